"""The figures of studies: maps, histograms, ranked bars, points by group - and what they do with data that is hardly there."""

import io
import re
import warnings
from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest
from sample_designs import four_bar_result, four_bar_scene
from test_view_figures import words

from drivewright.report.pack import pack_plots
from drivewright.result import Check, Column, Plot, Table
from drivewright.view import draw_panels, svg
from drivewright.view.histograms import bin_edges, figures
from drivewright.view.maps import cell_texts, edges, grid, is_geometric, is_smooth
from drivewright.view.palette import MARKERS, SERIES
from drivewright.view.panels import MOST_GROUPS, panels
from drivewright.view.ranked import MOST_ROWS
from drivewright.view.text import sentence, wrapped

pytestmark = pytest.mark.interface

NAN = np.nan


def table(**columns):
    return Table("t", "T", tuple(Column(name, unit, meaning, np.asarray(data)) for name, (unit, meaning, data) in columns.items()))


def shown(found, plot, checks=()):
    return panels(replace(four_bar_result(), tables={"t": found}, checks=checks), plot)


def drawn(found, plot, checks=()):
    return draw_panels(shown(found, plot, checks))


def long_table(x, y, z):
    """Rows of z[j, i] over x[i], y[j], in a mixed order."""
    across, up = (level.ravel() for level in np.meshgrid(x, y))
    order = np.random.default_rng(5).permutation(len(across))
    return table(x=("m", "radius", across[order]), y=("rad", "flank angle", up[order]), z=("Pa", "pressure", np.ravel(z)[order]))


def mapped(**more):
    return Plot("m", "pressure", "t", "x", ("y", "z"), style="map", **more)


def labels(axis):
    legend = axis.get_legend()
    return [text.get_text() for text in legend.get_texts()] if legend else []


# -- maps ----------------------------------------------------------------------------------------------------------------------


def test_a_cell_stands_about_its_own_levels_in_the_units_people_read():
    x, y, z = np.array([1.0, 2.0, 5.0]) * 1e-3, np.radians([10.0, 20.0]), np.array([[1.0, 2, 3], [4, NAN, 6]]) * 1e6
    figure = drawn(long_table(x, y, z), mapped())
    axis, bar = figure.axes
    mesh = axis.collections[0]
    assert np.asarray(mesh.get_coordinates())[0, :, 0] == pytest.approx([0.5, 1.5, 3.5, 6.5])
    assert np.asarray(mesh.get_coordinates())[:, 0, 1] == pytest.approx([5.0, 15.0, 25.0])
    np.testing.assert_allclose(np.ma.filled(mesh.get_array(), -1), [[1.0, 2, 3], [4, -1, 6]])
    assert (axis.get_xlabel(), axis.get_ylabel(), bar.get_ylabel()) == ("Radius [mm]", "Flank angle [°]", "Pressure [MPa]")
    assert mesh.norm.vmin == pytest.approx(1) and mesh.norm.vmax == pytest.approx(6)
    assert labels(axis) == ["No value"] and axis.patch.get_hatch() == "////" and figure.get_suptitle() == "Pressure"
    assert {(round(t.get_position()[0], 9), t.get_text()) for t in axis.texts} == {(1, "1"), (1, "4"), (2, "2"), (5, "3"), (5, "6")}


def test_cells_of_a_geometric_series_are_even_on_a_logarithmic_axis():
    levels = np.geomspace(1e-4, 1e-2, 5)
    assert is_geometric(levels) and not is_geometric(np.linspace(1, 20, 5)) and not is_geometric(np.array([1.0, 1.1, 1.21]))
    borders = edges(levels, True)
    assert np.diff(np.log(borders)) == pytest.approx(np.full(5, np.log(100) / 4)) and borders[0] == pytest.approx(1e-4 / 10**0.25)
    axis = drawn(long_table(levels, np.radians([1.0, 2]), np.arange(10.0).reshape(2, 5)), mapped()).axes[0]
    assert axis.get_xscale() == "log" and axis.get_yscale() == "linear"
    assert axis.get_xlim() == pytest.approx((0.1 / 10**0.25, 10 * 10**0.25))
    assert edges([3.0]) == pytest.approx([2.5, 3.5]) and edges([0.4]) == pytest.approx([0.38, 0.42])


