"""Values, tables and findings of an indexing drive against closed forms and against one another."""

from functools import cache

import numpy as np
import pytest

import drivewright as dw
from drivewright import materials, registry
from drivewright.curves.touching import touches
from drivewright.indexing.pin_pressure import pin_pressure
from drivewright.indexing.plane import contact_pressure_angle
from drivewright.runner import build

pytestmark = pytest.mark.analytical

PRESETS = registry.mechanism("indexer").presets()
TURN = 2 * np.pi


def pressure_on_pin(model, force, curvature):
    return pin_pressure(force, curvature, model.spec.pin_radius, model.spec.cam_width, model.modulus)


def spec(*changes, preset="default"):
    return dw.load(PRESETS[preset], changes)


@cache
def found(*changes, preset="default", only=None):
    return dw.run(spec(*changes, preset=preset), only)


def column(result, table, name):
    return result.tables[table][name].data


def test_motion_of_a_cycloidal_step_in_closed_form():
    """s' = 1 - cos 2 pi u, s'' = 2 pi sin 2 pi u over 240 deg of the input; speed by omega, acceleration by omega squared."""
    result = found('motion.law="cycloidal"', "motion.motion_to_dwell=2.0", 'load.speed="90 rpm"', only=("motion",))
    angle, pitch, omega = 4 * np.pi / 3, TURN / 12, 3 * np.pi
    assert result["motion.motion_angle"] == pytest.approx(angle, rel=1e-14)
    assert result["motion.velocity_factor"] == pytest.approx(2 * pitch / angle, rel=1e-9)
    assert result["motion.acceleration_factor"] == pytest.approx(TURN * pitch / angle**2, rel=1e-9)
    assert result["motion.peak_speed"] == pytest.approx(2 * pitch / angle * omega, rel=1e-9)
    assert result["motion.peak_acceleration"] == pytest.approx(TURN * pitch / angle**2 * omega**2, rel=1e-9)
    theta, wheel = column(result, "motion", "angle"), column(result, "motion", "wheel")
    u = np.minimum(theta / angle, 1.0)
    np.testing.assert_allclose(wheel, pitch * (u - np.sin(TURN * u) / TURN), atol=1e-12)
    moving = u < 1
    np.testing.assert_allclose(column(result, "motion", "third")[moving], TURN**2 * np.cos(TURN * u[moving]) * pitch / angle**3, atol=1e-9)


def test_walls_of_the_prototype_by_hand():
    """NU207E, 72 mm wide outside: 110 - 72 between the holes; least radius R - e - r = 102 mm less 55 + 36."""
    result = found(only=("profile",))
    assert result.check("wall.holes").value == pytest.approx(38e-3, rel=1e-9)
    assert result.check("wall.profile").value == pytest.approx(11e-3, rel=1e-6)


def test_a_crank_that_leaves_no_sleeve_is_told():
    """Bore of 35 mm on an eccentricity of 10 mm: 15 mm at most."""
    told = [
        any("leaves no sleeve" in each for each in found(f"shafts.diameters={each}", only=("profile",)).findings)
        for each in ('["14 mm", "14.9 mm", "14 mm", "14 mm"]', '["14 mm", "15.1 mm", "14 mm", "14 mm"]')
    ]
    assert told == [False, True]


def test_lobe_tops_of_the_dwell_are_the_sharpest():
    """Thin pins: in the dwell the centre runs on a circle of the eccentricity."""
    assert found(only=("profile",))["profile.min_convex_radius"] == pytest.approx(10e-3, rel=1e-9)


