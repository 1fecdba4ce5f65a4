"""Tables of plate and pins as solids: history, deformed bodies, lives, pressure on the seat, rolling contact, section through the hole."""

from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.chains.solid.history import FACES, SkinLife, SolidHistory
from drivewright.chains.solid.joint import OUTWARD, RollingPins
from drivewright.chains.stress.plate import SIDES
from drivewright.contact import hertz
from drivewright.fatigue import von_mises
from drivewright.result import Column, Table
from drivewright.solids.deformation import exaggeration_for
from drivewright.solids.elastic import MM, FreeBody
from drivewright.solids.stresses import SkinStress, hooke, skin_stress

DRAWN = 0.03  # of the plate's length: the largest displacement as drawn
FINER = 3  # parts of an element's edge in a picture
ENDLESS = "life is not limited where a body has no damage, or much less stress than its maximum"
AROUND = 2.2  # radii of the seat to either side of it that a section shows
GRID = (160, 60)  # rectangles of a section, along and across


class View(NamedTuple):
    """What a picture shows to the right and upwards: unit vectors (3,) and their meaning."""

    right: tuple[float, float, float]
    up: tuple[float, float, float]
    words: tuple[str, str]

    def columns(self, points: Floats, words: str = "") -> tuple[Column, Column, Column]:
        """Columns x, y, depth of points (n, 3) [m]; `words` are added to the meaning of the first two."""
        right, up = np.array(self.right), np.array(self.up)
        return (
            Column("x", "m", self.words[0] + words, points @ right, self.words[0]),
            Column("y", "m", self.words[1] + words, points @ up, self.words[1]),
            Column("depth", "m", "distance from the viewer", -points @ np.cross(right, up)),
        )


FACE = View((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), ("position along the chain", "position across the chain"))  # of a plate
SEATED = {  # a pin from the side on which it is seated
    "left": View((0.0, 0.0, 1.0), (0.0, 1.0, 0.0), ("position along the pin", "position across the chain")),
    "right": View((0.0, 0.0, 1.0), (0.0, -1.0, 0.0), ("position along the pin", "position across the chain, downwards")),
}


def history_table(history: SolidHistory, time: Floats) -> Table:
    """Table "solid_history": what plate and pins bear at each instant [s]."""
    left, right = history.seat_pressure.T
    return Table(
        "solid_history",
        "Plate and pins over a revolution (solid)",
        (
            Column("time", "s", "time", np.asarray(time, float)),
            Column("plate", "Pa", "maximum von Mises stress of the plate", history.greatest("plate")),
            Column("left_pin", "Pa", "maximum von Mises stress of the left pin", history.greatest("left")),
            Column("right_pin", "Pa", "maximum von Mises stress of the right pin", history.greatest("right")),
            Column("left_seat", "Pa", "maximum pressure on the left seat", left),
            Column("right_seat", "Pa", "maximum pressure on the right seat", right),
        ),
    )


def stress_table(name: str, title: str, history: SolidHistory, body: str, instant: int) -> Table:
    """Table for a plot of style "mesh": a body's skin at one instant, deformed; a plate from its face, a pin from its seat."""
    skin = skin_stress(history.solid.model.bodies[body], [history.states[instant].displacement(body)], FACES[body], FINER)
    moved = skin.displacement[0] - skin.displacement[0].mean(axis=0)
    times = exaggeration_for(float(np.ptp(skin.points, axis=0).max()), moved, DRAWN)
    rows = skin.parts.ravel()
    words = ", displacements magnified " + f"{times:,.0f} times".replace(",", " ")
    place = SEATED.get(body, FACE).columns((skin.points + times * moved)[rows], words)
    return Table(name, title, (*place, Column("mises", "Pa", "von Mises stress", skin.mises[0][rows])))


def life_table(name: str, title: str, skin: SkinStress, life: SkinLife, body: str) -> Table:
    """Table for a plot of style "mesh": life on a body's skin, inf where there is no damage."""
    lives = np.full(len(skin.points), np.inf)
    lives[life.points] = life.life
    rows = skin.parts.ravel()
    seen = SEATED.get(body, FACE).columns(skin.points[rows])
    return Table(name, title, (*seen, Column("life", "-", "life in revolutions of the chain", lives[rows])), missing=ENDLESS)


def seat_table(history: SolidHistory, side: str, instant: int) -> Table:
    """Table "seat_pressure": pressure on a seat unrolled, at one instant: angle from the outer direction, height, pressure."""
    along, height, pressure = _unrolled(history, side, instant)
    return Table(
        "seat_pressure",
        "Seat pressure of a pin, unrolled",
        (
            Column("along", "m", "position along the seat from the outer direction", along, "Position along the seat"),
            Column("height", "m", "position along the pin", height),
            Column("depth", "m", "depth in the picture", np.zeros(len(along))),
            Column("pressure", "Pa", "pressure on the seat", pressure),
        ),
    )


