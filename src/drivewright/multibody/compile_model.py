"""Tree -> System: the description as arrays of records for the kernels."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from drivewright._typing import Bools, Floats
from drivewright.contact.film_table import FilmTable
from drivewright.errors import InputError, UnknownName
from drivewright.multibody.bodies import GROUND
from drivewright.multibody.curves import Curve
from drivewright.multibody.forces.actuator import ACTUATOR
from drivewright.multibody.forces.bushing import BUSHING
from drivewright.multibody.forces.contact import CONTACT, Laws, NoLaws
from drivewright.multibody.forces.joint_friction import JOINT_FRICTION, JointFrictions, NoJointFriction
from drivewright.multibody.forces.load import FORCE, TORQUE
from drivewright.multibody.forces.rotational_spring import ROTATIONAL_SPRING
from drivewright.multibody.forces.spring import SPRING
from drivewright.multibody.index import ModelIndex, unit_axis
from drivewright.multibody.joints.joint import Joint, RowFields
from drivewright.multibody.joints.rows import FURTHER, LINEAR, Equations, NoEquations
from drivewright.multibody.model import JointDrive, MultibodyModel
from drivewright.multibody.records import Records, table_of
from drivewright.multibody.system import BODY, CURVE, DRIVEN, PIECE, ROW, System, length_of, no_chart
from drivewright.multibody.tree import Link, Tree, far_end

FORCE_TABLES = {
    "springs": SPRING,
    "rotational_springs": ROTATIONAL_SPRING,
    "torques": TORQUE,
    "forces": FORCE,
    "actuators": ACTUATOR,
    "bushings": BUSHING,
    "contacts": CONTACT,
}  # field of the system -> type of its records


def index_of(model: MultibodyModel, tree: Tree) -> ModelIndex:
    """The `ModelIndex` of an expanded model, without curves yet."""
    return ModelIndex(
        {GROUND: 0} | {link.body.name: k for k, link in enumerate(tree.links, start=1)},
        {GROUND: 0.0} | {body.name: body.angle for body in model.bodies},
        {GROUND: (0.0, 0.0)} | {body.name: body.centroid for body in model.bodies},
        [],
        [],
        [],
    )


def compile_model(model: MultibodyModel, tree: Tree) -> System:
    """`System` of an expanded model; the split into dependent and independent coordinates is not made yet."""
    index = index_of(model, tree)
    bodies = [{"parent": 0, "turn": -1, "slide": -1, "free": -1, "driven": False}, *(_body(link, index) for link in tree.links)]
    names = [joint.name for joint in model.joints]
    rows = [{**row, "joint": names.index(joint.name)} for joint in tree.closing for row in joint.constraint_rows(index)]
    driven = [_driven(drive, model, tree, index) for drive in model.drives]
    elements = [*model.forces, *(joint.force_element for joint in model.joints if joint.force_element)]
    records = {
        name: table_of(kind, (element.record(index) for element in elements if element.table == name))
        for name, kind in FORCE_TABLES.items()
    }
    given = [int(d["coordinate"]) for d in driven]
    if twice := [drive.joint for k, drive in enumerate(model.drives) if given[k] in given[:k]]:
        raise InputError(f"joint {twice[0]!r} is driven twice, or together with a joint about the same axis; keep one drive")
    stored = np.array([k for k in range(tree.size) if k not in given], dtype=np.int64)
    for body in bodies[1:]:  # parents come first
        own = [k for k in (body["turn"], body["slide"], body["free"]) if k >= 0]
        body["driven"] = (bodies[body["parent"]]["driven"] or not body["parent"]) and all(k in given for k in own)
    frictions = _frictions(model, tree, index)
    curves, pieces = _curves(index.curves)
    table, (row_table, equations) = table_of(BODY, bodies), rows_and_equations(rows)
    length = length_of(table, row_table, *(each for each in records.values() if "ax" in (each.dtype.names or ())))
    row_table["extent"] = np.where(_measures_angles(row_table), 1.0, length)
    return System(
        bodies=table,
        rows=row_table,
        driven=table_of(DRIVEN, driven),
        stored=stored,
        independent=stored,
        dependent=np.zeros(0, np.int64),
        **records,
        laws=_laws(index.laws),
        frictions=frictions,
        films=_films(index.films),
        wear=np.zeros((len(records["contacts"]), 0)),
        curves=curves,
        pieces=pieces,
        equations=equations,
        gravity_x=float(model.gravity[0]),
        gravity_y=float(model.gravity[1]),
        length=length,
        sizes=_sizes(tree, length),
        reference_determinant=0.0,
        chart=no_chart(),
    )


def rows_and_equations(rows: Sequence[RowFields]) -> tuple[Records, NoEquations | Equations]:
    """Records of constraint rows, and the equations of those whose kind is none of the package; every class of equations gets a number."""
    codes: dict[type, int] = {}
    equations: NoEquations | Equations = NoEquations()
    numbered = []
    for row in rows:
        equation = row.get("kind", LINEAR)
        if not isinstance(equation, int) and type(equation) not in codes:
            codes[type(equation)] = FURTHER + len(codes)
            equations = Equations(codes[type(equation)], equation, equations)
        numbered.append({"lift": -1, **row, "kind": codes.get(type(equation), equation)})
    return table_of(ROW, numbered), equations


def _laws(laws: Sequence[Any]) -> NoLaws | Laws:
    """The laws of the contacts that have one of their own, numbered from 1."""
    chain: NoLaws | Laws = NoLaws()
    for code, law in enumerate(laws, start=1):
        chain = Laws(code, law, chain)
    return chain


def _frictions(model: MultibodyModel, tree: Tree, index: ModelIndex) -> NoJointFriction | JointFrictions:
    """Records of the ideal joints that rub: what a joint of the tree transmits is what its body needs, of others what their rows do."""
    carried = {link.joint.name: index.numbers[link.body.name] for link in tree.links if link.joint}
    rows = [
        {**joint.friction_force.record(index), "child": carried.get(joint.name, -1), "joint": number}
        for number, joint in enumerate(model.joints)
        if joint.friction_force
    ]
    return JointFrictions(table_of(JOINT_FRICTION, rows)) if rows else NoJointFriction()


def _films(tables: Sequence[FilmTable]) -> Floats:
    """Coefficients of the tables of oil films, one after another."""
    return np.stack([table.coefficients for table in tables]) if tables else np.zeros((0, 2, 0, 0, 4, 4))


def _measures_angles(rows: Records) -> Bools:
    """Which rows have an angle for a residual; the others have a length."""
    return (rows.kind == LINEAR) & (rows.ex == 0.0) & (rows.ey == 0.0)


def _sizes(tree: Tree, length: float) -> Floats:
    """(coordinates,): 1 of the rotations, the mechanism's length of the displacements."""
    sizes = np.full(tree.size, length)
    sizes[[link.turn for link in tree.links if link.turn >= 0]] = 1.0
    return sizes


