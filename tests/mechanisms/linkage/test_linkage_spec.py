"""A linkage as the user says it, and the description made of it."""

import copy
import math
import tomllib
from dataclasses import fields, is_dataclass
from pathlib import Path

import numpy as np
import pytest
from places import EXAMPLES, SOURCE

from drivewright.contact.impact import delivered_restitution, kelvin_voigt_restitution
from drivewright.mechanisms.linkage.advice import advice, shortest_link
from drivewright.mechanisms.linkage.describe import describe, driven_bodies, output_marker
from drivewright.mechanisms.linkage.spec import LinkageSpec
from drivewright.multibody import model
from drivewright.multibody.bodies import largest_radius_of_gyration
from drivewright.spec import from_document, read_document, set_key

pytestmark = pytest.mark.interface

PRESETS = SOURCE / "mechanisms" / "linkage" / "presets"
NAMES = ("knife_folder", "slider_crank_clearance", "four_bar", "jansen_leg")
FILES = [*(EXAMPLES / f"{name}.toml" for name in NAMES), *sorted(PRESETS.glob("*.toml"))]


def linkage(path, *changes, folder="."):
    tables = copy.deepcopy(read_document(path if isinstance(path, Path) else EXAMPLES / f"{path}.toml"))
    for key, value in changes:
        set_key(tables, key, value)
    return from_document(tables, LinkageSpec, folder)


def joint(spec, name, **how):
    return next(joint for joint in describe(spec, **how).joints if joint.name == name)


def value(curve, x):
    """A Curve evaluated as its docstring says."""
    if curve.period:
        x = curve.breaks[0] + (x - curve.breaks[0]) % curve.period
    piece = int(np.clip(np.searchsorted(curve.breaks, x, side="right") - 1, 0, len(curve.breaks) - 2))
    return sum(c * (x - curve.breaks[piece]) ** k for k, c in enumerate(curve.coefficients[piece]))


def slope(curve, x, h=1e-5):
    return (value(curve, x + h) - value(curve, x - h)) / (2 * h)


def finite(thing):
    if is_dataclass(thing):
        return all(finite(getattr(thing, field.name)) for field in fields(thing))
    return all(map(finite, thing)) if isinstance(thing, tuple) else not isinstance(thing, float) or math.isfinite(thing)


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_every_file_is_read_described_and_written_back(path):
    spec = linkage(path)
    again = from_document(tomllib.loads(spec.to_toml()), LinkageSpec)
    assert again == spec and again.digest() == spec.digest() and hash(again) == hash(spec)
    found, ideal = describe(spec), describe(spec, ideal=True)
    assert finite(found) and len(found.bodies) == len(spec.bodies) and [j.name for j in found.joints] == [j.name for j in spec.joints]
    assert all(j.model == model.Ideal() for j in ideal.joints if isinstance(j, model.Revolute)) and ideal.bodies == found.bodies
    mobility = 3 * len(found.bodies) - 2 * len(found.joints)
    assert mobility == 1 and all(check.ok for check in advice(spec))


def test_the_contract_s_words_mean_what_they_say():
    spec = linkage("knife_folder", ("joints.A.kind", "revolute"))
    found = describe(spec)
    crank, coupler, knife = found.bodies
    assert found.gravity == (0.0, -9.81) and (crank.mass, crank.inertia, crank.angle) == (1.0, 0.0, 0.0)
    assert coupler.inertia == pytest.approx(2316e-6, rel=1e-15) and coupler.centroid == (0.079, 0.0)
    assert knife.inertia == pytest.approx(0.4487 - 6.883 * 0.243**2, rel=1e-12)
    assert joint(spec, "A") == model.Revolute(
        "A", model.Marker("crank", 0.066, 0.0), model.Marker("coupler", 0.0, 0.0), model.MasslessLink(2e-4, 1e-4, 0.2)
    )
    assert [f.damping for f in found.forces] == [0.1, 0.1] and {f.first for f in found.forces} == {"coupler", "knife"}
    (drive,) = found.drives
    assert drive.joint == "O2" and value(drive.motion, 0.25) == pytest.approx(4 * math.pi, rel=1e-14)
    assert driven_bodies(spec, spec.drive) == ("crank", "ground")
    assert spec.duration == pytest.approx(2.0, rel=1e-14) and spec.start_of_window == pytest.approx(5 / 8, rel=1e-14)
    tip = output_marker(spec, spec.outputs[1])
    arms = np.array([[-0.424, 0.0], [tip.x - 0.424, tip.y]])  # from B to O4 and to the tip
    angle = math.acos(arms[0] @ arms[1] / np.prod(np.linalg.norm(arms, axis=1)))
    assert math.hypot(tip.x, tip.y) == pytest.approx(0.448271442, rel=1e-9) and angle == pytest.approx(1.536, rel=1e-9)
    assert np.linalg.norm(arms[1]) == pytest.approx(0.161, rel=1e-9)


