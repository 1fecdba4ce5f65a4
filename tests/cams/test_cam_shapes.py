"""A cam as shapes and solids: radii, heights and bores from the parameters of an eccentric cam with a known profile."""

from functools import partial

import numpy as np
import pytest

from drivewright import cams, motion
from drivewright.cams import cam_shapes
from drivewright.cams.track import CamTrack

pytestmark = pytest.mark.analytical

PRIME, ROLLER, LIFT = 0.040, 0.008, 0.010


@pytest.fixture(scope="module")
def programme():
    law = motion.law("cycloidal")
    return motion.Programme((motion.Segment(np.pi, law, LIFT), motion.Segment(np.pi, law, -LIFT)))


@pytest.fixture(scope="module")
def track(programme):
    follower = cams.TranslatingRound(PRIME, ROLLER, 0.0, 1)
    return CamTrack("cam", "", follower, follower.contact)


@pytest.fixture(scope="module")
def wall(track):
    return CamTrack("outer wall", "outer.", track.follower, partial(track.follower.contact, flank=-1), flank=-1)


@pytest.fixture(scope="module")
def profile(programme, track):
    return cams.finished_profile(track.follower, programme)


@pytest.fixture(scope="module")
def wall_profile(programme, wall):
    return cams.finished_profile(wall.follower, programme, -1)


def radii(outline):
    return np.hypot(*np.asarray(outline.points(1e-6)).T)


def test_base_circle_pitch_curve_and_bore_of_a_cam(programme, track, profile):
    shapes = {shape.layer: shape.outline for shape in cam_shapes.cam_shapes(track, profile, programme, bore=0.012)}
    assert set(shapes) == {"profile", "base", "pitch", "hole"}
    assert radii(shapes["base"]) == pytest.approx(PRIME - ROLLER, abs=1e-6)  # a radial roller follower rests on it at zero lift
    assert radii(shapes["profile"]).max() == pytest.approx(PRIME - ROLLER + LIFT, abs=2e-6)
    assert (radii(shapes["pitch"]).min(), radii(shapes["pitch"]).max()) == pytest.approx((PRIME, PRIME + LIFT), abs=2e-6)
    assert radii(shapes["hole"]) == pytest.approx(0.006, abs=1e-6)


def test_a_cam_without_a_bore_has_no_hole(programme, track, profile):
    assert "hole" not in {shape.layer for shape in cam_shapes.cam_shapes(track, profile, programme)}


def test_the_disc_of_a_groove_keeps_its_wall_outside_the_groove(programme, wall, wall_profile):
    disc = cam_shapes.groove_disc_radius(wall_profile, wall=0.003)
    assert disc == pytest.approx(PRIME + LIFT + ROLLER + 0.003, abs=2e-6)
    shapes = {
        shape.layer: shape.outline for shape in cam_shapes.groove_wall_shapes(wall, wall_profile, cams.Cycle(programme.function), disc)
    }
    assert radii(shapes["body"]) == pytest.approx(disc, abs=1e-6)
    assert radii(shapes["profile"]).min() == pytest.approx(PRIME + ROLLER, abs=2e-6)


def test_an_undercut_leaves_the_removed_stretches_as_defects(programme):
    follower = cams.TranslatingRound(0.010, 0.0095, 0.0, 1)
    track = CamTrack("cam", "", follower, follower.contact)
    steep = motion.Programme(
        (
            motion.Segment(0.5, motion.law("cycloidal"), 0.004),
            motion.Segment(0.5, motion.law("cycloidal"), -0.004),
            motion.Segment(2 * np.pi - 1, "dwell"),
        )
    )
    finished = cams.finished_profile(follower, steep)
    defects = list(cam_shapes.trimmed_shapes(track, finished, cams.Cycle(steep.function)))
    assert len(defects) == len(finished.trimmed.removed) > 0
    assert {shape.layer for shape in defects} == {"defect"}
    for (start, stop), shape in zip(finished.trimmed.removed, defects, strict=True):
        ends = [track.contact(*cams.Cycle(steep.function).at_angle(np.array([angle]))).point.d0[0] for angle in (start, stop)]
        points = np.asarray(shape.outline.points(1e-6))
        assert points[0] @ (1, 1j) == pytest.approx(ends[0], abs=1e-9)
        assert points[-1] @ (1, 1j) == pytest.approx(ends[1], abs=1e-9)


def test_the_hub_stands_where_it_is_put_with_the_bore_through_both(profile):
    disc, hub = cam_shapes.cam_solids(profile, width=0.010, z=0.002, bore=0.012, hub=(0.024, 0.012, 0.015))
    assert (disc.z, disc.thickness, hub.z, hub.thickness) == (0.002, 0.010, 0.012, 0.015)
    assert disc.outline is profile.outline
    assert radii(hub.outline) == pytest.approx(0.012, abs=1e-6)
    for solid in (disc, hub):
        assert radii(solid.holes[0]) == pytest.approx(0.006, abs=1e-6)


def test_the_ring_of_a_groove_stands_on_its_disc(wall_profile):
    disc, ring = cam_shapes.groove_solids(wall_profile, 0.070, width=0.010, z=0.002, bore=0.012)
    assert disc.z + disc.thickness == pytest.approx(ring.z)
    assert (ring.z, ring.thickness, disc.thickness) == (0.002, 0.010, 0.010)
    assert radii(disc.outline) == pytest.approx(0.070, abs=1e-6)
    assert ring.holes == (wall_profile.outline,)
    assert radii(disc.holes[0]) == pytest.approx(0.006, abs=1e-6)
