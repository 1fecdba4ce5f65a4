"""What a study keeps of the answers of a case: values, the ends of their intervals, and margins of checks."""

from collections.abc import Iterable, Mapping
from typing import NamedTuple

from drivewright.labels import label_of
from drivewright.result import ERROR, HIGH, LOW, Check, Value

CHECK = "check."  # in front of the name of a check, as the name of its margin
MARGIN_OF = "margin to the limit (0 or more passes): "  # in front of the message of a check, in the meaning of its margin
INTERVAL_PARTS = {LOW: "at least", HIGH: "at most", ERROR: "standard error"}


class OutputInfo(NamedTuple):
    """What an output has in common in all cases: SI unit, meaning, the output whose interval it is an end, or the standard error, of
    ("" where it is a value of its own), and its label, the first phrase of the meaning unless given."""

    unit: str
    meaning: str
    bounds: str = ""
    label: str = ""

    def metadata(self) -> dict[str, str]:
        """Unit, label and meaning, as in the metadata of a Parquet file."""
        return {"unit": self.unit, "label": label_of(self.meaning, self.label), "meaning": self.meaning}


class Output(NamedTuple):
    """One number [SI unit] of a case; the other fields as of `OutputInfo`."""

    value: float
    unit: str
    meaning: str
    bounds: str = ""
    label: str = ""

    @property
    def about(self) -> OutputInfo:
        """What all cases have in common."""
        return OutputInfo(self.unit, self.meaning, self.bounds, self.label)


def case_outputs(values: Mapping[str, Value], checks: Iterable[Check]) -> dict[str, Output]:
    """{name: Output} of all that a study keeps: values, and margins of checks, 0 where rounding alone makes one negative: a check
    passes exactly when its margin is not below 0.  NAME.low and NAME.high are the ends of the 95 % interval of NAME, NAME.error its
    standard error, where it has them; a value that has such a name already keeps it."""
    outputs = [
        (name, Output(value.value, value.unit, value.meaning, label=label_of(value.meaning, value.label)), _bounds(value))
        for name, value in values.items()
    ]
    outputs += [(f"{CHECK}{check.name}", _margin(check), _ends(check.margin_bounds)) for check in checks]
    stated = {name for name, _, _ in outputs}
    collected: dict[str, Output] = {}
    for name, output, bounds in outputs:
        collected[name] = output
        for end, number in bounds.items():
            if f"{name}{end}" not in stated:
                meaning = f"{output.meaning}, {INTERVAL_PARTS[end]}"
                collected[f"{name}{end}"] = Output(number, output.unit, meaning, name, output.label)
    return collected


def _bounds(value: Value) -> dict[str, float]:
    """{end: number} of a value's interval."""
    if value.low is None or value.high is None:
        return {}
    plain = value.plain()
    ends = _ends(None if plain.low is None or plain.high is None else (plain.low, plain.high))
    return ends | ({ERROR: plain.error} if ends and plain.error is not None else {})


def _ends(bounds: tuple[float, float] | None) -> dict[str, float]:
    return dict(zip((LOW, HIGH), bounds, strict=True)) if bounds else {}


def _margin(check: Check) -> Output:
    return Output(float(check.counted_margin), check.unit, f"{MARGIN_OF}{check.message}", label=f"{check.display_label}, margin")