def _curves(curves: Sequence[Curve]) -> tuple[Records, Records]:
    """Records of the curves and of their pieces."""
    records, pieces = [], []
    for curve in curves:
        records.append({"first": len(pieces), "count": len(curve.coefficients), "period": curve.period})
        for start, row in zip(curve.breaks, curve.coefficients, strict=False):
            pieces.append({"start": start, **{f"c{k}": c for k, c in enumerate(row)}})
    return table_of(CURVE, records), table_of(PIECE, pieces)


def _body(link: Link, index: ModelIndex) -> dict[str, Any]:
    body, joint = link.body, link.joint
    known: dict[str, Any] = {
        "parent": index.numbers[link.parent],
        "turn": link.turn,
        "slide": link.slide,
        "free": link.free,
        "inherits": float(link.inherits),
        "mass": body.mass,
        "inertia": body.inertia,
    }
    if joint is None:
        return known
    mine, theirs = (joint.first, joint.second) if joint.first.body == body.name else (joint.second, joint.first)
    (known["ax"], known["ay"]), (known["bx"], known["by"]) = index.arm(theirs), index.arm(mine)
    if link.slide >= 0:
        names = ("ex", "ey") if mine is joint.first else ("fx", "fy")
        known |= dict(zip(names, unit_axis(joint.slide_axis, joint.name), strict=True))
    if link.turn < 0:  # the rotation is that of the parent, but for what the start angles differ by
        known["offset"] = body.angle - index.angles[link.parent]
    return known


def _driven(drive: JointDrive, model: MultibodyModel, tree: Tree, index: ModelIndex) -> dict[str, float]:
    """The coordinate of a driven joint: rotation or slide of the joint's first body relative to its second, of the other one relative to
    the ground."""
    joint = next((j for j in model.joints if j.name == drive.joint), None)
    if joint is None:
        raise UnknownName("driven joint", drive.joint, [j.name for j in model.joints])
    if joint.driven_motion is None:
        raise InputError(f"joint {joint.name!r} cannot be driven; drive a revolute, prismatic or pin-slot joint")
    far = far_end(model, joint)
    first, second = joint.bodies[0], (far or joint).bodies[1]
    mover, base = (second, first) if first == GROUND else (first, second)
    link = None if far else next((one for one in tree.links if one.joint is not None and one.joint.name == joint.name), None)
    if link is None:
        link = _turning_alone(joint, mover, base, tree)
    if joint.driven_motion == "displacement":
        return {"coordinate": link.slide, "sign": -1.0 if first == GROUND else 1.0, "start": 0.0, "curve": index.add_curve(drive.motion)}
    start = index.angles[mover] - index.angles[base]
    sign = 1.0 if link.body.name == mover else -1.0
    return {"coordinate": link.turn, "sign": sign, "start": start, "curve": index.add_curve(drive.motion)}


def _turning_alone(joint: Joint, mover: str, base: str, tree: Tree) -> Link:
    """A joint with play does not carry its body; its rotation can be driven where it is measured against the world."""
    link = tree.link(mover)
    if base != GROUND or link.turn < 0 or link.inherits:
        raise InputError(
            f"joint {joint.name!r} has clearance and connects two moving bodies, so its rotation cannot be driven; make it ideal, "
            "or drive the joint at the ground"
        )
    return link
