"""The cam itself as shapes, for scene and drawings, and as solids: profile, pitch curve, base circle, bore, hub, groove."""

from collections.abc import Iterator

import numpy as np

from drivewright.cams.cycle import Cycle
from drivewright.cams.finished import FinishedProfile, pitch_outline
from drivewright.cams.track import CamTrack
from drivewright.motion import Programme
from drivewright.scene import Prism, Shape, circle, polygon

TOLERANCE = 1e-6  # m, of the points by which base circle and disc are measured


def cam_shapes(track: CamTrack, profile: FinishedProfile, programme: Programme, bore: float | None = None) -> Iterator[Shape]:
    """Profile, base circle, pitch curve, bore (diameter [m]) of a cam worked from the outside, and what was trimmed away."""
    yield Shape("profile", profile.outline)
    yield Shape("base", circle((0, 0), float(_radii(profile).min())))
    if not track.flat and track.radius:
        yield Shape("pitch", pitch_outline(track.round_face, programme), "pitch curve (centre of the follower's face)")
    if bore:
        yield Shape("hole", circle((0, 0), bore / 2))
    yield from trimmed_shapes(track, profile, Cycle(programme.function))


def groove_wall_shapes(track: CamTrack, profile: FinishedProfile, cycle: Cycle, disc_radius: float) -> Iterator[Shape]:
    """The outer wall of a groove, the disc that it is cut into, and what was trimmed away."""
    yield Shape("profile", profile.outline)
    yield Shape("body", circle((0, 0), disc_radius))
    yield from trimmed_shapes(track, profile, cycle)


def trimmed_shapes(track: CamTrack, profile: FinishedProfile, cycle: Cycle) -> Iterator[Shape]:
    """The stretches of the profile that an undercut has removed."""
    for start, stop in profile.trimmed.removed if profile.trimmed else ():
        angle = np.linspace(start, stop, 33)
        point = track.contact(*cycle.at_angle(angle)).point.d0
        yield Shape("defect", polygon(np.stack([point.real, point.imag], axis=1), closed=False))


def groove_disc_radius(wall_profile: FinishedProfile, wall: float) -> float:
    """Radius [m] of the disc that a groove is cut into, by the profile of its outer wall and the least wall [m] around it."""
    return float(_radii(wall_profile).max()) + wall


def cam_solids(
    profile: FinishedProfile, width: float, z: float, bore: float | None = None, hub: tuple[float, float, float] | None = None
) -> Iterator[Prism]:
    """A cam of a width from height z with its bore (diameter), and its hub (diameter, height of its lower end, length); all [m]."""
    hole = (circle((0, 0), bore / 2),) if bore else ()
    yield Prism(profile.outline, hole, z, width)
    if hub:
        diameter, start, length = hub
        yield Prism(circle((0, 0), diameter / 2), hole, start, length)


def groove_solids(
    wall_profile: FinishedProfile, disc_radius: float, width: float, z: float, bore: float | None = None
) -> tuple[Prism, Prism]:
    """The disc under a groove, as thick as the groove is deep, and the ring around it; width, height z and bore [m]."""
    disc = circle((0, 0), disc_radius)
    hole = (circle((0, 0), bore / 2),) if bore else ()
    return Prism(disc, hole, z - width, width), Prism(disc, (wall_profile.outline,), z, width)


def _radii(profile):
    return np.hypot(*profile.outline.points(TOLERANCE).T)
