"""Roller bearings, cylindrical and tapered: every roller a row of laminae, each pressed in by its own amount.

After ISO/TS 16281, recalled: Palmgren's law of line contact, the load-dependent length of the contact by the profile of the roller,
clearance and tilt.  The rings keep their shape; ribs, cage and inertia are left out, so that without a contact angle nothing carries
axial load.  With 41 laminae a crowned roller's load is within 1 % and its stiffness within 3 % of the integral along it.
"""

from functools import lru_cache
from typing import Literal, NamedTuple

import numpy as np
from pydantic import model_validator

from drivewright._jit import by_reference, implements, inner, warmer
from drivewright._typing import ArrayLike, Floats
from drivewright.bearings.newton import BearingMeasures, measures
from drivewright.bearings.response import response
from drivewright.bearings.solving import PERMISSIBLE, basic_static_rating, elements, law_of, life_of, refuse_other, warm
from drivewright.contact import effective_modulus, line_contact
from drivewright.errors import SpecError
from drivewright.spec import Integer, Number, Spec
from drivewright.spec.fields import Field
from drivewright.units import SI, Angle, Force, Length, Pressure

RIGHT_ANGLE = 1.5707963267948966
EXPONENT = 10 / 9
# Palmgren's constant of the two contacts of a steel roller, 35948 N/mm^2, over E* of steel (210 GPa, 0.3).  The dimensions leave
# nothing but proportionality to E* once exponents of length and approach are 8/9 and 10/9.
LINE_CONSTANT = 35948e6 / (210e9 / (2 * (1 - 0.3**2)))
PEAK_SHARE = 5.0  # load of the fullest roller over the mean F/(Z cos a); with the usual clearance


class RollerBearing(Spec):
    """Inner geometry of a single-row roller bearing."""

    rollers: Integer = Field(ge=3, le=10000, description="number of rollers", examples=[16])
    roller_diameter: Length = Field(gt=0, description="diameter of a roller, at mid-length where it is tapered", examples=["3.5 mm"])
    roller_length: Length = Field(
        gt=0, description="effective length of a roller: that of the contact, without chamfers", examples=["3.2 mm"]
    )
    pitch_diameter: Length = Field(gt=0, description="diameter of the circle of the rollers' middles", examples=["26 mm"])
    contact_angle: Angle = Field(
        "0 deg",
        ge=0,
        lt=RIGHT_ANGLE,
        description="angle of the line of contact against a plane across the axis; "
        "above 0 a tapered bearing, whose inner ring carries axial load towards +z",
    )
    radial_clearance: Length = Field("0 mm", description="diametral clearance; negative for preload")
    profile: Literal["log", "none"] = Field("log", description="crown of the rollers: logarithmic after ISO/TS 16281, or none")
    laminae: Integer = Field(41, ge=1, le=1001, description="slices of a roller")
    dynamic_rating: Force | None = Field(None, gt=0, description="basic dynamic load rating C; without it there is no life")
    static_rating: Force | None = Field(None, gt=0, description="basic static load rating C0")
    youngs_modulus: Pressure = Field("210 GPa", gt=0, description="Young's modulus of rings and rollers")
    poisson_ratio: Number = Field(0.3, gt=-1, lt=0.5, description="Poisson's ratio of rings and rollers")
    first_element: Angle = Field("0 deg", description="angle of the first roller from +x towards +y")

    @model_validator(mode="after")
    def _fits(self):
        room = self.pitch_diameter * np.sin(np.pi / self.rollers)
        if self.roller_diameter > room:
            raise SpecError(
                f"{self.rollers} rollers of {1e3 * self.roller_diameter:.4g} mm overlap on a pitch circle of "
                f"{1e3 * self.pitch_diameter:.4g} mm, which leaves {1e3 * room:.4g} mm each. Take fewer or thinner rollers.",
                key="roller_diameter",
            )
        if not abs(self.radial_clearance) < self.roller_diameter:
            raise SpecError(
                f"{1e3 * self.radial_clearance:.4g} mm is more than a roller of {1e3 * self.roller_diameter:.4g} mm is thick; "
                "some hundredths of a millimetre are usual: check the unit.",
                key="radial_clearance",
            )
        return self

    @property
    def curvature_ratio(self) -> float:
        """g = Dw cos(contact_angle)/Dpw."""
        return self.roller_diameter * np.cos(self.contact_angle) / self.pitch_diameter


