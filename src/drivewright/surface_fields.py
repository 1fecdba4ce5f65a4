"""Scalar fields on the deformed surfaces of solids: what a finite-element analysis hands to figures, files and viewers.

Plain arrays in SI.  A value that is nan was not evaluated there, for instance beside a line contact that the elements do not resolve.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from drivewright._typing import Floats, Ints

Singles = NDArray[np.float32]  # seven digits are more than a picture shows, in half the space


class ScalarField(NamedTuple):
    """A quantity on the n points of a surface: values (s, n) at each of s load steps, or (1, n) where it is the same at all of them.

    `label` is the short name for people, `log` says that it is shown in powers of ten, `missing` why values are nan where some are.
    """

    name: str
    unit: str
    label: str
    values: Singles
    log: bool = False
    missing: str = ""

    def at(self, step: int) -> Singles:
        """Values (n,) at a load step."""
        return self.values[min(step, len(self.values) - 1)]

    @property
    def range(self) -> tuple[float, float]:
        """Least and greatest finite value of all steps; (nan, nan) where there is none."""
        finite = self.values[np.isfinite(self.values)]
        return (float(finite.min()), float(finite.max())) if len(finite) else (np.nan, np.nan)


class SurfaceBody(NamedTuple):
    """The surface of one solid through s load steps.

    points (n, 3) [m] in the body's own frame, triangles (m, 3) of them, counter-clockwise from outside; displacements (s, n, 3) [m].
    places (s, 4): x, y, z [m] of the own frame's origin and its turn [rad] about z at each step; None where the frame stands still.
    mirrored: the body is twice as large, its other half the mirror image in the plane z = 0 of its own frame.  hidden: a viewer leaves it
    out at first, for it covers the others.
    """

    name: str
    label: str
    points: Floats
    triangles: Ints
    displacements: Singles
    fields: tuple[ScalarField, ...]
    places: Floats | None = None
    mirrored: bool = False
    hidden: bool = False

    def field(self, name: str) -> ScalarField | None:
        """The field of a name, None where the body has none of it."""
        return next((each for each in self.fields if each.name == name), None)

    def deformed(self, step: int, scale: float = 1.0) -> Floats:
        """Points (n, 3) [m] at a load step: R(turn) (points + scale displacement) + origin."""
        points = self.points + scale * self.displacements[step].astype(float)
        if self.places is None:
            return points
        *origin, turn = self.places[step]
        c, s = np.cos(turn), np.sin(turn)
        return points @ np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]]) + origin


class SurfaceFields(NamedTuple):
    """Bodies with their fields through load steps, which `steps` labels; `worst` is the number of the one to look at first.

    scale: how many times as large displacements are drawn unless somebody wants another; notes: what a reader must know of the fields.
    """

    name: str
    title: str
    steps: tuple[str, ...]
    worst: int
    bodies: tuple[SurfaceBody, ...]
    scale: float = 1.0
    notes: tuple[str, ...] = ()

    def arrays(self) -> dict[str, NDArray[np.generic]]:
        """Everything as named arrays, for a file: BODY.points, BODY.triangles, BODY.displacements, BODY.FIELD and steps."""
        found: dict[str, NDArray[np.generic]] = {"steps": np.array(self.steps)}
        for body in self.bodies:
            found |= {f"{body.name}.{name}": getattr(body, name) for name in ("points", "triangles", "displacements")}
            found |= {f"{body.name}.{field.name}": field.values for field in body.fields}
            if body.places is not None:
                found[f"{body.name}.places"] = body.places
        return found


def single(values: Floats) -> Singles:
    """An array in single precision."""
    return np.asarray(values, np.float32)


def kept_steps(count: int, first: Sequence[int], most: int) -> Ints:
    """Numbers of those of `count` load steps that are kept: of `first`, then others spread evenly over all, `most` in total; sorted."""
    chosen = list(dict.fromkeys(int(step) for step in first))[:most]
    spread = np.linspace(0, count - 1, most - len(chosen) + 2).round().astype(int)[1:-1]
    return np.array(sorted({*chosen, *(int(step) for step in spread)}), int)
