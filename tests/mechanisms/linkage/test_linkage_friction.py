"""Friction of ideal joints, several drives, actuators and motor sizing, as a user states them."""

import numpy as np
import pytest

import drivewright as dw
from drivewright.errors import InputError, SpecError
from drivewright.mechanisms.linkage.build import build
from drivewright.mechanisms.linkage.spec import LinkageSpec
from drivewright.oracles.linkage import independent_check
from drivewright.spec.base import validate_tables

pytestmark = pytest.mark.analytical

G = 9.81
DOWN = ["0 m/s^2", "-9.81 m/s^2"]


def spec_of(bodies, joints, points=None, **tables):
    return validate_tables(
        LinkageSpec,
        {
            "format": 1,
            "mechanism": "linkage",
            "ground": {"points": {"O": ["0 mm", "0 mm"], **(points or {})}},
            "bodies": bodies,
            "joints": joints,
            "outputs": [{"name": "out", "body": next(iter(bodies)), "point": "centroid"}],
            **tables,
        },
    )


def body(mass="2 kg", inertia="0.1 kg m^2", **more):
    return {"mass": mass, "inertia": inertia, "points": {"C": ["0 mm", "0 mm"]}, **more}


def guide(**more):
    return {"name": "guide", "kind": "prismatic", "connects": ["block.C", "ground.O"], "axis": [1, 0], **more}


def block(joint=None, start="1 m/s", duration="1 s", **tables):
    return spec_of(
        {"block": body(velocity=[start, "0 m/s"])}, [guide(**(joint or {}))], gravity=DOWN, simulate={"duration": duration}, **tables
    )


def value(result, name):
    return result.values[name].value


# -- friction ---------------------------------------------------------------------------------------------------------------------


def test_a_block_stops_where_its_energy_is_used_up():
    result = dw.run(block({"friction": 0.2}), only=["end", "friction", "energy"])
    assert value(result, "bodies.block.x") == pytest.approx(1 / (2 * 0.2 * G), abs=2e-5)
    assert value(result, "out.displacement") == pytest.approx(value(result, "bodies.block.x"), rel=1e-12)
    assert value(result, "energy.friction") == pytest.approx(-1.0, rel=1e-6)
    assert value(result, "joints.guide.max_friction") == pytest.approx(0.2 * 2 * G, rel=1e-6)
    told = [text for text in result.findings if "at rest from" in text]
    assert len(told) == 1
    assert "from t = 0.51" in told[0]
    assert "'guide'" in told[0]


def test_friction_of_a_slide_says_that_tilting_is_left_out():
    assert any("bearing_length" in text for text in build(block({"friction": 0.2})).findings)
    assert not build(block({"friction": 0.2, "bearing_length": "100 mm"})).findings


def test_friction_of_a_pin_says_at_which_radius():
    pin = {"name": "pin", "connects": ["block.C", "ground.O"], "friction": 0.1}
    free = spec_of({"block": body(angular_velocity="60 rpm")}, [pin], simulate={"duration": "1 s"})
    assert any("at the default radius of 10 mm" in text for text in build(free).findings)
    given = free.replace({"joints.pin.bearing_radius": "8 mm"})
    assert not build(given).findings


def drawer(mu, load="10 N", push="0.1 m/s", tmp_path=None):
    profile = tmp_path / "push.csv"
    profile.write_text("time [s],travel [mm]\n0,0\n0.25,25\n0.5,50\n1,100\n")
    return spec_of(
        {"block": body("1 kg", points={"C": ["0 mm", "0 mm"], "S": ["0 mm", "100 mm"]}), "pusher": body("0.1 kg", "1e-5 kg m^2")},
        [
            guide(friction=mu, bearing_length="400 mm"),
            {"name": "drive", "kind": "prismatic", "connects": ["pusher.C", "ground.P"], "axis": [1, 0]},
            {"name": "slot", "kind": "pin-slot", "connects": ["pusher.C", "block.S"], "axis": [0, 1]},
        ],
        {"P": ["0 mm", "100 mm"]},
        forces=[{"body": "block", "force": [f"-{load}", "0 N"]}],
        drive={"joint": "drive", "profile": str(profile), "ends": "free"},
        simulate={"duration": "1 s"},
    )


