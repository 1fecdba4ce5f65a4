"""Contacts between one cam and the pins of the wheel at one position."""

from typing import NamedTuple

from drivewright._typing import Bools, Complexes, Floats, Ints


class CamContacts(NamedTuple):
    """Contacts and near contacts of ONE cam with the wheel's pins at one input angle; arrays over the contacts.

    pin: number of the pin; centre: of the pin, complex x + i y [m] from the wheel's axis, not turning; normal: unit complex, direction of
    the force that the cam exerts on the pin; arm [m] = Im(conj(centre) normal): a force F turns the wheel with F arm, forward (+phi)
    where positive; gap [m]: free distance along the normal, 0 where pin and cam touch; curvature [1/m] of the cam there, positive
    where it is convex; intended: True where the point is the envelope's own contact of this position and lies on the trimmed profile.
    Cam j of n is cam 0 and all its contacts turned by 2 pi j/n about the wheel's axis.
    """

    pin: Ints
    centre: Complexes
    normal: Complexes
    arm: Floats
    gap: Floats
    curvature: Floats
    intended: Bools

    def of(self, chosen: slice | Ints | Bools) -> "CamContacts":
        """Some of the contacts."""
        return CamContacts(
            self.pin[chosen],
            self.centre[chosen],
            self.normal[chosen],
            self.arm[chosen],
            self.gap[chosen],
            self.curvature[chosen],
            self.intended[chosen],
        )
