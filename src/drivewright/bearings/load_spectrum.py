"""Lives of a duty cycle: mean speed and load, Palmgren and Miner's sum, and the life of a system of several bearings.

In steps of constant load and speed, with the shares q of the time: n_m = sum q n, P_m = (sum q n P^p/sum q n)^(1/p), the formulas of the
makers (NSK, "Average of fluctuating load"; SEED guide, rolling element bearings, 4.4).
"""

from collections.abc import Sequence

import numpy as np

from drivewright._typing import ArrayLike, Floats
from drivewright.errors import InputError

WHOLE = 2e-3  # within which shares of the time sum to 1: three of 0.333 do
STEPS = 50  # of Newton's method; each doubles the digits
SLOPES = {"point": 10 / 9, "line": 9 / 8}  # Weibull's slope of lives, Lundberg and Palmgren; ISO 281


def checked_shares(shares: ArrayLike) -> Floats:
    """Shares of the time (n,), together 1; InputError unless each is at least 0 and all together are 1 but for rounding."""
    array = np.asarray(shares, dtype=float)
    if array.ndim != 1 or not len(array) or not np.all(array >= 0) or abs(array.sum() - 1) > WHOLE:
        raise InputError(
            f"duty cycle: the shares of the time must be at least 0 and sum to 1, got {', '.join(f'{each:.6g}' for each in array.flat)} "
            f"with the sum {array.sum():.6g}."
        )
    return array / array.sum()


def mean_speed(shares: ArrayLike, speeds: ArrayLike) -> float:
    """n_m = sum q |n|, in the unit of the speeds."""
    return float(checked_shares(shares) @ np.abs(speeds))


def mean_load(shares: ArrayLike, speeds: ArrayLike, loads: ArrayLike, exponent: float) -> float:
    """P_m [N] under which a bearing lasts as many revolutions: (sum q n P^p/sum q n)^(1/p); loads at least 0, p of the life."""
    weights, sizes = checked_shares(shares) * np.abs(speeds), np.asarray(loads, dtype=float)
    if not weights.sum() > 0:
        raise InputError("duty cycle: all speeds are 0; give at least one case a speed.")
    peak = sizes.max()
    return float(peak * (weights @ (sizes / peak) ** exponent / weights.sum()) ** (1 / exponent)) if peak > 0 else 0.0


def spectrum_life(shares: ArrayLike, lives: ArrayLike) -> float:
    """Life [s] of a duty cycle from the lives [s] of its cases, each as if it went on for ever: 1/L = sum q/L, Palmgren and Miner."""
    with np.errstate(divide="ignore"):
        rate = float(checked_shares(shares) @ (1 / np.asarray(lives, dtype=float)))
    return 1 / rate if rate > 0 else np.inf


def system_life(lives: Sequence[float], slopes: Sequence[float]) -> float:
    """Life [of the lives' unit] that all of several bearings reach with the reliability that each single life has.

    Each survives a time t with the probability S^((t/L)^e), Weibull's slope e; all of them with the product, so that t solves
    sum (t/L_i)^e_i = 1.  With one slope it is (sum L_i^-e)^(-1/e); else ln t by Newton's method on the convex ln of the sum.
    """
    given, powers = np.asarray(lives, dtype=float), np.asarray(slopes, dtype=float)
    if given.shape != powers.shape or not np.all(given > 0):
        raise InputError("bearing: the life of a system needs a life above 0 and a slope for every bearing.")
    fails = np.isfinite(given)
    if not fails.any():
        return np.inf
    ends, powers = np.log(given[fails]), powers[fails]
    time = ends.min()
    for _ in range(STEPS):
        shares = np.exp(powers * (time - ends))
        step = np.log(shares.sum()) * shares.sum() / (powers @ shares)
        time -= step
        if abs(step) < 1e-15 * max(1.0, abs(time)):
            break
    return float(np.exp(time))
