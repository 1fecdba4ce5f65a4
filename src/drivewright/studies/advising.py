"""What to change in a design so that a check which fails passes: the smallest change of one or two dimensions, verified by a run.

The sensitivities of the margins to each dimension say which to change and about how far; a search along the line
finds where the margin is 0, the number is rounded to the side that passes, and a run of that design has the last word.
"""

import math
import time
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from drivewright import registry
from drivewright._typing import Floats
from drivewright.advice import Advice, Change
from drivewright.execution.evaluation import PreparedTask, case_task
from drivewright.execution.outputs import CHECK
from drivewright.result import Check, Result, SpecT
from drivewright.spec import MechanismSpec
from drivewright.spec.study_table import Study
from drivewright.steps import Progress
from drivewright.studies.adjustable import dimensions
from drivewright.units import scale

NEAR = 0.02  # of the change: how well the point where the margin is 0 is known before it is rounded
ROUNDED = 0.2  # of the change, that rounding to few digits may add
TRIED = 4  # dimensions whose lines are searched for one check
STEPS = 12  # of the search along a line
SLOW = 2  # steps of the secant that do not halve what is searched, after which the middle is taken
PATIENCE = 3.0  # seconds that a run spends on advice
HOPEFUL = 4.0  # times the whole range that the slopes may say is needed: most margins are no straight lines
TINY = 1e-9  # of the limit: no change of a margin


class OutOfTime(Exception):
    """The time for advice is over."""


def advise(
    result: Result[SpecT],
    seconds: float | None = PATIENCE,
    progress: Progress | None = None,
    checks: Collection[str] = (),
    held: Collection[str] = (),
    tried: Callable[[int], object] | None = None,
) -> Result[SpecT]:
    """The result with advice on its failed checks, as far as some is found in so many seconds (None: however long it takes).

    `checks` names those that are looked at, all unless given; `held` the keys that must not change.
    `progress(done, total, name)` is called with the failed checks that are done, `tried(number)` before each design that is computed.
    A chaotic check, whose value has an interval, gets none: a step of a key would be compared with its noise.
    """
    failed = [check for check in result.checks if is_advisable(check) and (not checks or check.name in checks)]
    found: list[Advice] = []
    stopped = False
    if failed and result.outcome == "complete":
        try:
            designs = Designs(result, math.inf if seconds is None else time.monotonic() + seconds, held, tried)
            for group in designs.by_analysis(failed):
                slopes = _slopes(designs, group)
                for check in group:
                    if progress:
                        progress(len(found), len(failed), "what to change")
                    found += _advice(designs, check, slopes[check.name])
        except OutOfTime:
            stopped = True
    return replace(result, advice=tuple(found), advice_stopped=stopped)


def is_advisable(check: Check) -> bool:
    """Whether there may be advice on a check: it fails, by a margin that is a number without an interval."""
    return not check.ok and check.bounds is None and math.isfinite(check.margin)


# -- designs -------------------------------------------------------------------------------------------------------------------


