"""Invalid input of a shaft, refused with its key; what can be computed is left to the checks."""

from drivewright.bearings.load_spectrum import WHOLE
from drivewright.bearings.lubricant import refuse_said_twice
from drivewright.errors import SpecError, nearest
from drivewright.mechanisms.shaft.bearing_table import Bearing
from drivewright.mechanisms.shaft.strength_tables import WANTED
from drivewright.mechanisms.shaft.tables import DutyCase, ShaftTables

NEAR = 1e-9  # of the shaft's length: the same place
TAKEN = {"bearings": ("bending", "shear", "tension", "total", "entry"), "stations": ("z",)}  # columns of our own
SPRINGS = ("radial_stiffness", "stiffness_xx", "table", "bearing", "geometry", "roller_geometry", "envelope")
PLANES = ("stiffness_xx", "stiffness_yy")
CROSS = ("stiffness_xy", "stiffness_yx")
ROLLING = ("bearing", "geometry", "roller_geometry", "envelope")


def refuse_nonsense(spec: ShaftTables) -> None:
    """SpecError for the first thing that has no meaning."""
    for check in (_names, _places, _stations_of_loads, _analysis, _duty):
        check(spec)


def refuse_contradictions(spec: ShaftTables) -> None:
    """SpecError for the first two keys that contradict each other, or one that lacks another."""
    for check in (_segments, _bearings, _places_of_loads, _strength, _notches, _lubrication):
        check(spec)


def is_rolling(bearing: Bearing) -> bool:
    """Whether a bearing is a rolling bearing with an inner geometry."""
    return any(getattr(bearing, key) is not None for key in ROLLING)


def _segments(spec):
    for number, segment in enumerate(spec.segments):
        least = min(segment.diameter, segment.end_diameter or segment.diameter)
        if segment.bore >= least:
            raise SpecError(
                f"{_mm(segment.bore)} is not below the diameter of the shaft there ({_mm(least)}); take a smaller bore",
                f"segments.{number}.bore",
            )


def _names(spec):
    for table in ("bearings", "stations", "gears", "notches"):
        names = [entry.name for entry in getattr(spec, table)]
        for number, name in enumerate(names):
            if name in TAKEN.get(table, ()):
                raise SpecError(f"the name {name!r} is reserved for a column of a table; choose another", f"{table}.{number}.name")
            if name in names[:number]:
                raise SpecError(f"the name {name!r} occurs twice; names in {table} must differ", f"{table}.{number}.name")

    stations = [station.name for station in spec.stations]
    for number, gear in enumerate(spec.gears):
        if gear.name in stations and (gear.mass or gear.unbalance):
            raise SpecError(
                f"the name {gear.name!r} is that of a station, and both can have an unbalance; choose another", f"gears.{number}.name"
            )


def _places(spec):
    """Everything stands on the shaft; no two bearings and no two stations at one place."""
    far = spec.length
    tables = ("bearings", "stations", "gears", "notches")
    wanted = [(f"{table}.{entry.name}.position", entry.position) for table in tables for entry in getattr(spec, table)]
    wanted += [(f"loads.{number}.position", load.position) for number, load in enumerate(spec.loads) if load.position is not None]
    wanted += [
        (f"line_loads.{number}.{end}", getattr(load, end)) for number, load in enumerate(spec.line_loads) for end in ("start", "end")
    ]
    _widths(spec)
    for key, place in wanted:
        if not -NEAR * far <= place <= far * (1 + NEAR):
            raise SpecError(f"{_mm(place)} lies outside the shaft, which runs from 0 to {_mm(far)}; move it, or make a segment longer", key)
    for table in ("bearings", "stations"):
        entries = sorted(getattr(spec, table), key=lambda entry: entry.position)
        for one, two in zip(entries, entries[1:], strict=False):
            if two.position - one.position <= NEAR * far:
                raise SpecError(
                    f"is at {_mm(two.position)}, the position of {one.name!r}; {table} need different positions",
                    f"{table}.{two.name}.position",
                )


def _widths(spec):
    for bearing in spec.bearings:
        room = 2 * min(bearing.position, spec.length - bearing.position)
        if bearing.width and bearing.width > room + NEAR * spec.length:
            raise SpecError(
                f"its seat of {_mm(bearing.width)} about {_mm(bearing.position)} overhangs the end of the shaft; at most "
                f"{_mm(max(room, 0.0))} fit there",
                f"bearings.{bearing.name}.width",
            )


