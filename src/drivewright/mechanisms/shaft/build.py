"""From the spec to a shaft on supports under loads, in SI and in plain data."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from drivewright import bearings, materials, shafts
from drivewright._typing import Floats
from drivewright.bearings import BallBearing, RollerBearing
from drivewright.errors import InputError, SpecError
from drivewright.mechanisms.shaft.bearing_table import Bearing
from drivewright.mechanisms.shaft.refusals import is_rolling, refuse_contradictions
from drivewright.mechanisms.shaft.spec import ShaftSpec
from drivewright.mechanisms.shaft.tables import Analysis, Carried, Gear
from drivewright.shafts.tables import UNIT_LOADS
from drivewright.spec.csv_columns import read_columns

DOWN = np.array([0.0, -1.0])


@dataclass(frozen=True)
class ShaftModel:
    """Shaft, loads, and the rolling bearings among its supports by name."""

    spec: ShaftSpec
    shaft: shafts.Shaft
    loads: shafts.ShaftLoads
    rolling: Mapping[str, BallBearing | RollerBearing]
    yield_strength: float | None

    @property
    def direction(self) -> Floats:
        """Unit vector (x, y) of the unit loads: as given, else that of the loads where they have one, else down."""
        given = self.spec.analysis.direction
        return common_direction(self.spec) if given is None else shafts.transverse_direction(given)

    @property
    def direction_words(self) -> tuple[str, str]:
        """What lies along `direction`, and 90° clockwise from it: the unit loads, where there are stations that they act on."""
        if self.spec.stations:
            return UNIT_LOADS
        if self.spec.analysis.direction is not None:
            return "along the given direction", "across the given direction, 90° clockwise from it"
        if np.array_equal(self.direction, DOWN):
            return "along -y", "along -x"
        return "along the loads", "across the loads, 90° clockwise from them"

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the stations."""
        return tuple(station.name for station in self.shaft.stations)

    @property
    def places(self) -> list[float]:
        """Places [m] of the stations."""
        return [station.position for station in self.shaft.stations]

    @property
    def sprung(self) -> frozenset[str]:
        """Names of the bearings that are linear springs, whatever carries them."""
        return frozenset(b.name for b in self.spec.bearings if not is_rolling(b) and not b.table and not b.radial_clearance)

    @property
    def turning_parts(self) -> tuple[Carried, ...]:
        """Stations, and the gears that have a mass or an unbalance: what an unbalance moves."""
        return (*self.spec.stations, *(gear for gear in self.spec.gears if gear.mass or gear.unbalance))

    @property
    def loaded(self) -> bool:
        """Whether anything acts on the shaft: a load, a preload, a seat off the axis."""
        pushed = any(b.preload or any(b.seat_offset) or any(b.seat_tilt) for b in self.spec.bearings)
        return bool(self.loads.points or self.loads.lines or any(self.loads.gravity) or pushed)


def build(spec: ShaftSpec) -> ShaftModel:
    """The `ShaftModel` of a spec; InputError where its bearings do not hold it."""
    refuse_contradictions(spec)
    given = spec.material
    material = materials.properties(given.card, given.youngs_modulus, given.poisson_ratio, given.density, given.yield_strength)
    rolling = {b.name: rolling_bearing(spec, b) for b in spec.bearings if is_rolling(b)}
    mirrored = _mirrored(spec, rolling)
    shaft = shafts.Shaft(
        tuple(shafts.Section(s.length, s.diameter, s.end_diameter or s.diameter, s.bore) for s in spec.segments),
        material.modulus,
        material.poisson,
        material.density,
        tuple(_support(b, rolling.get(b.name), b.name in mirrored) for b in spec.bearings),
        tuple(map(_carried, spec.stations)),
        _shear_coefficient(spec.analysis),
        spec.analysis.theory != "euler-bernoulli",
        tuple(map(_carried, spec.gears)),
    )
    loads = shafts.ShaftLoads(tuple(_points(spec)), tuple(_lines(spec)), tuple(spec.gravity))
    shafts.refuse_mechanism(shaft)
    for notch in spec.notches:
        try:
            shafts.refuse_impossible_notch(shaft, notch.notch())
        except InputError as error:
            raise SpecError(str(error).removeprefix(f"{notch.name}: "), f"notches.{notch.name}") from None
    return ShaftModel(spec, shaft, loads, rolling, material.yield_strength)


def _carried(part: Carried) -> shafts.Station:
    return shafts.Station(part.name, part.position, part.mass, part.polar_inertia, part.diametral_inertia)


def _shear_coefficient(analysis: Analysis) -> float:
    if analysis.theory != "timoshenko":
        return shafts.EULER_BERNOULLI
    return shafts.COWPER if analysis.shear_coefficient == "cowper" else float(analysis.shear_coefficient)


