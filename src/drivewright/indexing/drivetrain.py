"""The elastic parts of a pin-wheel indexer, as plain data: pins, crank bearings, split shafts, their supports, gears, the wheel.

Two split shafts stand at (-spacing/2, 0) and (+spacing/2, 0); a gear on each meshes with the locked input gear on the wheel's axis,
and their crank pins, one a cam, carry every cam in two holes.  What is None is rigid; without a gear the shafts are held where it
would sit.  SI units.
"""

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import NamedTuple, TypeAlias

import numpy as np

from drivewright.bearings import BallBearing, RollerBearing, approximate_stiffness, contact_of
from drivewright.bearings.approximate_stiffness import RadialStiffness
from drivewright.errors import InputError
from drivewright.indexing.body_compliance import BodyCompliance
from drivewright.shafts import EULER_BERNOULLI, Section

PALMGREN_LINE = 8.06e10  # N/m^2: F = 8.06e4 b^(8/9) s^(10/9) of one steel line contact in N and mm; Palmgren, recalled
FORMULAS = {  # of the radial stiffness, by name and kind of contact
    ("liu", "point"): approximate_stiffness.liu_ball,
    ("liu", "line"): approximate_stiffness.liu_roller,
    ("palmgren", "point"): approximate_stiffness.palmgren_ball,
    ("palmgren", "line"): approximate_stiffness.palmgren_roller,
}
SIDES = (-1.0, 1.0)  # of the two split shafts


class PinContact(NamedTuple):
    """Approach of cam and pin under the force F: (F/line)^0.9 + F/series; line [N/m^(10/9)], series [N/m], None leaves its part out."""

    line: float | None = None
    series: float | None = None


class PowerLawBearing(NamedTuple):
    """Radial force F = constant max(d - clearance, 0)^exponent at the displacement d [N, m], alike in all directions."""

    constant: float
    exponent: float = 1.0
    clearance: float = 0.0


BearingModel: TypeAlias = PowerLawBearing | BallBearing | RollerBearing


class SplitShaft(NamedTuple):
    """A stepped shaft from z = 0: places of its gear, of its front and rear support and of the cams; beam and rod.

    shear: as in `shafts.model`, EULER_BERNOULLI or COWPER.
    """

    sections: tuple[Section, ...]
    gear: float
    supports: tuple[float, float]
    cams: tuple[float, ...]
    modulus: float
    poisson: float
    shear: float = EULER_BERNOULLI


class GearMesh(NamedTuple):
    """Gears of the split shafts: pitch radius [m], stiffness of a mesh along its line of action [N/m], pressure angle [rad], and the
    backlash [m] along that line, half of it on either flank."""

    pitch_radius: float
    stiffness: float
    pressure_angle: float
    backlash: float = 0.0


class Drivetrain(NamedTuple):
    """spacing [m] of the split shafts, and what yields.

    crank, support, wheel: bearings of the cams, the shafts, the wheel: a PowerLawBearing or a rolling bearing of `drivewright.bearings`;
    housing [N/m]: radial stiffness of a seat of the supports, in series; wheel_torsion [N m/rad]: between pins and output.
    bodies: what cams and wheel yield at every contact, in place of the spring behind it.
    """

    spacing: float
    pins: PinContact | None = None
    crank: BearingModel | None = None
    support: BearingModel | None = None
    housing: float | None = None
    shaft: SplitShaft | None = None
    gear: GearMesh | None = None
    wheel: BearingModel | None = None
    wheel_torsion: float | None = None
    bodies: BodyCompliance | None = None


def pin_contact(width: float, series: float | None = None) -> PinContact:
    """The PinContact of a steel pin and cam that touch along `width` [m], with a linear stiffness [N/m] in series."""
    if not width > 0:
        raise InputError(f"pin contact: the width must be above 0, got {1e3 * width:g} mm; it is the thickness of the cam on the pin.")
    return PinContact(PALMGREN_LINE * width ** (8 / 9), series)


def power_law_bearing(stiffness_of: Callable[[float], RadialStiffness], clearance: float = 0.0) -> PowerLawBearing:
    """The PowerLawBearing of a formula of `drivewright.bearings.approximate_stiffness`: stiffness_of(force) gives its RadialStiffness.

    F = K d^n has the secant K^(1/n) F^(1 - 1/n), and n is tangent over secant.
    """
    at_one = stiffness_of(1.0)
    exponent = 1.0 / at_one.ratio
    return PowerLawBearing(float(at_one.secant) ** exponent, exponent, clearance)


