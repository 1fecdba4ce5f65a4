"""The designs of a search as a table like that of a study: those that no other beats, and all that were tried, while it runs too."""

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from drivewright._typing import Floats
from drivewright.execution.outputs import CHECK
from drivewright.studies.optimisation import Optimised, front_rows
from drivewright.studies.search.problem import Problem
from drivewright.studio.design import Design
from drivewright.studio.jobs.design_keys import input_text, label, plain
from drivewright.studio.jobs.study import evenly_spaced_rows
from drivewright.view.text import display_unit, sentence

MOST_FRONT = 500  # designs of a front that a page is sent
MOST_TRIED = 1000  # designs of a search besides


def settings(problem: Problem, x: Floats) -> dict[str, str]:
    """{key: text} of a design of the search, with what the search sets besides."""
    texts = {setting.key: _plain_text(setting.value) for setting in problem.search.settings}
    return texts | {key: input_text(kind, value) for key, kind, value in zip(problem.keys, problem.kinds, x, strict=True)}


def label_of(problem: Problem, name: str) -> str:
    """What a value of the search is, as a sentence."""
    return sentence(problem.about[name].meaning or name)


def front_table(design: Design, outcome: Optimised) -> dict[str, Any]:
    """The designs that no other beats: {"columns", "rows", "load"}."""
    chosen = evenly_spaced_rows(len(outcome.front), MOST_FRONT)
    return _table(design, outcome.problem, outcome.front, outcome.front_values, chosen)


def tried(design: Design, problem: Problem, designs: Floats, values: Mapping[str, Floats]) -> dict[str, Any] | None:
    """Designs that a search with several objectives has tried, the front among them; None for a single objective.

    {"columns", "rows", "load", "cases": number of each, "passes": whether it meets every requirement, "fronts": [{"objectives": [{"name",
    "goal"}], "rows"}] by the first objective, "total": of how many these are a part}.
    """
    if len(problem.objectives) < 2:
        return None
    passes = problem.total_violation(values) <= 0
    best = front_rows(problem, values) if np.any(passes) else np.array([], int)
    best = best[evenly_spaced_rows(len(best), MOST_FRONT)]
    chosen = evenly_spaced_rows(len(designs), MOST_TRIED, best.tolist())
    objectives = [{"name": name, "goal": "minimise" if sign > 0 else "maximise"} for name, sign in problem.objectives]
    return _table(design, problem, designs, values, chosen) | {
        "cases": chosen.tolist(),
        "passes": passes[chosen].tolist(),
        "fronts": [{"name": "front", "objectives": objectives, "rows": np.searchsorted(chosen, best).tolist()}] if len(best) else [],
        "total": len(designs),
    }


def _table(design: Design, problem: Problem, designs: Floats, values: Mapping[str, Floats], chosen: Iterable[int]) -> dict[str, Any]:
    """Some of the designs as rows in the units people read, with the keys that make each."""
    keys = list(zip(problem.keys, problem.kinds, strict=True))
    columns = [{"name": key, "label": label(design.tables, key), "unit": display_unit(kind.unit)[1], "role": "key"} for key, kind in keys]
    columns += [
        {"name": name, "label": label_of(problem, name), "unit": display_unit(about.unit)[1], "role": _role(name)}
        for name, about in problem.about.items()
    ]
    units = [kind.unit for kind in problem.kinds] + [about.unit for about in problem.about.values()]
    data = [*designs.T, *(values[name] for name in problem.about)]
    rows = [[plain(column[n], unit) for column, unit in zip(data, units, strict=True)] for n in chosen]
    return {"columns": columns, "rows": rows, "load": [settings(problem, designs[n]) for n in chosen]}


def _role(name: str) -> str:
    return "check" if name.startswith(CHECK) else "value"


def _plain_text(value: object) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)
