"""What a new table or element of a list begins with: a sample, changed until it fits the design that it comes into."""

import re
from collections.abc import Collection, Iterable, Iterator
from copy import deepcopy
from fractions import Fraction
from itertools import permutations
from typing import Any

from drivewright import registry
from drivewright.errors import SpecError, UnitError
from drivewright.spec import set_key
from drivewright.spec.fields import field_at
from drivewright.spec.sample_values import required_keys_sample, sample_value, shared_table_samples
from drivewright.studio.design import Design, Tables
from drivewright.studio.field_info import FieldInfo, field_infos
from drivewright.studio.input_parsing import form_key, insert_parents, keys_overlap, spec_class, value_in
from drivewright.units import split

OFF = tuple(Fraction(part) for part in ("1.1", "0.9", "1.05", "0.95", "1.02", "0.98", "0.5"))  # of a quantity, for one beside it
TRIES = 300  # of names in a new table, until one fits


def sample_values_for(design: Design, info: FieldInfo, key: str) -> list[Any]:
    """Raw values that a new table or element could have: what is required, then with one more key that has an example."""
    if not info.table:
        example = info.example
        if isinstance(example, (list, dict)) and example:
            return [example[-1] if isinstance(example, list) else next(reversed(example.values()))]
        field = field_at(spec_class(design), key.split("."))
        sample = sample_value(field) if field else [None]
        return [sample[-1] if isinstance(sample, list) else next(iter(sample.values()))]
    shared = shared_table_samples(registry.mechanism(design.kind), design.tables).get(key, {})
    required = {name for name, each in field_infos(info.table).items() if each.required}
    least = {name: value for name, value in shared.items() if name in required or not required} or required_keys_sample(info.table)
    more = [{name: each.example} for name, each in field_infos(info.table).items() if each.example is not None and name not in least]
    return [least, *({**least, **one} for one in more)]


def first_valid_design(design: Design, place: str, samples: Iterable[Any], key: str) -> Design:
    """The first valid design with one of the samples at a key; else SpecError about the first sample."""
    first: SpecError | None = None
    for sample in samples:
        tables = deepcopy(design.tables)
        insert_parents(tables, spec_class(design), key.split("."))
        trial = design.with_tables(set_key(tables, key, deepcopy(sample)))
        try:
            return _with_valid_names(trial, place)
        except SpecError as error:
            first = first or error
    raise first or SpecError("has no sample to begin with", key)


# -- names of their own --------------------------------------------------------------------------------------------------------


def unused_name(name: Any, taken: Collection[Any]) -> str:
    """A name that is not taken: the same with the next free number behind it."""
    match = re.fullmatch(r"(.*?)_?(\d*)", name) if isinstance(name, str) else None
    stem, number = match.groups() if match else ("a", "")
    gap = "_" if isinstance(name, str) and re.search(r"_\d+$", name) else ""
    count = int(number or 1)
    while f"{stem}{gap}{count}" in taken or f"{stem}{gap}{count}" == name or count == 1:
        count += 1
    return f"{stem}{gap}{count}"


def with_unused_name(element: Any, others: Iterable[Any]) -> Any:
    """A copy of an element with a name of its own."""
    if not isinstance(element, dict) or "name" not in element:
        return deepcopy(element)
    return {**deepcopy(element), "name": unused_name(element["name"], {other.get("name") for other in others})}


# -- names that the design has -------------------------------------------------------------------------------------------------


def _with_valid_names(design: Design, place: str) -> Design:
    """The design itself where it is valid, else with texts in a new table that name what the design has; SpecError where none fits.

    A sample says `joint = "O2"`; here the joint is called something else.
    """
    try:
        design.spec()
        return design
    except SpecError as error:
        first, key, tries = error, error.key and form_key(design.tables, error.key), 0
        place = form_key(design.tables, place)
    if key and keys_overlap(place, key):
        for target, value in _replacements(design, key if len(key) >= len(place) else place):
            tries += 1
            trial = design.changed({target: value})
            try:
                trial.spec()
                return trial
            except SpecError:
                if tries >= TRIES:
                    break
    raise first.located(key=key)


def _replacements(design: Design, key: str) -> Iterator[tuple[str, Any]]:
    """(key, value) of what could stand instead of a text, or of a list of texts: names of the design, and points of what is named."""
    value, names = value_in(design.tables, key), _names(design.tables)
    if isinstance(value, str):
        yield from ((key, other) for other in _beside(value) or names)
    elif isinstance(value, list) and value and all(isinstance(each, str) for each in value):
        yield from ((key, list(choice)) for choice in permutations(names, len(value)))
    elif isinstance(value, dict):
        for name in value:
            yield from _replacements(design, f"{key}.{name}")


def _beside(text: str) -> list[str]:
    """Quantities a little off a given one, for a copy that must not stand where the first one does; none where the text is no quantity."""
    try:
        number, unit = split(text)
    except UnitError:
        return []
    return [f"{float(number * part):.6g} {unit}" for part in OFF] if number else [f"{part} {unit}" for part in (1, -1, 10)]


def _names(tables: Tables) -> list[str]:
    """What texts of a spec may refer to: names of elements, keys that the user chose, and points as NAME.POINT."""
    named = [
        each["name"]
        for elements in tables.values()
        if isinstance(elements, list)
        for each in elements
        if isinstance(each, dict) and isinstance(each.get("name"), str)
    ]
    holders = {name: table for name, table in tables.items() if isinstance(table, dict)}
    holders |= {name: table for outer in holders.values() for name, table in outer.items() if isinstance(table, dict)}
    points = [f"{name}.{point}" for name, table in holders.items() for held in table.values() if isinstance(held, dict) for point in held]
    return [*named, *holders, *points]
