"""The pins of a chain's joints and the holes they need: one class for each kind of joint.

All at the right end of a plate, in its pin frame; the left end is the mirror image.  The plate's own pin presses outwards on the
arc called "seat".  A joint turned by the angle t (positive over a sprocket, negative in back-bending) carries the neighbour's pin centre,
rolling on the own pin, to (A/2, 0) + 2 r (-cos(t/2), sin(t/2)): the line of centres turns half as far as the plate.
"""

from typing import NamedTuple, TypeAlias

import numpy as np

from drivewright._typing import ArrayLike, Floats, Numbers
from drivewright.chains.link import Link
from drivewright.chains.plate_outline import Pieces, outline
from drivewright.errors import InputError
from drivewright.numerics.roots import bracketed_roots
from drivewright.scene import Arc, Line, Outline, circle

_TURN = 2 * np.pi / 17  # a sprocket with fewer teeth than 17 is rare in a silent chain
_HINGE = 0.125  # radius of a hinge's pin over the pitch
_ROCKER = (0.17, 0.21, 0.02)  # radius of a rocker's back, its thickness, its clearance, over the pitch


def neighbour_center(link: Link, turn: Numbers) -> Floats:
    """Centre (..., 2) of the neighbour's pin when the joint is turned by `turn` [rad]."""
    half = 0.5 * np.asarray(turn, float)
    reach = 2 * link.radius
    return np.stack([0.5 * link.hole_pitch - reach * np.cos(half), reach * np.sin(half)], axis=-1)


def default_pins(link: Link) -> "Pins":
    """Pins that suit a link: one hinge pin for r = 0, round pins while two of their holes fit into a plate, else rockers."""
    if link.radius == 0:
        return HingePin(_HINGE * link.pitch)
    fits = link.radius < 0.18 * link.pitch
    return RoundPins() if fits else RockerPins(*(share * link.pitch for share in _ROCKER))


def joint_pins(kind: str, pitch: float, teeth: int, diameter: float | None = None) -> "Pins":
    """Pins of a "revolute", "round-pin" or "arc" joint (rockers) for a chain's pitch [m], which turn a tenth further than on so many teeth.

    diameter [m]: of a revolute joint's pin, a quarter of the pitch unless given.
    """
    if kind == "revolute":
        return HingePin(0.5 * diameter if diameter else _HINGE * pitch)
    turn = max(_TURN, 2.2 * np.pi / teeth)
    if kind == "round-pin":
        return RoundPins(turn=turn)
    back, thickness, clearance = (share * pitch for share in _ROCKER)
    return RockerPins(back, thickness, clearance, turn)


class HingePin(NamedTuple):
    """One round pin through both plates of a joint; radius [m].  The hole has the pin's radius."""

    radius: float
    pins_per_joint = 1

    def check(self, link: Link) -> None:
        """InputError where these pins do not fit the link."""
        if link.radius:
            raise InputError(f"HingePin: the link's pins roll with r = {link.radius * 1e3:.4g} mm; take RoundPins or RockerPins, or r = 0.")
        if not 0 < self.radius < 0.5 * link.hole_pitch:
            raise InputError(
                f"HingePin: radius = {self.radius * 1e3:.4g} mm; it lies between 0 and half the pitch, {link.hole_pitch * 500:.4g} mm."
            )

    def hole(self, link: Link) -> Pieces:
        """Pieces {name: Arc} of the hole, counter-clockwise."""
        center = (0.5 * link.hole_pitch, 0.0)
        return {"seat": Arc(center, self.radius, -0.5 * np.pi, np.pi), "slack": Arc(center, self.radius, 0.5 * np.pi, np.pi)}

    def pin(self, link: Link) -> Outline:
        """Outline of the plate's own pin."""
        return circle((0.5 * link.hole_pitch, 0.0), self.radius)

    def limits(self, link: Link) -> tuple[float, float]:
        """Joint angles (back, forward) [rad] between which the joint turns freely."""
        return -np.inf, np.inf


