"""Quantities at the door: what is read, to which float, and what is refused with which remedy."""

import math
import re
import subprocess
import sys
from decimal import Decimal
from fractions import Fraction

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from drivewright import units
from drivewright.errors import UnitError

pytestmark = pytest.mark.interface

READ = {
    "length": {
        "9.525 mm": 0.009525,
        "1 in": 0.0254,
        "2 ft": 0.6096,
        "1 yd": 0.9144,
        "1 mil": 25.4e-6,
        "1 thou": 25.4e-6,
        "1.5 um": 1.5e-6,
        "1.5 µm": 1.5e-6,
        "1.5 μm": 1.5e-6,
        "3 micron": 3e-6,
        "2 km": 2000.0,
        "1 nm": 1e-9,
        "3 dm": 0.3,
        " 7cm ": 0.07,
        "+.5 m": 0.5,
        "-2.e1 m": -20.0,
    },
    "angle": {
        "180 deg": math.pi,
        "1 rev": 2 * math.pi,
        "0.25 turn": math.pi / 2,
        "10800 arcmin": math.pi,
        "648000 arcsec": math.pi,
        "90 °": math.pi / 2,
        "1 rad": 1.0,
        "2 mrad": 0.002,
    },
    "angular speed": {"60 rpm": 2 * math.pi, "28800 rev/h": 16 * math.pi, "1 rps": 2 * math.pi, "180 deg/s": math.pi, "3 rad/s": 3.0}
    | {"25 Hz": 50 * math.pi, "0.5 hertz": math.pi}
    | {f"60 {unit}": 2 * math.pi for unit in ("1/min", "min^-1", "min⁻¹", "min-1", "r/min")}
    | {"60/min": 2 * math.pi},
    "angular acceleration": {"1 rev/s^2": 2 * math.pi, "2 rad/s**2": 2.0, "3 rad/s²": 3.0},
    "velocity": {"60 mm/min": 0.001, "3.6 km/h": 1.0},
    "acceleration": {"1 mm/s^2": 0.001, "1 m/(s s)": 1.0},
    "time": {"1 h": 3600.0, "2 min": 120.0, "3 ms": 0.003, "1 d": 86400.0},
    "frequency": {"8 Hz": 8.0, "2 kHz": 2000.0, "60 1/min": 1.0},
    "mass": {"200 g": 0.2, "1 t": 1000.0, "1 lb": 0.45359237, "1 mg": 1e-6}
    | {"1 lbm": 0.45359237, "16 oz": 0.45359237, "1 slug": 4.4482216152605 / 0.3048},
    "moment of inertia": {"1 kg m^2": 1.0, "5 kg cm^2": 5e-4, "2 g mm^2": 2e-9, "3 kg·m²": 3.0},
    "force": {
        "1 kN": 1000.0,
        "1 kgf": 9.80665,
        "1 lbf": 4.4482216152605,
        "2 kg m/s^2": 2.0,
        "16 ozf": 4.4482216152605,
        "1 kip": 4448.2216152605,
    },
    "torque": {"1 N m": 1.0, "1 Nm": 1.0, "1 N*m": 1.0, "1 N  m": 1.0, "1 N mm": 0.001, "2 kN m": 2000.0, "3 J": 3.0}
    | {f"1 {unit}": 4.4482216152605 * 0.0254 for unit in ("lbf in", "lbf-in", "in-lbf", "lbf*in", "lbf·in")}
    | {f"16 {unit}": 4.4482216152605 * 0.0254 for unit in ("ozf in", "oz in", "oz-in", "in oz")}
    | {"1 lbf ft": 4.4482216152605 * 0.3048, "16 oz-ft": 4.4482216152605 * 0.3048, "1 N-m": 1.0, "2 kW-s": 2000.0},
    "stiffness": {"3e7 N/m": 3e7, "1 N/um": 1e6, "2 kN/mm": 2e6},
    "rotational stiffness": {"1 N m/rad": 1.0, "1 N m/deg": 180 / math.pi, "1 N m/arcmin": 10800 / math.pi},
    "damping": {"1 N s/m": 1.0, "2 N s/mm": 2000.0, "1 kg/s": 1.0},
    "pressure": {"1 GPa": 1e9, "1 MPa": 1e6, "1 bar": 1e5, "1 N/mm^2": 1e6, "1 psi": 4.4482216152605 / 0.0254**2}
    | {"1 ksi": 6.894757293168361e6, "2 lbf/in^2": 2 * 4.4482216152605 / 0.0254**2},
    "area": {"1 cm^2": 1e-4, "1 mm mm": 1e-6},
    "curvature": {"1 1/mm": 1000.0, "2 1/m": 2.0},
    "power": {"1 kW": 1000.0, "1 PS": 735.49875, "1 hp": 550 * 0.3048 * 4.4482216152605},
    "density": {"7.85 g/cm^3": 7850.0, "1 kg/l": 1000.0},
    "volume": {"1 l": 0.001, "1 L": 0.001, "1 cm^3": 1e-6},
    "rotational damping": {"0.1 N m s/rad": 0.1, "1 N mm s/rad": 1e-3, "1 N m/(rad/s)": 1.0, "2 N m/rpm": 60 / math.pi},
    "viscosity": {"40 mPa s": 0.04, "1 Pa*s": 1.0, "1 N s/m^2": 1.0, "40 cP": 0.04, "1 P": 0.1},
    "kinematic viscosity": {"220 mm^2/s": 2.2e-4, "46 cSt": 4.6e-5, "2 St": 2e-4, "1 m^2/s": 1.0, "46 mm²/s": 4.6e-5},
    "temperature": {"70 degC": 343.15, "343.15 K": 343.15, "158 degF": 343.15, "70 °C": 343.15, "-40 °F": 233.15, "-273.15 degC": 0.0},
    "unbalance": {"10 g mm": 1e-5, "1 kg mm": 1e-3, "2 kg m": 2.0, "1 oz in": 0.45359237 / 16 * 0.0254},
    "wear coefficient": {"1 m^2/N": 1.0, "2 mm^3/(N m)": 2e-9, "3 1/Pa": 3.0},
    "slowness": {"2 s/m": 2.0, "1 s/mm": 1000.0},
    "torsional compliance": {"1 rad/(N m)": 1.0, "2 rad/(kN m)": 2e-3},
    "flexibility": {"1 m/N": 1.0, "250 um/kN": 2.5e-7, "3 mm/N": 3e-3},
}
CASES = [(name, text, value) for name, texts in READ.items() for text, value in texts.items()]
DIMENSIONS = pytest.mark.parametrize("dimension", units.DIMENSIONS, ids=lambda d: d.name)


