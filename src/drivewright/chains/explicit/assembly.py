"""The start of a run: seated plates on the sprockets' polygons, free strands between them, all moving as if rigid.

A chain around two sprockets, one of them on a slide, needs no more than its loop; with further sprockets, guides or a fixed centre distance
the path and the pulls of its strands come from `path`, tensioners in balance, and the polygon closes around that.
"""

from dataclasses import dataclass

import numpy as np

from drivewright._typing import Floats, Ints
from drivewright.chains.explicit.polygon import Bend, Closed, Polygon, closed, poses, seats
from drivewright.chains.link import seat_height
from drivewright.chains.model import ChainDrive
from drivewright.chains.path.balance import Balance, balanced, chain_speed
from drivewright.chains.path.route import bodies, centre_at, mean_link
from drivewright.chains.roller_tooth import RollerTooth
from drivewright.errors import DoesNotAssemble, InputError

TIGHT = 2e-3  # part of its length by which a chain may miss a loop that nothing adjusts


@dataclass(frozen=True)
class Start:
    """Poses and rates of the plates (N, 3) from the first one seated on sprocket 1; q and psi (m,) of the sprockets with their rates.

    hole_pitches (N,) with which the loop closes, supports (m,) of teeth that these plates just touch; speed of the chain along x of its
    plates; tension, the least of the strands; guide_q: places of the guides on their slides.
    """

    poses: Floats
    rates: Floats
    q: Floats
    psi: Floats
    rate_q: Floats
    rate_psi: Floats
    seated: tuple[Ints, ...]  # numbers of the plates on each sprocket
    tension: float
    hole_pitches: Floats
    supports: Floats
    speed: float
    guide_q: Floats


@dataclass(frozen=True)
class Laid:
    """A polygon before it is closed, sprockets of the model in its order, places of all bodies, least tension of a strand."""

    loop: Polygon
    order: Ints
    q: Floats
    tension: float


def start(model: ChainDrive, before: float = 0.0) -> Start:
    """The `Start` of a model, `before` [s] ahead of sprocket 1 being at its angle; DoesNotAssemble where the chain fits at no place of the
    slide."""
    _refuse_rollers(model)
    laid, speed = _laid(model), _speeds(model)
    angle = model.sprockets[0].angle
    taken, guess = seats(laid.loop, model.chain.count, (angle if angle is not None else 0.0) - before * speed[0])
    return _started(model, laid, speed, taken, closed(laid.loop, taken, guess))


def _started(model: ChainDrive, laid: Laid, speed: Floats, taken, found: Closed) -> Start:
    loop, count = laid.loop, len(model.sprockets)
    place, more = loop.parts(found.extra)
    plates, sat = poses(loop, taken, found)
    if loop.slide is not None:
        laid.q[laid.order[loop.slide]] = place
    back = np.argsort(laid.order)  # from the order of the path to that of the model
    seated, psi = tuple(sat[k] for k in back), found.psi[back]
    centre, chain = loop.centres(place)[back], chain_speed(model, abs(speed[model.driver]))
    pitches = np.full(len(plates), loop.link.hole_pitch + more)
    pitches[np.concatenate(seated)] = loop.link.hole_pitch
    supports = loop.link.flank_support - loop.height[back] * np.sin(loop.link.flank_angle)
    rates = _rates(plates, seated, centre, speed, chain)
    q, still = laid.q[:count], np.zeros(count)
    along = -np.sign(speed[0]) * chain
    return Start(plates, rates, q, psi, still, speed, seated, laid.tension, pitches, supports, along, laid.q[count:])


def _laid(model):
    simple = len(model.sprockets) == 2 and not model.guides and any(s.slide and not s.slide.pivot for s in model.sprockets)
    return _pair(model) if simple else _around(model)


def _refuse_rollers(model):
    radius = model.chain.link.radius
    if any(isinstance(s.tooth, RollerTooth) for s in model.sprockets) and radius != 0:
        raise InputError(f"chain drive: roller teeth need a chain with revolute joints; its rolling radius is {radius:g} m instead of 0.")


