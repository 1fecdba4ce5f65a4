"""Many cams at once: value by value what a run gives, and refused where a run is refused."""

import numpy as np
import pytest

import drivewright as dw
from drivewright import cams, registry
from drivewright.errors import DrivewrightError
from drivewright.execution.keys import key_kind
from drivewright.execution.outputs import case_outputs
from drivewright.runner import run_analyses, select_analyses
from drivewright.spec import document, from_document, set_key, value_at

pytestmark = pytest.mark.property

CAM = registry.mechanism("cam")
ANALYSES = ("motion", "geometry", "forces", "spring")
RANGES = {  # of the unknowns of each preset, so wide that some designs are refused
    "default": {
        "follower.prime_radius": (0.006, 0.05),
        "follower.offset": (-0.02, 0.02),
        "follower.roller_radius": (0.003, 0.03),
        "limits.pressure_angle": (0.3, 0.8),
    },
    "flat": {"follower.base_radius": (0.004, 0.06), "follower.face_offset": (-0.01, 0.01), "follower.face_angle": (-0.9, 0.2)},
    "groove": {"follower.prime_radius": (0.01, 0.06), "follower.roller_radius": (0.004, 0.012), "groove.clearance": (-2e-5, 1e-4)},
    "oscillating": {
        "follower.prime_radius": (0.02, 0.08),
        "follower.pivot_distance": (0.06, 0.12),
        "follower.arm_length": (0.04, 0.09),
        "drive.speed": (10.0, 50.0),
    },
    "conjugate": {"conjugate.prime_radius": (0.03, 0.09), "follower.prime_radius": (0.03, 0.06), "follower.arm_length": (0.05, 0.08)},
    "yoke": {"follower.prime_radius": (0.005, 0.08), "limits.breadth_error": (-1e-5, 1e-4)},
}
BEYOND = ("profile.area", "profile.perimeter", "lost_motion.at", "conjugate.profile.area", "conjugate.profile.perimeter")
BEYOND += ("outer.profile.area", "outer.profile.perimeter", "conjugate.lost_motion.at", "outer.lost_motion.at")
LEVER = {"motion": "oscillating", "face": "flat", "base_radius": "30 mm", "pivot_distance": "85 mm", "arm_length": "60 mm"}
TURN = [
    {"angle": "120 deg", "law": "mcv", "c": 0.4, "rise": "12 deg"},
    {"angle": "150 deg", "law": "cycloidal", "rise": "-12 deg"},
    {"angle": "90 deg", "law": "dwell"},
]
SLIDE = [{"angle": "150 deg", "law": "cycloidal", "rise": "-18 mm"}, {"angle": "90 deg", "law": "dwell"}]


def preset(name, **changes):
    return from_document(document(dw.load(CAM.folder / "presets" / f"{name}.toml")) | changes)


def outputs_of(spec, keys, design, analyses=ANALYSES):
    """{name: number} of a run of one design; none where it is refused."""
    tables = document(spec)
    for key, number in zip(keys, design, strict=True):
        set_key(tables, key, key_kind(spec, key).given(number))
    try:
        changed = from_document(tables, type(spec))
        answers = run_analyses(changed, CAM.build(changed), select_analyses(CAM.analyses, analyses)).values()
    except DrivewrightError:
        return {}
    values = {name: value for answer in answers for name, value in answer.values.items()}
    return {name: output.value for name, output in case_outputs(values, [check for a in answers for check in a.checks]).items()}


def designs_of(ranges, count=12):
    low, high = np.array(list(ranges.values())).T
    return np.random.default_rng(7).uniform(low, high, (count, len(low)))


def assert_same(spec, ranges, analyses=ANALYSES, count=12):
    """The batch equals the runs in every name that any of them has; how many of the designs were refused."""
    keys, designs = tuple(ranges), designs_of(ranges, count)
    runs = [outputs_of(spec, keys, design, analyses) for design in designs]
    names = tuple(dict.fromkeys(name for run in runs for name in run if name not in BEYOND))
    evaluate = CAM.batch(spec, keys, names)
    assert evaluate is not None
    found = evaluate(designs)
    for name in names:
        alone = np.array([run.get(name, np.nan) for run in runs])
        size = np.nanmax(np.abs(alone))
        np.testing.assert_allclose(found[name], alone, rtol=1e-9, atol=1e-7 if name.endswith(".at") else 1e-12 * size, err_msg=name)
    return sum(not run for run in runs)


