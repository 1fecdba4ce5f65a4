"""A mechanism with the requirements on its run: assembled, its twin without play, outputs, turn, window, settings; and the runs of both."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import lru_cache

import numpy as np

from drivewright._typing import ArrayLike, Floats
from drivewright.errors import SolverError, UnknownName
from drivewright.multibody.assembly import Assembly
from drivewright.multibody.bodies import Marker
from drivewright.multibody.record import Record, record
from drivewright.multibody.simulate import Run, Settings, simulate
from drivewright.result import Column
from drivewright.stops import collect_stops, note_stop

TURN = 2 * np.pi
IDEAL_SAMPLES = 7201  # of the ideal mechanism in a turn
ROWS = 4000  # of a table of the last turn, at most


@dataclass(frozen=True)
class Output:
    """A motion of interest: the angle of a body, or where it names a point, the motion of that point.

    axis: direction (x, y) in the world along which a Poincare section sees the point.
    """

    name: str
    body: str
    point: str | None
    marker: Marker
    axis: tuple[float, float] = (1.0, 0.0)


@dataclass(frozen=True)
class RunLimits:
    """Requirements on a run; None: not required."""

    impact_load_coefficient: float | None = None
    joint_force: float | None = None  # [N]
    penetration: float | None = None  # [m]; the clearance of each pin unless given
    drive_torque: float | None = None  # [N m]
    link_compression: float = 0.0  # of a massless link [N]
    energy_error: float = 1e-4


@dataclass(frozen=True, eq=False)
class SimulationModel:
    """A mechanism and its run.  period [s]: of a drive at constant speed, else None; duration [s]: None without a run; window_start [s]:
    from when peaks and means count; ensemble: number of runs behind the statistics of a motion that does not repeat itself."""

    assembly: Assembly
    ideal: Assembly
    outputs: tuple[Output, ...]
    settings: Settings
    duration: float | None = None
    period: float | None = None
    drive_speed: float | None = None  # [rad/s]
    window_start: float = 0.0
    samples_per_turn: int = 720
    ensemble: int = 1
    seed: int = 1
    limits: RunLimits = RunLimits()
    motors: Mapping[str, str] = field(default_factory=dict)  # {name of the force element: joint that it moves}
    grips: Mapping[str, float] = field(default_factory=dict)  # {rolling joint: coefficient of friction up to which it does not slip}

    @property
    def findings(self) -> tuple[str, ...]:
        """Of the assembly."""
        return self.assembly.findings

    @property
    def has_play(self) -> bool:
        """Whether a joint has play or gives way."""
        return has_play(self.assembly)

    @property
    def bodies(self) -> tuple[str, ...]:
        """Names of the bodies as stated."""
        return tuple(body.name for body in self.assembly.model.bodies)

    @property
    def markers(self) -> Mapping[str, Marker]:
        """Marker of every output; of every body where there is none."""
        if not self.outputs:
            return {name: Marker(name) for name in self.bodies}
        return {output.name: output.marker for output in self.outputs}

    @property
    def pins(self) -> list[str]:
        """Names of the pins whose contact the kernel simulates, in its order."""
        return [joint.name for joint in self.assembly.model.joints if joint.dry_contact]

    @property
    def massless_links(self) -> list[str]:
        """Names of the joints modelled by a massless link."""
        return [joint.name for joint in self.assembly.model.joints if joint.massless_link]

    @property
    def run_length(self) -> float:
        """Length of the run [s]."""
        if self.duration is None:
            raise SolverError("the mechanism has neither a [simulate] table nor a drive at constant speed, so there is nothing to simulate")
        return self.duration

    def output(self, name: str) -> Output:
        """The output of this name; UnknownName otherwise."""
        for output in self.outputs:
            if output.name == name:
                return output
        raise UnknownName("output", name, [output.name for output in self.outputs])

    @property
    def turn_length(self) -> float:
        """Duration of a turn of the drive [s]."""
        if self.period is None:
            raise SolverError("no drive has a constant speed, so turns are not defined")
        return self.period

    def crank_angle(self, t: ArrayLike) -> Floats:
        """Angle of the drive at constant speed, counted from the joint's zero [rad]."""
        driven = self.assembly.system.driven[0]
        return driven.sign * driven.start + (self.drive_speed or 0.0) * np.asarray(t)


