"""How the tables of chains are looked at."""

from drivewright.chains.explicit.tables import PEAKS
from drivewright.result import Plot

PLOTS = (
    Plot("equivalent_pitch", "Equivalent and ideal pitch", "equivalent_pitch", "turn", ("pitch", "ideal")),
    Plot("centre_distance", "Rigid chain over one tooth", "centre_distance", "angle", ("centre_distance", "transmission_error")),
    Plot("rigid_travel", "Rigid chain over one tooth, tensioner", "rigid_travel", "angle", ("travel", "transmission_error")),
    Plot(
        "phased_rows",
        "Rows out of phase, and one row",
        "phased_rows",
        "angle",
        ("centre_distance", "single_distance", "transmission_error", "single_error"),
    ),
    Plot(
        "trade_off",
        "Trade-offs over the rolling radius",
        "trade_off",
        "rolling_radius",
        ("fluctuation", "contact_pressure", "transmission_error"),
    ),
    Plot("pin_offset", "Pin offset over the rolling radius", "trade_off", "rolling_radius", ("pin_offset",)),
    Plot(
        "pitch_deviation",
        "Pitch deviation over the rolling radius",
        "trade_off",
        "rolling_radius",
        ("pitch_deviation_driven", "pitch_deviation_drive"),
    ),
    Plot("means", "Deviation from a hinged chain", "trade_off", "rolling_radius", ("running_deviation",)),
    Plot("phase_map", "Fluctuation over the number of links", "phase_map", "links", ("fluctuation",), by="design"),
    Plot("wear", "Elongation by wear over running time", "wear", "hours", ("elongation", "limit")),
    Plot("running", "Running chain over time", "running", "time", ("centre_distance", "transmission_error", "tension")),
    Plot("flanks", "Flank forces on a plate", "running", "time", ("plate.left_flank", "plate.right_flank")),
    Plot("spectrum", "Order spectrum of the centre distance", "spectrum", "order", ("centre_distance",), log=True),
    Plot("tensioners", "Travel and force of the tensioners", "tensioners", "time", ("travel", "force"), by="tensioner"),
    Plot("motion_spectrum", "Order spectrum of the drive", "motion_spectrum", "order", ("amplitude",), log=True),
    Plot(
        "quasi_static",
        "Loaded chain at rest over one tooth",
        "quasi_static",
        "angle",
        ("centre_distance", "transmission_error", "contacts"),
    ),
    Plot("plate_forces", "Forces along the chain at rest", "plate_forces", "plate", ("tension", "right_flank", "left_flank")),
    Plot("speeds", "Fluctuation over speed", "speeds", "speed", ("fluctuation", "mesh_order_1")),
    Plot("speeds_mean", "Mean over speed", "speeds", "speed", ("mean",)),
    Plot(
        "campbell",
        "Campbell diagram, highest peaks",
        "campbell",
        "speed",
        (*(f"peak_{k + 1}" for k in range(PEAKS)), "mesh_frequency"),
        style="points",
    ),
    Plot("scatter", "Drives with manufacturing scatter", "scatter", "mean", ("fluctuation",), style="points"),
    Plot("plate_history", "Plate stress and forces per revolution", "plate_history", "time", ("mises", "right_pin", "right_flank")),
    Plot("plate_stress", "Plate stress at its worst instant", "plate_stress", "x", ("y", "depth", "mises"), equal=True, style="mesh"),
    Plot("plate_life", "Damage per revolution around a plate", "plate_life", "x", ("damage",), style="points", log=True),
    Plot(
        "solid_history",
        "Plate and pins over a revolution (solid)",
        "solid_history",
        "time",
        ("plate", "left_pin", "right_pin", "left_seat", "right_seat"),
    ),
    *(
        Plot(name, title, name, x, (y, "depth", size), equal=True, style="mesh", log=size == "life")
        for name, title, x, y, size in (
            ("solid_plate", "Plate stress at its worst instant (solid)", "x", "y", "mises"),
            ("solid_pin", "Pin stress at its worst instant (solid)", "x", "y", "mises"),
            ("hole_section", "Section through the hole, von Mises stress", "x", "z", "mises"),
            ("seat_pressure", "Seat pressure of a pin, unrolled", "along", "height", "pressure"),
            ("solid_plate_life", "Life on the plate surface (solid)", "x", "y", "life"),
            ("solid_pin_life", "Life on the pin surface (solid)", "x", "y", "life"),
        )
    ),
    Plot("rolling_pressure", "Rolling contact along the pins", "rolling_pressure", "height", ("line_load", "pressure")),
    Plot("life_map", "Life around a plate", "life_map", "x", ("y", "depth", "life"), equal=True, style="mesh", log=True),
)
