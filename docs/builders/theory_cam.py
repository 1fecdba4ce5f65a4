"""Figures of the theory page on disc cams, drawn by the package's own functions."""

from collections.abc import Callable
from pathlib import Path

import numpy as np

import drivewright as dw
from drivewright import cams, curves, motion
from drivewright.cams import spring_surge

from .theory_figures import (
    BLUE,
    GREEN,
    GREY,
    INK,
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
    slideway,
    turn_axis,
    write,
)

PRESET = Path(dw.__file__).parent / "mechanisms" / "cam" / "presets" / "default.toml"
MM = 1e3


def build(docs: Path, progress: Callable[[str], None]) -> None:
    """Write the figures of the cam page to docs/theory/img."""
    write(docs, "cam", FIGURES, progress)


def _programme(rise, unit="m"):
    quarter = TURN / 4
    return motion.Programme(
        (
            motion.Segment(1.3 * quarter, "cycloidal", rise),
            motion.Segment(0.5 * quarter, "dwell"),
            motion.Segment(1.3 * quarter, "cycloidal", -rise),
            motion.Segment(0.9 * quarter, "dwell"),
        ),
        lift_unit=unit,
    )


def _outline(follower, programme):
    """Profile of a cam as complex points [m], in its own frame."""
    x, y = cams.finished_profile(follower, programme).outline.points(1e-5).T
    return x + 1j * y


def _at(follower, programme, angle):
    """The `CamContact` at a cam angle, and the turn of the cam into the machine's frame."""
    contact = follower.contact(*cams.Cycle(programme.function).at_angle(np.array([angle])))
    return contact, np.exp(1j * follower.sense * angle)


# -- frames and symbols ------------------------------------------------------------------------------------------------------


def frames():
    """The slide and the lever in the machine's frame, with the symbols of the kinematics."""
    figure, (left, right) = axes(1, 2, 9.2, 4.9)
    _slide(left)
    _lever(right)
    return figure


def _slide(ax):
    prime, radius, offset, rise, angle = 0.040, 0.008, 0.008, 0.036, np.radians(46)
    follower = cams.TranslatingRound(prime, radius, offset)
    programme = _programme(rise)
    contact, turn = _at(follower, programme, angle)
    centre, touch = contact.pitch.d0[0] * turn * MM, contact.point.d0[0] * turn * MM
    alpha = contact.pressure_angle.d0[0]
    base = np.sqrt(prime**2 - offset**2) * MM
    sketch(ax, "Roller follower on a slide")
    area(ax, _outline(follower, programme) * turn * MM)
    circle(ax, 0, prime * MM, GREY, lw=0.8, ls=(0, (6, 3)))
    label(ax, 40 * np.exp(1j * np.radians(203)), "prime circle $R$", GREY, fontsize=8.5)
    curve(ax, cams.pitch_outline(follower, programme).points(1e-5) @ [1, 1j] * turn * MM, BLUE, lw=1, ls=(0, (5, 2)))
    label(ax, 62 - 38j, "pitch curve", BLUE, fontsize=8.5)
    circle(ax, centre, radius * MM, INK, "white", zorder=3)
    curve(ax, [centre, centre + 28j], INK, lw=3.2)
    slideway(ax, centre + 17j, centre + 27j, 2.6)
    normal = (centre - touch) / abs(centre - touch)
    curve(ax, [complex(contact.lift.d1[0] * MM), centre + 30 * normal], RED, lw=0.9, ls=(0, (8, 3)))
    arrow(ax, centre, centre + 21 * normal, RED)
    label(ax, centre + 25 * normal - 4, "$N$", RED)
    angle_mark(ax, centre, 15, np.pi / 2, np.pi / 2 + alpha, r"$\alpha$", RED, 1.25)
    point(ax, centre, "$B$", 5.5 - 2.5j)
    frame(ax, 0, 16)
    curve(ax, [offset * MM, centre], GREY, lw=0.7, ls=":")
    curve(ax, [0, -8j], GREY, lw=0.6)
    dimension(ax, 0, offset * MM, "$e$", -6.5, shift=-3.2j)
    dimension(ax, offset * MM + 1j * base, offset * MM, "$s_0$", 72, shift=4)
    dimension(ax, centre, offset * MM + 1j * base, "$s$", 72, shift=4)
    pole = complex(contact.lift.d1[0] * MM)
    point(ax, pole, r"$P$", 3.5 - 4j, RED)
    angle_mark(ax, 0, 24, np.radians(112), np.radians(160), r"$\theta,\ \omega$", INK, 1.2)
    limits(ax, -56, 90, -72, 94)


