"""What a hand does on the page, in node with as much of a page as the modules use: handles, borders of segments, edges of panes, lists."""

import math

import pytest
from in_node import in_node

pytestmark = pytest.mark.interface

DRAG = """
    const layer = new Part("div"), guides = new Part("svg"), bubble = new Part("output"), button = new Part("button"), said = [];
    const view = {width: 600, height: 400, scale: 2000, middle: () => [0.05, 0.01]};
    view.toX = x => view.width / 2 + (x - 0.05) * view.scale;
    view.toY = y => view.height / 2 - (y - 0.01) * view.scale;
    const poses = {"-1": [0, 0, 0], 0: [0.02, 0.005, 0.7]};
    const clock = {playing: data.playing || false, phase: 0, set() {}, pause() { clock.playing = false; }};
    const place = (handle, [x, y]) => {
      const [px, py, angle] = poses[handle.body], c = Math.cos(angle), s = Math.sin(angle);
      return [view.toX(px + c * x - s * y), view.toY(py + s * x + c * y)];
    };
    const others = () => (data.others || []).map(other => ({...other, at: place(other, other.point)}));
    const numbers = () => data.numbers && data.numbers.map(number => ({...number}));
    const other = new Part("button"), nearest = () => ({button: data.beside ? other : button, handleOf: () => data.handle});
    const drag = createDrag({layer, guides, bubble, place, frame: handle => poses[handle.body], others, nearest, nameOf: () => "A", numbers,
      view: () => view, undrawn: () => data.undrawn || 0, say: message => said.push(message), t, clock});
    layer.append(button);
    drag.attach(button, () => data.handle);
    const at = place(data.handle, data.handle.point), grip = data.grip || [2, -1];
    function down() { button.fire("pointerdown", {clientX: at[0] + grip[0], clientY: at[1] + grip[1], pointerId: 1}); }
    function to(point, more = {}) {
      const [x, y] = place(data.handle, point);
      button.fire("pointermove", {clientX: x + grip[0], clientY: y + grip[1], ...more}); nextFrame();
    }
    const key = (name, more = {}) => button.fire("keydown", {key: name, ...more});
"""
POINT = {
    "handle": {"key": "crank.A", "body": 0, "point": [0.03, 0.01]},
    "numbers": [
        {"key": "crank.A.0", "unit": "mm", "factor": 1e-3, "value": 30},
        {"key": "crank.A.1", "unit": "mm", "factor": 1e-3, "value": 10, "high": 25},
    ],
}
SIZE = {
    "handle": {"key": "radius", "body": -1, "point": [0.04, 0.01], "direction": [0.6, 0.8], "value": 0.02},
    "numbers": [{"key": "radius", "unit": "cm", "factor": 1e-2, "value": 2, "low": 1}],
}


def dragged(body, data, **more):
    return in_node(DRAG + body, {**data, **more}, dragging="createDrag")


def numbers_of(message):
    return [float(text.split()[0]) for text in message["changes"].values()]


@pytest.mark.parametrize("target", [(0.05, -0.02), (0.012, 0.024), (-0.03, 0.001)])
def test_a_point_goes_where_the_hand_goes_in_the_frame_of_its_body(target):
    """To the half pixel of the grid: 2000 px are a metre."""
    said, held, words = dragged(f"down(); to({list(target)}); return [said, drag.held(button), bubble.textContent];", POINT)
    (message,) = said
    assert message["what"] == "drag" and list(message["changes"]) == ["crank.A.0", "crank.A.1"] and held
    assert numbers_of(message) == pytest.approx([1e3 * part for part in target], abs=0.3)
    assert all(text.endswith(" mm") for text in message["changes"].values()) and words.startswith("A  x ")
    for number in numbers_of(message):
        assert number * 2 == pytest.approx(round(number * 2))  # on the grid of half a millimetre


def test_of_two_handles_beside_each_other_the_nearest_is_taken():
    """The press falls upon the area of one, and the hand is nearer to another."""
    body = "down(); return [drag.held(button), drag.held(other)];"
    assert dragged(body, POINT, beside=True) == [False, True] and dragged(body, POINT) == [True, False]
    assert dragged(f"button.disabled = true; {body}", POINT) == [False, False]


