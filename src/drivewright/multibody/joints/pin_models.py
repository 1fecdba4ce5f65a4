"""Models of the play of a pin: none, a massless link, a dry or a lubricated contact, a bushing."""

from dataclasses import dataclass
from typing import ClassVar, TypeAlias

from drivewright.multibody.forces.bushing import Bushing
from drivewright.multibody.forces.contact import Dry, Lubricated


@dataclass(frozen=True)
class Ideal:
    """No play."""


@dataclass(frozen=True)
class MasslessLink:
    """Continuous contact: the journal's centre is held at the distance of the clearance by a rigid link without mass."""

    clearance: float  # radial [m]
    damping: float = 0.0  # of the link's own rotation [N m s/rad]
    angle: float = 0.0  # start angle, from the centre of the first body's pin towards that of the second's [rad]

    noun: ClassVar[str] = "clearance"


Play: TypeAlias = MasslessLink | Dry | Lubricated | Bushing
PinModel: TypeAlias = Ideal | Play
