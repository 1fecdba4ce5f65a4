"""Reynolds' equation for a plain journal bearing of finite length, by finite differences.

Angle x from the line of centres (x = 0 where the film is thinnest), film thickness c H, H = 1 - eps cos x, axial place z = u L/2,
u = 0 in the middle and 1 at the open end, where the pressure is 0; no groove.  With  p = 12 mu (R/c)^2 P  [Pa]:

    d/dx(H^3 dP/dx) + (2 R/L)^2 H^3 d2P/du2 = a sin x - b cos x,     a = eps (w/2 - g') wedge, b = eps' squeeze  [1/s]

Cavitation: "gumbel" leaves negative pressure out of the force (half-Sommerfeld), "reynolds" lets the film end where the pressure
ends smoothly.  Second order in the grid.  It checks the closed forms of `contact.film` and says how far they are off at a given
length; it is not made for a time step.  In `FilmMap` everything is a pure number.
"""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
import scipy

from drivewright._typing import ArrayLike, Floats
from drivewright.errors import InputError, SolverError

SHAPE = (180, 24)


class Film(NamedTuple):
    """angle (n,) in the axes of the eccentricity [rad], axial (m,) from the middle to the end [m], pressure (n, m) [Pa], force (2,) [N]."""

    angle: Floats
    axial: Floats
    pressure: Floats
    force: Floats


class FilmMap(NamedTuple):
    """Force on the journal over mu L (R^3/c^2) sqrt(a^2 + b^2): radial and tangential (m, n), over eccentricity ratio (m,) and
    direction (n,).

    direction = atan2(a, b): 0 approach, pi/2 pure wedge, pi retreat.  A negative one mirrors the tangential part.
    """

    eccentricity: Floats
    direction: Floats
    radial: Floats
    tangential: Floats


def solve_film(
    eccentricity: ArrayLike,
    velocity: ArrayLike,
    spin: float,
    viscosity: float,
    length: float,
    radius: float,
    clearance: float,
    cavitation: str = "gumbel",
    shape: tuple[int, int] = SHAPE,
) -> Film:
    """The film at one instant; eccentricity (2,) [m], velocity (2,) [m/s] and spin [rad/s] as in `contact.film`.

    shape: nodes around and along half the length.  The pressure is never negative.
    """
    e, v = np.asarray(eccentricity, dtype=float), np.asarray(velocity, dtype=float)
    size = np.hypot(*e)
    n = e / size if size > 0 else np.array([1.0, 0.0])
    across = n[0] * v[1] - n[1] * v[0]
    wedge, squeeze = float(0.5 * spin * size - across) / clearance, float(n @ v) / clearance
    grid = _Grid(size / clearance, length / (2 * radius), shape)
    if cavitation == "gumbel":
        pressure = grid.solve(wedge, squeeze)
        field = np.maximum(pressure, 0.0)
    elif cavitation == "reynolds":
        pressure = field = grid.solve_cavitated(wedge, squeeze)
    else:
        raise InputError(f"film: cavitation is 'gumbel' or 'reynolds', got {cavitation!r}.")
    scale = 12 * viscosity * (radius / clearance) ** 2
    radial, tangential = scale * radius * length * grid.force(pressure)
    force = np.array([radial * n[0] - tangential * n[1], radial * n[1] + tangential * n[0]])
    return Film(grid.x + np.arctan2(n[1], n[0]), 0.5 * length * grid.u, scale * field, force)


def film_map(
    slenderness: float, eccentricities: Sequence[float] | Floats, directions: ArrayLike, shape: tuple[int, int] = SHAPE
) -> FilmMap:
    """The dimensionless force of a bearing with L/D = slenderness, for every eccentricity ratio in [0, 1) and direction; Gumbel.

    Wedge and squeeze are solved once per eccentricity: before the negative part is cut off the pressure is linear in both.
    """
    directions = np.asarray(directions, dtype=float)
    radial, tangential = np.empty((2, len(eccentricities), directions.size))
    for row, eps in enumerate(eccentricities):
        grid = _Grid(eps, slenderness, shape)
        wedge, squeeze = grid.solve(1.0, 0.0), grid.solve(0.0, 1.0)
        for column, direction in enumerate(directions):
            radial[row, column], tangential[row, column] = 12 * grid.force(np.sin(direction) * wedge + np.cos(direction) * squeeze)
    return FilmMap(np.asarray(eccentricities, dtype=float), directions, radial, tangential)


def closed_form_map(
    film: Callable[..., tuple[float, float]],
    slenderness: float,
    eccentricities: Sequence[float] | Floats,
    directions: Sequence[float] | Floats,
) -> FilmMap:
    """The same table by a closed form, `long_bearing` or `short_bearing`."""
    forces = np.array(
        [[film(eps, 0.0, np.cos(d), -np.sin(d), 0.0, 1.0, 2 * slenderness, 1.0, 1.0) for d in directions] for eps in eccentricities]
    ) / (2 * slenderness)
    return FilmMap(np.asarray(eccentricities, dtype=float), np.asarray(directions, dtype=float), forces[..., 0], forces[..., 1])