def test_efficiency_of_a_drawer(tmp_path):
    """1 - 2 mu a/L of the work goes into the load."""
    result = dw.run(drawer(0.3, tmp_path=tmp_path), only=["friction", "motors", "energy"])
    assert value(result, "efficiency") == pytest.approx(1 - 2 * 0.3 * 0.1 / 0.4, rel=1e-6)
    assert value(result, "drives.drive.peak_force") == pytest.approx(10 / 0.85, rel=1e-6)
    assert value(result, "drive.max_force") == pytest.approx(10 / 0.85, rel=1e-6)
    assert value(result, "drives.drive.mean_power") == pytest.approx(10 / 0.85 * 0.1, rel=1e-6)
    assert value(result, "drives.drive.reflected_mass") == pytest.approx(1.1, rel=1e-9)


def test_a_drawer_that_locks_is_told_with_pose_and_joint(tmp_path):
    result = dw.run(drawer(2.5, tmp_path=tmp_path), only=["friction"])
    told = " ".join(result.findings)
    assert "friction locks the mechanism at t = 0 s, drive 'drive' at 0 mm: joint 'guide' is self-locking" in told
    assert "up to 80 %" in told


@pytest.mark.parametrize(("mu", "holds"), [(0.2, 0.0), (0.8, 1.0)])
def test_a_wedge_below_its_angle_of_friction_holds_its_load(mu, holds, tmp_path):
    """Lowered by a pin in a slot of 35 degrees: tan = 0.70; beyond, the drive has to push where without friction it would brake."""
    profile = tmp_path / "down.csv"
    profile.write_text("time [s],travel [mm]\n0,0\n0.25,25\n0.5,50\n1,100\n")
    angle = np.radians(35.0)
    wedge = spec_of(
        {"block": body("1 kg"), "pin": body("0.1 kg", "1e-5 kg m^2")},
        [
            {"name": "up", "kind": "prismatic", "connects": ["block.C", "ground.O"], "axis": [0, 1]},
            {"name": "drive", "kind": "prismatic", "connects": ["pin.C", "ground.O"], "axis": [1, 0]},
            {
                "name": "slot",
                "kind": "pin-slot",
                "connects": ["pin.C", "block.C"],
                "axis": [float(np.cos(angle)), float(np.sin(angle))],
                "friction": mu,
            },
        ],
        forces=[{"body": "block", "force": ["0 N", "-50 N"]}],
        drive={"joint": "drive", "profile": str(profile), "ends": "free"},
        simulate={"duration": "1 s"},
    )
    result = dw.run(wedge, only=["friction"])
    assert value(result, "friction.self_locking_share") == pytest.approx(holds, abs=1e-6)


def wheel(**joint):
    slope = np.radians(20.0)
    axis = [float(np.cos(slope)), float(np.sin(slope))]
    return spec_of(
        {"wheel": body("3 kg", "0.02 kg m^2")},
        [{"name": "track", "kind": "rolling", "connects": ["wheel.C", "ground.P"], "radius": "100 mm", "axis": axis, **joint}],
        {"P": [f"{100 * np.sin(slope)} mm", f"{-100 * np.cos(slope)} mm"]},
        gravity=DOWN,
        simulate={"duration": "0.5 s"},
    )


@pytest.mark.parametrize(("mu", "grips"), [(0.2, True), (0.1, False)])
def test_a_wheel_that_would_slip_fails_its_check(mu, grips):
    """T/N = tan(slope) J/(J + m R^2) = 0.1456."""
    result = dw.run(wheel(friction=mu), only=["friction"])
    check = next(check for check in result.checks if check.name == "grip.track")
    assert check.value == pytest.approx(np.tan(np.radians(20.0)) * 0.02 / 0.05, rel=1e-6)
    assert check.ok is grips
    assert "the wheel slips" in check.message


# -- drives ---------------------------------------------------------------------------------------------------------------------------


def motor(tmp_path, text, name="motor.csv"):
    path = tmp_path / name
    path.write_text(text)
    return str(path)


def test_an_actuator_runs_up_along_its_line(tmp_path):
    """m v' = F0 (1 - v/v0)."""
    file = motor(tmp_path, "velocity [m/s],force [N]\n-1,60\n0,40\n2,0\n4,-40\n")
    spec = block(start="0 m/s", drive={"joint": "guide", "motor": file}, duration="0.4 s")
    result = dw.run(spec, only=["end", "motors"])
    assert value(result, "bodies.block.vx") == pytest.approx(2 * (1 - np.exp(-0.4 * 40 / 2 / 2)), rel=1e-7)
    assert value(result, "drives.guide.peak_force") == pytest.approx(40.0, rel=1e-9)
    assert value(result, "drives.guide.peak_power") == pytest.approx(40 * 0.5 * 1.0, rel=1e-3)


