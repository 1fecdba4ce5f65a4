"""Statics: where a mechanism comes to rest, and what its drives must give to hold it.

Method: pseudo-transient continuation with switched evolution relaxation (Kelley & Keyes 1998, recalled).  The mechanism creeps against
a resistance,  (1/h + K) dx = Q,  whose time step h grows as the generalised forces Q shrink: far from an equilibrium it slides
downhill, near to one this is Newton's method.  Coordinates are scaled so that a unit of each moves the bodies alike.
"""

from typing import NamedTuple

import numpy as np

from drivewright._jit import inner
from drivewright._typing import Floats, Ints
from drivewright.errors import InputError, SolverError
from drivewright.multibody.assembly import Assembly
from drivewright.multibody.chart import update_kinematics
from drivewright.multibody.dynamics import validity_of_split
from drivewright.multibody.forces.pin_contact import LASTING
from drivewright.multibody.loads import apply_forces
from drivewright.multibody.mass_matrix import update_mass_matrix
from drivewright.multibody.partition import evaluate_at
from drivewright.multibody.simulate import repartition
from drivewright.multibody.system import BIAS, CURVE, PIECE, System, Work, motion

REACH = 0.1  # way of one step of creeping: an unstable equilibrium within it is found as well, in lengths of the mechanism
LONGEST = 0.3  # step of Newton's method, in the same
FLIP = 0.5  # change of a coordinate at once that may lead to another assembly [rad], [lengths of the mechanism]
SHORTEST = 1e-6  # part of a step below which the loops do not let it through
SETTLED = 1e-10  # generalised force over the forces that make it, and last step over the mechanism's length
TRIES = 300
NUDGE = 1e-6  # step of the numerical stiffness, in lengths of the mechanism
NEUTRAL = 1e-9  # stiffness over the forces at work per length that counts as none


class Equilibrium(NamedTuple):
    """`state` of the assembly's system at rest; `residual`: generalised force left over, as a part of those that make it.

    stable: every small displacement is pushed back.  A neutral equilibrium is not stable.
    """

    state: Floats
    residual: float
    stable: bool


class ReducedEquations(NamedTuple):
    """The system in its independent coordinates x:  mass (f, f) x'' = force (f,).

    size: of the forces on the bodies [N], torques counting over the mechanism's length, for what is small beside them.
    motions (bodies, 3, f): d(x, y, angle of a body)/dx.  drives (d,): what every drive gives while x'' = 0.
    """

    mass: Floats
    force: Floats
    size: float
    motions: Floats
    drives: Floats


class Place(NamedTuple):
    """A system at time t and state y, with scratch."""

    system: System
    work: Work
    t: float
    y: Floats

    @property
    def free(self) -> Ints:
        """Where the independent coordinates are in the state."""
        return np.searchsorted(self.system.stored, self.system.independent)


def equilibrium(assembly: Assembly, state: Floats | None = None, time: float = 0.0) -> Equilibrium:
    """`Equilibrium` to which the mechanism creeps from a state, its drives held where they are at `time`; rates do not count.

    A state near an unstable equilibrium leads there.  Raises SolverError, the last state as `partial`, where there is none.
    """
    here = place_at_rest(assembly, state, time)
    length, force, residual = here.system.length, np.zeros(0), np.inf
    for _ in range(TRIES):
        now = reduced_equations(here)
        scale = coordinate_scales(now, length)
        stiffness = scaled_stiffness(here, scale, NUDGE * length)
        force, whole = forces_at_work(now, stiffness, scale, length)
        residual, soft = float(np.linalg.norm(force) / whole), NEUTRAL * whole / length
        resistance = np.linalg.norm(force) / (REACH * length) if residual > SETTLED else 0.0
        step = _way(stiffness + resistance * np.eye(len(force)), force, soft)
        if residual <= SETTLED and np.linalg.norm(step) <= SETTLED * length:
            return Equilibrium(here.y, residual, bool(np.all(np.linalg.eigvals(stiffness).real > soft)))
        step *= min(1.0, LONGEST * length / max(np.linalg.norm(step), 1e-300))
        here = _repartitioned(displaced(here, here.t, step * scale))
    raise SolverError(_restless(assembly, here, force, residual), partial=here.y)


