"""The plan of a study: every case, known before the first one runs.

Levels are crossed with each other (the first key changes slowest); with each of their combinations come the points of the random
keys, the same ones every time, in blocks: a sample, corners, steps ...  A case is a row; its number is its name.
"""

import hashlib
import math
from dataclasses import dataclass
from functools import cached_property
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drivewright._typing import Ints
from drivewright.errors import SpecError
from drivewright.spec import MechanismSpec
from drivewright.spec.keys import key_by_name
from drivewright.studies.links import contradictions, with_links
from drivewright.studies.points import read_points
from drivewright.studies.random_points import Fixed, Independent, Mapped, Mixed, Points, Rows, Sobol, latin_hypercube, points_of
from drivewright.studies.relations import Link
from drivewright.studies.variables import Variable, readings_of, variable

LARGEST = 100_000_000  # cases
MOST_CORNERS = 16  # keys whose corners are all taken
FEW_CORNERS = 10  # keys up to which a tolerance study takes them


@dataclass(frozen=True)
class Block:
    """Rows `start` to `stop` of the points that come with every combination of levels: sample, nominal, steps, corners, a, b, mixed."""

    name: str
    start: int
    stop: int


@dataclass(frozen=True, eq=False)
class Plan:
    """All cases: a column per key, levels in `grid`, random keys in `random`, the `points` (n, d) of the latter and their blocks."""

    grid: tuple[Variable, ...]
    random: tuple[Variable, ...]
    points: Rows
    blocks: tuple[Block, ...]
    listed: dict[Variable, NDArray[Any]]  # columns of a file of points, by variable
    seed: int = 0
    remarks: tuple[str, ...] = ()

    @property
    def variables(self) -> tuple[Variable, ...]:
        """Everything that varies, in the order of its columns."""
        return (*self.listed, *self.grid, *self.random)

    @property
    def keys(self) -> tuple[str, ...]:
        """Their dotted keys, each with those that go with it."""
        return tuple(key for each in self.variables for key in each.keys)

    @property
    def relations(self) -> tuple[Link, ...]:
        """Keys that have another value than the one that they follow."""
        return tuple(link for each in self.variables for link in each.links if link.text)

    @property
    def shape(self) -> tuple[int, ...]:
        """How many levels each key of the grid has."""
        return tuple(len(variable.grid_levels) for variable in self.grid)

    @property
    def inner(self) -> int:
        """Cases that come with each combination of levels."""
        return len(next(iter(self.listed.values()))) if self.listed else len(self.points)

    @property
    def numeric(self) -> bool:
        """Whether every key that varies takes numbers."""
        return all(each.kind.numeric for each in self.variables)

    def __len__(self) -> int:
        return math.prod(self.shape) * self.inner

    def cases(self, first: int, stop: int) -> dict[str, NDArray[Any]]:
        """{key: values} of the cases from `first` up to `stop`, SI."""
        return self.at(np.arange(first, stop))

    def at(self, numbers: Ints) -> dict[str, NDArray[Any]]:
        """{key: values} of the cases of some numbers, SI."""
        outer, inner = np.divmod(numbers, self.inner)
        places = np.unravel_index(outer, self.shape) if self.grid else ()
        columns = [column[inner] for column in self.listed.values()]
        columns += [each.grid_levels[place] for each, place in zip(self.grid, places, strict=True)]
        columns += list(self.points[inner].T) if self.random else []
        pairs = zip(self.variables, columns, strict=True)
        return {key: values for each, column in pairs for key, values in each.columns(column).items()}

    def block(self, name: str) -> Block | None:
        """The `Block` of a name, or None."""
        return next((block for block in self.blocks if block.name == name), None)

    @property
    def digest(self) -> str:
        """SHA-256 of all cases: the same plan has the same points, also another day with other libraries."""
        return self._digest

    @cached_property
    def _digest(self) -> str:
        digest = hashlib.sha256(repr((self.keys, self.shape, self.blocks)).encode())
        digest.update("".join(repr((link.key, link.factor, link.offset)) for link in self.relations).encode())
        points = self.points.ends() if isinstance(self.points, Points) else [np.asarray(self.points)]
        for column in (*self.listed.values(), *(each.grid_levels for each in self.grid), *points):
            digest.update(repr(column.tolist()).encode() if column.dtype == object else np.ascontiguousarray(column).tobytes())
        return digest.hexdigest()


