"""Figures of the theory page on the seedling pusher, drawn by the package's own functions."""

from collections.abc import Callable
from pathlib import Path

import numpy as np

import drivewright as dw
from drivewright.mechanisms.seedling_pusher.dynamics import simulate
from drivewright.oracles.seedling_pusher.rolled_motion import rolled_pair

from .theory_figures import (
    BLUE,
    GREEN,
    GREY,
    INK,
    LIGHT,
    ORANGE,
    RED,
    TURN,
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

PRESET = Path(dw.__file__).parent / "mechanisms" / "seedling_pusher" / "presets" / "default.toml"
MM = 1e3


def build(docs: Path, progress: Callable[[str], None]) -> None:
    """Write the figures of the pusher page to docs/theory/img."""
    model = dw.build(dw.load(PRESET))
    drawings = {"train": train, "cams": cams, "motion": motion, "verification": verification}
    write(docs, "pusher", {name: lambda draw=draw: draw(model) for name, draw in drawings.items()}, progress)


# -- frames ------------------------------------------------------------------------------------------------------------------


def train(model):
    """The elliptic train at one carrier angle with the track of the tip, and the symbols of its start."""
    arm, gears = model.arm, model.arm.train
    figure, (left, right) = axes(1, 2, 9.4, 4.7, width_ratios=[1, 1.1])
    start = arm.carrier_angle
    for ax, t, title in ((left, 0.0, "Start, $t=0$"), (right, np.radians(86), "End of the push, $t=86°$")):
        sketch(ax, title)
        ellipses = zip(gears.axes(np.array(t), start), gears.directions(np.array(t), start), (GREY, BLUE, GREEN), strict=True)
        for axis, direction, color in ellipses:
            focus = complex(axis.d0) * MM
            outline = focus + _ellipse(model.eccentricity, model.spec.train.semi_major) * np.exp(1j * float(direction)) * MM
            area(ax, outline, "#f3f5f8", color, lw=1.3)
        foci = [complex(axis.d0) * MM for axis in gears.axes(np.array(t), start)]
        curve(ax, foci, INK, lw=2.6)
        for name, at, aside in zip(("$O$", "$M$", "$O'$"), foci, (-4 - 5j, 5 - 5j, -5 + 5j), strict=True):
            point(ax, at, name, aside * (1 if ax is left else 2.4), size=5)
        tip = complex(arm.point(np.array(t)).d0) * MM
        needle = np.exp(-1j * float(model.needle_angle(np.array(t))))
        curve(ax, [foci[-1], tip], GREY, lw=1, ls=(0, (5, 3)))
        arrow(ax, tip - 30 * needle, tip, RED, width=1.8)
        point(ax, tip, "", 0, RED)
    track = arm.point(np.linspace(0, TURN, 361)).d0 * MM
    curve(right, track, RED, lw=1)
    label(right, complex(track.real.max() + 4, 10), "track of\nthe tip", RED, fontsize=8.5)
    foci = [complex(axis.d0) * MM for axis in gears.axes(np.array(0.0), start)]
    curve(left, [foci[0], foci[0] + 46], GREY, lw=0.7)
    angle_mark(left, foci[0], 42, 0, start, r"$\varphi_0$", INK, 1.24, style="-|>")
    out = foci[1] + 26 * np.exp(1j * start)
    curve(left, [foci[1], out], GREY, lw=0.7)
    angle_mark(left, foci[1], 21, start, start + arm.bend, "$s$", INK, 1.3)
    angle_mark(left, foci[0], 20, np.radians(160), np.radians(95), "$t$", INK, 1.28)
    tip = complex(arm.point(np.array(0.0)).d0) * MM
    label(left, foci[-1] + 0.33 * (tip - foci[-1]) + 2 + 5j, "$S$", INK)
    label(left, foci[-1] + 0.33 * (tip - foci[-1]) + 4 - 17j, "to the tip\nof the needle", RED, fontsize=8.5)
    curve(left, [foci[-1], foci[-1] + 40], GREY, lw=0.7)
    angle_mark(left, foci[-1], 36, 0, arm.start, r"$\gamma_0$", INK, 1.26)
    limits(left, -30, 92, -52, 62)
    limits(right, -45, 222, -150, 100)
    frame(left, -24 - 46j, 12)
    return figure


def _ellipse(eccentricity, semi_major):
    """An ellipse about its focus, the short focal radius along +x [m]."""
    x = np.linspace(0, TURN, 181)
    return semi_major * (1 - eccentricity**2) / (1 + eccentricity * np.cos(x)) * np.exp(1j * x)


def cams(model):
    """The two cams with the lever in the frame of the cams."""
    pair, t = model.pair, np.array(np.radians(80))
    main, back = pair.cams
    turn = complex(np.exp(-1j * (float(pair.pivot_angle(t).d0) + np.pi / 2)))  # pivot straight down
    figure, (left, right) = axes(1, 2, 9.2, 4.3, width_ratios=[1, 1])
    sketch(left, "Conjugate cams and lever, pivot turned to $-y$")
    for cam, fill, edge in ((back, "#f1f3f6", GREY), (main, LIGHT, INK)):
        area(left, model.profiles[cam.name].points(1e-5) @ [1, 1j] * turn * MM, fill, edge, lw=1.1)
    grid = np.linspace(0, TURN, 721)
    curve(left, pair.pitch(main, grid).d0 * turn * MM, BLUE, lw=0.9, ls=(0, (5, 2)))
    curve(left, pair.pitch(back, grid).d0 * turn * MM, ORANGE, lw=0.9, ls=(0, (5, 2)))
    hinge = -1j * main.pivot_distance * MM
    swing = float(pair.swing(t).d0)
    for cam, color in ((main, BLUE), (back, ORANGE)):
        roller = complex(pair.pitch(cam, t).d0) * turn * MM
        curve(left, [hinge, roller], INK, lw=2.6)
        circle(left, roller, cam.roller_radius * MM, color, "white", lw=1.3, zorder=3)
        start = np.pi / 2
        way = np.angle((roller - hinge) / 1j)
        angle_mark(left, hinge, 9, start, start + way, rf"$\psi_{1 if cam is main else 2}$", color, 1.5)
        label(left, 0.5 * (roller + hinge) + 4 * np.sign((roller - hinge).real) - 2j, f"$l_{1 if cam is main else 2}$", INK)
    side = np.sign((complex(pair.pitch(main, t).d0) * turn).real)
    curve(left, [0, hinge], GREY, lw=0.8)
    point(left, 0j, "$O'$", -5 + 4j, size=5)
    point(left, hinge, "$E$", 5 - 4j, size=5)
    dimension(left, 0j, hinge, "$a'$", 46 * side, shift=0)
    limits(left, -42, 58, -46, 44)
    grid = np.radians(np.linspace(50, 140, 721))
    right.plot(np.degrees(grid), pair.travel(grid).d0 * MM, color=BLUE)
    right.set(title="Rod travel and pressure angles", xlabel="carrier angle [°]", ylabel="rod travel $g$ [mm]", xlim=(50, 140))
    steep = right.twinx()
    steep.grid(False)
    for cam, color in ((main, GREEN), (back, ORANGE)):
        steep.plot(np.degrees(grid), np.degrees(np.abs(pair.pressure_angle(cam, grid).d0)), color=color, lw=1.2, label=f"{cam.name} cam")
    steep.set_ylabel(r"pressure angle $|\alpha|$ [°]")
    steep.set_ylim(0, None)
    steep.legend(loc="upper right")
    assert swing > 0
    return figure


# -- motion ------------------------------------------------------------------------------------------------------------------


def motion(model):
    """Planet on the carrier, rotation of the arm, needle angle."""
    t = np.linspace(0, TURN, 361)
    figure, (left, right) = axes(1, 2, 9.0, 2.8)
    left.plot(np.degrees(t), model.arm.planet(t).d1, color=BLUE)
    left.axhline(1, color=GREY, lw=0.8, ls="--")
    left.set(title="Speed ratio of planet and carrier", ylabel=r"$\mathrm{d}\varphi_3/\mathrm{d}t$ [-]")
    right.plot(np.degrees(t), np.degrees(model.arm.rotation(t).d0), color=BLUE, label="rotation of the arm $\\rho$")
    right.plot(np.degrees(t), np.degrees(model.needle_angle(t)), color=ORANGE, label="needle below the horizontal")
    for place, text in ((model.arm.lowest, "tip lowest"), (model.arm.highest, "tip highest")):
        right.axvline(np.degrees(place), color=GREY, lw=0.8, ls="--")
        right.text(np.degrees(place) + 3, 88, text, color=GREY, fontsize=8, va="top")
    right.set(title="Planting arm", ylabel="angle [°]", ylim=(-20, 90))
    right.legend(loc="upper right", bbox_to_anchor=(1, 0.9))
    for ax in (left, right):
        ax.set(xlabel="carrier angle $t$ [°]", xlim=(0, 360), xticks=np.arange(0, 361, 60))
    return figure


# -- verification ------------------------------------------------------------------------------------------------------------


def verification(model):
    """The closed form of the train against rolling by arc length; contact forces against the rigid drive."""
    figure, (left, right) = axes(1, 2, 9.0, 3.0)
    x = np.linspace(0.05, TURN - 0.05, 60)
    for e, color in ((0.05, GREEN), (model.eccentricity, BLUE), (0.5, ORANGE)):
        r = (1 - e) / (1 + e)
        closed = 2 * np.arctan2(r * np.sin(x / 2), np.cos(x / 2))
        error = np.abs(rolled_pair(e, "near")(x) - closed)
        left.semilogy(np.degrees(x), error + 1e-18, color=color, lw=1, label=f"$e={e:.3g}$")
    left.set(title="Elliptic pair: closed form less arc length", xlabel="driver angle [°]", ylabel="difference [rad]", ylim=(1e-17, 1e-6))
    left.legend(loc="upper right")
    table = dw.run(model.spec, only=("load",)).tables["load"]
    run = simulate(model, clearance=0.0)
    start = np.degrees(model.pair.start)
    for name, force, color in (("main", run.main, BLUE), ("return", run.back, ORANGE)):
        right.plot(np.degrees(table["carrier_angle"].data), table[f"{name}.force"].data, color=color, lw=2.6, alpha=0.4)
        right.plot(start + np.degrees(run.angle), force, color=color, lw=0.9, label=f"{name} cam")
    right.set(title="Normal forces: rigid (broad), with contact stiffness (thin)", xlabel="carrier angle [°]", ylabel="force [N]")
    right.set_xlim(60, 130)
    right.legend(loc="upper right")
    return figure
