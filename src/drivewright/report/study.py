"""The report of a study beside its cases: what varied, what became of the cases, what the answers are, how to do it again."""

from pathlib import Path
from typing import Any

import numpy as np

from drivewright.atomic import replacing, write_text
from drivewright.labels import label_of
from drivewright.report.content import Views, content, pictures
from drivewright.report.folder import file_name, record_text
from drivewright.report.html import embedded, page
from drivewright.report.records import AnswersRecord, StudyRecord, VariableRecord
from drivewright.units import System
from drivewright.view.text import ends_shown, labelled_scale, number, numbers, quantity, sentence, uncertain, unit_text, with_unit

STATES = {"complete": "good", "partial": "warn", "failed": "bad"}
MOST_REASONS = 8
MOST_TILES = 12
MOST_LEVELS = 8  # that are told one by one
PRINTED = (40, 10)  # rows and columns of a table that is on the page itself
FORMS = {"norm": "normal", "truncnorm": "normal", "uniform": "uniform", "triang": "triangular"}
COMMAND = "drivewright sweep study.toml --out again"
VARIED = ("Key", "Over", "Nominal")


def write_answers(study: StudyRecord, answers: AnswersRecord, folder: str | Path) -> Path:
    """Write what was found in a study (`studies.answers.answers`) into `folder` and return the path of its report.html.

    answers.json, figures/*.svg, tables/*.parquet, report.html; each file whole or not at all, the report last.  What an older report
    left is replaced, everything else in the folder stays.
    """
    folder = Path(folder)
    drawn = [picture._replace(name=file_name(picture.name)) for picture in pictures(answers.result, Views(plots=answers.plots))]
    _write_tables(folder / "tables", answers.result.tables.values())
    _write_figures(folder / "figures", drawn)
    write_text(folder / "answers.json", record_text(answers.result))
    path = folder / "report.html"
    write_text(path, page("study.html.j2", study_content(study, answers), pictures=[embedded(picture) for picture in drawn]))
    return path


def _write_tables(folder, tables):
    from pyarrow import parquet

    files = {f"{file_name(table.name)}.parquet": table for table in tables}
    for name, table in files.items():
        with replacing(folder / name) as temporary:
            parquet.write_table(table.arrow(), temporary)
    _forget(folder, "*.parquet", files)


def _write_figures(folder, drawn):
    files = {f"{picture.name}.svg": picture.svg for picture in drawn}
    for name, text in files.items():
        write_text(folder / name, text)
    _forget(folder, "*.svg", files)


def _forget(folder, pattern, kept):
    """Remove what an older report left."""
    for file in folder.glob(pattern):
        if file.name not in kept:
            file.unlink()


# -- what the page says --------------------------------------------------------------------------------------------------------


def study_content(study: StudyRecord, answers: AnswersRecord) -> dict[str, Any]:
    """What the page says, as plain text in plain dictionaries."""
    result = answers.result
    system = study.spec.units
    tables = [
        described | _printed(table, system) for described, table in zip(content(result)["tables"], result.tables.values(), strict=True)
    ]
    return content(result, headlines=_headlines(answers)) | {
        "verdict": verdict(study),
        "tables": tables,
        "cases": cases(study),
        "reasons": reasons(study),
        "varied": [varied(variable, system) for variable in study.plan.variables],
        "varied_columns": [{"name": name, "unit": "", "meaning": name, "number": False} for name in VARIED],
        "sampling": sampling(study),
        "command": COMMAND,
        "recipe": recipe(study),
    }


def verdict(study: StudyRecord) -> dict[str, str]:
    """{'state', 'text'}: how many cases of the plan are complete; never good where one is not."""
    complete, total = study.counts.get("complete", 0), len(study.plan)
    state = "good" if complete == total else "warn" if complete else "bad"
    return {"state": state, "text": f"all {total} cases complete" if complete == total > 1 else f"{complete} of {total} cases complete"}


def cases(study: StudyRecord) -> list[dict[str, Any]]:
    """Rows {name, count, state, share} of every status, and of the cases that are not there."""
    counts = [(name, study.counts.get(name, 0), state) for name, state in STATES.items()]
    counts += [("not computed yet", len(study.plan) - len(study), "none")] if not study.complete else []
    return [{"name": name, "count": str(count), "state": state, "share": count} for name, count, state in counts]


def reasons(study: StudyRecord) -> list[dict[str, Any]]:
    """The commonest reasons {status, count, text} of what is not complete: those that differ in their numbers only are one."""
    return [{"status": group.status, "count": group.cases, "text": group.text()} for group in study.reasons()[:MOST_REASONS]]


def _headlines(answers):
    """The yield, then of each value that has a plot what the answers say about it."""
    plotted = {name for plot in answers.plots for name in plot.y}
    return [name for name in answers.result.values if name == "yield" or name.partition(".")[2] in plotted][:MOST_TILES]


def _printed(table, system):
    """{'printed': rows of text, 'columns'} of a table small enough for the page; a column of unit "" is in the unit its row names."""
    rows, columns = len(table.columns[0].data), table.columns
    if not 0 < rows <= PRINTED[0] or sum(not table.bounded(column.name) for column in columns) > PRINTED[1]:
        return {}
    named = next((column.data for column in columns if column.name == "unit"), [""] * rows)
    kept = [column for column in columns if column.name != "unit" and not table.bounded(column.name)]
    scales = [_column_scale(column, system) for column in kept]
    heads = [
        {"name": c.name, "unit": shown.unit, "meaning": sentence(c.meaning), "number": _is_number(c)}
        for c, shown in zip(kept, scales, strict=True)
    ]
    cells = (_cells(c, named, table.bounds_of(c.name), shown, system) for c, shown in zip(kept, scales, strict=True))
    return {"columns": heads, "printed": list(zip(*cells, strict=True))}


