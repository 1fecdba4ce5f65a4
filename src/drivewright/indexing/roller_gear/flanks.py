"""All contacts of a roller-gear cam over one turn: contact lines, what trimming leaves of them, contact map."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from drivewright._typing import ArrayLike, Bools, Floats
from drivewright.indexing.motion import TURN
from drivewright.indexing.roller_gear.design import RollerGear, roller_travel
from drivewright.indexing.roller_gear.envelope import FlankContact, flank_contact
from drivewright.indexing.roller_gear.trimming import TrimmingTest, in_front_of_blank

FLANKS = np.array([1.0, -1.0])  # pushes the turret forward, backward


@dataclass(frozen=True, eq=False)
class CamFlanks:
    """Contact lines of every roller on both flanks: arrays (flank, roller, theta, u), the flanks in the order of FLANKS.

    theta (n,) [rad]; u (m,) [m] along the roller from its middle, towards the cam's axis positive; on_cam: on the finished cam;
    active_fraction (..., m - 1): part of each stretch between neighbours of u that is on the finished cam, its ends found by bisection.
    """

    cam: RollerGear
    theta: Floats
    u: Floats
    contact: FlankContact
    on_cam: Bools
    active_fraction: Floats

    @property
    def contact_map(self) -> Bools:
        """Contact map (flank, roller, theta): True where the roller touches a piece of that flank."""
        return np.any(self.active_fraction > 0, axis=-1)

    def integrate_along_lines(self, values: Floats) -> Floats:
        """Integral (flank, roller, theta) of values (flank, roller, theta, u) along the live contact lines, by their true length."""
        density = values * self.contact.line_slope
        return np.sum(self.active_fraction * (density[..., 1:] + density[..., :-1]) / 2 * np.diff(self.u), axis=-1)

    def mask_off_cam(self, values: Floats) -> Floats:
        """The values (flank, roller, theta, u) where they belong to the finished cam, nan elsewhere."""
        return np.where(self.on_cam, values, np.nan)

    @property
    def undercut(self) -> float:
        """Part [-] of the contact lines within the blank that is lost to local undercut or to a roller passing at another angle."""
        inside = in_front_of_blank(self.cam, self.contact)
        return 1.0 - np.count_nonzero(self.on_cam) / max(np.count_nonzero(inside), 1)

    @property
    def pressure_angle_maximum(self) -> Floats:
        """Largest pressure angle (theta,) [rad] on the finished cam, nan where nothing touches."""
        angles = np.where(self.on_cam, self.contact.pressure_angle, -np.inf).max(axis=(0, 1, 3))
        return np.where(np.isfinite(angles), angles, np.nan)


def compute_flanks(cam: RollerGear, theta: ArrayLike | None = None, along: int = 9) -> CamFlanks:
    """Flanks of a cam at the angles theta (181 over a turn where not given), `along` places on each roller."""
    theta = np.linspace(0.0, TURN, 181) if theta is None else np.asarray(theta, dtype=float)
    u = np.linspace(-0.5, 0.5, along) * cam.roller_length
    trimming = TrimmingTest(cam)
    travel, start = roller_travel(cam, theta, cam.rollers)
    places = FLANKS[:, None, None, None], travel[None, :, :, None], u, start[None, :, :, None]
    contact = flank_contact(cam, places[1], places[2], places[0], places[3])
    on_cam = trimming.on_cam(contact)
    return CamFlanks(cam, theta, u, contact, on_cam, _active_fractions(trimming, places, on_cam))


def _active_fractions(trimming, places, on_cam):
    """Live part of each stretch of u: 1 between two live ends, 0 between two dead ones, else up to the end found by bisection."""
    fraction = (on_cam[..., 1:] & on_cam[..., :-1]).astype(float)
    ends = np.nonzero(on_cam[..., 1:] != on_cam[..., :-1])
    flank, travel, u, start = (np.broadcast_to(each, on_cam.shape) for each in places)
    low, high = u[..., :-1][ends], u[..., 1:][ends]
    first = on_cam[..., :-1][ends]
    good, bad = np.where(first, low, high), np.where(first, high, low)
    edge = bisect_trim_edge(trimming, good, bad, lambda place: (travel[..., 1:][ends], place, flank[..., 1:][ends], start[..., 1:][ends]))
    fraction[ends] = np.abs(edge - good) / np.abs(high - low)
    return fraction


def bisect_trim_edge(
    trimming: TrimmingTest, good: Floats, bad: Floats, places: Callable[[Floats], tuple[Floats, ...]], steps: int = 24
) -> Floats:
    """Where surviving ends between live `good` and dead `bad`, by bisection; places(x): travel, u, flank and start of the contact at x."""
    for _ in range(steps if good.size else 0):
        middle = (good + bad) / 2
        on_cam = trimming.on_cam(flank_contact(trimming.cam, *places(middle)))
        good, bad = np.where(on_cam, middle, good), np.where(on_cam, bad, middle)
    return good


def find_trim_edges(flanks: CamFlanks) -> Floats:
    """Points (n, 3) [m], in the cam's frame, where the finished flanks end between neighbouring angles of `flanks`, at each u."""
    trimming = TrimmingTest(flanks.cam)
    here, there = flanks.on_cam[:, :, :-1], flanks.on_cam[:, :, 1:]
    ends = np.nonzero(here != there)
    all_travel, all_starts = roller_travel(flanks.cam, flanks.theta, flanks.cam.rollers)
    travel, start = all_travel[ends[1]], all_starts[ends[1], 0]
    low, high = (np.take_along_axis(travel, (ends[2] + step)[:, None], axis=1)[:, 0] for step in (0, 1))
    first = here[ends]
    good, bad = np.where(first, low, high), np.where(first, high, low)
    u, flank = flanks.u[ends[3]], FLANKS[ends[0]]
    edge = bisect_trim_edge(trimming, good, bad, lambda place: (place, u, flank, start))
    return flank_contact(flanks.cam, edge, u, flank, start).point
