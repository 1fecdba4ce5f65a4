"""Tables of the rigid chain."""

from drivewright.chains.closure.model import Closure
from drivewright.result import Column, Table


def closure_table(found: Closure) -> Table:
    """Table "centre_distance": centre distance, transmission error and seated plates over one tooth of the driver."""
    seated = found.states.seated
    return Table(
        "centre_distance",
        "Centre distance over one tooth of the driving sprocket",
        (
            Column("angle", "rad", "angle of the driving sprocket", found.driver_angle),
            Column("centre_distance", "m", "centre distance", found.centre_distance),
            Column("transmission_error", "rad", "driven angle off the ratio of teeth", found.transmission_error),
            Column("seated_drive", "-", "plates seated on the driving sprocket", seated[:, 0].astype(float)),
            Column("seated_driven", "-", "plates seated on the driven sprocket", seated[:, 1].astype(float)),
        ),
    )
