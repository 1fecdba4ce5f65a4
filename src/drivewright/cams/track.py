"""A surface of a cam and what runs on it: how it is named beside the others of the cam, and its geometry over the turn."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from drivewright._typing import Bools, Floats
from drivewright.cams.cycle import STEP, Cycle, SampledJet
from drivewright.cams.followers import CamContact, ContactAt
from drivewright.cams.pressure import contact_pressure
from drivewright.cams.profile import FlatFollower, Follower, RoundFollower
from drivewright.cams.sizing import min_flat_radius
from drivewright.labels import LONGEST
from drivewright.numerics.jets import Jet
from drivewright.result import Column, Table

ROUNDING = 1e-9  # of a radius
SHORTER = (  # what a label that is too long is shortened by, step by step
    ("aximum ", "ax. "),
    ("inimum ", "in. "),
    ("Cam angle at ", "Angle of "),
    ("pitch curve", "pitch"),
    ("film thickness", "film"),
    ("conjugate cam", "conjugate"),
)


class KeptContacts:
    """`contact_at` that keeps its answers at the samples of a turn, and with them what has been computed of them."""

    def __init__(self, contact_at: ContactAt) -> None:
        self._contact_at, self._kept = contact_at, {}

    def __call__(self, angle: Jet, lift: Jet) -> CamContact:
        if not isinstance(lift, SampledJet):
            return self._contact_at(angle, lift)
        if lift not in self._kept:
            self._kept[lift] = self._contact_at(angle, lift)
        return self._kept[lift]

    def __reduce__(self) -> tuple[Any, ...]:
        return KeptContacts, (self._contact_at,)


@dataclass(frozen=True, eq=False)
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

    def __post_init__(self) -> None:
        object.__setattr__(self, "contact", KeptContacts(self.contact))

    @property
    def flat(self) -> bool:
        """Whether the face is flat."""
        return isinstance(self.follower, FlatFollower)

    @property
    def suffix(self) -> str:
        """What stands behind the names of its tables and checks."""
        return f".{self.prefix[:-1]}" if self.prefix else ""

    @property
    def words(self) -> str:
        """What it is called in a sentence."""
        return "conjugate cam" if self.name == "conjugate" else self.name

    @property
    def of(self) -> str:
        """What stands behind the meaning of its values, to tell it from the cam."""
        return f" ({self.words})" if self.prefix else ""

    def label(self, text: str) -> str:
        """A label of this surface, told from that of the cam: "Lost motion, conjugate cam"; shortened where it would be too long."""
        text += f", {self.words}" if self.prefix else ""
        for long, short in SHORTER:
            text = text.replace(long, short) if len(text) > LONGEST else text
        return text

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

    def clear_of_axis(self, cycle: Cycle) -> Bools:
        """Whether the face keeps clear of the cam's axis over the whole turn, so that a cam is left around it; an outer wall always is.

        Of many designs a column (n, 1).
        """
        if self.flank < 0:
            return np.array(True)

        def distance(angle, lift):
            """Distance of a flat face from the axis, square of that of a round one's centre."""
            return self.flat_face.face(angle, lift)[1] if self.flat else self.contact(angle, lift).pitch.abs2()

        limit = 0.0 if self.flat else (self.radius * (1 + ROUNDING)) ** 2
        sampled = distance(*cycle.sampled())
        steepest = np.max(np.abs(sampled.d1), axis=-1, keepdims=True)
        if np.all(np.min(sampled.d0, axis=-1, keepdims=True) - STEP * steepest > limit):  # so far that no place between two samples matters
            return np.array(True)
        return np.greater(cycle.minimum(distance).value, limit)

    def geometry_table(self, cycle: Cycle) -> Table:
        """Pressure angle, curvature and profile of one surface over the turn, one-sided at the joints."""
        _, angle = cycle.samples()
        contact = self.contact(*cycle.sampled())
        return Table(
            f"geometry{self.suffix}",
            self.label("Pressure angle and curvature"),
            (
                Column("angle", "rad", "cam angle", angle),
                Column("pressure_angle", "rad", f"pressure angle{self.of}", contact.pressure_angle.d0 + 0 * angle),
                Column(
                    "curvature", "1/m", f"curvature of the {self.curve}, convex positive{self.of}", contact.pitch_curvature.d0 + 0 * angle
                ),
                Column(
                    "pitch_radius",
                    "m",
                    f"distance of the {self.curve} from the cam centre{self.of}",
                    np.abs(contact.pitch.d0),
                    f"Polar radius of the {self.curve}",
                ),
                Column("profile_x", "m", f"x of the profile at cam angle 0{self.of}", contact.point.d0.real, "Profile x-coordinate"),
                Column("profile_y", "m", f"y of the profile at cam angle 0{self.of}", contact.point.d0.imag, "Profile y-coordinate"),
            ),
        )

    def undercut_table(self, cycle: Cycle) -> Table:
        """Curvature of the pitch curve against that of the face: above 1 the profile is undercut."""
        _, angle = cycle.samples()
        ratio = self.flank * self.radius * self.contact(*cycle.sampled()).pitch_curvature.d0
        return Table(
            f"undercut{self.suffix}",
            self.label("Undercut"),
            (
                Column("angle", "rad", "cam angle", angle),
                Column(
                    "ratio",
                    "-",
                    f"face radius times curvature of the pitch curve{self.of}",
                    ratio + 0 * angle,
                    "Face radius over pitch curve radius",
                ),
            ),
        )

    def contact_table(self, cycle: Cycle, normal_force: Floats, speed: float, rolls: bool) -> Table:
        """Normal force [N] at the cycle's samples, and the speeds of the contact at a speed of the cam [rad/s]."""
        _, angle = cycle.samples()
        contact = self.contact(*cycle.sampled())
        surface = f"{'circumferential speed of the roller' if rolls else 'sliding speed'}{self.of}"
        return Table(
            f"contact{self.suffix}",
            self.label("Contact of cam and follower"),
            (
                Column("angle", "rad", "cam angle", angle),
                Column("contact_force", "N", f"normal force{self.of}", normal_force),
                Column("surface_speed", "m/s", surface, np.abs(contact.sliding.d0) * speed + 0 * angle),
                Column("rolling_speed", "m/s", f"speed of the contact along the profile{self.of}", contact.rolling.d0 * speed + 0 * angle),
            ),
        )

    def pressure_table(self, cycle: Cycle, normal_force: Floats, width: float, modulus: float) -> Table:
        """Hertz pressure at the cycle's samples under a normal force [N]; width [m] of the contact, effective modulus [Pa]."""
        _, angle = cycle.samples()
        pressure = contact_pressure(normal_force, self.contact(*cycle.sampled()), self.radius, width, modulus)
        return Table(
            f"pressure{self.suffix}",
            self.label("Contact pressure"),
            (Column("angle", "rad", "cam angle", angle), Column("contact_pressure", "Pa", f"maximum Hertz pressure{self.of}", pressure)),
        )

    def without_pressure(self, cycle: Cycle) -> str:
        """Why a Hertz pressure has no meaning on this surface, or "": a knife edge, or an undercut profile."""
        if not self.flat and np.all(np.equal(self.radius, 0)):
            return "a knife edge has no contact pressure"
        return "" if self.has_pressure(cycle) else "the profile is undercut"

    def has_pressure(self, cycle: Cycle) -> Bools:
        """Whether a Hertz pressure has a meaning on this surface; of many designs a column (n, 1)."""
        if self.flat:
            return np.greater(min_flat_radius(cycle, self.flat_face).value, 0)
        sharpest = cycle.maximum(lambda angle, lift: self.flank * self.contact(angle, lift).pitch_curvature).value
        return np.less(sharpest * self.radius, 1) & np.greater(self.radius, 0)
