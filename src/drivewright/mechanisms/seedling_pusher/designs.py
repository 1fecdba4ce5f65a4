"""Many designs at once: the same quantities as a run, by algebra instead of trigonometry.

With half angles the elliptic pair is rational: tan(theta/2) = r tan(t/2).  On a fixed grid of t a whole train therefore needs no
trigonometric function per point, and the lever's atan(g / l) enters only through its sine and cosine.
"""

from collections.abc import Callable, Sequence
from functools import cache

import numpy as np

from drivewright import motion
from drivewright._jit import kernel, warmer
from drivewright._typing import Floats, Ints
from drivewright.cams.oscillating_batch import pitch_curvature, rest_cosine, sampled_peak
from drivewright.gears.elliptic_batch import phase, planet, planet_at
from drivewright.mechanisms.seedling_pusher.spec import SeedlingPusherSpec

TURN = 2 * np.pi
TRACK, CAM = 360, 91  # points over the turn, and over each of push and retraction

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


def batch(spec: SeedlingPusherSpec, keys: Sequence[str], names: Sequence[str]) -> Callable[[Floats], dict[str, Floats]] | None:
    """`evaluate(designs)` for designs (n, len(keys)) in SI -> {name: (n,)}; None where a key, name or event is not covered here."""
    if not set(keys) <= set(KEYS) or not set(names) <= set(NAMES) or spec.events.take == "gate":
        return None
    base = np.array([_at(spec, key) for key in KEYS])
    columns = [KEYS.index(key) for key in keys]
    flags = np.array(
        [
            spec.train.bend_reading == "interior",
            spec.train.start == "far",
            spec.arm.tip_reference == "planet",
            spec.push.end_event == "lowest",
            spec.events.take == "top",
            ("lowest", "push-end", "push-start").index(spec.events.push),
            spec.cams.orbit == "counter-clockwise",
            "planting.mouth_width" in names,
            spec.field.travel == "+x",
        ],
        dtype=np.int64,
    )
    tables = (*half_angles(), *law_table(spec.push.law))

    def evaluate(designs):
        rows = np.tile(base, (len(designs), 1))
        rows[:, columns] = designs
        out = np.empty((len(designs), len(NAMES)))
        evaluate_designs(rows, flags, *tables, out)
        return {name: out[:, NAMES.index(name)] for name in names}

    return evaluate


def _at(spec, key):
    table, name = key.split(".")
    value = getattr(getattr(spec, table), name)
    return 0.0 if value is None else value


@cache
def half_angles() -> tuple[Floats, Floats]:
    """cos(t/2), sin(t/2) on the track grid."""
    t = np.linspace(0, TURN, TRACK, endpoint=False)
    return np.cos(t / 2), np.sin(t / 2)


@cache
def law_table(name: str) -> tuple[Floats, Floats, Floats]:
    """s, v, a of a motion law on the cam grid."""
    found = motion.law(name)(np.linspace(0, 1, CAM))
    return np.asarray(found.s), np.asarray(found.v), np.asarray(found.a)


@kernel
def evaluate_designs(rows: Floats, flags: Ints, cos_half: Floats, sin_half: Floats, s: Floats, v: Floats, a: Floats, out: Floats) -> None:
    """All NAMES of each design; nan for what has no solution.

    rows (n, KEYS) in SI, out (n, NAMES) in SI, flags (9,); cos_half, sin_half (m,) of the track grid; s, v, a (k,) of the push law.
    """
    for n in range(rows.shape[0]):
        evaluate_train(rows[n], flags, cos_half, sin_half, out[n])
        end = out[n, 0] if flags[3] else rows[n, 8]
        finish_needle(rows[n], flags, end, out[n])
        evaluate_cams(rows[n], flags, end, s, v, a, out[n])
        out[n, 12] = mouth_width(rows[n], flags, out[n, 0]) if flags[7] else np.nan


@kernel
def shape(row: Floats, flags: Ints) -> tuple[complex, float, complex, complex]:
    """(e^{is/2}, r, G, W): half bend, slope of the pair, and tip z = e^{-it} (G + W e^{ip})."""
    bend = np.pi - row[2] if flags[0] else row[2]
    eccentricity = np.sqrt(1 - row[1] ** 2)
    r = (1 - eccentricity) / (1 + eccentricity)
    r = 1 / r if flags[1] else r
    start = row[3] + bend / 2 + np.pi + row[5] if flags[2] else row[3] - row[5]
    half = np.exp(0.5j * bend)
    carrier = 2 * row[0] * np.exp(1j * row[3]) * (1 + half * half)
    return half, r, carrier, row[4] * np.exp(1j * start) * np.conj(phase(half, r))


