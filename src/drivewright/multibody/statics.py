"""Statics: where a mechanism comes to rest, and what its drives must give to hold it.

Method: pseudo-transient continuation with switched evolution relaxation (Kelley & Keyes 1998, recalled).  The mechanism creeps against
a resistance,  (1/h + K) dx = Q,  whose time step h grows as the generalised forces Q shrink: far from an equilibrium it slides
downhill, near to one this is Newton's method.  Coordinates are scaled so that a unit of each moves the bodies alike.
"""

from typing import NamedTuple

import numpy as np

from drivewright._jit import outer
from drivewright.errors import InputError, SolverError
from drivewright.multibody.chart import configure
from drivewright.multibody.dynamics import inertia, validity_of_split
from drivewright.multibody.loads import LASTING, load
from drivewright.multibody.partition import at
from drivewright.multibody.simulate import resplit
from drivewright.multibody.system import CURVE, DRIFT, PIECE, System, Work, motion

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

    state: np.ndarray
    residual: float
    stable: bool


class Reduced(NamedTuple):
    """The system in its independent coordinates x:  mass (f, f) x'' = force (f,).

    size: of the forces on the bodies [N], torques counting over the mechanism's length, for what is small beside them.
    motions (bodies, 3, f): d(x, y, angle of a body)/dx.  drives (d,): what every drive gives while x'' = 0.
    """

    mass: np.ndarray
    force: np.ndarray
    size: float
    motions: np.ndarray
    drives: np.ndarray


class Place(NamedTuple):
    """A system at time t and state y, with scratch."""

    system: System
    work: Work
    t: float
    y: np.ndarray

    @property
    def free(self):
        """Where the independent coordinates are in the state."""
        return np.searchsorted(self.system.stored, self.system.independent)


def equilibrium(assembly, state=None, time=0.0):
    """`Equilibrium` to which the mechanism creeps from a state, its drives held where they are at `time`; rates do not count.

    A state near an unstable equilibrium leads there.  Raises SolverError, the last state as `partial`, where there is none.
    """
    here = resting(assembly, state, time)
    length = here.system.length
    for _ in range(TRIES):
        now = reduced(here)
        scale = scales(now, length)
        stiffness = scaled_stiffness(here, scale, NUDGE * length)
        force, whole = forces_at_work(now, stiffness, scale, length)
        residual, soft = float(np.linalg.norm(force) / whole), NEUTRAL * whole / length
        resistance = np.linalg.norm(force) / (REACH * length) if residual > SETTLED else 0.0
        step = _way(stiffness + resistance * np.eye(len(force)), force, soft)
        if residual <= SETTLED and np.linalg.norm(step) <= SETTLED * length:
            return Equilibrium(here.y, residual, bool(np.all(np.linalg.eigvals(stiffness).real > soft)))
        step *= min(1.0, LONGEST * length / max(np.linalg.norm(step), 1e-300))
        here = _firm(carried(here, here.t, step * scale))
    raise SolverError(_restless(assembly, here, force, residual), partial=here.y)


def balance(assembly, state=None, time=0.0):
    """Torque or force (drives,) with which each drive holds the mechanism at rest at `time`; what is free is in equilibrium."""
    if not assembly.model.drives:
        raise InputError("statics: the mechanism has no drive whose torque could be asked for; give it one, or ask for its equilibrium")
    rest = equilibrium(assembly, state, time)
    return reduced(resting(assembly, rest.state, time)).drives


# ------------------------------------------------------------------------------------------------------------------ places


def resting(assembly, state, time):
    """`Place` of a state, or of the start carried on to `time`, at rest: drives held, pins with play pressed where they overlap."""
    system = assembly.system
    y = at_rest(system, assembly.state if state is None else np.array(state, float))
    here = Place(system, motion(system).work, time, y)
    if state is None and len(system.driven) and time:
        ends = [at(system, assembly.start.q, t).coordinates.q[system.driven.coordinate] for t in (0.0, time)]
        ramp = _driven_by(system, ends[0], ends[1] - ends[0])
        here = carried(Place(ramp, here.work, 0.0, y), 1.0, np.zeros(len(system.independent)))
    return Place(held(system, time), here.work, time, here.y)


def at_rest(system, y):
    """A state without rates, every pin in lasting contact, so that its walls press wherever they overlap."""
    still = np.zeros_like(y)
    still[: len(system.stored)] = y[: len(system.stored)]
    still[system.contacts.memory] = LASTING
    return still


def held(system, time):
    """The system with its drives stopped where they are at `time`."""
    driven = system.driven.coordinate
    values = at(system, np.zeros(len(system.stored) + len(driven)), time).coordinates.q[driven]
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


@outer
def loaded(system, work, t, y, dy):
    """Everything but the accelerations of a state in `work`; False where the loops cannot be closed."""
    closed = configure(system, work, t, y)
    inertia(system, work)
    load(system, work, t, y, dy)
    return closed