def test_smooth_fields_get_contours_and_noise_does_not():
    x, y = np.linspace(0, 1, 9), np.linspace(0, 1, 7)
    hump = np.sin(2 * x)[None] * np.cos(y)[:, None]
    noise = np.random.default_rng(7).normal(size=(7, 9))
    assert is_smooth(np.ma.masked_invalid(hump)) and not is_smooth(np.ma.masked_invalid(noise))
    hump[3:, :2] = NAN
    assert is_smooth(np.ma.masked_invalid(hump))
    lines = [c for c in drawn(long_table(x, y, hump * 1e6), mapped()).axes[0].collections if hasattr(c, "labelTexts")]
    assert len(lines) == 1 and lines[0].labelTexts
    assert not [c for c in drawn(long_table(x, y, noise), mapped()).axes[0].collections if hasattr(c, "labelTexts")]


def test_a_limit_of_a_map_is_a_contour_where_the_cells_reach_it_and_told_where_not():
    x, y = np.linspace(1, 2, 6), np.linspace(0, 1, 6)
    found = long_table(x, y, np.broadcast_to(x, (6, 6)) * 1e6)
    check = Check("wear", 1.0, 1.55e6, "<=", "Pa", "")
    figure = drawn(found, mapped(limits=(("wear", "allowed"), (5e6, "yield"), (1e5, "least"))), (check,))
    axis = figure.axes[0]
    assert labels(axis) == ["allowed 1.55\u00a0MPa", "yield 5\u00a0MPa: all below", "least 0.1\u00a0MPa: all above"]
    limit = next(c for c in axis.collections if hasattr(c, "levels") and list(c.levels) == [pytest.approx(1.55)])
    assert limit.get_paths()[0].vertices[:, 0] == pytest.approx(1550.0)


def test_texts_and_whole_numbers_are_axes_of_a_map():
    kinds, teeth = np.array(["pin", "rocker", "pin", "rocker"], dtype=object), np.array([17, 17, 19, 19])
    found = table(x=("", "kind", kinds), y=("-", "teeth", teeth), z=("-", "failing", np.array([0.0, 1, 2, 3])))
    axis, bar = drawn(found, mapped()).axes
    assert [t.get_text() for t in axis.get_xticklabels()] == ["pin", "rocker"] and list(axis.get_yticks()) == [17, 19]
    assert sorted(t.get_text() for t in axis.texts) == ["0", "1", "2", "3"] and np.all(bar.get_yticks() % 1 == 0)


def test_a_logarithmic_map_hatches_what_has_no_logarithm():
    (panel,) = shown(long_table([1.0, 2], [0.1, 0.2], np.array([[1e3, 1e6], [0, -1]])), mapped(log=True))
    assert (panel.low, panel.high) == (pytest.approx(1e-3), pytest.approx(1.0))
    assert grid(panel)[2].mask.tolist() == [[False, False], [True, True]]
    figure = draw_panels((panel,))
    assert figure.axes[1].get_yscale() == "log" and labels(figure.axes[0]) == ["No value"]


def test_numbers_in_cells_have_the_decimals_of_the_largest():
    assert list(cell_texts(np.ma.masked_invalid([[0.0332, -2.4e-5, NAN]])).values()) == ["0.0332", "−0.0000"]
    assert list(cell_texts(np.ma.masked_invalid([[3e8, 2.0]])).values()) == ["3×10⁸", "2"]


# -- histograms ----------------------------------------------------------------------------------------------------------------


def test_bins_are_about_the_root_of_the_sample_or_fewer():
    normal = np.random.default_rng(1).normal(size=10_000)
    quartiles = np.percentile(normal, [25, 75])
    expected = np.ptp(normal) / (2 * np.diff(quartiles)[0] / 10_000 ** (1 / 3))
    assert len(bin_edges(normal)) - 1 == int(np.ceil(expected)) < 100
    assert len(bin_edges(np.random.default_rng(1).lognormal(0, 3, 400))) - 1 == 20, "long tails would ask for thousands"
    assert bin_edges(np.array([4, 7, 7])).tolist() == [3.5, 4.5, 5.5, 6.5, 7.5]
    assert len(bin_edges(np.full(50, 0.1))) == 2 and len(bin_edges(np.array([1.0, 1 + 1e-15]))) == 2
    for samples in (normal, np.array([4, 7, 7]), np.full(3, -2.0), np.zeros(3), np.arange(0, 1001, 7)):
        assert np.histogram(samples, bin_edges(samples))[0].sum() == len(samples)


