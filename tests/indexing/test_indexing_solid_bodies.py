"""Cams, split shafts and pin wheel as solids: against beams, closed forms and themselves."""

from functools import cache

import numpy as np
import pytest
from solid_indexer import CAM, NU, SHAFT, WIDTH, E, drive, solved, split_shaft, wheel

from drivewright.indexing.drivetrain import SplitShaft, pin_contact
from drivewright.indexing.plane import find_contacts
from drivewright.indexing.solid import ShaftBody, Solids, bodies, meshes, solid_stiffness, surface_table, usual_wheel
from drivewright.indexing.stiffness.layout import bending_flexibility, torsion_flexibility
from drivewright.shafts import Section
from drivewright.solids.elastic import FreeBody, Response, spring_supported

pytestmark = pytest.mark.analytical

needs_fe = pytest.mark.needs_fe


# -------------------------------------------------------------------------------------------------------------------- the dent


def test_the_compliance_of_a_strip_is_the_strain_under_it():
    """Strain along the normal, from Flamant's stresses under a Gaussian strip twice as wide (strip and mean), summed down to the depth."""
    sigma, depth, wide = 2e-4, 8e-3, np.sqrt(2) * 2e-4
    s = wide * np.linspace(-8, 8, 4001)
    p = np.exp(-(s**2) / (2 * wide**2))
    p /= p.sum()
    z = np.geomspace(1e-7, depth, 1500)[:, None]
    along, across = 2 / np.pi * (p * z**3 / (z**2 + s**2) ** 2).sum(axis=1), 2 / np.pi * (p * z * s**2 / (z**2 + s**2) ** 2).sum(axis=1)
    strain = ((1 - NU**2) * along - NU * (1 + NU) * across) / (E * WIDTH)
    assert bodies.strip_compliance(sigma, depth, CAM) == pytest.approx(np.trapezoid(strain, z[:, 0]), rel=2e-3)


# ------------------------------------------------------------------------------------------------------------------ the solids

FINENESS = 1.8


@cache
def strips():
    """The contacts at 45 deg, {(0, contact): (point, normal)}: on flanks and beside a corner."""
    here = find_contacts(wheel(), np.radians(45.0))
    at = here.centre - 0.008 * here.normal - 0.01 * np.exp(0.25j * np.pi)
    return {(0, int(c)): (complex(at[c]), complex(here.normal[c])) for c in np.flatnonzero(here.intended)}


@cache
def cam_body(sigma=1.6e-3, modulus=E):
    body = CAM._replace(modulus=modulus)
    return bodies.cam(wheel().profile.outline(), body, [-0.055 + 0j, 0.055 + 0j], strips(), sigma, FINENESS)


@needs_fe
def test_the_cam_is_as_large_as_its_outline():
    import ngsolve as ng

    body = cam_body()
    volume = ng.Integrate(1, body.free.mesh) * 1e-9
    assert volume == pytest.approx((wheel().profile.area - 2 * np.pi * 0.036**2) * WIDTH / 2, rel=2e-3)
    assert body.free.area("middle") == pytest.approx(2 * volume / WIDTH * 1e6, rel=1e-3)


@needs_fe
def test_loads_on_the_cam_pass_through_their_points():
    body = cam_body()
    for name, n in body.number.items():
        if name[0] == "contact":
            point, normal = strips()[name[1:]]
            assert body.resultants[:, n] == pytest.approx([normal.real, normal.imag, (point.conjugate() * normal).imag], abs=1e-7)
    assert body.flexibility == pytest.approx(body.flexibility.T, abs=1e-13 * body.flexibility.max())
    assert np.linalg.eigvalsh(body.flexibility).min() > -1e-12 * body.flexibility.max()
    assert cam_body(modulus=2 * E).flexibility == pytest.approx(body.flexibility / 2, rel=1e-9, abs=1e-16)


@needs_fe
def test_a_narrower_strip_yields_more_as_a_half_space_says():
    wide, narrow = cam_body(), cam_body(0.8e-3)
    contact = [n for name, n in wide.number.items() if name[0] == "contact"]
    more = (np.diag(narrow.flexibility) - np.diag(wide.flexibility))[contact]
    log = bodies.strip_compliance(0.8e-3, 0.008, CAM) - bodies.strip_compliance(1.6e-3, 0.008, CAM)
    assert np.median(more) == pytest.approx(log, rel=0.1)
    others = np.delete(np.arange(len(wide.flexibility)), contact)
    assert narrow.flexibility[np.ix_(others, others)] == pytest.approx(wide.flexibility[np.ix_(others, others)], rel=0.02, abs=1e-12)


