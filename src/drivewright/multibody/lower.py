"""Tree -> System: the description as arrays of records for the kernels."""

from typing import NamedTuple

import numpy as np

from drivewright.contact.impact import lasting_factor
from drivewright.errors import InputError, UnknownName
from drivewright.multibody import system as arrays
from drivewright.multibody.model import (
    GROUND,
    Bushing,
    CamPair,
    Dry,
    Force,
    Gear,
    Lubricated,
    Marker,
    PinSlot,
    Prismatic,
    Revolute,
    Rolling,
    RotationalSpring,
    Spring,
    Torque,
)
from drivewright.multibody.tree import far_end

_FRICTION = {"none": arrays.NO_FRICTION, "coulomb": arrays.COULOMB, "ambrosio": arrays.AMBROSIO, "lugre": arrays.LUGRE}
_FILM = {"long": arrays.LONG_FILM, "short": arrays.SHORT_FILM}
_OVER = {"time": arrays.TIME, "angle": arrays.ANGLE, "speed": arrays.SPEED}


class Places(NamedTuple):
    """Numbers of the bodies in the arrays, their start guesses, centroids, and the list that collects the curves."""

    numbers: dict
    angles: dict
    centroids: dict
    curves: list

    def number(self, name, whose):
        if name not in self.numbers:
            raise UnknownName(f"body of {whose}", name, self.numbers)
        return self.numbers[name]

    def arm(self, marker):
        """A marker seen from the centroid."""
        cx, cy = self.centroids[marker.body]
        return marker.x - cx, marker.y - cy

    def curve(self, curve):
        self.curves.append(curve)
        return len(self.curves) - 1


def lower(model, tree):
    """`System` of an expanded model; the split into dependent and independent coordinates is not made yet."""
    numbers = {GROUND: 0} | {link.body.name: k for k, link in enumerate(tree.links, start=1)}
    places = Places(
        numbers,
        {GROUND: 0.0} | {b.name: b.angle for b in model.bodies},
        {GROUND: (0.0, 0.0)} | {b.name: b.centroid for b in model.bodies},
        [],
    )
    bodies = [_record(arrays.BODY, parent=0, turn=-1, slide=-1, free=-1), *(_body(link, places) for link in tree.links)]
    names = [joint.name for joint in model.joints]
    rows = [row | {"joint": names.index(joint.name)} for joint in tree.closing for row in rows_of(joint, places)]
    driven = [_driven(drive, model, tree, places) for drive in model.drives]
    kinds = {kind: [f for f in model.forces if isinstance(f, kind)] for kind in (Spring, RotationalSpring, Torque, Force)}
    pins = [joint for joint in model.joints if isinstance(joint, Revolute)]
    records = {
        "springs": table(arrays.SPRING, (_spring(f, places) for f in kinds[Spring])),
        "twists": table(arrays.TWIST, (_twist(f, places) for f in kinds[RotationalSpring])),
        "torques": table(arrays.TORQUE, (_torque(f, places) for f in kinds[Torque])),
        "forces": table(arrays.FORCE, (_force(f, places) for f in kinds[Force])),
        "bushings": table(arrays.BUSHING, (_bushing(j, places) for j in pins if isinstance(j.model, Bushing))),
        "contacts": table(arrays.CONTACT, (_contact(j, places) for j in pins if isinstance(j.model, (Dry, Lubricated)))),
    }
    given = [d["coordinate"] for d in driven]
    if twice := [drive.joint for k, drive in enumerate(model.drives) if given[k] in given[:k]]:
        raise InputError(f"joint {twice[0]!r} is driven twice, or with another joint about the same axis; keep one drive")
    stored = np.array([k for k in range(tree.size) if k not in given], dtype=np.int64)
    for number, body in enumerate(bodies[1:], start=1):  # parents come first
        own = [k for k in (body["turn"], body["slide"], body["free"]) if k >= 0]
        bodies[number]["driven"] = bool(bodies[int(body["parent"])]["driven"] or not body["parent"]) and all(k in given for k in own)
    curves, pieces = _curves(places.curves)
    bodies, rows = np.array(bodies).view(np.recarray), table(arrays.ROW, rows)
    length = arrays.length_of(bodies, rows, *(each for each in records.values() if "ax" in each.dtype.names))
    rows["extent"] = np.where(_measures_angles(rows), 1.0, length)
    return arrays.System(
        bodies=bodies,
        rows=rows,
        driven=table(arrays.DRIVEN, driven),
        stored=stored,
        independent=stored,
        dependent=np.zeros(0, np.int64),
        **records,
        wear=np.zeros((len(records["contacts"]), 0)),
        curves=curves,
        pieces=pieces,
        gravity_x=float(model.gravity[0]),
        gravity_y=float(model.gravity[1]),
        length=length,
        sizes=_sizes(tree, length),
        reference_determinant=0.0,
        chart=arrays.no_chart(),
    )