def test_a_histogram_counts_marks_and_limits():
    samples = np.append(np.linspace(1e-3, 3e-3, 101), [NAN, NAN])
    figure = drawn(
        table(s=("m", "play", samples)),
        Plot("h", "Play", "t", "s", ("s",), style="histogram", limits=((3.2e-3, "largest"), (9.0, "absurd"))),
    )
    (axis,) = figure.axes
    assert sum(patch.get_height() for patch in axis.patches) == 101
    assert (axis.get_xlabel(), axis.get_ylabel()) == ("Play [mm]", "Cases")
    assert labels(axis) == [
        "101 cases, 2 without a value",
        "Mean 2\u00a0mm, standard deviation 0.586\u00a0mm",
        "5 % … 95 %: 1.1 … 2.9\u00a0mm",
        "absurd 9000\u00a0mm: far above",
    ]
    assert [line.get_xdata()[0] for line in axis.lines] == pytest.approx([2.0, 1.1, 2.9, 3.2])
    assert [text.get_text() for text in axis.texts] == ["largest 3.2\u00a0mm"] and axis.lines[-1].is_dashed()


def test_a_narrow_sample_is_told_with_the_figures_that_it_needs():
    assert figures(np.array([219.06]), 5e-5) == 10 and figures(np.array([2.0]), 1.0) == 4 and figures(np.zeros(2), 0.0) == 4


# -- ranked bars ---------------------------------------------------------------------------------------------------------------

LONG = "chain.stations.12.bearing.inner_ring.groove_curvature_radius.of_a_name_without_an_end"
KEYS = np.array(["b", LONG, "none", "a"])
EFFECTS = table(
    key=("", "key", KEYS),
    effect=("m", "effect", np.array([1.0, -3, NAN, 2]) * 1e-3),
    low=("m", "low", np.array([0.5, -4, 0, 1.5]) * 1e-3),
    high=("m", "high", np.array([1.5, -1, 0, 2.5]) * 1e-3),
    other=("m", "without the others", np.array([5.0, 1, 1, 1]) * 1e-3),
)
RANKED = Plot("r", "R", "t", "key", ("effect",), style="ranked", reference=("low", "high"))


def test_the_largest_magnitude_is_on_top_and_what_has_no_value_below():
    (axis,) = drawn(EFFECTS, RANKED).axes
    names = [text.get_text().replace("\n", "") for text in axis.get_yticklabels()]
    assert names == [LONG, "a", "b", "none"] and axis.yaxis_inverted()
    assert [bar.get_width() for bar in axis.patches] == pytest.approx([-3, 2, 1, 0])
    assert [text.get_text() for text in axis.texts] == ["−3", "2", "1", "no value"]
    assert [text.xy[0] for text in axis.texts] == pytest.approx([-4, 2.5, 1.5, 0]), "beyond the error bars"
    assert axis.get_xlabel() == "Effect [mm]"


def test_error_bars_are_those_of_the_first_column_row_by_row():
    (axis,) = drawn(EFFECTS, RANKED._replace(y=("effect", "other"))).axes
    ends = np.array(axis.collections[0].get_segments())
    assert ends[:, :, 0] == pytest.approx(np.array([[-4, -1], [1.5, 2.5], [0.5, 1.5]]))
    first = axis.containers[0].patches
    assert ends[:, 0, 1] == pytest.approx([bar.get_y() + bar.get_height() / 2 for bar in first[:3]])
    assert [bar.get_width() for bar in axis.containers[1]] == pytest.approx([1, 1, 5, 1])
    assert labels(axis) == ["Effect", "Without the others"] and axis.containers[1].patches[0].get_hatch()


