"""The plane kinds on screen and for manufacture: scene, drawings, parts."""

from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from drivewright.curves import drawn_outline
from drivewright.indexing.motion import TURN
from drivewright.indexing.plane import ALIVE, envelope_points, pitch_point
from drivewright.mechanisms.indexer import roller_views
from drivewright.scene import Body, Drawing, Frame, Part, Prism, Scene, Shape, circle, polygon

FRAMES = 361
FINE = 2e-6  # splines of the profile follow it to this [m]
_BEHIND = 3  # so many times as deep is a point sought in the cam
DRAWN = 2e-5  # on screen it stays within this part of the pin circle's radius
COLOURS = ("blue", "green", "violet", "steel")
NORMALS = 1.4  # length of a normal over the pin circle's radius


def scene(model):
    """The drive over one turn of the input."""
    return (roller_views.scene if model.spec.kind in ("barrel", "globoidal") else _plane_scene)(model)


class Cam(NamedTuple):
    """A cam on screen: the drive whose profile it has, and how far it is turned about the wheel's axis [rad]."""

    drive: Any
    turned: float


def cams(model):
    """All cams, the first one first: copies turned about the wheel's axis, or one of each shape."""
    if not model.translating:
        return tuple(Cam(level, 0.0) for level in model.drive.levels)
    return tuple(Cam(model.drive, TURN * number / model.spec.cams) for number in range(model.spec.cams))


def cam_poses(cam, angle):
    """Pose of a cam at input angles."""
    place, turn = (np.broadcast_to(jet.d0, angle.shape) for jet in cam.drive.pose(angle))
    return poses(place * np.exp(1j * cam.turned), turn + cam.turned)


def _plane_scene(model):
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
    bodies += _normals(cams(model)[0], angle)
    frames = (
        Frame("machine", "machine frame", still),
        Frame("cam", "seen from cam 1", cam_poses(cams(model)[0], angle)),
        Frame("wheel", "seen from the wheel", poses(0 * angle, phi)),
    )
    return Scene(angle, "input angle", "rad", period(model), tuple(bodies), frames, (), "motion", marks(moving))


def marks(moving):
    """Where step and dwell begin."""
    return ((0.0, "step"),) if moving.motion_angle >= TURN else ((0.0, "step"), (moving.motion_angle, "dwell"))


def period(model):
    """Of a turn of the input [s]."""
    return TURN / model.spec.load.speed if model.spec.load.speed else 4.0


def poses(place, angle):
    return np.stack(np.broadcast_arrays(np.real(place), np.imag(place), angle), axis=1)


def _wheel_shapes(model):
    inner, outer = rim(model)
    yield Shape("base", circle((0, 0), outer))
    yield Shape("base", circle((0, 0), inner))
    for level in model.drive.levels:
        for centre in level.centres(0.0).d0:
            yield Shape("roller", circle(_pair(centre), level.pin_radius))


def rim(model):
    """Inner and outer radius of the wheel's disc [m]."""
    return model.spec.pin_circle_radius - 1.8 * model.spec.pin_radius, model.spec.pin_circle_radius + 1.8 * model.spec.pin_radius


@lru_cache(maxsize=16)
def drawn_cam(drive):
    """Outline of the trimmed profile, as fine as a picture needs."""
    drive.refuse()
    return drawn_outline(drive.family, DRAWN * drive.circle_radius)


def _shown_cam(model, cam):
    """Profile and holes of a cam on screen, around the pins within its disc."""
    outline = drawn_cam(cam.drive)
    if cam.drive.side == "outside":
        yield Shape("body", circle((0, 0), _edge(cam.drive, outline)))
    yield Shape("profile", outline)
    yield from (Shape("hole", hole) for hole in _holes(model, cam.turned))


def cam_outline(drive):
    """Exact outline of the trimmed profile."""
    return drive.profile.outline(FINE)


def hole_radius(model):
    """Radius of the crank bearings' holes in a cam [m], None where no bearing tells it."""
    outer = getattr(model.crank_bearing, "outer_diameter", None)
    return outer / 2 if outer else None


def _holes(model, turned=0.0):
    """Bearing holes in the frame of a cam that is turned against the line of the shafts."""
    radius = hole_radius(model)
    if radius and model.translating:
        for side in (-1, 1):
            yield circle(_pair(side * model.spec.shaft_spacing / 2 * np.exp(-1j * turned)), radius)


