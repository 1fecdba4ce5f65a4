"""What commands print with --json: plain dictionaries, numbers in SI; what does not exist is null."""

import json
import math
import sys
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from drivewright.studies.answers.whole import Answers
    from drivewright.studies.optimisation import Optimised
    from drivewright.studies.study import Study
    from drivewright.studies.verification import Comparison
    from drivewright.validation.source import Row, Source


def print_json(record: object) -> None:
    """A record on stdout."""
    json.dump(plain(record), sys.stdout, indent=1)
    print()


def plain(record: Any) -> Any:
    """The same in what JSON knows; a number that is not finite is null."""
    if isinstance(record, Mapping):
        return {str(key): plain(each) for key, each in record.items()}
    if isinstance(record, np.ndarray):
        return plain(record.tolist())
    if isinstance(record, (list, tuple)):
        return [plain(each) for each in record]
    if isinstance(record, np.generic):
        return plain(record.item())
    if isinstance(record, float):
        return record if math.isfinite(record) else None
    return record if record is None or isinstance(record, (bool, int, str)) else str(record)


def study_record(study: "Study", answers: "Answers | None" = None) -> dict[str, Any]:
    """Cases by status, what varies, and least and greatest of every value with the number of its case; the answers' values where they
    are there."""
    from drivewright.studies.answers.extremes import ends_of_columns

    ends = ends_of_columns(study, study.value_names)
    return {
        "mechanism": study.spec.mechanism,
        "title": study.spec.title,
        "folder": study.folder,
        "cases": len(study.plan),
        "done": len(study),
        "counts": study.counts,
        "varied": list(study.plan.keys),
        "values": {
            name: {
                "unit": study.unit(name),
                "label": study.label(name),
                **{word: {"value": end.number, "case": end.case} for word, end in zip(("least", "greatest"), pair, strict=True)},
            }
            for name, pair in ends.items()
        },
        "answers": {name: value.record() for name, value in answers.result.values.items()} if answers else {},
        "reasons": [{"status": group.status, "cases": group.cases, "text": group.text()} for group in study.reasons()],
        "remarks": [*study.plan.remarks, *study.remarks, *study.notices],
    }


def search_record(search: "Optimised") -> dict[str, Any]:
    """The best design: its unknowns, objectives, requirements, and how the search ended."""
    problem, best = search.problem, search.best.values
    return {
        "mechanism": problem.spec.mechanism,
        "title": problem.spec.title,
        "folder": search.folder,
        "method": search.method,
        "seed": search.seed,
        "evaluations": search.evaluations,
        "feasible": search.feasible,
        "interrupted": search.interrupted,
        "unknowns": {
            key: {"value": value, "unit": kind.unit, "lower": low, "upper": high}
            for key, kind, value, (low, high) in zip(problem.keys, problem.kinds, search.front[0], problem.bounds, strict=True)
        },
        "objectives": {
            name: {
                "value": search.front_values[name][0],
                "unit": problem.about[name].unit,
                "goal": "minimise" if sign > 0 else "maximise",
                **({"run": best[name].record()} if name in best else {}),
            }
            for name, sign in problem.objectives
        },
        "front": {
            **dict(zip(problem.keys, search.front.T, strict=True)),
            **{name: search.front_values[name] for name, _ in problem.objectives},
        },
        "requirements": [check.record() for check in search.requirements],
        "findings": search.findings,
    }


def verification_record(rows: "Sequence[Comparison]") -> dict[str, Any]:
    """Our numbers beside those of the independent route."""
    return {
        "ok": all(row.ok for row in rows),
        "rows": [{**row._asdict(), "difference": row.other - row.ours, "ok": row.ok} for row in rows],
    }


def validation_record(sources: "Sequence[Source]", rows: "Mapping[str, Sequence[Row]]") -> dict[str, Any]:
    """Every printed number beside ours, by source."""
    return {
        source.name: {
            "citation": source.citation,
            "rows": [
                {
                    "name": row.name,
                    "printed": str(row.printed),
                    "ours": row.ours,
                    "unit": row.unit,
                    "low": row.low,
                    "high": row.high,
                    "deviation": row.deviation,
                    "verdict": row.verdict,
                    "pinned": row.pinned,
                    "where": row.where,
                    "comment": row.commentary,
                }
                for row in rows[source.name]
            ],
        }
        for source in sources
    }
