"""Keys that are missing for a kind or contradict another, refused by name; what can be computed is left to the checks."""

from collections.abc import Iterator

import numpy as np

from drivewright.errors import InputError, SpecError
from drivewright.indexing.motion import refuse_stations
from drivewright.indexing.pin_pressure import largest_approach
from drivewright.mechanisms.indexer.spec import IndexerSpec

TRANSLATING = ("pin-wheel", "cycloid")
NEEDED = {
    "pin-wheel": ("eccentricity",),
    "cycloid": ("eccentricity",),
    "parallel": ("centre_distance",),
    "barrel": ("pin_length", "cam_length", "cam_radius"),
    "globoidal": ("centre_distance", "pin_length", "cam_length"),
}
YIELDING = ("crank_bearings", "support_bearings", "shafts", "gear", "housing")
OWN = {  # keys that only some kinds have
    "eccentricity": TRANSLATING,
    "cams": TRANSLATING,
    "side": TRANSLATING,
    "shaft_spacing": TRANSLATING,
    "bodies": TRANSLATING,
    "cam_width": (*TRANSLATING, "parallel"),
    "centre_distance": ("parallel", "barrel", "globoidal"),
    "pin_length": ("barrel", "globoidal"),
    "cam_length": ("barrel", "globoidal"),
    "hand": ("barrel", "globoidal"),
    "cam_radius": ("barrel",),
}
LARGEST_RATIO = 1000.0
LEAST_PIN = 1e-5  # radius of a pin in that of its circle: play is followed in steps of a quarter of it
POINTS = {"table": "file", "spline": "points"}  # by law the key that holds its points


def required(spec: IndexerSpec, key: str) -> float:
    """The value of a key that the kind needs; SpecError where it is missing."""
    value = getattr(spec, key)
    if value is None:
        raise SpecError(f"is missing: kind {spec.kind!r} needs it", key)
    return value


def refuse_contradictions(spec: IndexerSpec) -> None:
    """SpecError for the first key that is missing for the kind or contradicts another."""
    for check in (_kind, _stations, _motion, _points, _pins, _drive, _bearings, _bodies):
        check(spec)


def unused(spec: IndexerSpec) -> Iterator[str]:
    """Findings about keys that this kind does not use, and limits that cannot be checked."""
    given = [key for key in OWN if key in spec.model_fields_set and spec.kind not in OWN[key]]
    if given:
        yield f"kind {spec.kind!r} does not use {', '.join(given)}"
    limits, load = spec.limits, spec.load
    if spec.kind in TRANSLATING and load.torque and spec.gear is None and any(getattr(spec, key) for key in YIELDING):
        yield "[gear] is not given: the split shafts are held at the gear positions, without deflection or backlash of gears"
    if spec.motor is not None and spec.table is None:
        yield "[motor] is not used: without [table] there is no torque at the input"
    if limits.life and not load.speed:
        yield "limits.life is not checked: load.speed is not given"
    if limits.stiffness and load.torque is None:
        yield "limits.stiffness is not checked: load.torque is not given"
    if limits.contact_pressure and load.torque is None:
        yield "limits.contact_pressure is not checked: load.torque is not given"
    if load.angle is not None:
        yield "load.angle gives a single input angle: play and holding contacts are not checked over the cycle"
    clearances = [key for key in ("crank_bearings", "support_bearings") if getattr(spec, key) and getattr(spec, key).radial_clearance]
    where = [*clearances, *(["gear"] if spec.gear and spec.gear.backlash else [])]
    if where:
        yield (
            f"the play includes pins and profile only; the clearance of {' and '.join(where)} is in the rotation under the torque, and "
            "so in the secant stiffness"
        )


def law_name(spec: IndexerSpec) -> str:
    """The motion law: as given, else uniform for a cycloid and the modified sine for all others."""
    return spec.motion.law or ("uniform" if spec.kind == "cycloid" else "modified-sine")


def _kind(spec: IndexerSpec) -> None:
    for key in NEEDED[spec.kind]:
        required(spec, key)


def stations(spec: IndexerSpec) -> int:
    """Steps in a turn of the wheel: as many as pins unless given."""
    return spec.pins if spec.stations is None else spec.stations


def _stations(spec: IndexerSpec) -> None:
    try:
        refuse_stations(spec.pins, stations(spec))
    except InputError as error:
        raise SpecError(str(error).removesuffix("."), "stations") from None
    phase = spec.pin_phase
    if phase is not None and not 0 <= phase < 1:
        same = f"; {phase % 1:.6g} is the same position" if np.isfinite(phase) else ""
        raise SpecError(f"{phase:g} is out of range; the position of a pin in the dwell is from 0 to below 1 pitch{same}", "pin_phase")


def _points(spec: IndexerSpec) -> None:
    name = law_name(spec)
    for law, key in POINTS.items():
        given = getattr(spec.motion, key) is not None
        if given and name != law:
            raise SpecError(f"is for law = {law!r}; the law is {name!r}", f"motion.{key}")
        if name == law and not given:
            raise SpecError(f"is missing: law = {law!r} needs it", f"motion.{key}")
    if spec.motion.degree is not None and name not in POINTS:
        raise SpecError(f"is for law = 'table' or 'spline'; the law is {name!r}", "motion.degree")
    if name == "table" and spec.motion.motion_to_dwell is not None:
        raise SpecError("the dwell begins at the last row of the table; leave motion_to_dwell out", "motion.motion_to_dwell")