def _lever(ax):
    prime, radius, pivot, arm, angle = 0.040, 0.008, 0.080, 0.062, np.radians(62)
    follower = cams.OscillatingRound(prime, radius, pivot, arm)
    programme = _programme(np.radians(22), "rad")
    contact, turn = _at(follower, programme, angle)
    centre, touch = contact.pitch.d0[0] * turn * MM, contact.point.d0[0] * turn * MM
    alpha, psi = contact.pressure_angle.d0[0], follower.rest_angle + contact.lift.d0[0]
    sketch(ax, "Roller follower on a lever")
    area(ax, _outline(follower, programme) * turn * MM)
    circle(ax, 0, prime * MM, GREY, lw=0.8, ls=(0, (6, 3)))
    curve(ax, cams.pitch_outline(follower, programme).points(1e-5) @ [1, 1j] * turn * MM, BLUE, lw=1, ls=(0, (5, 2)))
    hinge = pivot * MM + 0j
    resting = hinge - arm * MM * np.exp(-1j * follower.rest_angle)
    curve(ax, [hinge, resting], GREY, lw=1, ls=(0, (4, 3)))
    circle(ax, resting, radius * MM, GREY, lw=0.8, ls=(0, (4, 3)))
    curve(ax, [0, hinge], GREY, lw=0.8)
    curve(ax, [hinge, centre], INK, lw=3.2)
    circle(ax, centre, radius * MM, INK, "white", zorder=3)
    normal = (centre - touch) / abs(centre - touch)
    pole = pivot * MM * contact.lift.d1[0] / (1 + contact.lift.d1[0])
    curve(ax, [complex(pole), centre + 24 * normal], RED, lw=0.9, ls=(0, (8, 3)))
    point(ax, complex(pole), "$P$", -2 - 5j, RED)
    path = 1j * (centre - hinge) / abs(centre - hinge)
    path *= np.sign((path * normal.conjugate()).real)
    arrow(ax, centre, centre + 17 * normal, RED)
    label(ax, centre + 21 * normal, "$N$", RED)
    curve(ax, [centre, centre + 17 * path], GREY, lw=0.8)
    start = np.angle(path)
    angle_mark(ax, centre, 14, start, start + np.angle(normal / path), r"$\alpha$", RED)
    assert abs(abs(np.angle(normal / path)) - abs(alpha)) < 1e-9
    angle_mark(ax, hinge, 18, np.pi, np.pi - follower.rest_angle, r"$\psi_0$", GREY, 1.22)
    angle_mark(ax, hinge, 31, np.pi, np.pi - psi, r"$\psi$", INK, 1.13)
    point(ax, hinge, "$O$", 5 - 4j, size=6)
    point(ax, centre, "$B$", -6 + 2j)
    label(ax, 0.5 * (hinge + centre) + 4 + 5j, "$L$", INK)
    dimension(ax, 0, hinge, "$C$", -48, shift=0)
    frame(ax, 0, 16)
    angle_mark(ax, 0, 24, np.radians(112), np.radians(160), r"$\theta,\ \omega$", INK, 1.2)
    limits(ax, -58, 92, -64, 76)


def faces():
    """The two flat-faced followers and the rocker with its valve."""
    figure, panels = axes(1, 3, 9.6, 3.9)
    _flat_slide(panels[0])
    _flat_lever(panels[1])
    _rocker(panels[2])
    return figure


