"""Curvature and extremes of oscillating followers for many designs: what the jets give, on plain complex numbers."""

from typing import NamedTuple

import numpy as np

from drivewright._jit import kernel
from drivewright._typing import Floats


@kernel
def rest_cosine(prime: float, pivot: float, arm: float) -> float:
    """Cosine of the arm's angle at zero lift, from prime radius, pivot distance and arm length [m]."""
    return (pivot**2 + arm**2 - prime**2) / (2 * pivot * arm)


@kernel
def pitch_curvature(pivot: float, arm: float, q1: float, q2: float, w1: float, w2: float, u: complex) -> float:
    """Im(conj(B') B'')/|B'|^3 of B = -i a' e^{iq} + i l e^{iw}, u = e^{i(w - q)}, seen in the frame that turns with q  [1/m].

    pivot, arm [m]; q1, q2, w1, w2: derivatives of q and w [rad] by the driving angle.
    """
    first = pivot * q1 - arm * w1 * u
    second = pivot * complex(q2, q1 * q1) - arm * complex(w2, w1 * w1) * u
    size = first.real**2 + first.imag**2
    return (np.conj(first) * second).imag / (size * np.sqrt(size))


@kernel
def sampled_peak(values: Floats) -> float:
    """Greatest value of a function from its samples (m,), by the parabola through its top three samples."""
    top = np.argmax(values)
    if top == 0 or top == values.shape[0] - 1:
        return values[top]
    before, here, after = values[top - 1], values[top], values[top + 1]
    curvature = before - 2 * here + after
    return here - (after - before) ** 2 / (8 * curvature) if curvature < 0 else here


class ConjugateLever(NamedTuple):
    """A lever between a main and a return cam: pivot distance, both roller arms and the arm to the line of its output [m], and
    e^{i psi0} of both roller arms at zero lift, against the line of centres."""

    pivot_distance: float
    main_arm: float
    return_arm: float
    output_arm: float
    main: complex
    back: complex


@kernel
def conjugate_lever(
    pivot_distance: float, main_arm: float, return_arm: float, output_arm: float, main_prime: float, return_prime: float
) -> ConjugateLever:
    """The lever by the prime radii of its cams, all [m]; an arm that does not reach its cam has a cosine beyond 1."""
    cos_main, cos_return = rest_cosine(main_prime, pivot_distance, main_arm), rest_cosine(return_prime, pivot_distance, return_arm)
    main = complex(cos_main, np.sqrt(max(1 - cos_main**2, 0.0)))
    back = complex(cos_return, np.sqrt(max(1 - cos_return**2, 0.0)))
    return ConjugateLever(pivot_distance, main_arm, return_arm, output_arm, main, back)


@kernel
def can_swing(lever: ConjugateLever, swing: float) -> bool:
    """Whether both arms reach their cams and a swing [rad] takes neither onto its dead point."""
    cos_main, cos_return = lever.main.real, lever.back.real
    return abs(cos_main) < 1 and abs(cos_return) < 1 and np.arccos(cos_main) + swing < np.pi and np.arccos(cos_return) > swing


@kernel
def main_pitch_radius(lever: ConjugateLever, swing: float) -> float:
    """Radius of the main cam's pitch curve [m] at a swing [rad] of the lever."""
    pivot, arm = lever.pivot_distance, lever.main_arm
    return np.sqrt(pivot**2 + arm**2 - 2 * pivot * arm * (lever.main * np.exp(1j * swing)).real)


@kernel
def conjugate_extremes(
    lever: ConjugateLever, stroke: float, width: float, way: int, orbit: float, p1: Floats, p2: Floats, s: Floats, v: Floats, a: Floats
) -> tuple[float, float]:
    """(greatest tan of the pressure angle [-], greatest convex curvature [1/m]) of both pitch curves over a rise (`way` +1) or return (-1).

    stroke [m] of the output over a driving angle `width` [rad] by the motion law s, v, a (n,) [-]; the pivot orbits the cams in the
    sense `orbit` (+1 counter-clockwise) at the rates p1 (n,) [-] and p2 (n,) [1/rad], magnitudes, by the driving angle.
    """
    arm, pivot = lever.output_arm, lever.pivot_distance
    n = s.shape[0]
    steep_main, steep_back = np.zeros(n), np.zeros(n)
    curvature_main, curvature_back = np.zeros(n), np.zeros(n)
    for i in range(n):
        g = stroke * (s[i] if way > 0 else 1 - s[i])
        g1, g2 = way * stroke * v[i] / width, way * stroke * a[i] / width**2
        square = 1 / (arm * arm + g * g)
        f, f1 = arm * g1 * square, arm * square * (g2 - 2 * g * g1 * g1 * square)
        unit = complex(arm, g) * np.sqrt(square)  # e^{i swing}
        q1, q2 = orbit * p1[i], orbit * p2[i]
        psi_main, psi_back = lever.main * unit, lever.back * np.conj(unit)
        curvature_main[i] = orbit * pitch_curvature(pivot, lever.main_arm, q1, q2, q1 - f, q2 - f1, np.conj(psi_main))
        curvature_back[i] = orbit * pitch_curvature(pivot, lever.return_arm, q1, q2, q1 - f, q2 - f1, psi_back)
        steep_main[i] = abs((lever.main_arm * (1 - f / q1) - pivot * psi_main.real) / (pivot * psi_main.imag))
        steep_back[i] = abs((lever.return_arm * (1 - f / q1) - pivot * psi_back.real) / (pivot * psi_back.imag))
    return max(sampled_peak(steep_main), sampled_peak(steep_back)), max(sampled_peak(curvature_main), sampled_peak(curvature_back))
