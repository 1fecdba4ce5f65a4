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
    """What stands still; its frame is the world."""

    points: Named[Point] = Field({}, description="points that joints and springs hold on to", examples=[{"O2": ["0 mm", "0 mm"]}])


class LinkageBody(Spec):
    """A rigid body; centroid and points are in a frame of its own."""

    mass: Mass = Field("0 kg", ge=0, description="mass")
    inertia: Inertia = Field("0 kg m^2", ge=0, description="moment of inertia about `inertia_about`")
    inertia_about: Name = Field("centroid", description="centroid, or a point of this body")
    centroid: Point = Field(("0 mm", "0 mm"), description="centre of mass")
    points: Named[Point] = Field(
        {},
        description='points for joints, springs and outputs; each body also has "centroid"',
        examples=[{"A": ["0 mm", "0 mm"], "B": ["100 mm", "0 mm"]}],
    )
    angle: Angle = Field("0 deg", description="direction of the body's frame at the start, a guess that picks the assembly")
    velocity: tuple[Velocity, Velocity] | None = Field(
        None, description="of the centroid at the start, of a mechanism free to move", examples=[["0 m/s", "0 m/s"]]
    )
    angular_velocity: Speed | None = Field(None, description="at the start, of a mechanism free to move", examples=["0 rpm"])


class LinkageSpring(Spec):
    """A spring with a damper between two points."""

    name: Name | None = Field(None, description="name", examples=["return"])
    connects: tuple[Text, Text] = Field(description="its ends, BODY.POINT", examples=[["crank.centroid", "ground.O2"]])
    stiffness: Stiffness = Field("0 N/mm", ge=0, description="force per stretch")
    free_length: Length = Field("0 mm", ge=0, description="length without force")
    damping: Damping = Field("0 N s/m", ge=0, description="force per speed of the stretch")


class LinkageRotationalSpring(Spec):
    """A spring with a damper about the angle of a body."""

    name: Name | None = Field(None, description="name", examples=["air"])
    body: Text = Field(description="body it turns", examples=["crank"])
    on: Text = Field("ground", description="body that carries the reaction")
    stiffness: RotationalStiffness = Field("0 N m/rad", ge=0, description="torque per angle")
    rest: Angle = Field("0 deg", description="angle without torque, of `body` relative to `on`")
    damping: RotationalDamping = Field("0 N m s/rad", ge=0, description="torque per angular speed")


class LinkageTorque(Spec):
    """A torque on a body."""

    name: Name | None = Field(None, description="name", examples=["load"])
    body: Text = Field(description="body it turns", examples=["crank"])
    on: Text = Field("ground", description="body that carries the reaction")
    torque: Torque | None = Field(None, description="steady torque", examples=["0 N m"])
    file: DataFile | None = Field(None, description="CSV instead: torque [N m] over time [s], angle [deg] or speed [rpm]")
    periodic: Flag = Field(False, description="the table repeats itself; one over a whole turn of the angle does anyway")


class LinkageForce(Spec):
    """A force on a point of a body."""

    name: Name | None = Field(None, description="name", examples=["cut"])
    body: Text = Field(description="body", examples=["crank"])
    point: Text = Field("centroid", description="point of the body")
    force: tuple[Force, Force] = Field(description="force", examples=[["0 N", "0 N"]])
    follows: Flag = Field(False, description="its direction turns with the body")
    file: DataFile | None = Field(None, description="CSV of a factor on it over time [s], or over angle [deg] or speed [rpm] of the body")
    periodic: Flag = Field(False, description="the table repeats itself; one over a whole turn of the angle does anyway")


