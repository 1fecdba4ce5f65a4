"""Two congruent ellipses rolling on each other, each turning about a focus."""

from dataclasses import dataclass

import numpy as np

from drivewright._typing import ArrayLike
from drivewright.errors import InputError
from drivewright.gears.rolling import RollingPair, check_length
from drivewright.numerics.jets import Jet, compose

NARROWEST = 1e-6  # of 1 - e: beyond, an ellipse is a line to the focus, and speeds jump where it touches


@dataclass(frozen=True)
class EllipticGearPair(RollingPair):
    """Congruent ellipses of eccentricity e pivoted at a focus; centre distance 2 a.

    driven = 2 atan(r tan(angle/2)) continued over all turns, r = (1 - e)/(1 + e):
    E' = r/D, E'' = -r D'/D^2, E''' = r (2 D'^2/D^3 - D''/D^2), D = cos^2(x/2) + r^2 sin^2(x/2).

    start "near": at angle 0 the driver's short focal radius a (1 - e) is in contact; "far": its long one (r -> 1/r).
    semi_major [m] is needed only for lengths.
    """

    eccentricity: float
    semi_major: float | None = None
    start: str = "near"

    lobes = (1, 1)

    def __post_init__(self):
        if not 0 <= self.eccentricity < 1:
            raise InputError(f"EllipticGearPair: eccentricity = {self.eccentricity:.6g}; an ellipse needs 0 <= e < 1 (0 is a circle).")
        if 1 - self.eccentricity < NARROWEST:
            raise InputError(
                f"EllipticGearPair: eccentricity = {self.eccentricity:.9g}; the ratio of speeds would swing by "
                f"{(1 + self.eccentricity) / (1 - self.eccentricity):.3g} to 1; take a rounder ellipse."
            )
        if self.start not in ("near", "far"):
            raise InputError(f"EllipticGearPair: start = {self.start!r}; it is 'near' (short focal radius in contact at 0) or 'far'.")
        if self.semi_major is not None:
            check_length("semi_major", self.semi_major)

    @property
    def centre_distance(self) -> float:  # pyright: ignore[reportIncompatibleVariableOverride]  read only, as everywhere
        """Distance of the axes 2 a [m]."""
        if self.semi_major is None:
            raise InputError("EllipticGearPair: lengths need the size of the ellipse; give semi_major [m].")
        return 2 * self.semi_major

    @property
    def start_ratio(self) -> float:
        """r: the ratio at angle 0, (1 - e)/(1 + e) for a near start, its inverse for a far one; the ratio's other extreme is 1/r."""
        r = (1 - self.eccentricity) / (1 + self.eccentricity)
        return r if self.start == "near" else 1 / r

    def jet(self, angle: ArrayLike | Jet) -> Jet:
        """Driven angle [rad] as a jet; `angle` is an array or a jet."""
        x = np.asarray(angle.d0 if isinstance(angle, Jet) else angle, dtype=float)
        r = self.start_ratio
        turns = np.round(x / (2 * np.pi))
        half = 0.5 * (x - 2 * np.pi * turns)
        value = 2 * np.arctan2(r * np.sin(half), np.cos(half)) + 2 * np.pi * turns
        swing = 0.5 * (1 - r**2)
        d, slope, second = 1 - swing * (1 - np.cos(x)), -swing * np.sin(x), -swing * np.cos(x)
        outer = Jet(value, r / d, -r * slope / d**2, r * (2 * slope**2 / d**3 - second / d**2))
        return compose(outer, angle) if isinstance(angle, Jet) else outer
