"""What varies: a key of the spec with its levels or its distribution, in SI."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from drivewright._typing import Floats
from drivewright.errors import SpecError, brief
from drivewright.execution.keys import READABLE, KeyKind, key_kind
from drivewright.spec import MechanismSpec, Vary
from drivewright.spec.study_table import percentage
from drivewright.studies.nominal import nominal_value
from drivewright.studies.relations import Link, equal_link

Level: TypeAlias = float | int | bool | str
Distribution: TypeAlias = Any  # a frozen one of scipy.stats, or None
FAR = 3.0  # standard deviations: where an endless distribution is cut for corners, and what a tolerance is in a normal one


@dataclass(frozen=True)
class Variable:
    """A key with its kind, its nominal value (None where there is none) and either `levels` or a frozen `distribution` of scipy.stats."""

    key: str
    kind: KeyKind
    nominal: Level | None = None
    levels: NDArray[Any] | None = None
    distribution: Distribution = None
    links: tuple[Link, ...] = ()  # keys that follow it
    bounds: tuple[float, float] = (-np.inf, np.inf)  # that its distribution keeps, also after rounding
    readings: tuple[str, ...] = ()  # what is said of numbers whose unit is one of another kind

    @property
    def keys(self) -> tuple[str, ...]:
        """Its key and those that follow it."""
        return (self.key, *(link.key for link in self.links))

    @property
    def also(self) -> tuple[str, ...]:
        """Keys that follow it, with their relation where they have another value."""
        return tuple(map(str, self.links))

    def columns(self, column: NDArray[Any]) -> dict[str, NDArray[Any]]:
        """{key: values (n,)} of all its keys where its own has the values of a column (n,)."""
        return {self.key: column} | {link.key: link.at(column) for link in self.links}

    @property
    def grid_levels(self) -> NDArray[Any]:
        """The levels of a key of the grid."""
        if self.levels is None:
            raise ValueError(f"{self.key} is random: it has no levels")
        return self.levels

    @property
    def ends(self) -> tuple[float, float]:
        """Least and greatest value of the distribution, 3 sigma where it has no end."""
        mean, sigma, support = self.distribution.mean(), self.distribution.std(), self.distribution.support()
        low, high = (end if np.isfinite(end) else mean + side * FAR * sigma for end, side in zip(support, (-1, 1), strict=True))
        return float(np.clip(low, *self.bounds)), float(np.clip(high, *self.bounds))

    def at(self, u: Floats) -> Floats:
        """Its values (n,) at points u (n,) of the unit interval."""
        return np.clip(self.distribution.ppf(u), *self.bounds)


def variable(spec: MechanismSpec, vary: Vary, number: int) -> Variable:
    """The `Variable` of an entry of [[study.vary]]."""
    place = f"study.vary.{number}"
    kind, nominal = key_kind(spec, vary.key, f"{place}.key", vary.values), nominal_value(spec, vary.key)
    links = tuple(equal_link(spec, text, vary.key, kind, f"{place}.also.{n}", vary.values) for n, text in enumerate(vary.also))
    readings = tuple(readings_of(kind, vary.key, [*vary.values, *(getattr(vary, name) for name in NUMBERS)]))
    if vary.values or vary.steps is not None:
        refuse_beside(vary, "levels", ("values",) if vary.values else ("lower", "upper", "steps"), place)
        levels = _levels(kind, vary, nominal, place)
        for n, link in enumerate(links):
            link.check(levels, f"{place}.also.{n}")
        return Variable(vary.key, kind, nominal, levels, links=links, readings=readings)
    if not kind.numeric or kind.name == "integer":
        raise SpecError(
            f"{vary.key} takes {READABLE.get(kind.name)}, so it varies over values only; give values, or lower, upper and steps", place
        )
    nominal = nominal if isinstance(nominal, (int, float)) else None
    distribution, bounds = _distribution(kind, vary, nominal, place)
    _refuse_idle(vary, place)
    return Variable(vary.key, kind, nominal, distribution=distribution, links=links, bounds=bounds, readings=readings)


_Given: TypeAlias = Mapping[str, Any]  # numbers of a [[study.vary]] entry in SI, None where one is not given
VARY_KEYS = ("values", "lower", "upper", "steps", "distribution", "mean", "sigma", "mode", "tolerance")
NUMBERS = ("lower", "upper", "mean", "sigma", "mode", "tolerance")  # those that are one number
WIDTHS = ("sigma", "tolerance")  # those that are a difference, not a value of the key


def readings_of(kind: KeyKind, key: str, numbers: Iterable[Any]) -> Iterator[str]:
    """A remark for each of some numbers given for a key whose unit is one of another kind: "10 Hz" of an angular speed."""
    for number in dict.fromkeys(number for number in numbers if isinstance(number, str)):
        if reading := kind.reading(number):
            yield f"{key}: {brief(number)} is read as {reading}"


def refuse_beside(vary: Vary, what: str, wanted: Sequence[str], place: str) -> None:
    """SpecError for a key that says nothing beside those that are wanted."""
    for name in VARY_KEYS:
        if name not in wanted and getattr(vary, name) not in (None, ()):
            raise SpecError(
                f"has no meaning beside {', '.join(n for n in wanted if getattr(vary, n) not in (None, ()))} ({what}); leave it out",
                f"{place}.{name}",
            )


def _refuse_idle(vary: Vary, place: str) -> None:
    """SpecError for a key that the distribution does not use."""
    form = _form(vary)
    ends = ("tolerance",) if vary.tolerance is not None else ("lower", "upper")
    own = {"normal": ("mean", "sigma"), "triangular": ("mode",), "uniform": ()}[form]
    refuse_beside(vary, f"a {form} distribution", ("distribution", *own, *ends), place)


def _form(vary: Vary) -> str:
    """Name of the distribution, also where it is not given."""
    return vary.distribution or ("normal" if vary.sigma is not None or vary.tolerance is not None else "uniform")


def _levels(kind: KeyKind, vary: Vary, nominal: Any, place: str) -> NDArray[Any]:
    if vary.values:
        return column([kind.read(value, f"{place}.values.{n}") for n, value in enumerate(vary.values)], kind)
    low, high = (_bound(kind, vary, side, place, nominal, needed=True) for side in ("lower", "upper"))
    if not kind.numeric:
        raise SpecError(f"{vary.key} takes {READABLE[kind.name]} and has no range; give values", place)
    if vary.steps == 1 and low != high:
        raise SpecError("one step from lower to upper leaves one of them out; give 2 or more, or values", f"{place}.steps")
    steps = vary.steps or 1
    if vary.spacing == "logarithmic":
        if not low * high > 0:
            raise SpecError(f"logarithmic levels need bounds of one sign beside 0, got {brief(vary.lower)} and {brief(vary.upper)}", place)
        levels = np.geomspace(low, high, steps)
    else:
        levels = np.linspace(low, high, steps)
    if kind.name == "integer":
        levels = np.where(np.abs(levels - np.round(levels)) <= 1e-12 * np.abs(levels), np.round(levels), levels)  # equal ratios round
    if kind.name == "integer" and np.any(levels != np.round(levels)):
        raise SpecError(
            f"{vary.key} takes whole numbers, but {vary.steps} steps from {low} to {high} give "
            f"{', '.join(f'{x:g}' for x in levels[:4])} ...; choose steps = {abs(high - low) + 1}, or give values",
            place,
        )
    return levels.astype(np.int64) if kind.name == "integer" else levels


def column(levels: Sequence[Any], kind: KeyKind) -> NDArray[Any]:
    """An array of levels; texts stay objects, and quantities beside a word ("rigid", which is infinite) become texts."""
    if kind.dimension and any(isinstance(level, str) or not np.isfinite(level) for level in levels):
        return np.array([level if isinstance(level, str) else kind.dimension.text(level) for level in levels], dtype=object)
    return np.array(levels, dtype={"integer": np.int64, "flag": bool, "text": object}.get(kind.name, float))


def _bound(kind: KeyKind, vary: Vary, name: str, place: str, middle: Any = None, needed: bool = False) -> Any:
    """A number of the entry in SI, one in percent of or from the `middle`; None where it is not given."""
    value = getattr(vary, name)
    if value is None and needed:
        raise SpecError(f"a range of steps needs lower and upper; {name} is missing", f"{place}.{name}")
    if percentage(value):
        return _part_of(middle, vary, name, place)
    number = None if value is None else (kind.difference if name in WIDTHS else kind).read(value, f"{place}.{name}")
    if kind.name == "quantity" and number is not None and (isinstance(number, str) or not np.isfinite(number)):
        raise SpecError(f"wants a number with a unit here, got {brief(value)}; list a word among values", f"{place}.{name}")
    return number


def _part_of(middle: Any, vary: Vary, name: str, place: str) -> float:
    """A percentage in SI: as a width so much of the magnitude of the middle, as an end so much above or below it."""
    value = getattr(vary, name)
    sign, share = percentage(value) or ("", 0.0)
    if not isinstance(middle, (int, float)) or isinstance(middle, bool) or not 0 < abs(middle) < np.inf:
        state = "has no value in this spec" if middle is None else "is 0" if middle == 0 else f"is {brief(middle)}"
        raise SpecError(f"{vary.key} {state}, so {value} of it says nothing; give {name} as a number with its unit", f"{place}.{name}")
    if name in WIDTHS:
        return share * abs(middle)
    if not sign and share:
        raise SpecError(f'write "+{value}" or "-{value}": so much above or below the value in this spec', f"{place}.{name}")
    return middle + share * abs(middle)


def _distribution(kind: KeyKind, vary: Vary, nominal: float | None, place: str) -> tuple[Any, tuple[float, float]]:
    """(frozen distribution of scipy.stats, its bounds)."""
    given = {name: _bound(kind, vary, name, place) for name in ("mean", "mode")}
    middle = next((number for number in (*given.values(), nominal) if number is not None), None)
    given |= {name: _bound(kind, vary, name, place, middle) for name in ("lower", "upper", "sigma", "tolerance")}
    for name in WIDTHS:
        if given[name] is not None and not given[name] > 0:
            raise SpecError(f"must be greater than 0, got {brief(getattr(vary, name))}", f"{place}.{name}")
    if given["tolerance"] is not None:
        middle = _middle(given, nominal, vary.key, place)
        given |= {"lower": middle - given["tolerance"], "upper": middle + given["tolerance"]}
    if given["lower"] is not None and given["upper"] is not None and not given["lower"] < given["upper"]:
        raise SpecError(f"lower bound {vary.lower} is not below upper bound {vary.upper}", place)
    low, high = (end if given[name] is None else given[name] for name, end in (("lower", -np.inf), ("upper", np.inf)))
    return FORMS[_form(vary)](given, nominal, vary.key, place), (low, high)


def _middle(given: _Given, nominal: float | None, key: str, place: str) -> float:
    middle = given["mean"] if given["mean"] is not None else given["mode"] if given["mode"] is not None else nominal
    if middle is None:
        raise SpecError(
            f"{key} has no value in this spec to vary about; give mean, or lower and upper, or a value for it in the spec", place
        )
    return middle


def _normal(given: _Given, nominal: float | None, key: str, place: str) -> Any:
    from scipy import stats

    middle = _middle(given, nominal, key, place)
    if given["sigma"] is None and given["tolerance"] is None:
        raise SpecError("a normal distribution needs sigma or tolerance", f"{place}.sigma")
    sigma = given["sigma"] if given["sigma"] is not None else given["tolerance"] / FAR
    for side, beyond in (("lower", -1), ("upper", 1)):
        if given[side] is not None and beyond * (middle - given[side]) > 0:
            raise SpecError("the mean is beyond it; choose ends on both sides of the mean", f"{place}.{side}")
    low, high = ((end - middle) / sigma if end is not None else side * np.inf for end, side in ((given["lower"], -1), (given["upper"], 1)))
    if np.isinf(low) and np.isinf(high):
        return stats.norm(middle, sigma)
    return stats.truncnorm(low, high, middle, sigma)


def _ends(given: _Given, place: str) -> tuple[float, float]:
    if given["lower"] is None or given["upper"] is None:
        raise SpecError("needs lower and upper, or a tolerance", place)
    return given["lower"], given["upper"] - given["lower"]


def _uniform(given: _Given, nominal: float | None, key: str, place: str) -> Any:
    from scipy import stats

    return stats.uniform(*_ends(given, place))


def _triangular(given: _Given, nominal: float | None, key: str, place: str) -> Any:
    from scipy import stats

    low, width = _ends(given, place)
    mode = given["mode"] if given["mode"] is not None else nominal if nominal is not None else low + width / 2
    if not low <= mode <= low + width:
        raise SpecError("the peak of the triangle is not between its ends; give a mode there", f"{place}.mode")
    return stats.triang((mode - low) / width, low, width)


FORMS = {"normal": _normal, "uniform": _uniform, "triangular": _triangular}
