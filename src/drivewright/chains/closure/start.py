"""Initial guess of the closure: a belt around the pitch circles, as long as the chain."""

import numpy as np

from drivewright._typing import Floats, Ints
from drivewright.chains.closure.loop import Layout
from drivewright.chains.closure.model import Drive
from drivewright.chains.link import seat_height, seat_shift
from drivewright.errors import DoesNotAssemble

_HALVINGS = 60


def layout_of(drive: Drive) -> tuple[Layout, Ints, Floats]:
    """The `Layout` of a drive, and seats and x to start from at the driver's angle 0; DoesNotAssemble where the chain is too short."""
    p = drive.link.pitch
    radii = [0.5 / np.sin(np.pi / teeth) for teeth in (drive.driver_teeth, drive.driven_teeth)]  # of the pitch circles, in pitches
    phi_1, phi_2 = 2 * np.pi / drive.driver_teeth, 2 * np.pi / drive.driven_teeth
    distance = _belt_distance(drive, *radii)
    rise = np.arcsin((radii[1] - radii[0]) / distance)
    tangent = 0.5 * np.pi + rise  # polar angle where the belt leaves the driver and meets the driven sprocket
    run = distance * np.cos(rise)
    psi_2, lead = _phase(run, tangent, phi_1, phi_2)
    off_1, on_1 = np.ceil(tangent / phi_1), np.floor((2 * np.pi - tangent) / phi_1)
    on_2, off_2 = np.floor((tangent - psi_2) / phi_2), np.ceil((-tangent - psi_2) / phi_2)
    seats = np.array([off_1, on_2, off_2, on_1]).astype(np.int64)
    link, both = drive.link, (drive.driver_teeth, drive.driven_teeth)
    height_1, height_2 = (seat_height(link, teeth) / p for teeth in both)
    shift_1, shift_2 = (seat_shift(link, teeth) / p for teeth in both)
    bent = drive.strands == "equilibrium"
    joint = link.hole_pitch / p, link.radius / p, link.skew / p
    layout = Layout(*joint, bent, phi_1, phi_2, height_1, height_2, shift_1, shift_2, drive.links, lead)
    return layout, seats, np.array([psi_2, distance, rise, -np.pi - rise])


def _phase(run, tangent, phi_1, phi_2):
    """Angle of the driven sprocket, within half a tooth of 0, and the number of plates from tooth 0 of the driver to its tooth 0."""
    ahead = run - tangent / phi_1 + tangent / phi_2  # pitches along the belt from polar angle 0 of the driver to that of the other
    lead = int(np.floor(ahead + 0.5))
    return phi_2 * (ahead - lead), lead


def _belt_distance(drive, r1, r2):
    """Centre distance [pitches] at which the chain, taken as a belt, encloses circles of radius r1 and r2."""
    teeth = drive.driver_teeth, drive.driven_teeth
    low, high = abs(r2 - r1), 0.5 * drive.links
    if not _belt_length(low, r1, r2, *teeth) < drive.links:
        raise DoesNotAssemble(
            f"chain: {drive.links} links do not reach around the sprocket with {max(teeth)} teeth and the other one. "
            f"Take at least {int(np.ceil(_belt_length(r1 + r2, r1, r2, *teeth)))}, with which the pitch circles do not overlap."
        )
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if _belt_length(middle, r1, r2, *teeth) < drive.links else (low, middle)
    return 0.5 * (low + high)


def _belt_length(distance, r1, r2, z1, z2):
    """Number of links of a belt: 2 C cos g + (z1 + z2)/2 + (z2 - z1) g/pi, sin g = (r2 - r1)/C."""
    rise = np.arcsin((r2 - r1) / distance) if r1 != r2 else 0.0
    return 2 * distance * np.cos(rise) + 0.5 * (z1 + z2) + rise * (z2 - z1) / np.pi
