"""Singular positions: where loops fold and lose rank, and the chart that leads through along the smooth branch.

In a singular position several branches of the motion meet.  Along each of them the dependent coordinates are smooth functions of the
independent ones and of time, though the equations that close the loops do not determine them there.  Before such a place a straight line
of states is laid through it, the branch on which the mechanism comes is continued over it by a polynomial, and Newton's method closes the
loops at nodes on both sides.  That the polynomial also closes the loops in between, in the singular position itself, proves that the
branch goes through; where two branches only come near each other it does not, and the motion follows the bend of its own.
"""

from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats, Ints
from drivewright.multibody.chart import solve_kinematics
from drivewright.multibody.partition import evaluate_at, partition_into, scaled_jacobian, scaled_residuals
from drivewright.multibody.system import Chart, System, Work, memory_size, motion
from drivewright.numerics.linear import pivot_order

NODES = np.array([-1.0, -0.85, -0.7, -0.55, 0.55, 0.7, 0.85, 1.0])  # of a chart, in parts of its half width
WIDTHS = 0.12 * 0.5 ** np.arange(6)  # half widths to try [rad], [lengths of the mechanism]
REACH = 0.95  # part of the half width in which a chart serves
BACK = 0.01  # step back along the line by which the way to the singular position is estimated [rad], [lengths]
NEAR = 1e-4  # ... and by which it is estimated how far that is, whichever way
CLOSED = 1e-10  # largest miss of the loops between the nodes [rad], [lengths]
LINEAR, HALFWAY = 0.05, np.array([0.15, 0.3])  # places between a singular start and the nodes: the first ones by the rates alone
SAME = 1e-5  # difference of rates, per unit of x, within which a branch has the rates that are asked for
ASTRAY = 0.1  # correction of a guess, over the half width, that may lead to another branch
FOLDED = 1e-6  # singular value over the largest that counts as zero in a singular position


class Line(NamedTuple):
    """States z + x direction at t + x pace, x counting in radians, or lengths of the mechanism, of the fastest coordinate in loops."""

    system: System
    work: Work
    t: float
    y: Floats
    direction: Floats
    pace: float

    @property
    def independent(self) -> Ints:
        """Where the independent coordinates are in the state."""
        return np.searchsorted(self.system.stored, self.system.independent)

    @property
    def dependent(self) -> Ints:
        """Where the dependent coordinates are in the state."""
        return np.searchsorted(self.system.stored, self.system.dependent)

    def close(self, x: float, guess: Floats, shift: float | Floats = 0.0, delay: float = 0.0) -> "Place":
        """`Place` at x, the loops closed from a guess of the dependent coordinates; z shifted, time delayed."""
        y = self.y.copy()
        y[self.independent] += x * self.direction + shift
        y[self.dependent] = guess
        closed = solve_kinematics(self.system, self.work, self.t + x * self.pace + delay, y)
        dependent = self.work.coordinates.q[self.system.dependent]
        miss = np.max(np.abs(dependent - guess) / self.system.sizes[self.system.dependent], initial=0.0)
        values = np.linalg.svd(scaled_jacobian(self.system, self.work, self.system.stored), compute_uv=False) if closed else np.ones(1)
        return Place(x, dependent.copy(), miss if closed else np.inf, float(values[-1] / values[0]))


class Place(NamedTuple):
    """A point of a line: dependent coordinates, how far the guess was from them, smallest singular value over the largest."""

    x: float
    dependent: Floats
    correction: float
    smallest: float


class Outlook(NamedTuple):
    """`charted`: (system with a chart, state) where a singular position is near enough to be charted, else None; `time` [s] until one,
    estimated from how the smallest singular value falls, infinite where it does not."""

    charted: tuple[System, Floats] | None
    time: float


def look_ahead(system: System, t: float, y: Floats) -> Outlook:
    """The `Outlook` of the motion from a state on."""
    line = _line(system, t, y)
    if line is None:
        return Outlook(None, np.inf)
    behind = _behind(line)
    ahead = _way_ahead(behind)
    for width in WIDTHS[ahead < REACH * WIDTHS]:
        nodes = _nodes(line, behind, ahead, width)
        if nodes is not None and _closes_between(line, nodes):
            centre = _centre(line, nodes)
            if _fold(line, nodes, centre) < FOLDED:
                return Outlook(_charted(line, nodes, centre, width), ahead * line.pace)
    return Outlook(None, ahead * line.pace)


def distance_to_singularity(system: System, t: float, y: Floats) -> float:
    """How far a state is from a singular position [rad], [lengths of the mechanism], whichever independent coordinate moves and whichever
    way, estimated from how the smallest singular value changes; infinite where it does not."""
    first, nearest = len(system.stored), np.inf
    for m, k in enumerate(system.independent):
        changed = y.copy()
        changed[first : first + len(system.independent)] = 0.0
        changed[first + m] = system.sizes[k]
        line = _line(system, t, changed)
        if line is not None:
            here, before = _behind(line, 1, NEAR)
            change = abs(before.smallest - here.smallest) if np.isfinite(before.correction) else here.smallest
            nearest = min(nearest, NEAR * here.smallest / change if change > 0 else np.inf)
    return nearest


