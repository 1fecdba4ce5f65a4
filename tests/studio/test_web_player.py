"""What the player and the pages share, run in node: the clock, marks of a cycle, its pace, and what is left alone when it is the same."""

import math

import pytest
from in_node import in_node

pytestmark = pytest.mark.interface


# -- the clock -----------------------------------------------------------------------------------------------------------------


def test_a_step_counts_whole_turns_and_a_phase_that_is_set_stays_in_the_cycle():
    body = """
        const clock = createClock(), seen = [];
        clock.subscribe(({phase, turn}) => seen.push([phase, turn]));
        for (const change of [0.75, 0.5, -0.5, 2.5]) clock.step(change);
        for (const phase of [1.5, -2, 0.25]) clock.set(phase);
        return seen;
    """
    found = in_node(body, None, clock="createClock")
    assert found == [[0, 0], [0.75, 0], [0.25, 1], [0.75, 0], [0.25, 3], [1, 3], [0, 3], [0.25, 3]]


def test_a_cycle_takes_its_duration_by_the_speed_and_a_late_frame_does_not_jump():
    """Frames: the first one starts the watch, a pause of a second counts as a tenth."""
    body = """
        let frame = null;
        globalThis.requestAnimationFrame = act => { frame = act; return 1; };
        document.hidden = false;
        const clock = createClock({duration: 4, speed: 2}), view = {}, seen = [];
        const at = ms => { const now = frame; frame = null; now?.(ms); seen.push(clock.phase); };
        clock.play(); at(0);
        clock.see(view, true); at(1000); at(1050); at(2050);
        clock.see(view, false); at(2100);
        return [seen, clock.running];
    """
    seen, running = in_node(body, None, clock="createClock")
    assert seen == pytest.approx([0, 0, 0.025, 0.075, 0.075]) and not running


def test_the_interval_of_a_value_and_the_part_of_the_way_through_it():
    body = "const u = new Float32Array([0, 1, 3, 3, 5]); return data.map(value => locate(u, value));"
    found = in_node(body, [-1, 0, 0.5, 1, 2, 3, 4, 5, 9], clock="locate")
    assert found == [[0, 0], [0, 0], [0, 0.5], [1, 0], [1, 0.5], [3, 0], [3, 0.5], [3, 1], [3, 1]]


def test_round_numbers_go_up_to_the_one_asked_for():
    found = in_node("return data.map(nice);", [1, 1.9, 2, 4.99, 5, 9.9, 10, 0.03, 730], clock="nice")
    assert found == pytest.approx([1, 1, 2, 2, 5, 5, 10, 0.02, 500])


def test_numbers_with_decimals_have_a_true_minus_and_no_negative_zero():
    body = "return [[1.25, 1], [-1.25, 2], [-0.001, 2], [0, 0], [NaN, 1], [Infinity, 1]].map(each => fixed(...each));"
    found = in_node(body, None, clock="fixed")
    assert found == ["1.3", "−1.25", "0.00", "0", "–", "–"]


def test_what_is_the_same_is_left_alone():
    """Each text, attribute, class and font is given once, however often it is said: giving it lays the page out anew."""
    body = """
        const part = new Part("p"), given = [], context = {set font(value) { given.push(value); }};
        const other = {set font(value) { given.push(`other ${value}`); }};
        const own = part.setAttribute.bind(part);
        part.setAttribute = (name, value) => { given.push(`${name} ${value}`); own(name, value); };
        for (const value of [1, "1", 2, 2, true, "true"]) putAttribute(part, "x", value);
        for (const font of ["a", "a", "b", "a"]) useFont(context, font);
        useFont(other, "a");
        const toggled = part.classList.toggle.bind(part.classList);
        part.classList.toggle = (name, on) => { given.push(`${name} ${on}`); return toggled(name, on); };
        for (const on of [true, true, false, false]) putClass(part, "lit", on);
        put(part, "one"); const first = part.children; put(part, "one"); put(part, "two");
        const kept = part.textContent;
        part.replaceChildren(new Part("b"), "more"); put(part, "three");
        return [given, kept, part.textContent, part.children.length];
    """
    given, kept, last, count = in_node(body, None, clock="put, putAttribute, putClass, useFont")
    assert given == ["x 1", "x 2", "x true", "a", "b", "a", "other a", "lit true", "lit false"]
    assert (kept, last, count) == ("two", "three", 1)


def test_the_same_text_is_not_written_again():
    """The text node itself is asked: `data` is set only where it differs, all children only where there is more."""
    body = """
        const written = [];
        const node = own => ({firstChild: own, set textContent(text) { written.push(["all", text]); }});
        const text = (data, nextSibling = null) => ({nextSibling, get data() { return data;
        }, set data(next) { written.push(["own", next]); data = next; }});
        put(node(text("a")), "a"); put(node(text("a")), "b"); put(node(text("a", {})), "a");
        put(node({nextSibling: null}), "c"); put(node(null), "d"); put(node(text("")), "");
        return written;
    """
    assert in_node(body, None, clock="put") == [["own", "b"], ["all", "a"], ["all", "c"], ["all", "d"]]


