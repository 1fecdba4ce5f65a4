"""What the builders of the theory figures share: one style, and the marks of a technical sketch (arrows, dimensions, angles).

Points are complex numbers in the plane of the figure.  The figures keep a white ground, so that they read on a dark page too.
"""

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
import shapely

matplotlib.use("Agg")
from matplotlib import pyplot as plt

BLUE, RED, GREEN, ORANGE, VIOLET = "#1f5fa8", "#c0392b", "#2e7d4f", "#d9822b", "#7b4ea3"
GREY, LIGHT, INK = "#6b7480", "#d5dae1", "#1d242d"
TURN = 2 * np.pi
STYLE = {
    "font.family": "DejaVu Sans",
    "font.size": 9,
    "mathtext.fontset": "dejavusans",
    "axes.titlesize": 9.5,
    "axes.titlelocation": "left",
    "axes.labelsize": 9,
    "axes.edgecolor": "#9aa3ad",
    "axes.linewidth": 0.8,
    "axes.grid": True,
    "grid.color": "#e4e8ed",
    "grid.linewidth": 0.7,
    "axes.axisbelow": True,
    "xtick.color": INK,
    "ytick.color": INK,
    "xtick.labelsize": 8.5,
    "ytick.labelsize": 8.5,
    "legend.fontsize": 8.5,
    "legend.frameon": False,
    "lines.linewidth": 1.5,
    "svg.hashsalt": "drivewright",
    "path.simplify": True,
    "path.simplify_threshold": 0.1,
}


def write(docs: Path, page: str, drawings: Mapping[str, Callable[[], Any]], progress: Callable[[str], None]) -> None:
    """Write docs/theory/img/PAGE-NAME.svg of every drawing, a function that returns a figure."""
    folder = docs / "theory" / "img"
    folder.mkdir(parents=True, exist_ok=True)
    for name, draw in drawings.items():
        progress(f"theory of {page}: {name}")
        path = folder / f"{page}-{name}.svg"
        with plt.rc_context(STYLE):
            figure = draw()
            figure.savefig(path, facecolor="white", bbox_inches="tight", pad_inches=0.06, metadata={"Date": None})
            plt.close(figure)
        path.write_text(_compact(path.read_text(encoding="utf-8")), encoding="utf-8")


def axes(rows: int = 1, columns: int = 1, width: float = 8.0, height: float = 3.4, **options: Any) -> tuple[Any, Any]:
    """(figure, axes) of a size in inches."""
    return plt.subplots(rows, columns, figsize=(width, height), layout="constrained", **options)


def _compact(svg):
    """Coordinates of paths to a hundredth of a point, no trailing blanks."""
    lines = (line.rstrip() for line in svg.splitlines())
    short = re.sub(r' d="[^"]*"', lambda path: re.sub(r"-?\d+\.\d{3,}", lambda n: f"{float(n[0]):.2f}", path[0]), "\n".join(lines))
    return short + "\n"


def sketch(ax: Any, title: str = "") -> None:
    """Make axes a sheet for a sketch: equal scales, no frame, no ticks."""
    ax.set_aspect("equal")
    ax.axis("off")
    ax.set_anchor("N")
    ax.set_title(title, color=INK)


def curve(ax: Any, points: Iterable[complex], color: str = INK, **options: Any) -> None:
    """A curve through complex points."""
    z = _thinned(points)
    ax.plot(z.real, z.imag, color=color, **({"lw": 1.5, "solid_capstyle": "round"} | options))


def _thinned(points):
    """The points that a picture needs: those left out are within 0.03 % of the size of the curve."""
    z = np.asarray(points, dtype=complex)
    if len(z) < 100:
        return z
    size = max(np.ptp(z.real), np.ptp(z.imag))
    x, y = np.array(shapely.LineString(np.stack([z.real, z.imag], axis=1)).simplify(3e-4 * size).coords).T
    return x + 1j * y


def area(ax: Any, points: Iterable[complex], color: str = LIGHT, edge: str = INK, **options: Any) -> None:
    """A filled outline."""
    z = _thinned(points)
    ax.fill(z.real, z.imag, facecolor=color, edgecolor=edge, **({"lw": 1.3} | options))


