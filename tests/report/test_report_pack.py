"""The browser gets what the scene says: decoded here independently and compared."""

import base64
import json
from dataclasses import replace

import numpy as np
import pytest
from in_node import in_node
from sample_designs import FRAMES, PLOTS, four_bar_result, four_bar_scene

from drivewright.report.pack import FINENESS, MOST_ROWS, _fineness, envelope_rows, pack_handles, pack_plot_groups, pack_plots, pack_scene
from drivewright.result import Column, Plot, Table
from drivewright.scene import Handle, Outline, Shape, circle

pytestmark = pytest.mark.interface

SCENE, RESULT = four_bar_scene(), four_bar_result()


def array(text, columns=1):
    flat = np.frombuffer(base64.b64decode(text), "<f4")
    return flat.reshape(-1, columns) if columns > 1 else flat


def shapes_of(packed, things, number=0):
    return [packed["shapes"][n] for n in packed[things][number]["shapes"]]


def test_poses_arrive_with_continuous_angles():
    packed = pack_scene(SCENE)
    coupler = array(packed["motions"][packed["bodies"][1]["motion"]], 3)
    assert coupler[:, :2] == pytest.approx(SCENE.bodies[1].poses[:, :2], abs=1e-7)
    assert np.exp(1j * coupler[:, 2]) == pytest.approx(np.exp(1j * SCENE.bodies[1].poses[:, 2]), abs=1e-6)
    assert np.abs(np.diff(coupler[:, 2])).max() < 0.1
    wrapped = replace(SCENE.bodies[2], poses=np.column_stack([np.zeros((FRAMES, 2)), np.angle(np.exp(2j * SCENE.cycle))]))
    turned = pack_scene(replace(SCENE, bodies=(wrapped,), traces=()))
    assert np.ptp(array(turned["motions"][turned["bodies"][0]["motion"]], 3)[:, 2]) == pytest.approx(4 * np.pi, rel=1e-6)


def test_equal_motions_are_sent_once_and_still_ones_as_one_row():
    packed = pack_scene(SCENE)
    assert packed["observers"][2]["motion"] == packed["bodies"][1]["motion"]
    assert packed["observers"][0]["motion"] == packed["bodies"][0]["motion"]
    assert array(packed["motions"][packed["bodies"][0]["motion"]]).shape == (3,)
    assert len(packed["motions"]) == len(set(packed["motions"])) == 5


def test_cycle_and_marks_in_the_unit_people_read():
    cycle = pack_scene(SCENE)["cycle"]
    assert (cycle["label"], cycle["unit"], cycle["start"], cycle["span"]) == ("crank angle", "°", 0.0, pytest.approx(360.0))
    assert cycle["marks"] == [[0.0, "forward"], [pytest.approx(2.6 / 2 / np.pi), "return"], [pytest.approx(5 / 2 / np.pi), "dwell"]]


def test_a_cycle_of_uneven_steps_that_runs_backwards():
    angle = -(SCENE.cycle**2) / SCENE.cycle[-1] - 0.7
    scene = replace(SCENE, cycle=angle, marks=((angle[0] - 1.0, "on"),))
    packed = pack_scene(scene)
    assert array(packed["u"]) == pytest.approx((SCENE.cycle / SCENE.cycle[-1]) ** 2, abs=1e-6)
    assert packed["cycle"]["marks"] == [[pytest.approx(1 / 2 / np.pi), "on"]] and packed["cycle"]["span"] == pytest.approx(-360)


def test_arcs_become_chords_finer_than_a_pixel_at_twenty_fold_zoom():
    scene = replace(SCENE, bodies=(replace(SCENE.bodies[0], shapes=(Shape("body", circle((0, 0), 0.05)),)),), traces=())
    points = array(shapes_of(pack_scene(scene), "bodies")[0]["points"], 2)
    middle = np.hypot(*((points + np.roll(points, -1, axis=0)) / 2).T)
    assert np.hypot(*points.T) == pytest.approx(0.05) and 0.05 - middle.min() < 0.1 / 20 / 800


def test_open_and_closed_outlines_and_traces():
    packed = pack_scene(SCENE)
    ground = [shape["closed"] for shape in shapes_of(packed, "bodies")]
    assert ground == [s.outline.closed for s in SCENE.bodies[0].shapes] and False in ground
    assert packed["traces"] == [{"label": "coupler point", "body": 1, "point": [0.060, 0.046]}]
    assert packed["observers"][1]["advance"] == [-0.14, 0.0]


