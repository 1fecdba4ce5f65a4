"""Vibration of a follower train as one mass on a damped spring that the cam moves at its foot.

    x'' + 2 zeta w (x' - y') + w^2 (x - y) = 0,    z = x - y:    z'' + 2 zeta w z' + w^2 z = -y''        (time derivatives)

y is the planned travel, x the travel of the mass, w the natural circular frequency, zeta the damping ratio.  The state (z, z') is
carried from step to step by its exact propagator; the forcing is integrated by Gauss's rule, so a jump of y'' at a joint of
two pieces is met exactly, and a jump of y' is an impulse.
"""

from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats, Ints, Numbers
from drivewright.cams.cycle import Cycle
from drivewright.curves import derivative
from drivewright.errors import InputError
from drivewright.numerics.jets import Jet
from drivewright.result import Column, Table

ORDER = 8
STIFFEST = 2e4  # natural frequency over speed
PHASE = 0.5  # natural phase [rad] of one step: Gauss's rule of order 8 is then exact to rounding


class Response(NamedTuple):
    """Angle [rad] and piece of the steps, and the error z = x - y [m] there with its time derivatives; joints stand twice."""

    angle: Floats
    piece: Ints
    error: Jet


def propagator(time: Numbers, frequency: float, damping: float) -> Floats:
    """Matrix (..., 2, 2) that carries (z, z') over a time without forcing; 0 <= damping < 1."""
    wd = frequency * np.sqrt(1 - damping**2)
    decay, c, s = np.exp(-damping * frequency * time), np.cos(wd * time), np.sin(wd * time) / wd
    zw = damping * frequency
    rows = [[c + zw * s, s], [-(frequency**2) * s, c - zw * s]]
    return np.moveaxis(decay * np.array(rows), (0, 1), (-2, -1))


def transient_response(cycle: Cycle, reach: float, speed: float, frequency: float, damping: float = 0.0) -> Response:
    """`Response` over one turn from rest at angle 0; frequency in rad/s, speed of the cam in rad/s."""
    _refuse(speed, frequency, damping)
    piece, angle = cycle.samples(min(np.radians(1.0), PHASE * speed / frequency))
    push, carry = _steps(cycle, piece, angle, reach, speed, frequency, damping)
    kicks = _impulses(cycle, reach, speed)
    states, state = np.empty((len(angle), 2)), np.zeros(2)
    for k in range(len(angle)):
        if k == 0 or piece[k] != piece[k - 1]:
            state = state - (0.0, kicks[piece[k]])
        else:
            state = carry[k - 1] @ state + push[k - 1]
        states[k] = state
    return _response(cycle, piece, angle, states.T, reach, speed, frequency, damping)


def periodic_response(cycle: Cycle, reach: float, speed: float, frequency: float, damping: float = 0.0) -> Response:
    """`Response` of the steady state, which repeats itself every turn.  Raises InputError at an undamped resonance."""
    angle, piece, rest = transient_response(cycle, reach, speed, frequency, damping)
    turn = np.eye(2) - propagator(2 * np.pi / speed, frequency, damping)
    if np.linalg.norm(turn * [[1.0, frequency], [1 / frequency, 1.0]], -2) < 1e-9:
        raise InputError(
            f"cam vibration: at damping_ratio {damping:.3g} the natural frequency is {frequency / speed:.6g} times the cam's "
            "speed: a resonance without a steady state. Give some damping or another speed."
        )
    start = np.linalg.solve(turn, [rest.d0[-1], rest.d1[-1]])
    # A free swing superposed on the motion from rest brings the end back to the start.
    free = propagator(angle / speed, frequency, damping) @ start
    return _response(cycle, piece, angle, free.T + (rest.d0, rest.d1), reach, speed, frequency, damping)


def mass_acceleration(response: Response, frequency: float, damping: float = 0.0) -> Jet:
    """x'' = -2 zeta w z' - w^2 z [m/s^2] of the mass, a jet of time without its third derivative."""
    return -2 * damping * frequency * derivative(response.error) - frequency**2 * response.error


def free_amplitude(response: Response, frequency: float, damping: float = 0.0) -> Floats:
    """Envelope sqrt(z^2 + ((z' + zeta w z)/w_d)^2) [m]: what remains swinging where the planned travel rests."""
    wd = frequency * np.sqrt(1 - damping**2)
    error, rate, _, _ = response.error
    return np.hypot(error, (rate + damping * frequency * error) / wd)


