"""Results side by side as a value: labels, numbers, differences, overlaid plots."""

import json
import math
from dataclasses import replace

import pytest
from sample_designs import PLOTS, four_bar_result

import drivewright as dw
from drivewright import registry
from drivewright.errors import InputError, UnknownName
from drivewright.report.comparison import MOST_DESIGNS, Difference, difference, difference_text, distinct, identical_text, value_text
from drivewright.result import Value

pytestmark = pytest.mark.interface

FIRST = four_bar_result("First")


def changed(title="Second", **values):
    """The sample under another title, with some of its values replaced, or taken out where they are None."""
    kept = {name: value for name, value in FIRST.values.items() if values.get(name, 0) is not None}
    new = {name: kept[name]._replace(value=number) for name, number in values.items() if number is not None}
    return replace(FIRST, title=title, values={**kept, **new})


SECOND = changed(ratio=2.5, deviation=None)


@pytest.fixture
def kind(monkeypatch):
    """The sample's kind, with its plots."""
    monkeypatch.setattr(registry, "kinds", lambda: [FIRST.mechanism])
    monkeypatch.setattr(registry, "mechanism", lambda kind: type("Kind", (), {"plots": PLOTS}))


def test_values_stand_side_by_side_and_what_a_design_has_not_is_none():
    comparison = dw.compare([FIRST, SECOND])
    assert isinstance(comparison, dw.DesignComparison)
    assert comparison.labels == ("First", "Second") and comparison.results == (FIRST, SECOND)
    assert comparison.values["ratio"] == (3.125, 2.5)
    assert comparison.values["deviation"] == (FIRST["deviation"], None)
    assert comparison.units["stress.peak"] == "Pa"
    assert list(comparison.values) == list(FIRST.values)


def test_a_number_that_does_not_exist_is_none():
    comparison = dw.compare([FIRST, changed(ratio=math.nan)])
    assert comparison.values["ratio"] == (3.125, None)
    assert dw.compare([changed(ratio=math.inf), changed("Third", ratio=math.nan)]).values.get("ratio") is None


def cam(*changes):
    """The sample as if it came from a cam with these changes."""
    return replace(FIRST, spec=dw.load(registry.mechanism("cam").presets()["default"], changes))


def test_the_record_has_the_checks_and_the_keys_that_differ():
    plain, other = cam(), cam("drive.speed=700 rpm", "limits.contact_pressure=900 MPa")
    fewer = replace(other, checks=tuple(check for check in FIRST.checks if check.ok))
    record = json.loads(json.dumps(dw.compare([plain, fewer], ["A", "B"]).record(), allow_nan=False))
    assert record["checks"] == {check.name: [True, True] if check.ok else [False, None] for check in FIRST.checks}
    assert {check.ok for check in FIRST.checks} == {True, False}
    assert record["differing"] == {"drive.speed": ["600 rpm", "700 rpm"], "limits.contact_pressure": [None, "900 MPa"]}


def test_designs_whose_specs_differ_in_no_key_are_identical():
    slow, fast, other = cam("drive.speed=10 rev/s"), cam("drive.speed=700 rpm"), cam("title=Another")
    assert dw.compare([cam(), slow, fast, other], ["A", "B", "C", "D"]).identical == (("A", "B", "D"),)
    assert dw.compare([cam(), fast, fast, slow], ["A", "B", "C", "D"]).identical == (("A", "D"), ("B", "C"))
    assert dw.compare([cam(), fast]).identical == ()
    assert identical_text(("A", "B", "D")) == "A, B and D are identical: their specs differ in no key"


def test_the_record_is_what_the_file_has():
    comparison = dw.compare([cam(), replace(SECOND, spec=cam().spec)], ["A", "B"])
    record = json.loads(json.dumps(comparison.record(), allow_nan=False))
    assert set(record) == {"mechanism", "labels", "values", "units", "checks", "differing"}
    assert record["labels"] == ["A", "B"] and record["mechanism"] == FIRST.mechanism
    assert {name: tuple(row) for name, row in record["values"].items()} == comparison.values
    assert record["units"] == comparison.units and record["values"]["deviation"][1] is None


def test_a_design_beside_itself_differs_by_nothing():
    comparison = dw.compare([FIRST, FIRST])
    assert comparison.labels == ("First", "First (2)")
    for name in comparison.values:
        assert comparison.differences(name) == (Difference(0.0, 0.0), Difference(0.0, 0.0))
        assert difference_text(comparison.differences(name)[1], comparison.units[name]) == "0"


