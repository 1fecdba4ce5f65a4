"""A drive at rest at every angle of its driver: unilateral contacts, elastic joints and teeth, pitches and tooth thickness as they are."""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.chains.explicit.stability import refuse_seats
from drivewright.chains.implicit.parts import ARC, GAP, TOOTH, assembled, at_rest, compile_model
from drivewright.chains.implicit.relax import relax, work_for
from drivewright.chains.model import ChainDrive, with_sprocket
from drivewright.errors import InputError, SolverError

_MOST = 1000
_TOLERANCE = 1e-11  # part of the joint stiffness times the pitch that a force may stay unbalanced by: what rounding leaves, and some


@dataclass(frozen=True, eq=False)
class Equilibrium:
    """Positions of rest at S even steps of the driver's angle, over whole teeth, the last end left out.

    plates (S, N, 3): mass centres and angles; bodies (S, B, 2): place on the slide and angle of sprockets, then guides;
    joint_force (S, N, 2): of the joint behind a plate, as it acts on the next one [N]; flank_force (S, N, 2): on the right and the left
    flank of a plate, or on the seat and the flank of its roller's gap [N]; residual: the largest force left unbalanced [N].
    """

    model: ChainDrive
    plates: Floats
    bodies: Floats
    joint_force: Floats
    flank_force: Floats
    residual: float

    @property
    def driver_angle(self) -> Floats:
        """(S,)  [rad]."""
        return self.bodies[:, self.model.driver, 1]

    @property
    def slide(self) -> int:
        """Number of the sprocket whose centre distance counts, see `ChainDrive.measured`."""
        return self.model.measured

    def _centre(self, number):
        sprocket = self.model.sprockets[number]
        centre = complex(*sprocket.centre)
        q = self.bodies[:, number, 0]
        return centre + (sprocket.slide.shift(centre, q) if sprocket.slide else 0.0 * q)

    @property
    def centre_distance(self) -> Floats:
        """Distance of the sliding sprocket from the driver (S,)  [m]."""
        return np.abs(self._centre(self.slide) - self._centre(self.model.driver))

    @property
    def mean(self) -> float:
        """Mean centre distance  [m]."""
        return float(np.mean(self.centre_distance))

    @property
    def fluctuation(self) -> float:
        """Largest less least centre distance  [m]."""
        return float(np.ptp(self.centre_distance))

    def transmission_error(self, number: int) -> Floats:
        """Angle of a sprocket less that of the driver times the ratio of teeth, its mean taken off (S,)  [rad]."""
        teeth = [s.tooth.teeth for s in self.model.sprockets]
        sense = -1.0 if self.model.sprockets[number].outside else 1.0
        error = self.bodies[:, number, 1] - sense * self.driver_angle * teeth[self.model.driver] / teeth[number]
        return error - np.mean(error)

    @property
    def tension(self) -> Floats:
        """(S, N) size of the joints' forces  [N]."""
        return np.hypot(self.joint_force[..., 0], self.joint_force[..., 1])

    @property
    def contacts(self) -> Floats:
        """(S,) number of flanks that touch."""
        return np.sum(self.flank_force > 0, axis=(1, 2))


class Compliance(NamedTuple):
    """Mean centre distance of the rigid drive and what its compliance adds  [m]; fluctuation of the rigid drive, estimated  [m]."""

    rigid_mean: float
    added: float
    rigid_fluctuation: float


def equilibrium(model: ChainDrive, positions: int = 48, teeth: int = 1, tolerance: float | None = None) -> Equilibrium:
    """The `Equilibrium` of a model at `positions` angles of the driver per tooth, over `teeth` of them in its sense of rotation.

    tolerance [N]: the largest force left unbalanced.  SolverError where a position does not come to rest, with those before it.
    """
    _refuse(model, positions, teeth)
    refuse_seats(model)
    parts = compile_model(_at_rest(model))
    work, state = work_for(parts), at_rest(*assembled(model)[:2])
    small = _TOLERANCE * model.chain.joint_stiffness * model.chain.link.pitch if tolerance is None else tolerance
    relax(_endless(parts), state, work, small, _MOST)  # flanks of any length: nothing is lost on the way from the assembly
    step, found, driver = _step(model, positions), [], model.driver
    for k in range(positions * teeth):
        residual, _ = relax(parts, state, work, small, _MOST)
        if not residual <= small:
            raise SolverError(_restless(model, k, positions, residual, small), partial=_result(model, found) if found else None)
        found.append((state.plates.copy(), state.bodies.copy(), parts.field.joints.copy(), _flanks(parts), residual))
        state = _continued(state, found)
        state.bodies[driver, 1] = found[0][1][driver, 1] + (k + 1) * step
    return _result(model, found)