def complaint(text, name):
    with pytest.raises(UnitError) as caught:
        units.to_si(text, name)
    return str(caught.value)


def test_every_dimension_has_cases():
    assert set(READ) == set(units.BY_NAME)


@pytest.mark.parametrize(("name", "text", "value"), CASES)
def test_a_quantity_is_read_to_the_last_digit(name, text, value):
    assert units.to_si(text, name) == pytest.approx(value, rel=3e-16, abs=0)


@given(st.integers(-(10**9), 10**9), st.integers(-12, 6))
def test_the_same_length_is_the_same_float_in_every_unit(digits, power):
    metres = Decimal(digits).scaleb(power)
    texts = [f"{metres.scaleb(shift):f} {unit}" for unit, shift in (("m", 0), ("mm", 3), ("cm", 2), ("um", 6), ("km", -3))]
    assert {units.to_si(text, "length") for text in texts} == {float(metres)}


@given(st.integers(-(10**6), 10**6))
def test_the_same_angle_is_the_same_float_in_every_unit(quarters):
    texts = [f"{90 * quarters} deg", f"{quarters / 4} rev", f"{5400 * quarters} arcmin", f"{324000 * quarters} arcsec"]
    assert len({units.to_si(text, "angle") for text in texts}) == 1
    assert units.to_si(texts[0], "angle") == pytest.approx(quarters * math.pi / 2, rel=4e-16, abs=0)


@DIMENSIONS
def test_no_dimension_takes_the_unit_of_another(dimension):
    for other in units.DIMENSIONS:
        if other is not dimension and not dimension.reading(f"3 {other.display_unit}"):
            message = complaint(f"3 {other.display_unit}", dimension.name)
            assert message.startswith(f"wants {dimension.described}, got '3 {other.display_unit}' ({other.name})")


