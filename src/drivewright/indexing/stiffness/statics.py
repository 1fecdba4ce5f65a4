"""Bearing loads of a two-cam indexer by statics alone: equations (7) to (12) of Liu Mingtao et al. 2017, as printed and corrected.

Forces are complex x + i y, x along the line through the two split shafts.  Cams: the first with its centre at O_b, the second at -O_b.
Printed in error: (8) has F_y for F_x in the first bearing's moment and leaves out the couple, which is the output torque itself; (10)
leaves out the x-forces; (11) the gear's separating force and, in its first line, the sign; (12) has b1 for b2 in its first line.
That x-forces are shared equally is an assumption, true for bearings alike stiff; nothing else is left open by statics.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from drivewright._typing import ArrayLike, Complexes, Floats
from drivewright.indexing.contacts import CamContacts
from drivewright.indexing.drivetrain import SIDES
from drivewright.indexing.stiffness.assembly import cam_phases
from drivewright.indexing.stiffness.result import TorsionalStiffness


class ShaftLengths(NamedTuple):
    """Along a split shaft [m]: gear to front support (a), to the first cam (b1), to the second cam (c), to the rear support (b2)."""

    a: float
    b1: float
    c: float
    b2: float

    @property
    def span(self) -> float:
        """L = b1 + c + b2."""
        return self.b1 + self.c + self.b2


def cam_centre(eccentricity: float, theta: ArrayLike) -> Complexes:
    """(7): O_b = e exp(i theta)."""
    return np.asarray(eccentricity * np.exp(1j * np.asarray(theta, dtype=float)), dtype=np.complex128)


def pin_resultants(result: TorsionalStiffness, contacts: Sequence[CamContacts]) -> tuple[Complexes, Floats]:
    """(force (p, cams) complex, moment about the wheel's axis (p, cams)) of the pins on every cam of a `TorsionalStiffness`."""
    forces, moments = [], []
    for pressed, each in zip(result.pin_forces, contacts, strict=True):
        forces.append(-(pressed @ each.normal) * cam_phases(len(pressed)))
        moments.append(-(pressed @ each.arm))
    return np.array(forces), np.array(moments)


def crank_loads(force: Complexes, moment: Floats, centre: Complexes, spacing: float) -> tuple[Complexes, Complexes]:
    """(8) corrected: forces of the two bearings, at centre -+ spacing/2, on a cam under a force and a moment about the wheel's axis.

    R1x = R2x = -Fx/2,  R1y = -(1/2 + xb/l) Fy + yb/l Fx + M/l,  R2y = (xb/l - 1/2) Fy - yb/l Fx - M/l.
    """
    couple = (centre.real * force.imag - centre.imag * force.real - moment) / spacing
    return -0.5 * force - 1j * couple, -0.5 * force + 1j * couple


def crank_loads_printed(force: Complexes, centre: Complexes, spacing: float) -> tuple[Complexes, Complexes]:
    """(8) as printed: R1y = -(1/2 + xb/l) Fy - yb/l Fy,  R2y = (xb/l - 1/2) Fy + yb/l Fx, without the moment."""
    x, y = centre.real / spacing, centre.imag / spacing
    first = -(0.5 + x) * force.imag - y * force.imag
    second = (x - 0.5) * force.imag + y * force.real
    return -0.5 * force.real + 1j * first, -0.5 * force.real + 1j * second


def gear_force(
    first: Complexes, second: Complexes, centre: Complexes, pitch_radius: float, pressure_angle: float = 0.0, side: int = 0
) -> Complexes:
    """(10) corrected: force on the gear of a split shaft whose crank pins carry `first` and `second`, by one flank.

    Along y F_H m z/2 = -+[xb (F1y - F2y) - yb (F1x - F2x)], minus on side 0, the shaft at -spacing/2; outwards |F_H| tan(pressure angle).
    """
    torque = np.imag(np.conj(centre) * (first - second))
    around = SIDES[side] * torque / pitch_radius
    return 1j * around + SIDES[side] * np.abs(around) * np.tan(pressure_angle)


def gear_force_printed(first: Complexes, second: Complexes, centre: Complexes, pitch_radius: float) -> Floats:
    """(10) as printed: F_H = -2 (F1y xb - F2y xb)/(m z), along y, of the shaft at -spacing/2."""
    return -centre.real * (first.imag - second.imag) / pitch_radius


def support_loads(first: Complexes, second: Complexes, gear: Complexes, lengths: ShaftLengths) -> tuple[Complexes, Complexes]:
    """(11), (12) corrected: forces of the front and the rear support on a split shaft under `first`, `second` and the force on its gear.

    Rq = -[F1 (b2 + c) + F2 b2 + H (a + L)]/L,  Rh = -[F1 b1 + F2 (b1 + c) - H a]/L.
    """
    a, b1, c, b2 = lengths
    front = -(first * (b2 + c) + second * b2 + gear * (a + lengths.span)) / lengths.span
    rear = -(first * b1 + second * (b1 + c) - gear * a) / lengths.span
    return front, rear


def support_loads_printed(first: Complexes, second: Complexes, gear: Floats, lengths: ShaftLengths) -> tuple[Complexes, Complexes]:
    """(11), (12) as printed, `gear` the F_H of (10); the rear support as corrected, the front one

    R1qx = [F1x (b2 + c) + F2x b2]/L,  R1qy = [-F1y (b1 + c) - F2y b1 - F_H (a + L)]/L.
    """
    a, b1, c, b2 = lengths
    across = first.real * (b2 + c) + second.real * b2
    upright = -first.imag * (b1 + c) - second.imag * b1 - gear * (a + lengths.span)
    rear = -(first * b1 + second * (b1 + c) - 1j * gear * a)
    return (across + 1j * upright) / lengths.span, rear / lengths.span


def crank_load_deviations(
    result: TorsionalStiffness, contacts: Sequence[CamContacts], eccentricity: float, spacing: float
) -> dict[str, float]:
    """{"corrected", "printed"}: largest difference of equations (8) from the equilibrium, along y, over its largest load [-].

    Of cam 0 at all positions that carry; {} where none does.
    """
    carried = result.carried
    if not carried.any():
        return {}
    force, moment = pin_resultants(result, contacts)
    centre = cam_centre(eccentricity, result.theta)
    routes = {
        "corrected": crank_loads(force[:, 0], moment[:, 0], centre, spacing),
        "printed": crank_loads_printed(force[:, 0], centre, spacing),
    }
    size = np.nanmax(np.abs(result.crank_forces))
    return {
        name: float(max(float(np.nanmax(np.abs((loads[s] + result.crank_forces[:, s, 0]).imag[carried]))) for s in range(2)) / size)
        for name, loads in routes.items()
    }


def equivalent_load(load: Floats, power: float) -> float:
    """Load of constant size with the same life, (mean F^p)^(1/p) [N], of loads (n,) [N] over a turn, first and last position being one."""
    carried = load[:-1][np.isfinite(load[:-1])]
    return float(np.mean(carried**power) ** (1 / power)) if len(carried) else 0.0
