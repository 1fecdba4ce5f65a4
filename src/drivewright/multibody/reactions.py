"""Forces in the joints, from Newton's and Euler's equations of every body in absolute coordinates.

The motion and the loads are known; what every joint can transmit is written down as unit wrenches from its mechanics, without the
constraint equations and the tree that found the motion:  M a - F - M g = W lambda.  What is left over of these equations is an
independent check of the motion.
"""

from typing import NamedTuple

import numpy as np
from scipy.linalg import null_space

from drivewright.multibody.model import GROUND, Bushing, CamPair, Dry, Gear, Lubricated, MasslessLink, PinSlot, Prismatic, Revolute, Rolling
from drivewright.multibody.tree import closes

CHUNK = 2000  # states at a time: bounds the memory
RANK = 1e-10  # singular values below this part of the largest are those of redundant constraints
FOLDED = 1e-6  # ... and in a singular position of those that fold
CARRIED = 1e-6  # part of the largest force that joints may leave over in a singular position


class Reaction(NamedTuple):
    """On the joint's first body: force (m, 2) [N] in the world's axes and moment (m,) [N m] about the joint's point of that body.

    The point of a rolling wheel is its centre.  Of a gear it is the torque on its `first`, of a cam pair force and torque on the follower.
    """

    force: np.ndarray
    moment: np.ndarray


class Reactions(NamedTuple):
    """By name of the joint: `joints` and, of massless links, `tensions` (m,) [N]: below 0 the contact is lost.

    drives (m, drives): torque or force of each drive.  residual (m,): what the equations leave over, as a part of the largest force.
    Where constraints are redundant, the smallest forces (in the root mean square) that do it.
    """

    joints: dict
    tensions: dict
    drives: np.ndarray
    residual: np.ndarray


class Places(NamedTuple):
    """Where the bodies are: number by name, centroid by name, and the observed arrays (m, bodies, fields)."""

    numbers: dict
    centroids: dict
    observed: object

    def field(self, body, name):
        return self.observed.body(self.numbers[body], name)

    def arm(self, marker):
        """(m, 2) from the centroid to the marker, in the world's axes."""
        cx, cy = self.centroids[marker.body]
        return self.turned(marker.body, (marker.x - cx, marker.y - cy))

    def turned(self, body, vector):
        angle = self.field(body, "angle")
        (x, y), c, s = vector, np.cos(angle), np.sin(angle)
        return np.stack([c * x - s * y, s * x + c * y], axis=-1)

    def centre(self, body):
        return np.stack([self.field(body, "x"), self.field(body, "y")], axis=-1)

    def point(self, marker):
        return self.centre(marker.body) + self.arm(marker)

    def velocity(self, marker):
        arm, w = self.arm(marker), self.field(marker.body, "w")
        return np.stack([self.field(marker.body, "vx") - w * arm[:, 1], self.field(marker.body, "vy") + w * arm[:, 0]], axis=-1)


class Wrench(NamedTuple):
    """One unknown: torques on bodies by name, and a force at a point on one body with its opposite on another."""

    torques: dict
    first: str = GROUND
    second: str = GROUND
    force: np.ndarray | None = None
    point: np.ndarray | None = None


def reactions(assembly, system, observed):
    """`Reactions` of the observed states of a system of the assembly."""
    parts = [
        observed._replace(**{name: getattr(observed, name)[k : k + CHUNK] for name in observed._fields})
        for k in range(0, len(observed.t), CHUNK)
    ]
    solved = [_solve(assembly, system, part) for part in parts]
    joints = {
        name: Reaction(*(np.concatenate(pieces) for pieces in zip(*(one.joints[name] for one in solved), strict=True)))
        for name in solved[0].joints
    }
    tensions = {name: np.concatenate([one.tensions[name] for one in solved]) for name in solved[0].tensions}
    return Reactions(joints, tensions, *(np.concatenate([getattr(one, name) for one in solved]) for name in ("drives", "residual")))


