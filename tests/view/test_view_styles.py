"""Points, stems, references, powers of ten, shaded ground, rings and lines by group: the same in panels, figures and the player."""

import base64
from dataclasses import replace

import numpy as np
import pytest
from matplotlib.figure import Figure
from sample_designs import four_bar_result, four_bar_scene

from drivewright import registry
from drivewright.report.pack import pack_plots
from drivewright.result import Column, Plot, Table
from drivewright.scene import Drawing, Shape, circle
from drivewright.view import draw_drawing, draw_panels, svg
from drivewright.view.panels import DECADES, known_plots, log_span, panels
from drivewright.view.powers import power_of_ten
from drivewright.view.style import log_ticks

pytestmark = pytest.mark.interface

X = np.linspace(0, 2 * np.pi, 9)
TABLE = Table(
    "wave",
    "Wave",
    (
        Column("angle", "rad", "crank angle", X),
        Column("up", "m", "height", np.sin(X)),
        Column("ideal", "m", "height, ideal", np.cos(X)),
        Column("on", "-", "contact", (np.sin(X) > 0.1).astype(float)),
        Column("power", "-", "size", np.geomspace(1e-9, 10, 9)),
    ),
)
RESULT = replace(four_bar_result(), tables={"wave": TABLE})
GRID = Table(
    "grid",
    "Grid",
    (
        Column("speed", "rad/s", "speed", np.array([2.0, 1.0, 1.0, 2.0, 3.0])),
        Column("play", "m", "radial play", np.array([1, 1, 2, 2, 2]) * 1e-3),
        Column("load", "-", "load of the pin", np.array([12.0, 11, 21, 22, 23])),
        Column("who", "-", "pin", np.array(list("aabbb"))),
    ),
)


def test_a_reference_follows_its_line_and_is_dashed():
    (panel,) = panels(RESULT, Plot("w", "W", "wave", "angle", ("up",), reference=("ideal",)))
    assert [(s.name, s.dashed) for s in panel.series] == [("up", False), ("ideal", True)]
    assert panel.label == "Height [mm]" and panel.series[0].role != panel.series[1].role
    assert panel.low < -1000 and panel.high > 1000
    line, reference = draw_panels((panel,)).axes[0].lines
    assert line.get_linestyle() == "-" and reference.get_linestyle() == "--"
    assert reference.get_ydata() == pytest.approx(1e3 * np.cos(X))


def test_lines_are_told_apart_by_another_column():
    result = replace(RESULT, tables={"grid": GRID})
    (panel,) = panels(result, Plot("g", "G", "grid", "speed", ("load",), by="play"))
    assert [s.label for s in panel.series] == ["Play 1\u00a0mm", "Play 2\u00a0mm"] and panel.label == "Load of the pin"
    assert panel.x.data == pytest.approx(np.array([1, 2, 3]) * 30 / np.pi)
    assert panel.series[0].data == pytest.approx([11, 12, np.nan], nan_ok=True) and panel.series[1].data == pytest.approx([21, 22, 23])
    (named,) = panels(result, Plot("g", "G", "grid", "speed", ("load",), by="who", style="stems"))
    assert [s.label for s in named.series] == ["Who a", "Who b"]
    assert named.low < 0, "stems from 11 to 23 still stand on zero"
    assert "Who b" in svg(draw_panels((named,)))


def test_stems_stand_on_zero_and_points_have_no_line():
    (stems,) = panels(RESULT, Plot("w", "W", "wave", "angle", ("power",), style="stems"))
    assert stems.low < 0 < stems.high
    axis = draw_panels((stems,)).axes[0]
    feet = np.array([segment[0] for segment in axis.collections[0].get_segments()])
    assert feet == pytest.approx(np.column_stack([np.degrees(X), 0 * X]))
    (points,) = panels(RESULT, Plot("w", "W", "wave", "angle", ("up",), style="points"))
    (line,) = draw_panels((points,)).axes[0].lines
    assert line.get_linestyle() == "None" and line.get_marker() == "."


def test_a_cloud_of_points_becomes_an_image():
    many = np.random.default_rng(3).normal(size=(2, 30_000))
    table = Table("cloud", "Cloud", (Column("x", "m", "x", many[0]), Column("y", "m", "y", many[1])))
    text = svg(draw_panels(panels(replace(RESULT, tables={"cloud": table}), Plot("c", "C", "cloud", "x", ("y",), style="points"))))
    assert "<image" in text and len(text) < 400_000