def _flat_slide(ax):
    base, rise, angle = 0.030, 0.016, np.radians(52)
    follower, programme = cams.TranslatingFlat(base), _programme(rise)
    contact, turn = _at(follower, programme, angle)
    touch, height = contact.point.d0[0] * turn * MM, contact.face[1].d0[0] * MM
    sketch(ax, "Flat face on a slide")
    area(ax, _outline(follower, programme) * turn * MM)
    circle(ax, 0, base * MM, GREY, lw=0.8, ls=(0, (6, 3)))
    curve(ax, [-26 + 1j * height, 26 + 1j * height], INK, lw=3)
    curve(ax, [1j * height, 1j * height + 24j], INK, lw=3.2)
    slideway(ax, 1j * height + 9j, 1j * height + 19j, 2.4)
    point(ax, touch, "", 0, RED)
    arrow(ax, touch, touch + 13j, RED)
    label(ax, touch + 4 + 11j, "$N$", RED)
    dimension(ax, 0, 1j * height, "$p=R+s$", 30, shift=0)
    dimension(ax, complex(touch.real), 0j, r"$\mathrm{d}s/\mathrm{d}\theta$", 9, shift=-5j)
    curve(ax, [complex(touch.real, -9), touch], RED, lw=0.7, ls=":")
    frame(ax, 0, 11)
    angle_mark(ax, 0, 18, np.radians(195), np.radians(245), r"$\theta$", INK, 1.25)
    limits(ax, -44, 46, -36, 60)


def _flat_lever(ax):
    base, pivot, aside, angle = 0.030, 0.070, 0.008, np.radians(52)
    follower = cams.OscillatingFlat(base, pivot, 0.05, aside)
    programme = _programme(np.radians(14), "rad")
    contact, turn = _at(follower, programme, angle)
    touch, psi = contact.point.d0[0] * turn * MM, follower.rest_angle + contact.lift.d0[0]
    hinge, along = pivot * MM + 0j, np.exp(1j * (np.pi - psi))
    foot = hinge + 1j * along * -aside * MM
    sketch(ax, "Flat face on a lever")
    area(ax, _outline(follower, programme) * turn * MM)
    circle(ax, 0, base * MM, GREY, lw=0.8, ls=(0, (6, 3)))
    curve(ax, [foot - 4 * along, foot + 86 * along], INK, lw=3)
    curve(ax, [hinge, foot], INK, lw=3)
    curve(ax, [hinge, hinge + 60 * along], GREY, lw=0.8, ls=(0, (4, 3)))
    curve(ax, [0, hinge], GREY, lw=0.8)
    point(ax, hinge, "$O$", 5 - 4j, size=6)
    point(ax, touch, "", 0, RED)
    normal = -1j * along
    arrow(ax, touch, touch + 13 * normal, RED)
    label(ax, touch + 17 * normal, "$N$", RED)
    dimension(ax, foot, touch, r"$\lambda$", -22, shift=0)
    label(ax, hinge + 6 + 7j, "$d$", INK)
    angle_mark(ax, hinge, 26, np.pi, np.pi - psi, r"$\psi$", INK, 1.16)
    dimension(ax, 0, hinge, "$C$", -37, shift=0)
    frame(ax, 0, 11)
    angle_mark(ax, 0, 18, np.radians(195), np.radians(245), r"$\theta$", INK, 1.25)
    limits(ax, -38, 86, -46, 60)


def _rocker(ax):
    arm, length, start, swing = 34.0, 50.0, np.radians(-16), np.radians(24)
    sketch(ax, "Rocker and valve")
    tip = [length * np.exp(-1j * (start + part)) for part in (0, swing)]
    curve(ax, [0, length + 14], GREY, lw=0.8, ls=(0, (4, 3)))
    for at, color, style in ((tip[0], GREY, (0, (4, 3))), (tip[1], INK, "-")):
        curve(ax, [0, at], color, lw=2.8 if color == INK else 1.2, ls=style)
        circle(ax, at, 4, color, "white" if color == INK else None, lw=1.1, zorder=3)
    curve(ax, [0, -arm * np.exp(1j * np.radians(8))], INK, lw=2.8)
    circle(ax, -arm * np.exp(1j * np.radians(8)), 6, INK, "white", zorder=3)
    label(ax, -arm - 1 - 14j, "cam side, arm $L$", INK, fontsize=8.5)
    stem, bottom = 4.0, tip[1].imag - 4
    area(ax, [complex(50 - stem, bottom), complex(50 + stem, bottom), complex(50 + stem, -52), complex(50 - stem, -52)], "white")
    slideway(ax, 50 - 50j, 50 - 36j, 5.5)
    point(ax, 0j, "$O$", -5 + 6j, size=6)
    label(ax, 24 + 12.5j, "$l$", INK)
    angle_mark(ax, 0, 20, 0, -start, r"$-a_0$", GREY, 1.33)
    angle_mark(ax, 0, 34, -start, -start - swing, r"$\beta$", INK, 1.13)
    dimension(ax, complex(50, tip[0].imag), complex(50, tip[1].imag), "$h$", 17, shift=4)
    arrow(ax, 64 - 22j, 64 - 40j, INK)
    label(ax, 73 - 31j, "valve\nlift", INK, fontsize=8.5)
    limits(ax, -48, 84, -54, 36)


