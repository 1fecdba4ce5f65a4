"""The oscillating follower in the frame of its cam: a roller on an arm whose pivot orbits the cam.

The pivot stands at polar angle p (a jet of the driving angle) and distance C from the cam's centre, the arm of length L makes
the angle psi (a jet) with the line from pivot to centre.  `side` = +1: the roller lies counter-clockwise of that line, -1: clockwise.

    centre of the roller   B = C e^{ip} (1 - (L/C) e^{-i side psi})

A cam that turns counter-clockwise by theta under a standing pivot has p = -theta, clockwise p = +theta.  A pivot carried round a
standing cam by an angle q from -y has p = q - pi/2; then B = -i C e^{iq} + i L e^{i(q - side psi)}.
"""

from typing import Any

import numpy as np

from drivewright._typing import Numbers
from drivewright.cams.refusals import first_refused
from drivewright.curves import derivative
from drivewright.errors import DoesNotAssemble
from drivewright.numerics.jets import Jet, atan, cos, exp, sin


def rest_angle(prime_radius: Numbers, pivot_distance: Numbers, arm_length: Numbers) -> Any:
    """psi0 = acos((C^2 + L^2 - R^2)/(2 C L)) [rad], at which the roller's centre is at the prime radius R from the cam's centre.

    Raises DoesNotAssemble unless |C - L| < R < C + L.
    """
    shortest, longest = abs(pivot_distance - arm_length), pivot_distance + arm_length
    reaches = np.less(shortest, prime_radius) & np.less(prime_radius, longest)
    if refused := first_refused(reaches, pivot_distance, arm_length, shortest, longest, prime_radius):
        pivot_distance, arm_length, shortest, longest, prime_radius = refused
        raise DoesNotAssemble(
            f"oscillating follower: with pivot_distance {1e3 * pivot_distance:.6g} mm and arm_length {1e3 * arm_length:.6g} mm the "
            f"roller reaches radii from {1e3 * shortest:.6g} to {1e3 * longest:.6g} mm; prime_radius {1e3 * prime_radius:.6g} mm is not "
            "between them. Change the prime radius, the arm or the pivot."
        )
    return np.arccos((pivot_distance**2 + arm_length**2 - prime_radius**2) / (2 * pivot_distance * arm_length))


def pitch_curve(pivot_angle: Jet, psi: Jet, pivot_distance: Numbers, arm_length: Numbers, side: int = 1) -> Jet:
    """Centre of the roller in the cam frame [m]: a complex jet of the driving angle, from the jets p and psi.  C, L may be arrays."""
    return (pivot_distance - arm_length * exp(-1j * side * psi)) * exp(1j * pivot_angle)


def pressure_angle(pivot_angle: Jet, psi: Jet, pivot_distance: Numbers, arm_length: Numbers, side: int = 1) -> Jet:
    """Angle between the common normal and the path of the roller's centre [rad], a jet with one valid derivative.

    tan(alpha) = o (L (1 - side g) - C cos psi)/(C sin psi),  g = dpsi/dp,  o = -side sign(dp): positive where it opposes a
    growing psi.  From the pole on the line of centres, through which the normal passes.
    """
    opposing = -side * np.sign(pivot_angle.d1)
    turn = derivative(psi) / derivative(pivot_angle)
    return atan(opposing * (arm_length * (1 - side * turn) - pivot_distance * cos(psi)) / (pivot_distance * sin(psi)))
