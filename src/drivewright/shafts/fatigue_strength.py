"""Safety of a section of a rotating shaft against fatigue and against yield: Marin factors, notch sensitivity, Goodman's line.

Budynas and Nisbett, Shigley's Mechanical Engineering Design, 9th ed., chapters 6 and 7 (numbers of equations and pages from there).  The
shaft turns under loads that stand still, so bending alternates and an axial force is steady; the torque is as `Service.torsion` says.
Infinite life; no corrosion, no heat, no fretting beyond what a notch factor was measured with.
"""

import math
from statistics import NormalDist
from typing import NamedTuple

from drivewright.errors import InputError, UnknownName
from drivewright.materials import Strength
from drivewright.shafts.notches import Notch, NotchFactors, kind_of, measured_factors, root_radius, stress_concentration

MM, MPA, INCH, KPSI = 1e-3, 1e6, 25.4e-3, 6.894757e6
SURFACES = {"ground": (1.58, -0.085), "machined": (4.51, -0.265), "hot-rolled": (57.7, -0.718), "forged": (272.0, -0.995)}  # p. 345
TORSIONS = {"constant": (0.0, 1.0), "pulsating": (0.5, 0.5), "alternating": (1.0, 0.0)}  # (amplitude, mean) over the largest torque
NO_STRESS = 1e-9  # of the yield strength: rounding


class Service(NamedTuple):
    """What the shaft goes through: torque "constant", "pulsating" (from 0) or "alternating"; shock over steady load, for yield;
    surface "ground", "machined" (or cold-drawn), "hot-rolled" or "forged"; reliability of the endurance limit."""

    torsion: str = "constant"
    shock_factor: float = 1.0
    surface: str = "machined"
    reliability: float = 0.99


class NominalStress(NamedTuple):
    """Nominal stresses [Pa] of a section by bending, by an axial force and by the torque; magnitudes."""

    bending: float
    tension: float
    torsion: float


class StrengthSection(NamedTuple):
    """A section to be judged: the notch there, outer diameter of the shaft beside it, of the net section, bore [m], and the stress."""

    notch: Notch
    outer: float
    diameter: float
    bore: float
    nominal: NominalStress


class SectionStrength(NamedTuple):
    """How a section stands: nominal amplitudes and means [Pa], fatigue notch factors [-], endurance limit [Pa] of the smooth section, von
    Mises stresses [Pa] `amplitude` and `mean` at the notch, and safeties; inf where there is no stress."""

    name: str
    kind: str
    position: float
    diameter: float
    sigma_a: float
    sigma_m: float
    tau_a: float
    tau_m: float
    kf_tension: float
    kf_bending: float
    kf_torsion: float
    endurance_limit: float
    amplitude: float
    mean: float
    fatigue_safety: float
    static_safety: float
    source: str

    @property
    def safety(self) -> float:
        """The lesser safety."""
        return min(self.fatigue_safety, self.static_safety)


def endurance_limit(tensile: float, diameter: float, surface: str = "machined", reliability: float = 0.99) -> float:
    """Se = ka kb ke Se' [Pa] of a smooth rotating shaft of steel: tensile strength [Pa], diameter [m].

    Se' = 0.5 Rm up to 700 MPa (6-8); ka = a Rm^b of the surface, at most 1 (6-19); kb = 1.24 d^-0.107 up to 51 mm, then 1.51 d^-0.157
    (6-20); ke = 1 - 0.08 z of the reliability (6-29).
    """
    if surface not in SURFACES:
        raise UnknownName("surface of a shaft", surface, SURFACES)
    if not 0.5 <= reliability < 1:
        raise InputError(f"reliability of the endurance limit: {reliability:g} is outside 0.5 to below 1; take 0.9 or 0.99.")
    a, b = SURFACES[surface]
    by_surface = min(a * (tensile / MPA) ** b, 1.0)
    by_reliability = 1 - 0.08 * NormalDist().inv_cdf(reliability)
    return by_surface * _size_factor(diameter / MM) * by_reliability * min(0.5 * tensile, 700 * MPA)