def _measures_angles(rows):
    """Which rows have an angle for a residual; the others have a length."""
    return (rows.kind == arrays.LINEAR) & (rows.ex == 0.0) & (rows.ey == 0.0)


def _sizes(tree, length):
    """(coordinates,): 1 of the rotations, the mechanism's length of the displacements."""
    sizes = np.full(tree.size, length)
    sizes[[link.turn for link in tree.links if link.turn >= 0]] = 1.0
    return sizes


def _record(kind, /, **values):
    record = np.zeros((), kind)
    for name, value in values.items():
        record[name] = value
    return record


def table(kind, rows):
    """Records of a kind, from dictionaries of their fields."""
    return np.array([_record(kind, **row) for row in rows], dtype=kind).view(np.recarray)


def _curves(curves):
    """Records of the curves and of their pieces."""
    records, pieces = [], []
    for curve in curves:
        records.append({"first": len(pieces), "count": len(curve.coefficients), "period": curve.period})
        for start, row in zip(curve.breaks, curve.coefficients, strict=False):
            pieces.append({"start": start, **{f"c{k}": c for k, c in enumerate(row)}})
    return table(arrays.CURVE, records), table(arrays.PIECE, pieces)


def _unit(axis, joint):
    length = np.hypot(*axis)
    if not length > 0:
        raise InputError(f"joint {joint.name!r}: its axis {axis} has no direction; give e.g. [1, 0]")
    return axis[0] / length, axis[1] / length


def _body(link, places):
    body, joint = link.body, link.joint
    known = {
        "parent": places.numbers[link.parent],
        "turn": link.turn,
        "slide": link.slide,
        "free": link.free,
        "inherits": float(link.inherits),
        "mass": body.mass,
        "inertia": body.inertia,
    }
    if joint is None:
        return _record(arrays.BODY, **known)
    mine, theirs = (joint.first, joint.second) if joint.first.body == body.name else (joint.second, joint.first)
    (known["ax"], known["ay"]), (known["bx"], known["by"]) = places.arm(theirs), places.arm(mine)
    if link.slide >= 0:
        names = ("ex", "ey") if mine is joint.first else ("fx", "fy")
        known |= dict(zip(names, _unit(joint.axis, joint), strict=True))
    if isinstance(joint, Prismatic):
        known["offset"] = body.angle - places.angles[link.parent]
    return _record(arrays.BODY, **known)


def rows_of(joint, places):
    """Constraint rows of a joint as dictionaries; `assembled` marks rows whose constant is read off the assembled mechanism."""
    if isinstance(joint, Gear):
        i, j, k = (places.number(name, f"gear {joint.name!r}") for name in (joint.second, joint.first, joint.carrier))
        return [{"i": i, "j": j, "k": k, "lift": -1, "gi": 1.0, "gj": -joint.ratio, "gk": joint.ratio - 1.0, "constant": np.nan}]
    if isinstance(joint, CamPair):
        return [_cam_row(joint, places)]
    i, j = (places.number(marker.body, f"joint {joint.name!r}") for marker in (joint.first, joint.second))
    (ax, ay), (bx, by) = places.arm(joint.first), places.arm(joint.second)
    pair = {"i": i, "j": j, "ax": ax, "ay": ay, "bx": bx, "by": by, "lift": -1}
    if isinstance(joint, Revolute):
        return [pair | {"ex": 1.0}, pair | {"ey": 1.0}]
    if isinstance(joint, Rolling) and joint.track_radius:
        reach = joint.radius + joint.track_radius
        return [
            pair | {"kind": arrays.DISTANCE, "constant": abs(reach)},
            pair | {"kind": arrays.CIRCLE, "gi": joint.radius, "gj": joint.track_radius, "constant": np.nan},
        ]
    x, y = _unit(joint.axis, joint)
    across = pair | {"k": j, "ex": -y, "ey": x}
    if isinstance(joint, Rolling):
        return [
            across | {"constant": joint.radius},
            pair | {"k": j, "ex": x, "ey": y, "gi": joint.radius, "gj": -joint.radius, "constant": np.nan},
        ]
    if isinstance(joint, PinSlot):
        return [across]
    locked = places.angles[joint.first.body] - places.angles[joint.second.body]
    return [across, {"i": i, "j": j, "lift": -1, "gi": 1.0, "gj": -1.0, "constant": locked}]


def _cam_row(joint, places):
    whose = f"cam pair {joint.name!r}"
    i, k, l = places.number(joint.follower.body, whose), places.number(joint.carrier, whose), places.number(joint.cam, whose)
    row = {"i": i, "j": k, "k": k, "l": l, "lift": places.curve(joint.lift)}
    if joint.axis is None:
        return row | {"gi": 1.0, "gk": -1.0, "constant": places.angles[joint.follower.body] - places.angles[joint.carrier]}
    (ax, ay), (bx, by), (ex, ey) = places.arm(joint.follower), places.arm(Marker(joint.carrier, *joint.origin)), _unit(joint.axis, joint)
    return row | {"ax": ax, "ay": ay, "bx": bx, "by": by, "ex": ex, "ey": ey}


