"""Wear of a chain's joints: closed forms, the same volume from the wear of a bearing on bins, the lune between two circles."""

import numpy as np
import pytest
from shapely.geometry import Point

from drivewright.chains.path import Balance, Route, Station
from drivewright.chains.wear import (
    JointWear,
    articulations,
    elongation,
    elongation_limit,
    joint_wear,
    path_articulations,
    revolutions_to,
    sliding_per_revolution,
)
from drivewright.contact.wear import deposit

K, D, L, P = 1.3e-16, 4.45e-3, 10.95e-3, 12.7e-3


@pytest.mark.analytical
def test_the_closed_form():
    """h = pi k (Ft + Fs)(1/z1 + 1/z2)/L: onto and off each sprocket once under either strand."""
    turns = articulations((19, 38), 900.0, 150.0)
    assert joint_wear(K, D, L, turns) == pytest.approx(np.pi * K * (900 + 150) * (1 / 19 + 1 / 38) / L, rel=1e-13, abs=0)
    assert sliding_per_revolution(D, turns) == pytest.approx(2 * np.pi * D * (1 / 19 + 1 / 38), rel=1e-13, abs=0)


@pytest.mark.analytical
def test_tight_and_slack_strand_bend_on_both_sprockets():
    assert [(turn.angle, turn.force) for turn in articulations((10, 20), 5.0, 3.0)] == [
        (pytest.approx(2 * np.pi / 10), 5.0),
        (pytest.approx(2 * np.pi / 10), 3.0),
        (pytest.approx(2 * np.pi / 20), 3.0),
        (pytest.approx(2 * np.pi / 20), 5.0),
    ]
    assert articulations((10, 20), 5.0, -3.0)[1].force == 0


def path(wraps, per_turn, pulls, centrifugal=0.0):
    """A balance with these wraps and pulls; where its strands run does not matter."""
    stations = tuple(Station(k, 0.1, -1, each, str(k)) for k, each in enumerate(per_turn))
    none = np.zeros(len(wraps))
    return Balance(Route(stations, none, none, np.array(wraps), none + 0j, 0.0), none, np.array(pulls), centrifugal, 0.0)


@pytest.mark.analytical
def test_two_sprockets_on_a_path_are_the_two_of_the_closed_form():
    found = path_articulations(path([3.0, 3.28], [19, 38], [150.0, 900.0], 25.0))
    wear = joint_wear(K, D, L, found)
    assert wear == pytest.approx(joint_wear(K, D, L, articulations((19, 38), 925.0, 175.0)), rel=1e-13, abs=0)
    assert wear == pytest.approx(np.pi * K * (925 + 175) * (1 / 19 + 1 / 38) / L, rel=1e-13, abs=0)


@pytest.mark.analytical
def test_every_body_on_the_path_bends_the_chain_by_a_tooth_or_by_its_wrap():
    """Driver, idler under the pull of its own strands, driven sprocket, rail with friction that takes pull from the chain."""
    pulls = [150.0, 150.0, 900.0, 880.0]  # of the strands that leave the driver, the idler, the driven sprocket, the rail
    wide = path_articulations(path([3.1, 0.6, 3.4, 0.2], [19, 15, 38, 200.0], pulls))
    teeth = 150 / 15 + (880 + 150) / 2 / 19 + (150 + 900) / 2 / 38 + (900 + 880) / 2 / 200
    assert joint_wear(K, D, L, wide) == pytest.approx(2 * np.pi * K * teeth / L, rel=1e-13, abs=0)
    assert sliding_per_revolution(D, wide) == pytest.approx(2 * np.pi * D * (1 / 19 + 1 / 15 + 1 / 38 + 1 / 200), rel=1e-13, abs=0)
    small = path_articulations(path([3.1, 0.1, 3.4, 0.2], [19, 15, 38, 200.0], pulls))  # the idler is wrapped by less than a tooth
    assert sliding_per_revolution(D, wide) - sliding_per_revolution(D, small) == pytest.approx(D * (2 * np.pi / 15 - 0.1), rel=1e-12, abs=0)
    left = path_articulations(path([3.1, -0.1, 3.4, 0.2], [19, 15, 38, 200.0], pulls))
    assert [turn.angle for turn in left[2:4]] == [0.0, 0.0]


@pytest.mark.analytical
def test_the_same_volume_as_of_a_bearing_whose_history_is_followed():
    """The bush in the pin's frame: the contact stays at the side of the force while the pin turns under it, tooth by tooth."""
    turns, rate, bins = articulations((17, 23), 700.0, 200.0), 11.0, 360
    time, force, slip = [0.0], [0.0], [0.0]
    for turn in turns:
        ends = time[-1] + np.array([1e-6, 1e-6 + turn.angle / rate, 2e-6 + turn.angle / rate])
        time += [time[-1] + 1e-9, *ends]
        force += [0.0, turn.force, turn.force, 0.0]
        slip += [0.0, rate * D / 2, rate * D / 2, 0.0]
    depths = deposit(np.array(time), np.zeros(len(time)), np.array(force), np.array(slip), K, D / 2, L, bins)
    volume = depths.sum() * 2 * np.pi / bins * (D / 2) * L
    assert volume / (D * L) == pytest.approx(joint_wear(K, D, L, turns), rel=2e-4, abs=0)


@pytest.mark.analytical
def test_a_bush_that_moves_by_h_has_worn_off_a_lune_of_h_times_the_diameter():
    radius, moved = 1.0, 1e-3
    circle, shifted = Point(0, 0).buffer(radius, 20000), Point(moved, 0).buffer(radius, 20000)
    assert shifted.difference(circle).area == pytest.approx(2 * radius * moved, rel=1e-6)


@pytest.mark.property
def test_scaling():
    turns = articulations((19, 38), 900.0, 150.0)
    wear = joint_wear(K, D, L, turns)
    assert joint_wear(3 * K, D, L, turns) == pytest.approx(3 * wear, rel=1e-12, abs=0)
    assert joint_wear(K, 2 * D, L, turns) == pytest.approx(wear, rel=1e-12, abs=0), "the path grows as the pressure falls"
    assert joint_wear(K, D, 2 * L, turns) == pytest.approx(wear / 2, rel=1e-12, abs=0) and joint_wear(K, D, L, turns, 2) == pytest.approx(
        wear / 2, abs=0
    )
    assert joint_wear(K, D, L, articulations((38, 76), 900.0, 150.0)) == pytest.approx(wear / 2, rel=1e-12, abs=0)
    assert np.all(joint_wear(np.array([K, 2 * K]), D, L, turns) == np.array([wear, 2 * wear]))


@pytest.mark.analytical
def test_the_life_is_where_the_elongation_reaches_its_limit():
    turns = articulations((19, 38), 900.0, 150.0)
    wear = joint_wear(K, D, L, turns)
    revolutions = revolutions_to(0.02, P, wear)
    assert elongation(P, wear, revolutions) == pytest.approx(0.02, rel=1e-13, abs=0)
    found = JointWear(1.0, np.array([wear, 2 * wear]), 0.3)
    assert found.elongation(0.3 * revolutions, P) == pytest.approx([0.02, 0.04])


@pytest.mark.analytical
def test_many_teeth_end_the_life_before_the_limit():
    assert (
        elongation_limit(0.03, (19, 57)) == 0.03 and elongation_limit(0.03, (19, 100)) == 0.02 and elongation_limit(0.01, (19, 57)) == 0.01
    )
