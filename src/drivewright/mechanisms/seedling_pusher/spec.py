"""The spec of a seedling pusher: train, arm, push, lever, cams, field, load, limits."""

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
        gt=0, description="semi-major axis a of the pitch ellipses; the arms of the carrier have the length 2a", examples=["16.272 mm"]
    )
    axis_ratio: Number = Field(gt=0, le=1, description="ratio k of minor to major axis; eccentricity = sqrt(1 - k^2)", examples=[0.985])
    bend: Angle = Field(gt=0, lt=TURN / 2, description="bend of the carrier at the intermediate gear", examples=["89 deg"])
    bend_reading: Literal["turned", "interior"] = Field(
        "turned", title="Definition of the bend", description="whether bend is the angle turned there or the interior angle"
    )
    start: Literal["near", "far"] = Field(
        "near", title="Focal radius at the start", description="focal radius of the sun in contact at the start: short (near) or long (far)"
    )
    carrier_angle: Angle = Field(
        gt=-TURN / 2, le=TURN / 2, description="angle of the first arm of the carrier above the horizontal at the start", examples=["7 deg"]
    )
    teeth: Integer = Field(21, ge=8, le=400, description="number of teeth of each gear; congruent gears in a row need an odd number")


class Arm(Spec):
    """The planting arm: needle and pusher, rigid with the planet."""

    tip_distance: Length = Field(gt=0, description="distance of the needle tip from the planet axis", examples=["175 mm"])
    tip_angle: Angle = Field(ge=-TURN / 2, le=TURN / 2, description="angle of the tip at the start, see tip_reference", examples=["35 deg"])
    tip_reference: Literal["carrier", "planet"] = Field(
        "carrier",
        title="Reference of the tip angle",
        description="whether tip_angle is measured clockwise from the first arm, or at the planet from the ray to the sun",
    )
    needle_angle: Angle = Field(
        "30.84 deg", gt=-TURN / 4, lt=TURN / 4, description="angle by which the needle is steeper than the line from planet axis to tip"
    )


class Push(Spec):
    """Motion of the pusher rod over the carrier angle: push, hold, retract, rest."""

    stroke: Length = Field("18 mm", gt=0, description="travel of the rod")
    end_event: Literal["angle", "lowest"] = Field(
        "angle", title="End of the push", description="whether the push ends at push.end or at the lowest position of the tip"
    )
    end: Angle = Field(
        "86 deg",
        ge=0,
        lt=TURN,
        title="Carrier angle at the end",
        description='carrier angle at the end of the push, for end_event = "angle"',
    )
    rise: Angle = Field("21 deg", gt=0, lt=TURN, description="carrier angle of the push")
    hold: Angle = Field("1 deg", ge=0, lt=TURN, description="carrier angle with the rod fully extended")
    retraction: Angle = Field("36 deg", gt=0, lt=TURN, description="carrier angle of the retraction")
    law: Text = Field("polynomial-345", title="Motion law", description=f"motion law of push and retraction: {', '.join(LAWS)}")


class Lever(Spec):
    """Lever with two roller arms and a slotted arm that drives the rod."""

    pivot_distance: Length = Field(gt=0, description="distance of the lever pivot from the cam axis", examples=["37 mm"])
    arm_main: Length = Field(gt=0, description="distance of the roller on the main cam from the pivot", examples=["16 mm"])
    arm_return: Length = Field(gt=0, description="distance of the roller on the return cam from the pivot", examples=["16 mm"])
    output_arm: Length = Field(gt=0, description="distance of the line of the rod from the pivot", examples=["56 mm"])
    rod_length: Length = Field("135 mm", gt=0, description="length of the pusher rod")


class Cams(Spec):
    """Main cam (pushes) and return cam (retracts), both on the carrier, coaxial with the planet."""

    prime_radius_main: Length = Field(gt=0, description="pitch radius of the main cam with the rod retracted", examples=["29 mm"])
    prime_radius_return: Length = Field(
        gt=0, description="pitch radius of the return cam with the rod retracted, its maximum", examples=["33 mm"]
    )
    roller_radius: Length = Field(gt=0, description="radius of both rollers", examples=["6 mm"])
    orbit: Literal["clockwise", "counter-clockwise"] = Field("clockwise", description="sense in which the lever pivot orbits the cams")
    face_width: Length = Field("8 mm", gt=0, description="width of each cam")
    bore: Length = Field("20 mm", gt=0, description="bore diameter of both cams")
    hub_diameter: Length = Field("30 mm", gt=0, description="diameter of the hub that joins both cams")
    coplanar_rollers: Flag = Field(False, description="whether both rollers run in one plane, so that they must clear each other")


class Field_(Spec):
    """Field and soil."""

    spacing: Length = Field("140 mm", gt=0, description="distance between plants; one plant per carrier turn and arm")
    travel: Literal["+x", "-x"] = Field("+x", description="direction of travel of the machine")
    mouth_height: Length = Field("30 mm", gt=0, description="height of the soil surface above the lowest position of the tip")
    seedling_height: Length = Field("120 mm", gt=0, description="height of a planted seedling above the soil")


