"""How many digits a number has: those that its 95 % interval supports, `EXACT` where it has none."""

import math
from collections.abc import Iterable

EXACT = 5
NOISE = 1e-12  # of the largest number of the same unit in a design: what is smaller is rounding
ROUGH = 2  # digits of each number where only the power of ten is known


def noise_floors(numbers: Iterable[tuple[float, str]]) -> dict[str, float]:
    """{unit: magnitude below which a number of that unit is rounding} of the numbers [SI] of one design: `NOISE` of the largest of the
    unit; of pure numbers `NOISE` itself."""
    floors: dict[str, float] = {}
    for value, unit in numbers:
        if math.isfinite(value):
            floors[unit] = max(floors.get(unit, 0.0), NOISE * abs(value))
    return floors | {"-": NOISE}


def last_place(value: float, low: float | None, high: float | None, digits: int = EXACT) -> int | None:
    """Power of ten of the last digit to print of a value and its interval: the second significant digit of half the width, but no more
    than `digits` in all.

    None where the interval says nothing: it has no bound, or is narrower than the rounding to `digits`.
    """
    if low is None or high is None or not all(map(math.isfinite, (value, low, high))) or not high > low:
        return None
    half = (high - low) / 2
    exact = math.floor(math.log10(float(f"{max(abs(value), half):.{digits - 1}e}"))) - digits + 1
    if half < 0.5 * 10.0**exact:
        return None
    return max(math.floor(math.log10(float(f"{half:.1e}"))) - 1, exact)


def over_decades(low: float | None, high: float | None) -> bool:
    """Whether an interval of a positive number spans more than a power of ten, as of a life: then one place does not serve its ends."""
    return low is not None and high is not None and 0 < 10 * low < high < math.inf


def plain(value: float, low: float | None = None, high: float | None = None) -> list[str]:
    """Texts of a number and, where it says something, of the ends of its interval, in the digits that this supports.

    In plain letters: "4.1e-04" for what is very small or large.
    """
    place = last_place(value, low, high)
    if place is None or low is None or high is None:
        return [_exact(value)]
    rough = over_decades(low, high)
    return [_powered(each, math.floor(math.log10(each)) - ROUGH + 1 if rough else place) for each in (value, low, high)]


def _exact(value: float) -> str:
    rounded = f"{value + 0.0:.{EXACT}g}"  # + 0.0: never "-0"
    return to_place(value, 1) if 1e5 <= abs(float(rounded)) < 1e6 else rounded


def _powered(value: float, place: int) -> str:
    """Rounded to a power of ten; with one where it is very small or large."""
    if place >= -5 and abs(value) < 1e6:
        return to_place(value, place)
    count = math.floor(math.log10(abs(value))) - place if value else 0
    return f"{value:.{max(count, 0)}e}"


def to_place(value: float, place: int) -> str:
    """A number rounded to a power of ten, as text: (12.345, -1) -> '12.3', (1234.5, 2) -> '1200'; never '-0'."""
    text = f"{value:.{-place}f}" if place < 0 else f"{round(value / 10.0**place) * 10**place:d}"
    return text.removeprefix("-") if not any(digit in text for digit in "123456789") else text
