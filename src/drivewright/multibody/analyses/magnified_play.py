"""Play in pins large enough to see: bearing, journal and the journal's orbit, enlarged by a round factor that a label states."""

from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.multibody.analyses.cycle_poses import CyclePoses
from drivewright.multibody.drawing import positions_of, rotate
from drivewright.multibody.joints.revolute import Revolute
from drivewright.scene import Body, Shape, circle, polygon

BEARING, RIM = 1.7, 1.35  # radius of a bearing over half a bar's width; of its rim over the bearing's
SHOWN = 0.6  # the drawn play over the drawn bearing's radius, at most


class MagnifiedPlay(NamedTuple):
    """A pin with play as drawn: radius of the bearing [m], the play in it [m], the factor on the real one;
    `orbit` (samples, 2) of the journal in the bearing's body, `poses` (frames, 3) of the journal and at `rest` in the bearing's middle."""

    joint: Revolute
    radius: float
    drawn: float
    factor: float
    orbit: Floats
    poses: Floats
    rest: Floats


def magnify_play(joint: Revolute, cycle: CyclePoses, half_width: float) -> MagnifiedPlay:
    """The `MagnifiedPlay` of a pin that is not ideal, in bars of a half width [m]; a bushing has as much as it gives way."""
    assert joint.play is not None
    bearing, journal = (positions_of(m[1:], cycle.poses[m.body]) for m in (joint.first, joint.second))
    away = journal - bearing
    real = joint.play.clearance or float(np.hypot(*away.T).max())
    radius = max(BEARING * half_width, real / SHOWN)
    factor = max(_round_down(SHOWN * radius / real), 1.0) if real > 0 else 1.0
    away = away * factor
    # Where steel gives way the journal is a little outside its play; magnified, it would lie in the wall.
    away *= np.minimum(1.0, factor * real / np.maximum(np.hypot(*away.T), 1e-300))[:, None]
    turn, own = (cycle.poses[marker.body][:, 2] for marker in (joint.first, joint.second))
    poses, rest = (np.column_stack([place, own])[:: cycle.fine] for place in (bearing + away, bearing))
    return MagnifiedPlay(joint, radius, factor * real, factor, rotate(away, -turn), poses, rest)


def _round_down(value):
    """The largest of 1, 2, 5 times a power of ten up to a value."""
    power = 10.0 ** np.floor(np.log10(value))
    return float(next(step * power for step in (5, 2, 1) if step * power <= value * (1 + 1e-12)))


def bearing_shapes(plays: Iterable[MagnifiedPlay], name: str) -> Iterator[Shape]:
    """Rim and hole of the bearings that a body carries, and the journal's path in them."""
    for play in plays:
        if play.joint.first.body == name:
            center = play.joint.first[1:]
            yield Shape("body", circle(center, RIM * play.radius))
            yield Shape("hole", circle(center, play.radius))
            yield Shape("pitch", polygon(np.asarray(center) + play.orbit, closed=False))


def journal_body(play: MagnifiedPlay) -> Body:
    """The journal as a body of its own: only its place in the bearing is magnified, not the mechanism around it.

    Further than drawn it would pass through the bearing's wall.
    """
    assert play.joint.play is not None
    radius = play.radius - play.drawn
    shapes = (Shape("roller", circle((0, 0), radius)), Shape("axis", polygon([(0, 0), (radius, 0)], closed=False)))
    return Body(
        f"journal {play.joint.name}",
        f"{play.joint.play.noun} magnified ×{play.factor:g}",
        shapes,
        play.poses,
        "ground",
        rest=play.rest,
        most=1.0,
        magnified=play.factor,
    )
