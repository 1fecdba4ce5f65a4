"""Indexing drives: profiles cut by the pins of a wheel, contacts, play, torsional stiffness; roller gears; torsion tests."""

from importlib import import_module

# Their modules hold kernels, and the first kernel imports numba: loaded when first used.
_MODULES = ("roller_gear", "torsion_test")
_WHERE = {
    "contacts": ("CamContacts",),
    "motion": ("IndexMotion", "index_motion"),
    "plane": ("PlaneDrive", "find_contacts", "pitch_point"),
    "pin_wheel": ("PinWheel",),
    "parallel": ("ParallelIndexer",),
    "play": ("find_play",),
    "drivetrain": ("Drivetrain", "GearMesh", "PinContact", "PowerLawBearing", "SplitShaft", "pin_contact", "power_law_bearing"),
    "stiffness": ("TorsionalStiffness", "solve_torsional_stiffness"),
    "batch": ("evaluate_pin_wheels",),
}
_MODULE = {name: module for module, names in _WHERE.items() for name in names}

__all__ = [*_MODULE, *_MODULES]


def __getattr__(name: str) -> object:
    if name in _MODULES:
        return import_module(f"{__name__}.{name}")
    if name not in _MODULE:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_MODULE[name]}"), name)
