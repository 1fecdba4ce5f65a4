"""Kinematic tolerances: where a mechanism without freedom is when its points are a little off and its journals off their centres.

A `Source` displaces markers of joints, in the frame of their body.  `scatter` closes every random mechanism exactly; `gradient` is the
linear theory beside it, from the Jacobian of the closed loops.
"""

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from drivewright import cases
from drivewright._jit import inner, plain
from drivewright._typing import Floats
from drivewright.errors import DoesNotAssemble, InputError, UnknownName
from drivewright.multibody.assembly import Assembly
from drivewright.multibody.bodies import Marker
from drivewright.multibody.continuation import continue_motion
from drivewright.multibody.frames import rotated
from drivewright.multibody.joints.rows import terms_of_row
from drivewright.multibody.kinematics import close_loops
from drivewright.multibody.records import Records
from drivewright.multibody.simulate import work_at_state
from drivewright.multibody.system import CURVE, PIECE, System, Work, scratch

CHUNK = 10_000  # samples between two looks at the keyboard
CIRCLE, UNIFORM, NORMAL = "circle", "uniform", "normal"
# Standard deviation of a displacement along a fixed direction, over its largest value: r cos(phi); even; three sigma.
SIGMAS = {CIRCLE: np.sqrt(0.5), UNIFORM: np.sqrt(1 / 3), NORMAL: 1 / 3}

PARENT, OWN, FIRST, SECOND, MARK = range(5)  # an arm of a body (a, b), of a row (a, b), or a watched point
SHIFT = np.dtype([(name, np.int64) for name in ("source", "what", "number")])
WATCHED = np.dtype([("body", np.int64), ("x", np.float64), ("y", np.float64)])
READINGS = ("angle", "x", "y")


class Source(NamedTuple):
    """A random displacement of points.

    law "circle": anywhere on a circle of radius `reach` [m]; "uniform": within +-reach along `direction`; "normal": along it, reach being
    three standard deviations.  `ends`: (name of a joint, 0 or 1) of the markers that it moves, first or second; `marks`: names of the
    watched markers that it moves.
    """

    name: str
    reach: float
    law: str
    ends: tuple[tuple[str, int], ...]
    direction: tuple[float, float] = (1.0, 0.0)
    marks: tuple[str, ...] = ()


def play(joint: str, clearance: float) -> Source:
    """The journal of a pin with a radial clearance [m], in touch with its bearing in any direction, seen from the bearing's body."""
    return Source(joint, clearance, CIRCLE, ((joint, 0),))


class Posture(NamedTuple):
    """A mechanism that is held still, coordinates q; the markers watched (marks,), and which arms the sources move."""

    system: System
    work: Work
    q: Floats
    marks: Records
    shifts: Records


# ------------------------------------------------------------------------------------------------------------------ posture


def posture(assembly: Assembly, markers: Mapping[str, Marker], sources: Sequence[Source], angle: float | None = None) -> Posture:
    """The `Posture` of an assembly with its first drive at `angle` [rad] (None: where it starts), watching {name: Marker}.

    Raises InputError where the drives leave a freedom, DoesNotAssemble where the drive does not get there.
    """
    if assembly.freedom:
        raise InputError(
            f"tolerances: the drives leave the mechanism {assembly.freedom} degrees of freedom, so its dimensions do not determine its "
            "position; add drives or joints"
        )
    system, work = _at_drive_angle(assembly, angle)
    return Posture(
        system, work, work.coordinates.q.copy(), _observed_points(assembly, markers), _moved_arms(assembly, system, list(markers), sources)
    )


def _at_drive_angle(assembly, angle):
    """(system, work) with the drive moved from its start to an angle, always on the same assembly."""
    system, y = assembly.system, assembly.state.copy()
    if angle is not None:
        continuation = continue_motion(_with_drive_to(system, angle), np.empty(0), 1.0, y)
        system, y = continuation.stretches[-1].system, continuation.stretches[-1].y_end
        if continuation.outcome == "stuck":
            start = system.driven[0].start
            stop = np.degrees(start + continuation.reached * (angle - start))
            raise DoesNotAssemble(
                f"tolerances: the mechanism does not close beyond {stop:.2f}° of the drive, on the way from "
                f"{np.degrees(start):.2f} to {np.degrees(angle):.2f}°. Give an angle within its range"
            )
    return system, work_at_state(system, 0.0 if angle is None else 1.0, y)


