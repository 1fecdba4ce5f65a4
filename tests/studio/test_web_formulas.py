"""The formulas of the page's modules, run in node: what a hand snaps to, what is measured, how a programme is stretched and drawn."""

import base64
import csv
import io
import math
import random
import re
import struct
from xml.etree import ElementTree

import numpy as np
import pytest
from in_node import in_node

from drivewright.spec.optimise_table import Optimise
from drivewright.studies.search.searching import most_evaluations
from drivewright.units import exact_factor

pytestmark = pytest.mark.interface


def packed(values):
    """Numbers as the studio packs them: base64 of float32."""
    return base64.b64encode(struct.pack(f"<{len(values)}f", *values)).decode()


# -- what a dragged point snaps to ---------------------------------------------------------------------------------------------


def snapped(at, **near):
    return in_node("return snapped(data.at, data.near);", {"at": at, "near": near}, snapping="snapped")


def test_a_point_snaps_to_the_nearest_of_those_it_may_fall_upon():
    found = snapped([10, 20], fixed=[[14, 20], [12, 21], [300, 3]], partners=[[10, 90]])
    assert found == {"at": [12, 21], "guides": [], "words": "on a point"}
    assert snapped([10, 20], fixed=[[17.5, 20]])["at"] == [10, 20]  # too far


def test_level_and_plumb_with_others():
    assert snapped([100, 52], partners=[[20, 50]]) == {"at": [100, 50], "guides": [[[100, 50], [20, 50]]], "words": "horizontal"}
    assert snapped([23, 300], partners=[[20, 50]]) == {"at": [20, 300], "guides": [[[20, 300], [20, 50]]], "words": "vertical"}
    both = snapped([23, 52], partners=[[200, 50], [20, 400]])
    assert both["at"] == [20, 50] and both["words"] == "" and len(both["guides"]) == 2


def test_a_length_that_others_have_is_kept_along_the_line_of_the_hand():
    found = snapped([62, 80], partners=[[0, 0]], lengths=[40, 100])
    assert found["words"] == "equal length" and found["guides"] == [[[0, 0], found["at"]]]
    x, y = found["at"]
    assert math.hypot(x, y) == pytest.approx(100) and x / y == pytest.approx(62 / 80)
    assert snapped([62, 80], partners=[[0, 0]], lengths=[140])["words"] == ""
    assert snapped([9, 9], partners=[[0, 0]], lengths=[6])["words"] == ""  # lengths shorter than a snap are none


def test_a_number_on_a_grid_is_the_nearest_multiple():
    pairs = [[7.3, 0.5], [-7.3, 0.5], [0.1 + 0.2, 0.1], [3.14159, 0], [12.49, 5]]
    found = in_node("return data.map(pair => onGrid(...pair));", pairs, snapping="onGrid")
    assert found == [7.5, -7.5, 0.3, 3.14159, 10]


# -- what can be measured ------------------------------------------------------------------------------------------------------

SCENE = {
    "bodies": [{"name": "crank", "label": "crank", "shapes": [0]}, {"name": "rod", "label": "rod", "shapes": [1, 1]}],
    "handles": [
        {"key": "crank.A", "body": 0, "point": [0.04, 0], "label": "A"},
        {"key": "size", "body": 0, "point": [0.01, 0], "direction": [1, 0], "label": ""},
    ],
    "traces": [{"body": 1, "point": [0.1, 0.05], "label": "P"}],
    "features": {
        "0": {"lines": [[0, 0, 0.04, 0], [0.01, 0.01, 0.01, 0.01]], "arcs": [[0.04, 0, 0.005]]},
        "1": {"lines": [], "arcs": [[0.2, 0.1, 0.01]]},
    },
}


def test_features_are_named_ones_first_each_place_once():
    found = in_node("return featuresOf(data);", SCENE, features="featuresOf")
    seen = [(each["kind"], each["owner"], each["point"]) for each in found]
    assert len(seen) == len({str((each, feature.get("to"), feature.get("radius"))) for each, feature in zip(seen, found, strict=True)})
    assert seen[:2] == [("point", "crank", [0.04, 0]), ("point", "rod", [0.1, 0.05])]  # no handle of a size, which is no point
    assert ("circle", "crank", [0.04, 0]) in seen and [each["to"] for each in found if each["kind"] == "line"] == [[0.04, 0]]
    assert sum(each["kind"] == "circle" for each in found) == 2  # two equal shapes of the rod are one
    assert (
        found[0]["ref"] == "crank|handle crank.A"
        and found[0]["handle"]["key"] == "crank.A"
        and {each["of"] for each in found} == {"crank", "rod"}
    )


def test_the_distance_of_a_pixel_from_a_feature():
    body = """
        const seen = (body, [x, y]) => [100 * x, 300 - 100 * y];
        return data.map(([feature, at]) => distanceTo(feature, at, seen, 100));
    """
    point, circle = {"kind": "point", "point": [1, 2]}, {"kind": "circle", "point": [1, 2], "radius": 0.5}
    line = {"kind": "line", "point": [1, 2], "to": [2, 3]}
    asked = [[point, [103, 104]], [circle, [100, 40]], [circle, [100, 97]], [line, [150, 60]], [line, [80, 130]], [line, [220, -30]]]
    found = in_node(body, asked, features="distanceTo")
    assert found[:3] == [5, 10, 3]  # a circle is its rim or its centre, whichever is nearer
    assert found[3] == pytest.approx(10 / math.sqrt(2)) and found[4:] == [None, None]  # beyond its ends it is none


MEASURING = """
    const poses = data.poses, poseOf = body => poses[body + 1];
    return data.asked.map(([kind, parts]) => valueOf(kind, parts, poseOf));
"""


def test_measured_values_are_those_of_the_places_in_the_machine():
    def point(body, *at):
        return {"kind": "point", "body": body, "point": list(at)}

    asked = [
        ["distance", [point(-1, 0, 0), point(0, 3, 4)]],
        ["horizontal", [point(-1, 1, 0), point(0, 3, 4)]],
        ["vertical", [point(-1, 1, 1), point(0, 3, 4)]],
        ["angle", [point(0, 1, 0), point(0, 0, 0), point(0, 0, 1)]],
        ["radius", [{"kind": "circle", "body": 0, "point": [0, 0], "radius": 0.7}]],
        [
            "angle",
            [{"kind": "line", "body": -1, "point": [0, 0], "to": [1, 0]}, {"kind": "line", "body": 0, "point": [5, 5], "to": [6, 5]}],
        ],
        ["distance", [point(0, 3, 4), point(1, 3, 4)]],
    ]
    found = in_node(MEASURING, {"poses": [[0, 0, 0], [0, 0, math.pi / 6], [1, -2, 0]], "asked": asked}, measures="valueOf")
    c, s = math.cos(math.pi / 6), math.sin(math.pi / 6)
    x, y = 3 * c - 4 * s, 3 * s + 4 * c
    assert found == pytest.approx([5, x - 1, y - 1, math.pi / 2, 0.7, math.pi / 6, math.hypot(x - 4, y - 2)])


