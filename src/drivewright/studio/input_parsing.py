"""Raw tables of a design: where a dotted key is in them, and what has to happen when one is entered or taken out."""

import re
from copy import deepcopy

from drivewright import registry
from drivewright.errors import SpecError
from drivewright.spec import set_key
from drivewright.spec.keys import remove_key
from drivewright.spec.serialisation import document
from drivewright.studio.facts import ABSENT, fact_at, facts, read, shown_text

# -- where a key is ------------------------------------------------------------------------------------------------------------


def step_of(elements, number):
    """How an element of a list of raw tables is addressed: by its name where that is unambiguous, else by its number."""
    names = [element.get("name") for element in elements if isinstance(element, dict)]
    name = elements[number].get("name") if isinstance(elements[number], dict) else None
    plain = isinstance(name, str) and re.fullmatch(r"\w[\w-]*", name) and not name.isdecimal()
    return name if plain and names.count(name) == 1 else str(number)


def form_key(tables, key):
    """A dotted key as the form writes it: elements by name where they have one; a key of an error message comes with numbers."""
    place, steps = tables, []
    for step in (part.strip('"') for part in key.split(".")):
        if isinstance(place, list) and step.isdecimal() and int(step) < len(place):
            step, place = step_of(place, int(step)), place[int(step)]
        elif isinstance(place, list):
            place = next((each for each in place if isinstance(each, dict) and each.get("name") == step), None)
        else:
            place = place.get(step) if isinstance(place, dict) else None
        steps.append(step)
    return ".".join(steps)


def value_in(tables, key):
    """The raw value at a dotted key, ABSENT where there is none."""
    place = tables
    for step in key.split("."):
        if isinstance(place, list):
            named = [each for each in place if isinstance(each, dict) and each.get("name") == step]
            place = named[-1] if named else place[int(step)] if step.isdecimal() and int(step) < len(place) else ABSENT
        else:
            place = place.get(step, ABSENT) if isinstance(place, dict) else ABSENT
    return place


def has_place(design, key):
    """Whether the tables and elements above a key are there."""
    steps = key.split(".")
    for above in (steps[:number] for number in range(1, len(steps))):
        fact = fact_at(model_of(design), above)
        if value_in(design.tables, ".".join(above)) is ABSENT and (fact is None or fact.begun is None):
            return False
    return True


def overlap(key, other):
    """Whether one of two keys is in the other, or the same."""
    return f"{key}.".startswith(f"{other}.") or f"{other}.".startswith(f"{key}.")


# -- in and out ----------------------------------------------------------------------------------------------------------------


def model_of(design):
    """The spec class of the kind of a design."""
    return registry.mechanism(design.kind).spec


def valid(design):
    """The spec of a design; SpecError naming the key as the form does."""
    try:
        return design.spec()
    except SpecError as error:
        raise error.located(key=form_key(design.tables, error.key) if error.key else None) from None


def enter(tables, model, key, text):
    """Set a key of raw tables from typed text, in place."""
    fact, before = fact_at(model, key.split(".")), value_in(tables, key)
    if fact is not None and before is not ABSENT and text == shown_text(fact, before):
        return
    shown = "" if fact is None else shown_text(fact, fact.default if before is ABSENT else before)
    fill(tables, model, key.split("."))
    set_key(tables, key, read(fact, text, shown) if fact else text)


def fill(place, model, steps):
    """What has to stand above a key before it can be set: the whole default of a point, a list or a table, in place."""
    step, *rest = steps
    fact = facts(model).get(step)
    if fact is None or not rest or not isinstance(place, dict):
        return
    if step not in place and (begun := fact.begun) is not None:
        place[step] = begun
    if fact.table and fact.levels:
        inner, rest = value_in(place, f"{step}.{rest[0]}"), rest[1:]
    else:
        inner = place.get(step)
    if fact.table and rest and isinstance(inner, dict):
        fill(inner, fact.table, rest)


def drop_empty(tables, model, steps):
    """Take out tables that say nothing any more and are the same when they are not there, in place."""
    fact = fact_at(model, steps) if steps else None
    if fact and fact.table and not fact.levels and fact.begun == {} and value_in(tables, key := ".".join(steps)) == {}:
        remove_key(tables, key)
        drop_empty(tables, model, steps[:-1])


# -- keys where they belong ----------------------------------------------------------------------------------------------------


def settled(design):
    """The design with keys that its spec reads elsewhere than where they belong (a before-validator may move them) put in their place."""
    spec, tables = valid(design), deepcopy(design.tables)
    if not _pruned(tables, type(spec)):
        return design
    _completed(tables, document(spec), type(spec))
    moved = design.with_tables(tables)
    return moved if moved.spec().digest() == spec.digest() else design


def _pruned(tables, model):
    """Whether there were keys that a table class does not know; they are taken out, in place."""
    known = facts(model)
    strange = [name for name in tables if name not in known]
    for name in strange:
        del tables[name]
    inner = [name for name, fact in known.items() if fact.table and not fact.levels and isinstance(tables.get(name), dict)]
    return any([bool(strange), *(_pruned(tables[name], known[name].table) for name in inner)])


def _completed(tables, effective, model):
    """Add the keys of the effective tables that differ from their defaults and are missing, in place."""
    for name, fact in facts(model).items():
        if fact.table and isinstance(tables.get(name), dict) and not fact.levels:
            _completed(tables[name], effective[name], fact.table)
        elif name not in tables and name in effective and effective[name] != fact.default:
            tables[name] = effective[name]