def _bearings(spec):
    for bearing in spec.bearings:
        given = [key for key in SPRINGS if getattr(bearing, key) is not None]
        where = f"bearings.{bearing.name}"
        if len(given) != 1 and not (not given and (bearing.axial_stiffness or bearing.tilt_stiffness)):
            problem = f"has {' and '.join(given)}" if given else "has no stiffness"
            raise SpecError(f"{problem}; give one of {', '.join(SPRINGS)}", where)
        _refuse_half_matrix(bearing, where)
        if is_rolling(bearing):
            for key in ("axial_stiffness", "tilt_stiffness"):
                if getattr(bearing, key) is not None:
                    raise SpecError(
                        f"a rolling bearing has its own stiffness; leave it out, or give radial_stiffness instead of {given[0]}",
                        f"{where}.{key}",
                    )
            continue
        for key in ("preload", "free"):
            if getattr(bearing, key):
                raise SpecError(f"belongs to a rolling bearing ({', '.join(ROLLING)})", f"{where}.{key}")
        if bearing.radial_clearance is not None and (bearing.radial_stiffness in (None, float("inf")) or bearing.radial_clearance < 0):
            raise SpecError(
                "a clearance above 0 needs a rolling bearing or a radial_stiffness that is not rigid", f"{where}.radial_clearance"
            )


def _refuse_half_matrix(bearing, where):
    """One of two planes without the other; cross-coupling beside what is no spring across the shaft."""
    lacking = [key for key in PLANES if getattr(bearing, key) is None]
    if len(lacking) == 1:
        raise SpecError(f"is missing beside {next(key for key in PLANES if key not in lacking)}; give both", f"{where}.{lacking[0]}")
    if bearing.radial_damping and bearing.damping_xx is not None and bearing.damping_yy is not None:
        raise SpecError("has no effect beside damping_xx and damping_yy; leave it out", f"{where}.radial_damping")
    springs = [getattr(bearing, key) for key in PLANES] if not lacking else [bearing.radial_stiffness]
    for key in CROSS:
        if getattr(bearing, key) and not all(spring and spring < float("inf") for spring in springs):
            raise SpecError("needs a radial_stiffness, or stiffness_xx and stiffness_yy, that is not rigid", f"{where}.{key}")


def _places_of_loads(spec):
    for number, load in enumerate(spec.loads):
        if (load.station is None) == (load.position is None):
            raise SpecError("give either station or position", f"loads.{number}")


def _stations_of_loads(spec):
    names = [station.name for station in spec.stations]
    for number, load in enumerate(spec.loads):
        if load.station is not None and load.station not in names:
            raise SpecError(
                f"there is no station {load.station!r}{nearest(load.station, names)}; known: {', '.join(names) or 'none'}",
                f"loads.{number}.station",
            )
    for number, load in enumerate(spec.line_loads):
        if not load.end > load.start:
            raise SpecError(f"ends at {_mm(load.end)}, not right of its start at {_mm(load.start)}", f"line_loads.{number}.end")


def _analysis(spec):
    given = spec.analysis.shear_coefficient
    if not isinstance(given, str) and not 0 < given <= 1:
        raise SpecError(f'must lie above 0 and at most 1, got {given:g}; or write "cowper"', "analysis.shear_coefficient")


def _strength(spec):
    """Fillets that do not go onto the shaft; a yield strength above the tensile one."""
    for number, (segment, after) in enumerate(zip(spec.segments, spec.segments[1:], strict=False)):
        smaller = min(segment.end_diameter or segment.diameter, after.diameter)
        if segment.fillet_radius and segment.fillet_radius > smaller / 2:
            raise SpecError(
                f"{_mm(segment.fillet_radius)} is more than the radius of the shaft there ({_mm(smaller / 2)}); check the unit",
                f"segments.{number}.fillet_radius",
            )
    tensile, limit = spec.material.tensile_strength, spec.material.yield_strength
    if tensile and limit and limit > tensile:
        raise SpecError(f"{limit / 1e6:.6g} MPa is more than the tensile strength of {tensile / 1e6:.6g} MPa", "material.yield_strength")


def _notches(spec):
    for notch in spec.notches:
        wanted, where = WANTED.get(notch.kind, ()), f"notches.{notch.name}"
        for key in ("depth", "width", "radius", "diameter"):
            if key in wanted and getattr(notch, key) is None:
                raise SpecError(f"is missing: a {notch.kind} needs {', '.join(wanted)}", f"{where}.{key}")
            if key not in wanted and getattr(notch, key) is not None:
                raise SpecError(f"does not belong to a {notch.kind}; leave it out", f"{where}.{key}")


def _lubrication(spec):
    try:
        refuse_said_twice(spec.lubrication)
    except SpecError as error:
        raise error.located(f"lubrication.{error.key}") from None


def _duty(spec):
    total = sum(case.share for case in spec.duty)
    if spec.duty and abs(total - 1) > WHOLE:
        raise SpecError(f"the shares of the time sum to {total:.6g}; they must sum to 1", "duty")
    if spec.drive is None and any(case.speed is None for case in spec.duty):
        number = next(n for n, case in enumerate(spec.duty) if case.speed is None)
        raise SpecError("is missing, and there is no [drive] speed to use instead", f"duty.{number}.speed")
    if spec.duty and not any(duty_speed(spec, case) for case in spec.duty):
        raise SpecError("all speeds are 0; give at least one case a speed", "duty")


def duty_speed(spec: ShaftTables, case: DutyCase) -> float:
    """Speed [rad/s] of the shaft in a case of its duty cycle."""
    return case.speed if case.speed is not None else spec.drive.speed if spec.drive else 0.0


def _mm(length):
    return f"{1e3 * length:.6g} mm"
