"""The plots of a shaft and its bearings."""

from drivewright.bearings.tables import bearing_plots
from drivewright.mechanisms.shaft.spec import ShaftSpec
from drivewright.result import Plot, Result
from drivewright.shafts.plots import SURFACE, shaft_plots


def plots(result: Result[ShaftSpec]) -> tuple[Plot, ...]:
    """All plots whose table the result has."""
    every = (*shaft_plots(result), *bearing_plots(result.tables), SURFACE)
    return tuple(plot for plot in every if plot.table in result.tables)
