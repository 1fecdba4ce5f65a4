"""What a worker process does with a design: which analyses go with a drawing, what is told on the way, how answers are merged."""

import json
from types import SimpleNamespace

import pytest
from places import EXAMPLES

from drivewright import registry
from drivewright._jit import compilation
from drivewright.errors import DoesNotAssemble, SpecError
from drivewright.registry import Analysis
from drivewright.result import Check
from drivewright.studio import preview
from drivewright.studio.opening import opened
from drivewright.studio.preview import affordable_analyses, merge_results, page_result

pytestmark = pytest.mark.interface


def analysis(name, *needs):
    return Analysis(name, None, name, needs=needs)


# -- what can be afforded ------------------------------------------------------------------------------------------------------

CHAIN = (analysis("motion"), analysis("forces", "motion"), analysis("wear", "forces"), analysis("oil"))
SECONDS = {"motion": 0.004, "forces": 0.003, "wear": 0.008, "oil": 0.002}


@pytest.mark.parametrize(
    ("budget", "names"),
    [
        (0.0, []),
        (0.0019, []),
        (0.002, ["oil"]),
        (0.0059, ["oil"]),
        (0.0061, ["motion", "oil"]),  # forces is quicker than motion, but costs both
        (0.0089, ["motion", "oil"]),
        (0.0091, ["motion", "forces", "oil"]),
        (0.0169, ["motion", "forces", "oil"]),
        (0.0171, ["motion", "forces", "wear", "oil"]),
    ],
)
def test_the_quickest_go_first_each_with_what_it_needs(budget, names):
    assert affordable_analyses(CHAIN, SECONDS, budget) == names


def test_what_is_needed_is_paid_once():
    both = (analysis("a", "base"), analysis("b", "base"), analysis("base"))
    seconds = {"a": 1.0, "b": 2.0, "base": 4.0}
    assert affordable_analyses(both, seconds, 6.9) == ["a", "base"]
    assert affordable_analyses(both, seconds, 7.1) == ["a", "b", "base"]


def test_nothing_is_run_of_which_nobody_knows_how_long_it_takes():
    assert affordable_analyses(CHAIN, {}, 9.0) == []
    assert affordable_analyses(CHAIN, {"forces": 0.003, "oil": 0.002}, 9.0) == ["oil"]  # forces needs motion
    assert affordable_analyses(CHAIN, {"wear": 0.1, "forces": 0.003, "oil": 0.002}, 9.0) == ["oil"]  # and wear needs it through forces


def test_seconds_of_an_analysis_that_has_gone_say_nothing():
    assert affordable_analyses(CHAIN, SECONDS | {"gone": 0.0}, 9.0) == ["motion", "forces", "wear", "oil"]


# -- merging -------------------------------------------------------------------------------------------------------------------


def named(value, *names):
    return [{"name": name, "value": value} for name in names]


def result(value, *names, unit="deg", **more):
    return {
        "checks": named(value, *names),
        "values": named(value, *names),
        "headline": named(value, *names[:1]),
        "findings": [value],
        "verdict": {"state": "good", "text": "all pass"},
        "fractions": dict.fromkeys(names, value),
        "seconds": value,
        "plots": {"cycle": {"unit": unit, "span": value}, "plots": named(value, *names)},
        **more,
    }


def test_new_answers_replace_their_own_and_the_others_are_stale():
    shown = result(1, "a", "b", "c")
    both = merge_results(shown, result(2, "b"))
    for part in (both["checks"], both["values"], both["plots"]["plots"]):
        assert part == [{"name": "a", "value": 1, "stale": True}, {"name": "b", "value": 2}, {"name": "c", "value": 1, "stale": True}]
    assert both["headline"] == [{"name": "a", "value": 1, "stale": True}]  # what some analyses alone would put first does not join it
    assert both["verdict"] == {"state": "good", "text": "all pass", "stale": True}
    assert both["plots"]["cycle"] == {"unit": "deg", "span": 2}
    assert shown == result(1, "a", "b", "c")


