"""Many designs at once: the same quantities as a run, by algebra instead of trigonometry.

With half angles the elliptic pair is rational: tan(theta/2) = r tan(t/2).  On a fixed grid of t a whole train therefore needs no
trigonometric function per point, and the lever's atan(g / l) enters only through its sine and cosine.
"""

from collections.abc import Callable, Sequence
from functools import cache
from typing import NamedTuple

import numpy as np

from drivewright import motion
from drivewright._jit import kernel, warmer
from drivewright._typing import Floats
from drivewright.cams.oscillating_batch import can_swing, conjugate_extremes, conjugate_lever, main_pitch_radius
from drivewright.gears.elliptic_batch import planet_rates
from drivewright.gears.elliptic_track import (
    PlanetPoint,
    half_angles,
    opening_width,
    planet_point,
    point_direction,
    track_extremes,
    track_point,
)
from drivewright.mechanisms.seedling_pusher.spec import SeedlingPusherSpec

CAM = 91  # points over each of push and retraction

KEYS = (
    "train.semi_major",
    "train.axis_ratio",
    "train.bend",
    "train.carrier_angle",
    "arm.tip_distance",
    "arm.tip_angle",
    "arm.needle_angle",
    "push.stroke",
    "push.end",
    "push.rise",
    "push.hold",
    "push.retraction",
    "lever.pivot_distance",
    "lever.arm_main",
    "lever.arm_return",
    "lever.output_arm",
    "cams.prime_radius_main",
    "cams.prime_radius_return",
    "cams.roller_radius",
    "events.take_angle",
    "field.mouth_height",
    "field.spacing",
)
(
    SEMI_MAJOR,
    AXIS_RATIO,
    BEND,
    CARRIER_ANGLE,
    TIP_DISTANCE,
    TIP_ANGLE,
    NEEDLE_ANGLE,
    STROKE,
    END,
    RISE,
    HOLD,
    RETRACTION,
    PIVOT_DISTANCE,
    ARM_MAIN,
    ARM_RETURN,
    OUTPUT_ARM,
    PRIME_RADIUS_MAIN,
    PRIME_RADIUS_RETURN,
    ROLLER_RADIUS,
    TAKE_ANGLE,
    MOUTH_HEIGHT,
    SPACING,
) = range(len(KEYS))
NAMES = (
    "tip.lowest_angle",
    "tip.highest_angle",
    "tip.track_height",
    "tip.track_width",
    "needle.take_angle",
    "needle.push_angle",
    "needle.angle_difference",
    "tip.height_at_push_start",
    "cam.max_pressure_angle",
    "cam.curvature_ratio",
    "cam.max_pitch_radius",
    "rod.needle_distance",
    "planting.mouth_width",
)


class Choices(NamedTuple):
    """What a spec chooses, for the kernels; 1 where it holds.  push_event: 0 lowest point, 1 end and 2 start of the push."""

    interior_bend: int
    far_start: int
    tip_from_planet: int
    end_at_lowest: int
    take_at_top: int
    push_event: int
    counter_clockwise: int
    with_mouth: int
    forwards: int


def batch(spec: SeedlingPusherSpec, keys: Sequence[str], names: Sequence[str]) -> Callable[[Floats], dict[str, Floats]] | None:
    """`evaluate(designs)` for designs (n, len(keys)) in SI -> {name: (n,)}; None where a key, name or event is not covered here."""
    if not set(keys) <= set(KEYS) or not set(names) <= set(NAMES) or spec.events.take == "gate":
        return None
    base, columns = base_row(spec), [KEYS.index(key) for key in keys]
    choices, tables = choices_of(spec, "planting.mouth_width" in names), (*half_angles(), *law_table(spec.push.law))

    def evaluate(designs):
        rows = np.tile(base, (len(designs), 1))
        rows[:, columns] = designs
        out = np.empty((len(designs), len(NAMES)))
        evaluate_designs(rows, choices, *tables, out)
        return {name: out[:, NAMES.index(name)] for name in names}

    return evaluate


def base_row(spec: SeedlingPusherSpec) -> Floats:
    """The values of KEYS of a spec (KEYS,) in SI; 0 for what is not given."""
    values = [getattr(getattr(spec, table), name) for table, name in (key.split(".") for key in KEYS)]
    return np.array([0.0 if value is None else value for value in values])


def choices_of(spec: SeedlingPusherSpec, with_mouth: bool) -> Choices:
    """The `Choices` of a spec; with_mouth: whether the width of the hole is computed as well."""
    return Choices(
        int(spec.train.bend_reading == "interior"),
        int(spec.train.start == "far"),
        int(spec.arm.tip_reference == "planet"),
        int(spec.push.end_event == "lowest"),
        int(spec.events.take == "top"),
        ("lowest", "push-end", "push-start").index(spec.events.push),
        int(spec.cams.orbit == "counter-clockwise"),
        int(with_mouth),
        int(spec.field.travel == "+x"),
    )


@cache
def law_table(name: str) -> tuple[Floats, Floats, Floats]:
    """s, v, a of a motion law, each (CAM,)."""
    motions = motion.law(name)(np.linspace(0, 1, CAM))
    return np.asarray(motions.s), np.asarray(motions.v), np.asarray(motions.a)


