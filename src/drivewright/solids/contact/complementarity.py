"""Which places press: a convex quadratic programme with unknowns that are not negative.

    minimise  1/2 x'A x + b'x   with   H x + h = 0,   x_i >= 0 for the places that can only press,

whose multipliers a are the rigid motions: the gaps left are A x + b + H'a, 0 where x_i > 0.  A primal-dual active set settles it in a few
steps, most often; where it goes in circles a primal-dual interior point method, which always ends, says which places press, and a last
active set makes that exact.
"""

from typing import NamedTuple

import numpy as np

from drivewright._typing import Bools, Floats, Ints
from drivewright.errors import SolverError

TRIES = 25  # of the active set before the interior point method
STEPS = 80  # of the interior point method
SMALL = 1e-9  # of complementarity, relative
BACK = 0.995  # part of the way to the bound that a step may go
BALANCED = 1e-6  # of the load: what may be missing from its balance
SHARE = 0.1  # of the usual scale
TINY = 1e-13  # relative to the diagonal: keeps the matrix regular


class Pressed(NamedTuple):
    """x (n,), rigid motions a (m,), gaps (n,), and which places press (n,)."""

    x: Floats
    motions: Floats
    gap: Floats
    pressing: Bools


def solve_complementarity(
    matrix: Floats, right: Floats, held: Floats, load: Floats, one_sided: Bools, first: Bools | None = None
) -> Pressed:
    """`Pressed` for A (n, n), b (n,), H (m, n), h (m,) and which unknowns are one-sided (n,); `first`: places that pressed in a like case.

    SolverError where neither method ends.
    """
    scale = sizes(matrix, held)
    scaled = matrix / np.outer(scale, scale)
    push = np.linalg.norm(held / scale, axis=1)
    push = np.where(push > 0, push, 1.0)
    rows = held / scale / push[:, None]
    force, gaps = load / push, right / scale
    pressing = np.ones(len(right), bool) if first is None else first | ~one_sided
    found = _active_set(scaled, gaps, rows, force, one_sided, pressing)
    if found is None:
        near = _interior_point(scaled, gaps, rows, force, one_sided)
        found = _active_set(scaled, gaps, rows, force, one_sided, near)
    if found is None:
        raise SolverError(
            f"contact: the set of places in contact, out of {int(one_sided.sum())}, did not converge; "
            "try a finer mesh, a larger reach, or smaller steps."
        )
    x, motions, gap, pressing = found
    return Pressed(x / scale, motions / push, gap * scale, pressing)


def sizes(matrix: Floats, held: Floats) -> Floats:
    """Scale (n,) of the unknowns: the root of the diagonal, or what the rigid motions feel of them where that is far more."""
    own, weight = np.sqrt(np.maximum(np.diag(matrix), 0.0)), np.linalg.norm(held, axis=0)
    usual = np.median(own[weight > 0] / weight[weight > 0]) if np.any(weight > 0) else 0.0
    return np.maximum(np.maximum(own, SHARE * usual * weight), np.sqrt(TINY) * own.max(initial=1e-300))


def unbalanced(rays: Floats, load: Floats) -> Floats:
    """What of a load (m,) no amounts y >= 0 of rays (m, k) balance: r = R y + h of the least length, 0 where a balance exists.

    As a motion no ray works against it, R'r >= 0, while the load does, h'r = |r|^2 > 0 (Farkas): it is the way things go.
    """
    from scipy.optimize import nnls

    size = np.linalg.norm(rays, axis=0)
    unit = rays[:, size > 0] / size[size > 0]
    rest = unit @ nnls(unit, -load)[0] + load
    return np.where(np.linalg.norm(rest) > BALANCED * np.linalg.norm(load), rest, 0.0)


def _active_set(matrix: Floats, right: Floats, held: Floats, load: Floats, one_sided: Bools, pressing: Bools) -> Pressed | None:
    """The solution whose pressing places do not pull and whose others do not overlap; None where the set does not settle."""
    seen: set[bytes] = set()
    for _ in range(TRIES):
        x, motions = _solved(matrix, right, held, load, pressing)
        gap = matrix @ x + right + held.T @ motions
        close = SMALL * max(np.abs(gap).max(), np.abs(x).max(), 1e-300)
        wanted = np.where(pressing, x > -close, gap < -close) | ~one_sided
        if np.array_equal(wanted, pressing):
            if np.abs(held @ x + load).max(initial=0.0) > BALANCED * np.abs(load).max(initial=0.0):
                return None  # the places that press cannot carry the load
            return Pressed(np.where(one_sided, np.maximum(x, 0.0), x), motions, np.where(pressing, 0.0, gap), pressing)
        if wanted.tobytes() in seen:
            return None
        seen.add(wanted.tobytes())
        pressing = wanted
    return None


