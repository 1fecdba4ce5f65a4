"""What a link weighs, and what the strands pull with."""

import numpy as np

from drivewright.chains import standards
from drivewright.chains.plate import LinkMass, bar_link_mass, mean_link_mass
from drivewright.errors import InputError
from drivewright.mechanisms.silent_chain.build import ChainModel


def strand_force(model: ChainModel) -> float:
    """Of the tight strand: half the preload along it, half the load's pull, and the centrifugal force of the chain [N]."""
    tight, _ = pulls(model)
    return tight + centrifugal(model)


def centrifugal(model: ChainModel) -> float:
    """Mass per length times speed squared [N]."""
    return float(standards.centrifugal_tension(link_of(model).mass / model.link.pitch, chain_speed(model)))


def chain_speed(model: ChainModel) -> float:
    """Mean speed of the chain [m/s]."""
    return standards.chain_speed(model.link.pitch, model.teeth[0], model.drive.speed)


def pulls(model: ChainModel) -> tuple[float, float]:
    """Of the tight and of the slack strand [N], without the centrifugal force."""
    drive = model.drive
    return standards.strand_pulls(drive.preload, drive.load_torque, model.link.pitch, model.teeth[1], slope(model))


def slope(model: ChainModel) -> float:
    """Cosine of the angle of the strands to the line of centres, by pitch circles; 1 where there are none."""
    z1, z2 = model.teeth
    try:
        distance = standards.centre_distance(model.link.pitch, z1, z2, model.spec.links)
    except InputError:
        return 1.0
    return float(np.cos(standards.strand_angle(model.link.pitch, z1, z2, distance)))


def link_of(model: ChainModel) -> LinkMass:
    """`LinkMass` of a pitch of chain: mass [kg], height of its centre [m], inertia [kg m^2]."""
    given = model.spec.plate
    density, width = model.spec.material.density, model.chain_width
    if model.spec.roller or model.plate_refusal:
        drawn = bar_link_mass(model.spec.pitch, density, width)
    else:
        drawn = mean_link_mass(model.plate, given.lacing, density, width)
    mass = given.link_mass or drawn.mass
    return LinkMass(mass, drawn.height, given.link_inertia or drawn.inertia * mass / drawn.mass)
