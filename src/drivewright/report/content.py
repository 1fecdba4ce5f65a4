"""What a report says, as plain text in plain dictionaries: the page and the PDF both print this and nothing else."""

import html
import math
import textwrap
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from drivewright import registry
from drivewright._typing import ArrayLike, Floats
from drivewright.errors import InputError
from drivewright.execution.helper import Map
from drivewright.labels import label_of
from drivewright.report.advice import advice_texts, failed_texts
from drivewright.report.computed import how_computed
from drivewright.report.form import ReportForm
from drivewright.report.letterhead import read_letterhead
from drivewright.report.localised import localised
from drivewright.report.paper_figures import paper_svg
from drivewright.report.solids import MOST_TRIANGLES, SolidSurface, solid_surfaces, with_repeats
from drivewright.report.value_groups import grouped_values
from drivewright.report.words import Words, translated, words_of
from drivewright.result import UNDECIDED, Array, Check, Column, Plot, Result, SpecLike, Table, Value
from drivewright.runner import failure_reason, versions
from drivewright.scene import Drawing, Scene
from drivewright.units import Scale, System
from drivewright.view import draw_drawing, draw_panels, draw_scene, draw_solids, draw_thumbnail, svg
from drivewright.view.motion import fractions
from drivewright.view.panels import drawable, known_plots, panels
from drivewright.view.style import new_figure
from drivewright.view.text import (
    SIGNS,
    ends_shown,
    interval_hint,
    labelled_scale,
    number,
    numbers,
    sentence,
    shown_scale,
    unit_text,
    with_unit,
)

MOST_HEADLINES = 8  # values that are shown first
GHOSTS = tuple(n / 5 for n in range(5))
Content: TypeAlias = dict[str, Any]  # plain text and numbers, as the templates take them
LARGEST_ARRAY = 400  # entries: a larger one is only named; result.json has it


class Picture(NamedTuple):
    """A figure as SVG text, under the file name it gets; `meaning` is a sentence on what it shows, "" where the title is enough."""

    name: str
    title: str
    svg: str
    meaning: str = ""


class Views(NamedTuple):
    """What there is to see of a run besides its numbers; `remarks` say what could not be drawn, `solids` are there where wanted."""

    scene: Scene | None = None
    plots: tuple[Plot, ...] = ()
    drawings: tuple[Drawing, ...] = ()
    remarks: tuple[str, ...] = ()
    solids: tuple[SolidSurface, ...] = ()


def views(result: Result[Any], model: object = None, solids: bool = False) -> Views:
    """What the result's mechanism shows of its spec; a design that cannot be drawn still gets its report, with a remark.

    `model` is the spec's own, where it has been built already; `solids` asks for the parts as solids too.
    """
    if not registry.is_known(result.mechanism):
        return Views(remarks=(f"mechanism {result.mechanism!r} is not installed here: neither motion nor drawings",))
    mechanism = registry.mechanism(result.mechanism)
    model = model or mechanism.build(result.spec)
    scene, no_scene = _shown("motion", mechanism.scene, model, None, result.spec)
    drawings, no_drawings = _shown("drawings", mechanism.drawings, model, (), result.spec)
    surfaces, no_solids = _shown("solids", _surfaces, mechanism, (), result.spec, model) if solids else ((), ())
    return Views(scene, tuple(known_plots(result).values()), tuple(drawings), no_scene + no_drawings + no_solids, surfaces)


def _surfaces(mechanism, model):
    """The surfaces of the parts of a drive; InputError where it has none, or too many triangles."""
    parts = tuple(mechanism.parts(model)) if mechanism.parts else ()
    if not parts:
        raise InputError(f"{mechanism.kind} has none")
    return solid_surfaces(parts, most=MOST_TRIANGLES)


def _shown(what, make, model, nothing, spec, *more):
    """(what was made, remarks)."""
    try:
        return (make(model, *more) if make else nothing), ()
    except Exception as error:  # a picture that fails must not cost the numbers
        return nothing, (f"no {what} to show: {failure_reason(spec, error)}",)


class Sketch(NamedTuple):
    """A figure that is still to be drawn."""

    name: str
    title: str
    draw: Callable[..., Any]
    arguments: tuple[Any, ...]
    meaning: str = ""


def pictures(result: Result[Any], seen: Views, compute: Map = map, language: str = "en", paper: bool = False) -> tuple[Picture, ...]:
    """Every figure of a run: the scene for each observer, the plots, the drawings; `compute` may draw them side by side."""
    return tuple(
        compute(partial(draw_sketch, result.spec, told_in=(language, result.mechanism), paper=paper), list(_sketches(result, seen)))
    )


