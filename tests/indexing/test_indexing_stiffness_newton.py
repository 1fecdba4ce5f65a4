"""Newton's method in compiled code beside the same with NumPy: random systems of all laws, drives of all kinds, starts from far away."""

import numpy as np
import pytest
from scipy.optimize import brentq

from drivewright._jit import plain
from drivewright.bearings import bearing
from drivewright.contact import PowerLaw, power_law_response
from drivewright.indexing.contacts import CamContacts
from drivewright.indexing.drivetrain import Drivetrain, GearMesh, PinContact, PowerLawBearing, SplitShaft, pin_contact
from drivewright.indexing.stiffness import newton, solve_torsional_stiffness
from drivewright.indexing.stiffness.laws import (
    GearFlankLaw,
    LineContact,
    PinContactLaw,
    RadialBearingLaw,
    RigidContactLaw,
    contact_response,
    radial_bearing_law,
    radial_response,
)
from drivewright.indexing.stiffness.minimise import ConvexEnergy, ConvexTerm, gradient_and_hessian, minimise_energy
from drivewright.indexing.stiffness.newton import is_compiled, minimise_by_position, minimise_positions, newton_work, position_energy
from drivewright.shafts import Section

pytestmark = pytest.mark.property

SHAFT = SplitShaft((Section(0.06, 0.02, 0.02), Section(0.055, 0.03, 0.026)), 0.005, (0.025, 0.1), (0.05, 0.08), 206e9, 0.3)
BALL, ROLLER = PowerLawBearing(2e10, 1.5), PowerLawBearing(2e9, 10 / 9, 3e-6)
DRIVE = Drivetrain(
    0.11, pin_contact(0.018, 5e8), ROLLER, BALL, 2.5e8, SHAFT, GearMesh(0.025, 2.8e8, np.radians(20), 1e-5), PowerLawBearing(3e8), 4e5
)
DRIVES = {
    "all parts": DRIVE,
    "as the example": DRIVE._replace(housing=None, wheel=None, wheel_torsion=None),
    "line alone": DRIVE._replace(pins=PinContact(2e9)),
    "series alone": DRIVE._replace(pins=PinContact(series=5e8)),
    "rigid pins": DRIVE._replace(pins=None),
    "rigid cranks": DRIVE._replace(crank=None),
    "rigid supports, shafts and gear": DRIVE._replace(support=None, shaft=None, gear=None),
    "pins alone": Drivetrain(0.11, pin_contact(0.018, 5e8)),
    "nothing": Drivetrain(0.11),
}


def laws_of_a_system(positions):
    """One of each law, in both ways where it has two: (strains, components, law)."""
    multipliers = np.random.default_rng(7).normal(scale=2e3, size=(positions, 3, 1))
    penalty = np.linspace(2e8, 3e8, positions)[:, None, None]
    return (
        (3, 1, RigidContactLaw(multipliers, penalty, False)),
        (2, 1, RigidContactLaw(multipliers[:, :2], penalty, True)),
        (4, 1, PinContactLaw(pin_contact(0.018, 5e8), False)),
        (2, 1, PinContactLaw(pin_contact(0.012, 3e8), True)),
        (2, 1, PinContactLaw(PinContact(2e9), False)),
        (2, 1, PinContactLaw(PinContact(series=4e8), True)),
        (3, 1, GearFlankLaw(2.8e8)),
        (2, 2, RadialBearingLaw(BALL)),
        (2, 2, RadialBearingLaw(ROLLER)),
    )


def system(seed, positions=5, unknowns=6, chosen=None, shared=False):
    """Random rows, some of them 0, of all laws or of one (a number): at most one of them rigid, as the penalty is one a position."""
    rng = np.random.default_rng(seed)
    parts = []
    for number, (k, c, law) in enumerate(laws_of_a_system(positions)):
        rows = rng.normal(size=(positions, k, c, unknowns)) * (rng.uniform(size=(positions, k, c, unknowns)) < 0.7)
        part = ConvexTerm(rows, rng.normal(scale=1e-6, size=(positions, k, c)), law)
        if number == chosen or (chosen is None and number != 1):
            parts.append(part)
    root = rng.normal(size=(1 if shared else positions, unknowns, unknowns))
    linear = 1e5 * (root.transpose(0, 2, 1) @ root + np.eye(unknowns))
    linear = np.broadcast_to(linear, (positions, unknowns, unknowns))
    return ConvexEnergy(linear, tuple(parts), rng.normal(scale=3e3, size=(positions, unknowns)))


def assert_same(whole, start, bound=1.0, rel=1e-9):
    """Both routes end at one y with one Hessian, and agree on who has converged, after as many steps."""
    ours, theirs = (minimise(whole, start, bound) for minimise in (minimise_by_position, minimise_energy))
    np.testing.assert_array_equal(ours.converged, theirs.converged)
    size = np.abs(theirs.y).max(axis=1, keepdims=True)
    np.testing.assert_allclose(ours.y / size, theirs.y / size, atol=rel)
    np.testing.assert_allclose(ours.hessian, theirs.hessian, rtol=1e-6, atol=1e-6 * np.abs(theirs.hessian).max())
    assert abs(ours.steps - theirs.steps) <= 1
    return ours


