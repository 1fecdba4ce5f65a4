"""A straight joint under a strand's force: half a plate of each link and both pins as elastic solids in contact (extra `fe`).

The half above the middle plane z = 0 is meshed.  Plates press on their pins through the mesh; the pins' rolling contact, a few hundredths
of a millimetre wide, is a row of line contacts: each spreads its force over a strip as wide as the elements, and what a Hertz contact
yields more than that strip (`contact.hertz_beyond_strip`) is added as a compliance of each pin.
"""

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.chains.plate import Plate
from drivewright.chains.solid.meshes import Sizes, pin_mesh, plate_mesh
from drivewright.contact import hertz
from drivewright.contact.strip import hertz_beyond_strip
from drivewright.errors import InputError
from drivewright.scene import Outline
from drivewright.solids.contact.model import ContactModel, ContactState, Functional, Link, Pair
from drivewright.solids.contact.pairing import GapOf
from drivewright.solids.elastic import MM, FreeBody
from drivewright.solids.engine import EngineObject, fe_module

OUTWARD = {"left": -1.0, "right": 1.0}  # sense along x that leads out of a plate
STRIP = 0.08  # width sigma of a rolling contact's strip in radii of the seat
HATS = 12  # of the rolling contact along half a pin
APART = 1.0  # mm: gap of a part of a seat that does not bear
LOOSEST = 0.05  # clearance in radii of the seat
REACH = 2e-5  # m: beyond the clearance, what may close


class Fit(NamedTuple):
    """How a pin sits in its hole: radial clearance [m]; radius [m] of the rounded edges of the hole; half angle [rad] of the seat that
    bears, about the direction outwards, all of it unless given; coefficient of friction."""

    clearance: float
    edge_radius: float
    seat: float | None = None
    friction: float = 0.0


class Stack(NamedTuple):
    """Half a stack of plates: edges z [m] of the own plate and of the neighbour's next to it, the pin's end, and whether the stack goes on
    there (a plane of symmetry) or ends."""

    own: tuple[float, float]
    other: tuple[float, float]
    end: float
    endless: bool


class Material(NamedTuple):
    """Young's modulus [Pa] and Poisson's ratio."""

    modulus: float
    poisson: float


def stack_of(plate: Plate, lacing: tuple[int, int]) -> Stack:
    """The `Stack` of a lacing: 1 x 2 as it is, wider ones as a cell of an endless stack."""
    t, wide = plate.thickness, min(lacing) > 1
    return Stack((0.0, t / 2), (t / 2, t if wide else 1.5 * t), t if wide else 1.5 * t, wide)


@dataclass(frozen=True, eq=False)
class RollingPins:
    """What the pins of a straight joint do to each other under a force [N] of half a stack.

    height (k,) [m] and line load q (k,) [N/m] along the pins; state: of the bodies "own plate", "own pin", "other pin", "other plate".
    """

    height: Floats
    line_load: Floats
    state: ContactState

    @property
    def shares(self) -> Floats:
        """Shares of the force (k,) on the hats along the pins."""
        return self.state.links[: len(self.height)] / self.state.links[: len(self.height)].sum()


def rolling_pins(plate: Plate, stack: Stack, fit: Fit, material: Material, force: float, sizes: Sizes) -> RollingPins:
    """`RollingPins` of a joint whose half stack carries a force [N]."""
    if not plate.link.radius > 0:
        raise InputError("stress of solids: a joint with one round pin has no rolling pins")
    pitch, (left, right) = plate.link.pitch, plate.own_pins
    pairs = [
        seat_pair(plate, "own plate", "right", "own pin", fit, stack.own, 0.0),
        seat_pair(plate, "other plate", "left", "other pin", fit, stack.other, pitch),
    ]
    own = FreeBody(plate_mesh(plate, *stack.own, sizes, half=1), *material, dirichletx="cut", dirichletz="low")
    last: Any = {"dirichletz": "high"} if stack.endless else {}
    other = FreeBody(plate_mesh(plate, *stack.other, sizes, half=-1, shift=pitch), *material, **last)
    pins = {"own pin": pin_body(right, stack, material, sizes, 0.0), "other pin": pin_body(left, stack, material, sizes, pitch)}
    bodies = {"own plate": own, **pins, "other plate": other}
    contact = complex(pitch / 2)
    half_width = hertz.line_contact(
        force, stack.end, hertz.effective_radius(plate.link.radius, plate.link.radius), hertz.effective_modulus(*material, *material)
    ).half_width
    sigma = STRIP * plate.seat("right").radius
    rows = [strip_rows(pins[name], contact, way, sigma, stack.end) for name, way in (("own pin", -1.0), ("other pin", 1.0))]
    widths = hat_widths(stack.end)
    soft = 2 * hertz_beyond_strip(sigma, half_width, *material) / widths  # of both pins
    links = [
        Link((Functional("own pin", a), Functional("other pin", b)), float(c), one_sided=True) for a, b, c in zip(*rows, soft, strict=True)
    ]
    links += [Link((Functional(name, turn_row(pins[name])),)) for name in pins]
    links += [Link((Functional("own plate", own.mean("cut", (0, 1, 0))),)), *_guides("other plate", other, stack)]
    pull = Functional("other plate", other.mean("cut", (1, 0, 0)))
    model = ContactModel(bodies, pairs, links, {"pull": pull})
    state = model.solve({"pull": force})
    height = np.linspace(0.0, stack.end, HATS + 1)
    return RollingPins(height, state.links[: len(height)] / widths, state)


