"""The spec of a disc cam: follower, programme, closure, drive, loads, manufacture, limits."""

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
    """The follower: its face on the cam, and its guidance."""

    motion: Literal["translating", "oscillating"] = Field("translating", description="on a slide along +y, or on an arm about a pivot")
    face: Literal["roller", "flat", "knife", "shoe"] = Field("roller", description="shape of the follower's face on the cam")
    prime_radius: Length | None = Field(
        None, gt=0, description="radius of the pitch curve at zero lift; for a flat face the base radius", examples=["40 mm"]
    )
    base_radius: Length | None = Field(None, gt=0, description="radius of the profile at zero lift, instead of prime_radius")
    roller_radius: Length | None = Field(None, gt=0, description="radius of the roller", examples=["8 mm"])
    face_radius: Length | None = Field(None, gt=0, description="radius of a curved shoe", examples=["60 mm"])
    face_offset: Length = Field(
        "0 mm",
        description="offset of the centre of the shoe, or of the middle of the flat face, from the follower's line; oscillating flat face: "
        "distance from the parallel line through the pivot",
    )
    face_angle: Angle = Field(
        "0 deg", gt=-TURN / 8, lt=TURN / 8, description="tilt of a translating flat face against the rotation of the cam"
    )
    half_face: Length | None = Field(
        None, gt=0, description="half the length of a flat face, for the check", title="Half length of the face"
    )
    offset: Length = Field("0 mm", description="offset of the slide towards +x (cam rotating clockwise: towards -x)")
    pivot_distance: Length | None = Field(
        None, gt=0, description="distance of the pivot of an oscillating follower from the cam centre", examples=["80 mm"]
    )
    arm_length: Length | None = Field(
        None,
        gt=0,
        description="distance of the roller from the pivot; flat face: the radius at which mass and force act",
        examples=["60 mm"],
    )
    lift_at: Literal["arm", "tip", "valve"] | None = Field(
        None,
        title="Location of the stated lift",
        description="location at which the programme of an oscillating follower states its lengths: along the arc at arm_length, along the "
        "arc of the tip of the second arm, or along the line of the valve (default)",
    )
    inertia: Inertia = Field("0 kg m^2", ge=0, description="moment of inertia of an oscillating follower about its pivot")


class Valve(Spec):
    """Second arm of an oscillating follower, and the valve that its pad drives along a straight line; the load acts on the valve."""

    arm_length: Length = Field(gt=0, description="distance of the centre of the pad on the valve stem from the pivot", examples=["36 mm"])
    start_angle: Angle = Field(
        "0 deg",
        gt=-TURN / 4,
        lt=TURN / 4,
        description="angle of this arm at zero lift from the line through the pivot normal to the valve; negative: the arm moves towards "
        "that line as the valve opens",
    )


class Segment(Spec):
    """One segment of the motion programme over the turn of the cam."""

    angle: Angle | None = Field(
        None, gt=0, description="cam angle of the segment; left out in one segment: the rest of the turn", examples=["90 deg"]
    )
    law: Text = Field(title="Motion law", description=f"motion law, or dwell: {', '.join(motion.names())}", examples=["cycloidal"])
    rise: LengthOrAngle | None = Field(
        None, description="rise, negative for a return; oscillating follower: an angle, or a length (lift_at)", examples=["20 mm"]
    )
    file: DataFile | None = Field(
        None, title="Table of lifts", description='CSV file for law = "table": angle [deg],lift [mm] from the start of the segment'
    )
    rows: tuple[tuple[Angle, LengthOrAngle], ...] | None = Field(
        None,
        title="Rows of the table",
        description='rows (angle, lift) for law = "table", instead of a file, from the start of the segment',
        examples=[[["0 deg", "0 mm"], ["60 deg", "8 mm"], ["120 deg", "0 mm"]]],
    )
    b: Number | None = Field(None, title="Sine part b", description='part of the sine ramps, for law = "scca"')
    c: Number | None = Field(None, title="Constant part c", description="part of constant acceleration (scca) or velocity (mcv)")
    d: Number | None = Field(None, title="Cosine part d", description='part of the cosine, for law = "scca"')
    start: tuple[Number, ...] | None = Field(
        None,
        title="Start conditions",
        description='v, a, j ... at the start, for law = "polynomial"; angle and rise of the segment are scaled to 1',
    )
    end: tuple[Number, ...] | None = Field(
        None, title="End conditions", description='v, a, j ... at the end, for law = "polynomial"; angle and rise are scaled to 1'
    )
    interior: tuple[tuple[Number, Integer, Number], ...] | None = Field(
        None, title="Interior conditions", description='further conditions (u, order, value) for law = "polynomial"'
    )
    points: tuple[tuple[Number, Number], ...] | None = Field(
        None, title="Spline points", description='points (u, s) for law = "spline", both from 0 to 1'
    )
    band: LengthOrAngle | None = Field(
        None,
        gt=0,
        title="Smoothing band",
        description='tolerance band for smoothing law = "table": the smoothest motion within this distance of every row',
        examples=["2 um"],
    )
    degree: Integer | None = Field(None, title="Spline degree", description="degree of the spline through points or rows, 3 or 5")
    ends: Literal["clamped", "periodic"] | None = Field(
        None, title="Spline end type", description="end conditions of the spline through points or rows"
    )


