"""One run: spec -> model -> analyses -> result.  The data goes one way; nothing is filled in later."""

import math
import platform
import time
from dataclasses import replace
from functools import cache
from importlib.metadata import PackageNotFoundError, version

from drivewright import registry
from drivewright.errors import MissingExtra, SolverError, UnknownName
from drivewright.result import Answer, Result


def build(spec):
    """The model of a spec: curves, trains, systems - common types only."""
    return registry.mechanism(spec.mechanism).build(spec)


def run(spec, only=(), everything=False, progress=None, model=None):
    """Result of the default analyses of a spec, of exactly those named in `only` and what they need, or of all.

    `progress(done, total, name)` is called before each analysis.  What is left out is listed in the findings.
    `model` is the spec's own, where it has been built already.  A solver that gives up makes the outcome "partial".
    """
    started = time.perf_counter()
    mechanism = registry.mechanism(spec.mechanism)
    wanted = selection(mechanism.analyses, only, everything)
    model = mechanism.build(spec) if model is None else model
    answers = ask(spec, model, wanted, progress)
    findings = [*getattr(model, "findings", ()), *(finding for answer in answers.values() for finding in answer.findings)]
    findings += [
        f"analysis '{a.name}' ({a.meaning}) runs on request: --only {a.name}"
        for a in mechanism.analyses
        if not only and not everything and not a.default
    ]
    return _result(spec, mechanism, answers, findings, time.perf_counter() - started)


def ask(spec, model, wanted, progress=None):
    """{name: Answer} of the wanted analyses, one after another; each sees those before it."""
    answers = {}
    for number, analysis in enumerate(wanted):
        if progress:
            progress(number, len(wanted), analysis.name)
        answers[analysis.name] = _answer(analysis, spec, model, answers)
    return answers


def selection(analyses, only=(), everything=False):
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


def _answer(analysis, spec, model, answers):
    """The analysis' answer; an empty one with a finding where its input or its extra is missing, or its solver gives up."""
    unmet = (f"it needs '{name}', which is {answers[name].outcome}" for name in analysis.needs if not _usable(answers[name]))
    reason = analysis.missing(spec) or next(unmet, None)
    if reason is None:
        try:
            return analysis.answer(model, answers)
        except MissingExtra as error:
            reason = str(error)
        except SolverError as error:
            return _given_up(analysis, error)
    return Answer(findings=(f"analysis '{analysis.name}' ({analysis.meaning}) is left out: {reason}",), outcome="left out")


def _usable(answer):
    """Whether an analysis that needs this answer can go on from it."""
    return answer.outcome == "complete" or (answer.outcome == "partial" and answer.data is not None)


def _given_up(analysis, error):
    """What a solver had when it gave up, with a finding that says why."""
    had = error.partial if isinstance(error.partial, Answer) else Answer()
    finding = f"analysis '{analysis.name}' ({analysis.meaning}) gave up: {error}"
    return replace(had, outcome="partial", findings=(*had.findings, finding))


def _result(spec, mechanism, answers, findings, seconds):
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
        checks=tuple(c for a in answers.values() for c in a.checks),
        findings=tuple(findings),
        outcome="partial" if any(a.outcome == "partial" for a in answers.values()) else "complete",
        provenance={
            "seed": spec.optimise.seed if spec.optimise else 0,
            "seconds": round(seconds, 4),
            "analyses": list(answers),
            "versions": versions(),
            "sources": list(mechanism.sources),
        },
    )


def versions():
    """Version of Python and of the libraries that make numbers."""
    return dict(_versions())


@cache
def _versions():
    found = {"python": platform.python_version()}
    for name in ("drivewright", "numpy", "scipy", "numba"):
        try:
            found[name] = version(name)
        except PackageNotFoundError:
            found[name] = "not installed"
    return found
