"""The [optimise] table in numbers: unknowns, objectives and requirements.

A value of the result goes by its name, the margin of a design check by `check.NAME`: it is at least 0 exactly when the check passes.
A value with an interval meets a requirement only where the whole interval does: a search tries many designs and would otherwise choose
those that meet it by chance.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from drivewright import registry, runner, units
from drivewright._typing import Bools, Floats
from drivewright.errors import SpecError, UnknownName
from drivewright.execution.keys import READABLE, KeyKind, key_kind
from drivewright.execution.outputs import CHECK, OutputInfo, case_outputs
from drivewright.result import HIGH, LOW
from drivewright.spec import MechanismSpec, Optimise, document, from_document, set_key
from drivewright.spec.fields import field_at, type_of
from drivewright.studies.variables import readings_of

HOPELESS = 1e3  # violation of a design that has no solution at all, in units of the limits


@dataclass(frozen=True, eq=False)
class Problem:
    """Keys with their `KeyKind` and bounds (n, 2) SI, objectives (name, sign), limits (name, sense, limit) with the scale of each, what is
    known `about` every value that is looked at, {name: OutputInfo}, and the analyses that give them."""

    spec: MechanismSpec
    keys: tuple[str, ...]
    kinds: tuple[KeyKind, ...]
    bounds: Floats
    objectives: tuple[tuple[str, float], ...]
    limits: tuple[tuple[str, str, float], ...]
    scales: Floats
    about: dict[str, OutputInfo]
    analyses: tuple[str, ...]
    readings: tuple[str, ...] = ()  # what is said of bounds and limits whose unit is one of another kind

    @property
    def search(self) -> Optimise:
        """The [optimise] table."""
        assert self.spec.optimise is not None
        return self.spec.optimise

    @property
    def names(self) -> tuple[str, ...]:
        """Every value that is looked at."""
        return tuple(self.about)

    @cached_property
    def whole(self) -> Bools:
        """(n,) which unknowns are whole numbers."""
        return np.array([kind.name == "integer" for kind in self.kinds])

    @cached_property
    def space(self) -> Floats:
        """(n, 2) where the search moves: half a step further for whole numbers, so that each has an equal share."""
        return self.bounds + np.where(self.whole, 0.5, 0.0)[:, None] * np.array([-1.0, 1.0])

    def designs(self, points: Floats) -> Floats:
        """The designs (m, n) at points of the search: within the bounds, whole where a key takes whole numbers."""
        return np.clip(np.where(self.whole, np.rint(points), points), *self.bounds.T) + 0.0  # + 0.0: -0.0 is the same design as 0.0

    def objective_values(self, values: Mapping[str, Floats]) -> Floats:
        """(objectives, designs), to be made small; nan becomes large (and such a design violates, see below)."""
        rows = np.array([sign * values[name] for name, sign in self.objectives])
        return np.where(np.isfinite(rows), rows, HOPELESS)

    def violations(self, values: Mapping[str, Floats]) -> Floats:
        """(limits + 1, designs): how far beyond each limit the worse end of the interval is, over the limit's scale, and whether an
        objective is missing; 0 or less is met.

        A check that a computed design does not have is met: there is nothing to check, such as a cutter in a profile without a hollow.
        """
        rows = [
            (limit - at_worst(values, name, sense) if sense == ">=" else at_worst(values, name, sense) - limit) / scale
            for (name, sense, limit), scale in zip(self.limits, self.scales, strict=True)
        ]
        missing = ~np.all([np.isfinite(values[name]) for name, _ in self.objectives], axis=0)
        for row, (name, _, _) in zip(rows, self.limits, strict=True):
            if name.startswith(CHECK):
                row[np.isnan(values[name]) & ~missing] = 0.0
        rows.append(np.where(missing, HOPELESS, 0.0))
        return np.where(np.isfinite(rows), rows, HOPELESS)

    def total_violation(self, values: Mapping[str, Floats]) -> Floats:
        """(designs,): 0 exactly where every requirement is met."""
        return np.maximum(self.violations(values), 0.0).sum(axis=0)

    def design(self, x: Floats) -> MechanismSpec:
        """The spec with the unknowns at x (SI)."""
        data = document(self.spec)
        for key, kind, value in zip(self.keys, self.kinds, x, strict=True):
            set_key(data, key, kind.given(value))
        return from_document(data, type(self.spec))


def worse_end(name: str, sense: str) -> str:
    """The output that is the worse end of a value's interval for a requirement."""
    return f"{name}{LOW if sense == '>=' else HIGH}"


def at_worst(values: Mapping[str, Floats], name: str, sense: str) -> Floats:
    """The value (designs,) at the worse end of its interval; the value itself where it has none."""
    end = values.get(worse_end(name, sense), values[name])
    return np.where(np.isfinite(end), end, values[name])