@DIMENSIONS
def test_the_unit_people_read_is_the_registry_s(dimension):
    factor, shown = units.display(dimension.unit)
    assert shown == dimension.display_unit and factor == pytest.approx(1 / units.unit_factor(shown, dimension.name), rel=2e-16, abs=0)
    assert units.unit_factor(dimension.unit, dimension.name) == 1.0


def test_an_si_unit_nobody_registered_is_shown_as_it_is():
    assert units.display("m/N^2") == (1.0, "m/N^2") and units.display("-") == (1.0, "-")


@pytest.mark.parametrize(
    ("text", "name", "remedy"),
    [
        ("8 1/s", "angular speed", "wants an angular speed, got '8 1/s' (frequency); a frequency counts events: write rev/s, rpm or rad/s"),
        ("8 rad/s", "frequency", "wants a frequency, got '8 rad/s' (angular speed); write Hz or 1/s"),
        ("5 N m", "rotational stiffness", "wants a rotational stiffness, got '5 N m' (torque); write N m/rad or N m/deg"),
        ("70 C", "temperature", 'wants a temperature, got \'70 C\'; write e.g. "70 degC", "343.15 K" or "158 degF"'),
        ("70 F", "temperature", 'wants a temperature, got \'70 F\'; write e.g. "70 degC", "343.15 K" or "158 degF"'),
        ("9 mK", "temperature", 'wants a temperature, got \'9 mK\'; write e.g. "70 degC", "343.15 K" or "158 degF"'),
        ("1 N", "temperature", 'wants a temperature, got \'1 N\' (force); write e.g. "70 degC", "343.15 K" or "158 degF"'),
        ("-274 degC", "temperature", "'-274 degC' is below absolute zero, 0 K or -273.15 °C"),
        ("-1 K", "temperature", "'-1 K' is below absolute zero, 0 K or -273.15 °C"),
        ("40 mPa s", "kinematic viscosity", "wants a kinematic viscosity, got '40 mPa s' (viscosity); write mm^2/s or cSt"),
        ("46 cSt", "viscosity", "wants a viscosity, got '46 cSt' (kinematic viscosity); write Pa s, the dynamic viscosity"),
        ("1 N m", "unbalance", "wants an unbalance, got '1 N m' (torque); write g mm, kg mm or oz in"),
        ("10 lb", "force", "wants a force, got '10 lb' (mass); lb is a mass: write lbf"),
        ("10 lbm", "force", "wants a force, got '10 lbm' (mass); lbm is a mass: write lbf"),
        ("10 oz", "force", "wants a force, got '10 oz' (mass); oz is a mass: write ozf"),
        ("10 lb-in", "torque", "wants a torque, got '10 lb-in' (unbalance); lb is a mass: write lbf in"),
        ("10 lb/in^2", "pressure", "wants a pressure, got '10 lb/in^2'; lb is a mass: write lbf/in^2"),
        ("10 lbf", "mass", "wants a mass, got '10 lbf' (force)"),
        (
            "25 1/s",
            "angular speed",
            "wants an angular speed, got '25 1/s' (frequency); a frequency counts events: write rev/s, rpm or rad/s",
        ),
        (
            "25 kHz",
            "angular speed",
            "wants an angular speed, got '25 kHz' (frequency); a frequency counts events: write rev/s, rpm or rad/s",
        ),
        ("5 oz in", "length", "wants a length, got '5 oz in' (unbalance)"),
        ("5 k-m", "length", "'k-m' is no unit known here (did you mean 'kW'?)"),
        ("5 N m/rad", "torque", "wants a torque, got '5 N m/rad' (rotational stiffness); write N m"),
        ("1.2 kg", "length", "wants a length, got '1.2 kg' (mass)"),
        ("3 deg/deg", "angle", "wants an angle, got '3 deg/deg' (a pure number)"),
        ("3 m^5", "length", "wants a length, got '3 m^5'"),
        ("1.2", "length", 'unit missing: a length, e.g. "1.2 mm"'),
        (1.2, "length", 'unit missing: a length, e.g. "1.2 mm"'),
        (3, "angular speed", 'unit missing: an angular speed, e.g. "3 rpm"'),
        pytest.param(10**5000, "length", 'unit missing: a length, e.g. "a huge integer mm"', id="huge"),
        (True, "length", "wants a length, got true"),
        (None, "angle", "wants an angle, got None"),
        (["1 mm"], "length", "wants a length, got ['1 mm']"),
        ("5 MM", "length", "'MM' is no unit known here (did you mean 'mm'?)"),
        ("5 rmp", "angular speed", "'rmp' is no unit known here (did you mean 'rpm'?)"),
        ("1,5 mm", "length", "'1,5 mm' has a comma; write a decimal point and no thousands separator"),
        ("mm", "length", '\'mm\' is not "number unit"; write e.g. "9.5 mm"'),
        ("", "length", '\'\' is not "number unit"; write e.g. "9.5 mm"'),
        ("nan mm", "length", "'nan mm' is not finite; write e.g. \"9.5 mm\""),
        ("-inf mm", "length", "'-inf mm' is not finite; write e.g. \"9.5 mm\""),
        (math.nan, "length", "nan is not finite"),
        (-math.inf, "length", "-inf is not finite"),
        ("1e400 mm", "length", "'1e400 mm' is not finite: beyond the largest number"),
        ("1e307 km", "length", "'1e307 km' is not finite: beyond the largest number"),
        ("1e999999999 m", "length", "'1e999999999 m' is not finite: beyond the largest number"),
    ],
)
def test_what_is_refused_says_why_and_what_to_write(text, name, remedy):
    assert complaint(text, name) == remedy


