"""The reference of results: values, checks and tables of every kind by analysis, collected by running the worked examples."""

from collections.abc import Callable, Iterator
from pathlib import Path

from builders.collected import Collected, Found, collect, example_paths
from builders.markdown import cell, code, sentence, table, write_page
from drivewright import registry
from drivewright.registry import Analysis
from drivewright.view.text import unit_text

NAMES = (
    "Upper-case words stand for the names that a spec gives (`bearings.BEARING.reaction` is `bearings.A.reaction`), N for a running number;"
)
LIMITS = {"<=": "at most the limit", ">=": "at least the limit"}


def build(docs: Path, progress: Callable[[str], None]) -> None:
    """Write docs/reference/results-KIND.md for each kind."""
    for kind, collected in collect(registry.kinds(), progress, docs.parent / "out" / "docs" / "collected.pickle").items():
        write_page(docs / "reference" / f"results-{kind}.md", _page(kind, collected))


def _page(kind: str, collected: Collected) -> Iterator[str]:
    """Lines of the page of a kind."""
    analyses = registry.mechanism(kind).analyses
    names = ", ".join(code(path.stem) for path in example_paths(kind))
    yield from (f"# Results of `{kind}`", "")
    yield 'What `result["NAME"]`, `result.check("NAME")` and `result.table("NAME")` give, and `result.json` and `tables/` hold.'
    yield "All numbers are in SI."
    yield from ("", f"Collected by running the examples {names} with their default analyses.")
    yield f"{NAMES} the meaning is that of the first example that has the name. A design has those that concern it."
    yield from ("", "## Analyses", *_analyses(analyses))
    for analysis in analyses:
        yield from _section(analysis, collected[analysis.name])


def _analyses(analyses: tuple[Analysis, ...]) -> list[str]:
    """Table of the analyses, with what makes them run."""
    rows = (
        (
            code(each.name),
            cell(sentence(each.meaning)),
            "by default" if each.default else f"on request: `--only {each.name}`",
            ", ".join(map(code, each.needs)),
        )
        for each in analyses
    )
    return table(("analysis", "meaning", "runs", "needs"), rows)


def _section(analysis: Analysis, found: Found) -> Iterator[str]:
    """Values, checks and tables of one analysis; nothing where the examples show none."""
    if not (found.values or found.checks or found.tables):
        return
    yield from ("", f"## {analysis.name}", "", sentence(analysis.meaning))
    yield from table(
        ("value", "meaning", "unit", "sign, zero or sense"),
        (
            (code(name), cell(_meaning(row.label, row.meaning)), unit_text(row.unit), cell(sentence(row.convention)))
            for name, row in found.values.items()
        ),
    )
    yield from table(
        ("check", "message", "passes where the value is", "unit"),
        (
            (code(name), cell(_meaning(row.label, row.message)), LIMITS[row.sense], unit_text(row.unit))
            for name, row in found.checks.items()
        ),
    )
    for name, title in found.tables.items():
        yield from _columns(name, title, found)


def _columns(name: str, title: str, found: Found) -> Iterator[str]:
    """The columns of one table, folded."""
    rows = [
        (code(column), cell(_meaning(row.label, row.meaning)), unit_text(row.unit))
        for (place, column), row in found.columns.items()
        if place == name
    ]
    yield from ("", f'??? note "Table {name}: {title.replace(chr(34), chr(39))}"', "")
    yield from (f"    {line}" if line else "" for line in table(("column", "meaning", "unit"), rows))


def _meaning(label: str, meaning: str) -> str:
    """Label and meaning in one: the label alone where the meaning begins with it."""
    text = sentence(meaning)
    return text if text.lower().startswith(label.lower()) else f"{label}: {meaning.strip()}"
