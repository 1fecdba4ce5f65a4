"""What to change in a design so that a value becomes the number that is wanted: one dimension, found by its root and verified by a run.

Each dimension that moves the value is tried by itself, the one that needs the smallest move first.
"""

import math
import time
from collections.abc import Callable, Collection
from typing import Any, NamedTuple

from scipy.optimize import brentq

from drivewright.advice import Change
from drivewright.errors import UnknownName
from drivewright.result import Result
from drivewright.studies.advising import Designs, OutOfTime, written

ACCURATE = 1e-6  # of the number that is wanted: how well the root is known before the dimension is rounded
CLOSE = 1e-4  # of it: how far the value of the rounded dimension may be off
TRIED = 8  # dimensions that are tried
ENOUGH = 4  # ways that are offered
STEPS, REFINED = 14, 40  # designs computed to enclose the root of a dimension, and to find it
DIGITS = 9  # of a dimension, at most
TINY = 1e-12  # of the value: no change


class Way(NamedTuple):
    """A change of one dimension, and the value in a run of the design changed so; names of checks whose verdict turns."""

    change: Change
    value: float
    also_passes: tuple[str, ...] = ()
    then_fails: tuple[str, ...] = ()


class Nearest(NamedTuple):
    """The value nearest to the one wanted that was seen, and the dimension that gave it."""

    value: float
    key: str
    unit: str
    at: float


class Reached(NamedTuple):
    """The ways to a wanted number, those first that make no check fail; `nearest` where there are none; whether the time was over."""

    ways: tuple[Way, ...]
    nearest: Nearest | None = None
    stopped: bool = False


def reach(
    result: Result[Any], name: str, target: float, seconds: float, held: Collection[str] = (), tried: Callable[[int], object] | None = None
) -> Reached:
    """The changes of one dimension each with which the value `name` of a result is `target` [SI].

    `held` names keys that must not change; `tried(number)` is called before each design that is computed.
    """
    if name not in result.values:
        raise UnknownName("value", name, result.values)
    seeker = _Seeker(Designs(result, time.monotonic() + seconds, held, tried), result, name, target)
    ways: list[Way] = []
    stopped = False
    try:
        for number, sign in seeker.order():
            way = seeker.way(number, sign)
            ways += [way] if way else []
            if len(ways) == ENOUGH:
                break
    except OutOfTime:
        stopped = True
    ways.sort(key=lambda way: (len(way.then_fails), _part(way.change)))
    return Reached(tuple(ways), None if ways else seeker.nearest, stopped)


def _part(change: Change) -> float:
    """How far a dimension moves as a part of itself."""
    return abs(change.after - change.before) / abs(change.before) if change.before else math.inf


class _Seeker:
    """How far one value is from its target, by dimension and move."""

    def __init__(self, designs: Designs, result: Result[Any], name: str, target: float) -> None:
        self.designs, self.name, self.target, self.result = designs, name, target, result
        self._evaluate = designs.by_runs((result.value_sources[name],))
        self.now = float(result.values[name].value) - target
        self.size = max(abs(target), abs(self.now))
        self.nearest: Nearest | None = None

    def off(self, number: int, value: float) -> float:
        """Value less target with a dimension at a value [SI]; nan where the design has no such number."""
        self.designs.begin_design()
        design = self.designs.nominal.copy()
        design[number] = value
        off = self._evaluate(design).get(self.name, math.nan) - self.target
        if math.isfinite(off) and (self.nearest is None or abs(off) < abs(self.nearest.value - self.target)):
            dimension = self.designs.dimensions[number]
            self.nearest = Nearest(off + self.target, dimension.key, dimension.kind.unit, value)
        return off

    def order(self) -> list[tuple[int, float]]:
        """(number of a dimension, direction) of those that move the value, the smallest move by its slope first."""
        found = []
        for number, dimension in enumerate(self.designs.dimensions):
            change = self.off(number, dimension.at(dimension.step)) - self.now
            if math.isfinite(change) and abs(change) > TINY * self.size:
                move = -self.now * dimension.step / change
                found.append((abs(move), number, math.copysign(1.0, move)))
        return [(number, sign) for _, number, sign in sorted(found)[:TRIED]]

    def way(self, number: int, sign: float) -> Way | None:
        """The way of one dimension; None where the value does not come to its target within the range."""
        dimension = self.designs.dimensions[number]
        ends = self._enclosed(lambda move: self.off(number, dimension.at(sign * move)))
        if ends is None:
            return None
        exact = self._root(number, *(dimension.at(sign * move) for move in ends))
        return None if exact is None else self._rounded(number, exact)

    def _enclosed(self, off: Callable[[float], float]) -> tuple[float, float] | None:
        """Two moves between which the value passes its target; None where there are none up to the end of the range."""
        near, far, barrier = 0.0, 0.125, math.inf
        for _ in range(STEPS):
            value = off(far)
            if not math.isfinite(value):  # no such design: the range ends before that
                barrier = far
            elif value * self.now <= 0:
                return near, far
            else:
                near = far
            if near >= 1.0 or barrier - near < 1e-3:
                return None
            far = min(2.0 * far, 1.0) if barrier == math.inf else 0.5 * (near + barrier)
        return None

    def _root(self, number: int, one: float, other: float) -> float | None:
        """The value of a dimension at which the target is met."""

        def off(value: float) -> float:
            found = self.off(number, value)
            if not math.isfinite(found):
                raise ArithmeticError
            return 0.0 if abs(found) <= ACCURATE * self.size else found

        try:
            return float(brentq(off, one, other, maxiter=REFINED, xtol=1e-12 * abs(other - one)))
        except (ArithmeticError, RuntimeError, ValueError):  # a gap between them, or a jump
            return None

    def _rounded(self, number: int, exact: float) -> Way | None:
        """The dimension with the fewest digits that are close enough, by a run of all analyses."""
        designs, dimension = self.designs, self.designs.dimensions[number]
        for digits in range(2, DIGITS):
            text = written(designs, number, exact, digits, round)
            value = dimension.read(text)
            off = self.off(number, value)
            if not abs(off) <= CLOSE * self.size:
                continue
            design = designs.nominal.copy()
            design[number] = value
            margins = designs.run(design)
            if not all(map(math.isfinite, margins.values())):
                return None
            turned = [check for check in designs.checks.values() if check.ok != (margins[check.name] >= 0)]
            return Way(
                Change(dimension.key, dimension.kind.unit, dimension.value, value, text),
                self.target + off,
                tuple(check.name for check in turned if not check.ok),
                tuple(check.name for check in turned if check.ok),
            )
        return None
