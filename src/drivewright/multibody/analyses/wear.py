"""Wear of a bearing over many turns: a run gives the wear of a turn, a jump extrapolates it, and the worn bearing is simulated again.

The wall recedes where the journal rubs; the contact sees the depth on the side where the journal is (`forces.pin_contact.wear_depth`).
The stiffness of the contact keeps its value, and the journal its shape.
"""

from dataclasses import dataclass, replace

import numpy as np

from drivewright import cases
from drivewright._typing import Floats
from drivewright.contact.wear import deposit, extrapolate_wear
from drivewright.labels import in_words
from drivewright.multibody.analyses.ensemble import Statistics, orbit_turns, perturbed_start
from drivewright.multibody.analyses.simulation_model import TURN, SimulationModel
from drivewright.multibody.analyses.turns import RunNumbers, acceleration, ideal_peak, mean_per_turn, start_of_window, turn_ends
from drivewright.multibody.assembly import Assembly
from drivewright.multibody.measures import impact_load
from drivewright.multibody.model import Marker
from drivewright.multibody.observe import PIN_FIELDS
from drivewright.multibody.record import Record, record
from drivewright.multibody.simulate import simulate
from drivewright.numerics.ensemble import mean_of_members
from drivewright.result import Answer, Column, Table, Value

BEARING = "bearing of "  # before a joint's name: the marker that tells the bearing's angle; outputs have no blanks in their names
FLAT = 0.1  # slope of the worn profile by the angle, over the clearance, up to which the contact is where the journal's centre points
SMALL = 0.1  # depth of a jump over the clearance, likewise: the motion should not change much in between


@dataclass(frozen=True)
class WearingBearing:
    """The bearing that wears, and how: name of its joint and of its body, radius, length and clearance [m], volume worn off per force
    and way [m^2/N], turns of the drive in all, jumps among them, places around the bearing."""

    joint: str
    body: str
    radius: float
    length: float
    clearance: float
    coefficient: float
    cycles: int
    jumps: int
    bins: int


@dataclass(frozen=True)
class Stage:
    """The bearing before a jump: turns behind it, depth (bins,) [m], what a turn of this run takes off (bins,) [m], largest force [N],
    impact load coefficient of every output, and the means over each turn of force times slip [W]."""

    cycles: float
    depth: Floats
    per_turn: Floats
    force: float
    loads: tuple[float, ...]
    rubbing: Floats


@dataclass(frozen=True)
class History:
    """A bearing that wears, one run a stage: the stages, depth (bins,) [m] at the end, why it ended early, and whether every run repeated
    itself."""

    stages: tuple[Stage, ...]
    depth: Floats
    advice: str
    periodic: bool

    def numbers(self, joint: WearingBearing) -> RunNumbers:
        """Its numbers, and by the turns of the last run whether they drift."""
        turns = {"rubbing": self.stages[-1].rubbing} if self.stages else {}
        return RunNumbers(
            turns,
            {
                "max_depth": float(np.max(self.depth)),
                "clearance_growth": clearance_growth(self.depth),
                "volume": float(volume_of(joint, self.depth)),
            },
        )


def with_wear(assembly: Assembly, pin: int, depth: Floats) -> Assembly:
    """The assembly with a worn depth (bins,) [m] on the bearing of its pin number `pin`, over the angle in the bearing's body."""
    wear = np.zeros((len(assembly.system.contacts), len(depth)))
    wear[pin] = depth
    return replace(assembly, system=assembly.system._replace(wear=wear))


def wear(model: SimulationModel, bearing: WearingBearing) -> Answer:
    """Depth over the angle of the bearing, force and impact load over the turns: of a bearing, or the mean of an ensemble of bearings."""
    first, *_ = histories = _histories(model, bearing)
    count = len(first.stages)
    run_statistics = Statistics(tuple(each.numbers(bearing) for each in histories), int(first.periodic))
    tables = (_profiles(bearing, histories), _development(model, bearing, histories)) if count else ()
    jump = bearing.cycles / bearing.jumps
    findings = _findings(bearing, first.depth, max((jump * np.max(stage.per_turn) for stage in first.stages), default=0.0))
    if first.advice:
        findings = (*findings, f"wear stops after {count} of {bearing.jumps} jumps: {first.advice}")
    return Answer(
        _values(bearing, run_statistics, count * jump), tables, findings=findings, outcome="partial" if first.advice else "complete"
    )


