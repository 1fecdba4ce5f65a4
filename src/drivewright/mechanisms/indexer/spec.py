"""Spec of an indexing drive: wheel, cams, motion, load, and what yields."""

from typing import Annotated, Literal, Self

from pydantic import model_validator

from drivewright import materials, motion
from drivewright.errors import SpecError, UnknownName
from drivewright.indexing.motion import NO_DWELL, TURN
from drivewright.spec import DataFile, Integer, Machining, MechanismSpec, Number, Spec, Text
from drivewright.spec.fields import Designation, Field
from drivewright.units import Angle, Force, Inertia, Length, Pressure, RotationalStiffness, Speed, Stiffness, Time, Torque

Diameter = Annotated[Length, Field(gt=0)]


class IndexerMotion(Spec):
    """The wheel over one turn of the input."""

    law: Text | None = Field(
        None,
        description="motion law of the step: modified-sine (unless given), cycloidal, polynomial-345 ...; "
        "uniform: a full turn, no dwell, as for a cycloid",
        examples=["modified-sine"],
    )
    motion_to_dwell: Number | Literal["no-dwell"] | None = Field(
        None, description=f'angle of the step over that of the dwell; 1 unless given; "{NO_DWELL}": a full turn', examples=[1.0]
    )
    file: DataFile | None = Field(
        None,
        description='CSV of law = "table": angle [deg],lift [deg], the input from the start of the step and the wheel; the last row is the '
        "end of the step, so motion_to_dwell is left out",
    )
    points: tuple[tuple[Number, Number], ...] | None = Field(
        None, description='(u, s) of law = "spline": parts of the motion angle and of the step, both from 0 to 1'
    )
    degree: Integer | None = Field(None, description="degree of a spline or table, 3 or 5; 5 unless given")
    b: Number | None = Field(None, description='part of the sine ramps, for law = "scca"')
    c: Number | None = Field(None, description="part of constant acceleration (scca) or velocity (mcv)")
    d: Number | None = Field(None, description='part of the cosine, for law = "scca"')


class IndexerLoad(Spec):
    """What acts on the wheel."""

    torque: Torque | None = Field(
        None, description="on the wheel, positive in the index direction; stiffness is taken at it", examples=["1000 N m"]
    )
    angle: Angle | None = Field(None, description="one input angle to evaluate instead of the whole index period", examples=["45 deg"])
    speed: Speed | None = Field(None, gt=0, description="speed of the input, for velocities and lives in hours", examples=["120 rpm"])


class IndexerTable(Spec):
    """The dial table on the wheel and what turns with it; with load.speed it tells the torque at the input."""

    inertia: Inertia = Field(ge=0, description="moment of inertia about the wheel's axis of all that turns with it", examples=["2 kg m^2"])
    friction_torque: Torque = Field("0 N m", ge=0, description="friction of table and wheel, against their motion", examples=["20 N m"])
    process_torque: Torque = Field(
        "0 N m", description="steady torque on the table against the index direction, besides friction; load.torque is not counted here"
    )


class IndexerMotor(Spec):
    """The motor at the input; without it the torque is told at the input. The gears of [gear] are alike and change no torque."""

    ratio: Number = Field(1.0, gt=0, description="speed of the motor over that of the input", examples=[20.0])
    efficiency: Number = Field(1.0, gt=0, le=1, description="of all between table and motor: rollers, gears, reducer", examples=[0.85])
    inertia: Inertia | None = Field(None, gt=0, description="moment of inertia of the motor, to compare", examples=["5 kg cm^2"])
    rated_torque: Torque | None = Field(None, gt=0, description="torque that it delivers for any time", examples=["4 N m"])
    maximum_torque: Torque | None = Field(None, gt=0, description="torque that it delivers for a short time", examples=["12 N m"])


class IndexerContact(Spec):
    """Pins or rollers on the cams."""

    model: Literal["unilateral", "bonded"] = Field(
        "unilateral", description="unilateral: pins press only, gaps close; bonded: pins that touch also pull, as in the paper"
    )
    pin_stiffness: Stiffness | None = Field(
        None, gt=0, description="of a pin in its seats, behind the contact; rigid unless given", examples=["5e8 N/m"]
    )
    interference: Length = Field(
        "0 mm", ge=0, description="by which rollers and cams are pressed together in assembly; parallel, barrel and globoidal"
    )
    material: Text = Field("100Cr6", description=f"of pins and cams, for the contact pressure: {', '.join(materials.names())}")


