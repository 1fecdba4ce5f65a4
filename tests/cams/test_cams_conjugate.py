"""Conjugate cams: how far their lever can swing, by the triangles of its arms; tables against the extremes found by other routes."""

from dataclasses import replace

import numpy as np
import pytest

from drivewright.cams.clearance import LeverRun
from drivewright.cams.conjugate import ConjugateCam, ConjugatePair
from drivewright.cams.conjugate_tables import DrivenMass, contact_table, geometry_table, load_table
from drivewright.cams.oscillating_batch import can_swing, conjugate_lever, main_pitch_radius
from drivewright.motion import Programme, Segment, law
from drivewright.numerics.jets import variable
from drivewright.scene import Arc, Spline

pytestmark = pytest.mark.analytical

PIVOT, MAIN_ARM, RETURN_ARM, OUTPUT = 0.030, 0.018, 0.020, 0.025
MAIN_PRIME, RETURN_PRIME, STROKE, ROLLER = 0.024, 0.029, 0.012, 0.004


@pytest.fixture(scope="module")
def pair():
    cycloidal = law("cycloidal")
    programme = Programme((Segment(1.2, cycloidal, STROKE), Segment(1.4, cycloidal, -STROKE), Segment(2 * np.pi - 2.6, "dwell")))
    cams = (
        ConjugateCam("main", MAIN_ARM, MAIN_PRIME, 1, PIVOT, ROLLER),
        ConjugateCam("return", RETURN_ARM, RETURN_PRIME, -1, PIVOT, ROLLER),
    )
    return ConjugatePair(cams, programme, 0.5, OUTPUT, 1, lambda t: 1.0 * variable(t))


@pytest.mark.parametrize("primes", [(MAIN_PRIME, RETURN_PRIME), (0.045, RETURN_PRIME), (MAIN_PRIME, 0.012)])
def test_the_lever_swings_up_to_its_dead_points(primes):
    main, back = (
        ConjugateCam(name, arm, prime, side, PIVOT, ROLLER)
        for name, arm, prime, side in (("main", MAIN_ARM, primes[0], 1), ("return", RETURN_ARM, primes[1], -1))
    )
    lever, limit = conjugate_lever(PIVOT, MAIN_ARM, RETURN_ARM, OUTPUT, *primes), min(np.pi - main.rest_angle, back.rest_angle)
    assert can_swing(lever, limit - 1e-6) and not can_swing(lever, limit + 1e-6)


@pytest.mark.parametrize("primes", [(0.010, RETURN_PRIME), (0.050, RETURN_PRIME), (MAIN_PRIME, 0.051)])
def test_an_arm_that_does_not_reach_its_cam_cannot_swing(primes):
    assert not can_swing(conjugate_lever(PIVOT, MAIN_ARM, RETURN_ARM, OUTPUT, *primes), 0.01)


def test_the_main_cam_is_largest_where_the_lever_has_swung_out(pair):
    lever = conjugate_lever(PIVOT, MAIN_ARM, RETURN_ARM, OUTPUT, MAIN_PRIME, RETURN_PRIME)
    assert main_pitch_radius(lever, 0.0) == pytest.approx(MAIN_PRIME, rel=1e-12)
    assert main_pitch_radius(lever, float(np.arctan(STROKE / OUTPUT))) == pytest.approx(pair.pitch_radii(pair.cams[0])[1], rel=1e-9)


def test_the_geometry_table_has_the_sharpest_place(pair):
    table = geometry_table(pair)
    for cam in pair.cams:
        radius, place = pair.min_convex_radius(cam)
        assert table[f"{cam.name}.convex_ratio"].data.max() == pytest.approx(ROLLER / radius, rel=2e-4)
        assert table[f"{cam.name}.curvature"].data.max() == pytest.approx(1 / radius, rel=2e-4)
        assert table["carrier_angle"].data[np.argmax(table[f"{cam.name}.curvature"].data)] == pytest.approx(place, abs=0.02)


def test_the_torque_gives_the_power_that_the_mass_takes(pair):
    speed, mass, resistance = 20.0, 0.4, 30.0
    table = load_table(pair, DrivenMass(speed, mass, resistance, 0.006, 1e11))
    angle, velocity, acceleration = (table[name].data for name in ("carrier_angle", "velocity", "acceleration"))
    rising = angle < pair.start + 1.2
    rising[np.flatnonzero(angle == pair.start + 1.2)[:1]] = True
    force = mass * acceleration + np.where(rising, resistance, 0.0)
    assert table["torque"].data * speed == pytest.approx(force * velocity, abs=1e-9)
    rise = slice(0, 181)  # the first smooth piece
    by_difference = np.gradient(velocity[rise], angle[rise] / speed, edge_order=2)
    assert acceleration[rise] == pytest.approx(by_difference, abs=2e-3 * np.max(np.abs(acceleration)))
    assert np.all((table["main.force"].data == 0) | (table["return.force"].data == 0))


def test_the_contact_table_counts_from_the_start_of_the_programme():
    angle = np.linspace(0, 2 * np.pi, 5)
    table = contact_table(LeverRun(angle, angle, 2 * angle, -angle, None), 0.7)
    assert table["carrier_angle"].data == pytest.approx(0.7 + angle)
    last = [table[name].data[-1] for name in ("main.force", "return.force", "rod_error")]
    assert last == pytest.approx([2 * np.pi, 4 * np.pi, -2 * np.pi])


# -- the pitch curves as outlines ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("orbit", [1, -1])
@pytest.mark.parametrize("number", [0, 1])
def test_a_pitch_outline_is_the_pitch_curve_with_true_arcs_while_the_lever_rests(pair, orbit, number):
    """Its pieces follow each other once around the axis, with the tangents of the curve; dwells are arcs about the axis."""
    around = replace(pair, orbit=orbit)
    cam = around.cams[number]
    pieces = around.pitch_outline(cam).pieces
    assert [type(piece) for piece in pieces] == [Arc if each.phase == "dwell" else Spline for each in around.pieces]
    ends = [(points[0], points[-1]) for points in (piece.points(1e-6) for piece in pieces)]
    for (_, end), (start, _) in zip(ends, ends[1:] + ends[:1], strict=True):
        assert end == pytest.approx(start, abs=1e-9)
    for piece, each in zip(pieces, around.pieces, strict=True):
        t = np.linspace(each.low, each.high, 9)
        curve = around.pitch(cam, t, each.number)
        exact = np.stack([curve.d0.real, curve.d0.imag], axis=1)
        if isinstance(piece, Arc):
            angles = piece.start + piece.sweep * np.linspace(0, 1, 9)
            assert piece.center == (0, 0) and exact == pytest.approx(
                piece.radius * np.stack([np.cos(angles), np.sin(angles)], axis=1), abs=1e-12
            )
        else:
            tangents = curve.d1 / np.abs(curve.d1)
            assert complex(*piece.start_tangent) == pytest.approx(tangents[0]) and complex(*piece.end_tangent) == pytest.approx(
                tangents[-1]
            )
            knots = piece.points(1e-6)
            gap = np.array([np.min(np.hypot(*(knots - point).T)) for point in exact])
            assert gap.max() < np.hypot(*np.diff(knots, axis=0).T).max()
    whole = around.pitch_outline(cam).points(1e-6)
    turned = np.angle(np.roll(whole[:, 0] + 1j * whole[:, 1], -1) / (whole[:, 0] + 1j * whole[:, 1])).sum()
    assert turned == pytest.approx(orbit * 2 * np.pi)
