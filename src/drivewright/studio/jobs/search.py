"""The [optimise] of a design: a search for its best, reported while it runs."""

from collections.abc import Sequence
from copy import deepcopy
from dataclasses import replace
from typing import Any

import numpy as np

from drivewright.errors import SpecError
from drivewright.report.content import Views, pictures, summary
from drivewright.studies.optimisation import run_search
from drivewright.studies.search import history
from drivewright.studies.search.problem import prepare
from drivewright.studies.store import Memory, joined
from drivewright.studio.design import Design
from drivewright.studio.jobs.design_keys import is_locked, label, plain
from drivewright.studio.jobs.figures import drawn
from drivewright.studio.jobs.progress import Progress
from drivewright.studio.jobs.study import Live
from drivewright.studio.jobs.trade_off import front_table, label_of, settings, tried
from drivewright.view.text import SIGNS, display_unit, quantity, uncertain


def optimise(
    design: Design, progress: Progress, locks: Sequence[str] = (), workers: int | None = None, on: str | None = None, theme: str = "light"
) -> dict[str, Any]:
    """The best design of the [optimise] table, unknowns that are locked left as they are.

    {"changes": {key: text}, "unknowns", "objectives", "requirements", "feasible", "message", "findings", "verdict", "evaluations", "front":
    {"columns", "rows", "load"}, "tried": `trade_off.tried`, "history", "figures"}; on the way {"cases", "history", "best": {key: text},
    "objective", "tried"}.  history: [number of designs, best value so far in the unit people read or None, least violation so far].
    """
    free, left_out = _freed(design, locks)
    problem = prepare(free.spec_on_screen())
    kept = Memory()
    outcome = run_search(problem, kept, workers, on, Live(progress, lambda: _so_far(design, problem, kept)))
    return _search_summary(design, outcome, left_out, theme)


def _freed(design, locks):
    """(design without the unknowns that are locked, their keys); SpecError where none remains."""
    tables = deepcopy(design.tables)
    search = tables.get("optimise")
    if not isinstance(search, dict):
        raise SpecError(
            "Choose the parameters to vary and an objective; write them into the text of the design, for example:\n"
            '[[optimise.unknowns]]\nkey = "KEY"\nlower = "FROM"\nupper = "TO"\n\n[[optimise.objectives]]\nvalue = "VALUE"\n'
            'goal = "minimise"',
            "optimise",
        )
    unknowns = search.get("unknowns", [])
    locked = [unknown["key"] for unknown in unknowns if is_locked(tables, unknown["key"], locks)]
    search["unknowns"] = [unknown for unknown in unknowns if unknown["key"] not in locked]
    if locked and not search["unknowns"]:
        raise SpecError(f"every unknown is locked ({', '.join(locked)}), so nothing may change; unlock one", "optimise.unknowns")
    return design.with_tables(tables), locked


# -- the course of the search --------------------------------------------------------------------------------------------------


def _so_far(design, problem, kept):
    """What the page shows while the search goes on; None before the first evaluations are there."""
    tables = kept.tables()
    if not tables:
        return None
    table = joined(tables)
    _, designs, values = history.read(problem, table)
    course, best = _best_so_far(problem, values)
    return {
        "cases": table.num_rows,
        "history": course,
        "best": settings(problem, designs[best]),
        "objective": _objective(problem),
        "tried": tried(design, problem, designs, values),
    }


def _best_so_far(problem, values):
    """([[number, best, violation]] at every improvement and at the end, row of the best design): by the first objective."""
    name, sign = problem.objectives[0]
    violation = problem.total_violation(values)
    wanted = np.where((violation <= 0) & np.isfinite(values[name]), sign * values[name], np.inf)
    least, lowest = np.minimum.accumulate(violation), np.minimum.accumulate(wanted)
    turns = np.flatnonzero(np.concatenate([[True], (np.diff(least) < 0) | (lowest[1:] < lowest[:-1])]))
    unit = problem.about[name].unit
    points = [[int(n) + 1, plain(sign * lowest[n], unit), plain(least[n])] for n in sorted({*turns.tolist(), len(least) - 1})]
    return points, int(np.argmin(wanted) if np.isfinite(lowest[-1]) else np.argmin(violation))


def _objective(problem):
    name, sign = problem.objectives[0]
    return {
        "name": name,
        "label": label_of(problem, name),
        "unit": display_unit(problem.about[name].unit)[1],
        "goal": "minimise" if sign > 0 else "maximise",
    }


# -- the outcome ---------------------------------------------------------------------------------------------------------------


def _search_summary(design, outcome, left_out, theme):
    problem = outcome.problem
    _, designs, values = history.read(problem, outcome.table)
    return {
        "changes": settings(problem, outcome.front[0]),
        "unknowns": _unknowns(design, outcome),
        "objective": _objective(problem),
        "objectives": [
            {"name": name, "label": label_of(problem, name), "text": text, "goal": goal} for name, text, goal in outcome.objective_rows()
        ],
        "requirements": [_requirement(check) for check in outcome.requirements],
        "feasible": outcome.feasible,
        "message": _message(outcome, left_out),
        "findings": list(outcome.findings),
        "verdict": summary(outcome.best)["verdict"],
        "evaluations": outcome.evaluations,
        "seed": outcome.seed,
        "method": outcome.method,
        "history": _best_so_far(problem, values)[0],
        "front": front_table(design, outcome),
        "tried": tried(design, problem, designs, values),
        "figures": _figures(outcome, theme),
    }


def _unknowns(design, outcome):
    """Each unknown with its best value and its bounds as text."""
    return [
        {"key": key, "label": label(design.tables, key), "best": best, "lower": lower, "upper": upper}
        for key, best, lower, upper in outcome.unknown_rows()
    ]


def _requirement(check):
    """Met is what the whole interval of the value meets."""
    low, high = check.bounds or (None, None)
    return {
        "name": check.name,
        "ok": check.ok and not check.undecided,
        "value": uncertain(check.value, check.unit, low, high),
        "limit": f"{SIGNS[check.sense]} {quantity(check.limit, check.unit)}",
    }


def _message(outcome, left_out):
    """One or two sentences."""
    several = len(outcome.front) > 1
    message = (
        (
            f"{len(outcome.front)} designs that no other beats, of {outcome.evaluations}"
            if several
            else f"the best of {outcome.evaluations} designs"
        )
        if outcome.feasible
        else f"no design of {outcome.evaluations} meets every requirement; this one comes nearest"
    )
    return message + (f". Locked and left as they are: {', '.join(left_out)}" if left_out else "")


def _figures(outcome, theme):
    """The search itself as a figure."""
    table, plot = outcome.search()
    return drawn(pictures(replace(outcome.best, tables={table.name: table}), Views(plots=(plot,))), theme)
