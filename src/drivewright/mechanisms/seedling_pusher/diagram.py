"""The motion programme of the pusher rod as a diagram that can be edited: push, hold, retraction and rest over the carrier angle."""

import numpy as np

from drivewright.mechanisms.seedling_pusher.build import PusherModel
from drivewright.mechanisms.seedling_pusher.spec import LAWS
from drivewright.motion.diagram import diagram_segments
from drivewright.motion_diagram import DiagramSegment, FixedKeys, LawChoice, MotionDiagram, Origin

LOWEST = 'The push ends at the lowest position of the needle tip (push.end_event = "lowest"); that border is not moved here.'
CHECKS = tuple(f"{check}.{cam}" for check in ("pressure_angle", "undercut", "curvature_margin") for cam in ("main", "return"))
NONE = DiagramSegment("dwell", 0.0, 0.0, np.zeros((5, 2)))


def diagram(model: PusherModel) -> MotionDiagram:
    """The four segments as the spec states them; a hold of no length has its place too."""
    push, segments = model.spec.push, list(diagram_segments(model.pair.programme))
    if not push.hold:
        segments.insert(1, NONE)
    lowest = push.end_event == "lowest"
    return MotionDiagram(
        "",
        tuple(segment._replace(fixed=keys) for segment, keys in zip(segments, _keys(lowest), strict=True)),
        model.pair.programme.cycle,
        "carrier angle",
        "m",
        model.spec.drive.speed,
        tuple(map(LawChoice, LAWS)),
        origin=_origin(model, lowest),
        notes=(LOWEST,) if lowest else (),
        checks=CHECKS,
    )


def _keys(lowest: bool) -> tuple[FixedKeys, ...]:
    """Of push, hold, retraction and rest; the end of the push is a number of the spec, or the lowest position of the tip."""
    end = {} if lowest else {"push.end": 1.0, "push.rise": 1.0, "push.hold": -1.0}
    return (
        FixedKeys("push.rise", "push.stroke", "push.law", 1.0, {"push.rise": -1.0}),
        FixedKeys("push.hold", border=end),
        FixedKeys("push.retraction", "push.stroke", "push.law", -1.0, {"push.hold": 1.0, "push.retraction": -1.0}),
        FixedKeys(border={"push.retraction": 1.0}),
    )


def _origin(model: PusherModel, lowest: bool) -> Origin:
    """Where the push begins: at its end less its rise."""
    return Origin(float(model.arm.lowest), {"push.rise": -1.0}) if lowest else Origin(0.0, {"push.end": 1.0, "push.rise": -1.0})
