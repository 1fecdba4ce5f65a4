"""The Hy-Vo chain with a small rolling radius of An, Cheng, Li and Xu, figure by figure."""

from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from drivewright._typing import Floats
from drivewright.chains import meshing
from drivewright.chains.stress import rolling
from drivewright.report.comparison import compare
from drivewright.reproduction import hyvo_solids as solids
from drivewright.reproduction.document import Draw, LongRows, PaperStudy, read_paper, still
from drivewright.reproduction.figures import Chart, Curve, Stated, chart_figure
from drivewright.reproduction.views import drawing_of, scene_figure
from drivewright.result import Result
from drivewright.runner import run
from drivewright.validation import hyvo_model, hyvo_strength
from drivewright.validation import hyvo_paper as numbers
from drivewright.validation import hyvo_running as running
from drivewright.validation.hyvo_model import CLASSICAL_RADIUS, NEW_RADII, Z1, Z2, P
from drivewright.view import draw_drawing

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Drawn

MM, MICRO = 1e3, 1e6
RADIUS = "Rolling radius r1 [mm]"
GROUPS = np.array(NEW_RADII)


# -- sections 2 to 4 -----------------------------------------------------------------------------------------------------------


def plates() -> "Drawn":
    """Fig. 2: the plate of group 3 with its holes."""
    return draw_drawing(drawing_of(running.preset("default"), "plate"))


def meshing_scene() -> "Drawn":
    """Fig. 4: the chain on its sprockets."""
    return scene_figure(running.preset("default"))


def equivalent_pitches() -> "Drawn":
    """Fig. 3 and eqs. (3), (4): equivalent pitch over the angle of both joints."""
    turn = np.linspace(0.0, 8.0, 161)
    half = np.radians(turn)
    curves = []
    for name, radius, offset in (
        ("group 1", 1.0, hyvo_model.pin_offset(1.0)),
        ("group 3", 1.2, hyvo_model.pin_offset(1.2)),
        ("group 7", 1.6, hyvo_model.pin_offset(1.6)),
        ("control group", CLASSICAL_RADIUS, CLASSICAL_RADIUS * hyvo_model.MM * np.sin(np.radians(3.667))),
    ):
        r, hole = radius * hyvo_model.MM, meshing.hole_pitch(P, radius * hyvo_model.MM)
        pitch = hole - 2 * (r - offset * np.sin(half)) / np.cos(half)
        curves.append(Curve(name, turn, pitch * MM))
    curves.append(Curve("ideal, p/cos θ", turn, P / np.cos(half) * MM, "reference"))
    seats = [Stated(f"seat on {teeth} teeth", 180 / teeth) for teeth in (Z1, Z2)]
    chart = Chart("Equivalent pitch p'' [mm]", curves, seats)
    return chart_figure("Equivalent pitch over half the angle of a joint", "Half the relative rotation θ of two plates [deg]", [chart])


def offsets() -> "Drawn":
    """Fig. 7: pin offset over the rolling radius, with Table 2."""
    radii = np.linspace(0.9, 1.7, 41)
    printed = [float(text[1]) for text in hyvo_model.TABLE.values()]
    curves = [
        Curve("e by eq. (21)", radii, [hyvo_model.pin_offset(radius) * MM for radius in radii]),
        Curve("Table 2", GROUPS, printed, "printed"),
    ]
    return chart_figure("Pin offset over the rolling radius", RADIUS, [Chart("Pin offset e [mm]", curves)])


def deviations() -> "Drawn":
    """Fig. 8: pitch deviations over the rolling radius."""
    radii = np.linspace(0.5, 7.4, 70)
    reference = float(meshing.reference_deviation(P, Z1, Z2)) * MICRO
    curves = [
        Curve("δp2, matched on the driver (22)", radii, [hyvo_model.pitch_deviation(radius) * MICRO for radius in radii]),
        Curve("groups 1 to 7", GROUPS, [hyvo_model.pitch_deviation(radius) * MICRO for radius in GROUPS], "points"),
    ]
    boundary = float(meshing.boundary_radius(P, Z1, Z2)) * MM
    monotone = float(meshing.monotone_radius(P, Z1)) * MM
    stated = [
        Stated("δ12 = 4.06 µm printed", y=reference),
        Stated(f"r10 = {boundary:.4f} mm, as printed", boundary),
        Stated(f"p'' grows to the seat below {monotone:.4f} mm", monotone),
        Stated("holes allow 1.6 mm", 1.6),
    ]
    return chart_figure("Pitch deviations over the rolling radius", RADIUS, [Chart("Pitch deviation [µm]", curves, stated)])


# -- section 5 -----------------------------------------------------------------------------------------------------------------


