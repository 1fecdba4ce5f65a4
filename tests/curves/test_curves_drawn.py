"""The drawn outlines agree with the exactly trimmed ones to the drawing's fineness: a second route to gears, cams and indexing cams."""

from pathlib import Path

import numpy as np
import pytest
import shapely

import drivewright as dw
from drivewright import cams, curves
from drivewright.curves.display import chords
from drivewright.errors import InputError
from drivewright.gears import EllipticGearPair, Rack, RackFamily, cut_gear
from drivewright.mechanisms.cam.build import profile
from drivewright.numerics.jets import exp, variable
from drivewright.scene import Spline

pytestmark = pytest.mark.property

MECHANISMS = Path(dw.__file__).parent / "mechanisms"
FINE = 2e-6  # m


def presets(kind, quick):
    """Every preset of a kind; those that are not `quick` are for the slow tests."""
    names = [path.stem for path in sorted((MECHANISMS / kind / "presets").glob("*.toml"))]
    assert set(quick) < set(names)
    return [pytest.param(name, marks=() if name in quick else pytest.mark.slow) for name in names]


def model_of(kind, name):
    return dw.build(dw.load(MECHANISMS / kind / "presets" / f"{name}.toml"))


def apart(drawn, exact):
    """Largest distance of the two closed curves [m], either way, and the relative difference of their areas."""
    rings = [shapely.linearrings(outline.points(1e-7)) for outline in (drawn, exact)]
    areas = [shapely.area(shapely.polygons(ring)) for ring in rings]
    return shapely.hausdorff_distance(*rings), abs(areas[0] / areas[1] - 1)


def check(drawn, exact, tolerance, most=4.0):
    distance, area = apart(drawn, exact)
    assert distance < most * tolerance and area < 1e-3
    for before, after in zip(drawn.pieces, (*drawn.pieces[1:], drawn.pieces[0]), strict=True):
        assert ends(before)[1] == pytest.approx(ends(after)[0], abs=1e-12)


def ends(piece):
    points = piece.points(1e-6)
    return tuple(points[0]), tuple(points[-1])


@pytest.mark.parametrize("name", presets("seedling_pusher", ["default", "paper-interior"]))
def test_pusher_cams_and_gear(name):
    model = model_of("seedling_pusher", name)
    for cam in model.pair.cams:
        check(model.display_profiles[cam.name], model.profiles[cam.name], model.display_tolerance)
    check(model.display_gear, model.gear_outline, model.display_tolerance)


@pytest.mark.parametrize("name", presets("cam", ["conjugate", "flat", "groove", "oscillating"]))
def test_cams(name):
    model = model_of("cam", name)
    for number, track in enumerate(model.tracks):
        if track.cut and track.radius:
            family = cams.family(track.follower, model.programme, track.flank)
            exact = profile(model, number)
            check(curves.display_outline(family, FINE), exact.outline, FINE)
            simple = curves.simple_outline(family, FINE)
            assert (simple is None) == bool(exact.trimmed.removed)
            if simple:
                check(simple, exact.outline, FINE)


@pytest.mark.parametrize("name", ["default", "cycloid", "parallel"])
def test_indexing_cams_of_both_sides(name):
    for level in model_of("indexer", name).drive.levels:
        check(curves.display_outline(level.family, 10 * FINE), level.profile.outline(FINE), 10 * FINE)


@pytest.mark.parametrize(
    "teeth, rack", [(7, Rack()), pytest.param(11, Rack(addendum=1.25), marks=pytest.mark.slow), (23, Rack(backlash=0.1))]
)
def test_undercut_and_pointed_gears_are_trimmed_alike(teeth, rack):
    pair = EllipticGearPair(0.35, 0.02)
    exact = cut_gear(pair, 1, teeth, rack)
    assert bool(exact.undercut) == (teeth < 20)
    family = RackFamily(pair, 1, teeth, rack)
    check(curves.display_outline(family, FINE, fewest=6), exact.outline(1e-7), FINE)