def test_a_duration_and_turns_end_at_the_shorter():
    assert linkage("knife_folder", ("simulate.duration", "1 s")).duration == 1.0
    assert linkage("knife_folder", ("simulate.duration", "1 h")).duration == pytest.approx(2.0, rel=1e-14)
    assert linkage("knife_folder", ("drive.speed", "-28800 rev/h")).duration == pytest.approx(2.0, rel=1e-14)


def test_the_mass_of_a_body_counts_about_its_centroid():
    about = linkage("four_bar", ("bodies.rocker.inertia_about", "B"), ("bodies.rocker.inertia", "8e-4 kg m^2"))
    assert describe(about).bodies[2].inertia == pytest.approx(8e-4 - 0.25 * 0.045**2, rel=1e-12)


# -- joints --------------------------------------------------------------------------------------------------------------------


def dry(*changes):
    return joint(linkage("slider_crank_clearance", *((f"joints.wrist.{key}", v) for key, v in changes)), "wrist").model


def test_the_benchmark_s_contact():
    found = dry()
    assert found.stiffness == pytest.approx(6.6102e10, rel=1e-5) and found.hysteresis == pytest.approx(8 * 0.1 / 4.5, rel=1e-14)
    assert (found.clearance, found.bearing_radius, found.length, found.exponent, found.damping) == (5e-4, 0.01, 0.02, 1.5, 0.0)
    assert found.friction.law == "none" and not found.cylinder
    assert dry(("modulus", "414 GPa")).stiffness == pytest.approx(2 * found.stiffness, rel=1e-14)
    assert dry(("poisson", 0.0)).stiffness == pytest.approx(0.91 * found.stiffness, rel=1e-14)


@pytest.mark.parametrize(
    ("law", "hysteresis"), [("flores-2011", 8 * 0.4 / 3.0), ("lankarani-nikravesh", 0.75 * 0.64), ("hunt-crossley", 0.6), ("elastic", 0.0)]
)
def test_the_normal_law_sets_the_loss(law, hysteresis):
    assert dry(("normal", law), ("restitution", 0.6)).hysteresis == pytest.approx(hysteresis, rel=1e-12)


def test_the_exact_laws_deliver_the_restitution():
    assert delivered_restitution(dry(("normal", "gonthier"), ("restitution", 0.6)).hysteresis) == pytest.approx(0.6, rel=1e-9)
    linear = dry(("normal", "kelvin-voigt"), ("restitution", 0.6), ("stiffness", "5e7 N/m"))
    assert (linear.stiffness, linear.exponent, linear.hysteresis) == (5e7, 1.0, 0.0)
    assert kelvin_voigt_restitution(linear.damping, 5e7, 0.21 * 0.14 / 0.35) == pytest.approx(0.6, rel=1e-9)
    assert dry(("normal", "kelvin-voigt"), ("stiffness", "5e7 N/m"), ("damping", "90 N s/m")).damping == 90.0


def test_the_ground_counts_as_infinite_mass():
    changes = [("joints.B.model", "dry"), ("joints.O4.model", "dry")]
    changes += [(f"joints.{name}.{key}", v) for name in ("B", "O4") for key, v in (("normal", "kelvin-voigt"), ("stiffness", "1e7 N/m"))]
    spec = linkage("four_bar", *changes)
    for name, mass in (("B", 0.3 * 0.25 / 0.55), ("O4", 0.25)):
        assert kelvin_voigt_restitution(joint(spec, name).model.damping, 1e7, mass) == pytest.approx(0.9, rel=1e-9)


