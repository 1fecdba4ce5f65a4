"""The kind `cam` against formulas typed independently in polar form, searched with scipy."""

import numpy as np
import pytest
from places import EXAMPLES
from scipy.optimize import minimize_scalar

import drivewright as dw
from drivewright import registry
from drivewright.mechanisms.cam.spec import CamSpec
from drivewright.spec import from_document

pytestmark = pytest.mark.analytical

TURN = 2 * np.pi


def document(follower, segments, **tables):
    return {
        "mechanism": "cam",
        "follower": {"motion": "translating", **follower},
        "programme": [dict(zip(("angle", "law", "rise"), row, strict=False)) for row in segments],
        **tables,
    }


def run(follower, segments, only=("motion", "geometry", "profile"), **tables):
    return dw.run(from_document(document(follower, segments, **tables), CamSpec), only=only)


SEGMENTS = [("90 deg", "cycloidal", "20 mm"), ("180 deg", "cycloidal", "-20 mm"), ("90 deg", "dwell")]
ROLLER = {"face": "roller", "roller_radius": "8 mm", "prime_radius": "40 mm"}
SWINGS = [("90 deg", "cycloidal", "18 deg"), ("180 deg", "cycloidal", "-18 deg"), ("90 deg", "dwell")]
LEVER = {**ROLLER, "motion": "oscillating", "pivot_distance": "80 mm", "arm_length": "60 mm"}


def lift(theta, rise):
    """(s, s', s'') of the cycloidal rise and return, typed out."""
    up, down = theta / (np.pi / 2), (theta - np.pi / 2) / np.pi
    if theta <= np.pi / 2:
        return _cycloid(up, rise, np.pi / 2)
    if theta <= 3 * np.pi / 2:
        s, v, a = _cycloid(down, rise, np.pi)
        return rise - s, -v, -a
    return 0.0, 0.0, 0.0


def _cycloid(u, rise, width):
    p = TURN * u
    return rise * (u - np.sin(p) / TURN), rise / width * (1 - np.cos(p)), rise / width**2 * TURN * np.sin(p)


def search(function, low, high):
    """(greatest value, place) by a dense scan and Brent's method."""
    grid = np.linspace(low, high, 2001)
    k = int(np.argmax([function(x) for x in grid]))
    bounds = (grid[max(k - 1, 0)], grid[min(k + 1, 2000)])
    found = minimize_scalar(lambda x: -function(x), bounds=bounds, method="bounded", options={"xatol": 1e-12})
    return -found.fun, found.x


@pytest.mark.parametrize("offset", [0.0, 0.006, -0.004, 0.014])
def test_pressure_angle_of_a_slide(offset):
    result = run({**ROLLER, "offset": f"{1e3 * offset} mm"}, SEGMENTS)

    def alpha(theta):
        s, v, _ = lift(theta, 0.02)
        return np.arctan((v - offset) / (s + np.sqrt(0.04**2 - offset**2)))

    value, at = search(alpha, 0, np.pi / 2)
    assert result["max_pressure_angle"] == pytest.approx(value, abs=1e-12)
    assert result["max_pressure_angle.at"] == pytest.approx(at, abs=1e-6)
    value, at = search(lambda t: -alpha(t), 0, 3 * np.pi / 2)
    assert result["min_pressure_angle"] == pytest.approx(-value, abs=1e-12)
    assert result["min_pressure_angle.at"] == pytest.approx(at, abs=1e-6)
    steepest = max(result["max_pressure_angle"], -result["min_pressure_angle"])
    assert result.check("pressure_angle").value == steepest


def test_curvature_of_a_slide():
    result = run(ROLLER, SEGMENTS)

    def kappa(theta):
        s, v, a = lift(theta, 0.02)
        r = s + 0.04
        return (r**2 + 2 * v**2 - r * a) / (r**2 + v**2) ** 1.5

    value, at = search(kappa, 0, np.pi / 2)
    assert result["min_convex_radius"] == pytest.approx(1 / value, rel=1e-12)
    assert result["min_convex_radius.at"] == pytest.approx(at, abs=1e-5)
    value, at = search(lambda t: -kappa(t), 0, np.pi / 2)
    assert result["min_concave_radius"] == pytest.approx(1 / value, rel=1e-9)
    assert result.check("undercut").value == pytest.approx(result["min_convex_radius"] / 0.008, rel=1e-14)
    assert result.check("cutter").value == pytest.approx(result["min_concave_radius"] + 0.008, rel=1e-12)
    assert result["profile.min_convex_radius"] == pytest.approx(result["min_convex_radius"] - 0.008, rel=1e-12)
    assert result["profile.min_concave_radius"] == pytest.approx(result["min_concave_radius"] + 0.008, rel=1e-12)


