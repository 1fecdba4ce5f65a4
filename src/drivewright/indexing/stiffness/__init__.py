"""Torsional stiffness of indexing drives: assembly, equilibrium, compliance budget, and the statics to compare it with.

layout, assembly: unknowns and equations of the drive train.  laws, rolling: force laws of contacts and bearings.
equilibrium, minimise, solve, loading: the loaded positions; newton: the same in compiled code.  result, tables, values: what comes out.
statics: loads by statics alone.
roller_contacts, roller_drive, roller_loading: the same for parallel, barrel and globoidal drives.
"""

from drivewright.indexing.stiffness.result import COMPLIANCE_GROUPS, TorsionalStiffness, WheelStiffness, take_up_play
from drivewright.indexing.stiffness.solve import solve_torsional_stiffness
from drivewright.indexing.stiffness.statics import (
    ShaftLengths,
    crank_loads,
    crank_loads_printed,
    gear_force,
    gear_force_printed,
    support_loads,
    support_loads_printed,
)

__all__ = [
    "COMPLIANCE_GROUPS",
    "ShaftLengths",
    "TorsionalStiffness",
    "WheelStiffness",
    "crank_loads",
    "crank_loads_printed",
    "gear_force",
    "gear_force_printed",
    "solve_torsional_stiffness",
    "support_loads",
    "support_loads_printed",
    "take_up_play",
]
