"""Multiaxial strain-life fatigue: material cards, rainflow counting, Neuber's rule, critical planes after Brown and Miller, life maps.

`material` cards and the uniform material law; `curves` strain over life and stress at a notch; `rainflow` counting cycles; `tensors`
stress and strain tensors; `yielding` Neuber's rule along a history; `critical` life of a block on its critical plane, and of many nodes;
`planes` damage on one plane; `search` the plane of the greatest damage, by `bounds` and by `climbing`;
`shear` the plane of the largest shear amplitude.
"""

from importlib import import_module
from typing import Any

# Most of their modules hold kernels, and the first kernel imports numba: loaded when first used.
_WHERE = {
    "critical": ("CriticalPlane", "LifeMap", "PlaneCycles", "brown_miller", "life_map"),
    "curves": ("NotchStress", "life_at_strain", "neuber", "ramberg_osgood", "strain_at_life"),
    "material": ("StrainLife", "life_text", "uniform_material_law"),
    "rainflow": ("Cycles", "cycles"),
    "tensors": ("elastic_strain", "plane_tensors", "superpose", "von_mises"),
    "yielding": ("neuber_history",),
}
_MODULE = {name: module for module, names in _WHERE.items() for name in names}

__all__ = sorted(_MODULE)


def __getattr__(name: str) -> Any:
    if name not in _MODULE:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_MODULE[name]}"), name)
