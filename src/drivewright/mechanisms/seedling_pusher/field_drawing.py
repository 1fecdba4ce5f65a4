"""What the keys of the field, the events and the push measure: places over the field, and angles of the carrier's turn."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from drivewright.dimensions import Angle, Dimension, Length, body_of, corners_of, cut_prism, origin_of, still_body, still_scene, turn
from drivewright.mechanisms.seedling_pusher.build import PusherModel
from drivewright.mechanisms.seedling_pusher.scene import parts, scene
from drivewright.scene import Body, Prism, Scene, Shape, place, polygon

GATE = 60e-3  # half the length of a gate line as drawn [m]
PLANTS = 3  # that are drawn, the last one where the arm is
NO_TRAVEL = 1e-9  # of the rod, over its stroke


def _at(body: Body, frame: int, name: str, colour: str) -> Body:
    """A body as it stands in one frame, under another name."""
    return replace(body, name=name, label=name, poses=np.repeat(body.poses[frame : frame + 1], len(body.poses), axis=0), colour=colour)


def over_field(model: PusherModel) -> Scene:
    """Arm at the start, path of its tip, soil and plants, gate line."""
    whole = scene(model)
    still = whole.frames[0].poses
    stems = [shape for shape in whole.frames[1].shapes if shape.layer == "axis"][-PLANTS:]
    ground = next(shape.outline.pieces[0].points(1.0)[0, 1] for shape in whole.frames[1].shapes if shape.layer == "ground")
    places = [stem.outline.points()[0, 0] for stem in stems]
    reach = 0.6 * model.spec.field.spacing
    line = polygon([(min(places) - reach, ground), (max(places) + reach, ground)], closed=False)
    soil, plants = Body("soil", "soil", (Shape("ground", line),), still, "ground"), Body("plants", "plants", tuple(stems), still, "ground")
    arm, (trace, *_) = body_of(whole, "arm"), whole.traces
    path = np.array([place([trace.point], pose)[0] for pose in arm.poses])
    track = Body("track", "path of the tip", (Shape("edge", polygon(path, closed=False)),), still, "green")
    return replace(whole, bodies=(*whole.bodies, soil, plants, track, _gate(model, whole)))


def _gate(model: PusherModel, whole: Scene) -> Body:
    """The line at which the needle takes seedlings, through its point."""
    events = model.spec.events
    assert events.gate_point is not None
    middle, way = complex(*events.gate_point), GATE * np.exp(1j * events.gate_direction)
    ends = [(z.real, z.imag) for z in (middle - way, middle + way)]
    return Body("gate", "gate", (Shape("edge", polygon(ends, closed=False)),), whole.frames[0].poses, "orange")


def field_dimensions(model: PusherModel, scene: Scene) -> Iterator[Dimension]:
    """Plants over the soil, and the gate."""
    plants, track = np.array(corners_of(scene, "plants", "axis")).reshape(-1, 2, 2), np.array(corners_of(scene, "track", "edge"))
    soil = corners_of(scene, "soil", "ground")[0][1]
    first, second = sorted(plants, key=lambda plant: plant[0][0])[:2]
    low = track[np.argmin(track[:, 1])]
    yield Length("field.spacing", (float(first[1][0]), float(first[1][1])), (float(second[1][0]), float(second[1][1])), 0.06)
    yield Length("field.seedling_height", (float(first[1][0]), soil), (float(first[1][0]), float(first[1][1])), 0.1)
    yield Length("field.mouth_height", (float(low[0]), float(model.arm.point(model.arm.lowest).d0.imag)), (float(low[0]), soil), -0.24)
    (x0, y0), (x1, y1) = corners_of(scene, "gate", "edge")
    x, y = 0.5 * (x0 + x1), 0.5 * (y0 + y1)
    sun = origin_of(scene, "sun")
    yield Length("events.gate_point.0", sun, (x, sun[1]), 0.26, times=float(np.sign(x)))
    yield Length("events.gate_point.1", (x, sun[1]), (x, y), -0.1, times=float(np.sign(y)))
    yield Angle("events.gate_direction", (x, y), 0.0, float(np.arctan2(y1 - y0, x1 - x0)), 0.08)


# -- angles of the carrier -------------------------------------------------------------------------------------------------------


def carrier_turns(model: PusherModel) -> Scene:
    """The carrier at the start, where it takes a seedling, and where the push begins and ends and the rod is back."""
    whole = scene(model)
    carrier = body_of(whole, "carrier")
    frames = _frames(whole)
    taken = int(round(np.interp(float(model.spec.events.take_angle or 0.0), whole.cycle, np.arange(len(whole.cycle)))))
    places = {"start": (0, "blue"), "take": (taken, "green")}
    places |= {name: (frame, "orange") for name, frame in frames.items()}
    return replace(whole, bodies=tuple(_at(carrier, frame, name, colour) for name, (frame, colour) in places.items()))


def _frames(whole: Scene) -> dict[str, int]:
    """Frames in which the rod leaves its rest, is out, begins to return, and is back, by how far it has moved along the arm."""
    arm, rod = (body_of(whole, name).poses for name in ("arm", "rod"))
    out = np.hypot(*(rod - arm)[:, :2].T)
    moving, full = out > NO_TRAVEL * out.max(), out > (1 - NO_TRAVEL) * out.max()
    inside = np.flatnonzero(moving)
    return {
        "push": int(inside[0]) - 1,
        "out": int(np.flatnonzero(full)[0]),
        "return": int(np.flatnonzero(full)[-1]),
        "back": int(inside[-1]) + 1,
    }


def turn_dimensions(model: PusherModel, scene: Scene) -> Iterator[Dimension]:
    """Clockwise angles of the first arm of the carrier."""
    arm = {body.name: body.poses[0, 2] + model.spec.train.carrier_angle for body in scene.bodies}
    sun = (0.0, 0.0)
    yield Angle("push.end", sun, arm["start"], arm["out"] - arm["start"], 0.16, times=-1)
    yield Angle("push.rise", sun, arm["push"], turn(arm["push"], arm["out"]), 0.24, times=-1)
    yield Angle("push.hold", sun, arm["out"], turn(arm["out"], arm["return"]), 0.32, times=-1)
    yield Angle("push.retraction", sun, arm["return"], turn(arm["return"], arm["back"]), 0.24, times=-1)
    yield Angle("events.take_angle", sun, arm["start"], arm["take"] - arm["start"], 0.1, times=-1)


# -- cams ------------------------------------------------------------------------------------------------------------------------


def cams_cut(model: PusherModel) -> Scene:
    """Both cams with hub and collar, cut along their axis."""
    shown = [part for part in parts(model) if part.name.startswith("cam_") or part.name in ("hub", "collar")]
    return still_scene(
        *(
            still_body(p.name, [shape for prism in p.solids if isinstance(prism, Prism) for shape in cut_prism(prism)], p.colour)
            for p in shown
        )
    )


def cams_dimensions(model: PusherModel, scene: Scene) -> Iterator[Dimension]:
    """Widths and diameters of the cams."""
    main, hub, collar = (corners_of(scene, name, "profile") for name in ("cam_main", "hub", "collar"))
    left, right = min(x for x, _ in main), max(x for x, _ in main)
    top, outer = max(y for _, y in main), max(y for _, y in hub)
    end, inner = max(x for x, _ in collar), min(abs(y) for _, y in hub)
    yield Length("cams.face_width", (left, top), (right, top), 0.08)
    yield Length("cams.hub_diameter", (end, -outer), (end, outer), -0.3)
    yield Length("cams.bore", (end, -inner), (end, inner), -0.12)


GATE_LINE = ('events={take="gate",gate_point=["140 mm","20 mm"],gate_direction="70 deg"}',)
TURNS = ("push.hold=12 deg", "push.rise=22 deg", "push.retraction=36 deg", "push.end=86 deg", 'events={take="angle",take_angle="300 deg"}')
