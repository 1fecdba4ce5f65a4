"""What the user says of a joint: its kind, what it connects, and for a pin the model of its play."""

from typing import TYPE_CHECKING, Literal, TypeAlias

from drivewright.plugins import installed
from drivewright.spec import DataFile, Name, Number, Spec, Text
from drivewright.spec.fields import Field
from drivewright.units import (
    Angle,
    Damping,
    Length,
    Pressure,
    RotationalDamping,
    RotationalStiffness,
    Slowness,
    Stiffness,
    Velocity,
    Viscosity,
    WearCoefficient,
)

Direction = tuple[Number, Number]
KINDS = ("revolute", "prismatic", "pin-slot", "rolling", "gear", "cam")
Model = Literal["ideal", "massless-link", "dry", "lubricated", "bushing"]
NORMALS = ("flores-2011", "lankarani-nikravesh", "hunt-crossley", "gonthier", "herbert-mcwhannell", "kelvin-voigt", "elastic", "cylinder")
if TYPE_CHECKING:
    Kind: TypeAlias = str
    Normal: TypeAlias = str
else:
    Kind = Literal[(*KINDS, *sorted(installed("drivewright.joints")))]
    Normal = Literal[(*NORMALS, *sorted({*installed("drivewright.impact_laws"), *installed("drivewright.contact_laws")}))]