class IndexerBearings(Spec):
    """Rolling bearings of one kind; one of bearing and stiffness."""

    bearing: Designation | None = Field(None, description="designation in the catalogue, e.g. NU207E", examples=["NU207E"])
    stiffness: Stiffness | None = Field(None, gt=0, description="constant radial stiffness instead", examples=["4.5e8 N/m"])
    law: Literal["elements", "liu", "palmgren"] = Field(
        "elements",
        description="how the bearing yields: by its rolling elements; or by a formula of its catalogue numbers, F ~ d^n: "
        "liu (the paper's, taken as the tangent that it is) or palmgren",
    )
    radial_clearance: Length | None = Field(
        None,
        ge=0,
        description="across the diameter, instead of the bearing's own; of a formula or a stiffness, which has none of its own, besides",
        examples=["10 um"],
    )
    dynamic_rating: Force | None = Field(None, gt=0, description="basic dynamic load rating C, instead of the bearing's own")
    static_rating: Force | None = Field(None, gt=0, description="basic static load rating C0, instead of the bearing's own")


class IndexerShafts(Spec):
    """The two split shafts with their crank pins, alike; along each: gear, front support, cams, rear support."""

    overhang: Length = Field(gt=0, description="gear to front support", examples=["25 mm"])
    front: Length = Field(gt=0, description="front support to the first cam", examples=["25 mm"])
    pitch: Length = Field(gt=0, description="cam to cam", examples=["25 mm"])
    rear: Length = Field(gt=0, description="last cam to rear support", examples=["25 mm"])
    diameters: tuple[Diameter, Diameter, Diameter, Diameter] = Field(
        description="along those four stretches", examples=[["20 mm", "25 mm", "30 mm", "25 mm"]]
    )
    youngs_modulus: Pressure = Field("206 GPa", gt=0, description="Young's modulus")
    shear_modulus: Pressure = Field("79.3 GPa", gt=0, description="shear modulus")


class IndexerGear(Spec):
    """The gears from the input to the split shafts, all alike; without this table the split shafts are held where they would sit."""

    module: Length = Field(gt=0, description="module", examples=["2.5 mm"])
    teeth: Integer = Field(gt=3, description="teeth of each gear", examples=[22])
    stiffness: Stiffness = Field(gt=0, description="of one mesh along its line of action", examples=["2.8e8 N/m"])
    pressure_angle: Angle = Field("20 deg", ge=0, lt=1.0, description="pressure angle")
    backlash: Length = Field("0 mm", ge=0, description="along the line of action")


class IndexerHousing(Spec):
    """What holds supports, wheel and cam."""

    support_stiffness: Stiffness | None = Field(
        None, gt=0, description="of a seat of a support bearing; rigid unless given", examples=["5e8 N/m"]
    )
    wheel_stiffness: Stiffness | None = Field(
        None, gt=0, description="of the wheel's own bearing, radially; rigid unless given", examples=["1e9 N/m"]
    )
    wheel_torsion: RotationalStiffness | None = Field(
        None, gt=0, description="of the wheel between pins and output; rigid unless given", examples=["1e7 N m/rad"]
    )
    cam_stiffness: Stiffness | None = Field(
        None,
        gt=0,
        description="of the bearings of the cam's shaft, in all directions; parallel, barrel, globoidal; rigid unless given",
        examples=["5e8 N/m"],
    )
    input_torsion: RotationalStiffness | None = Field(
        None, gt=0, description="of the shaft from the locked input to the cam; parallel, barrel, globoidal; rigid unless given"
    )


class IndexerLimits(Spec):
    """Requirements; each becomes a check."""

    play: Angle = Field("1 arcmin", ge=0, description="free rotation of the wheel in either direction, over the whole cycle")
    pressure_angle: Angle = Field("60 deg", gt=0, lt=TURN / 4, description="of the pin that is best placed, at every input angle")
    static_safety: Number = Field(1.0, gt=0, description="static rating of a bearing over its largest load")
    life: Time | None = Field(None, gt=0, description="basic life of every bearing", examples=["20000 h"])
    contact_pressure: Pressure | None = Field(None, gt=0, description="allowable Hertz pressure on pins; the material's unless given")
    curvature_ratio: Number = Field(1.0, ge=1, description="least convex radius of the centre curve over the pin's radius")
    stiffness: RotationalStiffness | None = Field(None, gt=0, description="least torsional stiffness", examples=["2e5 N m/rad"])
    wall: Length = Field("3 mm", ge=0, description="least wall between the bearing holes of a cam, and to its profile")


