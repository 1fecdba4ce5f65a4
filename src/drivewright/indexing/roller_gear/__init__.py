"""Roller-gear indexers, barrel and globoidal: flanks of the cam, trimming, curvature, contact stress, play, views and solids."""

from drivewright.indexing.roller_gear.design import RollerGear, barrel, globoidal
from drivewright.indexing.roller_gear.envelope import Contact, contact
from drivewright.indexing.roller_gear.flanks import FLANKS, Flanks, flanks, trim_edges
from drivewright.indexing.roller_gear.play import play
from drivewright.indexing.roller_gear.solid import cam_part, turret_part
from drivewright.indexing.roller_gear.stress import Loads, roller_loads
from drivewright.indexing.roller_gear.views import Developed, centres, developed, section

__all__ = [
    "FLANKS",
    "Contact",
    "Developed",
    "Flanks",
    "Loads",
    "RollerGear",
    "barrel",
    "cam_part",
    "centres",
    "contact",
    "developed",
    "flanks",
    "globoidal",
    "play",
    "roller_loads",
    "section",
    "trim_edges",
    "turret_part",
]
