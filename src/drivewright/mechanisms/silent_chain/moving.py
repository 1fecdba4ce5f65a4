"""The drive as a moving system: masses, stiffnesses, sprockets, guides; from the spec, in SI."""

import numpy as np

from drivewright.chains.link import seat_support
from drivewright.chains.model import Chain, ChainContact, ChainDrive, Guide, Slide, SpeedRamp, Sprocket
from drivewright.chains.roller_sprocket import design_roller_sprocket
from drivewright.chains.standards import pitch_diameter
from drivewright.chains.tooth import Tooth
from drivewright.mechanisms.silent_chain.build import ChainModel
from drivewright.mechanisms.silent_chain.strands import link_of, strand_force

ROLLING, HINGED = 0.003, 0.02  # articulation damping over critical: little more than steel itself has, and with a pin that slides
IN_LINE = 3  # plate on pin, pin on pin, pin on plate: contacts that make a joint


def moving(model: ChainModel) -> ChainDrive:
    """The `ChainDrive` for any solver of its motion."""
    spec = model.spec
    damping = spec.contact.joint_damping * spec.contact.stiffness if spec.contact.damping is None else spec.contact.damping
    touch = ChainContact(spec.contact.stiffness, damping, spec.contact.law)
    driven = [_driven(model, touch), *(_further(model, each, touch) for each in spec.sprockets)]
    guides = tuple(_guide(model, each, touch) for each in spec.guides)
    return ChainDrive(_chain(model), (_driver(model, touch), *driven), guides, spec.drive.gravity)


def _chain(model):
    spec, found = model.spec, link_of(model)
    flank = {}
    if not spec.roller and not model.undrawn:
        heights = np.sort([model.plate.flank("right").start[1], model.plate.flank("right").end[1]])
        flank = {"toe": -float(heights[0]), "crotch": -float(heights[1])}
    return Chain(
        model.link,
        spec.links,
        found.mass,
        found.inertia,
        spec.contact.stiffness / IN_LINE,
        spec.contact.joint_damping,
        centre_offset=found.height,
        elongation=spec.closure.elongation,
        articulation_damping=_articulation(model, found),
        **flank,
    )


def _articulation(model, found):
    """Damping of a joint against the turning of its plates [N m s].

    A plate of inertia I between joints that stand still rocks under the force T of the strand with the stiffness T A, A from pin to pin;
    both its joints damp it, with 2 c: c = ratio sqrt(T A I).
    """
    given = model.spec.contact.articulation_damping_ratio
    ratio = (ROLLING if model.link.radius else HINGED) if given is None else given
    return ratio * np.sqrt(strand_force(model) * model.link.hole_pitch * found.inertia)


def _driver(model, touch):
    speed = model.spec.drive.speed
    start = 0.0 if model.spec.drive.ramp else -speed
    return Sprocket(_tooth(model, 0), touch, drive=SpeedRamp(-speed, start, model.spec.drive.ramp), **_active(model, 0))


def _driven(model, touch):
    """On its slide or fixed; its load resists changes of speed about the nominal one."""
    spec, given = model.spec, model.spec.driven
    mass = given.mass or _disc(model, model.teeth[1])
    inertia, fixed = given.inertia or _inertia(model, mass, model.teeth[1]), given.centre_distance
    stiffness, ratio = _strands(model), given.damping_ratio
    slide = None if fixed else Slide(0.0, spec.drive.preload, damping=2 * ratio * np.sqrt(stiffness * mass))
    turning = 0.0 if spec.drive.ramp else 2 * ratio * _pitch_radius(model, model.teeth[1]) * np.sqrt(stiffness * inertia)
    nominal = -spec.drive.speed * model.teeth[0] / model.teeth[1]
    return Sprocket(
        _tooth(model, 1),
        touch,
        (fixed or model.closure.mean, 0.0),
        mass=mass,
        inertia=inertia,
        torque=spec.drive.load_torque,
        damping=turning,
        reference_speed=nominal,
        slide=slide,
        **_active(model, 1),
    )


def _strands(model):
    """Stiffness of the slide [N/m]: both strands, their joints one behind the other."""
    free = 0.5 * (model.spec.links - np.mean(np.sum(model.closure.states.seated, axis=1)))
    return 2 * model.spec.contact.stiffness / IN_LINE / (free + 1)


def _tooth(model, number):
    """The driver's or driven tooth, thicker by what is said."""
    if model.spec.roller:
        return model.sprockets[number].tooth
    tooth = model.sides[number].tooth
    return tooth._replace(support=tooth.support - model.spec.dynamics.thickness_deviation)


def _active(model, number):
    """Radii between which the teeth are active."""
    if model.spec.roller:
        return {"tip_radius": model.sprockets[number].tip_radius}
    sprocket = model.sprockets[number]
    return {"tip_radius": sprocket.tip_radius - sprocket.tip_chamfer, "form_radius": sprocket.form_radius}


def _further(model, given, touch):
    """A sprocket that the chain passes besides, with teeth that fit."""
    mass = given.mass or _disc(model, given.teeth)
    inertia = given.inertia or _inertia(model, mass, given.teeth)
    if model.spec.roller:
        wheel = design_roller_sprocket(given.teeth, model.spec.pitch, model.spec.roller.diameter, model.spec.roller.tooth_space)
        active, tooth = {"tip_radius": wheel.tip_radius}, wheel.tooth
    else:
        base = 0.5 * model.cutter.module * given.teeth * np.cos(model.cutter.half_angle)
        wheel = model.sprocket(given.teeth, Tooth(given.teeth, base, seat_support(model.link, given.teeth)))
        tooth = wheel.tooth._replace(support=wheel.tooth.support - model.spec.dynamics.thickness_deviation)
        active = {"tip_radius": wheel.tip_radius - wheel.tip_chamfer, "form_radius": wheel.form_radius}
    return Sprocket(tooth, touch, given.centre, mass=mass, inertia=inertia, torque=given.load_torque, **active)


def _guide(model, given, touch):
    """A rail, or a tensioner on a slide, against the backs or the toes."""
    plate = None if model.spec.roller else model.plate
    distance = 0.45 * model.spec.pitch if plate is None else plate.back if given.side == "outside" else -plate.toe
    slide = None
    if given.force is not None:
        direction = given.direction if given.direction is not None else 0.0
        slide = Slide(direction, given.force, given.stiffness, given.damping)
    return Guide(
        given.centre, given.radius, given.start, given.end, given.side, distance, touch, given.friction, mass=given.mass, slide=slide
    )


def _pitch_radius(model, teeth):
    return 0.5 * pitch_diameter(model.spec.pitch, teeth)


def _disc(model, teeth):
    """Mass of a disc as large as the pitch circle and as wide as the chain [kg]."""
    radius = _pitch_radius(model, teeth)
    return np.pi * (radius**2 - _hole(model, radius) ** 2) * model.chain_width * model.spec.material.density


def _inertia(model, mass, teeth):
    """Of such a disc about its axis [kg m^2]."""
    radius = _pitch_radius(model, teeth)
    return 0.5 * mass * (radius**2 + _hole(model, radius) ** 2)


def _hole(model, radius):
    """Radius of the hole of a disc; none where it would leave no disc."""
    return 0.5 * model.bore if model.bore < 2 * radius else 0.0
