"""Run a chain drive: settings in, `Motion` out."""

import time
from dataclasses import dataclass

import numpy as np

from drivewright.chains.dynamics.advance import run, settle_rates
from drivewright.chains.dynamics.assembly import start
from drivewright.chains.dynamics.measure import BODY, PLATE, ROW, Log
from drivewright.chains.dynamics.model import Model
from drivewright.chains.dynamics.motion import Motion
from drivewright.chains.dynamics.stability import refuse_seats, refuse_step
from drivewright.chains.dynamics.state import lower
from drivewright.errors import InputError

CHUNK = 0.3  # seconds of computing between two looks at the outside world
AGAIN = 50  # steps between two searches for who may touch whom
DRIFT = 0.02  # of a tooth that a sprocket may turn in between


@dataclass(frozen=True)
class Settings:
    """How to run.  The step [s] is shortened to fit a whole number of times between samples, these into a tooth of the driver.

    settle [s]: what statistics leave out at the start; tolerance: energy drift over the largest kinetic energy that fails a run;
    joints whose tension is recorded; plate whose forces are.
    """

    step: float = 1e-6
    settle: float = 0.0
    samples_per_tooth: int = 24
    tolerance: float = 1e-4
    joints: tuple = (0,)
    plate: int = 0


def simulate(model, duration, settings=Settings(), *, begin=None, progress=None):
    """The `Motion` of a model over `duration` [s], from `begin` (a `Start`; None: assembled).

    progress(done, total) is called with samples, from the caller's thread; Ctrl-C comes through within a third of a second.
    """
    _refuse(model, duration, settings)
    refuse_step(model, settings.step)
    refuse_seats(model)
    every, step, samples = stepping(model, duration, settings)
    drive = placed(model, start(model) if begin is None else begin, step)
    log = _log(model, samples, settings)
    _in_chunks(drive, log, samples, every, _again(model, step), step, progress)
    return Motion(model, settings, step, every, log.rows, log.bodies, log.tension, log.plate)


def stepping(model, duration, settings):
    """(steps per sample, step, samples): a whole number of steps per sample and of samples per tooth."""
    between = tooth_time(model) / settings.samples_per_tooth
    every = int(np.ceil(between / settings.step - 1e-9))
    return every, between / every, int(np.ceil(duration / between - 1e-9)) + 1


def tooth_time(model):
    """Time in which the driver turns by one tooth at full speed  [s]."""
    sprocket = model.sprockets[model.driver]
    speed = max(abs(sprocket.drive.speed), abs(sprocket.drive.start))
    return 2 * np.pi / (sprocket.tooth.teeth * speed)


def placed(model, begin, step):
    """The arrays of a model at its start, its rates half a step before."""
    drive = lower(model)
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
    b.x[:], b.y[:] = b.x0 + b.q * b.ux, b.y0 + b.q * b.uy
    b.vx[:], b.vy[:] = b.vq * b.ux, b.vq * b.uy


def _log(model, samples, settings):
    bodies = len(model.sprockets) + len(model.guides)
    return Log(np.zeros((samples, len(ROW))), np.zeros((samples, bodies, len(BODY))), np.zeros((samples, len(settings.joints))),
               np.zeros((samples, len(PLATE))), np.array(settings.joints, np.int64), np.array([settings.plate], np.int64))


def _again(model, step):
    """Steps between two searches."""
    speed = 2 * np.pi / tooth_time(model)  # teeth times angular speed, of every sprocket
    return float(max(1, min(AGAIN, int(2 * np.pi * DRIFT / (speed * step)))))


def _in_chunks(drive, log, samples, every, again, step, progress):
    """All samples, in chunks of so many as CHUNK seconds hold."""
    done, many = 0, 1
    while done < samples:
        began, last = time.perf_counter(), min(done + many, samples)
        run(drive, log, done, last, every, again, step)
        took = max(time.perf_counter() - began, 1e-9)
        many = max(1, min(int((last - done) * CHUNK / took), 8 * many))
        done = last
        if progress:
            progress(done, samples)


def _refuse(model, duration, settings):
    if not isinstance(model, Model):
        raise InputError(f"simulate: wants a chain drive's Model, got {type(model).__name__}.")
    if not (np.isfinite(duration) and duration > 0):
        raise InputError(f"simulate: the duration must be finite and above 0 s, got {duration:g}.")
    if not 0 <= settings.settle < duration:
        raise InputError(f"simulate: {settings.settle:g} s of settling do not lie within the duration of {duration:g} s.")
    if settings.samples_per_tooth < 20:
        raise InputError(f"simulate: {settings.samples_per_tooth} samples per tooth alias its harmonics; take 20 or more.")
    drive = model.sprockets[model.driver].drive
    if max(abs(drive.speed), abs(drive.start)) == 0:
        raise InputError("simulate: the driver stands still, so a tooth takes no time; give it a speed.")
    for name, numbers in (("joint", settings.joints), ("plate", (settings.plate,))):
        wrong = [n for n in numbers if not 0 <= n < model.chain.count]
        if wrong:
            raise InputError(f"simulate: there is no {name} {wrong[0]}; the chain has 0 .. {model.chain.count - 1}.")