def formula_bearing(name: str, bearing: BallBearing | RollerBearing, clearance: float = 0.0) -> PowerLawBearing:
    """The PowerLawBearing of a rolling bearing by a formula of its catalogue numbers, "liu" or "palmgren"; clearance [m] in the radius."""
    if isinstance(bearing, BallBearing):
        numbers = {"balls": bearing.balls, "ball_diameter": bearing.ball_diameter}
    else:
        numbers = {"rollers": bearing.rollers, "roller_length": bearing.roller_length}
    return power_law_bearing(partial(FORMULAS[name, contact_of(bearing)], **numbers), clearance)


def split_shaft(
    lengths: tuple[float, float, float, float], diameters: Sequence[float], cams: int, modulus: float, shear_modulus: float
) -> SplitShaft:
    """The stepped SplitShaft from its gear to its rear support.

    lengths [m]: gear to front support, front support to first cam, cam to cam, last cam to rear support; diameters (4,) [m] along these
    stretches, the third one from the first to the last cam; moduli [Pa].
    """
    overhang, front, pitch, rear = lengths
    first = overhang + front
    places = tuple(first + pitch * number for number in range(cams))
    stretches = (overhang, front, places[-1] - first, rear)
    sections = tuple(Section(length, d, d) for length, d in zip(stretches, diameters, strict=True) if length > 0)
    poisson = modulus / (2 * shear_modulus) - 1
    return SplitShaft(sections, 0.0, (overhang, places[-1] + rear), places, modulus, poisson)


def refuse_invalid(drive: Drivetrain, cams: int) -> None:
    """InputError where a part has no meaning for a drive with that many cams."""
    for name, value, unit, least in _sizes(drive):
        if value is not None and not (value > 0 if least is None else value >= least):
            wanted = "above 0" if least is None else f"{least:g} or more"
            raise InputError(f"drive train: {name} = {value:g} {unit}".rstrip() + f" must be {wanted}; leave it out for a rigid part.")
    if drive.shaft is not None:
        _check_shaft(drive.shaft, cams)
    if drive.gear is not None:
        _check_gear(drive.gear, drive.spacing)


def _check_shaft(shaft: SplitShaft, cams: int) -> None:
    if len(shaft.cams) != cams:
        raise InputError(
            f"drive train: the split shaft has positions for {len(shaft.cams)} cams, but the drive has {cams}; give one for each."
        )
    front, rear = (1e3 * place for place in shaft.supports)
    if not front < rear:
        raise InputError(f"drive train: the front support at {front:g} mm must lie before the rear one at {rear:g} mm.")
    stations = sorted((shaft.gear, *shaft.cams))
    for before, after in zip(stations[:-1], stations[1:], strict=True):
        if not before < after:
            raise InputError(f"drive train: gear and cams of a split shaft need different positions; two are at {1e3 * after:g} mm.")


def _check_gear(gear: GearMesh, spacing: float) -> None:
    if not gear.pitch_radius < spacing / 2:
        raise InputError(
            f"drive train: the split gears' pitch radius {1e3 * gear.pitch_radius:g} mm leaves no room for the input gear between shafts "
            f"{1e3 * spacing:g} mm apart; it must be below half of that."
        )
    if not 0 <= gear.pressure_angle < np.pi / 2:
        raise InputError(
            f"drive train: the gears' pressure angle {np.degrees(gear.pressure_angle):.4g}° must lie from 0 to below 90° "
            "(it is taken in radians); 20° is usual."
        )


def _sizes(drive: Drivetrain) -> Iterator[tuple[str, float | None, str, float | None]]:
    """(name, value, unit, least value allowed; None: above 0)."""
    yield "spacing", drive.spacing, "m", None
    yield "housing", drive.housing, "N/m", None
    yield "wheel_torsion", drive.wheel_torsion, "N m/rad", None
    if drive.pins is not None:
        yield "pins.line", drive.pins.line, "N/m^(10/9)", None
        yield "pins.series", drive.pins.series, "N/m", None
    if drive.gear is not None:
        yield "gear.pitch_radius", drive.gear.pitch_radius, "m", None
        yield "gear.stiffness", drive.gear.stiffness, "N/m", None
        yield "gear.backlash", drive.gear.backlash, "m", 0.0
    for name in ("crank", "support", "wheel"):
        bearing = getattr(drive, name)
        if isinstance(bearing, PowerLawBearing):
            yield f"{name}.constant", bearing.constant, "N/m^n", None
            yield f"{name}.exponent", bearing.exponent, "", 1.0
            yield f"{name}.clearance", bearing.clearance, "m", 0.0
