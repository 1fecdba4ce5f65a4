"""A programme stated as the lift of a valve, or along an arm's arc: the rocker by root-finding, its force by Lagrange's equation."""

import numpy as np
import pytest
from scipy.optimize import brentq

import drivewright as dw
from drivewright.cams import GuidedArm
from drivewright.errors import InputError
from drivewright.mechanisms.cam.build import build
from drivewright.mechanisms.cam.spec import CamSpec
from drivewright.numerics.jets import Jet, variable
from drivewright.spec import from_document

LIFT, ARM, TIP, START, SPEED = 9.5e-3, 0.025, 0.037, np.radians(-6), 300.0
ROCKER = {
    "motion": "oscillating",
    "face": "roller",
    "roller_radius": "9 mm",
    "prime_radius": "28 mm",
    "pivot_distance": "40 mm",
    "arm_length": "25 mm",
}
VALVE = {"arm_length": "37 mm", "start_angle": "-6 deg"}
RISE = np.radians(65)


def segments(rise="9.5 mm", law="polynomial-4567"):
    return [
        {"angle": "65 deg", "law": law, "rise": rise},
        {"angle": "65 deg", "law": law, "rise": f"-{rise}"},
        {"angle": "230 deg", "law": "dwell"},
    ]


def spec(follower=None, programme=None, **tables):
    data = {"mechanism": "cam", "follower": {**ROCKER, **(follower or {})}, "programme": programme or segments(), **tables}
    return from_document({key: value for key, value in data.items() if value is not None}, CamSpec)


def typed_lift(theta):
    """s, s', s'', s''' of the rise of the 4-5-6-7 polynomial, typed out."""
    powers, factors = np.array([4, 5, 6, 7]), np.array([35.0, -84.0, 70.0, -20.0])
    out = []
    for order in range(4):
        rates = np.prod([powers - k for k in range(order)], axis=0) if order else np.ones(4)
        out.append(LIFT * np.sum(factors * rates * (theta / RISE) ** (powers - order)) / RISE**order)
    return np.array(out)


def swing_by_root(theta):
    """Swing of the rocker at which the pad stands where the lift is."""
    wanted = typed_lift(theta)[0]
    return brentq(lambda swing: TIP * (np.sin(START + swing) - np.sin(START)) - wanted, -0.5, 1.0, xtol=1e-16, rtol=1e-15)


@pytest.mark.analytical
def test_swing_by_root_finding_and_differences():
    programme = build(spec(valve=VALVE)).programme
    angles, step = RISE * np.array([0.13, 0.37, 0.71, 0.93]), 2e-3
    for theta in angles:
        around = np.array([swing_by_root(theta + k * step) for k in range(-3, 4)])
        first = np.dot([-1, 9, -45, 0, 45, -9, 1], around) / (60 * step)
        second = np.dot([2, -27, 270, -490, 270, -27, 2], around) / (180 * step**2)
        third = np.dot([1, -8, 13, 0, -13, 8, -1], around) / (8 * step**3)
        ours = programme(theta)
        assert ours.s == pytest.approx(around[3], abs=1e-14)
        assert ours.v == pytest.approx(first, rel=1e-8)
        assert ours.a == pytest.approx(second, rel=1e-5, abs=1e-5)
        assert ours.j == pytest.approx(third, rel=1e-4, abs=1e-3)


@pytest.mark.analytical
def test_values_and_columns_of_the_valve():
    result = dw.run(spec(valve=VALVE, drive={"speed": f"{SPEED} rad/s"}), only=("motion",))
    assert result["valve.lift"] == pytest.approx(LIFT, rel=1e-13)
    table = result.tables["valve"]
    rows = np.flatnonzero((table["angle"].data > 0) & (table["angle"].data < RISE))[::7]
    typed = np.array([typed_lift(theta) for theta in table["angle"].data[rows]])
    for order, name in enumerate(("lift", "velocity", "acceleration", "jerk")):
        scale = np.max(np.abs(typed[:, order]))
        assert table[name].data[rows] / SPEED**order == pytest.approx(typed[:, order], abs=1e-11 * scale), name
    # Published peaks of the law: 2.1875 and 7.5132.
    assert result["valve.max_velocity"] == pytest.approx(2.1875 * LIFT / RISE * SPEED, rel=1e-12)
    assert result["valve.max_acceleration"] == pytest.approx(7.5132 * LIFT / (RISE / SPEED) ** 2, rel=1e-5)
    assert result["valve.min_acceleration"] == pytest.approx(-result["valve.max_acceleration"], rel=1e-12)
    # Steepest at the middle of the arc, where the arm is square to the valve.
    assert result["valve.max_rocker_ratio"] == pytest.approx(TIP / ARM, rel=1e-12)
    end = START + swing_by_root(RISE)
    assert result["valve.min_rocker_ratio"] == pytest.approx(TIP / ARM * min(np.cos(START), np.cos(end)), rel=1e-12)
    assert result["valve.wipe"] == pytest.approx(TIP * (1 - min(np.cos(START), np.cos(end))), rel=1e-9)
    assert result["lift"] == pytest.approx(end - START, rel=1e-12)


