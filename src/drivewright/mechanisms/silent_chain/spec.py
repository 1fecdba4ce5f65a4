"""What the user says of a chain drive: links, joint, plates, sprockets, drive, how it is computed."""

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
        description="round-pin: two round pins that roll on each other; arc: rockers of a larger radius (classical Hy-Vo); asymmetric: pin "
        "and rocker of two radii; kidney: a pin in a hollow seat; rolling-pair: any two radii, a hollow one negative; revolute: one pin, a "
        "hinge; round-pin unless given, revolute of a chain by number",
        examples=["round-pin"],
    )
    rolling_radius: Length | None = Field(None, gt=0, description="of the rolling surfaces; not for a revolute joint", examples=["1.2 mm"])
    seat_radius: Length | None = Field(
        None,
        description="of the other rolling surface of an asymmetric, kidney or rolling-pair joint, on the left of a plate; rolling_radius "
        "is that on the right",
        examples=["6 mm"],
    )
    offset: Offset = Field(
        "match-drive",
        description="centre of the pins below the pitch line, or its rule: match-drive, minimax; a label, nothing physical depends on it",
    )
    contact_length: Length | None = Field(
        None,
        gt=0,
        description="length along which the pins touch, or of a roller chain's bushes, of one row; the width of the pack of plates "
        "unless given",
        examples=["6 mm"],
    )
    pin_diameter: Length | None = Field(
        None, gt=0, description="of the pin of a revolute joint; a quarter of the pitch unless given", examples=["3 mm"]
    )


class Plate(Spec):
    """The toothed link plates of a silent chain."""

    flank_angle: Angle = Field("30 deg", gt=0, lt=TURN / 8, description="of the outer flank from the plate's axis of symmetry")
    apothem: Length | None = Field(
        None, description="centre of the pin's rolling surface to the flank on the same side; or give standard_apothem", examples=["2.6 mm"]
    )
    standard_apothem: Length | None = Field(
        None, gt=0, description="rotation centre on the pitch line to flank, instead of apothem", examples=["3.773 mm"]
    )
    thickness: Length | None = Field(None, gt=0, description="of a plate; 2 mm unless given", examples=["2 mm"])
    lacing: tuple[Integer, Integer] = Field((1, 2), description="plates side by side in one pitch and in the next")
    back: Length | None = Field(
        None, gt=0, description="height of the back above the pin line; 0.27 pitches unless given", examples=["2.6 mm"]
    )
    toe: Length | None = Field(
        None, lt=0, description="ends of the toes below the pin line; -0.63 pitches unless given", examples=["-6 mm"]
    )
    crotch: Length | None = Field(
        None, lt=0, description="bottom of the crotch below the pin line; -0.15 pitches unless given", examples=["-1.4 mm"]
    )
    crotch_radius: Length | None = Field(None, ge=0, description="rounding of the crotch; 0.06 pitches unless given", examples=["0.6 mm"])
    link_mass: Mass | None = Field(None, gt=0, description="of a pitch of chain; from plates and pins unless given", examples=["2.5 g"])
    link_inertia: Inertia | None = Field(
        None,
        gt=0,
        description="of a pitch of chain about its centre of mass; from plates and pins unless given",
        examples=["6.4e-8 kg m^2"],
    )


class Roller(Spec):
    """Rollers on the pins: the chain is a roller chain, its sprockets have arcs for teeth."""

    diameter: Length | None = Field(None, gt=0, description="of the rollers; by the chain's number unless given", examples=["6.35 mm"])
    inner_width: Length | None = Field(
        None, gt=0, description="between the inner plates; the length of the bushes unless given", examples=["5.72 mm"]
    )
    tooth_space: Number = Field(0.5, ge=0, le=1, description="form of the sprockets' spaces between the smallest (0) and the largest (1)")


class Cutter(Spec):
    """The hob or rack cutter that makes the sprockets, and the teeth it leaves."""

    half_angle: Angle = Field("30 deg", gt=0, lt=TURN / 8, description="half the angle of its teeth")
    pitch: Length | None = Field(None, gt=0, description="of its teeth; from the chain's base pitch unless given", examples=["9.525 mm"])
    tip_rounding: Length | None = Field(
        None, gt=0, description="of its tip; a quarter of its module, or what has room, unless given", examples=["0.5 mm"]
    )
    tip_depth: Length | None = Field(
        None, description="tips of the teeth below the pin line of a seated plate; 0.18 pitches unless given", examples=["1.7 mm"]
    )
    root_depth: Length | None = Field(None, gt=0, description="roots of the teeth below it; 0.68 pitches unless given", examples=["6.5 mm"])
    chamfer: Length | None = Field(None, ge=0, description="of the tips; 0.02 pitches unless given", examples=["0.2 mm"])
    bore: Length | None = Field(
        None,
        ge=0,
        description="diameter of the holes of the sprockets, for drawings and masses; 0.4 of the smaller pitch circle unless given",
        examples=["20 mm"],
    )
    measuring_pin: Length | None = Field(
        None, gt=0, description="diameter; that which touches where the plates do unless given", examples=["6 mm"]
    )


