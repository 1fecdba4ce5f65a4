"""Joints whose two rolling surfaces have radii of their own: rolling of circular arcs, seats, strands, closures, and their limits."""

import numpy as np
import pytest
from scipy.optimize import minimize

from drivewright.chains.closure import Drive, close, departure, plates, states_at
from drivewright.chains.closure.strand import decay, plate_directions, pressing, reach
from drivewright.chains.link import chordal_rise, contact_pitch, design_link, rolled_length, seat_height, seat_shift
from drivewright.errors import InputError

P, ANGLE, F0 = 9.525e-3, np.pi / 6, 2.6e-3
PAIRS = [(0.9e-3, 1.8e-3), (1.8e-3, 0.9e-3), (0.9e-3, -1.8e-3), (-3e-3, 1.1e-3), (0.4e-3, 20e-3)]
EQUAL = (1.2e-3, 1.2e-3)


def pair(right, left, pitch=P):
    return design_link(pitch, 0.5 * (right + left), ANGLE, F0, 0.5 * (right - left))


def rolled(right, left, turn, steps=20000):
    """Direction of the line of centres of two arcs that roll on each other, by small steps without slip: right fixed, left turned."""
    m, turned = 0.0, 0.0
    for _ in range(steps):
        # a small turn of the left body about the place of contact, right e(m): its centre moves across the line of centres
        small = turn / steps
        contact, centre = right * np.exp(1j * m), (right + left) * np.exp(1j * m)
        centre = contact + (centre - contact) * np.exp(1j * small)
        m, turned = np.angle(centre / (right + left)), turned + small
    return m


@pytest.mark.analytical
@pytest.mark.parametrize(("right", "left"), [EQUAL, *PAIRS])
def test_the_line_of_centres_turns_as_the_arcs_roll(right, left):
    assert rolled(right, left, 0.17) == pytest.approx((1 - pair(right, left).first_share) * 0.17, rel=2e-4)


@pytest.mark.analytical
@pytest.mark.parametrize(("right", "left"), [EQUAL, *PAIRS])
@pytest.mark.parametrize("teeth", [11, 35])
def test_seated_plates_close_to_a_polygon(right, left, teeth):
    """The centre about which a plate, turned by a tooth, meets the joint of the plate before it."""
    link, phi = pair(right, left), 2 * np.pi / teeth
    half, turn = 0.5 * link.hole_pitch, np.exp(-1j * phi)
    joint = (right + left) * np.exp(-1j * phi * left / (right + left))
    centre = (half + turn * half - joint) / (1 - turn)
    assert (seat_shift(link, teeth), seat_height(link, teeth)) == (
        pytest.approx(-centre.real, abs=1e-15),
        pytest.approx(-centre.imag, rel=1e-13),
    )


@pytest.mark.analytical
@pytest.mark.parametrize(("right", "left"), [EQUAL, *PAIRS])
def test_contacts_of_a_seated_plate(right, left):
    link, t = pair(right, left), np.pi / 17
    angle, half = 2 * t, 0.5 * link.hole_pitch
    share = right / (right + left)
    own = half - right * np.exp(-1j * (1 - share) * angle)
    other = -half + left * np.exp(1j * share * angle)
    assert contact_pitch(link, 17) == pytest.approx(abs(own - other), rel=1e-14)
    assert rolled_length(link, 17) == pytest.approx(abs(right * (1 - share) * angle), rel=1e-13) == pytest.approx(abs(left * share * angle))
    small = contact_pitch(link, 2000) - P
    assert small == pytest.approx((right * (1 - share) ** 2 + left * share**2) * 2 * (np.pi / 2000) ** 2, rel=1e-4)


@pytest.mark.analytical
def test_equal_radii_are_the_joint_of_before():
    one, same = design_link(P, 1.2e-3, ANGLE, F0), pair(*EQUAL)
    assert same == one and same.first_share == 0.5 and same.effective_radius == pytest.approx(0.6e-3)
    assert contact_pitch(one, 35) == pytest.approx(one.hole_pitch - 2.4e-3 * np.cos(np.pi / 35), rel=1e-14)


