"""Many cases through one function: `run(task, cases, workers, progress)`, here and for the analyses of a mechanism alike."""

from drivewright.cases import Outcome, Outcomes, run

__all__ = ["Outcome", "Outcomes", "run"]