def test_distances_and_angles_do_not_know_where_the_machine_stands():
    pick = random.Random(2)
    parts = [{"kind": "point", "body": n % 2, "point": [pick.uniform(-1, 1), pick.uniform(-1, 1)]} for n in range(3)]
    poses = np.array([[0, 0, 0], [0.3, -0.2, 0.4], [0.1, 0.7, -2.0]])
    turn, (c, s) = 1.1, (math.cos(1.1), math.sin(1.1))
    moved = np.column_stack([c * poses[:, 0] - s * poses[:, 1] + 5, s * poses[:, 0] + c * poses[:, 1] - 3, poses[:, 2] + turn])
    asked = [["distance", parts[:2]], ["angle", parts]]
    here, there = (in_node(MEASURING, {"poses": p.tolist(), "asked": asked}, measures="valueOf") for p in (poses, moved))
    assert there == pytest.approx(here) and 0 < here[1] < math.pi


def test_the_course_of_a_measurement_has_its_ends_and_where_they_are():
    body = """
        const u = Array.from({length: 41}, (_, n) => n / 40);
        const poseOf = (body, phase) => body < 0 ? [0, 0, 0] : [0, 0, 2 * Math.PI * phase];
        const player = {scene: {u}, poseOf};
        const crank = {kind: "point", body: 0, point: [0.04, 0]}, frame = {kind: "point", body: -1, point: [0.1, 0]};
        const own = {kind: "point", body: 0, point: [-0.02, 0.01]};
        const circle = {kind: "circle", body: 0, point: [0, 0], radius: 0.01};
        const asked = [["distance", [crank, frame]], ["distance", [crank, own]], ["radius", [circle]]];
        return asked.map(([kind, parts]) => courseOf(kind, parts, player));
    """
    moving, fixed, circle = in_node(body, None, measures="courseOf")
    assert (moving["low"], moving["high"]) == pytest.approx((0.06, 0.14)) and (moving["lowAt"], moving["highAt"]) == (0, 0.5)
    assert (circle["lowAt"], circle["highAt"]) == (0, 0)  # the first of several
    assert not moving["constant"] and fixed["constant"] and fixed["low"] == pytest.approx(math.hypot(0.06, 0.01))


def test_what_is_picked_next_and_when_a_measurement_is_complete():
    body = """
        const point = {kind: "point"}, line = {kind: "line"}, circle = {kind: "circle"};
        return [nextWanted("angle", []), nextWanted("angle", [line]), nextWanted("distance", [point]), nextWanted("radius", []),
          isComplete("angle", [line, line]), isComplete("angle", [point, point]), isComplete("angle", [point, point, point]),
          isComplete("radius", [circle]), isComplete("distance", [point]), isComplete("vertical", [point, point])];
    """
    found = in_node(body, None, measures="nextWanted, isComplete")
    assert found == [["point", "line"], ["line"], ["point"], ["circle"], True, False, True, True, False, True]


def test_measured_values_as_text():
    body = """return [textOf("angle", Math.PI / 3), textOf("distance", 0.0123456), textOf("vertical", -0.001),
        cycleText({start: 0, span: 360, unit: "°"}, 0.25), cycleText({start: 1, span: 2, unit: "s"}, 0.5),
        cycleText({start: 0, span: 0.01, unit: ""}, 0.5)];"""
    found = in_node(body, None, measures="textOf, cycleText")
    assert found == ["60.00°", "12.346\u00a0mm", "−1.000\u00a0mm", "90.0°", "2.000 s", "0.00500"]


def test_what_differs_by_the_rounding_of_poses_only_is_constant():
    """Poses come as single precision: of an angle by parts of a turn, of a length by parts of how far its bodies go."""
    body = """
        const u = Array.from({length: 41}, (_, n) => n / 40), noise = phase => data.noise * (Math.round(40 * phase) % 2 ? 1 : -1);
        const poseOf = (body, phase) => body < 0 ? [0, 0, 0] : [data.far, 0, body ? noise(phase) / data.far : 0];
        const near = (body, x, y) => ({kind: "point", body, point: [x, y]}), player = {scene: {u}, poseOf};
        const moved = (body, phase) => { const [x, y, a] = poseOf(0, phase); return [x + (body ? noise(phase) : 0), y, a]; };
        return [courseOf("angle", [near(1, 1e-3, 0), near(0, 0, 0), near(0, 0, 1e-3)], player).constant,
          courseOf("distance", [near(1, 1e-3, 0), near(0, 0, 0)], {scene: {u}, poseOf: moved}).constant];
    """
    assert in_node(body, {"far": 10, "noise": 1e-6}, measures="courseOf") == [True, True]
    assert in_node(body, {"far": 10, "noise": 1e-3}, measures="courseOf") == [False, False]


def test_a_course_as_a_panel_is_in_the_unit_that_people_read_with_air_above_and_below():
    body = """
        const course = values => ({u: [0, 0.5, 1], values, low: Math.min(...values), high: Math.max(...values)});
        return [panelOf("A", "angle", course([0.5, 1, 1.5]), "blue"), panelOf("B", "vertical", course([-0.02, 0.01, 0.03]), "green"),
          panelOf("C", "distance", course([0.02, 0.02, 0.02]), "green"), panelOf("D", "distance", course([0, 0, 0]), "green")];
    """
    angle, length, still, none = in_node(body, None, measures="panelOf")
    (line,) = angle["series"]
    assert line["unit"] == "°" and line["values"] == pytest.approx(np.rad2deg([0.5, 1, 1.5]).tolist())
    assert (angle["low"], angle["high"]) == pytest.approx(tuple(np.rad2deg([0.44, 1.56])))
    assert length["series"][0]["unit"] == "mm" and length["series"][0]["values"] == pytest.approx([-20, 10, 30])
    assert (length["low"], length["high"]) == pytest.approx((-23, 33))
    assert (still["low"], still["high"]) == pytest.approx((18.8, 21.2)) and none["low"] < 0 < none["high"]


