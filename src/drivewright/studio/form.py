"""A design as the page's form: groups of fields, plain data, each field with its text, limits and slider."""

from functools import lru_cache

from drivewright import registry
from drivewright.errors import UnitError
from drivewright.studio.entering import step_of
from drivewright.studio.facts import ABSENT, facts, shown_text
from drivewright.studio.sliders import Limits, slider, typical
from drivewright.units import split

BESIDE_THE_FORM = ("mechanism", "format")  # keys of every spec that nobody changes in a form


def form(design, labels=None, old=None):
    """The form of a design: {"groups": [...]}, as plain data.

    `labels`: {dotted key with * for a name or number: label in another language}.  `old`: the form before, whose sliders keep their ranges.
    """
    maker = _Maker(labels or {}, values(old) if old else {})
    maker.table(registry.mechanism(design.kind).spec, design.tables, (), ())
    return {"groups": maker.groups}


def values(form):
    """Dotted key -> field of a form, parts of points and the like included."""
    return {each["key"]: each for group in form["groups"] for field in group["fields"] for each in (field, *field.get("parts", ()))}


def changed_fields(old, new):
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


# -- groups --------------------------------------------------------------------------------------------------------------------


class _Maker:
    """Collects the groups of a form on a walk through the tables."""

    def __init__(self, labels, old):
        self.labels, self.old, self.groups = labels, old, []

    def table(self, model, given, path, pattern, **about):
        """The group of one table, then those inside it."""
        known = facts(model)
        values = [fact for fact in known.values() if not fact.table and fact.kind != "names"]
        fields = [
            self.field(fact, given.get(fact.name, ABSENT), (*path, fact.name), (*pattern, fact.name))
            for fact in values
            if path or fact.name not in BESIDE_THE_FORM
        ]
        self.group(path, pattern, fields, **{"role": "table", "hint": model.__doc__ or "", **about})
        for fact in known.values():
            if fact.table or fact.kind == "names":
                self.inside(fact, given.get(fact.name, ABSENT), (*path, fact.name), (*pattern, fact.name))

    def inside(self, fact, given, path, pattern):
        """The groups of a sub-table, of a list of them, or of those that the user names."""
        said = fact.hint not in ("", fact.name.replace("_", " "))
        about = {
            "hint": fact.hint if said or not fact.table else fact.table.__doc__,
            "optional": not fact.required and not fact.levels and fact.default is None,
        }
        value = fact.begun if given is ABSENT else given
        if fact.kind == "names":
            self.names(fact, value or {}, path, pattern, about)
        elif fact.kind == "list":
            self.group(path, pattern, [], role="list", **about)
            for number, element in enumerate(value or []):
                step = step_of(value, number)
                self.table(
                    fact.table,
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
            self.table(fact.table, value, path, pattern, role="table", **about)

    def names(self, fact, value, path, pattern, about):
        """A table whose keys the user chooses: of values, which are its fields, or of tables, which are groups."""
        entry = fact.items[0] if fact.items else None
        fields = [self.field(entry, one, (*path, name), (*pattern, "*"), optional=True) for name, one in value.items()] if entry else []
        self.group(path, pattern, fields, role="names", **about)
        for name, table in value.items() if fact.table else ():
            self.table(fact.table, table, (*path, name), (*pattern, "*"), role="element", hint="", list=".".join(path), optional=True)

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

    def field(self, fact, value, path, pattern, optional=None):
        """One field, with one for each part of a point and the like."""
        key, given, label = ".".join(path), value is not ABSENT, path[-1].replace("_", " ")
        zh, optional = self.labels.get(".".join(pattern), ""), not fact.required if optional is None else optional
        value = value if given else fact.default
        if fact.kind != "list":
            return _kept(fact, value, key, label, zh, given, optional, self.slid(key))
        field = _field(fact, value, key, label, zh, given, optional)
        if fact.fixed and len(fact.levels) == 1:
            entries = value if isinstance(value, list) and len(value) == len(fact.items) else [None] * len(fact.items)
            field["parts"] = [
                self.field(part, entry, (*path, str(n)), (*pattern, str(n)), optional=False)
                for n, (part, entry) in enumerate(zip(fact.items, entries, strict=True))
            ]
        return field

    def slid(self, key):
        """(from, to, step, unit) of the slider that a field had."""
        old = self.old.get(key)
        return (*old["slider"], old["step"], old["unit"]) if old and old["slider"] else None


# -- fields --------------------------------------------------------------------------------------------------------------------


def _field(fact, value, key, label, zh, given, optional, slid=None):
    """A field as plain data."""
    unit, number = _number(fact, value)
    limits = _in_unit(fact, unit)
    ends, step = _slider(fact, number, unit, limits, slid) or (None, 1 if fact.kind == "integer" else None)
    return {
        "key": key,
        "label": label,
        "zh": zh,
        "hint": fact.hint,
        "kind": fact.kind,
        "unit": unit,
        "value": number,
        "text": shown_text(fact, value),
        "given": given,
        "default": None if fact.default is None else shown_text(fact, fact.default),
        "optional": optional,
        "low": limits.low,
        "high": limits.high,
        "step": step,
        "slider": ends,
        "choices": list(fact.choices),
    }


# Most fields of a form are those of the form before: these are the same objects, and nobody changes them.
_kept = lru_cache(maxsize=16384, typed=True)(_field)


def _slider(fact, number, unit, limits, slid):
    """(ends, step) of the slider of a field, None where it has none."""
    if fact.kind not in ("quantity", "number", "integer") or not isinstance(number, (int, float)):
        return None
    of, example = _number(fact, fact.example)
    around = typical(unit, example if of == unit and isinstance(example, (int, float)) else None)
    old = ([slid[0], slid[1]], slid[2]) if slid and slid[3] == unit else None
    return slider(number, limits, integer=fact.kind == "integer", around=around, old=old)


def _number(fact, value):
    """(unit, value) that a box shows: a quantity as its number; anything else as it is."""
    shown = fact.dimension.shown if fact.dimension else ""
    if value is None or value is ABSENT:
        return shown, None
    if fact.kind in ("quantity", "any") and isinstance(value, str):
        try:
            number, unit = split(value)
        except UnitError:
            return shown, value
        return unit or shown, float(number)
    return shown, value


def _in_unit(fact, unit):
    """Limits in the unit shown; none where that unit is of another kind than the limits."""
    if not fact.dimension:
        return fact.limits
    try:
        factor = fact.dimension.factor(unit)
    except UnitError:
        return Limits()
    low, high = (None if limit is None else float(f"{limit / factor:.12g}") for limit in fact.limits[:2])
    return Limits(low, high, *fact.limits[2:])
