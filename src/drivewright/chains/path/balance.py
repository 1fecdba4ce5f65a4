"""Tensioners and the pulls of the strands in balance, the chain as long as its links.

    links(q) = N + sum over strands of (l/p) (T + rho v^2)/(k_j p)                      the chain closes, stretched
    (T_out u_out - T_in u_in).c'(q) + F - k q + m g.c'(q) = 0                           each body on a slide; with the moment of friction
                                                                                        where a rail turns about a pivot
    T_out = T_in + M/r at a sprocket inside (- outside),  T_out = T_in exp(mu wrap) at a guide, along the way of the chain

T: pull of a strand without its centrifugal part, which presses on nothing; u: heading of a strand; c'(q): how the centre moves; M: torque
on the sprocket counter-clockwise, r = z p/(2 pi).  Unknown are all q and the pull of one strand; nothing slides at first order of the pull.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.chains.model import ChainDrive, Guide, Sprocket
from drivewright.chains.path.order import clearance, met
from drivewright.chains.path.route import Route, bodies, body_name, mean_link, route, way_at
from drivewright.errors import DoesNotAssemble, InputError, SolverError
from drivewright.numerics.roots import newton

STEP = 1e-6  # of differences, in pitches and in parts of a pull
STRIDE = 0.25  # pitches, between two places at which a tensioner is tried
FAR = 0.25  # of the chain's length, that a tensioner is tried over where its travel has no limits
HALVINGS = 40


class Balance(NamedTuple):
    """The path at rest relative to the moving chain: `Route`, places q (bodies,) [m] of all slides, pull [N] of the strand that leaves each
    station, without the centrifugal tension [N]; slack: how much longer [m] the chain is than its path where nothing tensions it."""

    route: Route
    q: Floats
    pulls: Floats
    centrifugal: float
    slack: float

    def force_on(self, place: int) -> complex:
        """Force [N] of the chain on the body at this place of the path."""
        out, into = self.pulls[place] * np.exp(1j * self.route.headings[place]), self.pulls[place - 1]
        return complex(out - into * np.exp(1j * self.route.headings[place - 1]))


def chain_speed(model: ChainDrive, speed: float | None = None) -> float:
    """Mean speed of the chain [m/s] at a speed of the driver [rad/s]; its own unless given."""
    given = model.drive.speed if speed is None else speed
    return abs(given) * model.sprockets[model.driver].tooth.teeth * model.chain.link.pitch / (2 * np.pi)


def balanced(model: ChainDrive, speed: float | None = None) -> Balance:
    """The `Balance` of a drive at a speed of the driver [rad/s] (its own unless given); DoesNotAssemble where the chain does not fit."""
    movers = [number for number, body in enumerate(bodies(model)) if body.slide]
    centrifugal = model.chain.line_density * chain_speed(model, speed) ** 2
    q = np.zeros(len(bodies(model)))
    if movers:
        q = _fitted(model, movers, q)
    found = met(model, q)
    preloaded = model.measured in movers
    _refuse_unmet(model, found, q, preloaded)
    on_path = [number for number in movers if found.place(number) is not None]
    if not on_path:
        return _held(model, found, q, centrifugal)
    try:
        return _sprung(model, found.stations, on_path, q, centrifugal)
    except DoesNotAssemble:
        if not preloaded or len(on_path) == 1:
            raise
    return _sprung(model, found.stations, [model.measured], q, centrifugal)  # the preload tightens the chain; tensioners find their place


def limit_speed(model: ChainDrive, most: float = 20.0) -> float:
    """Speed of the driver [rad/s] at which the chain's own weight in its curves has taken all pull from the slackest strand.

    inf where it does not fall to nothing below `most` times the speed of the drive: a force that does not yield, as of a preload, carries
    the chain at any speed.
    """
    own = abs(model.drive.speed)

    def pull(share):
        try:
            return float(np.min(balanced(model, share * own).pulls))
        except (DoesNotAssemble, InputError, SolverError):
            return -1.0

    if pull(0.0) <= 0:
        return 0.0
    if pull(most) > 0:
        return np.inf
    low, high = 0.0, most
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if pull(middle) > 0 else (low, middle)
    return low * own


# ------------------------------------------------------------------------------------------------------------------- the pulls


def _gains(model: ChainDrive, found: Route) -> tuple[Floats, Floats]:
    """Pulls of all strands as a T + b, T that of the strand which leaves the driver."""
    a, b, every = np.zeros(len(found.stations)), np.zeros(len(found.stations)), bodies(model)
    first = found.place(model.driver)
    assert first is not None
    a[first], pitch, along = 1.0, mean_link(model).pitch, -1.0 if model.drive.speed > 0 else 1.0
    for step in range(1, len(a)):
        k = (first + step) % len(a)
        station, body = found.stations[k], every[found.stations[k].body]
        if isinstance(body, Guide):
            gain = np.exp(along * body.friction * found.wraps[k])
            a[k], b[k] = gain * a[k - 1], gain * b[k - 1]
        else:
            radius = station.per_turn * pitch / (2 * np.pi)
            a[k], b[k] = a[k - 1], b[k - 1] - station.turn * body.torque / radius
    return a, b


def _excess(model: ChainDrive, found: Route, pulls: Floats, centrifugal: float) -> float:
    """By how many links the path is longer than the stretched chain."""
    pitch = mean_link(model).pitch
    stretch = np.sum(found.lengths * (pulls + centrifugal)) / (model.chain.joint_stiffness * pitch**2)
    return found.links - model.chain.count - float(stretch)


def _held(model, found, q, centrifugal):
    """All bodies stand still: the chain is as tense as it is stretched, or slack in its slackest strand."""
    a, b = _gains(model, found)
    tense = _excess(model, found, b, centrifugal)
    slope = _excess(model, found, a + b, centrifugal) - tense
    pull, least = -tense / slope, float(np.max(-b / a))
    slack = max(0.0, -_excess(model, found, a * least + b, centrifugal)) * mean_link(model).pitch if pull < least else 0.0
    return Balance(found, q, a * max(pull, least) + b, centrifugal, slack)


def _sprung(model, chosen, movers, q, centrifugal):
    """Newton's method for the places of all that slides and the pull of one strand."""
    pitch, every = mean_link(model).pitch, bodies(model)
    size = max(abs(every[n].slide.force) + abs(every[n].slide.stiffness * q[n]) for n in movers) or 1.0

    def misses(x):
        places = q.copy()
        places[movers] = x[:-1] * pitch
        found = route(model, chosen, places)
        a, b = _gains(model, found)
        now = Balance(found, places, a * x[-1] * size + b, centrifugal, 0.0)
        forces = [_force_along(model, now, number) / size for number in movers]
        return np.array([*forces, _excess(model, found, now.pulls, centrifugal)]), now

    def both(x):
        columns = [(misses(x + d)[0] - misses(x - d)[0]) / (2 * STEP) for d in STEP * np.eye(len(x))]
        return misses(x)[0], np.array(columns).T

    try:
        x = newton(both, np.append(q[movers] / pitch, _first_pull(model, chosen, movers[0], q) / size), tolerance=1e-11)
    except (SolverError, InputError) as error:
        raise DoesNotAssemble(f"chain drive: no equilibrium of the tensioner was found ({error})") from error
    now = misses(x)[1]
    _refuse_travel(model, now.q, movers)
    for number in movers:
        place = now.route.place(number)
        assert place is not None  # only what the chain meets moves
        pull = 0.5 * (now.pulls[place] + now.pulls[place - 1])
        if not (pull > 0 and now.route.wraps[place] >= 0):
            raise DoesNotAssemble(_slack(model, number, pull, float(now.q[number])))
    return now