def test_the_cylinder_law_takes_modulus_and_length():
    found = dry(("normal", "cylinder"), ("bearing_length", "15 mm"))
    assert found.cylinder and found.length == 0.015 and found.stiffness == pytest.approx(207e9 / 2 / 0.91, rel=1e-14)
    assert found.hysteresis == dry().hysteresis


def test_friction_says_its_law():
    assert dry(("friction", 0.1)).friction == model.Friction("coulomb", 0.1, 0.01)
    ramp = dry(("friction", 0.1), ("friction_law", "ambrosio"), ("friction_speed", "20 mm/s"), ("friction_dead_speed", "3 mm/s")).friction
    assert ramp == model.Friction("ambrosio", 0.1, 0.02, 0.003)
    bristles = dry(
        ("friction", 0.1),
        ("friction_law", "lugre"),
        ("static_friction", 0.2),
        ("bristle_deflection", "20 um"),
        ("bristle_damping", "3 s/m"),
        ("viscous_friction", "4 s/m"),
    ).friction
    assert bristles.static_coefficient == 0.2 and bristles.bristle_stiffness == pytest.approx(5e4, rel=1e-14)
    assert (bristles.bristle_damping, bristles.viscous) == (3.0, 4.0)
    assert dry(("friction", 0.1), ("friction_law", "lugre")).friction.static_coefficient == 0.1


def test_oil_and_rubber():
    oil = dry(("model", "lubricated"), ("viscosity", "0.4 Pa s"), ("film", "short"), ("roughness", "2 um"))
    assert oil == model.Lubricated(dry(), 0.4, "short", pytest.approx(2e-6, rel=1e-15))
    rubber = dry(
        ("model", "bushing"), ("stiffness", "2 kN/mm"), ("rotational_damping", "3 N m s/rad"), ("rotational_stiffness", "4 N m/rad")
    )
    assert rubber == model.Bushing(2e6, 0.0, 4.0, 3.0)


@pytest.mark.parametrize("name", ["massless-link", "dry", "lubricated"])
def test_a_pin_without_play_is_ideal(name):
    assert dry(("model", name), ("clearance", "0 mm")) == model.Ideal() != dry(("model", name))


def test_the_guide_and_the_other_joints(tmp_path):
    spec = linkage("slider_crank_clearance", ("joints.guide.axis", [3, 4]))
    assert joint(spec, "guide") == model.Prismatic("guide", model.Marker("slider"), model.Marker("ground"), (0.6, 0.8))
    slot = linkage("slider_crank_clearance", ("joints.guide.kind", "pin-slot"))
    assert joint(slot, "guide") == model.PinSlot("guide", model.Marker("slider"), model.Marker("ground"), (1.0, 0.0))
    wheel = [("joints.guide.kind", "rolling"), ("joints.guide.radius", "30 mm"), ("joints.guide.track_radius", "-70 mm")]
    assert joint(linkage("slider_crank_clearance", *wheel), "guide").track_radius == -0.07
    gear = [
        ("joints.guide.kind", "gear"),
        ("joints.guide.connects", ["crank", "slider"]),
        ("joints.guide.ratio", -2),
        ("joints.guide.carrier", "rod"),
    ]
    assert joint(linkage("slider_crank_clearance", *gear), "guide") == model.Gear("guide", "crank", "slider", -2.0, "rod")
    angles = np.arange(0, 361, 20)
    rows = "".join(f"{a},{10 * (1 - math.cos(math.radians(a))):.15g}\n" for a in angles)
    (tmp_path / "lift.csv").write_text("angle [deg],lift [mm]\n" + rows)
    cam = [
        ("joints.guide.kind", "cam"),
        ("joints.guide.connects", ["crank", "slider.B"]),
        ("joints.guide.lift", "lift.csv"),
        ("joints.guide.axis", [0, 2]),
        ("joints.guide.carrier", "rod.B"),
    ]
    pair = joint(linkage("slider_crank_clearance", *cam, folder=tmp_path), "guide")
    assert (pair.cam, pair.follower, pair.carrier) == ("crank", model.Marker("slider"), "rod")
    assert (pair.origin, pair.axis) == ((0.12, 0.0), (0.0, 1.0))
    assert value(pair.lift, 1.3 - 2 * math.pi) == pytest.approx(0.01 * (1 - math.cos(1.3)), abs=2e-7)
    (tmp_path / "lift.csv").write_text("angle [deg],lift [deg]\n" + rows)
    turned = joint(linkage("slider_crank_clearance", *cam, folder=tmp_path), "guide")
    assert turned.axis is None and value(turned.lift, math.pi) == pytest.approx(math.radians(20), rel=1e-6)