def test_differences_are_those_to_the_first_one():
    comparison = dw.compare([FIRST, SECOND, changed("Third", ratio=5.0)])
    none, second, third = comparison.differences("ratio")
    assert none == Difference(0.0, 0.0)
    assert second == Difference(-0.625, pytest.approx(-0.2)) and third == Difference(1.875, pytest.approx(0.6))
    assert comparison.differences("deviation")[1] is None


def test_a_difference_is_relative_to_the_magnitude_of_the_first():
    assert difference(Value(-2.0, "m", ""), Value(-1.0, "m", "")) == Difference(1.0, 0.5)
    assert difference(Value(0.0, "m", ""), Value(1.0, "m", "")) == Difference(1.0, None)
    assert difference(Value(1.0, "m", ""), Value(1.0 + 1e-9, "m", "")).absolute == pytest.approx(1e-9)
    assert difference(Value(1.0, "m", ""), Value(1.0 + 1e-15, "m", "")) == Difference(0.0, 0.0)
    assert difference(Value(1.0, "m", ""), Value(1.0, "N", "")) is None


def test_intervals_that_overlap_leave_a_difference_uncertain():
    first = Value(10e-3, "m", "", 9e-3, 11e-3, "ensemble")
    near, far = Value(11.5e-3, "m", "", 10.5e-3, 12.5e-3, "ensemble"), Value(20e-3, "m", "", 19e-3, 21e-3, "ensemble")
    assert not difference(first, near).certain and difference(first, far).certain
    step = difference(first, far)
    assert (step.low, step.high) == (pytest.approx(8e-3), pytest.approx(12e-3))
    assert difference_text(step, "m") == "+10.0\u00a0mm (+100\u00a0%)"


def test_differences_are_printed_with_a_sign_in_the_unit_that_people_read():
    assert difference_text(Difference(1.2e-3, 0.034), "m") == "+1.2\u00a0mm (+3.4\u00a0%)"
    assert difference_text(Difference(-1.2e-3, None), "m") == "−1.2\u00a0mm"
    assert difference_text(None, "m") == "" and value_text(None) == "–"


def test_names_are_made_different():
    assert distinct(["Cam", "Cam", "Cam (2)", "Cam"]) == ("Cam", "Cam (2)", "Cam (2) (2)", "Cam (3)")


@pytest.mark.parametrize(
    ("results", "labels", "message"),
    [
        ([FIRST], (), "at least two designs, got 1"),
        ([FIRST] * (MOST_DESIGNS + 1), (), f"at most {MOST_DESIGNS} designs, got {MOST_DESIGNS + 1}"),
        ([FIRST, replace(FIRST, mechanism="gearbox")], (), "designs of one kind can be compared, and these are four-bar-sample, gearbox"),
        ([FIRST, SECOND], ("A",), "1 labels for 2 designs"),
        ([FIRST, SECOND], ("A", " "), "a label is empty"),
        ([FIRST, SECOND], ("A", "A"), "the label 'A' stands for two designs"),
    ],
)
def test_what_cannot_be_compared_is_refused(results, labels, message):
    with pytest.raises(InputError, match=message.replace("(", r"\(")):
        dw.compare(results, labels)


def test_a_plot_has_a_panel_for_each_quantity_and_in_it_a_curve_for_each_design(kind):
    figure = dw.compare([FIRST, SECOND, FIRST], ["A", "B", "C"]).plot("speed")
    assert len(figure.axes) == 2
    for axes in figure.axes:
        assert [line.get_label() for line in axes.lines if line.get_label()[0] != "_"] == ["A", "B (same as A)", "C (same as A)"]
    assert [text.get_text() for text in figure.axes[0].get_legend().get_texts()] == ["A", "B (same as A)", "C (same as A)"]
    assert figure.axes[1].get_legend() is None


def test_an_unknown_plot_is_refused_by_name(kind):
    with pytest.raises(UnknownName, match="sped.*did you mean 'speed'"):
        dw.compare([FIRST, SECOND]).plot("sped")


def test_in_a_notebook_the_values_stand_side_by_side():
    text = dw.compare([FIRST, SECOND], ["<A>", "B"])._repr_html_()
    assert "&lt;A&gt;" in text and "3.125" in text and "2.5" in text and "–" in text
    assert "'B'" in repr(dw.compare([FIRST, SECOND], ["A", "B"]))
