"""A drive that is nothing but its spec: every type of key, every way to end, and answers that are closed forms of the keys."""

import math
import time
from pathlib import Path
from typing import Literal

from pydantic import Field

from drivewright import registry
from drivewright.errors import InputError, SolverError
from drivewright.registry import Analysis, Mechanism
from drivewright.result import Answer, Check, Value
from drivewright.spec import DataFile, Flag, Integer, MechanismSpec, Name, Named, Number, Spec, Text
from drivewright.units import Angle, Force, Length, Mass

SLOW, FAULTY, GIVES_UP = 99, 13, 7  # counts with a meaning
PATIENCE = 0.05  # seconds that a slow case takes


class Part(Spec):
    """One of a list."""

    name: Name | None = Field(None, description="name")
    width: Length = Field("5 mm", description="width")


class Body(Spec):
    """One of a dictionary."""

    mass: Mass = Field("1 kg", description="mass")
    at: tuple[Length, Length] = Field(("1 mm", "2 mm"), description="place")


class Toy(MechanismSpec):
    """A toy."""

    mechanism: Literal["toy"] = Field("toy", description="kind of drive")
    size: Length = Field("10 mm", gt=0, description="size")
    offset: Length | None = Field(None, description="a key without a value")
    force: Force = Field("2 N", description="force")
    angle: Angle = Field("30 deg", description="angle")
    ratio: Number = Field(0.25, description="plain number")
    count: Integer = Field(2, description="whole number")
    flag: Flag = Field(False, description="true or false")
    colour: Text = Field("red", description="any text")
    form: Literal["round", "square"] = Field("round", description="one of two")
    table: DataFile | None = Field(None, description="a file")
    teeth: tuple[Integer, Integer] = Field((17, 23), description="a list of numbers")
    parts: tuple[Part, ...] = Field((), description="a list of tables")
    bodies: Named[Body] = Field({}, description="tables by name")


def answer(spec, done):
    """size (like its key), area = size^2, root = sqrt(ratio) if there is one, bonus only with the flag; size is to stay below 12 mm."""
    if spec.colour == "black":
        raise InputError("colour: black cannot be seen; take another one")
    if spec.count == FAULTY:
        raise ZeroDivisionError("unlucky number")
    if spec.count == SLOW:
        time.sleep(PATIENCE)
    values = {"size": Value(spec.size, "m", "size again"), "area": Value(spec.size**2, "m^2", "size squared")}
    if spec.count == GIVES_UP:
        raise SolverError("7 steps were not enough; raise max_steps", Answer(values=values, findings=("half of it is done",)))
    values["root"] = Value(math.sqrt(spec.ratio) if spec.ratio >= 0 else math.nan, "-", "square root of ratio")
    if spec.flag:
        values["bonus"] = Value(1.0 + spec.count, "-", "only with the flag")
    return Answer(values=values, checks=(Check("small", spec.size, 0.012, "<=", "m", "it fits"),))


def more(spec, done):
    """force / size."""
    return Answer(values={"more": Value(spec.force / spec.size, "N/m", "force per size")})


TOY = Mechanism(
    "toy",
    "a toy",
    Toy,
    lambda spec: spec,
    (Analysis("main", answer, "what it is"), Analysis("more", more, "more", False)),
    Path(__file__).parent,
    headline=("area", "root"),
)


def exact(spec, keys, names):
    """A compiled route for size and ratio that gives the numbers of a run, up to rounding."""
    return _batch(spec, keys, names, 1 + 1e-11)


def rough(spec, keys, names):
    """The same, off by one in a thousand."""
    return _batch(spec, keys, names, 1.001)


def _batch(spec, keys, names, factor):
    import numpy as np

    if not set(keys) <= {"size", "ratio"} or not set(names) <= {"size", "area", "root", "check.small"}:
        return None

    def evaluate(designs):
        columns = {"size": np.full(len(designs), spec.size), "ratio": np.full(len(designs), spec.ratio)}
        columns |= dict(zip(keys, np.asarray(designs).T, strict=True))
        size, ratio = columns["size"], columns["ratio"]
        known = {"size": size, "area": factor * size**2, "root": np.sqrt(np.maximum(ratio, 0)), "check.small": 0.012 - size}
        bad = (size <= 0) | (ratio < 0)
        return {name: np.where(bad, np.nan, known[name]) for name in names}

    return evaluate


def install(patch=setattr, mechanism=TOY):
    """Make the kind "toy" known to this process; `patch` may be a monkeypatch's setattr."""
    kinds, find = registry.kinds, registry.mechanism
    patch(registry, "kinds", lambda: sorted([*kinds(), "toy"]))
    patch(registry, "mechanism", lambda kind: mechanism if kind == "toy" else find(kind))
