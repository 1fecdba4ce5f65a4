"""Link plates: a proposal for the manufacture of every body with two or more points.

A pin with a bearing has its radii: the bearing in the first body, the seat of the journal in the second.
"""

from typing import TYPE_CHECKING

from drivewright.errors import InputError
from drivewright.mechanisms.linkage.describe import marker
from drivewright.mechanisms.linkage.joints import Joint
from drivewright.mechanisms.linkage.scene import nodes
from drivewright.mechanisms.linkage.spec import LinkageSpec
from drivewright.mechanisms.linkage.tables import CENTROID, place, points_of
from drivewright.multibody.analyses.animation import COLOURS
from drivewright.multibody.analyses.cycle_poses import start_poses
from drivewright.multibody.link_plates import LinkPlate, PlatePin, link_plate, plate_drawing, stacked_parts, usual_pin_radius
from drivewright.scene import Drawing, Part

if TYPE_CHECKING:
    from drivewright.mechanisms.linkage.build import LinkageModel


def drawings(model: "LinkageModel") -> tuple[Drawing, ...]:
    """A drawing for each body with two or more points."""
    return tuple(plate_drawing(plate) for plate in plates(model.spec))


def parts(model: "LinkageModel") -> tuple[Part, ...]:
    """The plates one above the other at the start position, and their pins."""
    spec, poses = model.spec, {name: pose[0] for name, pose in start_poses(model).items()}
    pins = [
        PlatePin(joint.name, marker(spec, second), pin_radius(spec, joint), (place(first)[0], place(second)[0]))
        for joint in spec.joints
        if joint.kind == "revolute"
        for first, second in [joint.connects]
    ]
    return stacked_parts(plates(spec), pins, poses, default_radius(spec), COLOURS)


def plates(spec: LinkageSpec) -> list[LinkPlate]:
    """The bodies that can be plates; InputError where there are none, as holes overlap."""
    made, refused = _tried_plates(spec)
    if refused and not made:
        raise refused[0]
    return made


def plate_findings(spec: LinkageSpec) -> tuple[str, ...]:
    """Why bodies have no drawing of a link plate, an eccentric for instance, whose pins are larger than they are far apart."""
    return tuple(f"no drawing of a body: {reason}" for reason in _tried_plates(spec)[1])


def _tried_plates(spec):
    """(plates, refusals) of the bodies with two or more points."""
    made, refused = [], []
    for name in spec.bodies:
        points = nodes(spec, name)
        if len(points) > 1:
            try:
                made.append(link_plate(name, points, holes(spec, name), default_radius(spec), thickness(spec, name)))
            except InputError as reason:
                refused.append(reason)
    return made, refused


def default_radius(spec: LinkageSpec) -> float:
    """Radius of a pin without a bearing of its own [m]."""
    ends = [place(text) for joint in spec.joints if joint.kind == "revolute" for text in joint.connects]
    return usual_pin_radius([points_of(spec, name)[point] for body, point in ends if body == name and point] for name in spec.bodies)


def holes(spec: LinkageSpec, name: str) -> dict[tuple[float, float], float]:
    """Radius [m] of the hole at every pin's place (x, y) in a body."""
    radii: dict[tuple[float, float], float] = {}
    for joint in spec.joints:
        for end, text in enumerate(joint.connects if joint.kind == "revolute" else ()):
            body, point = place(text)
            if body == name:
                center = points_of(spec, body)[point or CENTROID]
                radii[center] = max(radii.get(center, 0.0), pin_radius(spec, joint, bearing=end == 0))
    return radii


def pin_radius(spec: LinkageSpec, joint: Joint, bearing: bool = False) -> float:
    """Radius of a pin, or of the bearing around it [m]."""
    if joint.has_contact or "bearing_radius" in joint.model_fields_set:
        return joint.bearing_radius - (0.0 if bearing else joint.clearance or 0.0)
    return default_radius(spec)


def thickness(spec: LinkageSpec, name: str) -> float:
    """Thickness of a plate [m]: the longest bearing in it, else a default pin's diameter."""
    lengths = [joint.length for joint in spec.joints if joint.has_contact and place(joint.connects[0])[0] == name]
    return max(lengths, default=2 * default_radius(spec))