@pytest.mark.parametrize(("rotation", "sense"), [("counter-clockwise", 1), ("clockwise", -1)])
def test_pressure_angle_of_a_lever(rotation, sense):
    result = run(LEVER, SWINGS, rotation=rotation)
    psi0 = np.arccos((0.06**2 + 0.08**2 - 0.04**2) / (2 * 0.06 * 0.08))

    def alpha(theta):
        swing, f, _ = lift(theta, np.radians(18))
        psi = psi0 + swing
        return np.arctan(sense * (0.06 * (1 + sense * f) - 0.08 * np.cos(psi)) / (0.08 * np.sin(psi)))

    for name, sign in (("max", 1), ("min", -1)):
        value, at = search(lambda t, sign=sign: sign * alpha(t), 0, 3 * np.pi / 2)
        assert sign * result[f"{name}_pressure_angle"] == pytest.approx(value, abs=1e-12)
        assert result[f"{name}_pressure_angle.at"] == pytest.approx(at, abs=1e-6)
    steepest = search(lambda t: abs(alpha(t)), np.pi / 2, 3 * np.pi / 2)[0]
    assert result["max_pressure_angle.return"] == pytest.approx(steepest, abs=1e-12)


@pytest.mark.parametrize("place", ["top", "follower", "drive"])
def test_rotation_may_stand_beside_what_turns(place):
    data = document(LEVER, SWINGS, drive={"speed": "60 rpm"})
    (data if place == "top" else data[place])["rotation"] = "clockwise"
    assert from_document(data, CamSpec).rotation == "clockwise"


@pytest.mark.parametrize("key", ["prime_radius", "base_radius"])
def test_flat_face(key):
    result = run({"face": "flat", key: "40 mm"}, SEGMENTS)
    least, at = search(lambda t: -sum(lift(t, 0.02)[::2]), 0, np.pi / 2)
    assert result["min_base_radius"] == pytest.approx(max(0.0, least), rel=1e-12)
    assert result["min_half_face"] == pytest.approx(0.02 / (np.pi / 2) * 2, rel=1e-12)
    assert result["min_convex_radius"] == pytest.approx(0.04 - least, rel=1e-12)
    assert result["min_convex_radius.at"] == pytest.approx(at, abs=1e-6)
    assert result.check("undercut").ok
    assert (result["max_pressure_angle"], result["min_pressure_angle"]) == (0, 0)
    assert (result["max_pressure_angle.at"], result["face.end"]) == (0, result["min_half_face"])


@pytest.mark.parametrize(
    ("face", "same"),
    [
        (
            {"face": "shoe", "face_radius": "12 mm", "prime_radius": "50 mm", "offset": "3 mm", "face_offset": "2 mm"},
            {"face": "roller", "roller_radius": "12 mm", "prime_radius": "50 mm", "offset": "5 mm"},
        ),
        ({**ROLLER}, {"face": "roller", "roller_radius": "8 mm", "base_radius": "32 mm"}),
    ],
)
def test_the_same_slide_said_otherwise(face, same):
    one, other = run(face, SEGMENTS), run(same, SEGMENTS)
    assert {name: value.value for name, value in one.values.items()} == {name: value.value for name, value in other.values.items()}


def test_shoe_on_a_lever_sits_beside_its_arm():
    """An arc whose centre is 11 mm off the arm is a roller on the straight line from the pivot."""
    shoe = run({**LEVER, "face": "shoe", "face_radius": "8 mm", "face_offset": "11 mm"}, SWINGS)
    straight = run({**LEVER, "arm_length": f"{float(np.hypot(60, 11))!r} mm"}, SWINGS)
    for name in ("max_pressure_angle", "min_pressure_angle", "min_convex_radius", "profile.area"):
        assert shoe[name] == pytest.approx(straight[name], rel=1e-12)


def test_walls_of_the_blank():
    result = run(ROLLER, SEGMENTS, manufacture={"bore": "18 mm", "hub_diameter": "30 mm"})
    assert result["profile.min_radius"] == pytest.approx(0.032, rel=1e-14)
    assert result["profile.max_radius"] == pytest.approx(0.052, rel=1e-14)
    walls = [result.check(name).value for name in ("bore_wall", "hub_wall", "hub_clearance")]
    assert walls == pytest.approx([0.032 - 0.009, 0.015 - 0.009, 0.032 - 0.015], rel=1e-12)


def test_flat_face_that_is_undercut_is_computed_in_full():
    segments = [("40 deg", "cycloidal", "20 mm"), ("90 deg", "cycloidal", "-20 mm"), ("230 deg", "dwell")]
    result = run({"face": "flat", "prime_radius": "50 mm"}, segments)
    check = result.check("undercut")
    assert not check.ok
    assert check.value == pytest.approx(0.05 - result["min_base_radius"], rel=1e-12)
    assert "min_convex_radius" not in result.values
    assert any("min_convex_radius is absent" in finding for finding in result.findings)
    assert result["lost_motion"] > 1e-3
    assert not result.check("lost_motion").ok
    rows = len(result.tables["inspection"]["angle"].data)
    assert 200 < rows < 360


