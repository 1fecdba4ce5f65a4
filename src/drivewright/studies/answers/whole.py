"""Evaluation of a study: a `Result` with values, tables and findings, and its plots.  Which of them exist depends on the plan."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from drivewright import registry
from drivewright.execution.outputs import CHECK
from drivewright.result import Plot, Result, Value
from drivewright.runner import versions
from drivewright.studies.answers import causes, extremes, maps, spread
from drivewright.studies.answers.all_cases import AllCases
from drivewright.studies.answers.cases import STATUSES
from drivewright.studies.answers.extremes import Rerun
from drivewright.studies.answers.fronts import fronts
from drivewright.studies.answers.parts import Arranged, Part, join_names, together
from drivewright.studies.answers.thinned import is_large, thinned
from drivewright.studies.statistics import LEVEL, finite, varies
from drivewright.studies.study import Study

MOST = 6  # values that get plots
REASONS = 3  # that are quoted
ROUNDING = 1e-15  # of the largest value of the same unit
LONGEST = 200  # characters of a quoted reason


class Answers(NamedTuple):
    """The `Result` of a study, and its plots."""

    result: Result[Any]
    plots: tuple[Plot, ...]


def analyse_study(study: Study, values: Sequence[str] = (), rerun: Rerun | None = None) -> Answers:
    """`Answers` of a study.  `values` (check.NAME for the margin of a check) get plots; UnknownName where the study has no such column.

    Unless given they are those of the spec's [study] or else of the mechanism's headline, `MOST` at most.  Tables hold all values.
    `rerun` computes further cases, `sweeps.rerun_cases`: the worst corners of linear theory where the study has no corners.
    """
    for name in values:
        study.meaning(name)
    few = thinned(study) if is_large(study) else None
    held = few.study if few else replace(study, rows=study.table)
    shown, remarks = _shown(held, values)
    arranged = Arranged(held, shown, few.numbers, AllCases(study, few.combinations.tolist())) if few else Arranged(held, shown)
    named = values or (study.spec.study.values if study.spec.study else ())
    front = fronts(held, named, study if few else None)
    notices = Part(findings=(*([few.remark] if few else ()), *remarks))
    parts = [_cases(study), notices, *_parts(arranged, rerun), front]
    parts_joined = together(parts)
    return Answers(_result(study, parts_joined), parts_joined.plots)


def _parts(arranged, rerun):
    """What the plan allows to say."""
    if not len(arranged.study):
        return
    if not (len(arranged.sample) or arranged.plan.blocks):
        yield Part(findings=tuple(_read_as_levels(arranged)))
        yield maps.ranges(arranged)
        yield maps.surveyed(arranged, maps.responses(arranged))
        yield extremes.extremes(arranged)
        return
    yield spread.spread(arranged)
    yield spread.worst_case(arranged)
    yield extremes.worst_inputs(arranged, rerun)
    yield causes.causes(arranged)
    yield Part(findings=tuple(_assumptions(arranged)))
    if arranged.combinations > 1:
        over_grid = (*(spread.responses(arranged) if len(arranged.sample) else ()), *causes.responses(arranged))
        yield maps.surveyed(arranged, over_grid)


def _read_as_levels(arranged):
    """What a file of points turned out to be."""
    listed_keys = [variable.key for variable in arranged.study.plan.listed]
    if listed_keys:
        axes = [variable.key for variable in arranged.plan.grid if variable.key in listed_keys]
        others = [key for key in listed_keys if key not in axes]
        yield (
            f"the points of the file are all combinations of the levels of {join_names(axes)}"
            + (f"; these decide {join_names(others)}" if others else "")
            + ", so they are answered as a grid"
        )


def _assumptions(arranged):
    """What the intervals take for granted."""
    method = {"tolerance": "latin-hypercube"}.get(arranged.study.spec.study.method, arranged.study.spec.study.method)
    if arranged.plan.listed:
        yield "the points of the file are taken as a random sample; contributions as if its keys varied independently of each other"
    elif len(arranged.sample) and method != "random":
        yield (
            f"the intervals of {LEVEL:.0%} are those of independent cases; the even points of this sample ({method}) make means, "
            "as a rule, more certain than these intervals state"
        )


# -- which values --------------------------------------------------------------------------------------------------------------


def _shown(study, values):
    """(names that get plots, findings about those that do not vary)."""
    known = (*study.value_names, *(CHECK + name for name in study.check_names))
    sizes = _sizes(study, known)
    varying = [name for name in known if varies(study[name], ROUNDING * sizes[study.unit(name)])]
    still = [name for name in study.value_names if name not in varying and np.any(np.isfinite(_numbers(study, name)))]
    absent = [name for name in study.value_names if not np.any(np.isfinite(_numbers(study, name)))]
    findings = [
        f"{what} ({len(names)}): {join_names(names)}"
        for names, what in ((still, "values that do not vary over the study"), (absent, "values that no case has"))
        if names
    ]
    chosen = [name for name in _wanted(study, values, varying) if name in varying]
    shown = chosen if values else chosen[:MOST]
    if len(chosen) > len(shown):
        findings.append(f"the plots show {MOST} of {len(chosen)} values: {join_names(shown)}; the tables hold all")
    return tuple(dict.fromkeys(shown)), tuple(findings)


def _sizes(study, names):
    """{unit: greatest magnitude of its values}, beside which rounding is judged; 0 for pure numbers, which are of many kinds."""
    sizes = {"-": 0.0}
    for name in names:
        if study.unit(name) == "-":
            continue
        sizes[study.unit(name)] = max(sizes.get(study.unit(name), 0.0), np.max(np.abs(finite(_numbers(study, name))), initial=0.0))
    return sizes


def _numbers(study, name):
    return np.asarray(study[name], dtype=float)


def _wanted(study, values, varying):
    """Names that should get plots, as far as they vary."""
    if values or (study.spec.study and study.spec.study.values):
        return values or study.spec.study.values
    values = [name for name in varying if not name.startswith(CHECK)]
    return registry.headlines(registry.mechanism(study.spec.mechanism), values)


# -- cases ---------------------------------------------------------------------------------------------------------------------


def _cases(study):
    """`Part` of the counts, and why cases are not complete."""
    counts = {name: study.counts.get(name, 0) for name in STATUSES}
    values = {"cases": Value(float(len(study.plan)), "-", "cases of the study")}
    values |= {f"cases.{name}": Value(float(count), "-", f"cases that are {name}") for name, count in counts.items()}
    missing = len(study.plan) - len(study)
    values["cases.missing"] = Value(float(missing), "-", "cases that have not been run")
    findings = [f"{missing} of {len(study.plan)} cases have not been run yet"] if missing else []
    return Part(values, findings=(*findings, *_reasons(study, counts)))


def _reasons(study, counts):
    """A finding for the failed and one for the partial cases, with the commonest reasons."""
    groups = study.reasons()
    for name in ("failed", "partial"):
        if counts[name]:
            yield f"{counts[name]} of {len(study)} cases are {name}; {_commonest([group for group in groups if group.status == name])}"


def _commonest(groups):
    """The largest groups of reasons, each with its number of cases and its first message in full."""
    quoted = [f"{f'{each.cases} times' if each.cases > 1 else 'once'}: {each.text(LONGEST)}" for each in groups[:REASONS]]
    rest = len(groups) - len(quoted)
    return "; ".join(quoted) + (f"; and {rest} other reasons" if rest else "")


# -- result --------------------------------------------------------------------------------------------------------------------


def _result(study, joined):
    """The `Result`; a value that does not exist is absent."""
    spec, mechanism = study.spec, registry.mechanism(study.spec.mechanism)
    return Result(
        spec=spec,
        mechanism=mechanism.kind,
        title=f"Study: {spec.title or mechanism.summary}",
        digest=spec.digest(),
        values={name: value for name, value in joined.values.items() if np.isfinite(value.value)},
        tables={table.name: table for table in joined.tables},
        checks=(),
        findings=(*study.plan.remarks, *study.remarks, *joined.findings),
        outcome="complete" if study.complete else "partial",
        provenance={
            "seed": study.plan.seed,
            "seconds": round(study.seconds, 4),
            "analyses": list(spec.study.analyses) if spec.study else [],
            "versions": versions(),
            "sources": list(mechanism.sources),
            "plan": study.plan.digest,
        },
    )