def _histories(model, bearing):
    """The `History` of a bearing, and where its motion does not repeat itself, of the others of the ensemble."""
    first = history(model, bearing, 0)
    if first.periodic or first.advice:
        return [first]
    rows = cases.run(lambda number: history(model, bearing, number), range(1, model.ensemble), workers=None).rows
    return [first, *(row.value for row in rows if row.ok and not row.value.advice)]


def history(model: SimulationModel, bearing: WearingBearing, number: int) -> History:
    """The `History` of one bearing, whose runs start like those of this member of the ensemble."""
    stages, depth, advice, periodic = [], np.zeros(bearing.bins), "", True
    for jump in range(bearing.jumps):
        record, advice = run_with_wear(model, bearing, depth, number)
        if advice:
            break
        cycles = bearing.cycles / bearing.jumps
        stages.append(
            Stage(
                jump * cycles,
                depth,
                depth_per_turn(record, model, bearing),
                _largest_force(record, model, bearing),
                _loads(record, model),
                _rubbing(record, model, bearing),
            )
        )
        depth, periodic = np.asarray(extrapolate_wear(depth, stages[-1].per_turn, cycles)), periodic and orbit_turns(model, record) > 0
    return History(tuple(stages), depth, advice, periodic)


# -- one run -------------------------------------------------------------------------------------------------------------------


def run_with_wear(model: SimulationModel, bearing: WearingBearing, depth: Floats, number: int = 0) -> tuple[Record, str]:
    """(record of the window of a run with a worn bearing, advice where the run ended early)."""
    pin = model.pins.index(bearing.joint)
    run = simulate(with_wear(model.assembly, pin, depth), model.run_length, model.settings, state=perturbed_start(model, number))
    markers = {**model.markers, BEARING + bearing.joint: Marker(bearing.body)}
    return record(run, markers, start_of_window(model, run.end[1])), run.advice


def _rubbing(record, model, bearing):
    """Means over the turns of force times slip [W]."""
    pin = _pin(record, model, bearing)
    return mean_per_turn(record.t, pin["normal"] * np.abs(pin["slip"]), turn_ends(model, record.t[0], record.t[-1]))


def _pin(record, model, bearing):
    return dict(zip(PIN_FIELDS, np.moveaxis(record.pins[:, model.pins.index(bearing.joint)], 1, 0), strict=True))


def contact_angle(record: Record, model: SimulationModel, bearing: WearingBearing) -> Floats:
    """Where the journal touches the bearing, in the frame of the bearing's body (m,) [rad]."""
    pin = _pin(record, model, bearing)
    return np.arctan2(-pin["ny"], -pin["nx"]) - record.point(BEARING + bearing.joint, "angle")


def depth_per_turn(record: Record, model: SimulationModel, bearing: WearingBearing) -> Floats:
    """Depth (bins,) [m] that a turn takes off the bearing, the mean over the window."""
    pin = _pin(record, model, bearing)
    taken = deposit(
        record.t,
        contact_angle(record, model, bearing),
        pin["normal"],
        pin["slip"],
        bearing.coefficient,
        bearing.radius,
        bearing.length,
        bearing.bins,
    )
    return taken * model.turn_length / (record.t[-1] - record.t[0])


def _largest_force(record, model, bearing):
    pin = _pin(record, model, bearing)
    return float(np.max(np.hypot(pin["fx"], pin["fy"])))


def _loads(record, model):
    return tuple(
        impact_load(record.t, acceleration(record, output)[0], ideal_peak(model, output), model.period).coefficient
        for output in model.outputs
    )


# -- answer ------------------------------------------------------------------------------------------------------------------


def _values(joint: WearingBearing, run_statistics: Statistics, cycles: float):
    name, label = joint.joint, f"joint {in_words(joint.joint)}"

    def of(key, unit, meaning, short):
        return Value.of(run_statistics.of_run(key, "rubbing"), unit, f"{meaning} of {label}", f"{short}, {label}")

    growth = "maximum growth of the radial clearance (half the wear of two opposite sides)"
    return {
        f"wear.{name}.max_depth": of("max_depth", "m", "maximum wear depth of the bearing", "maximum wear depth"),
        f"wear.{name}.volume": of("volume", "m^3", "wear volume of the bearing", "wear volume"),
        f"wear.{name}.clearance_growth": of("clearance_growth", "m", growth, "maximum clearance growth"),
        f"wear.{name}.cycles": Value(float(cycles), "-", "turns of the drive that the wear covers", label=f"turns with wear, {label}"),
    }


