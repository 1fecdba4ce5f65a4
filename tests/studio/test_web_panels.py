"""Panels of the page, run in node: measurements, the builder, the choice of plots, diagrams under the drawing, the programme."""

import base64
import math
import struct

import numpy as np
import pytest
from in_node import in_node

pytestmark = pytest.mark.interface


def packed(values):
    """Numbers as the studio packs them: base64 of float32."""
    return base64.b64encode(struct.pack(f"<{len(values)}f", *values)).decode()


STORE = """
    const said = [];
    const store = createStore({design: {opened: 1, kind: "toy", title: "Toy", form: {groups: []}, locks: []}, ...data.state});
    const clock = {playing: false, phase: 0, told: [], set(phase) { clock.phase = phase; clock.told.push(phase);
    }, pause() { clock.told.push("pause"); },
      subscribe() { return () => {}; }};
    const tools = {store, say: message => said.push(message), t, clock};
    const typed = (part, text, name = "input") => { part.value = text; part.fire(name); };
    const ticked = (part, on) => { part.checked = on; part.fire("change"); };
"""

# -- measurements --------------------------------------------------------------------------------------------------------------

LIST = (
    STORE
    + """
    const acts = {choose: kind => said.push(["choose", kind]), pick: ({ref}) => said.push(["pick", ref]),
      remove: id => said.push(["remove", id]), close() {}};
    const list = createMeasureList(tools, acts, handle => handle.name), part = name => list.node.named(name)[0];
    list.reword();
    const u = Float32Array.from({length: 5}, (_, n) => n / 4);
    const course = (values, constant = false) => ({u, values, low: Math.min(...values), high: Math.max(...values),
      lowAt: u[values.indexOf(Math.min(...values))], highAt: u[values.indexOf(Math.max(...values))], constant});
    const feature = (kind, label, more = {}) => ({kind, label, of: "crank", ref: label + Math.random(), ...more});
    const base = {on: true, kind: "distance", picked: [], wanted: ["point"], features: [], measures: [], cycle: {label: "crank angle",
      unit: "°", start: 0, span: 360}};
"""
)


def measured(body, **more):
    return in_node(LIST + body, {"state": {}, **more}, store="createStore", measure_list="createMeasureList")


def test_a_measurement_says_its_range_its_ends_and_where_they_are():
    body = """
        const parts = [feature("point", "A"), feature("point", "centre on *")];
        const moving = {id: 1, kind: "distance", role: "blue", parts, now: parts, course: course([0.02, 0.05, 0.03, 0.01, 0.02])};
        const level = course([-0.03, -0.03, -0.03, -0.03, -0.03], true);
        const still = {id: 2, kind: "vertical", role: "green", parts, now: parts, course: level};
        const gone = {id: 3, kind: "distance", role: "orange", parts, now: [parts[0], undefined], course: null};
        list.show({...base, measures: [moving, still, gone]});
        list.follow([[1, "33 mm"], [9, "x"]], 0.25);
        const rows = list.node.all().filter(each => each.classList.contains("ms-row"));
        return rows.map(row => {
          const one = name => row.named(name)[0], cursor = row.querySelectorAll("line")[0].attributes;
          const name = row.all().find(each => each.classList.contains("ms-name")).textContent, path = row.querySelectorAll("path").at(-1);
          return [name, one("measure-value").textContent, one("measure-range").textContent, one("measure-range").hidden,
            one("measure-ends").textContent, one("measure-svg").hidden, path.attributes.d ?? "", cursor.x1, cursor.x2];
        });
    """
    moving, still, gone = measured(body)
    assert moving[:6] == [
        "Distance: A – centre on crank",
        "33 mm",
        "range 40.000\u00a0mm",
        False,
        "min 10.000\u00a0mm at 270.0° · max 50.000\u00a0mm at 90.0°",
        False,
    ]
    points = [tuple(map(float, pair.split())) for pair in moving[6][1:].split("L")]
    assert [x for x, _ in points] == [0, 50, 100, 150, 200] and moving[7:] == ["50", "50"]
    assert [y for _, y in points] == pytest.approx([21, 3, 15, 27, 21])  # 3 px from both edges of 30, the largest value on top
    assert still[3:6] == [True, "constant over the cycle", True] and still[6] == ""
    assert gone[1] == "–" and gone[4] == "not in this design" and gone[0].startswith("Distance: A – centre on")


