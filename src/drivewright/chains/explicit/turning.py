"""A drive with rigid links at many angles of its driver, strands straight or bent around guides: for the screen, and how evenly it can run.

Free plates of a strand lie in line, around a guide on its smooth arc; a plate is seated from where its seat is in line with the strand.
What gives way so that the loop closes is the one tensioner (or the sliding driven sprocket).
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from drivewright._typing import ArrayLike, Floats
from drivewright.chains.explicit.assembly import Laid, laid_along
from drivewright.chains.explicit.polygon import closed, poses, reseated, seats
from drivewright.chains.model import ChainDrive
from drivewright.chains.path.balance import Balance, balanced
from drivewright.chains.path.route import bodies, route
from drivewright.errors import InputError

RESEATED = 4  # times that the seats are asked for again at an angle
SECANTS = 8
STILL = 1e-9  # of the pitch


class Turning(NamedTuple):
    """Angles of sprocket 1 (S,) [rad]; poses of all plates (S, N, 3), the same plate in the same row; angles of the sprockets
    (S, sprockets) [rad]; places of all bodies (S, bodies) [m]."""

    angle: Floats
    plates: Floats
    psi: Floats
    q: Floats


def turning(model: ChainDrive, angles: ArrayLike, balance: Balance | None = None, exact: bool = True) -> Turning:
    """The `Turning` of a drive at angles of sprocket 1 that change by less than half a tooth; `exact`: tensioners give way at each.

    Without, a guide that is a tensioner stands still, and the free plates' pitch takes up what it would: for the screen.
    """
    balance = balanced(model) if balance is None else balance
    guide, laid, rows = _yielding_guide(model, balance), _rigid(model, balance), []
    for angle in np.asarray(angles, float):
        if exact and guide is not None:
            balance, laid = _given_way(model, balance, guide, float(angle))
        plates, psi, q = _positions(model, laid, float(angle))
        rows.append(_continued(model, rows[-1] if rows else None, plates, psi, q))
    return Turning(np.asarray(angles, float), *(np.array(column) for column in zip(*rows, strict=True)))


def _rigid(model, balance):
    """The polygon along a path with joints that do not stretch."""
    laid = laid_along(model, balance)
    return replace(laid, loop=laid.loop._replace(gap=np.full(len(laid.loop.gap), 2 * model.chain.link.radius)))


def _yielding_guide(model, balance):
    """Number of the guide that closes the loop; None where a sprocket does."""
    on_path = [station.body for station in balance.route.stations if bodies(model)[station.body].slide]
    if any(number < len(model.sprockets) for number in on_path):
        return None
    return on_path[0] if on_path else None


def yielding(model: ChainDrive, balance: Balance) -> int:
    """Number of the one body that gives way; InputError where it is none or several, whose places are a matter of forces."""
    on_path = [station.body for station in balance.route.stations if bodies(model)[station.body].slide]
    if len(on_path) != 1:
        what = "no body can move" if not on_path else f"{len(on_path)} bodies can move, so that their positions depend on the forces"
        raise InputError(f"chain drive: {what}; a rigid chain needs exactly one moving body. Use the chain at rest (quasi_static) instead.")
    return on_path[0]


def _solved(laid: Laid, count: int, angle: float):
    """(seats, what closes the loop) at an angle of sprocket 1."""
    loop = laid.loop
    taken, guess = seats(loop, count, angle)
    found = closed(loop, taken, guess)
    for _ in range(RESEATED):
        loop, taken, new = reseated(loop, taken, found)
        if not new:
            break
        found = closed(loop, taken, np.concatenate([found.beta, found.psi, [found.extra]]))
    return taken, found


def _positions(model, laid, angle):
    """(poses, psi, q) at an angle of sprocket 1."""
    taken, found = _solved(laid, model.chain.count, angle)
    plates, _ = poses(laid.loop, taken, found)
    q, back = laid.q.copy(), np.argsort(laid.order)
    if laid.loop.slide is not None:
        q[laid.order[laid.loop.slide]] = found.extra
    return plates, found.psi[back], q


def _given_way(model, balance, guide, angle):
    """(balance, polygon) with the guide where the free plates keep their pitch, by secants."""
    pitch = model.chain.link.pitch

    def change(place):
        q = balance.q.copy()
        q[guide] = place
        now = balance._replace(q=q, route=route(model, balance.route.stations, q))
        laid = _rigid(model, now)
        return _solved(laid, model.chain.count, angle)[1].extra, now, laid

    a, b = balance.q[guide], balance.q[guide] + 1e-3 * pitch
    at_a, (at_b, now, laid) = change(a)[0], change(b)
    for _ in range(SECANTS):
        if abs(b - a) < STILL * pitch or at_a == at_b:
            break
        a, b, at_a = b, b - at_b * (b - a) / (at_b - at_a), at_b
        at_b, now, laid = change(b)
    return now, laid


def _continued(model, before, plates, psi, q):
    """The row after `before`, plates and teeth numbered on."""
    if before is None:
        return plates, psi, q
    shift = int(np.argmin(np.hypot(*(plates[:, :2] - before[0][0, :2]).T)))
    plates = np.roll(plates, -shift, axis=0)
    plates[:, 2] += 2 * np.pi * np.round((before[0][:, 2] - plates[:, 2]) / (2 * np.pi))
    phi = 2 * np.pi / np.array([sprocket.tooth.teeth for sprocket in model.sprockets])
    psi = psi + phi * np.round((before[1] - psi) / phi)
    return plates, psi, q
