"""Finished profiles: against a second geometry library, true arcs, limits of the face, size of a flat face and its cam."""

from dataclasses import replace

import numpy as np
import pytest
import shapely

from drivewright import cams, curves
from drivewright.motion import Programme, Segment
from drivewright.numerics.jets import variable

pytestmark = pytest.mark.analytical


def programme(rise, law="cycloidal", angles=(80, 30, 120, 130)):
    a, b, c, d = np.radians(angles)
    return Programme((Segment(a, law, rise), Segment(b, "dwell"), Segment(c, law, -rise), Segment(d, "dwell")))


ROUND = [
    (cams.TranslatingRound(0.04, 0.008, 0.006), 0.018),
    (cams.TranslatingRound(0.04, 0.008, -0.01, sense=-1), 0.018),
    (cams.TranslatingRound(0.075, 0.03, 0.004), 0.015),
    (cams.TranslatingRound(0.055, 0.008, 0.003, side=-1), 0.012),
    (cams.OscillatingRound(0.04, 0.008, 0.085, 0.06), 0.3),
    (cams.OscillatingRound(0.04, 0.008, 0.085, 0.06, sense=-1), 0.3),
    (cams.OscillatingRound(0.06, 0.009, 0.085, 0.06, side=-1), 0.25),
]


@pytest.mark.parametrize(("follower", "rise"), ROUND)
def test_roller_touches_the_profile_everywhere(follower, rise):
    motion = programme(rise)
    trimmed = curves.trim(cams.family(follower, motion))
    assert not trimmed.undercut
    body = shapely.Polygon(trimmed.outline(1e-9).points(1e-9))
    angle = np.linspace(0.01, 6.27, 61)
    centers = follower.pitch(variable(angle), cams.Cycle(motion.function).after(0.0, variable(angle))).d0
    gap = shapely.distance(shapely.boundary(body), shapely.points(centers.real, centers.imag)) - follower.radius
    assert np.max(np.abs(gap)) < 5e-9
    assert trimmed.area == pytest.approx(body.area, rel=1e-6)


def test_undercut_roller_sinks_by_the_lost_motion():
    follower, motion = cams.TranslatingRound(0.03, 0.02, 0.002), programme(0.02, angles=(60, 10, 70, 220))
    trimmed = curves.trim(cams.family(follower, motion))
    assert trimmed.undercut
    at, lost = curves.largest_profile_gap(trimmed)
    assert lost > 1e-4
    body = shapely.Polygon(trimmed.outline(1e-9).points(1e-9))
    lift = cams.Cycle(motion.function).after(0.0, variable(np.array([at])))
    center = follower.pitch(variable(np.array([at])), lift).d0[0]
    assert shapely.distance(shapely.boundary(body), shapely.Point(center.real, center.imag)) - 0.02 == pytest.approx(lost, rel=1e-4)


def test_dwells_are_true_arcs_about_the_cam_centre():
    outline = curves.trim(cams.family(cams.OscillatingRound(0.04, 0.008, 0.085, 0.06), programme(0.3))).outline()
    arcs = [piece for piece in outline.pieces if hasattr(piece, "radius")]
    psi = cams.oscillating.rest_angle(0.04, 0.085, 0.06) + 0.3
    top = abs(0.085 - 0.06 * np.exp(-1j * psi)) - 0.008
    assert sorted(arc.radius for arc in arcs) == pytest.approx([0.032, top], abs=1e-12)
    assert all(np.hypot(*arc.center) < 1e-12 for arc in arcs)
    assert sorted(abs(arc.sweep) for arc in arcs) == pytest.approx(np.radians([30, 130]), abs=1e-12)


def test_standstill_gives_a_circle():
    motion = Programme((Segment(np.pi, "dwell"), Segment(np.pi, "dwell")))
    trimmed = curves.trim(cams.family(cams.TranslatingRound(0.04, 0.008, 0.011), motion))
    assert trimmed.area == pytest.approx(np.pi * 0.032**2, rel=1e-12)
    assert trimmed.perimeter == pytest.approx(2 * np.pi * 0.032, rel=1e-12)


def test_small_roller_approaches_the_knife_edge_in_first_order():
    """Area under a roller = area of the pitch curve - r * its length + pi r^2 (a parallel curve)."""
    motion = programme(0.01)
    pieces = cams.path(motion, cams.TranslatingRound(0.04, 0.0).pitch)
    knife = curves.outline_of_spans(cams.spans(pieces), 1e-9)
    area, length = curves.outline_area(knife), curves.perimeter(knife)
    for radius in (1e-3, 1e-4):
        trimmed = curves.trim(cams.family(cams.TranslatingRound(0.04, radius), motion))
        assert trimmed.area == pytest.approx(area - radius * length + np.pi * radius**2, rel=1e-9)


def test_groove_is_two_parallel_walls():
    follower, motion = cams.TranslatingRound(0.045, 0.008, 0.004), programme(0.015)
    inner, outer = (curves.trim(cams.family(follower, motion, flank)) for flank in (1, -1))
    wall = shapely.Polygon(inner.outline(1e-9).points(1e-9)).exterior
    points = outer.outline(1e-6).points(1e-6)
    assert np.max(np.abs(shapely.distance(wall, shapely.points(points)) - 0.016)) < 1e-8
    angle = variable(np.array([0.9]))
    contact = [follower.contact(angle, cams.Cycle(motion.function).after(0.0, angle), flank) for flank in (1, -1)]
    assert abs(contact[0].point.d0[0] - contact[1].point.d0[0]) == pytest.approx(0.016, rel=1e-12)
    assert 1 / contact[0].curvature.d0[0] + 1 / contact[1].curvature.d0[0] == pytest.approx(-0.016, rel=1e-9)


