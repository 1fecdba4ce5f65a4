"""Gears in a row on a carrier, each pair non-circular: the planetary train of a transplanter."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from drivewright._typing import ArrayLike, Floats
from drivewright.errors import InputError
from drivewright.gears.rolling import RollingPair
from drivewright.numerics.jets import Jet, exp, variable
from drivewright.numerics.roots import bracketed_roots


@dataclass(frozen=True)
class GearTrain:
    """Sun, intermediate gears and planet on a carrier that is bent at each intermediate axis.

    pairs: the meshes from the sun outwards, each driver being the gear driven by the pair before.
    bends: for every intermediate axis the angle from the incoming arm's extension to the outgoing arm, counter-clockwise [rad].

    The carrier turns clockwise by t with the sun fixed.  Relative to the carrier the sun turns counter-clockwise by t, the next
    gear clockwise, and so on alternately.  A gear whose reference radius (the one in contact at angle 0 of its mesh as driver)
    points along the extension of the incoming arm has turned by its mesh's angle, so the next mesh sees that angle plus the bend,
    taken in the gear's own sense:  p_1 = E_1(t),  p_{k+1} = E_{k+1}(p_k +- bend_k), + for a gear that turns clockwise.
    """

    pairs: tuple[RollingPair, ...]
    bends: tuple[float, ...] = ()

    def __post_init__(self):
        if len(self.pairs) < 1 or len(self.bends) != len(self.pairs) - 1:
            raise InputError(
                f"GearTrain: {len(self.pairs)} pairs and {len(self.bends)} bends; a train of n pairs has a bend at each of its n - 1 "
                "intermediate axes."
            )

    def angles(self, t: ArrayLike) -> tuple[Jet, ...]:
        """Phases of sun, intermediate gears and planet relative to the carrier: jets in t, each in its own sense of rotation.

        The sun's is t itself, that of a driven gear the value of its mesh's driven angle.
        """
        return self._phases(t)[1]

    def planet(self, t: ArrayLike, zero: float = 0.0) -> Jet:
        """Rotation of the planet relative to the carrier since the carrier angle `zero` [rad], a jet in t.

        zero=0 counts from the start; zero=train.collinear_angles()[-1] from the later collinear position.
        """
        phase = self.angles(t)[-1]
        return phase - (self.phase if zero == 0.0 else float(self.angles(zero)[-1].d0))

    @cached_property
    def phase(self) -> float:
        """Phase of the planet at t = 0 [rad]: what `planet` leaves out."""
        return float(self.angles(0.0)[-1].d0)

    def rotation(self, t: ArrayLike) -> Jet:
        """Rotation of the last gear in the world [rad], counter-clockwise, a jet in t: relative to the carrier minus t."""
        sense = 1 if len(self.pairs) % 2 == 0 else -1
        return sense * self.planet(t) - variable(t)

    def directions(self, t: ArrayLike, start: float = 0.0) -> tuple[Floats, ...]:
        """World directions of the gears' reference radii [rad], shape of t; `start`: that of the sun's, towards the first arm at t = 0.

        A gear's reference radius points along the extension of its incoming arm at phase 0; the sun stands still.
        """
        carrier = start - np.asarray(t, dtype=float)
        arms = carrier[..., None] + np.concatenate([[0.0, 0.0], np.cumsum(self.bends)])
        senses = (-1) ** np.arange(len(self.pairs) + 1)
        phases = self.angles(t)
        driven = (arms[..., k] + senses[k] * phases[k].d0 for k in range(1, len(phases)))
        return (np.full(carrier.shape, start), *driven)

    def collinear_angles(self, samples: int = 721) -> Floats:
        """Carrier angles in [0, 2 pi) where the last two gears stand symmetrically: the angle of their mesh is 0 or pi.

        For ellipses both centres and both foci then lie on the line of the two axes.
        """
        grid = np.linspace(0, 2 * np.pi, samples)
        roots = bracketed_roots(lambda t: np.sin(self._phases(t)[0][-1].d0), grid)
        return roots[roots < 2 * np.pi * (1 - 1e-12)]

    def axes(self, t: ArrayLike, start: float = 0.0) -> tuple[Jet, ...]:
        """World positions of all axes, complex jets in t [m]: the sun at 0, the first arm at angle `start` for t = 0."""
        positions, direction = [0 * variable(t)], start - variable(t)
        for pair, bend in zip(self.pairs, (0.0, *self.bends), strict=True):
            direction = direction + bend
            positions.append(positions[-1] + pair.centre_distance * exp(1j * direction))
        return tuple(positions)

    def _phases(self, t):
        """(angle seen by each mesh, phase of each gear) as jets in t."""
        phase = t if isinstance(t, Jet) else variable(t)
        mesh_angles, phases = [], [phase]
        for k, (pair, bend) in enumerate(zip(self.pairs, (0.0, *self.bends), strict=True)):
            mesh_angles.append(phase + (bend if k % 2 else -bend))
            phase = pair.jet(mesh_angles[-1])
            phases.append(phase)
        return tuple(mesh_angles), tuple(phases)
