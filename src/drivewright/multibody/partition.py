"""Coordinate partitioning: the Jacobian of the loops, and which coordinates depend on which (Wehage & Haug 1982, recalled)."""

from collections.abc import Sequence

import numpy as np

from drivewright._typing import Floats, Ints
from drivewright.multibody.forces.contact import LUGRE
from drivewright.multibody.forces.joint_friction import STATES, JointFrictions
from drivewright.multibody.kinematics import evaluate_at_time
from drivewright.multibody.system import RESIDUAL, System, Work, no_chart, scratch
from drivewright.numerics.linear import pivot_order
from drivewright.numerics.small import SINGULAR


def evaluate_at(system: System, q: Floats, t: float = 0.0, v: Floats | None = None) -> Work:
    """`Work` with driven coordinates set, bodies placed and rows measured at the coordinates q."""
    work = scratch(system)
    if v is not None:
        work.coordinates["v"] = v
    evaluate_again(system, work, q, t)
    return work


def evaluate_again(system: System, work: Work, q: Floats, t: float = 0.0) -> None:
    """The same into `work` that held other coordinates."""
    work.coordinates["q"] = q
    evaluate_at_time(system, work, t)


def scaled_jacobian(system: System, work: Work, coordinates: Ints | Sequence[int] | range) -> Floats:
    """(rows, given coordinates) of the Jacobian without dimensions: lengths count in lengths of the mechanism."""
    return work.constraint_jacobian[:, coordinates] * system.sizes[coordinates] / system.rows.extent[:, None]


def scaled_residuals(system: System, work: Work) -> Floats:
    """Residuals of the rows without dimensions."""
    return work.row_columns[RESIDUAL] / system.rows.extent


def partition_coordinates(system: System, q: Floats, t: float = 0.0) -> System:
    """The system with its coordinates split at q so that the dependent ones follow as firmly as possible."""
    return partition_at(system, evaluate_at(system, q, t))


def partition_at(system: System, work: Work) -> System:
    """The same at what `work` holds."""
    dependent = system.stored
    if len(system.rows) < len(dependent):
        pivots = pivot_order(scaled_jacobian(system, work, dependent)) if len(system.rows) else np.zeros(0, int)
        dependent = np.sort(dependent[pivots[: len(system.rows)]])
    return partition_into(system, dependent, work)


def partition_into(system: System, dependent: Ints, work: Work) -> System:
    """The system with the given coordinates dependent and without a chart, its determinant measured at what `work` holds."""
    following = set(dependent.tolist())
    independent = np.array([k for k in system.stored.tolist() if k not in following], dtype=np.int64)
    contacts, place = system.contacts.copy(), len(system.stored) + len(independent)
    for contact in contacts:
        contact.memory, place = place, place + 1
    for contact in contacts:
        if contact.law == LUGRE:
            contact.bristle, place = place, place + 1
        else:
            contact.bristle = contact.memory
    frictions = system.frictions
    if isinstance(frictions, JointFrictions):
        frictions = JointFrictions(frictions.table.copy())
        for friction in frictions.table:
            friction.sliding, friction.deflection, friction.relaxation, place = place, place + 1, place + 2, place + STATES
    return system._replace(
        dependent=np.asarray(dependent, np.int64),
        independent=independent,
        contacts=contacts,
        frictions=frictions,
        reference_determinant=_determinant(scaled_jacobian(system, work, dependent)),
        chart=no_chart(len(independent), len(dependent)),
    )


def _determinant(square):
    """Determinant (n, n); 0 where that is a matter of rounding."""
    sizes = np.linalg.svd(square, compute_uv=False)
    return 0.0 if np.any(sizes <= SINGULAR * np.max(sizes, initial=0.0)) else float(np.linalg.det(square))
