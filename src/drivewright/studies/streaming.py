"""Statistics of numbers that come in pieces and are too many to be held: moments, ends, and exact percentiles.

A percentile needs the numbers of a few ranks.  They are found by counting: each pass over all numbers divides the intervals that hold a
wanted rank into many smaller ones, until so few numbers lie in them that these are kept and sorted.  Intervals are those of the 64-bit
patterns of the numbers, which are in the same order as the numbers: any distribution takes a few passes, and the result is exact.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field

import numpy as np

from drivewright._typing import Floats, Ints
from drivewright.studies.statistics import Sampled, Summary, mean_of, percentile_ranks, percentiles_at, sigma_of, skewness_of

BINS = 2**14  # parts into which the intervals of one column are divided in a pass
COLLECTED = 100_000  # numbers of a column that are kept and sorted

Pieces = Callable[[], Iterable[Mapping[str, Floats]]]  # one pass over all numbers: {column: (n,)}, as often as it is called


@dataclass
class Moments:
    """Count, mean and sums of powers about it, least and greatest of numbers that come in pieces; nan is left out and counted."""

    count: int = 0
    absent: int = 0
    mean: float = 0.0
    second: float = 0.0
    third: float = 0.0
    least: float = np.nan
    greatest: float = np.nan
    least_at: int = -1  # number of the case
    greatest_at: int = -1

    def add(self, column: Floats, cases: Ints) -> None:
        """Take the numbers of some cases.

        With n, mean, M2 and M3 of both sides and d the difference of the means: M2 = M2a + M2b + d^2 na nb / n,
        M3 = M3a + M3b + d^3 na nb (na - nb) / n^2 + 3 d (na M2b - nb M2a) / n (Chan, Golub & LeVeque 1979; Terriberry; recalled, held
        by the moments of the whole in the tests).
        """
        places = np.flatnonzero(np.isfinite(column))
        self.absent += len(column) - len(places)
        if not len(places):
            return
        given = column[places]
        middle, n, new = float(given.mean()), self.count, len(given)
        second, third = (float(np.sum((given - middle) ** k)) for k in (2, 3))
        off, total = middle - self.mean, n + new
        self.third += third + off**3 * n * new * (n - new) / total**2 + 3 * off * (n * second - new * self.second) / total
        self.second += second + off**2 * n * new / total
        self.mean += off * new / total
        self.count = total
        self._ends(given, cases[places])

    def _ends(self, given, cases):
        low, high = int(np.argmin(given)), int(np.argmax(given))
        if not self.least <= given[low]:
            self.least, self.least_at = float(given[low]), int(cases[low])
        if not self.greatest >= given[high]:
            self.greatest, self.greatest_at = float(given[high]), int(cases[high])

    @property
    def numbers(self) -> tuple[float, float, float]:
        """(mean, standard deviation with n - 1, skewness), as `statistics.moments`."""
        n = self.count
        if n < 2 or self.least == self.greatest:
            return (self.least if n else np.nan), (0.0 if n > 1 else np.nan), np.nan
        variance = self.second / n
        return self.mean, float(np.sqrt(self.second / (n - 1))), float(self.third / n / variance**1.5)


def summaries(pieces: Pieces, moments: Mapping[str, Moments]) -> dict[str, Summary]:
    """{column: `Summary`} as of `statistics.summary`, of numbers whose `Moments` are known."""
    ranks = {name: percentile_ranks(each.count) for name, each in moments.items() if each.count}
    ends = {name: (moments[name].least, moments[name].greatest) for name in ranks}
    found = numbers_of_ranks(pieces, {name: np.unique(wanted[wanted >= 0]) for name, wanted in ranks.items()}, ends)
    return {name: _summary(each, found.get(name, {})) for name, each in moments.items()}


def _summary(moments: Moments, of_rank: Mapping[int, float]) -> Summary:
    n, (mean, sigma, skewness) = moments.count, moments.numbers
    if not n:
        none = Sampled(np.nan)
        return Summary(0, moments.absent, none, none, none, np.nan, np.nan, (none,) * len(percentile_ranks(1)))
    at = percentiles_at(n, of_rank)
    estimates = mean_of(mean, sigma, n), sigma_of(sigma, n), skewness_of(skewness, n)
    return Summary(n, moments.absent, *estimates, moments.least, moments.greatest, at)


# -- numbers of given ranks ------------------------------------------------------------------------------------------------------


def ordered_bits(numbers: Floats) -> Ints:
    """Whole numbers in the order of some finite floats, one for each float; -0 counts as 0."""
    bits = (np.asarray(numbers, float) + 0.0).view(np.int64)
    return np.where(bits < 0, np.int64(-(2**63)) - bits, bits)


def floats_of(bits: Ints) -> Floats:
    """The floats of `ordered_bits`."""
    return np.where(bits < 0, np.int64(-(2**63)) - bits, bits).astype(np.int64).view(np.float64)


@dataclass
class _Search:
    """Ranks of one column that are wanted, and intervals [low, stop) of bit patterns that hold them, with how many numbers lie below."""

    wanted: Ints  # ascending
    intervals: list[tuple[int, int, int]]  # (low, stop, numbers below low)
    found: dict[int, float] = field(default_factory=dict)
    inside: int = 0  # numbers within the intervals, as far as is known
    kept: list[Ints] = field(default_factory=list)
    edges: Ints = field(default_factory=lambda: np.zeros(0, np.int64))
    counts: Ints = field(default_factory=lambda: np.zeros(0, np.int64))

    def begin(self) -> None:
        """Before a pass: the edges between which it counts."""
        share = max(BINS // len(self.intervals), 2)
        pieces = [_divided(low, stop, share) for low, stop, _ in self.intervals]
        self.edges = np.unique(np.concatenate(pieces))
        self.counts, self.kept = np.zeros(len(self.edges) + 1, np.int64), []

    @property
    def collects(self) -> bool:
        """Whether what is left is little enough to be kept."""
        return 0 < self.inside <= COLLECTED

    def take(self, bits: Ints) -> None:
        """Some numbers of the pass."""
        places = np.searchsorted(self.edges, bits, side="right")
        if self.collects:
            starts = np.array([low for low, _, _ in self.intervals])
            stops = np.array([stop for _, stop, _ in self.intervals])
            at = np.searchsorted(starts, bits, side="right") - 1
            self.kept.append(bits[(at >= 0) & (bits < stops[np.maximum(at, 0)])])
        else:
            self.counts += np.bincount(places, minlength=len(self.counts))

    def end(self) -> None:
        """After a pass: what is found now, and the intervals of the next pass."""
        if self.collects:
            self._sort_out()
        else:
            self._narrow()

    def _sort_out(self):
        kept = np.sort(np.concatenate(self.kept))
        for low, stop, below in self.intervals:
            mine = kept[np.searchsorted(kept, low) : np.searchsorted(kept, stop)]
            for rank in self.wanted[(self.wanted >= below) & (self.wanted < below + len(mine))].tolist():
                self.found[rank] = float(floats_of(mine[[rank - below]])[0])
        self.intervals, self.inside = [], 0

    def _narrow(self):
        """Of the intervals between two edges those that hold a wanted rank."""
        narrowed, inside = [], 0
        for low, stop, below in self.intervals:
            first, last = np.searchsorted(self.edges, (low, stop))
            count = self.counts[first + 1 : last + 1]
            under = below + np.concatenate([[0], np.cumsum(count)])
            for k in np.unique(np.searchsorted(under, self.wanted[(self.wanted >= below) & (self.wanted < under[-1])], side="right") - 1):
                piece = int(self.edges[first + k]), int(self.edges[first + k + 1]), int(under[k])
                if piece[1] - piece[0] == 1:  # all numbers in it are equal
                    value = float(floats_of(np.array([piece[0]]))[0])
                    self.found |= dict.fromkeys(self.wanted[(self.wanted >= under[k]) & (self.wanted < under[k + 1])].tolist(), value)
                else:
                    narrowed.append(piece)
                    inside += int(count[k])
        self.intervals, self.inside = narrowed, inside


def _divided(low: int, stop: int, parts: int) -> Ints:
    """Edges from `low` to `stop` that divide an interval of whole numbers; Python's numbers, since the difference may be beyond 63 bits."""
    parts = min(parts, stop - low)
    return np.array([low + (stop - low) * k // parts for k in range(parts)] + [stop], dtype=np.int64)


def numbers_of_ranks(pieces: Pieces, ranks: Mapping[str, Ints], ends: Mapping[str, tuple[float, float]]) -> dict[str, dict[int, float]]:
    """{column: {rank: number}}: the numbers of ranks from 0 among the finite ones of each column, whose least and greatest are `ends`."""
    searches = {}
    for name, wanted in ranks.items():
        low, high = ordered_bits(np.array(ends[name])).tolist()
        searches[name] = _Search(np.asarray(wanted), [(low, high + 1, 0)])
    while active := {name: search for name, search in searches.items() if search.intervals}:
        for search in active.values():
            search.begin()
        for columns in pieces():
            for name, search in active.items():
                column = columns[name]
                search.take(ordered_bits(column[np.isfinite(column)]))
        for search in active.values():
            search.end()
    return {name: search.found for name, search in searches.items()}