def test_what_is_new_comes_behind():
    both = merge_results(result(1, "a"), result(2, "b", "a"))
    assert both["checks"] == both["values"] == [{"name": "a", "value": 2}, {"name": "b", "value": 2}]
    assert both["plots"]["plots"][0] == {"name": "a", "value": 2}


def test_what_is_renewed_twice_is_not_stale():
    both = merge_results(merge_results(result(1, "a", "b"), result(2, "a")), result(3, "a", "b"))
    assert both["checks"] == [{"name": "a", "value": 3}, {"name": "b", "value": 3}]


def test_bars_follow_the_checks_that_were_renewed():
    assert merge_results(result(1, "a", "b"), result(2, "b"))["fractions"] == {"a": 1, "b": 2}


@pytest.mark.parametrize(
    ("old", "new"),
    [(None, result(2, "a")["plots"]), (result(1, "a")["plots"], None), (result(1, "a")["plots"], result(2, "a", unit="s")["plots"])],
)
def test_plots_over_another_cycle_stay_until_all_are_there(old, new):
    assert merge_results(result(1, "a", plots=old), result(2, "a", plots=new))["plots"] is old


# -- the page's result ---------------------------------------------------------------------------------------------------------


def check(name, value, limit, sense="<="):
    return Check(name, value, limit, sense, "mm", "says so")


@pytest.mark.parametrize(
    ("value", "limit", "sense", "part"),
    [
        (3.0, 4.0, "<=", 0.25),
        (5.0, 4.0, "<=", -0.25),
        (5.0, 4.0, ">=", 0.25),
        (-3.0, -4.0, ">=", 0.25),
        (-5.0, -4.0, ">=", -0.25),
        (1.0, 0.0, ">=", None),
        (float("inf"), 4.0, ">=", None),
        (1.0, 1e-9, ">=", None),
        (float("nan"), 4.0, ">=", None),
    ],
)
def test_a_margin_as_a_part_of_its_limit(value, limit, sense, part):
    assert preview._fraction(check("x", value, limit, sense)) == (part if part is None else pytest.approx(part, rel=1e-12))


@pytest.fixture(scope="module")
def four_bar():
    return opened(EXAMPLES / "four_bar.toml")


@pytest.fixture(scope="module")
def analysed(four_bar):
    """(told, answer) of all default analyses."""
    told = []
    return told, preview.analyse(told.append, four_bar)


def test_all_default_analyses_are_told_and_timed(four_bar, analysed):
    told, found = analysed
    seconds = found["timings"]
    names = [each.name for each in registry.mechanism(four_bar.kind).analyses if each.default]
    places = list(dict.fromkeys((done, total, name) for done, total, name, compiling in told if total))
    assert [name for _, _, name in places] == list(seconds) == found["analyses"] == names
    assert [done for done, _, _ in places] == list(range(len(names))) and {total for _, total, _ in places} == {len(names)}
    assert all(0 < each < found["seconds"] + 1 for each in seconds.values())
    assert 0.5 * found["seconds"] < sum(seconds.values()) < 1.5 * found["seconds"] + 0.1


def test_what_is_compiled_is_told_with_the_analysis_that_waits_for_it(four_bar, monkeypatch):
    def run(spec, only, progress, model):
        progress(2, 9, "motion")
        compilation.tell("multibody.some.kernel", compilation.BEGUN)
        compilation.tell("multibody.some.kernel", compilation.DONE)
        raise SystemExit

    told = []
    monkeypatch.setattr(preview.runner, "run", run)
    with pytest.raises(SystemExit):
        preview.analyse(told.append, four_bar)
    assert [each[:3] for each in told] == [(2, 9, "motion")] * 3
    assert told[0][3] == told[2][3] == "" and told[1][3].startswith("compiling kernels for 'linkage' (each once, when first needed) 1/")


