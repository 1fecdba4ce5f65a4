"""Raw tables of a design: where a dotted key is in them, and what has to happen when one is entered or taken out."""

import re
from collections.abc import Sequence
from copy import deepcopy
from typing import Any

from drivewright import registry
from drivewright.errors import SpecError
from drivewright.spec import MechanismSpec, Spec, set_key
from drivewright.spec.keys import remove_key
from drivewright.spec.serialisation import document
from drivewright.studio.design import Design, Tables
from drivewright.studio.field_info import ABSENT, display_text, field_info_at, field_infos, parse_text

# -- where a key is ------------------------------------------------------------------------------------------------------------


def element_step(elements: Sequence[Any], number: int) -> str:
    """How an element of a list of raw tables is addressed: by its name where that is unambiguous, else by its number."""
    names = [element.get("name") for element in elements if isinstance(element, dict)]
    name = elements[number].get("name") if isinstance(elements[number], dict) else None
    plain = isinstance(name, str) and re.fullmatch(r"\w[\w-]*", name) and not name.isdecimal()
    return str(name) if plain and names.count(name) == 1 else str(number)


def form_key(tables: Tables, key: str) -> str:
    """A dotted key as the form writes it: elements by name where they have one; a key of an error message comes with numbers."""
    place: Any = tables
    steps = []
    for step in (part.strip('"') for part in key.split(".")):
        if isinstance(place, list) and step.isdecimal() and int(step) < len(place):
            step, place = element_step(place, int(step)), place[int(step)]
        elif isinstance(place, list):
            place = next((each for each in place if isinstance(each, dict) and each.get("name") == step), None)
        else:
            place = place.get(step) if isinstance(place, dict) else None
        steps.append(step)
    return ".".join(steps)


def value_in(tables: Any, key: str) -> Any:
    """The raw value at a dotted key, ABSENT where there is none."""
    place = tables
    for step in key.split("."):
        if isinstance(place, list):
            named = [each for each in place if isinstance(each, dict) and each.get("name") == step]
            place = named[-1] if named else place[int(step)] if step.isdecimal() and int(step) < len(place) else ABSENT
        else:
            place = place.get(step, ABSENT) if isinstance(place, dict) else ABSENT
    return place


def parent_exists(design: Design, key: str) -> bool:
    """Whether the tables and elements above a key are there."""
    steps = key.split(".")
    for above in (steps[:number] for number in range(1, len(steps))):
        info = field_info_at(spec_class(design), above)
        if value_in(design.tables, ".".join(above)) is ABSENT and (info is None or info.initial_value is None):
            return False
    return True


def keys_overlap(key: str, other: str) -> bool:
    """Whether one of two keys is in the other, or the same."""
    return f"{key}.".startswith(f"{other}.") or f"{other}.".startswith(f"{key}.")


# -- in and out ----------------------------------------------------------------------------------------------------------------


def spec_class(design: Design) -> type[MechanismSpec]:
    """The spec class of the kind of a design."""
    return registry.mechanism(design.kind).spec


def validated_spec(design: Design) -> MechanismSpec:
    """The spec of a design; SpecError naming the key as the form does."""
    try:
        return design.spec()
    except SpecError as error:
        raise error.located(key=form_key(design.tables, error.key) if error.key else None) from None


def enter_text(tables: Tables, model: type[Spec], key: str, text: str) -> None:
    """Set a key of raw tables from typed text, in place."""
    info, before = field_info_at(model, key.split(".")), value_in(tables, key)
    if info is not None and before is not ABSENT and text == display_text(info, before):
        return
    shown = "" if info is None else display_text(info, info.default if before is ABSENT else before)
    insert_parents(tables, model, key.split("."))
    set_key(tables, key, parse_text(info, text, shown) if info else text)


def with_part(design: Design, key: str, text: str) -> Tables:
    """The raw tables with another bought part; values beside it that stood in place of what the part before has of its own go with it."""
    tables, model = deepcopy(design.tables), spec_class(design)
    info, above = field_info_at(model, key.split(".")), key.rpartition(".")[0]
    enter_text(tables, model, key, text)
    for name in (info.overrides if info else ()) if text != value_in(design.tables, key) else ():
        if value_in(tables, beside := f"{above}.{name}".lstrip(".")) is not ABSENT:
            remove_key(tables, beside)
    return tables


def insert_parents(place: Any, model: type[Spec], steps: Sequence[str]) -> None:
    """What has to stand above a key before it can be set: the whole default of a point, a list or a table, in place."""
    step, *rest = steps
    info = field_infos(model).get(step)
    if info is None or not rest or not isinstance(place, dict):
        return
    if step not in place and (initial_value := info.initial_value) is not None:
        place[step] = initial_value
    if info.table and info.levels:
        inner, rest = value_in(place, f"{step}.{rest[0]}"), rest[1:]
    else:
        inner = place.get(step)
    if info.table and rest and isinstance(inner, dict):
        insert_parents(inner, info.table, rest)


def remove_empty_tables(tables: Tables, model: type[Spec], steps: Sequence[str]) -> None:
    """Take out tables that say nothing any more and are the same when they are not there, in place."""
    info = field_info_at(model, steps) if steps else None
    if info and info.table and not info.levels and info.initial_value == {} and value_in(tables, key := ".".join(steps)) == {}:
        remove_key(tables, key)
        remove_empty_tables(tables, model, steps[:-1])


# -- keys where they belong ----------------------------------------------------------------------------------------------------


def normalised(design: Design) -> Design:
    """The design with keys that its spec reads elsewhere than where they belong (a before-validator may move them) put in their place."""
    spec, tables = validated_spec(design), deepcopy(design.tables)
    if not _remove_unknown_keys(tables, type(spec)):
        return design
    _add_missing_keys(tables, document(spec), type(spec))
    moved = design.with_tables(tables)
    return moved if moved.spec().digest() == spec.digest() else design


def _remove_unknown_keys(tables: Tables, model: type[Spec]) -> bool:
    """Whether there were keys that a table class does not know; they are taken out, in place."""
    known = field_infos(model)
    strange = [name for name in tables if name not in known]
    for name in strange:
        del tables[name]
    inner = [name for name, info in known.items() if info.table and not info.levels and isinstance(tables.get(name), dict)]
    return any([bool(strange), *(_remove_unknown_keys(tables[name], table) for name in inner if (table := known[name].table))])


def _add_missing_keys(tables: Tables, effective: Tables, model: type[Spec]) -> None:
    """Add the keys of the effective tables that differ from their defaults and are missing, in place."""
    for name, info in field_infos(model).items():
        if info.table and isinstance(tables.get(name), dict) and not info.levels:
            _add_missing_keys(tables[name], effective[name], info.table)
        elif name not in tables and name in effective and effective[name] != info.default:
            tables[name] = effective[name]
