"""Plates of silent chains: outline and holes of straight lines and true arcs, walls, mass, drawing.

Pin frame: origin midway between the plate's own two pin centres, x along the chain, y away from the sprocket.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from drivewright.chains.link import Link, seat_height
from drivewright.chains.plate_holes import Pins, RockerPins, default_pins
from drivewright.chains.plate_outline import Moments, Pieces, area_moments, mirrored, outline, rounded
from drivewright.chains.tooth import Tooth
from drivewright.errors import InputError
from drivewright.scene import Arc, Drawing, Line, Outline, Shape, Spline

_SIDES = ("left", "right")


@dataclass(frozen=True)
class Plate:
    """A plate of a chain; lengths in metres.

    link      pins and flanks (`Link`)
    pins      `HingePin`, `RoundPins` or `RockerPins`
    back      height of the back above the pin line
    toe       height of the toes' ends, below 0
    crotch    height of the crotch's bottom, below 0
    inner_gap distance of the inner flanks from the tooth of a rack that meshes with the outer flanks: its tooth's flank is the outer
              flank mirrored at the middle between two plates, so that an inner flank has the angle of the outer ones
    shoulder_radius, toe_radius, crotch_radius  of the roundings between back and flank, at the toes, in the crotch
    thickness of the sheet
    """

    link: Link
    pins: Pins
    back: float
    toe: float
    crotch: float
    inner_gap: float
    shoulder_radius: float
    toe_radius: float
    crotch_radius: float
    thickness: float

    def __post_init__(self):
        a = self.link.flank_angle
        if not 0 < a < np.pi / 4:
            raise InputError(f"Plate: flank angle = {np.degrees(a):.4g}°; it lies between 0 and 45°.")
        if not self.toe < self.crotch < 0 < self.back:
            raise InputError(
                f"Plate: toe {self.toe * 1e3:.4g}, crotch {self.crotch * 1e3:.4g} and back {self.back * 1e3:.4g} mm; "
                "heights from the pin line rise in this order, crotch below and back above 0."
            )
        for name in ("thickness", "shoulder_radius", "toe_radius", "crotch_radius"):
            value = getattr(self, name)
            if not (np.isfinite(value) and value >= 0) or (name == "thickness" and value == 0):
                raise InputError(
                    f"Plate: {name} = {value:.4g} m; it must be finite and {'positive' if name == 'thickness' else 'not negative'}."
                )
        self.pins.check(self.link)
        self._refuse_thin()

    def _refuse_thin(self):
        outer, inner, crotch = self._outer(self.toe), self._inner(self.toe), self._inner(self.crotch)
        if not crotch > 0:
            raise InputError(
                f"Plate: the inner flanks cross below the crotch at {self.crotch * 1e3:.4g} mm; they are "
                f"{crotch * 2e3:.4g} mm apart. "
                "Lower the crotch or take a larger inner_gap."
            )
        if not inner < outer:
            raise InputError(
                f"Plate: toe at {self.toe * 1e3:.4g} mm has the width {(outer - inner) * 1e3:.4g} mm. Take shorter toes or a "
                "smaller inner_gap."
            )
        self.pieces  # noqa: B018  roundings that do not fit are refused now, not when the outline is asked for

    def _outer(self, y):
        """x of the right outer flank at height y."""
        return (self.link.flank_support + y * np.sin(self.link.flank_angle)) / np.cos(self.link.flank_angle)

    def _inner(self, y):
        """x of the right inner flank at height y."""
        return self.link.pitch - self._outer(y) + self.inner_gap / np.cos(self.link.flank_angle)

    @cached_property
    def pieces(self) -> Pieces:
        """The outline, counter-clockwise from the back on: {name: Line or Arc}.

        "back", "crotch"; for each side, e.g. "flank right": shoulder, flank, toe outer, toe, toe inner, inner, crotch.
        """
        b, t, c = self.back, self.toe, self.crotch
        right = [(self._outer(b), b), (self._outer(t), t), (self._inner(t), t), (self._inner(c), c)]
        left = [(-x, y) for x, y in right]
        radii = [self.shoulder_radius, self.toe_radius, self.toe_radius, self.crotch_radius]
        return rounded(
            [right[0], *left, *right[:0:-1]],
            [radii[0], *radii, *radii[:0:-1]],
            ("back", "flank left", "toe left", "inner left", "crotch", "inner right", "toe right", "flank right"),
            (
                "shoulder right",
                "shoulder left",
                "toe outer left",
                "toe inner left",
                "crotch left",
                "crotch right",
                "toe inner right",
                "toe outer right",
            ),
        )

    def hole(self, side: str) -> Pieces:
        """The hole at the "left" or "right" end, counter-clockwise: {name: Line or Arc}; the own pin presses on "seat"."""
        pieces = self.pins.hole(self.link)
        return pieces if _side(side) > 0 else mirrored(pieces)

    @property
    def outline(self) -> Outline:
        """Counter-clockwise Outline without the holes."""
        return outline(self.pieces)

    @property
    def holes(self) -> tuple[Outline, Outline]:
        """Outlines (left, right) of the holes, counter-clockwise."""
        return outline(self.hole("left")), outline(self.hole("right"))

    @property
    def own_pins(self) -> tuple[Outline, Outline]:
        """Outlines (left, right) of the plate's own pins."""
        pin = self.pins.pin(self.link)
        return outline(mirrored({str(n): piece for n, piece in enumerate(pin.pieces) if not isinstance(piece, Spline)})), pin

    def flank(self, side: str) -> Line:
        """The Line of the active outer flank at a side."""
        flank = self.pieces[f"flank {side}"]
        assert isinstance(flank, Line)
        return flank

    @property
    def flank_heights(self) -> tuple[float, float]:
        """Heights of the lower and the upper end of an active outer flank above the pin line  [m]."""
        flank = self.flank("right")
        low, high = sorted((flank.start[1], flank.end[1]))
        return float(low), float(high)

    def flank_margin(self, tooth: Tooth) -> float:
        """How far inside its flank a seated plate touches a tooth, along the plate's axis of symmetry  [m]; negative: beyond an end."""
        (_, at), (low, high) = self.contact(tooth, "right"), self.flank_heights
        return min(at - low, high - at)

    def seat(self, side: str) -> Arc:
        """The Arc of the hole on which the own pin presses, facing outwards."""
        seat = self.hole(side)["seat"]
        assert isinstance(seat, Arc)
        return seat

    def contact(self, tooth: Tooth, side: str) -> tuple[float, float]:
        """Point (x, y) of the flank that touches the sprocket when the plate is seated: H n - rb n' seen from the pin line."""
        a = self.link.flank_angle
        x = tooth.support * np.cos(a) + tooth.base_radius * np.sin(a)
        y = -tooth.support * np.sin(a) + tooth.base_radius * np.cos(a) - seat_height(self.link, tooth.teeth)
        return _side(side) * float(x), float(y)

    def walls(self, tolerance: float = 1e-8) -> dict[str, float]:
        """Least widths of material [m]: {"between holes", "hole to outline", "toe"}, of outlines within `tolerance` [m].

        A hole that breaks through the outline leaves 0.
        """
        import shapely

        around = shapely.LinearRing(self.outline.points(tolerance))
        left, right = (shapely.Polygon(hole.points(tolerance)) for hole in self.holes)
        return {
            "between holes": left.distance(right),
            "hole to outline": left.distance(around),
            "toe": self._outer(self.toe) - self._inner(self.toe),
        }

    @property
    def moments(self) -> Moments:
        """`Moments` of the plate's area, holes taken out."""
        left, right = (area_moments(hole) for hole in self.holes)
        return area_moments(self.outline) - left - right

    def drawing(self, name: str = "plate") -> Drawing:
        """Drawing for manufacture: profile and holes."""
        shapes = (Shape("profile", self.outline), *(Shape("hole", hole) for hole in self.holes))
        joint = f"hole pitch {self.link.hole_pitch * 1e3:.5g} mm"
        if isinstance(self.pins, RockerPins):  # whose arcs have their centres far outside the plate
            joint = f"rocker arcs of {self.link.radius * 1e3:.5g} mm"
        title = f"chain plate, pitch {self.link.pitch * 1e3:.5g} mm, {joint}"
        return Drawing(name, title, shapes, self.thickness, milled=False)


