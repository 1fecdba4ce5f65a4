"""The motion over one tooth of the driver, compiled: from grid angle to grid angle, with every seating and leaving found on the way.

At each of the four ends of a strand two things must not become negative: the gap of the first free plate to the next seat, and the moment
that presses the last seated plate onto its own.  They are two sides of one event: where the gap closes, the plate joins the seated ones
with no moment on it, and the other way round.  So the seats are followed from event to event; none is ever guessed.
"""

from typing import NamedTuple

import numpy as np

from drivewright._jit import inner, kernel
from drivewright._typing import Bools, Floats, Ints
from drivewright.chains.closure.loop import ENDS, UNKNOWNS, Layout, free_plates, solve, workspace

DONE, LOST, RESTLESS, NO_STRAND, NO_WRAP = range(5)
_TIE = 1e-12  # a margin as little below 0 is a tie, and accepted
_CHANGES = 64  # of seats at one angle
_HALVINGS = 100


class Track(NamedTuple):
    """Samples: angle, x, dx/dpsi_1 before and after it, seats after it, whether they change there, miss; how many samples; how it ended."""

    psi: Floats
    x: Floats
    before: Floats
    after: Floats
    seats: Ints
    event: Bools
    miss: Floats
    length: Ints
    outcome: Ints


@kernel
def follow(layout: Layout, seats: Ints, x: Floats, grid: Floats) -> Track:
    """The `Track` over the ascending angles `grid` (n,) [rad]; seats (ENDS,) and x (UNKNOWNS,) are where to start from, and overwritten."""
    room = len(grid) * (1 + 2 * ENDS) + _CHANGES
    track = Track(
        np.empty(room),
        np.empty((room, UNKNOWNS)),
        np.empty((room, UNKNOWNS)),
        np.empty((room, UNKNOWNS)),
        np.empty((room, ENDS), np.int64),
        np.zeros(room, np.bool_),
        np.empty(room),
        np.zeros(1, np.int64),
        np.zeros(1, np.int64),
    )
    work, start, held = workspace(layout.links), np.empty(UNKNOWNS), np.empty(2 * ENDS)
    outcome = _settle(layout, seats, grid[0], x, work)
    if outcome == DONE:
        _write(track, grid[0], x, work, work.slope, seats, False)
        for k in range(1, len(grid)):
            outcome = _advance(layout, seats, grid[k], x, start, work, held, track)
            if outcome != DONE:
                break
    track.outcome[0] = outcome
    return track


@kernel
def solve_at(layout: Layout, psi: Floats, x: Floats, seats: Ints) -> float:
    """Brings each row of x (S, UNKNOWNS) to the solution at its angle psi (S,) [rad] and with its seats (S, ENDS); the largest miss
    [pitches], inf where one is not found."""
    work, worst = workspace(layout.links), 0.0
    for k in range(len(psi)):
        if not solve(layout, seats[k], psi[k], x[k], work):
            return np.inf
        worst = max(worst, _largest(work.miss))
    return worst


@inner
def _settle(layout, seats, psi, x, work):
    """Solves for x (UNKNOWNS,) at psi [rad], and changes one of seats (ENDS,) at a time, the worst first, till no margin is negative."""
    for _ in range(_CHANGES):
        wrong = _refused(layout, seats)
        if wrong != DONE:
            return wrong
        if not solve(layout, seats, psi, x, work):
            return LOST
        worst = _least(work.margins)
        if work.margins[worst] >= -_TIE:
            return DONE
        _change(seats, worst)
    return RESTLESS


@inner
def _advance(layout, seats, target, x, start, work, held, track):
    """Follows the motion to `target` [rad] and writes the samples, those at events too; start (UNKNOWNS,), held (2 ENDS,) are scratch."""
    for _ in range(_CHANGES):
        last = track.length[0] - 1
        psi = track.psi[last]
        _keep(x, start)
        _keep(work.margins, held)
        if not _solve_near(layout, seats, target, psi, x, start, track.after[last], work):
            return LOST
        worst = _least(work.margins)
        if work.margins[worst] >= -_TIE:
            return _write(track, target, x, work, work.slope, seats, False)
        event, worst = _first_event(layout, seats, psi, target, x, start, track.after[last], work, held, worst)
        if event != event:
            return LOST
        _keep(work.slope, held)
        _change(seats, worst)
        outcome = _settle(layout, seats, event, x, work)
        if outcome == DONE:
            outcome = _write(track, event, x, work, held, seats, True)
        if outcome != DONE:
            return outcome
    return RESTLESS


