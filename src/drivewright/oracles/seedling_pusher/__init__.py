"""The seedling pusher by routes that share no formula with its analyses.

exudyn_model   the cam pair as a multibody model in Exudyn
multibody_run  what a multibody run of the cam pair gives
rolled_motion  train, tip and rollers of a pusher by rolling and by construction
rows           the pusher once more, by routes that share no formula with the analyses
"""

from drivewright.oracles.seedling_pusher.rows import multibody_run, verify

__all__ = ["multibody_run", "verify"]