@pytest.mark.parametrize(("period", "sent"), [(0.3, 0.3), (np.inf, None), (0.0, None), (np.nan, None)])
def test_a_machine_without_speed_has_no_period(period, sent):
    assert pack_scene(replace(SCENE, period=period))["period"] == sent


def test_plots_over_the_cycle_are_linked_and_others_are_not():
    packed = pack_plots(RESULT, SCENE, PLOTS)
    titles = [panel["title"] for panel in packed["panels"]]
    assert titles == ["Rocker angle", "Rocker speed", "Rocker acceleration", "Angles at the rocker pin", "Radius of curvature"]
    rocker = packed["panels"][0]
    assert array(rocker["u"]) == pytest.approx(np.linspace(0, 1, FRAMES), abs=1e-7)
    assert array(rocker["series"][0]["data"]) == pytest.approx(np.degrees(RESULT.tables["motion"]["rocker"].data), rel=1e-6)
    assert packed["panels"][3]["limits"] == [[pytest.approx(40), "least 40°"]]
    assert np.isnan(array(packed["panels"][4]["series"][0]["data"])[0])
    json.dumps(packed, allow_nan=False)
    assert pack_plots(RESULT, replace(SCENE, table="nowhere"), PLOTS) is None


def shifted(start, span=2 * np.pi, rows=100):
    x = start + np.linspace(0, span, rows)
    return replace(
        RESULT,
        tables={
            **RESULT.tables,
            "forces": Table("forces", "Forces", (Column("angle", "rad", "crank angle", x), Column("force", "N", "force", np.cos(x)))),
        },
    )


def test_a_table_of_its_own_over_the_same_angle_is_linked_wherever_it_starts():
    panel = pack_plots(shifted(2.0), SCENE, PLOTS)["panels"][-1]
    u, force = array(panel["u"]), array(panel["series"][0]["data"])
    assert np.all(np.diff(u) >= 0) and u.min() >= 0 and u.max() <= 1
    assert force == pytest.approx(np.cos(2 * np.pi * u), abs=1e-5)


def test_a_table_over_several_turns_is_not_linked():
    assert len(pack_plots(shifted(0.0, 4 * np.pi), SCENE, PLOTS)["panels"]) == 5


def test_a_long_table_is_thinned_and_keeps_its_peaks():
    line = np.sin(np.linspace(0, 3, 50_000))
    line[31_417], line[777], line[9] = 5.0, -4.0, np.nan
    rows = envelope_rows([line, np.arange(50_000.0)])
    assert len(rows) <= MOST_ROWS + 2 and {0, 777, 31_417, 49_999} <= set(rows) and np.all(np.diff(rows) > 0)
    assert list(envelope_rows([line[:50]])) == list(range(50))


def test_shapes_of_any_outline_pack():
    half = Shape("ground", Outline(circle((0, 0), 1).pieces[:1], closed=False))
    packed = pack_scene(replace(SCENE, frames=(replace(SCENE.frames[0], shapes=(half,)),)))
    assert shapes_of(packed, "observers")[0]["closed"] is False


def test_bodies_of_the_same_shapes_send_them_once():
    first, second = SCENE.bodies[1:3]
    twins = replace(SCENE, bodies=(first, replace(second, shapes=first.shapes), second), traces=())
    packed = pack_scene(twins)
    one, twin, other = (body["shapes"] for body in packed["bodies"])
    assert one == twin == [0, 1, 2] and other == [3, 1] and len(packed["shapes"]) == 4 + len(SCENE.frames[1].shapes)
    assert [shape["layer"] for shape in packed["shapes"]] == ["body", "hole", "hole", "body", "ground"]


def test_a_scene_that_grows_a_little_keeps_the_chords_of_its_curves():
    def points(radius):
        bar = replace(SCENE.bodies[0], shapes=(Shape("body", circle((0, 0), 0.01)), Shape("body", circle((0, 0), radius))))
        return shapes_of(pack_scene(replace(SCENE, bodies=(bar,), traces=())), "bodies")[0]["points"]

    assert points(0.2) == points(0.201) and len(points(0.2)) > len(points(2.0))


