"""Kernels of `numerics.ode`: the method of Dormand and Prince, step by step, for any system of numbers.

Dormand & Prince, J. Comp. Appl. Math. 6 (1980); interpolant of order 4 and step control: Hairer, Norsett & Wanner, Solving
Ordinary Differential Equations I (code DOPRI5).  Both recalled; the tests check every order condition.
"""

from typing import NamedTuple

import numpy as np

from drivewright._jit import generic, implements, inner, outer

_C = np.array([0, 1 / 5, 3 / 10, 4 / 5, 8 / 9, 1, 1])
_A = np.array(
    [
        [0, 0, 0, 0, 0, 0],
        [1 / 5, 0, 0, 0, 0, 0],
        [3 / 40, 9 / 40, 0, 0, 0, 0],
        [44 / 45, -56 / 15, 32 / 9, 0, 0, 0],
        [19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729, 0, 0],
        [9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656, 0],
        [35 / 384, 0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84],  # also the result: the last stage is the first of the next step
    ]
)
_ERROR = np.array([71 / 57600, 0, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40])  # order 5 minus order 4
_DENSE = np.array(
    [
        -12715105075 / 11282082432,
        0,
        87487479700 / 32700410799,
        -10690763975 / 1880347072,
        701980252875 / 199316789632,
        -1453857185 / 822651844,
        69997945 / 29380423,
    ]
)

GOES_ON, FINISHED, EVENT, MIN_STEP, NOT_FINITE = range(5)


@generic
def rate(system, t, y, dy):
    """Write the derivative of the state y at time t into dy."""


@generic
def events(system, t, y, values):
    """Write the event functions at (t, y) into `values`; an event happens where one of them changes sign."""


@generic
def switch(system, index, t, y):
    """Event number `index` has happened at (t, y): change y, where the system starts anew from here."""


class Unwatched(NamedTuple):
    """Stands for the system where nobody watches for events."""

    nothing: int


@implements(events, Unwatched)
def _(system, t, y, values):
    pass


@implements(switch, Unwatched)
def _(system, index, t, y):
    pass


class Watch(NamedTuple):
    """What to do about each event function: sign change that counts (+1, -1, 0 any), and NOTE, STOP or SWITCH."""

    directions: np.ndarray
    effects: np.ndarray
    inside: bool  # look inside the steps for what crosses and comes back: for events that switch


NOTE, STOP, SWITCH = range(3)
NEARLY = 0.25  # a parabola whose vertex comes so near to 0, against its ends, is worth a look
AFTER_SWITCH = 0.1  # of the step before: what begins at a switch is often faster than what went before


class Settings(NamedTuple):
    t1: float
    rtol: float
    atol: np.ndarray
    max_step: float
    min_step: float


class Batch(NamedTuple):
    """Room for a batch of steps."""

    steps: np.ndarray  # (m, 2): start, size
    dense: np.ndarray  # (m, 5, n): coefficients of the interpolant
    hits: np.ndarray  # (m * events, 3): row of the step, number of the event function, fraction of the step
    found: np.ndarray  # (m * events, n): states at the hits, switched where they switched
    trial: np.ndarray  # scratch: a state
    after: np.ndarray  # and three rows of event values
    middle: np.ndarray
    between: np.ndarray


@outer
def refresh(system, watched, clock, y, k, values):
    """Rates and event functions at a new state."""
    rate_at(system, clock[0], y, k[0])
    events_at(watched, clock[0], y, values)


@outer
def rate_at(system, t, y, dy):
    """`rate`, compiled once for the places where it is not called often."""
    rate(system, t, y, dy)


@outer
def events_at(watched, t, y, values):
    """`events`, likewise."""
    events(watched, t, y, values)


@outer
def switch_at(switched, index, t, y):
    """`switch`, likewise."""
    switch(switched, index, t, y)


@outer
def begin(system, watched, settings, clock, y, k, values):
    """Rates and event functions at the start, and a first step: a hundredth of the time in which y changes by its size."""
    refresh(system, watched, clock, y, k, values)
    size = change = 0.0
    for i in range(y.size):
        scale = settings.atol[i] + settings.rtol * abs(y[i])
        size += (y[i] / scale) ** 2
        change += (k[0, i] / scale) ** 2
    if not np.isfinite(change):
        return NOT_FINITE
    first = 0.01 * np.sqrt(size / change) if min(size, change) > 1e-10 else 1e-6 * (settings.t1 - clock[0])
    clock[1] = max(first, settings.min_step)
    return GOES_ON