class Meshing(Spec):
    """Readings of the published method."""

    ideal: Ideal = Field("seat", description="ideal pitch: seat p/cos(pi/z), the paper's; rack p tan(t)/t, conjugate on the pitch circle")
    apothem_reference: Literal["pitch_line", "pin"] = Field(
        "pitch_line", description="where the apothem counts from; pin is the other reading of equation (2), and cuts the teeth too thin"
    )


class Drive(Spec):
    """Speed and loads."""

    speed: Speed = Field(gt=0, description="of the driving sprocket", examples=["2000 rpm"])
    preload: Force | None = Field(
        None,
        gt=0,
        description="outward force on the driven sprocket; each strand carries half of it; not for a fixed centre distance",
        examples=["150 N"],
    )
    load_torque: Torque = Field("0 N m", description="that the driven sprocket has to overcome; below 0 it drives")
    reversing: bool = Field(False, description="whether it also runs the other way under the same load: both strands are tight in turn")
    ramp: Time = Field("0 s", ge=0, description="time in which the speed is reached from rest; 0: the run begins at speed")
    gravity: tuple[Acceleration, Acceleration] = Field(
        ("0 m/s^2", "0 m/s^2"), description="along x, from the driving to the driven sprocket, and y"
    )


class Driven(Spec):
    """The driven sprocket as a body."""

    mass: Mass | None = Field(None, gt=0, description="a steel disc as wide as the chain unless given", examples=["0.6 kg"])
    inertia: Inertia | None = Field(None, gt=0, description="about its axis; that of the disc unless given", examples=["9.3e-4 kg m^2"])
    damping_ratio: Number = Field(
        0.1,
        ge=0,
        description="of its slide and, but while the speed ramps up, of its rotation about the nominal "
        "speed; over critical, on the strands",
    )
    centre_distance: Length | None = Field(
        None, gt=0, description="a fixed one, instead of the slide under the preload", examples=["219.056 mm"]
    )


class Tensioner(Spec):
    """What presses on the chain by a spring, on a slide or about a pivot."""

    force: Force | None = Field(
        None, gt=0, description="of a tensioner's spring at the given place, on the chain; fixed unless given", examples=["50 N"]
    )
    direction: Angle | None = Field(None, description="in which a tensioner moves on a slide", examples=["-90 deg"])
    pivot: tuple[Length, Length] | None = Field(
        None, description="x, y about which a tensioner turns, instead of a slide", examples=[["20 mm", "70 mm"]]
    )
    stiffness: Stiffness = Field("0 N/m", ge=0, description="of a tensioner's spring")
    damping: Damping = Field("50 N s/m", ge=0, description="of a tensioner")
    travel: Length | None = Field(
        None, gt=0, description="of a tensioner from the given place, as far as there is room", examples=["15 mm"]
    )


class Sprocket(Tensioner):
    """A further sprocket; sprung, it is a tensioner."""

    name: Name = Field(description="name", examples=["idler"])
    teeth: Integer = Field(ge=6, description="teeth", examples=[21])
    centre: tuple[Length, Length] = Field(description="x, y from the driving sprocket", examples=[["100 mm", "60 mm"]])
    side: Literal["outside", "inside"] = Field("inside", description="of the loop; outside, on the back of a roller chain")
    mass: Mass | None = Field(None, gt=0, description="a steel disc as wide as the chain unless given", examples=["0.3 kg"])
    inertia: Inertia | None = Field(None, gt=0, description="about its axis; that of the disc unless given", examples=["1e-4 kg m^2"])
    load_torque: Torque = Field("0 N m", description="that it has to overcome")


class Guide(Tensioner):
    """A curved rail that the plates slide on; sprung, it is a tensioner."""

    name: Name = Field(description="name", examples=["tensioner"])
    centre: tuple[Length, Length] = Field(description="of its arc: x, y from the driving sprocket", examples=[["110 mm", "350 mm"]])
    radius: Length = Field(gt=0, description="of its arc", examples=["300 mm"])
    start: Angle = Field(description="polar angle where the arc begins, counter-clockwise from x", examples=["255 deg"])
    end: Angle = Field(description="polar angle where it ends", examples=["285 deg"])
    side: Literal["outside", "inside"] = Field("outside", description="of the loop: touches the backs or the toes of the plates")
    friction: Number = Field(0.0, ge=0, description="coefficient of Coulomb friction")
    mass: Mass = Field("50 g", gt=0, description="of a tensioner; of one on a pivot, its moment of inertia over the square of the lever")
    lever: Length | None = Field(
        None, gt=0, description="from the pivot to where the spring acts; to the middle of the arc unless given", examples=["120 mm"]
    )


