"""Parts that the export tests share: a cam of arcs and splines, a toothed wheel on an ellipse, a lobed plate, an assembly."""

import numpy as np

from drivewright.scene import Arc, Bar, Drawing, Line, Outline, Part, Prism, Shape, Spline, circle, polygon

BASE, LIFT = 0.030, 0.010
SEGMENTS = ((0, 120, 0.0, 0.0), (120, 200, 0.0, LIFT), (200, 260, LIFT, LIFT), (260, 360, LIFT, 0.0))  # degrees, lift before and after


def cam_radius(q, before, after):
    """Radius of the knife-edge cam with cycloidal events at the fraction q of a segment."""
    return BASE + before + (after - before) * (q - np.sin(2 * np.pi * q) / (2 * np.pi))


def cam(knots=400):
    """Outline with dwells as true arcs and events as splines; all joints smooth."""
    pieces = []
    for start, stop, before, after in SEGMENTS:
        a, b = np.radians([start, stop])
        if before == after:
            pieces.append(Arc((0.0, 0.0), BASE + before, a, b - a))
        else:
            q = np.linspace(0, 1, knots)
            angle, radius = a + q * (b - a), cam_radius(q, before, after)
            points = np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)
            pieces.append(Spline(points, (-np.sin(a), np.cos(a)), (-np.sin(b), np.cos(b))))
    return Outline(tuple(pieces))


def cam_area():
    """Area of the cam, (1/2) int r^2 dtheta segment by segment with Gauss's rule."""
    x, w = np.polynomial.legendre.leggauss(60)
    return sum(
        np.dot(w, cam_radius((x + 1) / 2, before, after) ** 2) * np.radians(stop - start) / 4 for start, stop, before, after in SEGMENTS
    )


def lobed(depth=0.3, lobes=3, size=0.030, knots=900):
    """Closed spline r = size (1 + depth cos(lobes t)); concave between the lobes."""
    t = np.linspace(0, 2 * np.pi, knots)
    r, slope = size * (1 + depth * np.cos(lobes * t)), -size * depth * lobes * np.sin(lobes * t)
    tangent = np.array([slope[0] * np.cos(t[0]) - r[0] * np.sin(t[0]), slope[0] * np.sin(t[0]) + r[0] * np.cos(t[0])])
    tangent = tuple(tangent / np.hypot(*tangent))
    points = np.stack([r * np.cos(t), r * np.sin(t)], axis=1)
    points[-1] = points[0]
    return Outline((Spline(points, tangent, tangent),))


def concave_radius(depth=0.3, lobes=3, size=0.030):
    """Radius of curvature at the bottom between two lobes: r = size (1 - depth), r'' = size depth lobes^2, r' = 0."""
    r, second = size * (1 - depth), size * depth * lobes**2
    return r**2 / (second - r)


def wheel(teeth=30, a=0.030, e=0.35):
    """Toothed wheel on an ellipse about its focus: spline flanks, straight tips and roots; 4 pieces per tooth."""
    angle = np.linspace(0, 2 * np.pi, 20001)
    radius = a * (1 - e * e) / (1 - e * np.cos(angle))
    x, y = radius * np.cos(angle), radius * np.sin(angle)
    s = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(x), np.diff(y)))])
    pitch = s[-1] / teeth
    module, heights = pitch / np.pi, np.linspace(-1.25, 1.0, 9)
    half = pitch / 4 - heights * module * np.tan(np.radians(20))  # half the thickness of a tooth at each height
    normals = np.stack([np.gradient(y, s), -np.gradient(x, s)], axis=1)

    def at(place, height):
        p, n = (np.array([np.interp(place % s[-1], s, c) for c in column]) for column in ((x, y), normals.T))
        return p + height * module * n / np.hypot(*n)

    pieces, end, first = [], None, None
    for i in range(teeth):
        left, right = (np.array([at(i * pitch + side * w, h) for h, w in zip(heights, half, strict=True)]) for side in (-1, 1))
        if end is not None:
            pieces.append(Line(tuple(end), tuple(left[0])))
        first = left[0] if first is None else first
        pieces += [_flank(left), Line(tuple(left[-1]), tuple(right[-1])), _flank(right[::-1])]
        end = right[0]
    return Outline((*pieces, Line(tuple(end), tuple(first))))


def _flank(points):
    ends = [points[1] - points[0], points[-1] - points[-2]]
    return Spline(points, *(tuple(d / np.hypot(*d)) for d in ends))


def assembly():
    """Cam with hub, elliptic wheel, lever of plates and a bar; every part placed away from the origin."""
    bore = circle((0, 0), 0.006)
    hub = Prism(circle((0, 0), 0.014), (bore,), 0.012, 0.006)
    lever = (
        Prism(circle((0, 0), 0.012), (), 0.0, 0.008),
        Prism(circle((0.06, 0), 0.008), (), 0.0, 0.008),
        Bar((0, 0), (0.06, 0), 0.004, 0.006),
    )
    return (
        Part("cam.main", (Prism(cam(), (bore,), 0.0, 0.012), hub), (0.02, 0.01, 0.3), "orange"),
        Part("gear.sun", (Prism(wheel(), (bore,), 0.0, 0.008),), (0.10, -0.02, 1.1), "blue"),
        Part("lever", lever, (-0.09, 0.0, 0.2), "green"),
    )


def drawing():
    """The cam as a drawing with a bore, its base circle and an axis."""
    return Drawing(
        "cam.main",
        "Main cam <1>",
        (
            Shape("profile", cam()),
            Shape("hole", circle((0.002, -0.001), 0.006)),
            Shape("base", circle((0, 0), BASE)),
            Shape("axis", polygon([(-0.045, 0.001), (0.045, 0.001)], closed=False)),
        ),
        0.012,
    )
