"""One run: which analyses, in which order, and what becomes of those that cannot be done."""

import math
import pickle
from pathlib import Path

import numpy as np
import pytest
from spec_cases import ToySpec

from drivewright import registry, runner
from drivewright.errors import DrivewrightError, InputError, MissingExtra, SolverError, SpecError, UnknownName
from drivewright.registry import Analysis
from drivewright.result import Answer, Value

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


def test_the_user_s_mistake_found_by_an_analysis_is_no_partial_result(kind):
    def refuse(model, done):
        raise InputError("the loop does not close")

    kind(Analysis("a", refuse, ""))
    with pytest.raises(InputError, match="does not close"):
        runner.run(SPEC)


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