def unbounded_joints(assembly, system, observed):
    """Names of the ideal joints whose forces grow without bound towards one state in a singular position; none where they stay finite.

    There the joints cannot transmit every load.  What is left over of the equations of motion says whether they would have to; which joints
    it is, the forces say with which they could hold one another without any load.
    """
    equations = _equations(assembly, system, observed)
    _, residual = _balance(equations.columns, equations.wanted, FOLDED)
    if residual[0] < CARRIED:
        return ()
    idle = null_space(equations.columns[0], rcond=FOLDED)
    share = np.linalg.norm(idle, axis=1) if idle.shape[1] else np.zeros(equations.columns.shape[2])
    names = [joint.name for joint, group in zip(equations.ideal, equations.groups, strict=True) for _ in group]
    return tuple(dict.fromkeys(name for name, part in zip(names, share[: len(names)], strict=True) if part > 1e-3))


class _Equations(NamedTuple):
    """M a - F - M g = W lambda of observed states: `columns` W, `wanted` the left side; what the unknowns belong to; a length."""

    places: Places
    ideal: list
    groups: list
    unknowns: list
    length: float
    columns: np.ndarray
    wanted: tuple


def _equations(assembly, system, observed):
    wide = assembly.wide
    places = Places(
        {name: k for k, name in enumerate(assembly.names)}, {GROUND: (0.0, 0.0)} | {b.name: b.centroid for b in wide.bodies}, observed
    )
    ideal = [joint for joint in wide.joints if closes(joint)]
    groups = [wrenches(joint, places) for joint in ideal]
    driven = [_drive(next(j for j in wide.joints if j.name == drive.joint), places) for drive in wide.drives]
    unknowns = [wrench for group in groups for wrench in group] + driven
    length = _length(unknowns, places)
    return _Equations(places, ideal, groups, unknowns, length, _columns(unknowns, places, length), _wanted(system, observed, length))


def _solve(assembly, system, observed):
    wide, equations = assembly.wide, _equations(assembly, system, observed)
    places, length = equations.places, equations.length
    sizes, residual = _balance(equations.columns, equations.wanted)
    sizes *= [length if wrench.force is None else 1.0 for wrench in equations.unknowns]
    joints, start = {}, 0
    for joint, group in zip(equations.ideal, equations.groups, strict=True):
        joints[joint.name] = _reaction(joint, group, sizes[:, start : start + len(group)], places)
        start += len(group)
    joints |= {joint.name: _play(joint, k, places) for k, joint in enumerate(_pins(wide))}
    joints |= {j.name: _bushing(j, wide, places) for j in wide.joints if isinstance(j, Revolute) and isinstance(j.model, Bushing)}
    return Reactions(joints, _tensions(assembly.model, joints, places), sizes[:, start:], residual)


# ----------------------------------------------------------------------------------------------- what a joint can transmit


def wrenches(joint, places):
    """The unknowns of an ideal joint."""
    if isinstance(joint, Gear):
        return [Wrench(_sum((joint.first, -joint.ratio), (joint.second, 1.0), (joint.carrier, joint.ratio - 1.0)))]
    if isinstance(joint, CamPair):
        return [_cam(joint, places)]
    point = _contact_point(joint, places) if isinstance(joint, Rolling) else places.point(joint.first)
    bodies = (joint.first.body, joint.second.body)
    if isinstance(joint, (Revolute, Rolling)):
        return [Wrench({}, *bodies, np.broadcast_to(axis, point.shape), point) for axis in ((1.0, 0.0), (0.0, 1.0))]
    across = Wrench({}, *bodies, _along(joint, places) @ np.array([[0.0, 1.0], [-1.0, 0.0]]), point)
    return [across] if isinstance(joint, PinSlot) else [across, Wrench(_sum((bodies[0], 1.0), (bodies[1], -1.0)))]


