"""A lever with two rollers between conjugate cams, its pivot carried around them: all as functions of a driving angle t [rad].

Functions take t as an array and give jets in it, in the frame of the cams: axis at the origin, lever pivot on -y where its orbit
angle is 0.  A mass on a straight path is driven by the lever's output arm: its travel g and the swing phi obey g = l tan(phi).
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, partial
from typing import NamedTuple

import numpy as np

from drivewright._typing import ArrayLike, Floats, Ints
from drivewright.cams import oscillating
from drivewright.cams.profile import Overtravel
from drivewright.curves import CircleFamily, Member, Piece, Trimmed, curvature, trim
from drivewright.motion import Programme
from drivewright.numerics.jets import Jet, atan
from drivewright.numerics.roots import extremes
from drivewright.scene import Arc, Outline, Spline, xy

SAMPLES = 181  # per smooth piece, before an extreme is refined


@dataclass(frozen=True)
class ConjugateCam:
    """One of the two cams with its roller arm; `side` +1: the swing drives the roller outwards (main), -1: inwards (return)."""

    name: str
    arm: float
    prime_radius: float
    side: int
    pivot_distance: float
    roller_radius: float

    @cached_property
    def rest_angle(self) -> float:
        """Angle between arm and line pivot - cam axis at zero swing [rad]."""
        return oscillating.rest_angle(self.prime_radius, self.pivot_distance, self.arm)

    def psi(self, swing: Jet) -> Jet:
        """Angle between arm and line pivot - cam axis, from the lever's swing."""
        return self.rest_angle + self.side * swing

    def pitch(self, pivot_angle: Jet, swing: Jet) -> Jet:
        """Roller centre in the frame of the cams, a complex jet [m]."""
        return oscillating.pitch_curve(pivot_angle, self.psi(swing), self.pivot_distance, self.arm, self.side)

    def pressure_angle(self, pivot_angle: Jet, swing: Jet) -> Jet:
        """Angle between contact normal and roller path, a jet [rad]; positive where it opposes an opening arm."""
        return oscillating.pressure_angle(pivot_angle, self.psi(swing), self.pivot_distance, self.arm, self.side)


class SmoothPiece(NamedTuple):
    """A stretch of the programme without a jump: driving angles at its ends [rad], phase, number."""

    low: float
    high: float
    phase: str
    number: int