def make_plan(spec: MechanismSpec) -> Plan:
    """The `Plan` of a spec's [study]; SpecError where nothing varies, or something that cannot."""
    study = spec.study
    if study is None or not (study.vary or study.points):
        raise SpecError(
            "choose at least one parameter to vary: --vary KEY=FROM:TO:STEPS, KEY=V1,V2 or KEY=normal(MEAN, SIGMA), or a [study] table",
            "study.vary",
        )
    _refuse_many(study)
    own = [variable(spec, vary, number) for number, vary in enumerate(study.vary) if vary.link is None]
    listed, variables = with_links(spec, study.vary, read_points(spec, study.points) if study.points else {}, own)
    _refuse_twice(spec, [key for each in (*listed, *variables) for key in each.keys])
    random = tuple(each for each in variables if each.distribution is not None)
    grid = tuple(each for each in variables if each.levels is not None)
    if listed and random:
        raise SpecError("a file of points is not crossed with random keys; put their values into the file", "study.points")
    points, blocks, remarks = _points(study, random)
    remarks = (*remarks, *spec.readings.values(), *_readings((*listed, *variables)), *contradictions(spec, (*listed, *variables)))
    return Plan(grid, random, points, blocks, listed, study.seed, remarks)


def _readings(variables):
    """Notices about numbers with a unit of another kind, also in what follows another key."""
    for each in variables:
        yield from each.readings
        for link in each.links:
            yield from readings_of(link.kind, link.key, [link.offset_text])


def _refuse_many(study):
    """SpecError for more cases than can be held, before any of them is made."""
    entries = [vary for vary in study.vary if vary.link is None]
    levels = [vary.steps or len(vary.values) for vary in entries if vary.steps or vary.values]
    d = len(entries) - len(levels)
    rows = (
        {
            "corners": 2**d,
            "one-at-a-time": 1 + 2 * d,
            "sobol-indices": (d + 2) * study.samples,
            "tolerance": 1 + 2 * d + 2**FEW_CORNERS + study.samples,
        }.get(study.method, study.samples)
        if d
        else 1
    )
    count = math.prod(levels) * rows
    if count > LARGEST or rows * d > LARGEST:
        raise SpecError(f"{count:.3g} cases are more than {LARGEST:.0g}; take fewer levels or samples", "study.vary")


def _refuse_twice(spec, keys):
    names = [key_by_name(spec, key) for key in keys]
    for number, name in enumerate(names):
        if name in names[:number]:
            raise SpecError(f"{keys[number]} varies twice; give it once", "study.vary")


# -- points of the random keys -------------------------------------------------------------------------------------------------


def _points(study, random):
    """(points (n, d), blocks, remarks) of the random keys."""
    if not random:
        return np.zeros((1, 0)), (), ()
    parts = METHODS[study.method](study, random)
    ends = np.cumsum([0, *(len(part) for _, part in parts)]).tolist()
    blocks = tuple(Block(name, start, stop) for (name, _), start, stop in zip(parts, ends, ends[1:], strict=False))
    return points_of([part for _, part in parts], len(random)), blocks, tuple(_remarks(study))


def _remarks(study):
    if study.method in ("sobol", "sobol-indices") and study.samples & (study.samples - 1):
        near = 2 ** round(math.log2(study.samples))
        yield f"{study.samples} points of a Sobol sequence are less even than a power of two: {near} would be better spent"


def _latin(study, random):
    return [("sample", Mapped(latin_hypercube(study.samples, len(random), study.seed), random))]


def _sobol(study, random):
    return [("sample", Mapped(Sobol(study.samples, len(random), study.seed), random))]


def _independent(study, random):
    return [("sample", Mapped(Independent(study.samples, len(random), study.seed), random))]


def _corners(study, random):
    if len(random) > MOST_CORNERS:
        raise SpecError(
            f"{len(random)} keys have {2.0 ** len(random):.2g} corners; {MOST_CORNERS} keys at most, or take one-at-a-time", "study.method"
        )
    return [("corners", Fixed(np.array(list(product(*(each.ends for each in random))))))]


def _steps(study, random):
    """The means, then each key one standard deviation down and up: row 2 k is key k down, 2 k + 1 up."""
    means, sigmas = (np.array([getattr(each.distribution, what)() for each in random]) for what in ("mean", "std"))
    steps = np.repeat(means[None], 2 * len(random), axis=0)
    for k, sigma in enumerate(sigmas):
        steps[2 * k : 2 * k + 2, k] += [-sigma, sigma]
    return [("nominal", Fixed(means[None])), ("steps", Fixed(steps))]


def _tolerance(study, random):
    corners = _corners(study, random) if len(random) <= FEW_CORNERS else []
    return [*_steps(study, random), *corners, *_latin(study, random)]


def _saltelli(study, random):
    """A, B, and for each key k the points of A with the column k of B, one after another (Saltelli et al. 2010, recalled)."""
    cube = Sobol(study.samples, 2 * len(random), study.seed)
    a, b = Mapped(cube, random), Mapped(cube, random, len(random))
    return [("a", a), ("b", b), ("mixed", Mixed(a, b, len(random)))]


METHODS = {
    "latin-hypercube": _latin,
    "sobol": _sobol,
    "random": _independent,
    "corners": _corners,
    "one-at-a-time": _steps,
    "tolerance": _tolerance,
    "sobol-indices": _saltelli,
}
