"""Energy, force and stiffness of all non-linear elastic elements, for arrays of strains.

A law is called with strains d (..., c), c = 1 for a contact and 2 for a bearing, and answers with (energy (...), force (..., c),
stiffness (..., c, c)); the force is the gradient of the convex energy.  `secant(force)` [N/m] is a usual stiffness to start from.
The formulas themselves (`contact_response`, `radial_response`) take arrays, and single strains in kernels.
"""

from typing import Any, NamedTuple, Protocol, TypeAlias

import numpy as np

from drivewright._jit import generic, implements
from drivewright._typing import Floats, Numbers
from drivewright.contact import PowerLaw, power_law_response, power_law_secant
from drivewright.indexing.drivetrain import BearingModel, PinContact, PowerLawBearing

LINE = 10 / 9
TURNS = 4  # of Halley's method for the share of the line contact: cubic from a start within a fifth
TINY = 1e-300


class LineContact(NamedTuple):
    """A one-sided line contact F = line s^(10/9) with a compliance [m/N], F compliance, in series; line in [N/m^(10/9)].

    Arrays, in the shape of the approaches, where contacts differ.
    """

    line: float | Floats
    compliance: float | Floats


class ContactResponse(NamedTuple):
    """What a contact answers with to approaches [m] of any shape, each field of that shape: energy [J], force [N], tangent [N/m]."""

    energy: Floats
    force: Floats
    tangent: Floats


@generic
def contact_response(law: Any, depth: Numbers) -> ContactResponse:
    """The `ContactResponse` of a one-sided contact to approaches [m]: nothing where they are negative."""
    raise NotImplementedError


@implements(contact_response, PowerLaw)
def _(law, depth):
    """F = k d^n."""
    found = power_law_response(law, depth)
    return ContactResponse(found.energy, found.force, found.tangent)


@implements(contact_response, LineContact)
def _(law, depth):
    """F(d) of d = s + F C, F = c s^(10/9); V = 9/19 c s^(19/9) + F^2 C/2;  dF/dd = 1/(0.9 s/F + C).

    With t = d^(1/9) and s^(1/9) = t w it is w^9 (1 + c C t w) = 1, solved from w = (1 + c C t)^(-1/9), which is too small.
    """
    whole = np.maximum(depth, 0.0) ** (LINE - 1)
    ratio = law.line * law.compliance * whole
    w = (1.0 + ratio) ** (1 - LINE)
    for _ in range(TURNS):
        cube, part = w * w * w, ratio * w
        seventh = cube * cube * w
        off, first, second = seventh * w * w * (1.0 + part) - 1.0, seventh * w * (9.0 + 10.0 * part), seventh * (72.0 + 90.0 * part)
        w = w - 2.0 * off * first / (2.0 * first * first - off * second)
    root = whole * w
    cube, secant = root * root * root, law.line * root  # the secant F/s
    share = cube * cube * cube
    force = secant * share
    energy = force * share / (1 + LINE) + 0.5 * law.compliance * force * force
    return ContactResponse(energy, force, secant / (1 / LINE + law.compliance * secant))


class RadialResponse(NamedTuple):
    """What a bearing answers with to displacements of any shape, each field of that shape: energy [J], force [N], stiffness [N/m]."""

    energy: Floats
    x: Floats
    y: Floats
    xx: Floats
    xy: Floats
    yy: Floats


@generic
def radial_response(bearing: PowerLawBearing, x: Numbers, y: Numbers) -> RadialResponse:
    """The `RadialResponse` to displacements (x, y) [m] of a bearing alike in all directions: F = K max(r - c, 0)^n along them, r = |d|."""
    raise NotImplementedError


@implements(radial_response, PowerLawBearing)
def _(bearing, x, y):
    """dF = F' e e' + F/r (1 - e e')."""
    length = np.hypot(x, y)
    found = power_law_response(PowerLaw(bearing.constant, bearing.exponent), length - bearing.clearance)
    safe = np.maximum(length, TINY)
    # Without clearance F/r tends to K r^(n-1), also where r is 0 and has no direction.
    around = found.secant if bearing.clearance == 0.0 else found.force / safe
    ex, ey, more = x / safe, y / safe, found.tangent - around
    return RadialResponse(found.energy, around * x, around * y, more * ex * ex + around, more * ex * ey, more * ey * ey + around)


