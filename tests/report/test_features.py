"""What can be measured on a packed scene: exact lines and arcs, in the order of the packed shapes."""

import base64

import numpy as np
import pytest
from places import EXAMPLES

from drivewright import registry, runner
from drivewright.report.features import MOST_LINES, pack_features
from drivewright.report.pack import pack_scene
from drivewright.scene import Body, Frame, Scene, Shape, capsule, circle, polygon
from drivewright.spec import load


def scene_of(name):
    spec = load(EXAMPLES / f"{name}.toml")
    return registry.mechanism(spec.mechanism).scene(runner.build(spec))


@pytest.mark.parametrize("name", ["four_bar", "disc_cam", "hyvo_chain", "seedling_pusher"])
def test_features_lie_on_the_packed_shape_of_the_same_number(name):
    scene = scene_of(name)
    features, shapes = pack_features(scene), pack_scene(scene)["shapes"]
    assert len(features) == len(shapes) and any(each["arcs"] for each in features)
    for own, shape in zip(features, shapes, strict=True):
        points = np.frombuffer(base64.b64decode(shape["points"]), "<f4").reshape(-1, 2)
        size = np.ptp(points, axis=0).max() + 1e-9
        for x0, y0, x1, y1 in own["lines"]:
            for corner in ((x0, y0), (x1, y1)):
                assert np.min(np.hypot(*(points - corner).T)) < 1e-3 * size
        for x, y, radius, start, _ in own["arcs"]:
            assert np.min(np.hypot(*(points - (x + radius * np.cos(start), y + radius * np.sin(start))).T)) < 1e-2 * size


def test_a_curve_of_many_chords_has_no_edges():
    still = np.zeros((2, 3))
    turn = np.linspace(0, 2 * np.pi, MOST_LINES + 2)[:-1]
    shapes = (
        Shape("body", capsule((0, 0), (1, 0), 0.1)),
        Shape("profile", polygon(np.stack([np.cos(turn), np.sin(turn)], axis=1))),
        Shape("hole", circle((1, 0), 0.05)),
    )
    body, frame = Body("bar", "bar", shapes, still), Frame("machine", "machine frame", still)
    bar, curve, hole = pack_features(Scene(np.array([0.0, 1.0]), "angle", "rad", 1.0, (body,), (frame,)))
    assert len(bar["lines"]) == len(bar["arcs"]) == 2 and curve == {"lines": [], "arcs": []}
    assert [arc[:3] for arc in hole["arcs"]] == [[1.0, 0.0, 0.05]] * 2


def test_edges_run_the_way_the_outline_does_and_its_last_one_closes_it():
    """Outside numbers: a right triangle, walked around."""
    still, corners = np.zeros((2, 3)), [(0.0, 0.0), (3.0, 0.0), (3.0, 4.0)]
    body = Body("plate", "plate", (Shape("body", polygon(corners)),), still)
    (plate,) = pack_features(Scene(np.array([0.0, 1.0]), "angle", "rad", 1.0, (body,), (Frame("machine", "machine frame", still),)))
    assert plate["lines"] == [[0, 0, 3, 0], [3, 0, 3, 4], [3, 4, 0, 0]] and plate["arcs"] == []


@pytest.mark.parametrize(("count", "edges"), [(MOST_LINES, MOST_LINES), (MOST_LINES + 1, 0)])
def test_the_most_edges_of_an_outline_are_still_edges(count, edges):
    turn, still = np.arange(count) * 2 * np.pi / count, np.zeros((2, 3))
    body = Body("plate", "plate", (Shape("body", polygon(np.stack([np.cos(turn), np.sin(turn)], axis=1))),), still)
    (plate,) = pack_features(Scene(np.array([0.0, 1.0]), "angle", "rad", 1.0, (body,), (Frame("machine", "machine frame", still),)))
    assert len(plate["lines"]) == edges
