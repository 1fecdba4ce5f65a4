"""Roller-gear indexers, barrel and globoidal: flanks of the cam, trimming, curvature, contact stress, play, views and solids.

design    the numbers of a roller-gear indexer and what follows from them
envelope  the flanks of a roller-gear cam
scenes    a roller gear on screen, unrolled on the pitch surface of its cam
solid     solids of a roller-gear drive for CAD: the cam with its grooves, the turret with its rollers
tables    flanks, contacts and loads of a roller gear as tables and values
"""

from drivewright.indexing.roller_gear.design import RollerGear, barrel, globoidal
from drivewright.indexing.roller_gear.envelope import FlankContact, flank_contact
from drivewright.indexing.roller_gear.flanks import FLANKS, CamFlanks, compute_flanks, find_trim_edges
from drivewright.indexing.roller_gear.play import find_turret_play
from drivewright.indexing.roller_gear.scenes import roller_gear_scene
from drivewright.indexing.roller_gear.solid import cam_part, turret_part
from drivewright.indexing.roller_gear.stress import RollerLoads, compute_roller_loads
from drivewright.indexing.roller_gear.tables import contact_count_table, contact_map_array, flank_table, flank_values, roller_force_table
from drivewright.indexing.roller_gear.views import DevelopedSurface, axial_section, develop_surface, developed_roller_centres

__all__ = [
    "CamFlanks",
    "DevelopedSurface",
    "FLANKS",
    "FlankContact",
    "RollerGear",
    "RollerLoads",
    "axial_section",
    "barrel",
    "cam_part",
    "compute_flanks",
    "compute_roller_loads",
    "contact_count_table",
    "contact_map_array",
    "develop_surface",
    "developed_roller_centres",
    "find_trim_edges",
    "find_turret_play",
    "flank_contact",
    "flank_table",
    "flank_values",
    "globoidal",
    "roller_force_table",
    "roller_gear_scene",
    "turret_part",
]
