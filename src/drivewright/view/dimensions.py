"""Drawings with lines of measure: what the keys of a spec measure, each named with its key and value beside the drawing.

The names stand in two columns, left and right of the drawing, in the order of the lines that they belong to, so that none lies on another.
"""

import math
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.dimensions import Angle, Dimension, DimensionSheet, Length, Radius
from drivewright.scene import Scene, place
from drivewright.view.outlines import overall_size, simplified_points
from drivewright.view.palette import colour
from drivewright.view.sketches import draw_moment
from drivewright.view.style import TITLE, styled
from drivewright.view.text import quantity

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PICTURE_WIDTH, PICTURE_HEIGHT, HEAD = 4.4, 4.1, 0.45  # inches: widest and tallest drawing, title
COLUMN, LETTER, MARGIN = 1.75, 0.0665, 0.1  # inches: names on each side, at least; a letter of a key, and what is beside it
GAP = 0.15  # inches between the names and the drawing
ROW = 0.36  # inches that a name and its value take
COARSE = 2e-3  # of the scene's size: what the outlines lose where only their extent counts
MM = 1e3
INK, MUTED = colour("ink"), colour("muted")
BOTH = {"arrowstyle": "<|-|>,head_length=5,head_width=1.8", "color": INK, "lw": 0.9, "shrinkA": 0, "shrinkB": 0}
ONE = {**BOTH, "arrowstyle": "-|>,head_length=5,head_width=1.8"}
THIN = {"color": MUTED, "lw": 0.6, "zorder": 4}
LEVEL = 0.35  # of its length that a line of measure rises at most to count as level
LEADER = {"color": colour("accent"), "lw": 0.6, "zorder": 5}
OVER = 0.02  # of the scene's size that a thin line goes beyond the line of measure
ARC_POINTS = 60


class Drawn(NamedTuple):
    """A dimension as lines [m]: its line of measure with arrows at both ends or at the last, thin lines, and where its name points to."""

    dimension: Dimension
    measure: Floats
    double: bool
    thin: tuple[Floats, ...]
    anchor: Floats


def draw_dimensions(sheet: DimensionSheet, scene: Scene, dimensions: Iterable[Dimension]) -> "Figure":
    """Figure of a scene at its start, to one scale, with the lines of measure of `dimensions`, named in columns."""
    from matplotlib.figure import Figure

    corners = _corners(scene)
    size = float(np.ptp(corners, axis=0).max())
    drawn = [_lines(dimension, size) for dimension in dimensions]
    points = np.concatenate([corners, *(each.measure for each in drawn), *(line for each in drawn for line in each.thin)])
    low, high = points.min(axis=0), points.max(axis=0)
    left, right = _columns(drawn)
    column = max(COLUMN, MARGIN + LETTER * max(len(_key(each.dimension)) for each in drawn))
    width = PICTURE_WIDTH + 2 * (column + GAP)
    scale = min(PICTURE_WIDTH / (high - low)[0], PICTURE_HEIGHT / (high - low)[1])
    height = max(scale * (high - low)[1] + 0.2, ROW * max(len(left), len(right)))
    middle, half = (low + high) / 2, np.array([width, height]) / scale / 2
    with styled():
        figure = Figure(figsize=(width, height + HEAD))
        axis = figure.add_axes((0, 0, 1, height / (height + HEAD)))
        draw_moment(axis, scene, scene.frames[0], 0.0)
        axis.set(xlim=_span(middle, half, 0), ylim=_span(middle, half, 1))
        axis.set_axis_off()
        for each in drawn:
            _draw(axis, each)
        for side, names in ((-1, left), (1, right)):
            _name(axis, names, side, middle, half - (column / scale, 0.0), scale)
        figure.suptitle(sheet.title, x=0.02, y=1 - 0.08 / (height + HEAD), va="top", **TITLE)
    return figure


def _span(middle: Floats, half: Floats, number: int) -> tuple[float, float]:
    """Limits of an axis in millimetres."""
    return float(MM * (middle - half)[number]), float(MM * (middle + half)[number])


def _corners(scene: Scene) -> Floats:
    """Corners of the boxes around all that is drawn at the start, axes apart [m]."""
    tolerance, corners = COARSE * overall_size(scene), []
    for body in scene.bodies:
        for shape in (shape for shape in body.shapes if shape.layer != "axis"):
            points = place(simplified_points(shape.outline, tolerance), body.poses[0])
            corners += [points.min(axis=0), points.max(axis=0)]
    return np.array(corners)


# -- lines of measure ------------------------------------------------------------------------------------------------------------


def _lines(dimension: Dimension, size: float) -> Drawn:
    """The lines of a dimension in a scene of a size [m]."""
    return {Length: _of_length, Radius: _of_radius, Angle: _of_angle}[type(dimension)](dimension, size)


def _of_length(dimension: Length, size: float) -> Drawn:
    """Thin lines run from the points to where the line of measure lies aside."""
    start, end = np.array(dimension.start), np.array(dimension.end)
    along = (end - start) / np.hypot(*(end - start))
    side = np.array([-along[1], along[0]]) * math.copysign(1.0, dimension.aside)
    ends = np.array([start, end]) + abs(dimension.aside) * size * side
    thin = tuple(np.array([point, foot + OVER * size * side]) for point, foot in zip((start, end), ends, strict=True) if dimension.aside)
    return Drawn(dimension, ends, True, thin, ends.mean(axis=0))


