"""The shafts of a pipe-lining machine of Li, Zhang and Chen, figure by figure."""

from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from drivewright import registry
from drivewright._typing import Floats
from drivewright.report.comparison import compare
from drivewright.reproduction.document import Listing, LongRows, read_paper, still
from drivewright.reproduction.figures import Chart, Curve, Stated, chart_figure, draw_chart
from drivewright.reproduction.views import scene_figure
from drivewright.runner import build, run
from drivewright.shafts import closed_form, solid_check
from drivewright.spec import load
from drivewright.studies.sweeps import sweep
from drivewright.validation import shaft_model
from drivewright.validation import shaft_paper as numbers
from drivewright.validation.shaft_bearings import BEARINGS, LOADED, flexibility_on_bearings, on_bearings
from drivewright.validation.shaft_model import L1, L2, L3, L5, L6, L7, SPAN
from drivewright.validation.source import AGREES, Row, about
from drivewright.view.style import new_figure, styled
from drivewright.view.text import quantity

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Drawn

NANO = 1e9  # nm/N in m/N
MM = 1e3
SHAFTS = {"pressure-roller": ("m1", "m2"), "rubber-roller-r1": ("m3", "m4")}
TITLES = {"pressure-roller": "pressure-roller shaft", "rubber-roller-r1": "rubber-roller shaft"}
X_LABEL = "Position along the shaft [mm]"
Y_LABEL = "Flexibility: deflection per unit force [nm/N]"


def places_of(preset: str) -> list[tuple[float, str]]:
    """(x [mm], name) of the bearings and masses of a preset."""
    spec = load(registry.mechanism("shaft").presets()[preset])
    return sorted((MM * each.position, each.name) for each in (*spec.bearings, *spec.stations))


def scene(preset: str) -> "Drawn":
    """The shaft with its bearings and stations, to scale, each named."""
    figure = scene_figure(load(registry.mechanism("shaft").presets()[preset]))
    axis = figure.axes[0]
    axis.set_title("", loc="left")
    figure.suptitle("")
    for x, name in places_of(preset):
        axis.annotate(name, (x, axis.get_ylim()[1]), ha="center", va="top", fontsize=9)
    return figure


@cache
def unit_lines(preset: str, stiffness: float | None = None) -> tuple[Floats, dict[str, Floats]]:
    """(x [mm], {mass: deflection [nm/N] by a unit force there}) after Euler and Bernoulli."""
    table = shaft_model.run_preset(preset, stiffness, ("flexibility",)).tables["unit_load"]
    return table["z"].data * MM, {mass: table[mass].data * NANO for mass in SHAFTS[preset]}


def rigid_lines(preset: str) -> "Drawn":
    """Figs. 8 and 10: the line under a unit force at each mass, bearings rigid, with the formulas' values."""
    x, lines = unit_lines(preset, np.inf)
    curves = [Curve(f"force at {mass}", x, line) for mass, line in lines.items()]
    stated = {
        "pressure-roller": (Stated("eq. (3)", 0.0, 89.774), Stated("eq. (4)", 245.0, 457.184)),
        "rubber-roller-r1": (Stated("eq. (6) as printed", 53.0, 205.719),),
    }[preset]
    chart = Chart(Y_LABEL, curves, stated, places=places_of(preset))
    return chart_figure(f"Deflection by a unit force, {TITLES[preset]}, bearings rigid", X_LABEL, [chart])


def solid_line(preset: str, mass: str, stations: int = 15) -> tuple[Floats, Floats]:
    """(x [mm], deflection [nm/N] of the solid's centre line by a unit force at a mass), on the paper's springs over bands of 7 mm."""
    model = build(load(registry.mechanism("shaft").presets()[preset], (shaft_model.PRINTED_SECTION,)))
    places = sorted({*np.linspace(0.0, model.shaft.length, stations).round(4).tolist(), *model.places})
    bands = [(support.position, 7e-3, shaft_model.STIFFNESS) for support in model.shaft.supports]
    sections = [section[:4] for section in model.shaft.sections]
    found = solid_check.solid_flexibility(sections, model.shaft.modulus, model.shaft.poisson, bands, places)
    number = places.index(next(s.position for s in model.shaft.stations if s.name == mass))
    return np.array(places) * MM, found.flexibility[:, number] * NANO


