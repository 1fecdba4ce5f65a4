"""The plots of a chain drive; they depend on what was computed."""

from drivewright.mechanisms.silent_chain.many import PEAKS
from drivewright.result import Plot, Result


def plots(result: Result) -> tuple[Plot, ...]:
    """All plots whose table the result has."""
    return tuple(plot for plot in _all(result) if plot.table in result.tables)


def _all(result):
    yield Plot("equivalent_pitch", "Equivalent pitch as published, and the ideal one", "equivalent_pitch", "turn", ("pitch", "ideal"))
    yield Plot(
        "centre_distance",
        "Centre distance and transmission error over a tooth, rigid",
        "centre_distance",
        "angle",
        ("centre_distance", "transmission_error"),
    )
    yield Plot(
        "trade_off",
        "What the rolling radius trades",
        "trade_off",
        "rolling_radius",
        ("fluctuation", "contact_pressure", "transmission_error"),
    )
    if "trade_off" in result.tables and "pin_offset" in [column.name for column in result.tables["trade_off"].columns]:
        yield Plot("pin_offset", "Offset of the pins over the rolling radius, as published", "trade_off", "rolling_radius", ("pin_offset",))
        yield Plot(
            "pitch_deviation",
            "Seated less ideal pitch over the rolling radius, as published",
            "trade_off",
            "rolling_radius",
            ("pitch_deviation_driven", "pitch_deviation_drive"),
        )
    yield Plot("means", "Mean centre distance over that of a hinged chain", "trade_off", "rolling_radius", ("running_deviation",))
    yield Plot("phase_map", "Fluctuation by the number of links", "phase_map", "links", ("fluctuation",), by="design")
    yield Plot("running", "The running chain", "running", "time", ("centre_distance", "transmission_error", "tension"))
    yield Plot("flanks", "Flanks of a plate that goes round", "running", "time", ("plate.left_flank", "plate.right_flank"))
    yield Plot("spectrum", "Spectrum of the centre distance by mesh orders", "spectrum", "order", ("centre_distance",), log=True)
    yield Plot(
        "quasi_static",
        "The loaded chain at rest over a tooth",
        "quasi_static",
        "angle",
        ("centre_distance", "transmission_error", "contacts"),
    )
    yield Plot("plate_forces", "Forces along the chain at rest", "plate_forces", "plate", ("tension", "right_flank", "left_flank"))
    yield Plot("speeds", "Fluctuation of the centre distance over the speed", "speeds", "speed", ("fluctuation", "mesh_order_1"))
    yield Plot("speeds_mean", "Mean centre distance over the speed", "speeds", "speed", ("mean",))
    peaks = tuple(f"peak_{k + 1}" for k in range(PEAKS))
    yield Plot(
        "campbell",
        "Campbell diagram: highest peaks of the centre distance",
        "campbell",
        "speed",
        (*peaks, "mesh_frequency"),
        style="points",
    )
    yield Plot("scatter", "Drives as they come from manufacture", "scatter", "mean", ("fluctuation",), style="points")
    yield Plot(
        "plate_history", "Stress and forces of a plate over a revolution", "plate_history", "time", ("mises", "right_pin", "right_flank")
    )
    yield Plot(
        "plate_stress",
        "Von Mises stress of a plate at its worst instant",
        "plate_stress",
        "x",
        ("y", "depth", "mises"),
        equal=True,
        style="mesh",
    )
    yield Plot("plate_life", "Damage of a revolution around a plate", "plate_life", "x", ("damage",), style="points", log=True)
    yield Plot("life_map", "Life around a plate", "life_map", "x", ("y", "depth", "life"), equal=True, style="mesh")