def test_very_many_rows_are_cut_and_counted():
    many = table(key=("", "key", np.array([f"k{n}" for n in range(50)])), effect=("-", "effect", np.arange(50.0)))
    (axis,) = drawn(many, Plot("r", "R", "t", "key", ("effect",), style="ranked")).axes
    assert len(axis.patches) == MOST_ROWS and axis.patches[0].get_width() == 49
    assert f"{50 - MOST_ROWS} smaller ones are not shown" in axis.get_xlabel()


def test_names_are_broken_behind_dots_and_none_is_lost():
    lines = wrapped(LONG, 30).split("\n")
    assert "".join(lines) == LONG and all(len(line) <= 30 for line in lines) and lines[0].endswith((".", "_"))
    assert wrapped("x" * 70, 30) == "\n".join(["x" * 30, "x" * 30, "x" * 10])
    assert (sentence("joint.radius"), sentence("least play")) == ("joint.radius", "Least play")


# -- points by group -----------------------------------------------------------------------------------------------------------


def test_no_point_is_lost_where_a_group_has_an_x_twice():
    found = table(
        mass=("kg", "mass", np.array([1.0, 1, 1, 2])),
        play=("m", "play", np.array([1.0, 2, 3, 4]) * 1e-3),
        state=("", "state", np.array(["front", "dominated", "dominated", "fails"])),
    )
    (panel,) = shown(found, Plot("p", "P", "t", "mass", ("play",), style="points", by="state"))
    assert [(s.label, s.role, s.marker) for s in panel.series] == list(zip(("Front", "Dominated", "Fails"), SERIES, MARKERS, strict=False))
    assert [s.data[np.isfinite(s.data)].tolist() for s in panel.series] == [[1], [2, 3], [4]]
    axis = draw_panels((panel,)).axes[0]
    assert [line.get_marker() for line in axis.lines] == list(MARKERS[:3]) and labels(axis) == ["Front", "Dominated", "Fails"]
    assert axis.lines[0].get_zorder() > axis.lines[1].get_zorder() > axis.lines[2].get_zorder()
    assert axis.get_xlim()[0] < 1 and axis.get_xlim()[1] > 2


def test_groups_of_numbers_rise_and_very_many_groups_share_the_last():
    n = 200
    found = table(
        x=("-", "teeth", np.arange(n)),
        y=("m", "play", np.ones(n)),
        a=("rad", "angle", np.radians(np.arange(n) % 3)[::-1]),
        t=("", "kind", np.array([f"kind {k % 25}" for k in range(n)], dtype=object)),
    )
    (panel,) = shown(found, Plot("p", "P", "t", "x", ("y",), style="points", by="a"))
    assert [s.label for s in panel.series] == ["A 0°", "A 1°", "A 2°"]
    (panel,) = shown(found, Plot("p", "P", "t", "x", ("y",), style="points", by="t"))
    assert [s.label for s in panel.series][-2:] == ["Kind 18", "6 more"] and len(panel.series) == MOST_GROUPS
    assert len({(s.role, s.marker) for s in panel.series}) == MOST_GROUPS
    assert sum(np.isfinite(s.data).sum() for s in panel.series) == n


def test_points_over_texts_share_their_places_and_whole_numbers_have_whole_ticks():
    kinds = np.array(["pin", "rocker", "pin"])
    found = table(k=("", "kind", kinds), y=("m", "play", np.array([1.0, 2, 3])), n=("-", "teeth", np.array([20, 21, 22])))
    axis = drawn(found, Plot("p", "P", "t", "k", ("y",), style="points")).axes[0]
    assert axis.lines[0].get_xdata().tolist() == [0, 1, 0] and [t.get_text() for t in axis.get_xticklabels()] == ["pin", "rocker"]
    axis = drawn(found, Plot("p", "P", "t", "n", ("y",), style="line")).axes[0]
    assert np.all(axis.get_xticks() % 1 == 0)


# -- all of them ---------------------------------------------------------------------------------------------------------------


