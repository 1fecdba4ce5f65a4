"""Torsional stiffness of a pin-wheel indexer where it has a closed form: one part yields, the rest is rigid."""

import numpy as np
import pytest

from drivewright.bearings import approximate_stiffness
from drivewright.indexing.contacts import CamContacts
from drivewright.indexing.drivetrain import Drivetrain, GearMesh, PinContact, PowerLawBearing, SplitShaft, pin_contact, power_law_bearing
from drivewright.indexing.motion import index_motion
from drivewright.indexing.stiffness import solve_torsional_stiffness
from drivewright.indexing.stiffness.laws import PinContactLaw, radial_bearing_law
from drivewright.indexing.stiffness.layout import bending_flexibility, torsion_flexibility
from drivewright.shafts import EULER_BERNOULLI, Section, Shaft, Support, assemble, flexibility, solve

pytestmark = pytest.mark.analytical

N, R, E, L = 12, 0.12, 0.01, 0.11
ARCMIN = 3437.7468  # 1 N m/arcmin in N m/rad
MOTION = index_motion("modified-sine", N, 1.0)
ANGLES = np.radians([7.0, 22.5, 45.0, 67.5, 90.0, 131.0])


def jet(theta):
    """(phi, dphi/dtheta)."""
    return tuple(np.ravel(part)[0] for part in list(MOTION(theta))[:2])


def touching(theta, pins=range(N)):
    """Every pin touched from both sides along the normal through the instant centre."""
    phi, rate = jet(theta)
    centre = np.tile(R * np.exp(1j * (phi + 2 * np.pi * np.array(pins) / N)), 2)
    path = 1j * (rate * centre - E * np.exp(1j * theta))
    normal = path * 1j / np.abs(path) * np.repeat([1.0, -1.0], len(pins))
    size = len(centre)
    arm = np.imag(np.conj(centre) * normal)
    return CamContacts(np.tile(pins, 2), centre, normal, arm, np.zeros(size), np.zeros(size), np.ones(size, dtype=bool))


def solved(drive, torque=800.0, angles=ANGLES, model="bonded", pins=range(N), **settings):
    return solve_torsional_stiffness(drive, angles, [touching(theta, pins) for theta in angles], E, torque, model=model, **settings)


def crank_only(theta, k, spacing):
    """K = 2 rp^2/[1/(2k) + 2 (rp - e)^2/(k l^2)], rp = e/phi'."""
    reach = E / np.array([jet(each)[1] for each in theta])
    return 2 * reach**2 / (1 / (2 * k) + 2 * (reach - E) ** 2 / (k * spacing**2))


@pytest.mark.parametrize("model", ["bonded", "unilateral"])
def test_only_the_crank_bearings_yield(model):
    found = solved(Drivetrain(L, crank=PowerLawBearing(4.5e7)), model=model)
    assert found.secant == pytest.approx(crank_only(ANGLES, 4.5e7, L), rel=1e-11)
    assert found.tangent == pytest.approx(found.secant, rel=3e-7)
    assert found.shares["crank"] == pytest.approx(1 / found.secant, rel=1e-10)


def test_sheet_values_of_the_crank_bearings():
    """Evaluated, as the sheet's curves, a thousandth of a degree on."""
    angles = np.radians([0.0, 22.5, 45.0, 67.5, 90.0]) + np.radians(1e-3)
    found = solved(Drivetrain(L, crank=PowerLawBearing(4.5e7)), angles=angles)
    assert found.secant / ARCMIN == pytest.approx([158.3886, 155.0763, 94.0923, 59.8341, 51.0743], rel=1e-6)


def test_dwell_stiffness_of_the_crank_bearings():
    """All normals parallel: k l^2."""
    found = solved(Drivetrain(L, crank=PowerLawBearing(4.5e7)), angles=np.radians([0.0, 200.0]))
    assert found.secant == pytest.approx(4.5e7 * L**2, rel=1e-10)


def test_only_the_pins_yield():
    """Cams stand still: K = sum k arm^2 over the pins of both cams; one-sided, over half of them."""
    drive = Drivetrain(L, pins=PinContact(series=3e8))
    total = np.array([np.sum(touching(theta).arm ** 2) for theta in ANGLES])
    for torque in (500.0, -500.0):
        assert solved(drive, torque).secant == pytest.approx(2 * 3e8 * total, rel=1e-12)
        assert solved(drive, torque, model="unilateral").secant == pytest.approx(3e8 * total, rel=1e-12)


