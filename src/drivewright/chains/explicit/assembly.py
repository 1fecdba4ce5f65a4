"""Where everything is at the start: seated plates on the sprockets' polygons, straight strands between them, all moving as if rigid.

Plates leave sprocket j in the direction beta_j towards sprocket j + 1.  Unknown are the directions, the angles of all sprockets but the
first, and what lets the loop close: the first slide, or without one an even change of the hole pitches of all free plates.
"""

from dataclasses import dataclass

import numpy as np

from drivewright._typing import Complexes, Floats
from drivewright.chains.link import Link, seat_height
from drivewright.chains.model import ChainDrive
from drivewright.chains.roller_tooth import RollerTooth
from drivewright.errors import DoesNotAssemble, InputError, SolverError
from drivewright.numerics.roots import newton

TIGHT, SLACK = 2e-3, 0.03  # parts of its length by which a chain may miss a loop that nothing adjusts, and that guides may take up
STEP = 1e-7  # of differences, in lengths of the pitch and in angles


@dataclass(frozen=True)
class Start:
    """Poses and rates of the plates (N, 3) from the first one seated on sprocket 1; q and psi (m,) of the sprockets with their rates.

    hole_pitches (N,) with which the loop closes, supports (m,) of teeth that these plates just touch; speed of the chain along x of its
    plates; tension.
    """

    poses: Floats
    rates: Floats
    q: Floats
    psi: Floats
    rate_q: Floats
    rate_psi: Floats
    seated: tuple[Floats, Floats]  # numbers of the plates on each sprocket
    tension: float
    hole_pitches: Floats
    supports: Floats
    speed: float


@dataclass(frozen=True)
class _Loop:
    """Geometry of a loop in the making; slide: number of the sprocket that makes it close, or None."""

    link: Link
    teeth: Floats
    height: Floats
    centre: Complexes  # (m,) complex
    slide: int | None
    direction: complex
    taut: float  # stretch of the joints of free plates by the tension

    def centres(self, q):
        moved = self.centre.copy()
        if self.slide is not None:
            moved[self.slide] += q * self.direction
        return moved

    def parts(self, extra):
        """(place of the slide, change of the free plates' pitch) of what lets the loop close."""
        return (extra, 0.0) if self.slide is not None else (0.0, extra)

    @property
    def phi(self):
        return 2 * np.pi / self.teeth

    @property
    def gap(self):
        """Distance of the pins of a joint under tension."""
        return 2 * self.link.radius - self.taut


def start(model: ChainDrive, before: float = 0.0) -> Start:
    """The `Start` of a model, `before` [s] ahead of sprocket 1 being at its angle; DoesNotAssemble where the chain fits at no place of the
    slide."""
    loop = _loop(model, 0.0)
    q = _slid(loop, model.chain.count, SLACK if model.guides else 0.0)
    speed = _speeds(model)
    chain_speed = _chain_speed(model, speed)
    tension = _tension(model, loop, q, chain_speed)
    loop = _loop(model, tension / model.chain.joint_stiffness)
    seats, free, guess = _seats(loop, model, q, before * speed[0])
    beta, psi, extra = _closed(loop, seats, free, guess)
    poses, seated = _poses(loop, seats, free, beta, psi, extra)
    q, more = loop.parts(extra)
    rates = _rates(poses, seated, loop.centres(q), speed, chain_speed)
    places, pitches = np.zeros(len(psi)), np.full(len(poses), loop.link.hole_pitch + more)
    if loop.slide is not None:
        places[loop.slide] = q
    pitches[np.concatenate(seated)] = loop.link.hole_pitch
    supports = loop.link.flank_support - loop.height * np.sin(loop.link.flank_angle)
    return Start(poses, rates, places, psi, np.zeros(len(psi)), speed, seated, tension, pitches, supports, -np.sign(speed[0]) * chain_speed)


def _loop(model, taut):
    link = model.chain.link._replace(hole_pitch=float(np.mean(model.chain.hole_pitches)))
    teeth = np.array([s.tooth.teeth for s in model.sprockets])
    height = np.array([seat_height(link, z) for z in teeth])
    if any(isinstance(s.tooth, RollerTooth) for s in model.sprockets) and link.radius != 0:
        raise InputError(f"chain drive: roller teeth take a chain with plain joints; its rolling radius is {link.radius:g} m instead of 0.")
    centre = np.array([complex(*s.centre) for s in model.sprockets])
    slide = next((n for n, s in enumerate(model.sprockets) if s.slide), None)
    direction = np.exp(1j * model.sprockets[slide].slide.direction) if slide is not None else 0j
    return _Loop(link, teeth, height, centre, slide, direction, taut)


