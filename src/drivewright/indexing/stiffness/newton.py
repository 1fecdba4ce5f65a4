"""Newton's method of `minimise` in compiled code, position by position, for the laws that have a formula of single strains.

The energy of y is 1/2 y' A y + sum V_k(R_k y + o_k) - f'y, as there, with the same steps, line search and bounds.
"""

from typing import NamedTuple

import numpy as np

from drivewright._jit import by_reference, inner, warmer
from drivewright._typing import Bools, Floats, Ints
from drivewright.contact import PowerLaw
from drivewright.indexing.drivetrain import PowerLawBearing
from drivewright.indexing.stiffness.laws import (
    GearFlankLaw,
    LineContact,
    PinContactLaw,
    RadialBearingLaw,
    RigidContactLaw,
    StrainLaw,
    contact_response,
    radial_response,
)
from drivewright.indexing.stiffness.minimise import (
    FLOOR,
    REGULARISATION,
    ROUNDING,
    STEP_LIMIT,
    TOLERANCE,
    ConvexEnergy,
    EnergyMinimum,
    flatten_rows,
)
from drivewright.numerics.line_search import KEPT_OFF, LIMIT, SPENT

LINE, SPRING, RIGID, RADIAL, SECOND = range(5)  # kinds of strain; SECOND: y of the bearing whose x stands before it
COMPILED: tuple[type, ...] = (PinContactLaw, RigidContactLaw, GearFlankLaw, RadialBearingLaw)


@by_reference
class PositionEnergy(NamedTuple):
    """Energies of m unknowns at p positions with n strains, of which the laws are the same at all positions.

    linear (1 or p, m, m) [N/m]; load (p, m) [N]; rows (p, n, m) [-], offset (p, n) [m]: of the strains; kind (n,): LINE ... SECOND;
    constants (n, 3): of its law, (line, compliance, both ways), (k, -, both ways), (-, -, bonded) or (constant, exponent, clearance);
    multiplier (p, n) [N], penalty (p,) [N/m]: of rigid contacts.
    """

    linear: Floats
    load: Floats
    rows: Floats
    offset: Floats
    kind: Ints
    constants: Floats
    multiplier: Floats
    penalty: Floats


@by_reference
class NewtonWork(NamedTuple):
    """Work arrays for one position of m unknowns and n strains.

    entries (n,), column (n, m), value (n, m): the entries of the rows that are not 0; strain, change, force, slope, cross (n,): strain and
    its change in a step [m], force [N], its derivative by the strain itself, and by the other one of a bearing [N/m]; gradient, step (m,);
    factor (m, m): of the regularised Hessian.
    """

    entries: Ints
    column: Ints
    value: Floats
    strain: Floats
    change: Floats
    force: Floats
    slope: Floats
    cross: Floats
    gradient: Floats
    step: Floats
    factor: Floats


def newton_work(unknowns: int, strains: int) -> NewtonWork:
    """Empty work arrays."""
    return NewtonWork(
        np.empty(strains, np.int64),
        np.empty((strains, unknowns), np.int64),
        np.empty((strains, unknowns)),
        np.empty(strains),
        np.empty(strains),
        np.empty(strains),
        np.empty(strains),
        np.empty(strains),
        np.empty(unknowns),
        np.empty(unknowns),
        np.empty((unknowns, unknowns)),
    )


def is_compiled(system: ConvexEnergy) -> bool:
    """Whether all laws of the energy have a formula of single strains here, with the same constants at all contacts."""
    alike = (part.law.compliance is None for part in system.parts if isinstance(part.law, PinContactLaw))
    return all(isinstance(part.law, COMPILED) for part in system.parts) and all(alike)


def constants_of(law: StrainLaw) -> tuple[int, tuple[float, float, float]]:
    """(kind, constants) of a law that `is_compiled`."""
    if isinstance(law, RigidContactLaw):
        return RIGID, (0.0, 0.0, float(law.bonded))
    if isinstance(law, RadialBearingLaw):
        return RADIAL, (law.bearing.constant, law.bearing.exponent, law.bearing.clearance)
    if isinstance(law, GearFlankLaw):
        return SPRING, (law.k, 0.0, 0.0)
    assert isinstance(law, PinContactLaw)
    one_sided = law.one_sided
    if isinstance(one_sided, LineContact):
        return LINE, (float(one_sided.line), float(one_sided.compliance), float(law.bonded))
    return SPRING, (one_sided.k, 0.0, float(law.bonded))


