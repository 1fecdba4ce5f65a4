"""The trade-off between objectives: the Pareto front of the cases of a study."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from drivewright import units
from drivewright.errors import InputError
from drivewright.execution.case_table import CASE
from drivewright.execution.outputs import CHECK
from drivewright.result import Column, Plot, Table, Value
from drivewright.studies.answers.cases import passing
from drivewright.studies.answers.parts import Part, join_names, plain
from drivewright.studies.pareto import ABSENT, DOMINATED, FAILS, FRONT, classify_designs
from drivewright.studies.study import Study

DRAWN = (FRONT, DOMINATED, FAILS)  # from the top down


def fronts(study: Study, values: Sequence[str] = (), whole: Study | None = None) -> Part:
    """`Part` of a study with two objectives or more: tables `pareto` and `front`, and the points of the former.

    `whole`: the study of which `study` holds some cases; the front is that of all of them.

    Objectives and requirements are those of the spec's [optimise]; without, two values named are made small.
    """
    goals, remarks = _goals(study, values)
    if not goals:
        return Part(findings=remarks)
    if whole is not None:
        study = _with_front(study, whole, goals)
    sets, columns, ignored = _sets(study, goals)
    return _front_part(study, goals, columns, sets, (*remarks, *ignored))


def _sets(study, goals):
    """(set of each row, the objectives, findings)."""
    met, ignored = _requirements(study)
    columns = [np.asarray(study[name], dtype=float) for name in goals]
    return classify_designs(columns, goals.values(), passing(study) & met), columns, ignored


def _with_front(study, whole, goals):
    """Some cases of a study and those of its Pareto front, which is found piece by piece: what a piece beats is on no front."""
    import pyarrow as pa

    front = study.schema.empty_table()
    for table in whole.batches():
        joint = replace(whole, rows=pa.concat_tables([front, table]))
        front = joint.table.filter(_sets(joint, goals)[0] == FRONT)
    others = study.table.filter(~np.isin(study[CASE], front[CASE].to_numpy()))
    return replace(study, rows=pa.concat_tables([others, front]))


def _goals(study, values):
    """({value: minimise or maximise}, findings)."""
    search = study.spec.optimise
    if search and len(search.objectives) > 1:
        goals = {each.value: each.goal for each in search.objectives}
        missing = [name for name in goals if name not in study.value_names]
        return ({}, (f"no Pareto front: no case has the objective {join_names(missing)}",)) if missing else (goals, ())
    named = [name for name in values if not name.startswith(CHECK)]
    if len(named) != 2 or not set(named) <= set(study.value_names):
        return {}, ()
    return dict.fromkeys(named, "minimise"), (
        f"the Pareto front takes {named[0]} and {named[1]} as to be made small; say otherwise in [[optimise.objectives]]",
    )


def _requirements(study):
    """((rows,) whether all requirements are met, by whole intervals, findings about those that cannot be read)."""
    met, ignored = np.ones(len(study), dtype=bool), []
    for number, requirement in enumerate(study.spec.optimise.requirements if study.spec.optimise else ()):
        try:
            for sign, limit in _limits(study, requirement):
                met &= sign * (study.at_worst(requirement.value, -sign) - limit) >= 0
        except InputError as error:
            ignored.append(f"optimise.requirements.{number} is left out of the Pareto front: {error}")
    return met, ignored


def _limits(study, requirement):
    """(sign, limit [SI]) of each side; a limit without a unit is a pure number."""
    study[requirement.value]  # UnknownName where no case has it
    dimension = units.BY_UNIT.get(study.unit(requirement.value))
    sides = ((1.0, requirement.at_least), (-1.0, requirement.at_most))
    return [(sign, dimension.parse(limit) if dimension else float(limit)) for sign, limit in sides if limit is not None]


def _front_part(study, goals, columns, sets, remarks):
    """The `Part` of sorted out cases; those that lack an objective are left out."""
    there = np.flatnonzero(sets != ABSENT)
    if not len(there):
        return Part(findings=(*remarks, "no Pareto front: no case has all objectives"))
    there = there[np.argsort([DRAWN.index(each) for each in sets[there]], kind="stable")]
    members = there[sets[there] == FRONT]
    members = members[np.argsort(columns[0][members], kind="stable")]
    plots = tuple(
        Plot(
            "pareto" if number == 1 else f"pareto.{number}",
            "Trade-off of the objectives",
            "pareto",
            list(goals)[0],
            (name,),
            style="points",
            by="set",
        )
        for number, name in enumerate(list(goals)[1:], 1)
    )
    if not len(members):
        remarks = (*remarks, "no case passes every check and requirement, so the Pareto front is empty")
    title = " and ".join(f"{study.label(name)} ({goal})" for name, goal in goals.items())
    tables = (
        Table("pareto", f"Cases by {title}", _columns(study, goals, there, sets)),
        *([Table("front", f"Pareto front of {title}", _columns(study, goals, members, sets))] if len(members) else []),
    )
    return Part({"front.cases": Value(float(len(members)), "-", "cases on the Pareto front")}, tables, plots, remarks)


def _columns(study, goals, rows, sets):
    """Objectives, keys, case and set of some rows, and the ends of the objectives' intervals."""
    about = {name: study.meaning(name) or name for name in (*goals, "case")} | {key: key for key in study.plan.keys}
    return (
        *(Column(name, study.unit(name), meaning, plain(study[name])[rows], study.label(name)) for name, meaning in about.items()),
        Column("set", "", "front, dominated, or fails a check or requirement", sets[rows].astype(str)),
        *(
            end
            for name in goals
            if (bounds := study.bounds(name)) is not None
            for end in Column(name, study.unit(name), about[name], rows, study.label(name)).bounds(*(each[rows] for each in bounds))
        ),
    )