def test_an_actuator_over_its_travel_is_a_spring(tmp_path):
    file = motor(tmp_path, "travel [mm],force [N]\n-1000,800\n1000,-800\n")
    result = dw.run(block(drive={"joint": "guide", "motor": file}, duration="0.3 s"), only=["end"])
    assert value(result, "bodies.block.x") == pytest.approx(np.sin(20 * 0.3) / 20, rel=1e-6)


def two_sliders(tmp_path, first, second):
    """Two sliders at right angles on one block each, nothing between: two drives."""
    return spec_of(
        {"block": body(), "other": body()},
        [guide(), {"name": "lift", "kind": "prismatic", "connects": ["other.C", "block.C"], "axis": [0, 1]}],
        drive={"joint": "guide", **first},
        drives=[{"joint": "lift", **second}],
        simulate={"duration": "1 s"},
    )


def test_two_drives_each_with_its_profile_and_delay(tmp_path):
    file = motor(tmp_path, "time [s],travel [mm]\n0,0\n0.1,20\n0.2,40\n0.3,60\n", "profile.csv")
    result = dw.run(two_sliders(tmp_path, {"profile": file}, {"profile": file, "delay": "0.5 s"}), only=["end", "motors", "energy"])
    assert value(result, "bodies.other.x") == pytest.approx(0.06, rel=1e-9)
    assert value(result, "bodies.other.y") == pytest.approx(0.06, rel=1e-9)
    assert value(result, "drives.guide.reflected_mass") == pytest.approx(4.0, rel=1e-9)
    assert value(result, "drives.lift.reflected_mass") == pytest.approx(2.0, rel=1e-9)
    early = dw.run(
        two_sliders(tmp_path, {"profile": file}, {"profile": file, "delay": "0.5 s"}).replace({"simulate.duration": "0.4 s"}), only=["end"]
    )
    assert value(early, "bodies.other.y") == pytest.approx(0.0, abs=1e-12)


def four_bar(**drives):
    bodies = {
        "crank": body("1 kg", points={"A": ["0 mm", "0 mm"], "B": ["50 mm", "0 mm"]}, angle="40 deg"),
        "coupler": body("1 kg", points={"B": ["0 mm", "0 mm"], "D": ["150 mm", "0 mm"]}, angle="20 deg"),
        "rocker": body("1 kg", points={"E": ["0 mm", "0 mm"], "D": ["120 mm", "0 mm"]}, angle="80 deg"),
    }
    joints = [
        {"name": "A", "connects": ["ground.O", "crank.A"]},
        {"name": "B", "connects": ["crank.B", "coupler.B"]},
        {"name": "D", "connects": ["coupler.D", "rocker.D"]},
        {"name": "E", "connects": ["ground.E", "rocker.E"]},
    ]
    return spec_of(bodies, joints, {"E": ["170 mm", "0 mm"]}, simulate={"duration": "0.1 s"}, **drives)


@pytest.mark.error
def test_drives_that_fight_name_both():
    spec = four_bar(drive={"joint": "A", "speed": "60 rpm"}, drives=[{"joint": "E", "speed": "30 rpm"}])
    with pytest.raises(InputError) as error:
        build(spec)
    assert "the drives of joints 'A' and 'E' conflict at the start: with 'A' at the start of its drive, joint 'E' is" in str(error.value)
    pin = 50 * np.array([np.cos(np.radians(40)), np.sin(np.radians(40))]) - [170, 0]  # of the crank from E
    reach = np.hypot(*pin)
    angle = np.arctan2(pin[1], pin[0]) - np.arccos((120**2 + reach**2 - 150**2) / (2 * 120 * reach))
    spec = spec.replace({"bodies.rocker.angle": f"{float(angle)!r} rad"})
    with pytest.raises(InputError) as error:
        build(spec)
    assert "the drives of joints 'A' and 'E' conflict: the loop through joint" in str(error.value)


