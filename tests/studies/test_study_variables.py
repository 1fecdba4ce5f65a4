"""What varies, against closed forms: distributions, units, levels, and every type of key."""

import math
import tomllib

import numpy as np
import pytest
from places import EXAMPLES
from study_toy import Body, Part, Toy

import drivewright as dw
from drivewright.spec import Vary
from drivewright.studies.plan import make_plan
from drivewright.studies.variables import variable
from drivewright.studies.variation import (
    geomspace,
    linspace,
    normal,
    parse_variation,
    tolerance,
    triangular,
    uniform,
    with_options,
    with_variation,
)

pytestmark = pytest.mark.analytical

SPEC = Toy(parts=(Part(name="left", width="4 mm"), Part(name="right", width="6 mm"), Part()), bodies={"arm": Body(mass="2 kg")})


def found(key, what, spec=SPEC):
    return variable(spec, Vary(key=key, **what), 0)


def law(key, what, spec=SPEC):
    return found(key, what, spec).distribution


def levels(key, what, spec=SPEC):
    column = found(key, what if isinstance(what, dict) else {"values": what}, spec).levels
    return column.tolist()


def phi(z):
    return math.exp(-z * z / 2) / math.sqrt(2 * math.pi)


def big_phi(z):
    return (1 + math.erf(z / math.sqrt(2))) / 2


def truncated(z, low, high):
    """Distribution function of a standard normal between low and high."""
    return (big_phi(z) - big_phi(low)) / (big_phi(high) - big_phi(low))


# -- distributions -------------------------------------------------------------------------------------------------------------


def test_normal():
    each = law("force", normal("3 N", "0.2 N"))
    assert (each.mean(), each.std()) == pytest.approx((3, 0.2), rel=1e-14) and each.support() == (-np.inf, np.inf)
    assert each.cdf(3.3) == pytest.approx(big_phi(1.5), rel=1e-13)


def test_normal_about_the_specs_own_value():
    assert law("force", {"sigma": "0.2 N"}).mean() == 2.0
    assert law("parts.right.width", {"sigma": "1 um"}).mean() == 6e-3


def test_a_normal_cut_off_on_both_sides():
    each, low, high = law("force", normal("3 N", "0.5 N", "2.5 N", "4 N")), -1.0, 2.0
    mass = big_phi(high) - big_phi(low)
    mean = (phi(low) - phi(high)) / mass
    variance = 1 + (low * phi(low) - high * phi(high)) / mass - mean**2
    assert (each.mean(), each.std()) == pytest.approx((3 + 0.5 * mean, 0.5 * math.sqrt(variance)), rel=1e-12)
    assert each.support() == pytest.approx((2.5, 4)) and each.cdf(3.25) == pytest.approx(truncated(0.5, low, high), rel=1e-12)


@pytest.mark.parametrize(("ends", "support"), [({"lower": "2.5 N"}, (2.5, np.inf)), ({"upper": "3.5 N"}, (-np.inf, 3.5))])
def test_a_normal_cut_off_on_one_side(ends, support):
    each = law("force", {"mean": "3 N", "sigma": "0.5 N"} | ends)
    assert each.support() == pytest.approx(support)
    hazard, sign = phi(1) / big_phi(1), 1 if "lower" in ends else -1
    assert each.mean() == pytest.approx(3 + sign * 0.5 * hazard, rel=1e-12)


def test_a_tolerance_is_three_standard_deviations_and_ends_there():
    each = law("size", tolerance("0.3 mm"))
    assert each.mean() == pytest.approx(10e-3, rel=1e-14) and each.support() == pytest.approx((9.7e-3, 10.3e-3), rel=1e-14)
    assert each.cdf(10.1e-3) == pytest.approx(truncated(1.0, -3, 3), rel=1e-12)
    cut = math.sqrt(1 - 6 * phi(3) / (1 - 2 * big_phi(-3)))
    assert each.std() == pytest.approx(0.1e-3 * cut, rel=1e-10)


def test_a_tolerance_with_a_sigma_or_a_mean_of_its_own():
    each = law("size", {"tolerance": "0.3 mm", "sigma": "0.2 mm", "mean": "12 mm"})
    assert each.mean() == pytest.approx(12e-3) and each.support() == pytest.approx((11.7e-3, 12.3e-3))
    assert each.cdf(12.1e-3) == pytest.approx(truncated(0.5, -1.5, 1.5), rel=1e-12)


