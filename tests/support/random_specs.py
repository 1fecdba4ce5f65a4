"""Random legal specs of a kind: a preset or an example with some of its keys changed, within the limits that the schema itself states.

The same number gives the same spec.  What costs time in proportion to what is asked for is cut down to `COSTS` first.
"""

import math
import zlib
from typing import NamedTuple

import numpy as np
from places import EXAMPLES

from drivewright import registry
from drivewright.errors import UnitError
from drivewright.spec import document, load
from drivewright.studio.field_info import field_infos
from drivewright.units import split

MOST_CHANGES = 6
NEAR, FAR, EXTREME = 0.3, 2.0, 9.0  # powers of ten that a quantity is scaled by, at most
CHANCES = (0.7, 0.25, 0.05)  # of each
LEFT_ALONE = {"format", "mechanism", "title", "study", "optimise", "name", "seed"}
COSTS = {  # key: the most that is asked for
    "simulate.turns": 4.0,
    "simulate.max_steps": 20_000,
    "simulate.samples_per_turn": 2000,
    "lyapunov.turns": 32,
    "lyapunov.discard": 4,
    "tolerances.samples": 300,
    "bifurcation.steps": 3,
    "bifurcation.turns": 4,
    "wear.jumps": 2,
    "contact.turns": 2,
}


class Leaf(NamedTuple):
    """A key that can be changed: where it stands in the tables, what the schema says of it, its raw value (None: not said)."""

    path: tuple
    info: object
    value: object


def bases(kind):
    """The tables of every preset and example of a kind, paths of data files made absolute."""
    paths = [*registry.mechanism(kind).presets().values(), *sorted(EXAMPLES.glob("*.toml"))]
    specs = [load(path) for path in paths]
    return [document(spec) for spec in specs if spec.mechanism == kind]


def random_tables(kind, number, found=None):
    """(tables, {key: what it was changed to}) of random spec `number` of a kind; `found` are its `bases`, where they are known."""
    rng = np.random.default_rng([zlib.crc32(kind.encode()), number])
    known = found or bases(kind)
    tables = _copied(known[number % len(known)])
    model, changes = registry.mechanism(kind).spec, {}
    _cut(tables)
    for _ in range(rng.integers(1, MOST_CHANGES + 1)):
        leaves = list(_leaves(tables, model))
        said = [leaf for leaf in leaves if leaf.value is not None]
        leaf = _one(said if said and rng.random() < 0.8 else leaves, rng)
        if leaf.info.kind == "choice" and rng.random() < 0.6:  # another kind of thing mostly wants other keys as well
            continue
        value = _changed(leaf.info, leaf.value, rng)
        if value is not None:
            _put(tables, leaf.path, value)
            changes[".".join(map(str, leaf.path))] = value
    _cut(tables)
    _close(tables)
    return tables, changes


# -- walking the tables --------------------------------------------------------------------------------------------------------


def _copied(value):
    if isinstance(value, dict):
        return {key: _copied(inner) for key, inner in value.items()}
    return [_copied(inner) for inner in value] if isinstance(value, list) else value


def _leaves(tables, model, path=()):
    """Every `Leaf` of a table: its keys that hold one value or a list of them, also those that are not said."""
    for name, info in field_infos(model).items():
        if name in LEFT_ALONE or (not info.table and info.kind in ("text", "file", "any")):
            continue
        value = tables.get(name)
        if not info.table:
            yield Leaf((*path, name), info, value)
        elif isinstance(value, list):
            for n, entry in enumerate(value):
                yield from _leaves(entry, info.table, (*path, name, n))
        elif isinstance(value, dict) and info.kind == "names":
            for key, entry in value.items():
                yield from _leaves(entry, info.table, (*path, name, key)) if isinstance(entry, dict) else ()
        elif isinstance(value, dict):
            yield from _leaves(value, info.table, (*path, name))


def _one(leaves, rng):
    return leaves[int(rng.integers(len(leaves)))]


def _put(tables, path, value):
    for step in path[:-1]:
        tables = tables[step]
    tables[path[-1]] = value