@cache
def time_history(name: str, radius: float | None = None) -> tuple[Floats, Floats]:
    """(time [s], centre distance [mm]) of one run at 2000 rpm."""
    groups = (*running.OUTLINE, *running.MASSES, f'joint.rolling_radius="{radius} mm"') if radius else ()
    table = run(running.preset(name, *groups, *running.RUN, "dynamics.ensemble=1"), ("dynamics",)).tables["running"]
    return table["time"].data, table["centre_distance"].data * MM


def rigid_groups() -> "Drawn":
    """Fig. 10 without dynamics: the eight groups over a tooth, plates rigid."""
    groups = [run(running.preset("default", *running.OUTLINE, f'joint.rolling_radius="{radius} mm"'), ("closure",)) for radius in NEW_RADII]
    control = run(running.preset("classical"), ("closure",))
    labels = [*(f"group {number}" for number in range(1, 8)), "control"]
    return compare([*groups, control], labels).plot("centre_distance")


def fluctuations_in_time() -> "Drawn":
    """Fig. 10: centre distance of each group beside the control group."""
    time, control = time_history("classical")
    charts = []
    for number, radius in enumerate(NEW_RADII, 1):
        own_time, group = time_history("default", radius)
        curves = [Curve(f"group {number}", own_time[::6], group[::6]), Curve("control", time[::6], control[::6])]
        stated = [Stated("printed mean of the control group", y=219.1256)] if number == 1 else []
        charts.append(Chart("Centre distance [mm]", curves, stated, f"({'abcdefg'[number - 1]})"))
    return chart_figure("Centre distance at 2000 rpm", "Time [s]", charts, columns=2, height=2.1)


def fluctuation_over_radius(folder: Path) -> "Drawn":
    """Fig. 11: fluctuation over the rolling radius by four routes."""
    values = [each.fluctuation * MICRO for each in map(hyvo_model.rigid_closure, NEW_RADII)]
    straight = [hyvo_model.rigid_closure(radius, "straight").fluctuation * MICRO for radius in NEW_RADII]
    rest = [hyvo_model.elastic_equilibrium(radius).fluctuation * MICRO for radius in NEW_RADII]
    found = running.intervals(running.running_groups(folder), running.FLUCTUATION)
    curves = [
        Curve("rigid, straight strands", GROUPS, straight, "both"),
        Curve("rigid, strands in equilibrium", GROUPS, values, "both"),
        Curve("elastic at rest", GROUPS, rest, "both"),
        _with_ends("running at 2000 rpm", found, MICRO, 0.0),
    ]
    control = running.intervals(running.running_control(folder), running.FLUCTUATION)[0]
    rigid = hyvo_model.rigid_closure(CLASSICAL_RADIUS).fluctuation * MICRO
    elastic = hyvo_model.elastic_equilibrium(CLASSICAL_RADIUS).fluctuation * MICRO
    stated = [
        Stated("control group as printed, 20.145 µm", y=20.145),
        Stated(f"ours: control rigid, strands in equilibrium, {rigid:.1f} µm", y=rigid),
        Stated(f"ours: control running {control.value * MICRO:.1f} µm (elastic at rest {elastic:.1f})", y=control.value * MICRO),
    ]
    chart = Chart("Peak-to-peak centre distance [µm]", curves, stated, log=True)
    return chart_figure("Fluctuation of the centre distance", RADIUS, [chart], height=3.6)


def _with_ends(label: str, found: list[running.Interval], factor: float, base: float) -> Curve:
    value, low, high = (np.array([getattr(each, end) - base for each in found]) * factor for end in ("value", "low", "high"))
    return Curve(label, GROUPS, value, "both", low, high)


def means_over_radius(folder: Path) -> "Drawn":
    """Figs. 12 and 13: mean centre distance and running deviation over the rolling radius."""
    groups, control = running.running_groups(folder), running.running_control(folder)
    found, other = running.intervals(groups, running.DISTANCE), running.intervals(control, running.DISTANCE)[0]
    rest = [hyvo_model.elastic_equilibrium(radius).mean * MM for radius in NEW_RADII]
    rigid = [hyvo_model.rigid_closure(radius).mean * MM for radius in NEW_RADII]
    routes = [("rigid", rigid), ("elastic at rest", rest)]
    means = [Curve(name, GROUPS, values, "both") for name, values in routes] + [_with_ends("running at 2000 rpm", found, MM, 0.0)]
    stated = [
        Stated("control as printed, 219.1256 mm", y=219.1256),
        Stated(f"ours: control running, {other.value * MM:.4f} mm", y=other.value * MM),
    ]
    risen = [Curve(name, GROUPS, np.array(values) - 219.056, "both") for name, values in routes]
    risen.append(_with_ends("running at 2000 rpm", found, MM, running.INITIAL))
    beyond = [Stated("control as printed, 0.0696 mm", y=0.0696), Stated("ours: control running", y=other.value * MM - 219.056)]
    charts = [
        Chart("Mean centre distance [mm]", means, stated, "Fig. 12"),
        Chart("Running deviation: mean less 219.056 mm [mm]", risen, beyond, "Fig. 13"),
    ]
    return chart_figure("Mean centre distance and running deviation", RADIUS, charts, height=2.9)


