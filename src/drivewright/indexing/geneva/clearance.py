"""What the clearance of the pin in its slot does: the pin enters late and with a jump of the wheel's speed, and crosses the slot half-way.

A wheel that waits at -beta is touched by a pin on its forward side at once that
    C sin(beta) + a sin(theta - beta) = s/2,        s the clearance across the slot;
from then on it is carried with  phi = psi - asin(s/(2 rho)).  Its speed jumps to phi' omega there.  Half-way the pin slows down more than
the wheel, which moves on freely until its other side meets the pin.
"""

from typing import NamedTuple

import numpy as np

from drivewright.indexing.geneva.step import GenevaStep
from drivewright.numerics.roots import roots_in_brackets

FREE = 1.2  # rad of the crank within which a crossing ends


class Entry(NamedTuple):
    """Crank angle [rad] of the first contact; angle [rad] of the pin's path from the side of the slot there; speed of the pin against that
    side [m/s] and jump of the wheel's speed [rad/s] at the crank speed; gap [m] by which the pin misses the slot, 0 where it fits in."""

    angle: float
    path_angle: float
    normal_speed: float
    speed_jump: float
    miss: float


class Crossing(NamedTuple):
    """Crank angle [rad] at which the pin has crossed the slot, and the speed [m/s] at which it meets the other side."""

    angle: float
    speed: float


def entry(step: GenevaStep, clearance: float, speed: float) -> Entry:
    """The `Entry` of a pin with a clearance across the slot [m] at a speed of the crank [rad/s].

    A pin that is too far out for the slot pushes its tip aside: it has the entry of one that just passes, and a `miss`.
    """
    aside = (clearance / 2 - step.fitting_radius) / step.crank_radius  # sin(theta - beta)
    theta = float(np.arcsin(np.clip(aside, -1.0, 1.0))) + step.half_pitch
    path_angle = theta + np.pi / 2 - step.half_pitch
    normal = step.crank_radius * speed * float(np.sin(path_angle))
    miss = max(0.0, abs(step.excess) - clearance / 2)
    return Entry(theta, path_angle, normal, normal / float(step.pin_distance(theta)), miss)


def crossing(step: GenevaStep, clearance: float, speed: float, bend: float) -> Crossing:
    """The `Crossing` of a wheel that moves freely with the second derivative `bend` by the crank angle [rad/rad^2]: -T/(J w^2) of the
    torque that resists it.

    It begins where the pin would have to hold the wheel back, psi'' = bend.  The way is rho (psi - phi), both of equal speed at first.
    """
    if clearance <= 0:
        return Crossing(0.0, 0.0)
    start = _release(step, bend)
    psi = step.pin_direction(start)

    def gap(theta):
        """How far the pin is from the side that it left [m], and how fast it goes away from it by the crank angle [m/rad]."""
        now, ahead = step.pin_direction(theta), theta - start
        free = psi.d0 + psi.d1 * ahead + bend * ahead**2 / 2
        rate = psi.d1 + bend * ahead
        distance = step.pin_distance(theta)
        return distance * (free - now.d0), distance * (rate - now.d1) + step.pin_travel_rate(theta) * (free - now.d0)

    end = min(start + FREE, step.half_engagement)
    if gap(end)[0] < clearance:  # the pin leaves the slot before it has crossed it
        return Crossing(float(end), 0.0)
    at = _root(lambda theta: gap(theta)[0] - clearance, start, end)
    return Crossing(at, float(gap(at)[1]) * speed)


def _root(f, low, high):
    """The root of f between two ends at which it has different signs."""
    ends = np.array([low]), np.array([high])
    return float(roots_in_brackets(f, *ends, *(np.asarray(f(end)) for end in ends))[0])


def _release(step, bend):
    """Crank angle [rad] at which psi'' falls below the bend that the wheel takes by itself; the end of the step where it does not."""
    low, high = -step.largest_bend_angle, step.largest_bend_angle
    if step.pin_direction(high).d2 >= bend:
        return high
    if step.pin_direction(low).d2 <= bend:
        return low
    return _root(lambda theta: step.pin_direction(theta).d2 - bend, low, high)