def balance(assembly: Assembly, state: Floats | None = None, time: float = 0.0) -> Floats:
    """Torque or force (drives,) with which each drive holds the mechanism at rest at `time`; what is free is in equilibrium."""
    if not assembly.model.drives:
        raise InputError("statics: the mechanism has no drive, so there is no holding torque; add a drive, or compute the equilibrium")
    rest = equilibrium(assembly, state, time)
    return reduced_equations(place_at_rest(assembly, rest.state, time)).drives


# ------------------------------------------------------------------------------------------------------------------ places


def place_at_rest(assembly: Assembly, state: Floats | None, time: float) -> Place:
    """`Place` of a state, or of the start carried on to `time`, at rest: drives held, pins with play pressed where they overlap."""
    system = assembly.system
    y = state_at_rest(system, assembly.state if state is None else np.array(state, float))
    here = Place(system, motion(system).work, time, y)
    if state is None and len(system.driven) and time:
        ends = [evaluate_at(system, assembly.start.q, t).coordinates.q[system.driven.coordinate] for t in (0.0, time)]
        ramp = _driven_by(system, ends[0], ends[1] - ends[0])
        here = displaced(Place(ramp, here.work, 0.0, y), 1.0, np.zeros(len(system.independent)))
    return Place(with_drives_held(system, time), here.work, time, here.y)


def state_at_rest(system: System, y: Floats) -> Floats:
    """A state without rates, every pin in lasting contact, so that its walls press wherever they overlap."""
    still = np.zeros_like(y)
    still[: len(system.stored)] = y[: len(system.stored)]
    still[system.contacts.memory] = LASTING
    return still


def with_drives_held(system: System, time: float) -> System:
    """The system with its drives stopped where they are at `time`."""
    driven = system.driven.coordinate
    values = evaluate_at(system, np.zeros(len(system.stored) + len(driven)), time).coordinates.q[driven]
    return _driven_by(system, values, np.zeros(len(driven)))


def _driven_by(system, start, slope):
    """The system with driven coordinates start + slope t."""
    driven, curves, pieces = system.driven.copy(), np.zeros(len(start), CURVE), np.zeros(len(start), PIECE)
    driven["sign"], driven["start"], driven["curve"] = 1.0, start, len(system.curves) + np.arange(len(start))
    curves["first"], curves["count"], pieces["c1"] = len(system.pieces) + np.arange(len(start)), 1, slope
    return system._replace(
        driven=driven,
        curves=np.concatenate([system.curves, curves]).view(np.recarray),
        pieces=np.concatenate([system.pieces, pieces]).view(np.recarray),
    )


@inner
def evaluate_loads(system: System, work: Work, t: float, y: Floats, dy: Floats) -> bool:
    """Everything but the accelerations of a state in `work`; False where the loops cannot be closed.

    y, dy (states,) as in `loads.apply_forces`.
    """
    closed = update_kinematics(system, work, t, y)
    update_mass_matrix(system, work)
    apply_forces(system, work, t, y, dy)
    return closed


def displaced(here: Place, t: float, shift: Floats) -> Place:
    """The place at another time and with the independent coordinates shifted, in steps that stay on the assembly, as far as it goes."""
    system, work, _, y = here
    evaluate_loads(system, work, here.t, y, np.empty_like(y))
    done, part, last = 0.0, 1.0, work.coordinates.q.copy()
    while done < 1.0:
        trial, s = y.copy(), done + part
        trial[here.free] = here.y[here.free] + s * shift
        closed = evaluate_loads(system, work, here.t + s * (t - here.t), trial, np.empty_like(y))
        if closed and np.max(np.abs(work.coordinates.q - last) / system.sizes, initial=0.0) < FLIP:
            last, done = work.coordinates.q.copy(), s
            y = trial
            y[: len(system.stored)] = last[system.stored]
        elif part < SHORTEST:
            break
        else:
            part *= 0.5
        part = min(part, 1.0 - done)
    return here._replace(t=here.t + done * (t - here.t), y=y)


def _repartitioned(here):
    """The place with its coordinates split anew where the dependent ones have come near to a dead point."""
    evaluate_loads(here.system, here.work, here.t, here.y, np.empty_like(here.y))
    if validity_of_split(here.system, here.work) > 0.0:
        return here
    system, y = repartition(here.system, here.t, here.y)
    return Place(system, motion(system).work, here.t, state_at_rest(system, y))


# ------------------------------------------------------------------------------------------------------- reduced equations


