"""What unbalance does to a rotor at speed: orbits of places on it, and the forces that the supports carry round.

An unbalance U = m e at an angle d on the shaft is a force U s^2 e^(i (s t + d)) that turns with it at the speed s:

    (K + N - s^2 M + i s (C + s G)) q = s^2 sum U e^(i d) f,    f the `Rotor.force` at its place.

Permissible residual unbalance by the balance quality grade of ISO 21940-11 (recalled): e s = G, so U = m G/s for a rotor of mass m.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from drivewright._typing import Bools, Complexes, Floats
from drivewright.errors import InputError
from drivewright.shafts.model import Shaft
from drivewright.shafts.rotor import Rotor
from drivewright.shafts.sections import NODES, WEIGHTS, area

GRADES = {f"G {grade:g}": grade * 1e-3 for grade in (0.4, 1, 2.5, 6.3, 16, 40, 100, 250, 630, 1600, 4000)}  # e s [m/s]
RESONANCE = 1e3  # dynamic over static response: with more, damping alone decides, and there is next to none


class Unbalance(NamedTuple):
    """An unbalance U = m e [kg m] at a place [m] of the shaft, at an angle [rad] on it, from x towards y at the time 0; the name of the
    part that has it."""

    position: float
    moment: float
    angle: float = 0.0
    name: str = ""


class Orbits(NamedTuple):
    """Orbits of p places at the speeds (k,) [rad/s]: radii (k, p) [m], complex, of the circle with the shaft and of the one against it.

    support_forces (k, supports) [N]: largest force on each support; magnification (k,): response over that at rest, by their energy.
    """

    speeds: Floats
    forward: Complexes
    backward: Complexes
    support_forces: Floats
    magnification: Floats

    @property
    def amplitude(self) -> Floats:
        """(k, p) [m]: major semi-axis."""
        return np.abs(self.forward) + np.abs(self.backward)

    @property
    def lag(self) -> Floats:
        """(k, p) [rad]: by how much the turning part of the orbit stays behind the unbalance at the angle 0, in 0 ... 2 pi."""
        return np.mod(-np.round(np.angle(self.forward), 12), 2 * np.pi)  # a lag of rounding alone is none, not a whole turn

    @property
    def resonant(self) -> Bools:
        """(k,) whether nothing but rounding or next to no damping bounds the orbit."""
        return ~(self.magnification < RESONANCE)


def unbalance_response(
    rotor: Rotor, unbalances: Sequence[Unbalance], speeds: Sequence[float] | Floats, places: Sequence[float], stiffness: Floats
) -> Orbits:
    """The `Orbits` of places [m] at speeds [rad/s]; stiffness (supports, 2, 2) [N/m]: of the supports, for their forces (inf: nan)."""
    speeds = np.asarray(speeds, float)
    force = sum((u.moment * np.exp(1j * u.angle) * rotor.force(u.position) for u in unbalances), np.zeros(len(rotor.mass), complex))
    forces = speeds[:, None] ** 2 * force
    answer = _solve(_dynamic_stiffness(rotor, speeds), forces)
    x, y = np.einsum("aij,kj->aki", rotor.shapes[:, [rotor.node(place) for place in places]], answer)
    size = np.linalg.norm(forces, axis=1)
    with np.errstate(invalid="ignore", divide="ignore"):
        magnification = np.where(size > 0, np.linalg.norm(answer, axis=1) / size, 1.0)
    pressed = _support_forces(rotor, speeds, answer, stiffness)
    return Orbits(speeds, 0.5 * (x + 1j * y), 0.5 * np.conj(x - 1j * y), pressed, magnification)


def _dynamic_stiffness(rotor, speeds):
    """(k, r, r) at the frequency of the speed itself."""
    s = speeds[:, None, None]
    return np.eye(len(rotor.mass)) + rotor.circulatory - s**2 * rotor.mass + 1j * s * (rotor.damping + s * rotor.gyroscopic)


def _solve(matrices, right):
    """Solutions (k, r); inf where a matrix is singular to the last digit."""
    try:
        return np.linalg.solve(matrices, right[:, :, None])[:, :, 0]
    except np.linalg.LinAlgError:
        each = [_solve(matrix[None], row[None])[0] for matrix, row in zip(matrices, right, strict=True)] if len(right) > 1 else []
        return np.array(each) if each else np.full_like(right, np.inf)


def _support_forces(rotor, speeds, answer, stiffness):
    """(k, supports) major semi-axes of the forces of springs and dampers; nan of a rigid support, which has no displacement."""
    moved = np.einsum("paj,kj->kpa", rotor.supports, answer)
    complete = stiffness[None] + 1j * speeds[:, None, None, None] * rotor.support_damping[None]
    with np.errstate(invalid="ignore"):
        fx, fy = np.moveaxis(np.einsum("kpab,kpb->kpa", complete, moved), -1, 0)
    return 0.5 * (np.abs(fx + 1j * fy) + np.abs(fx - 1j * fy))


# -- permissible unbalance -----------------------------------------------------------------------------------------------------


def shaft_mass(shaft: Shaft) -> float:
    """Mass [kg] of the shaft itself, without its stations."""
    length, start, end, bore = np.array([section[:4] for section in shaft.sections], float).T[:, :, None]
    return float(shaft.density * np.sum(WEIGHTS * length * area(start + (end - start) * NODES, bore)))


def permissible_unbalances(shaft: Shaft, grade: str, speed: float) -> tuple[Unbalance, ...]:
    """The permissible residual unbalance of a rotor at a speed [rad/s], U = m G/s, shared by their masses among what sits on it, all at one
    angle, which is the worst for the first mode.  InputError where nothing there has a mass.
    """
    heavy = [station for station in shaft.masses if station.mass > 0]
    if not heavy:
        raise InputError("shaft: no station and no gear has a mass that could be out of balance; give one a mass or an unbalance")
    carried = sum(station.mass for station in heavy)
    whole = (shaft_mass(shaft) + carried) * GRADES[grade] / speed
    return tuple(Unbalance(each.position, whole * each.mass / carried, name=each.name) for each in heavy)


def balance_quality(shaft: Shaft, unbalances: Sequence[Unbalance], speed: float) -> float:
    """e s [m/s] of given unbalances: the sum of their sizes over the mass of the rotor, times the speed [rad/s]."""
    mass = shaft_mass(shaft) + sum(station.mass for station in shaft.masses)
    return sum(abs(u.moment) for u in unbalances) / mass * speed