def test_the_result_is_plain_and_whole(analysed):
    found = analysed[1]
    assert json.loads(json.dumps(found, allow_nan=False)) == found
    assert set(found["fractions"]) == {each["name"] for each in found["checks"]}
    assert found["verdict"]["state"] == "good" and found["outcome"] == "complete"
    assert {"motion.rocker", "forces"} <= {plot["name"] for plot in found["plots"]["plots"]}


def test_a_drawing_is_told_before_the_answers(four_bar):
    told = []

    def tell(what):
        told.append(json.loads(what))

    assert preview.draw(tell, four_bar, ()) is None
    assert [set(each) for each in told] == [{"scene", "remarks", "programme", "missing"}]
    assert told[0]["remarks"] == told[0]["missing"] == []
    assert {body["name"] for body in told[0]["scene"]["bodies"]} >= {"crank", "coupler", "rocker"}
    found = preview.draw(tell, four_bar, ["motion"])
    assert told[1] == told[0] and found["analyses"] == ["motion"]
    names = {each["name"] for each in found["values"]}
    assert "rocker.max_angular_acceleration" in names and not any(name.startswith("joints.") for name in names)
    assert found["plots"]["cycle"]["unit"] == told[0]["scene"]["cycle"]["unit"]


def test_what_is_told_beside_a_moving_drawing_is_what_goes_with_one_at_rest(four_bar):
    """Nothing of a mechanism with play, whose run the drawing under a hand leaves out."""
    at_rest, beside = preview.draw(lambda told: None, four_bar, ["motion"]), preview.glance(lambda told: None, four_bar, ["motion"])
    for found in (at_rest, beside):
        del found["seconds"], found["timings"]
    assert beside == at_rest
    assert preview.glance(lambda told: None, opened(EXAMPLES / "slider_crank_clearance.toml"), ["motion"]) is None


def test_a_drawing_follows_the_design(four_bar):
    told = []
    for design in (four_bar, four_bar.changed({"bodies.crank.points.A": ["35 mm", "0 mm"]})):
        preview.draw(told.append, design, ())
    assert told[0] != told[1]


def test_a_design_that_is_none_says_so_before_anything_is_told(four_bar):
    told = []
    for act in (lambda design: preview.draw(told.append, design, ()), lambda design: preview.analyse(told.append, design)):
        with pytest.raises(SpecError, match=r"drive\.speed: wants an angular speed, got '3 kg'"):
            act(four_bar.changed({"drive.speed": "3 kg"}))
    assert told == []


@pytest.mark.parametrize("building", [False, True])
def test_what_cannot_go_round_is_drawn_where_it_begins_with_the_reason(four_bar, building):
    """A crank of 80 mm comes to a position in which the loop does not close."""
    told = []
    assert preview.draw(told.append, four_bar.changed({"bodies.crank.points.A": ["80 mm", "0 mm"]}), (), building) is None
    drawing = json.loads(told[0])
    assert drawing["missing"] == [] and "does not close there" in drawing["remarks"][0]
    bodies = {body["name"] for body in drawing["scene"]["bodies"]}
    assert bodies >= {"crank", "coupler", "rocker"} and any("crank" in handle["key"] for handle in drawing["scene"]["handles"])


@pytest.fixture
def without_a_scene(four_bar, monkeypatch):
    """The mechanism, whose motion cannot be shown."""

    def scene(model):
        raise DoesNotAssemble("the loop stays open")

    known = registry.mechanism(four_bar.kind)
    fake = SimpleNamespace(scene=scene, programme=None, analyses=known.analyses, construction=None)
    monkeypatch.setattr(preview, "registry", SimpleNamespace(mechanism=lambda kind: fake))
    return fake


def test_what_cannot_be_shown_is_remarked_and_still_computed(four_bar, without_a_scene):
    told = []
    found = preview.draw(told.append, four_bar, ["motion"])
    assert json.loads(told[0]) == {"scene": None, "remarks": ["the loop stays open"], "programme": None}
    assert found["plots"]["cycle"] is None and found["values"]
    without_a_scene.scene = None
    preview.draw(told.append, four_bar, ())
    assert json.loads(told[1]) == {"scene": None, "remarks": [], "programme": None}


