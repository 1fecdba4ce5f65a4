"""The chain drive on screen and for manufacture: scene over two teeth, drawings, parts."""

from collections.abc import Iterator

import numpy as np

from drivewright._typing import Floats, Numbers
from drivewright.chains.closure import plates, states_at
from drivewright.chains.plate_stack import strand_parts
from drivewright.chains.roller_sprocket import RollerSprocket, roller_plate
from drivewright.errors import InputError
from drivewright.mechanisms.silent_chain.build import SIDES, ChainModel
from drivewright.mechanisms.silent_chain.meshing import SIDE_WORDS
from drivewright.scene import Body, Drawing, Frame, Part, Prism, Scene, Shape, circle

FRAMES = 49
SLOWLY = 3.0  # seconds for the two teeth on the screen
FINE = 2e-5  # of the teeth's outline on the screen [m]
SOLID_LINKS = 4
OVERHANG = 0.5e-3  # of the pins beyond the plates, in solids
COLOURS = {"drive": "orange", "driven": "green"}


def scene(model: ChainModel) -> Scene:
    """The chain running over two teeth of the driving sprocket; then every plate stands where the next one but one stood."""
    if model.spec.sprockets:
        raise InputError("a chain around more than two sprockets is shown by its dynamics, not by its closure")
    angle = np.linspace(0, -4 * np.pi / model.teeth[0], FRAMES)  # clockwise: the way the chain's own x points
    states = states_at(model.closure, angle)
    chain = plates(model.closure, states)
    still = np.zeros((FRAMES, 3))
    turns = {"drive": poses(0 * angle, angle), "driven": poses(states.centre_distance, states.driven_angle)}
    bodies = [
        Body(side, SIDE_WORDS[side], tuple(_wheel(model, sprocket)), turns[side], COLOURS[side])
        for side, sprocket in zip(SIDES, model.sprockets, strict=True)
    ]
    shapes = [tuple(link_shapes(model, number)) for number in range(2)]
    bodies += [
        Body(f"link{number}", "links", shapes[number % 2], chain[:, number], ("steel", "blue")[number % 2])
        for number in range(model.spec.links)
    ]
    frames = (Frame("machine", "machine frame", still), *(Frame(side, f"seen from the {SIDE_WORDS[side]}", turns[side]) for side in SIDES))
    return Scene(-angle, "angle of the driving sprocket", "rad", SLOWLY, tuple(bodies), frames)


def poses(x: Numbers, angle: Numbers) -> Floats:
    """Poses (n, 3) of places along x at angles  [m, m, rad]."""
    return np.stack(np.broadcast_arrays(x, 0.0, angle), axis=1)


def _wheel(model, sprocket):
    """A sprocket in the frame in which tooth 0 lies on x."""
    quarter = (0.0, 0.0, -np.pi / 2)
    outline = sprocket.outline() if model.spec.roller else sprocket.outline(FINE)
    gap = _gap_angle(sprocket)
    yield Shape("body", outline.transformed((0.0, 0.0, -np.pi / 2 - gap)))
    if model.bore:
        yield Shape("hole", circle((0, 0), 0.5 * model.bore))
    reach = 0.9 * sprocket.root_radius
    yield Shape("axis", circle((reach, 0.0), 0.02 * reach).transformed(quarter))


def _gap_angle(sprocket):
    """Angle [rad] from the frame of a sprocket to its tooth 0: half a tooth where gaps count, as for rollers."""
    return np.pi / sprocket.teeth if isinstance(sprocket, RollerSprocket) else 0.0


def link_shapes(model: ChainModel, number: int = 0) -> Iterator[Shape]:
    """One link: plate and its own pins, or the figure of eight and its rollers."""
    if model.spec.roller:
        radius = 0.5 * model.spec.roller.diameter
        yield Shape("body", roller_plate(model.spec.pitch, 0.45 * model.spec.pitch, 0.5 * model.spec.pitch))
        yield Shape("roller", circle((0.5 * model.spec.pitch, 0.0), radius))
        return
    yield Shape("body", model.plate.outline)
    if number == 0:
        yield from (Shape("hole", hole) for hole in model.plate.holes)
    yield from (Shape("roller", pin) for pin in model.plate.own_pins)


def drawings(model: ChainModel) -> tuple[Drawing, ...]:
    """Plate and both sprockets; what cannot be drawn raises InputError."""
    bore, width = model.bore, model.chain_width
    found = [sprocket.drawing(bore, width, f"sprocket_{side}") for side, sprocket in zip(SIDES, model.sprockets, strict=True)]
    if model.spec.roller:
        shape = Shape("profile", roller_plate(model.spec.pitch, 0.45 * model.spec.pitch, 0.5 * model.spec.pitch))
        return (
            Drawing(
                "plate",
                f"plate of a roller chain, pitch {1e3 * model.spec.pitch:.5g} mm",
                (shape,),
                model.spec.plate.thickness,
                milled=False,
            ),
            *found,
        )
    return (model.plate.drawing(), *found)


def parts(model: ChainModel) -> tuple[Part, ...]:
    """Both sprockets and the first links, of each kind two: as solids the whole chain would fill tens of megabytes."""
    states = states_at(model.closure, [0.0])
    where = {"drive": (0.0, 0.0, 0.0), "driven": (float(states.centre_distance[0]), 0.0, float(states.driven_angle[0]))}
    found = []
    for side, sprocket in zip(SIDES, model.sprockets, strict=True):
        x, y, angle = where[side]
        gap = _gap_angle(sprocket)
        found.append(sprocket.part(model.bore, model.chain_width, side, (x, y, float(angle - np.pi / 2 - gap))))
    chain = plates(model.closure, states)[0, :SOLID_LINKS]
    return (*found, *(_links(model, chain) if not model.spec.roller else _roller_links(model, chain)))


def _links(model, chain):
    low, high = sorted(model.spec.plate.lacing)
    return strand_parts(model.plate, chain, (low, high), overhang=OVERHANG)


def _roller_links(model, chain):
    """Plates on both sides of the rollers, inner and outer in turn."""
    width, sheet = model.contact_length, model.spec.plate.thickness
    outline = roller_plate(model.spec.pitch, 0.45 * model.spec.pitch, 0.5 * model.spec.pitch)
    roller = circle((0.5 * model.spec.pitch, 0.0), 0.5 * model.spec.roller.diameter)
    for number, pose in enumerate(chain):
        out = 0.5 * width + (number % 2) * sheet
        solids = (Prism(outline, (), out, sheet), Prism(outline, (), -out - sheet, sheet), Prism(roller, (), -0.5 * width, width))
        x, y, turn = map(float, pose)
        yield Part(f"link {number}", solids, (x, y, turn), ("steel", "blue")[number % 2])
