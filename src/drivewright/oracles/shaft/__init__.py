"""Shafts by routes that share no formula with the beam elements."""

from drivewright.oracles.shaft.independent_check import verify

__all__ = ["verify"]
