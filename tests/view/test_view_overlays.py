"""A plot of several designs: a panel for each quantity, a curve for each design over its own x."""

from dataclasses import replace

import numpy as np
import pytest

from drivewright import registry
from drivewright.errors import InputError
from drivewright.result import Check, Column, Plot, Result, Table
from drivewright.view import draw_panels
from drivewright.view.overlays import MOST_PANELS, apart, common_plots, is_apart, overlay
from drivewright.view.palette import MARKERS, SERIES

pytestmark = pytest.mark.interface


def result(*columns, checks=(), name="t"):
    return Result(None, "nothing", "t", "", {}, {name: Table(name, "T", tuple(columns))}, tuple(checks), (), {})


def waves(count, scale=1.0):
    """A design with a force and a displacement over `count` angles."""
    x = np.linspace(0, 2 * np.pi, count)
    return result(
        Column("angle", "rad", "crank angle", x),
        Column("force", "N", "force", scale * np.sin(x)),
        Column("path", "m", "path of the rod", scale * np.cos(x)),
    )


@pytest.fixture
def plots(monkeypatch):
    """Sets the plots of the kind."""

    def set_(*plots):
        monkeypatch.setattr(registry, "is_known", lambda kind: True)
        monkeypatch.setattr(registry, "mechanism", lambda kind: type("Kind", (), {"plots": plots}))

    return set_


def test_every_quantity_has_a_panel_with_one_curve_a_design(plots):
    plots(Plot("both", "Both", "t", "angle", ("force", "path")))
    designs = [waves(400), waves(250, 2.0), waves(300, 3.0)]
    shown = overlay(designs, ["A", "B", "C"], "both").panels
    assert [panel.label for panel in shown] == ["Force [N]", "Path of the rod [mm]"]
    for panel, name, factor in zip(shown, ("force", "path"), (1.0, 1e3), strict=True):
        assert [(s.label, s.role, s.marker) for s in panel.series] == list(zip("ABC", SERIES, MARKERS, strict=False))
        for series, design in zip(panel.series, designs, strict=True):
            table = design.tables["t"]
            assert series.data == pytest.approx(factor * table[name].data)
            assert series.x == pytest.approx(np.degrees(table["angle"].data))
    lines = [line for line in draw_panels(shown).axes[1].lines if line.get_label()[0] != "_"]
    assert [len(line.get_xdata()) for line in lines] == [400, 250, 300]
    assert lines[2].get_ydata().max() == pytest.approx(3000.0)


def test_the_range_holds_the_x_of_all_designs(plots):
    plots(Plot("p", "P", "t", "angle", ("force",)))
    near, far = waves(100), waves(100)
    columns = far.tables["t"].columns
    far = result(columns[0]._replace(data=columns[0].data + np.pi), *columns[1:])
    axes = draw_panels(overlay([near, far], ["A", "B"], "p").panels).axes[0]
    assert axes.get_xlim() == pytest.approx((0.0, 540.0))


def test_a_limit_that_is_the_same_for_all_stands_once_else_with_its_design(plots):
    plots(Plot("p", "P", "t", "angle", ("force", "path"), (("most", "allowed"), ("-most", "allowed"))))

    def limited(limit):
        return replace(waves(50), checks=(Check("most", 0.5, limit, "<=", "N", ""),))

    same = overlay([limited(2.0), limited(2.0)], ["A", "B"], "p").panels
    assert same[0].limits == ((2.0, "allowed 2\u00a0N"), (-2.0, "allowed −2\u00a0N")) and same[1].limits == ()
    other = overlay([limited(2.0), limited(3.0)], ["A", "B"], "p").panels[0]
    assert [text for _, text in other.limits][::2] == ["allowed (A) 2\u00a0N", "allowed (B) 3\u00a0N"]


def test_what_is_compared_with_is_dashed_in_the_colour_of_its_design_and_named_once(plots):
    plots(Plot("p", "P", "t", "angle", ("force",), reference=("path",)))
    (panel,) = overlay([waves(50), waves(60)], ["A", "B"], "p").panels
    assert [(s.label, s.role, s.dashed) for s in panel.series] == [
        ("A", "blue", False),
        ("Path of the rod", "blue", True),
        ("B", "orange", False),
        ("", "orange", True),
    ]


def test_a_quantity_that_only_one_design_has_is_counted_not_drawn(plots):
    plots(Plot("p", "P", "t", "angle", ("force",)), Plot("q", "Q", "t", "angle", ("path",)))
    one = waves(50)
    two = result(*one.tables["t"].columns[:2], Column("more", "N", "more", np.zeros(50)))
    assert len(overlay([one, two], ["A", "B"], "t").panels) == 1 and overlay([one, two], ["A", "B"], "t").left_out == 2
    many = result(
        Column("x", "s", "time", np.arange(3.0)), *(Column(f"y{n}", "m", f"y{n}", np.arange(3.0)) for n in range(MOST_PANELS + 4))
    )
    drawn = overlay([many, many], ["A", "B"], "t")
    assert (len(drawn.panels), drawn.left_out) == (MOST_PANELS, 4)


def test_common_plots_are_those_of_two_designs_at_least(plots):
    plots(Plot("p", "P", "t", "angle", ("force",)), Plot("q", "Q", "other", "angle", ("path",)), Plot("r", "R", "none", "angle", ("path",)))
    other = result(*waves(9).tables["t"].columns, name="other")
    both = replace(waves(9), tables={**waves(9).tables, **other.tables})
    assert common_plots([waves(9), both, both]) == {"p": [0, 1, 2], "q": [1, 2]}


