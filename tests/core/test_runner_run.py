"""One run: which analyses, in which order, and what becomes of those that cannot be done."""

import math
import pickle
import time
from pathlib import Path

import numpy as np
import pytest
from spec_cases import ToySpec

from drivewright import cases, registry, runner
from drivewright.errors import DrivewrightError, InputError, MissingExtra, SolverError, SpecError, UnknownName
from drivewright.registry import Analysis
from drivewright.result import Answer, Check, Column, Table, Value, merge_answers
from drivewright.stops import Stop, collect_stops, note_stop

pytestmark = pytest.mark.interface

SPEC = ToySpec(length="40 mm", title="a toy")


class Model:
    """A model that is false as a boolean, as an empty sequence of parts would be."""

    findings = ("the model has something to say",)

    def __bool__(self):
        return False


@pytest.fixture
def kind(monkeypatch):
    """Makes the analyses of the toy; returns the list of names that were answered, in order."""
    log = []

    def install(*analyses, build=lambda spec: Model()):
        def logged(analysis):
            def answer(model, done):
                log.append(analysis.name)
                return analysis.answer(model, done)

            return Analysis(analysis.name, answer, analysis.meaning, analysis.default, analysis.needs, analysis.missing)

        toy = registry.Mechanism("toy", "a toy that runs", ToySpec, build, tuple(map(logged, analyses)), Path(), sources=("a book",))
        monkeypatch.setattr(registry, "mechanism", lambda kind: toy)
        return log

    return install


def says(**values):
    return lambda model, done: Answer({name: Value(value, "m", f"meaning of {name}") for name, value in values.items()}, data=values)


def gives_up(model, done):
    raise SolverError("no convergence after 50 steps; raise `max_steps`", partial=Answer({"half": Value(0.5, "m", "half way")}))


def needs_extra(model, done):
    raise MissingExtra("the solid check", "fe")


def test_defaults_run_in_the_order_of_their_needs_and_only_once(kind):
    log = kind(
        Analysis("c", says(c=3.0), "third", needs=("b",)),
        Analysis("a", says(a=1.0), "first"),
        Analysis("b", says(b=2.0), "second", default=False, needs=("a",)),
        Analysis("d", says(d=4.0), "asked", default=False),
    )
    result = runner.run(SPEC)
    assert log == ["a", "b", "c"] and {name: v.value for name, v in result.values.items()} == {"a": 1.0, "b": 2.0, "c": 3.0}
    assert result["b"] == 2.0 and result.provenance["analyses"] == log and result.outcome == "complete"
    assert "analysis 'd' (asked) runs on request: --only d" in result.findings and Model.findings[0] in result.findings


def test_a_later_analysis_sees_the_answers_it_needs(kind):
    kind(
        Analysis("a", says(a=1.0), "first"),
        Analysis("b", lambda model, done: says(b=done["a"].data["a"] + 1)(model, done), "second", needs=("a",)),
    )
    assert runner.run(SPEC)["b"] == 2.0


@pytest.mark.parametrize(
    ("only", "everything", "names"),
    [
        ((), False, ["a"]),
        ((), True, ["a", "b", "c"]),
        (("c",), False, ["b", "c"]),
        (("b", "a"), False, ["a", "b"]),
        ("b", False, ["b"]),
        (("c",), True, ["b", "c"]),
    ],
)
def test_only_does_exactly_those_named_and_what_they_need(kind, only, everything, names):
    log = kind(Analysis("a", says(), ""), Analysis("b", says(), "", default=False), Analysis("c", says(), "", default=False, needs=("b",)))
    result = runner.run(SPEC, only=only, everything=everything)
    assert log == names
    assert not [f for f in result.findings if "on request" in f] or (not only and not everything)


