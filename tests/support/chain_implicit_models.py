"""Drives that the tests of the implicit route share."""

from dataclasses import replace

import numpy as np

from drivewright.chains.explicit.assembly import start
from drivewright.chains.link import design_link, seat_support
from drivewright.chains.model import Chain, ChainContact, ChainDrive, Guide, Slide, SpeedRamp, Sprocket, with_sprocket
from drivewright.chains.roller_tooth import RollerTooth
from drivewright.chains.tooth import Tooth

PITCH = 9.525e-3
FLANK = np.pi / 6


def drive(
    radius=1.2e-3,
    teeth=(35, 37),
    links=82,
    stiffness=1e9,
    joint=None,
    force=150.0,
    apothem=2.6e-3,
    speed=-200.0,
    damping=0.0,
    beta=2e-6,
    offset=0.0,
    gravity=(0.0, 0.0),
    torque=0.0,
    **chain,
):
    """The drive of the paper, masses assumed; both strands at force/2."""
    joined = design_link(PITCH, radius, FLANK, apothem)
    involutes = [Tooth(z, 0.5 * PITCH * z / np.pi * np.cos(FLANK), seat_support(joined, z)) for z in teeth]
    tips = [0.5 * PITCH / np.sin(np.pi / z) - 0.9e-3 for z in teeth]
    mass = 2.5e-3
    plates = Chain(joined, links, mass, mass * (15e-3**2 + 9e-3**2) / 12, stiffness if joint is None else joint, beta, offset, **chain)
    contact, centre = ChainContact(stiffness, damping), (0.5 * (links - sum(teeth) / 2) * PITCH, 0.0)
    first = Sprocket(involutes[0], contact, angle=0.0, tip_radius=tips[0], drive=SpeedRamp(speed, speed))
    second = Sprocket(
        involutes[1],
        contact,
        centre,
        None,
        tips[1],
        mass=0.6,
        inertia=0.3 * tips[1] ** 2,
        torque=torque,
        slide=Slide(0.0, force, 0.0, 100.0),
    )
    return ChainDrive(plates, (first, second), (), gravity)


def small(**changes):
    """Nine and ten teeth, 24 plates with the mass centre off the pins."""
    return drive(**({"teeth": (9, 10), "links": 24, "apothem": -0.5e-3, "offset": 0.5e-3, "speed": -60.0} | changes))


def with_guides(model):
    """A guide on the back and a sliding one on the belly of plates of both strands, pressed in by 20 um."""
    for _ in range(2):  # with guides the chain starts a little slack, so they are placed once more
        begin = start(model)
        places = (begin.seated[0][-1] + 3, "outside"), (begin.seated[1][-1] + 2, "inside")
        model = replace(model, guides=tuple(_guide(begin.poses[number], side) for number, side in places))
    return model


def _guide(pose, side):
    out = np.array([-np.sin(pose[2]), np.cos(pose[2])]) * (1 if side == "outside" else -1)
    polar = np.arctan2(-out[1], -out[0])
    return Guide(
        tuple(pose[:2] + out * (80e-3 + 1.2e-3 - 2e-5)),
        80e-3,
        polar - 0.06,
        polar + 0.06,
        side,
        1.2e-3,
        ChainContact(1e7),
        0.3,
        0.05,
        mass=0.1,
        slide=Slide(0.9, 3.0, 1e3, 2.0),
    )


def with_rollers(**changes):
    """The small drive as a roller chain."""
    model = small(radius=0.0, **changes)
    sprockets = []
    for sprocket in model.sprockets:
        z = sprocket.tooth.teeth
        tooth = RollerTooth(z, 0.5 * PITCH / np.sin(np.pi / z), 3.2e-3, 2.2, 8e-3, 3.17e-3)
        sprockets.append(replace(sprocket, tooth=tooth, tip_radius=tooth.pitch_radius + 2e-3))
    return replace(model, sprockets=tuple(sprockets))


def thickened(model, number, thickness):
    """The model with every flank of one sprocket standing out by `thickness` [m], against the plates."""
    tooth = model.sprockets[number].tooth
    return with_sprocket(model, number, tooth=tooth._replace(support=tooth.support - thickness))