class Groove(Spec):
    """A groove around the roller."""

    clearance: Length = Field("0.02 mm", ge=0, description="width of the groove minus the diameter of the roller")


class Conjugate(Spec):
    """The conjugate cam, which drives the follower back through a second roller."""

    prime_radius: Length = Field(
        gt=0, description="radius of the pitch curve of the conjugate cam at zero lift, its maximum", examples=["60 mm"]
    )
    roller_radius: Length | None = Field(None, gt=0, description="radius of the second roller; default: that of the first roller")
    offset: Length = Field("0 mm", description="offset of the second roller towards +x")
    arm_length: Length | None = Field(None, gt=0, description="arm of the second roller; default: that of the first roller")


class Drive(Spec):
    """The cam shaft."""

    speed: Speed = Field(gt=0, description="speed of the cam", examples=["300 rpm"])


class Load(Spec):
    """Load on the follower, along its travel (oscillating: at arm_length; with a valve: at the valve)."""

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
        description="mass of the active coils; if given, the surge of the spring is computed, with the inertia of its coils",
        examples=["60 g"],
    )
    damping_ratio: Number = Field(0.01, gt=0, lt=0.5, description="damping ratio of each surge mode of the spring")


class Face(Spec):
    """Width of the cam and of its contact."""

    width: Length = Field("10 mm", gt=0, description="width of the contact, and of the cam")


class Lubricant(Spec):
    """The oil between cam and follower."""

    viscosity: Viscosity = Field(gt=0, description="dynamic viscosity of the oil at the inlet of the contact", examples=["8 mPa s"])
    pressure_viscosity: PressureViscosity = Field("18 1/GPa", gt=0, description="pressure-viscosity coefficient of the oil")
    roughness: Length | None = Field(
        None, gt=0, description="composite RMS roughness of both surfaces, sqrt(Rq1^2 + Rq2^2)", examples=["0.3 um"]
    )


class Vibration(Spec):
    """The follower train as one mass on a damped spring."""

    natural_frequency: Frequency = Field(gt=0, description="natural frequency with the cam held", examples=["80 Hz"])
    damping_ratio: Number = Field(0.05, ge=0, lt=1, description="damping ratio: damping over critical damping")


class Manufacture(Machining):
    """Bore, hub and machining for the exported files."""

    bore: Length | None = Field(None, gt=0, description="bore diameter of the cam", examples=["16 mm"])
    hub_diameter: Length | None = Field(None, gt=0, description="diameter of the hub on one side of the cam")
    hub_length: Length = Field("10 mm", gt=0, description="length by which the hub protrudes from the cam")


class Limits(Spec):
    """Requirements; each becomes a check."""

    pressure_angle: Angle | None = Field(
        None, gt=0, lt=TURN / 4, description="maximum pressure angle; default: 30 deg translating, 45 deg oscillating"
    )
    curvature_ratio: Number = Field(
        1.2, ge=1, description="recommended minimum radius of curvature of the pitch curve over the face radius"
    )
    lost_motion: Length = Field("0 mm", ge=0, description="maximum overtravel of the follower beyond its programme by undercut")
    velocity_jump: Number = Field(0.0, ge=0, description="maximum jump of the velocity over its peak")
    acceleration_jump: Number = Field(0.0, ge=0, description="maximum jump of the acceleration over its peak")
    contact_pressure: Pressure | None = Field(None, gt=0, description="allowable Hertz pressure; default: that of the material")
    contact_force: Force = Field("0 N", ge=0, description="minimum force between cam and follower for closure by force")
    breadth_error: Length = Field("0.01 mm", ge=0, description="maximum clearance or interference of a yoke")
    play: Length = Field(
        "0.1 mm", ge=0, title="Play in the groove", description="maximum travel of the follower through the clearance of a groove"
    )
    wall: Length = Field("3 mm", ge=0, description="minimum wall thickness between profile and bore or hub")
    vibration: Length | None = Field(None, gt=0, description="maximum deviation of the vibrating follower from its programme")


class CamSpec(MechanismSpec):
    """A disc cam with a translating or oscillating follower."""

    mechanism: Literal["cam"] = Field("cam", description="kind of drive")
    rotation: Sense = Field("counter-clockwise", description="sense of rotation of the cam")
    closure: Literal["force", "groove", "conjugate", "yoke"] = Field("force", description="closure: what keeps the follower on the cam")
    material: Text = Field(
        "16MnCr5", description=f"material of cam and follower: {', '.join(materials.names())}", examples=list(materials.names())
    )
    follower: Follower = Field(description="follower")
    valve: Valve | None = Field(None, description="second arm and valve of an oscillating follower")
    programme: tuple[Segment, ...] = Field(min_length=1, description="segments of one turn of the cam, in order")
    groove: Groove | None = Field(None, description='groove around the roller, for closure = "groove"')
    conjugate: Conjugate | None = Field(None, description='conjugate cam, for closure = "conjugate"')
    drive: Drive | None = Field(None, description="drive; if left out, no velocities and forces are computed")
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
        """`rotation` may also stand in [follower] or [drive]."""
        if isinstance(data, dict):
            for name in ("follower", "drive"):
                table = data.get(name)
                if isinstance(table, dict) and "rotation" in table and "rotation" not in data:
                    rest = {key: value for key, value in table.items() if key != "rotation"}
                    data = {**data, "rotation": table["rotation"], name: rest}
        return data
