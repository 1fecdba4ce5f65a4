"""Hertz pressure between cam and follower: line contact of two cylinders that have the radii of the surfaces where they touch."""

from typing import Any

import numpy as np

from drivewright._typing import Floats, Numbers
from drivewright.cams.cycle import Cycle, Quantity
from drivewright.cams.followers import CamContact, ContactAt
from drivewright.contact import hertz
from drivewright.materials import Material
from drivewright.numerics.jets import Jet
from drivewright.result import Answer, Check

LEAST_SLACK = 1e-9  # of 1 - r kappa, and [1/m] of the relative curvature: nearer to a cusp the pressure is meaningless anyhow


def pair_modulus(material: Material) -> float:
    """Effective modulus E* [Pa] of cam and follower of one material."""
    return float(hertz.effective_modulus(material.modulus, material.poisson, material.modulus, material.poisson))


def relative_curvature(contact: CamContact, radius: float) -> Jet:
    """kappa + 1/r [1/m] of the cam's surface and a face of radius r [m], inf for a flat face."""
    return contact.curvature + 1 / radius


def contact_pressure(force: Floats, contact: CamContact, radius: float, width: float, modulus: float) -> Floats:
    """Peak Hertz pressure [Pa] under a normal force [N] at each place; radius of the face and width [m], modulus E* [Pa]."""
    return np.asarray(hertz.line_contact(force, width, 1 / relative_curvature(contact, radius).d0, modulus).pressure)


def peak_contact_pressure(
    cycle: Cycle, normal_force: Quantity, contact_at: ContactAt, radius: float, width: Numbers, modulus: float
) -> Any:
    """Largest Hertz pressure [Pa] over the turn: it goes with the product of force and relative curvature.

    normal_force(angle, lift) [N] and contact_at(angle, lift) of the jets; radius of the face and width [m], modulus E* [Pa].
    """

    def product(angle, lift):
        return normal_force(angle, lift) * relative_curvature(contact_at(angle, lift), radius)

    worst = np.maximum(cycle.maximum(product).value, 0.0)
    return hertz.line_contact(worst, width, 1.0, modulus).pressure


def roller_pressure(force: Floats, pitch_curvature: Floats, radius: float, width: float, modulus: float) -> Floats:
    """Peak Hertz pressure [Pa] of a roller of radius r [m] on the profile inside a pitch curve of curvature kappa [1/m].

    1/R = 1/r + kappa/(1 - r kappa), capped where the profile has a cusp; force [N], width [m], modulus E* [Pa]; arrays of one shape.
    """
    slack = np.maximum(1 - radius * pitch_curvature, LEAST_SLACK)
    relative = 1 / radius + pitch_curvature / slack
    return np.asarray(hertz.line_contact(force, width, 1 / np.maximum(relative, LEAST_SLACK), modulus).pressure)


def pressure_check(
    name: str, pressure: float, limit: float | None, material: Material, message: str, parts: tuple[str, ...], label: str = ""
) -> Answer:
    """The check of a Hertz pressure [Pa] against a limit [Pa], the material's unless given; without either a finding says so."""
    allowed = material.hertz_limit if limit is None else limit
    if allowed is None:
        unknown = f"no allowable pressure is known for {material.name}; give limits.contact_pressure"
        return Answer(findings=(f"check {name} is left out: {unknown}",))
    return Answer(checks=(Check(name, pressure, allowed, "<=", "Pa", message, parts, label=label),))
