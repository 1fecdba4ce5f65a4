"""Diagrams under the drawing and the pane of a motion programme, run in node: what is drawn where, and what its numbers say."""

import base64
import math
import struct

import numpy as np
import pytest
from in_node import STORE, in_node

pytestmark = pytest.mark.interface


def packed(values):
    """Numbers as the studio packs them: base64 of float32."""
    return base64.b64encode(struct.pack(f"<{len(values)}f", *values)).decode()


# -- diagrams under the drawing ------------------------------------------------------------------------------------------------

DIAGRAMS = (
    STORE
    + """
    const host = new Part("div"), shown = [];
    const view = {scale: data.scale, centre: data.centre, width: 600, height: 300, follow: [data.follow, 0]}, player = {view};
    const diagrams = createDiagrams(host, () => player, tools, on => shown.push(on));
    resized();
    const node = host.children[0], canvas = node.querySelectorAll("canvas")[0];
    const outputs = () => node.querySelectorAll("output").map(each => each.textContent);
"""
)


def diagram(name, values, **more):
    """A panel along a shaft from 0 to 400 mm."""
    axis = {"label": "x", "unit": "mm", "factor": 1000.0, "low": 0.0, "high": 400.0, "names": None, "places": []}
    series = [{"label": name, "unit": "N", "role": "blue", "data": packed(values)}]
    own = {"id": f"shaft/{name}", "name": name, "title": name, "label": name, "style": "line", "low": -1000, "high": 1000, "log": False}
    return {**own, "decimals": 1, "shade": [], "limits": [], "u": packed([0, 400]), "axis": axis, "series": series, **more}


PLOTS = {"diagrams": ["shaft/moment", "shaft/shear"], "plots": [{"panels": [diagram("shear", [0, 800]), diagram("moment", [100, -900])]}]}


@pytest.mark.parametrize(("scale", "centre", "follow"), [(1000, [0.2, 0.0], 0.0), (1700, [0.25, 0.1], -0.03)])
def test_a_diagram_stands_under_what_is_drawn(scale, centre, follow):
    """Its value at a pixel is that of the place of the machine which the drawing has there."""
    body = """
        const largest = outputs(), seen = data.pixels.map(px => { node.fire("pointermove", {clientX: px}); return outputs(); });
        node.fire("pointerleave");
        return [largest, seen, outputs(), shown, node.hidden];
    """
    pixels = [250, 300, 371]
    data = {"state": {"result": {"plots": PLOTS}}, "scale": scale, "centre": centre, "follow": follow, "pixels": pixels}
    largest, seen, again, shown, hidden = in_node(DIAGRAMS + body, data, store="createStore", diagrams="createDiagrams")
    assert largest == again == ["−900.0", "800.0"]  # the largest magnitude of each; there is no room here to say so
    for px, (moment, shear) in zip(pixels, seen, strict=True):
        place = 1e3 * ((px - 300) / scale + centre[0] + follow)
        assert float(shear) == pytest.approx(2 * place, abs=0.06)
        assert float(moment.replace("−", "-")) == pytest.approx(100 - 2.5 * place, abs=0.06)
    assert shown == [True] and hidden is False


def test_diagrams_share_the_height_and_follow_the_drawing_only_where_it_moved():
    body = """
        const count = () => canvas.context.calls.filter(([name]) => name === "clearRect").length;
        const heads = node.all().filter(each => each.classList.contains("dg-head")).map(each => [each.dataset.testid,
          each.style.transform]);
        const before = count();
        diagrams.draw(); const same = count() - before;
        view.scale *= 2; diagrams.draw(); const zoomed = count() - before;
        store.set({result: {plots: {diagrams: [], plots: []}}});
        return [heads, same, zoomed, node.hidden, diagrams.active(), shown, node.style["--dg-height"]];
    """
    data = {"state": {"result": {"plots": PLOTS}}, "scale": 1000, "centre": [0.2, 0], "follow": 0}
    heads, same, zoomed, hidden, active, shown, _ = in_node(DIAGRAMS + body, data, store="createStore", diagrams="createDiagrams")
    assert [name for name, _ in heads] == ["diagram-shaft/moment", "diagram-shaft/shear"]
    tops = [float(transform[len("translateY(") : -3]) for _, transform in heads]
    assert tops[0] == 2 and tops[1] - tops[0] == pytest.approx((400 - 38) / 2, abs=1)
    assert (same, zoomed) == (0, 1) and hidden and not active and shown == [True, False]