def test_alt_takes_the_place_itself_and_limits_hold():
    body = "down(); to([0.0301234, 0.0123456], {altKey: true}); to([0, 0.09], {altKey: true}); return said;"
    first, second = dragged(body, POINT)
    assert numbers_of(first) == pytest.approx([30.1234, 12.3456], rel=1e-9) and numbers_of(second)[1] == 25
    assert first["gesture"] == second["gesture"] != ""


def test_a_step_waits_while_drawings_are_on_their_way_and_is_the_newest_place_then():
    """Four steps may be under way; the end of the drag waits for nothing."""
    body = """
    down();
    for (const x of [0.031, 0.032, 0.0325, 0.033, 0.034]) to([x, 0.01]);
    const full = said.length;
    drag.answered(); to([0.035, 0.01]);
    const next = said.at(-1).changes["crank.A.0"], under = said.length;
    to([0.036, 0.01]); to([0.037, 0.01]);
    const still = said.length;
    button.fire("pointerup");
    return [full, under, next, still, said.length, said.at(-1).changes["crank.A.0"]];
    """
    full, under, following, still, ended, last = dragged(body, POINT)
    assert (full, under, still, ended) == (4, 5, 5, 6)
    assert float(following.split()[0]) == pytest.approx(35, abs=0.3) and float(last.split()[0]) == pytest.approx(37, abs=0.3)


def test_steps_that_the_server_has_taken_and_not_drawn_count_too():
    """Three of them leave room for one; a drawing that is the newest makes room again."""
    body = """
    down();
    for (const x of [0.031, 0.032, 0.033]) to([x, 0.01]);
    const before = said.length;
    data.undrawn = 0; drag.drawn();
    for (const x of [0.034, 0.035, 0.036, 0.037]) to([x, 0.01]);
    return [before, said.length];
    """
    assert dragged(body, POINT, undrawn=3) == [1, 4]


def test_answers_beyond_those_that_are_due_make_no_more_room():
    body = """
        down(); to([0.032, 0.01]);
        for (let n = 0; n < 5; n++) drag.answered();
        for (const x of [0.0325, 0.033, 0.034, 0.035, 0.036, 0.037]) to([x, 0.01]);
        return said.length;
    """
    assert dragged(body, POINT) == 5


def test_a_drawing_that_is_not_the_newest_makes_no_room():
    body = """
        down(); for (const x of [0.032, 0.0325, 0.033, 0.034]) to([x, 0.01]);
        data.undrawn = 1; drag.drawn(); to([0.0345, 0.01]);
        const before = said.length;
        data.undrawn = 0; drag.drawn(); for (const x of [0.035, 0.036, 0.037, 0.038]) to([x, 0.01]);
        return [before, said.length];
    """
    assert dragged(body, POINT) == [4, 7]  # one that the server took together with others is still due


def test_steps_without_any_answer_are_waited_for_a_moment_only():
    """Then the next one goes, and they are counted anew."""
    body = """
        let now = 1000;
        Object.defineProperty(globalThis, "performance", {value: {now: () => now}, configurable: true});
        down(); for (const x of [0.031, 0.032, 0.033, 0.034, 0.035]) to([x, 0.01]);
        const before = said.length;
        now += 200; for (const x of [0.036, 0.037, 0.038, 0.039, 0.040]) to([x, 0.01]);
        return [before, said.length];
    """
    assert dragged(body, POINT) == [4, 8]


def test_the_number_is_shown_with_its_drawing_or_a_moment_later_without():
    """The page is laid out once for both; and nothing is shown when the hand has let go."""
    body = """
        const timers = [];
        globalThis.setTimeout = act => timers.push(act);
        globalThis.clearTimeout = number => { if (number) timers[number - 1] = null; };
        down(); to([0.032, 0.01]);
        const seen = [bubble.textContent];
        to([0.033, 0.01]); seen.push(timers.length, bubble.textContent);
        drag.draw(); seen.push(bubble.textContent, timers[0]);
        to([0.034, 0.01]); timers[1](); seen.push(bubble.textContent);
        to([0.035, 0.01]); button.fire("pointerup"); seen.push(timers.length, timers[2] === null, bubble.hidden);
        return seen;
    """
    start, timers, still, drawn, stopped, late, asked, ended, hidden = dragged(body, POINT)
    assert "x 30 " in start and timers == 1 and still == start and "x 33 " in drawn and stopped is None
    assert "x 34 " in late and asked == 3 and ended and hidden


