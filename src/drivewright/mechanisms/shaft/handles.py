"""Sizes of a shaft that a hand can move on the drawing: segments, and the places of all that is on them.

All handles stand on the shaft at rest, in the machine frame: z to the right.
"""

from collections.abc import Iterator

from drivewright.mechanisms.shaft.build import ShaftModel
from drivewright.mechanisms.shaft.spec import ShaftSpec
from drivewright.scene import Handle

RIGHT = (1.0, 0.0)
ABOVE = 0.8  # of the largest diameter: where the places of loads are


def handles(model: ShaftModel) -> Iterator[Handle]:
    """Handles of places first, then those of segments."""
    yield from _places(model.spec)
    start = 0.0
    for number, segment in enumerate(model.spec.segments):
        yield from _segment(f"segments.{number}", segment, start)
        start += segment.length


def _places(spec: ShaftSpec) -> Iterator[Handle]:
    above = ABOVE * max(max(segment.diameter, segment.end_diameter or 0.0) for segment in spec.segments)
    for number, bearing in enumerate(spec.bearings):
        yield Handle(f"bearings.{number}.position", (bearing.position, 0.0), RIGHT)
    for number, station in enumerate(spec.stations):
        yield Handle(f"stations.{number}.position", (station.position, 0.0), RIGHT)
    for number, gear in enumerate(spec.gears):
        yield Handle(f"gears.{number}.position", (gear.position, -gear.pitch_diameter / 2), RIGHT)
        yield Handle(f"gears.{number}.pitch_diameter", (gear.position, gear.pitch_diameter / 2), (0.0, 0.5))
    for number, load in enumerate(spec.loads):
        if load.position is not None:
            yield Handle(f"loads.{number}.position", (load.position, above), RIGHT)
    for number, line in enumerate(spec.line_loads):
        yield Handle(f"line_loads.{number}.start", (line.start, above), RIGHT)
        yield Handle(f"line_loads.{number}.end", (line.end, above), RIGHT)


def _segment(key, segment, start):
    """Length at its right end, diameters upon its edge, bore below the axis."""
    cone, middle, end = segment.end_diameter, start + segment.length / 2, start + segment.length
    yield Handle(f"{key}.length", (end, -(cone or segment.diameter) / 2), RIGHT)
    yield Handle(f"{key}.diameter", (start if cone else middle, segment.diameter / 2), (0.0, 0.5))
    if cone:
        yield Handle(f"{key}.end_diameter", (end, cone / 2), (0.0, 0.5))
    if segment.bore:
        yield Handle(f"{key}.bore", (middle, -segment.bore / 2), (0.0, -0.5))
