"""G-code read back by a small control of our own: what the cutter leaves standing is the part."""

import re

import numpy as np
import pytest
import shapely
from export_cases import BASE, LIFT, cam, concave_radius, drawing, lobed

from drivewright.report.gcode import gcode, write_gcode
from drivewright.scene import Drawing, Shape, circle, polygon

pytestmark = pytest.mark.property

SETTINGS = {"cutter_diameter": 0.006, "feed": 0.012, "plunge": 0.002, "step_down": 0.005, "spindle_speed": 400.0}
NUMBER = re.compile(r"([A-Z])(-?\d+\.?\d*)")


class Move:
    """One block: motion code, points (n, 3) in mm, feed in mm/min, centre of an arc."""

    def __init__(self, code, points, feed, center=None):
        self.code, self.points, self.feed, self.center = code, np.asarray(points), feed, center


def run(program):
    """The moves of a program, as a control in mode G90 G17 G21 makes them."""
    at, feed, moves = np.array([0.0, 0.0, 100.0]), None, []
    for line in program.splitlines():
        words = dict(NUMBER.findall(re.sub(r"\(.*?\)", "", line)))
        feed = float(words.get("F", feed or 0)) or feed
        if not re.match(r"G[0123] ", line):
            continue
        end = np.array([float(words.get(axis, old)) for axis, old in zip("XYZ", at, strict=True)])
        code, center = int(words["G"]), None
        if code < 2:
            points = [at, end]
        else:
            center = at[:2] + [float(words["I"]), float(words["J"])]
            points = turn(at, end, center, 1 if code == 3 else -1)
        moves.append(Move(code, points, None if code == 0 else feed, center))
        at = end
    return moves


def turn(at, end, center, sense):
    """Points of an arc; like a control, a full turn where start and end agree, and an alarm where the radii do not."""
    a, b = (complex(*(p[:2] - center)) for p in (at, end))
    assert abs(abs(a) - abs(b)) < 2e-3 and abs(a) > 1e-3
    sweep = sense * ((sense * np.angle(b / a)) % (2 * np.pi) or 2 * np.pi)
    part = np.linspace(0, 1, max(4, int(np.ceil(abs(sweep) * np.sqrt(abs(a) / 8e-5)))))
    z = a * np.exp(1j * sweep * part)
    return np.stack([center[0] + z.real, center[1] + z.imag, at[2] + part * (end[2] - at[2])], axis=1)


def swept(moves, radius, depth):
    """Area [mm^2] cleared by the cutter's disc at full depth."""
    chains = [move.points[:, :2] for move in moves if np.all(move.points[:, 2] <= -depth + 1e-3)]
    return shapely.union_all([shapely.LineString(points).buffer(radius, quad_segs=200) for points in chains])


def part_left(moves, settings, depth, keep):
    """What stays of a big plate, around the point `keep`."""
    plate = shapely.box(-100, -100, 100, 100).difference(swept(moves, 1e3 * settings["cutter_diameter"] / 2, depth))
    return next(piece for piece in plate.geoms if piece.contains(shapely.Point(keep)))


def milled(outline, **changes):
    settings = {**SETTINGS, **changes}
    return run(gcode(Drawing("plate", "Plate", (Shape("profile", outline),), 0.004), **settings)), settings


def passes(moves):
    """The cutting moves between one retreat to the safe height and the next."""
    groups = [[]]
    for move in moves:
        if move.code == 0:
            groups += [[]] if groups[-1] else []
        else:
            groups[-1].append(move)
    return [group for group in groups if group]


@pytest.mark.parametrize("diameter", [0.004, 0.010])
def test_what_is_left_is_the_cam_within_the_tolerance(diameter):
    settings = {**SETTINGS, "cutter_diameter": diameter}
    moves = run(gcode(drawing(), **settings, tolerance=2e-6))
    left = part_left(moves, settings, 12.0, (0.02, 20.0))
    exact = shapely.Polygon(1e3 * cam(knots=4000).points(1e-9))
    hole = shapely.Point(2.0, -1.0).buffer(6.0, quad_segs=500)
    wanted = exact.difference(hole)
    assert left.exterior.hausdorff_distance(wanted.exterior) < 2.0e-3 + 0.3e-3  # the tolerance, and four decimals
    assert wanted.buffer(-2.3e-3).difference(left).is_empty  # no gouge
    assert left.area == pytest.approx(wanted.area, rel=5e-5)