@pytest.mark.analytical
def test_a_swing_that_is_stated_moves_the_valve_by_the_same_arm():
    result = dw.run(spec(programme=segments("14 deg"), valve=VALVE, drive={"speed": f"{SPEED} rad/s"}), only=("motion",))
    assert result["lift"] == pytest.approx(np.radians(14), rel=1e-12)
    assert result["valve.lift"] == pytest.approx(TIP * (np.sin(START + np.radians(14)) - np.sin(START)), rel=1e-12)
    table = result.tables["valve"]
    within = slice(3, 120)
    slope = np.gradient(table["lift"].data[within], table["angle"].data[within], edge_order=2)
    assert table["velocity"].data[within] / SPEED == pytest.approx(slope, abs=6e-4 * np.max(slope))


@pytest.mark.property
@pytest.mark.parametrize(("place", "length"), [("arm", ARM), ("tip", TIP)])
def test_a_lift_along_an_arc_is_the_swing_times_the_arm(place, length):
    stated = build(spec({"lift_at": place}, valve=VALVE)).programme
    swung = build(spec(programme=segments(f"{LIFT / length} rad"), valve=VALVE)).programme
    theta = np.linspace(0, 6.2, 40)
    for ours, other in zip(stated(theta), swung(theta), strict=True):
        assert ours == pytest.approx(other, abs=1e-12 * max(1, np.max(np.abs(other))))
    ours, other = stated.function.peaks(), swung.function.peaks()
    assert ours == pytest.approx(other, rel=1e-11)
    assert stated.continuity == swung.continuity == 3


@pytest.mark.property
def test_a_long_arm_has_a_constant_ratio():
    """The ratio departs from L/arm as the square of lift over arm: a hundredfold arm has a 10 000th of the departure."""

    def departure(scale):
        arm = GuidedArm(scale * TIP)
        swing = arm.value(variable(np.array([LIFT])))
        return abs(1 - arm.ratio(swing).d0[0] / arm.length)

    assert departure(10) / departure(1000) == pytest.approx(1e4, rel=1e-2)


@pytest.mark.property
def test_the_map_and_its_inverse():
    arm, theta = GuidedArm(TIP, START), np.linspace(0.05, RISE - 0.05, 9)
    stated = Jet(*np.array([typed_lift(each) for each in theta]).T)
    swing = arm.value(stated)
    for back, given in zip(arm.lift(swing), stated, strict=True):
        assert back == pytest.approx(given, abs=1e-12 * np.max(np.abs(given)))
    for ours, other in zip(arm.slope(stated), (arm.ratio(swing) ** -1), strict=True):
        assert ours == pytest.approx(other, rel=1e-11)


