"""Where a batch of elastic systems comes to rest: Newton's method with a line search on the convex energy, all positions at once.

The energy of y is 1/2 y' A y + sum V_k(R_k y + o_k) - f'y: linear parts A, and laws V_k of strains that depend linearly on y.
"""

from typing import Any, NamedTuple

import numpy as np

TOLERANCE = 1e-13  # of the residual over the load
ROUNDING = 32 * np.finfo(float).eps
MOST_STEPS = 200
FLOOR = 1e-13  # of the largest stiffness, under what nothing resists
SOFTEN = 1e-2  # of a usual stiffness, times the residual over the load: far from rest no step runs away, near it all stays quadratic
HALVINGS = 50


def stacked(rows):
    """(p, n, m): rows (p, ..., m) one below the other, also where p is 0."""
    return rows.reshape(len(rows), int(np.prod(rows.shape[1:-1])), rows.shape[-1])


class Part(NamedTuple):
    """rows (p, k, c, m), offset (p, k, c) of the strains, and the law of them."""

    rows: np.ndarray
    offset: np.ndarray
    law: Any

    def strain(self, y):
        """(p, k, c)."""
        return self.moved(y) + self.offset

    def moved(self, y):
        """The part of the strains that follows y: (p, k, c)."""
        return (stacked(self.rows) @ y[:, :, None]).reshape(self.rows.shape[:3])


class System(NamedTuple):
    """linear (p, m, m), parts, load (p, m)."""

    linear: np.ndarray
    parts: tuple
    load: np.ndarray


class Rest(NamedTuple):
    """y (p, m), Hessian there (p, m, m), whether it is at rest (p,), steps."""

    y: np.ndarray
    hessian: np.ndarray
    settled: np.ndarray
    steps: int


def energy(system, y):
    """(p,) of the elastic parts less the work of the load."""
    total = 0.5 * np.einsum("pi,pij,pj->p", y, system.linear, y) - np.sum(system.load * y, axis=1)
    return total + sum(part.law(part.strain(y))[0].sum(axis=1) for part in system.parts)


def slope_and_hessian(system, y):
    """Gradient (p, m) and Hessian (p, m, m) of the energy."""
    gradient, hessian = (system.linear @ y[:, :, None])[:, :, 0] - system.load, system.linear.copy()
    for part in system.parts:
        _, force, stiffness = part.law(part.strain(y))
        across = stacked(part.rows).transpose(0, 2, 1)
        gradient += (across @ stacked(force[..., None]))[:, :, 0]
        hessian += across @ stacked(stiffness @ part.rows)
    return gradient, hessian


def rest(system, start, bound):
    """The `Rest` from `start` (p, m), a usual answer; positions that do not settle, or leave |y| < bound, keep their last y."""
    y, scale = start.copy(), np.abs(system.load).max(axis=1)
    soften = SOFTEN / np.abs(start).max(axis=1)
    step = 0
    while True:
        gradient, hessian = slope_and_hessian(system, y)
        left = np.abs(gradient).max(axis=1)
        noise = ROUNDING * (np.abs(hessian) @ np.abs(y)[:, :, None])[:, :, 0].max(axis=1)
        settled = left <= np.maximum(TOLERANCE * scale, noise)
        gone = np.abs(y).max(axis=1) > bound
        if step == MOST_STEPS or (settled | gone).all():
            return Rest(_polished(y, gradient, hessian, settled), hessian, settled, step)
        change = -held_solve(hessian, gradient, FLOOR * largest(hessian) + soften * np.minimum(left, scale))
        change[settled | gone] = 0.0
        y, step = y + _length(system, y, change)[:, None] * change, step + 1


def _polished(y, gradient, hessian, settled):
    """One full step more: the bound on rounding that ended the search is a wide one."""
    return y - settled[:, None] * held_solve(hessian, gradient, FLOOR * largest(hessian))


def held_solve(hessian, right, trifle):
    """H^-1 right, with a trifle of stiffness (p,) on every unknown, so that what nothing resists stays where it is."""
    regular = hessian + trifle[:, None, None] * np.eye(right.shape[1])
    return np.linalg.solve(regular, right[:, :, None])[:, :, 0]


def largest(hessian):
    """(p,): the largest stiffness on the diagonal."""
    return np.abs(np.diagonal(hessian, axis1=1, axis2=2)).max(axis=1)


def _length(system, y, change):
    """(p,): share of the step, 1 or less, at which the energy along it, convex, has lost half of its steepness.

    Only the strains are followed; a bracket by the slope is narrowed by the secant, kept off its ends.
    """
    strains = [(part.law, part.strain(y), part.moved(change)) for part in system.parts]
    pull = (system.linear @ change[:, :, None])[:, :, 0]
    bent, base = np.sum(pull * change, axis=1), np.sum(pull * y, axis=1) - np.sum(system.load * change, axis=1)

    def slope(share):
        strained = sum(np.sum(law(d + share[:, None, None] * v)[1] * v, axis=(1, 2)) for law, d, v in strains)
        return base + share * bent + strained

    low, share = np.zeros(len(y)), np.ones(len(y))
    low_slope, high, high_slope = slope(low), np.ones(len(y)), np.zeros(len(y))
    steep, flat = np.abs(low_slope), low_slope >= 0  # flat: at rest but for rounding
    for _ in range(HALVINGS):
        here = slope(share)
        done = flat | (np.abs(here) <= 0.5 * steep) | ((here <= 0) & (share == 1.0))
        if done.all():
            break
        short, long = ~done & (here < 0), ~done & (here >= 0)
        low, low_slope = np.where(short, share, low), np.where(short, here, low_slope)
        high, high_slope = np.where(long, share, high), np.where(long, here, high_slope)
        part = -low_slope / np.where(done, 1.0, high_slope - low_slope)
        share = np.where(done, share, low + (high - low) * np.clip(part, 0.1, 0.9))
    return share
