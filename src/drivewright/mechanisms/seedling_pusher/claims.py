"""What the results of a seedling pusher obey exactly."""

from drivewright.claims import Claims, Derivative, Scaling
from drivewright.mechanisms.seedling_pusher.spec import SeedlingPusherSpec

REASONS = {
    "balances": "the motion of the rod is prescribed by two cams: the torque of the carrier is computed from the power of the rod",
    "mirror": "the carrier rotates clockwise by definition: the mirror image of a pusher is the same machine seen from behind",
    "limits": "the rod follows its cams without a spring: only the contact simulation has elastic parts",
}


def claims(spec: SeedlingPusherSpec) -> Claims:
    """The rod's rates over the carrier's angle and over its speed."""
    speed = spec.drive.speed
    derivatives = (
        Derivative("cycle", "planet_angle", "planet_ratio", "carrier_angle"),
        Derivative("cycle", "rod", "rod_velocity", "carrier_angle", per=speed),
        Derivative("cycle", "rod_velocity", "rod_acceleration", "carrier_angle", per=speed),
    )
    path = {"train.swing": 0, "tip.track_height": 0, "planting.mouth_width": 0}
    return Claims(derivatives, speed=(Scaling("drive.speed", path, ("train", "planting")),), reasons=REASONS)
