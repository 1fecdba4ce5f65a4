"""The plane of the largest shear amplitude, exactly: from the differences of the strains at all pairs of instants.

The resolved shear 2 d.e.n changes between two instants by 2 d.D.n, D the difference of the strains; its greatest value over all planes
and directions is the difference of D's outer principal values, on the planes that halve the angle of their axes.  The largest over all
pairs is the longest chord of the path of the shear vector, over all planes.
"""

import numpy as np

from drivewright._jit import inner, kernel
from drivewright._typing import Floats
from drivewright.fatigue.curves import Curve
from drivewright.fatigue.planes import Block, PlaneWorkspace, Vector, plane_damage, turn_towards

_NEAR = 1e-6  # the closed form of the principal values is good to about 1e-8 where two of them are equal
_TIE = 1e-9  # relative difference up to which shears, or principal values, count as equal
_AROUND = 32  # planes of a cone to begin with


@inner
def _difference(strain, i, j):
    """Six numbers of the strain at sample i less that at j, of strain (6, n) [-]."""
    return (
        strain[0, i] - strain[0, j],
        strain[1, i] - strain[1, j],
        strain[2, i] - strain[2, j],
        strain[3, i] - strain[3, j],
        strain[4, i] - strain[4, j],
        strain[5, i] - strain[5, j],
    )


@inner
def _second_invariant(t):
    """J2 of the deviator."""
    return ((t[0] - t[1]) ** 2 + (t[1] - t[2]) ** 2 + (t[2] - t[0]) ** 2) / 6.0 + t[3] ** 2 + t[4] ** 2 + t[5] ** 2


@inner
def _outer_difference(t, j2):
    """Largest less least principal value: 2 sqrt(J2) sin(theta + 60 deg), cos 3 theta = J3/2 (3/J2)^1.5, theta in 0 .. 60 deg."""
    mean = (t[0] + t[1] + t[2]) / 3.0
    x, y, z = t[0] - mean, t[1] - mean, t[2] - mean
    j3 = x * (y * z - t[3] ** 2) - t[5] * (t[5] * z - t[3] * t[4]) + t[4] * (t[5] * t[3] - y * t[4])
    lode = np.arccos(min(max(0.5 * j3 * (3.0 / j2) ** 1.5, -1.0), 1.0)) / 3.0
    return 2.0 * np.sqrt(j2) * np.sin(lode + np.pi / 3.0)


@inner
def _largest_shear(strain):
    """The largest shear between any two instants; pairs that cannot reach it, for it is at most 2 sqrt(J2), are passed over."""
    best = 0.0
    for i in range(strain.shape[1]):
        for j in range(i):
            t = _difference(strain, i, j)
            j2 = _second_invariant(t)
            if 4.0 * j2 > best * best:
                best = max(best, _outer_difference(t, j2))
    return best


@kernel
def largest_differences(strain: Floats, gate: float) -> Floats:
    """Differences (count, 6) [-] of a strain (6, n) [-], each once, between instants whose shear is the largest;
    none where no plane is sheared beyond `gate`.
    """
    best, differences = _largest_shear(strain), np.empty((4, 6))
    count = 0
    if best <= gate:
        return differences[:0]
    for i in range(strain.shape[1]):
        for j in range(i):
            t = _difference(strain, i, j)
            j2 = _second_invariant(t)
            if (
                4.0 * j2 < ((1.0 - _NEAR) * best) ** 2
                or _outer_difference(t, j2) < (1.0 - _NEAR) * best
                or _is_known(t, differences, count, best)
            ):
                continue
            if count == len(differences):
                differences = np.concatenate((differences, np.empty_like(differences)))
            for c in range(6):
                differences[count, c] = t[c]
            count += 1
    return differences[:count]


