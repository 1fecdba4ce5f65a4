"""Values over the levels of a grid: curves over one key, maps over two."""

from collections.abc import Iterable, Iterator
from itertools import product
from typing import NamedTuple

import numpy as np

from drivewright.execution.case_table import CASE
from drivewright.execution.outputs import CHECK
from drivewright.result import HIGH, LOW, Column, Plot, Table, Value
from drivewright.studies.answers.cases import STATUSES, status_codes
from drivewright.studies.answers.parts import Arranged, Part, about, level_text, table_of_rows, together
from drivewright.studies.statistics import finite

MOST_PANELS = 4  # combinations of further keys that get plots of their own
MOST_LINES = 6  # levels of a second key that are lines; with more they are a map

RANGE = (
    ("value", "", "value of the result"),
    ("unit", "", "unit of the row's numbers"),
    ("cases", "-", "cases that have the value"),
    ("least", "", "least over the grid"),
    ("least.case", "-", "number of the case where it is least"),
    ("greatest", "", "greatest over the grid"),
    ("greatest.case", "-", "number of the case where it is greatest"),
)


RANGE_ENDS = tuple(
    (f"{end}{side}", "", f"{end} over the grid, {bound}")
    for end in ("least", "greatest")
    for side, bound in ((LOW, "at least"), (HIGH, "at most"))
)


class Response(NamedTuple):
    """Something over the combinations of levels: columns (combinations,) that are lines of one plot; a map shows the first.

    What comes in steps, a count or a code, is not drawn as lines beside its map.
    """

    name: str
    title: str
    columns: tuple[Column, ...]
    in_steps: bool = False
    limits: tuple[tuple[float, str], ...] = ()
    ends: tuple[Column, ...] = ()  # columns with the intervals of the others, NAME.low and NAME.high


def surveyed(arranged: Arranged, responses: Iterable[Response]) -> Part:
    """`Part` of responses: tables `response` (one for each combination of further keys), curves or maps."""
    responses, axes = tuple(responses), _axes(arranged.plan)
    if not responses or not axes:
        return Part()
    panels, remark = _panels(arranged.plan, axes, arranged.study.spec.units)
    return together([Part(findings=remark), *(_panel(arranged, responses, axes[:2], *panel) for panel in panels)])


def _axes(plan):
    """Places of the keys with several levels, those with numbers first."""
    several = [n for n, variable in enumerate(plan.grid) if len(variable.levels) > 1]
    return sorted(several, key=lambda n: not _numeric(plan.grid[n]))


def _numeric(variable):
    return variable.levels.dtype.kind in "iuf"


def _panels(plan, axes, system):
    """([(suffix of names, end of titles, combinations)], findings): all levels of the two axes for each combination of the further keys."""
    others = axes[2:]
    combined = list(product(*(range(plan.shape[n]) for n in others)))
    chosen = combined if len(combined) <= MOST_PANELS else combined[:1]
    panels = []
    for number, places in enumerate(chosen, 1):
        fixed = dict(zip(others, places, strict=True))
        suffix = "".join(f", {plan.grid[n].key} = {level_text(plan.grid[n], place, system)}" for n, place in fixed.items())
        panels.append((f".{number}" if len(chosen) > 1 else "", suffix, _combinations(plan, axes[:2], fixed)))
    remark = (
        (
            f"the plots show one of {len(combined)} combinations of {', '.join(plan.grid[n].key for n in others)}:{panels[0][1][1:]}; "
            "the study's table holds all",
        )
        if len(chosen) < len(combined)
        else ()
    )
    return panels, remark


def _combinations(plan, axes, fixed):
    """Combinations of levels with all levels of the axes, the first axis slowest; keys that are not fixed at their first level."""
    levels = np.meshgrid(*(np.arange(plan.shape[n]) for n in axes), indexing="ij")
    places = dict(zip(axes, (level.ravel() for level in levels), strict=True))
    return np.ravel_multi_index([places.get(n, np.full(levels[0].size, fixed.get(n, 0))) for n in range(len(plan.grid))], plan.shape)


def _panel(arranged, responses, axes, suffix, fixed_text, combinations):
    """Table and plots of one combination of the further keys."""
    keys = arranged.level_columns(combinations)
    data = [
        column._replace(data=np.asarray(column.data)[combinations])
        for response in responses
        for column in (*response.columns, *response.ends)
    ]
    name = f"response{suffix}"
    table = Table(name, f"Response over {' and '.join(keys[n].name for n in axes)}{fixed_text}", (*(keys[n] for n in axes), *data))
    plots = [plot for response in responses for plot in _plots(arranged.plan, response, axes, table.name, suffix, fixed_text)]
    return Part(tables=(table,), plots=tuple(plots))


def _plots(plan, response, axes, table, suffix, fixed_text):
    x, *more = (plan.grid[n] for n in axes)
    columns = tuple(column.name for column in response.columns)
    title = f"{response.title}{fixed_text}"
    if not more:
        yield Plot(f"curve.{response.name}{suffix}", title, table, x.key, columns, response.limits)
        return
    mapped = _numeric(x) and _numeric(more[0])
    if mapped:
        yield Plot(f"map.{response.name}{suffix}", title, table, x.key, (more[0].key, columns[0]), response.limits, style="map")
    if not mapped or (len(more[0].levels) <= MOST_LINES and not response.in_steps):
        yield Plot(f"curve.{response.name}{suffix}", title, table, x.key, columns[:1], response.limits, by=more[0].key)


