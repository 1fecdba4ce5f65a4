"""Stress and strain tensors where an elastic analysis exceeds the yield stress: Neuber's rule along a history."""

import numpy as np

from drivewright._typing import ArrayLike
from drivewright.fatigue.curves import NotchStress, neuber
from drivewright.fatigue.material import StrainLife
from drivewright.fatigue.tensors import checked_tensors, deviator, elastic_strain, von_mises


def neuber_history(elastic_stress: ArrayLike, material: StrainLife) -> NotchStress:
    """`NotchStress` tensors (n, 3, 3) of one repeat of a block whose elastic stresses [Pa] are (n, 3, 3).

    Where no sample's von Mises stress exceeds the card's `cyclic_yield` the elastic stress and Hooke's strain come back as they are.
    Else, with the tensor T of the sample with the largest von Mises stress, made 1 in that measure:
        s(t) = T:S(t)/(T:T) of the deviators           the elastic history as one signed equivalent stress
        its branches by Neuber's rule and Masing's doubling of the cyclic curve, with memory of the loops that close
        S(t) + (s_local(t) - s(t)) T                   stress
        Hooke's strain of it + 3/2 e_plastic(t) dev T  strain
    The block has settled: it starts at the largest |s|, on the cyclic curve.  Exact for uniaxial stress under Neuber's own assumption;
    for other proportional histories the von Mises equivalents stand in the rule, with the hydrostatic part scaled alike; where the axes
    turn, only the part along T is corrected.  No redistribution of load, no hardening beyond the settled curve.
    """
    stress = checked_tensors("neuber_history", "elastic_stress", elastic_stress, 1)
    size = von_mises(stress)
    if not np.max(size) > material.cyclic_yield:
        return NotchStress(stress, elastic_strain(stress, material))
    unit = stress[np.argmax(size)] / np.max(size)
    along = 1.5 * np.sum(deviator(stress) * deviator(unit), axis=(1, 2))
    local = _follow_branches(along, material)
    relaxed = stress + (local.stress - along)[:, None, None] * unit
    plastic = local.strain - local.stress / material.youngs_modulus
    return NotchStress(relaxed, elastic_strain(relaxed, material) + 1.5 * plastic[:, None, None] * deviator(unit))


def _follow_branches(elastic, material):
    """`NotchStress` stress and strain of a signed scalar block, from its largest absolute value on."""
    size, first = len(elastic), int(np.argmax(np.abs(elastic)))
    points = [(elastic[first], *neuber(elastic[first], material))]  # where the branches that are still open began
    states, last = np.empty((size, 2)), points[0]
    states[first] = last[1:]
    for k in ((first + step) % size for step in range(1, size)):
        value = elastic[k]
        if (value - last[0]) * (last[0] - points[-1][0]) < 0:
            points.append(last)
        while len(points) > 2 and abs(value - points[-1][0]) >= abs(points[-2][0] - points[-1][0]):
            del points[-2:]  # a loop has closed: the branch that it interrupted goes on
        half = neuber((value - points[-1][0]) / 2, material)
        last = value, points[-1][1] + 2 * half.stress, points[-1][2] + 2 * half.strain
        states[k] = last[1:]
    return NotchStress(*states.T)
