"""The Hy-Vo paper's plates and pins as solids in contact: stress and life over what the paper leaves out, and rows of section 6.

The new chain is group 3, the classical one the control group; plates are drawn by us with one outer profile.  At rest every plate is
pulled by 200 N, the paper's F1; running, it bears what the chain under the paper's load case does to it.
"""

from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from drivewright import registry
from drivewright._typing import Floats
from drivewright.chains.solid.assumptions import over_fits, peaks
from drivewright.chains.solid.history import SolidHistory, skin_life
from drivewright.chains.solid.joint import Fit
from drivewright.chains.solid.pitch import PlateAndPins
from drivewright.chains.stress.plate import Loads
from drivewright.chains.stress.revolution import PlateRevolution, loads_at
from drivewright.errors import InputError
from drivewright.mechanisms.silent_chain.build import ChainModel
from drivewright.mechanisms.silent_chain.solid import condensed, steps
from drivewright.mechanisms.silent_chain.stress import card_of, plate_revolution
from drivewright.reproduction.figures import Chart, Curve, Stated, chart_figure
from drivewright.result import Result
from drivewright.runner import build, run
from drivewright.validation import hyvo_running as running
from drivewright.validation.hyvo_strength import PLATE_STRESSES
from drivewright.validation.source import ABOVE_ONE, BELOW_ONE, OPEN, Printed, Row, rounded

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Drawn

DESIGNS = {"group 3": ("paper-load", ()), "control group": ("classical", running.LOAD)}
FINENESS = 1.3  # with which contacts of pins 0.04 mm narrower in radius than their holes are wide enough for the elements
PULL = 200.0  # N on a plate: F1
CLEARANCES = (0.0, 2.0, 5.0, 10.0, 20.0, 40.0)  # um in the radius
RUNNING_CLEARANCES = (0.0, 2.0, 5.0, 10.0, 20.0)
CLEARANCE_LABEL = "Clearance of a pin in its hole, radial [µm]"
SEATS = {"all of the seat": None, "30° to either side": np.radians(30.0)}
PULLS = (50.0, 100.0, 200.0, 400.0)  # N
LOAD_STEPS = 24
USUAL = 5.0  # um: clearance of the analysis, and of the rows
EDGE = 5e-5  # m: rounding of the holes' edges
MICRO, MEGA = 1e-6, 1e6
PIN_STRESSES = {"group 3": 162.026855, "control group": 245.183578}  # printed, MPa
PRINTED_STRESSES = {"plate": PLATE_STRESSES, "pin": PIN_STRESSES}
SECTIONS = {"plate": "section 6, plates", "pin": "section 6, pins"}
FITS = {"exact fit": 0.0, f"{USUAL:g} um of clearance": USUAL}
FIELDS = {"plate": 0, "pin": 1, "plate life": 2, "pin life": 3}  # of `runs_of`


class Design(NamedTuple):
    """A chain as solids: its model, condensed plate and pins, and the revolutions that its runs give."""

    model: ChainModel
    solid: PlateAndPins
    revolutions: tuple[PlateRevolution, ...]


class Point(NamedTuple):
    """Maximum stresses [Pa] of plate and pins and their shortest lives [pulls, revolutions]; nan where elements cannot carry them."""

    plate: float
    pin: float
    plate_life: float
    pin_life: float


NOWHERE = Point(np.nan, np.nan, np.nan, np.nan)


@cache
def design(name: str) -> Design:
    """The `Design` of "group 3" or of the "control group" under the paper's load case."""
    preset, changes = DESIGNS[name]
    model: Any = build(running.preset(preset, *changes, f"solid.fineness={FINENESS}", f"solid.load_steps={LOAD_STEPS}"))
    dynamics = next(each for each in registry.mechanism("silent-chain").analyses if each.name == "dynamics")
    runs = dynamics.answer(model, {}).data.members
    revolutions = tuple(plate_revolution(model, run) for run in runs)
    return Design(model, condensed(model, revolutions)[1], revolutions)


def pull(force: float) -> Loads:
    """A straight pull on a plate [N]."""
    return Loads(np.array([[[-force, 0.0], [force, 0.0]]]), np.zeros((1, 2)), np.zeros((1, 2)))


def running_loads(name: str, number: int = 0) -> Loads:
    """Load steps of one of the runs."""
    each = design(name)
    return loads_at(each.revolutions[number].loads, steps(each.model, each.revolutions[number]))


@cache
def at_rest(name: str, clearance: float, seat: float | None = None, force: float = PULL) -> Point:
    """`Point` of a straight pull, once from 0 in a revolution."""
    each = design(name)
    try:
        (history,) = over_fits(each.solid, [Fit(clearance * MICRO, EDGE, seat)], pull(force))
    except InputError:  # the contact is too narrow for the elements
        return NOWHERE
    most = peaks(history)
    plate, *pins = (_life(each.model, history, body, repeated=True) for body in ("plate", "left", "right"))
    return Point(most.plate, most.pin, plate, min(pins))


