"""A four-bar computed here, with everything a report can show: scene, tables, plots, checks, findings.

ground 100, crank 32, coupler 96, rocker 72 mm; the coupler point draws the usual kidney.  The kind is registered nowhere.
"""

from types import SimpleNamespace

import numpy as np

from drivewright.report.content import Views
from drivewright.result import Array, Check, Column, Plot, Result, Table, Value
from drivewright.scene import Arc, Body, Drawing, Frame, Line, Outline, Scene, Shape, Spline, Trace, capsule, circle, polygon

GROUND, CRANK, COUPLER, ROCKER = 0.100, 0.032, 0.096, 0.072
POINT = (0.060, 0.046)
SPEED = 2 * np.pi  # rad/s
FRAMES = 361
SPEC_TEXT = 'format = 1\nmechanism = "four-bar-sample"\ntitle = "Four-bar <b>sample</b>"\n\n[links]\ncrank = "32 mm"  # driven & balanced\n'


def solve(angle):
    """Coupler angle and rocker angle [rad] of the open branch, by the triangle of the diagonal."""
    pin = CRANK * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    to_ground = np.array([GROUND, 0.0]) - pin
    diagonal = np.hypot(*to_ground.T)
    heading = np.arctan2(to_ground[..., 1], to_ground[..., 0])
    inner = np.arccos((COUPLER**2 + diagonal**2 - ROCKER**2) / (2 * COUPLER * diagonal))
    coupler = heading + inner
    tip = pin + COUPLER * np.stack([np.cos(coupler), np.sin(coupler)], axis=-1)
    return coupler, np.arctan2(tip[..., 1], tip[..., 0] - GROUND), pin


def plate():
    """The coupler: rounded triangle over its two pins and the tracing point."""
    corners, r = np.array([(0, 0), (COUPLER, 0), POINT]), 0.0055
    edges = np.roll(corners, -1, axis=0) - corners
    normals = np.stack([edges[:, 1], -edges[:, 0]], axis=1) / np.hypot(*edges.T)[:, None]
    pieces = []
    for n in range(3):
        a, b, before = corners[n], corners[(n + 1) % 3], normals[n - 1]
        start, end = np.arctan2(before[1], before[0]), np.arctan2(normals[n][1], normals[n][0])
        pieces += [Arc(tuple(a), r, start, (end - start) % (2 * np.pi)), Line(tuple(a + r * normals[n]), tuple(b + r * normals[n]))]
    return Outline(tuple(pieces))


def poses(x, y, angle):
    return np.stack(np.broadcast_arrays(x, y, angle), axis=1).astype(float)


def bar(length):
    """A link with round ends along +x."""
    return Shape("body", capsule((0.0, 0.0), (length, 0.0), 0.005))


def support(x):
    """Triangle and base line of a fixed pin."""
    return (
        Shape("ground", polygon([(x - 0.006, -0.010), (x, 0.0), (x + 0.006, -0.010)])),
        Shape("ground", polygon([(x - 0.010, -0.010), (x + 0.010, -0.010)], closed=False)),
        Shape("hole", circle((x, 0), 0.0016)),
    )


def four_bar_scene():
    """Machine frame, a frame fixed to the coupler, and a field that passes by 140 mm per turn."""
    angle = np.linspace(0, 2 * np.pi, FRAMES)
    coupler, rocker, pin = solve(angle)
    still = poses(np.zeros(FRAMES), 0.0, 0.0)
    wrapped = np.arctan2(np.sin(coupler), np.cos(coupler))
    hole, far = Shape("hole", circle((0, 0), 0.0016)), Shape("hole", circle((COUPLER, 0), 0.0016))
    bodies = (
        Body("frame", "frame", (*support(0.0), *support(GROUND)), still, "ground"),
        Body("coupler", "coupler", (Shape("body", plate()), hole, far), poses(pin[:, 0], pin[:, 1], wrapped), "blue"),
        Body("crank", "crank", (bar(CRANK), hole), poses(0.0, 0.0, angle), "orange"),
        Body("rocker", "rocker", (bar(ROCKER), Shape("pitch", circle((0, 0), 0.02))), poses(GROUND, 0.0, rocker), "green"),
    )
    soil = (Shape("ground", polygon([(-0.08, -0.03), (0.30, -0.03)], closed=False)),)
    field = poses(-0.14 * angle / (2 * np.pi), 0.0, 0.0)
    frames = (
        Frame("machine", "machine frame", still),
        Frame("field", "field frame", field, (-0.14, 0.0), soil),
        Frame("coupler", "seen from the coupler", poses(pin[:, 0], pin[:, 1], wrapped)),
    )
    marks = ((0.0, "forward"), (2.6, "return"), (5.0, "dwell"))
    return Scene(angle, "crank angle", "rad", 0.3, bodies, frames, (Trace("tip", "coupler point", "coupler", POINT),), "motion", marks)