def _tangents(loop, q):
    """Directions beta_j of the outer common tangents, falling from one to the next, and their lengths."""
    centre = loop.centres(q)
    gap, other = np.roll(centre, -1) - centre, np.roll(loop.height, -1) - loop.height
    if np.any(np.abs(gap) <= np.abs(other)):
        raise DoesNotAssemble(f"chain drive: sprocket {np.argmax(np.abs(gap) <= np.abs(other)) + 1} and the next lie inside each other.")
    beta = np.unwrap(np.angle(gap) + np.arcsin(other / np.abs(gap)))
    beta = beta[0] - np.concatenate([[0.0], np.cumsum((beta[:-1] - beta[1:]) % (2 * np.pi))])
    return beta, np.sqrt(np.abs(gap) ** 2 - other**2)


def _wraps(beta):
    """Angle that the chain turns by on each sprocket."""
    return np.append(beta[-1] + 2 * np.pi - beta[0], beta[:-1] - beta[1:])


def _links(loop, q):
    """Pitches that the loop takes."""
    beta, length = _tangents(loop, q)
    return np.sum(length) / loop.link.pitch + np.sum(_wraps(beta) / loop.phi)


def _slid(loop, count, slack):
    """Place of the slide at which the loop takes `count` pitches; without one, `slack` is the part of the chain that guides may take up."""
    if loop.slide is None:
        links = _links(loop, 0.0)
        if not -slack - TIGHT < links / count - 1 < TIGHT:
            raise DoesNotAssemble(_misfit(links, count))
        return 0.0
    q = 0.0
    for _ in range(50):
        excess = _links(loop, q) - count
        slope = (_links(loop, q + STEP * loop.link.pitch) - _links(loop, q)) / (STEP * loop.link.pitch)
        if abs(excess) < 1e-9:
            return q
        if abs(slope) < 1e-6 / loop.link.pitch:
            break
        q -= np.clip(excess / slope, -5 * loop.link.pitch, 5 * loop.link.pitch)
    raise DoesNotAssemble(_misfit(_links(loop, 0.0), count))


def _misfit(links, count):
    return (
        f"chain drive: the loop around the sprockets takes {links:.4g} pitches, the chain has {count}. "
        "Move a sprocket, give one a slide, or change the number of links."
    )


def _speeds(model):
    """Speed of every sprocket at the start: as the first drive's teeth ask."""
    drive, teeth = model.sprockets[model.driver].drive, np.array([s.tooth.teeth for s in model.sprockets])
    speed = drive.start if drive.ramp > 0 else drive.speed
    return speed * teeth[model.driver] / teeth


def _chain_speed(model, speed):
    return abs(speed[0]) * model.sprockets[0].tooth.teeth * model.chain.link.pitch / (2 * np.pi)


def _tension(model, loop, q, chain_speed):
    """Tension that balances the slide's force, with the centrifugal one rho v^2."""
    centrifugal = model.chain.line_density * chain_speed**2
    if loop.slide is None:
        return centrifugal
    slide, beta = model.sprockets[loop.slide].slide, _tangents(loop, q)[0]
    pull = np.exp(1j * beta[loop.slide]) - np.exp(1j * beta[loop.slide - 1])
    inward = -(pull * np.conj(loop.direction)).real
    tension = (slide.force - slide.stiffness * q) / inward if inward > 1e-6 else -1.0
    if not tension > 0:
        raise InputError(
            f"chain drive: the slide of sprocket {loop.slide + 1} leaves the chain slack (tension {tension:.3g} N); "
            "point its direction outward and its force along it."
        )
    return tension + centrifugal


def _seats(loop, model, q, behind):
    """((first, last) tooth of each sprocket, free plates of each strand, first guess of the unknowns)."""
    beta, length = _tangents(loop, q)
    phi, wrap, count = loop.phi, _wraps(beta), len(beta)
    angle = model.sprockets[0].angle
    psi = np.zeros(count)
    psi[0] = (angle if angle is not None else 0.0) - behind
    first, last, free = np.zeros(count, int), np.zeros(count, int), np.zeros(count, int)
    first[0] = np.floor((beta[0] + wrap[0] + 0.5 * np.pi - psi[0]) / phi[0])
    for j in range(count):
        last[j] = np.ceil((beta[j] + 0.5 * np.pi - psi[j]) / phi[j] - 1e-9)
        if j + 1 < count:  # the next sprocket takes its first plate half a tooth after the tangent
            past = psi[j] + last[j] * phi[j] - 0.5 * np.pi - beta[j]
            plates = length[j] / loop.link.pitch + past / phi[j] + 0.5
            free[j] = round(plates) - 1
            psi[j + 1] = beta[j] + 0.5 * np.pi - (0.5 + free[j] + 1 - plates) * phi[j + 1]
    free[-1] = model.chain.count - np.sum(first - last + 1) - np.sum(free)
    if np.min(free) < 1 or np.min(first - last) < 1:
        raise DoesNotAssemble(
            f"chain drive: {np.min(free)} free plates in a strand and {np.min(first - last) + 1} seated on a sprocket at least; "
            "the loop needs one free and two seated ones everywhere. Lengthen the chain or move the sprockets."
        )
    return (first, last), free, np.concatenate([beta, psi, [q if loop.slide is not None else 0.0]])


