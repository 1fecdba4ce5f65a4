"""What the results of a cam obey exactly."""

from typing import Any

from drivewright.claims import Claims, Derivative, Limit, Mirror, Scaling
from drivewright.mechanisms.cam.spec import CamSpec

REASONS = {
    "balances": "the motion of the follower is prescribed: the drive torque is computed from its power",
    "speed": "this preset has no drive speed",
    "mirror": "the pivot of an oscillating follower is on +x by definition, so it has no mirror image",
    "limits": "this preset has no elastic follower",
}


def claims(spec: CamSpec) -> Claims:
    """Derivatives of the programme; kinematics over speed; the mirror image; a stiff follower follows."""
    derivatives = [Derivative("motion", *pair, "angle") for pair in (("lift", "slope"), ("slope", "bend"))]
    speed, limits = (), ()
    if spec.drive is not None:
        derivatives.append(Derivative("kinematics", "velocity", "acceleration", "angle", per=spec.drive.speed))
        powers = {"max_velocity": 1, "max_acceleration": 2, "max_jerk": 3, "lift": 0, "max_pressure_angle": 0}
        speed = (Scaling("drive.speed", powers, ("motion", "geometry")),)
    if spec.drive is not None and spec.vibration is not None:
        limits = (Limit(("vibration.natural_frequency",), "vibration.max_error", 0.0, 2.0, analyses=("vibration",)),)
    mirror = (Mirror(image),) if spec.follower.motion == "translating" else ()
    return Claims(tuple(derivatives), speed=speed, mirror=mirror, limits=limits, reasons=REASONS)


def image(tables: dict[str, Any]) -> dict[str, Any]:
    """The cam that turns the other way: its profile is the mirror image.  An offset counts with the sense, so it stays."""
    turned = "counter-clockwise" if tables.get("rotation") == "clockwise" else "clockwise"
    return tables | {"rotation": turned}
