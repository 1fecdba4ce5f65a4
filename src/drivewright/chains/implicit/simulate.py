"""Run a chain drive with implicit steps: the same model, start and `Motion` as the explicit run."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from drivewright.chains.explicit.assembly import Start
from drivewright.chains.explicit.measure import BODY, PLATE, PRESSED, ROW
from drivewright.chains.explicit.motion import Motion
from drivewright.chains.explicit.simulate import stepping
from drivewright.chains.explicit.stability import refuse_seats
from drivewright.chains.implicit.advance import WORKS, Run, drive_bodies, scheme, steps, tally
from drivewright.chains.implicit.energy import assemble
from drivewright.chains.implicit.parts import ARC, POWERS, State, assembled, compile_model
from drivewright.chains.implicit.relax import work_for
from drivewright.chains.implicit.touch import find_candidates
from drivewright.chains.model import ChainDrive
from drivewright.errors import InputError, SolverError

_WORKS = (*POWERS, "drive", "impulse x", "impulse y", "turning impulse")


@dataclass(frozen=True)
class Settings:
    """How to run.  The step [s] is shortened to fit a whole number of times between samples, these into a tooth of the driver.

    rho: by how much the highest frequencies shrink per step, 1 not at all, 0 at once; solved: Newton step [m] that is taken for the last;
    settle [s]: what statistics leave out at the start; tolerance [1/s]: energy drift over the stored energy that fails a run;
    joints whose tension is recorded; plate whose forces are.
    """

    step: float = 1e-5
    rho: float = 0.8
    solved: float = 1e-11
    settle: float = 0.0
    samples_per_tooth: int = 24
    tolerance: float = 1e-2
    joints: tuple[int, ...] = (0,)
    plate: int = 0


def simulate(
    model: ChainDrive,
    duration: float,
    settings: Settings = Settings(),
    *,
    begin: Start | None = None,
    progress: Callable[[int, int], object] | None = None,
) -> Motion:
    """The `Motion` of a model over `duration` [s], from a `Start` (None: assembled).

    progress(done, total) is called with samples.  SolverError, with the motion so far, where a step does not settle.
    """
    _refuse(model, duration, settings)
    refuse_seats(model)
    every, step, samples = stepping(model, duration, settings)
    run, way = initial_run(model, begin), scheme(step, settings.rho, settings.solved)
    rows, bodies = np.zeros((samples, len(ROW))), np.zeros((samples, len(run.parts.bodies), len(BODY)))
    tension, plate = np.zeros((samples, len(settings.joints))), np.zeros((samples, len(PLATE)))
    for k in range(samples):
        if k and (done := steps(run, way, every)) < every:
            partial = Motion(model, settings, step, every, rows[:k], bodies[:k], tension[:k], plate[:k])
            raise SolverError(_unsettled(run, step, done), partial=partial)
        _record(run, model, settings, rows[k], bodies[k], tension[k], plate[k])
        if progress:
            progress(k + 1, samples)
    return Motion(model, settings, step, every, rows, bodies, tension, plate)


def initial_run(model: ChainDrive, begin_with: Start | None = None) -> Run:
    """The `Run` of a model at its start, with the accelerations a = -f/M there."""
    parts, state = compile_model(model), assembled(model, begin_with)
    parts.bodies["psi0"] = state.bodies[:, 1]
    true, auxiliary = (State(*map(np.zeros_like, state)) for _ in range(2))
    run = Run(parts, state, true, auxiliary, work_for(parts), np.zeros(WORKS), np.zeros(WORKS), np.zeros(1), np.zeros(1, np.int64))
    drive_bodies(run)
    find_candidates(parts, state)
    assemble(parts, state, 0.0)
    tally(run)
    for start in (true, auxiliary):
        start.plates[:] = -parts.field.plates / [model.chain.mass, model.chain.mass, model.chain.inertia]
        for a, column, inertia in ((0, "slide_column", "mass"), (1, "turn_column", "inertia")):
            free = parts.bodies[column] >= 0
            start.bodies[free, a] = -parts.field.bodies[free, a] / parts.bodies[inertia][free]
    return run


# ------------------------------------------------------------------------------------------------------------ recording


def _record(run, model, settings, row, bodies, tension, plate):
    """One sample, at the state reached."""
    parts, state = run.parts, run.state
    turns = parts.bodies["turn_column"] >= 0
    energy = assemble(parts, state, 0.0) + np.sum((parts.bodies["load"] * state.bodies[:, 1])[turns])  # load torques count as work
    tally(run)
    along, across = _joint_forces(run)
    pairs = parts.pairs[: parts.size[0]]
    teeth = pairs[parts.bodies["kind"][pairs["body"]] != ARC]
    x, v, m, inertia = state.plates, state.plate_rates, model.chain.mass, model.chain.inertia
    values = {
        "t": run.clock[0],
        "kinetic": _kinetic(run, m, inertia),
        "potential": energy,
        "elastic": energy - _outer_potential(run),
        "momentum x": m * np.sum(v[:, 0]),
        "momentum y": m * np.sum(v[:, 1]),
        "angular momentum": m * np.sum(x[:, 0] * v[:, 1] - x[:, 1] * v[:, 0]) + inertia * np.sum(v[:, 2]),
        "contacts": np.sum(teeth["right"] > 0) + np.sum(teeth["left"] > 0),
        "open joints": np.sum(along <= 0),
        "utilisation": _utilisation(along, across),
        **dict(zip(_WORKS, run.works, strict=True)),
    }
    row[:] = [values[name] for name in ROW]
    bodies[:, 0], bodies[:, 1], bodies[:, 2], bodies[:, 3] = (
        *np.stack([state.bodies[:, 0], state.body_rates[:, 0]]),
        *np.stack([state.bodies[:, 1], state.body_rates[:, 1]]),
    )
    bodies[:, 4:] = parts.field.loads
    tension[:] = along[list(settings.joints)]
    plate[:] = _watched(run, teeth, settings.plate)


def _kinetic(run, m, inertia):
    """Of plates, slides and free sprockets; what is driven counts as outside."""
    v, u, bodies = run.state.plate_rates, run.state.body_rates, run.parts.bodies
    slides, turns = bodies["slide_column"] >= 0, bodies["turn_column"] >= 0
    of_bodies = np.sum((bodies["mass"] * u[:, 0] ** 2)[slides]) + np.sum((bodies["inertia"] * u[:, 1] ** 2)[turns])
    return 0.5 * (m * np.sum(v[:, :2] ** 2) + inertia * np.sum(v[:, 2] ** 2) + of_bodies)


def _outer_potential(run):
    """Energy of weights, and of springs and steady forces of what slides: all that is not elastic."""
    parts, q = run.parts, run.state.bodies[:, 0]
    b, g = parts.bodies, parts.gravity
    pull = b["force"] + b["mass"] * (g[0] * b["ux"] + g[1] * b["uy"])
    sliding = np.sum((0.5 * b["spring"] * q * q - pull * q)[b["slide_column"] >= 0])
    return sliding - parts.chain.mass * np.sum(run.state.plates[:, :2] @ g)


def _joint_forces(run):
    """Force with which each joint pulls along the mean direction of its plates, and across it (N,), (N,)."""
    field = run.parts.field
    mean = field.directions + np.roll(field.directions, -1, axis=0)
    u = mean / np.hypot(mean[:, 0], mean[:, 1])[:, None]
    return -np.sum(field.joints * u, axis=1), field.joints[:, 1] * u[:, 0] - field.joints[:, 0] * u[:, 1]


def _utilisation(along, across):
    """The most friction that pure rolling asks for, in joints that are pressed together."""
    pressed = along > PRESSED * max(np.max(along), 0.0)
    return np.max(np.abs(across[pressed]) / along[pressed]) if np.any(pressed) else 0.0


def _watched(run, teeth, number):
    """Pose of a plate and the forces on it: pins in its own frame, flanks along their normals."""
    field, own = run.parts.field, teeth[teeth["plate"] == number]
    c, s = field.directions[number]
    left, right = field.joints[number - 1], -field.joints[number]
    return [
        *run.state.plates[number],
        c * left[0] + s * left[1],
        c * left[1] - s * left[0],
        c * right[0] + s * right[1],
        c * right[1] - s * right[0],
        np.sum(own["left"]),
        np.sum(own["right"]),
    ]


# -------------------------------------------------------------------------------------------------------------- refusals


def _unsettled(run, step, done):
    return (
        f"chain drive: Newton's method does not converge at t = {run.clock[0]:.4g} s, step {done} of a sample; "
        f"shorten the step of {step:.3g} s."
    )


def _refuse(model, duration, settings):
    if not isinstance(model, ChainDrive):
        raise InputError(f"simulate: needs a ChainDrive, got {type(model).__name__}.")
    if not (np.isfinite(duration) and duration > 0):
        raise InputError(f"simulate: the duration must be finite and above 0 s, got {duration:g}.")
    if not 0 <= settings.rho <= 1:
        raise InputError(f"simulate: rho = {settings.rho:g}; the highest frequencies shrink by a factor from 0 to 1 per step.")
    for name in ("step", "solved"):
        if not getattr(settings, name) > 0:
            raise InputError(f"simulate: {name} must be above 0, got {getattr(settings, name):g}.")
    if settings.samples_per_tooth < 20:
        raise InputError(f"simulate: {settings.samples_per_tooth} samples per tooth alias its harmonics; take 20 or more.")
    drive = model.drive
    if max(abs(drive.speed), abs(drive.start)) == 0:
        raise InputError("simulate: the driver does not turn; give it a speed, or use `equilibrium`.")
    for name, numbers in (("joint", settings.joints), ("plate", (settings.plate,))):
        wrong = [n for n in numbers if not 0 <= n < model.chain.count]
        if wrong:
            raise InputError(f"simulate: there is no {name} {wrong[0]}; the chain has 0 .. {model.chain.count - 1}.")