def test_a_hand_that_comes_back_takes_the_point_back_and_opens_no_box():
    body = """
        down(); to([0.05, 0.02], {altKey: true}); to([0.03, 0.01], {altKey: true}); button.fire("pointerup");
        return [said.map(({changes}) => changes), layer.named("handle-box-").length];
    """
    (away, back), boxes = dragged(body, POINT)
    assert (
        numbers_of({"changes": away}) == pytest.approx([50, 20]) and numbers_of({"changes": back}) == pytest.approx([30, 10]) and boxes == 0
    )


def test_the_numbers_stand_beside_the_handle_and_inside_of_the_drawing():
    """The bubble of the stub is 50 px wide and 20 high: to the left of its handle at the right edge, never closer than 4 px to an edge."""
    body = """
        down(); const seen = [];
        for (const [x, y] of [[0, 0.01], [0.19, 0.01], [0.04, 0.105]]) {
          to([x, y], {altKey: true});
          data.handle.point = [x, y];  // the drawing has come
          drag.draw(); seen.push([place(data.handle, data.handle.point), bubble.style.transform.match(/-?[\\d.]+/g).map(Number)]);
        }
        return seen;
    """
    free = {"handle": {"key": "p", "body": -1, "point": [0.05, 0.01]}, "numbers": POINT["numbers"]}
    middle, right, top = dragged(body, free)
    assert middle[1] == pytest.approx([middle[0][0] + 16, middle[0][1] - 34])
    assert right[0][0] > 550 and right[1][0] == pytest.approx(right[0][0] - 16 - 50) and top[0][1] < 20 and top[1][1] == 4


def test_a_hand_that_shakes_moves_nothing_and_opens_the_box():
    said, boxes = dragged(
        "down(); button.fire('pointermove', {clientX: at[0] + grip[0] + 2, clientY: at[1] + grip[1]});"
        "nextFrame(); button.fire('pointerup');"
        "return [said, layer.named('handle-box-').map(box => box.value)];",
        POINT,
    )
    assert said == [] and boxes == ["30, 10 mm"]


def test_a_point_falls_upon_one_of_another_body_and_stands_level_with_its_own():
    """Exactly, whatever the grid."""
    c, s = math.cos(0.7), math.sin(0.7)
    own = {"body": 0, "point": [0.0500333, 0.0200111]}
    x, y = 0.02 + 0.0500333 * c - 0.0200111 * s, 0.005 + 0.0500333 * s + 0.0200111 * c
    upon = dragged("down(); to([0.0510, 0.0205]); return said;", POINT, others=[{"body": -1, "point": [x, y]}])
    assert numbers_of(upon[0]) == pytest.approx([50.0333, 20.0111], abs=0.01)
    beside = dragged("down(); to([0.0510, 0.0205]); return said;", POINT, others=[own])
    assert numbers_of(beside[0]) == pytest.approx([50.0333, 20.0111], abs=0.01)  # level and plumb with its own: the very place
    length = dragged(
        "down(); to([0.0430, 0.041]); drag.draw(); return [said[0], bubble.textContent, guides.children.length];",
        POINT,
        others=[{"body": 0, "point": [0, 0]}, {"body": -1, "point": [0.2, 0.0]}, {"body": -1, "point": [0.2, 0.0585]}],
        numbers=[{**number, "high": None} for number in POINT["numbers"]],
    )
    assert math.hypot(*numbers_of(length[0])) == pytest.approx(58.5, abs=0.02) and "equal length" in length[1] and length[2] == 1


def test_a_point_beside_the_handle_attracts_it_and_one_upon_it_does_not():
    """A pin of two bodies is a point of both: the other one's moves along, and holds nothing fast."""
    c, s = math.cos(0.7), math.sin(0.7)
    spots = {
        name: [0.02 + x * c - y * s, 0.005 + x * s + y * c] for name, (x, y) in {"upon": (0.03, 0.01), "beside": (0.0323, 0.0111)}.items()
    }
    body = "down(); to([0.0324, 0.0112]); return said;"
    (beside,) = dragged(body, POINT, others=[{"body": -1, "point": spots["beside"]}])
    (upon,) = dragged(body, POINT, others=[{"body": -1, "point": spots["upon"]}])
    assert numbers_of(beside) == pytest.approx([32.3, 11.1], abs=0.01) and numbers_of(upon) == pytest.approx([32.5, 11])


