"""What a worker process does with a design for the page: the drawing, what follows it at once, and the whole result."""

import json
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, TypeAlias

from drivewright import registry, runner
from drivewright._jit.compilation import Compilation, watched_by
from drivewright.errors import DrivewrightError
from drivewright.execution.outputs import CHECK
from drivewright.registry import Analysis
from drivewright.report.comparison import difference, difference_text
from drivewright.report.content import check_label, summary
from drivewright.report.features import pack_features
from drivewright.report.pack import pack_handles, pack_scene
from drivewright.report.pack_plots import pack_every_plot
from drivewright.report.programme import pack_programme
from drivewright.result import Result, Value
from drivewright.scene import Scene
from drivewright.spec import MechanismSpec
from drivewright.studio.design import Design
from drivewright.studio.input_parsing import form_key
from drivewright.view.panels import known_plots

Number: TypeAlias = list[Any]  # value [SI], its unit, the ends of its interval or None, its label


def warm(send: Callable[[Any], object]) -> None:
    """Load what the first drawing needs."""
    for kind in registry.kinds():
        registry.mechanism(kind)
    runner.versions()


def draw(
    send: Callable[[Any], object], design: Design, affordable: Sequence[str], building: bool = False, moving: bool = False
) -> dict[str, Any] | None:
    """Send the packed scene; answer the page's result of the affordable analyses, None where there are none.

    building: the mechanism stands still at its start, assembled or not, where its kind has tools to build it.
    moving: while a hand moves the design, its quick scene is enough where its kind has one, and nothing is told of what is missing.
    `affordable` names analyses of which an earlier run has shown that a person does not notice the wait.
    """
    spec = design.spec_on_screen()
    construction = registry.mechanism(spec.mechanism).construction
    if building and construction:
        missing = construction.unfinished(spec)
        _send_scene(send, design, spec, construction.sketch(spec), [] if missing else _why_still(spec), missing)
        return None
    try:
        model = runner.build(spec)
    except DrivewrightError:
        if construction:  # what is not assembled is drawn as the spec states it; the error says the rest
            _send_scene(send, design, spec, construction.sketch(spec), [], construction.unfinished(spec))
        raise
    quick = _quick_scene(spec, model) if moving else None
    if construction and not construction.connected(spec):
        scene, remarks = construction.sketch(spec), []
    else:
        scene, remarks = (quick, []) if quick else _scene(spec, model)
        scene = construction.sketch(spec) if construction and scene is None else scene  # what cannot move is drawn at its start
    missing = construction.unfinished(spec) if construction and not moving else None
    _send_scene(send, design, spec, scene, remarks, missing, _programme(spec, model))
    return _quick_result(spec, model, scene, affordable) if affordable else None


def glance(send: Callable[[Any], object], design: Design, affordable: Sequence[str]) -> dict[str, Any] | None:
    """The page's result of the affordable analyses of a design that a hand is moving, without holding up its drawings; None of a kind
    whose drawings leave out, while it moves, what the analyses would have to compute first."""
    spec = design.spec_on_screen()
    model = runner.build(spec)
    return None if _quick_scene(spec, model) else _quick_result(spec, model, _scene(spec, model)[0], affordable)


def _quick_result(spec, model, scene, affordable):
    return page_result(runner.run(spec, only=tuple(affordable), model=model), scene, affordable, quick=True)


def _send_scene(send, design, spec, scene, remarks, missing, programme=None):
    packed = {**pack_scene(scene), "handles": _handles(design, spec, scene), "features": pack_features(scene)} if scene else None
    unfinished = {} if missing is None else {"missing": list(missing)}  # of a kind that is built by tools
    send(json.dumps({"scene": packed, "remarks": remarks, "programme": programme, **unfinished}, allow_nan=False))


def _handles(design: Design, spec: MechanismSpec, scene: Scene) -> list[dict[str, Any]]:
    """The handles with keys as the form has them; `value` [SI] is the number that this drawing was made with."""
    return [
        {
            **handle,
            "key": form_key(design.tables, handle["key"]),
            **({"value": _number(spec, handle["key"])} if "direction" in handle else {}),
        }
        for handle in pack_handles(scene)
    ]


