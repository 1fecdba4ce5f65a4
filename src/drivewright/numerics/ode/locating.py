"""Events within a step: sign changes of the event functions along the step's polynomial, and what they do to the run."""

from typing import NamedTuple

from drivewright._jit import by_reference, inner
from drivewright._typing import Floats, Ints
from drivewright.numerics.ode.dense_output import component
from drivewright.numerics.ode.method import STEP, TIME
from drivewright.numerics.ode.system import copy, events_at, switch_at

NOTE, STOP, SWITCH = range(3)
CONTINUES, SWITCHED, STOPPED = range(3)  # a run after a step
VERTEX_NEAR = 0.25  # a parabola whose vertex comes so near to 0, against its ends, is examined there
LOCATED = 2.0**-40  # of a step: how narrow the place of an event is; rounding of the event functions hides more
STEP_AFTER_EVENT = 0.1  # of the step before: what begins at a switch is often faster than what went before


@by_reference
class EventRules(NamedTuple):
    """Of each event function: the sign change that counts (+1, -1, 0 any), and its effect, NOTE, STOP or SWITCH."""

    directions: Ints  # (m,)
    effects: Ints  # (m,)
    search_inside: bool  # look inside the steps for what crosses and comes back: for events that switch


@by_reference
class StepBatch(NamedTuple):
    """The steps of a batch of at most s steps, and the events within them."""

    steps: Floats  # (s, 2): start, size
    dense: Floats  # (s, 5, n): coefficients of the polynomials
    hits: Floats  # (2 s m, 3): row of the step, number of the event function, fraction of the step
    hit_states: Floats  # (2 s m, n): states at the hits, switched where they switched
    trial: Floats  # (n,) scratch
    values_after: Floats  # (m,) scratch: event functions at the end of a step, in its middle, and between
    values_middle: Floats
    values_between: Floats


@inner
def record_events(
    event_system: object, rules: EventRules, before: Floats, after: Floats, y: Floats, row: int, batch: StepBatch, hits: int
) -> tuple[int, int]:
    """Record the events within step `row`, up to the first that ends it: (number of hits, which of them ends it or -1).

    before, after (m,): event functions at both ends of the step, those in its middle being in the batch; y (n,) is scratch.
    """
    if after.size == 0:
        return hits, -1
    total, first = hits, 2.0
    for index in range(after.size):
        inside = 1.0
        if rules.search_inside:
            inside = _excursion(event_system, index, before[index], batch.values_middle[index], after[index], batch, row, y)
        low, start = 0.0, before[index]
        for high in (inside, 1.0):  # into an excursion and back; or, inside being 1, to the end of the step
            crosses = high > low and (high < 1.0 or start < 0.0 <= after[index] or start > 0.0 >= after[index])
            if crosses and ((start < 0.0 and rules.directions[index] >= 0) or (start > 0.0 and rules.directions[index] <= 0)):
                theta = _locate(event_system, index, start, low, high, batch, row, y)
                batch.hits[total, 0], batch.hits[total, 1], batch.hits[total, 2] = row, index, theta
                if rules.effects[index] != NOTE and theta < first:
                    first = theta
                total += 1
            low, start = high, -start
    return _keep_until(rules, first, total, y, row, batch, hits)


@inner
def _excursion(event_system, index, before, middle, after, batch, row, y):
    """Fraction of the step where an event function has the other sign although both ends have the same; 1 where it has not.

    Looked for in the middle, and at the vertex of the parabola through both ends and the middle.

    y (n,): scratch.
    """
    if not before * after > 0.0:
        return 1.0
    if middle * before < 0.0:
        return 0.5
    curvature = 2.0 * (before - 2.0 * middle + after)
    slope = after - before - curvature
    if curvature * before > 0.0 and slope * curvature < 0.0 and abs(slope) < 2.0 * abs(curvature):
        extreme = before - 0.25 * slope * slope / curvature
        if extreme * before < VERTEX_NEAR * before * before or extreme * before < VERTEX_NEAR * after * before:
            vertex = -0.5 * slope / curvature
            if value_at(event_system, index, vertex, batch, row, y) * before < 0.0:
                return vertex
    return 1.0


@inner
def values_at(event_system: object, t: float, h: float, dense: Floats, theta: float, y: Floats, values: Floats) -> None:
    """Event functions (m,) at the fraction theta of the step h from t into `values`; dense (5, n), y (n,) is scratch."""
    for i in range(y.size):
        y[i] = component(dense, i, theta)
    events_at(event_system, t + theta * h, y, values)


