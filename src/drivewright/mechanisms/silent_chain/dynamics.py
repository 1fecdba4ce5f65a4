"""The running chain: centre distance, forces, orders and balances, over revolutions of the chain after it has settled, in an ensemble."""

from collections.abc import Iterator, Mapping

import numpy as np

from drivewright.chains.explicit.ensemble import Ensemble, centre_distance, ensemble, mean_of
from drivewright.chains.explicit.simulate import Settings, simulate, tooth_time
from drivewright.chains.explicit.stability import safe_step
from drivewright.chains.explicit.statistics import centre_distance_values, force_values, touching_flanks
from drivewright.chains.explicit.tables import signal_table, spectrum_table
from drivewright.chains.implicit import simulate as implicit
from drivewright.chains.model import ChainDrive
from drivewright.errors import InputError, SolverError, SpecError
from drivewright.mechanisms.silent_chain.build import ChainModel
from drivewright.mechanisms.silent_chain.chain_drive import chain_drive
from drivewright.mechanisms.silent_chain.missing import unless_impossible
from drivewright.result import Answer, Answers, Check, Value

IMPLICIT_STEP = 1e-5  # [s]
OFF = 0.25  # of the pitch: a mean centre distance so far from the rigid one is that of a chain off its teeth
REVOLUTIONS = 2  # of the chain, that are evaluated by default
MOST_STEPS = 2e10  # of a link, in all runs: about ten minutes
MOST_LISTED = 3  # statistics that have not settled, by name
MOST_FRICTION = 0.3  # coefficient of friction of dry steel on steel; lubricated about 0.1
HINT = (
    "where a shorter step does not help: a slack strand (check strand.taut), a speed, wear or teeth that throw the chain off, or a "
    "tensioner that hits it; see also the analysis 'quasi_static'"
)
ORDERS = 8  # of the mesh frequency, up to which the spectrum is shown
WATCHED = 0


@unless_impossible
def dynamics(model: ChainModel, done: Answers) -> Answer:
    """The runs, their statistics, spectrum and balances; of a run that failed the balance and the signals alone."""
    runs = _runs(model, chain_drive(model))
    if not all(np.all(np.isfinite(run.rows)) for run in runs.members):
        raise SolverError(f"{runs.advice}; {HINT}")
    drift = Value(runs.energy_drift, "1/s", "energy that computing added or lost in a second, over the energy stored")
    checks = (
        Check("energy_drift", drift.value, model.spec.dynamics.largest_drift, "<=", "1/s", drift.meaning, ("chain",)),
        *_seated(model, runs),
    )
    tables = (signal_table(runs.first), spectrum_table(runs, ORDERS))
    reason = runs.advice or next((check.message for check in checks if not check.ok), "")
    if reason:
        findings = (f"the run has failed, its statistics are left out: {reason}; {HINT}",)
        return Answer({"dynamics.energy_drift": drift}, tables, checks, findings, outcome="partial")
    values = {f"dynamics.centre_distance.{name}": value for name, value in centre_distance_values(runs).items()}
    values |= {f"dynamics.{name}": value for name, value in force_values(runs).items()}
    checks = (*checks, settled(values))
    values["dynamics.energy_drift"] = drift
    return Answer(values, tables, checks, tuple(_remarks(runs, values)), data=runs, warnings=tuple(_slipping(values)))


def _seated(model: ChainModel, runs: Ensemble) -> Iterator[Check]:
    """Whether the chain is still on its teeth."""
    first = runs.first
    message = "flanks that touch, on average, against one on every sprocket: with fewer the chain has left its teeth"
    yield Check.of(touching_flanks(runs), "running.contacts", float(len(first.model.sprockets)), ">=", message, ("chain",))
    if first.model.sprockets[first.slide].slide and len(first.model.sprockets) == 2:
        off = abs(runs.estimate(mean_of(centre_distance)).value - model.closure.mean)
        message = "mean centre distance of the run off the rigid one: so far off, the chain has left its teeth"
        yield Check("running.centre_distance", off, OFF * model.spec.pitch, "<=", "m", message, ("chain",))


def settled(values: Mapping[str, Value]) -> Check:
    """Whether mean and fluctuation of the centre distance have stopped drifting: the check `settled` counts those that have."""
    names = [f"dynamics.centre_distance.{name}" for name in ("mean", "fluctuation")]
    message = (
        "mean and fluctuation of the centre distance: how many of the two have stopped drifting, over two revolutions of the chain or "
        "more; where one has not, give dynamics.settling and dynamics.duration more"
    )
    count = float(sum(values[name].settled for name in names))
    return Check("settled", count, float(len(names)), ">=", "-", message, ("chain",), label="Settled statistics of centre distance")


def _remarks(runs, values):
    """What keeps the numbers from being the whole truth."""
    drifting = [name for name, value in values.items() if not value.settled]
    if drifting and runs.first.revolutions < 2:
        yield (
            "dynamics.duration holds less than two revolutions of the chain: they cannot tell whether the run has settled; below one, "
            "statistics are those of the whole run and depend on its length"
        )
    elif drifting:
        more = f" and {len(drifting) - MOST_LISTED} more" if len(drifting) > MOST_LISTED else ""
        yield f"not settled: {', '.join(drifting[:MOST_LISTED])}{more}; give dynamics.settling and dynamics.duration more"


def _slipping(values: Mapping[str, Value]) -> Iterator[str]:
    """A warning where pins roll in the model that would slip."""
    used = values.get("dynamics.friction_utilisation")
    if used and used.value > MOST_FRICTION:
        yield (
            f"the pins do not always roll as the model lets them: at moments that takes a coefficient of friction of {used.value:.2g} "
            f"(dynamics.friction_utilisation), and steel on steel has about 0.1 lubricated and {MOST_FRICTION:.2g} dry. Real pins slip "
            "then, in the joint that needs the most; the model has no such slip"
        )


def _runs(model, system):
    """The ensemble of runs, by the integrator asked for."""
    given = model.spec.dynamics
    duration = given.settling + (given.duration or REVOLUTIONS * model.spec.links * tooth_time(system))
    if duration - given.settling < 2 * tooth_time(system):
        raise SpecError(
            f"{1e3 * (duration - given.settling):.4g} ms hold no two teeth of {1e3 * tooth_time(system):.4g} ms; give more",
            "dynamics.duration",
        )
    common = {"settle": given.settling, "tolerance": given.largest_drift, "plate": WATCHED}
    if given.integrator == "implicit":
        settings, solve = implicit.Settings(given.step or IMPLICIT_STEP, **common), implicit.simulate
    else:
        settings, solve = Settings(explicit_step(model, system), **common), simulate
        _refuse_endless(model, duration, settings.step)
    return ensemble(system, duration, settings, given.ensemble, solve=solve)


def _refuse_endless(model, duration, step):
    """SpecError for an explicit run of more steps than anybody waits for."""
    given = model.spec.dynamics
    work = duration / step * model.spec.links * given.ensemble
    if work > MOST_STEPS:
        raise SpecError(
            f"{given.ensemble} runs of {duration:.3g} s in steps of {step:.3g} s take {work:.2g} steps of a link, more than "
            f"{MOST_STEPS:.2g}; shorten the run, lower stiffness or damping, or solve implicitly",
            "dynamics.duration",
        )


def explicit_step(model: ChainModel, system: ChainDrive) -> float:
    """Step of an explicit run [s]: as said, else a microsecond, or less where that is not safe."""
    given = model.spec.dynamics.step
    try:
        return safe_step(system, given)
    except InputError as reason:
        raise SpecError(str(reason), "dynamics.step") from None