def test_bars_stand_side_by_side_over_the_names_of_all(plots):
    plots(Plot("p", "P", "t", "part", ("mass",), style="bars"))

    def parts(names, masses):
        return result(Column("part", "-", "part", np.array(names)), Column("mass", "kg", "mass of the part", np.array(masses)))

    (panel,) = overlay([parts(["rod", "cam"], [1.0, 2.0]), parts(["cam", "pin"], [3.0, 4.0])], ["A", "B"], "p").panels
    assert panel.style == "grouped" and list(panel.x.data) == ["rod", "cam", "pin"]
    axes = draw_panels((panel,)).axes[0]
    found = sorted((round(bar.get_x() + bar.get_width() / 2, 9), bar.get_height()) for bar in axes.patches)
    assert found == [(-0.2, 1.0), (0.8, 2.0), (1.2, 3.0), (2.2, 4.0)]
    assert [tick.get_text() for tick in axes.get_xticklabels()] == ["rod", "cam", "pin"]


def test_ranked_bars_have_a_row_for_each_label_of_any_design(plots):
    plots(Plot("p", "P", "t", "key", ("share",), style="ranked"))

    def shares(names, numbers):
        return result(Column("key", "-", "key", np.array(names)), Column("share", "-", "share", np.array(numbers)))

    (panel,) = overlay([shares(["a", "b"], [0.1, 0.2]), shares(["c", "a"], [0.9, 0.3])], ["A", "B"], "p").panels
    assert list(panel.x.data) == ["c", "a", "b"]
    by_name = {series.label: dict(zip(panel.x.data, series.data, strict=True)) for series in panel.series}
    assert by_name["B"]["c"] == 90.0 and np.isnan(by_name["A"]["c"]) and by_name["A"]["b"] == 20.0  # percent
    assert "no value" not in [text.get_text() for text in draw_panels((panel,)).axes[0].texts]


def test_round_plots_lie_upon_each_other(plots):
    plots(Plot("p", "P", "t", "angle", ("force",), style="polar"))
    axes = draw_panels(overlay([waves(12), waves(8, 2.0)], ["A", "B"], "p").panels).axes[0]
    assert axes.name == "polar" and [len(line.get_xdata()) for line in axes.lines] == [12, 8]
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["A", "B"]


def test_maps_stay_apart_over_one_range_of_colours(plots):
    plots(Plot("p", "P", "t", "a", ("b", "c"), style="map"))

    def field(scale):
        a, b = (each.ravel() for each in np.meshgrid(np.arange(3.0), np.arange(2.0)))
        return result(Column("a", "m", "a", a), Column("b", "m", "b", b), Column("c", "-", "c", scale * (a + b)))

    designs = [field(1.0), field(5.0)]
    assert is_apart(designs, "p")
    drawn = apart(designs, ["A", "B"], "p")
    assert [panel.title for (panel,) in drawn] == ["P – A", "P – B"]
    assert {(panel.low, panel.high) for (panel,) in drawn} == {(0.0, 15.0)}
    with pytest.raises(InputError, match="style 'map' cannot lie upon each other"):
        overlay(designs, ["A", "B"], "p")


def test_the_axis_has_the_words_that_all_designs_have_for_it(plots):
    plots(Plot("p", "P", "t", "angle", ("force",)))

    def mode(text):
        table = waves(9).tables["t"]
        return result(table["angle"], table["force"]._replace(meaning=text))

    (panel,) = overlay([mode("mode 1, 38.8 Hz"), mode("mode 1, 39.8 Hz")], ["A", "B"], "p").panels
    assert panel.label == "Mode 1 [N]"


def test_what_stands_along_the_x_axis_is_named_where_it_is_at_one_place_in_all_designs(monkeypatch):
    """Bearings at 0 and 0.2 m of one shaft, at 0 and 0.3 m of the other: in millimetres, by the name of the one that does not move."""

    def shaft(end):
        x = np.linspace(0.0, end, 50)
        lines = Table("t", "T", (Column("position", "m", "distance", x), Column("force", "N", "force", x)))
        return Result(None, "nothing", str(end), "", {}, {"t": lines}, (), (), {})

    def plots_of(design):
        return (Plot("p", "P", "t", "position", ("force",), places=((0.0, "A"), (design.tables["t"]["position"].data[-1], "B"))),)

    monkeypatch.setattr(registry, "is_known", lambda kind: True)
    monkeypatch.setattr(registry, "mechanism", lambda kind: type("Kind", (), {"plots": staticmethod(plots_of)}))
    assert overlay([shaft(0.2), shaft(0.2), shaft(0.3)], ["one", "two", "three"], "p").panels[0].places == ((0.0, "A"),)
    assert overlay([shaft(0.2), shaft(0.2)], ["one", "two"], "p").panels[0].places == ((0.0, "A"), (pytest.approx(200.0), "B"))


def test_all_designs_are_drawn_in_the_unit_of_the_first(plots):
    plots(Plot("p", "P", "t", "x", ("d",)))

    def deflected(*sizes):
        return result(Column("x", "m", "place", np.array([0.0, 1.0])), Column("d", "m", "deflection", np.array(sizes)))

    (panel,) = overlay([deflected(1e-5, 2e-5), deflected(3e-4, 4e-4)], ["A", "B"], "p").panels
    assert panel.label.endswith("[µm]") and list(panel.series[1].data) == pytest.approx([300.0, 400.0])