def full():
    rng = np.random.default_rng(2)
    x, y = np.linspace(0, 1e-3, 8), np.radians(np.linspace(0, 30, 6))
    cloud = table(
        x=("kg", "mass", rng.random(60)),
        y=("m", "play", rng.random(60)),
        g=("", "g", np.array(["front", "fails", "more"] * 20)),
        k=("", "kind of $joint$", np.array([f"kind {n % 20} of joint" for n in range(60)])),
    )
    hump = long_table(x, y, np.exp(np.sin(3e3 * x)[None] + y[:, None]) * 1e6)
    return {
        "map": (hump, mapped(limits=((2e6, "allowed"),))),
        "table": (long_table(x[:3], y, rng.normal(size=(6, 3))), mapped()),
        "histogram": (
            table(s=("m", "play", rng.normal(5, 1, 300))),
            Plot("h", "H", "t", "s", ("s",), ((8.0, "limit"),), style="histogram"),
        ),
        "ranked": (EFFECTS, RANKED),
        "grouped": (EFFECTS, RANKED._replace(y=("effect", "other"))),
        "points": (cloud, Plot("p", "P", "t", "x", ("y",), style="points", by="g")),
        "texts": (cloud, Plot("p", "P", "t", "k", ("y",), style="points", by="g")),
    }


@pytest.mark.parametrize("name", full())
def test_nothing_is_cut_off_or_written_over_and_the_bytes_repeat(name):
    figure = drawn(*full()[name])
    frame, found = figure.bbox.padded(0.5), words(figure)
    for text, box in found:
        assert frame.x0 <= box.x0 and box.x1 <= frame.x1 and frame.y0 <= box.y0 and box.y1 <= frame.y1, text
    level = [(text, box) for text, box in found if not text.startswith("kind ")]  # boxes of turned names overlap, the names do not
    for (a, box), (b, other) in combinations(level, 2):
        assert not box.padded(-1).overlaps(other.padded(-1)), (a, b)
    assert svg(drawn(*full()[name])) == svg(drawn(*full()[name]))


def sparse():
    nothing, one, some, text = np.zeros(0), np.array([2.0]), np.arange(6.0), np.array(["a"])
    kinds = [np.array([form.format(n) for n in range(20)]) for form in ("name {} $", "{}$_x$")]
    for name, x, y, z in (
        ("no row", nothing, nothing, nothing),
        ("one row", one, one, one),
        ("one nan", one, one, np.array([NAN])),
        ("text", text, text, one),
        ("1 x n", some, np.full(6, 3.0), some),
        ("constant", some, some, np.full(6, 0.3)),
        ("zero", some, some, np.zeros(6)),
        ("all nan", some, some, np.full(6, NAN)),
        ("infinite", some[:3], some[:3], np.array([np.inf, -np.inf, 1.0])),
        ("whole", np.arange(4), np.arange(4), np.arange(4)),
        ("yes and no", np.arange(2), np.arange(2), np.array([True, False])),
        ("twenty", *kinds, np.arange(20.0)),
    ):
        yield name, table(x=("m", "x", x), y=("m", "y", y), z=("m", "z", z), k=("", "k", np.asarray(x).astype(str)))


STYLES = (
    mapped(),
    mapped(log=True),
    mapped(limits=((0.5, "limit"),)),
    Plot("h", "H", "t", "z", ("z",), ((0.5, "limit"),), style="histogram"),
    Plot("r", "R", "t", "k", ("z",), style="ranked"),
    Plot("r", "R", "t", "k", ("z", "z"), style="ranked", reference=("z", "z")),
    Plot("p", "P", "t", "x", ("z",), style="points", by="k"),
)


@pytest.mark.parametrize(("name", "found"), list(sparse()), ids=[name for name, _ in sparse()])
def test_data_that_is_hardly_there_is_drawn_without_a_word(name, found):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for plot in STYLES:
            drawn(found, plot).savefig(io.BytesIO(), format="svg")


def test_no_cursor_runs_along_a_map_or_a_histogram():
    result, scene = four_bar_result(), four_bar_scene()
    plots = [Plot("p", "P", "motion", "angle", ("rocker", "coupler"), style=style) for style in ("map", "histogram", "ranked")]
    assert pack_plots(result, scene, plots) is None
    assert pack_plots(result, scene, [plots[0]._replace(style="line")])


def test_a_map_is_light_as_a_file():
    x = np.linspace(0, 1, 150)
    text = svg(drawn(long_table(x, x, np.random.default_rng(1).normal(size=(150, 150))), mapped()))
    assert len(text) < 300_000 and len(re.findall("<image", text)) == 2