@pytest.mark.parametrize(
    ("preset", "suffix", "changes"),
    [
        ("default", "", ()),
        ("default", "", ('side="outside"', 'pin_radius="7 mm"')),
        ("cycloid", "", ()),
        ("cycloid", "", ('side="outside"',)),
        ("parallel", "", ()),
        ("parallel", ".second", ()),
    ],
)
def test_curvature_is_that_of_the_points_counter_clockwise(preset, suffix, changes):
    """1/R of the circle through three points in a row, left turns positive on the way counter-clockwise round the cam."""
    table = found(*changes, preset=preset, only=("profile",)).tables[f"profile{suffix}"]
    z = table["x"].data + 1j * table["y"].data
    way = np.sign(np.sum(np.imag(np.conj(z) * np.roll(z, -1))))
    a, b, c = z[:-2], z[1:-1], z[2:]
    with np.errstate(divide="ignore", invalid="ignore"):
        bend = 2 * way * np.imag(np.conj(b - a) * (c - b)) / (np.abs(b - a) * np.abs(c - b) * np.abs(c - a))
        even = (np.abs(b - a) > 1e-7) & (np.abs(np.abs(b - a) / np.abs(c - b) - 1) < 0.05)
    miss = np.abs(bend - table["curvature"].data[1:-1])[even]
    assert even.sum() > 100 and np.median(miss) < 0.02 * np.median(np.abs(bend[even]))