def test_uniform():
    each = law("size", {"lower": "8 mm", "upper": "13 mm"})
    assert (each.mean(), each.std(), *each.support()) == pytest.approx((10.5e-3, 5e-3 / math.sqrt(12), 8e-3, 13e-3), rel=1e-14)
    assert each.cdf(9e-3) == pytest.approx(0.2, rel=1e-12)


def test_uniform_with_a_tolerance():
    each = law("parts.1.width", tolerance("0.5 mm", "uniform"))
    assert (*each.support(), each.cdf(5.6e-3)) == pytest.approx((5.5e-3, 6.5e-3, 0.1), rel=1e-12)


def test_triangular():
    each = law("size", triangular("8 mm", "9 mm", "13 mm"))
    assert (each.mean(), *each.support()) == pytest.approx((10e-3, 8e-3, 13e-3), rel=1e-14)
    assert each.var() == pytest.approx(1e-6 * (64 + 81 + 169 - 72 - 104 - 117) / 18, rel=1e-12)
    assert each.cdf(9e-3) == pytest.approx(0.2, rel=1e-12) and each.cdf(11e-3) == pytest.approx(1 - 4 / 20, rel=1e-12)


def test_triangular_with_a_tolerance_peaks_at_the_specs_own_value():
    each = law("size", tolerance("2 mm", "triangular"))
    assert (*each.support(), each.pdf(10e-3)) == pytest.approx((8e-3, 12e-3, 1 / 2e-3), rel=1e-12)


def test_triangular_without_a_peak_takes_the_specs_own_value_else_the_middle():
    ends = {"distribution": "triangular", "lower": "8 mm", "upper": "13 mm"}
    assert law("size", ends).mean() == pytest.approx((8e-3 + 13e-3 + 10e-3) / 3)
    assert law("offset", ends).mean() == pytest.approx(10.5e-3)


def test_the_ends_are_those_of_the_distribution_or_three_sigma():
    assert found("force", normal("3 N", "0.2 N")).ends == pytest.approx((2.4, 3.6), rel=1e-13)
    assert found("size", uniform("8 mm", "13 mm")).ends == pytest.approx((8e-3, 13e-3), rel=1e-14)
    half = found("force", normal("3 N", "0.5 N", "2.5 N"))
    assert half.ends == pytest.approx((2.5, half.distribution.mean() + 3 * half.distribution.std()), rel=1e-12)


def test_what_is_said_alone_chooses_the_distribution():
    kinds = {"sigma": "normal", "tolerance": "normal", "lower": "uniform"}
    for name, kind in kinds.items():
        said = {"lower": "8 mm", "upper": "12 mm"} if name == "lower" else {name: "1 mm"}
        assert np.array_equal(law("size", said).ppf([0.1, 0.8]), law("size", said | {"distribution": kind}).ppf([0.1, 0.8]))


def test_plain_numbers_have_distributions_too():
    assert law("ratio", uniform(0.1, 0.5)).mean() == pytest.approx(0.3)
    assert law("ratio", tolerance(0.03)).mean() == pytest.approx(0.25)


# -- levels --------------------------------------------------------------------------------------------------------------------


def test_levels_from_lower_to_upper():
    assert levels("size", linspace("8 mm", "10 mm", 5)) == pytest.approx([8e-3, 8.5e-3, 9e-3, 9.5e-3, 10e-3], rel=1e-15)
    assert levels("size", linspace("10 mm", "8 mm", 3)) == pytest.approx([10e-3, 9e-3, 8e-3], rel=1e-15)
    assert levels("count", linspace(10, 4, 3)) == [10, 7, 4] and levels("ratio", linspace(0, 1, 3)) == [0.0, 0.5, 1.0]


def test_levels_end_exactly_where_they_are_said_to():
    for what in (linspace, geomspace):
        ends = levels("size", what("0.1 mm", "0.7 mm", 7))
        assert (ends[0], ends[-1]) == (0.0001, 0.0007)


@pytest.mark.parametrize(("low", "high", "ratio"), [("0.1 N", "100 N", 10), ("-1 N", "-8 N", 2), ("16 N", "2 N", 0.5)])
def test_logarithmic_levels_have_equal_ratios(low, high, ratio):
    column = np.array(levels("force", geomspace(low, high, 4)))
    assert column[1:] / column[:-1] == pytest.approx([ratio] * 3, rel=1e-13) and column[0] == pytest.approx(float(low.split()[0]))