def test_a_result_knows_the_analysis_of_each_check_and_how_long_each_took(kind):
    def slow(spec, done):
        time.sleep(0.05)
        return Answer(checks=(Check("late", 1.0, 2.0, "<=", "-", "late"),))

    kind(
        Analysis("fast", lambda spec, done: Answer(checks=(Check("early", 1.0, 2.0, "<=", "-", "early"),)), "a"),
        Analysis("slow", slow, "b"),
        Analysis("last", lambda spec, done: Answer(), "c"),
    )
    result = runner.run(SPEC)
    assert result.check_sources == {"early": "fast", "late": "slow"}
    assert list(result.timings) == ["fast", "slow", "last"]
    assert max(result.timings, key=result.timings.get) == "slow" and result.timings["slow"] >= 0.05
    assert sum(result.timings.values()) <= result.provenance["seconds"] + 1e-3


def test_one_analysis_may_be_named_without_a_list(kind):
    log = kind(Analysis("motion", says(), ""), Analysis("forces", says(), ""))
    runner.run(SPEC, only="forces")
    assert log == ["forces"]


def test_an_unknown_analysis_is_refused_before_anything_is_built(kind):
    kind(Analysis("motion", says(), ""), build=lambda spec: pytest.fail("built"))
    with pytest.raises(UnknownName, match="no analysis is called 'moton' .did you mean 'motion'.*; known: motion"):
        runner.run(SPEC, only=("moton",))


def test_what_is_left_out_says_why_and_takes_its_dependants_along(kind):
    log = kind(
        Analysis("a", needs_extra, "solid"),
        Analysis("b", says(b=1.0), "on top", needs=("a",)),
        Analysis("c", says(c=1.0), "apart"),
        Analysis("d", says(d=1.0), "forces", missing=lambda spec: f"[drive] is not given for {spec.title}"),
    )
    result = runner.run(SPEC)
    assert log == ["a", "c"] and set(result.values) == {"c"} and result.outcome == "complete"
    assert (
        result.findings[1].startswith("analysis 'a' (solid) is left out: the solid check needs the extra 'fe'")
        and "pip install" in result.findings[1]
    )
    assert result.findings[2:] == (
        "analysis 'b' (on top) is left out: it needs 'a', which is left out",
        "analysis 'd' (forces) is left out: [drive] is not given for a toy",
    )


def test_an_analysis_asked_for_by_name_that_is_left_out_is_a_warning_and_what_it_needs_is_not(kind):
    kind(Analysis("a", needs_extra, "solid"), Analysis("b", says(b=1.0), "on top", needs=("a",)), Analysis("c", says(c=1.0), "apart"))
    result = runner.run(SPEC, only=("b", "c"))
    (told,) = result.warnings
    assert told == "analysis 'b' (on top) is left out: it needs 'a', which is left out"
    assert result.findings.count(told) == 1
    assert result.findings[0] == told
    assert set(result.left_out) == {"a", "b"}
    assert result.left_out["b"] == told
    assert runner.run(SPEC).warnings == () != runner.run(SPEC).left_out


def test_an_analysis_may_leave_itself_out_without_a_word(kind):
    kind(Analysis("a", lambda model, done: Answer(outcome="left out"), "silent"))
    result = runner.run(SPEC, only="a")
    assert result.left_out == {"a": ""}
    assert result.warnings == ()


def test_warnings_of_all_analyses_come_first_among_the_findings(kind):
    kind(
        Analysis("a", lambda model, done: Answer(findings=("all is told",), warnings=("pins slip",)), "first"),
        Analysis("b", lambda model, done: Answer(warnings=("oil boils",)), "second"),
    )
    result = runner.run(SPEC)
    assert result.warnings == ("pins slip", "oil boils") and result.outcome == "complete" and result.ok
    assert result.findings == ("pins slip", "oil boils", *Model.findings, "all is told")
    answers = [Answer(warnings=("one",)), Answer(), Answer(warnings=("two",))]
    assert merge_answers(answers).warnings == ("one", "two")


