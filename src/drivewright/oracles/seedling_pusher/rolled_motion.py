"""Train, tip and rollers of a pusher by rolling and by construction: nothing here uses a formula or a derivative of the analyses."""

from collections.abc import Callable
from functools import cached_property
from typing import Any

import numpy as np

from drivewright._typing import Complexes, Floats
from drivewright.cams.conjugate import ConjugateCam
from drivewright.mechanisms.seedling_pusher.build import TURN, PusherModel
from drivewright.numerics.quadrature import cumulative_integral

SAMPLES = 36001  # over one turn
PHASE_SAMPLES = 4001  # over one smooth piece of the push


def rolled_pair(eccentricity: float, start: str = "near", panels: int = 3600) -> Callable[[Any], Any]:
    """driven(angle) of two congruent ellipses, each about a focus, laid against each other by equal arc length.

    r(x) = (1 - e^2)/(1 + e cos x) from the near vertex, in units of the semi-major axis; ds = sqrt(r^2 + r'^2) dx.
    Start "near": the driver's near vertex touches the far one of the driven ellipse.
    """
    from scipy.interpolate import CubicHermiteSpline

    x = np.linspace(0, TURN, panels + 1)
    speeds = [arc_speed(eccentricity if start == "near" else -eccentricity), arc_speed(-eccentricity if start == "near" else eccentricity)]
    (along, speed), (length, far_speed) = ((cumulative_integral(f, x), f(x)) for f in speeds)
    rolled, angle = CubicHermiteSpline(x, along, speed), CubicHermiteSpline(length, x, 1 / far_speed)

    def driven(angle_of_driver):
        turns, rest = np.divmod(angle_of_driver, TURN)
        return turns * TURN + angle(rolled(rest))

    return driven


def arc_speed(e: float) -> Callable[[Floats], Floats]:
    """ds/dx of an ellipse over the polar angle x about a focus, from the near vertex (e > 0) or the far one (e < 0)."""

    def speed(x):
        reach = 1 + e * np.cos(x)
        return (1 - e**2) / reach * np.hypot(1, e * np.sin(x) / reach)

    return speed


def roller_at_rest(cam: ConjugateCam) -> complex:
    """Roller centre with the rod in, from the three sides of the triangle axis - pivot - roller; the pivot is on -y."""
    c, arm, radius = cam.pivot_distance, cam.arm, cam.prime_radius
    depth = (c**2 + radius**2 - arm**2) / (2 * c)
    return cam.side * np.sqrt(radius**2 - depth**2) - 1j * depth


class RolledMotion:
    """The motion of a model; t is the carrier angle [rad], places are complex [m]."""

    def __init__(self, model: PusherModel) -> None:
        train = model.spec.train
        self.model, self.bend = model, model.arm.bend
        self.driven = rolled_pair(np.sqrt(1 - train.axis_ratio**2), train.start)
        self.turn = np.linspace(0, TURN, SAMPLES)

    def planet(self, t: Any) -> Any:
        """Planet relative to the carrier since t = 0 [rad]."""
        return self.driven(self.bend + self.driven(t)) - self.driven(self.bend)

    def tip(self, t: Floats) -> Complexes:
        """Needle tip in the world: carrier turned back by t, arm by what the planet adds."""
        spec = self.model.spec
        first = 2 * spec.train.semi_major * np.exp(1j * (spec.train.carrier_angle - t))
        needle = np.exp(1j * (self.model.arm.start - t + self.planet(t)))
        return first + first * np.exp(1j * self.bend) + spec.arm.tip_distance * needle

    def pivot(self, t: Floats) -> Complexes:
        """Lever pivot in the frame of the cams, carried round with the planet."""
        return -1j * self.model.spec.lever.pivot_distance * np.exp(1j * self.model.pair.orbit * self.planet(t))

    def roller(self, cam: ConjugateCam, t: Floats) -> Complexes:
        """Roller centre in the frame of the cams: lever turned clockwise about its pivot by the swing, then carried round."""
        home, pivot = -1j * cam.pivot_distance, self.pivot(t)
        swing = np.arctan2(self.model.pair.travel(t).d0, self.model.spec.lever.output_arm)
        return pivot * (1 + (roller_at_rest(cam) - home) / home * np.exp(-1j * swing))

    def pieces(self, *phases: str) -> list[Floats]:
        """Dense carrier angles over each smooth piece of the phases, ends included."""
        return [np.linspace(low, high, PHASE_SAMPLES) for low, high, phase, _ in self.model.pair.pieces if phase in phases]

    @cached_property
    def cycle(self) -> Floats:
        """Carrier angles of one turn from the start of the push, dense where the rod moves."""
        return np.unique(np.concatenate([t[:-1] for t in self.pieces("rise", "dwell", "return")]))
