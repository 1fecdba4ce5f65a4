"""Closures of many drives in numbers, for comparisons of rolling radii, numbers of links and tooth numbers."""

from collections.abc import Sequence

import numpy as np

from drivewright._typing import Floats
from drivewright.chains.closure.drive import phase_map
from drivewright.chains.closure.model import Drive
from drivewright.result import Column, Table

POSITIONS = 24  # of a closure in a tooth


def closure_numbers(drives: Sequence[Drive], positions: int = POSITIONS) -> Floats:
    """(n, 3) mean centre distance [m], its fluctuation [m] and the transmission ripple [rad] of n drives; nan where one does not close."""
    rows = phase_map(drives, positions).rows
    return np.array([(row.value.mean, row.value.fluctuation, row.value.transmission_ripple) if row.ok else (np.nan,) * 3 for row in rows])


def phase_map_table(drives: Sequence[Drive], numbers: Floats) -> Table:
    """Table "phase_map" of drives and their `closure_numbers` (n, 3), by the number of links."""
    names = [f"r {1e3 * each.link.radius:.4g} mm, z {each.driver_teeth}/{each.driven_teeth}" for each in drives]
    return Table(
        "phase_map",
        "Fluctuation over the number of links",
        (
            Column("links", "-", "number of links", np.array([each.links for each in drives], float)),
            Column("rolling_radius", "m", "rolling radius", np.array([each.link.radius for each in drives], float)),
            Column("driven_teeth", "-", "teeth of the driven sprocket", np.array([each.driven_teeth for each in drives], float)),
            Column("design", "-", "design: rolling radius and numbers of teeth", np.array(names)),
            Column("fluctuation", "m", "peak-to-peak centre distance", numbers[:, 1]),
            Column("transmission_error", "rad", "peak-to-peak transmission error", numbers[:, 2]),
        ),
    )
