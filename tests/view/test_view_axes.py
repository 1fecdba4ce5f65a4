"""A plot drawn into axes that the caller gives: lines, maps and polar ones; what needs axes of its own is refused."""

from dataclasses import replace

import numpy as np
import pytest
from matplotlib.figure import Figure
from sample_designs import four_bar_result

from drivewright.errors import InputError
from drivewright.result import Column, Plot, Table
from drivewright.view import draw_panels
from drivewright.view.figures import draw_into
from drivewright.view.panels import panels

pytestmark = pytest.mark.interface

GRID = Table(
    "grid",
    "Grid",
    (
        Column("speed", "rad/s", "speed", np.repeat([1.0, 2.0, 3.0], 2)),
        Column("play", "m", "radial play", np.tile([1e-3, 2e-3], 3)),
        Column("angle", "rad", "place around the shaft", np.linspace(0, 5, 6)),
        Column("load", "N", "load", np.arange(1.0, 7.0)),
        Column("length", "m", "length", np.arange(1.0, 7.0)),
    ),
)
RESULT = replace(four_bar_result(), tables={"grid": GRID})


def shown(style, x="angle", y=("load",)):
    return panels(RESULT, Plot("p", "P", "grid", x, y, style=style))


def two_axes(**options):
    """A figure of the caller with two axes side by side."""
    return Figure().subplots(1, 2, **options)


def test_a_table_is_drawn_into_the_axes_and_nowhere_else():
    left, right = two_axes()
    result = four_bar_result()
    name = next(name for name, table in result.tables.items() if len({c.unit for c in table.columns[1:]}) == 1)
    assert result.plot(name, ax=right) is right.figure
    own = result.plot(name).axes[0]
    assert not left.lines and len(right.lines) == len(own.lines)
    for ours, theirs in zip(right.lines, own.lines, strict=True):
        np.testing.assert_array_equal(ours.get_xydata(), theirs.get_xydata())
    assert (right.get_xlabel(), right.get_ylabel()) == (own.get_xlabel(), own.get_ylabel())


def test_a_map_is_drawn_with_its_colour_bar():
    left, right = two_axes()
    figure = draw_into(left, shown("map", "speed", ("play", "load")), "p")
    own = draw_panels(shown("map", "speed", ("play", "load"))).axes[0]
    assert figure is left.figure and len(figure.axes) == 3 and not right.collections
    np.testing.assert_array_equal(left.collections[0].get_array(), own.collections[0].get_array())


def test_a_polar_plot_wants_polar_axes_and_others_do_not():
    (axis,) = np.ravel(Figure().subplots(1, 1, subplot_kw={"projection": "polar"}, squeeze=False))
    assert draw_into(axis, shown("polar"), "p") is axis.figure
    assert list(axis.lines[0].get_ydata()) == list(range(1, 7))
    with pytest.raises(InputError, match="plot 'p': it needs polar axes"):
        draw_into(two_axes()[0], shown("polar"), "p")
    with pytest.raises(InputError, match="plot 'p': it needs plain axes; these are polar"):
        draw_into(axis, shown("line"), "p")


def test_several_panels_and_figures_of_their_own_are_refused():
    left, _ = two_axes()
    with pytest.raises(InputError, match="plot 'p': it has 2 panels"):
        draw_into(left, shown("line", y=("load", "length")), "p")
    with pytest.raises(InputError, match="plot 'p': its style 'histogram' needs a figure of its own"):
        draw_into(left, shown("histogram"), "p")
    with pytest.raises(InputError, match="plot 'grid': ax is a ndarray; give one matplotlib Axes"):
        RESULT.plot("grid", ax=two_axes())
    assert not left.lines