@pytest.mark.parametrize("chosen", [None, *range(9)])
@pytest.mark.parametrize("shared", [False, True])
def test_each_law_and_all_together(chosen, shared):
    for seed in range(4):
        whole = system(seed, chosen=chosen, shared=shared)
        assert is_compiled(whole)
        found = assert_same(whole, np.random.default_rng(seed).normal(scale=1e-5, size=(5, 6)))
        assert found.converged.all()
        gradient, _ = gradient_and_hessian(whole, found.y)
        assert np.all(np.abs(gradient).max(axis=1) < 1e-10 * np.abs(whole.load).max())


@pytest.mark.parametrize("far", [1e-9, 1e-3, 0.5])
def test_from_far_away(far):
    """Steps are cut by the line search: the way is the same, not its end alone."""
    found = assert_same(system(11), far * np.random.default_rng(1).normal(size=(5, 6)), bound=50.0)
    assert found.converged.all()


def test_what_leaves_the_bound_or_does_not_settle_keeps_its_last_place():
    whole, start = system(3), np.full((5, 6), 1e-6)
    near = np.abs(minimise_energy(whole, start, 1.0).y).max(axis=1)
    assert 0 < assert_same(whole, start, bound=float(np.median(near))).converged.sum() < 5
    flat = ConvexEnergy(np.diag([1e5, 0.0])[None], (), np.ones((1, 2)))  # one unknown goes on until it is out of bounds
    assert not assert_same(flat, np.full((1, 2), 1e-5), bound=10.0).converged[0]


def test_a_step_uphill_by_rounding_is_taken_whole():
    """As by NumPy: a spring of 1 N/m under 1 N, a billionth beyond its rest, and a step further."""
    energy, work = position_energy(ConvexEnergy(np.ones((1, 1, 1)), (), np.ones((1, 1)))), newton_work(1, 0)
    work.step[:] = 1e-12
    assert newton._step_length(energy, work, 0, np.array([1 + 1e-9])) == 1.0
    work.step[:] = 4.0  # from 0, where it ends at 1
    assert abs(1 - 4.0 * newton._step_length(energy, work, 0, np.zeros(1))) <= 0.5


def test_uncompiled_the_same():
    whole, start = system(5, positions=2), np.full((2, 6), 1e-6)
    energy, seen = position_energy(whole), []
    for run in (minimise_positions, plain(minimise_positions)):
        y, hessian, converged = start.copy(), np.empty((2, 6, 6)), np.zeros(2, bool)
        run(energy, newton_work(6, energy.rows.shape[1]), 1.0, y, hessian, converged)
        assert converged.all()
        seen.append(y)
    np.testing.assert_allclose(*seen, rtol=1e-10)


def test_a_position_ends_as_if_it_were_alone():
    whole, start = system(8), np.full((5, 6), 1e-6)
    many = minimise_by_position(whole, start, 1.0)
    for i in range(5):
        here = slice(i, i + 1)
        parts = []
        for part in whole.parts:
            law = part.law
            if isinstance(law, RigidContactLaw):
                law = law._replace(multipliers=law.multipliers[here], k=law.k[here])
            parts.append(ConvexTerm(part.rows[here], part.offset[here], law))
        one = minimise_by_position(ConvexEnergy(whole.linear[here], tuple(parts), whole.load[here]), start[here], 1.0)
        np.testing.assert_array_equal(one.y[0], many.y[i])


def test_no_positions():
    assert minimise_by_position(system(1, positions=0), np.zeros((0, 6)), 1.0).y.shape == (0, 6)


# ------------------------------------------------------------------------------------------------------------------------ drives


def contacts(theta, gaps):
    """Contacts of twelve pins with random normals, a third of them without a gap."""
    rng = np.random.default_rng(int(1e3 * theta))
    centre = 0.12 * np.exp(1j * (0.1 * theta + np.pi / 6 * np.arange(12)))
    normal = 1j * centre / np.abs(centre) * np.exp(1j * rng.uniform(-1.1, 1.1, 12)) * rng.choice([-1.0, 1.0], 12)
    gap = gaps * rng.uniform(0, 1, 12) * (np.arange(12) % 3 > 0)
    return CamContacts(np.arange(12), centre, normal, np.imag(np.conj(centre) * normal), gap, np.zeros(12), gap == 0)