def rolling_table(rolling: RollingPins, radius: float, modulus: float, poisson: float) -> Table:
    """Table "rolling_pressure": line load and Hertz pressure between two like pins of a radius [m] along the pins."""
    found = hertz.line_contact(
        rolling.line_load, 1.0, hertz.effective_radius(radius, radius), hertz.effective_modulus(modulus, poisson, modulus, poisson)
    )
    return Table(
        "rolling_pressure",
        "Rolling contact along the pins",
        (
            Column("height", "m", "position along the pin from the middle of the chain", rolling.height, "Position along the pin"),
            Column("line_load", "N/m", "line load between the pins", rolling.line_load),
            Column("pressure", "Pa", "Hertz pressure between the pins", np.asarray(found.pressure)),
        ),
    )


def section_table(history: SolidHistory, side: str, instant: int) -> Table:
    """Table "hole_section": von Mises stress of plate and pin in the plane of both pins' axes, around one hole, at one instant."""
    solid = history.solid
    seat = solid.plate.seat(side)
    span = seat.center[0] + AROUND * seat.radius * np.array([-1.0, 1.0])
    blocks = [
        _section(solid.model.bodies[name], history.states[instant].displacement(name), seat.center[1], span, solid.stack.end)
        for name in ("plate", side)
    ]
    x, z, size = (np.concatenate([block[n] for block in blocks]) for n in range(3))
    return Table(
        "hole_section",
        "Section through the hole, von Mises stress",
        (
            Column("x", "m", "position along the chain", x),
            Column("z", "m", "position along the pin from the middle of the chain", z, "Position along the pin"),
            Column("depth", "m", "depth in the picture", 0 * x),
            Column("mises", "Pa", "von Mises stress", size),
        ),
    )


def _unrolled(history: SolidHistory, side: str, instant: int) -> tuple[Floats, Floats, Floats]:
    """Triangles of a seat, three rows each, counter-clockwise: place along it from the outer direction and height [m], pressure [Pa]."""
    number = SIDES.index(side)
    pairing, (skin, _) = history.solid.model.pairings[number], history.solid.model.skins[number]
    pressure = np.zeros(skin.nodes.max() + 1)
    pressure[pairing.corners] = history.states[instant].pressure[number]
    seat = history.solid.plate.seat(side)
    place = skin.places[:, :3] * MM
    turn = np.angle(((place[..., 0] - seat.center[0]) + 1j * (place[..., 1] - seat.center[1])) * OUTWARD[side])
    flat = np.stack([seat.radius * turn, place[..., 2]], axis=-1)
    (ax, ay), (bx, by) = np.moveaxis(flat[:, 1] - flat[:, 0], -1, 0), np.moveaxis(flat[:, 2] - flat[:, 0], -1, 0)
    order = np.where((ax * by > ay * bx)[:, None], [0, 1, 2], [0, 2, 1])  # counter-clockwise
    along, height = np.take_along_axis(flat, order[..., None], axis=1).reshape(-1, 2).T
    rows = np.take_along_axis(skin.corners, order, axis=1).ravel()
    return along, height, pressure[rows]


def _section(body: FreeBody, field: Floats, y: float, span: Floats, height: float) -> tuple[Floats, Floats, Floats]:
    """Triangles (x, z) [m] and von Mises stress [Pa] of the rectangles of a grid in the plane y [m] that lie in a body; field [mm]."""
    ng = body.ng
    x, z = np.linspace(span[0], span[1], GRID[0] + 1), np.linspace(0.0, height, GRID[1] + 1)
    middle = np.stack(np.meshgrid(0.5 * (x[1:] + x[:-1]), 0.5 * (z[1:] + z[:-1]), indexing="ij"), axis=-1).reshape(-1, 2) / MM
    inside = [body.mesh.Contains(float(a), y / MM, float(b)) for a, b in middle]
    kept = middle[inside]
    if not len(kept):
        return np.zeros(0), np.zeros(0), np.zeros(0)
    shape = ng.GridFunction(body.space)
    shape.vec.FV().NumPy()[:] = field
    at = body.mesh(kept[:, 0], np.full(len(kept), y / MM), kept[:, 1])
    size = von_mises(hooke(body, np.asarray(ng.Grad(shape)(at)).reshape(-1, 3, 3)))
    half = 0.5 * np.array([x[1] - x[0], z[1] - z[0]])
    corners = np.array([(-1, -1), (1, -1), (1, 1), (-1, -1), (1, 1), (-1, 1)]) * half
    place = (kept[:, None, :] * MM + corners).reshape(-1, 2)
    return place[:, 0], place[:, 1], np.repeat(size, 6)
