"""Points of a motion programme, and segments whose keys are no list, as the page moves them; in node."""

import json
import math

import pytest
from in_node import in_node

pytestmark = pytest.mark.interface
DEGREE = math.pi / 180

# -- points as plain data ------------------------------------------------------------------------------------------------------

SPLINE = "[[0, 0], [0.25, 0.1], [0.75, 0.9], [1, 1]]"
ROWS = '[["0 deg", "0 mm"], ["60 deg", "5 mm"], ["120 deg", "0.8 cm"], ["360 deg", "0 mm"]]'


def on_points(body, text=SPLINE, kind="spline", closed=False):
    """What `body` makes of a segment from 90 to 180 degrees, or over the whole turn, with these points."""
    given = """
        const [start, end] = data.kind === "spline" ? [Math.PI / 2, Math.PI] : [0, 2 * Math.PI];
        const segment = {start, end, from: 0.01, rise: 0.02};
        segment.angle = segment.end - segment.start;
        segment.nodes = {...readPoints(data.text, data.kind), key: "points", closed: data.closed};
    """
    names = (
        "readPoints, rowsText, placeOf, pointAt, pointMoves, movedPoint, addedPoint, withoutPoint, liftAt, seenPoints, partText, typedPart"
    )
    return in_node(given + body, {"text": text, "kind": kind, "closed": closed}, motion_points=names)


def test_points_are_read_with_their_units_and_nothing_else_is():
    assert on_points("return segment.nodes.at;") == [[0, 0], [0.25, 0.1], [0.75, 0.9], [1, 1]]
    rows = on_points("return segment.nodes.at;", ROWS, "table")
    assert [row for pair in rows for row in pair] == pytest.approx([0, 0, math.pi / 3, 0.005, 2 * math.pi / 3, 0.008, 2 * math.pi, 0])
    odd = ("", "[", "[1, 2]", "[[1]]", "[[0, 0, 0]]", '[["0 deg", "0 mm"]]', "[[0, null]]", "{}")
    assert in_node("return data.map(text => readPoints(text, 'spline'));", odd, motion_points="readPoints") == [None] * len(odd)
    odd = ("[[0, 0]]", '[["0 kg", "0 mm"]]', '[["0", "0"]]', "[[[], {}]]")
    assert in_node("return data.map(text => readPoints(text, 'table'));", odd, motion_points="readPoints") == [None] * len(odd)


def test_a_point_is_where_it_is_drawn():
    body = "const [angle, lift] = placeOf(segment, 2); return [angle, lift, ...pointAt(segment, angle, lift)];"
    assert on_points(body) == pytest.approx([math.pi / 2 * 1.75, 0.028, 0.75, 0.9])
    assert on_points(body, ROWS, "table") == pytest.approx([2 * math.pi / 3, 0.008, 2 * math.pi / 3, 0.008])


def test_a_moved_point_keeps_its_unit_and_the_others_their_text():
    body = "return JSON.parse(movedPoint(segment, 2, [90 * Math.PI / 180, 0.0061]));"
    assert on_points(body, ROWS, "table") == [["0 deg", "0 mm"], ["60 deg", "5 mm"], ["90 deg", "0.61 cm"], ["360 deg", "0 mm"]]
    assert json.loads(on_points("return movedPoint(segment, 1, [-3, 2]);")) == [[0, 0], [0.01, 2], [0.75, 0.9], [1, 1]]
    assert json.loads(on_points("return movedPoint(segment, 1, [3, 2]);"))[1] == [0.74, 2]


def test_the_ends_of_a_table_over_the_turn_move_together_and_only_up():
    moves = "return [0, 1, 2, 3].map(k => pointMoves(segment, k));"
    assert on_points(moves) == [False, True, True, False] == on_points(moves, ROWS, "table")
    assert on_points(moves, ROWS, "table", closed=True) == [True] * 4
    found = json.loads(on_points("return movedPoint(segment, 3, [1, 0.002]);", ROWS, "table", closed=True))
    assert found[0] == ["0 deg", "2 mm"] and found[3] == ["360 deg", "2 mm"] and found[1:3] == json.loads(ROWS)[1:3]


