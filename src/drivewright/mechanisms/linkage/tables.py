"""The tables of a linkage's spec: bodies, joints, forces, the drive, the run and the analyses of it; without its refusals."""

import math
from typing import Literal

from drivewright.mechanisms.linkage.joints import Direction, Joint
from drivewright.spec import DataFile, Flag, Integer, MechanismSpec, Name, Named, Number, Spec, Text
from drivewright.spec.fields import Bound, Field
from drivewright.units import (
    Acceleration,
    Angle,
    Damping,
    Force,
    Inertia,
    Length,
    Mass,
    RotationalDamping,
    RotationalStiffness,
    Speed,
    Stiffness,
    Time,
    Torque,
    Velocity,
)

GROUND, CENTROID = "ground", "centroid"
Point = tuple[Length, Length]


class Ground(Spec):
    """The fixed frame; its coordinate system is the world's."""

    points: Named[Point] = Field({}, description="points of the fixed frame for joints and springs", examples=[{"O2": ["0 mm", "0 mm"]}])


class LinkageBody(Spec):
    """A rigid body; centroid and points are in the body's frame."""

    mass: Mass = Field("0 kg", ge=0, description="mass")
    inertia: Inertia = Field("0 kg m^2", ge=0, title="Moment of inertia", description="moment of inertia about `inertia_about`")
    inertia_about: Name = Field(
        "centroid", title="Inertia reference point", description="reference point of the inertia: centroid, or a point of this body"
    )
    centroid: Point = Field(("0 mm", "0 mm"), description="centre of mass")
    points: Named[Point] = Field(
        {},
        description='points for joints, springs and outputs; each body also has "centroid"',
        examples=[{"A": ["0 mm", "0 mm"], "B": ["100 mm", "0 mm"]}],
    )
    angle: Angle = Field(
        "0 deg", title="Initial angle", description="initial angle of the body's frame; an estimate that selects the assembly mode"
    )
    velocity: tuple[Velocity, Velocity] | None = Field(
        None,
        title="Initial velocity",
        description="initial velocity of the centroid, where the mechanism is free to move",
        examples=[["0 m/s", "0 m/s"]],
    )
    angular_velocity: Speed | None = Field(
        None,
        title="Initial angular velocity",
        description="initial angular velocity, where the mechanism is free to move",
        examples=["0 rpm"],
    )


class LinkageSpring(Spec):
    """A spring with a damper between two points."""

    name: Name | None = Field(None, description="name of the spring", examples=["return"])
    connects: tuple[Text, Text] = Field(
        title="Connected points",
        description="end points, BODY.POINT",
        examples=[["crank.centroid", "ground.O2"]],
        json_schema_extra={"parts": ["from", "to"]},
    )
    stiffness: Stiffness = Field("0 N/mm", ge=0, description="force per elongation")
    free_length: Length = Field("0 mm", ge=0, description="length without force")
    damping: Damping = Field("0 N s/m", ge=0, description="force per rate of elongation")


class LinkageRotationalSpring(Spec):
    """A rotational spring with a damper between two bodies."""

    name: Name | None = Field(None, description="name of the spring", examples=["air"])
    body: Text = Field(title="Loaded body", description="body on which the torque acts", examples=["crank"])
    on: Text = Field("ground", title="Reaction body", description="body that carries the reaction")
    stiffness: RotationalStiffness = Field("0 N m/rad", ge=0, description="torque per angle")
    rest: Angle = Field("0 deg", title="Free angle", description="angle without torque, of `body` relative to `on`")
    damping: RotationalDamping = Field("0 N m s/rad", ge=0, description="torque per angular speed")


class LinkageTorque(Spec):
    """A torque on a body."""

    name: Name | None = Field(None, description="name of the torque", examples=["load"])
    body: Text = Field(title="Loaded body", description="body on which the torque acts", examples=["crank"])
    on: Text = Field("ground", title="Reaction body", description="body that carries the reaction")
    torque: Torque | None = Field(None, title="Constant torque", description="constant torque", examples=["0 N m"])
    file: DataFile | None = Field(
        None, title="Torque file", description="CSV instead of torque: torque [N m] over time [s], angle [deg] or speed [rpm]"
    )
    periodic: Flag = Field(
        False, title="Periodic table", description="repeats the table; a table over a whole turn of the angle always repeats"
    )


