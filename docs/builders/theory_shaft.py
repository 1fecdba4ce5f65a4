"""Figures of the theory page on shafts, drawn by the package's own functions."""

from collections.abc import Callable
from pathlib import Path

import numpy as np

import drivewright as dw
from drivewright.bearings import catalogue
from drivewright.bearings.stiffness_curve import load_curve
from drivewright.shafts import beam as beams
from drivewright.shafts import closed_form
from drivewright.shafts.assembly import assemble
from drivewright.shafts.equilibrium import solve
from drivewright.shafts.influence import flexibility
from drivewright.shafts.model import COWPER, EULER_BERNOULLI, Section, Shaft, Support
from drivewright.shafts.rotor import reduced_rotor
from drivewright.shafts.sections import cylinder_compliances
from drivewright.shafts.vibration import modes
from drivewright.shafts.whirl import campbell, damped_critical_speeds

from .theory_figures import (
    BLUE,
    GREEN,
    GREY,
    INK,
    LIGHT,
    ORANGE,
    RED,
    VIOLET,
    angle_mark,
    area,
    arrow,
    axes,
    circle,
    curve,
    frame,
    label,
    point,
    sketch,
    write,
)

EXAMPLES = Path(__file__).parents[2] / "examples"
DOWN = np.array([0.0, -1.0])
STEEL = {"modulus": 206e9, "poisson": 0.3, "density": 7850.0}
PLACES, STATIONS = (0.0565, 0.1365), (0.0, 0.245)  # of the bearings and the masses of the default shaft [m]


def build(docs: Path, progress: Callable[[str], None]) -> None:
    """Write the figures of the shaft page to docs/theory/img."""
    write(docs, "shaft", FIGURES, progress)


def _shaft(stiffness, shear=COWPER):
    """The pressure-roller shaft on bearings of one stiffness [N/m]."""
    held = [
        Support(name, place, (stiffness, stiffness, stiffness if name == "A" else 0.0, 0.0, 0.0))
        for name, place in zip("AB", PLACES, strict=True)
    ]
    return Shaft((Section(0.34, 0.02, 0.02),), supports=tuple(held), shear=shear, **STEEL)


def _at_rest(shaft, places=()):
    model = assemble(shaft, places)
    return solve(model, np.zeros(model.size))


# ---------------------------------------------------------------------------------------------------------------- sketches


def _frames():
    figure, (left, right) = axes(1, 2, 8.8, 3.3, gridspec_kw={"width_ratios": [1.7, 1.0]})
    _default_shaft(left)
    _element(right)
    return figure


def _default_shaft(ax):
    sketch(ax, "pressure-roller shaft: frame, stations and loads")
    scale = 20.0
    end = 0.34 * scale
    area(ax, [0.0, end, end + 0.4j, 0.4j], LIGHT)
    curve(ax, [-0.25 + 0.2j, end + 0.25 + 0.2j], GREY, lw=0.7, ls="-.")
    for name, place in zip("AB", PLACES, strict=True):
        at = place * scale
        area(ax, [at, at - 0.17 - 0.38j, at + 0.17 - 0.38j], "white", lw=1.1)
        curve(ax, [at - 0.28 - 0.38j, at + 0.28 - 0.38j], INK, lw=1.3)
        label(ax, at - 0.6j, name)
        arrow(ax, at - 1.35j, at - 0.78j, GREEN)
    label(ax, PLACES[1] * scale + 0.75 - 1.1j, "reaction > 0", GREEN)
    for name, place in zip(("$m_1$", "$m_2$"), STATIONS, strict=True):
        at = place * scale
        circle(ax, at + 0.2j, 0.13, BLUE, "white")
        label(ax, at + 0.55j + 0.0, name, BLUE)
    at = STATIONS[1] * scale
    arrow(ax, at + 1.55j, at + 0.78j, RED, width=1.8)
    label(ax, at + 0.75 + 1.3j, "force 500 N", RED)
    frame(ax, -1.3 + 0.2j, 0.8, ("z", "y"))
    arrow(ax, at - 0.05j, at - 0.75j, ORANGE)
    label(ax, at + 0.85 - 0.5j, "deflection > 0", ORANGE)
    ax.set_xlim(-1.6, 7.6)
    ax.set_ylim(-1.7, 1.9)


