"""Torsional stiffness of a pin-wheel indexer: what must hold for any drive, by NumPy and in compiled code, and an independent route by
forces alone."""

import sys
from functools import partial

import numpy as np
import pytest
from scipy.linalg import block_diag

from drivewright.indexing.contacts import CamContacts
from drivewright.indexing.drivetrain import Drivetrain, GearMesh, PinContact, PowerLawBearing, SplitShaft, pin_contact
from drivewright.indexing.motion import index_motion
from drivewright.indexing.stiffness import solve_torsional_stiffness
from drivewright.indexing.stiffness.layout import bending_flexibility, torsion_flexibility
from drivewright.shafts import Section

pytestmark = pytest.mark.property

N, R, E, L = 12, 0.12, 0.01, 0.11
MOTION = index_motion("modified-sine", N, 1.0)
ANGLES = np.radians([13.0, 45.0, 77.0, 131.0])
SHAFT = SplitShaft((Section(0.06, 0.02, 0.02), Section(0.055, 0.03, 0.026)), 0.005, (0.025, 0.1), (0.05, 0.08), 206e9, 0.3)
LINEAR = Drivetrain(L, PinContact(series=4e8), PowerLawBearing(3e8), PowerLawBearing(1e8), 2.5e8, SHAFT, None, PowerLawBearing(3e8))
GEARED = LINEAR._replace(
    pins=pin_contact(0.018, 5e8),
    crank=PowerLawBearing(2e9, 10 / 9),
    support=PowerLawBearing(2e10, 1.5, 2e-6),
    gear=GearMesh(0.025, 2.8e8, np.radians(20), 1e-5),
)


@pytest.fixture(autouse=True, params=[False, True], ids=["numpy", "compiled"])
def _route(request, monkeypatch):
    monkeypatch.setattr(sys.modules[__name__], "solve_torsional_stiffness", partial(solve_torsional_stiffness, compiled=request.param))


def touching(theta, seed=0, gaps=0.0, sense=1.0, wheel=R, crank=E):
    """Some pins touched on either side, by a random choice, with random gaps up to `gaps` [m]."""
    rng = np.random.default_rng(seed + 1)
    phi, rate = (np.ravel(part)[0] for part in list(MOTION(theta))[:2])
    centre = wheel * np.exp(1j * (phi + 2 * np.pi * np.arange(N) / N))
    path = 1j * (rate * centre - sense * crank * np.exp(1j * sense * theta))
    normal = 1j * path / np.abs(path) * rng.choice([-1.0, 1.0], N)
    gap = gaps * rng.uniform(0, 1, N) * (np.arange(N) % 3 > 0)
    return CamContacts(np.arange(N), centre, normal, np.imag(np.conj(centre) * normal), gap, np.zeros(N), gap == 0)


def solved(drive, torque=900.0, angles=ANGLES, model="bonded", cams=2, sense=1.0, **contacts):
    sets = [touching(theta, sense=sense, **contacts) for theta in angles]
    return solve_torsional_stiffness(drive, angles, sets, E, torque, cams=cams, sense=sense, model=model)


# --------------------------------------------------------------------------------------------------- a second route: forces


