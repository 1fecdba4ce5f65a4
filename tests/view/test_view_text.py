"""Numbers as text: they read back, in the digits asked for."""

import math
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivewright.digits import last_place, to_place
from drivewright.result import Value
from drivewright.view.text import (
    SUPERSCRIPT,
    axis_label,
    dimension,
    interval_hint,
    number,
    numbers,
    quantity,
    uncertain,
    unit_text,
    with_unit,
)

pytestmark = pytest.mark.property

DOWN = {chr(v): chr(k) for k, v in SUPERSCRIPT.items()}


def read(text):
    """The number a person reads."""
    text = text.replace("\u202f", "").replace("−", "-")
    mantissa, _, power = text.partition("×10")
    return float(mantissa) * 10.0 ** int("".join(DOWN[c] for c in power) or 0)


@given(
    st.floats(allow_nan=False, allow_infinity=False, min_value=-1e200, max_value=1e200).filter(lambda x: x == 0 or abs(x) > 1e-200),
    st.integers(2, 8),
)
def test_a_number_reads_back_within_its_digits(value, digits):
    assert read(number(value, digits)) == pytest.approx(value, rel=0.5000001 * 10.0 ** (1 - digits))


@given(st.floats(1e-3, 999_000))
def test_no_power_of_ten_in_everyday_numbers(value):
    text = number(value)
    assert "×" not in text and not re.search(r"\.\d*0$", text)


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (48.1834, "48.183"),
        (0.0, "0"),
        (-3.5, "−3.5"),
        (12345.6, "12\u202f346"),
        (9999.96, "10\u202f000"),
        (1e6, "1×10⁶"),
        (2.4669517e-6, "2.467×10⁻⁶"),
        (999999.6, "1×10⁶"),
        (0.00099999999, "0.001"),
        (math.inf, "∞"),
        (-math.inf, "−∞"),
        (math.nan, "n/a"),
        (5600.0, "5600"),
    ],
)
def test_particular_numbers(value, text):
    assert number(value) == text


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [
        (math.radians(48.183), "rad", "48.183°"),
        (0.026469, "m", "26.469\u00a0mm"),
        (512.3e6, "Pa", "512.3\u00a0MPa"),
        (3.125, "-", "3.125"),
        (339.3, "m/s^2", "339.3\u00a0m/s²"),
        (math.inf, "m", "∞"),
        (2 * math.pi, "rad/s", "60\u00a0rpm"),
    ],
)
def test_quantities_in_the_unit_people_read(value, unit, text):
    assert quantity(value, unit) == text


def test_units_as_printed():
    assert unit_text("kg m^2") == "kg·m²"
    assert unit_text("deg/s") == "°/s"
    assert unit_text("m^-1") == "m⁻¹"
    assert unit_text("-") == ""
    assert unit_text("degree") == "degree"
    assert with_unit("5", "°") == "5°"


def test_axis_labels():
    assert axis_label("lift of the roller", "mm") == "Lift of the roller [mm]"
    assert axis_label("ratio", "") == "Ratio"
    assert "\n" in axis_label("a rather long name of a quantity", "mm", 20)
    assert (dimension("m"), dimension("rad"), dimension("m/rad")) == ("length", "angle", "value")


# -- digits of an interval -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("value", "low", "high", "expected"),
    [
        (10.234, 8.09, 12.38, ("10.2", "8.1", "12.4")),
        (10.0, 9.97, 10.03, ("10.000", "9.970", "10.030")),
        (3.2, -50.0, 56.0, ("3", "−50", "56")),
        (10234.0, 8123.0, 12345.0, ("10\u202f200", "8100", "12\u202f300")),
        (-0.04, -3.0, 2.9, ("0.0", "−3.0", "2.9")),
        (1.5e7, 1.1e7, 1.9e7, ("1.50×10⁷", "1.10×10⁷", "1.90×10⁷")),
        (2.5e-9, -1.1e-9, 6.1e-9, ("2.5×10⁻⁹", "−1.1×10⁻⁹", "6.1×10⁻⁹")),
        (12.3456789, 12.34567, 12.34569, ("12.346", "", "")),
        (12.3456, 12.3406, 12.3506, ("12.346", "12.341", "12.351")),
        (12.3456, 12.34511, 12.34609, ("12.346", "", "")),
        (12.3456, 12.34509, 12.34611, ("12.346", "12.345", "12.346")),
        (12.3456789, None, None, ("12.346", "", "")),
        (12.3456789, math.nan, 13.0, ("12.346", "", "")),
        (5.0, 5.0, 5.0, ("5", "", "")),
        (2.2166e10, 1.7e7, 2.74e13, ("2.2×10¹⁰", "1.7×10⁷", "2.7×10¹³")),  # a life: each of its own power of ten
        (30.0, 2.9, 31.0, ("30", "2.9", "31")),
        (30.0, 3.1, 31.0, ("30", "3", "31")),
        (1.0, -1.0, 100.0, ("1", "−1", "100")),
    ],
)
def test_digits_are_those_that_the_interval_supports(value, low, high, expected):
    assert numbers(value, low, high) == expected


@given(st.floats(-1e12, 1e12), st.floats(1e-6, 1e3))
def test_a_printed_value_lies_within_a_twentieth_of_half_the_width(value, part):
    """Half a unit of the second digit of the half width: at most 5 % of it; else half a unit of the fifth digit, as of an exact number."""
    half = part * max(abs(value), 1e-9)
    place, size = last_place(value, value - half, value + half), max(abs(value), half)
    exact = 10.0 ** (math.floor(math.log10(float(f"{size:.4e}"))) - 4)
    if place is None:
        assert half < 0.501 * exact
    elif 10.0**place > 1.01 * exact:
        assert abs(float(to_place(value, place)) - value) <= 0.0501 * half
        assert 10.0 ** (place + 1) <= 1.05 * half < 10.0 ** (place + 2) * 1.05
    else:
        assert 10.0**place == pytest.approx(exact) and half >= 0.499 * exact


def test_quantity_with_its_interval_and_without():
    assert uncertain(10.234e-3, "m", 8.09e-3, 12.38e-3) == "10.2 (8.1 to 12.4)\u00a0mm"
    assert uncertain(0.3, "rad", 0.2, 0.4) == "17.2 (11.5 to 22.9)°"
    assert uncertain(10.234e-3, "m", None, None) == quantity(10.234e-3, "m")


@pytest.mark.parametrize(
    ("value", "hint"),
    [
        (Value(1.0, "m", "x"), ""),
        (Value(1.0, "m", "x", 0.0, 2.0, "fit"), "95\u00a0%, fit"),
        (Value(1.0, "m", "x", 0.0, 2.0, "ensemble", False), "95\u00a0%, ensemble, not settled"),
        (Value(1.0, "m", "x", settled=False), "not settled"),
    ],
)
def test_hint_says_how_the_interval_was_made(value, hint):
    assert interval_hint(value) == hint