# -- a worked example --------------------------------------------------------------------------------------------------------


def curves_of_the_example():
    """Pressure angle, curvature, force and torque of the default design."""
    result = dw.run(dw.load(PRESET))
    geometry, contact, load = (result.tables[name] for name in ("geometry", "contact", "load"))
    figure, panels = axes(2, 2, 9.0, 4.8, sharex=True)
    (pressure, bend), (force, torque) = panels
    angle = np.degrees(geometry["angle"].data)
    pressure.plot(angle, np.degrees(geometry["pressure_angle"].data), color=BLUE)
    pressure.axhline(30, color=RED, lw=1, ls="--")
    pressure.axhline(-30, color=RED, lw=1, ls="--")
    pressure.set(title="Pressure angle (limit 30°)", ylabel=r"$\alpha$ [°]")
    bend.plot(angle, geometry["curvature"].data * 8e-3, color=BLUE)
    bend.axhline(1, color=RED, lw=1, ls="--")
    bend.set(title="Roller radius times curvature of the pitch curve", ylabel=r"$r\,\kappa_p$ [-]", ylim=(-0.35, 1.15))
    bend.text(356, 1.03, "undercut", color=RED, fontsize=8.5, ha="right")
    force.plot(np.degrees(contact["angle"].data), contact["contact_force"].data, color=BLUE, label="normal force $N$")
    force.plot(np.degrees(load["angle"].data), load["required_force"].data, color=ORANGE, lw=1.1, label="force along the travel $Q$")
    force.set(title="Forces at 600 rpm", ylabel="force [N]")
    force.legend(loc="upper right")
    torque.plot(np.degrees(load["angle"].data), load["torque"].data, color=BLUE)
    torque.set(title="Torque on the cam shaft", ylabel=r"$T$ [N m]")
    for ax in (force, torque):
        turn_axis(ax)
    return figure


# -- undercut ----------------------------------------------------------------------------------------------------------------


def undercut():
    """An undercut profile under a lever: the envelope, what is left of it, lost motion and profile gap."""
    radius, pivot, arm, rise = 0.016, 0.085, 0.070, np.radians(30)
    follower = cams.OscillatingRound(0.035, radius, pivot, arm)
    there, back = (motion.Segment(np.radians(width), "cycloidal", sign * rise) for width, sign in ((35, 1), (70, -1)))
    programme = motion.Programme((there, back, motion.Segment(TURN - np.radians(105), "dwell")), lift_unit="rad")
    swept = cams.family(follower, programme)
    trimmed = curves.trim(swept)
    at, lost = curves.largest_lost_motion(trimmed, *cams.overtravel(follower, programme))
    gap = float(curves.profile_gap(trimmed, np.array([at]))[0])
    turn = np.exp(1j * at)
    planned = _at(follower, programme, at)[0].pitch.d0[0] * turn * MM
    hinge = pivot * MM + 0j
    sunk = hinge + (planned - hinge) * np.exp(1j * lost / arm)
    profile = trimmed.outline(1e-7).points(1e-5) @ [1, 1j] * turn * MM
    figure, panels = axes(1, 2, 9.0, 3.4, width_ratios=[1.1, 1])
    for ax in panels:
        sketch(ax)
        area(ax, profile)
        for piece in swept.envelope():
            curve(ax, piece.at(np.linspace(piece.start, piece.stop, 200)).d0 * turn * MM, ORANGE, lw=1)
        for place, color, style in ((planned, BLUE, "-"), (sunk, GREEN, (0, (5, 2)))):
            circle(ax, place, radius * MM, color, lw=1.2, ls=style)
            curve(ax, [hinge, place], color, lw=1, ls=style)
            point(ax, place, "", 0, color)
    whole, near = panels
    whole.set_title("Cam, lever and roller")
    near.set_title("The same at the corner of the finished profile")
    point(whole, hinge, "$O$", 6 - 3j, size=6)
    limits(whole, -42, 100, -40, 80)
    label(whole, planned + 27 + 9j, "roller in its\nplanned place", BLUE, fontsize=8.5)
    corner = profile[np.argmin(np.abs(np.abs(profile - sunk) - radius * MM))]
    on_roller = planned + radius * MM * (corner - planned) / abs(corner - planned)
    limits(near, corner.real - 1.2, corner.real + 1.2, corner.imag - 0.8, corner.imag + 0.7)
    arrow(near, corner - (sunk - planned), corner, GREEN, width=1.8)
    label(near, corner + 0.52 + 0.32j, f"lost motion\n{lost * MM:.2f} mm", GREEN)
    curve(near, [on_roller, corner], RED, lw=2.4)
    label(near, corner - 0.62 + 0.42j, f"profile gap\n{gap * MM:.2f} mm", RED)
    arrow(near, corner - 0.4 + 0.33j, 0.5 * (on_roller + corner), RED, style="-", width=0.8)
    label(near, corner - 0.35j, "finished profile", INK)
    label(near, corner - 0.95 + 0.05j, "envelope", ORANGE)
    return figure


