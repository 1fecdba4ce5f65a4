"""Every line of the list of bad inputs for the seedling pusher: refused by key, or computed in full with a check that fails."""

import math
import tomllib

import numpy as np
import pytest
from places import EXAMPLES

import drivewright as dw
from drivewright.errors import SpecError
from drivewright.registry import mechanism
from drivewright.spec import load

pytestmark = pytest.mark.error

EXAMPLE = EXAMPLES / "seedling_pusher.toml"


def refusal(*changes):
    """(key, message) of the example with some keys changed."""
    with pytest.raises(SpecError) as caught:
        dw.build(load(EXAMPLE, changes))
    return caught.value.key, str(caught.value)


def computed(*changes, only=("cams",)):
    result = dw.run(load(EXAMPLE, changes), only=only)
    assert result.outcome == "complete" and result.values and result.tables
    return result


# -- refused: no meaning, or no solution ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("change", "key", "words"),
    [
        ('events.take="gate"', "events.gate_point", 'is missing: events.take = "gate" needs it'),
        ('events.take="angle"', "events.take_angle", 'is missing: events.take = "angle" needs it'),
        ("train.axis_ratio=0", None, "must be greater than 0, got 0"),
        ("train.axis_ratio=-0.5", None, "must be greater than 0, got -0.5"),
        ("train.axis_ratio=1.000001", None, "must be at most 1, got 1"),
        ("train.axis_ratio=1e-9", None, "0 <= e < 1"),
        ("train.axis_ratio=1.2e-4", None, "take a rounder ellipse"),
        ("train.semi_major=0 mm", None, "must be greater than 0 mm, got 0 mm"),
        ("train.semi_major=-16 mm", None, "must be greater than 0 mm, got -16 mm"),
        ("arm.tip_distance=0 mm", None, "must be greater than 0 mm, got 0 mm"),
        ("arm.tip_distance=-175 mm", None, "must be greater than 0 mm"),
        ("train.bend=0 deg", None, "must be greater than 0 deg, got 0 deg"),
        ("train.bend=180 deg", None, "must be less than 180 deg, got 180 deg"),
        ("train.bend=-89 deg", None, "must be greater than 0 deg, got -89 deg"),
        ("push.rise=0 deg", None, "must be greater than 0 deg"),
        ("push.rise=-21 deg", None, "must be greater than 0 deg"),
        ("push.hold=-1 deg", None, "must be at least 0 deg"),
        ("push.retraction=0 deg", None, "must be greater than 0 deg"),
        ("push.rise=360 deg", None, "must be less than 360 deg"),
        ("push.rise=330 deg", "push", "rise, hold and retraction sum to 367°; they must leave a rest within one turn of 360°"),
        ("push.retraction=338 deg", "push", "sum to 360°"),
        ("push.hold=310 deg", "push", "sum to 367°"),
        ("push.end=360 deg", None, "must be less than 360 deg"),
        ("push.stroke=0 mm", None, "must be greater than 0 mm"),
        ("push.stroke=-18 mm", None, "must be greater than 0 mm"),
        ("push.stroke=1 m", "cams.prime_radius_return", "the lever swings 86.79°, which takes the return arm from 63.08 to -23.71°"),
        ("push.law=polynomial-346", None, "no motion law is called 'polynomial-346' (did you mean 'polynomial-345'?)"),
        ("push.law=dwell", None, "a dwell does not move"),
        ("push.law=table", None, "give either a file, or the arrays"),
        ("push.law=spline", None, "'points'"),
        ("lever.output_arm=0 mm", None, "must be greater than 0 mm"),
        ("lever.output_arm=-56 mm", None, "must be greater than 0 mm"),
        ("lever.pivot_distance=0 mm", None, "must be greater than 0 mm"),
        ("cams.prime_radius_main=21 mm", None, "onto or past its dead point"),
        ("cams.prime_radius_main=53 mm", None, "reaches radii from 21 to 53 mm"),
        (
            "cams.prime_radius_main=20.9 mm",
            None,
            "with pivot_distance 37 mm and arm_length 16 mm the roller reaches radii from 21 to 53 mm",
        ),
        ("cams.prime_radius_main=53.1 mm", None, "prime_radius 53.1 mm is not between them"),
        ("cams.prime_radius_return=20 mm", None, "prime_radius 20 mm is not between them"),
        ("cams.prime_radius_return=54 mm", None, "prime_radius 54 mm is not between them"),
        ("lever.arm_main=80 mm", "cams.prime_radius_main", "radii from 43 to 117 mm"),
        ("cams.roller_radius=0 mm", None, "must be greater than 0 mm"),
        ("cams.roller_radius=29 mm", None, "29 mm leaves nothing of the main cam: the roller's centre comes as near as 29 mm to the axis"),
        ("cams.roller_radius=28.2 mm", None, "28.2 mm leaves nothing of the return cam: the roller's centre comes as near as 28.1363 mm"),
        ("field.spacing=0 mm", None, "must be greater than 0 mm"),
        ("field.spacing=-140 mm", None, "must be greater than 0 mm"),
        ("train.teeth=20", None, "odd number of teeth, take 21"),
        ("drive.speed=0 rpm", None, "must be greater than 0 rpm"),
        ("contact.turns=0", None, "must be at least 1, got 0"),
        ("contact.clearance=-1 um", None, "must be at least 0 mm"),
    ],
)
def test_what_has_no_meaning_is_refused_by_its_key(change, key, words):
    named, message = refusal(change)
    wanted = key or change.partition("=")[0]
    assert named == wanted and f"{wanted}: " in message and words in message and "\n" not in message


