"""A linkage as a moving picture: bars and plates through the bodies' points, pins, guides, springs, and play large enough to see."""

from typing import NamedTuple

import numpy as np

from drivewright.mechanisms.linkage.describe import marker, output_marker
from drivewright.mechanisms.linkage.frames import FINE, film
from drivewright.mechanisms.linkage.refusals import GROUND
from drivewright.mechanisms.linkage.sketch import block, carried, half_width, nodes, rounded, turned
from drivewright.multibody.model import Bushing, Dry, Gear, Ideal, Lubricated, MasslessLink, PinSlot, Prismatic, Revolute, Rolling
from drivewright.scene import Body, Frame, Scene, Shape, Trace, circle, polygon

COLOURS = ("blue", "orange", "green", "violet", "steel")
PIN, BEARING, RIM = 0.5, 1.7, 1.35  # radius of a pin and of a bearing over half a bar's width; of its rim over the bearing's
BLOCK = 2.6  # half the height of a sliding block over half a bar's width
SHOWN = 0.6  # the drawn play over the drawn bearing's radius, at most


def scene(model):
    """One turn of the drive, or the run of a free mechanism; play is drawn larger by a round factor that its label tells."""
    seen, slim = film(model), half_width(model.spec)
    names = (GROUND, *model.spec.bodies)
    plays = [_play(joint, seen, slim) for joint in model.assembly.model.joints if isinstance(joint, Revolute) and joint.model != Ideal()]
    shapes = {name: [*_body_shapes(model, seen, name, slim), *_bearings(plays, name), *_pins(model, names, name, slim)] for name in names}
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


def _body_shapes(model, seen, name, slim):
    """Plate, wheels, sliding blocks, guides and supports of a body, in its frame."""
    spec, joints = model.spec, model.assembly.model.joints
    of_own = [
        shape
        for joint in joints
        if isinstance(joint, (Prismatic, PinSlot, Rolling)) and joint.first.body == name
        for shape in _slides(joint, seen, slim)
    ]
    points = nodes(spec, name)
    if name == GROUND:
        yield from _supports(spec, joints, slim)
    elif len(points) > 1 or not of_own:
        yield Shape("body", rounded(points, slim))
    yield from of_own
    for joint in joints:
        if isinstance(joint, (Prismatic, PinSlot, Rolling)) and joint.second.body == name:
            yield from _guide(joint, seen, slim)
        if isinstance(joint, Gear) and name in (joint.first, joint.second):
            yield from _gear(joints, joint, name)


def _slides(joint, seen, slim):
    """The block of a prismatic joint, the wheel of a rolling one; a pin in a slot is drawn with the slot."""
    center = joint.first[1:]
    if isinstance(joint, Rolling):
        yield Shape("body", circle(center, joint.radius))
        yield Shape("axis", polygon([center, (center[0] + joint.radius, center[1])], closed=False))
    if isinstance(joint, Prismatic):
        angle = seen.poses[joint.second.body][0, 2] + np.arctan2(*joint.axis[::-1]) - seen.poses[joint.first.body][0, 2]
        yield Shape("body", block(center, angle, 3.2 * slim, BLOCK * slim))


def _guide(joint, seen, slim):
    """What the first body of a joint runs along, as far as it does: two rails, a slot, a track."""
    along, across, (low, high) = np.array(joint.axis), np.array([-joint.axis[1], joint.axis[0]]), _travel(joint, seen)
    origin, ground = np.array(joint.second[1:]), joint.second.body == GROUND
    layer = "ground" if ground else "body"
    if isinstance(joint, PinSlot):
        slot = [origin + low * along, origin + high * along]
        if not ground:
            yield Shape("body", rounded([*slot, origin], slim))
        yield Shape("hole", rounded(slot, 1.3 * PIN * slim))
    elif isinstance(joint, Prismatic):
        ends = low - 4 * slim, high + 4 * slim
        for side, (a, b) in ((-1, ends), (1, ends[::-1])):  # ground is hatched on the right of a line
            yield Shape(layer, polygon([origin + s * along + side * BLOCK * slim * across for s in (a, b)], closed=False))
    elif joint.track_radius:
        yield Shape(layer, circle(origin, abs(joint.track_radius)))
    else:
        ends = low - joint.radius, high + joint.radius
        yield Shape(layer, polygon([origin + s * along for s in ends], closed=False))


