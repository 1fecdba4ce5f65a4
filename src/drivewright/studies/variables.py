"""What varies: a key of the spec with its levels or its distribution, in SI."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from drivewright.errors import SpecError, UnitError, brief, nearest
from drivewright.spec import dimension_at, value_at
from drivewright.spec.fields import choices_of, field_at, levels, table_at, type_of
from drivewright.units import SI

FAR = 3.0  # standard deviations: where an endless distribution is cut for corners, and what a tolerance is in a normal one


@dataclass(frozen=True)
class Kind:
    """What a key takes: `name` quantity, number, integer, flag or text; the Dimension of a quantity, the choices where there are some."""

    name: str
    dimension: Any = None
    choices: tuple = ()

    @property
    def unit(self):
        """SI unit of its column; empty for text."""
        return self.dimension.unit if self.dimension else "-" if self.name in ("number", "integer") else ""

    @property
    def numeric(self):
        """Whether it has a distribution and a range."""
        return self.name in ("quantity", "number", "integer")

    def read(self, value, place):
        """A level in SI; SpecError at `place`."""
        if self.name == "quantity":
            try:
                return self.dimension.parse(value)
            except UnitError as error:
                raise error.located(place) from None
        wanted = {"number": (int, float), "integer": int, "flag": bool, "text": str}[self.name]
        if not isinstance(value, wanted) or (isinstance(value, bool) and self.name != "flag"):
            raise SpecError(f"wants {READABLE[self.name]}, got {brief(value)}", place)
        if self.name == "integer" and abs(value) > 2**53:
            raise SpecError(f"is too large a whole number: {brief(value)}", place)
        if self.choices and value not in self.choices:
            raise SpecError(f"must be one of {', '.join(map(str, self.choices))}, got {brief(value)}{nearest(value, self.choices)}", place)
        return float(value) if self.name == "number" else value

    def given(self, value):
        """An entry of its column as a spec takes it; a text stands for itself, also where a number may."""
        if isinstance(value, str):
            return str(value)
        return {"quantity": SI, "number": float, "integer": int, "flag": bool, "text": str}[self.name](value)


READABLE = {"number": "a number", "integer": "a whole number", "flag": "true or false", "text": "a text"}


@dataclass(frozen=True)
class Variable:
    """A key with its kind, its nominal value (None where there is none) and either `levels` or a frozen `distribution` of scipy.stats."""

    key: str
    kind: Kind
    nominal: Any = None
    levels: np.ndarray | None = None
    distribution: Any = None
    also: tuple = ()  # keys that have the same value
    bounds: tuple = (-np.inf, np.inf)  # that its distribution keeps, also after rounding

    @property
    def keys(self):
        """Every key that has its value."""
        return (self.key, *self.also)

    @property
    def ends(self):
        """Least and greatest value of the distribution, 3 sigma where it has no end."""
        mean, sigma, support = self.distribution.mean(), self.distribution.std(), self.distribution.support()
        ends = (end if np.isfinite(end) else mean + side * FAR * sigma for end, side in zip(support, (-1, 1), strict=True))
        return tuple(float(np.clip(end, *self.bounds)) for end in ends)

    def at(self, u):
        """Its values at points u of the unit interval."""
        return np.clip(self.distribution.ppf(u), *self.bounds)


def kind_of(spec, key, place="study.vary", said=()):
    """The `Kind` of a key; SpecError, with the nearest known name, where the spec has no such key.

    Of a key that takes a number or a word, what is `said` about it decides.
    """
    if key.split(".")[0] in FIXED:
        raise SpecError(f"{key} cannot vary: it says what the study is of", place)
    exists, dimension = dimension_at(type(spec), key)
    if not exists or _hole(spec, key):
        raise SpecError(f"this spec has no key {key!r}{_hole(spec, key) or _near(spec, key)}", place)
    annotation = field_at(type(spec), key.split(".")).annotation
    if depth := len(levels(annotation)) - _entered(spec, key):
        holder = key.rpartition(".")[0]
        if holder and value_at(spec, holder) is None and key.rpartition(".")[2].isdecimal():
            raise SpecError(f"{holder} has no value in this spec; give all of it there, then one of its elements can vary", place)
        raise SpecError(f"{key} holds {'several values' if depth == 1 else 'lists'}, not one; name an element, e.g. {key}.0", place)
    if dimension:
        return Kind("quantity", dimension)
    choices, plain = choices_of(annotation), type_of(annotation)
    if choices and (plain is None or (said and all(value in choices for value in said))):
        return Kind(KINDS[type(choices[0])], choices=tuple(choices))
    if plain not in KINDS:
        raise SpecError(f"{key} is a table or a file, not one value; name a key in it", place)
    return Kind(KINDS[plain])


def _entered(spec, key):
    """How many of the steps of a key stand for elements of the list or dictionary at its end."""
    steps = key.split(".")
    holders = [type(value_at(spec, ".".join(steps[:n]))) if n else None for n in range(len(steps))]
    count = 0
    for holder in reversed(holders):
        if holder is None or not issubclass(holder, (tuple, dict)):
            break
        count += 1
    return count


KINDS = {float: "number", int: "integer", bool: "flag", str: "text"}
FIXED = ("format", "mechanism", "study", "optimise")  # what a study is made of


def _hole(spec, key):
    """What a list or a `Named` table has instead of the element that a key names; empty where nothing is missing."""
    steps = key.split(".")
    for number in range(1, len(steps)):
        holder = value_at(spec, ".".join(steps[:number]))
        if isinstance(holder, (tuple, dict)) and value_at(spec, ".".join(steps[: number + 1])) is None:
            names = list(holder) if isinstance(holder, dict) else [getattr(entry, "name", None) or str(n) for n, entry in enumerate(holder)]
            return f": {'.'.join(steps[:number])} has {', '.join(names) or 'no elements'}{nearest(steps[number], names)}"
    return ""


def _near(spec, key):
    """The known keys of the table in which the last good step ends."""
    steps = key.split(".")
    for number in range(len(steps) - 1, -1, -1):
        table = table_at(type(spec), steps[:number])
        if table is not None:
            known = [".".join([*steps[:number], name]) for name in table.model_fields if number or name not in FIXED]
            return f"{nearest('.'.join(steps[: number + 1]), known)}; known there: {', '.join(known)}"
    return ""


def variable(spec, vary, number):
    """The `Variable` of an entry of [[study.vary]]."""
    place = f"study.vary.{number}"
    kind, nominal = kind_of(spec, vary.key, f"{place}.key", vary.values), value_at(spec, vary.key)
    for n, key in enumerate(vary.also):
        if kind_of(spec, key, f"{place}.also.{n}", vary.values) != kind:
            raise SpecError(f"{key} cannot have the same value as {vary.key}: they take different kinds of values", f"{place}.also.{n}")
    if vary.values or vary.steps is not None:
        _refuse_beside(vary, "levels", ("values",) if vary.values else ("lower", "upper", "steps"), place)
        return Variable(vary.key, kind, nominal, _levels(kind, vary, place), also=vary.also)
    if not kind.numeric or kind.name == "integer":
        raise SpecError(
            f"{vary.key} takes {READABLE.get(kind.name)}, so it varies over values only; give values, or lower, upper and steps", place
        )
    nominal = nominal if isinstance(nominal, (int, float)) else None
    distribution, bounds = _distribution(kind, vary, nominal, place)
    _refuse_idle(vary, place)
    return Variable(vary.key, kind, nominal, distribution=distribution, also=vary.also, bounds=bounds)


SAID = ("values", "lower", "upper", "steps", "distribution", "mean", "sigma", "mode", "tolerance")


def _refuse_beside(vary, what, wanted, place):
    """SpecError for a key that says nothing beside those that are wanted."""
    for name in SAID:
        if name not in wanted and getattr(vary, name) not in (None, ()):
            raise SpecError(
                f"has no meaning beside {', '.join(n for n in wanted if getattr(vary, n) not in (None, ()))} ({what}); leave it out",
                f"{place}.{name}",
            )


def _refuse_idle(vary, place):
    """SpecError for a key that the distribution does not use."""
    form = _form(vary)
    ends = ("tolerance",) if vary.tolerance is not None else ("lower", "upper")
    own = {"normal": ("mean", "sigma"), "triangular": ("mode",), "uniform": ()}[form]
    _refuse_beside(vary, f"a {form} distribution", ("distribution", *own, *ends), place)


def _form(vary):
    """Name of the distribution, also where it is not given."""
    return vary.distribution or ("normal" if vary.sigma is not None or vary.tolerance is not None else "uniform")


def _levels(kind, vary, place):
    if vary.values:
        return column([kind.read(value, f"{place}.values.{n}") for n, value in enumerate(vary.values)], kind)
    low, high = (_bound(kind, vary, side, place, needed=True) for side in ("lower", "upper"))
    if not kind.numeric:
        raise SpecError(f"{vary.key} takes {READABLE[kind.name]} and has no range; give values", place)
    if vary.steps == 1 and low != high:
        raise SpecError("one step from lower to upper leaves one of them out; give 2 or more, or values", f"{place}.steps")
    if vary.spacing == "logarithmic":
        if not low * high > 0:
            raise SpecError(f"logarithmic levels need bounds of one sign beside 0, got {brief(vary.lower)} and {brief(vary.upper)}", place)
        found = np.geomspace(low, high, vary.steps)
    else:
        found = np.linspace(low, high, vary.steps)
    if kind.name == "integer":
        found = np.where(np.abs(found - np.round(found)) <= 1e-12 * np.abs(found), np.round(found), found)  # equal ratios round
    if kind.name == "integer" and np.any(found != np.round(found)):
        raise SpecError(
            f"{vary.key} takes whole numbers, but {vary.steps} steps from {low} to {high} give "
            f"{', '.join(f'{x:g}' for x in found[:4])} ...; choose steps = {abs(high - low) + 1}, or give values",
            place,
        )
    return found.astype(np.int64) if kind.name == "integer" else found


def column(levels, kind):
    """An array of levels; texts stay objects, and quantities beside a word ("rigid", which is infinite) become texts."""
    if kind.name == "quantity" and any(isinstance(level, str) or not np.isfinite(level) for level in levels):
        return np.array([level if isinstance(level, str) else kind.dimension.text(level) for level in levels], dtype=object)
    return np.array(levels, dtype={"integer": np.int64, "flag": bool, "text": object}.get(kind.name, float))


def _bound(kind, vary, name, place, needed=False):
    value = getattr(vary, name)
    if value is None and needed:
        raise SpecError(f"a range of steps needs lower and upper; {name} is missing", f"{place}.{name}")
    found = None if value is None else kind.read(value, f"{place}.{name}")
    if kind.name == "quantity" and found is not None and (isinstance(found, str) or not np.isfinite(found)):
        raise SpecError(f"wants a number with a unit here, got {brief(value)}; list a word among values", f"{place}.{name}")
    return found


def _distribution(kind, vary, nominal, place):
    """(frozen distribution of scipy.stats, its bounds)."""
    said = {name: _bound(kind, vary, name, place) for name in ("lower", "upper", "mean", "sigma", "mode", "tolerance")}
    for name in ("sigma", "tolerance"):
        if said[name] is not None and not said[name] > 0:
            raise SpecError(f"must be greater than 0, got {brief(getattr(vary, name))}", f"{place}.{name}")
    if said["tolerance"] is not None:
        middle = _middle(said, nominal, vary.key, place)
        said |= {"lower": middle - said["tolerance"], "upper": middle + said["tolerance"]}
    if said["lower"] is not None and said["upper"] is not None and not said["lower"] < said["upper"]:
        raise SpecError(f"lower bound {vary.lower} is not below upper bound {vary.upper}", place)
    bounds = tuple(end if said[name] is None else said[name] for name, end in (("lower", -np.inf), ("upper", np.inf)))
    return FORMS[_form(vary)](said, nominal, vary.key, place), bounds


def _middle(said, nominal, key, place):
    found = said["mean"] if said["mean"] is not None else said["mode"] if said["mode"] is not None else nominal
    if found is None:
        raise SpecError(f"{key} has no value in this spec to vary about; give mean, or lower and upper", place)
    return found


def _normal(said, nominal, key, place):
    from scipy import stats

    middle = _middle(said, nominal, key, place)
    if said["sigma"] is None and said["tolerance"] is None:
        raise SpecError("a normal distribution needs sigma or tolerance", f"{place}.sigma")
    sigma = said["sigma"] if said["sigma"] is not None else said["tolerance"] / FAR
    for side, beyond in (("lower", -1), ("upper", 1)):
        if said[side] is not None and beyond * (middle - said[side]) > 0:
            raise SpecError("the mean is beyond it; choose ends on both sides of the mean", f"{place}.{side}")
    low, high = ((end - middle) / sigma if end is not None else side * np.inf for end, side in ((said["lower"], -1), (said["upper"], 1)))
    if np.isinf(low) and np.isinf(high):
        return stats.norm(middle, sigma)
    return stats.truncnorm(low, high, middle, sigma)


def _ends(said, place):
    if said["lower"] is None or said["upper"] is None:
        raise SpecError("needs lower and upper, or a tolerance", place)
    return said["lower"], said["upper"] - said["lower"]


def _uniform(said, nominal, key, place):
    from scipy import stats

    return stats.uniform(*_ends(said, place))


def _triangular(said, nominal, key, place):
    from scipy import stats

    low, width = _ends(said, place)
    mode = said["mode"] if said["mode"] is not None else nominal if nominal is not None else low + width / 2
    if not low <= mode <= low + width:
        raise SpecError("the peak of the triangle is not between its ends; give a mode there", f"{place}.mode")
    return stats.triang((mode - low) / width, low, width)


FORMS = {"normal": _normal, "uniform": _uniform, "triangular": _triangular}
