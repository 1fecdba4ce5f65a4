"""The follower as shapes, in its own frame: a slide's origin is the cam's centre at zero lift, a lever's is its pivot.

Points are complex [m] and become (x, y) at the end.
"""

from typing import Any

import numpy as np

from drivewright import cams
from drivewright.mechanisms.cam.build import CamModel
from drivewright.numerics.jets import constant, variable
from drivewright.scene import Arc, Line, Outline, Shape, circle, polygon

SLIM = 0.12  # width of stems and levers, of the size of the cam


def rest_center(follower: Any) -> complex:
    """Centre of a round face at zero lift, machine frame."""
    zero = np.array([0.0])
    return complex(follower.pitch(variable(zero), constant(zero)).d0[0])


def size(model: CamModel) -> float:
    """Greatest distance of the pitch curve from the cam's centre."""
    piece, angle = model.cycle.samples(np.radians(5))
    return float(np.max(np.abs(model.tracks[0].contact(*model.cycle.at(piece, angle)).pitch.d0)))


def origin(model: CamModel) -> Any:
    """Origin of the follower's frame in the machine frame at zero lift."""
    return complex(model.follower.pivot_distance) if model.oscillating else 0j


def pair(z: Any) -> Any:
    """(x, y) of a complex number."""
    return float(z.real), float(z.imag)


def bar(a: complex, b: complex, width: float) -> Outline:
    """A link with round ends between two points."""
    along, half = float(np.angle(b - a)), 0.5 * width * np.exp(1j * (np.angle(b - a) + np.pi / 2))
    return Outline(
        (
            Arc(pair(a), width / 2, along + np.pi / 2, np.pi),
            Line(pair(a - half), pair(b - half)),
            Arc(pair(b), width / 2, along - np.pi / 2, np.pi),
            Line(pair(b + half), pair(a + half)),
        )
    )


def beam(a: complex, b: complex, depth: complex) -> Outline:
    """A rectangle from a to b, `depth` (complex) deep."""
    return polygon([pair(z) for z in (a, b, b + depth, a + depth)])


def follower_shapes(model: CamModel) -> tuple[Shape, ...]:
    """Shapes of the follower in its own frame."""
    faces = _flat_faces(model) if model.tracks[0].flat else _round_faces(model)
    return (*_carrier(model, size(model)), *faces)


def centers(model: CamModel) -> Any:
    """Centres of the round faces in the follower's frame: of the first track, of a second cam or of a yoke's second roller."""
    found = [rest_center(model.follower)]
    if model.spec.closure == "conjugate":
        found.append(rest_center(model.tracks[1].follower))
    if model.spec.closure == "yoke":
        found.append(found[0] - 1j * model.yoke_breadth)
    return [center - origin(model) for center in found]


def _away(model):
    """Direction of the follower's path at zero lift, away from the cam."""
    return 1j * np.exp(-1j * model.follower.rest_angle) if model.oscillating else 1j


def _thickness(model):
    """Thickness of a curved shoe."""
    return min(0.5 * SLIM * size(model), 0.5 * model.follower.radius)


def _anchors(model):
    """Where stem or arms hold the faces: the centres, on a shoe its back."""
    if model.spec.follower.face != "shoe":
        return centers(model)
    return [center - _away(model) * (model.follower.radius - _thickness(model)) for center in centers(model)]


def _round_faces(model):
    rollers = [track.radius for track in model.tracks if track.flank > 0]
    for center, radius in zip(centers(model), rollers, strict=False):
        if model.spec.follower.face == "roller":
            yield Shape("roller", circle(pair(center), radius))
            yield Shape("hole", circle(pair(center), 0.3 * radius))
        elif radius:
            yield Shape("body", _shoe(model, center, radius))
        else:
            corner = SLIM * size(model) * _away(model)
            yield Shape("body", polygon([pair(z) for z in (center, center + corner * (1 - 0.5j), center + corner * (1 + 0.5j))]))


def _shoe(model, center, radius):
    """A curved plate, as long as the contact wanders and a little more."""
    reach = 0.15 + max(abs(a) for a in _pressure_range(model))
    inner, start = radius - _thickness(model), float(np.angle(-_away(model))) - reach
    near, far = (lambda r, turn: pair(center + r * np.exp(1j * (start + turn)))), 2 * reach
    return Outline(
        (
            Arc(pair(center), radius, start, far),
            Line(near(radius, far), near(inner, far)),
            Arc(pair(center), inner, start + far, -far),
            Line(near(inner, 0.0), near(radius, 0.0)),
        )
    )


def _pressure_range(model):
    def angle_of(angle, lift):
        return model.tracks[0].contact(angle, lift).pressure_angle

    return model.cycle.least(angle_of).value, model.cycle.greatest(angle_of).value


def _flat_faces(model):
    """The flat face, as long as it is used and a little more, and the second face of a yoke."""
    follower, thick = model.follower, 0.5 * SLIM * size(model)
    low, high = cams.face_ends(model.cycle, follower)
    low, high = low - thick, high + thick
    if model.oscillating:
        normal = _away(model)
        foot = follower.face_offset * normal
        yield Shape("body", beam(foot + 1j * normal * max(low, 0.0), foot + 1j * normal * high, thick * normal))
        return
    normal = 1j * np.exp(1j * follower.sense * follower.tilt)
    along, start = -1j * follower.sense * normal, _foot(follower)
    yield Shape("body", beam(start + low * along, start + high * along, thick * normal))
    if model.spec.closure == "yoke":
        other = start - 1j * model.yoke_breadth
        yield Shape("body", beam(other + low * along, other + high * along, -thick * normal))


def _foot(follower):
    """Where the line of a slide meets its flat face at zero lift."""
    return follower.sense * follower.offset + 1j * (follower.base_radius + follower.offset * np.sin(follower.tilt)) / np.cos(follower.tilt)


def _carrier(model, size_):
    """Stem of a slide, or arms of a lever."""
    width = SLIM * size_
    if model.oscillating:
        return [Shape("body", bar(0j, end, width)) for end in (_flat_arm(model.follower) if model.tracks[0].flat else _anchors(model))]
    first = _foot(model.follower) if model.tracks[0].flat else _anchors(model)[0]
    stem = [Shape("body", beam(first - width / 2, complex(first.real - width / 2, 1.75 * size_), complex(width)))]
    return stem + (_posts(model, first, width) if model.spec.closure in ("conjugate", "yoke") else [])


def _flat_arm(follower):
    """End of the arm that carries a flat face."""
    return [1j * np.exp(-1j * follower.rest_angle) * (1j * follower.arm_length + follower.face_offset)]


def _posts(model, first, width):
    """The frame that joins the faces above and below the cam."""
    low = first.imag - model.yoke_breadth if model.tracks[0].flat else centers(model)[1].imag
    half = 1.15 * size(model) + width
    return [Shape("axis", polygon([(-half, low - width), (half, low - width), (half, first.imag + width), (-half, first.imag + width)]))]
