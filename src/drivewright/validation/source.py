"""A published source: its numbers beside ours, each with a verdict that is computed."""

import math
import re
from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any, NamedTuple

from drivewright import units
from drivewright.errors import InputError

KINDS = ("closed form", "other code", "published table", "experiment")
COMPUTED, CALIBRATED, PRINT_ONLY = "computed", "calibrated", "print-only"
BASES = (COMPUTED, CALIBRATED, PRINT_ONLY)
PRINTED, EVALUATED, IMPLIED = "printed", "evaluated", "implied"
AGREES, EXPLAINED, OPEN, NOT_COMPARED = "agrees", "differs, explained", "differs, open", "not compared"
VERDICTS = (AGREES, EXPLAINED, OPEN, NOT_COMPARED)
BELOW_ONE, ABOVE_ONE = (-math.inf, math.nextafter(1.0, 0.0)), (math.nextafter(1.0, 2.0), math.inf)  # ends of a ratio that is claimed so
NUMBER = r"[+-]?\d+\.?(\d*)(?:e([+-]?\d+))?"


class Printed(NamedTuple):
    """What a source prints, and the SI interval that the print means.

    `number` [SI] is the printed number, None for a range or a claim, and `unit` the unit that it is printed in.  `origin` is "printed";
    "evaluated" where the source prints a formula, not this value of it; "implied" where its text only lets one expect it.
    """

    text: str
    low: float
    high: float
    number: float | None = None
    origin: str = PRINTED
    unit: str = ""

    def __str__(self) -> str:
        return self.text


def rounded(text: str, unit: str) -> Printed:
    """A printed number "50.22 deg" or "4.560e11 min": all that rounds to its digits.

    `unit` is the SI unit of its dimension, "-" for a pure number.
    """
    match = re.match(NUMBER, text)
    if match is None:
        raise InputError(f'the printed value {text!r} does not begin with a number; write e.g. "50.22 deg"')
    digits, decimals, power = match.group(0, 1, 2)
    printed = text[len(digits) :].strip()
    factor = 1.0 if unit == "-" else units.BY_UNIT[unit].factor(printed)
    half, number = 0.5 * 10.0 ** (int(power or 0) - len(decimals)) * factor, float(digits) * factor
    return Printed(text, number - half, number + half, number, unit=printed)


def about(text: str, number: float, half: float) -> Printed:
    """A number [SI] that a source prints as "about" so much, or that a figure shows: within `half` of it."""
    return Printed(text, number - half, number + half, number)


def evaluated(text: str, unit: str) -> Printed:
    """What a printed formula gives for the source's inputs, "1234.5 N": no printed number, and counted apart from those."""
    return rounded(text, unit)._replace(text=f"{text}, evaluated", origin=EVALUATED)


def implied(text: str, low: float, high: float) -> Printed:
    """What the text of a source lets one expect without saying it: counted apart from what it prints."""
    return Printed(f"{text}, implied", low, high, origin=IMPLIED)


class Explanation(NamedTuple):
    """Why a number differs: our number [SI] under the other reading that the text names.

    A reading that does not meet the print explains nothing.
    """

    text: str
    value: float


