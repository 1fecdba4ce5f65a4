"""A linkage that is not finished: where its bodies stand without being assembled, how that looks, and what is missing."""

import math
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace

import numpy as np

from drivewright._typing import Floats
from drivewright.errors import DrivewrightError
from drivewright.labels import in_words
from drivewright.mechanisms.linkage.build import build
from drivewright.mechanisms.linkage.scene import handles, nodes, scene
from drivewright.mechanisms.linkage.spec import LinkageSpec
from drivewright.mechanisms.linkage.tables import GROUND, place, points_of
from drivewright.multibody.analyses.animation import COLOURS
from drivewright.multibody.analyses.cycle_poses import start_poses
from drivewright.multibody.drawing import bar_half_width, rounded
from drivewright.scene import Body, Frame, Pose, Scene, Shape, circle, polygon

TURN = np.linspace(-0.25 * np.pi, 1.1 * np.pi, 41)
ARROW = (np.column_stack([np.cos(TURN), np.sin(TURN)]), np.array([(-1.22, -0.02), (-0.951, -0.309), (-0.72, 0.02)]))  # around a driven pin


def loose_poses(spec: LinkageSpec) -> dict[str, Pose]:
    """Poses of the ground and of all bodies at the start: those of the assembly, else those that the spec puts them in."""
    try:
        found = start_poses(build(spec))
    except DrivewrightError:
        return stated_poses(spec)
    held = {name: _pose(found[name][0]) for name in (GROUND, *held_by_frame(spec))}
    return stated_poses(spec) | held


def _pose(row: Floats) -> Pose:
    x, y, angle = row.tolist()
    return x, y, angle


def stated_poses(spec: LinkageSpec) -> dict[str, Pose]:
    """Every body at its initial angle on the first joint that holds it, from the frame outwards; others have the frame of the machine."""
    poses: dict[str, Pose] = {GROUND: (0.0, 0.0, 0.0)}
    while body := _next(spec, poses):
        poses[body[0]] = body[1]
    return poses | {name: (0.0, 0.0, given.angle) for name, given in spec.bodies.items() if name not in poses}


def _next(spec, poses):
    """(body, pose) of a body that a joint connects with one that has its pose, or None."""
    for joint in spec.joints:
        for held, by in (joint.connects, joint.connects[::-1]):
            (body, point), (other, seat) = place(held), place(by)
            if body not in poses and other in poses and point and seat:
                angle = spec.bodies[body].angle
                x, y = _carried(poses[other], points_of(spec, other)[seat])
                dx, dy = _carried((0.0, 0.0, angle), points_of(spec, body)[point])
                return body, (x - dx, y - dy, angle)
    return None


def _carried(pose, point):
    x, y, angle = pose
    c, s = math.cos(angle), math.sin(angle)
    return x + c * point[0] - s * point[1], y + s * point[0] + c * point[1]


def sketch(spec: LinkageSpec) -> Scene:
    """The mechanism at its start, without motion, with a mark at each driven pin; the bodies alone, as they are stated, where it is not
    assembled."""
    made = _still(spec)
    return replace(made, bodies=(*made.bodies, *_drive_marks(spec, len(made.cycle))))


def _drive_marks(spec: LinkageSpec, frames: int) -> Iterator[Body]:
    """An arrow around each pin that has a drive, as a body of the machine."""
    poses, driven = loose_poses(spec), {drive.joint for drive in spec.all_drives.values()}
    radius = 3.2 * bar_half_width({name: nodes(spec, name) for name in (GROUND, *spec.bodies)})
    for joint in (joint for joint in spec.joints if joint.name in driven):
        body, point = place(joint.connects[0])
        if not point:
            continue
        x, y = _carried(poses[body], points_of(spec, body)[point])
        shapes = tuple(Shape("edge", polygon([(x + radius * a, y + radius * b) for a, b in line], closed=False)) for line in ARROW)
        yield Body(f"drive {joint.name}", "drive", shapes, np.zeros((frames, 3)), "orange")


def _still(spec: LinkageSpec) -> Scene:
    if connected(spec):
        with suppress(DrivewrightError):
            return scene(replace(build(spec), duration=None))
    poses = loose_poses(spec)
    points = {name: nodes(spec, name) for name in (GROUND, *spec.bodies)}
    half_width = bar_half_width(points)
    joined = {text for joint in spec.joints for text in joint.connects}
    bodies = [Body(GROUND, in_words(GROUND), tuple(_supports(points[GROUND], half_width)), np.zeros((2, 3)), "ground")]
    for number, name in enumerate(spec.bodies):
        pins = [point for key, point in points_of(spec, name).items() if f"{name}.{key}" in joined]
        shapes = [Shape("body", rounded(points[name], half_width)), *(Shape("hole", circle(pin, 0.45 * half_width)) for pin in pins)]
        bodies.append(Body(name, in_words(name), tuple(shapes), np.tile(poses[name], (2, 1)), COLOURS[number % len(COLOURS)]))
    still = np.zeros((2, 3))
    return Scene(
        np.array([0.0, 1.0]),
        "time (not assembled: pose as stated)",
        "s",
        0.0,
        tuple(body for body in bodies if body.shapes),
        (Frame("machine", "machine frame", still),),
        handles=tuple(handles(spec)),
    )


def _supports(points, half_width):
    w = half_width
    for x, y in points.tolist():
        yield Shape("ground", polygon([(x - 1.6 * w, y - 2.8 * w), (x, y), (x + 1.6 * w, y - 2.8 * w)]))
        yield Shape("ground", polygon([(x - 2.6 * w, y - 2.8 * w), (x + 2.6 * w, y - 2.8 * w)], closed=False))


# -- what is missing -----------------------------------------------------------------------------------------------------------


def held_by_frame(spec: LinkageSpec) -> set[str]:
    """Bodies that joints connect with the frame, directly or through others."""
    held, before = {GROUND}, 0
    while len(held) > before:
        before = len(held)
        pairs = [{place(text)[0] for text in joint.connects} for joint in spec.joints]
        held |= {name for pair in pairs if pair & held for name in pair}
    return held - {GROUND}


def connected(spec: LinkageSpec) -> bool:
    """Whether every body is held by the frame."""
    return held_by_frame(spec) >= set(spec.bodies)


def unfinished(spec: LinkageSpec) -> tuple[str, ...]:
    """What is missing for a mechanism that moves as its drive says."""
    held, found = held_by_frame(spec), []
    for name in spec.bodies:
        joints = [joint for joint in spec.joints if name in {place(text)[0] for text in joint.connects}]
        if not joints:
            found.append(f"body {name} is held by no joint: add a pin or a slide")
        elif name not in held:
            found.append(f"body {name} is not connected to the frame")
    try:
        freedom = build(spec).assembly.freedom
    except DrivewrightError as error:
        return (*found, str(error))
    if not spec.all_drives and freedom:
        found.append(f"remaining degrees of freedom: {freedom}; add a drive on a pin")
    elif freedom:
        drives = "drive" if len(spec.all_drives) == 1 else "drives"
        found.append(f"remaining degrees of freedom beside the {drives}: {freedom}; {'add joints' if found else _free_end(spec)}")
    return tuple(found)


def _free_end(spec: LinkageSpec) -> str:
    """A body on one pin alone that no drive turns, where there is one: the end that is loose."""
    driven = {drive.joint for drive in spec.all_drives.values()}
    for name in spec.bodies:
        joints = [joint for joint in spec.joints if name in {place(text)[0] for text in joint.connects}]
        if len(joints) == 1 and joints[0].name not in driven:
            return f"body {name} is held by one joint only"
    return "add a drive on another pin, or joints"
