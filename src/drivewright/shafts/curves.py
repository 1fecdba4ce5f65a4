"""Supports whose radial force is a curve of the radial displacement, the same all round: a play, a measured table."""

from typing import NamedTuple

import numpy as np

from drivewright._jit import implements, warmer
from drivewright._typing import ArrayLike, Floats
from drivewright.bearings.response import evaluate_response, response
from drivewright.errors import InputError


class RadialCurve(NamedTuple):
    """F(r) by cubic pieces: over r[i] it is c[i, 0] + c[i, 1] s + c[i, 2] s^2 + c[i, 3] s^3, s = r - r[i]; the last runs on for ever.

    `energy` is the integral of F up to every r[i].
    """

    r: Floats
    c: Floats
    energy: Floats


@implements(response, RadialCurve)
def _(law, displacement, force, stiffness):
    """V = int F dr with r^2 = x^2 + y^2:  force F n,  stiffness F' n n' + F/r (I - n n')."""
    force[:] = 0.0
    stiffness[:] = 0.0
    x, y = displacement[0], displacement[1]
    radius = np.sqrt(x * x + y * y)
    i = len(law.r) - 1
    while i > 0 and radius < law.r[i]:
        i -= 1
    s = radius - law.r[i]
    value = law.c[i, 0] + s * (law.c[i, 1] + s * (law.c[i, 2] + s * law.c[i, 3]))
    slope = law.c[i, 1] + s * (2.0 * law.c[i, 2] + 3.0 * s * law.c[i, 3])
    energy = law.energy[i] + s * (law.c[i, 0] + s * (law.c[i, 1] / 2.0 + s * (law.c[i, 2] / 3.0 + s * law.c[i, 3] / 4.0)))
    secant = value / radius if radius > 0.0 else slope
    nx, ny = (x / radius, y / radius) if radius > 0.0 else (1.0, 0.0)
    force[0], force[1] = value * nx, value * ny
    stiffness[0, 0] = slope * nx * nx + secant * ny * ny
    stiffness[1, 1] = slope * ny * ny + secant * nx * nx
    stiffness[0, 1] = (slope - secant) * nx * ny
    stiffness[1, 0] = stiffness[0, 1]
    return energy


def with_play(stiffness: float, clearance: float) -> RadialCurve:
    """A spring [N/m] that is met after a radial clearance [m]."""
    return RadialCurve(np.array([0.0, clearance]), np.array([[0.0] * 4, [0.0, stiffness, 0.0, 0.0]]), np.zeros(2))


def tabulated(displacement: ArrayLike, force: ArrayLike) -> RadialCurve:
    """A table of radial force over radial displacement, both rising from 0; in between a monotone cubic, beyond it a straight line.

    InputError where the table does not start at 0 or does not rise.
    """
    from scipy.interpolate import PchipInterpolator

    r, f = np.asarray(displacement, float), np.asarray(force, float)
    if len(r) < 2 or r[0] != 0 or f[0] != 0 or np.any(np.diff(r) <= 0) or np.any(np.diff(f) < 0):
        raise InputError("a bearing's table needs at least two rows that start at displacement 0 and force 0 and rise from row to row")
    curve = PchipInterpolator(r, f)
    pieces = curve.c[::-1].T
    last = [f[-1], float(curve(r[-1], 1)), 0.0, 0.0]
    energy = np.concatenate([[0.0], np.cumsum([curve.integrate(a, b) for a, b in zip(r[:-1], r[1:], strict=True)])])
    return RadialCurve(r, np.ascontiguousarray(np.vstack([pieces, last])), energy)


class LinearSupport(NamedTuple):
    """A linear support with all its couplings: K (5, 5)  [N/m, N/rad, N m/rad]; one that is not symmetric has no energy."""

    k: Floats


@implements(response, LinearSupport)
def _(law, displacement, force, stiffness):
    """F = K u,  V = 1/2 u'K u of the symmetric part."""
    energy = 0.0
    for i in range(5):
        force[i] = 0.0
        for j in range(5):
            stiffness[i, j] = law.k[i, j]
            force[i] += law.k[i, j] * displacement[j]
        energy += 0.5 * force[i] * displacement[i]
    return energy


@warmer
def warm_supports() -> None:
    """Compile for `doctor --warm`."""
    evaluate_response(with_play(1.0, 1.0), np.zeros(5))
    evaluate_response(LinearSupport(np.eye(5)), np.zeros(5))
