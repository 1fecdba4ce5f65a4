"""A planar system as plain arrays for the compiled kernels.

Bodies hang in a tree; body 0 is the ground.  Every frame has its origin in the centroid.  A coordinate is the rotation of a body
(against the world, or against its parent where the joint is driven), the slide of a joint, or x and y of a body that hangs on
nothing.  Joints that close loops are constraint rows.  Of the coordinates some are driven (given functions of time), the rest is
split into independent and dependent ones; the rows make the dependent ones follow.
"""

from typing import NamedTuple, cast

import numpy as np

from drivewright._jit import by_reference
from drivewright._typing import Floats, Ints
from drivewright.multibody.forces.contact import LUGRE, Laws, NoLaws
from drivewright.multibody.forces.joint_friction import JOINT_FIELDS, STATES, FrictionWork, JointFrictions, NoFrictionWork, NoJointFriction
from drivewright.multibody.joints.rows import Equations, NoEquations
from drivewright.multibody.records import Records, empty_table, record_type

# r = r_parent + R_parent (a + s e) - R (b + s f), s the slide: one of e and f is 0.  `free`: x, y are coordinates free, free + 1.
# `driven`: it follows the drives alone.
BODY = record_type("parent turn slide free driven", "inherits offset ax ay bx by ex ey fx fy mass inertia")

# `extent` of its residual: the length of the mechanism, or 1 where the residual is an angle.
ROW = record_type("kind i j k l lift joint", "ax ay bx by ex ey gi gj gk constant extent")

DRIVEN = record_type("coordinate curve", "sign start")
CURVE = record_type("first count", "period")
PIECE = record_type("", "start c0 c1 c2 c3 c4 c5")

# What a run finds at the state it was last asked about.
COORDINATE = record_type("", "q v a")  # value, rate, acceleration
# Place, rates, velocity-product acceleration (that at zero q''), force through the centroid, torque.
POSE = record_type("", "x y c s angle vx vy w bias_x bias_y fx fy ft")
PARTIAL_VELOCITY = record_type("", "x y t")  # d(place, angle)/d(coordinate)
RESIDUAL, BIAS, SCRATCH = range(3)  # residual of the rows; q'' of the dependent coordinates at zero q'' of the independent ones; scratch


@by_reference
class Chart(NamedTuple):
    """The dependent coordinates across a singular position, as values at nodes on both sides of it; see `multibody.chart`.

    z are the independent coordinates.  A state lies at  x = normal . (z - origin) + normal_time (t - origin_time)  from the singular
    position; the node k stands at z + (offsets[k] - x) direction and t + (offsets[k] - x) pace.  No nodes: there is no singular
    position, and the loops are closed at the state itself.
    """

    offsets: Floats  # (nodes,)
    guesses: Floats  # (nodes, dependent): where Newton's method starts
    direction: Floats  # (independent,), per unit of x
    normal: Floats
    origin: Floats
    pace: float  # [s] per unit of x
    normal_time: float
    origin_time: float
    reach: float  # |x| up to which the chart holds


@by_reference
class System(NamedTuple):
    """Frozen arrays of records; `stored` are the coordinates in the state, dependent and independent ones."""

    bodies: Records
    rows: Records
    driven: Records
    stored: Ints
    independent: Ints
    dependent: Ints
    springs: Records
    rotational_springs: Records
    torques: Records
    forces: Records
    actuators: Records
    bushings: Records
    contacts: Records
    laws: NoLaws | Laws  # of contacts that have one of their own
    frictions: NoJointFriction | JointFrictions  # of ideal joints
    films: Floats  # (tables, 2, ...): coefficients of `contact.film_table`
    wear: Floats  # (contacts, bins): depth worn off each bearing, over the angle in its body's frame; no bins without wear
    curves: Records
    pieces: Records
    equations: NoEquations | Equations  # of rows of further kinds
    gravity_x: float
    gravity_y: float
    length: float  # of the mechanism, its largest arm [m]
    sizes: Floats  # (coordinates,): 1 of a rotation, `length` of a displacement
    reference_determinant: float  # of the dependent coordinates' Jacobian where the coordinates were split, with its sign; 0: none
    chart: Chart


