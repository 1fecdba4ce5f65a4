"""The finished profile: what the follower's face leaves of a cam, its size, and the table to inspect it by."""

from typing import Any, NamedTuple, TypeGuard

import numpy as np

from drivewright._typing import Floats, Numbers
from drivewright.cams.cycle import Cycle
from drivewright.cams.followers import ContactAt
from drivewright.cams.profile import FlatFollower, Follower, RoundFollower, family, path, spans
from drivewright.cams.refusals import nan_unless
from drivewright.curves import Trimmed, derivative, outline_of_spans, simple_outline, trim
from drivewright.errors import SolverError
from drivewright.motion import Programme
from drivewright.result import Column, Table
from drivewright.scene import Outline


class FinishedProfile(NamedTuple):
    """What is left of a cam: its outline, the trimmed envelope (None for a knife edge), and why trimming failed, if it did."""

    outline: Outline
    trimmed: Trimmed | None
    failure: str = ""


def finished_profile(follower: Follower, programme: Programme, flank: int = 1) -> FinishedProfile:
    """The `FinishedProfile` that a follower leaves; untrimmed where trimming fails.  flank -1: the outer wall of a groove.

    Raises InputError where nothing is left of the cam.
    """
    if _is_knife(follower):
        return FinishedProfile(pitch_outline(follower, programme), None)
    swept = family(follower, programme, flank)
    try:
        trimmed = trim(swept)
    except SolverError as error:
        return FinishedProfile(outline_of_spans(spans(swept.envelope()), 1e-6), None, str(error))
    return FinishedProfile(trimmed.outline(), trimmed)


def display_profile(follower: Follower, programme: Programme, tolerance: float, flank: int = 1) -> Outline | None:
    """The outline of a cam within a tolerance [m] where nothing of it is trimmed away, for pictures; else None."""
    return None if _is_knife(follower) else simple_outline(family(follower, programme, flank), tolerance)


def pitch_outline(follower: RoundFollower, programme: Programme, tolerance: float = 1e-6) -> Outline:
    """The pitch curve of a follower with a round face as an outline within a tolerance [m]."""
    return outline_of_spans(spans(path(programme, follower.pitch)), tolerance)


def profile_radii(cycle: Cycle, contact_at: ContactAt, trimmed: Trimmed | None) -> tuple[Any, Any]:
    """(least, greatest) distance of a profile from the cam's centre [m]; contact_at: as it is meant, trimmed: what is left of it.

    Of many designs, of which nothing is trimmed away, columns (n, 1).
    """
    if trimmed and trimmed.undercut:
        radii = np.hypot(*trimmed.outline(1e-9).points(1e-9).T)
        return float(radii.min()), float(radii.max())

    def square(angle, lift):
        return contact_at(angle, lift).point.abs2()

    return np.sqrt(cycle.minimum(square).value), np.sqrt(cycle.maximum(square).value)


def is_star_shaped(cycle: Cycle, contact_at: ContactAt) -> Any:
    """Whether the contact goes round the cam's centre without ever turning back: Im(conj(q) q') keeps its sign over the turn.

    A smooth envelope of this kind does not cross itself, so that nothing of it is cut away.  Of many designs a column (n, 1).
    """

    def area_rate(angle, lift):
        point = contact_at(angle, lift).point
        return (point.conj() * derivative(point)).imag

    least, greatest = cycle.minimum(area_rate).value, cycle.maximum(area_rate).value
    return np.greater(least, 0) | np.less(greatest, 0)


def min_hollow_radius(cycle: Cycle, contact_at: ContactAt, radius: Numbers) -> Any:
    """Least radius of curvature [m] of the hollow stretches of the profile under a face of that radius [m]; nan where none is hollow."""
    sharpest = cycle.minimum(lambda angle, lift: contact_at(angle, lift).pitch_curvature).value
    with np.errstate(divide="ignore"):
        return nan_unless(np.less(sharpest, 0), radius - np.divide(1.0, sharpest))


def polar_radii(trimmed: Trimmed, angle: Floats, points: int = 20_001) -> Floats:
    """Radii [m] of a profile at polar angles [rad], for one that every ray from the cam's centre meets once.

    `points` on each stretch: chords so short that the radius between two of them is exact to 1 nm.
    """
    stretches = (span.piece.at(np.linspace(span.start, span.stop, points)).d0 for span in trimmed.spans)
    z = np.concatenate([np.broadcast_to(stretch, points) for stretch in stretches])
    order = np.argsort(np.angle(z))
    return np.interp(np.angle(np.exp(1j * angle)), np.angle(z)[order], np.abs(z)[order], period=2 * np.pi)


def inspection_table(cycle: Cycle, contact_at: ContactAt, trimmed: Trimmed | None, tolerance: float, name: str, title: str) -> Table:
    """Nominal points of a profile at whole degrees of the cam angle, with its tolerance [m]; what was trimmed away is left out."""
    angle = np.radians(np.arange(360.0))
    for start, stop in trimmed.removed if trimmed else ():
        angle = angle[(angle <= start) | (angle >= stop)]
    contact = contact_at(*cycle.at_angle(angle))
    point = contact.point.d0
    columns = (
        Column("angle", "rad", "cam angle", angle),
        Column("polar_angle", "rad", "direction of the profile point from the cam centre, at cam angle 0", np.angle(point), "Polar angle"),
        Column("radius", "m", "distance of the profile point from the cam centre", np.abs(point), "Polar radius"),
        Column("x", "m", "x of the profile point at cam angle 0", np.real(point), "Profile x-coordinate"),
        Column("y", "m", "y of the profile point at cam angle 0", np.imag(point), "Profile y-coordinate"),
        Column(
            "normal",
            "rad",
            "direction of the outward normal of the profile at cam angle 0",
            np.angle(contact.normal),
            "Direction of the outward normal",
        ),
        Column(
            "pitch_radius",
            "m",
            "distance of the centre of the follower's face from the cam centre",
            np.abs(contact.pitch.d0),
            "Polar radius of the face centre",
        ),
        Column(
            "tolerance", "m", "allowed deviation along the normal, plus and minus", np.full(angle.shape, tolerance), "Profile tolerance"
        ),
    )
    return Table(name, title, columns)


def _is_knife(follower: Follower) -> TypeGuard[RoundFollower]:
    return not isinstance(follower, FlatFollower) and follower.radius == 0
