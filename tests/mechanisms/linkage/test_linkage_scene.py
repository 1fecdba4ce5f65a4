"""The drawn linkage is the computed one: poses, bar lengths, magnified play, plots, plates and pins."""

import re

import numpy as np
import pytest
import shapely
from places import EXAMPLES

import drivewright as dw
from drivewright import registry
from drivewright.errors import InputError
from drivewright.mechanisms.linkage.build import build
from drivewright.mechanisms.linkage.plates import plates
from drivewright.multibody.analyses.cycle_poses import FINE
from drivewright.multibody.analyses.simulation_model import record_of
from drivewright.multibody.drawing import block, rounded
from drivewright.multibody.model import Marker
from drivewright.multibody.record import record
from drivewright.multibody.simulate import simulate
from drivewright.report.content import pictures, views
from drivewright.scene import place

pytestmark = pytest.mark.property

NAMES = ("four_bar", "slider_crank_clearance", "knife_folder", "jansen_leg")
LINKAGE = registry.mechanism("linkage")
FREE = """
format = 1
mechanism = "linkage"
gravity = ["0 m/s^2", "-9.81 m/s^2"]
[ground.points]
O = ["10 mm", "20 mm"]
[bodies.arm]
mass = "1 kg"
inertia = "0.01 kg m^2"
centroid = ["150 mm", "30 mm"]
points = { O = ["0 mm", "0 mm"], E = ["400 mm", "0 mm"] }
angle = "10 deg"
[[joints]]
name = "O"
connects = ["ground.O", "arm.O"]
"""

GEARS = """
format = 1
mechanism = "linkage"
ground = { points = { A = ["0 mm", "0 mm"], B = ["90 mm", "0 mm"] } }
bodies.one = { mass = "1 kg", inertia = "1e-3 kg m^2", points = { M = ["5 mm", "0 mm"] } }
bodies.two = { mass = "1 kg", inertia = "1e-3 kg m^2", points = { M = ["0 mm", "0 mm"] } }
drive = { joint = "A", speed = "60 rpm" }
[[joints]]
name = "A"
connects = ["one.M", "ground.A"]
[[joints]]
name = "B"
connects = ["ground.B", "two.M"]
[[joints]]
name = "mesh"
kind = "gear"
connects = ["one", "two"]
ratio = RATIO
"""
YOKE = """
format = 1
mechanism = "linkage"
ground = { points = { O = ["0 mm", "0 mm"] } }
bodies.crank = { mass = "1 kg", points = { O = ["0 mm", "0 mm"], A = ["40 mm", "0 mm"] } }
bodies.yoke = { mass = "1 kg", inertia = "1e-3 kg m^2", points = { C = ["0 mm", "0 mm"] } }
drive = { joint = "O", speed = "60 rpm" }
[[joints]]
name = "O"
connects = ["ground.O", "crank.O"]
[[joints]]
name = "pin"
kind = "pin-slot"
connects = ["crank.A", "yoke.C"]
axis = [0, 1]
[[joints]]
name = "guide"
kind = "prismatic"
connects = ["yoke.C", "ground.O"]
"""
WHEEL = """
format = 1
mechanism = "linkage"
gravity = ["1 m/s^2", "-9.81 m/s^2"]
ground = { points = { T = ["10 mm", "-80 mm"] } }
bodies.wheel = { mass = "1 kg", inertia = "1e-3 kg m^2", points = { M = ["0 mm", "0 mm"] } }
simulate = { duration = "0.5 s" }
[[joints]]
name = "roll"
kind = "rolling"
connects = ["wheel.M", "ground.T"]
radius = "30 mm"
"""


@pytest.fixture(scope="module", params=NAMES)
def drawn(request):
    """(model, scene, {body: Body}); two turns do."""
    spec = dw.load(EXAMPLES / f"{request.param}.toml", ["simulate.turns=2", "simulate.discard=0"])
    model = build(spec)
    made = LINKAGE.scene(model)
    return model, made, {body.name: body for body in made.bodies}


@pytest.fixture
def written(tmp_path):
    def write(text):
        path = tmp_path / "spec.toml"
        path.write_text(text, encoding="utf-8")
        return dw.load(path)

    return write


def path(body, point):
    return np.array([place(np.array([point]), pose)[0] for pose in body.poses])


def test_the_scene_is_the_last_turn(drawn):
    model, made, _ = drawn
    assert made.cycle == pytest.approx(np.linspace(0, 2 * np.pi, 181)) and made.cycle_unit == "rad"
    assert made.period == pytest.approx(model.period) and made.table == "motion"
    assert all(body.poses.shape == (181, 3) for body in made.bodies)


