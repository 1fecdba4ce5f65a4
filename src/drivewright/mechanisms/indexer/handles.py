"""Sizes of an indexing drive that a hand can move on the drawing: pins and their circle, eccentricity, distances of the axes."""

from collections.abc import Iterator

import numpy as np

from drivewright.indexing.pin_wheel import PinWheel
from drivewright.indexing.plate_views import PlateDrive
from drivewright.indexing.roller_gear.design import RollerGear
from drivewright.indexing.roller_gear.views import developed_height, developed_roller_centres, roller_angles
from drivewright.scene import Handle, xy


def plate_handles(plates: PlateDrive) -> Iterator[Handle]:
    """Handles of a drive with plate cams."""
    drive = plates.drive
    level = drive.levels[0]
    outwards = complex(np.exp(1j * level.phase))
    centre = level.circle_radius * outwards
    yield Handle("pin_circle_radius", xy(centre), xy(outwards), "wheel")
    yield Handle("pin_radius", xy(centre + 1j * level.pin_radius * outwards), xy(1j * outwards), "wheel")
    if not isinstance(drive, PinWheel):
        yield Handle("centre_distance", (drive.centre_distance, 0.0), (1.0, 0.0))
    elif plates.holes:
        yield Handle("eccentricity", (drive.eccentricity, 0.0), (1.0, 0.0), "crank1")
        yield Handle("shaft_spacing", (plates.holes.spacing / 2, 0.0), (0.5, 0.0))


def roller_gear_handles(cam: RollerGear, distance_given: bool) -> Iterator[Handle]:
    """Handles of a cam that is shown unrolled: where its outermost roller stands at the start, at its middle roller, and at its end.

    distance_given: whether the spec gives the distance of the axes, which otherwise follows from the circle of the rollers.
    """
    angles, places = roller_angles(cam, 0.0), developed_roller_centres(cam, 0.0)[:, 0]
    outer, middle = int(np.argmax(np.abs(angles))), int(np.argmin(np.abs(angles)))
    barrel, angle = cam.kind == "barrel", float(angles[outer])
    across = cam.hand_sign * (np.cos(angle) - (0.0 if distance_given else 1.0)) if barrel else 0.0
    yield Handle("pin_circle_radius", _point(places[outer]), (float(across), float(np.sin(angle)) if barrel else angle))
    yield Handle("pin_radius", (cam.roller_radius, 0.0), (1.0, 0.0), f"roller{cam.rollers[outer]}")
    if barrel and distance_given:
        yield Handle("centre_distance", _point(places[middle]), (-cam.hand_sign, 0.0))
    half = cam.cam_length / 2
    tall = 1.0 if barrel else 1 / np.sqrt(1 - (half / cam.pin_circle_radius) ** 2)
    yield Handle("cam_length", (0.0, float(developed_height(cam, half))), (0.0, 0.5 * float(tall)))


def _point(place):
    return float(place[0]), float(place[1])