SLENDER = SplitShaft((Section(0.3, 0.02, 0.02),), 0.0, (0.08, 0.3), (0.15, 0.23), E, NU)


def on_rigid_supports(body):
    """(n, n) flexibility of cranks and gear of a condensed shaft, in one plane, its supports rigid and its gear held from turning."""
    first = [body.number["support", end, axis] for end in (0, 1) for axis in (0, 1)] + [body.number["gear", "turn"]]
    rest = [n for n in range(len(body.flexibility)) if n not in first]
    order = [*first, *rest]
    response = Response(body.flexibility[np.ix_(order, order)], body.resultants[:, order], ())
    return spring_supported(response, np.full(len(first), np.inf)).flexibility, [list(body.number)[n] for n in rest]


@pytest.mark.slow
@needs_fe
def test_a_slender_shaft_without_throw_is_the_beam():
    """The crank pins only mark places; shear, of the order (d/L)^2, makes the solid softer than the Euler-Bernoulli beam."""
    body = bodies.shaft(drive(shaft=SLENDER), ShaftBody(0.02, 0.004, 0.002, 0.004), [0j, 0j], 1.0)
    found, names = on_rigid_supports(body)
    places = [("gear",), ("crank", 0), ("crank", 1)]
    for axis in (0, 1):
        at = [names.index((*place, axis)) for place in places]
        assert found[np.ix_(at, at)] == pytest.approx(bending_flexibility(SLENDER), rel=0.03)
        assert np.all(np.abs(np.diag(found[np.ix_(at, at)])) > np.diag(bending_flexibility(SLENDER)))


@pytest.mark.slow
@needs_fe
def test_a_slender_shaft_twists_as_the_rod():
    """The rotation of one seat against the other under equal and opposite couples: int dz/GJ."""
    mesh, names = meshes.shaft_mesh(SLENDER, ShaftBody(0.02, 0.004, 0.002, 0.004), [0j, 0j])
    free = FreeBody(mesh, E, NU)
    radius = 0.01
    found = free.response([free.mean_rotation(names[place], 2, radius) for place in (("gear",), ("crank", 1))]).flexibility
    apart = np.array([1.0, -1.0])
    assert apart @ found @ apart == pytest.approx(torsion_flexibility(SLENDER)[1, 1] * radius**2, rel=0.01)


@needs_fe
@pytest.mark.slow
def test_bodies_ten_thousand_times_as_stiff_are_rigid():
    stiff = Solids(CAM._replace(modulus=1e4 * E), SHAFT, usual_wheel(wheel(), drive(), WIDTH)._replace(modulus=1e4 * E))
    train = drive(shaft=split_shaft(modulus=1e4 * E), pins=pin_contact(WIDTH))
    found = solved(train, stiff, model="bonded", fineness=2.2)
    assert found.secant == pytest.approx(found.reduced.secant, rel=1e-3)


@needs_fe
@pytest.mark.slow
def test_the_mirrored_drive_is_as_stiff():
    """K(theta, T) = K(180 deg - theta, -T); meshes are not symmetric, so that this is their error too."""
    theta = np.radians([38.0, 77.0])
    there, back = (
        solid_stiffness(wheel(), drive(), Solids(CAM, SHAFT), at, [find_contacts(wheel(), each) for each in at], torque, fineness=FINENESS)
        for at, torque in ((theta, -900.0), (np.pi - theta, 900.0))
    )
    assert there.secant == pytest.approx(back.secant, rel=1e-3)
    for own, image in zip(there.pin_forces, back.pin_forces, strict=True):
        assert np.sort(own.ravel())[-6:] == pytest.approx(np.sort(image.ravel())[-6:], rel=0.01, abs=0.01 * own.max())


