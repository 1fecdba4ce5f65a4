"""From the spec to a link, two teeth, plates and sprockets, and the results of the published method for them; SI, plain data."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from drivewright._typing import Numbers
from drivewright.chains import meshing, wear
from drivewright.chains.closure import Drive, close
from drivewright.chains.closure.model import Closure
from drivewright.chains.link import Link, design_link
from drivewright.chains.path import Balance, balanced, limit_speed
from drivewright.chains.plate import LinkMass, Plate, bar_link_mass, design_plate, mean_link_mass
from drivewright.chains.plate_holes import HingePin, Pins, joint_pins
from drivewright.chains.published_design import PublishedSprocket, published_sprocket
from drivewright.chains.roller_link import RollerLink, design_roller_link
from drivewright.chains.roller_sprocket import RollerSprocket, design_roller_sprocket
from drivewright.chains.sprocket import Sprocket, design_sprocket
from drivewright.chains.standards import StrandForces, chain_speed, pitch_diameter, strand_forces
from drivewright.chains.tooth import Cutter, matching_cutter
from drivewright.errors import InputError, SpecError
from drivewright.mechanisms.silent_chain import spec as tables
from drivewright.mechanisms.silent_chain.chain_drive import bare_drive
from drivewright.mechanisms.silent_chain.refusals import refuse_contradictions, unused
from drivewright.mechanisms.silent_chain.sizing import SizedSpec, size_findings, sized
from drivewright.mechanisms.silent_chain.spec import PAIRS, SilentChainSpec, signed_seat, size_of

BUSH = 0.9  # length of a roller chain's bushes over the pitch
BORE = 0.4  # of the smaller pitch circle
SHEET = 2e-3  # thickness of a plate  [m]
LONGEST = 0.05  # elongation
SIDES = ("drive", "driven")


@dataclass(frozen=True, eq=False)
class ChainModel:
    """The drive: `link` holds what moves; offset, apothem and `sides` are the published method's measures, None for a roller chain.

    `spec` is that of the user with what the number of the chain gives.
    """

    spec: SizedSpec
    link: Link
    offset: Numbers = 0.0
    standard_apothem: Numbers | None = None
    cutter: Cutter | None = None
    sides: tuple[PublishedSprocket, ...] = ()
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
        return link._replace(hole_pitch=link.hole_pitch + self.elongation * link.pitch)

    @cached_property
    def joint_wear(self) -> wear.JointWear | None:
        """Wear of a joint by the coefficient, then by the ends of its range; None where nothing is known of it, or nothing slides."""
        given, radius = self.spec.wear, self.pins.radius if isinstance(self.pins, HingePin) else 0.0
        if given is None or self.spec.drive is None or self.link.radius:
            return None
        length = self.contact_length if self.spec.roller else min(self.spec.plate.lacing) * self.sheet
        turns = self._articulations()
        depths = wear.joint_wear(given.coefficients, 2 * radius, length, turns, self.rows)
        time = self.spec.links * self.spec.pitch / self.chain_speed
        return wear.JointWear(wear.sliding_per_revolution(2 * radius, turns), np.asarray(depths), time)

    def _articulations(self) -> tuple[wear.Articulation, ...]:
        """Turns of a joint in a revolution of the chain, on all that bends it, under the pulls of the chain as it was new."""
        if self.plain:
            return wear.articulations(self.teeth, self.strands.tension, self.strands.slack + self.strands.centrifugal)
        return wear.path_articulations(balanced(bare_drive(self, new=True)))

    @cached_property
    def elongation(self) -> float:
        """Of the chain relative to its pitch, as given and by wear over the running time  [-]."""
        given = self.spec.wear
        worn = self.joint_wear if given and given.running_time else None
        if given is None or worn is None:
            return self.spec.closure.elongation
        total = self.spec.closure.elongation + float(worn.elongation(given.running_time, self.spec.pitch)[0])
        if total > LONGEST:
            raise SpecError(
                f"elongates the chain by {100 * total:.3g} % through wear, more than the {100 * LONGEST:g} % up to which a chain still "
                "meshes with its teeth. Choose a shorter time, or a smaller wear.coefficient",
                "wear.running_time",
            )
        return total

    @cached_property
    def closure(self) -> Closure:
        """The closed loop over one tooth of the driver."""
        driver, driven = self.teeth
        return close(Drive(self.worn, driver, driven, self.spec.links, self.spec.closure.strands))

    @cached_property
    def plate(self) -> Plate:
        """The plate of a silent chain; InputError where the lengths given leave none."""
        given = self.spec.plate
        if self.link.skew:
            raise InputError("the outline of a plate is defined for pins of one radius only, not for a joint of two radii")
        lengths = _given(back=given.back, toe=given.toe, crotch=given.crotch, crotch_radius=given.crotch_radius)
        return design_plate(self.link, self.pins, thickness=self.sheet, **lengths)

    @cached_property
    def plate_refusal(self) -> str:
        """Why the plate cannot be drawn; empty where it can."""
        try:
            _ = self.plate
        except InputError as reason:
            return str(reason)
        return ""

    @cached_property
    def link_mass(self) -> LinkMass:
        """`LinkMass` of a pitch of chain, as given or from plates and pins."""
        given, density = self.spec.plate, self.spec.material.density
        if self.spec.roller or self.plate_refusal:
            drawn = bar_link_mass(self.spec.pitch, density, self.row_width)
        else:
            drawn = mean_link_mass(self.plate, given.lacing, density, self.row_width)
        drawn = drawn._replace(mass=self.rows * drawn.mass, inertia=self.rows * drawn.inertia)
        mass = given.link_mass or drawn.mass
        return LinkMass(mass, drawn.height, given.link_inertia or drawn.inertia * mass / drawn.mass)

    @property
    def plain(self) -> bool:
        """Whether the chain goes around two sprockets alone, under a preload."""
        return not (self.spec.sprockets or self.spec.guides or self.spec.driven.centre_distance)

    @property
    def closes(self) -> bool:
        """Whether the rigid chain of two sprockets is that of this drive: nothing else takes up its length."""
        return self.spec.drive is None or not (self.spec.sprockets or any(guide.force is not None for guide in self.spec.guides))

    @property
    def preload(self) -> float:
        """Outward force on the driven sprocket [N]."""
        assert self.drive.preload is not None
        return self.drive.preload

    @cached_property
    def balance(self) -> Balance:
        """Path of the chain, tensioners and strands in balance."""
        return balanced(bare_drive(self))

    @cached_property
    def limit_speed(self) -> float:
        """Speed of the driving sprocket that takes all pull from the slackest strand [rad/s]; inf where none does."""
        return limit_speed(bare_drive(self))

    @cached_property
    def strands(self) -> StrandForces:
        """Speed of the chain and forces of its strands, under the loads of the spec."""
        drive, pitch = self.drive, self.link.pitch
        if self.plain:
            density = self.link_mass.mass / pitch
            return strand_forces(pitch, self.teeth, self.spec.links, density, drive.speed, self.preload, abs(drive.load_torque))
        pulls = self.balance.pulls
        return StrandForces(self.chain_speed, self.balance.centrifugal, float(np.max(pulls)), float(np.min(pulls)))

    @property
    def chain_speed(self) -> float:
        """Mean speed of the chain [m/s]."""
        return float(chain_speed(self.link.pitch, self.teeth[0], self.drive.speed))

    @property
    def free_plates(self) -> float:
        """Free plates of a strand between driving and driven sprocket, about."""
        return self.closure.free_plates if self.plain else 0.5 * (self.spec.links - 0.5 * sum(self.teeth))

    @property
    def pin_force(self) -> float:
        """Force of a strand on the pins of a joint [N], as given or by the loads."""
        return self.spec.contact.force or self.strands.tension

    @property
    def row_force(self) -> float:
        """The share of one row in it [N]: rows carry alike."""
        return self.pin_force / self.rows

    @property
    def rows(self) -> int:
        """Strands side by side."""
        return self.spec.rows or 1

    @property
    def contact_stiffness(self) -> float:
        """Stiffness of a place of contact, all rows together  [N/m]."""
        return self.rows * self.spec.contact.stiffness

    @property
    def joint_kind(self) -> str:
        """Kind of the joints."""
        return self.spec.joint.kind or "round-pin"

    @property
    def sheet(self) -> float:
        """Thickness of a plate [m]."""
        return self.spec.plate.thickness or SHEET

    @property
    def pins(self) -> Pins:
        """Pins of the joints and the holes they need."""
        given = self.spec.joint
        return joint_pins(
            "round-pin" if self.joint_kind in PAIRS else self.joint_kind, self.spec.pitch, min(self.teeth), given.pin_diameter
        )

    @cached_property
    def sprockets(self) -> tuple[Sprocket | RollerSprocket, ...]:
        """Both sprockets with all their teeth; InputError where the lengths given leave no teeth."""
        if not self.sides:
            return tuple(map(self.sprocket, self.teeth))
        return tuple(replace(self.sprocket(side.teeth), tooth=side.tooth) for side in self.sides)

    def sprocket(self, teeth: int) -> Sprocket | RollerSprocket:
        """A sprocket with teeth that fit this chain."""
        if self.spec.roller:
            return design_roller_sprocket(teeth, self.spec.pitch, self.roller_diameter, self.spec.roller.tooth_space)
        given = self.spec.cutter
        lengths = _given(tip_depth=given.tip_depth, root_depth=given.root_depth, tip_rounding=given.tip_rounding, tip_chamfer=given.chamfer)
        return design_sprocket(self.link, teeth, self.cutter, **lengths)

    @property
    def roller_link(self) -> RollerLink | None:
        """The link of a roller chain."""
        roller = self.spec.roller
        if roller is None:
            return None
        inner, size = roller.inner_width or self.contact_length, size_of(self.spec)
        link = design_roller_link(self.spec.pitch, self.roller_diameter, inner, self.sheet, self.spec.plate.back)
        return link._replace(inner_plate=size.inner_plate) if size and self.sheet == size.outer_plate else link

    @property
    def bore(self) -> float:
        """Diameter of the sprockets' holes [m]."""
        given = self.spec.cutter.bore
        return float(BORE * pitch_diameter(self.spec.pitch, min(self.teeth)) if given is None else given)

    @property
    def contact_length(self) -> float:
        """Length along which the pins touch, or of a roller chain's bushes [m]."""
        given = self.spec.joint.contact_length
        if given is not None:
            return given
        return BUSH * self.spec.pitch if self.spec.roller else sum(self.spec.plate.lacing) * self.sheet

    @property
    def chain_width(self) -> float:
        """Width over all rows [m]."""
        return self.row_width + (self.rows - 1) * self.row_pitch

    @property
    def row_width(self) -> float:
        """Width of the pack of plates of a row [m]; of a roller chain over its four plates."""
        return self.roller_link.width if self.roller_link else sum(self.spec.plate.lacing) * self.sheet

    @property
    def row_pitch(self) -> float:
        """Distance of the rows' middle planes [m]."""
        return self.spec.row_pitch or self.row_width

    @property
    def roller_diameter(self) -> float:
        """Diameter of the rollers, which the spec has to state [m]."""
        assert self.spec.roller is not None and self.spec.roller.diameter is not None
        return self.spec.roller.diameter