# -- the motion programme ------------------------------------------------------------------------------------------------------


def harmonic(angle, rise, law="cycloidal"):
    """A packed segment of simple harmonic motion."""
    x = np.linspace(0, 1, 61)
    course = [
        angle * x,
        rise * (1 - np.cos(np.pi * x)) / 2,
        rise * np.pi / 2 * np.sin(np.pi * x) / angle,
        rise * np.pi**2 / 2 * np.cos(np.pi * x) / angle**2,
        -rise * np.pi**3 / 2 * np.sin(np.pi * x) / angle**3,
    ]
    return {"law": law, "angle": angle, "rise": rise, "absolute": False, "points": [], "course": [packed(row) for row in course]}


PROGRAMME = {
    "cycle": {"span": 2 * math.pi, "factor": 180 / math.pi, "unit": "°", "label": "cam angle"},
    "lift": {"factor": 1e3, "unit": "mm", "angular": False},
    "speed": None,
    "list": "programme",
    "keys": {"angle": "angle", "rise": "rise", "law": "law", "points": "points"},
    "lawKeys": ["points"],
    "dwell": "dwell",
    "laws": [{"name": "dwell", "parameters": {}}, {"name": "cycloidal", "parameters": {}}],
    "segments": [
        harmonic(math.pi / 2, 0.02),
        harmonic(math.pi / 2, 0.0, "dwell"),
        harmonic(math.pi / 2, -0.015),
        harmonic(math.pi / 2, -0.005),
    ],
}


def fields_of(*segments):
    """The form's fields of (law, angle, unit, rise) of each segment."""
    made = []
    for n, (law, angle, unit, rise) in enumerate(segments):
        made.append({"key": f"programme.{n}.law", "text": law, "value": law, "unit": ""})
        made.append({"key": f"programme.{n}.angle", "text": "", "value": angle, "unit": unit})
        made.append({"key": f"programme.{n}.rise", "text": "", "value": rise, "unit": "mm"})
    return made


STATED = fields_of(
    ("cycloidal", 90, "deg", 20), ("dwell", math.pi / 2, "rad", None), ("cycloidal", 90, "deg", -15), ("cycloidal", None, "deg", -5)
)
MOTION = (
    STORE
    + """
    const host = new Part("div"), form = createMotionForm(host, tools), part = name => host.named(`programme-${name}`)[0];
    form.open(); resized();
    const choose = n => part(`segment-${n}`).fire("click");
    const texts = () => host.querySelectorAll("canvas")[0].context.calls.filter(([name]) => name === "fillText").map(([, text]) => text);
"""
)


def programme(body, fields=STATED, **more):
    design = {"opened": 1, "kind": "cam", "title": "Cam", "locks": [], "form": {"groups": [{"fields": fields}]}}
    state = {"design": design, "scene": {"programme": {**PROGRAMME, **more}}}
    return in_node(MOTION + body, {"state": state}, store="createStore", motion_form="createMotionForm")


def test_boxes_of_a_segment_show_its_numbers_and_the_last_angle_is_the_rest_of_the_turn():
    found = programme("return [0, 1, 2, 3].map(n => { choose(n); return [part('angle').value, part('rise').value, part('law').value]; });")
    assert found[0] == ["90 deg", "20 mm", "cycloidal"] and found[1] == ["1.570796 rad", "", "dwell"]
    assert found[2] == ["90 deg", "-15 mm", "cycloidal"] and found[3] == ["90 deg", "-5 mm", "cycloidal"]


