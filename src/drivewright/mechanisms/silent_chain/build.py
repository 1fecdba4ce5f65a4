"""From the spec to a link, two teeth, plates and sprockets, and what the published method says of them; SI, plain data."""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from drivewright._typing import Numbers
from drivewright.chains import meshing
from drivewright.chains.closure import Drive, close
from drivewright.chains.closure.model import Closure
from drivewright.chains.link import Link, design_link, seat_height
from drivewright.chains.plate import Plate, design_plate
from drivewright.chains.plate_holes import HingePin, Pins, RockerPins, RoundPins
from drivewright.chains.roller_sprocket import RollerSprocket, design_roller_sprocket
from drivewright.chains.sprocket import Sprocket, design_sprocket
from drivewright.chains.standards import pitch_diameter
from drivewright.chains.tooth import Cutter, Tooth, cut_tooth, matching_cutter
from drivewright.errors import InputError
from drivewright.mechanisms.silent_chain import spec as tables
from drivewright.mechanisms.silent_chain.refusals import refuse_contradictions, unused
from drivewright.mechanisms.silent_chain.spec import SilentChainSpec

BUSH = 0.9  # length of a roller chain's bushes over the pitch
BORE = 0.4  # of the smaller pitch circle
SIDES = ("drive", "driven")
LEAST_TURNED = 17  # teeth: joints turn as far as on a sprocket with so many, or with fewer where there is one
HINGE = 0.125  # radius of a hinge's pin over the pitch
ROCKER = (0.17, 0.21, 0.02)  # radius of a rocker's back, its thickness, its clearance, over the pitch


class Side(NamedTuple):
    """One sprocket as the published method sees it, lengths in m: seated and ideal pitch, their difference, seated apothem fp'',
    modification x, positioning diameter dp, and the tooth that is cut.  Arrays where the spec's numbers are those of many designs."""

    teeth: int
    seated_pitch: Numbers
    ideal_pitch: Numbers
    deviation: Numbers
    seated_apothem: Numbers
    modification: Numbers
    positioning_diameter: Numbers
    tooth: Tooth


@dataclass(frozen=True, eq=False)
class ChainModel:
    """The drive: `link` holds what moves; offset, apothem and `sides` are the published method's measures, None for a roller chain."""

    spec: SilentChainSpec
    link: Link
    offset: Numbers = 0.0
    standard_apothem: Numbers | None = None
    cutter: Cutter | None = None
    sides: tuple[Side, ...] = ()
    findings: tuple[str, ...] = ()

    @property
    def teeth(self) -> tuple[int, int]:
        """Teeth of the driving and of the driven sprocket."""
        return self.spec.teeth

    @property
    def drive(self) -> tables.Drive:
        """Speed and loads, which the spec has to state."""
        assert self.spec.drive is not None
        return self.spec.drive

    @property
    def worn(self) -> Link:
        """The link as long as wear has made it."""
        return self.lengthened(self.link)

    def lengthened(self, link: Link) -> Link:
        """A link with the wear of this chain."""
        return link._replace(hole_pitch=link.hole_pitch + self.spec.closure.elongation * link.pitch)

    @cached_property
    def closure(self) -> Closure:
        """The closed loop over one tooth of the driver."""
        driver, driven = self.teeth
        return close(Drive(self.worn, driver, driven, self.spec.links, self.spec.closure.strands))

    @cached_property
    def plate(self) -> Plate:
        """The plate of a silent chain; InputError where the lengths given leave none."""
        given = self.spec.plate
        lengths = {name: value for name in ("back", "toe", "crotch", "crotch_radius") if (value := getattr(given, name)) is not None}
        return design_plate(self.link, self.pins, thickness=given.thickness, **lengths)

    @cached_property
    def plate_refusal(self) -> str:
        """Why the plate cannot be drawn; empty where it can."""
        try:
            _ = self.plate
        except InputError as reason:
            return str(reason)
        return ""

    @property
    def pins(self) -> Pins:
        """Pins of the joints and the holes they need."""
        given, p = self.spec.joint, self.spec.pitch
        if given.kind == "revolute":
            return HingePin(0.5 * given.pin_diameter if given.pin_diameter else HINGE * p)
        turn = max(2 * np.pi / LEAST_TURNED, 2.2 * np.pi / min(self.teeth))
        if given.kind == "round-pin":
            return RoundPins(turn=turn)
        back, thickness, clearance = (share * p for share in ROCKER)
        return RockerPins(back, thickness, clearance, turn)

    @cached_property
    def sprockets(self) -> tuple[Sprocket | RollerSprocket, ...]:
        """Both sprockets with all their teeth; InputError where the lengths given leave no teeth."""
        if self.spec.roller:
            return tuple(
                design_roller_sprocket(z, self.spec.pitch, self.spec.roller.diameter, self.spec.roller.tooth_space) for z in self.teeth
            )
        return tuple(self.sprocket(side.teeth, side.tooth) for side in self.sides)

    def sprocket(self, teeth: int, tooth: Tooth) -> Sprocket:
        """A sprocket for this chain with a given tooth."""
        given, height = self.spec.cutter, seat_height(self.link, teeth)
        depths = {"tip_radius": given.tip_depth, "root_radius": given.root_depth}
        lengths = {name: height - depth for name, depth in depths.items() if depth is not None}
        lengths |= {
            name: value for name, value in (("tip_rounding", given.tip_rounding), ("tip_chamfer", given.chamfer)) if value is not None
        }
        return replace(design_sprocket(self.link, teeth, self.cutter, **lengths), tooth=tooth)

    @property
    def bore(self) -> float:
        """Diameter of the sprockets' holes [m]."""
        given = self.spec.cutter.bore
        return float(BORE * pitch_diameter(self.spec.pitch, min(self.teeth)) if given is None else given)

    @property
    def contact_length(self) -> float:
        """Length along which the pins touch, or of a roller chain's bushes [m]."""
        given, plate = self.spec.joint.contact_length, self.spec.plate
        if given is not None:
            return given
        return BUSH * self.spec.pitch if self.spec.roller else sum(plate.lacing) * plate.thickness

    @property
    def chain_width(self) -> float:
        """Width of the pack of plates [m]; of a roller chain over its four rows of plates."""
        plate = self.spec.plate
        return self.contact_length + 4 * plate.thickness if self.spec.roller else sum(plate.lacing) * plate.thickness


