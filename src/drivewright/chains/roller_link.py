"""The link of a roller chain: plates of round ends and a waist, and its roller, as shapes, drawing and solids."""

from collections.abc import Iterator
from typing import NamedTuple

from drivewright._typing import Floats
from drivewright.chains.link import Link
from drivewright.chains.roller_sprocket import roller_plate
from drivewright.scene import Drawing, Outline, Part, Prism, Shape, circle

END, WAIST = 0.45, 0.5  # radii of the plate's round ends and of the arcs of its waist, over the pitch
BAR = 0.3  # radius of the ends of a plate that stands for another, over the pitch


class RollerLink(NamedTuple):
    """pitch, roller_diameter, inner_width between the inner plates, thickness of an outer and of an inner plate, end_radius of the plates
    about their pins; all [m]."""

    pitch: float
    roller_diameter: float
    inner_width: float
    thickness: float
    inner_plate: float
    end_radius: float

    @property
    def width(self) -> float:
        """Width of the chain over its four plates  [m]."""
        return self.inner_width + 2 * (self.thickness + self.inner_plate)

    def bush_gap(self, bush: float) -> float:
        """Room for an inner plate between a bush of this length and an outer plate  [m]: none where the bush goes through it."""
        return max(0.5 * (self.inner_width - bush) + self.inner_plate, 0.0)

    @property
    def plate(self) -> Outline:
        """Outline of a plate, pins at (+-p/2, 0)."""
        return roller_plate(self.pitch, self.end_radius, WAIST * self.pitch)

    @property
    def roller(self) -> Outline:
        """Outline of the roller on the link's right pin."""
        return circle((0.5 * self.pitch, 0.0), 0.5 * self.roller_diameter)

    @property
    def shapes(self) -> tuple[Shape, Shape]:
        """Plate and roller for a scene."""
        return Shape("body", self.plate), Shape("roller", self.roller)

    def drawing(self, name: str = "plate") -> Drawing:
        """Drawing of a plate for manufacture."""
        title = f"plate of a roller chain, pitch {1e3 * self.pitch:.5g} mm"
        return Drawing(name, title, (Shape("profile", self.plate),), self.thickness, milled=False)

    def parts(self, poses: Floats) -> Iterator[Part]:
        """`Part` of each link at poses (n, 3) [m, m, rad]: plates on both sides of the rollers, inner and outer in turn."""
        plate, roller = self.plate, Prism(self.roller, (), -0.5 * self.inner_width, self.inner_width)
        for number, pose in enumerate(poses):
            outer = number % 2
            sheet, out = (self.inner_plate, self.thickness)[outer], 0.5 * self.inner_width + outer * self.inner_plate
            solids = (Prism(plate, (), out, sheet), Prism(plate, (), -out - sheet, sheet), roller)
            x, y, turn = map(float, pose)
            yield Part(f"link {number}", solids, (x, y, turn), ("steel", "blue")[number % 2], f"link{number}")


def design_roller_link(pitch: float, roller_diameter: float, inner_width: float, thickness: float, back: float | None = None) -> RollerLink:
    """A `RollerLink` with plates of one thickness, of a height `back` above the pins: 0.45 pitches unless given  [m]."""
    return RollerLink(pitch, roller_diameter, inner_width, thickness, thickness, END * pitch if back is None else back)


def pair_plate(link: Link) -> Outline:
    """A plate of two round ends about its places of contact in the straight chain, which stands for one whose pins are not drawn."""
    plate = roller_plate(link.pitch, BAR * link.pitch, WAIST * link.pitch)
    return plate.transformed((-link.skew, 0.0, 0.0), False)