@pytest.mark.parametrize(
    "unit",
    [
        "m^^2",
        "m^",
        "m (",
        "()",
        "m # x",
        "(m^9)^9",
        "m^99999999",
        "__class__",
        "__import__('os')",
        "lambda: 1",
        "m.m",
        "2 mm",
        "mm;",
        "m" * 200,
        "m/",
        "³",
        "\x00",
        "mm\nkg%",
    ],
)
def test_nonsense_instead_of_a_unit_is_refused_at_once(unit):
    assert (
        "no unit known here" in complaint(f"3 {unit}", "length") or "wants a length" in complaint(f"3 {unit}", "length") or len(unit) > 99
    )


@given(st.text(max_size=30), st.sampled_from(units.DIMENSIONS))
def test_any_text_gives_a_finite_number_or_our_complaint(text, dimension):
    try:
        assert math.isfinite(dimension.parse("3 " + text))
    except UnitError as error:
        assert error.message


def test_a_number_too_small_for_a_float_is_zero():
    assert units.to_si("1e-999999999 m", "length") == 0.0 == units.to_si("1e-330 mm", "length")


def test_a_float_marked_as_si_is_taken_as_it_is():
    assert units.to_si(units.SI(0.0254), "length") == 0.0254
    assert complaint(units.SI("nan"), "length") == "nan is not finite"


# -- writing -------------------------------------------------------------------------------------------------------------------

FLOATS = st.floats(allow_nan=False, allow_infinity=False)


@given(FLOATS, st.sampled_from(units.DIMENSIONS))
def test_the_text_of_a_quantity_reads_back_to_exactly_it(value, dimension):
    value = abs(value) if dimension.name == "temperature" else value
    assert dimension.parse(dimension.text(value)) == value


@given(st.integers(-(10**6), 10**6), st.integers(-4, 4), st.sampled_from(units.DIMENSIONS))
def test_what_was_said_in_the_common_unit_is_written_so(digits, power, dimension):
    number = Decimal(digits).scaleb(power).normalize()
    assume(dimension.name != "temperature" or number >= -273)
    text = f"{number:f} {dimension.display_unit}" if number else f"0 {dimension.display_unit}"
    assert Decimal(dimension.text(dimension.parse(text)).split(" ", 1)[0]) == number


