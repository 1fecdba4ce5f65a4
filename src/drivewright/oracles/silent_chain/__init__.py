"""Chain drives by independent routes: printed formulas, points of the teeth, an optimiser, other integrators, another engine.

chain_forces       forces of rolling joints and of teeth, once more from the geometry
exudyn_model       a chain drive in Exudyn
exudyn_rows        the running chain beside Exudyn's: centre distance, strand forces, a strand's first frequency
independent_check  all rows of `verify`
"""

from drivewright.oracles.silent_chain.independent_check import verify

__all__ = ["verify"]
