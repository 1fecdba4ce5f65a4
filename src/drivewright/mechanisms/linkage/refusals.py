"""Invalid input of a linkage: unknown names, numbers that contradict each other.  Each is a SpecError with its key."""

from drivewright.errors import SpecError, nearest
from drivewright.mechanisms.linkage.tables import (
    CENTROID,
    GROUND,
    LinkageTables,
    central_inertia,
    ends_on,
    pivot_distance,
    place,
    points_of,
)
from drivewright.spec import dimension_at

NO_PERIOD = "requires a drive at constant speed, which defines the duration of a turn"


def refuse_nonsense(spec: LinkageTables) -> None:
    """Raise SpecError for the first thing in the tables of a linkage that has no meaning."""
    for rule in (_bodies, _names, _places, _joints, _zero_links, _massless_chains, _loads, _drives, _run, _studies):
        rule(spec)


def _known(name, known, what, key):
    if name not in known:
        raise SpecError(f"no {what} is called {name!r}{nearest(name, known)}; there are: {', '.join(map(str, known)) or 'none'}", key=key)


# -- bodies --------------------------------------------------------------------------------------------------------------------


def _bodies(spec):
    if GROUND in spec.bodies:
        raise SpecError("this name is reserved for the fixed frame; put its points into [ground.points]", key="bodies.ground")
    for name, body in spec.bodies.items():
        key = f"bodies.{name}"
        if CENTROID in body.points:
            raise SpecError("every body already has this point, at its `centroid`; choose another name", key=f"{key}.points.centroid")
        _known(body.inertia_about, [CENTROID, *body.points], f"point of {name!r}", f"{key}.inertia_about")
        share = body.mass * pivot_distance(body) ** 2
        if body.inertia < share * (1 - 1e-12):
            raise SpecError(
                f"{body.inertia:.6g} kg·m² about {body.inertia_about!r} is less than the parallel-axis share of the mass alone: m d^2 = "
                f"{body.mass:.6g} kg x ({pivot_distance(body) * 1e3:.6g} mm)^2 = {share:.6g} kg·m². If the inertia is about the "
                "centroid, leave inertia_about out",
                key=f"{key}.inertia",
            )


def _names(spec):
    for kind in ("joints", "springs", "rotational_springs", "torques", "forces", "outputs"):
        taken = set()
        for number, item in enumerate(getattr(spec, kind)):
            if item.name is not None and item.name in taken:
                raise SpecError(f"two {kind} are called {item.name!r}; give each a different name", key=f"{kind}.{number}.name")
            taken.add(item.name)


def _items(spec, kind):
    """(key, item) of a list of tables, by name where an item has one."""
    return [(f"{kind}.{item.name or number}", item) for number, item in enumerate(getattr(spec, kind))]


def _places(spec):
    """Every body and every point that is named must be there."""
    for key, joint in _items(spec, "joints"):
        _two_ends(spec, joint, key, [_wants_point(joint, 0), _wants_point(joint, 1)])
        if joint.kind in ("gear", "cam"):
            _refuse_place(spec, joint.carrier, f"{key}.carrier", None)
    for key, spring in _items(spec, "springs"):
        _two_ends(spec, spring, key, [True, True])
    for key, item in _items(spec, "rotational_springs") + _items(spec, "torques"):
        _known(item.body, spec.bodies, "body", f"{key}.body")
        _known(item.on, [GROUND, *spec.bodies], "body", f"{key}.on")
        if item.body == item.on:
            raise SpecError(f"body and reaction body are both {item.body!r}; name two different bodies", key=f"{key}.on")
    for key, item in _items(spec, "forces") + _items(spec, "outputs"):
        _known(item.body, spec.bodies, "body", f"{key}.body")
        if item.point is not None:
            _known(item.point, points_of(spec, item.body), f"point of {item.body!r}", f"{key}.point")


def _two_ends(spec, item, key, wants):
    for end, text in enumerate(item.connects):
        _refuse_place(spec, text, f"{key}.connects.{end}", wants[end])
    first, second = (place(text)[0] for text in item.connects)
    if first == second:
        raise SpecError(f"connects {first!r} with itself; name two different bodies", key=f"{key}.connects")


def _wants_point(joint, end):
    return not (joint.kind == "gear" or (joint.kind == "cam" and end == 0))


