"""The poses of all bodies of a mechanism over one turn, or over the run of a free mechanism."""

from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.multibody.analyses.simulation_model import TURN, SimulationModel, run_of
from drivewright.multibody.drawing import positions_of
from drivewright.multibody.observe import observe
from drivewright.multibody.simulate import simulate
from drivewright.stops import collect_stops

FRAMES, FREE_FRAMES = 181, 721  # of a turn; of a whole run, which may hold many swings
FINE = 8  # samples from frame to frame where there is play: between two frames a journal may bounce


class CyclePoses(NamedTuple):
    """`poses` {body: (samples, 3)} of the bodies' own frames; every `fine`-th sample is a frame, of which `cycle` (frames,) is the angle
    of the drive or the time; `period` [s] 0 where nothing moves, and `start` [s] is the time of the first."""

    cycle: Floats
    label: str
    unit: str
    period: float
    poses: dict[str, Floats]
    fine: int
    start: float = 0.0

    @property
    def times(self) -> Floats:
        """Times (frames,) [s] of the frames."""
        return self.start + np.linspace(0.0, self.period, len(self.cycle))

    def frames(self, name: str) -> Floats:
        """Poses (frames, 3) of a body."""
        return self.poses[name][:: self.fine]


def cycle_poses(model: SimulationModel) -> CyclePoses:
    """The `CyclePoses` of the last whole turn, of the whole run without turns, or of the start where there is no run."""
    fine = FINE if model.has_play else 1
    start, end, run = _last_turn(model, fine)
    if run is None:
        still = {name: np.repeat(pose, fine + 1, axis=0) for name, pose in start_poses(model).items()}
        return CyclePoses(np.array([0.0, 1.0]), "time (no run: pose at the start)", "s", 0.0, still, fine)
    parts = [origins(model, observe(part.system, part.t, part.y).bodies) for part in run.stretches if len(part.t)]
    poses = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
    passed = _times(model, start, end, fine)[::fine] - start
    if model.period:
        return CyclePoses(passed * TURN / model.period, "crank angle", "rad", end - start, poses, fine, start)
    return CyclePoses(passed, "time", "s", end - start, poses, fine, start)


def _last_turn(model, fine):
    """(start, end) in time of the last whole turn, or of the whole run without turns, and the run sampled there; None without a run."""
    if not model.duration:
        return 0.0, 0.0, None
    if model.assembly.freedom == 0:  # such a run mostly gets to its end
        with collect_stops() as stops:
            sampled = _sampled(model, model.duration, fine)
        if not stops:
            return sampled
    return _sampled(model, run_of(model).end[1], fine)


def _sampled(model, end, fine):
    """The same of a run that gets to the end [s]."""
    turns = int(np.floor(end / model.period + 1e-9)) if model.period else 0
    start, end = ((turns - 1) * model.period, min(turns * model.period, end)) if turns else (0.0, end)
    run = simulate(model.assembly, end, model.settings, samples=_times(model, start, end, fine)) if end > start else None
    return start, end, run


def _times(model, start, end, fine):
    """Times of the samples from start to end [s]."""
    turns = model.period and end - start > (1 - 1e-9) * model.period
    return np.linspace(start, end, fine * ((FRAMES if turns else FREE_FRAMES) - 1) + 1)


def start_poses(model: SimulationModel) -> dict[str, Floats]:
    """Poses {body: (1, 3)} at the start."""
    assembly = model.assembly
    return origins(model, observe(assembly.system, [0.0], assembly.state[None]).bodies)


def origins(model: SimulationModel, bodies: Floats) -> dict[str, Floats]:
    """Poses {body: (m, 3)} of the bodies' own frames, from those of their centroids (m, bodies, FIELDS)."""
    centroids = {body.name: body.centroid for body in model.assembly.expanded.bodies}
    origins_by_name = {}
    for number, name in enumerate(model.assembly.names):
        pose = bodies[:, number, :3]
        x, y = centroids.get(name, (0.0, 0.0))
        back = positions_of((-x, -y), pose)
        origins_by_name[name] = np.column_stack([back, pose[:, 2]])
    return origins_by_name