def test_what_is_drawn_larger_tells_where_it_would_rest():
    body = SCENE.bodies[1]
    rest = body.poses * (1.0, 0.0, 1.0)
    free = pack_scene(replace(SCENE, bodies=(replace(body, rest=rest, magnified=40.0),), traces=()))
    (sent,) = free["bodies"]
    assert sent["magnified"] == 40.0 and "most" not in sent
    assert array(free["motions"][sent["rest"]], 3)[:, :2] == pytest.approx(rest[:, :2], abs=1e-7)
    assert array(free["motions"][sent["rest"]], 3)[:, 2] == pytest.approx(array(free["motions"][sent["motion"]], 3)[:, 2], abs=1e-7)
    (held,) = pack_scene(replace(SCENE, bodies=(replace(body, rest=rest, most=1.0),), traces=()))["bodies"]
    assert held["most"] == 1.0
    plain = pack_scene(SCENE)["bodies"][1]
    assert not {"rest", "most", "magnified"} & set(plain)
    json.dumps(free, allow_nan=False)


def test_what_is_drawn_for_a_part_of_the_cycle_tells_its_frames():
    frames = len(SCENE.cycle)
    shown = np.isin(np.arange(frames), [0, 1, 5, frames - 2, frames - 1])
    (sent,) = pack_scene(replace(SCENE, bodies=(replace(SCENE.bodies[1], shown=shown),), traces=()))["bodies"]
    assert sent["shown"] == [[0, 1], [5, 5], [frames - 2, frames - 1]]
    body = "return [0.0, 1.4, 1.6, 4.6, 5.4].map(at => isDrawn(data, Math.floor(at), at % 1)).concat(isDrawn({}, 0, 0));"
    assert in_node(body, sent, scene="isDrawn") == [True, True, False, True, True, True]
    assert "shown" not in pack_scene(SCENE)["bodies"][1]


def test_groups_hold_the_same_panels_plot_by_plot():
    groups, flat = pack_plot_groups(RESULT, SCENE, PLOTS), pack_plots(RESULT, SCENE, PLOTS)
    assert [(plot["name"], plot["title"], len(plot["panels"])) for plot in groups["plots"]] == [
        ("rocker", "Rocker angle", 1),
        ("speed", "Rocker speed and acceleration", 2),
        ("transmission", "Angles at the rocker pin", 1),
        ("radius", "Radius of curvature", 1),
    ]
    assert json.dumps([panel for plot in groups["plots"] for panel in plot["panels"]]) == json.dumps(flat["panels"])
    assert groups["cycle"] == flat["cycle"] and pack_plot_groups(RESULT, replace(SCENE, table="nowhere"), PLOTS) is None


@pytest.mark.parametrize("size", [1e-3, 0.2, 0.7, 13.0])
def test_chords_are_at_most_twice_as_fine_as_they_need_to_be_and_change_by_halves(size):
    fine = _fineness(size)
    assert FINENESS * size / 2 < fine <= FINENESS * size and np.log2(fine) == round(np.log2(fine))


def test_handles_of_the_frame_and_of_bodies_that_are_drawn():
    first = SCENE.bodies[0].name
    handles = (
        Handle("ground.O", (0.1, 0.2)),
        Handle("size", (0.3, 0.0), (1.0, 0.0), first, "size"),
        Handle("gone", (0.0, 0.0), None, "a body that is not drawn"),
    )
    found = pack_handles(replace(SCENE, handles=handles))
    assert [(each["key"], each["body"]) for each in found] == [("ground.O", -1), ("size", 0)]
    assert found[0]["point"] == [0.1, 0.2] and "direction" not in found[0] and found[1]["direction"] == [1.0, 0.0]


def test_the_ground_is_shaded_where_a_column_says_so():
    """Between a quarter and a half of the turn, however the angle is read."""
    motion = RESULT.tables["motion"]
    angle = motion["angle"].data
    share = (angle - angle[0]) / (angle[-1] - angle[0])
    shaded = Column("dwell", "-", "dwell", np.where((share >= 0.25) & (share <= 0.5), 1.0, 0.0))
    result = replace(RESULT, tables={**RESULT.tables, "motion": replace(motion, columns=(*motion.columns, shaded))})
    (panel,) = pack_plots(result, SCENE, (Plot("rocker", "Rocker", "motion", "angle", ("rocker",), shade="dwell"),))["panels"]
    (stretch,) = panel["shade"]
    assert stretch == pytest.approx([0.25, 0.5], abs=1.5 / (len(angle) - 1))