def _refuse_place(spec, text, key, wants_point):
    """`wants_point`: True, False, or None where a point may be named or not."""
    body, point = place(text)
    _known(body, [GROUND, *spec.bodies], "body", key)
    if point is not None:
        _known(point, points_of(spec, body), f"point of {body!r}", key)
    if wants_point and point is None:
        example = next(iter(points_of(spec, body)), "A")
        raise SpecError(f'names the body {body!r} but no point of it; write e.g. "{body}.{example}"', key=key)
    if wants_point is False and point is not None:
        raise SpecError(f"must be a body without a point, got {text!r}; write {body!r}", key=key)


# -- joints --------------------------------------------------------------------------------------------------------------------


def _joints(spec):
    for joint in spec.joints:
        for rule in (_axis, _model, _missing, _play):
            rule(joint, f"joints.{joint.name}")


def _axis(joint, key):
    if joint.axis == (0.0, 0.0):
        raise SpecError("[0, 0] has no direction; write e.g. [1, 0]", key=f"{key}.axis")
    if joint.axis != (1.0, 0.0) and joint.kind in ("revolute", "gear"):
        raise SpecError(
            f'a {joint.kind} joint has no axis in the plane; leave it out, or use kind = "prismatic" or "pin-slot"', key=f"{key}.axis"
        )


def _model(joint, key):
    if joint.kind != "revolute" and joint.model != "ideal":
        raise SpecError(
            f'a {joint.kind} joint cannot have model {joint.model!r}; clearance models apply to kind = "revolute"', key=f"{key}.model"
        )


MISSING = {
    "massless-link": ("clearance",),
    "dry": ("clearance",),
    "lubricated": ("clearance",),
    "bushing": ("stiffness",),
    "rolling": ("radius",),
    "gear": ("ratio",),
    "cam": ("lift",),
}


def _missing(joint, key):
    for choice in (joint.kind, joint.model):
        for name in MISSING.get(choice, ()):
            if getattr(joint, name) is None:
                meaning = type(joint).model_fields[name].description
                raise SpecError(f"is missing: {choice!r} requires it ({meaning})", key=f"{key}.{name}")
    if joint.ratio == 0:
        raise SpecError("must not be 0; give the teeth of the first gear over those of the second", key=f"{key}.ratio")


def _play(joint, key):
    if not joint.has_contact:
        return
    if joint.clearance >= joint.bearing_radius:
        raise SpecError(
            f"{joint.clearance * 1e3:.6g} mm must be less than the bearing radius, {joint.bearing_radius * 1e3:.6g} mm: the clearance is "
            "the bearing radius minus the journal radius",
            key=f"{key}.clearance",
        )
    if joint.normal == "kelvin-voigt" and joint.stiffness is None:
        raise SpecError('is missing: normal = "kelvin-voigt" requires a linear contact stiffness, e.g. "5e7 N/m"', key=f"{key}.stiffness")
    if joint.friction_law == "ambrosio" and joint.friction_dead_speed >= joint.friction_speed:
        raise SpecError(
            f"{joint.friction_dead_speed:.4g} m/s, the start of the friction ramp, must be less than its end, friction_speed = "
            f"{joint.friction_speed:.4g} m/s",
            key=f"{key}.friction_dead_speed",
        )


def _zero_links(spec):
    for name in spec.bodies:
        ends = ends_on(spec, name)
        places = {points_of(spec, name)[point] for joint, point in ends if point}
        if len(ends) > 1 and len(places) == 1 and all(joint.kind == "revolute" for joint, _ in ends):
            pins = " and ".join(repr(joint.name) for joint, _ in ends)
            raise SpecError(
                f"joints {pins} are at the same point, so this link has zero length; move a point, or join the other bodies directly",
                key=f"bodies.{name}.points",
            )


def _massless_chains(spec):
    """Two rigid links without mass at a body without mass have no equation of motion wherever they are in line."""
    for name, body in spec.bodies.items():
        links = [joint.name for joint, _ in ends_on(spec, name) if joint.pin == "massless-link"]
        if len(links) > 1 and body.mass == 0 and central_inertia(body) <= 0:
            raise SpecError(
                f"{name!r} has neither mass nor inertia but massless links at {' and '.join(map(repr, links))}: two clearances in series. "
                "Where the links are collinear, the equations of motion are singular. Give the body a mass, or make one joint ideal",
                key=f"bodies.{name}.mass",
            )


# -- loads and drive -----------------------------------------------------------------------------------------------------------


def _loads(spec):
    for key, item in _items(spec, "torques"):
        if (item.torque is None) == (item.file is None):
            raise SpecError("give torque or file, exactly one of them", key=f"{key}.torque")


