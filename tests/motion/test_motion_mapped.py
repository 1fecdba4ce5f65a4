"""A motion seen through a map: derivatives, peaks and jumps against a map whose result is known in closed form."""

import numpy as np
import pytest

from drivewright.motion import MappedPiecewise, Programme, Segment
from drivewright.motion.mapped import Composed
from drivewright.numerics.jets import exp, log

pytestmark = pytest.mark.analytical


class Exponential:
    """y = exp(s)."""

    value = staticmethod(exp)
    slope = staticmethod(exp)


class Logarithm:
    """y = log(s)."""

    value = staticmethod(log)

    @staticmethod
    def slope(stated):
        return stated**-1


def programme(law, rise):
    return Programme((Segment(2.0, law, rise), Segment(3.0, law, -rise), Segment(2 * np.pi - 5.0, "dwell")))


def test_exponential_of_a_uniform_motion():
    """s = r u: y = exp(r x/2), each derivative r/2 times the one before."""
    rise = 0.7
    mapped = MappedPiecewise.through(programme("constant-velocity", rise).stated, Exponential())
    x = np.linspace(0.1, 1.9, 7)
    for order, part in enumerate(mapped(x)):
        assert part == pytest.approx((rise / 2) ** order * np.exp(rise * x / 2), rel=1e-13)
    first, second = (sorted(np.abs(mapped.jumps(order)[:-1])) for order in (1, 2))
    top = np.exp(rise)
    assert first == pytest.approx(sorted([rise / 2, rise / 2 * top + rise / 3 * top, rise / 3]), rel=1e-12)
    assert second == pytest.approx(sorted([(rise / 2) ** 2, ((rise / 2) ** 2 - (rise / 3) ** 2) * top, (rise / 3) ** 2]), rel=1e-12)
    assert mapped.relative_jump(1) == pytest.approx((1 / 2 + 1 / 3) / (1 / 2), rel=1e-12)


@pytest.mark.parametrize("law", ["cycloidal", "polynomial-4567", "modified-sine"])
def test_peaks_are_the_greatest_of_many_places(law):
    mapped = MappedPiecewise.through(programme(law, 0.9).stated, Exponential())
    x = np.linspace(0, 5, 200001)
    motion, peaks = mapped(x), mapped.peaks()
    # Steps so fine that the parabola of a peak has no height between them; the third derivative may jump inside the law.
    for ours, dense in zip(peaks[:2], (motion.v, motion.a), strict=True):
        assert ours == pytest.approx(np.max(np.abs(dense)), rel=1e-8)
    assert peaks.Jm == pytest.approx(np.max(np.abs(motion.j)), rel=1e-4)
    assert peaks.AVm == pytest.approx(np.max(np.abs(motion.a * motion.v)), rel=1e-7)


def test_rates_hold_the_fourth_derivative():
    mapped, step = MappedPiecewise.through(programme("cycloidal", 0.9).stated, Exponential()), 1e-4
    third = mapped.rates(0, np.array([0.7 - step, 0.7 + step])).d2
    assert mapped.rates(0, np.array([0.7])).d3[0] == pytest.approx((third[1] - third[0]) / (2 * step), rel=1e-6)


def test_a_map_after_its_inverse_changes_nothing():
    stated = programme("cycloidal", 0.9).stated
    mapped = MappedPiecewise.through(MappedPiecewise.through(stated, Exponential()), Logarithm())
    assert isinstance(mapped.outer, Composed)
    x = np.linspace(0, 6, 50)
    for ours, given in zip(mapped(x), stated(x), strict=True):
        assert ours == pytest.approx(given, abs=1e-12)
    assert mapped.peaks() == pytest.approx(stated.peaks(), rel=1e-11)