def _size_factor(millimetres: float) -> float:
    """kb (6-20); below 2.79 mm that of 2.79 mm, beyond 254 mm extrapolated."""
    return 1.24 * max(millimetres, 2.79) ** -0.107 if millimetres <= 51 else 1.51 * millimetres**-0.157


def notch_sensitivity(radius: float, tensile: float, torsion: bool = False) -> float:
    """q = 1/(1 + sqrt(a/r)) [-] of steel with Neuber's constant a by the tensile strength [Pa], from 50 to 250 kpsi (6-34, 6-35)."""
    s = min(max(tensile / KPSI, 50.0), 250.0)
    bending = 0.246 - 3.08e-3 * s + 1.51e-5 * s**2 - 2.67e-8 * s**3
    twisting = 0.190 - 2.51e-3 * s + 1.35e-5 * s**2 - 2.67e-8 * s**3
    return 1 / (1 + (twisting if torsion else bending) / math.sqrt(radius / INCH))


def fatigue_notch_factors(notch: Notch, outer: float, bore: float, strength: Strength) -> NotchFactors:
    """Kf [-]: as measured, else 1 + q (Kt - 1) (6-32)."""
    measured = measured_factors(notch, outer, strength)
    if measured:
        return measured
    elastic, radius = stress_concentration(notch, outer, bore), root_radius(notch)
    if radius is None:
        return elastic
    q, q_torsion = notch_sensitivity(radius, strength.tensile), notch_sensitivity(radius, strength.tensile, torsion=True)
    return NotchFactors(1 + q * (elastic.tension - 1), 1 + q * (elastic.bending - 1), 1 + q_torsion * (elastic.torsion - 1), elastic.source)


def strength_at(section: StrengthSection, strength: Strength, service: Service = Service()) -> SectionStrength:
    """The `SectionStrength` of a section."""
    factors = fatigue_notch_factors(section.notch, section.outer, section.bore, strength)
    limit = endurance_limit(strength.tensile, section.diameter, service.surface, service.reliability)
    return judge(section, factors, limit, strength, service)


def judge(section: StrengthSection, factors: NotchFactors, limit: float, strength: Strength, service: Service) -> SectionStrength:
    """The `SectionStrength` with given fatigue notch factors and a given endurance limit [Pa] of the smooth section.

    s_a = sqrt((Kfb sb)^2 + 3 (Kfs t_a)^2), s_m = sqrt((Kft st)^2 + 3 (Kfs t_m)^2)   (6-55, 6-56),
    fatigue: 1/n = s_a/Se + s_m/Rm (6-46, modified Goodman); yield: n = Re/(shock sqrt((Kfb sb + Kft st)^2 + 3 (Kfs t)^2))   (7-15, 7-16).
    """
    if service.torsion not in TORSIONS:
        raise UnknownName("way in which the torque acts", service.torsion, TORSIONS)
    nominal = section.nominal
    tau_a, tau_m = (share * nominal.torsion for share in TORSIONS[service.torsion])
    bending, tension = factors.bending * nominal.bending, factors.tension * nominal.tension
    amplitude, mean = von_mises(bending, factors.torsion * tau_a), von_mises(tension, factors.torsion * tau_m)
    peak = service.shock_factor * von_mises(bending + tension, factors.torsion * nominal.torsion)
    unstressed = peak < NO_STRESS * strength.yield_strength
    return SectionStrength(
        section.notch.name,
        kind_of(section.notch),
        section.notch.position,
        section.diameter,
        nominal.bending,
        nominal.tension,
        tau_a,
        tau_m,
        *factors[:3],
        limit,
        amplitude,
        mean,
        math.inf if unstressed else 1 / (amplitude / limit + mean / strength.tensile),
        math.inf if unstressed else strength.yield_strength / peak,
        factors.source,
    )


def von_mises(normal: float, shear: float) -> float:
    """sqrt(s^2 + 3 t^2) [Pa]."""
    return math.sqrt(normal**2 + 3 * shear**2)
