"""G-code (ISO 6983) that mills a flat part out of a plate: climb milling, the cutter's radius already in the path.

The origin is the drawing's, Z0 the top of the plate; a right-hand cutter turns clockwise (M3), so the profile is
travelled clockwise and bores counter-clockwise.  ISO 6983 recalled; the words used are the ones common to all controls.
"""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from drivewright.atomic import write_text
from drivewright.curves import offset_outline
from drivewright.errors import InputError, counted
from drivewright.scene import Arc, Drawing
from drivewright.solids import outlines, pieces

MM = 1e3
MOST_LEVELS = 10_000


def write_gcode(drawing: Drawing, path: str | Path, **settings: Any) -> None:
    """The program of `gcode` as a file."""
    write_text(path, gcode(drawing, **settings))


def gcode(
    drawing: Drawing,
    *,
    cutter_diameter: float,
    feed: float,
    plunge: float,
    step_down: float,
    spindle_speed: float,
    depth: float | None = None,
    safe_height: float = 5e-3,
    lead_radius: float | None = None,
    tolerance: float = 2e-6,
    bores: bool = True,
    warnings: Sequence[str] = (),
) -> str:
    """Program text: round holes by a helix (with `bores`), then the profile in passes, with tangential quarter circles in and out.

    `cutter_diameter`, `depth` (default: the drawing's thickness), `step_down`, `safe_height` above the plate, `lead_radius`
    (default: the cutter's radius) and the chord `tolerance` of splines in metres, `feed` and `plunge` in m/s,
    `spindle_speed` in rad/s; `warnings` are put first, as comments.
    Raises InputError where a concave radius or a hole is too small for the cutter.
    """
    depth = drawing.thickness if depth is None else depth
    lead_radius = cutter_diameter / 2 if lead_radius is None else lead_radius
    _require_positive(
        cutter_diameter=cutter_diameter,
        feed=feed,
        plunge=plunge,
        step_down=step_down,
        spindle_speed=spindle_speed,
        depth=depth,
        safe_height=safe_height,
        lead_radius=lead_radius,
        tolerance=tolerance,
    )
    profile, radius = _profile(drawing), cutter_diameter / 2
    path = _climbing(profile, radius, drawing.name)
    count = counted(np.ceil(depth / step_down - 1e-9), MOST_LEVELS, "passes of the cutter", "make step_down larger")
    levels = -depth * np.arange(1, count + 1) / count
    write = _Writer(feed, plunge, safe_height, tolerance)
    holes = [outlines.normalised(hole, f"hole of drawing {drawing.name!r}") for hole in drawing.on("hole")]
    lines = _header(drawing, cutter_diameter, tolerance, levels, spindle_speed, warnings) + [f"G0 Z{_mm(safe_height)}"]
    for hole in holes:
        lines += _bore(write, hole, radius, levels, drawing.name) if bores else [_left_out(hole, "bores are not asked for")]
    cut = _with_leads(path, profile, radius, lead_radius, drawing.name)
    for floor, level in zip([0.0, *levels[:-1]], levels, strict=True):
        lines += [f"(PROFILE, Z{_mm(level)})", *write.down_to(pieces.start(cut[0]), floor, level), *write.along(cut), *write.up()]
    return "\n".join([*lines, "M5", "M30", "%", ""])


class _Writer:
    """Turns pieces into words; the cutter comes and goes at the safe height."""

    def __init__(self, feed, plunge, safe_height, tolerance):
        self.feed, self.plunge, self.safe, self.tolerance = feed, plunge, safe_height, tolerance

    def down_to(self, point, floor, level):
        """Rapid to a little above the `floor` that is already cut at this point, then at plunging feed to `level`."""
        return [f"G0 {_xy(point)}", f"G0 Z{_mm(floor + min(self.safe, 1e-3))}", f"G1 Z{_mm(level)} F{60 * MM * self.plunge:.1f}"]

    def up(self):
        return [f"G0 Z{_mm(self.safe)}"]

    def along(self, path):
        lines = [line for piece in path for line in self._words(piece)]
        return [f"{lines[0]} F{60 * MM * self.feed:.1f}", *lines[1:]]

    def _words(self, piece):
        """Lines of a piece; an arc too flat to see, whose rounded ends a control might read as a full turn, becomes a chord."""
        if isinstance(piece, Arc) and piece.radius * (1 - math.cos(piece.sweep / 2)) > self.tolerance / 4:
            return [_turn(piece)]
        points = pieces.polyline(piece, self.tolerance) if not isinstance(piece, Arc) else [pieces.start(piece), pieces.end(piece)]
        words = [_xy(point) for point in points]
        return [f"G1 {there}" for here, there in zip(words[:-1], words[1:], strict=True) if there != here]


def _require_positive(**settings):
    for name, value in settings.items():
        if not (math.isfinite(value) and value > 0):
            raise InputError(f"G-code: {name} is {value:g}; it must be positive and finite, in SI units")


def _profile(drawing):
    profiles = drawing.on("profile")
    if len(profiles) != 1 or not profiles[0].closed:
        raise InputError(
            f"G-code of drawing {drawing.name!r} needs one closed outline on layer 'profile'; there are {len(profiles)}"
            f"{', not closed' if len(profiles) == 1 else ''}"
        )
    profile = outlines.normalised(profiles[0], f"drawing {drawing.name!r}")
    outlines.outline_polygon(profile, f"drawing {drawing.name!r}")
    return profile


