"""Sliding friction at a pin, for kernels: scalars in, the friction force [N] out.

One sign convention: `slip` [m/s] is the sliding speed of one surface over the other along a tangent, the force has the sign of the
slip, and acts with the opposite sign on the surface that slides: force * slip >= 0 is the power lost.  normal [N] >= 0.
"""

import numpy as np

from drivewright._jit import kernel


@kernel
def coulomb(coefficient: float, normal: float, slip: float, speed: float) -> float:
    """T = mu N tanh(v/v_d): dry friction, smoothed below the speed v_d > 0 [m/s] (76 % of it at v_d)."""
    return coefficient * normal * np.tanh(slip / speed)


@kernel
def ambrosio(coefficient: float, normal: float, slip: float, low: float, high: float) -> float:
    """T = mu N sign(v) r: the ramp r is 0 below the speed `low`, 1 above `high`, linear between; 0 <= low <= high [m/s].

    Ambrosio, in Virtual Nonlinear Multibody Systems (2003), recalled.
    """
    size = abs(slip)
    if size <= low:
        return 0.0
    ramp = 1.0 if size >= high else (size - low) / (high - low)
    return coefficient * normal * ramp * np.sign(slip)


@kernel
def stribeck(slip: float, coefficient: float, static_coefficient: float, speed: float) -> float:
    """Coefficient of steady dry sliding: g = mu + (mu_s - mu) exp(-(v/v_s)^2)."""
    return coefficient + (static_coefficient - coefficient) * np.exp(-((slip / speed) ** 2))


@kernel
def lugre_rate(
    deflection: float, slip: float, bristle_stiffness: float, coefficient: float, static_coefficient: float, stribeck_speed: float
) -> float:
    """z' = v - s0 |v| z/g(v)  [m/s]: how the bristles' mean deflection z [m] follows the slip.

    s0 [1/m] is the friction force over the normal force per deflection; both coefficients above 0.  |z| never grows beyond mu_s/s0
    (mu_s >= mu).  The state goes back to 0 where the contact is lost.
    Canudas de Wit, Olsson, Astrom & Lischinsky, IEEE Trans. Automatic Control 40 (1995), recalled.
    """
    return slip - bristle_stiffness * abs(slip) * deflection / stribeck(slip, coefficient, static_coefficient, stribeck_speed)


@kernel
def lugre(
    deflection: float, rate: float, slip: float, normal: float, bristle_stiffness: float, bristle_damping: float, viscous: float
) -> float:
    """T = N (s0 z + s1 z' + s2 v), with z' from `lugre_rate`; s0 [1/m], s1 and s2 [s/m], all per normal force."""
    return normal * (bristle_stiffness * deflection + bristle_damping * rate + viscous * slip)
