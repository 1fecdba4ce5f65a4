"""The poses of all bodies of a mechanism over one turn, or over the run of a free mechanism."""

from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.multibody.analyses.simulation_model import TURN, SimulationModel, run_of
from drivewright.multibody.drawing import positions_of
from drivewright.multibody.observe import observe
from drivewright.multibody.simulate import simulate

FRAMES, FREE_FRAMES = 181, 721  # of a turn; of a whole run, which may hold many swings
FINE = 8  # samples from frame to frame: between two frames a journal may bounce


class CyclePoses(NamedTuple):
    """`poses` {body: (samples, 3)} of the bodies' own frames; every FINE-th sample is a frame, of which `cycle` (frames,) is the angle
    of the drive or the time; `period` [s] 0 where nothing moves, and `start` [s] is the time of the first."""

    cycle: Floats
    label: str
    unit: str
    period: float
    poses: dict[str, Floats]
    start: float = 0.0

    @property
    def times(self) -> Floats:
        """Times (frames,) [s] of the frames."""
        return self.start + np.linspace(0.0, self.period, len(self.cycle))

    def frames(self, name: str) -> Floats:
        """Poses (frames, 3) of a body."""
        return self.poses[name][::FINE]


def cycle_poses(model: SimulationModel) -> CyclePoses:
    """The `CyclePoses` of the last whole turn, of the whole run without turns, or of the start where there is no run."""
    start, end = _span(model)
    if end <= start:
        still = {name: np.repeat(pose, FINE + 1, axis=0) for name, pose in start_poses(model).items()}
        return CyclePoses(np.array([0.0, 1.0]), "time (no run: pose at the start)", "s", 0.0, still)
    turns = model.period and end - start > (1 - 1e-9) * model.period
    times = np.linspace(start, end, FINE * ((FRAMES if turns else FREE_FRAMES) - 1) + 1)
    run = simulate(model.assembly, end, model.settings, samples=times)
    parts = [origins(model, observe(part.system, part.t, part.y).bodies) for part in run.stretches if len(part.t)]
    poses = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
    passed = times[::FINE] - start
    if model.period:
        return CyclePoses(passed * TURN / model.period, "crank angle", "rad", end - start, poses, start)
    return CyclePoses(passed, "time", "s", end - start, poses, start)


def _span(model):
    """(start, end) in time of the last whole turn; of the whole run without turns."""
    if model.duration is None:
        return 0.0, 0.0
    end = run_of(model).end[1]
    turns = int(np.floor(end / model.period + 1e-9)) if model.period else 0
    return ((turns - 1) * model.period, min(turns * model.period, end)) if turns else (0.0, end)


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
