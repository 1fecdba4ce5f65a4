"""What the user says of a seedling pusher: train, arm, push, lever, cams, field, load, limits."""

from typing import Literal

from pydantic import model_validator

from drivewright import materials, motion
from drivewright.errors import SpecError
from drivewright.spec import Flag, Integer, Machining, MechanismSpec, Number, Spec, Text
from drivewright.spec.fields import Field
from drivewright.units import Angle, Damping, Force, Length, Mass, Pressure, Speed, Stiffness

LAWS = [name for name in motion.names() if name not in ("mcv", "polynomial", "scca", "spline", "table")]  # those without parameters
TURN = 6.283185307179586


class Train(Spec):
    """Three congruent elliptic gears, each on a focus: sun fixed, carrier bent at the intermediate gear."""

    semi_major: Length = Field(
        gt=0, description="semi-major axis a of the ellipses; the arms of the carrier are 2a", examples=["16.272 mm"]
    )
    axis_ratio: Number = Field(gt=0, le=1, description="minor over major axis k; eccentricity = sqrt(1 - k^2)", examples=[0.985])
    bend: Angle = Field(gt=0, lt=TURN / 2, description="bend of the carrier at the intermediate gear", examples=["89 deg"])
    bend_reading: Literal["turned", "interior"] = Field("turned", description="bend is the angle turned there, or the interior angle")
    start: Literal["near", "far"] = Field("near", description="focal radius of the sun in contact at the start: the short or the long one")
    carrier_angle: Angle = Field(
        gt=-TURN / 2, le=TURN / 2, description="first arm of the carrier above the horizontal at the start", examples=["7 deg"]
    )
    teeth: Integer = Field(21, ge=8, le=400, description="teeth of each gear; an odd number lets congruent gears mesh at both ends")


class Arm(Spec):
    """The planting arm: needle and pusher, rigid with the planet."""

    tip_distance: Length = Field(gt=0, description="planet axis to needle tip", examples=["175 mm"])
    tip_angle: Angle = Field(
        ge=-TURN / 2, le=TURN / 2, description="direction of the tip at the start, see tip_reference", examples=["35 deg"]
    )
    tip_reference: Literal["carrier", "planet"] = Field(
        "carrier", description="tip_angle is measured clockwise from the first arm, or at the planet from the ray to the sun"
    )
    needle_angle: Angle = Field(
        "30.84 deg", gt=-TURN / 4, lt=TURN / 4, description="needle steeper than the line planet axis - tip by this"
    )


class Push(Spec):
    """Motion of the pusher rod over the carrier angle: push, hold, retract, rest."""

    stroke: Length = Field("18 mm", gt=0, description="travel of the rod")
    end_event: Literal["angle", "lowest"] = Field("angle", description="the push ends at push.end, or where the tip is lowest")
    end: Angle = Field("86 deg", ge=0, lt=TURN, description='carrier angle at the end of the push, for end_event = "angle"')
    rise: Angle = Field("21 deg", gt=0, lt=TURN, description="carrier turn of the push")
    hold: Angle = Field("1 deg", ge=0, lt=TURN, description="carrier turn with the rod fully out")
    retraction: Angle = Field("36 deg", gt=0, lt=TURN, description="carrier turn of the retraction")
    law: Text = Field("polynomial-345", description=f"motion law of push and retraction: {', '.join(LAWS)}")


class Lever(Spec):
    """Lever with two roller arms and a slotted arm that drives the rod."""

    pivot_distance: Length = Field(gt=0, description="cam axis to lever pivot", examples=["37 mm"])
    arm_main: Length = Field(gt=0, description="pivot to the roller on the main cam", examples=["16 mm"])
    arm_return: Length = Field(gt=0, description="pivot to the roller on the return cam", examples=["16 mm"])
    output_arm: Length = Field(gt=0, description="pivot to the line of the rod", examples=["56 mm"])
    rod_length: Length = Field("135 mm", gt=0, description="length of the pusher rod")


class Cams(Spec):
    """Main cam (pushes) and return cam (retracts), both on the carrier, coaxial with the planet."""

    prime_radius_main: Length = Field(gt=0, description="pitch radius of the main cam with the rod in", examples=["29 mm"])
    prime_radius_return: Length = Field(
        gt=0, description="pitch radius of the return cam with the rod in (its largest)", examples=["33 mm"]
    )
    roller_radius: Length = Field(gt=0, description="radius of both rollers", examples=["6 mm"])
    orbit: Literal["clockwise", "counter-clockwise"] = Field("clockwise", description="sense in which the lever pivot orbits the cams")
    face_width: Length = Field("8 mm", gt=0, description="width of each cam")
    bore: Length = Field("20 mm", gt=0, description="bore of both cams")
    hub_diameter: Length = Field("30 mm", gt=0, description="hub that joins both cams")
    coplanar_rollers: Flag = Field(False, description="both rollers in one plane, so that they must clear each other")


class Field_(Spec):
    """Where it plants."""

    spacing: Length = Field("140 mm", gt=0, description="distance between plants; one plant per carrier turn and arm")
    travel: Literal["+x", "-x"] = Field("+x", description="direction in which the machine drives")
    mouth_height: Length = Field("30 mm", gt=0, description="soil surface above the lowest point of the tip")
    seedling_height: Length = Field("120 mm", gt=0, description="height of a planted seedling above the soil")


