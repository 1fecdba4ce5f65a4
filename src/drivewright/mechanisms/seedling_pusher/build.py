"""Spec -> model: train, tip, rod programme and the two cams, each a function of the carrier angle t (clockwise, 0 at the start).

All functions take the carrier angle as an array [rad] and give jets in it.  World frame: sun axis at the origin, y up.
"""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache, partial

import numpy as np

from drivewright import curves, motion
from drivewright._typing import ArrayLike, Complexes, Floats, Ints
from drivewright.cams import oscillating
from drivewright.errors import InputError, SpecError
from drivewright.gears import EllipticGearPair, Gear, GearTrain, Rack, RackFamily, cut_gear
from drivewright.mechanisms.seedling_pusher.spec import SeedlingPusherSpec
from drivewright.numerics.jets import Jet, atan, exp, variable
from drivewright.numerics.roots import bracketed_roots
from drivewright.scene import Outline

TURN = 2 * np.pi
GRID = np.linspace(0, TURN, 721)
DRAWN = 1e-4


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
        """Angle between arm and line pivot - cam axis with the rod in [rad]."""
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


@dataclass(frozen=True)
class PusherModel:
    """The model: common types only, frozen."""

    spec: SeedlingPusherSpec
    train: GearTrain
    bend: float  # signed turn from the first to the second arm of the carrier
    tip_start: float  # direction of the line planet axis - tip at t = 0
    programme: motion.Programme  # rod travel over the angle since the push started
    push_start: float
    cams: tuple[ConjugateCam, ...]
    findings: tuple[str, ...] = field(default=())

    @property
    def orbit(self) -> int:
        """+1 where the lever pivot orbits the cams counter-clockwise, -1 clockwise."""
        return 1 if self.spec.cams.orbit == "counter-clockwise" else -1

    @property
    def rod_distance(self) -> float:
        """Signed distance of the rod's line beyond the needle's, seen from the planet axis [m].

        The planet turns the arm counter-clockwise on the carrier.  A pivot that orbits the cams so, a lever that the main cam turns
        clockwise, and a rod that runs out along the needle put the rod on the needle's side of the planet axis; the other sense mirrors it.
        """
        arm, lever = self.spec.arm, self.spec.lever
        return self.orbit * (lever.pivot_distance + lever.output_arm) - arm.tip_distance * np.sin(arm.needle_angle)

    # -- train and tip ---------------------------------------------------------------------------------------------------

    def planet(self, t: ArrayLike) -> Jet:
        """Planet relative to the carrier phi3(t) [rad], 0 at the start, counter-clockwise."""
        return self.train.planet(t)

    def arm_rotation(self, t: ArrayLike) -> Jet:
        """Rotation of the planting arm in the world [rad]: -t + phi3."""
        return self.planet(t) - variable(t)

    def planet_axis(self, t: ArrayLike) -> Jet:
        """Axis of the planet in the world, complex jet [m]."""
        arm = 2 * self.spec.train.semi_major
        first = exp(1j * (self.spec.train.carrier_angle - variable(t)))
        return arm * (1 + np.exp(1j * self.bend)) * first

    def tip(self, t: ArrayLike) -> Jet:
        """Needle tip in the world (machine frame), complex jet [m]."""
        return self.planet_axis(t) + self.spec.arm.tip_distance * exp(1j * (self.tip_start + self.arm_rotation(t)))

    def needle_angle(self, t: ArrayLike) -> Floats:
        """Needle below the horizontal [rad], pointing away from the planet axis."""
        direction = self.tip_start + self.arm_rotation(t).d0
        return -np.angle(np.exp(1j * direction)) + self.spec.arm.needle_angle

    @property
    def eccentricity(self) -> float:
        """Of the pitch ellipses, which are alike [-]."""
        (first, *_) = self.train.pairs
        assert isinstance(first, EllipticGearPair)
        return first.eccentricity

    @cached_property
    def gear(self) -> Gear:
        """One of the three congruent toothed gears: axis (focus) at the origin, the short focal radius along +x.

        An odd tooth count puts a space at the near vertex and a tooth at the far one, so that the gear meshes with itself.
        """
        return cut_gear(EllipticGearPair(self.eccentricity, self.spec.train.semi_major), 1, self.spec.train.teeth)

    @cached_property
    def gear_outline(self) -> Outline:
        """Toothed outline of the gear."""
        return self.gear.outline(self.spec.manufacture.chord_tolerance)

    @cached_property
    def drawn_gear(self) -> Outline:
        """Toothed outline of the gear, as fine as a picture needs."""
        return _drawn_gear(self.eccentricity, self.spec.train.semi_major, self.spec.train.teeth, self.drawn_tolerance)

    @cached_property
    def drawn_profiles(self) -> dict[str, Outline]:
        """Outline of the real profile of each cam by name, as fine as a picture needs."""
        return {cam.name: curves.drawn_outline(self.family(cam), self.drawn_tolerance, fewest=65) for cam in self.cams}

    @property
    def drawn_tolerance(self) -> float:
        """How far a drawn curve may leave the exact one [m]: some millionths of the picture's size."""
        return DRAWN * self.spec.train.semi_major

    @cached_property
    def lowest(self) -> float:
        """Carrier angle in [0, 2 pi) where the tip is lowest."""
        return _extreme(lambda t: self.tip(t).imag, -1)

    @cached_property
    def highest(self) -> float:
        """Carrier angle in [0, 2 pi) where the tip is highest."""
        return _extreme(lambda t: self.tip(t).imag, +1)

    # -- rod, lever and cams -----------------------------------------------------------------------------------------------

    def pieces(self) -> list[tuple[float, float, str, int]]:
        """(carrier angle from, to, phase, index) of the smooth intervals; one turn from the start of the push on."""
        return [(self.push_start + p.theta0, self.push_start + p.theta1, p.phase, k) for k, p in enumerate(self.programme.pieces)]

    def rod(self, t: ArrayLike, piece: int | Ints | None = None) -> Jet:
        """Travel of the rod g(t), a jet [m]; by the formula of one piece where given."""
        angle = np.asarray(t) - self.push_start
        return Jet(*(self.programme(angle) if piece is None else self.programme.on_piece(piece, angle)))

    def swing(self, t: ArrayLike, piece: int | Ints | None = None) -> Jet:
        """Swing of the lever, atan(g / l), a jet [rad]."""
        return atan(self.rod(t, piece) / self.spec.lever.output_arm)

    def pivot_angle(self, t: ArrayLike) -> Jet:
        """Direction of the lever pivot seen from the cams: q - pi/2 with q = orbit * phi3, a jet [rad]."""
        return self.orbit * self.planet(t) - np.pi / 2

    def pitch(self, cam: ConjugateCam, t: ArrayLike, piece: int | Ints | None = None) -> Jet:
        """Pitch curve of a cam, complex jet [m]."""
        return cam.pitch(self.pivot_angle(t), self.swing(t, piece))

    def pressure_angle(self, cam: ConjugateCam, t: ArrayLike, piece: int | Ints | None = None) -> Jet:
        """Pressure angle of a cam, jet [rad]."""
        return cam.pressure_angle(self.pivot_angle(t), self.swing(t, piece))

    def curvature(self, cam: ConjugateCam, t: ArrayLike, piece: int | Ints | None = None) -> Floats:
        """Curvature of the pitch curve [1/m], positive where convex seen from outside."""
        return self.orbit * curves.curvature(self.pitch(cam, t, piece))

    @cached_property
    def trimmed(self) -> dict[str, curves.Trimmed]:
        """Real profile of each cam by name."""
        return {cam.name: curves.trim(self.family(cam)) for cam in self.cams}

    @cached_property
    def profiles(self) -> dict[str, Outline]:
        """Outline of the real profile of each cam by name, in the frame of its formulas."""
        return {name: trimmed.outline(self.spec.manufacture.chord_tolerance) for name, trimmed in self.trimmed.items()}

    def overtravel(self, cam: ConjugateCam) -> tuple[Callable[[Floats, Floats], Complexes], float]:
        """How a roller sinks along its path into its cam, for `curves.lost_motion`."""

        def place(t, depth):
            return cam.pitch(self.pivot_angle(t), self.swing(t) - cam.side * depth / cam.arm).d0

        return place, 1.0

    def family(self, cam: ConjugateCam) -> curves.CircleFamily:
        """The roller's motion around its cam, for enveloping."""
        at = partial(self._pitch_on, cam)
        pieces = [
            curves.Piece(low, high, curves.Member(at, (k,)), phase, "arc" if phase == "dwell" else "smooth")
            for low, high, phase, k in self.pieces()
        ]
        return curves.CircleFamily(tuple(pieces), cam.roller_radius)

    def _pitch_on(self, cam, piece, t):
        """`pitch` by the formula of a piece, or of a piece of its own at each t."""
        return self.pitch(cam, t, np.asarray(piece).astype(int))