def round_path(radius):
    """A centre on a circle of `radius` about the origin."""
    return (curves.Piece(0.0, 2 * np.pi, lambda t: radius * exp(1j * variable(t)), "round", "arc"),)


@pytest.mark.parametrize("material, left", [("inside", 20e-3), ("outside", 30e-3)])
def test_a_roller_on_a_circle_leaves_a_circle(material, left):
    outline = curves.display_outline(curves.CircleFamily(round_path(25e-3), 5e-3, material), FINE)
    radii = np.hypot(*outline.points().T)
    assert radii == pytest.approx(left, rel=1e-12) and len(radii) < 400
    assert len(outline.pieces) == 1 and isinstance(outline.pieces[0], Spline)  # smooth all the way round
    start, tangent = outline.pieces[0].knots[0], outline.pieces[0].start_tangent
    assert np.dot(start, tangent) == pytest.approx(0, abs=1e-3 * left) and np.hypot(*tangent) == pytest.approx(1)


@pytest.mark.parametrize("tolerance", [1e-5, 1e-6, 1e-7])
def test_chords_stay_within_the_tolerance(tolerance):
    """Of a circle the sagitta is R (1 - cos(step/2)), and no chord is much shorter than it may be."""
    _, t, z = chords(round_path(25e-3), tolerance, 5)
    step = np.abs(np.diff(t))
    sagitta = 25e-3 * (1 - np.cos(0.5 * step.max()))
    assert 0.3 * tolerance < sagitta <= tolerance * 1.001
    assert np.abs(z) == pytest.approx(25e-3, rel=1e-12)


def test_a_corner_parts_the_splines():
    """A roller on two arcs leaves a lens: its corners lie where circles of radius R about -a and +a meet, at +-sqrt(R^2 - a^2)."""
    radius, a = 20e-3, 5e-3

    def arc(center):
        return lambda t: center + (radius + 4e-3) * exp(1j * variable(t))

    top = np.sqrt((radius + 4e-3) ** 2 - a**2)
    half = np.arctan2(top, a)

    def left(t):
        return arc(a)(t - 2 * half + np.pi)

    path = (curves.Piece(-half, half, arc(-a), "right", "arc"), curves.Piece(half, 3 * half, left, "left", "arc"))
    outline = curves.display_outline(curves.CircleFamily(path, 4e-3), FINE)
    corner = np.sqrt(radius**2 - a**2)
    tops = [ends(piece)[0] for piece in outline.pieces]
    assert len(tops) == 2 and [x for x, _ in tops] == pytest.approx([0, 0], abs=3 * FINE)
    assert sorted(y for _, y in tops) == pytest.approx([-corner, corner], abs=3 * FINE)


def test_a_roller_over_the_axis_is_refused_as_by_the_exact_route():
    with pytest.raises(InputError, match="passes .* mm over the interior point"):
        curves.display_outline(curves.CircleFamily(round_path(4e-3), 5e-3), FINE)


def test_pieces_of_one_formula_are_gathered_with_their_own_numbers():
    def arc(center, radius, t):
        return center + radius * exp(1j * variable(t))

    pieces = [curves.Piece(0.0, 1.0, curves.Member(arc, (center, radius))) for center, radius in ((0.0, 1.0), (1 + 2j, 0.5), (-1.0, 3.0))]
    index, t = np.array([2, 0, 1, 1, 2]), np.array([0.1, 0.2, 0.3, 0.4, 0.5])
    found = curves.pieces.gather(pieces, index, t)
    alone = [pieces[k].at(np.array([x])) for k, x in zip(index, t, strict=True)]
    for order in ("d0", "d1", "d2", "d3"):
        assert getattr(found, order) == pytest.approx(np.array([getattr(jet, order)[0] for jet in alone]), rel=1e-15)