class Events(Spec):
    """When the needle takes the seedlings and when it pushes them."""

    take: Literal["top", "angle", "gate"] = Field(
        "top", description="the needle takes at the top of its track, at take_angle, or at the gate line"
    )
    take_angle: Angle | None = Field(None, ge=0, lt=TURN, description='carrier angle of taking, for take = "angle"')
    gate_point: tuple[Length, Length] | None = Field(
        None, description="a point of the gate line, sun axis at the origin", examples=[["140 mm", "0 mm"]]
    )
    gate_direction: Angle = Field("90 deg", description="direction of the gate line from the horizontal")
    push: Literal["lowest", "push-end", "push-start"] = Field(
        "lowest", description="the planting angle counts at the lowest point, or at an end of the push"
    )


class Drive(Spec):
    """The carrier's shaft."""

    speed: Speed = Field("200 rpm", gt=0, description="carrier speed; one plant per turn and arm")


class Load(Spec):
    """What the rod carries."""

    mass: Mass = Field("0.2 kg", gt=0, description="rod and output arm, reduced to the rod")
    push_force: Force = Field("50 N", ge=0, description="resistance while the rod pushes out")


class Contact(Spec):
    """Rollers on cams as springs, with play."""

    stiffness: Stiffness = Field("2e7 N/m", gt=0, description="normal stiffness of each roller contact")
    damping: Damping = Field("100 N s/m", ge=0, description="normal damping of each roller contact")
    clearance: Length = Field("0 mm", ge=0, description="normal play of each roller on its cam")
    turns: Integer = Field(3, ge=1, le=1000, description="carrier turns to simulate; the last one counts")
    material: Text = Field("16MnCr5", description=f"cam and roller material: {', '.join(materials.names())}")


class Limits(Spec):
    """Requirements of planting and of cam design; each becomes a check."""

    take_angle: tuple[Angle, Angle] = Field(("5 deg", "25 deg"), description="needle to the horizontal where it takes")
    push_angle: tuple[Angle, Angle] = Field(("60 deg", "80 deg"), description="needle to the horizontal where it pushes")
    angle_difference: Angle = Field("55 deg", description="wanted difference of the two: the slope of the seedling box")
    angle_difference_tolerance: Angle = Field("2 deg", gt=0, description="allowed deviation of the difference")
    pressure_angle: Angle = Field("40 deg", gt=0, lt=TURN / 4, description="largest pressure angle of a driving cam")
    curvature_ratio: Number = Field(1.2, ge=1, description="least convex radius of the pitch curve over the roller radius, recommended")
    pitch_radius: Length = Field("36 mm", gt=0, description="largest pitch radius")
    track_height: Length = Field("200 mm", gt=0, description="largest height of the tip track")
    mouth_width: Length = Field("40 mm", gt=0, description="widest hole that the needle leaves in the soil surface")
    axis_clearance: Length = Field("0 mm", ge=0, description="least distance of the planet axis from the lower half of planted seedlings")
    rod_distance: Length = Field("5 mm", gt=0, description="largest distance of the rod's line from the needle's")
    hub_wall: Length = Field("2 mm", gt=0, description="least wall between cam profile and hub")
    contact_pressure: Pressure | None = Field(None, gt=0, description="allowable Hertz pressure; the material's unless given")
    play_force_ratio: Number = Field(2.0, ge=1, description="largest normal force with 0.1 mm of play in each roller over that without")
    rod_error: Length = Field("0.2 mm", gt=0, description="largest deviation of the rod from its programme")


class SeedlingPusherSpec(MechanismSpec):
    """A rice transplanter's planting arm: elliptic-gear planetary train and conjugate-cam seedling pusher."""

    mechanism: Literal["seedling-pusher"] = Field("seedling-pusher", description="kind of drive")
    train: Train = Field(description="three elliptic gears on a bent carrier")
    arm: Arm = Field(description="planting arm, rigid with the planet gear")
    push: Push = Field(Push(), description="motion of the rod")
    lever: Lever = Field(description="lever between cams and rod")
    cams: Cams = Field(description="conjugate cam pair on the carrier")
    events: Events = Field(Events(), description="which positions count as taking and pushing")
    field: Field_ = Field(Field_(), description="field and soil")
    drive: Drive = Field(Drive(), description="drive")
    load: Load = Field(Load(), description="load on the rod")
    contact: Contact = Field(Contact(), description="contacts with play, for the dynamics")
    manufacture: Machining = Field(Machining(), description="exports")
    limits: Limits = Field(Limits(), description="requirements")

    @model_validator(mode="after")
    def _says_where_it_takes(self):
        for take, key, example in (("angle", "take_angle", '"300 deg"'), ("gate", "gate_point", '["140 mm", "0 mm"]')):
            if self.events.take == take and getattr(self.events, key) is None:
                raise SpecError(f'missing, though events.take is "{take}"; give it, e.g. {key} = {example}', f"events.{key}")
        return self
