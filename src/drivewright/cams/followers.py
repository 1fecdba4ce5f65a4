"""Followers: how a lift becomes a cam profile, and what happens where the two touch.

A face is round (a roller, a shoe, a knife edge of radius 0) or flat; a follower translates along +y or swings about a pivot on +x.
Each follower is a few numbers (or, of many designs at once, columns (n, 1) of them) and one method, `contact(angle, lift)`: jets of the
cam angle and of the lift [m or rad] in, `CamContact` out.  `sense` is +1 for a cam that turns counter-clockwise, -1 for clockwise; at
angle 0 the cam's frame is the machine's.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

import numpy as np

from drivewright._typing import Complexes
from drivewright.cams import oscillating, translating
from drivewright.cams.refusals import first_refused
from drivewright.curves import derivative, envelope_of_line, tangent
from drivewright.errors import DoesNotAssemble
from drivewright.numerics.jets import Jet, atan, constant, cos, exp, sin


@dataclass(frozen=True, eq=False)
class CamContact:
    """The contact of cam and follower, in the cam's frame, from the jets of the cam angle and of the lift.

    Each quantity is computed when it is first asked for.  Jets hold value and slope by the cam angle.  flank +1: the cam's side, -1: the
    outer wall of a groove; way -1 where the contact drives the return.
    """

    follower: "TranslatingRound | OscillatingRound | TranslatingFlat | OscillatingFlat"
    angle: Jet
    lift: Jet
    flank: int = 1
    way: int = 1

    @cached_property
    def pitch(self) -> Jet:
        """Centre of a round face, the point of contact of a flat one [m]."""
        raise NotImplementedError

    @cached_property
    def pitch_curvature(self) -> Jet:
        """Curvature of the path of `pitch` [1/m], positive convex."""
        raise NotImplementedError

    @cached_property
    def point(self) -> Jet:
        """Where they touch [m]."""
        raise NotImplementedError

    @cached_property
    def normal(self) -> Complexes:
        """Unit vector from `point` into the follower."""
        raise NotImplementedError

    @cached_property
    def curvature(self) -> Jet:
        """Curvature of the cam's surface [1/m], positive convex."""
        raise NotImplementedError

    @cached_property
    def pressure_angle(self) -> Jet:
        """Pressure angle [rad]."""
        raise NotImplementedError

    @cached_property
    def leverage(self) -> Jet:
        """Travel along the normal per travel of the follower; force along its path = leverage * normal force, negative where the cam
        drives the return."""
        raise NotImplementedError

    @cached_property
    def tangent(self) -> Jet:
        """Unit tangent of the cam's surface, in the sense in which the contact moves where there is no undercut."""
        raise NotImplementedError

    @cached_property
    def reference(self) -> Jet:
        """A point of the follower's body [m]."""
        raise NotImplementedError

    @cached_property
    def spin(self) -> Jet:
        """Turning of the follower's body over the cam, per unit of cam speed."""
        raise NotImplementedError

    @cached_property
    def sliding(self) -> Jet:
        """Speed of the follower's body over the cam at the point, per unit of cam speed [m]; a roller turns instead of sliding."""
        body = derivative(self.reference) + 1j * self.spin * (self.point - self.reference)
        return (body * self.tangent.conj()).real

    @cached_property
    def rolling(self) -> Jet:
        """Speed of the point of contact along the cam, per unit of cam speed [m]; negative where the profile loops back."""
        return (derivative(self.point) * self.tangent.conj()).real


ContactAt: TypeAlias = Callable[[Jet, Jet], CamContact]  # of the jets angle and lift


def curvature(pitch: Jet, orientation: int = 1) -> Jet:
    """Signed curvature kappa = o Im(conj(B') B'')/|B'|^3 [1/m] as a jet with one valid derivative.

    orientation o = +1 where the curve runs counter-clockwise about the cam's centre, -1 clockwise; kappa > 0 is convex from outside.
    """
    tangent = derivative(pitch)
    return orientation * (tangent.conj() * derivative(tangent)).imag * tangent.abs2() ** -1.5


