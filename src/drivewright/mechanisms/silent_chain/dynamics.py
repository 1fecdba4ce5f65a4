"""The running chain: centre distance, forces, orders and balances, over revolutions of the chain after it has settled, in an ensemble."""

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from drivewright.chains.explicit.ensemble import Ensemble, ensemble, mean_of
from drivewright.chains.explicit.failure import SLACK, Failure, first_failure, jumped_teeth, seated_links, slack_share, until
from drivewright.chains.explicit.motion import Motion
from drivewright.chains.explicit.signals import MIDDLE, tensioners
from drivewright.chains.explicit.simulate import Settings, simulate, tooth_time
from drivewright.chains.explicit.stability import safe_step
from drivewright.chains.explicit.statistics import force_values, signal_values, strand_values, tensioner_values, touching_flanks
from drivewright.chains.explicit.tables import signal_table, spectrum_table, tensioner_table
from drivewright.chains.implicit import simulate as implicit
from drivewright.chains.model import ChainDrive
from drivewright.errors import InputError, SpecError
from drivewright.mechanisms.silent_chain.build import ChainModel
from drivewright.mechanisms.silent_chain.chain_drive import chain_drive
from drivewright.mechanisms.silent_chain.missing import unless_impossible
from drivewright.result import Answer, Answers, Check, Value
from drivewright.stops import Stop

IMPLICIT_STEP = 1e-5  # [s]
OFF = 0.25  # of the pitch: a mean centre distance so far from the rigid one is that of a chain off its teeth
REVOLUTIONS = 2  # of the chain, that are evaluated by default
MOST_STEPS = 2e10  # of a link, in all runs: about ten minutes
MOST_LISTED = 3  # statistics that have not settled, by name
MOST_FRICTION = 0.3  # coefficient of friction of dry steel on steel; lubricated about 0.1
HINT = (
    "raise the preload or the tensioner's force, increase the damping of the tensioner, or reduce the speed or the wear; the check "
    "strand.taut shows whether the slack strand is under tension, and the analysis 'quasi_static' computes the chain at rest under its load"
)
ORDERS = 8  # of the mesh frequency, up to which the spectrum is shown
WATCHED = 0


@unless_impossible
def dynamics(model: ChainModel, done: Answers) -> Answer:
    """The runs, their statistics, spectrum and balances; of a run that failed what it was up to then."""
    runs = _runs(model, chain_drive(model))
    member, failed = first_failure(runs)
    if failed.reason:
        return _broken_off(model, until(member, failed.samples), failed, float(member.t[-1]))
    drift = Value(
        runs.energy_drift, "1/s", "numerical energy gain or loss per second, relative to the stored energy", label="Relative energy drift"
    )
    message = f"{drift.meaning}; a shorter step reduces it"
    checks = (
        Check("energy_drift", drift.value, model.spec.dynamics.largest_drift, "<=", "1/s", message, ("chain",), label=drift.label),
        *_seated(model, runs),
        *_whole(model, runs.members),
    )
    tables = (signal_table(runs.first), spectrum_table(runs, ORDERS), *_tensioner_tables(runs.first))
    reasons = [runs.advice] if runs.advice else []
    reasons += [_failing(check) for check in checks if not check.ok and check.name != "energy_drift"]
    if reasons:
        findings = (f"the run failed and its statistics are left out: {'; '.join(reasons)}. {_hint(runs.advice)}",)
        return Answer({"dynamics.energy_drift": drift}, tables, checks, findings, outcome="partial")
    found = signal_values(runs) | force_values(runs) | tensioner_values(runs)
    if not model.plain:
        found |= strand_values(runs, model.balance)
    values = {f"dynamics.{name}": value for name, value in found.items()}
    checks = (*checks, settled(values), *_travels(model, values))
    values["dynamics.energy_drift"] = drift
    return Answer(values, tables, checks, tuple(_remarks(runs, values)), data=runs, warnings=tuple(_slipping(values)))


def _failing(check: Check) -> str:
    """What a check found, in numbers."""
    most = "at most" if check.sense == "<=" else "at least"
    unit = "" if check.unit == "-" else f" {check.unit}"
    return f"{check.name} is {check.value:.3g}{unit} and must be {most} {check.limit:.3g}{unit} ({check.message})"


def _hint(advice: str = "") -> str:
    """What to try; after the run's own advice, which is a shorter step."""
    return f"Where a shorter step does not help, {HINT}" if advice else f"{HINT[0].upper()}{HINT[1:]}"


