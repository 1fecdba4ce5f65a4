"""Roller-gear designs that cannot be: the message says what, how much and what to try."""

import numpy as np
import pytest

from drivewright.errors import InputError
from drivewright.indexing.motion import index_motion
from drivewright.indexing.roller_gear import barrel, cam_part, compute_flanks, compute_roller_loads, develop_surface, globoidal

pytestmark = pytest.mark.error

MOTION = index_motion("modified-sine", 12, 2.0)
HOURGLASS = {"pin_circle_radius": 0.08, "roller_radius": 0.012, "roller_length": 0.016, "centre_distance": 0.125, "cam_length": 0.06}
DRUM = {"pin_circle_radius": 0.09, "roller_radius": 0.012, "roller_length": 0.016, "cam_radius": 0.05, "cam_length": 0.075}

CASES = [
    (globoidal, {"roller_radius": 0.019}, "overlap at their inner ends: half the pitch is 18.63 mm"),
    (globoidal, {"centre_distance": 0.088}, "from the turret's axis, touch the cam's axis. Raise centre_distance above 88.81 mm"),
    (globoidal, {"roller_length": 0.16}, "reach the turret's axis. Keep roller_length below 160 mm"),
    (globoidal, {"cam_length": 0.15}, "reaches beyond the circle of 72 mm radius through the feet"),
    (globoidal, {"cam_length": 0.04}, "shorter than a pitch of 41.41 mm"),
    (globoidal, {"cam_length": -0.04}, "cam_length = -0.04 m; it must be positive and finite"),
    (globoidal, {"roller_radius": np.nan}, "roller_radius = nan m; it must be positive and finite"),
    (globoidal, {"phase": np.inf}, "phase = inf"),
    (globoidal, {"hand": "up"}, "hand = 'up'; it is 'right' or 'left'"),
    (globoidal, {"motion": index_motion("modified-sine", 2, 1.0)}, "2 rollers; a turret needs at least 3"),
    (barrel, {"roller_radius": 0.0234}, "overlap on their circle: half the pitch is 23.29 mm"),
    (barrel, {"cam_radius": 0.008}, "reach the axis of a cam of cam_radius = 8 mm. Raise cam_radius above 8 mm"),
    (barrel, {"cam_radius": np.inf}, "cam_radius = inf m; it must be positive and finite"),
    (barrel, {"centre_distance": 0.15}, "passes beside a cam of outer radius 58 mm at centre_distance = 150 mm"),
    (barrel, {"cam_length": 0.16}, "does not fit into the rollers' circle of 90 mm radius. Keep it below 156 mm"),
    (barrel, {"cam_length": 0.03}, "shorter than a pitch of 46.59 mm"),
]


@pytest.mark.parametrize("make, change, message", CASES)
def test_impossible_designs_are_refused_with_the_limit(make, change, message):
    given = {"motion": MOTION, **(HOURGLASS if make is globoidal else DRUM), **change}
    with pytest.raises(InputError) as caught:
        make(**given)
    assert message in str(caught.value)
    if "hand" not in change:
        assert str(caught.value).startswith(f"{make.__name__} cam: ")


def test_loads_want_a_torque_and_a_modulus():
    found = compute_flanks(globoidal(MOTION, **HOURGLASS), np.array([0.3]), 3)
    with pytest.raises(InputError, match="torque = 0.0 N·m; it must be finite and not 0"):
        compute_roller_loads(found, 0.0, 115e9)
    with pytest.raises(InputError, match="effective modulus = -1.0 Pa"):
        compute_roller_loads(found, 100.0, -1.0)


def test_no_solid_of_a_cam_with_undercut_nor_with_too_wide_a_bore():
    thick = globoidal(index_motion("cycloidal", 12, 0.5), 0.08, 0.0165, 0.022, 0.115, 0.075)
    with pytest.raises(InputError, match=r"% of its flanks are lost to undercut.*Take thinner rollers"):
        cam_part(thick)
    with pytest.raises(InputError, match=r"a bore of 80 mm; it must be from 0 to below 72.8 mm, the floor of the groove"):
        cam_part(globoidal(MOTION, **HOURGLASS), bore=0.08)


def test_a_developed_view_runs_forward():
    with pytest.raises(InputError, match="from turn 1.0 to turn 0.0; the first must be below the second"):
        develop_surface(globoidal(MOTION, **HOURGLASS), 1.0, 0.0)
