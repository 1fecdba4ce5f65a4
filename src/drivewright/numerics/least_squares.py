"""Fit of parameters to data, with what the data say about their accuracy."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import scipy

from drivewright._typing import ArrayLike, Floats
from drivewright.errors import InputError, SolverError


class Fit(NamedTuple):
    """parameters (n,), covariance (n, n), root mean square of the residuals, residuals (m,)."""

    parameters: Floats
    covariance: Floats
    rms: float
    residuals: Floats


def fit(
    residuals: Callable[[Floats], Floats],
    start: ArrayLike,
    scale: ArrayLike = 1.0,
    bounds: tuple[ArrayLike, ArrayLike] = (-np.inf, np.inf),
    max_calls: int = 1000,
) -> Fit:
    """Parameters p that make the sum of squares of residuals(p) (m,) least.

    `scale`: typical size of each parameter.  Covariance s^2 (J^T J)^-1 with s^2 = sum of squares/(m - n), right for independent
    residuals of equal spread and parameters inside their bounds.
    Raises SolverError when the search does not settle, or when the data cannot tell some parameters apart.
    """
    start = np.atleast_1d(np.asarray(start, dtype=float))
    count = np.size(residuals(start))
    if count < start.size:
        raise InputError(f"fit: {start.size} parameters need at least as many residuals, got {count}.")
    solution = scipy.optimize.least_squares(
        residuals, start, x_scale=scale, bounds=bounds, max_nfev=max_calls, xtol=1e-12, ftol=1e-12, gtol=1e-12
    )
    if not solution.success:
        raise SolverError(
            f"fit: not settled after {solution.nfev} calls of the residuals; start nearer or raise max_calls.", partial=solution.x
        )
    _, size, directions = np.linalg.svd(solution.jac * scale, full_matrices=False)
    if size[-1] <= 1e-7 * size[0]:  # differences of the residuals, which give J, are no better
        free = ", ".join(str(i) for i in np.flatnonzero(np.abs(directions[-1]) > 0.1))
        raise SolverError(f"fit: the data do not determine the parameters {free} one by one; fix some of them.", partial=solution.x)
    root = (directions.T / size) * np.reshape(scale, (-1, 1))
    spread = 2 * solution.cost / max(count - start.size, 1)
    return Fit(solution.x, spread * root @ root.T, float(np.sqrt(2 * solution.cost / count)), solution.fun)