def _broken_off(model: ChainModel, run: Motion, failed: Failure, end: float) -> Answer:
    """What a run was up to where it failed: values of that part, checks of the whole."""
    stop = Stop(f"the run of the chain is valid up to t = {failed.time:.4g} s of {end:.4g} s", failed.reason)
    tension = run.tension[:, 0]
    values = {
        "dynamics.tension.mean": Value(float(np.mean(tension)), "N", "mean tension of a joint", label="Joint tension, mean"),
        "dynamics.tension.maximum": Value(float(np.max(tension)), "N", "maximum tension of a joint", label="Joint tension, maximum"),
        "dynamics.transmission_error": Value(
            run.fluctuation(run.transmission_error(run.model.measured)),
            "rad",
            "transmission error of the running chain, peak-to-peak: angle of the driven sprocket minus that by the tooth ratio",
            label="Dynamic transmission error, peak-to-peak",
        ),
        "dynamics.stop_time": Value(failed.time, "s", "time up to which the run of the chain is valid", label="Valid time of the run"),
    }
    checks = tuple(_whole(model, (run,), 1 if "jumps" in failed.reason else 0))
    tables = (signal_table(run), *_tensioner_tables(run)) if len(run.t) > 2 else ()
    return Answer(
        values,
        tables,
        checks,
        (f"the run failed and its statistics are left out: {failed.reason}. {_hint()}",),
        outcome="partial",
        stopped=(stop,),
    )


def _tensioner_tables(run):
    return (tensioner_table(run),) if tensioners(run.model) else ()


def _whole(model: ChainModel, members: Sequence[Motion], jumped: int = 0) -> Iterator[Check]:
    """Whether the chain keeps its tension, its teeth and its contact with them."""
    limits, seated = model.spec.limits, _seated_links(model, members[0].model)
    touching = min(run.mean(run.column("contacts")) for run in members) / seated
    message = (
        "mean number of tooth contacts for each link on a sprocket; few contacts mean overspeed, where centrifugal tension and impacts "
        "of the teeth lift the chain off: lower the speed or increase the preload"
    )
    label = "Tooth contacts per seated link"
    yield Check("running.tooth_contacts", touching, limits.contact_share, ">=", "-", message, ("chain",), label=label)
    message = (
        f"share of time in which {SLACK} or more joints have no tension at once, so that a strand is slack; increase the preload, or add a "
        "tensioner"
    )
    slack = max(slack_share(run) for run in members)
    yield Check("running.slack", slack, limits.slack_share, "<=", "-", message, ("chain",), label="Share of time with slack joints")
    teeth = max(jumped, *(jumped_teeth(run) for run in members))
    message = "number of teeth that the chain has jumped on a sprocket; more tension or a larger wrap angle prevents it"
    yield Check("running.jumped_teeth", float(teeth), 0.0, "<=", "-", message, ("chain",), label="Jumped teeth")


def _seated_links(model, system):
    """Links on all sprockets."""
    if model.plain:
        return float(np.sum(model.closure.states.seated[0]))
    found = model.balance.route
    wraps = np.array([found.wraps[found.place(n)] for n in range(len(system.sprockets))])
    return seated_links(system, wraps)


def _travels(model: ChainModel, values: Mapping[str, Value]) -> Iterator[Check]:
    """Mean travel of each tensioner against the room that it has."""
    for entry in (*model.spec.sprockets, *model.spec.guides):
        if entry.force is not None and entry.travel is not None:
            value = abs(values[f"dynamics.tensioner.{entry.name}.travel.mean"].value)
            message = f"mean travel of tensioner {entry.name}, either way; if it exceeds the limit, give more travel or move the tensioner"
            label = f"Mean travel of tensioner {entry.name}"
            yield Check(f"running.travel.{entry.name}", value, entry.travel, "<=", "m", message, (entry.name,), label=label)


def _seated(model: ChainModel, runs: Ensemble) -> Iterator[Check]:
    """Whether the chain is still on its teeth."""
    first = runs.first
    message = "mean number of tooth contacts, at least one on each sprocket; with fewer the chain has left its teeth"
    touching, least = touching_flanks(runs), float(len(first.model.sprockets))
    yield Check.of(touching, "running.contacts", least, ">=", message, ("chain",), "Mean number of tooth contacts")
    if model.plain:
        off = abs(runs.estimate(mean_of(lambda run: run.centre_distance)).value - model.closure.mean)
        message = "mean centre distance of the run minus that of the rigid chain, magnitude; beyond the limit the chain has left its teeth"
        label = "Deviation of the mean centre distance"
        yield Check("running.centre_distance", off, OFF * model.spec.pitch, "<=", "m", message, ("chain",), label=label)


