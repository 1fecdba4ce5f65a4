"""Pin wheels, parallel indexers and batches that cannot be: what the messages say."""

import numpy as np
import pytest

from drivewright.errors import InputError, SolverError
from drivewright.indexing.batch import evaluate_pin_wheels
from drivewright.indexing.motion import index_motion
from drivewright.indexing.parallel import ParallelIndexer
from drivewright.indexing.pin_wheel import PinWheel
from drivewright.motion import law

pytestmark = pytest.mark.error


def wheel(pins=12, circle=0.12, pin=8e-3, eccentricity=0.01):
    return PinWheel(pins, circle, pin, eccentricity, index_motion("modified-sine", pins))


def parallel(pins=8, circle=0.06, pin=9e-3, distance=0.085):
    return ParallelIndexer(pins, circle, pin, distance, index_motion("modified-sine", pins)).levels[0]


@pytest.mark.parametrize(
    ("drive", "words"),
    [
        (wheel(pin=0.032), "pin_radius = 32 mm: the pins overlap, their centres are 62.12 mm apart. Take less than 31.06 mm"),
        (wheel(pins=2), "pins = 2: a wheel needs at least 3 pins"),
        (wheel(eccentricity=0.115), "eccentricity + pin_radius = 123 mm reaches the middle of the pin circle of radius 120 mm"),
        (parallel(pin=0.025), "pin_radius = 25 mm: the pins overlap, their centres are 45.92 mm apart. Take less than 22.96 mm"),
        (
            parallel(distance=0.065),
            "centre_distance = 65 mm: the rollers reach 69 mm from the wheel's axis and sweep over the axis of the cams",
        ),
        (parallel(distance=0.03), "Take more than 69 mm"),
    ],
)
def test_no_cam_is_left(drive, words):
    with pytest.raises(InputError, match=words.replace("+", r"\+")):
        _ = drive.profile


def test_a_batch_wants_a_law_from_rest_to_rest():
    with pytest.raises(InputError, match="velocity of law 'constant-velocity' jumps"):
        evaluate_pin_wheels(law("constant-velocity"), 12, 0.12, 8e-3, 0.01, np.pi)


def test_a_batch_wants_a_side():
    with pytest.raises(InputError, match="side = 'left'; it is 'inside' or 'outside'"):
        evaluate_pin_wheels(law("modified-sine"), 12, 0.12, 8e-3, 0.01, np.pi, side="left")


def test_a_broken_loop_is_told():
    """Where the pins nearly stand still their envelope swings round in a wink; a crossing in it may be missed, and is not passed over."""
    drive = PinWheel(16, 0.12, 10.921345347403799e-3, 6.058702453908478e-3, index_motion("modified-sine", 16, 2.771))
    try:
        area = drive.profile.area
    except SolverError as error:
        assert "a crossing is missed" in str(error) and "Change pin_radius by a thousandth" in str(error)
    else:
        assert area == pytest.approx(3.6454e-2, rel=1e-3)
