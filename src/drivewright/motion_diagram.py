"""Plain data of a motion programme that can be drawn: its segments with lift and derivatives, and the keys of the spec behind them.

A `Mechanism` whose spec states a motion segment by segment, in a list or under keys of their own, gives a `MotionDiagram` of its model;
whoever lets a person edit the motion needs nothing else of the kind of drive.
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
    rows: str = "rows"  # of a table, (angle, lift) from the start of the segment
    file: str = "file"  # that has the rows of a table instead


class FixedKeys(NamedTuple):
    """Keys of the spec behind a segment that is no element of a list, "" where there is none.

    `sense` is the rise per number of `rise`; `border` {key: change of its number per change of the angle at which the segment begins},
    {} where that cannot be moved.
    """

    angle: str = ""
    rise: str = ""
    law: str = ""
    sense: float = 1.0
    border: Mapping[str, float] = {}


class Origin(NamedTuple):
    """Cycle angle [rad] at which the first segment begins: `constant` plus the number of each key times its factor."""

    constant: float
    factors: Mapping[str, float] = {}


class LawChoice(NamedTuple):
    """A motion law that a segment may take, with the parameters that it starts with, {key: text}."""

    name: str
    parameters: Mapping[str, str] = {}


class DiagramSegment(NamedTuple):
    """A segment: its law, angle [rad] and rise, and its course.

    `course` (5, n): angle from its start, lift, and three derivatives with respect to the angle; where a derivative may jump the angle
    stands twice.  `absolute`: its lifts are fixed by a table.  `points` (n, 2) of a spline; `rows` (n, 2) of a table, angle [rad] from the
    start of the segment and lift, and the name of the `file` that they were read from, "" where the spec has them.
    """

    law: str
    angle: float
    rise: float
    course: Floats
    absolute: bool = False
    points: Sequence[Sequence[float]] = ()
    rows: Floats | None = None
    file: str = ""
    fixed: FixedKeys | None = None


@dataclass(frozen=True)
class MotionDiagram:
    """A motion programme over one cycle [rad]; lifts in `lift_unit`, "m" or "rad"; `speed` [rad/s], nan where none is stated.

    `key` is the list of segments in the spec, "" where each segment has `FixedKeys`; `law_keys` are the keys of a segment that belong to
    its law alone.  `origin`: where the cycle does not begin with the first segment.  `notes` say in a sentence each what stands still, and
    why; `checks` are the names of the checks that the motion decides.
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
    origin: Origin | None = None
    notes: tuple[str, ...] = ()
    checks: tuple[str, ...] = ()
