"""Supports of a shaft from bearing data: springs, radial curves and rolling bearings, each on a housing that may yield."""

from collections.abc import Collection
from typing import NamedTuple

import numpy as np

from drivewright import bearings
from drivewright._typing import Floats
from drivewright.bearings.solving import RollingBearing
from drivewright.shafts.assembly import AXIAL
from drivewright.shafts.curves import RadialCurve
from drivewright.shafts.equilibrium import ShaftEquilibrium
from drivewright.shafts.model import NOTHING, PlaneMatrix, Support

CENTRED = (0.0,) * 5
RIGID_HOUSING = (np.inf, np.inf)
IDLE = 1e-9  # of the largest reaction: what rounding leaves to a bearing


def series_stiffness(one: float, two: float) -> float:
    """1/k = 1/k1 + 1/k2; 0 is no spring, inf rigid."""
    return 1 / (1 / one + 1 / two) if one > 0 and np.isfinite(min(one, two)) else min(one, two)


def spring_support(
    name: str,
    position: float,
    radial: float | tuple[float, float] | RadialCurve,
    axial: float = 0.0,
    tilt: float = 0.0,
    *,
    cross: tuple[float, float] = (0.0, 0.0),
    damping: PlaneMatrix = NOTHING,
    housing: tuple[float, float] = RIGID_HOUSING,
    offset: tuple[float, ...] = CENTRED,
    width: float = 0.0,
) -> Support:
    """A `Support` of springs: radial and axial [N/m], tilt [N m/rad], 0 is free and inf rigid; `radial` may be a pair along x and y, or a
    `RadialCurve`.

    cross: force along x over a displacement along y, and along y over one along x [N/m], of the bearing without its housing;
    damping ((cxx, cxy), (cyx, cyy)) [N s/m] likewise; housing: its radial and axial stiffness [N/m], in series; offset (5,): place of the
    seat [m, rad]; width [m] of the seat.
    """
    if isinstance(radial, RadialCurve):
        seat = (housing[0], housing[0], housing[1], np.inf, np.inf)
        return Support(name, position, (0.0, 0.0, axial, tilt, tilt), radial, seat=seat, offset=offset, width=width, damping=damping)
    x, y = radial if isinstance(radial, tuple) else (radial, radial)
    if any(cross) or damping != NOTHING:  # they act on the bearing alone, which so is kept apart from its housing
        seat, coupling = (housing[0], housing[0], housing[1], np.inf, np.inf), ((0.0, cross[0]), (cross[1], 0.0))
        return Support(name, position, (x, y, axial, tilt, tilt), seat=seat, offset=offset, width=width, coupling=coupling, damping=damping)
    x, y, axial = (series_stiffness(own, seat) for own, seat in zip((x, y, axial), (housing[0], *housing), strict=True))
    return Support(name, position, (x, y, axial, tilt, tilt), offset=offset, width=width)


def rolling_support(
    name: str,
    position: float,
    bearing: RollingBearing,
    *,
    preload: float = 0.0,
    mirrored: bool = False,
    free: Collection[str] = (),
    housing: tuple[float, float] = RIGID_HOUSING,
    offset: tuple[float, ...] = CENTRED,
    width: float = 0.0,
    damping: PlaneMatrix = NOTHING,
) -> Support:
    """A `Support` with the law of a rolling bearing; InputError where a preload is given and it takes no axial force.

    preload [N]: axial force that it is mounted with, or that of the spring behind an outer ring that is `free` ("axial", "tilt") to
    slide or to tilt in its seat; mirrored: it takes axial forces on the shaft to the left; the rest as for `spring_support`.
    """
    law = bearings.law_of(bearing)
    seat, push = [housing[0], housing[0], housing[1], np.inf, np.inf], [0.0] * 5
    unloaded = 0.0 if bearing.contact_angle else bearings.measures(law).centre
    place = unloaded
    if "tilt" in free:
        seat[3:] = 0.0, 0.0
    if preload:
        place = bearings.solve(bearing, force=[0, 0, preload, 0, 0], held=("x", "y", "tilt_x", "tilt_y")).displacement[2]
    if "axial" in free:
        seat[2], push[2], place = 0.0, -preload, unloaded
    x, y, _, tilt_x, tilt_y = offset
    turn = -1.0 if mirrored else 1.0
    own = (x, y, -place, turn * tilt_x, turn * tilt_y)
    seat, push = tuple(seat), tuple(push)
    return Support(name, position, law=law, mirrored=mirrored, offset=own, seat=seat, push=push, width=width, damping=damping)


# -- at rest ---------------------------------------------------------------------------------------------------------------------


class SupportStiffness(NamedTuple):
    """Radial force [N] of a support at rest; along it the tangent stiffness, all else held, and the secant from the seat's axis [N/m],
    nan where nothing is displaced with the force; the tangents along the axis [N/m] and against tilting about x and y [N m/rad]."""

    load: float
    tangent: float
    secant: float
    axial: float
    tilt_x: float
    tilt_y: float


def support_stiffness(equilibrium: ShaftEquilibrium, number: int, direction: Floats) -> SupportStiffness:
    """The `SupportStiffness` of a support by its number, along `direction` (x, y) where it carries nothing."""
    force, displacement = -equilibrium.reactions[number, :2], equilibrium.relative[number, :2]
    load, tangent = float(np.hypot(*force)), equilibrium.tangent[number]
    way = force / load if load > 0 else direction
    moved = float(way @ displacement)
    secant = load / moved if load > 0 and moved > 0 else np.nan
    return SupportStiffness(load, float(way @ tangent[:2, :2] @ way), secant, *map(float, np.diag(tangent)[2:]))


def slides_freely(equilibrium: ShaftEquilibrium) -> bool:
    """Whether no support holds the shaft along its axis."""
    return AXIAL in equilibrium.model.pinned


def is_idle(equilibrium: ShaftEquilibrium, number: int) -> bool:
    """Whether a support carries no more force than rounding leaves to it."""
    forces = np.abs(equilibrium.reactions[:, :3])
    return not forces[number].max() > IDLE * forces.max()


def bearing_displacement(equilibrium: ShaftEquilibrium, number: int) -> Floats:
    """Displacement (5,) [m, rad] of the inner ring against the outer in a support with a law, in the law's own axes."""
    mount = equilibrium.model.mounts[number]
    return mount.rows @ equilibrium.unknowns - mount.support.offset