Response: TypeAlias = tuple[Floats, Floats, Floats]  # energy (...) [J], force (..., c) [N], stiffness (..., c, c) [N/m]


class ForceLaw(Protocol):
    """Answers strains (..., c) [m] with its `Response`, and a force [N] with a usual stiffness [N/m]."""

    def __call__(self, strain: Floats) -> Response: ...

    def secant(self, force: float) -> float:
        """A usual secant stiffness F/d [N/m]."""
        ...


class PinContactLaw(NamedTuple):
    """Contacts (cams' pins): force of a `PinContact` against approach; `bonded`: they also pull, as if bonded.

    compliance [m/N], of the shape of the strains: behind each contact in place of `pin.series`, where contacts differ.
    """

    pin: PinContact
    bonded: bool
    compliance: Floats | None = None

    @property
    def one_sided(self) -> LineContact | PowerLaw:
        """The law of an approach that closes the contact."""
        line, series = self.pin
        if line is not None:
            return LineContact(line, self.compliance if self.compliance is not None else 0.0 if series is None else 1.0 / series)
        assert series is not None  # a pin without both is rigid
        return PowerLaw(series, 1.0)

    def __call__(self, strain: Floats) -> Response:
        """By the size of the strain where the contact is bonded."""
        energy, force, slope = contact_response(self.one_sided, np.abs(strain) if self.bonded else strain)
        return energy[..., 0], np.copysign(force, strain) if self.bonded else force, slope[..., None]

    def secant(self, force: float) -> float:
        """F/d [N/m]."""
        if self.compliance is None:
            return 1.0 / pin_compliance(self.pin, force)
        return 1.0 / (pin_compliance(self.pin._replace(series=None), force) + float(np.median(self.compliance)))


class ContactLinesLaw(NamedTuple):
    """Line contacts of different lengths: line [N/m^(10/9)], of the shape of the strains, compliance [m/N] in series behind each.

    bonded: as in `PinContactLaw`.
    """

    line: Floats
    compliance: float
    bonded: bool

    def __call__(self, strain: Floats) -> Response:
        found = contact_response(LineContact(self.line, self.compliance), np.abs(strain) if self.bonded else strain)
        force = np.copysign(found.force, strain) if self.bonded else found.force
        return found.energy[..., 0], force, found.tangent[..., None]

    def secant(self, force: float) -> float:
        """F/d [N/m] of a line of usual length."""
        return 1.0 / ((force / float(np.median(self.line))) ** 0.9 / force + self.compliance)


def pin_compliance(pin: PinContact, force: float) -> float:
    """d/F of a pin [m/N] under a force above 0: (F/c)^0.9/F + 1/k."""
    line = 0.0 if pin.line is None else (force / pin.line) ** 0.9 / force
    return line + (0.0 if pin.series is None else 1.0 / pin.series)


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
        energy, force, slope = contact_response(PowerLaw(self.k, 1.0), strain)
        return energy[..., 0], force, slope[..., None]

    def secant(self, force: float) -> float:
        """F/d [N/m]."""
        return self.k


class RadialBearingLaw(NamedTuple):
    """A bearing alike in all directions: F = K max(r - c, 0)^n along d, r = |d|."""

    bearing: PowerLawBearing

    def __call__(self, strain: Floats) -> Response:
        energy, x, y, xx, xy, yy = radial_response(self.bearing, strain[..., 0], strain[..., 1])
        stiffness = np.stack([xx, xy, xy, yy], axis=-1).reshape(*strain.shape, 2)
        return energy, np.stack([x, y], axis=-1), stiffness

    def secant(self, force: float) -> float:
        """F/d [N/m]."""
        return power_law_secant(PowerLaw(self.bearing.constant, self.bearing.exponent), force)


def radial_bearing_law(bearing: BearingModel) -> ForceLaw:
    """The law of a PowerLawBearing, or of a rolling bearing of `drivewright.bearings` with its axial place and tilts held."""
    if isinstance(bearing, PowerLawBearing):
        return RadialBearingLaw(bearing)
    from drivewright.indexing.stiffness.rolling import rolling_bearing_law  # its kernel imports numba

    return rolling_bearing_law(bearing)
