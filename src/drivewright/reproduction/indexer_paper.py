"""The inner-translation indexing cam of Liu, Zhai, Li and Guo, figure by figure."""

from collections.abc import Callable
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np

from drivewright import registry
from drivewright._typing import Floats
from drivewright.bearings import approximate_stiffness
from drivewright.indexing import torsion_test
from drivewright.reproduction import indexer_solids as solids
from drivewright.reproduction.document import LongRows, read_paper, still
from drivewright.reproduction.figures import Chart, Curve, Stated, chart_figure
from drivewright.reproduction.views import drawing_of, scene_figure
from drivewright.result import Result, Table
from drivewright.runner import run
from drivewright.scene import Drawing
from drivewright.spec import load
from drivewright.validation import indexer_paper as numbers
from drivewright.view import draw_drawing
from drivewright.view.palette import colour
from drivewright.view.style import new_figure, styled

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Drawn

PER_ARCMIN = np.pi / 10800  # N m/arcmin in N m/rad
TO_ARCMIN = 10800 / np.pi
ANGLE = "Angle of the input [deg]"
STIFFNESS = "Torsional stiffness [N m/arcmin]"
HYSTERESIS, SCATTER = 0.05, 0.01  # arcmin: half the width of the made-up loops, and how far their readings scatter
SLEEVE = (50e-6, 91e-6)  # clearance of H7/e6 over 30 to 50 mm of diameter [m]
ROLLERS, BALLS = (25e-6, 50e-6), (5e-6, 20e-6)  # clearance of a NU207 and of a 61904 of class 0, group normal [m]
DRIVES, SEED = 60, 1
LITTLE_PLAY = 1e-6  # rad, beyond which the wheel counts as free
CYCLE = 2 * numbers.BRANCH + 1  # readings of one made-up cycle, back to its first


def preset(*changes: str) -> Any:
    """The preset of the paper with changes."""
    return load(registry.mechanism("indexer").presets()["default"], changes)


@cache
def result(*changes: str) -> Result[Any]:
    """Contacts, play, stiffness and bearing loads of the preset with changes."""
    return run(preset(*changes), ("contacts", "play", "stiffness", "bearings"))


def degrees(table: Table) -> Floats:
    """The input angle [deg] of a table."""
    return np.degrees(table["angle"].data)


# -- sections 1 and 2 ----------------------------------------------------------------------------------------------------------


def drive() -> "Drawn":
    """Fig. 1: wheel, cams, cranks."""
    return scene_figure(preset())


def input_gears() -> "Drawn":
    """The input gear between the two split gears."""
    spec = preset()
    single, spacing, teeth = drawing_of(spec, "gear"), spec.shaft_spacing / 2, spec.gear.teeth
    half = np.pi / teeth
    placed = [(0.0, 0.0, 0.0), (spacing, 0.0, np.pi + half), (-spacing, 0.0, np.pi + half)]
    shapes = tuple(shape._replace(outline=shape.outline.transformed(pose)) for pose in placed for shape in single.shapes)
    return draw_drawing(Drawing("gears", "Input gear between the two split gears", shapes))


@cache
def test_readings() -> torsion_test.Readings:
    """Three made-up cycles at each of 41 positions: the bonded model's stiffness, hysteresis and scatter on it."""
    table = result('contact.model="bonded"').tables["stiffness"]
    random, up = np.random.default_rng(SEED), np.linspace(-1000.0, 1000.0, 41)
    torque = np.tile(np.concatenate([up, up[::-1]]), 3)
    way = np.tile(np.repeat([1.0, -1.0], len(up)), 3)
    angles = [
        torque / stiffness + (way * -HYSTERESIS + random.normal(0.0, SCATTER, len(torque))) * PER_ARCMIN
        for stiffness in table["secant"].data
    ]
    crank = np.repeat(table["angle"].data, len(torque))
    return torsion_test.Readings(np.tile(torque, len(angles)), np.concatenate(angles), crank=crank)


def hysteresis_loop() -> "Drawn":
    """Fig. 6: a made-up loop with the fit of eq. (3) and its branches."""
    found = numbers.loop_evaluation()
    ends = np.array([found.angle.min(), found.angle.max()]) * TO_ARCMIN
    branch = np.linspace(-numbers.LOOP_TORQUE, numbers.LOOP_TORQUE, 2)
    middle = found.torque.mean()
    curves = [
        Curve("readings", found.angle[:CYCLE] * TO_ARCMIN, found.torque[:CYCLE]),
        Curve(f"eq. (3): {found.whole_loop.value * PER_ARCMIN:.0f} N m/arcmin", ends, middle + found.whole_loop.value * PER_ARCMIN * ends),
        Curve(f"slope of the branches: {found.per_branch.value * PER_ARCMIN:.0f}", branch / found.per_branch.value * TO_ARCMIN, branch),
    ]
    return chart_figure("A hysteresis loop and two ways to read it", "Angle of the output [arcmin]", [Chart("Torque [N m]", curves)])