@inner
def _is_known(t, differences, count, size):
    """Whether the difference, or its negative, is there already: a block that repeats itself has few different ones."""
    for k in range(count):
        same, opposite = 0.0, 0.0
        for c in range(6):
            same, opposite = max(same, abs(differences[k, c] - t[c])), max(opposite, abs(differences[k, c] + t[c]))
        if min(same, opposite) <= _TIE * size:
            return True
    return False


@kernel
def principal_axes(t: Floats) -> tuple[Floats, Floats]:
    """Principal values (3,), ascending, in the unit of t, and axes (3, 3) [-] as rows, of a tensor t (6,): xx, yy, zz, yz, xz, xy."""
    full = np.array([[t[0], t[5], t[4]], [t[5], t[1], t[3]], [t[4], t[3], t[2]]])
    values, columns = np.linalg.eigh(full)
    return values, np.ascontiguousarray(columns.T)


@kernel
def max_shear_plane(block: Block, curve: Curve, work: PlaneWorkspace) -> tuple[float, Vector, Vector]:
    """(damage, normal, direction) on the plane of the largest shear amplitude, of tied planes on the one with the greatest damage.

    Two planes at right angles always tie, and where two principal values are equal a whole cone of them.
    """
    best, normal, direction = -1.0, (np.nan, np.nan, np.nan), (np.nan, np.nan, np.nan)
    tensors = largest_differences(block.strain, block.gate)
    largest = 0.0
    for k in range(len(tensors)):
        values, _ = principal_axes(tensors[k])
        largest = max(largest, values[2] - values[0])
    for k in range(len(tensors)):
        values, axes = principal_axes(tensors[k])
        if values[2] - values[0] < (1.0 - _TIE) * largest:
            continue
        low, mid, high = (axes[0, 0], axes[0, 1], axes[0, 2]), (axes[1, 0], axes[1, 1], axes[1, 2]), (axes[2, 0], axes[2, 1], axes[2, 2])
        if values[1] - values[0] <= _TIE * largest:
            fixed, start, sense, cone = high, low, mid, True
        else:
            fixed, start, sense, cone = low, high, mid, values[2] - values[1] <= _TIE * largest
        damage, angle = _worst_angle(block, curve, fixed, start, sense, cone, work)
        if damage > best:
            best = damage
            normal, direction = _frame(fixed, turn_towards(start, sense, angle))
    return max(best, 0.0), normal, direction


@inner
def _frame(a, b):
    """The plane that halves the angle of two principal axes, and the direction it slides in."""
    return turn_towards(a, b, np.pi / 4.0), turn_towards(b, a, -np.pi / 4.0)


@inner
def _damage_at(block, curve, fixed, start, sense, angle, work):
    """Damage of a repeat on the plane between the axis `fixed` and `start` turned towards `sense` by an angle [rad]."""
    normal, direction = _frame(fixed, turn_towards(start, sense, angle))
    return plane_damage(block, curve, normal, direction, work)


@inner
def _worst_angle(block, curve, fixed, start, sense, cone, work):
    """(greatest damage, its angle): of the two planes at right angles, at 0 and pi, or of the cone between them."""
    places = _AROUND if cone else 2
    width = 2.0 * np.pi / places
    best, angle = -1.0, 0.0
    for k in range(places):
        damage = _damage_at(block, curve, fixed, start, sense, k * width, work)
        if damage > best:
            best, angle = damage, k * width
    step = 0.5 * width
    while cone and step > 1e-6:
        left, right = (
            _damage_at(block, curve, fixed, start, sense, angle - step, work),
            _damage_at(block, curve, fixed, start, sense, angle + step, work),
        )
        if left <= best and right <= best:
            bend = left - 2.0 * best + right
            vertex = angle + (0.5 * step * (left - right) / bend if bend < 0.0 else 0.0)
            there = _damage_at(block, curve, fixed, start, sense, vertex, work)
            if there > best:
                best, angle = there, vertex
            step *= 0.25
        else:
            best, angle = (left, angle - step) if left > right else (right, angle + step)
    return best, angle
