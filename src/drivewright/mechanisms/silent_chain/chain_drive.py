"""The drive as a moving system: masses, stiffnesses, sprockets, guides; from the spec, in SI."""

from collections.abc import Callable
from typing import Any

import numpy as np

from drivewright.chains import masses
from drivewright.chains.explicit.simulate import kernel_of_steps
from drivewright.chains.explicit.warm import small_drive
from drivewright.chains.model import Chain, ChainContact, ChainDrive, Guide, Slide, SpeedRamp, Sprocket
from drivewright.chains.standards import pitch_diameter
from drivewright.mechanisms.silent_chain import spec as tables
from drivewright.mechanisms.silent_chain.build import ChainModel
from drivewright.mechanisms.silent_chain.spec import SilentChainSpec


def chain_drive(model: ChainModel) -> ChainDrive:
    """The `ChainDrive` for any solver of its motion."""
    spec = model.spec
    given, stiffness = spec.contact.damping, model.contact_stiffness
    damping = spec.contact.joint_damping * stiffness if given is None else model.rows * given
    touch = ChainContact(stiffness, damping, spec.contact.law)
    driven = [_driven(model, touch), *(_further(model, each, touch) for each in spec.sprockets)]
    guides = tuple(_guide(model, each, touch) for each in spec.guides)
    return ChainDrive(_chain(model), (_driver(model, touch), *driven), guides, model.drive.gravity)


def compile_ahead(spec: SilentChainSpec) -> list[Callable[[], object]]:
    """What compiles the kernel that a run of this spec comes to last: that of the steps of the running chain."""
    explicit = spec.drive is not None and spec.dynamics.integrator == "explicit"
    return [kernel_of_steps(small_drive(spec.contact.law))] if explicit else []


def _chain(model: ChainModel) -> Chain:
    spec, mass = model.spec, model.link_mass
    toe, crotch = np.inf, -np.inf
    if not spec.roller and not model.plate_refusal:
        toe, crotch = (-height for height in model.plate.flank_heights)
    given = spec.contact.articulation_damping_ratio
    ratio = masses.usual_articulation_ratio(model.link.radius) if given is None else given
    return Chain(
        model.link,
        spec.links,
        mass.mass,
        mass.inertia,
        masses.joint_stiffness(model.contact_stiffness),
        spec.contact.joint_damping,
        centre_offset=mass.height,
        toe=toe,
        crotch=crotch,
        elongation=model.elongation,
        articulation_damping=masses.articulation_damping(ratio, model.strands.tension, model.link.hole_pitch, mass.inertia),
    )


def _driver(model: ChainModel, touch: ChainContact) -> Sprocket:
    speed, ramp = model.drive.speed, model.drive.ramp
    return Sprocket(contact=touch, drive=SpeedRamp(-speed, 0.0 if ramp else -speed, ramp), **_teeth(model, model.sprockets[0]))


def _driven(model: ChainModel, touch: ChainContact) -> Sprocket:
    """On its slide or fixed; its load resists changes of speed about the nominal one."""
    given, drive, teeth = model.spec.driven, model.drive, model.teeth[1]
    disc, fixed, ratio = _disc(model, given, teeth), given.centre_distance, given.damping_ratio
    stiffness = masses.strands_stiffness(masses.joint_stiffness(model.contact_stiffness), model.closure.free_plates)
    slide = None if fixed else Slide(0.0, drive.preload, damping=masses.strand_damping(ratio, stiffness, disc.mass))
    turning = 0.0 if drive.ramp else masses.strand_damping(ratio, stiffness, disc.inertia, _pitch_radius(model, teeth))
    return Sprocket(
        contact=touch,
        centre=(fixed or model.closure.mean, 0.0),
        torque=drive.load_torque,
        damping=turning,
        reference_speed=-drive.speed * model.teeth[0] / teeth,
        slide=slide,
        **disc._asdict(),
        **_teeth(model, model.sprockets[1]),
    )


def _further(model: ChainModel, given: tables.Sprocket, touch: ChainContact) -> Sprocket:
    """A sprocket that the chain passes besides, with teeth that fit."""
    disc, teeth = _disc(model, given, given.teeth)._asdict(), _teeth(model, model.sprocket(given.teeth))
    return Sprocket(contact=touch, centre=given.centre, torque=given.load_torque, **disc, **teeth)


def _guide(model: ChainModel, given: tables.Guide, touch: ChainContact) -> Guide:
    """A rail, or a tensioner on a slide, against the backs or the toes."""
    if model.roller_link:
        distance = model.roller_link.end_radius
    else:
        distance = model.plate.back if given.side == "outside" else -model.plate.toe
    slide = None
    if given.force is not None:
        direction = given.direction if given.direction is not None else 0.0
        slide = Slide(direction, given.force, given.stiffness, given.damping)
    return Guide(
        given.centre, given.radius, given.start, given.end, given.side, distance, touch, given.friction, mass=given.mass, slide=slide
    )


def _teeth(model: ChainModel, wheel: Any) -> dict[str, Any]:
    """What meshes of a sprocket, thicker by what is said."""
    return masses.meshing_tooth(wheel, model.spec.dynamics.thickness_deviation)._asdict()


def _disc(model: ChainModel, given: tables.Driven | tables.Sprocket, teeth: int) -> masses.Disc:
    """Mass [kg] and inertia [kg m^2], as given or of a disc as large as the pitch circle and as wide as the chain."""
    radius, hole, density = _pitch_radius(model, teeth), 0.5 * model.bore, model.spec.material.density
    return masses.sprocket_disc(radius, hole, model.chain_width, density, given.mass, given.inertia)


def _pitch_radius(model: ChainModel, teeth: int) -> float:
    return float(0.5 * pitch_diameter(model.spec.pitch, teeth))
