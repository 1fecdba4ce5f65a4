"""The pusher once more, by routes that share no formula with the analyses.

Train: the ellipses are rolled on each other by arc length.  Cams: every roller centre is constructed, every derivative is a
difference, the profile is shapely's.  Motion: the cam pair runs as a multibody model with contact in Exudyn.
Rows are tuples (name, ours, other, unit, allowed difference, route) in SI.
"""

from collections.abc import Iterator
from typing import Any

import numpy as np

from drivewright.errors import MissingExtra
from drivewright.mechanisms.seedling_pusher.build import TURN, PusherModel
from drivewright.oracles.seedling_pusher.multibody_run import MultibodyRun
from drivewright.oracles.seedling_pusher.rolled_motion import RolledMotion
from drivewright.registry import LeftOut, Row
from drivewright.result import Result

ROD_ERROR = 0.2e-3  # what facets and elasticity of the contact may cost the rod [m]
ROLLED, CONSTRUCTED = "ellipses rolled by arc length", "roller path by construction, differences"
ERODED = "shapely: eroded polygon of the constructed roller path"
SUNK = "roller sunk on the eroded polygon along its arc"


def verify(model: PusherModel, result: Result[Any]) -> Iterator[Row | LeftOut]:
    """All rows; without Exudyn, what is left out."""
    yield from geometry(model, result, RolledMotion(model))
    try:
        made = multibody_run(model)
    except MissingExtra as error:
        yield LeftOut("motion of the rod in Exudyn", str(error), error.extra)
        return
    yield from motion(model, result, made)


def multibody_run(model: PusherModel) -> MultibodyRun:
    """One turn of the carrier with contact in Exudyn; MissingExtra without it."""
    try:
        from drivewright.oracles.seedling_pusher import exudyn_model
    except ImportError as error:
        raise MissingExtra("the multibody run of the cam pair in Exudyn", "peers", error) from None
    return exudyn_model.simulate(model, RolledMotion(model).planet)


def geometry(model: PusherModel, result: Result[Any], rolled: RolledMotion) -> tuple[Row, ...]:
    """Rows of train, track and cams, which need no extra."""
    cams = (row for cam in model.pair.cams for row in (*_profile(model, result, rolled, cam), *_pitch_curve(result, rolled, cam)))
    return (*_train(model, result, rolled), *_track(result, rolled), *cams, _roller_distance(model, result, rolled))


# -- train and track -------------------------------------------------------------------------------------------------------------


def _train(model, result, rolled):
    apart = np.abs(rolled.planet(rolled.turn) - model.arm.planet(rolled.turn).d0)
    size = 2 * model.spec.train.semi_major
    yield "train, planet angle: largest difference", 0.0, float(apart.max()), "rad", 1e-9, ROLLED
    yield "train.collinear_angle", result["train.collinear_angle"], _collinear(rolled), "rad", 1e-9, ROLLED
    yield "train, spacing of the free foci", size, _free_foci(model, rolled.turn), "m", 1e-12, "crossed four-bar of the free foci"


def _collinear(rolled):
    """The later carrier angle at which the intermediate gear's major axis lies along the second arm, by bisection."""
    multiples = np.pi * np.arange(4) - rolled.bend
    target, low, high = multiples[multiples < TURN].max(), 0.0, TURN
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if rolled.driven(middle) < target else (low, middle)
    return low


def _free_foci(model, t):
    """Of both meshes the spacing, farthest from 2a, of the foci that are no axes: they move like the coupler of a crossed four-bar."""
    train, (sun, middle, planet) = model.spec.train, (angle.d0 for angle in model.arm.train.angles(t))
    size, e = 2 * train.semi_major, np.sqrt(1 - train.axis_ratio**2) * (1 if train.start == "near" else -1)
    on_sun, on_middle = -size * e * np.exp(1j * sun), size - size * e * np.exp(-1j * middle)
    on_planet = size + size * np.exp(1j * model.arm.bend) * (1 - e * np.exp(1j * planet))
    return _farthest(np.abs(np.concatenate([on_sun - on_middle, on_middle - on_planet])), size)


def _track(result, rolled):
    t, tip = rolled.turn, rolled.tip(rolled.turn)
    (low, depth), (_, height), (_, east), (_, west) = (_vertex(t, y) for y in (-tip.imag, tip.imag, tip.real, -tip.real))
    yield "tip.lowest_angle", result["tip.lowest_angle"], low, "rad", 1e-7, ROLLED
    yield "tip.track_height", result["tip.track_height"], height + depth, "m", 1e-9, ROLLED
    yield "tip.track_width", result["tip.track_width"], east + west, "m", 1e-9, ROLLED


def _vertex(x, y):
    """(place, greatest value) of equidistant periodic samples by the parabola through the highest three."""
    k = int(np.argmax(y[:-1]))
    before, here, after = y[k - 1] if k else y[-2], y[k], y[k + 1]
    shift = 0.5 * (before - after) / (before - 2 * here + after)
    return float(x[k] + shift * (x[1] - x[0])), float(here - 0.25 * (before - after) * shift)


def _farthest(values, ours):
    return float(values[np.argmax(np.abs(values - ours))])


# -- cams ------------------------------------------------------------------------------------------------------------------------


