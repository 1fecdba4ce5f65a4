"""Linkages by routes that share no equation with the multibody kernel."""

from drivewright.oracles.linkage.independent_check import verify

__all__ = ["verify"]
