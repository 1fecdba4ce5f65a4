"""Shapes of the side view: shaft, bearings, loads."""

import numpy as np

from drivewright import bearings
from drivewright.scene import Outline, Shape, circle, polygon

ARROW = 0.09  # length of an arrow over the shaft's


def box(x, y, width, height):
    """Outline of a rectangle about (x, y)."""
    return polygon(
        [(x - width / 2, y - height / 2), (x + width / 2, y - height / 2), (x + width / 2, y + height / 2), (x - width / 2, y + height / 2)]
    )


def radius_at(shaft, z, side="right"):
    """Outer radius at places z, of the section right (or left) of a step."""
    ends = shaft.ends
    at = np.clip(np.searchsorted(ends, z, side=side) - 1, 0, len(shaft.sections) - 1)
    length, start, end, _ = np.array([section[:4] for section in shaft.sections], float)[at].T
    return 0.5 * (start + (end - start) * (z - ends[at]) / length)


def silhouette(shaft):
    """The outline of the shaft at rest, thin."""
    upper = [
        (z, r)
        for a, b in zip(shaft.ends[:-1], shaft.ends[1:], strict=True)
        for z, r in ((a, radius_at(shaft, a)), (b, radius_at(shaft, b, "left")))
    ]
    yield Shape("axis", polygon([(0.0, 0.0), (shaft.length, 0.0)], closed=False))
    yield Shape("base", polygon([(z, -r) for z, r in upper] + [(z, r) for z, r in reversed(upper)]))


def slices(shaft, z):
    """Shapes of every slice between places z, about its middle: upper and lower edge, and faces at steps and at the ends."""
    for a, b in zip(z[:-1], z[1:], strict=True):
        half, left, right = 0.5 * (b - a), radius_at(shaft, a), radius_at(shaft, b, "left")
        before = radius_at(shaft, a, "left") if a > 0 else 0.0
        edges = [((-half, left), (half, right))]
        edges += [((-half, before), (-half, left))] if abs(before - left) > 1e-9 else []
        edges += [((half, 0.0), (half, right))] if b == z[-1] else []
        yield [Shape("body", polygon([(x, way * y) for x, y in edge], closed=False)) for edge in edges for way in (1, -1)]


def bearing(model, support):
    """A rolling bearing as rings with an element above and below, a spring support as a triangle from below."""
    inner = model.rolling.get(support.name)
    outer = float(radius_at(model.shaft, support.position))
    if inner is None:
        size = max(0.8 * outer, 0.02 * model.shaft.length)
        foot = support.position
        yield Shape("body", polygon([(foot, -outer), (foot - 0.6 * size, -outer - size), (foot + 0.6 * size, -outer - size)]))
        yield Shape("body", polygon([(foot - size, -outer - 1.15 * size), (foot + size, -outer - 1.15 * size)], closed=False))
        return
    balls = bearings.contact_of(inner) == "point"
    element, width = (inner.ball_diameter, 1.9 * inner.ball_diameter) if balls else (inner.roller_diameter, 1.3 * inner.roller_length)
    low, high = outer, inner.pitch_diameter - outer
    for way in (1, -1):
        middle = way * inner.pitch_diameter / 2
        yield Shape("body", box(support.position, way * 0.5 * (low + high), width, max(high - low, element)))
        yield Shape("roller", _element(inner, support, middle, element))


def _element(inner, support, middle, element):
    if bearings.contact_of(inner) == "point":
        return circle((support.position, middle), element / 2)
    turn = (1 if support.mirrored else -1) * np.sign(middle) * inner.contact_angle
    corners = 0.5 * np.array(
        [(-inner.roller_length, -element), (inner.roller_length, -element), (inner.roller_length, element), (-inner.roller_length, element)]
    )
    c, s = np.cos(turn), np.sin(turn)
    return polygon(corners @ np.array([[c, s], [-s, c]]) + (support.position, middle))


def gear(model, wheel):
    """A gear as a ring about the shaft, seen from the side."""
    inner, outer = float(radius_at(model.shaft, wheel.position)), wheel.pitch_diameter / 2
    for way in (1, -1):
        yield Shape("body", box(0.0, way * 0.5 * (inner + outer), 0.3 * wheel.pitch_diameter, max(outer - inner, 1e-6)))


def arrow(model, place, along):
    """An arrow onto the shaft at a place, in the direction of a force along the unit loads."""
    length = ARROW * model.shaft.length
    way = np.sign(along)  # the tail lies where the load comes from
    tip = way * float(radius_at(model.shaft, min(place, model.shaft.length * (1 - 1e-12))))
    head, half = 0.35 * length, 0.12 * length
    yield Shape("body", polygon([(0.0, tip), (-half, tip + way * head), (half, tip + way * head)]))
    yield Shape("body", Outline(polygon([(0.0, tip + way * head), (0.0, tip + way * length)], closed=False).pieces, False))
