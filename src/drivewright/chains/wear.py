"""Elongation of a chain by wear of its hinges, by Archard's law.

A joint turns whenever it comes onto a sprocket or off it, by the angle 2 pi/z of a tooth, under the force of the strand that it comes from
or goes to; the pin slides in its bush by that angle times its radius.  Every body on the path bends the chain so, tensioners and guides
too: a joint turns by the angle a between two plates that lie on the body, or by the wrap w where that is less.  (The joints on the body
share its wrap: each bends from 0 to b and back while w/a + 1 pitches pass, so that they sum up to b max(w/a, 1) = w, b = min(w, a).)  The
volume worn off pin and bush together lets the bush move
along the force by the volume over the projected area d L: two circles of one diameter d that move apart by h leave a lune of h d.

Pins that roll on each other do not slide: Archard's law knows no wear of theirs.
"""

from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats, Numbers
from drivewright.chains.path import Balance
from drivewright.contact.wear import extrapolate_wear, wear_volume

TOOTH_RULE = 2.0  # elongation at which a worn chain climbs the teeth, times the teeth of the larger sprocket: 200/z %, recalled


class Articulation(NamedTuple):
    """One turn of a joint: angle [rad], force of the strand that bends there [N]."""

    angle: float
    force: float


class JointWear(NamedTuple):
    """Wear of a joint in a revolution of the chain: sliding of the pin [m]; depths (n,) along the chain, one for each wear coefficient
    [m]; turn_time of the revolution [s]."""

    sliding: float
    depths: Floats
    turn_time: float

    def elongation(self, time: float, pitch: float) -> Floats:
        """Elongations (n,) of the chain after a running time [s], relative to its pitch [m]."""
        return np.asarray(elongation(pitch, self.depths, time / self.turn_time))


def articulations(teeth: tuple[int, int], tight: float, slack: float) -> tuple[Articulation, ...]:
    """Those of a joint in a revolution of the chain around two sprockets: tight strand onto the driver and slack off it, slack onto the
    driven sprocket and tight off it; whole forces of the strands, centrifugal ones included [N]; a strand that sags pulls with none."""
    driver, driven = (2 * np.pi / z for z in teeth)
    pulls = np.maximum((tight, slack, slack, tight), 0.0)
    return tuple(Articulation(angle, float(force)) for angle, force in zip((driver, driver, driven, driven), pulls, strict=True))


def path_articulations(balance: Balance) -> tuple[Articulation, ...]:
    """Those of a joint in a revolution of the chain along a path: onto each body under the force of the strand that comes to it, off it
    under that of the strand that leaves it; by min(wrap, 2 pi/z), of a guide min(wrap, 2 atan(p/(2 R)))  [rad].

    Whole forces, the centrifugal one included [N]; a strand that sags pulls with none.
    """
    route, pulls = balance.route, np.maximum(balance.pulls + balance.centrifugal, 0.0)
    found = []
    for place, (station, wrap) in enumerate(zip(route.stations, route.wraps, strict=True)):
        angle = float(np.clip(wrap, 0.0, 2 * np.pi / station.per_turn))
        found += [Articulation(angle, float(pulls[place - 1])), Articulation(angle, float(pulls[place]))]
    return tuple(found)


def sliding_per_revolution(pin_diameter: float, turns: tuple[Articulation, ...]) -> float:
    """Length that a pin slides in its bush in a revolution of the chain, d/2 times the sum of the angles  [m]."""
    return 0.5 * pin_diameter * sum(turn.angle for turn in turns)


def joint_wear(coefficient: Numbers, pin_diameter: float, bush_length: float, turns: tuple[Articulation, ...], rows: int = 1) -> Numbers:
    """By how much a joint gets longer in a revolution of the chain  [m]: V/(d L), V = k sum F d/2 angle.

    coefficient k [m^3/(N m)] of pin and bush together; rows share the forces.  The diameter cancels: h = k sum F angle/(2 L).
    """
    volume = sum(wear_volume(coefficient, turn.force / rows, 0.5 * pin_diameter * turn.angle) for turn in turns)
    return volume / (pin_diameter * bush_length)


def elongation(pitch: float, wear_per_revolution: Numbers, revolutions: float) -> Numbers:
    """Elongation of the chain, relative to its pitch, after so many revolutions: forces and angles do not change, so it is even."""
    return extrapolate_wear(np.zeros(()), np.asarray(wear_per_revolution), revolutions) / pitch


def elongation_limit(limit: float, teeth: tuple[int, ...]) -> float:
    """The elongation that ends a chain's life: the limit, or 2/z of the largest sprocket where that is less  [-]."""
    return min(limit, TOOTH_RULE / max(teeth))


def revolutions_to(limit: float, pitch: float, wear_per_revolution: Numbers) -> Numbers:
    """Revolutions of the chain until the elongation reaches a limit."""
    return limit * pitch / np.asarray(wear_per_revolution)
