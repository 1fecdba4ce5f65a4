"""The [study] table: what varies from case to case, how it is sampled, what is kept.  The same for every kind of drive."""

import re
from typing import Annotated, Literal, TypeAlias

from pydantic import BeforeValidator, WrapValidator

from drivewright.spec.base import Spec
from drivewright.spec.fields import Bound, DataFile, Field, Flag, Integer, PlainValue, Text

PERCENT = re.compile(r"\s*([+-]?)\s*([0-9]{1,9}(?:\.[0-9]{0,15})?|\.[0-9]{1,15})\s*%\s*")

METHODS = Literal["latin-hypercube", "sobol", "random", "corners", "one-at-a-time", "tolerance", "sobol-indices"]


def percentage(value: object) -> tuple[str, float] | None:
    """(sign, share) of a text in percent: ("-", -0.05) of "-5 %", ("", 0.05) of "5 %"; None of anything else."""
    match = PERCENT.fullmatch(value) if isinstance(value, str) else None
    return (match[1], float(f"{match[1]}{match[2]}") / 100) if match else None


RelativeBound: TypeAlias = Annotated[Bound, WrapValidator(lambda value, read: value if percentage(value) else read(value))]


OneOrMany: TypeAlias = Annotated[tuple[Text, ...], BeforeValidator(lambda value: (value,) if isinstance(value, str) else value)]


class Vary(Spec):
    """A key of this spec that varies: over levels (`values`, or `lower`, `upper` and `steps`), or as a random number."""

    key: Text = Field(description="dotted key of this spec")
    also: OneOrMany = Field((), description="further keys that always have the same value; -KEY for one with the negative value")
    link: Text | None = Field(
        None, description='instead of all below: follows another key, "-2 * KEY" or "0.5 * KEY + 3 mm"', examples=["-2 * loads.0.force"]
    )
    values: tuple[PlainValue, ...] = Field((), description="its levels, one by one")
    lower: RelativeBound | None = Field(
        None, description='lowest level, or lower end of the distribution; "-5 %": below the value of the spec'
    )
    upper: RelativeBound | None = Field(
        None, description='highest level, or upper end of the distribution; "+5 %": above the value of the spec'
    )
    steps: Integer | None = Field(None, ge=1, le=100_000_000, description="number of levels from lower to upper")
    spacing: Literal["linear", "logarithmic"] = Field("linear", description="of the levels")
    distribution: Literal["normal", "uniform", "triangular"] | None = Field(
        None, description="normal where sigma or tolerance is given, else uniform from lower to upper"
    )
    mean: Bound | None = Field(None, description="of a normal distribution; the spec's own value unless given")
    sigma: RelativeBound | None = Field(
        None, description='standard deviation of a normal distribution, or "2 %" of its middle; a third of the tolerance unless given'
    )
    mode: Bound | None = Field(None, description="peak of a triangular distribution; the spec's own value unless given")
    tolerance: RelativeBound | None = Field(
        None, description='half the width about the spec\'s own value, or "5 %" of that, instead of lower and upper'
    )


class Study(Spec):
    """Many cases of this spec: levels are crossed with each other, and each of their combinations with the random sample."""

    method: METHODS = Field(
        "latin-hypercube",
        description="how random keys are sampled; corners: all ends; one-at-a-time: each a step up and down; tolerance: these three and a "
        "sample; sobol-indices: a sample for the variance that each key causes",
    )
    samples: Integer = Field(1000, ge=1, le=100_000_000, description="size of the random sample")
    seed: Integer = Field(1, ge=0, le=2**31 - 1, description="seed of the random numbers; same seed, same cases")
    analyses: tuple[Text, ...] = Field((), description="analyses to run; the default ones unless given")
    every_analysis: Flag = Field(False, description="run every analysis, also those on request")
    values: tuple[Text, ...] = Field((), description="values and checks (as check.NAME) to keep; all unless given")
    points: DataFile | None = Field(None, description="CSV or Parquet file of cases, a column per key: key [unit]")
    vary: tuple[Vary, ...] = Field((), description="parameters that vary")