class Closure(Spec):
    """Centre distance and transmission error without dynamics."""

    strands: Literal["straight", "equilibrium"] = Field(
        "equilibrium", description="straight: free plates in one line; equilibrium: each where the strand's force leaves it"
    )
    elongation: Number = Field(0.0, ge=-0.02, le=0.05, description="of the chain by wear, relative to its pitch")


class Contact(Spec):
    """Pins on each other, plates on teeth."""

    force: Force | None = Field(
        None, gt=0, description="of the strand; half the preload plus the centrifugal force unless given", examples=["200 N"]
    )
    stiffness: Stiffness = Field(
        "1e5 N/mm", gt=0, description="of a place of contact: flank on tooth, plate on pin, pin on pin; three of these in line make a joint"
    )
    damping: Damping | None = Field(
        None, ge=0, description="of flank and tooth; joint_damping times stiffness unless given", examples=["200 N s/m"]
    )
    law: ContactLaw = Field(
        "kelvin-voigt",
        description="of flank, roller or rail: kelvin-voigt: linear spring and damper; others come with packages that register them",
    )
    joint_damping: Time = Field("2 us", ge=0, description="damping of a joint over its stiffness")
    articulation_damping_ratio: Number | None = Field(
        None,
        ge=0,
        description="of the turning of neighbouring plates against each other, by friction and oil of the joint, over critical "
        "for a plate that rocks between its joints; 0.003 where pins roll, 0.02 in a hinge unless given",
        examples=[0.003],
    )


class Dynamics(Spec):
    """The run of the moving chain."""

    integrator: Literal["explicit", "implicit"] = Field(
        "explicit", description="implicit: for damping too large, or contacts too stiff, for short explicit steps"
    )
    step: Time | None = Field(None, gt=0, description="of time; 1 us (explicit) unless given", examples=["1 us"])
    settling: Time = Field("50 ms", ge=0, description="left out of the statistics")
    duration: Time | None = Field(
        None, gt=0, description="that is evaluated; two revolutions of the chain unless given", examples=["0.25 s"]
    )
    ensemble: Integer = Field(4, ge=1, le=64, description="runs whose starts differ by nanometres: intervals of statistics come from them")
    thickness_deviation: Length = Field("0 mm", description="of all teeth, on each flank, positive: too thick")
    largest_drift: Number = Field(
        1e-3, gt=0, description="of the energy balance in a second, over the energy stored; beyond it the run has failed"
    )


class Compare(Spec):
    """Designs beside this one; lists left empty are chosen around it."""

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
    """Scatter of manufacture, normally distributed: standard deviations."""

    tooth_thickness: Length = Field("2 um", ge=0, description="place of the flanks, all teeth of a sprocket alike")
    pitch: Length = Field("2 um", ge=0, description="hole pitch of every single plate")
    samples: Integer = Field(20, ge=3, le=5000, description="drives")
    seed: Integer = Field(0, ge=0, description="of the random numbers")


class Fatigue(Spec):
    """Stress and life of the plates."""

    card: StrainLife | None = Field(None, description="strain-life data; estimated from the tensile strength unless given")
    plane: Literal["max-shear", "max-damage"] = Field(
        "max-shear", description="critical plane: of the greatest shear strain, exact for one-directional tests; or the most damaged one"
    )
    fineness: Number = Field(1.0, ge=0.3, le=4, description="of the elements: 2 halves them all")


class Solid(Spec):
    """Plate and pins as elastic solids in contact (extra fe)."""

    clearance: Length = Field("5 um", ge=0, description="of an own pin in its hole, in the radius")
    edge_radius: Length = Field("50 um", ge=0, description="of the rounded edges of a hole")
    seat: Angle | None = Field(
        None,
        gt=0,
        description="half the angle about the outer direction on which a pin bears; all of its seat unless given",
        examples=["45 deg"],
    )
    friction: Number = Field(0.0, ge=0, le=1, description="coefficient between a pin and its seat; with it all takes about twice as long")
    load_steps: Integer = Field(
        24, ge=2, le=500, description="instants of a revolution of the chain, the largest and smallest forces among them"
    )
    fineness: Number = Field(1.0, ge=0.7, le=FINEST, description="of the elements: 2 halves them all")


