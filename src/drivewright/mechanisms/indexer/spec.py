"""Spec of an indexing drive: wheel, cams, motion, load and elastic parts."""

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
        title="Motion law",
        description="motion law of the step: modified-sine (default), cycloidal, polynomial-345 ...; "
        "uniform: a full turn without dwell, as for a cycloid",
        examples=["modified-sine"],
    )
    motion_to_dwell: Number | Literal["no-dwell"] | None = Field(
        None, description=f'input angle of the step over that of the dwell; default 1; "{NO_DWELL}": a full turn', examples=[1.0]
    )
    file: DataFile | None = Field(
        None,
        title="Motion data file",
        description='CSV for law = "table" with the columns angle [deg] (input from the start of the step) and lift [deg] (wheel); the '
        "last row is the end of the step, so leave motion_to_dwell out",
    )
    points: tuple[tuple[Number, Number], ...] | None = Field(
        None,
        title="Spline points",
        description='points (u, s) for law = "spline": fractions of the motion angle and of the step, both from 0 to 1',
    )
    degree: Integer | None = Field(None, title="Spline degree", description="degree of a spline or table, 3 or 5; default 5")
    b: Number | None = Field(None, title="Parameter b", description='fraction of the sine ramps, for law = "scca"')
    c: Number | None = Field(None, title="Parameter c", description="fraction of constant acceleration (scca) or velocity (mcv)")
    d: Number | None = Field(None, title="Parameter d", description='fraction of the cosine, for law = "scca"')


class IndexerLoad(Spec):
    """The load on the wheel."""

    torque: Torque | None = Field(
        None,
        description="torque on the wheel, positive in the index direction; forces and stiffness are those at this torque",
        examples=["1000 N m"],
    )
    angle: Angle | None = Field(
        None, title="Input angle", description="single input angle to evaluate, instead of the whole index period", examples=["45 deg"]
    )
    speed: Speed | None = Field(
        None, gt=0, title="Input speed", description="speed of the input, for velocities and lives in hours", examples=["120 rpm"]
    )


class IndexerTable(Spec):
    """The dial table on the wheel and what turns with it; with load.speed it determines the torque at the input."""

    inertia: Inertia = Field(
        ge=0, description="moment of inertia of the table and all that turns with it, about the wheel's axis", examples=["2 kg m^2"]
    )
    friction_torque: Torque = Field(
        "0 N m", ge=0, description="friction torque on table and wheel, opposing their motion", examples=["20 N m"]
    )
    process_torque: Torque = Field(
        "0 N m", description="steady torque on the table against the index direction, in addition to friction; load.torque is not included"
    )


class IndexerMotor(Spec):
    """The motor at the input; without it, the torque is given at the input. The gears of [gear] are equal and do not change the torque."""

    ratio: Number = Field(1.0, gt=0, title="Speed ratio", description="speed of the motor over that of the input", examples=[20.0])
    efficiency: Number = Field(
        1.0, gt=0, le=1, description="efficiency of everything between table and motor: rollers, gears, reducer", examples=[0.85]
    )
    inertia: Inertia | None = Field(None, gt=0, description="moment of inertia of the motor, for the inertia ratio", examples=["5 kg cm^2"])
    rated_torque: Torque | None = Field(None, gt=0, description="torque that the motor delivers continuously", examples=["4 N m"])
    maximum_torque: Torque | None = Field(None, gt=0, description="torque that the motor delivers for a short time", examples=["12 N m"])


class IndexerContact(Spec):
    """Pins or rollers on the cams."""

    model: Literal["unilateral", "bonded"] = Field(
        "unilateral",
        title="Contact model",
        description="unilateral: pins only press, and gaps close; bonded: pins in contact also pull, as in the paper",
    )
    pin_stiffness: Stiffness | None = Field(
        None, gt=0, description="stiffness of a pin in its seats, in series with the contact; default rigid", examples=["5e8 N/m"]
    )
    interference: Length = Field(
        "0 mm", ge=0, description="interference of rollers and cams at assembly; for parallel, barrel and globoidal"
    )
    material: Text = Field(
        "100Cr6",
        description=f"material of pins and cams, for the contact pressure: {', '.join(materials.names())}",
        examples=list(materials.names()),
    )


class IndexerBearings(Spec):
    """Rolling bearings of one kind; give either bearing or stiffness."""

    bearing: Designation | None = Field(
        None,
        title="Bearing designation",
        description="designation in the catalogue, e.g. NU207E",
        examples=["NU207E"],
        json_schema_extra={"x-list": "bearings", "x-overrides": ["radial_clearance"]},
    )
    stiffness: Stiffness | None = Field(
        None, gt=0, title="Radial stiffness", description="constant radial stiffness, instead of a bearing", examples=["4.5e8 N/m"]
    )
    law: Literal["elements", "liu", "palmgren"] = Field(
        "elements",
        title="Deflection law",
        description="deflection law of the bearing: elements (its rolling elements), or a formula of its catalogue data, F ~ d^n: "
        "liu (of the paper, as a tangent stiffness) or palmgren",
    )
    radial_clearance: Length | None = Field(
        None,
        ge=0,
        description="diametral clearance, in place of the bearing's own; for a formula or a stiffness, which has none, in addition",
        examples=["10 um"],
    )
    dynamic_rating: Force | None = Field(None, gt=0, description="basic dynamic load rating C, in place of the bearing's own")
    static_rating: Force | None = Field(None, gt=0, description="basic static load rating C0, in place of the bearing's own")