def test_lobes_with_concave_places_come_out_right():
    moves, settings = milled(lobed())
    left = part_left(moves, settings, 4.0, (0.0, 0.0))
    exact = shapely.Polygon(1e3 * lobed(knots=6000).points(1e-9))
    assert left.exterior.hausdorff_distance(exact.exterior) < 2.3e-3


def test_corners_of_a_plate_stay_sharp_and_cost_one_arc_each():
    corners = [(0.0, 0.0), (0.03, 0.002), (0.025, 0.02), (-0.004, 0.015)]
    moves, settings = milled(polygon(corners), step_down=0.004)
    left = part_left(moves, settings, 4.0, (10.0, 8.0))
    assert left.symmetric_difference(shapely.Polygon(1e3 * np.array(corners))).area < 0.02
    rounds = [move for move in moves if move.code == 2]
    assert sorted(tuple(np.round(move.center, 3)) for move in rounds) == sorted(tuple(np.round(1e3 * np.array(c), 3)) for c in corners)


def test_dwells_are_arcs_about_the_camshaft_with_the_cutter_added():
    moves = run(gcode(drawing(), **SETTINGS))
    radii = {round(np.hypot(*(move.points[0][:2] - move.center)), 3) for move in moves if move.code == 2 and np.hypot(*move.center) < 1e-3}
    assert radii == {1e3 * BASE + 3.0, 1e3 * (BASE + LIFT) + 3.0}


def test_profile_is_travelled_clockwise_and_bores_counter_clockwise():
    bore, *profile = passes(run(gcode(drawing(), **SETTINGS)))
    assert turning(bore) > 0
    assert all(turning(group) < 0 for group in profile)


def turning(moves):
    """Signed area [mm^2] about the mean point of a path."""
    z = np.concatenate([move.points[:, 0] + 1j * move.points[:, 1] for move in moves])
    z -= z.mean()
    return 0.5 * np.sum(np.imag(np.conj(z[:-1]) * z[1:]))


def test_depth_is_shared_evenly_and_no_step_is_deeper_than_asked():
    program = gcode(drawing(), **{**SETTINGS, "step_down": 0.0035})
    bore, *profile = passes(run(program))
    depths = [min(move.points[-1][2] for move in group) for group in profile]
    assert depths == pytest.approx([-3.0, -6.0, -9.0, -12.0])
    helix = [move for move in bore if move.code == 3]
    drops = [move.points[0][2] - move.points[-1][2] for move in helix]
    assert max(a + b for a, b in zip(drops[:-1], drops[1:], strict=True)) == pytest.approx(3.0, abs=1e-3)
    assert all(move.points[-1][2] == -12.0 for move in helix[-3:])


def test_rapids_travel_above_the_plate_and_never_plunge_into_it():
    moves = run(gcode(drawing(), **SETTINGS, safe_height=0.004))
    floor = {}
    for move in moves:
        (x, y, high), (_, _, low) = move.points[0], move.points[-1]
        if move.code == 0 and np.hypot(*(move.points[-1] - move.points[0])[:2]) > 0:
            assert high == low == 4.0
        elif move.code == 0 and low < high:
            assert low >= floor.get((x, y), 0.0) + 0.5
        if move.code == 1 and high > low:
            assert move.feed == pytest.approx(120.0)
            floor[(x, y)] = low
        elif move.code:
            assert move.feed == pytest.approx(720.0)


def test_cutter_comes_and_goes_on_quarter_circles_tangent_to_the_path():
    for group in passes(run(gcode(drawing(), **SETTINGS, lead_radius=0.002)))[1:]:
        plunge, entry, first, last, leave = *group[:3], *group[-2:]
        assert plunge.code == 1 and entry.code == leave.code == 3
        for before, after in ((entry, first), (last, leave)):
            assert heading(after, 0) == pytest.approx(heading(before, -1), abs=0.02)
        for lead in (entry, leave):
            assert abs(np.angle(heading(lead, -1) / heading(lead, 0))) == pytest.approx(np.pi / 2, abs=0.05)
            assert np.hypot(*(lead.points[0][:2] - lead.center)) == pytest.approx(2.0, abs=1e-3)
        assert np.abs(first.points[0] - last.points[-1]).max() < 2e-4


def heading(move, end):
    a, b = (move.points[0], move.points[1]) if end == 0 else (move.points[-2], move.points[-1])
    z = complex(*(b - a)[:2])
    return z / abs(z)


