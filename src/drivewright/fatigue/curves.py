"""Strain over life, and stress over strain at the root of a notch: scalar formulas and their inversions."""

from typing import NamedTuple

import numpy as np

from drivewright._jit import inner, kernel, warmer
from drivewright._typing import ArrayLike, Floats
from drivewright.errors import InputError
from drivewright.fatigue.material import StrainLife


class Curve(NamedTuple):
    """p = elastic (strength - mean) (2N)^b + plastic (2N)^c: elastic = C1/E [1/Pa], strength = sf' [Pa], plastic = C2 ef' [-]."""

    elastic: float
    strength: float
    b: float
    plastic: float
    c: float


def uniaxial_curve(material: StrainLife) -> Curve:
    """C1 = C2 = 1: p is the strain amplitude."""
    return Curve(
        1 / material.youngs_modulus,
        material.fatigue_strength,
        material.fatigue_strength_exponent,
        material.fatigue_ductility,
        material.fatigue_ductility_exponent,
    )


@inner
def log_root(log_a: float, p: float, log_b: float, q: float, log_total: float) -> float:
    """ln x where a x^p + b x^q = total, with a, b, total > 0 and p, q of one sign.

    In y = ln x the logarithm of the left side is convex.  Either term alone would give a root on one side of the true one, by ln 2
    of the value at most: from the nearer of the two Halley's method, of third order, is never more than twice Newton's step.
    """
    first, second = (log_total - log_a) / p, (log_total - log_b) / q
    y = max(first, second) if p < 0 else min(first, second)
    for _ in range(60):
        u, v = log_a + p * y, log_b + q * y
        share = np.exp(-abs(u - v))  # the smaller term over the larger one
        slope = (p + q * share if u > v else q + p * share) / (1.0 + share)
        newton = (max(u, v) + np.log(1.0 + share) - log_total) / slope
        step = newton / (1.0 - 0.5 * newton * share * ((p - q) / (1.0 + share)) ** 2 / slope)
        y -= step
        if abs(step) <= 1e-5:  # what is left is about its cube
            break
    return y


@inner
def cycle_damage(curve: Curve, parameter: float, mean: float) -> float:
    """1/N of a closed cycle; 0 for none, inf where the mean stress reaches sf' and nothing is left to endure a cycle."""
    if not parameter > 0.0:
        return 0.0
    if mean >= curve.strength:
        return np.inf
    log_a = np.log(curve.elastic * (curve.strength - mean))
    return 2.0 * np.exp(-log_root(log_a, curve.b, np.log(curve.plastic), curve.c, np.log(parameter)))


@kernel
def _damages(curve, parameter, mean):
    """`cycle_damage` of many: parameter (n,) [-], mean (n,) [Pa]."""
    damage = np.empty_like(parameter)
    for i in range(len(parameter)):
        damage[i] = cycle_damage(curve, parameter[i], mean[i])
    return damage


@kernel
def _neuber_stresses(elastic_stress, modulus, strength, exponent):
    """s (n,) [Pa] of s^2/E + s (s/K')^(1/n') = s_el^2/E for elastic stresses s_el (n,) [Pa]: Neuber's rule."""
    stress = np.zeros_like(elastic_stress)
    for i in range(len(stress)):
        if elastic_stress[i] != 0.0:
            energy = np.log(elastic_stress[i] ** 2 / modulus)
            y = log_root(np.log(strength**2 / modulus), 2.0, np.log(strength), 1.0 + 1.0 / exponent, energy)
            stress[i] = np.copysign(strength * np.exp(y), elastic_stress[i])
    return stress


def strain_at_life(life: ArrayLike, material: StrainLife, mean_stress: ArrayLike = 0.0) -> Floats:
    """Strain amplitude e_a = (sf' - s_m)/E (2N)^b + ef' (2N)^c that is endured for `life` N > 0 cycles.  Arrays broadcast.

    mean_stress s_m [Pa] after Morrow: tension shortens, compression lengthens the elastic part, in full.  It must lie below sf'.
    """
    life, mean = _numbers("strain_at_life", "life", life), _numbers("strain_at_life", "mean_stress", mean_stress)
    if np.any(life <= 0):
        raise InputError(f"strain_at_life: lives must be above 0, got {np.min(life):.6g}.")
    if np.any(mean >= material.fatigue_strength):
        raise InputError(
            f"strain_at_life: a mean stress of {np.max(mean) / 1e6:.6g} MPa leaves no strain amplitude; "
            f"it must stay below fatigue_strength, {material.fatigue_strength / 1e6:.6g} MPa."
        )
    elastic = (material.fatigue_strength - mean) / material.youngs_modulus * (2 * life) ** material.fatigue_strength_exponent
    return elastic + material.fatigue_ductility * (2 * life) ** material.fatigue_ductility_exponent


def life_at_strain(amplitude: ArrayLike, material: StrainLife, mean_stress: ArrayLike = 0.0) -> Floats:
    """Life N in cycles at a strain amplitude >= 0, the inverse of `strain_at_life`: inf at 0, 0 where mean_stress reaches sf'."""
    amplitude, mean = _numbers("life_at_strain", "amplitude", amplitude), _numbers("life_at_strain", "mean_stress", mean_stress)
    if np.any(amplitude < 0):
        raise InputError(f"life_at_strain: amplitudes must not be negative, got {np.min(amplitude):.6g}.")
    amplitude, mean = np.broadcast_arrays(amplitude, mean)
    damage = _damages(uniaxial_curve(material), amplitude.ravel(), mean.ravel()).reshape(amplitude.shape)
    with np.errstate(divide="ignore"):
        return np.divide(1.0, damage)


def ramberg_osgood(stress: ArrayLike, material: StrainLife) -> Floats:
    """Strain on the cyclic curve, e = s/E + sign(s) (|s|/K')^(1/n'), of stress amplitudes [Pa]; odd in s.  Ramberg and Osgood."""
    stress = _numbers("ramberg_osgood", "stress", stress)
    plastic = (np.abs(stress) / material.strength_coefficient) ** (1 / material.hardening_exponent)
    return stress / material.youngs_modulus + np.copysign(plastic, stress)


class NotchStress(NamedTuple):
    """Stress [Pa] and strain where the material yields."""

    stress: Floats
    strain: Floats


def neuber(elastic_stress: ArrayLike, material: StrainLife) -> NotchStress:
    """`NotchStress`: stress and strain amplitude at a notch whose elastic stress amplitude [Pa] is known; any shape, odd.

    Neuber's rule s e = s_el^2/E on the cyclic curve of `ramberg_osgood`.
    """
    elastic = _numbers("neuber", "elastic_stress", elastic_stress)
    stress = _neuber_stresses(elastic.ravel(), material.youngs_modulus, material.strength_coefficient, material.hardening_exponent)
    stress = stress.reshape(elastic.shape)[()]
    return NotchStress(stress, ramberg_osgood(stress, material))


def _numbers(function, name, values):
    """A finite array of floats."""
    try:
        array = np.asarray(values, dtype=float)
    except (TypeError, ValueError):
        raise InputError(f"{function}: {name} must be a number or an array of numbers.") from None
    if not np.all(np.isfinite(array)):
        raise InputError(f"{function}: {name} must be finite, got {array[~np.isfinite(array)].flat[0]}.")
    return array


@warmer
def warm_curves() -> None:
    """Compile for `doctor --warm`."""
    one = np.ones(1)
    _damages(Curve(1.0, 1.0, -0.1, 1.0, -0.5), one, 0 * one)
    _neuber_stresses(one, 1.0, 1.0, 0.2)
