"""The root that a hob's rounded tip leaves between the teeth of an involute gear.

The hob's pitch line rolls on the circle of radius r2 = rb/cos a2.  The centre of a rounding, at the height e below the pitch line (e < 0
in the formulas: outwards positive) and q beside the pitch point, envelops with its radius rho, turned back with the gear by the rolled
angle (q - q0)/r2, the curve  (q, r2 + e) + rho (q, e)/|(q, e)|,  since every normal of the cut passes through the pitch point.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from drivewright._typing import Complexes, Floats, Numbers
from drivewright.chains.tooth import Cutter
from drivewright.errors import InputError
from drivewright.numerics.roots import bracketed_roots


class Hob(NamedTuple):
    """The right-hand neighbour in the hob of the tooth on the y axis, at its left rounding.

    pitch_radius r2 [m], half_angle a2 [rad], rounding rho [m], height e of the rounding's centre above the pitch line [m], its place q0 [m]
    when the gear's tooth stands in the middle of the hob's space.
    """

    pitch_radius: float
    half_angle: float
    rounding: float
    height: float
    place: float

    def point(self, q: Numbers) -> Complexes | complex:
        """Points (complex) of the trochoid in the gear's frame."""
        arm = np.asarray(q) + 1j * self.height
        z = arm * (1 + self.rounding / np.abs(arm)) + 1j * self.pitch_radius
        return z * np.exp(1j * (q - self.place) / self.pitch_radius)

    def heading(self, q: float) -> tuple[float, float]:
        """Unit tangent (x, y) of the trochoid towards the flank: square to the arm from the pitch point."""
        arm = q + 1j * self.height
        along = -1j * arm / abs(arm) * np.exp(1j * (q - self.place) / self.pitch_radius)
        return float(along.real), float(along.imag)

    @property
    def join(self) -> float:
        """q at which the rounding passes over into the straight flank: e cot a2."""
        return self.height / np.tan(self.half_angle)

    @property
    def flank_end(self) -> float:
        """Depth of the lower end of the straight flank below the pitch line  [m]."""
        return self.rounding * np.sin(self.half_angle) - self.height


def hob(teeth: int, cutter: Cutter, half_angle: float, root_radius: float, rounding: float) -> Hob:
    """The `Hob` that cuts down to root_radius a tooth that fills 2 half_angle on the base circle.

    On the rolling circle the tooth is 2 r2 (psi - inv a2) thick, and so is the hob's space on its pitch line.
    """
    a2 = cutter.half_angle
    pitch_radius = 0.5 * cutter.module * teeth
    space = pitch_radius * (half_angle - np.tan(a2) + a2)  # half the hob's space on the pitch line
    height = root_radius + rounding - pitch_radius
    place = space - height * np.tan(a2) + rounding / np.cos(a2)
    largest = full_rounding(teeth, cutter, half_angle, root_radius)
    if not 0 < rounding <= largest * (1 + 1e-12):
        raise InputError(
            f"Sprocket: tip_rounding = {rounding * 1e3:.4g} mm; the hob's tip has room for more than 0 and at most "
            f"{max(largest, 0.0) * 1e3:.4g} mm at the root radius {root_radius * 1e3:.5g} mm. Take a smaller "
            "one, or a higher root."
        )
    if height >= 0:
        raise InputError(
            f"Sprocket: the rounding of the hob's tip, {rounding * 1e3:.4g} mm at the root radius {root_radius * 1e3:.5g} "
            "mm, reaches over the rolling "
            f"circle of {pitch_radius * 1e3:.5g} mm. Take a smaller rounding, a lower root, or a cutter with a larger pitch."
        )
    return Hob(float(pitch_radius), float(a2), float(rounding), float(height), float(place))


@dataclass(frozen=True)
class Root:
    """What is left of the trochoid, from the root circle (q = 0) to q = end, where the involute of form_radius [m] begins."""

    hob: Hob
    end: float
    form_radius: float
    undercut: bool

    @property
    def polar(self) -> float:
        """Angle [rad] from the tooth's centre line to the end of the root circle's arc."""
        return self.hob.place / self.hob.pitch_radius

    def points(self, count: int = 200) -> Floats:
        """Points (count, 2) from the root circle up."""
        z = self.hob.point(np.linspace(0.0, self.end, count))
        return np.stack([z.real, z.imag], axis=1)


def full_rounding(teeth: float, cutter: Cutter, half_angle: float, root_radius: float) -> float:
    """The rounding that leaves the hob's tip no land [m]: half its straight tip times cos a2/(1 - sin a2)."""
    a2 = cutter.half_angle
    pitch_radius = 0.5 * cutter.module * teeth
    half_tip = 0.5 * cutter.pitch - pitch_radius * (half_angle - np.tan(a2) + a2) + (root_radius - pitch_radius) * np.tan(a2)
    return half_tip * np.cos(a2) / (1 - np.sin(a2))


def root(hob: Hob, base_radius: float, half_angle: float) -> Root:
    """The `Root` of a hob beside the involute that fills 2 half_angle on the base circle."""
    slope = np.sin(hob.half_angle)
    along = hob.pitch_radius * slope - hob.flank_end / slope  # of the base tangent, where the hob's straight flank ends
    if along >= 0:
        return Root(hob, hob.join, float(np.hypot(base_radius, along)), False)

    def beyond(q):
        """Angle by which the trochoid reaches into the tooth; below the base circle the tooth is bounded by a radius."""
        z = hob.point(q)
        angle = np.arccos(np.minimum(base_radius / np.abs(z), 1.0))
        return half_angle - np.tan(angle) + angle - (0.5 * np.pi - np.angle(z))

    # The trochoid enters the tooth and leaves it again through the involute; the less undercut, the nearer to its end.
    crossings = bracketed_roots(beyond, hob.join * np.append(1.0, 1 - np.geomspace(1e-8, 1, 400)))
    if not len(crossings):
        return Root(hob, hob.join, float(np.hypot(base_radius, along)), False)
    end = float(crossings[0])
    return Root(hob, end, float(abs(hob.point(end))), True)
