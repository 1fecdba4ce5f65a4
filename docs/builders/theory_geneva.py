"""Figures of the theory page on Geneva drives, drawn by the package's own functions."""

from collections.abc import Callable
from pathlib import Path

import numpy as np

from drivewright.indexing.geneva.shapes import GenevaShape
from drivewright.indexing.geneva.step import GenevaStep

from .theory_figures import (
    BLUE,
    GREEN,
    GREY,
    INK,
    ORANGE,
    RED,
    angle_mark,
    area,
    arrow,
    axes,
    circle,
    curve,
    dimension,
    frame,
    label,
    limits,
    point,
    sketch,
    write,
)

MM = 1e3
C, PIN = 0.100, 0.008
STEP = GenevaStep(4, C, C * np.sin(np.pi / 4))
SLOTS = np.arange(3, 13)


def build(docs: Path, progress: Callable[[str], None]) -> None:
    """Write the figures of the Geneva page to docs/theory/img."""
    write(docs, "geneva", {"frames": frames, "step": step}, progress)


def _shape():
    """The default design with clearances that can be seen."""
    outer = float(np.hypot(C * np.cos(STEP.half_pitch), PIN + 2e-4))
    return GenevaShape(STEP, PIN, 4e-4, 1e-3, outer, STEP.crank_radius - 3 * PIN, 1e-3, 1e-3)


def frames():
    """The drive at entry, and the forces of the pin."""
    figure, (left, right) = axes(1, 2, 9.6, 4.6, width_ratios=[1, 1])
    _entry(left)
    _forces(right)
    return figure


def _draw(ax, theta):
    """Wheel, disc and pin at a crank angle; the place of the pin [mm]."""
    shape, turn = _shape(), np.pi - float(STEP.pin_direction(theta).d0)
    wheel, disc = (outline.points(1e-5) @ [1, 1j] for outline in (shape.wheel_outline, shape.disc_outline))
    area(ax, (C + wheel * np.exp(1j * turn)) * MM, "#e9edf2", GREY)
    area(ax, disc * np.exp(1j * theta) * MM)
    pin = STEP.crank_radius * np.exp(1j * theta) * MM
    curve(ax, [0, pin], INK, lw=3)
    circle(ax, pin, PIN * MM, INK, "white", zorder=3)
    frame(ax, 0, 9)
    frame(ax, C * MM, 9)
    point(ax, 0j, "$O_1$", -8 + 6j)
    point(ax, C * MM + 0j, "$O_2$", 8 + 6j)
    return pin


def _entry(ax):
    theta = -STEP.half_engagement
    sketch(ax, "The pin enters the slot")
    circle(ax, 0, STEP.crank_radius * MM, GREY, lw=0.8, ls=(0, (6, 3)))
    pin = _draw(ax, theta)
    curve(ax, [0, C * MM], GREY, lw=0.8)
    curve(ax, [C * MM, pin], GREY, lw=0.8)
    dimension(ax, 0, C * MM, "$C$", -80, shift=0)
    label(ax, 0.55 * pin - 6 - 6j, "$a$")
    label(ax, 0.5 * (pin + C * MM) + 5 - 6j, r"$\rho$")
    angle_mark(ax, 0, 22, theta, 0.0, r"$\theta_e$", INK, 1.35)
    angle_mark(ax, C * MM, 24, np.pi, np.pi + STEP.half_pitch, r"$\beta$", INK, 1.3)
    limits(ax, -80, 172, -92, 80)


def _forces(ax):
    theta = np.radians(-22.0)
    sketch(ax, "Forces on the wheel while the pin drives")
    pin = _draw(ax, theta)
    out = (pin - C * MM) / abs(pin - C * MM)
    forward = -1j * out
    touch = pin + PIN * MM * forward
    arrow(ax, touch, touch + 30 * forward, RED)
    label(ax, touch + 36 * forward, "$N$", RED)
    arrow(ax, touch, touch - 16 * out, ORANGE)
    label(ax, touch - 22 * out + 3j, r"$\mu N$", ORANGE)
    curve(ax, [C * MM, C * MM + 1.5 * (pin - C * MM)], GREY, lw=0.7, ls=(0, (5, 3)))
    arrow(ax, C * MM + 0j, C * MM + 20 * out, BLUE, width=1.1)
    label(ax, C * MM + 25 * out - 5j, "$u$", BLUE)
    arrow(ax, C * MM + 0j, C * MM + 20 * forward, BLUE, width=1.1)
    label(ax, C * MM + 26 * forward, "$t$", BLUE)
    angle_mark(ax, 0, 24, theta, 0.0, r"$\theta$", INK, 1.3)
    limits(ax, -80, 172, -92, 80)


def step():
    """Speed, acceleration and jerk of four slots; peaks over the number of slots."""
    figure, (left, right) = axes(1, 2, 9.2, 3.4)
    theta = np.linspace(-STEP.half_engagement, STEP.half_engagement, 301)
    over, degrees = STEP.pin_direction(theta), np.degrees(theta)
    for values, name, colour, scale in (
        (over.d1, r"$\psi'$", BLUE, 1),
        (over.d2, r"$\psi''/2$", RED, 2),
        (over.d3, r"$\psi'''/20$", GREEN, 20),
    ):
        left.plot(degrees, values / scale, color=colour, label=name)
    left.set(title="Four slots", xlabel="Crank angle θ [°]", xlim=(-45, 45))
    left.set_xticks(range(-45, 46, 15))
    left.legend()
    steps = [GenevaStep(int(n), 1.0, float(np.sin(np.pi / n))) for n in SLOTS]
    for values, name, colour in (
        ([each.largest_rate for each in steps], r"$\psi'_{\max}$", BLUE),
        ([each.largest_bend for each in steps], r"$\psi''_{\max}$", RED),
        ([each.entry_bend for each in steps], r"$\psi''$ at entry", ORANGE),
        ([each.largest_third for each in steps], r"$|\psi'''|_{\max}$", GREEN),
    ):
        right.semilogy(SLOTS, values, "o-", color=colour, label=name, ms=3.5)
    right.set(title="Peaks", xlabel="Number of slots")
    right.legend()
    return figure
