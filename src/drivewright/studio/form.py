"""A design as the page's form: groups of fields, plain data, each field with its text, limits and slider."""

from collections.abc import Mapping
from functools import lru_cache
from typing import Any, TypeAlias

from drivewright import registry
from drivewright.errors import UnitError
from drivewright.studio.design import Design
from drivewright.studio.field_info import ABSENT, FieldInfo, display_text, field_infos
from drivewright.studio.input_parsing import element_step
from drivewright.studio.sliders import Limits, slider, typical
from drivewright.units import split

Form: TypeAlias = dict[str, Any]  # {"groups": [...]}, plain data
BESIDE_THE_FORM = ("mechanism", "format")  # keys of every spec that a form does not change


def form(design: Design, labels: Mapping[str, str] | None = None, old: Form | None = None) -> Form:
    """The form of a design: {"groups": [...]}, as plain data.

    `labels`: {dotted key with * for a name or number: label in another language}.  `old`: the form before, whose sliders keep their ranges.
    """
    maker = _Maker(labels or {}, values(old) if old else {})
    maker.table(registry.mechanism(design.kind).spec, design.tables, (), ())
    return {"groups": maker.groups}


def values(form: Form) -> dict[str, Any]:
    """Dotted key -> field of a form, parts of points and the like included."""
    return {each["key"]: each for group in form["groups"] for field in group["fields"] for each in (field, *field.get("parts", ()))}


def changed_fields(old: Form, new: Form) -> dict[str, Any] | None:
    """Dotted key -> field, of the fields that differ between two forms; None where more than fields does."""
    if len(old["groups"]) != len(new["groups"]):
        return None
    changed = {}
    for before, after in zip(old["groups"], new["groups"], strict=True):
        if any(before[name] != after[name] for name in after if name != "fields") or len(before["fields"]) != len(after["fields"]):
            return None
        for was, now in zip(before["fields"], after["fields"], strict=True):
            if was["key"] != now["key"]:
                return None
            if was is not now and was != now:
                changed[now["key"]] = now
    return changed


def group_hint(info: FieldInfo) -> str:
    """What a table means: as its key states it, else as its class does."""
    if info.hint in ("", info.name.replace("_", " ")) and info.table:
        return info.table.__doc__ or ""
    return info.hint


# -- groups --------------------------------------------------------------------------------------------------------------------


