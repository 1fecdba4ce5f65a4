"""Newton's method for the equilibrium of one bearing under a force, compiled, whatever its law."""

from typing import Any, NamedTuple

import numpy as np

from drivewright._jit import generic, inner, kernel
from drivewright._typing import Bools, Floats, Ints
from drivewright.bearings.response import response
from drivewright.numerics.small import ldl_solve

MAX_STEPS = 30  # at one load
MAX_LOADS = 60  # on the way from an easy load to the wanted one
UNRESISTED, NOT_CONVERGED = -1, -2  # instead of the number of steps


class BearingMeasures(NamedTuple):
    """What the solver must know of a law.

    length [m]: a displacement that matters; arm [m]: radius at which a tilt becomes a displacement; centre [m]: z where the inner
    ring stands when nothing pushes it along the axis; elements, laminae: how many, laminae 0 where the contact is a point.
    """

    length: float
    arm: float
    centre: float
    elements: int
    laminae: int


@generic
def measures(law: Any) -> BearingMeasures:
    """The `BearingMeasures` of a law."""
    raise NotImplementedError


class _Work(NamedTuple):
    start: Floats
    load: Floats
    force: Floats
    stiffness: Floats
    matrix: Floats
    step: Floats
    origin: Floats
    scale: Floats


@kernel
def equilibrium(law: Any, force: Floats, held: Bools, start: Floats) -> tuple[Floats, int]:
    """(displacement (5,), steps) at which the bearing carries `force` (5,); steps < 0 is UNRESISTED or NOT_CONVERGED.

    held (5,) of bool: freedoms that stay at their `start`, where they find whatever force it takes.
    The energy less the work of the force is convex, so there is one minimum; a freedom that nothing resists and nothing pushes
    stays where it started.
    """
    displacement = start.copy()
    return displacement, _find_equilibrium(law, force, held, displacement, _workspace())


@kernel
def equilibria(law: Any, forces: Floats, held: Bools) -> tuple[Floats, Ints]:
    """(displacements (n, 5), steps (n,)) for many forces (n, 5) from the unloaded position; rows that failed are nan."""
    displacements, steps, work = np.zeros(forces.shape), np.zeros(len(forces), dtype=np.int64), _workspace()
    for i in range(len(forces)):
        centre_ring(law, forces[i], held, displacements[i])
        steps[i] = _find_equilibrium(law, forces[i], held, displacements[i], work)
        if steps[i] < 0:
            displacements[i] = np.nan
    return displacements, steps


@inner
def centre_ring(law: Any, force: Floats, held: Bools, displacement: Floats) -> None:
    """Put z where the ring centres itself when the load does not push it along the axis.

    The potential is symmetric about this z, so the answer lies there; on the way from anywhere else balls would change sides.

    force (5,) [N, N m], held (5,), displacement (5,) [m, rad], written.
    """
    loaded = force[0] != 0.0 or force[1] != 0.0 or force[3] != 0.0 or force[4] != 0.0
    if loaded and force[2] == 0.0 and not held[2]:
        displacement[2] = measures(law).centre


@kernel
def _workspace():
    """Working arrays of one search, (5,) and (5, 5)."""
    return _Work(np.empty(5), np.empty(5), np.empty(5), np.empty((5, 5)), np.empty((5, 5)), np.empty(5), np.empty(5), np.empty(5))


@inner
def _find_equilibrium(law, force, held, displacement, work):
    """Newton's method from `displacement`, in place; the number of steps. force (5,) [N, N m], held (5,), displacement (5,) [m, rad]."""
    sizes = measures(law)
    for i in range(5):
        work.scale[i] = 0.0 if held[i] else sizes.length if i < 3 else sizes.length / sizes.arm
    steps = _newton(law, force, 1.0, displacement, work)
    return _reduce_load(law, force, displacement, work) if steps == NOT_CONVERGED else steps


