"""Whether both strands pull, which the statics of the drive takes for granted: a check, and what to say where one would have to push."""

from collections.abc import Iterator

from drivewright.mechanisms.silent_chain.build import ChainModel
from drivewright.result import Answers, Check

NAME = "strand.taut"
ROUNDING = 1e-9  # of the tight strand's pull


def slack_pull(model: ChainModel) -> float:
    """Pull of the slackest strand without the centrifugal force [N]; below 0 it would have to push, which no chain can."""
    forces = model.strands
    return 0.0 if abs(forces.slack) < ROUNDING * abs(forces.tight) else forces.slack


def taut_checks(model: ChainModel, done: Answers) -> Iterator[Check]:
    """The check of it, in the first analysis of a run that needs the strands' forces."""
    if model.spec.drive and not any(check.name == NAME for answer in done.values() for check in answer.checks):
        message = "force of the slack strand under preload and load torque, without the centrifugal force"
        yield Check(NAME, slack_pull(model), 0.0, ">=", "N", message, ("chain",), label="Pull of the slack strand")


def slack_warnings(model: ChainModel) -> Iterator[str]:
    """A warning where a strand would have to push."""
    pull = slack_pull(model) if model.spec.drive else 0.0
    if pull >= 0:
        return
    forces = model.strands
    if model.plain:
        least = model.preload * (forces.tight - forces.slack) / (forces.tight + forces.slack)
        advice = f"A drive.preload above {least:.4g} N makes both strands pull"
    else:
        advice = "Raise the tensioner's force or move it to the slack strand, or lower the load torque"
    yield (
        f"the slack strand would have to push with {-pull:.4g} N, which a chain cannot do: the drive does not carry this load, and its "
        f"forces, safety factors and wear are those of no real drive. {advice}"
    )
