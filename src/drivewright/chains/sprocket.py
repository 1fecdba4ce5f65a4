"""Sprockets with involute teeth, as a hob with rounded tips generates them: exact profile, thicknesses, measuring pins, drawing.

Frame: axis at the origin, a tooth on the y axis.  A flank is an involute between the form and the tip radius; below it the trochoid that
the rounding of the hob's tip envelops runs into the root circle; the tip may have a chamfer.  z teeth, t = pi/z, psi half the angle
that a tooth fills on its base circle.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from drivewright._typing import Floats, Numbers
from drivewright.chains.link import Link, seat_height, seat_support
from drivewright.chains.sprocket_root import Hob, Root, full_rounding, hob, root
from drivewright.chains.tooth import Cutter, Tooth, base_half_angle, matching_cutter
from drivewright.errors import InputError, counted
from drivewright.numerics.roots import bracketed_roots
from drivewright.scene import Arc, Drawing, Line, Outline, Part, Prism, Shape, Spline, circle

FINEST = 1_000_000, "points of a flank of a tooth", "allow a larger tolerance"


def involute(angle: Numbers) -> Numbers:
    """inv(a) = tan a - a."""
    return np.tan(angle) - angle


@dataclass(frozen=True)
class Sprocket:
    """A sprocket; lengths in metres.

    tooth, flank_angle  the involute (`Tooth`) and the plate's flank angle at which its support is told
    cutter              hob that cuts it
    tip_radius, root_radius
    tip_rounding        rounding of the hob's tip
    tip_chamfer         chamfer of the teeth: as high as it is wide
    """

    tooth: Tooth
    flank_angle: float
    cutter: Cutter
    tip_radius: float
    root_radius: float
    tip_rounding: float
    tip_chamfer: float = 0.0

    def __post_init__(self):
        _refuse_numbers(self)
        _refuse_heights(self)

    # -- angles and radii ----------------------------------------------------------------------------------------------------------

    @property
    def half_angle(self) -> float:
        """psi: half the angle that a tooth fills on the base circle  [rad]."""
        return base_half_angle(self.tooth, self.flank_angle)

    def pressure_angle(self, radius: Numbers) -> Numbers:
        """Angle between the flank and the radius [rad]: acos(rb/radius)."""
        return np.arccos(self.tooth.base_radius / radius)

    def flank_polar(self, radius: Numbers) -> Numbers:
        """Angle [rad] from the tooth's centre line to its flank: psi - inv(acos(rb/radius))."""
        return self.half_angle - involute(self.pressure_angle(radius))

    def thickness(self, radius: float) -> float:
        """Tooth thickness along the circle of this radius  [m]."""
        return float(2 * radius * self.flank_polar(radius))

    @property
    def tip_thickness(self) -> float:
        """Width of the tooth's tip between the chamfers, along the tip circle  [m]."""
        return 2 * self.tip_radius * self._tip_polar

    @property
    def _tip_polar(self) -> float:
        return float(self.flank_polar(self.tip_radius - self.tip_chamfer) - self.tip_chamfer / self.tip_radius)

    @property
    def pointed_radius(self) -> float:
        """Radius at which the two flanks of a tooth meet  [m]."""
        angle = bracketed_roots(lambda a: involute(a) - self.half_angle, np.linspace(0.0, 1.5, 200))
        return float(self.tooth.base_radius / np.cos(angle[0])) if len(angle) else np.inf

    @property
    def form_radius(self) -> float:
        """Radius at which the involute begins  [m]."""
        return self._root.form_radius

    @property
    def undercut(self) -> bool:
        """True where the hob's tip has cut away a part of the involute that its straight flank had made."""
        return self._root.undercut

    @property
    def hob(self) -> Hob:
        """The hob's tip, as it generates the root."""
        return hob(self.tooth.teeth, self.cutter, self.half_angle, self.root_radius, self.tip_rounding)

    @cached_property
    def _root(self) -> Root:
        return root(self.hob, self.tooth.base_radius, self.half_angle)

    @property
    def contact_margins(self) -> tuple[float, float]:
        """How far the seated plate's contact lies above the form radius and below the chamfered tip  [m]; negative: off the flank."""
        at = self.tooth.contact_radius
        return float(at - self.form_radius), float(self.tip_radius - self.tip_chamfer - at)

    # -- measuring pins -------------------------------------------------------------------------------------------------------------

    @property
    def best_pin(self) -> float:
        """Diameter of the measuring pin that touches the flanks where the seated plates do  [m]: 2 rb (tan(b + tan ac) - tan ac).

        b = t - psi half the angle of a space on the base circle, ac the flank's pressure angle there.
        """
        roll = self.tooth.curvature_radius / self.tooth.base_radius
        return float(2 * self.tooth.base_radius * (np.tan(np.pi / self.tooth.teeth - self.half_angle + roll) - roll))

    def pin_center_radius(self, diameter: float) -> float:
        """Radius on which the centre of a measuring pin stands  [m]: rb/cos aM with inv aM = d/(2 rb) + psi - t."""
        wanted = 0.5 * diameter / self.tooth.base_radius + self.half_angle - np.pi / self.tooth.teeth
        angle = bracketed_roots(lambda a: involute(a) - wanted, np.linspace(0.0, 1.5, 200)) if wanted > 0 else np.empty(0)
        if not len(angle):
            raise InputError(
                f"Sprocket: a measuring pin of {diameter * 1e3:.4g} mm touches no flank; the best one has {self.best_pin * 1e3:.4g} mm."
            )
        return float(self.tooth.base_radius / np.cos(angle[0]))

    def over_pins(self, diameter: float) -> float:
        """Distance over two measuring pins in opposite spaces [m]; with odd z, in the spaces nearest to opposite."""
        center, z = self.pin_center_radius(diameter), self.tooth.teeth
        rest = np.sqrt(center**2 - self.tooth.base_radius**2) - 0.5 * diameter  # length of the base tangent up to the contact
        touched = np.hypot(self.tooth.base_radius, rest)
        if rest < 0 or not self.form_radius <= touched <= self.tip_radius - self.tip_chamfer:
            raise InputError(
                f"Sprocket: a measuring pin of {diameter * 1e3:.4g} mm touches at {touched * 1e3:.5g} mm, off the flank from "
                f"{self.form_radius * 1e3:.5g} to {(self.tip_radius - self.tip_chamfer) * 1e3:.5g} mm. Take one nearer to "
                f"{self.best_pin * 1e3:.4g} mm."
            )
        return float(2 * center * (1.0 if z % 2 == 0 else np.cos(0.5 * np.pi / z)) + diameter)

    # -- profile --------------------------------------------------------------------------------------------------------------------

    @property
    def _flank_ends(self):
        return np.array([self.form_radius, self.tip_radius - self.tip_chamfer])

    def flank_points(self, count: int = 200) -> Floats:
        """Points (count, 2) of the right flank of the tooth on the y axis, from form radius to tip or chamfer."""
        base = self.tooth.base_radius
        ends = np.sqrt(np.maximum(self._flank_ends**2 - base**2, 0.0))
        radius = np.hypot(base, np.linspace(ends[0], ends[1], count))
        return _polar(radius, 0.5 * np.pi - self.flank_polar(radius))

    def half_profile(self, tolerance: float = 1e-8) -> Floats:
        """Polyline (n, 2) from the middle of the space right of the tooth on the y axis up to the middle of its tip."""
        middle, edge = 0.5 * np.pi - np.pi / self.tooth.teeth, 0.5 * np.pi - self._root.polar
        low = Arc((0.0, 0.0), self.root_radius, middle, edge - middle).points(tolerance)
        flank = self.flank_points(self._flank_count(tolerance))
        tip = Arc((0.0, 0.0), self.tip_radius, 0.5 * np.pi - self._tip_polar, self._tip_polar).points(tolerance)
        return np.concatenate([low, self._root.points(self._root_count(tolerance))[1:], flank[1:], tip[0 if self.tip_chamfer else 1 :]])

    def _flank_count(self, tolerance):
        """Points of a flank, equidistant in s = sqrt(r^2 - rb^2), whose sagittas s ds^2/(8 rb^2) stay within a tolerance."""
        low, high = np.sqrt(np.maximum(self._flank_ends**2 - self.tooth.base_radius**2, 0.0))
        return 8 + counted((high - low) / self.tooth.base_radius * np.sqrt(high / (8 * tolerance)), *FINEST)

    def _root_count(self, tolerance):
        """Points of a trochoid, nowhere sharper than the hob's rounding, whose chords stay within a tolerance."""
        height = self.form_radius - self.root_radius + self.tip_rounding
        return 8 + counted(1.2 * height / np.sqrt(8 * tolerance * self.tip_rounding), *FINEST)

    def outline(self, tolerance: float = 1e-6) -> Outline:
        """Counter-clockwise Outline of all teeth: arcs for root and tip, splines with knots on the exact trochoids and involutes."""
        tooth = self._tooth_pieces(tolerance)
        turns = -2 * np.pi / self.tooth.teeth * np.arange(self.tooth.teeth)[::-1]
        return Outline(tuple(piece.transformed((0.0, 0.0, float(turn)), False) for turn in turns for piece in tooth))

    def _tooth_pieces(self, tolerance):
        """Pieces of the tooth on the y axis and the root before it, counter-clockwise."""
        rise, ends = self._root, self._flank_ends
        headings = _polar(1.0, 0.5 * np.pi - self.flank_polar(ends) + self.pressure_angle(ends))
        leave, arrive = (_point(way) for way in headings)
        up: list[Spline | Line] = [
            Spline(rise.points(self._root_count(tolerance)), rise.hob.heading(0.0), rise.hob.heading(rise.end)),
            Spline(flank := self.flank_points(self._flank_count(tolerance)), leave, arrive),
        ]
        if self.tip_chamfer:
            tip = Arc((0.0, 0.0), self.tip_radius, 0.5 * np.pi - self._tip_polar, 0.0).points(1.0)[0]
            up.append(Line(_point(flank[-1]), _point(tip)))
        down = [_backwards(piece.transformed((0.0, 0.0, np.pi), True)) for piece in reversed(up)]
        space = 2 * (np.pi / self.tooth.teeth - self._root.polar)
        low = Arc((0.0, 0.0), self.root_radius, 0.5 * np.pi - self._root.polar - space, space)
        top = Arc((0.0, 0.0), self.tip_radius, 0.5 * np.pi - self._tip_polar, 2 * self._tip_polar)
        return [*([low] if space > 1e-9 else []), *up, top, *down]

    def drawing(self, bore: float = 0.0, thickness: float = 0.0, name: str = "sprocket", tolerance: float = 1e-6) -> Drawing:
        """Drawing for manufacture: profile, base circle, and the bore (diameter [m]) about the axis."""
        shapes = [Shape("profile", self.outline(tolerance)), Shape("base", circle((0.0, 0.0), self.tooth.base_radius))]
        shapes += [Shape("hole", hole) for hole in self._bore(bore)]
        return Drawing(
            name,
            f"sprocket, {self.tooth.teeth:g} teeth, base pitch {2e3 * np.pi * self.tooth.base_radius / self.tooth.teeth:.5g} mm",
            tuple(shapes),
            thickness,
            milled=False,
        )

    def part(
        self,
        bore: float,
        thickness: float,
        name: str = "sprocket",
        pose: tuple[float, float, float] = (0.0, 0.0, 0.0),
        tolerance: float = 1e-6,
    ) -> Part:
        """`Part`: prism of this thickness with a bore (diameter [m]), its middle plane at height 0."""
        return Part(name, (Prism(self.outline(tolerance), self._bore(bore), -0.5 * thickness, thickness),), pose)

    def _bore(self, diameter):
        if not 0 <= diameter < 2 * self.root_radius:
            raise InputError(
                f"Sprocket: a bore of {diameter * 1e3:.4g} mm breaks through the root of {2e3 * self.root_radius:.4g} mm diameter."
            )
        return (circle((0.0, 0.0), 0.5 * diameter),) if diameter else ()