class Designs:
    """Margins of the checks, and other numbers, of a design in which some dimensions have moved."""

    def __init__(
        self, result: Result[Any], deadline: float, held: Collection[str] = (), tried: Callable[[int], object] | None = None
    ) -> None:
        self.spec: MechanismSpec = result.spec
        self.checks: Mapping[str, Check] = {check.name: check for check in result.checks}
        self.dimensions, self.deadline = tuple(each for each in dimensions(self.spec) if each.key not in held), deadline
        self._tried, self._count = tried, 0
        self.keys = tuple(each.key for each in self.dimensions)
        self.nominal = np.array([each.value for each in self.dimensions])
        self.analyses = tuple(result.provenance["analyses"])
        self.owner, self._seconds = result.check_sources, result.timings
        self._evaluations: dict[tuple[str, ...], Callable[[Floats], Mapping[str, float]]] = {}
        self._run_all = self.by_runs(self.analyses)

    def by_analysis(self, failed: Sequence[Check]) -> list[list[Check]]:
        """Those of one analysis together, those of quick analyses first."""
        groups: dict[str, list[Check]] = {}
        for check in failed:
            groups.setdefault(self.owner[check.name], []).append(check)
        return [groups[name] for name in sorted(groups, key=lambda name: self._seconds[name])]

    def moved(self, moves: Mapping[int, float]) -> Floats:
        """The dimensions (d,) after moves {number: move}."""
        design = self.nominal.copy()
        for number, move in moves.items():
            design[number] = self.dimensions[number].at(move)
        return design

    def margins(self, design: Floats, checks: Iterable[Check]) -> dict[str, float]:
        """{check: margin} of a design (d,), nan where it has none; by the analyses that give these checks alone, or by the compiled route
        of the kind where that has them."""
        names = tuple(check.name for check in checks)
        self.begin_design()
        if names not in self._evaluations:
            self._evaluations[names] = self._compiled(names) or self.by_runs(tuple(dict.fromkeys(self.owner[name] for name in names)))
        found = self._evaluations[names](design)
        return {name: found.get(f"{CHECK}{name}", math.nan) for name in names}

    def run(self, design: Floats) -> dict[str, float]:
        """{check: margin} of all checks by a run."""
        self.begin_design()
        found = self._run_all(design)
        return {name: found.get(f"{CHECK}{name}", math.nan) for name in self.checks}

    def _compiled(self, names: Sequence[str]) -> Callable[[Floats], Mapping[str, float]] | None:
        offer = registry.mechanism(self.spec.mechanism).batch
        batch = offer(self.spec, self.keys, tuple(f"{CHECK}{name}" for name in names)) if offer else None
        return (lambda design: {name: float(column[0]) for name, column in batch(design[None]).items()}) if batch else None

    def by_runs(self, analyses: tuple[str, ...]) -> Callable[[Floats], Mapping[str, float]]:
        """What gives {name: number} of a design (d,) by a run of some analyses; empty where that does not end."""
        asking = self.spec.model_copy(update={"study": Study(analyses=analyses), "optimise": None})
        task = PreparedTask(case_task(asking, self.keys))

        def evaluate(design: Floats) -> Mapping[str, float]:
            case = task.case({key: np.array([value]) for key, value in zip(self.keys, design, strict=True)}, 0)
            return {name: output.value for name, output in case.values.items()} if case.status == "complete" else {}

        return evaluate

    def begin_design(self) -> None:
        """Another design is to be computed: OutOfTime where the time is over."""
        if time.monotonic() > self.deadline:
            raise OutOfTime
        self._count += 1
        if self._tried:
            self._tried(self._count)


def _slopes(designs: Designs, checks: Sequence[Check]) -> dict[str, Floats]:
    """{check: d margin / d move (d,)} by one step of each dimension, 0 where it does nothing or has no number."""
    base = designs.margins(designs.nominal, checks)
    slopes = {check.name: np.zeros(len(designs.dimensions)) for check in checks}
    for number, dimension in enumerate(designs.dimensions):
        stepped = designs.margins(designs.moved({number: dimension.step}), checks)
        for check in checks:
            change = stepped[check.name] - base[check.name]
            if math.isfinite(change) and abs(change) > TINY * max(abs(check.limit), abs(check.margin)):
                slopes[check.name][number] = change / dimension.step
    return slopes


# -- along a line --------------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class _Line:
    """Directions {number of a dimension: part of the move} and how far the slopes say that the check is from passing."""

    parts: Mapping[int, float]
    predicted: float

    def moves(self, length: float) -> dict[int, float]:
        """Moves of the dimensions at a length along the line."""
        return {number: part * length for number, part in self.parts.items()}


def _lines(check: Check, slopes: Floats) -> list[_Line]:
    """The line of each dimension, the shortest way first, and the steepest one of the two that do most."""
    order = [int(number) for number in np.argsort(-np.abs(slopes), kind="stable") if slopes[number] != 0]
    directions = [{number: math.copysign(1.0, slopes[number])} for number in order[:TRIED]]
    if len(order) > 1:
        largest = abs(slopes[order[0]])
        directions.append({number: float(slopes[number] / largest) for number in order[:2]})
    lines = [_Line(parts, -check.margin / sum(part * slopes[number] for number, part in parts.items())) for parts in directions]
    return [line for line in lines if line.predicted < HOPEFUL]


def _advice(designs: Designs, check: Check, slopes: Floats) -> list[Advice]:
    """The best advice on a check, in a list; none where no change of up to two dimensions is found."""
    found: list[Advice] = []
    for line in _lines(check, slopes):
        length = _passing_length(designs, check, line)
        advice = _rounded(designs, check, line, length) if length else None
        if advice:
            found.append(advice)
            if len(advice.changes) == 1 and not advice.then_fails:
                break
    return sorted(found, key=lambda advice: (len(advice.then_fails), len(advice.changes)))[:1]


