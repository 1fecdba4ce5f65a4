"""Spec of a chain drive: links, joint, plates, sprockets, drive, and options of the analyses."""

from typing import TYPE_CHECKING, Annotated, Literal, TypeAlias

from pydantic import model_validator

from drivewright.chains.meshing import Ideal
from drivewright.chains.sizes import ChainSize, chain_size
from drivewright.errors import InputError, SpecError
from drivewright.fatigue.material import StrainLife
from drivewright.mechanisms.silent_chain.capacity_tables import Rating, Wear
from drivewright.plugins import installed
from drivewright.spec import Integer, MechanismSpec, Name, Number, Spec
from drivewright.spec.fields import Designation, Field
from drivewright.spec.length_or_rule import length_or_rule
from drivewright.units import Acceleration, Angle, Damping, Density, Force, Inertia, Length, Mass, Pressure, Speed, Stiffness, Time, Torque

if TYPE_CHECKING:
    ContactLaw: TypeAlias = str
else:
    ContactLaw = Literal[("kelvin-voigt", *sorted(installed("drivewright.contact_laws")))]
TURN = 6.283185307179586
FINEST = 3.0  # fineness of solids: beyond, memory and time run out
LEAST_TEETH = 6  # below, a polygon is no sprocket
PAIRS = ("asymmetric", "kidney", "rolling-pair")  # kinds of joints with two radii


Radius = Annotated[Length, Field(ge=0)]
Offset = Annotated[float | str, length_or_rule("match-drive", "minimax")]


class Joint(Spec):
    """What joins two plates."""

    kind: Literal["round-pin", "arc", "asymmetric", "kidney", "rolling-pair", "revolute"] | None = Field(
        None,
        title="Joint type",
        description="round-pin: two round pins that roll on each other; arc: rockers of a larger radius (classical Hy-Vo); asymmetric: pin "
        "and rocker of two radii; kidney: a pin in a hollow seat; rolling-pair: any two radii, a hollow one negative; revolute: a hinge "
        "with one pin; default round-pin, for a chain by number revolute",
        examples=["round-pin"],
    )
    rolling_radius: Length | None = Field(
        None, gt=0, description="radius of the rolling surfaces of the pins; not for a revolute joint", examples=["1.2 mm"]
    )
    seat_radius: Length | None = Field(
        None,
        description="radius of the second rolling surface of an asymmetric, kidney or rolling-pair joint, on the left side of a plate; "
        "rolling_radius is that on the right side",
        examples=["6 mm"],
    )
    offset: Offset = Field(
        "match-drive",
        title="Pin offset",
        description="distance of the pin centres below the pitch line, or a rule: match-drive, minimax; it affects only the measures of "
        "the published method",
    )
    contact_length: Length | None = Field(
        None,
        gt=0,
        description="contact length of the pins of one row, or length of a roller chain's bushes; default: the width of the plate pack",
        examples=["6 mm"],
    )
    pin_diameter: Length | None = Field(
        None, gt=0, description="diameter of the pin of a revolute joint; default: a quarter of the pitch", examples=["3 mm"]
    )


class Plate(Spec):
    """The toothed link plates of a silent chain."""

    flank_angle: Angle = Field("30 deg", gt=0, lt=TURN / 8, description="angle of the outer flank from the plate's axis of symmetry")
    apothem: Length | None = Field(
        None,
        description="distance from the centre of the pin's rolling surface to the flank on the same side; or give standard_apothem",
        examples=["2.6 mm"],
    )
    standard_apothem: Length | None = Field(
        None,
        gt=0,
        description="distance from the rotation centre on the pitch line to the flank, instead of apothem",
        examples=["3.773 mm"],
    )
    thickness: Length | None = Field(None, gt=0, description="thickness of a plate; default: 2 mm", examples=["2 mm"])
    lacing: tuple[Integer, Integer] = Field(
        (1, 2),
        description="number of plates side by side in one pitch and in the next",
        json_schema_extra={"parts": ["one pitch", "the next"]},
    )
    back: Length | None = Field(None, gt=0, description="height of the back above the pin line; default: 0.27 pitches", examples=["2.6 mm"])
    toe: Length | None = Field(
        None, lt=0, description="height of the toe ends relative to the pin line, negative; default: -0.63 pitches", examples=["-6 mm"]
    )
    crotch: Length | None = Field(
        None,
        lt=0,
        description="height of the crotch bottom relative to the pin line, negative; default: -0.15 pitches",
        examples=["-1.4 mm"],
    )
    crotch_radius: Length | None = Field(None, ge=0, description="radius of the crotch; default: 0.06 pitches", examples=["0.6 mm"])
    link_mass: Mass | None = Field(None, gt=0, description="mass of one pitch of chain; default: from plates and pins", examples=["2.5 g"])
    link_inertia: Inertia | None = Field(
        None,
        gt=0,
        description="moment of inertia of one pitch of chain about its centre of mass; default: from plates and pins",
        examples=["6.4e-8 kg m^2"],
    )