def test_a_logarithmic_axis_shows_what_is_positive():
    (panel,) = panels(RESULT, Plot("w", "W", "wave", "angle", ("power",), log=True))
    assert 10 < panel.high < 30 and 10 / 10**DECADES > panel.low > 10 / 10 ** (DECADES + 1)
    assert draw_panels((panel,)).axes[0].get_yscale() == "log"
    assert log_span([[np.nan, 0.0, -1.0]]) == (0.1, 1.0)
    low, high = log_span([[0.0, 2.0, 8.0]])
    assert low < 2 and high > 8 and low * high == pytest.approx(16)


def test_shaded_stretches_end_half_way_between_samples():
    (panel,) = panels(RESULT, Plot("w", "W", "wave", "angle", ("up",), shade="on"))
    assert panel.shade == ((pytest.approx(22.5), pytest.approx(157.5)),)
    packed = pack_plots(
        replace(RESULT, tables={"motion": replace(TABLE, name="motion")}),
        four_bar_scene(),
        (Plot("w", "W", "motion", "angle", ("up",), shade="on", style="points", reference=("ideal",)),),
    )
    (panel,) = packed["panels"]
    assert panel["shade"] == [[pytest.approx(1 / 16), pytest.approx(7 / 16)]]
    assert (panel["style"], panel["log"], [s["dashed"] for s in panel["series"]]) == ("points", False, [False, True])
    assert np.frombuffer(base64.b64decode(panel["series"][1]["data"]), "<f4") == pytest.approx(1e3 * np.cos(X), abs=1e-3)


def test_a_ring_is_a_circle_in_the_unit_of_the_axes():
    (panel,) = panels(RESULT, Plot("w", "W", "wave", "up", ("ideal",), equal=True, rings=((0.9, "play"),)))
    assert panel.rings == ((pytest.approx(900), "play 900\u00a0mm"),)
    axis = draw_panels((panel,)).axes[0]
    assert np.hypot(*axis.lines[-1].get_xydata().T) == pytest.approx(np.full(181, 900)) and "play 900" in axis.texts[0].get_text()


def test_plots_may_depend_on_the_result(monkeypatch):
    made = Plot("of_" + RESULT.title, "T", "wave", "angle", ("up",))
    kind = replace(registry.mechanism("cam"), plots=lambda result: (made._replace(name=f"of_{result.title}"),))
    monkeypatch.setattr(registry, "mechanism", lambda name: kind)
    assert known_plots(replace(RESULT, mechanism="cam")) == {made.name: made}


@pytest.mark.parametrize(
    ("x", "name"),
    [
        (1e-3, "10⁻³"),
        (1e12, "10¹²"),
        (1.0, "1"),
        (20.0, "20"),
        (100.0, "10²"),
        (2e-3, "2×10⁻³"),
        (0.9999999999e-3, "10⁻³"),
        (3.25e4, "3.25×10⁴"),
    ],
)
def test_powers_of_ten_are_text(x, name):
    assert power_of_ten(x) == name


@pytest.mark.parametrize(("low", "high", "names"), [(2e-5, 3e-2, ["10⁻⁴", "10⁻³", "10⁻²"]), (2.5e-3, 4.5e-3, ["3×10⁻³", "4×10⁻³"])])
def test_a_logarithmic_axis_names_its_decades_or_what_lies_between(low, high, names):
    axes = Figure().subplots()
    axes.set(yscale="log", ylim=(low, high))
    log_ticks(axes.yaxis)
    axes.figure.draw_without_rendering()
    texts = [
        tick.label1.get_text() for tick in [*axes.yaxis.get_major_ticks(), *axes.yaxis.get_minor_ticks()] if low <= tick.get_loc() <= high
    ]
    assert sorted(text for text in texts if text) == sorted(names)


def test_a_shape_is_called_what_it_says_itself():
    circles = [Shape("pitch", circle((0, 0), 0.03), "pitch circle"), Shape("base", circle((0, 0), 0.02))]
    legend = draw_drawing(Drawing("gear", "gear", tuple(circles))).axes[0].get_legend()
    assert [text.get_text() for text in legend.get_texts()] == ["pitch circle", "base circle"]
