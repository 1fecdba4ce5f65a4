"""The five papers that the package began with, figure by figure: `reproduce(name, folder)` writes a paper as a page from our own data.

document       a paper as a document: sections with claims, equations, printed numbers, figures
figures        figures of papers: curves told apart without colour, printed and stated values marked
formulas       equations as pictures
page           the page, its PDF and rows.json
parts          what a page is made of, computed part by part and kept
placing        where words in a chart find room: beside the curves, not upon them
views          a mechanism's scene and drawings as figures
shaft_paper    the shafts of a pipe-lining machine of Li, Zhang and Chen
indexer_paper  the inner-translation indexing cam of Liu, Zhai, Li and Guo
indexer_solids  the same as an assembly of solids in contact
hyvo_paper     the Hy-Vo chain with a small rolling radius of An, Cheng, Li and Xu
hyvo_solids    its plates and pins as solids in contact
folding_linkage  the knife-folding four-bar with play of Yuan, Liu and Wang
pusher_paper   the conjugate-cam seedling pusher of Chen et al.
"""

from importlib import import_module

from drivewright.errors import UnknownName
from drivewright.reproduction.document import Paper

NAMES = ("shaft-paper", "indexer-paper", "hyvo-paper", "folding-linkage", "pusher-paper")

__all__ = ["NAMES", "Paper", "papers"]


def papers(name: str | None = None) -> tuple[Paper, ...]:
    """All papers in their order, or the one of that name; UnknownName where there is none."""
    if name is not None and name not in NAMES:
        raise UnknownName("paper", name, NAMES)
    return tuple(import_module(f"drivewright.reproduction.{each.replace('-', '_')}").paper for each in (NAMES if name is None else (name,)))