def pin_body(outline: Outline, stack: Stack, material: Material, sizes: Sizes, shift: float) -> FreeBody:
    """Half a pin, held in the middle plane."""
    mesh = pin_mesh(outline, stack.end, (stack.own[1], stack.other[1]), sizes, shift)
    return FreeBody(mesh, *material, dirichletz="low|high" if stack.endless else "low")


def seat_pair(plate: Plate, name: str, side: str, pin: str, fit: Fit, edges: tuple[float, float], shift: float) -> Pair:
    """The `Pair` of a plate's seat and its pin in a `Fit`, between a plate's faces at `edges` [m]."""
    more = seat_gap(plate, side, fit, edges, shift)
    reach = fit.clearance + 0.5 * fit.edge_radius + REACH
    return Pair((name, f"seat {side}.*"), (pin, "skin"), reach, more, friction=fit.friction, label=f"the {side} seat of a plate")


def seat_gap(plate: Plate, side: str, fit: Fit, edges: tuple[float, float], shift: float = 0.0) -> GapOf:
    """Gap of a seat that the mesh does not have: clearance, rounded edges of the hole, and the part of the seat that does not bear.

    InputError where the clearance is no small part of the seat's radius: the mesh has hole and pin alike.
    """
    seat = plate.seat(side)
    if fit.clearance > LOOSEST * seat.radius:
        raise InputError(
            f"stress of solids: a clearance of {fit.clearance / MM:.4g} mm is too large for the assumption of small displacements around "
            "a pin of "
            f"{seat.radius / MM:.4g} mm in radius; give a clearance of {LOOSEST * seat.radius / MM:.2g} mm or less."
        )
    centre, radius = (complex(*seat.center) + shift) / MM, fit.edge_radius / MM

    def gap(points: Floats, normals: Floats) -> Floats:
        """Gap [mm] at points [mm]."""
        relief = np.full(len(points), fit.clearance / MM)
        for edge in edges:
            if edge > 0:  # 0 is the middle plane
                near = np.maximum(radius - np.abs(points[:, 2] - edge / MM), 0.0)
                relief += radius - np.sqrt(np.maximum(radius**2 - near**2, 0.0))
        if fit.seat is not None:
            turn = np.angle((points[:, 0] + 1j * points[:, 1] - centre) * OUTWARD[side])
            relief += np.where(np.abs(turn) > fit.seat, APART, 0.0)
        return relief

    return gap


def strip_rows(pin: FreeBody, contact: complex, normal: float, sigma: float, end: float) -> list[EngineObject]:
    """Load vectors of unit forces into a pin along the hats of its rolling contact; `normal`: out of the pin along x, 1 or -1."""
    ng, step = fe_module("ngsolve", "stress of solids"), end / HATS / MM
    rows = []
    for number in range(HATS + 1):
        hat = 1 - ng.Norm(ng.z - number * step) / step
        row = pin.gaussian_strip("skin", contact, complex(normal), sigma, along=ng.IfPos(hat, hat, 0))
        row.data = -1.0 * row
        rows.append(row)
    return rows


def turn_row(pin: FreeBody) -> EngineObject:
    """Load vector of a couple about a pin's own axis, by tractions along its skin: what holds it from turning in its seat."""
    ng, v = pin.ng, pin.space.TestFunction()
    area, skin = pin.area("skin"), ng.ds("skin")
    x, y = (c - ng.Integrate(c * skin, pin.mesh) / area for c in (ng.x, ng.y))
    spread = ng.Integrate((x * x + y * y) * skin, pin.mesh)
    return ng.LinearForm((x * v[1] - y * v[0]) / spread * skin).Assemble().vec


def hat_widths(end: float) -> Floats:
    """Lengths (k,) [m] that the hats stand for."""
    step = end / HATS
    return np.where((np.arange(HATS + 1) % HATS) == 0, step / 2, step)


def _guides(name: str, plate: FreeBody, stack: Stack) -> list[Link]:
    """What symmetry about the neighbour's own middle holds: its cut face moves neither across nor turns."""
    ng = fe_module("ngsolve", "stress of solids")
    area = plate.area("cut")
    y0, z0 = (ng.Integrate(c * ng.ds("cut"), plate.mesh) / area for c in (ng.y, ng.z))
    tilt = [((ng.y - y0), 0, 0), ((ng.z - z0), 0, 0)]
    across = [plate.mean("cut", (0, 1, 0))]
    if not stack.endless:
        tilt.append((0, 0, ng.y - y0))
        across.append(plate.mean("cut", (0, 0, 1)))
    across += [plate.weighted("cut", ng.CF(tuple(each)) / area) for each in tilt[: 1 if stack.endless else None]]
    return [Link((Functional(name, vector),)) for vector in across]
