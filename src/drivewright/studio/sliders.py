"""Ranges and steps of sliders, in the unit that the box shows, and the short text of a number that a slider gave."""

import math
import re
from collections.abc import Callable, Sequence
from typing import NamedTuple, TypeAlias

Slider: TypeAlias = tuple[list[float], float]  # ([from, to], step)
NICE = (1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0)  # where a range may end, times a power of ten
STEPS = 200  # of a slider, about
WIDE = 20.0  # limits further apart than so many times the value, or a usual one, make no slider
TYPICAL = {
    "mm": 10.0,
    "um": 100.0,
    "deg": 90.0,
    "rad": 1.5,
    "arcmin": 100.0,
    "rpm": 100.0,
    "rad/s": 10.0,
    "N": 100.0,
    "N/mm": 10.0,
    "N/m": 1e6,
    "MPa": 100.0,
    "N m/arcmin": 100.0,
    "N s/m": 100.0,
    "Hz": 10.0,
    "rad/s^2": 100.0,
    "m/s^2": 10.0,
    "kg/m^3": 1000.0,
    "W": 100.0,
}  # a usual value, by unit; 1 of any other
LEAST_COUNTS = 10  # places on a slider of whole numbers
DIGITS = 10  # of a number that a slider gives
SMALLEST, LARGEST = 1e-100, 1e100  # of numbers that have a slider


class Limits(NamedTuple):
    """What is allowed, in the unit of the slider; None where there is no limit, `open` where the limit itself is not allowed."""

    low: float | None = None
    high: float | None = None
    open_low: bool = False
    open_high: bool = False


def slider(
    value: float, limits: Limits = Limits(), *, integer: bool = False, around: float = 1.0, old: Slider | None = None
) -> Slider | None:
    """([from, to], step) of a slider for a value, or None where the limits leave it no room.

    Both limits, where they lie close enough together; else about half to twice the value.  `around` is the size of a usual value, for one
    that is 0.  The `old` answer stays as long as it holds the value and keeps the limits: a slider must not jump while it is dragged.
    """
    if old and old[0][0] <= value <= old[0][1] and _within(old[0], limits):
        return old
    if not (value == 0 or SMALLEST < abs(value) < LARGEST):
        return None
    low, high = _range(value, limits, integer, abs(around) or 1.0)
    step = _step(high - low, integer)
    low, high = _clipped(low, high, step, value, limits)
    return ([low, high], step) if low < high else None


def typical(unit: str, example: float | None = None) -> float:
    """Size of a usual value: that of an example where it is not 0, else by the unit."""
    return abs(example) if example else TYPICAL.get(unit, 1.0)


def tidied(text: str) -> str:
    """A text with its number to ten digits where it has more: a slider that counts in steps says "0.30000000000000004"."""
    match = re.match(r"\s*[+-]?[0-9.]+(?:[eE][+-]?[0-9]+)?", text)
    if not match or sum(map(str.isdigit, match[0])) <= DIGITS:
        return text
    return f"{float(match[0]):.{DIGITS}g}{text[match.end() :]}"


# -- ranges --------------------------------------------------------------------------------------------------------------------


def _range(value: float, limits: Limits, integer: bool, around: float) -> tuple[float, float]:
    """Where a slider begins and ends before it is clipped to the limits."""
    if limits.low is not None and limits.high is not None and limits.high - limits.low <= WIDE * max(abs(value), around):
        return limits.low, limits.high
    if value == 0:
        top = _nice(around, math.ceil)
        return (0.0 if limits.low is not None and limits.low >= 0 else -top), (0.0 if limits.high == 0 else top)
    ends = sorted(math.copysign(_nice(size, way), value) for size, way in ((abs(value) / 2, math.floor), (abs(value) * 2, math.ceil)))
    if integer and ends[1] - ends[0] < LEAST_COUNTS:
        return min(ends[0], value - LEAST_COUNTS // 2), max(ends[1], value + LEAST_COUNTS // 2)
    return ends[0], ends[1]


def _nice(size: float, way: Callable[[float], int]) -> float:
    """The nice number next to a size > 0, below it (`way` math.floor) or above it (math.ceil)."""
    power = 10.0 ** math.floor(math.log10(size))
    if way is math.floor:
        return _short(max((n for n in NICE if n * power <= size * (1 + 1e-9)), default=1.0) * power)
    return _short(min((n for n in NICE if n * power >= size * (1 - 1e-9)), default=10.0) * power)


def _step(width: float, integer: bool) -> float:
    """A two-hundredth of the range or less: 1, 2 or 5 times a power of ten; whole where the values are."""
    if width <= 0:
        return 1
    power = 10.0 ** math.floor(math.log10(width / STEPS))
    step = max((n for n in (1.0, 2.0, 5.0) if n * power <= width / STEPS * (1 + 1e-9)), default=1.0) * power
    return max(1, round(step)) if integer else _short(step)


def _clipped(low: float, high: float, step: float, value: float, limits: Limits) -> tuple[float, float]:
    """The range inside the limits; an open limit is not reached."""
    if limits.low is not None and (low < limits.low or (limits.open_low and low <= limits.low)):
        low = min(value, limits.low + step if limits.open_low else limits.low)
    if limits.high is not None and (high > limits.high or (limits.open_high and high >= limits.high)):
        high = max(value, limits.high - step if limits.open_high else limits.high)
    return _tidy(low), _tidy(high)


def _within(ends: Sequence[float], limits: Limits) -> bool:
    return (limits.low is None or ends[0] >= limits.low) and (limits.high is None or ends[1] <= limits.high)


def _tidy(number: float) -> float:
    """To twelve digits, whole where it is."""
    number = _short(number)
    return int(number) if number == int(number) and abs(number) < 1e15 else number


def _short(number: float) -> float:
    return float(f"{number:.12g}")