def _climbing(profile, radius, name):
    """Path of the cutter's centre around the outside, clockwise, in pieces of half a turn at most."""
    try:
        around = offset_outline(profile, radius).pieces[::-1]
    except InputError as error:
        raise InputError(f"G-code of drawing {name!r} with a cutter of radius {MM * radius:g} mm: {error}") from None
    backwards = [pieces.reverse(piece) for piece in around]
    return [
        half
        for piece in backwards
        for half in (pieces.halves(piece) if isinstance(piece, Arc) and abs(piece.sweep) > math.pi * (1 + 1e-12) else (piece,))
    ]


def _with_leads(path, profile, radius, lead_radius, name):
    """The closed path begun at the first joint where quarter circles in and out clear the profile."""
    import shapely

    body = outlines.outline_polygon(profile, name)
    shapely.prepare(body)
    for first in range(len(path)):
        entry, leave = _leads(path[first], lead_radius)
        clear = min(body.distance(shapely.LineString(lead.points(1e-6))) for lead in (entry, leave))
        if clear > radius - 1e-4 * radius:
            return [entry, *path[first:], *path[:first], leave]
    raise InputError(
        f"G-code of drawing {name!r}: no joint of the profile leaves room for a lead-in of radius {MM * lead_radius:g} mm; "
        "give a smaller lead_radius"
    )


def _leads(piece, radius):
    """Quarter circles that reach and leave the start of a piece along its heading, on its left (the free side)."""
    along = pieces.headings(piece)[0]
    center = pieces.start(piece) + radius * np.array([-along[1], along[0]])
    at = math.atan2(*(pieces.start(piece) - center)[::-1])
    return (Arc(tuple(center), radius, at - math.pi / 2, math.pi / 2), Arc(tuple(center), radius, at, math.pi / 2))


def _bore(write, hole, radius, levels, name):
    """A round hole: helix at the wall, one flat turn at the bottom, a half circle off the wall to the middle."""
    ring = outlines.full_circle(hole)
    if ring is None:
        return [_left_out(hole, "it is not round")]
    x, y = ring.center
    reach = ring.radius - radius
    if reach < -outlines.SNAP:
        raise InputError(
            f"G-code of drawing {name!r}: the hole at ({MM * x:.4g}, {MM * y:.4g}) mm has radius {MM * ring.radius:g} mm, "
            f"under the cutter's radius of {MM * radius:g} mm; take a smaller cutter, or bores=False and drill it"
        )
    core = f", LEAVES A LOOSE CORE OF DIAMETER {_mm(2 * (reach - radius))}" if reach > radius else ""
    title = f"(BORE AT X{_mm(x)} Y{_mm(y)}, DIAMETER {_mm(2 * ring.radius)}{core})"
    if reach < write.tolerance:
        return [title, *write.down_to((x, y), 0.0, levels[-1]), *write.up()]
    turns = [
        (_half_turn(x, y, reach, side), (high + low + side * (low - high)) / 2)
        for high, low in zip([0.0, *levels], [*levels, levels[-1]], strict=True)
        for side in (0, 1)
    ]
    off = Arc((x + reach / 2, y), reach / 2, 0.0, math.pi)
    helix = [f"{_turn(arc)} Z{_mm(level)}" for arc, level in turns]
    helix[0] += f" F{60 * MM * write.feed:.1f}"
    return [title, *write.down_to((x + reach, y), 0.0, 0.0), *helix, _turn(off), *write.up()]


def _half_turn(x, y, reach, side):
    return Arc((x, y), reach, side * math.pi, math.pi)


def _left_out(hole, reason):
    x, y = np.mean(outlines.piece_ends(hole)[:-1], axis=0)
    return f"(HOLE NEAR X{_mm(x)} Y{_mm(y)} IS LEFT OUT: {reason.upper()})"


def _header(drawing, cutter_diameter, tolerance, levels, spindle_speed, warnings):
    return [
        "%",
        "O0001",
        f"({_plain(drawing.title or drawing.name)})",
        *(f"(WARNING: {_plain(warning)})" for warning in warnings),
        f"(CUTTER DIAMETER {_mm(cutter_diameter)}, CLIMB MILLING, ITS RADIUS IS IN THE PATH: NO G41 OR G42)",
        f"(DEPTH {_mm(-levels[-1])} IN {len(levels)} PASSES, SPLINES WITHIN {_mm(tolerance)}; MILLIMETRES AND MILLIMETRES PER MINUTE)",
        "(X0 Y0 IS THE ORIGIN OF THE DRAWING, Z0 THE TOP OF THE PLATE; HOLD THE PART: THE LAST PASS FREES IT)",
        "G21 G90 G17 G40 G49 G80 G94",
        "G54",
        "T1 M6",
        f"S{spindle_speed * 30 / math.pi:.0f} M3",
    ]


def _turn(arc):
    """G2 or G3 to the end of an arc, with the centre relative to its start."""
    i, j = np.asarray(arc.center) - pieces.start(arc)
    return f"{'G3' if arc.sweep > 0 else 'G2'} {_xy(pieces.end(arc))} I{_mm(i)} J{_mm(j)}"


def _xy(point):
    return f"X{_mm(point[0])} Y{_mm(point[1])}"


def _mm(metres):
    """Always with a decimal point: without one, some controls count micrometres."""
    return f"{round(MM * float(metres), 4) + 0.0:.4f}"


def _plain(text):
    """Text fit for a comment: capital ASCII without brackets."""
    return "".join(c if c.isascii() and c.isprintable() and c not in "()%" else " " for c in text).upper().strip()
