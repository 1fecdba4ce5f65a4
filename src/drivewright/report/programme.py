"""A motion programme as JSON for a page that draws and edits it."""

import math
from typing import Any

from drivewright.motion_diagram import DiagramSegment, MotionDiagram
from drivewright.report.pack import floats
from drivewright.view.text import shown_scale

MOST_ROWS = 1000  # of a table that a page shows as points


def pack_programme(diagram: MotionDiagram) -> dict[str, Any]:
    """Plain dictionary of a diagram; angles and lifts in SI, `cycle` and `lift` with the unit and the factor in which people read them."""
    cycle, lift = shown_scale("rad"), shown_scale(diagram.lift_unit)
    return {
        "list": diagram.key,
        "keys": diagram.keys._asdict(),
        "dwell": diagram.dwell,
        "laws": [{"name": choice.name, "parameters": dict(choice.parameters)} for choice in diagram.laws],
        "lawKeys": list(diagram.law_keys),
        "cycle": {"span": diagram.cycle, "unit": cycle.unit, "factor": cycle.factor, "label": diagram.cycle_label},
        "lift": {"unit": lift.unit, "factor": lift.factor, "angular": diagram.lift_unit == "rad"},
        "speed": float(diagram.speed) if math.isfinite(diagram.speed) else None,
        "origin": {"constant": float(diagram.origin.constant), "factors": dict(diagram.origin.factors)} if diagram.origin else None,
        "notes": list(diagram.notes),
        "checks": list(diagram.checks),
        "segments": [_packed(segment) for segment in diagram.segments],
    }


def _packed(segment: DiagramSegment) -> dict[str, Any]:
    rows = [] if segment.rows is None else segment.rows.tolist()
    return {
        "law": segment.law,
        "angle": float(segment.angle),
        "rise": float(segment.rise),
        "absolute": segment.absolute,
        "points": [[float(part) for part in point] for point in segment.points],
        "course": [floats(row) for row in segment.course],
        "rows": rows if len(rows) <= MOST_ROWS else [],
        "rowCount": len(rows),
        "file": segment.file,
        "fixed": None if segment.fixed is None else {**segment.fixed._asdict(), "border": dict(segment.fixed.border)},
    }