@dataclass(frozen=True)
class Row:
    """One printed number beside ours [SI].

    `where` is the place in the source; `inputs` are as printed, `assumed` what the source leaves out; `note` is a remark that
    does not account for a difference.  `pinned` is the verdict that the repository states.

    `basis` says what ours is: "computed" from the source's inputs; "calibrated", with an input chosen so that it meets the print;
    "print-only", made of other printed numbers alone, or None where we have nothing to put beside the print.  Only a computed number is
    compared.  `low` and `high` are the ends of its 95 % interval; None: it is exact to its printed digits.

    `reading_of` names the printed number where several rows are readings of the same one.  `idealised`: ours leaves out something that
    the printed number is about (rigid plates for elastic ones, rest for motion); then it may explain a print, and never agrees with it.
    """

    name: str
    printed: Printed
    ours: float | None
    unit: str
    pinned: str
    kind: str
    where: str
    inputs: str = ""
    assumed: str = ""
    explanation: Explanation | None = None
    note: str = ""
    basis: str = COMPUTED
    low: float | None = None
    high: float | None = None
    reading_of: str = ""
    idealised: bool = False

    @property
    def deviation(self) -> float | None:
        """Ours minus the printed number; where a range or a limit is printed, how far beyond it ours is; None without ours."""
        if self.ours is None:
            return None
        if self.printed.number is not None:
            return self.ours - self.printed.number
        return min(self.ours - self.printed.low, 0.0) + max(self.ours - self.printed.high, 0.0)

    @property
    def shown_unit(self) -> tuple[float, str]:
        """(factor, unit) that turn an SI number of the row into the one to show: in the unit of the print, else in the one people read."""
        return units.display(self.unit, self.printed.unit)

    def deviation_text(self) -> str:
        """The deviation in the unit of the print; rounding noise as 0; nothing where nothing is compared."""
        if self.deviation is None or self.ours is None or self.basis != COMPUTED:
            return ""
        factor, shown = self.shown_unit
        deviation = self.deviation if abs(self.deviation) > 1e-13 * abs(self.ours) else 0.0
        return f"{deviation * factor:+.3g}{'' if shown == '-' else ' ' + shown}"

    @property
    def verdict(self) -> str:
        """Ours, or its interval, within what the print means, or explained, or open; a number that is not computed is not compared."""
        if self.basis != COMPUTED or self.ours is None:
            return NOT_COMPARED
        if self._meets(self.ours, self.low, self.high):
            return EXPLAINED if self.idealised else AGREES
        return EXPLAINED if self.explanation is not None and self._meets(self.explanation.value) else OPEN

    @property
    def commentary(self) -> str:
        """Basis where it is not computed, explanation and remark."""
        text = self.explanation.text if self.explanation else ""
        return " ".join(part for part in (BASIS_TEXT.get(self.basis, ""), text, self.note) if part)

    def record(self, source: str) -> dict[str, Any]:
        """Plain dictionary as in rows.json, numbers in SI; a number without interval has itself for both ends."""
        low, high = (self.ours if end is None else end for end in (self.low, self.high))
        return {
            "source": source,
            "where": self.where,
            "quantity": self.name,
            "printed": self.printed.text,
            "ours": self.ours,
            "low": low,
            "high": high,
            "unit": self.unit,
            "basis": self.basis,
            "verdict": self.verdict,
        }

    def _meets(self, value: float, low: float | None = None, high: float | None = None) -> bool:
        """Whether the value is within what the print means, or a printed number within the value's interval; of a printed limit the
        whole interval must keep it."""
        within = self.printed.low <= value <= self.printed.high
        if low is None or high is None:
            return within
        if self.printed.high < float("inf") and self.printed.low > -float("inf"):
            return within or (low <= self.printed.low and self.printed.high <= high)
        return self.printed.low <= low and high <= self.printed.high


def best_verdicts(rows: Iterable[Row]) -> dict[str, str]:
    """{printed number: the best verdict among its readings}, in the order of `VERDICTS`."""
    best: dict[str, str] = {}
    for row in rows:
        name = row.reading_of or row.name
        best[name] = min(best.get(name, NOT_COMPARED), row.verdict, key=VERDICTS.index)
    return best


def counts(rows: Iterable[Row], origin: str = PRINTED) -> dict[str, int]:
    """How many printed numbers and claims (or what is evaluated or implied) have each verdict, the best of their readings."""
    best = Counter(best_verdicts(row for row in rows if row.printed.origin == origin).values())
    return {verdict: best[verdict] for verdict in VERDICTS}


BASIS_TEXT = {CALIBRATED: "By calibration: no evidence.", PRINT_ONLY: "From the print alone: no evidence."}


@dataclass(frozen=True)
class Source:
    """A work and the function that computes its rows; `errata` are faults of the work found on the way."""

    name: str
    citation: str
    row_function: Callable[[], Iterable[Row]]
    errata: tuple[str, ...] = ()

    def rows(self) -> tuple[Row, ...]:
        """Tuple of `Row`, computed now."""
        return tuple(self.row_function())
