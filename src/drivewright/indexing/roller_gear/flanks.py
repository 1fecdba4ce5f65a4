"""All contacts of a roller-gear cam over one turn: contact lines, what trimming leaves of them, contact map."""

from dataclasses import dataclass

import numpy as np

from drivewright.indexing.motion import TURN
from drivewright.indexing.roller_gear.design import RollerGear, turns
from drivewright.indexing.roller_gear.envelope import Contact, contact
from drivewright.indexing.roller_gear.trimming import Survivors

FLANKS = np.array([1.0, -1.0])  # pushes the turret forward, backward


@dataclass(frozen=True, eq=False)
class Flanks:
    """Contact lines of every roller on both flanks: arrays (flank, roller, theta, u), the flanks in the order of FLANKS.

    theta (n,) [rad]; u (m,) [m] along the roller from its middle, towards the cam's axis positive; alive: on the finished cam;
    held (..., m - 1): part of each stretch between neighbours of u that is on the finished cam, its ends found by bisection.
    """

    cam: RollerGear
    theta: np.ndarray
    u: np.ndarray
    contact: Contact
    alive: np.ndarray
    held: np.ndarray

    @property
    def pushes(self):
        """Contact map (flank, roller, theta): True where the roller touches a piece of that flank."""
        return np.any(self.held > 0, axis=-1)

    def along_lines(self, values):
        """Integral (flank, roller, theta) of values (flank, roller, theta, u) along the live contact lines, by their true length."""
        density = values * self.contact.line_slope
        return np.sum(self.held * (density[..., 1:] + density[..., :-1]) / 2 * np.diff(self.u), axis=-1)

    def live(self, values):
        """The values (flank, roller, theta, u) where they belong to the finished cam, nan elsewhere."""
        return np.where(self.alive, values, np.nan)

    @property
    def undercut(self):
        """Part [-] of the contact lines within the blank that is lost to local undercut or to a roller passing at another angle."""
        inside = self.cam.in_blank(self.contact.point) >= -1e-12
        return 1.0 - np.count_nonzero(self.alive) / max(np.count_nonzero(inside), 1)

    @property
    def greatest_pressure_angle(self):
        """Largest pressure angle (theta,) [rad] on the finished cam, nan where nothing touches."""
        angles = np.where(self.alive, self.contact.pressure_angle, -np.inf).max(axis=(0, 1, 3))
        return np.where(np.isfinite(angles), angles, np.nan)


def flanks(cam, theta=None, along=9):
    """Flanks of a cam at the angles theta (181 over a turn where not given), `along` places on each roller."""
    theta = np.linspace(0.0, TURN, 181) if theta is None else np.asarray(theta, dtype=float)
    u = np.linspace(-0.5, 0.5, along) * cam.roller_length
    survivors = Survivors(cam)
    places = FLANKS[:, None, None, None], turns(theta, cam.rollers)[None, :, :, None], u
    touching = contact(cam, places[1], places[2], places[0])
    alive = survivors.alive(touching)
    return Flanks(cam, theta, u, touching, alive, _held(survivors, places, alive))


def _held(survivors, places, alive):
    """Live part of each stretch of u: 1 between two live ends, 0 between two dead ones, else up to the end found by bisection."""
    held = (alive[..., 1:] & alive[..., :-1]).astype(float)
    ends = np.nonzero(alive[..., 1:] != alive[..., :-1])
    flank, travel, u = (np.broadcast_to(each, alive.shape) for each in (places[0], places[1], places[2]))
    start, stop = u[..., :-1][ends], u[..., 1:][ends]
    first = alive[..., :-1][ends]
    good, bad = np.where(first, start, stop), np.where(first, stop, start)
    edge = last_alive(survivors, good, bad, lambda place: (travel[..., 1:][ends], place, flank[..., 1:][ends]))
    held[ends] = np.abs(edge - good) / np.abs(stop - start)
    return held


def last_alive(survivors, good, bad, places, steps=24):
    """Where surviving ends between live `good` and dead `bad`, by bisection; places(x) gives travel, u and flank of the contact at x."""
    for _ in range(steps if good.size else 0):
        middle = (good + bad) / 2
        alive = survivors.alive(contact(survivors.cam, *places(middle)))
        good, bad = np.where(alive, middle, good), np.where(alive, bad, middle)
    return good


def trim_edges(found):
    """Points (n, 3) [m], in the cam's frame, where the finished flanks end between neighbouring angles of `found`, at each u."""
    survivors = Survivors(found.cam)
    here, there = found.alive[:, :, :-1], found.alive[:, :, 1:]
    ends = np.nonzero(here != there)
    travel = turns(found.theta, found.cam.rollers)[ends[1]]
    start, stop = (np.take_along_axis(travel, (ends[2] + step)[:, None], axis=1)[:, 0] for step in (0, 1))
    first = here[ends]
    good, bad = np.where(first, start, stop), np.where(first, stop, start)
    u, flank = found.u[ends[3]], FLANKS[ends[0]]
    edge = last_alive(survivors, good, bad, lambda place: (place, u, flank))
    return contact(found.cam, edge, u, flank).point
