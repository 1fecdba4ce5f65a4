"""The loop as a polygon: seated plates on the sprockets, free plates between them, straight or bent around guides.

Sprockets stand in the order in which the chain meets them.  Plates leave sprocket j in the direction beta_j.  Unknown are the directions,
the angles of all sprockets but the first, and what lets the loop close: the first sprocket on a slide, or without one an even change of
the hole pitches of all free plates.
"""

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np

from drivewright._typing import Complexes, Floats, Ints
from drivewright.chains.link import Link
from drivewright.errors import DoesNotAssemble, SolverError
from drivewright.numerics.roots import newton

STEP = 1e-7  # of differences, in lengths of the pitch and in angles


class Bend(NamedTuple):
    """Where a strand begins to bend around a guide [m from its beginning], radius [m], sense of turn and angle [rad] of the bend."""

    start: float
    radius: float
    turn: int
    wrap: float


class Polygon(NamedTuple):
    """The loop in the making, in the order of the path.

    teeth, height of seated plates [m], turn (-1 inside, +1 outside) of the sprockets (m,); their centres (m,) at the places of the path;
    slide: the sprocket that makes the loop close, or None, and its centre by its place; gap (m,): distance of the pins of a strand's
    joints under tension [m]; beta, arrival (m,): headings of the strands that leave and arrive [rad]; length (m,) of the strands [m];
    bends of each strand.
    """

    link: Link
    teeth: Floats
    height: Floats
    turn: Ints
    centre: Complexes
    slide: int | None
    slid: Callable[[float], complex]
    place: float
    gap: Floats
    beta: Floats
    arrival: Floats
    length: Floats
    bends: tuple[tuple[Bend, ...], ...]

    def centres(self, q: float) -> Complexes:
        """Centres with the slide at its place q [m]."""
        moved = self.centre.copy()
        if self.slide is not None:
            moved[self.slide] = self.slid(q)
        return moved

    def parts(self, extra: float) -> tuple[float, float]:
        """(place of the slide, change of the free plates' pitch) of what lets the loop close."""
        return (extra, 0.0) if self.slide is not None else (0.0, extra)

    @property
    def phi(self) -> Floats:
        """Angle of a tooth of each sprocket [rad]."""
        return 2 * np.pi / self.teeth


class Seats(NamedTuple):
    """(first, last) tooth of each sprocket with a plate, free plates of each strand, headings of these against the strand's beginning."""

    first: Ints
    last: Ints
    free: Ints
    bent: tuple[Floats, ...]


class Closed(NamedTuple):
    """Headings beta (m,), angles psi (m,) of the sprockets, place of the slide or change of the free plates' pitch."""

    beta: Floats
    psi: Floats
    extra: float


def seats(loop: Polygon, count: int, angle: float) -> tuple[Seats, Floats]:
    """`Seats` of `count` plates with sprocket 1 at an angle [rad], and first guess of all unknowns: beta, psi, extra."""
    m, phi, turn, p = len(loop.beta), loop.phi, loop.turn, loop.link.pitch
    psi, first, last, free = np.zeros(m), np.zeros(m, int), np.zeros(m, int), np.zeros(m, int)
    psi[0] = angle
    for j in range(m):
        first[j], last[j] = _seated(loop, j, psi[j])
        plates = loop.length[j] / p + _past(loop, j, psi[j], last[j]) + 0.5
        free[j] = round(plates) - 1
        if j + 1 < m:  # the next sprocket takes its first plate half a tooth after the tangent
            heading = loop.arrival[j + 1] + turn[j + 1] * (0.5 + free[j] + 1 - plates) * phi[j + 1]
            psi[j + 1] = heading - turn[j + 1] * 0.5 * np.pi
    free[-1] = count - int(np.sum(turn * (last - first) + 1)) - int(np.sum(free[:-1]))
    if np.min(free) < 1:
        raise DoesNotAssemble(
            f"chain drive: a strand has {np.min(free)} free plates; it needs at least one between sprockets. Lengthen the chain or "
            "move the sprockets."
        )
    guess = np.concatenate([loop.beta, psi, [loop.place if loop.slide is not None else 0.0]])
    return Seats(first, last, free, _bent(loop, psi, last, free)), guess


def reseated(loop: Polygon, seats: Seats, found: Closed) -> tuple[Polygon, Seats, bool]:
    """(polygon, seats, whether anything is new) with the plates seated that the headings found ask for: strands leave where they are in
    line with the next plate's seat."""
    turned = [sum(b.turn * b.wrap for b in bends) for bends in loop.bends]
    arrival = np.roll(found.beta + turned, 1)
    arrival[0] += 2 * np.pi
    loop = loop._replace(beta=found.beta, arrival=arrival)
    first, last = np.array([_seated(loop, j, psi) for j, psi in enumerate(found.psi)]).T
    free = seats.free - loop.turn * (last - seats.last) + np.roll(loop.turn * (first - seats.first), -1)
    new = bool(np.any(first != seats.first) or np.any(last != seats.last)) and bool(np.min(free) >= 1)
    if not new:
        return loop, seats, False
    return loop, Seats(first, last, free, _bent(loop, found.psi, last, free)), True


def _past(loop, j, psi, last):
    """Pitches by which the middle of the last seated plate lies before the strand's beginning."""
    return -loop.turn[j] * (psi + last * loop.phi[j] + loop.turn[j] * 0.5 * np.pi - loop.beta[j]) / loop.phi[j]


