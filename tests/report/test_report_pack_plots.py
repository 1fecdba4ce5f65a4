"""Every plot for a page that offers a choice: axes of their own, what a page begins with, names on a drawing."""

import base64
import json
from types import SimpleNamespace

import numpy as np
import pytest
from places import ROOT

from drivewright import registry, runner
from drivewright.report.pack import MOST_ROWS, pack_scene
from drivewright.report.pack_plots import MOST_FAILED, MOST_SHOWN, _rows, first_panels, pack_every_plot
from drivewright.result import Check, Plot
from drivewright.spec import load
from drivewright.view.panels import known_plots


def numbers(text):
    return np.frombuffer(base64.b64decode(text), "<f4")


@pytest.fixture(scope="module")
def shaft():
    spec = load(ROOT / "examples" / "pressure_roller_shaft.toml")
    model = runner.build(spec)
    return runner.run(spec, model=model), registry.mechanism("shaft").scene(model)


@pytest.fixture(scope="module")
def packed(shaft):
    result, scene = shaft
    return pack_every_plot(result, scene, tuple(known_plots(result).values()))


def panels_of(packed):
    return {panel["id"]: panel for plot in packed["plots"] for panel in plot["panels"]}


def test_a_plot_along_the_shaft_has_its_places_in_the_unit_of_its_axis(shaft, packed):
    result, _ = shaft
    panel = panels_of(packed)["diagram/moment"]
    axis, z = panel["axis"], result.tables["diagram"]["z"].data
    assert axis["unit"] == "mm" and axis["factor"] == pytest.approx(1e3)
    assert numbers(panel["u"])[[0, -1]] == pytest.approx(1e3 * np.array([z[0], z[-1]]))
    assert axis["low"] < 0 < 340 < axis["high"]
    assert [name for _, name in axis["places"]] == ["m1", "A", "B", "m2, 500 N"]
    assert json.loads(json.dumps(packed, allow_nan=False)) == packed


def test_bars_stand_beside_each_other_under_their_names(packed):
    axis = panels_of(packed)["shares/bending"]["axis"]
    assert axis["names"] == ["m1, m1", "m1, m2", "m2, m2"] and (axis["low"], axis["high"]) == (-0.5, 2.5)


def test_a_page_begins_with_what_the_drive_names_and_its_diagrams_stand_apart(packed):
    assert packed["diagrams"] == ["diagram/shear", "diagram/moment", "diagram/deflection", "diagram/slope", "stress/stress"]
    assert packed["first"][0] == "haigh/weakest" and len(packed["first"]) == MOST_SHOWN
    assert not set(packed["first"]) & set(packed["diagrams"])


def test_a_changing_design_has_only_the_plots_that_the_drive_names(shaft):
    result, scene = shaft
    found = pack_every_plot(result, scene, tuple(known_plots(result).values()), quick=True)
    assert {"diagram", "stress", "haigh"} <= {plot["name"] for plot in found["plots"]}
    assert "force_vectors" not in {plot["name"] for plot in found["plots"]}


def test_a_panel_that_shows_a_failed_check_comes_first(shaft):
    result, _ = shaft
    failed = Check("play", 2.0, 1.0, "<=", "mm", "too much")
    plots = (
        Plot("lift", "Lift", "t", "x", ("lift",)),
        Plot("gap", "Gap", "t", "x", ("gap", "play")),
        Plot("other", "Other", "t", "x", ("other",)),
    )
    ids = {"lift": ["lift/lift"], "gap": ["gap/gap", "gap/play"], "other": ["other/other"]}
    told = type(result)(**{**vars(result), "checks": (failed,)})
    assert first_panels(told, plots, ids, ("lift",)) == ["gap/play", "lift/lift"]
    assert first_panels(told, plots, ids, ()) == ["gap/play", "lift/lift", "gap/gap", "other/other"]
    assert first_panels(told, plots, ids, ("l*", "o*"), apart=("gap/play",)) == ["lift/lift", "other/other"]


def beginning(names, failing, main):
    """The panels that a page opens with, of plots with a line of their own name; `failing` are the checks."""
    plots = tuple(Plot(name, name, "t", "x", (name,)) for name in names)
    checks = tuple(Check(name, 2.0, 1.0, "<=", "mm", "too much") for name in failing)
    return first_panels(SimpleNamespace(checks=checks), plots, {name: [f"{name}/{name}"] for name in names}, main)


