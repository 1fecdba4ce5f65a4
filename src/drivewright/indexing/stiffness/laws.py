"""Energy, force and stiffness of everything that yields non-linearly, for arrays of strains.

A law is called with strains d (..., c), c = 1 for a contact and 2 for a bearing, and answers with (energy (...), force (..., c),
stiffness (..., c, c)); the force is the gradient of the convex energy.  `secant(force)` [N/m] is a usual stiffness to start from.
"""

from typing import NamedTuple, Protocol, TypeAlias

import numpy as np

from drivewright._typing import Floats
from drivewright.contact import PowerLaw, power_law_response, power_law_secant
from drivewright.indexing.drivetrain import BearingModel, PinContact, PowerLawBearing

LINE = 10 / 9
TURNS = 6  # of Newton's method for the share of the line contact: quadratic from a start within a few tens of per cent
TINY = 1e-300


Response: TypeAlias = tuple[Floats, Floats, Floats]  # energy (...) [J], force (..., c) [N], stiffness (..., c, c) [N/m]


class ForceLaw(Protocol):
    """Answers strains (..., c) [m] with its `Response`, and a force [N] with a usual stiffness [N/m]."""

    def __call__(self, strain: Floats) -> Response: ...

    def secant(self, force: float) -> float:
        """A usual secant stiffness F/d [N/m]."""
        ...


class PinContactLaw(NamedTuple):
    """Contacts (cams' pins): force of a `PinContact` against approach; `bonded`: they also pull, as if bonded."""

    pin: PinContact
    bonded: bool

    def __call__(self, strain: Floats) -> Response:
        """F(d) of d = s + F/k, F = c s^(10/9); V = 9/19 c s^(19/9) + F^2/2k;  dF/dd = 1/(0.9 s/F + 1/k)."""
        c, k = self.pin.line, self.pin.series
        depth = np.abs(strain) if self.bonded else strain
        if c is None:
            assert k is not None  # a pin without both is rigid
            energy, force, _, slope = power_law_response(PowerLaw(k, 1.0), depth)
        else:
            share = np.maximum(depth, 0.0)
            line = power_law_response(PowerLaw(c, LINE), share if k is None else line_contact_approach(share, c / k))
            force = line.force
            slope = line.secant / (1 / LINE + (0.0 if k is None else line.secant / k))
            energy = line.energy + (0.0 if k is None else 0.5 * force**2 / k)
        return energy[..., 0], np.copysign(force, strain) if self.bonded else force, slope[..., None]

    def secant(self, force: float) -> float:
        """F/d [N/m]."""
        return 1.0 / pin_compliance(self.pin, force)


def pin_compliance(pin: PinContact, force: float) -> float:
    """d/F of a pin [m/N] under a force above 0: (F/c)^0.9/F + 1/k."""
    line = 0.0 if pin.line is None else (force / pin.line) ** 0.9 / force
    return line + (0.0 if pin.series is None else 1.0 / pin.series)


def line_contact_approach(depth: Floats, ratio: float) -> Floats:
    """s of s + ratio s^(10/9) = depth."""
    share = depth / (1 + ratio * depth ** (LINE - 1))
    for _ in range(TURNS):
        power = ratio * share ** (LINE - 1)
        share = share * (1 - (share * (1 + power) - depth) / np.maximum(share * (1 + LINE * power), TINY))
    return share


class RigidContactLaw(NamedTuple):
    """Rigid contacts by the method of multipliers: F = max(m + k d, 0) with multipliers m (..., 1) that a loop moves to where d = 0.

    A stiffness k alone leaves the error F/k; here it only sets how fast the loop is.
    """

    multipliers: Floats
    k: Floats
    bonded: bool

    def __call__(self, strain: Floats) -> Response:
        pull = self.multipliers + self.k * strain
        force = pull if self.bonded else np.maximum(pull, 0.0)
        slope = np.where((force > 0) | self.bonded, self.k, 0.0)
        return ((force**2 - self.multipliers**2) / (2 * self.k))[..., 0], force, slope[..., None]


StrainLaw: TypeAlias = ForceLaw | RigidContactLaw


class GearFlankLaw(NamedTuple):
    """One-sided linear contact: F = k max(d, 0)."""

    k: float

    def __call__(self, strain: Floats) -> Response:
        energy, force, _, slope = power_law_response(PowerLaw(self.k, 1.0), strain)
        return energy[..., 0], force, slope[..., None]

    def secant(self, force: float) -> float:
        """F/d [N/m]."""
        return self.k


class RadialBearingLaw(NamedTuple):
    """A bearing alike in all directions: F = K max(r - c, 0)^n along d, r = |d|;  dF = F' e e' + F/r (1 - e e')."""

    bearing: PowerLawBearing

    def __call__(self, strain: Floats) -> Response:
        constant, n, clearance = self.bearing
        length = np.hypot(strain[..., 0], strain[..., 1])
        energy, force, root, slope = power_law_response(PowerLaw(constant, n), length - clearance)
        safe = np.maximum(length, TINY)
        # Without clearance F/r tends to K r^(n-1), also where r is 0 and has no direction.
        around = root if clearance == 0 else force / safe
        along = strain / safe[..., None]
        stiffness = ((slope - around)[..., None] * along)[..., None] * along[..., None, :]
        stiffness[..., 0, 0] += around
        stiffness[..., 1, 1] += around
        return energy, around[..., None] * strain if clearance == 0 else force[..., None] * along, stiffness

    def secant(self, force: float) -> float:
        """F/d [N/m]."""
        return power_law_secant(PowerLaw(self.bearing.constant, self.bearing.exponent), force)


def radial_bearing_law(bearing: BearingModel) -> ForceLaw:
    """The law of a PowerLawBearing, or of a rolling bearing of `drivewright.bearings` with its axial place and tilts held."""
    if isinstance(bearing, PowerLawBearing):
        return RadialBearingLaw(bearing)
    from drivewright.indexing.stiffness.rolling import rolling_bearing_law  # its kernel imports numba

    return rolling_bearing_law(bearing)
