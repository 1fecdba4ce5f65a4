"""Kernels of the implicit motion: generalised-alpha steps with the exact tangent, each solved by Newton's method.

    M a + f(q, v) = 0 at the end of every step;   (1 - am) A1 + am A0 = (1 - af) a1 + af a0
    q1 = q0 + h v0 + h^2 ((1/2 - b) A0 + b A1),   v1 = v0 + h ((1 - g) A0 + g A1)

am = (2 rho - 1)/(rho + 1), af = rho/(rho + 1), g = 1/2 - am + af, b = (g + 1/2)^2/4: of second order, the highest frequencies shrink by
rho per step.  Chung & Hulbert 1993, in the form of Arnold & Bruels 2007; recalled.
"""

from typing import NamedTuple

import numpy as np

from drivewright._jit import by_reference, inner
from drivewright._typing import Floats, Ints
from drivewright.chains.implicit.energy import assemble
from drivewright.chains.implicit.parts import TORQUE, Parts, State
from drivewright.chains.implicit.relax import Work, downhill
from drivewright.chains.implicit.ring import factor
from drivewright.chains.implicit.touch import find_candidates

WORKS = 11  # powers (see POWERS), drive, impulse x and y, turning impulse
DRIVE, PUSH_X, PUSH_Y, PUSH_TURN = range(7, WORKS)
_WHOLE, _SHORTER = 10, 0.75  # Newton steps taken whole, and by what factor each further one is shorter


class Scheme(NamedTuple):
    """Step h; am, af, g, b of the method; size of a Newton step [m] that ends it; most of them."""

    h: float
    am: float
    af: float
    g: float
    b: float
    tolerance: float
    most: int


@by_reference
class Run(NamedTuple):
    """A motion under way: parts, state, true and auxiliary accelerations (as State: plates, bodies), works, powers, clock, Newton steps."""

    parts: Parts
    state: State
    true: State
    auxiliary: State
    work: Work
    works: Floats
    powers: Floats
    clock: Floats
    spent: Ints


def scheme(h: float, rho: float, tolerance: float, most: int = 80) -> Scheme:
    """The `Scheme` of spectral radius rho, 0 .. 1, at infinite frequency."""
    am, af = (2 * rho - 1) / (rho + 1), rho / (rho + 1)
    g = 0.5 - am + af
    return Scheme(h, am, af, g, 0.25 * (g + 0.5) ** 2, tolerance, most)


@inner
def steps(run: Run, scheme: Scheme, count: int) -> int:
    """`count` steps; how many of them succeeded."""
    for k in range(count):
        for j in range(WORKS):
            run.works[j] += 0.5 * scheme.h * run.powers[j]
        run.clock[0] += scheme.h
        _predict(run, scheme)
        drive_bodies(run)
        find_candidates(run.parts, run.state)
        if not _newton(run, scheme):
            return k
        _accept(run.true.plates, run.auxiliary.plates, scheme)
        _accept(run.true.bodies, run.auxiliary.bodies, scheme)
        tally(run)
        for j in range(WORKS):
            run.works[j] += 0.5 * scheme.h * run.powers[j]
    return count


@inner
def _predict(run, scheme):
    """Places and rates at the end of the step, should the true accelerations stay."""
    state, true, aux = run.state, run.true, run.auxiliary
    _predict_table(state.plates, state.plate_rates, true.plates, aux.plates, scheme)
    _predict_table(state.bodies, state.body_rates, true.bodies, aux.bodies, scheme)


@inner
def _predict_table(q, v, true, auxiliary, scheme):
    """The same of one table: places q [m or rad], rates v [1/s of it], true and auxiliary accelerations [1/s^2 of it], all (n, a)."""
    h = scheme.h
    for i in range(q.shape[0]):
        for a in range(q.shape[1]):
            old = auxiliary[i, a]
            new = (true[i, a] - scheme.am * old) / (1.0 - scheme.am)
            q[i, a] += h * v[i, a] + h * h * ((0.5 - scheme.b) * old + scheme.b * new)
            v[i, a] += h * ((1.0 - scheme.g) * old + scheme.g * new)
            auxiliary[i, a] = (scheme.af * true[i, a] - scheme.am * old) / (1.0 - scheme.am)


@inner
def _accept(true, auxiliary, scheme):
    """The auxiliary accelerations at the end of the step, by the true ones: both (n, a) [m/s^2 or rad/s^2]."""
    for i in range(true.shape[0]):
        for a in range(true.shape[1]):
            auxiliary[i, a] += (1.0 - scheme.af) / (1.0 - scheme.am) * true[i, a]