def _sketches(result, seen):
    scene, system = seen.scene, result.units
    for frame in scene.frames if scene else ():
        yield Sketch(f"scene-{frame.name}", sentence(frame.label), draw_scene, (scene, frame.name, [scene_phase(scene)], GHOSTS, system))
    for plot in drawable(result, seen.plots):
        try:
            yield Sketch(f"plot-{plot.name}", plot.title, draw_panels, (panels(result, plot), _marks(result, plot, scene)), caption(plot))
        except Exception as error:
            yield failing_sketch(f"plot-{plot.name}", plot.title, error)
    if seen.solids:
        yield Sketch("solids", "Solids of the assembly", draw_solids, (with_repeats(seen.solids, scene),))
    for drawing in seen.drawings:
        yield Sketch(f"drawing-{drawing.name}", sentence(drawing.title), draw_drawing, (drawing, system))


def caption(plot: Plot) -> str:
    """The sentence on what a plot shows, with its full stop."""
    text = sentence(plot.meaning)
    return text if not text or text.endswith(".") else f"{text}."


def failing_sketch(name: str, title: str, error: Exception) -> Sketch:
    """A figure that says why it is none."""
    return Sketch(name, title, _fail, (error,))


def _fail(error):
    raise error


def draw_sketch(spec: SpecLike, sketch: Sketch, told_in: tuple[str, str] = ("en", ""), paper: bool = False) -> Picture:
    """The figure as SVG, also as small as `paper` wants it; one that cannot be drawn says why.

    `spec` is what the reason speaks of; `told_in` are a language and a kind of drive, whose words are used."""
    words = words_of(*told_in)
    sketch = sketch._replace(title=words(sketch.title), meaning=words(sketch.meaning))
    try:
        figure = localised(sketch.draw(*sketch.arguments), words, told_in[0])
        return Picture(sketch.name, sketch.title, paper_svg(figure) if paper else svg(figure), sketch.meaning)
    except Exception as error:  # one figure that fails must not cost the others
        return Picture(sketch.name, sketch.title, _instead(f"This figure is missing: {failure_reason(spec, error)}"))


def prepare_drawing() -> None:
    """Load what figures need, by drawing an empty one."""
    svg(new_figure(1.0))


def _instead(text: str) -> str:
    """A picture that says in words why it is none."""
    lines = textwrap.wrap(text, 90)
    spans = "".join(f'<tspan x="10" dy="18">{html.escape(line)}</tspan>' for line in lines)
    size = f'width="640" height="{18 * len(lines) + 20}" viewBox="0 0 640 {18 * len(lines) + 20}"'
    return f'<svg xmlns="http://www.w3.org/2000/svg" {size}><text font-family="sans-serif" font-size="13" y="4">{spans}</text></svg>'


def thumbnail(scene: Scene) -> Picture:
    """The picture of a scene for a gallery."""
    return Picture("thumbnail", "thumbnail", svg(draw_thumbnail(scene, scene_phase(scene))))


def scene_phase(scene: Scene) -> float:
    """The first mark behind the start of the cycle, else 0.3: a machine at its start often shows nothing."""
    marked = np.interp([value for value, _ in scene.marks], *_rising(scene.cycle)) if scene.marks else np.array([])
    return float(next((phase for phase in sorted(marked) if phase > 0), 0.3))


def _rising(cycle: ArrayLike) -> tuple[Floats, Floats]:
    order = np.argsort(cycle)
    return np.asarray(cycle)[order], fractions(cycle)[order]


def _marks(result: Result[Any], plot: Plot, scene: Scene | None) -> tuple[tuple[float, str], ...]:
    """The scene's marks in the unit of the x axis, for a plot over the scene's cycle."""
    if scene is None or plot.table != scene.table or plot.x != result.tables[plot.table].columns[0].name:
        return ()
    shown = shown_scale(scene.cycle_unit, system=result.units)
    return tuple((shown.of(value), label) for value, label in scene.marks)


def content(
    result: Result[Any], remarks: Sequence[str] = (), headlines: Sequence[str] | None = None, form: ReportForm = ReportForm()
) -> Content:
    """Title, verdict, headline, checks, values, arrays, tables, findings, sources, provenance of a result, as far as its form wants them.

    `headlines` names the values shown first; the mechanism's unless given.
    """
    words = words_of(form.language, result.mechanism)
    first = {
        "detail": form.detail,
        "language": form.language,
        "title": words.exact(result.title),
        "mechanism": words.exact(result.mechanism.replace("-", " ")) if form.language != "en" else result.mechanism,
        "version": program(),
        "digest": result.digest,
        "letterhead": read_letterhead(result.spec).content(),
        "warnings": [words(each) for each in result.warnings],
        "cite": f"Drivewright {program()}, {result.mechanism}: {result.title}, digest {result.digest[:12]}.",
    }
    numbers = summary(result, headlines, words)
    groups = {"groups": grouped_values(result, numbers["values"])}
    return first | translated(numbers | groups | _behind_page_one(result, remarks, form), words)