def test_every_point_is_where_the_kernel_has_it(drawn):
    model, made, bodies = drawn
    times = np.linspace(model.period, 2 * model.period, 180 * FINE + 1)
    markers = {(name, key): Marker(name, *point) for name, body in model.spec.bodies.items() for key, point in body.points.items()}
    seen = record(simulate(model.assembly, 2 * model.period, model.settings, samples=times), markers)
    for (name, key), marker in markers.items():
        where = np.stack([seen.point((name, key), "x"), seen.point((name, key), "y")], axis=1)[::FINE]
        assert path(bodies[name], marker[1:]) == pytest.approx(where, abs=1e-12), f"{name}.{key}"


def test_bars_keep_their_length_and_pins_hold(drawn):
    model, _, bodies = drawn
    give = {"dry": 1.1, "massless-link": 1.0 + 1e-9}  # steel gives way a little
    play = {joint.name: joint.clearance * give[joint.pin] for joint in model.spec.joints if joint.pin in give}
    for joint in model.assembly.model.joints:
        if hasattr(joint, "model"):
            one, other = (path(bodies[m.body], m[1:]) for m in (joint.first, joint.second))
            gap = np.hypot(*(other - one).T)
            assert gap.max() <= play.get(joint.name, 1e-9), joint.name
            if joint.name in play:
                assert gap.max() > 0.5 * play[joint.name]
    for name, body in model.spec.bodies.items():
        points = list(body.points.values())
        for a, b in zip(points, points[1:], strict=False):
            length = np.hypot(*(path(bodies[name], b) - path(bodies[name], a)).T)
            assert length == pytest.approx(np.full(181, np.hypot(*np.subtract(b, a))), abs=1e-12)


def test_the_outline_of_a_body_holds_its_points(drawn):
    model, _, bodies = drawn
    for name, body in model.spec.bodies.items():
        shape = next(s for s in bodies[name].shapes if s.layer == "body")
        area = shapely.Polygon(shape.outline.points(1e-6))
        assert area.is_valid and all(area.contains(shapely.Point(p)) for p in body.points.values()), name


def test_the_journal_stays_inside_its_bearing_and_shows_the_play(drawn):
    model, _, bodies = drawn
    for joint in model.assembly.model.joints:
        journal = bodies.get(f"journal {joint.name}")
        if journal is None:
            assert model.spec.joints[[j.name for j in model.spec.joints].index(joint.name)].pin in (None, "ideal")
            continue
        play = joint.model.clearance
        factor = float(journal.label.rpartition("×")[2])
        centre, carrier = joint.first[1:], bodies[joint.first.body]
        holes = [s.outline for s in carrier.shapes if s.layer == "hole" and np.allclose(s.outline.points().mean(axis=0), centre)]
        bearing = max(np.hypot(*(hole.points(1e-7) - centre).T).mean() for hole in holes)
        radius = np.hypot(*journal.shapes[0].outline.points(1e-7).T).mean()
        assert bearing - radius == pytest.approx(factor * play, rel=1e-6) and factor * play > 0.2 * bearing
        away = journal.poses[:, :2] - path(carrier, centre)
        assert np.all(np.hypot(*away.T) + radius <= bearing * (1 + 1e-9))
        real = path(bodies[joint.second.body], joint.second[1:]) - path(carrier, centre)
        assert journal.rest[:, :2] == pytest.approx(path(carrier, centre), abs=1e-12), "without play it is in the bearing's middle"
        assert journal.rest[:, 2] == pytest.approx(bodies[joint.second.body].poses[:, 2], abs=1e-12)
        assert (journal.magnified, journal.most) == (factor, 1.0), "further out it would pass through the wall"
        inside = np.hypot(*real.T) <= play
        assert away[inside] == pytest.approx(factor * real[inside], abs=1e-9)
        orbits = [s.outline.points() for s in carrier.shapes if s.layer == "pitch"]
        orbit = next(points for points in orbits if np.hypot(*(points - centre).T).max() < bearing)
        for frame in (7, 100):
            there = place(away[frame : frame + 1], (0, 0, -carrier.poses[frame, 2]))[0] + centre
            assert orbit[FINE * frame] == pytest.approx(there, abs=1e-9)


def test_traces_are_the_paths_of_the_outputs(drawn):
    model, made, bodies = drawn
    seen = record_of(model)
    for trace in made.traces:
        end = path(bodies[trace.body], trace.point)[-1]
        assert end == pytest.approx([seen.point(trace.name, "x")[-1], seen.point(trace.name, "y")[-1]], abs=1e-7)
    assert {trace.name for trace in made.traces} == {output.name for output in model.spec.outputs if output.point}