def test_the_bubble_is_measured_again_when_its_text_gets_longer():
    body = """
        Object.defineProperty(bubble, "offsetWidth", {get: () => 6 * bubble.textContent.length});
        data.handle.point = [0.16, 0.01];
        drag.attach(button, () => data.handle);
        button.fire("pointerenter", {pointerType: "mouse"});
        const short = [bubble.textContent.length, Number(bubble.style.transform.match(/-?[\\d.]+/)[0])];
        data.numbers[0].value = 160.123456; drag.draw();
        const x = place(data.handle, data.handle.point)[0];
        return [x, short, [bubble.textContent.length, Number(bubble.style.transform.match(/-?[\\d.]+/)[0])]];
    """
    x, short, long = dragged(body, {"handle": {"key": "p", "body": -1, "point": [0.16, 0.01]}, "numbers": POINT["numbers"]})
    for length, left in (short, long):
        assert left == pytest.approx(x - 16 - 6 * length)
    assert long[0] > short[0]


def test_one_number_follows_the_hand_along_its_direction_only():
    """A metre along the direction is a metre of the number, and what is across does not count."""
    along = [0.04 + 0.6 * 0.01 - 0.8 * 0.03, 0.01 + 0.8 * 0.01 + 0.6 * 0.03]
    (message,) = dragged(f"down(); to({along}, {{altKey: true}}); return said;", SIZE)
    assert message["changes"] == {"radius": "3 cm"}
    twice = {**SIZE, "handle": {**SIZE["handle"], "direction": [1.2, 1.6]}}  # the handle goes two metres a metre
    (message,) = dragged(f"down(); to({along}, {{altKey: true}}); return said;", twice)
    assert message["changes"] == {"radius": "2.5 cm"}
    (message,) = dragged("down(); to([0.0413, 0.0113]); return said;", SIZE)
    (number,) = numbers_of(message)
    assert number == pytest.approx(2.182, abs=0.03) and number * 20 == pytest.approx(round(number * 20))  # on the grid of half a millimetre
    (message,) = dragged("down(); to([-0.2, -0.2]); return said;", SIZE)
    assert message["changes"] == {"radius": "1 cm"}  # its limit


def test_whole_numbers_stay_whole():
    teeth = {**SIZE, "numbers": [{"key": "teeth", "unit": "", "factor": 1, "value": 20, "whole": True}]}
    teeth["handle"] = {**teeth["handle"], "direction": [0.001, 0], "value": 20}
    assert [each["changes"] for each in dragged("down(); to([0.0434, 0]); key('ArrowUp'); return said;", teeth)] == [
        {"teeth": "23"},
        {"teeth": "21"},
    ]


def test_escape_takes_a_drag_back_and_nothing_follows():
    said = dragged("down(); to([0.05, 0]); key('Escape'); to([0.06, 0]); button.fire('pointerup'); return said;", POINT)
    assert [each["what"] for each in said] == ["drag", "revert"] and said[0]["gesture"] == said[1]["gesture"]


def test_arrow_keys_take_steps_on_the_grid_ten_with_shift():
    said = dragged("key('ArrowRight'); key('ArrowDown', {shiftKey: true}); key('ArrowLeft'); return said;", POINT)
    (right, y), (x, down), (left, _) = map(numbers_of, said)
    step = right - 30
    assert (
        step > 0 and y == 10 and x == right and down == pytest.approx(10 - 10 * step) and left == 30
    )  # each from where the one before it went
    assert said[0]["gesture"] == said[2]["gesture"]  # quick steps are undone together
    (more,) = dragged("key('ArrowUp'); return said;", SIZE)
    (less,) = dragged("key('ArrowLeft'); return said;", SIZE)
    assert numbers_of(more)[0] > 2 > numbers_of(less)[0]


@pytest.mark.parametrize(
    ("typed", "changes"),
    [
        ("45, 12 mm", ["45 mm", "12 mm"]),
        ("45 mm, 1.2 cm", ["45 mm", "1.2 cm"]),
        ("4, 5", ["4 mm", "5 mm"]),
        ("4, 5 cm", ["4 cm", "5 cm"]),
        ("-4, .5", ["-4 mm", "0.5 mm"]),
        ("45", None),
        ("x, 5", None),
        ("x5, 5", None),
        ("1, 2, 3", None),
    ],
)
def test_typed_coordinates(typed, changes):
    body = """
        key("Enter");
        const [box] = layer.named("handle-box-");
        box.value = data.typed;
        box.fire("keydown", {key: "Enter"}); box.fire("blur");
        return [said, layer.named("handle-box-").length];
    """
    said, left = dragged(body, POINT, typed=typed)
    assert [list(each["changes"].values()) for each in said] == ([changes] if changes else []) and left == 0


