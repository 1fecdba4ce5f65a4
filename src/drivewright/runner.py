"""One run: spec -> model -> analyses -> result.  The data goes one way; nothing is filled in later."""

import math
import os
import platform
import time
import traceback
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from typing import Any

import numpy as np

from drivewright import registry
from drivewright.errors import DEBUG, DrivewrightError, MissingExtra, SolverError, UnknownName
from drivewright.registry import Analysis, Mechanism
from drivewright.result import Answer, Answers, Result, SpecLike, SpecT, Table
from drivewright.steps import Progress
from drivewright.stops import Stop, collect_stops

ON_REQUEST = "runs on request: --only"  # in the finding on an analysis that is not among the usual ones


def build(spec: SpecLike) -> Any:
    """The model of a spec: curves, trains, systems - common types only."""
    return registry.mechanism(spec.mechanism).build(spec)


def run(
    spec: SpecT, only: Iterable[str] | str = (), everything: bool = False, progress: Progress | None = None, model: Any = None
) -> Result[SpecT]:
    """Result of the default analyses of a spec, of exactly those named in `only` and what they need, or of all.

    `progress(done, total, name)` is called before each analysis.  What is left out is listed in the findings; an analysis of `only`, or
    one whose own table the spec gives, among the warnings.
    `model` is the spec's own, where it has been built already.  An analysis that fails in whatever way, or that looks at a run which
    stopped, makes the outcome "partial", and a finding says why; the other analyses keep their answers.
    """
    started = time.perf_counter()
    mechanism = registry.mechanism(spec.mechanism)
    only = (only,) if isinstance(only, str) and only else tuple(only)
    selected = select_analyses(mechanism.analyses, only, everything)
    model = mechanism.build(spec) if model is None else model
    began: dict[str, float] = {}
    answers = run_analyses(spec, model, selected, _timed(began, progress))
    ended = time.perf_counter()
    left_out = {name: "".join(answer.findings[-1:]) for name, answer in answers.items() if answer.outcome == "left out"}
    unanswered = [left_out[name] for name in dict.fromkeys((*only, *_given_tables(spec, left_out))) if left_out.get(name)]
    warnings = tuple(dict.fromkeys([*(warning for answer in answers.values() for warning in answer.warnings), *unanswered]))
    findings = [*warnings, *getattr(spec, "readings", {}).values(), *getattr(model, "findings", ())]
    findings += [each for each in _findings(answers) if each not in unanswered]
    findings += [*stop_findings(answers), *_missing_numbers(answers)]
    findings += [
        f"analysis '{a.name}' ({a.meaning}) {ON_REQUEST} {a.name}"
        for a in mechanism.analyses
        if not only and not everything and not a.default
    ]
    answers = {name: _with_stop_times(answer) for name, answer in answers.items()}
    result = _result(spec, mechanism, answers, findings, time.perf_counter() - started)
    return replace(result, warnings=warnings, left_out=left_out, timings=_durations(began, ended))


def _timed(began: dict[str, float], progress: Progress | None) -> Progress:
    """The progress callback that also writes into `began` when each analysis began."""

    def begin(done: int, total: int, name: str) -> None:
        began[name] = time.perf_counter()
        if progress:
            progress(done, total, name)

    return begin


def _durations(began: Mapping[str, float], ended: float) -> dict[str, float]:
    """{analysis: seconds} of analyses that ran one after another."""
    return {name: end - start for (name, start), end in zip(began.items(), [*list(began.values())[1:], ended], strict=True)}


def _given_tables(spec: SpecLike, names: Iterable[str]) -> Iterator[str]:
    """Those of the analyses whose table of the same name in the spec is not as it is by default: the user requests them."""
    fields = getattr(type(spec), "model_fields", {})
    yield from (name for name in names if name in fields and getattr(spec, name) != fields[name].get_default(call_default_factory=True))


def run_analyses(
    spec: SpecLike,
    model: Any,
    selected: Sequence[Analysis[Any, Any]],
    progress: Progress | None = None,
    reraise: tuple[type[BaseException], ...] = (),
) -> dict[str, Answer]:
    """{name: Answer} of the selected analyses, one after another; each sees those before it.

    Exceptions of the kinds `reraise` are not the analysis' own (a study calls memory and imports the place's) and are let through.
    """
    answers = {}
    for number, analysis in enumerate(selected):
        if progress:
            progress(number, len(selected), analysis.name)
        answers[analysis.name] = _with_inherited_stops(analysis, answers, *_answer(analysis, spec, model, answers, reraise))
    return answers