def test_halves_and_sums_of_angles_keep_the_unit_and_make_a_whole():
    body = """
        choose(0); part("add").fire("click"); const half = said.at(-1).elements.slice(0, 2).map(each => each.changes.angle);
        store.set({refused: {}}); choose(2); part("drop").fire("click"); const sum = said.at(-1).elements.map(each => each.changes);
        return [half, sum];
    """
    half, changes = programme(body)
    assert half == ["45 deg", "45 deg"]
    kept, dwell, last = changes
    assert kept == {} and list(dwell) == ["angle"] and dwell["angle"].endswith(" rad")
    assert float(dwell["angle"].split()[0]) == pytest.approx(math.pi)  # a quarter turn in radians and one in degrees
    assert last == {"rise": "-20 mm"}


def test_two_halves_of_a_long_number_are_the_whole():
    fields = [{**field, "value": 33.3333333333} if field["key"] == "programme.0.angle" else field for field in STATED]
    half = programme(
        "choose(0); part('add').fire('click'); return said.at(-1).elements.slice(0, 2).map(each => each.changes.angle);", fields
    )
    assert abs(sum(float(text.split()[0]) for text in half) - 33.3333333333) < 2e-11


@pytest.mark.parametrize(("angular", "unit"), [(False, "mm"), (True, "deg")])
def test_a_dwell_that_begins_to_move_does_so_in_the_unit_of_the_lift(angular, unit):
    """By a quarter of the stroke, which the next segment gives back."""
    body = "choose(1); typed(part('law'), 'cycloidal', 'change'); return said.at(-1).elements.map(each => each.changes.rise);"
    rises = programme(body, lift={**PROGRAMME["lift"], "angular": angular})
    assert rises[1].split()[1] == unit and rises[2].split()[1] == "mm"
    si = math.pi / 180 if angular else 1e-3
    assert float(rises[1].split()[0]) * si == pytest.approx(0.005) and float(rises[2].split()[0]) == pytest.approx(-20)


@pytest.mark.parametrize(
    ("speed", "angular", "titles", "peaks"),
    [
        (None, False, ["First derivative [mm/rad]", "Second derivative [mm/rad²]"], ["peak 20\u00a0mm/rad", "peak 40\u00a0mm/rad²"]),
        (10.0, False, ["Velocity [m/s]", "Acceleration [m/s²]"], ["peak 0.2\u00a0m/s", "peak 4\u00a0m/s²"]),
        (10.0, True, ["Velocity [rad/s]", "Acceleration [rad/s²]"], ["peak 0.2\u00a0rad/s", "peak 4\u00a0rad/s²"]),
        (None, True, ["First derivative [rad/rad]", "Second derivative [rad/rad²]"], ["peak 0.02\u00a0rad/rad", "peak 0.04\u00a0rad/rad²"]),
    ],
)
def test_peaks_are_those_of_the_motion_at_its_speed(speed, angular, titles, peaks):
    """Harmonic over a quarter turn: v = h pi / (2 b), a = h pi² / (2 b²) with b = pi / 2; the jerk has no end where a jumps."""
    lift = {"factor": 180 / math.pi, "unit": "°", "angular": True} if angular else PROGRAMME["lift"]
    drawn, status = programme("return [texts(), part('continuity').textContent];", speed=speed, lift=lift)
    assert {*titles, *peaks, "peak ∞"} <= set(drawn)
    assert status.endswith("acceleration jumps at 0°, 90°, 180°, 270°") and status.startswith(
        "Lift 1.146°" if angular else "Lift 20\u00a0mm"
    )