def _with_drive_to(system, angle):
    """The system with its first drive moved evenly from its start, at time 0, to an angle at time 1."""
    driven = system.driven.copy()
    driven.curve[0] = len(system.curves)
    curve = np.array([(len(system.pieces), 1, 0.0)], CURVE)
    piece = np.zeros(1, PIECE)
    piece["c1"] = angle - driven.start[0]
    joined = {"curves": np.concatenate([system.curves, curve]), "pieces": np.concatenate([system.pieces, piece])}
    return system._replace(driven=driven, **{name: array.view(np.recarray) for name, array in joined.items()})


def _observed_points(assembly, markers):
    centroids = {body.name: body.centroid for body in assembly.expanded.bodies}
    rows = []
    for marker in markers.values():
        cx, cy = centroids.get(marker.body, (0.0, 0.0))
        rows.append((assembly.names.index(marker.body), marker.x - cx, marker.y - cy))
    return np.array(rows, WATCHED).view(np.recarray)


def _moved_arms(assembly, system, marks, sources):
    """Which arms each source moves."""
    rows = []
    for number, source in enumerate(sources):
        rows += [(number, *arm) for joint, end in source.ends for arm in _arms(assembly, system, joint, end)]
        rows += [(number, MARK, marks.index(name)) for name in source.marks]
    return np.array(rows, SHIFT).view(np.recarray)


def _arms(assembly, system, name, end):
    """[(what, number)] of the arms that hold one marker of a joint."""
    for number, link in enumerate(assembly.tree.links, 1):
        if link.joint is not None and link.joint.name == name:
            own = link.joint.first.body == link.body.name
            return [(OWN if own == (end == 0) else PARENT, number)]
    names = [joint.name for joint in assembly.expanded.joints]
    if name not in names:
        raise UnknownName("joint with a tolerance", name, names)
    return [((FIRST, SECOND)[end], number) for number, row in enumerate(system.rows) if row.joint == names.index(name)]


# -------------------------------------------------------------------------------------------------------------- Monte Carlo


class Sampled(NamedTuple):
    """deviations (samples, marks, READINGS) from the nominal mechanism, nan where one does not close; whether Ctrl-C cut it short."""

    deviations: Floats
    interrupted: bool


def sample(posture: Posture, sources: Sequence[Source], samples: int, seed: int) -> Sampled:
    """`Sampled` of so many random mechanisms; the same seed gives the same ones on any number of cores."""
    sizes = [min(CHUNK, samples - first) for first in range(0, samples, CHUNK)]

    def task(chunk):
        number, size = chunk
        return deviations(posture, draw_deviations(sources, size, np.random.default_rng([seed, number])))

    rows = cases.run(task, list(enumerate(sizes)), workers=None if len(sizes) > 1 else 1)
    return Sampled(np.concatenate([row.value for row in rows.rows]), rows.interrupted)


def draw_deviations(sources: Sequence[Source], samples: int, rng: np.random.Generator) -> Floats:
    """Random displacements (samples, sources, 2) [m], each in the frame of its body."""
    moves = np.empty((samples, len(sources), 2))
    for number, source in enumerate(sources):
        if source.law == CIRCLE:
            angle = rng.uniform(0.0, 2 * np.pi, samples)
            unit = np.stack([np.cos(angle), np.sin(angle)], axis=1)
        else:
            along = rng.uniform(-1.0, 1.0, samples) if source.law == UNIFORM else rng.normal(0.0, SIGMAS[NORMAL], samples)
            unit = along[:, None] * np.asarray(source.direction)
        moves[:, number] = source.reach * unit
    return moves


