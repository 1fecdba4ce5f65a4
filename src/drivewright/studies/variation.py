"""Statement of what varies: from Python, and as on the command line."""

import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeAlias, TypeVar

import numpy as np

from drivewright.errors import SpecError, brief
from drivewright.spec import MechanismSpec, Study, Vary, dimension_at, document, read_value
from drivewright.spec.fields import field_at, type_of
from drivewright.studies.relations import relation

SpecT = TypeVar("SpecT", bound=MechanismSpec)
Bound: TypeAlias = str | float  # a quantity with its unit, or a number of a key that has none
Variation: TypeAlias = dict[str, Any]  # the keys of a [[study.vary]] table beside `key` and `also`
FORMS = {"normal": ("mean", "sigma", "lower", "upper"), "uniform": ("lower", "upper"), "triangular": ("lower", "mode", "upper")}
LEAST = {"normal": 2, "uniform": 2, "triangular": 3}
HOW = (
    "KEY=FROM:TO:STEPS (add :log for equal ratios), KEY=V1,V2,... , KEY=FROM:TO or KEY=uniform(FROM, TO), KEY=normal(MEAN, SIGMA), "
    "KEY=triangular(FROM, PEAK, TO), KEY=NUMBER * OTHER + QUANTITY, KEY=+-TOLERANCE"
)


def linspace(lower: Bound, upper: Bound, steps: int) -> Variation:
    """So many equal steps from `lower` to `upper`, both with their unit: levels of a key."""
    return {"lower": lower, "upper": upper, "steps": steps}


def geomspace(lower: Bound, upper: Bound, steps: int) -> Variation:
    """So many levels from `lower` to `upper` with equal ratios."""
    return {"lower": lower, "upper": upper, "steps": steps, "spacing": "logarithmic"}


def uniform(lower: Bound, upper: Bound) -> Variation:
    """Evenly distributed from `lower` to `upper`."""
    return {"distribution": "uniform", "lower": lower, "upper": upper}


def normal(mean: Bound, sigma: Bound, lower: Bound | None = None, upper: Bound | None = None) -> Variation:
    """Normally distributed, cut off at `lower` and `upper` where given."""
    ends = {"lower": lower, "upper": upper}
    return {"distribution": "normal", "mean": mean, "sigma": sigma} | {side: end for side, end in ends.items() if end is not None}


def triangular(lower: Bound, mode: Bound, upper: Bound) -> Variation:
    """Distributed in a triangle with its peak at `mode`."""
    return {"distribution": "triangular", "lower": lower, "mode": mode, "upper": upper}


def tolerance(half_width: Bound, distribution: str = "normal") -> Variation:
    """Within `half_width` of the spec's own value, or "5 %" of it; normal: three standard deviations."""
    return {"distribution": distribution, "tolerance": half_width}


def linked(formula: str) -> Variation:
    """Follows another key: "-2 * gears.pinion.torque", "0.5 * segments.0.length + 3 mm"."""
    return {"link": formula}


def with_variation(spec: SpecT, vary: Mapping[str, Any], **settings: Any) -> SpecT:
    """A spec whose [study] varies {key: what}: a list of levels, or what the functions above give; `settings` are further keys of it.

    "key + other" are keys that always have the same value, "key + -other" one that has the negative value.
    """
    entries = tuple(_entry(key, what if isinstance(what, dict) else {"values": _plain(what)}) for key, what in vary.items())
    kept = document(spec.study) if spec.study else {}
    if entries:
        kept = {name: value for name, value in kept.items() if name != "points"} | {"vary": [document(entry) for entry in entries]}
    return spec.model_copy(update={"study": Study(**(kept | settings))})


def _entry(keys: str, what: Mapping[str, Any]) -> Vary:
    key, *also = (part.strip() for part in keys.split("+"))
    return Vary(key=key, also=tuple(also), **what)


def with_options(spec: SpecT, texts: Iterable[str] = (), points: str | Path | None = None, **settings: Any) -> SpecT:
    """A spec whose [study] is that of the command line: `texts` as in `parse_variation`, a file of points, settings that are not
    None."""
    given = {name: value for name, value in settings.items() if value is not None}
    if points is not None:
        given["points"] = str(points)
    vary = {}
    for key, what in (_as_relation(spec, *_as_names(spec, *parse_variation(text))) for text in texts):
        if key in vary:
            raise SpecError(f"--vary {key} is given twice; give its levels in one list")
        vary[key] = what
    changed = with_variation(spec, vary, **given) if vary or given else spec
    entries = changed.study.vary if changed.study else ()
    for name, option in (("samples", "--sample"), ("method", "--method"), ("seed", "--seed")):
        if settings.get(name) is not None and not any(each.steps is None and not each.values and each.link is None for each in entries):
            raise SpecError(
                f"{option} {settings[name]}: nothing has a distribution to sample from; give --vary KEY=FROM:TO or "
                "KEY=normal(MEAN, SIGMA) or KEY=+-TOLERANCE"
            )
    return changed


