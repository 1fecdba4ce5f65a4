"""A spec of no mechanism: every kind of key once, for the tests of the reader."""

from typing import Literal

from pydantic import Field

from drivewright import registry
from drivewright.spec import DataFile, Flag, Integer, MechanismSpec, Number, Spec, Text
from drivewright.units import Angle, Length, Speed


class Joint(Spec):
    """A joint."""

    name: Text = Field(description="name", examples=["crank"])
    clearance: Length = Field("0.1 mm", ge=0, description="radial play")
    at: tuple[Length, Length] | None = Field(None, description="place")


class Spring(Spec):
    """A spring."""

    rate: Number = Field(gt=0, description="rate", examples=[2.0])
    preload: Number = Field(1.5, description="preload")


class Drive(Spec):
    """The drive."""

    speed: Speed = Field("100 rpm", gt=0, description="speed")
    sense: Literal["forward", "backward"] = Field("forward", description="sense")


class ToySpec(MechanismSpec):
    """A toy."""

    mechanism: Literal["toy"] = Field("toy", description="kind")
    length: Length = Field(gt=0, lt=2, description="length", examples=["40 mm"])
    tilt: Angle = Field("0 deg", ge=-1, le=1, description="tilt")
    turns: Integer = Field(3, ge=1, le=9, description="turns")
    ratio: Number = Field(0.5, gt=0, le=1, description="ratio")
    mirrored: Flag = Field(False, description="mirrored")
    weights: tuple[Number, ...] = Field((1.0, 2.0), max_length=4, description="weights")
    points: tuple[tuple[Number, Number], ...] | None = Field(None, description="points")
    table: DataFile | None = Field(None, description="table")
    second: DataFile | None = Field(None, description="second table")
    drive: Drive = Field(Drive(), description="drive")
    spring: Spring | None = Field(None, description="spring")
    joints: tuple[Joint, ...] = Field((), description="joints")


def install(monkeypatch, folder, *analyses, build=lambda spec: spec):
    """Make the kind "toy" known for one test, with `folder/presets`."""
    toy = registry.Mechanism("toy", "a toy", ToySpec, build, analyses, folder)
    kinds, find = registry.kinds, registry.mechanism
    monkeypatch.setattr(registry, "kinds", lambda: sorted([*kinds(), "toy"]))
    monkeypatch.setattr(registry, "mechanism", lambda kind: toy if kind == "toy" else find(kind))


FULL = """
mechanism = "toy"
title = "a toy"
length = "40 mm"
tilt = "-30 deg"
turns = 4
ratio = 0.25
mirrored = true
weights = [3.0]
points = [[0.0, 0.5], [1.0, 0.25]]
table = "lift.csv"

[drive]
speed = "2 rev/s"
sense = "backward"

[spring]
rate = 7.0

[[joints]]
name = "crank"
clearance = "0.02 mm"
at = ["1 mm", "-2 mm"]

[[joints]]
name = "rocker"

[optimise]

[[optimise.unknowns]]
key = "joints.rocker.clearance"
lower = "10 um"
upper = "0.1 mm"

[[optimise.objectives]]
value = "miss"

[[optimise.requirements]]
value = "swing"
at_least = "30 deg"

[[optimise.settings]]
key = "turns"
value = 2
"""
