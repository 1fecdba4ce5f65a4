"""Why an analysis is left out: what the spec lacks for it, or an impossible geometry."""

from collections.abc import Callable
from functools import wraps

from drivewright.errors import InputError, SpecError
from drivewright.mechanisms.silent_chain.build import ChainModel
from drivewright.mechanisms.silent_chain.spec import PAIRS, SilentChainSpec, size_of
from drivewright.result import Answer, Answers


def no_meshing(spec: SilentChainSpec) -> str | None:
    """Why there are no measures of the published method."""
    if spec.joint.kind in PAIRS:
        return "the published method applies to pins of one radius"
    return "the published method applies to silent chains, not to roller chains" if spec.meshes_rollers else None


def no_closure(spec: SilentChainSpec) -> str | None:
    """Why there is no closure."""
    if not (spec.sprockets or any(guide.force is not None for guide in spec.guides)):
        return None
    if spec.drive is None:
        return "the positions of tensioners depend on speed and loads, which are not given; add [drive]"
    if spec.joint.kind in PAIRS:
        return "with tensioners or further sprockets it is available for joints of two equal radii only"
    return "with tensioners or further sprockets it is available for one row or for rows in phase only" if spec.row_phase else None


def no_phase_map(spec: SilentChainSpec) -> str | None:
    """Why there is no phase map."""
    if spec.joint.kind in PAIRS:
        return "it is available for joints of two equal radii only"
    return "it is available for two sprockets only" if spec.sprockets else None


def no_contact(spec: SilentChainSpec) -> str | None:
    """Why there are no stresses of the pins."""
    return None if spec.drive or spec.contact.force else "the force of the strand is not known; add [drive], or give contact.force"


def no_trade_off(spec: SilentChainSpec) -> str | None:
    """Why there is no trade-off over the rolling radius."""
    if _hinged(spec):
        return "a revolute joint has no rolling radius"
    return no_phase_map(spec) or no_contact(spec)


def no_dynamics(spec: SilentChainSpec) -> str | None:
    """Why there is no running chain."""
    if spec.joint.kind in PAIRS:
        return (
            "the dynamic model covers joints of two equal radii only. Take round pins of twice the effective radius "
            "(joint.effective_radius), whose motion agrees to second order in the articulation angles"
        )
    if spec.row_phase:
        return (
            "the dynamic model has one chain, and two rows out of phase are two chains on common shafts. The analysis 'closure' gives the "
            "effect of their phase on the rigid chain; take row_phase = 0 for the motion of rows in phase"
        )
    return no_drive(spec)


def no_drive(spec: SilentChainSpec) -> str | None:
    """Why there are no forces of the strands."""
    return None if spec.drive else "speed and preload are not given; add [drive]"


def no_stress(spec: SilentChainSpec) -> str | None:
    """Why there is no stress of the plates."""
    return "it is available for the plates of silent chains only" if spec.meshes_rollers else no_phase_map(spec) or no_dynamics(spec)


def no_solid_stress(spec: SilentChainSpec) -> str | None:
    """Why there is no contact of plate and pins as solids."""
    if _hinged(spec):
        return "it is available for rolling joints with two pins only"
    return no_stress(spec)


def no_wear(spec: SilentChainSpec) -> str | None:
    """Why there is no elongation by wear."""
    if spec.wear is None:
        return "no wear coefficient is given; add [wear] with coefficient or coefficient_range"
    if not _hinged(spec):
        return "pins that roll on each other do not slide, so that Archard's law gives no wear"
    return no_closure(spec) or no_drive(spec)


def no_rating(spec: SilentChainSpec) -> str | None:
    """Why there is no power rating."""
    size = size_of(spec)
    if spec.rating.rated_power is None and not (size and size.ansi):
        return "no rating is known; give rating.rated_power of the maker, or the number of an ANSI chain, for which ASME B29.1 has formulas"
    if spec.drive and not spec.drive.load_torque:
        return "no power is transmitted: drive.load_torque is 0"
    return no_closure(spec) or no_drive(spec)


def _hinged(spec: SilentChainSpec) -> bool:
    return (spec.joint.kind or ("revolute" if spec.chain else "")) == "revolute"


def unless_impossible(answer: Callable[[ChainModel, Answers], Answer]) -> Callable[[ChainModel, Answers], Answer]:
    """The analysis, left out with the reason where the bodies, the card or the place that it asks for cannot be."""

    @wraps(answer)
    def guarded(model: ChainModel, done: Answers) -> Answer:
        """Its answer, or why there is none."""
        try:
            return answer(model, done)
        except SpecError:  # it names the key to change
            raise
        except InputError as impossible:
            return Answer(findings=(f"analysis '{answer.__name__}' is left out: {impossible}",), outcome="left out")

    return guarded
