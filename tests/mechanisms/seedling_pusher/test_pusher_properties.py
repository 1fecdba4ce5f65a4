"""What must hold for any seedling pusher: chain rule, invariants, mirror images, two routes to the same number."""

import tomllib

import numpy as np
import pytest
from places import EXAMPLES

import drivewright as dw
from drivewright.mechanisms.seedling_pusher import designs
from drivewright.mechanisms.seedling_pusher.build import build
from drivewright.spec import from_document

pytestmark = pytest.mark.property

EXAMPLE = EXAMPLES / "seedling_pusher.toml"
CHANGES = [
    "train.axis_ratio=0.979",
    "train.bend=97 deg",
    "train.carrier_angle=-11 deg",
    "arm.tip_angle=47 deg",
    "push.end=93 deg",
    "push.rise=24 deg",
    "lever.arm_main=14.7 mm",
    "cams.prime_radius_main=30.5 mm",
]


@pytest.fixture(
    scope="module", params=[[], CHANGES, ["train.start=far"], ["cams.orbit=counter-clockwise"]], ids=["paper", "other", "far", "orbit"]
)
def model(request):
    return build(dw.load(EXAMPLE, request.param))


def differences(f, t, h=1e-4):
    """First three derivatives by central differences of high order."""
    v = {k: f(t + k * h) for k in range(-4, 5)}
    first = (8 * (v[1] - v[-1]) - (v[2] - v[-2])) / (12 * h)
    second = (-v[2] + 16 * v[1] - 30 * v[0] + 16 * v[-1] - v[-2]) / (12 * h * h)
    return first, second


@pytest.mark.parametrize("what", ["point", "axis", "planet", "rotation"])
def test_derivatives_of_the_train(model, what):
    t = np.array([0.3, 1.234, 2.9, 5.1])
    jet = getattr(model.arm, what)(t)
    first, second = differences(lambda x: getattr(model.arm, what)(x).d0, t)
    assert np.abs(first - jet.d1).max() < 1e-9 * max(1, np.abs(jet.d1).max())
    assert np.abs(second - jet.d2).max() < 1e-6 * max(1, np.abs(jet.d2).max())


def test_derivatives_of_the_pitch_curves(model):
    low, high, _, k = next(p for p in model.pair.pieces if p[2] == "rise")
    t = low + (high - low) * np.array([0.2, 0.45, 0.8])
    for cam in model.pair.cams:
        jet = model.pair.pitch(cam, t, k)
        first, second = differences(lambda x, cam=cam: model.pair.pitch(cam, x, k).d0, t)
        assert np.abs(first - jet.d1).max() < 1e-8 * np.abs(jet.d1).max()
        assert np.abs(second - jet.d2).max() < 1e-5 * np.abs(jet.d2).max()


def test_both_rollers_keep_their_distance(model):
    t = np.linspace(0, 2 * np.pi, 500)
    main, back = (model.pair.pitch(cam, t).d0 for cam in model.pair.cams)
    distance = np.abs(main - back)
    arms = [cam.arm for cam in model.pair.cams]
    between = sum(cam.rest_angle for cam in model.pair.cams)
    assert np.ptp(distance) < 1e-15
    assert distance[0] == pytest.approx(np.sqrt(arms[0] ** 2 + arms[1] ** 2 - 2 * arms[0] * arms[1] * np.cos(between)), rel=1e-14)


def test_pressure_angle_is_the_angle_between_normal_and_roller_path(model):
    """From the pitch curve's own tangent and the arm's direction, both in the frame of the cams."""
    for low, high, phase, k in model.pair.pieces:
        if phase == "dwell":
            continue
        t = np.linspace(low, high, 41)[1:-1]
        for cam in model.pair.cams:
            pitch = model.pair.pitch(cam, t, k)
            pivot = cam.pivot_distance * np.exp(1j * model.pair.pivot_angle(t).d0)
            arm = pitch.d0 - pivot
            angle = np.arccos(np.abs((pitch.d1 / np.abs(pitch.d1) * np.conj(arm / np.abs(arm))).real))
            assert angle == pytest.approx(np.abs(model.pair.pressure_angle(cam, t, k).d0), abs=1e-7)


def test_power_of_the_rod_comes_from_the_cams(model):
    """Torque on the planet times its rate equals rod force times rod velocity."""
    table = dw.run(model.spec, only=("load",)).tables["load"]
    t = table["carrier_angle"].data
    assert table["torque"].data * model.arm.planet(t).d1 * model.spec.drive.speed == pytest.approx(
        table["rod_force"].data * table["velocity"].data, abs=1e-9 * np.abs(table["rod_force"].data).max()
    )


def test_needle_angle_is_the_direction_of_the_tip_line_and_the_offset(model):
    t = np.linspace(0, 2 * np.pi, 50)
    line = model.arm.point(t).d0 - model.arm.axis(t).d0
    assert np.exp(-1j * (model.needle_angle(t) - model.spec.arm.needle_angle)) == pytest.approx(
        line / model.spec.arm.tip_distance, abs=1e-12
    )


def test_scaling_the_world_leaves_pure_numbers(model):
    data = tomllib.loads(model.spec.to_toml())
    for table, key in [
        ("train", "semi_major"),
        ("arm", "tip_distance"),
        ("push", "stroke"),
        ("lever", "pivot_distance"),
        ("lever", "arm_main"),
        ("lever", "arm_return"),
        ("lever", "output_arm"),
        ("cams", "prime_radius_main"),
        ("cams", "prime_radius_return"),
        ("cams", "roller_radius"),
    ]:
        number, unit = data[table][key].split()
        data[table][key] = f"{3.7 * float(number):.17g} {unit}"
    small, large = dw.run(model.spec, only=("train", "planting", "cams")), dw.run(from_document(data), only=("train", "planting", "cams"))
    for name in ("needle.angle_difference", "cam.max_pressure_angle", "cam.curvature_ratio", "tip.lowest_angle", "lever.swing"):
        assert large[name] == pytest.approx(small[name], rel=1e-9)
    for name in ("tip.track_height", "cam.main.min_convex_radius", "cam.return.lost_motion", "cam.roller_distance"):
        assert large[name] == pytest.approx(3.7 * small[name], rel=1e-6, abs=1e-12)


