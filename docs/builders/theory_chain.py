"""Figures of the theory pages on chains and on solids in contact, drawn by the package's own functions."""

from collections.abc import Callable
from pathlib import Path

import numpy as np

from drivewright.chains.closure.drive import close
from drivewright.chains.closure.model import Drive
from drivewright.chains.closure.positions import mesh_order, phased
from drivewright.chains.closure.strand import decay, plate_directions
from drivewright.chains.interference import seated_poses
from drivewright.chains.link import design_link, seat_height
from drivewright.chains.plate import design_plate
from drivewright.chains.sprocket import design_sprocket
from drivewright.contact.normal import KelvinVoigt
from drivewright.contact.time_step import mean_force
from drivewright.solids.contact.complementarity import solve_complementarity

from .theory_figures import (
    BLUE,
    GREEN,
    GREY,
    INK,
    LIGHT,
    ORANGE,
    RED,
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

PITCH, FLANK, APOTHEM = 9.525e-3, np.radians(30.0), 2.6e-3
RADIUS, TEETH, LINKS = 1.2e-3, (35, 37), 82
FINE = 2e-5  # [m] to which outlines are drawn


def build(docs: Path, progress: Callable[[str], None]) -> None:
    """Write the figures of both pages to docs/theory/img."""
    write(docs, "silent-chain", FIGURES, progress)
    write(docs, "contact", CONTACT_FIGURES, progress)


def _link(radius=RADIUS):
    return design_link(PITCH, radius, FLANK, APOTHEM)


def _drive(links=LINKS, radius=RADIUS):
    return Drive(_link(radius), *TEETH, links)


# ---------------------------------------------------------------------------------------------------------------- sketches


def _frames():
    figure, (left, right) = axes(1, 2, 8.8, 3.9, gridspec_kw={"width_ratios": [1.0, 1.2]})
    _joint(left)
    _seats(right)
    return figure


def _joint(ax):
    """Two plates turned by 2 t against each other, the rolling radius much enlarged."""
    sketch(ax, "joint: two pins that roll on each other")
    hole, r, t = 3.0, 0.55, 0.22
    one, other = np.exp(1j * t), np.exp(-1j * t)  # directions of the plates
    p = 0j  # right pin of the first plate
    q = p - 2 * r  # left pin of the next one, along the mean direction
    for start, end, color in ((p - hole * one, p, LIGHT), (q, q + hole * other, "#dbe7f4")):
        way = (end - start) / abs(end - start)
        around = np.linspace(0.5, 1.5, 31) * np.pi
        area(ax, [*(start + 1.0 * way * np.exp(1j * around)), *(end - 1.0 * way * np.exp(1j * around))], color, alpha=0.75)
    for pin, name, shift, color in ((p, r"$\mathbf{P}$", 0.3 - 0.25j, BLUE), (q, r"$\mathbf{Q}$", -0.3 - 0.25j, RED)):
        circle(ax, pin, r, color, "white")
        point(ax, pin, name, shift, color)
    for pin in (p - hole * one, q + hole * other):
        circle(ax, pin, 0.55, GREY, "white")
        point(ax, pin)
    curve(ax, [p - hole * one, p], GREY, lw=0.8, ls="--")
    curve(ax, [q, q + hole * other], GREY, lw=0.8, ls="--")
    curve(ax, [q - 2.2, p + 2.4], GREY, lw=0.6, ls=":")
    arrow(ax, q, p, ORANGE, width=2)
    label(ax, 0.5 * (p + q) + 0.3j, r"$2r\,\mathbf{u}$", ORANGE)
    dimension(ax, q, q + hole * other, "$A$", 1.25)
    angle_mark(ax, q, 1.9, 0.0, -t, "$t$", GREY, 1.15)
    limits(ax, -4.3, 3.4, -2.1, 2.4)


def _seats(ax):
    sketch(ax, "plates seated on the driving sprocket")
    link = _link()
    sprocket, plate = design_sprocket(link, TEETH[0]), design_plate(link)
    turn = 2 * np.pi / TEETH[0]
    outline = sprocket.outline(FINE).points(FINE)
    z = 1e3 * (outline[:, 0] + 1j * outline[:, 1])
    area(ax, z, "#eef1f4", GREY, lw=1.0)
    top = seat_height(link, TEETH[0])
    for number, pose in enumerate(seated_poses(link, TEETH[0], range(-1, 2))):
        place, direction = 1e3 * (pose[0] + 1j * pose[1]), np.exp(1j * pose[2])
        shape = plate.outline.points(FINE)
        area(ax, place + 1e3 * direction * (shape[:, 0] + 1j * shape[:, 1]), LIGHT if number % 2 else "#dbe7f4", alpha=0.8, lw=1.0)
        for side in (-1, 1):
            circle(ax, place + side * 0.5e3 * link.hole_pitch * direction, 1e3 * RADIUS, INK, "white", lw=0.9)
        if number == 1:
            middle, way = place, direction
    radial = middle / abs(middle)
    foot = middle - 7.5 * radial
    curve(ax, [foot, middle + 4.5 * radial], GREY, lw=0.7, ls="-.")
    arrow(ax, middle, middle + 3.4 * way, BLUE)
    arrow(ax, middle, middle + 3.4j * way, BLUE)
    label(ax, middle + 3.9 * way + 0.4j * way, "$x$", BLUE)
    label(ax, middle + 4.1j * way, "$y$", BLUE)
    arrow(ax, middle + 4.0 * way - 7.5 * radial, middle + 4.0 * way, RED, style="<|-", width=1.0)
    label(ax, middle + 4.9 * way - 5.8 * radial, "$h$", RED)
    contact = middle + 1e3 * _contact(link, sprocket.tooth) * way
    point(ax, contact, "", color=RED, size=5)
    arrow(ax, contact, contact + 2.6 * np.exp(-1j * FLANK) * way, RED)
    label(ax, contact + 3.1 * np.exp(-1j * FLANK) * way, r"$\mathbf{n}$", RED)
    angle_mark(ax, 0j, 1e3 * top - 6.5, np.angle(middle), np.angle(middle) - 0.5 * turn, "$t$", GREY, 0.985)
    half = 14.0
    limits(ax, middle.real - half, middle.real + half, middle.imag - 9.5, middle.imag + 7.0)


def _contact(link, tooth):
    """Where a seated plate's right flank touches its tooth, H n - rb dn/da seen from the pin frame: complex [m]."""
    normal = np.exp(-1j * FLANK)
    return tooth.support * normal + 1j * tooth.base_radius * normal - 1j * seat_height(link, tooth.teeth)


# --------------------------------------------------------------------------------------------------------- rigid closure


def _closure():
    figure, (left, right) = axes(1, 2, 8.6, 3.4)
    place = np.arange(1, 11)
    start, count = np.pi / TEETH[0], 24
    for radius, color in ((0.6e-3, GREEN), (1.2e-3, BLUE), (3.0e-3, RED)):
        hole, r = 1 + 2 * radius / PITCH, radius / PITCH  # in pitches
        bent = plate_directions(hole, r, 0.0, True, count, start, 0.0)[: len(place)]
        left.semilogy(place, np.degrees(bent), "o", ms=4, color=color, label=f"r = {1e3 * radius:g} mm")
        left.semilogy(place, np.degrees(start) * decay(hole, r, 0.0) ** place, color=color, lw=1)
    left.set(title="bend of a strand that leaves the sprocket", xlabel="free plate [-]", ylabel="angle against the force [°]")
    left.set_ylim(1e-8, 10)
    left.legend()
    counts = np.arange(70, 91)
    for radius, color in ((1.2e-3, BLUE), (3.0e-3, RED)):
        height = [1e6 * close(_drive(int(links), radius), 24).fluctuation for links in counts]
        right.plot(counts, height, "o-", ms=4, lw=1, color=color, label=f"r = {1e3 * radius:g} mm")
    right.set(title="centre distance, 35 and 37 teeth", xlabel="links [-]", ylabel="fluctuation, peak to peak [µm]", ylim=(0, None))
    right.set_xticks(counts[::4])
    right.legend()
    return figure


def _phased():
    found = close(_drive())
    figure, (left, right) = axes(1, 2, 8.6, 3.4)
    half = phased(found, 0.5)
    angle = np.degrees(half.driver_angle)
    left.plot(angle, 1e6 * half.single_error, color=GREY, label="one row")
    left.plot(angle, 1e6 * half.transmission_error, color=BLUE, label="two rows, phase 0.5")
    left.set(title="transmission error", xlabel="driver angle [°]", ylabel="error [µrad]", xlim=(0, angle[-1]))
    left.legend()
    shares = np.linspace(0, 1, 21)
    fine = np.linspace(0, 1, 201)
    for order, color in ((1, BLUE), (2, RED), (3, GREEN)):
        single = mesh_order(half.driver_angle, half.single_error, order)
        right.plot(fine, np.abs(np.cos(np.pi * order * fine)), color=color, lw=1)
        each = [phased(found, float(share)) for share in shares]
        right.plot(
            shares,
            [mesh_order(e.driver_angle, e.transmission_error, order) / single for e in each],
            "o",
            ms=4,
            color=color,
            label=f"harmonic {order}",
        )
    right.set(title="mesh orders against equation (C.13)", xlabel="phase of the second row [pitches]", ylabel="amplitude / one row [-]")
    right.legend(ncols=3, loc="upper center", fontsize=8)
    right.set_ylim(0, 1.25)
    return figure


# ------------------------------------------------------------------------------------------------------------ time stepping


def _bounce(step, phase, averaged):
    """Relative change of energy of a unit mass at speed 1 on F = k d, k = 1, by the leapfrog with contact from d = 0 on."""
    law = KelvinVoigt(1.0, 0.0)
    x, v, force = -1.0 - phase * step, 1.0, 0.0
    while v > 0 or x > -0.5:
        x += step * v
        rate = v - 0.5 * step * force  # predicted from the last acceleration
        force = mean_force(law, x, rate, step)[1] if averaged else max(x, 0.0)
        v -= step * force
    return v * v - 1.0


def _step():
    figure, ax = axes(1, 1, 6.0, 3.4)
    steps = np.geomspace(0.02, 0.4, 9)
    phases = (np.arange(16) + 0.5) / 16
    for averaged, color, name, order in ((False, RED, "force at whole steps", 2), (True, BLUE, "mean force (C.21)", 4)):
        size = np.array([np.sqrt(np.mean([_bounce(step, phase, averaged) ** 2 for phase in phases])) for step in steps])
        ax.loglog(steps, size, "o-", ms=4, color=color, label=name)
        ax.loglog(steps, 0.4 * size[-1] * (steps / steps[-1]) ** order, color=color, ls="--", lw=1, label=f"slope {order}")
    ax.set(xlabel=r"step $\times$ natural frequency [-]", ylabel="change of energy, rms over phases [-]")
    ax.set_xticks((0.02, 0.05, 0.1, 0.2, 0.4), ("0.02", "0.05", "0.1", "0.2", "0.4"))
    ax.minorticks_off()
    ax.legend()
    return figure


FIGURES = {"frames": _frames, "closure": _closure, "phased": _phased, "step": _step}


# -------------------------------------------------------------------------------------------------------- solids in contact


def _pairing():
    figure, (left, right) = axes(1, 2, 8.8, 3.5, gridspec_kw={"width_ratios": [1.0, 1.15]})
    _hats(left)
    _line_contact(right)
    return figure


def _hats(ax):
    sketch(ax, "hats of pressure between two skins")
    x = np.linspace(-3.0, 3.0, 121)
    first, second = x + 1j * (0.09 * x**2 + 0.28), x - 0.02j * x**2
    area(ax, [*first, 3.0 + 2.6j, -3.0 + 2.6j], "#dbe7f4", lw=1.2)
    area(ax, [*second, 3.0 - 1.5j, -3.0 - 1.5j], LIGHT, lw=1.2)
    nodes = np.linspace(-2.4, 2.4, 9)
    at = nodes + 1j * (0.09 * nodes**2 + 0.28)
    for place in at:
        ax.plot(place.real, place.imag, "o", ms=4, color=INK, zorder=5)
    height = np.maximum(1.0 - (nodes / 1.9) ** 2, 0.0)
    curve(ax, at + 1j * height, RED, lw=1.6)
    for k in range(1, len(nodes) - 1):
        if height[k] > 0:
            curve(ax, [at[k - 1], at[k] + 1j * height[k], at[k + 1]], RED, lw=0.7, ls="--")
    label(ax, 0.0 + 1.55j, "$p = \\sum p_i h_i$", RED)
    for place in (-1.8, 1.8):
        foot = place + 1j * (0.09 * place**2 + 0.28)
        normal = np.exp(1j * (-0.5 * np.pi + 0.5 * (0.18 - 0.04) * place))
        arrow(ax, foot, foot + normal * 0.62, BLUE, width=1.1)
        label(ax, foot + normal * 0.28 + 0.28, "$g_0$", BLUE)
    label(ax, -2.35 + 2.2j, "body 1", INK, fontsize=8.5)
    label(ax, -2.35 - 1.1j, "body 2", INK, fontsize=8.5)


def _line_contact(ax):
    """Cylinder on a half-plane in units of Hertz's half width and peak pressure: E* = 2 R p0/b, and F = pi b p0/2."""
    count, reach = 81, 1.6
    edges = np.linspace(-reach, reach, count + 1)
    x, width = 0.5 * (edges[1:] + edges[:-1]), edges[1] - edges[0]
    radius, scale = 50.0, 0.01  # lengths times `scale` enter the logarithm, whose constant is a rigid motion
    modulus = 2.0 * radius
    ahead, behind = scale * (x[:, None] - edges[None, 1:]), scale * (x[:, None] - edges[None, :-1])
    integral = (behind * (np.log(np.abs(behind)) - 1) - ahead * (np.log(np.abs(ahead)) - 1)) / scale
    flexibility = -2.0 / (np.pi * modulus) * integral * width
    gap = width * x**2 / (2.0 * radius)
    found = solve_complementarity(flexibility, gap, np.full((1, count), width), np.array([-0.5 * np.pi]), np.ones(count, bool))
    fine = np.linspace(-1, 1, 201)
    ax.plot(fine, np.sqrt(1 - fine**2), color=INK, lw=1, label="Hertz")
    ax.plot(x, found.x, "o", ms=3.5, color=RED, label="pressure")
    ax.plot(x, found.gap / width * radius, "s", ms=3, color=BLUE, label=r"gap $\times\,R/b^2$")
    ax.set(title="line contact by the quadratic programme", xlabel="place / half width [-]", ylabel="pressure / Hertz's peak, gap [-]")
    ax.legend(loc="upper right", fontsize=8)
    ax.set_ylim(-0.05, 1.3)


CONTACT_FIGURES = {"pairing": _pairing}