def test_what_the_design_has_is_drawn_where_the_scene_is_late():
    """Stretched to the numbers of the form where the segments are the same, else marked as old."""
    body = """
        const old = () => host.children[1].classList.contains("is-old"), first = [part("border-1").style.transform, old()];
        const set = fields => store.set({design: {...store.state.design, form: {groups: [{fields}]}}});
        const fields = store.state.design.form.groups[0].fields, other = more => fields.map(field => ({...field,
          ...more[field.key] || {}}));
        set(other({"programme.0.angle": {value: 60}, "programme.2.angle": {value: 120}}));
        const second = [part("border-1").style.transform, old()];
        set(other({"programme.0.law": {text: "dwell", value: "dwell"}})); const third = old();
        return [first, second, third];
    """
    first, second, third = programme(body)
    width = 600 - 58 - 16
    x = [float(transform[len("translate(") :].split("px")[0]) for transform, _ in (first, second)]
    assert x == pytest.approx([58 + width / 4, 58 + width / 6], abs=0.06) and not first[1] and not second[1] and third


PLOT = """
    const canvas = new Part("canvas"), plot = createMotionPlot(canvas, () => {});
    resized();
    const row = Float32Array.from([0, 0.5, 1]);
    const segment = (start, s, v) => ({start, end: start + Math.PI, course: [row.map(x => start + Math.PI * x), s, v, v,
      v].map(each => Float32Array.from(each))});
    const programme = (high = 0.02) => ({cycle: {span: 2 * Math.PI, factor: 180 / Math.PI, unit: "°"},
      segments: [segment(0, [0.01, high, 0.015], [1, 2, 3]), segment(Math.PI, [0.015, 0.012, 0.01], [3, 2, 1])]});
    const titles = [0, 1, 2, 3].map(n => [`row ${n}`, "peak"]), colours = new Proxy({}, {get: (_, name) => name});
    const show = (more = {}) => plot.show({programme: programme(more.high), jumps: [], selected: 0, factors: [1e3, 1, 1, 1], titles,
      axis: "angle", ...more}, colours);
    show();
"""


def test_places_of_the_programme_go_to_pixels_and_back():
    body = (
        PLOT
        + """
        const ends = [plot.toX(0), plot.toX(2 * Math.PI)], rows = [0, 1, 2, 3].map(plot.rowAt), back = [plot.fromX(plot.toX(1.2)),
          plot.fromY(plot.toY(0.013))];
        return [ends, rows, plot.bottom(), back, [plot.toY(0.01), plot.toY(0.02)]];
    """
    )
    ends, rows, bottom, back, (low, high) = in_node(body, None, motion_plot="createMotionPlot")
    assert ends == [58, 600 - 16] and back == pytest.approx([1.2, 0.013])
    for (top, tall), (below, less) in zip(rows, rows[1:], strict=False):
        assert below == pytest.approx(top + tall + 22) and less == pytest.approx(rows[1][1])
    assert rows[0][0] == 30 and rows[0][1] == pytest.approx(2 * rows[1][1]) and bottom == pytest.approx(400 - 34)
    assert (
        high > rows[0][0] and low < rows[0][0] + rows[0][1] and low - high == pytest.approx(rows[0][1] / 1.16)
    )  # 8 % of air on both sides


def test_the_axis_of_the_lift_stays_while_a_hand_holds_it_and_derivatives_show_zero():
    body = (
        PLOT
        + """
        const before = plot.toY(0.02);
        show({high: 0.04, held: true}); const held = plot.toY(0.02);
        show({high: 0.04}); const after = plot.toY(0.02);
        canvas.context.calls.length = 0;
        show({jumps: [{at: Math.PI, order: 1}, {at: 2, order: 2}]});
        const calls = canvas.context.calls, strong = calls.filter(([name, style]) => name === "stroke" && style === "grid-strong").length;
        return [before, held, after, strong, calls.filter(([name, style]) => name === "stroke" && ["bad",
          "warn"].includes(style)).map(([, style]) => style)];
    """
    )
    before, held, after, zeros, stripes = in_node(body, None, motion_plot="createMotionPlot")
    assert held == before and after > before + 5
    assert zeros == 3  # of velocity, acceleration and jerk; the lift, from 10 mm on, has none
    assert stripes == ["bad", "warn"]
