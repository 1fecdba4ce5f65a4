"""Bending and shear of a chain's pin across the pack of plates.

Along the pin z [m]; every plate presses with an even line load over its thickness, the plates of one link with equal forces.  In a
rolling joint a pin is pulled by the plates of its own link and pressed by the other pin, evenly over the width of the pack; in a hinge
the plates of both links pull at the one pin.  The pin is a slender beam, free at both ends, for these loads are in balance.
"""

from typing import NamedTuple

import numpy as np

from drivewright._typing import Bools, Floats
from drivewright.curves import outline_area
from drivewright.errors import InputError
from drivewright.scene import Arc, Outline

FIBRES = 201  # places across a section where shear and bending are put together


class Pack(NamedTuple):
    """Plates across the width: edges (n, 2) [m] of each along the pin, and own (n,): those of the link that the pin belongs to."""

    edges: Floats
    own: Bools

    @property
    def width(self) -> float:
        """From the first face to the last  [m]."""
        return self.edges[-1, 1] - self.edges[0, 0]


class Beam(NamedTuple):
    """position (n,) [m] along the pin; shear force V [N] and bending moment M [N m] there: dV/dz = -q, dM/dz = V."""

    position: Floats
    shear: Floats
    moment: Floats


class Section(NamedTuple):
    """A pin's cross-section: area [m^2], second_moment [m^4] about the centroid for bending along x;  over the fibres (n,) from the
    centroid, offset x [m], width b [m] and first moment Q [m^3] of what lies beyond."""

    area: float
    second_moment: float
    offset: Floats
    width: Floats
    first_moment: Floats


class PinStress(NamedTuple):
    """Greatest stresses along a pin [Pa]: bending |M x|/I, shear |V| Q/(I b), and von Mises of both at the worst fibre."""

    bending: float
    shear: float
    mises: float


def lacing(own: int, other: int, thickness: float, gap: float = 0.0) -> Pack:
    """The `Pack` of `own` x `other` plates that alternate, e.g. 1 x 2, of one thickness [m], with a gap [m] between neighbours."""
    if not (min(own, other) >= 1 and abs(own - other) == 1 and int(own) == own and int(other) == other):
        raise InputError(
            f"lacing {own} x {other}: plates of the two links alternate across the width and must be symmetrical, "
            "else they tilt the pin; their numbers must be at least 1 and differ by 1, e.g. 1 x 2"
        )
    if not (thickness > 0 and gap >= 0):
        raise InputError(
            f"lacing: plates {1e3 * thickness:g} mm thick with gaps of {1e3 * gap:g} mm; the first must be above 0, the second not below"
        )
    start = (thickness + gap) * np.arange(float(own + other))
    return Pack(np.column_stack([start, start + thickness]), np.arange(own + other) % 2 == int(own < other))


def rolling_pin_load(pack: Pack, force: float) -> tuple[Floats, Floats]:
    """Line load on a pin of a rolling joint under a chain force [N]: breaks (m + 1,) [m] along the pin and q (m,) [N/m] between."""
    breaks, load = _own_load(pack, force)
    return breaks, load - force / pack.width


def hinge_pin_load(pack: Pack, force: float) -> tuple[Floats, Floats]:
    """Line load on the one pin of a hinge: the plates of the other link pull with the same force [N] the other way."""
    breaks, load = _own_load(pack, force)
    return breaks, load - _own_load(pack._replace(own=~pack.own), force)[1]


def roller_pin_load(sheet: float, bush: float, force: float, gap: float | None = None) -> tuple[Floats, Floats]:
    """Line load on the pin of a roller chain, plates and bush of these lengths [m]: outer plates pull at both ends, the bush presses
    between; a gap at either end of the bush, a plate wide unless given, holds an inner plate."""
    space = sheet if gap is None else gap
    breaks = sheet * np.array([0, 1, 1, 1, 1, 2]) + space * np.array([0, 0, 1, 1, 2, 2]) + bush * np.array([0, 0, 0, 1, 1, 1])
    return breaks, force * np.array([0.5 / sheet, 0, -1 / bush, 0, 0.5 / sheet])


def laced_pin_load(plates: tuple[int, int], thickness: float, force: float, rolls: bool) -> tuple[Floats, Floats]:
    """Line load on a pin of the link with fewer plates, which alternate with those of the other link: of a rolling joint or a hinge."""
    low, high = sorted(plates)
    pack = lacing(low, high, thickness)
    return rolling_pin_load(pack, force) if rolls else hinge_pin_load(pack, force)


def pin_section(shape: Outline, rolls: bool) -> Section:
    """Cross-section of a pin by its outline; a hinge's, or one of arcs of the same radius, is round."""
    radii = {getattr(piece, "radius", None) for piece in shape.pieces}
    (first, *_) = shape.pieces
    if isinstance(first, Arc) and (not rolls or len(radii) == 1):
        return round_section(first.radius)
    return outline_section(shape)