def test_a_moving_mechanism_stops_at_its_start_under_a_hand():
    assert dragged("down(); return clock.playing;", POINT, playing=True) is False
    assert dragged("down(); to([0.05, 0]); return said;", {**POINT, "numbers": None}) == []  # no such fields


# -- the motion programme ------------------------------------------------------------------------------------------------------

PROGRAMME = """
    const layer = new Part("div"), stage = new Part("div"), said = [], held = [], chosen = [];
    const angles = data.angles, rises = data.rises, degree = Math.PI / 180;
    let start = 0, level = 0;
    const segments = angles.map((angle, n) => {
      const own = {angle: angle * degree, rise: rises[n] / 1e3, start, end: start + angle * degree, from: level, to: level + rises[n] / 1e3,
        law: "cycloidal", absolute: false};
      if (n === data.spline) own.nodes = {...readPoints("[[0, 0], [0.25, 0.1], [0.75, 0.9], [1, 1]]", "spline"), key: "programme.2.points"};
      start = own.end; level = own.to;
      return own;
    });
    const drawn = () => ({segments, list: "programme", keys: {angle: "angle", rise: "rise", points: "points"},
      cycle: {span: 2 * Math.PI, factor: 1 / degree, unit: "°"}, lift: {factor: 1e3, unit: "mm"}});
    const plot = {toX: a => a / degree * 2, fromX: x => x / 2 * degree, toY: s => 300 - s * 1e4, fromY: y => (300 - y) / 1e4};
    const number = (n, name) => name === "angle" ? {key: `programme.${n}.angle`, value: angles[n], unit: "deg", factor: degree}
      : {key: `programme.${n}.rise`, value: rises[n], unit: "mm", factor: 1e-3};
    const clock = {paused: 0, at: null, pause() { clock.paused++; }, set(phase) { clock.at = phase; }};
    const hands = createMotionDrag({layer, stage, plot, drawn, isCurrent: () => data.current !== false, number,
      hold: numbers => held.push(numbers), select: n => chosen.push(n), tools: {say: message => said.push(message), t, clock}});
    hands.place(0);
    const made = name => layer.named(`programme-${name}`)[0];
    function pull(name, [x0, y0], [x, y], more = {}) {
      made(name).fire("pointerdown", {clientX: x0, clientY: y0, pointerId: 1});
      made(name).fire("pointermove", {clientX: x, clientY: y, ...more}); nextFrame();
    }
    const changes = () => said.map(message => message.changes ?? message);
"""
MOTION = {"angles": [90, 60, 120, 90], "rises": [20, 0, -12, -8]}


def programme(body, **more):
    return in_node(PROGRAMME + body, {**MOTION, **more}, motion_drag="createMotionDrag", motion_points="readPoints")


def test_what_can_be_held_of_a_programme():
    names, transform = programme(
        "return [layer.named('programme-').map(({dataset}) => dataset.testid), made('border-1').style.transform];", spline=2
    )
    assert names == [
        *(f"programme-segment-{n}" for n in range(4)),
        *(f"programme-border-{n}" for n in (1, 2, 3)),
        "programme-lift-0",
        "programme-lift-2",
        "programme-point-2-1",
        "programme-point-2-2",
    ]
    assert transform == "translate(180.0px, 12.0px)"
    assert programme("return made('point-2-1').style.transform;", spline=2) == "translate(360.0px, 112.0px)"  # a quarter of 120 degrees on


def test_a_border_moves_by_whole_degrees_and_the_turn_stays_closed():
    (changes,) = programme("pull('border-1', [180, 12], [197.4, 12]); return changes();")
    assert changes == {"programme.0.angle": "99 deg", "programme.1.angle": "51 deg"}
    (changes,) = programme("pull('border-1', [180, 12], [197.4, 12], {altKey: true}); return changes();")
    assert changes == {"programme.0.angle": "98.7 deg", "programme.1.angle": "51.3 deg"}
    (changes,) = programme("pull('border-1', [180, 12], [500, 12]); return changes();")
    assert changes == {"programme.0.angle": "149 deg", "programme.1.angle": "1 deg"}  # a degree is left
    (changes,) = programme("pull('border-1', [180, 12], [-500, 12]); return changes();")
    assert changes == {"programme.0.angle": "1 deg", "programme.1.angle": "149 deg"}


