"""The follower as shapes, in its own frame: a slide's origin is the cam's centre at zero lift, a lever's is its pivot.

Points are complex [m] and become (x, y) at the end.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from drivewright.cams.cycle import Cycle
from drivewright.cams.followers import OscillatingFlat, OscillatingRound, TranslatingFlat
from drivewright.cams.profile import FlatFollower, Follower, RoundFollower
from drivewright.cams.sizing import face_ends
from drivewright.cams.valve import GuidedArm
from drivewright.numerics.jets import constant, variable
from drivewright.scene import Arc, Line, Outline, Shape, capsule, circle, polygon, xy

SLIM = 0.12  # width of stems and levers, of the size of the cam


@dataclass(frozen=True, eq=False)
class FollowerShapes:
    """What a follower looks like over the turn `cycle`; call it for its shapes.

    followers: on the cam and, of a conjugate pair, on the second cam; face: roller, shoe, knife or flat; yoke_breadth [m]: distance
    of the two faces or roller centres of a yoke, else 0; arm: the second arm of a lever, which presses on a valve.
    """

    followers: tuple[Follower, ...]
    face: str
    cycle: Cycle
    yoke_breadth: float = 0.0
    arm: GuidedArm | None = None

    def __call__(self) -> tuple[Shape, ...]:
        """Stem or arms, and faces."""
        follower = self.followers[0]
        second = (Shape("body", capsule((0.0, 0.0), xy(self._tip), self.slim / 2)),) if self.arm else ()
        if isinstance(follower, FlatFollower):
            return (*second, *self._flat_carrier(follower), *self._flat_faces(follower))
        return (*second, *self._round_carrier(follower), *self._round_faces(follower))

    def valve(self) -> Iterator[Shape]:
        """The valve at zero lift, in the machine frame, hanging below the pad of the second arm; drawn, not to scale."""
        top, slim = self.origin + self._tip - 0.5j * self.slim, 0.5 * self.slim
        yield Shape("body", _strip(top - slim / 2, top - slim / 2 - 1j * self.size, complex(slim)))
        yield Shape("body", _strip(top - self.slim - 1j * self.size, top + self.slim - 1j * self.size, -0.5j * self.slim))

    @property
    def _tip(self) -> complex:
        """Centre of the pad of the second arm from the pivot at zero lift [m]; it falls as the lever swings clockwise."""
        return self.arm.length * complex(np.exp(-1j * self.arm.start)) if self.arm else 0j

    @cached_property
    def size(self) -> float:
        """Greatest distance of the pitch curve from the cam's centre [m]."""
        piece, angle = self.cycle.samples(np.radians(5))
        return float(np.max(np.abs(self.followers[0].contact(*self.cycle.at(piece, angle)).pitch.d0)))

    @property
    def origin(self) -> complex:
        """Origin of the follower's frame in the machine frame at zero lift [m]."""
        follower = self.followers[0]
        return complex(follower.pivot_distance) if isinstance(follower, OscillatingRound | OscillatingFlat) else 0j

    @property
    def centers(self) -> list[complex]:
        """Centres of the round faces in the follower's frame [m]: on the first cam, on a second cam or of a yoke's second roller."""
        zero = variable(np.array([0.0]))
        centers = [complex(each.pitch(zero, constant(zero.d0)).d0[0]) for each in self.followers if not isinstance(each, FlatFollower)]
        if self.yoke_breadth:
            centers.append(centers[0] - 1j * self.yoke_breadth)
        return [center - self.origin for center in centers]

    @property
    def radii(self) -> list[float]:
        """Radii of the round faces at `centers` [m]."""
        radii = [each.radius for each in self.followers if not isinstance(each, FlatFollower)]
        return radii + radii[:1] if self.yoke_breadth else radii

    @property
    def slim(self) -> float:
        """Width of stems and levers [m]."""
        return SLIM * self.size

    # -- round faces -------------------------------------------------------------------------------------------------------------

    def _round_carrier(self, follower: RoundFollower) -> Iterator[Shape]:
        """Stem of a slide, or arms of a lever, from the centres of the faces; from the back of a shoe."""
        anchors = self.centers
        if self.face == "shoe":
            anchors = [center - _away(follower) * (follower.radius - self._thickness(follower)) for center in anchors]
        if isinstance(follower, OscillatingRound):
            yield from (Shape("body", capsule((0.0, 0.0), xy(end), self.slim / 2)) for end in anchors)
            return
        yield self._stem(anchors[0])
        if len(anchors) > 1:
            yield self._frame(anchors[0], self.centers[1].imag)

    def _round_faces(self, follower: RoundFollower) -> Iterator[Shape]:
        for center, radius in zip(self.centers, self.radii, strict=True):
            if self.face == "roller":
                yield Shape("roller", circle(xy(center), radius))
                yield Shape("hole", circle(xy(center), 0.3 * radius))
            elif radius:
                yield Shape("body", self._shoe(follower, center, radius))
            else:
                corner = self.slim * _away(follower)
                yield Shape("body", polygon([xy(z) for z in (center, center + corner * (1 - 0.5j), center + corner * (1 + 0.5j))]))

    def _thickness(self, follower: RoundFollower) -> float:
        """Thickness of a curved shoe [m]."""
        return min(0.5 * self.slim, 0.5 * follower.radius)

    def _shoe(self, follower: RoundFollower, center: complex, radius: float) -> Outline:
        """A curved plate, as long as the contact wanders and a little more."""

        def pressure_angle(angle, lift):
            return follower.contact(angle, lift).pressure_angle

        steepest = max(abs(extreme(pressure_angle).value) for extreme in (self.cycle.minimum, self.cycle.maximum))
        reach = 0.15 + steepest
        inner, start = radius - self._thickness(follower), float(np.angle(-_away(follower))) - reach
        near, far = (lambda r, turn: xy(center + r * np.exp(1j * (start + turn)))), 2 * reach
        return Outline(
            (
                Arc(xy(center), radius, start, far),
                Line(near(radius, far), near(inner, far)),
                Arc(xy(center), inner, start + far, -far),
                Line(near(inner, 0.0), near(radius, 0.0)),
            )
        )

    # -- flat faces --------------------------------------------------------------------------------------------------------------

    def _flat_carrier(self, follower: FlatFollower) -> Iterator[Shape]:
        """Stem of a slide, or the arm that carries the face of a lever."""
        if isinstance(follower, OscillatingFlat):
            end = _away(follower) * (1j * follower.arm_length + follower.face_offset)
            yield Shape("body", capsule((0.0, 0.0), xy(end), self.slim / 2))
            return
        foot = _foot(follower)
        yield self._stem(foot)
        if self.yoke_breadth:
            yield self._frame(foot, foot.imag - self.yoke_breadth)

    def _flat_faces(self, follower: FlatFollower) -> Iterator[Shape]:
        """The flat face, as long as it is used and a little more, and the second face of a yoke."""
        thick = 0.5 * self.slim
        low, high = face_ends(self.cycle, follower)
        low, high = low - thick, high + thick
        if isinstance(follower, OscillatingFlat):
            normal = _away(follower)
            foot = follower.face_offset * normal
            yield Shape("body", _strip(foot + 1j * normal * max(low, 0.0), foot + 1j * normal * high, thick * normal))
            return
        normal = 1j * np.exp(1j * follower.sense * follower.tilt)
        along, start = -1j * follower.sense * normal, _foot(follower)
        yield Shape("body", _strip(start + low * along, start + high * along, thick * normal))
        if self.yoke_breadth:
            other = start - 1j * self.yoke_breadth
            yield Shape("body", _strip(other + low * along, other + high * along, -thick * normal))

    # -- slides ------------------------------------------------------------------------------------------------------------------

    def _stem(self, foot: complex) -> Shape:
        """The stem of a slide."""
        left = foot - self.slim / 2
        return Shape("body", _strip(left, complex(foot.real - self.slim / 2, 1.75 * self.size), complex(self.slim)))

    def _frame(self, top: complex, bottom: float) -> Shape:
        """The frame that joins the faces above and below the cam."""
        half, low, high = 1.15 * self.size + self.slim, bottom - self.slim, top.imag + self.slim
        return Shape("axis", polygon([(-half, low), (half, low), (half, high), (-half, high)]))


def _away(follower: Follower) -> complex:
    """Direction of the follower's path at zero lift, away from the cam."""
    return 1j * np.exp(-1j * follower.rest_angle) if isinstance(follower, OscillatingRound | OscillatingFlat) else 1j


def _foot(follower: TranslatingFlat) -> complex:
    """Where the line of a slide meets its flat face at zero lift [m]."""
    return follower.sense * follower.offset + 1j * (follower.base_radius + follower.offset * np.sin(follower.tilt)) / np.cos(follower.tilt)


def _strip(a: complex, b: complex, depth: complex) -> Outline:
    """A parallelogram from a to b, `depth` deep."""
    return polygon([xy(z) for z in (a, b, b + depth, a + depth)])
