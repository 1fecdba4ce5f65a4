"""Cam and turret of a roller gear turn as they do in the drive: every roller touches the groove's flanks over the whole turn."""

import numpy as np
import pytest

from drivewright.indexing.motion import TURN, index_motion
from drivewright.indexing.roller_gear import barrel, compute_flanks, globoidal, turret_part
from drivewright.indexing.roller_gear.scenes import frame_angles, roller_gear_scene
from drivewright.indexing.roller_gear.solid import cam_turning

pytestmark = pytest.mark.property
MOTION = index_motion("modified-sine", 12, 2.0)
CAMS = {
    "globoidal, left": globoidal(MOTION, 0.08, 0.012, 0.016, 0.125, 0.06, hand="left"),
    "globoidal, right": globoidal(MOTION, 0.08, 0.012, 0.016, 0.125, 0.06, hand="right"),
    "barrel": barrel(MOTION, 0.09, 0.012, 0.016, 0.05, 0.075),
}


def turned(points, turning, angle):
    """Points (..., 3) turned by the right hand about the line of a turning, by Rodrigues."""
    k, at = np.asarray(turning.direction), np.asarray(points) - turning.point
    return turning.point + at * np.cos(angle) + np.cross(k, at) * np.sin(angle) + np.outer(at @ k, k) * (1 - np.cos(angle))


def distances(cam, points, turn):
    """From points (n, 3) to the axes of all rollers of the turret, turned by `turn`."""
    psi = cam.pin_pitch * (cam.phase + np.arange(cam.pins)) + turn
    radial = np.stack([np.cos(psi), np.sin(psi), 0 * psi], axis=-1)
    foot, along = (0 * radial, radial) if cam.kind == "globoidal" else (cam.pin_circle_radius * radial, np.array([0.0, 0.0, 1.0]))
    return np.linalg.norm(np.cross(points[:, None] - foot, along), axis=-1)


@pytest.mark.parametrize("name", CAMS)
def test_rollers_touch_the_flanks_of_the_turning_cam(name):
    cam = CAMS[name]
    of_cam, of_turret = cam_turning(cam), turret_part(cam).turning
    frames = np.arange(5, len(frame_angles()) - 5, 17)
    found, checked = compute_flanks(cam, frame_angles()[frames], 5), 0
    for number, frame in enumerate(frames):
        here = found.on_cam[:, :, number]
        points = found.contact.point[:, :, number][here] + [cam.centre_distance, 0.0, cam.height]
        away = distances(cam, turned(points, of_cam, of_cam.angles[frame]), of_turret.angles[frame])
        assert np.allclose(np.abs(away - cam.roller_radius).min(axis=1), 0, atol=1e-9)
        checked += len(points)
    assert checked > 100


@pytest.mark.parametrize("name", CAMS)
def test_turns_belong_to_the_frames_of_the_scene(name):
    cam = CAMS[name]
    scene, turret = roller_gear_scene(cam, 1.0), turret_part(cam).turning
    assert len(scene.cycle) == len(cam_turning(cam).angles) == len(turret.angles)
    assert np.ptp(cam_turning(cam).angles) == pytest.approx(TURN) and turret.angles[-1] == pytest.approx(TURN / 12)
