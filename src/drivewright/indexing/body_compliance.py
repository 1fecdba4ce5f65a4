"""Compliance of cam, pin and wheel under one contact alone, for a lumped model whose bodies are elastic."""

from typing import NamedTuple

import numpy as np

from drivewright._typing import Complexes, Floats, Ints

SAME_FLANK = 0.3  # cosine between the normals of a contact and of a node that may speak for it
NEAREST = 2  # nodes between which is interpolated


class BodyCompliance(NamedTuple):
    """Own compliance of a contact [m/N]: that of a cam at nodes of its profile, and that of a pin along and across its radius.

    points, normals (n,): of the nodes, complex, seen from the cam [m]; cams (c, n): of every cam, its bearing seats held, along the normal;
    pins (c, 2, 2): of a pin at the height of every cam, the wheel's output held; what other contacts do to it is left out.
    """

    pin_radius: float
    points: Complexes
    normals: Complexes
    cams: Floats
    pins: Floats

    def at(self, cam: int, seen: Complexes, centre: Complexes, normal: Complexes, gap: Floats) -> Floats:
        """(k,) of contacts of a cam: centre of the pin as seen from the cam and from the wheel's axis, normal, complex; gap [m]."""
        nodes, share = self._between(seen - (self.pin_radius + gap) * normal, normal)
        local = normal * np.conj(centre) / np.abs(centre)
        along = np.stack([local.real, local.imag], axis=-1)
        own = np.sum(share * self.cams[cam][nodes], axis=-1)
        return np.asarray(own + np.einsum("ki,ij,kj->k", along, self.pins[cam], along), dtype=float)

    def _between(self, point: Complexes, normal: Complexes) -> tuple[Ints, Floats]:
        """(nodes (k, 2), shares (k, 2)): the two nearest on the same flank, by their distances."""
        away = np.abs(point[:, None] - self.points)
        facing = np.real(np.conj(normal)[:, None] * self.normals)
        nodes = np.argsort(np.where(facing > SAME_FLANK, away, np.inf), axis=1)[:, :NEAREST]
        nearness = 1 / (np.take_along_axis(away, nodes, axis=1) + 1e-12)
        return nodes, nearness / nearness.sum(axis=1, keepdims=True)
