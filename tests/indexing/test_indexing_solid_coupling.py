"""Condensed bodies on springs: with those of the reduced model they give its stiffness; what makes no sense is refused."""

import re

import numpy as np
import pytest
from solid_indexer import ANGLES, CAM, NU, SHAFT, E, drive, solved, wheel

from drivewright.bearings import BallBearing
from drivewright.errors import InputError
from drivewright.indexing.drivetrain import GearMesh, PowerLawBearing, SplitShaft
from drivewright.indexing.plane import find_contacts
from drivewright.indexing.solid import Solids, WheelBody, parts, solid_stiffness
from drivewright.shafts import Section
from drivewright.units import SI

pytestmark = pytest.mark.analytical

# ------------------------------------------------------------------------------------------------- the bodies of the reduced model


CASES = {
    "set A": ({}, 2, "inside"),
    "one cam": ({}, 1, "inside"),
    "three cams": ({}, 3, "inside"),
    "four cams": ({}, 4, "inside"),
    "outside": ({}, 2, "outside"),
    "housing and wheel": ({"housing": 3e8, "wheel": PowerLawBearing(2e8, 1.1, 3e-6), "wheel_torsion": 4e5}, 2, "inside"),
    "play": ({"gear": GearMesh(0.0275, 2.8e8, 0.3, 2e-5), "support": PowerLawBearing(6e7, 1.0, 5e-6)}, 2, "inside"),
    "little": ({"shaft": None, "gear": None, "support": None, "pins": None}, 2, "inside"),
    "rigid shafts": ({"shaft": None, "crank": None}, 2, "inside"),
    "rolling": ({"support": BallBearing(balls=9, ball_diameter=SI(0.006), pitch_diameter=SI(0.0285))}, 2, "inside"),
}
WIDE = np.radians([1e-3, 20.0, 45.0, 83.0, 110.0, 140.0, 179.0])


@pytest.mark.parametrize("model", ["bonded", "unilateral"])
@pytest.mark.parametrize("changes, cams, side", CASES.values(), ids=CASES)
def test_with_the_same_bodies_it_is_the_reduced_model(changes, cams, side, model):
    """Stiffness, contact state and forces of the pins; of rigid pins statics leaves the forces open."""
    for torque in (-1000.0, 700.0):
        found = solved(drive(cams, **changes), Solids(), torque, side, WIDE, cams=cams, model=model)
        carried = found.reduced.carried
        assert carried.any() and np.isnan(found.secant[~carried]).all()
        assert found.secant[carried] == pytest.approx(found.reduced.secant[carried], rel=1e-6)
        for own, theirs in zip(found.pin_forces, found.reduced.pin_forces, strict=True):
            if np.isfinite(theirs).all() and drive(**changes).pins is not None:
                assert np.array_equal(own != 0, theirs != 0)
                assert own == pytest.approx(theirs, rel=1e-6, abs=1e-6 * np.abs(theirs).max())


def test_energy_is_the_work_of_the_torque():
    """d(energy) = T d(phi) along the loading, contacts without a gap: Simpson over the torque of T phi' against the energy."""
    bare = [find_contacts(wheel(), each).of(slice(None)) for each in ANGLES[1:]]
    touching = [each.of(each.gap < 1e-9) for each in bare]
    torques = -1000.0 * np.linspace(0, 1, 65)[1:] ** 3
    loaded = [solid_stiffness(wheel(), drive(), Solids(), ANGLES[1:], touching, torque) for torque in torques]
    turn = np.array([np.zeros(2), *(torque / each.secant for torque, each in zip(torques, loaded, strict=True))])
    pull = np.array([0.0, *torques])[:, None]
    work = np.sum(0.5 * (pull[1:] + pull[:-1]) * np.diff(turn, axis=0), axis=0)
    assert loaded[-1].energy == pytest.approx(work, rel=1e-3)
    assert np.all(loaded[-1].energy < 0.5 * torques[-1] * turn[-1])  # laws that stiffen store less than half of T phi


