"""The shaft on screen and for manufacture: the load grows and fades, the shaft bends, much exaggerated; its drawing and its solid.

The picture looks along the plane of the unit loads: z to the right, against the load up.
"""

from math import floor, log10

import numpy as np

from drivewright import shafts
from drivewright.errors import SolverError
from drivewright.mechanisms.shaft import sketch
from drivewright.mechanisms.shaft.influence import flexibility
from drivewright.result import Answer
from drivewright.scene import Body, Drawing, Frame, Part, Scene, Shape, Turned, polygon
from drivewright.shafts.beam import line

FRAMES, SLICES = 61, 90
SHOWN = 0.06  # the largest deflection is drawn as about this part of the shaft's length


def scene(model):
    """The shaft under its loads; without loads under a force at the last station."""
    phase = np.linspace(0.0, 2 * np.pi, FRAMES)
    part = 0.5 * (1 - np.cos(phase))
    still = np.zeros((FRAMES, 3))
    z = _cuts(model)
    middles = 0.5 * (z[1:] + z[:-1])
    up, turn, words = _bent(model, z)
    factor = exaggeration(np.abs(up).max(), model.shaft.length)
    name = f"shaft, {words} × {factor:g}" if factor else "shaft"

    def bent(called, label, shapes, poses, colour):
        """A body that leaves the straight axis by the drawn deflection."""
        rest = poses * (1.0, 0.0, 0.0) if factor else None
        return Body(called, label, tuple(shapes), poses, colour, rest, magnified=float(factor or 1))

    def riding(place):
        return _poses(place, factor * part * np.interp(place, middles, up), 0.0)

    bodies = [Body("rest", "shaft at rest", tuple(sketch.silhouette(model.shaft)), still, "ground")]
    bodies += [
        bent(
            f"bearing.{support.name}",
            "bearing",
            sketch.bearing(model, support),
            _poses(0.0, factor * _raised(model, bearing) + 0 * part, 0.0),
            "green",
        )
        for support, bearing in zip(model.shaft.supports, model.spec.bearings, strict=True)
    ]
    bodies += [bent(f"gear.{gear.name}", "gear", sketch.gear(model, gear), riding(gear.position), "violet") for gear in model.spec.gears]
    bodies += [
        bent(f"shaft.{n}", name, shapes, _poses(middle, factor * part * u, np.arctan(factor * part * t)), "blue")
        for n, (middle, shapes, u, t) in enumerate(zip(middles, sketch.slices(model.shaft, z), up, turn, strict=True))
    ]
    bodies += [
        bent(f"load.{n}", "load", sketch.arrow(model, place, force), riding(place), "orange")
        for n, (place, force) in enumerate(_shown(model))
        if abs(force) > 1e-9
    ]
    return Scene(phase, "load grows and fades", "rad", 2.0, tuple(bodies), (Frame("side", "seen from the side, exaggerated", still),))


def _raised(model, bearing):
    """How far a seat stands above the common axis, as seen from the side."""
    return -float(np.dot(model.direction, bearing.seat_offset))


def _shown(model):
    """(place, force along the unit loads) of what can be seen from the side: points, and a line load by five of its forces."""
    for load in model.loads.points:
        yield load.position, float(np.dot(model.direction, load.force[:2]))
    for load in model.loads.lines:
        for share in np.linspace(0.0, 1.0, 5):
            force = (1 - share) * np.asarray(load.first) + share * np.asarray(load.last)
            yield load.start + share * (load.end - load.start), float(np.dot(model.direction, force))


def _poses(x, y, angle):
    return np.stack(np.broadcast_arrays(np.full(FRAMES, float(x)), y, angle), axis=1)


def _cuts(model):
    return np.unique(np.concatenate([np.linspace(0.0, model.shaft.length, SLICES + 1), model.shaft.ends]))


def _bent(model, z):
    """(upward deflection, its slope, words) at the middles of the slices."""
    middles = 0.5 * (z[1:] + z[:-1])
    try:
        loaded = shafts.load(model.shaft, model.loads)
    except SolverError:  # the run says so; the picture shows the shaft as it is
        return 0 * middles, 0 * middles, "not found"
    if model.loaded or not model.names:
        drawn = [line(loaded.equilibrium.model.beam, plane, loaded.equilibrium.unknowns, middles, loaded.spread[plane]) for plane in (0, 1)]
        words = "deflection"
    else:
        found = flexibility(model, {"statics": Answer(data=loaded)}).data
        if found is None:
            return np.zeros(len(middles)), np.zeros(len(middles)), "unloaded"
        drawn = [line(loaded.equilibrium.model.beam, plane, found.unknowns[:, -1], middles) for plane in (0, 1)]
        words = f"force at {model.names[-1]}, deflection"
    up = -np.stack([each.deflection for each in drawn], axis=1) @ model.direction
    return up, -np.stack([each.slope for each in drawn], axis=1) @ model.direction, words


def exaggeration(largest, length):
    """1, 2 or 5 times a power of ten that draws the largest deflection at about SHOWN of the length; 0 without deflection."""
    if not largest > 1e-15 * length:
        return 0
    wanted = SHOWN * length / largest
    power = 10.0 ** floor(log10(wanted))
    return next(step * power for step in (5, 2, 1) if step * power <= wanted)


def drawings(model):
    """The turned part along its axis."""
    shaft, ends = model.shaft, model.shaft.ends
    upper = [
        (z, radius)
        for section, a, b in zip(shaft.sections, ends[:-1], ends[1:], strict=True)
        for z, radius in ((a, section.start / 2), (b, section.end / 2))
    ]
    upper = [point for n, point in enumerate(upper) if n == 0 or np.hypot(*np.subtract(point, upper[n - 1])) > 1e-9]
    outline = polygon([(z, -r) for z, r in upper] + [(z, r) for z, r in reversed(upper)])
    over = 0.03 * shaft.length
    shapes = [Shape("profile", outline), Shape("axis", polygon([(-over, 0.0), (shaft.length + over, 0.0)], closed=False))]
    shapes += [Shape("hole", sketch.box(0.5 * (start + end), 0.0, end - start, bore)) for start, end, bore in _bores(shaft)]
    return (Drawing("shaft", "Shaft, turned part along its axis", tuple(shapes), milled=False),)


def _bores(shaft):
    """(start, end, diameter) of every hole, neighbouring sections of one bore as one."""
    found = []
    for section, start, end in zip(shaft.sections, shaft.ends[:-1], shaft.ends[1:], strict=True):
        if found and found[-1][2] == section.bore:
            found[-1] = (found[-1][0], end, section.bore)
        elif section.bore:
            found.append((start, end, section.bore))
    return found


def parts(model):
    """The shaft as a solid of revolution about x."""
    rings = tuple((float(s.length), float(s.start), float(s.end), float(s.bore)) for s in model.shaft.sections)
    return (Part("shaft", (Turned((0.0, 0.0), 0.0, rings),)),)
