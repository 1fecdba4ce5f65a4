"""The plane kinds on screen and for manufacture: scene, drawings, parts."""

from collections.abc import Iterator

import numpy as np

from drivewright._typing import Floats
from drivewright.indexing.drawing import (
    PlacedCam,
    cam_poses,
    edge_radius,
    normal_bodies,
    outer_radius,
    pin_centre_curve,
    point_of,
    poses,
    profile_outline,
    screen_outline,
)
from drivewright.indexing.motion import TURN, IndexMotion
from drivewright.indexing.plane import PlaneDrive
from drivewright.mechanisms.indexer import roller_views
from drivewright.mechanisms.indexer.build import IndexerModel
from drivewright.scene import Body, Drawing, Frame, Outline, Part, Prism, Scene, Shape, circle, polygon

FRAMES = 361
COLOURS = ("blue", "green", "violet", "steel")


def scene(model: IndexerModel) -> Scene:
    """The drive over one turn of the input."""
    return (roller_views.scene if model.spec.kind in ("barrel", "globoidal") else _plane_scene)(model)


def cams(model: IndexerModel) -> tuple[PlacedCam, ...]:
    """All cams, the first one first: copies turned about the wheel's axis, or one of each shape."""
    if not model.translating:
        return tuple(PlacedCam(level, 0.0) for level in model.plane.levels)
    return tuple(PlacedCam(model.wheel, TURN * number / model.spec.cams) for number in range(model.spec.cams))


def _plane_scene(model: IndexerModel) -> Scene:
    """Wheel, cams and cranks, with the normals of the first cam through the pitch point."""
    angle = np.linspace(0, TURN, FRAMES)
    moving = model.drive.motion
    phi = np.append(moving(angle[:-1]).d0, moving.pitch)
    still = poses(0 * angle, 0.0)
    bodies = [Body("wheel", "wheel with pins", tuple(_wheel_shapes(model)), poses(0 * angle, phi), "orange")]
    for number, cam in reversed(list(enumerate(cams(model)))):
        colour = COLOURS[number % len(COLOURS)]
        bodies.append(Body(f"cam{number + 1}", f"cam {number + 1}", tuple(_shown_cam(model, cam)), cam_poses(cam, angle), colour))
    bodies += _cranks(model, angle)
    bodies += normal_bodies(cams(model)[0].drive, angle)
    frames = (
        Frame("machine", "machine frame", still),
        Frame("cam", "seen from cam 1", cam_poses(cams(model)[0], angle)),
        Frame("wheel", "seen from the wheel", poses(0 * angle, phi)),
    )
    return Scene(angle, "input angle", "rad", period(model), tuple(bodies), frames, (), "motion", marks(moving))


def marks(moving: IndexMotion) -> tuple[tuple[float, str], ...]:
    """Where step and dwell begin."""
    return ((0.0, "step"),) if moving.motion_angle >= TURN else ((0.0, "step"), (moving.motion_angle, "dwell"))


def period(model: IndexerModel) -> float:
    """Of a turn of the input [s]."""
    return TURN / model.spec.load.speed if model.spec.load.speed else 4.0


def _wheel_shapes(model: IndexerModel) -> Iterator[Shape]:
    inner, outer = rim(model)
    yield Shape("base", circle((0, 0), outer))
    yield Shape("base", circle((0, 0), inner))
    for level in model.plane.levels:
        for centre in level.pin_centres(0.0).d0:
            yield Shape("roller", circle(point_of(centre), level.pin_radius))


def rim(model: IndexerModel) -> tuple[float, float]:
    """Inner and outer radius of the wheel's disc [m]."""
    return model.spec.pin_circle_radius - 1.8 * model.spec.pin_radius, model.spec.pin_circle_radius + 1.8 * model.spec.pin_radius


def _shown_cam(model: IndexerModel, cam: PlacedCam) -> Iterator[Shape]:
    """Profile and holes of a cam on screen, around the pins within its disc."""
    outline = screen_outline(cam.drive)
    if cam.drive.side == "outside":
        yield Shape("body", circle((0, 0), edge_radius(cam.drive, outline)))
    yield Shape("profile", outline)
    yield from (Shape("hole", hole) for hole in _holes(model, cam.turned))


def hole_radius(model: IndexerModel) -> float | None:
    """Radius of the crank bearings' holes in a cam [m], None where no bearing tells it."""
    outer = getattr(model.crank_bearing, "outer_diameter", None)
    return outer / 2 if outer else None


def _holes(model: IndexerModel, turned: float = 0.0) -> Iterator[Outline]:
    """Bearing holes in the frame of a cam that is turned against the line of the shafts."""
    radius = hole_radius(model)
    spacing = model.spec.shaft_spacing
    if radius and spacing and model.translating:
        for side in (-1, 1):
            yield circle(point_of(side * spacing / 2 * np.exp(-1j * turned)), radius)