@pytest.mark.parametrize("preset", ["default", "parallel"])
def test_points_of_contact_lie_on_the_profile_and_on_their_pin(preset):
    result, model = found(preset=preset, only=("contacts",)), build(spec(preset=preset))
    levels, each = model.drive.levels, result.tables["contact_points"]
    angle, at, pin = each["angle"].data, each["x"].data + 1j * each["y"].data, each["pin"].data.astype(int)
    seen = set()
    for k in range(0, len(angle), 7):
        level = levels[pin[k] // model.drive.pins]
        place, turn = (complex(jet.d0) for jet in level.pose(angle[k]))
        assert np.min(np.abs(touches(level.nodes, [(at[k] - place) * np.exp(-1j * turn)], 0.0, 1e-3).gap)) < 1e-7
        assert abs(at[k] - level.pin_centres(angle[k]).d0[pin[k] % model.drive.pins]) == pytest.approx(model.spec.pin_radius, rel=1e-9)
        seen.add(pin[k] // model.drive.pins)
    assert seen == set(range(len(levels)))


def test_pressure_angles_either_way_are_those_of_their_direction():
    """Away from the middle of the step, where both ways are alike."""
    one, model = found('load.angle="40 deg"', only=("contacts",)), build(spec())
    ways = [float(contact_pressure_angle(model.drive, np.radians(40), way)[0]) for way in (1, -1)]
    assert abs(ways[0] - ways[1]) > 0.05
    assert [one[f"pressure_angle.{name}.maximum"] for name in ("forward", "backward")] == pytest.approx(ways, rel=1e-9)
    assert one["pressure_angle.maximum"] == pytest.approx(ways[0], rel=1e-9)  # in the first half the wheel is accelerated
    late = found('load.angle="140 deg"', only=("contacts",))
    assert late["pressure_angle.maximum"] == pytest.approx(late["pressure_angle.backward.maximum"], rel=1e-12)


def test_a_wheel_that_turns_evenly_is_judged_by_its_worse_way():
    result = found(preset="cycloid", only=("contacts",))
    forward, backward, told = (
        column(result, "contacts", name) for name in ("pressure_angle_forward", "pressure_angle_backward", "pressure_angle")
    )
    assert np.max(np.abs(forward - backward)) > 1e-3
    np.testing.assert_array_equal(told, np.maximum(forward, backward))


@pytest.mark.parametrize("torque", [100.0, -100.0])
def test_the_roller_of_two_plate_cams_with_the_longest_lever_carries(torque):
    """Force times lever is the torque, the lever against it, and no contact that resists has a longer one."""
    result = found(f'load.torque="{torque} N m"', preset="parallel", only=("contacts", "stress"))
    force, arm, angle, pin = (column(result, "pin_forces", name) for name in ("force", "arm", "angle", "pin"))
    np.testing.assert_allclose(force * arm, -torque, rtol=1e-12)
    at, lever, pins = (column(result, "contact_points", name) for name in ("angle", "arm", "pin"))
    for k in range(len(angle)):
        here = at == angle[k]
        levers = -np.sign(torque) * lever[here]
        assert abs(arm[k]) == pytest.approx(levers.max(), rel=1e-9) and pins[here][np.argmax(levers)] == pin[k]
    assert len(set(pin >= 8)) == 2 or len(set(pin)) > 1


@pytest.mark.parametrize("preset", ["barrel", "globoidal"])
def test_the_contact_map_of_rollers_is_positive_where_they_push_forward(preset):
    result = found(preset=preset, only=("contacts",))
    way = result.arrays["contact_map"].values.sum(axis=1)
    wanted = column(result, "contacts", "forward") - column(result, "contacts", "backward")
    np.testing.assert_array_equal(way, wanted)
    assert np.any(wanted != 0) or np.any(result.arrays["contact_map"].values != 0)


@pytest.mark.parametrize("curvature", [0.0, 500.0, -60.0])
def test_hertz_pressure_of_two_cylinders(curvature):
    """p = sqrt(F E'/(pi b R)), 1/R = 1/r + kappa, E' = E/(2 (1 - nu^2)) for two bodies alike; nothing on a corner or in a pull."""
    model = build(spec())
    steel = materials.material(model.spec.contact.material)
    shared = steel.modulus / (2 * (1 - steel.poisson**2))
    wanted = np.sqrt(3000.0 * shared / (np.pi * 18e-3) * (1 / 8e-3 + curvature))
    assert pressure_on_pin(model, 3000.0, curvature) == pytest.approx(wanted, rel=1e-9)
    assert np.isnan(
        [pressure_on_pin(model, 3000.0, np.inf), pressure_on_pin(model, -3000.0, curvature), pressure_on_pin(model, 3000.0, -125.1)]
    ).all()


def test_pressures_of_the_pins_are_those_of_their_own_contacts():
    changes = 'load.angle="40 deg"', 'load.torque="-1000 N m"'
    result, model = found(*changes, only=("contacts", "stiffness")), build(spec(*changes))
    at, own = result.tables["contact_points"], result.tables["pin_forces"]
    bends = dict(zip(at["pin"].data, at["curvature"].data, strict=True))
    assert len(own["pin"].data) > 4 and len(set(bends.values())) > 4
    for pin, force, pressure in zip(*(own[name].data for name in ("pin", "force", "pressure")), strict=True):
        if pin in bends:
            assert pressure == pytest.approx(pressure_on_pin(model, force, bends[pin]), rel=1e-9)


def test_after_the_play_and_reversed_the_mirror_holds_too():
    """K(theta, T) = K(180 deg - theta, -T), also after the play, where the wheel is turned the other way."""
    names = ("secant_after_play", "secant_reversed", "free_rotation", "secant")
    ours, theirs = (
        [
            column(found(f'load.angle="{angle} deg"', f'load.torque="{torque} N m"', only=("stiffness",)), "stiffness", name)[0]
            for name in names
        ]
        for angle, torque in ((13.5, 1000), (166.5, -1000))
    )
    np.testing.assert_allclose(ours, theirs, rtol=1e-6)
    assert ours[0] > 0 and ours[2] > 0 and np.isnan(ours[3])
    back = column(found('load.angle="13.5 deg"', 'load.torque="-1000 N m"', only=("stiffness",)), "stiffness", "secant")[0]
    assert ours[1] == pytest.approx(back, rel=1e-12)


def test_the_sweep_of_the_optimiser_is_the_run():
    """Motion angle and factors to rounding; play and pressure angles as the sweep promises, and either way in its own column."""
    names = (
        "motion.motion_angle",
        "motion.velocity_factor",
        "motion.acceleration_factor",
        "pressure_angle.forward.maximum",
        "play.forward.maximum",
        "profile.min_convex_radius",
    )
    base = 'motion.law="cycloidal"'
    evaluate = registry.mechanism("indexer").batch(spec(base), ("motion.motion_to_dwell", "pin_radius"), names)
    quick = {name: value[0] for name, value in evaluate(np.array([[2.0, 7e-3]])).items()}
    exact = found(base, "motion.motion_to_dwell=2.0", 'pin_radius="7 mm"', only=("motion", "profile", "contacts", "play"))
    for name in names[:3]:
        assert quick[name] == pytest.approx(exact[name], rel=1e-6)
    assert quick[names[3]] == pytest.approx(exact[names[3]], abs=5e-4)
    assert quick[names[4]] == pytest.approx(exact[names[4]], rel=0.02)  # the run seeks the peak between the angles
    assert quick[names[5]] == pytest.approx(exact[names[5]], rel=1e-3)
