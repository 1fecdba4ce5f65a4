"""The drive as a moving system: masses, stiffnesses, sprockets, guides; from the spec, in SI."""

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from drivewright.chains import masses
from drivewright.chains.explicit.simulate import kernel_of_steps
from drivewright.chains.explicit.warm import small_drive
from drivewright.chains.model import Chain, ChainContact, ChainDrive, Guide, Slide, SpeedRamp, Sprocket
from drivewright.chains.standards import pitch_diameter
from drivewright.mechanisms.silent_chain import spec as tables
from drivewright.mechanisms.silent_chain.spec import SilentChainSpec

if TYPE_CHECKING:
    from drivewright.mechanisms.silent_chain.build import ChainModel


def chain_drive(model: "ChainModel") -> ChainDrive:
    """The `ChainDrive` for any solver of its motion."""
    spec, bare = model.spec, bare_drive(model)
    given = spec.contact.articulation_damping_ratio
    ratio = masses.usual_articulation_ratio(model.link.radius) if given is None else given
    damping = masses.articulation_damping(ratio, model.strands.tension, model.link.hole_pitch, model.link_mass.inertia)
    return replace(bare, chain=replace(bare.chain, articulation_damping=damping))


def bare_drive(model: "ChainModel", new: bool = False) -> ChainDrive:
    """The same before its tension is known, which the damping of its articulation goes by; `new`: without the wear of its running time."""
    spec = model.spec
    given, stiffness = spec.contact.damping, model.contact_stiffness
    damping = spec.contact.joint_damping * stiffness if given is None else model.rows * given
    touch = ChainContact(stiffness, damping, spec.contact.law)
    driven = [_driven(model, touch), *(_further(model, each, touch) for each in spec.sprockets)]
    guides = tuple(_guide(model, each, touch) for each in spec.guides)
    return ChainDrive(_chain(model, new), (_driver(model, touch), *driven), guides, model.drive.gravity)


def compile_ahead(spec: SilentChainSpec) -> list[Callable[[], object]]:
    """What compiles the kernel that a run of this spec comes to last: that of the steps of the running chain."""
    explicit = spec.drive is not None and spec.dynamics.integrator == "explicit"
    return [kernel_of_steps(small_drive(spec.contact.law))] if explicit else []


def _chain(model: "ChainModel", new: bool) -> Chain:
    spec, mass = model.spec, model.link_mass
    toe, crotch = np.inf, -np.inf
    if not spec.roller and not model.plate_refusal:
        toe, crotch = (-height for height in model.plate.flank_heights)
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
        elongation=spec.closure.elongation if new else model.elongation,
    )


def _driver(model: "ChainModel", touch: ChainContact) -> Sprocket:
    speed, ramp = model.drive.speed, model.drive.ramp
    return Sprocket(contact=touch, drive=SpeedRamp(-speed, 0.0 if ramp else -speed, ramp), **_teeth(model, model.sprockets[0]))


def _driven(model: "ChainModel", touch: ChainContact) -> Sprocket:
    """On its slide or fixed; its load resists changes of speed about the nominal one."""
    given, drive, teeth = model.spec.driven, model.drive, model.teeth[1]
    disc, fixed, ratio = _disc(model, given, teeth), given.centre_distance, given.damping_ratio
    stiffness = masses.strands_stiffness(masses.joint_stiffness(model.contact_stiffness), model.free_plates)
    slide = None if fixed else Slide(0.0, model.preload, damping=masses.strand_damping(ratio, stiffness, disc.mass))
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


def _further(model: "ChainModel", given: tables.Sprocket, touch: ChainContact) -> Sprocket:
    """A sprocket that the chain passes besides, with teeth that fit."""
    disc, teeth = _disc(model, given, given.teeth)._asdict(), _teeth(model, model.sprocket(given.teeth))
    outside = given.side == "outside"
    torque = -given.load_torque if outside else given.load_torque  # against its own sense of rotation
    slide = _slide(given, given.centre, None)
    return Sprocket(contact=touch, centre=given.centre, torque=torque, slide=slide, outside=outside, name=given.name, **disc, **teeth)


def _slide(given: tables.Sprocket | tables.Guide, centre: tuple[float, float], lever: float | None) -> Slide | None:
    """Slide or pivot of a tensioner; None of what is fixed.  Outward along it the spring presses on the chain."""
    if given.force is None:
        return None
    travel = (-np.inf, np.inf) if given.travel is None else (-given.travel, given.travel)
    spring = {"force": given.force, "stiffness": given.stiffness, "damping": given.damping, "travel": travel}
    if given.pivot is None:
        return Slide(given.direction or 0.0, **spring)
    arm = complex(*centre) - complex(*given.pivot)
    sense = 1.0 if (1j * arm * np.exp(-1j * (given.direction or 0.0))).real >= 0 else -1.0
    return Slide(0.0, pivot=given.pivot, lever=sense * (lever or abs(arm)), **spring)


def _guide(model: "ChainModel", given: tables.Guide, touch: ChainContact) -> Guide:
    """A rail, or a tensioner on a slide, against the backs or the toes."""
    if model.roller_link:
        distance = model.roller_link.end_radius
    else:
        distance = model.plate.back if given.side == "outside" else -model.plate.toe
    middle = complex(*given.centre) + given.radius * np.exp(0.5j * (given.start + given.end))
    lever = given.lever or (abs(middle - complex(*given.pivot)) if given.pivot else None)
    arc = (given.centre, given.radius, given.start, given.end, given.side)
    slide = _slide(given, given.centre, lever)
    return Guide(*arc, distance, touch, given.friction, mass=given.mass, slide=slide, name=given.name)


def _teeth(model: "ChainModel", wheel: Any) -> dict[str, Any]:
    """The meshing part of a sprocket, thicker by the given amount."""
    return masses.meshing_tooth(wheel, model.spec.dynamics.thickness_deviation)._asdict()


def _disc(model: "ChainModel", given: tables.Driven | tables.Sprocket, teeth: int) -> masses.Disc:
    """Mass [kg] and inertia [kg m^2], as given or of a disc as large as the pitch circle and as wide as the chain."""
    radius, hole, density = _pitch_radius(model, teeth), 0.5 * model.bore, model.spec.material.density
    return masses.sprocket_disc(radius, hole, model.chain_width, density, given.mass, given.inertia)


def _pitch_radius(model: "ChainModel", teeth: int) -> float:
    return float(0.5 * pitch_diameter(model.spec.pitch, teeth))
