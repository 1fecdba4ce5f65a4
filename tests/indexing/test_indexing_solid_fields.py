"""Von Mises stress on cams, shafts and wheel: scale, place, what is left out beside contacts, tables of the report."""

from functools import cache

import numpy as np
import pytest
from solid_indexer import ANGLES, CAM, SHAFT, WIDTH, drive, solved, wheel

from drivewright.fatigue import von_mises
from drivewright.indexing.plane import find_contacts
from drivewright.indexing.solid import Solids, bodies
from drivewright.indexing.solid.fields import BESIDE, Loaded, pressed_points, stress_fields
from drivewright.indexing.solid.springs import Position
from drivewright.indexing.solid.tables import STRESSED, assembly_plots, stress_tables
from drivewright.solids.coupling import CoupledSolution
from drivewright.solids.elastic import superposed_field
from drivewright.solids.stresses import hooke

pytestmark = [pytest.mark.analytical, pytest.mark.needs_fe]


@cache
def loaded():
    return solved(drive(), Solids(CAM, SHAFT), -1000.0, fineness=2.2)


def body(name):
    return next(each for each in loaded().fields.bodies if each.name == name)


def test_all_solids_have_stress_at_the_positions_kept():
    fields = loaded().fields
    assert fields.name == "assembly" and [each.name for each in fields.bodies] == ["cam_0", "cam_1", "shaft_0", "shaft_1"]
    assert set(fields.steps) <= {f"input at {angle:.4g}°" for angle in np.degrees(ANGLES)}
    for each in fields.bodies:
        assert each.triangles.max() < len(each.points) and each.displacements.shape == (len(fields.steps), len(each.points), 3)
        assert each.field("mises").values.shape == (len(fields.steps), len(each.points))


def test_the_cam_lies_where_the_reduced_model_has_it():
    """Cam j on its crank, at the height of its seat, cam 1 turned by half a turn."""
    for j in (0, 1):
        places = body(f"cam_{j}").places
        assert np.hypot(*places[:, :2].T) == pytest.approx(wheel().eccentricity)
        assert np.unique(places[:, 2]) == pytest.approx(drive().shaft.cams[j])
        assert np.cos(places[:, 3]) == pytest.approx((-1.0) ** j)
    assert body("shaft_0").places[:, 0] == pytest.approx(-drive().spacing / 2)
    assert body("shaft_1").places[:, 0] == pytest.approx(drive().spacing / 2)


def test_the_stress_of_a_cam_balances_its_load():
    """Two seats pulled apart: twice the mean of sxx over half the section between them is the force, and the field is at that scale."""
    pull, holes = 1000.0, [-0.055 + 0j, 0.055 + 0j]
    strip = {(0, 0): (0.112j, 1j)}
    made = bodies.cam(wheel().profile.outline(), CAM, holes, strip, 1.6e-3, 1.8)
    loads = np.zeros(len(made.flexibility))
    loads[made.number["seat", 0, 0]], loads[made.number["seat", 1, 0]] = -pull, pull
    vector = superposed_field(made.fields, loads)
    y, z = np.linspace(-0.12, 0.12, 401), np.linspace(0.0, WIDTH / 2, 7)
    y, z = 0.5 * (y[1:] + y[:-1]), 0.5 * (z[1:] + z[:-1])
    spots = [(a, b) for a in y for b in z if made.free.mesh.Contains(0.0, 1e3 * a, 1e3 * b)]
    stress = stress_at(made.free, vector, [(0.0, *spot) for spot in spots])
    measured = 2 * stress[:, 0, 0].sum() * (y[1] - y[0]) * (z[1] - z[0])
    scale = pull / measured
    assert scale == pytest.approx(1 / bodies.STIFFENED, rel=0.03)
    solution = CoupledSolution(np.zeros(0), np.zeros(0), loads, np.zeros(len(loads)), {})
    place = Position(0, 0.0, 0.0, wheel().pins, find_contacts(wheel(), ANGLES[1]))
    fields = stress_fields(drive(), {("cam", 0): made}, [Loaded(place, solution, (np.zeros(0, complex),))], 0.01, 1, 1.6e-3)
    (cam,) = fields.bodies
    nearest = np.linalg.norm(cam.points - [0.0, 0.03, WIDTH / 2], axis=1).argmin()
    expected = scale * von_mises(stress_at(made.free, vector, [0.999 * cam.points[nearest]]))[0]
    assert cam.field("mises").values[0, nearest] == pytest.approx(expected, rel=0.15)


