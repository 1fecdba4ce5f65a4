"""The figures of a report: in which order they stand, their numbers, and which of them shows a check.

Scenes come first, then plots, then drawings.  Among the plots those that show a failed check come first: before all those that draw its
limit, then those that bear its name, as their own or as that of a curve.  A check with a dotted name, "play.forward", also has the name
in front of the dot.  All others keep the order that the drive gives them.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, NamedTuple

from drivewright.report.content import Content, Picture, Views
from drivewright.report.form import MAIN_PLOTS, ReportForm
from drivewright.report.names import file_name
from drivewright.result import Check, Plot, Result
from drivewright.view.panels import drawable

DRAWS_LIMIT, BEARS_NAME, UNRELATED = 0, 1, 2


class NumberedFigure(NamedTuple):
    """A figure under its number in the report: the name of its file, without suffix."""

    number: int
    name: str


def relation(plot: Plot, check: Check) -> int:
    """How a plot shows a check: DRAWS_LIMIT, BEARS_NAME or UNRELATED."""
    names = {check.name, check.name.partition(".")[0]}
    limits = {value.removeprefix("-") for value, _ in plot.limits if isinstance(value, str)}
    if names & {each for limit in limits for each in (limit, limit.partition(".")[0])}:
        return DRAWS_LIMIT
    curves = {step for column in plot.y for step in (column, *column.split("."))}
    return BEARS_NAME if names & {plot.name, *curves} else UNRELATED


def failed_first(result: Result[Any], seen: Views) -> Views:
    """The same views, the plots of failed checks in front."""
    failed = [check for check in result.checks if not check.ok]
    return seen._replace(
        plots=tuple(sorted(seen.plots, key=lambda plot: min((relation(plot, each) for each in failed), default=UNRELATED)))
    )


def numbered_figures(result: Result[Any], seen: Views) -> tuple[NumberedFigure, ...]:
    """All figures of a report in their order, numbered from 1."""
    scenes = [f"scene-{frame.name}" for frame in (seen.scene.frames if seen.scene else ())]
    plots = [f"plot-{plot.name}" for plot in drawable(result, seen.plots)]
    names = [*scenes, *plots, *(["solids"] if seen.solids else []), *(f"drawing-{drawing.name}" for drawing in seen.drawings)]
    return tuple(NumberedFigure(number, name) for number, name in enumerate(names, 1))


def with_figures(content: Content, result: Result[Any], seen: Views) -> Content:
    """The content, each check with the `figure` that shows it: {"number", "name"}, None where there is none."""
    numbers = {figure.name: figure.number for figure in numbered_figures(result, seen)}
    plots, made = drawable(result, seen.plots), {check.name: check for check in result.checks}
    return {**content, "checks": [{**row, "figure": _figure_of(made[row["name"]], plots, numbers)} for row in content["checks"]]}


def _figure_of(check: Check, plots: Sequence[Plot], numbers: dict[str, int]) -> Content | None:
    """The plot that shows a check best."""
    best = min(plots, key=lambda plot: relation(plot, check), default=None)
    if best is None or relation(best, check) == UNRELATED:
        return None
    return {"number": numbers[f"plot-{best.name}"], "name": f"plot-{best.name}"}


def in_order(pictures: Sequence[Picture], figures: Sequence[NumberedFigure]) -> list[tuple[int, Picture]]:
    """(number, picture) of pictures in the order of the report; further ones at the end, with the numbers that follow."""
    numbers = {file_name(figure.name): figure.number for figure in figures}
    known = [(numbers[file_name(each.name)], each) for each in pictures if file_name(each.name) in numbers]
    others = [each for each in pictures if file_name(each.name) not in numbers]
    return [*sorted(known, key=lambda each: each[0]), *enumerate(others, len(figures) + 1)]


def seen_in(form: ReportForm, result: Result[Any], seen: Views) -> Views:
    """What a report of this form shows, failed checks first; a short one: the scene (else the first drawing) and the main plots."""
    ordered = failed_first(result, seen)
    if form.detail != "short":
        return ordered
    scene = replace(seen.scene, frames=seen.scene.frames[:1]) if seen.scene else None
    return ordered._replace(scene=scene, plots=drawable(result, ordered.plots)[:MAIN_PLOTS], drawings=() if scene else seen.drawings[:1])
