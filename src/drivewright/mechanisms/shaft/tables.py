"""Tables of the spec of a shaft: material, segments, bearings, stations, loads, limits."""

from typing import Literal

from drivewright import materials
from drivewright.bearings.lubricant import Lubrication
from drivewright.mechanisms.shaft.bearing_table import Bearing
from drivewright.mechanisms.shaft.strength_tables import NotchTable, StrengthTable
from drivewright.spec import DataFile, Integer, MechanismSpec, Name, Number, Spec, Text
from drivewright.spec.fields import Field
from drivewright.units import (
    Acceleration,
    Angle,
    Density,
    Force,
    Inertia,
    Length,
    LineForce,
    Mass,
    Pressure,
    Speed,
    Time,
    Torque,
    Unbalance,
)


class Material(Spec):
    """The shaft's material."""

    card: Text | None = Field(
        None,
        title="Material card",
        description="material card that supplies the keys not given here: C45, 42CrMo4, 16MnCr5 ...",
        examples=["C45", *(name for name in materials.names() if name != "C45")],
    )
    youngs_modulus: Pressure | None = Field(
        None, gt=0, description="Young's modulus; default that of the card, else 206 GPa", examples=["206 GPa"]
    )
    poisson_ratio: Number | None = Field(
        None, gt=-1, lt=0.5, description="Poisson's ratio; default that of the card, else 0.3", examples=[0.3]
    )
    density: Density | None = Field(
        None, ge=0, description="density, 0 for a massless shaft; default that of the card, else 7850 kg/m^3", examples=["7850 kg/m^3"]
    )
    yield_strength: Pressure | None = Field(
        None, gt=0, description="yield strength, for stress checks; default that of the card, else none", examples=["355 MPa"]
    )
    tensile_strength: Pressure | None = Field(
        None,
        gt=0,
        description="tensile strength, for fatigue; default that of the card for the bar diameter, else none",
        examples=["600 MPa"],
    )
    bar_diameter: Length | None = Field(
        None, gt=0, description="diameter of the heat-treated bar; default the maximum diameter of the shaft", examples=["60 mm"]
    )


class Segment(Spec):
    """A piece of the shaft, from left to right."""

    length: Length = Field(gt=0, description="length along the shaft", examples=["340 mm"])
    diameter: Length = Field(gt=0, description="outer diameter, for a cone at its left end", examples=["20 mm"])
    end_diameter: Length | None = Field(None, gt=0, description="outer diameter at the right end of a cone", examples=["24 mm"])
    bore: Length = Field("0 mm", ge=0, description="diameter of the bore")
    fillet_radius: Length | None = Field(
        None,
        gt=0,
        description="radius of the fillet at the step to the next segment; default 0.02 of the smaller diameter",
        examples=["1 mm"],
    )


class Carried(Spec):
    """A part on the shaft at a position."""

    name: Name = Field(description="name", examples=["m1"])
    position: Length = Field(description="distance from the left end of the shaft", examples=["0 mm"])
    mass: Mass = Field("0 kg", ge=0, description="mass on the shaft")
    polar_inertia: Inertia = Field("0 kg m^2", ge=0, description="moment of inertia about the shaft's axis")
    diametral_inertia: Inertia = Field("0 kg m^2", ge=0, description="moment of inertia about a diameter")
    unbalance: Unbalance | None = Field(
        None, description="unbalance, mass times eccentricity; default from drive.balance_grade where no part has one", examples=["50 g mm"]
    )
    unbalance_angle: Angle = Field("0 deg", description="angle of the unbalance on the shaft, from x towards y")


class Station(Carried):
    """A position of interest and the part there."""


DOWN = "-90 deg"


class PointLoad(Spec):
    """A load at a position."""

    name: Name | None = Field(None, description="name", examples=["belt"])
    station: Text | None = Field(None, description="name of the station of the load; give station or position", examples=["m1"])
    position: Length | None = Field(
        None, description="distance of the load from the left end; give station or position", examples=["100 mm"]
    )
    force: Force = Field("0 N", description="force across the shaft", examples=["500 N"])
    angle: Angle = Field(DOWN, description="direction of the force, from x towards y; -90 deg is down, along -y")
    axial_force: Force = Field("0 N", description="force along the shaft, to the right")
    torque: Torque = Field("0 N m", description="torque about the axis, x towards y")
    moment: Torque = Field("0 N m", description="bending moment", examples=["10 N m"])
    moment_angle: Angle = Field("0 deg", description="direction of the moment vector, from x towards y, right-handed")


