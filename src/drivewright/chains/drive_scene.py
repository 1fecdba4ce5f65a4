"""A chain drive on screen and as solids: sprockets and plates as shapes, the rigid chain over teeth of the driving sprocket."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats, Numbers
from drivewright.chains.closure import Closure, plates, states_at
from drivewright.chains.explicit.turning import turning
from drivewright.chains.model import ChainDrive, Guide
from drivewright.chains.path.balance import Balance
from drivewright.chains.path.route import bodies as bodies_of
from drivewright.chains.plate import Plate
from drivewright.chains.roller_sprocket import RollerSprocket
from drivewright.chains.sprocket import Sprocket
from drivewright.scene import Arc, Body, Frame, Line, Outline, Part, Scene, Shape, circle

FRAMES = 49
PERIOD = 3.0  # seconds on the screen for the teeth shown
FINE = 2e-5  # of the teeth's outline on the screen [m]
RAIL = 4e-3  # thickness of a rail on the screen [m]


class SprocketView(NamedTuple):
    """A sprocket on screen: name, label, shapes in the frame in which tooth 0 lies on x, colour."""

    name: str
    label: str
    shapes: tuple[Shape, ...]
    colour: str


def closure_scene(closure: Closure, sprockets: Sequence[SprocketView], links: Sequence[tuple[Shape, ...]], teeth: int = 2) -> Scene:
    """The chain running over so many teeth of the driver; then a plate stands where another one stood, `teeth` plates ahead.

    sprockets: driver and driven one; links: shapes of the links in turn.
    """
    drive = closure.drive
    angle = np.linspace(0, -teeth * 2 * np.pi / drive.driver_teeth, FRAMES)  # clockwise: the way the chain's own x points
    states = states_at(closure, angle)
    chain = plates(closure, states)
    turns = (poses(0 * angle, angle), poses(states.centre_distance, states.driven_angle))
    bodies = [Body(each.name, each.label, each.shapes, turn, each.colour) for each, turn in zip(sprockets, turns, strict=True)]
    bodies += [
        Body(f"link{number}", "links", links[number % len(links)], chain[:, number], ("steel", "blue")[number % 2])
        for number in range(drive.links)
    ]
    seen_from = (Frame(each.name, f"seen from the {each.label}", turn) for each, turn in zip(sprockets, turns, strict=True))
    frames = (Frame("machine", "machine frame", np.zeros((FRAMES, 3))), *seen_from)
    return Scene(-angle, "angle of the driving sprocket", "rad", PERIOD, tuple(bodies), frames)


def path_scene(
    model: ChainDrive, sprockets: Sequence[SprocketView], links: Sequence[tuple[Shape, ...]], balance: Balance, teeth: int = 2
) -> Scene:
    """The same of a drive with tensioners, guides or further sprockets, as rigid links; sprockets as numbered in the model."""
    angle = -np.linspace(0, teeth * 2 * np.pi / model.sprockets[0].tooth.teeth, FRAMES)
    turned = turning(model, angle, balance, exact=False)
    poses_of = [_moved(model, turned, number) for number in range(len(bodies_of(model)))]
    bodies = [Body(each.name, each.label, each.shapes, poses_of[n], each.colour) for n, each in enumerate(sprockets)]
    for number, guide in enumerate(model.guides, len(model.sprockets)):
        colour = "violet" if guide.slide else "ground"
        words = "tensioner" if guide.slide else "guide"
        bodies.append(Body(guide.name, f"{words} {guide.name}", (Shape("body", rail(guide)),), poses_of[number], colour))
    bodies += [
        Body(f"link{number}", "links", links[number % len(links)], turned.plates[:, number], ("steel", "blue")[number % 2])
        for number in range(model.chain.count)
    ]
    seen_from = (Frame(each.name, f"seen from the {each.label}", poses_of[n]) for n, each in enumerate(sprockets[:2]))
    frames = (Frame("machine", "machine frame", np.zeros((FRAMES, 3))), *seen_from)
    return Scene(-angle, "angle of the driving sprocket", "rad", PERIOD, tuple(bodies), frames)


def _moved(model, turned, number):
    """Poses (frames, 3) of a sprocket or guide."""
    body, q = bodies_of(model)[number], turned.q[:, number]
    centre = complex(*body.centre) + (body.slide.shift(complex(*body.centre), q) if body.slide else 0 * q)
    turn = turned.psi[:, number] if number < len(model.sprockets) else (body.slide.turn(q) if body.slide else 0.0) + 0 * q
    return np.stack([np.real(centre), np.imag(centre), turn], axis=1)


def rail(guide: Guide) -> Outline:
    """Outline of a rail about the centre of its arc: a band as thick as a part of its radius, with its face on the arc."""
    back, sweep = guide.radius - min(RAIL, 0.5 * guide.radius), guide.end - guide.start
    ends = [[r * np.array([np.cos(a), np.sin(a)]) for r in (back, guide.radius)] for a in (guide.start, guide.end)]
    pieces = (
        Arc((0.0, 0.0), guide.radius, guide.start, sweep),
        Line(tuple(ends[1][1]), tuple(ends[1][0])),
        Arc((0.0, 0.0), back, guide.end, -sweep),
        Line(tuple(ends[0][0]), tuple(ends[0][1])),
    )
    return Outline(pieces)


def poses(x: Numbers, angle: Numbers) -> Floats:
    """Poses (n, 3) of places along x at angles  [m, m, rad]."""
    return np.stack(np.broadcast_arrays(x, 0.0, angle), axis=1)


def gap_angle(sprocket: Sprocket | RollerSprocket) -> float:
    """Angle [rad] from the y axis of a sprocket's own frame to its tooth 0: half a tooth where gaps count, as for rollers."""
    return np.pi / sprocket.teeth if isinstance(sprocket, RollerSprocket) else 0.0


