"""The plots of a shaft and its bearings."""

from drivewright.bearings.tables import bearing_plots
from drivewright.mechanisms.shaft.spec import ShaftSpec
from drivewright.result import Plot, Result
from drivewright.shafts.force_results import vector_plots
from drivewright.shafts.haigh import haigh_plots
from drivewright.shafts.plots import SURFACE, shaft_plots
from drivewright.shafts.rotor_results import rotor_plots


def plots(result: Result[ShaftSpec]) -> tuple[Plot, ...]:
    """All plots whose table the result has."""
    spec, at = result.spec, places(result.spec)
    turning = rotor_plots(result.tables, spec.drive.speed if spec.drive else None, at)
    of_tables = (plots for kind in (haigh_plots, vector_plots, bearing_plots) for plots in kind(result.tables))
    every = (*shaft_plots(result, at), *turning, *of_tables, SURFACE)
    return tuple(plot for plot in every if plot.table in result.tables)


def places(spec: ShaftSpec) -> tuple[tuple[float, str], ...]:
    """(position [m], name) of bearings, stations, gears and forces along the shaft; what stands at one place shares a name."""
    at: dict[float, list[str]] = {}
    for each in (*spec.bearings, *spec.stations, *spec.gears):
        at.setdefault(round(each.position, 9), []).append(each.name)
    stations = {station.name: station.position for station in spec.stations}
    for load in spec.loads:
        place = stations[str(load.station)] if load.position is None else load.position
        if load.force:
            at.setdefault(round(place, 9), []).append(f"{load.force:.5g} N")
    return tuple((place, ", ".join(names)) for place, names in sorted(at.items()))
