"""A turning shaft as a rotor in few coordinates: its lowest modes on the supports, and the shapes that forces at given places make.

    M q'' + (C + s G) q' + (K + N) q = f,    s the speed of the shaft,

M mass, C damping of the supports, G gyroscopic moments (skew), K stiffness, N the cross-coupling of the supports that has no energy.
On supports that are the same all round, q are coordinates of z = x + iy: one plane stands for both, G = -i P with the polar moments P.
Modes are those of the shaft that does not turn, with the symmetric part of the stiffness; the static shapes (attachment modes, Craig 1981,
recalled) under forces at damped or cross-coupled supports and at unbalances make the reduction exact for slow forces there.
Sources of the equations: Genta, Dynamics of Rotating Systems 2005; Friswell et al., Dynamics of Rotating Machines 2010 (recalled).
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import scipy

from drivewright._typing import Complexes, Floats, Ints
from drivewright.errors import InputError
from drivewright.shafts.assembly import AXIAL, Mount, regularisation
from drivewright.shafts.beam import FREEDOMS
from drivewright.shafts.equilibrium import ShaftEquilibrium
from drivewright.shafts.influence import REGULARISATION_FACTOR
from drivewright.shafts.model import NOTHING
from drivewright.shafts.vibration import (
    ROUND,
    UNHELD,
    condense_supports,
    is_isotropic,
    lateral_system,
    plane_freedoms,
    polar_moments,
    symmetric_part,
)

KEPT = 12  # modes in each plane: four for each of the three that are shown as a rule
IMMENSE = 1e6  # times the stiffness: damping or cross-coupling beside which damping ratios have ten digits
DEPENDENT = 1e-8  # of a static shape: what the modes and the shapes before it leave of one that they contain


class Rotor(NamedTuple):
    """The matrices (r, r) of a rotor, K the unit matrix, and where its coordinates move it.

    `whirls`: whether q stands for z = x + iy; matrices are complex then.  shapes (2, n, r): x and y of the nodes at `z` (n,) [m], such
    that a motion q e^(i w t) has the complex amplitudes shapes q; axial_mass (r, r): the part of the mass that moves along the axis.
    supports (p, 2, r): x and y of the shaft in every support, against the ring of one whose seat yields; support_damping (p, 2, 2) [N s/m].
    """

    whirls: bool
    mass: Floats
    damping: Floats | Complexes
    gyroscopic: Floats | Complexes
    circulatory: Floats | Complexes
    z: Floats
    shapes: Floats | Complexes
    axial_mass: Floats
    supports: Floats | Complexes
    support_damping: Floats
    reference: float  # [rad/s] of the lowest mode: what frequencies are scaled with

    @property
    def is_conservative(self) -> bool:
        """Whether nothing takes energy from a whirl or feeds it."""
        return not self.damping.any() and not self.circulatory.any()

    def node(self, position: float) -> int:
        """Number of the node at a position [m]."""
        return int(np.argmin(np.abs(self.z - position)))

    def force(self, position: float) -> Floats | Complexes:
        """(r,) of the force (1, -i) e^(i w t) [N] at a place: of length 1, turning with the shaft from x towards y."""
        x, y = self.shapes[:, self.node(position)]
        return x if self.whirls else x - 1j * y


def reduced_rotor(equilibrium: ShaftEquilibrium, places: Sequence[float] = (), kept: int = KEPT) -> Rotor:
    """The `Rotor` of a shaft at rest, with `kept` modes in each plane and exact under slow forces at `places` [m].

    InputError where the shaft is not held or has no mass, or where damping or cross-coupling is so large that all else drowns.
    """
    stiff, inertia, gyroscopic, _ = lateral_system(equilibrium)
    model, whirls = equilibrium.model, is_round(equilibrium)
    chosen = plane_freedoms(model.beam, 0) if whirls else _lateral_freedoms(equilibrium)
    turning = -1j * polar_moments(equilibrium, gyroscopic) if whirls else gyroscopic
    coordinates, frequency = _coordinates(equilibrium, (stiff, inertia), chosen, _static_forces(equilibrium, places, whirls), kept)

    def reduced(whole: Any) -> Any:
        return coordinates.T @ whole[np.ix_(chosen, chosen)] @ coordinates

    nodes = (model.basis[: model.beam.size, chosen] @ coordinates).reshape(-1, FREEDOMS, coordinates.shape[1])
    felt = np.array([mount.rows[:2][:, chosen] @ coordinates for mount in model.mounts])
    couplings = np.array([_cross_coupling(contact) for contact in equilibrium.contact])
    damping = np.array([mount.support.damping for mount in model.mounts])
    _refuse_immense(frequency, _pressed(felt, damping, whirls), _pressed(felt, couplings, whirls))
    return Rotor(
        whirls,
        reduced(inertia),
        _pressed(felt, damping, whirls),
        reduced(turning),
        _pressed(felt, couplings, whirls),
        model.beam.z,
        _both_planes(nodes[:, 0], nodes[:, 1], whirls),
        _axial_mass(inertia, chosen, coordinates),
        _both_planes(felt[:, 0], felt[:, 1], whirls).swapaxes(0, 1),
        damping,
        frequency,
    )


def _refuse_immense(frequency, damping, circulatory):
    """Both are in units of the stiffness here."""
    for what, size in (("damping", frequency * np.abs(damping).max()), ("cross-coupling", np.abs(circulatory).max())):
        if not size < IMMENSE:
            raise InputError(
                f"shaft: the {what} of its bearings is {size:.2g} times the stiffness of a mode, so that all digits of the "
                "latter are lost; check the unit, or declare that bearing rigid"
            )


def _axial_mass(inertia, chosen, coordinates):
    """(r, r) of the motion along the axis alone; rings, beyond the nodes, have no mass."""
    axial = chosen[chosen % FREEDOMS == AXIAL]
    own = coordinates[np.isin(chosen, axial)]
    return own.T @ inertia[np.ix_(axial, axial)] @ own


def is_round(equilibrium: ShaftEquilibrium) -> bool:
    """Whether stiffness, cross-coupling and damping of all supports are the same all round."""
    return is_isotropic(equilibrium) and all(_turns_alike(np.array(mount.support.damping)) for mount in equilibrium.model.mounts)


def _turns_alike(matrix):
    """Whether a matrix (2, 2) is a 1 + b J, the same in every direction."""
    size = ROUND * np.abs(matrix).max()
    return abs(matrix[0, 0] - matrix[1, 1]) <= size and abs(matrix[0, 1] + matrix[1, 0]) <= size


def _cross_coupling(contact):
    """The part (2, 2) of a support's stiffness without an energy."""
    return (contact - symmetric_part(contact))[:2, :2]


