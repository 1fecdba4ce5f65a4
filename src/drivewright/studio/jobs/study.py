"""The [study] of a design: its cases as rows of a table, and their evaluation."""

import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from drivewright import registry
from drivewright._typing import Ints
from drivewright.errors import SpecError
from drivewright.execution.case_table import CASE, STATUS
from drivewright.execution.evaluation import case_task
from drivewright.execution.outputs import CHECK, MARGIN_OF
from drivewright.report.content import Views, pictures
from drivewright.report.study import study_content
from drivewright.spec.serialisation import toml_value
from drivewright.studies.answers import analyse_study
from drivewright.studies.plan import make_plan
from drivewright.studies.statistics import varies
from drivewright.studies.store import Memory, joined
from drivewright.studies.study import Study
from drivewright.studies.study_folder import Folder
from drivewright.studies.sweeps import compute_study, rerun_cases, study_identity
from drivewright.studies.variation import with_options
from drivewright.studio.design import Design
from drivewright.studio.jobs.design_keys import input_text, label, numeric, plain
from drivewright.studio.jobs.figures import drawn
from drivewright.studio.jobs.progress import Progress
from drivewright.view.text import display_unit, quantity, sentence

MOST_ROWS, MOST_LIVE = 4000, 1000  # that a page is sent: at the end, and on the way
PAUSE = 0.5  # seconds between two looks at what is done so far
SHARE = 10  # pauses are so many times as long as a look takes


def study(
    design: Design,
    progress: Progress,
    vary: Sequence[str] = (),
    samples: int | None = None,
    method: str | None = None,
    folder: str | Path | None = None,
    workers: int | None = None,
    on: str | None = None,
    theme: str = "light",
) -> dict[str, Any]:
    """Every case of the [study] table, or of `vary` as on the command line ("key=1 mm:2 mm:5").

    {"columns": [{"name", "label", "unit", "role": key | value | check}], "rows" in the units people read, None where there is no number,
    "ends": {column: [[low, high] or None of each row]} of the 95 % intervals, "cases": number of each row, "passes" whether it is complete
    and passes, "load": {key: text} of each row, "fronts":
    [{"name", "objectives": [{"name", "goal"}], "rows"}], "statements", "figures", "failed", "total"}.  A check is told by its margin.
    Of more than `MOST_ROWS` cases an even part is told, and every case on a front.
    """
    spec = with_options(design.spec_on_screen(), vary, samples=samples, method=method)
    if spec.study is None or not (spec.study.vary or spec.study.points):
        raise SpecError(_remedy(design), "study.vary")
    plan = make_plan(spec)
    kept = Folder(Path(folder), spec, study_identity(spec, plan)) if folder is not None else Memory()
    live = Live(progress, lambda: _rows(design, _so_far(spec, plan, kept), MOST_LIVE))
    try:
        computed = compute_study(kept, spec, plan, case_task(spec, plan.keys), workers, on, live)
    finally:
        kept.close()
    progress(len(plan), len(plan), "what the cases say")
    return _study_summary(design, computed, theme)


class Live:
    """Progress of cases, with a partial answer at most every `PAUSE`, and less often where one takes long to make."""

    def __init__(self, progress: Progress, preview: Callable[[], Any]) -> None:
        self._progress, self._preview, self._next = progress, preview, 0.0

    def __call__(self, done: int, total: int, what: str) -> None:
        began = time.monotonic()
        due = done and began >= self._next
        self._progress(done, total, what, self._preview() if due else None)
        if due:
            self._next = time.monotonic() + max(PAUSE, SHARE * (time.monotonic() - began))


def _remedy(design):
    """What to write, with a key of this design."""
    known = numeric(design, design.spec()).items()
    key, low, high = next(
        (
            (key, *(toml_value(input_text(kind, float(f"{part * value:.2g}"))) for part in (0.9, 1.1)))
            for key, (kind, value) in known
            if value > 0 and kind.name == "quantity"
        ),
        ("KEY", '"FROM"', '"TO"'),
    )
    return (
        "choose at least one parameter to vary and write it into the text of the design, for example:\n"
        f'[study]\nsamples = 200\n\n[[study.vary]]\nkey = "{key}"\nlower = {low}\nupper = {high}'
    )


def _so_far(spec, plan, kept):
    return Study(spec, plan, joined(kept.tables()))


# -- rows ----------------------------------------------------------------------------------------------------------------------