def test_roller_that_undercuts_is_computed_in_full():
    segments = [("50 deg", "cycloidal", "20 mm"), ("90 deg", "cycloidal", "-20 mm"), ("220 deg", "dwell")]
    tables = {"drive": {"speed": "60 rpm"}, "load": {"mass": "1 kg"}, "spring": {"preload": "90 N"}}
    result = run({"face": "roller", "roller_radius": "18 mm", "prime_radius": "40 mm"}, segments, (), **tables)
    assert not result.check("undercut").ok
    assert result["min_convex_radius"] < 0.018
    assert result["lost_motion"] > 0
    assert "max_contact_pressure" not in result.values
    assert any("max_contact_pressure is absent: the profile is undercut" in finding for finding in result.findings)
    assert result["max_contact_force"] > 0


def test_table_driven_lift_follows_its_rows(tmp_path):
    angle = np.arange(0, 361, 5.0)
    rows = 8 - 8 * np.cos(np.radians(angle))
    (tmp_path / "lift.csv").write_text("angle [deg],lift [mm]\n" + "\n".join(f"{a},{s:.12f}" for a, s in zip(angle, rows, strict=True)))
    data = document({"face": "flat", "base_radius": "30 mm"}, [])
    data["programme"] = [{"angle": "360 deg", "law": "table", "file": "lift.csv"}]
    result = dw.run(from_document(data, CamSpec, folder=tmp_path), only=("geometry", "profile"))
    assert result["min_half_face"] == pytest.approx(0.008, rel=1e-6)
    assert result["profile.area"] == pytest.approx(np.pi * 0.038**2, rel=1e-6)
    assert result["min_convex_radius"] == pytest.approx(0.038, rel=1e-4)


def test_jumps_of_the_parabolic_law():
    segments = [("120 deg", "parabolic", "10 mm"), ("120 deg", "parabolic", "-10 mm"), ("120 deg", "dwell")]
    result = run(ROLLER, segments, drive={"speed": "60 rpm"})
    assert result.check("continuity.velocity").ok
    # In the middle of the rise the acceleration jumps from its peak to the opposite one.
    assert result.check("continuity.acceleration").value == pytest.approx(2.0, rel=1e-12)
    assert not result.check("continuity.acceleration").ok
    assert any("jerk is infinite" in finding for finding in result.findings)
    assert result["max_acceleration"] == pytest.approx(4 * 0.01 / (2 * np.pi / 3) ** 2 * TURN**2, rel=1e-12)


LOADED = {"drive": {"speed": "300 rpm"}, "load": {"mass": "0.5 kg", "force": "20 N"}, "spring": {"stiffness": "5 N/mm", "preload": "60 N"}}


def test_forces_of_a_slide():
    result = run(ROLLER, SEGMENTS, (), face={"width": "12 mm"}, **LOADED)
    speed = 10 * np.pi

    def force(theta):
        s, v, a = lift(theta, 0.02)
        return 0.5 * speed**2 * a + 5000 * s + 80, v, np.arctan(v / (0.04 + s))

    assert result["min_required_force"] == pytest.approx(-search(lambda t: -force(t)[0], 0, TURN)[0], rel=1e-9)
    assert result["max_torque"] == pytest.approx(search(lambda t: force(t)[0] * force(t)[1], 0, np.pi / 2)[0], rel=1e-9)
    assert result["max_contact_force"] == pytest.approx(search(lambda t: force(t)[0] / np.cos(force(t)[2]), 0, TURN)[0], rel=1e-9)
    table, modulus = result.tables["pressure"], 210e9 / (2 * (1 - 0.3**2))

    def pressure(theta):
        s, v, a = lift(theta, 0.02)
        r = s + 0.04
        rho = (r**2 + v**2) ** 1.5 / (r**2 + 2 * v**2 - r * a) - 0.008
        return np.sqrt(force(theta)[0] / np.cos(force(theta)[2]) * modulus * (1 / 0.008 + 1 / rho) / (np.pi * 0.012))

    assert result["max_contact_pressure"] == pytest.approx(search(pressure, 0, TURN)[0], rel=1e-9)
    k = 100
    assert table["contact_pressure"].data[k] == pytest.approx(pressure(table["angle"].data[k]), rel=1e-9)


def test_roller_turns_by_rolling():
    """In a dwell the roller turns at w * base radius / roller radius against its pin."""
    result = run(ROLLER, [("180 deg", "dwell"), ("180 deg", "dwell")], (), **LOADED)
    assert result["max_roller_speed"] == pytest.approx(10 * np.pi * 0.032 / 0.008, rel=1e-12)
    assert result.tables["contact"]["rolling_speed"].data[3] == pytest.approx(10 * np.pi * 0.032, rel=1e-12)


