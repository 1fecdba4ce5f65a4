"""Cams, eccentric shafts and pin wheel of an indexer as solids in contact, beside the reduced model (extra `fe`).

assembly      torsional stiffness of the assembly: contact of pins, bearings and gears, beside the reduced model
bodies        every body of a pin-wheel indexer condensed to the loads on its interfaces, a `Substructure`
condensation  all bodies condensed for all positions at once
correction    elastic bodies as an option of the lumped model
fields        von Mises stress on the deformed bodies, for a viewer and for figures
meshes        meshes [mm] of cam, split shaft and pin wheel, second order, with named faces whose areas are checked
parts         measures that the solids of a pin-wheel indexer have and its reduced model does not; SI
springs       the springs between the bodies at one position, with the laws of the reduced model
surfaces      surfaces of the solids under load, for pictures
tables        the assembly as tables and plots
"""

from drivewright.indexing.solid.assembly import SolidAssembly, SolidStiffness, condense_assembly, load_assembly, solid_stiffness
from drivewright.indexing.solid.parts import CamBody, ShaftBody, Solids, WheelBody, seated, usual_wheel
from drivewright.indexing.solid.tables import surface_table

__all__ = [
    "CamBody",
    "ShaftBody",
    "SolidAssembly",
    "SolidStiffness",
    "Solids",
    "WheelBody",
    "condense_assembly",
    "load_assembly",
    "seated",
    "solid_stiffness",
    "surface_table",
    "usual_wheel",
]