@pytest.mark.error
def test_a_motor_beside_a_drive_does_not_fight(tmp_path):
    file = motor(tmp_path, "speed [rpm],torque [N m]\n-100,2\n100,2\n")
    spec = four_bar(drive={"joint": "A", "speed": "60 rpm"}, drives=[{"joint": "E", "motor": file}])
    result = dw.run(spec, only=["motors", "energy"])
    assert value(result, "drives.E.rms_torque") == pytest.approx(2.0, rel=1e-9)
    assert value(result, "drives.A.mean_power") == pytest.approx(-value(result, "drives.E.mean_power"), abs=30.0)


@pytest.mark.error
@pytest.mark.parametrize(
    ("drives", "key", "words"),
    [
        (
            {"drives": [{"joint": "A", "speed": "60 rpm"}, {"joint": "A", "speed": "30 rpm"}]},
            "drives.1.joint",
            "drives.0 already drives joint 'A'",
        ),
        (
            {"drive": {"joint": "A", "speed": "60 rpm"}, "drives": [{"joint": "A", "speed": "30 rpm"}]},
            "drives.0.joint",
            "[drive] already drives joint",
        ),
        ({"drives": [{"joint": "X", "speed": "60 rpm"}]}, "drives.0.joint", "no joint is called 'X'"),
        ({"drives": [{"joint": "A"}]}, "drives.0.speed", "give exactly one of speed, profile and motor"),
        ({"drives": [{"joint": "A", "speed": "60 rpm", "delay": "1 s"}]}, "drives.0.delay", "applies to a drive with a profile"),
    ],
)
def test_drives_that_have_no_meaning(drives, key, words):
    with pytest.raises(SpecError) as error:
        four_bar(**drives)
    assert error.value.key == key
    assert words in str(error.value)


def test_a_drive_begins_at_its_phase():
    result = dw.run(four_bar(drive={"joint": "A", "speed": "-60 rpm", "phase": "90 deg"}), only=["end"])
    assert value(result, "bodies.crank.angle") == pytest.approx(np.radians(40 + 90 - 36.0), rel=1e-9)


def test_drives_in_a_list_are_the_drive():
    """One drive stated as `[drive]` and as the first of `[[drives]]`."""
    one = dw.run(four_bar(drive={"joint": "A", "speed": "60 rpm"}), only=["energy", "motors"])
    two = dw.run(four_bar(drives=[{"joint": "A", "speed": "60 rpm"}]), only=["energy", "motors"])
    assert one.values.keys() == two.values.keys()
    for name in one.values:
        assert value(two, name) == value(one, name)


def test_the_pin_of_a_slot_is_driven_along_it(tmp_path):
    """A crank in a slotted arm, driven along the slot: the circle about O and the place on the arm give both angles."""
    file = motor(tmp_path, "time [s],travel [mm]\n0,100\n0.25,105\n0.5,110\n1,120\n", "slot.csv")
    bodies = {
        "arm": body("1 kg", points={"O": ["0 mm", "0 mm"]}, angle="20 deg"),
        "crank": body("1 kg", points={"Q": ["0 mm", "0 mm"], "P": ["60 mm", "0 mm"]}, angle="60 deg"),
    }
    joints = [
        {"name": "O", "connects": ["ground.O", "arm.O"]},
        {"name": "Q", "connects": ["ground.Q", "crank.Q"]},
        {"name": "slot", "kind": "pin-slot", "connects": ["crank.P", "arm.O"], "axis": [1, 0]},
    ]
    spec = spec_of(
        bodies, joints, {"Q": ["80 mm", "0 mm"]}, drive={"joint": "slot", "profile": file, "ends": "free"}, simulate={"duration": "1 s"}
    )
    result = dw.run(spec, only=["end", "energy", "motors"])
    cosine = (0.08**2 + 0.12**2 - 0.06**2) / (2 * 0.08 * 0.12)
    assert value(result, "bodies.arm.angle") == pytest.approx(np.arccos(cosine), rel=1e-9)
    assert result.values["drives.slot.peak_force"].unit == "N"


# -- second routes -------------------------------------------------------------------------------------------------------------------


def test_verify_finds_the_friction_by_the_bodies_equations(tmp_path):
    """Of a drawer: slide and slot; of a wheel: its resistance."""
    rubbing = drawer(0.3, tmp_path=tmp_path).replace({"joints.slot.friction": 0.1})
    for spec, count in ((rubbing, 2), (wheel(friction=0.4, rolling_resistance="1 mm"), 1)):
        model = build(spec)
        rows = [row for row in independent_check.verify(model, None) if row[0].startswith("friction in")]
        assert len(rows) == count
        for _, ours, other, _, allowed, _ in rows:
            assert ours == pytest.approx(other, abs=allowed)
            assert other > 0


