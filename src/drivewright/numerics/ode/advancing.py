"""The compiled loop over the steps of a batch, the same for every method and every system."""

import numpy as np

from drivewright._jit import inner
from drivewright._typing import Floats
from drivewright.numerics.ode.locating import EventRules, StepBatch, apply_switches, record_events, return_to_event
from drivewright.numerics.ode.method import ERROR, STEP, TIME, StepControl, begin, carry_over, interpolate, restart, step
from drivewright.numerics.ode.system import copy, events_at

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

    The workspace, clock (3,), state y (n,) and event functions (m,) are carried from batch to batch.
    A step ends at the first event that stops the run or switches the system; what would come after it is not seen.
    """
    trial, after = batch.trial, batch.values_after
    accepted = rejected = hits = 0
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
        carry_over(work, system, clock[TIME], y)
        events_at(event_system, clock[TIME], y, after)
        known = hits
        hits, ender = record_events(event_system, rules, values, after, trial, accepted, batch, hits)
        copy(after, values)
        accepted += 1
        if ender >= 0:
            return_to_event(clock, y, batch, ender)
            if apply_switches(switch_system, rules, clock[TIME], y, batch, known, hits, ender):
                return EVENT, accepted, rejected, hits
            restart(work, system, control, clock, y)
            events_at(event_system, clock[TIME], y, values)
            last = clock[TIME] >= control.t1
        if last:
            return FINISHED, accepted, rejected, hits
    return GOES_ON, accepted, rejected, hits