# ----------------------------------------------------------------------------------------------- around any number of bodies


def _around(model: ChainDrive) -> Laid:
    """The polygon along the path in balance."""
    balance = balanced(model, _first_speed(model))
    _refuse_misfit(model, balance)
    return laid_along(model, balance)


def laid_along(model: ChainDrive, balance: Balance) -> Laid:
    """The polygon along a path."""
    found, count, link = balance.route, len(model.sprockets), mean_link(model)
    places = [k for k, station in enumerate(found.stations) if station.body < count]
    order = np.array([found.stations[k].body for k in places])
    tension = np.maximum(balance.pulls[places] + balance.centrifugal, 0.0)
    moving = next((j for j, body in enumerate(order) if model.sprockets[body].slide), None)
    wheel = model.sprockets[order[moving]] if moving is not None else model.sprockets[0]
    loop = Polygon(
        link,
        np.array([model.sprockets[body].tooth.teeth for body in order]),
        np.array([seat_height(link, model.sprockets[body].tooth.teeth) for body in order]),
        np.array([found.stations[k].turn for k in places]),
        np.array([centre_at(model.sprockets[body], balance.q[body]) for body in order]),
        moving,
        lambda q: centre_at(wheel, q),
        float(balance.q[order[moving]]) if moving is not None else 0.0,
        2 * link.radius - tension / model.chain.joint_stiffness,
        *_strands(found, places, link.pitch),
    )
    least = float(np.min(np.maximum(balance.pulls, 0.0))) + balance.centrifugal
    return Laid(loop, order, balance.q.copy(), least)


def _strands(found, places, pitch):
    """(beta, arrival, length, bends) of the strands between sprockets at these places of a path; guides on the way are bends of theirs.

    Headings fall and rise on from the first strand's: unlike angles they know of whole turns.
    """
    beta, arrival, length, bends = [], [], [], []
    heading, ends = float(found.headings[0]), [*places[1:], len(found.stations)]
    heading -= found.stations[0].turn * found.wraps[0]
    for first, end in zip(places, ends, strict=True):
        arrival.append(heading)
        heading += found.stations[first].turn * found.wraps[first]
        beta.append(heading)
        along, own = float(found.lengths[first]), []
        for k in range(first + 1, end):
            station, wrap = found.stations[k], float(found.wraps[k])
            arc = station.per_turn * wrap / (2 * np.pi) * pitch
            own.append(Bend(along, arc / wrap if wrap else station.radius, station.turn, wrap))
            along += arc + float(found.lengths[k])
            heading += station.turn * wrap
        length.append(along)
        bends.append(tuple(own))
    return np.array(beta), np.array(arrival), np.array(length), tuple(bends)


def _refuse_misfit(model, balance: Balance):
    """DoesNotAssemble where nothing takes up what the chain is too long or too short by."""
    links, count = balance.route.links, model.chain.count
    taken_up = any(body.slide and balance.route.place(n) is not None for n, body in enumerate(bodies(model)))
    if not taken_up and abs(links / count - 1) > TIGHT:
        raise DoesNotAssemble(
            f"chain drive: the loop around the sprockets needs {links:.4g} pitches, the chain has {count}: it is "
            f"{1e3 * abs(links - count) * mean_link(model).pitch:.4g} mm too {'short' if links > count else 'long'}. "
            "Move a sprocket, give one a slide, add a tensioner, or change the number of links."
        )


# ---------------------------------------------------------------------------------------------- two sprockets, one of them sliding