def reached(right, left, start, end, count):
    link = pair(right, left)
    A, r, k = link.hole_pitch / P, link.radius / P, link.skew / P
    return A, r, k, reach(A, r, k, True, count, start, end, np.zeros((3, count + 2)))


@pytest.mark.analytical
@pytest.mark.parametrize(("right", "left"), PAIRS)
def test_a_strand_reaches_as_far_as_it_can(right, left):
    """The farthest reach along the force over all directions of the free plates, by SciPy; and its derivatives."""
    start, end, count = 0.09, -0.05, 9
    A, r, k, found = reached(right, left, start, end, count)
    share = right / (right + left)

    def vector(free):
        d = np.concatenate([[start], free, [end]])
        return A * np.exp(1j * free).sum() - 2 * r * np.exp(1j * (share * d[:-1] + (1 - share) * d[1:])).sum()

    best = minimize(lambda free: -vector(free).real, np.zeros(count), method="BFGS", options={"gtol": 1e-11})
    assert found.vector.real == pytest.approx(-best.fun, rel=1e-12)
    assert plate_directions(A, r, k, True, count, start, end) == pytest.approx(best.x, abs=3e-6)
    h = 1e-5
    for place, slope in ((0, found.by_start), (1, found.by_end)):
        step = np.array([h, 0.0]) if place == 0 else np.array([0.0, h])
        above, below = (reached(right, left, *(np.array([start, end]) + sign * step), count)[3].vector for sign in (1, -1))
        assert (above - below) / (2 * h) == pytest.approx(slope, rel=1e-6, abs=1e-8)


@pytest.mark.analytical
@pytest.mark.parametrize(("right", "left"), PAIRS)
def test_a_straight_strand_turns_its_end_joints_alone(right, left):
    link, share = pair(right, left), right / (right + left)
    A, r, k = link.hole_pitch / P, link.radius / P, link.skew / P

    def straight(start, end):
        return reach(A, r, k, False, 5, start, end, np.zeros((3, 7)))

    found = straight(0.09, -0.05)
    joints = np.exp(1j * share * 0.09) + 4 + np.exp(-1j * (1 - share) * 0.05)
    assert found.vector == pytest.approx(5 * A - 2 * r * joints, rel=1e-13) and found.first == found.last == 0
    h = 1e-6
    assert found.by_start == pytest.approx((straight(0.09 + h, -0.05).vector - straight(0.09 - h, -0.05).vector) / (2 * h), rel=1e-7)
    assert found.by_end == pytest.approx((straight(0.09, -0.05 + h).vector - straight(0.09, -0.05 - h).vector) / (2 * h), rel=1e-7)


@pytest.mark.property
@pytest.mark.parametrize(("right", "left"), PAIRS)
def test_a_strand_seen_from_its_other_end(right, left):
    A, r, k, found = reached(right, left, 0.08, 0.03, 7)
    _, _, _, mirrored = reached(left, right, -0.03, -0.08, 7)
    assert mirrored.vector == pytest.approx(np.conj(found.vector), rel=1e-12)
    assert mirrored.first == pytest.approx(-found.last, rel=1e-12)
    assert pressing(A, r, k, 0.2, 0.1, 0.05) == pytest.approx(
        np.sin(0.1)
        - (left * np.sin(0.1 + right / (right + left) * 0.2) + right * np.sin((right * 0.1 + left * 0.05) / (right + left))) / P / A
    )


@pytest.mark.analytical
@pytest.mark.parametrize(("right", "left"), PAIRS)
def test_bends_decay_by_the_effective_radius(right, left):
    link = pair(right, left)
    A, r, k, R = link.hole_pitch / P, link.radius / P, link.skew / P, link.effective_radius / P
    x = decay(A, r, k)
    assert R * (1 + x * x) == pytest.approx((1 + 2 * R) * x, rel=1e-12) and 0 < x < 1
    bend = plate_directions(A, r, k, True, 30, 1e-3, 0.0)
    assert bend[3] / bend[2] == pytest.approx(x, rel=1e-5)


