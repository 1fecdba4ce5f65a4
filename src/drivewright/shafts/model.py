"""A shaft on its supports as plain data, independent of any solver.

z runs along the axis from the left end, y is up, x completes the right-handed frame.  Six displacements a place: x, y, z and the
rotations about x, y, z; all lengths in metres.
"""

from typing import NamedTuple, TypeAlias

import numpy as np

from drivewright._typing import Floats

COWPER, EULER_BERNOULLI = 0.0, -1.0  # special values of the shear coefficient
RIGID = (np.inf,) * 5
PlaneMatrix: TypeAlias = tuple[tuple[float, float], tuple[float, float]]  # ((xx, xy), (yx, yy)): the force along the first of the second
NOTHING: PlaneMatrix = ((0.0, 0.0), (0.0, 0.0))


class Section(NamedTuple):
    """A piece of shaft: length, outer diameter at either end, bore."""

    length: float
    start: float
    end: float
    bore: float = 0.0


class Support(NamedTuple):
    """What carries the shaft at a place.

    Five stiffnesses (x, y, z, tilt_x, tilt_y; inf is rigid, 0 is free) and beside them a `law`, a NamedTuple with a formula under
    `bearings.response`.  `mirrored`: the law's own axis points to the left.  `offset` (5,): where the seat stands, of a law in the
    law's own axes.  `seat` (5,): stiffness of the seat under the law, in series (inf is none, 0 slides freely), with the forces
    `push` (5,) on the ring that sits there.  The reaction is spread evenly over `width`.  `coupling` [N/m] between x
    and y acts beside the springs and `damping` [N s/m] beside springs and law, both between the shaft and the ring.
    """

    name: str
    position: float
    stiffness: tuple[float, ...] = (0.0, 0.0, 0.0, 0.0, 0.0)
    law: object = None
    mirrored: bool = False
    offset: tuple[float, ...] = (0.0, 0.0, 0.0, 0.0, 0.0)
    seat: tuple[float, ...] = RIGID
    push: tuple[float, ...] = (0.0, 0.0, 0.0, 0.0, 0.0)
    width: float = 0.0
    coupling: PlaneMatrix = NOTHING
    damping: PlaneMatrix = NOTHING


class Station(NamedTuple):
    """A place of interest, with what sits on it: mass [kg], moments of inertia about the axis and about a diameter [kg m^2]."""

    name: str
    position: float
    mass: float = 0.0
    polar: float = 0.0
    diametral: float = 0.0


class ShaftLoad(NamedTuple):
    """Force (x, y, z) [N] and moment (x, y, z) [N m] on the shaft at a place."""

    position: float
    force: tuple[float, ...] = (0.0, 0.0, 0.0)
    moment: tuple[float, ...] = (0.0, 0.0, 0.0)


class LineLoad(NamedTuple):
    """Force per length (x, y) [N/m] between two places, linear from one to the other."""

    start: float
    end: float
    first: tuple[float, ...]
    last: tuple[float, ...]


class Shaft(NamedTuple):
    """Sections from left to right, one material, supports and stations in any order; `carried` are masses that are no stations.

    `shear`: kappa, COWPER or EULER_BERNOULLI; `rotary_inertia`: whether the sections resist being turned (None: where they also shear,
    Timoshenko's beam; without shear Rayleigh's).
    """

    sections: tuple[Section, ...]
    modulus: float
    poisson: float
    density: float
    supports: tuple[Support, ...]
    stations: tuple[Station, ...] = ()
    shear: float = COWPER
    rotary_inertia: bool | None = None
    carried: tuple[Station, ...] = ()

    @property
    def masses(self) -> tuple[Station, ...]:
        """Everything that sits on the shaft: its stations, and what is carried besides."""
        return (*self.stations, *self.carried)

    @property
    def length(self) -> float:
        """Length [m]."""
        return float(sum(section.length for section in self.sections))

    @property
    def has_rotary_inertia(self) -> bool:
        """Whether the sections of the shaft resist being turned."""
        return self.shear != EULER_BERNOULLI if self.rotary_inertia is None else self.rotary_inertia

    @property
    def ends(self) -> Floats:
        """Places (sections + 1,) [m] of the ends of the sections, from 0."""
        return np.concatenate([[0.0], np.cumsum([section.length for section in self.sections])])
