"""Many pin wheels at once: stiffness, loads of pins and bearings, checks, value by value beside the runs."""

import sys
from dataclasses import replace

import numpy as np
import pytest
from places import EXAMPLES

import drivewright as dw
from drivewright import registry
from drivewright.errors import DrivewrightError
from drivewright.execution.keys import key_kind
from drivewright.execution.outputs import case_outputs
from drivewright.indexing.batch import sampled
from drivewright.indexing.plane import contacts_at
from drivewright.indexing.stiffness import newton
from drivewright.indexing.stiffness.newton import minimise_by_position
from drivewright.mechanisms.indexer.geometry import play_answer
from drivewright.mechanisms.indexer.stiffness import dwell_stiffness, pin_loads, secant_stiffness
from drivewright.runner import run_analyses, select_analyses
from drivewright.spec import document, from_document, set_key

pytestmark = pytest.mark.property

INDEXER = registry.mechanism("indexer")
STIFFNESS = ("stiffness.undefined_fraction", "stiffness.mean", "stiffness.minimum", "stiffness.maximum", "stiffness.range")
PINS = ("pins.max_force", "pins.max_pressure", "check.contact_pressure")
DWELL = ("dwell.undefined_fraction", "dwell.stiffness.minimum", "dwell.pins.max_force", "check.held.dwell")


def indexer(**changes):
    return from_document(document(dw.load(EXAMPLES / "pin_indexer.toml")) | changes)


def outputs_of(spec, keys, design, analyses):
    """{name: number} of a run of one design; none where it is refused."""
    tables = document(spec)
    for key, number in zip(keys, design, strict=True):
        set_key(tables, key, key_kind(spec, key).given(int(number) if key_kind(spec, key).name == "integer" else number))
    try:
        changed = from_document(tables, type(spec))
        answers = run_analyses(changed, INDEXER.build(changed), select_analyses(INDEXER.analyses, analyses)).values()
    except DrivewrightError:
        return {}
    values = {name: value for answer in answers for name, value in answer.values.items()}
    return {name: output.value for name, output in case_outputs(values, [check for a in answers for check in a.checks]).items()}


def assert_close(spec, keys, designs, names, analyses, rel):
    """The batch gives what the runs give, to `rel`, and nan where these have nothing; the batch's values."""
    found = INDEXER.batch(spec, keys, names)(np.array(designs))
    runs = [outputs_of(spec, keys, design, analyses) for design in designs]
    for name in names:
        alone = np.array([run.get(name, np.nan) for run in runs])
        np.testing.assert_allclose(found[name], alone, rtol=rel, atol=1e-12, err_msg=name)
    return found


def test_stiffness_forces_and_pressure_of_other_sizes_loads_and_parts():
    """A negative size, and pins that overlap, have none; a torque the other way presses the other flanks."""
    keys = ("pin_radius", "eccentricity", "load.torque", "gear.stiffness", "shafts.diameters.2", "cam_width")
    designs = [
        [7.4e-3, 10.3e-3, 800.0, 3.1e8, 0.032, 0.016],
        [8.3e-3, 9.6e-3, -1200.0, 2.0e8, 0.028, 0.021],
        [8e-3, -1e-3, 1000.0, 2.8e8, 0.030, 0.018],
        [35e-3, 10e-3, 1000.0, 2.8e8, 0.030, 0.018],
    ]
    spec = indexer(limits={"stiffness": "1e5 N m/rad", "contact_pressure": "2 GPa"})
    found = assert_close(spec, keys, designs, (*STIFFNESS, "check.stiffness", "check.held", *PINS), ("stiffness",), 2e-4)
    assert np.isfinite(found["stiffness.mean"]).tolist() == [True, True, False, False]
    assert found["stiffness.mean"][0] != pytest.approx(found["stiffness.mean"][1], rel=0.05)


