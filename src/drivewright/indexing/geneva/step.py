"""Kinematics of the external Geneva wheel: closed forms in the crank angle.

With the ratio l = a/C of crank radius and centre distance, the direction of the pin as seen from the wheel's axis is
    psi = atan2(l sin theta, 1 - l cos theta),    D = 1 + l^2 - 2 l cos theta,
    psi' = l (cos theta - l)/D,    psi'' = -l (1 - l^2) sin theta/D^2,
    psi''' = -l (1 - l^2) (D cos theta - 4 l sin^2 theta)/D^3.
The pin enters along the slot, without a shock, where l = sin(pi/n).  Recalled: Bickford, Mechanisms for Intermittent Motion (1972);
Norton, Design of Machinery.  The tests check the formulas against differences of the loop and the tables of the literature.
"""

from typing import NamedTuple

import numpy as np

from drivewright._typing import Bools, Floats, Numbers
from drivewright.numerics.jets import Jet


class GenevaStep(NamedTuple):
    """Number of slots n, centre distance C [m], crank radius a [m], 0 < a < C."""

    slots: int
    centre_distance: float
    crank_radius: float

    @property
    def ratio(self) -> float:
        """l = a/C."""
        return self.crank_radius / self.centre_distance

    @property
    def half_pitch(self) -> float:
        """beta = pi/n [rad], half the step."""
        return np.pi / self.slots

    @property
    def fitting_radius(self) -> float:
        """Crank radius [m] with which the pin enters along the slot: C sin(beta)."""
        return self.centre_distance * float(np.sin(self.half_pitch))

    @property
    def excess(self) -> float:
        """Crank radius beyond the fitting one [m]; 0 of a drive without an entry shock."""
        return self.crank_radius - self.fitting_radius

    @property
    def half_engagement(self) -> float:
        """Crank angle [rad] from entry to the line of centres: where the pin stands on the axis of the waiting slot.

        A crank that is too short never reaches it; there the angle at which the pin is farthest aside stands for it.
        """
        if self.excess > 0:
            return float(np.arcsin(np.sin(self.half_pitch) / self.ratio)) - self.half_pitch
        return float(np.arccos(self.ratio))

    @property
    def engagement(self) -> float:
        """Crank angle of a step [rad]; pi (1 - 2/n) where the pin enters along the slot."""
        return 2 * self.half_engagement

    def pin_direction(self, theta: Numbers) -> Jet:
        """psi [rad] and its derivatives by the crank angle [rad]."""
        ratio, cosine, sine = self.ratio, np.cos(theta), np.sin(theta)
        square = 1 + ratio**2 - 2 * ratio * cosine
        bend = ratio * (1 - ratio**2)
        return Jet(
            np.arctan2(ratio * sine, 1 - ratio * cosine),
            ratio * (cosine - ratio) / square,
            -bend * sine / square**2,
            -bend * (square * cosine - 4 * ratio * sine**2) / square**3,
        )

    def pin_distance(self, theta: Numbers) -> Floats:
        """Distance rho of the pin from the wheel's axis [m]."""
        return self.centre_distance * np.sqrt(1 + self.ratio**2 - 2 * self.ratio * np.cos(theta))

    def pin_travel_rate(self, theta: Numbers) -> Floats:
        """d(rho)/d(theta) [m/rad]: how the pin moves outwards along the slot."""
        return self.crank_radius * self.centre_distance * np.sin(theta) / self.pin_distance(theta)

    def wheel(self, theta: Numbers, engaged: Bools) -> Jet:
        """Angle of the wheel [rad] from the start of its step, and its derivatives by the crank angle [rad].

        theta from -pi to pi; `engaged` says where the pin is in the slot: elsewhere the wheel rests at 0 or at the whole step.
        """
        psi, rest = self.pin_direction(theta), np.where(np.asarray(theta) < 0, 0.0, 2 * self.half_pitch)
        held = np.asarray(engaged, dtype=bool)
        return Jet(np.where(held, psi.d0 + self.half_pitch, rest), *(np.where(held, part, 0.0) for part in (psi.d1, psi.d2, psi.d3)))

    @property
    def largest_rate(self) -> float:
        """Largest psi', on the line of centres: l/(1 - l)."""
        return self.ratio / (1 - self.ratio)

    @property
    def entry_bend(self) -> float:
        """psi'' at entry; tan(beta) where the pin enters along the slot."""
        return float(self.pin_direction(-self.half_engagement).d2)

    @property
    def largest_bend_angle(self) -> float:
        """Crank angle [rad] from the line of centres of the largest psi'': cos = sqrt(G^2 + 2) - G with G = (1 + l^2)/(4 l); within the
        engagement."""
        g = (1 + self.ratio**2) / (4 * self.ratio)
        return min(float(np.arccos(min(1.0, np.sqrt(g * g + 2) - g))), self.half_engagement)

    @property
    def largest_bend(self) -> float:
        """Largest psi''."""
        return float(self.pin_direction(-self.largest_bend_angle).d2)

    @property
    def largest_third(self) -> float:
        """Largest |psi'''|, on the line of centres: l (1 + l)/(1 - l)^3."""
        return self.ratio * (1 + self.ratio) / (1 - self.ratio) ** 3
