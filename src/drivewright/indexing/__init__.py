"""Indexing drives: profiles cut by the pins of a wheel, contacts, play, torsional stiffness; roller gears; torsion tests.

motion          the wheel's angle over the input's: step and dwell
plane           plate cams and pins: paths, trimmed profiles, contacts, pitch point
pin_wheel       cams on cranks inside or around the pins
parallel        two plate cams on the input shaft
body_compliance what cam, pin and wheel yield under one contact alone
contacts        contacts of one cam with the pins at one position
play            free rotation of the wheel
pin_pressure    Hertz pressure of a pin, the contact that resists a torque best
cam_tables      profile, contacts and pressure angles as tables
values          motion, profile, contacts and play as values and findings
drive_torque    torque at the input for a table with inertia and friction
drawing         outlines, poses and common normals of plate cams
plate_views     scene, drawings and solids of drives with plate cams
drivetrain      what yields: pins, bearings, split shafts, gears, wheel
stiffness/      torsional stiffness, forces of pins and bearings, statics
solid/          the same with cams, shafts and wheel as solids in contact (extra `fe`)
batch/          many pin wheels at once in compiled code
geneva/         external Geneva drives: step, wheel and locking disc, clearance, forces
roller_gear/    barrel and globoidal cams: flanks, trimming, play, stress, tables, scene, solids
torsion_test/   evaluation of measured loops of torque and angle
"""

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
    "stiffness": ("TorsionalStiffness", "WheelStiffness", "solve_torsional_stiffness"),
    "stiffness.roller_drive": ("RollerDrive",),
    "stiffness.roller_loading": ("LoadedRollers", "solve_rollers"),
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