class RoundContact(CamContact):
    """The contact of a round face, whose centre runs along `pitch`."""

    follower: "TranslatingRound | OscillatingRound"

    @cached_property
    def pitch(self) -> Jet:
        """Centre of the face [m]."""
        return self.follower.pitch(self.angle, self.lift)

    @cached_property
    def pitch_curvature(self) -> Jet:
        """Curvature of the path of the centre [1/m], positive convex."""
        return curvature(self.pitch, -self.follower.sense)

    @cached_property
    def tangent(self) -> Jet:
        """Unit tangent of the path of the centre."""
        return tangent(self.pitch)

    @cached_property
    def inward(self) -> Jet:
        """Unit vector from the centre of the face to the cam's surface."""
        return -1j * self.flank * self.follower.sense * self.tangent

    @cached_property
    def point(self) -> Jet:
        """Where they touch [m]: q = B + r n, n the unit vector inward."""
        return self.pitch + self.follower.radius * self.inward

    @cached_property
    def normal(self) -> Complexes:
        """Unit vector from `point` into the follower."""
        return -self.inward.d0

    @cached_property
    def curvature(self) -> Jet:
        """kappa = o kp/(1 - o r kp) of a pitch curve's kp, o = flank."""
        with np.errstate(divide="ignore", invalid="ignore"):  # at a cusp the curvature is infinite
            return self.flank * self.pitch_curvature / (1 - self.flank * self.follower.radius * self.pitch_curvature)

    @cached_property
    def pressure_angle(self) -> Jet:
        """Pressure angle [rad]."""
        return self.follower.pressure_angle(self.angle, self.lift)

    @cached_property
    def leverage(self) -> Jet:
        """cos(pressure angle), with the sign of side, flank and way."""
        return self.way * self.follower.side * self.flank * cos(self.pressure_angle)

    @cached_property
    def reference(self) -> Jet:
        """The centre of the face [m]."""
        return self.pitch

    @cached_property
    def spin(self) -> Jet:
        """Turning of the follower's body over the cam, per unit of cam speed."""
        return self.follower.spin(self.angle, self.lift)


def flat_radius(direction: Jet, support: Jet) -> Jet:
    """Radius of curvature p + p'' [m] under a line with its normal in `direction` phi at distance p = `support` (' = d/dphi), jets."""
    turn = derivative(direction)
    return support + derivative(derivative(support) / turn) / turn


