"""What the modes of a shaft are compared with: its plane of unit loads, and the masses of its stations on a massless shaft."""

from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.shafts.beam import FREEDOMS, Beam
from drivewright.shafts.vibration import Modes

NO_MOTION = 1e-12  # of the greatest 1/w^2: that of a station on a rigid bearing


class PlanarShape(NamedTuple):
    """Deflections (n,) of the nodes in the plane, "x" or "y", in which a mode moves most, the largest scaled to 1.

    alone: whether it moves in this plane only.
    """

    plane: str
    deflection: Floats
    alone: bool


def planar_shape(beam: Beam, shape: Floats) -> PlanarShape:
    """The `PlanarShape` of one of the `Modes.shapes` (size,)."""
    x, y = shape[0 : beam.size : FREEDOMS], shape[1 : beam.size : FREEDOMS]
    plane, way = ("x", x) if np.abs(x).max() > np.abs(y).max() else ("y", y)
    return PlanarShape(plane, way / way[np.argmax(np.abs(way))], not x.any())


def first_mode_along(modes: Modes, direction: Floats) -> int | None:
    """Number of the first mode that moves along a direction (x, y), where modes have planes of their own; None where none does."""
    for number, shape in enumerate(modes.shapes.T):
        nodes = shape[: len(shape) // FREEDOMS * FREEDOMS].reshape(-1, FREEDOMS)[:, :2]
        if np.sum((nodes @ direction) ** 2) > 0.5 * np.sum(nodes**2) or not nodes[:, 0].any():
            return number
    return None


def massless_frequencies(delta: Floats, masses: Floats) -> Floats:
    """Natural frequencies [Hz], rising, of masses (s,) [kg] above 0 at stations of a massless shaft.

    delta (s, s) [m/N]: its flexibility;  det(m^1/2 delta m^1/2 - 1/w^2 I) = 0; a station on a rigid bearing does not move and adds none.
    """
    root = np.sqrt(masses)
    inverse = np.linalg.eigvalsh(root[:, None] * delta * root)[::-1]
    return np.sqrt(1 / inverse[inverse > NO_MOTION * inverse[0]]) / (2 * np.pi)
