"""Numbers and units as people read them: '48.183°', '26.469 mm', '2.4670×10⁻⁶ m'."""

import math
import re
import textwrap

from drivewright.digits import EXACT, ROUGH, last_place, over_decades, to_place
from drivewright.labels import usual_unit
from drivewright.result import Value
from drivewright.units import BY_UNIT, Scale, System, display, scale

SUPERSCRIPT = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")
UNSPOKEN = {"J": "energy"}  # what results have and nobody writes into a spec
SIGNS = {"<=": "≤", ">=": "≥"}  # of the limit of a check
THIN, SOLID = "\u202f", "\u00a0"


def number(value: float, digits: int = EXACT) -> str:
    """`value` to `digits` significant digits: thin spaces from 10 000 on, powers of ten outside 0.001 ... 1e6."""
    value = float(value)
    if not math.isfinite(value):
        return "n/a" if math.isnan(value) else "∞" if value > 0 else "−∞"
    if value == 0:
        return "0"
    exponent = math.floor(math.log10(abs(float(f"{value:.{digits - 1}e}"))))
    if -3 <= exponent < 6:
        text = f"{value:,.{max(digits - 1 - exponent, 0)}f}"
        text = (text.rstrip("0").rstrip(".") if "." in text else text).replace(",", THIN if exponent >= 4 else "")
    else:
        text = _powered(f"{value / 10.0**exponent:.{digits - 1}f}".rstrip("0").rstrip("."), exponent)
    return _signed(text)


def _powered(mantissa: str, exponent: int) -> str:
    return f"{mantissa}×10{str(exponent).translate(SUPERSCRIPT)}"


def _signed(text: str) -> str:
    """With the minus sign of print."""
    return text.replace("-", "−", 1) if text.startswith("-") else text


def numbers(value: float, low: float | None, high: float | None, digits: int = EXACT) -> tuple[str, str, str]:
    """(value, low, high) as texts with the digits that the interval supports, all with the same power of ten but where it spans several.

    The bounds are "" where there are none, or where they say nothing beyond the printed digits: then the value stands as if exact.
    """
    place = last_place(value, low, high, digits)
    if place is None or low is None or high is None:
        return number(value, digits), "", ""
    if over_decades(low, high):
        return number(value, ROUGH), number(low, ROUGH), number(high, ROUGH)
    exponent = math.floor(math.log10(max(abs(value), abs(low), abs(high))))
    return _to_place(value, place, exponent), _to_place(low, place, exponent), _to_place(high, place, exponent)


def _to_place(value: float, place: int, exponent: int) -> str:
    """A number rounded to the power of ten `place`, in powers of ten where `exponent`, that of the largest beside it, asks for them."""
    if -3 <= exponent < 6:
        return _signed(_grouped(to_place(value, place)))
    text = to_place(value / 10.0**exponent, min(place - exponent, 0))
    return _signed(_powered(text, exponent)) if text.strip("-0.") else "0"


def _grouped(text: str) -> str:
    """Thin spaces between thousands from 10 000 on."""
    whole, point, rest = text.partition(".")
    return f"{int(whole):,}".replace(",", THIN) + point + rest if len(whole.lstrip("-")) > 4 else text


def unit_text(unit: str) -> str:
    """A unit as printed: 'm/s^2' -> 'm/s²', 'um/kN' -> 'µm/kN', 'N m' -> 'N·m', 'deg' -> '°', none for a pure number."""
    if unit in ("-", "", "1"):
        return ""
    raised = re.sub(r"\^(-?\d+)", lambda match: match[1].translate(SUPERSCRIPT), unit)
    return re.sub(r"\bum\b", "µm", re.sub(r"\bdeg(?=[CF]?\b)", "°", raised)).replace("million ", f"million{SOLID}").replace(" ", "·")


def display_unit(unit: str, system: System = "mm") -> tuple[float, str]:
    """(factor, printed unit) that turn an SI number into the one people read."""
    factor, text = display(unit, system=system)
    return factor, unit_text(text)


