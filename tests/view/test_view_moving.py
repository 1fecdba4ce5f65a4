"""Moving pictures of a scene: everything stays within the picture, the cycle closes, the file runs endlessly."""

import io
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from drivewright.scene import Body, Frame, Scene, Shape, circle
from drivewright.view.moving import draw_view, image, images, largest_within, moving_webp, still_webp, view_of

pytestmark = pytest.mark.interface

TURN = np.linspace(0, 2 * np.pi, 13)
ROUND = np.stack([0.05 * np.cos(TURN), 0.05 * np.sin(TURN), TURN], axis=1)
SIZE = (160, 100)


def _scene(poses=ROUND):
    ball = Body("ball", "ball", (Shape("body", circle((0.01, 0.0), 0.01)),), poses, "orange")
    return Scene(TURN, "angle", "rad", 1.0, (ball,), (Frame("machine", "machine", 0 * ROUND),))


def _ink(picture):
    """Where the picture is not white."""
    return np.asarray(picture.convert("L")) < 250


def test_a_whole_cycle_fits_into_the_picture_and_fills_it():
    scene = _scene()
    seen = np.any([_ink(picture) for picture in images(scene, view_of(scene, 1.6), 24, SIZE)], axis=0)
    rows, columns = np.flatnonzero(seen.any(axis=1)), np.flatnonzero(seen.any(axis=0))
    assert rows[0] >= 2 and rows[-1] <= SIZE[1] - 3 and np.ptp(rows) > 0.85 * SIZE[1], (
        "the ball's round leaves the picture, or is small in it"
    )
    assert columns[0] >= 2 and columns[-1] <= SIZE[0] - 3


def test_what_is_shown_for_a_part_of_the_cycle_is_left_out_of_the_rest():
    scene = _scene()
    still = replace(scene.bodies[0], name="still", poses=0 * ROUND)
    half = replace(scene, bodies=(still, replace(scene.bodies[0], shown=np.arange(13) < 6)))
    early, late = (_ink(image(draw_view(half, view_of(scene, 1.6), phase, SIZE))).sum() for phase in (0.2, 0.8))
    assert early > 1.5 * late > 0


def test_a_part_of_the_picture_is_drawn_larger():
    whole, part = (view_of(_scene(), 1.6, part=part) for part in ((0, 0, 1, 1), (0, 0, 0.5, 0.5)))
    np.testing.assert_allclose(part.high - part.low, (whole.high - whole.low) / 2)


def test_lengths_have_one_scale_both_ways():
    view = view_of(_scene(), 1.6)
    assert (view.high - view.low)[0] / (view.high - view.low)[1] == pytest.approx(1.6)


def test_the_cycle_closes_and_an_open_one_is_seen():
    ends = [np.asarray(image(draw_view(_scene(), view_of(_scene(), 1.6), phase, SIZE))) for phase in (0.0, 1.0)]
    assert np.array_equal(*ends)
    open_ = _scene(ROUND + np.outer(TURN, [0.01, 0, 0]))
    ends = [np.asarray(image(draw_view(open_, view_of(open_, 1.6), phase, SIZE))) for phase in (0.0, 1.0)]
    assert not np.array_equal(*ends)


def test_axes_take_no_room():
    scene = _scene()
    far = Shape("axis", circle((0.0, 0.0), 1.0))
    drawn = replace(scene, bodies=(replace(scene.bodies[0], shapes=(*scene.bodies[0].shapes, far)),))
    np.testing.assert_allclose(view_of(drawn, 1.6).low, view_of(scene, 1.6).low)


def test_a_moving_file_runs_endlessly_in_the_period():
    scene = _scene()
    file = Image.open(io.BytesIO(moving_webp(images(scene, view_of(scene, 1.6), 6, SIZE), 1.2)))
    lengths = []
    for number in range(file.n_frames):
        file.seek(number)
        file.load()
        lengths.append(file.info["duration"])
    assert file.n_frames == 6 and file.info["loop"] == 0 and sum(lengths) == 1200
    still = Image.open(io.BytesIO(still_webp(image(draw_view(scene, view_of(scene, 1.6), 0.0, SIZE)))))
    assert still.size == SIZE and getattr(still, "n_frames", 1) == 1


def test_fewer_images_where_the_budget_is_small():
    scene = _scene()
    pictures = images(scene, view_of(scene, 1.6), 12, SIZE)
    whole = moving_webp(pictures, 1.2)
    assert largest_within(len(whole), pictures, 1.2) == whole
    half = largest_within(len(whole) - 1, pictures, 1.2)
    assert half == moving_webp(pictures[::2], 1.2) and len(half) < len(whole)
