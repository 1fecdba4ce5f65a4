"""The drive on screen and for manufacture: scene, drawings, parts."""

from dataclasses import replace

import numpy as np

from drivewright.errors import InputError, SolverError
from drivewright.gears import EllipticGearPair, Rack, cut_gear
from drivewright.indexing import roller_gear
from drivewright.indexing.motion import TURN
from drivewright.indexing.plate_views import CamHoles, PlateDrive, plate_drawings, plate_parts, plate_scene
from drivewright.mechanisms.indexer.build import IndexerModel
from drivewright.mechanisms.indexer.handles import plate_handles, roller_gear_handles
from drivewright.scene import Drawing, Part, Scene

MOST_TEETH = 300  # of a gear that is drawn: cutting them takes seconds
SHOWN_PERIOD = 4.0  # s a turn of the input takes on screen where no speed is given


def plates(model: IndexerModel) -> PlateDrive:
    """What is drawn of a drive with plate cams."""
    spec = model.spec
    outer = getattr(model.crank_bearing, "outer_diameter", None)
    holes = CamHoles(spec.shaft_spacing, outer / 2 if outer else None) if spec.shaft_spacing is not None and model.translating else None
    step = spec.shafts.pitch if spec.shafts else 1.2 * spec.cam_width
    return PlateDrive(model.plane, spec.cams, spec.cam_width, step, holes)


def scene(model: IndexerModel) -> Scene:
    """The drive over one turn of the input."""
    period = TURN / model.spec.load.speed if model.spec.load.speed else SHOWN_PERIOD
    if not model.flat:
        return replace(
            roller_gear.roller_gear_scene(model.cam, period),
            handles=tuple(roller_gear_handles(model.cam, model.spec.centre_distance is not None)),
        )
    drawn = plates(model)
    return replace(plate_scene(drawn, period), handles=tuple(plate_handles(drawn)))


def drawings(model: IndexerModel) -> tuple[Drawing, ...]:
    """The cams that differ, and the gear of input and split shafts; a roller gear has none that is flat."""
    cams = plate_drawings(plates(model), model.spec.title or "indexer") if model.flat else ()
    return (*cams, *input_gear(model))


def input_gear(model: IndexerModel) -> tuple[Drawing, ...]:
    """The gear that input and split shafts have alike, with involute teeth cut by a standard rack; none without a [gear] table.

    Nor one with teeth that such a rack does not cut, or with more than `MOST_TEETH`: the cams are drawn all the same.
    """
    given, shafts = model.spec.gear, model.spec.shafts
    if given is None or not model.flat or given.teeth > MOST_TEETH:
        return ()
    try:
        pair = EllipticGearPair(0.0, given.module * given.teeth / 2)
        gear = cut_gear(pair, 1, given.teeth, Rack(pressure_angle=given.pressure_angle))
    except (InputError, SolverError):
        return ()
    seat, root = shafts.diameters[0] if shafts else 0.0, 2 * np.min(np.abs(gear.profile.chain.z))
    drawn = gear.drawing("gear", seat if seat < root else 0.0)  # a pinion as slim as its shaft is one piece with it
    title = f"gear of input and split shafts, {drawn.title}"
    return (replace(drawn, title=title, milled=False),)  # an end mill does not fit into the tooth spaces


def parts(model: IndexerModel) -> tuple[Part, ...]:
    """Cams and wheel as solids."""
    return plate_parts(plates(model)) if model.flat else (roller_gear.cam_part(model.cam), roller_gear.turret_part(model.cam))
