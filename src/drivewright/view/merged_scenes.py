"""Several scenes as one: the bodies of each design in its own colour, all at the same value of the driving quantity."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from drivewright._typing import Floats
from drivewright.scene import Body, Frame, Scene, Shape, Trace
from drivewright.view.motion import fractions
from drivewright.view.palette import SERIES

FILLED = ("profile", "body", "roller")  # layers that viewers fill
CLOSE = 1e-9  # of the cycle, and m or rad: the same


def merged_scene(scenes: Sequence[Scene], labels: Sequence[str]) -> tuple[Scene | None, tuple[str, ...]]:
    """(one scene of all, remarks), None where their driving quantities have not the same unit.

    The cycle is the longest one; a shorter one is repeated.  A body is called "label: name", and labelled with its design.  Observers that
    are not the same for all designs are left out.
    """
    units = {scene.cycle_unit for scene in scenes}
    if len(units) > 1:
        return None, (f"the motions run over quantities of different units ({', '.join(sorted(units))}) and cannot be shown together",)
    longest = max(scenes, key=lambda scene: abs(float(scene.cycle[-1] - scene.cycle[0])))
    parts = [_carried(scene, longest.cycle) for scene in scenes]
    frames, left = _common_frames(parts)
    named = list(enumerate(zip(parts, labels, strict=True)))
    return replace(
        longest,
        bodies=tuple(_body(body, label, n) for n, (scene, label) in named for body in scene.bodies),
        traces=tuple(_trace(trace, label, n) for n, (scene, label) in named for trace in scene.traces),
        frames=frames,
        table="",
        marks=longest.marks if len({scene.marks for scene in scenes}) == 1 else (),
    ), (*_repeated(scenes, labels, longest), *left)


def phases_of(scene: Scene, cycle: Floats) -> Floats:
    """Where in a scene's own cycle, 0 ... 1, the values of another cycle lie; beyond its ends the cycle is repeated."""
    u = (np.asarray(cycle, float) - scene.cycle[0]) / (scene.cycle[-1] - scene.cycle[0])
    part = np.where(np.abs(u - np.round(u)) < CLOSE, 0.0, u % 1.0)
    return np.where((part == 0.0) & (np.round(u) > 0), 1.0, part)


def _carried(scene: Scene, cycle: Floats) -> Scene:
    """The scene over another cycle."""
    if np.shape(scene.cycle) == np.shape(cycle) and np.allclose(scene.cycle, cycle, rtol=0, atol=CLOSE):
        return scene
    own, u = fractions(scene.cycle), phases_of(scene, cycle)

    def at(poses):
        poses = np.asarray(poses, float)
        continuous = np.column_stack([poses[:, :2], np.unwrap(poses[:, 2])])
        return np.stack([np.interp(u, own, column) for column in continuous.T], axis=1)

    bodies = tuple(replace(body, poses=at(body.poses), rest=None if body.rest is None else at(body.rest)) for body in scene.bodies)
    return replace(scene, cycle=cycle, bodies=bodies, frames=tuple(replace(frame, poses=at(frame.poses)) for frame in scene.frames))


def _body(body: Body, label: str, number: int) -> Body:
    """A body of one design: the first design is filled, the others are outlines, and holes let through what lies below."""
    bare = ("hole",) if number == 0 else ("hole", *FILLED)
    shapes = tuple(Shape("edge", shape.outline) if shape.layer in bare else shape for shape in body.shapes)
    return replace(body, name=f"{label}: {body.name}", label=label, shapes=shapes, colour=SERIES[number % len(SERIES)])


def _trace(trace: Trace, label: str, number: int) -> Trace:
    name, body = f"{label}: {trace.name}", f"{label}: {trace.body}"
    return replace(trace, name=name, label=label, body=body, colour=SERIES[number % len(SERIES)])


def _common_frames(scenes: Sequence[Scene]) -> tuple[tuple[Frame, ...], tuple[str, ...]]:
    """(observers that all scenes have in common, remarks about the others); where there is none, one that stands still."""
    found, left = [], []
    for frame in scenes[0].frames:
        others = [other for scene in scenes[1:] for other in scene.frames if other.name == frame.name]
        if len(others) == len(scenes) - 1 and all(_is_same(frame, other) for other in others):
            shapes = dict.fromkeys(map(_key, (frame, *others)))
            found.append(frame if len(shapes) == 1 else replace(frame, shapes=tuple(s for f in (frame, *others) for s in f.shapes)))
        else:
            left.append(frame.label)
    remarks = (f"the designs do not share these observers: {', '.join(left)}",) if left else ()
    return tuple(found) or (Frame("fixed", "fixed frame", np.zeros((len(scenes[0].cycle), 3))),), remarks


def _is_same(frame: Frame, other: Frame) -> bool:
    turned = np.abs(np.exp(1j * frame.poses[:, 2]) - np.exp(1j * other.poses[:, 2]))
    return (
        np.allclose(frame.poses[:, :2], other.poses[:, :2], rtol=0, atol=CLOSE)
        and bool(np.all(turned < CLOSE))
        and np.allclose(frame.advance, other.advance, rtol=0, atol=CLOSE)
    )


def _key(frame: Frame) -> str:
    return repr(frame.shapes)


def _repeated(scenes, labels, longest):
    """A remark where a shorter cycle is repeated."""
    span = abs(float(longest.cycle[-1] - longest.cycle[0]))
    short = [
        label for scene, label in zip(scenes, labels, strict=True) if abs(float(scene.cycle[-1] - scene.cycle[0])) < span * (1 - CLOSE)
    ]
    return (f"the cycle of {', '.join(short)} is shorter than the longest one, and is repeated",) if short else ()
