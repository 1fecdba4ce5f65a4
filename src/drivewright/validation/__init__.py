"""Published sources, one file each: published numbers beside ours.

A plug-in adds a `Source` of its own under the entry point group `drivewright.validation`.

clearance_joints    joints with play against other computations
elliptic_gears      elliptic gears pivoted at a focus, and the planetary train made of them
folding_contact     impact loads of the knife-folding four-bar with dry or lubricated contact in its pins
folding_linkage     the knife-folding four-bar with play of Yuan, Liu and Wang 2011
geneva_tables       peaks of external Geneva drives as handbooks tabulate them, and in closed form
hyvo_model          the Hy-Vo chain as printed: data, Table 2, and its drives at rest, rigid and elastic
hyvo_paper          the Hy-Vo chain with a small rolling radius of An, Cheng, Li and Xu
hyvo_running        the Hy-Vo paper's running chains, stress and life of their plates, computed in studies
hyvo_strength       stress and life of pins and plates of the Hy-Vo chain: section 6 of the paper
indexer_paper       the inner-translation indexing cam of Liu, Zhai, Li and Guo
modified_sine_help  help page of a commercial cam program: factors of the modified sine
motion_factors      factors of the classical motion laws as handbooks print them, and in closed form
page                the sources as one page of Markdown, for the documentation
pusher_paper        the conjugate-cam seedling pusher of Chen et al
rotors              whirl and critical speeds of two rotors of the literature
shaft_bearings      rolling bearings of the shaft paper: which kind is the stiffest, and how stiff a 61804 is
shaft_equations     equations (1) to (21) of the shaft paper, each evaluated for its data, beside the beam of the presets
shaft_model         the shafts of the pipe-lining machine as printed: data of Table 1, and what runs of the presets give for them
shaft_paper         the shafts of a pipe-lining machine of Li, Zhang and Chen
source              a published source: its numbers beside ours, each with a verdict that is computed
"""

from collections.abc import Callable, Iterable

from drivewright import plugins
from drivewright.errors import InputError, UnknownName
from drivewright.execution.executors import side_by_side
from drivewright.validation import (
    clearance_joints,
    elliptic_gears,
    folding_linkage,
    geneva_tables,
    hyvo_paper,
    indexer_paper,
    modified_sine_help,
    motion_factors,
    pusher_paper,
    rotors,
    shaft_paper,
)
from drivewright.validation.page import page
from drivewright.validation.source import (
    AGREES,
    BASES,
    CALIBRATED,
    COMPUTED,
    EXPLAINED,
    KINDS,
    NOT_COMPARED,
    OPEN,
    PRINT_ONLY,
    VERDICTS,
    Explanation,
    Printed,
    Row,
    Source,
    about,
    best_verdicts,
    counts,
    evaluated,
    implied,
    rounded,
)

OURS = (
    pusher_paper.source,
    motion_factors.source,
    geneva_tables.source,
    modified_sine_help.source,
    elliptic_gears.source,
    folding_linkage.source,
    clearance_joints.source,
    shaft_paper.source,
    rotors.two_disc_rotor,
    rotors.nelson_mcvaugh,
    indexer_paper.source,
    hyvo_paper.source,
)

__all__ = [
    "AGREES",
    "BASES",
    "CALIBRATED",
    "COMPUTED",
    "EXPLAINED",
    "Explanation",
    "KINDS",
    "NOT_COMPARED",
    "OPEN",
    "PRINT_ONLY",
    "Printed",
    "Row",
    "Source",
    "VERDICTS",
    "about",
    "best_verdicts",
    "counts",
    "evaluated",
    "implied",
    "page",
    "rounded",
    "rows_of",
    "sources",
]


def rows_of(
    chosen: Iterable[Source], progress: Callable[[int, int, str], object] = lambda done, total, name: None
) -> dict[str, tuple[Row, ...]]:
    """{name: rows} of sources, computed side by side; `progress` is called with (done, total, sources that are computed)."""
    named = {source.name: source for source in chosen}
    if len(named) == 1:
        return {name: source.rows() for name, source in named.items()}
    names, found, running = list(named), dict[str, tuple[Row, ...]](), list[str]()

    def tell():
        progress(len(found), len(names), ", ".join(running))

    def begun(index):
        running.append(names[index])
        tell()

    for index, rows in side_by_side(_rows_of, [(name,) for name in names], begun=begun):
        found[names[index]] = rows
        running.remove(names[index])
        tell()
    return found


def _rows_of(name: str) -> tuple[Row, ...]:
    """In a process of its own; a source of a plug-in can be found there and not be sent."""
    return sources(name)[0].rows()


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
