"""Measures that the solids of a pin-wheel indexer have and its reduced model does not; SI.

Heights z are those of the split shaft.  The shaft's sections, modulus and places, gears and bearings are those of the `Drivetrain`.
"""

from typing import NamedTuple

import numpy as np

from drivewright.errors import InputError
from drivewright.indexing.drivetrain import Drivetrain, SplitShaft
from drivewright.indexing.pin_wheel import PinWheel
from drivewright.shafts import Section

STEEL, POISSON = 206e9, 0.3


class CamBody(NamedTuple):
    """A plate of `thickness` with two holes of the crank bearings' outer diameter, half the spacing from its middle, and a bore there."""

    thickness: float
    hole_diameter: float
    bore: float = 0.0
    modulus: float = STEEL
    poisson: float = POISSON


class ShaftBody(NamedTuple):
    """Crank pins of the crank bearings' bore, round the cam's centre circle and solid; widths of their, the supports' and the gear's seats.

    The shaft reaches half a seat beyond a support or a gear at its end.
    """

    crank_diameter: float
    crank_width: float
    support_width: float
    gear_width: float


class WheelBody(NamedTuple):
    """Rings from z = low to high, of the diameters `bore` and `rim`, on whose faces the pins stand.

    One ring carries the pins as cantilevers, two hold them at both ends; a `drum` between two diameters joins the two, else the pins alone
    do.  The output holds the part between the diameters `flange` of the outer face of the last ring, by its mean motion.
    """

    rings: tuple[tuple[float, float], ...]
    bore: float
    rim: float
    flange: tuple[float, float]
    drum: tuple[float, float] | None = None
    modulus: float = STEEL
    poisson: float = POISSON


class Solids(NamedTuple):
    """The bodies of a drive; what is None is as in the reduced model: cam and wheel rigid, shafts beams."""

    cam: CamBody | None = None
    shaft: ShaftBody | None = None
    wheel: WheelBody | None = None


def usual_wheel(wheel: PinWheel, drive: Drivetrain, width: float, ends: int = 2) -> WheelBody:
    """A `WheelBody` where nothing is said, for cams of `width` [m].

    Rings three pin radii thick, a quarter of the width away from the cams; with ends=2 joined by a drum two pin radii thick on that side of
    the pins where the cams are not, half a pin radius away from them; with ends=1 only the one behind the last cam.
    """
    if drive.shaft is None:
        raise InputError("solid check: a solid wheel takes its axial positions from the split shaft; give the drive train a split shaft.")
    radius, pin, way = wheel.circle_radius, wheel.pin_radius, wheel.sense
    near = radius + way * (2 * wheel.eccentricity + 0.5 * pin)
    inner, outer = sorted((near, near + 2 * way * pin))
    drum = (2 * inner, 2 * outer)
    bore, rim = (2 * r for r in sorted((radius - 2.5 * way * pin, near + 2 * way * pin)))
    first, last = min(drive.shaft.cams) - 0.75 * width, max(drive.shaft.cams) + 0.75 * width
    rings = ((first - 3 * pin, first), (last, last + 3 * pin))[2 - ends :]
    return WheelBody(rings, bore, rim, drum, drum if ends == 2 else None)


def seated(shaft: SplitShaft | None, body: ShaftBody | None) -> SplitShaft | None:
    """The split shaft with seats under its supports, as wide as the bearings and of the thinner of the diameters that meet there."""
    if shaft is None or body is None:
        return shaft
    ends = np.cumsum([0.0, *(section.length for section in shaft.sections)])
    edges = [(z - body.support_width / 2, z + body.support_width / 2) for z in shaft.supports]
    cuts = np.unique(np.round([*ends, *(min(max(z, 0.0), ends[-1]) for edge in edges for z in edge)], 12))
    pieces = []
    for low, high in zip(cuts[:-1], cuts[1:], strict=True):
        middle = 0.5 * (low + high)
        spots = [middle, *(z for a, b in edges if a < middle < b for z in (a, b))]
        meeting = [shaft.sections[min(int(np.searchsorted(ends, z, side="right")) - 1, len(shaft.sections) - 1)].start for z in spots]
        pieces.append(Section(float(high - low), min(meeting), min(meeting)))
    return shaft._replace(sections=tuple(pieces))