def prepare(spec: MechanismSpec) -> Problem:
    """The `Problem` of a spec; each complaint names the key of the [optimise] table."""
    if spec.optimise is None:
        raise SpecError("is missing: choose the parameters to vary, an objective and the requirements (see `drivewright new`)", "optimise")
    search, base = spec.optimise, _with_settings(spec)
    givers, known, sizes = _known(base)
    kinds = [_kind(base, search.unknowns, number) for number in range(len(search.unknowns))]
    bounds = [_bounds(kind, search.unknowns[number], f"optimise.unknowns.{number}") for number, kind in enumerate(kinds)]
    objectives = tuple(
        (_named(known, each.value, f"optimise.objectives.{n}.value"), 1.0 if each.goal == "minimise" else -1.0)
        for n, each in enumerate(search.objectives)
    )
    limits = tuple(limit for n, each in enumerate(search.requirements) for limit in _limits(known, each, f"optimise.requirements.{n}"))
    ends = [end for name, sense, _ in limits if (end := worse_end(name, sense)) in known and known[end].bounds == name]
    names = dict.fromkeys([*(name for name, _ in objectives), *(name for name, _, _ in limits), *ends])
    return Problem(
        base,
        tuple(unknown.key for unknown in search.unknowns),
        tuple(kinds),
        np.array(bounds, float),
        objectives,
        limits,
        scales=np.array([abs(limit) or sizes[name] or 1.0 for name, _, limit in limits]),
        about={name: known[name].about for name in names},
        analyses=tuple(analysis for analysis in dict.fromkeys(givers.values()) if any(givers[name] == analysis for name in names)),
        readings=tuple(_readings(search, kinds, known)),
    )


def _readings(search, kinds, known):
    """A remark for each bound and limit whose unit is one of another kind: "10 Hz" of an angular speed."""
    for kind, unknown in zip(kinds, search.unknowns, strict=True):
        yield from readings_of(kind, unknown.key, (unknown.lower, unknown.upper))
    for each in search.requirements:
        kind = KeyKind("quantity", units.BY_UNIT.get(known[each.value].unit))
        yield from readings_of(kind, each.value, (each.at_least, each.at_most))


def _with_settings(spec):
    data = document(spec)
    for number, setting in enumerate(spec.optimise.settings):
        if type_of(getattr(field_at(type(spec), setting.key.split(".")), "annotation", None)) is Path:
            raise SpecError("is a data file, which a search cannot change; name it in its own table", f"optimise.settings.{number}.key")
        set_key(data, setting.key, setting.value)
    return from_document(data, type(spec))


def _known(spec):
    """({name: analysis}, {name: Output}, {name: size}) of all that the spec itself gives."""
    mechanism = registry.mechanism(spec.mechanism)
    answers = runner.run_analyses(spec, mechanism.build(spec), runner.select_analyses(mechanism.analyses))
    givers, known, sizes = {}, {}, {}
    for analysis, answer in answers.items():
        outputs = case_outputs(answer.values, answer.checks)
        known |= outputs
        givers |= dict.fromkeys(outputs, analysis)
        sizes |= {name: abs(value.value) for name, value in outputs.items()} | {f"{CHECK}{c.name}": abs(c.limit) for c in answer.checks}
    return givers, known, {name: size if np.isfinite(size) else 0.0 for name, size in sizes.items()}


def _kind(spec, unknowns, number):
    """The `KeyKind` of an unknown."""
    key, place = unknowns[number].key, f"optimise.unknowns.{number}.key"
    if key in (each.key for each in unknowns[:number]):
        raise SpecError(f"{key} occurs twice; give one range for it", place)
    kind = key_kind(spec, key, place)
    if not kind.numeric:
        raise SpecError(f"{key} takes {READABLE[kind.name]} and has no range; an unknown is a quantity, a number or a whole number", place)
    return kind


def _bounds(kind, unknown, place):
    low, high = (kind.read(getattr(unknown, side), f"{place}.{side}") for side in ("lower", "upper"))
    if not low < high:
        raise SpecError(f"lower bound {unknown.lower} is not below upper bound {unknown.upper}", place)
    return low, high


def _named(known, name, key):
    if name not in known:
        raise SpecError(str(UnknownName("value of the result", name, known)), key)
    return name


def _limits(known, requirement, place):
    """(name, sense, limit) of a requirement; a check with no limit given has to pass."""
    name = _named(known, requirement.value, f"{place}.value")
    dimension = units.BY_UNIT.get(known[name].unit)
    if requirement.at_least is None and requirement.at_most is None:
        if not name.startswith(CHECK):
            raise SpecError("needs at_least, at_most, or both", place)
        yield name, ">=", 0.0
    for side, sense in (("at_least", ">="), ("at_most", "<=")):
        if (limit := getattr(requirement, side)) is not None:
            yield name, sense, _in_si(limit, dimension, f"{place}.{side}")


def _in_si(value, dimension, key):
    if dimension is None:
        if isinstance(value, str):
            raise SpecError(f"is a pure number here, got {value!r}", key)
        return float(value)
    try:
        return dimension.parse(value)
    except SpecError as error:
        raise error.located(key) from None
