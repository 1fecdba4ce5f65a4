"""Optimisation of any drive: the unknowns, requirements and objectives of a spec's [optimise] table.

One objective: differential evolution (SciPy); several: NSGA-II (pymoo).  Seeded and deterministic: a search that was stopped in any way
is gone through again from its beginning, and what its folder holds is not evaluated again.
"""

import time
from collections import Counter
from collections.abc import Mapping
from contextlib import closing
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from drivewright import registry
from drivewright._typing import Floats, Ints
from drivewright.digits import plain
from drivewright.errors import InputError, SolverError
from drivewright.execution.case_table import MESSAGE, STATUS
from drivewright.execution.outputs import CHECK, case_outputs
from drivewright.labels import label_of
from drivewright.result import Check, Column, Plot, Result, Table
from drivewright.runner import build, incomplete_reasons, run, run_analyses, select_analyses, versions
from drivewright.spec import MechanismSpec
from drivewright.studies.pareto import nondominated
from drivewright.studies.search import history
from drivewright.studies.search.evaluator import SILENT, Evaluator, Progress
from drivewright.studies.search.problem import Problem, at_worst, prepare
from drivewright.studies.search.searching import METHODS, method_of
from drivewright.studies.store import Memory, Store, joined
from drivewright.studies.study_folder import Folder
from drivewright.studies.study_reading import is_study
from drivewright.view.text import labelled_scale, shown_scale, with_unit

if TYPE_CHECKING:
    import pyarrow as pa

HISTORY = "history.parquet"
DRAWN = 4000  # evaluations that a figure shows, evenly chosen, and the best ones
SETS = ("best", "meets every requirement", "fails a requirement", "has no value")
NEAR = 1e-6  # difference of two routes to a value, relative to its size, that is worth no word