def test_what_may_be_picked_by_name_is_numbered_where_names_repeat():
    body = """
        const circle = radius => feature("circle", "circle of *", {radius}), pin = feature("point", "", {handle: {name: "crank pin"}});
        const features = [feature("point", "A"), circle(0.005), circle(0.005), circle(0.00625), pin, feature("line", "edge of *")];
        const names = () => part("measure-point").options.map(one => one.textContent);
        list.show({...base, features, wanted: ["circle"]});
        const circles = names();
        list.show({...base, features, wanted: ["point", "line"], kind: "angle"});
        const hint = list.node.all().find(each => each.classList.contains("ms-hint")).textContent;
        part("measure-point").value = features[4].ref; part("measure-pick").fire("click"); part("measure-radius").fire("click");
        return [circles, names(), hint, said, features[4].ref,
          list.node.named("measure-").filter(each => each.attributes["aria-pressed"] === "true").length];
    """
    circles, both, hint, said, ref, pressed = measured(body)
    assert circles == ["circle of crank R 5.00", "circle of crank R 5.00 (2)", "circle of crank R 6.25"]
    assert both == ["A", "crank pin", "edge of crank"] and hint == "Pick three points, or two edges" and pressed == 1
    assert said == [["pick", ref], ["choose", "radius"]]


@pytest.mark.parametrize(
    ("kind", "values", "shown"),
    [
        ("distance", [0.01, 0.04], True),
        ("distance", [0.02, 0.02], True),
        ("angle", [0.1, 0.2], False),
        ("radius", [0.01, 0.01], False),
        ("vertical", [-0.01, -0.01], True),
        ("distance", [0.0, 0.0], False),
    ],
)
def test_lengths_that_are_there_can_be_scaled(kind, values, shown):
    """By their range where they move, else by their size; the wanted length begins with it."""
    body = """
        const parts = [feature("point", "A"), feature("point", "B")], values = [...data.values, ...data.values.slice(0, 1)];
        list.show({...base, measures: [{id: 1, kind: data.kind, role: "blue", parts, now: parts, course: course(values,
          values[0] === values[1])}]});
        const scale = part("measure-scale");
        if (!scale.hidden) scale.fire("click");
        return [!scale.hidden, scale.hidden ? "" : list.node.named("measure-wanted")[0].value];
    """
    field = {"key": "ground.points.A.0", "value": 1, "unit": "mm"}
    state = {"design": {"opened": 1, "locks": [], "form": {"groups": [{"fields": [field]}]}}}
    there, begins = measured(body, kind=kind, values=values, state=state)
    size = values[1] - values[0] or abs(values[0])
    assert there == shown and begins == (f"{size * 1e3:g} mm" if shown else "")


def test_a_press_in_the_small_plot_sets_the_clock():
    body = """
        const parts = [feature("point", "A"), feature("point", "B")];
        list.show({...base, measures: [{id: 1, kind: "distance", role: "blue", parts, now: parts, course: course([0.01, 0.02, 0.03,
          0.02, 0.01])}]});
        const plot = list.node.querySelectorAll("svg").at(-1);
        plot.box = {left: 100, top: 0, width: 200, height: 30};
        plot.fire("pointermove", {clientX: 250, pointerId: 3});
        plot.fire("pointerdown", {clientX: 150, pointerId: 3}); plot.fire("pointermove", {clientX: 280, pointerId: 3});
        plot.fire("pointermove", {clientX: 120, pointerId: 4});
        return clock.told;
    """
    assert measured(body) == ["pause", 0.25, "pause", 0.9]


# -- building ------------------------------------------------------------------------------------------------------------------

BUILDER = (
    STORE
    + """
    const view = {width: 600, height: 400, scale: 2000, middle: () => [0.05, 0.01], zoom() {}};
    view.toX = x => view.width / 2 + (x - 0.05) * view.scale;
    view.toY = y => view.height / 2 - (y - 0.01) * view.scale;
    const poses = {"-1": data.frame ?? [0, 0, 0], 0: [0.02, 0.005, 0.7]};
    const player = {view, poseOf: body => poses[body], redraw() {}};
    const builder = createBuilder(() => player, tools), host = new Part("div");
    host.append(builder.layer);
    const sheet = builder.layer.named("build-sheet")[0];
    sheet.box = {left: 10, top: 20, width: 600, height: 400};
    builder.load({handles: [{body: 0, point: [0.03, 0.01]}]});
    const at = ([x, y], dx = 0, dy = 0) => ({clientX: view.toX(x) + 10 + dx, clientY: view.toY(y) + 20 + dy, button: 0});
    const press = (point, more = {}, ...off) => sheet.fire("pointerdown", {...at(point, ...off), ...more});
    const use = name => builder.layer.named(`tool-${name}`)[0].fire("click");
    const key = (name, more = {}) => sheet.fire("keydown", {key: name, ...more});
    builder.button.fire("click");
    const built = () => said.filter(({what}) => what === "construct");
"""
)
KINDS = [
    {
        "kind": "toy",
        "tools": [
            {"name": "body", "label": "Body", "hint": "Click", "fewest": 2, "most": 3},
            {"name": "drive", "label": "Drive", "hint": "Click", "fewest": 1, "most": 1, "picks": True},
            {"name": "force", "label": "Force", "hint": "Click", "fewest": 1, "most": 1},
        ],
    }
]