def _pressed(felt: Floats, matrices: Floats, whirls: bool) -> Floats | Complexes:
    """(r, r) of the forces that matrices (p, 2, 2) make of what the supports feel (p, 2, r)."""
    if whirls:  # (a + ib) z with the force along x of a motion along x, and along y
        return np.einsum("pi,p,pj->ij", felt[:, 0], matrices[:, 0, 0] + 1j * matrices[:, 1, 0], felt[:, 0])
    return np.einsum("pai,pab,pbj->ij", felt, matrices, felt)


def _both_planes(x: Floats, y: Floats, whirls: bool) -> Floats | Complexes:
    """x and y as complex amplitudes of q; of z = x + iy they are those of a turn with the shaft."""
    planes: Any = (x, -1j * x if whirls else y)
    return np.stack(planes)


def _lateral_freedoms(equilibrium) -> Ints:
    """Numbers of all freedoms but the turning, and those along an axis that nothing holds."""
    model = equilibrium.model
    nodes = FREEDOMS * np.arange(len(model.beam.z))
    out = np.concatenate([nodes + freedom for freedom in model.pinned])
    return np.setdiff1d(np.arange(model.size), out)


def _static_forces(equilibrium, places, whirls):
    """(size, forces): unit forces where the modes alone would be slow to converge, along x, and along y where the planes differ."""
    model, planes = equilibrium.model, (0,) if whirls else (0, 1)
    damped = [m for m, contact in zip(model.mounts, equilibrium.contact, strict=True) if _acts(m, contact)]
    forces = [mount.rows[plane] for mount in damped for plane in planes]
    forces += [model.basis[FREEDOMS * model.beam.node(place) + plane] for place in places for plane in planes]
    return np.array(forces).reshape(-1, model.size).T


def _acts(mount: Mount, contact: Floats) -> bool:
    return mount.support.damping != NOTHING or bool(_cross_coupling(contact).any())


def _coordinates(equilibrium, matrices, chosen, forces, kept):
    """((chosen, r) coordinates with q'Kq = 1, lowest frequency [rad/s]): modes, then what static shapes add to them."""
    stiff, inertia = (whole[np.ix_(chosen, chosen)] for whole in matrices)
    model = equilibrium.model
    small = (REGULARISATION_FACTOR * regularisation(model))[np.ix_(chosen, chosen)]
    basis, k = condense_supports(stiff + small, model.constraints[:, chosen], model.compliance)
    count = min(len(k), kept * (1 if len(chosen) == 2 * len(model.beam.z) else 2))
    try:
        inverse, modes = scipy.linalg.eigh(basis.T @ inertia @ basis, k, subset_by_index=(len(k) - count, len(k) - 1))
    except np.linalg.LinAlgError:
        raise InputError(UNHELD) from None
    if not inverse[-1] > 0:
        raise InputError("shaft: nothing that can move has a mass; give a density, or a station a mass")
    return basis @ np.hstack([modes, _beyond(modes, k, basis.T @ forces[chosen])]), 1 / np.sqrt(inverse[-1])


def _beyond(modes, k, forces):
    """(n, m) with q'Kq = 1: the static shapes under forces (n, f), less what modes (n, r) with q'Kq = 1 contain of them."""
    static = np.linalg.solve(k, forces)
    compliance = np.sum(forces * static, axis=0)  # 0 of a force on a rigid support
    static = static[:, compliance > 0] / np.sqrt(compliance[compliance > 0])
    return _independent(static - modes @ (modes.T @ k @ static), k)


def _independent(shapes, k):
    """Shapes with q'Kq = 1 that span the same, without what is rounding."""
    size, turn = np.linalg.eigh(shapes.T @ k @ shapes)
    return shapes @ turn[:, size > DEPENDENT] / np.sqrt(size[size > DEPENDENT])
