"""For manufacture: teeth of the elliptic gears and the inspection table of both profiles."""

import numpy as np

from drivewright.cams import polar_radii
from drivewright.mechanisms.seedling_pusher.build import PusherModel
from drivewright.result import Answer, Answers, Check, Column, Table, Value


def inspection(model: PusherModel, done: Answers) -> Answer:
    """Polar coordinates of both finished profiles at whole degrees, with the tolerance."""
    return Answer(tables=tuple(_polar(model, name, trimmed) for name, trimmed in model.pair.trimmed.items()))


def _polar(model, name, trimmed):
    columns = (
        Column(
            "angle", "rad", "polar angle, counter-clockwise from +x; the lever pivot is on -y at the start", np.radians(np.arange(0, 360))
        ),
        Column("radius", "m", "radius of the profile", polar_radii(trimmed, np.radians(np.arange(0, 360)))),
        Column(
            "tolerance",
            "m",
            "allowed deviation, plus and minus",
            np.full(360, model.spec.manufacture.profile_tolerance),
            "Profile tolerance",
        ),
    )
    return Table(f"inspection_{name}", f"Inspection of the {name} cam", columns)


def teeth(model: PusherModel, done: Answers) -> Answer:
    """Perimeter, module and undercut of the three congruent gears."""
    gear = model.gear
    pair = gear.family.pair
    lost, label = max((cut.lost for cut in gear.undercut), default=0.0), "Flank depth lost to undercut"
    values = {
        "gear.perimeter": Value(float(pair.perimeter()), "m", "perimeter of the pitch ellipse"),
        "gear.module": Value(float(gear.module), "m", "module of the gears: perimeter over pi times the number of teeth"),
        "gear.max_curvature_radius": Value(
            1 / pair.min_curvature()[1],
            "m",
            "maximum radius of curvature of the pitch ellipse",
            label="Maximum radius of the pitch ellipse",
        ),
        "gear.lost_flank": Value(float(lost), "m", "straight depth of the cutter that leaves no flank because of undercut", label=label),
    }
    parts = ("sun", "intermediate", "planet")
    message = "depth of the tooth flanks lost to undercut by the rack cutter; take more teeth"
    checks = (Check("gear.undercut", float(lost), 0.0, "<=", "m", message, parts, True, label=label),)
    return Answer(values, (), checks, (gear.describe_undercut(),) if gear.undercut else ())