def test_pin_forces_where_only_the_pins_yield():
    """F = k phi arm on the pins of either cam."""
    found = solved(Drivetrain(L, pins=PinContact(series=3e8)), 500.0, pins=(0, 4, 9))
    for theta, forces, turned in zip(ANGLES, found.pin_forces, found.rotation, strict=True):
        assert forces == pytest.approx(np.tile(-3e8 * turned * touching(theta, (0, 4, 9)).arm, (2, 1)), rel=1e-9)


def test_a_line_contact_alone():
    """One pin, one cam: F = T/arm, phi = [(F/c)^0.9 + F/k]/arm."""
    pin = pin_contact(0.018, 5e8)
    angles = ANGLES[1:3]
    found = solved(Drivetrain(L, pins=pin), 700.0, angles, pins=(1,), cams=1)
    arm = np.array([touching(theta, (1,)).arm[0] for theta in angles])
    force = 700.0 / np.abs(arm) / 2  # one contact on either side shares, pressed or pulled
    assert found.rotation == pytest.approx(((force / pin.line) ** 0.9 + force / 5e8) / np.abs(arm), rel=1e-12)


def test_only_the_gears_yield():
    """Both shafts turn by t = T phi'/(2 k (r cos a)^2): the meshes share the crank torque T phi'."""
    gear = GearMesh(0.02, 2.8e8, np.radians(22.0))
    rate = np.array([jet(theta)[1] for theta in ANGLES])
    for torque in (600.0, -600.0):
        found = solved(Drivetrain(L, gear=gear), torque)
        assert found.secant == pytest.approx(2 * gear.stiffness * (gear.pitch_radius * np.cos(gear.pressure_angle) / rate) ** 2, rel=1e-9)


def test_backlash_turns_the_wheel_before_it_loads():
    """phi grows by the backlash/2 along the line of action: phi' times half the backlash over r cos a."""
    gear = GearMesh(0.02, 2.8e8, np.radians(22.0))
    without, wide = (solved(Drivetrain(L, gear=gear._replace(backlash=b))) for b in (0.0, 4e-5))
    rate = np.array([jet(theta)[1] for theta in ANGLES])
    assert wide.rotation - without.rotation == pytest.approx(rate * 2e-5 / (0.02 * np.cos(gear.pressure_angle)), rel=1e-7)
    assert sum(wide.shares.values()) == pytest.approx(1 / wide.secant, rel=1e-10)
    assert wide.tangent == pytest.approx(without.tangent, rel=1e-6)


def test_the_output_shaft_in_series():
    drive = Drivetrain(L, crank=PowerLawBearing(4.5e7))
    found = solved(drive._replace(wheel_torsion=3e5))
    assert 1 / found.secant == pytest.approx(1 / crank_only(ANGLES, 4.5e7, L) + 1 / 3e5, rel=1e-11)
    assert found.shares["wheel"] == pytest.approx(1 / 3e5, rel=1e-10)


def test_only_the_supports_yield_midway():
    """One cam midway between two supports: together they are a crank bearing of twice their stiffness, under one cam instead of two."""
    shaft = SplitShaft((Section(0.1, 0.5, 0.5),), 0.0, (0.02, 0.08), (0.05,), 206e9, 0.3)  # so thick that it is nearly rigid
    found = solved(Drivetrain(L, support=PowerLawBearing(2e7), shaft=shaft), cams=1)
    assert found.secant == pytest.approx(crank_only(ANGLES, 4e7, L) / 2, rel=2e-6)


def test_support_and_housing_in_series():
    base = Drivetrain(L, support=PowerLawBearing(2e8))
    seated, soft = solved(base._replace(housing=3e8)), solved(base._replace(support=PowerLawBearing(1.2e8)))
    assert seated.secant == pytest.approx(soft.secant, rel=1e-11)
    assert seated.shares["support"] / seated.shares["housing"] == pytest.approx(1.5, rel=1e-9)


# ---------------------------------------------------------------------------------------------------------------------- laws

SECANTS = {"roller": (339366, 363724, 389830, 427237, 457901), "ball": (51956, 65461, 82476, 111937, 141031)}


