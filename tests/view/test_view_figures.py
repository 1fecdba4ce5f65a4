"""Figures a printer and a colour-blind reader can use: labelled, nothing cut off, the same bytes each time."""

import os
import re
import subprocess
import sys
from itertools import combinations
from xml.etree import ElementTree

import matplotlib
import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.text import Text
from places import SUPPORT
from sample_designs import PLOTS, eccentric_drawing, four_bar_result, four_bar_scene

from drivewright.errors import UnknownName
from drivewright.view import draw_drawing, draw_panels, draw_scene, draw_thumbnail, plot_table, svg
from drivewright.view.panels import drawable, panels

pytestmark = pytest.mark.interface

RESULT, SCENE = four_bar_result(), four_bar_scene()
MARKS = tuple((np.degrees(value), label) for value, label in SCENE.marks)
FIGURES = {
    **{
        plot.name: (lambda plot=plot: draw_panels(panels(RESULT, plot), MARKS if plot.x == "angle" else ()))
        for plot in drawable(RESULT, PLOTS)
    },
    "table": lambda: plot_table(RESULT, "motion"),
    "machine": lambda: draw_scene(SCENE, "machine", [0.3], [0, 0.25, 0.5]),
    "field": lambda: draw_scene(SCENE, "field", [0.3], [0, 0.5]),
    "two": lambda: draw_scene(SCENE, None, [0.1, 0.6]),
    "drawing": lambda: draw_drawing(eccentric_drawing()),
    "thumbnail": lambda: draw_thumbnail(SCENE),
}


def words(figure):
    """(text, box in pixels) of everything that is really drawn; tick labels beyond the range exist but are not."""
    canvas, drawn, draw = FigureCanvasAgg(figure), [], Text.draw
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Text, "draw", lambda text, renderer, *rest, **more: (drawn.append(text), draw(text, renderer, *rest, **more)))
        canvas.draw()
    seen = [text for text in dict.fromkeys(drawn) if text.get_visible() and text.get_text().strip()]
    return [(text.get_text(), Text.get_window_extent(text, canvas.get_renderer())) for text in seen]


@pytest.mark.parametrize("name", FIGURES)
def test_nothing_written_is_cut_off_or_written_over(name):
    figure = FIGURES[name]()
    found = words(figure)
    frame = figure.bbox.padded(0.5)
    for text, box in found:
        assert frame.x0 <= box.x0 and box.x1 <= frame.x1 and frame.y0 <= box.y0 and box.y1 <= frame.y1, text
    for (a, box), (b, other) in combinations(found, 2):
        assert not box.padded(-1).overlaps(other.padded(-1)), (a, b)


@pytest.mark.parametrize("name", [name for name in FIGURES if name != "thumbnail"])
def test_every_axis_is_labelled_and_the_figure_has_a_title(name):
    figure = FIGURES[name]()
    assert figure.get_suptitle()
    assert all(axes.get_ylabel() for axes in figure.axes[:1])
    assert figure.axes[-1].get_xlabel()
    if name not in ("links", "track"):
        assert re.search(r"\[(°|mm)\]", figure.axes[-1].get_xlabel())


def test_the_curve_is_the_column_in_display_units():
    axes = plot_table(RESULT, "motion").axes[0]
    x, y = axes.lines[0].get_data()
    table = RESULT.tables["motion"]
    assert x == pytest.approx(np.degrees(table["angle"].data)) and y == pytest.approx(np.degrees(table["rocker"].data))
    assert axes.get_ylabel() == "Angle [°]" and [t.get_text() for t in axes.get_legend().get_texts()][0] == "Rocker angle"


def test_a_limit_is_a_dashed_line_at_its_value_with_its_name():
    axes = FIGURES["transmission"]().axes[0]
    limit = axes.lines[-1]
    assert limit.get_ydata() == pytest.approx([40, 40]) and limit.is_dashed()
    assert "least 40°" in [t.get_text() for t in axes.texts]


def test_phases_are_shaded_in_turn_and_named_on_the_first_panel_only():
    first, second = FIGURES["speed"]().axes
    spans = [(patch.get_x(), patch.get_width()) for patch in first.patches]
    assert spans == [(0.0, pytest.approx(np.degrees(2.6))), (pytest.approx(np.degrees(5.0)), pytest.approx(360 - np.degrees(5.0)))]
    assert [t.get_text() for t in first.texts] == ["forward", "return", "dwell"] and not second.texts
    assert len(second.patches) == len(first.patches)