class IndexerShafts(Spec):
    """The two equal split shafts with their crank pins; along each: gear, front support, cams, rear support."""

    overhang: Length = Field(
        gt=0, title="Gear to front support", description="distance from the gear to the front support", examples=["25 mm"]
    )
    front: Length = Field(
        gt=0, title="Front support to first cam", description="distance from the front support to the first cam", examples=["25 mm"]
    )
    pitch: Length = Field(gt=0, title="Cam pitch", description="distance from cam to cam", examples=["25 mm"])
    rear: Length = Field(
        gt=0, title="Last cam to rear support", description="distance from the last cam to the rear support", examples=["25 mm"]
    )
    diameters: tuple[Diameter, Diameter, Diameter, Diameter] = Field(
        title="Shaft diameters",
        description="diameters over those four lengths",
        examples=[["20 mm", "25 mm", "30 mm", "25 mm"]],
        json_schema_extra={"parts": ["overhang", "front", "pitch", "rear"]},
    )
    youngs_modulus: Pressure = Field("206 GPa", gt=0, description="Young's modulus")
    shear_modulus: Pressure = Field("79.3 GPa", gt=0, description="shear modulus")


class IndexerGear(Spec):
    """The equal gears from the input to the split shafts; without this table, the split shafts are held at the gear positions."""

    module: Length = Field(gt=0, description="module", examples=["2.5 mm"])
    teeth: Integer = Field(gt=3, title="Number of teeth", description="number of teeth of each gear", examples=[22])
    stiffness: Stiffness = Field(
        gt=0, title="Mesh stiffness", description="stiffness of one mesh along its line of action", examples=["2.8e8 N/m"]
    )
    pressure_angle: Angle = Field("20 deg", ge=0, lt=1.0, description="pressure angle")
    backlash: Length = Field("0 mm", ge=0, description="backlash along the line of action")


class IndexerHousing(Spec):
    """Housing and shafts that hold supports, wheel and cam."""

    support_stiffness: Stiffness | None = Field(
        None, gt=0, description="stiffness of the seat of a support bearing; default rigid", examples=["5e8 N/m"]
    )
    wheel_stiffness: Stiffness | None = Field(
        None,
        gt=0,
        title="Wheel bearing stiffness",
        description="radial stiffness of the wheel's own bearing; default rigid",
        examples=["1e9 N/m"],
    )
    wheel_torsion: RotationalStiffness | None = Field(
        None,
        gt=0,
        title="Torsional stiffness of the wheel",
        description="torsional stiffness of the wheel between pins and output; default rigid",
        examples=["1e7 N m/rad"],
    )
    cam_stiffness: Stiffness | None = Field(
        None,
        gt=0,
        title="Cam shaft bearing stiffness",
        description="stiffness of the cam shaft bearings in all directions; for parallel, barrel and globoidal; default rigid",
        examples=["5e8 N/m"],
    )
    input_torsion: RotationalStiffness | None = Field(
        None,
        gt=0,
        title="Torsional stiffness of the input",
        description="torsional stiffness of the shaft from the locked input to the cam; for parallel, barrel and globoidal; default rigid",
    )


class IndexerLimits(Spec):
    """Requirements; each becomes a check."""

    play: Angle = Field(
        "1 arcmin", ge=0, title="Maximum play", description="maximum free rotation of the wheel in either direction, over the whole cycle"
    )
    pressure_angle: Angle = Field(
        "60 deg",
        gt=0,
        lt=TURN / 4,
        title="Maximum pressure angle",
        description="maximum pressure angle, of the driving pin at every input angle",
    )
    static_safety: Number = Field(1.0, gt=0, description="minimum static rating of a bearing over its maximum load")
    life: Time | None = Field(None, gt=0, title="Bearing life", description="minimum basic life of every bearing", examples=["20000 h"])
    contact_pressure: Pressure | None = Field(None, gt=0, description="allowable Hertz pressure on pins; default that of the material")
    curvature_ratio: Number = Field(
        1.0, ge=1, title="Convex radius over pin radius", description="minimum convex radius of the pitch curve over the pin radius"
    )
    stiffness: RotationalStiffness | None = Field(
        None, gt=0, title="Minimum torsional stiffness", description="minimum torsional stiffness", examples=["2e5 N m/rad"]
    )
    wall: Length = Field(
        "3 mm", ge=0, title="Minimum wall", description="minimum wall between the bearing holes of a cam, and to its profile"
    )