def _life(model: ChainModel, history: SolidHistory, body: str, repeated: bool = False) -> float:
    skin = history.skins[body]
    if repeated:  # from nothing to the load
        skin = skin._replace(stress=np.concatenate([0 * skin.stress, skin.stress]))
    return skin_life(skin, history.searched[body], card_of(model), model.spec.fatigue.plane).least


@cache
def runs_of(name: str, clearance: float = USUAL) -> tuple[Floats, ...]:
    """Maximum stress of plate and pin [Pa], and their lives [revolutions], in each run: four arrays."""
    each = design(name)
    return tuple(np.array([_running(each, running_loads(name, number), clearance) for number in range(len(each.revolutions))]).T)


def _running(each: Design, loads: Loads, clearance: float) -> Point:
    """`Point` of one run, lives in revolutions of the chain."""
    try:
        (history,) = over_fits(each.solid, [Fit(clearance * MICRO, EDGE)], loads)
    except InputError:  # the contact is too narrow for the elements
        return NOWHERE
    most = peaks(history)
    lives = [_life(each.model, history, body) for body in ("plate", "left", "right")]
    return Point(most.plate, most.pin, lives[0], min(lives[1:]))


# -- rows ----------------------------------------------------------------------------------------------------------------------


def solid_rows(folder: Path) -> Iterator[Row]:
    """Section 6 beside plates and pins as solids in contact: running, and under the same pull."""
    for body in ("plate", "pin"):
        yield from _running_rows(body, _common(USUAL))
        for words, clearance in FITS.items():
            yield _quotient_row(body, words, clearance)
        yield from _pulled_rows(body, _common(USUAL) | {"idealised": True})
    for words, clearance in FITS.items():
        yield _life_row(words, clearance)


def _common(clearance: float) -> dict[str, Any]:
    """What the rows of a fit say of their inputs."""
    fit = f"pins {clearance:g} um narrower in radius than their holes" if clearance else "pins that fit their holes exactly"
    return {
        "kind": "other code",
        "inputs": "F1 = 200 N, F0 = 50 N, 2000 rpm, 1 x 2, 2 mm",
        "assumed": f"{running.PLATE.partition(';')[0]}; {fit}, edges of holes rounded with {EDGE / MICRO:g} um; elastic plate and pins in "
        "contact",
        "pinned": OPEN,
    }


def _means(quantity: str, clearance: float = USUAL) -> list[running.Interval]:
    """Means over the runs of either chain; of a life the geometric ones."""
    number, logarithmic = FIELDS[quantity], quantity.endswith("life")
    return [running.mean_of_cases(runs_of(name, clearance)[number], logarithmic) for name in DESIGNS]


def _running_rows(body: str, common: dict[str, Any]) -> Iterator[Row]:
    """Maximum stress of a body in the running chain, one row a design."""
    beside = "" if body == "plate" else " Beside the rolling contact, whose own stress is Hertz's."
    for (name, printed), ours in zip(PRINTED_STRESSES[body].items(), _means(body), strict=True):
        yield Row(
            f"maximum stress of a {body} as a solid, {name}, running",
            rounded(f"{printed} MPa", "Pa"),
            ours.value,
            "Pa",
            where=SECTIONS[body],
            low=ours.low,
            high=ours.high,
            note=f"{_order(body)}{beside}",
            reading_of=f"maximum stress of {_one(body)}, {name}",
            **common,
        )


def _quotient_row(body: str, words: str, clearance: float) -> Row:
    """Stress of the new chain over that of the classical one, both running with the same fit."""
    ours = running.ratio(*_means(body, clearance))
    return Row(
        f"maximum stress of a {body} as a solid, group 3 over control, running, {words}",
        Printed("below 1", *BELOW_ONE),
        ours.value,
        "-",
        where=SECTIONS[body],
        low=ours.low,
        high=ours.high,
        note=_order(body),
        reading_of=f"maximum stress of {_one(body)}, group 3 over control",
        **_common(clearance),
    )


def _pulled_rows(body: str, common: dict[str, Any]) -> Iterator[Row]:
    """The same quotient of both chains under one pull, over the fit of the pins."""
    usual = [at_rest(name, USUAL) for name in DESIGNS]
    for words, upper, under in (
        ("exact fit", *(at_rest(name, 0.0) for name in DESIGNS)),
        (f"{USUAL:g} um of clearance", *usual),
        (f"{USUAL:g} um of clearance, control {CLEARANCES[-1]:g} um", usual[0], at_rest("control group", CLEARANCES[-1])),
    ):
        yield Row(
            f"maximum stress of a {body} as a solid, group 3 over control, both pulled by 200 N, {words}",
            Printed("below 1", *BELOW_ONE),
            getattr(upper, body) / getattr(under, body),
            "-",
            where=SECTIONS[body],
            note=_order(body),
            reading_of=f"maximum stress of {_one(body)}, group 3 over control",
            **common,
        )


def _life_row(words: str, clearance: float) -> Row:
    """Life of the pins of the new chain over that of the classical one, both running with the same fit."""
    ours = running.quotient(*_means("pin life", clearance))
    return Row(
        f"life of a pin as a solid, new over classical, running, {words}",
        Printed("above 1", *ABOVE_ONE),
        ours.value,
        "-",
        where=SECTIONS["pin"],
        low=ours.low,
        high=ours.high,
        note=_order("pin"),
        reading_of="life of the pins, new over classical",
        **_common(clearance),
    )


