"""A linkage as a moving picture: bars and plates through the bodies' points, pins, guides, springs, and play large enough to see."""

from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.mechanisms.linkage.build import LinkageModel
from drivewright.mechanisms.linkage.describe import marker, output_marker
from drivewright.mechanisms.linkage.refusals import GROUND
from drivewright.mechanisms.linkage.sketch import half_width, nodes
from drivewright.multibody.analyses.cycle_poses import FINE, cycle_poses
from drivewright.multibody.drawing import positions_of, rotate, rounded
from drivewright.multibody.joints.joint import JointDrawing
from drivewright.multibody.model import Revolute
from drivewright.scene import Body, Frame, Scene, Shape, Trace, circle, polygon

COLOURS = ("blue", "orange", "green", "violet", "steel")
BEARING, RIM = 1.7, 1.35  # radius of a bearing over half a bar's width; of its rim over the bearing's
SHOWN = 0.6  # the drawn play over the drawn bearing's radius, at most


def scene(model: LinkageModel) -> Scene:
    """One turn of the drive, or the run of a free mechanism; play is drawn larger by a round factor that its label tells."""
    seen, slim = cycle_poses(model), half_width(model.spec)
    names = (GROUND, *model.spec.bodies)
    drawing = JointDrawing(seen.poses, slim, names, model.assembly.model.joints)
    plays = [_play(joint, seen, slim) for joint in drawing.joints if joint.play]
    shapes = {
        name: [
            *_body_shapes(model.spec, drawing, name),
            *_bearings(plays, name),
            *(shape for joint in drawing.joints for shape in joint.pin_shapes(name, drawing)),
        ]
        for name in names
    }
    colours = ["ground", *(COLOURS[n % len(COLOURS)] for n in range(len(model.spec.bodies)))]
    bodies = [
        Body(name, name.replace("_", " "), tuple(shapes[name]), seen.frames(name), colour)
        for name, colour in zip(names, colours, strict=True)
    ]
    bodies += [*_springs(model, seen, slim), *(_journal(play) for play in plays)]
    traces = tuple(
        Trace(o.name, f"path of {o.name.replace('_', ' ')}", o.body, output_marker(model.spec, o)[1:])
        for o in model.spec.outputs
        if o.point
    )
    still = np.zeros((len(seen.cycle), 3))
    table = "motion" if model.spec.outputs else "drive" if model.assembly.model.drives else ""
    return Scene(
        seen.cycle,
        seen.label,
        seen.unit,
        seen.period,
        tuple(body for body in bodies if body.shapes),
        (Frame("machine", "machine frame", still),),
        traces,
        table if seen.period else "",
    )


# -- bodies --------------------------------------------------------------------------------------------------------------------


def _body_shapes(spec, drawing, name):
    """Plate, wheels, sliding blocks, guides and supports of a body, in its frame."""
    of_own = [shape for joint in drawing.joints for shape in joint.own_shapes(name, drawing)]
    points = nodes(spec, name)
    if name == GROUND:
        yield from _supports(spec, drawing)
    elif len(points) > 1 or not of_own:
        yield Shape("body", rounded(points, drawing.half_width))
    yield from of_own
    for joint in drawing.joints:
        yield from joint.guide_shapes(name, drawing)


def _supports(spec, drawing):
    """A triangle on hatched ground below every pin of the ground, a short line at a spring's end."""
    slim, pins = drawing.half_width, {marker[1:] for joint in drawing.joints for marker in joint.support_markers if marker.body == GROUND}
    for x, y in sorted(pins):
        yield Shape("ground", polygon([(x - 1.6 * slim, y - 2.8 * slim), (x, y), (x + 1.6 * slim, y - 2.8 * slim)]))
        yield Shape("ground", polygon([(x - 2.6 * slim, y - 2.8 * slim), (x + 2.6 * slim, y - 2.8 * slim)], closed=False))
    ends = {marker(spec, text)[1:] for spring in spec.springs for text in spring.connects if text.startswith(GROUND + ".")}
    for x, y in sorted(ends - pins):
        yield Shape("ground", polygon([(x - slim, y), (x + slim, y)], closed=False))


# -- play ----------------------------------------------------------------------------------------------------------------------


