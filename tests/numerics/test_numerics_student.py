"""Student's distribution beside SciPy's and closed forms."""

import math

import numpy as np
import pytest
from scipy.special import stdtrit

from drivewright.errors import InputError
from drivewright.numerics.student import student_quantile

pytestmark = pytest.mark.analytical


@pytest.mark.parametrize("freedom", [1.0, 1.3, 2.0, 3.0, 4.7, 9.0, 29.5, 120.0, 3e3, 1e6])
@pytest.mark.parametrize("share", [0.51, 0.75, 0.9, 0.975, 0.995, 0.9995])
def test_quantiles_are_scipys(freedom, share):
    assert student_quantile(freedom, share) == pytest.approx(float(stdtrit(freedom, share)), rel=1e-8)


@pytest.mark.parametrize("share", [0.6, 0.9, 0.975, 0.999])
def test_closed_forms_of_one_two_and_four_degrees(share):
    assert student_quantile(1.0, share) == pytest.approx(math.tan(math.pi * (share - 0.5)), rel=1e-12)
    spread = 4 * share * (1 - share)
    assert student_quantile(2.0, share) == pytest.approx((2 * share - 1) * math.sqrt(2 / spread), rel=1e-12)
    angle = math.acos(math.sqrt(spread)) / 3
    assert student_quantile(4.0, share) == pytest.approx(2 * math.sqrt(math.cos(angle) / math.sqrt(spread) - 1), rel=1e-11)


@pytest.mark.parametrize("freedom", [1.0, 2.5, 40.0])
def test_it_is_symmetric_and_falls_with_the_freedom(freedom):
    shares = np.linspace(0.5, 0.999, 20)
    values = [student_quantile(freedom, share) for share in shares]
    assert values[0] == 0.0 and np.all(np.diff(values) > 0)
    assert student_quantile(freedom, 0.2) == pytest.approx(-student_quantile(freedom, 0.8), rel=1e-12)
    assert student_quantile(freedom + 1, 0.9) < student_quantile(freedom, 0.9)


@pytest.mark.parametrize(("freedom", "share"), [(0.5, 0.9), (3.0, 1.0), (3.0, 1e-6), (math.nan, 0.9)])
def test_what_is_no_distribution_is_refused(freedom, share):
    with pytest.raises(InputError, match="Student"):
        student_quantile(freedom, share)
