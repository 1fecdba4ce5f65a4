"""A closed triangle surface seen from the side: nearest triangles last, coloured by a quantity, lightly shaded, its shape before dashed.

Where the quantity is nan it was not evaluated: grey.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from drivewright._typing import Bools, Floats, Ints
from drivewright.view.palette import BARE, COLOUR_MAP, colour
from drivewright.view.panels import DECADES, Panel
from drivewright.view.style import WIDTH, log_ticks, new_figure, styled
from drivewright.view.text import axis_label, parts_of_label

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

LIGHT = np.array([-0.35, 0.75, 0.56])  # from the upper left, in front: right, up, towards the viewer
DARKEST = 0.72  # brightness of what the light does not reach


def draw_mesh(shown: Sequence[Panel]) -> "Figure":
    """Figure of a panel of style "mesh"; axes in the panel's units at one scale, a colour bar below."""
    from matplotlib import colormaps
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import LogNorm, Normalize

    panel = shown[0]
    up, depth, size, *before = panel.series
    corners = np.stack([panel.x.data, up.data, -depth.data], axis=1).reshape(-1, 3, 3)
    seen, order, bright = facing(corners)
    low, high = colour_range(size.data, panel.log)
    tint = _of_triangles(size.data, high, panel.log)[seen][order]
    scale = ScalarMappable((LogNorm if panel.log else Normalize)(low, high), colormaps[COLOUR_MAP].with_extremes(bad=BARE))
    with styled():
        figure = new_figure(_height(corners), panel.title)
        axis = figure.subplots()
        _paint(axis, corners[seen][order][:, :, :2], scale.to_rgba(tint)[:, :3] * bright[order, None])
        for ring in silhouette(*(series.data for series in before)) if before else ():
            axis.plot(*ring.T, color=colour("ink"), lw=0.8, ls=(0, (5, 3)))
        axis.set_aspect("equal", adjustable="datalim")
        axis.autoscale_view()
        axis.set(xlabel=axis_label(panel.x.label, panel.x.unit), ylabel=axis_label(*parts_of_label(panel.label), width=30))
        label, beyond = axis_label(size.label, size.unit), "max" if np.any(size.data > high) else "neither"
        bar = figure.colorbar(scale, ax=axis, orientation="horizontal", aspect=45, pad=0.02, shrink=0.7, label=label, extend=beyond)
        bar.outline.set_visible(False)
        if panel.log:
            log_ticks(bar.ax.xaxis)
    return figure


def colour_range(data: Floats, log: bool) -> tuple[float, float]:
    """Ends of the colours: from 0 to the greatest; on a logarithmic scale from the least to the greatest, `DECADES` at most."""
    finite = data[np.isfinite(data) & (data > 0)]
    most = float(finite.max(initial=0.0)) or 1.0
    if not log:
        return 0.0, most
    least = float(finite.min(initial=most))
    return (least, min(most, least * 10.0**DECADES)) if least < most else (0.1 * most, most)


def _of_triangles(data: Floats, high: float, log: bool) -> Floats:
    """Means of the corners' values (3 m,), of the logarithms where the scale is so, of nothing beyond its upper end."""
    values = np.minimum(data, high).reshape(-1, 3)  # nan stays
    return np.exp(np.log(values).mean(axis=1)) if log else values.mean(axis=1)


def facing(corners: Floats) -> tuple[Bools, Ints, Floats]:
    """Of triangles (m, 3, 3), z towards the viewer: (which face the viewer (m,), their order from far to near, their brightness)."""
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    seen = normal[:, 2] > 0
    normal = normal[seen] / np.linalg.norm(normal[seen], axis=1, keepdims=True)
    bright = DARKEST + (1 - DARKEST) * np.clip(normal @ LIGHT, 0.0, 1.0)
    return seen, np.argsort(corners[seen, :, 2].mean(axis=1), kind="stable"), bright


def silhouette(right: Floats, up: Floats) -> list[Floats]:
    """Rings (n, 2) around the picture of triangles, three rows each."""
    import shapely

    triangles = np.stack([right, up], axis=1).reshape(-1, 3, 2)
    shape = shapely.union_all(shapely.buffer(shapely.polygons(triangles), 1e-9 * np.ptp(right)))
    return [shapely.get_coordinates(shapely.simplify(ring, 1e-4 * np.ptp(right))) for ring in shapely.get_parts(shapely.boundary(shape))]


def _paint(axis: "Axes", triangles: Floats, colours: Floats) -> None:
    """Triangles as an image: as outlines they would be megabytes."""
    from matplotlib.collections import PolyCollection

    axis.add_collection(PolyCollection(list(triangles), facecolors=colours, linewidths=0, antialiaseds=False, rasterized=True, zorder=2))


def _height(corners: Floats) -> float:
    """Inches: room for the picture at full width, between a flat strip and a square."""
    wide, tall = np.ptp(corners.reshape(-1, 3), axis=0)[:2]
    return float(np.clip(1.9 + 0.85 * WIDTH * tall / wide, 2.7, 6.0))
