"""Chain drives by independent routes: printed formulas, points of the teeth, an optimiser, other integrators."""

from drivewright.oracles.silent_chain.independent_check import verify

__all__ = ["verify"]
