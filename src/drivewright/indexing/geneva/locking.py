"""The wheel locked by the disc: its play in the dwell, and how close disc and wheel come while the wheel turns."""

from typing import NamedTuple

import numpy as np

from drivewright._typing import Bools, Complexes, Floats
from drivewright.indexing.geneva.shapes import GenevaShape
from drivewright.scene import Arc, Line, Piece

ANGLES = 61  # of the crank from entry to the line of centres; the way out is its mirror image
POINTS = 40  # on each piece of an outline


class LockingClearance(NamedTuple):
    """Crank angles (n,) [rad] from entry to the line of centres; distance (n,) [m] of disc and wheel, negative where they overlap."""

    angle: Floats
    distance: Floats


def dwell_play(shape: GenevaShape) -> float:
    """Angle [rad] by which the locked wheel turns either way from the middle until the horn of a locking arc meets the disc.

    The horn stands at the polar angle eta from the line of centres and at the distance R from O2:
    |R exp(i (eta - g)) - C| = locking radius.
    """
    c, horn = shape.step.centre_distance, shape.horn * np.exp(-1j * shape.step.half_pitch)
    radius, eta = abs(horn), abs(float(np.angle(horn)))
    cosine = (c * c + radius * radius - shape.locking_radius**2) / (2 * c * radius)
    return max(0.0, eta - float(np.arccos(np.clip(cosine, -1.0, 1.0))))


def locking_angle(shape: GenevaShape) -> float:
    """Crank angle [rad] over which the disc locks the wheel: the turn without the step."""
    return 2 * np.pi - shape.step.engagement


def locking_clearance(shape: GenevaShape) -> LockingClearance:
    """`LockingClearance` over the step: points of either outline against the pieces of the other one."""
    c, angle = shape.step.centre_distance, np.linspace(-shape.step.half_engagement, 0.0, ANGLES)
    turn = (np.pi - shape.step.pin_direction(angle).d0)[:, None]
    crank = np.exp(1j * angle)[:, None]
    wheel, disc = _beside_the_slot(shape), shape.disc_outline.pieces
    seen = (c + _points(wheel) * np.exp(1j * turn)) / crank  # the wheel in the frame of the crank
    back = (_points(disc) * crank - c) * np.exp(-1j * turn)  # the disc in the frame of the wheel
    from_disc = np.where(_in_disc(shape, seen), -1.0, 1.0) * _distance(disc, seen)
    from_wheel = np.where(_in_wheel(shape, back), -1.0, 1.0) * _distance(wheel, back)
    return LockingClearance(angle, np.minimum(from_disc.min(axis=1), from_wheel.min(axis=1)))


def _beside_the_slot(shape: GenevaShape) -> list[Piece]:
    """The pieces of the wheel from the bottom of slot -1 to that of slot 1: what the disc comes near to."""
    return [*shape.sector(-2 * shape.step.half_pitch), *shape.sector(0.0)]


def _points(pieces) -> Complexes:
    """Points (m,) on pieces, their ends included; complex [m]."""
    u = np.linspace(0.0, 1.0, POINTS)
    return np.concatenate([_on_line(each, u) if isinstance(each, Line) else _on_arc(each, u) for each in pieces])


def _on_line(line: Line, u: Floats) -> Complexes:
    start, end = complex(*line.start), complex(*line.end)
    return np.asarray(start + (end - start) * u, np.complex128)


def _on_arc(arc: Arc, u: Floats) -> Complexes:
    return np.asarray(complex(*arc.center) + arc.radius * np.exp(1j * (arc.start + arc.sweep * u)), np.complex128)


def _distance(pieces, points: Complexes) -> Floats:
    """Distance [m] of points from the nearest of several pieces."""
    return np.min([_from_line(each, points) if isinstance(each, Line) else _from_arc(each, points) for each in pieces], axis=0)


def _from_line(line: Line, points: Complexes) -> Floats:
    start, way = complex(*line.start), complex(*line.end) - complex(*line.start)
    along = np.clip(((points - start) * np.conj(way)).real / abs(way) ** 2, 0.0, 1.0)
    return np.abs(points - start - along * way)


def _from_arc(arc: Arc, points: Complexes) -> Floats:
    centre, ends = complex(*arc.center), _on_arc(arc, np.array([0.0, 1.0]))
    turned = np.angle((points - centre) * np.exp(-1j * (arc.start + arc.sweep / 2)))
    beside = np.minimum(np.abs(points - ends[0]), np.abs(points - ends[1]))
    return np.where(np.abs(turned) <= abs(arc.sweep) / 2, np.abs(np.abs(points - centre) - arc.radius), beside)


def _in_disc(shape: GenevaShape, points: Complexes) -> Bools:
    """Whether points in the frame of the crank lie in the disc."""
    relief = shape.disc_relief
    return (np.abs(points) < shape.locking_radius) & (np.abs(points - complex(*relief.center)) > relief.radius)


def _in_wheel(shape: GenevaShape, points: Complexes) -> Bools:
    """Whether points in the frame of the wheel lie in it: within its rim, in no slot, in no locking arc."""
    pitch = 2 * shape.step.half_pitch
    slot = points * np.exp(-1j * pitch * np.round(np.angle(points) / pitch))
    arc = slot * np.exp(-1j * shape.step.half_pitch * np.where(slot.imag < 0, -1.0, 1.0))
    half = shape.slot_width / 2
    in_slot = ((np.abs(slot.imag) < half) & (slot.real > shape.slot_end)) | (np.abs(slot - shape.slot_end) < half)
    in_arc = np.abs(arc - shape.step.centre_distance) < shape.arc_radius
    return (np.abs(points) < shape.outer_radius) & ~in_slot & ~in_arc
