"""The finished profile: what trimming leaves, whether it can be made, and the table to inspect it by."""

import numpy as np

from drivewright import cams, curves
from drivewright.errors import DoesNotAssemble, SolverError
from drivewright.mechanisms.cam.build import CamModel, profile
from drivewright.mechanisms.cam.spec import TURN
from drivewright.result import Answer, Answers, Check, Value, merge_answers


def finished_profiles(model: CamModel, done: Answers) -> Answer:
    """The profiles after global trimming: lost motion, size, walls, cutter; one inspection table each."""
    answers = [_one_profile(model, number) for number, track in enumerate(model.tracks) if track.cut]
    return merge_answers((*answers, Answer(checks=_cutter_checks(model))))


def _one_profile(model, number):
    track, left = model.tracks[number], profile(model, number)
    prefix, name, tolerance = track.prefix, f"inspection{track.suffix}", model.spec.manufacture.profile_tolerance
    least, greatest = cams.profile_radii(model.cycle, track.contact, left.trimmed)
    area, length = curves.outline_area(left.outline), curves.perimeter(left.outline)
    if left.trimmed:
        area, length = left.trimmed.area, left.trimmed.perimeter
    values = {
        f"{prefix}profile.min_radius": Value(least, "m", f"least distance of the profile from the cam's centre{track.of}"),
        f"{prefix}profile.max_radius": Value(greatest, "m", f"greatest distance of the profile from the cam's centre{track.of}"),
        f"{prefix}profile.area": Value(area, "m^2", f"area within the profile{track.of}"),
        f"{prefix}profile.perimeter": Value(length, "m", f"length of the profile{track.of}"),
    }
    table = cams.inspection_table(model.cycle, track.contact, left.trimmed, tolerance, name, f"Inspection{track.of}")
    shape = Answer(values, (table,), tuple(_wall_checks(model, track, least)))
    lost = _lost_motion(model, track, left) if left.trimmed else Answer()
    failure = f"{track.name}: the undercut profile could not be trimmed ({left.failure}); it is drawn untrimmed"
    return merge_answers((shape, lost, *([Answer(findings=(failure,), outcome="partial")] if left.failure else [])))


def _lost_motion(model, track, left):
    """How far the follower sinks where the profile that it needs has been cut away, and the gap it would leave in its planned place."""
    gap = curves.largest_profile_gap(left.trimmed)[1]
    meaning = f"gap between the follower in its planned place and the real profile{track.of}"
    values = {f"{track.prefix}profile_gap": Value(gap, "m", meaning)}
    try:
        at, lost = curves.largest_lost_motion(left.trimmed, *cams.overtravel(track.follower, model.programme, track.flank))
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
        if (hollow := cams.min_hollow_radius(model.cycle, track.contact, track.radius)) is not None:
            message = "least hollow radius of the profile against the radius of the cutter"
            checks.append(Check(f"cutter{track.suffix}", hollow, cutter / 2, ">=", "m", message, (track.name,)))
    return tuple(checks)
