"""Spec -> model: the programme over one turn and the surfaces that touch: cam and follower, conjugate cam, outer wall, second face."""

import math
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache, partial
from typing import Any

import numpy as np

from drivewright import cams, materials, motion
from drivewright._typing import Bools, Floats
from drivewright.cams import CamTrack, FollowerShapes
from drivewright.errors import DoesNotAssemble, InputError, SpecError
from drivewright.mechanisms.cam.spec import TURN, CamSpec, Groove
from drivewright.numerics.jets import Jet
from drivewright.spec.length_or_angle import AngleGiven

LAW_KEYS = ("file", "rows", "band", "b", "c", "d", "start", "end", "interior", "points", "degree", "ends")
USED = {  # keys of the follower that each motion and face reads
    "translating": ("offset",),
    "oscillating": ("pivot_distance", "arm_length", "lift_at", "inertia"),
    "roller": ("roller_radius",),
    "knife": (),
    "shoe": ("face_radius", "face_offset"),
    "flat": ("face_offset", "face_angle", "half_face"),
}


@dataclass(frozen=True, eq=False)
class CamModel:
    """The model: the motion over one turn and the tracks, the first of which is the cam's own."""

    spec: CamSpec
    programme: motion.Programme
    tracks: tuple[CamTrack, ...]
    material: materials.Material

    @cached_property
    def findings(self) -> tuple[str, ...]:
        """Keys that are not used, and what is found in tables: computed where it is read, for it takes longer than a drawing may."""
        return tuple(_findings(self.spec, self.programme))

    @cached_property
    def cycle(self) -> cams.Cycle:
        """The turn in smooth pieces."""
        return cams.Cycle(self.programme.function)

    @cached_property
    def shapes(self) -> FollowerShapes:
        """The follower for pictures and solids."""
        followers = tuple(track.follower for track in self.tracks if track.cut and track.flank > 0)
        breadth = self.yoke_breadth if self.spec.closure == "yoke" else 0.0
        return FollowerShapes(followers, self.spec.follower.face, self.cycle, breadth, self.arm)

    @cached_property
    def phases(self) -> dict[str, cams.Cycle]:
        """The pieces of the turn in each phase that there is: "rise", "return", "dwell"."""
        names = [piece.phase for piece in self.programme.pieces]
        return {name: replace(self.cycle, chosen=tuple(k for k, own in enumerate(names) if own == name)) for name in dict.fromkeys(names)}

    @property
    def follower(self) -> Any:
        """The follower on its first track."""
        return self.tracks[0].follower

    @property
    def oscillating(self) -> bool:
        """Whether the follower swings."""
        return self.spec.follower.motion == "oscillating"

    @property
    def turns(self) -> bool:
        """Whether the spec states a speed."""
        return self.spec.drive is not None

    @property
    def speed(self) -> float:
        """Speed of the cam [rad/s]; only where the spec states one."""
        assert self.spec.drive is not None
        return self.spec.drive.speed

    @property
    def arm(self) -> cams.GuidedArm | None:
        """The second arm of an oscillating follower."""
        return valve_arm(self.spec)

    @cached_property
    def path(self) -> cams.LoadPath:
        """Where the load acts."""
        return cams.LoadPath(self.follower.reach, self.arm, self.spec.follower.inertia if self.oscillating else 0.0)

    @cached_property
    def valve_motion(self) -> motion.Piecewise:
        """Lift of the valve over the cam angle: as it is stated, or by the rocker's swing."""
        assert self.arm is not None
        programme = self.programme
        if isinstance(programme, motion.MappedProgramme) and programme.outer == self.arm:
            return programme.stated
        return motion.MappedPiecewise.through(programme.function, cams.GuidedLift(self.arm))

    @property
    def yoke_breadth(self) -> float:
        """Distance of the two faces, or roller centres, of a yoke [m]."""
        radius = self.follower.base_radius if self.tracks[0].flat else self.follower.prime_radius
        return 2 * radius + cams.breadth(self.cycle).mean

    @property
    def clearance(self) -> float:
        """Width of a groove less the diameter of its roller [m]."""
        return (self.spec.groove or Groove()).clearance

    @cached_property
    def surging_spring(self) -> cams.SurgingSpring | None:
        """The spring with the mass of its coils, where the spec states one."""
        spring = self.spec.spring
        return (
            cams.SurgingSpring(spring.stiffness, spring.mass, spring.damping_ratio) if spring and spring.mass and spring.stiffness else None
        )

    @cached_property
    def surge(self) -> cams.PeriodicSurge | None:
        """The surge of the spring at the cam's speed."""
        spring = self.surging_spring
        return cams.PeriodicSurge(spring, cams.lift_harmonics(self.load_travel), self.speed) if spring and self.turns else None

    def load_travel(self, angle: Floats) -> Floats:
        """Travel [m] of what carries load and spring, at cam angles [rad]."""
        return self.path.travel(self.cycle.at_angle(angle)[1]).d0

    @property
    def load(self) -> cams.FollowerLoad:
        """What acts along the follower's travel, or at its valve."""
        load, spring = self.spec.load, self.spec.spring
        stiffness, preload = (spring.stiffness, spring.preload) if spring else (0.0, 0.0)
        return cams.FollowerLoad(load.mass, load.damping, stiffness, preload, load.force)

    def required(self, angle: Jet, lift: Jet) -> Jet:
        """Force that the cam must exert along the travel [N]; a jet."""
        force = self.path.force(lift, self.load, self.speed)
        return force + self.path.ratio(lift) * self.surge.force(angle) if self.surge else force

    def normal_force(self, track: CamTrack, angle: Jet, lift: Jet) -> Jet:
        """Normal force between the surfaces of a track [N], negative where it falls to another one; a jet."""
        return cams.cam_normal_force(self.required(angle, lift), track.contact(angle, lift))

    def torque(self, angle: Jet, lift: Jet) -> Jet:
        """Torque of the contact force on the cam shaft [N m], a jet; where a follower closed by force has left the cam there is none."""
        required = self.required(angle, lift)
        transmitted = required * (required.d0 > 0) if self.spec.closure == "force" else required
        return cams.drive_torque(self.follower.reach * lift, transmitted)


