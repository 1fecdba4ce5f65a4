"""The conjugate-cam seedling pusher of Chen et al., figure by figure."""

from collections.abc import Callable
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np

from drivewright import registry
from drivewright.mechanisms.seedling_pusher.dynamics import runs_with_play
from drivewright.numerics.ensemble import mean_of_members
from drivewright.oracles import seedling_pusher as oracle
from drivewright.report.comparison import compare
from drivewright.reproduction.document import read_paper, still
from drivewright.reproduction.figures import Chart, Curve, Stated, chart_figure
from drivewright.reproduction.views import drawing_of, scene_figure
from drivewright.result import Result
from drivewright.runner import build, run
from drivewright.spec import MechanismSpec, load
from drivewright.validation import pusher_paper as numbers
from drivewright.view import draw_drawing

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Drawn

MM = 1e3
CARRIER = "Carrier angle [deg]"
DRIVING = ((65.0, 86.0), (87.0, 123.0))  # carrier angles [deg] over which the main and the return cam drive
SIDES = {"rod at the needle": "default", "mirrored": "paper-mirrored"}


def spec(preset: str = "default") -> MechanismSpec:
    """The spec of a preset."""
    return load(registry.mechanism("seedling-pusher").presets()[preset])


def model(preset: str = "default") -> Any:
    """The model of a preset."""
    return build(spec(preset))


@cache
def result(preset: str = "default") -> Result[Any]:
    """Train, planting and cams of a preset."""
    return run(spec(preset), ("train", "planting", "cams"))


def arm() -> "Drawn":
    """Fig. 1: the mechanism at the start of the push."""
    return scene_figure(spec(), "machine", 65 / 360)


def rod_motion() -> "Drawn":
    """Fig. 2: rod over the carrier angle."""
    table = result().tables["cycle"]
    stated = [Stated(text, at) for text, at in (("push from 65°", 65.0), ("to 86°", 86.0), ("return to 123°", 123.0))]
    curve = Curve("rod", np.degrees(table["carrier_angle"].data), table["rod"].data * MM)
    charts = [Chart("Displacement of the rod [mm]", [curve], [*stated, Stated("18 mm", y=18.0)])]
    return chart_figure("Displacement of the rod in the planting arm", CARRIER, charts)


def planet() -> "Drawn":
    """Fig. 4: planet on the carrier."""
    table = result().tables["cycle"]
    angle, turned = np.degrees(table["carrier_angle"].data), np.degrees(table["planet_angle"].data)
    phase = np.degrees(table["planet_phase"].data) - 360.0
    curves = [Curve("from the start", angle, turned), Curve("phase, 0 or -360° where collinear", angle, phase)]
    collinear = np.degrees(result()["train.collinear_angle"])
    stated = [Stated("collinear as printed, 253°", 253.0), Stated(f"ours, {collinear:.1f}°", collinear)]
    return chart_figure("Planet relative to the carrier", CARRIER, [Chart("Angle of the planet [deg]", curves, stated[:1])], height=3.0)


def tracks() -> "Drawn":
    """Fig. 8: tracks of tip and axis in the machine and over the field."""
    found = result()
    table = found.tables["cycle"]
    tip, axis = (np.array([table[f"{name}_x"].data, table[f"{name}_y"].data]) * MM for name in ("tip", "axis"))
    field = table["field_x"].data * MM
    curves = [
        Curve("tip, machine", *tip),
        Curve("planet axis, machine", *axis),
        Curve("tip, field", field, tip[1]),
        Curve("planet axis, field", axis[0] + field - tip[0], axis[1]),
    ]
    stated = []
    for name, event, printed in (("G, printed 17.6°", "take", "needle.take_angle"), ("H, printed 67.82°", "push", "needle.push_angle")):
        at = np.degrees(found[f"needle.{event}_event"])
        place = [float(np.interp(at, np.degrees(table["carrier_angle"].data), row)) for row in tip]
        stated.append(Stated(f"{name}, ours {np.degrees(found[printed]):.2f}°", *place))
    chart = [Chart("y [mm]", curves, stated, equal=True)]
    return chart_figure("Tracks of needle tip and planet axis", "x [mm]", chart, height=5.2)


def cam(name: str) -> Callable[[], "Drawn"]:
    """Fig. 9: the drawing of a cam."""

    return lambda: draw_drawing(drawing_of(spec(), f"cam_{name}"))