def _bent(loop, psi, last, free):
    """Headings of the free plates of each strand against its beginning, as its guides bend it."""
    bent = []
    for j, bends in enumerate(loop.bends):
        along = (np.arange(1, free[j] + 1) - _past(loop, j, psi[j], last[j])) * loop.link.pitch
        bent.append(sum((b.turn * np.clip((along - b.start) / b.radius, 0.0, b.wrap) for b in bends), np.zeros(free[j])))
    return tuple(bent)


def _seated(loop, j, psi):
    """First and last tooth of sprocket j that has a plate within the wrap.

    A hinge may lie in its gap between two plates that are both free: the last tooth is then the one before the first, and the ends of both
    strands are this pin.  Where plates mesh, the one nearest to the middle of the wrap is seated.
    """
    turn, phi = loop.turn[j], loop.phi[j]
    into, out = ((heading - turn * 0.5 * np.pi - psi) / phi for heading in (loop.arrival[j], loop.beta[j]))
    first, last = turn * np.ceil(turn * into), turn * np.floor(turn * out + 1e-9)
    if turn * (last - first) < 0 and loop.link.radius > 0:
        first = last = np.round(0.5 * (into + out))
    return int(first), int(last)


def closed(loop: Polygon, seats: Seats, guess: Floats) -> Closed:
    """What closes the loop: every strand meets both its ends."""
    m, p = len(loop.beta), loop.link.pitch
    scale = np.concatenate([np.ones(2 * m - 1), [p]])

    def whole(x):
        return Closed(x[:m], np.append(guess[m], x[m : 2 * m - 1]), x[-1])

    def residual(x):
        return _misses(loop, seats, whole(x)) / p

    def both(x):
        steps = STEP * scale
        columns = [(residual(x + d) - residual(x - d)) / (2 * h) for h, d in zip(steps, np.diag(steps), strict=True)]
        return residual(x), np.array(columns).T

    try:
        return whole(newton(both, np.delete(guess, m), scale=scale, tolerance=1e-10))
    except SolverError as error:
        raise DoesNotAssemble(f"chain drive: the loop does not close ({error})") from error


def _pins(loop, centre, j, angle):
    """(left, right) pin of a plate seated on sprocket j at this angle of its own."""
    arm, out = 0.5 * loop.link.hole_pitch, -1j * loop.turn[j] * loop.height[j]
    return tuple(centre[j] + (side + out) * np.exp(1j * angle) for side in (-arm, arm))


def _ends(loop: Polygon, seats: Seats, psi: Floats, q: float) -> Iterator[tuple[complex, float, complex, float]]:
    """Per strand: right pin and angle of the last seated plate, left pin and angle of the next first one."""
    centre, phi, quarter = loop.centres(q), loop.phi, 0.5 * np.pi * loop.turn
    for j in range(len(psi)):
        n = (j + 1) % len(psi)
        off = psi[j] + seats.last[j] * phi[j] + quarter[j]
        on = psi[n] + seats.first[n] * phi[n] + quarter[n] - (2 * np.pi if n == 0 else 0.0)
        yield _pins(loop, centre, j, off)[1], off, _pins(loop, centre, n, on)[0], on


def _misses(loop, seats, found):
    """By how much each strand, laid from its beginning, misses its end: (2 m,) real."""
    q, more = loop.parts(found.extra)
    A, misses = loop.link.hole_pitch + more, []
    ends = _ends(loop, seats, found.psi, q)
    for (pin, off, target, on), bent, b, gap in zip(ends, seats.bent, found.beta, loop.gap, strict=True):
        d = b + bent
        joints = np.exp(0.5j * (off + d[0])) + np.sum(np.exp(0.5j * (d[1:] + d[:-1]))) + np.exp(0.5j * (d[-1] + on))
        misses.append(pin + A * np.sum(np.exp(1j * d)) - gap * joints - target)
    return np.concatenate([np.real(misses), np.imag(misses)])


def poses(loop: Polygon, seats: Seats, found: Closed) -> tuple[Floats, tuple[Ints, ...]]:
    """Pin-frame poses (N, 3) of all plates in their order, and which of them sit on each sprocket."""
    q, more = loop.parts(found.extra)
    A, rows, seated = loop.link.hole_pitch + more, [], []
    centre = loop.centres(q)
    for j, (pin, off, _, _) in enumerate(_ends(loop, seats, found.psi, q)):
        turn, gap = loop.turn[j], loop.gap[j]
        teeth = np.arange(seats.first[j], seats.last[j] + turn, turn)
        angles = found.psi[j] + teeth * loop.phi[j] + turn * 0.5 * np.pi
        seated.append(np.arange(len(rows), len(rows) + len(angles)))
        rows += [(centre[j] - turn * 1j * loop.height[j] * np.exp(1j * a), a) for a in angles]
        d = found.beta[j] + seats.bent[j]
        gaps = gap * np.exp(0.5j * (np.concatenate([[off], d[:-1]]) + d))
        steps = A * np.exp(1j * d)
        middles = pin + np.cumsum(steps) - np.cumsum(gaps) - 0.5 * steps
        rows += list(zip(middles, d, strict=True))
    return np.array([(place.real, place.imag, angle) for place, angle in rows]), tuple(seated)
