"""Units of input: text with a unit -> SI float, converted once.

A registry of our own, in which **angle is a base dimension**: `rev` and `rpm` exist, "8 1/s" is no angular speed, and
`N m` (torque) is not `N m/rad` (rotational stiffness).  The registry is built for the first unit that is not among the usual
ones of `unit_factors.toml`.

"8 Hz" of an angular speed has one usual reading, 8 rev/s, and so have the other units of `READ_AS`: they are taken, and
`Dimension.reading` says as what.

Factors are exact fractions and a quantity is rounded once, at the end: "1.27 cm", "12.7 mm" and "0.0127 m" are the same float.
"""

import math
import re
import tomllib
from dataclasses import dataclass
from decimal import Context, Decimal
from fractions import Fraction
from functools import cache, lru_cache
from numbers import Real
from pathlib import Path
from typing import Annotated, Any, ClassVar, Literal, NamedTuple, TypeAlias

from drivewright.errors import UnitError, brief, nearest

__all__ = [
    "BY_NAME",
    "BY_UNIT",
    "DIMENSIONS",
    "Acceleration",
    "Angle",
    "AngularAcceleration",
    "Damping",
    "Density",
    "Dimension",
    "Force",
    "Frequency",
    "Inertia",
    "KinematicViscosity",
    "Length",
    "LineForce",
    "Mass",
    "Power",
    "Pressure",
    "PressureViscosity",
    "RotationalDamping",
    "RotationalStiffness",
    "SI",
    "Scale",
    "Slowness",
    "Speed",
    "Stiffness",
    "System",
    "Temperature",
    "TemperatureDifference",
    "Time",
    "Torque",
    "Unbalance",
    "Velocity",
    "Viscosity",
    "WearCoefficient",
    "any_quantity",
    "display",
    "scale",
    "split",
    "to_si",
    "unit_factor",
]

# To 50 digits: as good as exact beside the 16 of a float.
PI = "3.14159265358979323846264338327950288419716939937511"

DEFINITIONS = f"""
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
kelvin = [temperature] = K = degC = degreeC = deltaK
rankine = 5 / 9 * kelvin = degR = degF = degreeF  # pint reads ° as "degree"
gram = 1e-3 * kilogram = g
tonne = 1e3 * kilogram = t
inch = 0.0254 * metre = in
mil = 0.001 * inch = thou
foot = 0.3048 * metre = ft
yard = 0.9144 * metre = yd
micron = 1e-6 * metre
pound = 0.45359237 * kilogram = lb = lbm
ounce = pound / 16 = oz
minute = 60 * second = min
hour = 3600 * second = h
day = 86400 * second = d
degree = {PI} / 180 * radian = deg = °
arcminute = degree / 60 = arcmin
arcsecond = degree / 3600 = arcsec
revolution = 360 * degree = rev = turn
rpm = revolution / minute
rps = revolution / second
hertz = 1 / second = Hz
newton = kilogram * metre / second ** 2 = N
kilogram_force = 9.80665 * newton = kgf
pound_force = 4.4482216152605 * newton = lbf
ounce_force = pound_force / 16 = ozf
kip = 1000 * pound_force
slug = pound_force * second ** 2 / foot
pascal = newton / metre ** 2 = Pa
bar = 1e5 * pascal
psi = pound_force / inch ** 2
ksi = 1000 * psi
poise = 0.1 * pascal * second = P
stokes = 1e-4 * metre ** 2 / second = St
joule = newton * metre = J
newton_metre = newton * metre = Nm
watt = joule / second = W
metric_horsepower = 735.49875 * watt = PS
horsepower = 550 * foot * pound_force / second = hp
litre = 1e-3 * metre ** 3 = l = L
"""

