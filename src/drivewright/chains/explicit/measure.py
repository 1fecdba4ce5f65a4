"""The record of a run from its snapshots: energies, works, momenta, and the forces on plates, joints and sprockets."""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats, Records
from drivewright.chains.explicit.snapshots import BODIES, PLATES, SCALARS, Snapshots
from drivewright.chains.explicit.state import SUMS, ChainConstants, DriveArrays

ROW = (
    "t",
    "kinetic",
    "potential",
    "elastic",
    "momentum x",
    "momentum y",
    "angular momentum",
    "contacts",
    "open joints",
    "utilisation",
    "joint damping",
    "contact damping",
    *SUMS,
)
BODY = BODIES[:7]
PLATE = ("x", "y", "angle", "left x", "left y", "right x", "right y", "left flank", "right flank")
PRESSED = 0.05  # part of the largest joint force below which friction utilisation is not asked for


class Log(NamedTuple):
    """Rows (samples, ROW), bodies (samples, bodies, BODY), tension (samples, joints), plate (samples, PLATE)."""

    rows: Floats
    bodies: Floats
    tension: Floats
    plate: Floats


def empty_log(samples: int, bodies: int, joints: int) -> Log:
    """Room for so many."""
    return Log(
        np.zeros((samples, len(ROW))), np.zeros((samples, bodies, len(BODY))), np.zeros((samples, joints)), np.zeros((samples, len(PLATE)))
    )


def measured(drive: DriveArrays, snapshots: Snapshots, joints: tuple[int, ...], plate: int) -> Log:
    """The `Log` of snapshots; `joints` whose tension, `plate` whose forces are asked for."""
    p = {name: snapshots.plates[:, k] for k, name in enumerate(PLATES)}
    b = {name: snapshots.bodies[:, k] for k, name in enumerate(BODIES)}
    tension, across, stretched = joint_forces(drive.chain, p)
    columns = {name: snapshots.scalars[:, k] for k, name in enumerate(SCALARS)} | momenta(drive.chain, p)
    columns["kinetic"] = plates_kinetic(drive.chain, p) + bodies_kinetic(drive.bodies, b)
    columns["elastic"] = stretched + np.sum(p["stored"], axis=1)
    columns["potential"] = columns["elastic"] + weight(drive, p) + bodies_potential(drive, b)
    columns["contacts"] = np.sum(p["left"] > 0, axis=1) + np.sum(p["right"] > 0, axis=1)
    columns["open joints"] = np.sum(tension <= 0, axis=1)
    columns["utilisation"] = utilisation(tension, across)
    bodies = np.moveaxis(snapshots.bodies[:, : len(BODY)], 1, 2)
    return Log(np.stack([columns[name] for name in ROW], axis=1), bodies, tension[:, list(joints)], watched(p, plate))


def twice(half: Floats, mean: Floats) -> Floats:
    """Product h (2 v - h) of the rates half a step after and before.

    With it the leapfrog's kinetic energy changes by exactly the mean force of two steps times the path between them, so that the energy of
    a linear system without damping does not change at all.
    """
    return half * (2 * mean - half)


def dot(a: Floats, b: Floats) -> Floats:
    """Sum over the last axis of the products."""
    return np.einsum("...i,...i->...", a, b)


def plates_kinetic(chain: ChainConstants, p: Mapping[str, Floats]) -> Floats:
    """Kinetic energy of all plates (S,)  [J]."""
    x, y, turning = (2 * dot(p[half], p[mean]) - dot(p[half], p[half]) for half, mean in (("hx", "vx"), ("hy", "vy"), ("hw", "w")))
    return 0.5 * (chain.mass * (x + y) + chain.inertia * turning)


def momenta(chain: ChainConstants, p: Mapping[str, Floats]) -> dict[str, Floats]:
    """Momentum and angular momentum about the origin of all plates, (S,) each."""
    turning = chain.mass * (dot(p["x"], p["vy"]) - dot(p["y"], p["vx"])) + chain.inertia * np.sum(p["w"], axis=1)
    return {
        "momentum x": chain.mass * np.sum(p["vx"], axis=1),
        "momentum y": chain.mass * np.sum(p["vy"], axis=1),
        "angular momentum": turning,
    }


def weight(drive: DriveArrays, p: Mapping[str, Floats]) -> Floats:
    """Energy of the plates' weight (S,)  [J]."""
    return -drive.chain.mass * (drive.gravity[0] * np.sum(p["x"], axis=1) + drive.gravity[1] * np.sum(p["y"], axis=1))


def bodies_kinetic(b: Records, seen: Mapping[str, Floats]) -> Floats:
    """Kinetic energy of sprockets and guides (S,)  [J]; what is driven counts as outside."""
    slid = np.where(b.slides, b.mass * twice(seen["hq"], seen["vq"]), 0.0)
    turned = np.where(b.driven, 0.0, b.inertia * twice(seen["hw"], seen["w"]))
    return 0.5 * np.sum(slid + turned, axis=1)


def bodies_potential(drive: DriveArrays, seen: Mapping[str, Floats]) -> Floats:
    """Energy of springs, steady forces and weights of what slides (S,)  [J]."""
    b, q = drive.bodies, seen["q"]
    force = b.force + b.weight * (drive.gravity[0] * b.ux + drive.gravity[1] * b.uy)
    return np.sum(np.where(b.slides, 0.5 * b.spring * q * q - force * q, 0.0), axis=1)


def joint_forces(chain: ChainConstants, p: Mapping[str, Floats]) -> tuple[Floats, Floats, Floats]:
    """Tension along the mean direction of the two plates and force across it (S, N); energy stored in all joints (S,)."""
    ux, uy = p["c"] + np.roll(p["c"], -1, axis=1), p["s"] + np.roll(p["s"], -1, axis=1)
    inverse, fx, fy, rx, ry, c = 1 / np.sqrt(ux * ux + uy * uy), p["fx"], p["fy"], p["rx"], p["ry"], chain.joint_damping
    stretched = dot(fx, fx) + dot(fy, fy) - 2 * c * (dot(fx, rx) + dot(fy, ry)) + c * c * (dot(rx, rx) + dot(ry, ry))
    return -(fx * ux + fy * uy) * inverse, (fy * ux - fx * uy) * inverse, 0.5 / chain.joint_stiffness * stretched


def utilisation(tension: Floats, across: Floats) -> Floats:
    """The most friction that pure rolling asks for in joints pressed together (S,), over the force that presses them."""
    least = PRESSED * np.max(tension, axis=1, keepdims=True).clip(1e-300)
    return np.max(np.where(tension > least, np.abs(across) / np.maximum(tension, least), 0.0), axis=1)


def watched(p: Mapping[str, Floats], i: int) -> Floats:
    """Pose of a plate and the forces on it (S, PLATE): pins in its own frame, flanks along their normals."""
    c, s = p["c"][:, i], p["s"][:, i]
    (lx, ly), (rx, ry) = (p["fx"][:, i - 1], p["fy"][:, i - 1]), (-p["fx"][:, i], -p["fy"][:, i])
    pins = (c * lx + s * ly, c * ly - s * lx, c * rx + s * ry, c * ry - s * rx)
    return np.stack([*(p[name][:, i] for name in ("x", "y", "angle")), *pins, p["left"][:, i], p["right"][:, i]], axis=1)