def _drive(joint, places):
    """The unknown of a drive: it moves the first body against the second, or, where the first is the ground, the second."""
    first, second = joint.first.body, joint.second.body
    if isinstance(joint, Prismatic):
        mover, base = (second, first) if first == GROUND else (first, second)
        return Wrench({}, mover, base, _along(joint, places), places.point(joint.first))
    return Wrench(_sum((second, 1.0)) if first == GROUND else _sum((first, 1.0), (second, -1.0)))


def _cam(joint, places):
    """Virtual work: F ds = F s'(angle) d(angle) of the cam."""
    follower = joint.follower.body
    angle = places.field(joint.cam, "angle") - places.field(joint.carrier, "angle")
    slope = slope_of(joint.lift, angle)
    geared = ((joint.cam, -slope), (joint.carrier, slope))
    if joint.axis is None:
        return Wrench(_sum((follower, 1.0), (joint.carrier, -1.0), *geared))
    axis = places.turned(joint.carrier, np.array(joint.axis) / np.hypot(*joint.axis))
    return Wrench(_sum(*geared), follower, joint.carrier, axis, places.point(joint.follower))


def _contact_point(joint, places):
    """Where a rolling wheel touches its track."""
    centre = places.point(joint.first)
    if not joint.track_radius:
        return centre - joint.radius * _along(joint, places) @ np.array([[0.0, 1.0], [-1.0, 0.0]])
    hub = places.point(joint.second)
    apart = centre - hub
    return hub + abs(joint.track_radius) * apart / np.hypot(*apart.T)[:, None]


def _along(joint, places):
    return places.turned(joint.second.body, np.array(joint.axis) / np.hypot(*joint.axis))


def _sum(*torques):
    """Torques by body; a body that is named twice gets both."""
    total = {}
    for body, torque in torques:
        total[body] = total.get(body, 0.0) + torque
    return total


def slope_of(curve, x):
    """df/dx of a `Curve` at x, any shape."""
    breaks, coefficients = np.asarray(curve.breaks), np.asarray(curve.coefficients)
    x = breaks[0] + (x - breaks[0]) % curve.period if curve.period else np.asarray(x)
    piece = np.clip(np.searchsorted(breaks[: len(coefficients)], x, side="right") - 1, 0, None)
    powers = np.arange(1, coefficients.shape[1])
    return np.sum(powers * coefficients[piece, 1:] * (x - breaks[piece])[..., None] ** (powers - 1), axis=-1)


# -------------------------------------------------------------------------------------------------------------- equations


def _length(unknowns, places):
    """A length of the mechanism's size, so that moments and forces can be weighed against each other."""
    arms = [
        np.hypot(*(wrench.point - places.centre(body)).T).max()
        for wrench in unknowns
        if wrench.force is not None
        for body in (wrench.first, wrench.second)
        if body != GROUND
    ]
    return max(arms, default=0.0) or 1.0


def _columns(unknowns, places, length):
    """W (m, 3 bodies, unknowns): forces, and moments over the length, per unit of force, or of torque over the length."""
    columns = np.zeros((len(places.observed.t), len(places.numbers), 3, len(unknowns)))
    for u, wrench in enumerate(unknowns):
        for body, torque in wrench.torques.items():
            columns[:, places.numbers[body], 2, u] += torque if wrench.force is None else torque / length
        if wrench.force is None:
            continue
        for body, sign in ((wrench.first, 1.0), (wrench.second, -1.0)):
            arm = wrench.point - places.centre(body)
            columns[:, places.numbers[body], :2, u] += sign * wrench.force
            columns[:, places.numbers[body], 2, u] += sign * _cross(arm, wrench.force) / length
    return columns[:, 1:].reshape(len(columns), 3 * (len(places.numbers) - 1), len(unknowns))


def _cross(a, b):
    return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]


def _wanted(system, observed, length):
    """(M a - F - M g, size of its largest part) of all bodies but the ground."""

    def seen(*names):
        return np.stack([observed.body(slice(1, None), name) for name in names], axis=-1)

    mass, inertia = system.bodies.mass[1:], system.bodies.inertia[1:]
    weights = np.stack([mass, mass, inertia / length], axis=-1)
    inertial, loads = weights * seen("ax", "ay", "alpha"), seen("fx", "fy", "torque") / [1.0, 1.0, length]
    gravity = weights * [system.gravity_x, system.gravity_y, 0.0]
    largest = np.max(np.abs(inertial) + np.abs(loads) + np.abs(gravity), axis=(1, 2), initial=0.0)
    return (inertial - loads - gravity).reshape(len(observed.t), -1), largest