def circle(ax: Any, centre: complex, radius: float, color: str = INK, fill: str | None = None, **options: Any) -> None:
    """A circle, filled where `fill` names a colour."""
    z = centre + radius * np.exp(1j * np.linspace(0, TURN, 73))
    if fill:
        area(ax, z, fill, color, **options)
    else:
        curve(ax, z, color, **options)


def point(ax: Any, at: complex, text: str = "", shift: complex = 0, color: str = INK, size: float = 4.0) -> None:
    """A marked point with its name beside it."""
    ax.plot(at.real, at.imag, "o", ms=size, color=color, zorder=5)
    if text:
        label(ax, at + shift, text, color)


def label(ax: Any, at: complex, text: str, color: str = INK, **options: Any) -> None:
    """A text on a small white ground, so that lines below it do not strike it through."""
    box = {"boxstyle": "round,pad=0.12", "fc": "white", "ec": "none", "alpha": 0.85}
    settings = {"ha": "center", "va": "center", "fontsize": 9.5, "zorder": 6, "bbox": box} | options
    ax.text(at.real, at.imag, text, color=color, **settings)


def arrow(ax: Any, start: complex, end: complex, color: str = INK, style: str = "-|>", width: float = 1.3, **options: Any) -> None:
    """An arrow from one point to another."""
    props = {"arrowstyle": style, "color": color, "lw": width, "shrinkA": 0, "shrinkB": 0, "mutation_scale": 9} | options
    ax.annotate("", xy=(end.real, end.imag), xytext=(start.real, start.imag), arrowprops=props, zorder=4)


def dimension(ax: Any, start: complex, end: complex, text: str, aside: float = 0.0, color: str = GREY, shift: complex = 0) -> None:
    """A dimension line between two points, moved `aside` to the left of the way from the first to the second, with witness lines."""
    away = 1j * (end - start) / abs(end - start) * aside
    for at in (start, end):
        if aside:
            curve(ax, [at, at + 1.06 * away], color, lw=0.6)
    arrow(ax, start + away, end + away, color, style="<|-|>", width=0.9)
    label(ax, 0.5 * (start + end) + away + shift, text, color)


def angle_mark(
    ax: Any, centre: complex, radius: float, start: float, end: float, text: str, color: str = GREY, out: float = 1.22, style: str = "-|>"
) -> None:
    """An arc with an arrow from one direction [rad] to another, its name outside of it."""
    z = centre + radius * np.exp(1j * np.linspace(start, end, 41))
    curve(ax, z[:-2], color, lw=1.0)
    arrow(ax, z[-4], z[-1], color, style=style, width=1.0)
    label(ax, centre + out * radius * np.exp(0.5j * (start + end)), text, color)


def frame(ax: Any, origin: complex, size: float, names: Sequence[str] = ("x", "y"), color: str = GREY) -> None:
    """The axes of a frame."""
    for way, name in zip((1, 1j), names, strict=True):
        arrow(ax, origin, origin + size * way, color, width=1.0)
        label(ax, origin + 1.13 * size * way, f"${name}$", color)


def slideway(ax: Any, bottom: complex, top: complex, half: float, color: str = GREY) -> None:
    """The guide of a follower's stem: two hatched strips."""
    along = (top - bottom) / abs(top - bottom)
    for side in (1, -1):
        a, b = bottom + side * half * 1j * along, top + side * half * 1j * along
        curve(ax, [a, b], color, lw=1.0)
        for part in np.linspace(0, 1, 5):
            at = a + part * (b - a)
            curve(ax, [at, at + side * 1j * along * half * 0.7 - 0.5 * half * along], color, lw=0.6)


def limits(ax: Any, left: float, right: float, bottom: float, top: float) -> None:
    """What of the plane is shown."""
    ax.set_xlim(left, right)
    ax.set_ylim(bottom, top)


def turn_axis(ax: Any, text: str = "cam angle [°]", step: int = 60) -> None:
    """An abscissa over one turn in degrees."""
    ax.set_xlim(0, 360)
    ax.set_xticks(np.arange(0, 361, step))
    ax.set_xlabel(text)