def test_where_on_the_cycle_is_told_to_a_thousandth_of_its_span():
    body = "return data.map(span => cycleText({start: 0, span, unit: 's'}, 0.5));"
    assert in_node(body, [60, 49, 5, 0.5], measures="cycleText") == ["30.0 s", "24.50 s", "2.500 s", "0.2500 s"]


def lines_of(kind, parts, at, text="5", scale=100):
    """The elements of a dimension: [(tag, attributes, text)]."""
    body = """
        const seen = (body, [x, y]) => [100 * x, 300 - 100 * y];
        const made = dimension(data.kind, data.parts, data.at, data.text, {scale: data.scale, seen});
        return made.map(each => [each.tagName, each.attributes, each.textContent]);
    """
    return in_node(body, {"kind": kind, "parts": parts, "at": at, "text": text, "scale": scale}, measure_lines="dimension")


def ends(attributes):
    return [[float(attributes[f"{axis}{n}"]) for axis in "xy"] for n in (1, 2)]


def heads(elements):
    """Corners of the arrow heads, tips first."""
    return [[list(map(float, pair.split(","))) for pair in a["points"].split()] for tag, a, _ in elements if tag == "POLYGON"]


def test_dimension_lines_run_as_what_they_measure():
    parts, at = [{}, {}], [[100, 200], [160, 120]]
    for kind, corner, over in (("horizontal", [160, 200], [160, 205]), ("vertical", [100, 120], [95, 120]), ("distance", [160, 120], None)):
        found = lines_of(kind, parts, at)
        drawn = [ends(a) for tag, a, _ in found if tag == "LINE"]
        assert drawn[0] == [at[0], corner] and (over is None or drawn[1] == [at[1], over])
        tips = [corners[0] for corners in heads(found)]
        assert tips == [at[0], corner]
        middle = [(at[0][k] + corner[k]) / 2 for k in (0, 1)]
        ((label, text),) = [(a, text) for tag, a, text in found if tag == "TEXT"]
        assert text == "5" and [float(label["x"]), float(label["y"]) + 6] == middle
    for corners, way in zip(heads(lines_of("distance", parts, at)), (1, -1), strict=True):  # inside of the line, for there is room
        base = np.mean(corners[1:], axis=0)
        assert base == pytest.approx([corners[0][0] + way * 4.8, corners[0][1] - way * 6.4], abs=0.1) and math.dist(
            *corners[1:]
        ) == pytest.approx(6, abs=0.1)
    outside = heads(lines_of("distance", parts, [[100, 100], [120, 100]]))
    assert [np.mean(corners[1:], axis=0)[0] for corners in outside] == pytest.approx([92, 128], abs=0.1)


def test_a_radius_runs_to_its_rim_and_an_angle_has_its_arc_on_the_side_of_its_arms():
    found = lines_of("radius", [{"kind": "circle", "radius": 0.5}], [[100, 200]])
    centre, rim = ends(found[0][1])
    assert centre == [100, 200] and math.dist(centre, rim) == pytest.approx(50, abs=0.1) and rim[0] > 100 and rim[1] < 200
    assert [corners[0] for corners in heads(found)] == [rim]
    points = [{"kind": "point"}] * 3
    found = lines_of("angle", points, [[200, 200], [100, 200], [100, 100]])
    (path,) = [a["d"] for tag, a, _ in found if tag == "PATH"]
    x0, y0, radius, _, _, large, sweep, x1, y1 = map(float, re.findall(r"-?[\d.]+", path))
    assert (x0, y0, x1, y1, radius) == (134, 200, 100, 166, 34) and large == 0 and sweep == 0  # counter-clockwise, upwards on the screen
    ((label),) = [a for tag, a, _ in found if tag == "TEXT"]
    assert float(label["x"]) == pytest.approx(100 + 50 / math.sqrt(2), abs=0.1) and float(label["y"]) + 6 == pytest.approx(
        200 - 50 / math.sqrt(2), abs=0.1
    )
    assert [ends(a) for tag, a, _ in found if tag == "LINE"] == [[[200, 200], [100, 200]], [[100, 100], [100, 200]]]


def test_the_arc_between_two_lines_stands_at_the_start_of_the_first():
    lines = [{"kind": "line", "body": 0, "point": [1, 1], "to": [2, 1]}, {"kind": "line", "body": 0, "point": [3, 1], "to": [3, 0]}]
    found = lines_of("angle", lines, [[100, 200], [300, 200]])
    (path,) = [a["d"] for tag, a, _ in found if tag == "PATH"]
    x0, y0, _, _, _, _, sweep, x1, y1 = map(float, re.findall(r"-?[\d.]+", path))
    assert (x0, y0, x1, y1, sweep) == (134, 200, 100, 234, 1)  # clockwise, downwards


def test_an_angle_across_the_half_turn_is_the_small_one():
    """Arms at 170 and at -170 degrees: the arc goes through 180, and its label stands there."""
    arms = [[200 + 100 * math.cos(a), 200 - 100 * math.sin(a)] for a in map(math.radians, (170, -170))]
    found = lines_of("angle", [{"kind": "point"}] * 3, [arms[0], [200, 200], arms[1]])
    (path,) = [a["d"] for tag, a, _ in found if tag == "PATH"]
    assert path.split("A")[1].split()[3:5] == ["0", "0"]  # the short way, counter-clockwise
    (text,) = [a for tag, a, _ in found if tag == "TEXT"]
    assert [float(text["x"]), float(text["y"]) + 6] == pytest.approx([150, 200], abs=0.1)


def test_points_that_fall_together_have_no_arrow_heads_and_lines_of_an_angle_go_beyond_its_arc():
    assert heads(lines_of("distance", [{}, {}], [[100, 200], [100, 200]])) == []
    lines = [{"kind": "line", "body": 0, "point": [1, 1], "to": [2, 1]}, {"kind": "line", "body": 0, "point": [3, 1], "to": [3, 0]}]
    arms = [ends(a) for tag, a, _ in lines_of("angle", lines, [[100, 200], [300, 200]]) if tag == "LINE"]
    assert [math.dist(*arm) for arm in arms] == pytest.approx([46, 46], abs=0.1)  # 12 px beyond the 34 of the arc


# -- the motion programme ------------------------------------------------------------------------------------------------------


def harmonic(start, angle, level, rise, law="cycloidal", points=(), absolute=False):
    """A packed segment of simple harmonic motion."""
    x = np.linspace(0, 1, 61)
    course = [
        angle * x,
        level + rise * (1 - np.cos(np.pi * x)) / 2,
        rise * np.pi / 2 * np.sin(np.pi * x) / angle,
        rise * np.pi**2 / 2 * np.cos(np.pi * x) / angle**2,
        -rise * np.pi**3 / 2 * np.sin(np.pi * x) / angle**3,
    ]
    own = {"law": law, "angle": angle, "rise": rise, "start": start, "end": start + angle, "from": level, "to": level + rise}
    return {**own, "absolute": absolute, "points": list(points), "course": [packed(row) for row in course]}


