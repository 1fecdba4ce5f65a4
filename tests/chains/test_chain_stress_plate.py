"""Stress of a chain's plate: the bearing law, superposition against direct solutions, symmetry, scaling, inertia."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from drivewright.chains.link import design_link
from drivewright.chains.plate import design_plate
from drivewright.chains.plate_holes import HingePin
from drivewright.chains.stress import bearing
from drivewright.chains.stress.plate import Loads, amounts, plate_basis, plate_body, stress_history, stress_picture, unbalanced, worst
from drivewright.errors import InputError
from drivewright.solids.plane import order_error, plane_von_mises

pytestmark = [pytest.mark.analytical, pytest.mark.needs_fe]
PULL = 200.0


@cache
def plate():
    return design_plate(design_link(9.525e-3, 1.2e-3, np.radians(30), 2.6e-3))


@cache
def basis():
    return plate_basis(plate(), plate_body(plate(), 206e9, 0.3))


def pulled(angle, size=PULL):
    """Loads: both pins pull outwards along a line that leans by an angle [deg]."""
    force = size * np.array([np.cos(np.radians(angle)), np.sin(np.radians(angle))])
    return Loads(np.array([[-force, force]]), np.zeros((1, 2)), np.zeros((1, 2)))


def seats(found):
    return [bearing.seat_of(found.body, plate(), side) for side in ("left", "right")]


def direct(found, left, right):
    """Stress along the rim by a solution of its own, the pressures of the very directions."""
    traction = np.zeros((1, len(found.body.rim.name), 2))
    for seat, force in zip(seats(found), (left, right), strict=True):
        traction[0, seat.rows] += bearing.cosine_pressure(seat, force)[:, None] * seat.outward
    return found.body.stress(found.body.solve(traction))[0], traction


def test_cosine_law_of_a_half_seat():
    """Peak 4 F/(pi d t) and a pressure that falls as the cosine from the force's direction."""
    seat = seats(basis())[1]
    pressure = bearing.cosine_pressure(seat, (200 * np.cos(0.3), 200 * np.sin(0.3)))
    peak = 4 * 200 / (np.pi * 2.4e-3 * 2e-3)
    assert np.allclose(pressure, peak * np.maximum(np.cos(seat.turn - 0.3), 0), atol=0.004 * peak)
    assert np.allclose((seat.area * pressure) @ seat.outward, [200 * np.cos(0.3), 200 * np.sin(0.3)], rtol=1e-12)


def test_a_seat_cut_off_still_carries_the_force():
    """80 deg from the middle of the seat the half circle is cut off: another pressure, the same force."""
    seat = seats(basis())[1]
    force = 100 * np.array([np.cos(1.9), np.sin(1.9)])
    pressure = bearing.cosine_pressure(seat, force)
    assert np.allclose((seat.area * pressure) @ seat.outward, force, rtol=1e-9)
    assert pressure.min() >= 0
    assert pressure.max() > 1.1 * 4 * 100 / (np.pi * 2.4e-3 * 2e-3)


def test_both_ends_are_prepared_alike():
    """Turns are counter-clockwise from the direction outwards, so a mirrored plate turns them round; never more than 10 deg apart."""
    left, right = basis().directions
    assert np.allclose(left, -right[::-1], atol=0.01)
    assert np.diff(right).max() <= np.radians(10.0) * (1 + 1e-12)
    assert right[0] < np.radians(-90) < np.radians(90) < right[-1]


@pytest.mark.parametrize("angle", [3.0, 8.5, 21.4, 50.0])
def test_superposition_is_the_direct_solution_within_two_per_cent(angle):
    force = PULL * np.array([np.cos(np.radians(angle)), np.sin(np.radians(angle))])
    exact, _ = direct(basis(), -force, force)
    ours = stress_history(basis(), pulled(angle))[0]
    assert np.abs(plane_von_mises(ours) - plane_von_mises(exact)).max() < 0.01 * plane_von_mises(exact).max()
    assert plane_von_mises(ours).max() == pytest.approx(plane_von_mises(exact).max(), rel=2e-3)


def test_superposition_is_exact_in_a_prepared_direction():
    turn = basis().directions[1][12]
    force = PULL * np.array([np.cos(turn), np.sin(turn)])
    left = basis().directions[0][9]
    exact, _ = direct(basis(), [-70 * np.cos(left), -70 * np.sin(left)], force)
    loads = Loads(np.array([[[-70 * np.cos(left), -70 * np.sin(left)], force]]), np.zeros((1, 2)), np.zeros((1, 2)))
    assert np.allclose(stress_history(basis(), loads)[0], exact, atol=1e-6 * np.abs(exact).max())


