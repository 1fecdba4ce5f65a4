"""Cams, eccentric shafts and pin wheel of an indexer as solids, joined by the springs of the reduced model (extra `fe`)."""

from drivewright.indexing.solid.check import SolidStiffness, solid_stiffness, surface_table
from drivewright.indexing.solid.parts import CamBody, ShaftBody, Solids, WheelBody, usual_wheel

__all__ = ["CamBody", "ShaftBody", "SolidStiffness", "Solids", "WheelBody", "solid_stiffness", "surface_table", "usual_wheel"]
