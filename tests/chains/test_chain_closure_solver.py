"""The ways in which the compiled solution ends early, met by data that no drive has."""

import numpy as np
import pytest

from drivewright.chains.closure import Drive, tracking
from drivewright.chains.closure.start import layout_of
from drivewright.chains.link import design_link

pytestmark = pytest.mark.error

LAYOUT, SEATS, X = layout_of(Drive(design_link(9.525e-3, 1.2e-3, np.pi / 6, 2.6e-3), 11, 13, 40))


def outcome(layout, seats=SEATS, x=X):
    return tracking.follow(layout, seats.copy(), x.copy(), np.linspace(0, 0.3, 3)).outcome[0]


def test_the_outcome_tells_why():
    assert outcome(LAYOUT) == tracking.DONE
    assert outcome(LAYOUT._replace(height_1=np.nan)) == tracking.LOST
    assert outcome(LAYOUT, x=X * np.nan) == tracking.LOST
    assert outcome(LAYOUT, seats=SEATS - [30, 0, 0, 0]) == tracking.NO_STRAND
    assert outcome(LAYOUT, seats=SEATS + [8, 0, 0, 0]) == tracking.NO_WRAP


def test_wrong_seats_to_start_from_are_put_right():
    right = tracking.follow(LAYOUT, SEATS.copy(), X.copy(), np.linspace(0, 0.3, 3))
    for change in ([1, 0, 0, 0], [-1, 1, 0, 1], [2, -2, 2, -2], [-2, 0, 1, 0]):
        found = tracking.follow(LAYOUT, SEATS + change, X.copy(), np.linspace(0, 0.3, 3))
        assert found.outcome[0] == tracking.DONE
        np.testing.assert_array_equal(found.seats[0], right.seats[0])
        np.testing.assert_allclose(found.x[0], right.x[0], rtol=1e-12, atol=1e-12)


def test_the_miss_of_the_worst_row_is_told():
    psi, x, seats = np.zeros(2), np.array([X, X * np.nan]), np.array([SEATS, SEATS])
    assert tracking.solve_at(LAYOUT, psi[:1], x[:1], seats[:1]) < 1e-12
    assert tracking.solve_at(LAYOUT, psi, x, seats) == np.inf