def test_a_border_snaps_to_where_both_segments_are_equally_long():
    changes, words = programme("pull('border-1', [180, 12], [154, 12]); return [said[0].changes, layer.children[0].textContent];")
    assert changes == {"programme.0.angle": "75 deg", "programme.1.angle": "75 deg"} and "equally long" in words


def test_a_lift_is_taken_up_by_the_next_segment_that_moves():
    (changes,) = programme("pull('lift-0', [180, 100], [180, 60], {altKey: true}); return changes();")
    assert changes == {"programme.0.rise": "24 mm", "programme.2.rise": "-16 mm"}
    (changes,) = programme("pull('lift-2', [540, 220], [540, 250]); return changes();")
    own, rest = (float(text.split()[0]) for text in changes.values())
    assert (
        list(changes) == ["programme.2.rise", "programme.3.rise"]
        and own + rest == pytest.approx(-20)
        and own == pytest.approx(-15, abs=0.5)
    )
    assert programme("pull('lift-2', [540, 220], [540, 300]); return changes();") == []  # no segment may come to stand still


def test_a_lift_snaps_to_the_level_of_another():
    changes, words = programme(
        "pull('lift-0', [180, 100], [180, 283]); return [said[0].changes, layer.children[0].textContent];",
        rises=[20, 0, -17, -3],
        angles=[90, 60, 120, 90],
    )
    assert float(changes["programme.0.rise"].split()[0]) + float(changes["programme.2.rise"].split()[0]) == pytest.approx(3)
    two = {"angles": [60, 60, 60, 60, 120], "rises": [5, 8, -8, 10, -15]}
    changes, words = programme("pull('lift-3', [480, 150], [480, 173]); return [said[0].changes, layer.children[0].textContent];", **two)
    assert changes == {"programme.3.rise": "8 mm", "programme.4.rise": "-13 mm"} and "level" in words
    (changes,) = programme("pull('lift-0', [180, 100], [180, 105]); return changes();")
    assert changes == {"programme.0.rise": "19.5 mm", "programme.2.rise": "-11.5 mm"}  # not back to the dwell that moves along


def test_a_point_of_a_spline_stays_between_its_neighbours():
    said = programme("pull('point-2-1', [360, 112], [300, 120]); return changes();", spline=2)
    (points,) = (list(each.values())[0] for each in said)
    assert points.startswith("[[0,0],[0.01,") and points.endswith("[0.75,0.9],[1,1]]") and list(said[0]) == ["programme.2.points"]


def test_keys_of_a_border_and_escape():
    body = """
        made("border-2").fire("keydown", {key: "ArrowRight"}); made("border-2").fire("keydown", {key: "ArrowDown", shiftKey: true});
        made("lift-0").fire("keydown", {key: "ArrowUp"});
        pull("border-1", [180, 12], [200, 12]);
        made("border-1").fire("keydown", {key: "Escape"});
        return [changes(), hands.held(), held.at(-1)];
    """
    said, still, last = programme(body)
    assert said[0] == {"programme.1.angle": "61 deg", "programme.2.angle": "119 deg"}
    assert said[1] == {"programme.1.angle": "50 deg", "programme.2.angle": "130 deg"}
    up, down = (float(text.split()[0]) for text in said[2].values())
    assert up > 20 and up + down == pytest.approx(8)
    assert said[-1]["what"] == "revert" and not still and last is None


def test_typed_angles_and_rises_keep_the_turn_closed():
    body = """
        hands.typed(0, 'angle', '100'); hands.typed(3, 'angle', '80 °');
        hands.typed(0, 'rise', '25 mm'); hands.typed(3, 'rise', '-5');
        return changes();
    """
    said = programme(body)
    assert said[0] == {"programme.0.angle": "100 deg", "programme.1.angle": "50 deg"}
    assert said[1] == {"programme.2.angle": "130 deg", "programme.3.angle": "80 deg"}  # the last one moves the border before it
    assert said[2] == {"programme.0.rise": "25 mm", "programme.2.rise": "-17 mm"}
    assert said[3] == {"programme.2.rise": "-15 mm", "programme.3.rise": "-5 mm"}
    other = programme("hands.typed(0, 'angle', '1 rad'); hands.typed(0, 'angle', 'x'); return changes();")
    assert other == [{"what": "set", "key": "programme.0.angle", "text": "1 rad"}]
    assert programme("hands.typed(1, 'angle', '50'); return changes();", current=False) == [
        {"what": "set", "key": "programme.1.angle", "text": "50 deg"}
    ]


