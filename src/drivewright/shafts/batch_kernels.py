"""The compiled loop over the shafts of a batch.

A uniform shaft on two bearings takes the closed form.  Every other is swept from both ends: all that lies on one side of a place acts
there, whatever it is, as one spring of compliance u on a lever, c away, and one tilt spring q:  2 V = (w - c theta)^2/u + q theta^2.
In this form nothing cancels, nothing is inverted and rigid (u = 0), free (u = inf) and single supports (q = 0) are no special cases:

    a support beside it     u' = u v/(u + v),  c' = c v/(u + v),  q' = q + c^2/(u + v)           v = 1/k
    a piece of shaft        c += l;  n = 1 + q f;  u' = u + r + f (c - g)^2/n,  c' = (c + q f g)/n,  q' = q/n

with f = int dx/EI of the piece, g how far back its elastic centre lies from the new end, and r = int (x - g)^2 dx/EI + int dx/(kappa G A).
(The piece is a hinge of compliance f at its elastic centre and a slide of compliance r: its flexibility matrix, diagonal about there.)
Where the two sides meet at a station, the deflection under a unit force is u + c^2/q of both together; it is then carried outwards.
The exact solution of Timoshenko's beam, as the two-node shear-flexible elements give it, without their loss of digits in short elements.
"""

from typing import NamedTuple

import numpy as np

from drivewright._jit import by_reference, inner
from drivewright._typing import Floats, Ints
from drivewright.shafts.closed_form import flexibility_entry, reaction_shares
from drivewright.shafts.sections import compliance_integrals

OFF = 1e-9  # part of the shaft's length by which a place may lie beyond its end: sums of lengths are rounded


class DesignColumn(NamedTuple):
    """A table (designs, width) as its numbers in a row and the steps to the next design and entry, 0 where one serves all."""

    values: Floats
    row: int
    entry: int


class DesignColumns(NamedTuple):
    """Shafts of a batch: lengths, diameters, bores, supports, stations [m], radial stiffness [N/m], modulus [Pa]; poisson, shear [-]."""

    lengths: DesignColumn
    diameters: DesignColumn
    end_diameters: DesignColumn
    bores: DesignColumn
    supports: DesignColumn
    radial_stiffness: DesignColumn
    stations: DesignColumn
    youngs_modulus: DesignColumn
    poisson: DesignColumn
    shear: DesignColumn


@by_reference
class BatchWorkspace(NamedTuple):
    """What a design needs on its way, by point: a support or a station; supports are numbered first.

    order (P,): number of each point, from left to right; place (P,) [m]; pieces (P, 4): of the shaft to the next point its length [m],
    f [1/(N m)], g [m] from its left end, r [m/N]; sides (2, P, 3): u [m/N], c [m], q [N m] of all left and right of a point.
    """

    order: Ints
    place: Floats
    pieces: Floats
    sides: Floats


def workspace(points: int) -> BatchWorkspace:
    """The `BatchWorkspace` for so many points."""
    return BatchWorkspace(np.empty(points, np.int64), np.empty(points), np.empty((points, 4)), np.empty((2, points, 3)))


@inner
def entry_of(column: DesignColumn, design: int, entry: int) -> float:
    """The number of one design and entry."""
    return column.values[design * column.row + entry * column.entry]


@inner
def fill_flexibilities(
    designs: DesignColumns, sections: int, begin: int, end: int, work: BatchWorkspace, delta: Floats, carried: Floats
) -> None:
    """Writes the rows begin ... end of delta (N, M, M) [m/N] and, where it has rows, carried (N, B, M) [-]."""
    bearings, stations = carried.shape[1], carried.shape[2]
    wanted = carried.shape[0] > 0
    for n in range(begin, end):
        total = np.nan
        row = n if wanted else 0
        if _is_possible(designs, sections, bearings, stations, n):
            if bearings == 2 and _is_uniform(designs, sections, n):
                _fill_closed_form(designs, n, delta, carried, wanted)
            else:
                _fill_two_sided(designs, sections, n, work, delta, carried, wanted)
            total = 0.0
            for i in range(stations):
                for j in range(stations):
                    total += delta[n, i, j]
                for b in range(bearings if wanted else 0):
                    total += carried[row, b, i]
        if not np.isfinite(total):
            for i in range(stations):
                for j in range(stations):
                    delta[n, i, j] = np.nan
                for b in range(bearings if wanted else 0):
                    carried[row, b, i] = np.nan