def has_play(assembly: Assembly) -> bool:
    """Whether a joint has play or gives way."""
    return any(joint.play for joint in assembly.model.joints)


def run_of(model: SimulationModel) -> Run:
    """The requested run, at every step."""
    return _noted(_run(model))


def record_of(model: SimulationModel) -> Record:
    """Its record."""
    return _noted(_record(model))


def _noted(run):
    """A run or record, which whoever takes it inherits the stop of: what is kept from before has been noted for another analysis."""
    note_stop(run.stop)
    return run


@lru_cache(maxsize=4)
def _run(model):
    return simulate(model.assembly, model.run_length, model.settings)


@lru_cache(maxsize=4)
def _record(model):
    return record(_run(model), model.markers)


def ideal_record(model: SimulationModel) -> Record:
    """The record of the ideal mechanism: over a turn of a drive at constant speed, else over the whole run.

    Its stop is reported only where the run itself may have come further.
    """
    with collect_stops():
        ideal = _ideal_record(model)
    if model.has_play and ideal.stop:
        note_stop(ideal.stop._replace(where=f"with ideal joints, {ideal.stop.where}"))
    return ideal


def simulate_ideal(model: SimulationModel) -> Record:
    """The same, computed anew and not kept."""
    length = model.period or model.run_length
    samples = np.linspace(0.0, length, IDEAL_SAMPLES)
    return record(simulate(model.ideal, length, model.settings, samples=samples), model.markers)


_ideal_record = lru_cache(maxsize=4)(simulate_ideal)


def ideal_at(model: SimulationModel, times: ArrayLike) -> Mapping[str, Floats]:
    """Motion {marker: (m, POINT_FIELDS)} of the ideal mechanism at times (m,) of the run, in turns of a drive at constant speed."""
    times = np.asarray(times)
    folded = np.mod(times, model.period) if model.period and model.ideal.freedom == 0 else times
    order = np.argsort(folded, kind="stable")
    run_record = record(simulate(model.ideal, float(folded.max()), model.settings, samples=folded[order]), model.markers)
    back = np.empty_like(order)
    back[order] = np.arange(len(order))
    return {name: values[back] for name, values in run_record.points.items()}


def last_turn(model: SimulationModel) -> Record:
    """The record of the last whole turn (of the whole run without turns), thinned to about ROWS rows, or as many as are asked for."""
    record = record_of(model)
    turns = np.floor(record.t[-1] / model.period + 1e-9) if model.period else 0
    start = (turns - 1) * model.turn_length if turns >= 1 else 0.0
    end = turns * model.turn_length if turns >= 1 else record.t[-1]
    rows = np.flatnonzero((record.t >= start * (1 - 1e-12)) & (record.t <= end * (1 + 1e-12)))
    stride = max(1, -(-len(rows) // max(ROWS, model.samples_per_turn + 1)))
    return record.take(rows[::stride])


def over_last_turn(model: SimulationModel) -> str:
    """What the title of a table of `last_turn` ends with."""
    return " over the last turn" if model.period else ""


def cycle_columns(model: SimulationModel, t: Floats) -> tuple[Column, ...]:
    """Time, the angle of a drive at constant speed, and where loops fold in a run that passes singular positions."""
    columns = (Column("time", "s", "time", t), *_folds(run_of(model), t))
    if model.period:
        turn = np.floor(t[0] / model.period + 1e-9)
        angle = (t - turn * model.period) * TURN / model.period
        columns = (Column("crank_angle", "rad", "drive angle since start of turn", angle), *columns)
    return columns


def _folds(run, t):
    if not run.passages:
        return ()
    near = [np.abs(t - passed.time) < passed.system.chart.reach * passed.system.chart.pace for passed in run.passages]
    meaning, label = "1 near a singular position, where loops fold; 0 elsewhere", "near a singular position"
    return (Column("fold", "-", meaning, np.any(near, axis=0).astype(float), label),)
