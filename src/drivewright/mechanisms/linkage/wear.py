"""Wear of a bearing over many turns: a run tells what a turn wears off, a jump extrapolates it, the worn bearing runs again.

The wall recedes where the journal rubs; the contact sees the depth on the side where the journal is (`multibody.loads.worn_off`).
The stiffness of the contact keeps its value, and the journal its shape.
"""

from dataclasses import dataclass, replace

import numpy as np

from drivewright.contact.wear import deposit, worn
from drivewright.mechanisms.linkage.analyse import acceleration, no_run
from drivewright.mechanisms.linkage.build import TURN, ideal_record
from drivewright.mechanisms.linkage.refusals import place
from drivewright.multibody.measures import impact_load, largest
from drivewright.multibody.model import Marker
from drivewright.multibody.observe import PIN_FIELDS
from drivewright.multibody.record import record
from drivewright.multibody.simulate import simulate
from drivewright.result import Answer, Column, Table, Value

BEARING = "bearing of "  # before a joint's name: the marker that tells the bearing's angle; outputs have no blanks in their names
FLAT = 0.1  # slope of the worn profile by the angle, over the clearance, up to which the contact is where the journal's centre points
SMALL = 0.1  # depth of a jump over the clearance, likewise: the motion should not change much in between


@dataclass(frozen=True)
class Stage:
    """The bearing before a jump: turns behind it, depth (bins,) [m], what a turn of this run takes off (bins,) [m], largest force [N],
    and the impact load coefficient of every output."""

    cycles: float
    depth: np.ndarray
    per_turn: np.ndarray
    force: float
    loads: tuple


def no_wear(spec):
    """Why nothing wears."""
    if spec.wear is None:
        return "the spec has no [wear] table"
    joint = _joint(spec)
    if joint.pin != "dry":
        return f"joint {joint.name!r} is {joint.pin or joint.kind}; wear wants model = \"dry\" and a clearance"
    return no_run(spec) or (f"joint {joint.name!r} states no wear_coefficient" if joint.wear_coefficient is None else None)


def _joint(spec):
    return next(joint for joint in spec.joints if joint.name == spec.wear.joint)


def with_wear(assembly, pin, depth):
    """The assembly with a worn depth (bins,) [m] on the bearing of its pin number `pin`, over the angle in the bearing's body."""
    wear = np.zeros((len(assembly.system.contacts), len(depth)))
    wear[pin] = depth
    return replace(assembly, system=assembly.system._replace(wear=wear))


def wear(model, done):
    """Depth over the angle of the bearing, force and impact load over the turns."""
    asked, joint = model.spec.wear, _joint(model.spec)
    jump, stages, depth, advice = asked.cycles / asked.jumps, [], np.zeros(asked.bins), ""
    for number in range(asked.jumps):
        seen, advice = worn_run(model, depth)
        if advice:
            break
        per_turn = depth_per_turn(seen, model, asked.bins)
        stages.append(Stage(number * jump, depth, per_turn, _largest_force(seen, model), _loads(seen, model)))
        depth = worn(depth, per_turn, jump)
    values = _values(joint, depth, len(stages) * jump)
    tables = (_profiles(joint, stages, depth), _history(model, joint, stages)) if stages else ()
    findings = _findings(joint, depth, max((jump * np.max(stage.per_turn) for stage in stages), default=0.0))
    if advice:
        findings = (*findings, f"wear ends after {len(stages)} of {asked.jumps} jumps: {advice}")
    return Answer(values, tables, findings=findings, outcome="partial" if advice else "complete")


# -- one run -------------------------------------------------------------------------------------------------------------------


def worn_run(model, depth):
    """(record of the window of a run with a worn bearing, advice where the run ended early)."""
    pin, joint = model.pins.index(model.spec.wear.joint), _joint(model.spec)
    run = simulate(with_wear(model.assembly, pin, depth), model.duration, model.settings)
    markers = model.markers | {BEARING + joint.name: Marker(place(joint.connects[0])[0])}
    start = model.spec.start_of_window if model.spec.simulate else 0.0
    return record(run, markers).after(start * (1 - 1e-12)), run.advice


def _pin(seen, model):
    return dict(zip(PIN_FIELDS, np.moveaxis(seen.pins[:, model.pins.index(model.spec.wear.joint)], 1, 0), strict=True))


def contact_angle(seen, model):
    """Where the journal touches the bearing, in the frame of the bearing's body (m,) [rad]."""
    pin = _pin(seen, model)
    return np.arctan2(-pin["ny"], -pin["nx"]) - seen.point(BEARING + model.spec.wear.joint, "angle")


