"""The compiled loop over the steps of a batch, the same for every method and every system."""

import numpy as np

from drivewright._jit import inner, per_lane
from drivewright._typing import Floats
from drivewright.numerics.lanes import any_lane, where
from drivewright.numerics.ode.locating import STOPPED, SWITCHED, EventRules, StepBatch, end_step, values_at
from drivewright.numerics.ode.method import ERROR, STEP, TIME, StepControl, begin, carry_over, interpolate, restart, step
from drivewright.numerics.ode.system import copy, copy_where, events_at

GOES_ON, FINISHED, EVENT, MIN_STEP, NOT_FINITE = range(5)


@inner
def start(work: object, system: object, event_system: object, control: StepControl, clock: Floats, y: Floats, values: Floats) -> int:
    """Rate, first step and event functions (m,) at the start y (n,); GOES_ON, or NOT_FINITE."""
    begin(work, system, control, clock, y)
    events_at(event_system, clock[TIME], y, values)
    return GOES_ON if np.isfinite(clock[ERROR]) else NOT_FINITE


@inner
def advance(
    work: object,
    system: object,
    event_system: object,
    switch_system: object,
    control: StepControl,
    rules: EventRules,
    clock: Floats,
    y: Floats,
    values: Floats,
    batch: StepBatch,
) -> tuple[int, int, int, int]:
    """Step until the batch is full or the run ends; returns (code, accepted steps, rejected steps, event hits).

    The workspace, clock (3,), state y (n,) and event functions (m,) are carried from batch to batch; a batch without room for a step
    sets them up at the start.
    A step ends at the first event that stops the run or switches the system; what would come after it is not seen.
    """
    trial, accepted, rejected, hits = batch.trial, 0, 0, 0
    if len(batch.steps) == 0:
        return start(work, system, event_system, control, clock, y, values), accepted, rejected, hits
    again = rejected > 0  # False, but not as a constant, for which numba would compile `step` once more
    while accepted < len(batch.steps):
        t, h = clock[TIME], min(clock[STEP], control.max_step)
        last = t + 1.000001 * h >= control.t1  # no tiny step is left over
        if last:
            h = control.t1 - t
        elif h < control.min_step:
            return (MIN_STEP if np.isfinite(clock[ERROR]) else NOT_FINITE), accepted, rejected, hits
        again = not step(work, system, control, clock, t, h, again, y, trial)
        if again:
            rejected += 1
            continue
        interpolate(work, h, y, trial, batch.dense[accepted])
        batch.steps[accepted, 0], batch.steps[accepted, 1] = t, h
        clock[TIME] = control.t1 if last else t + h
        copy(trial, y)
        carry_over(work, system, clock[TIME], y, True)
        events_at(event_system, clock[TIME], y, batch.values_after)
        if rules.search_inside:
            values_at(event_system, t, h, batch.dense[accepted], 0.5, trial, batch.values_middle)
        hits, end = end_step(event_system, switch_system, rules, clock, y, values, batch, accepted, hits)
        accepted += 1
        if end == STOPPED:
            return EVENT, accepted, rejected, hits
        if end == SWITCHED:
            restart(work, system, control, clock, y)
            events_at(event_system, clock[TIME], y, values)
            last = clock[TIME] >= control.t1
        if last:
            return FINISHED, accepted, rejected, hits
    return GOES_ON, accepted, rejected, hits


ACCEPTED, REJECTED, HITS, OUTCOME, AGAIN = range(5)  # of each case that steps with others; AGAIN: its last step failed


@inner
def advance_together(
    work: object,
    system: object,
    event_system: object,
    switch_system: object,
    control: StepControl,
    rules: EventRules,
    clock: Floats,
    y: Floats,
    values: Floats,
    batch: StepBatch,
    counts: Floats,
    dense: Floats,
) -> None:
    """`advance` for many cases in lanes, each with steps of its own: until a run ends, or the batch of one is full.

    counts (5,): accepted and rejected steps, event hits, the outcome, and 1 where a step is tried again, all in lanes; a case takes part
    while its outcome is GOES_ON.
    dense (5, n): scratch, the polynomials of a step.
    """
    trial, rounds = batch.trial, 0
    while rounds < len(batch.steps):
        runs = counts[OUTCOME] == GOES_ON
        t, h = clock[TIME], min(clock[STEP], control.max_step)
        last = t + 1.000001 * h >= control.t1
        h = where(last, control.t1 - t, h)
        too_short = runs & ~last & (h < control.min_step)
        if any_lane(too_short):
            counts[OUTCOME] = where(too_short, where(is_finite(clock[ERROR]), MIN_STEP, NOT_FINITE), counts[OUTCOME])
            return
        h = where(runs, h, 0.0)
        good = step(work, system, control, clock, t, h, counts[AGAIN] > 0.0, y, trial) & runs
        counts[AGAIN] = where(runs & ~good, 1.0, 0.0)
        counts[REJECTED] += counts[AGAIN]
        interpolate(work, h, y, trial, dense)
        clock[TIME] = where(good, where(last, control.t1, t + h), t)
        copy_where(good, trial, y)
        carry_over(work, system, clock[TIME], y, good)
        events_at(event_system, clock[TIME], y, batch.values_after)
        if rules.search_inside:
            values_at(event_system, t, h, dense, 0.5, trial, batch.values_middle)
        switched = end_step_of(event_system, switch_system, rules, clock, y, values, batch, counts, dense, t, h, good)
        if any_lane(switched):
            restart(work, system, control, clock, y)  # where nothing switched the rates come out as they were
            events_at(event_system, clock[TIME], y, batch.values_after)
            copy_where(switched, batch.values_after, values)
            last = where(switched, clock[TIME] >= control.t1, last)
        counts[OUTCOME] = where(good & last & (counts[OUTCOME] == GOES_ON), FINISHED, counts[OUTCOME])
        if any_lane(runs & (counts[OUTCOME] != GOES_ON)):
            return
        rounds += 1


@per_lane
def is_finite(number: float) -> bool:
    """Whether a number is one."""
    return np.isfinite(number)


@per_lane
def end_step_of(
    event_system: object,
    switch_system: object,
    rules: EventRules,
    clock: Floats,
    y: Floats,
    values: Floats,
    batch: StepBatch,
    counts: Floats,
    dense: Floats,
    t: float,
    h: float,
    is_good: bool,
) -> bool:
    """Enter a good step of one case into its batch, with the events in it; whether one of them switched the system.

    The arrays are those of `advance_together`, of one case.
    """
    if not is_good:
        return False
    row = int(counts[ACCEPTED])
    batch.steps[row, 0], batch.steps[row, 1] = t, h
    for c in range(dense.shape[0]):
        for i in range(y.size):
            batch.dense[row, c, i] = dense[c, i]
    hits, end = end_step(event_system, switch_system, rules, clock, y, values, batch, row, int(counts[HITS]))
    counts[ACCEPTED] += 1.0
    counts[HITS] = hits
    if end == STOPPED:
        counts[OUTCOME] = EVENT
    return end == SWITCHED