@by_reference
class Work(NamedTuple):
    """Scratch of one run."""

    coordinates: Records
    poses: Records  # (bodies,)
    partial_velocities: Records  # (bodies, coordinates)
    constraint_jacobian: Floats  # (rows, coordinates)
    lu: Floats  # (rows, rows): decomposition of the Jacobian by the dependent coordinates
    pivots: Floats  # (rows,): numbers of rows, as real numbers, for cases in lanes have different ones
    row_columns: Floats  # (3, rows)
    dependency_matrix: Floats  # (rows, independent + driven): d(dependent)/d(independent and, in a chart, driven)
    reduced_partial_velocities: Records  # (bodies, independent): the dependent coordinates following
    mass: Floats  # (independent, independent): factors of the mass matrix L D L^T, see `numerics.small.ldl_factor`
    force: Floats  # (independent,)
    unit_load: Floats  # (independent,): scratch, what a unit force of a contact does
    node_state: Floats  # (stored + independent,): state of a node of the chart
    node_sums: Floats  # (rows, 3 + independent + driven): dependent coordinates, rates, bias and dependency matrix, summed over nodes
    friction: FrictionWork  # NoFrictionWork where no ideal joint rubs


@by_reference
class Motion(NamedTuple):
    """A system that moves: what the integrator integrates."""

    system: System
    work: Work


def rotation_velocities(bodies: Records, size: int) -> Floats:
    """(bodies, coordinates): d(angle)/d(coordinate), which never changes."""
    turns = np.zeros((len(bodies), size))
    parents, inherits, turning = (bodies[name].tolist() for name in ("parent", "inherits", "turn"))
    for i in range(1, len(bodies)):
        if inherits[i]:
            turns[i] = inherits[i] * turns[parents[i]]
        if turning[i] >= 0:
            turns[i, turning[i]] = 1.0
    return turns


def scratch(system: System) -> Work:
    """Fresh `Work` for a system; every thread needs its own."""
    bodies, given, rows, free = len(system.bodies), len(system.driven), len(system.rows), len(system.independent)
    n = len(system.stored) + given
    poses, partial_velocities = empty_table(POSE, bodies), empty_table(PARTIAL_VELOCITY, bodies, n)
    poses["c"] = 1.0  # of the angle 0
    partial_velocities["t"] = rotation_velocities(system.bodies, n)
    return Work(
        empty_table(COORDINATE, n),
        poses,
        partial_velocities,
        np.zeros((rows, n)),
        np.zeros((rows, rows)),
        np.zeros(rows),
        np.zeros((3, rows)),
        np.zeros((rows, free + given)),
        empty_table(PARTIAL_VELOCITY, bodies, free),
        np.zeros((free, free)),
        np.zeros(free),
        np.zeros(free),
        np.zeros(len(system.stored) + free),
        np.zeros((rows, 3 + free + given)),
        _friction_work(system, bodies, rows, free),
    )


def _friction_work(system, bodies, rows, free):
    n = len(joints_with_friction(system))
    if n == 0:
        return cast(FrictionWork, NoFrictionWork())
    return FrictionWork(
        np.zeros((bodies, 3)),
        np.zeros((rows, 7)),
        np.zeros((n, 4)),
        np.zeros((n, free)),
        np.zeros((n, 1 + n, 2)),
        np.zeros((n, n)),
        np.zeros((2, n)),
        np.zeros((n, len(JOINT_FIELDS))),
        np.zeros(free),
        np.zeros(len(system.stored) + free + memory_size(system)),
    )


def joints_with_friction(system: System) -> Records:
    """Records (joints,) of the ideal joints that rub."""
    return system.frictions.table if isinstance(system.frictions, JointFrictions) else ()


def memory_size(system: System) -> int:
    """Number of states behind coordinates and rates: what pins with play and joints with friction remember."""
    return len(system.contacts) + int(np.sum(system.contacts.law == LUGRE)) + STATES * len(joints_with_friction(system))


def no_chart(independent: int = 0, dependent: int = 0) -> Chart:
    """The `Chart` without nodes."""
    none = np.zeros(independent)
    return Chart(np.zeros(0), np.zeros((0, dependent)), none, none, none, 0.0, 0.0, 0.0, np.inf)


def length_of(*tables: Records) -> float:
    """The largest arm in tables of records: how large the mechanism is [m]; 1 where all are zero."""
    arms = [table[name] for table in tables for name in ("ax", "ay", "bx", "by") if name in table.dtype.names]
    return float(np.max(np.abs(np.concatenate([np.zeros(1), *arms])))) or 1.0


def motion(system: System) -> Motion:
    """The `Motion` of a system with scratch of its own."""
    return Motion(system, scratch(system))
