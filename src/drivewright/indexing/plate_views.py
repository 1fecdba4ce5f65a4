"""Indexing drives with plate cams as pictures and solids: scene over a turn of the input, drawings of the cams, solids of the parts."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.indexing.drawing import (
    PlacedCam,
    cam_poses,
    edge_radius,
    normal_bodies,
    outer_radius,
    pin_centre_curves,
    point_of,
    poses,
    profile_outline,
    screen_outline,
)
from drivewright.indexing.motion import TURN, IndexMotion
from drivewright.indexing.parallel import ParallelIndexer
from drivewright.indexing.pin_wheel import PinWheel
from drivewright.indexing.plane import PlaneDrive
from drivewright.scene import Body, Drawing, Frame, Outline, Part, Prism, Scene, Shape, circle, polygon

FRAMES = 361
COLOURS = ("blue", "green", "violet", "steel")
RIM = 1.8  # half the width of the wheel's disc, over the radius of a pin


class CamHoles(NamedTuple):
    """Two bearing holes of a cam on cranks: distance [m] of the crank shafts, radius [m] of the holes, None where it is not known."""

    spacing: float
    radius: float | None = None


@dataclass(frozen=True, eq=False)
class PlateDrive:
    """A drive with plate cams and what of it is drawn: cams (of a pin wheel, evenly phased), their width [m] and their distance [m] along
    the axis, the holes of cams on cranks (None: no cranks are drawn)."""

    drive: PinWheel | ParallelIndexer
    cams: int
    cam_width: float
    cam_step: float
    holes: CamHoles | None = None

    @property
    def placed_cams(self) -> tuple[PlacedCam, ...]:
        """All cams, the first one first: copies turned about the wheel's axis, or one of each shape."""
        if isinstance(self.drive, PinWheel):
            return tuple(PlacedCam(self.drive, TURN * number / self.cams) for number in range(self.cams))
        return tuple(PlacedCam(level, 0.0) for level in self.drive.levels)

    @property
    def rim(self) -> tuple[float, float]:
        """Inner and outer radius of the wheel's disc [m]."""
        return self.drive.circle_radius - RIM * self.drive.pin_radius, self.drive.circle_radius + RIM * self.drive.pin_radius


def plate_scene(plates: PlateDrive, period: float) -> Scene:
    """Wheel, cams and cranks over one turn of the input in `period` [s], with the normals of the first cam through the pitch point."""
    angle = np.linspace(0, TURN, FRAMES)
    moving = plates.drive.motion
    phi = np.append(moving(angle[:-1]).d0, moving.pitch)
    still = poses(0 * angle, 0.0)
    cams = plates.placed_cams
    bodies = [Body("wheel", "wheel with pins", tuple(_wheel_shapes(plates)), poses(0 * angle, phi), "orange")]
    for number, cam in reversed(list(enumerate(cams))):
        colour = COLOURS[number % len(COLOURS)]
        bodies.append(Body(f"cam{number + 1}", f"cam {number + 1}", tuple(_screen_shapes(plates, cam)), cam_poses(cam, angle), colour))
    bodies += _cranks(plates, angle)
    bodies += normal_bodies(cams[0].drive, angle)
    frames = (
        Frame("machine", "machine frame", still),
        Frame("cam", "seen from cam 1", cam_poses(cams[0], angle)),
        Frame("wheel", "seen from the wheel", poses(0 * angle, phi)),
    )
    return Scene(angle, "input angle", "rad", period, tuple(bodies), frames, (), "motion", motion_marks(moving))


def motion_marks(moving: IndexMotion) -> tuple[tuple[float, str], ...]:
    """Input angles [rad] at which step and dwell begin, with their names."""
    return ((0.0, "step"),) if moving.motion_angle >= TURN else ((0.0, "step"), (moving.motion_angle, "dwell"))


def _wheel_shapes(plates: PlateDrive) -> Iterator[Shape]:
    inner, outer = plates.rim
    yield Shape("base", circle((0, 0), outer))
    yield Shape("base", circle((0, 0), inner))
    for level in plates.drive.levels:
        for centre in level.pin_centres(0.0).d0:
            yield Shape("roller", circle(point_of(centre), level.pin_radius))


def _screen_shapes(plates: PlateDrive, cam: PlacedCam) -> Iterator[Shape]:
    """Profile and holes of a cam on screen; a cam around the pins within its disc."""
    outline = screen_outline(cam.drive)
    if cam.drive.side == "outside":
        yield Shape("body", circle((0, 0), edge_radius(cam.drive, outline)))
    yield Shape("profile", outline)
    yield from (Shape("hole", hole) for hole in _hole_outlines(plates.holes, cam.turned))


