"""Figures of the theory page on indexing drives, drawn by the package's own functions."""

from collections.abc import Callable
from pathlib import Path

import numpy as np

import drivewright as dw
from drivewright import indexing
from drivewright.indexing.contacts import CamContacts
from drivewright.indexing.drive_torque import TableLoad, drive_torque
from drivewright.indexing.drivetrain import Drivetrain, PowerLawBearing
from drivewright.indexing.torsion_test.regression import fit_line

from .theory_figures import (
    BLUE,
    GREEN,
    GREY,
    INK,
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
    dimension,
    frame,
    label,
    limits,
    point,
    sketch,
    turn_axis,
    write,
)

PRESETS = Path(dw.__file__).parent / "mechanisms" / "indexer" / "presets"
MM = 1e3
ARCMIN = 1 / np.radians(1 / 60)
R, E, PIN, N = 0.120, 0.010, 0.008, 12  # the default design
PARTS = {
    "pin": ("pins", BLUE),
    "crank": ("crank bearings", GREEN),
    "support": ("support bearings", ORANGE),
    "bending": ("shafts, bending", VIOLET),
    "torsion": ("shafts, torsion", RED),
    "gear": ("gears", GREY),
}


def build(docs: Path, progress: Callable[[str], None]) -> None:
    """Write the figures of the indexer page to docs/theory/img."""
    drawings = {"frames": frames, "motion": motion, "play": play, "stiffness": stiffness, "verification": verification}
    write(docs, "indexer", drawings, progress)


def _wheel(ratio=1.0):
    """The pin wheel of the default design with another ratio of motion to dwell."""
    return indexing.PinWheel(N, R, PIN, E, indexing.index_motion("modified-sine", N, ratio))


def _outline(trimmed):
    return trimmed.outline(1e-7).points(1e-4) @ [1, 1j] * MM


# -- frames ------------------------------------------------------------------------------------------------------------------


def frames():
    """The pin wheel and the parallel drive with their symbols."""
    figure, (left, right) = axes(1, 2, 9.6, 4.9, width_ratios=[1, 1.05])
    _pin_wheel(left)
    _parallel(right)
    return figure


def _pin_wheel(ax):
    radius, eccentric, pin = 0.060, 0.009, 0.0065  # coarser than the default design, to be read
    wheel = indexing.PinWheel(9, radius, pin, eccentric, indexing.index_motion("modified-sine", 9, 1.0))
    theta = np.radians(62)
    phi, centre = wheel.motion(theta), wheel.crank_vector(theta).d0 * MM
    sketch(ax, "Pin wheel, cam on a crank")
    area(ax, _outline(wheel.profile) + centre)
    circle(ax, 0, radius * MM, GREY, lw=0.8, ls=(0, (6, 3)))
    for k, at in enumerate(np.ravel(wheel.pin_centres(theta).d0) * MM):
        circle(ax, at, pin * MM, INK, "white", lw=1.1)
        if k == 0:
            label(ax, at, "0", INK, fontsize=8.5)
    pitch = complex(indexing.pitch_point(wheel, theta)) * MM
    contacts = indexing.find_contacts(wheel, theta, 1e-5)
    for at, normal in zip(contacts.centre * MM, contacts.normal, strict=True):
        curve(ax, [at, pitch], RED, lw=0.6, ls=(0, (5, 3)))
        arrow(ax, at, at + 9 * normal, RED, width=1.1)
    point(ax, pitch, "$P$", 4.5 + 1j, RED)
    curve(ax, [0, centre], INK, lw=2)
    point(ax, 0j, "$O_g$", -6 - 3j)
    point(ax, centre, "$O_b$", -6 + 1j)
    label(ax, 0.5 * centre + 4.5 - 1.5j, "$e$", INK)
    first = radius * MM * np.exp(1j * phi.d0)
    curve(ax, [0, first], GREY, lw=0.8)
    curve(ax, [0, 78], GREY, lw=0.8)
    curve(ax, [0, 30 * np.exp(1j * theta)], GREY, lw=0.6, ls=":")
    angle_mark(ax, 0, 26, 0, theta, r"$\theta$", INK, 1.17)
    angle_mark(ax, 0, 72, 0, float(phi.d0), r"$\varphi$", INK, 1.09)
    dimension(ax, 0, radius * MM * np.exp(1j * np.radians(214)), "$R$", 0)
    limits(ax, -72, 84, -72, 72)