def test_and_model() -> "Drawn":
    """Fig. 7: the evaluated test over the model."""
    found = torsion_test.evaluate_positions(test_readings())
    model = result('contact.model="bonded"').tables["stiffness"]
    at = np.degrees(np.array([each.crank for each in found], float))
    value, low, high = (np.array([getattr(each.per_branch, end) for each in found]) * PER_ARCMIN for end in ("value", "low", "high"))
    curves = [
        Curve("model, no separation", degrees(model), model["secant"].data * PER_ARCMIN),
        Curve("made-up test, evaluated", at, value, "points", low, high),
    ]
    chart = Chart(STIFFNESS, curves, stated_of_test())
    return chart_figure("Stiffness of 41 positions: test over model", ANGLE, [chart], height=3.4)


def stated_of_test() -> list[Stated]:
    """Statements of the text about the measured curve."""
    return [Stated("mean as printed, 747.39", y=747.39), Stated("lowest as printed, about 50°", 50.0), Stated("highest, about 145°", 145.0)]


# -- section 3 -----------------------------------------------------------------------------------------------------------------


def bearing_loads() -> "Drawn":
    """Figs. 8 to 10: loads of crank and support bearings."""
    table = result('contact.model="bonded"').tables["bearing_loads"]
    shown = degrees(table) <= 180
    names = {
        "crank, left shaft, cam 1": "crank.left.cam1",
        "support, left shaft, front": "support.left.front",
        "support, left shaft, rear": "support.left.rear",
    }
    curves = [Curve(label, degrees(table)[shown], table[name].data[shown] / 1e3) for label, name in names.items()]
    return chart_figure("Bearing loads under 1000 N m", ANGLE, [Chart("Radial load [kN]", curves)])


def bearing_stiffness() -> "Drawn":
    """Tangent stiffness of eqs. (5) and (6) under the loads."""
    table = result('contact.model="bonded"').tables["bearing_loads"]
    shown = degrees(table) <= 180
    roller = approximate_stiffness.liu_roller(np.maximum(table["crank.left.cam1"].data[shown], 1.0), 14, 8.5e-3).value
    ball = approximate_stiffness.liu_ball(np.maximum(table["support.left.front"].data[shown], 1.0), 11, 4.762e-3).value
    curves = [
        Curve("NU207E, eq. (5)", degrees(table)[shown], np.asarray(roller) / 1e6),
        Curve("61904, eq. (6)", degrees(table)[shown], np.asarray(ball) / 1e6),
    ]
    return chart_figure("Stiffness of two bearings over the index period", ANGLE, [Chart("Radial stiffness [N/µm]", curves)])


def contact_map() -> "Drawn":
    """Fig. 11: which pins touch the first cam."""
    found = result()
    table, touching = found.tables["contacts"], found.arrays["contact_map"].values
    with styled():
        figure = new_figure(3.6, "Contacts of the twelve pins with one cam")
        axis = figure.subplots()
        for index, pin in np.argwhere(touching != 0):
            role = "ink" if touching[index, pin] > 0 else "muted"
            axis.barh(pin, 4.5, left=degrees(table)[index] - 2.25, height=0.8, color=colour(role), lw=0)
        axis.set(xlabel=ANGLE, ylabel="Pin", yticks=range(12), xlim=(-2.25, 182.25))
        for angle, text in ((45, "7 pins stated"), (90, "12 pins stated")):
            axis.axvline(angle, color=colour("bad"), lw=1.0, ls=(0, (5, 3)))
            axis.annotate(text, (angle, 11.6), xytext=(3, 0), textcoords="offset points", fontsize=8, color=colour("bad"))
        counts = [f"{count:.0f}" for count in table["pins"].data]
        for number in range(0, len(counts), 5):
            axis.annotate(counts[number], (degrees(table)[number], -0.95), ha="center", fontsize=8, color=colour("muted"))
        axis.set_ylim(-1.3, 12.3)
    return figure


def play() -> "Drawn":
    """Play over the whole turn of the input, in arcmin."""
    table = result().tables["play"]
    curves = [Curve(f"{way}", degrees(table), table[way].data * TO_ARCMIN) for way in ("forward", "backward")]
    stated = [Stated("end of the index", 180.0)]
    return chart_figure("Free rotation of the wheel", ANGLE, [Chart("Play of the wheel [arcmin]", curves, stated)])


# -- section 4 -----------------------------------------------------------------------------------------------------------------