def build(spec: CamSpec) -> CamModel:
    """The `CamModel` of a spec."""
    model = assembled(spec, programme_of(spec))
    for number in np.flatnonzero(~clear_of_axis(model)):  # of a cam that is cut away altogether nothing is left to analyse
        profile(model, int(number))
    return model


def programme_of(spec: CamSpec) -> motion.Programme:
    """The motion over one turn."""
    laws = [_law(segment, f"programme.{number}") for number, segment in enumerate(spec.programme)]
    lengths = _counts_lengths(spec, laws)
    segments = tuple(_segment(spec, number, law, lengths) for number, law in enumerate(laws))
    if spec.follower.motion == "oscillating" and lengths:
        return motion.MappedProgramme(segments, lift_unit="m", outer=_lift_place(spec))
    return motion.Programme(segments, lift_unit="m" if lengths else "rad")


def valve_arm(spec: CamSpec) -> cams.GuidedArm | None:
    """The arm that drives the valve of an oscillating follower."""
    return cams.GuidedArm(spec.valve.arm_length, spec.valve.start_angle) if spec.valve and spec.follower.motion == "oscillating" else None


def _counts_lengths(spec, laws):
    """Whether the programme states lengths: a translating follower's, and an oscillating one's where it is known where they count."""
    if spec.follower.motion == "translating" or spec.follower.lift_at is not None:
        return True
    rises = [segment.rise for segment in spec.programme if segment.rise]
    angles = [isinstance(rise, AngleGiven) for rise in rises] + [unit == "rad" for law in laws if (unit := getattr(law, "lift_unit", None))]
    return spec.valve is not None and not any(angles)


def _lift_place(spec):
    """The map from the lengths that the programme of an oscillating follower states to its swing."""
    given, arm = spec.follower.lift_at, valve_arm(spec)
    if given != "arm" and arm is None:
        raise SpecError(f'is missing: follower.lift_at = "{given}" needs the second arm', key="valve")
    if given == "arm" or arm is None:
        return cams.ArcArm(_needed(spec.follower, "arm_length"))
    return cams.ArcArm(arm.length) if given == "tip" else arm


def clear_of_axis(model: CamModel) -> Bools:
    """Whether the face of each track keeps clear of the cam's axis (tracks,), so that a cam is left; of n designs (tracks, n)."""
    clear = [np.ravel(track.clear_of_axis(model.cycle)) if track.cut else np.array([True]) for track in model.tracks]
    return np.squeeze(np.stack(np.broadcast_arrays(*clear)))