def response_peak(response: Response, speed: float, quantity: Jet) -> float:
    """Largest magnitude over the turn of a jet of time at the response's steps; between them by quintic Hermite interpolation."""
    slope = quantity.d1
    turns = np.flatnonzero((response.piece[1:] == response.piece[:-1]) & (slope[1:] * slope[:-1] < 0))
    step = (response.angle[turns + 1] - response.angle[turns]) / speed
    between = _hermite(quantity[turns], quantity[turns + 1], step)
    rate = between[1:] * np.arange(1, 6)[:, None]
    low, high = np.zeros(len(turns)), np.ones(len(turns))
    for _ in range(50):
        middle = 0.5 * (low + high)
        before = np.sign(_value(rate, middle)) == np.sign(slope[turns])
        low, high = np.where(before, middle, low), np.where(before, high, middle)
    return float(np.max(np.abs(np.append(quantity.d0, _value(between, low)))))


def vibration_table(cycle: Cycle, response: Response, reach: float, acceleration: Jet) -> Table:
    """Planned travel reach * lift, travel with vibration, error, and acceleration of the mass [m/s^2] at the response's steps."""
    lift = reach * cycle.at(response.piece, response.angle)[1].d0
    columns = (
        Column("angle", "rad", "cam angle", response.angle),
        Column("travel", "m", "travel of the rigid follower", lift, "Prescribed travel"),
        Column("actual", "m", "travel of the vibrating follower", lift + response.error.d0, "Travel with vibration"),
        Column("error", "m", "deviation of the vibrating follower from its programme", response.error.d0, "Deviation from the programme"),
        Column("acceleration", "m/s^2", "acceleration of the follower, vibration included", acceleration.d0, "Acceleration with vibration"),
    )
    return Table("vibration", "Vibration of the follower", columns)


def _hermite(left, right, step):
    """Coefficients (6, n) of the polynomials in 0..1 with value, slope and second derivative of both ends."""
    rise, (v0, v1), (a0, a1) = right.d0 - left.d0, (step * left.d1, step * right.d1), (step**2 * left.d2, step**2 * right.d2)
    return np.array(
        [
            left.d0,
            v0,
            a0 / 2,
            10 * rise - 6 * v0 - 4 * v1 - 1.5 * a0 + 0.5 * a1,
            -15 * rise + 8 * v0 + 7 * v1 + 1.5 * a0 - a1,
            6 * rise - 3 * (v0 + v1) - 0.5 * (a0 - a1),
        ]
    )


def _value(coefficients, x):
    return np.sum(coefficients * x ** np.arange(len(coefficients))[:, None], axis=0)


def _response(cycle, piece, angle, state, reach, speed, frequency, damping):
    """The higher derivatives of z follow from its equation."""
    error, rate = state
    _, lift = cycle.at(piece, angle)
    second = -reach * speed**2 * lift.d2 - 2 * damping * frequency * rate - frequency**2 * error
    third = -reach * speed**3 * lift.d3 - 2 * damping * frequency * second - frequency**2 * rate
    return Response(angle, piece, Jet(error, rate, second, third))


def _steps(cycle, piece, angle, reach, speed, frequency, damping):
    """(push, carry): what the forcing adds over each step (n-1, 2), and the propagator of each step (n-1, 2, 2)."""
    node, weight = np.polynomial.legendre.leggauss(ORDER)
    width = np.where(np.diff(piece) == 0, np.diff(angle), 0.0)
    at = angle[:-1, None] + width[:, None] * 0.5 * (1 + node)
    _, lift = cycle.at(np.broadcast_to(piece[:-1, None], at.shape), at)
    forcing = -reach * speed**2 * np.broadcast_to(lift.d2, at.shape)
    time = width / speed
    rest = propagator(0.5 * time[:, None] * (1 - node), frequency, damping)[..., 1]
    push = np.sum((0.5 * time[:, None] * weight * forcing)[..., None] * rest, axis=1)
    return push, propagator(time, frequency, damping)


def _impulses(cycle, reach, speed):
    """Jump of the planned velocity [m/s] on entering each piece."""
    pieces = cycle.pieces
    before, after = (cycle.at(pieces, ends)[1].d1 for ends in (cycle.motion.breaks[1:], cycle.motion.breaks[:-1]))
    return reach * speed * (after - np.roll(before, 1))


def _refuse(speed, frequency, damping):
    if not (speed > 0 and frequency > 0 and 0 <= damping < 1):
        raise InputError(
            f"cam vibration: speed {speed:.6g} rad/s and natural frequency {frequency:.6g} rad/s must be positive and "
            f"damping_ratio {damping:.6g} within 0 .. 1 (1 excluded)."
        )
    if frequency > STIFFEST * speed:
        raise InputError(
            f"cam vibration: the natural frequency is {frequency / speed:.4g} times the cam's speed; above {STIFFEST:g} times "
            "the follower is practically rigid. Leave the vibration out."
        )