def test_names_column_becomes_marks_with_names_below():
    axes = FIGURES["links"]().axes[0]
    assert [t.get_text() for t in axes.get_xticklabels()] == ["crank", "coupler", "rocker"]
    assert axes.lines[0].get_linestyle() == "None" and axes.lines[0].get_ydata() == pytest.approx([32, 96, 72])


def test_a_scene_is_drawn_where_its_poses_say():
    """The crank's round end at a quarter of the cycle: its bounding box by hand."""
    figure = draw_scene(SCENE, "machine", [0.25])
    boxes = [patch.get_path().vertices for patch in figure.axes[0].findobj(matplotlib.patches.Polygon)]
    crank = next(box for box in boxes if np.ptp(box, axis=0) == pytest.approx([10, 42], abs=0.12))
    assert crank.mean(axis=0)[0] == pytest.approx(0.0, abs=0.3) and crank[:, 1].max() == pytest.approx(37, abs=0.06)


def test_the_field_sees_the_cycles_before_one_advance_back():
    lines = draw_scene(SCENE, "field", [0.0]).axes[0].lines
    now, past, older = (np.asarray(line.get_xydata()) for line in lines[:3])
    assert past - now == pytest.approx(np.broadcast_to([-140, 0], now.shape))
    assert older - now == pytest.approx(np.broadcast_to([-280, 0], now.shape))


def test_a_thumbnail_is_trimmed_to_its_picture():
    axes = FIGURES["thumbnail"]().axes[0]
    box, frame = axes.get_position(), axes.figure.get_size_inches()
    assert [box.x0 * frame[0], (1 - box.x1) * frame[0], box.y0 * frame[1], (1 - box.y1) * frame[1]] == pytest.approx([0.1] * 4, abs=1e-9)


def test_scenes_and_drawings_are_to_scale():
    for name in ("machine", "field", "two", "drawing"):
        figure = FIGURES[name]()
        words(figure)
        for axes in figure.axes:
            per_mm = np.divide(axes.get_window_extent().size, [np.ptp(axes.get_xlim()), np.ptp(axes.get_ylim())])
            assert per_mm[0] == pytest.approx(per_mm[1], rel=1e-6)


def test_a_drawing_says_its_size_and_has_a_scale_bar():
    axes = FIGURES["drawing"]().axes[0]
    assert "66 × 66.27\u00a0mm, 8\u00a0mm thick" in axes.get_title(loc="left")
    bar = axes.lines[-1].get_xdata()
    assert f"{bar[1] - bar[0]:.0f}\u00a0mm" in [t.get_text() for t in axes.texts]


def test_unknown_frame_is_refused_with_the_nearest():
    with pytest.raises(UnknownName, match="frame of the scene is called 'feild'.*did you mean 'field'"):
        draw_scene(SCENE, "feild")


def test_svg_is_well_formed_repeatable_and_free_of_the_readers_settings():
    first = svg(plot_table(RESULT, "motion"))
    with matplotlib.rc_context({"font.size": 30, "axes.facecolor": "black", "svg.fonttype": "path", "axes.grid": False}):
        assert svg(plot_table(RESULT, "motion")) == first
        assert matplotlib.rcParams["font.size"] == 30
    assert ElementTree.fromstring(first).tag.endswith("svg")
    assert "Verdana" in first and not re.search(r"<script|<image|href=\"http", first)


def test_no_window_no_pyplot_and_no_matplotlib_before_a_figure_is_drawn():
    code = (
        "import sys; sys.path.insert(0, sys.argv[1]); from sample_designs import *; import drivewright.view as v\n"
        "from drivewright.report import folder\n"
        "assert 'matplotlib' not in sys.modules, 'too early'\n"
        "v.svg(v.plot_table(four_bar_result(), 'motion')); v.svg(v.draw_scene(four_bar_scene()))\n"
        "assert 'matplotlib.pyplot' not in sys.modules"
    )
    environment = {**os.environ, "MPLBACKEND": "tkagg"}
    command = [sys.executable, "-c", code, str(SUPPORT)]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
