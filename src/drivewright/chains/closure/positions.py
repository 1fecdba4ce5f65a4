"""Positions of a closed drive at any angle of the driver, the plates in them, and two chains side by side on the same shafts."""

from typing import NamedTuple

import numpy as np

from drivewright._typing import ArrayLike, Floats
from drivewright.chains.closure import tracking
from drivewright.chains.closure.loop import free_plates
from drivewright.chains.closure.model import Closure, States
from drivewright.chains.closure.start import layout_of
from drivewright.chains.closure.strand import first_share, plate_directions
from drivewright.errors import InputError, SolverError


class Phased(NamedTuple):
    """Two chains on one pair of shafts over one tooth: driver_angle, centre_distance, transmission_error (S,) [rad, m, rad], mean centre
    distance [m], and greatest less least of it [m] and of the transmission error [rad].

    single_distance, single_error (S,): of the first chain alone, in the same zero.  distance_gap, angle_gap (S,): by how much the places
    that the first and the second chain ask for differ [m, rad]; each is held off by half of it.
    """

    driver_angle: Floats
    centre_distance: Floats
    transmission_error: Floats
    mean: float
    fluctuation: float
    transmission_ripple: float
    single_distance: Floats
    single_error: Floats
    distance_gap: Floats
    angle_gap: Floats


def states_at(closure: Closure, driver_angle: ArrayLike) -> States:
    """The `States` at any angles of the driver [rad], over many teeth too: exact positions, not interpolated ones.

    A tooth further the same positions come back with the driven sprocket a tooth further.
    """
    angle = np.atleast_1d(np.asarray(driver_angle, dtype=float))
    if angle.ndim != 1 or not np.all(np.isfinite(angle)):
        raise InputError("states_at: the driver's angles must be finite numbers in one row [rad].")
    layout = layout_of(closure.drive)[0]
    teeth = np.floor(angle / layout.phi_1)
    within = angle - teeth * layout.phi_1
    known, p = closure.states, closure.drive.link.pitch
    last = np.clip(np.searchsorted(known.driver_angle, within, side="right") - 1, 0, len(known.driver_angle) - 2)
    x = np.column_stack([known.driven_angle, known.centre_distance / p, known.strand_angle])[last]
    x[:, :2] += closure.after[last] * (within - known.driver_angle[last])[:, None] / np.array([1.0, p])
    seats = known.seats[last]
    if not tracking.solve_at(layout, within, x, seats) < np.inf:
        raise SolverError("states_at: a position between two samples is not found. Close the drive with more `positions`.")
    further = teeth.astype(np.int64)[:, None]
    return States(angle, x[:, 0] + teeth * layout.phi_2, p * x[:, 1], x[:, 2:].copy(), seats - further)