@inner
def _is_possible(designs, sections, bearings, stations, n):
    """Whether sizes, material and places make a shaft; comparisons are turned so that nan fails."""
    good = (
        entry_of(designs.youngs_modulus, n, 0) > 0.0
        and -1.0 < entry_of(designs.poisson, n, 0) < 0.5
        and np.isfinite(entry_of(designs.shear, n, 0))
    )
    length = 0.0
    for s in range(sections):
        part, bore = entry_of(designs.lengths, n, s), entry_of(designs.bores, n, s)
        good = (
            good
            and part > 0.0
            and bore >= 0.0
            and entry_of(designs.diameters, n, s) > bore
            and entry_of(designs.end_diameters, n, s) > bore
        )
        length += part
    low, high = -OFF * length, (1.0 + OFF) * length
    for b in range(bearings):
        good = good and low <= entry_of(designs.supports, n, b) <= high and entry_of(designs.radial_stiffness, n, b) >= 0.0
    for i in range(stations):
        good = good and low <= entry_of(designs.stations, n, i) <= high
    return good


@inner
def _is_uniform(designs, sections, n):
    """Whether all sections of design n have one diameter and one bore."""
    diameter, bore = entry_of(designs.diameters, n, 0), entry_of(designs.bores, n, 0)
    same = True
    for s in range(sections):
        same = same and entry_of(designs.diameters, n, s) == diameter and entry_of(designs.end_diameters, n, s) == diameter
        same = same and entry_of(designs.bores, n, s) == bore
    return same


@inner
def _fill_closed_form(designs, n, delta, carried, wanted):
    """Row n of delta (N, M, M) [m/N] and, where wanted, of carried (N, B, M) [-], of a uniform shaft on two supports: `closed_form`."""
    diameter, bore = entry_of(designs.diameters, n, 0), entry_of(designs.bores, n, 0)
    modulus, poisson, shear = entry_of(designs.youngs_modulus, n, 0), entry_of(designs.poisson, n, 0), entry_of(designs.shear, n, 0)
    bend, _, _, slip = compliance_integrals(1.0, diameter, diameter, bore, modulus, poisson, shear)
    first = 0 if entry_of(designs.supports, n, 0) <= entry_of(designs.supports, n, 1) else 1
    start, end = entry_of(designs.supports, n, first), entry_of(designs.supports, n, 1 - first)
    span = end - start
    gives = 1.0 / entry_of(designs.radial_stiffness, n, first), 1.0 / entry_of(designs.radial_stiffness, n, 1 - first)
    for i in range(delta.shape[1]):
        x = entry_of(designs.stations, n, i) - start
        for j in range(i + 1):
            entry = flexibility_entry(x, entry_of(designs.stations, n, j) - start, span, bend, slip, *gives)
            delta[n, i, j], delta[n, j, i] = entry, entry
        if wanted:
            carried[n, first, i], carried[n, 1 - first, i] = reaction_shares(x, span)


@inner
def _fill_two_sided(designs, sections, n, work, delta, carried, wanted):
    """The same of any shaft: both sides of every station as springs, then the force carried outwards from it.

    Arrays as for `_fill_closed_form`.
    """
    bearings, points = carried.shape[1], work.order.size
    _sort_points(designs, n, bearings, work)
    _divide_shaft(designs, sections, n, work)
    _condense_side(designs, n, bearings, work, 1)
    _condense_side(designs, n, bearings, work, -1)
    for p in range(points):
        i = work.order[p] - bearings
        if i < 0:
            continue
        u1, c1, q1 = work.sides[0, p]
        u2, c2, q2 = work.sides[1, p]
        u, c, q = _in_parallel(u1, c1, q1, u2, -c2, q2)
        turn = c / q if q > 0.0 else np.nan
        w = u + c * turn
        delta[n, i, i] = w
        # The unit force parts between the sides; a side next to rigid has its share from the other's, for w of its own is nearly 0.
        right = (w + c2 * turn) / u2 if u2 > u1 else 1.0 - (w - c1 * turn) / u1
        _carry_outwards(designs, n, bearings, work, p, 1, w, turn, right, delta, carried, wanted)
        if wanted:
            _carry_outwards(designs, n, bearings, work, p, -1, w, -turn, 1.0 - right, delta, carried, wanted)


@inner
def _sort_points(designs, n, bearings, work):
    """Points from left to right, supports before stations at the same place."""
    for k in range(work.order.size):
        x = entry_of(designs.supports, n, k) if k < bearings else entry_of(designs.stations, n, k - bearings)
        p = k
        while p > 0 and work.place[p - 1] > x:
            work.place[p], work.order[p] = work.place[p - 1], work.order[p - 1]
            p -= 1
        work.place[p], work.order[p] = x, k