@pytest.mark.parametrize("name", RANGES)
def test_the_batch_gives_what_the_runs_give(name):
    refused = assert_same(preset(name), RANGES[name])
    assert refused < 6
    assert refused or name == "conjugate"


def test_a_flat_face_on_a_lever():
    spec = from_document(
        {"mechanism": "cam", "follower": LEVER, "programme": [{"angle": "120 deg", "law": "modified-sine", "rise": "12 deg"}, *TURN[1:]]}
    )
    assert assert_same(spec, {"follower.base_radius": (0.01, 0.07), "follower.pivot_distance": (0.05, 0.1)}, count=24) > 0


def test_each_design_has_a_motion_of_its_own():
    """A part of constant velocity beyond 1 is refused; the others have their own pieces, peaks and phases."""
    spec = preset("default", programme=[{"angle": "120 deg", "law": "mcv", "c": 0.3, "rise": "18 mm"}, *SLIDE])
    assert assert_same(spec, {"programme.0.c": (-0.1, 1.1), "follower.prime_radius": (0.02, 0.05)}) > 0
    spec = from_document({"mechanism": "cam", "follower": LEVER, "programme": TURN})
    assert_same(spec, {"programme.0.c": (0.1, 0.9)}, count=6)


def test_few_motions_are_shared_by_many_designs():
    spec = preset("default", programme=[{"angle": "120 deg", "law": "mcv", "c": 0.3, "rise": "18 mm"}, *SLIDE])
    keys, names = ("follower.offset", "programme.0.c"), ("max_pressure_angle", "max_acceleration", "check.continuity.acceleration")
    designs = np.stack(np.meshgrid([-0.004, 0.001, 0.003], [0.2, 0.45]), axis=-1).reshape(-1, 2)
    evaluate = CAM.batch(spec, keys, names)
    found, runs = evaluate(designs), [outputs_of(spec, keys, design) for design in designs]
    for name in names:
        np.testing.assert_allclose(found[name], [run[name] for run in runs], rtol=1e-9)


def test_a_cam_of_which_nothing_is_left_is_refused_among_others():
    """The roller sinks over the axis at 7 mm; at 15 mm its lowest place is clear."""
    dip = [{"angle": "180 deg", "law": "cycloidal", "rise": rise} for rise in ("-20 mm", "20 mm")]
    spec, keys = preset("default", programme=dip), ("follower.prime_radius", "follower.roller_radius")
    designs = np.array([[0.040, 0.006], [0.026, 0.0065], [0.030, 0.006], [0.0262, 0.006], [0.0262, 0.0063]])
    found = CAM.batch(spec, keys, ("min_convex_radius",))(designs)["min_convex_radius"]
    alone = [outputs_of(spec, keys, design).get("min_convex_radius", np.nan) for design in designs]
    assert np.isnan(alone).tolist() == [False, True, False, False, True]
    np.testing.assert_allclose(found, alone, rtol=1e-9)


@pytest.mark.parametrize(
    ("keys", "names"),
    [
        (("follower.face",), ("lift",)),
        (("spring.preload",), ("profile.area",)),
        (("load.mass",), ("vibration.max_error",)),
        (("groove.clearance",), ("lift",)),
        (("programme.0.law",), ("lift",)),
        (("follower.base_radius",), ("no such value",)),
    ],
)
def test_what_is_beyond_the_batch_runs_one_by_one(keys, names):
    assert CAM.batch(preset("default"), keys, names) is None


def test_only_the_measures_of_the_names_are_taken(monkeypatch):
    """No curvature where only the pressure angle is wanted."""
    evaluate = CAM.batch(preset("default"), ("follower.prime_radius",), ("max_pressure_angle",))
    monkeypatch.setattr(cams, "min_pitch_radius", None)
    assert np.isfinite(evaluate(np.array([[0.03], [0.04]]))["max_pressure_angle"]).all()


@pytest.mark.slow
def test_a_search_by_the_batch_finds_the_cam_that_a_search_by_runs_finds(monkeypatch):
    table = {
        "population": 8,
        "generations": 4,
        "unknowns": [{"key": "follower.prime_radius", "lower": "30 mm", "upper": "80 mm"}],
        "objectives": [{"value": "min_convex_radius"}],
        "requirements": [{"value": "check.pressure_angle"}, {"value": "max_pressure_angle", "at_most": "25 deg"}],
    }
    spec = preset("default", optimise=table)
    by_batch = dw.optimise(spec)
    monkeypatch.setattr("drivewright.studies.search.evaluator.compiled", lambda problem: None)
    by_runs = dw.optimise(spec, workers=1)
    for name, column in by_runs.history.items():
        np.testing.assert_allclose(by_batch.history[name], column, rtol=1e-9)
    assert by_batch.feasible and by_runs.feasible


