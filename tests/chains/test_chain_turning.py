"""Rigid links around any number of bodies, angle by angle: against the closure of two sprockets, and exact lengths, periods, limits."""

from dataclasses import replace

import numpy as np
import pytest
from test_chain_path import PITCH, TOUCH, drive, idler, wheel

from drivewright.chains.closure import Drive, close
from drivewright.chains.explicit.assembly import start
from drivewright.chains.explicit.turning import turning, yielding
from drivewright.chains.model import Guide, Slide
from drivewright.chains.path import balanced
from drivewright.errors import InputError

pytestmark = pytest.mark.analytical

RAIL = Guide((0.16, -0.345), 0.3, 1.3, 1.84, "outside", 4e-3, TOUCH)


def pins(plates):
    """Right pins of all plates (S, N) as complex numbers."""
    return plates[..., 0] + 1j * plates[..., 1] + 0.5 * PITCH * np.exp(1j * plates[..., 2])


@pytest.mark.parametrize(("teeth", "links"), [((19, 38), 96), ((19, 37), 95), ((17, 17), 60)])
def test_two_sprockets_are_those_of_the_closure(teeth, links):
    # a rail far away makes the drive one of the general kind
    away = replace(RAIL, centre=(0.16, -1.0))
    closure = close(Drive(drive().chain.link, *teeth, links, "straight"))
    model = drive(teeth=teeth, links=links, slide=Slide(0.0, 1.0), guides=(away,), distance=closure.mean)
    angle = -np.linspace(0.0, 2 * np.pi / teeth[0], 97)
    found = turning(model, angle)
    error = found.psi[:, 1] - angle * teeth[0] / teeth[1]
    moved = found.q[:, 1]
    assert np.mean(0.5 * (moved[1:] + moved[:-1])) == pytest.approx(0.0, abs=2e-9)
    assert np.ptp(moved) == pytest.approx(closure.fluctuation, rel=2e-3, abs=1e-10)
    assert np.ptp(error) == pytest.approx(closure.transmission_ripple, rel=2e-3)


@pytest.mark.parametrize(
    "model", [drive(idler(), torque=8.0), drive(idler(), guides=(RAIL,)), drive(idler(19, (0.2, 0.03), 60.0, 500.0), links=98)]
)
def test_links_keep_their_length_and_a_tooth_further_all_is_as_before(model):
    angle = -np.linspace(0.0, 2 * np.pi / 19, 25)
    found = turning(model, angle)
    joints = pins(found.plates)
    left = joints - PITCH * np.exp(1j * found.plates[..., 2])
    assert np.max(np.abs(joints - np.roll(left, -1, axis=1))) < 1e-10
    np.testing.assert_allclose(np.roll(found.plates[-1, :, :2], 1, axis=0), found.plates[0, :, :2], atol=1e-9)
    assert found.q[-1, 2] == pytest.approx(found.q[0, 2], abs=1e-10)
    assert 1e-6 < np.ptp(found.q[:, 2]) < 2e-3


def test_nothing_jumps_where_plates_seat_or_leave():
    model = drive(idler(), torque=8.0)
    coarse, fine = (np.max(np.abs(np.diff(turning(model, -np.linspace(0.0, 2 * np.pi / 19, n)).q[:, 2]))) for n in (25, 97))
    assert fine < 0.4 * coarse  # a jump would stay as it is


def test_seated_rollers_lie_on_the_pitch_circles():
    model = drive(idler(), torque=8.0)
    found = turning(model, [0.0])
    for number, sprocket in enumerate(model.sprockets):
        centre = complex(*sprocket.centre) + (sprocket.slide.shift(complex(*sprocket.centre), found.q[0, number]) if sprocket.slide else 0)
        off = np.abs(np.abs(pins(found.plates[0]) - centre) - sprocket.tooth.pitch_radius)
        assert np.sum(off < 1e-9) >= (10, 20, 1)[number]
        gaps = np.angle((pins(found.plates[0]) - centre)[off < 1e-9]) - found.psi[0, number]
        phi = 2 * np.pi / sprocket.tooth.teeth
        np.testing.assert_allclose(gaps / phi - np.round(gaps / phi - 0.5), 0.5, atol=1e-6)  # rollers lie in gaps, midway between teeth


def test_a_blade_gives_way_until_the_pitch_is_its_own():
    slide = Slide(0.0, 30.0, 500.0, pivot=(0.03, 0.08), lever=-0.12)
    blade = Guide((0.15, 0.225), 0.2, -2.0, -1.2, "outside", 4e-3, TOUCH, mass=0.05, slide=slide, name="blade")
    model = drive(guides=(blade,))
    found = turning(model, -np.linspace(0.0, 2 * np.pi / 19, 9))
    step = np.abs(np.diff(np.append(pins(found.plates[3]), pins(found.plates[3])[0])))
    assert np.max(np.abs(step - PITCH)) < 1e-9
    assert yielding(model, balanced(model)) == 2
    assert np.ptp(found.q[:, 2]) > 1e-6


def test_what_gives_way_has_to_be_one_body():
    still = drive(wheel(21, (0.11, -0.08)), links=102, distance=0.3195)
    with pytest.raises(InputError, match="no body can move"):
        yielding(still, balanced(drive(distance=0.32)))
    both = drive(idler(), slide=Slide(0.0, 100.0))
    with pytest.raises(InputError, match="2 bodies can move, so that their positions depend on the forces"):
        yielding(both, balanced(both))


def test_the_start_puts_all_bodies_in_balance():
    model = drive(idler(), torque=8.0, guides=(RAIL,))
    begin, found = start(model), balanced(model)
    assert begin.q[2] == pytest.approx(found.q[2], abs=3e-4)
    assert len(begin.poses) == 96 and begin.rate_psi[2] == pytest.approx(60.0 * 19 / 15)  # the idler outside turns the other way
    joints = pins(begin.poses)
    step = np.abs(np.diff(np.append(joints, joints[0])))
    assert np.max(np.abs(step - PITCH)) < np.max(found.pulls + found.centrifugal) / 3e7 * 1.01
