"""Tolerances in percent of the spec's own value, and about values that the drive takes from elsewhere."""

import re
from dataclasses import replace

import numpy as np
import pytest
from places import EXAMPLES
from study_toy import TOY, Part, Toy, install

import drivewright as dw
from drivewright import bearings, materials, registry
from drivewright.errors import InputError, SpecError
from drivewright.mechanisms.shaft.supplied import supplied
from drivewright.spec import Vary
from drivewright.spec.keys import key_by_name
from drivewright.spec.study_table import percentage
from drivewright.studies.nominal import nominal_value, supplied_values
from drivewright.studies.plan import make_plan
from drivewright.studies.variables import variable
from drivewright.studies.variation import linspace, normal, parse_variation, tolerance, uniform, with_options, with_variation

pytestmark = pytest.mark.analytical

SPEC = Toy(parts=(Part(name="left", width="4 mm"), Part(width="-6 mm")), size="10 mm", angle="-20 deg")


def law(key, what, spec=SPEC):
    return variable(spec, Vary(key=key, **what), 0).distribution


def refused(key, what, spec=SPEC):
    with pytest.raises(SpecError) as found:
        variable(spec, Vary(key=key, **what), 0)
    return str(found.value)


# -- percent -------------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "wanted"), [("5 %", ("", 0.05)), ("-5%", ("-", -0.05)), (" + 2.5 % ", ("+", 0.025)), (".5 %", ("", 0.005)), ("0 %", ("", 0.0))]
)
def test_percentages(text, wanted):
    assert percentage(text) == pytest.approx(wanted)


@pytest.mark.parametrize("text", ["5", "5 mm", "%", "5 % mm", "1e2 %", "--5 %", "5 %%", "", None, 5, 5.0, True])
def test_what_is_no_percentage(text):
    assert percentage(text) is None


def test_a_tolerance_in_percent_is_that_part_of_the_own_value():
    each, same = law("size", tolerance("5 %")), law("size", tolerance("0.5 mm"))
    assert each.support() == pytest.approx((9.5e-3, 10.5e-3), rel=1e-14) and each.std() == pytest.approx(same.std(), rel=1e-14)
    assert law("parts.left.width", tolerance("10%", "uniform")).support() == pytest.approx((3.6e-3, 4.4e-3), rel=1e-14)
    assert law("ratio", tolerance("20 %", "uniform")).support() == pytest.approx((0.2, 0.3), rel=1e-14)


def test_of_the_magnitude_where_the_own_value_is_negative():
    assert law("parts.1.width", tolerance("10 %", "uniform")).support() == pytest.approx((-6.6e-3, -5.4e-3), rel=1e-14)
    ends = law("parts.1.width", uniform("-10 %", "+20 %")).support()
    assert ends == pytest.approx((-6.6e-3, -4.8e-3), rel=1e-14)


def test_a_sigma_in_percent_is_of_the_middle():
    assert law("size", {"sigma": "2 %"}).std() == pytest.approx(0.2e-3, rel=1e-14)
    each = law("size", normal("30 mm", "2 %"))
    assert (each.mean(), each.std()) == pytest.approx((30e-3, 0.6e-3), rel=1e-14)
    assert law("size", {"mean": "30 mm", "tolerance": "10 %"}).support() == pytest.approx((27e-3, 33e-3), rel=1e-14)
    peak = law("size", {"distribution": "triangular", "mode": "20 mm", "tolerance": "10 %"})
    assert peak.support() == pytest.approx((18e-3, 22e-3), rel=1e-14)


