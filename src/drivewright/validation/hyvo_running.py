"""The Hy-Vo paper's running chains beside ours: centre distances at 2000 rpm, stress and life of the plates under its load case.

Chains are chaotic: every number is a mean with its 95 % interval.  Studies in a folder hold the cases, and go on where they stopped.
"""

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from drivewright import registry
from drivewright._typing import Floats
from drivewright.numerics.ensemble import mean_of_members
from drivewright.spec import MechanismSpec, load
from drivewright.studies.study import Study
from drivewright.studies.sweeps import sweep
from drivewright.validation.hyvo_model import CLASSICAL_RADIUS, DRIVE, MM, NEW_RADII, SMALLER
from drivewright.validation.hyvo_strength import PLATE_STRESSES
from drivewright.validation.source import AGREES, BELOW_ONE, OPEN, Printed, Row, rounded

Progress: TypeAlias = Callable[[int, int, str], object]
RUNNING, CONTROL, LOADED, LOADED_CONTROL = "running-groups", "running-control", "load-group-3", "load-control"
OUTLINE = ("plate.apothem=", 'plate.standard_apothem="3.773 mm"')  # the same outer profile for all groups
MASSES = ('plate.link_mass="2.5 g"', 'plate.link_inertia="6.375e-8 kg m^2"', 'driven.mass="0.6 kg"')
RUN = ('dynamics.duration="0.3 s"',)
LOAD = ('drive.preload="250 N"', 'drive.load_torque="8.424 N m"', 'contact.force="200 N"')
STARTS = tuple(f"{250 + 1e-6 * number!r} N" for number in range(8))  # of the preload: starts that differ by next to nothing
DISTANCE, FLUCTUATION = "dynamics.centre_distance.mean", "dynamics.centre_distance.fluctuation"
STRESS, LIFE = "plate.max_von_mises", "plate.life"
INITIAL = 219.056 * MM
ASSUMED = (
    "links of 2.5 g, driven sprocket of 0.6 kg, articulation damped by 0.3 % of critical, four runs of 0.3 s; the run begins at speed: to "
    "bring such a sprocket to 2000 rpm in 0.01 s takes 328 N between the strands, which 150 N do not give"
)
PLATE = "plates drawn by us with the outer profile of both chains alike, as the paper prints none; running at speed, eight starts"
AGAINST = (
    "Neither plate is drawn in the paper and its start from rest is left out. The order of the two depends on the plate, the clearance "
    "in its holes and on how far the running chain shakes."
)


class Interval(NamedTuple):
    """A mean with the ends of its 95 % interval."""

    value: float
    low: float
    high: float


def preset(name: str, *changes: str) -> MechanismSpec:
    """A preset of the chain with changes."""
    return load(registry.mechanism("silent-chain").presets()[name], changes)


def running_groups(folder: Path, progress: Progress | None = None) -> Study:
    """Groups 1 to 7 at 2000 rpm, the same outer profile for all."""
    spec = preset("default", *OUTLINE, *MASSES, *RUN, 'study.analyses=["dynamics"]')
    vary: dict[str, Any] = {"joint.rolling_radius": [f"{radius} mm" for radius in NEW_RADII]}
    return sweep(spec, vary, out=folder / "studies" / RUNNING, progress=progress)


def running_control(folder: Path, progress: Progress | None = None) -> Study:
    """The control group at 2000 rpm."""
    spec = preset("classical", *RUN, 'study.analyses=["dynamics"]')
    vary: dict[str, Any] = {"joint.rolling_radius": [f"{CLASSICAL_RADIUS} mm"]}
    return sweep(spec, vary, out=folder / "studies" / CONTROL, progress=progress)


def loaded_group(folder: Path, progress: Progress | None = None) -> Study:
    """Stress and life of a plate of group 3 under the paper's load case, from eight starts."""
    spec = preset("paper-load", 'study.analyses=["life"]')
    return sweep(spec, {"drive.preload": list(STARTS)}, out=folder / "studies" / LOADED, progress=progress)


def loaded_control(folder: Path, progress: Progress | None = None) -> Study:
    """The same of the control group."""
    spec = preset("classical", *LOAD, 'study.analyses=["life"]')
    return sweep(spec, {"drive.preload": list(STARTS)}, out=folder / "studies" / LOADED_CONTROL, progress=progress)


def intervals(study: Study, name: str) -> list[Interval]:
    """The value of each case with the interval that its own ensemble gives."""
    low, high = study.bounds(name) or (study[name], study[name])
    return [Interval(*map(float, each)) for each in zip(study[name], low, high, strict=True)]


def mean_of_cases(values: Floats, logarithmic: bool = False) -> Interval:
    """Mean of independent cases with Student's 95 % interval; of their logarithms where that is asked for."""
    data = np.asarray(values, float)
    data = np.log(data[np.isfinite(data)]) if logarithmic else data[np.isfinite(data)]
    mean, half = mean_of_members(data)
    ends = mean + half * np.array([0.0, -1.0, 1.0])
    value, low, high = (np.exp(ends) if logarithmic else ends).tolist()
    return Interval(value, low, high)


