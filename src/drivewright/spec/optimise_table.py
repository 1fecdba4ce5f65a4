"""The [optimise] table: unknowns, requirements and objectives.  The same for every kind of drive."""

from typing import Literal

from drivewright.spec.base import Spec
from drivewright.spec.fields import Bound, Field, Integer, PlainValue, Text


class Unknown(Spec):
    """An unknown of the optimiser: a key of this spec and its bounds."""

    key: Text = Field(description="dotted key of this spec that may change")
    lower: Bound = Field(description="lower bound, in the key's own unit")
    upper: Bound = Field(description="upper bound, in the key's own unit")


class Setting(Spec):
    """A key that has another value during the search and in its outcome."""

    key: Text = Field(description="dotted key of this spec")
    value: PlainValue = Field(description="its value during the search")


class Objective(Spec):
    """A value of the result to be made small or large."""

    value: Text = Field(description="name of a value of the result")
    goal: Literal["minimise", "maximise"] = Field("minimise", description="direction")


class Requirement(Spec):
    """A value of the result that must stay within limits."""

    value: Text = Field(description="name of a value of the result")
    at_least: Bound | None = Field(None, title="Lower limit", description="lower limit, in the value's own unit")
    at_most: Bound | None = Field(None, title="Upper limit", description="upper limit, in the value's own unit")


class Optimise(Spec):
    """What may change, what is required, what is wanted."""

    method: Literal["auto", "differential-evolution", "nsga2"] = Field(
        "auto", description="auto takes differential evolution for one objective and NSGA-II for several"
    )
    seed: Integer = Field(1, ge=0, le=2**31 - 1, description="seed of the random numbers; same seed, same answer")
    population: Integer | None = Field(
        None, ge=8, le=10_000, examples=[60], description="designs per generation; 8 per unknown (at least 16) unless given"
    )
    generations: Integer = Field(400, ge=1, le=100_000, description="generations at most")
    settings: tuple[Setting, ...] = Field((), description="keys set differently for the search")
    unknowns: tuple[Unknown, ...] = Field(min_length=1, description="parameters to vary")
    objectives: tuple[Objective, ...] = Field(min_length=1, description="objectives of the search")
    requirements: tuple[Requirement, ...] = Field((), description="limits that a design must meet")