def shown_scale(unit: str, wanted: str = "", system: System = "mm", size: float = 0.0) -> Scale:
    """`units.scale` with its unit as printed: of a `wanted` unit, e.g. "arcmin", instead of the usual one, for a number of a `size`."""
    plain = scale(unit, wanted, system, size)
    return plain._replace(unit=unit_text(plain.unit))


def labelled_scale(label: str, unit: str, system: System = "mm", size: float = 0.0) -> Scale:
    """`shown_scale` in the unit in which people read a quantity of this label: a share in percent, a play in arcmin."""
    return shown_scale(unit, usual_unit(label, unit), system, size)


def with_unit(text: str, unit: str) -> str:
    """A number's text and its printed unit; a degree sign stands close, and infinity has no unit."""
    if text in ("n/a", "∞", "−∞"):
        return text
    return f"{text}{unit}" if unit.startswith("°") and unit not in ("°C", "°F") or not unit else f"{text}{SOLID}{unit}"


def quantity(value: float, unit: str, digits: int = EXACT, system: System = "mm", label: str = "") -> str:
    """An SI number in the unit people read, that of its `label` where one is given."""
    shown = labelled_scale(label, unit, system, value)
    return with_unit(number(shown.of(value), digits), shown.unit)


def uncertain(
    value: float, unit: str, low: float | None, high: float | None, digits: int = EXACT, system: System = "mm", label: str = ""
) -> str:
    """The same with its interval, '10.2 (8.1 to 12.4) mm'; as `quantity` where the interval says nothing."""
    shown = labelled_scale(label, unit, system, value)
    middle, *ends = numbers(shown.of(value), *ends_shown(low, high, shown), digits)
    return with_unit(f"{middle} ({ends[0]} to {ends[1]})" if ends[0] else middle, shown.unit)


def ends_shown(low: float | None, high: float | None, shown: Scale) -> tuple[float | None, float | None]:
    """Ends of an interval on a scale, None where there is none."""
    return None if low is None else shown.of(low), None if high is None else shown.of(high)


def interval_hint(value: Value) -> str:
    """How the interval of a `result.Value` was made, '95 %, ensemble'; "" where it has none."""
    made = value.made.replace(" %", f"{SOLID}%")
    return made if value.settled else ", ".join(filter(None, (made, "not settled")))


def sentence(text: str) -> str:
    """First letter large, the rest untouched; a dotted name at the start stays as it is."""
    return text if re.match(r"\w+[._]\w", text) else text[:1].upper() + text[1:]


def axis_label(meaning: str, unit: str, width: int = 60) -> str:
    """'Lift of the roller [mm]', wrapped; `unit` as printed."""
    return wrapped_label(sentence(meaning) + (f" [{unit}]" if unit else ""), width)


def wrapped_label(label: str, width: int) -> str:
    """A label on lines of a width, its unit in brackets never torn apart."""
    return textwrap.fill(re.sub(r"\[[^]]*\]$", lambda unit: unit[0].replace(" ", "\u00a0"), label), width)


def literal(text: object) -> str:
    """A text of the user's for matplotlib, which would take what stands between two dollar signs for a formula."""
    return str(text).replace("$", r"\$")


def wrapped(name: str, width: int = 32) -> str:
    """A long dotted name on several lines, broken behind dots, underscores, hyphens and blanks where it has some."""
    pieces = [piece[i : i + width] for piece in re.findall(r"[^._ -]*[._ -]|[^._ -]+", name) for i in range(0, len(piece), width)]
    lines = [""]
    for piece in pieces:
        if lines[-1] and len(lines[-1]) + len(piece.rstrip()) > width:
            lines.append("")
        lines[-1] += piece
    return "\n".join(line.rstrip() for line in lines)


def dimension(unit: str) -> str:
    """Name of what an SI unit measures: 'm' -> 'length'; 'value' where it has no name."""
    return BY_UNIT[unit].name if unit in BY_UNIT else UNSPOKEN.get(unit, "value")


def parts_of_label(label: str) -> tuple[str, str]:
    """(meaning, unit) of an axis label, so that it can be wrapped anew."""
    meaning, bracket, unit = label.partition(" [")
    return (meaning, unit.rstrip("]")) if bracket else (label, "")
