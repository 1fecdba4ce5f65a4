"""Values of one design from its sampled envelope, compiled: pins in contact over the index period, their arms, play over the turn."""

from typing import NamedTuple

import numpy as np

from drivewright._jit import inner, kernel
from drivewright._typing import Bools, Floats
from drivewright.curves.touching import Nodes, nearest
from drivewright.indexing.batch.envelope import (
    LawTable,
    PinPath,
    PinWheelSizes,
    find_exposed_samples,
    sample_pin_path,
    sort_into_cells,
    trace_exposed_segments,
)
from drivewright.indexing.batch.loops import APART, find_cam_loop, loop_nodes, restrict_to_loop
from drivewright.indexing.plane import PROFILE_TOLERANCE
from drivewright.indexing.play import BACKWARD, CAPACITY, FORWARD, free_rotation, pin_within_cam

VALUES = 8
_LEAST_ARM = 1e-6  # an arm above this part of the pin circle stops the wheel
_CELL_WIDTH = 0.4  # width of a cell over the pin's radius
_PASSES = 7  # over the places of the play: the first visits every 64th, each of the others those in the middle between


class SampledCam(NamedTuple):
    """The cam of one design as a sampled envelope.

    path: of the pins' centres; exposed (2, samples): True where the point of the envelope, left of the centre's travel, then right of it,
    lies on the profile; nodes: of the profile, none where no cam is left.
    """

    path: PinPath
    exposed: Bools
    nodes: Nodes


@kernel
def evaluate_pin_wheel(
    wheel: PinWheelSizes, table: LawTable, theta: Floats, index_stride: int, index_count: int, play_stride: int, values: Floats
) -> None:
    """Writes the values (VALUES,) of one design, in the order and units of `PinWheelValues`; none where no cam is left.

    theta (n,) [rad]: samples over one turn; the first `index_count` of every `index_stride`-th are the places of the contacts, every
    `play_stride`-th those of the play; of which there is none where the stride is 0.
    """
    evaluate_cam(wheel, sample_cam(wheel, table, theta), index_stride, index_count, play_stride, values)


@kernel
def evaluate_cam(wheel: PinWheelSizes, cam: SampledCam, index_stride: int, index_count: int, play_stride: int, values: Floats) -> None:
    """`evaluate_pin_wheel` of a cam that is sampled already."""
    path, exposed, nodes = cam
    if not len(nodes.a):
        return
    foot_points, curvatures = np.empty(CAPACITY, np.complex128), np.empty(CAPACITY)
    _evaluate_contacts(wheel, path, nodes, exposed, index_stride, index_count, values, foot_points, curvatures)
    if play_stride:
        _evaluate_play(wheel, path, nodes, exposed, play_stride, values, foot_points, curvatures, np.empty(wheel.pins, np.complex128))
    values[7] = _convex_radius(path, exposed)


@kernel
def sample_cam(wheel: PinWheelSizes, table: LawTable, theta: Floats) -> SampledCam:
    """The `SampledCam` of one design; theta (n,) [rad]: samples over one turn."""
    path = sample_pin_path(wheel, table, theta)
    margin = _spacing(path) ** 2 / (2 * wheel.pin_radius)
    cells = sort_into_cells(path, wheel.circle_radius + wheel.eccentricity + margin, _CELL_WIDTH * wheel.pin_radius)
    least, most = _where_the_cam_ends(wheel)
    exposed = find_exposed_samples(path, cells, wheel.pin_radius, margin, least, most)
    segments = trace_exposed_segments(wheel, table, path, cells, margin, exposed)
    loop = find_cam_loop(segments, wheel.sense > 0)
    if not len(loop):
        none = np.empty(0, np.complex128)
        return SampledCam(path, exposed, Nodes(none, none, none, none, none, np.empty(0)))
    restrict_to_loop(exposed, segments, loop)
    return SampledCam(path, exposed, loop_nodes(segments, loop))


@inner
def _where_the_cam_ends(wheel):
    """Least and greatest distance [m] of the profile from the cam's axis.

    All centres lie from R - e to R + e, on a closed curve that runs round the axis: a cam inside ends within it, one outside beyond it.
    What is left out is so far beyond that no end of a segment meets it.
    """
    if wheel.sense > 0:
        return 0.0, wheel.circle_radius + wheel.eccentricity + APART
    return wheel.circle_radius - wheel.eccentricity - APART, np.inf


@inner
def _spacing(path):
    """No two neighbours among the samples are further apart [m]."""
    fastest, widest = 0.0, 2 * np.pi - path.theta[-1]
    for k in range(len(path.z)):
        fastest = max(fastest, abs(path.v[k]))
    for j in range(1, len(path.theta)):
        widest = max(widest, path.theta[j] - path.theta[j - 1])
    return fastest * widest


