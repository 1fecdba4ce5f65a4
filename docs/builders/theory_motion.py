"""Figures of the theory page on motion laws, drawn by the package's own functions."""

from collections.abc import Callable
from pathlib import Path

import numpy as np

from drivewright import motion

from .theory_figures import BLUE, GREEN, GREY, INK, ORANGE, RED, TURN, VIOLET, arrow, axes, label, write

LAWS = {
    "cycloidal": BLUE,
    "modified-sine": GREEN,
    "modified-trapezoid": ORANGE,
    "polynomial-345": RED,
    "polynomial-4567": VIOLET,
    "mcv50": GREY,
}


def build(docs: Path, progress: Callable[[str], None]) -> None:
    """Write the figures of the motion-law page to docs/theory/img."""
    write(docs, "motion", {"laws": laws, "scca": scca, "programme": programme, "verification": verification}, progress)


def laws():
    """Position, velocity, acceleration and jerk of the common laws."""
    figure, panels = axes(2, 2, 9.0, 5.0, sharex=True)
    titles = ("Position $s$", "Velocity $v$", "Acceleration $a$", "Jerk $j$")
    for name, color in LAWS.items():
        law = motion.law(name)
        for ax, order in zip(panels.ravel(), range(4), strict=True):
            x, y = _with_both_sides(law, order)
            ax.plot(x, y, color=color, lw=1.2, label=name)
    for ax, title in zip(panels.ravel(), titles, strict=True):
        ax.set(title=title, xlim=(0, 1))
    for ax in panels[1]:
        ax.set_xlabel("$u$ [-]")
    panels[1, 1].set_ylim(-120, 220)
    panels[0, 0].legend(loc="upper left", fontsize=8)
    return figure


def _with_both_sides(law, order, samples=60):
    """Places and values piece by piece, so that a jump shows as a vertical line."""
    parts = [np.linspace(a, b, samples) for a, b in zip(law.breaks[:-1], law.breaks[1:], strict=True)]
    values = [np.broadcast_to(law.on_piece(k, part)[order], part.shape) for k, part in enumerate(parts)]
    return np.concatenate(parts), np.concatenate(values)


def scca():
    """Acceleration of the sine-constant-cosine family, with its parts."""
    figure, (left, right) = axes(1, 2, 9.0, 3.0)
    b, c, d = 0.3, 0.25, 0.45
    law = motion.law("scca", b=b, c=c, d=d)
    x, a = _with_both_sides(law, 2)
    left.plot(x, a, color=BLUE)
    peak = law.peaks().Am
    ends = np.array([0, b / 2, (b + c) / 2, (b + c) / 2 + d, 1 - b / 2, 1])
    for end in ends[1:-1]:
        left.axvline(end, color=GREY, lw=0.7, ls=":")
    for low, high, text in zip(ends[:-1], ends[1:], ("$b/2$", "$c/2$", "$d$", "$c/2$", "$b/2$"), strict=True):
        arrow(left, complex(low, -1.3 * peak), complex(high, -1.3 * peak), GREY, style="<|-|>", width=0.8)
        label(left, complex((low + high) / 2, -1.3 * peak), text, INK, fontsize=8.5)
    left.set(title="Parts of the acceleration", xlabel="$u$ [-]", ylabel="$a$ [-]", xlim=(0, 1), ylim=(-1.55 * peak, 1.25 * peak))
    for part, color in ((0.25, BLUE), (0.5, GREEN)):
        rest = 1 - part
        peaks = [motion.law("scca", b=part, c=rest * (1 - q), d=rest * q).peaks() for q in np.linspace(0, 1, 41)]
        right.plot([p.Vm for p in peaks], [p.Am for p in peaks], color=color, lw=1.2, label=f"$b={part}$")
    for name in ("cycloidal", "modified-sine", "modified-trapezoid", "parabolic", "simple-harmonic", "mcv33", "mcv20"):
        p = motion.law(name).peaks()
        right.plot(p.Vm, p.Am, "o", ms=4, color=RED)
        right.annotate(name, (p.Vm, p.Am), xytext=(5, 4), textcoords="offset points", fontsize=8)
    right.set(title="Peak acceleration over peak velocity", xlabel="$V_m$ [-]", ylabel="$A_m$ [-]", xlim=(1.35, 2.35), ylim=(3.7, 7))
    right.legend(loc="lower left")
    return figure