def test_points_are_added_between_others_and_removed_but_for_the_ends():
    added = on_points("return addedPoint(segment, [0.5, 0.45]);")
    assert added["k"] == 2 and json.loads(added["text"]) == [[0, 0], [0.25, 0.1], [0.5, 0.45], [0.75, 0.9], [1, 1]]
    assert on_points("return [0.255, 0.745, -0.1, 1, 1.5].map(u => addedPoint(segment, [u, 0]));") == [None] * 5
    row = on_points("return addedPoint(segment, [Math.PI / 2, 0.007]);", ROWS, "table")
    assert json.loads(row["text"])[2] == ["90 deg", "0.7 cm"]
    assert json.loads(on_points("return withoutPoint(segment, 1);")) == [[0, 0], [0.75, 0.9], [1, 1]]
    assert on_points("return [0, 3].map(k => withoutPoint(segment, k));") == [None, None]
    assert on_points("return withoutPoint(segment, 1);", "[[0, 0], [0.5, 0.5], [1, 1]]") is None  # three are the fewest
    still = "segment.nodes.still = true; return [addedPoint(segment, [0.5, 0.5]), withoutPoint(segment, 1), pointMoves(segment, 1)];"
    assert on_points(still) == [None, None, False]


def test_rows_of_a_file_become_the_text_of_a_spec():
    rows = [[0, 0], [10 * DEGREE, 0.0012345], [130 * DEGREE, 0.1 + 0.2]]
    made = in_node("return [rowsText(data, false), rowsText(data, true)];", rows, motion_points="rowsText")
    assert json.loads(made[0]) == [["0 deg", "0 mm"], ["10 deg", "1.2345 mm"], ["130 deg", "300 mm"]]
    assert json.loads(made[1])[2] == ["130 deg", "17.188733854 deg"]


def test_typed_parts_of_a_point():
    body = "const typed = (part, text) => typedPart(segment, 1, part, text);"
    body += "return [partText(segment, 1, 0), typed(0, '70'), typed(1, '0.6 cm'), typed(1, '3 kg')];"
    text, angle, lift, odd = on_points(body, ROWS, "table")
    assert text == "60 deg" and (angle, lift) == pytest.approx((70 * DEGREE, 0.006)) and odd is None
    assert on_points("return ['0.3', '0.3 mm', 'x'].map(text => typedPart(segment, 1, 0, text));") == [0.3, None, None]


def test_of_many_points_the_chosen_one_and_those_near_the_hand_are_seen():
    seen = "return seenPoints(data.xs, k => k > 0 && k < data.xs.length - 1, {apart: 15, most: 5, reach: 60, ...data.more});"

    def shown(xs, **more):
        return in_node(seen, {"xs": xs, "more": {"x": None, "chosen": -1, **more}}, motion_points="seenPoints")

    assert shown([0, 20, 40, 60]) == [1, 2]  # few: all that move
    many = [2 * k for k in range(200)]
    assert shown(many) == [] and shown(many, chosen=77) == [77]
    near = shown(many, x=101)
    assert len(near) == 5 and all(abs(many[k] - 101) <= 60 for k in near) and min(abs(many[k] - 101) for k in near) == 1
    assert all(many[b] - many[a] >= 15 for a, b in zip(near, near[1:], strict=False))
    assert 77 in shown(many, x=101, chosen=77)


# -- the design behind the drawing ---------------------------------------------------------------------------------------------