def _closed(loop, seats, free, guess):
    """(beta, psi, place of the slide or change of the free plates' pitch) at which every strand meets both its ends."""
    m, p = len(free), loop.link.pitch
    scale = np.concatenate([np.ones(2 * m - 1), [p]])

    def residual(x):
        return _misses(loop, seats, free, x[:m], np.append(guess[m], x[m : 2 * m - 1]), x[-1]) / p

    def both(x):
        steps = STEP * scale
        columns = [(residual(x + d) - residual(x - d)) / (2 * h) for h, d in zip(steps, np.diag(steps), strict=True)]
        return residual(x), np.array(columns).T

    try:
        x = newton(both, np.delete(guess, m), scale=scale, tolerance=1e-10)
    except SolverError as error:
        raise DoesNotAssemble(f"chain drive: the loop does not close ({error})") from error
    return x[:m], np.append(guess[m], x[m : 2 * m - 1]), x[-1]


def _pins(loop, centre, j, angle):
    """(left, right) pin of a plate seated on sprocket j at this angle of its own."""
    arm = 0.5 * loop.link.hole_pitch
    return tuple(centre[j] + (side + 1j * loop.height[j]) * np.exp(1j * angle) for side in (-arm, arm))


def _ends(loop, seats, psi, q):
    """Per strand: right pin and angle of the last seated plate, left pin and angle of the next first one."""
    centre, phi, (first, last) = loop.centres(q), loop.phi, seats
    for j in range(len(psi)):
        n = (j + 1) % len(psi)
        off = psi[j] + last[j] * phi[j] - 0.5 * np.pi
        on = psi[n] + first[n] * phi[n] - 0.5 * np.pi - (2 * np.pi if n == 0 else 0.0)
        yield _pins(loop, centre, j, off)[1], off, _pins(loop, centre, n, on)[0], on


def _misses(loop, seats, free, beta, psi, extra):
    """By how much each strand, laid from its beginning, misses its end: (2 m,) real."""
    q, more = loop.parts(extra)
    gap, A = loop.gap, loop.link.hole_pitch + more
    misses = []
    for (pin, off, target, on), n, b in zip(_ends(loop, seats, psi, q), free, beta, strict=True):
        along = np.exp(1j * b) * (n * A - (n - 1) * gap)
        misses.append(pin - gap * (np.exp(0.5j * (off + b)) + np.exp(0.5j * (b + on))) + along - target)
    return np.concatenate([np.real(misses), np.imag(misses)])


def _poses(loop, seats, free, beta, psi, extra):
    """Pin-frame poses (N, 3) of all plates in their order, and which of them sit on each sprocket."""
    q, more = loop.parts(extra)
    centre, gap, A, (first, last) = loop.centres(q), loop.gap, loop.link.hole_pitch + more, seats
    rows, seated = [], []
    for j, (pin, off, _, _) in enumerate(_ends(loop, seats, psi, q)):
        angles = psi[j] + np.arange(first[j], last[j] - 1, -1) * loop.phi[j] - 0.5 * np.pi
        seated.append(np.arange(len(rows), len(rows) + len(angles)))
        rows += [(centre[j] + 1j * loop.height[j] * np.exp(1j * a), a) for a in angles]
        pin = pin - gap * np.exp(0.5j * (off + beta[j]))
        rows += [(pin + np.exp(1j * beta[j]) * (0.5 * A + k * (A - gap)), beta[j]) for k in range(free[j])]
    return np.array([(place.real, place.imag, angle) for place, angle in rows]), tuple(seated)


def _rates(poses, seated, centre, speed, chain_speed):
    """Rates (N, 3): seated plates turn with their sprocket, free ones move along their strand at the mean speed of the chain.

    What the sprockets' polygons would give a strand across its length at this very instant would make it swing for long.
    """
    place, rates = poses[:, 0] + 1j * poses[:, 1], np.zeros((len(poses), 3))
    for j, plates in enumerate(seated):
        velocity = 1j * speed[j] * (place[plates] - centre[j])
        rates[plates] = np.stack([velocity.real, velocity.imag, np.full(len(plates), speed[j])], axis=1)
    free = np.setdiff1d(np.arange(len(poses)), np.concatenate(seated))
    along = -np.sign(speed[0]) * chain_speed * np.exp(1j * poses[free, 2])
    rates[free, 0], rates[free, 1] = along.real, along.imag
    return rates
