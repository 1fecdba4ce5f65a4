"""What a link weighs, and what the strands pull with."""

import numpy as np

from drivewright.chains import standards
from drivewright.chains.plate import LinkMass, link_mass
from drivewright.errors import InputError

ROUGH_PLATE = (1.86, 0.95)  # length and height of a plate that cannot be drawn, over the pitch; its area is a pitch squared


def strand_force(model):
    """Of the tight strand: half the preload along it, half the load's pull, and the centrifugal force of the chain [N]."""
    tight, _ = pulls(model)
    return tight + centrifugal(model)


def centrifugal(model):
    """Mass per length times speed squared [N]."""
    return standards.centrifugal_tension(link_of(model).mass / model.link.pitch, chain_speed(model))


def chain_speed(model):
    """Mean speed of the chain [m/s]."""
    return standards.chain_speed(model.link.pitch, model.teeth[0], model.spec.drive.speed)


def pulls(model):
    """Of the tight and of the slack strand [N], without the centrifugal force."""
    drive = model.spec.drive
    pull = drive.load_torque * 2 * np.pi / (model.teeth[1] * model.link.pitch)
    along = drive.preload / slope(model)
    return 0.5 * (along + pull), 0.5 * (along - pull)


def slope(model):
    """Cosine of the angle of the strands to the line of centres, by pitch circles; 1 where there are none."""
    try:
        distance = standards.centre_distance(model.link.pitch, *model.teeth, model.spec.links)
    except InputError:
        return 1.0
    return float(np.cos(standards.strand_angle(model.link.pitch, *model.teeth, distance)))


def link_of(model):
    """`LinkMass` of a pitch of chain: mass [kg], height of its centre [m], inertia [kg m^2]."""
    given = model.spec.plate
    drawn = _rough(model) if model.spec.roller or model.undrawn else _drawn(model)
    mass = given.link_mass or drawn.mass
    return LinkMass(mass, drawn.height, given.link_inertia or drawn.inertia * mass / drawn.mass)


def _drawn(model):
    """Mean of the two kinds of links in turn."""
    given, density = model.spec.plate, model.spec.material.density
    both = [link_mass(model.plate, plates, density, model.chain_width) for plates in given.lacing]
    return LinkMass(*(0.5 * sum(each) for each in zip(*both, strict=True)))


def _rough(model):
    """Bars of the outer measures of a plate, with a plate's area."""
    p, spec = model.spec.pitch, model.spec
    mass = spec.material.density * 0.5 * model.chain_width * p * p
    return LinkMass(mass, 0.0, mass * (ROUGH_PLATE[0] ** 2 + ROUGH_PLATE[1] ** 2) * p * p / 12)
