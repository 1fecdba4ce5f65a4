"""The knife-folding four-bar with play of Yuan, Liu and Wang, figure by figure."""

from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from drivewright._typing import Floats
from drivewright.mechanisms.linkage.spec import LinkageSpec
from drivewright.reproduction.document import Draw, Grid, LongRows, PaperStudy, read_paper, still
from drivewright.reproduction.figures import Chart, Curve, Stated, chart_figure
from drivewright.reproduction.views import scene_figure
from drivewright.result import Result
from drivewright.runner import run
from drivewright.validation import folding_contact as contact
from drivewright.validation import folding_linkage as numbers
from drivewright.validation.folding_linkage import CALIBRATED_DAMPING, CALIBRATION_SPEED, PLAYS, TABLE

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Drawn

SPEED = "Crank speed [1000 turns/h]"
SPEEDS = np.array(list(TABLE)) / 1e3
CUT = 5.0  # of the ideal peak: where the drawing of accelerations ends
WEAR_TURNS = (1_000_000, 10_000_000)


def calibrated_damping(play: str, speed: float) -> float:
    """Damping of the massless links [N m s/rad] as calibrated."""
    return CALIBRATED_DAMPING[play] * speed / CALIBRATION_SPEED


def linkage() -> "Drawn":
    """Figs. 1, 2: the linkage to scale."""
    spec = numbers.folding_spec(CALIBRATION_SPEED, "0.20", calibrated_damping("0.20", CALIBRATION_SPEED))
    return scene_figure(spec)


@cache
def motion(kind: str) -> Result[Any]:
    """The run of Fig. 3: "stated", "calibrated" or "dry"."""
    damping = {"stated": numbers.STATED_DAMPING, "calibrated": calibrated_damping("0.20", CALIBRATION_SPEED), "dry": 0.0}[kind]
    pins = {"model": "dry", "bearing_radius": "15 mm", "friction": 0.1} if kind == "dry" else {}
    more: dict[str, object] = {"method": "radau"} if kind == "stated" else {}
    spec = numbers.folding_spec(CALIBRATION_SPEED, "0.20", damping, pins, ensemble=1, relative_tolerance=1e-6, **more)
    return run(spec, ("impact", "motion"))


def accelerations() -> "Drawn":
    """Fig. 3: angular acceleration of the knife over a turn."""
    peak = motion("stated")["knife.ideal_peak"]
    curves = []
    for label, kind in (("dry contact", "dry"), ("damping calibrated", "calibrated"), ("damping as stated", "stated")):
        table = motion(kind).tables["motion"]
        crank, value = np.degrees(table["crank_angle"].data), table["knife.alpha"].data / peak
        last = crank >= crank[-1] - 360.0
        curves.append(Curve(label, crank[last] - crank[last][0], np.clip(value[last], -CUT, CUT)))
    label = f"Angular acceleration of the knife over its ideal peak of {peak:.0f} rad/s²"
    stated = [Stated("K_d as printed, 1.9185", y=1.9185)]
    return chart_figure(
        "Acceleration of the knife, 28 800 turns/h, 0.2 mm", "Crank angle [deg]", [Chart(label, curves, stated)], height=3.6
    )


@cache
def coefficients(reading: str) -> Floats:
    """(speeds, plays) K_d with the damping as "stated" or "calibrated"."""

    def damping(speed, play):
        return numbers.STATED_DAMPING if reading == "stated" else calibrated_damping(play, speed)

    points = [(speed, play, damping(speed, play)) for speed in TABLE for play in PLAYS]
    return np.array(numbers.load_coefficients(points)).reshape(len(TABLE), len(PLAYS))


def printed_coefficients() -> Floats:
    """(speeds, plays) K_d of Table 2."""
    return np.array([[float(text) for text in row[1:]] for row in TABLE.values()])


def peaks() -> "Drawn":
    """Fig. 4: peak accelerations over speed, ours and printed."""
    edge = numbers.edge_acceleration() * (2 * np.pi * SPEEDS * 1e3 / 3600) ** 2
    printed = np.array([float(row[0]) for row in TABLE.values()])
    charts = []
    for unit, ideal, table, title in (
        ("m/s²", edge, coefficients("calibrated"), "ours, damping calibrated"),
        ("km/s²", printed, printed_coefficients(), "printed"),
    ):
        curves = [Curve("no play", SPEEDS, ideal)]
        curves += [Curve(f"{play} mm", SPEEDS, ideal * table[:, n]) for n, play in enumerate(PLAYS)]
        stated = [Stated("text: 7.0 km/s², 0.10 mm", 32.4, 7.0)] if unit == "km/s²" else []
        charts.append(Chart(f"Peak acceleration of the knife's edge [{unit}]", curves, stated, title))
    return chart_figure("Peak acceleration over speed", SPEED, charts, height=3.0)


def coefficients_over_speed() -> "Drawn":
    """K_d over speed, calibrated, with Table 2."""
    ours, printed = coefficients("calibrated"), printed_coefficients()
    curves = [Curve(f"{play} mm", SPEEDS, ours[:, n]) for n, play in enumerate(PLAYS)]
    curves.append(Curve("Table 2", np.repeat(SPEEDS, len(PLAYS)), printed.ravel(), "printed"))
    chart = Chart("Impact load coefficient K_d", curves, log=True)
    return chart_figure("K_d over speed, damping calibrated", SPEED, [chart], height=3.6)