KEYS = (
    "train.axis_ratio",
    "train.bend",
    "train.carrier_angle",
    "arm.tip_angle",
    "arm.tip_distance",
    "arm.needle_angle",
    "push.rise",
    "push.retraction",
    "lever.output_arm",
    "lever.pivot_distance",
    "lever.arm_main",
    "lever.arm_return",
    "cams.prime_radius_main",
    "cams.prime_radius_return",
    "cams.roller_radius",
)


@pytest.mark.parametrize(
    "changes",
    [
        [],
        ["push.end_event=lowest"],
        ["train.start=far"],
        ["cams.orbit=counter-clockwise"],
        ["train.bend_reading=interior"],
        ["arm.tip_reference=planet"],
        ["events.push=push-start"],
        ["events.take=angle", "events.take_angle=244 deg"],
        ["push.law=cycloidal", "events.push=push-end", "field.travel=-x"],
    ],
)
def test_the_batch_gives_the_numbers_of_a_run(changes):
    spec = dw.load(EXAMPLE, changes)
    lower = np.array([[0.97, 1.4, -0.2, 0.3, 0.165, 0.45, 0.32, 0.55, 0.050, 0.034, 0.014, 0.014, 0.027, 0.030, 0.005]])
    upper = np.array([[0.99, 1.7, 0.4, 0.9, 0.185, 0.65, 0.45, 1.0, 0.060, 0.037, 0.017, 0.017, 0.030, 0.034, 0.006]])
    x = lower + np.random.default_rng(5).random((2, len(KEYS))) * (upper - lower)
    found = designs.batch(spec, KEYS, designs.NAMES)(x)
    for n, row in enumerate(x):
        data = tomllib.loads(spec.to_toml())
        for key, value in zip(KEYS, row, strict=True):
            table, name = key.split(".")
            unit = (
                ""
                if name == "axis_ratio"
                else (" rad" if name in ("bend", "carrier_angle", "tip_angle", "needle_angle", "rise", "retraction") else " m")
            )
            data[table][name] = f"{value:.17g}{unit}" if unit else float(value)
        result = dw.run(from_document(data), only=("train", "planting", "cams"))
        for name in designs.NAMES:
            tolerance = 1e-4 if name.startswith("cam.") else 1e-9
            assert found[name][n] == pytest.approx(result[name], rel=tolerance, abs=1e-9), name


def test_the_batch_runs_uncompiled_to_the_same_numbers():
    from drivewright._jit import plain

    spec = dw.load(EXAMPLE)
    rows, choices = designs.base_row(spec)[None], designs.choices_of(spec, with_mouth=True)
    compiled, interpreted = np.empty((1, len(designs.NAMES))), np.empty((1, len(designs.NAMES)))
    arguments = (rows, choices, *designs.half_angles(), *designs.law_table("cycloidal"))
    designs.evaluate_designs(*arguments, compiled)
    plain(designs.evaluate_designs)(*arguments, interpreted)
    assert compiled == pytest.approx(interpreted, rel=1e-13)


def test_an_impossible_design_of_a_batch_is_nan():
    found = designs.batch(dw.load(EXAMPLE), ("cams.prime_radius_main",), ("cam.max_pressure_angle", "tip.track_height"))(
        np.array([[0.060], [0.029]])
    )
    assert np.isnan(found["cam.max_pressure_angle"][0]) and np.isfinite(found["cam.max_pressure_angle"][1])
    assert np.isfinite(found["tip.track_height"]).all()


def test_the_batch_declines_what_it_does_not_know():
    spec = dw.load(EXAMPLE)
    assert designs.batch(spec, ("drive.speed",), ("tip.track_height",)) is None
    assert designs.batch(spec, ("push.rise",), ("contact.peak_force",)) is None


def test_a_material_without_an_allowable_pressure_leaves_the_check_out():
    """And says so; the pressure itself is computed, and a limit of one's own is checked."""
    spec = dw.load(EXAMPLE, ["contact.material=C45"])
    result = dw.run(spec, only="load")
    assert not [check for check in result.checks if check.name.startswith("contact_pressure")]
    assert any("contact_pressure.main is left out" in finding and "limits.contact_pressure" in finding for finding in result.findings)
    assert result["cam.main.max_contact_pressure"] > 0
    limited = dw.run(dw.load(EXAMPLE, ["contact.material=C45", "limits.contact_pressure=900 MPa"]), only="load")
    assert limited.check("contact_pressure.main").limit == 900e6


def test_the_hole_is_as_wide_as_the_track_over_the_field_below_the_surface():
    """Of the table's 720 points; the tip goes back while the machine advances, so the hole is narrower than the advance."""
    done = dw.run(dw.load(EXAMPLE), only=["planting", "train"])
    cycle = done.tables["cycle"]
    inside = cycle["tip_y"].data < cycle["tip_y"].data.min() + done.spec.field.mouth_height
    over_field = float(np.ptp(cycle["field_x"].data[inside]))
    advance = done.spec.field.spacing * np.ptp(cycle["carrier_angle"].data[inside]) / (2 * np.pi)
    assert over_field == pytest.approx(done["planting.mouth_width"], abs=5e-4)
    assert over_field < advance