def beam(breaks: Floats, load: Floats) -> Beam:
    """Shear force and bending moment of a free beam under an even q (m,) [N/m] between breaks (m + 1,) [m], at the breaks and wherever
    the shear force is 0.  V = -int q, M = int V; both are 0 at either end."""
    shear = -np.concatenate([[0.0], np.cumsum(load * np.diff(breaks))])
    size = np.abs(load * np.diff(breaks)).sum()
    if abs(shear[-1]) > 1e-9 * size:
        raise InputError(f"pins: the line load has a resultant of {-shear[-1]:.4g} N; loads on a free pin must be in equilibrium")
    steep = np.where(load == 0, 1.0, load)
    zeros = breaks[:-1] + np.where(load == 0, -1.0, shear[:-1] / steep)
    zeros = zeros[(zeros > breaks[:-1]) & (zeros < breaks[1:])]
    position = np.union1d(breaks, zeros)
    force = np.interp(position, breaks, shear)
    moment = np.concatenate([[0.0], np.cumsum(np.diff(position) * (force[1:] + force[:-1]) / 2)])  # V is linear: exact
    if abs(moment[-1]) > 1e-9 * size * np.ptp(breaks):
        raise InputError(f"pins: the line load has a moment of {moment[-1]:.4g} N·m; the pack must be symmetrical")
    return Beam(position, force, moment)


def round_section(radius: float) -> Section:
    """`Section` of a round pin: I = pi r^4/4, b = 2 sqrt(r^2 - x^2), Q = b^3/12; the greatest shear is 4/3 V/area."""
    if not radius > 0:
        raise InputError(f"pins: a pin of radius {1e3 * radius:g} mm; it must be above 0")
    offset = radius * np.linspace(-1, 1, FIBRES)
    width = 2 * np.sqrt(np.maximum(radius**2 - offset**2, 0.0))
    return Section(np.pi * radius**2, np.pi * radius**4 / 4, offset, width, width**3 / 12)


def outline_section(outline: Outline) -> Section:
    """`Section` of a pin with any closed Outline, e.g. a rocker's segment, bent along the outline's x axis.

    Shear is taken as even across the width b; the outline is to be cut once only by every line across.
    """
    x, width = _widths(outline)
    area = outline_area(outline)
    cells, middles = np.diff(x), (x[1:] + x[:-1]) / 2
    strips = cells * (width[1:] + width[:-1]) / 2
    strips *= abs(area) / strips.sum()
    centre = np.sum(strips * middles) / np.sum(strips)
    beyond = np.concatenate([np.cumsum((strips * (middles - centre))[::-1])[::-1], [0.0]])
    second = np.sum(strips * ((middles - centre) ** 2 + cells**2 / 12))
    return Section(abs(area), second, x - centre, width, beyond)


def pin_stress(found: Beam, section: Section) -> PinStress:
    """`PinStress` of a `Beam` with a `Section`."""
    inside = section.width > 0
    across = np.zeros_like(section.width)
    across[inside] = section.first_moment[inside] / (section.second_moment * section.width[inside])
    bending = np.abs(found.moment)[:, None] * np.abs(section.offset) / section.second_moment
    shear = np.abs(found.shear)[:, None] * across
    return PinStress(bending.max(), shear.max(), np.sqrt(bending**2 + 3 * shear**2).max())


def bent_pin(shape: Outline, load: tuple[Floats, Floats], rolls: bool) -> PinStress:
    """`PinStress` of a pin by its outline, under a line load: breaks (m + 1,) [m] along the pin and q (m,) [N/m] between."""
    return pin_stress(beam(*load), pin_section(shape, rolls))


def _own_load(pack, force):
    """Breaks along the pin and the line load of the own plates, which share the force."""
    breaks = np.unique(pack.edges)
    middles = (breaks[1:] + breaks[:-1]) / 2
    load = np.zeros(len(middles))
    for low, high in pack.edges[pack.own]:
        load[(middles > low) & (middles < high)] = force / (pack.own.sum() * (high - low))
    return breaks, load


def _widths(outline):
    """Places x (FIBRES,) [m], denser towards the ends, and the outline's extent across there."""
    from shapely import LineString, Polygon

    shape = Polygon(outline.points(1e-5 * np.sqrt(abs(outline_area(outline)))))
    left, low, right, high = shape.bounds
    x = left + (right - left) * (1 - np.cos(np.linspace(0, np.pi, FIBRES))) / 2
    return x, np.array([shape.intersection(LineString([(at, low - 1), (at, high + 1)])).length for at in x])