@kernel
def tip(t: float, half: complex, r: float, carrier: complex, arm: complex) -> tuple[complex, complex, complex]:
    """(z, z', z'') of the needle tip [m] at the carrier angle t [rad], from what `shape` gives."""
    e, p1, p2 = planet(t, half, r)
    turn = np.exp(-1j * t)
    first = -1j * carrier + 1j * (p1 - 1) * arm * e
    second = -carrier + arm * e * complex(-((p1 - 1) ** 2), p2)
    return turn * (carrier + arm * e), turn * first, turn * second


@kernel
def refine(t: float, axis: complex, half: complex, r: float, carrier: complex, arm: complex) -> float:
    """The stationary place of Re(conj(axis) z) near t, by Newton steps on its exact derivative."""
    for _ in range(6):
        _, z1, z2 = tip(t, half, r, carrier, arm)
        slope, second = (np.conj(axis) * z1).real, (np.conj(axis) * z2).real
        step = -slope / second if second != 0 else 0.0
        t += min(max(step, -0.02), 0.02)
        if abs(step) < 1e-13:
            break
    return t


@kernel
def evaluate_train(row: Floats, flags: Ints, cos_half: Floats, sin_half: Floats, out: Floats) -> None:
    """Lowest and highest carrier angle [rad], height and width [m] of the tip track of one design; row (KEYS,), out (NAMES,)."""
    half, r, carrier, arm = shape(row, flags)
    low = high = left = right = 0
    y_low = x_low = np.inf
    y_high = x_high = -np.inf
    for i in range(cos_half.shape[0]):
        c, d = cos_half[i], sin_half[i]
        x, y = half.real * c - half.imag * r * d, half.imag * c + half.real * r * d
        q = 1 / (x * x + r * r * y * y)
        pr, pi = (x * x - r * r * y * y) * q, 2 * r * x * y * q
        wr, wi = carrier.real + arm.real * pr - arm.imag * pi, carrier.imag + arm.real * pi + arm.imag * pr
        tr, ti = c * c - d * d, -2 * c * d
        zx, zy = wr * tr - wi * ti, wr * ti + wi * tr
        if zy < y_low:
            y_low, low = zy, i
        if zy > y_high:
            y_high, high = zy, i
        if zx < x_low:
            x_low, left = zx, i
        if zx > x_high:
            x_high, right = zx, i
    step = 2 * np.pi / cos_half.shape[0]
    t_low = refine(low * step, 1j, half, r, carrier, arm)
    t_high = refine(high * step, 1j, half, r, carrier, arm)
    t_left, t_right = refine(left * step, 1 + 0j, half, r, carrier, arm), refine(right * step, 1 + 0j, half, r, carrier, arm)
    out[0], out[1] = t_low % (2 * np.pi), t_high % (2 * np.pi)
    out[2] = (tip(t_high, half, r, carrier, arm)[0] - tip(t_low, half, r, carrier, arm)[0]).imag
    out[3] = (tip(t_right, half, r, carrier, arm)[0] - tip(t_left, half, r, carrier, arm)[0]).real


@kernel
def needle(row: Floats, flags: Ints, t: float) -> float:
    """Needle below the horizontal [rad] at the carrier angle t."""
    half, r, _, arm = shape(row, flags)
    return -np.angle(arm * planet(t, half, r)[0] * np.exp(-1j * t)) + row[6]


@kernel
def finish_needle(row: Floats, flags: Ints, end: float, out: Floats) -> None:
    """Needle angles at the two events, the tip's height when the push starts, the rod's distance from the needle."""
    take = out[1] if flags[4] else row[19]
    push = out[0] if flags[5] == 0 else (end if flags[5] == 1 else end - row[9])
    out[4], out[5] = needle(row, flags, take), needle(row, flags, push)
    out[6] = out[5] - out[4]
    out[11] = abs((1.0 if flags[6] else -1.0) * (row[12] + row[15]) - row[4] * np.sin(row[6]))
    half, r, carrier, arm = shape(row, flags)
    out[7] = (tip(end - row[9], half, r, carrier, arm)[0] - tip(out[0], half, r, carrier, arm)[0]).imag