class Play(NamedTuple):
    """A joint with play as drawn: radius of the bearing, the play in it, the factor on the real one;
    `orbit` (samples, 2) of the journal in the bearing's body, `poses` (frames, 3) of the journal and at `rest` in the bearing's middle."""

    joint: Revolute
    radius: float
    drawn: float
    factor: float
    orbit: Floats
    poses: Floats
    rest: Floats


def _play(joint, seen, slim):
    """The `Play` of a joint; a bushing has as much as it gives way."""
    bearing, journal = (positions_of(m[1:], seen.poses[m.body]) for m in (joint.first, joint.second))
    away = journal - bearing
    real = joint.play.clearance or float(np.hypot(*away.T).max())
    radius = max(BEARING * slim, real / SHOWN)
    factor = max(_round_down(SHOWN * radius / real), 1.0) if real > 0 else 1.0
    away = away * factor
    # Where steel gives way the journal is a little outside its play; magnified, it would lie in the wall.
    away *= np.minimum(1.0, factor * real / np.maximum(np.hypot(*away.T), 1e-300))[:, None]
    turn, own = (seen.poses[marker.body][:, 2] for marker in (joint.first, joint.second))
    poses, rest = (np.column_stack([place, own])[::FINE] for place in (bearing + away, bearing))
    return Play(joint, radius, factor * real, factor, rotate(away, -turn), poses, rest)


def _round_down(value):
    """The largest of 1, 2, 5 times a power of ten up to a value."""
    power = 10.0 ** np.floor(np.log10(value))
    return float(next(step * power for step in (5, 2, 1) if step * power <= value * (1 + 1e-12)))


def _bearings(plays, name):
    """Rim and hole of the bearings that a body carries, and the journal's path in them."""
    for play in plays:
        if play.joint.first.body == name:
            center = play.joint.first[1:]
            yield Shape("body", circle(center, RIM * play.radius))
            yield Shape("hole", circle(center, play.radius))
            yield Shape("pitch", polygon(np.asarray(center) + play.orbit, closed=False))


def _journal(play):
    """The journal as a body of its own: only its place in the bearing is magnified, not the mechanism around it.

    Further than drawn it would pass through the bearing's wall.
    """
    radius = play.radius - play.drawn
    shapes = (Shape("roller", circle((0, 0), radius)), Shape("axis", polygon([(0, 0), (radius, 0)], closed=False)))
    return Body(
        f"journal {play.joint.name}",
        f"{play.joint.play.noun} drawn ×{play.factor:g}",
        shapes,
        play.poses,
        "ground",
        rest=play.rest,
        most=1.0,
        magnified=play.factor,
    )


# -- springs -------------------------------------------------------------------------------------------------------------------


def _springs(model, seen, slim):
    """Every spring as a coil on one end and a rod on the other that slide along each other."""
    for number, spring in enumerate(model.spec.springs, 1):
        ends = [positions_of(m[1:], seen.poses[m.body]) for m in (marker(model.spec, text) for text in spring.connects)]
        between = (ends[1] - ends[0])[::FINE]
        lengths = np.hypot(*between.T)
        if lengths.min() < 2 * slim:
            continue  # no room for a coil
        angle, name = np.unwrap(np.arctan2(between[:, 1], between[:, 0])), spring.name or f"spring {number}"
        coil = 0.7 * lengths.min()
        rod = min(lengths.max() - 0.6 * coil, lengths.min())
        label = f"spring {spring.name.replace('_', ' ')}" if spring.name else name
        yield Body(f"coil {name}", label, (Shape("body", _zigzag(coil, 0.8 * slim)),), np.column_stack([ends[0][::FINE], angle]), "steel")
        yield Body(
            f"rod {name}",
            label,
            (Shape("body", polygon([(0, 0), (-rod, 0)], closed=False)),),
            np.column_stack([ends[1][::FINE], angle]),
            "steel",
        )


def _zigzag(length, height, turns=6):
    """A spring's symbol along +x."""
    x = np.linspace(0.12, 0.88, 2 * turns) * length
    y = height * np.where(np.arange(2 * turns) % 2, 1.0, -1.0)
    return polygon([(0, 0), (0.08 * length, 0), *zip(x, y, strict=True), (0.92 * length, 0), (length, 0)], closed=False)
