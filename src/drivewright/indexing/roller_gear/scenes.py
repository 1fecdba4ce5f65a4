"""A roller gear on screen, unrolled on the pitch surface of its cam."""

import numpy as np

from drivewright._typing import Floats
from drivewright.indexing.motion import TURN
from drivewright.indexing.plate_views import FRAMES, motion_marks
from drivewright.indexing.roller_gear.design import RollerGear
from drivewright.indexing.roller_gear.views import develop_surface, developed_roller_centres
from drivewright.scene import Body, Frame, Scene, Shape, circle, polygon


def frame_angles() -> Floats:
    """Angles (frames,) [rad] of the input that are drawn."""
    return np.linspace(0, TURN, FRAMES)


def roller_gear_scene(cam: RollerGear, period: float) -> Scene:
    """One turn of the input in `period` [s]: ribs pass the rollers as the cam turns; the rollers move along the wheel's circle."""
    angle = frame_angles()
    unrolled = develop_surface(cam)
    moving = np.stack([-unrolled.pitch_radius * angle, 0 * angle, 0 * angle], axis=1)
    still = np.zeros((FRAMES, 3))
    bodies = [Body("cam", "ribs of the cam, unrolled", tuple(Shape("profile", polygon(rib)) for rib in unrolled.ribs), moving, "blue")]
    places = developed_roller_centres(cam, angle)
    for number, place in zip(cam.rollers, places, strict=True):
        poses = np.column_stack([place, 0 * angle])
        bodies.append(
            Body(f"roller{number}", "rollers of the wheel", (Shape("roller", circle((0, 0), cam.roller_radius)),), poses, "orange")
        )
    frames = (Frame("machine", "machine frame, cam unrolled", still), Frame("cam", "seen from the cam", moving))
    return Scene(angle, "input angle", "rad", period, tuple(bodies), frames, (), "motion", motion_marks(cam.motion))
