"""A mechanism as a moving picture: bars and plates through the bodies' points, pins, guides, springs, and play large enough to see."""

from collections.abc import Iterable, Iterator, Mapping

import numpy as np

from drivewright._typing import Floats
from drivewright.labels import in_words
from drivewright.multibody.analyses.cycle_poses import CyclePoses, cycle_poses
from drivewright.multibody.analyses.magnified_play import bearing_shapes, journal_body, magnify_play
from drivewright.multibody.analyses.simulation_model import SimulationModel
from drivewright.multibody.drawing import bar_half_width, coil_symbol, positions_of, rounded
from drivewright.multibody.forces.load import AppliedForce
from drivewright.multibody.joints.joint import JointDrawing
from drivewright.multibody.joints.revolute import Revolute
from drivewright.multibody.model import GROUND, PointSpring
from drivewright.scene import Body, Frame, Scene, Shape, Trace, polygon

COLOURS = ("blue", "orange", "green", "violet", "steel")
LEAST_FACTOR = 1e-3  # of its greatest over the cycle, below which a load counts as gone


def animate(model: SimulationModel, points: Mapping[str, Floats]) -> Scene:
    """One turn of the drive, or the run of a free mechanism; play is drawn larger by a round factor that its label tells.

    points {body: (n, 2)} [m]: places that the bar or plate of a body spans, in its frame; the ground may be among the bodies.
    """
    cycle, half_width = cycle_poses(model), bar_half_width(points)
    names = (GROUND, *model.bodies)
    drawing = JointDrawing(cycle.poses, half_width, names, model.assembly.model.joints)
    springs = [force for force in model.assembly.model.forces if isinstance(force, PointSpring)]
    plays = [magnify_play(joint, cycle, half_width) for joint in drawing.joints if isinstance(joint, Revolute) and joint.play]
    shapes = {
        name: [
            *_body_shapes(points.get(name, np.zeros((0, 2))), drawing, springs, name),
            *bearing_shapes(plays, name),
            *(shape for joint in drawing.joints for shape in joint.pin_shapes(name, drawing)),
        ]
        for name in names
    }
    colours = ["ground", *(COLOURS[n % len(COLOURS)] for n in range(len(model.bodies)))]
    bodies = [
        Body(name, in_words(name), tuple(shapes[name]), cycle.frames(name), colour) for name, colour in zip(names, colours, strict=True)
    ]
    loads = [force for force in model.assembly.model.forces if isinstance(force, AppliedForce)]
    bodies += [
        *_spring_bodies(springs, cycle, half_width),
        *_force_bodies(loads, cycle, half_width),
        *(journal_body(play) for play in plays),
    ]
    traces = tuple(Trace(o.name, f"path of {in_words(o.name)}", o.body, o.marker[1:]) for o in model.outputs if o.point)
    still = np.zeros((len(cycle.cycle), 3))
    table = "motion" if model.outputs else "drive" if model.assembly.model.drives else ""
    return Scene(
        cycle.cycle,
        cycle.label,
        cycle.unit,
        cycle.period,
        tuple(body for body in bodies if body.shapes),
        (Frame("machine", "machine frame", still),),
        traces,
        table if cycle.period else "",
    )


def _body_shapes(points: Floats, drawing: JointDrawing, springs: Iterable[PointSpring], name: str) -> Iterator[Shape]:
    """Plate, wheels, sliding blocks, guides and supports of a body, in its frame."""
    of_own = [shape for joint in drawing.joints for shape in joint.own_shapes(name, drawing)]
    if name == GROUND:
        yield from _supports(drawing, springs)
    elif len(points) > 1 or not of_own:
        yield Shape("body", rounded(points, drawing.half_width))
    yield from of_own
    for joint in drawing.joints:
        yield from joint.guide_shapes(name, drawing)


def _supports(drawing: JointDrawing, springs: Iterable[PointSpring]) -> Iterator[Shape]:
    """A triangle on hatched ground below every pin of the ground, a short line at a spring's end."""
    pins = {marker[1:] for joint in drawing.joints for marker in joint.support_markers if marker.body == GROUND}
    w = drawing.half_width
    for x, y in sorted(pins):
        yield Shape("ground", polygon([(x - 1.6 * w, y - 2.8 * w), (x, y), (x + 1.6 * w, y - 2.8 * w)]))
        yield Shape("ground", polygon([(x - 2.6 * w, y - 2.8 * w), (x + 2.6 * w, y - 2.8 * w)], closed=False))
    ends = {marker[1:] for spring in springs for marker in (spring.first, spring.second) if marker.body == GROUND}
    for x, y in sorted(ends - pins):
        yield Shape("ground", polygon([(x - w, y), (x + w, y)], closed=False))


def _spring_bodies(springs: Iterable[PointSpring], cycle: CyclePoses, half_width: float) -> Iterator[Body]:
    """Every spring as a coil on one end and a rod on the other that slide along each other."""
    for spring in springs:
        ends = [positions_of(marker[1:], cycle.poses[marker.body]) for marker in (spring.first, spring.second)]
        between = (ends[1] - ends[0])[:: cycle.fine]
        lengths = np.hypot(*between.T)
        if lengths.min() < 2 * half_width:
            continue  # no room for a coil
        angle, name = np.unwrap(np.arctan2(between[:, 1], between[:, 0])), spring.name
        coil = 0.7 * lengths.min()
        rod = min(lengths.max() - 0.6 * coil, lengths.min())
        label = name if name.startswith("spring ") else f"spring {in_words(name)}"
        shapes = coil_symbol(coil, 0.8 * half_width), polygon([(0, 0), (-rod, 0)], closed=False)
        for part, shape, end in zip(("coil", "rod"), shapes, ends, strict=True):
            yield Body(f"{part} {name}", label, (Shape("body", shape),), np.column_stack([end[:: cycle.fine], angle]), "steel")


def _force_bodies(forces: Iterable[AppliedForce], cycle: CyclePoses, half_width: float) -> Iterator[Body]:
    """Every applied force as an arrow whose tip is where it acts, drawn while it does; one with a negative factor points the other way."""
    w = half_width
    arrow = polygon(
        [
            (0, 0),
            (-2.4 * w, 0.9 * w),
            (-2.4 * w, 0.25 * w),
            (-9 * w, 0.25 * w),
            (-9 * w, -0.25 * w),
            (-2.4 * w, -0.25 * w),
            (-2.4 * w, -0.9 * w),
        ]
    )
    for force in forces:
        poses, name = cycle.frames(force.point.body), in_words(force.name)
        tip = positions_of(force.point[1:], poses)
        factor = _load_factor(force, cycle)
        angle = np.arctan2(force.direction[1], force.direction[0]) + (poses[:, 2] if force.follows else 0.0) + np.pi * (factor < 0)
        label = name if name.startswith("force") else f"force {name}"
        acts = np.abs(factor) > LEAST_FACTOR * np.abs(factor).max()
        yield Body(f"force {force.name}", label, (Shape("body", arrow),), np.column_stack([tip, angle]), "steel", shown=acts)


def _load_factor(force: AppliedForce, cycle: CyclePoses) -> Floats:
    """The load factor of a force in every frame (frames,)."""
    turned = cycle.frames(force.point.body)[:, 2] - cycle.frames(GROUND)[:, 2]
    speeds = np.gradient(turned, cycle.times) if cycle.period else np.zeros(len(turned))
    return force.load.values(cycle.times, turned, speeds)
