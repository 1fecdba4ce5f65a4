"""Indexing drives: profiles cut by the pins of a wheel, contacts, play, torsional stiffness; roller gears; torsion tests."""

from importlib import import_module

from drivewright.indexing.contacts import Contacts
from drivewright.indexing.motion import NO_DWELL, IndexMotion, index_motion

# Their modules hold kernels, and the first kernel imports numba: loaded when first used.
_WHERE = {
    "pin_wheel": ("PinWheel",),
    "parallel": ("ParallelIndexer",),
    "drivetrain": ("Drivetrain", "GearMesh", "PinContact", "PowerBearing", "SplitShaft", "pin_contact", "power_bearing"),
}
_MODULES = ("plane", "play", "roller_gear", "stiffness", "torsion_test")
_MODULE = {name: module for module, names in _WHERE.items() for name in names}

__all__ = ["Contacts", "IndexMotion", "NO_DWELL", "index_motion", *_MODULE, *_MODULES]


def __getattr__(name):
    if name in _MODULES:
        return import_module(f"{__name__}.{name}")
    if name not in _MODULE:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_MODULE[name]}"), name)