PROGRAMME = {
    "cycle": {"span": 2 * math.pi, "factor": 180 / math.pi, "unit": "°"},
    "lift": {"factor": 1e3, "unit": "mm"},
    "list": "programme",
    "keys": {"angle": "angle", "rise": "rise", "law": "law", "points": "points"},
    "lawKeys": ["points", "b"],
    "dwell": "dwell",
    "laws": [
        {"name": "dwell", "parameters": {}},
        {"name": "spline", "parameters": {"points": "[[0, 0], [1, 1]]"}},
        {"name": "cycloidal", "parameters": {}},
    ],
    "segments": [
        harmonic(0, math.pi / 2, 0.0, 0.02),
        harmonic(math.pi / 2, math.pi / 2, 0.02, 0.0, "dwell"),
        harmonic(math.pi, math.pi / 2, 0.02, -0.015),
        harmonic(1.5 * math.pi, math.pi / 2, 0.005, -0.005),
    ],
}


def stretched(angles, rises):
    body = """
        const made = stretched(unpacked(data.programme), data.angles, data.rises);
        return made.segments.map(each => ({...each, course: each.course.map(row => [...row])}));
    """
    return in_node(body, {"programme": PROGRAMME, "angles": angles, "rises": rises}, motion_segments="stretched, unpacked")


def test_a_stretched_programme_joins_and_its_rates_are_the_derivatives_of_its_lift():
    angles, rises = [1.0, 2.0, 1.5, 2 * math.pi - 4.5], [0.03, 0.0, -0.02, -0.01]
    found = stretched(angles, rises)
    ends_ = [(segment["start"], segment["end"], segment["from"], segment["to"]) for segment in found]
    assert [end - start for start, end, _, _ in ends_] == pytest.approx(angles)
    assert [to - level for _, _, level, to in ends_] == pytest.approx(rises, abs=1e-8)
    for (_, end, _, level), (start, _, to, _) in zip(ends_, ends_[1:], strict=False):
        assert start == pytest.approx(end) and to == pytest.approx(level, abs=1e-8)
    for segment in found:
        theta, *rows = map(np.array, segment["course"])
        assert theta[0] == pytest.approx(segment["start"], abs=1e-6) and theta[-1] == pytest.approx(segment["end"], abs=1e-6)
        for lower, upper in zip(rows, rows[1:], strict=False):
            steps = np.diff(lower) / np.diff(theta)
            assert np.allclose(steps, (upper[1:] + upper[:-1]) / 2, atol=2e-3 * max(abs(upper).max(), 1e-9) + 2e-6)


def test_a_table_of_lifts_is_not_stretched_in_height():
    table = {**PROGRAMME, "segments": [harmonic(0, math.pi, 0.005, 0.01, absolute=True), harmonic(math.pi, math.pi, 0.015, -0.01)]}
    body = "return stretched(unpacked(data), [2, 2 * Math.PI - 2], [0.9, -0.02]).segments.map(({from, to}) => [from, to]);"
    (low, high), (level, end) = in_node(body, table, motion_segments="stretched, unpacked")
    assert (low, high, level) == pytest.approx((0.005, 0.015, 0.015)) and end == pytest.approx(-0.005)


def jumps_of(programme):
    """{jumps, peaks} of a programme as it is, peaks without end as -1."""
    body = """
        const packed = unpacked(data), own = name => packed.segments.map(segment => segment[name]);
        const made = stretched(packed, own("angle"), own("rise")), jumps = jumpsOf(made);
        return {jumps, peaks: peaksOf(made, jumps).map(peak => peak === Infinity ? -1 : peak)};
    """
    return in_node(body, programme, motion_segments="jumpsOf, peaksOf, stretched, unpacked")


def test_jumps_and_peaks_of_a_programme():
    found = jumps_of(PROGRAMME)
    at = sorted(jump["at"] for jump in found["jumps"])
    assert at == pytest.approx([0, math.pi / 2, math.pi, 1.5 * math.pi], abs=1e-6) and {jump["order"] for jump in found["jumps"]} == {2}
    lift, velocity, acceleration, jerk = found["peaks"]
    assert lift == pytest.approx(0.02) and velocity == pytest.approx(0.02) and acceleration == pytest.approx(0.04) and jerk == -1
    smooth = {**PROGRAMME, "segments": [harmonic(0, math.pi, 0.1, 0.02), harmonic(math.pi, math.pi, 0.12, -0.02)]}
    found = jumps_of(smooth)  # one harmonic: nothing jumps
    assert found["jumps"] == [] and found["peaks"] == pytest.approx([0.02, 0.01, 0.01, 0.01], rel=1e-4)


def test_a_jump_of_the_velocity_counts_before_one_of_the_acceleration():
    ramp = {**PROGRAMME, "segments": [harmonic(0, math.pi, 0, 0.02), harmonic(math.pi, math.pi, 0.02, -0.02)]}
    theta = np.linspace(0, math.pi, 61)
    zero = packed(np.zeros(61))
    ramp["segments"][0]["course"] = [packed(theta), packed(0.02 * theta / math.pi), packed(np.full(61, 0.02 / math.pi)), zero, zero]
    found = jumps_of(ramp)
    assert {jump["order"] for jump in found["jumps"]} == {1} and found["peaks"][2:] == [-1, -1] and found["peaks"][1] > 0


def test_two_jumps_at_one_place_are_one():
    step = {**PROGRAMME, "segments": [harmonic(0, math.pi, 0, 0.02), harmonic(math.pi, math.pi, 0.02, -0.02)]}
    rows = [np.array(struct.unpack("<61f", base64.b64decode(row))) for row in step["segments"][1]["course"]]
    rows = [np.concatenate([row[:1], row]) for row in rows]
    rows[3][0] += 0.01  # the acceleration jumps there and back at the border
    step["segments"][1]["course"] = [packed(row) for row in rows]
    (jump,) = jumps_of(step)["jumps"]
    assert jump["order"] == 2 and jump["at"] == pytest.approx(math.pi)