def _of_radius(dimension: Radius, size: float) -> Drawn:
    """From the centre onto the circle; a diameter from the other side."""
    centre, way = np.array(dimension.centre), _way(dimension.towards)
    rim = centre + dimension.radius * way
    start = centre - dimension.radius * way if dimension.diameter else centre
    return Drawn(dimension, np.array([start, rim]), dimension.diameter, (), (start + rim) / 2)


def _of_angle(dimension: Angle, size: float) -> Drawn:
    """An arc between two thin lines from the centre."""
    radius, centre = dimension.radius * size, np.array(dimension.centre)
    turns = dimension.start + dimension.sweep * np.linspace(0, 1, ARC_POINTS)
    arc = centre + radius * np.stack([np.cos(turns), np.sin(turns)], axis=1)
    thin = tuple(np.array([centre, centre + (radius + OVER * size) * _way(turn)]) for turn in turns[[0, -1]])
    return Drawn(dimension, arc, True, thin, arc[ARC_POINTS // 2])


def _way(angle: float) -> Floats:
    return np.array([math.cos(angle), math.sin(angle)])


def _draw(axis: "Axes", drawn: Drawn) -> None:
    from matplotlib.patches import FancyArrowPatch
    from matplotlib.path import Path

    for line in drawn.thin:
        axis.plot(*(MM * line).T, **THIN)
    axis.add_patch(FancyArrowPatch(path=Path(MM * drawn.measure), zorder=4.5, mutation_scale=1, **(BOTH if drawn.double else ONE)))
    for point in drawn.measure[: 1 if isinstance(drawn.dimension, Radius) else 2] if not drawn.thin and not _is_diameter(drawn) else ():
        axis.plot(*(MM * point), "o", ms=2.6, color=INK, zorder=4.5)


def _is_diameter(drawn: Drawn) -> bool:
    return isinstance(drawn.dimension, Radius) and drawn.dimension.diameter


# -- names -----------------------------------------------------------------------------------------------------------------------


def _columns(drawn: Sequence[Drawn]) -> tuple[list[Drawn], list[Drawn]]:
    """Which names stand on the left and on the right, each from the lowest to the highest: half of them, by where they point to."""
    across = sorted(drawn, key=lambda each: float(each.anchor[0]))
    halves = across[: len(across) // 2], across[len(across) // 2 :]
    left, right = (sorted(half, key=lambda each: float(each.anchor[1])) for half in halves)
    return left, right


def _name(axis: "Axes", column: Sequence[Drawn], side: int, middle: Floats, half: Floats, scale: float) -> None:
    """Keys and values of a column, each with a thin line to what it names; `half` is half the size of what lies between the columns."""
    x = middle[0] + side * half[0]
    heights = spread([float(each.anchor[1]) for each in column], ROW / scale, middle[1] - half[1], middle[1] + half[1])
    for each, y in zip(column, heights, strict=True):
        look = {"ha": "right" if side < 0 else "left", "fontsize": 8.2, "zorder": 6}
        axis.plot(*(MM * np.array([[x + side * 0.02 / scale, y], _named_point(each, side)])).T, **LEADER)
        axis.text(MM * (x + side * 0.06 / scale), MM * y, _key(each.dimension), va="bottom", color=INK, **look)
        axis.text(MM * (x + side * 0.06 / scale), MM * (y - 0.02 / scale), _value(each.dimension), va="top", color=MUTED, **look)


def _named_point(drawn: Drawn, side: int) -> Floats:
    """Where a thin line from a column ends: in the middle of the line of measure, at the nearer end of a level one."""
    ends = drawn.measure[[0, -1]]
    if isinstance(drawn.dimension, Length) and abs(ends[1] - ends[0])[1] < LEVEL * math.dist(*ends):
        return ends[int(np.argmax(side * ends[:, 0]))]
    return drawn.anchor


def _key(dimension: Dimension) -> str:
    return f"{_times(dimension):g} × {dimension.key}" if _times(dimension) != 1 else dimension.key


def _value(dimension: Dimension) -> str:
    value = quantity(dimension.drawn, "rad" if isinstance(dimension, Angle) else "m", 4)
    return f"{_times(dimension):g} × {value}" if _times(dimension) != 1 else value


def _times(dimension: Dimension) -> float:
    """How often the key's value is drawn; a sign tells the sense alone."""
    return 1.0 if isinstance(dimension, Radius) else abs(dimension.times)


def spread(wanted: Sequence[float], room: float, low: float, high: float) -> list[float]:
    """Heights in the order of `wanted`, near to them, at least `room` apart, half of it from low and high where all have place."""
    heights = []
    for value in wanted:
        heights.append(max(value, heights[-1] + room if heights else low + room / 2))
    limit = high - room / 2
    for number in range(len(heights) - 1, -1, -1):
        heights[number] = min(heights[number], limit)
        limit = heights[number] - room
    return heights