class Roller(Spec):
    """Rollers on the pins: the chain is a roller chain, its sprockets have arcs for teeth."""

    diameter: Length | None = Field(None, gt=0, description="diameter of the rollers; default: by the chain number", examples=["6.35 mm"])
    inner_width: Length | None = Field(
        None, gt=0, description="width between the inner plates; default: the length of the bushes", examples=["5.72 mm"]
    )
    tooth_space: Number = Field(
        0.5, ge=0, le=1, description="tooth gap form of the sprockets between the smallest (0) and the largest (1) of the standard"
    )


class Cutter(Spec):
    """The hob or rack cutter that makes the sprockets, and the teeth it leaves."""

    half_angle: Angle = Field("30 deg", gt=0, lt=TURN / 8, description="half the angle of the cutter's teeth")
    pitch: Length | None = Field(
        None, gt=0, description="pitch of the cutter's teeth; default: from the base pitch of the chain", examples=["9.525 mm"]
    )
    tip_rounding: Length | None = Field(
        None,
        gt=0,
        description="radius of the cutter's tip; default: a quarter of its module, or the largest that fits",
        examples=["0.5 mm"],
    )
    tip_depth: Length | None = Field(
        None, description="distance of the tooth tips below the pin line of a seated plate; default: 0.18 pitches", examples=["1.7 mm"]
    )
    root_depth: Length | None = Field(
        None,
        gt=0,
        description="distance of the tooth roots below the pin line of a seated plate; default: 0.68 pitches",
        examples=["6.5 mm"],
    )
    chamfer: Length | None = Field(None, ge=0, description="chamfer of the tooth tips; default: 0.02 pitches", examples=["0.2 mm"])
    bore: Length | None = Field(
        None,
        ge=0,
        description="bore diameter of the sprockets, for drawings and masses; default: 0.4 times the smaller pitch diameter",
        examples=["20 mm"],
    )
    measuring_pin: Length | None = Field(
        None, gt=0, title="Measuring pin diameter", description="default: touches the flanks where the plates do", examples=["6 mm"]
    )


class Meshing(Spec):
    """Readings of the published method."""

    ideal: Ideal = Field(
        "seat",
        title="Ideal pitch",
        description="definition of the ideal pitch: seat, p/cos(pi/z) of the paper; rack, p tan(t)/t, conjugate on the pitch circle",
    )
    apothem_reference: Literal["pitch_line", "pin"] = Field(
        "pitch_line",
        description="origin of the apothem: pitch_line; or pin, the other reading of equation (2), with which the teeth are cut too thin",
    )


class Drive(Spec):
    """Speed and loads."""

    speed: Speed = Field(gt=0, description="speed of the driving sprocket", examples=["2000 rpm"])
    preload: Force | None = Field(
        None,
        gt=0,
        description="outward force on the driven sprocket, half of it in each strand; not for a fixed centre distance",
        examples=["150 N"],
    )
    load_torque: Torque = Field("0 N m", description="load torque on the driven sprocket; negative where it drives")
    reversing: bool = Field(
        False, description="whether the drive also runs in the other sense of rotation under the same load, where the tight strand changes"
    )
    ramp: Time = Field(
        "0 s", ge=0, title="Ramp time", description="time in which the speed is reached from rest; 0: the run begins at speed"
    )
    gravity: tuple[Acceleration, Acceleration] = Field(
        ("0 m/s^2", "0 m/s^2"), description="gravity along x, from the driving to the driven sprocket, and along y"
    )