class RoundPins(NamedTuple):
    """Two round pins of radius r that roll on each other.

    The hole is the disk of radius r that seats the own pin, joined with the slot that leaves the neighbour's pin the radius
    clearance r while the joint turns from straight to `turn` [rad]; its lower wall stops back-bending at `back_turn` [rad].  The
    edges of the throat between the two are rounded with rounding r.
    """

    clearance: float = 1.12
    turn: float = _TURN
    back_turn: float = np.deg2rad(2.0)
    rounding: float = 0.15
    pins_per_joint = 2

    def check(self, link: Link) -> None:
        """InputError where these pins do not fit the link."""
        if not link.radius > 0:
            raise InputError(f"RoundPins: rolling radius r = {link.radius:.4g} m; it must be positive. A hinge with r = 0 takes HingePin.")
        if not 1 < self.clearance < 2:
            raise InputError(f"RoundPins: clearance = {self.clearance:.4g} pin radii; it lies between 1 (no play) and 2 (no throat).")
        if not (0 < self.turn < np.pi and self.back_turn >= 0 and self.rounding >= 0):
            raise InputError(
                f"RoundPins: turn = {self.turn:.4g} rad, back_turn = {self.back_turn:.4g} rad, rounding = "
                f"{self.rounding:.4g}; "
                "turn lies between 0 and pi, back_turn and rounding are not negative."
            )
        reach = (2 + self.clearance) * link.radius
        if reach >= 0.5 * link.hole_pitch:
            raise InputError(
                f"RoundPins: two holes that reach {reach * 1e3:.4g} mm inwards from the pin centres overlap in a plate of hole pitch "
                f"{link.hole_pitch * 1e3:.4g} mm. Take a smaller rolling radius, or RockerPins for a large one."
            )

    def _ends(self, link):
        """Directions from the own pin's centre to the centres of the slot's upper and lower end."""
        return np.pi - 0.5 * self.turn, np.pi - self._swing(link) + 0.5 * self.back_turn

    def _swing(self, link):
        """Turn of the line of centres that uses up the play: 4 r sin(s/2) = (clearance - 1) r."""
        return 2 * np.arcsin((self.clearance - 1) / 4)

    def hole(self, link: Link) -> Pieces:
        """Pieces {name: Arc} of the hole, counter-clockwise."""
        r, own = link.radius, 0.5 * link.hole_pitch
        c, k = self.clearance * r, self.rounding * r
        up, low = self._ends(link)
        near, far = r + k, c + k  # of the rounding's centre from the own pin and from the slot's end
        at_own = np.arccos((near**2 + 4 * r * r - far**2) / (4 * near * r))
        at_rounding = np.arccos((near**2 + far**2 - 4 * r * r) / (2 * near * far))
        around = at_own + at_rounding

        def from_own(distance, angle):
            return own + distance * float(np.cos(angle)), distance * float(np.sin(angle))

        pieces = {
            "seat": Arc((own, 0.0), r, low + at_own - 2 * np.pi, 2 * np.pi + up - low - 2 * at_own),
            "throat upper": Arc(from_own(near, up - at_own), k, up - at_own + np.pi, -at_rounding),
            "slot upper": Arc(from_own(2 * r, up), c, up - around, around),
            "slot": Arc((own, 0.0), 2 * r + c, up, low - up),
            "slot lower": Arc(from_own(2 * r, low), c, low, around),
            "throat lower": Arc(from_own(near, low + at_own), k, low + around + np.pi, -at_rounding),
        }
        return {name: arc for name, arc in pieces.items() if arc.radius > 0}

    def pin(self, link: Link) -> Outline:
        """Outline of the plate's own pin."""
        return circle((0.5 * link.hole_pitch, 0.0), link.radius)

    def limits(self, link: Link) -> tuple[float, float]:
        """Joint angles (back, forward) [rad] at which the neighbour's pin meets the ends of the slot."""
        return -self.back_turn, self.turn + 2 * self._swing(link)


