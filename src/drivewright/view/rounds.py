"""A quantity around a circle: the load at each position around a bearing."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from drivewright.view.markers import line_marker
from drivewright.view.palette import colour
from drivewright.view.panels import Panel
from drivewright.view.style import new_figure, styled
from drivewright.view.text import axis_label, literal, parts_of_label

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def draw_round(shown: Sequence[Panel]) -> "Figure":
    """Figure of a panel of style "polar": angles counter-clockwise from the right, x up and down as in the drawing."""
    with styled():
        figure = new_figure(4.2, shown[0].title)
        round_into(figure.add_subplot(projection="polar"), shown[0])
    return figure


def round_into(axis: "Axes", panel: Panel) -> None:
    """Draw a panel of style "polar" into polar axes."""
    several = len(panel.series) > 1
    for number, series in enumerate(panel.series):
        angle, hue = np.deg2rad(panel.x.data if series.x is None else series.x), colour(series.role)
        axis.vlines(angle, 0.0, series.data, color=hue, lw=1.2 if not several else 0.5)
        axis.plot(angle, series.data, color=hue, lw=1.0, marker=series.marker or line_marker(number), ms=4, label=literal(series.label))
    axis.set_ylim(0.0, max(1.05 * max(float(series.data.max()) for series in panel.series), 1e-12))
    cast(Any, axis).set_rlabel_position(22.5)
    axis.set_xlabel(axis_label(*parts_of_label(panel.label)))
    if several:
        axis.legend(loc="upper left", bbox_to_anchor=(1.08, 1.0))