NUMBER = re.compile(r"\s*([+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]{1,9})?)\s*(.*?)\s*$", re.DOTALL)
WORD = "[A-Za-z\u00b5\u03bc\u00b0]+"  # letters, both micro signs, degree sign
PATTERN = r"^\s*[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?\s*([^\s0-9]|1\s*/).*$"  # the same for editors: a number and a unit
# What may reach pint's parser: units, one-digit powers of units, products, quotients, and 1 as in 1/min.
EXPRESSION = re.compile(rf"(?:{WORD}(?:\^[+-]?[0-9](?:\.[0-9])?)?|1(?![0-9.])|[\s*/()])+")
# {kind that is wanted: {unit of another kind: the unit that it is read as}}: usual in drawings, and of one reading there.
READ_AS = {
    "angular speed": dict.fromkeys(("Hz", "hertz"), "rev/s") | dict.fromkeys(("1/min", "/min", "min^-1", "min-1", "r/min"), "rev/min"),
    "torque": {"oz in": "ozf in", "in oz": "ozf in", "oz ft": "ozf ft", "ft oz": "ozf ft"},
}
FORCES = {"lb": "lbf", "lbm": "lbf", "oz": "ozf"}  # {unit of mass: the force of that name}
SMALLEST, LARGEST = 1e-40, 1e40  # magnitude in SI of what a key may say: no drive has more, and products of a few are still numbers
FACTORS = Path(__file__).parent / "unit_factors.toml"  # {text: [factor, {base: exponent}]}, written by scripts/unit_factors.py
# Units of temperature and where their scales begin [K]: their factors are those of a difference.
SCALES = {
    "K": Fraction(0),
    "degC": Fraction("273.15"),
    "°C": Fraction("273.15"),
    "degF": Fraction("459.67") * 5 / 9,
    "°F": Fraction("459.67") * 5 / 9,
}
System: TypeAlias = Literal["mm", "si", "inch"]  # what results are shown in
LONGEST = 100  # characters of a quantity: a limit on the work of the parser


class SI(float):
    """A float that is already in SI: the one bare number a quantity accepts, for code that has computed it."""


@cache
def _registry():
    import pint

    definitions: Any = DEFINITIONS.strip().splitlines()  # pint takes lines as well as a file, and any number type
    exact: Any = Fraction
    return pint.UnitRegistry(definitions, non_int_type=exact)


@cache
def _factors() -> dict[str, tuple[Fraction, frozenset[tuple[str, float]]]]:
    """What `parsed_unit` gives for the texts that people write most: pint takes a tenth of a second to import."""
    table = tomllib.loads(FACTORS.read_text(encoding="utf-8"))
    return {
        text: (Fraction(factor), frozenset((base, float(power)) for base, power in bases.items()))
        for text, (factor, bases) in table.items()
    }


@lru_cache(maxsize=4096)
def _unit(text: str) -> tuple[Fraction, frozenset[tuple[str, float]]]:
    return _factors().get(text) or _factors().get(_tidy(text)) or parsed_unit(text)


def _tidy(unit: str) -> str:
    """A unit in one spelling: "lbf-in", "lbf  in" and "lbf·in" are "lbf in", "m²" is "m^2"; a hyphen between letters is a product."""
    text = re.sub("(⁻?)([¹²³])", lambda power: f"^{'-' * len(power[1])}{'¹²³'.index(power[2]) + 1}", unit.strip().replace("**", "^"))
    return re.sub(r"\s*[\u00b7\u22c5*]\s*|(?<=[A-Za-z])-(?=[A-Za-z])|\s+", " ", text)


def parsed_unit(text: str) -> tuple[Fraction, frozenset[tuple[str, float]]]:
    """(exact factor to SI, dimensionality as a frozenset of (base, exponent)) of a unit text; UnitError where it is none."""
    expression = _tidy(text)
    if not EXPRESSION.fullmatch(expression):
        raise UnitError(f"{brief(text)} is no unit known here{_meant(text)}")
    # A blank between two units is a product; pint reads "N m" so, but not "N  m" or "mm s^2".
    expression = re.sub(rf"(?<=[\w)])\s+(?=[(]|{WORD})", "*", expression).replace("^", "**")
    try:
        quantity: Any = _registry().Quantity(Fraction(1), _registry().parse_units(expression)).to_base_units()
        return Fraction(quantity.magnitude), frozenset((k, float(v)) for k, v in quantity.dimensionality.items())
    except Exception:  # pint raises a dozen kinds, its parser whatever Python's tokeniser does on garbage
        raise UnitError(f"{brief(text)} is no unit known here{_meant(text)}") from None


def _meant(text):
    """Hint at the unit that a text may stand for: as it is often written elsewhere, else the nearest one."""
    if text.strip() in OTHERWISE:
        return f" (did you mean {OTHERWISE[text.strip()]!r}?)"
    words = [word for word in re.findall(WORD, text) if word not in _registry()]
    return nearest(words[0], UNITS_PEOPLE_WRITE) if words else ""


