"""Energy audit of a time history: the work of all elements against the change of energy."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from drivewright._typing import Floats
from drivewright.multibody.observe import POWER_FIELDS
from drivewright.multibody.record import Record
from drivewright.numerics.quadrature import cumulative_simpson, trapezoid
from drivewright.result import Answer, Check, Column, Table, Value

IDLE = 1e-3  # part of the energy exchanged that drives do at least, for the power audit
DRIVES = POWER_FIELDS.index("drives")


@dataclass(frozen=True)
class Audit:
    """Work [J] of each kind of element from the start, over t (m,) [s]: works (m, kinds); gap (m,) between all work and the change of
    energy; exchanged: all power, either way, over time, and all that the kinetic energy rises and falls; driven: the same of the power of
    the drives alone."""

    t: Floats
    works: Floats
    gap: Floats
    exchanged: float
    driven: float

    @property
    def error(self) -> float:
        """Largest gap over the energy exchanged."""
        return float(np.max(np.abs(self.gap)) / self.exchanged) if self.exchanged > 0 else 0.0

    @property
    def power_error(self) -> float:
        """Largest difference between the work of the drives and the change of energy and losses, over the work that the drives do, give
        and take; drives that do next to nothing count as a thousandth of what is exchanged."""
        whole = max(self.driven, IDLE * self.exchanged)
        return float(np.max(np.abs(self.gap)) / whole) if whole > 0 else 0.0


def audit(record: Record) -> Audit:
    """The `Audit` of a record taken with two points per step: Simpson's rule over each step."""
    t, power = record.t[::2], record.powers
    steps = np.diff(t)[:, None]
    begin, middle, end = power[:-2:2], power[1:-1:2], power[2::2]
    works = np.concatenate([np.zeros((1, power.shape[1])), np.cumsum(steps / 6 * (begin + 4 * middle + end), axis=0)])
    flow = np.sum(steps / 6 * (np.abs(begin) + 4 * np.abs(middle) + np.abs(end)), axis=0)
    return _audit(t, works, flow, record.energy[::2], record.kinetic[::2], DRIVES)


def audit_of_samples(record: Record) -> Audit:
    """The `Audit` of a record at any times, Simpson's rule over neighbouring samples: kinematics has no steps of its own."""
    works = cumulative_simpson(record.powers, record.t)
    flow = trapezoid(np.abs(record.powers), record.t)
    return _audit(record.t, works, flow, record.energy, record.kinetic, DRIVES)


def audit_of_powers(t: Floats, powers: Floats, energy: Floats, kinetic: Floats, drives: int) -> Audit:
    """The `Audit` of any time history: powers (m, kinds) [W] that elements give, energy (m,) stored [J], kinetic energy (m,) alone [J].

    drives: the column of the drive's power.  Where a time stands twice the powers may jump.
    """
    ends = [0, *(np.flatnonzero(np.diff(t) <= 0) + 1), len(t)]
    works, flow = np.zeros_like(powers), np.zeros(powers.shape[1])
    for first, end in zip(ends[:-1], ends[1:], strict=True):
        piece = slice(first, end)
        works[piece] = works[first - 1] if first else 0.0
        if end - first > 1:
            works[piece] += cumulative_simpson(powers[piece], t[piece])
            flow += trapezoid(np.abs(powers[piece]), t[piece])
    return _audit(t, works, flow, energy, kinetic, drives)


def _audit(t, works, flow, energy, kinetic, drives):
    exchanged = float(np.sum(flow) + np.sum(np.abs(np.diff(kinetic))))
    return Audit(t, works, energy - energy[0] - np.sum(works, axis=1), exchanged, float(flow[drives]))


def audit_table(audit: Audit, meanings: Mapping[str, str], most: int) -> Table:
    """Stored energy, works and gap over time, in about so many rows; meanings {kind: what it is}, in the order of the works."""
    rows = slice(None, None, max(1, len(audit.t) // most))
    columns = (
        Column("time", "s", "time", audit.t[rows]),
        Column("stored", "J", "kinetic and gravitational energy, change since the start", (audit.gap + np.sum(audit.works, axis=1))[rows]),
        *(
            Column(f"work_{name}", "J", f"work of {words}", audit.works[rows, k], f"work of {words}")
            for k, (name, words) in enumerate(meanings.items())
        ),
        Column("gap", "J", "change of energy minus the work of all elements", audit.gap[rows], "energy audit error"),
    )
    return Table("energy", "Energy audit", columns)


def audit_answer(audit: Audit, meanings: Mapping[str, str], limit: float, most: int) -> Answer:
    """Works over the whole history, gap and error with its check, and the table of about so many rows."""
    values = {
        f"energy.{name}": Value(float(audit.works[-1, k]), "J", f"work of {words}") for k, (name, words) in enumerate(meanings.items())
    }
    values |= error_values(float(np.max(np.abs(audit.gap))), audit.error)
    return Answer(values, (audit_table(audit, meanings, most),), (error_check(audit.error, limit),))


def error_values(gap: float, error: float) -> dict[str, Value]:
    """The error of an audit [J], and relative to the energy exchanged, as values."""
    meaning = "maximum difference between the change of energy and the work of all elements"
    return {
        "energy.gap": Value(gap, "J", meaning, label="energy audit error"),
        "energy.error": Value(error, "-", f"{meaning}, relative to the energy exchanged", label="energy audit error, relative"),
    }


def error_check(error: float, limit: float, remedy: str = "") -> Check:
    """The check of an audit: its error relative to the energy exchanged."""
    label, words = "energy audit error, relative", "change of energy against the work of all elements, relative to the energy exchanged"
    return Check("energy_audit", error, limit, "<=", "-", words + remedy, label=label)