def plates(closure: Closure, states: States) -> Floats:
    """(S, links, 3) places [m] and directions [rad] of the pin frames of all plates, for every row of `states`.

    Row 0 is the plate on the driver's tooth z1//2; the others follow clockwise, the same plate in the same row at every angle.  Directions
    fall along the chain, by 2 pi from row 0 to the row after the last.
    """
    layout, p = layout_of(closure.drive)[0], closure.drive.link.pitch
    found = np.empty((len(states.driver_angle), layout.links, 3))
    for k, state in enumerate(map(States, *states)):
        direction = _directions(layout, *state)
        place = p * _places(layout, state, direction)
        found[k] = _from_row_0(np.column_stack([place.real, place.imag, direction]), state.seats[0] - closure.drive.driver_teeth // 2)
    return found


def phased(closure: Closure, share: float = 0.5) -> Phased:
    """The `Phased` motion of two equal chains side by side, the teeth of the second ahead by `share` of a pitch on both shafts.

    Each alone would hold the driven sprocket where it closes; together, equally stiff, they hold it halfway.
    """
    if not 0 <= share <= 1:
        raise InputError(f"phased: share = {share:.4g} of a pitch; it must be from 0 to 1.")
    period, own = closure.driver_angle[-1], closure.driver_angle
    grid = np.unique(np.concatenate([own, np.mod(own - share * period, period)]))
    angle = np.insert(grid, np.arange(1, len(grid)), 0.5 * (grid[:-1] + grid[1:]))
    one, other = states_at(closure, angle), states_at(closure, angle + share * period)
    ratio = closure.drive.driver_teeth / closure.drive.driven_teeth
    own_error, other_error = (each.driven_angle - ratio * each.driver_angle for each in (one, other))
    distance, error = 0.5 * (one.centre_distance + other.centre_distance), 0.5 * (own_error + other_error)
    mean, low, high = _parabolas(angle, distance)
    offset, behind, ahead = _parabolas(angle, error)
    single = one.centre_distance, own_error - offset
    gaps = one.centre_distance - other.centre_distance, own_error - other_error
    return Phased(angle, distance, error - offset, mean, high - low, ahead - behind, *single, *gaps)


def mesh_order(angle: Floats, signal: Floats, order: int) -> float:
    """Amplitude of a harmonic of the meshing in a signal over one tooth, at samples (S,) as of `Phased`: |2/T int s exp(-i k 2 pi x/T) dx|.

    Simpson's rule over each two intervals, the middle point halfway.
    """
    wave = signal * np.exp(-2j * np.pi * order * (angle - angle[0]) / (angle[-1] - angle[0]))
    width = angle[2::2] - angle[:-2:2]
    return float(2 * abs(np.sum(width * (wave[:-2:2] + 4 * wave[1:-1:2] + wave[2::2]) / 6)) / (angle[-1] - angle[0]))


def _directions(layout, psi_1, psi_2, _, strand_angle, seats):
    """Directions of all plates, clockwise from the one that leaves the driver."""
    off_1, on_2, off_2, on_1 = seats
    upper, lower = free_plates(layout, seats)
    around_2 = psi_2 + np.arange(on_2, off_2 - 1, -1) * layout.phi_2 - 0.5 * np.pi
    around_1 = psi_1 + np.arange(on_1, off_1 - 1, -1) * layout.phi_1 - 2.5 * np.pi
    leaving = around_1[-1] + 2 * np.pi
    up, down = strand_angle
    over = up + plate_directions(layout.A, layout.r, layout.k, layout.bent, upper, leaving - up, around_2[0] - up)
    under = down + plate_directions(layout.A, layout.r, layout.k, layout.bent, lower, around_2[-1] - down, around_1[0] - down)
    return np.concatenate([[leaving], over, around_2, under, around_1[:-1]])


def _places(layout, state, direction):
    """Complex places of the pin frames [pitches], joint after joint from the plate that leaves the driver."""
    first = (layout.height_1 - 1j * layout.shift_1) * np.exp(1j * (state.driver_angle + state.seats[0] * layout.phi_1))
    share = first_share(layout.r, layout.k)
    half, joint = (
        0.5 * layout.A * np.exp(1j * direction),
        2 * layout.r * np.exp(1j * (share * direction[:-1] + (1 - share) * direction[1:])),
    )
    return first + np.concatenate([[0], np.cumsum(half[:-1] + half[1:] - joint)])


def _from_row_0(poses, first):
    """The rows turned so that row `first` comes first, directions falling on."""
    first %= len(poses)
    poses = np.roll(poses, -first, axis=0)
    poses[len(poses) - first :, 2] -= 2 * np.pi
    return poses


def _parabolas(x, y):
    """Mean, least and greatest value through parabolas, one over each two intervals, the middle point halfway."""
    start, middle, end, width = y[:-2:2], y[1:-1:2], y[2::2], x[2::2] - x[:-2:2]
    slope, bend = 0.5 * (end - start), 0.5 * (start + end) - middle
    with np.errstate(divide="ignore", invalid="ignore"):
        at = -0.5 * slope / bend
        tops = (middle - 0.25 * slope**2 / bend)[np.abs(at) < 1]
    every = np.concatenate([y, tops])
    return y[0] + np.sum(width * (start + 4 * middle + end - 6 * y[0])) / (6 * (x[-1] - x[0])), every.min(), every.max()
