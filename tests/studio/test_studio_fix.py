"""The smallest change with which a failed check passes, and the seconds of each analysis, as the page asks for them."""

from dataclasses import replace
from types import SimpleNamespace

import pytest
from study_toy import TOY, install

from drivewright import runner
from drivewright.errors import InputError, UnknownName
from drivewright.registry import Analysis
from drivewright.result import Answer, Check
from drivewright.spec import from_document
from drivewright.studio.design import Design
from drivewright.studio.jobs import fix as fixing
from drivewright.studio.jobs import timing

pytestmark = pytest.mark.interface


def checks(spec):
    """Area from 200 mm², which 14.2 mm reach; two that turn with it, one that passes, and one without a number."""
    return (
        Check("area", spec.size**2, 2e-4, ">=", "m^2", "area", label="Area"),
        Check("side", spec.size, 0.0141, ">=", "m", "side", label="Side"),
        Check("short", spec.size, 0.014, "<=", "m", "short", label="Short"),
        Check("force", spec.force, 9.0, "<=", "N", "force", label="Force"),
        Check("chance", spec.size, 0.5, ">=", "m", "chance", label="Chance", low=0.008, high=0.012),
        Check("endless", float("nan"), 1.0, "<=", "m", "endless", label="Endless"),
    )


@pytest.fixture
def design(monkeypatch):
    drive = replace(
        TOY,
        analyses=(Analysis("main", lambda spec, done: Answer(checks=checks(spec)), "what it is"),),
        adjustable={"size": 2.0, "force": 2.0},
    )
    install(monkeypatch.setattr, drive)
    return Design({"mechanism": "toy", "size": "10 mm"})


def fixed(design, check, news=None, **more):
    return fixing.fix(design, lambda *each: (news if news is not None else []).append(each), check, **more)


def passes(design, changes, check):
    """Whether a check passes in the design with the changes."""
    result = runner.run(from_document({**design.tables, **changes}))
    return next(each.ok for each in result.checks if each.name == check)


def test_the_change_passes_in_a_run_and_says_what_turns_with_it(design):
    news = []
    found = fixed(design, "area", news)
    assert found["changes"] == [{"key": "size", "label": found["changes"][0]["label"], "before": "10\u00a0mm", "given": "14.2 mm"}]
    assert found["load"] == {"size": "14.2 mm"} and not passes(design, {}, "area") and passes(design, found["load"], "area")
    assert found["value"].startswith("201.6") and found["limit"].startswith("≥") and "200" in found["limit"]
    assert found["also_passes"] == ["Side"] and found["then_fails"] == ["Short"]
    assert found["reason"] == "" and found["stopped"] is False and found["check"] == "area"
    assert any("design 1 is being computed" in text for _, _, text, *_ in news)


def test_a_locked_key_stays_and_without_a_free_one_there_is_no_change(design):
    found = fixed(design, "area", locks=["size"])
    assert (
        found["changes"] == []
        and found["load"] == {}
        and found["reason"] == "no change of one or two dimensions within their ranges makes this check pass"
    )
    assert fixed(design, "area", locks=["size", "force"])["reason"] == "no dimension that may change is free; unlock one"


@pytest.mark.parametrize(
    ("check", "reason"),
    [("chance", "the value of this check has an interval"), ("endless", "this check has no number that a change could improve")],
)
def test_what_no_change_can_be_found_for_says_why(design, check, reason):
    found = fixed(design, check)
    assert found["changes"] == [] and found["reason"].startswith(reason) and not found["stopped"]


@pytest.mark.parametrize("check", ["chance", "endless"])
def test_for_a_check_that_no_change_can_improve_nothing_is_tried(design, monkeypatch, check):
    """Not one design: half a minute of them would say no more."""
    monkeypatch.setattr(fixing, "advise", lambda *given, **more: pytest.fail("a change was looked for"))
    assert fixed(design, check)["changes"] == []


def test_a_check_that_passes_or_is_none_is_refused(design):
    with pytest.raises(InputError, match="Force: this check passes"):
        fixed(design, "force")
    for name in ("", "__class__", "areas"):
        with pytest.raises(UnknownName):
            fixed(design, name)


def test_the_time_is_limited_and_ten_times_longer_on_request(design, monkeypatch):
    asked = []

    def slowly(result, seconds, checks, held, tried):
        asked.append((seconds, checks, held))
        return SimpleNamespace(advice_stopped=True, advice=())

    monkeypatch.setattr(fixing, "advise", slowly)
    found = fixed(design, "area", locks=["force"])
    assert found["stopped"] and found["reason"] == "no change was found within 30 s"
    assert fixed(design, "area", longer=True)["reason"] == "no change was found within 300 s"
    assert [given for _, *given in asked] == [[("area",), {"force"}], [("area",), set()]]
    assert [seconds for seconds, *_ in asked] == [pytest.approx(30, abs=5), pytest.approx(300, abs=5)]


def test_a_run_that_did_not_end_gives_no_change(design, monkeypatch):
    run = runner.run
    monkeypatch.setattr(fixing.runner, "run", lambda spec, progress: replace(run(spec), outcome="partial"))
    monkeypatch.setattr(fixing, "advise", lambda *given, **more: SimpleNamespace(advice_stopped=False, advice=()))
    assert fixed(design, "area")["reason"] == "the run of this design did not end, so no change can be compared with it"


# -- timing --------------------------------------------------------------------------------------------------------------------


def timed(monkeypatch, *runs):
    """(answer of the job, number of runs) where the runs take so long."""
    left = list(runs)
    monkeypatch.setattr(timing.runner, "run", lambda spec, progress: SimpleNamespace(timings=left.pop(0)))
    return timing.timing(SimpleNamespace(spec_on_screen=lambda: None), lambda *news: None), len(runs) - len(left)


def test_the_shorter_of_two_runs_counts_unless_the_first_is_long(monkeypatch):
    assert timed(monkeypatch, {"a": 3.0, "b": 0.2}, {"a": 0.1, "b": 0.5}) == ({"timings": {"a": 0.1, "b": 0.2}}, 2)
    assert timed(monkeypatch, {"a": 3.0}, {}) == ({"timings": {"a": 3.0}}, 2)
    assert timed(monkeypatch, {"a": 25.0}, {"a": 0.1}) == ({"timings": {"a": 25.0}}, 1)