def _travel(joint, seen):
    """(least, largest) place of the first body's point along the line of the second."""
    here, there = (carried(m[1:], seen.poses[m.body]) for m in (joint.first, joint.second))
    along = turned(np.broadcast_to(joint.axis, here.shape), seen.poses[joint.second.body][:, 2])
    travel = np.sum((here - there) * along, axis=1)
    return float(travel.min()), float(travel.max())


def _gear(joints, gear, name):
    """The pitch circle of a gear: centre distance a = |r1 - sign r2| with r1 / r2 = |ratio|; none without two pins on the carrier."""
    pins = [_pin_on(joints, body, gear.carrier) for body in (gear.first, gear.second)]
    if None in pins or gear.ratio == 1.0:
        return
    distance = np.hypot(*np.subtract(pins[0][1][1:], pins[1][1][1:]))
    second = distance / abs(1.0 - gear.ratio)
    which = 0 if name == gear.first else 1
    radius = second if which else second * abs(gear.ratio)
    if radius > 0:
        yield Shape("pitch", circle(pins[which][0][1:], radius))


def _pin_on(joints, body, carrier):
    """(marker on the body, marker on the carrier) of the pin between them; None without one."""
    for joint in joints:
        if isinstance(joint, Revolute) and {joint.first.body, joint.second.body} == {body, carrier}:
            return (joint.first, joint.second) if joint.first.body == body else (joint.second, joint.first)
    return None


# -- pins and ground -----------------------------------------------------------------------------------------------------------


def _pins(model, names, name, slim):
    """Pins without play, each on the body of the two that is drawn later; pins in slots on their own body."""
    for joint in model.assembly.model.joints:
        if isinstance(joint, Revolute) and joint.model == Ideal():
            upper = max((joint.first, joint.second), key=lambda m: names.index(m.body))
            if upper.body == name:
                yield Shape("hole", circle(upper[1:], PIN * slim))
        if isinstance(joint, PinSlot) and joint.first.body == name:
            yield Shape("hole", circle(joint.first[1:], PIN * slim))


def _supports(spec, joints, slim):
    """A triangle on hatched ground below every pin of the ground, a short line at a spring's end."""
    pins = {m[1:] for j in joints if isinstance(j, Revolute) for m in (j.first, j.second) if m.body == GROUND}
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
    orbit: np.ndarray
    poses: np.ndarray
    rest: np.ndarray


def _play(joint, seen, slim):
    """The `Play` of a joint; a bushing has as much as it gives way."""
    bearing, journal = (carried(m[1:], seen.poses[m.body]) for m in (joint.first, joint.second))
    away = journal - bearing
    real = clearance(joint.model) or float(np.hypot(*away.T).max())
    radius = max(BEARING * slim, real / SHOWN)
    factor = max(_round_down(SHOWN * radius / real), 1.0) if real > 0 else 1.0
    away = away * factor
    # Where steel gives way the journal is a little outside its play; magnified, it would lie in the wall.
    away *= np.minimum(1.0, factor * real / np.maximum(np.hypot(*away.T), 1e-300))[:, None]
    turn, own = (seen.poses[marker.body][:, 2] for marker in (joint.first, joint.second))
    poses, rest = (np.column_stack([place, own])[::FINE] for place in (bearing + away, bearing))
    return Play(joint, radius, factor * real, factor, turned(away, -turn), poses, rest)


def clearance(model):
    """Play of a pin [m]; 0 of a bushing."""
    if isinstance(model, Lubricated):
        return model.contact.clearance
    return model.clearance if isinstance(model, (Dry, MasslessLink)) else 0.0


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
    what = "bushing" if isinstance(play.joint.model, Bushing) else "play"
    return Body(
        f"journal {play.joint.name}",
        f"{what} drawn ×{play.factor:g}",
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
        ends = [carried(m[1:], seen.poses[m.body]) for m in (marker(model.spec, text) for text in spring.connects)]
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
