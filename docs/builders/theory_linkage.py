"""Figures of the theory page on linkages, drawn by the package's own functions."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

import drivewright as dw
from drivewright.contact import impact, reynolds
from drivewright.contact.film import long_bearing, short_bearing
from drivewright.multibody import Marker, record, simulate
from drivewright.multibody.analyses.simulation_model import simulate_ideal
from drivewright.multibody.observe import PIN_FIELDS
from drivewright.oracles.linkage.four_bar_closed_form import COUPLER_TURN, ROCKER_TURN, FourBar, ideal_motion

from .theory_figures import (
    BLUE,
    GREEN,
    GREY,
    INK,
    LIGHT,
    ORANGE,
    RED,
    TURN,
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
    turn_axis,
    write,
)

PRESETS = Path(dw.__file__).parent / "mechanisms" / "linkage" / "presets"
DEFAULT = FourBar(  # the default four-bar, whose ideal motion depends on its lengths alone
    np.array([0.12, 0.04, 0.10, 0.09]), np.ones(3), np.ones(2), np.zeros(3), np.zeros(4), branch=-1.0
)


def build(docs: Path, progress: Callable[[str], None]) -> None:
    """Write the figures of the linkage page to docs/theory/img."""
    write(docs, "linkage", FIGURES, progress)


# ---------------------------------------------------------------------------------------------------------------- sketches


def _frames():
    figure, (left, right) = axes(1, 2, 8.6, 3.9, gridspec_kw={"width_ratios": [1.15, 1.0]})
    _loop(left)
    _pin(right)
    return figure


def _bar(ax, start, end, half=0.055, color=LIGHT):
    way = (end - start) / abs(end - start)
    turns = np.linspace(0.5, 1.5, 25) * np.pi
    rounded = [*(start + half * way * np.exp(1j * turns)), *(end - half * way * np.exp(1j * turns))]
    area(ax, rounded, color, lw=1.1)


def _loop(ax):
    sketch(ax, "body frame and loop")
    e2, e3, _ = (each[0] for each in ideal_motion(DEFAULT, np.array([1.15]))[0])
    unit = 25.0
    o2, o4 = 0j, unit * 0.12
    a = o2 + unit * 0.04 * e2
    b = a + unit * 0.10 * e3
    _bar(ax, o2, a)
    _bar(ax, o4, b)
    tip = a + (0.055 + 0.035j) * unit * e3
    area(ax, [a - 0.12 * e3, b + 0.12 * e3, tip + 0.1j * e3], "#dbe7f4", lw=1.1)
    for at, name, shift in ((o2, "O2", -0.25 - 0.2j), (a, "A", -0.27 + 0.02j), (b, "B", 0.27 + 0.1j), (o4, "O4", 0.3 - 0.2j)):
        circle(ax, at, 0.055, INK, "white")
        label(ax, at + shift, name)
    for support in (o2, o4):
        area(ax, [support - 0.06j, support - 0.16 - 0.3j, support + 0.16 - 0.3j], "white", lw=1.0)
        circle(ax, support, 0.055, INK, "white")
    centroid = a + (0.05 + 0.011j) * unit * e3
    frame(ax, -1.0 - 0.45j, 0.45)
    arrow(ax, -1.0 - 0.45j, centroid, BLUE)
    label(ax, 0.42 * centroid - 0.58 - 0.05j, r"$\mathbf{r}$", BLUE)
    arrow(ax, a, a + 1.05 * e3, RED)
    arrow(ax, a, a + 0.7j * e3, RED)
    curve(ax, [a, a + 1.0], GREY, lw=0.7, ls="--")
    angle_mark(ax, a, 0.8, 0.0, np.angle(e3), r"$\theta$", RED, 1.17)
    point(ax, centroid, "centroid", 0.1 - 0.21j, BLUE)
    point(ax, tip, r"$\mathbf{P}$", 0.0 + 0.23j, INK)
    for start, end, name, shift in ((o2, a, "$l_2$", 0.22), (b, o4, "$l_4$", 0.22)):
        label(ax, 0.5 * (start + end) + shift, name, GREY)
    ax.set_xlim(-1.2, 3.6)
    ax.set_ylim(-0.75, 2.75)


def _pin(ax):
    sketch(ax, "revolute joint with radial clearance")
    bearing, r_b, r_j, depth = 0j, 1.0, 0.72, 0.02
    way = np.exp(1j * np.radians(214))  # from the bearing's centre to the journal's
    journal = way * (r_b - r_j + depth)
    outline = 1.32 * np.exp(1j * np.linspace(0, TURN, 181))
    area(ax, outline, "#dbe7f4", lw=1.1)
    circle(ax, bearing, r_b, INK, "white")
    circle(ax, journal, r_j, INK, LIGHT)
    point(ax, bearing, "bearing centre", 0.05 + 0.17j, BLUE)
    point(ax, journal, "journal centre", 0.2 - 0.19j, INK)
    arrow(ax, journal, bearing, BLUE, width=1.8)
    label(ax, 0.5 * journal - 0.1 + 0.1j, r"$\mathbf{e}$", BLUE)
    touch = way * r_b
    n, t = -way, -1j * way
    arrow(ax, touch, touch + 0.55 * n, GREY)
    label(ax, touch + 0.47 * n + 0.12j, r"$\mathbf{n}$", GREY)
    arrow(ax, touch, touch + 0.5 * t, GREY)
    label(ax, touch + 0.62 * t, r"$\mathbf{t}$", GREY)
    arrow(ax, touch, touch - 0.75 * n, RED, width=1.8)
    label(ax, touch - 0.87 * n, r"$-N\,\mathbf{n}$", RED)
    arrow(ax, touch, touch - 0.5 * t, ORANGE, width=1.8)
    label(ax, touch - 0.68 * t, r"$-T\,\mathbf{t}$", ORANGE)
    end = r_b * np.exp(0.3j)
    arrow(ax, bearing, end, GREY, width=0.9)
    label(ax, 0.8 * end + 0.13j, "$R_b$", GREY)
    end = journal + r_j * np.exp(-0.75j)
    arrow(ax, journal, end, GREY, width=0.9)
    label(ax, journal + 0.75 * r_j * np.exp(-0.75j) + 0.14, "$R_j$", GREY)
    label(ax, 1.16j, "body 1: bearing", INK, fontsize=8.5)
    label(ax, journal - 0.47j + 0.05, "body 2: journal", INK, fontsize=8.5)
    ax.set_xlim(-2.0, 1.5)


# ---------------------------------------------------------------------------------------------------------- four-bar, checks


def _four_bar():
    model = dw.build(dw.load(PRESETS / "default.toml"))
    run = simulate(model.assembly, model.turn_length, samples=np.linspace(0, model.turn_length, 361))
    bodies = record(run, {"rocker": Marker("rocker"), "coupler": Marker("coupler")})
    crank = bodies.t * TURN / model.turn_length
    speed = TURN / model.turn_length
    _, v, a = ideal_motion(DEFAULT, crank)
    figure, (left, right) = axes(1, 2, 8.6, 3.3)
    for name, color, key, scale, other in (
        ("angular velocity / crank speed", BLUE, "w", speed, v),
        ("angular acceleration / crank speed²", RED, "alpha", speed**2, a),
    ):
        for body, row in (("rocker", ROCKER_TURN), ("coupler", COUPLER_TURN)):
            ours, theirs = bodies.point(body, key) / scale, other[row].real
            if body == "rocker":
                left.plot(np.degrees(crank), ours, color=color, label=name)
            error = np.abs(ours - theirs) / np.max(np.abs(theirs))
            right.semilogy(
                np.degrees(crank),
                np.maximum(error, 1e-17),
                color=color,
                lw=1.0,
                ls="-" if body == "rocker" else ":",
                label=f"{body}, {'velocity' if key == 'w' else 'acceleration'}",
            )
    left.legend(loc="upper right")
    left.set(title="rocker", ylabel="angular velocity, acceleration [-]", ylim=(-1.1, 1.9))
    right.set(title="difference from the closed form", ylabel="difference / peak [-]", ylim=(1e-17, 1e-11))
    right.legend(ncols=2, loc="upper center")
    for ax in (left, right):
        turn_axis(ax, "crank angle [°]")
    return figure


# ------------------------------------------------------------------------------------------------------------------ impacts


def _restitution():
    figure, (left, right) = axes(1, 2, 8.6, 3.5)
    asked = np.linspace(0.05, 1.0, 60)
    colors = dict(zip(("gonthier", "flores-2011", "lankarani-nikravesh", "hunt-crossley", "herbert-mcwhannell"), _PALETTE, strict=True))
    for name, color in colors.items():
        law = impact.impact_law(name)
        left.plot(asked, [impact.delivered_restitution(law.factor(e)) for e in asked], color=color, label=name)
        if name in ("gonthier", "lankarani-nikravesh", "hunt-crossley"):
            right.plot(*_impact_loop(law.factor(0.7)), color=color, label=f"{name}: {impact.delivered_restitution(law.factor(0.7)):.3f}")
    left.set(title="restitution of a free impact", xlabel="restitution asked for [-]", ylabel="restitution delivered [-]")
    left.set(xlim=(0, 1), ylim=(0, 1))
    left.legend()
    right.plot(*_impact_loop(0.0), color=GREY, ls="--", label="elastic: 1")
    right.set(title="impact with $e_r$ = 0.7 asked for", xlabel="depth / elastic depth [-]", ylabel="force / elastic peak force [-]")
    right.set(xlim=(0, 1.05), ylim=(0, 1.05))
    right.legend(title="law: restitution delivered", alignment="left")
    return figure


_PALETTE = (INK, BLUE, RED, GREEN, ORANGE)


def _impact_loop(h):
    """(depth, force) of one impact of m = 1 at speed 1 on F = K d^1.5 (1 + h v), over those of the elastic impact."""
    stiffness = 1.25  # E = K d^2.5/2.5 = 1/2 at d = 1

    def force(d, v):
        return max(stiffness * max(d, 0.0) ** 1.5 * (1 + h * v), 0.0)

    def leaves(t, y):
        return y[0]

    leaves.terminal, leaves.direction = True, -1
    run = solve_ivp(lambda t, y: [y[1], -force(*y)], (0, 20), [1e-12, 1.0], events=leaves, rtol=1e-9, atol=1e-12, max_step=0.02)
    return run.y[0], np.array([force(*row) for row in run.y.T]) / stiffness


# --------------------------------------------------------------------------------------------------------------------- films


def _film():
    figure, panels = axes(1, 2, 8.6, 3.5)
    ratios = np.linspace(0.05, 0.9, 18)
    shape = (120, 14)
    for ax, direction, title in ((panels[0], 0.5 * np.pi, "wedge: steady rotation"), (panels[1], 0.0, "squeeze: approach")):
        for slenderness, color in ((0.25, GREEN), (0.5, BLUE), (1.0, VIOLET), (4.0, RED)):
            found = reynolds.film_map(slenderness, ratios, [direction], shape)
            ax.semilogy(ratios, _size(found), color=color, label=f"L/D = {slenderness:g}")
        long = reynolds.closed_form_map(long_bearing, 1.0, ratios, [direction])
        short = reynolds.closed_form_map(short_bearing, 0.25, ratios, [direction])
        ax.semilogy(ratios, _size(long), color=INK, ls="--", lw=1.1, label="long bearing")
        ax.semilogy(ratios, _size(short), color=INK, ls=":", lw=1.4, label="short bearing, L/D = 0.25")
        ax.set(title=title, xlabel=r"eccentricity ratio $\varepsilon$ [-]", xlim=(0, 0.92))
    panels[0].set_ylabel(r"$|F|\,/\,(P\,\sqrt{a^2+b^2})$ [-]")
    panels[1].legend(ncols=1, fontsize=8, loc="lower right")
    panels[1].set_ylim(0.02, 600)
    return figure


def _size(found):
    return np.hypot(found.radial[:, 0], found.tangential[:, 0])


# ------------------------------------------------------------------------------------------------------- motion with clearance


def _clearance():
    spec = dw.load(PRESETS / "slider_crank.toml")
    model = dw.build(spec)
    turns = 4
    run = simulate(model.assembly, turns * model.turn_length, model.settings)
    pin = model.pins.index("wrist")
    whole = record(run, {"slider": Marker("slider")}, (turns - 1) * model.turn_length)
    ideal = simulate_ideal(model)
    output = model.outputs[0]
    figure, (left, right) = axes(1, 2, 8.6, 3.5, gridspec_kw={"width_ratios": [1.5, 1.0]})
    phase = (whole.t - whole.t[0]) / model.turn_length * 360
    left.plot(phase, whole.point("slider", "ax") / 1e3, color=RED, lw=0.7, label="0.5 mm radial clearance")
    shown = ideal.t <= ideal.t[0] + model.turn_length * (1 + 1e-9)
    angle = (ideal.t[shown] - ideal.t[0]) / model.turn_length * 360
    left.plot(angle, ideal.point(output.name, "ax")[shown] / 1e3, color=INK, lw=1.4, label="ideal joints")
    left.set(title="slider, turn 4", ylabel="acceleration [km/s²]")
    left.legend(loc="upper right")
    turn_axis(left, "crank angle [°]")
    depth, nx, ny = (whole.pins[:, pin, PIN_FIELDS.index(name)] for name in ("depth", "nx", "ny"))
    size = (depth + 0.5e-3) * 1e3
    right.plot(-size * nx, -size * ny, color=BLUE, lw=0.6)
    right.plot(*(0.5 * np.array([np.cos(a := np.linspace(0, TURN, 181)), np.sin(a)])), color=INK, lw=1.1)
    right.set(title="journal centre in the bearing", xlabel="x [mm]", ylabel="y [mm]", aspect="equal")
    return figure


FIGURES = {"frames": _frames, "four-bar": _four_bar, "restitution": _restitution, "film": _film, "clearance": _clearance}