def deviations(posture: Posture, moves: Floats) -> Floats:
    """What the displacements moves (m, sources, 2) do to the watched markers: (m, marks, READINGS), nan where a loop does not close."""
    system = posture.system
    own = system._replace(bodies=system.bodies.copy(), rows=system.rows.copy())  # each caller overwrites its own arms
    everything = np.concatenate([np.zeros((1, *moves.shape[1:])), moves])
    out = np.empty((len(everything), len(posture.marks), len(READINGS)))
    scatter(own, posture.system, scratch(own), posture.q, posture.shifts, everything, posture.marks.copy(), posture.marks, out)
    return out[1:] - out[0]


def kernel_of_samples(system: System) -> Callable[[], object]:
    """What compiles the kernel of `deviations` for systems like this one."""
    kernel: Any = scatter
    shifts, marks = (np.zeros(1, kind).view(np.recarray) for kind in (SHIFT, WATCHED))
    moves, readings = np.zeros((1, 1, 2)), np.zeros((1, 1, len(READINGS)))
    return partial(kernel.compile_for, system, system, scratch(system), np.zeros(1), shifts, moves, marks, marks, readings)


@inner
def scatter(
    system: System,
    nominal: System,
    work: Work,
    q: Floats,
    shifts: Records,
    moves: Floats,
    marks: Records,
    nominal_marks: Records,
    out: Floats,
) -> None:
    """Readings out (m, marks, READINGS) of the mechanism displaced by each of moves (m, sources, 2).

    The arms of `system`, and `marks`, are scratch; what they are without displacement is in `nominal` and `nominal_marks`.
    """
    for n in range(moves.shape[0]):
        _restore(system, nominal, marks, nominal_marks)
        for k in range(shifts.size):
            shift = shifts[k]
            _displace(system, marks, shift, moves[n, shift.source, 0], moves[n, shift.source, 1])
        for k in range(q.size):
            work.coordinates[k].q = q[k]
        closed = close_loops(system, work)
        for k in range(marks.size):
            here = work.poses[marks[k].body]
            px, py = rotated(here, marks[k].x, marks[k].y)
            out[n, k, 0], out[n, k, 1], out[n, k, 2] = here.angle, here.x + px, here.y + py
            if not closed:
                out[n, k, 0] = out[n, k, 1] = out[n, k, 2] = np.nan


@inner
def _restore(system, nominal, marks, nominal_marks):
    """All arms as they are nominally: adding and taking off again would let rounding pile up."""
    for i in range(system.bodies.size):
        here, there = system.bodies[i], nominal.bodies[i]
        here.ax, here.ay, here.bx, here.by = there.ax, there.ay, there.bx, there.by
    for r in range(system.rows.size):
        row, same = system.rows[r], nominal.rows[r]
        row.ax, row.ay, row.bx, row.by = same.ax, same.ay, same.bx, same.by
    for k in range(marks.size):
        mark, point = marks[k], nominal_marks[k]
        mark.x, mark.y = point.x, point.y


@inner
def _displace(system, marks, shift, dx, dy):
    """Move the arm of a body or of a row, or a watched point, by (dx, dy) [m] in its body's frame."""
    if shift.what == MARK:
        mark = marks[shift.number]
        mark.x, mark.y = mark.x + dx, mark.y + dy
    elif shift.what == PARENT or shift.what == OWN:
        body = system.bodies[shift.number]
        if shift.what == PARENT:
            body.ax, body.ay = body.ax + dx, body.ay + dy
        else:
            body.bx, body.by = body.bx + dx, body.by + dy
    else:
        row = system.rows[shift.number]
        if shift.what == FIRST:
            row.ax, row.ay = row.ax + dx, row.ay + dy
        else:
            row.bx, row.by = row.bx + dx, row.by + dy


# ------------------------------------------------------------------------------------------------------------ linear theory


def worst_moves(sources: Sequence[Source], slope: Floats) -> Floats:
    """Displacements (2, sources, 2) [m] that make a reading greatest and least by linear theory, from its gradient (sources, 2): along a
    circle in the direction of the gradient, along a fixed direction to the end that the sign of g . d says."""
    moves = np.zeros((len(sources), 2))
    for number, source in enumerate(sources):
        direction = np.asarray(source.direction)
        steep = np.hypot(*slope[number])
        if source.law == CIRCLE:
            moves[number] = source.reach * slope[number] / steep if steep > 0 else 0.0
        else:
            moves[number] = source.reach * np.sign(slope[number] @ direction) * direction
    return np.stack([moves, -moves])


