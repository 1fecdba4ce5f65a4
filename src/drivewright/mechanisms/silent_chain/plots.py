"""The plots of a chain drive; they depend on what was computed."""

from drivewright.chains.plots import PLOTS
from drivewright.result import Plot, Result


def plots(result: Result) -> tuple[Plot, ...]:
    """All plots whose columns the result has."""
    columns = {name: {column.name for column in table.columns} for name, table in result.tables.items()}
    return tuple(plot for plot in PLOTS if {plot.x, *plot.y} <= columns.get(plot.table, set()))