@outer
def advance(system, watched, switched, settings, watch, clock, y, k, values, batch):
    """Step until the batch is full or the run ends; returns (code, accepted steps, rejected steps, event hits).

    clock = (time, next step, last error); clock, y, k and the event values are carried from batch to batch.
    A step ends at the first event that stops the run or switches the system; what would come after it is not seen.
    """
    trial, after = batch.trial, batch.after
    accepted = rejected = hits = 0
    most = 5.0
    while accepted < len(batch.steps):
        t, h = clock[0], min(clock[1], settings.max_step)
        last = t + 1.000001 * h >= settings.t1  # no tiny step is left over
        if last:
            h = settings.t1 - t
        elif h < settings.min_step:
            return (MIN_STEP if np.isfinite(clock[2]) else NOT_FINITE), accepted, rejected, hits
        _stages(system, t, h, y, k, trial)
        error = _error(h, y, trial, k, settings)
        clock[1] = h * _growth(error, clock, most)
        if not error <= 1.0:  # nan is no success either
            rejected, most = rejected + 1, 1.0
            continue
        most = 5.0
        _interpolant(h, y, trial, k, batch.dense[accepted])
        batch.steps[accepted, 0], batch.steps[accepted, 1] = t, h
        clock[0] = settings.t1 if last else t + h
        _copy(trial, y)
        _copy(k[6], k[0])
        events_at(watched, clock[0], y, after)
        known = hits
        hits, ender = _watch(watched, watch, values, after, trial, accepted, batch, hits)
        _copy(after, values)
        accepted += 1
        if ender >= 0:
            _go_back(clock, y, batch, ender)
            if _happen(switched, watch, clock[0], y, batch, known, hits, ender):
                return EVENT, accepted, rejected, hits
            refresh(system, watched, clock, y, k, values)
        elif last:
            return FINISHED, accepted, rejected, hits
    return GOES_ON, accepted, rejected, hits


@inner
def _copy(source, target):
    # target[:] = source would cost three seconds of compiling, for the message on unequal shapes.
    for i in range(source.size):
        target[i] = source[i]


@inner
def _stages(system, t, h, y, k, trial):
    """Rates k[1..6] of the step from (t, y), k[0] being known, and its result in `trial`."""
    for stage in range(1, 7):
        _copy(y, trial)
        for j in range(stage):
            weight = h * _A[stage, j]
            for i in range(y.size):
                trial[i] += weight * k[j, i]
        rate(system, t + _C[stage] * h, trial, k[stage])


@inner
def _error(h, y, trial, k, settings):
    """Root mean square of the estimated error over its tolerance."""
    total = 0.0
    for i in range(y.size):
        error = 0.0
        for j in range(7):
            error += _ERROR[j] * k[j, i]
        total += (h * error / (settings.atol[i] + settings.rtol * max(abs(y[i]), abs(trial[i])))) ** 2
    return np.sqrt(total / y.size)


@inner
def _growth(error, clock, most):
    """Factor on the step: proportional-integral control, which settles where pure error control would hunt."""
    if not np.isfinite(error):
        clock[2] = np.nan
        return 0.1
    previous = clock[2] if np.isfinite(clock[2]) else 1e-4
    if error > 1.0:
        clock[2] = previous
        return max(0.2, 0.9 * error**-0.17)
    clock[2] = max(error, 1e-4)
    return min(most, max(0.2, 0.9 * max(error, 1e-8) ** -0.17 * previous**0.04))


@inner
def _interpolant(h, y, trial, k, dense):
    """Coefficients of the polynomial through both ends of the step, with their slopes, and of order 4 between."""
    for i in range(y.size):
        bend = 0.0
        for j in range(7):
            bend += _DENSE[j] * k[j, i]
        rise = trial[i] - y[i]
        dense[0, i] = y[i]
        dense[1, i] = rise
        dense[2, i] = h * k[0, i] - rise
        dense[3, i] = rise - h * k[6, i] - dense[2, i]
        dense[4, i] = h * bend


