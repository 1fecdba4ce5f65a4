"""Many chains at once: the published method, and the layout's closed forms, with arrays in the place of the spec's numbers."""

from collections.abc import Callable, Sequence
from functools import partial

import numpy as np

from drivewright._typing import Floats
from drivewright.chains import standards
from drivewright.mechanisms.silent_chain.build import SIDES, build
from drivewright.mechanisms.silent_chain.layout import side_measures, teeth_checks
from drivewright.mechanisms.silent_chain.meshing import measures, offset_checks, seated_measures
from drivewright.mechanisms.silent_chain.spec import LEAST_TEETH, PAIRS, SilentChainSpec
from drivewright.spec import value_at
from drivewright.spec.designs import evaluator, within_limits

KEYS = (
    "pitch",
    "links",
    "teeth.0",
    "teeth.1",
    "joint.rolling_radius",
    "joint.offset",
    "plate.flank_angle",
    "plate.apothem",
    "plate.standard_apothem",
    "cutter.half_angle",
    "cutter.pitch",
    "drive.speed",
    "drive.preload",
    "drive.load_torque",
)


def batch(spec: SilentChainSpec, keys: Sequence[str], names: Sequence[str]) -> Callable[[Floats], dict[str, Floats]] | None:
    """designs (n, d) -> {name: (n,)}; None where a key or a value is beyond it, which then runs one by one.

    A design that the spec refuses, or for which one of the values asked for does not exist, is nan in every name.
    """
    if (
        spec.meshes_rollers
        or spec.joint.kind in PAIRS
        or not set(keys) <= set(KEYS)
        or (spec.drive is None and any(key.startswith("drive.") for key in keys))
    ):
        return None
    return evaluator(spec, keys, names, _quantities, partial(_possible, spec))


def _possible(spec, columns, count):
    """Which designs the spec accepts: the limits of each field, and what it asks of teeth and links."""
    good = within_limits(type(spec), columns, count)
    links, first, second = (columns.get(key, value_at(spec, key)) for key in ("links", "teeth.0", "teeth.1"))
    return good & (np.minimum(first, second) >= LEAST_TEETH) & (links > np.maximum(first, second))


def _quantities(spec):
    """Name -> numbers of everything there is: values of `meshing`, closed forms of `layout`, margins of the checks of both."""
    with np.errstate(all="ignore"):  # what is beyond the floats is not finite, and becomes nan
        model = build(spec)
        values = measures(model)
        for number, side in enumerate(SIDES):
            values |= seated_measures(model, side, number) | dict(side_measures(model, side, number))
        return {name: np.asarray(measure.number) for name, measure in values.items()} | _pair(model.spec) | dict(_margins(model))


def _pair(spec):
    """The closed forms of a layout of two sprockets; nan where the chain does not reach around them."""
    if spec.sprockets:
        return {}
    pitch, (z1, z2) = spec.pitch, spec.teeth
    touching = 0.5 * (standards.pitch_diameter(1.0, z1) + standards.pitch_diameter(1.0, z2)) * (1 + 1e-12)  # as `centre_distance` asks
    reaches = np.where(spec.links >= standards.chain_links(1.0, z1, z2, touching), 1.0, np.nan)
    forms = {"layout.chain_length": spec.links * pitch}
    if spec.drive:
        forms["layout.mesh_frequency"] = standards.mesh_frequency(z1, spec.drive.speed)
        forms["layout.meeting_velocity"] = standards.meeting_velocity(pitch, spec.drive.speed)
    return {name: reaches * value for name, value in forms.items()}


def _margins(model):
    """check.NAME -> margin of each check, at least 0 exactly where it passes."""
    for check in (*teeth_checks(model), *offset_checks(model)):
        yield f"check.{check.name}", np.asarray(check.counted_margin)
