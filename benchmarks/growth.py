"""How run time grows with size, one quantity at a time, and how a study grows with its workers.  Writes docs/growth.md and its figures.

`python benchmarks/growth.py` measures everything; with words behind it only the quantities whose panel or name has one of them, which
are printed and not written.  Nothing is asserted.
"""

import gc
import os
import platform
import statistics
import sys
import time
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import NamedTuple

import cluster
import growth_tabs
import numpy as np
from growth_quantities import QUANTITIES, Quantity
from numpy.typing import ArrayLike

ROOT = Path(__file__).parent.parent
FIGURE = ROOT / "docs" / "img" / "growth.svg"
ENOUGH, FEWEST, MOST = 0.6, 3, 9  # seconds of repeats at a size, and how many of them
FITTED = 4  # sizes at least, the largest ones, through which the exponent is fitted
COLOURS, MARKERS, DASHES = ("blue", "orange", "green"), ("o", "s", "D"), ("-", "--", "-.")


class Fit(NamedTuple):
    """seconds = factor size^exponent over the sizes from `first` up, with the half width of the exponent's 95 % interval."""

    exponent: float
    half_width: float
    factor: float
    first: float


class Measured(NamedTuple):
    """A quantity with the sizes as they came out and the median seconds of a call at each."""

    quantity: Quantity
    sizes: tuple[float, ...]
    seconds: tuple[float, ...]

    @property
    def fit(self) -> Fit:
        """Its growth."""
        return fitted(self.sizes, self.seconds)

    @property
    def verdict(self) -> str:
        """How the exponent lies against what is expected, where its interval does not touch that."""
        low, high = self.quantity.expected
        exponent, half = self.fit[:2]
        return "grows more than expected" if exponent - half > high else "grows less than expected" if exponent + half < low else ""


