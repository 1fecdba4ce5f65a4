"""Fields of an analysis on the deformed solids, for a viewer: corners of triangles with displacement and values at every load step."""

import base64
from pathlib import Path
from typing import Any

import numpy as np

from drivewright import registry, runner
from drivewright._typing import Ints
from drivewright.errors import InputError, UnknownName
from drivewright.registry import Analysis
from drivewright.report.pack import floats
from drivewright.result import Result
from drivewright.solids.engine import fe_module
from drivewright.solids.shading import surface_shape
from drivewright.steps import detailed
from drivewright.studio.design import Design
from drivewright.studio.jobs.progress import Progress
from drivewright.studio.kept_results import kept_result, result_of
from drivewright.surface_fields import ScalarField, SurfaceBody, SurfaceFields
from drivewright.view.palette import BARE, colour_stops
from drivewright.view.text import display_unit

CREASE = np.cos(np.radians(50))  # elements on a round surface are coarser than the facets of a drawing
SEAM = 1e-7  # m from the mirror plane


def fields(design: Design, progress: Progress, analysis: str = "", run: bool = False, kept: str = "") -> dict[str, Any]:
    """`packed_fields` of an analysis, with its name; {"analysis", "absent": True} where it has not run, unless it is to `run` now.

    kept: folder of the results that earlier runs have left.  UnknownName for an analysis without fields, MissingExtra without finite
    elements, InputError with the reason where the analysis is left out or fails.
    """
    spec = design.spec_on_screen()
    mechanism = registry.mechanism(spec.mechanism)
    known = {each.name: each for each in mechanism.analyses if each.fields}
    if analysis not in known:
        raise UnknownName("analysis with fields", analysis, known)
    folder = Path(kept) if kept else None
    found = kept_result(folder, spec.digest(), [analysis])
    if found is None and not run:
        return {"analysis": analysis, "absent": True}
    if found is None:
        fe_module("ngsolve", f"analysis '{analysis}'")  # what an extra brings is missed before anything has run
        default = [each.name for each in mechanism.analyses if each.default]
        with detailed(progress) as step:
            found = result_of(spec, [*default, analysis], folder, step, runner.build(spec))
    if analysis not in found.fields:
        raise InputError(_reason(known[analysis], found))
    return {"analysis": analysis, **packed_fields(found.fields[analysis])}


def _reason(analysis: Analysis[Any, Any], result: Result[Any]) -> str:
    """The finding that says why an analysis has no fields."""
    own = [finding for finding in result.findings if analysis.name in finding]
    return own[-1] if own else f"{analysis.name}: has no fields for this design"


def packed_fields(found: SurfaceFields) -> dict[str, Any]:
    """Plain dictionary of `SurfaceFields` for a viewer.

    {"name", "title", "steps", "worst", "scale", "notes", "size" [m], "colours": stops of the colour map as #rrggbb, "bare": the colour of
    what was not evaluated, "fields": [{"name", "label", "unit", "factor" from SI to that unit, "log", "missing"}],
    "bodies": [..]}.
    """
    packed = [_packed_body(body) for body in found.bodies]
    low, high = (end([end(body.deformed(0, 0.0), axis=0) for body in found.bodies], axis=0) for end in (np.min, np.max))
    return {
        "name": found.name,
        "title": found.title,
        "steps": list(found.steps),
        "worst": found.worst,
        "scale": float(found.scale),
        "notes": list(found.notes),
        "size": float(np.linalg.norm(high - low)),
        "colours": colour_stops(),
        "bare": BARE,
        "fields": _field_infos(found),
        "bodies": packed,
    }


def _packed_body(body: SurfaceBody) -> dict[str, Any]:
    """{"name", "label", "triangles", "mirrored", "hidden", "positions", "normals", "edges", "displacements", "places", "values", "ranges"}.

    Arrays are base64, three corners a triangle; edges: two numbers of corners each; displacements: one array a step; places:
    [x, y, z, turn] a step, or None; values: {field: one array a step, or one for all}; ranges: {field: [least, greatest] of all steps}.
    """
    shape = surface_shape(body.points, body.triangles, CREASE)
    rows = body.triangles[shape.proper].ravel()
    return {
        "name": body.name,
        "label": body.label,
        "triangles": len(rows) // 3,
        "mirrored": body.mirrored,
        "hidden": body.hidden,
        "positions": floats(body.points[rows]),
        "normals": floats(shape.normals),
        "edges": _numbers(_corner_of(body, rows)[_without_seam(body, shape.edges)]),
        "displacements": [floats(step[rows]) for step in body.displacements],
        "places": None if body.places is None else body.places.tolist(),
        "values": {field.name: [floats(step[rows]) for step in field.values] for field in body.fields},
        "ranges": {field.name: list(field.range) for field in body.fields if np.isfinite(field.range[0])},
    }


def _without_seam(body: SurfaceBody, edges: Ints) -> Ints:
    """Edges (e, 2) of a body but those where its mirror image joins it."""
    return edges[np.abs(body.points[edges, 2]).max(axis=1) > SEAM] if body.mirrored else edges


def _corner_of(body: SurfaceBody, rows: Ints) -> Ints:
    """For every point (n,) the number of a corner that is there."""
    _, same = np.unique(body.points.round(9), axis=0, return_inverse=True)
    same = np.ravel(same)
    corner = np.zeros(same.max() + 1, int)
    corner[same[rows]] = np.arange(len(rows))
    return corner[same]


def _numbers(values: Ints) -> str:
    """base64 of whole numbers as uint32."""
    return base64.b64encode(np.ascontiguousarray(values, "<u4").tobytes()).decode()


def _field_infos(found: SurfaceFields) -> list[dict[str, Any]]:
    """What is alike of each field on all bodies, in the order in which the bodies name them."""
    by_name: dict[str, list[ScalarField]] = {}
    for body in found.bodies:
        for field in body.fields:
            by_name.setdefault(field.name, []).append(field)
    return [_field_info(alike) for alike in by_name.values() if any(np.isfinite(field.range[0]) for field in alike)]


def _field_info(alike: list[ScalarField]) -> dict[str, Any]:
    first = alike[0]
    factor, unit = display_unit(first.unit)
    return {
        "name": first.name,
        "label": first.label,
        "unit": unit,
        "factor": factor,
        "log": first.log,
        "missing": next((field.missing for field in alike if not np.isfinite(field.values).all()), ""),
    }
