"""Elastic bodies in the lumped model: compliance behind every contact, shear of the shafts, and how near the assembly it comes."""

import numpy as np
import pytest
from solid_indexer import ANGLES, CAM, NU, SHAFT, WIDTH, E, drive, split_shaft, wheel

from drivewright.errors import InputError
from drivewright.indexing.body_compliance import BodyCompliance
from drivewright.indexing.plane import find_contacts
from drivewright.indexing.solid import Solids, solid_stiffness, usual_wheel
from drivewright.indexing.solid.correction import elastic_train, profile_nodes
from drivewright.indexing.stiffness import solve_torsional_stiffness
from drivewright.indexing.stiffness.assembly import assemble_drivetrain, pad_contacts
from drivewright.indexing.stiffness.layout import bending_flexibility
from drivewright.shafts import COWPER

pytestmark = pytest.mark.analytical


def lumped(train, torque=-1000.0, model="unilateral", compiled=False):
    contacts = [find_contacts(wheel(), angle) for angle in ANGLES]
    return solve_torsional_stiffness(train, ANGLES, contacts, 0.01, torque, model=model, compiled=compiled)


def alike(cam, pin):
    """A `BodyCompliance` that is the same at all contacts: of cams [m/N], of pins (2, 2) [m/N]."""
    points, normals = profile_nodes(wheel(), 4e-3)
    return BodyCompliance(0.008, points, normals, np.full((2, len(points)), cam), np.array([pin, pin]))


@pytest.mark.parametrize("model", ["unilateral", "bonded"])
def test_one_compliance_at_all_contacts_is_the_spring_behind_them(model):
    """1/k = cam + pin, whatever the direction where a pin yields alike in all; also where compiled code is asked for."""
    bodies = alike(0.7e-9, 1.3e-9 * np.eye(2))
    expected = lumped(drive(pins=drive().pins._replace(series=5e8)), model=model)
    for compiled in (False, True):
        found = lumped(drive(bodies=bodies), model=model, compiled=compiled)
        assert found.secant == pytest.approx(expected.secant, rel=1e-9, nan_ok=True)
        for own, theirs in zip(found.pin_forces, expected.pin_forces, strict=True):
            assert own == pytest.approx(theirs, rel=1e-6, abs=1e-3, nan_ok=True)


def test_a_pin_yields_by_the_direction_of_its_normal():
    """Along the pin's radius by the first, across by the second entry; between them by the squares of the cosines."""
    bodies = alike(0.0, np.diag([3e-9, 1e-9]))
    centre = 0.12 * np.exp(1j * np.array([0.3, 0.3, 0.3]))
    turn = np.array([0.0, np.pi / 2, np.pi / 3])
    normal = np.exp(1j * (0.3 + turn))
    found = bodies.at(1, centre - 0.01, centre, normal, np.zeros(3))
    assert found == pytest.approx(3e-9 * np.cos(turn) ** 2 + 1e-9 * np.sin(turn) ** 2, rel=1e-12)


def test_a_cam_yields_as_at_its_nearest_nodes():
    """On the same flank: a node nearer but on the other side of a horn does not speak."""
    points, normals = np.array([0j, 0.004 + 0j, 0.002 - 0.001j]), np.array([1j, 1j, -1j])
    bodies = BodyCompliance(0.008, points, normals, np.array([[1e-9, 3e-9, 9e-9], [2e-9, 6e-9, 9e-9]]), np.zeros((2, 2, 2)))
    gap = np.array([0.0, 0.0, 5e-4])
    seen = np.array([0.0, 0.001, 0.001]) + 1j * (0.008 + gap)
    centre, normal = np.full(3, 0.1 + 0j), np.full(3, 1j)
    assert bodies.at(0, seen, centre, normal, gap) == pytest.approx([1e-9, 1.5e-9, 1.5e-9], rel=1e-6)
    assert bodies.at(1, seen, centre, normal, gap) == pytest.approx([2e-9, 3e-9, 3e-9], rel=1e-6)