def _drives(spec):
    taken = {}
    for key, drive in spec.all_drives.items():
        _drive(spec, key, drive)
        if drive.joint in taken:
            raise SpecError(f"{taken[drive.joint]} already drives joint {drive.joint!r}; a joint can have one drive", key=f"{key}.joint")
        taken[drive.joint] = f"[{key}]" if key == "drive" else key


DRIVEN = {"revolute": ("speed", "profile", "motor"), "prismatic": ("profile", "motor"), "pin-slot": ("profile",)}  # by which ways


def _drive(spec, key, drive):
    names = {joint.name: joint for joint in spec.joints}
    _known(drive.joint, names, "joint", f"{key}.joint")
    joint, ways = names[drive.joint], [way for way in ("speed", "profile", "motor") if getattr(drive, way) is not None]
    if joint.kind not in DRIVEN:
        raise SpecError(
            f"{joint.name!r} is a {joint.kind} joint; a drive needs a revolute, prismatic or pin-slot joint", key=f"{key}.joint"
        )
    if len(ways) != 1:
        raise SpecError(f"give exactly one of speed, profile and motor, got {' and '.join(ways) or 'none'}", key=f"{key}.speed")
    if ways[0] not in DRIVEN[joint.kind]:
        raise SpecError(f"{joint.name!r} is a {joint.kind} joint: give a profile of its travel over time", key=f"{key}.{ways[0]}")
    if drive.speed == 0:
        raise SpecError("must not be 0; leave the drive out, or hold the body by a profile", key=f"{key}.speed")
    for name, way in (("phase", "speed"), ("delay", "profile")):
        if getattr(drive, name) and ways != [way]:
            raise SpecError(
                f"applies to a drive with a {way}, but that of {joint.name!r} has a {ways[0]}; leave it out", key=f"{key}.{name}"
            )


# -- the run and the studies ---------------------------------------------------------------------------------------------------


def _run(spec):
    run = spec.simulate
    if run is None:
        return
    if run.turns is None and run.duration is None:
        raise SpecError('is missing: give turns, or duration = "0.5 s"', key="simulate.turns")
    for name in ("turns", "discard"):
        if getattr(run, name) and spec.period is None:
            remedy = "give duration instead" if name == "turns" else "leave it out"
            raise SpecError(f"{NO_PERIOD}; {remedy}", key=f"simulate.{name}")
    if run.discard and spec.start_of_window >= spec.duration * (1 - 1e-12):
        raise SpecError(
            f"{run.discard:g} turns must be fewer than those of the run, {spec.duration / spec.period:g}; none would be left to evaluate",
            key="simulate.discard",
        )


def _studies(spec):
    outputs = [output.name for output in spec.outputs]
    for name in ("poincare", "bifurcation", "table"):
        if (study := getattr(spec, name)) is not None:
            _known(study.output, outputs, "output", f"{name}.output")
    for name in ("poincare", "lyapunov", "bifurcation", "table", "wear"):
        if getattr(spec, name) is not None and spec.period is None:
            raise SpecError(NO_PERIOD, key=name)
    if spec.wear is not None:
        _known(spec.wear.joint, [joint.name for joint in spec.joints], "joint", "wear.joint")
    if spec.bifurcation is not None:
        _refuse_sweep(spec)
    for number, item in enumerate(spec.tolerances.dimensions if spec.tolerances else ()):
        _refuse_place(spec, item.at, f"tolerances.dimensions.{number}.at", True)
        if item.axis == (0.0, 0.0):
            raise SpecError("[0, 0] has no direction; write e.g. [1, 0]", key=f"tolerances.dimensions.{number}.axis")


def _refuse_sweep(spec):
    """The key of a bifurcation diagram is there and holds one number."""
    study, (exists, _) = spec.bifurcation, dimension_at(type(spec), spec.bifurcation.over)
    if not exists:
        raise SpecError(
            f'{study.over!r} is not a key of this spec; write e.g. "joints.NAME.clearance" or "drive.speed"', key="bifurcation.over"
        )
    table, _, name = study.over.partition(".")
    if table in ("joints", "bodies"):
        known = [joint.name for joint in spec.joints] if table == "joints" else list(spec.bodies)
        if not name.split(".")[0].isdigit():
            _known(name.split(".")[0], known, table[:-1].replace("bodie", "body"), "bifurcation.over")
    if study.discard >= study.turns:
        raise SpecError(
            f"{study.discard} turns must be fewer than those of a run, {study.turns}; none would be left to show", key="bifurcation.discard"
        )
