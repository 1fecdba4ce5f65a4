"""What the user says of a disc cam: follower, programme, closure, drive, loads, manufacture, limits."""

from typing import Literal

from pydantic import model_validator

from drivewright import materials, motion
from drivewright.spec import DataFile, Integer, Machining, MechanismSpec, Number, Spec, Text
from drivewright.spec.fields import Field
from drivewright.spec.length_or_angle import LengthOrAngle
from drivewright.units import (
    Angle,
    Damping,
    Force,
    Frequency,
    Inertia,
    Length,
    Mass,
    Pressure,
    PressureViscosity,
    Speed,
    Stiffness,
    Viscosity,
)

TURN = 6.283185307179586
Sense = Literal["counter-clockwise", "clockwise"]


class Follower(Spec):
    """What touches the cam, and how it is guided."""

    motion: Literal["translating", "oscillating"] = Field("translating", description="on a slide along +y, or on an arm about a pivot")
    face: Literal["roller", "flat", "knife", "shoe"] = Field("roller", description="shape that touches the cam")
    prime_radius: Length | None = Field(
        None, gt=0, description="radius of the pitch curve at zero lift; for a flat face the base radius", examples=["40 mm"]
    )
    base_radius: Length | None = Field(None, gt=0, description="radius of the profile at zero lift, instead of prime_radius")
    roller_radius: Length | None = Field(None, gt=0, description="radius of the roller", examples=["8 mm"])
    face_radius: Length | None = Field(None, gt=0, description="radius of a curved shoe", examples=["60 mm"])
    face_offset: Length = Field(
        "0 mm",
        description="centre of the shoe or middle of the flat face off the follower's line; oscillating "
        "flat face: beyond the parallel line through the pivot",
    )
    face_angle: Angle = Field("0 deg", gt=-TURN / 8, lt=TURN / 8, description="tilt of a translating flat face against the cam's turning")
    half_face: Length | None = Field(None, gt=0, description="half the length of a flat face, for the check")
    offset: Length = Field("0 mm", description="offset of the slide towards +x (cam turning clockwise: towards -x)")
    pivot_distance: Length | None = Field(None, gt=0, description="cam centre to the pivot of an oscillating follower", examples=["80 mm"])
    arm_length: Length | None = Field(
        None, gt=0, description="pivot to roller; on a flat face the radius where mass and force are counted", examples=["60 mm"]
    )
    lift_at: Literal["arm", "tip", "valve"] | None = Field(
        None,
        description="where an oscillating follower's programme counts its lengths: along the arc at arm_length, along the arc of the "
        "second arm's tip, or along the valve's line; the valve's unless given",
    )
    inertia: Inertia = Field("0 kg m^2", ge=0, description="moment of inertia of an oscillating follower about its pivot")


class Valve(Spec):
    """The second arm of an oscillating follower, and the valve that its pad drives along a straight line; the load acts there."""

    arm_length: Length = Field(gt=0, description="pivot to the centre of the pad on the valve's stem", examples=["36 mm"])
    start_angle: Angle = Field(
        "0 deg",
        gt=-TURN / 4,
        lt=TURN / 4,
        description="this arm at zero lift against the line through the pivot square to the valve; negative: it comes to that line as "
        "the valve opens",
    )


class Segment(Spec):
    """A stretch of the cam's turn."""

    angle: Angle = Field(gt=0, description="cam angle of the segment", examples=["90 deg"])
    law: Text = Field(description=f"motion law, or dwell: {', '.join(motion.names())}", examples=["cycloidal"])
    rise: LengthOrAngle | None = Field(
        None, description="rise, negative for a return; for an oscillating follower an angle, or a length (lift_at)", examples=["20 mm"]
    )
    file: DataFile | None = Field(None, description='CSV of law = "table": angle [deg],lift [mm] from the start of the segment')
    b: Number | None = Field(None, description='part of the sine ramps, for law = "scca"')
    c: Number | None = Field(None, description="part of constant acceleration (scca) or velocity (mcv)")
    d: Number | None = Field(None, description='part of the cosine, for law = "scca"')
    start: tuple[Number, ...] | None = Field(None, description='v, a, j ... at the start, for law = "polynomial"; segment and rise are 1')
    end: tuple[Number, ...] | None = Field(None, description="the same at the end")
    interior: tuple[tuple[Number, Integer, Number], ...] | None = Field(None, description="further (u, order, value) of a polynomial")
    points: tuple[tuple[Number, Number], ...] | None = Field(None, description='(u, s) of law = "spline", both from 0 to 1')
    band: LengthOrAngle | None = Field(
        None, gt=0, description='smooth the lifts of law = "table": the smoothest motion within this of every row', examples=["2 um"]
    )
    degree: Integer | None = Field(None, description="degree of a spline or table, 3 or 5")
    ends: Literal["clamped", "periodic"] | None = Field(None, description="ends of a spline or table")


class Groove(Spec):
    """A groove around the roller."""

    clearance: Length = Field("0.02 mm", ge=0, description="width of the groove less the diameter of the roller")


class Conjugate(Spec):
    """A second cam that drives the follower back through a roller of its own."""

    prime_radius: Length = Field(gt=0, description="pitch radius of the second cam at zero lift, where it is largest", examples=["60 mm"])
    roller_radius: Length | None = Field(None, gt=0, description="radius of the second roller; the first one's unless given")
    offset: Length = Field("0 mm", description="offset of the second roller towards +x")
    arm_length: Length | None = Field(None, gt=0, description="arm of the second roller; the first one's unless given")