def slider_crank(**wrist):
    """Crank 50 mm, rod 150 mm, at 300 rpm."""
    return spec_of(
        {
            "crank": {"mass": "0.5 kg", "inertia": "1e-3 kg m^2", "points": {"O": ["0 mm", "0 mm"], "A": ["50 mm", "0 mm"]}},
            "rod": {
                "mass": "0.3 kg",
                "inertia": "6e-4 kg m^2",
                "centroid": ["75 mm", "0 mm"],
                "points": {"A": ["0 mm", "0 mm"], "B": ["150 mm", "0 mm"]},
                "angle": "-15 deg",
            },
            "slider": {"mass": "1 kg", "inertia": "1e-3 kg m^2", "points": {"B": ["0 mm", "0 mm"]}},
        },
        [
            {"name": "main", "connects": ["ground.O", "crank.O"]},
            {"name": "pin", "connects": ["crank.A", "rod.A"]},
            {"name": "wrist", "connects": ["rod.B", "slider.B"], **wrist},
            {"name": "guide", "kind": "prismatic", "connects": ["slider.B", "ground.O"], "axis": [1, 0]},
        ],
        drive={"joint": "main", "speed": "300 rpm"},
        simulate={"turns": 2, "discard": 1},
    )


def test_reflected_inertia_is_its_mean_over_time_and_does_not_go_by_play():
    """Twice the kinetic energy over the speed squared, on an even grid of the crank's angle."""
    angle = np.linspace(0, 2 * np.pi, 7201)
    tilt = np.arcsin(np.sin(angle) / 3)
    rod_rate = np.cos(angle) / 3 / np.cos(tilt)  # against the crank's sense
    slider = -0.05 * np.sin(angle) - 0.15 * np.sin(tilt) * rod_rate
    middle = np.array([-0.05 * np.sin(angle) - 0.075 * np.sin(tilt) * rod_rate, 0.05 * np.cos(angle) - 0.075 * np.cos(tilt) * rod_rate])
    inertia = 1e-3 + 0.3 * np.sum(middle**2, axis=0) + 6e-4 * rod_rate**2 + slider**2
    for wrist in ({}, {"model": "dry", "clearance": "0.1 mm", "bearing_radius": "10 mm", "bearing_length": "15 mm"}):
        result = dw.run(slider_crank(**wrist), only=["motors"])
        assert value(result, "drives.main.reflected_inertia") == pytest.approx(np.mean(inertia[:-1]), rel=2e-3)
        assert value(result, "drives.main.max_reflected_inertia") == pytest.approx(np.max(inertia), rel=3e-3)


def test_a_pin_that_slides_slowly_says_that_its_friction_is_smoothed_away():
    pin = {"model": "dry", "clearance": "0.1 mm", "bearing_radius": "10 mm", "bearing_length": "15 mm", "friction": 0.1}

    def told(**more):
        found = dw.run(slider_crank(**pin, **more), only=["pins"])
        return [text for text in found.findings if "friction_speed" in text]

    (text,) = told(friction_speed="200 mm/s")
    assert "joint 'wrist' slides too slowly" in text and "not 0.1" in text and "200 mm/s" in text
    assert not told(friction_speed="1 mm/s")


# -- what is said of odd input --------------------------------------------------------------------------------------------------


def findings_of(spec):
    return build(spec).findings


def test_a_velocity_that_the_joints_do_not_allow_is_said():
    (text,) = [text for text in findings_of(spec_of({"block": body(velocity=["1 m/s", "2 m/s"])}, [guide()])) if "cannot start" in text]
    assert text == "body 'block' cannot start with the velocity (1000, 2000) mm/s: joints and drives allow (1000, 0) mm/s"
    (text,) = [text for text in findings_of(spec_of({"block": body(angular_velocity="60 rpm")}, [guide()])) if "cannot start" in text]
    assert "angular velocity 6.283 rad/s" in text and "allow 0 rad/s" in text
    assert not any("cannot start" in text for text in findings_of(block()))