def build(spec: SilentChainSpec) -> ChainModel:
    """The `ChainModel` of a spec."""
    refuse_contradictions(spec)
    radius = 0.0 if spec.joint.kind == "revolute" or spec.joint.rolling_radius is None else spec.joint.rolling_radius
    if spec.roller:
        return ChainModel(spec, design_link(spec.pitch, 0.0, spec.plate.flank_angle, 0.0), findings=tuple(unused(spec)))
    offset = offset_of(spec, radius)
    angle = spec.plate.flank_angle
    apothem: Numbers | None = spec.plate.apothem
    if apothem is None:
        assert spec.plate.standard_apothem is not None  # one of the two is given
        apothem = spec.plate.standard_apothem - meshing.standard_apothem(0.0, radius, offset, angle)
    standard = meshing.standard_apothem(apothem, radius, offset, angle, spec.meshing.apothem_reference)
    cutter = matching_cutter(spec.pitch, angle, spec.cutter.half_angle)
    cutter = cutter if spec.cutter.pitch is None else cutter._replace(pitch=spec.cutter.pitch)
    sides = tuple(_side(spec, radius, offset, standard, cutter, z) for z in spec.teeth)
    link = design_link(spec.pitch, radius, angle, apothem)  # pyright: ignore[reportArgumentType]  arrays, of many designs
    return ChainModel(spec, link, offset, standard, cutter, sides, tuple(unused(spec)))


def offset_of(spec: SilentChainSpec, radius: float) -> Numbers:
    """Offset of the pins [m], as given or by its rule."""
    given, (z1, z2), ideal = spec.joint.offset, spec.teeth, spec.meshing.ideal
    if not isinstance(given, str):
        return given
    if given == "match-drive":
        return meshing.matching_offset(spec.pitch, radius, z1, ideal)
    return meshing.minimax_offset(spec.pitch, radius, z1, z2, ideal)


def _side(spec, radius, offset, standard, cutter, teeth):
    pitch, angle = spec.pitch, spec.plate.flank_angle
    seated = meshing.seated_pitch(meshing.hole_pitch(pitch, radius), radius, offset, teeth)
    apothem = meshing.seated_apothem(standard, pitch, seated, angle)
    shift = meshing.modification(apothem, seated, teeth, angle, *cutter)
    return Side(
        teeth,
        seated,
        meshing.ideal_pitch(pitch, teeth, spec.meshing.ideal),
        meshing.pitch_deviation(pitch, radius, offset, teeth, spec.meshing.ideal),
        apothem,
        shift,
        meshing.positioning_diameter(seated, teeth),
        cut_tooth(teeth, cutter, shift, angle),
    )