@inner
def _solve_near(layout, seats, target, psi, x, start, slope, work):
    """Solves for x (UNKNOWNS,) at `target` [rad] from the solution start (UNKNOWNS,) at psi, foreseen by its slope (UNKNOWNS,)."""
    for k in range(UNKNOWNS):
        x[k] = start[k] + slope[k] * (target - psi)
    return solve(layout, seats, target, x, work)


@inner
def _first_event(layout, seats, psi, high, x, start, slope, work, held, worst):
    """The angle where the first margin vanishes, solved there, and which one it is; nan where a solution is lost."""
    for _ in range(2 * ENDS):
        event = _root(layout, seats, psi, high, x, start, slope, work, held, worst)
        other = _least(work.margins)
        if event != event or work.margins[other] >= -_TIE:
            return event, worst
        high, worst = event, other
    return np.nan, worst


@inner
def _root(layout, seats, psi, high, x, start, slope, work, held, which):
    """Where a margin, `held` at psi and negative at `high`, vanishes: false position with the Illinois weights; nan where lost."""
    low, at_low, at_high = psi, held[which], work.margins[which]
    if at_low <= 0.0:  # a tie that was accepted at psi
        return psi if _solve_near(layout, seats, psi, psi, x, start, slope, work) else np.nan
    side = 0
    for _ in range(_HALVINGS):
        middle = (low * at_high - high * at_low) / (at_high - at_low)
        if not _solve_near(layout, seats, middle, psi, x, start, slope, work):
            return np.nan
        here = work.margins[which]
        if abs(here) < 0.1 * _TIE:
            return middle
        if here > 0:
            low, at_low = middle, here
            at_high *= 0.5 if side > 0 else 1.0
            side = 1
        else:
            high, at_high = middle, here
            at_low *= 0.5 if side < 0 else 1.0
            side = -1
    return np.nan


@inner
def _refused(layout, seats):
    """Why seats cannot be: no free plate in a strand, or fewer than two seated ones on a sprocket; else DONE."""
    upper, lower = free_plates(layout, seats)
    if min(upper, lower) < 1:
        return NO_STRAND
    return NO_WRAP if min(seats[3] - seats[0], seats[1] - seats[2]) < 1 else DONE


@inner
def _change(seats, margin):
    """Seats one plate more at the end whose gap is negative, one less where the moment is; 0 and 2 are ends where plates leave."""
    end = margin // 2
    clockwise = 1 if end % 2 == 0 else -1
    seats[end] += clockwise if margin % 2 else -clockwise


@inner
def _keep(source, target):
    """target (n,) = source (n,); a slice would allocate."""
    for k in range(len(source)):
        target[k] = source[k]


@inner
def _least(margins):
    """Index of the least of margins (n,); of one that is nan, where there is any."""
    worst = 0
    for k in range(1, len(margins)):
        if not margins[k] >= margins[worst]:
            worst = k
    return worst


@inner
def _largest(miss):
    """Largest magnitude of miss (n,)."""
    worst = 0.0
    for k in range(len(miss)):
        worst = max(worst, abs(miss[k]))
    return worst


@inner
def _write(track, psi, x, work, before, seats, event):
    """One more sample: x (UNKNOWNS,), its slopes before and after, seats (ENDS,); RESTLESS where there is no room for it."""
    k = track.length[0]
    if k >= len(track.psi):
        return RESTLESS
    track.psi[k], track.event[k], track.miss[k], track.length[0] = psi, event, _largest(work.miss), k + 1
    for i in range(UNKNOWNS):
        track.x[k, i], track.before[k, i], track.after[k, i] = x[i], before[i], work.slope[i]
    for end in range(ENDS):
        track.seats[k, end] = seats[end]
    return DONE
