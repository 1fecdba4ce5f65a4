"""The finished profile after trimming, whether it can be made, and its inspection table."""

from collections.abc import Callable, Iterator
from functools import partial, reduce
from typing import Any

import numpy as np

from drivewright import cams, curves
from drivewright.errors import DoesNotAssemble, SolverError
from drivewright.mechanisms.cam.build import CamModel, profile
from drivewright.mechanisms.cam.geometry import existing
from drivewright.mechanisms.cam.spec import TURN
from drivewright.result import Answer, Answers, Check, Value, merge_answers

REMEDY = "enlarge the prime radius, reduce the face radius or lengthen the segment"


def finished_profiles(model: CamModel, done: Answers) -> Answer:
    """The profiles after global trimming: lost motion, size, walls, cutter; one inspection table each."""
    answers = [_one_profile(model, number) for number, track in enumerate(model.tracks) if track.cut]
    return existing(merge_answers((*answers, _cutter(model))))


def untrimmed_measures(model: CamModel) -> Iterator[Callable[[CamModel], Answer]]:
    """The functions that give values and checks of profiles that are not undercut, as `geometry_measures`; see `is_untrimmed`."""
    for number, track in enumerate(model.tracks):
        if track.cut:
            yield partial(_size, number=number)
            if not _is_knife(track):
                yield partial(_nothing_lost, number=number)
    yield _cutter


def is_untrimmed(model: CamModel) -> Any:
    """Whether surely nothing is trimmed away of a cam that is clear of its axis; of many designs a column (n, 1)."""
    if model.programme.continuity < 1:  # the face rounds a corner
        return np.array(False)
    cut = [track for track in model.tracks if track.cut and not _is_knife(track)]
    return reduce(np.logical_and, (cams.is_star_shaped(model.cycle, track.contact) for track in cut), np.array(True))


def _is_knife(track):
    return not track.flat and np.all(np.equal(track.radius, 0))


def _one_profile(model, number):
    track, left = model.tracks[number], profile(model, number)
    prefix, name, tolerance = track.prefix, f"inspection{track.suffix}", model.spec.manufacture.profile_tolerance
    area, length = curves.outline_area(left.outline), curves.perimeter(left.outline)
    if left.trimmed:
        area, length = left.trimmed.area, left.trimmed.perimeter
    values = {
        f"{prefix}profile.area": Value(area, "m^2", f"area within the profile{track.of}", label=track.label("Area of the profile")),
        f"{prefix}profile.perimeter": Value(
            length, "m", f"perimeter of the profile{track.of}", label=track.label("Perimeter of the profile")
        ),
    }
    size = _size(model, number, left.trimmed)
    table = cams.inspection_table(model.cycle, track.contact, left.trimmed, tolerance, name, track.label("Inspection"))
    lost = _lost_motion(model, track, left) if left.trimmed else Answer()
    failure = f"{track.words}: the undercut profile could not be trimmed ({left.failure}); it is drawn untrimmed"
    shape = Answer({**size.values, **values}, (table,), size.checks)
    return merge_answers((shape, lost, *([Answer(findings=(failure,), outcome="partial")] if left.failure else [])))


def _size(model, number, trimmed=None):
    """Minimum and maximum polar radius of a profile, and the walls to bore and hub."""
    track = model.tracks[number]
    least, greatest = cams.profile_radii(model.cycle, track.contact, trimmed)
    values = {
        f"{track.prefix}profile.{name}_radius": Value(
            radius,
            "m",
            f"{words} distance of the profile from the cam centre{track.of}",
            label=track.label(f"{words.capitalize()} polar radius"),
        )
        for name, words, radius in (("min", "minimum", least), ("max", "maximum", greatest))
    }
    return Answer(values, (), tuple(_wall_checks(model, track, least)))


def _nothing_lost(model, number):
    """Gap and lost motion of a profile that is whole."""
    track = model.tracks[number]
    gap, (lost, check) = _gap(track, 0.0), _lost(model, track, 0.0)
    return Answer({**gap, **lost}, (), (check,))


def _gap(track, gap):
    meaning = f"maximum gap between the follower in its prescribed position and the finished profile{track.of}"
    return {f"{track.prefix}profile_gap": Value(gap, "m", meaning, label=track.label("Profile gap"))}