# -- section 6 -----------------------------------------------------------------------------------------------------------------


def pin_stress() -> "Drawn":
    """Figs. 16, 17: von Mises stress below the contact of two pins under 200 N."""
    charts = []
    for name, radius, printed in (("group 3, pins of 1.2 mm", 1.2, 162.027), ("control group, arcs of 7.4 mm", CLASSICAL_RADIUS, 245.184)):
        contact = rolling.rolling_contact(200.0, 6e-3, (radius * 1e-3, radius * 1e-3), hyvo_model.MODULUS, hyvo_model.POISSON)
        depth = np.linspace(0.0, 6.0, 241)
        mises = rolling.equivalent(rolling.line_stresses(0.0, depth), hyvo_model.POISSON, "mises")
        stress = np.asarray(mises) * float(contact.pressure) / 1e6
        curves = [Curve("von Mises stress below the line of contact", depth * float(contact.half_width) * MICRO, stress)]
        stated = [Stated(f"maximum stress printed, {printed:.2f} MPa", y=printed), Stated("yield stress, 835 MPa", y=835.0)]
        if 6 * float(contact.half_width) * MICRO > 138.0:
            stated.append(Stated("element of the paper: 138 µm", 138.0))
        charts.append(Chart("Von Mises stress [MPa]", curves, stated, name, from_zero=True))
    return chart_figure("Stress below the rolling contact, 200 N over 6 mm", "Depth below the surface [µm]", charts, height=2.7)


@cache
def loaded(name: str) -> Result[Any]:
    """Stress and life of a plate under the paper's load case."""
    changes = running.LOAD if name == "classical" else ()
    return run(running.preset(name, *changes), ("life",))


def plate_in_time() -> "Drawn":
    """Fig. 22: maximum stress of a plate as it goes round."""
    curves = []
    for label, name in (("group 3", "paper-load"), ("control group", "classical")):
        table = loaded(name).tables["plate_history"]
        curves.append(Curve(label, table["time"].data * 1e3, table["mises"].data / 1e6))
    stated = [Stated(f"{name} as printed, {stress:.2f} MPa", y=stress) for name, stress in hyvo_strength.PLATE_STRESSES.items()]
    title = "Stress of a plate at its most stressed point over a revolution of the chain"
    return chart_figure(title, "Time [ms]", [Chart("Von Mises stress [MPa]", curves, stated)], height=3.2)


def plate_picture(name: str, plot: str) -> "Drawn":
    """Figs. 21, 24: the field of a plate."""
    return loaded(name).plot(plot)


FIGURES: dict[str, Draw] = {
    "Fig. 2": still(plates),
    "Fig. 3": still(equivalent_pitches),
    "Fig. 4": still(meshing_scene),
    "Fig. 7": still(offsets),
    "Fig. 8": still(deviations),
    "Fig. 10, rigid": still(rigid_groups),
    "Fig. 10": still(fluctuations_in_time),
    "Fig. 11": fluctuation_over_radius,
    "Figs. 12, 13": means_over_radius,
    "Figs. 16, 17": still(pin_stress),
    "Fig. 21, group 3": still(plate_picture, "paper-load", "plate_stress"),
    "Fig. 21, control group": still(plate_picture, "classical", "plate_stress"),
    "Fig. 22": still(plate_in_time),
    "Plates and pins in contact, stress": still(solids.map_of_stress),
    "Plates and pins in contact, load": still(solids.map_of_load),
    "Plates and pins in contact, life": still(solids.map_of_life),
    "Plates and pins in contact, running": still(solids.map_of_running),
    "Plate as a solid, group 3": still(solids.picture, "group 3", "solid_plate"),
    "Plate as a solid, control group": still(solids.picture, "control group", "solid_plate"),
    "Pin as a solid, group 3": still(solids.picture, "group 3", "solid_pin"),
    "Pin as a solid, control group": still(solids.picture, "control group", "solid_pin"),
    "Section through the hole": still(solids.picture, "group 3", "hole_section"),
    "Fig. 24, group 3": still(plate_picture, "paper-load", "life_map"),
    "Fig. 24, control group": still(plate_picture, "classical", "life_map"),
}

paper = read_paper(
    numbers.source,
    FIGURES,
    (
        LongRows("running", running.running_rows),
        LongRows("plates", running.plate_rows, solids=True),
        LongRows("plates and pins in contact", solids.solid_rows, solids=True),
    ),
    tuple(PaperStudy(name, study, name.startswith("load")) for name, study in running.all_studies()),
)