def test_the_elements_are_fine_enough():
    _, traction = direct(basis(), [-PULL, 0.0], [PULL, 0.0])
    assert order_error(basis().body, traction)[0] < 0.01


def test_equilibrium_at_the_rim():
    """The stress on the rim's normals is the load there, within a few per cent of the greatest stress."""
    loads = pulled(6.0)
    s, n = stress_history(basis(), loads)[0], basis().body.rim.normals
    load = np.tensordot(amounts(basis(), loads), basis().tractions, axes=1)[0]
    got = np.stack([s[:, 0] * n[:, 0] + s[:, 2] * n[:, 1], s[:, 2] * n[:, 0] + s[:, 1] * n[:, 1]], axis=1)
    assert np.abs(got - load).max() < 0.03 * plane_von_mises(s).max()


def test_mirrored_loads_give_mirrored_stress():
    here = Loads([[[-180.0, -20.0], [190.0, -35.0]]], [[60.0, 25.0]], [[-3.2e-3, -4.0e-3]])
    there = Loads([[[-190.0, -35.0], [180.0, -20.0]]], [[25.0, 60.0]], [[-4.0e-3, -3.2e-3]])
    tops = [
        [plane_von_mises(stress_history(basis(), loads)[0, basis().body.on(f"hole{k}:*")]).max() for k in (0, 1)] for loads in (here, there)
    ]
    assert tops[0] == pytest.approx(tops[1][::-1], rel=5e-3)
    assert tops[0][0] != pytest.approx(tops[0][1], rel=0.02)
    peaks = [worst(basis(), loads) for loads in (here, there)]
    assert peaks[0].stress == pytest.approx(peaks[1].stress, rel=5e-3)
    assert peaks[0].place[0] == pytest.approx(-peaks[1].place[0], abs=1e-4)


def test_stress_scales_with_force_and_thickness():
    thick = replace(plate(), thickness=3e-3)
    other = plate_basis(thick, plate_body(thick, 206e9, 0.3))
    one, two, three = worst(basis(), pulled(4.0)), worst(basis(), pulled(4.0, 2.5 * PULL)), worst(other, pulled(4.0))
    assert two.stress == pytest.approx(2.5 * one.stress, rel=1e-9)
    assert three.stress == pytest.approx(one.stress * 2 / 3, rel=1e-6)


def test_the_crotch_is_the_worst_place_and_a_history_finds_its_instant():
    history = Loads(np.array([[[-f, 0.0], [f, 0.0]] for f in (50.0, PULL, 120.0)]), np.zeros((3, 2)), np.zeros((3, 2)))
    peak = worst(basis(), history)
    assert peak.instant == 1
    assert peak.stress == pytest.approx(223e6, rel=0.01)  # of this plate; the same on meshes twice as fine
    assert abs(peak.place[0]) == pytest.approx(1.55e-3, abs=0.1e-3)
    assert stress_history(basis(), history, [peak.row]).shape == (3, 1, 3)
    assert plane_von_mises(stress_history(basis(), history, [peak.row]))[1, 0] == pytest.approx(peak.stress)
    table = stress_picture(basis(), history, 1)
    assert table["mises"].data.max() == pytest.approx(peak.stress, rel=0.02)


def test_flank_forces_keep_their_place():
    """Force and moment of a flank pressed between two prepared places are those of a force there."""
    height, force, a = -3.61e-3, 80.0, np.radians(30)
    forces, moments = unbalanced(basis(), Loads(np.zeros((1, 2, 2)), [[0.0, force]], [[0.0, height]]))
    push = -force * np.array([np.cos(a), -np.sin(a)])
    assert np.allclose(forces[0], push, rtol=1e-12)
    x = (plate().link.flank_support + height * np.sin(a)) / np.cos(a)
    assert moments[0] == pytest.approx(x * push[1] - height * push[0], rel=1e-3)


def test_flank_stress_spreads_from_its_place():
    """Away from the flank the pressure's shape does not matter: halfway between two places the mean of both."""
    places = basis().heights[1]

    def pressed(height):
        return stress_history(basis(), Loads([[[-100.0, 0.0], [100.0, 0.0]]], [[0.0, 60.0]], [[0.0, height]]))[0, basis().bare]

    assert np.allclose(pressed((places[2] + places[3]) / 2), (pressed(places[2]) + pressed(places[3])) / 2, atol=1.0)
    assert not np.allclose(pressed(places[2]), pressed(places[3]), atol=1e5)