def depth_per_turn(seen, model, bins):
    """Depth (bins,) [m] that a turn takes off the bearing, the mean over the window."""
    pin, joint = _pin(seen, model), _joint(model.spec)
    taken = deposit(seen.t, contact_angle(seen, model), pin["normal"], pin["slip"], joint.wear_coefficient, joint.bearing_radius,
                    joint.length, bins)
    return taken * model.period / (seen.t[-1] - seen.t[0])


def _largest_force(seen, model):
    pin = _pin(seen, model)
    return float(np.max(np.hypot(pin["fx"], pin["fy"])))


def _loads(seen, model):
    if not model.spec.outputs:
        return ()
    ideal, loads = ideal_record(model), []
    for output in model.spec.outputs:
        peak = largest(ideal.t, acceleration(ideal, output)[0])
        loads.append(impact_load(seen.t, acceleration(seen, output)[0], peak, model.period).coefficient)
    return tuple(loads)


# -- what is told --------------------------------------------------------------------------------------------------------------


def _values(joint, depth, cycles):
    name = joint.name
    volume = TURN * joint.bearing_radius * joint.length * np.mean(depth)
    return {
        f"wear.{name}.max_depth": Value(float(np.max(depth)), "m", f"largest depth worn off the bearing of joint {name!r}"),
        f"wear.{name}.volume": Value(float(volume), "m^3", f"volume worn off the bearing of joint {name!r}"),
        f"wear.{name}.clearance_growth": Value(clearance_growth(depth), "m", f"largest growth of the radial clearance of joint {name!r}: "
                                                                             "half of what two opposite sides lost"),
        f"wear.{name}.cycles": Value(float(cycles), "-", "turns of the drive behind it")}


def clearance_growth(depth):
    """Largest growth of the radial clearance in any direction [m]: half the sum of the depths (bins,) of two opposite sides."""
    angles = np.arange(len(depth)) + len(depth) / 2
    return float(0.5 * np.max(depth + np.interp(angles, np.arange(2 * len(depth)), np.tile(depth, 2))))


def _profiles(joint, stages, depth):
    after = [*(stage.depth for stage in stages[1:]), depth]
    middle = len(after) // 2
    angle = np.arange(len(depth)) * TURN / len(depth)
    return Table(f"wear.{joint.name}", f"Wear of the bearing of joint {joint.name!r}", (
        Column("angle", "rad", f"place on the bearing, in the frame of {place(joint.connects[0])[0]!r}", angle),
        Column("first", "m", "depth after the first jump", after[0]),
        Column("middle", "m", f"depth after jump {middle + 1} of {len(after)}", after[middle]),
        Column("last", "m", "depth at the end", after[-1])))


def _history(model, joint, stages):
    volume = TURN * joint.bearing_radius * joint.length
    loads = [Column(f"impact_load.{output.name}", "-", f"impact load coefficient of {output.name!r}",
                    np.array([stage.loads[k] for stage in stages])) for k, output in enumerate(model.spec.outputs)]
    return Table(f"wear.{joint.name}.cycles", f"Joint {joint.name!r} while it wears", (
        Column("cycles", "-", "turns of the drive behind it", np.array([stage.cycles for stage in stages])),
        Column("max_depth", "m", "largest depth", np.array([np.max(stage.depth) for stage in stages])),
        Column("volume", "m^3", "volume worn off", np.array([volume * np.mean(stage.depth) for stage in stages])),
        Column("volume_per_turn", "m^3", "volume that a turn wears off", np.array([volume * np.mean(stage.per_turn) for stage in stages])),
        Column("max_force", "N", f"largest force in joint {joint.name!r}", np.array([stage.force for stage in stages])), *loads))


def _findings(joint, depth, step):
    found, slope = [], float(np.max(np.abs(np.diff(depth, append=depth[0])))) * len(depth) / TURN
    if slope > FLAT * joint.clearance:
        found.append(
            f"wear of joint {joint.name!r}: the worn profile has slopes of {1e3 * slope:.3g} mm/rad beside a clearance of "
            f"{1e3 * joint.clearance:.3g} mm. The contact is looked for on the side where the journal's centre is; that is good up to "
            f"slopes of about {FLAT:g} times the clearance. Take fewer cycles, or fewer bins")
    if step > SMALL * joint.clearance:
        found.append(f"wear of joint {joint.name!r}: a jump takes off up to {1e3 * step:.3g} mm, {step / joint.clearance:.2g} times the "
                     f"clearance of {1e3 * joint.clearance:.3g} mm, as if the motion stayed the same meanwhile; take more jumps")
    return tuple(found)
