"""Numbers as text: they read back, in the digits asked for."""

import math
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivewright.view.text import SUPERSCRIPT, axis_label, dimension, number, quantity, unit_text, with_unit

DOWN = {chr(v): chr(k) for k, v in SUPERSCRIPT.items()}


def read(text):
    """The number a person reads."""
    text = text.replace("\u202f", "").replace("−", "-")
    mantissa, _, power = text.partition("×10")
    return float(mantissa) * 10.0 ** int("".join(DOWN[c] for c in power) or 0)


@given(st.floats(allow_nan=False, allow_infinity=False, min_value=-1e200, max_value=1e200).filter(lambda x: x == 0 or abs(x) > 1e-200),
       st.integers(2, 8))
def test_a_number_reads_back_within_its_digits(value, digits):
    assert read(number(value, digits)) == pytest.approx(value, rel=0.5000001 * 10.0 ** (1 - digits))


@given(st.floats(1e-3, 999_000))
def test_no_power_of_ten_in_everyday_numbers(value):
    text = number(value)
    assert "×" not in text and not re.search(r"\.\d*0$", text)


@pytest.mark.parametrize(("value", "text"), [
    (48.1834, "48.183"), (0.0, "0"), (-3.5, "−3.5"), (12345.6, "12\u202f346"), (9999.96, "10\u202f000"), (1e6, "1×10⁶"),
    (2.4669517e-6, "2.467×10⁻⁶"), (999999.6, "1×10⁶"), (0.00099999999, "0.001"), (math.inf, "∞"), (-math.inf, "−∞"),
    (math.nan, "n/a"), (5600.0, "5600")])
def test_particular_numbers(value, text):
    assert number(value) == text


@pytest.mark.parametrize(("value", "unit", "text"), [
    (math.radians(48.183), "rad", "48.183°"), (0.026469, "m", "26.469\u00a0mm"), (512.3e6, "Pa", "512.3\u00a0MPa"), (3.125, "-", "3.125"),
    (339.3, "m/s^2", "339.3\u00a0m/s²"), (math.inf, "m", "∞"), (2 * math.pi, "rad/s", "60\u00a0rpm")])
def test_quantities_in_the_unit_people_read(value, unit, text):
    assert quantity(value, unit) == text


def test_units_as_printed():
    assert unit_text("kg m^2") == "kg\u00a0m²"
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