@pytest.mark.analytical
@pytest.mark.parametrize(("right", "left"), PAIRS)
def test_every_joint_of_a_closed_chain_rolls(right, left):
    link = pair(right, left)
    closure = close(Drive(link, 19, 23, 50), 8)
    poses = plates(closure, states_at(closure, [0.1]))[0]
    place, turned = poses[:, 0] + 1j * poses[:, 1], poses[:, 2]
    after, next_turn = np.roll(place, -1), np.append(turned[1:], turned[0] - 2 * np.pi)
    gap = (place + 0.5 * link.hole_pitch * np.exp(1j * turned)) - (after - 0.5 * link.hole_pitch * np.exp(1j * next_turn))
    share = right / (right + left)
    joint = (right + left) * np.exp(1j * (share * turned + (1 - share) * next_turn))
    assert np.abs(gap - joint).max() < 1e-12 and closure.residual < 1e-12
    seat = seat_height(link, 19) - 1j * seat_shift(link, 19)
    assert place[0] == pytest.approx(seat * np.exp(1j * (turned[0] + np.pi / 2)), rel=1e-12), "row 0 sits on the driver"
    on_driven = np.abs(
        np.abs(place - states_at(closure, [0.1]).centre_distance[0]) - abs(seat_height(link, 23) - 1j * seat_shift(link, 23))
    )
    assert np.sum(on_driven < 1e-12) >= 8


@pytest.mark.property
@pytest.mark.parametrize(("right", "left"), PAIRS)
def test_the_mirror_image_is_the_same_drive(right, left):
    one, other = (close(Drive(pair(*radii), 19, 23, 50)) for radii in ((right, left), (left, right)))
    assert other.mean == pytest.approx(one.mean, rel=1e-12) and other.fluctuation == pytest.approx(one.fluctuation, rel=1e-6)
    assert other.transmission_ripple == pytest.approx(one.transmission_ripple, rel=1e-6)


@pytest.mark.property
@pytest.mark.parametrize(("right", "left"), [(0.9e-3, 1.8e-3), (0.8e-3, 2.4e-3), (0.5e-3, -3e-3)])
def test_to_second_order_the_effective_radius_is_all_that_counts(right, left):
    link = pair(right, left)
    equal = pair(2 * link.effective_radius, 2 * link.effective_radius)
    ours, theirs, hinge = (close(Drive(each, 35, 37, 82)) for each in (link, equal, design_link(P, 0.0, ANGLE, F0)))
    assert abs(ours.mean - theirs.mean) < 0.05 * (theirs.mean - hinge.mean)
    assert ours.fluctuation == pytest.approx(theirs.fluctuation, rel=0.02)
    leaving, alike = departure(link, 35), departure(equal, 35)
    assert leaving.rise == pytest.approx(alike.rise, rel=2e-3) and leaving.seating == pytest.approx(alike.seating, rel=2e-3)


@pytest.mark.property
def test_a_vanishing_radius_is_a_hinge():
    hinge = close(Drive(design_link(P, 0.0, ANGLE, F0), 35, 37, 82))
    for left in (1.2e-3, -1.2e-3):
        edge = close(Drive(pair(1e-9, left), 35, 37, 82))
        assert edge.mean == pytest.approx(hinge.mean, abs=2e-11) and edge.fluctuation == pytest.approx(hinge.fluctuation, rel=1e-3)


@pytest.mark.error
def test_surfaces_that_cannot_touch_on_one_line_are_refused():
    with pytest.raises(InputError, match="relative curvature"):
        close(Drive(pair(2e-3, -1.5e-3), 35, 37, 82))
    with pytest.raises(InputError, match="relative curvature"):
        close(Drive(pair(-2e-3, -1.5e-3), 35, 37, 82))
    with pytest.raises(InputError, match="two equal radii"):
        chordal_rise(pair(0.9e-3, 1.8e-3), 35)