def test_analyses_that_fail_for_one_reason_say_it_once(kind):
    kind(Analysis("a", gives_up, "balance"), Analysis("c", says(c=1.0), "apart"), Analysis("d", gives_up, "forces"))
    result = runner.run(SPEC)
    assert result.findings[1:] == ("analyses 'a', 'd' fail alike; each gave up: no convergence after 50 steps; raise `max_steps`",)
    assert result.outcome == "partial" and result.provenance["failed"] == ["a", "d"]


def test_a_solver_that_gives_up_leaves_a_partial_result_with_what_it_had(kind):
    log = kind(Analysis("a", gives_up, "balance"), Analysis("b", says(b=1.0), "on top", needs=("a",)), Analysis("c", says(c=1.0), "apart"))
    result = runner.run(SPEC)
    assert result.outcome == "partial" and log == ["a", "c"] and set(result.values) == {"half", "c"}
    assert "analysis 'a' (balance) gave up: no convergence after 50 steps; raise `max_steps`" in result.findings
    assert "analysis 'b' (on top) is left out: it needs 'a', which is partial" in result.findings


def test_a_partial_answer_with_data_can_be_built_on(kind):
    kind(
        Analysis("a", lambda model, done: Answer(outcome="partial", data=7.0), "most of it"),
        Analysis("b", lambda model, done: says(b=done["a"].data)(model, done), "on top", needs=("a",)),
    )
    result = runner.run(SPEC)
    assert result.outcome == "partial" and result["b"] == 7.0
    assert runner.run_analyses(SPEC, Model(), registry.mechanism("toy").analyses)["b"].outcome == "partial", (
        "no more complete than what it needs"
    )


def raises(error):
    def answer(model, done):
        raise error

    return answer


def test_a_design_that_an_analysis_cannot_answer_keeps_the_other_answers(kind):
    kind(Analysis("a", raises(SpecError("holds no two teeth", "dynamics.duration")), "running"), Analysis("b", says(b=1.0), "apart"))
    result = runner.run(SPEC)
    assert result.outcome == "partial" and result["b"] == 1.0
    assert "analysis 'a' (running) has no answer for this design: dynamics.duration: holds no two teeth" in result.findings


FAULTS = (
    ValueError("odd"),
    FloatingPointError("overflow"),
    np.linalg.LinAlgError("Singular matrix"),
    KeyError("x"),
    RecursionError("deep"),
    AssertionError(),
    UserWarning("rank"),
)


@pytest.mark.faults
@pytest.mark.parametrize("error", FAULTS, ids=lambda e: type(e).__name__)
def test_a_fault_of_ours_is_a_finding_that_says_what_to_report(kind, error, capsys):
    kind(Analysis("a", raises(error), "balance"), Analysis("b", says(b=1.0), "apart"))
    result = runner.run(SPEC)
    (finding,) = (f for f in result.findings if "balance" in f)
    assert result.outcome == "partial" and result["b"] == 1.0 and not capsys.readouterr().err
    wanted = (
        "analysis 'a' (balance) failed by a fault of the program, not of the spec",
        type(error).__name__,
        "toy",
        SPEC.digest(),
        runner.versions()["drivewright"],
        "--debug",
    )
    assert [part for part in wanted if part not in finding] == []


@pytest.mark.faults
def test_a_fault_shows_its_place_where_that_is_asked_for(kind, monkeypatch, capsys):
    monkeypatch.setenv("DRIVEWRIGHT_DEBUG", "1")
    kind(Analysis("a", raises(ValueError("odd")), "balance"))
    runner.run(SPEC)
    told = capsys.readouterr().err
    assert "Traceback" in told and "in answer" in told and told.endswith("ValueError: odd\n")


def test_memory_is_the_machine_s_and_said_as_such(kind):
    kind(Analysis("a", raises(MemoryError()), "solid"), Analysis("b", says(b=1.0), "apart"))
    result = runner.run(SPEC)
    assert result.outcome == "partial" and result["b"] == 1.0
    assert any("'a' (solid) needs more memory than there is" in f for f in result.findings)


