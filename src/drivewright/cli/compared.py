"""Specs run for a comparison, and its output on the terminal."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from drivewright import registry
from drivewright.cli import show

if TYPE_CHECKING:
    from drivewright.execution.helper import Map
    from drivewright.report.comparison import DesignComparison
    from drivewright.report.content import Views
    from drivewright.result import Result
    from drivewright.spec import MechanismSpec
    from drivewright.units import System

    Design = tuple[Result[Any], Views]

MAX_ROWS = 20  # values that are printed


def labels_of(paths: Sequence[Path], specs: "Sequence[MechanismSpec]", given: str) -> tuple[str, ...]:
    """The labels given, one for each spec; else the titles, the names of the files where titles are equal or missing, all different."""
    from drivewright.report.comparison import check_labels, distinct

    if given:
        labels = tuple(label.strip() for label in given.split(","))
        check_labels(labels, len(paths))
        return labels
    titles = [spec.title for spec in specs]
    return distinct([title if title and titles.count(title) == 1 else path.stem for title, path in zip(titles, paths, strict=True)])


@contextmanager
def helped(kind: str) -> "Iterator[Map]":
    """A `Map` that shares runs and figures of a kind with a second process."""
    from drivewright.execution.helper import helping_hand

    with helping_hand(partial(_prepare, kind)) as compute:
        yield compute


def _prepare(kind: str) -> None:
    from drivewright.report.content import prepare_drawing

    registry.mechanism(kind)
    prepare_drawing()


def run_designs(paths: Sequence[Path], specs: "Sequence[MechanismSpec]", only: Sequence[str], compute: "Map") -> "list[Design]":
    """(result, views) of each spec, side by side where a second process helps."""
    from drivewright.execution.helper import compiling_ahead

    with compiling_ahead(specs[0]):
        return list(compute(partial(_run, tuple(only)), list(zip(paths, specs, strict=True))))


def _run(only: tuple[str, ...], design: "tuple[Path, MechanismSpec]") -> "Design":
    from drivewright import runner
    from drivewright.report.content import views

    path, spec = design
    with show.located(path):
        model = runner.build(spec)
        result = runner.run(spec, only, model=model)
        return result, views(result, model)


def show_comparison(comparison: "DesignComparison", changed: bool = False) -> None:
    """The headline values of the designs side by side, of two with the difference, which designs are the same and the checks that fail.

    `changed`: keys were set for all designs at once.
    """
    from drivewright.report.comparison import identical_text
    from drivewright.report.comparison_page import headline_names

    names = headline_names(comparison)[:MAX_ROWS]
    pair = len(comparison.results) == 2
    apart: show.Header = [("difference", "right")] if pair else []
    header: show.Header = [("value", "left"), *((label, "right") for label in comparison.labels), *apart, ("", "left")]
    rows = [
        (
            name,
            *(_value(result, name, comparison.system) for result in comparison.results),
            *_difference(comparison, name)[:pair],
            comparison.known(name).meaning,
        )
        for name in names
    ]
    checks = ["fails" if not result.ok else "pass" if result.checks else "none" for result in comparison.results]
    show.table(f"{comparison.mechanism}: {len(comparison.labels)} designs", header, [*rows, ("checks", *checks, *[""] * pair, "")])
    for labels in comparison.identical:
        show.note(f"note: {identical_text(labels)}{' (--set changes every design)' if changed else ''}")
    for label, result in zip(comparison.labels, comparison.results, strict=True):
        failed = [check.name for check in result.checks if not check.ok]
        if failed:
            show.note(f"note: {label}: {', '.join(failed)} {'fails' if len(failed) == 1 else 'fail'}")
        for warning in result.warnings:
            show.note(f"warning: {label}: {warning}")


def _difference(comparison: "DesignComparison", name: str) -> list[str]:
    """The difference of the second design to the first one, marked where the intervals of the two overlap."""
    from drivewright.report.comparison import difference_text

    apart, known = comparison.differences(name)[1], comparison.known(name)
    return [
        difference_text(apart, known.unit, comparison.system, show.label_text(known)) + ("" if apart is None or apart.certain else " ~")
    ]


def _value(result: "Result[Any]", name: str, system: "System") -> str:
    from drivewright.report.comparison import value_text

    return value_text(result.values.get(name), system)
