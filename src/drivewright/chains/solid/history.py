"""Stress and life of a plate and of its pins, as solids in contact, through a history of loads.

Stress that belongs to a line contact alone is not in the elements and not searched: pins beside their rolling contact only, plates beside
their loaded flanks; what acts there is Hertz's (`chains.stress.rolling`).
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from drivewright._typing import Bools, Floats, Ints
from drivewright.chains.solid.joint import OUTWARD, STRIP
from drivewright.chains.solid.pitch import PlateAndPins, forces_at
from drivewright.chains.stress.life import life_of_history
from drivewright.chains.stress.plate import SIDES, Loads
from drivewright.fatigue.material import StrainLife
from drivewright.solids.contact.model import ContactState
from drivewright.solids.stresses import SkinStress, skin_stress
from drivewright.steps import note_step

BODIES = ("plate", *SIDES)
FACES = {"plate": "(?!flank|low).*", "left": "skin|high", "right": "skin|high"}  # whose stress is looked at
ROLLING = 5.0  # widths of the strip beside the rolling contact that are left out
LEAST = 0.4  # of the greatest stress: points below it are not looked at for life


class SolidHistory(NamedTuple):
    """A plate and its pins through n instants.

    states: of the contact; skins: {body: `SkinStress` of n fields}; searched: {body: points (m,) that belong to the search}.
    """

    solid: PlateAndPins
    states: tuple[ContactState, ...]
    skins: dict[str, SkinStress]
    searched: dict[str, Bools]

    def greatest(self, body: str) -> Floats:
        """Greatest von Mises stress (n,) [Pa] of a body's skin at each instant."""
        return self.skins[body].mises[:, self.searched[body]].max(axis=1)

    @property
    def seat_pressure(self) -> Floats:
        """Greatest pressure (n, 2) [Pa] on the left and on the right seat at each instant."""
        return np.array([[part.max(initial=0.0) for part in state.pressure] for state in self.states])

    def worst(self, body: str) -> tuple[float, int, int]:
        """(von Mises stress [Pa], instant, point) where a body's skin has it worst."""
        mises = np.where(self.searched[body], self.skins[body].mises, 0.0)
        instant, point = np.unravel_index(int(mises.argmax()), mises.shape)
        return float(mises[instant, point]), int(instant), int(point)


class SkinLife(NamedTuple):
    """points (m,): numbers of a skin's points; life (m,) in repeats of the history, inf without damage; damage (m,) a repeat."""

    points: Ints
    life: Floats
    damage: Floats

    @property
    def least(self) -> float:
        """Shortest life."""
        return float(self.life.min(initial=np.inf))


def solid_history(solid: PlateAndPins, loads: Loads, gaps: Sequence[Floats] | None = None) -> SolidHistory:
    """`SolidHistory` through the `Loads` of one plate; `gaps`: other ones [mm^3] of the seats' hats, as `with_fit` gives them.

    With friction, which remembers, it is the second time through.
    """
    states: list[ContactState] = []
    size = np.linalg.norm(np.asarray(loads.pins, float), axis=2)
    count = len(size)
    for instant in [*range(count)] * (2 if solid.fit.friction else 1):
        note_step("load steps", instant + 1, count)  # under a light load a contact may be too narrow for the elements: it does not count
        states.append(solid.model.solve(forces_at(solid, loads, instant), states[-1] if states else None, gaps, narrow=True))
    states = states[-count:]
    for number, instant in enumerate(size.argmax(axis=0)):
        solid.model.refuse_narrow(states[instant], number)
    skins = {}
    for name in BODIES:
        skins[name] = skin_stress(solid.model.bodies[name], [state.displacement(name) for state in states], FACES[name])
    return SolidHistory(solid, tuple(states), skins, {name: _searched(solid, name, skins[name]) for name in BODIES})


def skin_life(skin: SkinStress, searched: Bools, material: StrainLife, plane: str = "max-shear") -> SkinLife:
    """`SkinLife` where the history repeats, of points whose greatest stress is `LEAST` of the greatest or more.

    Where the elastic stress exceeds the cyclic yield stress, Neuber's rule gives the local stress and strain.
    """
    size = np.where(searched, skin.mises.max(axis=0), 0.0)
    points = np.flatnonzero(size >= LEAST * size.max())
    stress = np.ascontiguousarray(np.swapaxes(skin.stress[:, points], 0, 1))
    found = life_of_history(stress, size[points], material, plane)
    return SkinLife(points, found.life, found.damage)


def _searched(solid: PlateAndPins, body: str, skin: SkinStress) -> Bools:
    if body == "plate":
        return np.ones(len(skin.points), bool)
    contact = 0.5 * OUTWARD[body] * solid.plate.link.pitch
    away = np.hypot(skin.points[:, 0] - contact, skin.points[:, 1])
    return away > ROLLING * STRIP * solid.plate.seat("right").radius