# -- verification ------------------------------------------------------------------------------------------------------------


def verification():
    """Spring surge and residual vibration against their closed forms."""
    figure, panels = axes(2, 2, 9.0, 4.6, height_ratios=[2, 1], sharex="col")
    _surge(panels[0, 0], panels[1, 0])
    _residual(panels[0, 1], panels[1, 1])
    return figure


def _surge(ax, error):
    spring = spring_surge.SurgingSpring(6000.0, 0.06, 1e-9)
    x = np.linspace(0.02, 3.98, 900)
    ours = np.real(1 + spring.surge_factor(x * spring.frequency))
    with np.errstate(divide="ignore"):
        exact = np.pi * x / np.tan(np.pi * x)
    ax.plot(x, np.where(np.abs(exact) < 9, exact, np.nan), color=BLUE, label="closed form")
    ax.plot(x[::18], np.where(np.abs(ours[::18]) < 9, ours[::18], np.nan), "o", ms=3, color=RED, label="computed")
    ax.set(title="Dynamic stiffness of the spring", ylabel=r"$F/(k\,Y)$ [-]", ylim=(-9, 9))
    ax.legend(loc="upper left", handlelength=1.2, handletextpad=0.5)
    error.semilogy(x, np.abs(ours - exact) / (1 + np.abs(exact)) + 1e-17, color=RED, lw=0.9)
    error.set(xlabel=r"$x=\omega/\omega_1$ [-]", ylabel="relative error", ylim=(1e-17, 1e-5), xlim=(0, 4))


def _residual(ax, error):
    rise, length, speed = 0.01, TURN / 4, 50.0
    programme = motion.Programme(
        (motion.Segment(length, "cycloidal", rise), motion.Segment(length, "dwell"), motion.Segment(2 * length, "cycloidal", -rise))
    )
    cycle = cams.Cycle(programme.function)
    ratios = np.concatenate([np.linspace(0.35, 0.95, 13), np.linspace(1.05, 6.05, 51)])
    found = np.array([_left(cycle, speed, n * TURN * speed / length) for n in ratios]) / rise
    fine = np.linspace(0.3, 6.1, 1201)
    ax.plot(fine, _closed(fine), color=BLUE, label="closed form")
    ax.plot(ratios, found, "o", ms=3, color=RED, label="computed")
    ax.set(title="Vibration left behind a cycloidal rise", ylabel="amplitude / rise [-]", yscale="log", ylim=(1e-5, 3))
    ax.legend(loc="upper right")
    error.semilogy(ratios, np.abs(found - _closed(ratios)) / np.max(found) + 1e-18, color=RED, lw=0.9)
    error.set(xlabel="natural periods in the rise $n$ [-]", ylabel="error / peak", ylim=(1e-18, 1e-10), xlim=(0, 6.1))


def _closed(n):
    return np.abs(np.sin(np.pi * n)) / (np.pi * n * np.abs(n**2 - 1))


def _left(cycle, speed, frequency):
    """Amplitude [m] at the start of the dwell behind the rise."""
    response = cams.transient_response(cycle, 1.0, speed, frequency)
    return cams.free_amplitude(response, frequency)[response.piece == 1][0]


FIGURES = {"frames": frames, "faces": faces, "example": curves_of_the_example, "undercut": undercut, "verification": verification}