@pytest.mark.analytical
def test_force_at_the_cam_by_lagrange():
    """The torque about the pivot is d/dt dT/dphi' - dT/dphi + dV/dphi of valve, spring and rocker, by differences of the energies."""
    mass, inertia, stiffness, preload = 0.09, 4e-5, 30e3, 280.0
    loads = {"load": {"mass": "0.09 kg"}, "spring": {"stiffness": "30 N/mm", "preload": "280 N"}, "drive": {"speed": f"{SPEED} rad/s"}}
    model = build(spec({"inertia": "4e-5 kg m^2"}, valve=VALVE, **loads))
    height = lambda swing: TIP * (np.sin(START + swing) - np.sin(START))  # noqa: E731
    theta, step = 0.41 * RISE, 1e-4
    swings = np.array([swing_by_root(theta + k * step) for k in (-2, -1, 0, 1, 2)])
    rate = (swings[3] - swings[1]) / (2 * step) * SPEED
    bend = (swings[3] - 2 * swings[2] + swings[1]) / step**2 * SPEED**2
    small = 1e-5
    lever = (height(swings[2] + small) - height(swings[2] - small)) / (2 * small)
    lever_slope = (height(swings[2] + small) - 2 * height(swings[2]) + height(swings[2] - small)) / small**2
    acceleration = lever * bend + lever_slope * rate**2
    torque = inertia * bend + lever * (mass * acceleration + stiffness * height(swings[2]) + preload)
    ours = model.required(*model.cycle.at_angle(np.array([theta]))).d0[0]
    assert ours * ARM == pytest.approx(torque, rel=1e-5)


@pytest.mark.property
def test_energy_of_the_rocker_and_its_valve():
    loads = {"load": {"mass": "0.09 kg", "damping": "8 N s/m"}, "spring": {"stiffness": "30 N/mm", "preload": "380 N"}}
    given = spec({"inertia": "4e-5 kg m^2"}, valve=VALVE, drive={"speed": "200 rad/s"}, **loads)
    assert dw.run(given, only=("energy",)).check("energy_audit").ok


@pytest.mark.error
@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({}, ("programme.0.rise", "must be an angle", 'lift_at = "arm"', "[valve]")),
        ({"follower": {"lift_at": "valve"}}, ("valve", "is missing", "second arm")),
        ({"follower": {"lift_at": "tip"}}, ("valve", "is missing", "second arm")),
        ({"follower": {"lift_at": "arm"}, "programme": segments("14 deg")}, ("programme.0.rise", "must be a length", "lift_at")),
        ({"valve": {"arm_length": "9 mm"}}, ("out of reach", "9 mm long", "valve.arm_length")),
        (
            {"valve": VALVE, "programme": [*segments()[:1], {**segments("14 deg")[1]}, segments()[2]]},
            ("programme.0.rise", "must be an angle", "another segment has an angle"),
        ),
    ],
)
def test_refusals(changes, words):
    with pytest.raises(InputError) as caught:
        dw.run(spec(**changes), only=("motion",))
    assert all(word in str(caught.value) for word in words), str(caught.value)


def test_a_valve_of_a_slide_is_not_used():
    data = {"motion": "translating", "face": "flat", "prime_radius": "40 mm"}
    given = from_document({"mechanism": "cam", "follower": data, "programme": segments(), "valve": VALVE}, CamSpec)
    assert any("[valve] is not used" in finding for finding in dw.run(given, only=("motion",)).findings)


@pytest.mark.property
def test_jump_speed_names_the_place_where_the_force_vanishes():
    loads = {"load": {"mass": "0.09 kg"}, "spring": {"stiffness": "30 N/mm", "preload": "280 N"}, "drive": {"speed": "340 rad/s"}}
    result = dw.run(spec({"inertia": "1e-5 kg m^2"}, valve=VALVE, **loads), only=("spring", "forces"))
    check = result.check("jump_speed")
    assert not check.ok and check.value == result["spring.jump_speed"] < 340
    degrees = np.degrees(result["spring.jump_speed.at"])
    assert f"leaves the cam at {check.value * 30 / np.pi:.5g} rpm, at cam angle {degrees:.1f}°" in check.message
    assert any("leaves the cam" in finding and "cam angle" in finding for finding in result.findings)
    at_jump = build(spec({"inertia": "1e-5 kg m^2"}, valve=VALVE, **{**loads, "drive": {"speed": f"{check.value} rad/s"}}))
    lowest = at_jump.cycle.minimum(at_jump.required)
    assert lowest.value == pytest.approx(0, abs=1e-6) and lowest.angle == pytest.approx(result["spring.jump_speed.at"], abs=1e-6)