def test_every_picture_of_every_example_can_be_drawn(drawn):
    model, _, _ = drawn
    result = dw.run(model.spec.replace(lyapunov=None))
    seen = views(result, model)
    assert not seen.remarks
    found = {picture.name for picture in pictures(result, seen)}
    assert {"scene-machine", "plot-drive"} <= found
    for output in model.spec.outputs:
        assert {f"plot-motion.{output.name}", f"plot-spectrum.{output.name}"} <= found
    for joint in model.spec.joints:
        if joint.pin == "dry":
            assert {f"plot-orbit.{joint.name}", f"plot-force.{joint.name}", f"plot-polar.{joint.name}"} <= found


def test_a_slider_moves_between_rails_that_are_as_long_as_its_way():
    model = build(dw.load(EXAMPLES / "slider_crank_clearance.toml", ["simulate.turns=2", "simulate.discard=0"]))
    bodies = {body.name: body for body in LINKAGE.scene(model).bodies}
    rails = [s.outline.points() for s in bodies["ground"].shapes if s.layer == "ground" and not s.outline.closed][-2:]
    shoe = bodies["slider"].shapes[0].outline.points()
    for frame in (0, 44, 90, 133):
        moved = place(shoe, bodies["slider"].poses[frame])
        for rail in rails:
            assert rail[:, 0].min() < moved[:, 0].min() and moved[:, 0].max() < rail[:, 0].max()
        assert sorted(np.unique(moved[:, 1].round(9))) == pytest.approx(sorted(rail[0, 1] for rail in rails), abs=1e-8)


def test_a_spring_is_drawn_from_end_to_end():
    model = build(dw.load(EXAMPLES / "four_bar.toml"))
    bodies = {body.name: body for body in LINKAGE.scene(model).bodies}
    coil, rod = bodies["coil return"], bodies["rod return"]
    assert path(coil, (0, 0)) == pytest.approx(path(bodies["rocker"], (0.045, 0)), abs=1e-12)
    assert path(rod, (0, 0)) == pytest.approx(np.zeros((181, 2)), abs=1e-12)
    length = np.hypot(*path(coil, (0, 0)).T)
    ends = [body.shapes[0].outline.points() for body in (coil, rod)]
    reach = [np.ptp(points[:, 0]) for points in ends]
    assert np.all(reach[0] <= length) and np.all(reach[1] <= length) and sum(reach) >= length.max()
    for frame in (0, 50, 120):  # the rod points at the rocker's end, the coil at the ground's
        (a, b), (c, d) = place(ends[1], rod.poses[frame])[-1], path(coil, (0, 0))[frame]
        assert a * d - b * c == pytest.approx(0, abs=1e-12)
        assert np.hypot(*place(ends[0], coil.poses[frame])[-1]) == pytest.approx(length[frame] - reach[0], abs=1e-12)
        assert np.hypot(*place(ends[1], rod.poses[frame])[-1]) == pytest.approx(reach[1], abs=1e-12)
        assert place(ends[1], rod.poses[frame])[-1] @ path(coil, (0, 0))[frame] > 0


@pytest.mark.parametrize(("ratio", "radii"), [(-2.0, (60, 30)), (3.0, (135, 45)), (0.25, (30, 120)), (-0.5, (30, 60))])
def test_pitch_circles_of_gears_touch_and_have_the_ratio(written, ratio, radii):
    """Outer gears touch from outside, r1 + r2 = a; a ring from inside, |r1 - r2| = a = 90 mm."""
    spec = written(GEARS.replace("RATIO", str(ratio)))
    made = LINKAGE.scene(build(spec))
    circles = {b.name: s.outline.points(1e-7) for b in made.bodies for s in b.shapes if s.layer == "pitch"}
    found = [np.hypot(*(circles[name] - circles[name].mean(axis=0)).T).mean() for name in ("one", "two")]
    assert found == pytest.approx([r * 1e-3 for r in radii], abs=1e-6)
    one = circles["one"].mean(axis=0)
    assert one == pytest.approx([0.005, 0.0], abs=1e-9)  # the pin is not at the body's origin


def test_a_slot_is_as_long_as_the_way_of_its_pin(written):
    """Scotch yoke: the pin on a crank of 40 mm slides 80 mm in the slot and the yoke moves by as much."""
    bodies = {body.name: body for body in LINKAGE.scene(build(written(YOKE))).bodies}
    slot = next(s.outline.points(1e-7) for s in bodies["yoke"].shapes if s.layer == "hole")
    wide, high = np.ptp(slot, axis=0)
    assert high - wide == pytest.approx(0.08, abs=1e-5) and slot[:, 1].mean() == pytest.approx(0.0, abs=1e-5)
    assert np.ptp(bodies["yoke"].poses[:, 0]) == pytest.approx(0.08, abs=1e-5)


