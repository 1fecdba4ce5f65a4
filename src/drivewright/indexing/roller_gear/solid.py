"""Solids of a roller-gear drive for CAD: the cam with its grooves, the turret with its rollers."""

import numpy as np

from drivewright._typing import Floats
from drivewright.errors import InputError
from drivewright.indexing.motion import TURN
from drivewright.indexing.roller_gear.design import RollerGear
from drivewright.indexing.roller_gear.envelope import flank_contact
from drivewright.indexing.roller_gear.flanks import FLANKS, compute_flanks
from drivewright.indexing.roller_gear.scenes import frame_angles
from drivewright.indexing.roller_gear.trimming import FRONT
from drivewright.indexing.roller_gear.views import groove_floor, groove_mouth, groove_travel_range
from drivewright.scene import Arc, Bar, Grooved, Line, Outline, Part, Prism, Turning, circle, polygon

STEP = np.radians(4.0)  # of the cam, between rows of points of a wall
DEPTHS = 7


def cam_part(cam: RollerGear, bore: float = 0.0, name: str = "cam") -> Part:
    """Part of the finished cam at theta = 0 in the frame of the drive: the turned blank, bored along its axis, less the groove.

    Raises InputError where undercut eats into the flanks, for the walls of the groove would cross, and for a bore that meets the groove.
    """
    lost = compute_flanks(cam).undercut
    if lost > 0:
        raise InputError(
            f"{cam.kind} cam: {100 * lost:.3g} % of its flanks are lost to undercut, so no clean groove can be modelled. "
            "Take thinner rollers, a larger cam or a longer motion angle."
        )
    floor = cam.pitch_radius - groove_floor(cam)
    if not 0 <= bore / 2 < floor:
        raise InputError(
            f"{cam.kind} cam: a bore of {1e3 * bore:g} mm; it must be from 0 to below {2e3 * floor:.4g} mm, the floor of the groove."
        )
    grooves = [groove_walls(cam, start) for start in range(cam.starts)]
    local = tuple(np.stack([walls[..., 1], -walls[..., 0], walls[..., 2]], axis=-1) for walls in grooves)  # a turned part's axis is along x
    body = Grooved((0.0, 0.0), cam.height, _section(cam, bore), local)
    return Part(name, (body,), (cam.centre_distance, 0.0, np.pi / 2), turning=cam_turning(cam))


def cam_turning(cam: RollerGear) -> Turning:
    """How the cam turns over the frames of `roller_gear_scene`: by hand_sign theta about its axis."""
    return Turning((cam.centre_distance, 0.0, cam.height), (0.0, 1.0, 0.0), cam.hand_sign * frame_angles())


def turret_turning(cam: RollerGear) -> Turning:
    """How the turret turns over the same frames: by phi about z."""
    return Turning((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), np.asarray(cam.motion(frame_angles()).d0, float))


def groove_walls(cam: RollerGear, start: int = 0) -> Floats:
    """Points (2, n, m, 3) [m], in the cam's frame, of both walls of the groove of a start, floor and mouth included."""
    travel = _rows(cam, start)
    u = np.linspace(groove_mouth(cam), groove_floor(cam), DEPTHS)
    contact = flank_contact(cam, travel[None, :, None], u, FLANKS[:, None, None], start)
    if np.any(contact.opening <= 0):
        raise InputError(
            f"{cam.kind} cam: the walls of the groove fold up outside the rollers' length, at the travel "
            f"{np.degrees(travel[np.nonzero(contact.opening <= 0)[1][0]]):.1f}°; no clean groove can be modelled. "
            "Take thinner rollers or a larger cam."
        )
    return contact.point


def turret_part(cam: RollerGear, name: str = "turret") -> Part:
    """Part of the turret at phi = 0: a disc and all rollers, each of its full length, at their places in the dwell before theta = 0."""
    psi = cam.pin_pitch * (cam.phase + np.arange(cam.pins))
    half, radius = cam.roller_length / 2, cam.pin_circle_radius
    if cam.kind == "globoidal":
        rim = radius - half - cam.roller_radius / 10
        disc = Prism(circle((0.0, 0.0), rim), (), -1.2 * cam.roller_radius, 2.4 * cam.roller_radius)
        rollers = tuple(Bar(_polar(0.9 * rim, a), _polar(radius + half, a), 0.0, 2 * cam.roller_radius) for a in psi)
        return Part(name, (disc, *rollers), colour="blue", turning=turret_turning(cam))
    gap, thick = cam.roller_radius / 10, cam.roller_radius
    disc = Prism(circle((0.0, 0.0), radius + 1.5 * cam.roller_radius), (), -half - gap - thick, thick)
    spots = [_polar(radius, a) for a in psi]
    rollers = tuple(Prism(circle(spot, cam.roller_radius), (), -half - gap - thick / 2, 2 * half + gap + thick / 2) for spot in spots)
    return Part(name, (disc, *rollers), colour="blue", turning=turret_turning(cam))


def _polar(radius: float, angle: float) -> tuple[float, float]:
    return float(radius * np.cos(angle)), float(radius * np.sin(angle))


def _rows(cam: RollerGear, roller: int) -> Floats:
    """Travel of the rows of a wall: evenly in every stretch of the motion, from where the roller enters the blank to where it leaves."""
    start, stop = groove_travel_range(cam)
    foot = cam.pin_circle_radius - cam.cosine * cam.roller_length / 2
    reach = cam.cam_length / 2 + 1.3 * cam.roller_radius
    rows = [
        turn + np.linspace(s.start, s.stop, 2 + int((s.stop - s.start) / STEP))[:-1]
        for turn in np.arange(start, stop - 1e-9, TURN)
        for s in cam.motion.segments
    ]
    travel = np.append(np.concatenate(rows), stop)
    psi = cam.motion(travel).d0 + cam.pin_pitch * (cam.phase + roller)
    return travel[(np.abs(foot * np.sin(psi)) < reach) & (np.abs(psi) < FRONT)]


def _section(cam: RollerGear, bore: float) -> Outline:
    """Half-section of the blank, along its axis and away from it."""
    end, low = cam.cam_length / 2, bore / 2
    if cam.kind == "barrel":
        top = cam.height + cam.roller_length / 2
        return polygon([(-end, low), (end, low), (end, top), (-end, top)])
    foot = cam.pin_circle_radius - cam.roller_length / 2
    side, centre = float(np.arcsin(end / foot)), cam.centre_distance
    top = centre - foot * np.cos(side)
    arc = Arc((0.0, centre), foot, -np.pi / 2 + side, -2 * side)
    return Outline((Line((-end, low), (end, low)), Line((end, low), (end, top)), arc, Line((-end, top), (-end, low))))
