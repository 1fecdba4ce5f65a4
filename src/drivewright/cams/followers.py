"""Followers: how a lift becomes a cam profile, and what happens where the two touch.

A face is round (a roller, a shoe, a knife edge of radius 0) or flat; a follower translates along +y or swings about a pivot on +x.
Each follower is a few numbers and one method, `contact(angle, lift)`: jets of the cam angle and of the lift [m or rad] in, `CamContact`
out.  `sense` is +1 for a cam that turns counter-clockwise, -1 for clockwise; at angle 0 the cam's frame is the machine's.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from drivewright._typing import Complexes
from drivewright.cams import oscillating, translating
from drivewright.curves import derivative, envelope_of_line, tangent
from drivewright.errors import DoesNotAssemble
from drivewright.numerics.jets import Jet, atan, constant, cos, exp, sin


@dataclass(frozen=True, eq=False)
class CamContact:
    """The contact of cam and follower, in the cam's frame.  Jets hold value and slope by the cam angle.

    pitch [m]: centre of a round face, the point of contact of a flat one; pitch_curvature [1/m]: of its path.
    point [m], normal: where they touch and the unit vector from there into the follower.
    curvature [1/m]: of the cam's surface, positive convex.  pressure_angle [rad].
    leverage: travel along the normal per travel of the follower; force along its path = leverage * normal force, negative where the
    cam drives the return.
    sliding [m]: speed of the follower's body over the cam at the point, per unit of cam speed; a roller turns instead of sliding.
    rolling [m]: speed of the point of contact along the cam, per unit of cam speed; negative where the profile loops back.
    """

    pitch: Jet
    pitch_curvature: Jet
    point: Jet
    normal: Complexes
    curvature: Jet
    pressure_angle: Jet
    leverage: Jet
    sliding: Jet
    rolling: Jet


ContactAt: TypeAlias = Callable[[Jet, Jet], CamContact]  # of the jets angle and lift


def curvature(pitch: Jet, orientation: int = 1) -> Jet:
    """Signed curvature kappa = o Im(conj(B') B'')/|B'|^3 [1/m] as a jet with one valid derivative.

    orientation o = +1 where the curve runs counter-clockwise about the cam's centre, -1 clockwise; kappa > 0 is convex from outside.
    """
    tangent = derivative(pitch)
    return orientation * (tangent.conj() * derivative(tangent)).imag * tangent.abs2() ** -1.5


def _round_contact(follower, pitch, flank, pressure, spin):
    """CamContact of the circle about `pitch`.  flank +1: the cam's side, -1: the outer wall of a groove; spin: of the body over the cam."""
    pitch_curvature, along = curvature(pitch, -follower.sense), tangent(pitch)
    inward = -1j * flank * follower.sense * along
    with np.errstate(divide="ignore", invalid="ignore"):  # at a cusp the curvature is infinite
        surface = flank * pitch_curvature / (1 - flank * follower.radius * pitch_curvature)
    point = pitch + follower.radius * inward
    leverage = follower.side * flank * cos(pressure)
    return CamContact(pitch, pitch_curvature, point, -inward.d0, surface, pressure, leverage, *_speeds(pitch, point, along, spin))


def flat_radius(direction: Jet, support: Jet) -> Jet:
    """Radius of curvature p + p'' [m] under a line with its normal in `direction` phi at distance p = `support` (' = d/dphi), jets."""
    turn = derivative(direction)
    return support + derivative(derivative(support) / turn) / turn


def _flat_contact(direction, support, reference, pressure, leverage):
    """CamContact of a line, as in `flat_radius`; `reference` is any point of the follower's body."""
    turn, normal, point = derivative(direction), exp(1j * direction), envelope_of_line(direction, support)
    along = np.sign(turn.d0) * 1j * normal
    with np.errstate(divide="ignore", invalid="ignore"):
        surface = 1 / flat_radius(direction, support)
    return CamContact(point, surface, point, normal.d0, surface, pressure, leverage, *_speeds(reference, point, along, turn))


def _speeds(reference, point, tangent, spin):
    """(sliding, rolling): tangential speeds over the cam of the follower's body at the point, and of the point itself."""
    body = derivative(reference) + 1j * spin * (point - reference)
    return (body * tangent.conj()).real, (derivative(point) * tangent.conj()).real


@dataclass(frozen=True)
class TranslatingRound:
    """Roller, shoe or knife edge on a slide along +y at x = sense * offset.  side -1: on the far side of the cam."""

    prime_radius: float
    radius: float
    offset: float = 0.0
    sense: int = 1
    side: int = 1

    reach = 1.0  # travel of the follower [m] per lift

    def pitch(self, angle: Jet, lift: Jet) -> Jet:
        """Centre of the face in the cam frame [m], from the jets of the cam angle and of the lift [m]."""
        low = translating.rest_height(self.prime_radius, self.offset) + np.min(self.side * lift.d0)
        if low <= 0:
            raise DoesNotAssemble(
                f"translating follower: the lift takes the roller's centre to {1e3 * low:.6g} mm above the cam's centre; "
                f"enlarge prime_radius by more than {-1e3 * low:.6g} mm or reduce the lift."
            )
        pitch = translating.pitch_curve(angle, lift, self.prime_radius, self.offset, self.side)
        return pitch if self.sense > 0 else -pitch.conj()

    def contact(self, angle: Jet, lift: Jet, flank: int = 1) -> CamContact:
        """`CamContact` from the jets of the cam angle and of the lift [m]; flank -1 is the outer wall of a groove."""
        pressure = translating.pressure_angle(angle, lift, self.prime_radius, self.offset, self.side)
        return _round_contact(self, self.pitch(angle, lift), flank, pressure, -self.sense * derivative(angle))


@dataclass(frozen=True)
class OscillatingRound:
    """Roller, shoe or knife edge on an arm about the pivot (pivot_distance, 0); a positive lift [rad] swings it clockwise.

    side +1: the roller is above the x axis, and rises away from the cam; side -1: below, and the cam drives it back.
    """

    prime_radius: float
    radius: float
    pivot_distance: float
    arm_length: float
    sense: int = 1
    side: int = 1

    @property
    def reach(self) -> float:
        """Travel of the roller's centre [m] per swing [rad]."""
        return self.arm_length

    @property
    def rest_angle(self) -> float:
        """Angle between the arm and the line from pivot to cam centre at zero lift [rad]."""
        return oscillating.rest_angle(self.prime_radius, self.pivot_distance, self.arm_length)

    def pitch(self, angle: Jet, lift: Jet) -> Jet:
        """Centre of the face in the cam frame [m], from the jets of the cam angle and of the swing [rad]."""
        psi = self.rest_angle + self.side * lift
        _refuse_swing(psi.d0, 0.0, np.pi)
        return oscillating.pitch_curve(-self.sense * angle, psi, self.pivot_distance, self.arm_length, self.side)

    def contact(self, angle: Jet, lift: Jet, flank: int = 1) -> CamContact:
        """`CamContact` from the jets of the cam angle and of the swing [rad]; flank -1 is the outer wall of a groove."""
        psi = self.rest_angle + self.side * lift
        pressure = oscillating.pressure_angle(-self.sense * angle, psi, self.pivot_distance, self.arm_length, self.side)
        return _round_contact(self, self.pitch(angle, lift), flank, pressure, -(derivative(lift) + self.sense * derivative(angle)))


@dataclass(frozen=True)
class TranslatingFlat:
    """Flat face on a slide along +y at x = sense * offset; `tilt` [rad] leans its normal against the cam's turning."""

    base_radius: float
    tilt: float = 0.0
    offset: float = 0.0
    sense: int = 1

    reach = 1.0

    def face(self, angle: Jet, lift: Jet) -> tuple[Jet, Jet]:
        """(direction, support): of the normal of the face [rad] and the distance from the cam's centre [m], in the cam frame."""
        support = self.base_radius + np.cos(self.tilt) * lift
        _refuse_crossing(support.d0)
        return np.pi / 2 + self.sense * (self.tilt - angle), support

    def contact(self, angle: Jet, lift: Jet) -> CamContact:
        """`CamContact` from the jets of the cam angle and of the lift [m]."""
        reference = (self.sense * self.offset + 1j * lift) * exp(-1j * self.sense * angle)
        tilt = constant(self.tilt + 0.0 * lift.d0)
        return _flat_contact(*self.face(angle, lift), reference, tilt, cos(tilt))


@dataclass(frozen=True)
class OscillatingFlat:
    """Flat face on a lever about the pivot (pivot_distance, 0), `face_offset` beyond the parallel line through the pivot.

    The base radius is the distance of the face from the cam's centre at zero lift; force and mass are counted at arm_length.
    """

    base_radius: float
    pivot_distance: float
    arm_length: float
    face_offset: float = 0.0
    sense: int = 1

    @property
    def reach(self) -> float:
        """Travel [m] at the arm length per swing [rad]."""
        return self.arm_length

    @property
    def rest_angle(self) -> float:
        """asin((R - d)/C): angle between the face and the line from pivot to cam centre at zero lift [rad]."""
        height = self.base_radius - self.face_offset
        if not abs(height) < self.pivot_distance:
            raise DoesNotAssemble(
                f"oscillating flat follower: base radius {1e3 * self.base_radius:.6g} mm less face_offset {1e3 * self.face_offset:.6g} mm "
                f"must be smaller than pivot_distance {1e3 * self.pivot_distance:.6g} mm. Move the pivot away or change the base radius."
            )
        return np.arcsin(height / self.pivot_distance)

    def face(self, angle: Jet, lift: Jet) -> tuple[Jet, Jet]:
        """(direction, support): phi = pi/2 - psi - sense angle and p = C sin psi + d of the face in the cam frame, jets."""
        psi = self.rest_angle + lift
        _refuse_swing(psi.d0, -np.pi / 2, np.pi / 2)
        if np.any(1 + self.sense * lift.d1 / angle.d1 <= 0):
            raise DoesNotAssemble(
                f"oscillating flat follower: the lever turns as fast as the cam (d swing/d angle reaches {-self.sense}), and no profile "
                "does that. Spread the motion over a larger cam angle or reduce the rise."
            )
        support = self.pivot_distance * sin(psi) + self.face_offset
        _refuse_crossing(support.d0)
        return np.pi / 2 - psi - self.sense * angle, support

    def contact(self, angle: Jet, lift: Jet) -> CamContact:
        """`CamContact` from the jets of the cam angle and of the swing [rad]."""
        # Distance of the contact from the foot of the pivot along the face.
        lever = self.pivot_distance * cos(self.rest_angle + lift) / (1 + self.sense * derivative(lift) / derivative(angle))
        pivot = self.pivot_distance * exp(-1j * self.sense * angle)
        return _flat_contact(*self.face(angle, lift), pivot, self.sense * atan(self.face_offset / lever), lever / self.arm_length)


def _refuse_crossing(support):
    """A flat face must stay on its side of the cam's centre."""
    low = np.min(support)
    if low <= 0:
        raise DoesNotAssemble(
            f"flat follower: the lift takes the face {-1e3 * low:.6g} mm beyond the cam's centre and nothing is left "
            "of the cam; enlarge the base radius (prime_radius) by more than that or reduce the fall."
        )


def _refuse_swing(psi, low, high):
    """The lever must stay on one side of its dead points."""
    least, greatest = np.min(psi), np.max(psi)
    if not (least > low and greatest < high):
        raise DoesNotAssemble(
            f"oscillating follower: the lever swings from {np.degrees(least):.6g} to {np.degrees(greatest):.6g} deg against the line of "
            f"centres, but it drives only between {np.degrees(low):.6g} and {np.degrees(high):.6g} deg. Reduce the rise, or change "
            "prime_radius or arm_length."
        )
