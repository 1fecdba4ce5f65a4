"""Many linkages at once: the values of a run without its tables, of one turn where every turn is like it."""

from collections.abc import Callable, Iterable, Sequence
from functools import partial
from typing import NamedTuple

from drivewright._typing import Floats
from drivewright.errors import DrivewrightError, SolverError
from drivewright.mechanisms.linkage.advice import advice
from drivewright.mechanisms.linkage.analyses import ANALYSES
from drivewright.mechanisms.linkage.build import LinkageModel, build
from drivewright.mechanisms.linkage.refusals import refuse_nonsense
from drivewright.mechanisms.linkage.spec import LinkageSpec
from drivewright.multibody.analyses.energy import drive_torque, work_audit
from drivewright.multibody.analyses.joint_forces import largest_joint_forces
from drivewright.multibody.analyses.outputs import output_values
from drivewright.multibody.analyses.repeated_turn import repeated_turn
from drivewright.multibody.analyses.simulation_model import run_of
from drivewright.multibody.analyses.singular_positions import passage_count
from drivewright.result import Answer
from drivewright.spec import value_at
from drivewright.spec.designs import accepted_blocks, evaluator_of_blocks, numbers_of, with_columns, with_samples, within_limits

TABLES = ("gravity", "ground", "bodies", "joints", "springs", "rotational_springs", "torques", "forces", "drive", "simulate", "limits")


class Measure(NamedTuple):
    """A function that gives some of the values; `of_turn`: those of one turn, where every turn is like it."""

    answer: Callable[[LinkageModel], Answer]
    of_turn: bool = False


MEASURES = (
    Measure(lambda model: Answer(checks=advice(model.spec)), of_turn=True),
    Measure(lambda model: Answer(output_values(model)), of_turn=True),
    Measure(drive_torque, of_turn=True),
    Measure(passage_count, of_turn=True),
    Measure(lambda model: Answer(largest_joint_forces(model)), of_turn=True),
    Measure(work_audit),
)


def batch(spec: LinkageSpec, keys: Sequence[str], names: Sequence[str]) -> Callable[[Floats], dict[str, Floats]] | None:
    """designs (n, d) -> {name: (n,)}; None where a key or a value is beyond it, or where the linkage is more than kinematics.

    A design that is refused, does not assemble or cannot go round is nan in every name.
    """
    if not all(_is_number(spec, key) for key in keys):
        return None
    measures = _measures(with_samples(spec, keys), names)
    if measures is None:
        return None

    def one_by_one(columns, rows):
        """(rows, {name: number}) of the designs that nothing refuses."""

        def measured(row):
            return _measured(with_columns(spec, {key: float(column[row[0]]) for key, column in columns.items()}), measures)

        return accepted_blocks(rows, measured, 1)

    return evaluator_of_blocks(keys, names, partial(within_limits, type(spec)), one_by_one)


def _is_number(spec, key):
    """Whether a key is a number, and no count, of a table that shapes the run."""
    own = value_at(spec, key)
    return key.split(".")[0] in TABLES and (own is None or isinstance(own, float))


def _measured(spec, measures):
    """{name: number} of one design."""
    refuse_nonsense(spec)
    return _values(build(spec), measures)


def _values(model, measures):
    """{name: number} by the measures; SolverError where the run ends before its time."""
    turn = repeated_turn(model) if any(measure.of_turn for measure in measures) else model
    if run_of(turn).advice:
        raise SolverError(run_of(turn).advice)
    return {name: number for measure in measures for name, number in numbers_of(measure.answer(turn if measure.of_turn else model))}


def _measures(spec: LinkageSpec, names: Iterable[str]) -> list[Measure] | None:
    """The measures that give these names, those of a turn first; None where one of the names is not among them, or there is freedom."""
    try:
        model = build(spec)
        if model.assembly.freedom or model.has_play or spec.duration is None and spec.period is None:
            return None
        missing, chosen = set(names), []
        for measure in (*MEASURES, *_whole_analyses(spec)):
            own = _values(model, [measure]).keys() & missing if missing else ()
            if own:
                chosen.append(measure)
                missing -= own
    except DrivewrightError:  # the run of one design says why
        return None
    return None if missing else chosen


def _whole_analyses(spec):
    """The analyses that a run uses by default, tables and all, as measures."""
    return [_whole(analysis) for analysis in ANALYSES if analysis.default and analysis.missing(spec) is None]


def _whole(analysis):
    return Measure(lambda model: analysis.answer(model, {}))