class Shares(NamedTuple):
    """Linear theory: what each source does to each reading, arrays (marks, READINGS, sources): largest deviation and standard deviation."""

    worst: Floats
    sigma: Floats


def shares(sources: Sequence[Source], slopes: Floats) -> Shares:
    """`Shares` from the gradient (marks, READINGS, sources, 2): along a circle |g| r, along a direction |g . d| t."""
    worst = np.empty(slopes.shape[:-1])
    for number, source in enumerate(sources):
        slope = slopes[:, :, number]
        steep = np.hypot(slope[..., 0], slope[..., 1]) if source.law == CIRCLE else np.abs(slope @ np.asarray(source.direction))
        worst[:, :, number] = source.reach * steep
    return Shares(worst, worst * np.array([SIGMAS[source.law] for source in sources]))


def gradient(posture: Posture, count: int) -> Floats:
    """d(reading)/d(displacement) (marks, READINGS, count, 2) for `count` sources, in the frames of the bodies whose points they move.

    From the closed loops r(q, p) = 0:  dq/dp = -(dr/dq)^-1 dr/dp  for the dependent coordinates q, the driven ones held.
    """
    system, work = posture.system, posture.work
    total = np.zeros((len(posture.marks), len(READINGS), count, 2))
    normals, dependent = _normals(system, work), system.dependent
    for shift in posture.shifts:
        carried, rows, points = _moved_by(posture, shift)
        misses = np.einsum("rx,rxd->rd", normals, carried[system.rows.i] - carried[system.rows.j] + rows)
        steps = -np.linalg.solve(work.constraint_jacobian[:, dependent], misses)
        for k, mark in enumerate(posture.marks):
            partial = work.partial_velocities[mark.body, dependent]
            arm = _rotation(work.poses[mark.body]) @ (mark.x, mark.y)
            partials = np.stack([partial.t, partial.x - arm[1] * partial.t, partial.y + arm[0] * partial.t])
            total[k, :, shift.source] += partials @ steps
            total[k, 1:, shift.source] += carried[mark.body] + points[k]
    return total


def _moved_by(posture, shift):
    """What a displacement moves while the coordinates stand still, d(place)/d(displacement): bodies (n, 2, 2), rows' points of the first
    body less those of the second (rows, 2, 2), and watched points (marks, 2, 2)."""
    system, poses, number = posture.system, posture.work.poses, shift.number
    bodies, rows, marks = (np.zeros((size, 2, 2)) for size in (len(system.bodies), len(system.rows), len(posture.marks)))
    if shift.what == PARENT:
        bodies[_bodies_carried_by(system, number)] = _rotation(poses[system.bodies[number].parent])
    elif shift.what == OWN:
        bodies[_bodies_carried_by(system, number)] = -_rotation(poses[number])
    elif shift.what == FIRST:
        rows[number] = _rotation(poses[system.rows[number].i])
    elif shift.what == SECOND:
        rows[number] = -_rotation(poses[system.rows[number].j])
    else:
        marks[number] = _rotation(poses[posture.marks[number].body])
    return bodies, rows, marks


def _bodies_carried_by(system, number):
    """A body and all that hang on it in the tree."""
    carried = [number]
    for k in range(number + 1, len(system.bodies)):
        if system.bodies[k].parent in carried:
            carried.append(k)
    return carried


def _rotation(pose):
    return np.array([[pose.c, -pose.s], [pose.s, pose.c]])


def _normals(system, work):
    """d(residual)/d(point of the first body) of every row, (rows, 2)."""
    normals = np.empty((len(system.rows), 2))
    for r, row in enumerate(system.rows):
        first, second = work.poses[row.i], work.poses[row.j]
        apart = np.array([first.x, first.y]) + _rotation(first) @ (row.ax, row.ay)
        apart -= np.array([second.x, second.y]) + _rotation(second) @ (row.bx, row.by)
        normals[r] = plain(terms_of_row)(system, work, row, *apart)[1:3]
    return normals