def _findings(answers: Answers) -> Iterator[str]:
    """The findings of all analyses; those that failed for one and the same reason say it once."""
    failures = _failures(answers)
    stated = set()
    for name, answer in answers.items():
        yield from answer.findings[:-1] if answer.failure else answer.findings
        if answer.failure and failures[name] not in stated:
            stated.add(failures[name])
            yield failures[name]


def _failures(answers: Answers) -> dict[str, str]:
    """{analysis that failed: the finding that says why}, one and the same for those that failed for one reason."""
    by_failure: dict[str, list[str]] = {}
    for name, answer in answers.items():
        if answer.failure:
            by_failure.setdefault(answer.failure, []).append(name)
    return {
        name: f"analyses {', '.join(map(repr, names))} fail alike; each {failure}" if len(names) > 1 else answers[name].findings[-1]
        for failure, names in by_failure.items()
        for name in names
    }


def stop_findings(answers: Answers) -> list[str]:
    """A sentence for every run that stopped, with the analyses that look at it."""
    analyses: dict[Stop, list[str]] = {}
    for name, answer in answers.items():
        for stop in answer.stopped:
            analyses.setdefault(stop, []).append(name)
    return [f"{str(stop).rstrip('.')}. Partial for that reason: {', '.join(names)}" for stop, names in analyses.items()]


def _missing_numbers(answers: Answers) -> Iterator[str]:
    """A sentence for every check and table with numbers that do not exist."""
    for answer in answers.values():
        for check in answer.checks:
            if not (math.isfinite(check.value) and math.isfinite(check.limit)):
                yield f"check '{check.name}' ({check.message}) does not exist for this design: {check.value} {check.sense} {check.limit}"
        for table in answer.tables:
            if not table.missing:
                yield from _missing_numbers_of(table)


def _missing_numbers_of(table: Table) -> Iterator[str]:
    """The same of one table: its columns with missing numbers, and how many rows the worst of them lacks."""
    columns = {c.name: int(np.sum(~np.isfinite(c.data))) for c in table.columns if np.asarray(c.data).dtype.kind == "f"}
    names = [name for name, count in columns.items() if count]
    if names:
        shown = ", ".join(names[:3]) + (f" and {len(names) - 3} more" if len(names) > 3 else "")
        yield (
            f"table '{table.name}' ({table.title}): {shown} do{'es' if len(names) == 1 else ''} not exist in "
            f"{max(columns.values())} of {len(table.columns[0].data)} rows"
        )


def incomplete_reasons(answers: Answers) -> list[str]:
    """Why answers are not complete, in short."""
    left = [finding for answer in answers.values() if answer.outcome != "complete" for finding in answer.findings[-1:]]
    return [*left, *stop_findings(answers)]


def select_analyses(
    analyses: Iterable[Analysis[Any, Any]], only: Iterable[str] | str = (), everything: bool = False
) -> tuple[Analysis[Any, Any], ...]:
    """The analyses to do, each after those that it needs; UnknownName for a name that is none."""
    by_name = {a.name: a for a in analyses}
    only = (only,) if isinstance(only, str) else only
    for name in only:
        if name not in by_name:
            raise UnknownName("analysis", name, by_name)
    chosen = {}

    def take(name):
        if name not in chosen:
            for needed in by_name[name].needs:
                take(needed)
            chosen[name] = by_name[name]

    for analysis in analyses:
        if analysis.name in only if only else (everything or analysis.default):
            take(analysis.name)
    return tuple(chosen.values())


def _answer(
    analysis: Analysis[Any, Any], spec: SpecLike, model: Any, answers: Answers, reraise: tuple[type[BaseException], ...]
) -> tuple[Answer, tuple[Stop, ...]]:
    """(answer, stops of what it looks at): an empty answer with a finding where input or an extra is missing, or where it fails."""
    with collect_stops() as stopped:
        try:
            unmet = (f"it needs '{name}', which is {answers[name].outcome}" for name in analysis.needs if not _is_usable(answers[name]))
            reason = analysis.missing(spec) or next(unmet, None)
            return (analysis.answer(model, answers) if reason is None else _left_out(analysis, reason)), tuple(stopped)
        except MissingExtra as error:
            return _left_out(analysis, error), ()
        except reraise:
            raise
        except Exception as error:
            return _failed(analysis, spec, error), tuple(stopped)


def _with_inherited_stops(analysis: Analysis[Any, Any], answers: Answers, answer: Answer, stopped: tuple[Stop, ...]) -> Answer:
    """The answer with the stops of what it looked at, directly or through the analyses that it needs: it is no more complete than they."""
    needed = [answers[name] for name in analysis.needs]
    stops = dict.fromkeys((*answer.stopped, *stopped, *(stop for other in needed for stop in other.stopped)))
    cut = bool(stops) or any(other.outcome == "partial" for other in needed)
    return replace(answer, stopped=tuple(stops), outcome="partial" if cut and answer.outcome == "complete" else answer.outcome)