def test_a_contact_of_the_assembly_has_its_own_state():
    """A cam ten times as soft as another is not asked where the rigid one carries: all contacts of both cams take part."""
    found = solved(drive(), Solids(), theta=WIDE)
    for own, near in zip(found.pin_forces, [find_contacts(wheel(), each) for each in WIDE], strict=True):
        assert own.shape == (2, len(near.gap)) and (np.isnan(own).all() or (own >= 0).all())


def test_shares_are_those_of_the_reduced_model():
    found = solved(drive(housing=3e8, wheel_torsion=4e5), Solids(), model="bonded")
    shares = found.reduced.shares
    for own, theirs in {"pin": "pin", "crank": "crank", "gear": "gear", "output": "wheel"}.items():
        assert found.shares[own] == pytest.approx(shares[theirs], rel=1e-9)
    assert found.shares["support"] == pytest.approx(shares["support"] + shares["housing"], rel=1e-9)
    assert found.shares["shaft"] == pytest.approx(shares["bending"] + shares["torsion"], rel=1e-9)
    assert np.all(found.shares["cam"] == 0) and np.all(found.shares["wheel"] == 0)


# ------------------------------------------------------------------------------------------------------------------ refusals

THIN = SplitShaft((Section(0.11, 0.019, 0.019),), 0.0, (0.025, 0.1), (0.05, 0.075), E, NU)
RING = WheelBody(((0.09, 0.11),), 0.2, 0.3, (0.27, 0.3))


@pytest.mark.parametrize(
    "solids, changes, message",
    [
        (Solids(CAM._replace(thickness=0.0)), {}, "solid check: CamBody.thickness = 0 must be above 0 and finite."),
        (Solids(CAM._replace(poisson=0.5)), {}, "solid check: CamBody.poisson = 0.5; a solid needs -1 < nu < 0.5."),
        (
            Solids(CAM._replace(hole_diameter=0.1, bore=0.02)),
            {},
            "solid check: holes of 100 mm, 110 mm apart, leave no wall between them and "
            "the bore of 20 mm; take smaller bearings or a wider spacing.",
        ),
        (
            Solids(CAM, SHAFT._replace(crank_width=0.03)),
            {},
            "solid check: the seats of cam 1 at 50 mm and of cam 2 at 75 mm on the split shaft overlap; make them narrower.",
        ),
        (
            Solids(shaft=SHAFT._replace(crank_diameter=1e-4)),
            {"shaft": THIN},
            "solid check: a crank pin of 0.1 mm, 10 mm off the axis, does not reach the shaft of 19 mm; take a thicker one.",
        ),
        (Solids(shaft=SHAFT), {"shaft": None}, "solid check: solid shafts and wheels take their axial positions from the split shaft"),
        (
            Solids(wheel=RING),
            {},
            "solid check: the pins of a solid wheel are loaded over the width of the cams; give the cam as a solid too.",
        ),
        (
            Solids(CAM, wheel=RING._replace(bore=0.23)),
            {},
            "solid check: the ring of 230 to 300 mm does not hold the pins, which reach from 224 to 256 mm.",
        ),
        (Solids(CAM, wheel=RING._replace(flange=(0.3, 0.31))), {}, "solid check: WheelBody.flange = (0.3, 0.31) m lies outside the ring"),
        (Solids(CAM, wheel=RING._replace(drum=(0.27, 0.3))), {}, "solid check: WheelBody.drum = (0.27, 0.3) m joins two rings"),
        (
            Solids(CAM, wheel=RING._replace(rings=((0.08, 0.1),))),
            {},
            "solid check: the cam at z = 75 mm runs into the ring from 80 to 100 mm; move the ring.",
        ),
        (
            Solids(CAM, wheel=RING._replace(rings=())),
            {},
            "solid check: WheelBody.rings = (); give one or two rings, each from a lower to a higher z.",
        ),
    ],
)
def test_bodies_without_meaning_are_refused(solids, changes, message):
    with pytest.raises(InputError, match=re.escape(message)):
        parts.check(solids, wheel(), drive(**changes), 2)


def test_no_position_that_carries_is_refused():
    with pytest.raises(InputError, match="assembly: no position carries the torque: no contact without a gap resists the torque"):
        solid_stiffness(wheel(), drive(), Solids(), [0.2], [find_contacts(wheel(), 0.2)], 1000.0)