def test_ends_in_percent_are_above_and_below():
    assert law("size", uniform("-5 %", "+10 %")).support() == pytest.approx((9.5e-3, 11e-3), rel=1e-14)
    assert law("size", uniform("0 %", "+10 %")).support() == pytest.approx((10e-3, 11e-3), rel=1e-14)
    assert law("size", {"sigma": "3 %", "lower": "-6 %"}).support() == pytest.approx((9.4e-3, np.inf), rel=1e-14)
    each = variable(SPEC, Vary(key="size", **linspace("-20 %", "+20 %", 5)), 0)
    assert each.levels == pytest.approx([8e-3, 9e-3, 10e-3, 11e-3, 12e-3], rel=1e-14)


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("size=+-5 %", tolerance("5 %")),
        ("size=±5%", tolerance("5%")),
        ("size=-5 %:+10 %", uniform("-5 %", "+10 %")),
        ("size=-20 %:+20 %:5", linspace("-20 %", "+20 %", 5)),
        ("size=normal(30 mm, 2 %)", normal("30 mm", "2 %")),
    ],
)
def test_on_the_command_line(text, wanted):
    assert parse_variation(text) == ("size", wanted)


def test_as_a_table_and_as_an_option_the_same_plan(tmp_path):
    (tmp_path / "a.toml").write_text((EXAMPLES / "rubber_roller_shaft.toml").read_text())
    spec = dw.load(tmp_path / "a.toml")
    (tmp_path / "b.toml").write_text(
        (EXAMPLES / "rubber_roller_shaft.toml").read_text() + '\n[study]\n[[study.vary]]\nkey = "segments.0.diameter"\ntolerance = "5 %"\n'
    )
    one, two = make_plan(with_options(spec, ["segments.0.diameter=±5%"])), make_plan(dw.load(tmp_path / "b.toml"))
    own = spec.segments[0].diameter
    assert one.digest == two.digest and one.random[0].ends == pytest.approx((0.95 * own, 1.05 * own), rel=1e-14)
    other = dw.load(tmp_path / "a.toml", ['segments.0.diameter="21 mm"'])
    assert make_plan(with_options(other, ["segments.0.diameter=±5%"])).digest != one.digest


@pytest.mark.parametrize(
    ("key", "what", "words"),
    [
        (
            "offset",
            tolerance("5 %"),
            "study.vary.0.tolerance: offset has no value in this spec, so 5 % of it says nothing; give tolerance as",
        ),
        ("size", tolerance("0 %"), "study.vary.0.tolerance: must be greater than 0, got '0 %'"),
        ("size", tolerance("-5 %"), "study.vary.0.tolerance: must be greater than 0, got '-5 %'"),
        ("size", {"sigma": "-5 %"}, "study.vary.0.sigma: must be greater than 0"),
        ("size", uniform("95 %", "105 %"), 'study.vary.0.lower: write "+95 %" or "-95 %": so much above or below'),
        ("size", uniform("-5 %", "5 %"), 'study.vary.0.upper: write "+5 %" or "-5 %"'),
        ("size", uniform("+5 %", "-5 %"), "lower bound +5 % is not below upper bound -5 %"),
        ("count", linspace("-25 %", "+25 %", 2), "count takes whole numbers"),
    ],
)
def test_percentages_of_nothing(key, what, words):
    assert words in refused(key, what)


def test_of_zero_the_remedy_is_a_quantity():
    spec = Toy(size="10 mm", force="0 N")
    said = refused("force", tolerance("5 %"), spec)
    assert said == "study.vary.0.tolerance: force is 0, so 5 % of it says nothing; give tolerance as a number with its unit"


@pytest.mark.parametrize("name", ["mean", "mode"])
def test_a_middle_is_no_percentage(name):
    with pytest.raises(SpecError, match="%"):
        Vary(key="size", **{name: "5 %"})


# -- values from elsewhere -----------------------------------------------------------------------------------------------------


def lending(monkeypatch, values):
    install(monkeypatch.setattr, replace(TOY, supplied=values))


def test_a_key_varies_about_what_the_drive_supplies(monkeypatch):
    lending(monkeypatch, lambda spec: {"offset": 2e-3, "size": 99.0})
    assert nominal_value(SPEC, "offset") == 2e-3 and nominal_value(SPEC, "size") == pytest.approx(10e-3)
    assert law("offset", tolerance("0.1 mm", "uniform")).support() == pytest.approx((1.9e-3, 2.1e-3), rel=1e-14)
    assert law("offset", tolerance("5 %", "uniform")).support() == pytest.approx((1.9e-3, 2.1e-3), rel=1e-14)
    assert law("offset", {"sigma": "0.1 mm"}).mean() == 2e-3
    assert variable(SPEC, Vary(key="offset", values=("1 mm",)), 0).nominal == 2e-3


