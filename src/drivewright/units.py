"""Units at the door: text with a unit -> SI float, once.

A registry of our own, in which **angle is a base dimension**: `rev` and `rpm` exist, "8 Hz" is no angular speed, and
`N m` (torque) is not `N m/rad` (rotational stiffness).  The registry is built when the first quantity is parsed.
"""

import math
import re
from dataclasses import dataclass
from functools import cache
from typing import Annotated, Any

from drivewright.errors import UnitError, nearest

DEFINITIONS = """
milli- = 1e-3 = m-
micro- = 1e-6 = µ- = μ- = u-
kilo- = 1e3 = k-
mega- = 1e6 = M-
giga- = 1e9 = G-
centi- = 1e-2 = c-
deci- = 1e-1 = d-
nano- = 1e-9 = n-
metre = [length] = m = meter
kilogram = [mass] = kg
second = [time] = s
radian = [angle] = rad
kelvin = [temperature] = K
gram = 1e-3 * kilogram = g
tonne = 1e3 * kilogram = t
inch = 0.0254 * metre = in
foot = 0.3048 * metre = ft
micron = 1e-6 * metre
pound = 0.45359237 * kilogram = lb
minute = 60 * second = min
hour = 3600 * second = h
day = 86400 * second = d
degree = 0.017453292519943295 * radian = deg = °
arcminute = 0.017453292519943295 / 60 * radian = arcmin
arcsecond = 0.017453292519943295 / 3600 * radian = arcsec
revolution = 6.283185307179586 * radian = rev = turn
rpm = revolution / minute
rps = revolution / second
hertz = 1 / second = Hz
newton = kilogram * metre / second ** 2 = N
kilogram_force = 9.80665 * newton = kgf
pound_force = 4.4482216152605 * newton = lbf
pascal = newton / metre ** 2 = Pa
bar = 1e5 * pascal
psi = pound_force / inch ** 2
joule = newton * metre = J
watt = joule / second = W
horsepower = 735.49875 * watt = PS
litre = 1e-3 * metre ** 3 = l = L
"""

NUMBER = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*?)\s*$", re.DOTALL)


class SI(float):
    """A float that is already in SI: the one bare number a quantity accepts, for code that has computed it."""


@cache
def _registry():
    import pint

    return pint.UnitRegistry(DEFINITIONS.strip().splitlines())


@cache
def _unit(text):
    """(factor to SI, dimensionality as a frozenset of (base, exponent)) of a unit text."""
    import pint

    # A blank between two units is a product; pint reads "N m" so, but not "N  m" or "kg·m".
    expression = re.sub(r"\s*[·*]\s*|\s+(?=[A-Za-zµμ°])", "*", text.strip().replace("^", "**"))
    try:
        quantity = (1.0 * _registry().parse_units(expression)).to_base_units()
    except (pint.UndefinedUnitError, pint.DefinitionSyntaxError, AttributeError):
        words = [w for w in re.findall(r"[A-Za-zµμ°]+", text) if w not in _registry()]
        hint = nearest(words[0], UNITS_PEOPLE_WRITE) if words else ""
        raise UnitError(f"{text!r} is no unit known here{hint}") from None
    except Exception:  # pint's parser raises whatever Python's tokeniser does on garbage
        raise UnitError(f"{text!r} is no unit known here") from None
    return float(quantity.magnitude), frozenset((k, float(v)) for k, v in quantity.dimensionality.items())


UNITS_PEOPLE_WRITE = ("mm", "um", "cm", "m", "in", "deg", "rad", "rev", "rpm", "arcmin", "N", "kN", "MPa", "GPa", "Pa", "kg", "g", "ms", "s",
                      "min", "h", "Hz", "J", "W", "kW")


@dataclass(frozen=True)
class Dimension:
    """A kind of quantity: its SI unit and the unit people read.  Also the pydantic field type of that quantity."""

    name: str
    unit: str
    shown: str

    def parse(self, value):
        """SI float of a text such as "9.525 mm"; UnitError says what was wanted and what came."""
        if isinstance(value, SI):
            return float(value)
        if isinstance(value, bool) or not isinstance(value, (str, int, float)):
            raise UnitError(f"wants {self.described}, got {value!r}")
        if not isinstance(value, str):
            raise UnitError(f'a bare number; {self.described} wants its unit, e.g. "{value} {self.shown}"')
        number, unit = split(value)
        if not unit:
            raise UnitError(f'a bare number; {self.described} wants its unit, e.g. "{value.strip()} {self.shown}"')
        return number * self.factor(unit, value)

    def factor(self, unit, whole=None):
        """Factor from `unit` to SI; UnitError where it belongs to another kind of quantity."""
        factor, dimensionality = _unit(unit)
        if dimensionality != _unit(self.unit)[1]:
            raise UnitError(f"wants {self.described}, got {whole or unit!r}{_other_name(dimensionality)}{self._remedy(dimensionality)}")
        return factor

    def text(self, value):
        """The shortest text in the shown unit that parses back to exactly `value`; SI where none does."""
        shown = value / _unit(self.shown)[0]
        for digits in (6, 9, 12, 15, 16, 17):
            if (text := f"{_plain(shown, digits)} {self.shown}") and self.parse(text) == value:
                return text
        return f"{value!r} {self.unit}"

    @property
    def described(self):
        return f"{'an' if self.name[0] in 'aeiou' else 'a'} {self.name}"

    def _remedy(self, dimensionality):
        """How to get from the unit that was given to one that fits, where the mix-up is a classic."""
        mixups = {("angular speed", "frequency"): "; a frequency counts events: write rev/s, rpm or rad/s",
                  ("frequency", "angular speed"): "; write Hz or 1/s", ("rotational stiffness", "torque"): "; write N m/rad or N m/deg",
                  ("torque", "rotational stiffness"): "; write N m"}
        return mixups.get((self.name, _name_of(dimensionality)), "")

    def __get_pydantic_core_schema__(self, source, handler):
        from pydantic_core import core_schema

        def validate(value):
            try:
                return self.parse(value)
            except UnitError as error:
                raise ValueError(error.message) from None

        return core_schema.no_info_before_validator_function(validate, handler(source))

    def __get_pydantic_json_schema__(self, schema, handler):
        # Limits are given in SI beside the unit; JSON schema itself cannot compare quantities.
        limits = {f"x-{name}": schema["schema"][name] for name in ("gt", "ge", "lt", "le") if name in schema.get("schema", {})}
        return {"type": "string", "examples": [f"1 {self.shown}"], "x-dimension": self.name, "x-unit": self.shown, "x-si-unit": self.unit, **limits}


