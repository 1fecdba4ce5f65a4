"""Stresses and strains as symmetric tensors (..., 3, 3): checks, Hooke's law, superposition of plane-stress fields."""

import numpy as np

from drivewright._typing import ArrayLike, Floats
from drivewright.errors import InputError
from drivewright.fatigue.material import StrainLife

# Where the six stored numbers of a symmetric tensor stand: xx, yy, zz, yz, xz, xy.
ROWS, COLUMNS = np.array([0, 1, 2, 1, 0, 0]), np.array([0, 1, 2, 2, 2, 1])
_ASYMMETRY = 1e-9  # of the largest entry of the whole array


def checked_tensors(function: str, name: str, tensors: ArrayLike, axes: int) -> Floats:
    """The tensors as an array with `axes` axes before the last two; InputError where they are not finite, symmetric, 3 x 3."""
    try:
        array = np.asarray(tensors, dtype=float)
    except (TypeError, ValueError):
        raise InputError(f"{function}: {name} must be an array of numbers.") from None
    wanted = f"({', '.join(('nodes', 'samples')[-axes:])}, 3, 3)"
    if array.ndim != axes + 2 or array.shape[-2:] != (3, 3) or not array.size:
        raise InputError(f"{function}: {name} must have the shape {wanted}, got {array.shape}. `plane_tensors` makes it from xx, yy, xy.")
    if not np.all(np.isfinite(array)):
        bad = np.argwhere(~np.isfinite(array))
        raise InputError(f"{function}: {name}{list(map(int, bad[0]))} is {array[tuple(bad[0])]}, {len(bad)} in all are not finite.")
    skew = np.abs(array - np.swapaxes(array, -1, -2))
    if np.max(skew) > _ASYMMETRY * np.max(np.abs(array)):
        place = np.unravel_index(np.argmax(skew), skew.shape)
        mirrored = (*place[:-2], place[-1], place[-2])
        raise InputError(
            f"{function}: {name}{list(map(int, place))} is {array[place]:.6g} but its mirror is {array[mirrored]:.6g}; tensors are "
            "symmetric, with the tensor shear, half of the engineering shear, on both sides."
        )
    return array


def elastic_strain(stress: ArrayLike, material: StrainLife) -> Floats:
    """Hooke's law, e = ((1 + nu) s - nu tr(s) I)/E, for stress tensors [Pa] (n, 3, 3) or (nodes, n, 3, 3); `material` a `StrainLife`."""
    stress = checked_tensors("elastic_strain", "stress", stress, max(np.ndim(stress) - 2, 1))
    trace = np.trace(stress, axis1=-2, axis2=-1)[..., None, None] * np.eye(3)
    return ((1 + material.poisson_ratio) * stress - material.poisson_ratio * trace) / material.youngs_modulus


def plane_tensors(components: ArrayLike) -> Floats:
    """Tensors (..., 3, 3) of plane stress from (..., 3): xx, yy, xy; everything across the plane is 0."""
    components = np.asarray(components, dtype=float)
    if components.ndim < 1 or components.shape[-1] != 3:
        raise InputError(
            f"plane_tensors: components must have the shape (..., 3), the last axis xx, yy, xy; got the shape {components.shape}."
        )
    tensors = np.zeros((*components.shape[:-1], 3, 3))
    tensors[..., 0, 0], tensors[..., 1, 1] = components[..., 0], components[..., 1]
    tensors[..., 0, 1] = tensors[..., 1, 0] = components[..., 2]
    return tensors


def superpose(factors: ArrayLike, unit_stress: ArrayLike) -> Floats:
    """Plane-stress histories (nodes, n, 3, 3) of a linear body: factors (n, loads) times unit_stress (loads, nodes, 3), xx, yy, xy."""
    factors, unit_stress = np.asarray(factors, dtype=float), np.asarray(unit_stress, dtype=float)
    if factors.ndim != 2 or unit_stress.ndim != 3 or factors.shape[1] != len(unit_stress):
        raise InputError(
            f"superposed: factors (samples, loads) and unit_stress (loads, nodes, 3) do not fit together; "
            f"got the shapes {factors.shape} and {unit_stress.shape}."
        )
    return plane_tensors(np.einsum("tl,lnc->ntc", factors, unit_stress))


def von_mises(stress: ArrayLike) -> Floats:
    """sqrt(3/2 s:s) of the deviators s of stress tensors (n, 3, 3) or (nodes, n, 3, 3)."""
    s = deviator(checked_tensors("von_mises", "stress", stress, max(np.ndim(stress) - 2, 1)))
    return np.sqrt(1.5 * np.sum(s * s, axis=(-2, -1)))


def deviator(stress: ArrayLike) -> Floats:
    """s - tr(s)/3 I of tensors (..., 3, 3)."""
    return stress - np.trace(stress, axis1=-2, axis2=-1)[..., None, None] / 3 * np.eye(3)
