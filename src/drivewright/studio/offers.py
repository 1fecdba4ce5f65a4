"""What the page offers to begin with: the kinds of drives with their presets, tools, drawings and worked examples."""

from functools import cache
from typing import Any

from drivewright import registry
from drivewright.report.dimension_drawings import drawing_files
from drivewright.report.worked_examples import cards, preset_films, preset_pictures
from drivewright.studio import translations


def offered() -> list[dict[str, Any]]:
    """What the page offers to start with: kinds with their presets and worked examples, and which of these have pictures."""
    return _offered(tuple(registry.kinds()))


@cache
def _offered(kinds):
    return [
        {
            "kind": kind,
            "summary": registry.mechanism(kind).summary,
            "presets": presets(kind),
            "titles": translations.preset_titles(kind),
            "programme": registry.mechanism(kind).programme is not None,
            "pictures": sorted(preset_pictures(kind)),
            "tools": [tool._asdict() for tool in _tools(kind)],
            "start": _first_preset(kind),
            "films": sorted(preset_films(kind)),
            "drawings": [{"name": sheet.name, "title": sheet.title} for sheet in _drawn_sheets(kind)],
            "examples": [{"name": c.name, "title": c.title, "moving": c.moving is not None} for c in cards() if c.kind == kind],
        }
        for kind in kinds
    ]


def _tools(kind):
    construction = registry.mechanism(kind).construction
    return construction.tools if construction else ()


def _first_preset(kind):
    construction = registry.mechanism(kind).construction
    return construction.start if construction else ""


def _drawn_sheets(kind):
    return [sheet for sheet in registry.mechanism(kind).dimensions if sheet.name in drawing_files(kind)]


def presets(kind: str) -> list[str]:
    """Names of the presets: the one to build from by clicks first, then the default one."""
    start = _first_preset(kind)
    return sorted(registry.mechanism(kind).presets(), key=lambda name: (name != start, name != "default", name))