@lru_cache(maxsize=64)
def _drawn_gear(eccentricity, semi_major, teeth, tolerance):
    """The gear of `PusherModel.gear` for the picture; it stays while other numbers of the design change."""
    family = RackFamily(EllipticGearPair(eccentricity, semi_major), 1, teeth, Rack())
    return curves.drawn_outline(family, tolerance, fewest=4)


def build(spec: SeedlingPusherSpec) -> PusherModel:
    """The model of a spec.  SpecError names the key where the numbers have no solution."""
    _refuse_even_teeth(spec)
    bend = _signed_bend(spec)
    train = _train(spec, bend)
    model = PusherModel(spec, train, bend, _tip_start(spec, bend), _programme(spec), 0.0, _cams(spec))
    end = model.lowest if spec.push.end_event == "lowest" else spec.push.end
    return replace(model, push_start=end - spec.push.rise)


def _train(spec, bend):
    try:
        pair = EllipticGearPair(np.sqrt(1 - spec.train.axis_ratio**2), spec.train.semi_major, spec.train.start)
    except InputError as error:  # so flat that the eccentricity rounds to 1
        raise SpecError(str(error), "train.axis_ratio") from None
    return GearTrain((pair, pair), (bend,))


def _refuse_even_teeth(spec):
    if spec.train.teeth % 2 == 0:
        raise SpecError(
            f"is {spec.train.teeth}; three congruent gears in a row mesh only with an odd number of teeth, take {spec.train.teeth + 1}",
            "train.teeth",
        )


