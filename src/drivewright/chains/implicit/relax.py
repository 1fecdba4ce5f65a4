"""Towards the least energy of a drive, compiled: Newton steps with the exact Hessian, shifted where it is not positive definite."""

from typing import NamedTuple

import numpy as np

from drivewright._jit import by_reference, inner
from drivewright._typing import Floats
from drivewright.chains.implicit.energy import assemble
from drivewright.chains.implicit.parts import Parts, State
from drivewright.chains.implicit.ring import factor, solve
from drivewright.chains.implicit.touch import find_candidates

_FIRST_SHIFT, _LAST_SHIFT = 1e-8, 1e6  # of the joint stiffness
_LONGEST = 0.2  # pitches, or radians, that a step may move a plate
_HALVINGS = 30
_ROUNDING = 1e-14  # part of the energy below which its change says nothing


@by_reference
class Work(NamedTuple):
    """Trial state, step of the plates and of the border, scales (a length per unit) of both."""

    trial: State
    plates: Floats
    border: Floats
    plate_scale: Floats
    border_scale: Floats


def work_for(parts: Parts) -> Work:
    """An empty `Work`; a turn counts by half the hole pitch of a plate, by the reach of a sprocket."""
    count, bodies, size = len(parts.half), len(parts.bodies), len(parts.field.ring.corner)
    trial = State(np.zeros((count, 3)), np.zeros((bodies, 2)), np.zeros((count, 3)), np.zeros((bodies, 2)))
    border = np.ones(size)
    for body in parts.bodies:
        if body["turn_column"] >= 0:
            border[body["turn_column"]] = body["reach"]
    return Work(trial, np.zeros((count, 3)), np.zeros(size), np.array([1.0, 1.0, parts.half[0]]), border)


@inner
def relax(parts: Parts, state: State, work: Work, tolerance: float, most: int) -> tuple[float, int]:
    """Bring the state to rest; (residual force [N], steps taken): not at rest where the residual is above tolerance.

    A shift lambda stands for springs lambda k_j that hold every plate where it was: what the drive itself leaves free stays near there.
    It changes the way, not the place of rest.
    """
    find_candidates(parts, state)
    energy, shift, residual = assemble(parts, state, 0.0), 0.0, np.inf
    for step in range(most):
        residual = _residual(parts, work)
        if residual <= tolerance:
            if not find_candidates(parts, state):
                return residual, step
            energy = assemble(parts, state, 0.0)
            continue
        shift = _direction(parts, state, work, shift)
        if shift > _LAST_SHIFT:
            return residual, step
        share, energy = _search(parts, state, work, energy, residual)
        if share < 0.2:
            shift = max(10.0 * shift, _FIRST_SHIFT)
        elif share == 1.0:
            shift = 0.0 if shift <= _FIRST_SHIFT else 0.1 * shift
        if share > 0.0 and find_candidates(parts, state):
            energy = assemble(parts, state, 0.0)
    return residual, most


@inner
def _residual(parts, work):
    """The largest force that is not balanced, moments over their lengths  [N]."""
    field, worst = parts.field, 0.0
    for i in range(len(field.plates)):
        for a in range(3):
            worst = max(worst, abs(field.plates[i, a]) / work.plate_scale[a])
    for n in range(len(parts.bodies)):
        body = parts.bodies[n]
        if body.slide_column >= 0:
            worst = max(worst, abs(field.bodies[n, 0]))
        if body.turn_column >= 0:
            worst = max(worst, abs(field.bodies[n, 1]) / body.reach)
    return worst


@inner
def _direction(parts, state, work, shift):
    """Newton step (H + lambda k_j W) step = -gradient into the work; returns the lambda that made it possible."""
    while shift <= _LAST_SHIFT:
        stiff, ring = shift * parts.chain.joint_stiffness, parts.field.ring
        for i in range(len(ring.diagonal)):
            for a in range(3):
                ring.diagonal[i, a, a] += stiff * work.plate_scale[a] ** 2
        for a in range(len(work.border)):
            ring.corner[a, a] += stiff * work.border_scale[a] ** 2
        if factor(ring):
            downhill(parts, work)
            return shift
        shift = max(10.0 * shift, _FIRST_SHIFT)
        assemble(parts, state, 0.0)
    return shift


@inner
def downhill(parts: Parts, work: Work) -> None:
    """Minus the gradient, and from it the step, with the factors of the tangent."""
    field = parts.field
    for i in range(len(field.plates)):
        for a in range(3):
            work.plates[i, a] = -field.plates[i, a]
    for n in range(len(parts.bodies)):
        body = parts.bodies[n]
        if body.slide_column >= 0:
            work.border[body.slide_column] = -field.bodies[n, 0]
        if body.turn_column >= 0:
            work.border[body.turn_column] = -field.bodies[n, 1]
    solve(field.ring, work.plates, work.border)


@inner
def _search(parts, state, work, energy, residual):
    """Halve the step until the energy falls, or, where rounding hides that, the residual; the share taken, the energy there."""
    longest = 0.0
    for i in range(len(work.plates)):
        for a in range(3):
            longest = max(longest, abs(work.plates[i, a]) / (2 * parts.chain.half_plate if a < 2 else 1.0))
    for a in range(len(work.border)):
        longest = max(longest, 0.2 * abs(work.border[a]) * work.border_scale[a] / (2 * parts.chain.half_plate))
    share = min(1.0, _LONGEST / longest)
    for _ in range(_HALVINGS):
        _step(parts, state, work, share)
        found = assemble(parts, work.trial, 0.0)
        noise = _ROUNDING * (1.0 + abs(energy))
        if found < energy - noise or (found <= energy + noise and _residual(parts, work) < residual):
            copy(work.trial.plates, state.plates)
            copy(work.trial.bodies, state.bodies)
            return share, found
        share *= 0.5
    return 0.0, assemble(parts, state, 0.0)


@inner
def _step(parts, state, work, share):
    """The trial state, this share of the step away."""
    for i in range(len(work.plates)):
        for a in range(3):
            work.trial.plates[i, a] = state.plates[i, a] + share * work.plates[i, a]
    for n in range(len(parts.bodies)):
        body = parts.bodies[n]
        q, psi = state.bodies[n, 0], state.bodies[n, 1]
        work.trial.bodies[n, 0] = q + share * work.border[body.slide_column] if body.slide_column >= 0 else q
        work.trial.bodies[n, 1] = psi + share * work.border[body.turn_column] if body.turn_column >= 0 else psi


@inner
def copy(source: Floats, target: Floats) -> None:
    """target (n, a) = source (n, a); the slice assignment would allocate."""
    for i in range(source.shape[0]):
        for a in range(source.shape[1]):
            target[i, a] = source[i, a]
