"""Forces of a Geneva drive in rigid contact without clearance: pin, crank, bearing of the wheel.

The pin presses on the slot with N along +t, the way the wheel steps, on its forward side where N > 0, else on its other one; u points from
the wheel's axis to the pin.  By friction it drags the wheel along u with m|N| sign(v), v the speed of its surface over the side,
    v = rho' w + s r (w + phi'),    s = sign(N),
r the radius of the pin: the crank turns one way, the wheel the other.  A roller rolls; the friction in its journal, of radius j, acts like
m j/r at its rim.  The wheel with a bearing of the friction radius q and its coefficient k then has
    N (rho - m r sign(v)) - k q |F| = T0,    |F| = |N| sqrt(1 + m^2),    T0 = J phi'' + friction + process torque.
"""

from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.indexing.geneva.step import GenevaStep


class PinFriction(NamedTuple):
    """Friction of pin and bearing.

    coefficient m at the pin's surface, of a roller that of its journal times j/r; slip: what slides over what the surface moves, 1 or j/r;
    bearing: coefficient times radius of the wheel's bearing, k q [m].
    """

    coefficient: float = 0.0
    slip: float = 1.0
    bearing: float = 0.0


class PinForces(NamedTuple):
    """Over crank angles, (n,): normal force N [N], positive on the forward side; friction along u [N]; speed of the sliding surfaces [m/s];
    torque of the pin on the wheel, torque that the wheel's bearing takes, torque at the crank [N m]; power lost at the pin [W]."""

    normal: Floats
    tangential: Floats
    sliding: Floats
    wheel_torque: Floats
    bearing_torque: Floats
    crank_torque: Floats
    pin_loss: Floats

    @property
    def resultant(self) -> Floats:
        """Force on the pin, and on the wheel's bearing (n,) [N]."""
        return np.hypot(self.normal, self.tangential)


def pin_forces(
    step: GenevaStep, pin_radius: float, friction: PinFriction, theta: Floats, crank_speed: Floats, wheel_speed: Floats, torque: Floats
) -> PinForces:
    """`PinForces` at crank angles [rad] within the step, speeds of both [rad/s], and the torque T0 [N m] that moves the wheel."""
    rho, side = step.pin_distance(theta), np.where(torque < 0, -1.0, 1.0)
    surface = step.pin_travel_rate(theta) * crank_speed + side * pin_radius * (crank_speed + wheel_speed)
    drag = friction.coefficient * np.sign(surface)
    lever = rho - pin_radius * drag - side * friction.bearing * np.sqrt(1 + drag**2)
    normal = torque / lever
    tangential = drag * np.abs(normal)
    wheel = normal * (rho - pin_radius * drag)
    loss = np.abs(tangential * surface)
    crank = _crank_torque(step, pin_radius, theta, side, normal, tangential)
    return PinForces(normal, tangential, np.abs(surface) * friction.slip, wheel, wheel - torque, crank, loss)


def _crank_torque(step, pin_radius, theta, side, normal, tangential):
    """Moment about the crank's axis of what crank and pin exert on the wheel, at the point of contact."""
    pin = step.crank_radius * np.exp(1j * np.asarray(theta))
    outwards = (pin - step.centre_distance) / step.pin_distance(theta)
    forward = -1j * outwards  # the wheel steps clockwise
    force = normal * forward + tangential * outwards
    return np.imag(np.conj(pin + side * pin_radius * forward) * force)
