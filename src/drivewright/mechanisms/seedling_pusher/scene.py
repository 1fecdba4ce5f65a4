"""The seedling pusher as shapes, drawings and solids.

World: sun axis at the origin, carrier turning clockwise.  The rod runs along the needle's direction d, the lever pivot lies
beside the planet axis at right angles to it: on the needle's side where the pivot orbits the cams counter-clockwise, as the
train turns the arm; on the far side, everything mirrored, where the spec says clockwise.
"""

from collections.abc import Iterator, Mapping
from functools import partial

import numpy as np

from drivewright.cams import ConjugateCam
from drivewright.mechanisms.seedling_pusher.build import TURN, PusherModel
from drivewright.mechanisms.seedling_pusher.handles import NEEDLE, handles
from drivewright.scene import Bar, Body, Drawing, Frame, Line, Outline, Part, Prism, Scene, Shape, Trace, capsule, circle, polygon, xy

FRAMES = 361
GEAR_THICKNESS, LEVER_THICKNESS, PIN, GAP = 10e-3, 4e-3, 2.5e-3, 0.5e-3


def scene(model: PusherModel) -> Scene:
    """One carrier turn: train, arm with lever and rod, cams; machine, field, carrier and arm frames."""
    t = np.linspace(0, TURN, FRAMES)
    spec = model.spec
    axis, rotation, swing = model.arm.axis(t).d0, model.arm.rotation(t).d0, model.pair.swing(t).d0
    carrier = 2 * spec.train.semi_major * np.exp(1j * (spec.train.carrier_angle - t))
    wheel, (sun, intermediate, planet) = model.display_gear, _gear_directions(model, t)
    arm_pose, lever_pivot = _poses(axis, rotation), axis + np.exp(1j * rotation) * pivot(model)
    bodies = (
        _gear("sun", "sun gear (fixed)", wheel, _poses(0 * axis, sun), "ground"),
        _gear("intermediate", "intermediate gear", wheel, _poses(carrier, intermediate), "steel"),
        _gear("planet", "planet gear", wheel, _poses(axis, planet), "steel"),
        Body("carrier", "carrier", (Shape("body", _carrier_shape(model)),), _poses(0 * axis, -t), "blue"),
        *(
            Body(f"cam.{cam.name}", f"{cam.name} cam", tuple(cam_shapes(model, cam, model.display_profiles)), _poses(axis, -t), colour)
            for cam, colour in zip(model.pair.cams, ("orange", "violet"), strict=True)
        ),
        Body("arm", "planting arm with needle", tuple(_arm_shapes(model)), arm_pose, "green"),
        Body("lever", "lever with rollers", tuple(_lever_shapes(model)), _poses(lever_pivot, rotation - model.pair.orbit * swing), "blue"),
        Body(
            "rod",
            "pusher rod",
            (Shape("body", _rod_shape(model)),),
            _poses(axis + np.exp(1j * rotation) * model.pair.travel(t).d0 * model.needle, rotation),
            "orange",
        ),
    )
    tip_in_arm = spec.arm.tip_distance * np.exp(1j * model.arm.start)
    traces = (
        Trace("tip", "needle tip", "arm", xy(tip_in_arm)),
        Trace("axis", "planet axis", "arm", (0.0, 0.0)),
        Trace("rod_end", "rod end", "rod", xy(model.rod_ends[1])),
    )
    marks = ((model.arm.highest, "top"), (model.arm.lowest, "lowest"), (model.pair.start % TURN, "push"))
    period, held = TURN / spec.drive.speed, tuple(handles(model, rollers(model)))
    return Scene(t, "carrier angle", "rad", period, bodies, _frames(model, t, axis, rotation), traces, "cycle", marks, held)


def _poses(position, angle):
    position, angle = np.broadcast_arrays(position, angle)
    return np.stack([np.real(position), np.imag(position), angle.astype(float)], axis=1)


def _gear(name, label, outline, poses, colour):
    return Body(name, label, (Shape("body", outline), Shape("hole", circle((0, 0), 4e-3))), poses, colour)


def _frames(model, t, axis, rotation):
    """Observers: the machine, the field that it drives over, the carrier, the arm."""
    still = np.zeros((len(t), 3))
    field = np.stack([-model.advance * t / TURN, 0 * t, 0 * t], axis=1)
    return (
        Frame("machine", "machine", still),
        Frame("field", "field", field, (-model.advance, 0.0), tuple(_field_shapes(model))),
        Frame("cams", "cams (carrier)", _poses(axis, -t)),
        Frame("arm", "planting arm", _poses(axis, rotation)),
    )


