"""What the user says of a bearing of a shaft: springs, a table, or a rolling bearing; its seat and its ratings."""

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
            raise UnitError(
                f'must be above 0, got {value}; a bearing that does not hold here is left out, one that does not yield is "{RIGID}"'
            )
        return found

    def text(self, value):
        return RIGID if value == math.inf else BY_NAME["stiffness"].text(value)

    def __get_pydantic_json_schema__(self, schema, handler):
        return {"type": "string", "examples": ["3e7 N/m", RIGID], "x-dimension": "stiffness", "x-unit": "N/m", "x-si-unit": "N/m"}


StiffnessOrRigid = Annotated[float, _StiffnessOrRigid('stiffness, or "rigid"', "N/m", "N/m", largest=math.inf)]


CrossStiffness = Annotated[float, Dimension("stiffness", "N/m", "N/mm")]  # which has no rigid limit


class Bearing(Spec):
    """What carries the shaft at a place: springs, a table, or a rolling bearing with its inner geometry."""

    name: Name = Field(description="name", examples=["A"])
    position: Length = Field(description="distance from the left end of the shaft", examples=["56.5 mm"])
    radial_stiffness: StiffnessOrRigid | None = Field(
        None, description='radial stiffness, the same all round; "rigid" does not yield', examples=["3e7 N/m"]
    )
    stiffness_xx: StiffnessOrRigid | None = Field(
        None, description="stiffness along x instead, where stiffness_yy along y differs", examples=["5e7 N/m"]
    )
    stiffness_yy: StiffnessOrRigid | None = Field(None, description="stiffness along y, beside stiffness_xx", examples=["7e7 N/m"])
    stiffness_xy: CrossStiffness = Field("0 N/m", description="force along x that a displacement along y needs (cross-coupling)")
    stiffness_yx: CrossStiffness = Field("0 N/m", description="force along y that a displacement along x needs (cross-coupling)")
    radial_damping: Damping = Field("0 N s/m", ge=0, description="radial damping, the same all round", examples=["500 N s/m"])
    damping_xx: Damping | None = Field(None, ge=0, description="damping along x instead of radial_damping")
    damping_yy: Damping | None = Field(None, ge=0, description="damping along y instead of radial_damping")
    damping_xy: Damping = Field("0 N s/m", description="force along x that a velocity along y needs")
    damping_yx: Damping = Field("0 N s/m", description="force along y that a velocity along x needs")
    axial_stiffness: StiffnessOrRigid | None = Field(
        None, description="axial stiffness, beside radial_stiffness or a table", examples=["1e7 N/m"]
    )
    tilt_stiffness: RotationalStiffness | None = Field(
        None, gt=0, description="tilt stiffness, beside radial_stiffness or a table", examples=["2e4 N m/rad"]
    )
    table: DataFile | None = Field(
        None, description="CSV of the radial force over the radial displacement instead: displacement [um],force [N] from 0, 0"
    )
    bearing: Designation | None = Field(None, description="designation of a rolling bearing instead, e.g. 6306 or NU206", examples=["6306"])
    geometry: BallBearing | None = Field(None, description="inner geometry of a ball bearing instead")
    roller_geometry: RollerBearing | None = Field(None, description="inner geometry of a roller bearing instead")
    envelope: Envelope | None = Field(None, description="a rolling bearing by its type, boundary dimensions and ratings alone instead")
    radial_clearance: Length | None = Field(
        None,
        description="diametral clearance, as of rolling bearings: of a rolling bearing instead of its own, of a spring twice the gap",
        examples=["10 um"],
    )
    preload: Force = Field(
        "0 N",
        ge=0,
        description="axial preload of a rolling bearing as mounted, on a shaft that does not yield; "
        "where it is free to slide, that of the spring behind it",
    )
    carries: Literal["right", "left"] | None = Field(
        None,
        description="direction of the axial force on the shaft that an angular-contact or tapered bearing takes; unless given in turn "
        "from the left: right, left, right (a pair stands back to back)",
    )
    free: tuple[Literal["axial", "tilt"], ...] = Field((), description="freedoms of the outer ring of a rolling bearing in its seat")
    seat_offset: tuple[Length, Length] = Field(("0 mm", "0 mm"), description="offset of the seat from the common axis, x and y")
    seat_tilt: tuple[Angle, Angle] = Field(("0 deg", "0 deg"), description="tilt of the seat about x and y")
    housing_stiffness: StiffnessOrRigid = Field(RIGID, description="radial stiffness of the housing, in series with the bearing")
    housing_axial_stiffness: StiffnessOrRigid = Field(RIGID, description="axial stiffness of the housing")
    width: Length = Field("0 mm", ge=0, description="width over which the reaction is spread evenly; 0: it acts at a point")
    dynamic_rating: Force | None = Field(
        None, gt=0, description="basic dynamic load rating C, instead of the rolling bearing's own", examples=["4.03 kN"]
    )
    static_rating: Force | None = Field(
        None, gt=0, description="basic static load rating C0, instead of the rolling bearing's own", examples=["2.32 kN"]
    )
