"""Condensed bodies on springs: with those of the reduced model they give its stiffness; what makes no sense is refused."""

import re

import numpy as np
import pytest
from solid_indexer import CAM, NU, SHAFT, E, drive, solved, wheel

from drivewright.bearings import BallBearing
from drivewright.errors import DoesNotAssemble, InputError
from drivewright.indexing.drivetrain import GearMesh, PowerLawBearing, SplitShaft
from drivewright.indexing.plane import find_contacts
from drivewright.indexing.solid import Solids, WheelBody, parts, solid_stiffness
from drivewright.shafts import Section
from drivewright.solids.coupling import InterfaceSpring, solve_coupled
from drivewright.solids.substructures import InterfaceLoad, rigid_substructure
from drivewright.units import SI

pytestmark = pytest.mark.analytical

# ------------------------------------------------------------------------------------------------- the bodies of the reduced model


@pytest.mark.parametrize("model", ["bonded", "unilateral"])
@pytest.mark.parametrize(
    "changes, cams, side",
    [
        ({}, 2, "inside"),
        ({}, 1, "inside"),
        ({}, 3, "inside"),
        ({}, 4, "inside"),
        ({}, 2, "outside"),
        ({"housing": 3e8, "wheel": PowerLawBearing(2e8, 1.1, 3e-6), "wheel_torsion": 4e5}, 2, "inside"),
        ({"gear": GearMesh(0.0275, 2.8e8, 0.3, 2e-5), "support": PowerLawBearing(6e7, 1.0, 5e-6)}, 2, "inside"),
        ({"shaft": None, "gear": None, "support": None, "pins": None}, 2, "inside"),
        ({"shaft": None, "crank": None}, 2, "inside"),
    ],
    ids=["set A", "one cam", "three cams", "four cams", "outside", "housing and wheel", "play", "little", "rigid shafts"],
)
def test_with_the_same_bodies_it_is_the_reduced_model(changes, cams, side, model):
    for torque in (-1000.0, 700.0):
        found = solved(drive(cams, **changes), Solids(), torque, side, cams=cams, model=model)
        carried = np.array(found.reduced.outcome) == "carried"
        assert carried.any() and np.isnan(found.secant[~carried]).all()
        assert found.secant[carried] == pytest.approx(found.reduced.secant[carried], rel=1e-8)


def test_a_rolling_bearing_by_its_elements():
    ball = BallBearing(balls=9, ball_diameter=SI(0.006), pitch_diameter=SI(0.0285))
    found = solved(drive(support=ball), Solids(), model="bonded")
    assert found.secant == pytest.approx(found.reduced.secant, rel=1e-8)


def test_shares_are_those_of_the_reduced_model():
    found = solved(drive(housing=3e8, wheel_torsion=4e5), Solids(), model="bonded")
    shares = found.reduced.shares
    for own, theirs in {"pin": "pin", "crank": "crank", "gear": "gear", "output": "wheel"}.items():
        assert found.shares[own] == pytest.approx(shares[theirs], rel=1e-9)
    assert found.shares["support"] == pytest.approx(shares["support"] + shares["housing"], rel=1e-9)
    assert found.shares["shaft"] == pytest.approx(shares["bending"] + shares["torsion"], rel=1e-9)
    assert np.all(found.shares["cam"] == 0) and np.all(found.shares["wheel"] == 0)


def test_two_springs_in_a_row_and_a_gap():
    """A bar of flexibility f between a spring behind a gap and a load P: u = P/k + gap + 4 f P, f between ends that move apart."""
    places = [InterfaceLoad((n,), np.array([1.0, 0, 0]), np.zeros(3)) for n in (0, 1)]
    bar = rigid_substructure(places, (0,))._replace(flexibility=2e-9 * np.array([[1.0, -1.0], [-1.0, 1.0]]))
    found = solve_coupled({"bar": bar}, [InterfaceSpring("ground", (("bar", (0,), 1.0),), 1 / 3e8, 1e-5)], ("bar", (1,), 500.0))
    assert found.displacements[1] == pytest.approx(500 / 3e8 + 1e-5 + 500 * 8e-9, rel=1e-12)
    assert found.forces == pytest.approx([500.0])
    with pytest.raises(DoesNotAssemble, match="some body moves freely between its springs"):
        solve_coupled({"bar": bar, "other": bar}, [InterfaceSpring("ground", (("bar", (0,), 1.0),), 0.0)], ("bar", (1,), 1.0))


# ------------------------------------------------------------------------------------------------------------------ refusals

THIN = SplitShaft((Section(0.11, 0.019, 0.019),), 0.0, (0.025, 0.1), (0.05, 0.075), E, NU)
RING = WheelBody(((0.09, 0.11),), 0.2, 0.3, (0.27, 0.3))


@pytest.mark.parametrize(
    "solids, changes, message",
    [
        (Solids(CAM._replace(thickness=0.0)), {}, "solid check: CamBody.thickness = 0 must be above 0 and finite."),
        (Solids(CAM._replace(poisson=0.5)), {}, "solid check: CamBody.poisson = 0.5; a solid wants -1 < nu < 0.5."),
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
        (Solids(shaft=SHAFT), {"shaft": None}, "solid check: the solids of shaft and wheel stand at the heights of the split shaft"),
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
            "solid check: WheelBody.rings = (); one or two rings, each from a lower to a higher z.",
        ),
    ],
)
def test_bodies_without_meaning_are_refused(solids, changes, message):
    with pytest.raises(InputError, match=re.escape(message)):
        parts.check(solids, wheel(), drive(**changes), 2)


def test_no_position_that_carries_is_refused():
    with pytest.raises(InputError, match="solid check: no position carries the torque: no contact without a gap resists the torque"):
        solid_stiffness(wheel(), drive(), Solids(), [0.2], [find_contacts(wheel(), 0.2)], 1000.0)