def _field_shapes(model):
    """Soil line and the plants of neighbouring turns, where the tip was lowest."""
    field, lowest = model.spec.field, model.arm.point(model.arm.lowest).d0
    ground, step = float(lowest.imag) + field.mouth_height, model.advance
    foot = float(lowest.real) + step * model.arm.lowest / TURN
    yield Shape("ground", Outline((Line((foot - 4 * field.spacing, ground), (foot + 4 * field.spacing, ground)),), closed=False))
    for turn in range(-3, 1):
        x = foot + turn * step
        yield Shape("axis", Outline((Line((x, ground - field.mouth_height), (x, ground + field.seedling_height)),), closed=False))


# -- train -----------------------------------------------------------------------------------------------------------------------


def _gear_directions(model, t):
    """World directions of the short focal radii of sun, intermediate and planet gear; in a far start they point the other way."""
    train = model.spec.train
    return model.arm.train.directions(t, train.carrier_angle + (0.0 if train.start == "near" else np.pi))


def _carrier_shape(model):
    arm, start = 2 * model.spec.train.semi_major, model.spec.train.carrier_angle
    middle = arm * np.exp(1j * start)
    end = middle + arm * np.exp(1j * (start + model.arm.bend))
    return polygon([(0.0, 0.0), xy(middle), xy(end)], closed=False)


# -- arm, lever, rod: all in the frame of the arm at t = 0, origin on the planet axis ------------------------------------------------


def pivot(model: PusherModel) -> complex:
    """Lever pivot."""
    return model.spec.lever.pivot_distance * model.outwards


def rollers(model: PusherModel) -> dict[str, complex]:
    """Roller centres with the rod in, relative to the lever pivot, by cam name."""
    return {cam.name: -cam.arm * np.exp(-1j * model.pair.orbit * cam.side * cam.rest_angle) * model.outwards for cam in model.pair.cams}


def _arm_shapes(model):
    spec, tip = model.spec, model.spec.arm.tip_distance * np.exp(1j * model.arm.start)
    back = tip - NEEDLE * model.needle
    reach = max(cam.prime_radius for cam in model.pair.cams) + spec.cams.roller_radius + 4e-3
    yield Shape("body", circle((0, 0), reach))
    yield Shape("axis", polygon([(0.0, 0.0), xy(back), xy(tip)], closed=False))
    yield Shape("body", capsule(xy(back), xy(tip), 1.2e-3))


def _lever_shapes(model):
    radius = model.spec.cams.roller_radius
    for centre in rollers(model).values():
        yield Shape("body", capsule((0.0, 0.0), xy(centre), 3.5e-3))
        yield Shape("roller", circle(xy(centre), radius))
    yield Shape("body", capsule((0.0, 0.0), xy(model.spec.lever.output_arm * model.outwards), 3.5e-3))


def _rod_shape(model):
    back, front = model.rod_ends
    return capsule(xy(back), xy(front), 2e-3)


# -- cams ------------------------------------------------------------------------------------------------------------------------


def in_carrier(model: PusherModel) -> tuple[tuple[float, float, float], bool]:
    """(pose, mirror) that carry a cam from the frame of its formulas to the carrier's frame at t = 0, origin on the planet axis."""
    angle = float(np.angle(model.outwards))
    return (0.0, 0.0, angle + model.pair.orbit * np.pi / 2), model.pair.orbit < 0


def cam_shapes(model: PusherModel, cam: ConjugateCam, profiles: Mapping[str, Outline]) -> Iterator[Shape]:
    """Profile, pitch curve, circle of the pitch radius at rest, bore of a cam, in the carrier's frame."""
    pose, mirror = in_carrier(model)
    yield Shape("profile", profiles[cam.name].transformed(pose, mirror))
    yield Shape("pitch", model.pair.pitch_outline(cam).transformed(pose, mirror), "pitch curve (roller centre)")
    yield Shape("base", circle((0.0, 0.0), cam.prime_radius), "pitch radius at rest")
    yield Shape("hole", circle((0.0, 0.0), model.spec.cams.bore / 2))


