"""A pendulum that a cam swings by a motion law of its own."""

from pathlib import Path
from typing import Literal

import numpy as np
from pydantic import Field

from drivewright import motion
from drivewright.registry import Analysis, Mechanism
from drivewright.result import Answer, Check, Column, Plot, Table, Value
from drivewright.spec import MechanismSpec, Spec, Text
from drivewright.units import Angle, Length


def half_cosine():
    """s = (1 - cos pi u)/2, stated by its acceleration."""
    return motion.integrate([motion.wave(1, np.pi / 2, 3 * np.pi / 2)])


class Bob(Spec):
    """What swings."""

    length: Length = Field(gt=0, description="pivot to bob", examples=["1 m"])


class PendulumSpec(MechanismSpec):
    """A driven pendulum."""

    mechanism: Literal["pendulum"] = Field("pendulum", description="kind of drive")
    bob: Bob = Field(description="what swings")
    swing: Angle = Field("30 deg", gt=0, le=np.pi, description="swing from end to end")
    law: Text = Field("half-cosine", description="motion law of the swing")


def build(spec):
    """The model: the spec and its law."""
    return spec, motion.law(spec.law)


def period(model, done):
    """Free period of small swings: T = 2 pi sqrt(L / g)."""
    seconds = 2 * np.pi * np.sqrt(model[0].bob.length / 9.80665)
    return Answer(values={"period": Value(float(seconds), "s", "free period of small swings")})


def path(model, done):
    """The swing over one stroke; the bob must not rise by more than half its length."""
    spec, law = model
    u = np.linspace(0, 1, 11)
    angle = spec.swing * (law(u).s - 0.5)
    rise = spec.bob.length * (1 - float(np.cos(spec.swing / 2)))
    table = Table("swing", "The swing", (Column("u", "-", "part of the stroke", u), Column("angle", "rad", "from the vertical", angle)))
    return Answer(
        values={"rise": Value(rise, "m", "rise of the bob")},
        tables=(table,),
        checks=(Check("rise", rise, spec.bob.length / 2, "<=", "m", "the bob stays low", ("bob",)),),
    )


mechanism = Mechanism(
    kind="pendulum",
    summary="driven pendulum",
    spec=PendulumSpec,
    build=build,
    folder=Path(__file__).parent,
    analyses=(Analysis("period", period, "free period"), Analysis("path", path, "the swing")),
    plots=(Plot("swing", "The swing", "swing", "u", ("angle",)),),
    headline=("period", "rise"),
)
