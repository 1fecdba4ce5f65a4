"""Positions of the drives of a mechanism as text."""

import numpy as np

from drivewright.multibody.assembly import Assembly
from drivewright.multibody.system import System, Work


def drive_positions(assembly: Assembly, system: System, work: Work) -> list[str]:
    """ "'JOINT' at 37.25 deg" of every drive, or mm of what slides, at the coordinates in `work`."""
    positions = []
    for drive, driven in zip(assembly.model.drives, system.driven, strict=True):
        value = driven.sign * work.coordinates.q[driven.coordinate]
        turning = any(link.turn == driven.coordinate for link in assembly.tree.links)
        angle, way = round(float(np.degrees(value)), 6) % 360, round(1e3 * float(value), 9) + 0.0  # no 360.00 deg, no -0 mm of rounding
        positions.append(f"{drive.joint!r} at {angle:.2f}°" if turning else f"{drive.joint!r} at {way:.4g} mm")
    return positions