def _element(ax):
    sketch(ax, "element, clamped at its start")
    x = np.linspace(0, 2.4, 60)
    bent = x + 1j * (-0.11 * x**2)
    curve(ax, [0, 2.4], GREY, lw=0.8, ls="--")
    curve(ax, bent, BLUE, lw=4)
    curve(ax, [-0.5j, 0.5j], INK, lw=1.6)
    for k in np.linspace(-0.45, 0.45, 7):
        curve(ax, [1j * k, -0.15 + 1j * k - 0.12j], INK, lw=0.7)
    end = bent[-1]
    arrow(ax, end, end - 0.75j, RED, width=1.8)
    label(ax, end - 0.9j, "$F$", RED)
    angle_mark(ax, end, 0.4, 1.2, -0.9, "$M_2$", ORANGE, 1.45)
    arrow(ax, 2.4 + 0j, end, GREY, style="<|-|>", width=0.9)
    label(ax, 2.17 - 0.2j, "$w_2$", GREY)
    arrow(ax, 0.28j, 2.4 + 0.28j, GREY, style="<|-|>", width=0.9)
    label(ax, 1.2 + 0.28j, "$L$", GREY)
    ax.set_xlim(-0.5, 3.3)
    ax.set_ylim(-1.8, 0.8)


def _bearing():
    figure, (left, right) = axes(1, 2, 8.6, 3.6)
    _groove_centres(left)
    bearing = catalogue.bearing("61804")
    factors = np.geomspace(10, 2000, 25)
    for clearance, style in ((0.0, "-"), (10e-6, "--")):
        found = load_curve(bearing.model_copy(update={"radial_clearance": clearance}), (0.0, -1.0, 0.0), factors)
        for stiffness, color, name in ((found.tangent, BLUE, "tangent"), (found.secant, RED, "secant")):
            right.loglog(found.load, stiffness, color=color, ls=style, label=f"{name}, clearance {1e6 * clearance:.0f} µm")
    right.set(title="61804: radial stiffness", xlabel="radial load [N]", ylabel="stiffness [N/m]")
    right.legend()
    return figure


def _groove_centres(ax):
    sketch(ax, "one ball between the grooves")
    inner, outer = -0.12 - 0.55j, 0.22 + 0.55j
    v = (outer - inner) / abs(outer - inner)
    radius = 1.62
    for centre, way, name in ((outer, -v, "inner groove"), (inner, v, "outer groove")):
        angles = np.angle(way) + np.linspace(-0.75, 0.75, 61)
        curve(ax, centre + radius * np.exp(1j * angles), INK, lw=2)
        label(ax, centre + (radius + 0.22) * way, name, INK, fontsize=8.5)
    circle(ax, 0.5 * (inner + outer), 1.06, GREY, LIGHT)
    point(ax, inner, "centre of the outer groove", 0.0 - 0.2j, BLUE)
    point(ax, outer, "centre of the inner groove", 0.0 + 0.2j, BLUE)
    arrow(ax, inner, outer, RED, width=1.8)
    label(ax, 0.5 * (inner + outer) + 0.2 - 0.02j, r"$\mathbf{v}$", RED)
    middle = 0.5 * (inner + outer)
    curve(ax, [middle - 0.95j, middle + 0.95j], GREY, lw=0.7, ls="--")
    angle_mark(ax, middle, 0.85, np.pi / 2, np.angle(v), r"$\alpha$", GREY, 1.15)
    frame(ax, -2.6 - 1.3j, 0.6, ("z", "r"))
    ax.set_xlim(-3.0, 2.6)
    ax.set_ylim(-2.1, 2.1)


# ------------------------------------------------------------------------------------------------------ static verification


