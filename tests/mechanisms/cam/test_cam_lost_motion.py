"""The lost motion is what the follower loses: closed forms, a second route that moves the follower, what must not matter."""

import numpy as np
import pytest

import drivewright as dw
from drivewright import curves
from drivewright.errors import SolverError
from drivewright.mechanisms.cam.build import build
from drivewright.numerics.jets import variable
from drivewright.oracles.cam.laid_follower import LAID, verify

pytestmark = pytest.mark.analytical

RISE = [("50 deg", "cycloidal", "20 mm"), ("90 deg", "cycloidal", "-20 mm"), ("220 deg", "dwell", None)]
SWING = [("40 deg", "cycloidal", "25 deg"), ("70 deg", "cycloidal", "-25 deg"), ("250 deg", "dwell", None)]
STEEP = [("35 deg", "cycloidal", "30 deg"), ("70 deg", "cycloidal", "-30 deg"), ("255 deg", "dwell", None)]
GENTLE = [("60 deg", "cycloidal", "15 deg"), ("90 deg", "cycloidal", "-15 deg"), ("210 deg", "dwell", None)]
DIP = [("30 deg", "cycloidal", "20 mm"), ("30 deg", "cycloidal", "-20 mm"), ("300 deg", "dwell", None)]
ROLLER = {"motion": "translating", "face": "roller", "roller_radius": "18 mm", "prime_radius": "40 mm"}
FLAT = {"motion": "translating", "face": "flat", "prime_radius": "50 mm"}
LEVER = {"motion": "oscillating", "pivot_distance": "85 mm", "arm_length": "70 mm"}
ARM = LEVER | {"face": "roller", "roller_radius": "14 mm", "prime_radius": "40 mm"}
CASES = {  # follower, programme, more, prefix of the undercut track
    "roller": (ROLLER, RISE, {}, ""),
    "roller beside": (ROLLER | {"offset": "8 mm"}, RISE, {"rotation": "clockwise"}, ""),
    "flat": (FLAT, RISE, {}, ""),
    "flat, leaning": (FLAT | {"face_angle": "10 deg"}, RISE, {}, ""),
    "arm": (ARM, SWING, {"rotation": "clockwise"}, ""),
    "steep arm": (ARM | {"prime_radius": "35 mm", "roller_radius": "16 mm"}, STEEP, {}, ""),
    "flat lever": (LEVER | {"face": "flat", "prime_radius": "30 mm"}, GENTLE, {}, ""),
    "second cam": (ROLLER, RISE, {"closure": "conjugate", "conjugate": {"prime_radius": "60 mm"}}, "conjugate."),
    "second cam of an arm": (
        ARM,
        SWING,
        {"closure": "conjugate", "conjugate": {"prime_radius": "60 mm", "arm_length": "70 mm"}},
        "conjugate.",
    ),
    "outer wall": (ROLLER, DIP, {"closure": "groove"}, "outer."),
}


def cam(follower, segments, **more):
    programme = [{"angle": angle, "law": law} | ({"rise": rise} if rise else {}) for angle, law, rise in segments]
    return dw.Cam(follower=follower, programme=programme, **more)


@pytest.fixture(scope="module")
def ran():
    found = {name: cam(follower, segments, **more) for name, (follower, segments, more, _) in CASES.items()}
    return {name: (spec, dw.run(spec)) for name, spec in found.items()}


@pytest.mark.parametrize("name", CASES)
def test_the_follower_lowered_on_a_polygon_sinks_as_far(ran, name):
    spec, result = ran[name]
    prefix = CASES[name][3]
    lost, gap = result[f"{prefix}lost_motion"], result[f"{prefix}profile_gap"]
    row = next(row for row in verify(build(spec), result) if row[0] == f"{prefix}lost_motion")
    assert row[5] == LAID and row[1] == lost > 1e-6 and gap > 1e-6
    assert abs(lost - row[2]) <= 2e-5 * lost + 2e-9
    check = result.check(f"lost_motion{'.' if prefix else ''}{prefix[:-1]}")
    assert check.value == lost and not check.ok
    if name != "flat lever":
        assert lost >= gap * (1 - 1e-9)


