"""A published source: the world's numbers beside ours, each with a verdict that is computed."""

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import NamedTuple

from drivewright import units
from drivewright.errors import InputError

KINDS = ("closed form", "other code", "published table", "experiment")
AGREES, EXPLAINED, OPEN = "agrees", "differs, explained", "differs, open"


class Printed(NamedTuple):
    """What a source prints, and the SI interval that the print means."""

    text: str
    low: float
    high: float

    def __str__(self) -> str:
        return self.text


def rounded(text: str, unit: str) -> Printed:
    """A printed number "50.22 deg": all that rounds to its digits.  `unit` is the SI unit of its dimension, "-" for a pure number."""
    match = re.match(r"[+-]?\d+\.?(\d*)", text)
    if match is None:
        raise InputError(f'the printed value {text!r} does not begin with a number; write e.g. "50.22 deg"')
    number, digits = match.group(0, 1)
    factor = 1.0 if unit == "-" else units.BY_UNIT[unit].factor(text[len(number) :].strip())
    half = 0.5 * 10.0 ** -len(digits) * factor
    return Printed(text, float(number) * factor - half, float(number) * factor + half)


class Explanation(NamedTuple):
    """Why a number differs.

    `value` is our number [SI] under the other reading that the text names; one that does not meet the print explains nothing.
    None where the text shows the print itself to be wrong.
    """

    text: str
    value: float | None = None


@dataclass(frozen=True)
class Row:
    """One printed number beside ours [SI].

    `where` is the place in the source; `inputs` are as printed, `assumed` what the source leaves out; `note` is a remark that
    does not account for a difference.  `pinned` is the verdict that the repository states.
    """

    name: str
    printed: Printed
    ours: float
    unit: str
    pinned: str
    kind: str
    where: str
    inputs: str = ""
    assumed: str = ""
    explanation: Explanation | None = None
    note: str = ""

    @property
    def deviation(self) -> float:
        """Ours minus the printed number; where a limit is printed, how far beyond it ours is."""
        low, high = self.printed.low, self.printed.high
        if high < float("inf") and low > -float("inf"):
            return self.ours - 0.5 * (low + high)
        return min(self.ours - low, 0.0) + max(self.ours - high, 0.0)

    def deviation_text(self) -> str:
        """The deviation in the unit people read; rounding noise as 0."""
        factor, shown = units.display(self.unit)
        deviation = self.deviation if abs(self.deviation) > 1e-13 * abs(self.ours) else 0.0
        return f"{deviation * factor:+.3g}{'' if shown == '-' else ' ' + shown}"

    @property
    def verdict(self) -> str:
        """Ours within what the print means, or explained, or open."""
        if self._meets(self.ours):
            return AGREES
        explained = self.explanation is not None and (self.explanation.value is None or self._meets(self.explanation.value))
        return EXPLAINED if explained else OPEN

    @property
    def commentary(self) -> str:
        """Explanation and remark."""
        return " ".join(text for text in (self.explanation.text if self.explanation else "", self.note) if text)

    def _meets(self, value: float) -> bool:
        return self.printed.low <= value <= self.printed.high


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
