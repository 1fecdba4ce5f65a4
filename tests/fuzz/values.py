"""What stands in place of a value: other types, units and magnitudes, odd texts."""

import datetime
import math
import re

QUANTITY = re.compile(r"\s*([-+]?[\d.]+(?:[eE][-+]?\d+)?)\s*(\D.*)", re.DOTALL)
UNITS = (
    "mm",
    "m",
    "um",
    "deg",
    "rad",
    "rpm",
    "rad/s",
    "Hz",
    "s",
    "kg",
    "N",
    "N m",
    "N/mm",
    "MPa",
    "kg m^2",
    "m^3",
    "",
    "furlong",
    "mm^-9",
    "/",
)
NUMBERS = (0, -1, 1, 2, 3.7, -0.0, 5e-324, 1e-300, 1e300, 1.7e308, 2**31, 2**63, 10**400, math.nan, math.inf, -math.inf)
TEXTS = (
    "",
    " ",
    "=1+1",
    "-",
    "\u202etxt.exe",  # right to left
    "\u2066a\u2069",
    "\ud800",  # one half of a surrogate pair
    "a\udc80b",
    "\x00",
    "a\nb",
    "\x1b[31mred",
    "\ufeff",
    "e\u0301" * 40,
    "\U0001f529",
    "\u0661\u0662 mm",  # digits that are not ASCII
    "１ mm",
    "<script>alert(1)</script>",
    "../../etc/passwd",
    "/dev/zero",
    "x" * 5000,
    "nan mm",
    "inf mm",
    "1e999999999 mm",
    "1,5 mm",
    "1 mm mm",
    "rigid",
    "0x10 mm",
)
OTHERS = (True, False, [], {}, [1], ["1 mm", "2 mm"], {"a": 1}, [[]], [[[[1]]]], datetime.date(2024, 1, 1), datetime.time(12, 0))


def other_value(value, rng):
    """Something else in place of a value: mostly of the same kind and near, else anything."""
    chance = rng.random()
    if isinstance(value, str) and QUANTITY.fullmatch(value) and chance < 0.95:
        return _other_quantity(value, rng)
    if isinstance(value, bool) and chance < 0.6:
        return not value
    if isinstance(value, (int, float)) and not isinstance(value, bool) and chance < 0.9:
        return _scaled_number(value, rng)
    if isinstance(value, list) and chance < 0.8:
        return _other_list(value, rng)
    return _one((*NUMBERS, *TEXTS, *OTHERS), rng)


def _one(choices, rng):
    return choices[int(rng.integers(len(choices)))]


def _factor(rng):
    """Mostly near one, else anywhere between 1e-300 and 1e300."""
    reach = (0.3, 1.0, 4.0, 40.0, 300.0)[int(rng.choice(5, p=(0.3, 0.25, 0.2, 0.1, 0.15)))]
    return float(rng.uniform(-reach, reach))


def _other_quantity(value, rng):
    number, unit = QUANTITY.fullmatch(value).groups()
    chance = rng.random()
    if chance < 0.8:
        size = abs(float(number)) or 1.0
        exponent = math.log10(size) + _factor(rng)
        sign = "-" if number.startswith("-") != (rng.random() < 0.05) else ""
        return f"{sign}{10 ** (exponent - math.floor(exponent)):.4g}e{math.floor(exponent)} {unit}"
    if chance < 0.86:
        return f"0 {unit}"
    if chance < 0.9:
        return f"-{number} {unit}"
    if chance < 0.94:
        return f"{number} {_one(UNITS, rng)}"
    return _one(
        (float(number), f"nan {unit}", f"inf {unit}", f"{number}{unit}{unit}", f"{number} {unit}^9", number, unit, f"{number}  {unit} "),
        rng,
    )


def _scaled_number(value, rng):
    if rng.random() < 0.15:
        return _one(NUMBERS, rng)
    try:
        scaled = (value or 1) * 10.0 ** _factor(rng) * (-1 if rng.random() < 0.1 else 1)
        return int(scaled) if isinstance(value, int) else scaled
    except OverflowError:
        return math.inf


def _other_list(value, rng):
    n = int(rng.integers(len(value))) if value else 0
    inner = [*value[:n], other_value(value[n], rng), *value[n + 1 :]] if value else [1]
    return _one(([], value[:-1], value[1:], value[::-1], value * 2, value * 300, [value], inner, inner, inner, inner), rng)