@pytest.mark.parametrize(
    ("name", "said", "written"),
    [
        ("length", "9.525 mm", "9.525 mm"),
        ("length", "1e6 m", "1e+9 mm"),
        ("length", "-0 m", "0 mm"),
        ("length", "0.1 um", "0.0001 mm"),
        ("length", "1.23456789 um", "0.00123456789 mm"),
        ("angle", "-0.125 rev", "-45 deg"),
        ("angle", "1 arcmin", "1 arcmin"),
        ("angle", "0.1 rad", "0.1 rad"),
        ("angular speed", "200 rpm", "200 rpm"),
        ("angular speed", "1 rad/s", "1 rad/s"),
        ("velocity", "100 mm/min", "100 mm/min"),
        ("stiffness", "2e7 N/m", "20000 N/mm"),
        ("pressure", "1.5 GPa", "1500 MPa"),
        ("time", "7 min", "420 s"),
        ("temperature", "0 degC", "0 degC"),
    ],
)
def test_quantities_are_written_as_people_read_them(name, said, written):
    assert units.BY_NAME[name].text(units.to_si(said, name)) == written


def test_the_factors_that_are_kept_are_those_of_the_parser():
    assert len(units._factors()) > 90
    for text, kept in units._factors().items():
        assert kept == units.parsed_unit(text), text


def test_usual_units_need_no_parser():
    code = "import sys; from drivewright import units; print(units.to_si('12 N m/rad', 'rotational stiffness'), 'pint' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split() == ["12.0", "False"]


@pytest.mark.parametrize("dimension", units.DIMENSIONS, ids=lambda dimension: dimension.name)
def test_the_units_of_every_kind_of_quantity_are_kept(dimension):
    assert {dimension.unit, dimension.display_unit, *dimension.also} <= set(units._factors())


# -- other units of one reading, other systems ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "name", "reading"),
    [
        ("25 Hz", "angular speed", "25 rev/s"),
        ("-1.5e3 1/min", "angular speed", "-1.5e3 rev/min"),
        ("1500 min⁻¹", "angular speed", "1500 rev/min"),
        ("10 oz-in", "torque", "10 ozf in"),
        ("25 rev/s", "angular speed", ""),
        ("25 Hz", "frequency", ""),
        ("10 oz in", "unbalance", ""),
        ("Hz", "angular speed", ""),
    ],
)
def test_what_is_read_as_something_says_as_what(text, name, reading):
    dimension = units.BY_NAME[name]
    assert dimension.reading(text) == reading
    assert not reading or (dimension.parse(text) == dimension.parse(reading) and units.has_two_readings(text))


def test_a_factor_is_of_the_kind_itself():
    with pytest.raises(UnitError, match="wants an angular speed"):
        units.unit_factor("Hz", "angular speed")


def test_factors_of_inches_and_pounds_are_exact():
    pound, inch = Fraction("4.4482216152605"), Fraction("0.0254")
    assert units.exact_factor("ksi") == 1000 * pound / inch**2 and float(units.exact_factor("ksi")) == 6.894757293168361e6
    assert units.exact_factor("mil") == units.exact_factor("thou") == inch / 1000
    assert units.exact_factor("kip") == 1000 * pound and units.exact_factor("hp") == 550 * 12 * inch * pound
    assert units.exact_factor("lbm") == 16 * units.exact_factor("oz") == Fraction("0.45359237")


@given(st.integers(-(10**9), 10**9), st.integers(-6, 3))
def test_inches_and_millimetres_are_the_same_float(digits, power):
    inches = Decimal(digits).scaleb(power)
    texts = (f"{inches:f} in", f"{inches * Decimal('25.4'):f} mm", f"{inches * 1000:f} mil", f"{inches / 12 * 12:f} in")
    assert len({units.to_si(text, "length") for text in texts}) == 1


@pytest.mark.parametrize("system", ["mm", "si", "inch"])
@DIMENSIONS
def test_what_a_system_shows_reads_back(dimension, system):
    shown = units.scale(dimension.unit, system=system)
    assert dimension.parse(f"{shown.of(412.375)!r} {shown.unit}") == pytest.approx(412.375, rel=4e-15)
    assert (shown.factor, shown.unit) == units.display(dimension.unit, system=system)
    assert system != "si" or shown == (1.0, dimension.unit, 0.0)


def test_no_unit_of_the_inch_system_is_metric():
    metric = {"m", "mm", "um", "kg", "g", "N", "kN", "Pa", "MPa", "W", "J", "l", "degC", "K"}
    texts = [units.display(dimension.unit, system="inch")[1] for dimension in units.DIMENSIONS]
    texts += [
        units.display(unit, system="inch")[1] for unit in ("J", "kg/s", "m/rad", "m/rad^2", "m/s^3", "m/N^2", "N/m^2", "W/m", "deltaK")
    ]
    assert not [text for text in texts if metric & set(re.findall("[A-Za-z]+", text))]