def settled(values: Mapping[str, Value]) -> Check:
    """Whether mean and fluctuation of the signal have stopped drifting: the check `settled` counts those that have."""
    slides = "dynamics.centre_distance.mean" in values
    first = "dynamics.centre_distance" if slides else next((n.removesuffix(".mean") for n in values if n.endswith(".travel.mean")), None)
    names = [f"{first}.{name}" for name in ("mean", "fluctuation")] if first else ["dynamics.transmission_error", "dynamics.tension.mean"]
    signal = "centre distance" if slides else "tensioner travel"
    statistics = f"mean and peak-to-peak {signal}" if first else "transmission error and mean tension"
    message = (
        f"number of settled statistics ({statistics}) over two or more revolutions of the chain; if one is missing, increase "
        "dynamics.settling and dynamics.duration"
    )
    label = f"Settled statistics, {signal}" if first else "Settled transmission error and tension"
    count = float(sum(values[name].settled for name in names))
    return Check("settled", count, float(len(names)), ">=", "-", message, ("chain",), label=label)


def _remarks(runs, values):
    """Findings on statistics that have not settled."""
    drifting = [name for name, value in values.items() if not value.settled]
    if not runs.stable:
        yield (
            f"the motion is unstable: the difference between two runs whose starts differ by nanometres grows {runs.growth:.2g}-fold from "
            "the first evaluated revolution of the chain to the last; the chain will settle to another motion, increase dynamics.settling"
        )
    elif drifting and runs.first.revolutions < 2:
        yield (
            "dynamics.duration is shorter than two revolutions of the chain, from which settling cannot be judged; below one revolution "
            "the statistics are those of the whole run and depend on its length: increase dynamics.duration"
        )
    elif drifting:
        more = f" and {len(drifting) - MOST_LISTED} more" if len(drifting) > MOST_LISTED else ""
        yield f"not settled: {', '.join(drifting[:MOST_LISTED])}{more}; increase dynamics.settling and dynamics.duration"


def _slipping(values: Mapping[str, Value]) -> Iterator[str]:
    """A warning where pins roll in the model that would slip."""
    used = values.get("dynamics.friction_utilisation")
    if used and used.value > MOST_FRICTION:
        yield (
            f"the pins roll without slip in the model, which at times requires a coefficient of friction of {used.value:.2g} "
            f"(dynamics.friction_utilisation); steel on steel has about 0.1 lubricated and {MOST_FRICTION:.2g} dry. Real pins slip then, "
            "which the model does not include"
        )


def _runs(model, system):
    """The ensemble of runs, by the given integrator."""
    given = model.spec.dynamics
    duration = given.settling + (given.duration or REVOLUTIONS * model.spec.links * tooth_time(system))
    if duration - given.settling < 2 * tooth_time(system):
        raise SpecError(
            f"{1e3 * (duration - given.settling):.4g} ms is shorter than two teeth of {1e3 * tooth_time(system):.4g} ms each; increase it",
            "dynamics.duration",
        )
    joints = (WATCHED,) if model.plain else _recorded(model)
    common = {"settle": given.settling, "tolerance": given.largest_drift, "plate": WATCHED, "joints": joints}
    if given.integrator == "implicit":
        settings, solve = implicit.Settings(given.step or IMPLICIT_STEP, **common), implicit.simulate
    else:
        settings, solve = Settings(explicit_step(model, system), **common), simulate
        _refuse_endless(model, duration, settings.step)
    return ensemble(system, duration, settings, given.ensemble, solve=solve)


def _recorded(model):
    """Joints whose tension is recorded: so many that one is in the middle of every strand at any time."""
    stride = int(MIDDLE * np.min(model.balance.route.lengths) / model.spec.pitch)
    return tuple(range(WATCHED, model.spec.links, max(1, stride)))


def _refuse_endless(model, duration, step):
    """SpecError for an explicit run of more than `MOST_STEPS` steps."""
    given = model.spec.dynamics
    work = duration / step * model.spec.links * given.ensemble
    if work > MOST_STEPS:
        raise SpecError(
            f"{given.ensemble} runs of {duration:.3g} s in steps of {step:.3g} s take {work:.2g} steps of a link, more than "
            f'the limit of {MOST_STEPS:.2g}; shorten the run, reduce stiffness or damping, or take integrator = "implicit"',
            "dynamics.duration",
        )


def explicit_step(model: ChainModel, system: ChainDrive) -> float:
    """Step of an explicit run [s]: as given, else a microsecond, or less where that is not safe."""
    given = model.spec.dynamics.step
    try:
        return safe_step(system, given)
    except InputError as reason:
        raise SpecError(str(reason), "dynamics.step") from None
