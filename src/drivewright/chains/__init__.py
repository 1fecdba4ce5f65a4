"""Chains: links and joints, teeth, meshing, closure around sprockets, motion, stress.

A chain drive is a `ChainDrive`; `simulate` runs it explicitly, `equilibrium` finds it at rest.

link             a link and its joint: pitch, rolling radius, flanks; seat on a sprocket
tooth            the involute tooth that a plate sits on, and the cutter that makes it
roller_tooth     the tooth of arcs that a roller sits on
model            the description of a drive: chain, sprockets, guides, contacts
meshing, published_design  the published method of silent chains: equivalent pitch, offset, modification; sprockets by it
standards        formulas of roller and silent chains: lengths, speeds, forces, ratings, sprockets
plate, plate_outline, plate_holes, plate_stack  the plate: outline, holes and pins, mass; a strand of plates as solids
sprocket, sprocket_root, roller_sprocket        sprockets with all their teeth, root trochoids, measuring pins
roller_link      the link of a roller chain: plate and roller
sizes            roller chains by their number: dimensions, mass, breaking load
drive_scene      a drive on screen and as solids: sprockets, plates, the rigid chain over teeth
interference     gaps between plates and teeth
masses           masses, stiffness and damping that nobody has measured: discs for sprockets, joints in line
touching         where flank, roller and guide touch: the geometry that explicit and implicit runs share
path             the taut path around sprockets and guides in any order, tensioners in balance
closure          the rigid chain around two sprockets: centre distance and transmission error over a tooth
explicit         simulation with short explicit steps, ensembles, batches over speed and scatter
implicit         equilibrium and simulation with implicit steps
plots            how the tables of chains are looked at
wear             elongation of a chain by wear of its hinges
stress           pins under pressure and bending, plates by finite elements, life
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
    "sizes": ("ChainSize", "chain_size"),
    "sprocket": ("design_sprocket",),
    "tooth": ("Cutter", "Tooth", "cut_tooth", "matching_cutter", "modification_for"),
}
_MODULE = {name: module for module, names in _WHERE.items() for name in names}

__all__ = sorted(_MODULE)


def __getattr__(name: str) -> Any:
    if name not in _MODULE:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_MODULE[name]}"), name)