def _line(system, t, y):
    """The `Line` along the motion of a state, the coordinates split by its tangent; None where the loops are at rest."""
    moving = motion(system)
    if not solve_kinematics(moving.system, moving.work, t, y):
        return None
    rates = moving.work.coordinates.v.copy()
    speed = _speed(system, moving.work.coordinates.q, rates)
    if speed == 0.0:
        return None
    fresh = partition_into(system, _dependent(system, moving.work), moving.work)
    remembered = y[len(system.stored) + len(system.independent) :]
    state = np.concatenate([moving.work.coordinates.q[fresh.stored], rates[fresh.independent], remembered])
    return Line(fresh, motion(fresh).work, t, state, rates[fresh.independent] / speed, 1.0 / speed)


def _speed(system, q, v):
    """Rate of the fastest coordinate in loops, 0 without them."""
    return float(np.max(np.abs(v / system.sizes)[_looped(system, q)], initial=0.0))


def _looped(system, q):
    """Which coordinates the loops know of; of others they have no derivatives, wherever the bodies are."""
    columns = [scaled_jacobian(system, evaluate_at(system, place), np.arange(len(q))) for place in (q, q + 0.3 * system.sizes)]
    return np.max(np.abs(columns), axis=(0, 1), initial=0.0) > 1e-12


def _dependent(system, work):
    """The coordinates that follow best: those in which the tangent of the motion is small, for the Jacobian says nothing in a fold."""
    free = len(system.independent)
    if not free:
        return system.dependent
    tangent = np.linalg.svd(scaled_jacobian(system, work, system.stored))[2][-free:]
    pivots = pivot_order(tangent)
    return np.sort(system.stored[pivots[free:]])


def _behind(line, count=2, step=BACK):
    """Places of the line at the state itself and so many on the way to it."""
    here = line.close(0.0, line.y[line.dependent])
    rates = line.work.coordinates.v[line.system.dependent] * line.pace
    places = [here]
    for k in range(1, count + 1):
        places.append(line.close(-k * step, _carried(places, -k * step) if k > 1 else here.dependent - step * rates))
    return places


def _way_ahead(behind):
    """x at which the smallest singular value, on its straight way, is zero; infinite where it does not fall."""
    here, before = behind[0].smallest, behind[1].smallest
    return BACK * here / (before - here) if before > here and all(np.isfinite(p.correction) for p in behind) else np.inf


def _carried(places, x, most=5):
    """Dependent coordinates at x by the polynomial through the nearest places."""
    near = sorted(places, key=lambda place: abs(place.x - x))[:most]
    at_x = np.array([place.x for place in near])
    return _weights(at_x, x) @ np.array([place.dependent for place in near])


def _weights(nodes, x):
    """Lagrange's polynomials of the nodes at x."""
    differences = nodes[:, None] - nodes + np.eye(len(nodes))
    away = np.where(np.eye(len(nodes), dtype=bool), 1.0, x - nodes)
    return np.prod(away / differences, axis=1)


def chart_through(system: System, q: Floats, v: Floats) -> System | None:
    """The system with a chart through the singular position at the coordinates q, along the branch with the rates v; None where there is
    none.  Nothing but its rates tells it from the other branches there; of several freedoms of the loops it is not known what the others
    do."""
    inside, speed = system.stored[_looped(system, q)[system.stored]], _speed(system, q, v)
    free = len(system.independent) - (len(system.stored) - len(inside))
    if free > 1 or speed == 0.0:
        return None
    dependent = np.setdiff1d(inside, inside[np.argsort(-np.abs(v / system.sizes)[inside])[:free]])
    fresh = partition_into(system, dependent, evaluate_at(system, q))
    state = np.concatenate([q[fresh.stored], v[fresh.independent], np.zeros(memory_size(system))])
    line = Line(fresh, motion(fresh).work, 0.0, state, v[fresh.independent] / speed, 1.0 / speed)
    here, slope = Place(0.0, q[dependent], 0.0, 0.0), v[dependent] / speed
    for width in WIDTHS:
        beside = [line.close(x, here.dependent + x * slope) for x in (-LINEAR * width, LINEAR * width)]
        nodes = _outward(line, [here, *beside], width * np.concatenate([-HALFWAY, HALFWAY, NODES]), width)
        if nodes is None or max(place.correction for place in beside) > ASTRAY * LINEAR * width:
            continue
        nodes = sorted(place for place in nodes if abs(place.x) > np.max(HALFWAY) * width)
        if _closes_between(line, nodes) and np.allclose(_slope(nodes, width), slope, rtol=0.0, atol=SAME * np.max(system.sizes[dependent])):
            return _charted(line, nodes, 0.0, width)[0]
    return None


