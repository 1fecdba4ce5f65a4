"""The involute tooth that a plate sits on, by its support.

A plate stands astride of a tooth; its right flank, with the normal n = (cos a, -sin a), faces the next tooth clockwise.  The support
of an involute is linear in the angle of its normal: turned by d against its seat, the plate finds the tooth at H + rb d.
"""

from typing import NamedTuple

import numpy as np

from drivewright._typing import Numbers


class Tooth(NamedTuple):
    """teeth z; base radius rb [m]; support H [m].

    H, below 0, is the signed distance from the centre to the flank along the normal of a seated plate.
    A tooth thicker by d on each flank has H - d.
    """

    teeth: int
    base_radius: float
    support: float

    @property
    def contact_radius(self) -> float:
        """Radius where the seated plate touches: sqrt(H^2 + rb^2)  [m]."""
        return np.hypot(self.support, self.base_radius)

    @property
    def curvature_radius(self) -> Numbers:
        """Radius of curvature of the flank there, |H|  [m]."""
        return abs(self.support)


class Cutter(NamedTuple):
    """Hob or rack cutter: pitch p2 [m] and half tooth angle a2 [rad]."""

    pitch: float
    half_angle: float

    @property
    def module(self) -> float:
        """m2 = p2/pi  [m]."""
        return self.pitch / np.pi


def matching_cutter(pitch: Numbers, flank_angle: Numbers, half_angle: float) -> Cutter:
    """The cutter with the base pitch of the chain  (8): p2 = p cos a/cos a2."""
    return Cutter(pitch * np.cos(flank_angle) / np.cos(half_angle), half_angle)


def cut_tooth(teeth: int, cutter: Cutter, modification: Numbers, flank_angle: float) -> Tooth:
    """The `Tooth` that a cutter shifted by `modification` x (in its modules) generates, its support at the flank angle a.

    The cutter's flank through (3/4 p2, z m2/2 + x m2) has the support (3/4) p2 cos a2 - (z/2 + x) m2 sin a2 at a2, and
    H(a) = H(a2) - rb (a - a2).
    """
    base = 0.5 * cutter.module * teeth * np.cos(cutter.half_angle)
    at_cutter = 0.75 * cutter.pitch * np.cos(cutter.half_angle) - (teeth / 2 + modification) * cutter.module * np.sin(cutter.half_angle)
    return Tooth(teeth, base, at_cutter - base * (flank_angle - cutter.half_angle))


def modification_for(teeth: int, cutter: Cutter, support: float, flank_angle: float) -> float:
    """The shift x with which a cutter leaves the support H at the flank angle: the inverse of `cut_tooth`."""
    base = 0.5 * cutter.module * teeth * np.cos(cutter.half_angle)
    at_cutter = support + base * (flank_angle - cutter.half_angle)
    return (0.75 * cutter.pitch * np.cos(cutter.half_angle) - at_cutter) / (cutter.module * np.sin(cutter.half_angle)) - teeth / 2


def base_half_angle(tooth: Tooth, flank_angle: float) -> float:
    """Half the angle that a tooth fills on its base circle [rad], (pi/2 + 2 x tan a2)/z + tan a2 - a2 for a cutter.

    The next flank touches at H n - rb dn/da; where H(a0) = 0 the involute begins, at a0 = a + H/rb clockwise of the plate's centre line.
    """
    return 2 * np.pi / tooth.teeth - (flank_angle + tooth.support / tooth.base_radius)
