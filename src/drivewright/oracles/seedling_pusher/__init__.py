"""The seedling pusher by routes that share no formula with its analyses."""

from drivewright.oracles.seedling_pusher.rows import verify

__all__ = ["verify"]
