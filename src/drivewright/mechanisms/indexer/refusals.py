"""What has no meaning, refused by name; what can be computed is left to the checks."""

import math

from drivewright import motion
from drivewright.errors import SpecError, UnknownName

TRANSLATING = ("pin-wheel", "cycloid")
NEEDED = {
    "pin-wheel": ("eccentricity",),
    "cycloid": ("eccentricity",),
    "parallel": ("centre_distance",),
    "barrel": ("pin_length", "cam_length", "cam_radius"),
    "globoidal": ("centre_distance", "pin_length", "cam_length"),
}
YIELDING = ("crank_bearings", "support_bearings", "shafts", "gear", "housing")
LEAST_PINS = 3


def refuse_nonsense(spec):
    """SpecError for the first thing that has no meaning whatever else is said."""
    if spec.load.torque is not None and spec.load.torque == 0:
        raise SpecError("0 N m: without a load there is no stiffness; give another torque, or leave it out", "load.torque")
    if spec.motion.law is not None and spec.motion.law not in motion.names():
        raise SpecError(str(UnknownName("motion law", spec.motion.law, motion.names())), "motion.law")


def refuse_contradictions(spec):
    """SpecError for the first key that is missing for the kind or contradicts another."""
    for check in (_kind, _motion, _pins, _drive, _bearings):
        check(spec)


def law_name(spec):
    """The motion law: as said, else uniform for a cycloid and the modified sine for all others."""
    return spec.motion.law or ("uniform" if spec.kind == "cycloid" else "modified-sine")


def _kind(spec):
    for key in NEEDED[spec.kind]:
        if getattr(spec, key) is None:
            raise SpecError(f"is missing: kind {spec.kind!r} needs it", key)


def _motion(spec):
    name, ratio = law_name(spec), spec.motion.motion_to_dwell
    if spec.kind == "cycloid" and name != "uniform":
        raise SpecError(f'kind "cycloid" turns evenly and has law = "uniform", not {name!r}; for a dwell take kind = "pin-wheel"',
                        "motion.law")
    if name == "uniform" and ratio not in (None, "no-dwell"):
        raise SpecError("the uniform law takes the full turn and has no dwell; leave motion_to_dwell out", "motion.motion_to_dwell")
    if isinstance(ratio, float) and not (ratio > 0 and math.isfinite(ratio)):
        raise SpecError(f'{ratio:g}: the ratio of motion to dwell is above 0; "no-dwell" for a full turn', "motion.motion_to_dwell")


def _pins(spec):
    if spec.pins < LEAST_PINS:
        raise SpecError(f"{spec.pins}: a wheel needs at least {LEAST_PINS} pins", "pins")
    if spec.kind in TRANSLATING and spec.pins % spec.cams:
        raise SpecError(f"{spec.cams} cams in even phase need a number of pins that they divide; {spec.pins} is not. "
                        f"Take 1 cam, or {spec.pins - spec.pins % spec.cams + spec.cams} pins", "cams")


def _drive(spec):
    given = [key for key in YIELDING if getattr(spec, key) is not None]
    if not given:
        return
    if spec.kind not in TRANSLATING:
        raise SpecError(f"kind {spec.kind!r} has no split shafts; [{given[0]}] is for pin-wheel and cycloid", given[0])
    on_shafts = [key for key in given if key != "housing"]
    if on_shafts and spec.shaft_spacing is None:
        raise SpecError(f"is missing: [{on_shafts[0]}] needs the distance of the two split shafts", "shaft_spacing")
    if spec.gear and spec.gear.module * spec.gear.teeth >= spec.shaft_spacing:
        raise SpecError(
            f"pitch circles of {1e3 * spec.gear.module * spec.gear.teeth:.4g} mm leave no input gear between shafts "
            f"{1e3 * spec.shaft_spacing:.4g} mm apart; module times teeth is half of that", "gear.teeth")


def _bearings(spec):
    for key in ("crank_bearings", "support_bearings"):
        given = getattr(spec, key)
        if given is None:
            continue
        if (given.bearing is None) == (given.stiffness is None):
            raise SpecError("give one of bearing (a designation) and stiffness", key)
        if given.stiffness is not None and given.dynamic_rating is not None:
            raise SpecError(
                "a life needs a bearing, whose rolling elements tell the exponent; a stiffness has none", f"{key}.dynamic_rating"
            )
        if given.stiffness is not None and given.law != "elements":
            raise SpecError(f"law = {given.law!r} needs a bearing; a constant stiffness is a law of its own", f"{key}.law")
