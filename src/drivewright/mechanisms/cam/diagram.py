"""The motion programme of a cam as a diagram that can be edited."""

import inspect
from functools import cache

from drivewright import motion
from drivewright.mechanisms.cam.build import LAW_KEYS, CamModel
from drivewright.mechanisms.cam.spec import Segment
from drivewright.motion.diagram import diagram_segments
from drivewright.motion.laws import BUILT_IN
from drivewright.motion_diagram import DiagramSegment, LawChoice, MotionDiagram

CHECKS = ("continuity.velocity", "continuity.acceleration", "pressure_angle", "undercut", "curvature_margin")

STARTS: dict[str, dict[str, str]] = {  # parameters of the laws that do not go without
    "scca": {"b": "0.25", "c": "0", "d": "0.75"},
    "mcv": {"c": "0.5"},
    "spline": {"points": "[[0, 0], [0.25, 0.1], [0.5, 0.5], [0.75, 0.9], [1, 1]]"},
}


def diagram(model: CamModel) -> MotionDiagram:
    """The segments as the spec states them, before an arm maps their lengths to a swing."""
    programme, spec = model.programme, model.spec
    segments = diagram_segments(programme, [segment.points or () if segment.law == "spline" else () for segment in spec.programme])
    return MotionDiagram(
        "programme",
        tuple(_with_rows(*each) for each in zip(segments, programme.segments, spec.programme, strict=True)),
        programme.cycle,
        "cam angle",
        programme.lift_unit or "m",
        model.speed if model.turns else float("nan"),
        laws(),
        LAW_KEYS,
        checks=CHECKS,
    )


def _with_rows(drawn: DiagramSegment, segment: motion.Segment, given: Segment) -> DiagramSegment:
    """A segment as it is drawn, with the rows of its table."""
    law = segment.motion_law
    if not isinstance(law, motion.TableLaw) or law.rows is None:
        return drawn
    return drawn._replace(rows=law.rows * (segment.angle, 1.0), file=given.file.name if given.file else "")


@cache
def laws() -> tuple[LawChoice, ...]:
    """The laws that a segment may take without a file."""
    return (
        LawChoice("dwell"),
        *(LawChoice(name, STARTS.get(name, {})) for name in motion.names() if name in STARTS or _goes_without(name)),
    )


def _goes_without(name):
    """Whether a law needs neither parameters nor a file."""
    build = None if name in ("table", "uniform") else BUILT_IN.get(name)
    return build is not None and not any(each.default is inspect.Parameter.empty for each in inspect.signature(build).parameters.values())