@pytest.mark.parametrize(
    ("changes", "rel"),
    [({}, 3e-4), ({"contact": {"model": "bonded"}}, 1e-3), ({"side": "outside"}, 3e-4), ({"support_bearings": {"bearing": "61904"}}, 3e-4)],
)
def test_random_designs_in_compiled_code_are_those_of_the_runs(changes, rel):
    """Pins that overlap among them; a bearing by its rolling elements has no compiled law.

    Bonded pins carry as long as they touch, which the sampled profile has end a little earlier or later.
    """
    rng = np.random.default_rng(6)
    keys = ("pin_radius", "eccentricity", "load.torque", "shafts.diameters.2", "crank_bearings.radial_clearance")
    designs = rng.uniform((6e-3, 8e-3, -1500.0, 0.02, 0.0), (10e-3, 12e-3, 1500.0, 0.035, 2e-5), (4, 5))
    designs[2, 0] = 40e-3
    names = ("stiffness.mean", "stiffness.undefined_fraction", "pins.max_force", "crank.max_load", "contacts.minimum")
    crank = {"crank_bearings": {"bearing": "NU207E", "law": "liu", "radial_clearance": "5 um"}}
    found = assert_close(indexer(**crank, **changes), keys, designs.tolist(), names, ("contacts", "stiffness", "bearings"), rel)
    assert np.isnan(found["pins.max_force"]).tolist() == [False, False, True, False]


def test_the_equilibria_of_a_batch_are_those_of_numpy():
    built = INDEXER.build(indexer())
    quick = replace(built, drive=sampled(built.wheel))
    for measure in (secant_stiffness, pin_loads, dwell_stiffness):
        ours, theirs = measure(replace(quick, compiled=True)).values, measure(quick).values
        assert {name: value.value for name, value in ours.items()} == pytest.approx(
            {name: value.value for name, value in theirs.items()}, rel=1e-9
        )


def test_a_batch_solves_in_compiled_code_and_a_run_by_numpy(monkeypatch):
    """A single run would wait for the kernel longer than NumPy takes."""
    seen = []
    monkeypatch.setattr(newton, "minimise_by_position", lambda *given: seen.append(given) or minimise_by_position(*given))
    outputs_of(indexer(), (), (), ("stiffness", "bearings"))
    assert not seen
    evaluate = INDEXER.batch(indexer(), ("pin_radius",), ("stiffness.mean", "pins.max_force", "contacts.minimum"))
    seen.clear()
    evaluate(np.array([[8e-3]]))
    assert len(seen) == 2  # at the contacts, and after the play: measures share both


def test_the_dwell_and_other_numbers_of_pins_contacts_and_ratios():
    keys = ("pins", "motion.motion_to_dwell", "contact.pin_stiffness")
    designs = [[12, 1.2, 5e8], [10, 0.9, 4e8], [11, 1.0, 5e8]]  # two cams do not divide 11 pins
    names = (*DWELL, "stiffness.mean", "contacts.minimum", "contacts.maximum")
    found = assert_close(indexer(), keys, designs, names, ("contacts", "stiffness"), 2e-4)
    assert np.isfinite(found["dwell.stiffness.minimum"]).tolist() == [True, True, False]


def test_no_torque_no_stiffness_among_others_that_have():
    found = assert_close(indexer(), ("load.torque",), [[1000.0], [0.0]], ("stiffness.mean", "pins.max_force"), ("stiffness",), 2e-4)
    assert np.isnan(found["stiffness.mean"]).tolist() == [False, True]


def test_loads_of_bearings_and_pressure_angle():
    names = ("crank.max_load", "support.max_load", "support.basic_life", "pressure_angle.maximum", "check.pressure_angle")
    names += ("contacts.minimum", "motion.peak_speed")
    spec = indexer(load={"torque": "900 N m", "speed": "100 rpm"})
    assert_close(spec, ("pin_radius", "load.speed"), [[7.6e-3, 8.0]], names, ("motion", "contacts", "bearings"), 2e-4)


def test_checks_of_play_and_curvature_are_those_of_a_run():
    """Of play the run seeks the peak between the angles: two per cent."""
    names = ("check.play.forward", "check.play.backward", "check.curvature", "play.forward.maximum")
    spec, keys = indexer(limits={"play": "3 arcmin"}), ("pin_radius", "limits.curvature_ratio")
    assert_close(spec, keys, [[7.5e-3, 1.1], [8.4e-3, 1.3]], names, ("profile", "play"), 0.03)