def by_forces(drive, theta, contacts, torque, cams, sense, active):
    """(compliance, pin forces (cams, k), approach of all contacts): least complementary energy under the balance of every body.

    Unknown forces: pins (those active), cams on crank pins (x, y), shafts on supports, wheel on its bearing.  Linear laws, no gear.
    """
    k, way = len(contacts.pin), np.exp(2j * np.pi * np.arange(cams) / cams)
    centre, shaft = E * np.exp(1j * sense * theta) * way, drive.shaft
    pins = cams * k
    crank = pins + 2 * np.arange(2 * cams).reshape(2, cams)
    support = pins + 4 * cams + 2 * np.arange(4).reshape(2, 2)
    size = pins + 4 * cams + 10
    balance, right = [], []

    def equation(terms, value=0.0):
        row = np.zeros(size)
        for at, factor in terms:
            row[at] += factor
        balance.append(row)
        right.append(value)

    def vector(terms):
        for part in (0, 1):
            equation([(at + part if two else at, factor if two else (factor.real, factor.imag)[part]) for at, factor, two in terms])

    f, arm = np.array([contacts.normal * w for w in way]), np.tile(contacts.arm, (cams, 1))
    number = np.arange(pins).reshape(cams, k)
    equation([(number[j, i], arm[j, i]) for j in range(cams) for i in range(k)], -torque)
    vector([(number[j, i], f[j, i], False) for j in range(cams) for i in range(k)] + [(size - 2, -1.0, True)])
    for j in range(cams):
        vector([(number[j, i], -f[j, i], False) for i in range(k)] + [(crank[s, j], -1.0, True) for s in (0, 1)])
        terms = [(number[j, i], -arm[j, i]) for i in range(k)]
        for s, x in enumerate((-L / 2, L / 2)):
            at = x + centre[j]
            terms += [(crank[s, j], at.imag), (crank[s, j] + 1, -at.real)]
        equation(terms)
    for s in (0, 1):
        for height in (np.zeros(3 + cams), [shaft.gear, *shaft.supports, *shaft.cams]):
            weight = np.ones(cams + 3) if not np.any(height) else np.array(height)
            vector([(crank[s, j], weight[3 + j], True) for j in range(cams)] + [(support[s, i], -weight[1 + i], True) for i in (0, 1)])
    soft = np.concatenate(
        [
            np.full(pins, 1 / drive.pins.series),
            np.full(4 * cams, 1 / drive.crank.constant),
            np.full(8, 1 / drive.support.constant + 1 / drive.housing),
            np.full(2, 1 / drive.wheel.constant),
        ]
    )
    compliance = np.diag(soft)
    bend, twist = bending_flexibility(shaft)[1:, 1:], torsion_flexibility(shaft)
    for s in (0, 1):
        at = crank[s]
        for part in (0, 1):
            compliance[np.ix_(at + part, at + part)] += bend
        lever = np.zeros((cams, size))
        lever[np.arange(cams), at], lever[np.arange(cams), at + 1] = -centre.imag, centre.real
        compliance += lever.T @ twist @ lever
    chosen = np.concatenate([np.flatnonzero(active.ravel()), np.arange(pins, size)])
    a, c = np.array(balance)[:, chosen], compliance[np.ix_(chosen, chosen)]
    scale = np.sqrt(np.diag(c)).mean() ** 2
    kkt = block_diag(c / scale, np.zeros((len(a), len(a))))
    kkt[len(c) :, : len(c)], kkt[: len(c), len(c) :] = a, a.T
    answer = np.linalg.lstsq(kkt, np.concatenate([np.zeros(len(c)), right]), rcond=None)[0]
    force = np.zeros(size)
    force[chosen] = answer[: len(c)]
    approach = -(np.array(balance)[:, :pins].T @ answer[len(c) :]) * scale
    return force @ compliance @ force / torque**2, force[:pins].reshape(cams, k), approach.reshape(cams, k)


@pytest.mark.parametrize(("cams", "sense"), [(2, 1.0), (1, 1.0), (3, -1.0)])
def test_second_route_with_bonded_pins(cams, sense):
    shaft = SHAFT._replace(cams=(0.05, 0.08, 0.065)[:cams])
    drive = LINEAR._replace(shaft=shaft)
    found = solved(drive, cams=cams, sense=sense)
    for theta, secant, forces in zip(ANGLES, found.secant, found.pin_forces, strict=True):
        compliance, pins, _ = by_forces(drive, theta, touching(theta, sense=sense), 900.0, cams, sense, np.ones((cams, N), dtype=bool))
        assert 1 / secant == pytest.approx(compliance, rel=1e-8)
        assert forces == pytest.approx(pins, abs=1e-6 * np.abs(pins).max())