class Limits(Spec):
    """Requirements; each becomes a check."""

    teeth: Integer = Field(8, ge=3, description="of a sprocket, at least")
    wrap: Angle = Field("120 deg", ge=0, description="angle of a sprocket that the chain takes in, at least")
    contact_share: Number = Field(
        0.2, ge=0, le=1, description="tooth contacts for each link that lies on a sprocket, at least: fewer is overspeed"
    )
    slack_share: Number = Field(0.05, ge=0, le=1, description="share of the time in which three joints may be without tension at once")
    shakedown_safety: Number = Field(1.0, gt=0, description="shakedown limit of the rolling pins over their contact pressure")
    yield_safety: Number = Field(1.0, gt=0, description="yield strength over von Mises stress of pins and plates")
    wall: Length = Field("0.5 mm", ge=0, description="least width of a plate around and between its holes")
    tip_thickness: Length = Field("0.3 mm", ge=0, description="of the teeth at their tips")
    static_safety: Number = Field(6.0, gt=0, description="breaking load over the force of the tight strand, at least")
    wear_life: Time | None = Field(
        None, gt=0, description="time until wear elongates the chain to its limit, at least", examples=["5000 h"]
    )
    overlap: Length = Field("5 um", ge=0, description="of plates with teeth, seated or coming in")


class Material(Spec):
    """Of plates and pins; the values are those of 38CrMoAl, recalled but for the yield strength."""

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
        description="number of a roller chain, e.g. 08B, 16B-2 or ANSI 40: gives pitch, roller, pin, plate, mass and breaking load that "
        "are not given",
        examples=["08B"],
    )
    pitch: Length | None = Field(None, gt=0, description="of the straight chain; by the chain's number unless given", examples=["9.525 mm"])
    links: Integer = Field(ge=6, le=2000, description="number of pitches", examples=[82])
    teeth: tuple[Integer, Integer] = Field(description="of the driving and of the driven sprocket", examples=[[35, 37]])
    rows: Integer | None = Field(None, ge=1, le=8, description="strands side by side on common pins; 1 unless given", examples=[2])
    row_pitch: Length | None = Field(
        None, gt=0, description="distance of the rows' middle planes; the width of one unless given", examples=["13.92 mm"]
    )
    row_phase: Number = Field(
        0.0,
        ge=0,
        lt=1,
        description="by how much of a pitch the teeth of the second of two rows are ahead of the first's, each row a chain of its own; 0: "
        "rows on common pins",
        examples=[0.5],
    )
    breaking_load: Force | None = Field(
        None, gt=0, description="minimum tensile strength of the chain, all rows together", examples=["17.8 kN"]
    )
    joint: Joint = Field(Joint(), description="joint")
    plate: Plate = Field(Plate(), description="plate")
    roller: Roller | None = Field(None, description="rollers; without them the plates mesh")
    cutter: Cutter = Field(Cutter(), description="cutter")
    meshing: Meshing = Field(Meshing(), description="published method")
    drive: Drive | None = Field(None, description="speed and loads; for contact, dynamics, stress and life")
    driven: Driven = Field(Driven(), description="driven sprocket")
    sprockets: tuple[Sprocket, ...] = Field((), description="further sprockets, in any order")
    guides: tuple[Guide, ...] = Field((), description="guides and tensioners")
    closure: Closure = Field(Closure(), description="closure")
    contact: Contact = Field(Contact(), description="contact")
    dynamics: Dynamics = Field(Dynamics(), description="dynamics")
    material: Material = Field(Material(), description="material")
    compare: Compare = Field(Compare(), description="comparisons")
    scatter: Scatter = Field(Scatter(), description="scatter of manufacture")
    fatigue: Fatigue = Field(Fatigue(), description="stress and life")
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
            raise SpecError(f"{teeth} teeth are too few for a sprocket; take {LEAST_TEETH} or more", f"teeth.{number}")
    if spec.links <= max(spec.teeth):
        raise SpecError(
            f"{spec.links} links are no more than the {max(spec.teeth)} teeth of a sprocket: the chain does not reach around two; "
            f"take {max(spec.teeth) + 4} or more",
            "links",
        )
    for table in ("guides", "sprockets"):
        names = [entry.name for entry in getattr(spec, table)]
        for name in names:
            if names.count(name) > 1:
                raise SpecError(f"the name {name!r} comes twice; names in {table} must differ", f"{table}.{name}.name")
    if min(spec.plate.lacing) < 1:
        raise SpecError(f"lacing {list(spec.plate.lacing)} has a pitch without a plate; count one or more in each", "plate.lacing")


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
