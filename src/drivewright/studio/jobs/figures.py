"""Figures for the page: those of a run that do not move with the cycle, in the colours of its theme."""

import re
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from drivewright import registry, runner
from drivewright.report.content import Picture, pictures, views
from drivewright.report.pack import pack_plots
from drivewright.steps import detailed
from drivewright.studio.design import Design
from drivewright.studio.jobs.progress import Progress
from drivewright.studio.kept_results import result_of
from drivewright.view.palette import ROLES, THEMES


def figures(
    design: Design, progress: Progress, theme: str = "light", analyses: Sequence[str] = (), everything: bool = False, kept: str = ""
) -> dict[str, Any]:
    """Every figure of a run that is not linked to the cycle: meshes, maps, drawings, plots over something else.

    {"figures": [{"name", "title", "svg"}], "requests": [{"name", "meaning", "missing"}] analyses that run on request and have not,
    "findings"}.  `analyses` names those to run besides the default ones; kept: folder of the results that earlier runs have left.
    """
    spec = design.spec_on_screen()
    mechanism, model = registry.mechanism(spec.mechanism), runner.build(spec)
    default = tuple(analysis.name for analysis in mechanism.analyses if analysis.default)
    with detailed(progress) as step:
        if everything:
            result = runner.run(spec, (), everything, step, model)
        else:
            result = result_of(spec, (*default, *analyses), Path(kept) if kept else None, step, model)
    done = result.provenance["analyses"]
    progress(len(done), len(done), "drawing")
    seen = views(result, model)
    unlinked = tuple(plot for plot in seen.plots if not _is_linked(result, seen.scene, plot))
    requests = [{"name": a.name, "meaning": a.meaning, "missing": a.missing(spec)} for a in mechanism.analyses if a.name not in done]
    return {
        "figures": drawn(pictures(result, seen._replace(scene=None, plots=unlinked)), theme),
        "requests": requests,
        "findings": [*result.findings, *seen.remarks],
    }


def _is_linked(result, scene, plot):
    """Whether the page draws a plot itself, with a cursor."""
    return scene is not None and pack_plots(result, scene, (plot,)) is not None


def drawn(figures: Iterable[Picture], theme: str) -> list[dict[str, str]]:
    """Pictures as plain dictionaries in the colours of a theme."""
    return [{"name": picture.name, "title": picture.title, "svg": themed(picture.svg, theme)} for picture in figures]


def themed(svg: str, theme: str) -> str:
    """An SVG of the light theme in another one: the colour of each role changes, those of maps stay."""
    if theme not in THEMES or theme == THEMES[0]:
        return svg
    place = THEMES.index(theme)
    other = {colours[0]: colours[place] for colours in ROLES.values()}
    return re.sub(r"#[0-9a-f]{6}\b", lambda match: other.get(match[0], match[0]), svg)
