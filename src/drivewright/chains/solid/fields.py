"""Stress, pressure and life on plate and pins as `SurfaceFields`, at the worst and a few other instants of a history."""

from collections.abc import Mapping

import numpy as np

from drivewright._typing import Bools, Floats, Ints
from drivewright.chains.solid.history import BODIES, SkinLife, SolidHistory
from drivewright.chains.stress.plate import SIDES
from drivewright.solids.deformation import exaggeration_for
from drivewright.solids.elastic import MM
from drivewright.solids.stresses import SkinStress, skin_stress
from drivewright.surface_fields import ScalarField, Singles, SurfaceBody, SurfaceFields, kept_steps, single

STEPS = 8  # that are kept
DRAWN = 0.02  # of the plate's length: the largest displacement as drawn
LABELS = {"plate": "Plate", "left": "Left pin", "right": "Right pin"}
UNSEARCHED = {"plate": "flank.*"}  # faces that belong to the picture, and not to the search of the greatest stress
BESIDE = "not evaluated next to a line contact, where the stress follows from Hertz"
LONGER = "longer than shown: no damage, or less than 40 % of the maximum stress"
NOTES = (
    "one run of the chain, the first; the values of the analysis are means over all its runs",
    "displacements are shown without the rigid-body motion of each body",
)
NEAR = 1e-6  # m: a corner of an element is on a seat


def solid_fields(history: SolidHistory, time: Floats, lives: Mapping[str, SkinLife]) -> SurfaceFields:
    """`SurfaceFields` "solid_stress" of a history at the instants `time` (s,) [s], with the lives of "plate", "left" and "right".

    The instants with the greatest stress of each body and with the greatest pressure are among those kept.  Displacements are relative to
    the mean of each body's.
    """
    worst = {name: history.worst(name)[1] for name in BODIES}
    steps = kept_steps(len(history.states), [*worst.values(), int(history.seat_pressure.max(axis=1).argmax())], STEPS)
    bodies = tuple(_body(history, name, steps, lives[name]) for name in BODIES)
    moved = np.concatenate([each.displacements.reshape(-1, 3) for each in bodies]).astype(float)
    scale = exaggeration_for(float(np.ptp(bodies[0].points, axis=0).max()), moved, DRAWN)
    labels = tuple(f"{1e3 * time[step]:.4g} ms" for step in steps)
    return SurfaceFields(
        "solid_stress", "Plate and pins (solid)", labels, int(np.searchsorted(steps, worst["plate"])), bodies, scale, NOTES
    )


def _body(history: SolidHistory, name: str, steps: Ints, life: SkinLife) -> SurfaceBody:
    skin = history.skins[name]
    rest = _unsearched(history, name, steps)
    stress = np.where(history.searched[name], skin.mises[steps], np.nan)
    lives_at = np.full(len(skin.points), np.inf)
    lives_at[life.points] = life.life
    fields = [
        ScalarField("mises", "Pa", "Von Mises stress", _with_rest(stress, rest, np.nan), missing=BESIDE),
        ScalarField("life", "-", "Life in revolutions of the chain", _with_rest(lives_at[None], rest, np.inf), log=True, missing=LONGER),
    ]
    if name == "plate":
        pressure = np.array([_pressure(history, skin, int(step)) for step in steps])
        fields.append(ScalarField("pressure", "Pa", "Contact pressure on the seats", _with_rest(pressure, rest, 0.0)))
    points, triangles, moved = skin.points, skin.parts, skin.displacement[steps]
    if rest is not None:
        triangles = np.concatenate([triangles, rest.parts + len(points)])
        points, moved = np.concatenate([points, rest.points]), np.concatenate([moved, rest.displacement], axis=1)
    return SurfaceBody(
        name,
        LABELS[name],
        points,
        triangles,
        single(moved - skin.displacement[steps].mean(axis=1, keepdims=True)),
        tuple(fields),
        mirrored=True,
    )


def _unsearched(history: SolidHistory, name: str, steps: Ints) -> SkinStress | None:
    """Skin of the faces that are shown without their stress."""
    if name not in UNSEARCHED:
        return None
    body = history.solid.model.bodies[name]
    return skin_stress(body, [history.states[step].displacement(name) for step in steps], UNSEARCHED[name])


def _with_rest(values: Floats, rest: SkinStress | None, other: float) -> Singles:
    """Values (s, n) with an `other` one on the faces that are not searched."""
    more = np.full((len(values), 0 if rest is None else len(rest.points)), other)
    return single(np.concatenate([values, more], axis=1))


def _pressure(history: SolidHistory, skin: SkinStress, step: int) -> Floats:
    """Contact pressure (n,) [Pa] on the plate's skin at an instant."""
    from scipy.spatial import KDTree

    found = np.zeros(len(skin.points))
    for number, side in enumerate(SIDES):
        seated = _on_seat(history, skin, side)
        tree = KDTree(history.solid.model.pairings[number].places * MM)
        distance, nearest = tree.query(skin.points[seated])
        found[seated] = np.where(distance < NEAR, history.states[step].pressure[number][nearest], 0.0)
    return found


def _on_seat(history: SolidHistory, skin: SkinStress, side: str) -> Bools:
    """Which points (n,) of the plate's skin belong to elements on a seat."""
    seat = history.solid.plate.seat(side)
    near = np.abs(np.hypot(*(skin.points[:, :2] - seat.center).T) - seat.radius) < NEAR
    found = np.zeros(len(near), bool)
    found[skin.parts[near[skin.parts].all(axis=1)]] = True
    return found
