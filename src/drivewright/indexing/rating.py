"""What a swept profile is worth, in compiled code: the pins that touch over the index period, their arms, and the play over the turn."""

import numpy as np

from drivewright._jit import kernel, outer
from drivewright.curves.touching import nearest
from drivewright.indexing.loops import keep_loop, loop_around, nodes_along
from drivewright.indexing.plane import ALIVE
from drivewright.indexing.play import BACKWARD, FORWARD, free_rotation
from drivewright.indexing.sweep import bare_samples, cells_of, stretches_of, swept

VALUES = 8
_HOLDS = 1e-6  # an arm above this part of the pin circle stops the wheel
_ROOM = 16
_CELL = 0.5  # width of a cell over the pin's radius


@kernel
def rate(wheel, table, theta, index_stride, index_count, play_stride, values):
    """Writes the VALUES of one design, in the order of `designs.Ratings`; none where no cam is left.

    theta: samples over one turn; the first `index_count` of every `index_stride`-th are the places of the contacts, every
    `play_stride`-th those of the play.
    """
    path = swept(wheel, table, theta)
    margin = _spacing(path) ** 2 / (2 * wheel.pin_radius)
    cells = cells_of(path, wheel.circle_radius + wheel.eccentricity + margin, _CELL * wheel.pin_radius)
    bare = bare_samples(path, cells, wheel.pin_radius, margin)
    found = stretches_of(wheel, table, path, cells, margin, bare)
    loop = loop_around(found, wheel.sense > 0)
    if not len(loop):
        return
    keep_loop(bare, found, loop)
    nodes = nodes_along(found, loop)
    points, bends = np.empty(_ROOM, np.complex128), np.empty(_ROOM)
    _rate_contacts(wheel, path, nodes, bare, index_stride, index_count, values, points, bends)
    _rate_play(wheel, path, nodes, bare, play_stride, values, points, bends, np.empty(wheel.pins, np.complex128))
    values[7] = _convex_radius(path, bare)


@outer
def _spacing(path):
    """No two neighbours among the samples are further apart [m]."""
    fastest, widest = 0.0, 2 * np.pi - path.theta[-1]
    for k in range(len(path.z)):
        fastest = max(fastest, abs(path.v[k]))
    for j in range(1, len(path.theta)):
        widest = max(widest, path.theta[j] - path.theta[j - 1])
    return fastest * widest


@outer
def _rate_contacts(wheel, path, nodes, bare, stride, count, values, points, bends):
    """Least and greatest number of pins that touch; worst angle of the best pin forward, backward, and the best of all."""
    fewest, most = wheel.pins, 0
    worst_forward, worst_backward, best = wheel.circle_radius, wheel.circle_radius, 0.0
    for step in range(count):
        j, number, forward, backward = step * stride, 0, 0.0, 0.0
        for turn in range(wheel.pins):
            touching = False
            for side in range(2):
                if _touches(wheel, path, nodes, bare, j, turn, side, points, bends):
                    touching = True
                    arm = _arm(wheel, path, j, turn, side)
                    forward, backward = max(forward, arm), max(backward, -arm)
            number += touching
        fewest, most = min(fewest, number), max(most, number)
        best = max(best, forward, backward)
        if forward > _HOLDS * wheel.circle_radius:
            worst_forward = min(worst_forward, forward)
        if backward > _HOLDS * wheel.circle_radius:
            worst_backward = min(worst_backward, backward)
    values[2], values[3] = fewest, most
    for n, arm in enumerate((worst_forward, worst_backward, best)):
        values[4 + n] = np.arccos(min(arm / wheel.circle_radius, 1.0))


@outer
def _touches(wheel, path, nodes, bare, j, turn, side, points, bends):
    """Whether the envelope's point lies on the profile."""
    k = turn * len(path.theta) + j
    if bare[side, k]:
        return True
    return nearest(nodes, _offset(wheel, path, k, side), ALIVE, points, bends) > 0


@outer
def _offset(wheel, path, k, side):
    return path.z[k] + (1 - 2 * side) * wheel.pin_radius * 1j * path.v[k] / abs(path.v[k])


@outer
def _arm(wheel, path, j, turn, side):
    """Arm of the cam's force on the pin about the wheel's axis: Im(conj(c) n), n from the contact to the pin's centre."""
    k = turn * len(path.theta) + j
    centre = path.z[k] + _crank(wheel, path.theta[j])
    force = (2 * side - 1) * 1j * path.v[k] / abs(path.v[k])
    return centre.real * force.imag - centre.imag * force.real


@outer
def _crank(wheel, theta):
    return wheel.eccentricity * complex(np.cos(theta), wheel.sense * np.sin(theta))


@outer
def _rate_play(wheel, path, nodes, bare, stride, values, points, bends, centres):
    """Greatest play forward and backward; nan where nothing stops the wheel somewhere."""
    for n, direction in enumerate((FORWARD, BACKWARD)):
        values[n] = 0.0
        for j in range(0, len(path.theta), stride):
            if not _held(wheel, path, bare, j, direction):
                crank = _crank(wheel, path.theta[j])
                for turn in range(wheel.pins):
                    centres[turn] = path.z[turn * len(path.theta) + j] + crank
                free = free_rotation(nodes, centres, crank, wheel.pin_radius, direction, 2 * np.pi / wheel.pins, points, bends)
                values[n] = np.nan if free != free else max(values[n], free)
                if free != free:
                    break


@outer
def _held(wheel, path, bare, j, direction):
    """Whether a pin that touches stops the wheel in the direction."""
    for turn in range(wheel.pins):
        for side in range(2):
            if bare[side, turn * len(path.theta) + j] and direction * _arm(wheel, path, j, turn, side) < -_HOLDS * wheel.circle_radius:
                return True
    return False


@outer
def _convex_radius(path, bare):
    """Least radius of curvature of the centre curve where the profile is convex, its centre of curvature on the side of the cam."""
    sharpest = 0.0
    for side in range(2):
        for k in range(len(path.z)):
            if bare[side, k]:
                v, a = path.v[k], path.a[k]
                sharpest = max(sharpest, (1 - 2 * side) * (v.real * a.imag - v.imag * a.real) / abs(v) ** 3)
    return 1.0 / sharpest
