"""Solids as a picture on paper: triangles with hidden surfaces removed pixel by pixel, edges where faces meet in a crease."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from drivewright._typing import Floats, Ints
from drivewright.solids.shading import surface_shape
from drivewright.view.palette import colour
from drivewright.view.style import WIDTH, new_figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure

TURN, TILT = 0.62, 0.5  # rad: the oblique view of the page's viewer
PIXELS = 1500  # across the picture; the margin is part of it
MARGIN = 0.04
KEY, BACK = np.array([-0.35, 0.55, 0.76]), np.array([0.7, -0.25, 0.35])  # where light comes from: right, up, towards the eye
EDGE = 0.45  # how dark an edge is over its face
BEHIND = 1.5  # pixels that an edge may lie behind the faces that meet in it


class Surface(Protocol):
    """What is drawn of a part: points (n, 3) [m] and corners (m, 3), counter-clockwise from outside."""

    @property
    def colour(self) -> str:
        """Name of a colour of the palette."""
        ...

    @property
    def points(self) -> Floats:
        """Points (n, 3) [m]."""
        ...

    @property
    def corners(self) -> Ints:
        """Points of each triangle (m, 3)."""
        ...


class _Canvas(NamedTuple):
    """Red, green, blue (h, w, 3) of each pixel and how near to the eye it is (h, w)."""

    paint: Floats
    depth: Floats


def draw_solids(surfaces: Sequence[Surface], title: str = "Solids of the assembly") -> "Figure":
    """Figure of surfaces in an oblique view."""
    image = solid_image(surfaces)
    figure = new_figure(0.4 + WIDTH * image.shape[0] / image.shape[1], title)
    axis = figure.add_subplot()
    axis.imshow(image, interpolation="antialiased")
    axis.set_axis_off()
    return figure


def solid_image(surfaces: Sequence[Surface], wide: int = PIXELS) -> NDArray[np.uint8]:
    """Image (h, w, 3) of surfaces in an oblique view on white."""
    axes = view_axes(TURN, TILT)
    turned = [each.points @ axes.T for each in surfaces]
    low, high = (end([end(points, axis=0) for points in turned], axis=0) for end in (np.min, np.max))
    scale = wide * (1 - 2 * MARGIN) / max(high[0] - low[0], (high[1] - low[1]) / 0.75)
    size = np.ceil(scale * (high - low)[:2] + 2 * MARGIN * wide).astype(int)
    canvas = _Canvas(np.full((size[1], size[0], 3), 1.0), np.full((size[1], size[0]), -np.inf))
    middle = 0.5 * (low + high)
    for each, points in zip(surfaces, turned, strict=True):
        spots = scale * (points - middle) * [1, -1, 1] + [*(size / 2), 0.0]  # pixels: right, down, towards the eye
        shape = surface_shape(each.points, each.corners)
        _fill(canvas, spots[shape.corners], _shade(shape.normals @ axes.T, colour(each.colour)))
    for each, points in zip(surfaces, turned, strict=True):
        spots = scale * (points - middle) * [1, -1, 1] + [*(size / 2), 0.0]
        _line(canvas, spots[surface_shape(each.points, each.corners).edges])
    return (255 * np.clip(canvas.paint, 0, 1)).astype(np.uint8)


def view_axes(turn: float, tilt: float) -> Floats:
    """Rows right, up, towards the eye of a view that is turned about y first, then tilted [rad]."""
    c, s, ct, st = np.cos(turn), np.sin(turn), np.cos(tilt), np.sin(tilt)
    return np.array([[c, 0.0, -s], [-s * st, ct, -c * st], [s * ct, st, c * ct]])


def _shade(normals, hexadecimal):
    """Colours (m, 3, 3) at the corners of triangles by their normals, as the page's viewer shades them."""
    plain = np.array([int(hexadecimal[k : k + 2], 16) for k in (1, 3, 5)]) / 255
    light = 0.42 + 0.1 * normals[..., 1]
    for share, towards in ((0.5, KEY), (0.14, BACK)):
        light = light + share * np.maximum(normals @ (towards / np.linalg.norm(towards)), 0.0)
    rim = 0.18 * (1 - np.abs(normals[..., 2])) ** 3
    return (0.34 + 0.66 * plain) * light[..., None] + rim[..., None]


def _fill(canvas, triangles, colours):
    """Triangles (m, 3, 3) [pixels] that face the eye, each pixel where it is the nearest so far."""
    (ax, ay), (bx, by) = (np.moveaxis(triangles[:, k, :2] - triangles[:, 0, :2], 1, 0) for k in (1, 2))
    twice = ax * by - ay * bx  # y points down: a face towards the eye runs clockwise
    high, wide = canvas.depth.shape
    low = np.maximum(np.floor(triangles[..., :2].min(axis=1)), 0).astype(int)
    end = np.minimum(np.ceil(triangles[..., :2].max(axis=1)) + 1, [wide, high]).astype(int)
    for n in np.flatnonzero(twice < 0):
        (x0, y0), (x1, y1) = low[n], end[n]
        x, y = np.arange(x0, x1)[None, :] + 0.5 - triangles[n, 0, 0], np.arange(y0, y1)[:, None] + 0.5 - triangles[n, 0, 1]
        b, c = (x * by[n] - y * bx[n]) / twice[n], (ax[n] * y - ay[n] * x) / twice[n]
        depth = triangles[n, 0, 2] + b * (triangles[n, 1, 2] - triangles[n, 0, 2]) + c * (triangles[n, 2, 2] - triangles[n, 0, 2])
        window = np.s_[y0:y1, x0:x1]
        inside = (b >= -1e-9) & (c >= -1e-9) & (b + c <= 1 + 1e-9) & (depth > canvas.depth[window])
        canvas.depth[window][inside] = depth[inside]
        share = np.stack([1 - b - c, b, c], axis=-1)[inside]
        canvas.paint[window][inside] = share @ colours[n]


def _line(canvas, edges):
    """Edges (e, 2, 3) [pixels] where they are not behind a face."""
    if not len(edges):
        return
    steps = np.maximum(np.ceil(1.4 * np.linalg.norm(np.diff(edges[..., :2], axis=1)[:, 0], axis=1)), 1).astype(int) + 1
    of = np.repeat(np.arange(len(edges)), steps)
    part = (np.arange(len(of)) - np.repeat(np.cumsum(steps) - steps, steps)) / np.maximum(steps[of] - 1, 1)
    spots = edges[of, 0] + part[:, None] * (edges[of, 1] - edges[of, 0])
    x, y = np.floor(spots[:, :2]).astype(int).T
    high, wide = canvas.depth.shape
    kept = (x >= 0) & (x < wide) & (y >= 0) & (y < high)
    x, y, depth = x[kept], y[kept], spots[kept, 2]
    seen = depth > canvas.depth[y, x] - BEHIND
    pixels = np.unique(np.stack([y[seen], x[seen]]), axis=1)
    canvas.paint[pixels[0], pixels[1]] *= 1 - EDGE