def _driven(drive, model, tree, places):
    """The coordinate of a driven joint: rotation or slide of the joint's first body relative to its second, of the other one relative to
    the ground."""
    joint = next((j for j in model.joints if j.name == drive.joint), None)
    if joint is None:
        raise UnknownName("driven joint", drive.joint, [j.name for j in model.joints])
    if not isinstance(joint, (Revolute, Prismatic)):
        raise InputError(f"joint {joint.name!r} cannot be driven; drive a revolute or a prismatic joint")
    far = far_end(model, joint)
    first, second = joint.first.body, (far or joint).second.body
    mover, base = (second, first) if first == GROUND else (first, second)
    link = None if far else next((one for one in tree.links if one.joint is not None and one.joint.name == joint.name), None)
    if link is None:
        link = _turning_alone(joint, mover, base, tree)
    if isinstance(joint, Prismatic):
        return {"coordinate": link.slide, "sign": -1.0 if first == GROUND else 1.0, "start": 0.0, "curve": places.curve(drive.motion)}
    start = places.angles[mover] - places.angles[base]
    sign = 1.0 if link.body.name == mover else -1.0
    return {"coordinate": link.turn, "sign": sign, "start": start, "curve": places.curve(drive.motion)}


def _turning_alone(joint, mover, base, tree):
    """A joint with play does not carry its body; its rotation can be driven where it is measured against the world."""
    link = tree.link(mover)
    if base != GROUND or link.turn < 0 or link.inherits:
        raise InputError(
            f"joint {joint.name!r} has play and joins two moving bodies: its rotation cannot be driven; make it ideal, "
            "or drive the joint at the ground"
        )
    return link


def _pair(first, second, places, whose):
    i, j = places.number(first.body, whose), places.number(second.body, whose)
    (ax, ay), (bx, by) = places.arm(first), places.arm(second)
    return {"i": i, "j": j, "ax": ax, "ay": ay, "bx": bx, "by": by}


def _spring(spring, places):
    return _pair(spring.first, spring.second, places, f"spring {spring.name!r}") | {
        "stiffness": spring.stiffness,
        "free_length": spring.free_length,
        "damping": spring.damping,
    }


def _twist(spring, places):
    whose = f"rotational spring {spring.name!r}"
    return {
        "i": places.number(spring.first, whose),
        "j": places.number(spring.second, whose),
        "stiffness": spring.stiffness,
        "rest": spring.rest,
        "damping": spring.damping,
    }


def _torque(torque, places):
    whose = f"torque {torque.name!r}"
    return {
        "i": places.number(torque.body, whose),
        "j": places.number(torque.on, whose),
        "over": _OVER[torque.load.over],
        "curve": places.curve(torque.load.curve),
    }


def _force(force, places):
    i = places.number(force.point.body, f"force {force.name!r}")
    (ax, ay), (ex, ey) = places.arm(force.point), force.direction
    return {
        "i": i,
        "over": _OVER[force.load.over],
        "curve": places.curve(force.load.curve),
        "follows": force.follows,
        "k": i if force.follows else 0,
        "ax": ax,
        "ay": ay,
        "ex": ex,
        "ey": ey,
    }


def _bushing(joint, places):
    model = joint.model
    rest = places.angles[joint.first.body] - places.angles[joint.second.body]
    return _pair(joint.first, joint.second, places, f"joint {joint.name!r}") | {
        "stiffness": model.stiffness,
        "damping": model.damping,
        "rotational_stiffness": model.rotational_stiffness,
        "rotational_damping": model.rotational_damping,
        "rest": rest,
    }


def _contact(joint, places):
    oil = joint.model if isinstance(joint.model, Lubricated) else None
    dry = oil.contact if oil else joint.model
    rub = dry.friction
    film = {"film": _FILM[oil.film], "viscosity": oil.viscosity, "roughness": oil.roughness} if oil else {}
    return (
        _pair(joint.first, joint.second, places, f"joint {joint.name!r}")
        | film
        | {
            "memory": -1,
            "bristle": -1,
            "cylinder": dry.cylinder,
            "clearance": dry.clearance,
            "bearing_radius": dry.bearing_radius,
            "stiffness": dry.stiffness,
            "exponent": dry.exponent,
            "hysteresis": dry.hysteresis,
            "lasting": lasting_factor(dry.hysteresis),
            "damping": dry.damping,
            "length": dry.length,
            "law": _FRICTION[rub.law] if rub.coefficient > 0 else arrays.NO_FRICTION,
            "friction": rub.coefficient,
            "slip_speed": rub.speed,
            "dead_speed": rub.dead_speed,
            "static_friction": rub.static_coefficient,
            "bristle_stiffness": rub.bristle_stiffness,
            "bristle_damping": rub.bristle_damping,
            "viscous": rub.viscous,
        }
    )
