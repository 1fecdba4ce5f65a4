"""Quantities at the door: what is read, to which float, and what is refused with which remedy."""

import math
import subprocess
import sys
from decimal import Decimal

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
    "angular speed": {"60 rpm": 2 * math.pi, "28800 rev/h": 16 * math.pi, "1 rps": 2 * math.pi, "180 deg/s": math.pi, "3 rad/s": 3.0},
    "angular acceleration": {"1 rev/s^2": 2 * math.pi, "2 rad/s**2": 2.0, "3 rad/s²": 3.0},
    "velocity": {"60 mm/min": 0.001, "3.6 km/h": 1.0},
    "acceleration": {"1 mm/s^2": 0.001, "1 m/(s s)": 1.0},
    "time": {"1 h": 3600.0, "2 min": 120.0, "3 ms": 0.003, "1 d": 86400.0},
    "frequency": {"8 Hz": 8.0, "2 kHz": 2000.0, "60 1/min": 1.0},
    "mass": {"200 g": 0.2, "1 t": 1000.0, "1 lb": 0.45359237, "1 mg": 1e-6},
    "moment of inertia": {"1 kg m^2": 1.0, "5 kg cm^2": 5e-4, "2 g mm^2": 2e-9, "3 kg·m²": 3.0},
    "force": {"1 kN": 1000.0, "1 kgf": 9.80665, "1 lbf": 4.4482216152605, "2 kg m/s^2": 2.0},
    "torque": {"1 N m": 1.0, "1 Nm": 1.0, "1 N*m": 1.0, "1 N  m": 1.0, "1 N mm": 0.001, "2 kN m": 2000.0, "3 J": 3.0},
    "stiffness": {"3e7 N/m": 3e7, "1 N/um": 1e6, "2 kN/mm": 2e6},
    "rotational stiffness": {"1 N m/rad": 1.0, "1 N m/deg": 180 / math.pi, "1 N m/arcmin": 10800 / math.pi},
    "damping": {"1 N s/m": 1.0, "2 N s/mm": 2000.0, "1 kg/s": 1.0},
    "pressure": {"1 GPa": 1e9, "1 MPa": 1e6, "1 bar": 1e5, "1 N/mm^2": 1e6, "1 psi": 4.4482216152605 / 0.0254**2},
    "area": {"1 cm^2": 1e-4, "1 mm mm": 1e-6},
    "curvature": {"1 1/mm": 1000.0, "2 1/m": 2.0},
    "power": {"1 kW": 1000.0, "1 PS": 735.49875},
    "density": {"7.85 g/cm^3": 7850.0, "1 kg/l": 1000.0},
    "volume": {"1 l": 0.001, "1 L": 0.001, "1 cm^3": 1e-6},
    "rotational damping": {"0.1 N m s/rad": 0.1, "1 N mm s/rad": 1e-3, "1 N m/(rad/s)": 1.0, "2 N m/rpm": 60 / math.pi},
    "viscosity": {"40 mPa s": 0.04, "1 Pa*s": 1.0, "1 N s/m^2": 1.0},
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
        ("-274 degC", "temperature", "'-274 degC' is below absolute zero, 0 K or -273.15 degC"),
        ("-1 K", "temperature", "'-1 K' is below absolute zero, 0 K or -273.15 degC"),
        ("40 mPa s", "kinematic viscosity", "wants a kinematic viscosity, got '40 mPa s' (viscosity); write mm^2/s or cSt"),
        ("46 cSt", "viscosity", "wants a viscosity, got '46 cSt' (kinematic viscosity); write Pa s, the dynamic viscosity"),
        ("1 N m", "unbalance", "wants an unbalance, got '1 N m' (torque); write g mm, kg mm or oz in"),
        ("5 N m/rad", "torque", "wants a torque, got '5 N m/rad' (rotational stiffness); write N m"),
        ("1.2 kg", "length", "wants a length, got '1.2 kg' (mass)"),
        ("3 deg/deg", "angle", "wants an angle, got '3 deg/deg' (a pure number)"),
        ("3 m^5", "length", "wants a length, got '3 m^5'"),
        ("1.2", "length", 'a bare number; a length wants its unit, e.g. "1.2 mm"'),
        (1.2, "length", 'a bare number; a length wants its unit, e.g. "1.2 mm"'),
        (3, "angular speed", 'a bare number; an angular speed wants its unit, e.g. "3 rpm"'),
        pytest.param(10**5000, "length", 'a bare number; a length wants its unit, e.g. "a huge integer mm"', id="huge"),
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
