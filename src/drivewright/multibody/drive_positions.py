"""Where the drives of a mechanism stand, in words."""

import numpy as np

from drivewright.multibody.assembly import Assembly
from drivewright.multibody.system import System, Work


def drive_positions(assembly: Assembly, system: System, work: Work) -> list[str]:
    """ "'JOINT' at 37.25 deg" of every drive, or mm of what slides, at the coordinates in `work`."""
    positions = []
    for drive, driven in zip(assembly.model.drives, system.driven, strict=True):
        value = driven.sign * work.coordinates.q[driven.coordinate]
        turning = any(link.turn == driven.coordinate for link in assembly.tree.links)
        positions.append(f"{drive.joint!r} at {np.degrees(value) % 360:.2f} deg" if turning else f"{drive.joint!r} at {1e3 * value:.4g} mm")
    return positions
