"""What is observed of a moving system: arrays over times, by body, by pin with play, by drive."""

from typing import NamedTuple

from drivewright._typing import Floats

FIELDS = ("x", "y", "angle", "vx", "vy", "w", "ax", "ay", "alpha", "fx", "fy", "torque")
PIN_FIELDS = ("depth", "normal", "friction", "slip", "nx", "ny", "fx", "fy", "drag", "spin")
POWER_FIELDS = ("springs", "applied", "pins", "friction", "drives")
FRICTION_FIELDS = ("rate", "force", "load", "share", "sliding", "normal", "tangential")


class Observed(NamedTuple):
    """Arrays over the times t (m,).

    bodies (m, bodies, FIELDS): centroid, rates, accelerations, and the force and torque of all elements on the body, gravity left out;
    pins (m, pins with play, PIN_FIELDS): depth below 0 in flight, n from the journal to the bearing's centre, force on the bearing, torque
    of an oil film on it, angular velocity of the journal against it;
    powers (m, POWER_FIELDS) that the elements give to the bodies [W], friction being that of ideal joints; drives (m, drives): torque or
    force of each drive; frictions (m, ideal joints with friction, FRICTION_FIELDS): rate of the joint, friction on its first body, that
    at the coefficient 1, share of the largest static one, -1, 1 where it slides, 0 where it sticks, and what it transmits: of a pin force
    x and y, of a slide normal force and twice the moment over the guide's length, of a wheel normal (above 0: pressed) and tangential
    force.
    """

    t: Floats
    bodies: Floats
    pins: Floats
    powers: Floats
    drives: Floats
    frictions: Floats

    def body(self, number: int | slice, field: str) -> Floats:
        """One of FIELDS of a body (m,)."""
        return self.bodies[:, number, FIELDS.index(field)]

    def pin(self, number: int, field: str) -> Floats:
        """One of PIN_FIELDS of a pin with play (m,)."""
        return self.pins[:, number, PIN_FIELDS.index(field)]

    def friction(self, number: int, field: str) -> Floats:
        """One of FRICTION_FIELDS of an ideal joint with friction (m,)."""
        return self.frictions[:, number, FRICTION_FIELDS.index(field)]
