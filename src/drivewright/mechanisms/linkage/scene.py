"""A linkage as a moving picture: which points the bar or plate of a body spans."""

from collections.abc import Iterator
from dataclasses import replace

from drivewright._typing import Floats
from drivewright.mechanisms.linkage.build import LinkageModel
from drivewright.mechanisms.linkage.spec import LinkageSpec
from drivewright.mechanisms.linkage.tables import CENTROID, GROUND, place, points_of
from drivewright.multibody.analyses.animation import animate
from drivewright.multibody.drawing import distinct_points
from drivewright.scene import Handle, Scene


def scene(model: LinkageModel) -> Scene:
    """One turn of the drive, or the run of a free mechanism."""
    drawn = animate(model, {name: nodes(model.spec, name) for name in (GROUND, *model.spec.bodies)})
    return replace(drawn, handles=tuple(handles(model.spec)))


def quick_scene(model: LinkageModel) -> Scene | None:
    """One turn with ideal joints, while a hand moves the mechanism; None without play, where the scene itself is as quick."""
    if not model.has_play:
        return None
    return scene(replace(model, assembly=model.ideal, duration=model.period or model.duration))


def handles(spec: LinkageSpec) -> Iterator[Handle]:
    """The points of the frame and of the bodies; a body's origin where a joint holds it is none: the other points say where it is."""
    joined = {text for joint in spec.joints for text in joint.connects}
    for name, x, y in ((name, *point) for name, point in spec.ground.points.items()):
        yield Handle(f"ground.points.{name}", (x, y))
    for body, given in spec.bodies.items():
        for name, point in given.points.items():
            if any(point) or f"{body}.{name}" not in joined:
                yield Handle(f"bodies.{body}.points.{name}", (point[0], point[1]), body=body)
        if _holds_centroid(spec, body):
            yield Handle(f"bodies.{body}.centroid", (given.centroid[0], given.centroid[1]), body=body)


def nodes(spec: LinkageSpec, name: str) -> Floats:
    """Points (n, 2) of a body, each once; the centroid counts where something holds on to it or a single point would be all."""
    named = points_of(spec, name)
    points = distinct_points(point for key, point in named.items() if key != CENTROID or _holds_centroid(spec, name))
    return points if len(points) > 1 or name == GROUND else distinct_points([*points, named[CENTROID]])


def _holds_centroid(spec: LinkageSpec, name: str) -> bool:
    """Whether a joint or spring holds on to a body's centroid."""
    return any(place(text) == (name, CENTROID) for item in (*spec.joints, *spec.springs) for text in item.connects)
