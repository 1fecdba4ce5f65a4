"""Advice: what to change in a design so that a check which fails passes; found and verified by `studies.advising`."""

from typing import Any, NamedTuple


class Change(NamedTuple):
    """One key of a spec [SI unit]: its value now and the one advised; `given` is the new value as it is written into the file."""

    key: str
    unit: str
    before: float
    after: float
    given: str

    def record(self) -> dict[str, Any]:
        """Plain dictionary as in result.json."""
        return {"key": self.key, "unit": self.unit, "before": self.before, "after": self.after, "given": self.given}


class Advice(NamedTuple):
    """A change of one or two keys with which the check passes.

    `value` is that of the check in a run of the changed design.  `also_passes` and `then_fails` name the other checks whose verdict turns.
    """

    check: str
    changes: tuple[Change, ...]
    value: float
    also_passes: tuple[str, ...] = ()
    then_fails: tuple[str, ...] = ()

    def record(self) -> dict[str, Any]:
        """Plain dictionary as in result.json."""
        return {
            "check": self.check,
            "changes": [change.record() for change in self.changes],
            "value": self.value,
            "also_passes": list(self.also_passes),
            "then_fails": list(self.then_fails),
        }