def _behind_page_one(result: Result[Any], remarks: Sequence[str], form: ReportForm) -> Content:
    """What comes after the first page; of that a short report has its warnings alone."""
    if form.detail == "short":
        return {
            "values": [],
            "groups": [],
            "arrays": [],
            "tables": [],
            "findings": list(result.warnings),
            "spec": "",
            "sources": [],
            "provenance": [],
        }
    return {
        "arrays": [_array(name, array, result.units) for name, array in result.arrays.items()],
        "tables": [_table(table, result.units if form.detail == "full" else None) for table in result.tables.values()],
        "findings": [*result.findings, *remarks],
        "spec": result.spec.to_toml(moved=True),
        "sources": [str(source) for source in result.provenance.get("sources", ())],
        "provenance": provenance(result) if form.detail != "full" else [("digest", result.digest), *how_computed(result)],
    }


def summary(result: Result[Any], headlines: Sequence[str] | None = None, words: Words | None = None) -> Content:
    """Verdict, headline, checks and values of a result: what changes with every number of a design; its advice in `words`."""
    advice = advice_texts(result, words)
    return {
        "verdict": verdict_of(result),
        "failed": failed_texts(result, words),
        "headline": headline(result, headlines),
        "checks": [_check(result, c, advice.get(c.name, "")) for c in sorted(result.checks, key=lambda c: c.ok)],
        "values": [_value(result, name) for name, value in result.values.items() if math.isfinite(value.value)],
    }


def program() -> str:
    """Our own version."""
    return versions()["drivewright"]


def verdict_of(result: Result[Any]) -> dict[str, str]:
    """The `verdict` of a result."""
    checks = result.checks
    return verdict([bool(check.ok) for check in checks], result.outcome, sum(check.undecided for check in checks), len(result.warnings))


def verdict(passed: Sequence[bool], outcome: str, undecided: int = 0, warnings: int = 0) -> dict[str, str]:
    """{'state': 'good' | 'bad' | 'warn', 'text'} of checks as booleans; an unfinished, unchecked or undecided run, or one with warnings,
    is never good."""
    failed, count = passed.count(False), len(passed)
    if failed:
        return {"state": "bad", "text": f"{failed} of {count} checks {'fails' if failed == 1 else 'fail'}"}
    if outcome != "complete":
        return {"state": "warn", "text": f"{outcome} result"}
    if not passed:
        return {"state": "warn", "text": "no checks"}
    if undecided:
        return {"state": "warn", "text": f"{undecided} of {count} checks undecided"}
    good = "1 check passes" if count == 1 else f"all {count} checks pass"
    if warnings:
        return {"state": "warn", "text": f"{good}, {warnings} warning{'' if warnings == 1 else 's'}"}
    return {"state": "good", "text": good}


def headline(result: Result[Any], names: Sequence[str] | None = None) -> list[Content]:
    """The values of those names, of the `key_names` unless given."""
    return [_value(result, name) for name in (key_names(result) if names is None else names)]


def key_names(result: Result[Any]) -> list[str]:
    """The names of the key numbers: the first of the mechanism's headline values, or of all, where the kind of drive is not known here.

    What a pattern such as "*.max_acceleration" finds is left out where it is zero: a slider does not turn.
    """
    if not registry.is_known(result.mechanism):
        return list(result.values)[:MOST_HEADLINES]
    mechanism = registry.mechanism(result.mechanism)
    return registry.key_values(mechanism, _telling(result, mechanism), MOST_HEADLINES)


def _telling(result: Result[Any], mechanism: registry.Mechanism[Any, Any]) -> dict[str, Value]:
    """The values that are not zero, or that the headline asks for by their full names."""
    return {name: value for name, value in result.values.items() if name in mechanism.headline or not _is_zero(result, value)}


def _is_zero(result: Result[Any], value: Value) -> bool:
    return value.value == 0 or result.is_noise(value)


