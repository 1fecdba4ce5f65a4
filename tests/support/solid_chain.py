"""The paper's plate with its pins as solids, coarsely meshed: condensed once for all tests of a process."""

from functools import cache

import numpy as np

from drivewright.chains.link import design_link
from drivewright.chains.plate import design_plate
from drivewright.chains.solid.history import solid_history
from drivewright.chains.solid.joint import Fit, Material, hat_widths, rolling_pins, stack_of
from drivewright.chains.solid.meshes import usual_sizes
from drivewright.chains.solid.pitch import forces_at, plate_and_pins
from drivewright.chains.stress.plate import Loads

STEEL = Material(206e9, 0.3)
FIT = Fit(2e-6, 50e-6)
PULL = 200.0  # N
COARSEST = 0.5


@cache
def plate():
    return design_plate(design_link(9.525e-3, 1.2e-3, np.radians(30), 2.6e-3))


@cache
def sizes(fineness=0.7):
    """Elements of a fineness, but usual ones in the crotch, where the plate bears most."""
    return usual_sizes(plate(), fineness)._replace(rounding=0.3)


def middle_of_flank():
    """Height [m] of the middle of the outer flanks."""
    return float(np.mean([point[1] for point in plate().flank("right")]))


@cache
def solid(modulus=STEEL.modulus, fineness=0.7, friction=0.0):
    """Plate and pins of a lacing 1 x 2 whose pins share their force evenly; two heights on each flank."""
    stack, height = stack_of(plate(), (1, 2)), middle_of_flank()
    shares = hat_widths(stack.end) / stack.end
    material = STEEL._replace(modulus=modulus)
    return plate_and_pins(
        plate(), stack, FIT._replace(friction=friction), material, shares, (height - 5e-4, height + 5e-4), sizes(fineness)
    )


def loads(pins, flanks=None, heights=None):
    """`Loads` of pins (n, 2, 2); no flank is pressed unless given."""
    pins = np.array(pins, float)
    none = np.zeros(pins.shape[:2])
    return Loads(pins, none if flanks is None else np.array(flanks, float), none if heights is None else np.array(heights, float))


def straight(*sizes_of_pull):
    """`Loads` of straight pulls [N], an instant each."""
    return loads([[[-size, 0.0], [size, 0.0]] for size in sizes_of_pull])


def no_gap(made):
    """Gaps of 0 at all hats: neither clearance nor what the two meshes leave between them."""
    return [np.zeros(len(each.gap)) for each in made.model.pairings]


def state_of(made, given, instant=0, gaps=None):
    """State of the contact under one instant of `Loads`."""
    return made.model.solve(forces_at(made, given, instant), gaps=gaps, narrow=True)


@cache
def pulled():
    """`SolidHistory` from rest to the pull, its half, and rest."""
    return solid_history(solid(), straight(0.0, PULL, PULL / 2, 0.0))


@cache
def rolling(lacing):
    """The joint under half the pull, no clearance: what is coarse is refused with one."""
    return rolling_pins(plate(), stack_of(plate(), lacing), Fit(0.0, 0.0), STEEL, PULL / 2, sizes())