def test_a_programme_begins_at_its_own_level_and_a_table_stays_at_its_lifts():
    """Whatever a segment before it is stretched to."""
    table = {**PROGRAMME, "segments": [harmonic(0, math.pi, 0.005, 0.01), harmonic(math.pi, math.pi, 0.015, -0.01, absolute=True)]}
    body = "return stretched(unpacked(data), [Math.PI, Math.PI], [0.02, 0]).segments.map(({from, to}) => [from, to]);"
    first, second = in_node(body, table, motion_segments="stretched, unpacked")
    assert first == pytest.approx([0.005, 0.025]) and second == pytest.approx([0.015, 0.005])


@pytest.mark.parametrize(("part", "orders"), [(1e-2, {2}), (1e-6, set())])
def test_a_jump_of_a_hundredth_counts_and_rounding_does_not(part, orders):
    made = {**PROGRAMME, "segments": [harmonic(0, math.pi, 0.1, 0.02), harmonic(math.pi, math.pi, 0.12, -0.02)]}
    rows = [np.array(struct.unpack("<61f", base64.b64decode(row))) for row in made["segments"][1]["course"]]
    rows[3][0] += part * 0.01  # of the largest acceleration
    made["segments"][1]["course"] = [packed(row) for row in rows]
    assert {jump["order"] for jump in jumps_of(made)["jumps"]} == orders


def test_a_segment_can_be_halved_down_to_a_degree():
    body = (
        TEXTS
        + """
        const wide = angle => ({...programme, segments: [{...programme.segments[0], angle: angle * Math.PI / 180}]});
        return data.angles.map(angle => withDwell(wide(angle), 0, texts) !== null);
    """
    )
    found = in_node(body, {**PROGRAMME, "angles": [1.9, 2.1, 10]}, motion_segments="withDwell")
    assert found == [False, True, True]


def segments(*rises, absolute=()):
    return [{"rise": rise, "angle": 1.0, "absolute": n in absolute, "from": 0, "to": rise, "points": []} for n, rise in enumerate(rises)]


def test_what_can_move_in_a_programme():
    asked = [segments(20, 0, -15, -5), segments(20, 0, -20, absolute=[1]), segments(0, 20, -20), segments(5, 1e-12, -5)]
    body = """return data.map(each => ({borders: each.map((_, n) => borderMoves(each, n)), partners: each.map((_, n) => partnerOf(each, n)),
        takers: each.map((_, n) => taker(each, n, 15))}));"""
    first, table, dwell, noise = in_node(body, asked, motion_segments="borderMoves, partnerOf, taker")
    assert first["borders"] == [False, True, True, True] and first["partners"] == [2, -1, 3, -1]
    assert first["takers"] == [3, 3, 3, 0]  # not the one that would stand still with it
    assert table["borders"] == [False, False, False] and table["partners"] == [-1, -1, -1]
    assert dwell["partners"] == [-1, 2, -1] and noise["partners"] == [2, -1, -1]


TEXTS = """
    const texts = {rise: (value, n) => `${+value.toFixed(9)} m`, half: n => ["a", "b"], sum: (n, m) => `${n}+${m}`};
    const programme = {...data, segments: data.segments};
"""


def rises_after(elements, before):
    """The rises of a list of elements, those that nothing is told about as they were."""
    told = [(each["of"], each["changes"].get("rise")) for each in elements]
    return [before[of] if text is None else float(text.split()[0]) if text else 0.0 for of, text in told]


def test_other_lists_of_segments_close_the_turn():
    rises = [each["rise"] for each in PROGRAMME["segments"]]
    body = (
        TEXTS
        + """
        return {law: withLaw(programme, 1, "spline", texts), still: withLaw(programme, 0, "dwell", texts),
          half: withDwell(programme, 2, texts),
          first: without(programme, 0, texts), last: without(programme, 3, texts), dwell: without(programme, 1, texts),
          none: withLaw(programme, 1, "nonsense", texts)};
        """
    )
    found = in_node(body, PROGRAMME, motion_segments="withLaw, withDwell, without")
    assert found["none"] is None
    for name in ("law", "still", "half", "first", "last", "dwell"):
        assert sum(rises_after(found[name], rises)) == pytest.approx(0 if name != "half" else sum(rises), abs=1e-9), name
    assert [each["of"] for each in found["first"]] == [1, 2, 3] and found["first"][0]["changes"]["angle"] == "1+0"
    assert [each["of"] for each in found["last"]] == [0, 1, 2] and found["last"][2]["changes"]["angle"] == "2+3"
    assert [each["of"] for each in found["half"]] == [0, 1, 2, 2, 3]
    assert found["half"][2]["changes"] == {"angle": "a"} and found["half"][3]["changes"] == {
        "points": "",
        "b": "",
        "angle": "b",
        "law": "dwell",
        "rise": "",
    }
    assert found["law"][1]["changes"]["points"] == "[[0, 0], [1, 1]]" and rises_after(found["law"], rises)[1] == pytest.approx(0.005)
    assert found["still"][0]["changes"]["rise"] == "" and rises_after(found["still"], rises)[0] == 0


def test_lists_that_cannot_be_are_none():
    body = (
        TEXTS
        + """
        const [one] = programme.segments, only = {...programme, segments: [one]};
        const narrow = {...programme, segments: [{...one, angle: 0.03}]};
        const table = {...programme, segments: programme.segments.map((each, n) => ({...each, absolute: n === 0}))};
        return [without(only, 0, texts), withDwell(narrow, 0, texts), without(table, 0, texts), without(table, 1, texts),
          withLaw(table, 0, "spline", texts), withDwell(table, 0, texts)];
    """
    )
    assert in_node(body, PROGRAMME, motion_segments="withLaw, withDwell, without") == [None] * 6


# -- lengths, numbers, costs ---------------------------------------------------------------------------------------------------


def test_units_of_handles_are_those_of_the_specs():
    factors = in_node("return FACTORS;", None, handles="FACTORS")
    for unit in ("m", "mm", "cm", "um", "in", "rad", "deg"):
        assert factors[unit] == pytest.approx(float(exact_factor(unit))), unit


def test_the_numbers_of_a_handle():
    body = """
        const fields = new Map(Object.entries(data));
        return [numbersOf({key: "p"}, fields), numbersOf({key: "n", direction: [1, 0]}, fields),
          numbersOf({key: "q"}, fields), numbersOf({key: "w", direction: [1, 0]}, fields)];
    """
    data = {
        "p.0": {"unit": "mm", "value": 3, "kind": "quantity"},
        "p.1": {"unit": "m", "value": 1, "kind": "quantity"},
        "n": {"unit": "", "value": 5, "kind": "integer", "low": 2, "high": 9},
        "q.0": {"unit": "mm", "value": 3},
        "w": {"unit": "kg", "value": 1},
    }
    point, whole, half, weight = in_node(body, data, handles="numbersOf")
    assert [(each["key"], each["factor"], each["value"]) for each in point] == [("p.0", 1e-3, 3), ("p.1", 1, 1)]
    assert (
        whole == [{"key": "n", "unit": "", "factor": 1, "value": 5, "whole": True, "low": 2, "high": 9}] and half is None and weight is None
    )


