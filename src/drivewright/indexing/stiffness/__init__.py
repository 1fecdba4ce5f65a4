"""Torsional stiffness of a pin-wheel indexer: assembly, equilibrium, compliance budget, and the statics to compare it with."""

from drivewright.indexing.stiffness.result import GROUPS, TorsionalStiffness, take_up
from drivewright.indexing.stiffness.solve import solve

__all__ = ["GROUPS", "TorsionalStiffness", "solve", "take_up"]
