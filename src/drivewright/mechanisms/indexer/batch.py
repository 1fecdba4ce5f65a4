"""Many pin wheels at once for the optimiser: play, contacts and pressure angles in compiled code."""

from collections.abc import Callable, Sequence

import numpy as np

from drivewright._typing import Floats
from drivewright.indexing.batch import evaluate_designs
from drivewright.indexing.motion import step_angle
from drivewright.mechanisms.indexer.build import law_parameters, motion_to_dwell
from drivewright.mechanisms.indexer.refusals import TRANSLATING, law_name, refuse_contradictions
from drivewright.mechanisms.indexer.spec import IndexerSpec

SIZES = ("pin_circle_radius", "pin_radius", "eccentricity")
RATIO = "motion.motion_to_dwell"
LAW = {"motion.b": "b", "motion.c": "c", "motion.d": "d"}
VALUES = {
    "play.forward.maximum": "play_forward",
    "play.backward.maximum": "play_backward",
    "contacts.minimum": "contacts_minimum",
    "contacts.maximum": "contacts_maximum",
    "pressure_angle.forward.maximum": "pressure_forward",
    "pressure_angle.backward.maximum": "pressure_backward",
    "profile.min_convex_radius": "convex_radius",
}
FACTORS = {"motion.velocity_factor": "velocity_factor", "motion.acceleration_factor": "acceleration_factor"}
MOTION = {"motion.motion_angle": "motion_angle", **FACTORS}


def batch(spec: IndexerSpec, keys: Sequence[str], names: Sequence[str]) -> Callable[[Floats], dict[str, Floats]] | None:
    """designs (n, d) -> {name: (n,)}; None where a key or a value is beyond the batch, which then runs one by one."""
    if spec.kind not in TRANSLATING or spec.load.angle is not None or not set(names) <= {*VALUES, *MOTION}:
        return None
    if not set(keys) <= {*SIZES, RATIO, *LAW}:
        return None
    refuse_contradictions(spec)

    def evaluate(x: Floats) -> dict[str, Floats]:
        """{name: (n,)} of designs (n, d), nan for an impossible one."""
        columns = dict(zip(keys, np.asarray(x, float).T, strict=True))
        circle, pin, throw = (columns.get(key, np.full(len(x), getattr(spec, key))) for key in SIZES)
        parameters = law_parameters(spec) | {LAW[key]: column for key, column in columns.items() if key in LAW}
        angle = step_angle(law_name(spec), columns.get(RATIO, motion_to_dwell(spec)))
        factors = bool(set(names) & set(FACTORS))
        found = evaluate_designs(law_name(spec), parameters, spec.pins, circle, pin, throw, angle, spec.side, factors)
        return {name: getattr(found.wheels, VALUES[name]) if name in VALUES else getattr(found, MOTION[name]) for name in names}

    return evaluate