def _pair(model: ChainDrive) -> Laid:
    """The polygon of two sprockets at the place of the slide at which the chain fits, tense by the slide's force."""
    link = mean_link(model)
    teeth = np.array([s.tooth.teeth for s in model.sprockets])
    height = np.array([seat_height(link, z) for z in teeth])
    slide = next(n for n, s in enumerate(model.sprockets) if s.slide)
    wheel = model.sprockets[slide]
    loop = Polygon(
        link,
        teeth,
        height,
        np.array([-1, -1]),
        np.array([complex(*s.centre) for s in model.sprockets]),
        slide,
        lambda q: centre_at(wheel, q),
        0.0,
        np.full(2, 2 * link.radius),
        np.zeros(2),
        np.zeros(2),
        np.zeros(2),
        ((), ()),
    )
    q = _slid(loop, model.chain.count)
    tension = _tension(model, loop, q)
    beta, length = _tangents(loop, q)
    gap = np.full(2, 2 * link.radius - tension / model.chain.joint_stiffness)
    arrival = np.append(beta[-1] + 2 * np.pi, beta[:-1])
    return Laid(loop._replace(place=q, gap=gap, beta=beta, arrival=arrival, length=length), np.arange(2), np.zeros(2), tension)


def _tangents(loop, q):
    """Directions beta_j of the outer common tangents, falling from one to the next, and their lengths."""
    centre = loop.centres(q)
    gap, other = np.roll(centre, -1) - centre, np.roll(loop.height, -1) - loop.height
    if np.any(np.abs(gap) <= np.abs(other)):
        raise DoesNotAssemble(
            f"chain drive: sprocket {np.argmax(np.abs(gap) <= np.abs(other)) + 1} and the next one overlap; move them apart."
        )
    beta = np.unwrap(np.angle(gap) + np.arcsin(other / np.abs(gap)))
    beta = beta[0] - np.concatenate([[0.0], np.cumsum((beta[:-1] - beta[1:]) % (2 * np.pi))])
    return beta, np.sqrt(np.abs(gap) ** 2 - other**2)


def _links(loop, q):
    """Pitches that the loop takes."""
    beta, length = _tangents(loop, q)
    wraps = np.append(beta[-1] + 2 * np.pi - beta[0], beta[:-1] - beta[1:])
    return np.sum(length) / loop.link.pitch + np.sum(wraps / loop.phi)


def _slid(loop, count):
    """Place of the slide at which the loop takes `count` pitches."""
    q, step = 0.0, 1e-7 * loop.link.pitch
    for _ in range(50):
        excess = _links(loop, q) - count
        slope = (_links(loop, q + step) - _links(loop, q)) / step
        if abs(excess) < 1e-9:
            return q
        if abs(slope) < 1e-6 / loop.link.pitch:
            break
        q -= np.clip(excess / slope, -5 * loop.link.pitch, 5 * loop.link.pitch)
    raise DoesNotAssemble(
        f"chain drive: the loop around the sprockets needs {_links(loop, 0.0):.4g} pitches, the chain has {count}. "
        "Move a sprocket, give one a slide, or change the number of links."
    )


def _tension(model, loop, q):
    """Tension that balances the slide's force, with the centrifugal one rho v^2."""
    centrifugal = model.chain.line_density * chain_speed(model, _first_speed(model)) ** 2
    slide, beta = model.sprockets[loop.slide].slide, _tangents(loop, q)[0]
    pull = np.exp(1j * beta[loop.slide]) - np.exp(1j * beta[loop.slide - 1])
    inward = -(pull * np.exp(-1j * slide.direction)).real
    tension = (slide.force - slide.stiffness * q) / inward if inward > 1e-6 else -1.0
    if not tension > 0:
        raise InputError(
            f"chain drive: the slide of sprocket {loop.slide + 1} leaves the chain slack (tension {tension:.3g} N); "
            "point its direction outward and its force along it."
        )
    return tension + centrifugal


# ------------------------------------------------------------------------------------------------------------------ how it moves


def _first_speed(model):
    """Speed of the driver at the start."""
    return model.drive.start if model.drive.ramp > 0 else model.drive.speed


def _speeds(model):
    """Speed of every sprocket at the start: as the first drive's teeth ask; those outside turn the other way."""
    teeth = np.array([s.tooth.teeth for s in model.sprockets])
    return _first_speed(model) * teeth[model.driver] / teeth * np.where([s.outside for s in model.sprockets], -1.0, 1.0)


def _rates(poses, seated, centre, speed, chain_speed):
    """Rates (N, 3): seated plates turn with their sprocket, free ones move along their own line at the mean speed of the chain.

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