def test_a_whole_result_without_a_scene_has_no_plots(four_bar, without_a_scene, monkeypatch):
    monkeypatch.setattr(preview.runner, "run", lambda spec, only, progress, model: SimpleNamespace(timings={"a": 1.0}))
    monkeypatch.setattr(preview, "page_result", lambda result, scene, analyses: (scene, analyses))
    assert preview.analyse(lambda told: None, four_bar) == (None, ["a"])
    without_a_scene.scene = None
    assert preview.analyse(lambda told: None, four_bar) == (None, ["a"])


def test_findings_and_the_outcome_come_along(monkeypatch):
    monkeypatch.setattr(preview, "summary", lambda result: {"verdict": "good"})
    checks = (check("near", 3.0, 4.0), check("zero", 1.0, 0.0, ">="))
    made = SimpleNamespace(checks=checks, findings=("beware",), warnings=("beware",), outcome="partial", provenance={"seconds": 2.5})
    made.mechanism, made.timings, made.tables = "indexer", {"stress": 0.2}, {}
    made.value_sources, made.check_sources = {"lift": "profile"}, {"near": "stress"}
    assert page_result(made, None, ["a"]) == {
        "verdict": "good",
        "plots": None,
        "findings": ["beware"],
        "warnings": ["beware"],
        "outcome": "partial",
        "seconds": 2.5,
        "analyses": ["a"],
        "timings": {"stress": 0.2},
        "needs": {"stress": ["profile", "stress"]},
        "sources": {"lift": "profile", "check.near": "stress"},
        "fractions": {"near": 0.25, "zero": None},
        "numbers": {"values": {}, "checks": {"near": [3.0, "mm", None, None, "Near"], "zero": [1.0, "mm", None, None, "Zero"]}},
    }


def numbered(value, checked=1.0):
    """What a result of the page has of one headline value and one check."""
    return {"numbers": {"values": {"lift": (value, "m", None, None, "Stroke")}, "checks": {"bore": (checked, "m", None, None, "Wall")}}}


def test_differences_are_told_as_the_page_of_a_comparison_tells_them():
    first = numbered(20e-3)
    assert preview.differences(first, first) == {"values": {"lift": "0"}, "checks": {"bore": "0"}}
    assert preview.differences(first, numbered(25e-3, 0.5))["values"]["lift"] == "+5\u00a0mm (+25\u00a0%)"
    assert preview.differences({"numbers": {"values": {}, "checks": {}}}, first) == {"values": {}, "checks": {}}


def test_numbers_of_renewed_analyses_take_over():
    both = merge_results(
        {**result(1, "a"), **numbered(1.0, 2.0)}, {**result(2, "a"), "numbers": {"values": {"lift": (3.0, "m", None, None, "Stroke")}}}
    )
    assert both["numbers"] == {"values": {"lift": (3.0, "m", None, None, "Stroke")}, "checks": {"bore": (2.0, "m", None, None, "Wall")}}


def test_warming_loads_every_kind_and_tells_nothing(monkeypatch):
    loaded = []
    monkeypatch.setattr(preview, "registry", SimpleNamespace(kinds=lambda: ["a", "b"], mechanism=loaded.append))
    preview.warm(None)
    assert loaded == ["a", "b"]


def test_plots_are_sent_without_the_panels_that_a_page_has():
    one, two = [{"id": "a/x"}], [{"id": "b/x"}]
    plots = {"cycle": None, "plots": [{"name": "a", "panels": one, "stale": True}, {"name": "b", "panels": two}], "first": ["a/x"]}
    told = preview.without_known(plots, {"a": one, "b": [{"id": "b/x"}]})
    assert told == {**plots, "plots": [{"name": "a", "stale": True}, {"name": "b", "panels": two}]}, "the same object, not an equal one"
    assert preview.without_known(plots, {}) == plots and preview.without_known(None, {}) is None
