"""What an ensemble of runs says in numbers: means over revolutions of the chain, with their intervals."""

import numpy as np

from drivewright._typing import Floats
from drivewright.chains.explicit.ensemble import Ensemble, amplitude_of, centre_distance, maximum_of, mean_of, range_of
from drivewright.chains.explicit.motion import Motion
from drivewright.chains.explicit.simulate import tooth_time
from drivewright.result import Value


def centre_distance_values(runs: Ensemble) -> dict[str, Value]:
    """Mean, fluctuation and mesh order of the centre distance in a revolution of the chain, range of the whole run."""
    found = {
        "mean": (runs.estimate(mean_of(centre_distance), range_of(centre_distance)), "mean of the centre distance"),
        "fluctuation": (runs.estimate(range_of(centre_distance)), "peak-to-peak of the centre distance in a revolution of the chain"),
        "range": (runs.extreme(range_of(centre_distance)), "peak-to-peak of the centre distance in the whole run"),
        "mesh_order_amplitude": (runs.estimate(amplitude_of(centre_distance)), "amplitude of the centre distance at the mesh frequency"),
    }
    return {name: Value.of(estimate, "m", meaning) for name, (estimate, meaning) in found.items()}


def force_values(runs: Ensemble) -> dict[str, Value]:
    """Transmission error, tension of a joint, flank force of a plate and mesh frequency; of rolling pins the friction that they need."""
    statistics = {
        "transmission_error": (
            range_of(lambda run: run.transmission_error(1)),
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
    return Value.of(runs.estimate(mean_of(lambda run: run.column("contacts"))), "-", "flanks that touch, on average")


def _tension(run: Motion) -> Floats:
    return run.tension[:, 0]


def _flank_force(run: Motion) -> Floats:
    return np.maximum(run.column("left flank"), run.column("right flank"))