def _passing_length(designs: Designs, check: Check, line: _Line) -> float | None:
    """The shortest length along a line, to `NEAR`, at which the check passes; None where it is not reached."""
    near, far = (0.0, check.margin), None
    length, wide, slow = min(1.1 * line.predicted, 1.0), math.inf, 0
    for _ in range(STEPS):
        margin = designs.margins(designs.moved(line.moves(length)), (check,))[check.name]
        if margin >= 0:
            far = (length, margin)
        elif not math.isfinite(margin) or (far is None and (length >= 1.0 or margin < near[1])):
            return far[0] if far else None
        else:
            near = (length, margin)
        if far and far[0] - near[0] <= NEAR * far[0]:
            break
        if far:
            before, wide = wide, far[0] - near[0]
            slow = 0 if wide <= 0.5 * before else slow + 1
            length = _between(near, far) if slow < SLOW else near[0] + 0.5 * wide
        else:
            length = min(_beyond(length, margin, check.margin), 1.0)
    return far[0] if far else None


def _between(near: tuple[float, float], far: tuple[float, float]) -> float:
    """By the secant, kept within the inner nine tenths so that both ends move.  Where that does not halve what is between them, the
    middle comes next: a margin that grows with a high power of the dimension lets the secant creep from one end."""
    share = near[1] / (near[1] - far[1])
    return near[0] + min(max(share * 1.005, 0.05), 0.95) * (far[0] - near[0])


def _beyond(length: float, margin: float, at_start: float) -> float:
    """By the secant from the start, a little farther; twice as far at most."""
    return length * min(1.1 * at_start / (at_start - margin) if margin > at_start else 2.0, 2.0)


# -- the numbers advised -------------------------------------------------------------------------------------------------------


def _rounded(designs: Designs, check: Check, line: _Line, length: float) -> Advice | None:
    """Advice with the fewest digits that pass in a run; None where none do."""
    exact = designs.moved(line.moves(length))
    for digits in range(1, 6):
        for rounding in (round, _away):
            texts = {number: written(designs, number, exact[number], digits, rounding) for number in line.parts}
            design = exact.copy()
            for number, text in texts.items():
                design[number] = designs.dimensions[number].read(text)
            off = np.abs(design - exact) > ROUNDED * np.abs(exact - designs.nominal)
            if np.any(off) or not designs.margins(design, (check,))[check.name] >= 0:
                continue
            margins = designs.run(design)
            if margins[check.name] >= 0:
                return _made(designs, check, texts, margins)
    return None


def written(designs: Designs, number: int, value: float, digits: int, rounding: Callable[[float], float]) -> str:
    """A value [SI] of a dimension as a person writes it, with few digits; `rounding` counts away from what it is now."""
    dimension = designs.dimensions[number]
    shown = scale(dimension.kind.unit, system=designs.spec.units)
    size, before = shown.of(value), shown.of(dimension.value)
    places = digits - 1 - math.floor(math.log10(abs(size))) if size else 0
    outwards = 1.0 if size > before else -1.0
    rounded = outwards * rounding(round(outwards * size * 10.0**places, 6)) / 10.0**places
    return f"{rounded:.{max(places, 0)}f} {shown.unit if dimension.kind.dimension else ''}".strip()


def _away(number: float) -> float:
    """The next whole number above."""
    return math.ceil(number)


def _made(designs: Designs, check: Check, texts: Mapping[int, str], margins: Mapping[str, float]) -> Advice:
    """`Advice` of the dimensions written so, whose run has these margins."""
    changed = ((designs.dimensions[number], text) for number, text in texts.items())
    others = [other for other in designs.checks.values() if other.name != check.name]
    margin = margins[check.name]
    return Advice(
        check.name,
        tuple(Change(each.key, each.kind.unit, each.value, each.read(text), text) for each, text in changed),
        check.limit - margin if check.sense == "<=" else check.limit + margin,
        tuple(other.name for other in others if not other.ok and margins[other.name] >= 0),
        tuple(other.name for other in others if other.ok and not margins[other.name] >= 0),
    )
