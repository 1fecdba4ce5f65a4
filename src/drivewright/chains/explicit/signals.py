"""Signals of the uniformity of a drive: the centre distance of a sliding driven sprocket, the travel of tensioners, else the transmission
error."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.chains.explicit.motion import Motion
from drivewright.chains.model import ChainDrive
from drivewright.chains.path.balance import Balance
from drivewright.chains.path.route import bodies

MIDDLE = 0.6  # of a strand, whose joints tell its tension


class Signal(NamedTuple):
    """A signal of a run: name, unit, what it is, its samples (m,) of a run, and the beginning of its labels."""

    name: str
    unit: str
    words: str
    of: Callable[[Motion], Floats]
    label: str


def signals(model: ChainDrive) -> tuple[Signal, ...]:
    """The signals of a drive, first the one by which its evenness is judged."""
    found = []
    if model.sprockets[model.measured].slide:
        found.append(Signal("centre_distance", "m", "centre distance", lambda run: run.centre_distance, "Dynamic centre distance"))
    found += [travel(model, number) for number in tensioners(model)]
    return (*found, transmission_error(model.measured))


def tensioners(model: ChainDrive) -> tuple[int, ...]:
    """Numbers of the bodies that slide or turn about a pivot, without the driven sprocket."""
    return tuple(n for n, body in enumerate(bodies(model)) if body.slide and n != model.measured)


def travel(model: ChainDrive, number: int) -> Signal:
    """How far a tensioner stands from the place for which its force is given."""
    name = bodies(model)[number].name or str(number + 1)
    return Signal(
        f"tensioner.{name}.travel", "m", f"travel of tensioner {name}", lambda run: run.body(number, "q"), f"Dynamic travel of {name}"
    )


def transmission_error(number: int) -> Signal:
    """Angle of a sprocket minus that by the tooth ratio."""
    return Signal(
        "transmission_error", "rad", "transmission error", lambda run: run.transmission_error(number), "Dynamic transmission error"
    )


def spring_force(model: ChainDrive, number: int) -> Callable[[Motion], Floats]:
    """Signal: force of a tensioner's spring [N]."""
    slide = bodies(model)[number].slide
    assert slide is not None
    return lambda run: slide.force - slide.stiffness * run.body(number, "q")


def strand_tension(balance: Balance, place: int, share: float = MIDDLE) -> Callable[[Motion], Floats]:
    """Signal: mean tension (m,) of the recorded joints in the middle `share` of the strand that leaves a station of the path, nan where
    none is there [N].

    Only the watched plate's place is recorded: that of a joint so many plates ahead is where the watched one comes as many teeth later.
    """
    found = balance.route
    start, way, length = found.starts[place], np.exp(-1j * found.headings[place]), found.lengths[place]
    margin, width = 0.5 * (1 - share) * length, 0.5 * min(station.radius for station in found.stations)

    def signal(run):
        seen = (run.column("x") + 1j * run.column("y") - start) * way
        here = (seen.real > margin) & (seen.real < length - margin) & (np.abs(seen.imag) < width)
        within = np.stack([_ahead(run, here, joint - run.settings.plate) for joint in run.settings.joints], axis=1)
        count = np.sum(within, axis=1)
        return np.where(count, np.sum(run.tension * within, axis=1) / np.maximum(count, 1), np.nan)

    return signal


def _ahead(run, here, plates):
    """The same mask for a plate so many ahead of the watched one."""
    at, turn = np.arange(len(here)) + plates * run.per_tooth, run.model.chain.count * run.per_tooth
    at = np.where(at >= len(here), at - turn * np.ceil((at - len(here) + 1) / turn).astype(int), at)
    return np.where(at >= 0, here[np.maximum(at, 0)], False)
