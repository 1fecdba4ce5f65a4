"""The sources as one page of Markdown, for the documentation."""

import re
from collections.abc import Iterable, Iterator

from drivewright.validation.source import Row, Source

HEADER = """# Validation

The numbers that others have published beside ours. `drivewright validate` computes this page; it exits with 1 when a verdict
differs from the one pinned in the repository. A verdict is computed: *agrees* when our number rounds to the printed one or meets
the printed limit (of an uncertain number also when the print lies within its 95 % interval); *differs, explained* when our number under
another reading, which the remark names, gives the printed one; *differs, open* otherwise. What is calibrated on the print, or made of
printed numbers alone, is *not compared*. What is called *evaluated* is a printed formula's value for the source's data, which the source
itself does not print. `drivewright reproduce` shows the five papers that the package began with figure by figure.
"""


UNITS = (
    (r"(?<=\d) deg\b", "°"),
    (r"(?<=[\d.]) ?um\b|\bum\b", lambda found: found[0].replace("um", "µm")),
    (r"\burad\b", "µrad"),
    (r"\bN m s/rad", "N·m·s/rad"),
    (r"\bN s/rad", "N·s/rad"),
    (r"\bN m\b", "N·m"),
    (r"\bkg mm\^2", "kg·mm²"),
    (r"\bkg m\^2", "kg·m²"),
    (r"\b(mm?|s|N/m)\^(\d)(?![.\d])", lambda found: found[1] + "⁰¹²³⁴⁵⁶⁷⁸⁹"[int(found[2])]),
)


def page(sources: Iterable[Source]) -> str:
    """Markdown with a table per source, its assumptions and its errata."""
    return with_printed_units("\n".join([HEADER, *(line for source in sources for line in _section(source))]))


def with_printed_units(text: str) -> str:
    """The text with its units as a book prints them: µm, N·m, m/s², °."""
    for unit, printed in UNITS:
        text = re.sub(unit, printed, text)
    return text


def _section(source: Source) -> Iterator[str]:
    rows = source.rows()
    remarks = list(dict.fromkeys(row.commentary for row in rows if row.commentary))
    yield from (f"## {source.name}", "", source.citation, "", "| quantity | where | kind | printed | ours | deviation | verdict |")
    yield "|---|---|---|---|---|---|---|"
    for row in rows:
        verdict = f"{row.verdict} [{remarks.index(row.commentary) + 1}]" if row.commentary else row.verdict
        cells = (row.name, row.where, row.kind, str(row.printed), _number(row), row.deviation_text(), verdict)
        yield f"| {' | '.join(cells)} |"
    yield ""
    yield from _listed(f"[{number}] {remark}" for number, remark in enumerate(remarks, 1))
    yield from _listed(dict.fromkeys(f"Inputs as printed: {row.inputs}." for row in rows if row.inputs))
    yield from _listed(dict.fromkeys(f"Assumed: {row.assumed}." for row in rows if row.assumed))
    yield from _listed(f"Erratum: {text}" for text in source.errata)


def _listed(lines: Iterable[str]) -> list[str]:
    lines = [f"- {line}" for line in lines]
    return [*lines, ""] if lines else []


def _number(row: Row) -> str:
    factor, shown = row.shown_unit
    return "" if row.ours is None else f"{row.ours * factor:.6g}{'' if shown == '-' else ' ' + shown}"
