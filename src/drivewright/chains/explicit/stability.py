"""How long an explicit step may be, and whether seated plates touch at all.

Undamped, the leapfrog is stable for omega dt < 2.  Damping of rates predicted from the last acceleration makes that
omega^2 dt^2 + 4 gamma dt < 4, gamma = c/m: the step with which the fastest mode changes sign.
"""

import numpy as np

from drivewright.chains.link import seat_height
from drivewright.chains.model import ChainDrive
from drivewright.chains.tooth import Tooth
from drivewright.errors import InputError

STEP, SAFE = 1e-6, 0.5  # [s], and part of the largest stable step, that a run takes by default


def fastest(model: ChainDrive) -> tuple[float, float]:
    """(omega^2 [1/s^2], gamma [1/s]) of the stiffest plate, bounds from above.

    Joints: 4 k_j (1/m + a^2/I), every plate having two and every joint two plates, a half the hole pitch, and 4 c/I of their
    articulation; contacts: k on each flank of a plate and on the sprocket.
    """
    chain = model.chain
    arm = np.hypot(0.5 * np.max(chain.hole_pitches), chain.centre_offset)
    ease = 1 / chain.mass + arm**2 / chain.inertia
    touching = [_touch(body, ease) for body in (*model.sprockets, *model.guides)]
    joint = 4 * chain.joint_stiffness * ease
    articulation = 4 * chain.articulation_damping / chain.inertia
    return joint + max(k for k, _ in touching), chain.joint_damping * joint + articulation + max(c for _, c in touching)


def _touch(body, ease):
    """(omega^2, gamma) of two contacts of one plate with the body."""
    for_body = abs(body.slide.way(complex(*body.centre), 0.0)) ** 2 / body.mass if body.slide else 0.0
    inertia = getattr(body, "inertia", 0.0)
    if inertia and not getattr(body, "drive", None):
        for_body += (getattr(body.tooth, "base_radius", 0.0) or body.tooth.pitch_radius) ** 2 / inertia
    return tuple(2 * value * (ease + for_body) for value in (body.contact.stiffness, body.contact.damping))


def largest_step(model: ChainDrive) -> float:
    """Largest stable step [s]: 2 (sqrt(gamma^2 + omega^2) - gamma)/omega^2."""
    square, gamma = fastest(model)
    return 2 / (np.sqrt(gamma**2 + square) + gamma)


def refuse_step(model: ChainDrive, step: float) -> None:
    """InputError for a step beyond the stable one; it says whether damping makes it small."""
    largest = largest_step(model)
    if 0 < step <= largest:
        return
    square, gamma = fastest(model)
    damped = gamma / np.sqrt(square)
    reason = (
        f"the damping of joints or contacts is {damped:.3g} times critical; take that step, reduce the damping, or integrate implicitly"
        if damped > 1
        else f"the fastest mode has {np.sqrt(square) / (2 * np.pi * 1e3):.3g} kHz; take that step or a shorter one"
    )
    raise InputError(f"chain drive: a step of {step:.3g} s is not between 0 and the largest stable one, {largest:.3g} s: {reason}.")


def safe_step(model: ChainDrive, step: float | None = None) -> float:
    """The step [s] itself, refused where it is not stable; where none is given `STEP`, or less where that is not safe."""
    refuse_step(model, step or 0.1 * largest_step(model))
    return step or min(STEP, SAFE * largest_step(model))


def refuse_seats(model: ChainDrive) -> None:
    """InputError where a plate seated on a sprocket would touch it beyond the active part of a flank."""
    chain = model.chain
    link, a = chain.link, chain.link.flank_angle
    for number, sprocket in enumerate(model.sprockets, 1):
        if not isinstance(sprocket.tooth, Tooth):
            continue
        tooth = sprocket.tooth
        depth = link.flank_support * np.sin(a) - (tooth.base_radius - seat_height(link, tooth.teeth) * np.cos(a)) * np.cos(a)
        if not chain.crotch < depth < chain.toe:
            raise InputError(
                f"sprocket {number}: a seated plate touches {1e3 * depth:.4g} mm below its pins, but its flank reaches from "
                f"{1e3 * chain.crotch:.4g} to {1e3 * chain.toe:.4g} mm; move toe or crotch, or the flank's distance from the pins."
            )
        if not (tooth.support < 0 and sprocket.form_radius < tooth.contact_radius < sprocket.tip_radius):
            raise InputError(
                f"sprocket {number}: a seated plate touches at radius {1e3 * tooth.contact_radius:.5g} mm, but the flank is active from "
                f"{1e3 * sprocket.form_radius:.5g} to {1e3 * sprocket.tip_radius:.5g} mm; move the tip, the form radius or the support."
            )
