"""Every figure of a shaft is drawn, with what it claims on its axes."""

import pytest
from places import EXAMPLES

import drivewright as dw
from drivewright import registry
from drivewright.view.panels import drawable

pytestmark = pytest.mark.interface


@pytest.fixture(scope="module")
def spindle():
    return dw.run(dw.load(EXAMPLES / "spindle.toml"))


def plots(result):
    return {plot.name: plot for plot in drawable(result, registry.mechanism("shaft").plots(result))}


def test_every_plot_is_drawn(spindle):
    found = plots(spindle)
    assert {"diagram", "stress", "unit_load", "shares", "modes", "elements.front_1", "contact.front_1", "curve.front_1"} <= set(found)
    for name in found:
        figure = spindle.plot(name)
        assert figure.axes and all(axis.get_xlabel() or axis.name == "polar" or len(figure.axes) > 1 for axis in figure.axes)


def test_the_bars_of_the_shares_stand_on_one_axis_and_end_at_the_flexibility(spindle):
    figure = spindle.plot("shares")
    (axis,) = figure.axes
    sums = [line for line in axis.lines if line.get_marker() == "D"][0].get_ydata()
    assert list(sums) == pytest.approx([1e9 * v for v in spindle.tables["shares"]["total"].data], rel=1e-6)


def test_unit_load_lines_stand_beside_those_on_rigid_bearings(spindle):
    table = spindle.tables["unit_load"]
    assert table["nose"].data[-1] > table["nose.rigid"].data[-1] > 0
    delta = spindle.arrays["flexibility"].values
    at = [abs(z - 0.35) for z in table["z"].data].index(min(abs(z - 0.35) for z in table["z"].data))
    assert table["nose"].data[at] == pytest.approx(delta[1, 1], rel=1e-6)


@pytest.mark.needs_fe
def test_the_deformed_solid_is_drawn_with_a_scale(tmp_path):
    result = dw.run(dw.load(EXAMPLES / "pressure_roller_shaft.toml"), only=("solid",))
    figure = result.plot("solid_surface")
    assert result["solid.deviation"] < 0.002 and result.check("solid").ok
    assert any("times as large" in (axis.get_xlabel() + axis.get_ylabel()) for axis in figure.axes)
