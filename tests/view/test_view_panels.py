"""Which columns share a panel, in which unit and over which range."""

from dataclasses import replace

import numpy as np
import pytest
from sample_designs import PLOTS, four_bar_result

from drivewright import registry
from drivewright.errors import UnknownName
from drivewright.result import Column, Plot, Table
from drivewright.view.panels import REACH, decimals, drawable, find_plot, limit_text, panels, span

pytestmark = pytest.mark.interface

RESULT = four_bar_result()
BY_NAME = {plot.name: plot for plot in PLOTS}


def test_columns_of_one_unit_share_a_panel_in_display_units():
    (angles,) = panels(RESULT, BY_NAME["transmission"])
    assert [s.name for s in angles.series] == ["transmission", "coupler"]
    assert angles.label == "Angle [°]" and angles.x.unit == "°"
    assert angles.series[0].data == pytest.approx(np.degrees(RESULT.tables["motion"]["transmission"].data))
    assert angles.limits == ((pytest.approx(40.0), "least 40°"),)


def test_other_units_get_a_panel_of_their_own_and_go_on_in_colour():
    speed, acceleration = panels(RESULT, BY_NAME["speed"])
    assert (speed.label, acceleration.label) == ("Rocker speed [rpm]", "Rocker acceleration [rad/s²]")
    assert (speed.series[0].role, acceleration.series[0].role) == ("blue", "orange")
    limited = panels(RESULT, BY_NAME["speed"]._replace(limits=((3.0, "limit"),)))
    assert [len(panel.limits) for panel in limited] == [1, 0]


def test_many_columns_of_one_unit_are_split_so_that_every_line_has_its_colour():
    columns = [Column("t", "s", "time", np.arange(3.0))] + [Column(f"y{n}", "m", f"height {n}", np.arange(3.0) + n) for n in range(12)]
    result = replace(RESULT, tables={"long": Table("long", "Long", tuple(columns))})
    found = panels(result, find_plot(result, "long"))
    assert [len(panel.series) for panel in found] == [5, 5, 2]
    assert all(len({s.role for s in panel.series}) == len(panel.series) for panel in found)


def test_equal_meanings_are_told_apart_by_their_names():
    table = Table(
        "load",
        "Load",
        (
            Column("t", "s", "time", np.arange(3.0)),
            Column("main.force", "N", "normal force", np.arange(3.0)),
            Column("return.force", "N", "normal force", np.arange(3.0)),
        ),
    )
    (panel,) = panels(replace(RESULT, tables={"load": table}), Plot("load", "Load", "load", "t", ("main.force", "return.force")))
    assert [s.label for s in panel.series] == ["Normal force · main", "Normal force · return"]


def test_the_range_shows_data_and_limits_and_cuts_poles():
    low, high = span([[1.0, 3.0, np.nan, np.inf]])
    assert low == pytest.approx(1 - 0.12) and high == pytest.approx(3 + 0.12)
    low, high = span([[1.0, 3.0]], [6.0])
    assert low < 1 and 6 < high < 7
    low, high = span([[1.0, -1e9, 1e9]], [2.0, -0.1])
    assert -low == pytest.approx(REACH * 2 * 1.12) and high == pytest.approx(REACH * 2 * 1.12)


def test_a_range_of_nothing_or_of_one_value_has_a_height():
    assert span([[np.nan]]) == (-1.0, 1.0)
    assert span([[5.0, 5.0]]) == (4.5, 5.5)
    assert span([[0.0, 0.0]]) == (-1.0, 1.0)


def test_running_numbers_keep_four_digits():
    assert [decimals(0, high) for high in (12345, 360, 99.9, 9.99, 0.05)] == [0, 1, 2, 3, 5]
    assert decimals(-360, 1) == 1


def test_a_limit_says_its_value_once():
    assert limit_text(40.0, "allowed", "°") == "allowed 40°"
    assert limit_text(-40.0, "-40 deg", "°") == "-40 deg"
    assert limit_text(1.0, "", "mm") == "1\u00a0mm"


def test_a_plot_is_found_by_name_before_a_table(monkeypatch):
    plots = (Plot("motion", "Only the rocker", "motion", "angle", ("rocker",)), BY_NAME["forces"])
    monkeypatch.setattr(registry, "kinds", lambda: [RESULT.mechanism])
    monkeypatch.setattr(registry, "mechanism", lambda kind: type("Kind", (), {"plots": plots}))
    assert find_plot(RESULT, "motion").y == ("rocker",)
    assert find_plot(RESULT, "links").y == ("length",)
    with pytest.raises(UnknownName, match=r"no table for the plot 'forces' \(its analysis was left out\) is called 'forces'"):
        find_plot(RESULT, "forces")
    with pytest.raises(UnknownName, match="no table or plot is called 'moton'.*did you mean 'motion'"):
        find_plot(RESULT, "moton")


def test_plots_of_analyses_left_out_are_left_out():
    assert [plot.name for plot in drawable(RESULT, PLOTS)] == [plot.name for plot in PLOTS if plot.name != "forces"]