@dataclass(frozen=True, eq=False)
class Optimised:
    """The outcome: best design with its full result, the front (designs, unknowns) of several objectives with its values, and every
    evaluation: `table` is a pyarrow.Table with unit and meaning of each column, a row per evaluation."""

    problem: Problem
    best: Result[Any]
    front: Floats
    front_values: dict[str, Floats]
    requirements: tuple[Check, ...]
    feasible: bool
    table: "pa.Table"
    seconds: float
    method: str
    findings: tuple[str, ...]
    folder: Path | None = None
    interrupted: bool = False

    @property
    def evaluations(self) -> int:
        """How many designs were evaluated, in all starts together."""
        return self.table.num_rows

    @property
    def seed(self) -> int:
        """Of the random numbers."""
        return self.problem.search.seed

    @cached_property
    def history(self) -> dict[str, NDArray[Any]]:
        """{column: array} of the table: generation, unknowns, values (nan where there is none), violation."""
        names = [history.GENERATION, *self.problem.keys, *(history.column_of(self.problem, name) for name in self.problem.names)]
        return {name: self.table[name].to_numpy() for name in [*names, history.VIOLATION]}

    def search(self) -> tuple[Table, Plot]:
        """(Table, Plot) of evaluations, of many a part: the objectives against each other, or the only one in the course of the search."""
        names = [name for name, _ in self.problem.objectives]
        sets = self._sets(names)
        shown = np.flatnonzero((np.arange(len(sets)) % -(-len(sets) // DRAWN) == 0) | (sets == SETS[0]))
        order = shown[np.argsort([SETS.index(each) for each in sets[shown]], kind="stable")]  # what matters lies on top
        columns = [Column("evaluation", "-", "number of the evaluation", np.arange(self.evaluations)[order])]
        columns += [self._column(name, order) for name in names]
        table = Table("search", "The search", (*columns, Column("set", "", "what became of the design", sets[order])))
        x, y = (names[0], tuple(names[1:])) if len(names) > 1 else ("evaluation", (names[0],))
        title = "Trade-off of the objectives" if len(names) > 1 else "The objective in the course of the search"
        return table, Plot("search", title, "search", x, y, style="points", by="set")

    def _column(self, name, rows):
        """Some rows of a value of the history."""
        about = self.problem.about[name]
        return Column(name, about.unit, about.meaning, self.history[history.column_of(self.problem, name)][rows], about.label)

    def _sets(self, names):
        """What became of each evaluation, as one of `SETS`."""
        values = [np.asarray(self.history[history.column_of(self.problem, name)], float) for name in names]
        sets = np.where(self.history[history.VIOLATION] <= 0, SETS[1], SETS[2])
        sets[~np.all(np.isfinite(values), axis=0)] = SETS[3]
        designs = np.stack([self.history[key].astype(float) for key in self.problem.keys], axis=1)
        best = set(map(bytes, self.front))
        sets[[n for n, design in enumerate(designs) if bytes(design) in best]] = SETS[0]
        return sets

    def objective_rows(self) -> list[tuple[str, str, str]]:
        """(value, reached, direction) as text."""
        reached = case_outputs(self.best.values, self.best.checks)
        return [
            (
                name,
                _with_interval(reached, name, self.best.units) if name in reached else "does not exist",
                "as small as possible" if sign > 0 else "as large as possible",
            )
            for name, sign in self.problem.objectives
        ]

    def unknown_rows(self) -> list[tuple[str, ...]]:
        """(key, best, lower, upper) as text."""
        keys, kinds = self.problem.keys, self.problem.kinds
        return [
            (key, *(_shown(x, kind.unit, self.best.units, 5) for x in (best, low, high)))
            for key, kind, best, (low, high) in zip(keys, kinds, self.front[0], self.problem.bounds, strict=True)
        ]


def optimise(
    spec: MechanismSpec,
    *,
    out: str | Path | None = None,
    workers: int | None = None,
    on: str | None = None,
    progress: Progress | None = None,
) -> Optimised:
    """`Optimised` of a spec with an [optimise] table.  SpecError where the table cannot be understood.

    `out` is the folder that keeps every evaluation: the same search given again goes on where it was, or answers from there.  None keeps
    them in memory.  `workers` processes (None: one per core, where the search is long enough), or `on` another place, see
    `execution.executors`; neither changes a bit.  What the mechanism evaluates in compiled code is done here.
    `progress(done, total, what)` counts the evaluations, of those that all generations could ask for.  Ctrl-C, also from `progress`, gives
    the best so far, `interrupted`.
    SolverError where no design can be computed.
    """
    problem = prepare(spec)
    with closing(_place(out, spec, method_of(problem.search))) as kept:
        return run_search(problem, kept, workers, on, progress)


def run_search(
    problem: Problem, kept: Store, workers: int | None = None, on: str | None = None, progress: Progress | None = None
) -> Optimised:
    """`Optimised` of a problem; every evaluation goes to the store `kept` within a second.  The rest as of `optimise`."""
    started, method = time.perf_counter(), method_of(problem.search)
    interrupted = _search(problem, method, Evaluator(problem, kept, workers, on, progress))
    tables = kept.tables()
    if not tables:
        raise KeyboardInterrupt
    outcome = _outcome(problem, joined(tables))
    outcome["findings"] = (*kept.notices, *outcome["findings"])
    return Optimised(problem, **outcome, seconds=time.perf_counter() - started, method=method, folder=kept.folder, interrupted=interrupted)


def _search(problem, method, evaluator):
    """Search to the end; whether it was interrupted."""
    try:
        with closing(evaluator):
            evaluator.begin()
            METHODS[method](problem, problem.search, evaluator)
    except KeyboardInterrupt:
        return True
    return False


def _place(out, spec, method):
    """The store of a search; InputError for a folder with something else in it."""
    if out is None:
        return Memory()
    if (Path(out) / HISTORY).is_file() and not is_study(out):
        raise InputError(
            f"{out}: holds the outcome of a search ({HISTORY}) by an older version, which cannot be continued; nothing was "
            "written. Remove the folder, or give another --out"
        )
    return Folder(out, spec, {"spec": spec.digest(), "search": method, "drivewright": versions()["drivewright"]})


# -- outcome -------------------------------------------------------------------------------------------------------------------


def _outcome(problem, table):
    """What an `Optimised` says of the evaluations of a table."""
    _, designs, values = history.read(problem, table)
    chosen = front_rows(problem, values)
    front, front_values = designs[chosen], {name: column[chosen] for name, column in values.items()}
    if table[STATUS][int(chosen[0])].as_py() != "complete":
        raise SolverError(_nothing(problem, table, front[0]))
    best = run(problem.design(front[0]))
    feasible = bool(problem.total_violation(front_values)[0] <= 0)
    reached = case_outputs(best.values, best.checks)
    bounds = {name: _bounds(reached, name) for name, _, _ in problem.limits}
    requirements = tuple(
        Check(
            name,
            reached[name].value if name in reached else float("nan"),
            limit,
            sense,
            problem.about[name].unit,
            "required by the search",
            low=bounds[name].get("low"),
            high=bounds[name].get("high"),
            label=_label_of(name, best),
        )
        for name, sense, limit in problem.limits
    )
    findings = [*problem.readings] + ([] if feasible else [_blame(problem, front_values, values)])
    findings += _route_differences(problem, front_values, reached)
    findings += _on_bounds(problem, front[0]) if len(problem.objectives) == 1 else []
    return {
        "best": best,
        "front": front,
        "front_values": front_values,
        "requirements": requirements,
        "feasible": feasible,
        "table": table,
        "findings": tuple(findings),
    }


def _label_of(name: str, best: Result[Any]) -> str:
    """What a requirement is about, in the words of the result: the label of a value, or of a check, whose margin counts."""
    if name in best.values:
        return label_of(best.values[name].meaning, best.values[name].label)
    named = next((check for check in best.checks if f"{CHECK}{check.name}" == name), None)
    return f"{named.display_label}, margin" if named else name


def front_rows(problem: Problem, values: Mapping[str, Floats]) -> Ints:
    """Rows of the designs that meet every requirement and that no other beats, by the first objective; else the least violating one."""
    violation = problem.total_violation(values)
    rows = np.flatnonzero(violation <= 0)
    if not len(rows):
        return np.array([np.argmin(violation)])
    objectives = problem.objective_values(values)[:, rows]
    if len(objectives) == 1:
        return rows[[np.argmin(objectives[0])]]
    order = np.lexsort(objectives[::-1])
    return rows[order[nondominated(objectives.T)[order]]]


def _nothing(problem, table, x):
    """Why no design has an answer."""
    incomplete_reasons = Counter(message for message in table[MESSAGE].to_pylist() if message)
    reason = incomplete_reasons.most_common(1)[0][0]
    if reason == SILENT:
        reason = next(iter(_why_silent(problem.design(x))), reason)
    reason = reason.rstrip(".")
    return (
        f"no feasible design after {table.num_rows} evaluations: none of them could be computed; the commonest reason: {reason}. Move "
        "the bounds of the unknowns to where the drive works"
    )


def _why_silent(spec):
    """Why the compiled route has no numbers for a design, as its run tells."""
    try:
        wanted = registry.mechanism(spec.mechanism).analyses
        return incomplete_reasons(run_analyses(spec, build(spec), select_analyses(wanted)))
    except InputError as error:
        return [str(error)]


def _blame(problem, reached, values):
    """Which requirement cannot be met: the one that the least violating design misses most."""
    violations = problem.violations(reached)[:, 0]
    count, worst = len(next(iter(values.values()))), int(np.argmax(violations))
    if worst == len(problem.limits):
        absent = ", ".join(name for name, _ in problem.objectives if not np.isfinite(reached[name][0]))
        return f"no feasible design after {count} evaluations: {absent} does not exist in any of them. Move the bounds of the unknowns"
    name, sense, limit = problem.limits[worst]
    unit, system = problem.about[name].unit, problem.spec.units
    alone = int(np.sum(problem.violations(values)[worst] <= 0))
    end = at_worst(reached, name, sense)[0]
    uncertain = f" with an interval to {_shown(end, unit, system)}, all of which has to meet it" if end != reached[name][0] else ""
    wanted, best = (_shown(each, unit, system) for each in (limit, reached[name][0]))
    return (
        f"no feasible design after {count} evaluations; the limiting requirement is {name} {sense} {wanted}: the least "
        f"violating design reaches {best}{uncertain}, and {alone} of the designs tried meet this one at all. "
        "Relax it or widen the bounds of the unknowns."
    )


def _route_differences(problem, evaluated, reached):
    """Where the evaluation during the search and the run of the best design part."""
    for name, column in evaluated.items():
        value = reached[name].value if name in reached else np.nan
        if np.isfinite(column[0]) and not abs(column[0] - value) <= NEAR * max(abs(column[0]), abs(value)):
            ours, run_ = (_shown(each, problem.about[name].unit, problem.spec.units, 8) for each in (column[0], value))
            yield f"{name}: the compiled evaluation of the search gives {ours}, the run of the best design {run_}"


def _on_bounds(problem, x):
    low, high = problem.bounds.T
    share = (x - low) / (high - low)
    for key, u in zip(problem.keys, share, strict=True):
        if u < 0.01 or u > 0.99:
            yield f"{key} sits on its {'lower' if u < 0.5 else 'upper'} bound; a wider bound may give a better design"


def _bounds(reached, name):
    """{"low", "high"} of an output, where it has an interval."""
    ends = {side: reached.get(f"{name}.{side}") for side in ("low", "high")}
    return {side: end.value for side, end in ends.items()} if all(end and end.bounds == name for end in ends.values()) else {}


def _with_interval(reached, name, system):
    """A number with its interval, in the digits that this supports."""
    output = reached[name]
    shown = labelled_scale(label_of(output.meaning, output.label), output.unit, system, output.value)
    value, *ends = plain(*(shown.of(each) for each in (output.value, *_bounds(reached, name).values())))
    return _with_unit(f"{value} ({ends[0]} to {ends[1]})", shown.unit) if ends else _with_unit(f"{shown.of(output.value):.6g}", shown.unit)


def _shown(value, unit, system, digits=6):
    """A number in the unit people read in a system of units, with the unit."""
    shown = shown_scale(unit, system=system, size=value)
    return _with_unit(f"{shown.of(value):.{digits}g}", shown.unit)


def _with_unit(text, unit):
    """Typed with plain spaces, to be copied from a terminal."""
    return with_unit(text, unit).replace("\u00a0", " ")
