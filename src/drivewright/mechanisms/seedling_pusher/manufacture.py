"""For the workshop: teeth of the elliptic gears and the inspection table of both profiles."""

import numpy as np

from drivewright.cams import polar_radii
from drivewright.mechanisms.seedling_pusher.build import PusherModel
from drivewright.result import Answer, Answers, Check, Column, Table, Value


def inspection(model: PusherModel, done: Answers) -> Answer:
    """Polar coordinates of both finished profiles at whole degrees, with the tolerance."""
    return Answer(tables=tuple(_polar(model, name, trimmed) for name, trimmed in model.pair.trimmed.items()))


def _polar(model, name, trimmed):
    columns = (
        Column("angle", "rad", "polar angle, counter-clockwise from +x", np.radians(np.arange(0, 360))),
        Column("radius", "m", "profile radius", polar_radii(trimmed, np.radians(np.arange(0, 360)))),
        Column("tolerance", "m", "allowed deviation, either side", np.full(360, model.spec.manufacture.profile_tolerance)),
    )
    title = f"Inspection of the {name} cam, in the frame of its formulas (lever pivot on -y at the start)"
    return Table(f"inspection_{name}", title, columns)


def teeth(model: PusherModel, done: Answers) -> Answer:
    """Perimeter, module and undercut of the three congruent gears."""
    gear = model.gear
    pair = gear.family.pair
    lost = max((cut.lost for cut in gear.undercut), default=0.0)
    values = {
        "gear.perimeter": Value(float(pair.perimeter()), "m", "perimeter of the pitch ellipse"),
        "gear.module": Value(float(gear.module), "m", "module: perimeter / (pi * teeth)"),
        "gear.max_curvature_radius": Value(1 / pair.min_curvature()[1], "m", "largest radius of curvature of the pitch ellipse"),
        "gear.lost_flank": Value(float(lost), "m", "straight cutter depth that leaves no flank because of undercut"),
    }
    parts = ("sun", "intermediate", "planet")
    checks = (Check("gear.undercut", float(lost), 0.0, "<=", "m", "the rack cutter leaves the tooth flanks whole", parts, True),)
    return Answer(values, (), checks, (gear.describe_undercut(),) if gear.undercut else ())
