"""Sprockets and plates of roller chains from circular arcs.

Frame: axis at the origin, a tooth space on the y axis.  The bottom of a space touches the seated roller, so that the root circle is the
pitch circle less the roller's diameter; seat and flank arcs join smoothly at the ends of the seat angle.
"""

from dataclasses import dataclass

import numpy as np

from drivewright.chains.roller_tooth import RollerTooth
from drivewright.chains.standards.sprocket import tip_range, tooth_gap
from drivewright.errors import InputError
from drivewright.scene import Arc, Drawing, Outline, Part, Prism, Shape, circle


@dataclass(frozen=True)
class RollerSprocket:
    """teeth; pitch, roller_diameter, seat_radius, flank_radius, tip_radius [m]; seat_angle [rad]."""

    teeth: int
    pitch: float
    roller_diameter: float
    seat_radius: float
    flank_radius: float
    seat_angle: float
    tip_radius: float

    def __post_init__(self):
        if not (float(self.teeth).is_integer() and self.teeth >= 5):
            raise InputError(f"RollerSprocket: teeth = {self.teeth:g}; the number is whole and at least 5.")
        if not 0 < self.roller_diameter < self.pitch:
            raise InputError(
                f"RollerSprocket: roller_diameter = {self.roller_diameter * 1e3:.4g} mm; it lies between 0 and the pitch, "
                f"{self.pitch * 1e3:.4g} mm."
            )
        if not self.seat_radius >= 0.5 * self.roller_diameter:
            raise InputError(
                f"RollerSprocket: seat_radius = {self.seat_radius * 1e3:.4g} mm; a roller of "
                f"{self.roller_diameter * 1e3:.4g} mm diameter "
                "needs at least its radius."
            )
        if not (0 < self.seat_angle < np.pi and self.flank_radius > 0):
            raise InputError(
                f"RollerSprocket: seat_angle = {np.degrees(self.seat_angle):.4g}°, flank_radius = "
                f"{self.flank_radius * 1e3:.4g} mm; "
                "the angle lies between 0 and 180°, the radius is positive."
            )
        if not self._lowest_tip < self.tip_radius < abs(self._flank_center) + self.flank_radius:
            raise InputError(
                f"RollerSprocket: tip_radius = {self.tip_radius * 1e3:.5g} mm; it must lie on the flank arcs, which reach from "
                f"{self._lowest_tip * 1e3:.5g} to "
                f"{(abs(self._flank_center) + self.flank_radius) * 1e3:.5g} mm."
            )
        if self.tip_thickness <= 0:
            raise InputError(
                f"RollerSprocket: the teeth are pointed below the tip at {self.tip_radius * 1e3:.5g} mm; they overlap by "
                f"{-self.tip_thickness * 1e3:.4g} mm there. Take a smaller tip_radius, seat_radius or a larger flank_radius."
            )

    @property
    def pitch_radius(self) -> float:
        """Radius of the circle through the seated rollers' centres, p/(2 sin(pi/z))  [m]."""
        return 0.5 * self.pitch / np.sin(np.pi / self.teeth)

    @property
    def root_radius(self) -> float:
        """Pitch radius less the roller's radius  [m]."""
        return self.pitch_radius - 0.5 * self.roller_diameter

    @property
    def tooth(self) -> RollerTooth:
        """What the rollers touch."""
        return RollerTooth(self.teeth, self.pitch_radius, self.seat_radius, self.seat_angle, self.flank_radius, 0.5 * self.roller_diameter)

    @property
    def _seat_center(self):
        return 1j * (self.root_radius + self.seat_radius)

    @property
    def _flank_center(self):
        """Centre of the flank of the tooth right of the space on the y axis."""
        return self._seat_center + (self.seat_radius + self.flank_radius) * np.exp(1j * 0.5 * (self.seat_angle - np.pi))

    @property
    def _lowest_tip(self):
        return abs(self._seat_center + self.seat_radius * np.exp(1j * 0.5 * (self.seat_angle - np.pi)))

    @property
    def _flank_end(self):
        """Angle about the flank's centre at which it meets the tip circle, by the triangle with the axis."""
        center, r = self._flank_center, self.flank_radius
        cosine = (abs(center) ** 2 + r * r - self.tip_radius**2) / (2 * abs(center) * r)
        return float(np.angle(-center) - np.arccos(np.clip(cosine, -1.0, 1.0))) % (2 * np.pi)

    @property
    def _tip_polar(self):
        """Half the angle of a tooth's tip."""
        edge = self._flank_center + self.flank_radius * np.exp(1j * self._flank_end)
        return np.pi / self.teeth - (0.5 * np.pi - np.angle(edge))

    @property
    def tip_thickness(self) -> float:
        """Width of the teeth along the tip circle  [m]."""
        return float(2 * self.tip_radius * self._tip_polar)

    def outline(self) -> Outline:
        """Counter-clockwise Outline of all teeth in true arcs."""
        half, join, end = 0.5 * self.seat_angle, 0.5 * (np.pi + self.seat_angle), self._flank_end
        f, c, r = self._flank_center, self._seat_center, self.flank_radius
        tip = float(self._tip_polar)
        pieces = (
            Arc((float(f.real), float(f.imag)), r, end, join - end),
            Arc((float(c.real), float(c.imag)), self.seat_radius, half - 0.5 * np.pi, -self.seat_angle),
            Arc((-float(f.real), float(f.imag)), r, np.pi - join, join - end),
            Arc((0.0, 0.0), self.tip_radius, 0.5 * np.pi + np.pi / self.teeth - tip, 2 * tip),
        )
        turns = 2 * np.pi / self.teeth * np.arange(self.teeth)
        return Outline(tuple(piece.transformed((0.0, 0.0, float(turn)), False) for turn in turns for piece in pieces))

    def roller(self, number: int = 0) -> Outline:
        """Outline of the roller seated in a space, counted counter-clockwise from the y axis."""
        at = 1j * self.pitch_radius * np.exp(2j * np.pi * number / self.teeth)
        return circle((float(at.real), float(at.imag)), 0.5 * self.roller_diameter)

    def drawing(self, bore: float = 0.0, thickness: float = 0.0, name: str = "sprocket") -> Drawing:
        """Drawing for manufacture: profile, pitch circle and the bore (diameter [m])."""
        shapes = [Shape("profile", self.outline()), Shape("pitch", circle((0.0, 0.0), self.pitch_radius), "pitch circle")]
        shapes += [Shape("hole", hole) for hole in self._bore(bore)]
        return Drawing(
            name,
            f"sprocket, {self.teeth:g} teeth, pitch {self.pitch * 1e3:.5g} mm, roller {self.roller_diameter * 1e3:.4g} mm",
            tuple(shapes),
            thickness,
            milled=False,
        )

    def part(self, bore: float, thickness: float, name: str = "sprocket", pose: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> Part:
        """`Part`: prism of this thickness with a bore (diameter [m]), its middle plane at height 0."""
        return Part(name, (Prism(self.outline(), self._bore(bore), -0.5 * thickness, thickness),), pose)

    def _bore(self, diameter):
        if not 0 <= diameter < 2 * self.root_radius:
            raise InputError(
                f"RollerSprocket: a bore of {diameter * 1e3:.4g} mm breaks through the root of {2e3 * self.root_radius:.4g} mm diameter."
            )
        return (circle((0.0, 0.0), 0.5 * diameter),) if diameter else ()


def design_roller_sprocket(teeth: int, pitch: float, roller_diameter: float, space: float = 0.5, **lengths: float) -> RollerSprocket:
    """A `RollerSprocket` between the smallest (space = 0) and the largest (1) tooth space of the common roller-chain standards.

    With the roller's diameter d1 and z teeth, smallest to largest: seat radius 0.505 d1 to 0.505 d1 + 0.069 d1^(1/3) (in mm), seat angle
    140 to 120 deg less 90 deg/z, flank radius 0.12 d1 (z + 2) to 0.008 d1 (z^2 + 180); the smallest tip circle,
    d + p (1 - 1.6/z) - d1 (the largest would be d + 1.25 p - d1, where few teeth get pointed).
    ISO 606; source: recalled, not checked against the text.
    """
    if not 0 <= space <= 1:
        raise InputError(f"roller sprocket: space = {space:.4g}; it lies between 0 (smallest tooth space) and 1 (largest).")
    if not (teeth >= 5 and 0 < roller_diameter < pitch):
        raise InputError(
            f"roller sprocket: {teeth:g} teeth, pitch {pitch:.4g} m, roller {roller_diameter:.4g} m; "
            "give at least 5 teeth, and a roller smaller than the pitch."
        )
    least, greatest = (tooth_gap(teeth, roller_diameter, kind) for kind in ("least", "greatest"))
    standard = {
        name: (1 - space) * getattr(least, name) + space * getattr(greatest, name) for name in ("seat_radius", "seat_angle", "flank_radius")
    }
    standard["tip_radius"] = 0.5 * tip_range(pitch, teeth, roller_diameter)[0]
    return RollerSprocket(teeth, pitch, roller_diameter, **{**standard, **lengths})


def roller_plate(pitch: float, end_radius: float, waist_radius: float) -> Outline:
    """Outline of a roller chain's plate: two round ends about the pins at (+-p/2, 0), a waist of two arcs tangent to both.

    The centre of a waist arc stands sqrt((e + w)^2 - (p/2)^2) beside the plate's axis.
    """
    if not (0 < end_radius < 0.5 * pitch and waist_radius > 0):
        raise InputError(
            f"roller plate: end_radius = {end_radius * 1e3:.4g} mm, waist_radius = {waist_radius * 1e3:.4g} mm; "
            "the ends are smaller than "
            f"half the pitch, {pitch * 500:.4g} mm, both are positive."
        )
    reach = end_radius + waist_radius
    beside = np.sqrt(reach**2 - 0.25 * pitch**2) if reach > 0.5 * pitch else 0.0
    if beside <= waist_radius:
        raise InputError(
            f"roller plate: the two arcs of the waist meet; waist_radius = {waist_radius * 1e3:.4g} mm must exceed "
            f"{(0.125 * pitch**2 / end_radius - 0.5 * end_radius) * 1e3:.4g} mm."
        )
    lean = float(np.arctan2(beside, 0.5 * pitch))
    x, y = 0.5 * pitch, float(beside)
    waist = np.pi - 2 * lean
    return Outline(
        (
            Arc((x, 0.0), end_radius, lean - np.pi, 2 * (np.pi - lean)),
            Arc((0.0, y), waist_radius, -lean, -waist),
            Arc((-x, 0.0), end_radius, lean, 2 * (np.pi - lean)),
            Arc((0.0, -y), waist_radius, np.pi - lean, -waist),
        )
    )
