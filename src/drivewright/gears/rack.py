"""The rack that cuts a gear: its profile, the pieces of its envelope on a pitch curve, and its distance from a point.

Frame at the driver angle x: origin at the contact point z(x) of the pitch curve, T along the direction in which the contact
runs, N outward.  The rack's pitch line lies on T; its point at the coordinate xi touches the pitch curve where the rolled
arc length is s = xi.  A cutter tooth stands on xi_c, straight flanks at alpha, its tip (depth h_d) rounded by rho.  A point of its
surface cuts when the normal there passes through z; with w = side (s - xi_c), h = p/4 + backlash/4:

    flank   z + (w - h) cos(alpha) (-side cos(alpha) T + sin(alpha) N)
    fillet  z + (1 + rho/l) (side (u - w) T - e N),   (u, -e) centre of the rounding, l = |(u - w, e)|
    root    z - h_d N
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from drivewright._typing import ArrayLike, Complexes, Floats, Ints, Numbers
from drivewright.curves import Member, Piece, derivative, tangent
from drivewright.errors import InputError, SolverError
from drivewright.gears.rolling import RollingPair
from drivewright.numerics.jets import Jet

_REACH = 1.5  # a cutter this many pitches long on either side cuts everything that an endless one would
_FAR = 1e3  # gap, in pitches, given to members out of reach


@dataclass(frozen=True)
class Rack:
    """Basic rack: pressure angle [rad]; addendum, dedendum and tip rounding in modules; backlash in modules of arc.

    The rounding is that of the cutter's tip, which leaves the fillet at the gear's root.  Default values are the common
    full-depth profile (recalled; the straight flank then ends 1.0 modules below the pitch line).
    """

    pressure_angle: float = np.deg2rad(20.0)
    addendum: float = 1.0
    dedendum: float = 1.25
    rounding: float = 0.25 / (1 - np.sin(np.deg2rad(20.0)))
    backlash: float = 0.0

    def __post_init__(self):
        if not 0 < self.pressure_angle < np.pi / 4:
            raise InputError(f"Rack: pressure_angle = {self.pressure_angle:.4g} rad; it lies between 0 and pi/4 (20° is 0.349).")
        for name in ("addendum", "dedendum"):
            if not getattr(self, name) > 0:
                raise InputError(f"Rack: {name} = {getattr(self, name):.4g} modules; it must be positive.")
        if not 0 <= self.backlash < np.pi / 2:
            raise InputError(f"Rack: backlash = {self.backlash:.4g} modules; it lies between 0 and pi/2.")
        if self.rounding <= 0 or self.land < 0:
            raise InputError(
                f"Rack: rounding = {self.rounding:.4g} modules leaves a tip land of {2 * self.land:.4g} modules; it must be positive and "
                f"at most {self.rounding + self.land * np.cos(self.pressure_angle) / (1 - np.sin(self.pressure_angle)):.4g}."
            )
        if self.straight <= 0:
            raise InputError(
                f"Rack: the rounding begins {-self.straight:.4g} modules above the pitch line; take a smaller one or more dedendum."
            )

    @property
    def half_width(self) -> float:
        """Half the cutter tooth on the pitch line, in modules: pi/4 + backlash/4."""
        return np.pi / 4 + self.backlash / 4

    @property
    def center_depth(self) -> float:
        """Depth e of the centre of the rounding below the pitch line, in modules."""
        return self.dedendum - self.rounding

    @property
    def land(self) -> float:
        """Half the flat tip u, in modules: the place of the centre of the rounding."""
        return self.half_width - (self.center_depth * np.sin(self.pressure_angle) + self.rounding) / np.cos(self.pressure_angle)

    @property
    def straight(self) -> float:
        """Depth to which the flank is straight, in modules."""
        return self.dedendum - self.rounding * (1 - np.sin(self.pressure_angle))


@dataclass(frozen=True)
class RackFamily:
    """The rack rolling around the pitch curve of gear 1 or 2 of a pair, with whole `teeth`; a family for `curves.trim`.

    phase: place of the first tooth space of gear 1, in pitches of arc from the contact at angle 0; gear 2 has a tooth there.
    """

    pair: RollingPair
    gear: int
    teeth: int
    rack: Rack
    phase: float = 0.0

    material, whole = "inside", True

    @property
    def period(self) -> float:
        """Driver angle during which the gear turns once."""
        n, m = self.pair.lobes
        return 2 * np.pi * (1.0 if self.gear == 1 else m / n)

    @cached_property
    def module(self) -> float:
        """Module [m]."""
        return self.pair.module(self.teeth, self.gear)

    @property
    def spaces(self) -> Floats:
        """Rack coordinates of the tooth spaces' centres [m]."""
        return (self.phase + 0.5 * (self.gear - 1) + np.arange(self.teeth, dtype=float)) * np.pi * self.module

    def frame(self, x: ArrayLike) -> tuple[Jet, Jet, Jet, Jet]:
        """z, T, N, s as jets of the driver angle (T and N: second derivative nan)."""
        z = self.pair.pitch_curve(self.gear, x)
        along = tangent(z)
        speed = derivative(z).abs2() ** 0.5
        return z, along, (1j if self.gear == 1 else -1j) * along, Jet(self.pair.arc_length(x), *list(speed)[:3])

    def flank(self, center: Numbers, side: Numbers, x: ArrayLike) -> Jet:
        """Envelope of the flank on the `side` (+1: ahead, -1: behind) of the cutter tooth at `center`."""
        s, c = np.sin(self.rack.pressure_angle), np.cos(self.rack.pressure_angle)
        half = self.rack.half_width * self.module
        z, along, outward, rolled = self.frame(x)
        return z + (side * (rolled - center) - half) * c * (s * outward - side * c * along)

    def fillet(self, center: Numbers, side: Numbers, x: ArrayLike) -> Jet:
        """Envelope of the rounded corner of the cutter's tip."""
        land, depth, rounding = (self.module * value for value in (self.rack.land, self.rack.center_depth, self.rack.rounding))
        z, along, outward, rolled = self.frame(x)
        beside = land - side * (rolled - center)
        return z + (1 + rounding * (beside * beside + depth**2) ** -0.5) * (side * beside * along - depth * outward)

    def parallel(self, height: Numbers, x: ArrayLike) -> Jet:
        """The curve at a height [m] outside the pitch curve: tip and root."""
        z, _, outward, _ = self.frame(x)
        return z + height * outward

    def envelope(self) -> tuple[Piece, ...]:
        """Pieces of the gear's boundary in the direction of the driver angle, five per tooth space and the tip of the tooth after it."""
        tip, flank_ends, shape = Member(self.parallel, (self.rack.addendum * self.module,)), self._tip_corners, self.round_shape
        pieces = []
        for k in range(self.teeth):
            behind, ahead = flank_ends[0][k]
            pieces += self._space(k, behind, ahead, shape)
            following = flank_ends[1][(k + 1) % self.teeth, 0] + (self.period if k == self.teeth - 1 else 0.0)
            pieces.append(Piece(flank_ends[1][k, 1], following, tip, f"tip {k}", shape, 0))
        return tuple(pieces)

    def _space(self, k, behind, ahead, shape):
        center, (a, b, c, d) = self.spaces[k], self._root_corners[k]
        yield Piece(behind, a, Member(self.flank, (center, -1.0)), f"flank {k}-", "smooth", 0)
        yield Piece(a, b, Member(self.fillet, (center, -1.0)), f"fillet {k}-", "smooth", 0)
        if self.rack.land > 0:
            yield Piece(b, c, Member(self.parallel, (-self.rack.dedendum * self.module,)), f"root {k}", shape, 0)
        yield Piece(c, d, Member(self.fillet, (center, 1.0)), f"fillet {k}+", "smooth", 0)
        yield Piece(d, ahead, Member(self.flank, (center, 1.0)), f"flank {k}+", "smooth", 0)

    @cached_property
    def _root_corners(self):
        """Driver angles (teeth, 4) at which flank, fillet, root, fillet and flank of each space meet."""
        join, land = self._join * self.module, self.rack.land * self.module
        return self.pair.arc_length.inverse(self.spaces[:, None] + np.array([-join, -land, land, join]))

    @property
    def _join(self):
        """w at which flank and fillet meet, in modules."""
        return self.rack.land - self.rack.center_depth / np.tan(self.rack.pressure_angle)

    @cached_property
    def round_shape(self) -> str:
        """A pitch circle about the axis has arcs for tips and roots."""
        radius = np.abs(self.pair.pitch_curve(self.gear, np.linspace(0, self.period, 37)).d0)
        return "arc" if np.ptp(radius) < 1e-12 * np.max(radius) else "smooth"

    @cached_property
    def _tip_corners(self):
        """Driver angles at which each space's two flanks (behind, ahead) reach the tip curve: on the flank, and on the tip curve.

        Newton's method on flank(x) = tip(y) for all flanks at once.
        """
        s, c = np.sin(self.rack.pressure_angle), np.cos(self.rack.pressure_angle)
        half, height = self.rack.half_width * self.module, self.rack.addendum * self.module
        centers, sides = np.repeat(self.spaces, 2), np.tile([-1.0, 1.0], self.teeth)
        x = self.pair.arc_length.inverse(centers + sides * (half + height / (s * c)))
        y = self.pair.arc_length.inverse(centers + sides * (half + height * s / c))
        miss = np.full(len(x), np.inf, dtype=complex)
        for _ in range(30):
            p, q = self.flank(centers, sides, x), self.parallel(height, y)
            miss, area = q.d0 - p.d0, np.imag(np.conj(p.d1) * q.d1)
            step = np.imag(np.conj(miss) * q.d1) / area
            x, y = x + step, y + np.imag(np.conj(miss) * p.d1) / area
            if np.max(np.abs(miss)) < 1e-14 * self.module * self.teeth:
                return x.reshape(-1, 2), y.reshape(-1, 2)
        worst = int(np.argmax(np.abs(miss)))
        raise SolverError(
            f"gear teeth: flank {worst % 2} of space {worst // 2} does not reach the tip curve {height * 1e3:.4g} mm above the "
            f"pitch curve; they stay {np.abs(miss[worst]) * 1e3:.3g} mm apart. Take more teeth or less addendum."
        )

    # -- the cutting family, as `curves.trim` asks for it ----------------------------------------------------------------------

    def members(self, index: Ints, t: Floats) -> Complexes:
        """Rows z, T, N, s of the frame at driver angles t."""
        return np.stack([part.d0 + 0j for part in self.frame(t)])

    def gap(self, member: Any, point: Any) -> Any:
        """Distance [m] of a point from the rack in the given frame, negative inside a cutter tooth."""
        z, along, outward, rolled = member
        away, height = np.real(np.conj(along) * (point - z)), np.real(np.conj(outward) * (point - z))
        pitch = np.pi * self.module
        u = np.abs((rolled.real + away - self.spaces[0] + 0.5 * pitch) % pitch - 0.5 * pitch)
        return np.where(np.abs(away) > _REACH * pitch, _FAR * pitch, self._from_tooth(u, height))

    def _from_tooth(self, u, height):
        """Signed distance of (u >= 0, height) from the rounded tooth standing at u = 0."""
        s, c = np.sin(self.rack.pressure_angle), np.cos(self.rack.pressure_angle)
        beside, above = u - self.rack.land * self.module, height + self.rack.center_depth * self.module
        straight = np.maximum((u - self.rack.half_width * self.module) * c - height * s, -(height + self.rack.dedendum * self.module))
        corner = (beside >= 0) & (beside * s + above * c <= 0)
        return np.where(corner, np.hypot(beside, above) - self.rack.rounding * self.module, straight)

    def deepest(self, members: Complexes, points: Complexes, chunk: int = 500) -> Ints:
        """For each point the number of the member with the least gap, among those whose contact is within reach."""
        from scipy.spatial import KDTree

        rolled = np.mod(members[3].real, self.pair.perimeter(self.gear))
        order = np.argsort(rolled)
        tree = KDTree(np.stack([members[0].real, members[0].imag], axis=1))
        nearest = rolled[tree.query(np.stack([points.real, points.imag], axis=1))[1]]
        reach = _REACH * np.pi * self.module
        turn = self.pair.perimeter(self.gear)
        around = np.concatenate([rolled[order] - turn, rolled[order], rolled[order] + turn])
        low, high = np.searchsorted(around, nearest - reach), np.searchsorted(around, nearest + reach)
        window = np.arange(np.max(high - low))
        best = np.empty(len(points), dtype=int)
        for part in np.array_split(np.arange(len(points)), max(1, len(points) // chunk)):
            number = order[(low[part, None] + window) % len(order)]
            gaps = self.gap(members[:, number], points[part, None])
            best[part] = number[np.arange(len(part)), np.argmin(gaps, axis=1)]
        return best