class LineLoad(Spec):
    """A load spread along the shaft."""

    name: Name | None = Field(None, description="name", examples=["felt"])
    start: Length = Field(description="position of the left end", examples=["100 mm"])
    end: Length = Field(description="position of the right end", examples=["200 mm"])
    force: LineForce = Field(description="force per length at the left end, constant unless end_force is given", examples=["5 N/mm"])
    end_force: LineForce | None = Field(None, description="force per length at the right end", examples=["8 N/mm"])
    angle: Angle = Field(DOWN, description="direction, from x towards y")


class Gear(Carried):
    """A gear on the shaft: its tooth forces follow from the torque."""

    name: Name = Field(description="name", examples=["gear"])
    pitch_diameter: Length = Field(gt=0, description="diameter of the (operating) pitch circle", examples=["60 mm"])
    torque: Torque = Field(description="torque of the teeth on the shaft about its axis, x towards y", examples=["30 N m"])
    mesh_angle: Angle = Field("0 deg", description="direction of the mating gear, from x towards y")
    pressure_angle: Angle = Field("20 deg", ge=0, lt=1.0, description="normal pressure angle")
    helix_angle: Angle = Field(
        "0 deg", gt=-1.2, lt=1.2, description="helix angle; positive: with a positive torque the axial force points to the right"
    )
    face_width: Length | None = Field(None, gt=0, description="face width, for the misalignment over it", examples=["20 mm"])


BalanceGrade = Literal["G 0.4", "G 1", "G 2.5", "G 6.3", "G 16", "G 40", "G 100", "G 250", "G 630", "G 1600", "G 4000"]


class Drive(Spec):
    """The rotation of the shaft."""

    speed: Speed = Field(gt=0, description="speed of the shaft, for whirl, unbalance and the life in hours", examples=["1500 rpm"])
    balance_grade: BalanceGrade = Field(
        "G 6.3", description="balance quality grade of ISO 21940-11, for the unbalance response where no part has an unbalance"
    )


class DutyCase(Spec):
    """A case of the duty cycle."""

    name: Name | None = Field(None, description="name", examples=["roughing"])
    share: Number = Field(
        gt=0, le=1, title="Share of the time", description="share of the time; the shares of all cases sum to 1", examples=[1.0]
    )
    load: Number = Field(
        1.0, ge=0, title="Load factor", description="factor on all loads and gear torques; weight and preload are unchanged"
    )
    speed: Speed | None = Field(None, ge=0, description="speed of the shaft; default that of [drive]", examples=["3000 rpm"])


class Analysis(Spec):
    """Settings of the computation."""

    theory: Literal["timoshenko", "rayleigh", "euler-bernoulli"] = Field(
        "timoshenko", description="beam with shear and rotary inertia, with rotary inertia alone, or with neither"
    )
    shear_coefficient: Literal["cowper"] | Number = Field("cowper", description='shear coefficient: "cowper", or a number')
    direction: Angle | None = Field(
        None,
        description="direction of the unit loads for flexibility and stiffness, from x towards y; default that of "
        "the loads where they share a plane, else downwards",
        examples=["-90 deg"],
    )
    modes: Integer = Field(3, ge=0, le=50, title="Number of modes", description="number of natural frequencies")
    element_length: Length | None = Field(
        None, gt=0, description="maximum element length for the modes; default a fortieth of the shaft", examples=["10 mm"]
    )
    campbell_speed: Speed | None = Field(
        None,
        gt=0,
        description="maximum speed of Campbell diagram and unbalance response; default above the speed of the shaft and the first "
        "critical speed",
        examples=["10000 rpm"],
    )
    solid_band: Length = Field(
        "2 mm", gt=0, description="width of the bearing bands of the solid check, for bearings without a width of their own"
    )