class LinkageForce(Spec):
    """A force on a point of a body."""

    name: Name | None = Field(None, description="name of the force", examples=["cut"])
    body: Text = Field(title="Loaded body", description="body on which the force acts", examples=["crank"])
    point: Text = Field("centroid", title="Point of application", description="point of the body at which the force acts")
    force: tuple[Force, Force] = Field(description="force, x and y", examples=[["0 N", "0 N"]])
    follows: Flag = Field(False, title="Rotation with the body", description="the direction of the force rotates with the body")
    file: DataFile | None = Field(
        None,
        title="Force factor file",
        description="CSV of a factor on the force over time [s], or over angle [deg] or speed [rpm] of the body",
    )
    periodic: Flag = Field(
        False, title="Periodic table", description="repeats the table; a table over a whole turn of the angle always repeats"
    )


class LinkageDrive(Spec):
    """A drive of one joint."""

    joint: Text = Field(
        title="Driven joint",
        description="name of a revolute joint; with a profile or a motor also of a prismatic joint, with a profile of a pin-slot",
        examples=["A"],
    )
    speed: Speed | None = Field(
        None,
        description="constant speed of the joint's first body relative to its second; where the first is the ground, of the second",
        examples=["100 rpm"],
    )
    phase: Angle = Field(
        "0 deg", title="Initial phase", description="drive at constant speed: additional rotation at the start, beyond the body's angle"
    )
    profile: DataFile | None = Field(
        None,
        title="Motion profile file",
        description="CSV over time [s] instead of speed: angle [deg] relative to the first row, or travel [mm] "
        "of a prismatic joint or pin-slot from the point of its line",
    )
    delay: Time = Field("0 s", ge=0, title="Start delay of the profile", description="time before the profile begins")
    ends: Literal["rest", "free"] = Field(
        "rest",
        title="Ends of the profile",
        description="ends of the profile. rest: it starts and ends at rest; free: it starts and ends at any speed, which then continues",
    )
    motor: DataFile | None = Field(
        None,
        title="Motor characteristic file",
        description="CSV instead of speed: torque [N m] of a motor over speed [rpm], angle [deg] or time [s]; force [N] of an actuator "
        "of a prismatic joint over velocity [m/s], travel [mm] or time [s]",
    )


class Simulate(Spec):
    """The run."""

    turns: Number | None = Field(
        None,
        gt=0,
        le=1e6,
        title="Length of the run in turns",
        description="length of the run in turns of a drive at constant speed",
        examples=[16.0],
    )
    duration: Time | None = Field(
        None, gt=0, description="duration of the run; if turns is also given, the shorter run applies", examples=["1 h"]
    )
    discard: Number = Field(0.0, ge=0, title="Discarded turns", description="turns at the start of the run that peaks and means exclude")
    relative_tolerance: Number = Field(1e-8, ge=1e-13, le=1e-2, description="relative tolerance of the integrator per step")
    absolute_tolerance: Length | None = Field(
        None,
        gt=0,
        description="absolute tolerance of positions; relative_tolerance times the size of the mechanism unless given",
        examples=["1 nm"],
    )
    method: Literal["dopri5", "radau"] = Field(
        "dopri5", title="Integration method", description="dopri5: explicit, fast; radau: implicit, for heavy damping"
    )
    singular: Literal["smooth", "stop"] = Field(
        "smooth",
        title="Singular position handling",
        description="behaviour at a singular position, where loops fold and branches of the motion "
        "meet. smooth: continue on the smooth branch; stop: end the run",
    )
    max_steps: Integer = Field(
        20_000_000, ge=1, title="Maximum number of steps", description="number of integration steps after which the run ends early"
    )
    min_step: Time = Field(
        "0 s", ge=0, title="Minimum time step", description="time step below which the run ends early; 0: limited by rounding only"
    )
    samples_per_turn: Integer = Field(720, ge=8, le=1_000_000, description="rows of the tables per turn, or of a run without turns")
    seed: Integer = Field(
        1, ge=0, le=2**31 - 1, title="Random seed", description="seed of the random numbers; the same seed gives the same results"
    )
    ensemble: Integer = Field(
        4,
        ge=1,
        le=10_000,
        title="Runs of the ensemble",
        description="number of runs for the statistics of a non-periodic motion with clearance; their initial states differ by a "
        "thousandth of the clearance",
    )


class LinkageOutput(Spec):
    """An output: the angle of a body, or the motion of one of its points."""

    name: Name = Field(description="name of the output", examples=["output"])
    body: Text = Field(description="body of the output", examples=["crank"])
    point: Text | None = Field(
        None, description="point of the body whose motion is the output; without it, the angle of the body is", examples=["centroid"]
    )


class Poincare(Spec):
    """Poincaré section: position and velocity of an output at crank angle zero, once per turn."""

    output: Text = Field(description="name of an output", examples=["output"])


