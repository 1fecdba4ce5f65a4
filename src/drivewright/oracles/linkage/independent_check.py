"""The linkage once more, by routes that share no equation with the motion of the multibody kernel.

Every linkage: joints closed and Newton's and Euler's equations met in absolute coordinates.  Without freedom: differences of the
angles.  Four-bars: the closed form of the loop.  What Exudyn knows: the same mechanism as a multibody model with constraints.
Rows are tuples (name, ours, other, unit, allowed difference, route) in SI.
"""

import numpy as np

from drivewright.errors import MissingExtra
from drivewright.mechanisms.linkage.build import LinkageModel
from drivewright.multibody.analyses.simulation_model import ideal_record, run_of
from drivewright.multibody.model import GROUND, Dry, Ideal, PinSlot, Prismatic, Revolute, Rolling
from drivewright.multibody.observe import FIELDS, PIN_FIELDS, observe
from drivewright.multibody.reactions import observed_bodies, reactions
from drivewright.multibody.simulate import Settings, simulate, states_outside_folds
from drivewright.oracles.linkage.four_bar import closed_form
from drivewright.registry import LeftOut, Row

SHOWN = 400  # states at which joints are looked at
POSE = slice(0, 6)  # of FIELDS: place, angle, and their rates
FREE = (0.05, 0.95)  # a pin in flight lies that far off its centre, over the play
BEFORE = 0.98  # of the way to the touch from which on a contact lasts
STEPS = {"smooth": 4000, "dry": 24000}  # of Exudyn, per turn; a second run takes half (a quarter of) the step
PART = {"smooth": 1.0, "dry": 0.12}  # of a turn that is compared: after impacts two motions part exponentially
LONGEST = 0.5  # of a mechanism without turns [s]
ABSOLUTE = "equations of the bodies in absolute coordinates, reactions of the joints by least squares"
EXUDYN = "Exudyn: absolute coordinates, trapezoidal rule; allowed is five times what its own answer still changes with the step"
IN_EXUDYN = "the linkage in Exudyn"
TIMES = 5  # a halved step shows the error of the second order and less of that of an impact


def verify(model: LinkageModel, result: object) -> tuple[Row | LeftOut, ...]:
    """All rows; of a linkage that Exudyn does not know, or without Exudyn, what is left out."""
    states = list(_observed_states(model))
    mechanics = (*_closed_joints(model, states), *_newton_euler(model, states), *_friction(model, states))
    return (*mechanics, *_differences(model), *closed_form(model), *_exudyn_rows(model))


# -- joints and equations ------------------------------------------------------------------------------------------------------


def _closed_joints(model, states):
    """How far the two halves of every joint without play part, in place and across its line."""
    names, wide = model.assembly.names, model.assembly.expanded
    places = _Places(wide, names, np.concatenate([observed.bodies[:, :, POSE] for _, observed in states]))
    misses = {Revolute: [], Prismatic: [], PinSlot: []}
    for joint in wide.joints:
        if isinstance(joint, (Prismatic, PinSlot)):
            across = places.of(joint.first) - places.of(joint.second)
            misses[type(joint)].append(np.abs((across * np.conj(complex(*joint.axis) * places.turned(joint.second.body))).imag))
        elif isinstance(joint, Revolute) and isinstance(joint.model, Ideal):
            misses[Revolute].append(np.abs(places.of(joint.first) - places.of(joint.second)))
    for kind, miss in misses.items():
        if miss:
            yield (
                f"ideal joints, {kind.__name__.lower()}: maximum gap",
                0.0,
                float(np.max(miss)),
                "m",
                1e-9 * places.size,
                "joint positions from the poses of both bodies",
            )


class _Places:
    """World places of markers over states, from the poses of the bodies."""

    def __init__(self, model, names, poses):
        self.names, self.poses = names, poses
        self.centroids = {GROUND: (0.0, 0.0), **{body.name: body.centroid for body in model.bodies}}
        self.size = float(np.ptp(poses[:, :, :2], axis=(0, 1)).max())

    def turned(self, body):
        return np.exp(1j * self.poses[:, self.names.index(body), 2])

    def of(self, marker):
        x, y = self.poses[:, self.names.index(marker.body), :2].T
        cx, cy = self.centroids[marker.body]
        return x + 1j * y + complex(marker.x - cx, marker.y - cy) * self.turned(marker.body)


