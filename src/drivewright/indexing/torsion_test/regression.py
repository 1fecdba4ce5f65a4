"""A straight line through autocorrelated readings: slope, and its uncertainty."""

from typing import NamedTuple

import numpy as np

from drivewright._typing import ArrayLike, Floats
from drivewright.errors import InputError

CORRELATIONS = (-0.4, -0.2, 0.0, 0.2, 0.4, 0.5, 0.6, 0.7, 0.8, 0.85, 0.9, 0.93, 0.95, 0.97, 0.98, 0.99)  # tried, of neighbouring errors
LAGS = (0, 1, 2, 3, 5, 8, 13, 21)  # samples apart, where the residuals are compared with their expected moments
ROUNDING = 1e-13  # part of the signal: residuals this small are none


class RegressionLine(NamedTuple):
    """y = slope x + an intercept for each group; `variance` of the slope, `freedom` for Student's t."""

    slope: float
    variance: float
    freedom: float
    intercepts: Floats
    residuals: Floats


class Estimate(NamedTuple):
    """A value, its standard uncertainty, and the interval [low, high] of the required confidence."""

    value: float
    uncertainty: float
    low: float
    high: float


def fit_line(x: ArrayLike, y: ArrayLike, group: ArrayLike | None = None) -> RegressionLine:
    """The `RegressionLine` of y (n,) over x (n,) by ordinary least squares; groups (n,) of whole numbers share the slope,
    each has its intercept.

    The slope is that of the groups, weighted with their sum of (x - mean)^2.  Its variance is the larger of two that stand
    autocorrelated errors, the samples being in the order of measuring:

    * white errors plus errors of first order, e_t = rho e_(t-1) + white.  Both spreads and rho are those whose expected products of
      residuals up to 21 samples apart come nearest to the ones seen; what the fit itself takes from the residuals is in the expectation.
    * Newey and West (1987): Bartlett weights over 1.3 sqrt(n) lags, with n/(n - parameters).

    `freedom` is n/(variance over that of white errors of the same size), the number of errors that count, less the parameters, at
    least 2.  Recalled; the tests hold the coverage of the intervals against simulated errors.
    """
    x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    group = np.zeros(x.size, dtype=int) if group is None else np.unique(group, return_inverse=True)[1]
    members = (group[:, None] == np.arange(group.max() + 1)).astype(float)
    counts = members.sum(axis=0)
    x_mean, y_mean = members.T @ x / counts, members.T @ y / counts
    inside, right = x - x_mean[group], y - y_mean[group]
    size = float(np.sqrt(inside @ inside))
    if size == 0 or x.size <= counts.size + 1:
        raise InputError(f"a line through {x.size} samples in {counts.size} groups has no slope; give more samples, at different places")
    slope = float(inside @ right) / size**2
    residuals = right - slope * inside
    basis = np.column_stack([members / np.sqrt(counts), inside / size])
    variance, white = _variance(basis, residuals, float(np.sqrt(right @ right)))
    freedom = max(x.size * min(white / variance, 1.0) - basis.shape[1], 2.0) if variance else float(x.size - basis.shape[1])
    return RegressionLine(slope, variance / size**2, freedom, y_mean - slope * x_mean, residuals)


