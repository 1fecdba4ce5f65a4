"""Moving pictures: a scene over its cycle as images of one size, drawn to one scale, and an endless WebP of them.

Pillow, which matplotlib brings, writes the files; nothing here is needed to look at them.
"""

import io
from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.scene import Frame, Scene, place
from drivewright.view.motion import pose_at, seen_from
from drivewright.view.outlines import overall_size, simplified_points
from drivewright.view.sketches import draw_moment, observer_of
from drivewright.view.style import styled

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from PIL.Image import Image

MARGIN = 0.05  # of the larger side of what is shown, on every side
LOOKS = 24  # phases at which the room that a scene takes is measured
COARSE = 4e-3  # of the scene's size: what the outlines lose where only their extent counts
DPI = 100.0
KEY_IMAGES = (9, 17)  # images of a moving file from one that is stored whole to the next: fewer leave traces of what has gone
MM = 1e3


class View(NamedTuple):
    """What is seen of a scene: its observer, and the box low ... high (x, y) [m] that fills the picture."""

    observer: Frame
    low: Floats
    high: Floats


def view_of(scene: Scene, aspect: float, frame: str | None = None, part: Sequence[float] = (0.0, 0.0, 1.0, 1.0)) -> View:
    """The `View` of a whole cycle for a picture with width / height = `aspect`.

    `part` (left, bottom, right, top) is the share of the box around everything that is shown, 0 0 1 1 all of it.
    """
    observer = observer_of(scene, frame)
    low, high = _extent(scene, observer)
    low, high = low + np.array(part[:2]) * (high - low), low + np.array(part[2:]) * (high - low)
    middle, size = (low + high) / 2, (high - low) * (1 + 2 * MARGIN)
    width = max(size[0], aspect * size[1])
    half = np.array([width, width / aspect]) / 2
    return View(observer, middle - half, middle + half)


def _extent(scene: Scene, observer: Frame) -> tuple[Floats, Floats]:
    """The box around all bodies over the cycle, their axes apart."""
    tolerance = COARSE * overall_size(scene)
    corners = []
    for phase in np.arange(LOOKS) / LOOKS:
        eye = pose_at(observer.poses, scene.cycle, phase)
        for body in scene.bodies:
            pose = seen_from(pose_at(body.poses, scene.cycle, phase)[None], eye[None])[0]
            for shape in (shape for shape in body.shapes if shape.layer != "axis"):
                points = place(simplified_points(shape.outline, tolerance), pose)
                corners += [points.min(axis=0), points.max(axis=0)]
    return np.min(corners, axis=0), np.max(corners, axis=0)


def draw_view(scene: Scene, view: View, phase: float, size: tuple[int, int]) -> "Figure":
    """Figure of a scene at a phase of its cycle, `size` pixels (width, height) large at 100 dpi, without axes and names."""
    from matplotlib.figure import Figure

    with styled():
        figure = Figure(figsize=(size[0] / DPI, size[1] / DPI), dpi=DPI)
        axis = figure.add_axes((0, 0, 1, 1))
        draw_moment(axis, scene, view.observer, phase)
        axis.set(xlim=MM * np.array([view.low[0], view.high[0]]), ylim=MM * np.array([view.low[1], view.high[1]]), aspect="equal")
        axis.set_axis_off()
    return figure


def image(figure: "Figure", scale: float = 1.0) -> "Image":
    """A figure as pixels, `scale` times as many as its own."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from PIL import Image

    with styled():
        figure.set_dpi(DPI * scale)
        canvas = FigureCanvasAgg(figure)
        canvas.draw()
    return Image.fromarray(np.asarray(canvas.buffer_rgba())).convert("RGB")


def images(scene: Scene, view: View, count: int, size: tuple[int, int], scale: float = 1.0) -> "list[Image]":
    """`count` images evenly over the cycle, the last one a step before the first comes again."""
    return [image(draw_view(scene, view, n / count, size), scale) for n in range(count)]


def still_webp(picture: "Image", quality: int = 80) -> bytes:
    """One image as a WebP file."""
    sink = io.BytesIO()
    picture.save(sink, "WEBP", quality=quality, method=6)
    return sink.getvalue()


def moving_webp(pictures: "Sequence[Image]", period: float, quality: int = 80) -> bytes:
    """Images as a WebP file that runs endlessly, one round in `period` seconds."""
    sink = io.BytesIO()
    first, *others = pictures
    step = round(1000 * period / len(pictures))
    look = {"quality": quality, "method": 6, "kmin": KEY_IMAGES[0], "kmax": KEY_IMAGES[1]}
    first.save(sink, "WEBP", save_all=True, append_images=others, duration=step, loop=0, **look)
    return sink.getvalue()


def largest_within(budget: int, pictures: "Sequence[Image]", period: float, quality: int = 80) -> bytes:
    """The moving WebP of all images, or where that has more than `budget` bytes of every second, third, fourth one."""
    made = b""
    for each in (1, 2, 3, 4):
        made = moving_webp(pictures[::each], period, quality)
        if len(made) <= budget:
            break
    return made
