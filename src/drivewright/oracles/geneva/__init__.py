"""The Geneva drive by routes that share no formula with its analyses."""

from drivewright.oracles.geneva.independent_check import verify

__all__ = ["verify"]