def _column_scale(column, system):
    """The `Scale` of a column: long times in hours, where the longest of them is long."""
    size = np.nanmax(np.abs(column.data), initial=0.0) if _is_number(column) else 0.0
    return labelled_scale(label_of(column.meaning, column.label), column.unit, system, size)


def _is_number(column):
    return np.asarray(column.data).dtype.kind in "iuf"


def _cells(column, named, bounds, shown, system):
    """Texts of a column with its intervals on the scale `shown` of its head, or with the unit that each row names."""
    data = np.asarray(column.data).tolist()
    if not _is_number(column):
        return [str(cell) for cell in data]
    lows, highs = (np.asarray(end.data).tolist() for end in bounds) if bounds else ([None] * len(data),) * 2
    rows = zip(data, lows, highs, strict=True)
    if column.unit == "":
        return [uncertain(value, str(unit), low, high, system=system) for unit, (value, low, high) in zip(named, rows, strict=True)]
    return [_on_scale(value, low, high, shown) for value, low, high in rows]


def _on_scale(value, low, high, shown):
    """A number with its interval, without the unit."""
    text, *ends = numbers(shown.of(value), *ends_shown(low, high, shown))
    return f"{text} ({ends[0]} to {ends[1]})" if ends[0] else text


# -- what varied ---------------------------------------------------------------------------------------------------------------


def varied(variable: VariableRecord, system: System = "mm") -> tuple[str, str, str]:
    """(key and those that go with it, levels or distribution, nominal value) as people read them in a system of units."""
    if variable.levels is not None:
        over = _levels(variable, system)
    else:
        over = _distribution(variable, system) if variable.distribution is not None else "the points of a file"
    key = variable.key + (f", also {', '.join(variable.also)}" if variable.also else "")
    return key, over, "" if variable.nominal is None else _text(variable, variable.nominal, system)


def _text(variable, value, system):
    if isinstance(value, (bool, np.bool_)):
        return str(bool(value)).lower()
    return quantity(float(value), variable.kind.unit, system=system) if isinstance(value, (int, float, np.number)) else str(value)


def _levels(variable, system):
    """Each of some levels; of many numbers the ends, and how they follow each other."""
    levels = variable.levels
    if len(levels) <= MOST_LEVELS or levels.dtype.kind not in "iuf":
        texts = [_text(variable, level, system) for level in levels.tolist()]
        more = len(texts) - 3 * MOST_LEVELS
        return ", ".join(texts[: 3 * MOST_LEVELS]) + (f" and {more} more" if more > 0 else "")
    steps = np.diff(levels)
    even = np.ptp(steps) <= 1e-9 * np.abs(steps).max()
    how = "equal steps" if even else "equal ratios" if _is_geometric(levels) else "uneven steps"
    low, high = (_text(variable, end, system) for end in (levels.min(), levels.max()))
    return f"{low} … {high}, {len(levels)} levels in {how}"


def _is_geometric(levels):
    if np.any(levels[0] * levels <= 0):
        return False
    steps = np.diff(np.log(np.abs(levels)))
    return np.ptp(steps) <= 1e-9 * np.abs(steps).max()


def _distribution(variable, system):
    """The form with its numbers."""
    frozen = variable.distribution
    form, (low, high) = FORMS[frozen.dist.name], frozen.support()
    ends = " … ".join(_text(variable, end, system) for end in (low, high))
    if form == "uniform":
        return f"uniform, {ends}"
    if form == "triangular":  # the mean of a triangle is that of its three corners
        return f"triangular, {ends}, peak at {_text(variable, 3 * frozen.mean() - low - high, system)}"
    # The parameters of the bell itself; a cut one is narrower than they say.
    middle, sigma = frozen.args[-2:]
    cut = f", within {ends}" if np.isfinite(low) or np.isfinite(high) else ""
    width = quantity(float(sigma), variable.kind.difference.unit, system=system)
    return f"normal, mean {_text(variable, middle, system)}, standard deviation {width}{cut}"


# -- how to do it again --------------------------------------------------------------------------------------------------------


def sampling(study: StudyRecord) -> str:
    """How the cases come about, in a sentence."""
    plan, method = study.plan, study.spec.study.method if study.spec.study else ""
    levels = f"{' × '.join(map(str, plan.shape))} levels" if plan.grid else ""
    blocks = " + ".join(f"{block.stop - block.start} {block.name}" for block in plan.blocks)
    points = f"{plan.inner} points of a file" if plan.listed else f"{plan.inner} points by {method} ({blocks})" if plan.random else ""
    return f"{' × '.join(part for part in (levels, points) if part)} = {len(plan)} cases."


def recipe(study: StudyRecord) -> str:
    """What has to be the same for the same numbers."""
    place = "study.toml is in the study's folder" if study.folder else "study.toml is the spec below"
    return (
        f"{place}. Same version, same seed ({study.plan.seed}), same cases: digest of the plan {study.plan.digest[:12]}, "
        f"of the spec {study.spec.digest()[:12]}. Computing took {with_unit(number(study.seconds, 3), unit_text('s'))} of one core."
    )
