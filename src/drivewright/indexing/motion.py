"""The motion of an indexing wheel over the angle of its input: one step a turn, then a dwell."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from drivewright.errors import InputError
from drivewright.motion import MotionLaw, law
from drivewright.numerics.jets import Jet

TURN = 2 * np.pi
NO_DWELL = "no-dwell"


@dataclass(frozen=True)
class Stretch:
    """A smooth stretch of one turn of the input, angles [rad]; `number` is its piece of the law, None in the dwell."""

    start: float
    stop: float
    number: int | None


@dataclass(frozen=True, eq=False)
class IndexMotion:
    """phi(theta) = pitch (n + s((theta - 2 pi n)/motion_angle)), pitch = 2 pi/divisions, n = floor(theta/(2 pi)); then a dwell.

    divisions: steps of the wheel in a turn; motion_angle [rad]: part of the input's turn in which the wheel moves.
    """

    law: MotionLaw
    divisions: int
    motion_angle: float

    @property
    def pitch(self):
        """Angle of one step [rad]."""
        return TURN / self.divisions

    @cached_property
    def stretches(self):
        """Smooth stretches of one turn, the dwell last."""
        ends = self.motion_angle * np.asarray(self.law.breaks)
        moving = tuple(Stretch(float(a), float(b), k) for k, (a, b) in enumerate(zip(ends[:-1], ends[1:], strict=True)))
        return moving if self.motion_angle >= TURN else (*moving, Stretch(self.motion_angle, TURN, None))

    def on(self, stretch, theta, turn=0):
        """Jet of phi [rad] by the input angle theta, counted in turn number `turn`, by the formula of a stretch; one-sided at its ends."""
        theta = np.asarray(theta, dtype=float)
        if stretch.number is None:
            still = np.zeros_like(theta)
            return Jet(still + self.pitch * (turn + 1), still, still, still)
        ends = self.law.breaks[stretch.number : stretch.number + 2]
        s, v, a, j = self.law.on_piece(stretch.number, np.clip(theta / self.motion_angle, *ends))
        return Jet(self.pitch * (turn + s), *(self.pitch * d / self.motion_angle**k for k, d in enumerate((v, a, j), start=1)))

    def __call__(self, theta):
        """Jet of phi [rad] by the input angle theta [rad], any turn; at a joint the stretch that begins there."""
        theta = np.asarray(theta, dtype=float)
        turn = np.floor(theta / TURN)
        inside = theta - TURN * turn
        starts = np.array([stretch.start for stretch in self.stretches])
        number = np.clip(np.searchsorted(starts, inside, side="right") - 1, 0, len(starts) - 1)
        parts = np.zeros((4, *theta.shape))
        for k, stretch in enumerate(self.stretches):
            here = number == k
            if np.any(here):
                parts[:, here] = np.stack(np.broadcast_arrays(*self.on(stretch, inside[here], turn[here])))
        return Jet(*parts)


def index_motion(name, divisions, motion_to_dwell=1.0, **parameters):
    """IndexMotion of the law `name`: motion_angle = 2 pi r/(1 + r), r = motion_to_dwell; a full turn for "no-dwell" and for "uniform".

    Raises InputError for a law whose velocity jumps or that does not go from rest to rest where a dwell follows.
    """
    found = law(name, **parameters)
    if motion_to_dwell == NO_DWELL or name == "uniform":
        return IndexMotion(found, divisions, TURN)
    if not (np.isfinite(motion_to_dwell) and motion_to_dwell > 0):
        raise InputError(f"motion_to_dwell = {motion_to_dwell}; the ratio of motion to dwell is above 0 and finite, or {NO_DWELL!r}.")
    if found.continuity < 1:
        raise InputError(
            f"motion law {name!r}: its velocity jumps by {found.peaks().Vm:.4g}, so the wheel would be struck at the ends of the dwell. "
            f'Take a law from rest to rest, as "modified-sine", or motion_to_dwell = "{NO_DWELL}".'
        )
    return IndexMotion(found, divisions, TURN * motion_to_dwell / (1 + motion_to_dwell))
