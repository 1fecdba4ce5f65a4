"""Roller gears on screen, unrolled on the pitch surface, and as solids."""

import numpy as np

from drivewright.indexing import roller_gear
from drivewright.indexing.motion import TURN
from drivewright.mechanisms.indexer.build import IndexerModel
from drivewright.scene import Body, Frame, Part, Scene, Shape, circle, polygon

FRAMES = 361


def scene(model: IndexerModel) -> Scene:
    """The developed surface: ribs pass the rollers as the cam turns; the rollers move along the wheel's circle."""
    cam = model.cam
    angle = np.linspace(0, TURN, FRAMES)
    unrolled = roller_gear.develop_surface(cam)
    moving = np.stack([-unrolled.pitch_radius * angle, 0 * angle, 0 * angle], axis=1)
    still = np.zeros((FRAMES, 3))
    bodies = [Body("cam", "ribs of the cam, unrolled", tuple(Shape("profile", polygon(rib)) for rib in unrolled.ribs), moving, "blue")]
    places = roller_gear.developed_roller_centres(cam, angle)
    for number, place in zip(cam.rollers, places, strict=True):
        poses = np.column_stack([place, 0 * angle])
        bodies.append(
            Body(f"roller{number}", "rollers of the wheel", (Shape("roller", circle((0, 0), cam.roller_radius)),), poses, "orange")
        )
    period = TURN / model.spec.load.speed if model.spec.load.speed else 4.0
    dwell = ((cam.motion.motion_angle, "dwell"),) if cam.motion.motion_angle < TURN else ()
    frames = (Frame("machine", "machine frame, cam unrolled", still), Frame("cam", "seen from the cam", moving))
    return Scene(angle, "input angle", "rad", period, tuple(bodies), frames, (), "motion", ((0.0, "step"), *dwell))


def parts(model: IndexerModel) -> tuple[Part, ...]:
    """Cam and wheel as solids."""
    return roller_gear.cam_part(model.cam), roller_gear.turret_part(model.cam)
