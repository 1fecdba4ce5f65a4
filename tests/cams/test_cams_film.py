"""Entrainment of oil between cam and follower: the flat face in closed form, other faces by differences of the points' motion."""

import numpy as np
import pytest
from scipy.optimize import brentq

from drivewright import cams
from drivewright.motion import Programme, Segment
from drivewright.numerics.jets import Jet

TURN, OMEGA = 2 * np.pi, 40.0
SLIDE = Programme((Segment(1.1, "polynomial-4567", 9e-3), Segment(1.2, "polynomial-4567", -9e-3), Segment(TURN - 2.3, "dwell")))
SWING = Programme((Segment(1.6, "polynomial-4567", 0.2), Segment(1.7, "polynomial-4567", -0.2), Segment(TURN - 3.3, "dwell")))


@pytest.mark.analytical
def test_a_flat_tappet_in_closed_form():
    """u = w (R + s + 2 s'')/2: where the fall of the acceleration is deepest, on both flanks, the entrainment reverses."""
    radius, follower, cycle = 0.055, cams.TranslatingFlat(0.055), cams.Cycle(SLIDE.function)

    def typed(theta):
        s = SLIDE(theta)
        return 0.5 * (radius + s.s + 2 * s.a)

    angle = np.linspace(0.05, 6.2, 50)
    ours = cams.entrainment(follower.contact(*cycle.at_angle(angle)), rolls=False).d0
    assert np.abs(ours) == pytest.approx(np.abs(typed(angle)), rel=1e-12)
    found = cams.reversals(cycle, lambda a, s: cams.entrainment(follower.contact(a, s), False))
    grid = np.linspace(0, TURN, 4001)
    changes = np.flatnonzero(np.diff(np.sign(typed(grid))))
    assert len(found) == len(changes) == 4
    assert found == pytest.approx([brentq(typed, grid[k], grid[k + 1], xtol=1e-14) for k in changes], abs=1e-10)
    assert found[1] < 1.1 < found[2]


FOLLOWERS = [
    (cams.TranslatingFlat(0.03, 0.1, 0.004), SLIDE),
    (cams.TranslatingFlat(0.03, 0.1, 0.004, -1), SLIDE),
    (cams.OscillatingFlat(0.02, 0.05, 0.04, 0.003), SWING),
    (cams.OscillatingFlat(0.02, 0.05, 0.04, 0.003, -1), SWING),
    (cams.TranslatingRound(0.05, 0.02, 0.003), SLIDE),
    (cams.OscillatingRound(0.045, 0.015, 0.06, 0.04, -1), SWING),
]


def in_machine(follower, programme, theta):
    """Contact point and the direction of the face's normal in the machine's frame at cam angles."""
    contact = follower.contact(Jet(theta, np.ones_like(theta), 0 * theta, 0 * theta), Jet(*programme(theta)))
    turn = np.exp(1j * follower.sense * theta)
    return contact.point.d0 * turn, contact.tangent.d0 * turn


@pytest.mark.analytical
@pytest.mark.parametrize(("follower", "programme"), FOLLOWERS)
def test_by_differences_of_the_points(follower, programme):
    """Mean of both bodies' velocities at the contact, against that of the contact itself, along the surface."""
    theta, step = np.array([0.31, 0.77, 1.93, 2.6]), 1e-6
    (before, _), (after, _), (point, tangent) = (in_machine(follower, programme, theta + k * step) for k in (-1, 1, 0))
    contact = (after - before) / (2 * step)
    cam = 1j * follower.sense * point
    motion = programme(theta)
    swings = hasattr(follower, "pivot_distance")
    body = -1j * motion.v * (point - follower.pivot_distance) if swings else 1j * motion.v
    expected = np.real((contact - 0.5 * (cam + body)) * np.conj(tangent))
    contact_at = follower.contact(Jet(theta, np.ones_like(theta), 0 * theta, 0 * theta), Jet(*motion))
    assert cams.entrainment(contact_at, rolls=False).d0 == pytest.approx(expected, abs=1e-8)
    rolling = np.real((contact - cam) * np.conj(tangent))
    assert cams.entrainment(contact_at, rolls=True).d0 == pytest.approx(rolling, abs=1e-8)


@pytest.mark.property
def test_film_where_nothing_presses():
    follower, cycle = cams.TranslatingFlat(0.03), cams.Cycle(SLIDE.function)
    contact = follower.contact(*cycle.at_angle(np.array([0.2, 3.0])))
    found = cams.cam_film(contact, np.array([2.0, 2.0]), np.array([0.0, 100.0]), np.inf, 0.01, 115e9, 0.01, 18e-9)
    assert np.isnan(found.minimum[0]) and 0 < found.minimum[1] < found.central[1]