def _solved(matrix: Floats, right: Floats, held: Floats, load: Floats, pressing: Bools) -> tuple[Floats, Floats]:
    """Unknowns and rigid motions of one set; a motion that the set does not hold is held by next to nothing."""
    import scipy.linalg

    at, count = np.flatnonzero(pressing), len(held)
    block = np.zeros((len(at) + count,) * 2)
    block[: len(at), : len(at)] = matrix[np.ix_(at, at)] + TINY * np.eye(len(at))
    block[: len(at), len(at) :] = held[:, at].T
    block[len(at) :, : len(at)] = held[:, at]
    block[len(at) :, len(at) :] = -1e-12 * np.eye(count)
    answer = scipy.linalg.solve(block, np.concatenate([-right[at], -load]), check_finite=False, assume_a="sym")
    x = np.zeros(len(right))
    x[at] = answer[: len(at)]
    return x, answer[len(at) :]


def _interior_point(matrix: Floats, right: Floats, held: Floats, load: Floats, one_sided: Bools) -> Bools:
    """Which places press (n,): Mehrotra's predictor and corrector on x_i g_i = 0, x, g > 0, for the one-sided unknowns."""
    import scipy.linalg

    bound = np.flatnonzero(one_sided)
    size, count = np.abs(load).max(initial=0.0) or 1.0, max(len(bound), 1)
    start = size / np.sqrt(count)
    x, motions = np.where(one_sided, start, 0.0), np.zeros(len(held))
    gap = np.full(len(bound), max(np.abs(right).max(), start))
    for _ in range(STEPS):
        missing = matrix @ x + right + held.T @ motions
        missing[bound] -= gap
        primal, mean = held @ x + load, float(x[bound] @ gap) / count
        if mean < 1e-14 * start * start and np.abs(primal).max(initial=0.0) < 1e-9 * size:
            break
        barrier = np.full(len(right), TINY)
        barrier[bound] += gap / x[bound]
        factor = scipy.linalg.cho_factor(matrix + np.diag(barrier), check_finite=False)
        inner = scipy.linalg.cho_solve(factor, held.T, check_finite=False)
        system = _Newton(factor, inner, held, missing, primal, x[bound], gap, bound)
        dx, _, dg = system.step(-x[bound] * gap)
        reach = min(_room(x[bound], dx[bound]), _room(gap, dg))
        after = float((x[bound] + reach * dx[bound]) @ (gap + reach * dg)) / count
        dx, turn, dg = system.step((after / mean) ** 3 * mean - x[bound] * gap - dx[bound] * dg)
        part = BACK * min(_room(x[bound], dx[bound]), _room(gap, dg))
        x, gap, motions = x + part * dx, gap + part * dg, motions + part * turn
    pressing = ~one_sided
    pressing[bound] = x[bound] > gap
    return pressing


class _Newton(NamedTuple):
    """A linear system of the interior point method: A + diag(g/x) factorised, its inverse times H', H, what both sides miss, and where the
    one-sided unknowns stand."""

    factor: tuple[Floats, bool]
    inner: Floats
    held: Floats
    dual: Floats
    primal: Floats
    x: Floats
    gap: Floats
    bound: Ints

    def step(self, complement: Floats) -> tuple[Floats, Floats, Floats]:
        """(dx, da, dg) with x dg + g dx = complement on the one-sided unknowns."""
        import scipy.linalg

        rest = -self.dual
        rest[self.bound] += complement / self.x
        free = scipy.linalg.cho_solve(self.factor, rest, check_finite=False)
        regular = TINY * np.eye(len(self.held))
        motions = np.linalg.solve(self.held @ self.inner + regular, self.held @ free + self.primal)
        dx = free - self.inner @ motions
        return dx, motions, (complement - self.gap * dx[self.bound]) / self.x


def _room(value: Floats, step: Floats) -> float:
    """Largest part of a step, up to 1, that leaves the values not negative."""
    down = step < 0
    return min(1.0, float((value[down] / -step[down]).min(initial=1.0)))