def test_second_route_with_pins_that_only_press():
    """With the pins that the solver finds pressed: they press, the others are apart, and the stiffness is the same."""
    found = solved(LINEAR, model="unilateral")
    for theta, secant, forces in zip(ANGLES, found.secant, found.pin_forces, strict=True):
        compliance, pins, approach = by_forces(LINEAR, theta, touching(theta), 900.0, 2, 1.0, forces > 0)
        assert 0 < np.sum(forces > 0) < forces.size
        assert 1 / secant == pytest.approx(compliance, rel=1e-8)
        assert pins == pytest.approx(forces, abs=1e-6 * forces.max()) and np.all(pins >= 0)
        assert np.all(approach[forces == 0] <= 1e-12)
        assert approach[forces > 0] == pytest.approx(forces[forces > 0] / 4e8, rel=1e-6)


# ---------------------------------------------------------------------------------------------------------------- exact laws


def test_every_body_is_in_balance():
    """Pins, cranks, supports, gears and wheel bearing of a non-linear drive: sums of forces and moments."""
    found = solved(GEARED, model="unilateral", gaps=2e-5)
    way = np.array([1.0, -1.0])
    for i, theta in enumerate(ANGLES):
        each, forces, size = touching(theta, gaps=2e-5), found.pin_forces[i], 1e-7
        centre = E * np.exp(1j * theta) * way
        on_wheel, arms = (forces @ each.normal) * way, forces @ each.arm
        assert arms.sum() == pytest.approx(-900.0, rel=1e-9)
        assert found.wheel_forces[i] == pytest.approx(on_wheel.sum(), abs=size)
        crank = found.crank_forces[i]
        assert crank.sum(axis=0) == pytest.approx(-on_wheel, abs=size)
        at = np.array([[-L / 2], [L / 2]]) + centre
        assert np.imag(np.conj(at) * crank).sum(axis=0) == pytest.approx(-arms, abs=size)
        assert found.support_forces[i].sum(axis=1) == pytest.approx(crank.sum(axis=1) + found.gear_forces[i], abs=size)
        lengthwise = crank @ np.array(SHAFT.cams) + found.gear_forces[i] * SHAFT.gear
        assert found.support_forces[i] @ np.array(SHAFT.supports) == pytest.approx(lengthwise, abs=size)
        assert np.imag(np.conj(centre) * crank).sum(axis=1) == pytest.approx(-found.gear_torques[i], abs=size)
        assert np.imag(found.gear_forces[i]) * [1.0, -1.0] * 0.025 == pytest.approx(found.gear_torques[i], abs=size)


@pytest.mark.parametrize("gear", [None, GEARED.gear])
def test_the_input_takes_torque_times_transmission(gear):
    """All normals pass through the instant centre: the torques on the split shafts add up to -T phi'."""
    found = solved(GEARED._replace(gear=gear))
    rate = np.array([np.ravel(list(MOTION(theta))[1])[0] for theta in ANGLES])
    assert found.gear_torques.sum(axis=1) == pytest.approx(-900.0 * rate, rel=1e-9)


@pytest.mark.parametrize("exponent", [10 / 9, 1.5])
def test_power_laws_scale(exponent):
    """All that yields with one exponent n: K grows as T^(1 - 1/n), and the tangent is n times the secant."""
    drive = Drivetrain(L, crank=PowerLawBearing(2e9, exponent), support=PowerLawBearing(5e9, exponent))
    low, high = solved(drive, 100.0), solved(drive, 800.0)
    assert high.secant / low.secant == pytest.approx(np.full(4, 8 ** (1 - 1 / exponent)), rel=1e-9)
    assert high.tangent == pytest.approx(exponent * high.secant, rel=1e-6)


def test_tangent_is_the_slope_of_the_curve():
    step = 1e-2
    for model in ("bonded", "unilateral"):
        low, high, found = (solved(GEARED, 900.0 + d, model=model, gaps=1e-5) for d in (-step, step, 0.0))
        assert 2 * step / (high.rotation - low.rotation) == pytest.approx(found.tangent, rel=1e-5)


