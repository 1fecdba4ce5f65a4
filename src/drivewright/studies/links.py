"""Keys of a study that follow other keys: entries of [[study.vary]] with a `link`, joined to what they follow."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from drivewright.errors import SpecError
from drivewright.execution.keys import KeyKind, key_kind
from drivewright.spec import MechanismSpec, Vary
from drivewright.spec.keys import key_by_name
from drivewright.studies.nominal import nominal_value
from drivewright.studies.relations import formula_link
from drivewright.studies.variables import Variable, column, refuse_beside
from drivewright.units import System

NEAR = 1e-9  # of a value: the same


class Linked(NamedTuple):
    """What varies: the columns of a file of points, the other variables, both with the keys that follow them."""

    listed: dict[Variable, NDArray[Any]]
    variables: list[Variable]


def with_links(spec: MechanismSpec, entries: Sequence[Vary], listed: dict[Variable, NDArray[Any]], variables: Iterable[Variable]) -> Linked:
    """`Linked` of a study's entries; what follows a key that does not vary follows its value in the spec, which becomes one level."""
    listed, variables = dict(listed), list(variables)
    for number, vary in enumerate(entries):
        if vary.link is None:
            continue
        place = f"study.vary.{number}"
        refuse_beside(vary, "a relation", ("link",), place)
        if vary.also:
            raise SpecError("has no meaning beside link (a relation); give each of these keys a link of its own", f"{place}.also")
        source, link = formula_link(spec, vary.key, vary.link, place)
        _refuse_chain(spec, vary.key, source, entries, f"{place}.link")
        followed = _followed(spec, source, [*listed, *variables])
        if followed is None:
            followed = _fixed(spec, source, f"{place}.link")
            variables.append(followed)
        joined = replace(followed, links=(*followed.links, link))
        cells = next((cells for each, cells in listed.items() if each is followed), followed.levels)
        if cells is not None:
            link.check(cells, f"{place}.link")
        listed = {joined if each is followed else each: cells for each, cells in listed.items()}
        variables = [joined if each is followed else each for each in variables]
    return Linked(listed, variables)


def _followed(spec: MechanismSpec, source: str, variables: Sequence[Variable]) -> Variable | None:
    """The variable of a key, however its list elements are written."""
    name = key_by_name(spec, source)
    return next((each for each in variables if key_by_name(spec, each.key) == name), None)


def _refuse_chain(spec: MechanismSpec, key: str, source: str, entries: Sequence[Vary], place: str) -> None:
    """SpecError where a key follows itself, or one that follows another."""
    name = key_by_name(spec, source)
    if name == key_by_name(spec, key):
        raise SpecError(f"{key} cannot follow itself; name another key", place)
    following = [vary.key for vary in entries if vary.link is not None]
    following += [text.removeprefix("-").strip() for vary in entries for text in vary.also]
    if name in [key_by_name(spec, each) for each in following]:
        raise SpecError(f"{source} follows another key itself; name that one here", place)


def _fixed(spec: MechanismSpec, key: str, place: str) -> Variable:
    """A key that has one level, its value in the spec."""
    kind, value = key_kind(spec, key, place), nominal_value(spec, key)
    if value is None or not np.isfinite(value):
        state = "has no value in this spec" if value is None else "has no finite value in this spec"
        raise SpecError(f"{key} does not vary and {state}, so nothing can follow it; give it a value there, or vary it", place)
    return Variable(key, kind, value, column([value], kind))


def contradictions(spec: MechanismSpec, variables: Iterable[Variable]) -> Iterator[str]:
    """A remark for each key whose value in the spec is not what it follows from."""
    for each in variables:
        own = nominal_value(spec, each.key)
        for link in each.links:
            there = nominal_value(spec, link.key)
            if own is None or there is None:
                continue
            wanted = link.at(np.array([own]))[0]
            if not _is_same(there, wanted):
                other = f"where {link.text} gives" if link.text else f"and {each.key} is"
                here, following = (_shown(link.kind, value, spec.units) for value in (there, wanted))
                yield (f"{link.key} is {here} in the spec, {other} {following}; in this study it follows {each.key}")


def _is_same(there: Any, wanted: Any) -> bool:
    if isinstance(there, str) or isinstance(wanted, str):
        return bool(there == wanted)
    return bool(there == wanted or abs(there - wanted) <= NEAR * max(abs(there), abs(wanted)) < np.inf)


def _shown(kind: KeyKind, value: Any, system: System) -> str:
    from drivewright.view.text import quantity

    return quantity(float(value), kind.unit, system=system) if kind.numeric and not isinstance(value, str) else str(value)