@pytest.mark.property
@pytest.mark.parametrize(
    ("value", "key", "unit"), [("needed_preload", "spring.preload", "N"), ("needed_stiffness", "spring.stiffness", "N/m")]
)
@pytest.mark.parametrize("valve", [{"arm_length": "22 mm", "start_angle": "-45 deg"}, VALVE])
def test_a_spring_at_the_valve_that_just_holds(value, key, unit, valve):
    """With a rocker whose ratio changes a lot over the lift, or is far above 1, and damping: the least force at the cam is zero."""
    loads = {"load": {"mass": "0.09 kg", "damping": "30 N s/m"}, "spring": {"stiffness": "30 N/mm", "preload": "280 N"}}
    given = spec({"inertia": "1e-5 kg m^2"}, valve=valve, drive={"speed": "420 rad/s"}, **loads)
    limit = dw.run(given, only=("spring",))[f"spring.{value}"]
    model = build(given.replace({key: f"{limit!r} {unit}"}))
    assert limit > 0 and model.cycle.minimum(model.required).value == pytest.approx(0, abs=1e-6)


@pytest.mark.property
def test_jump_speed_with_damping_at_the_valve():
    loads = {"load": {"mass": "0.09 kg", "damping": "30 N s/m"}, "spring": {"stiffness": "30 N/mm", "preload": "280 N"}}
    given = spec({"inertia": "1e-5 kg m^2"}, valve={"arm_length": "22 mm", "start_angle": "-45 deg"}, drive={"speed": "420 rad/s"}, **loads)
    found = dw.run(given, only=("spring",))
    model = build(given.replace({"drive.speed": f"{found['spring.jump_speed']!r} rad/s"}))
    lowest = model.cycle.minimum(model.required)
    assert lowest.value == pytest.approx(0, abs=1e-6) and lowest.angle == pytest.approx(found["spring.jump_speed.at"], abs=1e-6)


@pytest.mark.property
@pytest.mark.parametrize("closure", ["groove", "conjugate"])
def test_a_lift_along_the_arm_with_every_closure(closure):
    second = {"conjugate": {"prime_radius": "46 mm"}} if closure == "conjugate" else {}
    tables = {"closure": closure, "drive": {"speed": "60 rad/s"}, "load": {"mass": "0.1 kg"}, **second}
    by_length = dw.run(spec({"lift_at": "arm"}, **tables))
    by_angle = dw.run(spec(programme=segments(f"{LIFT / ARM!r} rad"), **tables))
    extra = {name for name in by_length.values if name.startswith("arm_end.")}
    assert by_length.values.keys() - extra == by_angle.values.keys() and by_length.outcome == "complete"
    for name, value in by_angle.values.items():
        assert by_length[name] == pytest.approx(value.value, rel=1e-6, abs=1e-9 * max(1.0, abs(value.value))), name


@pytest.mark.analytical
def test_wipe_is_counted_from_zero_lift():
    table = dw.run(spec(valve=VALVE), only=("motion",)).tables["valve"]
    assert table["wipe"].data[0] == pytest.approx(0, abs=1e-15)
    swing = swing_by_root(RISE)
    place = int(np.argmax(table["lift"].data))
    assert table["wipe"].data[place] == pytest.approx(TIP * (np.cos(START + swing) - np.cos(START)), rel=1e-9)


@pytest.mark.analytical
@pytest.mark.parametrize("place", ["arm", "tip"])
def test_values_and_columns_of_an_arms_end(place):
    """A lift stated along an arc is in the result as it is stated: the law's published peaks."""
    valve = {"valve": VALVE} if place == "tip" else {}
    result = dw.run(spec({"lift_at": place}, drive={"speed": f"{SPEED} rad/s"}, **valve), only=("motion",))
    assert result["arm_end.lift"] == pytest.approx(LIFT, rel=1e-12)
    assert result["arm_end.max_velocity"] == pytest.approx(2.1875 * LIFT / RISE * SPEED, rel=1e-12)
    assert result["arm_end.max_acceleration"] == pytest.approx(7.5132 * LIFT / (RISE / SPEED) ** 2, rel=1e-5)
    table = result.tables["arm_end"]
    row = int(np.argmin(np.abs(table["angle"].data - 0.3 * RISE)))
    for order, name in enumerate(("lift", "velocity", "acceleration", "jerk")):
        assert table[name].data[row] == pytest.approx(typed_lift(table["angle"].data[row])[order] * SPEED**order, rel=1e-9), name
    assert ("valve.lift" in result.values) == (place == "tip")