def _one(body: str) -> str:
    """The body as the paper's claims have it: every plate is alike, of pins there are two."""
    return "the plate" if body == "plate" else "a pin"


def _order(body: str) -> str:
    """What decides the order of both chains, with our numbers."""
    exact = [getattr(at_rest(name, 0.0), body) / MEGA for name in DESIGNS]
    usual = [getattr(at_rest(name, USUAL), body) / MEGA for name in DESIGNS]
    worn = getattr(at_rest("control group", CLEARANCES[-1]), body) / MEGA
    return (
        f"Both pulled by 200 N, the {body} of the new and of the classical chain bear {exact[0]:.0f} and {exact[1]:.0f} MPa where pins fit "
        f"exactly, {usual[0]:.0f} and {usual[1]:.0f} MPa with {USUAL:g} um of clearance, and the classical one {worn:.0f} MPa with "
        f"{CLEARANCES[-1]:g} um."
    )


# -- figures -------------------------------------------------------------------------------------------------------------------


def _over_clearance(field: str, scale: float) -> list[Curve]:
    curves = []
    for name in DESIGNS:
        for words, seat in SEATS.items():
            values = [getattr(at_rest(name, clearance, seat), field) / scale for clearance in CLEARANCES]
            curves.append(Curve(f"{name}, {words}", np.array(CLEARANCES), np.array(values), "both"))
    return curves


def map_of_stress() -> "Drawn":
    """Maximum stress of plate and pin over clearance and seat, both chains pulled alike."""
    stated = [Stated(f"{name} as printed, {stress:.0f} MPa", y=stress) for name, stress in PLATE_STRESSES.items()]
    pins = [Stated(f"{name} as printed, {stress:.0f} MPa", y=stress) for name, stress in PIN_STRESSES.items()]
    charts = [
        Chart("Stress of the plate [MPa]", _over_clearance("plate", MEGA), stated, "Both plates pulled by 200 N", from_zero=True),
        Chart("Stress of the pin [MPa]", _over_clearance("pin", MEGA), pins, "Pins, beside their rolling contact", from_zero=True),
    ]
    return chart_figure("Maximum stress over the fit of the pins", CLEARANCE_LABEL, charts, height=3.4)


def map_of_life() -> "Drawn":
    """Shortest life of plate and pin over clearance and seat, both chains pulled alike."""
    charts = [
        Chart("Life [pulls]", _over_clearance("plate_life", 1.0), (), "Plates", log=True),
        Chart("Life [pulls]", _over_clearance("pin_life", 1.0), (), "Pins, beside their rolling contact", log=True),
    ]
    return chart_figure("Shortest life over the fit of the pins", CLEARANCE_LABEL, charts, height=3.4)


def map_of_running() -> "Drawn":
    """Maximum stress and shortest life of plate and pin over the clearance, running under the paper's load case."""
    charts = [
        Chart("Stress of the plate [MPa]", _while_running("plate", MEGA), title="Plates, running", from_zero=True),
        Chart("Stress of the pin [MPa]", _while_running("pin", MEGA), title="Pins, running", from_zero=True),
        Chart("Life of the plate [revolutions]", _while_running("plate life"), log=True),
        Chart("Life of the pin [revolutions]", _while_running("pin life"), log=True),
    ]
    return chart_figure("Running at 2000 rpm, over the fit of the pins", CLEARANCE_LABEL, charts, columns=2, height=3.2)


def _while_running(quantity: str, scale: float = 1.0) -> list[Curve]:
    """Means over the runs with their intervals, over the clearance."""
    found = [_means(quantity, clearance) for clearance in RUNNING_CLEARANCES]
    curves = []
    for number, name in enumerate(DESIGNS):
        value, low, high = np.array([each[number] for each in found]).T / scale
        curves.append(Curve(name, np.array(RUNNING_CLEARANCES), value, "both", low, high))
    return curves


def map_of_load() -> "Drawn":
    """Maximum stress of plate and pin over the pull."""
    curves = [
        [
            Curve(name, np.array(PULLS), np.array([getattr(at_rest(name, USUAL, None, force), body) / MEGA for force in PULLS]), "both")
            for name in DESIGNS
        ]
        for body in ("plate", "pin")
    ]
    charts = [Chart("Stress of the plate [MPa]", curves[0], from_zero=True), Chart("Stress of the pin [MPa]", curves[1], from_zero=True)]
    return chart_figure("Maximum stress over the pull of the strand", "Pull on a plate [N]", charts, columns=2, height=3.0)


@cache
def solid_result(name: str) -> Result:
    """The analysis `solid_stress` of a design under the paper's load case."""
    preset, changes = DESIGNS[name]
    return run(running.preset(preset, *changes), ("solid_stress",))


def picture(name: str, plot: str) -> "Drawn":
    """A plot of plate or pin as solids."""
    return solid_result(name).plot(plot)