@pytest.mark.parametrize(
    ("key", "given", "column"),
    [
        ("count", [3, -1], [3, -1]),
        ("flag", [True, False, True], [True, False, True]),
        ("colour", ["red", "7", ""], ["red", "7", ""]),
        ("form", ["square", "round"], ["square", "round"]),
        ("ratio", [1, 0.5], [1.0, 0.5]),
        ("angle", ["180 deg", "1 rev"], [math.pi, 2 * math.pi]),
        ("offset", ["1 mm", "-2 mm"], [1e-3, -2e-3]),
        ("teeth.1", [20, 21], [20, 21]),
        ("bodies.arm.mass", ["500 g"], [0.5]),
        ("bodies.arm.at.1", ["3 mm"], [3e-3]),
        ("parts.left.width", ["1 mm"], [1e-3]),
        ("parts.2.width", ["1 mm"], [1e-3]),
        ("title", ["a"], ["a"]),
    ],
)
def test_levels_of_every_type_of_key(key, given, column):
    each = found(key, {"values": given})
    assert each.levels.tolist() == column and list(map(type, each.levels.tolist())) == list(map(type, column))


@pytest.mark.parametrize(
    ("key", "name", "unit"),
    [
        ("size", "quantity", "m"),
        ("angle", "quantity", "rad"),
        ("ratio", "number", "-"),
        ("count", "integer", "-"),
        ("flag", "flag", ""),
        ("colour", "text", ""),
        ("form", "text", ""),
        ("teeth.0", "integer", "-"),
        ("bodies.arm.mass", "quantity", "kg"),
    ],
)
def test_kind_and_unit_of_every_type_of_key(key, name, unit):
    values = {"quantity": "1 " + unit, "number": 1.5, "integer": 2, "flag": True, "text": "round"}
    kind = found(key, {"values": [values[name]]}).kind
    assert (kind.name, kind.unit, kind.numeric) == (name, unit, name in ("quantity", "number", "integer"))


@pytest.mark.parametrize(
    ("key", "nominal"),
    [
        ("size", 10e-3),
        ("offset", None),
        ("teeth.1", 23),
        ("parts.left.width", 4e-3),
        ("parts.1.width", 6e-3),
        ("bodies.arm.mass", 2.0),
        ("bodies.arm.at.1", 2e-3),
        ("ratio", 0.25),
    ],
)
def test_the_nominal_value_is_the_specs_own(key, nominal):
    values = {"teeth.1": [1], "ratio": [1], "bodies.arm.mass": ["1 kg"]}.get(key, ["1 mm"])
    assert found(key, {"values": values}).nominal == nominal


def test_a_key_that_is_a_quantity_or_a_word_keeps_both():
    chain = dw.load(EXAMPLES / "hyvo_chain.toml")
    assert levels("joint.offset", ["match-drive", "0.2 mm"], chain) == ["match-drive", "0.2 mm"]
    assert levels("joint.offset", ["0.2 mm", "0.3 mm"], chain) == [2e-4, 3e-4]
    assert found("joint.offset", {"values": ["0.2 mm"]}, chain).kind.given("match-drive") == "match-drive"


def test_keys_of_the_real_drives():
    linkage = dw.load(EXAMPLES / "four_bar.toml")
    assert (
        found("joints.A.clearance", tolerance("0.01 mm"), linkage).nominal
        == found("joints.1.clearance", tolerance("0.01 mm"), linkage).nominal
    )
    assert law("bodies.coupler.mass", tolerance("3 g"), linkage).mean() == pytest.approx(0.3)
    assert law("bodies.coupler.points.C.1", tolerance("3 mm"), linkage).mean() == pytest.approx(0.04)
    assert law("drive.speed", tolerance("60 rpm"), linkage).support() == pytest.approx((8 * math.pi, 12 * math.pi))


# -- units ---------------------------------------------------------------------------------------------------------------------

SAME = [("12.7 mm", "1.27 cm", "0.0127 m", "0.5 in"), ("9 mm", "0.9 cm", "9000 um", "0.009 m"), ("0.3 mm", "300 um", "0.03 cm", "0.0003 m")]


@pytest.mark.parametrize("texts", SAME)
def test_two_ways_to_say_a_length_give_the_same_floats(texts):
    assert len({float(levels("size", [text])[0]).hex() for text in texts}) == 1
    assert len({tuple(levels("size", linspace(text, "20 mm", 7))) for text in texts}) == 1
    assert len({tuple(law("size", {"mean": "10 mm", "sigma": text}).ppf([0.1, 0.5, 0.9])) for text in texts}) == 1
    assert len({tuple(law("size", uniform(text, "20 mm")).ppf([0.1, 0.5, 0.9])) for text in texts}) == 1
    assert len({tuple(law("size", tolerance(text)).ppf([0.1, 0.5, 0.9])) for text in texts}) == 1