def _cut(tables):
    """Nothing costs more than `COSTS`."""
    for key, most in COSTS.items():
        table, _, name = key.partition(".")
        if isinstance(tables.get(table), dict) and tables[table].get(name, 0) > most:
            tables[table][name] = most
    simulate = tables.get("simulate")
    if simulate and simulate.get("max_steps") is None:
        simulate["max_steps"] = COSTS["simulate.max_steps"]
    if simulate and simulate.get("method") == "radau":
        simulate["max_steps"] = min(simulate["max_steps"], COSTS["simulate.max_steps"] // 20)
    if simulate and simulate.get("turns") and simulate.get("discard", 0) >= simulate["turns"]:
        simulate["discard"] = 0


def _close(tables):
    """The segments of a programme make a whole turn again, each in its share, and its last rise takes back the others."""
    segments = [segment for segment in tables.get("programme", ()) if isinstance(segment, dict)]
    if len(segments) < 2:
        return
    angles = np.array([float(split(segment["angle"])[0]) for segment in segments])
    shares = np.round(360.0 * np.abs(angles) / np.sum(np.abs(angles)), 3)
    shares[-1] += 360.0 - np.sum(shares)
    for segment, share in zip(segments, shares, strict=True):
        segment["angle"] = f"{share:.3f} deg"
    rises = [segment for segment in segments if "rise" in segment and float(split(segment["rise"])[0])]
    if len(rises) > 1 and len(units := {split(segment["rise"])[1] for segment in rises}) == 1:
        heights = [round(float(split(segment["rise"])[0]), 9) for segment in rises[:-1]]
        for segment, height in zip(rises, [*heights, -sum(heights)], strict=True):
            segment["rise"] = f"{height:.9f} {min(units)}"


# -- changing a value ----------------------------------------------------------------------------------------------------------


def _changed(info, value, rng):
    """Another raw value of a key; None where there is nothing to begin with."""
    value = value if value is not None else info.example if info.example is not None else info.default
    if info.kind == "list":
        return _changed_list(info, value, rng)
    if info.kind == "choice":
        return _one(info.choices, rng)
    if info.kind == "flag":
        return not value
    if info.kind == "quantity":
        return _scaled_quantity(info, value, rng)
    if info.kind in ("number", "integer") and value is not None:
        return _within(info, value * _factor(rng), rng)
    return None


def _changed_list(info, value, rng):
    if not isinstance(value, list) or not value or not info.items:
        return None
    n = int(rng.integers(len(value)))
    inner = _changed(info.items[min(n, len(info.items) - 1)], value[n], rng)
    return None if inner is None else [*value[:n], inner, *value[n + 1 :]]


def _factor(rng):
    """What to scale by: mostly near 1, now and then by orders of magnitude."""
    reach = (NEAR, FAR, EXTREME)[int(rng.choice(3, p=CHANCES))]
    return 10.0 ** rng.uniform(-reach, reach)


def _scaled_quantity(info, value, rng):
    """A quantity as text, scaled; a zero takes the place of one unit now and then."""
    if not isinstance(value, str) or not value[:1].isdigit() and value[:1] not in "-.":  # "rigid" is no number
        return None
    number, unit = split(value)
    number = float(number) or float(rng.choice([0.0, 1.0, -1.0]))
    sign = -1.0 if rng.random() < 0.05 and not _has_floor(info) else 1.0
    text = f"{sign * number * _factor(rng):.6g} {unit}"
    if rng.random() < 0.03 and not info.limits.open_low and (info.limits.low in (None, 0)):
        return f"0 {unit}"
    low, high = info.limits.low, info.limits.high
    try:
        si = info.dimension.parse(text) if info.dimension else 0.0
    except UnitError:  # a dimension with a limit of its own
        return value
    return text if (low is None or si > low) and (high is None or si < high) else value


def _has_floor(info):
    return info.limits.low is not None and info.limits.low >= 0


def _within(info, number, rng):
    """A number inside its limits, now and then at one of them."""
    low, high, open_low, open_high = info.limits
    ends = [end for end, is_open in ((low, open_low), (high, open_high)) if end is not None and not is_open]
    if ends and rng.random() < 0.1:
        number = float(rng.choice(ends))
    number = number if low is None else max(number, math.nextafter(low, math.inf) if open_low else low)
    number = number if high is None else min(number, math.nextafter(high, -math.inf) if open_high else high)
    return int(round(number)) if info.kind == "integer" else float(number)