def _side(side):
    if side not in _SIDES:
        raise InputError(f"Plate: side = {side!r}; a plate has a 'left' and a 'right' side.")
    return 1.0 if side == "right" else -1.0


def design_plate(link: Link, pins: Pins | None = None, **lengths: float) -> Plate:
    """A `Plate` with the lengths given and the others in proportion to the pitch.

    Toes end higher where they would be narrower than a tenth of the pitch.
    For p = 9.525 mm: back 3.1, shoulder 2.6, toe -6, crotch -1.4, gap 0.3, roundings 0.35 (toe) and 0.6 (crotch), sheet 2 mm.
    """
    ratios = {
        "back": 3.1,
        "toe": -6.0,
        "crotch": -1.4,
        "inner_gap": 0.3,
        "shoulder_radius": 2.6,
        "toe_radius": 0.35,
        "crotch_radius": 0.6,
        "thickness": 2.0,
    }
    standard = {name: value / 9.525 * link.pitch for name, value in ratios.items()}
    standard["toe"] = max(standard["toe"], _toe_end(link, standard["inner_gap"]))
    return Plate(link, default_pins(link) if pins is None else pins, **{**standard, **lengths})


def _toe_end(link, inner_gap):
    """Height at which a toe is a tenth of the pitch wide: 2 (w + y sin a)/cos a - p - gap/cos a = p/10."""
    a = link.flank_angle
    return (0.5 * (1.1 * link.pitch * np.cos(a) + inner_gap) - link.flank_support) / np.sin(a)