def _flexibility():
    figure, (left, right) = axes(1, 2, 8.6, 3.4)
    z = np.linspace(0, 0.34, 341)
    at_rest = _at_rest(_shaft(3e7), STATIONS)
    answer = flexibility(at_rest, STATIONS, DOWN)
    for column, color, name in ((0, BLUE, "$m_1$"), (1, RED, "$m_2$")):
        line = beams.elastic_line(at_rest.model.beam, 1, answer.unknowns[:, column], z)
        left.plot(1e3 * z, -1e9 * line.deflection, color=color, label=f"unit force at {name}")
    left.axhline(0, color=GREY, lw=0.8)
    for name, place in zip("AB", PLACES, strict=True):
        left.plot(1e3 * place, 0, "^", ms=7, color=INK)
        left.annotate(name, (1e3 * place, 0), (0, -16), textcoords="offset points", ha="center")
    left.set(title="default shaft", xlabel="z [mm]", ylabel="deflection [nm/N]")
    left.invert_yaxis()
    left.legend()
    stiffness = np.geomspace(1e5, 1e12, 29)
    for shear, color, name in ((COWPER, BLUE, "Timoshenko"), (EULER_BERNOULLI, RED, "Euler-Bernoulli")):
        bend, slip = cylinder_compliances(0.02, 0.0, STEEL["modulus"], STEEL["poisson"], shear)
        off = []
        for each in stiffness:
            ours = flexibility(_at_rest(_shaft(each, shear), STATIONS), STATIONS, DOWN).delta
            exact = closed_form.flexibility(STATIONS, PLACES, (each, each), 1 / bend, 1 / slip if slip else np.inf)
            off.append(np.max(np.abs(ours - exact)) / np.max(np.abs(exact)))
        right.loglog(stiffness, np.maximum(off, 1e-17), "o-", ms=3, lw=1, color=color, label=name)
    right.set(title="difference from the closed form", xlabel="stiffness of both bearings [N/m]", ylabel="difference / largest entry [-]")
    right.set_ylim(1e-17, 1e-11)
    right.legend()
    return figure


# --------------------------------------------------------------------------------------------------------------- vibration


def _convergence():
    figure, ax = axes(1, 1, 6.0, 3.4)
    length, diameter = 1.0, 0.02
    held = tuple(Support(str(n), place, (np.inf, np.inf, np.inf if n == 0 else 0.0, 0.0, 0.0)) for n, place in enumerate((0.0, length)))
    shaft = Shaft((Section(length, diameter, diameter),), supports=held, shear=EULER_BERNOULLI, **STEEL)
    counts = np.array([2, 3, 4, 6, 8, 12, 16, 24, 32])
    numbers = np.arange(1, 5)
    exact = (numbers * np.pi / length) ** 2 * np.sqrt(STEEL["modulus"] * (diameter / 4) ** 2 / STEEL["density"]) / (2 * np.pi)
    error = np.full((len(counts), len(numbers)), np.nan)
    for row, count in enumerate(counts):
        found = modes(_at_rest(shaft, np.linspace(0, length, count + 1)), 4)
        each = found[0].frequencies[: len(numbers)]
        error[row, : len(each)] = np.abs(each / exact[: len(each)] - 1)
    for k, color in zip(range(len(numbers)), (BLUE, RED, GREEN, VIOLET), strict=True):
        ax.loglog(counts, error[:, k], "o-", ms=3.5, color=color, label=f"mode {numbers[k]}")
    ax.loglog(counts, 2.0 * counts**-4.0, color=INK, ls="--", lw=1.0, label="slope -4")
    ax.set(xlabel="elements [-]", ylabel="relative error of the frequency [-]")
    ax.set_xticks(counts, [str(each) for each in counts])
    ax.minorticks_off()
    ax.legend()
    return figure


def _campbell():
    model = dw.build(dw.load(EXAMPLES / "two_disc_rotor.toml"))
    rotor = reduced_rotor(_at_rest(model.shaft, np.linspace(0, model.shaft.length, 41)), model.places)
    rpm = np.linspace(1, 4500, 60)
    found = campbell(rotor, rpm * np.pi / 30, 2)
    figure, ax = axes(1, 1, 6.4, 3.8)
    colors = {True: BLUE, False: RED}
    for branch in range(found.frequency.shape[1]):
        forward = bool(np.nanmean(found.sense[:, branch]) > 0)
        ax.plot(rpm, found.frequency[:, branch] * 30 / np.pi, color=colors[forward])
    ax.plot(rpm, rpm, color=GREY, ls="--", lw=1.0, label="frequency = speed")
    for each in damped_critical_speeds(rotor, found):
        at = each.speed * 30 / np.pi
        ax.plot(at, at, "o", ms=5, color=colors[each.forward], mec=INK)
    ax.plot([], [], color=BLUE, label="forward whirl")
    ax.plot([], [], color=RED, label="backward whirl")
    ax.plot([], [], "o", ms=5, color="white", mec=INK, label="critical speed")
    ax.set(xlabel="speed [rpm]", ylabel="damped frequency [1/min]", xlim=(0, 4500), ylim=(0, 4500))
    ax.legend(loc="upper left")
    return figure


FIGURES = {"frames": _frames, "flexibility": _flexibility, "bearing": _bearing, "convergence": _convergence, "campbell": _campbell}