def _profile(model, result, rolled, cam):
    from shapely import LinearRing, Polygon, distance, points

    prefix, centres = f"cam.{cam.name}", _pairs(rolled.roller(cam, rolled.cycle))
    shape = Polygon(LinearRing(centres).buffer(cam.roller_radius, quad_segs=256).interiors[0])
    ours = LinearRing(model.pair.trimmed[cam.name].outline(1e-8).points(1e-8))
    area, perimeter, gap = (result[f"{prefix}.{name}"] for name in ("profile_area", "profile_perimeter", "profile_gap"))
    eroded, left = (distance(curve, points(centres[::3])) - cam.roller_radius for curve in (shape.exterior, ours))
    yield f"{prefix}.profile_area", area, shape.area, "m^2", 2e-5 * area, ERODED
    yield f"{prefix}.profile_perimeter", perimeter, shape.length, "m", 2e-5 * perimeter, ERODED
    yield f"{prefix}.profile_gap", gap, float(eroded.max()), "m", 1e-6, ERODED
    yield f"{prefix}.lost_motion", result[f"{prefix}.lost_motion"], _sunk(rolled, cam, shape), "m", 1e-6, SUNK
    yield f"{prefix}, roller off our profile", gap, float(left.max()), "m", 2e-7, "our profile under the constructed rollers"
    yield f"{prefix}, roller pressed into our profile", 0.0, float(left.min()), "m", 2e-7, "our profile under the constructed rollers"


def _sunk(rolled, cam, shape):
    """How far at most the roller sinks along its arc about the pivot until it rests on the polygon, by bisection of the arm's turn [m]."""
    from shapely import distance, points

    t = rolled.cycle[::3]
    centre, pivot = rolled.roller(cam, t), rolled.pivot(t)

    def clear(turn):
        moved = pivot + (centre - pivot) * np.exp(1j * turn)
        return distance(shape.exterior, points(_pairs(moved))) - cam.roller_radius

    inwards = -np.sign((np.conj(centre) * 1j * (centre - pivot)).real)
    low, high = np.zeros(len(t)), np.full(len(t), 0.5 * cam.roller_radius / cam.arm)
    for _ in range(40):
        middle = 0.5 * (low + high)
        free = clear(inwards * middle) > 0
        low, high = np.where(free, middle, low), np.where(free, high, middle)
    return float(cam.arm * low.max())


def _pairs(z):
    return np.column_stack([z.real, z.imag])


def _pitch_curve(result, rolled, cam):
    for phase in ("rise", "return"):
        name = f"cam.{cam.name}.max_pressure_angle.{phase}"
        yield name, result[name], max(_pressure_angle(rolled, cam, t) for t in rolled.pieces(phase)), "rad", 1e-5, CONSTRUCTED
    name = f"cam.{cam.name}.min_convex_radius"
    sharpest = max(_sharpness(rolled, cam, t) for t in rolled.pieces("rise", "return"))
    yield name, result[name], 1 / sharpest, "m", 1e-6, CONSTRUCTED


def _pressure_angle(rolled, cam, t):
    """Largest angle between the normal of the roller's path in the cam frame and its path about the pivot [rad]."""
    centre = rolled.roller(cam, t)
    along = np.gradient(centre, t, edge_order=2) * np.conj(centre - rolled.pivot(t))
    return float(np.max(np.abs(np.arctan(along.imag / along.real))))


def _sharpness(rolled, cam, t):
    """Greatest curvature [1/m] of the circles through three roller centres, where they bend around the cam."""
    z = rolled.roller(cam, t[::4])
    a, b = z[1:-1] - z[:-2], z[2:] - z[1:-1]
    return float(np.max(2 * rolled.model.pair.orbit * np.imag(np.conj(a) * b) / (np.abs(a) * np.abs(b) * np.abs(a + b))))


def _roller_distance(model, result, rolled):
    main, back = (rolled.roller(cam, rolled.turn) for cam in model.pair.cams)
    ours = result["cam.roller_distance"]
    return "cam.roller_distance", ours, _farthest(np.abs(main - back), ours), "m", 1e-12, f"{CONSTRUCTED}; the one farthest from ours"


# -- motion ----------------------------------------------------------------------------------------------------------------------


def motion(model: PusherModel, result: Result[Any], run: MultibodyRun) -> Iterator[Row]:
    """Rows of the multibody run: stroke, swing, and how far the rod leaves its programme."""
    route = "Exudyn: polyline cams in contact with rollers, rod in the lever's slot, no play"
    error = run.travel - model.pair.travel(model.pair.start + run.angle).d0
    behind, ahead = (ROD_ERROR + _freed(model, result, cam) for cam in model.pair.cams)
    swing, allowed = result["lever.swing"], max(ahead, behind) / model.spec.lever.output_arm
    yield "rod, stroke", model.spec.push.stroke, float(np.ptp(run.travel)), "m", max(ahead, behind), route
    yield "rod, furthest ahead of its programme", 0.0, float(error.max()), "m", ahead, route
    yield "rod, furthest behind its programme", 0.0, float(error.min()), "m", behind, route
    yield "lever.swing", swing, float(np.ptp(run.swing)), "rad", allowed, route


def _freed(model, result, cam):
    """How far the rod can leave its programme at most where this cam is undercut: behind for the main, ahead for the return cam [m]."""
    prefix, arm = f"cam.{cam.name}", model.spec.lever.output_arm
    return result[f"{prefix}.lost_motion"] / cam.arm * arm / np.cos(result["lever.swing"]) ** 2