def cam_shapes(model, drive):
    """Profile, holes and the centre curve of the pins, for the drawing."""
    outline = cam_outline(drive)
    if drive.side == "outside":
        yield Shape("body", circle((0, 0), outer_radius(drive)))
    yield Shape("profile", outline)
    yield from (Shape("hole", hole) for hole in _holes(model))
    if drive.side == "inside":
        yield Shape("base", circle((0, 0), float(np.min(np.hypot(*outline.points(1e-6).T)))))
    if model.translating:
        yield Shape("pitch", polygon(_centre_curve(drive)))


def outer_radius(drive):
    """Outer edge of a cam around the pins [m]."""
    return _edge(drive, cam_outline(drive))


def _edge(drive, outline):
    return float(np.max(np.hypot(*outline.points(1e-6).T))) + 2 * drive.pin_radius


def _centre_curve(drive, steps=120):
    theta = np.linspace(0, TURN, steps, endpoint=False)
    points = drive.path(theta).d0.T.ravel()
    return np.stack([points.real, points.imag], axis=1)


def _cranks(model, angle):
    """Crank pins on the split shafts."""
    if model.spec.shaft_spacing is None or not model.translating:
        return
    e, sense = model.spec.eccentricity, model.drive.sense
    radius = hole_radius(model)
    pin = 0.5 * radius if radius else e
    for number, side in enumerate((-1, 1)):
        shapes = [Shape("axis", circle((0, 0), e)), Shape("ground", circle((0, 0), 0.25 * pin))]
        for cam in range(model.spec.cams):
            at = e * np.exp(1j * TURN * cam / model.spec.cams)
            shapes.append(Shape("body", circle(_pair(at), pin)))
        placed = poses(side * model.spec.shaft_spacing / 2 + 0 * angle, sense * angle)
        yield Body(f"crank{number + 1}", ("left", "right")[number] + " crank", tuple(shapes), placed, "violet")


def _normals(cam, angle):
    """The pitch point, and the common normal of every pin that touches a cam; a pin that does not shows the normal of another."""
    drive = cam.drive
    reach = 1.15 * max(drive.circle_radius, float(np.max(np.abs(drive.pose(angle)[0].d0))))
    pitch = pitch_point(drive, angle)
    turn = np.where(np.isfinite(pitch), pitch, drive.pose(angle)[0].d0)
    shown = np.where(np.abs(pitch) < reach, pitch, reach * turn / np.abs(turn))
    yield Body(
        "pitch_point",
        "pitch point (on the rim: beyond it)",
        (Shape("profile", circle((0, 0), 0.03 * drive.circle_radius)),),
        poses(shown, 0.0),
        "ground",
    )
    places, turns = _normal_poses(drive, angle)
    line = polygon([(0.0, 0.0), (NORMALS * drive.circle_radius, 0.0)], closed=False)
    for pin in range(drive.pins):
        yield Body(f"normal{pin}", "common normals of cam 1", (Shape("axis", line),), poses(places[:, pin], turns[:, pin]), "ground")


def _normal_poses(drive, angle):
    """Foot and direction of the normal of every pin, towards the pitch point."""
    centre, turn = drive.centres(angle).d0, np.broadcast_to(drive.pose(angle)[1].d0, angle.shape)[:, None]
    side = _touching_side(drive, angle)
    touched = side != 0
    towards_pin = -side * 1j * np.exp(1j * turn) * _unit(drive.path(angle).d1)
    pitch = pitch_point(drive, angle)[:, None]
    ahead = np.real(np.conj(towards_pin) * (np.where(np.isfinite(pitch), pitch, 0.0) - centre))
    normal = towards_pin * np.where(ahead >= 0, 1.0, -1.0)
    chosen = np.where(touched, np.arange(drive.pins), np.argmax(touched, axis=1)[:, None])
    rows, any_touch = np.arange(len(angle))[:, None], touched.any(axis=1)[:, None]
    return np.where(any_touch, centre[rows, chosen], 0.0), np.where(any_touch, np.angle(normal[rows, chosen]), 0.0)