def building(body, **more):
    return in_node(BUILDER + body, {"state": {"kinds": KINDS}, **more}, store="createStore", builder="createBuilder")


@pytest.mark.parametrize("frame", [[0, 0, 0], [0.01, -0.02, 0.4]])
def test_a_click_is_a_place_of_the_machine_at_its_start(frame):
    """In the frame of the machine, wherever that is seen; Alt takes the pixel itself.  A tool for what is there does so too."""
    x, y, angle = frame
    c, s = math.cos(angle), math.sin(angle)
    mine = [0.0412345, -0.0123456]
    seen = [x + c * mine[0] - s * mine[1], y + s * mine[0] + c * mine[1]]
    body = "use('force'); press(data.seen, {altKey: true}); use('drive'); press(data.seen); use('force'); press(data.seen); return built();"
    exact, picked, grid = building(body, frame=frame, seen=seen)
    assert exact["places"][0] == pytest.approx(mine, abs=1e-9) and picked["places"][0] == pytest.approx(mine, abs=1e-9)
    assert grid["places"][0] == pytest.approx(mine, abs=5e-3) and grid["places"][0] != pytest.approx(mine, abs=1e-6)
    assert [each["tool"] for each in (exact, picked, grid)] == ["force", "drive", "force"] and exact["near"] == pytest.approx(9 / 2000)
    (step,) = {round(part * 1e3, 9) % 5 for part in grid["places"][0]}  # 10 px are 5 mm here
    assert step == 0


def test_a_click_falls_upon_a_point_within_nine_pixels():
    c, s = math.cos(0.7), math.sin(0.7)
    point = [0.02 + 0.03 * c - 0.01 * s, 0.005 + 0.03 * s + 0.01 * c]
    near, far = building(
        "use('force'); press(data.point, {}, 5, -6); press(data.point, {altKey: true}, 8, -7); return built();", point=point
    )
    assert near["places"][0] == pytest.approx(point, abs=1e-9)
    assert far["places"][0] == pytest.approx([point[0] + 8 / 2000, point[1] + 7 / 2000], abs=1e-9)


def test_a_tool_ends_with_its_most_places_or_when_a_person_says_so_with_enough():
    body = """
        const counts = [];
        press([0.01, 0]); key("Enter"); counts.push(built().length);
        press([0.03, 0]); press([0.03, 0]); counts.push(built().length);
        key("Enter"); counts.push(built().length);
        press([0.01, 0]); press([0.03, 0]); press([0.05, 0.02]); counts.push(built().length);
        press([0.01, 0]); key("Escape"); key("Enter"); counts.push(built().length);
        press([0.01, 0]); press([0.03, 0]); sheet.fire("dblclick"); counts.push(built().length);
        press([0.02, 0],
          {button: 2}); counts.push(builder.layer.querySelectorAll("circle").filter(each => each.classList.contains("is-set")).length);
        return [counts, built().map(({places}) => places.length)];
    """
    counts, sizes = building(body)
    assert counts == [0, 0, 1, 2, 2, 3, 0] and sizes == [2, 3, 2]  # one place is no body, and the second click of a double one is none


def test_arrow_keys_move_a_place_by_twelve_pixels_or_one():
    """From the middle of the drawing, the space bar sets it; y goes up on the machine and down on the page."""
    body = """
        use('force'); key('ArrowRight'); key('ArrowUp', {shiftKey: true}); key(' '); key('ArrowLeft', {ctrlKey: true}); key(' ');
        return built();
    """
    first, second = building(body)
    assert first["places"][0] == pytest.approx([0.05 + 12 / 2000, 0.01 + 1 / 2000]) == second["places"][0]


