"""A linkage as a moving picture: which points the bar or plate of a body spans."""

from drivewright._typing import Floats
from drivewright.mechanisms.linkage.build import LinkageModel
from drivewright.mechanisms.linkage.spec import LinkageSpec
from drivewright.mechanisms.linkage.tables import CENTROID, GROUND, place, points_of
from drivewright.multibody.analyses.animation import animate
from drivewright.multibody.drawing import distinct_points
from drivewright.scene import Scene


def scene(model: LinkageModel) -> Scene:
    """One turn of the drive, or the run of a free mechanism."""
    return animate(model, {name: nodes(model.spec, name) for name in (GROUND, *model.spec.bodies)})


def nodes(spec: LinkageSpec, name: str) -> Floats:
    """Points (n, 2) of a body, each once; the centroid counts where something holds on to it or a single point would be all."""
    named = points_of(spec, name)
    points = distinct_points(point for key, point in named.items() if key != CENTROID or _holds_centroid(spec, name))
    return points if len(points) > 1 or name == GROUND else distinct_points([*points, named[CENTROID]])


def _holds_centroid(spec: LinkageSpec, name: str) -> bool:
    """Whether a joint or spring holds on to a body's centroid."""
    return any(place(text) == (name, CENTROID) for item in (*spec.joints, *spec.springs) for text in item.connects)