def _as_names(spec: MechanismSpec, key: str, what: Any) -> tuple[str, Any]:
    """(key, what), levels of a key of text as text: 6204 is a designation, though it reads as a number."""
    field = field_at(type(spec), key.split(".")) if isinstance(what, list) and dimension_at(type(spec), key)[0] else None
    is_text = field is not None and type_of(field.annotation) is str
    return (key, [str(level) if type(level) is int else level for level in what]) if is_text else (key, what)


def _as_relation(spec: MechanismSpec, key: str, what: Any) -> tuple[str, Any]:
    """(key, what), one level that is the key of a spec read as what a key of numbers follows: "size = offset"."""
    model, level = type(spec), what[0] if isinstance(what, list) and len(what) == 1 else None
    is_key = isinstance(level, str) and dimension_at(model, level)[0]
    field = field_at(model, key.split(".")) if is_key else None
    is_number = field is not None and (dimension_at(model, key)[1] is not None or type_of(field.annotation) in (float, int))
    return (key, linked(level)) if isinstance(level, str) and is_number else (key, what)


def _plain(levels: Any) -> tuple[Any, ...]:
    """Levels as a tuple of what a spec file could say."""
    if isinstance(levels, (str, bytes)) or not hasattr(levels, "__iter__"):
        raise SpecError(f"wants a list of levels, or linspace, normal ..., got {brief(levels)}", "study.vary")
    return tuple(level.item() if isinstance(level, np.generic) else level for level in levels)


def parse_variation(text: str) -> tuple[str, Any]:
    """(key, what) of "key=from:to:steps" and the other ways of the command line."""
    key, equals, given = (part.strip() for part in text.partition("="))
    if not equals or not key or not given:
        raise SpecError(f"--vary takes {HOW}; got {brief(text)}")
    if _is_relation(given):
        return key, linked(given)
    if form := re.fullmatch(r"(\w+)\s*\((.*)\)", given):
        return key, _distribution(form[1], [_bound(part) for part in form[2].split(",")], text)
    if sign := re.fullmatch(r"(?:\+-|\+/-|±)\s*(.+)", given):
        return key, tolerance(_bound(sign[1]))
    parts = [part.strip() for part in given.split(":")]
    if len(parts) == 2:
        return key, uniform(*map(_bound, parts))
    if len(parts) in (3, 4):
        return key, _range(parts, text)
    if len(parts) > 1:
        raise SpecError(f"--vary takes {HOW}; got {brief(text)}")
    return key, [read_value(part) for part in given.split(",") if part.strip()]


def _is_relation(text: str) -> bool:
    """Whether a text names a key with a factor, a sign or an offset; a word alone is a level."""
    found = relation(text)
    return found is not None and text != found.source


def _range(parts: Sequence[str], text: str) -> Variation:
    if not parts[2].isdecimal() or not int(parts[2]):
        raise SpecError(f"--vary {text}: the number of steps must be a whole number from 1 up, got {brief(parts[2])}")
    if len(parts) == 4 and parts[3] != "log":
        raise SpecError(f"--vary {text}: behind the steps only :log can stand, got {brief(parts[3])}")
    return (geomspace if len(parts) == 4 else linspace)(_bound(parts[0]), _bound(parts[1]), int(parts[2]))


def _distribution(name: str, numbers: Sequence[Bound], text: str) -> Variation:
    if name not in FORMS:
        raise SpecError(f"--vary {text}: no distribution is called {name!r}; known: {', '.join(FORMS)}")
    if not LEAST[name] <= len(numbers) <= len(FORMS[name]):
        raise SpecError(f"--vary {text}: {name} takes ({', '.join(FORMS[name][: LEAST[name]])}), got {len(numbers)} numbers")
    return {"distribution": name, **dict(zip(FORMS[name], numbers, strict=False))}


def _bound(text: str) -> Bound:
    """A bound as TOML has it: a number, or a quantity as text."""
    return read_value(text.strip())
