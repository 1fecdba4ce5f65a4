"""Lines of one panel are told apart without colour: each has a marker of its own, in the legend too."""

import numpy as np
import pytest
from sample_designs import PLOTS, four_bar_result

from drivewright.result import Column, Plot, Result, Table
from drivewright.view import draw_panels
from drivewright.view.markers import MARKED, marked_rows
from drivewright.view.palette import MARKERS
from drivewright.view.panels import panels

pytestmark = pytest.mark.interface

RESULT = four_bar_result()
BY_NAME = {plot.name: plot for plot in PLOTS}


def drawn(*columns, rows=400, **plot):
    """Axes of columns over their own index."""
    names = tuple(f"y{n}" for n in range(len(columns)))
    table = Table(
        "t", "T", (Column("x", "s", "time", np.arange(float(rows))), *(Column(n, "m", n, c) for n, c in zip(names, columns, strict=True)))
    )
    result = Result(None, "nothing", "t", "", {}, {"t": table}, (), (), {})
    return draw_panels(panels(result, Plot("t", "T", "t", "x", names, **plot))).axes[0]


def test_every_line_of_a_panel_has_a_marker_of_its_own_also_in_the_legend():
    axes = drawn(*(np.arange(400.0) + n for n in range(4)))
    assert [line.get_marker() for line in axes.lines] == list(MARKERS[:4])
    assert [handle.get_marker() for handle in axes.get_legend().legend_handles] == list(MARKERS[:4])
    rows = [line.get_markevery() for line in axes.lines]
    assert all(6 <= len(each) <= 10 for each in rows) and len({row for each in rows for row in each}) == sum(map(len, rows))


def test_a_single_line_stays_clean():
    (line,) = drawn(np.arange(400.0)).lines
    assert line.get_marker() in (None, "None", "")


def test_what_a_single_line_is_compared_with_is_dashed_and_has_no_marker():
    axes = drawn(np.arange(400.0), rows=400)
    assert len(axes.lines) == 1
    table = Table("t", "T", tuple(Column(n, "m", n, np.arange(400.0)) for n in ("x", "y", "z")))
    result = Result(None, "nothing", "t", "", {}, {"t": table}, (), (), {})
    lines = draw_panels(panels(result, Plot("t", "T", "t", "x", ("y",), reference=("z",)))).axes[0].lines
    assert [line.get_marker() for line in lines] == ["None", "None"] and lines[1].is_dashed()


def test_short_lines_are_marked_at_every_point():
    axes = drawn(np.arange(9.0), np.arange(9.0) + 1, rows=9)
    assert [line.get_markevery() for line in axes.lines] == [None, None]
    assert [line.get_marker() for line in axes.lines] == list(MARKERS[:2])


def test_markers_lie_at_equal_distances_along_x_even_where_the_points_do_not():
    x = np.concatenate([np.linspace(0, 1, 5000, endpoint=False), np.linspace(1, 8, 701)])
    places = x[marked_rows(x, np.sin(x), 0, 2)]
    assert len(places) == MARKED and np.diff(places) == pytest.approx(np.ones(MARKED - 1), abs=0.02)
    assert places[0] == pytest.approx(0.25, abs=0.02)
    other = x[marked_rows(x, np.sin(x), 1, 2)]
    assert other - places == pytest.approx(np.full(MARKED, 0.5), abs=0.02)


def test_markers_follow_the_path_of_a_closed_curve():
    turn = np.linspace(0, 2 * np.pi, 801)
    rows = marked_rows(np.cos(turn), np.sin(turn), 0, 1, upright=False)
    assert np.diff(turn[rows]) == pytest.approx(np.full(MARKED - 1, np.pi / 4), abs=0.02)


def test_gaps_carry_no_marker():
    y = np.where(np.arange(400) < 200, np.nan, 1.0)
    rows = marked_rows(np.arange(400.0), y, 0, 1)
    assert len(rows) == MARKED and min(rows) >= 200
    assert marked_rows(np.arange(3.0), np.full(3, np.nan), 0, 1) == []
