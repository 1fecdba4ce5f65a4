"""One suite for every motion law: derivatives, rise, rest, claims."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from drivewright import motion

pytestmark = pytest.mark.conformance

RISE = np.array([[0, 0], [0.2, 0.06], [0.37, 0.3], [0.55, 0.61], [0.8, 0.93], [1, 1]])
ANGLE = np.linspace(0, 2 * np.pi, 49)
PARAMETERS = {
    "scca": {"b": 0.21, "c": 0.33, "d": 0.46},
    "mcv": {"c": 0.41},
    "polynomial": {"start": (0, 0, 3.0), "end": (0, 0), "interior": [(0.4, 0, 0.45)]},
    "spline": {"points": RISE},
    "table": {"angle": ANGLE, "lift": 0.01 * np.exp(np.sin(ANGLE + 0.3))},
}
# name: (order of continuity, symmetric, monotone).  By hand: a dwell before and after, the shape of the acceleration.
CLAIMS = {
    "constant-velocity": (0, True, True),
    "uniform": (0, True, True),
    "parabolic": (1, True, True),
    "simple-harmonic": (1, True, True),
    "double-harmonic": (1, False, True),
    "cycloidal": (2, True, True),
    "modified-sine": (2, True, True),
    "modified-trapezoid": (2, True, True),
    "scca": (2, True, True),
    "mcv": (2, True, True),
    "mcv50": (2, True, True),
    "mcv33": (2, True, True),
    "mcv20": (2, True, True),
    "polynomial-345": (2, True, True),
    "polynomial-4567": (3, True, True),
    "polynomial-56789": (4, True, True),
    "polynomial": (2, False, False),
    "spline": (2, False, True),
    "table": (4, False, False),
}


@pytest.fixture(params=sorted(CLAIMS))
def law(request):
    return motion.law(request.param, **PARAMETERS.get(request.param, {}))


def pieces(law):
    return range(len(law.breaks) - 1)


def test_the_suite_covers_every_law():
    assert sorted(CLAIMS) == motion.names()


def test_each_derivative_integrates_to_the_one_before(law):
    nodes, weights = np.polynomial.legendre.leggauss(24)
    scale = [np.max(np.abs(part)) for part in law(np.linspace(0, 1, 201))]
    for k in pieces(law):
        low, high = law.breaks[k : k + 2]
        for part in (0.31, 0.77, 1.0):  # not only the whole piece: over a full wave a wrong sign integrates to the same nothing
            end = low + part * (high - low)
            inside = law.on_piece(k, low + (end - low) * (nodes + 1) / 2)
            start, stop = law.on_piece(k, low), law.on_piece(k, end)
            for order in range(3):
                integral = weights @ inside[order + 1] * (end - low) / 2
                size = max(scale[order], scale[order + 1] * (end - low))
                assert_allclose(integral, stop[order] - start[order], rtol=0, atol=1e-12 * size)


def test_rise_is_one_and_starts_at_zero(law):
    if law.name == "table":
        assert_allclose(law(0.0).s, PARAMETERS["table"]["lift"][0], rtol=1e-14)
    else:
        assert_allclose((law(0.0).s, law(1.0).s), (0, 1), rtol=0, atol=2e-15)


def test_derivatives_below_the_claimed_order_do_not_jump_and_the_next_one_does(law):
    continuity = CLAIMS[law.name][0]
    assert law.continuity == continuity
    scale = [np.max(np.abs(part)) for part in law(np.linspace(0, 1, 201))]
    for order in range(min(continuity + 2, 4)):
        left = [law.on_piece(k, law.breaks[k])[order] for k in pieces(law)]
        right = [law.on_piece(k, law.breaks[k + 1])[order] for k in pieces(law)]
        rest = (right[-1], left[0]) if law.closed else (0.0, 0.0) if order else (left[0], right[-1])
        gaps = np.abs(np.array([*left, rest[1]]) - np.array([rest[0], *right]))
        assert (np.max(gaps) < 1e-7 * scale[order]) == (order <= continuity)


def test_turns_back_only_where_it_says_so(law):
    v = law(np.linspace(0, 1, 4001)).v
    assert CLAIMS[law.name][2] == bool(np.min(v) >= -1e-12 * np.max(v))


def test_second_half_is_the_first_turned_about_where_it_says_so(law):
    u = np.linspace(0.013, 0.487, 57)
    turned = np.max(np.abs(law(u).v - law(1 - u).v)) < 1e-11 * np.max(law(u).v)
    assert law.symmetric == CLAIMS[law.name][1] == turned


def test_peaks_are_plain_floats_and_the_greatest_values_of_a_dense_sampling(law):
    peaks, scale = law.peaks(), 1.0
    assert all(type(value) is float for value in peaks)
    k = np.repeat(pieces(law), 4001)
    low, high = law.breaks[k], law.breaks[k + 1]
    _, v, a, j = law.function.on_piece(k, low + (high - low) * np.tile(np.linspace(0, 1, 4001), len(pieces(law))))
    dense = [np.max(np.abs(part)) for part in (v, a, j, a * v)]
    finite = (True, law.continuity > 0, law.continuity > 1, law.continuity > 0)
    for value, sampled, is_finite in zip(peaks, dense, finite, strict=True):
        assert math.isfinite(value) == is_finite
        if is_finite:  # sampling falls short of a smooth peak by O(h^2), never beyond it
            scale = max(value, 1e-300)
            assert -1e-13 * scale <= value - sampled <= 1e-5 * scale


def test_an_array_and_its_scalars_agree(law):
    u = np.array([[0.0, 0.123], [0.5, 1.0]])
    many = law(u)
    assert all(part.shape == u.shape for part in many)
    one = law(float(u[0, 1]))
    assert all(isinstance(part, float) for part in one)
    assert_allclose(one, [part[0, 1] for part in many], rtol=1e-14, atol=1e-15)


def test_at_a_break_the_right_piece_speaks_and_on_piece_gives_both(law):
    for k in list(pieces(law))[1:]:
        assert_allclose(law(law.breaks[k]), law.on_piece(k, law.breaks[k]), rtol=1e-14, atol=0)