OTHERWISE = {  # as others write them
    "Nmm": "N mm",
    "Ncm": "N cm",
    "kNm": "kN m",
    "gmm": "g mm",
    "kgmm": "kg mm",
    "kgm2": "kg m^2",
    "kgm^2": "kg m^2",
    "kg m2": "kg m^2",
    "kgmm2": "kg mm^2",
    "N/mm2": "N/mm^2",
    "m/s2": "m/s^2",
    "mm2": "mm^2",
    "m2": "m^2",
    "mm3": "mm^3",
    "mm2/s": "mm^2/s",
    "kg/m3": "kg/m^3",
    "g/cm3": "g/cm^3",
    "Ns/m": "N s/m",
    "Nm/rad": "N m/rad",
    "U/min": "rpm",
    "1/min-1": "rpm",
    "lbfin": "lbf in",
    "lbfft": "lbf ft",
    "ftlb": "lbf ft",
}


UNITS_PEOPLE_WRITE = (
    "mm",
    "um",
    "cm",
    "m",
    "in",
    "deg",
    "rad",
    "rev",
    "rpm",
    "arcmin",
    "N",
    "kN",
    "MPa",
    "GPa",
    "Pa",
    "kg",
    "g",
    "ms",
    "s",
    "min",
    "h",
    "Hz",
    "J",
    "W",
    "kW",
    "Nm",
    "millimetre",
    "millimeter",
    "degree",
    "radian",
    "newton",
)