@pytest.mark.parametrize("kind", SECANTS)
def test_secant_stiffness_of_the_bearings_in_the_sheet(kind):
    """Sheet, section 5, N/mm: from F = K d^n and its displacement."""
    bearing = power_law_bearing(
        {
            "roller": lambda f: approximate_stiffness.liu_roller(f, 14, 8.5e-3),
            "ball": lambda f: approximate_stiffness.liu_ball(f, 11, 4.762e-3),
        }[kind]
    )
    force = np.array([500.0, 1000.0, 2000.0, 5000.0, 10000.0])
    away = (force / bearing.constant) ** (1 / bearing.exponent)
    assert force / away / 1e3 == pytest.approx(np.array(SECANTS[kind]), rel=2e-5)
    law = radial_bearing_law(bearing)
    assert np.hypot(*law(np.stack([0.6 * away, -0.8 * away], axis=1))[1].T) == pytest.approx(force, rel=1e-12)
    assert law.secant(force) == pytest.approx(force / away, rel=1e-12)


def test_pin_contact_of_the_sheet():
    """delta = (F/(8.06e4 b^(8/9)))^0.9 + F/k_pin in N and mm."""
    force = np.geomspace(1e-3, 1e5, 30)
    delta = ((force / (8.06e4 * 18 ** (8 / 9))) ** 0.9 + force / 5e5) * 1e-3
    law = PinContactLaw(pin_contact(0.018, 5e8), bonded=False)
    assert law(delta[:, None])[1][:, 0] == pytest.approx(force, rel=1e-13)
    assert law.secant(force) == pytest.approx(force / delta, rel=1e-13)


def test_shafts_on_rigid_supports():
    """Uniform: gear on the overhang a, a^2 (a + L)/3EI; a cam at b, b^2 (L - b)^2/3EIL; their mixed term -a b (L - b)(2L - b)/6EIL."""
    a, b, span, modulus, poisson, d = 0.03, 0.04, 0.1, 206e9, 0.29, 0.02
    shaft = SplitShaft((Section(a + span, d, d),), 0.0, (a, a + span), (a + b,), modulus, poisson)
    bend = modulus * np.pi * d**4 / 64
    mixed = -a * b * (span - b) * (2 * span - b) / (6 * bend * span)
    expected = [[a**2 * (a + span) / (3 * bend), mixed], [mixed, (b * (span - b)) ** 2 / (3 * bend * span)]]
    assert bending_flexibility(shaft) == pytest.approx(np.array(expected), rel=1e-9)


@pytest.mark.parametrize("cams", [(0.05,), (0.05, 0.08), (0.012, 0.05, 0.11)])
def test_a_stepped_shaft_bends_as_by_the_general_model_of_shafts(cams):
    """A cone, gear and cams on either side of the supports."""
    sections = (Section(0.03, 0.02, 0.02), Section(0.05, 0.03, 0.024), Section(0.04, 0.02, 0.02))
    shaft = SplitShaft(sections, 0.004, (0.025, 0.1), cams, 206e9, 0.3)
    rigid = (np.inf, np.inf, 0.0, 0.0, 0.0)
    supports = tuple(Support(str(z), z, rigid) for z in shaft.supports)
    model = assemble(Shaft(sections, 206e9, 0.3, 0.0, supports, shear=EULER_BERNOULLI), (0.004, *cams))
    whole = flexibility(solve(model, np.zeros(model.size)), (0.004, *cams), (1.0, 0.0)).delta
    assert bending_flexibility(shaft) == pytest.approx(whole, rel=1e-8)


def test_torsion_of_stepped_shafts():
    """int dz/GJ, GJ = E pi d^4/(64 (1 + nu)), over the way from the gear that both cams share; one cam on the far side of the gear."""
    modulus, poisson = 206e9, 0.29

    def soft(length, d):
        return length * 64 * (1 + poisson) / (modulus * np.pi * d**4)

    sections = (Section(0.03, 0.02, 0.02), Section(0.05, 0.03, 0.03), Section(0.02, 0.02, 0.02))
    shaft = SplitShaft(sections, 0.02, (0.0, 0.1), (0.01, 0.04, 0.09), modulus, poisson)
    near, far = soft(0.01, 0.02) + soft(0.01, 0.03), soft(0.02, 0.02) + soft(0.05, 0.03)
    expected = [[soft(0.01, 0.02), 0, 0], [0, near, near], [0, near, far]]
    assert torsion_flexibility(shaft) == pytest.approx(np.array(expected), rel=1e-9, abs=1e-15)
