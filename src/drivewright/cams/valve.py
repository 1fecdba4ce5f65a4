"""The second arm of a rocker and the valve that it drives on a straight line; lengths along an arm's arc.

The pad of the arm is round (or a point) and presses on the flat end of a valve stem: the valve moves as the centre of the pad does along
the valve's line, whatever the pad's radius.  With the arm L [m] at the angle a to the line through the pivot square to the valve's line,
a = a0 + swing,

    lift = L (sin(a0 + swing) - sin(a0)),     d lift/d swing = L cos(a0 + swing)

and the place of contact moves across the stem's end as L cos(a0 + swing).
"""

from dataclasses import dataclass

import numpy as np

from drivewright.errors import DoesNotAssemble
from drivewright.numerics.jets import Jet, compose, constant, cos, sin


@dataclass(frozen=True)
class GuidedArm:
    """An arm of a length [m] at an angle `start` [rad] at zero lift, whose end drives a valve along a straight line."""

    length: float
    start: float = 0.0

    def lift(self, swing: Jet) -> Jet:
        """Lift of the valve [m] at a swing [rad] of the rocker; jets."""
        return self.length * (sin(self.start + swing) - np.sin(self.start))

    def ratio(self, swing: Jet) -> Jet:
        """d lift/d swing = L cos(a0 + swing) [m/rad], a jet."""
        return self.length * cos(self.start + swing)

    def across(self, swing: Jet) -> Jet:
        """Place of the contact across the stem's end [m], from where it is at zero lift; a jet."""
        return self.ratio(swing) - self.length * np.cos(self.start)

    def value(self, stated: Jet) -> Jet:
        """Swing [rad] of the rocker at a lift [m] of the valve: asin(lift/L + sin a0) - a0."""
        height = self._height(stated)
        return _asin(height) - self.start

    def slope(self, stated: Jet) -> Jet:
        """d swing/d lift = 1/(L sqrt(1 - (lift/L + sin a0)^2)) [rad/m]."""
        return (1 - self._height(stated) ** 2) ** -0.5 / self.length

    def _height(self, stated):
        """sin(a0 + swing); DoesNotAssemble where the arm cannot reach."""
        height = stated / self.length + np.sin(self.start)
        worst = float(np.max(np.abs(height.d0)))
        if worst >= 1:
            room = self.length * (1 - np.sin(self.start))
            raise DoesNotAssemble(
                f"valve: its lift is out of reach of the arm: {1e3 * self.length:.6g} mm long and at {np.degrees(self.start):.6g}° at "
                f"zero lift, it lifts the valve by less than {1e3 * room:.6g} mm. Lengthen valve.arm_length or lower valve.start_angle."
            )
        return height


@dataclass(frozen=True)
class ArcArm:
    """An arm of a length [m] along whose end's arc a lift is counted: lift = L swing."""

    length: float

    def value(self, stated: Jet) -> Jet:
        """Swing [rad] at a lift [m]."""
        return stated / self.length

    def slope(self, stated: Jet) -> Jet:
        """d swing/d lift = 1/L [rad/m]."""
        return constant(np.full_like(stated.d0, 1 / self.length))


@dataclass(frozen=True)
class GuidedLift:
    """The map the other way: the valve's lift of a rocker's swing."""

    arm: GuidedArm

    def value(self, stated: Jet) -> Jet:
        """Lift [m] of the valve at a swing [rad]."""
        return self.arm.lift(stated)

    def slope(self, stated: Jet) -> Jet:
        """d lift/d swing [m/rad]."""
        return self.arm.ratio(stated)


def _asin(x: Jet) -> Jet:
    """Inverse sine: asin' = r = (1 - x^2)^(-1/2), asin'' = x r^3, asin''' = r^3 + 3 x^2 r^5."""
    r = 1 / np.sqrt(1 - x.d0**2)
    return compose(Jet(np.arcsin(x.d0), r, x.d0 * r**3, r**3 + 3 * x.d0**2 * r**5), x)