def test_a_wheel_rolls_on_its_track(written):
    bodies = {body.name: body for body in LINKAGE.scene(build(written(WHEEL))).bodies}
    rim, wheel = bodies["wheel"].shapes[0].outline.points(1e-7), bodies["wheel"].poses
    track = bodies["ground"].shapes[0].outline.points()
    for frame in (0, 300, 720):
        assert place(rim, wheel[frame])[:, 1].min() == pytest.approx(track[0, 1], abs=1e-6)
    assert np.ptp(wheel[:, 0]) > 0.02 and np.ptp(wheel[:, 0]) == pytest.approx(0.03 * np.ptp(wheel[:, 2]), rel=1e-9)
    assert np.ptp(track[:, 0]) == pytest.approx(np.ptp(wheel[:, 0]) + 2 * 0.03)


def test_a_free_mechanism_shows_its_whole_run_in_time(written):
    spec = written(FREE + '[simulate]\nduration = "0.7 s"\n')
    made = LINKAGE.scene(build(spec))
    assert (made.cycle[0], made.cycle[-1], made.cycle_label, made.period) == (0.0, pytest.approx(0.7), "time", pytest.approx(0.7))
    arm = next(body for body in made.bodies if body.name == "arm")
    assert path(arm, (0, 0)) == pytest.approx(np.broadcast_to([0.01, 0.02], (len(made.cycle), 2)), abs=1e-12)
    assert np.ptp(arm.poses[:, 2]) > 1.0


def test_without_a_run_the_start_is_shown(written):
    made = LINKAGE.scene(build(written(FREE)))
    arm = next(body for body in made.bodies if body.name == "arm")
    assert arm.poses == pytest.approx(np.array([[0.01, 0.02, np.radians(10)]] * 2)) and made.period == 0.0 and "start" in made.cycle_label


# -- plates --------------------------------------------------------------------------------------------------------------------


def centres(drawing):
    return np.array([outline.points(1e-7).mean(axis=0) for outline in drawing.on("hole")])


def radii(drawing):
    return [float(np.hypot(*(outline.points(1e-7) - outline.points(1e-7).mean(axis=0)).T).mean()) for outline in drawing.on("hole")]


def test_plates_have_their_holes_where_the_pins_are(drawn):
    model, _, _ = drawn
    plates = {drawing.name: drawing for drawing in LINKAGE.drawings(model)}
    assert set(plates) == {name for name, body in model.spec.bodies.items() if len(body.points) > 1}
    for name, drawing in plates.items():
        pins = {
            tuple(model.spec.bodies[name].points[text.split(".")[1]])
            for joint in model.spec.joints
            for text in joint.connects
            if text.split(".")[0] == name
        }
        found = centres(drawing)
        assert len(found) == len(pins) and all(np.hypot(*(found - pin).T).min() < 1e-9 for pin in pins)
        edge = shapely.Polygon(drawing.on("profile")[0].points(1e-7))
        for hole in drawing.on("hole"):
            assert edge.buffer(-1e-4).contains(shapely.Polygon(hole.points(1e-7)))
        assert "proposal" in drawing.title and drawing.thickness > 0


def test_a_bearing_has_its_radius_and_the_journal_that_less_the_play():
    knife = {d.name: d for d in LINKAGE.drawings(build(dw.load(EXAMPLES / "knife_folder.toml")))}
    assert radii(knife["crank"]) == pytest.approx([5e-3, 15e-3], abs=1e-6)  # a default pin, a bearing
    assert radii(knife["coupler"]) == pytest.approx([14.8e-3, 15e-3], abs=1e-6)  # a journal's seat, a bearing
    assert np.hypot(*np.diff(centres(knife["coupler"]), axis=0)[0]) == pytest.approx(0.158, abs=1e-9)
    leg = LINKAGE.drawings(build(dw.load(EXAMPLES / "jansen_leg.toml")))
    assert {round(r, 7) for drawing in leg for r in radii(drawing)} == {1.5e-3}  # a tenth of the crank, the shortest link