@by_reference
class RollerLaw(NamedTuple):
    """The numbers of a roller bearing; SI.

    constant k of both contacts of a lamina [N/m^(10/9)]; cosine and sine of the contact angle; cosines and sines of the rollers'
    places (n,); arms (ns,) of the tilt and gaps (ns,) to close before a lamina carries [m]; peak pressure of a lamina at each race
    for 1 N [Pa]; diameter of a roller and the farthest arm [m].
    """

    constant: float
    cosine: float
    sine: float
    cosines: Floats
    sines: Floats
    arms: Floats
    gaps: Floats
    inner_pressure: float
    outer_pressure: float
    diameter: float
    reach: float


@law_of.register(RollerBearing)
@lru_cache(maxsize=1024)
def _(bearing):
    """A point x along the contact from its middle lies at (z, r) = (x cos a, Dpw/2 - x sin a); the tilts move it along the normal
    (sin a, cos a) by (Dpw/2 sin a - x)(tilt_x sin p - tilt_y cos p), wherever on the normal it lies.
    """
    angle, modulus = bearing.contact_angle, _modulus(bearing)
    x, lever = lamina_places(bearing), float(bearing.pitch_diameter / 2 * np.sin(angle))
    places = bearing.first_element + 2 * np.pi * np.arange(bearing.rollers) / bearing.rollers
    inner_pressure, outer_pressure = (
        float(line_contact(1.0, bearing.roller_length / bearing.laminae, radius, modulus).pressure) for radius in contact_radii(bearing)
    )
    return RollerLaw(
        LINE_CONSTANT * modulus * bearing.roller_length ** (8 / 9) / bearing.laminae,
        float(np.cos(angle)),
        float(np.sin(angle)),
        np.cos(places),
        np.sin(places),
        lever - x,
        bearing.radial_clearance / 2 * np.cos(angle) + 2 * profile_drop(bearing, x),
        inner_pressure,
        outer_pressure,
        bearing.roller_diameter,
        lever + bearing.roller_length / 2,
    )


def _modulus(bearing):
    return float(effective_modulus(bearing.youngs_modulus, bearing.poisson_ratio, bearing.youngs_modulus, bearing.poisson_ratio))


def lamina_places(bearing: RollerBearing) -> Floats:
    """Middles x (ns,) [m] of the laminae along the roller, 0 at mid-length."""
    count = bearing.laminae
    return (np.arange(count) - (count - 1) / 2) * bearing.roller_length / count


def profile_drop(bearing: RollerBearing, x: Floats) -> Floats:
    """How far the roller's surface lies back at x [m] from its middle, per contact.

    log: 0.00035 Dw ln(1/(1 - (2x/L)^2)) for rollers up to L = 2.5 Dw; longer ones are straight but for 1.25 Dw at either end, where it
    is 0.0005 Dw ln(1/(1 - u^2)), u from 0 to 1 over the end.  ISO/TS 16281, recalled; the same in a public transcription of it.
    """
    if bearing.profile == "none":
        return np.zeros_like(x)
    diameter, length = bearing.roller_diameter, bearing.roller_length
    if length <= 2.5 * diameter:
        return -0.00035 * diameter * np.log1p(-np.square(2 * x / length))
    into_end = np.maximum(2 * np.abs(x) - (length - 2.5 * diameter), 0.0) / (2.5 * diameter)
    return -0.0005 * diameter * np.log1p(-np.square(into_end))


def contact_radii(bearing: RollerBearing) -> tuple[float, float]:
    """Effective radii (inner, outer) [m] of roller and raceway: Dw (1 -+ g)/2."""
    g = bearing.curvature_ratio
    return bearing.roller_diameter * (1 - g) / 2, bearing.roller_diameter * (1 + g) / 2


