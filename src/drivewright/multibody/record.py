"""The record of a run: motion of chosen points, pins with play, energy and powers, over all recorded states.

A run of a hundred turns has a million states; they are observed in chunks and only what is asked for is kept.
"""

from dataclasses import dataclass

import numpy as np
from scipy.integrate import cumulative_simpson, trapezoid

from drivewright.multibody.observe import FIELDS, POWER_FIELDS, observe
from drivewright.stopped import Stop

CHUNK = 20_000
IDLE = 1e-3  # part of the energy exchanged that drives do at least, for the power audit
POINT_FIELDS = ("angle", "w", "alpha", "x", "y", "vx", "vy", "ax", "ay")


@dataclass(frozen=True)
class Record:
    """Over the times t (m,): points {name: (m, POINT_FIELDS)}, pins (m, pins, PIN_FIELDS), powers (m, POWER_FIELDS), drives (m, drives),
    energy (m,) kinetic and of gravity, kinetic (m,) alone; last (bodies, FIELDS) at the end; stop where the run ended before its time.

    A time stands twice where two events fall together.
    """

    t: np.ndarray
    points: dict
    pins: np.ndarray
    powers: np.ndarray
    drives: np.ndarray
    energy: np.ndarray
    kinetic: np.ndarray
    last: np.ndarray
    stop: Stop | None = None

    def point(self, name, field):
        return self.points[name][:, POINT_FIELDS.index(field)]

    def after(self, time):
        """The part from a time on."""
        return self.take(self.t >= time)

    def take(self, keep):
        """The chosen rows."""
        return Record(
            self.t[keep],
            {k: v[keep] for k, v in self.points.items()},
            self.pins[keep],
            self.powers[keep],
            self.drives[keep],
            self.energy[keep],
            self.kinetic[keep],
            self.last,
            self.stop,
        )


def record(run, markers, start=-np.inf):
    """The `Record` of a run for markers {name: Marker}, from a time on."""
    parts = [part for stretch in run.stretches for part in _parts(run.assembly, stretch, markers, start)]
    t, points, pins, powers, drives, energy, kinetic = zip(*parts, strict=True)
    return Record(
        np.concatenate(t),
        {name: np.concatenate([p[name] for p in points]) for name in markers},
        np.concatenate(pins),
        np.concatenate(powers),
        np.concatenate(drives),
        np.concatenate(energy),
        np.concatenate(kinetic),
        last_of(run),
        run.stop,
    )


def last_of(run):
    """(bodies, FIELDS) at the end of a run."""
    system, time, state = run.end
    return observe(system, [time], state[None]).bodies[0]


def _parts(assembly, stretch, markers, start):
    for first in range(int(np.searchsorted(stretch.t, start)), len(stretch.t), CHUNK):
        seen = observe(stretch.system, stretch.t[first : first + CHUNK], stretch.y[first : first + CHUNK])
        points = {name: moved(assembly, seen, marker) for name, marker in markers.items()}
        yield seen.t, points, seen.pins, seen.powers, seen.drives, *energy_of(stretch.system, seen)


def moved(assembly, seen, marker):
    """POINT_FIELDS (m, 9) of a marker's motion: angle of its body with rates, place with rates."""
    number = assembly.names.index(marker.body)
    x, y, angle, vx, vy, w, ax, ay, alpha = np.moveaxis(seen.bodies[:, number, :9], 1, 0)
    cx, cy = next((body.centroid for body in assembly.wide.bodies if body.name == marker.body), (0.0, 0.0))
    dx, dy = marker.x - cx, marker.y - cy
    px, py = np.cos(angle) * dx - np.sin(angle) * dy, np.sin(angle) * dx + np.cos(angle) * dy
    return np.stack(
        [angle, w, alpha, x + px, y + py, vx - w * py, vy + w * px, ax - alpha * py - w * w * px, ay + alpha * px - w * w * py], axis=1
    )


def energy_of(system, seen):
    """(kinetic energy and energy of gravity, kinetic energy alone) [J]."""
    x, y, _, vx, vy, w = np.moveaxis(seen.bodies[:, :, : FIELDS.index("ax")], 2, 0)
    mass, inertia = system.bodies.mass, system.bodies.inertia
    kinetic = np.sum(0.5 * mass * (vx**2 + vy**2) + 0.5 * inertia * w**2, axis=1)
    return kinetic - (system.gravity_x * x + system.gravity_y * y) @ mass, kinetic


# ------------------------------------------------------------------------------------------------------------ energy audit


@dataclass(frozen=True)
class Audit:
    """Work [J] of each kind of element from the start, over t (m,): works (m, POWER_FIELDS); gap (m,) between all work and the change of
    energy; exchanged: all power, either way, over time, and all that the kinetic energy rises and falls; driven: the same of the power of
    the drives alone."""

    t: np.ndarray
    works: np.ndarray
    gap: np.ndarray
    exchanged: float
    driven: float

    @property
    def error(self):
        """Largest gap over the energy exchanged."""
        return float(np.max(np.abs(self.gap)) / self.exchanged) if self.exchanged > 0 else 0.0

    @property
    def power_error(self):
        """Largest difference between the work of the drives and the change of energy and losses, over the work that the drives do, give
        and take; drives that do next to nothing count as a thousandth of what is exchanged."""
        whole = max(self.driven, IDLE * self.exchanged)
        return float(np.max(np.abs(self.gap)) / whole) if whole > 0 else 0.0


def audit(seen):
    """The `Audit` of a record taken with two points per step: Simpson's rule over each step."""
    t, power = seen.t[::2], seen.powers
    steps = np.diff(t)[:, None]
    begin, middle, end = power[:-2:2], power[1:-1:2], power[2::2]
    works = np.concatenate([np.zeros((1, power.shape[1])), np.cumsum(steps / 6 * (begin + 4 * middle + end), axis=0)])
    flow = np.sum(steps / 6 * (np.abs(begin) + 4 * np.abs(middle) + np.abs(end)), axis=0)
    return _audit(t, works, flow, seen.energy[::2], seen.kinetic[::2])


def audit_of_samples(seen):
    """The `Audit` of a record at any times, Simpson's rule over neighbouring samples: kinematics has no steps of its own."""
    works = cumulative_simpson(seen.powers, x=seen.t, axis=0, initial=0.0)
    flow = trapezoid(np.abs(seen.powers), seen.t, axis=0)
    return _audit(seen.t, works, flow, seen.energy, seen.kinetic)


def _audit(t, works, flow, energy, kinetic):
    exchanged = float(np.sum(flow) + np.sum(np.abs(np.diff(kinetic))))
    return Audit(t, works, energy - energy[0] - np.sum(works, axis=1), exchanged, float(flow[POWER_FIELDS.index("drives")]))