class Driven(Spec):
    """The driven sprocket as a body."""

    mass: Mass | None = Field(
        None, gt=0, description="mass of the sprocket; default: a steel disc as wide as the chain", examples=["0.6 kg"]
    )
    inertia: Inertia | None = Field(
        None, gt=0, description="moment of inertia about its axis; default: that of the disc", examples=["9.3e-4 kg m^2"]
    )
    damping_ratio: Number = Field(
        0.1,
        ge=0,
        description="damping ratio of its slide and, except while the speed ramps up, of its rotation about the nominal speed, on the "
        "stiffness of the strands",
    )
    centre_distance: Length | None = Field(
        None, gt=0, description="fixed centre distance, instead of a slide under the preload", examples=["219.056 mm"]
    )


class Tensioner(Spec):
    """What presses on the chain by a spring, on a slide or about a pivot."""

    force: Force | None = Field(
        None,
        gt=0,
        description="spring force of a tensioner on the chain at the given position; without it the body is fixed",
        examples=["50 N"],
    )
    direction: Angle | None = Field(None, description="direction in which a tensioner moves on its slide", examples=["-90 deg"])
    pivot: tuple[Length, Length] | None = Field(
        None, description="x, y of the pivot about which a tensioner turns, instead of a slide", examples=[["20 mm", "70 mm"]]
    )
    stiffness: Stiffness = Field("0 N/m", ge=0, description="spring stiffness of a tensioner")
    damping: Damping = Field("50 N s/m", ge=0, description="damping of a tensioner")
    travel: Length | None = Field(
        None, gt=0, description="largest travel of a tensioner from the given position, either way", examples=["15 mm"]
    )


class Sprocket(Tensioner):
    """A further sprocket; sprung, it is a tensioner."""

    name: Name = Field(description="name", examples=["idler"])
    teeth: Integer = Field(ge=6, description="number of teeth", examples=[21])
    centre: tuple[Length, Length] = Field(description="x, y of the centre from the driving sprocket", examples=[["100 mm", "60 mm"]])
    side: Literal["outside", "inside"] = Field("inside", description="side of the chain loop; outside: on the back of a roller chain")
    mass: Mass | None = Field(
        None, gt=0, description="mass of the sprocket; default: a steel disc as wide as the chain", examples=["0.3 kg"]
    )
    inertia: Inertia | None = Field(
        None, gt=0, description="moment of inertia about its axis; default: that of the disc", examples=["1e-4 kg m^2"]
    )
    load_torque: Torque = Field("0 N m", description="load torque on the sprocket")


class Guide(Tensioner):
    """A curved rail that the plates slide on; sprung, it is a tensioner."""

    name: Name = Field(description="name", examples=["tensioner"])
    centre: tuple[Length, Length] = Field(
        description="x, y of the centre of the arc from the driving sprocket", examples=[["110 mm", "350 mm"]]
    )
    radius: Length = Field(gt=0, description="radius of the arc", examples=["300 mm"])
    start: Angle = Field(description="polar angle where the arc begins, counter-clockwise from x", examples=["255 deg"])
    end: Angle = Field(description="polar angle where the arc ends", examples=["285 deg"])
    side: Literal["outside", "inside"] = Field(
        "outside", description="side of the chain loop: outside touches the backs of the plates, inside the toes"
    )
    friction: Number = Field(0.0, ge=0, description="coefficient of Coulomb friction")
    mass: Mass = Field("50 g", gt=0, description="mass of a tensioner; on a pivot, its moment of inertia over the square of the lever")
    lever: Length | None = Field(
        None,
        gt=0,
        description="distance from the pivot to the point where the spring acts; default: to the middle of the arc",
        examples=["120 mm"],
    )