@implements(measures, RollerLaw)
def _(law):
    return BearingMeasures(0.01 * law.diameter, law.reach, 0.0, len(law.cosines), len(law.arms))


# ------------------------------------------------------------------------------------------------------------ response


@implements(response, RollerLaw)
def _(law, displacement, force, stiffness):
    """V = sum k 9/19 d^(19/9) over laminae of d = max(n.u + arm t.u - gap, 0): k d^(10/9) is the load, 10/9 k d^(1/9) its slope.

    At a place p the normal is n = (cos a cos p, cos a sin p, sin a), and the tilts count by t = (sin p, -cos p).
    """
    energy = 0.0
    for i in range(5):
        force[i] = 0.0
        for j in range(5):
            stiffness[i, j] = 0.0
    for k in range(len(law.cosines)):
        cos, sin = law.cosines[k], law.sines[k]
        n, t = (law.cosine * cos, law.cosine * sin, law.sine), (sin, -cos)
        normal = n[0] * displacement[0] + n[1] * displacement[1] + n[2] * displacement[2]
        work, load, moment, k0, k1, k2 = _laminae(law, normal, t[0] * displacement[3] + t[1] * displacement[4])
        energy += work
        for i in range(3):
            force[i] += load * n[i]
            for j in range(i + 1):
                stiffness[i, j] += k0 * n[i] * n[j]
        for i in range(2):
            force[3 + i] += moment * t[i]
            for j in range(3):
                stiffness[3 + i, j] += k1 * t[i] * n[j]
            for j in range(i + 1):
                stiffness[3 + i, 3 + j] += k2 * t[i] * t[j]
    for i in range(5):
        for j in range(i):
            stiffness[j, i] = stiffness[i, j]
    return energy


@inner
def _laminae(law, normal, tilt):
    """Sums over the laminae of one roller: energy, load, load x arm, slope, slope x arm, slope x arm^2.

    normal [m] and tilt [rad] of the inner ring at the roller; sums in [J, N, N m, N/m, N, N m].
    """
    energy = q0 = q1 = k0 = k1 = k2 = 0.0
    for i in range(law.arms.shape[0]):
        arm = law.arms[i]
        depth = normal + arm * tilt - law.gaps[i]
        if depth > 0.0:
            slope = law.constant * depth ** (EXPONENT - 1)
            load = slope * depth
            energy += load * depth
            q0 += load
            q1 += load * arm
            k0 += slope
            k1 += slope * arm
            k2 += slope * arm * arm
    return energy / (1 + EXPONENT), q0, q1, EXPONENT * k0, EXPONENT * k1, EXPONENT * k2


@implements(elements, RollerLaw)
def _(law, displacement, loads, angles, pressures, laminae):
    """k d^(10/9) of each lamina, their sum, and p0 = (p0 of 1 N) q^1/2 of the fullest."""
    for k in range(len(law.cosines)):
        cos, sin = law.cosines[k], law.sines[k]
        normal = law.cosine * (cos * displacement[0] + sin * displacement[1]) + law.sine * displacement[2]
        tilt = sin * displacement[3] - cos * displacement[4]
        peak, loads[k] = 0.0, 0.0
        for i in range(len(law.arms)):
            laminae[k, i] = law.constant * max(normal + law.arms[i] * tilt - law.gaps[i], 0.0) ** EXPONENT
            loads[k] += laminae[k, i]
            peak = max(peak, laminae[k, i])
        angles[k] = np.arctan2(law.sine, law.cosine)
        pressures[k, 0] = law.inner_pressure * np.sqrt(peak)
        pressures[k, 1] = law.outer_pressure * np.sqrt(peak)


# ------------------------------------------------------------------------------------------------------------ ratings