class Lyapunov(Spec):
    """Largest Lyapunov exponent: the rate at which neighbouring motions diverge."""

    turns: Integer = Field(
        60, ge=32, le=1_000_000, title="Evaluated turns", description="turns evaluated; the standard error needs at least 32"
    )
    discard: Integer = Field(20, ge=0, le=1_000_000, title="Discarded turns", description="turns discarded before the evaluated ones")


class Bifurcation(Spec):
    """Bifurcation diagram: the points of the Poincaré section over a key of this spec."""

    over: Text = Field(title="Varied key", description="dotted key of this spec, e.g. joints.NAME.clearance", examples=["drive.speed"])
    start: Bound = Field(title="First value", description="first value of the key", examples=["100 rpm"])
    stop: Bound = Field(title="Last value", description="last value of the key", examples=["300 rpm"])
    steps: Integer = Field(
        200, ge=2, le=100_000, title="Number of values", description="number of equally spaced values from first to last"
    )
    turns: Integer = Field(300, ge=1, le=1_000_000, title="Turns of each run", description="turns of each run")
    discard: Integer = Field(
        200, ge=0, le=1_000_000, title="Discarded turns", description="turns at the start of each run that are not shown"
    )
    output: Text = Field(description="name of an output", examples=["output"])


class LoadTable(Spec):
    """Impact load coefficients over speed and clearance."""

    speeds: tuple[Speed, ...] = Field(
        min_length=1, title="Drive speeds", description="speeds of the drive", examples=[["100 rpm", "200 rpm"]]
    )
    clearances: tuple[Length, ...] = Field(
        min_length=1,
        title="Radial clearances",
        description="radial clearances, applied to every joint with clearance",
        examples=[["0.05 mm", "0.1 mm"]],
    )
    output: Text = Field(description="name of an output", examples=["output"])


class Deviation(Spec):
    """A tolerance of a point in its body (or in the ground)."""

    at: Text = Field(title="Point", description="the point, BODY.POINT", examples=["crank.A"])
    tolerance: Length = Field(ge=0, description="maximum deviation in either direction", examples=["0.05 mm"])
    axis: Direction = Field(
        (1.0, 0.0), title="Direction", description="direction of the deviation in the body's frame", json_schema_extra={"parts": ["x", "y"]}
    )
    distribution: Literal["uniform", "normal"] = Field(
        "uniform", description="distribution of the deviation; normal: the tolerance is three standard deviations"
    )


class Tolerances(Spec):
    """Deviations of the outputs, without dynamics, from random dimensions and journals anywhere on the circle of their clearance."""

    angle: Angle = Field("0 deg", title="Angle of the driven body", description="angle of the driven body")
    samples: Integer = Field(20_000, ge=2, le=10_000_000, title="Number of samples", description="number of random mechanisms")
    dimensions: tuple[Deviation, ...] = Field((), title="Point tolerances", description="tolerances of points")


class Wear(Spec):
    """Wear of a bearing by Archard's law with feedback to its contact."""

    joint: Text = Field(description='name of a joint with model = "dry"', examples=["A"])
    cycles: Integer = Field(ge=1, title="Number of turns", description="number of turns of the drive", examples=[1_000_000])
    jumps: Integer = Field(
        10,
        ge=1,
        le=10_000,
        title="Wear extrapolation steps",
        description="number of simulated runs, after each of which wear is extrapolated",
    )
    bins: Integer = Field(360, ge=8, le=100_000, title="Sectors around the bearing", description="number of sectors around the bearing")


class Limits(Spec):
    """Requirements; each becomes a check."""

    impact_load_coefficient: Number | None = Field(
        None, gt=0, description="maximum impact load coefficient of every output", examples=[2.0]
    )
    joint_force: Force | None = Field(None, gt=0, description="maximum force in every joint with clearance", examples=["1 kN"])
    penetration: Length | None = Field(
        None, gt=0, description="maximum penetration in every joint with contact; its clearance unless given", examples=["10 um"]
    )
    drive_torque: Torque | None = Field(None, gt=0, description="maximum magnitude of the drive torque", examples=["10 N m"])
    link_compression: Force = Field("0 N", ge=0, description="maximum compression of a massless link; in compression the pin loses contact")
    clearance_share: Number = Field(
        0.05, gt=0, title="Clearance over shortest link", description="maximum clearance relative to the shortest link"
    )
    least_restitution: Number = Field(
        0.7,
        gt=0,
        le=1,
        title="Minimum restitution",
        description="minimum restitution for lankarani-nikravesh and hunt-crossley, which return more than stated below it",
    )
    least_turns: Number = Field(
        5.0,
        gt=0,
        title="Minimum evaluated turns",
        description="minimum number of turns after the discarded ones, for the five largest peaks of the impact load coefficient",
    )
    energy_error: Number = Field(
        1e-4, gt=0, title="Energy audit error", description="maximum error of the energy audit relative to the energy exchanged"
    )