def test_typed_quantities():
    texts = ["45 mm", "-3.5e-2 m", "−3 mm", "+.5", "12", "11 mm", "a5 mm", "/5", "mm", "", "5,5 mm", ",5"]
    found = in_node("return data.map(quantityOf);", texts, numbers="quantityOf")
    assert found == [[45, "mm"], [-0.035, "m"], [-3, "mm"], [0.5, ""], [12, ""], [11, "mm"], None, None, None, None, [5, ",5 mm"], None]


def test_a_quantity_too_long_for_its_box_is_shown_to_six_digits():
    pairs = {
        "36.62853743027 mm": "36.6285 mm",
        "-0.000123456789 kg": "-0.000123457 kg",
        "12345678.8912": "12345700",
        "0.1 mm": "0.1 mm",
        "123.4567 mm": "123.4567 mm",
        "1e-5 kg m^2 and more": "1e-5 kg m^2 and more",
        "a name that is long": "a name that is long",
    }
    assert in_node("return data.map(text => shortened(text, 12));", list(pairs), numbers="shortened") == list(pairs.values())


STORE = """
    const store = {state: {design: {opened: 1}, result: {timings: data.timings, needs: data.needs, sources: data.sources}}};
    learn(store);
"""


def test_the_time_of_a_search_is_that_of_the_analyses_it_wants():
    data = {
        "timings": {"kinematics": 0.2, "statics": 0.5, "fatigue": 3.0},
        "needs": {"fatigue": ["fatigue", "statics"], "statics": ["statics"]},
        "sources": {"life": "fatigue", "force": "statics", "angle": "kinematics"},
    }
    body = (
        STORE
        + """
        const first = [secondsOf(store), secondsOf(store, ["life"]), secondsOf(store, ["life", "force"]), secondsOf(store, ["unknown"])];
        store.state = {...store.state, result: {...store.state.result, timings: {statics: 0.9, fatigue: 1}}};
        learn(store);
        const shorter = secondsOf(store);
        store.state = {...store.state, design: {opened: 2}};
        learn(store);
        return [...first, shorter, secondsOf(store)];
    """
    )
    found = in_node(body, data, costs="learn, secondsOf")
    assert found[:3] == pytest.approx([3.7, 3.5, 3.5]) and found[3] is None
    assert found[4] == pytest.approx(1.7) and found[5] == pytest.approx(1.9)  # the shortest of each; of another drive only what it took


def test_designs_of_a_search_are_those_that_it_tries():
    searches = [(unknowns, several, population, 7) for unknowns in (1, 2, 3, 5) for several in (0, 1) for population in (None, 9, 33)]
    body = """return data.map(([unknowns, several, population, generations]) => {
        const size = members(unknowns, several, population);
        return [designsOf(generations, size, several), generationsFor(designsOf(generations, size, several), size, several)];
    });"""
    found = in_node(body, searches, costs="members, designsOf, generationsFor")
    for (unknowns, several, population, generations), (designs, back) in zip(searches, found, strict=True):
        unknown = [{"key": f"a{n}", "lower": 1, "upper": 2} for n in range(unknowns)]
        goals = [{"value": f"x{n}", "goal": "minimise"} for n in range(1 + several)]
        search = Optimise(unknowns=unknown, objectives=goals, population=population, generations=generations)
        assert designs == most_evaluations(search), (unknowns, several, population)
        assert back == generations


def test_durations_as_people_say_them():
    found = in_node("return data.map(seconds => durationText(seconds, t));", [0.2, 1, 89, 240, 5399, 9000], costs="durationText")
    assert found == ["less than 1 s", "1 s", "89 s", "4 min", "90 min", "2.5 h"]


# -- pictures and files --------------------------------------------------------------------------------------------------------

WIDE, HIGH, LEFT, RIGHT, TOP, BOTTOM = 268, 158, 46, 8, 8, 34


def history(steps, total=0):
    """(attributes of the line, texts, caption) of the course of a search."""
    body = """
        const made = historyPlot(data.steps, {label: "mass", unit: "kg"}, t, data.total), parts = made.all();
        const texts = parts.filter(({tagName}) => tagName === "TEXT").map(part => [part.attributes, part.textContent]);
        return [parts.find(({attributes}) => attributes.class === "hp-line").attributes.d, texts, made.children[0].textContent];
    """
    return in_node(body, {"steps": steps, "total": total}, history_plot="historyPlot")


def test_the_course_of_a_search_is_a_stair_down_to_its_best():
    d, texts, caption = history([[10, 5.0, 0], [20, 3.0, 0], [40, 2.0, 0]], 80)
    numbers = [float(each) for each in re.findall(r"-?[\d.]+", d)]
    assert re.sub(r"[\d. -]", "", d) == "MHVHVH" and caption == "mass [kg]"
    x = [LEFT + n / 80 * (WIDE - LEFT - RIGHT) for n in (10, 20, 40)]
    assert [numbers[0], numbers[2], numbers[4], numbers[6]] == pytest.approx([x[0], x[1], x[2], x[2]], abs=0.06)
    first, second, third = numbers[1], numbers[3], numbers[5]
    assert TOP < first < second < third < HIGH - BOTTOM  # values fall, pixels grow
    assert (second - first) / (third - second) == pytest.approx(2, abs=0.01)
    for attributes, text in texts:
        if attributes["class"] == "hp-up":
            value = float(text)
            assert float(attributes["y"]) == pytest.approx(first + (5 - value) / 3 * (third - first), abs=0.1)


def test_before_a_design_meets_the_requirements_the_course_is_that_of_the_violation():
    _, _, caption = history([[10, None, 4.0], [20, None, 1.0]])
    assert caption == "violation of the requirements"
    d, _, _ = history([[10, None, 4.0], [20, 7.0, 0.0], [30, 6.0, 0.0]])
    numbers = [float(each) for each in re.findall(r"-?[\d.]+", d)]
    assert numbers[0] == pytest.approx(LEFT + 20 / 30 * (WIDE - LEFT - RIGHT), abs=0.06)  # begins with the first design that does


