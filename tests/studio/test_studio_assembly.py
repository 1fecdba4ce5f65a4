"""The assembly in motion: each solid goes with the body of the scene that it belongs to."""

import base64
from pathlib import Path

import numpy as np
import pytest
from places import EXAMPLES

from drivewright import registry, runner
from drivewright.report.solids import displacements
from drivewright.scene import Body, Frame, Scene, Shape, circle, place
from drivewright.solids import facets
from drivewright.spec import load
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
    from drivewright.spec.parsing import parse_document

    answer = solid(Design(parse_document(path.read_text()), Path(path).parent), lambda *news: None)
    motions = {part["name"]: part["motion"] for part in answer["parts"]}
    assert sorted(motions.values()) == [0, 1] and len(answer["motions"]) == 2
    cam, roller = (of_text(answer["motions"][motions[name]]) for name in ("cam", "roller"))
    assert np.ptp(cam[:, 2]) == pytest.approx(2 * np.pi, rel=1e-6) and np.allclose(cam[:, :2], 0, atol=1e-9)
    assert np.ptp(roller[:, 1]) == pytest.approx(0.02, rel=1e-6) and np.allclose(roller[:, [0, 2]], 0, atol=1e-9)