@inner
def _watch(watched, watch, before, after, y, row, batch, hits):
    """Record the events within step `row`, up to the first that ends it: (number of hits, which of them ends it or -1).  y is scratch."""
    if after.size == 0:
        return hits, -1
    found, first = hits, 2.0
    if watch.inside:
        values_at(watched, 0.5, batch, row, y, batch.middle)
    for index in range(after.size):
        inside = 1.0
        if watch.inside:
            inside = _excursion(watched, index, before[index], batch.middle[index], after[index], batch, row, y)
        low, start = 0.0, before[index]
        for high in (inside, 1.0):  # into an excursion and back; or, inside being 1, to the end of the step
            crosses = high > low and (high < 1.0 or start < 0.0 <= after[index] or start > 0.0 >= after[index])
            if crosses and ((start < 0.0 and watch.directions[index] >= 0) or (start > 0.0 and watch.directions[index] <= 0)):
                theta = _locate(watched, index, start, low, high, batch, row, y)
                batch.hits[found, 0], batch.hits[found, 1], batch.hits[found, 2] = row, index, theta
                if watch.effects[index] != NOTE and theta < first:
                    first = theta
                found += 1
            low, start = high, -start
    return _cut(watch, first, found, y, row, batch, hits)


@inner
def _excursion(watched, index, before, middle, after, batch, row, y):
    """Fraction of the step where an event function has the other sign although both ends have the same; 1 where it has not.

    Looked for in the middle, and at the vertex of the parabola through both ends and the middle.
    """
    if not before * after > 0.0:
        return 1.0
    if middle * before < 0.0:
        return 0.5
    bend = 2.0 * (before - 2.0 * middle + after)
    slope = after - before - bend
    if bend * before > 0.0 and slope * bend < 0.0 and abs(slope) < 2.0 * abs(bend):
        extreme = before - 0.25 * slope * slope / bend
        if extreme * before < NEARLY * before * before or extreme * before < NEARLY * after * before:
            vertex = -0.5 * slope / bend
            values_at(watched, vertex, batch, row, y, batch.between)
            if batch.between[index] * before < 0.0:
                return vertex
    return 1.0


@outer
def values_at(watched, theta, batch, row, y, values):
    """Event functions at a fraction of a step; y is scratch."""
    for i in range(y.size):
        y[i] = _point(batch.dense[row], i, theta)
    events_at(watched, batch.steps[row, 0] + theta * batch.steps[row, 1], y, values)


@inner
def _cut(watch, first, found, y, row, batch, hits):
    """Keep of the new hits those up to the fraction `first`: (number of hits, which of them ends the step or -1)."""
    ender = -1
    for n in range(hits, found):
        if batch.hits[n, 2] <= first:
            for column in range(3):
                batch.hits[hits, column] = batch.hits[n, column]
            if batch.hits[hits, 2] == first and watch.effects[int(batch.hits[hits, 1])] != NOTE:
                ender = hits
            for i in range(y.size):
                batch.found[hits, i] = _point(batch.dense[row], i, batch.hits[hits, 2])
            hits += 1
    return hits, ender


@inner
def _go_back(clock, y, batch, hit):
    """To the event within the step just done; the next step is a careful one."""
    row, theta = int(batch.hits[hit, 0]), batch.hits[hit, 2]
    _copy(batch.found[hit], y)
    clock[0] = batch.steps[row, 0] + theta * batch.steps[row, 1]
    clock[1] = AFTER_SWITCH * batch.steps[row, 1]


@inner
def _happen(switched, watch, t, y, batch, known, hits, ender):
    """Switch the system at every event at the end of the step, for several may coincide; whether one of them stops the run."""
    stops, theta = False, batch.hits[ender, 2]
    for n in range(known, hits):
        index = int(batch.hits[n, 1])
        if batch.hits[n, 2] == theta and watch.effects[index] == STOP:
            stops = True
        elif batch.hits[n, 2] == theta and watch.effects[index] == SWITCH:
            switch_at(switched, index, t, y)
    for n in range(known, hits):
        if batch.hits[n, 2] == theta and watch.effects[int(batch.hits[n, 1])] == SWITCH:
            _copy(y, batch.found[n])
    return stops


@outer
def _locate(watched, index, before, low, high, batch, row, y):
    """Fraction of the step just after the sign change between two fractions.

    Bisection, for it ends on the far side: a run that starts again from there does not meet the same event at once.
    """
    for _ in range(53):
        theta = 0.5 * (low + high)
        values_at(watched, theta, batch, row, y, batch.between)
        if batch.between[index] * before > 0.0:
            low = theta
        else:
            high = theta
    return high


@inner
def _point(dense, i, theta):
    """`_polynomial` of one component."""
    return dense[0, i] + theta * (dense[1, i] + (1 - theta) * (dense[2, i] + theta * (dense[3, i] + (1 - theta) * dense[4, i])))