def _number(spec: MechanismSpec, key: str) -> float:
    """The number of a dotted key, elements by their place."""
    value: Any = spec
    for step in key.split("."):
        value = value[int(step)] if isinstance(value, tuple) else getattr(value, step)
    return float(value)


def analyse(send: Callable[[Any], object], design: Design, only: Sequence[str] = ()) -> dict[str, Any]:
    """Send (done, total, analysis, what is compiled for it) on the way; answer the page's result of all default analyses, or of those
    named."""
    place = [(0, 0, "")]

    def step(done, total, name):
        place[0] = done, total, name
        send((*place[0], ""))

    spec = design.spec_on_screen()
    compilation = Compilation(spec.mechanism, lambda: send((*place[0], compilation.words)))
    with watched_by(compilation):
        model = runner.build(spec)
        result = runner.run(spec, only=tuple(only), progress=step, model=model)
    scene, _ = _scene(spec, model)
    return page_result(result, scene, list(result.timings))


def _quick_scene(spec, model):
    """The quick scene of a design that a hand is moving, None where there is none."""
    mechanism = registry.mechanism(spec.mechanism)
    try:
        return mechanism.quick_scene(model) if mechanism.quick_scene else None
    except MemoryError:
        raise
    except Exception:  # the scene itself says what is wrong
        return None


def _scene(spec, model):
    """(the scene or None, the reasons why there is none: that there is none is for the page to say)."""
    mechanism = registry.mechanism(spec.mechanism)
    try:
        return mechanism.scene(model) if mechanism.scene else None, []
    except MemoryError:  # of this process, which may be tried again
        raise
    except Exception as error:  # a drawing that fails must not cost the numbers
        return None, [runner.failure_reason(spec, error)]


def _why_still(spec):
    """Remarks that say why a mechanism that is complete has no motion; none where it moves, or where its analyses say what is wrong."""
    try:
        return _scene(spec, runner.build(spec))[1]
    except DrivewrightError:
        return []


def _programme(spec, model):
    """The packed motion programme, None where the kind has none that can be edited."""
    diagram = registry.mechanism(spec.mechanism).programme
    try:
        return pack_programme(diagram(model)) if diagram else None
    except MemoryError:
        raise
    except Exception:  # one view less must not cost the others
        return None


def page_result(result: Result[Any], scene: Scene | None, analyses: Sequence[str], quick: bool = False) -> dict[str, Any]:
    """Plain dictionary of a result for the page; `analyses` says whose answers it holds, `quick` that a design is just changing."""
    told = summary(result)
    return {
        **told,
        "plots": pack_every_plot(result, scene, tuple(known_plots(result).values()), quick),
        "findings": list(result.findings),
        "warnings": list(result.warnings),
        "outcome": result.outcome,
        "seconds": result.provenance["seconds"],
        "analyses": analyses,
        "timings": dict(result.timings),
        "needs": _needs(result),
        "sources": {**result.value_sources, **{f"{CHECK}{name}": analysis for name, analysis in result.check_sources.items()}},
        "fractions": {check.name: _fraction(check) for check in result.checks},
        "numbers": _numbers(result, [item["name"] for item in told.get("headline", ())]),
    }


def _needs(result: Result[Any]) -> dict[str, list[str]]:
    """{analysis: itself and all that it needs} of those that have run."""
    by_name = {analysis.name: analysis for analysis in registry.mechanism(result.mechanism).analyses}
    return {name: sorted(_needed(name, by_name)) for name in result.timings}


def _numbers(result: Result[Any], names: Iterable[str]) -> dict[str, dict[str, Number]]:
    """The numbers behind the texts of the headline values of those names, and of the checks."""
    checks = {check.name: Value(check.value, check.unit, check_label(check), *(check.bounds or (None, None))) for check in result.checks}
    return {"values": _finite_numbers({name: result.values[name] for name in names}), "checks": _finite_numbers(checks)}


def _finite_numbers(values: Mapping[str, Value]) -> dict[str, Number]:
    """Those that exist, as JSON has them."""
    plain = {name: value.plain() for name, value in values.items() if math.isfinite(value.value)}
    return {name: [value.value, value.unit, value.low, value.high, value.label] for name, value in plain.items()}