def test_where_the_travel_leans_the_lost_motion_is_the_longer_one(ran):
    for name in ("roller", "roller beside", "arm", "steep arm", "second cam", "second cam of an arm"):
        _, result = ran[name]
        prefix = CASES[name][3]
        assert result[f"{prefix}lost_motion"] > 1.01 * result[f"{prefix}profile_gap"]


def test_at_67_degrees_a_fifth_is_between_them(ran):
    _, result = ran["steep arm"]
    assert np.degrees(result["max_pressure_angle"]) == pytest.approx(67.2, abs=0.1)
    assert result["lost_motion"] > 1.2 * result["profile_gap"]


def test_a_leaning_flat_face_sinks_by_the_gap_over_the_cosine(ran):
    for name, angle in (("flat", 0.0), ("flat, leaning", np.radians(10))):
        _, result = ran[name]
        assert result["lost_motion"] == pytest.approx(result["profile_gap"] / np.cos(angle), rel=1e-9)


def test_the_other_sense_of_rotation_is_the_mirror_image(ran):
    spec, result = ran["roller beside"]
    follower, segments, _, _ = CASES["roller beside"]
    assert dw.run(cam(follower, segments))["lost_motion"] == pytest.approx(result["lost_motion"], rel=1e-9)


def test_a_larger_cam_loses_in_proportion(ran):
    tenfold = {key: f"{10 * float(value.split()[0])} mm" if value.endswith("mm") else value for key, value in ARM.items()}
    large = dw.run(cam(tenfold, SWING, rotation="clockwise"))
    for name in ("lost_motion", "profile_gap"):
        assert large[name] == pytest.approx(10 * ran["arm"][1][name], rel=1e-6)


# -- the curves below it -------------------------------------------------------------------------------------------------------


def square(half):
    """Pieces of a square path, counter-clockwise, parameter 0 ... 4; the corner (half, half) is at 1."""
    corners = half * np.array([1 - 1j, 1 + 1j, -1 + 1j, -1 - 1j, 1 - 1j])
    return tuple(
        curves.Piece(float(k), float(k + 1), lambda t, a=a, b=b, k=k: a + (b - a) * (variable(t) - k), "side", "smooth")
        for k, (a, b) in enumerate(zip(corners[:-1], corners[1:], strict=True))
    )


@pytest.mark.parametrize("lean", [0.0, 20.0, 40.0])
def test_a_roller_over_a_square_corner(lean):
    """The profile's corner is R off in x and y; sinking at the angle f from the diagonal: |(R, R) - d (cos, sin)| = R."""
    half, radius = 0.1, 0.03
    left = curves.trim(curves.CircleFamily(square(half), radius))
    way = np.exp(1j * np.radians(45 + lean))

    def place(t, depth):
        return half * (1 + 1j) - depth * way

    along = way.real + way.imag
    exact = radius * (along - np.sqrt(along**2 - 1))
    assert curves.profile_gap(left, np.array([1.0]))[0] == pytest.approx(radius * (np.sqrt(2) - 1), rel=1e-9)
    assert curves.lost_motion(left, np.array([1.0]), place)[0] == pytest.approx(exact, rel=1e-9)
    assert curves.lost_motion(left, np.array([0.5]), place)[0] == 0


def test_a_follower_that_finds_nothing_falls_through():
    left = curves.trim(curves.CircleFamily(square(0.1), 0.03))
    with pytest.raises(SolverError, match="falls through"):
        curves.lost_motion(left, np.array([1.0]), lambda t, depth: (0.1 + depth) * (1 + 1j))


def test_the_greatest_is_found_between_samples():
    left = curves.trim(curves.CircleFamily(square(0.1), 0.03))

    def place(t, depth):
        """Towards a point beside the middle, so that no corner is like another."""
        side = np.clip(np.floor(t), 0, 3)
        at = 0.1 * 1j**side * (1 - 1j + 2j * (t - side))
        return at - depth * (at - 0.01) / np.abs(at - 0.01)

    at, lost = curves.largest_lost_motion(left, place)
    t = np.linspace(0, 4, 4001)
    assert lost >= curves.lost_motion(left, t, place).max() - 1e-9
    assert lost == pytest.approx(curves.lost_motion(left, np.array([at]), place)[0], rel=1e-12)
