"""What a study looks at in the answers of a case: values, the ends of their intervals, and margins of checks."""

from typing import NamedTuple

from drivewright.result import ERROR, HIGH, LOW
from drivewright.studies.study import CHECK

TOLD = {LOW: "at least", HIGH: "at most", ERROR: "standard error"}


class Output(NamedTuple):
    """One number [SI unit] of a case; `bounds` names the output whose interval it is an end, or the standard error, of."""

    value: float
    unit: str
    meaning: str
    bounds: str = ""

    @property
    def about(self):
        """(unit, meaning, bounds): what all cases have in common."""
        return self[1:]


def looked_at(values, checks):
    """{name: Output} of all that a study looks at: values, and margins of checks, 0 where rounding alone makes one negative: a check
    passes exactly when its margin is not below 0.  NAME.low and NAME.high are the ends of the 95 % interval of NAME, NAME.error its
    standard error, where it has them; a value that has such a name already keeps it."""
    outputs = [(name, Output(value.value, value.unit, value.meaning), _bounds(value)) for name, value in values.items()]
    outputs += [(f"{CHECK}{check.name}", _margin(check), _ends(check.margin_bounds)) for check in checks]
    stated = {name for name, _, _ in outputs}
    found = {}
    for name, output, bounds in outputs:
        found[name] = output
        found |= {
            f"{name}{end}": Output(number, output.unit, f"{output.meaning}, {TOLD[end]}", name)
            for end, number in bounds.items()
            if f"{name}{end}" not in stated
        }
    return found


def _bounds(value):
    """{end: number} of a value's interval."""
    plain = value.plain()
    ends = _ends(None if plain.low is None or plain.high is None else (plain.low, plain.high))
    return ends | ({ERROR: plain.error} if ends and plain.error is not None else {})


def _ends(bounds):
    return dict(zip((LOW, HIGH), bounds or (), strict=False))


def _margin(check):
    return Output(max(check.margin, 0.0) if check.ok else check.margin, check.unit, f"margin of: {check.message}")
