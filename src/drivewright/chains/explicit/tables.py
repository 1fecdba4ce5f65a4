"""Tables of the running chain: signals over time, spectrum by mesh orders."""

from drivewright.chains.explicit.ensemble import Ensemble
from drivewright.chains.explicit.motion import Motion
from drivewright.chains.explicit.simulate import tooth_time
from drivewright.numerics.ensemble import of_members
from drivewright.result import Column, Table

PLATE_FORCES = ("left x", "left y", "right x", "right y", "left flank", "right flank")


def signal_table(motion: Motion) -> Table:
    """Table "running": centre distance, transmission error, tension, contacts, plate forces and energy gap in the steady part."""
    steady = motion.steady
    forces = [
        Column(f"plate.{name.replace(' ', '_')}", "N", f"on a plate as it goes round: {name}", motion.column(name)[steady])
        for name in PLATE_FORCES
    ]
    return Table(
        "running",
        "The running chain",
        (
            Column("time", "s", "time", motion.t[steady]),
            Column("centre_distance", "m", "centre distance", motion.centre_distance[steady]),
            Column("transmission_error", "rad", "driven angle off the ratio of teeth", motion.transmission_error(1)[steady]),
            Column("tension", "N", "tension in a joint as it goes round", motion.tension[steady, 0]),
            Column("contacts", "-", "flanks that touch", motion.column("contacts")[steady]),
            *forces,
            Column("energy_gap", "J", "energy less all work since the start", motion.energy_gap[steady]),
        ),
    )


def spectrum_table(runs: Ensemble, highest: float) -> Table:
    """Table "spectrum": amplitudes of the centre distance up to the `highest` mesh order, means over all revolutions of the chain."""
    orders, amplitudes = runs.mesh_orders
    near = orders <= highest
    mean, reach = of_members(amplitudes[:, near])
    amplitude = Column("centre_distance", "m", "amplitude of the centre distance", mean)
    return Table(
        "spectrum",
        "Spectrum of the centre distance",
        (
            Column("order", "-", "multiple of the mesh frequency", orders[near]),
            Column("frequency", "Hz", "frequency", orders[near] / tooth_time(runs.first.model)),
            amplitude,
            *(amplitude.bounds(mean - reach, mean + reach) if len(amplitudes) > 1 else ()),
        ),
    )