def position_energy(system: ConvexEnergy) -> PositionEnergy:
    """The `PositionEnergy` of an energy that `is_compiled`."""
    p, m = system.load.shape
    counts = [part.offset.shape[1] * part.offset.shape[2] for part in system.parts]
    n = sum(counts)
    rows, offset, kind, constants = np.empty((p, n, m)), np.empty((p, n)), np.empty(n, np.int64), np.zeros((n, 3))
    multiplier, penalty, first = np.zeros((p, n)), np.ones(p), 0
    for part, count in zip(system.parts, counts, strict=True):
        here = slice(first, first + count)
        rows[:, here], offset[:, here] = flatten_rows(part.rows), part.offset.reshape(p, count)
        kind[here], constants[here] = constants_of(part.law)
        if isinstance(part.law, RadialBearingLaw):
            kind[first + 1 : first + count : 2] = SECOND
        if isinstance(part.law, RigidContactLaw):
            multiplier[:, here] = np.broadcast_to(part.law.multipliers, part.offset.shape).reshape(p, count)
            penalty[:] = np.broadcast_to(part.law.k, (p, 1, 1))[:, 0, 0]
        first += count
    linear = system.linear[:1] if system.linear.strides[0] == 0 else system.linear
    return PositionEnergy(
        np.ascontiguousarray(linear), np.ascontiguousarray(system.load), rows, offset, kind, constants, multiplier, penalty
    )


def minimise_by_position(system: ConvexEnergy, start: Floats, bound: float) -> EnergyMinimum:
    """What `minimise_energy` finds, of an energy that `is_compiled`; a position ends as if it were alone."""
    energy, y = position_energy(system), np.array(start, dtype=float, order="C")
    p, n, m = energy.rows.shape
    hessian, converged = np.empty((p, m, m)), np.zeros(p, dtype=bool)
    steps = minimise_positions(energy, newton_work(m, n), bound, y, hessian, converged)
    return EnergyMinimum(y, hessian, converged, int(steps))


@warmer
def warm_positions() -> None:
    """Compile for `doctor --warm`."""
    one, square = np.ones((1, 1)), np.ones((1, 1, 1))
    energy = PositionEnergy(square, one, square, one, np.full(1, SPRING), np.ones((1, 3)), one, np.ones(1))
    minimise_positions(energy, newton_work(1, 1), 1.0, one, square, np.zeros(1, dtype=bool))


@inner
def minimise_positions(energy: PositionEnergy, work: NewtonWork, bound: float, y: Floats, hessian: Floats, converged: Bools) -> int:
    """Writes y (p, m) [m], at first the start, hessian (p, m, m) [N/m] and converged (p,); the most steps of a position is returned.

    A position that does not settle, or leaves |y| < bound [m], keeps its last y.
    """
    most = 0
    for i in range(len(y)):
        most = max(most, _minimise(energy, work, i, bound, y[i], hessian[i], converged))
    return most


@inner
def _minimise(energy, work, i, bound, y, hessian, converged):
    """One position i: y (m,) and hessian (m, m) are written; returns the steps."""
    _gather_entries(energy, work, i)
    scale, regularisation = _largest(energy.load[i]), REGULARISATION / _largest(y)
    for step in range(STEP_LIMIT + 1):
        noise = _differentiate(energy, work, i, y, hessian)
        left = _largest(work.gradient)
        converged[i] = left <= max(TOLERANCE * scale, noise)
        floor = FLOOR * _largest_stiffness(hessian)
        if converged[i]:
            _solve(hessian, floor, work)
            for a in range(len(y)):
                y[a] += work.step[a]  # one full step more: the bound on rounding that ended the search is a wide one
            return step
        if step == STEP_LIMIT or _largest(y) > bound:
            return step
        _solve(hessian, floor + regularisation * min(left, scale), work)
        share = _step_length(energy, work, i, y)
        for a in range(len(y)):
            y[a] += share * work.step[a]
    return STEP_LIMIT


@inner
def _largest(vector):
    """The largest size in a vector (m,)."""
    largest = 0.0
    for a in range(len(vector)):
        largest = max(largest, abs(vector[a]))
    return largest


@inner
def _largest_stiffness(hessian):
    """The largest size on the diagonal of a matrix (m, m)."""
    largest = 0.0
    for a in range(len(hessian)):
        largest = max(largest, abs(hessian[a, a]))
    return largest


@inner
def _gather_entries(energy, work, i):
    """Writes what is not 0 in the rows of position i."""
    for j in range(len(energy.kind)):
        count = 0
        for a in range(energy.rows.shape[2]):
            if energy.rows[i, j, a] != 0.0:
                work.column[j, count], work.value[j, count] = a, energy.rows[i, j, a]
                count += 1
        work.entries[j] = count


@inner
def _strain_of(work, y, displacement):
    """Writes R y (n,) of y (m,)."""
    for j in range(len(displacement)):
        total = 0.0
        for e in range(work.entries[j]):
            total += work.value[j, e] * y[work.column[j, e]]
        displacement[j] = total