def test_solids_are_the_plates_at_the_start_one_above_the_other(drawn):
    model, made, _ = drawn
    parts = {part.name: part for part in LINKAGE.parts(model)}
    plates = {drawing.name: drawing for drawing in LINKAGE.drawings(model)}
    tops = -np.inf
    for name, drawing in plates.items():
        (solid,) = parts[name].solids
        assert solid.outline.points() == pytest.approx(drawing.on("profile")[0].points()) and solid.thickness == drawing.thickness
        assert solid.z > tops
        tops = solid.z + solid.thickness
    for name, part in parts.items():
        if name.startswith("pin "):
            joint = next(j for j in model.spec.joints if j.name == name[4:])
            body, point = joint.connects[1].split(".")
            pin = part.solids[0].outline.points(1e-7).mean(axis=0)
            if body in plates:
                assert pin == pytest.approx(place(np.array([model.spec.bodies[body].points[point]]), parts[body].pose)[0], abs=1e-6)
                low, high = part.solids[0].z, part.solids[0].z + part.solids[0].thickness
                assert low <= parts[body].solids[0].z and parts[body].solids[0].z + plates[body].thickness <= high + 1e-12


def test_a_body_whose_holes_meet_has_no_plate_and_a_finding():
    model = build(dw.load(EXAMPLES / "slider_crank_clearance.toml", ["joints.wrist.bearing_radius=115 mm"]))
    told = r"link plate 'rod': two holes overlap: radii of 5 and 115 mm at a distance of 120 mm.*smaller bearing_radius"
    (finding,) = [text for text in model.findings if "no drawing of a body" in text]
    assert re.search(told, finding)
    drawn = [drawing.name for drawing in LINKAGE.drawings(model)]
    assert "rod" not in drawn and drawn
    alone = model.spec.model_copy(update={"bodies": {"rod": model.spec.bodies["rod"]}})
    with pytest.raises(InputError, match=told):
        plates(alone)


# -- forces --------------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("over", "low", "high", "share"), [("time [s]", 1.5, 1.75, 0.25), ("angle [deg]", 540, 630, 0.25), ("speed [rpm]", 50, 70, 1.0)]
)
def test_the_arrow_of_a_force_is_there_while_it_acts_and_points_along_it(tmp_path, over, low, high, share):
    """The second turn of a crank at 60 rpm: the factor is -1 in its third quarter, or at this speed."""
    small = 1e-3 * (high - low)
    rows = [(0, 0), (low - small, 0), (low, -1), (high, -1), (high + small, 0), (9e3, 0)]
    (tmp_path / "factor.csv").write_text("\n".join([f"{over},factor", *(f"{x},{y}" for x, y in rows)]), encoding="utf-8")
    crank = registry.mechanism("linkage").presets()["crank"].read_text(encoding="utf-8")
    load = '[[forces]]\nname = "push"\nbody = "crank"\npoint = "A"\nforce = ["0 N", "5 N"]\nfile = "factor.csv"\n'
    (tmp_path / "crank.toml").write_text(crank + load, encoding="utf-8")
    drawn = LINKAGE.scene(build(dw.load(tmp_path / "crank.toml")))
    (arrow,) = [body for body in drawn.bodies if body.name == "force push"]
    crank_angle = np.degrees(drawn.cycle)
    assert np.mean(arrow.shown) == pytest.approx(share, abs=0.02)
    if share < 1:
        assert crank_angle[arrow.shown].min() >= 178 and crank_angle[arrow.shown].max() <= 272
    assert arrow.poses[arrow.shown, 2] == pytest.approx(1.5 * np.pi)  # downwards: 5 N upwards, times -1


def test_the_arrow_of_a_steady_force_is_always_there():
    spec = dw.load(registry.mechanism("linkage").presets()["crank"], ['forces=[{name="F", body="crank", point="A", force=["3 N", "0 N"]}]'])
    (arrow,) = [body for body in LINKAGE.scene(build(spec)).bodies if body.name == "force F"]
    assert arrow.shown.all() and arrow.poses[:, 2] == pytest.approx(0.0)


# -- outlines ------------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "points", [[(1, 2)], [(0, 0), (3, 1)], [(0, 0), (2, 2), (1, 1)], [(0, 0), (4, 1), (2, 5), (2, 2)], [(2, 5), (4, 1), (0, 0)]]
)
def test_a_rounded_outline_is_the_hull_grown_by_its_radius(points):
    grown = shapely.convex_hull(shapely.MultiPoint(points)).buffer(0.3, quad_segs=400)
    made = shapely.Polygon(rounded(points, 0.3).points(1e-6))
    assert made.is_valid and made.symmetric_difference(grown).area < 1e-4


def test_a_block_lies_along_its_angle():
    corners = block((1, 2), np.pi / 2, 3, 1).points()
    assert (corners.min(axis=0), corners.max(axis=0)) == (pytest.approx([0, -1]), pytest.approx([2, 5]))
