"""Spectrum of a motion in orders of the drive."""

import numpy as np

from drivewright._typing import Floats
from drivewright.errors import counted
from drivewright.labels import in_words
from drivewright.multibody.analyses.simulation_model import SimulationModel, ideal_record, record_of
from drivewright.multibody.analyses.turns import acceleration
from drivewright.multibody.record import record
from drivewright.multibody.simulate import MOST_STATES, simulate
from drivewright.numerics.ensemble import estimate
from drivewright.numerics.signals import order_spectrum, spectrogram
from drivewright.result import Answer, Column, Table

ORDERS = 60
PER_OSCILLATION = 20  # samples of the highest order, at least


def spectrum(model: SimulationModel) -> Answer:
    """Amplitudes of every output's acceleration in orders of the drive, with and without play."""
    run_record, tables = record_of(model), []
    start, period = model.window_start, model.turn_length
    turns = int(np.floor((run_record.t[-1] - start) / period + 1e-9))
    if turns < 1:
        return Answer(findings=("the spectrum is left out: the evaluation window has no whole turn; raise simulate.turns",))
    samples = max(2 * model.samples_per_turn, PER_OSCILLATION * ORDERS)
    count = counted(turns * samples, MOST_STATES, "samples of the spectrum", "lower samples_per_turn or turns")
    times = start + np.linspace(0, turns * period, count + 1)
    run = simulate(model.assembly, model.run_length, model.settings, samples=np.minimum(times, model.run_length))
    even, ideal = record(run, model.markers), ideal_record(model)
    orders = np.arange(ORDERS + 1.0)
    for output in model.outputs:
        data, unit, word = acceleration(even, output)
        same, _, _ = acceleration(ideal, output)
        amplitude, low, high = amplitudes(spectrogram(even.t, data, period, orders)[1])
        column, beside = (
            Column("amplitude", unit, f"{word} amplitude", amplitude, "amplitude"),
            order_spectrum(ideal.t, same, period, orders),
        )
        tables.append(
            Table(
                f"spectrum.{output.name}",
                f"{word.capitalize()} spectrum, {in_words(output.name)}",
                (
                    Column("order", "-", "order, oscillations per turn", orders, "order of the drive"),
                    column,
                    *(column.bounds(low, high) if turns > 1 else ()),
                    Column("ideal_amplitude", unit, f"{word} amplitude, ideal joints", beside, "amplitude, ideal joints"),
                ),
            )
        )
    return Answer(tables=tuple(tables))


def amplitudes(turns: Floats) -> Floats:
    """(amplitude, low, high) of each order from the amplitudes (turns, orders) of single turns: the root of their mean square, so that
    what is irregular keeps its size however many turns there are, with its interval.  A motion that repeats itself has the same in all."""
    estimates = [estimate(power, scale=float(np.max(turns**2))) for power in (turns**2).T]
    power = np.array([[one.value, one.low, one.high] for one in estimates])
    return np.sqrt(np.maximum(power, 0.0)).T
