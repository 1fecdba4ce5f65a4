"""The chain drive on screen and for manufacture: scene over two teeth, drawings, parts."""

from dataclasses import replace

from drivewright.chains.drive_scene import (
    SprocketView,
    closure_scene,
    path_scene,
    placed_closure,
    placed_path,
    plate_shapes,
    sprocket_parts,
    sprocket_shapes,
)
from drivewright.chains.link import tooth_turn
from drivewright.chains.plate_stack import strand_parts
from drivewright.chains.roller_link import pair_plate
from drivewright.chains.roller_sprocket import RollerSprocket
from drivewright.chains.sprocket import Sprocket
from drivewright.errors import InputError
from drivewright.mechanisms.silent_chain.build import SIDES, ChainModel
from drivewright.mechanisms.silent_chain.chain_drive import bare_drive
from drivewright.mechanisms.silent_chain.handles import handles
from drivewright.mechanisms.silent_chain.meshing import SIDE_WORDS
from drivewright.scene import Drawing, Part, Scene, Shape

SOLID_LINKS = 4
OVERHANG = 0.5e-3  # of the pins beyond the plates, in solids
COLOURS = {"drive": "orange", "driven": "green"}


def scene(model: ChainModel) -> Scene:
    """The chain running over two teeth of the driving sprocket; then every plate stands where the next one but one stood."""
    if model.link.skew and not model.closes:
        raise InputError("the motion of a chain with tensioners or further sprockets can be shown for joints of two equal radii only")
    if model.spec.drive is None and model.spec.sprockets:
        raise InputError("the path of a chain around more than two sprockets depends on its loads; add [drive]")
    views = [SprocketView(name, words, _under_the_chain(model, sprocket), colour) for name, words, sprocket, colour in _sprockets(model)]
    links = link_shapes(model)
    closed = model.closes
    drawn = closure_scene(model.closure, views, links) if closed else path_scene(bare_drive(model), views, links, model.balance)
    return replace(drawn, handles=tuple(handles(model)))


def _sprockets(model):
    """(name, label, sprocket, colour) of all sprockets."""
    for side, sprocket in zip(SIDES, model.sprockets, strict=True):
        yield side, SIDE_WORDS[side], sprocket, COLOURS[side]
    for given in model.spec.sprockets:
        yield given.name, f"{'tensioner' if given.force else 'sprocket'} {given.name}", model.sprocket(given.teeth), "violet"


def _under_the_chain(model: ChainModel, sprocket: Sprocket | RollerSprocket) -> tuple[Shape, ...]:
    """Shapes of a sprocket, its teeth turned under plates whose pins of two radii shift them along the chain."""
    shapes = tuple(sprocket_shapes(sprocket, model.bore))
    if not model.link.skew or isinstance(sprocket, RollerSprocket):
        return shapes
    turn = tooth_turn(model.worn, sprocket.tooth)
    return tuple(shape._replace(outline=shape.outline.transformed((0.0, 0.0, turn), False)) for shape in shapes)


def link_shapes(model: ChainModel) -> tuple[tuple[Shape, ...], ...]:
    """Shapes of the links in turn: plates with their own pins, or the figure of eight and its roller."""
    roller = model.roller_link
    if model.link.skew:
        return ((Shape("body", pair_plate(model.link)),),)
    return (roller.shapes,) if roller else tuple(tuple(plate_shapes(model.plate, holes)) for holes in (True, False))


def drawings(model: ChainModel) -> tuple[Drawing, ...]:
    """Plate and all sprockets; what cannot be drawn raises InputError."""
    if model.link.skew:
        raise InputError(model.plate_refusal)
    bore, width, roller = model.bore, model.chain_width, model.roller_link
    sprockets = [sprocket.drawing(bore, width, f"sprocket_{name}") for name, _, sprocket, _ in _sprockets(model)]
    return (roller.drawing() if roller else model.plate.drawing(), *sprockets)


def parts(model: ChainModel) -> tuple[Part, ...]:
    """All sprockets and the first links, of each kind two: as solids the whole chain would fill tens of megabytes."""
    placed = placed_closure(model.closure) if model.closes else placed_path(bare_drive(model), model.balance)
    roller, links = model.roller_link, placed.plates[:SOLID_LINKS]
    names, _, wheels, _ = zip(*_sprockets(model), strict=True)
    low, high = sorted(model.spec.plate.lacing)
    return (
        *sprocket_parts(placed, wheels, names, model.bore, model.chain_width),
        *(roller.parts(links) if roller else strand_parts(model.plate, links, (low, high), overhang=OVERHANG)),
    )