@dataclass(frozen=True, eq=False)
class ConjugatePair:
    """The pair of cams and the motion of their lever.

    programme: travel g [m] of the mass over the driving angle since `start` [rad]; output_arm: l [m]; orbit_angle(t): orbit of the
    pivot [rad], a jet, of which `orbit` is the sense, +1 counter-clockwise.
    """

    cams: tuple[ConjugateCam, ...]
    programme: Programme
    start: float
    output_arm: float
    orbit: int
    orbit_angle: Callable[[ArrayLike], Jet]

    @cached_property
    def pieces(self) -> tuple[SmoothPiece, ...]:
        """The smooth intervals of one turn from the start of the programme on."""
        pieces = enumerate(self.programme.pieces)
        return tuple(SmoothPiece(self.start + p.theta0, self.start + p.theta1, p.phase, k) for k, p in pieces)

    def travel(self, t: ArrayLike, piece: int | Ints | None = None) -> Jet:
        """Travel of the mass g(t), a jet [m]; by the formula of one piece where given."""
        angle = np.asarray(t) - self.start
        return Jet(*(self.programme(angle) if piece is None else self.programme.on_piece(piece, angle)))

    def swing(self, t: ArrayLike, piece: int | Ints | None = None) -> Jet:
        """Swing of the lever, atan(g / l), a jet [rad]."""
        return atan(self.travel(t, piece) / self.output_arm)

    def pivot_angle(self, t: ArrayLike) -> Jet:
        """Direction of the lever pivot seen from the cams: q - pi/2 with q = orbit * orbit_angle, a jet [rad]."""
        return self.orbit * self.orbit_angle(t) - np.pi / 2

    def pitch(self, cam: ConjugateCam, t: ArrayLike, piece: int | Ints | None = None) -> Jet:
        """Pitch curve of a cam, complex jet [m]."""
        return cam.pitch(self.pivot_angle(t), self.swing(t, piece))

    def pressure_angle(self, cam: ConjugateCam, t: ArrayLike, piece: int | Ints | None = None) -> Jet:
        """Pressure angle of a cam, jet [rad]."""
        return cam.pressure_angle(self.pivot_angle(t), self.swing(t, piece))

    def curvature(self, cam: ConjugateCam, t: ArrayLike, piece: int | Ints | None = None) -> Floats:
        """Curvature of the pitch curve [1/m], positive where convex seen from outside."""
        return self.orbit * curvature(self.pitch(cam, t, piece))

    # -- extremes ----------------------------------------------------------------------------------------------------------------

    def max_pressure_angle(self, cam: ConjugateCam, phase: str) -> float:
        """Largest magnitude of the pressure angle [rad] in a phase of the programme, over its smooth pieces one-sidedly."""
        return max(
            extremes(lambda t, k=k: np.abs(self.pressure_angle(cam, t, k).d0), low, high, SAMPLES)[3]
            for low, high, name, k in self.pieces
            if name == phase
        )

    def min_convex_radius(self, cam: ConjugateCam) -> tuple[float, float]:
        """(radius [m], driving angle [rad]) of the sharpest convex place of a pitch curve."""
        curvatures = [extremes(lambda t, k=k: self.curvature(cam, t, k), low, high, SAMPLES) for low, high, _, k in self.pieces]
        sharpest, place = max((greatest, place) for _, _, place, greatest in curvatures)
        return 1 / sharpest, place

    def pitch_radii(self, cam: ConjugateCam) -> tuple[float, float]:
        """(least, greatest) radius [m] of a pitch curve."""
        _, least, _, greatest = extremes(lambda t: np.abs(self.pitch(cam, t).d0), self.start, self.start + 2 * np.pi)
        return least, greatest

    # -- profiles ----------------------------------------------------------------------------------------------------------------

    @cached_property
    def trimmed(self) -> dict[str, Trimmed]:
        """Real profile of each cam by name."""
        return {cam.name: trim(self.family(cam)) for cam in self.cams}

    def overtravel(self, cam: ConjugateCam) -> Overtravel:
        """How a roller goes along its path beyond the programme into its cam, for `curves.lost_motion`."""

        def place(t, depth):
            return cam.pitch(self.pivot_angle(t), self.swing(t) - cam.side * depth / cam.arm).d0

        return Overtravel(place, 1.0)

    def family(self, cam: ConjugateCam) -> CircleFamily:
        """The roller's motion around its cam, for enveloping."""
        at = partial(self._pitch_on, cam)
        pieces = [Piece(low, high, Member(at, (k,)), phase, "arc" if phase == "dwell" else "smooth") for low, high, phase, k in self.pieces]
        return CircleFamily(tuple(pieces), cam.roller_radius)

    def _pitch_on(self, cam, piece, t):
        """`pitch` by the formula of a piece, or of a piece of its own at each t."""
        return self.pitch(cam, t, np.asarray(piece).astype(int))

    def pitch_outline(self, cam: ConjugateCam) -> Outline:
        """The pitch curve once round: true arcs while the lever rests, splines with exact end tangents while it swings."""
        pieces, ends = [], np.array([(low, high) for low, high, _, _ in self.pieces])
        whole = self.pitch(cam, np.linspace(ends[:, 0], ends[:, 1], SAMPLES), np.array([k for _, _, _, k in self.pieces]))
        for n, (low, high, phase, _) in enumerate(self.pieces):
            jet = whole[:, n]
            if phase == "dwell":
                sweep = self.orbit * float(np.diff(self.orbit_angle(np.array([low, high])).d0)[0])
                pieces.append(Arc((0.0, 0.0), float(abs(jet.d0[0])), float(np.angle(jet.d0[0])), sweep))
            else:
                tangents = jet.d1 / np.abs(jet.d1)
                pieces.append(Spline(np.stack([jet.d0.real, jet.d0.imag], axis=1), xy(tangents[0]), xy(tangents[-1])))
        return Outline(tuple(pieces))

    # -- forces ------------------------------------------------------------------------------------------------------------------

    def lever_moment(self, force: Floats, swing: Floats) -> Floats:
        """Moment M = F dg/dphi = F l/cos^2(phi) [N m] on the lever that gives the mass a force F [N] along its travel, by virtual work."""
        return force * self.output_arm / np.cos(swing) ** 2

    def roller_force(self, cam: ConjugateCam, moment: Floats, t: ArrayLike, piece: int | Ints | None = None) -> Floats:
        """Normal force [N] of a roller without play, N = M/(L cos(alpha)) where the moment M [N m] falls to this cam, else 0."""
        leverage = cam.arm * np.cos(self.pressure_angle(cam, t, piece).d0)
        return np.maximum(cam.side * moment, 0.0) / leverage