def test_stacked_bars_show_the_whole_stack(monkeypatch):
    """The range holds the sums of what is above and below zero, and a mark stands at their sum."""
    import numpy as np

    from drivewright.result import Column, Plot, Result, Table
    from drivewright.view import figures, panels

    table = Table(
        "t",
        "T",
        (
            Column("part", "-", "entry", np.array(["a", "b"])),
            Column("one", "m", "one", np.array([2e-3, 3e-3])),
            Column("two", "m", "two", np.array([1e-3, -4e-3])),
        ),
    )
    plot = Plot("t", "T", "t", "part", ("one", "two"), style="bars")
    result = Result(None, "nothing", "t", "", {}, {"t": table}, (), (), {})
    (panel,) = panels.panels(result, plot)
    assert panel.low < -4 and panel.high > 3
    figure = figures.draw_panels((panel,))
    sums = figure.axes[0].lines[0].get_ydata()
    assert list(np.round(sums, 9)) == [3.0, -1.0]
    heights = sorted(round(bar.get_y() + bar.get_height(), 9) for bar in figure.axes[0].patches if bar.get_height())
    assert heights == [-4.0, 2.0, 3.0, 3.0]


def test_a_polar_plot_turns_with_the_angle():
    import numpy as np

    from drivewright.result import Column, Plot, Result, Table
    from drivewright.view import figures, panels

    angle = np.linspace(0, 2 * np.pi, 9)
    table = Table("t", "T", (Column("angle", "rad", "angle", angle), Column("load", "N", "load", np.arange(9.0))))
    result = Result(None, "nothing", "t", "", {}, {"t": table}, (), (), {})
    figure = figures.draw_panels(panels.panels(result, Plot("t", "T", "t", "angle", ("load",), style="polar")))
    line = next(line for line in figure.axes[0].lines)
    assert figure.axes[0].name == "polar" and list(line.get_ydata()) == list(range(9))
    assert np.allclose(line.get_xdata(), angle)


SHARES = Table("t", "T", (Column("x", "m", "place", np.array([0.0, 0.1])), Column("a", "-", "share of A", np.array([0.25, 0.75]))))


def with_columns(*columns):
    return replace(four_bar_result(), tables={"t": replace(SHARES, columns=(*SHARES.columns, *columns))})


def drawn(result, *y, **more):
    return panels(result, Plot("p", "P", "t", "x", y, **more))


def test_shares_are_drawn_in_percent_with_their_limit():
    (panel,) = drawn(with_columns(), "a", limits=((0.5, "half"),))
    assert list(panel.series[0].data) == [25.0, 75.0] and panel.label.endswith("[%]") and panel.limits == ((50.0, "half 50\u00a0%"),)
    assert panel.low <= 25.0 and panel.high >= 75.0


def test_a_slope_is_drawn_in_arcmin_unless_an_angle_stands_beside_it():
    slope = Column("s", "rad", "slope", np.array([0.0, np.deg2rad(0.5)]))
    angle = Column("b", "rad", "angle of rotation", np.array([0.0, np.deg2rad(0.5)]))
    (alone,), (both,) = drawn(with_columns(slope), "s"), drawn(with_columns(slope, angle), "s", "b")
    assert alone.series[0].unit == "arcmin" and alone.series[0].data[1] == pytest.approx(30.0)
    assert both.series[0].unit == "°" and both.series[1].data[1] == pytest.approx(0.5)
    (wanted,) = drawn(with_columns(slope), "s", unit="rad")
    assert wanted.series[0].unit == "rad" and wanted.series[0].data[1] == pytest.approx(np.deg2rad(0.5))


def test_samples_of_a_share_and_their_limit_have_one_unit():
    (panel,) = panels(with_columns(), Plot("p", "P", "t", "a", ("a",), limits=((0.5, "half"),), style="histogram"))
    assert panel.x.unit == panel.series[0].unit == "%" and list(panel.x.data) == [25.0, 75.0] and panel.limits[0][0] == 50.0


def test_the_colour_of_a_map_of_shares_is_percent():
    up = Column("y", "m", "height", np.array([0.0, 0.1]))
    (panel,) = panels(with_columns(up), Plot("p", "P", "t", "x", ("y", "a"), limits=((0.5, "half"),), style="map"))
    assert panel.series[1].unit == "%" and (panel.low, panel.high) == (25.0, 75.0) and panel.limits[0][0] == 50.0


def test_points_of_a_share_are_percent():
    group = Column("g", "-", "group", np.array(["u", "v"]))
    (panel,) = panels(with_columns(group), Plot("p", "P", "t", "x", ("a",), by="g", style="points"))
    assert panel.label.endswith("[%]") and panel.series[1].data[1] == 75.0


def test_short_lengths_are_drawn_in_micrometres_unless_the_limit_or_the_drawing_is_large():
    short = with_columns(Column("s", "m", "deflection", np.array([2e-5, -9e-5])))
    (panel,) = drawn(short, "s")
    assert panel.series[0].unit == "µm" and list(panel.series[0].data) == pytest.approx([20.0, -90.0])
    assert drawn(short, "s", limits=((5e-5, "limit"),))[0].limits[0][0] == pytest.approx(50.0)
    assert [p.series[0].unit for p in (*drawn(short, "s", limits=((2e-4, "limit"),)), *drawn(short, "s", equal=True))] == ["mm", "mm"]
    zero = with_columns(Column("s", "m", "deflection", np.zeros(2)))
    assert drawn(zero, "s")[0].series[0].unit == "mm"
    assert panels(short, Plot("p", "P", "t", "x", ("s",)), "inch")[0].series[0].unit == "in"