# -- forces and drive ----------------------------------------------------------------------------------------------------------


def test_springs_torques_and_forces(tmp_path):
    (tmp_path / "cut.csv").write_text("angle [deg],factor\n0,1\n90,3\n360,1\n")
    (tmp_path / "load.csv").write_text("time [ms],torque [N mm]\n0,1000\n20,3000\n")
    more = [
        ("torques", [{"body": "rocker", "on": "coupler", "file": "load.csv"}, {"body": "crank", "torque": "2 N m"}]),
        ("forces", [{"body": "coupler", "point": "C", "force": ["3 N", "-4 N"], "follows": True, "file": "cut.csv"}]),
    ]
    spring, timed, steady, cut = describe(linkage("four_bar", *more, folder=tmp_path)).forces
    assert spring == model.PointSpring("return", model.Marker("rocker", 0.045, 0.0), model.Marker("ground"), 500.0, 0.06, 1.0)
    assert (timed.name, timed.body, timed.on, timed.load.over) == ("torque 1", "rocker", "coupler", "time")
    assert [value(timed.load.curve, t) for t in (-5, 0, 0.005, 0.02, 0.03, 9)] == pytest.approx([1, 1, 1.5, 3, 3, 3], rel=1e-12)
    assert steady.name == "torque 2" and value(steady.load.curve, 77.0) == 2.0
    assert (cut.point, cut.direction, cut.follows, cut.load.over) == (model.Marker("coupler", 0.05, 0.04), (3.0, -4.0), True, "angle")
    angles = [math.radians(a) for a in (45, 90, 225, 405, -315)]
    assert [value(cut.load.curve, a) for a in angles] == pytest.approx([2, 3, 2, 2, 2], rel=1e-12)  # goes round


def test_a_table_called_periodic_repeats(tmp_path):
    (tmp_path / "load.csv").write_text("time [s],torque [N m]\n0,1\n1,3\n2,1\n")
    torque = {"body": "rocker", "file": "load.csv", "periodic": True}
    found = describe(linkage("four_bar", ("torques", [torque]), folder=tmp_path)).forces[-1].load.curve
    assert [value(found, t) for t in (0.5, 2.5, 7.25)] == pytest.approx([2, 2, 2.5], rel=1e-12)


def profiled(tmp_path, ends, rows):
    (tmp_path / "p.csv").write_text("time [s],angle [deg]\n" + "".join(f"{t},{a}\n" for t, a in rows))
    drive = {"joint": "O2", "profile": "p.csv", "ends": ends}
    spec = linkage("four_bar", ("drive", drive), ("simulate", {"duration": "1 s"}), folder=tmp_path)
    return describe(spec).drives[0].motion


def test_a_profile_at_rest_starts_and_ends_so_and_counts_from_its_first_row(tmp_path):
    rows = [(0.1 * k, 30 + 90 * (k / 10 - math.sin(2 * math.pi * k / 10) / (2 * math.pi))) for k in range(11)]
    motion = profiled(tmp_path, "rest", rows)
    assert [math.degrees(value(motion, t)) for t in (-1, 0, 0.3, 1, 5)] == pytest.approx([0, 0, rows[3][1] - 30, 90, 90], abs=1e-9)
    assert slope(motion, 0.0) == pytest.approx(0, abs=1e-6) and slope(motion, 1.0) == pytest.approx(0, abs=1e-6)
    assert math.degrees(value(motion, 0.55)) == pytest.approx(90 * (0.55 - math.sin(1.1 * math.pi) / (2 * math.pi)), abs=2e-3)