def _polar(radius, angle):
    return np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=-1)


def _backwards(piece):
    """A Spline or Line in the other sense."""
    if isinstance(piece, Line):
        return Line(piece.end, piece.start)
    (x0, y0), (x1, y1) = piece.start_tangent, piece.end_tangent
    return Spline(piece.knots[::-1], (-x1, -y1), (-x0, -y0))


def _refuse_numbers(sprocket):
    z, base, cutter = sprocket.tooth.teeth, sprocket.tooth.base_radius, sprocket.cutter
    if not (float(z).is_integer() and z >= 6):
        raise InputError(f"Sprocket: teeth = {z:g}; the number is whole and at least 6.")
    cut = 0.5 * cutter.module * z * np.cos(cutter.half_angle)
    if not abs(cut - base) <= 1e-9 * base:
        raise InputError(
            f"Sprocket: the cutter leaves the base radius {cut * 1e3:.6g} mm, the tooth has {base * 1e3:.6g} mm. "
            "Take the cutter with the tooth's base pitch, or the tooth that this cutter cuts."
        )
    if not 0 <= sprocket.tip_chamfer < sprocket.tip_radius - sprocket.root_radius < sprocket.tip_radius < np.inf:
        raise InputError(
            f"Sprocket: root {sprocket.root_radius * 1e3:.5g} mm, tip {sprocket.tip_radius * 1e3:.5g} mm, chamfer "
            f"{sprocket.tip_chamfer * 1e3:.4g} mm; the root lies below the chamfer, the chamfer is not negative."
        )


