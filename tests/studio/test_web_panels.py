"""Panels of the page, run in node: measurements, the builder, the choice of plots."""

import math

import pytest
from in_node import STORE, in_node

pytestmark = pytest.mark.interface


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
    const press = (point, more = {}, ...off) =>
      ["pointerdown", "pointerup"].forEach(what => sheet.fire(what, {...at(point, ...off), ...more}));
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