def test_other_units_change_nothing():
    """Lengths by 1000, forces by 7: the stiffness by 7000 (millimetres and another unit of force)."""
    a, b = 1e3, 7.0
    shaft = SHAFT._replace(
        sections=tuple(Section(*(a * x for x in each)) for each in SHAFT.sections),
        gear=a * SHAFT.gear,
        supports=tuple(a * z for z in SHAFT.supports),
        cams=tuple(a * z for z in SHAFT.cams),
        modulus=206e9 * b / a**2,
    )
    crank, support = GEARED.crank, GEARED.support
    drive = Drivetrain(
        a * L,
        PinContact(GEARED.pins.line * b / a ** (10 / 9), 5e8 * b / a),
        PowerLawBearing(crank.constant * b / a**crank.exponent, 10 / 9),
        PowerLawBearing(support.constant * b / a**1.5, 1.5, a * support.clearance),
        2.5e8 * b / a,
        shaft,
        GearMesh(a * 0.025, 2.8e8 * b / a, np.radians(20), a * 1e-5),
        PowerLawBearing(3e8 * b / a),
    )
    ours = solved(GEARED)
    theirs = solve_torsional_stiffness(
        drive, ANGLES, [touching(t, wheel=a * R, crank=a * E) for t in ANGLES], a * E, 900.0 * a * b, model="bonded"
    )
    assert theirs.secant == pytest.approx(a * b * ours.secant, rel=1e-9)


def test_cams_change_places_half_a_turn_on():
    """Turning one cam with its contacts by half a turn makes it the other one."""
    half = np.pi
    other = [each._replace(centre=-each.centre, normal=-each.normal) for each in map(touching, ANGLES)]
    shaft = SHAFT._replace(cams=SHAFT.cams[::-1])
    ours = solved(GEARED, model="unilateral")
    theirs = solve_torsional_stiffness(GEARED._replace(shaft=shaft), ANGLES + half, other, E, 900.0)
    assert theirs.secant == pytest.approx(ours.secant, rel=1e-10)
    assert theirs.crank_forces[:, :, ::-1] == pytest.approx(ours.crank_forces, abs=1e-5)


def test_one_position_as_among_many():
    many = solved(GEARED, model="unilateral", gaps=2e-5)
    for i in range(len(ANGLES)):
        one = solved(GEARED, angles=ANGLES[i : i + 1], model="unilateral", gaps=2e-5)
        assert one.secant[0] == pytest.approx(many.secant[i], rel=1e-11)


# ------------------------------------------------------------------------------------------------------------ one-sided facts


def test_whatever_is_softer_never_stiffens():
    base = solved(GEARED, model="unilateral").secant
    softer = [
        GEARED._replace(crank=PowerLawBearing(1e9, 10 / 9)),
        GEARED._replace(housing=1e8),
        GEARED._replace(wheel_torsion=1e6),
        GEARED._replace(wheel=PowerLawBearing(1e8)),
        GEARED._replace(shaft=SHAFT._replace(modulus=150e9)),
    ]
    for drive in softer:
        assert np.all(solved(drive, model="unilateral").secant < base)
    assert np.all(solved(LINEAR, model="unilateral").secant < solved(LINEAR).secant)  # what may pull too carries more


def test_gaps_only_loosen():
    """Rotation grows with the gaps, and the work in them is nobody's share."""
    drive, sizes = LINEAR, (0.0, 5e-6, 2e-5, 5e-5)
    found = [solved(drive, model="unilateral", gaps=gap) for gap in sizes]
    for near, wide in zip(found[:-1], found[1:], strict=True):
        assert np.all(np.abs(wide.rotation) >= np.abs(near.rotation) * (1 - 1e-12))
    for each in found[1:]:
        np.testing.assert_allclose(sum(each.shares.values()), 1 / each.secant, rtol=1e-10)


@pytest.mark.parametrize("model", ["bonded", "unilateral"])
def test_rigid_pins_are_the_limit_of_stiff_ones(model):
    """1/K less the pins' own share misses the rigid value by the order 1/k^2."""
    drive = LINEAR._replace(wheel=None)
    rigid = solved(drive._replace(pins=None), model=model)
    miss = []
    for k in (1e11, 1e12):
        found = solved(drive._replace(pins=PinContact(series=k)), model=model)
        assert np.all(found.secant < rigid.secant)
        miss.append(np.abs((1 / found.secant - found.shares["pin"]) * rigid.secant - 1).max())
    assert miss[0] < 1e-4
    assert miss[0] / miss[1] == pytest.approx(100, rel=0.2)
    assert np.all(np.abs(rigid.shares["pin"] * rigid.secant) < 1e-9)