class Closure(Spec):
    """Centre distance and transmission error without dynamics."""

    strands: Literal["straight", "equilibrium"] = Field(
        "equilibrium",
        description="shape of the free strands: straight, plates in one line; equilibrium, each plate in equilibrium under the tension",
    )
    elongation: Number = Field(0.0, ge=-0.02, le=0.05, description="elongation of the chain by wear, relative to its pitch")


class Contact(Spec):
    """Pins on each other, plates on teeth."""

    force: Force | None = Field(
        None, gt=0, description="force of the strand on the pins; default: the strand tension by [drive]", examples=["200 N"]
    )
    stiffness: Stiffness = Field(
        "1e5 N/mm",
        gt=0,
        description="stiffness of one contact: flank on tooth, plate on pin, pin on pin; a joint is three of these in series",
    )
    damping: Damping | None = Field(
        None, ge=0, description="damping of the contact of flank and tooth; default: joint_damping times stiffness", examples=["200 N s/m"]
    )
    law: ContactLaw = Field(
        "kelvin-voigt",
        description="contact law of flank, roller or rail; kelvin-voigt: linear spring and damper; further laws by installed packages",
    )
    joint_damping: Time = Field("2 us", ge=0, description="damping of a joint over its stiffness")
    articulation_damping_ratio: Number | None = Field(
        None,
        ge=0,
        description="damping ratio of the articulation between neighbouring plates, by friction and oil in the joint, for a plate that "
        "oscillates between its joints; default: 0.003 for rolling pins, 0.02 for a hinge",
        examples=[0.003],
    )


class Dynamics(Spec):
    """The run of the moving chain."""

    integrator: Literal["explicit", "implicit"] = Field(
        "explicit", description="time integration; implicit: for damping or contact stiffness that would require very short explicit steps"
    )
    step: Time | None = Field(None, gt=0, description="time step; default: 1 µs (explicit)", examples=["1 us"])
    settling: Time = Field("50 ms", ge=0, description="time before the statistics begin")
    duration: Time | None = Field(None, gt=0, description="evaluated time; default: two revolutions of the chain", examples=["0.25 s"])
    ensemble: Integer = Field(
        4, ge=1, le=64, description="number of runs whose starts differ by nanometres, for the intervals of the statistics"
    )
    thickness_deviation: Length = Field("0 mm", description="thickness deviation of all teeth per flank; positive: too thick")
    largest_drift: Number = Field(
        1e-3, gt=0, description="largest drift of the energy balance per second, relative to the stored energy; above it the run has failed"
    )


class Compare(Spec):
    """Comparison designs; empty lists are chosen around this design."""

    rolling_radii: tuple[Radius, ...] = Field(
        (),
        max_length=40,
        description="rolling radii of the trade-off and of the phase map",
        examples=[["1.0 mm", "1.2 mm", "1.6 mm", "7.4 mm"]],
    )
    links: tuple[Integer, ...] = Field((), max_length=60, description="numbers of links of the phase map", examples=[[80, 81, 82, 83, 84]])
    driven_teeth: tuple[Integer, ...] = Field(
        (), max_length=20, description="teeth of the driven sprocket in the phase map", examples=[[35, 36, 37]]
    )
    speeds: tuple[Speed, ...] = Field(
        (),
        max_length=60,
        description="speeds of the driving sprocket for the Campbell diagram",
        examples=[["500 rpm", "1000 rpm", "2000 rpm"]],
    )


class Scatter(Spec):
    """Manufacturing scatter, normally distributed, by standard deviations."""

    tooth_thickness: Length = Field(
        "2 um", ge=0, description="standard deviation of the flank position, the same for all teeth of a sprocket"
    )
    pitch: Length = Field("2 um", ge=0, description="standard deviation of the hole pitch of each plate")
    samples: Integer = Field(20, ge=3, le=5000, description="number of drives")
    seed: Integer = Field(0, ge=0, description="seed of the random numbers")


class Fatigue(Spec):
    """Stress and life of the plates."""

    card: StrainLife | None = Field(None, description="strain-life data; default: estimated from the tensile strength")
    plane: Literal["max-shear", "max-damage"] = Field(
        "max-shear",
        description="critical plane: that of the maximum shear strain range, exact for uniaxial tests, or that of the maximum damage",
    )
    fineness: Number = Field(1.0, ge=0.3, le=4, description="mesh refinement: 2 halves the size of all elements")


