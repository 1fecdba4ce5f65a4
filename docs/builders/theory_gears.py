"""Figures of the theory page on non-circular gears, drawn by the package's own functions."""

from collections.abc import Callable
from pathlib import Path

import numpy as np

from drivewright.gears import EllipticGearPair, NonCircularPair, Rack, cut_gear
from drivewright.numerics.jets import cos

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
    label,
    limits,
    point,
    sketch,
    write,
)

MM = 1e3


def build(docs: Path, progress: Callable[[str], None]) -> None:
    """Write the figures of the gear page to docs/theory/img."""
    write(docs, "gears", {"pair": pair, "rack": rack, "undercut": undercut, "verification": verification}, progress)


def _outline(gear):
    return gear.outline(1e-7).points(2e-5) @ [1, 1j] * MM


# -- pairs -------------------------------------------------------------------------------------------------------------------


def pair():
    """Two elliptic gears in mesh, and a pair from a ratio function."""
    figure, panels = axes(1, 2, 9.4, 3.9)
    elliptic = EllipticGearPair(0.4, 0.020)
    general = NonCircularPair(lambda x: 1 + 0.2 * cos(2 * x), 0.040)
    for ax, made, teeth, title in (
        (panels[0], elliptic, 23, "Congruent ellipses, $e=0.4$"),
        (panels[1], general, 32, "Ratio $i=1+0.2\\cos2x$"),
    ):
        _meshing(ax, made, teeth, np.radians(38))
        ax.set_title(title)
    return figure


def _meshing(ax, made, teeth, x):
    driven, distance = float(made.driven(np.array(x))), made.centre_distance * MM
    first, second = (float(part.d0) * MM for part in made.radii(np.array(x)))
    sketch(ax)
    period = np.linspace(0, TURN * max(1, made.lobes[1] / made.lobes[0]), 721)
    for gear, place, turn, fill in ((1, 0j, x, "#dde5ef"), (2, complex(distance), -driven, "#f0e6da")):
        area(ax, _outline(cut_gear(made, gear, teeth)) * np.exp(1j * turn) + place, fill, INK, lw=0.9)
        curve(ax, made.pitch_curve(gear, period).d0 * MM * np.exp(1j * turn) + place, BLUE if gear == 1 else ORANGE, lw=0.9, ls=(0, (5, 2)))
        point(ax, place, "", 0, INK, 5)
    touch = complex(first)
    point(ax, touch, "", 0, RED)
    tilt = float(made.tilt(np.array(x)))
    along = 1j * np.exp(1j * tilt)
    curve(ax, [touch - 17 * along, touch + 17 * along], RED, lw=0.9, ls=(0, (6, 3)))
    curve(ax, [touch, touch + 14j], GREY, lw=0.6)
    angle_mark(ax, touch, 13, np.pi / 2, np.pi / 2 + tilt, r"$\tau$", RED, 1.25)
    low = -1j * (0.62 * distance)
    dimension(ax, low, complex(first) + low, "$r_1$", 0)
    dimension(ax, complex(first) + low, complex(distance) + low, "$r_2$", 0)
    dimension(ax, low - 6j, complex(distance) + low - 6j, "$C$", 0)
    for at in (0j, touch, complex(distance)):
        curve(ax, [at, at + low - 7j], GREY, lw=0.5)
    angle_mark(ax, 0, 8, np.radians(200), np.radians(290), "$x$", INK, 1.5)
    angle_mark(ax, complex(distance), 8, np.radians(-20), np.radians(-110), "$y$", INK, 1.5)
    limits(ax, -0.95 * distance, 1.95 * distance, -0.9 * distance, 0.85 * distance)


# -- rack --------------------------------------------------------------------------------------------------------------------


def rack():
    """The cutter tooth with its measures, in modules."""
    figure, ax = axes(1, 1, 7.2, 3.3)
    cutter = Rack()
    alpha, half, land, depth = cutter.pressure_angle, cutter.half_width, cutter.land, cutter.center_depth
    s, c = np.sin(alpha), np.cos(alpha)
    join = complex(land + cutter.rounding * c, -depth - cutter.rounding * s)
    corner = complex(land, -depth) + cutter.rounding * np.exp(1j * np.linspace(-alpha, -np.pi / 2, 31))
    top = complex(half + cutter.addendum * np.tan(alpha), cutter.addendum)
    right = [top, join, *corner]
    tooth = np.array([*right, *(-np.conj(right[::-1]))])
    sketch(ax)
    for shift in (-np.pi, 0.0, np.pi):
        area(ax, tooth + shift, LIGHT if shift == 0 else "#f1f3f6", INK if shift == 0 else GREY, lw=1.2)
    curve(ax, [-4.3, 4.3], BLUE, lw=1, ls=(0, (6, 3)))
    label(ax, 3.75 + 0.16j, "pitch line", BLUE, fontsize=8.5)
    point(ax, complex(land, -depth), "", 0, RED)
    circle(ax, complex(land, -depth), cutter.rounding, RED, lw=0.7, ls=(0, (4, 2)))
    label(ax, complex(land - 0.24, -depth + 0.16), r"$(u,-e)$", RED, fontsize=8.5)
    arrow(ax, complex(land, -depth), complex(land, -depth) + cutter.rounding * np.exp(-0.4j), RED, width=0.9)
    label(ax, complex(land + 0.62, -depth + 0.08), r"$\rho$", RED)
    dimension(ax, 0j, complex(half), "$h$", 0.32)
    curve(ax, [complex(half), complex(half, -1.1)], GREY, lw=0.6)
    angle_mark(ax, complex(half), 0.95, -np.pi / 2, -np.pi / 2 - alpha, r"$\alpha$", INK, 1.17)
    dimension(ax, -1.9 + 0j, complex(-1.9, -cutter.dedendum), "$h_d$", 0)
    dimension(ax, complex(-1.9, cutter.addendum), -1.9 + 0j, "$h_a$", 0)
    dimension(ax, 0j, complex(np.pi), "$p=\\pi m$", 0.72)
    curve(ax, [0, -1.4j], GREY, lw=0.6, ls=":")
    ax.set_title("Rack tooth of the cutter; lengths in modules, 20° full-depth profile")
    limits(ax, -4.4, 4.4, -1.6, 1.35)
    return figure