def test_the_scale_of_the_world_moves_no_pure_number():
    small, large = (law("size", triangular(*(f"{n}e{power} mm" for n in (8, 9, 13)))).ppf([0.05, 0.4, 0.9]) for power in (0, 3))
    assert large / small == pytest.approx(np.full(3, 1e3), rel=1e-13)


@pytest.mark.parametrize(
    ("key", "value", "table"),
    [("size", 0.0127, 0.0127), ("ratio", 0.5, 0.5), ("count", np.int64(4), 4), ("flag", np.True_, True), ("colour", "blue", "blue")],
)
def test_an_entry_of_a_column_is_what_a_spec_takes(key, value, table):
    kind = found(key, {"values": [{"size": "1 mm", "ratio": 1.0, "count": 1, "flag": True, "colour": "x"}[key]]}).kind
    assert getattr(Toy(**{key: kind.given(value)}), key) == table


# -- ways to say it ------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "what"),
    [
        ("size=1 mm:2 mm:5", linspace("1 mm", "2 mm", 5)),
        (" size = 1 mm : 2 mm : 5 ", linspace("1 mm", "2 mm", 5)),
        ("size=1 mm:2 mm:5:log", geomspace("1 mm", "2 mm", 5)),
        ("ratio=-1:2.5:3", linspace(-1, 2.5, 3)),
        ("size=1 mm:2 mm", uniform("1 mm", "2 mm")),
        ("size=uniform(1 mm, 2 mm)", uniform("1 mm", "2 mm")),
        ("size=normal(1 mm,2 mm)", normal("1 mm", "2 mm")),
        ("size=normal (1 mm, 2 mm, 0 mm)", normal("1 mm", "2 mm", "0 mm")),
        ("size=normal(1 mm, 2 mm, 0 mm, 3 mm)", normal("1 mm", "2 mm", "0 mm", "3 mm")),
        ("size=triangular(1 mm, 2 mm, 4 mm)", triangular("1 mm", "2 mm", "4 mm")),
        ("size=+-0.1 mm", tolerance("0.1 mm")),
        ("size=+/- 0.1 mm", tolerance("0.1 mm")),
        ("size=±0.1 mm", tolerance("0.1 mm")),
        ("size=1 mm", ["1 mm"]),
        ("size=1 mm, 3 mm,", ["1 mm", "3 mm"]),
        ("count=3,5", [3, 5]),
        ("flag=true,false", [True, False]),
        ("colour=red, dark blue", ["red", "dark blue"]),
        ('colour="5",x=y', ["5", "x=y"]),
    ],
)
def test_the_command_line_says_what_the_functions_say(text, what):
    assert parse_variation(text) == (text.partition("=")[0].strip(), what)


def test_what_the_functions_say_stands_in_a_spec_file():
    table = tomllib.loads("""
    [[study.vary]]
    key = "size"
    lower = "8 mm"
    upper = "13 mm"
    steps = 4
    [[study.vary]]
    key = "force"
    distribution = "normal"
    mean = "2 N"
    sigma = "0.3 N"
    """)
    functions = with_variation(Toy(), {"size": linspace("8 mm", "13 mm", 4), "force": normal("2 N", "0.3 N")})
    texts = with_options(Toy(), ["size=8 mm:13 mm:4", "force=normal(2 N, 0.3 N)"])
    assert Toy(**table).study == functions.study == texts.study


def test_what_is_asked_replaces_what_the_spec_varies_and_keeps_its_settings(tmp_path):
    (tmp_path / "p.csv").write_text("ratio\n1\n2\n")
    spec = with_variation(Toy(), {"size": ["1 mm"]}, samples=7, seed=3, values=["area"], points=str(tmp_path / "p.csv"))
    study = with_options(spec, ["force=1 N:2 N"], seed=9, samples=None).study
    assert ([v.key for v in study.vary], study.samples, study.seed, study.values, study.points) == (["force"], 7, 9, ("area",), None)
    assert with_options(spec) is spec and with_options(spec, (), tmp_path / "p.csv", samples=None).study.vary == spec.study.vary


def test_levels_come_as_a_list_an_array_or_a_generator():
    for levels in ([1, 2], (1, 2), np.array([1, 2]), range(1, 3), (n for n in (1, 2))):
        assert make_plan(with_variation(Toy(), {"count": levels})).grid[0].levels.tolist() == [1, 2]