def solid_rows(folder: Path) -> Iterator[Row]:
    """Section 5.2: the solid's own flexibility over the beam's, at the mass where they differ most."""
    shares = []
    for preset, masses in SHAFTS.items():
        at = {name: place for place, name in places_of(preset)}
        for mass in masses:
            shares.append(float(np.interp(at[mass], *solid_line(preset, mass))) / (shaft_model.own_flexibility(mass) * NANO))
    yield Row(
        "flexibility by solid elements over that of the beam, the farthest from 1 of four masses",
        about("consistent trends: 1 within 10 %", 1.0, 0.1),
        max(shares, key=lambda share: abs(share - 1.0)),
        "-",
        AGREES,
        "other code",
        "section 5.2",
        shaft_model.DATA,
        f"{shaft_model.READING}; springs of 3.0e7 N/m over bands of 7 mm, second-order tetrahedra",
    )


def solid_and_beam(preset: str) -> "Drawn":
    """Figs. 12 to 14: finite elements of the solid on the line of the beam."""
    charts = []
    sheared = run(load(registry.mechanism("shaft").presets()[preset], (shaft_model.PRINTED_SECTION,)), ("flexibility",)).tables["unit_load"]
    for mass in SHAFTS[preset]:
        x, lines = unit_lines(preset)
        curves = [
            Curve("beam after Euler and Bernoulli, as in the paper", x, lines[mass]),
            Curve("beam with shear, after Timoshenko", sheared["z"].data * MM, sheared[mass].data * NANO),
            Curve("solid, finite elements", *solid_line(preset, mass), "points"),
        ]
        charts.append(Chart(Y_LABEL, curves, title=f"Unit force at {mass}", places=places_of(preset)))
    return chart_figure(f"Beam and solid on the same springs, {TITLES[preset]}", X_LABEL, charts, height=2.9)


class MovedMass(NamedTuple):
    """A mass that a length places: where that is, from the left of the bearings that stand `span` apart [m]."""

    mass: str
    printed: float  # the length in Table 1 [m]
    span: float
    place: Callable[[Floats], Floats]
    ends: tuple[float, float]  # of the length [mm]
    held: str


MOVED = {
    "l1": MovedMass("m1", L1, L2, lambda length: -length, (20.0, 100.0), "A, B and m2 stay"),
    "l3": MovedMass("m2", L3, L2, lambda length: L2 + length, (50.0, 170.0), "A, B and m1 stay"),
    "l5": MovedMass("m3", L5, SPAN, lambda length: length - L5 - L6, (0.0, 110.0), "l5 + l6 = 135 mm"),
    "l7": MovedMass("m4", L7, SPAN, lambda length: length, (30.0, 260.0), "l7 + l8 = 326 mm"),
}


def mass_positions() -> "Drawn":
    """Flexibility of each mass under its own load over the length that places it, by the closed form."""
    charts = []
    for length, moved in MOVED.items():
        values = np.linspace(*moved.ends, 61)
        curves = [
            Curve(name, values, own_flexibility(moved, values / MM, stiffness) * NANO)
            for name, stiffness in (("bearings of 3.0e7 N/m", shaft_model.STIFFNESS), ("bearings rigid", np.inf))
        ]
        stated = [Stated(f"Table 1: {moved.printed * MM:g} mm", moved.printed * MM)]
        charts.append(Chart("Own flexibility [nm/N]", curves, stated, f"{length}: {moved.mass} moves, {moved.held}"))
    return chart_figure("Flexibility of each mass over its position", "Length [mm]", charts, columns=2, height=2.7)


def own_flexibility(moved: MovedMass, lengths: Floats, stiffness: float) -> Floats:
    """Flexibility [m/N] of a mass under its own load for lengths [m], after Euler and Bernoulli, both bearings of a stiffness [N/m]."""
    stations = moved.place(lengths)[:, None]
    return closed_form.flexibility(stations, (0.0, moved.span), (stiffness, stiffness), shaft_model.EI)[:, 0, 0]


EQUATIONS = {"pressure-roller": 16, "rubber-roller-r1": 17}  # that say the contribution of the bearings