class FlatContact(CamContact):
    """The contact of a flat face: of a line with its normal in a direction at a distance, its support."""

    follower: "TranslatingFlat | OscillatingFlat"

    @cached_property
    def face(self) -> tuple[Jet, Jet]:
        """(direction [rad], support [m]) of the face in the cam frame."""
        return self.follower.face(self.angle, self.lift)

    @cached_property
    def pitch(self) -> Jet:
        """The point of contact [m]."""
        return envelope_of_line(*self.face)

    @cached_property
    def point(self) -> Jet:
        """Where they touch [m]."""
        return self.pitch

    @cached_property
    def _normal(self):
        return exp(1j * self.face[0])

    @cached_property
    def normal(self) -> Complexes:
        """Unit vector from `point` into the follower."""
        return self._normal.d0

    @cached_property
    def curvature(self) -> Jet:
        """Curvature of the cam's surface 1/(p + p'') [1/m], positive convex."""
        with np.errstate(divide="ignore", invalid="ignore"):
            return 1 / flat_radius(*self.face)

    @cached_property
    def pitch_curvature(self) -> Jet:
        """That of the cam's surface [1/m]."""
        return self.curvature

    @cached_property
    def pressure_angle(self) -> Jet:
        """Pressure angle [rad]."""
        return self.follower.pressure_angle(self.angle, self.lift)

    @cached_property
    def leverage(self) -> Jet:
        """Travel along the normal per travel of the follower, with the sign of the way."""
        return self.way * self.follower.leverage(self.angle, self.lift)

    @cached_property
    def tangent(self) -> Jet:
        """Unit tangent of the face, in the sense in which it turns."""
        return np.sign(self.spin.d0) * 1j * self._normal

    @cached_property
    def reference(self) -> Jet:
        """A point of the follower's body [m]."""
        return self.follower.reference(self.angle, self.lift)

    @cached_property
    def spin(self) -> Jet:
        """Turning of the face over the cam, per unit of cam speed."""
        return derivative(self.face[0])


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
        self.refuse(angle, lift)
        pitch = translating.pitch_curve(angle, lift, self.prime_radius, self.offset, self.side)
        return pitch if self.sense > 0 else -pitch.conj()

    def refuse(self, angle: Jet, lift: Jet) -> None:
        """DoesNotAssemble where the roller's centre passes the cam's centre."""
        low = translating.rest_height(self.prime_radius, self.offset) + np.min(np.atleast_1d(self.side * lift.d0), axis=-1, keepdims=True)
        if refused := first_refused(low > 0, low):
            raise DoesNotAssemble(
                f"translating follower: the lift takes the roller's centre to {1e3 * refused[0]:.6g} mm above the cam's centre; "
                f"enlarge prime_radius by more than {-1e3 * refused[0]:.6g} mm or reduce the lift."
            )

    def pressure_angle(self, angle: Jet, lift: Jet) -> Jet:
        """Pressure angle [rad], from the jets of the cam angle and of the lift [m]."""
        return translating.pressure_angle(angle, lift, self.prime_radius, self.offset, self.side)

    def spin(self, angle: Jet, lift: Jet) -> Jet:
        """Turning of the follower's body over the cam, per unit of cam speed."""
        return -self.sense * derivative(angle)

    def contact(self, angle: Jet, lift: Jet, flank: int = 1) -> CamContact:
        """`CamContact` from the jets of the cam angle and of the lift [m]; flank -1 is the outer wall of a groove."""
        self.refuse(angle, lift)
        return RoundContact(self, angle, lift, flank)


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
        self.refuse(angle, lift)
        psi = self.rest_angle + self.side * lift
        return oscillating.pitch_curve(-self.sense * angle, psi, self.pivot_distance, self.arm_length, self.side)

    def refuse(self, angle: Jet, lift: Jet) -> None:
        """DoesNotAssemble where the arm passes a dead point."""
        _refuse_swing(self.rest_angle + self.side * lift.d0, 0.0, np.pi)

    def pressure_angle(self, angle: Jet, lift: Jet) -> Jet:
        """Pressure angle [rad], from the jets of the cam angle and of the swing [rad]."""
        psi = self.rest_angle + self.side * lift
        return oscillating.pressure_angle(-self.sense * angle, psi, self.pivot_distance, self.arm_length, self.side)

    def spin(self, angle: Jet, lift: Jet) -> Jet:
        """Turning of the follower's body over the cam, per unit of cam speed."""
        return -(derivative(lift) + self.sense * derivative(angle))

    def contact(self, angle: Jet, lift: Jet, flank: int = 1) -> CamContact:
        """`CamContact` from the jets of the cam angle and of the swing [rad]; flank -1 is the outer wall of a groove."""
        self.refuse(angle, lift)
        return RoundContact(self, angle, lift, flank)


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
        self.refuse(angle, lift)
        return np.pi / 2 + self.sense * (self.tilt - angle), self.base_radius + np.cos(self.tilt) * lift

    def refuse(self, angle: Jet, lift: Jet) -> None:
        """DoesNotAssemble where the face passes the cam's centre."""
        _refuse_crossing(self.base_radius + np.cos(self.tilt) * lift.d0)

    def pressure_angle(self, angle: Jet, lift: Jet) -> Jet:
        """The tilt of the face [rad], a jet of the shape of the lift's."""
        return constant(self.tilt + 0.0 * lift.d0)

    def leverage(self, angle: Jet, lift: Jet) -> Jet:
        """Travel along the normal per travel of the follower."""
        return cos(self.pressure_angle(angle, lift))

    def reference(self, angle: Jet, lift: Jet) -> Jet:
        """The point of the follower where its line meets the height of the lift [m], in the cam frame."""
        return (self.sense * self.offset + 1j * lift) * exp(-1j * self.sense * angle)

    def contact(self, angle: Jet, lift: Jet) -> CamContact:
        """`CamContact` from the jets of the cam angle and of the lift [m]."""
        self.refuse(angle, lift)
        return FlatContact(self, angle, lift)


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
        within = np.less(np.abs(height), self.pivot_distance)
        if refused := first_refused(within, self.base_radius, self.face_offset, self.pivot_distance):
            raise DoesNotAssemble(
                f"oscillating flat follower: base radius {1e3 * refused[0]:.6g} mm less face_offset {1e3 * refused[1]:.6g} mm "
                f"must be smaller than pivot_distance {1e3 * refused[2]:.6g} mm. Move the pivot away or change the base radius."
            )
        return np.arcsin(height / self.pivot_distance)

    def face(self, angle: Jet, lift: Jet) -> tuple[Jet, Jet]:
        """(direction, support): phi = pi/2 - psi - sense angle and p = C sin psi + d of the face in the cam frame, jets."""
        self.refuse(angle, lift)
        psi = self.rest_angle + lift
        return np.pi / 2 - psi - self.sense * angle, self.pivot_distance * sin(psi) + self.face_offset

    def refuse(self, angle: Jet, lift: Jet) -> None:
        """DoesNotAssemble where the lever passes a dead point, turns as fast as the cam, or takes the face past the cam's centre."""
        psi = self.rest_angle + lift.d0
        _refuse_swing(psi, -np.pi / 2, np.pi / 2)
        if np.any(1 + self.sense * lift.d1 / angle.d1 <= 0):
            raise DoesNotAssemble(
                f"oscillating flat follower: the lever turns as fast as the cam (d swing/d angle reaches {-self.sense}), which no profile "
                "can produce. Spread the motion over a larger cam angle or reduce the rise."
            )
        _refuse_crossing(self.pivot_distance * np.sin(psi) + self.face_offset)

    def lever(self, angle: Jet, lift: Jet) -> Jet:
        """Distance of the contact from the foot of the pivot along the face [m]."""
        return self.pivot_distance * cos(self.rest_angle + lift) / (1 + self.sense * derivative(lift) / derivative(angle))

    def pressure_angle(self, angle: Jet, lift: Jet) -> Jet:
        """Pressure angle [rad], from the jets of the cam angle and of the swing [rad]."""
        return self.sense * atan(self.face_offset / self.lever(angle, lift))

    def leverage(self, angle: Jet, lift: Jet) -> Jet:
        """Travel along the normal per travel at the arm length."""
        return self.lever(angle, lift) / self.arm_length

    def reference(self, angle: Jet, lift: Jet) -> Jet:
        """The pivot in the cam frame [m]."""
        return self.pivot_distance * exp(-1j * self.sense * angle)

    def contact(self, angle: Jet, lift: Jet) -> CamContact:
        """`CamContact` from the jets of the cam angle and of the swing [rad]."""
        self.refuse(angle, lift)
        return FlatContact(self, angle, lift)


def _refuse_crossing(support):
    """A flat face must stay on its side of the cam's centre."""
    low = np.min(np.atleast_1d(support), axis=-1, keepdims=True)
    if refused := first_refused(low > 0, low):
        raise DoesNotAssemble(
            f"flat follower: the lift takes the face {-1e3 * refused[0]:.6g} mm beyond the cam's centre and nothing is left "
            "of the cam; enlarge the base radius (prime_radius) by more than that or reduce the fall."
        )


def _refuse_swing(psi, low, high):
    """The lever must stay on one side of its dead points."""
    least, greatest = (extreme(np.atleast_1d(psi), axis=-1, keepdims=True) for extreme in (np.min, np.max))
    if refused := first_refused((least > low) & (greatest < high), least, greatest):
        raise DoesNotAssemble(
            f"oscillating follower: the lever swings from {np.degrees(refused[0]):.6g} to {np.degrees(refused[1]):.6g}° against the "
            f"line of centres, but it drives only between {np.degrees(low):.6g} and {np.degrees(high):.6g}°. Reduce the rise, or change "
            "prime_radius or arm_length."
        )