PANEL = {
    "title": 'Force <b> & "torque"',
    "style": "line",
    "low": 0,
    "high": 10,
    "log": False,
    "shade": [],
    "limits": [],
    "u": packed([0, 0.5, 1]),
    "series": [
        {"label": "force", "unit": "N", "role": "blue", "data": packed([0, 10, 5]), "ends": [packed([-1, 9, 4]), packed([1, 11, 6])]},
        {"label": "=1+1", "unit": "", "role": "orange", "x": packed([0.25, 0.75]), "data": packed([1, math.nan])},
    ],
}
CYCLE = {"label": "crank angle", "unit": "°", "start": 30, "span": 360, "marks": []}
RUN = {"name": 'first, "kept"', "colour": "run-1", "dash": [7, 3], "lines": [{"u": [0, 1], "values": [2, 4], "low": 2, "high": 12}, None]}


def plot_file(function):
    body = (
        f"const panel = unpacked(data.panel); return {function}({{panel, axis: axisOf(panel, data.cycle), behind: [data.run]}}, 'A <i>');"
    )
    stub = "document.createElement = tag => ({getContext: () => ({measureText: () => ({width: 40})})});"
    return in_node(stub + body, {"panel": PANEL, "cycle": CYCLE, "run": RUN}, plotting="unpacked, axisOf", plotfiles="csvText, svgText")


def test_a_plot_as_csv_has_every_line_with_its_places_and_units():
    head, *rows = csv.reader(io.StringIO(plot_file("csvText")))
    assert head[:4] == ["crank angle [°]", "force [N]", "force, low [N]", "force, high [N]"]
    assert head[4:] == ["crank angle, =1+1 [°]", "=1+1", 'crank angle · first, "kept" [°]', 'force · first, "kept" [N]']
    assert [row[:4] for row in rows] == [["30", "0", "-1", "1"], ["210", "10", "9", "11"], ["390", "5", "4", "6"]]
    assert [row[4:] for row in rows] == [["120", "1", "30", "2"], ["300", "", "390", "4"], ["", "", "", ""]]


def test_a_plot_as_svg_is_well_formed_whatever_its_texts_are():
    root = ElementTree.fromstring(plot_file("svgText"))
    space = "{http://www.w3.org/2000/svg}"
    texts = [each.text for each in root.iter(f"{space}text")]
    assert root.find(f"{space}title").text == PANEL["title"] == texts[0] and "A <i>" in texts
    assert {"force [N]", "=1+1", 'first, "kept"'} <= set(texts) and not list(root.iter(f"{space}b"))


# -- the assembly in motion ----------------------------------------------------------------------------------------------------


def test_a_part_stands_between_its_frames_and_its_matrix_moves_it_so():
    body = """
        const moving = unpackMotion(data);
        const at = displacementAt(moving, moving.motions[0], 0.375);
        return [[...at], [...matrixOf(at, [1, 2, 3])], unpackMotion({motions: [], u: ""})];
    """
    motion = [0, 0, 0, 1, 2, 1, 3, 3, 2]
    at, matrix, still = in_node(
        body, {"u": packed([0, 0.25, 0.5]), "motions": [packed(motion)]}, assembly="unpackMotion, displacementAt, matrixOf"
    )
    assert at == pytest.approx([2, 2.5, 1.5]) and still is None
    point = np.reshape(matrix, (4, 4)).T @ [0.3, -0.2, 0.7, 1]
    c, s = math.cos(1.5), math.sin(1.5)
    assert point[:3] == pytest.approx([2 + 1 + 0.3 * c + 0.2 * s, 2.5 + 2 + 0.3 * s - 0.2 * c, 3.7], abs=1e-6)


def test_parts_are_pulled_away_from_the_middle_and_further_apart_along_the_axis():
    whole = {"low": [-1, -1, 0], "high": [1, 1, 0.2], "centre": [0, 0, 0.1], "size": 2.8}
    parts = [{"points": [0.4, 0, 0, 0.6, 0, 0.04]}, {"points": [-1, -1, 0.18, 1, 1, 0.2]}]
    near, high = in_node("return pullsOf(data.parts, null, data.whole);", {"parts": parts, "whole": whole}, assembly="pullsOf")
    assert near == pytest.approx([0.45, 0, 0.9 * (0.02 - 0.1) * 0.5 * 2.8 / 0.2]) and high == pytest.approx([0, 0, 0.9 * 0.09 * 7])


def test_the_view_holds_an_assembly_over_its_whole_cycle():
    whole = {"low": [0, 0, 0], "high": [1, 1, 1], "centre": [0.5, 0.5, 0.5], "size": 1.7}
    frames = np.linspace(0, 1, 49)
    motion = np.column_stack([0 * frames, 0 * frames, 2 * np.pi * frames]).ravel().tolist()
    data = {"u": packed(frames), "motions": [packed(motion)], "parts": [{"points": [0, 0, 0, 2, 0, 1], "motion": 0}], "whole": whole}
    body = "const moving = unpackMotion(data); return [reachOf(data.parts, moving, data.whole), reachOf(data.parts, null, data.whole)];"
    found, still = in_node(body, data, assembly="reachOf, unpackMotion")
    quarter = np.column_stack([0 * frames, 0 * frames, np.pi / 2 * frames]).ravel().tolist()
    bar = {
        **data,
        "motions": [packed(quarter)],
        "parts": [{"points": [0, 1, 0, 2, 1, 1], "motion": 0}],
        "whole": {**whole, "high": [1, 1, 1]},
    }
    turned, _ = in_node(body, bar, assembly="reachOf, unpackMotion")
    assert turned["low"] == pytest.approx([-1, 0, 0], abs=0.02) and turned["high"] == pytest.approx([2, math.sqrt(5), 1], abs=0.02)
    assert found["low"] == pytest.approx([-2, -2, 0], abs=0.02) and found["high"] == pytest.approx([2, 2, 1], abs=0.02)
    assert (
        found["centre"] == pytest.approx([0, 0, 0.5], abs=0.02)
        and found["size"] == pytest.approx(math.sqrt(33), rel=1e-2)
        and still == whole
    )


def test_the_cube_turns_with_the_view():
    """A point of the cube, with y downwards as on the page, is seen at its components right, up and towards the eye."""
    body = """
        const {node, turn} = createCube(() => {}, t);
        turn(data);
        return node.all().find(part => part.classList.has("so-cube")).style.transform;
    """
    a, b = 0.4, 0.7
    right, eye = np.array([math.cos(a), math.sin(a), 0]), np.array([math.sin(a) * math.cos(b), -math.cos(a) * math.cos(b), math.sin(b)])
    up = np.cross(eye, right)
    text = in_node(body, [right.tolist(), up.tolist(), eye.tolist()], cube="createCube")
    matrix = np.reshape([float(each) for each in text[9:-1].split(",")], (4, 4)).T[:3, :3]
    flip = np.diag([1, -1, 1])
    assert np.allclose(flip @ matrix @ flip, [right, up, eye], atol=1e-4)