def test_where_nothing_is_supplied_the_message_says_what_to_give(monkeypatch):
    lending(monkeypatch, lambda spec: {})
    assert refused("offset", tolerance("1 mm")).endswith(
        "offset has no value in this spec to vary about; give mean, or lower and upper, or a value for it in the spec"
    )
    lending(monkeypatch, None)
    assert supplied_values(SPEC) == {}


def test_a_spec_with_faults_supplies_nothing(monkeypatch):
    def broken(spec):
        raise InputError("no such card")

    lending(monkeypatch, broken)
    assert supplied_values(SPEC) == {} and variable(SPEC, Vary(key="offset", values=("1 mm",)), 0).nominal is None


def test_a_key_by_the_names_of_its_elements():
    for key in ("parts.0.width", "parts.left.width"):
        assert key_by_name(SPEC, key) == "parts.left.width"
    assert key_by_name(SPEC, "parts.1.width") == "parts.1.width" and key_by_name(SPEC, "size") == "size"


def rubber_roller(*changes):
    return dw.load(EXAMPLES / "rubber_roller_61804.toml", changes)


def test_what_a_shaft_takes_from_catalogue_and_card():
    own, spec = bearings.bearing("61804"), rubber_roller("material.youngs_modulus=", "material.density=", 'material.card="C45"')
    found, card = supplied(spec), materials.properties("C45")
    assert found["material.youngs_modulus"] == card.modulus and found["material.density"] == card.density
    assert "material.poisson_ratio" not in found and "material.yield_strength" not in found  # given in the spec
    for name in ("C", "D"):
        assert found[f"bearings.{name}.dynamic_rating"] == own.dynamic_rating > 1000
        assert found[f"bearings.{name}.static_rating"] == own.static_rating != own.dynamic_rating
        assert found[f"bearings.{name}.radial_clearance"] == own.radial_clearance
    assert "bearings.C.dynamic_rating" not in supplied(rubber_roller('bearings.C.dynamic_rating="4 kN"'))


def test_steel_unless_a_card_says_otherwise_and_no_strength_of_its_own():
    spec = rubber_roller("material.youngs_modulus=", "material.yield_strength=", "material.poisson_ratio=")
    found = supplied(spec)
    assert found["material.youngs_modulus"] == 206e9 and found["material.poisson_ratio"] == 0.3 and "material.yield_strength" not in found


def test_springs_supply_nothing():
    assert not [key for key in supplied(dw.load(EXAMPLES / "rubber_roller_shaft.toml")) if key.startswith("bearings")]


def test_the_rating_of_a_catalogue_bearing_varies_about_its_own():
    """Basic life goes with the cube of the dynamic rating of a ball bearing."""
    assert registry.mechanism("shaft").supplied is supplied
    spec = with_variation(rubber_roller(), {"bearings.C.dynamic_rating": linspace("-10 %", "+10 %", 3)}, analyses=["statics", "rolling"])
    study = dw.sweep(spec, on="serial")
    own = bearings.bearing("61804").dynamic_rating
    assert study["bearings.C.dynamic_rating"] == pytest.approx([0.9 * own, own, 1.1 * own], rel=1e-14)
    life = study["bearings.C.reference_life"]
    assert life / life[1] == pytest.approx([0.9**3, 1, 1.1**3], rel=1e-6)
    plain = dw.run(rubber_roller(), "rolling")
    assert life[1] == pytest.approx(plain["bearings.C.reference_life"], rel=1e-12)


def test_a_clearance_by_levels_and_about_its_own():
    study = dw.sweep(rubber_roller(), {"bearings.0.radial_clearance": ["0 um", "8 um"]}, on="serial")
    assert re.search("complete", study["status"][0]) and study["bearings.C.max_pressure"][0] != study["bearings.C.max_pressure"][1]
    own = bearings.bearing("61804").radial_clearance
    assert law("bearings.0.radial_clearance", tolerance("2 um"), rubber_roller()).mean() == pytest.approx(own, abs=1e-15)