def build(spec: SilentChainSpec) -> ChainModel:
    """The `ChainModel` of a spec."""
    return _sized_model(sized(spec), (*size_findings(spec),))


def _sized_model(spec: SizedSpec, findings: tuple[str, ...]) -> ChainModel:
    refuse_contradictions(spec)
    findings += tuple(unused(spec))
    radius = 0.0 if spec.joint.kind == "revolute" or spec.joint.rolling_radius is None else spec.joint.rolling_radius
    if spec.roller:
        return ChainModel(spec, design_link(spec.pitch, 0.0, spec.plate.flank_angle, 0.0), findings=findings)
    if spec.joint.kind in PAIRS:
        return _pair_model(spec, findings)
    offset = offset_of(spec, radius)
    angle = spec.plate.flank_angle
    apothem: Numbers | None = spec.plate.apothem
    if apothem is None:
        assert spec.plate.standard_apothem is not None  # one of the two is given
        apothem = spec.plate.standard_apothem - meshing.standard_apothem(0.0, radius, offset, angle)
    standard = meshing.standard_apothem(apothem, radius, offset, angle, spec.meshing.apothem_reference)
    cutter = matching_cutter(spec.pitch, angle, spec.cutter.half_angle)
    cutter = cutter if spec.cutter.pitch is None else cutter._replace(pitch=spec.cutter.pitch)
    sides = tuple(published_sprocket(spec.pitch, radius, offset, standard, angle, cutter, z, spec.meshing.ideal) for z in spec.teeth)
    link = design_link(spec.pitch, radius, angle, apothem)  # pyright: ignore[reportArgumentType]  arrays, of many designs
    return ChainModel(spec, link, offset, standard, cutter, sides, findings)


def _pair_model(spec: SizedSpec, findings: tuple[str, ...]) -> ChainModel:
    """Of a joint of two radii: without the measures of the published method, which has one."""
    own, seat, angle, apothem = spec.joint.rolling_radius, signed_seat(spec.joint), spec.plate.flank_angle, spec.plate.apothem
    assert own is not None and apothem is not None  # else refused
    link = design_link(spec.pitch, 0.5 * (own + seat), angle, apothem, 0.5 * (own - seat))
    cutter = matching_cutter(spec.pitch, angle, spec.cutter.half_angle)
    cutter = cutter if spec.cutter.pitch is None else cutter._replace(pitch=spec.cutter.pitch)
    return ChainModel(spec, link, cutter=cutter, findings=findings)


def offset_of(spec: SizedSpec, radius: Numbers) -> Numbers:
    """Offset of the pins [m], as given or by its rule."""
    given = spec.joint.offset
    return meshing.offset_by_rule(given, spec.pitch, radius, *spec.teeth, spec.meshing.ideal) if isinstance(given, str) else given


def _given(**lengths: float | None) -> dict[str, float]:
    """Those lengths that are given [m]."""
    return {name: length for name, length in lengths.items() if length is not None}