def common_direction(spec: ShaftSpec) -> Floats:
    """Unit vector along the angle of the loads where all of them lie in one plane; down otherwise."""
    ways = [shafts.transverse_direction(load.angle) for load in (*spec.loads, *spec.line_loads) if load.force]
    weight = [np.asarray(spec.gravity[:2])] if any(spec.gravity[:2]) else []
    return ways[0] if ways and not spec.gears and shafts.are_coplanar([*ways, *weight]) else DOWN


# -- supports ------------------------------------------------------------------------------------------------------------------


def _mirrored(spec: ShaftSpec, rolling: Mapping[str, BallBearing | RollerBearing]) -> set[str]:
    """Names of the bearings that take an axial force to the left; those with a contact angle in turn from the left unless it is given."""
    inclined = sorted((b for b in spec.bearings if b.name in rolling and rolling[b.name].contact_angle), key=lambda b: b.position)
    in_turn = {bearing.name: ("right", "left")[number % 2] for number, bearing in enumerate(inclined)}
    return {b.name for b in spec.bearings if (b.carries or in_turn.get(b.name, "right")) == "left"}


def _support(bearing: Bearing, rolling: BallBearing | RollerBearing | None, mirrored: bool) -> shafts.Support:
    """The `Support` of a bearing."""
    housing, offset = (bearing.housing_stiffness, bearing.housing_axial_stiffness), (*bearing.seat_offset, 0.0, *bearing.seat_tilt)
    seat = {"housing": housing, "offset": offset, "width": bearing.width, "damping": _damping(bearing)}
    if rolling is not None:
        try:
            return shafts.rolling_support(
                bearing.name, bearing.position, rolling, preload=bearing.preload, mirrored=mirrored, free=bearing.free, **seat
            )
        except InputError as error:  # of the preload alone: the shaft is not loaded yet
            raise SpecError(f"this bearing takes no axial force: {error}", f"bearings.{bearing.name}.preload") from None
    radial = bearing.radial_stiffness or 0.0
    if bearing.stiffness_xx is not None:
        radial = (bearing.stiffness_xx, bearing.stiffness_yy or 0.0)
    if bearing.table is not None:
        rows = read_columns(bearing.table, {"displacement": "length"}, {"force": "force"})
        radial = shafts.tabulated(rows.x, rows.y)
    elif bearing.radial_clearance:
        radial = shafts.with_play(radial, bearing.radial_clearance / 2)
    cross = (bearing.stiffness_xy, bearing.stiffness_yx)
    return shafts.spring_support(
        bearing.name, bearing.position, radial, bearing.axial_stiffness or 0.0, bearing.tilt_stiffness or 0.0, cross=cross, **seat
    )


def _damping(bearing: Bearing) -> shafts.PlaneMatrix:
    xx, yy = (bearing.radial_damping if own is None else own for own in (bearing.damping_xx, bearing.damping_yy))
    return (xx, bearing.damping_xy), (bearing.damping_yx, yy)


def rolling_bearing(spec: ShaftSpec, bearing: Bearing) -> BallBearing | RollerBearing:
    """The rolling bearing of a table, with the clearance and the ratings that stand there in place of its own."""
    found = bearing.geometry or bearing.roller_geometry or _named_or_estimated(spec, bearing)
    return bearings.replace_catalogue_values(found, bearing.radial_clearance, bearing.dynamic_rating, bearing.static_rating)


def _named_or_estimated(spec: ShaftSpec, bearing: Bearing) -> BallBearing | RollerBearing:
    """The bearing of a designation, or of an envelope."""
    where = f"bearings.{bearing.name}"
    try:
        if bearing.envelope is not None:
            return bearings.bearing_of_envelope(bearing.envelope)
        return bearings.bearing(str(bearing.bearing), spec.catalogue)
    except SpecError as error:
        raise error.located(f"{where}.envelope.{error.key}" if bearing.envelope else error.key) from None
    except InputError as error:
        raise SpecError(str(error), f"{where}.bearing") from None


# -- loads ---------------------------------------------------------------------------------------------------------------------


def _points(spec: ShaftSpec) -> Iterator[shafts.ShaftLoad]:
    places = {station.name: station.position for station in spec.stations}
    for load in spec.loads:
        place = places[str(load.station)] if load.position is None else load.position
        force = load.force * shafts.transverse_direction(load.angle)
        moment = load.moment * shafts.transverse_direction(load.moment_angle)
        yield shafts.ShaftLoad(place, (*force, load.axial_force), (*moment, load.torque))
    yield from map(tooth_load, spec.gears)


def tooth_load(gear: Gear) -> shafts.ShaftLoad:
    """The load of a gear's teeth."""
    return shafts.tooth_load(
        gear.position, gear.pitch_diameter, gear.torque, gear.mesh_angle, gear.pressure_angle, helix_angle=gear.helix_angle
    )


def _lines(spec: ShaftSpec) -> Iterator[shafts.LineLoad]:
    for load in spec.line_loads:
        way = shafts.transverse_direction(load.angle)
        last = load.force if load.end_force is None else load.end_force
        yield shafts.LineLoad(load.start, load.end, tuple(load.force * way), tuple(last * way))
