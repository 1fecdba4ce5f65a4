"""The drawn mechanism is the computed one: rollers lie on their cams, gears mesh, the rod runs along its line, parts fit together."""

from dataclasses import replace

import numpy as np
import pytest
import shapely
from places import EXAMPLES

import drivewright as dw
from drivewright.mechanisms.seedling_pusher import scene as pusher_scene
from drivewright.mechanisms.seedling_pusher.build import build
from drivewright.scene import Shape, place

pytestmark = pytest.mark.property

FRAMES = (0, 37, 70, 76, 84, 90, 110, 118, 200, 305)


@pytest.fixture(scope="module", params=["seedling_pusher_improved", "mirrored", "far"])
def drawn(request):
    changes = {"mirrored": ["cams.orbit=clockwise"], "far": ["train.start=far"]}.get(request.param, [])
    model = build(dw.load(EXAMPLES / "seedling_pusher_improved.toml", changes))
    made = pusher_scene.scene(model)
    return model, made, {body.name: body for body in made.bodies}


def polygon(body, layer, frame):
    shape = next(s for s in body.shapes if s.layer == layer)
    return shapely.Polygon(place(shape.outline.points(2e-6), body.poses[frame]))


def centres(body, layer, frame):
    points = [s.outline.points(1e-7).mean(axis=0) for s in body.shapes if s.layer == layer]
    return place(np.array(points), body.poses[frame])


@pytest.mark.parametrize("frame", FRAMES)
def test_each_roller_touches_its_cam(drawn, frame):
    model, _, bodies = drawn
    for cam, centre in zip(model.pair.cams, centres(bodies["lever"], "roller", frame), strict=True):
        profile = polygon(bodies[f"cam.{cam.name}"], "profile", frame)
        assert profile.exterior.distance(shapely.Point(centre)) == pytest.approx(cam.roller_radius, abs=6e-6)
        assert not profile.contains(shapely.Point(centre))


@pytest.mark.parametrize("frame", FRAMES)
def test_the_gears_mesh_without_overlap(drawn, frame):
    _, _, bodies = drawn
    sun, middle, planet = (polygon(bodies[name], "body", frame) for name in ("sun", "intermediate", "planet"))
    tooth = 1.5e-3**2
    for one, other in ((sun, middle), (middle, planet)):
        assert one.intersection(other).area < 2e-3 * tooth
        assert one.distance(other) < 0.02e-3


def test_the_tip_and_the_axis_are_those_of_the_model(drawn):
    model, made, bodies = drawn
    for trace, jet in (("tip", model.arm.point(made.cycle)), ("axis", model.arm.axis(made.cycle))):
        point = next(t.point for t in made.traces if t.name == trace)
        path = np.array([place(np.array([point]), pose)[0] for pose in bodies["arm"].poses])
        assert path[:, 0] + 1j * path[:, 1] == pytest.approx(jet.d0, abs=1e-15)


def test_the_rod_end_is_on_its_line_beside_the_needle_and_moves_by_the_travel(drawn):
    """In the frame of the arm, by the needle: rod.needle_distance from its line, from one stroke behind its tip to one level with it."""
    model, made, bodies = drawn
    distance = dw.run(model.spec, only=("planting",), model=model)["rod.needle_distance"]
    t = made.cycle
    rotation, tip = model.arm.rotation(t).d0, model.arm.point(t).d0
    along = np.exp(1j * rotation) * model.needle
    off = (model.rod_end(t) - tip) * np.conj(along)  # behind the tip, and across
    assert np.abs(off.imag) == pytest.approx(np.full(len(t), distance), abs=1e-12)
    assert off.real == pytest.approx(model.pair.travel(t).d0 - model.spec.push.stroke, abs=1e-12)
    assert np.angle(along) == pytest.approx(np.angle(np.exp(-1j * model.needle_angle(t))), abs=1e-12)
    drawn_end = next(trace for trace in made.traces if trace.name == "rod_end")
    path = np.array([place(np.array([drawn_end.point]), pose)[0] for pose in bodies[drawn_end.body].poses])
    assert path[:, 0] + 1j * path[:, 1] == pytest.approx(model.rod_end(t), abs=1e-14)
    shape = polygon(bodies["rod"], "body", 0)
    assert shape.exterior.distance(shapely.Point(*path[0])) == pytest.approx(2e-3, abs=1e-5), "the round end of a rod of 4 mm"


