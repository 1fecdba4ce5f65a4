"""Running in: from the assembled drive to one that runs quietly, before the clock starts.

Assembled, plates sit where ideal teeth would seat them, free ones have the pitch that closes the loop, and guides are passed through.
In the first part of the run-in teeth, pitches and guides become what they are; all the time, ever more faintly, rates are drawn to those
of a chain that follows itself at its mean speed.  What remains in the end is the motion itself.

The slowest to find their place are the strands, strings that nothing else damps much: a drag of twice their angular frequency lets them
settle soonest, so the run-in lasts two of their periods, most of it under about such a drag.
"""

import numpy as np

from drivewright.chains.explicit.advance import run
from drivewright.chains.explicit.assembly import Start
from drivewright.chains.explicit.snapshots import empty_snapshots
from drivewright.chains.explicit.state import DriveArrays
from drivewright.chains.model import ChainDrive

PARTS = 400  # of the run-in, between which rates are damped
FADED = 1 / 3  # part of the run-in in which the parts take on their own measures
BLOWS, STRANDS = 400.0, 40.0  # rates of damping at the start, times the duration: of what that throws up, and of the strands
PERIODS = 2  # of the slowest strand, that the run-in lasts; no more than a revolution of the chain, but
SHORTEST = 0.02  # [s]


def run_in_time(model: ChainDrive, begin: Start) -> float:
    """Duration of the run-in [s]: periods of the longest strand as a moving string, 2 L c/(c^2 - v^2)."""
    density, pitch = model.chain.line_density, model.chain.link.pitch
    strand = _longest_strand(begin) * pitch
    wave = np.sqrt(begin.tension / density)
    slow = max(wave * wave - begin.speed**2, 0.0)
    revolution = len(begin.poses) * pitch / max(abs(begin.speed), 1e-300)
    return max(SHORTEST, revolution if slow * revolution < 2 * PERIODS * strand * wave else 2 * PERIODS * strand * wave / slow)


def _longest_strand(begin):
    """Most plates between two seated ones, with half of the joints at both ends."""
    seated = np.sort(np.concatenate(begin.seated))
    return np.max(np.diff(np.append(seated, seated[0] + len(begin.poses))))


def steps_of(duration: float, step: float) -> int:
    """Steps of each of the PARTS."""
    return max(1, round(duration / PARTS / step))


def run_in(drive: DriveArrays, begin: Start, steps: int, step: float, search_interval: float) -> None:
    """Run the drive in for PARTS of so many steps; afterwards its clock stands at 0 and its works start anew."""
    own, first = _measures(drive), _first_measures(drive, begin)
    ramps = drive.bodies.ramp.copy(), drive.bodies.speed.copy()
    drive.bodies.ramp[:], drive.bodies.speed[:] = 0.0, drive.bodies.w
    snapshots = empty_snapshots(1, len(drive.bodies), drive.chain.count)
    for part in range(PARTS):
        done = (part + 1) / PARTS
        faded = min(1.0, done / FADED)
        _set_measures(drive, first, own, faded * faded * (3 - 2 * faded))
        run(drive, snapshots, 0, 1, steps, search_interval, step)
        rate = BLOWS * max(0.0, 1 - done / (1.2 * FADED)) ** 2 + STRANDS * (1 - done)
        _damp(drive, begin, 1 - np.exp(-rate / PARTS))
    drive.bodies.ramp[:], drive.bodies.speed[:] = ramps
    drive.bodies.psi0[:] = drive.bodies.psi
    for sums in (drive.clock, drive.sums, drive.joints.lost, drive.touches.lost):
        sums[:] = 0.0


def _measures(drive):
    """Half the hole pitches, supports of the teeth, radii of the guides."""
    return drive.plates.half.copy(), drive.teeth.support.copy(), drive.arcs.radius.copy()


def _first_measures(drive, begin):
    """Those with which the assembled drive is free of contact forces."""
    half, n = drive.plates.half.copy(), drive.chain.count
    half[:n] = 0.5 * begin.hole_pitches
    half[n] = half[0]
    support = np.where(drive.teeth.rolls, drive.teeth.support, begin.supports)
    deepest = [max(0.0, np.max(_guide_depth(drive, g))) for g in range(len(drive.arcs))]
    return half, support, drive.arcs.radius - deepest


def _guide_depth(drive, number):
    """Depth of every plate in a guide (N,); -inf where it is beside the arc."""
    arc, b, p, n = drive.arcs[number], drive.bodies[len(drive.teeth.base) + number], drive.plates, drive.chain.count
    middle = (arc.middle_x + 1j * arc.middle_y) * np.exp(1j * b.psi)
    c, s, gx, gy = p.c[:n], p.s[:n], p.x[:n] - b.x, p.y[:n] - b.y
    along, out = c * gx + s * gy, c * gy - s * gx - drive.chain.offset - arc.side * arc.distance
    along = along + np.clip(-along, -drive.chain.half_plate, drive.chain.half_plate)
    far = np.hypot(along, out)
    within = (c * along - s * out) * middle.real + (s * along + c * out) * middle.imag >= arc.opening * far
    return np.where(within, np.where(arc.side * out > 0, arc.radius - far, arc.radius + far), -np.inf)


def _set_measures(drive, first, own, share):
    targets = (drive.plates.half, drive.teeth.support, drive.arcs.radius)
    for target, a, b in zip(targets, first, own, strict=True):
        target[:] = b if share == 1.0 else a + share * (b - a)


def _damp(drive, begin, share):
    """Draw rates towards the quiet ones: plates along their own line, no faster turned than their neighbours, slides at rest."""
    p, b, n, m = drive.plates, drive.bodies, drive.chain.count, len(begin.psi)
    w = p.hw[:n]
    changes = (
        share * (begin.speed * p.c[:n] - p.hx[:n]),
        share * (begin.speed * p.s[:n] - p.hy[:n]),
        0.25 * share * (np.roll(w, 1) - 2 * w + np.roll(w, -1)),
    )
    for half, whole, change in zip((p.hx, p.hy, p.hw), (p.vx, p.vy, p.w), changes, strict=True):
        half[:n] += change
        whole[:n] += change
        whole[n] = whole[0]
    free = ~b.driven[:m]
    for rate in (b.hw, b.w):
        rate[:m][free] += share * (begin.rate_psi - rate[:m])[free]
    for rate in (b.hq, b.vq, b.vx, b.vy):
        rate *= 1 - share