class LinkageDrive(Spec):
    """What moves the mechanism, at one joint."""

    joint: Text = Field(
        description="name of a revolute joint; with a profile or a motor also of a prismatic one or a pin-slot", examples=["A"]
    )
    speed: Speed | None = Field(
        None,
        description="constant speed of the joint's first body relative to its second; where the first is the ground, of the second",
        examples=["100 rpm"],
    )
    phase: Angle = Field("0 deg", description="turned at the start, at constant speed, beyond where the body's angle puts it")
    profile: DataFile | None = Field(
        None,
        description="CSV over time [s] instead: angle [deg] counted from the first row, or travel [mm] "
        "of a prismatic joint or pin-slot from the point of its line",
    )
    delay: Time = Field("0 s", ge=0, description="until a profile begins")
    ends: Literal["rest", "free"] = Field(
        "rest", description="of a profile. rest: it starts and ends at rest; free: with any speed, which goes on after the end"
    )
    motor: DataFile | None = Field(
        None,
        description="CSV instead: torque [N m] of a motor over speed [rpm], angle [deg] or time [s]; force [N] of an actuator of a "
        "prismatic joint over velocity [m/s], travel [mm] or time [s]",
    )


class Simulate(Spec):
    """The run."""

    turns: Number | None = Field(None, gt=0, le=1e6, description="length of the run in turns of a drive at constant speed", examples=[16.0])
    duration: Time | None = Field(
        None, gt=0, description="length of the run; where turns are given too, the shorter one counts", examples=["1 h"]
    )
    discard: Number = Field(0.0, ge=0, description="turns at the start that are left out of peaks and means")
    relative_tolerance: Number = Field(1e-8, ge=1e-13, le=1e-2, description="of the integrator, a step")
    absolute_tolerance: Length | None = Field(
        None, gt=0, description="of positions; relative_tolerance times the mechanism's size unless given", examples=["1 nm"]
    )
    method: Literal["dopri5", "radau"] = Field("dopri5", description="dopri5: explicit, fast; radau: for heavy damping")
    singular: Literal["smooth", "stop"] = Field(
        "smooth",
        description="in a singular position, where loops fold and branches of the motion "
        "meet. smooth: go on along the smooth branch; stop: end the run",
    )
    max_steps: Integer = Field(20_000_000, ge=1, description="steps after which the run ends with what it has")
    min_step: Time = Field("0 s", ge=0, description="step below which the run ends with what it has; 0: at the limit of the arithmetic")
    samples_per_turn: Integer = Field(720, ge=8, le=1_000_000, description="rows of the tables of a turn, or of a run without turns")
    seed: Integer = Field(1, ge=0, le=2**31 - 1, description="seed of the random numbers; same seed, same answer")
    ensemble: Integer = Field(
        4,
        ge=1,
        le=10_000,
        description="runs behind the statistics of a motion with play that does not repeat "
        "itself; their starts differ by a thousandth of the clearance",
    )


class LinkageOutput(Spec):
    """A motion of interest."""

    name: Name = Field(description="name", examples=["output"])
    body: Text = Field(description="body whose angle it is", examples=["crank"])
    point: Text | None = Field(None, description="point of the body whose motion it is", examples=["centroid"])


class Poincare(Spec):
    """One point a turn: position and velocity of an output at crank angle zero."""

    output: Text = Field(description="name of an output", examples=["output"])


class Lyapunov(Spec):
    """The largest Lyapunov exponent: how fast neighbouring motions part."""

    turns: Integer = Field(60, ge=32, le=1_000_000, description="turns that count; the error bar takes 32")
    discard: Integer = Field(20, ge=0, le=1_000_000, description="turns before them")


class Bifurcation(Spec):
    """The points of the Poincare section over a key of this spec."""

    over: Text = Field(description="dotted key of this spec, e.g. joints.NAME.clearance", examples=["drive.speed"])
    start: Bound = Field(description="its first value", examples=["100 rpm"])
    stop: Bound = Field(description="its last value", examples=["300 rpm"])
    steps: Integer = Field(200, ge=2, le=100_000, description="values from first to last, equally far apart")
    turns: Integer = Field(300, ge=1, le=1_000_000, description="turns of each run")
    discard: Integer = Field(200, ge=0, le=1_000_000, description="turns of each that are not shown")
    output: Text = Field(description="name of an output", examples=["output"])


class LoadTable(Spec):
    """Impact load coefficients over speed and clearance."""

    speeds: tuple[Speed, ...] = Field(min_length=1, description="speeds of the drive", examples=[["100 rpm", "200 rpm"]])
    clearances: tuple[Length, ...] = Field(
        min_length=1, description="clearances, the same at each joint with play", examples=[["0.05 mm", "0.1 mm"]]
    )
    output: Text = Field(description="name of an output", examples=["output"])


