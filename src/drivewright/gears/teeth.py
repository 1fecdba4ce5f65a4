"""Gears with teeth: what the rack leaves of the blank when it has rolled once around the pitch curve."""

from dataclasses import dataclass
from functools import partial
from typing import NamedTuple

import numpy as np

from drivewright.curves import Piece, Span, Trimmed, outline_of_spans, trim
from drivewright.errors import InputError
from drivewright.gears.rack import Rack, RackFamily
from drivewright.gears.rolling import RollingPair
from drivewright.scene import Drawing, Outline, Shape, circle


class Undercut(NamedTuple):
    """A flank that the cutter's tip has partly cut away: `lost` [m] of the cutter's straight depth `straight` [m] leave no profile."""

    space: int
    side: int
    lost: float
    straight: float
    pitch_radius: float


@dataclass(frozen=True)
class Gear:
    """A gear cut by a rack: the family that cut it and the profile that was left, in the gear's own frame (axis at the origin).

    undercut: the flanks partly cut away; pointed: the numbers of teeth whose flanks meet below the tip curve.
    """

    family: RackFamily
    profile: Trimmed
    undercut: tuple[Undercut, ...]
    pointed: tuple[int, ...]

    @property
    def module(self) -> float:
        """Module [m]."""
        return self.family.module

    @property
    def teeth(self) -> int:
        """Tooth count."""
        return self.family.teeth

    def outline(self, tolerance: float = 1e-6) -> Outline:
        """Counter-clockwise Outline of the toothed gear."""
        return self.profile.outline(tolerance)

    def pitch_outline(self, tolerance: float = 1e-6) -> Outline:
        """Counter-clockwise Outline of the pitch curve."""
        family = self.family
        piece = Piece(0.0, family.period, partial(family.parallel, 0.0), "pitch curve", family.round_shape)
        return outline_of_spans([Span(piece, piece.start, piece.stop)], tolerance)

    def drawing(self, name: str, bore: float = 0.0, thickness: float = 0.0, tolerance: float = 1e-6) -> Drawing:
        """Drawing for manufacture: profile, pitch curve and the bore (diameter [m]) about the axis."""
        shapes = [Shape("profile", self.outline(tolerance)), Shape("pitch", self.pitch_outline(tolerance))]
        if bore:
            wall = np.min(np.abs(self.profile.chain.z)) - 0.5 * bore
            if wall <= 0:
                raise InputError(
                    f"gear drawing '{name}': a bore of {bore * 1e3:.4g} mm breaks through the root by {-wall * 1e3:.4g} mm; the axis is "
                    f"{np.min(np.abs(self.profile.chain.z)) * 1e3:.4g} mm from the nearest root. Take a smaller bore or a larger gear."
                )
            shapes.append(Shape("hole", circle((0.0, 0.0), 0.5 * bore)))
        return Drawing(name, f"{self.teeth} teeth, module {self.module * 1e3:.4g} mm", tuple(shapes), thickness)

    def describe_undercut(self) -> str:
        """One sentence on the undercut for a check or a finding; empty without undercut."""
        if not self.undercut:
            return ""
        worst = max(self.undercut, key=lambda cut: cut.lost)
        least = worst.straight / np.sin(self.family.rack.pressure_angle) ** 2
        hollow = worst.pitch_radius < 0
        return (
            f"{len(self.undercut)} of {2 * self.teeth} flanks are undercut, worst in space {worst.space}: {worst.lost * 1e3:.3g} mm of "
            f"{worst.straight * 1e3:.3g} mm straight cutter depth lost, pitch curve radius {abs(worst.pitch_radius) * 1e3:.4g} mm "
            f"{'there, and hollow: a rack needs a convex one of' if hollow else 'there,'} {least * 1e3:.4g} mm"
            f"{'. Take less variation of the ratio' if hollow else ' needed. Take more teeth, a larger pressure angle or less dedendum'}."
        )


def cut_gear(pair: RollingPair, gear: int, teeth: int, rack: Rack | None = None, phase: float = 0.0) -> Gear:
    """Cut gear 1 (driver) or 2 (driven) of a rolling pair with a rack; returns Gear.

    teeth belong to this gear; with lobes (n, m) the mate has teeth m/n (or n/m) times as many.  phase: the first tooth space of
    gear 1 lies this many pitches of arc after the contact at angle 0; the same value gives gear 2 teeth that fit.
    """
    n, m = pair.lobes
    mate = teeth * (m / n if gear == 1 else n / m)
    if not (float(teeth).is_integer() and teeth >= 3 and float(mate).is_integer()):
        raise InputError(
            f"cut_gear: {teeth:g} teeth on gear {gear} give {mate:g} on its mate (lobes {n} and {m}); both must be whole and at least 3. "
            f"Take a multiple of {n if gear == 1 else m}."
        )
    family = RackFamily(pair, gear, int(teeth), rack or Rack(), phase)
    profile = trim(family, samples=24 * 6 * family.teeth, least=24)
    return Gear(family, profile, tuple(_undercut(family, profile)), tuple(_pointed(profile)))


def _undercut(family, profile):
    """Flank pieces that do not survive down to the fillet."""
    left = {span.piece.label: span for span in profile.spans}
    rack, size = family.rack, family.module
    s, c = np.sin(rack.pressure_angle), np.cos(rack.pressure_angle)
    for piece in profile.chain.pieces:
        if not piece.label.startswith("flank"):
            continue
        space, side = int(piece.label[6:-1]), 1 if piece.label[-1] == "+" else -1
        root, tip = (piece.start, piece.stop) if side > 0 else (piece.stop, piece.start)
        kept = left.get(piece.label)
        at = tip if kept is None else (kept.start if side > 0 else kept.stop)
        if at != root:
            w = side * (family.pair.arc_length(np.array([at]))[0] - family.spaces[space])
            depth = (rack.half_width * size - w) * s * c
            bend = float(family.pair.curvature(family.gear, np.array([root]))[0])
            yield Undercut(space, side, float(rack.straight * size - depth), float(rack.straight * size), 1 / bend if bend else np.inf)


def _pointed(profile):
    """Numbers of the teeth whose tip does not survive."""
    left = {span.piece.label for span in profile.spans}
    return [int(piece.label[4:]) for piece in profile.chain.pieces if piece.label.startswith("tip") and piece.label not in left]