@kernel
def mouth_width(row: Floats, flags: Ints, t_low: float) -> float:
    """Width of the hole at the soil surface, field frame [m]; 0 where the tip never leaves the soil."""
    half, r, carrier, arm = shape(row, flags)
    surface = tip(t_low, half, r, carrier, arm)[0].imag + row[20]
    advance = row[21] / (2 * np.pi) * (1.0 if flags[8] else -1.0)
    edges = np.zeros(2)
    for k in range(2):
        step = 0.02 if k else -0.02
        t = t_low
        while abs(t - t_low) < np.pi and tip(t, half, r, carrier, arm)[0].imag < surface:
            t += step
        if abs(t - t_low) >= np.pi:
            return 0.0
        low, high = t - step, t
        for _ in range(50):
            middle = 0.5 * (low + high)
            if tip(middle, half, r, carrier, arm)[0].imag < surface:
                low = middle
            else:
                high = middle
        edges[k] = tip(high, half, r, carrier, arm)[0].real + advance * high
    return abs(edges[1] - edges[0])


@kernel
def evaluate_cams(row: Floats, flags: Ints, end: float, s: Floats, v: Floats, a: Floats, out: Floats) -> None:
    """Largest pressure angle of both cams, least convex radius over roller radius, largest pitch radius."""
    cos_main, cos_return = rest_cosine(row[16], row[12], row[13]), rest_cosine(row[17], row[12], row[14])
    swing = np.arctan(row[7] / row[15])
    possible = abs(cos_main) < 1 and abs(cos_return) < 1 and row[9] + row[10] + row[11] < 2 * np.pi
    if not possible or np.arccos(cos_main) + swing >= np.pi or np.arccos(cos_return) <= swing:
        out[8], out[9], out[10] = np.nan, np.nan, np.nan
        return
    main = complex(cos_main, np.sqrt(1 - cos_main**2))
    back = complex(cos_return, np.sqrt(1 - cos_return**2))
    rise = stretch(row, flags, end - row[9], row[9], 1, main, back, s, v, a)
    retraction = stretch(row, flags, end + row[10], row[11], -1, main, back, s, v, a)
    out[8] = np.arctan(max(rise[0], retraction[0]))
    sharpest = max(max(rise[1], retraction[1]), max(1 / row[16], 1 / row[17]))
    outermost = main * np.exp(1j * swing)
    reach = np.sqrt(row[12] ** 2 + row[13] ** 2 - 2 * row[12] * row[13] * outermost.real)
    out[9], out[10] = 1 / (sharpest * row[18]), max(reach, row[17])


@kernel
def stretch(
    row: Floats, flags: Ints, t0: float, width: float, way: int, main: complex, back: complex, s: Floats, v: Floats, a: Floats
) -> tuple[float, float]:
    """(greatest tan of the pressure angle, greatest convex curvature) of both cams over one push (`way` +1) or retraction (-1)."""
    half, r, _, _ = shape(row, flags)
    orbit = 1.0 if flags[6] else -1.0
    stroke, lever, pivot = row[7], row[15], row[12]
    n = s.shape[0]
    dt = width / (n - 1)
    turn = np.exp(0.5j * dt)
    place = np.exp(0.5j * t0)
    steep_main, steep_back = np.zeros(n), np.zeros(n)
    curvature_main, curvature_back = np.zeros(n), np.zeros(n)
    for i in range(n):
        g = stroke * (s[i] if way > 0 else 1 - s[i])
        g1, g2 = way * stroke * v[i] / width, way * stroke * a[i] / width**2
        square = 1 / (lever * lever + g * g)
        f, f1 = lever * g1 * square, lever * square * (g2 - 2 * g * g1 * g1 * square)
        unit = complex(lever, g) * np.sqrt(square)  # e^{i phi1}
        _, p1, p2 = planet_at(place.real, place.imag, half, r)
        place *= turn
        q1, q2 = orbit * p1, orbit * p2
        psi_main, psi_back = main * unit, back * np.conj(unit)
        curvature_main[i] = orbit * pitch_curvature(pivot, row[13], q1, q2, q1 - f, q2 - f1, np.conj(psi_main))
        curvature_back[i] = orbit * pitch_curvature(pivot, row[14], q1, q2, q1 - f, q2 - f1, psi_back)
        steep_main[i] = abs((row[13] * (1 - f / q1) - pivot * psi_main.real) / (pivot * psi_main.imag))
        steep_back[i] = abs((row[14] * (1 - f / q1) - pivot * psi_back.real) / (pivot * psi_back.imag))
    return max(sampled_peak(steep_main), sampled_peak(steep_back)), max(sampled_peak(curvature_main), sampled_peak(curvature_back))


@warmer
def warm_batch() -> None:
    """Compile for `doctor --warm`."""
    out = np.empty((1, len(NAMES)))
    evaluate_designs(np.ones((1, len(KEYS))) * 0.5, np.zeros(9, dtype=np.int64), *half_angles(), *law_table("cycloidal"), out)