def dry_coefficients(folder: Path) -> "Drawn":
    """K_d over speed with dry contact and intervals."""
    tables = [contact.impact_loads(folder, spec).to_pydict() for spec in contact.dry_specs().values()]
    curves = []
    for n, play in enumerate(PLAYS):
        value, low, high = (np.array([table[f"coefficient{end}"][n] for table in tables]) for end in ("", ".low", ".high"))
        curves.append(Curve(f"{play} mm", SPEEDS, value, "both", low, high))
    curves.append(Curve("Table 2", np.repeat(SPEEDS, len(PLAYS)), printed_coefficients().ravel(), "printed"))
    return chart_figure("K_d over speed, dry contact", SPEED, [Chart("Impact load coefficient K_d", curves, log=True)], height=3.8)


# -- outlook -------------------------------------------------------------------------------------------------------------------


def worn_pins(folder: Path) -> "Drawn":
    """Which pin to watch: K_d with one pin worn."""
    found = {name: contact.impact_loads(folder, spec).to_pydict() for name, spec in contact.worn_specs().items()}
    whole = contact.impact_loads(folder, contact.dry_specs()[CALIBRATION_SPEED]).to_pydict()
    names = [*(f"{name} alone" for name in found), "all three"]
    rows = [*(each for each in found.values()), {key: [values[PLAYS.index("0.20")]] for key, values in whole.items()}]
    value, low, high = (np.array([row[f"coefficient{end}"][0] for row in rows]) for end in ("", ".low", ".high"))
    curves = [Curve("0.2 mm of play, dry", np.array(names), value, "points", low, high)]
    return chart_figure("K_d with play in one pin", "Pin with play", [Chart("Impact load coefficient K_d", curves, from_zero=True)])


def oiled_pins(folder: Path) -> "Drawn":
    """K_d over the play, oil and dry."""
    oil = contact.impact_loads(folder, contact.oil_spec()).to_pydict()
    dry = contact.impact_loads(folder, contact.dry_specs()[CALIBRATION_SPEED]).to_pydict()
    curves = [
        Curve(
            "oil film, 100 mPa s",
            np.array(oil["clearance"]) * 1e3,
            oil["coefficient"],
            "both",
            oil["coefficient.low"],
            oil["coefficient.high"],
        ),
        Curve("dry", np.array(PLAYS, float), dry["coefficient"], "both", dry["coefficient.low"], dry["coefficient.high"]),
        Curve("Table 2", np.array(PLAYS, float), [float(text) for text in TABLE[CALIBRATION_SPEED][1:]], "printed"),
    ]
    return chart_figure("K_d over the play at 28 800 turns/h", "Radial play [mm]", [Chart("Impact load coefficient K_d", curves, log=True)])


def wear_spec(cycles: int) -> LinkageSpec:
    """Dry contact in A alone with wear over so many turns."""
    pins: dict[str, object] = {"model": "ideal", "bearing_radius": "15 mm", "friction": 0.1, "wear_coefficient": "1e-9 mm^3/(N m)"}
    spec = numbers.folding_spec(CALIBRATION_SPEED, "0.10", 0.0, pins, turns=8, discard=3, relative_tolerance=1e-6, ensemble=1)
    return spec.replace({"joints.A.model": "dry"}).replace(wear={"joint": "A", "cycles": cycles, "jumps": 10})


def wear() -> "Drawn":
    """Depth worn into the bearing of A around its circumference."""
    curves = []
    for cycles in WEAR_TURNS:
        table = run(wear_spec(cycles), ("wear",)).tables["wear.A"]
        curves.append(Curve(f"{cycles / 1e6:.0f} million turns", np.degrees(table["angle"].data), table["last"].data * 1e6))
    return chart_figure("Wear of the bearing of A", "Place around the bearing [deg]", [Chart("Depth worn off [µm]", curves)], height=3.0)


FIGURES: dict[str, Draw] = {
    "Figs. 1, 2": still(linkage),
    "Fig. 3": still(accelerations),
    "Fig. 4": still(peaks),
    "K_d over speed": still(coefficients_over_speed),
    "K_d, dry contact": dry_coefficients,
    "Outlook: clearance": worn_pins,
    "Outlook: oil": oiled_pins,
    "Outlook: wear": still(wear),
}


def grid(reading: str) -> Grid:
    """Table 2 under one reading."""
    rows = tuple((f"{speed}", tuple(f"K_d at {speed} r/h, r = {play} mm, {reading}" for play in PLAYS)) for speed in TABLE)
    return Grid(f"Table 2, {reading}", "turns/h", tuple(f"r = {play} mm" for play in PLAYS), rows)


ideal = Grid(
    "Table 2, ideal acceleration",
    "turns/h",
    ("ideal state",),
    tuple((f"{speed}", (f"ideal acceleration at {speed} r/h",)) for speed in TABLE),
)
paper = read_paper(
    numbers.source,
    FIGURES,
    (LongRows("dry contact", contact.dry_rows),),
    (PaperStudy("impact loads with contact", contact.compute),),
    {"3 Dynamic response": (ideal, grid("damping as stated"), grid("damping calibrated"), grid("dry contact"))},
)