class RockerPins(NamedTuple):
    """Two rockers: round rods of radius `back_radius` on which a rolling face of the link's radius r is ground, `thickness` [m] left.

    The rolling faces touch in the pitch point (p/2, 0).  The hole is the convex hull of the own rod, which it seats, and of a disk that
    leaves the neighbour's rod the `clearance` [m]; it stands in the middle between the rod's places in the straight joint and in the one
    turned by `turn` [rad].
    """

    back_radius: float
    thickness: float
    clearance: float
    turn: float = _TURN
    pins_per_joint = 2

    def check(self, link: Link) -> None:
        """InputError where these pins do not fit the link."""
        b, t = self.back_radius, self.thickness
        if not (b > 0 and self.clearance > 0 and 0 < self.turn < np.pi):
            raise InputError(
                f"RockerPins: back_radius = {b:.4g} m, clearance = {self.clearance:.4g} m, turn = {self.turn:.4g} rad; "
                "all are positive, turn below pi."
            )
        if not (b + 0.5 * self.clearance < t < 2 * b and link.radius > b):
            raise InputError(
                f"RockerPins: thickness = {t * 1e3:.4g} mm; with back_radius {b * 1e3:.4g} mm and clearance "
                f"{self.clearance * 1e3:.4g} mm it lies "
                f"between {(b + 0.5 * self.clearance) * 1e3:.4g} mm, where the neighbour's rocker covers the seat, and "
                f"{2e3 * b:.4g} mm, and the "
                f"rolling radius ({link.radius * 1e3:.4g} mm) exceeds back_radius."
            )
        if t + self.clearance >= 0.5 * link.pitch:
            raise InputError(
                f"RockerPins: two holes that reach {(t + self.clearance) * 1e3:.4g} mm from the pitch points "
                "overlap in a plate of "
                f"pitch {link.pitch * 1e3:.4g} mm. Take a smaller thickness."
            )
        back, forward = self.limits(link)
        if forward < self.turn or back > 0:
            raise InputError(
                f"RockerPins: the joint turns from {np.degrees(back):.4g} to {np.degrees(forward):.4g}° only, 0 to "
                f"{np.degrees(self.turn):.4g}° are required. Take a larger back_radius, more clearance or less turn."
            )

    def rod_center(self, link: Link, turn: ArrayLike) -> Floats:
        """Centre (..., 2) of the neighbour's rod when the joint is turned by `turn` [rad]."""
        arm = link.radius - self.thickness + self.back_radius
        turn = np.asarray(turn, float)
        return neighbour_center(link, turn) + arm * np.stack([np.cos(turn), -np.sin(turn)], axis=-1)

    def _middle(self, link):
        return np.mean(self.rod_center(link, [0.0, self.turn]), axis=0)

    def _own(self, link):
        return 0.5 * link.pitch + self.thickness - self.back_radius

    def hole(self, link: Link) -> Pieces:
        """Pieces {name: Arc or Line} of the hole, counter-clockwise."""
        own, b = complex(self._own(link)), self.back_radius
        other, c = complex(*self._middle(link)), self.back_radius + self.clearance
        heading, lean = np.angle(other - own), np.arccos((b - c) / abs(other - own))
        upper, lower = heading - lean, heading + lean  # directions of the normals of the common tangents

        def foot(center, radius, angle):
            z = center + radius * np.exp(1j * angle)
            return float(z.real), float(z.imag)

        return {
            "seat": Arc((own.real, 0.0), b, lower - 2 * np.pi, 2 * np.pi - 2 * lean),
            "side upper": Line(foot(own, b, upper), foot(other, c, upper)),
            "slot": Arc((other.real, other.imag), c, upper, 2 * lean),
            "side lower": Line(foot(other, c, lower), foot(own, b, lower)),
        }

    def _edge(self, link):
        """Half the height of the rolling face: where rod and face meet  [m]."""
        gap = link.radius - self.thickness + self.back_radius  # between the centres of the two circles
        along = (gap**2 + link.radius**2 - self.back_radius**2) / (2 * gap)
        return np.sqrt(link.radius**2 - along**2)

    def pin(self, link: Link) -> Outline:
        """Outline of the plate's own rocker."""
        edge, own, face = self._edge(link), self._own(link), 0.5 * link.hole_pitch
        half = np.arcsin(edge / link.radius)
        back = float(np.arctan2(edge, face - link.radius * np.cos(half) - own))
        return outline(
            {"back": Arc((own, 0.0), self.back_radius, -back, 2 * back), "face": Arc((face, 0.0), link.radius, np.pi - half, 2 * half)}
        )

    def limits(self, link: Link) -> tuple[float, float]:
        """Joint angles (back, forward) [rad]: the neighbour's rod meets the hole, or the contact reaches the edge of the rolling faces."""
        edge = 2 * np.arcsin(self._edge(link) / link.radius)
        middle = self._middle(link)

        def play(turn):
            return self.clearance - np.hypot(*np.moveaxis(self.rod_center(link, turn) - middle, -1, 0))

        roots = bracketed_roots(play, np.linspace(-edge, edge, 201))
        before, after = roots[roots < 0.5 * self.turn], roots[roots > 0.5 * self.turn]
        return float(before[-1]) if len(before) else -edge, float(after[0]) if len(after) else edge


Pins: TypeAlias = HingePin | RoundPins | RockerPins