def _with_stop_times(answer: Answer) -> Answer:
    """The answer whose values say until when they were computed, where a run stopped."""
    if not answer.stopped:
        return answer
    where = "; ".join(stop.where for stop in answer.stopped)
    return replace(answer, values={name: v._replace(meaning=f"{v.meaning} ({where})") for name, v in answer.values.items()})


def _left_out(analysis: Analysis[Any, Any], reason: object) -> Answer:
    return Answer(findings=(f"analysis '{analysis.name}' ({analysis.meaning}) is left out: {reason}",), outcome="left out")


def _is_usable(answer: Answer) -> bool:
    """Whether an analysis that needs this answer can go on from it."""
    return answer.outcome == "complete" or (answer.outcome == "partial" and answer.data is not None)


def _failed(analysis: Analysis[Any, Any], spec: SpecLike, error: Exception) -> Answer:
    """What an analysis had when it failed, with a finding that says why: its solver, the design, the memory, or a fault of ours."""
    partial = getattr(error, "partial", None)
    partial_answer = partial if isinstance(partial, Answer) else Answer()
    of_design = "gave up: " if isinstance(error, SolverError) else "has no answer for this design: "
    failure = f"{of_design if isinstance(error, DrivewrightError) else ''}{failure_reason(spec, error)}"
    finding = f"analysis '{analysis.name}' ({analysis.meaning}) {failure}"
    return replace(partial_answer, outcome="partial", findings=(*partial_answer.findings, finding), failure=failure)


def failure_reason(spec: SpecLike, error: Exception) -> str:
    """Why something about a spec failed, in words: those of our own error, else the predicate of a sentence on the machine or on us."""
    if isinstance(error, DrivewrightError):
        return str(error)
    if isinstance(error, MemoryError):
        return "needs more memory than there is; take fewer turns, samples or elements, or leave it out"
    return _program_fault(spec, error)


def _program_fault(spec: SpecLike, error: Exception) -> str:
    """What to say, and to report, of an exception that nobody expected."""
    if os.environ.get(DEBUG):
        traceback.print_exception(error)
    return (
        f"failed by a fault of the program, not of the spec: {type(error).__name__}: {error}. Please report it with drivewright "
        f"{versions()['drivewright']}, {spec.mechanism}, spec digest {spec.digest()}; drivewright --debug shows where it happened"
    )


def _result(spec: SpecT, mechanism: Mechanism[Any, Any], answers: Answers, findings: Iterable[str], seconds: float) -> Result[SpecT]:
    values = {k: v.plain() for a in answers.values() for k, v in a.values.items()}
    absent = {k: v for k, v in values.items() if not math.isfinite(v.value)}
    findings = [*findings, *(f"value '{name}' ({v.meaning}) does not exist for this design: it is {v.value}" for name, v in absent.items())]
    return Result(
        spec=spec,
        mechanism=mechanism.kind,
        title=spec.title or mechanism.summary,
        digest=spec.digest(),
        values={k: v for k, v in values.items() if k not in absent},
        arrays={k: v for a in answers.values() for k, v in a.arrays.items()},
        tables={t.name: t for a in answers.values() for t in a.tables},
        fields={each.name: each for a in answers.values() for each in a.fields},
        checks=tuple(c for a in answers.values() for c in a.checks),
        check_sources={c.name: name for name, a in answers.items() for c in a.checks},
        findings=tuple(findings),
        outcome="partial" if any(a.outcome == "partial" for a in answers.values()) else "complete",
        failures=_failures(answers),
        value_sources={name: analysis for analysis, answer in answers.items() for name in answer.values if name not in absent},
        provenance={
            "seed": spec.optimise.seed if spec.optimise else 0,
            "seconds": round(seconds, 4),
            "analyses": list(answers),
            "failed": [name for name, answer in answers.items() if answer.outcome == "partial" and not answer.stopped],
            "versions": versions(),
            "sources": list(mechanism.sources),
        },
    )


def versions() -> dict[str, str]:
    """Version of Python and of the libraries that make numbers."""
    return dict(_versions())


@cache
def _versions() -> dict[str, str]:
    by_library = {"python": platform.python_version()}
    for name in ("drivewright", "numpy", "scipy", "numba"):
        try:
            by_library[name] = version(name)
        except PackageNotFoundError:
            by_library[name] = "not installed"
    return by_library
