"""The plots of a shaft; they depend on its stations and bearings."""

from collections.abc import Iterator

from drivewright.mechanisms.shaft.spec import ShaftSpec
from drivewright.result import Plot, Result


def plots(result: Result[ShaftSpec]) -> tuple[Plot, ...]:
    """All plots whose table the result has."""
    return tuple(plot for plot in _all(result) if plot.table in result.tables)


def _all(result: Result[ShaftSpec]) -> Iterator[Plot]:
    stations = result.arrays["flexibility"].labels[0] if "flexibility" in result.arrays else ()
    across = "_across" if "diagram" in result.tables and any(result.tables["diagram"]["moment_across"].data) else ""
    columns = [name for each in ("deflection", "slope", "shear", "moment") for name in dict.fromkeys((each, each + across))]
    yield Plot("diagram", "Deflection, slope, shear force and bending moment", "diagram", "z", tuple(columns))
    yield Plot("stress", "Stress along the shaft", "diagram", "z", ("stress",))
    yield Plot(
        "unit_load",
        "Deflection by a unit force; dashed: bearings rigid",
        "unit_load",
        "z",
        tuple(stations),
        reference=tuple(f"{name}.rigid" for name in stations),
    )
    parts = result.arrays["flexibility.shares"].labels[0] if "flexibility.shares" in result.arrays else ()
    yield Plot("shares", "Who contributes what to the flexibility", "shares", "entry", tuple(parts), style="bars")
    if "modes" in result.tables:
        shapes = tuple(column.name for column in result.tables["modes"].columns[1:])
        yield Plot("modes", "Natural modes of bending", "modes", "z", shapes)
    for name in result.tables:
        if name.startswith("elements."):
            bearing = name.partition(".")[2]
            yield Plot(name, f"Load on the rolling elements of bearing {bearing}", name, "angle", ("load",), style="polar")
            angled = ("contact_angle",) if any(result.tables[name]["contact_angle"].data) else ()
            yield Plot(
                f"contact.{bearing}",
                f"Contact angle and pressure in bearing {bearing}",
                name,
                "angle",
                (*angled, "inner_pressure", "outer_pressure"),
            )
        if name.startswith("curve."):
            yield Plot(name, f"Bearing {name.partition('.')[2]} over its load", name, "load", ("displacement", "tangent", "secant"))
    yield Plot(
        "solid_surface",
        "Shaft as a solid of finite elements",
        "solid_surface",
        "z",
        ("y", "x", "displacement"),
        equal=True,
        style="mesh",
        reference=("rest_z", "rest_y"),
    )
