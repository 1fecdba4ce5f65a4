"""The cam once more, by a route that shares no formula with the analyses: the follower is laid on the finished profile.

The profile is a polygon of the shapely library, the follower a point or a line that is lowered until it touches; directions are
differences.  Rows are tuples (name, ours, other, unit, allowed difference, route) in SI.
"""

from collections.abc import Iterator
from typing import Any

import numpy as np

from drivewright import cams
from drivewright.mechanisms.cam.build import CamModel, profile
from drivewright.mechanisms.cam.spec import TURN
from drivewright.numerics.jets import constant, variable
from drivewright.registry import Row
from drivewright.result import Result

CHORD = 1e-9  # m: how far the polygon's chords are from the profile
LAID = "follower laid on the polygon of the finished profile"


def verify(model: CamModel, result: Result[Any]) -> Iterator[Row]:
    """All rows."""
    import shapely

    body, angle = shapely.Polygon(_fine_outline(model).points(CHORD)), np.linspace(0, TURN, 91)[:-1]
    shapely.prepare(body)
    lost = result.values.get("lost_motion")
    sunk = lost.value if lost else 0.0
    laid, planned = _laid(model, body, angle, sunk), model.programme(angle).s
    allowed = (1e-8 + sunk) / model.follower.reach
    unit = "rad" if model.oscillating else "m"
    yield "lift: largest difference over the turn", 0.0, float(np.max(np.abs(laid - planned))), unit, allowed, LAID
    yield "profile.area", result["profile.area"], body.area, "m^2", 1e-6 * body.area, "area of the polygon"
    yield "profile.perimeter", result["profile.perimeter"], body.length, "m", 1e-6 * body.length, "length of the polygon"
    if not model.tracks[0].flat:
        yield from _at_the_extremes(model, result, body, sunk)
    yield from _sunk(model, result)


def _sunk(model, result):
    """The lost motion of every undercut cam: the follower lowered on the polygon around the place that the analysis names."""
    for number, track in enumerate(model.tracks):
        at = result.values.get(f"{track.prefix}lost_motion.at")
        if at is None:
            continue
        name, follower = f"{track.prefix}lost_motion", track.follower
        outline, angle = _trimmed(model, number).outline(CHORD), at.value + np.linspace(-0.02, 0.02, 41)
        way = track.flank * getattr(follower, "side", 1)
        sinks = _lowered(track, outline.points(CHORD), angle, model.programme(angle).s, way / follower.reach, result[name])
        yield name, result[name], float(np.max(sinks)), "m", 1e-4 * result[name] + 1e-8, LAID


def _lowered(track, points, angle, lift, way, guess):
    """Depth of travel [m] at which the face first touches the polygon, in small steps and then by bisection; nan where it does not."""
    import shapely

    body = shapely.Polygon(points)
    shapely.prepare(body)
    low, high = np.zeros(angle.shape), np.full(angle.shape, np.nan)
    for depth in np.linspace(0.0, 2 * guess, 81)[1:]:
        touched = np.isnan(high) & (_clear(track, body, angle, lift - way * depth) <= 0)
        high[touched] = depth
        low[np.isnan(high)] = depth
    for _ in range(40):
        middle = 0.5 * (low + high)
        free = _clear(track, body, angle, lift - way * np.nan_to_num(middle)) > 0
        low, high = np.where(free, middle, low), np.where(free, high, middle)
    return high


def _clear(track, body, angle, lift):
    """Distance of the face from the material [m], negative in it; of an outer wall the body is the hole."""
    import shapely

    at = variable(angle), constant(lift)
    if track.flat:
        direction, support = track.follower.face(*at)
        points = np.array(body.exterior.coords) @ (1, 1j)
        return support.d0 - np.array([np.max((points * np.exp(-1j * d)).real) for d in direction.d0])
    centers = track.follower.pitch(*at).d0
    points = shapely.points(centers.real, centers.imag)
    free = shapely.contains(body, points) == (track.flank < 0)
    return np.where(free, 1.0, -1.0) * shapely.distance(body.exterior, points) - track.follower.radius


def _trimmed(model, number):
    trimmed = profile(model, number).trimmed
    assert trimmed, "a knife edge has no undercut"
    return trimmed


def _fine_outline(model):
    trimmed = profile(model, 0).trimmed
    if trimmed:
        return trimmed.outline(CHORD)
    return cams.pitch_outline(model.tracks[0].round_face, model.programme, CHORD)


def _laid(model, body, angle, sunk=0.0):
    """Lift at which the follower touches the body, by bisection at all angles at once."""
    planned = model.programme(angle).s
    room = 0.5 * np.ptp(planned) + 1e-3 / model.follower.reach
    low, high = planned - max(0.2 * room, 2 * sunk / model.follower.reach), planned + 0.2 * room
    for _ in range(36):
        middle = 0.5 * (low + high)
        free = _clear(model.tracks[0], body, angle, middle) > 0
        low, high = np.where(free, low, middle), np.where(free, middle, high)
    return 0.5 * (low + high)


def _centers(model, angle, lift):
    return model.follower.pitch(variable(np.asarray(angle)), constant(np.asarray(lift))).d0


def _at_the_extremes(model, result, body, sunk):
    """Pressure angle and curvature from touching points and differences, at the places that the analyses name."""
    for name in ("max_pressure_angle", "min_pressure_angle"):
        if model.follower.radius and not sunk:
            other = _pressure_angle(model, body, result[f"{name}.at"])
            yield name, result[name], other, "rad", 5e-4, "touching point of the polygon, path by difference"
    if "min_convex_radius" in result.values:
        at = result["min_convex_radius.at"] + np.array([-1e-3, 0.0, 1e-3])
        radius, ours = _through(_centers(model, at, model.programme(at).s)), result["min_convex_radius"]
        yield "min_convex_radius", ours, radius, "m", 1e-2 * ours, "circle through three near places of the roller's centre"


def _pressure_angle(model, body, angle):
    """Angle between the line from the touching point to the centre and the path of a lift that grows."""
    import shapely

    lift, step = model.programme(angle).s, 1e-6 / model.follower.reach
    low, center, high = _centers(model, np.full(3, angle), lift + step * np.array([-1.0, 0.0, 1.0]))
    _, touch = shapely.get_coordinates(shapely.shortest_line(shapely.Point(center.real, center.imag), body.exterior))
    return float(model.follower.sense * np.angle((center - complex(*touch)) / (high - low)))


def _through(z):
    """Radius of the circle through three points."""
    a, b, c = abs(z[1] - z[0]), abs(z[2] - z[1]), abs(z[2] - z[0])
    return float(a * b * c / (2 * abs(np.imag(np.conj(z[1] - z[0]) * (z[2] - z[0])))))
