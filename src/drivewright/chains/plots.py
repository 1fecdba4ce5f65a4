"""How the tables of chains are looked at."""

from drivewright.chains.explicit.tables import PEAKS
from drivewright.result import Plot

PLOTS = (
    Plot("equivalent_pitch", "Equivalent pitch as published, and the ideal one", "equivalent_pitch", "turn", ("pitch", "ideal")),
    Plot(
        "centre_distance",
        "Centre distance and transmission error over a tooth, rigid",
        "centre_distance",
        "angle",
        ("centre_distance", "transmission_error"),
    ),
    Plot("rigid_travel", "Travel and transmission error over a tooth, rigid", "rigid_travel", "angle", ("travel", "transmission_error")),
    Plot(
        "phased_rows",
        "Two rows out of phase, and one alone",
        "phased_rows",
        "angle",
        ("centre_distance", "single_distance", "transmission_error", "single_error"),
    ),
    Plot(
        "trade_off",
        "What the rolling radius trades",
        "trade_off",
        "rolling_radius",
        ("fluctuation", "contact_pressure", "transmission_error"),
    ),
    Plot("pin_offset", "Offset of the pins over the rolling radius, as published", "trade_off", "rolling_radius", ("pin_offset",)),
    Plot(
        "pitch_deviation",
        "Seated less ideal pitch over the rolling radius, as published",
        "trade_off",
        "rolling_radius",
        ("pitch_deviation_driven", "pitch_deviation_drive"),
    ),
    Plot("means", "Mean centre distance over that of a hinged chain", "trade_off", "rolling_radius", ("running_deviation",)),
    Plot("phase_map", "Fluctuation by the number of links", "phase_map", "links", ("fluctuation",), by="design"),
    Plot("wear", "Elongation by wear over the running time", "wear", "hours", ("elongation", "limit")),
    Plot("running", "The running chain", "running", "time", ("centre_distance", "transmission_error", "tension")),
    Plot("flanks", "Flanks of a plate that goes round", "running", "time", ("plate.left_flank", "plate.right_flank")),
    Plot("spectrum", "Spectrum of the centre distance by mesh orders", "spectrum", "order", ("centre_distance",), log=True),
    Plot("tensioners", "Travel and force of the tensioners", "tensioners", "time", ("travel", "force"), by="tensioner"),
    Plot("motion_spectrum", "Spectrum of the drive by mesh orders", "motion_spectrum", "order", ("amplitude",), log=True),
    Plot(
        "quasi_static",
        "The loaded chain at rest over a tooth",
        "quasi_static",
        "angle",
        ("centre_distance", "transmission_error", "contacts"),
    ),
    Plot("plate_forces", "Forces along the chain at rest", "plate_forces", "plate", ("tension", "right_flank", "left_flank")),
    Plot("speeds", "Fluctuation of the centre distance over the speed", "speeds", "speed", ("fluctuation", "mesh_order_1")),
    Plot("speeds_mean", "Mean centre distance over the speed", "speeds", "speed", ("mean",)),
    Plot(
        "campbell",
        "Campbell diagram: highest peaks of the centre distance",
        "campbell",
        "speed",
        (*(f"peak_{k + 1}" for k in range(PEAKS)), "mesh_frequency"),
        style="points",
    ),
    Plot("scatter", "Drives as they come from manufacture", "scatter", "mean", ("fluctuation",), style="points"),
    Plot("plate_history", "Stress and forces of a plate over a revolution", "plate_history", "time", ("mises", "right_pin", "right_flank")),
    Plot(
        "plate_stress",
        "Von Mises stress of a plate at its worst instant",
        "plate_stress",
        "x",
        ("y", "depth", "mises"),
        equal=True,
        style="mesh",
    ),
    Plot("plate_life", "Damage of a revolution around a plate", "plate_life", "x", ("damage",), style="points", log=True),
    Plot(
        "solid_history",
        "Plate and pins as solids over a revolution of the chain",
        "solid_history",
        "time",
        ("plate", "left_pin", "right_pin", "left_seat", "right_seat"),
    ),
    *(
        Plot(name, title, name, x, (y, "depth", size), equal=True, style="mesh", log=size == "life")
        for name, title, x, y, size in (
            ("solid_plate", "Plate as a solid: von Mises stress at its worst instant", "x", "y", "mises"),
            ("solid_pin", "Pin as a solid, from its seat: von Mises stress at its worst instant", "x", "y", "mises"),
            ("hole_section", "Section through the hole: von Mises stress of plate and pin", "x", "z", "mises"),
            ("seat_pressure", "Pressure of a pin on its seat, unrolled", "along", "height", "pressure"),
            ("solid_plate_life", "Plate as a solid: life", "x", "y", "life"),
            ("solid_pin_life", "Pin as a solid, from its seat: life", "x", "y", "life"),
        )
    ),
    Plot("rolling_pressure", "Rolling contact of two pins along the pins", "rolling_pressure", "height", ("line_load", "pressure")),
    Plot("life_map", "Life around a plate", "life_map", "x", ("y", "depth", "life"), equal=True, style="mesh", log=True),
)
