"""What the results of an indexing drive obey exactly."""

from typing import Any

from drivewright.claims import Balance, Claims, Derivative, Mirror, Scaling
from drivewright.mechanisms.indexer.spec import IndexerSpec

REASONS = {
    "balances": "this preset has no split shafts, whose loads are computed by two routes",
    "speed": "this preset has no drive, so nothing depends on a speed",
    "mirror": "the index direction is forward by definition; the mirror image of a plane drive is the same drive seen from behind",
    "limits": "play and position of the first contact do not depend on stiffness, and there is no rigid indexer to tend to",
}


def claims(spec: IndexerSpec) -> Claims:
    """Derivatives of the wheel's motion; kinematics over speed; cams of either hand."""
    derivatives = (Derivative("motion", "wheel", "rate", "angle"), Derivative("motion", "rate", "bend", "angle"))
    speed, mirror, balances = (), (), ()
    if spec.shafts is not None:
        balances = (Balance("statics.corrected.deviation", 1e-9, ("bearings",)),)
    if spec.load is not None and spec.load.speed is not None:
        powers = {"motion.peak_speed": 1, "motion.peak_acceleration": 2, "motion.velocity_factor": 0}
        speed = (Scaling("load.speed", powers, ("motion",)),)
    if spec.kind == "globoidal" or (spec.kind == "barrel" and _symmetric(spec)):
        mirror = (Mirror(image, analyses=("motion", "profile", "contacts")),)
    return Claims(derivatives, balances, speed=speed, mirror=mirror, reasons=REASONS)


def _symmetric(spec: IndexerSpec) -> bool:
    """Whether a step run backwards is that step: the image of a barrel, whose cam lies on one side of the wheel, runs backwards."""
    return spec.pin_phase in (None, 0.0, 0.5) and spec.motion.law not in ("table", "spline")


def image(tables: dict[str, Any]) -> dict[str, Any]:
    """The cam whose grooves wind the other way."""
    return tables | {"hand": "left" if tables.get("hand", "right") == "right" else "right"}
