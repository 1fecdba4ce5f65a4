"""The largest Lyapunov exponent: how fast neighbouring motions of a mechanism part, per turn of its drive."""

from collections.abc import Sequence

import numpy as np

from drivewright import cases
from drivewright._typing import Floats
from drivewright.errors import SolverError
from drivewright.multibody.analyses.ensemble import perturbed_start, settled_check
from drivewright.multibody.analyses.simulation_model import TURN, SimulationModel
from drivewright.multibody.simulate import Settings, convert_state, simulate, tolerances
from drivewright.numerics.chaos import Exponent, largest_exponent
from drivewright.numerics.ensemble import estimate
from drivewright.result import Answer, Column, Table, Value

ABOVE_ERROR = 1000.0  # separation of twins over the relative tolerance: below, the integrator's error would be taken for growth
PAIRS_OF_TWINS = 2  # of the ensemble: every turn of a pair is a sample


def lyapunov(model: SimulationModel, turns: int, discard: int) -> Answer:
    """Largest Lyapunov exponent per turn of the drive, by Benettin's method over so many turns behind the discarded ones."""
    system = model.assembly.system
    if model.assembly.freedom == 0:
        return Answer(findings=("the Lyapunov exponent does not exist: with its drive the mechanism has no degree of freedom",))
    free = len(system.stored) + len(system.independent)
    scales = tolerances(system, model.settings, TURN / model.turn_length) / model.settings.rtol
    inside = np.arange(len(scales)) < free
    inside[: len(system.stored)] = ~np.isin(system.stored, system.dependent)  # a dependent coordinate has no neighbours of its own

    def one(number: int) -> Exponent:
        return largest_exponent(
            TurnMap(model),
            perturbed_start(model, number),
            scales,
            cycles=turns,
            discard=discard,
            rng=np.random.default_rng(model.seed + number),
            continuous=inside,
            separation=float(np.clip(ABOVE_ERROR * model.settings.rtol, 1e-8, 1e-4)),
        )

    pairs = [row.value for row in cases.run(one, range(min(PAIRS_OF_TWINS, model.ensemble)), workers=None).rows if row.ok]
    if not pairs:
        return Answer(findings=("the Lyapunov exponent is left out: the motion diverges",), outcome="partial")
    return exponent_answer(pairs)


def exponent_answer(pairs: Sequence[Exponent]) -> Answer:
    """Value, interval and convergence of exponents from motions that start almost alike, each with a twin."""
    history = np.mean([pair.history for pair in pairs], axis=0)
    turns = np.arange(1.0, len(history) + 1)
    growth = np.diff([pair.history * turns for pair in pairs], axis=1, prepend=0.0)
    exponent = Value.of(
        estimate(growth), "-", "largest Lyapunov exponent per turn", convention="above 0: chaotic motion; 0 or below: regular motion"
    )
    error = float(np.sqrt(np.sum([pair.error**2 for pair in pairs])) / len(pairs))
    meaning = "standard error of the largest Lyapunov exponent per turn"
    values = {
        "lyapunov_exponent.per_turn": exponent,
        "lyapunov_exponent.error": Value(error, "-", meaning, label="standard error of Lyapunov exponent"),
    }
    table = Table(
        "lyapunov",
        "Convergence of the Lyapunov exponent",
        (
            Column("turn", "-", "turns evaluated", turns),
            Column("exponent", "-", "mean logarithmic growth of the separation per turn", history, "Lyapunov exponent, running mean"),
        ),
    )
    return Answer(values, (table,), (settled_check("settled.lyapunov", [exponent], "Settled Lyapunov exponent"),))


class TurnMap:
    """State at the start of a turn -> state at its end: the map whose neighbours the exponent compares."""

    def __init__(self, model: SimulationModel) -> None:
        self.model = model
        self.settings = Settings(model.settings.rtol, model.settings.atol, max_steps=model.settings.max_steps)
        stored, tree = list(model.assembly.system.stored), model.assembly.tree
        self.spinning = [stored.index(tree.link(f"link:{name}").turn) for name in model.massless_links]

    def __call__(self, state: Floats) -> Floats:
        # Every turn is run from time 0: the drive's angle is the same, and the state carries all that pins remember.
        run = simulate(self.model.assembly, self.model.turn_length, self.settings, samples=np.empty(0), state=state)
        if run.advice:
            raise SolverError(f"a turn was not completed: {run.stop}")
        end = convert_state(*run.end, self.model.assembly.system)  # the coordinates may have been partitioned again on the way
        end[self.spinning] %= TURN  # a link that spins would drown the separation in the rounding of its angle
        return end