def stiffness_curves() -> "Drawn":
    """Fig. 16: bonded and unilateral contact."""
    curves = []
    for label, changes in (
        ("no separation, as in the paper", ('contact.model="bonded"',)),
        ("pins that press only, torque forward", ()),
        ("pins that press only, torque backward", ('load.torque="-1000 N m"',)),
    ):
        table = result(*changes).tables["stiffness"]
        curves.append(Curve(label, degrees(table), table["secant"].data * PER_ARCMIN))
    return chart_figure("Stiffness with load-dependent bearings", ANGLE, [Chart(STIFFNESS, curves, stated_of_test())], height=3.4)


def constant_bearings() -> "Drawn":
    """Fig. 17: constant bearing stiffness."""
    found = numbers.indexer_result(*numbers.CONSTANT)
    table, contacts = found.tables["stiffness"], found.tables["contacts"]
    stated = [Stated("as printed, about 1020", y=1020.0), Stated("highest as printed, 90°", 90.0), Stated("small as printed, 45°", 45.0)]
    charts = [
        Chart(STIFFNESS, [Curve("constant bearings, no separation", degrees(table), table["secant"].data * PER_ARCMIN)], stated),
        Chart("Pins in contact with a cam", [Curve("pins", degrees(contacts), contacts["pins"].data)], from_zero=True),
    ]
    return chart_figure("Stiffness with constant bearings, and the number of contacts", ANGLE, charts)


@cache
def clearance_band() -> tuple[Floats, Floats]:
    """(angle [deg], stiffness (drives, angles) [N m/arcmin]) after the play, clearances drawn from fits and grades."""
    random = np.random.default_rng(SEED)
    tables = []
    for _ in range(DRIVES):
        crank = random.uniform(*SLEEVE) + random.uniform(*ROLLERS)
        changes = (f'crank_bearings.radial_clearance="{crank} m"', f'support_bearings.radial_clearance="{random.uniform(*BALLS)} m"')
        tables.append(run(preset(*changes), ("stiffness",)).tables["stiffness"])
    return degrees(tables[0]), np.array([table["secant_after_play"].data for table in tables]) * PER_ARCMIN


def clearances() -> "Drawn":
    """The band of the stiffness after play, beside the drive without clearances."""
    angle, rows = clearance_band()
    table = result().tables["stiffness"]
    first = table["free_rotation"].data > LITTLE_PLAY  # of the drive without clearances: the cams do not hold the wheel here
    held = np.isfinite(table["secant"].data)
    low, middle, high = np.full((3, len(angle)), np.nan)
    carried = np.isfinite(rows).any(axis=0)
    low[carried], middle[carried], high[carried] = np.nanpercentile(rows[:, carried], (5, 50, 95), axis=0)
    curves = [Curve("without clearances", degrees(table), np.where(held, table["secant"].data, np.nan) * PER_ARCMIN)]
    for label, shown in (("with clearances, median and 5 to 95 %", held), ("the same where the wheel turns freely first", first)):
        median, *ends = (np.where(shown, each, np.nan) for each in (middle, low, high))
        curves.append(Curve(label, angle, median, "line" if shown is held else "points", ends[0], ends[1]))
    return chart_figure("Stiffness after play, 60 drives", ANGLE, [Chart(STIFFNESS, curves)], height=3.2)


# -- section 5 -----------------------------------------------------------------------------------------------------------------


def budget() -> "Drawn":
    """Compliance by groups of parts."""
    table = result('contact.model="bonded"').tables["stiffness"]
    names = ("support", "torsion", "crank", "bending", "pin", "gear")
    curves = [Curve(name, degrees(table), table[name].data * TO_ARCMIN * 1e3) for name in names]
    return chart_figure("Compliance by groups of parts", ANGLE, [Chart("Compliance [arcmin/(kN m)]", curves)], height=3.4)


DRAW: dict[str, Callable[[], Any]] = {
    "Fig. 1": drive,
    "Fig. 1, input gears": input_gears,
    "Fig. 6": hysteresis_loop,
    "Fig. 7": test_and_model,
    "Figs. 8 to 10": bearing_loads,
    "Bearing stiffness": bearing_stiffness,
    "Fig. 11": contact_map,
    "Play": play,
    "Assembly of solids": solids.assembly_stiffness,
    "Assembly of solids, by bodies": solids.assembly_bodies,
    "Fig. 16": stiffness_curves,
    "Fig. 17": constant_bearings,
    "Band of fits and grades": clearances,
    "Compliance budget": budget,
}

paper = read_paper(
    numbers.source,
    {name: still(function) for name, function in DRAW.items()},
    (LongRows("assembly of solids", solids.assembly_rows, solids=True),),
)