@dataclass(frozen=True)
class Dimension:
    """A kind of quantity: its SI unit, the unit people read, others they `also` use, the unit among inches and pounds where it is another.
    And the pydantic field type of that quantity.

    What a spec says is at most `largest`: infinite where ever larger values tend to a limit, as stiff springs do to a rigid one.
    """

    name: str
    unit: str
    display_unit: str
    also: tuple[str, ...] = ()
    inch: str = ""
    largest: float = LARGEST
    plain: ClassVar[bool] = False  # of a kind whose values are more than a float: what `parse` gives is final

    def parse(self, value: Any) -> Any:
        """SI float of a text such as "9.525 mm"; UnitError says what was wanted and what came."""
        if isinstance(value, SI) and math.isfinite(value):
            return float(value)
        if isinstance(value, bool) or not isinstance(value, (str, Real)):
            raise UnitError(f"wants {self.described}, got {brief(value)}")
        if not isinstance(value, str) and (value != value or abs(value) == math.inf):
            raise UnitError(f"{brief(value)} is not finite")
        if not isinstance(value, str):
            raise UnitError(f'unit missing: {self.described}, e.g. "{brief(value)} {self.display_unit}"')
        return _read(self, value)

    def factor(self, unit: str) -> float:
        """Factor from `unit` to SI, of a temperature that of a difference; UnitError where it belongs to another kind of quantity."""
        return float(self._exact(unit, unit))

    def count(self, number: float, unit: str) -> float:
        """How many of a `unit` an SI number is, a temperature on that unit's scale: 338.15 is 65 "degC"."""
        self._exact(unit, unit)
        return float(self._counted(Fraction(number), unit))

    def _exact(self, unit: str, whole: object) -> Fraction:
        self._refuse_other_scales(unit, whole)
        factor, dimensionality = _unit(unit)
        if dimensionality != _unit(self.unit)[1]:
            raise UnitError(f"wants {self.described}, got {brief(whole)}{_other_name(dimensionality)}{self._remedy(unit, dimensionality)}")
        return factor

    def _read_as(self, unit: str) -> str:
        return READ_AS.get(self.name, {}).get(_tidy(unit), unit)

    def reading(self, text: str) -> str:
        """What a text is read as where its unit is one of another kind, "25 rev/s" for "25 Hz"; "" where it says what it is."""
        number = NUMBER.match(text)
        unit = self._read_as(number[2]) if number else ""
        return f"{number[1]} {unit}" if number and unit != number[2] else ""

    def _exact_si(self, number: Fraction, unit: str, whole: object) -> Fraction:
        """SI number of so many of a unit; a temperature counts from where its scale begins."""
        exact = number * self._exact(self._read_as(unit), whole) + self._begin(unit)
        if self.name == "temperature" and exact < 0:
            raise UnitError(f"{brief(whole)} is below absolute zero, 0 K or -273.15 °C")
        return exact

    def _begin(self, unit: str) -> Fraction:
        """Where the scale of a temperature begins [K]."""
        return SCALES[unit] if self.name == "temperature" else Fraction(0)

    def _counted(self, exact: Fraction, unit: str) -> Fraction:
        """An SI number in a unit; what a scale's beginning leaves of a float's rounding is none of it."""
        begin = self._begin(unit)
        return round((exact - begin) / _unit(unit)[0], 10) if begin else exact / _unit(unit)[0]

    def _refuse_other_scales(self, unit, whole):
        """A temperature is read in the units of `SCALES` alone: "C" is none, and what "mK" or "degC" times something begins at is open."""
        if self.name == "temperature" and unit not in SCALES and (unit in ("C", "F") or _unit(unit)[1] == _unit(self.unit)[1]):
            raise UnitError(f"wants {self.described}, got {brief(whole)}{REMEDIES[self.name]}")

    def text(self, value: float) -> str:
        """A text that parses back to exactly `value`, in the unit people read or another that makes it shorter."""
        exact = Fraction(float(value))
        for digits, units in (
            (6, [self.display_unit]),
            (12, [self.display_unit, *self.also]),
            (15, [self.display_unit]),
            (16, [self.display_unit]),
        ):
            for unit in units:
                text = f"{decimal_text(self._counted(exact, unit), digits)} {unit}"
                if _reads_as(text, value, self):
                    return text
        last = self.unit if self._begin(self.display_unit) else self.display_unit  # 17 digits always do, but for the beginning of a scale
        return f"{decimal_text(exact / _unit(last)[0], 17)} {last}"

    def shown_unit(self, system: System) -> str:
        """The unit in which a system of units shows it."""
        si = self.unit.removeprefix("delta")
        return {"mm": self.display_unit, "si": si, "inch": self.inch or self.display_unit}[system]

    @property
    def described(self) -> str:
        """The name with its article: "a length", "an angle"."""
        return f"{'an' if self.name[0] in 'aeiou' else 'a'} {self.name}"

    def _remedy(self, unit, dimensionality):
        """How to get from the unit that was given to one that fits, where the mix-up is a classic."""
        masses = re.findall(rf"\b(?:{'|'.join(FORCES)})\b", unit)
        force = re.sub(rf"\b({'|'.join(FORCES)})\b", lambda mass: FORCES[mass[0]], _tidy(unit))
        if masses and _unit(force)[1] == _unit(self.unit)[1]:
            return f"; {masses[0]} is a mass: write {force}"
        mixups = {
            ("angular speed", "frequency"): "; a frequency counts events: write rev/s, rpm or rad/s",
            ("frequency", "angular speed"): "; write Hz or 1/s",
            ("rotational stiffness", "torque"): "; write N m/rad or N m/deg",
            ("torque", "rotational stiffness"): "; write N m",
        }
        return mixups.get((self.name, _name_of(dimensionality)), REMEDIES.get(self.name, ""))

    def __get_pydantic_core_schema__(self, source: Any, handler: Any) -> Any:
        from pydantic_core import core_schema

        def validate(value):
            try:
                parsed = self.parse(value)
            except UnitError as error:
                raise ValueError(error.message) from None
            return refuse_absurd(parsed, value, f" {self.unit}", largest=self.largest) if isinstance(parsed, float) else parsed

        if self.plain:
            return core_schema.no_info_plain_validator_function(validate)
        return core_schema.no_info_before_validator_function(validate, handler(source))

    def __get_pydantic_json_schema__(self, schema: Any, handler: Any) -> dict[str, Any]:
        # Limits are given in SI beside the unit; JSON schema itself cannot compare quantities.
        limits = {f"x-{name}": schema["schema"][name] for name in ("gt", "ge", "lt", "le") if name in schema.get("schema", {})}
        about = {"x-dimension": self.name, "x-unit": self.display_unit, "x-si-unit": self.unit}
        return {"type": "string", "pattern": PATTERN, "examples": [f"1 {self.display_unit}"], **about, **limits}


@lru_cache(maxsize=4096)
def _read(dimension: Dimension, text: str) -> float:
    """SI float of a text: the cases of a study say the same again and again."""
    number, unit = split(text)
    if not unit:
        raise UnitError(f'unit missing: {dimension.described}, e.g. "{text.strip()} {dimension.display_unit}"')
    return _rounded(dimension._exact_si(number, unit, text), text)


