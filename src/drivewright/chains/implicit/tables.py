"""Tables of the loaded chain at rest."""

import numpy as np

from drivewright.chains.implicit.equilibrium import Equilibrium
from drivewright.result import Column, Table


def rest_table(found: Equilibrium) -> Table:
    """Table "quasi_static": centre distance, transmission error and flanks that touch, over the driver's angle."""
    return Table(
        "quasi_static",
        "The loaded chain at rest over a tooth",
        (
            Column("angle", "rad", "angle of the driving sprocket", np.abs(found.driver_angle - found.driver_angle[0])),
            Column("centre_distance", "m", "centre distance", found.centre_distance),
            Column("transmission_error", "rad", "driven angle off the ratio of teeth", found.transmission_error(1)),
            Column("contacts", "-", "flanks that touch", found.contacts.astype(float)),
        ),
    )


def plate_force_table(found: Equilibrium) -> Table:
    """Table "plate_forces": tension and flank forces of every plate at the first angle."""
    return Table(
        "plate_forces",
        "Forces in the chain at rest, plate by plate",
        (
            Column("plate", "-", "plate, clockwise from the driving sprocket", np.arange(float(found.tension.shape[1]))),
            Column("tension", "N", "of the joint behind the plate", found.tension[0]),
            Column("right_flank", "N", "force on the right flank", found.flank_force[0, :, 0]),
            Column("left_flank", "N", "force on the left flank", found.flank_force[0, :, 1]),
        ),
    )
