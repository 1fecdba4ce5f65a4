"""Chains: links and joints, teeth, meshing, closure around sprockets, motion, stress.

A chain drive is a `ChainDrive`; `simulate` runs it explicitly, `equilibrium` finds it at rest.  Steps of an implicit run are in
`chains.implicit`, formulas of standards in `chains.standards`, the published method of silent chains in `chains.meshing`, plates under
stress in `chains.stress`.
"""

from importlib import import_module
from typing import Any

# Loaded when first used: the runs hold kernels, and the first kernel imports numba.
_WHERE = {
    "closure.drive": ("Closure", "close", "phase_map"),
    "explicit.batch": ("campbell", "monte_carlo"),
    "explicit.ensemble": ("Ensemble",),
    "explicit.motion": ("Motion",),
    "explicit.simulate": ("Settings", "simulate", "tooth_time"),
    "implicit.equilibrium": ("Equilibrium", "compliance_of", "equilibrium"),
    "link": ("Link", "chordal_rise", "design_link", "seat_height", "seat_support"),
    "model": ("Chain", "ChainContact", "ChainDrive", "Guide", "Slide", "SpeedRamp", "Sprocket", "at_speed", "with_sprocket"),
    "plate": ("Plate", "design_plate", "link_mass"),
    "plate_holes": ("HingePin", "RockerPins", "RoundPins"),
    "roller_sprocket": ("RollerSprocket", "design_roller_sprocket"),
    "roller_tooth": ("RollerTooth",),
    "sprocket": ("design_sprocket",),
    "tooth": ("Cutter", "Tooth", "cut_tooth", "matching_cutter"),
}
_MODULE = {name: module for module, names in _WHERE.items() for name in names}

__all__ = sorted(_MODULE)


def __getattr__(name: str) -> Any:
    if name not in _MODULE:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_MODULE[name]}"), name)
