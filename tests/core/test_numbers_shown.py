"""Numbers as people read them: micrometres, hours, percent, minutes of arc, and 0 where a number is rounding."""

import math
from dataclasses import replace
from pathlib import Path

import pytest
from study_toy import TOY

from drivewright import digits, registry, runner, units
from drivewright.cli import show
from drivewright.labels import usual_unit
from drivewright.report.content import summary
from drivewright.result import Check, Result, Value

pytestmark = pytest.mark.interface


def result(values, checks=()):
    given = {"spec": None, "mechanism": "none", "title": "t", "digest": "d", "tables": {}, "findings": (), "provenance": {}}
    return Result(values={name: value.plain() for name, value in values.items()}, checks=tuple(checks), **given)


@pytest.fixture
def shown():
    """What a page and the terminal show of a value."""

    def show_value(name, values, checks=()):
        run = result(values, checks)
        page = next(value for value in summary(run)["values"] if value["name"] == name)
        return page["shown"].replace("\u00a0", " "), show.value_text(run, name)

    return show_value


@pytest.mark.parametrize(
    "value, page, terminal",
    [
        (Value(2.1e-5, "m", "deflection"), "21 µm", "21 µm"),
        (Value(9.99e-5, "m", "deflection"), "99.9 µm", "99.9 µm"),
        (Value(1.0e-4, "m", "deflection"), "0.1 mm", "0.1 mm"),
        (Value(0.0, "m", "deflection"), "0 mm", "0 mm"),
        (Value(3.6e7, "s", "life"), "10\u202f000 h", "10000 h"),
        (Value(math.pi / 180 / 60, "rad", "play of the wheel"), "1 arcmin", "1 arcmin"),
        (Value(math.pi / 180, "rad", "pressure angle"), "1°", "1°"),
        (Value(0.125, "-", "time share of contact"), "12.5 %", "12.5 %"),
        (Value(0.125, "-", "ratio"), "0.125", "0.125"),
        (Value(3.0, "N m", "torque"), "3 N·m", "3 N·m"),
        (Value(3.0, "m/s^2", "acceleration"), "3 m/s²", "3 m/s²"),
    ],
)
def test_values_in_the_unit_of_the_field(shown, value, page, terminal):
    assert shown("x", {"x": value}) == (page, terminal)


def test_rounding_is_shown_as_nothing(shown):
    values = {"a": Value(1238.0, "N", "force"), "b": Value(-1.1e-13, "N", "axial force"), "c": Value(1.1e-8, "N", "small force")}
    assert shown("b", values) == ("0 N", "0 N")
    assert shown("c", values)[1] == "1.1e-08 N"  # small, but no rounding
    assert shown("b", {"b": values["b"]})[1] == "-1.1e-13 N"  # there is nothing larger beside it
    assert shown("d", {"d": Value(3e-16, "-", "residual")}) == ("0", "0")
    assert result(values).record()["values"]["b"]["value"] == -1.1e-13  # result.json keeps it


def test_the_numbers_of_checks_count_too(shown):
    check = Check("c", 5.0, 9.0, "<=", "Pa", "pressure")
    assert shown("p", {"p": Value(1e-13, "Pa", "pressure at rest")}, (check,))[1] == "0 MPa"


def test_a_number_with_an_interval_is_no_rounding():
    wide = Value(1e-16, "m", "level", -1.0, 1.0, "sample")
    assert not result({"a": Value(1.0, "m", "length"), "b": wide}).is_noise(wide)


def test_floors_are_those_of_each_unit():
    floors = digits.noise_floors([(2.0, "m"), (-300.0, "m"), (math.inf, "N"), (7.0, "N")])
    assert floors == {"m": 300 * digits.NOISE, "N": 7 * digits.NOISE, "-": digits.NOISE}


@pytest.mark.parametrize(
    "label, unit, wanted",
    [
        ("Contact time share, joint wrist", "-", "%"),
        ("Mechanical efficiency", "-", "%"),
        ("Shareholders", "-", ""),
        ("Contact time share", "s", ""),
        ("Maximum play, forward", "rad", "arcmin"),
        ("Slope at gear 'wheel'", "rad", "arcmin"),
        ("Input angle at maximum play", "rad", ""),
        ("Play", "m", ""),
    ],
)
def test_the_usual_unit_follows_from_the_label(label, unit, wanted):
    assert usual_unit(label, unit) == wanted


def test_micrometres_only_where_millimetres_are_shown():
    assert units.scale("m", system="mm", size=1e-6).unit == "um"
    assert units.scale("m", system="inch", size=1e-6).unit == "in"
    assert units.scale("m", system="si", size=1e-6).unit == "m"
    assert units.scale("m").unit == "mm"  # of a whole column nothing is known


def test_key_values_are_of_many_kinds():
    drive = replace(TOY, headline=("bearings.*", "stress", "life.*"))
    names = ["bearings.A", "bearings.B", "bearings.C", "stress", "life.A", "life.B", "other"]
    assert registry.headlines(drive, names) == ["bearings.A", "bearings.B", "bearings.C", "stress", "life.A", "life.B"]
    assert registry.key_values(drive, names, 3) == ["bearings.A", "stress", "life.A"]
    assert registry.key_values(drive, names, 4) == ["bearings.A", "bearings.B", "stress", "life.A"]
    assert registry.key_values(drive, names, 99) == registry.headlines(drive, names)
    assert registry.key_values(replace(TOY, headline=()), names, 2) == ["bearings.A", "bearings.B"]


def test_a_real_run_shows_them():
    path = Path(__file__).parents[2] / "examples" / "pin_indexer.toml"
    from drivewright.spec import load

    run = runner.run(load(path), only=["play"])
    assert show.value_text(run, "play.forward.maximum").endswith(" arcmin")
    play = next(check for check in summary(run)["checks"] if check["name"] == "play.forward")
    assert play["limit"] == "≤ 1\u00a0arcmin" and play["value"].endswith("arcmin")


@pytest.mark.parametrize(
    ("value", "low", "high", "texts"),
    [
        (999_999.0, None, None, ["1e+06"]),
        (123_456.0, None, None, ["123460"]),
        (1_234_567.0, None, None, ["1.2346e+06"]),
        (-0.0, None, None, ["0"]),
        (2.5, 2.5, 2.5, ["2.5"]),
        (0.0, 0.0, 0.0, ["0"]),
        (4.1e-5, 3.0e-5, 5.2e-5, ["4.1e-05", "3.0e-05", "5.2e-05"]),
        (1.2345e-2, 1.2e-2, 1.2690e-2, ["0.01235", "0.01200", "0.01269"]),
        (2.0e6, 1.9e6, 2.1e6, ["2.00e+06", "1.90e+06", "2.10e+06"]),
        (0.9e6, 0.85e6, 0.95e6, ["900000", "850000", "950000"]),
    ],
)
def test_texts_of_a_number_and_its_ends(value, low, high, texts):
    """Plain digits between 1e-5 and a million, powers of ten outside; a width of nothing is no interval."""
    assert digits.plain(value, low, high) == texts


def test_the_first_pattern_of_the_headline_that_fits_has_a_name_and_twelve_stand_for_none():
    drive = replace(TOY, headline=("life.A", "life.*"))
    assert registry.headline_groups(drive, ["life.B", "life.A", "other"]) == [["life.A"], ["life.B"]]
    names = [f"v{n}" for n in range(14)]
    assert registry.headlines(replace(TOY, headline=()), names) == names[:12]