def test_what_is_missing_and_refused_is_said_and_the_sketch_ends_with_the_builder():
    body = """
        const words = () => builder.layer.named("build-words")[0].textContent, missing = builder.layer.named("build-missing")[0];
        const open = [builder.active(), clock.phase, words(), missing.children.map(each => each.textContent)];
        store.set({refused: {"": {message: "no body here"}}});
        const bad = words();
        use("drive"); const other = words();
        store.set({refused: {"": {message: "no pin here"}}}); const again = words();
        key("Escape");
        return [open, bad, other, again, builder.active(), said.filter(({what}) => what === "sketch").map(({on}) => on)];
    """
    opened, bad, other, again, active, sketch = building(body, state={"kinds": KINDS, "scene": {"missing": ["add a drive"]}})
    assert opened == [True, 0, "Click", ["add a drive"]] and bad == "no body here" and other == "Click" and again == "no pin here"
    assert active is False and sketch == [True, False]


# -- the choice of plots -------------------------------------------------------------------------------------------------------

PICKER = (
    STORE
    + """
    let chosen = data.chosen;
    const heard = [];
    const plots = [
      {name: "force", title: "Forces", panels: [{id: "force/a", series: [{label: "pin A"}]}, {id: "force/b", series: [{label: "pin B"}]}]},
      {name: "lift", title: "Lift", panels: [{id: "lift/s", series: [{label: "lift"}]}]},
      {name: "map", title: "Map of speeds", panels: [], picture: true}];
    const picker = createPicker(tools, {chosen: () => chosen, choose(ids) { heard.push(ids); chosen = ids ?? ["lift/s"];
    }, plots: () => plots});
    const open = picker.node.named("plot-picker")[0];
    Object.assign(globalThis, {innerWidth: 1200});
    Part.prototype.querySelector = function(names) {
      return this.all().find(each => names.toUpperCase().split(", ").includes(each.tagName)) || null;
    };
    picker.show(); open.fire("click");
    const box = name => picker.node.named(`pick-${name}`)[0];
    const states = () => picker.node.querySelectorAll("input").filter(each => each.attributes.type === "checkbox")
      .map(each => [each.dataset.testid.slice(5), each.checked, Boolean(each.indeterminate)]);
"""
)


def picking(body, chosen):
    return in_node(PICKER + body, {"state": {}, "chosen": chosen}, store="createStore", picker="createPicker")


def test_boxes_of_a_plot_and_of_its_panels_agree():
    body = """
        const seen = [states()];
        ticked(box("force"), true); seen.push(states());
        ticked(box("force/b"), false); seen.push(states());
        ticked(box("map"), true); ticked(box("lift"), false);
        picker.node.named("plot-usual")[0].fire("click"); seen.push(states());
        picker.node.named("plot-none")[0].fire("click"); seen.push(states());
        return [seen, heard];
    """
    seen, heard = picking(body, ["lift/s", "force/a"])
    order = ["force", "force/a", "force/b", "lift", "map"]
    assert [[name for name, *_ in each] for each in seen] == [order] * 5
    ticks = [{name: "some" if some else on for name, on, some in each} for each in seen]
    assert ticks[0] == {"force": "some", "force/a": True, "force/b": False, "lift": True, "map": False}
    assert ticks[1] == {"force": True, "force/a": True, "force/b": True, "lift": True, "map": False}
    assert ticks[2] == ticks[0] and ticks[3] == {**dict.fromkeys(order, False), "lift": True} and ticks[4] == dict.fromkeys(order, False)
    assert heard == [["lift/s", "force/a", "force/b"], ["lift/s", "force/a"], ["lift/s", "force/a", "map"], ["force/a", "map"], None, []]


def test_plots_are_found_by_their_titles_and_the_names_of_their_lines():
    body = """
        const search = picker.node.named("plot-search")[0], none = picker.node.all().find(each => each.classList.contains("st-item-hint"));
        const found = text => { typed(search, text); return [...["force", "lift",
          "map"].map(name => !box(name).parentElement.parentElement.hidden), !none.hidden]; };
        return ["", " PIN b ", "speeds", "nothing like it"].map(found);
    """
    assert picking(body, []) == [
        [True, True, True, False],
        [True, False, False, False],
        [False, False, True, False],
        [False, False, False, True],
    ]


def test_how_many_of_all_are_shown_counts_only_those_there_are():
    words = "return [open.textContent, open.attributes['aria-label']];"
    (text, name) = picking(words, ["lift/s", "gone/x", "map"])
    assert text.endswith("2 of 4 shown") and name.endswith("2 of 4 shown")


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
    assert largest == again == ["largest −900.0", "largest 800.0"]  # the largest magnitude of each
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