@kernel
def evaluate_designs(
    rows: Floats, choices: Choices, cos_half: Floats, sin_half: Floats, s: Floats, v: Floats, a: Floats, out: Floats
) -> None:
    """All NAMES of each design; nan for what has no solution.

    rows (n, KEYS) in SI, out (n, NAMES) in SI; cos_half, sin_half (m,) [-] of `half_angles`; s, v, a (k,) [-] of the push law.
    """
    for n in range(rows.shape[0]):
        evaluate_train(rows[n], choices, cos_half, sin_half, out[n])
        end = out[n, 0] if choices.end_at_lowest else rows[n, END]
        evaluate_needle(rows[n], choices, end, out[n])
        evaluate_cams(rows[n], choices, end, s, v, a, out[n])


@kernel
def needle_tip(row: Floats, choices: Choices) -> PlanetPoint:
    """The needle's tip as a point on the planet; row (KEYS,) in SI."""
    bend = np.pi - row[BEND] if choices.interior_bend else row[BEND]
    eccentricity = np.sqrt(1 - row[AXIS_RATIO] ** 2)
    slope = (1 - eccentricity) / (1 + eccentricity)
    slope = 1 / slope if choices.far_start else slope
    to_sun = row[CARRIER_ANGLE] + bend / 2 + np.pi
    start = to_sun + row[TIP_ANGLE] if choices.tip_from_planet else row[CARRIER_ANGLE] - row[TIP_ANGLE]
    return planet_point(row[SEMI_MAJOR], slope, bend, row[CARRIER_ANGLE], row[TIP_DISTANCE], start)


@kernel
def evaluate_train(row: Floats, choices: Choices, cos_half: Floats, sin_half: Floats, out: Floats) -> None:
    """Lowest and highest carrier angle [rad], height and width [m] of the tip track of one design; row (KEYS,), out (NAMES,) in SI."""
    tip = needle_tip(row, choices)
    t = track_extremes(tip, cos_half, sin_half)
    out[0], out[1] = t.lowest % (2 * np.pi), t.highest % (2 * np.pi)
    out[2] = (track_point(t.highest, tip)[0] - track_point(t.lowest, tip)[0]).imag
    out[3] = (track_point(t.rightmost, tip)[0] - track_point(t.leftmost, tip)[0]).real


@kernel
def evaluate_needle(row: Floats, choices: Choices, end: float, out: Floats) -> None:
    """Needle angles at the two events [rad], tip height at the start of the push, rod's distance from the needle, width of the hole [m].

    row (KEYS,), out (NAMES,) in SI; end: carrier angle at which the push ends [rad].
    """
    tip = needle_tip(row, choices)
    take = out[1] if choices.take_at_top else row[TAKE_ANGLE]
    push = out[0] if choices.push_event == 0 else (end if choices.push_event == 1 else end - row[RISE])
    out[4], out[5] = -point_direction(take, tip) + row[NEEDLE_ANGLE], -point_direction(push, tip) + row[NEEDLE_ANGLE]
    out[6] = out[5] - out[4]
    out[7] = (track_point(end - row[RISE], tip)[0] - track_point(out[0], tip)[0]).imag
    orbit = 1.0 if choices.counter_clockwise else -1.0
    out[11] = abs(orbit * (row[PIVOT_DISTANCE] + row[OUTPUT_ARM]) - row[TIP_DISTANCE] * np.sin(row[NEEDLE_ANGLE]))
    advance = row[SPACING] * (1.0 if choices.forwards else -1.0)
    out[12] = opening_width(tip, out[0], row[MOUTH_HEIGHT], advance) if choices.with_mouth else np.nan


@kernel
def evaluate_cams(row: Floats, choices: Choices, end: float, s: Floats, v: Floats, a: Floats, out: Floats) -> None:
    """Largest pressure angle of both cams [rad], least convex radius over roller radius [-], largest pitch radius [m].

    row (KEYS,), out (NAMES,) in SI; end: carrier angle at which the push ends [rad]; s, v, a (k,) [-] of the push law.
    """
    main_prime, return_prime = row[PRIME_RADIUS_MAIN], row[PRIME_RADIUS_RETURN]
    lever = conjugate_lever(row[PIVOT_DISTANCE], row[ARM_MAIN], row[ARM_RETURN], row[OUTPUT_ARM], main_prime, return_prime)
    swing = np.arctan(row[STROKE] / row[OUTPUT_ARM])
    if not can_swing(lever, swing) or row[RISE] + row[HOLD] + row[RETRACTION] >= 2 * np.pi:
        out[8], out[9], out[10] = np.nan, np.nan, np.nan
        return
    tip, orbit = needle_tip(row, choices), 1.0 if choices.counter_clockwise else -1.0
    first, second = np.empty(s.shape[0]), np.empty(s.shape[0])
    planet_rates(end - row[RISE], row[RISE], tip.half_bend, tip.slope, first, second)
    rise = conjugate_extremes(lever, row[STROKE], row[RISE], 1, orbit, first, second, s, v, a)
    planet_rates(end + row[HOLD], row[RETRACTION], tip.half_bend, tip.slope, first, second)
    retraction = conjugate_extremes(lever, row[STROKE], row[RETRACTION], -1, orbit, first, second, s, v, a)
    sharpest = max(max(rise[1], retraction[1]), max(1 / main_prime, 1 / return_prime))
    out[8] = np.arctan(max(rise[0], retraction[0]))
    out[9], out[10] = 1 / (sharpest * row[ROLLER_RADIUS]), max(main_pitch_radius(lever, swing), return_prime)


@warmer
def warm_batch() -> None:
    """Compile for `doctor --warm`."""
    out = np.empty((1, len(NAMES)))
    evaluate_designs(np.ones((1, len(KEYS))) * 0.5, Choices(*[0] * 9), *half_angles(), *law_table("cycloidal"), out)