class Deviation(Spec):
    """A tolerance of a point in its body (or in the ground)."""

    at: Text = Field(description="BODY.POINT", examples=["crank.A"])
    tolerance: Length = Field(ge=0, description="largest deviation either way", examples=["0.05 mm"])
    axis: Direction = Field((1.0, 0.0), description="its direction in the body's frame")
    distribution: Literal["uniform", "normal"] = Field("uniform", description="normal: the tolerance is three standard deviations")


class Tolerances(Spec):
    """Random dimensions, and journals anywhere on the circle of their clearance: what becomes of the outputs, without dynamics."""

    angle: Angle = Field("0 deg", description="angle of the driven body")
    samples: Integer = Field(20_000, ge=2, le=10_000_000, description="random mechanisms")
    dimensions: tuple[Deviation, ...] = Field((), description="tolerances of points")


class Wear(Spec):
    """Wear of a bearing by Archard's law, fed back into the contact."""

    joint: Text = Field(description='name of a joint with model = "dry"', examples=["A"])
    cycles: Integer = Field(ge=1, description="turns of the drive", examples=[1_000_000])
    jumps: Integer = Field(10, ge=1, le=10_000, description="runs among them; between two of them the wear is extrapolated")
    bins: Integer = Field(360, ge=8, le=100_000, description="places around the bearing")


class Limits(Spec):
    """Requirements; each becomes a check."""

    impact_load_coefficient: Number | None = Field(None, gt=0, description="of every output", examples=[2.0])
    joint_force: Force | None = Field(None, gt=0, description="of every joint with play", examples=["1 kN"])
    penetration: Length | None = Field(None, gt=0, description="of every dry joint", examples=["10 um"])
    drive_torque: Torque | None = Field(None, gt=0, description="of the drive, either way", examples=["10 N m"])
    link_compression: Force = Field("0 N", ge=0, description="of a massless link; a pin that is pushed has lost contact")
    clearance_share: Number = Field(0.05, gt=0, description="clearance over the shortest link")
    least_restitution: Number = Field(0.7, gt=0, le=1, description="of lankarani-nikravesh and hunt-crossley, which bounce too well below")
    least_turns: Number = Field(5.0, gt=0, description="after discard, for the five largest peaks of the impact load coefficient")
    energy_error: Number = Field(1e-4, gt=0, description="gap of the energy audit over the energy exchanged")


class LinkageTables(MechanismSpec):
    """All tables of a linkage."""

    mechanism: Literal["linkage"] = Field("linkage", description="kind of drive")
    gravity: tuple[Acceleration, Acceleration] = Field(("0 m/s^2", "0 m/s^2"), description="acceleration of free fall")
    ground: Ground = Field(Ground(), description="ground")
    bodies: Named[LinkageBody] = Field(min_length=1, description="bodies")
    joints: tuple[Joint, ...] = Field((), description="joints")
    springs: tuple[LinkageSpring, ...] = Field((), description="springs")
    rotational_springs: tuple[LinkageRotationalSpring, ...] = Field((), description="rotational springs and dampers")
    torques: tuple[LinkageTorque, ...] = Field((), description="torques")
    forces: tuple[LinkageForce, ...] = Field((), description="forces")
    drive: LinkageDrive | None = Field(None, description="drive; without it, and without drives, the mechanism is free to move")
    drives: tuple[LinkageDrive, ...] = Field((), description="further drives, at joints of their own")
    simulate: Simulate | None = Field(None, description="run; without it no dynamics")
    outputs: tuple[LinkageOutput, ...] = Field((), description="motions of interest")
    poincare: Poincare | None = Field(None, description="Poincare section")
    lyapunov: Lyapunov | None = Field(None, description="largest Lyapunov exponent")
    bifurcation: Bifurcation | None = Field(None, description="bifurcation diagram")
    table: LoadTable | None = Field(None, description="table of impact load coefficients")
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
