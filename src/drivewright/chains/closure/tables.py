"""Tables of the rigid chain."""

from drivewright._typing import Floats
from drivewright.chains.closure.model import Closure
from drivewright.chains.closure.positions import Phased
from drivewright.result import Column, Table


def closure_table(found: Closure) -> Table:
    """Table "centre_distance": centre distance, transmission error and seated plates over one tooth of the driver."""
    seated = found.states.seated
    return Table(
        "centre_distance",
        "Rigid chain over one tooth",
        (
            Column("angle", "rad", "angle of the driving sprocket", found.driver_angle),
            Column("centre_distance", "m", "centre distance", found.centre_distance),
            Column("transmission_error", "rad", "transmission error", found.transmission_error),
            Column("seated_drive", "-", "plates seated on the driving sprocket", seated[:, 0].astype(float)),
            Column("seated_driven", "-", "plates seated on the driven sprocket", seated[:, 1].astype(float)),
        ),
    )


def phased_table(found: Phased) -> Table:
    """Table "phased_rows": centre distance and transmission error of one row, and of both together, over one tooth of the driver."""
    return Table(
        "phased_rows",
        "Rows out of phase over one tooth",
        (
            Column("angle", "rad", "angle of the driving sprocket", found.driver_angle),
            Column("centre_distance", "m", "centre distance of both rows", found.centre_distance),
            Column("single_distance", "m", "centre distance of one row", found.single_distance),
            Column("transmission_error", "rad", "transmission error of both rows", found.transmission_error),
            Column("single_error", "rad", "transmission error of one row", found.single_error),
            Column("distance_gap", "m", "centre distance difference of the rows", found.distance_gap),
        ),
    )


def rigid_table(angle: Floats, travel: Floats, error: Floats, words: str) -> Table:
    """Table "rigid_travel" over the driver's angle (S,) [rad]: what gives way so that a rigid chain closes (S,) [m], its name in words, and
    the transmission error (S,) [rad]."""
    return Table(
        "rigid_travel",
        "Rigid chain over one tooth",
        (
            Column("angle", "rad", "angle of the driving sprocket", angle),
            Column("travel", "m", words, travel),
            Column("transmission_error", "rad", "transmission error", error),
        ),
    )
