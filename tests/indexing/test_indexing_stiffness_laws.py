"""Laws of what yields in an indexer: the force is the gradient of the energy, the stiffness that of the force, and it never falls."""

import numpy as np
import pytest

from drivewright.bearings import bearing
from drivewright.indexing.drivetrain import PinContact, PowerLawBearing, pin_contact
from drivewright.indexing.stiffness.laws import GearFlankLaw, PinContactLaw, RigidContactLaw, radial_bearing_law
from drivewright.indexing.stiffness.minimise import ConvexEnergy, ConvexTerm, gradient_and_hessian, minimise_energy, total_energy

pytestmark = pytest.mark.property

STEP = 1e-9
CONTACTS = {
    "line and series": PinContactLaw(pin_contact(0.018, 5e8), False),
    "line and series, both ways": PinContactLaw(pin_contact(0.018, 5e8), True),
    "line": PinContactLaw(PinContact(2e9), False),
    "series": PinContactLaw(PinContact(series=5e8), False),
    "series, both ways": PinContactLaw(PinContact(series=5e8), True),
    "rigid": RigidContactLaw(np.full((40, 1), 300.0), np.array(3e8), False),
    "rigid, both ways": RigidContactLaw(np.full((40, 1), -300.0), np.array(3e8), True),
    "flank": GearFlankLaw(2.8e8),
}
BEARINGS = {
    "linear": PowerLawBearing(4e8),
    "linear with clearance": PowerLawBearing(4e8, clearance=4e-6),
    "ball": PowerLawBearing(3e10, 1.5),
    "roller with clearance": PowerLawBearing(2e9, 10 / 9, 3e-6),
    "rolling, balls": bearing("61904"),
    "rolling, balls with clearance": bearing("61904").replace(radial_clearance="8 um"),
    "rolling, rollers": bearing("NU207E"),
}
LAWS = CONTACTS | {name: radial_bearing_law(each) for name, each in BEARINGS.items()}


def strains(name, seed=3):
    """(40, c) strains of +-20 um, away from where the force begins."""
    found = np.random.default_rng(seed).uniform(-2e-5, 2e-5, (40, 1 if name in CONTACTS else 2))
    return np.where(np.abs(found) < 2e-7, 3e-7, found)


@pytest.mark.parametrize("name", LAWS)
def test_force_is_the_gradient_and_stiffness_that_of_the_force(name):
    law, d = LAWS[name], strains(name)
    _, force, stiffness = law(d)
    sizes = np.abs(force).max(), np.abs(stiffness).max()
    for k, way in enumerate(np.eye(d.shape[1])):
        (v1, f1, _), (v0, f0, _) = law(d + STEP * way), law(d - STEP * way)
        assert (v1 - v0) / (2 * STEP) == pytest.approx(force[:, k], rel=1e-5, abs=1e-6 * sizes[0])
        kinks = 3  # strains within a step of where an element begins to carry
        wrong = np.abs((f1 - f0) / (2 * STEP) - stiffness[:, :, k]).max(axis=1) > 1e-3 * sizes[1]
        assert np.sum(wrong) <= kinks
    assert stiffness == pytest.approx(np.swapaxes(stiffness, 1, 2), rel=1e-12)


@pytest.mark.parametrize("name", LAWS)
def test_the_force_never_falls(name):
    """(F(a) - F(b)).(a - b) >= 0: convex energy."""
    a, b = strains(name), strains(name, seed=8)
    assert np.all(np.sum((LAWS[name](a)[1] - LAWS[name](b)[1]) * (a - b), axis=1) >= 0)


@pytest.mark.parametrize("name", LAWS)
def test_unloaded_at_rest(name):
    if name.startswith("rigid"):  # loaded by its multiplier
        return
    value, force, stiffness = LAWS[name](np.zeros((40, LAWS[name](strains(name))[1].shape[1])))
    assert np.all(value == 0) and np.all(np.abs(force) < 1e-9) and np.all(np.isfinite(stiffness))


def test_a_rolling_bearing_with_clearance_is_free_within_it():
    """8 um across the diameter, held in the middle of its axial play: nothing up to 4 um, then a force."""
    force = LAWS["rolling, balls with clearance"](np.array([[3.9e-6, 0.0], [0.0, -3.9e-6], [6e-6, 0.0]]))[1]
    assert np.all(force[:2] == 0) and force[2, 0] > 1


@pytest.mark.parametrize("name", ["line and series, both ways", "series, both ways", "ball", "linear with clearance", "rolling, rollers"])
def test_odd(name):
    d = strains(name)
    assert LAWS[name](-d)[1] == pytest.approx(-LAWS[name](d)[1], rel=1e-9, abs=1e-6)


@pytest.mark.parametrize("name", ["linear with clearance", "ball", "roller with clearance"])
def test_a_power_law_has_no_preferred_direction(name):
    d, turn = strains(name), np.array([[np.cos(0.7), -np.sin(0.7)], [np.sin(0.7), np.cos(0.7)]])
    _, force, stiffness = LAWS[name](d)
    _, turned_force, turned_stiffness = LAWS[name](d @ turn.T)
    assert turned_force == pytest.approx(force @ turn.T, rel=1e-10, abs=1e-8)
    assert turned_stiffness == pytest.approx(turn @ stiffness @ turn.T, rel=1e-9, abs=1e-3)


def system(seed=5):
    """Two positions of a random system of six unknowns under laws of both kinds."""
    rng = np.random.default_rng(seed)
    kinds = ((5, 1, "line and series"), (3, 2, "ball"), (2, 2, "roller with clearance"), (2, 1, "series, both ways"))
    parts = tuple(ConvexTerm(rng.normal(size=(2, k, c, 6)), rng.normal(scale=1e-6, size=(2, k, c)), LAWS[name]) for k, c, name in kinds)
    return ConvexEnergy(np.tile(1e5 * np.eye(6), (2, 1, 1)), parts, rng.normal(scale=3e3, size=(2, 6)))


def test_slope_and_hessian_of_a_system():
    whole, y = system(), np.random.default_rng(1).normal(scale=1e-5, size=(2, 6))
    gradient, hessian = gradient_and_hessian(whole, y)
    for k, way in enumerate(np.eye(6)):
        assert (total_energy(whole, y + STEP * way) - total_energy(whole, y - STEP * way)) / (2 * STEP) == pytest.approx(
            gradient[:, k], rel=1e-5
        )
        change = gradient_and_hessian(whole, y + STEP * way)[0] - gradient_and_hessian(whole, y - STEP * way)[0]
        assert change / (2 * STEP) == pytest.approx(hessian[:, :, k], rel=2e-3, abs=2e-4 * np.abs(hessian).max())


def test_rest_is_the_minimum():
    whole = system()
    found = minimise_energy(whole, np.full((2, 6), 1e-6), 1.0)
    assert found.converged.all()
    least = total_energy(whole, found.y)
    for shift in np.random.default_rng(2).normal(scale=1e-6, size=(50, 2, 6)):
        assert np.all(total_energy(whole, found.y + shift) > least)


def test_rest_from_far_away_is_the_same():
    whole = system()
    near, far = (minimise_energy(whole, np.full((2, 6), start), 1.0).y for start in (1e-6, 3e-3))
    assert far == pytest.approx(near, rel=1e-9, abs=1e-15)
