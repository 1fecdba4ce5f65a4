"""The cam by a route that shares no formula with its analyses."""

from drivewright.oracles.cam.laid_follower import verify

__all__ = ["verify"]