def assembled(spec: CamSpec, programme: motion.Programme) -> CamModel:
    """The `CamModel` of a spec and its programme, without the check that anything is left of the cam.

    The spec's numbers, those of the programme left aside, may be columns (n, 1) of n designs.
    """
    follower = _follower(spec)
    tracks = (CamTrack("cam", "", follower, follower.contact), *_closing_tracks(spec, follower, programme))
    model = CamModel(spec, programme, tracks, _material(spec))
    for track in tracks:  # lever past its dead point, lift through the cam's centre: refused here, not in the middle of an analysis
        track.contact(*model.cycle.sampled())
    return model


# -- programme -----------------------------------------------------------------------------------------------------------------


def _law(segment, key):
    """The law of one [[programme]] table; errors name the table."""
    parameters = {name: getattr(segment, name) for name in LAW_KEYS if getattr(segment, name) is not None}
    if segment.law == "dwell" and parameters:
        raise SpecError("a dwell has no parameters; leave this one out or choose another law", key=f"{key}.{next(iter(parameters))}")
    try:
        return "dwell" if segment.law == "dwell" else motion.law(segment.law, **parameters)
    except SpecError:
        raise
    except InputError as error:
        raise SpecError(str(error), key=f"{key}.law") from None


def _segment(spec, number, law, lengths):
    """The motion of one [[programme]] table."""
    segment, key = spec.programme[number], f"programme.{number}"
    _refuse_rise(spec, segment, law, lengths, key)
    try:
        return motion.Segment(_angle(spec, number), law, 0.0 if segment.rise is None else float(segment.rise))
    except InputError as error:
        raise SpecError(str(error), key=f"{key}.law") from None


def _angle(spec, number):
    """The angle of a segment; that which states none has the rest of the turn."""
    angles = [segment.angle for segment in spec.programme]
    if angles[number] is not None:
        return angles[number]
    if angles.count(None) > 1:
        raise SpecError(
            "is missing: one segment may leave its angle out, which is then the rest of the turn", key=f"programme.{number}.angle"
        )
    given = math.fsum(angle for angle in angles if angle is not None)
    if given >= TURN:
        raise SpecError(
            f"is left out, and the other segments leave nothing of the turn: they take {math.degrees(given):.9g}°; shorten one",
            key=f"programme.{number}.angle",
        )
    return TURN - given


def _refuse_rise(spec, segment, law, lengths, key):
    """The rise, or the lift of a table, must be a length where the programme counts lengths, else an angle."""
    if spec.follower.motion == "translating":
        wanted = "a length, because the follower is translating"
    elif lengths:
        wanted = "a length, because the lift is stated along an arc or at the valve (follower.lift_at or [valve])"
    else:
        place = "" if spec.valve else '; to state lengths, give follower.lift_at = "arm", or a [valve] with the second arm'
        wanted = f"an angle, because the follower oscillates{' and another segment has an angle' if spec.valve else ''}{place}"
    if segment.rise is not None and segment.rise != 0 and isinstance(segment.rise, AngleGiven) == lengths:
        raise SpecError(f"must be {wanted}", key=f"{key}.rise")
    if (getattr(law, "lift_unit", None) or "") == ("rad" if lengths else "m"):
        raise SpecError(f"the lift in its table must be {wanted}", key=f"{key}.{'file' if segment.rows is None else 'rows'}")


def _findings(spec, programme):
    """Keys that are not used, and findings on tables."""
    used = {"motion", "face", "prime_radius", "base_radius", *USED[spec.follower.motion], *USED[spec.follower.face]}
    used -= {"face_angle"} if spec.follower.motion == "oscillating" else set()
    kind = f"{spec.follower.motion} follower with a {spec.follower.face} face"
    for name in sorted(name for name in spec.follower.model_fields_set - used if np.any(getattr(spec.follower, name))):
        yield f"follower.{name} is not used: it does not apply to a {kind}"
    for segment in programme.segments:
        if isinstance(segment.law, motion.TableLaw):
            yield from segment.law.findings
    if spec.valve is not None and spec.follower.motion != "oscillating":
        yield "[valve] is not used: only an oscillating follower has a second arm"
    for name in ("groove", "conjugate"):
        if getattr(spec, name) is not None and spec.closure != name:
            yield f'[{name}] is not used: closure = "{spec.closure}"'


def _material(spec):
    try:
        return materials.material(spec.material)
    except InputError as error:
        raise SpecError(str(error), key="material") from None


# -- follower and tracks ---------------------------------------------------------------------------------------------------------