def _hole_outlines(holes: CamHoles | None, turned: float = 0.0) -> Iterator[Outline]:
    """Bearing holes in the frame of a cam that is turned against the line of the crank shafts."""
    if holes and holes.radius:
        for side in (-1, 1):
            yield circle(point_of(side * holes.spacing / 2 * np.exp(-1j * turned)), holes.radius)


def _cranks(plates: PlateDrive, angle: Floats) -> Iterator[Body]:
    """Crank pins on the split shafts."""
    wheel = plates.drive
    if plates.holes is None or not isinstance(wheel, PinWheel):
        return
    pin = 0.5 * plates.holes.radius if plates.holes.radius else wheel.eccentricity
    for number, side in enumerate((-1, 1)):
        shapes = [Shape("axis", circle((0, 0), wheel.eccentricity)), Shape("ground", circle((0, 0), 0.25 * pin))]
        for cam in range(plates.cams):
            at = wheel.eccentricity * np.exp(1j * TURN * cam / plates.cams)
            shapes.append(Shape("body", circle(point_of(at), pin)))
        placed = poses(side * plates.holes.spacing / 2 + 0 * angle, wheel.sense * angle)
        yield Body(f"crank{number + 1}", ("left", "right")[number] + " crank", tuple(shapes), placed, "violet")


# -- drawings and solids -----------------------------------------------------------------------------------------------------------


def plate_drawings(plates: PlateDrive, title: str) -> tuple[Drawing, ...]:
    """A drawing of each cam that has a shape of its own, named after the `title` of the drive."""
    levels = plates.drive.levels
    # Half a turn brings the holes back on each other.
    alike = 2 if isinstance(plates.drive, PinWheel) and plates.cams % 2 == 0 else 1
    drawings = []
    for number, level in enumerate(levels):
        reach = 1.1 * float(np.max(np.hypot(*profile_outline(level).points(1e-5).T)))
        axes = tuple(Shape("axis", polygon(pair, closed=False)) for pair in (((-reach, 0), (reach, 0)), ((0, -reach), (0, reach))))
        name = f"cam{number + 1}" if len(levels) > 1 else "cam"
        heading = f"{title}: {name}" + (f" ({alike} alike)" if alike > 1 else "")
        shapes = (*_drawing_shapes(plates, level), *axes)
        drawings.append(Drawing(name, heading, shapes, plates.cam_width, level.side == "inside"))
    return tuple(drawings)


def _drawing_shapes(plates: PlateDrive, drive: PlaneDrive) -> Iterator[Shape]:
    """Profile, holes and the centre curve of the pins."""
    outline = profile_outline(drive)
    if drive.side == "outside":
        yield Shape("body", circle((0, 0), outer_radius(drive)))
    yield Shape("profile", outline)
    yield from (Shape("hole", hole) for hole in _hole_outlines(plates.holes))
    if drive.side == "inside":
        yield Shape("base", circle((0, 0), float(np.min(np.hypot(*outline.points(1e-6).T)))), "least radius of the profile")
    if isinstance(plates.drive, PinWheel):
        yield from (Shape("pitch", polygon(curve), "curve of the pin centres") for curve in pin_centre_curves(drive))


def plate_parts(plates: PlateDrive) -> tuple[Part, ...]:
    """Cams one behind the other, and the wheel as a ring with its pins."""
    width, step, start = plates.cam_width, plates.cam_step, np.zeros(1)
    parts = []
    for number, cam in enumerate(plates.placed_cams):
        outline, holes = profile_outline(cam.drive), tuple(_hole_outlines(plates.holes, cam.turned))
        plate = (outline, holes) if cam.drive.side == "inside" else (circle((0, 0), outer_radius(cam.drive)), (outline,))
        x, y, turn = (float(each) for each in cam_poses(cam, start)[0])
        parts.append(Part(f"cam{number + 1}", (Prism(*plate, number * step, width),), (x, y, turn), COLOURS[number % len(COLOURS)]))
    pins = [
        Prism(circle(point_of(at), level.pin_radius), (), *_pin_heights(plates, number))
        for number, level in enumerate(plates.drive.levels)
        for at in level.pin_centres(0.0).d0
    ]
    inner, outer = plates.rim
    disc = Prism(circle((0, 0), outer), (circle((0, 0), inner),), -1.2 * width, width)
    return (*parts, Part("wheel", (disc, *pins), colour="orange"))


def _pin_heights(plates: PlateDrive, level: int) -> tuple[float, float]:
    """(z, length) of the pins of a level: from the disc through its own cam, or, of cams on cranks, through all of them."""
    width = plates.cam_width
    last = len(plates.placed_cams) - 1 if isinstance(plates.drive, PinWheel) else level
    return -0.2 * width, last * plates.cam_step + width + 0.2 * width
