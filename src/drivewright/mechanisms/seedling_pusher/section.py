"""Poincare section of the contact run: where the rod is once a turn, at the start of the push."""

import numpy as np

from drivewright._typing import Floats
from drivewright.errors import SolverError
from drivewright.mechanisms.seedling_pusher.build import TURN, PusherModel
from drivewright.mechanisms.seedling_pusher.dynamics import lever_system
from drivewright.multibody.analyses.poincare import Section, section_answer
from drivewright.numerics.ode import integrate
from drivewright.result import Answer, Answers
from drivewright.stops import Stop, note_stop

TURNS, DISCARD = 48, 16  # of the carrier, and those of them that are left out
STILL = 1e-3  # of the rod's range: the damper's force jumps at a touch, which costs digits


def poincare(model: PusherModel, done: Answers) -> Answer:
    """Deviation of the rod from its programme, and its rate, once a turn of the carrier, at the start of the push."""
    system = lever_system(model)
    period = TURN / system.speed
    run = integrate(
        system,
        0.0,
        TURNS * period * (1 + 1e-12),
        [0.0, 0.0],
        rtol=1e-10,  # finer than the contact run: visits are compared with each other
        atol=[1e-13, 1e-10],
        samples=period * np.arange(TURNS + 1),
        max_step=period / 2000,
        max_steps=5_000_000,
    )
    if run.advice:
        note_stop(Stop(f"the contact simulation ends at t = {run.t_end:.6g} s of {TURNS * period:.6g} s", run.advice))
    if len(run.t) <= DISCARD:
        raise SolverError(f"the contact simulation ends before turn {DISCARD}, at t = {run.t_end:.6g} s: {run.advice}")
    start = model.swing(np.array([model.push_start]))
    error, rate = rod_deviation(system.arm, start.d0, start.d1 * system.speed, *run.y.T)
    turn = model.swing(model.push_start + np.linspace(0.0, TURN, 721))
    spans = np.array([np.ptp(system.arm * np.tan(turn.d0)), np.ptp(system.arm * turn.d1 * system.speed / np.cos(turn.d0) ** 2)])
    return section_answer("rod", Section(run.t, error, rate), period, spans, DISCARD * period, "the start of the push", STILL)


def rod_deviation(arm: float, swing: Floats, swing_rate: Floats, ahead: Floats, ahead_rate: Floats) -> tuple[Floats, Floats]:
    """(deviation of the rod [m], its rate [m/s]) where the lever is `ahead` [rad] of its swing [rad]; any matching shapes."""
    planned, actual = swing, swing + ahead
    rate = arm * ((swing_rate + ahead_rate) / np.cos(actual) ** 2 - swing_rate / np.cos(planned) ** 2)
    return arm * (np.tan(actual) - np.tan(planned)), rate
