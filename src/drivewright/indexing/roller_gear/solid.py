"""Solids of a roller-gear drive for CAD: the cam with its grooves, the turret with its rollers."""

import numpy as np

from drivewright.errors import InputError
from drivewright.indexing.motion import TURN
from drivewright.indexing.roller_gear.envelope import contact
from drivewright.indexing.roller_gear.flanks import FLANKS, flanks
from drivewright.indexing.roller_gear.views import deep, groove_range, shallow
from drivewright.scene import Arc, Bar, Grooved, Line, Outline, Part, Prism, circle, polygon

STEP = np.radians(4.0)  # of the cam, between rows of points of a wall
DEPTHS = 7


def cam_part(cam, bore=0.0, name="cam"):
    """Part of the finished cam at theta = 0 in the frame of the drive: the turned blank, bored along its axis, less the groove.

    Raises InputError where undercut eats into the flanks, for the walls of the groove would cross, and for a bore that meets the groove.
    """
    lost = flanks(cam).undercut
    if lost > 0:
        raise InputError(
            f"{cam.kind} cam: {100 * lost:.3g} % of its flanks are lost to undercut, so no clean groove can be modelled. "
            "Take thinner rollers, a larger cam or a longer motion."
        )
    floor = cam.pitch_radius - deep(cam)
    if not 0 <= bore / 2 < floor:
        raise InputError(
            f"{cam.kind} cam: a bore of {1e3 * bore:g} mm; it must be from 0 to below {2e3 * floor:.4g} mm, the floor of the groove."
        )
    walls = groove(cam)
    local = np.stack([walls[..., 1], -walls[..., 0], walls[..., 2]], axis=-1)  # the axis of a turned part is its x direction
    body = Grooved((0.0, 0.0), cam.height, _section(cam, bore), (local,))
    return Part(name, (body,), (cam.centre_distance, 0.0, np.pi / 2))


def groove(cam):
    """Points (2, n, m, 3) [m], in the cam's frame, of both walls of the one groove that all rollers share, floor and mouth included."""
    travel = _rows(cam)
    u = np.linspace(shallow(cam), deep(cam), DEPTHS)
    touching = contact(cam, travel[None, :, None], u, FLANKS[:, None, None])
    if np.any(touching.opening <= 0):
        raise InputError(
            f"{cam.kind} cam: the walls of the groove fold up outside the rollers' length, at the travel "
            f"{np.degrees(travel[np.nonzero(touching.opening <= 0)[1][0]]):.1f} deg; no clean groove can be modelled. "
            "Take thinner rollers or a larger cam."
        )
    return touching.point


def turret_part(cam, name="turret"):
    """Part of the turret at phi = 0: a disc and all rollers, each of its full length, at their places in the dwell before theta = 0."""
    psi = cam.motion.pitch * (cam.phase + np.arange(cam.motion.divisions))
    half, radius = cam.roller_length / 2, cam.pin_circle_radius
    if cam.kind == "globoidal":
        rim = radius - half - cam.roller_radius / 10
        disc = Prism(circle((0.0, 0.0), rim), (), -1.2 * cam.roller_radius, 2.4 * cam.roller_radius)
        ends = [tuple(float(r * part) for part in (np.cos(a), np.sin(a))) for a in psi for r in (0.9 * rim, radius + half)]
        rollers = tuple(Bar(a, b, 0.0, 2 * cam.roller_radius) for a, b in zip(ends[::2], ends[1::2], strict=True))
        return Part(name, (disc, *rollers), colour="blue")
    gap, thick = cam.roller_radius / 10, cam.roller_radius
    disc = Prism(circle((0.0, 0.0), radius + 1.5 * cam.roller_radius), (), -half - gap - thick, thick)
    spots = [(float(radius * np.cos(a)), float(radius * np.sin(a))) for a in psi]
    rollers = tuple(Prism(circle(spot, cam.roller_radius), (), -half - gap - thick / 2, 2 * half + gap + thick / 2) for spot in spots)
    return Part(name, (disc, *rollers), colour="blue")


def _rows(cam):
    """Travel of the rows of a wall: evenly in every stretch of the motion, from where the roller enters the blank to where it leaves."""
    start, stop = groove_range(cam)
    foot = cam.pin_circle_radius - cam.cosine * cam.roller_length / 2
    reach = cam.cam_length / 2 + 1.3 * cam.roller_radius
    rows = [
        turn + np.linspace(s.start, s.stop, 2 + int((s.stop - s.start) / STEP))[:-1]
        for turn in np.arange(start, stop - 1e-9, TURN)
        for s in cam.motion.stretches
    ]
    travel = np.append(np.concatenate(rows), stop)
    psi = cam.motion(travel).d0 + cam.motion.pitch * cam.phase
    return travel[np.abs(foot * np.sin(psi)) < reach]


def _section(cam, bore):
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
