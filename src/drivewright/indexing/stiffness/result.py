"""The result of `solve_torsional_stiffness`, and how it is read off the equilibrium."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any, TypeVar

import numpy as np

from drivewright._typing import Bools, Complexes, Floats, Ints
from drivewright.indexing.drivetrain import SIDES, Drivetrain, GearMesh
from drivewright.indexing.stiffness.assembly import DrivetrainAssembly, flank_directions
from drivewright.indexing.stiffness.equilibrium import EquilibriumState
from drivewright.indexing.stiffness.layout import OUT

COMPLIANCE_GROUPS = ("pin", "crank", "support", "housing", "bending", "torsion", "gear", "wheel")
ROTATION_LIMIT = 0.1  # rad: beyond it the contacts are others than those given
StiffnessT = TypeVar("StiffnessT", bound="WheelStiffness")
CARRIED, FREE, RIGID, FAR, UNSETTLED = "carried", "free", "rigid", "far", "unsettled"
REASONS = {
    CARRIED: "",
    FREE: "no contact without a gap resists the torque, so the wheel turns freely first; check the play",
    RIGID: "every part that carries the torque is rigid; give one of them a stiffness",
    FAR: f"the wheel turns by more than {np.degrees(ROTATION_LIMIT):.3g}°, where other contacts act: the moment arms are near zero, "
    "or the torque is more than the parts carry; check the play beyond these contacts, or take less torque or stiffer parts",
    UNSETTLED: "no equilibrium was found; check the clearances, and whether the torque is far more than the parts carry",
}


@dataclass(frozen=True, eq=False)
class WheelStiffness:
    """A wheel under `torque` [N m] with the input locked, at p positions; where `outcome` is not "carried" numbers are nan.

    rotation [rad] of the output; secant = torque/rotation and tangent [N m/rad]; pin_forces [N]: one array a position, of the cams on the
    pins of its contacts; shares: compliance [rad/(N m)] of each group of parts (p,), sum of force times displacement over torque^2: they
    add up to 1/secant; steps: of Newton's method.
    """

    theta: Floats
    torque: float
    model: str
    outcome: tuple[str, ...]
    rotation: Floats
    tangent: Floats
    pin_forces: tuple[Floats, ...]
    shares: dict[str, Floats]
    steps: int

    @property
    def secant(self) -> Floats:
        """T/phi [N m/rad]."""
        return self.torque / self.rotation

    @property
    def carried(self) -> Bools:
        """(p,): whether the torque is carried."""
        return np.array([each == CARRIED for each in self.outcome], dtype=bool)

    @property
    def reasons(self) -> tuple[str, ...]:
        """Why a position has no stiffness, "" where it has one."""
        return tuple(REASONS[each] for each in self.outcome)


@dataclass(frozen=True, eq=False)
class TorsionalStiffness(WheelStiffness):
    """The `WheelStiffness` of a wheel with cams on cranks, shares of each of COMPLIANCE_GROUPS.

    Forces [N] in the plane are complex.  pin_forces: (cams, k) of the cam on the pins of its k `CamContacts` along their normals;
    crank_forces (p, 2, cams): of the cams on the crank pins of either shaft; support_forces (p, 2, 2): of either shaft on its front and
    rear support; gear_forces (p, 2): of the input gear on either split gear, gear_torques [N m] about its axis (without a gear a couple
    holds the shaft); wheel_forces (p,): of the wheel on its bearing.
    """

    crank_forces: Complexes
    support_forces: Complexes
    gear_forces: Complexes
    gear_torques: Floats
    wheel_forces: Complexes


def collect_result(
    drive: Drivetrain,
    theta: Floats,
    torque: float,
    model: str,
    kept: Sequence[Bools],
    assembly: DrivetrainAssembly,
    state: EquilibriumState,
    here: Ints,
    cams: int,
) -> TorsionalStiffness:
    """The `TorsionalStiffness` at all positions from the state of those that may carry (`here`)."""
    rotation = state.q[:, OUT] / assembly.lever
    outcome = judge_outcomes(len(theta), here, state, rotation, assembly.lever)
    good = outcome == CARRIED
    spread = spread_over(len(theta), good, here)
    gear_forces, gear_torques = _gears(drive.gear, state)
    return TorsionalStiffness(
        theta,
        torque,
        model,
        tuple(outcome),
        spread(rotation),
        spread(1 / np.where(good[here], state.compliance, np.nan)),
        _pin_forces(state, cams, kept, here, good),
        {name: spread(share) for name, share in compliance_shares(state, torque).items()},
        state.steps,
        spread(_vectors(state, "crank").reshape(len(here), 2, cams)),
        spread(_vectors(state, "support").reshape(len(here), 2, 2)),
        spread(gear_forces),
        spread(gear_torques),
        spread(_vectors(state, "wheel")[:, 0]),
    )


def judge_outcomes(count: int, here: Ints, state: EquilibriumState, rotation: Floats, lever: float) -> Ints:
    """(count,) outcomes from the state of the positions `here`, whose output has turned by `rotation` [rad]; all others are free."""
    outcome = np.full(count, FREE, dtype=object)
    outcome[here] = np.where(state.converged, CARRIED, UNSETTLED)
    outcome[here[~state.deforms]] = RIGID
    outcome[here[(np.abs(rotation) > ROTATION_LIMIT) | (np.abs(state.q).max(axis=1) > lever)]] = FAR
    return outcome


def spread_over(count: int, good: Bools, here: Ints) -> Callable[[Any], Any]:
    """What spreads values of the positions `here` over all `count`, nan where a position is not `good` (count,)."""

    def spread(values):
        whole = np.full((count, *values.shape[1:]), np.nan, dtype=values.dtype)
        whole[good] = values[good[here]]
        return whole

    return spread


def take_up_play(first: StiffnessT, after: StiffnessT) -> StiffnessT:
    """`first`, with the positions where the wheel turns freely taken from `after`, the same drive with the wheel turned by its play.

    Rotations there count from the turned wheel, so that the play adds to them and the secant is that of the loaded drive alone.
    """
    new = np.array([each == FREE for each in first.outcome], dtype=bool)

    def chosen(a, b):
        return np.where(new.reshape(len(new), *[1] * (a.ndim - 1)), b, a)

    arrays = [each.name for each in fields(first) if isinstance(getattr(first, each.name), np.ndarray) and each.name != "theta"]
    return replace(
        first,
        outcome=tuple(np.where(new, after.outcome, first.outcome)),
        pin_forces=tuple(b if n else a for n, a, b in zip(new, first.pin_forces, after.pin_forces, strict=True)),
        shares={name: chosen(share, after.shares[name]) for name, share in first.shares.items()},
        steps=first.steps + after.steps,
        **{name: chosen(getattr(first, name), getattr(after, name)) for name in arrays},
    )


def compliance_shares(state: EquilibriumState, torque: float) -> dict[str, Floats]:
    """Compliance [rad/(N m)] of each of GROUPS (p,): work of its parts, force times displacement, over torque^2."""
    total = {name: np.zeros(len(state.q)) for name in COMPLIANCE_GROUPS}
    for part in state.parts:
        total["wheel" if part.name == "output" else part.name] += part.work / torque**2
    return total


def _named(state: EquilibriumState, name: str) -> Floats:
    """(p, n): all components of the forces in the parts of a name."""
    return np.concatenate([part.flat for part in state.parts if part.name == name], axis=1)


def _vectors(state: EquilibriumState, name: str) -> Complexes:
    """(p, n) complex."""
    forces = _named(state, name)
    return forces[:, 0::2] + 1j * forces[:, 1::2]


def _gears(gear: GearMesh | None, state: EquilibriumState) -> tuple[Complexes, Floats]:
    """(forces (p, 2) complex, torques (p, 2)) of the input on either split shaft."""
    pressed = _named(state, "gear")
    if gear is None:
        return np.zeros_like(pressed, dtype=complex), -pressed
    pressed = pressed.reshape(len(pressed), 2, 2)
    forces = np.stack([pressed[:, side] @ flank_directions(gear, side) for side in (0, 1)], axis=1)
    return forces, np.imag(np.conj(-np.array(SIDES) * gear.pitch_radius) * forces)


def _pin_forces(state: EquilibriumState, cams: int, kept: Sequence[Bools], here: Ints, good: Bools) -> tuple[Floats, ...]:
    """One array (cams, contacts) a position; 0 for contacts that take no part, nan where the position does not carry."""
    found = [np.full((cams, len(keep)), np.nan) for keep in kept]
    forces = _named(state, "pin")
    forces = forces.reshape(len(here), cams, forces.shape[1] // cams)
    for row, i in enumerate(here):
        if good[i]:
            found[i][:] = 0.0
            found[i][:, kept[i]] = forces[row, :, : np.sum(kept[i])]
    return tuple(found)