@inner
def _divide_shaft(designs, sections, n, work):
    """f, g, r of the shaft between neighbouring points, joined from the parts that the sections make of it."""
    modulus, poisson, shear = entry_of(designs.youngs_modulus, n, 0), entry_of(designs.poisson, n, 0), entry_of(designs.shear, n, 0)
    s, begin, length, fresh = 0, 0.0, entry_of(designs.lengths, n, 0), True
    start, end, bore, bend, slip = 0.0, 0.0, 0.0, 0.0, 0.0
    for p in range(work.order.size - 1):
        x, stop = work.place[p], work.place[p + 1]
        f, g, r = 0.0, 0.0, 0.0
        while x < stop:
            while s < sections - 1 and begin + length <= x:
                s, begin, fresh = s + 1, begin + length, True
                length = entry_of(designs.lengths, n, s)
            if fresh:
                start, end, bore, fresh = (
                    entry_of(designs.diameters, n, s),
                    entry_of(designs.end_diameters, n, s),
                    entry_of(designs.bores, n, s),
                    False,
                )
                if start == end:
                    bend, _, _, slip = compliance_integrals(1.0, start, end, bore, modulus, poisson, shear)
            to = min(stop, begin + length) if s < sections - 1 else stop
            part = to - x
            if start == end:
                f2, g2, r2 = bend * part, 0.5 * part, part * (bend * part * part / 12.0 + slip)
            else:
                slope = (end - start) / length
                f2, first, second, slide = compliance_integrals(
                    part, start + slope * (x - begin), start + slope * (to - begin), bore, modulus, poisson, shear
                )
                g2 = first / f2
                r2 = second - g2 * first + slide
            g2 += x - work.place[p]
            if f > 0.0:
                r += r2 + f * f2 / (f + f2) * (g2 - g) ** 2
                g += f2 / (f + f2) * (g2 - g)
            else:
                g, r = g2, r2
            f, x = f + f2, to
        work.pieces[p, 0], work.pieces[p, 1], work.pieces[p, 2], work.pieces[p, 3] = stop - work.place[p], f, g, r


@inner
def _condense_side(designs, n, bearings, work, step):
    """u, c, q of all that lies behind each point, walking right (step 1) or left (-1); c is the distance back."""
    points, side = work.order.size, (1 - step) // 2
    u, c, q = np.inf, 0.0, 0.0
    p = 0 if step > 0 else points - 1
    for _ in range(points):
        work.sides[side, p, 0], work.sides[side, p, 1], work.sides[side, p, 2] = u, c, q
        if work.order[p] < bearings:
            u, c, q = _in_parallel(u, c, q, _support_compliance(designs, n, work.order[p]), 0.0, 0.0)
        k = p if step > 0 else p - 1
        if 0 <= k < points - 1:
            length, f, r = work.pieces[k, 0], work.pieces[k, 1], work.pieces[k, 3]
            g = length - work.pieces[k, 2] if step > 0 else work.pieces[k, 2]
            c += length
            soft = 1.0 / (1.0 + q * f)
            u, c, q = u + r + f * soft * (c - g) ** 2, (c + q * f * g) * soft, q * soft
        p += step


@inner
def _carry_outwards(designs, n, bearings, work, p, step, w, turn, force, delta, carried, wanted):
    """Carry deflection, turn (positive: rising ahead) and the force into what lies ahead from the loaded station p outwards.

    delta (N, M, M) [m/N], carried (N, B, M) [-], of which the row of the design is written.
    """
    loaded, points, side = work.order[p] - bearings, work.order.size, (1 + step) // 2
    while 0 <= p + step < points:
        k = p if step > 0 else p - 1
        length, f, r = work.pieces[k, 0], work.pieces[k, 1], work.pieces[k, 3]
        g = work.pieces[k, 2] if step > 0 else length - work.pieces[k, 2]
        moment = work.sides[side, p, 2] * turn + force * (work.sides[side, p, 1] - g)
        w += length * turn - f * moment * (length - g) - force * r
        turn -= f * moment
        p += step
        point = work.order[p]
        if point >= bearings:
            if step > 0:
                delta[n, loaded, point - bearings], delta[n, point - bearings, loaded] = w, w
            continue
        give, ahead = _support_compliance(designs, n, point), work.sides[side, p, 0]
        if give == 0.0:
            w = 0.0  # but for rounding it is
        # The stiffer of the two has what the softer leaves, as above.
        on = (w + work.sides[side, p, 1] * turn) / ahead if give < ahead else force - w / give
        if wanted:
            carried[n, point, loaded] = force - on if give < ahead else w / give
        force = on


@inner
def _support_compliance(designs, n, bearing):
    """1/k [m/N] of a support; inf where it is absent."""
    stiffness = entry_of(designs.radial_stiffness, n, bearing)
    return 1.0 / stiffness if stiffness > 0.0 else np.inf


@inner
def _in_parallel(u1, c1, q1, u2, c2, q2):
    """Two sets of springs on one cross-section, both levers measured the same way; a free one (u = inf) has no tilt spring either."""
    if u1 == np.inf:
        return u2, c2, q2
    if u2 == np.inf:
        return u1, c1, q1
    part = 1.0 / (u1 + u2)
    return u1 * u2 * part, (c1 * u2 + c2 * u1) * part, q1 + q2 + (c1 - c2) ** 2 * part
