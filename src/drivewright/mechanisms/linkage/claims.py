"""What the results of a linkage obey exactly."""

from typing import Any

from drivewright.claims import Balance, Claims, Derivative, Mirror, Scaling
from drivewright.mechanisms.linkage.spec import LinkageSpec

REASONS = {
    "speed": "with clearance in a pin twice the speed is another motion, not the same path",
    "mirror": "with clearance in a pin the motion is chaotic: its mirror image departs from it by rounding",
    "limits": "no preset has massless links, whose motion tends to the ideal one in the first order of the clearance",
}


def claims(spec: LinkageSpec) -> Claims:
    """Derivatives of every output; the energy audit; of ideal joints kinematics over speed and the mirror image."""
    derivatives = tuple(pair for output in spec.outputs for pair in _derivatives(output.name, output.point is not None))
    audits = {"energy.error": (1e-6, "energy"), "power_audit": (1e-5, "energy"), "forces.residual": (1e-9, "forces")}
    balances = tuple(Balance(name, limit, (analysis,)) for name, (limit, analysis) in audits.items())
    if any(joint.pin in ("dry", "lubricated", "massless-link") for joint in spec.joints):
        return Claims(derivatives, balances, reasons=REASONS)
    speed = (Scaling("drive.speed", {"*.max_angular_acceleration": 2, "*.swing": 0}, ("motion",), 1e-6),) if spec.outputs else ()
    reasons = REASONS if spec.outputs else REASONS | {"speed": "this preset has no outputs"}
    odd = ("*.y", "*.vy", "*.angle", "*.angular_velocity")
    mirror = Mirror(image, odd, analyses=("motion", "end"), tolerance=1e-7)
    return Claims(derivatives, balances, speed, (mirror,), reasons=reasons)


def _derivatives(name: str, of_point: bool) -> tuple[Derivative, ...]:
    pairs = (("x", "vx"), ("y", "vy"), ("vx", "ax"), ("vy", "ay")) if of_point else (("angle", "w"), ("w", "alpha"))
    return tuple(Derivative("motion", f"{name}.{position}", f"{name}.{rate}", "time") for position, rate in pairs)


def image(tables: dict[str, Any]) -> dict[str, Any]:
    """The linkage reflected about the x axis, gravity and drive included."""
    drive = tables["drive"]
    return (
        tables
        | _reflected(tables, "gravity")
        | {
            "ground": _body(tables.get("ground", {})),
            "bodies": {name: _body(body) for name, body in tables["bodies"].items()},
            "joints": [_reflected(joint, "axis") for joint in tables["joints"]],
            "drive": [_reversed(each, "speed") for each in drive] if isinstance(drive, list) else _reversed(drive, "speed"),
        }
    )


def _body(table: dict[str, Any]) -> dict[str, Any]:
    points = {name: [point[0], _negated(point[1])] for name, point in table.get("points", {}).items()}
    return _reflected(_reversed(table | {"points": points}, "angle", "angular_velocity"), "centroid", "velocity")


def _reversed(table: dict[str, Any], *keys: str) -> dict[str, Any]:
    """The table with angles and rates the other way round."""
    return table | {key: _negated(table[key]) for key in keys if key in table}


def _reflected(table: dict[str, Any], *keys: str) -> dict[str, Any]:
    """The table with the second coordinate of vectors the other way round."""
    return table | {key: [table[key][0], _negated(table[key][1])] for key in keys if key in table}


def _negated(value: Any) -> Any:
    """A number or a quantity with the other sign."""
    if not isinstance(value, str):
        return -value
    return value[1:] if value.startswith("-") else f"-{value}"
