"""The assembly as triangles for a viewer, and the analyses whose fields it can show."""

from typing import Any

from drivewright import registry, runner
from drivewright.errors import InputError
from drivewright.report.solids import pack_solids, solid_surfaces
from drivewright.studio.design import Design
from drivewright.studio.jobs.progress import Progress


def solid(design: Design, progress: Progress) -> dict[str, Any]:
    """`pack_solids` of the design with "analyses": [{"name", "meaning", "missing"}] whose fields a viewer can show.

    InputError where the drive has no solids; MissingExtra where a part needs the CAD kernel.
    """
    spec = design.spec()
    mechanism = registry.mechanism(spec.mechanism)
    model = runner.build(spec)
    parts = tuple(mechanism.parts(model)) if mechanism.parts else ()
    if not parts:
        raise InputError(f"{mechanism.kind} has no solids to show")
    scene = mechanism.scene(model) if mechanism.scene else None
    analyses = [{"name": a.name, "meaning": a.meaning, "missing": a.missing(spec)} for a in mechanism.analyses if a.fields]
    return {**pack_solids(solid_surfaces(parts, progress), scene), "analyses": analyses}
