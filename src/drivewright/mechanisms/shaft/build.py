"""From the spec to a shaft on supports under loads, in SI and in plain data."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from drivewright import bearings, materials, shafts
from drivewright.errors import InputError, SpecError
from drivewright.mechanisms.shaft.refusals import is_rolling, refuse_contradictions
from drivewright.spec.csv_columns import read_columns
from drivewright.units import SI

STEEL = {"youngs_modulus": 206e9, "poisson_ratio": 0.3, "density": 7850.0, "yield_strength": None}
DOWN = np.array([0.0, -1.0])
CARD = {"youngs_modulus": "modulus", "poisson_ratio": "poisson", "density": "density", "yield_strength": "yield_strength"}


@dataclass(frozen=True)
class ShaftModel:
    """Shaft, loads, and the rolling bearings among its supports by name."""

    spec: Any
    shaft: Any
    loads: Any
    rolling: dict
    yield_strength: float | None

    @property
    def direction(self):
        """Unit vector (x, y) of the unit loads: as asked for, else that of the loads where they have one, else down."""
        asked = self.spec.analysis.direction
        return common_direction(self.spec) if asked is None else across(asked)

    @property
    def names(self):
        return tuple(station.name for station in self.shaft.stations)

    @property
    def places(self):
        return [station.position for station in self.shaft.stations]

    @property
    def loaded(self):
        """Whether anything acts on the shaft: a load, a preload, a seat off the axis."""
        pushed = any(b.preload or any(b.seat_offset) or any(b.seat_tilt) for b in self.spec.bearings)
        return bool(self.loads.points or self.loads.lines or any(self.loads.gravity) or pushed)


def build(spec):
    """The `ShaftModel` of a spec; InputError where its bearings do not hold it."""
    refuse_contradictions(spec)
    stuff = material(spec.material)
    rolling = {b.name: rolling_bearing(spec, b) for b in spec.bearings if is_rolling(b)}
    shaft = shafts.Shaft(
        tuple(shafts.Section(s.length, s.diameter, s.end_diameter or s.diameter, s.bore) for s in spec.segments),
        stuff["youngs_modulus"],
        stuff["poisson_ratio"],
        stuff["density"],
        tuple(support(b, rolling.get(b.name)) for b in spec.bearings),
        tuple(shafts.Station(s.name, s.position, s.mass, s.polar_inertia, s.diametral_inertia) for s in spec.stations),
        shear(spec.analysis),
    )
    loads = shafts.ShaftLoads(tuple(_points(spec)), tuple(_lines(spec)), tuple(spec.gravity))
    shafts.refuse_mechanism(shaft)
    return ShaftModel(spec, shaft, loads, rolling, stuff["yield_strength"])


def material(given):
    """The numbers of the material: as given, else of its card, else of steel."""
    card = materials.material(given.card) if given.card else None
    return {key: first_given(getattr(given, key), getattr(card, CARD[key], None), usual) for key, usual in STEEL.items()}


def first_given(*values):
    """The first that is not None, else None."""
    return next((value for value in values if value is not None), None)


def shear(analysis):
    if analysis.theory == "euler-bernoulli":
        return shafts.EULER_BERNOULLI
    return shafts.COWPER if analysis.shear_coefficient == "cowper" else float(analysis.shear_coefficient)


def across(angle):
    """Unit vector (x, y), exact along the axes."""
    turn = np.exp(1j * angle)
    return np.where(np.abs([turn.real, turn.imag]) < 1e-15, 0.0, [turn.real, turn.imag])


def common_direction(spec):
    """Unit vector along the angle of the loads where all of them lie in one plane; down otherwise."""
    ways = [across(load.angle) for load in (*spec.loads, *spec.line_loads) if load.force]
    others = [np.asarray(spec.gravity[:2])] if any(spec.gravity[:2]) else []
    flat = all(abs(ways[0][0] * way[1] - ways[0][1] * way[0]) < 1e-9 * np.hypot(*way) for way in (*ways, *others)) if ways else False
    return ways[0] if flat and not spec.gears else DOWN


# -- supports ------------------------------------------------------------------------------------------------------------------


def support(bearing, rolling):
    """The `Support` of a bearing."""
    about = {"offset": (*bearing.seat_offset, 0.0, *bearing.seat_tilt), "width": bearing.width}
    if rolling is not None:
        return _rolling_support(bearing, rolling, about)
    radial, axial, tilt = bearing.radial_stiffness, bearing.axial_stiffness or 0.0, bearing.tilt_stiffness or 0.0
    housing = (bearing.housing_stiffness,) * 2 + (bearing.housing_axial_stiffness, np.inf, np.inf)
    if bearing.table is not None:
        law, radial = shafts.tabulated(*_table(bearing)), 0.0
    elif bearing.radial_clearance:
        law, radial = shafts.with_play(radial, bearing.radial_clearance / 2), 0.0
    else:
        radial, axial = _series(radial or 0.0, housing[0]), _series(axial, housing[2])
        return shafts.Support(bearing.name, bearing.position, (radial, radial, axial, tilt, tilt), **about)
    return shafts.Support(bearing.name, bearing.position, (0.0, 0.0, axial, tilt, tilt), law, seat=housing, **about)


def _series(one, two):
    return 1 / (1 / one + 1 / two) if one > 0 and np.isfinite(min(one, two)) else min(one, two)


def _table(bearing):
    """(displacement, force) of a bearing's CSV."""
    rows = read_columns(bearing.table, {"displacement": "length"}, {"force": "force"})
    return rows.x, rows.y


