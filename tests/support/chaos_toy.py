"""A drive whose numbers are drawn: a closed form of its keys, and beside it noise like that of a chaotic run, seeded by the keys.

`level` = size (1 + 0.1 noise), from an ensemble of `members` with `windows` each; without `noise` it is periodic.  `drift` makes it
unsettled.  The keys seed the members, so that the same design has the same bytes wherever it is computed.
"""

import hashlib
from pathlib import Path
from typing import Literal

import numpy as np
from pydantic import Field
from scipy.special import ndtri

from drivewright.numerics.ensemble import estimate
from drivewright.registry import Analysis, Mechanism
from drivewright.result import Answer, Array, Check, Column, Plot, Table, Value
from drivewright.scene import Body, Frame, Scene, Shape, circle
from drivewright.spec import Integer, MechanismSpec, Number
from drivewright.units import Length

LIMIT = 0.012


class Chaotic(MechanismSpec):
    """A toy with chaotic numbers."""

    mechanism: Literal["chaotic-toy"] = Field("chaotic-toy", description="kind of drive")
    size: Length = Field("10 mm", gt=0, description="size")
    load: Number = Field(1.0, description="load")
    noise: Number = Field(0.1, ge=0, description="standard deviation of a window, over the size")
    drift: Number = Field(0.0, description="change from the first window to the last, over the size")
    members: Integer = Field(4, ge=1, description="members of the ensemble")
    windows: Integer = Field(8, ge=2, description="windows of a member")


def samples(spec):
    """(members, windows) of the level."""
    text = repr((spec.size, spec.load, spec.noise, spec.members, spec.windows))
    drawn = np.array([_normal(f"{text} {number}") for number in range(spec.members * spec.windows)])
    return spec.size * spec.load * (1 + spec.noise * drawn.reshape(spec.members, -1) + spec.drift * np.linspace(0, 1, spec.windows))


def _normal(text):
    """A number of the standard normal distribution, the same on every machine for all time."""
    return ndtri((int.from_bytes(hashlib.sha256(text.encode()).digest()[:6]) + 0.5) / 2**48)


def answer(spec, done):
    """Level and its check, the exact area, and how the level follows the window."""
    drawn = samples(spec)
    found = estimate(drawn)
    level = Value.of(found, "m", "level of the drive")
    values = {"level": level, "area": Value(spec.size**2, "m^2", "size squared")}
    checks = (
        Check.of(level, "low_enough", LIMIT, "<=", "the level stays below its limit"),
        Check("settled", float(found.settled), 1.0, ">=", "-", "the level has settled"),
    )
    return Answer(values, (course(drawn),), checks, arrays={"drawn": Array("m", ("member", "window"), (), drawn)})


def course(drawn):
    """Table of the mean of each window with its interval over the members."""
    each = [estimate(drawn[:, [n]]) for n in range(drawn.shape[1])]
    mean = Column("level", "m", "level in the window", np.array([one.value for one in each]))
    ends = mean.bounds([one.low for one in each], [one.high for one in each])
    name = Column("name", "", "name of the window", np.array([f"window {n}" for n in range(len(each))]))
    window = Column("window", "-", "number of the window", np.arange(float(len(each))))
    return Table("course", "Course of the level", (window, mean, *ends, name))


def scene(spec):
    """A disc that rises over the windows."""
    count = spec.windows
    poses = np.column_stack([np.zeros(count), spec.size * np.linspace(0, 1, count), np.zeros(count)])
    disc = Body("disc", "disc", (Shape("profile", circle((0.0, 0.0), spec.size)),), poses)
    frames = (Frame("machine", "machine frame", np.zeros((count, 3))),)
    return Scene(np.arange(float(count)), "number of the window", "-", 1.0, (disc,), frames, table="course")


PLOTS = (
    Plot("course", "Course of the level", "course", "window", ("level",)),
    Plot("points", "Levels of the windows", "course", "window", ("level",), style="points"),
    Plot("stems", "Stems of the windows", "course", "window", ("level",), style="stems"),
    Plot("bars", "Bars of the windows", "course", "name", ("level",), style="bars"),
    Plot("ranked", "Ranks of the windows", "course", "name", ("level",), style="ranked"),
)
CHAOTIC = Mechanism(
    "chaotic-toy",
    "a toy with chaotic numbers",
    Chaotic,
    lambda spec: spec,
    (Analysis("main", answer, "what it is"),),
    Path(__file__).parent,
    scene=scene,
    plots=PLOTS,
    headline=("level", "area"),
)


def install(patch=setattr, mechanism=CHAOTIC):
    """Make the kind known to this process; `patch` may be a monkeypatch's setattr."""
    from drivewright import registry

    kinds, find = registry.kinds, registry.mechanism
    patch(registry, "kinds", lambda: sorted([*kinds(), "chaotic-toy"]))
    patch(registry, "mechanism", lambda kind: mechanism if kind == "chaotic-toy" else find(kind))