def test_each_contact_gets_the_compliance_of_its_place():
    """A cam that yields by the distance of the place from its centre; opposite cams are touched at the same places."""
    bodies = alike(0.0, np.zeros((2, 2)))
    bodies = bodies._replace(cams=np.abs(bodies.points) * np.array([[1e-8], [2e-8]]))
    here, cam = find_contacts(wheel(), ANGLES[1]), 0.01 * np.exp(1j * ANGLES[1])
    pins = pad_contacts([here], [here.intended])
    law = assemble_drivetrain(drive(bodies=bodies), 2, np.array([cam]), pins, False).groups[0].law
    at = (here.centre - 0.008 * here.normal - cam)[here.intended]
    first, second = law.compliance.reshape(2, -1)
    assert first == pytest.approx(1e-8 * np.abs(at), rel=0.03)
    assert second == pytest.approx(2 * first, rel=1e-12)


@pytest.mark.parametrize("side", ["inside", "outside"])
def test_nodes_lie_on_the_profile_and_point_out_of_the_cam(side):
    points, normals = profile_nodes(wheel(side), 2e-3)
    assert np.abs(np.diff(points)).max() < 2.1e-3 and np.abs(normals) == pytest.approx(1.0, rel=1e-12)
    for angle in ANGLES:
        here = find_contacts(wheel(side), angle).of(slice(0, 6))
        at = here.centre - (0.008 + here.gap) * here.normal - 0.01 * np.exp(1j * wheel(side).sense * angle)
        away = np.abs(at[:, None] - points)
        facing = np.real(np.conj(here.normal)[:, None] * normals)
        assert away.min(axis=1).max() < 1.1e-3
        assert np.median(facing[np.arange(len(at)), away.argmin(axis=1)]) > 0.95


def test_a_shaft_with_shear_is_softer_by_that_of_its_sections():
    """Added at a cam between the supports, a and b apart from them: ab/(a + b)/(kappa G A) of an even shaft, kappa by Cowper."""
    even = split_shaft()._replace(sections=tuple(s._replace(start=0.03, end=0.03) for s in split_shaft().sections))
    more = bending_flexibility(even._replace(shear=COWPER)) - bending_flexibility(even)
    kappa, a, b = 6 * (1 + NU) / (7 + 6 * NU), 0.025, 0.05
    expected = a * b / (a + b) / (kappa * E / (2 * (1 + NU)) * np.pi / 4 * 0.03**2)
    assert more[1, 1] == pytest.approx(expected, rel=1e-9)


def test_it_wants_a_line_contact_and_bodies_that_fit():
    with pytest.raises(InputError, match="elastic bodies: their compliance is in series with a line contact"):
        elastic_train(wheel(), drive(pins=None), Solids(CAM))
    with pytest.raises(InputError, match=r"CamBody\.thickness = 0 must be above 0"):
        elastic_train(wheel(), drive(), Solids(CAM._replace(thickness=0.0)))


@pytest.mark.needs_fe
@pytest.mark.slow
def test_it_comes_near_the_assembly():
    """Where the lumped model with rigid bodies is 5 to 30 % too stiff, it is within 5 %, most of it on the stiff side."""
    theta = np.radians([45.0, 70.0, 90.0, 120.0])
    contacts = [find_contacts(wheel(), angle, 2e-3) for angle in theta]
    solids = Solids(CAM, SHAFT, usual_wheel(wheel(), drive(), WIDTH))
    train = elastic_train(wheel(), drive(), solids, fineness=1.8)
    for model, torque in (("unilateral", 1000.0), ("bonded", -1000.0)):
        assembly = solid_stiffness(wheel(), drive(), solids, theta, contacts, torque, model=model, fineness=1.8)
        found = solve_torsional_stiffness(train, theta, contacts, 0.01, torque, model=model)
        assert np.all(assembly.reduced.secant / assembly.secant > 1.03)
        assert np.all(np.abs(found.secant / assembly.secant - 1) < 0.05)