def test_the_diagram_sweeps_the_clock():
    body = """
        const canvas = new Part("canvas");
        stage.append(canvas);
        canvas.fire("pointerdown", {clientX: 180, clientY: 5, pointerId: 1});
        stage.fire("pointermove", {clientX: 360, clientY: 5});
        stage.fire("pointerup");
        stage.fire("pointermove", {clientX: 0, clientY: 5});
        return clock.at;
    """
    assert programme(body) == pytest.approx(0.5)


# -- panes and lists -----------------------------------------------------------------------------------------------------------


def test_the_edge_of_the_plots_follows_the_hand_within_its_limits():
    body = """
        const host = new Part("div"), root = new Part("main"), memory = {height: 0};
        let kept = 0;
        root.append(host);
        Object.defineProperty(host, "box", {get: () => ({height: memory.height || 200})});
        const {node} = createSplitter(host, memory, () => { kept++; }, t), seen = [];
        const note = () => seen.push([memory.height, root.style["--st-plots"] ?? null]);
        node.fire("pointerdown", {clientY: 500, pointerId: 1}); node.fire("pointermove", {clientY: 450}); note();
        node.fire("pointermove", {clientY: -2000}); note(); node.fire("pointermove", {clientY: 2000}); note(); node.fire("pointerup");
        node.fire("pointermove", {clientY: 300}); note();
        node.fire("keydown", {key: "ArrowUp"}); note(); node.fire("keydown", {key: "ArrowDown", shiftKey: true}); note();
        node.fire("keydown", {key: "Home"}); note(); node.fire("keydown", {key: "x"}); node.fire("dblclick"); note();
        nextFrame();
        return [seen, kept, node.attributes["aria-valuemin"], node.attributes["aria-valuemax"], node.attributes["aria-valuenow"]];
    """
    seen, kept, low, high, now = in_node(body, None, splitter="createSplitter")
    heights = [height for height, _ in seen]
    assert heights == [250, 680, 36, 36, 60, 36, 680, 0] and [text for _, text in seen[:2]] == ["250px", "680px"] and seen[-1][1] is None
    assert kept == 5 and (low, high, now) == ("36", "680", "200")


KEYS = """
    const opened = [];
    let changes = 0;
    const keys = data.map(each => ({key: each, label: `${each} name`, text: "1 mm", kind: "quantity", locked: each === "locked"}));
    const editor = key => { opened.push(key.key); return {node: new Part("div"), value: () => ({lower: key.entry?.lower ?? "0"})}; };
    const list = createKeyList("x", {t}, editor, () => { changes++; });
    const rows = () => list.node.named("x-key-").map(each => each.dataset.testid.slice(6));
    const boxOf = key => list.node.named(`x-key-${key}`)[0], find = list.node.named("x-find")[0];
"""


def test_a_list_of_keys_shows_what_is_ticked_first_and_finds_by_every_word():
    body = (
        KEYS
        + """
        list.load(keys, {"b.width": {lower: "3"}, "locked": {}, "gone": {}});
        const first = [rows().slice(0, 3), rows().length, list.chosen()];
        const tick = boxOf("a.width"); tick.checked = true; tick.fire("change");
        find.value = "WIDTH  a"; find.fire("input");
        const found = rows();
        find.value = "nothing like it"; find.fire("input");
        const none = [rows(), list.node.children[2].textContent];
        const off = boxOf("b.width"); off.checked = false; off.fire("change");
        return [first, found, none, list.chosen(), changes];
    """
    )
    data = ["a.width", "b.width", "a.height", "locked", *(f"other.{n}" for n in range(80))]
    (first, count, chosen), found, none, last, changes = in_node(body, data, key_list="createKeyList")
    assert first == ["b.width", "locked", "a.width"] and count == 62 and chosen == [{"key": "b.width", "lower": "3"}]
    assert found == ["a.width", "b.width", "locked"] and none[0] == ["a.width", "b.width", "locked"] and none[1] == ""
    assert last == [{"key": "a.width", "lower": "0"}] and changes == 2
