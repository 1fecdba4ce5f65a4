"""Several scenes as one: every body is where it is in its own scene."""

from dataclasses import replace

import numpy as np
import pytest
from sample_designs import four_bar_scene

from drivewright.report.pack import pack_scene
from drivewright.scene import Body, Frame, Scene, Shape, circle
from drivewright.view import draw_scene
from drivewright.view.merged_scenes import merged_scene, phases_of
from drivewright.view.palette import SERIES, colour

pytestmark = pytest.mark.interface

SCENE = four_bar_scene()


def turning(frames, speed=1.0, start=0.0, turns=1.0, unit="rad", observer=0.0):
    """A disc that turns `speed` times as fast as the drive, from `start`, over so many turns of the drive."""
    cycle = start + np.linspace(0, 2 * np.pi * turns, frames)
    poses = np.stack([np.cos(cycle), np.sin(cycle), speed * cycle], axis=1)
    still = Frame("machine", "machine frame", np.zeros((frames, 3)))
    seen = Frame("own", "seen from the disc", np.stack([0 * cycle, 0 * cycle, observer * cycle], axis=1))
    body = Body("disc", "disc", (Shape("body", circle((0, 0), 0.1)), Shape("hole", circle((0, 0), 0.02))), poses)
    return Scene(cycle, "drive", unit, 1.0, (body,), (still, seen))


def test_every_body_moves_as_in_its_own_scene():
    other = replace(SCENE, bodies=tuple(replace(body, poses=body.poses + (0.01, 0.0, 0.0)) for body in SCENE.bodies))
    merged, remarks = merged_scene([SCENE, other], ["A", "B"])
    assert remarks == () and len(merged.bodies) == 2 * len(SCENE.bodies)
    for label, scene in (("A", SCENE), ("B", other)):
        for body in scene.bodies:
            (found,) = [each for each in merged.bodies if each.name == f"{label}: {body.name}"]
            assert np.array_equal(found.poses, body.poses) and found.label == label
    assert {body.colour for body in merged.bodies if body.label == "B"} == {SERIES[1]}
    assert {(trace.body, trace.colour) for trace in merged.traces} == {("A: coupler", SERIES[0]), ("B: coupler", SERIES[1])}
    assert [frame.name for frame in merged.frames] == [frame.name for frame in SCENE.frames] and merged.marks == SCENE.marks


def test_other_samples_of_the_same_cycle_lie_on_the_same_motion():
    fine, coarse = turning(721), turning(2881)
    merged, _ = merged_scene([fine, coarse], ["A", "B"])
    a, b = merged.bodies
    assert b.poses[:, :2] == pytest.approx(a.poses[:, :2], abs=1e-5)
    assert np.exp(1j * b.poses[:, 2]) == pytest.approx(np.exp(1j * a.poses[:, 2]), abs=1e-9)


def test_an_angle_that_jumps_by_a_turn_is_continued_between_the_samples():
    coarse, fine = turning(37, speed=3.0), turning(361, speed=3.0)
    (body,) = coarse.bodies
    wrapped = np.column_stack([body.poses[:, :2], np.angle(np.exp(1j * body.poses[:, 2]))])
    merged, _ = merged_scene([fine, replace(coarse, bodies=(replace(body, poses=wrapped),))], ["A", "B"])
    a, b = merged.bodies
    assert np.exp(1j * b.poses[:, 2]) == pytest.approx(np.exp(1j * a.poses[:, 2]), abs=1e-9)


def test_a_shorter_cycle_is_repeated_over_the_longest_one():
    merged, remarks = merged_scene([turning(361), turning(721, turns=2.0)], ["one", "two"])
    assert len(merged.cycle) == 721 and "the cycle of one is shorter" in remarks[0]
    one, two = merged.bodies
    assert one.poses[:, :2] == pytest.approx(two.poses[:, :2], abs=1e-9)


def test_designs_stand_at_the_same_value_of_the_drive_wherever_their_cycles_begin():
    merged, remarks = merged_scene([turning(361), turning(361, start=np.pi / 2)], ["A", "B"])
    assert remarks == ()
    a, b = merged.bodies
    assert b.poses[:, :2] == pytest.approx(a.poses[:, :2], abs=1e-9)


def test_both_ends_of_a_cycle_are_in_it():
    scene = turning(5)
    assert phases_of(scene, scene.cycle) == pytest.approx([0, 0.25, 0.5, 0.75, 1.0])
    assert phases_of(scene, np.array([-np.pi, 2.5 * np.pi])) == pytest.approx([0.5, 0.25])


def test_other_units_of_the_drive_are_not_merged():
    scene, remarks = merged_scene([turning(9), turning(9, unit="s")], ["A", "B"])
    assert scene is None and "rad, s" in remarks[0]


def test_observers_that_differ_are_left_out_with_a_remark():
    merged, remarks = merged_scene([turning(9, observer=1.0), turning(9, observer=2.0)], ["A", "B"])
    assert [frame.name for frame in merged.frames] == ["machine"] and "seen from the disc" in remarks[0]
    same, remarks = merged_scene([turning(9, observer=1.0), turning(9, observer=1.0)], ["A", "B"])
    assert [frame.name for frame in same.frames] == ["machine", "own"] and not remarks


def test_only_the_first_design_is_filled_and_no_hole_covers_another_design():
    merged, _ = merged_scene([turning(9), turning(9)], ["A", "B"])
    assert [[shape.layer for shape in body.shapes] for body in merged.bodies] == [["body", "edge"], ["edge", "edge"]]


def test_the_picture_names_each_design_once():
    merged, _ = merged_scene([SCENE, SCENE], ["A", "B"])
    figure = draw_scene(merged, "machine", [0.3])
    assert [text.get_text() for text in figure.legends[0].get_texts()] == ["A", "B"]
    assert [line.get_color() for line in figure.axes[0].lines] == [colour(role) for role in SERIES[:2]]
    assert [trace["colour"] for trace in pack_scene(merged)["traces"]] == list(SERIES[:2])
    assert "colour" not in pack_scene(SCENE)["traces"][0]
    box = figure.axes[0].get_position()
    width, height = figure.get_size_inches()
    low, high = figure.axes[0].get_xlim(), figure.axes[0].get_ylim()
    assert box.width * width / (low[1] - low[0]) == pytest.approx(box.height * height / (high[1] - high[0]))
