"""Cams, eccentric shafts and pin wheel of an indexer as solids, joined by the springs of the reduced model (extra `fe`).

bodies  every body of a pin-wheel indexer condensed to the loads on its interfaces, a `Substructure`
check   torsional stiffness of a pin-wheel indexer with its bodies as solids, beside that of the reduced model
meshes  meshes [mm] of cam, split shaft and pin wheel, second order, with named faces whose areas are checked
parts   measures that the solids of a pin-wheel indexer have and its reduced model does not; SI
"""

from drivewright.indexing.solid.assembly import SolidStiffness, solid_stiffness
from drivewright.indexing.solid.parts import CamBody, ShaftBody, Solids, WheelBody, usual_wheel

__all__ = ["CamBody", "ShaftBody", "SolidStiffness", "Solids", "WheelBody", "solid_stiffness", "usual_wheel"]
