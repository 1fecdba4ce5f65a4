"""Bounds of studies and searches: units of another kind are read with a remark, widths about a temperature are differences."""

from dataclasses import replace
from math import pi

import numpy as np
import pyarrow as pa
import pytest
from pyarrow import parquet
from study_toy import TOY, Toy, install

import drivewright as dw
from drivewright.errors import SpecError
from drivewright.execution.keys import key_kind
from drivewright.registry import Analysis
from drivewright.result import Answer, Value
from drivewright.spec import from_document
from drivewright.spec.fields import Field
from drivewright.studies.answers import analyse_study
from drivewright.studies.plan import make_plan
from drivewright.studies.search.problem import prepare
from drivewright.studies.variation import linked, linspace, normal, tolerance, triangular, uniform, with_variation
from drivewright.units import BY_NAME, Speed, Temperature

pytestmark = pytest.mark.property


class Warm(Toy):
    """A toy with a speed and two temperatures."""

    speed: Speed = Field("600 rpm", description="speed")
    warmth: Temperature = Field("70 degC", description="temperature")
    oil: Temperature = Field("50 degC", description="temperature")


def answer(spec, done):
    """The speed again."""
    return Answer(values={"turning": Value(spec.speed, "rad/s", "speed again"), "size": Value(spec.size, "m", "size again")})


@pytest.fixture(autouse=True)
def _toy(monkeypatch):
    install(monkeypatch.setattr, replace(TOY, spec=Warm, analyses=(Analysis("main", answer, "what it is"),), headline=("turning",)))


def plan(vary, **settings):
    return make_plan(with_variation(settings.pop("spec", Warm()), vary, **settings))


def only(vary, **settings):
    (variable,) = plan(vary, **settings).variables
    return variable


# -- temperatures --------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("width", ["6 degC", "6 K", "10.8 degF"])
def test_a_tolerance_about_a_temperature_is_a_difference(width):
    law = only({"warmth": tolerance(width)})
    assert law.ends == pytest.approx((337.15, 349.15), abs=1e-9) and law.distribution.args[-1] == pytest.approx(2.0)
    assert only({"warmth": normal("80 degC", width)}).distribution.std() == pytest.approx(6.0)
    assert only({"warmth": normal("80 degC", width)}).distribution.mean() == pytest.approx(353.15)


def test_ends_and_levels_of_a_temperature_are_on_its_scale():
    assert only({"warmth": uniform("60 degC", "176 degF")}).distribution.support() == pytest.approx((333.15, 353.15))
    assert only({"warmth": linspace("0 degC", "300 K", 2)}).grid_levels == pytest.approx([273.15, 300])
    assert only({"warmth": ["-40 degF"]}).grid_levels == pytest.approx([233.15])


def test_what_follows_a_temperature_is_so_much_warmer():
    cases = plan({"warmth": ["60 degC", "80 degC"], "oil": linked("warmth + 10 degC")}).cases(0, 2)
    assert cases["oil"] == pytest.approx([343.15, 363.15])
    assert plan({"warmth": ["60 degC"], "oil": linked("warmth - 18 degF")}).cases(0, 1)["oil"] == pytest.approx([323.15])


def test_a_width_of_another_kind_is_refused():
    with pytest.raises(SpecError, match=r"study.vary.0.tolerance: wants a temperature difference, got '5 mm' \(length\)"):
        plan({"warmth": tolerance("5 mm")})
    with pytest.raises(SpecError, match=r"study.vary.0.lower: '-300 degC' is below absolute zero"):
        plan({"warmth": uniform("-300 degC", "20 degC")})


def test_a_difference_of_anything_else_is_of_the_same_kind():
    size, warmth, ratio = (key_kind(Warm(), key) for key in ("size", "warmth", "ratio"))
    assert size.difference is size and ratio.difference is ratio
    assert (warmth.difference.unit, warmth.unit, warmth.difference.numeric) == ("deltaK", "K", True)


# -- a file of points ----------------------------------------------------------------------------------------------------------


def points(tmp_path, text):
    (tmp_path / "p.csv").write_text(text)
    return plan({}, points=str(tmp_path / "p.csv"))


@pytest.mark.parametrize(("unit", "cells"), [("degC", "70.1,-40"), ("degF", "158.18,-40"), ("K", "343.25,233.15")])
def test_a_column_of_temperatures_counts_from_where_its_scale_begins(tmp_path, unit, cells):
    made = points(tmp_path, f"warmth [{unit}]\n" + cells.replace(",", "\n") + "\n")
    assert made.cases(0, 2)["warmth"] == pytest.approx([343.25, 233.15], abs=1e-12) and made.remarks == ()
    assert made.cases(0, 1)["warmth"][0] == BY_NAME["temperature"].parse(f"{cells.split(',')[0]} {unit}")