@pytest.mark.parametrize("error", [KeyboardInterrupt(), SystemExit(3)], ids=lambda e: type(e).__name__)
def test_what_ends_the_program_ends_the_run(kind, error):
    kind(Analysis("a", raises(error), ""))
    with pytest.raises(type(error)):
        runner.run(SPEC)


def test_a_study_says_which_exceptions_are_not_the_analysis_own(kind):
    kind(Analysis("a", raises(MemoryError()), ""))
    mechanism = registry.mechanism("toy")
    with pytest.raises(MemoryError):
        runner.run_analyses(SPEC, Model(), mechanism.analyses, reraise=(MemoryError,))


@pytest.mark.faults
def test_a_fault_in_what_says_whether_it_can_be_done_is_the_analysis_own(kind):
    kind(Analysis("a", says(), "one", missing=lambda spec: 1 / 0), Analysis("b", says(b=1.0), "apart"))
    result = runner.run(SPEC)
    assert result.outcome == "partial" and result["b"] == 1.0 and any("ZeroDivisionError" in f for f in result.findings)


def test_checks_and_tables_with_numbers_that_do_not_exist_say_so(kind):
    def answer(model, done):
        columns = [
            Column(name, "m", name, np.array(data))
            for name, data in (("x", [0.0, 1.0, 2.0]), ("y", [math.nan, 1.0, math.inf]), ("z", [1.0, math.nan, 3.0]), ("n", [1, 2, 3]))
        ]
        checks = Check("gap", math.nan, 1.0, "<=", "m", "the gap"), Check("size", 2.0, math.inf, ">=", "m", "the size")
        tables = Table("curve", "The curve", tuple(columns)), Table("whole", "A whole one", tuple(columns[:1]))
        return Answer(tables=tables, checks=checks)

    kind(Analysis("a", answer, ""))
    found = [finding for finding in runner.run(SPEC).findings if "exist" in finding]
    assert found == [
        "check 'gap' (the gap) does not exist for this design: nan <= 1.0",
        "check 'size' (the size) does not exist for this design: 2.0 >= inf",
        "table 'curve' (The curve): y, z do not exist in 2 of 3 rows",
    ]


# -- what stopped early --------------------------------------------------------------------------------------------------------

STOP = Stop("the run ends at t = 0.7 s of 3 s", "the limit of 40 steps is reached. Raise max_steps")


def looks(answer, stop=STOP):
    def looking(model, done):
        note_stop(stop)
        return answer(model, done)

    return looking


def test_whatever_looks_at_a_run_that_stopped_is_partial_and_says_until_when(kind):
    kind(
        Analysis("a", looks(says(a=1.0)), ""),
        Analysis("b", says(b=1.0), ""),
        Analysis("c", lambda model, done: says(c=done["a"].data["a"])(model, done), "", needs=("a",)),
        Analysis("d", looks(says(d=4.0)), ""),
        Analysis("e", looks(says(e=4.0), None), ""),
    )
    answers = runner.run_analyses(SPEC, Model(), registry.mechanism("toy").analyses)
    assert {name: answer.outcome for name, answer in answers.items()} == {
        "a": "partial",
        "b": "complete",
        "c": "partial",
        "d": "partial",
        "e": "complete",
    }
    result = runner.run(SPEC)
    assert result.outcome == "partial" and f"{STOP.where}: {STOP.reason}. Partial for that reason: a, c, d" in result.findings
    assert result.values["c"].meaning == f"meaning of c ({STOP.where})" and result.values["b"].meaning == "meaning of b"
    assert runner.run(SPEC, only="b").outcome == "complete"


def test_one_only_analysis_tells_of_the_stop_too(kind):
    kind(Analysis("a", looks(says(a=1.0)), ""), Analysis("d", looks(says(d=4.0)), ""))
    for name in "ad":
        assert runner.run(SPEC, only=name).outcome == "partial"


