"""Two bearings and a uniform shaft: flexibility and reactions in closed form, for stations anywhere along it.

A station on an overhang is its support, moved out by a lever: what it bends is the span under a couple at that support, and the overhang
as a cantilever.  With x measured from the left support, span L, y = x held within 0 ... L and overhangs a = max(-x, 0), b = max(x - L, 0),

    delta(x, s) EI = G(y, t) - a p(t) - a' p(y) - b q(t) - b' q(y) + (a a' + b b') L/3 + (a b' + a' b) L/6 + c(a, a') + c(b, b')
    delta(x, s) kappa G A = low (L - high)/L + (a - b)(a' - b')/L + min(a, a') + min(b, b')

where t, a', b' belong to s, low and high are the lesser and the greater of y and t, and

    G = low (L - high) [high^2 - low^2 + 2 high (L - high)] / 6L      a force within the span
    p = y (L - y)(2L - y) / 6L,   q = y (L - y)(L + y) / 6L           the slope at the left, right support under it
    c = m^2 (3 m' - m) / 6,  m <= m'                                  the cantilever.

Nothing is subtracted that could cancel, so short overhangs keep all their digits.  `influence_coefficient` is this formula, for a kernel's
scalars and, through `plain`, for arrays.
"""

import numpy as np

from drivewright._jit import inner, plain
from drivewright._typing import ArrayLike, Floats
from drivewright.errors import InputError


@inner
def influence_coefficient(x: float, s: float, span: float, bend: float, slip: float) -> float:
    """Deflection at x under a unit force at s on rigid supports  [m/N]; x, s from the left support, bend = 1/EI, slip = 1/(kappa G A)."""
    part = 1.0 / span
    y, t = np.minimum(np.maximum(x, 0.0), span), np.minimum(np.maximum(s, 0.0), span)
    a, b, a2, b2 = np.maximum(-x, 0.0), np.maximum(x - span, 0.0), np.maximum(-s, 0.0), np.maximum(s - span, 0.0)
    low, high = np.minimum(y, t), np.maximum(y, t)
    inside = low * (span - high)
    within = inside * ((high - low) * (high + low) + 2.0 * high * (span - high))
    steep, steep2 = y * (span - y), t * (span - t)
    lever = a * steep2 * (2.0 * span - t) + a2 * steep * (2.0 * span - y) + b * steep2 * (span + t) + b2 * steep * (span + y)
    couples = (2.0 * (a * a2 + b * b2) + a * b2 + a2 * b) * span
    near_a, far_a, near_b, far_b = np.minimum(a, a2), np.maximum(a, a2), np.minimum(b, b2), np.maximum(b, b2)
    cantilever = near_a * near_a * (3.0 * far_a - near_a) + near_b * near_b * (3.0 * far_b - near_b)
    bending = ((within - lever) * part + couples + cantilever) / 6.0
    return bend * bending + slip * ((inside + (a - b) * (a2 - b2)) * part + near_a + near_b)


@inner
def reaction_shares(x: float, span: float) -> tuple[float, float]:
    """What the left and the right support carry of a unit force at x, measured from the left one."""
    part = 1.0 / span
    return (span - x) * part, x * part


@inner
def flexibility_entry(x: float, s: float, span: float, bend: float, slip: float, left_give: float, right_give: float) -> float:
    """`influence_coefficient` and what the supports yield [m/N], rA rA'/kA + rB rB'/kB: a Gram matrix; a softer bearing never stiffens."""
    left, right = reaction_shares(x, span)
    left2, right2 = reaction_shares(s, span)
    return influence_coefficient(x, s, span, bend, slip) + left * left2 * left_give + right * right2 * right_give


def flexibility(
    stations: ArrayLike, supports: ArrayLike, radial_stiffness: ArrayLike, bending_stiffness: ArrayLike, shear_stiffness: ArrayLike = np.inf
) -> Floats:
    """(..., M, M) deflections at the stations under unit forces there  [m/N].

    stations (..., M) and supports (..., 2): places along the shaft [m]; radial_stiffness (..., 2) [N/m], inf is rigid;
    bending_stiffness EI [N m^2] and shear_stiffness kappa G A [N] (inf: Euler-Bernoulli) broadcast with the leading axes.
    """
    supports, stiffness = np.asarray(supports, dtype=float), np.asarray(radial_stiffness, dtype=float)
    for name, values, count in (("supports", supports, 2), ("radial_stiffness", stiffness, 2)):
        if values.shape[-1:] != (count,):
            raise InputError(f"{name}: the closed form has two bearings, so the last axis must be 2; got the shape {values.shape}.")
    order = np.argsort(supports, axis=-1)
    left, right = np.moveaxis(np.take_along_axis(supports, order, -1), -1, 0)
    stiffness = np.take_along_axis(np.broadcast_to(stiffness, np.broadcast_shapes(stiffness.shape, order.shape)), order, -1)
    _refuse("supports: the two bearings", right - left, "stand at one place; move them apart")
    for name, values in (("radial_stiffness", stiffness), ("bending_stiffness", bending_stiffness), ("shear_stiffness", shear_stiffness)):
        _refuse(f"{name}:", np.asarray(values, dtype=float), "is not above 0; a support that carries nothing must be left out")
    x = np.asarray(stations, dtype=float) - left[..., None]
    # Two axes more at the end, for the two stations of an entry.
    span, bend, slip = ((np.asarray(each, dtype=float))[..., None, None] for each in (right - left, bending_stiffness, shear_stiffness))
    give = 1.0 / stiffness[..., None, None, :]
    return plain(flexibility_entry)(x[..., :, None], x[..., None, :], span, 1.0 / bend, 1.0 / slip, give[..., 0], give[..., 1])


def _refuse(what, values, why):
    """Raise where a value is not positive."""
    if not np.all(values > 0.0):
        raise InputError(f"{what} {np.ravel(values)[~(np.ravel(values) > 0.0)][0]:g} {why}.")
