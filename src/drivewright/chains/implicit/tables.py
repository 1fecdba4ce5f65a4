"""Tables of the loaded chain at rest."""

import numpy as np

from drivewright.chains.implicit.equilibrium import Equilibrium
from drivewright.result import Column, Table


def rest_table(found: Equilibrium) -> Table:
    """Table "quasi_static": centre distance, transmission error and flanks that touch, over the driver's angle."""
    return Table(
        "quasi_static",
        "Loaded chain at rest over one tooth",
        (
            Column("angle", "rad", "angle of the driving sprocket", np.abs(found.driver_angle - found.driver_angle[0])),
            Column("centre_distance", "m", "centre distance", found.centre_distance),
            Column("transmission_error", "rad", "transmission error", found.transmission_error(1)),
            Column("contacts", "-", "flanks in contact", found.contacts.astype(float)),
        ),
    )


def plate_force_table(found: Equilibrium) -> Table:
    """Table "plate_forces": tension and flank forces of every plate at the first angle."""
    return Table(
        "plate_forces",
        "Forces along the chain at rest",
        (
            Column(
                "plate", "-", "plate number, clockwise from the driving sprocket", np.arange(float(found.tension.shape[1])), "Plate number"
            ),
            Column("tension", "N", "tension of the joint behind the plate", found.tension[0], "Joint tension"),
            Column("right_flank", "N", "right flank force", found.flank_force[0, :, 0]),
            Column("left_flank", "N", "left flank force", found.flank_force[0, :, 1]),
        ),
    )