def test_numbers_are_those_in_the_hand_until_the_form_has_them():
    """The form is late while a hand moves: each step begins where the one before it went."""
    body = """
        const at = angle => ({key: "programme.0.angle", unit: "deg", value: angle, text: `${angle} deg`});
        const fields = angle => new Map([["programme.0.angle", at(angle)], ["programme.0.rows", {text: data.rows}]]);
        const design = createMotionDesign(() => []), seen = [];
        const look = () => seen.push([design.number(0, "angle").value, design.holds() && design.arrived()]);
        design.load({list: "programme", keys: {angle: "angle", rise: "rise", law: "law", rows: "rows"}, segments: []});
        design.fill(fields(90)); look();
        design.hold({"programme.0.angle": 95 * Math.PI / 180}); look();
        design.fill(fields(92)); look();
        design.fill(fields(95)); look();
        design.hold({}, {"programme.0.rows": "[[0,1]]"}); look();
        data.rows = "[[0, 1]]"; design.fill(fields(95)); look();
        design.hold(null); design.fill(fields(80)); look();
        return seen;
    """
    found = in_node(body, {"rows": "[[0, 0]]"}, motion_design="createMotionDesign")
    assert found == [[90, False], [95, False], [95, False], [95, True], [95, False], [95, True], [80, False]]


# -- segments with keys of their own, on a turn that begins elsewhere ----------------------------------------------------------

PUSHER = """
    const layer = new Part("div"), stage = new Part("div"), said = [], held = [], degree = Math.PI / 180, numbers = {...data.numbers};
    const units = {"push.stroke": ["mm", 1e-3]}, limits = {"push.end": {low: 0, high: 360}, "push.hold": {low: 0}, "push.stroke": {low: 0}};
    const numberAt = (key, sense = 1) => key in numbers && !data.locked.includes(key)
      ? {key, value: numbers[key], unit: units[key]?.[0] || "deg", factor: (units[key]?.[1] || degree) * sense, ...limits[key]} : null;
    const fixed = [
      {angle: "push.rise", rise: "push.stroke", law: "push.law", sense: 1, border: {"push.rise": -1}},
      {angle: "push.hold", rise: "", law: "", sense: 1, border: {"push.end": 1, "push.rise": 1, "push.hold": -1}},
      {angle: "push.retraction", rise: "push.stroke", law: "push.law", sense: -1, border: {"push.hold": 1, "push.retraction": -1}},
      {angle: "", rise: "", law: "", sense: 1, border: {"push.retraction": 1}}];
    const wide = [numbers["push.rise"], numbers["push.hold"], numbers["push.retraction"]], stroke = numbers["push.stroke"] / 1e3;
    wide.push(360 - wide[0] - wide[1] - wide[2]);
    let start = 0, level = 0;
    const segments = wide.map((angle, n) => {
      const rise = [stroke, 0, -stroke, 0][n], end = start + angle * degree;
      const own = {angle: angle * degree, rise, start, end, from: level, to: level + rise,
        law: n % 2 ? "dwell" : "cycloidal", absolute: false, fixed: fixed[n]};
      start = own.end; level = own.to;
      return own;
    });
    const origin = (numbers["push.end"] - numbers["push.rise"]) * degree;
    const drawn = () => ({segments, list: "", origin, dwell: "dwell", keys: {},
      cycle: {span: 2 * Math.PI, factor: 1 / degree, unit: "°"}, lift: {factor: 1e3, unit: "mm"}});
    const turned = angle => angle - Math.floor(angle / (2 * Math.PI) + 1e-9) * 2 * Math.PI;
    const plot = {toX: a => turned(a + origin) / degree * 2, fromX: x => x / 2 * degree - origin,
      toY: s => 300 - s * 1e4, fromY: y => (300 - y) / 1e4};
    const number = (n, name) => numberAt(fixed[n][name], name === "rise" ? fixed[n].sense : 1);
    const clock = {at: null, pause() {}, set(phase) { clock.at = phase; }};
    const hands = createMotionDrag({layer, stage, plot, drawn, isCurrent: () => true, number, numberAt,
      hold: (...all) => held.push(all), select() {}, tools: {say: message => said.push(message), t, clock}});
    hands.place(0);
    const made = name => layer.named(`programme-${name}`)[0];
    function pull(name, [x0, y0], [x, y], more = {}) {
      made(name).fire("pointerdown", {clientX: x0, clientY: y0, pointerId: 1});
      made(name).fire("pointermove", {clientX: x, clientY: y, ...more}); nextFrame();
    }
    const changes = () => said.map(message => message.changes ?? message);
"""
NUMBERS = {"push.end": 86, "push.rise": 21, "push.hold": 1, "push.retraction": 36, "push.stroke": 18}