class Solid(Spec):
    """Plate and pins as elastic solids in contact (extra fe)."""

    clearance: Length = Field("5 um", ge=0, description="radial clearance of a pin in its own hole")
    edge_radius: Length = Field("50 um", ge=0, description="radius of the rounded edges of a hole")
    seat: Angle | None = Field(
        None,
        gt=0,
        title="Seat half-angle",
        description="half the angle about the outer direction over which a pin bears; default: its whole seat",
        examples=["45 deg"],
    )
    friction: Number = Field(
        0.0, ge=0, le=1, description="coefficient of friction between a pin and its seat; a value above 0 doubles the computing time"
    )
    load_steps: Integer = Field(
        24,
        ge=2,
        le=500,
        description="number of instants of a revolution of the chain, including those with the largest and smallest forces",
    )
    fineness: Number = Field(1.0, ge=0.7, le=FINEST, description="mesh refinement: 2 halves the size of all elements")


class Limits(Spec):
    """Requirements; each becomes a check."""

    teeth: Integer = Field(8, ge=3, description="minimum number of teeth of a sprocket")
    wrap: Angle = Field("120 deg", ge=0, description="minimum wrap angle of driving and driven sprocket")
    contact_share: Number = Field(
        0.2, ge=0, le=1, description="minimum number of tooth contacts for each link on a sprocket; fewer contacts mean overspeed"
    )
    slack_share: Number = Field(0.05, ge=0, le=1, description="maximum share of time in which three or more joints have no tension at once")
    shakedown_safety: Number = Field(1.0, gt=0, description="minimum of the shakedown limit of the pins over their Hertz pressure")
    yield_safety: Number = Field(1.0, gt=0, description="minimum of the yield strength over the von Mises stress of pins and plates")
    wall: Length = Field("0.5 mm", ge=0, description="minimum wall thickness of a plate around and between its holes")
    tip_thickness: Length = Field("0.3 mm", ge=0, description="minimum thickness of the teeth at their tips")
    static_safety: Number = Field(6.0, gt=0, description="minimum of the breaking load over the tension of the tight strand")
    wear_life: Time | None = Field(
        None, gt=0, description="minimum time until wear elongates the chain to its elongation limit", examples=["5000 h"]
    )
    overlap: Length = Field("5 um", ge=0, description="maximum overlap of plates with teeth, seated or engaging")


class Material(Spec):
    """Material of plates and pins; the default is 38CrMoAl, recalled except for the yield strength."""

    youngs_modulus: Pressure = Field("206 GPa", gt=0, description="Young's modulus")
    poisson_ratio: Number = Field(0.3, gt=-1, lt=0.5, description="Poisson's ratio")
    density: Density = Field("7850 kg/m^3", gt=0, description="density")
    yield_strength: Pressure = Field("835 MPa", gt=0, description="yield strength")
    tensile_strength: Pressure = Field("980 MPa", gt=0, description="tensile strength")