def rigid_and_elastic(preset: str, folder: Path) -> "Drawn":
    """Figs. 15, 16: a study with "rigid" as one of its levels, and the masses' flexibility at the printed equations."""
    study = stiffness_study(preset, folder)
    x, _ = unit_lines(preset)
    charts = []
    for mass in SHAFTS[preset]:
        curves = [
            Curve(f"bearings of {text}" if text != "rigid" else "bearings rigid", x, unit_lines(preset, value)[1][mass])
            for text, value in (("3.0e7 N/m", None), ("1e8 N/m", 1e8), ("rigid", np.inf))
        ]
        own = shaft_model.own_flexibility(mass, np.inf) + shaft_model.literal_bearing_flexibility(mass)
        at = {name: place for place, name in places_of(preset)}[mass]
        stated = [Stated(f"eq. ({EQUATIONS[preset]}) to the letter", at, own * NANO)]
        charts.append(Chart(Y_LABEL, curves, stated, f"Unit force at {mass}", places=places_of(preset)))
    levels = np.array([1e7, 3e7, 1e8, 1e9])
    relative = {mass: np.asarray(study[f"flexibility.{mass}.{mass}"], float) for mass in SHAFTS[preset]}
    shares = [Curve(f"{mass} under its own load", levels / 1e6, each[:-1] / each[-1], "both") for mass, each in relative.items()]
    title = f"Rigid and elastic bearings, {TITLES[preset]}"
    with styled():
        figure = new_figure(9.2, title)
        axes = figure.subplots(3, 1)
        for axis, chart in zip(axes, charts, strict=False):
            draw_chart(axis, chart)
            axis.set_xlabel(X_LABEL)
        axes[2].set_xscale("log")
        draw_chart(axes[2], Chart("Flexibility over that on rigid bearings", shares, [Stated("Table 1", 30.0)]))
        axes[2].set_xlabel("Stiffness of each bearing [N/µm]")
    return figure


def stiffness_study(preset: str, folder: Path) -> Any:
    """Study of the bearings' stiffness, "rigid" as a level."""
    spec = load(registry.mechanism("shaft").presets()[preset], (shaft_model.PRINTED_SECTION, 'analysis.theory="euler-bernoulli"'))
    first, second = (f"bearings.{bearing.name}.radial_stiffness" for bearing in spec.bearings)
    vary: dict[str, Any] = {f"{first}+{second}": ["1e7 N/m", "3e7 N/m", "1e8 N/m", "1e9 N/m", "rigid"]}
    return sweep(spec, vary, out=folder / "studies" / f"stiffness-{preset}", on="serial")


def bearing_types(preset: str) -> "Drawn":
    """Figs. 17, 18: the four types of bearings under 500 N at one mass, tangent flexibility there; dashed: rigid, free to tilt."""
    return compare([on_bearings(preset, each, LOADED[preset]) for each in BEARINGS.values()], list(BEARINGS)).plot("unit_load")


def bearing_table() -> tuple[tuple[str, ...], list[list[str]]]:
    """Flexibility of each mass under its own load, and the bearings' stiffness, for the four types and rigid supports."""
    heads, rows = ("", *BEARINGS, "rigid, free to tilt"), []
    for masses in SHAFTS.values():
        for mass in masses:
            own = [flexibility_on_bearings(mass, each) for each in BEARINGS.values()]
            values = [*own, shaft_model.own_flexibility(mass, np.inf)]
            rows.append([f"flexibility of {mass} under its own load", *(quantity(value, "m/N", 4) for value in values)])
    for preset, mass in LOADED.items():
        for support in load(registry.mechanism("shaft").presets()[preset]).bearings:
            found = [on_bearings(preset, each, mass)[f"bearings.{support.name}.stiffness.tangent"] for each in BEARINGS.values()]
            rows.append([f"tangent stiffness of {support.name}", *(quantity(value, "N/m", 4) for value in found), "∞"])
    return heads, rows


FIGURES = {
    "Fig. 5": still(scene, "pressure-roller"),
    "Fig. 6": still(scene, "rubber-roller-r1"),
    "Fig. 8": still(rigid_lines, "pressure-roller"),
    "Fig. 10": still(rigid_lines, "rubber-roller-r1"),
    "Fig. 13": still(solid_and_beam, "pressure-roller"),
    "Fig. 14": still(solid_and_beam, "rubber-roller-r1"),
    "Figs. 13, 14 over lengths": still(mass_positions),
    "Fig. 15": lambda folder: rigid_and_elastic("pressure-roller", folder),
    "Fig. 16": lambda folder: rigid_and_elastic("rubber-roller-r1", folder),
    "Fig. 17": still(bearing_types, "pressure-roller"),
    "Fig. 18": still(bearing_types, "rubber-roller-r1"),
}

paper = read_paper(
    numbers.source,
    FIGURES,
    (LongRows("solid elements", solid_rows, solids=True),),
    listings={
        "5.3 Influence of the bearings": (
            Listing(
                "four types of bearings",
                "Four types of bearings of one size",
                lambda folder: bearing_table(),
                "Under 500 N at m2 and at m3; tapered and angular-contact bearings stand back to back without preload. A bearing's "
                "stiffness is that at its own load. The tapered bearing has 17 rollers of 4 mm, the cylindrical one 16 of 3.2 mm, the "
                "others the balls of a 61804. Inclined bearings act at their pressure centres, not at their middles, and so change the "
                "span: a stiffer bearing may then make a mass more flexible.",
            ),
        )
    },
)
