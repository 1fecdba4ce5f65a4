"""Many pin wheels at once, for studies and the optimiser: play, contacts and pressure angles of a thousand designs in seconds.

The profile is not the exact one of `curves.trim` but a sampled envelope (`batch.envelope`), one point every 0.45 deg of the crank.
Measured on designs of all proportions: play within 0.05 arcmin of the exact route at the same angles, pressure angles within 0.02 deg,
and the same counts of contacts but for pins that begin or cease to touch within a micrometre of an angle of the table.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from drivewright import cases
from drivewright._jit import warmer
from drivewright._typing import ArrayLike, Bools, Floats
from drivewright.errors import InputError
from drivewright.indexing.batch.envelope import PinWheelSizes, tabulate_law
from drivewright.indexing.batch.values import VALUES, evaluate_pin_wheel
from drivewright.indexing.motion import TURN
from drivewright.motion import MotionLaw

INDEX_STEP = np.deg2rad(4.5)  # as `index_angles`
SAMPLES_PER_STEP, PLAY_STRIDE = 10, 2  # samples in an index step, and to the next angle of the play
CHUNK = 8  # designs: some tenths of a second


class PinWheelValues(NamedTuple):
    """Values of N designs, arrays (N,); nan where no cam is left.

    play_forward, play_backward [rad]: largest free rotation over the turn, nan where nothing stops the wheel; contacts_minimum,
    contacts_maximum: pins of a cam that touch over the index period; pressure_forward, pressure_backward [rad]: the worst over the index
    period of the best pin that pushes that way, pi/2 - arcsin of its arm over the pin circle, where one does; pressure_best [rad]: the
    least of all; convex_radius [m]: least radius of curvature of the centre curve on convex parts of the profile, whose own is less by
    the pin's radius.
    """

    play_forward: Floats
    play_backward: Floats
    contacts_minimum: Floats
    contacts_maximum: Floats
    pressure_forward: Floats
    pressure_backward: Floats
    pressure_best: Floats
    convex_radius: Floats


def crank_samples(motion_angle: float) -> tuple[Floats, int]:
    """Samples of the crank over one turn [rad] and the number of index angles among them, every 10th; every 2nd serves the play."""
    steps = max(int(round(motion_angle / INDEX_STEP)), 1)
    moving = np.arange(steps * SAMPLES_PER_STEP, dtype=float) * (motion_angle / (steps * SAMPLES_PER_STEP))
    rest = TURN - motion_angle
    dwell = PLAY_STRIDE * int(np.ceil(rest / (PLAY_STRIDE * INDEX_STEP / SAMPLES_PER_STEP) - 1e-9))
    if not dwell:
        return moving, steps
    return np.concatenate([moving, motion_angle + np.arange(dwell, dtype=float) * (rest / dwell)]), steps + 1


def evaluate_pin_wheels(
    law: MotionLaw,
    pins: int,
    circle_radius: ArrayLike,
    pin_radius: ArrayLike,
    eccentricity: ArrayLike,
    motion_angle: ArrayLike,
    side: str = "inside",
    play: bool = True,
    workers: int | None = None,
    progress: Callable[[int, int, str], object] | None = None,
) -> PinWheelValues:
    """`PinWheelValues` of N pin wheels that share law (a MotionLaw), number of pins and side.

    circle_radius, pin_radius, eccentricity [m], motion_angle [rad] (2 pi: no dwell): arrays (N,) or numbers.  An impossible design, as
    pins that overlap, is a row of nan and no error.  Without `play` its columns are nan.  The number of `workers` (None: one per core)
    changes no digit.
    """
    if law.continuity < 1 and law.name != "uniform":
        raise InputError(f"designs: the velocity of law {law.name!r} jumps; give a law that starts and ends at rest, or uniform motion.")
    if side not in ("inside", "outside"):
        raise InputError(f"designs: side = {side!r}; it is 'inside' or 'outside'.")
    sizes = np.broadcast_arrays(*np.atleast_1d(circle_radius, pin_radius, eccentricity, motion_angle))
    sizes = np.stack([np.asarray(size, dtype=float).ravel() for size in sizes], axis=1)
    table, sense = tabulate_law(law), 1.0 if side == "inside" else -1.0
    values = np.full((len(sizes), VALUES), np.nan)
    possible = feasible_designs(sizes, pins, law)

    def chunk(begin: int) -> None:
        for k in range(begin, min(begin + CHUNK, len(sizes))):
            if possible[k]:
                theta, count = crank_samples(float(sizes[k, 3]))
                circle, pin, throw, angle = (float(size) for size in sizes[k])
                wheel = PinWheelSizes(pins, circle, pin, throw, angle, sense)
                evaluate_pin_wheel(wheel, table, theta, SAMPLES_PER_STEP, count, PLAY_STRIDE if play else 0, values[k])

    if cases.run(chunk, range(0, len(sizes), CHUNK), workers, progress).interrupted:
        raise KeyboardInterrupt
    return PinWheelValues(*values.T)


def feasible_designs(sizes: Floats, pins: int, law: MotionLaw) -> Bools:
    """(N,): which designs have pins that do not overlap and leave a middle for the cam, and a motion that fits the law.

    sizes (N, 4): radius of the pin circle, of the pins, eccentricity [m], motion angle [rad].
    """
    circle, pin, eccentricity, motion_angle = sizes.T
    sound = np.all(np.isfinite(sizes) & (sizes > 0), axis=1) & (motion_angle <= TURN * (1 + 1e-12)) & (pins >= 3)
    if law.name == "uniform":
        sound &= motion_angle >= TURN * (1 - 1e-12)
    return sound & (pin < circle * np.sin(np.pi / pins)) & (eccentricity + pin < circle)


@warmer
def warm_designs() -> None:
    """One design."""
    from drivewright.motion import law

    evaluate_pin_wheels(law("modified-sine"), 12, 0.12, 0.008, 0.01, np.pi)