class IndexerSpec(MechanismSpec):
    """An indexing drive."""

    mechanism: Literal["indexer"] = Field("indexer", description="kind of drive")
    kind: Literal["pin-wheel", "cycloid", "parallel", "barrel", "globoidal"] = Field(
        "pin-wheel",
        title="Kind of indexer",
        description="pin-wheel: cams that translate on cranks; cycloid: the same with uniform motion; parallel: two plate cams; "
        "barrel, globoidal: roller-gear cams",
    )
    pins: Integer = Field(
        ge=3,
        le=200,
        title="Number of pins",
        description="number of pins (rollers) of the wheel, on one level where it has two",
        examples=[12],
    )
    stations: Integer | None = Field(
        None,
        ge=1,
        title="Number of stations",
        description="steps per turn of the wheel; default the number of pins, which it must divide: a step passes pins/stations pins",
        examples=[4],
    )
    pin_phase: Number | None = Field(
        None,
        description="position of a pin in the dwell, in pitches ahead of the line to the axis of the cam (of the crank), 0 to below 1; the "
        "default depends on the kind",
        examples=[0.4],
    )
    pin_circle_radius: Length = Field(gt=0, description="radius of the circle of the pin centres", examples=["120 mm"])
    pin_radius: Length = Field(gt=0, description="radius of a pin", examples=["8 mm"])
    eccentricity: Length | None = Field(None, gt=0, description="eccentricity of the cranks; for pin-wheel and cycloid", examples=["10 mm"])
    cams: Integer = Field(
        2, ge=1, le=4, title="Number of cams", description="number of cams on the cranks, evenly phased; for pin-wheel and cycloid"
    )
    side: Literal["inside", "outside"] = Field(
        "inside",
        title="Side of the cams",
        description="for pin-wheel and cycloid: cams inside the pins (one lobe less than pins) or around them (one lobe more)",
    )
    cam_width: Length = Field("18 mm", gt=0, description="thickness of a plate cam; for pin-wheel, cycloid and parallel")
    centre_distance: Length | None = Field(
        None, gt=0, description="distance of the axes of wheel and cam; for parallel, barrel and globoidal", examples=["150 mm"]
    )
    pin_length: Length | None = Field(None, gt=0, description="working length of a roller; for barrel and globoidal", examples=["16 mm"])
    cam_length: Length | None = Field(
        None, gt=0, description="length of the cam along its axis; for barrel and globoidal", examples=["60 mm"]
    )
    cam_radius: Length | None = Field(
        None, gt=0, description="distance from the axis of a barrel cam to the middle of its rollers", examples=["50 mm"]
    )
    hand: Literal["right", "left"] = Field("right", title="Hand of the cam", description="hand of the cam; for barrel and globoidal")
    shaft_spacing: Length | None = Field(
        None, gt=0, description="distance of the two split shafts; for pin-wheel and cycloid", examples=["110 mm"]
    )
    catalogue: DataFile | None = Field(
        None, title="Bearing catalogue", description="your own catalogue of rolling bearings (TOML), in addition to the built-in one"
    )
    motion: IndexerMotion = Field(IndexerMotion(), description="motion of the wheel")
    load: IndexerLoad = Field(IndexerLoad(), description="load")
    table: IndexerTable | None = Field(None, description="dial table, for the torque at the input")
    motor: IndexerMotor | None = Field(None, description="motor at the input")
    contact: IndexerContact = Field(IndexerContact(), description="contact of pins and cams")
    crank_bearings: IndexerBearings | None = Field(None, description="bearings between cams and crank pins; default rigid")
    support_bearings: IndexerBearings | None = Field(None, description="bearings of the split shafts; default rigid")
    shafts: IndexerShafts | None = Field(None, description="split shafts; default rigid")
    gear: IndexerGear | None = Field(None, description="gears; without this table, gears neither deflect nor have backlash")
    housing: IndexerHousing | None = Field(None, description="housing and wheel; default rigid")
    bodies: Literal["rigid", "elastic"] = Field(
        "rigid",
        title="Model of the bodies",
        description="model of cams, pins and wheel for the stiffness: rigid, with contact.pin_stiffness; elastic, with the compliance of "
        "finite elements behind each contact and shear of the shafts (takes some 30 s once; needs the extra fe)",
    )
    manufacture: Machining = Field(Machining(), description="milling of plate cams, for exports")
    limits: IndexerLimits = Field(IndexerLimits(), description="requirements")

    @model_validator(mode="after")
    def _refuse_impossible(self) -> Self:
        """SpecError for the first value that has no meaning whatever the other keys are."""
        if self.load.torque == 0:
            raise SpecError("0 N·m gives no stiffness; give another torque, or leave it out", "load.torque")
        law = self.motion.law
        if law is not None and law not in motion.names():
            raise SpecError(str(UnknownName("motion law", law, motion.names())), "motion.law")
        return self