def _parallel(ax):
    radius, pin, distance = 0.060, 0.008, 0.090
    drive = indexing.ParallelIndexer(8, radius, pin, distance, indexing.index_motion("modified-sine", 8, 1.0))
    theta = np.radians(58)
    sketch(ax, "Parallel drive, two plate cams")
    for level, fill, edge in zip(drive.levels[::-1], ("#e9edf2", "#c3ccd8"), (GREY, INK), strict=True):
        place, turn = (complex(part.d0) for part in level.pose(theta))
        area(ax, _outline(level.profile) * np.exp(1j * turn.real) + place * MM, fill, edge)
        for at in np.ravel(level.pin_centres(theta).d0) * MM:
            circle(ax, at, pin * MM, edge, "white", lw=1.1)
    circle(ax, 0, radius * MM, GREY, lw=0.8, ls=(0, (6, 3)))
    curve(ax, [0, distance * MM], GREY, lw=0.8)
    point(ax, 0j, "$O_g$", -6 - 4j, size=6)
    point(ax, complex(distance * MM), "$O_b$", 6 - 5j, size=6)
    pitch = complex(indexing.pitch_point(drive.levels[0], theta)) * MM
    point(ax, pitch, "$P$", -1 + 6j, RED)
    for level in drive.levels:
        for contact in [indexing.find_contacts(level, theta, 1e-6)]:
            for at, normal in zip(contact.centre * MM, contact.normal, strict=True):
                curve(ax, [at, pitch], RED, lw=0.6, ls=(0, (5, 3)))
                arrow(ax, at, at + 11 * normal, RED, width=1.1)
    dimension(ax, 0, complex(distance * MM), "$C$", -76)
    dimension(ax, 0, radius * MM * np.exp(1j * np.radians(190)), "$R$", 0)
    angle_mark(ax, 0, 24, np.radians(95), np.radians(140), r"$\varphi$", INK, 1.2)
    angle_mark(ax, complex(distance * MM), 17, np.radians(60), np.radians(5), r"$\theta$", INK, 1.32)
    frame(ax, -60 - 66j, 14)
    limits(ax, -72, 122, -84, 72)


# -- motion and torque -------------------------------------------------------------------------------------------------------


def motion():
    """Motion of the wheel and the torque that a dial table asks of the input."""
    drive, load, speed = indexing.index_motion("modified-sine", 4, 2.0), TableLoad(5.0, 12.0, 0.0), TURN
    found = drive_torque(drive, load, speed)
    angle = np.degrees(found.angle)
    figure, (wheel, torque) = axes(1, 2, 9.0, 2.8)
    wheel.plot(angle, np.degrees(np.asarray(drive(np.minimum(found.angle, TURN * (1 - 1e-12))).d0)), color=BLUE)
    wheel.set_ylabel(r"wheel angle $\varphi$ [°]", color=BLUE)
    wheel.set_title("Step of 90° in 240° of the input")
    rate = wheel.twinx()
    rate.plot(angle, found.wheel_speed / speed, color=ORANGE)
    rate.set_ylabel(r"$\varphi'$ [-]", color=ORANGE)
    rate.grid(False)
    rate.set_ylim(0, None)
    wheel.set_ylim(0, None)
    torque.plot(angle, found.input_torque, color=BLUE, label="input torque $T_{in}$")
    torque.plot(angle, found.table_torque, color=GREY, lw=1.1, label="torque on the table $T$")
    torque.set(title="Table of 5 kg m² and 12 N m of friction at 60 rpm", ylabel="torque [N m]")
    torque.legend(loc="upper right")
    for ax in (wheel, torque):
        turn_axis(ax, "input angle [°]")
    return figure


# -- play --------------------------------------------------------------------------------------------------------------------


def play():
    """Contacts that push either way, and the play that follows from them."""
    figure, (count, free) = axes(1, 2, 9.0, 2.9)
    wheel = _wheel()
    theta = np.radians(np.linspace(0.2, 179.8, 181))
    contacts = [indexing.find_contacts(wheel, t, 2e-6) for t in theta]
    for sign, color, text in ((1, BLUE, "push forward"), (-1, ORANGE, "push backward")):
        number = [np.count_nonzero(each.intended & (sign * each.arm > 0)) for each in contacts]
        count.step(np.degrees(theta), number, color=color, where="mid", label=text)
    count.set(title="Contacts of one cam, $r=1$", xlabel="input angle [°]", ylabel="contacts [-]", xlim=(0, 180), ylim=(0, 12))
    count.legend(loc="upper center")
    for ratio, color in ((1.0, BLUE), (2.0, GREEN), (3.0, ORANGE)):
        wheel = _wheel(ratio)
        angle = np.linspace(0, wheel.motion.motion_angle, 181)
        part = angle / wheel.motion.motion_angle
        for direction, style in ((1.0, "-"), (-1.0, "--")):
            turned = np.degrees(indexing.find_play(wheel, angle, direction)) * 60
            text = f"$r={ratio:.0f}$" if direction > 0 else None
            free.plot(part, turned, color=color, ls=style, lw=1.3, label=text)
    free.set(
        title="Play: forward solid, backward dashed", xlabel=r"part of the step $\theta/\theta_h$ [-]", ylabel="free rotation [arcmin]"
    )
    free.set_xlim(0, 1)
    free.set_ylim(0, 120)
    free.legend(loc="upper center")
    return figure


# -- stiffness ---------------------------------------------------------------------------------------------------------------