def film_deviation(closed: FilmMap, solved: FilmMap) -> Floats:
    """|difference of force| / |force| of two FilmMaps over the same places."""
    return np.hypot(closed.radial - solved.radial, closed.tangential - solved.tangential) / np.hypot(solved.radial, solved.tangential)


class _Grid:
    """Nodes x (n,) around and u (m,) from the middle to the open end, and the equation -div(H^3 grad P) = right-hand side on them."""

    def __init__(self, eps: float, slenderness: float, shape: tuple[int, int]) -> None:
        around, along = shape
        if not (0 <= eps < 1 and slenderness > 0):
            raise InputError(
                f"film: the eccentricity must lie in [0, 1) of the clearance and L/D be above 0, got {eps:g} and {slenderness:g}."
            )
        if around < 8 or along < 3:
            raise InputError(f"film: a grid of {around} x {along} nodes is too coarse; take at least 8 around and 3 along.")
        self.x, self.u = 2 * np.pi * np.arange(around) / around, np.linspace(0.0, 1.0, along)
        self.eps, self.shape = eps, (around, along)
        self.matrix = self._matrix(slenderness).tocsc()

    def _matrix(self, slenderness):
        """Finite volumes; the last node along, where P = 0, is left out, and the cell of the middle node is half as long."""
        n, m = self.shape
        dx, du = 2 * np.pi / n, 1.0 / (m - 1)
        between = (1 - self.eps * np.cos(self.x + 0.5 * dx)) ** 3 / dx**2
        before = np.roll(between, 1)
        around = _diagonals([between + before, -between[:-1], -between[:-1], -between[-1:], -between[-1:]], [0, 1, -1, n - 1, 1 - n])
        length = np.ones(m - 1)
        length[0] = 0.5
        self.weights = np.outer(np.ones(n), length).ravel()
        off = -np.ones(m - 2)
        along = _diagonals([np.r_[1.0, np.full(m - 2, 2.0)], off, off], [0, 1, -1]) / (slenderness * du) ** 2
        film = scipy.sparse.diags_array((1 - self.eps * np.cos(self.x)) ** 3)
        return scipy.sparse.kron(around, scipy.sparse.diags_array(length)) + scipy.sparse.kron(film, along)

    def source(self, wedge: float, squeeze: float) -> Floats:
        return np.repeat(squeeze * np.cos(self.x) - wedge * np.sin(self.x), self.shape[1] - 1) * self.weights

    def solve(self, wedge: float, squeeze: float) -> Floats:
        """P (n, m) of the full film, negative parts included."""
        return self._with_end(scipy.sparse.linalg.spsolve(self.matrix, self.source(wedge, squeeze)))

    def solve_cavitated(self, wedge: float, squeeze: float) -> Floats:
        """P >= 0 with  A P >= f,  one of both equal at every node: Reynolds' condition, by Newton's method on min(P, A P - f) = 0.

        A is an M-matrix: the set of cavitated nodes settles after a few solutions.
        """
        right, rows = self.source(wedge, squeeze), self.matrix.tocsr()
        scale = rows.diagonal()
        full = np.ones(right.size, dtype=bool)
        for _ in range(100):
            pressure = np.zeros(right.size)
            inside = np.flatnonzero(full)
            pressure[inside] = scipy.sparse.linalg.splu(rows[inside][:, inside].tocsc()).solve(right[inside])
            now = scale * pressure > rows @ pressure - right
            if np.array_equal(now, full):
                return self._with_end(pressure)
            full = now
        raise SolverError("film: the edge of the cavitated film does not settle; take cavitation = 'gumbel' or another grid.")

    def force(self, pressure: Floats) -> Floats:
        """(radial, tangential) = -integral of the positive part of P (cos x, sin x) dx du, u from 0 to 1.

        Between two nodes around the film's edge P is taken as straight and cut where it is 0: second order wherever the edge lies.
        """
        after = np.roll(pressure, -1, axis=0)
        positive, size = np.maximum(pressure, 0) + np.maximum(after, 0), np.abs(pressure) + np.abs(after)
        cell = 0.5 * positive**2 / np.where(size > 0, size, 1.0)
        dx, du = 2 * np.pi / self.shape[0], 1.0 / (self.shape[1] - 1)
        rows = (cell.sum(axis=1) - 0.5 * (cell[:, 0] + cell[:, -1])) * dx * du
        middle = self.x + 0.5 * dx
        return -np.array([rows @ np.cos(middle), rows @ np.sin(middle)])

    def _with_end(self, inner):
        n, m = self.shape
        return np.column_stack([inner.reshape(n, m - 1), np.zeros(n)])


def _diagonals(values: Sequence[Floats], offsets: Sequence[int]) -> "scipy.sparse.dia_array":
    """A sparse matrix of its diagonals."""
    return scipy.sparse.diags_array(values, offsets=offsets)  # pyright: ignore[reportArgumentType]  scipy's default 0 passes for the type