@inner
def _newton(run, scheme):
    """Solve M a + f = 0 for the places at the end of the step; False where it does not settle.

    A contact's damping force may jump where it closes, and the solution lie within the jump, which Newton steps leap over to and fro:
    after some of them they are shortened, each more than the one before.  A tangent that is not positive definite is made so by more mass.
    """
    parts, work, share, more = run.parts, run.work, 1.0, 1.0
    inertial, gain = (1.0 - scheme.am) / (scheme.h**2 * scheme.b * (1.0 - scheme.af)), scheme.g / (scheme.h * scheme.b)
    for k in range(scheme.most):
        assemble(parts, run.state, gain)
        _add_inertia(run, more * inertial)
        if not factor(parts.field.ring):
            more *= 10.0
            continue
        downhill(parts, work)
        run.spent[0] += 1
        share = 1.0 if k < _WHOLE else _SHORTER * share
        longest = _improve(run, inertial, gain, share)
        if longest <= scheme.tolerance:
            return True
        if not np.isfinite(longest):
            return False
        more = max(1.0, 0.1 * more)
    return False


@inner
def _add_inertia(run, inertial):
    """M a to the gradient [N, N m], `inertial` M to the tangent: da/dq [1/s^2] of the scheme."""
    parts, field, chain = run.parts, run.parts.field, run.parts.chain
    for i in range(len(field.plates)):
        for a in range(3):
            m = chain.mass if a < 2 else chain.inertia
            field.plates[i, a] += m * run.true.plates[i, a]
            field.ring.diagonal[i, a, a] += inertial * m
    for n in range(len(parts.bodies)):
        body = parts.bodies[n]
        if body.slide_column >= 0:
            field.bodies[n, 0] += body.mass * run.true.bodies[n, 0]
            field.ring.corner[body.slide_column, body.slide_column] += inertial * body.mass
        if body.turn_column >= 0:
            field.bodies[n, 1] += body.inertia * run.true.bodies[n, 1]
            field.ring.corner[body.turn_column, body.turn_column] += inertial * body.inertia


@inner
def _improve(run, inertial, gain, share):
    """Take on a share of a Newton step; the longest part of it, turns by the length that they count for  [m].

    inertial [1/s^2], gain [1/s]: by how much accelerations and rates follow the places.
    """
    state, true, work, longest = run.state, run.true, run.work, 0.0
    for i in range(len(state.plates)):
        for a in range(3):
            step = share * work.plates[i, a]
            state.plates[i, a] += step
            state.plate_rates[i, a] += gain * step
            true.plates[i, a] += inertial * step
            longest = max(longest, abs(step) * work.plate_scale[a])
    for n in range(len(run.parts.bodies)):
        body = run.parts.bodies[n]
        columns = (body.slide_column, body.turn_column)
        for a in range(2):
            if columns[a] >= 0:
                step = share * work.border[columns[a]]
                state.bodies[n, a] += step
                state.body_rates[n, a] += gain * step
                true.bodies[n, a] += inertial * step
                longest = max(longest, abs(step) * work.border_scale[columns[a]])
    return longest


@inner
def drive_bodies(run: Run) -> None:
    """Prescribed angles and speeds: w = start + (speed - start)(x - sin(2 pi x)/(2 pi)), x = t/ramp up to 1."""
    time = run.clock[0]
    for n in range(len(run.parts.bodies)):
        body = run.parts.bodies[n]
        if body.slide_column < 0:
            run.state.bodies[n, 0], run.state.body_rates[n, 0] = 0.0, 0.0
        if body.turn_column < 0:
            change, ramp = body.speed - body.start, body.ramp
            x = min(time / ramp, 1.0) if ramp > 0.0 else 1.0
            turned = ramp * (0.5 * x * x - (1.0 - np.cos(2 * np.pi * x)) / (4 * np.pi**2))
            run.state.bodies[n, 1] = body.psi0 + body.start * time + change * (turned + max(time - ramp, 0.0))
            run.state.body_rates[n, 1] = body.start + change * (x - np.sin(2 * np.pi * x) / (2 * np.pi))


@inner
def tally(run: Run) -> None:
    """Powers at the end of the step: losses below 0, load torques, drive; push of bodies and weight on all plates, and its moment."""
    parts, field, state, powers = run.parts, run.parts.field, run.state, run.powers
    for j in range(7):
        powers[j] = field.powers[j] if j == TORQUE else -field.powers[j]
    for j in range(7, WORKS):
        powers[j] = 0.0
    for n in range(len(parts.bodies)):
        if parts.bodies[n].turn_column < 0:
            powers[DRIVE] += field.bodies[n, 1] * state.body_rates[n, 1]
    for n in range(len(parts.bodies)):
        body, fx, fy = parts.bodies[n], field.loads[n, 0], field.loads[n, 1]
        x, y = body.x0 + state.bodies[n, 0] * body.ux, body.y0 + state.bodies[n, 0] * body.uy
        powers[PUSH_X] -= fx
        powers[PUSH_Y] -= fy
        powers[PUSH_TURN] -= field.loads[n, 2] + x * fy - y * fx
    gx, gy = parts.chain.mass * parts.gravity[0], parts.chain.mass * parts.gravity[1]
    for i in range(len(state.plates)):
        powers[PUSH_X] += gx
        powers[PUSH_Y] += gy
        powers[PUSH_TURN] += state.plates[i, 0] * gy - state.plates[i, 1] * gx