@inner
def _respond(energy, work, i, share):
    """Writes force, slope and cross (n,) of all strains of position i at a share of the step."""
    for j in range(len(energy.kind)):
        kind, d, (first, second, third) = energy.kind[j], work.strain[j] + share * work.change[j], _three(energy.constants, j)
        work.cross[j] = 0.0
        if kind == RADIAL:
            beside = work.strain[j + 1] + share * work.change[j + 1]
            found = radial_response(PowerLawBearing(first, second, third), d, beside)
            work.force[j], work.slope[j], work.cross[j] = found.x, found.xx, found.xy
            work.force[j + 1], work.slope[j + 1] = found.y, found.yy
        elif kind == RIGID:
            pull = energy.multiplier[i, j] + energy.penalty[i] * d
            closed = pull > 0.0 or third > 0.0
            work.force[j], work.slope[j] = (pull, energy.penalty[i]) if closed else (0.0, 0.0)
        elif kind != SECOND:
            depth = abs(d) if third > 0.0 else d
            if depth < 0.0:
                work.force[j], work.slope[j] = 0.0, 0.0
                continue
            pressed = contact_response(LineContact(first, second), depth) if kind == LINE else contact_response(PowerLaw(first, 1.0), depth)
            work.force[j], work.slope[j] = np.copysign(pressed.force, d), pressed.tangent


@inner
def _three(constants, j):
    """Row j of the constants (n, 3) as three numbers."""
    return constants[j, 0], constants[j, 1], constants[j, 2]


@inner
def _differentiate(energy, work, i, y, hessian):
    """Writes gradient (m,) and hessian (m, m) at y (m,); returns what rounding leaves of the gradient [N]."""
    linear = energy.linear[i % len(energy.linear)]
    _strain_of(work, y, work.strain)
    for j in range(len(energy.kind)):
        work.strain[j] += energy.offset[i, j]
        work.change[j] = 0.0
    _respond(energy, work, i, 0.0)
    for a in range(len(y)):
        total = 0.0
        for b in range(len(y)):
            hessian[a, b] = linear[a, b]
            total += linear[a, b] * y[b]
        work.gradient[a] = total - energy.load[i, a]
    for j in range(len(energy.kind)):
        _add_strain(work, j, hessian)
    noise = 0.0
    for a in range(len(y)):
        total = 0.0
        for b in range(len(y)):
            total += abs(hessian[a, b]) * abs(y[b])
        noise = max(noise, total)
    return ROUNDING * noise


@inner
def _add_strain(work, j, hessian):
    """Adds the force of strain j to the gradient, its stiffness to hessian (m, m)."""
    for e in range(work.entries[j]):
        a, value = work.column[j, e], work.value[j, e]
        work.gradient[a] += value * work.force[j]
        for f in range(work.entries[j]):
            hessian[a, work.column[j, f]] += value * work.slope[j] * work.value[j, f]
        if work.cross[j] != 0.0:
            for f in range(work.entries[j + 1]):
                b, both = work.column[j + 1, f], value * work.cross[j] * work.value[j + 1, f]
                hessian[a, b] += both
                hessian[b, a] += both


@inner
def _solve(hessian, floor, work):
    """Writes step (m,) = -(H + floor)^-1 gradient, H (m, m) symmetric and not negative, by Cholesky's factors."""
    size, factor, step = len(hessian), work.factor, work.step
    for a in range(size):
        for b in range(a, size):
            factor[a, b] = hessian[a, b]
        factor[a, a] += floor
        step[a] = -work.gradient[a]
    for k in range(size):
        pivot = 1.0 / np.sqrt(factor[k, k])  # at least the floor, beside which rounding is small
        for b in range(k, size):
            factor[k, b] *= pivot
        step[k] *= pivot
        for a in range(k + 1, size):
            above = factor[k, a]
            if above != 0.0:
                step[a] -= above * step[k]
                for b in range(a, size):
                    factor[a, b] -= above * factor[k, b]
        factor[k, k] = pivot
    for k in range(size - 1, -1, -1):
        total = step[k]
        for b in range(k + 1, size):
            total -= factor[k, b] * step[b]
        step[k] = total * factor[k, k]


@inner
def _step_length(energy, work, i, y):
    """Share of the step: `numerics.line_search.convex_step_length` once more, which cannot be called here: a kernel that takes its slope
    as a function is not kept on disk."""
    linear, step = energy.linear[i % len(energy.linear)], work.step
    _strain_of(work, step, work.change)
    bent, base = 0.0, 0.0
    for a in range(len(y)):
        pull = 0.0
        for b in range(len(y)):
            pull += linear[a, b] * step[b]
        bent += pull * step[a]
        base += pull * y[a] - energy.load[i, a] * step[a]
    low, share, high, high_slope = 0.0, 1.0, 1.0, 0.0
    low_slope = _steepness(energy, work, i, base, bent, 0.0)
    steep = abs(low_slope)
    if low_slope >= 0.0:  # at rest but for rounding
        return share
    for _ in range(LIMIT):
        here = _steepness(energy, work, i, base, bent, share)
        if abs(here) <= SPENT * steep or (here <= 0.0 and share == 1.0):
            break
        if here < 0.0:
            low, low_slope = share, here
        else:
            high, high_slope = share, here
        part = -low_slope / (high_slope - low_slope)
        share = low + (high - low) * min(max(part, KEPT_OFF), 1.0 - KEPT_OFF)
    return share


@inner
def _steepness(energy, work, i, base, bent, share):
    """Slope of the energy at a share of the step: base + share bent, and what the strains add."""
    _respond(energy, work, i, share)
    total = base + share * bent
    for j in range(len(energy.kind)):
        total += work.force[j] * work.change[j]
    return total
