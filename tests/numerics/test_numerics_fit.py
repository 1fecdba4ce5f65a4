import numpy as np
import pytest

from drivewright.errors import InputError, SolverError
from drivewright.numerics.least_squares import fit

pytestmark = pytest.mark.analytical

T = np.linspace(0, 2, 400)


def decay(p):
    return p[0] * np.exp(-p[1] * T)


def test_exact_data_give_exact_parameters():
    found = fit(lambda p: decay(p) - decay([2.0, 0.7]), [1.0, 0.3])
    np.testing.assert_allclose(found.parameters, [2.0, 0.7], rtol=1e-10)
    assert found.rms < 1e-10


def test_covariance_of_a_line_is_the_textbook_one():
    y = 1.0 + 2.0 * T + np.random.default_rng(7).normal(0, 0.1, T.size)
    found = fit(lambda p: p[0] + p[1] * T - y, [0.0, 0.0], scale=[1.0, 10.0])
    theirs, covariance = np.polyfit(T, y, 1, cov=True)
    np.testing.assert_allclose(found.parameters, theirs[::-1], rtol=1e-8)
    np.testing.assert_allclose(found.covariance, covariance[::-1, ::-1], rtol=1e-6)
    assert found.rms == pytest.approx(np.sqrt(np.mean((np.polyval(theirs, T) - y) ** 2)), rel=1e-9)
    np.testing.assert_allclose(found.residuals, np.polyval(theirs, T) - y, atol=1e-8)


def test_covariance_predicts_the_scatter():
    rng = np.random.default_rng(11)
    runs = [fit(lambda p, y=decay([2.0, 0.7]) + rng.normal(0, 0.05, T.size): decay(p) - y, [1.5, 0.5]) for _ in range(200)]
    scatter = np.cov([run.parameters for run in runs], rowvar=False)
    np.testing.assert_allclose(np.mean([run.covariance for run in runs], axis=0), scatter, rtol=0.35)


def test_what_the_data_cannot_tell_apart():
    with pytest.raises(SolverError, match="do not determine the parameters 0, 2 one by one"):
        fit(lambda p: (p[0] + p[2]) * T + p[1] - 1, [0.0, 0.0, 0.0])


def test_too_few_data():
    with pytest.raises(InputError, match="2 parameters need at least as many residuals, got 1"):
        fit(lambda p: p[:1], [1.0, 2.0])


def test_giving_up_keeps_the_best_parameters():
    with pytest.raises(SolverError, match="not settled after 3 calls") as caught:
        fit(lambda p: decay(p) - decay([2.0, 5.0]), [1.0, 0.3], max_calls=3)
    assert caught.value.partial.shape == (2,)
