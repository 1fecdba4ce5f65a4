"""Tables of the running chain: signals over time, spectrum by mesh orders; many runs over speed and over the scatter of manufacture."""

from collections.abc import Sequence

import numpy as np

from drivewright.chains.explicit.batch import Level
from drivewright.chains.explicit.ensemble import Ensemble
from drivewright.chains.explicit.motion import Motion
from drivewright.chains.explicit.signals import spring_force, tensioners, travel
from drivewright.chains.explicit.simulate import tooth_time
from drivewright.numerics.ensemble import Estimate, mean_of_members
from drivewright.numerics.signals import highest_peaks
from drivewright.result import Column, Table

PEAKS = 4  # of a spectrum, in the Campbell diagram
SIGNAL_WORDS = {"m": "tensioner travel", "rad": "transmission error"}
PLATE_FORCES = {
    "left x": "left pin force on a plate along x",
    "left y": "left pin force on a plate along y",
    "right x": "right pin force on a plate along x",
    "right y": "right pin force on a plate along y",
    "left flank": "left flank force on a plate",
    "right flank": "right flank force on a plate",
}


def tensioner_table(motion: Motion) -> Table:
    """Table "tensioners": travel and spring force of each tensioner over time, one below the other."""
    steady, model = motion.steady, motion.model
    rows = [(travel(model, n), spring_force(model, n)) for n in tensioners(model)]
    t = motion.t[steady]
    return Table(
        "tensioners",
        "Tensioners, running chain",
        (
            Column("time", "s", "time", np.tile(t, len(rows))),
            Column("travel", "m", "tensioner travel", np.concatenate([signal.of(motion)[steady] for signal, _ in rows])),
            Column("force", "N", "spring force", np.concatenate([force(motion)[steady] for _, force in rows])),
            Column("tensioner", "-", "tensioner", np.repeat([signal.name.split(".")[1] for signal, _ in rows], len(t))),
        ),
    )


def signal_table(motion: Motion) -> Table:
    """Table "running": centre distance, transmission error, tension, contacts, plate forces and energy gap in the steady part."""
    steady = motion.steady
    forces = [
        Column(f"plate.{name.replace(' ', '_')}", "N", meaning, motion.column(name)[steady]) for name, meaning in PLATE_FORCES.items()
    ]
    return Table(
        "running",
        "Running chain over time",
        (
            Column("time", "s", "time", motion.t[steady]),
            Column("centre_distance", "m", "centre distance", motion.centre_distance[steady]),
            Column("transmission_error", "rad", "transmission error", motion.transmission_error(motion.model.measured)[steady]),
            Column("tension", "N", "joint tension", motion.tension[steady, 0]),
            Column("contacts", "-", "flanks in contact", motion.column("contacts")[steady]),
            *forces,
            Column("energy_gap", "J", "energy minus all work since the start", motion.energy_gap[steady]),
        ),
    )


def spectrum_table(runs: Ensemble, highest: float) -> Table:
    """Table "spectrum": amplitudes of the centre distance up to the `highest` mesh order, means over all revolutions of the chain.

    Table "motion_spectrum" of a drive whose centre distance is fixed: those of its first tensioner or of the transmission error.
    """
    orders, amplitudes = runs.mesh_orders
    near = orders <= highest
    mean, reach = mean_of_members(amplitudes[:, near])
    signal = runs.signal
    slides = signal.name == "centre_distance"
    words = signal.words if slides else SIGNAL_WORDS[signal.unit]
    amplitude = Column("centre_distance" if slides else "amplitude", signal.unit, f"amplitude of the {words}", mean, f"{words} amplitude")
    return Table(
        "spectrum" if slides else "motion_spectrum",
        f"Spectrum of the {words}",
        (
            Column("order", "-", "multiple of the mesh frequency", orders[near]),
            Column("frequency", "Hz", "frequency", orders[near] / tooth_time(runs.first.model)),
            amplitude,
            *(amplitude.bounds(mean - reach, mean + reach) if len(amplitudes) > 1 else ()),
        ),
    )


def speed_table(rows: Sequence[tuple[float, Level]]) -> Table:
    """Table "speeds" of (speed [rad/s], `Level`): mean, fluctuation and mesh orders of the drives' signal, greatest tension."""
    levels = [level for _, level in rows]
    unit, words = signal_of(levels)
    orders = [
        column
        for k in range(len(levels[0].amplitudes))
        for column in bounded(f"mesh_order_{k + 1}", unit, f"amplitude at mesh order {k + 1}", [level.amplitudes[k] for level in levels])
    ]
    fluctuation = f"peak-to-peak {words}"
    return Table(
        "speeds",
        f"{words.capitalize()} over speed",
        (
            Column("speed", "rad/s", "speed of the driving sprocket", np.array([speed for speed, _ in rows])),
            *bounded("mean", unit, f"mean {words}", [level.mean for level in levels]),
            *bounded("fluctuation", unit, fluctuation, [level.fluctuation for level in levels]),
            *orders,
            *bounded("tension", "N", "maximum joint tension", [level.tension for level in levels]),
        ),
    )


def signal_of(levels: Sequence[Level]) -> tuple[str, str]:
    """(unit, words) of the signal of drives of one kind."""
    signal = levels[0].signal
    return signal.unit, signal.words if signal.name == "centre_distance" else SIGNAL_WORDS[signal.unit]


def campbell_table(rows: Sequence[tuple[float, Level]], teeth: int, peaks: int = PEAKS) -> Table:
    """Table "campbell": the highest peaks of the spectra over the speed, beside the mesh frequency of so many teeth."""
    speed = np.array([speed for speed, _ in rows])
    highest = [highest_peaks(level.frequency, level.spectrum, peaks) for _, level in rows]
    _, words = signal_of([level for _, level in rows])
    return Table(
        "campbell",
        f"Campbell diagram, {words}",
        (
            Column("speed", "rad/s", "speed of the driving sprocket", speed),
            *(Column(f"peak_{k + 1}", "Hz", f"spectral peak {k + 1}", np.array([each[k] for each in highest])) for k in range(peaks)),
            Column("mesh_frequency", "Hz", "mesh frequency", speed * teeth / (2 * np.pi)),
        ),
    )


def scatter_table(levels: Sequence[Level]) -> Table:
    """Table "scatter": mean and fluctuation of the signal of every drive."""
    unit, words = signal_of(levels)
    return Table(
        "scatter",
        "Drives with manufacturing scatter",
        (
            Column("drive", "-", "drive", np.arange(float(len(levels)))),
            *bounded("mean", unit, f"mean {words}", [each.mean for each in levels]),
            *bounded("fluctuation", unit, f"peak-to-peak {words}", [each.fluctuation for each in levels]),
        ),
    )


def bounded(name: str, unit: str, meaning: str, estimates: Sequence[Estimate]) -> tuple[Column, ...]:
    """A column of the values of estimates, and those of the ends of their intervals."""
    value, low, high = np.array([(each.value, each.low, each.high) for each in estimates]).T
    column = Column(name, unit, meaning, value)
    return column, *column.bounds(low, high)
