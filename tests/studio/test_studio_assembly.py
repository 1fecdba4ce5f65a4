"""The assembly in motion: each solid goes with the body of the scene that it belongs to."""

import base64
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from packed_solids import solid_corners
from places import EXAMPLES

from drivewright import registry, runner
from drivewright.report.solids import displacements, pack_solids, solid_surfaces, with_repeats
from drivewright.scene import Body, Frame, Part, Scene, Shape, Turned, Turning, circle, place
from drivewright.solids import facets
from drivewright.spec import load
from drivewright.spec.parsing import parse_document
from drivewright.studio.design import Design
from drivewright.studio.jobs.solid import solid

pytestmark = [pytest.mark.needs_studio, pytest.mark.property]
MOVING = {  # example: parts that stand still
    "disc_cam": set(),
    "four_bar": set(),
    "slider_crank_clearance": set(),
    "seedling_pusher": {"gear_sun"},
    "roller_chain": set(),
    "pin_indexer": set(),
}


def of_text(text):
    return np.frombuffer(base64.b64decode(text), "<f4").reshape(-1, 3)


def body(poses, rest=None):
    shape = Shape("body", circle((0.0, 0.0), 1.0))
    return Body("b", "b", (shape,), np.asarray(poses, float), rest=None if rest is None else np.asarray(rest, float))


def moved(poses, rest=None):
    cycle = np.linspace(0, 1, len(poses))
    return displacements(Scene(cycle, "", "-", 1.0, (body(poses, rest),), (Frame("m", "m", np.zeros((len(poses), 3))),)))


def test_a_displacement_carries_a_point_from_its_start_to_where_the_body_takes_it():
    rng = np.random.default_rng(3)
    poses, own = rng.normal(size=(5, 3)), rng.normal(size=(1, 2))
    found, start = of_text(moved(poses)["b"]), place(own, poses[0])
    for displacement, pose in zip(found, poses, strict=True):
        assert place(start, displacement) == pytest.approx(place(own, pose), abs=1e-6)


def test_what_stands_still_has_no_displacement_and_play_that_is_drawn_enlarged_does_not_count():
    still, shaken = np.zeros((3, 3)), [[0, 0, 0], [0.1, 0, 0], [0, 0, 0]]
    assert moved(still) == {} and list(moved(shaken)) == ["b"] and moved(shaken, rest=still) == {}


@pytest.mark.parametrize("name", MOVING)
def test_every_part_moves_with_a_body_that_is_where_the_part_is(name):
    model = runner.build(load(EXAMPLES / f"{name}.toml"))
    mechanism = registry.mechanism(model.spec.mechanism)
    scene = mechanism.scene(model)
    carrying = displacements(scene)
    parts = mechanism.parts(model)
    assert {part.name for part in parts if (part.body or part.name) not in carrying} == MOVING[name]
    for part in parts:
        carrier = next((each for each in scene.bodies if each.name == (part.body or part.name)), None)
        if carrier is None:
            continue
        drawn = np.concatenate([place(shape.outline.points(1e-4), carrier.poses[0]) for shape in carrier.shapes])
        points, _ = facets.surface_triangles(part, 1e-3)
        low, high = drawn.min(axis=0), drawn.max(axis=0)
        margin = 0.15 * float(np.max(high - low))
        middle = 0.5 * (points[:, :2].min(axis=0) + points[:, :2].max(axis=0))
        assert np.all(middle > low - margin) and np.all(middle < high + margin), f"{part.name} does not lie on {carrier.name}"


def test_the_answer_names_the_motion_of_each_part_once():
    path = EXAMPLES / "disc_cam.toml"
    answer = solid(Design(parse_document(path.read_text()), Path(path).parent), lambda *news: None)
    motions = {part["name"]: part["motion"] for part in answer["parts"]}
    assert sorted(motions.values()) == [0, 1] and len(answer["motions"]) == 2
    cam, roller = (of_text(answer["motions"][motions[name]]) for name in ("cam", "roller"))
    assert np.ptp(cam[:, 2]) == pytest.approx(2 * np.pi, rel=1e-6) and np.allclose(cam[:, :2], 0, atol=1e-9)
    assert np.ptp(roller[:, 1]) == pytest.approx(0.02, rel=1e-6) and np.allclose(roller[:, [0, 2]], 0, atol=1e-9)


def rim(part):
    """Segments (n, 2, 2) [m] around the lowest face of a packed prism, bore and profile."""
    corners = solid_corners(part)[0].reshape(-1, 3, 3)
    face = corners[np.all(np.isclose(corners[..., 2], corners[..., 2].min()), axis=1)][..., :2].round(9)
    sides = np.stack([face, np.roll(face, -1, axis=1)], axis=2).reshape(-1, 2, 2)
    ordered = np.where((sides[:, 0] < sides[:, 1])[:, :1] | (sides[:, 0] == sides[:, 1])[:, :1] & (sides[:, 0] < sides[:, 1])[:, 1:], 1, 0)
    sides = np.where(ordered[..., None] == 1, sides, sides[:, ::-1])
    names, counts = np.unique(sides.reshape(-1, 4), axis=0, return_counts=True)
    return names[counts == 1].reshape(-1, 2, 2)


