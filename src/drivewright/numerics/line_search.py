"""How far to go along a step of Newton's method on a convex function."""

from collections.abc import Callable

import numpy as np

from drivewright._typing import Floats

LIMIT = 50  # looks along a step
SPENT = 0.5  # of the slope at the start that may be left
KEPT_OFF = 0.1  # of a bracket: what lies so near to its ends is not looked at


def convex_step_length(slope: Callable[[Floats], Floats], count: int = 1) -> Floats:
    """Share (count,) of a step, 1 or less, at which each of so many convex functions along it has lost half of its slope.

    slope: of the functions at shares (count,); where it rises from the start, but for rounding at rest, the share is 1.  A bracket by the
    slope is narrowed by the secant, kept off its ends.
    """
    low, share = np.zeros(count), np.ones(count)
    low_slope, high, high_slope = slope(low), np.ones(count), np.zeros(count)
    steep, flat = np.abs(low_slope), low_slope >= 0
    for _ in range(LIMIT):
        here = slope(share)
        done = flat | (np.abs(here) <= SPENT * steep) | ((here <= 0) & (share == 1.0))
        if done.all():
            break
        short, long = ~done & (here < 0), ~done & (here >= 0)
        low, low_slope = np.where(short, share, low), np.where(short, here, low_slope)
        high, high_slope = np.where(long, share, high), np.where(long, here, high_slope)
        part = -low_slope / np.where(done, 1.0, high_slope - low_slope)
        share = np.where(done, share, low + (high - low) * np.clip(part, KEPT_OFF, 1 - KEPT_OFF))
    return share