@pytest.mark.parametrize("name", DRIVES)
@pytest.mark.parametrize(("model", "torque"), [("unilateral", 900.0), ("unilateral", -400.0), ("bonded", 900.0), ("bonded", -900.0)])
def test_drives(name, model, torque):
    angles = np.radians([13.0, 45.0, 77.0, 131.0])
    sets = [contacts(theta, 2e-5) for theta in angles]
    ours, theirs = (
        solve_torsional_stiffness(DRIVES[name], angles, sets, 0.01, torque, model=model, compiled=compiled) for compiled in (True, False)
    )
    assert ours.outcome == theirs.outcome
    assert (name == "nothing") == (set(ours.outcome) == {"rigid"})
    size = np.nanmax(np.abs(theirs.crank_forces)) if theirs.carried.any() else 1.0
    for field in ("rotation", "tangent"):
        np.testing.assert_allclose(getattr(ours, field), getattr(theirs, field), rtol=1e-8)
    for field in ("crank_forces", "support_forces", "gear_forces", "gear_torques", "wheel_forces"):
        np.testing.assert_allclose(getattr(ours, field), getattr(theirs, field), atol=1e-6 * size)
    for one, other in zip(ours.pin_forces, theirs.pin_forces, strict=True):
        np.testing.assert_allclose(one, other, atol=1e-6 * size)
    for share, other in theirs.shares.items():
        np.testing.assert_allclose(ours.shares[share], other, atol=1e-8 * np.nanmax(1 / np.abs(theirs.secant), initial=0.0))


def test_a_law_without_a_formula_of_single_strains_goes_by_numpy():
    drive, angles = DRIVE._replace(support=bearing("61904")), [0.4]
    term = ConvexTerm(np.zeros((1, 1, 2, 1)), np.zeros((1, 1, 2)), radial_bearing_law(drive.support))
    assert not is_compiled(ConvexEnergy(np.zeros((1, 1, 1)), (term,), np.ones((1, 1))))
    found = [solve_torsional_stiffness(drive, angles, [contacts(0.4, 2e-5)], 0.01, 900.0, compiled=each).secant for each in (True, False)]
    np.testing.assert_array_equal(*found)


def test_the_constants_of_a_law_are_those_of_its_kind():
    assert newton.constants_of(PinContactLaw(PinContact(2e9), True)) == (newton.LINE, (2e9, 0.0, 1.0))
    assert newton.constants_of(PinContactLaw(PinContact(2e9, 5e8), False)) == (newton.LINE, (2e9, 2e-9, 0.0))
    assert newton.constants_of(PinContactLaw(PinContact(series=5e8), False)) == (newton.SPRING, (5e8, 0.0, 0.0))
    assert newton.constants_of(RadialBearingLaw(ROLLER)) == (newton.RADIAL, tuple(ROLLER))


# -------------------------------------------------------------------------------------------------------------------------- laws


@pytest.mark.parametrize("compliance", [0.0, 1e-12, 2e-9, 1e-6])
@pytest.mark.parametrize("depth", [1e-12, 1e-7, 1e-5, 1e-3])
def test_line_contact_beside_a_bracketed_root(depth, compliance):
    """d = (F/c)^0.9 + C F, its energy the integral of F over d, by d(F) = int d dF: V = F d - 9/19 (F/c)^0.9 F - C F^2/2 ..."""
    c = 2.3e9
    force = brentq(lambda f: (f / c) ** 0.9 + compliance * f - depth, 0.0, c * depth ** (10 / 9) * (1 + 1e-9), xtol=1e-300, rtol=1e-15)
    found = contact_response(LineContact(c, compliance), np.array([depth, -depth, 0.0]))
    assert found.force[0] == pytest.approx(force, rel=1e-12)
    assert found.tangent[0] == pytest.approx(1 / (0.9 * (force / c) ** 0.9 / force + compliance), rel=1e-12)
    complementary = (force / c) ** 0.9 * force / 1.9 + compliance * force**2 / 2
    assert found.energy[0] == pytest.approx(force * depth - complementary, rel=1e-10)
    assert np.all(np.array(found)[:, 1:] == 0)


def test_responses_of_arrays_are_those_of_their_elements():
    depth = np.random.default_rng(4).normal(scale=1e-5, size=7)
    for law in (LineContact(2e9, 2e-9), PowerLaw(3e8, 1.0), PowerLaw(3e9, 1.5)):
        alone = np.array([contact_response(law, one) for one in depth]).T
        np.testing.assert_allclose(np.array(contact_response(law, depth)), alone, rtol=1e-14)
    np.testing.assert_allclose(power_law_response(PowerLaw(3.0, 1.5), 4.0), [3 * 32 / 2.5, 24.0, 6.0, 9.0])
    x, y = depth[:3], depth[3:6]
    for law in (BALL, ROLLER):  # K (r - c)^n along the displacement
        found = radial_response(law, 3e-6, -4e-6)
        force = law.constant * (5e-6 - law.clearance) ** law.exponent
        assert (found.x, found.y) == pytest.approx((0.6 * force, -0.8 * force), rel=1e-12)
        assert found.energy == pytest.approx(force * (5e-6 - law.clearance) / (1 + law.exponent), rel=1e-12)
        along = 0.36 * found.xx - 0.96 * found.xy + 0.64 * found.yy
        assert along == pytest.approx(law.exponent * force / (5e-6 - law.clearance), rel=1e-12)
        assert 0.64 * found.xx + 0.96 * found.xy + 0.36 * found.yy == pytest.approx(force / 5e-6, rel=1e-12)
    for law in (BALL, ROLLER):
        alone = np.array([radial_response(law, a, b) for a, b in zip(x, y, strict=True)]).T
        np.testing.assert_allclose(np.array(radial_response(law, x, y)), alone, rtol=1e-14)
