"""Sizes of a seedling pusher that a hand can move on the drawing: carrier, needle, lever, rollers, rod and cams.

Points and directions are complex [m, m per SI unit], in the frame of the body that carries them, at the start of the turn.
"""

from collections.abc import Iterator

import numpy as np

from drivewright.mechanisms.seedling_pusher.build import PusherModel
from drivewright.scene import Handle, xy

NEEDLE = 60e-3  # of the needle's line behind its tip, as drawn [m]


def handles(model: PusherModel, rollers: dict[str, complex]) -> Iterator[Handle]:
    """All handles; `rollers` are the centres of the rollers with the rod in, from the lever's pivot."""
    yield from _carrier(model)
    yield from _arm(model)
    yield from _lever(model, rollers)
    bore = model.spec.cams.bore
    yield _handle("cams.bore", -0.5j * bore, -0.5j, "cam.main")


def _handle(key: str, point: complex, direction: complex, body: str) -> Handle:
    return Handle(key, xy(complex(point)), xy(complex(direction)), body)


def _carrier(model):
    """Length of the arms at the intermediate axis, angle of the first arm half-way, bend at the planet's axis."""
    train = model.spec.train
    first, second = np.exp(1j * train.carrier_angle), np.exp(1j * (train.carrier_angle + model.arm.bend))
    sense = 1 if train.bend_reading == "turned" else -1
    yield _handle("train.semi_major", 2 * train.semi_major * first, 2 * first, "carrier")
    yield _handle("train.carrier_angle", train.semi_major * first, 1j * train.semi_major * first, "carrier")
    yield _handle("train.bend", 2 * train.semi_major * (first + second), sense * 2j * train.semi_major * second, "carrier")


def _arm(model):
    """Distance and angle of the tip, slope of the needle, pivot of the lever, stroke of the rod."""
    given, along = model.spec.arm, np.exp(1j * model.arm.start)
    tip, sense = given.tip_distance * along, -1 if given.tip_reference == "carrier" else 1
    yield _handle("arm.tip_distance", tip, along, "arm")
    yield _handle("arm.tip_angle", 0.5 * tip, 0.5j * sense * tip, "arm")
    yield _handle("arm.needle_angle", tip - NEEDLE * model.needle, 1j * NEEDLE * model.needle, "arm")
    yield _handle("lever.pivot_distance", model.spec.lever.pivot_distance * model.outwards, model.outwards, "arm")
    yield _handle("push.stroke", model.rod_ends[1], -model.needle, "arm")
    yield _handle("lever.rod_length", model.rod_ends[0], -model.needle, "rod")


def _lever(model, rollers):
    """Pitch radii at the rollers, arms upon the arms, radius of the rollers at an edge, slotted arm at its end."""
    pivot = model.spec.lever.pivot_distance * model.outwards
    for cam in model.pair.cams:
        centre = rollers[cam.name]
        out = pivot + centre
        yield _handle(f"cams.prime_radius_{cam.name}", centre, _with_lengths(out, centre, cam.prime_radius, 0.0), "lever")
        yield _handle(f"lever.arm_{cam.name}", 0.5 * centre, 0.5 * _with_lengths(out, centre, 0.0, cam.arm), "lever")
    radius = model.spec.cams.roller_radius
    yield _handle("cams.roller_radius", rollers["main"] + radius, 1, "lever")
    yield _handle("lever.output_arm", model.spec.lever.output_arm * model.outwards, model.outwards, "lever")


def _with_lengths(out, centre, radially, along):
    """The motion dz of a roller's centre with out . dz = radially and centre . dz = along: from the cam's axis, from the pivot."""
    return complex(*np.linalg.solve([[out.real, out.imag], [centre.real, centre.imag]], [radially, along]))