@inner
def _reduce_load(law, force, displacement, work):
    """A load that presses the ring in, reduced to the wanted one; the number of steps.

    Under a slight load the elements are as good as rigid, and the ring finds its place among them in too many small steps.

    force (5,) [N, N m], displacement (5,) [m, rad], in place.
    """
    factor, reached, ratio, total = 100.0, np.inf, 0.1, MAX_STEPS
    for _ in range(MAX_LOADS):
        for i in range(5):
            work.start[i] = displacement[i]
        steps = _newton(law, force, factor, displacement, work)
        if steps == UNRESISTED:
            return UNRESISTED
        total += steps if steps >= 0 else MAX_STEPS
        if steps >= 0 and factor == 1.0:
            return total
        if steps < 0 and reached == np.inf:
            factor *= 100.0
            continue
        if steps >= 0:
            reached = factor
        else:
            ratio = np.sqrt(ratio)
            for i in range(5):
                displacement[i] = work.start[i]
        factor = max(ratio * reached, 1.0)
    return NOT_CONVERGED


@inner
def _newton(law, force, factor, displacement, work):
    """Newton steps at `factor` times the force, in place; the number of steps. force (5,) [N, N m], displacement (5,) [m, rad]."""
    weight = 0.0
    for i in range(5):
        work.load[i] = factor * force[i]
        weight = np.hypot(weight, work.scale[i] * work.load[i])
    response(law, displacement, work.force, work.stiffness)
    miss = np.inf
    for number in range(MAX_STEPS):
        before, miss = miss, 0.0
        for i in range(5):
            miss = np.hypot(miss, work.scale[i] * (work.force[i] - work.load[i]))
        if miss <= 1e-12 * weight or (miss <= 1e-8 * weight and miss > 0.5 * before):  # the second: as near as rounding lets
            return number
        size, here = _newton_step(displacement, miss, work)
        if size <= 1e-15 * here + 1e-16:  # rounding is all that is left, as where a preload outweighs the force
            return number
        if not _line_search(law, displacement, size, work):
            return UNRESISTED
    return NOT_CONVERGED


@inner
def _newton_step(displacement, miss, work):
    """Writes the step [m, rad]; (its size, that of the displacement) in units of `scale`.

    H + lambda I with lambda from next to nothing, raised while the step leaves the neighbourhood in which the stiffness means
    anything: where H is singular the step then follows the force.

    displacement (5,) [m, rad]; miss: of the forces in units of `scale` [N m].
    """
    peak, size, here = 0.0, np.inf, 0.0
    for i in range(5):
        peak = max(peak, work.scale[i] ** 2 * work.stiffness[i, i])
        if work.scale[i] > 0.0:
            here = np.hypot(here, displacement[i] / work.scale[i])
    damping = 1e-10 * peak if peak > 0.0 else miss / 0.01
    for _ in range(40):
        for i in range(5):
            for j in range(i + 1):
                work.matrix[i, j] = work.scale[i] * work.stiffness[i, j] * work.scale[j]
            work.matrix[i, i] += damping
            work.step[i] = work.scale[i] * (work.load[i] - work.force[i])
        ldl_solve(work.matrix, work.step)
        size = 0.0
        for i in range(5):
            size = np.hypot(size, work.step[i])
        if size <= max(1.0, here):
            break
        damping *= 30.0
    for i in range(5):
        work.step[i] *= work.scale[i]
    return size, here


@inner
def _line_search(law, displacement, size, work):
    """Go along the step until the slope has dropped to a part of its first value; False where it never does.

    displacement (5,) [m, rad], in place; size of the step in units of `scale`.
    """
    first = _slope(work)
    low, low_slope, high, high_slope, t = 0.0, first, np.inf, 0.0, 1.0
    for i in range(5):
        work.origin[i] = displacement[i]
    for _ in range(60):
        for i in range(5):
            displacement[i] = work.origin[i] + t * work.step[i]
        response(law, displacement, work.force, work.stiffness)
        slope = _slope(work)
        if abs(slope) <= 0.5 * abs(first):
            return True
        if slope < 0.0:
            low, low_slope = t, slope
        else:
            high, high_slope = t, slope
        if high == np.inf:
            t *= 4.0
            if t * size > 1e8:
                return False
        else:
            t = low + (high - low) * min(max(low_slope / (low_slope - high_slope), 0.1), 0.9)
    return True


@inner
def _slope(work):
    """Change of the potential along the step [J]."""
    slope = 0.0
    for i in range(5):
        slope += (work.force[i] - work.load[i]) * work.step[i]
    return slope