def _follower(spec):
    """The follower on the cam."""
    given, sense = spec.follower, 1 if spec.rotation == "counter-clockwise" else -1
    radius = {"roller": given.roller_radius, "shoe": given.face_radius}.get(given.face, 0.0)
    if radius is None:
        name = "roller_radius" if given.face == "roller" else "face_radius"
        raise SpecError(f"is missing: a {given.face} has a radius", key=f"follower.{name}")
    prime, aside = _prime_radius(given, radius), given.face_offset if given.face == "shoe" else 0.0
    if given.motion == "translating":
        if given.face == "flat":
            return cams.TranslatingFlat(prime, given.face_angle, given.offset, sense)
        return cams.TranslatingRound(prime, radius, given.offset + aside, sense)
    pivot, arm = (_needed(given, name) for name in ("pivot_distance", "arm_length"))
    if given.face == "flat":
        return cams.OscillatingFlat(prime, pivot, arm, given.face_offset, sense)
    return cams.OscillatingRound(prime, radius, pivot, np.hypot(arm, aside), sense)


def _prime_radius(given, radius):
    """Radius of the pitch curve at zero lift: as given, or that of the base circle and the face."""
    if (given.prime_radius is None) == (given.base_radius is None):
        reason = "is missing" if given.prime_radius is None else "and follower.base_radius are both given; leave one out"
        raise SpecError(reason, key="follower.prime_radius")
    prime = given.base_radius + radius if given.prime_radius is None else given.prime_radius
    _refuse_small(prime, radius, given.face, "follower.prime_radius")
    return prime


def _refuse_small(prime, radius, face, key):
    """A face must not reach over the cam's axis at zero lift."""
    if refused := cams.first_refused(np.greater(prime, radius), prime, radius):
        raise SpecError(f"{1e3 * refused[0]:.6g} mm leaves no cam under a {face} of radius {1e3 * refused[1]:.6g} mm; make it larger", key)


def _needed(given, name):
    value = getattr(given, name)
    if value is None:
        raise SpecError("is missing: an oscillating follower needs pivot_distance and arm_length", key=f"follower.{name}")
    return value


def _closing_tracks(spec, follower, programme):
    """The surfaces that take the force where the cam itself cannot pull."""
    if spec.closure == "force":
        return ()
    if spec.closure == "conjugate":
        second = _conjugate(spec, follower)
        return (CamTrack("conjugate", "conjugate.", second, second.contact),)
    if spec.closure == "groove":
        if spec.follower.face != "roller":
            raise SpecError(f'"groove" needs a roller, not a {spec.follower.face} face; change follower.face or closure', key="closure")
        return (CamTrack("outer wall", "outer.", follower, partial(follower.contact, flank=-1), flank=-1),)
    if spec.follower.motion != "translating" or spec.follower.face not in ("flat", "roller") or np.any(spec.follower.offset):
        raise SpecError('"yoke" needs a translating follower without offset, with flat faces or rollers', key="closure")
    opposite = partial(cams.opposite_contact, cams.Cycle(programme.function), follower)
    return (CamTrack("second face", "opposite.", follower, opposite, cut=False),)


def _conjugate(spec, follower):
    """The follower on its conjugate cam."""
    given = spec.conjugate
    if given is None:
        raise SpecError('is missing: closure = "conjugate" needs the table of the conjugate cam', key="conjugate")
    if spec.follower.face != "roller":
        raise SpecError(f'"conjugate" needs rollers, not a {spec.follower.face} face; change follower.face or closure', key="closure")
    radius, arm = (
        of_first if own is None else own
        for own, of_first in ((given.roller_radius, follower.radius), (given.arm_length, getattr(follower, "arm_length", None)))
    )
    changes = {"prime_radius": given.prime_radius, "radius": radius, "side": -1}
    guide = {"arm_length": arm} if spec.follower.motion == "oscillating" else {"offset": given.offset}
    second = replace(follower, **changes, **guide)
    _refuse_small(given.prime_radius, second.radius, "roller", "conjugate.prime_radius")
    return second


# -- profile -------------------------------------------------------------------------------------------------------------------


@lru_cache(maxsize=16)
def profile(model: CamModel, number: int = 0) -> cams.FinishedProfile:
    """The finished profile of a track by its number; DoesNotAssemble where nothing is left of it."""
    track = model.tracks[number]
    try:
        return cams.finished_profile(track.follower, model.programme, track.flank)
    except InputError as error:
        raise DoesNotAssemble(f"cam: nothing is left of the {track.words}. {error}") from None