def _observed_states(model):
    """(system, `Observed`) of states spread over each stretch of the run, folds left out: there forces in the joints are mere limits."""
    for system, t, y in states_outside_folds(run_of(model)):
        rows = slice(None, None, max(1, len(t) // SHOWN))
        yield system, observe(system, t[rows], y[rows])


def _newton_euler(model, states):
    """What no reactions of the joints could make up for in the equations of every body; the drives' torques by these equations."""
    solved = [reactions(model.assembly, system, observed) for system, observed in states]
    left = max(float(np.max(solution.residual)) for solution in solved)
    yield "Newton-Euler equations: maximum residual, relative to the largest force", 0.0, left, "-", 1e-8, ABSOLUTE
    ours, other = (
        np.concatenate(parts) for parts in ([observed.drives for _, observed in states], [solution.drives for solution in solved])
    )
    for k, drive in enumerate(model.assembly.model.drives):
        worst, size = np.argmax(np.abs(ours[:, k] - other[:, k])), float(np.max(np.abs(ours[:, k])))
        unit = "N" if isinstance(next(j for j in model.assembly.model.joints if j.name == drive.joint), Prismatic) else "N m"
        name = f"drive of {drive.joint!r}, at the maximum difference"
        yield name, float(ours[worst, k]), float(other[worst, k]), unit, 1e-8 * size + 1e-12, ABSOLUTE


def _friction(model, states):
    """Friction at the coefficient 1 of every ideal joint that rubs, from the forces by the equations of the bodies."""
    rubbing = [joint for joint in model.assembly.expanded.joints if joint.friction_force]
    solved = [(observed, reactions(model.assembly, system, observed)) for system, observed in states if rubbing]
    for k, joint in enumerate(rubbing):
        parts = [(one.friction(k, "load"), _load_by_reaction(model, joint, one, found.joints[joint.name])) for one, found in solved]
        ours, other = (np.concatenate(part) for part in zip(*parts, strict=True))
        worst, size = np.argmax(np.abs(ours - other)), float(np.max(np.abs(other)))
        unit = "N m" if isinstance(joint, (Revolute, Rolling)) else "N"
        name = f"friction in {joint.name!r} over its coefficient, at the maximum difference"
        yield name, float(ours[worst]), float(other[worst]), unit, 1e-7 * size + 1e-12, ABSOLUTE


def _load_by_reaction(model, joint, observed, reaction):
    rub = joint.friction
    if isinstance(joint, Revolute):
        return rub.arm * np.hypot(*reaction.force.T)
    places = observed_bodies(model.assembly, observed)
    if isinstance(joint, Rolling):
        across = places.point(joint.first) - places.point(joint.second)
        if not joint.track_radius:
            across = places.rotated(joint.second.body, (-joint.axis[1], joint.axis[0]))
        return rub.arm * np.abs(np.sum(reaction.force * across, axis=1)) / np.hypot(*across.T)
    across = places.rotated(joint.second.body, np.array([-joint.axis[1], joint.axis[0]]) / np.hypot(*joint.axis))
    normal = np.abs(np.sum(reaction.force * across, axis=1))
    return np.maximum(normal, 2 * np.abs(reaction.moment) / rub.guide) if isinstance(joint, Prismatic) and rub.guide else normal


def _differences(model):
    """Without freedom: the outputs' accelerations by differences over a turn."""
    if model.assembly.freedom:
        return
    states = ideal_record(model)
    step = states.t[1] - states.t[0]
    for output in model.spec.outputs:
        angle, alpha = states.point(output.name, "angle"), states.point(output.name, "alpha")[1:-1]
        bent = (angle[2:] - 2 * angle[1:-1] + angle[:-2]) / step**2
        worst, size = np.argmax(np.abs(bent - alpha)), float(np.max(np.abs(alpha)))
        yield (
            f"{output.name}, angular acceleration at the maximum difference",
            float(alpha[worst]),
            float(bent[worst]),
            "rad/s^2",
            1e-4 * size + 1e-14 / step**2,
            "finite differences of the angle",
        )


# -- Exudyn ----------------------------------------------------------------------------------------------------------------------


def _exudyn_rows(model):
    """The rows of Exudyn, or why there are none."""
    if missing := _missing_in_exudyn(model):
        yield LeftOut(IN_EXUDYN, f"its Exudyn model does not support {missing}")
        return
    try:
        yield from _exudyn(model)
    except MissingExtra as error:
        yield LeftOut(IN_EXUDYN, str(error), error.extra)


def _missing_in_exudyn(model):
    """What of the mechanism Exudyn's twin does not have; empty where nothing is missing."""
    wide, spec = model.assembly.model, model.spec
    pins = [joint.model for joint in wide.joints if isinstance(joint, Revolute)]
    smooth = all(isinstance(pin, Ideal) or (isinstance(pin, Dry) and _plain(pin)) for pin in pins)
    joints = all(isinstance(joint, (Revolute, Prismatic, PinSlot)) for joint in wide.joints)
    tables = any(item.file for item in (*spec.torques, *spec.forces))
    steady = all(drive.speed is not None for drive in spec.all_drives.values())
    smooth_joints = model.assembly.freedom == 0 or not any(joint.friction_force for joint in wide.joints)
    massive = all(body.mass > 0 and body.inertia > 0 for body in wide.bodies)
    known = {
        "the law of a joint with clearance": smooth,
        "a type of joint": joints,
        "friction in ideal joints": smooth_joints,
        "loads from a table": not tables,
        "a drive of variable speed": steady,
        "bodies without mass or inertia": massive,
    }
    return ", ".join(words for words, there in known.items() if not there)


def _plain(dry):
    """Whether Exudyn's contact law is that of a dry pin."""
    ramp = dry.friction.law == "ambrosio" and dry.friction.dead_speed == 0
    return dry.law is None and not dry.cylinder and dry.hysteresis < 1.5 and dry.damping == 0 and (dry.friction.coefficient == 0 or ramp)


def _exudyn(model):
    """Poses after a part of a turn by Exudyn, at two steps."""
    try:
        from drivewright.oracles.linkage import exudyn_model
    except ImportError as error:
        raise MissingExtra("the linkage in Exudyn", "peers", error) from None
    kind = "dry" if model.pins else "smooth"
    state = _start(model)
    if state is None:
        yield LeftOut(IN_EXUDYN, "there is no recorded instant at which all pins are in flight")
        return
    system, t, y, start = state
    length = _until_lasting(model, system, t, y, min(PART[kind] * (model.period or LONGEST), model.run_length))
    ours = _final_poses(model, system, t, y, length)
    step, finer = (model.period or LONGEST) / STEPS[kind], 4 if kind == "dry" else 2
    coarse, fine = (exudyn_model.run(model.assembly.model, start, length, h, samples=2) for h in (step, step / finer))
    yield from _pose_rows(model, ours, coarse, fine, kind, length)


def _start(model):
    """(system, time, state, {body: pose and rates}) from which both start: the model's own, or one with every dry pin in flight."""
    if not model.pins:
        run = simulate(model.assembly, 0.0, Settings(), samples=np.zeros(1))
        stretch, row = run.stretches[0], 0
    else:
        stretch = run_of(model).stretches[0]
        row = _in_flight(model, stretch)
        if row is None:
            return None
    bodies = observe(stretch.system, stretch.t[row : row + 1], stretch.y[row : row + 1]).bodies[0]
    poses = {body.name: bodies[model.assembly.names.index(body.name), POSE] for body in model.assembly.model.bodies}
    return stretch.system, float(stretch.t[row]), stretch.y[row], poses


def _in_flight(model, stretch):
    """First recorded state in which every pin lies between centre and contact; None without one."""
    plays = np.array([joint.model.clearance for joint in model.assembly.model.joints if joint.name in model.pins])
    states = observe(stretch.system, stretch.t[: 20 * SHOWN], stretch.y[: 20 * SHOWN])
    off = 1 + states.pins[:, :, PIN_FIELDS.index("depth")] / plays
    rows = np.flatnonzero(np.all((off > FREE[0]) & (off < FREE[1]), axis=1))
    return int(rows[0]) if len(rows) else None


def _until_lasting(model, system, t, y, length) -> float:
    """The length, or less: to the end of the flight before the first contact that lasts, for which Exudyn keeps the approach speed."""
    if not model.pins:
        return length
    run = simulate(model.assembly, length, Settings(1e-10), state=y, start=t)
    times = np.concatenate([part.t for part in run.stretches])
    memories = np.concatenate([part.y[:, part.system.contacts.memory] for part in run.stretches])
    lasting = np.flatnonzero(np.any(memories < 0, axis=1))
    if not len(lasting):
        return length
    flight = np.flatnonzero(np.all(memories[: lasting[0]] == 0, axis=1))
    return BEFORE * (times[flight[-1]] - t)


def _final_poses(model, system, t, y, length):
    """{body: pose and rates} after `length` [s], from a state."""
    if model.assembly.freedom == 0:
        done = simulate(model.assembly, length, Settings(), samples=np.array([length]))
    else:
        done = simulate(model.assembly, length, Settings(1e-10), samples=np.empty(0), state=y, start=t)
    system, t, y = done.end
    bodies = observe(system, [t], y[None]).bodies[0]
    return {body.name: bodies[model.assembly.names.index(body.name), POSE] for body in model.assembly.model.bodies}


def _pose_rows(model, ours, coarse, fine, kind, length):
    """Rows of every moving body: place and angle."""
    size = max(float(np.max(np.abs(pose[:2]))) for pose in ours.values())
    still = 3e-7 * size if kind == "smooth" else 0.02 * min(j.model.clearance for j in model.assembly.model.joints if j.name in model.pins)
    changes = {name: np.abs(coarse.bodies[name][-1] - fine.bodies[name][-1]) for name in ours}
    place, angle = (max(float(np.max(change[part])) for change in changes.values()) for part in (slice(0, 2), slice(2, 3)))
    after = f"after {length / model.period:.3g} turns" if model.period else "at the end"
    for name, pose in ours.items():
        for k, field in enumerate(FIELDS[:3]):
            allowed, unit = (place, "m") if k < 2 else (angle, "rad")
            limit = still if k < 2 else still / size
            other = float(fine.bodies[name][-1, k])
            yield f"bodies.{name}.{field} {after}", float(pose[k]), other, unit, min(TIMES * allowed + 1e-12, limit), EXUDYN