def test_rigid_bearings_are_the_limit_of_stiff_ones():
    """Their forces too, where statics leaves them open."""
    stiff = GEARED._replace(crank=PowerLawBearing(1e14), support=PowerLawBearing(3e13), housing=None)
    rigid = GEARED._replace(crank=None, support=None, housing=None)
    ours, theirs = solved(rigid, model="unilateral"), solved(stiff, model="unilateral")
    assert theirs.secant == pytest.approx(ours.secant, rel=1e-4)
    assert np.sum(theirs.support_forces, axis=2) == pytest.approx(np.sum(ours.support_forces, axis=2), rel=1e-2, abs=20.0)


# -------------------------------------------------------------------------------------------------------------------- absent


def one_sided(theta, sign):
    each = touching(theta)
    keep = np.sign(each.arm) == sign
    return CamContacts(*(part[keep] for part in each))


def test_no_contact_that_resists_gives_no_number():
    sets = [one_sided(theta, sign) for theta, sign in zip(ANGLES, (1, -1, 1, -1), strict=True)]
    found = solve_torsional_stiffness(GEARED, ANGLES, sets, E, 900.0)
    assert found.outcome == ("free", "carried", "free", "carried")
    assert np.array_equal(np.isnan(found.secant), [True, False, True, False])
    assert np.isnan(found.support_forces[0]).all() and np.isnan(found.shares["crank"][2]) and np.isnan(found.pin_forces[2]).all()
    assert solve_torsional_stiffness(GEARED, ANGLES, sets, E, -900.0).outcome == ("carried", "free", "carried", "free")


def test_no_position_that_carries():
    found = solve_torsional_stiffness(GEARED, ANGLES, [one_sided(theta, 1) for theta in ANGLES], E, 900.0)
    assert set(found.outcome) == {"free"} and np.isnan(found.secant).all()


def test_a_gap_everywhere_is_play_not_stiffness():
    sets = [each._replace(gap=each.gap + 2e-5) for each in map(touching, ANGLES)]
    assert set(solve_torsional_stiffness(GEARED, ANGLES, sets, E, 900.0).outcome) == {"free"}


def test_a_drive_without_anything_that_yields():
    for model in ("bonded", "unilateral"):
        found = solved(Drivetrain(L), model=model)
        assert set(found.outcome) == {"rigid"} and np.isnan(found.secant).all() and "rigid" in found.reasons[0]


def test_next_to_no_arm_holds_nothing():
    """One pin touches, its normal 1e-7 rad off the radius."""
    centre, normal = np.array([R + 0j]), np.exp(1j * np.array([np.pi - 1e-7]))
    each = CamContacts(np.array([0]), centre, normal, np.imag(np.conj(centre) * normal), *np.zeros((2, 1)), np.array([True]))
    assert solve_torsional_stiffness(GEARED, [0.3], [each], E, -900.0).outcome == ("free",)


def test_bonded_contacts_are_the_intended_ones():
    """A pin that touches elsewhere, as at a corner, takes no part; it does where contacts press."""
    each = touching(ANGLES[0])
    intended = np.arange(N) % 2 == 0
    found, without = (
        solve_torsional_stiffness(GEARED, ANGLES[:1], [contacts], E, 900.0, model="bonded")
        for contacts in (each._replace(intended=intended), each.of(intended))
    )
    assert found.secant == pytest.approx(without.secant, rel=1e-10)
    assert np.all(found.pin_forces[0][:, ~intended] == 0) and np.any(found.pin_forces[0][:, intended] != 0)


def test_hardly_an_arm_is_no_stiffness():
    """One pin touches, its normal 1e-5 rad off the radius: it would take a gigantic force."""
    centre, normal = np.array([R + 0j]), np.exp(1j * np.array([np.pi - 1e-5]))
    each = CamContacts(np.array([0]), centre, normal, np.imag(np.conj(centre) * normal), *np.zeros((2, 1)), np.array([True]))
    found = solve_torsional_stiffness(GEARED, [0.3], [each], E, -900.0)
    assert found.outcome == ("far",) and np.isnan(found.rotation[0])
