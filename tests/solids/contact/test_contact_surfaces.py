"""Pieces of contact and stress on their own: rays that meet skins, width of what presses, Hooke's law, von Mises stress."""

import numpy as np
import pytest

from drivewright.fatigue import von_mises
from drivewright.solids.contact import ContactModel, Functional, Pair
from drivewright.solids.contact.model import contact_width
from drivewright.solids.contact.surfaces import hit_by_rays, skin_of
from drivewright.solids.elastic import FreeBody, Plane
from drivewright.solids.stresses import hooke
from tests.support.pressed_bodies import NU, SHEET, E, block

pytestmark = [pytest.mark.analytical, pytest.mark.needs_fe]


def test_a_ray_meets_the_side_that_faces_it_and_not_the_nearer_back():
    """From inside a block upwards: the top is nearer, but its normal points the same way."""
    skin = skin_of(block((0, 0), (3, 1), 3.0), ".*")
    up, down = np.array([[0.0, 1.0]]), np.array([[0.0, -1.0]])
    assert hit_by_rays(skin, np.array([[1.4, 0.9]]), up).distance == pytest.approx([-0.9])
    assert hit_by_rays(skin, np.array([[1.4, 0.2]]), down).distance == pytest.approx([-0.8])


def test_a_ray_that_passes_by_meets_nothing():
    skin = skin_of(block((0, 0), (3, 1), 3.0), ".*")
    found = hit_by_rays(skin, np.array([[3.5, -1.0]]), np.array([[0.0, 1.0]]))
    assert found.element.tolist() == [-1]
    assert np.isinf(found.distance[0])


@pytest.mark.parametrize(("held", "width"), [({}, 10.0), ({"dirichletx": "left"}, 20.0)])
def test_width_of_what_presses_is_that_of_an_even_strip_completed_at_a_plane_of_symmetry(held, width):
    lower = FreeBody(block((-2, 0), (12, 6), 1.1), E, NU, Plane(SHEET), dirichlety="bottom", dirichletx="bottom")
    upper = FreeBody(block((0, 6), (10, 12), 0.5), E, NU, Plane(SHEET), **held)
    push = Functional("upper", upper.mean("top", (0, -1)))
    model = ContactModel({"upper": upper, "lower": lower}, [Pair(("upper", "bottom"), ("lower", "top"), 1e-4)], [], {"push": push})
    (pairing,) = model.pairings
    assert contact_width(pairing, np.ones(len(pairing.area), bool), upper) == pytest.approx(width, rel=0.01)
    half = pairing.places[:, 0] < 5.01
    assert contact_width(pairing, half, upper) == pytest.approx(width / 2, rel=0.06)


@pytest.mark.parametrize("state", ["strain", "stress"])
def test_hookes_law_of_a_stretch_in_the_plane(state):
    """Plane strain: (1 - nu) E e/((1 + nu)(1 - 2 nu)) along, nu/(1 - nu) of it beside.  Plane stress: E e/(1 - nu^2), nu of it, 0."""
    body, stretch = FreeBody(block((0, 0), (1, 1), 1.0), E, NU, Plane(SHEET, state)), 1e-3
    (found,) = hooke(body, np.array([[[stretch, 0.0], [0.0, 0.0]]]))
    if state == "strain":
        along = E * stretch * (1 - NU) / ((1 + NU) * (1 - 2 * NU))
        sides = NU / (1 - NU) * np.array([along, along])
    else:
        along = E * stretch / (1 - NU**2)
        sides = np.array([NU * along, 0.0])
    assert np.diag(found) == pytest.approx([along, *sides])
    assert found[0, 1] == 0


def test_hookes_law_of_a_shear_and_of_a_turn():
    body, angle = FreeBody(block((0, 0), (1, 1), 1.0), E, NU, Plane(SHEET)), 1e-3
    sheared, turned = hooke(body, np.array([[[0.0, angle], [0.0, 0.0]], [[0.0, angle], [-angle, 0.0]]]))
    assert sheared[0, 1] == sheared[1, 0] == pytest.approx(E / 2 / (1 + NU) * angle)
    assert np.abs(turned).max() == 0


def test_von_mises_stress_of_a_pull_a_shear_and_a_pressure_from_all_sides():
    pull, shear = np.diag([0.0, -7.0, 0.0]), np.zeros((3, 3))
    shear[0, 2] = shear[2, 0] = 5.0
    assert von_mises(np.array([pull, shear, -3.0 * np.eye(3)])) == pytest.approx([7.0, 5.0 * np.sqrt(3), 0.0])