def _force_along(model, now, number):
    """Force [N] on a sliding body along its slide: chain, spring and weight."""
    body, place = bodies(model)[number], now.route.place(number)
    assert body.slide is not None and place is not None
    way = way_at(body, now.q[number])
    pull = now.force_on(place) + body.mass * complex(*model.gravity) * (body.slide.pivot is None)
    turning = 0.0
    if isinstance(body, Guide) and body.slide.pivot:  # friction on its face turns it too
        turning = now.route.stations[place].turn * body.radius * (now.pulls[place] - now.pulls[place - 1]) / body.slide.lever
    return (pull * np.conj(way)).real + turning + body.slide.force - body.slide.stiffness * now.q[number]


def _first_pull(model, chosen, number, q):
    """Pull at which the first tensioner would be in balance, all strands alike."""
    found = route(model, chosen, q)
    now = Balance(found, q, np.ones(len(chosen)), 0.0, 0.0)
    body, place = bodies(model)[number], found.place(number)
    assert body.slide is not None and place is not None
    against = -(now.force_on(place) * np.conj(way_at(body, q[number]))).real
    force = body.slide.force - body.slide.stiffness * q[number]
    return force / against if abs(against) > 1e-6 else abs(force)


# ------------------------------------------------------------------------------------------------------ where the chain closes