def test_a_column_of_parquet_does_so_too(tmp_path):
    fields = [("warmth", "degC"), ("oil", None), ("size", "mm")]
    schema = pa.schema([pa.field(name, pa.float64(), metadata={"unit": unit} if unit else None) for name, unit in fields])
    parquet.write_table(
        pa.Table.from_arrays([pa.array([70.0, 20.0]), pa.array([300.0, 310.0]), pa.array([4.0, 5.0])], schema=schema), tmp_path / "p.pq"
    )
    cases = plan({}, points=str(tmp_path / "p.pq")).cases(0, 2)
    assert (
        cases["warmth"] == pytest.approx([343.15, 293.15])
        and cases["oil"].tolist() == [300, 310]
        and cases["size"] == pytest.approx([4e-3, 5e-3])
    )


def test_a_temperature_below_absolute_zero_names_its_case(tmp_path):
    with pytest.raises(SpecError, match=r"p.csv: case 1, column 'warmth': '-300.0 degC' is below absolute zero"):
        points(tmp_path, "warmth [degC]\n20\n-300\n")


def test_a_column_in_hertz_of_a_speed_is_read_with_a_remark(tmp_path):
    made = points(tmp_path, "speed [Hz],size [mm]\n10,3\n20,4\n")
    assert made.cases(0, 2)["speed"] == pytest.approx(2 * pi * np.array([10, 20]), rel=1e-15)
    assert made.remarks == ("speed: [Hz] in the file of points is read as [rev/s]",)
    with pytest.raises(SpecError, match="column 'size'.*wants a length, got 'Hz'"):
        points(tmp_path, "size [Hz]\n10\n")


# -- readings ------------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("what", "texts"),
    [
        (["5 Hz", "600 rpm", "5 Hz"], {"5 Hz": "5 rev/s"}),
        (linspace("5 Hz", "300 1/min", 3), {"5 Hz": "5 rev/s", "300 1/min": "300 rev/min"}),
        (normal("10 Hz", "0.2 Hz"), {"10 Hz": "10 rev/s", "0.2 Hz": "0.2 rev/s"}),
        (triangular("5 Hz", "6 Hz", "7 Hz"), {"5 Hz": "5 rev/s", "7 Hz": "7 rev/s", "6 Hz": "6 rev/s"}),
        (tolerance("1 Hz"), {"1 Hz": "1 rev/s"}),
        (tolerance("5 %"), {}),
        (uniform("500 rpm", "+5 %"), {}),
    ],
)
def test_every_number_of_a_variation_that_has_a_reading_says_so_once(what, texts):
    made = plan({"speed": what}, samples=4)
    assert made.remarks == tuple(f"speed: '{text}' is read as {reading}" for text, reading in texts.items())


def test_ten_hertz_are_ten_turns_a_second():
    assert only({"speed": ["10 Hz"]}).grid_levels == pytest.approx([20 * pi], rel=1e-15)
    assert only({"speed": tolerance("1 Hz")}).ends == pytest.approx((18 * pi, 22 * pi))


def test_a_relation_and_the_spec_itself_say_so_too():
    class Two(Warm):
        other: Speed = Field("1 rpm", description="speed")

    given = from_document({"mechanism": "toy", "speed": "10 Hz", "other": "15 Hz"}, Two)
    made = plan({"size": ["1 mm"], "other": linked("speed + 5 Hz")}, spec=given)
    assert made.remarks == ("speed: '10 Hz' is read as 10 rev/s", "other: '15 Hz' is read as 15 rev/s", "other: '5 Hz' is read as 5 rev/s")


def test_a_study_and_a_search_have_them_among_their_findings():
    study = dw.sweep(Warm(), {"speed": ["5 Hz", "6 Hz"]}, on="serial")
    assert study.plan.remarks[0] == "speed: '5 Hz' is read as 5 rev/s"
    assert analyse_study(study).result.findings[:2] == study.plan.remarks


def search(**more):
    table = {
        "unknowns": [{"key": "speed", "lower": "5 Hz", "upper": "20 Hz"}, {"key": "warmth", "lower": "20 degC", "upper": "80 degC"}],
        "objectives": [{"value": "turning", "goal": "minimise"}],
        "requirements": [{"value": "turning", "at_least": "10 Hz", "at_most": "900 rpm"}],
        "generations": 20,
        "population": 10,
    }
    return from_document({"mechanism": "toy", "optimise": table | more}, Warm)


def test_bounds_and_limits_of_a_search_are_read_so_with_remarks():
    problem = prepare(search())
    assert problem.bounds == pytest.approx(np.array([[10 * pi, 40 * pi], [293.15, 353.15]]))
    assert [limit for _, _, limit in problem.limits] == pytest.approx([20 * pi, 30 * pi])
    assert problem.readings == (
        "speed: '5 Hz' is read as 5 rev/s",
        "speed: '20 Hz' is read as 20 rev/s",
        "turning: '10 Hz' is read as 10 rev/s",
    )
    found = dw.optimise(search(), on="serial")
    assert found.findings[:3] == problem.readings and found.best.values["turning"].value == pytest.approx(20 * pi, rel=1e-2)