def test_an_analysis_that_fails_on_a_stopped_run_says_both(kind):
    kind(Analysis("a", looks(raises(SolverError("no peak"))), "peaks"))
    result = runner.run(SPEC)
    assert any("gave up: no peak" in f for f in result.findings) and any(f.startswith(STOP.where) for f in result.findings)


def test_a_stop_is_noted_where_it_was_used_and_nowhere_else():
    note_stop(STOP)  # outside of an analysis nothing happens
    with collect_stops() as outer:
        with collect_stops() as inner:
            note_stop(STOP)
        assert list(inner) == [STOP] and not outer
        note_stop(STOP._replace(reason="again"))
    assert [stop.reason for stop in outer] == ["again"] and list(inner) == [STOP]


@pytest.mark.parametrize("workers", [1, 3])
def test_a_case_that_looks_at_a_stopped_run_is_a_row_with_the_reason(workers):
    def task(case):
        note_stop(STOP if case == 2 else None)
        return 10 * case

    with collect_stops() as stopped:
        found = cases.run(task, [1, 2, 3], workers)
    assert [(row.value, row.reason) for row in found.rows] == [(10, ""), (20, str(STOP)), (30, "")] and not stopped


def test_a_value_that_does_not_exist_is_absent_and_a_finding_says_so(kind):
    kind(Analysis("a", says(good=1.0, jerk=math.inf, hole=np.float64("nan")), ""))
    result = runner.run(SPEC)
    assert set(result.values) == {"good"}
    assert result.findings[1:] == (
        "value 'jerk' (meaning of jerk) does not exist for this design: it is inf",
        "value 'hole' (meaning of hole) does not exist for this design: it is nan",
    )


def test_a_model_built_before_is_used_even_when_it_is_false(kind):
    kind(Analysis("a", lambda model, done: Answer(data=model), ""), build=lambda spec: pytest.fail("built again"))
    runner.run(SPEC, model=Model())


def test_progress_is_told_before_each_analysis(kind):
    log = kind(Analysis("a", says(), ""), Analysis("b", says(), ""))
    told = []
    runner.run(SPEC, progress=lambda done, total, name: told.append((done, total, name, len(log))))
    assert told == [(0, 2, "a", 0), (1, 2, "b", 1)]


def test_a_result_remembers_where_it_came_from(kind):
    kind(Analysis("a", says(a=1.0), ""))
    result = runner.run(SPEC)
    assert (result.spec, result.mechanism, result.title, result.digest) == (SPEC, "toy", "a toy", SPEC.digest())
    assert result.provenance["sources"] == ["a book"] and {"python", "numpy", "drivewright"} <= set(result.provenance["versions"])
    assert runner.run(SPEC.replace(title="")).title == "a toy that runs" and result.provenance["seed"] == 0


# -- errors travel -------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "error",
    [
        UnknownName("value", "forse", ["force", "mass"]),
        MissingExtra("STEP", "fe", "no libGL"),
        SpecError("is wrong", "drive.speed", "x.toml"),
        SolverError("gave up", partial={"x": 1}),
        InputError("plain"),
    ],
    ids=lambda e: type(e).__name__,
)
def test_an_error_survives_the_way_through_a_pool_of_processes(error):
    again = pickle.loads(pickle.dumps(error))
    assert type(again) is type(error) and str(again) == str(error) and vars(again) == vars(error) and isinstance(again, DrivewrightError)


def test_the_hint_is_the_nearest_name_capitals_aside():
    assert "(did you mean 'force'?)" in str(UnknownName("value", "Forse", ["force", "mass"]))
    assert "did you mean" not in str(UnknownName("value", "torque", ["force", "mass"]))
    assert str(SpecError("is wrong", "drive.speed").located(file="x.toml")) == "x.toml: drive.speed: is wrong"