def split(text):
    """(number, unit text) of "9.525 mm"; UnitError where there is no finite number in front."""
    match = NUMBER.match(text)
    if not match:
        reason = "is not finite" if re.match(r"\s*[+-]?(nan|inf)", text, re.IGNORECASE) else 'is not "number unit"'
        raise UnitError(f"{text!r} {reason}; write e.g. \"9.5 mm\"")
    number = float(match[1])
    if not math.isfinite(number):
        raise UnitError(f"{text!r} is not finite")
    return number, match[2]


def _plain(value, digits):
    """`value` to so many digits, without an exponent where that reads well."""
    if value == int(value) and abs(value) < 1e6:
        return str(int(value)) if value else "0"
    return f"{value:.{digits}g}"


DIMENSIONS = tuple(Dimension(*row) for row in (
    ("length", "m", "mm"), ("angle", "rad", "deg"), ("angular speed", "rad/s", "rpm"), ("angular acceleration", "rad/s^2", "rad/s^2"),
    ("velocity", "m/s", "m/s"), ("acceleration", "m/s^2", "m/s^2"), ("time", "s", "s"), ("frequency", "Hz", "Hz"), ("mass", "kg", "kg"),
    ("moment of inertia", "kg m^2", "kg m^2"), ("force", "N", "N"), ("torque", "N m", "N m"), ("stiffness", "N/m", "N/mm"),
    ("rotational stiffness", "N m/rad", "N m/rad"), ("damping", "N s/m", "N s/m"), ("pressure", "Pa", "MPa"), ("area", "m^2", "mm^2"),
    ("curvature", "1/m", "1/mm"), ("power", "W", "W"), ("density", "kg/m^3", "kg/m^3"), ("volume", "m^3", "mm^3")))
BY_NAME = {dimension.name: dimension for dimension in DIMENSIONS}
BY_UNIT = {dimension.unit: dimension for dimension in DIMENSIONS}


@cache
def _name_of(dimensionality):
    for dimension in DIMENSIONS:
        if _unit(dimension.unit)[1] == dimensionality:
            return dimension.name
    return ""


def _other_name(dimensionality):
    name = _name_of(dimensionality)
    return f" ({name})" if name else ""


def field(name):
    """The pydantic field type of a quantity by the name of its dimension."""
    return Annotated[float, BY_NAME[name]]


Length, Angle, Speed, Velocity = field("length"), field("angle"), field("angular speed"), field("velocity")
Acceleration, Time, Frequency, Mass = field("acceleration"), field("time"), field("frequency"), field("mass")
Inertia, Force, Torque, Stiffness = field("moment of inertia"), field("force"), field("torque"), field("stiffness")
RotationalStiffness, Damping, Pressure = field("rotational stiffness"), field("damping"), field("pressure")


def to_si(value: Any, dimension: str):
    """SI float of a text with a unit, for a dimension by name ("length", "angle" ...)."""
    return BY_NAME[dimension].parse(value)


def unit_factor(unit: str, dimension: str):
    """Factor from a unit text to SI, for a dimension by name; UnitError where they do not belong together."""
    return BY_NAME[dimension].factor(unit)


def display(si_unit):
    """(factor, unit) that turn an SI number of `si_unit` into the one people read: 'm' -> (1e3, 'mm')."""
    dimension = BY_UNIT.get(si_unit)
    if dimension is None:
        return 1.0, si_unit
    return 1 / _SHOWN_FACTOR.get(dimension.shown, 1.0), dimension.shown


# Typed apart from the registry so that drawing a figure does not import pint; a test holds the two together.
_SHOWN_FACTOR = {"mm": 1e-3, "deg": math.pi / 180, "rpm": math.pi / 30, "N/mm": 1e3, "MPa": 1e6, "mm^2": 1e-6, "1/mm": 1e3, "mm^3": 1e-9}
