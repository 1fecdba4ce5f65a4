"""Spec -> model: kinematics of the step, motion of the crank, outlines of wheel and disc, materials, bearing."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from drivewright import bearings, materials, motion
from drivewright.bearings import BallBearing, RollerBearing
from drivewright.chains.plate_outline import area_moments
from drivewright.contact.hertz import effective_modulus
from drivewright.errors import InputError, SpecError
from drivewright.indexing.geneva.crank import Crank, CrankSamples
from drivewright.indexing.geneva.forces import PinFriction
from drivewright.indexing.geneva.shapes import GenevaShape
from drivewright.indexing.geneva.step import GenevaStep
from drivewright.mechanisms.geneva.spec import GenevaSpec
from drivewright.numerics.jets import Jet
from drivewright.scene import circle

JOURNAL = 0.5  # radius of the journal in a roller, over that of the roller
LOCKING = 3.0  # radii of the pin by which the locking disc is smaller than the pin's circle


@dataclass(frozen=True, eq=False)
class GenevaModel:
    """The model of a drive."""

    spec: GenevaSpec
    step: GenevaStep
    shape: GenevaShape
    crank: Crank
    rolling: BallBearing | RollerBearing | None = None  # the rolling bearing of the wheel

    @cached_property
    def samples(self) -> CrankSamples:
        """A turn of the crank."""
        return self.crank.samples(self.step.half_engagement)

    @cached_property
    def wheel_by_angle(self) -> Jet:
        """Angle of the wheel over the samples and its derivatives by the crank angle."""
        return self.step.wheel(self.samples.angle, self.samples.engaged)

    @cached_property
    def wheel_by_time(self) -> Jet:
        """Angle, speed, acceleration and jerk of the wheel over the samples."""
        crank, over = self.samples, self.wheel_by_angle
        w, a, j = crank.speed, crank.acceleration, crank.jerk
        return Jet(over.d0, over.d1 * w, over.d2 * w**2 + over.d1 * a, over.d3 * w**3 + 3 * over.d2 * w * a + over.d1 * j)

    @property
    def steady(self) -> bool:
        """Whether the crank turns at constant speed."""
        return self.crank.law is None

    @property
    def entry_speed(self) -> float:
        """Speed of the crank at entry [rad/s]."""
        return float(self.crank.at(np.array(self.crank.part_at(-self.step.half_engagement)))[1])

    @property
    def friction(self) -> PinFriction:
        """Friction at pin and bearing."""
        pin, bearing = self.spec.pin, self.spec.bearing
        share = 1.0 if pin.kind == "fixed" else self.journal_radius / pin.radius
        return PinFriction(pin.friction * share, share, bearing.friction * (bearing.radius or 0.0))

    @property
    def journal_radius(self) -> float:
        """Radius of the journal in a roller [m]."""
        given = self.spec.pin.journal_radius
        return JOURNAL * self.spec.pin.radius if given is None else given

    @property
    def modulus(self) -> float:
        """Effective modulus of pin and wheel [Pa]."""
        pin, wheel = materials.material(self.spec.pin.material), materials.material(self.spec.wheel.material)
        return float(effective_modulus(pin.modulus, pin.poisson, wheel.modulus, wheel.poisson))

    @cached_property
    def wheel_solid(self) -> tuple[float, float]:
        """Mass [kg] of the wheel with bore and hub, and its moment of inertia about its axis [kg m^2]."""
        wheel = self.spec.wheel
        density = materials.material(wheel.material).density
        plate = area_moments(self.shape.wheel_outline)
        area, polar = plate.area * wheel.thickness, plate.polar * wheel.thickness
        if wheel.hub_diameter:
            area, polar = _added(area, polar, wheel.hub_diameter / 2, wheel.hub_length)
        if wheel.bore:
            area, polar = _added(area, polar, wheel.bore / 2, -wheel.thickness - (wheel.hub_length if wheel.hub_diameter else 0.0))
        return density * area, density * polar

    @property
    def inertia(self) -> float:
        """Moment of inertia of all that the pin moves [kg m^2]."""
        return self.spec.load.inertia + self.wheel_solid[1]


def _added(area, polar, radius, length):
    """Volume and polar moment with a disc more, or with one of negative length less."""
    moments = area_moments(circle((0.0, 0.0), radius))
    return area + moments.area * length, polar + moments.polar * length


def build(spec: GenevaSpec) -> GenevaModel:
    """The `GenevaModel` of a spec; SpecError where wheel or disc do not exist."""
    step = _step(spec)
    for key, name in (("pin.material", spec.pin.material), ("wheel.material", spec.wheel.material)):
        _known(materials.material, key, name)
    if spec.bearing.friction and spec.bearing.radius is None:
        raise SpecError("is missing: the friction of the bearing needs the radius at which it acts", "bearing.radius")
    law = None if spec.drive.law == "uniform" else motion.law(spec.drive.law)
    rolling = _known(bearings.bearing, "bearing.bearing", spec.bearing.bearing) if spec.bearing.bearing else None
    return GenevaModel(spec, step, _shape(spec, step), Crank(spec.drive.speed, law), rolling)


def _step(spec):
    """Centre distance and crank radius; the one that is not given fits the other."""
    sine = float(np.sin(np.pi / spec.slots))
    centre, crank = spec.centre_distance, spec.crank_radius
    if centre is None and crank is None:
        raise SpecError("is missing: give centre_distance, crank_radius, or both", "centre_distance")
    if centre is None:
        centre = crank / sine
    if crank is None:
        crank = centre * sine
    if crank >= centre:
        raise SpecError(
            f"{1e3 * crank:.4g} mm reaches the axis of the wheel, {1e3 * centre:.4g} mm away; the pin enters along the slot with "
            f"{1e3 * centre * sine:.5g} mm",
            "crank_radius",
        )
    return GenevaStep(spec.slots, centre, crank)


def _known(find, key, name):
    """What a name stands for; SpecError with its key where it stands for nothing."""
    try:
        return find(name)
    except InputError as error:
        raise SpecError(str(error), key) from None


def _shape(spec, step):
    pin, wheel, locking = spec.pin.radius, spec.wheel, spec.locking
    along = step.centre_distance * float(np.cos(step.half_pitch))
    outer = float(np.hypot(along, pin + wheel.slot_clearance / 2)) if wheel.outer_radius is None else wheel.outer_radius
    radius = step.crank_radius - LOCKING * pin if locking.radius is None else locking.radius
    shape = GenevaShape(step, pin, wheel.slot_clearance, wheel.end_clearance, outer, radius, locking.clearance, locking.relief)
    _refuse_slots(spec, shape)
    _refuse_locking(spec, shape)
    return shape


def _refuse_slots(spec, shape):
    """A wheel whose slots meet, or that has none."""
    step = shape.step
    if shape.slot_wall <= 0 or shape.slot_bottom <= 0:
        most = (step.centre_distance - step.crank_radius - shape.end_clearance) / (1 + 1 / np.sin(step.half_pitch))
        raise SpecError(
            f"{1e3 * shape.pin_radius:.4g} mm is so thick that the slots meet at their bottoms, and the wheel falls apart; "
            f"take a thinner pin (below about {1e3 * max(most, 0):.3g} mm), more distance of the axes or fewer slots",
            "pin.radius",
        )
    if shape.outer_radius >= step.centre_distance:
        raise SpecError(
            f"reaches the axis of the crank, {1e3 * step.centre_distance:.4g} mm away; make the wheel smaller", "wheel.outer_radius"
        )
    if shape.side_end <= shape.slot_end + 1e-3 * shape.slot_width:
        key = "wheel.outer_radius" if shape.undercut == 0 else "locking.radius" if spec.locking.radius else "pin.radius"
        raise SpecError(
            "leaves no sides to the slots of the wheel; enlarge the wheel, or take a smaller locking disc or a thinner pin", key
        )


def _refuse_locking(spec, shape):
    """A disc that does not exist or does not reach the wheel."""
    step, key = shape.step, "pin.radius" if spec.locking.radius is None else "locking.radius"
    least = step.centre_distance - shape.outer_radius
    if shape.locking_radius <= 0 or shape.arc_radius <= least * (1 + 1e-9):
        raise SpecError(
            f"leaves a locking disc of {1e3 * shape.locking_radius:.4g} mm, which does not reach the wheel; its radius must be above "
            f"{1e3 * max(least - shape.locking_clearance, 0.0):.4g} mm: take a thinner pin, or give locking.radius",
            key,
        )