def nearest(point, segments):
    """Distance of a point from segments (n, 2, 2)."""
    a, b = segments[:, 0], segments[:, 1]
    part = np.clip(np.einsum("ij,ij->i", point - a, b - a) / np.einsum("ij,ij->i", b - a, b - a), 0, 1)
    return np.hypot(*(a + part[:, None] * (b - a) - point).T).min()


@pytest.mark.parametrize("name, cam, roller", [("disc_cam", "cam", "roller"), ("seedling_pusher", "cam_main", "roller_main")])
def test_the_contact_stays_closed_over_the_cycle(name, cam, roller):
    """The roller's surface lies on the flank of the cam, to the tolerance of the triangles, wherever both have moved."""
    path = EXAMPLES / f"{name}.toml"
    answer = solid(Design(parse_document(path.read_text(encoding="utf-8")), path.parent), lambda *news: None)
    parts = {part["name"]: part for part in answer["parts"]}
    ring, flank = solid_corners(parts[roller])[0][:, :2], rim(parts[cam])
    centre, radius = 0.5 * (ring.min(axis=0) + ring.max(axis=0)), 0.5 * np.ptp(ring[:, 1])
    flank = flank[np.hypot(*(flank.mean(axis=1) - flank.mean(axis=(0, 1))).T) > 0.4 * np.ptp(flank[..., 0]) / 2]  # not the bore
    moved = [of_text(answer["motions"][parts[part]["motion"]]) for part in (cam, roller)]
    for frame in range(0, len(moved[0]), 23):
        of_cam, of_roller = moved[0][frame], moved[1][frame]
        there = np.stack([place(flank[:, k], of_cam) for k in (0, 1)], axis=1)
        gap = nearest(place(centre[None], of_roller)[0], there) - radius
        assert abs(gap) < 9e-5, f"frame {frame}: a gap of {1e6 * gap:.1f} µm"


def test_parts_of_a_scene_that_is_unrolled_or_seen_from_the_side_have_a_turn_of_their_own():
    angles = np.array([0.0, 1.0, 2.0])
    turning = Turning((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), angles)
    shaft = Part("shaft", (Turned((0.0, 0.0), 0.0, ((0.1, 0.02, 0.02, 0.0),)),), turning=turning)
    bare, marked = (pack_solids(solid_surfaces([part]), rolling_scene()) for part in (replace(shaft, turning=None), shaft))
    (part,) = marked["parts"]
    assert part["turn"] == 0 and part["motion"] == -1 and bare["parts"][0]["turn"] == -1 and bare["parts"][0]["motion"] == 0
    assert np.allclose(np.frombuffer(base64.b64decode(marked["turns"][0]["angles"]), "<f4"), angles)
    lines = solid_corners(part)[2]
    lying = lines[np.isclose(np.abs(lines[:, 1, 0] - lines[:, 0, 0]), 0.1, atol=1e-7)]
    assert len(lying) == 1 and len(lines) == len(solid_corners(bare["parts"][0])[2]) + 1  # a meridian, or nobody sees it turn


def rolling_scene():
    poses = np.column_stack([[0.0, 0.1, 0.2], np.zeros((3, 2))])
    return Scene(np.linspace(0, 1, 3), "", "-", 1.0, (replace(body(poses), name="shaft"),), (Frame("m", "m", np.zeros((3, 3))),))


def test_links_of_a_chain_repeat_the_first_ones_where_the_scene_has_them():
    """Every link of the scene has a solid; a repeated one is placed as its body is, inner and outer plates in turn."""
    model = runner.build(load(EXAMPLES / "roller_chain.toml"))
    mechanism = registry.mechanism(model.spec.mechanism)
    scene, surfaces = mechanism.scene(model), solid_surfaces(mechanism.parts(model))
    bodies = {each.name: each for each in scene.bodies}
    packed = pack_solids(surfaces, scene)
    whole = with_repeats(surfaces, scene)
    assert {each.body for each in whole} == set(displacements(scene)) and len(whole) == len(surfaces) + len(packed["repeats"])
    for again, surface in zip(packed["repeats"], whole[len(surfaces) :], strict=True):
        original = surfaces[again["part"]]
        assert (int(surface.body.removeprefix("link")) - int(original.body.removeprefix("link"))) % 2 == 0
        motion = of_text(packed["motions"][again["motion"]])
        for frame in (0, 17, -1):
            carrier, start = bodies[surface.body].poses[frame], bodies[original.body].poses[0]
            own = unplaced(original.points[:20, :2], start)
            assert place(original.points[:20, :2], motion[frame]) == pytest.approx(place(own, carrier), abs=1e-7)
        assert place(original.points[:, :2], motion[0]) == pytest.approx(surface.points[:, :2], abs=1e-7)


def unplaced(points, pose):
    """The points in the frame of the pose."""
    c, s = np.cos(pose[2]), np.sin(pose[2])
    return (points - pose[:2]) @ np.array([[c, -s], [s, c]])
