"""Solids as a page gets them, as arrays again."""

import base64

import numpy as np


def vectors(text):
    """Points (n, 3) of base64 text."""
    return np.frombuffer(base64.b64decode(text), "<f4").reshape(-1, 3).astype(float)


def solid_corners(packed):
    """(corners of the triangles (3 m, 3), normals at them (3 m, 3), edges (e, 2, 3)) of a packed part."""
    points, normals = vectors(packed["positions"]), vectors(packed["normals"])
    kind = "<u2" if len(points) <= 65536 else "<u4"
    corners, edges = (np.frombuffer(base64.b64decode(packed[name]), kind) for name in ("corners", "edges"))
    return points[corners], normals[corners], points[edges].reshape(-1, 2, 3)
