"""Roller-gear indexers: a turret with cylindrical rollers and a cam whose ribs run between them; one index pitch per turn of the cam.

Frames.  The turret turns by phi about z; its roller k = 0, 1 ... has the middle of its axis on a circle of radius R in the plane z = 0 at
the angle psi_k = phi + p (phase + k), p = 2 pi/N the angle between neighbours of N rollers.  Axis of roller k in the turret's own frame,
turned by psi_k:
    c(u) = (R + u cos b, 0, u sin b),   |u| <= roller_length/2,   b = inclination.
The cam turns by hand_sign theta about the axis through A = (C, 0, h) in the direction y; its own frame has its origin in A and y along
its axis.  Globoidal: b = 0 (radial rollers), h = 0.  Barrel: b = 90 deg (rollers parallel to the turret's axis), h = cam_radius.
C is in both cases the shortest distance between the two axes.  The cam is `right` handed where a groove that moves on in +y winds
counter-clockwise about +y.

A step of the turret, 2 pi/S, S stations, passes m = N/S rollers, and so the cam has m starts: grooves that wind side by side.  All rollers
of one start cut the same groove one turn apart, so the cam is described by the rollers k = 0 .. m - 1 over an angle `travel` t that runs on
through several turns: roller k = m q + j at the cam angle theta is roller j at t = theta + 2 pi q.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import NoReturn

import numpy as np

from drivewright._typing import ArrayLike, Floats
from drivewright.errors import InputError
from drivewright.indexing.motion import TURN, IndexMotion, refuse_stations

MM = 1e3


@dataclass(frozen=True, eq=False)
class RollerGear:
    """A roller-gear cam and its turret; make one with `barrel` or `globoidal`.  Lengths in metres, angles in radians.

    cosine, sine: of the inclination of the roller axes against the turret's plane; height h of the cam's axis above that plane;
    hand_sign: sense of the cam about y; phase: place of the rollers in the dwell before theta = 0, in pitches of the rollers (0.5: a rib in
    the middle); pins: number of rollers, a multiple of the motion's divisions.
    """

    kind: str
    motion: IndexMotion
    pin_circle_radius: float
    roller_radius: float
    roller_length: float
    centre_distance: float
    height: float
    cam_length: float
    cosine: float
    sine: float
    hand_sign: float
    phase: float
    pins: int

    @property
    def pin_pitch(self) -> float:
        """Angle between neighbouring rollers [rad]."""
        return TURN / self.pins

    @property
    def starts(self) -> int:
        """Grooves that wind side by side: rollers that pass the cam in a step."""
        return self.pins // self.motion.divisions

    @property
    def pitch_radius(self) -> float:
        """Least distance of the circle of the rollers' middles from the cam's axis [m]."""
        return self.centre_distance - self.pin_circle_radius if self.kind == "globoidal" else self.height

    @cached_property
    def rollers(self) -> tuple[int, ...]:
        """Numbers k of the rollers that meet the cam at some angle of its turn, in the order of psi."""
        radius = self.pin_circle_radius - self.cosine * self.roller_length / 2
        reach = (self.cam_length / 2 + self.roller_radius) / radius
        most = np.arcsin(reach) if reach < 1 else np.pi / 2
        low = np.floor((-most / self.pin_pitch) - self.phase - self.starts) + 1
        high = np.ceil(most / self.pin_pitch - self.phase) - 1
        return tuple(range(int(low), int(high) + 1))

    def in_blank(self, points: Floats) -> Floats:
        """How far [m] points (..., 3) in the cam's frame lie inside the turned blank: above 0 inside.

        Ends at |y| = cam_length/2.  Outside of a barrel: a cylinder through the feet of the rollers; of a globoidal cam: a circle about the
        turret's axis through the feet, turned about the cam's axis.
        """
        axial = points[..., 1]
        away = np.hypot(points[..., 0], points[..., 2])
        return np.minimum(self.cam_length / 2 - np.abs(axial), self._below_top(axial, away))

    def _below_top(self, axial, away):
        half = self.roller_length / 2
        if self.kind == "barrel":
            return self.height + half - away
        return np.hypot(self.centre_distance - away, axial) - (self.pin_circle_radius - half)


def globoidal(
    motion: IndexMotion,
    pin_circle_radius: float,
    roller_radius: float,
    roller_length: float,
    centre_distance: float,
    cam_length: float,
    hand: str = "right",
    phase: float = 0.5,
    pins: int | None = None,
) -> RollerGear:
    """Hour-glass cam whose rollers stand radially on the turret; pin_circle_radius: of the middles of the rollers.

    pins: number of rollers, as many as the motion has divisions where not given.  Raises InputError where rollers overlap, reach the
    turret's centre or the cam's axis, or the cam is too short or too long.
    """
    sizes = pin_circle_radius, roller_radius, roller_length, centre_distance, 0.0, cam_length
    cam = RollerGear("globoidal", motion, *sizes, 1.0, 0.0, _sign(hand), phase, motion.divisions if pins is None else pins)
    _check_common(cam)
    foot, tip = pin_circle_radius - roller_length / 2, pin_circle_radius + roller_length / 2
    if foot <= 0:
        _refuse(
            cam,
            f"rollers of length {MM * roller_length:g} mm on a circle of {MM * pin_circle_radius:g} mm reach the turret's axis. "
            f"Keep roller_length below {MM * 2 * pin_circle_radius:g} mm.",
        )
    _check_pitch(cam, foot, "at their inner ends")
    needed = np.hypot(tip, roller_radius)
    if centre_distance <= needed:
        _refuse(
            cam,
            f"with centre_distance = {MM * centre_distance:g} mm the rollers, which reach {MM * needed:.4g} mm from the turret's "
            f"axis, touch the cam's axis. Raise centre_distance above {MM * needed:.4g} mm or shorten the rollers.",
        )
    if cam_length / 2 >= foot:
        _refuse(
            cam,
            f"cam_length = {MM * cam_length:g} mm reaches beyond the circle of {MM * foot:g} mm radius through the feet of the "
            f"rollers, from which the hour-glass is turned. Keep it below {MM * 2 * foot:g} mm.",
        )
    _check_engaged(cam)
    return cam


def barrel(
    motion: IndexMotion,
    pin_circle_radius: float,
    roller_radius: float,
    roller_length: float,
    cam_radius: float,
    cam_length: float,
    centre_distance: float | None = None,
    hand: str = "right",
    phase: float = 0.5,
    pins: int | None = None,
) -> RollerGear:
    """Cylindrical cam whose rollers stand parallel to the turret's axis.

    cam_radius: distance of the cam's axis from the plane of the rollers' middles; centre_distance: shortest distance of the two axes,
    pin_circle_radius where not given; pins and errors as of `globoidal`.
    """
    distance = pin_circle_radius if centre_distance is None else centre_distance
    sizes = pin_circle_radius, roller_radius, roller_length, distance, cam_radius, cam_length
    cam = RollerGear("barrel", motion, *sizes, 0.0, 1.0, _sign(hand), phase, motion.divisions if pins is None else pins)
    _check_common(cam)
    _check_pitch(cam, pin_circle_radius, "on their circle")
    if cam_radius <= roller_length / 2:
        _refuse(
            cam,
            f"rollers of length {MM * roller_length:g} mm reach the axis of a cam of cam_radius = {MM * cam_radius:g} mm. "
            f"Raise cam_radius above {MM * roller_length / 2:g} mm.",
        )
    outer = cam_radius + roller_length / 2
    if abs(distance - pin_circle_radius) >= outer:
        _refuse(
            cam,
            f"the rollers' circle of {MM * pin_circle_radius:g} mm passes beside a cam of outer radius {MM * outer:g} mm at "
            f"centre_distance = {MM * distance:g} mm. Take centre_distance near the pin circle's radius.",
        )
    if cam_length / 2 + roller_radius >= pin_circle_radius:
        _refuse(
            cam,
            f"cam_length = {MM * cam_length:g} mm does not fit into the rollers' circle of {MM * pin_circle_radius:g} mm radius. "
            f"Keep it below {MM * 2 * (pin_circle_radius - roller_radius):g} mm.",
        )
    _check_engaged(cam)
    return cam


def _sign(hand: str) -> float:
    if hand not in ("right", "left"):
        raise InputError(f"roller-gear cam: hand = {hand!r}; it is 'right' or 'left'.")
    return -1.0 if hand == "right" else 1.0


def _refuse(cam: RollerGear, text: str) -> NoReturn:
    raise InputError(f"{cam.kind} cam: {text}")


def _check_common(cam):
    names = ("pin_circle_radius", "roller_radius", "roller_length", "centre_distance", "cam_length")
    for name, value in ((name, getattr(cam, name)) for name in names):
        if not (np.isfinite(value) and value > 0):
            _refuse(cam, f"{name} = {value} m; it must be positive and finite.")
    if cam.kind == "barrel" and not (np.isfinite(cam.height) and cam.height > 0):
        _refuse(cam, f"cam_radius = {cam.height} m; it must be positive and finite.")
    if not np.isfinite(cam.phase):
        _refuse(cam, f"phase = {cam.phase}; it must be a finite number of pitches.")
    if cam.pins < 3:
        _refuse(cam, f"{cam.pins} rollers; a turret needs at least 3.")
    refuse_stations(cam.pins, cam.motion.divisions)


def _check_pitch(cam, radius, where):
    room = radius * np.sin(np.pi / cam.pins)
    if cam.roller_radius >= room:
        _refuse(
            cam,
            f"rollers of radius {MM * cam.roller_radius:g} mm overlap {where}: half the pitch is {MM * room:.4g} mm there. "
            "Take thinner or fewer rollers, or a larger pin circle.",
        )


def _check_engaged(cam):
    """The cam is at least one pitch of the rollers long, or some angle would leave no roller in it."""
    least = 2 * cam.pin_circle_radius * np.sin(cam.pin_pitch / 2)
    if cam.cam_length < least:
        _refuse(
            cam,
            f"cam_length = {MM * cam.cam_length:g} mm is shorter than a pitch of {MM * least:.4g} mm, so that no roller would be "
            "held at some angles. Make the cam longer.",
        )


def roller_travel(cam: RollerGear, theta: ArrayLike, rollers: ArrayLike) -> tuple[Floats, Floats]:
    """(travel t (rollers, theta) [rad], start (rollers, 1)) of the rollers k at the cam angles theta (theta,) [rad]."""
    turns, start = np.divmod(np.asarray(rollers, dtype=float)[:, None], cam.starts)
    return np.asarray(theta, dtype=float) + TURN * turns, start