def ratio(first: Interval, second: Interval) -> Interval:
    """Quotient of two independent means, the relative half widths added as squares."""
    value = first.value / second.value
    one, other = (0.5 * (each.high - each.low) / each.value for each in (first, second))
    share = float(np.hypot(one, other))
    return Interval(value, value * (1 - share), value * (1 + share))


def quotient(first: Interval, second: Interval) -> Interval:
    """Quotient of two independent means of logarithms, whose half widths there are added as squares."""
    value = first.value / second.value
    spread = float(np.exp(np.hypot(*(0.5 * np.log(each.high / each.low) for each in (first, second)))))
    return Interval(value, value / spread, value * spread)


def difference(first: Interval, value: float) -> Interval:
    """A mean less an exact number."""
    return Interval(first.value - value, first.low - value, first.high - value)


def running_rows(folder: Path) -> Iterator[Row]:
    """Section 5 at 2000 rpm: fluctuations, means, running deviations."""
    groups, control = running_groups(folder), running_control(folder)
    common: dict[str, Any] = {"kind": "other code", "inputs": DRIVE, "assumed": ASSUMED}
    fluctuation, mean = intervals(groups, FLUCTUATION), intervals(groups, DISTANCE)
    of_control, mean_control = intervals(control, FLUCTUATION)[0], intervals(control, DISTANCE)[0]
    deviations = [difference(each, INITIAL) for each in mean]
    deviation_control = difference(mean_control, INITIAL)
    for name, place, text, ours in (
        ("fluctuation, control group", "section 5.2", "0.020145 mm", of_control),
        ("mean centre distance, control group", "section 5.3", "219.1256 mm", mean_control),
        ("running deviation, printed mean less 219.056 mm", "section 5.3", "0.0696 mm", deviation_control),
    ):
        yield _row(f"{name.partition(',')[0]}, control group running", rounded(text, "m"), ours, "m", place, reading_of=name, **common)
    grows = Printed("grows: above 1", float(np.nextafter(1.0, 2.0)), float("inf"))
    for name, place, values, other in (
        ("fluctuation", "Fig. 11", fluctuation, of_control),
        ("running deviation", "Figs. 12, 13", deviations, deviation_control),
    ):
        agreed: dict[str, Any] = common | {"pinned": AGREES}
        largest, verdict = ratio(max(values), other), OPEN if name == "fluctuation" else AGREES
        agreed["reading_of"] = f"minimum growth of the {name} from group to group, in um"
        yield _row(f"{name} of group 7 over group 1, running", grows, ratio(values[-1], values[0]), "-", place, **agreed)
        quantity = f"largest {name} of groups 1 to 7 over control, running"
        claim = f"largest {name} of groups 1 to 7 over control"
        yield _row(quantity, SMALLER, largest, "-", place, reading_of=claim, **(common | {"pinned": verdict}))


def plate_rows(folder: Path) -> Iterator[Row]:
    """Section 6.2: maximum stress and least life of the plates under the paper's load case."""
    common: dict[str, Any] = {
        "kind": "other code",
        "inputs": "F1 = 200 N, F0 = 50 N, 2000 rpm, 1 x 2, 2 mm",
        "assumed": PLATE,
        "note": AGAINST,
    }
    new, control = loaded_group(folder), loaded_control(folder)
    stress = [mean_of_cases(study[STRESS]) for study in (new, control)]
    lives = [mean_of_cases(study[LIFE], logarithmic=True) for study in (new, control)]
    for (name, printed), ours in zip(PLATE_STRESSES.items(), stress, strict=True):
        yield _row(f"maximum stress of the plate, {name}", rounded(f"{printed} MPa", "Pa"), ours, "Pa", "section 6.2", **common)
    below = Printed("below 1", *BELOW_ONE)
    yield _row("maximum stress of the plate, group 3 over control", below, ratio(*stress), "-", "section 6.2", **common)
    for name, text, ours, of in (
        ("group 3", "1.64e9", lives[0], "plate, new chain"),
        ("control group", "1.21e8", lives[1], "plate, classical chain"),
    ):
        quantity = f"least life of the plate in revolutions of the chain, {name}"
        yield _row(quantity, rounded(text, "-"), ours, "-", "section 6, lives", reading_of=f"life of the {of}", **common)
    name = "life of the plates, new over classical"
    yield _row(f"{name}, running", rounded("13.55", "-"), quotient(*lives), "-", "section 6, lives", reading_of=name, **common)


def _row(name: str, printed: Printed, ours: Interval, unit: str, where: str, pinned: str = OPEN, **common: Any) -> Row:
    return Row(name, printed, ours.value, unit, pinned, where=where, low=ours.low, high=ours.high, **common)


def all_studies() -> Sequence[tuple[str, Callable[[Path, Progress | None], Study]]]:
    """(name, function) of each study."""
    return ((RUNNING, running_groups), (CONTROL, running_control), (LOADED, loaded_group), (LOADED_CONTROL, loaded_control))