def test_a_free_profile_goes_on_at_its_last_speed(tmp_path):
    motion = profiled(tmp_path, "free", [(t, 40 * t) for t in (0, 0.2, 0.5, 0.7, 1.0)])
    assert [math.degrees(value(motion, t)) for t in (-1, 0.3, 2)] == pytest.approx([-40, 12, 80], rel=1e-9, abs=1e-9)


def test_the_travel_of_a_slide_is_counted_from_its_line_s_point(tmp_path):
    (tmp_path / "p.csv").write_text("time [s],travel [mm]\n" + "".join(f"{k},{150 + k * k}\n" for k in range(7)))
    changes = [(name, None) for name in ("poincare", "lyapunov")]
    tables = {k: v for k, v in read_document(EXAMPLES / "slider_crank_clearance.toml").items() if k not in dict(changes)}
    tables |= {"drive": {"joint": "guide", "profile": "p.csv"}, "simulate": {"duration": "1 s"}}
    motion = describe(from_document(tables, LinkageSpec, tmp_path)).drives[0].motion
    assert value(motion, 0.0) == pytest.approx(0.15, rel=1e-12) and value(motion, 3.0) == pytest.approx(0.159, rel=1e-12)


def test_a_motor_is_a_torque_over_the_speed(tmp_path):
    (tmp_path / "motor.csv").write_text("speed [rpm],torque [N m]\n0,5\n3000,0\n")
    drive = {"joint": "O2", "motor": "motor.csv"}
    spec = linkage("four_bar", ("drive", drive), ("simulate", {"duration": "1 s"}), folder=tmp_path)
    found = describe(spec)
    motor = found.forces[-1]
    assert not found.drives and (motor.body, motor.on, motor.load.over) == ("crank", "ground", "speed")
    assert value(motor.load.curve, 1500 * math.pi / 30) == pytest.approx(2.5, rel=1e-12) and spec.period is None


# -- the examples' geometry ----------------------------------------------------------------------------------------------------


def corner(p, rp, q, rq, side):
    """Where the circles about p and q meet; side +1: to the left of the line from p to q."""
    line = q - p
    distance = abs(line)
    along = (rp**2 - rq**2 + distance**2) / (2 * distance)
    return p + (along + side * 1j * np.sqrt(rp**2 - along**2)) * line / distance


def length(spec, body, a, b):
    points = spec.bodies[body].points
    return math.dist(points[a], points[b])


def test_the_knife_s_ideal_motion_is_the_published_geometry_s():
    spec, crank = linkage("knife_folder"), np.radians(np.arange(0, 360, 0.01))
    frame = spec.ground.points["O4"][0]
    pin = length(spec, "crank", "O2", "A") * np.exp(1j * crank)
    rocker, coupler = length(spec, "knife", "O4", "B"), length(spec, "coupler", "A", "B")
    joint_b = corner(frame, rocker, pin, coupler, 1)
    knife, bar = np.degrees(np.angle(joint_b - frame)) % 360, np.degrees(np.angle(joint_b - pin))
    assert (knife.min(), knife.max()) == pytest.approx((188.8297, 207.5609), abs=1e-4)
    assert (bar.min(), bar.max()) == pytest.approx((-82.8185, -31.0310), abs=1e-4)
    guesses = [np.degrees(spec.bodies[name].angle) % 360 for name in ("coupler", "knife")]
    assert guesses == pytest.approx([bar[0] % 360, knife[0]], abs=1.0)  # the guess picks this assembly