def carried(here, t, shift):
    """The place at another time and with the independent coordinates shifted, in steps that stay on the assembly, as far as it goes."""
    system, work, _, y = here
    loaded(system, work, here.t, y, np.empty_like(y))
    done, part, last = 0.0, 1.0, work.coordinates.q.copy()
    while done < 1.0:
        trial, s = y.copy(), done + part
        trial[here.free] = here.y[here.free] + s * shift
        closed = loaded(system, work, here.t + s * (t - here.t), trial, np.empty_like(y))
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


def _firm(here):
    """The place with its coordinates split anew where the dependent ones have come near to a dead point."""
    loaded(here.system, here.work, here.t, here.y, np.empty_like(here.y))
    if validity_of_split(here.system, here.work) > 0.0:
        return here
    system, y = resplit(here.system, here.t, here.y)
    return Place(system, motion(system).work, here.t, at_rest(system, y))


# ------------------------------------------------------------------------------------------------------- reduced equations


def reduced(here):
    """`Reduced` at a place."""
    system, work = here.system, here.work
    loaded(system, work, here.t, here.y, np.empty_like(here.y))
    levers = np.stack([work.levers.x, work.levers.y, work.levers.t], axis=1)  # (bodies, 3, coordinates)
    driven, dependent = system.driven.coordinate, levers[:, :, system.dependent]
    motions = levers[:, :, system.independent] + dependent @ work.follow[:, : len(system.independent)]
    led = levers[:, :, driven] - dependent @ np.linalg.solve(work.jacobian[:, system.dependent], work.jacobian[:, driven])
    poses, none = work.poses, np.zeros(len(work.poses))
    mass = np.stack([system.bodies.mass, system.bodies.mass, system.bodies.inertia], axis=-1)
    bent = np.stack([poses.bx, poses.by, none], axis=-1) + dependent @ work.columns[DRIFT]
    bent += levers[:, :, driven] @ work.coordinates.a[driven]
    loads, weight = np.stack([poses.fx, poses.fy, poses.ft], axis=-1), mass * [system.gravity_x, system.gravity_y, 0.0]
    rest = loads + weight - mass * bent
    return Reduced(
        mass=np.einsum("bcm,bc,bcn->mn", motions, mass, motions),
        force=np.einsum("bcm,bc->m", motions, rest),
        size=float(np.sum((np.abs(loads) + np.abs(weight) + np.abs(mass * bent))[1:] / [1.0, 1.0, system.length])),
        motions=motions,
        drives=-system.driven.sign * np.einsum("bcd,bc->d", led, rest),
    )


def scales(now, length):
    """Change of every independent coordinate that moves the bodies by one metre in all, a turn counting as the length."""
    return 1.0 / np.sqrt(np.einsum("bcm,c->m", now.motions**2, [1.0, 1.0, length**2]))


def scaled_stiffness(here, scale, step):
    """-d(force)/d(coordinates), both scaled, by central differences over +-step."""

    def force(shift):
        return reduced(carried(here, here.t, shift)).force * scale

    columns = [(force(-shift) - force(shift)) / (2 * step) for shift in step * np.diag(scale)]
    return np.array(columns).T.reshape(len(scale), len(scale))


def forces_at_work(now, stiffness, scale, length):
    """(scaled force, size of the forces that make it: those on the bodies, and those of a displacement by the length)."""
    return now.force * scale, now.size + length * float(np.max(np.abs(stiffness), initial=0.0)) or 1.0


def _way(stiffness, force, soft):
    """The least dx of stiffness dx = force, nothing along directions of less stiffness than `soft`."""
    u, values, v = np.linalg.svd(stiffness)
    return v.T @ (u.T @ force / np.where(values > soft, values, np.inf))


def names_of(assembly, system):
    """Names of the independent coordinates of a system of the assembly."""
    names = {}
    for link in assembly.tree.links:
        names[link.turn] = f"{link.body.name}.angle"
        if link.free >= 0:
            names |= {link.free: f"{link.body.name}.x", link.free + 1: f"{link.body.name}.y"}
        if link.slide >= 0:
            names[link.slide] = f"{link.joint.name}.slide"
    return tuple(names[k] for k in system.independent)


def _restless(assembly, here, force, residual):
    worst = int(np.argmax(np.abs(force)))
    name = names_of(assembly, here.system)[worst]
    gone = np.max(np.abs(here.y - at_rest(assembly.system, assembly.state)))
    return (
        f"statics: no equilibrium found in {TRIES} steps. Coordinate {name!r} is still pushed by {abs(force[worst]):.4g} N, "
        f"{residual:.2g} of the forces at work, after a way of {gone:.3g} rad or m. A mechanism that a load drives on for ever has no "
        "equilibrium: add a spring or a stop, or drive that coordinate; otherwise start nearer to where it rests"
    )
