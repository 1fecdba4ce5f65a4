"""The finished profile: what trimming leaves, whether it can be made, and the table to inspect it by."""

import numpy as np

from drivewright import cams, curves
from drivewright.errors import DoesNotAssemble, SolverError
from drivewright.mechanisms.cam.build import CamModel, profile
from drivewright.mechanisms.cam.spec import TURN
from drivewright.result import Answer, Answers, Check, Column, Table, Value


def finished(model: CamModel, done: Answers) -> Answer:
    """The profiles after global trimming: lost motion, size, walls, cutter; one inspection table each."""
    answers = [_one_profile(model, number) for number, track in enumerate(model.tracks) if track.cut]
    values = {name: value for answer in answers for name, value in answer.values.items()}
    tables, checks, findings = (tuple(x for answer in answers for x in getattr(answer, name)) for name in ("tables", "checks", "findings"))
    outcome = "partial" if any(answer.outcome == "partial" for answer in answers) else "complete"
    return Answer(values, tables, (*checks, *_cutter_checks(model)), findings, outcome=outcome)


def _one_profile(model, number):
    track, found = model.tracks[number], profile(model, number)
    prefix = track.prefix
    least, greatest = _radii(model, track, found)
    area, length = curves.outline_area(found.outline), curves.perimeter(found.outline)
    if found.trimmed:
        area, length = found.trimmed.area, found.trimmed.perimeter
    values = {
        f"{prefix}profile.min_radius": Value(least, "m", f"least distance of the profile from the cam's centre{track.of}"),
        f"{prefix}profile.max_radius": Value(greatest, "m", f"greatest distance of the profile from the cam's centre{track.of}"),
        f"{prefix}profile.area": Value(area, "m^2", f"area within the profile{track.of}"),
        f"{prefix}profile.perimeter": Value(length, "m", f"length of the profile{track.of}"),
    }
    lost = _lost_motion(model, track, found) if found.trimmed else Answer()
    checks = (*_wall_checks(model, track, least), *lost.checks)
    findings = (*lost.findings, *([found.finding] if found.finding else []))
    outcome = "partial" if found.finding or lost.outcome == "partial" else "complete"
    return Answer({**values, **lost.values}, (_inspection(model, track, found),), checks, findings, outcome=outcome)


def _radii(model, track, found):
    """Least and greatest distance of the profile from the cam's centre [m]."""
    if found.trimmed and found.trimmed.undercut:
        radii = np.hypot(*found.trimmed.outline(1e-9).points(1e-9).T)
        return float(radii.min()), float(radii.max())

    def square(angle, lift):
        return track.contact(angle, lift).point.abs2()

    return tuple(np.sqrt(extreme(square).value) for extreme in (model.cycle.least, model.cycle.greatest))


def _lost_motion(model, track, found):
    """How far the follower sinks where the profile that it needs has been cut away, and the gap it would leave in its planned place."""
    gap = curves.largest_profile_gap(found.trimmed)[1]
    meaning = f"gap between the follower in its planned place and the real profile{track.of}"
    values = {f"{track.prefix}profile_gap": Value(gap, "m", meaning)}
    try:
        at, lost = curves.largest_lost_motion(found.trimmed, *cams.sinking(track.follower, model.programme, track.flank))
    except (SolverError, DoesNotAssemble) as error:
        finding = f"the {track.name} is undercut so deep that no lost motion can be told: {error}"
        return Answer(values, findings=(finding,), outcome="partial")
    meaning = f"how far the follower sinks beyond its programme, along its travel (of the arm's end where it swings){track.of}"
    values[f"{track.prefix}lost_motion"] = Value(lost, "m", meaning)
    check = Check(f"lost_motion{track.suffix}", lost, model.spec.limits.lost_motion, "<=", "m", meaning, (track.name,), True)
    if not lost > 0:
        return Answer(values, (), (check,))
    values[f"{track.prefix}lost_motion.at"] = Value(at % TURN, "rad", f"cam angle at which it sinks farthest{track.of}")
    finding = (
        f"the {track.name} is undercut: near cam angle {np.degrees(at):.1f} deg the follower sinks {1e3 * lost:.3g} mm beyond its "
        "programme; a larger prime radius, a smaller face radius or a longer segment mends it"
    )
    return Answer(values, (), (check,), (finding,))


def _wall_checks(model, track, least):
    """Material between profile, hub and bore of a cam that is worked from the outside."""
    make, wall, parts = model.spec.manufacture, model.spec.limits.wall, (track.name,)
    bore, hub, name = (make.bore or 0.0) / 2, make.hub_diameter, track.suffix
    if track.flank < 0:
        return []
    checks = [Check(f"bore_wall{name}", least - bore, wall, ">=", "m", "wall between bore and profile", parts, True)] if bore else []
    if hub:
        checks += [
            Check(f"hub_wall{name}", hub / 2 - bore, wall, ">=", "m", "wall between bore and hub", parts, True),
            Check(f"hub_clearance{name}", least - hub / 2, 0.0, ">=", "m", "the hub stays within the profile", parts),
        ]
    return checks


def _cutter_checks(model):
    """Whether the milling cutter reaches every hollow."""
    cutter, checks = model.spec.manufacture.cutter_diameter, []
    if model.spec.closure == "groove":
        width = 2 * model.follower.radius + model.clearance
        return (Check("cutter", cutter, width, "<=", "m", "diameter of the cutter, which must go into the groove", ("cam",)),)
    for track in (track for track in model.tracks if track.cut and not track.flat):
        sharpest = model.cycle.least(lambda angle, lift, track=track: track.contact(angle, lift).pitch_curvature).value
        if sharpest < 0:
            message = "least hollow radius of the profile against the radius of the cutter"
            checks.append(Check(f"cutter{track.suffix}", track.radius - 1 / sharpest, cutter / 2, ">=", "m", message, (track.name,)))
    return tuple(checks)


def _inspection(model, track, found):
    """Nominal points of the profile at whole degrees of the cam angle; what was trimmed away is left out."""
    angle = np.radians(np.arange(360.0))
    for start, stop in found.trimmed.removed if found.trimmed else ():
        angle = angle[(angle <= start) | (angle >= stop)]
    breaks = model.cycle.motion.breaks
    contact = track.contact(*model.cycle.at(np.searchsorted(breaks, angle, side="right") - 1, angle))
    point, tolerance = contact.point.d0, model.spec.manufacture.profile_tolerance
    return Table(
        f"inspection{track.suffix}",
        f"Inspection{track.of}",
        (
            Column("angle", "rad", "cam angle", angle),
            Column("polar_angle", "rad", "direction of the point at cam angle 0", np.angle(point)),
            Column("radius", "m", "distance of the point from the cam's centre", np.abs(point)),
            Column("x", "m", "point, x at cam angle 0", point.real),
            Column("y", "m", "point, y at cam angle 0", point.imag),
            Column("normal", "rad", "direction of the outward normal at cam angle 0", np.angle(contact.normal)),
            Column("pitch_radius", "m", "distance of the follower's face centre from the cam's centre", np.abs(contact.pitch.d0)),
            Column("tolerance", "m", "allowed deviation along the normal, plus and minus", np.full(angle.shape, tolerance)),
        ),
    )