def test_the_worst_place_is_not_under_a_flank_s_made_up_pressure():
    top = basis().heights[0].max()
    loads = Loads(np.zeros((1, 2, 2)), [[100.0, 100.0]], [[top, top]])
    everywhere = plane_von_mises(stress_history(basis(), loads)[0])
    assert not basis().bare[everywhere.argmax()]
    assert worst(basis(), loads).stress == everywhere[basis().bare].max() < everywhere.max()


def test_a_balanced_seated_plate_is_not_accelerated():
    a, lift = np.radians(30), 9.0
    flank = lift / np.sin(a)
    loads = Loads([[[-100.0, -lift], [100.0, -lift]]], [[flank, flank]], [[-3.5e-3, -3.5e-3]])
    forces, moments = unbalanced(basis(), loads)
    assert np.abs(forces).max() < 1e-9
    assert abs(moments[0]) < 1e-5


def test_a_hinge_s_hole_takes_forces_all_around():
    hinge = replace(plate(), link=design_link(9.525e-3, 0.0, np.radians(30), 2.6e-3), pins=HingePin(1.2e-3), toe=-3.5e-3)
    found = plate_basis(hinge, plate_body(hinge, 206e9, 0.3))
    assert np.isclose(np.ptp(found.directions[0]), 2 * np.pi)
    inwards = Loads([[[100.0, 0.0], [-100.0, 1e-9]]], np.zeros((1, 2)), np.zeros((1, 2)))
    outwards = Loads([[[-100.0, 0.0], [100.0, 0.0]]], np.zeros((1, 2)), np.zeros((1, 2)))
    for loads in (inwards, outwards):
        assert np.abs(unbalanced(found, loads)[0]).max() < 1e-6
        assert worst(found, loads).stress > 20e6


def test_a_small_force_off_the_seat_acts_at_its_end():
    """Below 5 % of the greatest force, in full, at the end that is nearer; one prepared direction carries it."""
    ready = basis().directions[1]
    turns = np.array([0.3, ready[-1] + 0.4, ready[0] - 0.2, np.pi - 1e-3])
    sizes = np.array([200.0, 9.9, 7.0, 1e-3])
    share = bearing.shares(turns, ready, sizes)
    assert share[1:] == pytest.approx(
        np.array([[0.0] * (len(ready) - 1) + [9.9], [7.0] + [0.0] * (len(ready) - 1), [0.0] * len(ready)]), abs=2e-3
    )
    assert share[3, -1] == pytest.approx(1e-3, rel=1e-12) and np.count_nonzero(share[1:] > 1e-12) == 3
    within = bearing.shares(np.clip(turns, ready[0], ready[-1]), ready, sizes)
    assert share == pytest.approx(within, rel=1e-12, abs=1e-12)


def test_a_force_off_the_seat_of_more_than_a_twentieth_is_refused():
    ready = basis().directions[1]
    turns = np.array([0.0, ready[-1] + 0.4])
    assert bearing.shares(turns, ready, np.array([200.0, 9.99])).shape == (2, len(ready))
    with pytest.raises(InputError, match=r"at 1 of 2 instants a pin's force points away from its seat, worst at instant 1: 10\.01 N"):
        bearing.shares(turns, ready, np.array([200.0, 10.01]))


def test_messages():
    slack = Loads(np.array([[[-100.0, 0.0], [100.0, 0.0]], [[-1.0, 0.0], [-30.0, 2.0]]]), np.zeros((2, 2)), np.zeros((2, 2)))
    with pytest.raises(InputError, match=r"1 of 2 instants .* worst at instant 1: 30\.\d+ N at 176.*° .* slack there"):
        amounts(basis(), slack)
    with pytest.raises(InputError, match=r"right flank is pressed at a height of -9 mm \(instant 0, 1 in all\)"):
        amounts(basis(), Loads(np.zeros((1, 2, 2)), [[0.0, 5.0]], [[0.0, -9e-3]]))
    with pytest.raises(InputError, match="not below 0 .* the smallest is -5 N"):
        amounts(basis(), Loads(np.zeros((1, 2, 2)), [[0.0, -5.0]], [[0.0, -4e-3]]))
    with pytest.raises(InputError, match=r"pins \(2, 2\)"):
        amounts(basis(), Loads(np.zeros((2, 2)), np.zeros((1, 2)), np.zeros((1, 2))))
