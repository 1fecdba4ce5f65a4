"""Points, stems, dashed references, powers of ten and shaded ground in the report's linked plots."""

from dataclasses import replace

import numpy as np
import pytest
from sample_designs import four_bar_result, four_bar_scene

from drivewright.report.content import Views
from drivewright.report.html import write_report
from drivewright.result import Column, Plot, Table
from drivewright.view.palette import colour
from drivewright.view.panels import panels

pytestmark = pytest.mark.browser

X = np.linspace(0, 2 * np.pi, 41)
TABLE = Table(
    "motion",
    "Motion",
    (
        Column("angle", "rad", "crank angle", X),
        Column("up", "N", "force", 10 + np.sin(X)),
        Column("ideal", "N", "ideal force", 10 + np.cos(X)),
        Column("wide", "-", "size", np.exp(X)),
        Column("on", "-", "contact", (X < 3.0).astype(float)),
    ),
)
RESULT = replace(four_bar_result(), tables={"motion": TABLE})
LINE = Plot("line", "Line", "motion", "angle", ("up",))
PLOTS = (
    LINE,
    LINE._replace(name="points", style="points"),
    LINE._replace(name="stems", style="stems"),
    LINE._replace(name="shaded", shade="on"),
    LINE._replace(name="compared", reference=("ideal",)),
    Plot("log", "Log", "motion", "angle", ("wide",), log=True),
)
COUNT = """([n, hex, near]) => {
  const c = document.querySelectorAll('.dw-plot-canvas')[n], d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;
  const want = [1, 3, 5].map(k => parseInt(hex.slice(k, k + 2), 16));
  let found = 0;
  for (let i = 0; i < d.length; i += 4) if (want.every((v, k) => Math.abs(v - d[i + k]) < near) && d[i + 3] > 250) found++;
  return found; }"""
DOT = "() => new DOMMatrix(getComputedStyle(document.querySelectorAll('.dw-plot')[5].querySelector('.dw-dot')).transform).f"


@pytest.fixture
def page(open_page, tmp_path):
    found = open_page(write_report(RESULT, Views(four_bar_scene(), PLOTS), tmp_path).as_uri())
    found.evaluate("() => { drivewright.clock.pause(); drivewright.clock.set(0.5); }")
    found.wait_for_timeout(200)
    return found


def test_every_style_leaves_its_ink(page):
    # A thin line is nowhere quite as dark as its ink; letters, in a lighter colour, stay farther away from it.
    near = {"blue": 6, "ink": 60, "line": 6}
    blue, ink, grey = ([page.evaluate(COUNT, [n, colour(role), near[role]]) for n in range(6)] for role in near)
    line, points, stems = blue[:3]
    assert 0 < points != line and stems > 3 * line, "points have gaps between them, stems fill the ground"
    assert ink[4] > 25 + ink[0], "the reference is drawn in ink"
    assert grey[3] > 10 * (grey[0] + 10), "shaded where in contact"


def test_a_logarithmic_plot_puts_its_cursor_where_the_logarithm_is(page):
    (panel,) = panels(RESULT, PLOTS[5])
    height = page.evaluate("() => document.querySelectorAll('.dw-plot-canvas')[5].getBoundingClientRect().height") - 6 - 36
    there = page.evaluate(DOT)
    low, value, high = np.log([panel.low, np.exp(np.pi), panel.high])
    assert there == pytest.approx(6 + (high - value) / (high - low) * height, abs=1.0)