class LinkageTables(MechanismSpec):
    """All tables of a linkage."""

    mechanism: Literal["linkage"] = Field("linkage", description="kind of drive")
    gravity: tuple[Acceleration, Acceleration] = Field(("0 m/s^2", "0 m/s^2"), description="gravitational acceleration, x and y")
    ground: Ground = Field(Ground(), description="fixed frame")
    bodies: Named[LinkageBody] = Field(min_length=1, description="bodies")
    joints: tuple[Joint, ...] = Field((), description="joints")
    springs: tuple[LinkageSpring, ...] = Field((), description="springs")
    rotational_springs: tuple[LinkageRotationalSpring, ...] = Field((), description="rotational springs and dampers")
    torques: tuple[LinkageTorque, ...] = Field((), description="torques")
    forces: tuple[LinkageForce, ...] = Field((), description="forces")
    drive: LinkageDrive | None = Field(None, description="drive; without any drive the mechanism is free to move")
    drives: tuple[LinkageDrive, ...] = Field((), title="Further drives", description="further drives, at other joints")
    simulate: Simulate | None = Field(None, title="Simulation", description="simulation run; without it, one turn of the drive")
    outputs: tuple[LinkageOutput, ...] = Field((), description="outputs: bodies and points whose motion is evaluated")
    poincare: Poincare | None = Field(None, title="Poincaré section", description="Poincaré section")
    lyapunov: Lyapunov | None = Field(None, title="Lyapunov exponent", description="largest Lyapunov exponent")
    bifurcation: Bifurcation | None = Field(None, title="Bifurcation diagram", description="bifurcation diagram")
    table: LoadTable | None = Field(None, title="Impact load table", description="table of impact load coefficients")
    tolerances: Tolerances | None = Field(None, description="tolerances")
    wear: Wear | None = Field(None, description="wear")
    limits: Limits = Field(Limits(), description="requirements")

    @property
    def all_drives(self) -> dict[str, LinkageDrive]:
        """{key: drive} of all drives, `drive` first."""
        first = {"drive": self.drive} if self.drive else {}
        return first | {f"drives.{number}": drive for number, drive in enumerate(self.drives)}

    @property
    def turning_drive(self) -> str | None:
        """Key of the first drive at constant speed: whose turn is the turn of the mechanism."""
        return next((key for key, drive in self.all_drives.items() if drive.speed), None)

    @property
    def drive_speed(self) -> float | None:
        """Speed of the drive whose turn counts [rad/s]; None without a drive at constant speed."""
        return self.all_drives[self.turning_drive].speed if self.turning_drive else None

    @property
    def period(self) -> float | None:
        """Duration of a turn of the drive [s]; None without a drive at constant speed."""
        return 6.283185307179586 / abs(self.drive_speed) if self.drive_speed else None

    @property
    def duration(self) -> float | None:
        """Length of the run [s]; None without one."""
        if self.simulate is None:
            return None
        given = (self.simulate.duration, self.simulate.turns * self.period if self.simulate.turns and self.period else None)
        return min(time for time in given if time is not None)

    @property
    def start_of_window(self) -> float:
        """Time [s] from which peaks and means count."""
        return self.simulate.discard * self.period if self.simulate and self.period and self.simulate.discard else 0.0


# -- what the tables refer to -------------------------------------------------------------------------------------------------------


def points_of(spec: LinkageTables, body: str) -> dict[str, tuple[float, float]]:
    """Name -> (x, y) [m] of all points of a body or of the ground, in its frame."""
    return dict(spec.ground.points) if body == GROUND else {**spec.bodies[body].points, CENTROID: spec.bodies[body].centroid}


def place(text: str) -> tuple[str, str | None]:
    """(body, point) of a "BODY.POINT"; the point of "BODY" alone is None."""
    body, _, point = text.partition(".")
    return body, point or None


def central_inertia(body: LinkageBody) -> float:
    """Moment of inertia about the centroid [kg m^2]: Steiner's share m d^2 taken off where it was given about a point."""
    return body.inertia - body.mass * pivot_distance(body) ** 2


def pivot_distance(body: LinkageBody) -> float:
    """From the centroid to the point that the inertia is about [m]."""
    if body.inertia_about == CENTROID:
        return 0.0
    return math.dist(body.points[body.inertia_about], body.centroid)


def ends_on(spec: LinkageTables, body: str) -> list[tuple[Joint, str | None]]:
    """[(joint, point)] where joints hold a body."""
    ends = [(joint, place(text)) for joint in spec.joints for text in joint.connects]
    return [(joint, point) for joint, (name, point) in ends if name == body]
