"""What the results of a Geneva drive obey exactly."""

from drivewright.claims import Balance, Claims, Derivative, Scaling
from drivewright.mechanisms.geneva.loads import no_audit
from drivewright.mechanisms.geneva.spec import GenevaSpec

REASONS = {
    "balances": "the pin enters with a shock that takes energy",
    "mirror": "the wheel steps forward by definition, and its step is symmetric in time",
    "limits": "pin and wheel are rigid; the contact pressure has no rigid limit",
}


def claims(spec: GenevaSpec) -> Claims:
    """Derivatives of the step by angle and time; kinematics over speed; the energy over a turn."""
    derivatives = (
        Derivative("step", "wheel", "rate", "angle"),
        Derivative("step", "rate", "bend", "angle"),
        Derivative("step", "bend", "third", "angle"),
        Derivative("motion", "wheel", "wheel_speed", "time"),
        Derivative("motion", "wheel_speed", "wheel_acceleration", "time"),
    )
    powers = {
        "max_speed": 1,
        "max_acceleration": 2,
        "max_jerk": 3,
        "acceleration_jump": 2,
        "max_speed_ratio": 0,
        "max_bend": 0,
        "step": 0,
        "motion_angle": 0,
        "motion_to_dwell": 0,
        "motion_time": -1,
    }
    balances = () if no_audit(spec) else (Balance("energy.error", 1e-5, ("energy",)),)
    return Claims(derivatives, balances, speed=(Scaling("drive.speed", powers, ("motion",)),), reasons=REASONS)
