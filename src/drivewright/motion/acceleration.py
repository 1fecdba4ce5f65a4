"""A motion law stated by its acceleration: constant and sinusoidal pieces and polynomials, integrated exactly.

    integrate([wave(1/8, 0, pi/2), wave(3/4, pi/2, 3*pi/2), wave(1/8, 3*pi/2, 2*pi)])      # the modified sine

Only the shape matters: widths are parts of the whole, and the level is scaled so that the rise is one.
"""

import math
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from drivewright._typing import Complexes
from drivewright.errors import InputError
from drivewright.motion.piecewise import CLOSURE, Piecewise, joined


class Acceleration(NamedTuple):
    """a = sum_m poly[m] t^m + Re sum amplitude exp(i turn t/width) over a width, t from its middle; `waves` holds (amplitude, turn)."""

    width: float
    poly: tuple[float, ...] = (0.0,)
    waves: tuple[tuple[complex, float], ...] = ()


def hold(width: float, level: float) -> Acceleration:
    """Constant acceleration; level 0 is a stretch of constant velocity."""
    return Acceleration(width, (level,))


def wave(width: float, start: float, end: float, level: float = 1.0) -> Acceleration:
    """level sin(phase), the phase running evenly from start to end [rad], which must differ."""
    return Acceleration(width, waves=((level * np.exp(0.5j * (start + end - math.pi)), end - start),))


def integrate(pieces: Iterable[Acceleration], start_velocity: float = 0.0) -> Piecewise:
    """s(u) on 0..1 with s(0) = 0, s(1) = 1, whose acceleration is proportional to the pieces, v(0) likewise to start_velocity."""
    functions, x, s, v = [], 0.0, 0.0, start_velocity
    for piece in (piece for piece in pieces if piece.width > 0):
        function = _twice_integrated(piece, s, v).scaled(start=x)
        functions.append(function)
        x = function.breaks[-1]
        s, v, _, _ = function.on_piece(0, x)
    return _normalised(joined(functions, closed=False), x, s)


def _twice_integrated(piece, s, v):
    """The motion over a piece's own 0..width that starts with s and v."""
    frequency = np.array([[turn / piece.width for _, turn in piece.waves]])
    sizes: Complexes = np.array([[size for size, _ in piece.waves]], dtype=complex)
    amplitude = -sizes / frequency**2
    powers = np.arange(1, len(piece.poly) + 1)
    poly = np.concatenate([[0.0, 0.0], np.asarray(piece.poly) / (powers * (powers + 1))])
    free = Piecewise(np.array([0.0, piece.width]), poly[None], amplitude, frequency)
    begin = free.on_piece(0, 0.0)
    poly[:2] = s - begin.s + (v - begin.v) * piece.width / 2, v - begin.v
    return Piecewise(free.breaks, poly[None], amplitude, frequency)


def _normalised(function, width, rise):
    if abs(width - 1) > CLOSURE:
        raise InputError(f"motion law: the widths of its acceleration pieces sum to {width:.9g}; they must sum to 1.")
    if not abs(rise) > 0:
        raise InputError("motion law: these acceleration pieces give no rise. Change a level or a start velocity.")
    function = function.scaled(width=1 / width, height=1 / rise)
    breaks = np.append(function.breaks[:-1], 1.0)
    return Piecewise(breaks, function.poly, function.amplitude, function.frequency)