class Joint(Spec):
    """What holds two bodies together.   A key that its kind and model do not ask for is left aside: models can be swapped."""

    name: Name = Field(description="name", examples=["A"])
    kind: Kind = Field(
        "revolute",
        description="revolute: a pin. prismatic: a point of the first body slides on a line of the second, "
        "without turning; pin-slot: it may turn. rolling: a wheel of the first on a track of the "
        "second. gear: two bodies turn at a ratio. cam: the first moves the second by a programme",
    )
    connects: tuple[Text, Text] = Field(
        description="BODY.POINT of both; of a pin with play the first carries the bearing, the second the "
        "journal. gear, and the cam of a cam pair: BODY",
        examples=[["crank.A", "coupler.A"]],
    )
    axis: Direction = Field((1.0, 0.0), description="direction of the line in the second body's frame (cam: in the carrier's)")
    model: Model = Field(
        "ideal",
        description="play of a revolute joint. massless-link: journal and bearing always touch; dry: contact and "
        "flight; lubricated: oil between; bushing: rubber",
    )
    clearance: Length | None = Field(
        None,
        ge=0,
        description="play: radius of the bearing less that of the journal; half the difference of the diameters",
        examples=["0.1 mm"],
    )
    link_damping: RotationalDamping = Field("0 N m s/rad", ge=0, description="massless-link: damping of the link's rotation")
    link_angle: Angle = Field("0 deg", description="massless-link: start direction of the link, from the first body's pin to the second's")
    bearing_radius: Length = Field("10 mm", gt=0, description="dry, lubricated, or with friction: radius of the bearing")
    bearing_length: Length | None = Field(
        None,
        gt=0,
        description="length of the bearing; twice its radius unless given. prismatic with friction: of the guide along its axis, at "
        "whose ends a moment presses; what tilts the slider is not counted unless given",
        examples=["20 mm"],
    )
    modulus: Pressure = Field("207 GPa", gt=0, description="dry: Young's modulus of bearing and journal")
    poisson: Number = Field(0.3, ge=0, lt=0.5, description="dry: Poisson's ratio of both")
    normal: Normal = Field(
        "flores-2011",
        description="dry: law of the contact force. elastic: no loss; cylinder: line contact, losing "
        "energy as flores-2011 does; kelvin-voigt: linear spring and damper",
    )
    restitution: Number = Field(0.9, gt=0, le=1, description="dry: speed after an impact over the speed before it")
    friction: Number = Field(
        0.0,
        ge=0,
        description="coefficient of sliding friction: of a dry pin, and of ideal pins, slides and slots by the force that they transmit; "
        "rolling: of wheel and track, which must not slip",
    )
    friction_law: Literal["coulomb", "ambrosio", "lugre"] = Field(
        "coulomb",
        description="of a dry pin. coulomb: mu tanh(v/v0); ambrosio: a ramp that starts above v = 0; lugre: bristles. Ideal joints "
        "slide by Coulomb's law and stick",
    )
    friction_speed: Velocity = Field(
        "10 mm/s", gt=0, description="v0 of coulomb; end of ambrosio's ramp; Stribeck speed of lugre and of ideal joints"
    )
    friction_dead_speed: Velocity = Field("1 mm/s", ge=0, description="ambrosio: start of the ramp")
    static_friction: Number | None = Field(
        None, ge=0, description="coefficient at rest, of lugre and of ideal joints; friction unless given", examples=[0.2]
    )
    bristle_deflection: Length = Field(
        "10 um", gt=0, description="deflection before sliding: of lugre's bristles at the normal force, and of ideal joints"
    )
    bristle_damping: Slowness = Field("0 s/m", ge=0, description="lugre: friction over normal force, per speed of the bristles")
    viscous_friction: Slowness = Field(
        "0 s/m", ge=0, description="friction over normal force, per sliding speed: of lugre and of ideal joints"
    )
    rolling_resistance: Length = Field(
        "0 mm", ge=0, description="rolling: moment that resists rolling over the normal force", examples=["0.05 mm"]
    )
    stiffness: Stiffness | None = Field(
        None, gt=0, description="bushing: of its displacement; kelvin-voigt: of the contact", examples=["5e7 N/m"]
    )
    damping: Damping | None = Field(
        None,
        ge=0,
        description="bushing: of its displacement, 0 unless given; kelvin-voigt: instead of that which gives the restitution",
        examples=["100 N s/m"],
    )
    rotational_stiffness: RotationalStiffness = Field("0 N m/rad", ge=0, description="bushing: of its rotation")
    rotational_damping: RotationalDamping = Field("0 N m s/rad", ge=0, description="bushing: of its rotation")
    viscosity: Viscosity = Field("40 mPa s", gt=0, description="lubricated: dynamic viscosity of the oil")
    film: Literal["long", "short", "reynolds"] = Field(
        "long", description="lubricated: long bearing (no flow along it), short bearing, or Reynolds' equation for its length"
    )
    roughness: Length = Field("1 um", gt=0, description="lubricated: film thickness at which the oil gives way to contact")
    wear_coefficient: WearCoefficient | None = Field(
        None, ge=0, description="dry: volume worn off the bearing per force and sliding", examples=["1e-6 mm^3/(N m)"]
    )
    radius: Length | None = Field(None, gt=0, description="rolling: of the wheel", examples=["30 mm"])
    track_radius: Length = Field(
        "0 mm",
        description="rolling: 0 for a straight track along the axis, the wheel to the left of it; above 0 "
        "for a circle with the wheel outside, below 0 for a ring around the wheel",
    )
    ratio: Number | None = Field(
        None,
        description="gear: turns of the second for one of the first, relative to the carrier; negative for outer gears",
        examples=[-2.0],
    )
    carrier: Text = Field("ground", description="gear, cam: body that carries both; BODY.POINT for the origin of a lift along the axis")
    lift: DataFile | None = Field(
        None, description="cam: CSV of a turn, angle [deg],lift [mm] along the axis, or lift [deg] for a follower that turns"
    )

    @property
    def pin(self) -> str | None:
        """The model of a pin; None for another joint, and "ideal" where there is no play."""
        if self.kind != "revolute":
            return None
        return "ideal" if self.model in ("massless-link", "dry", "lubricated") and self.clearance == 0 else self.model

    @property
    def has_play(self) -> bool:
        """Whether it is a pin whose journal may move in its bearing."""
        return self.pin not in (None, "ideal")

    @property
    def is_ideal(self) -> bool:
        """Whether it has neither play nor springs."""
        return self.pin in (None, "ideal")

    @property
    def has_contact(self) -> bool:
        """Whether journal and bearing touch by a contact law, dry or through the oil."""
        return self.pin in ("dry", "lubricated")

    @property
    def length(self) -> float:
        """Of the bearing [m]."""
        return self.bearing_length or 2 * self.bearing_radius
