"""Track of a point on the planet of two congruent elliptic pairs, for many designs: by algebra, without trigonometry per point.

World: sun axis at the origin, the carrier turns clockwise by t [rad].  With the planet's direction e^{ip} of `elliptic_batch` the
point is z = e^{-it} (carrier + arm e^{ip}).
"""

from functools import cache
from typing import NamedTuple

import numpy as np

from drivewright._jit import kernel
from drivewright._typing import Floats
from drivewright.gears.elliptic_batch import phase, planet

STEPS = 360  # samples over the turn, before an extreme is refined


class PlanetPoint(NamedTuple):
    """A point on the planet: e^{i bend/2} of the carrier, slope r of each pair at angle 0, and the numbers of z above [m]."""

    half_bend: complex
    slope: float
    carrier: complex
    arm: complex


class TrackExtremes(NamedTuple):
    """Carrier angles [rad] of the lowest, highest, leftmost and rightmost point of a track."""

    lowest: float
    highest: float
    leftmost: float
    rightmost: float


@kernel
def planet_point(semi_major: float, slope: float, bend: float, carrier_angle: float, distance: float, direction: float) -> PlanetPoint:
    """The `PlanetPoint` at a distance [m] from the planet's axis, at t = 0 in a direction [rad].

    semi_major [m]; slope: r of the pairs; bend [rad] of the carrier, counter-clockwise; carrier_angle [rad]: first arm at t = 0.
    """
    half = np.exp(0.5j * bend)
    carrier = 2 * semi_major * np.exp(1j * carrier_angle) * (1 + half * half)
    return PlanetPoint(half, slope, carrier, distance * np.exp(1j * direction) * np.conj(phase(half, slope)))


@kernel
def track_point(t: float, point: PlanetPoint) -> tuple[complex, complex, complex]:
    """(z, z', z'') [m] at the carrier angle t [rad], derivatives by t."""
    e, p1, p2 = planet(t, point.half_bend, point.slope)
    turn = np.exp(-1j * t)
    first = -1j * point.carrier + 1j * (p1 - 1) * point.arm * e
    second = -point.carrier + point.arm * e * complex(-((p1 - 1) ** 2), p2)
    return turn * (point.carrier + point.arm * e), turn * first, turn * second


@kernel
def point_direction(t: float, point: PlanetPoint) -> float:
    """Direction [rad] of the line planet axis - point in the world at the carrier angle t [rad]."""
    return np.angle(point.arm * planet(t, point.half_bend, point.slope)[0] * np.exp(-1j * t))


@kernel
def stationary_angle(t: float, axis: complex, point: PlanetPoint) -> float:
    """Carrier angle [rad] near t at which Re(conj(axis) z) is stationary, by Newton steps on its exact derivative."""
    for _ in range(6):
        _, z1, z2 = track_point(t, point)
        slope, second = (np.conj(axis) * z1).real, (np.conj(axis) * z2).real
        step = -slope / second if second != 0 else 0.0
        t += min(max(step, -0.02), 0.02)
        if abs(step) < 1e-13:
            break
    return t


@cache
def half_angles() -> tuple[Floats, Floats]:
    """cos(t/2) and sin(t/2), each (STEPS,), over one turn."""
    t = np.linspace(0, 2 * np.pi, STEPS, endpoint=False)
    return np.cos(t / 2), np.sin(t / 2)


@kernel
def track_extremes(point: PlanetPoint, cos_half: Floats, sin_half: Floats) -> TrackExtremes:
    """The `TrackExtremes` of a point's track; cos_half, sin_half (m,) [-]: cos(t/2), sin(t/2) over one turn, see `half_angles`."""
    half, r, carrier, arm = point.half_bend, point.slope, point.carrier, point.arm
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
    t_low, t_high = stationary_angle(low * step, 1j, point), stationary_angle(high * step, 1j, point)
    return TrackExtremes(t_low, t_high, stationary_angle(left * step, 1 + 0j, point), stationary_angle(right * step, 1 + 0j, point))


@kernel
def opening_width(point: PlanetPoint, lowest: float, height: float, advance: float) -> float:
    """Width [m] of the track where it crosses a height [m] above its lowest point, on a machine that advances; 0 where it never does.

    lowest: carrier angle of that point [rad]; advance: along +x per turn of the carrier [m].  Edges by bisection.
    """
    surface = track_point(lowest, point)[0].imag + height
    per_angle = advance / (2 * np.pi)
    edges = np.zeros(2)
    for k in range(2):
        step = 0.02 if k else -0.02
        t = lowest
        while abs(t - lowest) < np.pi and track_point(t, point)[0].imag < surface:
            t += step
        if abs(t - lowest) >= np.pi:
            return 0.0
        low, high = t - step, t
        for _ in range(50):
            middle = 0.5 * (low + high)
            if track_point(middle, point)[0].imag < surface:
                low = middle
            else:
                high = middle
        edges[k] = track_point(high, point)[0].real + per_angle * high
    return abs(edges[1] - edges[0])
