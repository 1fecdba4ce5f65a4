"""A joint in the spec: its kind, what it connects, and for a pin the model of its play."""

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
    """A joint between two bodies.   Keys that its kind and model do not use are ignored, so models can be swapped."""

    name: Name = Field(description="name of the joint", examples=["A"])
    kind: Kind = Field(
        "revolute",
        title="Joint type",
        description="revolute: a pin. prismatic: a point of the first body slides on a line of the second "
        "without rotation; pin-slot: it may rotate. rolling: a wheel of the first on a track of the "
        "second. gear: two bodies rotate at a ratio. cam: the first body moves the second by a lift curve",
    )
    connects: tuple[Text, Text] = Field(
        title="Connected points",
        description="BODY.POINT of both bodies; at a pin with clearance the first carries the bearing, the second the "
        "journal. gear, and the cam of a cam pair: BODY",
        examples=[["crank.A", "coupler.A"]],
        json_schema_extra={"parts": ["first", "second"]},
    )
    axis: Direction = Field(
        (1.0, 0.0),
        title="Direction of axis",
        description="direction of the line in the second body's frame (cam: in the carrier's)",
        json_schema_extra={"parts": ["x", "y"]},
    )
    model: Model = Field(
        "ideal",
        title="Clearance model",
        description="clearance model of a revolute joint. massless-link: journal and bearing in permanent contact; dry: contact and "
        "flight; lubricated: oil film; bushing: rubber bushing",
    )
    clearance: Length | None = Field(
        None,
        ge=0,
        title="Radial clearance",
        description="radial clearance: bearing radius minus journal radius, half the difference of the diameters",
        examples=["0.1 mm"],
    )
    link_damping: RotationalDamping = Field("0 N m s/rad", ge=0, description="massless-link: damping of the link's rotation")
    link_angle: Angle = Field(
        "0 deg", description="massless-link: initial direction of the link, from the first body's pin to the second's"
    )
    bearing_radius: Length = Field("10 mm", gt=0, description="dry, lubricated, or with friction: radius of the bearing")
    bearing_length: Length | None = Field(
        None,
        gt=0,
        description="length of the bearing; twice its radius unless given. prismatic with friction: length of the guide, whose ends carry "
        "tilting moments; these cause no friction without it",
        examples=["20 mm"],
    )
    modulus: Pressure = Field("207 GPa", gt=0, title="Young's modulus", description="dry: Young's modulus of bearing and journal")
    poisson: Number = Field(0.3, ge=0, lt=0.5, title="Poisson's ratio", description="dry: Poisson's ratio of bearing and journal")
    normal: Normal = Field(
        "flores-2011",
        title="Normal contact law",
        description="dry: law of the contact force. elastic: no energy loss; cylinder: line contact with the energy "
        "loss of flores-2011; kelvin-voigt: linear spring and damper",
    )
    restitution: Number = Field(
        0.9,
        gt=0,
        le=1,
        title="Coefficient of restitution",
        description="dry: coefficient of restitution, speed after an impact over the speed before it",
    )
    friction: Number = Field(
        0.0,
        ge=0,
        title="Coefficient of sliding friction",
        description="coefficient of sliding friction of a dry pin, or of an ideal pin, slide or slot under its joint force; "
        "rolling: between wheel and track, which must not slip",
    )
    friction_law: Literal["coulomb", "ambrosio", "lugre"] = Field(
        "coulomb",
        description="friction law of a dry pin. coulomb: mu tanh(v/v0); ambrosio: a ramp that starts above v = 0; lugre: bristle model. "
        "Ideal joints use Coulomb friction with sticking",
    )
    friction_speed: Velocity = Field(
        "10 mm/s", gt=0, description="v0 of coulomb; end of the ramp of ambrosio; Stribeck speed of lugre and of ideal joints"
    )
    friction_dead_speed: Velocity = Field("1 mm/s", ge=0, description="ambrosio: start of the ramp")
    static_friction: Number | None = Field(
        None,
        ge=0,
        title="Coefficient of static friction",
        description="coefficient of static friction of lugre and of ideal joints; equal to friction unless given",
        examples=[0.2],
    )
    bristle_deflection: Length = Field(
        "10 um", gt=0, description="presliding deflection: of the bristles of lugre at the normal force, and of ideal joints"
    )
    bristle_damping: Slowness = Field("0 s/m", ge=0, description="lugre: friction over normal force, per speed of the bristles")
    viscous_friction: Slowness = Field(
        "0 s/m", ge=0, description="friction over normal force, per sliding speed, of lugre and of ideal joints"
    )
    rolling_resistance: Length = Field(
        "0 mm", ge=0, description="rolling: lever arm of rolling resistance, its moment over the normal force", examples=["0.05 mm"]
    )
    stiffness: Stiffness | None = Field(
        None, gt=0, description="bushing: radial stiffness; kelvin-voigt: contact stiffness", examples=["5e7 N/m"]
    )
    damping: Damping | None = Field(
        None,
        ge=0,
        description="bushing: radial damping, 0 unless given; kelvin-voigt: contact damping, from the restitution unless given",
        examples=["100 N s/m"],
    )
    rotational_stiffness: RotationalStiffness = Field("0 N m/rad", ge=0, description="bushing: rotational stiffness")
    rotational_damping: RotationalDamping = Field("0 N m s/rad", ge=0, description="bushing: rotational damping")
    viscosity: Viscosity = Field("40 mPa s", gt=0, title="Dynamic viscosity", description="lubricated: dynamic viscosity of the oil")
    film: Literal["long", "short", "reynolds"] = Field(
        "long",
        title="Oil film model",
        description="lubricated: long bearing (no axial flow), short bearing, or Reynolds' equation for its length",
    )
    roughness: Length = Field("1 um", gt=0, description="lubricated: film thickness below which the surfaces are in contact")
    wear_coefficient: WearCoefficient | None = Field(
        None, ge=0, description="dry: wear volume of the bearing per force and sliding distance", examples=["1e-6 mm^3/(N m)"]
    )
    radius: Length | None = Field(None, gt=0, title="Wheel radius", description="rolling: radius of the wheel", examples=["30 mm"])
    track_radius: Length = Field(
        "0 mm",
        description="rolling: 0 for a straight track along the axis, the wheel to the left of it; above 0 "
        "for a circular track with the wheel outside, below 0 for a ring around the wheel",
    )
    ratio: Number | None = Field(
        None,
        title="Gear ratio",
        description="gear: turns of the second body per turn of the first, relative to the carrier; negative for external gears",
        examples=[-2.0],
    )
    carrier: Text = Field("ground", description="gear, cam: body that carries both; BODY.POINT for the origin of a lift along the axis")
    lift: DataFile | None = Field(
        None,
        title="Cam lift file",
        description="cam: CSV of one turn, angle [deg],lift [mm] along the axis, or lift [deg] for an oscillating follower",
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