def drawings(model: PusherModel) -> tuple[Drawing, ...]:
    """One drawing per cam, and one of the toothed gear."""
    width = model.spec.cams.face_width
    cams = tuple(
        Drawing(
            f"cam_{cam.name}",
            f"{cam.name} cam, roller radius {1e3 * cam.roller_radius:.3f} mm",
            tuple(cam_shapes(model, cam, model.profiles)),
            width,
        )
        for cam in model.pair.cams
    )
    gear = Drawing(
        "elliptic_gear",
        f"elliptic gear, {model.spec.train.teeth} teeth, bore on the focus",
        (Shape("profile", model.gear_outline), Shape("hole", circle((0, 0), 4e-3))),
        GEAR_THICKNESS,
        milled=False,  # an end mill does not fit into the tooth spaces
    )
    return (*cams, gear)


# -- solids at the start position ------------------------------------------------------------------------------------------------


def parts(model: PusherModel) -> tuple[Part, ...]:
    """Both cams on their hub, lever with rollers, rod, and the three gears, in their start position."""
    axis = complex(model.arm.axis(np.array(0.0)).d0)
    width = model.spec.cams.face_width
    level = {"main": 0.0, "return": width + 2 * GAP + LEVER_THICKNESS}
    here = (*xy(axis), 0.0)
    return (*_cam_parts(model, level, here), *_lever_parts(model, level, axis), _rod_part(model, level, here), *_gear_parts(model, level))


def _cam_parts(model, level, here):
    spec, (pose, mirror) = model.spec, in_carrier(model)
    bore = (circle((0, 0), spec.cams.bore / 2),)
    top = level["return"] + spec.cams.face_width
    for cam, colour in zip(model.pair.cams, ("orange", "violet"), strict=True):
        profile = model.profiles[cam.name].transformed(pose, mirror)
        yield Part(f"cam_{cam.name}", (Prism(profile, bore, level[cam.name], spec.cams.face_width),), here, colour, f"cam.{cam.name}")
    hub = Prism(circle((0, 0), spec.cams.hub_diameter / 2), bore, spec.cams.face_width, level["return"] - spec.cams.face_width)
    collar = Prism(circle((0, 0), spec.cams.hub_diameter / 2), bore, top, 4e-3)
    yield Part("hub", (hub,), here, "steel", "cam.main")
    yield Part("collar", (collar,), here, "steel", "cam.main")


def _lever_parts(model, level, axis):
    spec, here = model.spec, (*xy(axis + pivot(model)), 0.0)
    plate = spec.cams.face_width + GAP
    slot_end = spec.lever.output_arm * model.outwards
    boss = partial(capsule, (0.0, 0.0))
    along = slot_end / abs(slot_end)
    slot = capsule(xy(slot_end - 4e-3 * along), xy(slot_end + 4e-3 * along), 2.1e-3)
    solids = [Prism(boss(xy(slot_end + 4e-3 * along), 4.5e-3), (slot, circle((0, 0), 2.5e-3)), plate, LEVER_THICKNESS)]
    for name, centre in rollers(model).items():
        solids.append(Prism(boss(xy(centre), 4e-3), (circle((0, 0), 2.5e-3),), plate, LEVER_THICKNESS))
        low, high = sorted((level[name], plate)) if name == "main" else (plate + LEVER_THICKNESS, level[name] + spec.cams.face_width)
        solids.append(Prism(circle(xy(centre), PIN), (), low, high - low))
    yield Part("lever", tuple(solids), here, "blue")
    for name, centre in rollers(model).items():
        ring = Prism(circle(xy(centre), spec.cams.roller_radius), (circle(xy(centre), PIN),), level[name], spec.cams.face_width)
        yield Part(f"roller_{name}", (ring,), here, "steel", "lever")


def _rod_part(model, level, here):
    back, front = model.rod_ends
    return Part("rod", (Bar(xy(back), xy(front), model.spec.cams.face_width + GAP + LEVER_THICKNESS / 2, 4e-3),), here, "orange")


def _gear_parts(model, level):
    outline, bore = model.gear_outline, (circle((0, 0), 4e-3),)
    zero = np.array(0.0)
    carrier = 2 * model.spec.train.semi_major * np.exp(1j * model.spec.train.carrier_angle)
    centres = (0j, carrier, complex(model.arm.axis(zero).d0))
    for name, centre, direction in zip(("sun", "intermediate", "planet"), centres, _gear_directions(model, zero), strict=True):
        yield Part(
            f"gear_{name}", (Prism(outline, bore, -GEAR_THICKNESS - 3e-3, GEAR_THICKNESS),), (*xy(centre), float(direction)), "steel", name
        )
