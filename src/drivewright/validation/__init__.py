"""Published sources, one file each: the world's numbers beside ours.

A plug-in adds a `Source` of its own under the entry point group `drivewright.validation`.
"""

from drivewright import plugins
from drivewright.errors import InputError, UnknownName
from drivewright.validation import (
    clearance_joints,
    elliptic_gears,
    folding_linkage,
    hyvo_paper,
    indexer_paper,
    modified_sine_help,
    motion_factors,
    pusher_paper,
    shaft_paper,
)
from drivewright.validation.page import page
from drivewright.validation.source import AGREES, EXPLAINED, KINDS, OPEN, Explanation, Printed, Row, Source, rounded

OURS = (
    pusher_paper.source,
    motion_factors.source,
    modified_sine_help.source,
    elliptic_gears.source,
    folding_linkage.source,
    clearance_joints.source,
    shaft_paper.source,
    indexer_paper.source,
    hyvo_paper.source,
)

__all__ = ["AGREES", "EXPLAINED", "Explanation", "KINDS", "OPEN", "Printed", "Row", "Source", "page", "rounded", "sources"]


def sources(name: str | None = None) -> tuple[Source, ...]:
    """All sources, ours first, or the one of that name; UnknownName where there is none."""
    group = "drivewright.validation"
    known = {}
    for source in (*OURS, *(plugins.load(group, point) for point in sorted(plugins.installed(group)))):
        if source.name in known:
            raise InputError(f"two validation sources are called {source.name!r}; rename or uninstall one of the plug-ins of {group}")
        known[source.name] = source
    if name is not None and name not in known:
        raise UnknownName("validation source", name, known)
    return tuple(known.values()) if name is None else (known[name],)
