"""Spec -> model: the arm on the planet of the elliptic train, and the conjugate cams, both over the carrier angle t.

The carrier turns clockwise, t = 0 at the start.  World frame: sun axis at the origin, y up.
"""

from dataclasses import dataclass, field
from functools import cached_property, lru_cache

import numpy as np

from drivewright import curves, motion
from drivewright._typing import ArrayLike, Complexes, Floats
from drivewright.cams.conjugate import ConjugateCam, ConjugatePair
from drivewright.errors import InputError, SpecError
from drivewright.gears import EllipticGearPair, Gear, GearTrain, PlanetArm, Rack, RackFamily, cut_gear
from drivewright.mechanisms.seedling_pusher.spec import SeedlingPusherSpec
from drivewright.scene import Outline

TURN = 2 * np.pi
GRID = np.linspace(0, TURN, 721)
DRAWN = 1e-4


@dataclass(frozen=True)
class PusherModel:
    """The model: common types only, frozen.  The point of `arm` is the needle's tip, the mass of `pair` the pusher rod."""

    spec: SeedlingPusherSpec
    arm: PlanetArm
    pair: ConjugatePair
    findings: tuple[str, ...] = field(default=())

    @property
    def rod_distance(self) -> float:
        """Signed distance of the rod's line beyond the needle's, seen from the planet axis [m].

        The planet turns the arm counter-clockwise on the carrier.  A pivot that orbits the cams so, a lever that the main cam turns
        clockwise, and a rod that runs out along the needle put the rod on the needle's side of the planet axis; the other sense mirrors it.
        """
        arm, lever = self.spec.arm, self.spec.lever
        return self.pair.orbit * (lever.pivot_distance + lever.output_arm) - arm.tip_distance * np.sin(arm.needle_angle)

    @property
    def advance(self) -> float:
        """How far the machine drives per carrier turn, signed [m]."""
        return self.spec.field.spacing * (1 if self.spec.field.travel == "+x" else -1)

    @property
    def needle(self) -> complex:
        """Direction of needle and rod in the frame of the arm at t = 0, origin on the planet axis."""
        return complex(np.exp(1j * (self.arm.start - self.spec.arm.needle_angle)))

    @property
    def outwards(self) -> complex:
        """Direction from the planet axis to the lever pivot, in the same frame."""
        return self.pair.orbit * 1j * self.needle

    @property
    def rod_ends(self) -> tuple[complex, complex]:
        """(back, front) of the rod with the rod in [m], in the same frame: its front is one stroke behind the needle's tip."""
        spec = self.spec
        line = (spec.lever.pivot_distance + spec.lever.output_arm) * self.outwards
        tip = spec.arm.tip_distance * np.exp(1j * self.arm.start)
        front = line + ((tip * np.conj(self.needle)).real - spec.push.stroke) * self.needle
        return front - spec.lever.rod_length * self.needle, complex(front)

    def rod_end(self, t: ArrayLike) -> Complexes:
        """Front end of the rod over the carrier angle, machine frame, x + i y [m]."""
        inside = self.rod_ends[1] + self.pair.travel(t).d0 * self.needle
        return self.arm.axis(t).d0 + np.exp(1j * self.arm.rotation(t).d0) * inside

    def needle_angle(self, t: ArrayLike) -> Floats:
        """Needle below the horizontal [rad], pointing away from the planet axis."""
        return -np.angle(np.exp(1j * self.arm.direction(t).d0)) + self.spec.arm.needle_angle

    @property
    def eccentricity(self) -> float:
        """Of the pitch ellipses, which are alike [-]."""
        (first, *_) = self.arm.train.pairs
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
    def display_gear(self) -> Outline:
        """Toothed outline of the gear, as fine as a picture needs."""
        return _display_gear(self.eccentricity, self.spec.train.semi_major, self.spec.train.teeth, self.display_tolerance)

    @cached_property
    def profiles(self) -> dict[str, Outline]:
        """Outline of the real profile of each cam by name, in the frame of its formulas."""
        return {name: trimmed.outline(self.spec.manufacture.chord_tolerance) for name, trimmed in self.pair.trimmed.items()}

    @cached_property
    def display_profiles(self) -> dict[str, Outline]:
        """Outline of the real profile of each cam by name, as fine as a picture needs."""
        return {cam.name: curves.display_outline(self.pair.family(cam), self.display_tolerance, fewest=65) for cam in self.pair.cams}

    @property
    def display_tolerance(self) -> float:
        """How far a drawn curve may leave the exact one [m]: some millionths of the picture's size."""
        return DRAWN * self.spec.train.semi_major


@lru_cache(maxsize=64)
def _display_gear(eccentricity, semi_major, teeth, tolerance):
    """The gear of `PusherModel.gear` for the picture; it stays while other numbers of the design change."""
    family = RackFamily(EllipticGearPair(eccentricity, semi_major), 1, teeth, Rack())
    return curves.display_outline(family, tolerance, fewest=4)


def build(spec: SeedlingPusherSpec) -> PusherModel:
    """The model of a spec.  SpecError names the key where the numbers have no solution."""
    _refuse_even_teeth(spec)
    bend, size = _signed_bend(spec), spec.train
    arm = PlanetArm(_train(spec, bend), 2 * size.semi_major, size.carrier_angle, bend, spec.arm.tip_distance, _tip_start(spec, bend))
    programme, cams, orbit = _programme(spec), _cams(spec), 1 if spec.cams.orbit == "counter-clockwise" else -1
    end = arm.lowest if spec.push.end_event == "lowest" else spec.push.end
    return PusherModel(spec, arm, ConjugatePair(cams, programme, end - spec.push.rise, spec.lever.output_arm, orbit, arm.planet))


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
            f"rise, hold and retraction sum to {np.degrees(TURN - rest):.6g}°; they must leave a rest within one turn of 360°", "push"
        )
    try:
        segments = (
            motion.Segment(push.rise, push.law, push.stroke),
            motion.Segment(push.hold, "dwell") if push.hold else None,
            motion.Segment(push.retraction, push.law, -push.stroke),
            motion.Segment(rest, "dwell"),
        )
        return motion.Programme(tuple(segment for segment in segments if segment), lift_unit="m")
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
            f"the lever swings {np.degrees(swing):.4g}°, which takes the {cam.name} arm from {np.degrees(rest):.4g} to "
            f"{np.degrees(end):.4g}° from the line of centres, onto or past its dead point; lengthen lever.output_arm or shorten "
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
