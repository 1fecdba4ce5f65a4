"""Two pitch curves that roll on each other about fixed axes, from the driven angle as a function of the driver's.

World frame: driver axis at 0, driven axis at +centre_distance on the x axis.  The driver turns counter-clockwise by `angle`, the
driven gear clockwise by `driven(angle)`; both are 0 together.  ratio i = d driven / d angle; the radii in contact are

    r1 = C i/(1 + i),   r2 = C/(1 + i),   r1 + r2 = C,   r1 = i r2   (the contact point does not slide).
"""

from abc import ABC, abstractmethod
from functools import cached_property

import numpy as np

from drivewright._typing import ArrayLike, Floats
from drivewright.curves import curvature, derivative
from drivewright.errors import InputError
from drivewright.gears.integral import RunningIntegral
from drivewright.numerics.jets import Jet, exp, variable


class RollingPair(ABC):
    """What follows from `jet(angle)`, `centre_distance` and `lobes` alone.

    lobes (n, m): the ratio repeats n times per turn of the driver and m times per turn of the driven gear.
    """

    centre_distance: float
    lobes: tuple[int, int]

    @abstractmethod
    def jet(self, angle: ArrayLike | Jet) -> Jet:
        """Driven angle [rad] as a jet; `angle` is an array (derivatives by it) or itself a jet of some other variable."""

    def ratio_jet(self, angle: ArrayLike) -> Jet:
        """The ratio as a jet of the driver angle, an array (third derivative nan)."""
        return derivative(self.jet(angle))

    def driven(self, angle: ArrayLike) -> Floats:
        """Driven angle [rad], continuous over any number of turns, 0 at 0, positive with positive driver angle."""
        return self.jet(angle).d0

    def ratio(self, angle: ArrayLike) -> Floats:
        """d driven / d angle."""
        return self.jet(angle).d1

    def radii(self, angle: ArrayLike) -> tuple[Jet, Jet]:
        """Radii of driver and driven pitch curve at the contact [m], jets of the driver angle (third derivative nan)."""
        driven = self.centre_distance / (1 + self.ratio_jet(np.asarray(angle, dtype=float)))
        return self.centre_distance - driven, driven

    def pitch_curve(self, gear: int, angle: ArrayLike) -> Jet:
        """Pitch curve of gear 1 (driver) or 2 (driven) in the gear's own frame, a complex jet of the driver angle.

        The gear's frame is the world's at angle 0, moved to the gear's axis.  z1 = r1 e^{-i angle}, z2 = -r2 e^{i driven}.
        """
        angle = np.asarray(angle, dtype=float)
        first, second = self.radii(angle)
        return first * exp(-1j * variable(angle)) if gear == 1 else -1 * second * exp(1j * self.jet(angle))

    @cached_property
    def arc_length(self) -> RunningIntegral:
        """Length rolled since angle 0 [m], the same on both pitch curves: a function of the driver angle with `.inverse`."""
        return RunningIntegral(self._rolling_speed)

    def _rolling_speed(self, angle):
        """ds/d angle = sqrt(r1^2 + r1'^2), r1' = C i'/(1 + i)^2  [m]."""
        ratio, rate, _, _ = self.ratio_jet(angle)
        return self.centre_distance / (1 + ratio) * np.hypot(ratio, rate / (1 + ratio))

    def perimeter(self, gear: int = 1) -> float:
        """Perimeter of the pitch curve of gear 1 or 2 [m]."""
        n, m = self.lobes
        return self.arc_length.total * (1.0 if gear == 1 else m / n)

    def module(self, teeth: float, gear: int = 1) -> float:
        """Module [m] that puts this many teeth on the gear's pitch curve: perimeter / (pi teeth)."""
        return self.perimeter(gear) / (np.pi * teeth)

    def teeth(self, module: float, gear: int = 1) -> float:
        """Tooth count, in general not whole, that a module [m] gives: perimeter / (pi module)."""
        return self.perimeter(gear) / (np.pi * module)

    def curvature(self, gear: int, angle: ArrayLike) -> Floats:
        """Curvature of a pitch curve [1/m], positive where convex."""
        return (-1.0 if gear == 1 else 1.0) * curvature(self.pitch_curve(gear, angle))

    def min_curvature(self, gear: int = 1, samples: int = 1440) -> tuple[float, float]:
        """(driver angle, curvature [1/m]) where the pitch curve is least convex; negative: it is hollow there."""
        turns = 1.0 if gear == 1 else self.lobes[1] / self.lobes[0]
        angle = np.linspace(0, 2 * np.pi * turns, samples, endpoint=False)
        curvatures = self.curvature(gear, angle)
        worst = int(np.argmin(curvatures))
        return float(angle[worst]), float(curvatures[worst])

    def tilt(self, angle: ArrayLike) -> Floats:
        """Angle [rad] from the normal of the line of centres to the pitch curves' common tangent, counter-clockwise: tan = r1'/r1.

        A rack angle alpha acts on the axes as alpha + tilt on one flank and alpha - tilt on the other.
        """
        first, _ = self.radii(angle)
        return np.arctan2(first.d1, first.d0)


def check_length(name: str, value: float) -> None:
    """Raise InputError unless value is a positive finite length."""
    if not (np.isfinite(value) and value > 0):
        raise InputError(f"gears: {name} = {value:.6g} m; it must be positive and finite.")