class SilentChainSpec(MechanismSpec):
    """A chain drive."""

    mechanism: Literal["silent-chain"] = Field("silent-chain", description="kind of drive")
    chain: Designation | None = Field(
        None,
        title="Chain number",
        description="number of a roller chain, e.g. 08B, 16B-2 or ANSI 40: supplies pitch, roller, pin, plate, mass and breaking load "
        "where they are not given",
        examples=["08B"],
    )
    pitch: Length | None = Field(None, gt=0, description="pitch of the straight chain; default: by the chain number", examples=["9.525 mm"])
    links: Integer = Field(ge=6, le=2000, title="Number of links", description="number of links (pitches)", examples=[82])
    teeth: tuple[Integer, Integer] = Field(
        title="Numbers of teeth",
        description="numbers of teeth of the driving and the driven sprocket",
        examples=[[35, 37]],
        json_schema_extra={"parts": ["driving", "driven"]},
    )
    rows: Integer | None = Field(None, ge=1, le=8, description="number of rows side by side on common pins; default: 1", examples=[2])
    row_pitch: Length | None = Field(
        None, gt=0, description="distance between the middle planes of the rows; default: the width of one row", examples=["13.92 mm"]
    )
    row_phase: Number = Field(
        0.0,
        ge=0,
        lt=1,
        description="lead of the teeth of the second row as a share of the pitch, each row being a separate chain; 0: rows on common pins",
        examples=[0.5],
    )
    breaking_load: Force | None = Field(
        None, gt=0, description="minimum tensile strength of the chain, all rows together", examples=["17.8 kN"]
    )
    joint: Joint = Field(Joint(), description="joint of the plates")
    plate: Plate = Field(Plate(), description="link plates of a silent chain")
    roller: Roller | None = Field(None, description="rollers of a roller chain; without this table the plates mesh (silent chain)")
    cutter: Cutter = Field(Cutter(), description="cutter of the sprockets")
    meshing: Meshing = Field(Meshing(), description="options of the published method")
    drive: Drive | None = Field(None, description="speed and loads, required for dynamics, stress and life")
    driven: Driven = Field(Driven(), description="driven sprocket")
    sprockets: tuple[Sprocket, ...] = Field((), description="further sprockets, in any order")
    guides: tuple[Guide, ...] = Field((), description="guides and tensioners")
    closure: Closure = Field(Closure(), description="closure of the rigid chain")
    contact: Contact = Field(Contact(), description="stiffness and damping of the contacts")
    dynamics: Dynamics = Field(Dynamics(), description="run of the moving chain")
    material: Material = Field(Material(), description="material of plates and pins")
    compare: Compare = Field(Compare(), description="comparison designs")
    scatter: Scatter = Field(Scatter(), description="manufacturing scatter")
    fatigue: Fatigue = Field(Fatigue(), description="stress and life of the plates")
    solid: Solid = Field(Solid(), description="plate and pins as solids")
    wear: Wear | None = Field(None, description="wear of the joints")
    rating: Rating = Field(Rating(), description="power rating")
    limits: Limits = Field(Limits(), description="requirements")

    @property
    def meshes_rollers(self) -> bool:
        """Whether it is a roller chain: by its table, or by its number."""
        return self.roller is not None or self.chain is not None

    @model_validator(mode="after")
    def _has_a_meaning(self):
        _refuse_nonsense(self)
        return self


def _refuse_nonsense(spec: SilentChainSpec) -> None:
    """SpecError for the first thing that has no meaning."""
    if spec.pitch is None and spec.chain is None:
        raise SpecError('is missing; give it, or the number of a roller chain, e.g. chain = "08B"', "pitch")
    size_of(spec)
    for number, teeth in enumerate(spec.teeth):
        if teeth < LEAST_TEETH:
            raise SpecError(f"{teeth} teeth are too few for a sprocket; choose {LEAST_TEETH} or more", f"teeth.{number}")
    if spec.links <= max(spec.teeth):
        raise SpecError(
            f"{spec.links} links do not reach around two sprockets, of which one has {max(spec.teeth)} teeth; "
            f"choose {max(spec.teeth) + 4} or more",
            "links",
        )
    for table in ("guides", "sprockets"):
        names = [entry.name for entry in getattr(spec, table)]
        for name in names:
            if names.count(name) > 1:
                raise SpecError(f"the name {name!r} is used twice; choose different names in {table}", f"{table}.{name}.name")
    if min(spec.plate.lacing) < 1:
        raise SpecError(f"lacing {list(spec.plate.lacing)} has a pitch without a plate; give one or more in each", "plate.lacing")


def signed_seat(joint: Joint) -> float:
    """Radius of the left rolling surface of a joint of two radii, negative where it is hollow  [m]."""
    assert joint.seat_radius is not None
    return -joint.seat_radius if joint.kind == "kidney" else joint.seat_radius


def size_of(spec: SilentChainSpec) -> ChainSize | None:
    """What the number of the chain says; None where there is none, SpecError where it is unknown."""
    try:
        return None if spec.chain is None else chain_size(spec.chain)
    except InputError as error:
        raise SpecError(str(error), "chain") from None
