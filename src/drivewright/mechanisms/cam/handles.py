"""Sizes of a cam that a hand can move on the drawing: radii, offset, arms and pivot, bore.

Points and directions are complex [m, m per SI unit] and stand in the frame of the follower at zero lift, unless a function says otherwise.
"""

from collections.abc import Iterator

import numpy as np

from drivewright.cams.followers import OscillatingFlat, OscillatingRound, TranslatingFlat, TranslatingRound
from drivewright.mechanisms.cam.build import CamModel
from drivewright.scene import Handle, xy

ABOVE = 0.6  # of the prime radius: how far above its face the stem of a slide has its handle
ALONG = 0.6  # of an arm: where on it its handle is


def handles(model: CamModel) -> Iterator[Handle]:
    """The handles of follower, second roller, valve arm, pivot and bore."""
    follower = model.follower
    if isinstance(follower, TranslatingFlat):
        yield from _flat_slide(model, follower)
    elif isinstance(follower, OscillatingFlat):
        yield from _flat_lever(model, follower)
    else:
        yield from _round(model)
    if isinstance(follower, OscillatingFlat | OscillatingRound):
        yield Handle("follower.pivot_distance", (float(follower.pivot_distance), 0.0), (1.0, 0.0))
    if model.arm:
        yield from _valve_arm(model)
    if bore := model.spec.manufacture.bore:
        yield Handle("manufacture.bore", (0.0, -bore / 2), (0.0, -0.5), "cam")


def _handle(key: str, point: complex, direction: complex) -> Handle:
    return Handle(key, xy(complex(point)), xy(complex(direction)), "follower")


def _radius_key(model):
    return "follower.prime_radius" if model.spec.follower.prime_radius is not None else "follower.base_radius"


# -- round faces -----------------------------------------------------------------------------------------------------------------


def _round(model):
    """Roller, shoe or knife: radius of cam and face, offset or arm; the same of the second roller of a conjugate cam."""
    given, follower = model.spec.follower, model.follower
    centre, grown = model.shapes.centers[0] + model.shapes.origin, _by_radius(follower, model.shapes.centers[0])
    yield _on_contact(_radius_key(model), follower, model.shapes.centers[0], model.shapes.origin)
    follows = grown if given.prime_radius is None else 0j  # with the base radius held, a larger roller stands further out
    if given.face == "roller":
        yield _handle("follower.roller_radius", centre - model.shapes.origin + follower.radius, 1 + follows)
    elif given.face == "shoe" and given.prime_radius is None:
        yield _handle("follower.face_radius", centre - model.shapes.origin, grown)
    yield from _guidance(model, "follower", follower, model.shapes.centers[0], given.face == "shoe")
    if model.spec.closure == "conjugate":
        yield from _second_roller(model)


def _second_roller(model):
    """The roller on the conjugate cam."""
    given, second, centre = model.spec.conjugate, model.tracks[1].follower, model.shapes.centers[1]
    yield _on_contact("conjugate.prime_radius", second, centre, model.shapes.origin)
    if given.roller_radius is not None:
        yield _handle("conjugate.roller_radius", centre + second.radius, 1)
    if not model.oscillating or given.arm_length is not None:
        yield from _guidance(model, "conjugate", second, centre, False)


def _on_contact(key, follower, centre, origin):
    """The radius of the cam, where the line from its axis to the centre of the face crosses the face."""
    arm, grown, prime, radius = centre + origin, _by_radius(follower, centre), follower.prime_radius, follower.radius
    return _handle(key, arm * (1 - radius / prime) - origin, grown * (1 - radius / prime) + arm * radius / prime**2)


def _by_radius(follower, centre):
    """How the centre of a round face moves with the radius of the pitch curve at zero lift."""
    if isinstance(follower, TranslatingRound):
        return 1j * follower.prime_radius / centre.imag
    return _where(follower, centre, follower.prime_radius, 0.0)


def _where(follower: OscillatingRound, centre, radially, along):
    """The motion dz of the centre z of a lever's roller with z . dz = radially, q . dz = along, q its place from the pivot."""
    out = centre + follower.pivot_distance
    return complex(*np.linalg.solve([[out.real, out.imag], [centre.real, centre.imag]], [radially, along]))


def _guidance(model, table, follower, centre, shoe):
    """Offset of a slide, upon its stem, where it may have one; length of an arm, upon the arm."""
    if isinstance(follower, TranslatingRound):
        if model.spec.closure == "yoke":
            return
        up = ABOVE * follower.prime_radius * 1j if table == "follower" else 0j
        yield _handle(f"{table}.offset", centre + up, follower.sense - 1j * follower.offset / centre.imag)
    elif not shoe:
        yield _handle(f"{table}.arm_length", ALONG * centre, ALONG * _where(follower, centre, 0.0, follower.arm_length))


# -- flat faces and the valve ----------------------------------------------------------------------------------------------------


def _flat_slide(model, follower):
    """Radius where the slide's line meets the face; offset upon the stem."""
    lean, tall = np.tan(follower.tilt), 1 / np.cos(follower.tilt)
    foot = follower.sense * follower.offset + 1j * (follower.base_radius * tall + follower.offset * lean)
    yield _handle(_radius_key(model), foot, 1j * tall)
    if model.spec.closure != "yoke":
        yield _handle("follower.offset", foot + 1j * ABOVE * follower.base_radius, follower.sense + 1j * lean)


def _flat_lever(model, follower):
    """Radius where the face is nearest to the cam's axis; the radius at which mass and force act upon the arm."""
    psi = float(follower.rest_angle)
    normal, level = 1j * np.exp(-1j * psi), follower.pivot_distance * np.cos(psi)
    yield _handle(
        _radius_key(model), follower.base_radius * normal - follower.pivot_distance, normal * (1 - 1j * follower.base_radius / level)
    )
    yield _handle("follower.arm_length", normal * (1j * follower.arm_length + follower.face_offset), 1j * normal)


def _valve_arm(model):
    """Length of the second arm at its end, its angle half-way."""
    along = np.exp(-1j * model.arm.start)
    yield _handle("valve.arm_length", model.arm.length * along, along)
    yield _handle("valve.start_angle", 0.5 * model.arm.length * along, -0.5j * model.arm.length * along)
