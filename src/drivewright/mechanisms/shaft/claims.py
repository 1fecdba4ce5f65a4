"""What the results of a shaft obey exactly."""

from typing import Any

from drivewright.claims import Balance, Claims, Derivative, Limit, Mirror
from drivewright.mechanisms.shaft.spec import ShaftSpec

REASONS = {
    "speed": "deflections do not depend on the speed",
    "limits": "the stiffness of rolling bearings follows from their geometry: there is no number that could grow",
}
STRAIGHT = 180.0  # deg


def claims(spec: ShaftSpec) -> Claims:
    """The slope along the shaft, the mirror image across the vertical plane, springs that tend to rigid supports."""
    derivatives = [Derivative("diagram", "moment", "shear", "z", per=-1.0)]
    if spec.analysis.theory == "euler-bernoulli":  # else the slope is that of the section, not of the line
        derivatives.append(Derivative("diagram", "deflection", "slope", "z"))
    springs = [bearing.name for bearing in spec.bearings if bearing.radial_stiffness is not None]
    limits = ()
    if len(springs) == len(spec.bearings):
        keys = tuple(f"bearings.{name}.radial_stiffness" for name in springs)
        limits = (Limit(keys, "shaft.max_deflection", dict.fromkeys(keys, "rigid"), 1.0, (1e2, 1e4), ("statics",)),)
    balances = (Balance("equilibrium", 1e-9, ("statics",)),)
    return Claims(tuple(derivatives), balances, mirror=(Mirror(image, ("*_x",), analyses=("statics",)),), limits=limits, reasons=REASONS)


def image(tables: dict[str, Any]) -> dict[str, Any]:
    """The shaft in a mirror that stands in the vertical plane of its axis: x the other way round, so turns about y and z too."""
    loads = [_across(_reversed(load, "torque", "moment_angle"), "angle") for load in tables.get("loads", [])]
    gears = [_across(_reversed(gear, "torque", "helix_angle"), "mesh_angle", 0.0) for gear in tables.get("gears", [])]
    lines = [_across(load, "angle") for load in tables.get("line_loads", [])]
    image = tables | {"loads": loads, "gears": gears, "line_loads": lines}
    if "direction" in tables.get("analysis", {}):
        image["analysis"] = _across(tables["analysis"], "direction")
    return {key: value for key, value in image.items() if value or key in tables}


def _across(table: dict[str, Any], key: str, usual: float = -90.0) -> dict[str, Any]:
    """The table with an angle from x towards y on the other side of the plane."""
    text = table.get(key, f"{usual} deg")
    return table | {key: f"{STRAIGHT - float(text.removesuffix(' deg'))!r} deg"}


def _reversed(table: dict[str, Any], *keys: str) -> dict[str, Any]:
    return table | {key: table[key][1:] if table[key].startswith("-") else f"-{table[key]}" for key in keys if key in table}
