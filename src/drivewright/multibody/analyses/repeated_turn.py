"""One turn that stands for a whole run: what repeats itself has the same extremes in every turn.

For a search, which evaluates thousands of mechanisms by a few numbers each: a run of six turns costs six times as much as its first one.
"""

from dataclasses import replace

import numpy as np

from drivewright.multibody.analyses.simulation_model import TURN, SimulationModel, run_of
from drivewright.multibody.analyses.turns import start_of_window
from drivewright.multibody.continuation import WEAK, carry_on
from drivewright.multibody.forces.load import ANGLE, TIME
from drivewright.multibody.observe import FIELDS, observe
from drivewright.multibody.system import System

OVERLAP = 4  # samples beyond the turn: each sample of a turn has neighbours on both sides, as in the middle of a longer run
COUNT = OVERLAP + 1  # samples at either end of the turn that are the same
SAME = 1e-9  # of its size to which everything is the same one turn later
ALIGNED = 1e-6  # of a sample


def repeated_turn(model: SimulationModel) -> SimulationModel:
    """A model that runs for one turn, and has every extreme, of a motion or a force, that the run of `model` has in its window.

    The model itself where it is not known to repeat itself: with freedom, without turns, with loads of another period, in a run that
    passes a singular position, splits its coordinates or has samples elsewhere in each turn, or where an output turns all the way round.
    """
    if not _may_repeat(model):
        return model
    turn = replace(model, duration=model.turn_length * (1 + OVERLAP / model.settings.samples), window_start=0.0)
    return turn if _repeats(turn) else model


def _may_repeat(model):
    """Whether the samples of all turns are alike, at least a turn of them counts, and no load says that a turn is unlike another."""
    if model.period is None or model.assembly.freedom or model.has_play:
        return False
    samples = (
        np.array([model.run_length, model.run_length - start_of_window(model, model.run_length)]) * model.settings.samples / model.period
    )
    aligned = abs(samples[0] - np.rint(samples[0])) < ALIGNED
    return bool(aligned and samples[1] > model.settings.samples + OVERLAP - ALIGNED and _loads_repeat(model.assembly.system, model.period))


def _loads_repeat(system: System, period: float) -> bool:
    """Whether every torque and force over time, or over an angle, is steady or has a whole number of periods in a turn."""
    turn = {TIME: period, ANGLE: TURN}
    for load in (load for table in (system.torques, system.forces) for load in table if load.over in turn):
        curve = system.curves[load.curve]
        first = system.pieces[curve.first]
        count = turn[int(load.over)] / curve.period if curve.period else 0.0
        if (curve["count"] > 1 or any(first[f"c{k}"] for k in range(1, 6))) and not (count and abs(count - np.rint(count)) < SAME):
            return False
    return True


def _repeats(turn):
    """Whether a run of a turn ends as it began, and is the first of many alike."""
    run = run_of(turn)
    t, y = (np.concatenate([getattr(part, name) for part in run.stretches]) for name in ("t", "y"))
    later = np.max(np.abs(t[-COUNT:] - t[:COUNT] - turn.turn_length))
    if (
        run.advice
        or any(len(part.system.chart.offsets) for part in run.stretches)
        or later > ALIGNED * turn.turn_length / turn.settings.samples
    ):
        return False
    return _ends_as_it_began(turn, t, y) and _splits_alike(turn, run)


def _splits_alike(turn, run):
    """Whether the turns that follow split their coordinates, and add samples on the way to where branches come near each other, as a run
    of the first one does.  A split is made where the determinant of the loops has changed by a decade since the one before, and what
    follows from a split depends on the pose alone: so all are alike where the first one of the second turn is that of the first turn."""
    first, last = run.stretches[0], run.stretches[-1]
    if first is last:
        return True
    if run.refined_until > turn.turn_length or last.t[0] > turn.turn_length:
        return False
    grid = np.linspace(0.0, run.until, turn.settings.samples + COUNT)
    again, code = carry_on(last.system, 0.0, grid, run.until, turn.assembly.state)
    return code == WEAK and again.t_end == first.t_end


def _ends_as_it_began(turn, t, y):
    """Whether poses, but for whole rotations, rates, accelerations, loads and drives of the last samples are those of the first ones."""
    ends = [*range(COUNT), *range(len(t) - COUNT, len(t))]
    observed = observe(turn.assembly.system, t[ends], y[ends])
    angle, outputs = FIELDS.index("angle"), [turn.assembly.names.index(output.body) for output in turn.outputs]
    change, turned = observed.bodies[COUNT:] - observed.bodies[:COUNT], observed.drives[COUNT:] - observed.drives[:COUNT]
    if np.any(np.abs(change[:, outputs, angle]) > SAME):
        return False
    change[:, :, angle] -= TURN * np.rint(change[:, :, angle] / TURN)
    sizes = np.max(np.abs(observed.bodies[:COUNT]), axis=(0, 1))
    sizes[angle] = 1.0
    same = np.abs(turned) <= SAME * np.max(np.abs(observed.drives), axis=0)
    return bool(np.all(np.abs(change) <= SAME * sizes) and np.all(same))