def test_roots_of_the_arms_are_refused_exactly_where_the_triangle_ends():
    """|a - l| < r0 < a + l, and the swung arm must stay off its dead points."""
    for radius in (21.001, 52.999):
        try:
            dw.build(load(EXAMPLE, [f"cams.prime_radius_main={radius} mm"]))
        except SpecError as error:  # at the far end the swing takes the arm past 180 deg
            assert radius > 50 and "dead point" in str(error)


NUMERIC = [
    f"{table}.{key}"
    for table, keys in tomllib.loads(EXAMPLE.read_text()).items()
    if isinstance(keys, dict) and table != "optimise"
    for key, value in keys.items()
    if not isinstance(value, str) or value[:1].isdigit()
]


@pytest.mark.parametrize("key", NUMERIC)
@pytest.mark.parametrize(
    "value", ["nan", "inf", "-inf", "'nan mm'", "'inf deg'", "'a lot'", "''", "true", "[]", "{}", "1979-05-27", "[1, 2]"]
)
def test_nan_infinity_and_wrong_types_are_refused_everywhere(key, value):
    named, message = refusal(f"{key}={value}")
    assert named == key and "Traceback" not in message and "\n" not in message


@pytest.mark.parametrize("key", [key for key in NUMERIC if key not in ("train.axis_ratio", "train.teeth")])
@pytest.mark.parametrize("value", ["1", "1.5", "'1.5'"])
def test_a_bare_number_is_refused_so_that_degrees_and_radians_cannot_mix(key, value):
    named, message = refusal(f"{key}={value}")
    assert named == key and "unit missing: " in message and ", e.g. " in message


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ("train.bend=89 mm", "wants an angle, got '89 mm' (length)"),
        ("push.stroke=18 deg", "wants a length, got '18 deg' (angle)"),
        ("drive.speed=200 1/s", "a frequency counts events"),
        ("contact.stiffness=2e7 N m/rad", "wants a stiffness"),
        ("load.mass=2 N", "wants a mass, got '2 N' (force)"),
    ],
)
def test_a_wrong_unit_is_refused_with_both_names(change, words):
    assert refusal(change)[0] == change.partition("=")[0] and words in refusal(change)[1]


def test_degrees_and_radians_said_so_mean_the_same():
    assert load(EXAMPLE, ["train.bend=0.25 rev", "push.rise=1260 arcmin"]).digest() == load(EXAMPLE, ["train.bend=90 deg"]).digest()


def test_there_is_no_switch_that_allows_it():
    named, message = refusal("cams.allow_undercut=true")
    assert named == "cams.allow_undercut" and "unknown key" in message


# -- computed in full, and a check fails ---------------------------------------------------------------------------------------


def test_undercut_is_a_failed_check_of_a_complete_result():
    result = computed()
    failed = result.check("undercut.return")
    assert not failed.ok and failed.geometry and failed.value == pytest.approx(0.9035, abs=2e-4) and failed.limit == 1.0
    assert result.check("undercut.main").ok and result["cam.return.lost_motion"] > 0
    assert any("return cam is undercut" in finding for finding in result.findings)


@pytest.mark.parametrize("radius", [14.5, 20.0])
def test_a_roller_too_large_for_the_hub_is_a_failed_check(radius):
    """The wall between profile and hub: least pitch radius - roller - hub radius."""
    result = computed(f"cams.roller_radius={radius} mm")
    for cam in ("main", "return"):
        check = result.check(f"hub_wall.{cam}")
        assert not check.ok and check.value == pytest.approx(result[f"cam.{cam}.min_pitch_radius"] - 1e-3 * radius - 0.015, abs=1e-9)
        assert not result.check(f"undercut.{cam}").ok
    assert computed("cams.roller_radius=4.3 mm").check("hub_wall.main").ok


@pytest.mark.parametrize(
    ("changes", "name"),
    [
        (["limits.pitch_radius=33 mm"], "pitch_radius"),
        (["limits.pressure_angle=30 deg"], "pressure_angle.main"),
        (["cams.coplanar_rollers=true", "cams.roller_radius=14 mm"], "roller_clearance"),
        (["push.rise=8 deg"], "pressure_angle.main"),
    ],
)
def test_a_design_that_should_not_be_built_is_computed(changes, name):
    check = computed(*changes).check(name)
    assert not check.ok and check.margin < 0 and check.message


# -- legal, though it looks wrong ----------------------------------------------------------------------------------------------


def test_circular_gears_are_legal_and_give_pure_translation():
    """k = 1: phi3 = t, so the arm does not rotate and every point of it moves as the planet axis does."""
    model = dw.build(load(EXAMPLE, ["train.axis_ratio=1"]))
    t = np.linspace(0.3, 6.1, 37)
    np.testing.assert_allclose(model.arm.planet(t).d0, t, atol=1e-13)
    np.testing.assert_allclose(model.arm.rotation(t).d0, 0, atol=1e-13)
    offset = (model.arm.point(t) - model.arm.axis(t)).d0
    np.testing.assert_allclose(offset, offset[0], atol=1e-15)
    result = computed("train.axis_ratio=1", only=("train",))
    assert result["tip.track_height"] == pytest.approx(result["tip.track_width"], rel=1e-9)  # a circle
    assert result["tip.track_height"] == pytest.approx(2 * abs(2 * 16.272e-3 * (1 + np.exp(1j * math.radians(89)))), rel=1e-9)


def test_no_hold_and_almost_no_rest_are_legal():
    assert computed("push.hold=0 deg").values.keys() == computed().values.keys()
    assert computed("push.hold=302.9 deg")["cam.main.max_pressure_angle.rise"] == pytest.approx(
        computed()["cam.main.max_pressure_angle.rise"], rel=1e-9
    )


def test_every_preset_is_legal():
    for path in mechanism("seedling-pusher").presets().values():
        dw.build(load(path))