def _refuse_heights(sprocket):
    top = sprocket.tip_radius - sprocket.tip_chamfer
    if top <= max(sprocket.tooth.base_radius, sprocket.form_radius):
        raise InputError(
            f"Sprocket: no involute is left between the form radius {sprocket.form_radius * 1e3:.5g} mm and the chamfered tip at "
            f"{top * 1e3:.5g} mm. Take a higher tip, a smaller chamfer or more teeth."
        )
    if sprocket.tip_thickness <= 0:
        raise InputError(
            f"Sprocket: the teeth are pointed; their flanks meet at {sprocket.pointed_radius * 1e3:.5g} mm, the tip is at "
            f"{sprocket.tip_radius * 1e3:.5g} mm with a chamfer of {sprocket.tip_chamfer * 1e3:.4g} mm. Take a lower tip or "
            "a smaller chamfer."
        )


def _point(place: Floats) -> tuple[float, float]:
    return float(place[0]), float(place[1])


def design_sprocket(link: Link, teeth: int, cutter: Cutter | None = None, **lengths: float) -> Sprocket:
    """The `Sprocket` on which a chain of this `Link` sits, with the lengths given and the others in proportion to the pitch.

    Without a cutter it is cut by the one with the chain's base pitch and flank angle.  tip_depth and root_depth count from the pin line of
    a seated plate, instead of tip_radius and root_radius.  For p = 9.525 mm the tip lies 1.7 mm and the root
    6.5 mm below the pin line of a seated plate, the chamfer is 0.2 mm; the hob's tip is rounded with a quarter of its module, at most nine
    tenths of what it has room for.
    """
    cutter = matching_cutter(link.pitch, link.flank_angle, link.flank_angle) if cutter is None else cutter
    if not teeth >= 6:
        raise InputError(f"Sprocket: teeth = {teeth:g}; the number is whole and at least 6.")
    base = 0.5 * cutter.module * teeth * np.cos(cutter.half_angle)
    tooth = Tooth(teeth, base, seat_support(link, teeth))
    height, p = seat_height(link, teeth), link.pitch / 9.525
    lengths = {name.replace("_depth", "_radius"): height - value if name.endswith("_depth") else value for name, value in lengths.items()}
    design = {"tip_radius": height - 1.7 * p, "root_radius": height - 6.5 * p, "tip_chamfer": 0.2 * p, **lengths}
    if "tip_rounding" not in design:
        half = base_half_angle(tooth, link.flank_angle)
        full = full_rounding(teeth, cutter, half, design["root_radius"])
        while full < 0.1 * cutter.module and "root_radius" not in lengths and design["root_radius"] < design["tip_radius"] - 2 * p:
            design["root_radius"] += 0.1 * p
            full = full_rounding(teeth, cutter, half, design["root_radius"])
        design["tip_rounding"] = min(0.25 * cutter.module, 0.9 * full)
    return Sprocket(tooth, link.flank_angle, cutter, **design)