def _motion(spec: IndexerSpec) -> None:
    name, ratio = law_name(spec), spec.motion.motion_to_dwell
    if spec.kind == "cycloid" and name != "uniform":
        raise SpecError(
            f'kind "cycloid" has uniform motion, law = "uniform", not {name!r}; for a dwell take kind = "pin-wheel"', "motion.law"
        )
    if name == "uniform" and ratio not in (None, "no-dwell"):
        raise SpecError("the uniform law takes the full turn and has no dwell; leave motion_to_dwell out", "motion.motion_to_dwell")
    if isinstance(ratio, float) and not 1 / LARGEST_RATIO <= ratio <= LARGEST_RATIO:
        raise SpecError(
            f"{ratio:g} is out of range; the ratio of motion to dwell is from {1 / LARGEST_RATIO:g} to {LARGEST_RATIO:g}; "
            'give "no-dwell" for a full turn',
            "motion.motion_to_dwell",
        )


def _pins(spec: IndexerSpec) -> None:
    least = LEAST_PIN * spec.pin_circle_radius
    if spec.pin_radius < least:
        raise SpecError(
            f"{1e3 * spec.pin_radius:.4g} mm is less than {LEAST_PIN:g} of the pin circle radius, too thin to be followed along the cam. "
            f"Take at least {1e3 * least:.4g} mm",
            "pin_radius",
        )
    if spec.kind in TRANSLATING and spec.pins % spec.cams:
        fitting = [str(number) for number in range(1, 5) if spec.pins % number == 0]
        raise SpecError(
            f"{spec.cams} cams do not divide the {spec.pins} pins evenly. Take {' or '.join(fitting)} cams, or "
            f"{spec.pins - spec.pins % spec.cams + spec.cams} pins",
            "cams",
        )


def _drive(spec: IndexerSpec) -> None:
    given = [key for key in YIELDING if getattr(spec, key) is not None]
    _housing(spec)
    if spec.kind not in TRANSLATING:
        given = [key for key in given if key != "housing"]
        if given:
            raise SpecError(f"kind {spec.kind!r} has no split shafts; [{given[0]}] is for pin-wheel and cycloid", given[0])
    if not given:
        return
    on_shafts = [key for key in given if key != "housing"]
    spacing = spec.shaft_spacing
    if on_shafts and spacing is None:
        raise SpecError(f"is missing: [{on_shafts[0]}] needs the distance of the two split shafts", "shaft_spacing")
    if spec.gear and spacing is not None and spec.gear.module * spec.gear.teeth >= spacing:
        raise SpecError(
            f"pitch circles of {1e3 * spec.gear.module * spec.gear.teeth:.4g} mm leave no room for the input gear between shafts "
            f"{1e3 * spacing:.4g} mm apart; module times teeth must be half of that",
            "gear.teeth",
        )


def _housing(spec: IndexerSpec) -> None:
    """SpecError for parts and contacts that only the other kinds have."""
    housing, translating = spec.housing, spec.kind in TRANSLATING
    if housing and not translating and housing.support_stiffness is not None:
        raise SpecError(
            f"kind {spec.kind!r} has no split shafts; give cam_stiffness for the bearings of its cam", "housing.support_stiffness"
        )
    for key in ("cam_stiffness", "input_torsion"):
        if housing and translating and getattr(housing, key) is not None:
            raise SpecError(
                f"is for parallel, barrel and globoidal; the cams of kind {spec.kind!r} deflect by [crank_bearings], [shafts], "
                "[support_bearings] and [gear]",
                f"housing.{key}",
            )
    if spec.contact.interference and translating:
        raise SpecError(
            f"is for parallel, barrel and globoidal; kind {spec.kind!r} has no interference of its cams", "contact.interference"
        )
    if spec.contact.interference and spec.contact.model == "bonded":
        raise SpecError('bonded contacts need no interference; leave it out, or take contact.model = "unilateral"', "contact.interference")
    given, largest = spec.contact.interference, largest_approach(spec.pin_radius)
    if given > largest:
        raise SpecError(
            f"{1e3 * given:.4g} mm is {100 * given / spec.pin_radius:.3g} % of the roller's radius; beyond "
            f"{1e3 * largest:.3g} mm the contact is wider than a tenth of the radius, where Hertz's theory ends. Some micrometres "
            'are usual: try "5 um"',
            "contact.interference",
        )


def _bearings(spec: IndexerSpec) -> None:
    for key in ("crank_bearings", "support_bearings"):
        given = getattr(spec, key)
        if given is None:
            continue
        if (given.bearing is None) == (given.stiffness is None):
            raise SpecError("give either bearing (a designation) or stiffness", key)
        if given.stiffness is not None and given.dynamic_rating is not None:
            raise SpecError(
                "a life needs a bearing, whose rolling elements set the life exponent; give bearing instead of stiffness",
                f"{key}.dynamic_rating",
            )
        if given.stiffness is not None and given.law != "elements":
            raise SpecError(f"law = {given.law!r} needs a bearing; leave it out for a constant stiffness", f"{key}.law")


def _bodies(spec: IndexerSpec) -> None:
    sizes = spec.crank_bearings is not None and spec.crank_bearings.bearing is not None
    if spec.kind in TRANSLATING and spec.bodies == "elastic" and not sizes:
        raise SpecError(
            '"elastic" needs the size of the bodies: give crank_bearings.bearing, which sets the holes of the cams and the crank pins, or '
            'take "rigid"',
            "bodies",
        )