def test_flat_face_slides_at_its_height():
    result = run({"face": "flat", "base_radius": "40 mm"}, SEGMENTS, (), **LOADED)
    assert result["max_sliding_speed"] == pytest.approx(10 * np.pi * 0.06, rel=1e-12)


def test_conjugate_pair_shares_the_force():
    pair = {"closure": "conjugate", "conjugate": {"prime_radius": "60 mm"}}
    result = run(LEVER, SWINGS, (), **pair, drive={"speed": "600 rpm"}, load={"mass": "1 kg"})
    first, second = result.tables["contact"], result.tables["contact.conjugate"]
    assert np.all((first["contact_force"].data == 0) | (second["contact_force"].data == 0))
    assert result["crossovers"] == 2
    assert result["conjugate.max_contact_force"] > 0
    # Required force along the travel from either surface: N cos(alpha), to opposite sides.
    net = first["contact_force"].data * np.cos(result.tables["geometry"]["pressure_angle"].data) - second["contact_force"].data * np.cos(
        result.tables["geometry.conjugate"]["pressure_angle"].data
    )
    assert np.allclose(net, result.tables["load"]["required_force"].data, atol=1e-9)


def test_groove_shares_the_force_between_its_walls():
    groove = {"closure": "groove", "groove": {"clearance": "0.05 mm"}}
    result = run(ROLLER, SEGMENTS, (), **groove, drive={"speed": "600 rpm"}, load={"mass": "1 kg"})
    inner, outer = (result.tables[name]["contact_force"].data for name in ("contact", "contact.outer"))
    alpha = result.tables["geometry"]["pressure_angle"].data
    assert np.allclose((inner - outer) * np.cos(alpha), result.tables["load"]["required_force"].data, atol=1e-9)
    assert result["groove.play"] == pytest.approx(5e-5 / np.cos(result["max_pressure_angle"]), rel=1e-12)
    assert result["outer.min_convex_radius"] == result["min_convex_radius"]
    assert result.check("undercut.outer").value == pytest.approx(result["min_concave_radius"] / 0.008, rel=1e-12)
    assert result.check("cutter").limit == pytest.approx(0.01605, rel=1e-12)


def test_yoke():
    segments = [("150 deg", "modified-sine", "24 mm"), ("30 deg", "dwell"), ("150 deg", "modified-sine", "-24 mm"), ("30 deg", "dwell")]
    result = run({"face": "flat", "prime_radius": "42 mm"}, segments, (), closure="yoke", drive={"speed": "300 rpm"}, load={"mass": "2 kg"})
    assert result["yoke.breadth"] == pytest.approx(0.108, rel=1e-12)
    assert result.check("closure.breadth").ok
    assert result["crossovers"] == 2
    assert result["opposite.max_contact_force"] == pytest.approx(result["max_contact_force"], rel=1e-12)
    broken = run({"face": "flat", "prime_radius": "42 mm"}, SEGMENTS, closure="yoke")
    assert not broken.check("closure.breadth").ok


def test_vibration_of_the_example():
    result = dw.run(dw.load(EXAMPLES / "disc_cam.toml"))
    table = result.tables["vibration"]
    assert result["vibration.max_error"] == pytest.approx(np.max(np.abs(table["error"].data)), rel=1e-3)
    assert np.allclose(table["actual"].data - table["travel"].data, table["error"].data, atol=1e-15)
    # The acceleration takes the mass through the turn: its integral by the trapezoidal rule vanishes.
    step, middle = np.diff(table["angle"].data), 0.5 * (table["acceleration"].data[1:] + table["acceleration"].data[:-1])
    assert abs(np.sum(step * middle)) < 1e-3 * np.sum(step * np.abs(middle))


@pytest.mark.parametrize("name", sorted(registry.mechanism("cam").presets()))
def test_presets_pass_every_check(name):
    result = dw.run(dw.load(registry.mechanism("cam").presets()[name]))
    assert result.outcome == "complete"
    assert [check.name for check in result.checks if not check.ok] == []
    for table in result.tables.values():
        assert all(np.all(np.isfinite(column.data)) and column.unit and column.meaning for column in table.columns)


@pytest.mark.parametrize(
    ("name", "value", "expected"),
    [("disc_cam", "spring.jump_speed", 74.119), ("oscillating_cam", "crossovers", 4), ("yoke_cam", "yoke.breadth", 0.108)],
)
def test_examples_show_their_number(name, value, expected):
    assert dw.run(dw.load(EXAMPLES / f"{name}.toml"))[value] == pytest.approx(expected, rel=1e-4)
