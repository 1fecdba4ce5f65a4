"""For the workshop: teeth of the elliptic gears and the inspection table of both profiles."""

import numpy as np

from drivewright.mechanisms.seedling_pusher.build import PusherModel
from drivewright.result import Answer, Answers, Check, Column, Table, Value


def inspection(model: PusherModel, done: Answers) -> Answer:
    """Polar coordinates of both finished profiles at whole degrees, with the tolerance."""
    return Answer(tables=tuple(_polar(model, name, trimmed) for name, trimmed in model.trimmed.items()))


DENSE = 20_001  # points on each stretch of the profile: chords so short that the radius between two of them is exact to 1 nm


def _polar(model, name, trimmed):
    stretches = (span.piece.at(np.linspace(span.start, span.stop, DENSE)).d0 for span in trimmed.spans)
    z = np.concatenate([np.broadcast_to(stretch, DENSE) for stretch in stretches])
    order = np.argsort(np.angle(z))
    angle, radius = np.angle(z)[order], np.abs(z)[order]
    at = np.radians(np.arange(0, 360))
    measured = np.interp(np.angle(np.exp(1j * at)), angle, radius, period=2 * np.pi)
    return Table(
        f"inspection_{name}",
        f"Inspection of the {name} cam, in the frame of its formulas (lever pivot on -y at the start)",
        (
            Column("angle", "rad", "polar angle, counter-clockwise from +x", at),
            Column("radius", "m", "profile radius", measured),
            Column("tolerance", "m", "allowed deviation, either side", np.full(360, model.spec.manufacture.profile_tolerance)),
        ),
    )


def teeth(model: PusherModel, done: Answers) -> Answer:
    """Perimeter, module and undercut of the three congruent gears."""
    gear = model.gear
    pair = gear.family.pair
    lost = max((cut.lost for cut in gear.undercut), default=0.0)
    values = {
        "gear.perimeter": Value(float(pair.perimeter()), "m", "perimeter of the pitch ellipse"),
        "gear.module": Value(float(gear.module), "m", "module: perimeter / (pi * teeth)"),
        "gear.max_curvature_radius": Value(1 / pair.least_curvature()[1], "m", "largest radius of curvature of the pitch ellipse"),
        "gear.lost_flank": Value(float(lost), "m", "straight cutter depth that leaves no flank because of undercut"),
    }
    parts = ("sun", "intermediate", "planet")
    checks = (Check("gear.undercut", float(lost), 0.0, "<=", "m", "the rack cutter leaves the tooth flanks whole", parts, True),)
    return Answer(values, (), checks, (gear.describe_undercut(),) if gear.undercut else ())
