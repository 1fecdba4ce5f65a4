"""What an ensemble of runs says in numbers: means over revolutions of the chain, with their intervals."""

import numpy as np

from drivewright._typing import Floats
from drivewright.chains.explicit.ensemble import Ensemble, amplitude_of, maximum_of, mean_of, range_of
from drivewright.chains.explicit.motion import Motion
from drivewright.chains.explicit.signals import signals, spring_force, strand_tension, tensioners, travel
from drivewright.chains.explicit.simulate import tooth_time
from drivewright.chains.path.balance import Balance
from drivewright.chains.path.route import short_name
from drivewright.result import Value


def signal_values(runs: Ensemble) -> dict[str, Value]:
    """Mean, fluctuation and mesh order of centre distance and tensioners in a revolution of the chain, range of the whole run."""
    lengths = [signal for signal in signals(runs.first.model) if signal.unit == "m"]
    return {f"{signal.name}.{name}": value for signal in lengths for name, value in _values_of(runs, signal).items()}


def _values_of(runs, signal):
    of, words = signal.of, signal.words
    found = {
        "mean": (runs.estimate_mean(of, range_of(of)), f"mean of the {words}"),
        "fluctuation": (runs.estimate(range_of(of)), f"peak-to-peak of the {words} in a revolution of the chain"),
        "range": (runs.extreme(range_of(of)), f"peak-to-peak of the {words} in the whole run"),
        "mesh_order_amplitude": (runs.estimate(amplitude_of(of)), f"amplitude of the {words} at the mesh frequency"),
    }
    return {name: Value.of(estimate, signal.unit, meaning) for name, (estimate, meaning) in found.items()}


def tensioner_values(runs: Ensemble) -> dict[str, Value]:
    """Mean force of the spring of each tensioner."""
    values, model = {}, runs.first.model
    for number in tensioners(model):
        name = travel(model, number).name.removesuffix(".travel")
        found = runs.estimate_mean(spring_force(model, number))
        values[f"{name}.force"] = Value.of(found, "N", f"mean force of the spring of {name.replace('.', ' ')}")
    return values


def strand_values(runs: Ensemble, balance: Balance) -> dict[str, Value]:
    """Mean tension in the middle of each strand, named by the body that it leaves."""
    values = {}
    for place, station in enumerate(balance.route.stations):
        signal, name = strand_tension(balance, place), short_name(runs.first.model, station.body)
        if all(np.all(np.isfinite(signal(run)[run.steady])) for run in runs.members):
            mean = runs.estimate(mean_of(signal))
            values[f"strand.{name}.tension"] = Value.of(mean, "N", f"mean tension in the strand that leaves {name}")
    return values


def force_values(runs: Ensemble) -> dict[str, Value]:
    """Transmission error, tension of a joint, flank force of a plate and mesh frequency; of rolling pins the friction that they need."""
    driven = runs.first.model.measured
    statistics = {
        "transmission_error": (
            range_of(lambda run: run.transmission_error(driven)),
            "rad",
            "driven angle off the ratio of teeth, peak-to-peak in a revolution of the chain",
        ),
        "tension.mean": (mean_of(_tension), "N", "tension in a joint as it goes round, mean"),
        "tension.maximum": (maximum_of(_tension), "N", "tension in a joint as it goes round, greatest in a revolution"),
        "flank_force.maximum": (maximum_of(_flank_force), "N", "on a flank of a plate as it goes round, greatest in a revolution"),
    }
    values = {name: Value.of(runs.estimate(statistic), unit, meaning) for name, (statistic, unit, meaning) in statistics.items()}
    model = runs.first.model
    values["mesh_frequency"] = Value(1 / tooth_time(model), "Hz", "teeth that mesh in a second")
    if model.chain.link.radius:
        values["friction_utilisation"] = Value.of(
            runs.estimate(maximum_of(lambda run: run.column("utilisation"))),
            "-",
            "coefficient of friction that pins need to roll, in joints with a twentieth of the greatest force or more, greatest in a "
            "revolution",
        )
    return values


def touching_flanks(runs: Ensemble) -> Value:
    """Flanks that touch, on average."""
    return Value.of(runs.estimate(mean_of(lambda run: run.column("contacts"))), "-", "tooth contacts, on average")


def _tension(run: Motion) -> Floats:
    return run.tension[:, 0]


def _flank_force(run: Motion) -> Floats:
    return np.maximum(run.column("left flank"), run.column("right flank"))