# -- axes ----------------------------------------------------------------------------------------------------------------------


def test_ticks_are_round_inside_their_range_and_about_as_many_as_asked():
    asked = [[0, 10, 5, "mm"], [-3.2, 7.9, 4, "N"], [0, 360, 5, "°"], [0, 0.013, 6, "m"], [1e5, 1.2e5, 3, ""], [0, 45, 4, "°"]]
    found = in_node("return data.map(each => ticks(...each));", asked, plotting="ticks")
    for (low, high, count, unit), made in zip(asked, found, strict=True):
        values, steps = made["values"], np.diff(made["values"])
        assert low - 1e-9 <= values[0] and values[-1] <= high + 1e-9 and count / 2.6 <= len(values) <= 2.2 * count + 1
        assert np.allclose(steps, steps[0]) and all(float(f"{value:.{made['decimals']}f}") == pytest.approx(value) for value in values)
        step = steps[0] if unit != "°" or high < 60 else steps[0] / 90
        assert f"{step:e}"[0] in "125"
    assert found[2]["values"] == [0, 90, 180, 270, 360]


def test_a_value_of_a_line_is_that_between_its_points_and_none_beyond_them():
    body = "const u = [0, 1, 3], v = [0, 10, 30]; return [0, 0.5, 2, 3, 3.002, 3.1, -0.1].map(at => valueAt(u, v, at));"
    found = in_node(body, None, plotting="valueAt")
    assert found[:5] == pytest.approx([0, 5, 20, 30, 30]) and found[5:] == [None, None]
    body = """return [nearest([0, 1, 3], [1, NaN, 2], 1.2), nearest([0, 1, 3], [NaN, NaN, NaN], 1),
        isRising([0, 1, 1, 2]), isRising([0, 2, 1])];"""
    assert in_node(body, None, plotting="nearest, isRising") == [0, -1, True, False]


def test_places_and_values_of_a_panel_go_to_pixels_and_back():
    body = """
        const panel = {...data.panel, low: 1, high: 100}, axis = {from: 0, to: 2, start: 0, scale: 1};
        const size = {width: 200, height: 100, margin: {left: 20, right: 10, top: 5, bottom: 15}};
        const plain = layout(panel, axis, [{lines: [{low: -3, high: 5, from: -1, to: 1}, null]}], size);
        const log = layout({...panel, log: true}, axis, [], size), equal = layout({...panel, equal: true}, axis, [], size);
        return [[plain.toX(-1), plain.toX(2), plain.placeAt(plain.toX(1.3)), plain.toY(-3), plain.toY(100)],
          [log.toY(1), log.toY(10), log.toY(100)], [equal.toX(1) - equal.toX(0), equal.toY(0) - equal.toY(1)],
          [equal.toX(0), equal.toX(2), equal.toY(1), equal.toY(100)]];
    """
    plain, log, (across, up), inside = in_node(body, {"panel": PANEL}, plotting="layout")
    assert plain == pytest.approx([20, 190, 1.3, 85, 5]) and log == pytest.approx([85, 45, 5]) and across == pytest.approx(up)
    assert 20 <= inside[0] < inside[1] <= 190 and inside[2:] == pytest.approx([85, 5])  # all of it, as large as it can be


def test_a_point_that_no_line_joins_is_a_dot():
    body = """
        const values = data.values.map(each => each ?? NaN), u = [0, 1, 2, 3, 4, 5];
        const panel = {...data.panel, series: [{values, role: "blue", ends: []}], u};
        const axis = {from: 0, to: 5, start: 0, scale: 1}, margin = {left: 0, right: 0, top: 0, bottom: 0};
        const at = layout(panel, axis, [], {width: 50, height: 100, margin});
        const pen = new Part("canvas").getContext();
        paintPanel(pen, panel, {...axis, marks: [], labels: [], places: []}, [], at, {}, {foot: false, named: false});
        return pen.calls.filter(([name]) => name === "arc").map(([, x, y]) => [x, y]);
    """
    values = [4, None, 1, 2, None, 7]
    dots = in_node(body, {"panel": {**PANEL, "u": [], "series": []}, "values": values}, plotting="layout, paintPanel")
    assert dots == [[0, 60], [50, 30]]


def test_names_along_the_axis_stay_inside_and_do_not_lie_over_one_another():
    """Six pixels a letter: the last one ends before its line; one that would begin within the one before is left out."""
    body = """
        const margin = {left: 0, right: 0, top: 0, bottom: 0}, series = [{values: [], role: "blue", ends: [], unit: ""}];
        const axis = {from: 0, to: 10, start: 0, scale: 1, marks: [], labels: [], places: data.places};
        const panel = {...data.panel, series, u: []};
        const at = layout(panel, axis, [], {width: 100, height: 50, margin}), pen = new Part("canvas").getContext();
        const names = data.places.map(([, name]) => name);
        paintPanel(pen, panel, axis, [], at, {}, {foot: false});
        return pen.calls.filter(([name, text]) => name === "fillText" && names.includes(text)).map(([, text, x]) => [text, x]);
    """
    told = in_node(body, {"panel": PANEL, "places": [[1, "first"], [3, "hidden"], [9, "last"]]}, plotting="layout, paintPanel")
    assert told == [["first", 13], ["last", 63]]


def test_a_panel_in_another_language_has_its_axis_with_all_names_in_it():
    body = """
        const words = {speed: "zh speed", "operating speed": "zh operating", first: "zh first", force: "zh force",
          "limit 3 N": "zh limit", T: "zh T"};
        return translated(data, text => words[text] ?? text);
    """
    axis = {"label": "speed", "unit": "rpm", "names": ["first", "m1"], "places": [[4000, "operating speed"], [1, "m1"]]}
    panel = {"title": "T", "axis": axis, "series": [{"label": "force", "unit": "N"}], "limits": [[3, "limit 3 N"]]}
    assert in_node(body, panel, overlays="translated") == {
        "title": "zh T",
        "axis": {"label": "zh speed", "unit": "rpm", "names": ["zh first", "m1"], "places": [[4000, "zh operating"], [1, "m1"]]},
        "series": [{"label": "zh force", "unit": "N"}],
        "limits": [[3, "zh limit"]],
    }