def _signed_bend(spec):
    """Angle turned from the first arm to the second, counter-clockwise: the bend, or the supplement of an interior one."""
    return spec.train.bend if spec.train.bend_reading == "turned" else np.pi - spec.train.bend


def _tip_start(spec, bend):
    """Direction of planet axis - tip at the start: clockwise from the first arm, or from the ray planet axis - sun axis."""
    if spec.arm.tip_reference == "carrier":
        return spec.train.carrier_angle - spec.arm.tip_angle
    to_sun = spec.train.carrier_angle + bend / 2 + np.pi  # the two equal arms make the chord's direction their mean
    return to_sun + spec.arm.tip_angle


def _programme(spec):
    push = spec.push
    rest = TURN - push.rise - push.hold - push.retraction
    if rest <= 0:
        raise SpecError(
            f"rise, hold and retraction sum to {np.degrees(TURN - rest):.6g} deg; they must leave a rest within one turn of 360 deg", "push"
        )
    try:
        segments = (
            motion.Segment(push.rise, push.law, push.stroke),
            motion.Segment(push.hold, "dwell") if push.hold else None,
            motion.Segment(push.retraction, push.law, -push.stroke),
            motion.Segment(rest, "dwell"),
        )
        return motion.Programme(tuple(segment for segment in segments if segment))
    except InputError as error:
        raise SpecError(str(error), "push.law") from None


def _cams(spec):
    lever, cams = spec.lever, spec.cams
    shared = {"pivot_distance": lever.pivot_distance, "roller_radius": cams.roller_radius}
    pair = (
        ConjugateCam("main", lever.arm_main, cams.prime_radius_main, +1, **shared),
        ConjugateCam("return", lever.arm_return, cams.prime_radius_return, -1, **shared),
    )
    for cam in pair:
        _refuse_out_of_reach(cam, np.arctan(spec.push.stroke / lever.output_arm))
    return pair


def _refuse_out_of_reach(cam, swing):
    try:
        rest = cam.rest_angle
    except InputError as error:
        raise SpecError(str(error), f"cams.prime_radius_{cam.name}") from None
    end = rest + cam.side * swing
    if not 1e-6 < min(rest, end) <= max(rest, end) < np.pi - 1e-6:  # rad: exactly there, rounding decides
        raise SpecError(
            f"the lever swings {np.degrees(swing):.4g} deg, which takes the {cam.name} arm from {np.degrees(rest):.4g} to "
            f"{np.degrees(end):.4g} deg against the line of centres, onto or past its dead point; lengthen lever.output_arm or shorten "
            "push.stroke",
            f"cams.prime_radius_{cam.name}",
        )
    nearest = float(np.sqrt(cam.pivot_distance**2 + cam.arm**2 - 2 * cam.pivot_distance * cam.arm * np.cos(min(rest, end))))
    if cam.roller_radius >= nearest:
        raise SpecError(
            f"{1e3 * cam.roller_radius:.6g} mm leaves nothing of the {cam.name} cam: the roller's centre comes as near as "
            f"{1e3 * nearest:.6g} mm to the axis. Take smaller rollers or a larger cams.prime_radius_{cam.name}",
            "cams.roller_radius",
        )


def _extreme(height, sign):
    """Carrier angle of the greatest sign * height, from the roots of its exact derivative."""
    turning = bracketed_roots(lambda t: height(t).d1, GRID)
    if not len(turning):
        raise InputError("the height of the needle tip is constant over the turn; arm.tip_distance and the train give no track")
    candidates = np.unique(np.mod(turning, TURN))
    return float(candidates[np.argmax(sign * height(candidates).d0)])