def _rows(design, study, most, always=()):
    """Columns and rows of a study, and the design behind each row; rows thinned to `most`, `always` (rows) among them."""
    names = _names(study)
    chosen = evenly_spaced_rows(len(study), most, always)
    columns = [
        {"name": name, "label": _label(design, study, name), "unit": display_unit(study.unit(name))[1], "role": _role(study, name)}
        for name in names
    ]
    data = [_cells(study[name][chosen], study.unit(name)) for name in names]
    ends = {name: _intervals(bounds, chosen, study.unit(name)) for name in names if (bounds := study.bounds(name)) is not None}
    return {
        "columns": columns,
        "rows": [list(row) for row in zip(*data, strict=True)],
        "ends": ends,
        "cases": study[CASE][chosen].tolist(),
        "passes": _passes(study)[chosen].tolist(),
        "load": _loads(study, chosen),
        "total": len(study.plan),
    }


def evenly_spaced_rows(count: int, most: int, always: Sequence[int] = ()) -> Ints:
    """Numbers of up to about `most` of `count` rows, evenly spaced, and of those that must be there."""
    even = np.arange(count) if count <= most else np.linspace(0, count - 1, most).round().astype(int)
    return np.union1d(even, np.asarray(always, int)).astype(int)


def _names(study):
    """The keys, then the values that vary, those of the headline first, then the checks."""
    keys = [variable.key for variable in study.plan.variables]
    values = [name for name in study.value_names if varies(np.asarray(study[name], float))]
    first = [name for name in study.spec.study.values if name in values]
    first += registry.headlines(registry.mechanism(study.spec.mechanism), values)
    return [*keys, *dict.fromkeys([*first, *values]), *(CHECK + name for name in study.check_names)] if len(study) else keys


def _role(study, name):
    return "key" if name in study.plan.keys else "check" if name.startswith(CHECK) else "value"


def _label(design, study, name):
    if _role(study, name) == "key":
        return label(design.tables, name)
    return sentence(study.meaning(name).removeprefix(MARGIN_OF) or name)


def _cells(data, unit):
    """Numbers in the unit people read, None for what is none; texts and flags as they are."""
    return [plain(cell, unit) if isinstance(cell, float) else cell for cell in np.asarray(data).tolist()]


def _intervals(bounds, chosen, unit):
    """[low, high] of each row in the unit people read, None where it has no interval."""
    rows = zip(*(_cells(end[chosen], unit) for end in bounds), strict=True)
    return [None if None in row else list(row) for row in rows]


def _passes(study):
    passes = np.asarray(study[STATUS], dtype=str) == "complete"
    for name in study.check_names:
        passes &= ~(np.asarray(study[CHECK + name], float) < 0)
    return passes


def _loads(study, chosen):
    """{key: text} that makes the design of each row."""
    texts = {}
    for variable in study.plan.variables:
        cells = [input_text(variable.kind, cell) for cell in study[variable.key][chosen].tolist()]
        texts |= dict.fromkeys(variable.keys, cells)
    return [dict(zip(texts, row, strict=True)) for row in zip(*texts.values(), strict=True)]


# -- what the cases say --------------------------------------------------------------------------------------------------------


def _study_summary(design, study, theme):
    answers = analyse_study(study, rerun=rerun_cases(study))
    fronts = _fronts(study, answers.result)
    rows = _rows(design, study, MOST_ROWS, [row for front in fronts for row in front["rows"]])
    place = {case: row for row, case in enumerate(rows["cases"])}
    cases = study[CASE]
    for front in fronts:
        front["rows"] = [place[int(cases[row])] for row in front["rows"]]
    failed = int(np.sum(np.asarray(study[STATUS], dtype=str) == "failed"))
    return rows | {
        "fronts": fronts,
        "figures": drawn(pictures(answers.result, Views(plots=answers.plots)), theme),
        "statements": _statements(study, answers),
        "failed": failed,
    }


def _fronts(study, result):
    """The Pareto front as rows of the study, in the order of its first objective."""
    if "front" not in result.tables:
        return []
    table = result.tables["front"]
    names = [column.name for column in table.columns]
    goals = {each.value: each.goal for each in study.spec.optimise.objectives} if study.spec.optimise else {}
    objectives = [{"name": name, "goal": goals.get(name, "minimise")} for name in names[: names.index(CASE)]]
    rows = np.searchsorted(study[CASE], np.asarray(table[CASE].data, int)).tolist()
    return [{"name": "front", "objectives": objectives, "rows": rows}]


def _statements(study, answers):
    """What the study's report says in words and small tables, all of it text."""
    page = study_content(study, answers)
    tables = [
        {"name": table["name"], "title": table["title"], "columns": table["columns"], "rows": [list(row) for row in table["printed"]]}
        for table in page["tables"]
        if "printed" in table
    ]
    headline = [{"name": value["name"], "meaning": value["label"], "shown": value["shown"]} for value in page["headline"]]
    return {
        "verdict": page["verdict"],
        "headline": headline,
        "tables": tables,
        "findings": page["findings"],
        "reasons": page["reasons"],
        "cases": page["cases"],
        "varied": [list(row) for row in page["varied"]],
        "sampling": page["sampling"],
        "seconds": quantity(study.seconds, "s", 3),
    }
