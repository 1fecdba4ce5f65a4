"""Table of a bearing in the spec of a shaft: springs, a force table, or a rolling bearing; its seat and its ratings."""

import math
from typing import Annotated, Literal

from drivewright.bearings.ball import BallBearing
from drivewright.bearings.envelope import Envelope
from drivewright.bearings.roller import RollerBearing
from drivewright.errors import UnitError
from drivewright.spec import DataFile, Name, Spec
from drivewright.spec.fields import Designation, Field
from drivewright.units import BY_NAME, Angle, Damping, Dimension, Force, Length, RotationalStiffness

RIGID = "rigid"


class _StiffnessOrRigid(Dimension):
    """A stiffness [N/m] above 0, or "rigid": infinity."""

    plain = True

    def parse(self, value):
        """As `Dimension.parse`, of the wider kind."""
        if value == RIGID:
            return math.inf
        found = BY_NAME["stiffness"].parse(value)
        if not found > 0:
            raise UnitError(f'must be above 0, got {value}; leave out a bearing without this stiffness, and give "{RIGID}" for a rigid one')
        return found

    def text(self, value):
        return RIGID if value == math.inf else BY_NAME["stiffness"].text(value)

    def __get_pydantic_json_schema__(self, schema, handler):
        return {"type": "string", "examples": ["3e7 N/m", RIGID], "x-dimension": "stiffness", "x-unit": "N/m", "x-si-unit": "N/m"}


StiffnessOrRigid = Annotated[float, _StiffnessOrRigid('stiffness, or "rigid"', "N/m", "N/m", largest=math.inf)]


CrossStiffness = Annotated[float, Dimension("stiffness", "N/m", "N/mm")]  # which has no rigid limit


class Bearing(Spec):
    """A support of the shaft: springs, a force table, or a rolling bearing with its inner geometry."""

    name: Name = Field(description="name", examples=["A"])
    position: Length = Field(description="distance from the left end of the shaft", examples=["56.5 mm"])
    radial_stiffness: StiffnessOrRigid | None = Field(
        None, description='radial stiffness in all directions, or "rigid"', examples=["3e7 N/m"]
    )
    stiffness_xx: StiffnessOrRigid | None = Field(
        None, description="stiffness along x, with stiffness_yy, instead of radial_stiffness", examples=["5e7 N/m"]
    )
    stiffness_yy: StiffnessOrRigid | None = Field(None, description="stiffness along y, with stiffness_xx", examples=["7e7 N/m"])
    stiffness_xy: CrossStiffness = Field("0 N/m", description="cross-coupled stiffness, force along x over displacement along y")
    stiffness_yx: CrossStiffness = Field("0 N/m", description="cross-coupled stiffness, force along y over displacement along x")
    radial_damping: Damping = Field("0 N s/m", ge=0, description="radial damping in all directions", examples=["500 N s/m"])
    damping_xx: Damping | None = Field(None, ge=0, description="damping along x instead of radial_damping")
    damping_yy: Damping | None = Field(None, ge=0, description="damping along y instead of radial_damping")
    damping_xy: Damping = Field("0 N s/m", description="cross-coupled damping, force along x over velocity along y")
    damping_yx: Damping = Field("0 N s/m", description="cross-coupled damping, force along y over velocity along x")
    axial_stiffness: StiffnessOrRigid | None = Field(
        None, description="axial stiffness, in addition to radial_stiffness or a table", examples=["1e7 N/m"]
    )
    tilt_stiffness: RotationalStiffness | None = Field(
        None, gt=0, description="tilt stiffness, in addition to radial_stiffness or a table", examples=["2e4 N m/rad"]
    )
    table: DataFile | None = Field(
        None,
        description="CSV of the radial force over the radial displacement, instead of a stiffness: displacement [um],force [N] from 0, 0",
    )
    bearing: Designation | None = Field(
        None,
        title="Bearing designation",
        description="designation of a rolling bearing, e.g. 6306 or NU206",
        examples=["6306"],
        json_schema_extra={"x-list": "bearings", "x-overrides": ["radial_clearance", "dynamic_rating", "static_rating"]},
    )
    geometry: BallBearing | None = Field(None, description="inner geometry of a ball bearing, instead of a designation")
    roller_geometry: RollerBearing | None = Field(None, description="inner geometry of a roller bearing, instead of a designation")
    envelope: Envelope | None = Field(
        None, description="type, boundary dimensions and ratings of a rolling bearing, instead of a designation"
    )
    radial_clearance: Length | None = Field(
        None, description="diametral clearance; for a rolling bearing in place of its own, for a spring twice the gap", examples=["10 um"]
    )
    preload: Force = Field(
        "0 N",
        ge=0,
        description="axial preload of a rolling bearing as mounted, on a rigid shaft; "
        "where the outer ring slides freely, the force of its preload spring",
    )
    carries: Literal["right", "left"] | None = Field(
        None,
        title="Axial load direction",
        description="direction of the axial force on the shaft that an angular-contact or tapered bearing takes; default alternating "
        "from the left: right, left, right (a pair is back to back)",
    )
    free: tuple[Literal["axial", "tilt"], ...] = Field(
        (), title="Free directions", description="free directions of the outer ring of a rolling bearing in its seat"
    )
    seat_offset: tuple[Length, Length] = Field(("0 mm", "0 mm"), description="offset of the seat from the common axis, x and y")
    seat_tilt: tuple[Angle, Angle] = Field(
        ("0 deg", "0 deg"), description="tilt of the seat about x and y", json_schema_extra={"parts": ["about x", "about y"]}
    )
    housing_stiffness: StiffnessOrRigid = Field(RIGID, description="radial stiffness of the housing, in series with the bearing")
    housing_axial_stiffness: StiffnessOrRigid = Field(RIGID, description="axial stiffness of the housing")
    width: Length = Field("0 mm", ge=0, description="width over which the reaction is uniformly distributed; 0 for a point")
    dynamic_rating: Force | None = Field(
        None, gt=0, description="basic dynamic load rating C, in place of the rolling bearing's own", examples=["4.03 kN"]
    )
    static_rating: Force | None = Field(
        None, gt=0, description="basic static load rating C0, in place of the rolling bearing's own", examples=["2.32 kN"]
    )