def pusher(body, locked=(), **numbers):
    return in_node(PUSHER + body, {"numbers": {**NUMBERS, **numbers}, "locked": locked}, motion_drag="createMotionDrag")


def test_each_border_of_a_pusher_moves_its_own_keys():
    said = pusher(
        """
        pull("border-0", [130, 12], [100, 12]); made("border-0").fire("pointerup");
        pull("border-1", [172, 12], [172.4, 12], {altKey: true}); made("border-1").fire("pointerup");
        pull("border-2", [174, 12], [194, 12]); made("border-2").fire("pointerup");
        pull("border-3", [246, 12], [266, 12]);
        return changes();
    """
    )
    assert said == [
        {"push.rise": "36 deg"},
        {"push.end": "86.2 deg", "push.rise": "21.2 deg", "push.hold": "0.8 deg"},
        {"push.hold": "11 deg", "push.retraction": "26 deg"},
        {"push.retraction": "46 deg"},
    ]


def test_a_hold_may_vanish_but_the_motions_keep_a_degree():
    (changes,) = pusher('pull("border-2", [174, 12], [20, 12]); return changes();')
    assert changes == {"push.hold": "0 deg", "push.retraction": "37 deg"}
    (changes,) = pusher('pull("border-3", [246, 12], [100, 12]); return changes();')
    assert changes == {"push.retraction": "1 deg"}


def test_a_push_over_the_end_of_the_turn():
    (changes,) = pusher('pull("border-1", [716, 12], [4, 12]); return changes();', **{"push.end": 358, "push.hold": 20})
    assert changes == {"push.end": "2 deg", "push.rise": "25 deg", "push.hold": "16 deg"}  # the end of the push is an angle of one turn
    (changes,) = pusher('pull("border-0", [10, 12], [700, 12]); return changes();', **{"push.end": 26})
    assert changes == {"push.rise": "36 deg"}  # backwards over the beginning


def test_borders_that_are_close_stand_apart_and_are_held_where_they_are():
    places, names = pusher(
        "return [[1, 2].map(n => made(`border-${n}`).style.transform), layer.named('programme-').map(({dataset}) => dataset.testid)];"
    )
    assert places == ["translate(164.0px, 12.0px)", "translate(182.0px, 12.0px)"]
    assert names[-1] == "programme-lift-0" and "programme-lift-2" not in names


def test_the_stroke_is_one_number_for_both_motions():
    said, held = pusher('pull("lift-0", [172, 120], [172, 100], {altKey: true}); return [changes(), held[0]];')
    assert said == [{"push.stroke": "20 mm"}] and held[0] == {"push.stroke": 0.02}  # as the spec has it
    assert pusher('pull("lift-0", [172, 120], [172, 380], {altKey: true}); return changes();') == []  # never negative
    typed = pusher(
        "hands.typed(2, 'rise', '-20'); hands.typed(0, 'rise', '2 cm'); hands.typed(1, 'angle', '3'); hands.typed(3, 'angle', '9');"
        "return said;"
    )
    assert [(each["key"], each["text"]) for each in typed] == [("push.stroke", "20 mm"), ("push.stroke", "2 cm"), ("push.hold", "3 deg")]


def test_locked_numbers_hold_their_borders():
    body = "return [0, 1, 2, 3].map(n => made(`border-${n}`).disabled);"
    assert pusher(body, ["push.hold"]) == [False, True, True, False]


def test_the_clock_of_a_turn_that_begins_elsewhere():
    body = """
        const canvas = new Part("canvas");
        stage.append(canvas);
        canvas.fire("pointerdown", {clientX: 180, clientY: 5, pointerId: 1});
        return clock.at;
    """
    assert pusher(body) == pytest.approx(0.25)