class IndexerSpec(MechanismSpec):
    """An indexing drive."""

    mechanism: Literal["indexer"] = Field("indexer", description="kind of drive")
    kind: Literal["pin-wheel", "cycloid", "parallel", "barrel", "globoidal"] = Field(
        "pin-wheel",
        description="pin-wheel: cams that translate on cranks; cycloid: the same, uniform; parallel: two plate cams; barrel, "
        "globoidal: roller gears",
    )
    pins: Integer = Field(ge=3, le=200, description="pins (rollers) of the wheel, of one level where it has two", examples=[12])
    stations: Integer | None = Field(
        None,
        ge=1,
        description="steps in a turn of the wheel, as many as pins unless given; divides pins: a step passes pins/stations of them",
        examples=[4],
    )
    pin_phase: Number | None = Field(
        None,
        description="place of a pin in the dwell, in pitches ahead of the line to the cam's axis (of the crank), 0 to below 1; by the kind "
        "unless given",
        examples=[0.4],
    )
    pin_circle_radius: Length = Field(gt=0, description="radius on which the pins sit", examples=["120 mm"])
    pin_radius: Length = Field(gt=0, description="radius of a pin", examples=["8 mm"])
    eccentricity: Length | None = Field(None, gt=0, description="of the cranks; pin-wheel and cycloid", examples=["10 mm"])
    cams: Integer = Field(2, ge=1, le=4, description="cams on the cranks, evenly phased; pin-wheel and cycloid")
    side: Literal["inside", "outside"] = Field(
        "inside", description="pin-wheel and cycloid: cams inside the pins (a lobe less than pins) or around them (a lobe more)"
    )
    cam_width: Length = Field("18 mm", gt=0, description="thickness of a cam; plane kinds")
    centre_distance: Length | None = Field(None, gt=0, description="of wheel and cam; parallel, barrel, globoidal", examples=["150 mm"])
    pin_length: Length | None = Field(None, gt=0, description="working length of a roller; barrel and globoidal", examples=["16 mm"])
    cam_length: Length | None = Field(None, gt=0, description="length of the cam along its axis; barrel and globoidal", examples=["60 mm"])
    cam_radius: Length | None = Field(
        None, gt=0, description="from the axis of a barrel to the middle of its rollers' length", examples=["50 mm"]
    )
    hand: Literal["right", "left"] = Field("right", description="of the cam; barrel and globoidal")
    shaft_spacing: Length | None = Field(
        None, gt=0, description="distance of the two split shafts; pin-wheel and cycloid", examples=["110 mm"]
    )
    catalogue: DataFile | None = Field(None, description="a catalogue of rolling bearings of your own (TOML), beside ours")
    motion: IndexerMotion = Field(IndexerMotion(), description="motion of the wheel")
    load: IndexerLoad = Field(IndexerLoad(), description="load")
    table: IndexerTable | None = Field(None, description="dial table, for the torque at the input")
    motor: IndexerMotor | None = Field(None, description="motor at the input")
    contact: IndexerContact = Field(IndexerContact(), description="contact of pins and cams")
    crank_bearings: IndexerBearings | None = Field(None, description="between cams and crank pins; rigid unless given")
    support_bearings: IndexerBearings | None = Field(None, description="of the split shafts; rigid unless given")
    shafts: IndexerShafts | None = Field(None, description="split shafts; rigid unless given")
    gear: IndexerGear | None = Field(None, description="gears; without it no deflection and no backlash of gears")
    housing: IndexerHousing | None = Field(None, description="housing and wheel; rigid unless given")
    bodies: Literal["rigid", "elastic"] = Field(
        "rigid",
        description="cams, pins and wheel in the stiffness: rigid, pins by contact.pin_stiffness; elastic: each contact yields as finite "
        "elements of its bodies do, and shafts shear (some 30 s once, extra fe)",
    )
    manufacture: Machining = Field(Machining(), description="milling of plate cams, for exports")
    limits: IndexerLimits = Field(IndexerLimits(), description="requirements")

    @model_validator(mode="after")
    def _refuse_impossible(self) -> Self:
        """SpecError for the first value that has no meaning whatever the other keys are."""
        if self.load.torque == 0:
            raise SpecError("0 N m: without a load there is no stiffness; give another torque, or leave it out", "load.torque")
        law = self.motion.law
        if law is not None and law not in motion.names():
            raise SpecError(str(UnknownName("motion law", law, motion.names())), "motion.law")
        return self
