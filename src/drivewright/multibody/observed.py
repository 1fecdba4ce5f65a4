"""What is observed of a moving system: arrays over times, by body, by pin with play, by drive."""

from typing import NamedTuple

from drivewright._typing import Floats

FIELDS = ("x", "y", "angle", "vx", "vy", "w", "ax", "ay", "alpha", "fx", "fy", "torque")
PIN_FIELDS = ("depth", "normal", "friction", "slip", "nx", "ny", "fx", "fy")
POWER_FIELDS = ("springs", "applied", "pins", "drives")


class Observed(NamedTuple):
    """Arrays over the times t (m,).

    bodies (m, bodies, FIELDS): centroid, rates, accelerations, and the force and torque of all elements on the body, gravity left out;
    pins (m, pins with play, PIN_FIELDS): depth below 0 in flight, n from the journal to the bearing's centre, force on the bearing;
    powers (m, POWER_FIELDS) that the elements give to the bodies [W]; drives (m, drives): torque or force of each drive.
    """

    t: Floats
    bodies: Floats
    pins: Floats
    powers: Floats
    drives: Floats

    def body(self, number: int | slice, field: str) -> Floats:
        """One of FIELDS of a body (m,)."""
        return self.bodies[:, number, FIELDS.index(field)]

    def pin(self, number: int, field: str) -> Floats:
        """One of PIN_FIELDS of a pin with play (m,)."""
        return self.pins[:, number, PIN_FIELDS.index(field)]