class Limits(Spec):
    """Requirements; each becomes a check."""

    deflection: Length | None = Field(
        None, gt=0, title="Maximum deflection", description="maximum deflection of every station and gear", examples=["0.1 mm"]
    )
    gear_slope: Angle | None = Field(
        None, gt=0, title="Maximum slope at gears", description="maximum slope of the shaft at every gear", examples=["2 arcmin"]
    )
    slope: Angle | None = Field(
        None, gt=0, title="Maximum slope at bearings", description="maximum slope of the shaft at every bearing", examples=["4 arcmin"]
    )
    yield_safety: Number = Field(1.0, gt=0, description="minimum yield strength over maximum von Mises stress, nominal and at notches")
    fatigue_safety: Number = Field(1.2, gt=0, description="minimum fatigue safety of every section")
    static_safety: Number = Field(
        1.0, gt=0, description="minimum static rating of a bearing over its load; for a rolling bearing from its contact pressure"
    )
    life: Time | None = Field(
        None, gt=0, title="Reference life", description="minimum reference life of every rolling bearing", examples=["20000 h"]
    )
    modified_life: Time | None = Field(None, gt=0, description="minimum modified life of every rolling bearing", examples=["20000 h"])
    shock_factor: Number = Field(1.0, ge=1, description="shock load over steady load, for yield, static safety and limit loads")
    buckling: Number = Field(3.0, gt=0, description="minimum buckling safety, buckling load over axial force")
    largest_slope: Angle = Field("0.1 rad", gt=0, description="maximum slope along the shaft, up to which linear beam theory holds")
    largest_deflection: Number = Field(
        0.1, gt=0, description="maximum deflection over the length of the shaft, up to which linear beam theory holds"
    )
    critical_speed: Number = Field(
        1.25,
        gt=0,
        title="Critical speed ratio",
        description="minimum ratio of the lowest unbalance-excited critical speed to the speed of the shaft",
    )
    separation_margin: Number = Field(
        0.15, ge=0, description="minimum distance of the nearest unbalance-excited critical speed over the speed of the shaft"
    )
    log_decrement: Number = Field(
        0.0, description="minimum log decrement of all whirls at the speed of the shaft, where bearings have damping"
    )
    unbalance: Length | None = Field(
        None,
        gt=0,
        title="Maximum unbalance amplitude",
        description="maximum unbalance amplitude of every station and gear",
        examples=["20 um"],
    )
    slenderness: Number = Field(1000.0, gt=0, description="maximum length of the shaft over its minimum diameter; detects wrong units")
    stockiness: Number = Field(0.1, gt=0, description="minimum length of the shaft over its minimum diameter; detects wrong units")


class ShaftTables(MechanismSpec):
    """All tables of a shaft."""

    mechanism: Literal["shaft"] = Field("shaft", description="kind of drive")
    catalogue: DataFile | None = Field(
        None, title="Bearing catalogue", description="your own catalogue of rolling bearings (TOML), in addition to the built-in one"
    )
    gravity: tuple[Acceleration, Acceleration, Acceleration] = Field(
        ("0 m/s^2", "0 m/s^2", "0 m/s^2"), description="acceleration of gravity along x, y, z; downwards is [0, -9.81, 0]"
    )
    material: Material = Field(Material(), description="material")
    segments: tuple[Segment, ...] = Field(min_length=1, description="segments, left to right")
    bearings: tuple[Bearing, ...] = Field(min_length=1, description="bearings")
    stations: tuple[Station, ...] = Field((), description="stations: places of interest")
    loads: tuple[PointLoad, ...] = Field((), description="point loads")
    line_loads: tuple[LineLoad, ...] = Field((), description="line loads")
    gears: tuple[Gear, ...] = Field((), description="gears")
    drive: Drive | None = Field(None, description="rotation of the shaft")
    duty: tuple[DutyCase, ...] = Field((), description="duty cycle of loads and speeds, for the lives of the bearings")
    lubrication: Lubrication = Field(Lubrication(), description="lubricant of the rolling bearings")
    notches: tuple[NotchTable, ...] = Field((), description="notches in addition to the steps")
    strength: StrengthTable = Field(StrengthTable(), description="operating conditions for the fatigue strength")
    analysis: Analysis = Field(Analysis(), description="analysis")
    limits: Limits = Field(Limits(), description="requirements")

    @property
    def length(self) -> float:
        """Length of the shaft [m]."""
        return sum(segment.length for segment in self.segments)