def rolling_bearing(spec, bearing):
    """The rolling bearing of a table, with the clearance and the ratings that stand there in place of its own."""
    if bearing.bearing is not None:
        try:
            found = bearings.bearing(bearing.bearing, spec.catalogue)
        except InputError as error:
            raise SpecError(str(error), f"bearings.{bearing.name}.bearing") from None
    else:
        found = bearing.geometry or bearing.roller_geometry
    keys = ("radial_clearance", "dynamic_rating", "static_rating")
    changes = {key: getattr(bearing, key) for key in keys if getattr(bearing, key) is not None}
    return replaced(found, changes) if changes else found


def replaced(table, changes):
    """A spec table with some SI numbers changed."""
    return table.replace(**{key: SI(value) for key, value in changes.items()})


def _rolling_support(bearing, rolling, about):
    law, mirrored = bearings.law_of(rolling), bearing.carries == "left"
    seat = [bearing.housing_stiffness] * 2 + [bearing.housing_axial_stiffness, np.inf, np.inf]
    push = [0.0] * 5
    place = 0.0 if rolling.contact_angle else bearings.measures(law).centre
    if "tilt" in bearing.free:
        seat[3:] = 0.0, 0.0
    if bearing.preload:
        place = _mounted(bearing, rolling)  # refuses a bearing that takes no axial force
    if "axial" in bearing.free:
        seat[2], push[2], place = 0.0, -bearing.preload, 0.0 if rolling.contact_angle else bearings.measures(law).centre
    x, y, _, tilt_x, tilt_y = about["offset"]
    turn = -1.0 if mirrored else 1.0
    offset = (x, y, -place, turn * tilt_x, turn * tilt_y)
    return shafts.Support(
        bearing.name, bearing.position, law=law, mirrored=mirrored, offset=offset, seat=tuple(seat), push=tuple(push), width=bearing.width
    )


def _mounted(bearing, rolling):
    """How far the inner ring stands in when the preload presses it, all else held."""
    try:
        return bearings.solve(rolling, force=[0, 0, bearing.preload, 0, 0], held=("x", "y", "tilt_x", "tilt_y")).displacement[2]
    except InputError as error:
        raise SpecError(f"this bearing takes no axial force: {error}", f"bearings.{bearing.name}.preload") from None


# -- loads ---------------------------------------------------------------------------------------------------------------------


def _points(spec):
    places = {station.name: station.position for station in spec.stations}
    for load in spec.loads:
        place = places[load.station] if load.station else load.position
        bend = load.moment * across(load.moment_angle)
        yield shafts.ShaftLoad(place, (*(load.force * across(load.angle)), load.axial_force), (*bend, load.torque))
    for gear in spec.gears:
        yield tooth_force(gear)


def tooth_force(gear):
    """Load of a gear's teeth: F_t = 2 T/d along the pitch circle, F_r = |F_t| tan(a_n)/cos(b) inwards, F_a = F_t tan(b)."""
    out, radius = across(gear.mesh_angle), gear.pitch_diameter / 2
    along = np.array([-out[1], out[0]])
    tangential = gear.torque / radius
    force = tangential * along - abs(tangential) * np.tan(gear.pressure_angle) / np.cos(gear.helix_angle) * out
    axial = tangential * np.tan(gear.helix_angle)
    return shafts.ShaftLoad(gear.position, (*force, axial), (radius * axial * out[1], -radius * axial * out[0], gear.torque))


def _lines(spec):
    for load in spec.line_loads:
        way = across(load.angle)
        last = load.force if load.end_force is None else load.end_force
        yield shafts.LineLoad(load.start, load.end, tuple(load.force * way), tuple(last * way))