@lru_cache(maxsize=4096)
def has_two_readings(text: str) -> bool:
    """Whether some kind of quantity reads the unit of a text as another one."""
    number = NUMBER.match(text) if len(text) <= LONGEST else None
    return number is not None and any(_tidy(number[2]) in units for units in READ_AS.values())


def split(text: str) -> tuple[Fraction, str]:
    """(exact number, unit text) of "9.525 mm"; UnitError where there is no finite number in front."""
    match = NUMBER.match(text) if len(text) <= LONGEST else None
    if not match:
        reason = "is not finite" if re.match(r"\s*[+-]?(nan|inf)", text, re.IGNORECASE) else 'is not "number unit"'
        raise UnitError(f'{brief(text)} {reason}; write e.g. "9.5 mm"')
    if match[2].startswith(","):
        raise UnitError(f"{brief(text)} has a comma; write a decimal point and no thousands separator")
    number = Decimal(match[1])
    if abs(number.adjusted()) > 400:  # beyond any float in any unit; its fraction would not fit into the memory
        number = Decimal(0) if number.adjusted() < 0 or not number else Decimal("1e400")
    return Fraction(number), match[2]


def exact_factor(unit: str) -> Fraction:
    """Factor from a unit text to SI, without rounding."""
    return _unit(unit)[0]


def any_quantity(text: str) -> tuple[float, tuple[tuple[str, float], ...]]:
    """(SI float, dimensionality) of a quantity of any kind; UnitError where the text is none."""
    number, unit = split(text)
    factor, dimensionality = _unit(unit)
    return _rounded(number * factor + SCALES.get(unit, 0), text), tuple(sorted(dimensionality))


def _reads_as(text, value, dimension):
    try:
        return dimension.parse(text) == value
    except UnitError:  # rounded up beyond the largest float
        return False


def _rounded(exact, whole):
    """The float nearest to a fraction."""
    try:
        return float(exact)
    except OverflowError:
        raise UnitError(f"{brief(whole)} is not finite: beyond the largest number") from None


def decimal_text(exact: Fraction, digits: int) -> str:
    """A fraction to so many digits, without an exponent where that reads well."""
    number = Context(prec=digits).divide(Decimal(exact.numerator), Decimal(exact.denominator)).normalize()
    return f"{number:f}" if -5 <= number.adjusted() < 7 or not number else f"{number:e}"


DIMENSIONS = (
    Dimension("length", "m", "mm", ("um", "in"), inch="in"),
    Dimension("angle", "rad", "deg", ("arcmin", "arcsec", "rad")),
    Dimension("angular speed", "rad/s", "rpm", ("rad/s", "rev/h")),
    Dimension("angular acceleration", "rad/s^2", "rad/s^2"),
    Dimension("velocity", "m/s", "m/s", ("mm/min", "mm/s"), inch="in/s"),
    Dimension("acceleration", "m/s^2", "m/s^2", inch="in/s^2"),
    Dimension("time", "s", "s", ("min", "h")),
    Dimension("frequency", "Hz", "Hz"),
    Dimension("mass", "kg", "kg", inch="lb"),
    Dimension("moment of inertia", "kg m^2", "kg m^2", inch="lb in^2"),
    Dimension("force", "N", "N", inch="lbf"),
    Dimension("torque", "N m", "N m", inch="lbf in"),
    Dimension("stiffness", "N/m", "N/mm", inch="lbf/in", largest=math.inf),
    Dimension("rotational stiffness", "N m/rad", "N m/arcmin", ("N m/rad",), inch="lbf in/arcmin", largest=math.inf),
    Dimension("damping", "N s/m", "N s/m", inch="lbf s/in"),
    Dimension("pressure", "Pa", "MPa", inch="ksi"),
    Dimension("area", "m^2", "mm^2", inch="in^2"),
    Dimension("curvature", "1/m", "1/mm", inch="1/in"),
    Dimension("power", "W", "W", inch="hp"),
    Dimension("density", "kg/m^3", "kg/m^3", inch="lb/in^3"),
    Dimension("volume", "m^3", "mm^3", inch="in^3"),
    Dimension("rotational damping", "N m s/rad", "N m s/rad", inch="lbf in s/rad"),
    Dimension("viscosity", "Pa s", "Pa s", inch="lbf s/in^2"),
    Dimension("kinematic viscosity", "m^2/s", "mm^2/s", ("cSt",), inch="cSt"),
    Dimension("temperature", "K", "degC", ("K", "degF"), inch="degF"),
    Dimension("unbalance", "kg m", "g mm", ("kg mm", "oz in"), inch="oz in"),
    Dimension("wear coefficient", "m^2/N", "mm^3/(N m)", inch="in^3/(lbf in)"),
    Dimension("slowness", "s/m", "s/m", inch="s/in"),
    Dimension("flexibility", "m/N", "um/kN", inch="mil/kip"),
    Dimension("torsional compliance", "rad/(N m)", "arcmin/(kN m)", inch="arcmin/(kip in)"),
)
REMEDIES = {
    "rotational damping": "; write N m s/rad, a torque per angular speed",
    "viscosity": "; write Pa s, the dynamic viscosity",
    "kinematic viscosity": "; write mm^2/s or cSt",
    "temperature": '; write e.g. "70 degC", "343.15 K" or "158 degF"',
    "unbalance": "; write g mm, kg mm or oz in",
    "wear coefficient": "; write mm^3/(N m), volume per force and sliding distance",
    "slowness": "; write s/m",
}
BY_NAME = {dimension.name: dimension for dimension in DIMENSIONS}
# A result says "K" of a temperature, which is shown on a scale such as that of degC, and "deltaK" of a difference of two.
TEMPERATURE_DIFFERENCE = Dimension("temperature difference", "deltaK", "K", inch="degF")
BY_UNIT = {dimension.unit: dimension for dimension in (*DIMENSIONS, TEMPERATURE_DIFFERENCE)}