def stiffness():
    """Stiffness of the default design over the step, and where its compliance comes from."""
    tables = {model: dw.run(_spec(model), only=("stiffness",)).tables["stiffness"] for model in ("unilateral", "bonded")}
    figure, (whole, parts) = axes(1, 2, 9.0, 3.1)
    for model, color in (("bonded", GREY), ("unilateral", BLUE)):
        table = tables[model]
        angle = np.degrees(table["angle"].data)
        whole.plot(angle, table["secant"].data / ARCMIN, color=color, label=f"{model} contacts")
    whole.set(title="Secant stiffness under 1000 N m", xlabel="input angle [°]", ylabel="stiffness [N m/arcmin]", xlim=(0, 180))
    whole.set_ylim(0, None)
    whole.legend(loc="upper center")
    table = tables["unilateral"]
    shares = np.array([np.nan_to_num(table[name].data) for name in PARTS]) * ARCMIN * 1e3
    parts.stackplot(angle, shares, labels=[text for text, _ in PARTS.values()], colors=[color for _, color in PARTS.values()], alpha=0.85)
    parts.set(title="Compliance budget, unilateral contacts", xlabel="input angle [°]", ylabel="compliance [arcmin/(kN m)]", xlim=(0, 180))
    parts.legend(loc="upper right", fontsize=8)
    return figure


def _spec(model):
    return dw.load(PRESETS / "default.toml", (f"contact.model={model}",))


# -- verification ------------------------------------------------------------------------------------------------------------


def verification():
    """Crank bearings alone against the closed form, and the bias of the regression over a whole loop."""
    figure, ((stiff, bias), (error, missed)) = axes(2, 2, 9.0, 4.2, height_ratios=[2, 1], sharex="col")
    wheel_motion = indexing.index_motion("modified-sine", N, 1.0)
    theta = np.radians(np.linspace(1, 179, 90))
    k, spacing = 4.5e7, 0.110
    contacts = [_touching(wheel_motion, t) for t in theta]
    drive = Drivetrain(spacing, crank=PowerLawBearing(k))
    found = indexing.solve_torsional_stiffness(drive, theta, contacts, E, 800.0, model="bonded").secant
    reach = E / np.asarray(wheel_motion(theta).d1)
    exact = 2 * reach**2 / (1 / (2 * k) + 2 * (reach - E) ** 2 / (k * spacing**2))
    stiff.plot(np.degrees(theta), exact / ARCMIN, color=BLUE, label="closed form")
    stiff.plot(np.degrees(theta)[::4], found[::4] / ARCMIN, "o", ms=3, color=RED, label="computed")
    stiff.set(title="Only the crank bearings yield", ylabel="stiffness [N m/arcmin]", ylim=(0, None))
    stiff.legend(loc="upper center")
    error.semilogy(np.degrees(theta), np.abs(found / exact - 1) + 1e-18, color=RED, lw=0.9)
    error.set(xlabel="input angle [°]", ylabel="relative error", ylim=(1e-17, 1e-9), xlim=(0, 180))
    width = np.linspace(0, 1, 21)
    whole, branch = np.array([_regression(part) for part in width]).T
    bias.plot(width, 1 / (1 + 3 * width**2), color=BLUE, label="closed form")
    bias.plot(width, whole, "o", ms=3, color=RED, label="one line through the loop")
    bias.plot(width, branch, "s", ms=3, color=GREEN, label="slope of the branches")
    bias.set(title="Stiffness read off a hysteresis loop", ylabel="fitted / true stiffness [-]", ylim=(0, 1.1))
    bias.legend(loc="lower left")
    missed.semilogy(width, np.abs(whole - 1 / (1 + 3 * width**2)) + 1e-18, color=RED, lw=0.9)
    missed.set(xlabel=r"half width of the loop $h\,k/T_m$ [-]", ylabel="error", ylim=(1e-17, 1e-3), xlim=(0, 1))
    return figure


def _touching(wheel_motion, theta):
    """Contacts of every pin on both sides along the normal through the pitch point."""
    phi = wheel_motion(theta)
    centre = np.tile(R * np.exp(1j * (float(phi.d0) + TURN * np.arange(N) / N)), 2)
    path = 1j * (float(phi.d1) * centre - E * np.exp(1j * theta))
    normal = path * 1j / np.abs(path) * np.repeat([1.0, -1.0], N)
    none = np.zeros(2 * N)
    return CamContacts(np.tile(np.arange(N), 2), centre, normal, np.imag(np.conj(centre) * normal), none, none, none == 0)


def _regression(part, samples=4001):
    """(slope of one line through a parallelogram of half width `part`, of its branches), both over the true slope."""
    torque = np.linspace(-1, 1, samples)
    load = np.concatenate([torque, torque[::-1]])
    angle = load + part * np.repeat([1.0, -1.0], samples)
    return fit_line(angle, load).slope, fit_line(angle, load, np.repeat([0, 1], samples)).slope
