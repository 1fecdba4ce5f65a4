"""How a running chain fails: no tension, teeth jumped over, tooth contact lost; and up to which time a run is valid."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.chains.explicit.ensemble import Ensemble
from drivewright.chains.explicit.motion import Motion
from drivewright.chains.model import ChainDrive

SLACK = 3  # joints without tension make a slack piece of chain; single ones come and go where plates seat
JUMP = 0.5  # of a tooth: a sprocket that is so far off has let the chain pass by one


class Failure(NamedTuple):
    """samples that can be believed, of the first that cannot the time [s], and why; all of them and an empty reason for a sound run."""

    samples: int
    time: float
    reason: str


def jumps(run: Motion) -> Floats:
    """By how many teeth every sprocket is off the driver (m, sprockets), in the sense in which it turns."""
    every = range(len(run.model.sprockets))
    return np.stack([run.transmission_error(n) * run.model.sprockets[n].tooth.teeth / (2 * np.pi) for n in every], axis=1)


def failure(run: Motion) -> Failure:
    """Until when a run can be believed: no number is lost and no tooth jumped."""
    finite = np.all(np.isfinite(run.rows), axis=1) & np.all(np.isfinite(run.bodies), axis=(1, 2))
    with np.errstate(invalid="ignore"):
        off = np.abs(jumps(run)) > JUMP
    bad = ~finite | np.any(off, axis=1)
    if not np.any(bad):
        return Failure(len(run.t), float(run.t[-1]), "")
    first = int(np.argmax(bad))
    time = float(run.t[max(first - 1, 0)])
    if not finite[first]:
        return Failure(max(first, 1), time, "the motion diverges")
    number = int(np.argmax(off[first]))
    name = run.model.sprockets[number].name or ("the driven sprocket" if number == run.model.measured else f"sprocket {number + 1}")
    return Failure(max(first, 2), time, f"the chain jumps a tooth on {name}")


def until(run: Motion, samples: int) -> Motion:
    """The run up to so many samples, without any settling."""
    kept = {name: getattr(run, name)[:samples] for name in ("rows", "bodies", "tension", "plate")}
    return replace(run, settings=replace(run.settings, settle=0.0), **kept)  # pyright: ignore[reportArgumentType]  every settings is a dataclass


def first_failure(runs: Ensemble) -> tuple[Motion, Failure]:
    """The member of an ensemble that fails first, and how; the first one where none does."""
    found = [(run, failure(run)) for run in runs.members]
    failed = [each for each in found if each[1].reason]
    return min(failed, key=lambda each: each[1].time) if failed else found[0]


def slack_share(run: Motion) -> float:
    """Share of the samples in which `SLACK` joints or more are without tension at once  [-]."""
    return float(np.mean(run.column("open joints")[run.steady] >= SLACK))


def jumped_teeth(run: Motion) -> int:
    """The most teeth by which the chain has moved against a sprocket."""
    seen = jumps(run)
    return int(np.max(np.floor(np.abs(seen[np.isfinite(seen)]) + 1 - JUMP)))


def seated_links(model: ChainDrive, wraps: Floats) -> float:
    """Links that lie on the sprockets, by their wraps (sprockets,) [rad]."""
    teeth = np.array([sprocket.tooth.teeth for sprocket in model.sprockets])
    return float(np.sum(teeth * wraps) / (2 * np.pi))