def test_header_says_units_plane_cutter_and_speed():
    program = gcode(drawing(), **SETTINGS)
    lines = program.splitlines()
    assert lines[0] == lines[-1] == "%" and lines[-2] == "M30" and lines[2] == "(MAIN CAM <1>)"
    assert "G21 G90 G17 G40 G49 G80 G94" in lines and f"S{400 * 30 / np.pi:.0f} M3" in lines
    assert "(CUTTER DIAMETER 6.0000, CLIMB MILLING, ITS RADIUS IS IN THE PATH: NO G41 OR G42)" in lines
    assert all(line.isascii() and len(line) < 130 for line in lines)
    assert all("." in number for line in lines if re.match(r"G[0123] ", line) for number in re.findall(r"[XYZIJF](\S+)", line))


def test_bore_is_left_on_a_half_circle_to_its_middle():
    bore = passes(run(gcode(drawing(), **SETTINGS)))[0]
    wall, off = bore[-2:]
    assert heading(off, 0) == pytest.approx(heading(wall, -1), abs=0.02)
    assert off.points[-1] == pytest.approx((2.0, -1.0, -12.0))


def test_corner_too_flat_to_see_does_not_become_a_full_turn():
    # the arc about it is 0.02 micrometres long: its ends print alike, and a control would mill a whole circle of the cutter's radius
    bent = [(0.0, 0.0), (0.015, -1e-7), (0.03, 0.0), (0.03, 0.02), (0.0, 0.02)]
    moves, settings = milled(polygon(bent))
    assert sum(move.code == 2 for move in moves) == 4
    left = part_left(moves, settings, 4.0, (10.0, 8.0))
    assert left.symmetric_difference(shapely.Polygon(1e3 * np.array(bent))).area < 0.02


def test_lead_in_finds_room_or_says_that_there_is_none():
    # both joints of the closed spline lie in a valley between lobes
    valley = lobed(depth=-0.3, lobes=2)
    moves, settings = milled(valley, lead_radius=0.003)
    left = part_left(moves, settings, 4.0, (0.0, 0.0))
    assert left.exterior.hausdorff_distance(shapely.Polygon(1e3 * lobed(-0.3, 2, knots=6000).points(1e-9)).exterior) < 2.3e-3
    with pytest.raises(ValueError, match="no joint of the profile leaves room for a lead-in of radius 40 mm; give a smaller lead_radius"):
        milled(valley, lead_radius=0.040)


def test_wide_bore_names_its_loose_core_and_a_square_hole_is_left_out():
    square = polygon([(0.012, -0.002), (0.016, -0.002), (0.016, 0.002), (0.012, 0.002)])
    part = Drawing("cam", "Cam", (Shape("profile", cam()), Shape("hole", circle((0.0, 0.0), 0.010)), Shape("hole", square)), 0.012)
    program = gcode(part, **SETTINGS)
    assert "(BORE AT X0.0000 Y0.0000, DIAMETER 20.0000, LEAVES A LOOSE CORE OF DIAMETER 8.0000)" in program
    assert "(HOLE NEAR X14.0000 Y0.0000 IS LEFT OUT: IT IS NOT ROUND)" in program
    assert len(passes(run(gcode(part, **SETTINGS, bores=False)))) == len(passes(run(program))) - 1


def test_bore_of_the_cutters_own_size_is_a_plunge():
    part = Drawing("cam", "Cam", (Shape("profile", cam()), Shape("hole", circle((0.001, 0.0), 0.003))), 0.012)
    (plunge,) = passes(run(gcode(part, **SETTINGS)))[0]
    assert plunge.points[-1] == pytest.approx((1.0, 0.0, -12.0))


def test_cutter_may_be_as_wide_as_the_tightest_concave_place_and_no_wider():
    limit = 2 * concave_radius()
    moves, settings = milled(lobed(), cutter_diameter=0.97 * limit)
    left = part_left(moves, settings, 4.0, (0.0, 0.0))
    assert left.exterior.hausdorff_distance(shapely.Polygon(1e3 * lobed(knots=6000).points(1e-9)).exterior) < 2.3e-3
    with pytest.raises(ValueError, match="concave"):
        milled(lobed(), cutter_diameter=1.01 * limit)


def test_file_is_the_program(tmp_path):
    write_gcode(drawing(), tmp_path / "cam.nc", **SETTINGS)
    assert (tmp_path / "cam.nc").read_bytes().decode() == gcode(drawing(), **SETTINGS)