class Drive(Spec):
    """The cam shaft."""

    speed: Speed = Field(gt=0, description="speed of the cam", examples=["300 rpm"])


class Load(Spec):
    """What the follower moves, counted along its travel (oscillating: at arm_length; with a valve: at the valve)."""

    mass: Mass = Field("0 kg", ge=0, description="moving mass")
    force: Force = Field("0 N", description="steady force that presses the follower onto the cam")
    damping: Damping = Field("0 N s/m", ge=0, description="viscous damping of the follower")


class Spring(Spec):
    """The spring that holds the follower on the cam; with a valve it acts there."""

    stiffness: Stiffness = Field("0 N/m", ge=0, description="stiffness along the travel", examples=["5 N/mm"])
    preload: Force = Field("0 N", ge=0, description="force at zero lift", examples=["50 N"])
    mass: Mass | None = Field(
        None,
        gt=0,
        description="mass of the active coils; with it the spring surges, and carries its own third of inertia",
        examples=["60 g"],
    )
    damping_ratio: Number = Field(0.01, gt=0, lt=0.5, description="damping of the surging spring over critical damping, in each mode")


class Face(Spec):
    """The cam across its plane."""

    width: Length = Field("10 mm", gt=0, description="width of the contact, and of the cam")


class Lubricant(Spec):
    """The oil between cam and follower."""

    viscosity: Viscosity = Field(gt=0, description="dynamic viscosity of the oil where it enters the contact", examples=["8 mPa s"])
    pressure_viscosity: PressureViscosity = Field("18 1/GPa", gt=0, description="pressure-viscosity coefficient of the oil")
    roughness: Length | None = Field(
        None, gt=0, description="rms roughness of both surfaces together, sqrt(Rq1^2 + Rq2^2)", examples=["0.3 um"]
    )


class Vibration(Spec):
    """The follower train as one mass on a damped spring."""

    natural_frequency: Frequency = Field(gt=0, description="natural frequency with the cam held", examples=["80 Hz"])
    damping_ratio: Number = Field(0.05, ge=0, lt=1, description="damping over critical damping")


class Manufacture(Machining):
    """For the exported files."""

    bore: Length | None = Field(None, gt=0, description="bore of the cam", examples=["16 mm"])
    hub_diameter: Length | None = Field(None, gt=0, description="hub on one side of the cam")
    hub_length: Length = Field("10 mm", gt=0, description="how far the hub stands out")


class Limits(Spec):
    """Requirements; each becomes a check."""

    pressure_angle: Angle | None = Field(
        None, gt=0, lt=TURN / 4, description="largest pressure angle; unless given 30 deg on a slide, 45 deg on an arm"
    )
    curvature_ratio: Number = Field(1.2, ge=1, description="least radius of the pitch curve over the radius of the face, recommended")
    lost_motion: Length = Field("0 mm", ge=0, description="how far the follower may sink beyond its programme")
    velocity_jump: Number = Field(0.0, ge=0, description="largest jump of the velocity over its peak")
    acceleration_jump: Number = Field(0.0, ge=0, description="largest jump of the acceleration over its peak")
    contact_pressure: Pressure | None = Field(None, gt=0, description="allowable Hertz pressure; the material's unless given")
    contact_force: Force = Field("0 N", ge=0, description="least force between follower and cam, closed by force")
    breadth_error: Length = Field("0.01 mm", ge=0, description="play or interference of a yoke")
    play: Length = Field("0.1 mm", ge=0, description="travel of the follower through the clearance of a groove")
    wall: Length = Field("3 mm", ge=0, description="least wall between profile and bore or hub")
    vibration: Length | None = Field(None, gt=0, description="largest deviation of the follower from its programme")


class CamSpec(MechanismSpec):
    """A disc cam with a translating or oscillating follower."""

    mechanism: Literal["cam"] = Field("cam", description="kind of drive")
    rotation: Sense = Field("counter-clockwise", description="sense in which the cam turns")
    closure: Literal["force", "groove", "conjugate", "yoke"] = Field("force", description="what holds the follower on the cam")
    material: Text = Field("16MnCr5", description=f"material of cam and follower: {', '.join(materials.names())}")
    follower: Follower = Field(description="follower")
    valve: Valve | None = Field(None, description="second arm and valve of an oscillating follower")
    programme: tuple[Segment, ...] = Field(min_length=1, description="segments of one turn of the cam, in order")
    groove: Groove | None = Field(None, description='for closure = "groove"')
    conjugate: Conjugate | None = Field(None, description='for closure = "conjugate"')
    drive: Drive | None = Field(None, description="drive; without it no velocities and forces")
    load: Load = Field(Load(), description="load on the follower")
    spring: Spring | None = Field(None, description="spring")
    lubricant: Lubricant | None = Field(None, description="oil between cam and follower")
    face: Face = Field(Face(), description="width of the contact")
    vibration: Vibration | None = Field(None, description="vibration of the follower train")
    manufacture: Manufacture = Field(Manufacture(), description="exports")
    limits: Limits = Field(Limits(), description="requirements")

    @model_validator(mode="before")
    @classmethod
    def _sense_beside_what_turns(cls, data):
        """`rotation` may also be said in [follower] or [drive]."""
        if isinstance(data, dict):
            for name in ("follower", "drive"):
                table = data.get(name)
                if isinstance(table, dict) and "rotation" in table and "rotation" not in data:
                    rest = {key: value for key, value in table.items() if key != "rotation"}
                    data = {**data, "rotation": table["rotation"], name: rest}
        return data
