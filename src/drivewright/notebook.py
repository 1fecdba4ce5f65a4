"""What a notebook shows of a result and of a study: a card with a figure and the key numbers in the units that people read."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from drivewright import registry
from drivewright.labels import label_of
from drivewright.report.content import Content, Picture, Views, headline, pictures, summary, thumbnail, views
from drivewright.report.records import AnswersRecord, StudyRecord
from drivewright.report.study import reasons, varied, verdict
from drivewright.result import Plot, Result
from drivewright.view import cards
from drivewright.view.panels import drawable
from drivewright.view.text import labelled_scale, number, with_unit

WIDE, NARROW = 560, 320  # pixels of a plot, of a scene
DATA_COLOURS = ("map", "mesh")  # styles of plots whose colours are data
MOST_VALUES = 300  # in the table that opens with a click
MOST_ROWS = 12
MOST_NOTES = 40
HEAD = ("Quantity", "Value", "Name")


def result_card(result: Result[Any]) -> str:
    """HTML of a result: verdict, figure, key numbers, the checks that fail; all checks, values and notes open with a click."""
    said = summary(result)
    failed = [check for check in said["checks"] if not check["ok"] or check["undecided"]]
    values = said["values"]
    more = [f"{len(values) - MOST_VALUES} more values: see `values` of the result"] if len(values) > MOST_VALUES else []
    others = [finding for finding in result.findings if finding not in result.warnings]
    blocks = (
        cards.beside(_figure_of(result), cards.table(map(_value_row, said["headline"]), HEAD, "tnc")),
        _checks(failed),
        cards.notes(f"⚠ {warning}" for warning in result.warnings),
        cards.folded(f"All checks ({len(said['checks'])})", _checks(said["checks"])),
        cards.folded(f"All values ({len(values)})", cards.table(map(_value_row, values[:MOST_VALUES]), HEAD, "tnc") + cards.notes(more)),
        cards.folded(f"Notes ({len(others)})", cards.notes(_some(others))),
    )
    return cards.card(result.title or result.mechanism, result.mechanism, said["verdict"], blocks)


def _some(lines: Sequence[str]) -> list[str]:
    """The first `MOST_NOTES` of some lines, and how many there are beside them."""
    return [*lines[:MOST_NOTES], *([f"{len(lines) - MOST_NOTES} more"] if len(lines) > MOST_NOTES else [])]


def _value_row(value: Content) -> tuple[str, str, str]:
    return value["label"], value["shown"], value["name"]


def _checks(checks: Sequence[Content]) -> str:
    """Table of checks with value, limit and margin, and what to do about those that fail."""
    rows = [
        ("✓" if c["ok"] else "✗", c["label"], c["value"], c["limit"], c["margin"], c["undecided"] or ("" if c["ok"] else c["message"]))
        for c in checks
    ]
    return cards.table(rows, ("", "Check", "Value", "Limit", "Margin", ""), "ttnnnt")


def _figure_of(result: Result[Any]) -> str:
    """The mechanism's picture, or its first plot where there is no scene or that is too large; "" without either."""
    if not registry.is_known(result.mechanism):
        return ""
    seen = views(result)
    shown = cards.figure(thumbnail(seen.scene).svg, result.title or "Mechanism", NARROW) if seen.scene else ""
    plots = tuple(drawable(result, seen.plots))[:1]
    return shown or _plot(result, plots)


def _plot(result: Result[Any], plots: Sequence[Plot]) -> str:
    """The first of some plots as a figure."""
    drawn: Picture | None = next(iter(pictures(result, Views(plots=tuple(plots[:1])))), None)
    return cards.figure(drawn.svg, drawn.title, WIDE, plots[0].style not in DATA_COLOURS) if drawn else ""


def study_card(study: StudyRecord, answers: AnswersRecord | None) -> str:
    """HTML of a study: how many cases are complete, what varies, the main plot and numbers of its `answers`, and why cases failed."""
    system = study.spec.units
    variables = [varied(variable, system) for variable in study.plan.variables]
    findings = answers.result.findings if answers else ()
    blocks = (
        cards.table(variables, ("Varied key", "Over", "Nominal"), "ctn"),
        cards.beside(_plot(answers.result, answers.plots), _numbers(study, answers)) if answers else "",
        cards.notes(f"{each['count']} × {each['status']}: {each['text']}" for each in reasons(study)[:3]),
        cards.folded(f"Notes ({len(findings)})", cards.notes(_some(findings))),
        cards.notes([f"folder: {study.folder}" if study.folder else "in memory"]),
    )
    return cards.card(study.spec.title or "Study", f"study of {study.spec.mechanism}", verdict(study), blocks)


def _numbers(study: StudyRecord, answers: AnswersRecord) -> str:
    """Table of least and greatest of the values that have plots, and of the yield."""
    ends, system = _ends(answers), study.spec.units
    plotted = [name for plot in answers.plots for name in plot.y if name in ends]
    rows = []
    for name in list(dict.fromkeys(plotted or ends))[:MOST_ROWS]:
        about = study.schema.field(name).metadata or {}
        unit, label = (about.get(key, b"").decode() for key in (b"unit", b"label"))
        label = label_of(about.get(b"meaning", b"").decode(), label)
        shown = labelled_scale(label, unit, system, max(map(abs, ends[name])))
        rows.append((label, *(with_unit(number(shown.of(end)), shown.unit) for end in ends[name]), name))
    known = [name for name in ("yield",) if name in answers.result.values]
    yields = cards.table(map(_value_row, headline(answers.result, known)), kinds="tnc")
    return f"<div>{yields}{cards.table(rows, ('Value', 'Least', 'Greatest', 'Column'), 'tnnc')}</div>"


def _ends(answers: AnswersRecord) -> dict[str, tuple[float, float]]:
    """{column: (least, greatest)} over all cases."""
    table = answers.result.tables.get("extremes")
    if table is None:
        return {}
    names, numbers = table["value"].data, np.asarray(table["number"].data, float)
    return {str(name): (float(low), float(high)) for name, low, high in zip(names[::2], numbers[::2], numbers[1::2], strict=True)}
