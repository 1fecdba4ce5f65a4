"""Deep-groove and angular-contact ball bearings: five freedoms, quasi-static, without the balls' inertia and friction.

The ball is squeezed between two grooves whose centres are the vector v apart, A = ri + re - Dw when it just touches:
    v = (A sin a0 + z + R (tilt_x sin p - tilt_y cos p),  A cos a0 + x cos p + y sin p)   (axial, radial)
    overlap e = |v| - A,  Q = c max(e, 0)^1.5,  energy V = 2/5 c sum max(e, 0)^2.5
The load acts along v; V is convex, its gradient is the force and its Hessian the stiffness.
After ISO/TS 16281, recalled; checked against the results of another program in the tests.
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from pydantic import model_validator

from drivewright._jit import by_reference, implements, warmer
from drivewright._typing import Floats
from drivewright.bearings.life import REVOLUTIONS
from drivewright.bearings.newton import BearingMeasures, measures
from drivewright.bearings.response import response
from drivewright.bearings.solving import PERMISSIBLE, basic_static_rating, elements, law_of, life_of, warm
from drivewright.contact import effective_modulus, point_contact, relative_radii
from drivewright.errors import SpecError
from drivewright.spec import Integer, Number, Spec
from drivewright.spec.fields import Field
from drivewright.units import SI, Angle, Force, Length, Pressure

RIGHT_ANGLE = 1.5707963267948966


class BallBearing(Spec):
    """A single-row ball bearing by its inner geometry; contact_angle 0 is a deep-groove bearing.

    z = 0 is where every ball touches both rings on the side that a force along +z on the inner ring loads.  The grooves bear on
    their other side too: an angular-contact bearing pushed the wrong way still carries here, and `reversed_elements` tells.
    """

    balls: Integer = Field(ge=3, le=10000, description="number of balls", examples=[9])
    ball_diameter: Length = Field(gt=0, description="diameter of a ball", examples=["8 mm"])
    pitch_diameter: Length = Field(gt=0, description="diameter of the circle through the centres of the balls", examples=["40 mm"])
    inner_conformity: Number = Field(0.52, gt=0.5, description="radius of the inner groove over the diameter of a ball")
    outer_conformity: Number = Field(0.53, gt=0.5, description="radius of the outer groove over the diameter of a ball")
    radial_clearance: Length = Field("0 mm", description="diametral clearance; negative for preload")
    contact_angle: Angle = Field("0 deg", ge=0, lt=RIGHT_ANGLE, description="nominal contact angle, without clearance")
    dynamic_rating: Force | None = Field(None, gt=0, description="basic dynamic load rating C; without it there is no life")
    static_rating: Force | None = Field(None, gt=0, description="basic static load rating C0")
    youngs_modulus: Pressure = Field("210 GPa", gt=0, description="Young's modulus of rings and balls")
    poisson_ratio: Number = Field(0.3, ge=0, lt=0.5, description="Poisson's ratio of rings and balls")
    tilt_radius: Length | None = Field(None, gt=0, description="moment arm R of a ball for tilting; default half the pitch diameter")
    first_element: Angle = Field("0 deg", description="angle of the first ball from +x towards +y")

    @model_validator(mode="after")
    def _fits(self):
        chord = self.pitch_diameter * np.sin(np.pi / self.balls)
        if self.ball_diameter > chord:
            raise SpecError(
                f"{self.balls} balls of {1e3 * self.ball_diameter:.6g} mm do not fit on the pitch circle, where they are "
                f"{1e3 * chord:.6g} mm apart; take fewer or smaller balls, or a larger pitch_diameter",
                key="ball_diameter",
            )
        distance = self.groove_distance
        widest = 2 * distance * np.cos(self.contact_angle)
        if not abs(self.radial_clearance) < widest:
            raise SpecError(
                f"{1e3 * self.radial_clearance:.6g} mm leaves no contact angle: with grooves whose centres are {1e3 * distance:.6g} mm "
                f"apart it must stay within +-{1e3 * widest:.6g} mm; check the unit, or open the grooves",
                key="radial_clearance",
            )
        return self

    @property
    def groove_distance(self) -> float:
        """A = ri + re - Dw [m], between the centres of the grooves when a ball just touches both."""
        return (self.inner_conformity + self.outer_conformity - 1) * self.ball_diameter

    @property
    def curvature_ratio(self) -> float:
        """gamma = Dw cos(contact_angle)/Dpw."""
        return self.ball_diameter * np.cos(self.contact_angle) / self.pitch_diameter


@by_reference
class BallLaw(NamedTuple):
    """Distance between the groove centres at zero displacement, along z and radially, and A when the ball just touches [m];
    axial^2 + radial^2 - A^2, which only a preload makes other than 0 [m^2]; c [N/m^1.5]; arm R [m]; peak pressure at each race for
    1 N [Pa]; cosine and sine of the balls' places.
    """

    axial: float
    radial: float
    groove: float
    squeeze: float
    constant: float
    arm: float
    inner_pressure: float
    outer_pressure: float
    cosines: Floats
    sines: Floats


@law_of.register(BallBearing)
@lru_cache(maxsize=1024)
def _(bearing):
    """cos a0 = cos(contact_angle) - clearance/(2 A); above 1 the clearance is eaten up, and the balls are pressed radially."""
    groove = float(bearing.groove_distance)
    radial = groove * float(np.cos(bearing.contact_angle)) - bearing.radial_clearance / 2
    axial = np.sqrt(max(groove**2 - radial**2, 0.0))
    (inner, outer), constant = _contacts(bearing)
    places = bearing.first_element + 2 * np.pi * np.arange(bearing.balls) / bearing.balls
    arm = bearing.pitch_diameter / 2 if bearing.tilt_radius is None else bearing.tilt_radius
    squeeze = max(radial**2 - groove**2, 0.0)
    return BallLaw(float(axial), radial, groove, squeeze, constant, arm, inner, outer, np.cos(places), np.sin(places))


def _contacts(bearing):
    """(peak pressure for 1 N at the inner and the outer race [Pa], constant c of both in series [N/m^1.5])."""
    modulus = effective_modulus(bearing.youngs_modulus, bearing.poisson_ratio, bearing.youngs_modulus, bearing.poisson_ratio)
    ball, g = bearing.ball_diameter / 2, bearing.curvature_ratio
    inner = ball * (1 - g) / g, -bearing.inner_conformity * bearing.ball_diameter
    outer = -ball * (1 + g) / g, -bearing.outer_conformity * bearing.ball_diameter
    touches = [point_contact(1.0, relative_radii((ball, ball), race), modulus) for race in (inner, outer)]
    return [float(touch.pressure) for touch in touches], float(sum(touch.approach for touch in touches) ** -1.5)


@implements(measures, BallLaw)
def _(law):
    return BearingMeasures(law.groove, law.arm, -law.axial, len(law.cosines), 0)


@implements(response, BallLaw)
def _(law, displacement, force, stiffness):
    """dV = sum Q n.dv,  d2V = sum (3/2 c e^1/2 n n' + Q/|v| (I - n n')) on v; each ball adds g g' and m m' with n and its normal.

    e is found without the difference of two nearly equal lengths.  A radial distance below 0, an inner ring shifted by more than A,
    counts as 0: that ball is free.
    """
    energy = 0.0
    for i in range(5):
        force[i] = 0.0
        for j in range(5):
            stiffness[i, j] = 0.0
    for k in range(len(law.cosines)):
        cos, sin = law.cosines[k], law.sines[k]
        z = displacement[2] + law.arm * (displacement[3] * sin - displacement[4] * cos)
        r = displacement[0] * cos + displacement[1] * sin
        free = r < -law.radial
        r = -law.radial if free else r
        axial, radial = law.axial + z, law.radial + r
        length = np.sqrt(axial * axial + radial * radial)
        overlap = ((2.0 * law.axial + z) * z + (2.0 * law.radial + r) * r + law.squeeze) / (length + law.groove)
        if overlap > 0.0:
            root = law.constant * np.sqrt(overlap)
            along, across = 1.5 * root, 0.0 if free else root * overlap / length
            axial, radial = axial / length, radial / length
            g = (radial * cos, radial * sin, axial, axial * law.arm * sin, -axial * law.arm * cos)
            m = (-axial * cos, -axial * sin, radial, radial * law.arm * sin, -radial * law.arm * cos)
            energy += 0.4 * root * overlap * overlap
            for i in range(5):
                force[i] += root * overlap * g[i]
                for j in range(i + 1):
                    stiffness[i, j] += along * g[i] * g[j] + across * m[i] * m[j]
    for i in range(5):
        for j in range(i):
            stiffness[j, i] = stiffness[i, j]
    return energy


@implements(elements, BallLaw)
def _(law, displacement, loads, angles, pressures, laminae):
    """Q = c e^1.5, the direction of v, and p0 = (p0 of 1 N) Q^1/3."""
    for k in range(len(law.cosines)):
        cos, sin = law.cosines[k], law.sines[k]
        z = displacement[2] + law.arm * (displacement[3] * sin - displacement[4] * cos)
        r = max(displacement[0] * cos + displacement[1] * sin, -law.radial)
        axial, radial = law.axial + z, law.radial + r
        length = np.sqrt(axial * axial + radial * radial)
        overlap = ((2.0 * law.axial + z) * z + (2.0 * law.radial + r) * r + law.squeeze) / (length + law.groove)
        loads[k] = law.constant * max(overlap, 0.0) ** 1.5
        angles[k] = np.arctan2(axial, radial)
        pressures[k, 0] = law.inner_pressure * np.cbrt(loads[k])
        pressures[k, 1] = law.outer_pressure * np.cbrt(loads[k])


# ---------------------------------------------------------------------------------------------------------------- ratings and life


def _capacity_ratio(bearing: BallBearing) -> float:
    """h: capacity of the inner race over the outer, 1.044 ((1 - g)/(1 + g))^1.72 (ri (2 re - Dw)/(re (2 ri - Dw)))^0.41."""
    g, inner, outer = bearing.curvature_ratio, bearing.inner_conformity, bearing.outer_conformity
    return 1.044 * ((1 - g) / (1 + g)) ** 1.72 * (inner * (2 * outer - 1) / (outer * (2 * inner - 1))) ** 0.41


@life_of.register(BallBearing)
def _(bearing, state):
    return ball_reference_life(bearing, state.element_loads)


def ball_reference_life(bearing: BallBearing, loads: Floats) -> float | None:
    """L10r [revolutions] for the loads of the balls [N]; inf where all are 0, None without a dynamic rating.

    L = ((Qci/Qi)^(-10/3) + (Qce/Qe)^(-10/3))^(-9/10) 1e6,  Qi = (mean Q^3)^(1/3) on the turning inner ring,
    Qe = (mean Q^(10/3))^(3/10) on the standing outer one, Qc the capacity of each at the nominal contact angle (ISO/TS 16281, recalled).
    """
    if bearing.dynamic_rating is None:
        return None
    peak = np.max(loads)
    if peak == 0:
        return np.inf
    h = _capacity_ratio(bearing)
    share = bearing.dynamic_rating / (bearing.balls * np.cos(bearing.contact_angle) * peak)
    inner = share / 0.407 * (1 + h ** (10 / 3)) ** 0.3 / np.cbrt(np.mean((loads / peak) ** 3))
    outer = share / 0.389 * (1 + h ** (-10 / 3)) ** 0.3 / np.mean((loads / peak) ** (10 / 3)) ** 0.3
    return float(REVOLUTIONS * (inner ** (-10 / 3) + outer ** (-10 / 3)) ** -0.9)


@basic_static_rating.register(BallBearing)
def ball_static_rating(bearing: BallBearing) -> float:
    """C0 [N]: the radial load F whose most loaded ball, Q = 5 F/(Z cos a), reaches 4200 MPa at one of its races."""
    law = law_of(bearing)
    ball = (PERMISSIBLE["point"][0] / max(law.inner_pressure, law.outer_pressure)) ** 3
    return float(ball * bearing.balls * np.cos(bearing.contact_angle) / 5)


@warmer
def warm_ball_bearing() -> None:
    """Compile for `doctor --warm`."""
    warm(BallBearing(balls=3, ball_diameter=SI(1.0), pitch_diameter=SI(5.0)))