FLAT = [
    (cams.TranslatingFlat(0.06), 0.012),
    (cams.TranslatingFlat(0.06, 0.1, 0.003, sense=-1), 0.012),
    (cams.OscillatingFlat(0.04, 0.09, 0.06, 0.006), 0.15),
    (cams.OscillatingFlat(0.05, 0.09, 0.06, -0.004, sense=-1), 0.12),
]


@pytest.mark.parametrize(("follower", "rise"), FLAT)
def test_flat_face_supports_the_profile_everywhere(follower, rise):
    motion = programme(rise)
    trimmed = curves.trim(cams.family(follower, motion))
    assert not trimmed.undercut
    points = trimmed.outline(1e-9).points(1e-9) @ (1, 1j)
    angle = variable(np.linspace(0.01, 6.27, 61))
    direction, support = follower.face(angle, cams.Cycle(motion.function).after(0.0, angle))
    reach = np.max((points[None] * np.exp(-1j * direction.d0[:, None])).real, axis=1)
    assert np.max(np.abs(reach - support.d0)) < 5e-9


@pytest.mark.parametrize(("follower", "rise"), FLAT)
def test_min_base_radius_is_where_the_profile_gets_a_corner(follower, rise):
    cycle = cams.Cycle(programme(1.2 * rise).function)
    base = cams.min_base_radius(cycle, follower)
    assert base > 0
    least = cycle.minimum(lambda angle, lift: cams.flat_radius(*replace(follower, base_radius=base).face(angle, lift))).value
    assert least == pytest.approx(0, abs=1e-13)


def test_a_swing_that_no_base_radius_can_follow():
    cycle = cams.Cycle(programme(0.4, angles=(70, 20, 80, 190)).function)
    assert np.isnan(cams.min_base_radius(cycle, FLAT[2][0]))


def test_min_base_radius_of_a_slide_is_a_formula():
    """A cosine s = h/2 (1 - cos theta) has s + s'' = h/2 everywhere: no base radius is too small."""
    smooth = Programme((Segment(np.pi, "simple-harmonic", 0.02), Segment(np.pi, "simple-harmonic", -0.02)))
    assert cams.min_base_radius(cams.Cycle(smooth.function), cams.TranslatingFlat(0.05)) == 0
    # Twice per turn, s = h/2 (1 - cos 2 theta): s + s'' = h/2 (1 + 3 cos 2 theta), least -h.
    quick = Programme(tuple(Segment(np.pi / 2, "simple-harmonic", sign * 0.02) for sign in (1, -1, 1, -1)))
    assert cams.min_base_radius(cams.Cycle(quick.function), cams.TranslatingFlat(0.05)) == pytest.approx(0.02, rel=1e-12)
    tilted = cams.min_base_radius(cams.Cycle(quick.function), cams.TranslatingFlat(0.05, 0.2))
    assert tilted == pytest.approx(0.02 * np.cos(0.2), rel=1e-12)


@pytest.mark.parametrize("follower", [case[0] for case in FLAT])
def test_face_ends_hold_every_contact(follower):
    """The contact seen in the follower's own frame, moved back by its travel."""
    cycle = cams.Cycle(programme(0.12 if hasattr(follower, "arm_length") else 0.012).function)
    angle, lift = cycle.at(*cycle.samples())
    here = follower.contact(angle, lift).point.d0 * np.exp(1j * follower.sense * angle.d0)
    if hasattr(follower, "arm_length"):
        back = (here - follower.pivot_distance) * np.exp(1j * lift.d0)
        normal, foot = 1j * np.exp(-1j * follower.rest_angle), 0.0
        along = (back * np.conj(1j * normal)).real
    else:
        back = here - 1j * lift.d0
        normal = 1j * np.exp(1j * follower.sense * follower.tilt)
        x = follower.sense * follower.offset
        foot = x + 1j * (follower.base_radius - x * normal.real) / normal.imag
        along = ((back - foot) * np.conj(-1j * follower.sense * normal)).real
    assert np.ptp((back * np.conj(normal)).real) < 1e-15
    low, high = cams.face_ends(cycle, follower)
    assert (low, high) == (pytest.approx(along.min(), abs=2e-6), pytest.approx(along.max(), abs=2e-6))
    assert low <= along.min() + 1e-15
    assert high >= along.max() - 1e-15


def test_yoke_breadth():
    shifted = Programme(
        (
            Segment(np.radians(150), "modified-sine", 0.02),
            Segment(np.radians(30), "dwell"),
            Segment(np.radians(150), "modified-sine", -0.02),
            Segment(np.radians(30), "dwell"),
        )
    )
    found = cams.breadth(cams.Cycle(shifted.function))
    assert found.mean == pytest.approx(0.02, rel=1e-12)
    assert found.error < 1e-16
    uneven = Programme((Segment(np.radians(170), "modified-sine", 0.02), Segment(np.radians(190), "modified-sine", -0.02)))
    wrong = cams.breadth(cams.Cycle(uneven.function))
    grid = np.linspace(0, np.pi, 20001)
    total = uneven(grid).s + uneven(grid + np.pi).s
    assert wrong.error == pytest.approx(np.ptp(total) / 2, rel=1e-6)
    assert wrong.mean == pytest.approx((total.max() + total.min()) / 2, rel=1e-6)