def roller_reference_life(bearing: RollerBearing, lamina_loads: ArrayLike) -> float | None:
    """L10r [revolutions] for the loads (n, ns) [N] of the laminae, the inner ring turning; None without a dynamic rating.

    L = 10^6 [sum over laminae (f qi/qci)^4.5 + (f qe/qce)^4.5]^(-8/9), qi = (mean q^4)^(1/4) and qe = (mean q^4.5)^(1/4.5) over the
    rollers, qc = Qc ns^(-7/9)/l.  With the logarithmic profile l = 0.83 and f is `edge_factor`, meant for medium loads and tilts
    below 4'; rollers without a profile keep the share for their edges that C holds: l = 1, f = 1.

    ISO/TS 16281, recalled; a public transcription says the same.  Without profile and clearance it is (C/P)^4 within 2 %, Lundberg
    and Palmgren's law of line contact, from which ISO 281 rounds 10/3; with both it is some three times (C/P)^(10/3) at P = C/10.
    """
    refuse_other(bearing, RollerBearing, "the life by the loads of laminae")
    if bearing.dynamic_rating is None:
        return None
    loads = np.asarray(lamina_loads, dtype=float)
    count = loads.shape[1]
    edge, share = (edge_factor(count), 0.83) if bearing.profile == "log" else (1.0, 1.0)
    inner_limit, outer_limit = roller_capacities(bearing)
    qi, qe = np.mean(loads**4, axis=0) ** (1 / 4), np.mean(loads**4.5, axis=0) ** (1 / 4.5)
    damage = ((edge * qi / inner_limit) ** 4.5 + (edge * qe / outer_limit) ** 4.5) * (share * count ** (7 / 9)) ** 4.5
    return 1e6 * float(np.sum(damage)) ** (-8 / 9) if damage.any() else np.inf


def roller_capacities(bearing: RollerBearing) -> tuple[float, float]:
    """(Qci, Qce) [N]: loads of one roller that inner and outer ring bear for a million turns, by the dynamic rating C.

    Qci = C/(0.378 Z cos a) (1 + h^4.5)^(2/9),  Qce = C/(0.364 Z cos a) (1 + h^-4.5)^(2/9),  h = 1.038 ((1 - g)/(1 + g))^(143/108).
    0.378 and 0.364 are F/(Z q) of a half-loaded circle with the means q of `roller_reference_life`.
    """
    g = bearing.curvature_ratio
    h = 1.038 * ((1 - g) / (1 + g)) ** (143 / 108)
    share = bearing.dynamic_rating / (bearing.rollers * np.cos(bearing.contact_angle))
    return float(share / 0.378 * (1 + h**4.5) ** (2 / 9)), float(share / 0.364 * (1 + h**-4.5) ** (2 / 9))


def edge_factor(count: int) -> Floats:
    """f(k) of the laminae k = 1..ns: 1 - 0.01/ln(1.985 |2k - ns - 1|/(2 ns - 2)), 2.33 at an edge, 1 in the middle."""
    off_middle = np.abs(2 * np.arange(1, count + 1) - count - 1) / max(2 * count - 2, 1)
    with np.errstate(divide="ignore"):  # ln 0 in the middle
        return 1 - 0.01 / np.log(1.985 * off_middle)


def roller_static_rating(bearing: RollerBearing) -> float:
    """C0 [N] by the inner geometry: the fullest roller, loaded by 5 F/(Z cos a), at 4000 MPa against the inner ring.

    With E = 206 GPa it is 44 (1 - g) Z L Dw cos a (N, mm), the formula of ISO 76, recalled.
    """
    refuse_other(bearing, RollerBearing, "this static rating")
    fullest = PERMISSIBLE["line"][0] ** 2 * np.pi * bearing.roller_length * contact_radii(bearing)[0] / _modulus(bearing)
    return float(fullest * bearing.rollers * np.cos(bearing.contact_angle) / PEAK_SHARE)


basic_static_rating.register(RollerBearing)(roller_static_rating)


@life_of.register(RollerBearing)
def _(bearing, state):
    return roller_reference_life(bearing, state.lamina_loads)


@warmer
def warm_roller_bearing() -> None:
    """Compile for `doctor --warm`."""
    warm(RollerBearing(rollers=3, roller_diameter=SI(1.0), roller_length=SI(1.0), pitch_diameter=SI(5.0)), held=("z",))