BAR = (1.86, 0.95)  # length and height of a link's bar over the pitch; its area is a pitch squared


class LinkMass(NamedTuple):
    """mass [kg] of a link's plates and own pins, height of the mass centre above the pin line [m], inertia about it [kg m^2]."""

    mass: float
    height: float
    inertia: float


def link_mass(plate: Plate, plates: int, density: float, pin_length: float) -> LinkMass:
    """`LinkMass` of one link: `plates` equal plates and its own two pins of `pin_length` [m]; half of each shared hinge pin."""
    left, right = (area_moments(pin) for pin in plate.own_pins)
    sheet, pins, depth = plate.moments, left + right, plates * plate.thickness
    share = density * pin_length * plate.pins.pins_per_joint / 2
    mass = density * depth * sheet.area + share * pins.area
    first = density * depth * sheet.first + share * pins.first
    polar = density * depth * sheet.polar + share * pins.polar
    return LinkMass(float(mass), float(first.imag / mass), float(polar - abs(first) ** 2 / mass))


def mass_per_pitch(plate: Plate, lacing: tuple[int, int], density: float, pin_length: float) -> float:
    """Mass of a chain per link [kg] for a lacing (a, b): links of a and of b plates in turn."""
    return 0.5 * sum(link_mass(plate, plates, density, pin_length).mass for plates in lacing)


def mean_link_mass(plate: Plate, lacing: tuple[int, int], density: float, pin_length: float) -> LinkMass:
    """Mean `LinkMass` of the two kinds of links, of a and of b plates in turn."""
    one, other = (link_mass(plate, plates, density, pin_length) for plates in lacing)
    return LinkMass(0.5 * (one.mass + other.mass), 0.5 * (one.height + other.height), 0.5 * (one.inertia + other.inertia))


def bar_link_mass(pitch: float, density: float, width: float) -> LinkMass:
    """`LinkMass` of a link without a drawing: bars of the outer measures of a plate over half the chain's width [m], a plate's area."""
    mass = density * 0.5 * width * pitch * pitch
    return LinkMass(mass, 0.0, mass * (BAR[0] ** 2 + BAR[1] ** 2) * pitch * pitch / 12)
