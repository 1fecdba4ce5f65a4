"""Curves that lie upon each other: all of them show, and the legend says which are the same."""

import numpy as np
import pytest

from drivewright import registry
from drivewright.result import Column, Plot, Result, Table
from drivewright.view import draw_panels
from drivewright.view.overlays import overlay
from drivewright.view.palette import SERIES, colour

pytestmark = pytest.mark.interface

X = np.linspace(0.0, 10.0, 401)


@pytest.fixture(autouse=True)
def kind(monkeypatch):
    """A kind with a plot of lines, one of a logarithmic axis and one of points."""
    plots = (
        Plot("lines", "P", "t", "x", ("y",)),
        Plot("log", "P", "t", "x", ("y",), log=True),
        Plot("points", "P", "t", "x", ("y",), style="points"),
    )
    monkeypatch.setattr(registry, "is_known", lambda kind: True)
    monkeypatch.setattr(registry, "mechanism", lambda kind: type("Kind", (), {"plots": plots}))


def design(y, x=X):
    table = Table("t", "T", (Column("x", "-", "place", np.asarray(x, float)), Column("y", "N", "force", np.asarray(y, float))))
    return Result(None, "nothing", "t", "", {}, {"t": table}, (), (), {})


def panel_of(*designs, plot="lines", labels="ABCD"):
    return overlay(designs, list(labels)[: len(designs)] if isinstance(labels, str) else labels, plot).panels[0]


def dashes(panel):
    """(colour, first x, last x, length of the gap over that of the dash) of every dashed line, in the order in which they are drawn."""
    found = []
    for line in draw_panels((panel,)).axes[0].lines:
        if line.is_dashed():
            shown = np.asarray(line.get_xdata())[np.isfinite(line.get_ydata())]
            on, off = line._unscaled_dash_pattern[1]
            found.append((line.get_color(), shown[0], shown[-1], off / on))
    return found


def test_two_equal_curves_are_dashed_upon_each_other_and_named_so():
    panel = panel_of(design(np.sin(X)), design(np.sin(X)))
    assert [series.label for series in panel.series] == ["A", "B (same as A)"]
    assert dashes(panel) == [(colour(SERIES[0]), 0.0, 10.0, 1.0)]


def test_three_equal_curves_all_show():
    panel = panel_of(*[design(np.sin(X))] * 3)
    assert [series.label for series in panel.series] == ["A", "B (same as A)", "C (same as A)"]
    assert dashes(panel) == [(colour(SERIES[1]), 0.0, 10.0, 1.0), (colour(SERIES[0]), 0.0, 10.0, 2.0)]


def test_curves_that_are_apart_are_left_alone():
    panel = panel_of(design(np.sin(X)), design(np.cos(X)), design(2 + np.sin(X)))
    assert [series.label for series in panel.series] == ["A", "B", "C"]
    assert all(line.get_label()[0] != "_" or not line.is_dashed() for line in draw_panels((panel,)).axes[0].lines)


def test_a_stretch_that_coincides_is_dashed_and_the_curves_keep_their_names():
    panel = panel_of(design(np.where(X < 6, X, 6.0)), design(X))
    assert [series.label for series in panel.series] == ["A", "B"]
    ((hue, first, last, _),) = dashes(panel)
    assert hue == colour(SERIES[0]) and first == 0.0 and last == pytest.approx(6.0, abs=0.06)


def test_a_crossing_is_no_coincidence():
    assert dashes(panel_of(design(X), design(10 - X))) == []


def test_curves_over_other_places_are_compared_between_them():
    other = np.linspace(0.0, 10.0, 301)
    panel = panel_of(design(2 * X), design(2 * other, other))
    assert panel.series[1].label == "B (same as A)" and len(dashes(panel)) == 1
    shorter = np.linspace(0.0, 5.0, 301)
    panel = panel_of(design(2 * X), design(2 * shorter, shorter))
    assert panel.series[1].label == "B" and dashes(panel)[0][2] == pytest.approx(5.0)


def test_a_difference_that_nobody_sees_is_dashed_but_not_called_the_same():
    panel = panel_of(design(np.sin(X)), design(np.sin(X) + 1e-4))
    assert panel.series[1].label == "B" and len(dashes(panel)) == 1


def test_on_a_logarithmic_axis_powers_count():
    decades = 10.0 ** (X / 2)
    assert dashes(panel_of(design(decades), design(1.3 * decades), plot="lines")) != []
    assert dashes(panel_of(design(decades), design(1.3 * decades), plot="log")) == []


def test_gaps_belong_to_a_curve():
    holed = np.where((X > 3) & (X < 4), np.nan, X)
    assert panel_of(design(holed), design(holed)).series[1].label == "B (same as A)"
    assert panel_of(design(holed), design(X)).series[1].label == "B"


def test_points_are_named_and_not_dashed():
    panel = panel_of(design(X), design(X), plot="points")
    assert panel.series[1].label == "B (same as A)" and dashes(panel) == []


def test_a_long_name_is_cut_in_the_legend():
    panel = panel_of(design(X), design(X), labels=["Disc cam with a spring-loaded roller", "B"])
    assert panel.series[1].label == "B (same as Disc cam with a spring-…)"


def test_markers_lie_upon_the_dashes():
    lines = draw_panels((panel_of(design(X), design(X)),)).axes[0].lines
    dashed = max(line.get_zorder() for line in lines if line.is_dashed())
    marked = [line for line in lines if line.get_linestyle() == "None"]
    assert len(marked) == 2 and all(line.get_zorder() > dashed for line in marked)