def programme():
    """A programme of four segments with its derivatives by the cam angle."""
    part = np.radians
    segments = (
        motion.Segment(part(100), "modified-sine", 0.020),
        motion.Segment(part(50), "dwell"),
        motion.Segment(part(130), "polynomial-345", -0.020),
        motion.Segment(part(80), "dwell"),
    )
    cycle = motion.Programme(segments, lift_unit="m")
    theta = np.linspace(0, TURN, 721)
    found = cycle(np.minimum(theta, TURN * (1 - 1e-12)))
    figure, panels = axes(1, 3, 9.4, 2.6)
    for ax, value, title in zip(panels, (found.s, found.v, found.a), ("$s$ [mm]", "$s'$ [mm/rad]", "$s''$ [mm/rad²]"), strict=True):
        ax.plot(np.degrees(theta), value * 1e3, color=BLUE, lw=1.3)
        for start in np.degrees(cycle.starts[1:-1]):
            ax.axvline(start, color=GREY, lw=0.7, ls=":")
        ax.set(title=title, xlabel="cam angle [°]", xlim=(0, 360), xticks=np.arange(0, 361, 90))
    return figure


def verification():
    """Peak factors against their closed forms, and the order of splines through a known motion."""
    figure, (left, right) = axes(1, 2, 9.0, 3.0)
    exact = {
        "cycloidal": (2, 2 * np.pi, 4 * np.pi**2),
        "modified-sine": (4 * np.pi / (4 + np.pi), 4 * np.pi**2 / (4 + np.pi), 16 * np.pi**3 / (4 + np.pi)),
        "modified-trapezoid": (2, 8 * np.pi / (2 + np.pi), 32 * np.pi**2 / (2 + np.pi)),
        "polynomial-345": (15 / 8, 10 / np.sqrt(3), 60),
        "polynomial-4567": (35 / 16, 84 * np.sqrt(5) / 25, 52.5),
        "polynomial-56789": (315 / 128, 2520 / 64 * (6 / 7) ** 3 / np.sqrt(7), 78.75),
    }
    for order, (marker, color, text) in enumerate((("o", BLUE, "$V_m$"), ("s", GREEN, "$A_m$"), ("^", ORANGE, "$J_m$"))):
        errors = [abs(motion.law(name).peaks()[order] / peaks[order] - 1) + 1e-17 for name, peaks in exact.items()]
        left.semilogy(range(len(exact)), errors, marker, ms=5, color=color, label=text)
    left.set_xticks(range(len(exact)), exact, rotation=20, ha="right", fontsize=8)
    left.set(title="Peak factors against closed forms", ylabel="relative error [-]", ylim=(1e-17, 1e-9))
    left.legend(loc="upper right", ncols=3)
    rows = np.array([12, 16, 24, 32, 48, 64, 96])
    x = np.linspace(0, 1, 2001)
    for degree, color in ((3, ORANGE), (5, BLUE)):
        errors = [np.max(np.abs(_table(n, degree)(x).s - _known(x))) for n in rows]
        right.loglog(rows, errors, "o-", ms=4, color=color, lw=1.2, label=f"degree {degree}")
        right.loglog(rows, errors[-1] * (rows / rows[-1]) ** -(degree + 1.0), color=GREY, lw=0.8, ls="--")
    right.set(title="Splines through a known motion", xlabel="rows per turn [-]", ylabel="largest error of $s$ [-]")
    right.set_xticks(rows, rows)
    right.minorticks_off()
    right.legend(loc="upper right")
    return figure


def _known(u):
    return np.exp(np.sin(TURN * u))


def _table(rows, degree):
    u = np.linspace(0, 1, rows + 1)
    return motion.law("table", angle=TURN * u, lift=_known(u), degree=degree, ends="periodic")