@cache
def _name_of(dimensionality):
    for dimension in DIMENSIONS:
        if _unit(dimension.unit)[1] == dimensionality:
            return dimension.name
    return ""


def _other_name(dimensionality):
    name = _name_of(dimensionality) if dimensionality else "a pure number"
    return f" ({name})" if name else ""


# The pydantic field types of quantities: a text with a unit comes in, an SI float is kept.
Length: TypeAlias = Annotated[float, BY_NAME["length"]]
Angle: TypeAlias = Annotated[float, BY_NAME["angle"]]
Speed: TypeAlias = Annotated[float, BY_NAME["angular speed"]]
Velocity: TypeAlias = Annotated[float, BY_NAME["velocity"]]
Acceleration: TypeAlias = Annotated[float, BY_NAME["acceleration"]]
AngularAcceleration: TypeAlias = Annotated[float, BY_NAME["angular acceleration"]]
Time: TypeAlias = Annotated[float, BY_NAME["time"]]
Frequency: TypeAlias = Annotated[float, BY_NAME["frequency"]]
Mass: TypeAlias = Annotated[float, BY_NAME["mass"]]
Inertia: TypeAlias = Annotated[float, BY_NAME["moment of inertia"]]
Force: TypeAlias = Annotated[float, BY_NAME["force"]]
Torque: TypeAlias = Annotated[float, BY_NAME["torque"]]
Stiffness: TypeAlias = Annotated[float, BY_NAME["stiffness"]]
RotationalStiffness: TypeAlias = Annotated[float, BY_NAME["rotational stiffness"]]
Damping: TypeAlias = Annotated[float, BY_NAME["damping"]]
Pressure: TypeAlias = Annotated[float, BY_NAME["pressure"]]
RotationalDamping: TypeAlias = Annotated[float, BY_NAME["rotational damping"]]
Viscosity: TypeAlias = Annotated[float, BY_NAME["viscosity"]]
KinematicViscosity: TypeAlias = Annotated[float, BY_NAME["kinematic viscosity"]]
Temperature: TypeAlias = Annotated[float, BY_NAME["temperature"]]
TemperatureDifference: TypeAlias = Annotated[float, TEMPERATURE_DIFFERENCE]
Unbalance: TypeAlias = Annotated[float, BY_NAME["unbalance"]]
WearCoefficient: TypeAlias = Annotated[float, BY_NAME["wear coefficient"]]
Power: TypeAlias = Annotated[float, BY_NAME["power"]]
Slowness: TypeAlias = Annotated[float, BY_NAME["slowness"]]
Density: TypeAlias = Annotated[float, BY_NAME["density"]]
PressureViscosity: TypeAlias = Annotated[float, Dimension("pressure-viscosity coefficient", "1/Pa", "1/GPa", inch="in^2/lbf")]
LineForce: TypeAlias = Annotated[float, Dimension("force per length", "N/m", "N/mm", inch="lbf/in")]  # of the same kind as a stiffness