def test_failed_checks_have_two_of_the_four_places_at_most_unless_there_is_room():
    names = "abcdefgh"
    own = [f"{name}/{name}" for name in names]
    assert (MOST_FAILED, MOST_SHOWN) == (2, 4)
    assert beginning(names, "efg", ("a", "b", "c")) == [own[4], own[5], own[0], own[1]]
    assert beginning(names, "efgh", ("a",)) == [own[4], own[5], own[0], own[6]]  # the third one behind what leads
    assert beginning(names, "", ()) == own[:4]


def test_a_plot_with_the_limit_of_a_check_shows_it_in_its_first_panel():
    """Limits are drawn there, whatever line bears the name; a plot with the limit goes before one with the name alone."""
    check = Check("play", 2.0, 1.0, "<=", "mm", "too much")
    drawn = Plot("gap", "Gap", "t", "x", ("gap", "play"), (("play", "limit"),))
    named = Plot("play", "Play", "t", "x", ("play",))
    ids = {"play": ["play/play"], "gap": ["gap/gap", "gap/play"]}
    assert first_panels(SimpleNamespace(checks=(check,)), (named, drawn), ids, ("x",))[0] == "gap/gap"


def test_a_pattern_that_fits_several_plots_means_the_first():
    assert beginning(["lift", "lever", "other"], "", ("l*", "o*")) == ["lift/lift", "other/other"]


@pytest.mark.parametrize("count", [MOST_ROWS, MOST_ROWS + 1, 5000])
def test_a_long_path_is_drawn_evenly_from_its_first_point_to_its_last(count):
    """It runs back and forth, so that lowest and highest values of equal stretches would leave corners out."""
    turn = np.linspace(0, 40 * np.pi, count)
    panel = SimpleNamespace(series=[SimpleNamespace(data=np.sin(turn), x=None)], style="line")
    rows = _rows(panel, np.cos(turn))
    assert rows[0] == 0 and rows[-1] == count - 1 and len(rows) == MOST_ROWS
    assert np.diff(rows).max() <= np.ceil(count / MOST_ROWS)


@pytest.mark.parametrize("kind", registry.kinds())
def test_what_a_kind_names_is_written_as_a_plot_or_a_panel(kind):
    known = registry.mechanism(kind)
    for pattern in (*known.main_plots, *known.diagrams):
        assert pattern.count("/") <= 1 and pattern.strip("/") == pattern


def test_a_path_has_the_phase_of_its_points():
    spec = load(ROOT / "examples" / "four_bar.toml")
    model = runner.build(spec)
    result, scene = runner.run(spec, model=model, only=("motion",)), registry.mechanism("linkage").scene(model)
    panel = panels_of(pack_every_plot(result, scene, tuple(known_plots(result).values())))["path.coupler_point/coupler_point.y"]
    phase = numbers(panel["phase"])
    assert panel["equal"] and phase[0] == pytest.approx(0, abs=1e-6) and phase[-1] == pytest.approx(1) and np.all(np.diff(phase) > 0)
    assert len(phase) == len(numbers(panel["u"]))


def test_a_shaft_is_drawn_with_the_names_of_its_bearings_and_stations_and_its_forces(shaft):
    _, scene = shaft
    found = pack_scene(scene)
    assert [label["text"].replace("\u00a0", " ") for label in found["labels"]] == ["A", "B", "m1", "m2", "500 N"]
    assert [label["above"] for label in found["labels"]] == [False, False, True, False, True]  # the arrow comes upon m2 from above
    (x1, y1), (x2, y2) = (label["point"] for label in found["labels"][2:4])
    assert y1 == -y2 > 0
    bodies = [found["bodies"][label["body"]]["name"] for label in found["labels"]]
    assert bodies[:2] == ["bearing.A", "bearing.B"] and bodies[-1] == "load.0"
    assert "lbf" in pack_scene(scene, "inch")["labels"][-1]["text"]


def test_a_gear_is_named_below_where_an_arrow_comes_out_of_it_above():
    """The arrow upon the wheel ends inside of it; that upon the pinion would cross the name."""
    spec = load(ROOT / "examples" / "gearbox_shaft.toml")
    labels = {each.text: each for each in registry.mechanism("shaft").scene(runner.build(spec)).labels}
    assert labels["wheel"].above and labels["wheel"].point[1] > 0
    assert not labels["pinion"].above and labels["pinion"].point[1] < 0