def check(solids: Solids, wheel: PinWheel, drive: Drivetrain, cams: int) -> None:
    """InputError where the bodies have no meaning or do not fit."""
    for body in solids:
        if body is not None:
            _refuse_sizes(body)
    heights = drive.shaft.cams if drive.shaft else None
    if heights is None and (solids.shaft is not None or solids.wheel is not None):
        raise InputError(
            "solid check: solid shafts and wheels take their axial positions from the split shaft; give the drive train a split shaft."
        )
    if solids.cam is not None:
        _refuse_cam(solids.cam, drive.spacing)
    if solids.shaft is not None:
        _refuse_shaft(solids.shaft, wheel.eccentricity, drive.shaft)
    if solids.wheel is not None and heights is not None:
        width = None if solids.cam is None else solids.cam.thickness
        if width is None:
            raise InputError("solid check: the pins of a solid wheel are loaded over the width of the cams; give the cam as a solid too.")
        _refuse_wheel(solids.wheel, wheel, heights[:cams], width)


def _refuse_sizes(body):
    name = type(body).__name__
    for key, value in body._asdict().items():
        if key == "bore" and value == 0:
            continue
        if key == "poisson":
            if not -1 < value < 0.5:
                raise InputError(f"solid check: {name}.poisson = {value:g}; a solid needs -1 < nu < 0.5.")
        elif key not in ("rings", "flange", "drum") and not (np.isfinite(value) and value > 0):
            raise InputError(f"solid check: {name}.{key} = {value:g} must be above 0 and finite.")


def _refuse_cam(cam, spacing):
    if cam.hole_diameter + cam.bore >= spacing:
        raise InputError(
            f"solid check: holes of {1e3 * cam.hole_diameter:g} mm, {1e3 * spacing:g} mm apart, leave no wall between them"
            f"{f' and the bore of {1e3 * cam.bore:g} mm' if cam.bore else ''}; take smaller bearings or a wider spacing."
        )


def _refuse_shaft(body, eccentricity, shaft):
    """Every crank pin must overlap with the round shaft next to it."""
    thinnest = min(min(section.start, section.end) for section in shaft.sections)
    if eccentricity >= (body.crank_diameter + thinnest) / 2:
        raise InputError(
            f"solid check: a crank pin of {1e3 * body.crank_diameter:g} mm, {1e3 * eccentricity:g} mm off the axis, does not "
            f"reach the shaft of {1e3 * thinnest:g} mm; take a thicker one."
        )
    seats = sorted((z, body.crank_width, f"cam {j + 1}") for j, z in enumerate(shaft.cams))
    seats += [(z, body.support_width, "the support") for z in shaft.supports]
    seats = sorted([*seats, (shaft.gear, body.gear_width, "the gear")])
    for (low, wide, first), (high, other, second) in zip(seats[:-1], seats[1:], strict=True):
        if low + wide / 2 > high - other / 2 + 1e-9:
            raise InputError(
                f"solid check: the seats of {first} at {1e3 * low:g} mm and of {second} at {1e3 * high:g} mm on the split "
                "shaft overlap; make them narrower."
            )


def _refuse_wheel(body, wheel, cams, width):
    radius, pin = wheel.circle_radius, wheel.pin_radius
    if not (len(body.rings) in (1, 2) and all(high > low for low, high in body.rings)):
        raise InputError(f"solid check: WheelBody.rings = {body.rings}; give one or two rings, each from a lower to a higher z.")
    if not (body.bore / 2 < radius - pin and radius + pin < body.rim / 2):
        raise InputError(
            f"solid check: the ring of {1e3 * body.bore:g} to {1e3 * body.rim:g} mm does not hold the pins, which reach from "
            f"{2e3 * (radius - pin):g} to {2e3 * (radius + pin):g} mm."
        )
    if not body.bore <= body.flange[0] < body.flange[1] <= body.rim:
        raise InputError(
            f"solid check: WheelBody.flange = {body.flange} m lies outside the ring of {1e3 * body.bore:g} to {1e3 * body.rim:g} mm."
        )
    if body.drum is not None and not (len(body.rings) == 2 and body.bore <= body.drum[0] < body.drum[1] <= body.rim):
        raise InputError(
            f"solid check: WheelBody.drum = {body.drum} m joins two rings, and lies within {1e3 * body.bore:g} to {1e3 * body.rim:g} mm."
        )
    for z in cams:
        for low, high in body.rings:
            if z + width / 2 > low + 1e-9 and z - width / 2 < high - 1e-9:
                raise InputError(
                    f"solid check: the cam at z = {1e3 * z:g} mm runs into the ring from {1e3 * low:g} to {1e3 * high:g} mm; move the ring."
                )
