"""The record of a run: motion of chosen points, pins with play, energy and powers, over all recorded states.

A run of a hundred turns has a million states; they are observed in chunks and only what is required is kept.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from drivewright._typing import Bools, Floats, Ints
from drivewright.multibody.assembly import Assembly
from drivewright.multibody.bodies import Marker
from drivewright.multibody.locking import refuse_locked
from drivewright.multibody.observe import FIELDS, Observed, observe
from drivewright.multibody.simulate import Run
from drivewright.multibody.system import System
from drivewright.stops import Stop

CHUNK = 20_000
POINT_FIELDS = ("angle", "w", "alpha", "x", "y", "vx", "vy", "ax", "ay")


@dataclass(frozen=True)
class Record:
    """Over the times t (m,): points {name: (m, POINT_FIELDS)}, pins (m, pins, PIN_FIELDS), powers (m, POWER_FIELDS), drives (m, drives),
    frictions (m, ideal joints with friction, FRICTION_FIELDS),
    energy (m,) kinetic and of gravity, kinetic (m,) alone; last (bodies, FIELDS) at the end; stop where the run ended before its time.

    A time stands twice where two events fall together.
    """

    t: Floats
    points: dict[str, Floats]
    pins: Floats
    powers: Floats
    drives: Floats
    frictions: Floats
    energy: Floats
    kinetic: Floats
    last: Floats
    stop: Stop | None = None

    def point(self, name: str, field: str) -> Floats:
        """One of POINT_FIELDS of a marker (m,)."""
        return self.points[name][:, POINT_FIELDS.index(field)]

    def after(self, time: float) -> "Record":
        """The part from a time on."""
        keep = self.t >= time
        return self if np.all(keep) else self.take(keep)

    def take(self, keep: Bools | Ints) -> "Record":
        """The chosen rows."""
        return Record(
            self.t[keep],
            {k: v[keep] for k, v in self.points.items()},
            self.pins[keep],
            self.powers[keep],
            self.drives[keep],
            self.frictions[keep],
            self.energy[keep],
            self.kinetic[keep],
            self.last,
            self.stop,
        )


def record(run: Run, markers: Mapping[str, Marker], start: float = -np.inf) -> Record:
    """The `Record` of a run for markers {name: Marker}, from a time on."""
    parts = [part for stretch in run.stretches for part in _parts(run.assembly, stretch, markers, start)]
    t, points, pins, powers, drives, frictions, energy, kinetic = zip(*parts, strict=True)
    return Record(
        np.concatenate(t),
        {name: np.concatenate([p[name] for p in points]) for name in markers},
        np.concatenate(pins),
        np.concatenate(powers),
        np.concatenate(drives),
        np.concatenate(frictions),
        np.concatenate(energy),
        np.concatenate(kinetic),
        final_state(run),
        run.stop,
    )


def final_state(run: Run) -> Floats:
    """(bodies, FIELDS) at the end of a run."""
    system, time, state = run.end
    return observe(system, [time], state[None]).bodies[0]


def _parts(assembly, stretch, markers, start):
    for first in range(int(np.searchsorted(stretch.t, start)), len(stretch.t), CHUNK):
        t, y = stretch.t[first : first + CHUNK], stretch.y[first : first + CHUNK]
        record = observe(stretch.system, t, y)
        refuse_locked(assembly, stretch.system, t, y, record.frictions)
        points = {name: marker_motion(assembly, record.bodies, marker) for name, marker in markers.items()}
        yield record.t, points, record.pins, record.powers, record.drives, record.frictions, *energy_of(stretch.system, record)


def marker_motion(assembly: Assembly, bodies: Floats, marker: Marker) -> Floats:
    """POINT_FIELDS (m, 9) of a marker's motion, of bodies (m, bodies, FIELDS): angle of its body with rates, place with rates."""
    number = assembly.names.index(marker.body)
    x, y, angle, vx, vy, w, ax, ay, alpha = np.ascontiguousarray(bodies[:, number, :9].T)
    cx, cy = next((body.centroid for body in assembly.expanded.bodies if body.name == marker.body), (0.0, 0.0))
    dx, dy = marker.x - cx, marker.y - cy
    c, s = np.cos(angle), np.sin(angle)
    px, py = c * dx - s * dy, s * dx + c * dy
    return np.array(
        [angle, w, alpha, x + px, y + py, vx - w * py, vy + w * px, ax - alpha * py - w * w * px, ay + alpha * px - w * w * py]
    ).T


def energy_of(system: System, record: Observed) -> tuple[Floats, Floats]:
    """(kinetic energy and energy of gravity, kinetic energy alone) [J]."""
    x, y, _, vx, vy, w = np.moveaxis(record.bodies[:, :, : FIELDS.index("ax")], 2, 0)
    mass, inertia = system.bodies.mass, system.bodies.inertia
    kinetic = 0.5 * ((vx**2 + vy**2) @ mass + w**2 @ inertia)
    return kinetic - (system.gravity_x * x + system.gravity_y * y) @ mass, kinetic
