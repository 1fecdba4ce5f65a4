"""Run a chain drive: settings in, `Motion` out."""

import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, cast

import numpy as np

from drivewright._jit import plain
from drivewright._typing import Floats
from drivewright.chains.explicit.advance import run, settle_rates
from drivewright.chains.explicit.assembly import Start, start
from drivewright.chains.explicit.bodies import place_body
from drivewright.chains.explicit.measure import empty_log, measured
from drivewright.chains.explicit.motion import Motion, RunSettings
from drivewright.chains.explicit.run_in import PARTS, run_in, run_in_time, steps_of
from drivewright.chains.explicit.snapshots import PLATES, SCALARS, Snapshots, empty_snapshots
from drivewright.chains.explicit.stability import refuse_seats, refuse_step
from drivewright.chains.explicit.state import DriveArrays, compile_model
from drivewright.chains.model import ChainDrive
from drivewright.errors import InputError, counted

CHUNK = 0.3  # seconds of computing between two looks at the outside world
ROOM = 16000  # plates, over all snapshots, that are kept until they are measured: what a cache holds
SEARCH_INTERVAL = 50  # steps between two searches for who may touch whom
MOST_STEPS, MOST_SAMPLES = 10_000_000, 2_000_000  # between two samples, and samples of a run
DRIFT = 0.02  # of a tooth that a sprocket may turn in between


@dataclass(frozen=True)
class Settings:
    """How to run.  The step [s] is shortened to fit a whole number of times between samples, these into a tooth of the driver.

    run_in [s]: before the clock starts, teeth, pitches and guides take on their measures under fading damping; None: see `run_in_time`;
    settle [s]: what statistics leave out at the start; tolerance [1/s]: energy drift over the stored energy that fails a run;
    joints whose tension is recorded; plate whose forces are.
    """

    step: float = 1e-6
    run_in: float | None = None
    settle: float = 0.0
    samples_per_tooth: int = 24
    tolerance: float = 1e-3
    joints: tuple[int, ...] = (0,)
    plate: int = 0


def simulate(
    model: ChainDrive,
    duration: float,
    settings: Settings = Settings(),
    *,
    begin: Start | None = None,
    progress: Callable[[int, int], object] | None = None,
) -> Motion:
    """The `Motion` of a model over `duration` [s], from `begin` (a `Start`; None: assembled).

    progress(done, total) is called with samples, from the caller's thread; Ctrl-C comes through within a third of a second.
    """
    _refuse(model, duration, settings)
    refuse_step(model, settings.step)
    refuse_seats(model)
    every, step, samples = stepping(model, duration, settings)
    search_interval = _search_interval(model, step)
    drive = _begun(model, begin, settings, step, search_interval)
    log = _in_chunks(drive, settings, samples, every, search_interval, step, progress)
    return Motion(model, settings, step, every, log.rows, log.bodies, log.tension, log.plate)


def kernel_of_steps(model: ChainDrive) -> Callable[[], object]:
    """What compiles the kernel with which `simulate` takes its steps: every drive whose contacts have such a law runs on it."""
    drive, kernel = compile_model(model), cast(Any, run)
    return partial(kernel.compile_for, drive, empty_snapshots(1, len(drive.bodies), drive.chain.count), 0, 1, 1, 1.0, 1e-6)


def first_start(model: ChainDrive, settings: RunSettings) -> Start:
    """The `Start` from which `simulate` runs a drive in, so that the clock starts with sprocket 1 at its angle."""
    _, step, _ = stepping(model, tooth_time(model), settings)
    return start(model, PARTS * _run_in_steps(model, settings, step) * step)


def running_start(model: ChainDrive, settings: Settings = Settings()) -> Start:
    """The `Start` of a chain that has been run in: with it any solver begins, at clock 0, where `simulate` does."""
    _, step, _ = stepping(model, tooth_time(model), settings)
    drive, begin, offset = _begun(model, None, settings, step, _search_interval(model, step)), start(model), model.chain.centre_offset
    p, b, n, m = drive.plates, drive.bodies, model.chain.count, len(model.sprockets)
    angle, w = p.angle[:n], p.w[:n]
    c, s = np.cos(angle), np.sin(angle)
    return replace(
        begin,
        poses=np.stack([p.x[:n] + offset * s, p.y[:n] - offset * c, angle], axis=1),
        rates=np.stack([p.vx[:n] + offset * c * w, p.vy[:n] + offset * s * w, w], axis=1),
        q=b.q[:m].copy(),
        guide_q=b.q[m:].copy(),
        psi=b.psi[:m].copy(),
        rate_q=b.vq[:m].copy(),
        rate_psi=b.w[:m].copy(),
        hole_pitches=model.chain.hole_pitches,
        supports=drive.teeth.support.copy(),
    )


def chain_shapes(model: ChainDrive, begin: Start, duration: float, step: float, samples: int) -> tuple[Floats, Floats]:
    """(times (m,) [s], mass centres and angles of all plates (m, N, 3) [m], [rad]) from `begin`, at the ends of `samples` intervals.

    The step [s] is shortened to fit into these a whole number of times; no run-in.
    """
    refuse_step(model, step)
    every = counted(np.ceil(duration / samples / step - 1e-9), MOST_STEPS, "steps between two samples", "make the step longer")
    step = duration / samples / every
    drive = placed(model, begin, step)
    snapshots = empty_snapshots(samples + 1, len(drive.bodies), drive.chain.count)
    run(drive, snapshots, 0, samples + 1, every, _search_interval(model, step), step)
    shapes = snapshots.plates[:, [PLATES.index(name) for name in ("x", "y", "angle")]]
    return snapshots.scalars[:, SCALARS.index("t")].copy(), np.moveaxis(shapes, 1, 2)