def _value(result: Result[Any], name: str) -> Content:
    """`shown` in full; `number`, `unit` and the interval `low` .. `high` apart, "" where it says nothing, with its `hint`."""
    value = result.values[name]
    seen = 0.0 if result.is_noise(value) else value.value
    shown = labelled_scale(value.label, value.unit, result.units, seen)
    text, low, high = numbers(shown.of(seen), *ends_shown(value.low, value.high, shown))
    return {
        "name": name,
        "label": label_of(value.meaning or name, value.label),
        "meaning": sentence(value.meaning or name),
        "convention": sentence(value.convention),
        "shown": with_unit(f"{text} ({low} to {high})" if low else text, shown.unit),
        "number": text,
        "unit": shown.unit,
        "low": low,
        "high": high,
        "hint": interval_hint(value),
        "interval": value.interval,
        "si": with_unit(repr(float(value.value)), unit_text(value.unit)),
    }


def _check(result: Result[Any], check: Check, advice: str = "") -> Content:
    """`advice` says what to change so that it passes, where that is known.

    The interval of the value is `low` .. `high`, the unit behind the latter; "" where it says nothing."""
    seen = 0.0 if result.is_noise(check) else check.value
    shown = labelled_scale(check_label(check), check.unit, result.units, check.limit or seen)
    unit, limit = shown.unit, with_unit(number(shown.of(check.limit)), shown.unit)
    text, low, high = numbers(shown.of(seen), *ends_shown(*(check.bounds or (None, None)), shown))
    margin = _margin(check, shown) if math.isfinite(check.margin) else ""
    return {
        "name": check.name,
        "label": check_label(check),
        "ok": bool(check.ok),
        "value": with_unit(text, unit),
        "low": low,
        "high": with_unit(high, unit) if high else "",
        "undecided": UNDECIDED if check.undecided else "",
        "limit": f"{SIGNS[check.sense]} {limit}",
        "margin": with_unit(margin, unit) if margin else "",
        "message": sentence(check.message),
        "advice": sentence(advice),
        "parts": list(check.parts),
    }


def check_label(check: Check) -> str:
    """The label of a check, its name in words where it has none."""
    return sentence(check.label or check.name.replace("_", " ").replace(".", " · "))


def _margin(check: Check, shown: Scale) -> str:
    """With a sign, and the digits that the check's value has."""
    low, high = check.margin_bounds or (math.nan, math.nan)
    text = numbers(check.margin * shown.factor, low * shown.factor, high * shown.factor, 4)[0]
    return text if text.startswith("−") else f"+{text}"


def _array(name: str, array: Array, system: System) -> Content:
    shown = Scale(1.0, unit_text(array.unit)) if system == "mm" else shown_scale(array.unit, system=system)
    values = np.atleast_1d(shown.of(np.asarray(array.values)))
    small = values.ndim <= 2 and values.size <= LARGEST_ARRAY
    rows = [[number(v) for v in row] for row in np.atleast_2d(values)] if small else []
    return {
        "name": name,
        "unit": shown.unit,
        "axes": " × ".join(array.axes),
        "shape": " × ".join(map(str, values.shape)),
        "head": [str(x) for x in array.labels[-1]] if array.labels else [],
        "side": [str(x) for x in array.labels[0]] if len(array.labels) == 2 else [],
        "rows": rows,
    }


def _table(table: Table, system: System | None = None) -> Content:
    """A column whose intervals are in the table stands for their ends too; with a `system` of units, each with its least and greatest."""
    heads = [(c, " (with its interval)" if table.bounds_of(c.name) else "") for c in table.columns if not table.bounded(c.name)]
    return {
        "name": table.name,
        "title": table.title,
        "rows": len(table.columns[0].data),
        "columns": [
            {"name": c.name, "unit": unit_text(c.unit), "meaning": sentence(c.meaning) + more} | (_ends(c, system) if system else {})
            for c, more in heads
        ],
    }


def _ends(column: Column, system: System) -> Content:
    """Least and greatest number of a column in the unit people read, "" of one without numbers."""
    data = np.asarray(column.data)
    finite = data[np.isfinite(data)] if data.dtype.kind in "iuf" else data[:0]
    if not len(finite):
        return {"least": "", "greatest": ""}
    shown = labelled_scale(label_of(column.meaning, column.label), column.unit, system, float(np.abs(finite).max()))
    return {"least": number(shown.of(float(finite.min()))), "greatest": number(shown.of(float(finite.max()))), "unit": shown.unit}


def provenance(result: Result[Any]) -> list[tuple[str, str]]:
    """Rows (what, text) of where the numbers came from; lists and mappings on one line, nothing of empty ones."""
    rows = [("outcome", result.outcome), ("digest", result.digest)]
    rows += [(key, _flat(value)) for key, value in result.provenance.items() if key != "sources"]
    return [(key, text) for key, text in rows if text]


def _flat(value: object) -> str:
    if isinstance(value, dict):
        return ", ".join(f"{key} {item}" for key, item in value.items())
    return ", ".join(map(str, value)) if isinstance(value, (list, tuple)) else str(value)