def pressure_angles() -> "Drawn":
    """Pressure angles of both cams on either side."""
    charts = []
    for label, preset in SIDES.items():
        table = result(preset).tables["cams"]
        angle = np.degrees(table["carrier_angle"].data)
        shown = (angle >= 55) & (angle <= 135)
        curves = [
            Curve(f"{cam} cam", angle[shown], np.abs(np.degrees(table[f"{cam}.pressure_angle"].data[shown]))) for cam in ("main", "return")
        ]
        curves += [_largest_while_driving(curve, ends) for curve, ends in zip(curves, DRIVING, strict=True)]
        stated = [Stated("main cam as printed, 38.67°", y=38.67), Stated("return cam as printed, 30.74°", y=30.74)]
        charts.append(Chart("Pressure angle [deg]", curves, stated, label))
    return chart_figure("Pressure angles", CARRIER, charts, height=2.8)


def _largest_while_driving(curve: Curve, ends: tuple[float, float]) -> Curve:
    """The point of a cam's curve with the largest angle between the ends [deg] of the phase in which the cam drives."""
    x, y = np.asarray(curve.x, float), np.asarray(curve.y, float)
    at = int(np.argmax(np.where((x >= ends[0]) & (x <= ends[1]), y, -np.inf)))
    return Curve(f"{curve.label} while it drives: {y[at]:.2f}°", x[at : at + 1], y[at : at + 1], "points")


DESIGNS = {"as published": "default", **{f"design {letter.upper()}": f"design-{letter}" for letter in "abcd"}}


def repaired() -> "Drawn":
    """Curvature of both cams: the published design and those that repair it."""
    return compare([result(preset) for preset in DESIGNS.values()], list(DESIGNS)).plot("convexity")


def optimised() -> "Drawn":
    """Pressure angles before and after the search."""
    return compare([result(), result("design-d")], ["as published", "design D, found by the search"]).plot("pressure_angle")


def static_tracks() -> "Drawn":
    """Fig. 10a: tracks of needle tip and rod end."""
    table = result().tables["cycle"]
    curves = [
        Curve("needle tip", table["tip_x"].data * MM, table["tip_y"].data * MM),
        Curve("rod end", table["rod_end_x"].data * MM, table["rod_end_y"].data * MM),
    ]
    return chart_figure("Static tracks of needle tip and rod end", "x [mm]", [Chart("y [mm]", curves, equal=True)], height=5.2)


def prototype() -> "Drawn":
    """Fig. 10b: rod of the multibody run beside ours, and the difference."""
    shown = model()
    found = oracle.multibody_run(shown)
    at = shown.pair.start + found.angle
    order = np.argsort(at % (2 * np.pi))
    angle = np.degrees(at % (2 * np.pi))[order]
    ours, other = shown.pair.travel(at).d0[order] * MM, found.travel[order] * MM
    charts = [
        Chart("Displacement of the rod [mm]", [Curve("multibody run", angle, other), Curve("ours", angle, ours, "reference")]),
        Chart("Multibody run less ours [mm]", [Curve("difference", angle, other - ours)]),
    ]
    return chart_figure("Virtual prototype: rod displacement", CARRIER, charts)


def play() -> "Drawn":
    """Largest force over the play, with intervals."""
    plays = np.linspace(0.0, 0.1e-3, 6)
    curves = []
    for label, preset in SIDES.items():
        shown = model(preset)
        mean, half = mean_of_members(np.array([[each.peak_force for each in runs_with_play(shown, value)] for value in plays]).T)
        curves.append(Curve(label, plays * MM, mean, "both", mean - half, mean + half))
    return chart_figure("Largest normal force on a roller", "Play of each roller [mm]", [Chart("Force [N]", curves, from_zero=True)])


DRAW: dict[str, Callable[[], Any]] = {
    "Fig. 1": arm,
    "Fig. 2": rod_motion,
    "Fig. 4": planet,
    "Fig. 8": tracks,
    "Fig. 9, main cam": cam("main"),
    "Fig. 9, return cam": cam("return"),
    "Pressure angles": pressure_angles,
    "Designs A to D": repaired,
    "Before and after": optimised,
    "Fig. 10a": static_tracks,
    "Fig. 10b": prototype,
    "Play": play,
}

paper = read_paper(numbers.source, {name: still(function) for name, function in DRAW.items()})
