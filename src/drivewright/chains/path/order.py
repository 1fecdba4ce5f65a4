"""Which bodies the chain meets, one after another: from two sprockets on, each strand is deflected by the bodies in its way.

A sprocket inside stands in the way of a strand where it reaches over to its left, one outside where it reaches over to its right.  What
stands in the way the most comes first: among sprockets inside this is the convex hull of circles (Quickhull's choice), and what no strand
comes near is not met.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from drivewright._typing import Complexes, Floats
from drivewright.chains.model import ChainDrive, Guide
from drivewright.chains.path.route import Route, Station, bodies, centres, route, stations
from drivewright.errors import InputError

TOUCH = 1e-9  # of the pitch: a body that stands in the way by less does not touch


class _Obstacle(NamedTuple):
    """By how much [m] a station stands in the way of the strand that leaves number `strand`; less than 0: how far it is away."""

    depth: float
    strand: int


def met(model: ChainDrive, q: Floats, without: Sequence[int] = ()) -> Route:
    """The `Route` past all bodies that stand in the chain's way at the places q (bodies,) [m]; bodies `without` are left aside.

    Sprockets that no strand reaches are not in it, nor are guides that the chain passes by.
    """
    every = stations(model)
    chosen = [every[0], every[_second(model)]]
    _refuse_overlap(chosen[0], chosen[1], centres(model, q))
    waiting = [s for s in every if s not in chosen and s.body not in without]
    count = len(model.sprockets)
    for group in ([s for s in waiting if s.body < count], [s for s in waiting if s.body >= count]):
        while group:
            now = route(model, chosen, q)
            depths = {s: _obstacle(model, now, s, q) for s in group}
            worst = max(group, key=lambda s: depths[s].depth)
            if not depths[worst].depth > TOUCH * model.chain.link.pitch:
                break
            chosen.insert(depths[worst].strand + 1, worst)
            group.remove(worst)
    return route(model, chosen, q)


def clearance(model: ChainDrive, q: Floats, body: int) -> float:
    """How far [m] a body that the chain does not meet is from the nearest strand at the places q (bodies,) [m]."""
    now = met(model, q, without=(body,))
    return -_obstacle(model, now, stations(model)[body], q).depth


def _second(model):
    """The first other sprocket inside."""
    inside = [number for number, sprocket in enumerate(model.sprockets) if not sprocket.outside]
    if len(inside) < 2 or inside[0] != 0:
        raise InputError("chain drive: sprocket 1 and another one must lie inside the loop; only idlers may be outside.")
    return inside[1]


def _refuse_overlap(first: Station, second: Station, at: Complexes) -> None:
    """InputError where the two sprockets that carry the loop overlap."""
    apart, least = abs(at[second.body] - at[first.body]), first.radius + second.radius
    if apart <= least:
        raise InputError(
            f"chain drive: {first.name} and {second.name} overlap: their centres are {1e3 * apart:.4g} mm apart, and their pitch circles "
            f"touch at {1e3 * least:.4g} mm. Increase the centre distance, or take fewer teeth."
        )


def _obstacle(model: ChainDrive, now: Route, station: Station, q: Floats) -> _Obstacle:
    """How a station stands in the way: of the strand that its centre (of a guide, the middle of its arc) is nearest to.

    A sprocket inside may lie far beyond a strand, so it is the strand that it reaches over the most.
    """
    body, centre = bodies(model)[station.body], centres(model, q)[station.body]
    nearest, found = np.inf, _Obstacle(-np.inf, 0)
    for strand, (start, heading, length) in enumerate(zip(now.starts, now.headings, now.lengths, strict=True)):
        seen = (centre - start) * np.exp(-1j * heading)  # along the strand, and to its left
        depth = station.radius - station.turn * seen.imag
        if isinstance(body, Guide):
            middle = 0.5 * (body.start + body.end) + _turned(body, q[station.body])
            seen = (centre + station.radius * np.exp(1j * middle) - start) * np.exp(-1j * heading)
        beside = max(-seen.real, seen.real - length, 0.0)
        by_depth = station.turn < 0 and not isinstance(body, Guide)
        measure = -depth + beside if by_depth else np.hypot(beside, seen.imag)
        if measure < nearest and beside < station.radius + length:
            nearest, found = measure, _Obstacle(float(depth) if _faces(body, station, heading, q) else -abs(float(depth)), strand)
    return found


def _turned(body, q):
    """By how much a guide has turned about its pivot  [rad]."""
    return body.slide.turn(float(q)) if body.slide else 0.0


def _faces(body, station, heading, q):
    """Whether a guide's arc faces a strand: its middle within a right angle of the strand's normal on the guide's side."""
    if not isinstance(body, Guide):
        return True
    towards = heading - station.turn * 0.5 * np.pi  # from the centre of the arc to the strand
    return np.cos(0.5 * (body.start + body.end) + _turned(body, q[station.body]) - towards) > 0