def _touching_side(drive, angle):
    """+1 or -1 where a pin touches the cam on the left or right of its path, 0 where it does not; shape (angle, pins).

    Of the envelope's points of each pin those count with the cam behind them that no pin at any of the angles covers; the right one
    where both do.
    """
    from scipy.spatial import cKDTree

    points, centre = envelope_points(drive, angle), drive.path(angle).d0
    row, pin, side = np.nonzero(_in_cam(drive, points + _BEHIND * DRAWN * drive.circle_radius * _unit(points - centre[..., None])))
    near = points[row, pin, side]
    tree = cKDTree(np.stack([centre.ravel().real, centre.ravel().imag], axis=1))
    kept = np.isinf(tree.query(np.stack([near.real, near.imag], axis=1), distance_upper_bound=drive.pin_radius - ALIVE)[0])
    touching = np.zeros((*centre.shape, 2), dtype=bool)
    touching[row[kept], pin[kept], side[kept]] = True
    return np.where(touching[..., 1], -1.0, np.where(touching[..., 0], 1.0, 0.0))


def _in_cam(drive, points):
    """Whether points seen from the cam, complex, lie in it; nan does not."""
    import shapely

    profile = shapely.polygons(drawn_cam(drive).points())
    shapely.prepare(profile)
    return (shapely.contains_xy(profile, points.real, points.imag) == (drive.side == "inside")) & np.isfinite(points)


def _unit(z):
    with np.errstate(divide="ignore", invalid="ignore"):
        return z / np.abs(z)


def _pair(z):
    return float(np.real(z)), float(np.imag(z))


# -- drawings and parts ------------------------------------------------------------------------------------------------------------


def drawings(model):
    """The cams that differ; plane kinds only."""
    if model.spec.kind in ("barrel", "globoidal"):
        return ()
    found, alike = [], 2 if model.translating and model.spec.cams % 2 == 0 else 1  # half a turn brings the holes back on each other
    for number, level in enumerate(model.drive.levels):
        reach = 1.1 * float(np.max(np.hypot(*cam_outline(level).points(1e-5).T)))
        axes = tuple(Shape("axis", polygon(pair, closed=False)) for pair in (((-reach, 0), (reach, 0)), ((0, -reach), (0, reach))))
        name = f"cam{number + 1}" if len(model.drive.levels) > 1 else "cam"
        title = f"{model.spec.title or 'indexer'}: {name}" + (f" ({alike} alike)" if alike > 1 else "")
        found.append(Drawing(name, title, (*cam_shapes(model, level), *axes), model.spec.cam_width, level.side == "inside"))
    return tuple(found)


def parts(model):
    """Cams one behind the other, and the wheel as a ring with its pins; roller gears as their own solids."""
    return (roller_views.parts if model.spec.kind in ("barrel", "globoidal") else _plane_parts)(model)


def _plane_parts(model):
    width, spec = model.spec.cam_width, model.spec
    step = spec.shafts.pitch if spec.shafts else 1.2 * width
    found, start = [], np.zeros(1)
    for number, cam in enumerate(cams(model)):
        outline, holes = cam_outline(cam.drive), tuple(_holes(model, cam.turned))
        plate = (outline, holes) if cam.drive.side == "inside" else (circle((0, 0), outer_radius(cam.drive)), (outline,))
        pose = tuple(float(each) for each in cam_poses(cam, start)[0])
        found.append(Part(f"cam{number + 1}", (Prism(*plate, number * step, width),), pose, COLOURS[number % len(COLOURS)]))
    reach = (len(cams(model)) - 1) * step + width
    pins = [
        Prism(circle(_pair(at), level.pin_radius), (), *_pin_heights(model, number, step, width, reach))
        for number, level in enumerate(model.drive.levels)
        for at in level.centres(0.0).d0
    ]
    inner, outer = rim(model)
    disc = Prism(circle((0, 0), outer), (circle((0, 0), inner),), -1.2 * width, width)
    found.append(Part("wheel", (disc, *pins), colour="orange"))
    return tuple(found)


def _pin_heights(model, number, step, width, reach):
    """(z, length) of the pins of a level: from the disc through its own cam, or through all of them."""
    top = reach if model.translating else number * step + width
    return -0.2 * width, top + 0.2 * width