def _lost(model, track, lost):
    """(values, check) of a lost motion."""
    travel, label = "at the end of the arm" if model.oscillating else "along its travel", track.label("Lost motion")
    meaning = f"maximum overtravel of the follower beyond its programme into the undercut profile, {travel}{track.of}"
    message = f"overtravel of the follower beyond its programme into the undercut profile; {REMEDY}"
    check = Check(f"lost_motion{track.suffix}", lost, model.spec.limits.lost_motion, "<=", "m", message, (track.name,), True, label=label)
    return {f"{track.prefix}lost_motion": Value(lost, "m", meaning, label=label)}, check


def _lost_motion(model, track, left):
    """Overtravel of the follower where its profile has been cut away, and the gap that it would leave in its prescribed position."""
    values = _gap(track, curves.largest_profile_gap(left.trimmed)[1])
    try:
        at, lost = curves.largest_lost_motion(left.trimmed, *cams.overtravel(track.follower, model.programme, track.flank))
    except (SolverError, DoesNotAssemble) as error:
        finding = f"the {track.words} is undercut so deeply that its lost motion cannot be computed: {error}"
        return Answer(values, findings=(finding,), outcome="partial")
    lost_values, check = _lost(model, track, lost)
    values |= lost_values
    if not lost > 0:
        return Answer(values, (), (check,))
    values[f"{track.prefix}lost_motion.at"] = Value(
        at % TURN,
        "rad",
        f"cam angle at the maximum lost motion{track.of}",
        label=track.label("Cam angle at maximum lost motion"),
        convention="0 at the start of the programme",
    )
    finding = (
        f"the {track.words} is undercut: near cam angle {np.degrees(at):.1f}° the follower overtravels its programme by "
        f"{1e3 * lost:.3g} mm; {REMEDY}"
    )
    return Answer(values, (), (check,), (finding,))


def _wall_checks(model, track, least):
    """Material between profile, hub and bore of a cam that is worked from the outside."""
    make, wall, parts = model.spec.manufacture, model.spec.limits.wall, (track.name,)
    bore, hub, name = 0.0 if make.bore is None else make.bore / 2, make.hub_diameter, track.suffix
    if track.flank < 0:
        return []
    message, label = "minimum wall thickness between bore and profile; reduce the bore or enlarge the cam", "Wall between bore and profile"
    checks = [Check(f"bore_wall{name}", least - bore, wall, ">=", "m", message, parts, True, label=track.label(label))]
    checks = [] if make.bore is None else checks
    if hub is not None:
        message, label = "wall thickness between bore and hub; reduce the bore or enlarge the hub", track.label("Wall between bore and hub")
        checks.append(Check(f"hub_wall{name}", hub / 2 - bore, wall, ">=", "m", message, parts, True, label=label))
        message = "minimum distance from the hub out to the profile; reduce the hub diameter or enlarge the cam"
        label = track.label("Clearance, hub to profile")
        checks.append(Check(f"hub_clearance{name}", least - hub / 2, 0.0, ">=", "m", message, parts, label=label))
    return checks


def _cutter(model):
    """Whether the milling cutter reaches every concave part; nan where a profile has none."""
    cutter, message = model.spec.manufacture.cutter_diameter, "cutter diameter against the width of the groove; take a smaller cutter"
    if model.spec.closure == "groove":
        width = 2 * model.follower.radius + model.clearance
        return Answer(checks=(Check("cutter", cutter, width, "<=", "m", message, ("cam",), label="Cutter diameter for the groove"),))
    message = "minimum concave radius of the profile against the cutter radius; take a smaller cutter or smooth the profile"
    label = "Concave radius for the cutter"
    hollow = {track: cams.min_hollow_radius(model.cycle, track.contact, track.radius) for track in model.tracks if _is_hollowed(track)}
    return Answer(
        checks=tuple(
            Check(f"cutter{track.suffix}", radius, cutter / 2, ">=", "m", message, (track.name,), label=track.label(label))
            for track, radius in hollow.items()
        )
    )


def _is_hollowed(track):
    return track.cut and not track.flat