@inner
def _keep_until(rules, first, total, y, row, batch, hits):
    """Keep of the new hits those up to the fraction `first`: (number of hits, which of them ends the step or -1).

    y (n,): the shape of a state.
    """
    ender = -1
    for n in range(hits, total):
        if batch.hits[n, 2] <= first:
            for column in range(3):
                batch.hits[hits, column] = batch.hits[n, column]
            if batch.hits[hits, 2] == first and rules.effects[int(batch.hits[hits, 1])] != NOTE:
                ender = hits
            for i in range(y.size):
                batch.hit_states[hits, i] = component(batch.dense[row], i, batch.hits[hits, 2])
            hits += 1
    return hits, ender


@inner
def end_step(
    event_system: object,
    switch_system: object,
    rules: EventRules,
    clock: Floats,
    y: Floats,
    values: Floats,
    batch: StepBatch,
    row: int,
    hits: int,
) -> tuple[int, int]:
    """Events within the step `row` that is done, and what they do: (number of hits, CONTINUES, SWITCHED or STOPPED).

    clock (3,), y (n,) and values (m,) are those at its end, or at the event that ends it.
    """
    known = hits
    hits, ender = record_events(event_system, rules, values, batch.values_after, batch.trial, row, batch, hits)
    copy(batch.values_after, values)
    if ender < 0:
        return hits, CONTINUES
    return_to_event(clock, y, batch, ender)
    stops = apply_switches(switch_system, rules, clock[TIME], y, batch, known, hits, ender)
    return hits, STOPPED if stops else SWITCHED


@inner
def return_to_event(clock: Floats, y: Floats, batch: StepBatch, hit: int) -> None:
    """Clock and state y (n,) back to the event within the step just done; the next step is a careful one."""
    row, theta = int(batch.hits[hit, 0]), batch.hits[hit, 2]
    copy(batch.hit_states[hit], y)
    clock[TIME] = batch.steps[row, 0] + theta * batch.steps[row, 1]
    clock[STEP] = STEP_AFTER_EVENT * batch.steps[row, 1]


@inner
def apply_switches(
    switch_system: object, rules: EventRules, t: float, y: Floats, batch: StepBatch, known: int, hits: int, ender: int
) -> bool:
    """Switch the system at every event at the end of the step, for several may coincide; whether one of them stops the run.

    y (n,), in place.
    """
    stops, theta = False, batch.hits[ender, 2]
    for n in range(known, hits):
        index = int(batch.hits[n, 1])
        if batch.hits[n, 2] == theta and rules.effects[index] == STOP:
            stops = True
        elif batch.hits[n, 2] == theta and rules.effects[index] == SWITCH:
            switch_at(switch_system, index, t, y)
    for n in range(known, hits):
        if batch.hits[n, 2] == theta and rules.effects[int(batch.hits[n, 1])] == SWITCH:
            copy(y, batch.hit_states[n])
    return stops


@inner
def _locate(event_system, index, before, low, high, batch, row, y):
    """Fraction of the step just after the sign change between two fractions: on the far side, lest a run that starts again from there
    meets the same event at once.

    The ITP method (Oliveira & Takahashi, ACM Trans. Math. Softw. 47 (2020), recalled): the secant's zero, moved a little towards the
    middle and kept so near to it that in the worst case there is one step more than bisection has.

    y (n,): scratch.
    """
    one = abs(value_at(event_system, index, low, batch, row, y))
    two = -abs(value_at(event_system, index, high, batch, row, y))
    moved = 0.2 / (high - low)
    reach = high - low  # twice what is left of an interval that is halved every time, and one step more
    while high - low > LOCATED:
        middle, half = 0.5 * (low + high), 0.5 * (high - low)
        secant = (one * high - two * low) / (one - two) if one > two else middle
        side = 1.0 if secant < middle else -1.0
        inward = secant + side * moved * 4.0 * half * half
        spare = reach - half
        theta = middle if (middle - inward) * side <= 0.0 else middle - side * min((middle - inward) * side, spare)
        if not low < theta < high:
            theta = middle
        value = value_at(event_system, index, theta, batch, row, y)
        if value * before > 0.0:
            low, one = theta, abs(value)
        else:
            high, two = theta, -abs(value)
        reach *= 0.5
    return high


@inner
def value_at(event_system: object, index: int, theta: float, batch: StepBatch, row: int, y: Floats) -> float:
    """One event function at a fraction of step `row`; y (n,) is scratch."""
    values_at(event_system, batch.steps[row, 0], batch.steps[row, 1], batch.dense[row], theta, y, batch.values_between)
    return batch.values_between[index]
