"""Loads and lives of an indexer's bearings, clearances, seats: definitions and closed forms."""

from functools import cache

import numpy as np
import pytest

import drivewright as dw
from drivewright import bearings, registry
from drivewright.indexing.solid import ShaftBody
from drivewright.indexing.solid.parts import seated
from drivewright.indexing.stiffness import statics
from drivewright.indexing.stiffness.laws import radial_bearing_law
from drivewright.indexing.stiffness.rolling import rolling_bearing_law
from drivewright.runner import build
from drivewright.units import SI

pytestmark = pytest.mark.analytical

PRESETS = registry.mechanism("indexer").presets()
RATED = ('crank_bearings.dynamic_rating="50 kN"', 'support_bearings.dynamic_rating="6 kN"', 'load.speed="90 rpm"', 'contact.model="bonded"')


def spec(*changes):
    return dw.load(PRESETS["default"], changes)


@cache
def loads():
    return dw.run(spec(*RATED), ("bearings",))


def test_the_mean_load_of_a_turn_counts_its_start_once():
    """(mean F^p)^(1/p); positions without a load are left out."""
    assert statics.equivalent_load(np.array([3.0, 4.0, np.nan, 5.0, 3.0]), 3) == pytest.approx((216 / 3) ** (1 / 3), rel=1e-14)
    assert statics.equivalent_load(np.full(4, np.nan), 3) == 0


@pytest.mark.parametrize(("group", "power", "rating"), [("crank", 10 / 3, 50e3), ("support", 3, 6e3)])
def test_lives_of_the_bearings_from_their_own_table(group, power, rating):
    """L10 = 10^6 (C/P)^p turns, p = 10/3 for rollers and 3 for balls, P the mean over a whole turn of the worst bearing."""
    result = loads()
    table = result.tables["bearing_loads"]
    assert table["angle"].data[[0, -1]] == pytest.approx([0, 2 * np.pi]) and len(table["angle"].data) == 81
    own = [each.data for each in table.columns if each.name.startswith(group) and not each.name.endswith((".x", ".y"))]
    assert len(own) == 4
    means = [np.mean(load[:-1] ** power) ** (1 / power) for load in own]
    assert np.ptp(means) > 0.01 * max(means)
    assert result[f"{group}.max_load"] == pytest.approx(np.max(own), rel=1e-12)
    assert result[f"{group}.equivalent_load"] == pytest.approx(max(means), rel=1e-9)
    turns = 1e6 * (rating / max(means)) ** power
    assert result[f"{group}.basic_life"] == pytest.approx(turns, rel=1e-9)
    assert result[f"{group}.basic_life.time"] == pytest.approx(turns / 1.5, rel=1e-9)  # 90 turns a minute


@pytest.mark.parametrize(
    "changes", [("crank_bearings.bearing=", 'crank_bearings.law="elements"', 'crank_bearings.stiffness="3e8 N/m"'), ()]
)
def test_clearance_is_across_the_diameter(changes):
    """Radial clearance of 20 um lets a ring move by 10 um either way."""
    law = radial_bearing_law(build(spec(*changes, 'crank_bearings.radial_clearance="20 um"')).train.crank)
    force = law(np.array([[6e-6, 7.9e-6], [6e-6, 8.1e-6]]))[1]
    assert np.all(force[0] == 0) and np.all(force[1] > 0)


def test_where_the_rings_of_a_rolling_bearing_are_held():
    """With a contact angle where it just touches: any radial move presses; without, in the middle of its axial play."""
    angular = bearings.BallBearing(balls=12, ball_diameter=SI(8e-3), pitch_diameter=SI(40e-3), contact_angle=SI(np.radians(25)))
    assert rolling_bearing_law(angular).axial == 0.0
    at_once = rolling_bearing_law(angular)(np.array([[1e-7, 0.0], [0.0, -1e-7]]))[1]
    assert at_once[0, 0] > 0 > at_once[1, 1]


def test_what_printed_crank_loads_have_wrong():
    """(8) as printed less (8) corrected: -(yb/l)(Fx + Fy) in the first bearing, 2 (yb/l) Fx in the second; then the couple M/l."""
    force, centre, spacing = 700.0 - 400.0j, 0.004 + 0.009j, 0.11
    printed = np.array(statics.crank_loads_printed(force, centre, spacing))
    right = np.array(statics.crank_loads(force, 0.0, centre, spacing))
    assert printed - right == pytest.approx(0.009j / 0.11 * np.array([400.0 - 700.0, 2 * 700.0]), abs=1e-9)
    with_moment = np.array(statics.crank_loads(force, 33.0, centre, spacing))
    assert with_moment - right == pytest.approx(np.array([300j, -300j]), abs=1e-9)


def test_seats_are_as_wide_as_the_bearing_and_of_the_thinner_shaft():
    shaft = build(spec()).train.shaft
    found = seated(shaft, ShaftBody(35e-3, 18e-3, 9e-3, 14e-3))
    ends = np.cumsum([0.0, *(section.length for section in found.sections)])
    assert ends[-1] == pytest.approx(0.1)

    def at(z):
        return found.sections[int(np.searchsorted(ends, z)) - 1].start

    assert [at(z) for z in (0.0204, 0.0206, 0.0294, 0.0296, 0.0499, 0.0501, 0.0749, 0.0751, 0.0999)] == [
        0.02,
        0.02,
        0.02,
        0.025,
        0.025,
        0.03,
        0.03,
        0.025,
        0.025,
    ]