def differences(first: Mapping[str, Any], other: Mapping[str, Any]) -> dict[str, dict[str, str]]:
    """{"values", "checks"}: {name: how far the number of one page's result is from that of another, '+1.2 mm (+3.4 %)'}."""

    def told(what):
        known, numbers = first.get("numbers", {}).get(what, {}), other.get("numbers", {}).get(what, {})
        return {name: _difference(known[name], numbers[name]) for name in numbers if name in known}

    return {what: told(what) for what in ("values", "checks")}


def _difference(first: Number, other: Number) -> str:
    one, two = (Value(value, unit, label, low, high) for value, unit, low, high, label in (first, other))
    return difference_text(difference(one, two), two.unit, label=two.meaning)


def _fraction(check):
    """Margin as a part of the limit; None where that says nothing."""
    part = check.margin / abs(check.limit) if check.limit else float("nan")
    return part if abs(part) < 1e6 else None


def merge_results(shown: Mapping[str, Any], update: Mapping[str, Any]) -> dict[str, Any]:
    """What is shown, with the answers of some analyses renewed; checks and plots of the others are marked stale."""

    def renewed(old, new, name):
        fresh = {item[name]: item for item in new}
        known = {item[name] for item in old}
        return [fresh.get(item[name], {**item, "stale": True}) for item in old] + [item for item in new if item[name] not in known]

    checks, values, headline = (renewed(shown[what], update[what], "name") for what in ("checks", "values", "headline"))
    if first := {item["name"] for item in shown["headline"]}:  # some analyses alone have others first, for want of better ones
        headline = [item for item in headline if item["name"] in first]
    return {
        **shown,
        "checks": checks,
        "values": values,
        "headline": headline,
        "plots": _merged_plots(shown["plots"], update["plots"]),
        "timings": {**shown.get("timings", {}), **update.get("timings", {})},
        "sources": {**shown.get("sources", {}), **update.get("sources", {})},
        "fractions": {**shown["fractions"], **update["fractions"]},
        "numbers": _merged_numbers(shown, update),
        "verdict": {**shown["verdict"], "stale": True},
    }


def _merged_numbers(shown, update):
    old, new = shown.get("numbers", {}), update.get("numbers", {})
    return {what: {**old.get(what, {}), **new.get(what, {})} for what in ("values", "checks")}


def _merged_plots(shown, update):
    """Plots of the same name renewed, where the cycle is still the same kind of cycle."""
    if not shown or not update or _cycle_unit(shown) != _cycle_unit(update):
        return shown
    fresh = {plot["name"]: plot for plot in update["plots"]}
    return {**shown, "cycle": update["cycle"], "plots": [fresh.get(plot["name"], {**plot, "stale": True}) for plot in shown["plots"]]}


def without_known(plots: Mapping[str, Any] | None, known: Mapping[str, Any]) -> Mapping[str, Any] | None:
    """Plots without the panels that a page has already: `known` {name: panels}."""

    def told(plot):
        return {key: part for key, part in plot.items() if key != "panels" or part is not known.get(plot["name"])}

    return plots and {**plots, "plots": [told(plot) for plot in plots["plots"]]}


def _cycle_unit(plots: Mapping[str, Any]) -> str | None:
    return plots["cycle"] and plots["cycle"]["unit"]


def affordable_analyses(analyses: Iterable[Analysis[Any, Any]], seconds: Mapping[str, float], budget: float) -> list[str]:
    """Names of the analyses that fit the budget [s], each with what it needs, the quickest first."""
    by_name = {analysis.name: analysis for analysis in analyses}
    chosen, spent = {}, 0.0
    for name in sorted(seconds, key=lambda name: seconds[name]):
        more = {n for n in _needed(name, by_name) if n not in chosen}
        if name not in chosen and all(n in seconds for n in more):
            cost = sum(seconds[n] for n in more)
            if spent + cost <= budget:
                chosen |= dict.fromkeys(more)
                spent += cost
    return [analysis.name for analysis in analyses if analysis.name in chosen]


def _needed(name, by_name):
    """The analysis and all that it needs."""
    return {name}.union(*(_needed(other, by_name) for other in by_name[name].needs)) if name in by_name else {name}
