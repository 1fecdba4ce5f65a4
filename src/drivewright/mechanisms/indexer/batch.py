"""Many pin wheels at once for the optimiser: play, contacts and pressure angles in the compiled sweep."""

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from drivewright import motion
from drivewright._typing import Bools, Floats
from drivewright.errors import InputError
from drivewright.indexing.batch import evaluate_pin_wheels
from drivewright.indexing.motion import NO_DWELL, TURN
from drivewright.mechanisms.indexer.refusals import TRANSLATING, law_name, refuse_contradictions
from drivewright.mechanisms.indexer.spec import IndexerSpec
from drivewright.motion import MotionLaw

SIZES = ("pin_circle_radius", "pin_radius", "eccentricity")
RATIO = "motion.motion_to_dwell"
LAW = {"motion.b": "b", "motion.c": "c", "motion.d": "d"}
VALUES = {
    "play.forward.maximum": lambda found: found.play_forward,
    "play.backward.maximum": lambda found: found.play_backward,
    "contacts.minimum": lambda found: found.contacts_minimum,
    "contacts.maximum": lambda found: found.contacts_maximum,
    "pressure_angle.forward.maximum": lambda found: found.pressure_forward,
    "pressure_angle.backward.maximum": lambda found: found.pressure_backward,
    "profile.min_convex_radius": lambda found: found.convex_radius,
}


MOTION = {  # of the law's peaks, the pitch and the motion angle
    "motion.motion_angle": lambda peaks, pitch, angle: angle,
    "motion.velocity_factor": lambda peaks, pitch, angle: pitch * peaks.Vm / angle,
    "motion.acceleration_factor": lambda peaks, pitch, angle: pitch * peaks.Am / angle**2,
}


def batch(spec: IndexerSpec, keys: Sequence[str], names: Sequence[str]) -> Callable[[Floats], dict[str, Floats]] | None:
    """designs (n, d) -> {name: (n,)}; None where a key or a value is beyond the sweep, which then runs one by one."""
    if spec.kind not in TRANSLATING or spec.load.angle is not None or not set(names) <= {*VALUES, *MOTION}:
        return None
    if not set(keys) <= {*SIZES, RATIO, *LAW}:
        return None
    refuse_contradictions(spec)

    def evaluate(x: Floats) -> dict[str, Floats]:
        """{name: (n,)} of designs (n, d), NaN for an impossible one."""
        columns = dict(zip(keys, np.asarray(x, float).T, strict=True))
        sizes = [columns.get(key, np.full(len(x), getattr(spec, key))) for key in SIZES]
        shapes = np.stack([columns[key] for key in LAW if key in columns], axis=1) if set(columns) & set(LAW) else np.zeros((len(x), 0))
        found = {name: np.full(len(x), np.nan) for name in names}
        for shape in np.unique(shapes, axis=0):
            own = np.all(shapes == shape, axis=1)
            law = _law(spec, dict(zip([LAW[key] for key in LAW if key in columns], shape, strict=True)))
            if law is not None:
                angle = _motion_angle(spec, columns.get(RATIO), own)
                circle, pin, throw = (size[own] for size in sizes)
                design_values = evaluate_pin_wheels(law, spec.pins, circle, pin, throw, angle, spec.side)
                for name in names:
                    found[name][own] = VALUES[name](design_values) if name in VALUES else MOTION[name](law.peaks(), TURN / spec.pins, angle)
        return found

    return evaluate


def _law(spec: IndexerSpec, changed: Mapping[str, float]) -> MotionLaw | None:
    """The motion law with the parameters of a design; None where they make none."""
    given = {key: getattr(spec.motion, key) for key in LAW.values() if getattr(spec.motion, key) is not None}
    try:
        found = motion.law(law_name(spec), **(given | dict(changed)))
    except InputError:
        return None
    return found if found.continuity >= 1 or found.name == "uniform" else None


def _motion_angle(spec: IndexerSpec, ratios: Floats | None, own: Bools) -> Floats:
    """Input angle of the step [rad] of each of the designs."""
    given = spec.motion.motion_to_dwell
    if law_name(spec) == "uniform" or (ratios is None and given == NO_DWELL):
        return np.full(int(np.sum(own)), TURN)
    ratio = ratios[own] if ratios is not None else np.full(int(np.sum(own)), 1.0 if given is None else given)
    return TURN * ratio / (1 + ratio)
