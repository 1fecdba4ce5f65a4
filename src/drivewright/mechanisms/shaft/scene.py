"""The shaft on screen and for manufacture: bent by its loads, its drawing and its solid."""

from dataclasses import replace

from drivewright import shafts
from drivewright.errors import SolverError
from drivewright.mechanisms.shaft.build import ShaftModel
from drivewright.mechanisms.shaft.handles import handles
from drivewright.mechanisms.shaft.influence import flexibility
from drivewright.result import Answer
from drivewright.scene import Drawing, Part, Scene
from drivewright.shafts.drawing import turned_drawing, turned_part
from drivewright.shafts.scenes import BentShape, DrawnGear, load_phases, shaft_scene


def scene(model: ShaftModel) -> Scene:
    """The shaft under its loads; without loads under a force at the last station."""
    gears = [DrawnGear(gear.name, gear.position, gear.pitch_diameter, gear.face_width) for gear in model.spec.gears]
    stations = {station.name: station.position for station in model.spec.stations}
    drawn = shaft_scene(model.shaft, _bent_shape(model), model.direction, model.loads, gears, model.rolling, stations)
    return replace(drawn, handles=tuple(handles(model)))


def _bent_shape(model: ShaftModel) -> BentShape | None:
    try:
        loaded = shafts.apply_loads(model.shaft, model.loads)
    except SolverError:  # the run says so; the picture shows the shaft as it is
        return None
    beam = loaded.equilibrium.model.beam
    if model.loaded or not model.names:
        return BentShape(beam, loaded.equilibrium.unknowns, loaded.spread, "deflection")
    found = flexibility(model, {"statics": Answer(data=loaded)}).data
    return None if found is None else BentShape(beam, found.unknowns[:, -1], (None, None), f"force at {model.names[-1]}, deflection")


def drawings(model: ShaftModel) -> tuple[Drawing, ...]:
    """The turned part along its axis."""
    return (turned_drawing(model.shaft),)


def parts(model: ShaftModel) -> tuple[Part, ...]:
    """The shaft as a solid of revolution about x, which turns once over the scene."""
    return (turned_part(model.shaft, load_phases()),)