@inner
def _evaluate_contacts(wheel, path, nodes, exposed, stride, count, values, foot_points, curvatures):
    """Least and greatest number of pins that touch; worst angle of the best pin forward, backward, and the best of all.

    exposed (2, samples); values (VALUES,), of which those from 2 to 6 are written; foot_points (n,) [m], curvatures (n,) [1/m]: work
    arrays.
    """
    fewest, most = wheel.pins, 0
    worst_forward, worst_backward, best = wheel.circle_radius, wheel.circle_radius, 0.0
    for step in range(count):
        j, number, forward, backward = step * stride, 0, 0.0, 0.0
        for turn in range(wheel.pins):
            touching = False
            for side in range(2):
                if _is_on_profile(wheel, path, nodes, exposed, j, turn, side, foot_points, curvatures):
                    touching = True
                    arm = _arm(wheel, path, j, turn, side)
                    forward, backward = max(forward, arm), max(backward, -arm)
            number += touching
        fewest, most = min(fewest, number), max(most, number)
        best = max(best, forward, backward)
        if forward > _LEAST_ARM * wheel.circle_radius:
            worst_forward = min(worst_forward, forward)
        if backward > _LEAST_ARM * wheel.circle_radius:
            worst_backward = min(worst_backward, backward)
    values[2], values[3] = fewest, most
    for n, arm in enumerate((worst_forward, worst_backward, best)):
        values[4 + n] = np.arccos(min(arm / wheel.circle_radius, 1.0))


@inner
def _is_on_profile(wheel, path, nodes, exposed, j, turn, side, foot_points, curvatures):
    """Whether the envelope's point lies on the profile. exposed (2, samples); foot_points (n,) [m], curvatures (n,) [1/m]: work arrays."""
    k = turn * len(path.theta) + j
    if exposed[side, k]:
        return True
    return nearest(nodes, _envelope_point(wheel, path, k, side), PROFILE_TOLERANCE, foot_points, curvatures) > 0


@inner
def _envelope_point(wheel, path, k, side):
    """Point (complex, [m]) of the envelope at sample k on a side, seen from the cam."""
    return path.z[k] + (1 - 2 * side) * wheel.pin_radius * 1j * path.v[k] / abs(path.v[k])


@inner
def _arm(wheel, path, j, turn, side):
    """Arm of the cam's force on the pin about the wheel's axis: Im(conj(c) n), n from the contact to the pin's centre."""
    k = turn * len(path.theta) + j
    centre = path.z[k] + _crank(wheel, path.theta[j])
    force = (2 * side - 1) * 1j * path.v[k] / abs(path.v[k])
    return centre.real * force.imag - centre.imag * force.real


@inner
def _crank(wheel, theta):
    """Centre of the cam e exp(i sense theta), complex [m]."""
    return wheel.eccentricity * complex(np.cos(theta), wheel.sense * np.sin(theta))


@inner
def _evaluate_play(wheel, path, nodes, exposed, stride, values, foot_points, curvatures, centres):
    """Greatest play forward and backward; nan where nothing stops the wheel somewhere.

    Where a pin is inside the cam after the greatest play so far, the play is less than that and is not sought.
    exposed (2, samples); values (VALUES,), of which the first two [rad] are written; centres (pins,) [m], foot_points (n,) [m],
    curvatures (n,) [1/m]: work arrays.
    """
    limit = 2 * np.pi / wheel.pins
    for n, direction in enumerate((FORWARD, BACKWARD)):
        largest, pin = 0.0, 0
        for visit in range(_PASSES):
            step = stride << (_PASSES - 1 - visit)
            for j in range(step if visit else 0, len(path.theta), 2 * step if visit else step):
                if largest != largest or _is_stopped(wheel, path, exposed, j, direction):
                    continue
                crank = _crank(wheel, path.theta[j])
                for turn in range(wheel.pins):
                    centres[turn] = path.z[turn * len(path.theta) + j] + crank
                within = pin_within_cam(nodes, centres, crank, wheel.pin_radius, direction, largest, pin, foot_points, curvatures)
                if within >= 0:
                    pin = within
                else:
                    free, pin = free_rotation(nodes, centres, crank, wheel.pin_radius, direction, limit, pin, foot_points, curvatures)
                    largest = max(largest, free) if free == free else np.nan
        values[n] = largest


@inner
def _is_stopped(wheel, path, exposed, j, direction):
    """Whether a pin that touches stops the wheel in the direction. exposed (2, samples)."""
    for turn in range(wheel.pins):
        for side in range(2):
            if (
                exposed[side, turn * len(path.theta) + j]
                and direction * _arm(wheel, path, j, turn, side) < -_LEAST_ARM * wheel.circle_radius
            ):
                return True
    return False


@inner
def _convex_radius(path, exposed):
    """Least radius of curvature of the centre curve where the profile is convex, its centre of curvature on the side of the cam.

    exposed (2, samples); in [m].
    """
    sharpest = 0.0
    for side in range(2):
        for k in range(len(path.z)):
            if exposed[side, k]:
                v, a = path.v[k], path.a[k]
                sharpest = max(sharpest, (1 - 2 * side) * (v.real * a.imag - v.imag * a.real) / abs(v) ** 3)
    return 1.0 / sharpest