def _variance(basis: Floats, residuals: Floats, signal: float) -> tuple[float, float]:
    """(variance of the last coefficient, that with white errors of the same size) for an orthonormal basis (n, p)."""
    if np.linalg.norm(residuals) <= ROUNDING * signal:
        return 0.0, 0.0
    lags = [lag for lag in LAGS if lag <= residuals.size // 8]
    seen = np.array([residuals[lag:] @ residuals[: residuals.size - lag] for lag in lags])
    expected, effects = _moments(basis, lags)
    white, correlated, misfit = _spreads(expected[CORRELATIONS.index(0.0)], expected, seen)
    best = int(np.argmin(misfit))
    modelled = white[best] + correlated[best] * effects[best]
    return float(max(modelled, _newey_west(basis[:, -1] * residuals, basis.shape[1]))), float(white[best] + correlated[best])


def _spreads(white, correlated, seen):
    """(variance of white errors, of correlated errors, misfit) (rho,), none negative, whose moments (lag,) come nearest to those seen."""
    a, ab, b = white @ white, correlated @ white, np.sum(correlated**2, axis=1)
    left, right, det = white @ seen, correlated @ seen, a * b - ab**2
    det = np.where(det > 1e-9 * a * b, det, np.inf)  # rho = 0 is white already
    both = np.array([(left * b - right * ab) / det, (right * a - left * ab) / det])
    alone = np.array([np.zeros_like(b), np.maximum(right / b, 0.0)])
    pairs = np.where(np.all(both >= 0, axis=0) & np.isfinite(det), both, alone)
    misfit = np.sum((pairs[0][:, None] * white + pairs[1][:, None] * correlated - seen) ** 2, axis=1)
    return *pairs, misfit


def _moments(basis, lags):
    """E[sum r_t r_(t - lag)] (rho, lag) of residuals r and variance (rho,) of the last coefficient, for errors of unit spread and each rho.

    r = M e with M = I - Z Z^T, so E[r^T A r] = tr(M A M R), R_ij = rho^|i-j|, A_ij = 1/2 where |i-j| = lag (1 for lag 0).
    """
    n = len(basis)
    shifted = np.array([_shifted(basis, lag) for lag in lags])
    inner, flat, steps = (basis.T @ shifted).reshape(len(lags), -1), shifted.reshape(len(lags), -1), np.array(lags)
    moments, effects = [], []
    for rho in CORRELATIONS:
        spread = _correlated(basis, rho)
        across = basis.T @ spread
        moments.append((n - steps) * rho**steps - 2 * flat @ spread.ravel() + inner @ across.ravel())
        effects.append(across[-1, -1])
    return np.array(moments), np.array(effects)


def _shifted(basis, lag):
    """A Z: the mean of Z shifted by `lag` samples up and down."""
    if lag == 0:
        return basis
    near = np.zeros_like(basis)
    near[:-lag] += 0.5 * basis[lag:]
    near[lag:] += 0.5 * basis[:-lag]
    return near


def _correlated(basis, rho):
    """R Z with R_ij = rho^|i-j|, by going through the samples forth and back."""
    if rho == 0:
        return basis
    return _decayed(basis, rho) + _decayed(basis[::-1], rho)[::-1] - basis


def _decayed(values, rho):
    """sum over j <= i of rho^(i-j) values_j, by doubling the reach."""
    total, reach, weight = values.copy(), 1, rho
    while reach < len(values) and abs(weight) > 1e-18:
        total[reach:] += weight * total[:-reach].copy()
        reach, weight = 2 * reach, weight * weight
    return total


def _newey_west(scores, parameters):
    """Long-run variance of the sum of scores (n,), Bartlett weights."""
    n = scores.size
    lags = min(int(np.ceil(1.3 * np.sqrt(n))), n - 1)
    total = scores @ scores + 2 * sum((1 - lag / (lags + 1)) * (scores[lag:] @ scores[:-lag]) for lag in range(1, lags + 1))
    return total * n / (n - parameters)


def student_half_width(confidence: float, freedom: float) -> float:
    """Half width of the two-sided interval in standard uncertainties."""
    from scipy.special import stdtrit

    return float(stdtrit(freedom, 0.5 + confidence / 2))


def slope_estimate(line: RegressionLine, confidence: float) -> Estimate:
    """The `Estimate` of a stiffness that is the slope of a line."""
    u = float(np.sqrt(line.variance))
    reach = student_half_width(confidence, line.freedom) * u
    return Estimate(line.slope, u, line.slope - reach, line.slope + reach)


def inverse_estimate(line: RegressionLine, confidence: float) -> Estimate:
    """The `Estimate` of a stiffness that is one over the slope of a line (a compliance); the interval is that of the compliance, turned."""
    return compliance_estimate(line.slope, float(np.sqrt(line.variance)), line.freedom, confidence)


def compliance_estimate(compliance: float, uncertainty: float, freedom: float, confidence: float) -> Estimate:
    """Stiffness k = 1/c with u(k) = k^2 u(c); `high` is infinite where the interval of the compliance reaches zero."""
    reach = student_half_width(confidence, freedom) * uncertainty
    high = 1 / (compliance - reach) if compliance > reach else np.inf
    return Estimate(1 / compliance, uncertainty / compliance**2, 1 / (compliance + reach), high)
