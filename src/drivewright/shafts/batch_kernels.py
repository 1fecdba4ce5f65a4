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
from drivewright.shafts.sections import compliance_integrals, cylinder_compliances

OFF = 1e-9  # part of the shaft's length by which a place may lie beyond its end: sums of lengths are rounded


LANES = 128  # designs that are checked, and taken by the closed form, at once: all that belongs to them stays in the first cache
# Rows of `BatchWorkspace.lanes`: an entry of every column, in the order of `DesignColumns`; then of the shaft; of the two supports of the
# closed form; of a pair of stations; then all stations, and the flexibilities of their pairs.
PART, DIAMETER, END_DIAMETER, BORE, SUPPORT, STIFFNESS, PLACE, MODULUS, POISSON, SHEAR = range(10)
POSSIBLE, UNIFORM, LENGTH, FIRST_DIAMETER, FIRST_BORE, START, SPAN, LEFT, RIGHT, TURNED, BEND, SLIP, X, S, ENTRY, STATION = range(10, 26)


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
    lanes: numbers of `LANES` designs side by side, a row of LANES for each; one array, so that the compiler sees that rows do not overlap.
    """

    order: Ints
    place: Floats
    pieces: Floats
    sides: Floats
    lanes: Floats


def workspace(bearings: int, stations: int) -> BatchWorkspace:
    """The `BatchWorkspace` for shafts with so many bearings and stations."""
    points, rows = bearings + stations, STATION + stations + stations * (stations + 1) // 2
    return BatchWorkspace(
        np.empty(points, np.int64), np.empty(points), np.empty((points, 4)), np.empty((2, points, 3)), np.ones(rows * LANES)
    )


@inner
def entry_of(column: DesignColumn, design: int, entry: int) -> float:
    """The number of one design and entry."""
    return column.values[design * column.row + entry * column.entry]


@inner
def fill_flexibilities(
    designs: DesignColumns, sections: int, begin: int, end: int, work: BatchWorkspace, delta: Floats, carried: Floats
) -> None:
    """Writes the rows begin ... end of delta (N, M, M) [m/N] and, where it has rows, carried (N, B, M) [-]."""
    bearings, wanted, lanes = carried.shape[1], carried.shape[0] > 0, work.lanes
    for first in range(begin, end, LANES):
        count = min(LANES, end - first)
        _check(designs, sections, bearings, delta.shape[1], first, count, lanes)
        if bearings == 2:
            _fill_closed_form(first, count, lanes, delta, carried, wanted)
        for k in range(count):
            if bearings != 2 or lanes[UNIFORM * LANES + k] == 0.0:
                possible = lanes[POSSIBLE * LANES + k] == 1.0
                if possible:
                    _fill_two_sided(designs, sections, first + k, work, delta, carried, wanted)
                if not (possible and np.isfinite(_total(first + k, delta, carried, wanted))):
                    _fill_nan(first + k, delta, carried, wanted)


@inner
def _total(n, delta, carried, wanted):
    """Sum of row n: finite where all of it is."""
    total = 0.0
    for i in range(delta.shape[1]):
        for j in range(delta.shape[1]):
            total += delta[n, i, j]
        for b in range(carried.shape[1] if wanted else 0):
            total += carried[n, b, i]
    return total


@inner
def _fill_nan(n, delta, carried, wanted):
    """Row n of an impossible design."""
    for i in range(delta.shape[1]):
        for j in range(delta.shape[1]):
            delta[n, i, j] = np.nan
        for b in range(carried.shape[1] if wanted else 0):
            carried[n, b, i] = np.nan


@inner
def _gather(column, entry, first, count, row):
    """An entry of `count` designs from the first on, side by side in a row; the rest of the row repeats the last of them."""
    source = column.values[first * column.row + entry * column.entry :]
    if column.row == 0:
        for k in range(count):
            row[k] = source[0]
    elif column.row == 1:
        for k in range(count):
            row[k] = source[k]
    else:
        apart = source[:: column.row]
        for k in range(count):
            row[k] = apart[k]
    for k in range(count, LANES):
        row[k] = row[count - 1]


@inner
def _check(designs, sections, bearings, stations, first, count, lanes):
    """Rows `POSSIBLE` and `UNIFORM`: 1 where sizes, material and places make a shaft, and where it has one diameter and one bore, else 0.

    Comparisons are turned so that nan fails.  What the closed form needs is kept: first section, two supports, stations.
    """
    for section in range(sections):
        for number in range(PART, SUPPORT):
            _gather(designs[number], section, first, count, lanes[number * LANES :])
        if section == 0:
            for number in range(MODULUS, SHEAR + 1):
                _gather(designs[number], section, first, count, lanes[number * LANES :])
            _check_material(lanes)
        for k in range(LANES):
            part, diameter = lanes[PART * LANES + k], lanes[DIAMETER * LANES + k]
            end_diameter, bore = lanes[END_DIAMETER * LANES + k], lanes[BORE * LANES + k]
            good = (part > 0.0) & (bore >= 0.0) & (diameter > bore) & (end_diameter > bore)
            same = (diameter == lanes[FIRST_DIAMETER * LANES + k]) & (end_diameter == diameter) & (bore == lanes[FIRST_BORE * LANES + k])
            lanes[POSSIBLE * LANES + k] *= 1.0 if good else 0.0
            lanes[UNIFORM * LANES + k] *= 1.0 if same else 0.0
            lanes[LENGTH * LANES + k] += part
    for bearing in range(bearings):
        for number in range(SUPPORT, PLACE):
            _gather(designs[number], bearing, first, count, lanes[number * LANES :])
        for k in range(LANES):
            lanes[PLACE * LANES + k] = lanes[SUPPORT * LANES + k]
            lanes[POSSIBLE * LANES + k] *= 1.0 if lanes[STIFFNESS * LANES + k] >= 0.0 else 0.0
        _check_place(lanes)
        if bearing < 2:
            for k in range(LANES):
                lanes[(START + bearing) * LANES + k] = lanes[PLACE * LANES + k]
                lanes[(LEFT + bearing) * LANES + k] = lanes[STIFFNESS * LANES + k]
    for station in range(stations):
        _gather(designs[PLACE], station, first, count, lanes[PLACE * LANES :])
        _check_place(lanes)
        for k in range(LANES):
            lanes[(STATION + station) * LANES + k] = lanes[PLACE * LANES + k]


@inner
def _check_material(lanes):
    """Rows `POSSIBLE`, `UNIFORM`, `LENGTH` and those of the first section as they are before its sizes are looked at."""
    for k in range(LANES):
        modulus, poisson, shear = lanes[MODULUS * LANES + k], lanes[POISSON * LANES + k], lanes[SHEAR * LANES + k]
        good = (modulus > 0.0) & (poisson > -1.0) & (poisson < 0.5) & (abs(shear) < np.inf)
        lanes[POSSIBLE * LANES + k], lanes[UNIFORM * LANES + k], lanes[LENGTH * LANES + k] = 1.0 if good else 0.0, 1.0, 0.0
        lanes[FIRST_DIAMETER * LANES + k], lanes[FIRST_BORE * LANES + k] = lanes[DIAMETER * LANES + k], lanes[BORE * LANES + k]


@inner
def _check_place(lanes):
    """Row `POSSIBLE` becomes 0 where row `PLACE` is off the shaft."""
    for k in range(LANES):
        place, length = lanes[PLACE * LANES + k], lanes[LENGTH * LANES + k]
        good = (place >= -OFF * length) & (place <= (1.0 + OFF) * length)
        lanes[POSSIBLE * LANES + k] *= 1.0 if good else 0.0


@inner
def _fill_closed_form(first, count, lanes, delta, carried, wanted):
    """Rows of delta (N, M, M) [m/N] and, where wanted, of carried (N, B, M) [-], as uniform shafts on two supports: `closed_form`."""
    stations = delta.shape[1]
    _measure_from_left(lanes)
    for k in range(LANES):
        diameter, bore = lanes[FIRST_DIAMETER * LANES + k], lanes[FIRST_BORE * LANES + k]
        modulus, poisson, shear = lanes[MODULUS * LANES + k], lanes[POISSON * LANES + k], lanes[SHEAR * LANES + k]
        lanes[BEND * LANES + k], lanes[SLIP * LANES + k] = cylinder_compliances(diameter, bore, modulus, poisson, shear)
    row = STATION + stations
    for i in range(stations):
        for j in range(i + 1):
            for k in range(LANES):  # rows of known number from here, or the compiler has to look whether rows overlap
                lanes[X * LANES + k], lanes[S * LANES + k] = lanes[(STATION + i) * LANES + k], lanes[(STATION + j) * LANES + k]
            for k in range(LANES):
                start, span = lanes[START * LANES + k], lanes[SPAN * LANES + k]
                x, s = lanes[X * LANES + k] - start, lanes[S * LANES + k] - start
                bend, slip = lanes[BEND * LANES + k], lanes[SLIP * LANES + k]
                entry = flexibility_entry(x, s, span, bend, slip, lanes[LEFT * LANES + k], lanes[RIGHT * LANES + k])
                lanes[ENTRY * LANES + k] = entry
                lanes[POSSIBLE * LANES + k] = lanes[POSSIBLE * LANES + k] if abs(entry) < np.inf else 0.0
            for k in range(LANES):
                lanes[row * LANES + k] = lanes[ENTRY * LANES + k]
            row += 1
    rows, row = delta[first:], STATION + stations
    for i in range(stations):
        for j in range(i + 1):
            entries = lanes[row * LANES :]
            for k in range(count):
                entry = entries[k] if lanes[POSSIBLE * LANES + k] == 1.0 else np.nan
                rows[k, i, j], rows[k, j, i] = entry, entry
            row += 1
        for k in range(count if wanted else 0):
            left, right = reaction_shares(lanes[(STATION + i) * LANES + k] - lanes[START * LANES + k], lanes[SPAN * LANES + k])
            turned, possible = lanes[TURNED * LANES + k] == 1.0, lanes[POSSIBLE * LANES + k] == 1.0
            carried[first + k, 0, i] = (right if turned else left) if possible else np.nan
            carried[first + k, 1, i] = (left if turned else right) if possible else np.nan


@inner
def _measure_from_left(lanes):
    """Places and stiffness of two supports become place `START` of the left one, distance `SPAN` to the other, what they yield [m/N].

    `TURNED` is 1 where the left one is the second.
    """
    for k in range(LANES):
        one, two, stiffness, other = lanes[START * LANES + k], lanes[SPAN * LANES + k], lanes[LEFT * LANES + k], lanes[RIGHT * LANES + k]
        turned = two < one
        lanes[TURNED * LANES + k], lanes[SPAN * LANES + k] = 1.0 if turned else 0.0, abs(two - one)
        lanes[START * LANES + k] = two if turned else one
        lanes[LEFT * LANES + k], lanes[RIGHT * LANES + k] = 1.0 / (other if turned else stiffness), 1.0 / (stiffness if turned else other)


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