class _Maker:
    """Collects the groups of a form on a walk through the tables."""

    def __init__(self, labels, old):
        self.labels, self.old, self.groups = labels, old, []

    def table(self, model, given, path, pattern, **about):
        """The group of one table, then those inside it."""
        known = field_infos(model)
        values = [info for info in known.values() if not info.table and info.kind != "names"]
        fields = [
            self.field(info, given.get(info.name, ABSENT), (*path, info.name), (*pattern, info.name))
            for info in values
            if path or info.name not in BESIDE_THE_FORM
        ]
        self.group(path, pattern, fields, **{"role": "table", "hint": model.__doc__ or "", **about})
        for info in known.values():
            if info.table or info.kind == "names":
                self.inside(info, given.get(info.name, ABSENT), (*path, info.name), (*pattern, info.name))

    def inside(self, info, given, path, pattern):
        """The groups of a sub-table, of a list of them, or of those that the user names."""
        about = {"hint": group_hint(info), "optional": not info.required and not info.levels and info.default is None}
        value = info.initial_value if given is ABSENT else given
        if info.kind == "names":
            self.names(info, value or {}, path, pattern, about)
        elif info.kind == "list":
            self.group(path, pattern, [], role="list", **about)
            for number, element in enumerate(value or []):
                step = element_step(value, number)
                self.table(
                    info.table,
                    element,
                    (*path, step),
                    (*pattern, "*"),
                    role="element",
                    hint="",
                    list=".".join(path),
                    index=number,
                    optional=True,
                )
        elif value is None:
            self.group(path, pattern, [], role="table", present=False, **about)
        else:
            self.table(info.table, value, path, pattern, role="table", **about)

    def names(self, info, value, path, pattern, about):
        """A table whose keys the user chooses: of values, which are its fields, or of tables, which are groups."""
        entry = info.items[0] if info.items else None
        fields = [self.field(entry, one, (*path, name), (*pattern, "*"), optional=True) for name, one in value.items()] if entry else []
        self.group(path, pattern, fields, role="names", **about)
        for name, table in value.items() if info.table else ():
            self.table(info.table, table, (*path, name), (*pattern, "*"), role="element", hint="", list=".".join(path), optional=True)

    def group(self, path, pattern, fields, *, role, hint, optional=False, present=True, list=None, index=None):
        title = path[-1].replace("_", " ") if path else ""
        zh = "" if role == "element" else self.labels.get(".".join(pattern), "")
        self.groups.append(
            {
                "key": ".".join(path),
                "path": [*path],
                "depth": max(0, len(path) - 1),
                "title": title,
                "hint": " ".join(hint.split()),
                "zh": zh,
                "role": role,
                "optional": optional,
                "present": present,
                "list": list,
                "index": index,
                "fields": fields,
            }
        )

    def field(self, info, value, path, pattern, optional=None):
        """One field, with one for each part of a point and the like."""
        key, given, label = ".".join(path), value is not ABSENT, path[-1].replace("_", " ")
        zh, optional = self.labels.get(".".join(pattern), ""), not info.required if optional is None else optional
        value = value if given else info.default
        if info.kind != "list":
            return _kept(info, value, key, label, zh, given, optional, self.slid(key))
        field = _field(info, value, key, label, zh, given, optional)
        if info.fixed and len(info.levels) == 1:
            field["names"] = list(info.parts)
            entries = value if isinstance(value, list) and len(value) == len(info.items) else [None] * len(info.items)
            field["parts"] = [
                self.field(part, entry, (*path, str(n)), (*pattern, str(n)), optional=False)
                for n, (part, entry) in enumerate(zip(info.items, entries, strict=True))
            ]
        return field

    def slid(self, key):
        """(from, to, step, unit) of the slider that a field had."""
        old = self.old.get(key)
        return (*old["slider"], old["step"], old["unit"]) if old and old["slider"] else None


# -- fields --------------------------------------------------------------------------------------------------------------------


def _field(info, value, key, label, zh, given, optional, slid=None):
    """A field as plain data."""
    unit, number = _number(info, value)
    limits = _in_unit(info, unit)
    ends, step = _slider(info, number, unit, limits, slid) or (None, 1 if info.kind == "integer" else None)
    return {
        "key": key,
        "label": label,
        "zh": zh,
        "hint": info.hint,
        "kind": info.kind,
        "unit": unit,
        "value": number,
        "text": display_text(info, value),
        "given": given,
        "default": None if info.default is None else display_text(info, info.default),
        "optional": optional,
        "low": limits.low,
        "high": limits.high,
        "step": step,
        "slider": ends,
        "choices": list(info.choices),
        "suggestions": list(info.suggestions),
        "list": info.listed,
        "overrides": list(info.overrides),
    }


# Most fields of a form are those of the form before: these are the same objects, and are not changed.
_kept = lru_cache(maxsize=16384, typed=True)(_field)


def _slider(info, number, unit, limits, slid):
    """(ends, step) of the slider of a field, None where it has none."""
    if info.kind not in ("quantity", "number", "integer") or not isinstance(number, (int, float)):
        return None
    of, example = _number(info, info.example)
    around = typical(unit, example if of == unit and isinstance(example, (int, float)) else None)
    old = ([slid[0], slid[1]], slid[2]) if slid and slid[3] == unit else None
    return slider(number, limits, integer=info.kind == "integer", around=around, old=old)


def _number(info, value):
    """(unit, value) that a box shows: a quantity as its number; anything else as it is."""
    shown = info.dimension.display_unit if info.dimension else ""
    if value is None or value is ABSENT:
        return shown, None
    if info.kind in ("quantity", "any") and isinstance(value, str):
        try:
            number, unit = split(value)
        except UnitError:
            return shown, value
        return unit or shown, float(number)
    return shown, value


def _in_unit(info, unit):
    """Limits in the unit shown; none where that unit is of another kind than the limits."""
    if not info.dimension:
        return info.limits
    try:
        low, high = (None if limit is None else float(f"{info.dimension.count(limit, unit):.12g}") for limit in info.limits[:2])
    except UnitError:
        return Limits()
    return Limits(low, high, *info.limits[2:])
