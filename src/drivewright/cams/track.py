"""A surface of a cam and what runs on it: how it is named beside the others of the cam, and its geometry over the turn."""

from dataclasses import dataclass

import numpy as np

from drivewright.cams.cycle import Cycle
from drivewright.cams.followers import ContactAt
from drivewright.cams.profile import FlatFollower, Follower, RoundFollower
from drivewright.result import Column, Table


@dataclass(frozen=True)
class CamTrack:
    """A surface of a cam and what runs on it: `contact(angle, lift)` gives the `CamContact`.

    `prefix` stands before the names of its values; flank -1 is the outer wall of a groove; `cut`: it needs a profile of its own.
    """

    name: str
    prefix: str
    follower: Follower
    contact: ContactAt
    flank: int = 1
    cut: bool = True

    @property
    def flat(self) -> bool:
        """Whether the face is flat."""
        return isinstance(self.follower, FlatFollower)

    @property
    def suffix(self) -> str:
        """What stands behind the names of its tables and checks."""
        return f".{self.prefix[:-1]}" if self.prefix else ""

    @property
    def of(self) -> str:
        """What stands behind the meaning of its values, to tell it from the cam."""
        return f" ({self.name})" if self.prefix else ""

    @property
    def curve(self) -> str:
        """The curve whose curvature counts."""
        return "profile" if self.flat else "pitch curve"

    @property
    def round_face(self) -> RoundFollower:
        """The follower of a track whose face is round."""
        assert not isinstance(self.follower, FlatFollower)
        return self.follower

    @property
    def flat_face(self) -> FlatFollower:
        """The follower of a track whose face is flat."""
        assert isinstance(self.follower, FlatFollower)
        return self.follower

    @property
    def radius(self) -> float:
        """Radius of the face [m]; 0 for a knife edge, inf for a flat face."""
        return np.inf if self.flat else self.round_face.radius

    def geometry_table(self, cycle: Cycle) -> Table:
        """Pressure angle, curvature and profile of one surface over the turn, one-sided at the joints."""
        piece, angle = cycle.samples()
        contact = self.contact(*cycle.at(piece, angle))
        return Table(
            f"geometry{self.suffix}",
            f"Pressure angle and curvature{self.of}",
            (
                Column("angle", "rad", "cam angle", angle),
                Column("pressure_angle", "rad", f"pressure angle{self.of}", contact.pressure_angle.d0 + 0 * angle),
                Column(
                    "curvature", "1/m", f"curvature of the {self.curve}{self.of}, convex positive", contact.pitch_curvature.d0 + 0 * angle
                ),
                Column("pitch_radius", "m", f"distance of the {self.curve}{self.of} from the cam's centre", np.abs(contact.pitch.d0)),
                Column("profile_x", "m", f"profile{self.of}, x at cam angle 0", contact.point.d0.real),
                Column("profile_y", "m", f"profile{self.of}, y at cam angle 0", contact.point.d0.imag),
            ),
        )

    def undercut_table(self, cycle: Cycle) -> Table:
        """Curvature of the pitch curve against that of the face: above 1 the profile cuts itself away."""
        piece, angle = cycle.samples()
        ratio = self.flank * self.radius * self.contact(*cycle.at(piece, angle)).pitch_curvature.d0
        return Table(
            f"undercut{self.suffix}",
            f"Undercut{self.of}",
            (
                Column("angle", "rad", "cam angle", angle),
                Column("ratio", "-", f"face radius times curvature of the pitch curve{self.of}", ratio + 0 * angle),
            ),
        )