def volume_of(joint: WearingBearing, depth: Floats) -> Floats:
    """Volume [m^3] behind the depths (..., bins) [m]."""
    return TURN * joint.radius * joint.length * np.mean(depth, axis=-1)


def clearance_growth(depth: Floats) -> float:
    """Largest growth of the radial clearance in any direction [m]: half the sum of the depths (bins,) of two opposite sides."""
    angles = np.arange(len(depth)) + len(depth) / 2
    return float(0.5 * np.max(depth + np.interp(angles, np.arange(2 * len(depth)), np.tile(depth, 2))))


def _profiles(joint, histories):
    after = np.array([[*(stage.depth for stage in each.stages[1:]), each.depth] for each in histories])
    middle, bins = after.shape[1] // 2, after.shape[2]
    return Table(
        f"wear.{joint.joint}",
        f"Wear profile of joint {in_words(joint.joint)}",
        (
            Column(
                "angle",
                "rad",
                f"angle on the bearing, in the frame of {in_words(joint.body)}",
                np.arange(bins) * TURN / bins,
                "bearing angle",
            ),
            *_columns("first", "m", "wear depth after the first jump", after[:, 0]),
            *_columns("middle", "m", f"wear depth after jump {middle + 1} of {after.shape[1]}", after[:, middle]),
            *_columns("last", "m", "wear depth at the end", after[:, -1]),
        ),
    )


def _development(model, joint, histories):
    """Force, impact load and wear before every jump."""

    def stages(number):
        return np.array([[number(stage) for stage in each.stages] for each in histories])

    loads = [
        _columns(
            f"impact_load.{output.name}", "-", f"impact load coefficient of {in_words(output.name)}", stages(lambda at, k=k: at.loads[k])
        )
        for k, output in enumerate(model.outputs)
    ]
    return Table(
        f"wear.{joint.joint}.cycles",
        f"Wear history of joint {in_words(joint.joint)}",
        (
            Column("cycles", "-", "turns of the drive with wear", np.array([stage.cycles for stage in histories[0].stages])),
            *_columns("max_depth", "m", "maximum wear depth", stages(lambda at: np.max(at.depth))),
            *_columns("volume", "m^3", "wear volume", stages(lambda at: volume_of(joint, at.depth))),
            *_columns("volume_per_turn", "m^3", "wear volume per turn", stages(lambda at: volume_of(joint, at.per_turn))),
            *_columns("max_force", "N", "peak force in the joint", stages(lambda at: at.force)),
            *sum(loads, ()),
        ),
    )


def _columns(name, unit, meaning, numbers):
    """The mean of numbers (bearings, rows), with its interval where there are several."""
    mean, reach = mean_of_members(numbers)
    column = Column(name, unit, meaning, mean)
    return (column, *column.bounds(mean - reach, mean + reach)) if len(numbers) > 1 else (column,)


def _findings(joint, depth, step):
    findings, slope = [], float(np.max(np.abs(np.diff(depth, append=depth[0])))) * len(depth) / TURN
    if slope > FLAT * joint.clearance:
        findings.append(
            f"wear of joint {joint.joint!r}: the worn profile has slopes up to {1e3 * slope:.3g} mm/rad at a clearance of "
            f"{1e3 * joint.clearance:.3g} mm. The contact is evaluated in the direction of the journal's centre, which is accurate up to "
            f"slopes of about {FLAT:g} times the clearance. Use fewer cycles or fewer bins"
        )
    if step > SMALL * joint.clearance:
        findings.append(
            f"wear of joint {joint.joint!r}: one jump removes up to {1e3 * step:.3g} mm, {step / joint.clearance:.2g} times the clearance "
            f"of {1e3 * joint.clearance:.3g} mm, while the motion is assumed unchanged; increase jumps"
        )
    return tuple(findings)