# -- undercut ----------------------------------------------------------------------------------------------------------------


def undercut():
    """Gears of 10 and 20 teeth, and the depth that undercut takes over the number of teeth."""
    figure, (small, large, depth) = axes(1, 3, 9.4, 3.1, width_ratios=[1, 1, 1.25])
    for ax, teeth in ((small, 10), (large, 20)):
        gear = cut_gear(EllipticGearPair(0.0, 0.5e-3 * teeth), 1, teeth)
        sketch(ax, f"{teeth} teeth, 20°")
        area(ax, _outline(gear) / (gear.module * MM), "#dde5ef", INK, lw=1)
        circle(ax, 0, teeth / 2, BLUE, lw=0.8, ls=(0, (5, 2)))
        for cut in gear.undercut[:1]:
            label(ax, 1j * (teeth / 2 - 2.7), f"{len(gear.undercut)} flanks\nundercut", RED, fontsize=8.5)
            assert cut.lost > 0
        limits(ax, -3.2, 3.2, teeth / 2 - 3.2, teeth / 2 + 2.2)
    depth.axhline(0, color=GREY, lw=0.8)
    for degrees, color in ((14.5, ORANGE), (20.0, BLUE)):
        tip = np.radians(degrees)
        profile = Rack(pressure_angle=tip, rounding=0.25 / (1 - np.sin(tip)))
        limit = 2 * profile.straight / np.sin(tip) ** 2
        teeth = np.unique(np.concatenate([limit * np.array([0.6, 0.75, 0.9, 1.2]), [limit, limit + 1]]).astype(int))
        lost = [_lost(profile, int(number)) for number in teeth]
        depth.plot(teeth, lost, "o-", ms=3.5, lw=1, color=color, label=f"{degrees:g}°")
        depth.axvline(limit, color=color, lw=0.8, ls="--")
    depth.set(title="Straight depth lost", xlabel="number of teeth [-]", ylabel="lost depth / module [-]")
    depth.legend(loc="upper right")
    return figure


def _lost(profile, teeth):
    """Depth of the straight flank that undercut takes, in modules."""
    gear = cut_gear(EllipticGearPair(0.0, 0.5e-3 * teeth), 1, teeth, profile)
    return max((cut.lost for cut in gear.undercut), default=0.0) / gear.module


# -- verification ------------------------------------------------------------------------------------------------------------


def verification():
    """Flanks of a circular gear against the involute, and rolling of a general pair without sliding."""
    figure, (left, right) = axes(1, 2, 9.0, 3.0)
    for teeth, color in ((20, BLUE), (31, GREEN)):
        radius, deviation = _off_involute(teeth)
        left.semilogy(radius, deviation + 1e-19, color=color, lw=1, label=f"{teeth} teeth")
    left.set(title="Generated flank less involute", xlabel="radius / pitch radius [-]", ylabel="deviation / module [-]", ylim=(1e-19, 1e-9))
    left.legend(loc="upper right")
    made = NonCircularPair(lambda x: 1 + 0.2 * cos(2 * x), 0.040)
    x = np.linspace(0, TURN, 200)
    lengths = [_length(made, gear, x) for gear in (1, 2)]
    right.semilogy(np.degrees(x), np.abs(lengths[0] - lengths[1]) / lengths[0][-1] + 1e-19, color=BLUE, lw=1, label="gear 1 less gear 2")
    error = np.abs(lengths[0] - made.arc_length(x)) / lengths[0][-1]
    right.semilogy(np.degrees(x), error + 1e-19, color=RED, lw=1, label="gear 1 less (G.3)")
    right.set(title="Arc lengths rolled, ratio $1+0.2\\cos2x$", xlabel="driver angle $x$ [°]", ylabel="difference / perimeter [-]")
    right.set_ylim(1e-19, 1e-5)
    right.legend(loc="upper right")
    return figure


def _off_involute(teeth):
    """(radius over pitch radius, deviation over module) along one flank of a circular gear."""
    gear = cut_gear(EllipticGearPair(0.0, 0.5e-3 * teeth), 1, teeth)
    span = next(each for each in gear.profile.spans if each.piece.label == "flank 0+")
    z = span.piece.at(np.linspace(span.start, span.stop, 200)).d0
    pitch = 0.5 * teeth * gear.module
    base = np.arccos(np.clip(pitch * np.cos(gear.family.rack.pressure_angle) / np.abs(z), -1, 1))
    turn = np.unwrap(np.angle(z))
    way = np.sign((turn[-1] - turn[0]) * (np.abs(z[-1]) - np.abs(z[0])))
    off = turn - way * (np.tan(base) - base)
    return np.abs(z) / pitch, np.abs(off - off[len(off) // 2]) * np.abs(z) / gear.module


def _length(made, gear, x, panels=200):
    """Length of a pitch curve from 0 to each x by Gauss's rule on its own curve, not on the common formula."""
    node, weight = np.polynomial.legendre.leggauss(8)
    half = 0.5 * np.diff(x)[:, None]
    places = x[:-1, None] + half * (1 + node)
    speed = np.abs(made.pitch_curve(gear, places).d1)
    assert len(x) == panels
    return np.append(0.0, np.cumsum(np.sum(half * weight * speed, axis=1)))
