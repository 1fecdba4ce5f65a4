"""A chain drive on screen and as solids: sprockets and plates as shapes, the rigid chain over teeth of the driving sprocket."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats, Numbers
from drivewright.chains.closure import Closure, plates, states_at
from drivewright.chains.plate import Plate
from drivewright.chains.roller_sprocket import RollerSprocket
from drivewright.chains.sprocket import Sprocket
from drivewright.scene import Body, Frame, Part, Scene, Shape, circle

FRAMES = 49
PERIOD = 3.0  # seconds on the screen for the teeth shown
FINE = 2e-5  # of the teeth's outline on the screen [m]


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


def sprocket_parts(
    closure: Closure, sprockets: Sequence[Sprocket | RollerSprocket], names: Sequence[str], bore: float, width: float
) -> Iterator[Part]:
    """Driver and driven sprocket as solids of a width with a bore (diameter) [m], where they stand at the angle 0 of the driver."""
    states = states_at(closure, [0.0])
    places = (0.0, 0.0), (float(states.centre_distance[0]), float(states.driven_angle[0]))
    for sprocket, name, (x, angle) in zip(sprockets, names, places, strict=True):
        yield sprocket.part(bore, width, name, (x, 0.0, float(angle - np.pi / 2 - gap_angle(sprocket))))


def first_links(closure: Closure, count: int) -> Floats:
    """(count, 3) poses [m, m, rad] of the first plates at the angle 0 of the driver."""
    return plates(closure, states_at(closure, [0.0]))[0, :count]


def plate_shapes(plate: Plate, holes: bool = True) -> Iterator[Shape]:
    """A plate and its own pins, with its holes where asked."""
    yield Shape("body", plate.outline)
    if holes:
        yield from (Shape("hole", hole) for hole in plate.holes)
    yield from (Shape("roller", pin) for pin in plate.own_pins)