def _fitted(model: ChainDrive, movers: Sequence[int], q: Floats) -> Floats:
    """Places at which the path has as many links as the chain, by moving one of what slides: the driven sprocket where it does."""
    number = model.measured if model.measured in movers else movers[0]
    body, pitch = bodies(model)[number], mean_link(model).pitch
    assert body.slide is not None
    low, high = body.slide.travel
    far = FAR * model.chain.count * pitch

    def excess(place):
        places = q.copy()
        places[number] = place
        return met(model, places).links - model.chain.count

    start = min(max(0.0, low), high)
    first = excess(start)
    onward = -1.0 if first > 0 else 1.0  # outward makes the path longer
    end = max(low, start - far) if first > 0 else min(high, start + far)
    before, tried = start, first
    while abs(before - end) > 1e-12 * pitch:
        here = before + onward * min(STRIDE * pitch, abs(end - before))
        found = _tried(excess, here)
        if found is None:
            break
        if found * first <= 0:
            q[number] = _root(excess, before, here)
            return q
        before, tried = here, found
    q[number] = before
    if tried < 0 and (tried < first or met(model, q).place(number) is None):  # outward it makes the path no longer
        raise DoesNotAssemble(_to_no_effect(model, q, number, -tried))
    raise DoesNotAssemble(_misfit(model, number, tried, before))


def _tried(excess, place):
    try:
        return excess(place)
    except InputError:  # bodies overlap there
        return None


def _root(excess, before, here):
    """Where the excess changes its sign, by bisection: a path may take on another body on the way."""
    sign = np.sign(excess(before))
    for _ in range(HALVINGS):
        middle = 0.5 * (before + here)
        before, here = (middle, here) if np.sign(excess(middle)) == sign else (before, middle)
    return 0.5 * (before + here)


# -------------------------------------------------------------------------------------------------------------------- refusals


def _misfit(model, number, excess, place):
    """What to say of a chain that does not fit at the last place that was tried."""
    count, links, name = model.chain.count, abs(excess), body_name(model, number)
    longer, more = ("short", "more") if excess > 0 else ("long", "fewer")
    change = int(np.ceil(links))
    change += (count + change) % 2
    return (
        f"chain drive: {count} links are {_links(model, links)} too {longer}: {name} moves by {1e3 * place:.4g} mm, where the path "
        f"needs {count + excess:.4g} links. Take {change} {more} links, give it more travel, or move its centre. (An even number of links "
        "needs no offset link.)"
    )


def _to_no_effect(model, q, number, links):
    """What to say of a tensioner that does not tighten the chain: at the end of its travel, which is at q, or on its way there."""
    body, name = bodies(model)[number], body_name(model, number)
    inside = not body.outside if isinstance(body, Sprocket) else body.side == "inside"
    lies, other = ("inside", "outside") if inside else ("outside", "inside")
    if met(model, q).place(number) is None:
        what = (
            f"does not touch the chain: it lies {lies} the loop, and {1e3 * q[number]:.4g} mm along its direction the nearest strand "
            f"passes {1e3 * clearance(model, q, number):.4g} mm away"
        )
    else:
        what = f"does not tighten the chain: it lies {lies} the loop, and its direction leads it away from the strand that it touches"
    return (
        f"chain drive: {name} {what}. The {model.chain.count} links remain {_links(model, links)} too long. Move its centre towards the "
        f"strand, turn its direction towards the strand, or take side = {other!r}."
    )


def _links(model, links):
    return f"{links:.3g} links ({1e3 * links * mean_link(model).pitch:.4g} mm)"


def _refuse_unmet(model, found, q, preloaded):
    """DoesNotAssemble for a sprocket, or a tensioner that has to tighten the chain, which it does not reach."""
    for number, body in enumerate(bodies(model)):
        if found.place(number) is not None or (isinstance(body, Guide) and (preloaded or not body.slide)):
            continue
        away = clearance(model, q, number)
        raise DoesNotAssemble(
            f"chain drive: the chain does not reach {body_name(model, number)}: the nearest strand passes {1e3 * away:.4g} mm away. "
            "Move its centre towards the chain, or change the side of the loop on which it lies."
        )


def _refuse_travel(model, q, movers):
    for number in movers:
        slide = bodies(model)[number].slide
        low, high = slide.travel
        if not low - 1e-9 <= q[number] <= high + 1e-9:
            raise DoesNotAssemble(
                f"chain drive: {body_name(model, number)} is in equilibrium at a travel of {1e3 * q[number]:.4g} mm, which is limited to "
                f"{1e3 * low:.4g} to {1e3 * high:.4g} mm. Give it more travel, change its force, or change the number of links."
            )


def _slack(model, number, pull, q):
    slide = bodies(model)[number].slide
    if slide.force > 0 >= slide.force - slide.stiffness * q:
        return (
            f"chain drive: the spring of {body_name(model, number)} has no force left at the travel of {1e3 * q:.4g} mm where the chain is "
            "taut. Increase its force, reduce its stiffness, move its centre towards the chain, or reduce the number of links."
        )
    return (
        f"chain drive: the slide of {body_name(model, number)} leaves the chain slack (a tension of {float(pull):.3g} N); "
        "point its direction outward and its force along it."
    )
