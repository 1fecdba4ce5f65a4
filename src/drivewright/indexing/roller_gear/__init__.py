"""Roller-gear indexers, barrel and globoidal: flanks of the cam, trimming, curvature, contact stress, play, views and solids."""

from drivewright.indexing.roller_gear.design import RollerGear, barrel, globoidal
from drivewright.indexing.roller_gear.envelope import FlankContact, flank_contact
from drivewright.indexing.roller_gear.flanks import FLANKS, CamFlanks, compute_flanks, find_trim_edges
from drivewright.indexing.roller_gear.play import find_turret_play
from drivewright.indexing.roller_gear.solid import cam_part, turret_part
from drivewright.indexing.roller_gear.stress import RollerLoads, compute_roller_loads
from drivewright.indexing.roller_gear.views import DevelopedSurface, axial_section, develop_surface, developed_roller_centres

__all__ = [
    "FLANKS",
    "FlankContact",
    "DevelopedSurface",
    "CamFlanks",
    "RollerLoads",
    "RollerGear",
    "barrel",
    "cam_part",
    "developed_roller_centres",
    "flank_contact",
    "develop_surface",
    "compute_flanks",
    "globoidal",
    "find_turret_play",
    "compute_roller_loads",
    "axial_section",
    "find_trim_edges",
    "turret_part",
]
