"""Whether both strands are in tension, which the statics of the drive assumes: a check, and a warning where one would be compressed."""

from collections.abc import Iterator

from drivewright.mechanisms.silent_chain.build import ChainModel
from drivewright.result import Answers, Check

NAME = "strand.taut"
ROUNDING = 1e-9  # of the tight strand's tension


def slack_pull(model: ChainModel) -> float:
    """Tension of the slackest strand without the centrifugal tension [N]; below 0 it would be compressed, which no chain can be."""
    forces = model.strands
    return 0.0 if abs(forces.slack) < ROUNDING * abs(forces.tight) else forces.slack


def taut_checks(model: ChainModel, done: Answers) -> Iterator[Check]:
    """The check of it, in the first analysis of a run that needs the tensions of the strands."""
    if model.spec.drive and not any(check.name == NAME for answer in done.values() for check in answer.checks):
        message = (
            "tension of the slack strand under preload and load torque, without the centrifugal tension; a larger preload or tensioner "
            "force increases it"
        )
        yield Check(NAME, slack_pull(model), 0.0, ">=", "N", message, ("chain",), label="Slack strand tension")


def slack_warnings(model: ChainModel) -> Iterator[str]:
    """A warning where a strand would be compressed."""
    pull = slack_pull(model) if model.spec.drive else 0.0
    if pull >= 0:
        return
    forces = model.strands
    if model.plain:
        least = model.preload * (forces.tight - forces.slack) / (forces.tight + forces.slack)
        advice = f"A drive.preload above {least:.4g} N keeps both strands in tension"
    else:
        advice = "Raise the tensioner's force, move the tensioner to the slack strand, or lower the load torque"
    yield (
        f"the slack strand would be compressed by {-pull:.4g} N, which a chain cannot carry: the drive does not transmit this load, and "
        f"the computed forces, safety factors and wear are not valid. {advice}"
    )
