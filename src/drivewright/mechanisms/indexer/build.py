"""From the spec to a wheel with its cams and to what yields between wheel and input, in SI and in plain data."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property, lru_cache, wraps
from typing import Any, Literal, TypeVar

import numpy as np

from drivewright import bearings, materials, motion
from drivewright._typing import Floats
from drivewright.bearings import BallBearing, Entry, RollerBearing
from drivewright.errors import InputError, SpecError
from drivewright.indexing import drivetrain
from drivewright.indexing.motion import IndexMotion, index_motion, index_motion_of_rows
from drivewright.indexing.parallel import ParallelIndexer
from drivewright.indexing.pin_wheel import PinWheel
from drivewright.indexing.plane import index_angles
from drivewright.indexing.roller_gear.design import RollerGear, barrel, globoidal
from drivewright.indexing.solid import Solids
from drivewright.indexing.stiffness.loading import LoadedWheel
from drivewright.mechanisms.indexer.bodies import solid_parts
from drivewright.mechanisms.indexer.refusals import TRANSLATING, law_name, refuse_contradictions, required, stations, unused
from drivewright.mechanisms.indexer.spec import IndexerBearings, IndexerShafts, IndexerSpec

PartT = TypeVar("PartT")
ResultT = TypeVar("ResultT")
STEP = np.deg2rad(4.5)  # of the input, from position to position


@dataclass(frozen=True, eq=False)
class IndexerModel:
    """The drive (PinWheel, ParallelIndexer or RollerGear), the drive train of a pin wheel, and its rolling bearings by table name.

    compiled: whether its equilibria are solved in compiled code, as those of many designs.
    """

    spec: IndexerSpec
    drive: PinWheel | ParallelIndexer | RollerGear
    train: drivetrain.Drivetrain | None = None
    rolling: Mapping[str, BallBearing | RollerBearing] = field(default_factory=dict)
    findings: tuple[str, ...] = ()
    compiled: bool = False
    results: dict[str, Any] = field(default_factory=dict, init=False, repr=False)  # of `once`

    @property
    def wheel(self) -> PinWheel:
        """The drive of a translating kind."""
        return _of_kind(self.drive, PinWheel)

    @property
    def plane(self) -> PinWheel | ParallelIndexer:
        """The drive of a kind with plate cams."""
        return _of_kind(self.drive, (PinWheel, ParallelIndexer))

    @property
    def cam(self) -> RollerGear:
        """The drive of a kind with a roller-gear cam."""
        return _of_kind(self.drive, RollerGear)

    @property
    def roller_drive(self) -> ParallelIndexer | RollerGear:
        """The drive of a kind whose cams turn."""
        return _of_kind(self.drive, (ParallelIndexer, RollerGear))

    @property
    def translating(self) -> bool:
        """Whether the cams translate on cranks."""
        return self.spec.kind in TRANSLATING

    @property
    def flat(self) -> bool:
        """Whether the cams are plates."""
        return not isinstance(self.drive, RollerGear)

    @cached_property
    def angles(self) -> Floats:
        """Input angles [rad] of the tables: over the index period, or the one given."""
        if self.spec.load.angle is not None:
            return np.array([self.spec.load.angle])
        return index_angles(self.drive, STEP)

    @property
    def torque(self) -> float:
        """Torque on the wheel [N m]; of analyses that are left out without one."""
        return _of_kind(self.spec.load.torque, float)

    @property
    def loaded_wheel(self) -> LoadedWheel:
        """The pin wheel with its drive train, for the stiffness; of translating kinds alone."""
        train = _of_kind(self.train, drivetrain.Drivetrain) if self.spec.bodies == "rigid" else _elastic_train(self)
        return LoadedWheel(self.wheel, train, self.spec.cams, self.spec.contact.model, self.compiled)

    @property
    def rigid_wheel(self) -> LoadedWheel:
        """The same with rigid bodies, whatever the spec says of them."""
        return LoadedWheel(self.wheel, _of_kind(self.train, drivetrain.Drivetrain), self.spec.cams, self.spec.contact.model, self.compiled)

    @property
    def crank_bearing(self) -> Entry | None:
        """Catalogue entry (bore, outer_diameter, width) of the crank bearings; None where none is named."""
        return _entry(self.spec, self.spec.crank_bearings)

    @property
    def support_bearing(self) -> Entry | None:
        """The same of the support bearings."""
        return _entry(self.spec, self.spec.support_bearings)

    @property
    def solids(self) -> Solids:
        """The bodies whose size the spec gives."""
        return solid_parts(self.spec, self.crank_bearing, self.support_bearing, self.wheel, self.train)

    @property
    def pin_measures(self) -> tuple[float, float, float]:
        """Radius of a pin and width of a cam [m], effective modulus [Pa]."""
        return self.spec.pin_radius, self.spec.cam_width, self.modulus

    @property
    def modulus(self) -> float:
        """Effective modulus of pin and cam [Pa]."""
        card = materials.material(self.spec.contact.material)
        return card.modulus / (2 * (1 - card.poisson**2))


def once(function: Callable[[IndexerModel], ResultT]) -> Callable[[IndexerModel], ResultT]:
    """Decorator: what several analyses of a model need is computed by the first and kept with the model."""

    @wraps(function)
    def kept(model: IndexerModel) -> ResultT:
        name = function.__name__
        if name not in model.results:
            model.results[name] = function(model)
        return model.results[name]

    return kept


@once
def _elastic_train(model: IndexerModel) -> drivetrain.Drivetrain:
    """The drive train whose contacts and shafts yield as its bodies do; of an analysis, since it takes long."""
    from drivewright.indexing.solid.correction import elastic_train

    return elastic_train(model.wheel, _of_kind(model.train, drivetrain.Drivetrain), model.solids, cams=model.spec.cams)


def _of_kind(part: object, kind: type[PartT] | tuple[type[PartT], ...]) -> PartT:
    """The part, where it is of a type, or of one of several."""
    if not isinstance(part, kind):
        raise TypeError(f"an analysis of other kinds of indexer was asked about a {type(part).__name__}")
    return part


def build(spec: IndexerSpec) -> IndexerModel:
    """The `IndexerModel` of a spec; InputError where it has no cam."""
    refuse_contradictions(spec)
    moving, motion_findings = wheel_motion(spec)
    findings = (*motion_findings, *unused(spec))
    if spec.kind not in TRANSLATING:
        return IndexerModel(spec, OTHERS[spec.kind](spec, moving), findings=findings)
    sizes = spec.pins, spec.pin_circle_radius, spec.pin_radius, required(spec, "eccentricity")
    wheel = PinWheel(*sizes, moving, spec.side, 0.0 if spec.pin_phase is None else spec.pin_phase)
    wheel.refuse()
    tables = {"crank_bearings": spec.crank_bearings, "support_bearings": spec.support_bearings}
    rolling = {key: rolling_bearing(spec, key, given) for key, given in tables.items() if given is not None and given.bearing is not None}
    return IndexerModel(spec, wheel, drive_train(spec, rolling), rolling, findings)


def wheel_motion(spec: IndexerSpec) -> tuple[IndexMotion, tuple[str, ...]]:
    """The motion of the wheel, and what the rows of its table make of it."""
    if law_name(spec) != "table":
        return _index_motion(law_name(spec), stations(spec), motion_to_dwell(spec), **law_parameters(spec)), ()
    try:
        rows = motion.law("table", file=spec.motion.file, degree=spec.motion.degree or 5, ends="clamped")
        assert isinstance(rows, motion.TableLaw)
        moving = index_motion_of_rows(rows, stations(spec))
    except SpecError:
        raise
    except InputError as error:
        raise SpecError(str(error).removesuffix("."), "motion.file") from None
    return moving, tuple(rows.findings)


def law_parameters(spec: IndexerSpec) -> dict[str, Any]:
    """The parameters of the motion law that are given; those of a table are its rows."""
    given = {key: getattr(spec.motion, key) for key in ("b", "c", "d", "points", "degree")}
    return {key: value for key, value in given.items() if value is not None}


def motion_to_dwell(spec: IndexerSpec) -> float | Literal["no-dwell"]:
    """Angle of the step over that of the dwell; 1 unless given."""
    return 1.0 if spec.motion.motion_to_dwell is None else spec.motion.motion_to_dwell


def _parallel(spec: IndexerSpec, moving: IndexMotion) -> ParallelIndexer:
    sizes = spec.pins, spec.pin_circle_radius, spec.pin_radius, required(spec, "centre_distance")
    drive = ParallelIndexer(*sizes, moving, 0.25 if spec.pin_phase is None else spec.pin_phase)
    drive.refuse()
    return drive


def _globoidal(spec: IndexerSpec, moving: IndexMotion) -> RollerGear:
    length, distance, cam_length = (required(spec, key) for key in ("pin_length", "centre_distance", "cam_length"))
    return globoidal(moving, spec.pin_circle_radius, spec.pin_radius, length, distance, cam_length, spec.hand, *_rollers(spec))


def _barrel(spec: IndexerSpec, moving: IndexMotion) -> RollerGear:
    length, radius, cam_length = (required(spec, key) for key in ("pin_length", "cam_radius", "cam_length"))
    rollers = spec.pin_circle_radius, spec.pin_radius, length
    return barrel(moving, *rollers, radius, cam_length, spec.centre_distance, spec.hand, *_rollers(spec))


def _rollers(spec: IndexerSpec) -> tuple[float, int]:
    """Place of the rollers in the dwell, in pitches, and their number."""
    return 0.5 if spec.pin_phase is None else spec.pin_phase, spec.pins


_index_motion = lru_cache(maxsize=16)(index_motion)  # designs of one search have it in common, more often than not


OTHERS = {"parallel": _parallel, "globoidal": _globoidal, "barrel": _barrel}


def _entry(spec: IndexerSpec, given: IndexerBearings | None) -> Entry | None:
    return bearings.entry(given.bearing, spec.catalogue) if given is not None and given.bearing is not None else None


def rolling_bearing(spec: IndexerSpec, key: str, given: IndexerBearings) -> BallBearing | RollerBearing:
    """The rolling bearing of a table, with the clearance and the ratings that stand there in place of its own."""
    try:
        found = bearings.bearing(str(given.bearing), spec.catalogue)
    except InputError as error:
        raise SpecError(str(error), f"{key}.bearing") from None
    return bearings.replace_catalogue_values(found, given.radial_clearance, given.dynamic_rating, given.static_rating)


def drive_train(spec: IndexerSpec, rolling: Mapping[str, BallBearing | RollerBearing]) -> drivetrain.Drivetrain:
    """The `Drivetrain` of a spec; what has no table is rigid."""
    housing, gear = spec.housing, spec.gear
    return drivetrain.Drivetrain(
        spec.shaft_spacing or 2 * spec.pin_circle_radius,
        drivetrain.pin_contact(spec.cam_width, spec.contact.pin_stiffness),
        _bearing_model(spec.crank_bearings, rolling.get("crank_bearings")),
        _bearing_model(spec.support_bearings, rolling.get("support_bearings")),
        housing and housing.support_stiffness,
        spec.shafts and split_shaft(spec.shafts, spec.cams),
        gear and drivetrain.GearMesh(gear.module * gear.teeth / 2, gear.stiffness, gear.pressure_angle, gear.backlash),
        drivetrain.PowerLawBearing(housing.wheel_stiffness) if housing and housing.wheel_stiffness else None,
        housing and housing.wheel_torsion,
    )


def _bearing_model(given: IndexerBearings | None, rolling: BallBearing | RollerBearing | None) -> drivetrain.BearingModel | None:
    """How a bearing yields: None, a power law, or the rolling bearing itself."""
    if given is None:
        return None
    clearance = (given.radial_clearance or 0.0) / 2
    if rolling is None:
        return None if given.stiffness is None else drivetrain.PowerLawBearing(given.stiffness, clearance=clearance)
    return rolling if given.law == "elements" else drivetrain.formula_bearing(given.law, rolling, clearance)


def split_shaft(given: IndexerShafts, cams: int) -> drivetrain.SplitShaft:
    """The stepped shaft from its gear to its rear support."""
    lengths = (given.overhang, given.front, given.pitch, given.rear)
    return drivetrain.split_shaft(lengths, given.diameters, cams, given.youngs_modulus, given.shear_modulus)
