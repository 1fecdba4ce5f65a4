"""Torsional stiffness of a pin-wheel indexer: assembly, equilibrium, compliance budget, and the statics to compare it with."""

from drivewright.indexing.stiffness.result import COMPLIANCE_GROUPS, TorsionalStiffness, take_up_play
from drivewright.indexing.stiffness.solve import solve_torsional_stiffness

__all__ = ["COMPLIANCE_GROUPS", "TorsionalStiffness", "solve_torsional_stiffness", "take_up_play"]
