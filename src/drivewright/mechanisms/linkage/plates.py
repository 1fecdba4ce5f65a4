"""Link plates: a proposal for the manufacture of every body with two or more points.

A plate reaches an edge around all points of its body.  A pin with a bearing has its radii: the bearing in the first body, the seat of
the journal in the second.  Any other pin gets a radius of a tenth of the shortest link, at most 5 mm.
"""

import itertools
import math

import numpy as np

from drivewright.errors import InputError
from drivewright.mechanisms.linkage.build import LinkageModel
from drivewright.mechanisms.linkage.joints import Joint
from drivewright.mechanisms.linkage.refusals import CENTROID, GROUND, place, points_of
from drivewright.mechanisms.linkage.scene import COLOURS
from drivewright.mechanisms.linkage.sketch import nodes
from drivewright.mechanisms.linkage.spec import LinkageSpec
from drivewright.multibody.analyses.cycle_poses import start_poses
from drivewright.multibody.drawing import positions_of, rounded
from drivewright.scene import Drawing, Part, Prism, Shape, circle, polygon

SHARE, LARGEST = 0.1, 5e-3  # default radius of a pin over the shortest link, and its limit [m]
EDGE = 2.0  # edge of a plate around its points over the radius of its largest hole
SAME = 1e-6  # pins closer than this at the start are one [m]


def drawings(model: LinkageModel) -> tuple[Drawing, ...]:
    """A drawing for each body with two or more points."""
    return tuple(_drawing(model.spec, name) for name in plates(model.spec))


def plates(spec: LinkageSpec) -> list[str]:
    """Names of the bodies that are plates."""
    return [name for name in spec.bodies if len(nodes(spec, name)) > 1]


def _drawing(spec, name):
    bores, edge = holes(spec, name), edge_of(spec, name)
    shapes = [Shape("profile", rounded(nodes(spec, name), edge)), *(Shape("hole", circle(center, r)) for center, r in bores.items())]
    for x, y in bores:
        shapes += [Shape("axis", polygon(ends, closed=False)) for ends in (((x - edge, y), (x + edge, y)), ((x, y - edge), (x, y + edge)))]
    return Drawing(name, f"Link plate, a proposal: {name.replace('_', ' ')}", tuple(shapes), thickness(spec, name))


def default_radius(spec: LinkageSpec) -> float:
    """Radius of a pin without a bearing of its own [m]."""
    pins = [[points_of(spec, name)[p] for p in _pin_points(spec, name)] for name in spec.bodies]
    gaps = [math.dist(a, b) for points in pins for a, b in itertools.combinations(points, 2) if math.dist(a, b) > SAME]
    return min([LARGEST, *(SHARE * gap for gap in gaps)])


def _pin_points(spec, name):
    ends = [place(text) for joint in spec.joints if joint.kind == "revolute" for text in joint.connects]
    return [point for body, point in ends if body == name and point]


def holes(spec: LinkageSpec, name: str) -> dict[tuple[float, float], float]:
    """Radius [m] of the hole at every pin's place (x, y) in a body; InputError where two meet."""
    found = {}
    for joint in spec.joints:
        for end, text in enumerate(joint.connects if joint.kind == "revolute" else ()):
            body, point = place(text)
            if body == name:
                center = points_of(spec, body)[point or CENTROID]
                found[center] = max(found.get(center, 0.0), pin_radius(spec, joint, bearing=end == 0))
    for (a, r), (b, s) in itertools.combinations(found.items(), 2):
        if math.dist(a, b) <= r + s:
            raise InputError(
                f"linkage: the holes of link {name!r} meet: radii of {1e3 * r:.4g} and {1e3 * s:.4g} mm at a distance of "
                f"{1e3 * math.dist(a, b):.4g} mm. Give its joints a smaller bearing_radius"
            )
    return found


def pin_radius(spec: LinkageSpec, joint: Joint, bearing: bool = False) -> float:
    """Radius of a pin, or of the bearing around it [m]."""
    if joint.pin in ("dry", "lubricated") or "bearing_radius" in joint.model_fields_set:
        return joint.bearing_radius - (0.0 if bearing else joint.clearance or 0.0)
    return default_radius(spec)


def edge_of(spec: LinkageSpec, name: str) -> float:
    """Radius of a plate around its points [m]."""
    return EDGE * max([*holes(spec, name).values(), default_radius(spec)])


def thickness(spec: LinkageSpec, name: str) -> float:
    """Thickness of a plate [m]: the longest bearing in it, else a default pin's diameter."""
    lengths = [joint.length for joint in spec.joints if joint.pin in ("dry", "lubricated") and place(joint.connects[0])[0] == name]
    return max(lengths, default=2 * default_radius(spec))


# -- solids --------------------------------------------------------------------------------------------------------------------


def parts(model: LinkageModel) -> tuple[Part, ...]:
    """The plates one above the other at the start position, and their pins."""
    spec, poses = model.spec, {name: pose[0] for name, pose in start_poses(model).items()}
    levels = _levels(spec)
    found = [
        Part(name, (_prism(spec, name, levels[name][0]),), tuple(poses[name]), COLOURS[n % len(COLOURS)]) for n, name in enumerate(levels)
    ]
    return (*found, *_pins(spec, poses, levels))


def _levels(spec):
    """{plate: (bottom, top)} [m], with a little air between them."""
    found, bottom = {}, 0.0
    for name in plates(spec):
        top = bottom + thickness(spec, name)
        found[name], bottom = (bottom, top), top + 0.1 * default_radius(spec)
    return found


def _prism(spec, name, bottom):
    bores = tuple(circle(center, radius) for center, radius in holes(spec, name).items())
    return Prism(rounded(nodes(spec, name), edge_of(spec, name)), bores, bottom, thickness(spec, name))


def _pins(spec, poses, levels):
    """A round pin through all plates that share it; one to the ground reaches a little below the lowest plate."""
    below, spots = (-2 * default_radius(spec),) * 2, {}
    for joint in spec.joints:
        if joint.kind == "revolute":
            body, point = place(joint.connects[1])
            spot = positions_of(points_of(spec, body)[point or CENTROID], np.array([poses[body]]))[0]
            near = next((key for key in spots if math.dist(key, spot) < SAME), tuple(spot))
            spots.setdefault(near, []).append(joint)
    for spot, joints in spots.items():
        bodies = [place(text)[0] for joint in joints for text in joint.connects]
        ends = [levels.get(body, below if body == GROUND else None) for body in bodies]
        ends = [end for pair in ends if pair for end in pair]
        if ends:
            pin = circle(spot, min(pin_radius(spec, joint) for joint in joints))
            yield Part(f"pin {joints[0].name}", (Prism(pin, (), min(ends), max(ends) - min(ends)),), (0.0, 0.0, 0.0), "ground")