def cam_shapes(model: IndexerModel, drive: PlaneDrive) -> Iterator[Shape]:
    """Profile, holes and the centre curve of the pins, for the drawing."""
    outline = profile_outline(drive)
    if drive.side == "outside":
        yield Shape("body", circle((0, 0), outer_radius(drive)))
    yield Shape("profile", outline)
    yield from (Shape("hole", hole) for hole in _holes(model))
    if drive.side == "inside":
        yield Shape("base", circle((0, 0), float(np.min(np.hypot(*outline.points(1e-6).T)))))
    if model.translating:
        yield Shape("pitch", polygon(pin_centre_curve(drive)))


def _cranks(model: IndexerModel, angle: Floats) -> Iterator[Body]:
    """Crank pins on the split shafts."""
    if model.spec.shaft_spacing is None or not model.translating:
        return
    e, sense = model.wheel.eccentricity, model.wheel.sense
    radius = hole_radius(model)
    pin = 0.5 * radius if radius else e
    for number, side in enumerate((-1, 1)):
        shapes = [Shape("axis", circle((0, 0), e)), Shape("ground", circle((0, 0), 0.25 * pin))]
        for cam in range(model.spec.cams):
            at = e * np.exp(1j * TURN * cam / model.spec.cams)
            shapes.append(Shape("body", circle(point_of(at), pin)))
        placed = poses(side * model.spec.shaft_spacing / 2 + 0 * angle, sense * angle)
        yield Body(f"crank{number + 1}", ("left", "right")[number] + " crank", tuple(shapes), placed, "violet")


# -- drawings and parts ------------------------------------------------------------------------------------------------------------


def drawings(model: IndexerModel) -> tuple[Drawing, ...]:
    """The cams that differ; plane kinds only."""
    if model.spec.kind in ("barrel", "globoidal"):
        return ()
    found, alike = [], 2 if model.translating and model.spec.cams % 2 == 0 else 1  # half a turn brings the holes back on each other
    for number, level in enumerate(model.plane.levels):
        reach = 1.1 * float(np.max(np.hypot(*profile_outline(level).points(1e-5).T)))
        axes = tuple(Shape("axis", polygon(pair, closed=False)) for pair in (((-reach, 0), (reach, 0)), ((0, -reach), (0, reach))))
        name = f"cam{number + 1}" if len(model.plane.levels) > 1 else "cam"
        title = f"{model.spec.title or 'indexer'}: {name}" + (f" ({alike} alike)" if alike > 1 else "")
        found.append(Drawing(name, title, (*cam_shapes(model, level), *axes), model.spec.cam_width, level.side == "inside"))
    return tuple(found)


def parts(model: IndexerModel) -> tuple[Part, ...]:
    """Cams one behind the other, and the wheel as a ring with its pins; roller gears as their own solids."""
    return (roller_views.parts if model.spec.kind in ("barrel", "globoidal") else _plane_parts)(model)


def _plane_parts(model: IndexerModel) -> tuple[Part, ...]:
    width, spec = model.spec.cam_width, model.spec
    step = spec.shafts.pitch if spec.shafts else 1.2 * width
    found, start = [], np.zeros(1)
    for number, cam in enumerate(cams(model)):
        outline, holes = profile_outline(cam.drive), tuple(_holes(model, cam.turned))
        plate = (outline, holes) if cam.drive.side == "inside" else (circle((0, 0), outer_radius(cam.drive)), (outline,))
        x, y, turn = (float(each) for each in cam_poses(cam, start)[0])
        found.append(Part(f"cam{number + 1}", (Prism(*plate, number * step, width),), (x, y, turn), COLOURS[number % len(COLOURS)]))
    reach = (len(cams(model)) - 1) * step + width
    pins = [
        Prism(circle(point_of(at), level.pin_radius), (), *_pin_heights(model, number, step, width, reach))
        for number, level in enumerate(model.plane.levels)
        for at in level.pin_centres(0.0).d0
    ]
    inner, outer = rim(model)
    disc = Prism(circle((0, 0), outer), (circle((0, 0), inner),), -1.2 * width, width)
    found.append(Part("wheel", (disc, *pins), colour="orange"))
    return tuple(found)


def _pin_heights(model: IndexerModel, number: int, step: float, width: float, reach: float) -> tuple[float, float]:
    """(z, length) of the pins of a level: from the disc through its own cam, or through all of them."""
    top = reach if model.translating else number * step + width
    return -0.2 * width, top + 0.2 * width