def _run_in_steps(model, settings, step):
    """Steps of each part of the run-in."""
    duration = getattr(settings, "run_in", 0.0)
    duration = run_in_time(model, start(model)) if duration is None else duration
    return steps_of(duration, step) if duration > 0 else 0


def _begun(model, begin, settings, step, search_interval):
    """The drive run in, sprocket 1 at its angle."""
    begin = first_start(model, settings) if begin is None else begin
    steps = _run_in_steps(model, settings, step)
    drive = placed(model, begin, step)
    if steps:
        run_in(drive, begin, steps, step, search_interval)
    return drive


def stepping(model: ChainDrive, duration: float, settings: RunSettings) -> tuple[int, float, int]:
    """(steps per sample, step, samples): a whole number of steps per sample and of samples per tooth."""
    between = tooth_time(model) / settings.samples_per_tooth
    every = counted(np.ceil(between / settings.step - 1e-9), MOST_STEPS, "steps between two samples", "make the step longer")
    samples = counted(
        np.ceil(duration / between - 1e-9), MOST_SAMPLES, "samples of the run", "take a shorter run, or fewer samples per tooth"
    )
    return every, between / every, samples + 1


def tooth_time(model: ChainDrive) -> float:
    """Time in which the driver turns by one tooth at full speed  [s]."""
    speed = max(abs(model.drive.speed), abs(model.drive.start))
    return 2 * np.pi / (model.sprockets[model.driver].tooth.teeth * speed)


def placed(model: ChainDrive, begin: Start, step: float) -> DriveArrays:
    """The arrays of a model at its start, its rates half a step before."""
    drive = compile_model(model)
    p, b, n, offset = drive.plates, drive.bodies, model.chain.count, model.chain.centre_offset
    x, y, angle = begin.poses.T
    c, s = np.cos(angle), np.sin(angle)
    vx, vy, w = begin.rates.T
    values = (x - offset * s, y + offset * c, c, s, vx - offset * c * w, vy - offset * s * w, w)
    for row, value in zip((p.x, p.y, p.c, p.s, p.vx, p.vy, p.w), values, strict=True):
        row[:n], row[n] = value, value[0]
    p.angle[:n] = angle
    p.hx[:n], p.hy[:n], p.hw[:n] = p.vx[:n], p.vy[:n], p.w[:n]
    _place_bodies(b, begin)
    settle_rates(drive, step)
    return drive


def _place_bodies(b, begin):
    m = len(begin.psi)
    b.q[:m], b.vq[:m], b.hq[:m] = begin.q, begin.rate_q, begin.rate_q
    b.psi0[:m], b.psi[:m], b.w[:m], b.hw[:m] = begin.psi, begin.psi, begin.rate_psi, begin.rate_psi
    b.q[m:] = begin.guide_q
    for n in range(b.q.size):
        plain(place_body)(b, n)
    b.vx[:], b.vy[:] = b.vq * b.ux, b.vq * b.uy


def _search_interval(model, step):
    """Steps between two searches."""
    speed = 2 * np.pi / tooth_time(model)  # teeth times angular speed, of every sprocket
    return float(max(1, min(SEARCH_INTERVAL, int(2 * np.pi * DRIFT / (speed * step)))))


def _in_chunks(drive, settings, samples, every, search_interval, step, progress):
    """The `Log` of all samples, in chunks of so many as CHUNK seconds and ROOM hold."""
    bodies, count = len(drive.bodies), drive.chain.count
    log = empty_log(samples, bodies, len(settings.joints))
    room = min(samples, max(1, ROOM // count))
    snapshots, done, many = empty_snapshots(room, bodies, count), 0, 1
    while done < samples:
        began, now = time.perf_counter(), min(many, samples - done)
        run(drive, snapshots, 0, now, every, search_interval, step)
        took = max(time.perf_counter() - began, 1e-9)
        taken = measured(drive, Snapshots(*(each[:now] for each in snapshots)), settings.joints, settings.plate)
        for whole, part in zip(log, taken, strict=True):
            whole[done : done + now] = part
        many = max(1, min(int(now * CHUNK / took), 8 * many, room))
        done += now
        if progress:
            progress(done, samples)
    return log


def _refuse(model, duration, settings):
    if not isinstance(model, ChainDrive):
        raise InputError(f"simulate: needs a ChainDrive, got {type(model).__name__}.")
    if not (np.isfinite(duration) and duration > 0):
        raise InputError(f"simulate: the duration must be finite and above 0 s, got {duration:g}.")
    if not 0 <= settings.settle < duration:
        raise InputError(f"simulate: {settings.settle:g} s of settling do not lie within the duration of {duration:g} s.")
    if settings.run_in is not None and not (np.isfinite(settings.run_in) and settings.run_in >= 0):
        raise InputError(f"simulate: run_in must be finite and 0 s or more, got {settings.run_in:g}.")
    if settings.samples_per_tooth < 20:
        raise InputError(f"simulate: {settings.samples_per_tooth} samples per tooth alias its harmonics; take 20 or more.")
    drive = model.drive
    if max(abs(drive.speed), abs(drive.start)) == 0:
        raise InputError("simulate: the driver does not turn; give it a speed.")
    for name, numbers in (("joint", settings.joints), ("plate", (settings.plate,))):
        wrong = [n for n in numbers if not 0 <= n < model.chain.count]
        if wrong:
            raise InputError(f"simulate: there is no {name} {wrong[0]}; the chain has 0 .. {model.chain.count - 1}.")
