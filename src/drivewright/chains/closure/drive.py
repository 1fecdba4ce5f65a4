"""Quasi-static closure of a chain around two sprockets: rigid plates, both strands taut, no load, over one tooth of the driver."""

from collections.abc import Callable, Sequence
from typing import Any, get_args

import numpy as np

from drivewright.cases import Outcomes, run
from drivewright.chains.closure import tracking
from drivewright.chains.closure.measures import measure
from drivewright.chains.closure.model import Closure, Drive, States, Strands
from drivewright.chains.closure.start import layout_of
from drivewright.chains.link import Link
from drivewright.contact import hertz
from drivewright.errors import DoesNotAssemble, InputError, SolverError, UnknownName, brief

POSITIONS = 48
LEAST_TEETH = 5


def close(drive: Drive, positions: int = POSITIONS) -> Closure:
    """The `Closure` of a `Drive`, at `positions` equal steps of a tooth and at every event between them.

    InputError for numbers that make no chain, DoesNotAssemble where the chain is too short for a free plate in each strand or the wrap
    too small for two seated ones, SolverError where the positions or seats do not settle.  A wrap or a centre distance that should not
    be built is computed all the same.
    """
    refuse_joint(drive.link)
    refuse_strands(drive.strands)
    for name in ("driver_teeth", "driven_teeth"):
        refuse_count(name, getattr(drive, name), LEAST_TEETH)
    refuse_count("links", drive.links, 1)
    refuse_count("positions", positions, 4)
    layout, seats, x = layout_of(drive)
    track = tracking.follow(layout, seats, x, np.linspace(0, layout.phi_1, positions + 1))
    if track.outcome[0] != tracking.DONE:
        raise _failure(drive, track, x)
    return _closure(drive, track)


def phase_map(
    drives: Sequence[Drive], positions: int = POSITIONS, workers: int = 1, progress: Callable[..., Any] | None = None
) -> Outcomes:
    """`Outcomes` of `close` for many drives in the order given; a chain that cannot be is a row with the reason.  See `cases.run`."""
    return run(lambda drive: close(drive, positions), drives, workers, progress)


def _closure(drive, track):
    count, p = track.length[0], drive.link.pitch
    psi, x = track.psi[:count], track.x[:count] * np.array([1.0, p, 1.0, 1.0])
    before, after = (slope[:count, :2] * np.array([1.0, p]) for slope in (track.before, track.after))
    mean, low, high = measure(psi, x[:, 1], before[:, 1], after[:, 1])
    ratio = drive.driver_teeth / drive.driven_teeth
    error = x[:, 0] - ratio * psi
    offset, behind, ahead = measure(psi, error, before[:, 0] - ratio, after[:, 0] - ratio)
    states = States(psi.copy(), x[:, 0].copy(), x[:, 1].copy(), x[:, 2:].copy(), track.seats[:count].copy())
    residual = p * float(np.max(track.miss[:count]))
    return Closure(drive, states, track.event[:count].copy(), before, after, error - offset, ahead - behind, mean, high - low, residual)


def refuse_joint(joint: Link) -> None:
    """InputError for a joint that leaves no pitch, or whose surfaces do not touch on one line."""
    if joint.skew:
        refuse_pair(joint)
        return
    if not (np.isfinite(joint.hole_pitch) and 0 <= joint.radius < joint.hole_pitch / 2):
        raise InputError(
            f"chain: a joint with hole pitch {joint.hole_pitch * 1e3:.4g} mm and rolling radius {joint.radius * 1e3:.4g} mm; the radius "
            "must be at least 0 and less than half the hole pitch."
        )


def refuse_pair(joint: Link) -> None:
    """InputError for rolling surfaces of two radii that do not touch on one line, or leave no pitch."""
    right, left = joint.radii
    if not (np.all(np.isfinite(joint)) and joint.pitch > 0):
        raise InputError(f"chain: rolling radii of {1e3 * right:.4g} and {1e3 * left:.4g} mm leave no positive pitch; take smaller radii.")
    hertz.effective_radius(right, left)


def refuse_count(name: str, value: int, least: int) -> None:
    """InputError for what is no whole number from `least` up."""
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)) or value < least:
        raise InputError(f"chain: {name} = {brief(value)}; it must be a whole number from {least} up.")


def refuse_strands(strands: str) -> None:
    """UnknownName for an unknown form of the strands."""
    if strands not in get_args(Strands):
        raise UnknownName("form of the strands", strands, get_args(Strands))


def _failure(drive, track, x):
    """What to raise for a track that ended early."""
    where = f"{drive.links} links around {drive.driver_teeth} and {drive.driven_teeth} teeth"
    outcome, distance = track.outcome[0], x[1] * drive.link.pitch * 1e3
    if outcome == tracking.NO_STRAND:
        return DoesNotAssemble(
            f"chain: {where} leave no free plate in a strand, at a centre distance of about {distance:.4g} mm. Add links, two at a time."
        )
    if outcome == tracking.NO_WRAP:
        return DoesNotAssemble(
            f"chain: {where} leave fewer than two plates on a sprocket, at a centre distance of about {distance:.4g} mm. "
            "Take more teeth there, or more links and more similar numbers of teeth."
        )
    count = track.length[0]
    angle = track.psi[count - 1] if count else 0.0
    what = "seats of the plates do not converge" if outcome == tracking.RESTLESS else "position of the plates is not found"
    return SolverError(
        f"chain: {where}, rolling radius {drive.link.radius * 1e3:.4g} mm: the {what} beyond a driver angle of {np.degrees(angle):.4f}°, "
        f"after {count} samples, at a centre distance of about {distance:.4g} mm. Change the links by one or the rolling radius a little.",
        partial=_closure(drive, track) if count > 1 else None,
    )