def compliance_of(model: ChainDrive, positions: int = 24, factor: float = 8.0) -> Compliance:
    """The `Compliance` of a drive, from its equilibrium and that with all stiffnesses `factor` times higher.

    What contact and joints add is of first order in 1/k: rigid = (factor stiff - soft)/(factor - 1).
    """
    soft, stiff = equilibrium(model, positions), equilibrium(stiffened(model, factor), positions)
    rigid = stiff.mean + (stiff.mean - soft.mean) / (factor - 1)
    ripple = stiff.fluctuation + (stiff.fluctuation - soft.fluctuation) / (factor - 1)
    return Compliance(rigid, soft.mean - rigid, ripple)


def stiffened(model: ChainDrive, factor: float) -> ChainDrive:
    """The model with its joints, teeth and guides stiffer by a factor."""
    for number, sprocket in enumerate(model.sprockets):
        contact = replace(sprocket.contact, stiffness=factor * sprocket.contact.stiffness)
        model = with_sprocket(model, number, contact=contact)
    guides = tuple(replace(g, contact=replace(g.contact, stiffness=factor * g.contact.stiffness)) for g in model.guides)
    return replace(model, chain=replace(model.chain, joint_stiffness=factor * model.chain.joint_stiffness), guides=guides)


def _at_rest(model):
    """The model without rotational dampers: what does not turn is not damped."""
    return replace(model, sprockets=tuple(replace(each, damping=0.0) for each in model.sprockets))


def _endless(parts):
    """The same drive with flanks of any length."""
    bodies = parts.bodies.copy()
    bodies["low"][bodies["kind"] == TOOTH] = -np.inf
    bodies["low"][bodies["kind"] == GAP] = np.inf
    return parts._replace(bodies=bodies, chain=parts.chain._replace(deepest=-np.inf, highest=np.inf))


def _step(model, positions):
    """From one position to the next, in the sense of the drive, or as the plates are numbered."""
    sprocket = model.sprockets[model.driver]
    sense = np.sign(sprocket.drive.speed or sprocket.drive.start or -1.0)
    return sense * 2 * np.pi / (sprocket.tooth.teeth * positions)


def _continued(state, found):
    """A guess of the next position: on as before."""
    if len(found) < 2:
        return state
    return at_rest(2 * found[-1][0] - found[-2][0], 2 * found[-1][1] - found[-2][1])


def _flanks(parts):
    """(N, 2) forces on both flanks of every plate; guides left out."""
    forces, pairs = np.zeros((len(parts.half), 2)), parts.pairs[: parts.size[0]]
    teeth = pairs[parts.bodies["kind"][pairs["body"]] != ARC]
    forces[teeth["plate"]] = np.column_stack([teeth["right"], teeth["left"]])
    return forces


def _result(model, found):
    plates, bodies, joints, flanks, residual = zip(*found, strict=True)
    return Equilibrium(model, *map(np.array, (plates, bodies, joints, flanks)), residual=float(max(residual)))


def _restless(model, k, positions, residual, small):
    return (
        f"chain drive: at position {k} of {positions} per tooth a force of {residual:.3g} N remains unbalanced, more than {small:.3g} N. "
        "A plate may rest on the edge of a flank (raise tip_radius or toe), or the loads leave the chain slack (raise the slide's force)."
    )


def _refuse(model, positions, teeth):
    if not isinstance(model, ChainDrive):
        raise InputError(f"equilibrium: needs a ChainDrive, got {type(model).__name__}.")
    for name, value in (("positions", positions), ("teeth", teeth)):
        if isinstance(value, bool) or not isinstance(value, int | np.integer) or value < 1:
            raise InputError(f"equilibrium: {name} = {value!r}; it must be a whole number from 1 up.")
    free = [n for n, s in enumerate(model.sprockets, 1) if s.slide and not s.slide.force and not s.slide.stiffness]
    if free:
        raise InputError(f"equilibrium: the slide of sprocket {free[0]} has neither force nor stiffness; give one of them.")
