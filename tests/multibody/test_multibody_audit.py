"""The energy audit against powers whose work is known: exact over uneven steps, by kind; its errors over what they say."""

import numpy as np
import pytest

from drivewright.multibody.analyses.energy_audit import IDLE, audit, audit_of_samples
from drivewright.multibody.observe import POWER_FIELDS
from drivewright.multibody.record import Record

pytestmark = pytest.mark.analytical

TURNS = 3
DRIVES = POWER_FIELDS.index("drives")
AUDITS = pytest.mark.parametrize("by", [audit, audit_of_samples])


def seen(t, powers, energy, kinetic):
    """A `Record` of which only powers and energy are known."""
    return Record(
        t, {}, np.zeros((len(t), 0, 8)), powers, np.zeros((len(t), 0)), np.zeros((len(t), 0, 7)), energy, kinetic, np.zeros((1, 12))
    )


def halved(steps):
    """Times with one in the middle of each uneven step."""
    edges = np.cumsum([0.7, *np.random.default_rng(3).uniform(0.01, 0.4, steps)])
    return np.sort(np.concatenate([edges, (edges[1:] + edges[:-1]) / 2]))


@pytest.mark.parametrize(("by", "degree"), [(audit, 3), (audit_of_samples, 2)])
def test_work_of_polynomial_powers_is_exact_over_uneven_steps(by, degree):
    t, rng = halved(12), np.random.default_rng(5)
    powers = [np.polynomial.Polynomial(rng.uniform(-1, 1, degree + 1)) for _ in POWER_FIELDS]
    works = np.stack([power.integ(lbnd=t[0])(t) for power in powers], axis=1)
    energy = 4.0 + works.sum(axis=1)
    found = by(seen(t, np.stack([power(t) for power in powers], axis=1), energy, energy))
    assert found.works == pytest.approx(works[np.isin(t, found.t)], rel=0, abs=1e-12)
    assert found.t[-1] == t[-1] and found.gap == pytest.approx(np.zeros(len(found.t)), abs=1e-12)


def swing(drives, others, missing=0.0):
    """Kinetic energy sin(t) of drives that give a part of it and springs the rest; torques from outside that springs take up; from the
    middle on some energy is missing."""
    t = np.linspace(0.0, TURNS * 2 * np.pi, 24001)
    cos = np.cos(t)
    powers = np.zeros((len(t), len(POWER_FIELDS)))
    powers[:, DRIVES] = drives * cos
    powers[:, POWER_FIELDS.index("springs")] = (1 - drives - others) * cos
    powers[:, POWER_FIELDS.index("applied")] = others * cos
    return seen(t, powers, 7.0 + np.sin(t) - missing * (t > t[-1] / 2), 2.0 + np.sin(t))


@AUDITS
@pytest.mark.parametrize("missing", [0.03, -0.03])
@pytest.mark.parametrize(("drives", "others"), [(1.0, 0.0), (0.6, 0.0), (1.3, -2.0), (0.2, 0.1)])
def test_the_errors_are_the_gap_over_what_is_exchanged_and_over_what_drives_do(by, drives, others, missing):
    """A turn has |cos| = 4 of power either way, and the kinetic energy rises and falls by 4."""
    found = by(swing(drives, others, missing))
    flow = 4 * TURNS * (abs(drives) + abs(others) + abs(1 - drives - others))
    assert found.gap[-1] == pytest.approx(-missing, rel=1e-6)
    assert found.error == pytest.approx(0.03 / (flow + 4 * TURNS), rel=1e-5)
    assert found.power_error == pytest.approx(0.03 / (4 * TURNS * drives), rel=1e-5)


@AUDITS
@pytest.mark.parametrize("drives", [0.0, 1e-4, 1e-2])
def test_drives_that_do_next_to_nothing_count_as_a_thousandth_of_the_exchange(by, drives):
    found = by(swing(drives, 0.0, 0.03))
    assert found.exchanged == pytest.approx(8 * TURNS, rel=1e-5)
    assert found.power_error == pytest.approx(0.03 / (4 * TURNS * max(drives, 2 * IDLE)), rel=1e-5) and IDLE == 1e-3


@AUDITS
def test_what_stands_still_has_no_error(by):
    t = np.linspace(0.0, 1.0, 11)
    found = by(seen(t, np.zeros((11, len(POWER_FIELDS))), np.full(11, 3.0), np.zeros(11)))
    assert found.error == 0.0 and found.power_error == 0.0