def _slope(nodes, width):
    """d(dependent)/dx at x = 0 by the polynomial through the nodes."""
    step = 1e-3 * width
    return (_carried(nodes, step, len(nodes)) - _carried(nodes, -step, len(nodes))) / (2 * step)


def _outward(line, known, offsets, width):
    """Places of the line at offsets, closed one after another, the nearest first, from those already known; None where the branch is
    lost."""
    places = []
    for x in sorted(offsets, key=abs):
        place = line.close(x, _carried([*known, *places], x))
        if not place.correction < ASTRAY * width:
            return None
        places.append(place)
    return places


def _nodes(line, behind, ahead, width):
    """Places of the nodes about x = ahead, closed one after another from this side to the other; None where the branch is lost."""
    outward = _outward(line, behind, ahead + width * NODES, width)
    if outward is None:
        return None
    nodes = sorted(outward)
    centre = _centre(line, nodes)
    if abs(centre - ahead) <= 0.02 * width:
        return nodes
    again = [line.close(x, _carried(nodes, x, len(nodes))) for x in centre + width * NODES]
    return again if max(place.correction for place in again) < ASTRAY * width else None


def _centre(line, nodes):
    """x of the singular position, where the smallest singular value is zero: branches that cross, it falls evenly; where they touch, as a
    square."""
    candidates = [_crossing(nodes, power) for power in (1.0, 0.5)]
    return min(candidates, key=lambda x: _fold(line, nodes, x))


def _crossing(nodes, power):
    """x where that power of the smallest singular value, counted negative beyond, is zero."""
    x = np.array([place.x for place in nodes])
    beyond = np.where(np.arange(len(nodes)) < len(nodes) // 2, 1.0, -1.0)
    signed = np.array([place.smallest for place in nodes]) ** power * beyond
    low, high = x[len(x) // 2 - 1], x[len(x) // 2]
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if _weights(x, middle) @ signed > 0 else (low, middle)
    return float((low + high) / 2)


def _closes_between(line, nodes):
    """Whether the polynomial through the nodes closes the loops between them too."""
    low, high = nodes[len(nodes) // 2 - 1].x, nodes[len(nodes) // 2].x
    return all(_miss(line, x, _carried(nodes, x, len(nodes))) < CLOSED for x in np.linspace(low, high, 5))


def _coordinates(line, x, dependent):
    """All coordinates at x of the line."""
    q = np.zeros(len(line.system.sizes))
    q[line.system.independent] = line.y[line.independent] + x * line.direction
    q[line.system.dependent] = dependent
    return q


def _fold(line, nodes, x):
    """Smallest singular value over the largest on the polynomial through the nodes, at x."""
    work = evaluate_at(line.system, _coordinates(line, x, _carried(nodes, x, len(nodes))), line.t + x * line.pace)
    values = np.linalg.svd(scaled_jacobian(line.system, work, line.system.stored), compute_uv=False)
    return float(values[-1] / values[0])


def _miss(line, x, dependent):
    work = evaluate_at(line.system, _coordinates(line, x, dependent), line.t + x * line.pace)
    return float(np.max(np.abs(scaled_residuals(line.system, work))))


def _charted(line, nodes, centre, width):
    """(system with the chart, state)."""
    normal, normal_time = _normal(line, nodes, width)
    chart = Chart(
        offsets=np.array([place.x - centre for place in nodes]),
        guesses=np.array([place.dependent for place in nodes]),
        direction=line.direction,
        normal=normal,
        origin=line.y[line.independent] + centre * line.direction,
        pace=line.pace,
        normal_time=normal_time,
        origin_time=line.t + centre * line.pace,
        reach=REACH * width,
    )
    return line.system._replace(chart=chart), line.y


def _normal(line, nodes, width):
    """(normal, normal_time): the gradient of x in the independent coordinates and in time, from that of the smallest singular value."""
    free, driven = len(line.system.independent), len(line.system.driven)
    if free == 0 or (free == 1 and driven == 0):
        return 1.0 / line.direction, 0.0 if free else 1.0 / line.pace
    base = nodes[len(nodes) // 2 - 1]
    step = 0.05 * width

    def slope(**change):
        one, other = (line.close(base.x, base.dependent, **{k: sign * v for k, v in change.items()}).smallest for sign in (1.0, -1.0))
        return one - other

    sizes = line.system.sizes[line.system.independent]
    gradient = np.array([slope(shift=step * size * unit) / (2 * step * size) for size, unit in zip(sizes, np.eye(free), strict=True)])
    in_time = slope(delay=step * line.pace) / (2 * step * line.pace) if driven else 0.0
    along = gradient @ line.direction + in_time * line.pace
    return gradient / along, float(in_time / along)
