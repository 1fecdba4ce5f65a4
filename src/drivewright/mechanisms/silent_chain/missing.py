"""Why an analysis is left out: what the spec lacks for it, or bodies that cannot be."""

from collections.abc import Callable
from functools import wraps

from drivewright.errors import InputError, SpecError
from drivewright.mechanisms.silent_chain.build import ChainModel
from drivewright.mechanisms.silent_chain.spec import PAIRS, SilentChainSpec, size_of
from drivewright.result import Answer, Answers


def no_meshing(spec: SilentChainSpec) -> str | None:
    """Why there are no measures of the published method."""
    if spec.joint.kind in PAIRS:
        return "the published method has pins of one radius"
    return "the published method is for chains whose plates mesh, not for rollers" if spec.meshes_rollers else None


def no_closure(spec: SilentChainSpec) -> str | None:
    """Why there is no closure."""
    if not (spec.sprockets or any(guide.force is not None for guide in spec.guides)):
        return None
    if spec.drive is None:
        return "speed and loads are not given, by which tensioners find their place: write [drive]"
    if spec.joint.kind in PAIRS:
        return "around tensioners and further sprockets it knows joints of two equal radii"
    return "around tensioners and further sprockets it knows one row, or rows in phase" if spec.row_phase else None


def no_phase_map(spec: SilentChainSpec) -> str | None:
    """Why there is no phase map."""
    if spec.joint.kind in PAIRS:
        return "it compares joints of two equal radii"
    return "it is for two sprockets" if spec.sprockets else None


def no_contact(spec: SilentChainSpec) -> str | None:
    """Why there are no stresses of the pins."""
    return None if spec.drive or spec.contact.force else "no force is known: write [drive], or [contact] force"


def no_trade_off(spec: SilentChainSpec) -> str | None:
    """Why there is no trade-off over the rolling radius."""
    if _hinged(spec):
        return "a revolute joint has no rolling radius to compare"
    return no_phase_map(spec) or no_contact(spec)


def no_dynamics(spec: SilentChainSpec) -> str | None:
    """Why there is no running chain."""
    if spec.joint.kind in PAIRS:
        return (
            "the joints of the moving chain turn by the mean of their plates' angles, as two equal radii roll. Take round pins of twice "
            "the effective radius (joint.effective_radius), which move alike to second order in the angles"
        )
    if spec.row_phase:
        return (
            "two rows out of phase are two chains on common shafts, and the moving chain is one. closure tells what their phase does at "
            "rest; take row_phase = 0 for the motion of rows in phase"
        )
    return no_drive(spec)


def no_drive(spec: SilentChainSpec) -> str | None:
    """Why there are no forces of the strands."""
    return None if spec.drive else "speed and preload are not given: write [drive]"


def no_stress(spec: SilentChainSpec) -> str | None:
    """Why there is no stress of the plates."""
    return "it is for plates of silent chains" if spec.meshes_rollers else no_phase_map(spec) or no_dynamics(spec)


def no_solid_stress(spec: SilentChainSpec) -> str | None:
    """Why there is no contact of plate and pins as solids."""
    if _hinged(spec):
        return "it is for joints whose two pins roll on each other"
    return no_stress(spec)


def no_wear(spec: SilentChainSpec) -> str | None:
    """Why there is no elongation by wear."""
    if spec.wear is None:
        return "nothing is known of its wear: write [wear] with a coefficient or its range"
    if not _hinged(spec):
        return "pins that roll on each other do not slide: Archard's law knows no wear of theirs"
    return no_closure(spec) or no_drive(spec)


def no_rating(spec: SilentChainSpec) -> str | None:
    """Why there is no power rating."""
    size = size_of(spec)
    if spec.rating.rated_power is None and not (size and size.ansi):
        return "no rating is known: give rating.rated_power of the maker, or an American chain by its number, which has formulas"
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
            return Answer(findings=(f"{answer.__name__.replace('_', ' ')} is left out: {impossible}",), outcome="left out")

    return guarded