class Events(Spec):
    """Positions at which the needle takes the seedlings and pushes them."""

    take: Literal["top", "angle", "gate"] = Field(
        "top", description="where the needle takes the seedlings: at the top of its track, at take_angle, or at the gate line"
    )
    take_angle: Angle | None = Field(None, ge=0, lt=TURN, description='carrier angle at taking, for take = "angle"')
    gate_point: tuple[Length, Length] | None = Field(
        None, description="a point of the gate line, with the sun axis at the origin", examples=[["140 mm", "0 mm"]]
    )
    gate_direction: Angle = Field("90 deg", description="direction of the gate line from the horizontal")
    push: Literal["lowest", "push-end", "push-start"] = Field(
        "lowest", description="where the needle pushes: at the lowest position of the tip, or at the start or end of the push"
    )


class Drive(Spec):
    """Drive of the carrier."""

    speed: Speed = Field("200 rpm", gt=0, description="carrier speed; one plant per turn and arm")


class Load(Spec):
    """Load on the rod."""

    mass: Mass = Field("0.2 kg", gt=0, description="mass of rod and output arm, reduced to the rod")
    push_force: Force = Field("50 N", ge=0, description="resistance while the rod extends")


class Contact(Spec):
    """Contacts of the rollers as springs and dampers, with clearance."""

    stiffness: Stiffness = Field("2e7 N/m", gt=0, description="normal stiffness of each roller contact")
    damping: Damping = Field("100 N s/m", ge=0, description="normal damping of each roller contact")
    clearance: Length = Field("0 mm", ge=0, description="normal clearance of each roller on its cam")
    turns: Integer = Field(3, ge=1, le=1000, description="carrier turns to simulate; results are those of the last one")
    material: Text = Field(
        "16MnCr5", description=f"material of cams and rollers: {', '.join(materials.names())}", examples=list(materials.names())
    )


class Limits(Spec):
    """Requirements of planting and of cam design; each becomes a check."""

    take_angle: tuple[Angle, Angle] = Field(
        ("5 deg", "25 deg"),
        description="allowed angles of the needle below the horizontal at taking",
        json_schema_extra={"parts": ["minimum", "maximum"]},
    )
    push_angle: tuple[Angle, Angle] = Field(
        ("60 deg", "80 deg"),
        description="allowed angles of the needle below the horizontal at pushing",
        json_schema_extra={"parts": ["minimum", "maximum"]},
    )
    angle_difference: Angle = Field("55 deg", description="required difference of push and take angle: the slope of the seedling box")
    angle_difference_tolerance: Angle = Field("2 deg", gt=0, description="allowed deviation of that difference")
    pressure_angle: Angle = Field("40 deg", gt=0, lt=TURN / 4, description="maximum pressure angle of a driving cam")
    curvature_ratio: Number = Field(1.2, ge=1, description="recommended minimum convex radius of the pitch curve over the roller radius")
    pitch_radius: Length = Field("36 mm", gt=0, description="maximum pitch radius of both cams")
    track_height: Length = Field("200 mm", gt=0, description="maximum height of the tip track")
    mouth_width: Length = Field("40 mm", gt=0, description="maximum width of the hole that the needle leaves in the soil surface")
    axis_clearance: Length = Field("0 mm", ge=0, description="minimum distance of the planet axis from the lower half of planted seedlings")
    rod_distance: Length = Field("5 mm", gt=0, description="maximum distance between the lines of rod and needle")
    hub_wall: Length = Field("2 mm", gt=0, description="minimum wall thickness between cam profile and hub")
    contact_pressure: Pressure | None = Field(None, gt=0, description="allowable Hertz pressure; default: that of the material")
    play_force_ratio: Number = Field(
        2.0, ge=1, description="maximum normal force with 0.1 mm of clearance at each roller over that without"
    )
    rod_error: Length = Field("0.2 mm", gt=0, description="maximum deviation of the rod from its programme")


class SeedlingPusherSpec(MechanismSpec):
    """A rice transplanter's planting arm: elliptic-gear planetary train and conjugate-cam seedling pusher."""

    mechanism: Literal["seedling-pusher"] = Field("seedling-pusher", description="kind of drive")
    train: Train = Field(description="three elliptic gears on a bent carrier")
    arm: Arm = Field(description="planting arm, rigid with the planet gear")
    push: Push = Field(Push(), description="motion of the rod")
    lever: Lever = Field(description="lever between cams and rod")
    cams: Cams = Field(description="conjugate cam pair on the carrier")
    events: Events = Field(Events(), description="positions of taking and pushing")
    field: Field_ = Field(Field_(), description="field and soil")
    drive: Drive = Field(Drive(), description="drive")
    load: Load = Field(Load(), description="load on the rod")
    contact: Contact = Field(Contact(), description="contacts with clearance, for the contact dynamics")
    manufacture: Machining = Field(Machining(), description="exports")
    limits: Limits = Field(Limits(), description="requirements")

    @model_validator(mode="after")
    def _says_where_it_takes(self):
        for take, key, example in (("angle", "take_angle", '"300 deg"'), ("gate", "gate_point", '["140 mm", "0 mm"]')):
            if self.events.take == take and getattr(self.events, key) is None:
                raise SpecError(f'is missing: events.take = "{take}" needs it; give e.g. {key} = {example}', f"events.{key}")
        return self
