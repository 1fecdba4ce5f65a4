"""The spec of an external Geneva drive: wheel, slots, pin, locking disc, drive, load, bearing, limits."""

from typing import Literal

from drivewright import materials
from drivewright.spec import Integer, Machining, MechanismSpec, Number, Spec, Text
from drivewright.spec.fields import Designation, Field
from drivewright.units import Angle, AngularAcceleration, Inertia, Length, Pressure, Speed, Time, Torque, WearCoefficient

MATERIALS = list(materials.names())
DRIVEN = ("cycloidal", "modified-sine", "modified-trapezoid", "polynomial-345", "polynomial-4567", "simple-harmonic")


class Pin(Spec):
    """The pin on the crank."""

    radius: Length = Field(gt=0, description="radius of the pin, of a roller its outer radius", examples=["8 mm"])
    kind: Literal["fixed", "roller"] = Field("roller", description="fixed in the crank, or a roller on a journal")
    journal_radius: Length | None = Field(
        None, gt=0, description="radius of the journal in a roller; default: half the radius of the roller", examples=["4 mm"]
    )
    friction: Number = Field(0.05, ge=0, lt=1, description="coefficient of friction of a fixed pin in the slot, of a roller on its journal")
    material: Text = Field("100Cr6", description=f"material of the pin: {', '.join(MATERIALS)}", examples=MATERIALS)
    wear_coefficient: WearCoefficient | None = Field(
        None, gt=0, description="specific wear rate of the sliding surfaces: worn volume per force and path", examples=["1e-6 mm^3/(N m)"]
    )


class Wheel(Spec):
    """The wheel with its slots."""

    outer_radius: Length | None = Field(
        None, gt=0, description="outer radius of the wheel; default: to where the pin touches the slot first", examples=["72 mm"]
    )
    thickness: Length = Field("12 mm", gt=0, description="thickness of the wheel, and of the locking disc")
    slot_clearance: Length = Field("0.02 mm", ge=0, description="width of a slot minus the diameter of the pin")
    end_clearance: Length = Field("1 mm", ge=0, description="clearance of the pin at the bottom of a slot")
    bore: Length | None = Field(None, gt=0, description="bore diameter of the wheel", examples=["16 mm"])
    hub_diameter: Length | None = Field(None, gt=0, description="diameter of the hub on the side away from the crank")
    hub_length: Length = Field("10 mm", gt=0, description="length by which the hub protrudes from the wheel")
    material: Text = Field("16MnCr5", description=f"material of the wheel: {', '.join(MATERIALS)}", examples=MATERIALS)


class Locking(Spec):
    """The locking disc on the crank."""

    radius: Length | None = Field(
        None, gt=0, description="radius of the locking disc; default: the crank radius less three radii of the pin", examples=["46 mm"]
    )
    clearance: Length = Field("0.05 mm", ge=0, description="clearance between the locking disc and the arcs of the wheel")
    relief: Length = Field("1 mm", ge=0, description="depth of the relief of the disc beyond what the tips of the wheel need")
    bore: Length | None = Field(None, gt=0, description="bore diameter of disc and crank", examples=["20 mm"])


class Drive(Spec):
    """The crank shaft."""

    speed: Speed = Field(gt=0, description="speed of the crank, with a law its mean over the turn", examples=["60 rpm"])
    law: Literal["uniform", *DRIVEN] = Field(  # pyright: ignore[reportInvalidTypeForm]  # the names are constants
        "uniform",
        title="Motion law of the crank",
        description="uniform: constant speed; else the law by which the crank makes each turn from rest to rest, the pin away from the "
        "wheel at both ends",
    )
    inertia: Inertia = Field("0 kg m^2", ge=0, description="moment of inertia of crank and motor at the crank shaft; felt with a law")


class Load(Spec):
    """What the wheel moves."""

    inertia: Inertia = Field(
        "0 kg m^2",
        ge=0,
        description="moment of inertia of all that turns with the wheel, without the wheel itself",
        examples=["0.05 kg m^2"],
    )
    friction_torque: Torque = Field("0 N m", ge=0, description="friction torque, opposing the motion of the wheel")
    process_torque: Torque = Field("0 N m", description="steady torque against the step, in motion and dwell")


class WheelBearing(Spec):
    """The bearing of the wheel, which takes the force of the pin."""

    bearing: Designation | None = Field(
        None, title="Bearing designation", description="designation in the catalogue, e.g. 6204; without it no life is computed"
    )
    friction: Number = Field(0.0, ge=0, lt=1, description="coefficient of friction of the bearing of the wheel")
    radius: Length | None = Field(
        None, gt=0, title="Friction radius", description="radius at which its friction acts; needed with a friction", examples=["8 mm"]
    )


class Limits(Spec):
    """Requirements; each becomes a check."""

    contact_pressure: Pressure | None = Field(
        None, gt=0, description="allowable Hertz pressure; default: the lower one of the two materials"
    )
    acceleration: AngularAcceleration | None = Field(
        None, gt=0, title="Maximum wheel acceleration", description="maximum angular acceleration of the wheel", examples=["200 rad/s^2"]
    )
    dwell: Angle = Field("0 deg", ge=0, lt=6.3, title="Minimum dwell angle", description="minimum crank angle of the dwell")
    entry_angle: Angle = Field(
        "3 deg", gt=0, lt=1.5, title="Maximum entry angle", description="maximum angle between the path of the pin and the slot at entry"
    )
    slot_wall: Length = Field("4 mm", ge=0, title="Wall between slots", description="minimum wall between two slots")
    mouth_wall: Length = Field(
        "2 mm", ge=0, title="Wall at the mouth", description="minimum wall between a slot and the locking arc beside it"
    )
    bore_wall: Length = Field("3 mm", ge=0, title="Wall at the bore", description="minimum wall between bore or hub and the slots")
    locking_clearance: Length = Field(
        "0 mm", title="Minimum locking clearance", description="minimum clearance between locking disc and wheel while the wheel turns"
    )
    dwell_play: Angle = Field(
        "10 arcmin", ge=0, title="Maximum play in the dwell", description="maximum rotation of the locked wheel, either way"
    )
    life: Time | None = Field(None, gt=0, title="Bearing life", description="minimum basic life L10h of the bearing", examples=["20000 h"])


class GenevaSpec(MechanismSpec):
    """An external Geneva drive: a pin on a crank steps a wheel with radial slots; a disc on the crank locks it in the dwell."""

    mechanism: Literal["geneva"] = Field("geneva", description="kind of drive")
    slots: Integer = Field(ge=3, le=18, title="Number of slots", description="number of slots, one a station", examples=[4])
    centre_distance: Length | None = Field(
        None,
        gt=0,
        description="distance of the axes of crank and wheel; default: such that the pin enters along the slot",
        examples=["100 mm"],
    )
    crank_radius: Length | None = Field(
        None, gt=0, description="radius of the pin's circle; default: such that the pin enters along the slot", examples=["70.711 mm"]
    )
    pin: Pin = Field(description="pin")
    wheel: Wheel = Field(Wheel(), description="wheel")
    locking: Locking = Field(Locking(), description="locking disc")
    drive: Drive = Field(description="drive")
    load: Load = Field(Load(), description="load on the wheel")
    bearing: WheelBearing = Field(WheelBearing(), description="bearing of the wheel")
    manufacture: Machining = Field(Machining(), description="exports")
    limits: Limits = Field(Limits(), description="requirements")