def test_the_table_holds_the_rod_end(drawn):
    model, _, _ = drawn
    table = dw.run(model.spec, only=("train",), model=model).tables["cycle"]
    end = model.rod_end(table["carrier_angle"].data)
    assert (table["rod_end_x"].data, table["rod_end_y"].data) == (pytest.approx(end.real, abs=1e-15), pytest.approx(end.imag, abs=1e-15))
    back, front = model.rod_ends
    assert abs(front - back) == pytest.approx(model.spec.lever.rod_length, rel=1e-12)


def test_the_rod_moves_along_the_needle_by_its_travel(drawn):
    model, made, bodies = drawn
    for frame in FRAMES:
        arm, rod = bodies["arm"].poses[frame], bodies["rod"].poses[frame]
        moved = complex(*(rod - arm)[:2]) * np.exp(-1j * arm[2])
        assert moved == pytest.approx(model.pair.travel(made.cycle[frame]).d0 * model.needle, abs=1e-15)


def test_the_lever_reaches_the_rod(drawn):
    """The rod's line is at the end of the output arm, which swings by atan(travel / arm)."""
    model, made, bodies = drawn
    back, front = model.rod_ends
    for frame in FRAMES:
        lever, rod = bodies["lever"].poses[frame], bodies["rod"].poses[frame]
        arm = model.outwards * np.exp(1j * lever[2])
        ends = place(np.array([[z.real, z.imag] for z in (back, front)]), rod)
        line = shapely.LineString(ends + (ends - ends.mean(axis=0)) * 5)
        far = complex(*lever[:2]) + arm * model.spec.lever.output_arm / np.cos(model.pair.swing(made.cycle[frame]).d0)
        assert line.distance(shapely.Point(far.real, far.imag)) < 1e-12


def test_the_field_observer_sees_one_plant_per_turn(drawn):
    model, made, _ = drawn
    field = next(frame for frame in made.frames if frame.name == "field")
    assert field.poses[-1] - field.poses[0] == pytest.approx([-0.14, 0, 0]) and field.advance == pytest.approx((-0.14, 0))
    assert made.period == pytest.approx(0.3)


def test_the_solids_stand_where_the_scene_starts(drawn):
    model, _, bodies = drawn
    parts = {part.name: part for part in pusher_scene.parts(model)}
    assert {
        "cam_main",
        "cam_return",
        "hub",
        "lever",
        "roller_main",
        "roller_return",
        "rod",
        "gear_sun",
        "gear_intermediate",
        "gear_planet",
    } <= set(parts)
    for cam in model.pair.cams:
        prism = parts[f"cam_{cam.name}"].solids[0]
        solid = shapely.Polygon(place(prism.outline.points(2e-6), parts[f"cam_{cam.name}"].pose))
        shown = polygon(bodies[f"cam.{cam.name}"], "profile", 0)
        assert solid.symmetric_difference(shown).area < model.display_tolerance * solid.length
        exact = replace(bodies[f"cam.{cam.name}"], shapes=tuple(pusher_scene.cam_shapes(model, cam, model.profiles)))
        assert solid.symmetric_difference(polygon(exact, "profile", 0)).area < 1e-9
        roller = parts[f"roller_{cam.name}"]
        assert roller.solids[0].z == prism.z, "roller and cam lie in one plane"
        centre = place(roller.solids[0].outline.points(1e-7), roller.pose).mean(axis=0)
        assert solid.exterior.distance(shapely.Point(centre)) == pytest.approx(cam.roller_radius, abs=6e-6)
    for name in ("sun", "intermediate", "planet"):
        part = parts[f"gear_{name}"]
        solid = shapely.Polygon(place(part.solids[0].outline.points(2e-6), part.pose))
        assert solid.symmetric_difference(polygon(bodies[name], "body", 0)).area < model.display_tolerance * solid.length
        exact = replace(bodies[name], shapes=(Shape("body", model.gear_outline),))
        assert solid.symmetric_difference(polygon(exact, "body", 0)).area < 1e-9


def test_an_even_tooth_count_is_refused():
    with pytest.raises(dw.SpecError, match="train.teeth: is 20; three congruent gears .* odd number of teeth, take 21"):
        build(dw.load(EXAMPLES / "seedling_pusher.toml", ["train.teeth=20"]))
