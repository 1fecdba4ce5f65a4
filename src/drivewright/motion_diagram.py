"""Plain data of a motion programme that can be drawn: its segments with lift and derivatives, and the keys of the spec behind them.

A `Mechanism` whose spec has a list of segments gives a `MotionDiagram` of its model; whoever lets a person edit the motion needs nothing
else of the kind of drive.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

from drivewright._typing import Floats


class SegmentKeys(NamedTuple):
    """Names of the keys in the table of a segment."""

    angle: str = "angle"
    rise: str = "rise"
    law: str = "law"
    points: str = "points"  # of a spline, (u, s) from (0, 0) to (1, 1)


class LawChoice(NamedTuple):
    """A motion law that a segment may take, with the parameters that it starts with, {key: text}."""

    name: str
    parameters: Mapping[str, str] = {}


class DiagramSegment(NamedTuple):
    """A segment: its law, angle [rad] and rise, and its course.

    `course` (5, n): angle from its start, lift, and three derivatives with respect to the angle; where a derivative may jump the angle
    stands twice.  `absolute`: its lifts are fixed by a table.  `points` (n, 2) of a spline.
    """

    law: str
    angle: float
    rise: float
    course: Floats
    absolute: bool = False
    points: Sequence[Sequence[float]] = ()


@dataclass(frozen=True)
class MotionDiagram:
    """A motion programme over one cycle [rad]; lifts in `lift_unit`, "m" or "rad"; `speed` [rad/s], nan where none is stated.

    `key` is the list of segments in the spec, `law_keys` are the keys of a segment that belong to its law alone.
    """

    key: str
    segments: tuple[DiagramSegment, ...]
    cycle: float
    cycle_label: str
    lift_unit: str
    speed: float = float("nan")
    laws: tuple[LawChoice, ...] = ()
    law_keys: tuple[str, ...] = ()
    dwell: str = "dwell"
    keys: SegmentKeys = field(default=SegmentKeys())