# -- a grid alone --------------------------------------------------------------------------------------------------------------


def ranges(arranged: Arranged) -> Part:
    """`Part` of a grid without random keys: table `range` of all values."""
    cases = arranged.of(CASE)[:, 0]
    rows = [(0, name, arranged.study.unit(name), *_range(arranged, name, cases)) for name in arranged.study.value_names]
    rows = [row for row in rows if row[3]]
    if not rows:
        return Part()
    uncertain = np.any(np.isfinite([row[-4:] for row in rows]))
    table = table_of_rows("range", "Range of the values over the grid", RANGE + (RANGE_ENDS if uncertain else ()), rows)
    return Part(dict(_range_values(arranged, rows)), (table,))


def _range(arranged, name, cases):
    if arranged.everything:
        return _range_of_all(arranged.everything, name)
    column = arranged.of(name)[:, 0]
    count = len(finite(column))
    if not count:
        return 0, np.nan, -1, np.nan, -1, *[np.nan] * 4
    ends = int(np.nanargmin(column)), int(np.nanargmax(column))
    bounds = [part[:, 0] for part in arranged.bounds(name) or ()] or [np.full(len(column), np.nan)] * 2
    places = (part for end in ends for part in (float(column[end]), int(cases[end])))
    return count, *places, *(float(bound[end]) for end in ends for bound in bounds)


def _range_of_all(everything, name):
    """The same of all cases, also where only some are held."""
    ends = everything.ends[name]
    if not ends.count:
        return 0, np.nan, -1, np.nan, -1, *[np.nan] * 4
    rows = [everything.row(case) for case in (ends.least_at, ends.greatest_at)]
    bounds = [float(bound[0]) for row in rows for bound in row.bounds(name) or [np.array([np.nan])] * 2]
    return ends.count, ends.least, ends.least_at, ends.greatest, ends.greatest_at, *bounds


def _range_values(arranged, rows):
    for _, name, unit, _, least, _, greatest, _, least_low, least_high, greatest_low, greatest_high in rows:
        for end, value, low, high in (("least", least, least_low, least_high), ("greatest", greatest, greatest_low, greatest_high)):
            told = about(arranged.study, name, f"{end} over the grid")
            yield f"{end}.{name}", Value(value, unit, **told, low=low, high=high, interval="of the case").plain()


def responses(arranged: Arranged) -> Iterator[Response]:
    """`Response`s of a grid without random keys: the shown values, the worst margin, the number of failing checks, the status."""
    for name in arranged.plotted:
        study, data = arranged.study, arranged.of(name)[:, 0]
        column = Column(name, study.unit(name), study.meaning(name) or name, data, study.label(name))
        bounds = arranged.bounds(name)
        yield Response(name, study.label(name), (column,), ends=column.bounds(*(end[:, 0] for end in bounds)) if bounds else ())
    yield from _of_checks(arranged)
    if np.any(status_codes(arranged.study)):
        meaning = "status: " + ", ".join(f"{code} {name}" for code, name in enumerate(STATUSES))
        yield Response("status", "What became of the cases", (Column("status.code", "-", meaning, arranged.status[:, 0]),), True)


def _of_checks(arranged):
    """Margins of different units are compared as parts of the largest size that each check's margin has in the study."""
    columns = [CHECK + name for name in arranged.study.check_names]
    margins = [arranged.of(column)[:, 0] for column in columns]
    sizes = [np.max(np.abs(finite(margin)), initial=0.0) or 1.0 for margin in margins]
    parts = np.array([margin / size for margin, size in zip(margins, sizes, strict=True)])
    known = np.any(np.isfinite(parts), axis=0) if len(parts) else np.zeros(0, dtype=bool)
    if not np.any(known):
        return
    worst = _least(parts, known)
    meaning = "least margin of all checks, each over the largest in the study; a check fails below 0"
    column, ends = Column("checks.margin", "-", meaning, worst), ()
    if any(arranged.bounds(each) for each in columns):
        scaled = ([arranged.at_worst(each, sign)[:, 0] / size for each, size in zip(columns, sizes, strict=True)] for sign in (-1, 1))
        ends = column.bounds(*(_least(np.array(each), known) for each in scaled))
    yield Response("checks.margin", "Margin of the worst check", (column,), limits=((0.0, "limit"),), ends=ends)
    failing = np.where(known, np.sum(parts < 0, axis=0), np.nan)
    if np.any(failing > 0):
        yield Response("checks.failing", "Checks that fail", (Column("checks.failing", "-", "number of checks that fail", failing),), True)


def _least(parts, known):
    """The least of the margins (checks, combinations) that exist."""
    return np.where(known, np.min(np.where(np.isfinite(parts), parts, np.inf), axis=0), np.nan)