def sprocket_shapes(sprocket: Sprocket | RollerSprocket, bore: float) -> Iterator[Shape]:
    """A sprocket in the frame in which tooth 0 lies on x: its teeth, bore (diameter [m]), and a mark that shows how it turns."""
    outline = sprocket.outline() if isinstance(sprocket, RollerSprocket) else sprocket.outline(FINE)
    yield Shape("body", outline.transformed((0.0, 0.0, -np.pi / 2 - gap_angle(sprocket))))
    if bore:
        yield Shape("hole", circle((0, 0), 0.5 * bore))
    reach = 0.9 * sprocket.root_radius
    yield Shape("axis", circle((reach, 0.0), 0.02 * reach).transformed((0.0, 0.0, -np.pi / 2)))


class Placed(NamedTuple):
    """A drive at the angle 0 of its driver: poses (sprockets, 3) of the sprockets, of all plates (links, 3)  [m, m, rad]."""

    sprockets: Floats
    plates: Floats


def placed_closure(closure: Closure) -> Placed:
    """The `Placed` of two sprockets and a rigid chain."""
    states = states_at(closure, [0.0])
    return Placed(np.array([[0.0, 0.0, 0.0], [states.centre_distance[0], 0.0, states.driven_angle[0]]]), plates(closure, states)[0])


def placed_path(model: ChainDrive, balance: Balance) -> Placed:
    """The `Placed` of a drive with tensioners, guides or further sprockets."""
    turned = turning(model, [0.0], balance, exact=False)
    return Placed(np.array([_moved(model, turned, n)[0] for n in range(len(model.sprockets))]), turned.plates[0])


def sprocket_parts(
    placed: Placed, sprockets: Sequence[Sprocket | RollerSprocket], names: Sequence[str], bore: float, width: float
) -> Iterator[Part]:
    """Sprockets as solids of a width with a bore (diameter) [m], where they stand at the angle 0 of the driver."""
    for sprocket, name, (x, y, angle) in zip(sprockets, names, placed.sprockets, strict=True):
        yield sprocket.part(bore, width, name, (float(x), float(y), float(angle - np.pi / 2 - gap_angle(sprocket))))


def plate_shapes(plate: Plate, holes: bool = True) -> Iterator[Shape]:
    """A plate and its own pins, with its holes where asked."""
    yield Shape("body", plate.outline)
    if holes:
        yield from (Shape("hole", hole) for hole in plate.holes)
    yield from (Shape("roller", pin) for pin in plate.own_pins)