def test_a_body_that_can_move_without_mass_is_refused():
    with pytest.raises(InputError, match="body 'block' can move with neither mass nor inertia"):
        build(spec_of({"block": body(mass="0 kg")}, [guide()]))


def test_static_friction_below_that_of_sliding_is_said():
    assert any(
        "static_friction 0.1 is below friction 0.2" in text for text in findings_of(block({"friction": 0.2, "static_friction": 0.1}))
    )
    assert not any("is below" in text for text in findings_of(block({"friction": 0.2, "static_friction": 0.2})))


def test_gears_beside_pins_that_rub_say_that_their_teeth_press_none():
    bodies = {"one": body(), "two": body()}
    joints = [
        {"name": "in", "connects": ["ground.O", "one.C"], "friction": 0.1, "bearing_radius": "10 mm"},
        {"name": "out", "connects": ["ground.Q", "two.C"]},
        {"name": "mesh", "kind": "gear", "connects": ["one", "two"], "ratio": -0.5},
    ]
    found = findings_of(spec_of(bodies, joints, {"Q": ["100 mm", "0 mm"]}))
    assert any("joints of kind gear ('mesh') transmit torque only" in text for text in found)
    joints[0] = {key: value for key, value in joints[0].items() if key != "friction"}
    assert not any("of kind gear" in text for text in findings_of(spec_of(bodies, joints, {"Q": ["100 mm", "0 mm"]})))


def test_the_share_of_sticking_goes_from_event_to_event():
    """The block slides for v/(mu g) of its second."""
    result = dw.run(block({"friction": 0.2}), only=["friction"])
    assert value(result, "joints.guide.stick_share") == pytest.approx(1 - 1 / (0.2 * G), abs=2e-6)


@pytest.mark.parametrize(("length", "words"), [("70 mm", "The mechanism is self-locking"), (None, "raise the motor torque or the load")])
def test_what_stands_still_says_what_would_move_it(length, words):
    """A block pushed 200 mm beside a guide of 70 mm, mu = 0.2, locks under any force; one pushed in its line only by a small one."""
    joint = {"friction": 0.2} | ({"bearing_length": length} if length else {})
    arm = ["0 mm", "200 mm"] if length else ["0 mm", "0 mm"]
    bodies = {"block": body() | {"points": {"C": ["0 mm", "0 mm"], "H": arm}}}
    spec = spec_of(
        bodies,
        [guide(**joint)],
        gravity=["0 m/s^2", "0 m/s^2"] if length else DOWN,
        forces=[{"body": "block", "point": "H", "force": ["2 N", "0 N"]}],
        simulate={"duration": "0.1 s"},
    )
    (text,) = [text for text in dw.run(spec, only=["friction"]).findings if "at rest from" in text]
    assert words in text


def test_turns_of_a_mechanism_without_play_need_be_no_more_than_one():
    check = next(check for check in dw.run(slider_crank(), only=["motion"]).checks if check.name == "window")
    assert (check.value, check.limit, check.ok) == (1.0, 1.0, True)


def test_the_displacement_of_a_point_is_the_chord_of_its_way():
    """A free rotor, its point 80 mm beside the axis and 110 mm from its centroid."""
    rotor = body(angular_velocity="30 rpm", centroid=["-30 mm", "0 mm"]) | {"points": {"C": ["0 mm", "0 mm"], "P": ["80 mm", "0 mm"]}}
    spec = spec_of(
        {"rotor": rotor},
        [{"name": "axle", "connects": ["ground.O", "rotor.C"]}],
        outputs=[{"name": "tip", "body": "rotor", "point": "P"}],
        simulate={"duration": "0.4 s"},
    )
    assert value(dw.run(spec, only=["end"]), "tip.displacement") == pytest.approx(0.16 * np.sin(0.5 * np.pi * 0.4), rel=1e-7)


def test_a_mechanism_without_a_load_has_no_efficiency_and_says_so():
    spec = slider_crank(friction=0.1, bearing_radius="10 mm")
    result = dw.run(spec, only=["friction"])
    assert "efficiency" not in result.values and any("there is no efficiency" in text for text in result.findings)


def test_the_equilibrium_says_that_it_leaves_friction_out():
    found = dw.run(block({"friction": 0.2}, start="0 m/s").replace({"gravity": ["0 m/s^2", "0 m/s^2"]}), only=["rest"])
    assert any("friction in ideal joints is left out" in text for text in found.findings)