def refuse_absurd(value: float, given: Any, unit: str = "", smallest: float = SMALLEST, largest: float = LARGEST) -> float:
    """The value of a key again, also infinity (a word says it); ValueError where it is beyond `largest`, or below `smallest` and not 0."""
    size = abs(value)
    if math.isfinite(value) and size > largest:
        raise ValueError(f"{brief(given)} has no meaning: it is larger than {largest:g}{unit}")
    if 0 < size < smallest:
        raise ValueError(f"{brief(given)} has no meaning: it is smaller than {smallest:g}{unit}, which is none at all: write 0")
    return value


def to_si(value: Any, dimension: str) -> float:
    """SI float of a text with a unit, for a dimension by name ("length", "angle" ...)."""
    return BY_NAME[dimension].parse(value)


def unit_factor(unit: str, dimension: str) -> float:
    """Factor from a unit text to SI, for a dimension by name; UnitError where they do not belong together."""
    return BY_NAME[dimension].factor(unit)


# -- showing -------------------------------------------------------------------------------------------------------------------

IN_INCH = {"m": "in", "kg": "lb", "N": "lbf", "Pa": "psi", "J": "lbf in", "W": "hp"}  # words of a unit that no `Dimension` has
LONG = {"s": (3600.0, 1 / 3600, "h"), "rev": (1e6, 1e-6, "million rev")}  # {SI unit: (from where on, factor, unit)}
SHORT = 1e-4  # m: below it a length is shown in micrometres


class Scale(NamedTuple):
    """How SI numbers of a unit are shown: in `unit`, `factor` times the number plus `zero`, which is not 0 of temperatures alone.

    Differences, such as a margin, are shown by the factor.
    """

    factor: float
    unit: str
    zero: float = 0.0

    def of(self, number: Any) -> Any:
        """A number, or an array, as shown."""
        return self.factor * number + self.zero if self.zero else self.factor * number


def scale(si_unit: str, wanted: str = "", system: System = "mm", size: float = 0.0) -> Scale:
    """The `Scale` of an SI unit in a system of units, for numbers of a size: times in hours and counts of revolutions ("rev") in millions
    where they are long, lengths in micrometres where they are short.  `wanted` may be "%" for a pure number."""
    long = LONG.get(si_unit)
    if long and not wanted and abs(size) >= long[0]:
        return Scale(long[1], long[2])
    if si_unit == "m" and not wanted and system == "mm" and 0 < abs(size) < SHORT:
        return Scale(1e6, "um")
    if si_unit == "-" and wanted == "%":
        return Scale(100.0, "%")
    factor, unit = display(si_unit, wanted, system)
    return Scale(factor, unit, -float(SCALES[unit] / _unit(unit)[0]) if si_unit == "K" else 0.0)


def display(si_unit: str, wanted: str = "", system: System = "mm") -> tuple[float, str]:
    """(factor, unit) that turn an SI number of `si_unit` into that of a system of units: 'm' -> (1e3, 'mm'); or into a `wanted` unit.

    What is wanted instead of the usual unit gives way to a system that has its own.
    """
    dimension = BY_UNIT.get(si_unit)
    if dimension is None:
        return _display_composite(si_unit, system)
    if wanted and (system == "mm" or (system == "inch" and dimension.shown_unit("inch") == dimension.display_unit)):
        return 1 / dimension.factor(wanted), wanted
    unit = dimension.shown_unit(system)
    return float(1 / _unit(unit)[0]), unit


def _display_composite(si_unit: str, system: System) -> tuple[float, str]:
    """The same of a unit that no `Dimension` has: in inches and pounds word by word."""
    if system == "mm" and si_unit.startswith("m/rad"):  # a lift's derivatives by an angle
        return 1e3, f"m{si_unit}"
    unit = re.sub("[A-Za-z]+", lambda word: IN_INCH.get(word[0], word[0]), si_unit) if system == "inch" else si_unit
    try:
        return (1.0, si_unit) if unit == si_unit else (float(_unit(si_unit)[0] / _unit(unit)[0]), unit)
    except UnitError:  # words that only look like units
        return 1.0, si_unit