@needs_fe
@pytest.mark.slow
def test_set_a_is_softer_than_the_reduced_model_says():
    theta = np.radians([1e-3, 45.0, 83.0])
    found = solved(drive(), Solids(CAM, SHAFT, usual_wheel(wheel(), drive(), WIDTH)), theta=theta, fineness=2.2)
    assert np.all((found.ratio > 0.7) & (found.ratio < 1.0))
    assert sum(found.shares.values()) == pytest.approx(1 / found.secant, rel=1e-12)
    assert np.all(found.shares["shaft"] > found.reduced.shares["bending"] + found.reduced.shares["torsion"])  # shear, webs of the cranks
    assert np.all((found.shares["wheel"] < found.reduced.shares["pin"])[1:])  # pins held at both ends are stiffer than those of set A
    alike = [np.array_equal(own > 0, theirs > 0) for own, theirs in zip(found.pin_forces, found.reduced.pin_forces, strict=True)]
    assert not alike[0], "horns as soft as those lift pins that the reduced model loads"
    assert found.unknowns["cam"] > 10_000 and found.seconds < 120


@pytest.mark.slow
@needs_fe
def test_the_width_of_the_strip_drops_out():
    widths = [solved(drive(), Solids(CAM), fineness=FINENESS, strip=s) for s in (0.12, 0.2)]
    assert widths[0].secant == pytest.approx(widths[1].secant, rel=3e-3)
    assert widths[0].shares["cam"] == pytest.approx(widths[1].shares["cam"], rel=0.06)


@cache
def pin_wheel_body(ends):
    touched = [(k, j) for k in (0, 3, 7) for j in (0, 1)]
    return bodies.wheel(drive(), wheel(), usual_wheel(wheel(), drive(), WIDTH, ends), WIDTH, touched, FINENESS)


def pins_on_a_held_flange(ends):
    """(n, n) flexibility of the pins, the output held."""
    body = pin_wheel_body(ends)
    first = [body.number["flange", n] for n in range(6)]
    rest = [n for n in range(len(body.flexibility)) if n not in first]
    response = Response(body.flexibility[np.ix_(first + rest, first + rest)], body.resultants[:, first + rest], ())
    return spring_supported(response, np.full(6, np.inf)).flexibility.reshape(3, 2, 2, 3, 2, 2)


@needs_fe
@pytest.mark.slow
def test_all_pins_of_a_wheel_are_alike():
    own = pins_on_a_held_flange(1)[(0, 1, 2), :, :, (0, 1, 2)]  # (pin, cam, axis, cam, axis)
    for pin, angle in zip(own, 2 * np.pi * np.array([0, 3, 7]) / 12, strict=True):
        turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
        turned = np.einsum("ax,ixjy,by->iajb", turn, pin, turn)
        assert turned == pytest.approx(own[0], rel=0.03, abs=0.01 * own.max())


@needs_fe
@pytest.mark.slow
def test_a_pin_is_a_cantilever_on_its_ring():
    """Unit-load integral of a clamped pin under a load spread over the cam's width; its ring, which yields too, adds as to a beam on a
    half-space, the more the shorter the pin."""
    far, near = pins_on_a_held_flange(1)[0, :, 1, 0, :, 1].diagonal()
    inertia, section = np.pi * 0.008**4 / 4, np.pi * 0.008**2
    low = usual_wheel(wheel(), drive(), WIDTH, 1).rings[0][0]
    clamped = []
    for z in (0.05, 0.075):
        begin, end = low - z - WIDTH / 2, low - z + WIDTH / 2
        s = np.linspace(0, end, 40001)
        load = np.where(s > begin, (end - s) / WIDTH, 1.0)
        moment = np.where(s > begin, (end - s) ** 2 / (2 * WIDTH), (begin + end) / 2 - s)
        clamped.append(np.trapezoid(moment**2 / (E * inertia) + load**2 * 2 * (1 + NU) / (0.89 * E * section), s))
    assert clamped[0] < far < 1.6 * clamped[0]
    assert clamped[1] < near < 3.0 * clamped[1]
    assert np.all(pins_on_a_held_flange(2)[0, :, 1, 0, :, 1].diagonal() < [0.2 * far, 0.9 * near])


# ------------------------------------------------------------------------------------------------------------------- pictures


@needs_fe
def test_the_deformed_cam_as_a_table():
    found = solved(drive(), Solids(CAM), fineness=2.2)
    table = surface_table(found, 1)
    size = np.asarray(table["displacement"].data)
    assert len(size) % 3 == 0 and 1e-7 < size.max() < 1e-4
    assert np.hypot(table["rest_x"].data, table["rest_y"].data).max() == pytest.approx(0.122, rel=1e-3)
    assert np.ptp(table["z"].data) == pytest.approx(WIDTH, rel=0.2)
