"""Indexing drives by routes that share no equation with `indexing`: polygons, swept rollers, the instant centre, finite elements."""

from drivewright.oracles.indexer.independent_check import verify

__all__ = ["verify"]
