"""Statistics of an ensemble of runs: means over revolutions of the chain, with their intervals."""

import numpy as np

from drivewright._typing import Floats
from drivewright.chains.explicit.ensemble import Ensemble, amplitude_of, maximum_of, mean_of, range_of
from drivewright.chains.explicit.motion import Motion
from drivewright.chains.explicit.signals import signals, spring_force, strand_tension, tensioners, travel
from drivewright.chains.explicit.simulate import tooth_time
from drivewright.chains.path.balance import Balance
from drivewright.chains.path.route import short_name
from drivewright.result import Value

SPROCKETS = {"drive": "driving sprocket", "driven": "driven sprocket"}


def signal_values(runs: Ensemble) -> dict[str, Value]:
    """Mean, fluctuation and mesh order of centre distance and tensioners in a revolution of the chain, range of the whole run."""
    lengths = [signal for signal in signals(runs.first.model) if signal.unit == "m"]
    return {f"{signal.name}.{name}": value for signal in lengths for name, value in _values_of(runs, signal).items()}


def _values_of(runs, signal):
    of, words = signal.of, signal.words
    found = {
        "mean": (runs.estimate_mean(of, range_of(of)), f"mean {words} of the running chain", "mean"),
        "fluctuation": (runs.estimate(range_of(of)), f"peak-to-peak {words} in a revolution of the chain", "peak-to-peak"),
        "range": (runs.extreme(range_of(of)), f"peak-to-peak {words} in the whole run", "total range"),
        "mesh_order_amplitude": (runs.estimate(amplitude_of(of)), f"amplitude of the {words} at the mesh frequency", "mesh order 1"),
    }
    return {name: Value.of(each, signal.unit, meaning, f"{signal.label}, {what}") for name, (each, meaning, what) in found.items()}


def tensioner_values(runs: Ensemble) -> dict[str, Value]:
    """Mean force of the spring of each tensioner."""
    values, model = {}, runs.first.model
    for number in tensioners(model):
        name = travel(model, number).name.removesuffix(".travel")
        found = runs.estimate_mean(spring_force(model, number))
        values[f"{name}.force"] = Value.of(found, "N", f"mean spring force of {name.replace('.', ' ')}")
    return values


def strand_values(runs: Ensemble, balance: Balance) -> dict[str, Value]:
    """Mean tension in the middle of each strand, named by the body that it leaves."""
    values = {}
    for place, station in enumerate(balance.route.stations):
        signal, name = strand_tension(balance, place), short_name(runs.first.model, station.body)
        if all(np.all(np.isfinite(signal(run)[run.steady])) for run in runs.members):
            mean = runs.estimate(mean_of(signal))
            body = SPROCKETS.get(name, name)
            meaning = f"mean tension in the middle of the strand that leaves {f'the {body}' if name in SPROCKETS else name}"
            values[f"strand.{name}.tension"] = Value.of(mean, "N", meaning, f"Dynamic tension after {body}")
    return values


def force_values(runs: Ensemble) -> dict[str, Value]:
    """Transmission error, tension of a joint, flank force of a plate and mesh frequency; of rolling pins the required friction."""
    driven = runs.first.model.measured
    statistics = {
        "transmission_error": (
            range_of(lambda run: run.transmission_error(driven)),
            "rad",
            "transmission error, peak-to-peak in a revolution of the chain: angle of the driven sprocket minus that by the tooth ratio",
            "Dynamic transmission error, peak-to-peak",
        ),
        "tension.mean": (mean_of(_tension), "N", "mean tension of a joint over a revolution of the chain", "Joint tension, mean"),
        "tension.maximum": (maximum_of(_tension), "N", "maximum tension of a joint in a revolution of the chain", "Joint tension, maximum"),
        "flank_force.maximum": (
            maximum_of(_flank_force),
            "N",
            "maximum force on a flank of a plate in a revolution of the chain",
            "Maximum flank force, dynamic",
        ),
    }
    values = {name: Value.of(runs.estimate(statistic), *about) for name, (statistic, *about) in statistics.items()}
    model = runs.first.model
    values["mesh_frequency"] = Value(
        1 / tooth_time(model), "Hz", "number of teeth that mesh per second in the run", label="Mesh frequency in the run"
    )
    if model.chain.link.radius:
        values["friction_utilisation"] = Value.of(
            runs.estimate(maximum_of(lambda run: run.column("utilisation"))),
            "-",
            "maximum coefficient of friction in a revolution that rolling without slip of the pins requires, in joints with at least a "
            "twentieth of the maximum force",
            "Required coefficient of friction, pins",
        )
    return values


def touching_flanks(runs: Ensemble) -> Value:
    """Mean number of tooth contacts."""
    return Value.of(runs.estimate(mean_of(lambda run: run.column("contacts"))), "-", "mean number of tooth contacts")


def _tension(run: Motion) -> Floats:
    return run.tension[:, 0]


def _flank_force(run: Motion) -> Floats:
    return np.maximum(run.column("left flank"), run.column("right flank"))
