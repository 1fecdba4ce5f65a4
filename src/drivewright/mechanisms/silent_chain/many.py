"""Many runs of the moving chain: over speed, and over the scatter of manufacture; and the chain at rest at many angles."""

import numpy as np

from drivewright.chains.explicit.batch import Scatter, campbell, monte_carlo, revolution_time
from drivewright.chains.explicit.signals import tensioners
from drivewright.chains.explicit.simulate import Settings
from drivewright.chains.explicit.tables import campbell_table, scatter_table, signal_of, speed_table
from drivewright.chains.implicit.equilibrium import compliance_of, equilibrium
from drivewright.chains.implicit.tables import plate_force_table, rest_table
from drivewright.chains.path.route import bodies
from drivewright.mechanisms.silent_chain.build import ChainModel
from drivewright.mechanisms.silent_chain.chain_drive import chain_drive
from drivewright.mechanisms.silent_chain.dynamics import explicit_step
from drivewright.mechanisms.silent_chain.missing import unless_impossible
from drivewright.result import Answer, Answers, Value

SPEEDS = 12  # of the Campbell diagram by default, up to
BEYOND = 1.5  # times the design's speed
REVOLUTIONS = 2  # of the chain, in a run of the Campbell diagram
POSITIONS = 24  # in a tooth, at rest
PERCENTILES = (5, 50, 95)


@unless_impossible
def speeds(model: ChainModel, done: Answers) -> Answer:
    """Fluctuation and mesh order over the speed, and the spectra: a Campbell diagram."""
    drive, given = model.drive, model.spec.compare.speeds
    chosen = np.array(given) if given else drive.speed * BEYOND * np.arange(1, SPEEDS + 1) / SPEEDS
    system = chain_drive(model)
    outcomes = campbell(system, -chosen, REVOLUTIONS, _settings(model, system), model.spec.dynamics.ensemble)
    rows = [(-row.case, row.value) for row in outcomes.rows if row.ok]
    findings = tuple(f"at {-row.case * 30 / np.pi:.4g} rpm: {row.reason}" for row in outcomes.failed)
    findings += tuple(_drifting([(f"{speed * 30 / np.pi:.4g} rpm", level) for speed, level in rows]))
    if not rows:
        return Answer(findings=findings, outcome="partial")
    table = speed_table(rows)
    diagram = campbell_table(rows, model.teeth[0])
    return Answer({}, (table, diagram), (), findings)


def _drifting(levels):
    """Finding: where the fluctuation had not settled."""
    names = [name for name, level in levels if not level.fluctuation.settled]
    if names:
        yield f"not settled: the fluctuation at {', '.join(names)}, which depends on the length of the runs; increase dynamics.settling"


@unless_impossible
def scatter(model: ChainModel, done: Answers) -> Answer:
    """Percentiles of mean and fluctuation of the centre distance over drives as they come from manufacture; each drive runs once."""
    system, given = chain_drive(model), model.spec.scatter
    settings = _settings(model, system)
    duration = settings.settle + REVOLUTIONS * revolution_time(system)
    spread = monte_carlo(system, Scatter(given.tooth_thickness, given.pitch), given.samples, duration, settings, PERCENTILES, given.seed)
    values, levels = {}, [row.value for row in spread.outcomes.rows if row.ok]
    unit, words = signal_of(levels)
    for k, percent in enumerate(PERCENTILES):
        for name, numbers, what in (("mean", spread.mean, f"mean {words}"), ("fluctuation", spread.fluctuation, f"peak-to-peak {words}")):
            value, low, high = np.asarray(numbers)[:, k]
            meaning = f"{what} in a revolution of the chain, below which {percent} % of the drives lie"
            label = f"{what}, P{percent}"
            values[f"scatter.{name}.p{percent:02d}"] = Value(value, unit, meaning, low, high, "sample", label=label).plain()
    table = scatter_table(levels)
    findings = tuple(f"drive {row.case}: {row.reason}" for row in spread.outcomes.failed)
    return Answer(values, (table,), (), findings)


@unless_impossible
def quasi_static(model: ChainModel, done: Answers) -> Answer:
    """The loaded chain at rest, teeth and joints elastic, flanks that press only: also with thick teeth and a worn chain."""
    system = chain_drive(model)
    rest = equilibrium(system, POSITIONS)
    values = {
        **(_distances_at_rest(system, rest) if system.sprockets[system.measured].slide else {}),
        **_travels_at_rest(system, rest),
        "quasi_static.transmission_error": Value(
            np.ptp(rest.transmission_error(1)),
            "rad",
            "transmission error of the loaded chain at rest, peak-to-peak over one tooth: angle of the driven sprocket minus that by the "
            "tooth ratio",
            label="Static transmission error, peak-to-peak",
        ),
        "quasi_static.flank_force.maximum": Value(
            np.max(rest.flank_force),
            "N",
            "maximum force on a flank of a plate, chain at rest under load",
            label="Maximum flank force, static",
        ),
    }
    return Answer(values, (rest_table(rest), plate_force_table(rest)))


def _distances_at_rest(system, rest):
    """The centre distance at rest, and that of the rigid limit."""
    rigid = compliance_of(system, POSITIONS)
    return {
        "quasi_static.centre_distance.mean": Value(
            rest.mean, "m", "mean centre distance over one tooth, chain at rest under load", label="Static centre distance, mean"
        ),
        "quasi_static.centre_distance.fluctuation": Value(
            rest.fluctuation,
            "m",
            "peak-to-peak centre distance over one tooth, chain at rest under load",
            label="Static centre distance, peak-to-peak",
        ),
        "quasi_static.centre_distance.rigid": Value(
            rigid.rigid_mean,
            "m",
            "mean centre distance over one tooth, extrapolated to rigid plates and joints",
            label="Static centre distance, rigid limit",
        ),
    }


def _travels_at_rest(system, rest):
    """Where tensioners stand at rest."""
    values = {}
    for number in tensioners(system):
        name, travel = bodies(system)[number].name, rest.bodies[:, number, 0]
        key = f"quasi_static.tensioner.{name}.travel"
        values[f"{key}.mean"] = Value(
            float(np.mean(travel)),
            "m",
            f"mean travel of tensioner {name} over one tooth, chain at rest under load",
            label=f"Static travel of {name}, mean",
        )
        values[f"{key}.fluctuation"] = Value(
            float(np.ptp(travel)),
            "m",
            f"peak-to-peak travel of tensioner {name} over one tooth, chain at rest under load",
            label=f"Static travel of {name}, peak-to-peak",
        )
    return values


def _settings(model, system):
    return Settings(explicit_step(model, system), settle=model.spec.dynamics.settling, tolerance=model.spec.dynamics.largest_drift)