def stress_at(free, vector, points):
    """Stress (n, 3, 3) [Pa] inside a body at points [m]."""
    shape = free.ng.GridFunction(free.space)
    shape.vec.data = vector
    x, y, z = 1e3 * np.array(points).T
    return hooke(free, np.asarray(free.ng.Grad(shape)(free.mesh(x, y, z))).reshape(-1, 3, 3))


def test_stress_grows_with_the_load_and_not_with_its_half():
    """Of a bonded model twice the torque is twice the stress; with gaps the same contacts press a little more."""
    once = solved(drive(), Solids(CAM), -500.0, theta=ANGLES[1:2], fineness=2.2, model="bonded").fields.bodies[0]
    twice = solved(drive(), Solids(CAM), -1000.0, theta=ANGLES[1:2], fineness=2.2, model="bonded").fields.bodies[0]
    ratio = np.nanmedian(twice.field("mises").values / once.field("mises").values)
    assert ratio == pytest.approx(2.0, rel=0.1)


def test_elements_beside_a_loaded_contact_have_no_stress():
    """Each is bare as a whole; all bare points lie in patches at the profile, not much larger than what is left out."""
    cam = body("cam_0")
    bare = np.isnan(cam.field("mises").values)
    assert 0 < bare.mean() < 0.3
    assert np.array_equal(bare[:, cam.triangles].any(axis=2), bare[:, cam.triangles].all(axis=2))
    assert np.hypot(*cam.points[bare.any(axis=0), :2].T).min() > 0.05
    assert BESIDE * 0.2 * wheel().pin_radius == pytest.approx(wheel().pin_radius)


def test_only_contacts_that_press_are_left_out():
    points = {0: 1 + 0j, 1: 2 + 0j, 3: 4j}
    forces = np.array([[5.0, 0.0, 7.0, 1.0], [0.0, 2.0, 0.0, np.nan]])
    first, second = pressed_points(points, forces, [0, 1, 3])
    assert first.tolist() == [1, 4j] and second.tolist() == [2]


def test_displacements_have_no_motion_as_a_whole():
    """A bent shaft moves far less than its ends would if it turned with its cams."""
    assert np.abs(body("shaft_0").displacements).max() < 5e-4
    assert body("cam_0").mirrored and body("cam_0").points[:, 2].max() == pytest.approx(WIDTH / 2, rel=1e-6)


def test_a_shaft_of_glued_pieces_is_one_closed_surface():
    """Every side belongs to two triangles; a face inside would be a third."""
    shaft = body("shaft_0")
    _, same = np.unique(shaft.points.round(9), axis=0, return_inverse=True)
    corners = np.ravel(same)[shaft.triangles]
    sides = np.sort(np.stack([corners, np.roll(corners, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
    assert np.unique(np.unique(sides, axis=0, return_counts=True)[1]).tolist() == [2]


def test_tables_draw_the_body_that_bears_most_where_it_does():
    fields = loaded().fields
    tables = {table.name: table for table in stress_tables(fields)}
    assert set(tables) == {"assembly_cam_stress", "assembly_shaft_stress"}
    for kind in ("cam", "shaft"):
        table = tables[f"assembly_{kind}_stress"]
        most = max(each.field("mises").range[1] for each in fields.bodies if each.name.startswith(kind))
        assert np.nanmax(table["mises"].data) == pytest.approx(most, rel=1e-6)
        assert len(table["right"].data) % 3 == 0 and "input at" in table.title
        assert np.isnan(table["mises"].data).any() == bool(table.missing) == (kind == "cam")
    assert {plot.name for plot in assembly_plots(tables)} == set(tables) and set(STRESSED) == {"cam", "shaft", "wheel"}