def test_the_legs_loops_close_over_the_turn_and_the_foot_is_flat_on_the_ground():
    spec, crank = linkage("jansen_leg"), np.radians(np.arange(0.0, 360.0, 1.0))
    pivot = complex(*spec.ground.points["Q"])
    pin = length(spec, "crank", "O", "P") * np.exp(1j * crank)
    x = corner(pivot, length(spec, "upper_frame", "Q", "X"), pin, length(spec, "upper_rod", "P", "X"), 1)
    y = corner(pivot, length(spec, "lower_rocker", "Q", "Y"), pin, length(spec, "lower_rod", "P", "Y"), -1)
    e = pivot + complex(*spec.bodies["upper_frame"].points["E"]) * (x - pivot) / abs(x - pivot)
    f = corner(e, length(spec, "shin_rod", "E", "F"), y, length(spec, "foot", "Y", "F"), -1)
    tip = y + complex(*spec.bodies["foot"].points["tip"]) * (f - y) / abs(f - y)
    assert np.all(np.isfinite(tip))
    starts = {
        "upper_rod": x - pin,
        "lower_rod": y - pin,
        "upper_frame": x - pivot,
        "lower_rocker": y - pivot,
        "shin_rod": f - e,
        "foot": f - y,
    }
    for body, direction in starts.items():
        assert spec.bodies[body].angle == pytest.approx(np.angle(direction[0]), abs=math.radians(1.0)), body
    down = tip.imag < tip.imag.min() + 1e-3
    assert np.mean(down) == pytest.approx(0.43, abs=0.01) and np.ptp(tip.real[down]) == pytest.approx(0.0572, abs=1e-4)
    assert np.ptp(tip.real) == pytest.approx(0.0679, abs=1e-4) and np.ptp(tip.imag) > 0.02
    sides = {
        "upper_frame": (("Q", "X", 41.5), ("Q", "E", 40.1), ("X", "E", 55.8)),
        "foot": (("Y", "F", 36.7), ("F", "tip", 65.7), ("Y", "tip", 49.0)),
    }
    for body, three in sides.items():
        for a, b, wanted in three:
            assert length(spec, body, a, b) == pytest.approx(wanted * 1e-3, rel=1e-8)


# -- advice --------------------------------------------------------------------------------------------------------------------


def checks(spec):
    return {check.name: check for check in advice(spec)}


def test_the_clearance_is_compared_with_the_shortest_link():
    assert shortest_link(linkage("knife_folder")) == (pytest.approx(0.066), "crank")
    found = checks(linkage("knife_folder", ("joints.B.clearance", "3.4 mm")))["clearance_share"]
    assert found.value == pytest.approx(3.4 / 66) and not found.ok and found.parts == ("B", "crank")
    assert "clearance_share" not in checks(linkage("four_bar"))  # its pins are ideal


def test_a_bouncy_law_is_pointed_out():
    laws = {"lankarani-nikravesh": False, "hunt-crossley": False, "flores-2011": None, "gonthier": None}
    for law, ok in laws.items():
        found = checks(linkage("slider_crank_clearance", ("joints.wrist.normal", law), ("joints.wrist.restitution", 0.69)))
        assert (found["restitution.wrist"].ok if "restitution.wrist" in found else None) is ok
    assert checks(linkage("slider_crank_clearance", ("joints.wrist.normal", "hunt-crossley")))["restitution.wrist"].ok


def test_a_pivot_inertia_read_as_central_reaches_beyond_the_body():
    found = checks(linkage("knife_folder", ("bodies.knife.inertia_about", "centroid")))["inertia.knife"]
    assert found.value == pytest.approx(0.2553, abs=1e-4) and found.limit == pytest.approx(math.sqrt(0.243 * 0.181), rel=1e-9)
    assert not found.ok


def test_the_largest_radius_of_gyration():
    assert largest_radius_of_gyration([(0, 0), (3, 0)], (1, 0)) == pytest.approx(math.sqrt(2))
    assert largest_radius_of_gyration([(0, 0), (1, 0), (2, 0), (3, 0)], (1, 0)) == pytest.approx(math.sqrt(2))
    corners_at_one_distance = [(1, 0), (-1, 0), (0, 1), (0, -1)]
    assert largest_radius_of_gyration(corners_at_one_distance, (0.2, 0.1)) == pytest.approx(math.sqrt(1 - 0.05))
    assert largest_radius_of_gyration([(0, 0), (3, 0)], (1, 0.5)) is None and largest_radius_of_gyration([(1, 0)], (1, 0)) is None
    assert largest_radius_of_gyration([], (0, 0)) is None and largest_radius_of_gyration([(1, 0), (-1, 0), (0, 1)], (0.3, -0.3)) is None


def test_a_short_window_is_pointed_out():
    assert not checks(linkage("knife_folder", ("simulate.turns", 9.9)))["window"].ok
    assert checks(linkage("knife_folder", ("simulate.turns", 10)))["window"].ok