@pytest.mark.parametrize(
    ("si_unit", "factor", "unit"),
    [
        ("J", 8.850745791327185, "lbf in"),
        ("m/rad^2", 1 / 0.0254, "in/rad^2"),
        ("kg/s", 1 / 0.45359237, "lb/s"),
        ("1/rad", 1.0, "1/rad"),
        ("-", 1.0, "-"),
        ("m per tooth", 1.0, "m per tooth"),
    ],
)
def test_units_without_a_dimension_go_word_by_word(si_unit, factor, unit):
    assert units.display(si_unit, system="inch") == (pytest.approx(factor, rel=3e-16), unit)
    assert units.display(si_unit, system="si") == (1.0, si_unit)


def test_what_a_plot_wants_gives_way_to_a_system_of_its_own():
    assert units.display("rad", "arcmin")[1] == "arcmin" == units.display("rad", "arcmin", "inch")[1]
    assert units.display("rad", "arcmin", "si") == (1.0, "rad")
    assert units.display("m", "um") == (1e6, "um") and units.display("m", "um", "inch")[1] == "in"


def test_temperatures_are_shown_on_their_scale_and_differences_by_the_factor():
    celsius, fahrenheit, kelvin = (units.scale("K", system=system) for system in ("mm", "inch", "si"))
    assert (celsius.of(343.15), celsius.unit) == (70.0, "degC") and kelvin == (1.0, "K", 0.0)
    assert fahrenheit.of(343.15) == pytest.approx(158, abs=1e-12) and fahrenheit.unit == "degF"
    assert units.scale("deltaK") == (1.0, "K", 0.0) and units.scale("deltaK", system="inch") == (1.8, "degF", 0.0)
    assert units.TEMPERATURE_DIFFERENCE.parse("10 K") == units.TEMPERATURE_DIFFERENCE.parse("18 degF") == 10.0


@pytest.mark.parametrize(
    ("unit", "size", "shown", "text"),
    [
        ("s", 3599.0, 3599.0, "s"),
        ("s", 3600.0, 1.0, "h"),
        ("s", -12345600.0, -3429 - 1 / 3, "h"),
        ("s", math.nan, math.nan, "s"),
        ("rev", 999999.0, 999999.0, "rev"),
        ("rev", 34.03e6, 34.03, "million rev"),
        ("m", 1e9, 1e12, "mm"),
    ],
)
def test_long_times_are_hours_and_many_revolutions_millions(unit, size, shown, text):
    scale = units.scale(unit, size=size)
    assert scale.of(size) == pytest.approx(shown, rel=4e-16, nan_ok=True) and scale.unit == text
    assert units.scale("s", "min", size=7200.0).unit == "min"


@pytest.mark.error
@pytest.mark.parametrize(
    "text, meant",
    [("1 Nmm", "N mm"), ("1 gmm", "g mm"), ("1 U/min", "rpm"), ("1 N/mm2", "N/mm^2"), ("1 kgm2", "kg m^2"), ("1 lbfin", "lbf in")],
)
def test_units_as_others_write_them_are_suggested(text, meant):
    with pytest.raises(UnitError, match=re.escape(f"(did you mean {meant!r}?)")):
        units.any_quantity(text)


def test_every_suggestion_is_a_unit():
    for text, meant in units.OTHERWISE.items():
        assert units.exact_factor(meant) > 0, text


@pytest.mark.parametrize(
    ("name", "number", "unit", "count"),
    [("temperature", 338.15, "degC", 65.0), ("temperature", 253.15, "degF", -4.0), ("length", 0.0254, "in", 1.0)],
)
def test_an_si_number_is_counted_in_a_unit(name, number, unit, count):
    assert units.BY_NAME[name].count(number, unit) == pytest.approx(count, rel=1e-12)
    assert units.BY_NAME[name].parse(f"{count!r} {unit}") == pytest.approx(number, rel=1e-15)


def test_a_count_wants_a_unit_of_its_kind():
    with pytest.raises(units.UnitError):
        units.BY_NAME["length"].count(1.0, "degC")