def four_bar_result(title="Four-bar sample"):
    """Tables over the crank angle, a passed and a failed check, a radius with a pole, names that need escaping."""
    angle = np.linspace(0, 2 * np.pi, FRAMES)
    coupler, rocker, pin = solve(angle)
    speed = np.gradient(rocker, angle) * SPEED
    transmission = np.abs(rocker - coupler)
    radius = 0.02 / np.where(np.abs(np.sin(3 * angle)) < 1e-9, np.nan, np.sin(3 * angle))
    x = pin[:, 0] + POINT[0] * np.cos(coupler) - POINT[1] * np.sin(coupler)
    y = pin[:, 1] + POINT[0] * np.sin(coupler) + POINT[1] * np.cos(coupler)
    motion = Table(
        "motion",
        "Motion over one turn",
        (
            Column("angle", "rad", "crank angle", angle),
            Column("rocker", "rad", "rocker angle", rocker),
            Column("coupler", "rad", "coupler angle", coupler),
            Column("rocker_speed", "rad/s", "rocker speed", speed),
            Column("acceleration", "rad/s^2", "rocker acceleration", np.gradient(speed, angle) * SPEED),
            Column("transmission", "rad", "transmission angle", transmission),
            Column("radius", "m", "radius of curvature", radius),
            Column("x", "m", "coupler point, x", x),
            Column("y", "m", "coupler point, y", y),
        ),
    )
    links = Table(
        "links",
        "Links",
        (
            Column("link", "-", "link", np.array(["crank", "coupler", "rocker"])),
            Column("length", "m", "length", np.array([CRANK, COUPLER, ROCKER])),
        ),
    )
    least = float(transmission.min())
    checks = (
        Check("transmission", least, np.radians(40), ">=", "rad", "the rocker is pushed at a good angle all the way", ("rocker",)),
        Check(
            "acceleration",
            float(np.nanmax(np.abs(motion["acceleration"].data))),
            30.0,
            "<=",
            "rad/s^2",
            "the rocker shakes <its> frame: use a longer rocker",
            ("rocker", "frame"),
        ),
        Check("min_radius", np.inf, 0.006, ">=", "m", "no convex arc: nothing to undercut"),
    )
    values = {
        "rocker.swing": Value(float(np.ptp(rocker)), "rad", "angle swept by the rocker"),
        "transmission.least": Value(least, "rad", "least transmission angle"),
        "stress.peak": Value(512.3e6, "Pa", "peak contact pressure"),
        "deviation": Value(2.4669517247e-06, "m", "pitch deviation"),
        "ratio": Value(3.125, "-", "length ratio"),
    }
    stations = (("m1", "m2"), ("m1", "m2"))
    arrays = {"flexibility": Array("m/N", ("station", "station"), stations, np.array([[1.5e-8, 0.2e-8], [0.2e-8, 2.5e-8]]))}
    provenance = {
        "seed": 0,
        "seconds": 0.412,
        "analyses": ["motion"],
        "versions": {"python": "3.11", "numpy": "2"},
        "sources": ["Norton, Design of Machinery (recalled)"],
    }
    spec = SimpleNamespace(to_toml=lambda moved=False: SPEC_TEXT, write=lambda path: path.write_text(SPEC_TEXT))
    return Result(
        spec,
        "four-bar-sample",
        title,
        "5d41402abc4b2a76b9719d911017c592ae2f",
        values,
        {"motion": motion, "links": links},
        checks,
        ("analysis 'forces' is left out: no [load] & no mass",),
        provenance,
        arrays,
    )


PLOTS = (
    Plot("rocker", "Rocker angle", "motion", "angle", ("rocker",)),
    Plot("speed", "Rocker speed and acceleration", "motion", "angle", ("rocker_speed", "acceleration"), ()),
    Plot("transmission", "Angles at the rocker pin", "motion", "angle", ("transmission", "coupler"), ((np.radians(40), "least"),)),
    Plot("radius", "Radius of curvature", "motion", "angle", ("radius",), ((0.006, "roller"),)),
    Plot("track", "Coupler curve", "motion", "x", ("y",), (), True),
    Plot("links", "Lengths of the links", "links", "link", ("length",)),
    Plot("forces", "Forces", "forces", "angle", ("force",)),
)


def eccentric_drawing():
    """A disc cam with a spline profile, pitch curve, base circle and bore."""
    angle = np.linspace(0, 2 * np.pi, 241)
    radius = 0.030 + 0.006 * (1 - np.cos(angle)) / 2
    profile = np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)
    pitch = profile * (1 + 0.006 / radius[:, None])
    outlines = {
        "profile": Outline((Spline(profile, (0, 1), (0, 1)),)),
        "pitch": Outline((Spline(pitch, (0, 1), (0, 1)),)),
        "base": circle((0, 0), 0.030),
        "hole": circle((0, 0), 0.008),
        "axis": polygon([(-0.045, 0), (0.045, 0)], closed=False),
    }
    return Drawing("cam", "cam disc", tuple(Shape(layer, outline) for layer, outline in outlines.items()), 0.008)


def all_views():
    """Everything there is to see of the four-bar."""
    return Views(four_bar_scene(), PLOTS, (eccentric_drawing(),))
