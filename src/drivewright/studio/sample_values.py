"""What a new table or element of a list begins with: a sample, changed until it fits the design that it comes into."""

import re
from copy import deepcopy
from fractions import Fraction
from itertools import permutations

from drivewright import registry
from drivewright.errors import SpecError, UnitError
from drivewright.spec import set_key
from drivewright.spec.fields import field_at
from drivewright.spec.sample_values import required_keys_sample, sample_value, shared_table_samples
from drivewright.studio.entering import fill, form_key, model_of, overlap, value_in
from drivewright.studio.facts import facts
from drivewright.units import split

OFF = tuple(Fraction(part) for part in ("1.1", "0.9", "1.05", "0.95", "1.02", "0.98", "0.5"))  # of a quantity, for one beside it
TRIES = 300  # of names in a new table, until one fits


def samples_for(design, fact, key):
    """Raw values that a new table or element could have: what is required, then with one more key that has an example."""
    if not fact.table:
        example = fact.example
        if isinstance(example, (list, dict)) and example:
            return [example[-1] if isinstance(example, list) else next(reversed(example.values()))]
        sample = sample_value(field_at(model_of(design), key.split(".")))
        return [sample[-1] if isinstance(sample, list) else next(iter(sample.values()))]
    shared = shared_table_samples(registry.mechanism(design.kind), design.tables).get(key, {})
    required = {name for name, each in facts(fact.table).items() if each.required}
    least = {name: value for name, value in shared.items() if name in required or not required} or required_keys_sample(fact.table)
    more = [{name: each.example} for name, each in facts(fact.table).items() if each.example is not None and name not in least]
    return [least, *({**least, **one} for one in more)]


def first_fitting(design, place, samples, key):
    """The first valid design with one of the samples at a key; else SpecError about the first sample."""
    first = None
    for sample in samples:
        tables = deepcopy(design.tables)
        fill(tables, model_of(design), key.split("."))
        trial = design.with_tables(set_key(tables, key, deepcopy(sample)))
        try:
            return _mended(trial, place)
        except SpecError as error:
            first = first or error
    raise first


# -- names of their own --------------------------------------------------------------------------------------------------------


def fresh(name, taken):
    """A name that is not taken: the same with the next free number behind it."""
    stem, number = re.fullmatch(r"(.*?)_?(\d*)", name).groups() if isinstance(name, str) else ("a", "")
    gap = "_" if isinstance(name, str) and re.search(r"_\d+$", name) else ""
    found = int(number or 1)
    while f"{stem}{gap}{found}" in taken or f"{stem}{gap}{found}" == name or found == 1:
        found += 1
    return f"{stem}{gap}{found}"


def renamed(element, others):
    """A copy of an element with a name of its own."""
    if not isinstance(element, dict) or "name" not in element:
        return deepcopy(element)
    return {**deepcopy(element), "name": fresh(element["name"], {other.get("name") for other in others})}


# -- names that the design has -------------------------------------------------------------------------------------------------


def _mended(design, place):
    """The design itself where it is valid, else with texts in a new table that name what the design has; SpecError where none fits.

    A sample says `joint = "O2"`; here the joint is called something else.
    """
    try:
        design.spec()
        return design
    except SpecError as error:
        first, key, tries = error, error.key and form_key(design.tables, error.key), 0
        place = form_key(design.tables, place)
    if key and overlap(place, key):
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


def _replacements(design, key):
    """(key, value) of what could stand instead of a text, or of a list of texts: names of the design, and points of what is named."""
    value, names = value_in(design.tables, key), _names(design.tables)
    if isinstance(value, str):
        yield from ((key, other) for other in _beside(value) or names)
    elif isinstance(value, list) and value and all(isinstance(each, str) for each in value):
        yield from ((key, list(choice)) for choice in permutations(names, len(value)))
    elif isinstance(value, dict):
        for name in value:
            yield from _replacements(design, f"{key}.{name}")


def _beside(text):
    """Quantities a little off a given one, for a copy that must not stand where the first one does; none where the text is no quantity."""
    try:
        number, unit = split(text)
    except UnitError:
        return []
    return [f"{float(number * part):.6g} {unit}" for part in OFF] if number else [f"{part} {unit}" for part in (1, -1, 10)]


def _names(tables):
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