def reduced_equations(here: Place) -> ReducedEquations:
    """`ReducedEquations` at a place."""
    system, work = here.system, here.work
    evaluate_loads(system, work, here.t, here.y, np.empty_like(here.y))
    partials = np.stack(
        [work.partial_velocities.x, work.partial_velocities.y, work.partial_velocities.t], axis=1
    )  # (bodies, 3, coordinates)
    driven, dependent = system.driven.coordinate, partials[:, :, system.dependent]
    motions = partials[:, :, system.independent] + dependent @ work.dependency_matrix[:, : len(system.independent)]
    led = partials[:, :, driven] - dependent @ np.linalg.solve(
        work.constraint_jacobian[:, system.dependent], work.constraint_jacobian[:, driven]
    )
    poses, none = work.poses, np.zeros(len(work.poses))
    mass = np.stack([system.bodies.mass, system.bodies.mass, system.bodies.inertia], axis=-1)
    bent = np.stack([poses.bias_x, poses.bias_y, none], axis=-1) + dependent @ work.row_columns[BIAS]
    bent += partials[:, :, driven] @ work.coordinates.a[driven]
    loads, weight = np.stack([poses.fx, poses.fy, poses.ft], axis=-1), mass * [system.gravity_x, system.gravity_y, 0.0]
    rest = loads + weight - mass * bent
    return ReducedEquations(
        mass=np.einsum("bcm,bc,bcn->mn", motions, mass, motions),
        force=np.einsum("bcm,bc->m", motions, rest),
        size=float(np.sum((np.abs(loads) + np.abs(weight) + np.abs(mass * bent))[1:] / [1.0, 1.0, system.length])),
        motions=motions,
        drives=-system.driven.sign * np.einsum("bcd,bc->d", led, rest),
    )


def coordinate_scales(now: ReducedEquations, length: float) -> Floats:
    """Change of every independent coordinate that moves the bodies by one metre in all, a turn counting as the length."""
    return 1.0 / np.sqrt(np.einsum("bcm,c->m", now.motions**2, [1.0, 1.0, length**2]))


def scaled_stiffness(here: Place, scale: Floats, step: float) -> Floats:
    """-d(force)/d(coordinates), both scaled, by central differences over +-step."""

    def force(shift):
        return reduced_equations(displaced(here, here.t, shift)).force * scale

    columns = [(force(-shift) - force(shift)) / (2 * step) for shift in step * np.diag(scale)]
    return np.array(columns).T.reshape(len(scale), len(scale))


def forces_at_work(now: ReducedEquations, stiffness: Floats, scale: Floats, length: float) -> tuple[Floats, float]:
    """(scaled force, size of the forces that make it: those on the bodies, and those of a displacement by the length)."""
    return now.force * scale, now.size + length * float(np.max(np.abs(stiffness), initial=0.0)) or 1.0


def _way(stiffness, force, soft):
    """The least dx of stiffness dx = force, nothing along directions of less stiffness than `soft`."""
    u, values, v = np.linalg.svd(stiffness)
    return v.T @ (u.T @ force / np.where(values > soft, values, np.inf))


def coordinate_names(assembly: Assembly, system: System) -> tuple[str, ...]:
    """Names of the independent coordinates of a system of the assembly."""
    names = {}
    for link in assembly.tree.links:
        names[link.turn] = f"{link.body.name}.angle"
        if link.free >= 0:
            names |= {link.free: f"{link.body.name}.x", link.free + 1: f"{link.body.name}.y"}
        if link.joint is not None and link.slide >= 0:
            names[link.slide] = f"{link.joint.name}.slide"
    return tuple(names[k] for k in system.independent)


def _restless(assembly, here, force, residual):
    worst = int(np.argmax(np.abs(force)))
    name = coordinate_names(assembly, here.system)[worst]
    gone = np.max(np.abs(here.y - state_at_rest(assembly.system, assembly.state)))
    return (
        f"statics: no equilibrium found in {TRIES} steps. At coordinate {name!r} a force of {abs(force[worst]):.4g} N is unbalanced, "
        f"{residual:.2g} of the acting forces, after a displacement of {gone:.3g} rad or m. A mechanism that a load drives without end has "
        "no equilibrium: add a spring or a stop, or drive that coordinate; otherwise start closer to the equilibrium"
    )