@pytest.mark.parametrize("name", [name if name == "default" else pytest.param(name, marks=pytest.mark.slow) for name in RANGES])
def test_who_else_is_in_the_batch_changes_no_bit(name):
    spec, designs = preset(name), designs_of(RANGES[name], 20)
    names = tuple(outputs_of(spec, (), ()))
    evaluate = CAM.batch(spec, tuple(RANGES[name]), names)
    together, alone = evaluate(designs), [evaluate(design[None]) for design in designs]
    for each in names:
        np.testing.assert_array_equal(together[each], [one[each][0] for one in alone], err_msg=each)


FORCES = {"load.mass": (0.1, 2.0), "load.force": (-20.0, 10.0), "load.damping": (0.0, 20.0), "spring.preload": (0.0, 60.0)}
DRIVE = {"spring.stiffness": (0.0, 2e4), "drive.speed": (10.0, 160.0), "face.width": (0.004, 0.02), "limits.contact_pressure": (5e8, 2e9)}


def test_forces_spring_and_pressure_of_many_loads():
    """Some springs hold the follower at no stiffness, some followers leave the cam at rest, some at no speed."""
    spec, ranges = preset("default"), FORCES | DRIVE | {"follower.roller_radius": (0.004, 0.039)}
    assert assert_same(spec, ranges, count=20) == 0
    designs = designs_of(ranges, 40)
    found = CAM.batch(spec, tuple(ranges), names := ("spring.needed_stiffness", "spring.jump_speed", "max_contact_pressure"))(designs)
    absent = {name: int(np.isnan(found[name]).sum()) for name in names}
    assert 0 < absent["spring.needed_stiffness"] < 40 and 0 < absent["max_contact_pressure"] < 40
    assert 0 < np.sum(found["spring.jump_speed"] == 0) < 40


@pytest.mark.parametrize("name", ["groove", pytest.param("conjugate", marks=pytest.mark.slow)])
def test_forces_that_change_the_surface(name):
    assert_same(preset(name), {"load.mass": (0.1, 2.0), "load.force": (-40.0, 40.0), "drive.speed": (5.0, 60.0)})


def test_a_follower_without_any_load_has_no_forces_among_others_that_have():
    spec = preset("groove", load={"mass": "1 kg"})
    names = ("max_torque", "max_contact_force", "max_pressure_angle")
    found = CAM.batch(spec, ("load.mass",), names)(np.array([[1.0], [0.0], [2.0]]))
    runs = [outputs_of(spec, ("load.mass",), (mass,)) for mass in (1.0, 0.0, 2.0)]
    for name in names:
        np.testing.assert_allclose(found[name], [run.get(name, np.nan) for run in runs], rtol=1e-9)
    assert np.isnan(found["max_torque"]).tolist() == [False, True, False]


@pytest.mark.parametrize("name", RANGES)
def test_profiles_are_trimmed_only_where_they_may_be_undercut(name, monkeypatch):
    """Of wide ranges some designs are undercut, and have the numbers of a run; near the preset none is trimmed at all."""
    wide = {key: bounds for key, bounds in RANGES[name].items() if key != "follower.face_angle"}
    assert_same(preset(name), wide, ("profile",), count=8)
    spec, key = preset(name), next(iter(RANGES[name]))
    names = [each for each in outputs_of(spec, (), (), ("profile",)) if each not in BEYOND]
    monkeypatch.setattr(cams, "finished_profile", lambda *told: pytest.fail("trimmed"))
    own = value_at(spec, key)
    found = CAM.batch(spec, (key,), names)(np.array([[own], [1.01 * own]]))
    assert all(np.isfinite(column).all() for column in found.values())


@pytest.mark.slow
def test_bore_hub_and_cutter_may_vary_and_an_undercut_cam_loses_motion():
    spec = preset("default")
    ranges = {"manufacture.bore": (0.005, 0.03), "manufacture.hub_diameter": (0.03, 0.07), "follower.roller_radius": (0.02, 0.0399)}
    assert assert_same(spec, ranges, ("profile", "geometry"), count=16) == 0
    lost = CAM.batch(spec, tuple(ranges), ("lost_motion", "profile.min_radius"))(designs_of(ranges, 16))["lost_motion"]
    assert 0 < np.sum(lost > 0) < 16
