"""Points of the random keys of a plan: a small table of them as an array, a large one made where it is read, block by block.

Whichever way, the same row holds the same numbers.  A source gives its rows from `first` up to `stop`; nothing of it is kept.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import lru_cache
from typing import Protocol

import numpy as np

from drivewright._typing import Floats, Ints
from drivewright.errors import SpecError
from drivewright.studies.variables import Variable

HELD = 2_000_000  # numbers of a plan's points that are kept in memory; of more, blocks are made as they are read
BLOCK = 65_536  # rows of such a block
KEPT = 4  # blocks that are kept for the next reading
ROUNDS = 4  # of the mixing of a permutation


class Source(Protocol):
    """Rows of points (n, d)."""

    def __len__(self) -> int: ...

    def rows(self, first: int, stop: int) -> Floats:
        """The rows from `first` up to `stop`."""
        ...


class Rows(Protocol):
    """Points (n, d) by their rows: an array, or `Points`."""

    @property
    def shape(self) -> tuple[int, ...]:
        """(n, d)."""
        ...

    def __len__(self) -> int: ...

    def __getitem__(self, rows: slice | Ints, /) -> Floats: ...


def points_of(sources: Sequence[Source], dimensions: int) -> Rows:
    """The rows of several sources, one after another."""
    points = Points(sources, dimensions)
    return points[:] if len(points) * dimensions <= HELD else points


class Points:
    """Points that are made as they are read."""

    def __init__(self, sources: Sequence[Source], dimensions: int) -> None:
        self._sources, self._ends = tuple(sources), np.cumsum([len(source) for source in sources]).tolist()
        self.shape = (self._ends[-1], dimensions)
        self._block = lru_cache(KEPT)(lambda number: self._rows(number * BLOCK, min((number + 1) * BLOCK, len(self))))

    shape: tuple[int, int]

    def __len__(self) -> int:
        return self.shape[0]

    def __getitem__(self, rows: slice | Ints) -> Floats:
        """Rows of a slice, or of some numbers."""
        numbers = np.arange(len(self))[rows] if isinstance(rows, slice) else np.asarray(rows)
        chosen, blocks = np.empty((len(numbers), self.shape[1])), numbers // BLOCK
        for block in np.unique(blocks):
            inside = blocks == block
            chosen[inside] = self._block(int(block))[numbers[inside] - block * BLOCK]
        return chosen

    def _rows(self, first: int, stop: int) -> Floats:
        pieces, begin = [np.empty((0, self.shape[1]))], 0
        for source, end in zip(self._sources, self._ends, strict=True):
            if first < end and stop > begin:
                pieces.append(source.rows(max(first - begin, 0), min(stop, end) - begin))
            begin = end
        return np.concatenate(pieces)

    def ends(self) -> list[Floats]:
        """The first, the middle and the last block: what tells these points from others."""
        last = (len(self) - 1) // BLOCK
        return [self._block(number) for number in sorted({0, last // 2, last})]


class Fixed:
    """Points that are there."""

    def __init__(self, points: Floats) -> None:
        self._points = points

    def __len__(self) -> int:
        return len(self._points)

    def rows(self, first: int, stop: int) -> Floats:
        """The rows from `first` up to `stop`."""
        return self._points[first:stop]


class Mapped:
    """Points of the unit cube through the inverse distributions of some keys; of its columns those from `column` on."""

    def __init__(self, cube: Source, variables: Sequence[Variable], column: int = 0) -> None:
        self._cube, self._variables, self._column = cube, variables, column

    def __len__(self) -> int:
        return len(self._cube)

    def rows(self, first: int, stop: int) -> Floats:
        """The rows from `first` up to `stop`."""
        unit = self._cube.rows(first, stop)[:, self._column :]
        return np.stack([each.at(u) for each, u in zip(self._variables, unit.T, strict=False)], axis=1)


class Mixed:
    """For each key k the points of A with the column k of B, one key after another."""

    def __init__(self, a: Source, b: Source, dimensions: int) -> None:
        self._a, self._b, self._dimensions = a, b, dimensions

    def __len__(self) -> int:
        return self._dimensions * len(self._a)

    def rows(self, first: int, stop: int) -> Floats:
        """The rows from `first` up to `stop`."""
        n, pieces = len(self._a), []
        for k in range(first // n, -(-stop // n)):
            low, high = max(first - k * n, 0), min(stop - k * n, n)
            piece = self._a.rows(low, high).copy()
            piece[:, k] = self._b.rows(low, high)[:, k]
            pieces.append(piece)
        return np.concatenate(pieces)


# -- cubes ---------------------------------------------------------------------------------------------------------------------


class Independent:
    """Independent points: a case's point depends on seed and number alone, so that a longer sample continues a shorter one."""

    def __init__(self, count: int, dimensions: int, seed: int) -> None:
        self._count, self._dimensions, self._seed = count, dimensions, seed

    def __len__(self) -> int:
        return self._count

    def rows(self, first: int, stop: int) -> Floats:
        """The rows from `first` up to `stop`."""
        draws, philox = first * self._dimensions, np.random.Philox(self._seed)
        philox.advance(draws // 4)  # four numbers a step
        generator = np.random.Generator(philox)
        generator.random(draws % 4)
        return generator.random((stop - first, self._dimensions))


class Sobol:
    """Scrambled Sobol points, kept off the faces of the cube."""

    def __init__(self, count: int, dimensions: int, seed: int) -> None:
        from scipy.stats import qmc

        if dimensions > qmc.Sobol.MAXDIM:
            raise SpecError(f"{dimensions} dimensions are beyond a Sobol sequence; take latin-hypercube", "study.method")
        self._count, self._dimensions, self._seed = count, dimensions, seed

    def __len__(self) -> int:
        return self._count

    def rows(self, first: int, stop: int) -> Floats:
        """The rows from `first` up to `stop`; without the even number of a power of two they are less even, which a remark says."""
        import warnings

        from scipy.stats import qmc

        with warnings.catch_warnings():
            warnings.simplefilter("ignore", UserWarning)
            engine = qmc.Sobol(self._dimensions, rng=self._seed)
            if first:
                engine.fast_forward(first)
            cube = engine.random(stop - first)
        return np.clip(cube, 0.5**33, 1 - 0.5**33)


def latin_hypercube(count: int, dimensions: int, seed: int) -> Source:
    """One point in each of `count` strata of each key; by SciPy, or where that is too much for the memory by `LatinHypercube`."""
    from scipy.stats import qmc

    if count * dimensions > HELD:
        return LatinHypercube(count, dimensions, seed)
    return Fixed(qmc.LatinHypercube(dimensions, rng=seed).random(count))


class LatinHypercube:
    """Row i has the stratum p_k(i) of key k, p_k being a permutation that is computed and not stored, and a random place in it."""

    def __init__(self, count: int, dimensions: int, seed: int) -> None:
        self._places = Independent(count, dimensions, seed)
        draws = np.random.default_rng(seed).integers(2**62, size=(dimensions, ROUNDS, 2), dtype=np.uint64)
        self._permutations = [Permutation(count, keys) for keys in draws]

    def __len__(self) -> int:
        return len(self._places)

    def rows(self, first: int, stop: int) -> Floats:
        """The rows from `first` up to `stop`."""
        numbers = np.arange(first, stop)
        strata = np.stack([permutation.at(numbers) for permutation in self._permutations], axis=1)
        return (strata + self._places.rows(first, stop)) / len(self)


class Permutation:
    """A permutation of 0 ... count - 1, one for each set of `keys` (rounds, 2).

    Each round mixes a number of b bits in three steps that can all be undone: times an odd number and plus another one, both mod 2^b, and
    the upper half of the bits upon the lower one.  What lies beyond the count is mixed again until it does not (cycle walking).
    """

    def __init__(self, count: int, keys: Ints) -> None:
        self._count, self._bits = count, max(math.ceil(math.log2(max(count, 2))), 2)
        self._keys = [(np.uint64(2 * int(factor) % 2**64 + 1), np.uint64(term)) for factor, term in keys]

    def at(self, numbers: Ints) -> Ints:
        """Where some numbers go."""
        places = self._mixed(np.asarray(numbers).astype(np.uint64))
        while np.any(outside := places >= self._count):
            places[outside] = self._mixed(places[outside])
        return places.astype(np.int64)

    def _mixed(self, x):
        mask, half = np.uint64(2**self._bits - 1), np.uint64((self._bits + 1) // 2)
        for factor, term in self._keys:
            x = (x * factor + term) & mask
            x = x ^ (x >> half)
        return x
