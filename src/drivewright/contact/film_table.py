"""The oil film of a journal bearing of finite length as a table of Reynolds' equation, quick enough for a time step.

Before cavitation cuts off what is negative the pressure is linear in wedge a and squeeze b, so that the force is
mu L (R^3/c^2) sqrt(a^2 + b^2) times a function of the eccentricity ratio and of the direction atan2(a, b) alone (`reynolds.film_map`).
Its parts along and across the line of centres grow as (1 - eps^2)^-1.5 and (1 - eps^2)^-1 at most; times these powers they are smooth,
and a bicubic spline goes through them.
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline

from drivewright._jit import inner
from drivewright._typing import Floats
from drivewright.contact.film import line_of_centres
from drivewright.contact.reynolds import film_map

ECCENTRICITIES, DIRECTIONS, LARGEST = 33, 25, 0.985  # nodes of the table; the largest ratio in it, where the grid still sees the film
SHAPE = (360, 20)  # of the grid around, and along half the length
RADIAL, TANGENTIAL = -1.5, -1.0  # powers of 1 - eps^2 taken out


class FilmTable(NamedTuple):
    """Even nodes of eccentricity (m,) and direction (n,); coefficients (2, m - 1, n - 1, 4, 4) of u^i v^j, u and v from a cell's corner:
    of the radial and of the tangential part."""

    eccentricity: Floats
    direction: Floats
    coefficients: Floats


@lru_cache(maxsize=8)
def film_table(slenderness: float) -> FilmTable:
    """The `FilmTable` of a bearing with L/D = slenderness."""
    eccentricity, direction = np.linspace(0.0, LARGEST, ECCENTRICITIES), np.linspace(0.0, np.pi, DIRECTIONS)
    solved = film_map(slenderness, eccentricity, direction, SHAPE)
    rest = (1.0 - eccentricity**2)[:, None]
    parts = (solved.radial * rest**-RADIAL, solved.tangential * rest**-TANGENTIAL)
    return FilmTable(eccentricity, direction, np.stack([_cells(eccentricity, direction, part) for part in parts]))


def _cells(x, y, values):
    """Coefficients (m - 1, n - 1, 4, 4) of the cells of a bicubic spline through values (m, n), along x and then along y."""
    along_x = CubicSpline(x, values, axis=0).c[::-1]  # (4, m - 1, n), powers ascending
    both = CubicSpline(y, along_x, axis=2).c[::-1]  # (4, n - 1, 4, m - 1)
    return np.ascontiguousarray(both.transpose(3, 1, 2, 0))


@inner
def tabulated_bearing(
    ex: float,
    ey: float,
    vx: float,
    vy: float,
    spin: float,
    viscosity: float,
    length: float,
    radius: float,
    clearance: float,
    coefficients: Floats,
) -> tuple[float, float]:
    """(Fx, Fy) [N] on the journal, arguments as in `film.long_bearing`; coefficients of the `FilmTable` of its length over diameter."""
    nx, ny, eps, wedge, squeeze = line_of_centres(ex, ey, vx, vy, spin, clearance)
    rate = np.sqrt(wedge * wedge + squeeze * squeeze)
    if rate == 0.0:
        return 0.0, 0.0
    direction = np.arctan2(abs(wedge), squeeze)
    rest = 1.0 - eps * eps
    scale = viscosity * length * radius**3 / clearance**2 * rate
    radial = scale * _spline_at(coefficients[0], eps, direction) * rest**RADIAL
    tangential = np.sign(wedge) * scale * _spline_at(coefficients[1], eps, direction) * rest**TANGENTIAL
    return radial * nx - tangential * ny, radial * ny + tangential * nx


@inner
def _spline_at(cells, eps, direction):
    """Value of a spline (m - 1, n - 1, 4, 4); level beyond its largest eccentricity."""
    m, n = cells.shape[0], cells.shape[1]
    x, y = min(eps, LARGEST) * m / LARGEST, direction * n / np.pi
    i, j = min(int(x), m - 1), min(int(y), n - 1)
    u, v = (x - i) * LARGEST / m, (y - j) * np.pi / n
    total, power = 0.0, 1.0
    for k in range(4):
        total += power * (cells[i, j, k, 0] + v * (cells[i, j, k, 1] + v * (cells[i, j, k, 2] + v * cells[i, j, k, 3])))
        power *= u
    return total