def _balance(columns, wanted, rank=RANK):
    """(sizes of the unknowns, residual): least squares, least norm, corrected once for rounding."""
    wanted, largest = wanted
    inverse = np.linalg.pinv(columns, rcond=rank)
    sizes = np.einsum("mub,mb->mu", inverse, wanted)
    left = wanted - np.einsum("mbu,mu->mb", columns, sizes)
    sizes += np.einsum("mub,mb->mu", inverse, left)
    left = wanted - np.einsum("mbu,mu->mb", columns, sizes)
    scale = np.maximum(largest, np.max(np.abs(sizes), axis=1, initial=0.0))
    return sizes, np.max(np.abs(left), axis=1, initial=0.0) / np.where(scale > 0, scale, 1.0)


# ---------------------------------------------------------------------------------------------------------------- results


def _reaction(joint, group, sizes, places):
    """`Reaction` of an ideal joint from the sizes of its wrenches."""
    body = joint.first if isinstance(joint, Gear) else (joint.follower if isinstance(joint, CamPair) else joint.first).body
    total = Reaction(np.zeros((len(sizes), 2)), np.zeros(len(sizes)))
    for wrench, size in zip(group, sizes.T, strict=True):
        moment = size * wrench.torques.get(body, 0.0)
        if wrench.force is not None:
            at = places.point(joint.follower if isinstance(joint, CamPair) else joint.first)
            moment = moment + size * _cross(wrench.point - at, wrench.force)
            total = total._replace(force=total.force + size[:, None] * wrench.force)
        total = total._replace(moment=total.moment + moment)
    return total


def _pins(wide):
    return [joint for joint in wide.joints if isinstance(joint, Revolute) and isinstance(joint.model, (Dry, Lubricated))]


def _play(joint, number, places):
    """A pin with play: the walls press at the bearing's radius, the oil at the journal's centre."""
    seen = {name: places.observed.pin(number, name) for name in ("depth", "normal", "friction", "nx", "ny", "fx", "fy")}
    contact = joint.model.contact if isinstance(joint.model, Lubricated) else joint.model
    n, force = np.stack([seen["nx"], seen["ny"]], axis=-1), np.stack([seen["fx"], seen["fy"]], axis=-1)
    rubbing = seen["friction"][:, None] * n @ np.array([[0.0, -1.0], [1.0, 0.0]])
    oil = force + seen["normal"][:, None] * n - rubbing
    moment = -contact.bearing_radius * _cross(n, rubbing) - (seen["depth"] + contact.clearance) * _cross(n, oil)
    return Reaction(force, moment)


def _bushing(joint, wide, places):
    model, one, two = joint.model, joint.first, joint.second
    angles = {GROUND: 0.0} | {body.name: body.angle for body in wide.bodies}
    rest = angles[one.body] - angles[two.body]
    apart, rate = places.point(one) - places.point(two), places.velocity(one) - places.velocity(two)
    force = -model.stiffness * apart - model.damping * rate
    turned, spin = (places.field(one.body, name) - places.field(two.body, name) for name in ("angle", "w"))
    twist = -model.rotational_stiffness * (turned - rest) - model.rotational_damping * spin
    return Reaction(force, twist - _cross(apart, force))


def _tensions(model, joints, places):
    """Pull of every massless link on the first body, along the link."""
    tensions = {}
    for joint in model.joints:
        if isinstance(getattr(joint, "model", None), MasslessLink):
            towards = places.turned(f"link:{joint.name}", (1.0, 0.0))
            tensions[joint.name] = np.sum(joints[joint.name].force * towards, axis=-1)
    return tensions