def test_where_nothing_stops_the_wheel_the_check_of_the_play_fails_by_a_pitch_as_in_a_run():
    model, of_batch = INDEXER.build(indexer()), sys.modules["drivewright.mechanisms.indexer.batch"]
    nowhere = {name: np.array([np.nan, 0.1]) for name in ("forward", "backward")}
    numbers = {f"play.{name}.maximum": np.nan for name in nowhere} | {"profile.min_convex_radius": np.nan}
    of_run = {check.name: check for check in play_answer(model, np.array([0.0, 1.0]), nowhere).checks}
    ours = {check.name: check for check in of_batch._checks(model.spec, numbers)}
    for name in ("play.forward", "play.backward"):
        assert ours[name].counted_margin == pytest.approx(of_run[name].counted_margin, rel=1e-12)


def test_contacts_of_the_sampled_profile_are_those_of_the_exact_one():
    model = INDEXER.build(indexer())
    exact, quick = (contacts_at(wheel, model.angles, 2e-3) for wheel in (model.wheel, sampled(model.wheel)))
    for one, other in zip(exact, quick, strict=True):
        np.testing.assert_array_equal(one.pin, other.pin)
        np.testing.assert_array_equal(one.intended, other.intended)
        np.testing.assert_allclose(other.gap, one.gap, atol=1e-7)
        np.testing.assert_allclose(other.arm[one.intended], one.arm[one.intended], rtol=1e-9, atol=1e-12)


def test_a_wheel_of_which_no_cam_is_left_is_refused_among_others():
    designs = np.array([[8e-3, 10e-3], [8e-3, 112.5e-3], [7e-3, 10e-3]])
    found = INDEXER.batch(indexer(), ("pin_radius", "eccentricity"), ("stiffness.mean", "play.forward.maximum"))(designs)
    for column in found.values():
        assert np.isnan(column).tolist() == [False, True, False]


@pytest.mark.parametrize(
    ("keys", "names"),
    [
        (("side",), ("play.forward.maximum",)),
        (("load.angle",), ("play.forward.maximum",)),
        (("housing.support_stiffness",), ("stiffness.mean",)),
        (("pin_radius",), ("no such value",)),
        (("pin_radius",), ("profile.area",)),
        (("shafts.diameters",), ("stiffness.mean",)),
    ],
)
def test_what_is_beyond_the_batch_runs_one_by_one(keys, names):
    tables = document(indexer())
    tables.pop("housing", None)
    assert INDEXER.batch(from_document(tables), keys, names) is None
    assert INDEXER.batch(indexer(load={"torque": "1 kN m", "angle": "40 deg"}), ("pin_radius",), ("stiffness.mean",)) is None


def test_who_else_is_in_the_batch_changes_no_bit():
    names, designs = ("stiffness.mean", "play.forward.maximum"), np.array([[7.4e-3, 900.0], [8e-3, 1000.0], [0.0, 1.0]])
    evaluate = INDEXER.batch(indexer(), ("pin_radius", "load.torque"), names)
    together, alone = evaluate(designs), [evaluate(design[None]) for design in designs]
    for each in names:
        np.testing.assert_array_equal(together[each], [one[each][0] for one in alone], err_msg=each)


@pytest.mark.slow
def test_a_search_by_the_batch_finds_the_indexer_that_a_search_by_runs_finds(monkeypatch):
    table = {
        "population": 8,
        "generations": 1,
        "unknowns": [
            {"key": "pin_radius", "lower": "7 mm", "upper": "9 mm"},
            {"key": "gear.stiffness", "lower": "2e8 N/m", "upper": "4e8 N/m"},
        ],
        "objectives": [{"value": "stiffness.minimum", "goal": "maximise"}],
        "requirements": [{"value": "pins.max_pressure", "at_most": "4 GPa"}],
    }
    spec = indexer(optimise=table)
    by_batch = dw.optimise(spec)
    monkeypatch.setattr("drivewright.studies.search.evaluator.compiled", lambda problem: None)
    by_runs = dw.optimise(spec, workers=1)
    for name, column in by_runs.history.items():
        np.testing.assert_allclose(by_batch.history[name], column, rtol=1e-3)
    assert by_batch.best.spec.pin_radius == pytest.approx(by_runs.best.spec.pin_radius, rel=1e-3)