def fitted(sizes: ArrayLike, seconds: ArrayLike) -> Fit:
    """The `Fit` by least squares of the logarithms, through the upper half of the sizes and `FITTED` of them at least."""
    from scipy.stats import t

    x, y = np.log(np.asarray(sizes, float)), np.log(np.asarray(seconds, float))
    kept = max(FITTED, (len(x) + 1) // 2)
    x, y = x[-kept:], y[-kept:]
    (slope, offset), left = np.polyfit(x, y, 1), len(x) - 2
    error = np.sqrt(np.sum((y - slope * x - offset) ** 2) / left / np.sum((x - x.mean()) ** 2))
    return Fit(float(slope), float(t.ppf(0.975, left) * error), float(np.exp(offset)), float(np.exp(x[0])))


def median_seconds(call: Callable[[], object]) -> float:
    """Median of repeats of a call, after one warm-up."""
    call()
    times = []
    gc.collect()
    while len(times) < FEWEST or (sum(times) < ENOUGH and len(times) < MOST):
        started = time.perf_counter()
        call()
        times.append(time.perf_counter() - started)
    return statistics.median(times)


def measured(quantity: Quantity) -> Measured:
    """A quantity at all its sizes."""
    prepared = (quantity.prepare(size) for size in quantity.sizes)
    pairs = [(each.size, median_seconds(each.call)) for each in prepared]
    return Measured(quantity, tuple(size for size, _ in pairs), tuple(seconds for _, seconds in pairs))


def studio() -> tuple[list[Measured], str]:
    """What tabs cost: two quantities, and a sentence on the memory of the server."""
    counts, alone, together, server, workers = zip(*growth_tabs.tabs(), strict=True)
    about = (
        ("one tab draws", alone, (-0.1, 0.2), "a changed length until the new drawing: the other tabs rest and cost nothing"),
        (
            "all draw at once",
            together,
            (0.6, 1.1),
            "the same until the last tab has its drawing: one server and a fixed number of worker processes",
        ),
    )
    rows = [
        Measured(Quantity("Studio", name, "tabs", counts, _unprepared, expected, why), counts, seconds)
        for name, seconds, expected, why in about
    ]
    slope, offset = np.polyfit(counts, server, 1)
    memory = (
        f"Memory of the studio's server: {offset:.0f} MB and {slope:.2f} MB a tab ({counts[-1]} tabs: {server[-1]:.0f} MB); its worker "
        f"processes, which the tabs share, {workers[0]:.0f} MB with one tab and {workers[-1]:.0f} MB with {counts[-1]}."
    )
    return rows, memory


def _unprepared(size):
    raise NotImplementedError("tabs are measured together, on one server")


# -- the page ------------------------------------------------------------------------------------------------------------------


def row(each: Measured) -> str:
    """A row of the page's table."""
    fit, (low, high) = each.fit, each.quantity.expected
    seconds = f"{_time(each.seconds[0])} to {_time(each.seconds[-1])}"
    sizes = f"{each.sizes[0]:,.0f} to {each.sizes[-1]:,.0f} {each.quantity.counts}"
    remark = f"**{each.verdict}**; {each.quantity.why}" if each.verdict else each.quantity.why
    expected = f"{(low + high) / 2:.0f}" if high - low <= 0.5 and round((low + high) / 2) in (0, 1) else f"{low:g} to {high:g}"
    exponent = f"{fit.exponent:.2f} ± {fit.half_width:.2f}".replace("-", "\u2212")
    return f"| {each.quantity.panel}: {each.quantity.name} | {sizes} | {seconds} | {exponent} | {expected} | {remark} |"


def _time(seconds: float) -> str:
    """A time with three digits in a unit that suits it."""
    for unit, factor in (("s", 1.0), ("ms", 1e3)):
        if seconds * factor >= 0.9995:
            return f"{seconds * factor:.3g} {unit}"
    return f"{1e6 * seconds:.3g} µs"


def page(rows: Sequence[Measured], memory: str, load: tuple[float, float], simulated: Iterable[str]) -> str:
    """The text of docs/growth.md."""
    return "\n".join(
        [
            "# Growth",
            "",
            "How run time grows with size, one quantity at a time, and how a study grows with its workers. Made by `make growth`, which "
            "measures everything again and writes this page and its figures. Nothing here is asserted by a test.",
            "",
            f"Python {platform.python_version()}, {os.cpu_count()} cores, {platform.machine()}; processes that wanted to run: "
            f"{load[0]:.1f} on average in the minute before the start and {load[1]:.1f} before the end. One thread. Median of "
            f"{FEWEST} to {MOST} calls at each size, compile time not included. The exponent p of time ~ size^p is fitted by least squares "
            f"of the logarithms through the upper half of the sizes, {FITTED} at least; ± is half of its 95 % interval.",
            "",
            "## Time against size",
            "",
            "![Time against size](img/growth.svg)",
            "",
            "Points are measured, lines are the fits; the exponent stands behind each name.",
            "",
            "| what | sizes | time | exponent | expected | why |",
            "|---|---|---|---|---|---|",
            *map(row, rows),
            "",
            memory,
            "",
            *simulated,
            "",
        ]
    )


# -- the figure ----------------------------------------------------------------------------------------------------------------


def draw(rows: Sequence[Measured], path: Path) -> None:
    """One panel for what belongs together: measured points, the fitted line where it was fitted."""
    from drivewright.view.palette import colour
    from drivewright.view.style import new_figure, styled

    panels = list(dict.fromkeys(each.quantity.panel for each in rows))
    with styled():
        figure = new_figure(2.5 * -(-len(panels) // 2))
        axes = figure.subplots(-(-len(panels) // 2), 2).ravel()
        for axis in axes[len(panels) :]:
            axis.remove()
        for axis, panel in zip(axes, panels, strict=False):
            own = [each for each in rows if each.quantity.panel == panel]
            for each, hue, marker, dash in zip(own, COLOURS, MARKERS, DASHES, strict=False):
                _curve(axis, each, colour(hue), marker, dash)
            counts = dict.fromkeys(each.quantity.counts for each in own)
            axis.set(xscale="log", yscale="log", title=panel, xlabel=f"number of {', '.join(counts)}", ylabel="time [s]")
            _limits(axis, [s for each in own for s in each.seconds], len(own))
            axis.legend(loc="upper left", handlelength=2.6, fontsize=8, borderaxespad=0.2)
        figure.savefig(path, metadata={"Date": None})


def _curve(axis, each, hue, marker, dash):
    fit = each.fit
    x = np.array([fit.first, each.sizes[-1]])
    label = f"{each.quantity.name}: {fit.exponent:.2f}".replace("-", "\u2212")
    axis.plot(each.sizes, each.seconds, marker, color=hue, markersize=5, markerfacecolor="white", markeredgewidth=1.3)
    axis.plot(x, fit.factor * x**fit.exponent, dash, color=hue, linewidth=1.4)
    axis.plot([], [], dash, marker=marker, color=hue, markersize=5, markerfacecolor="white", markeredgewidth=1.3, label=label)


def _limits(axis, seconds, curves):
    """Room above the points for the legend; powers of ten alone are written."""
    from matplotlib.ticker import NullFormatter

    low, high = np.log10(min(seconds)), np.log10(max(seconds))
    if high - low < 1.5:
        low, high = np.floor(low), max(high, np.floor(low) + 1.0)
    span = high - low
    axis.set_ylim(10 ** (low - 0.1 * span), 10 ** (high + (0.2 + 0.16 * curves) * span))
    for scale in (axis.xaxis, axis.yaxis):
        scale.set_minor_formatter(NullFormatter())


def main(words: Sequence[str]) -> None:
    """Measure, print, and write the page unless only some quantities were asked for."""
    before = os.getloadavg()[0]
    rows = []
    for quantity in QUANTITIES:
        if not words or any(word in f"{quantity.panel}: {quantity.name}" for word in words):
            rows.append(measured(quantity))
            print(row(rows[-1]), flush=True)
    memory = ""
    if not words or "Studio" in words:
        own, memory = studio()
        rows += own
        print(*map(row, own), memory, sep="\n", flush=True)
    if not words:
        simulated = cluster.section(ROOT / "docs" / "img")
        (ROOT / "docs" / "growth.md").write_text(page(rows, memory, (before, os.getloadavg()[0]), simulated), encoding="utf-8")
        draw(rows, FIGURE)


if __name__ == "__main__":
    main(sys.argv[1:])