def test_lists_are_the_same_entry_by_entry():
    body = "return [same([1, 2], [1, 2]), same([1, 2], [2, 1]), same([1], [1, 2]), same([1, 2], [1]), same(null, null), !!same(null, [])];"
    assert in_node(body, None, clock="same") == [True, False, False, False, True, False]


# -- the controls --------------------------------------------------------------------------------------------------------------

MARKS = [[0.7, "lowest"], [0.1, "tooth"], [0.4, "highest"], [0.05, "tooth"]]
AFTER = [[0.2, "lowest"], [0.15, "tooth"], [0.6, "highest"], [0.9, "tooth"]]


def test_marks_stand_by_their_label_and_equal_ones_by_their_place():
    """However they are listed: a mark that overtakes another one keeps its button."""
    for marks in (MARKS, MARKS[::-1], sorted(MARKS)):
        found = in_node("return byLabel({marks: data});", marks, controls="byLabel")
        assert found == [[0.4, "highest"], [0.7, "lowest"], [0.05, "tooth"], [0.1, "tooth"]]


def test_the_marks_of_a_slider_follow_the_cycle_and_lead_to_where_they_are_now():
    body = """
        const set = [], clock = {pause() { set.push("pause"); }, set(phase) { set.push(phase); }};
        const {node, follow, show} = scrubber(clock, {marks: data.marks}, text => text), [input, ...ticks] = node.children;
        const seen = () => ticks.map(tick => [tick.attributes.title, tick.style["--u"]]);
        const before = seen();
        follow({marks: data.after});
        const after = seen();
        ticks.forEach(tick => tick.fire("click"));
        input.value = "0.3"; input.fire("input");
        show(0.5);
        return [before, after, set, input.value, input.style["--part"]];
    """
    before, after, told, value, part = in_node(body, {"marks": MARKS, "after": AFTER}, controls="scrubber")
    assert before == [["highest", 0.4], ["lowest", 0.7], ["tooth", 0.05], ["tooth", 0.1]]
    assert after == [["highest", 0.6], ["lowest", 0.2], ["tooth", 0.15], ["tooth", 0.9]]
    assert told == [0.6, 0.2, 0.15, 0.9, "pause", 0.3] and value == part == 0.5


def test_how_much_slower_than_the_machine_it_is_shown():
    """A turn of a second shown in four is a quarter of the speed."""
    asked = [[4, 1, 1], [4, 1, 4], [4, 1, 40], [1, 1, 0.03], [4, 0.5, 0.1], [4, 1, 0]]
    body = "return data.map(([duration, speed, period]) => pace({duration, speed}, period, text => text));"
    found = in_node(body, asked, controls="pace")
    assert found == ["4× slow motion", "real time", "10× fast motion", "33× slow motion", "80× slow motion", ""]


def test_how_far_behind_the_last_mark_the_cycle_is():
    cycle = {"marks": [[0.25, "highest"], [0.75, "lowest"]], "span": 360, "unit": "°"}
    body = """
        const since = (cycle, phase, digits) => sinceMark(cycle, phase, digits, text => text);
        return [...[0.25, 0.5, 0.8, 0.1].map(phase => since(data, phase, 1)), since({...data, unit: "s", span: -2}, 0.5, 2),
          since({...data, marks: []}, 0.5, 1)];
    """
    found = in_node(body, cycle, controls="sinceMark")
    assert found == ["highest + 0.0°", "highest + 90.0°", "lowest + 18.0°", "lowest + 126.0°", "highest + 0.50 s", ""]


def test_exaggeration_goes_as_far_as_a_body_allows():
    body = "return [...[0.5, 1, 3].map(scale => magnifiedBy({most: 2, magnified: 50}, scale)), ...[1, 12.345, 1234].map(times)];"
    assert in_node(body, None, controls="magnifiedBy, times") == [25, 50, 100, "× 1", "× 12.3", "× 1230"]


def test_real_time_stays_chosen_when_the_period_changes():
    body = """
        const clock = {duration: 4, speed: 1, setSpeed(value) { clock.speed = value; }}, {node, follow} = speedBox(clock, text => text);
        follow(2);
        const real = node.options.at(-1), first = [clock.speed, real.value];
        real.selected = true; follow(8);
        const second = [clock.speed, real.value];
        real.selected = false; clock.speed = 2; follow(1);
        const third = [clock.speed, node.value];
        follow(0);
        return [first, second, third, node.options.length];
    """
    first, second, third, count = in_node(body, None, controls="speedBox")
    assert first == [1, "2"] and second == [0.5, "0.5"] and third == [2, "2"] and count == 6
    assert math.isclose(4 / 8, second[0])


# -- drawings as they come -----------------------------------------------------------------------------------------------------


def test_one_drawing_a_frame_the_first_at_once_and_then_the_newest():
    body = """
        const seen = [], pace = createPace(drawing => seen.push(drawing));
        pace(1); pace(2); pace(3);
        const first = [...seen];
        nextFrame(); pace(4); pace(5);
        const second = [...seen];
        nextFrame(); nextFrame(); nextFrame(); pace(6);
        return [first, second, seen];
    """
    assert in_node(body, None, frames="createPace") == [[1], [1, 3], [1, 3, 5, 6]]
