"""Cams, shafts and wheel as solids in contact: torsional stiffness over the index period, and what the lumped model neglects."""

from collections.abc import Iterator
from typing import Literal, NamedTuple

import numpy as np

from drivewright._typing import Bools, Floats
from drivewright.indexing import solid
from drivewright.indexing.contacts import CamContacts
from drivewright.indexing.plane import contacts_at
from drivewright.indexing.solid import SolidStiffness, tables
from drivewright.indexing.stiffness import TorsionalStiffness
from drivewright.indexing.stiffness.loading import REACH, solve_at_contacts
from drivewright.indexing.stiffness.tables import pin_force_table
from drivewright.mechanisms.indexer.build import IndexerModel
from drivewright.mechanisms.indexer.spec import IndexerSpec
from drivewright.mechanisms.indexer.stiffness import no_stiffness
from drivewright.result import Answer, Answers, Table, Value

POSITIONS = 9  # over the index period
MESH_ERROR = 0.02  # of the stiffness, from above: see theory.md
MODELS: tuple[Literal["unilateral", "bonded"], ...] = ("unilateral", "bonded")


class LoadedAssembly(NamedTuple):
    """Assembly and lumped model, each {"unilateral", "bonded"}, at the input angles (p,) [rad] with their contacts."""

    angles: Floats
    contacts: list[CamContacts]
    solids: dict[str, SolidStiffness]
    lumped: dict[str, TorsionalStiffness]


def no_assembly(spec: IndexerSpec) -> str | None:
    """Why there is none."""
    if spec.crank_bearings is None or spec.crank_bearings.bearing is None:
        return no_stiffness(spec) or "no body has a size: give crank_bearings.bearing, which sets the holes of the cams and the crank pins"
    return no_stiffness(spec)


def assembly(model: IndexerModel, done: Answers) -> Answer:
    """Stiffness, compliance by bodies, forces of the pins and pictures of the deformed bodies."""
    loaded = load(model)
    own, lumped = loaded.solids[model.spec.contact.model], loaded.lumped[model.spec.contact.model]
    forces = pin_force_table(
        loaded.angles, loaded.contacts, own.pin_forces, *model.pin_measures, "assembly_pins", "Forces on the pins, assembly of solids"
    )
    found = (tables.assembly_table(loaded.angles, loaded.solids, loaded.lumped), *tables.share_tables(loaded.angles, own, lumped), forces)
    pictures = tuple(_pictures(loaded.angles, own))
    fields = () if own.fields is None else (own.fields,)
    stressed = tuple(table for each in fields for table in tables.stress_tables(each))
    values = assembly_values(loaded, model.spec.contact.model, forces)
    return Answer(values, found + pictures + stressed, (), tuple(_findings(model.spec, loaded.angles, own)), fields=fields)


def load(model: IndexerModel, fineness: float = 1.0, positions: int = POSITIONS) -> LoadedAssembly:
    """The `LoadedAssembly` at `positions` over the index period, or at the one input angle given."""
    angles = model.angles if len(model.angles) == 1 else np.linspace(0.0, model.wheel.motion.motion_angle, positions)
    contacts, bodies = contacts_at(model.wheel, angles, REACH), model.solids
    rigid, wheel = model.rigid_wheel.train, model.loaded_wheel
    train = rigid._replace(shaft=solid.seated(rigid.shaft, bodies.shaft))
    condensed = solid.condense_assembly(model.wheel, train, bodies, angles, contacts, cams=model.spec.cams, fineness=fineness)
    solids = {each: solid.load_assembly(condensed, model.torque, each, each == model.spec.contact.model) for each in MODELS}
    return LoadedAssembly(
        angles, contacts, solids, {each: solve_at_contacts(wheel._replace(model=each), angles, contacts, model.torque) for each in MODELS}
    )


def assembly_values(loaded: LoadedAssembly, model: str, forces: Table) -> dict[str, Value]:
    """Stiffness and compliance of the positions that carry, under the spec's contact model, and the mean with pins that stick."""
    own, lumped, angles = loaded.solids[model], loaded.lumped[model], loaded.angles
    carried = np.isfinite(own.secant)
    words = "share of the positions at which the assembly of solids carries no torque"
    over = "" if carried.all() else " over the positions that carry the torque"
    values = {"assembly.undefined_fraction": Value(float(np.mean(~carried)), "-", words, label="Positions without stiffness, solids")}
    if not carried.any():
        return values
    secant, least = own.secant[carried], int(np.nanargmin(own.secant))
    ratio = float(np.mean(secant) / np.mean(lumped.secant[carried]))
    values |= {
        "assembly.stiffness.mean": _within_mesh(
            float(np.mean(secant)), "N m/rad", f"mean secant stiffness of the assembly of solids{over}", "Mean secant stiffness, solids"
        ),
        "assembly.stiffness.minimum": _within_mesh(
            float(own.secant[least]),
            "N m/rad",
            f"minimum secant stiffness of the assembly of solids{over}",
            "Minimum secant stiffness, solids",
        ),
        "assembly.stiffness.minimum.at": Value(
            float(angles[least]),
            "rad",
            "input angle at minimum secant stiffness of the assembly of solids",
            label="Input angle at minimum, solids",
        ),
        "assembly.stiffness.ratio": _within_mesh(
            ratio, "-", "mean stiffness of the assembly of solids over that of the lumped model", "Stiffness ratio, solids to lumped model"
        ),
    }
    values |= dict(_body_values(own, lumped, carried))
    bonded = loaded.solids["bonded"].secant
    if np.isfinite(bonded).any():
        words, label = "mean secant stiffness of the assembly of solids with bonded pins", "Mean stiffness, solids, bonded pins"
        values["assembly.bonded.stiffness.mean"] = _within_mesh(float(np.nanmean(bonded)), "N m/rad", words, label)
    if len(forces["force"].data):
        values["assembly.pins.max_force"] = Value(
            float(np.max(forces["force"].data)),
            "N",
            "maximum force on a pin of the assembly of solids",
            label="Maximum force on a pin, solids",
        )
    if np.isfinite(forces["pressure"].data).any():
        largest = float(np.nanmax(forces["pressure"].data))
        values["assembly.pins.max_pressure"] = Value(
            largest, "Pa", "maximum Hertz pressure on a pin of the assembly of solids", label="Maximum Hertz pressure on a pin, solids"
        )
    words = "unknowns of the finite elements, one of each body"
    values["assembly.unknowns"] = Value(float(sum(own.unknowns.values())), "-", words, label="Unknowns of the finite elements")
    return values


def _within_mesh(value: float, unit: str, meaning: str, label: str) -> Value:
    """A stiffness, which finer meshes lower."""
    return Value(value, unit, meaning, (1 - MESH_ERROR) * value, value, "mesh", label=label)


def _body_values(own: SolidStiffness, lumped: TorsionalStiffness, carried: Bools) -> Iterator[tuple[str, Value]]:
    """Shares of the bodies in the compliance, means over the positions that carry, and in what the lumped model leaves out."""
    whole, added = tables.compliance_by_body(own), tables.added_compliance(own, lumped)
    total = float(np.mean(1 / own.secant[carried]))
    missing = total - float(np.mean(1 / lumped.secant[carried]))
    for name, (body, _, _) in tables.BODIES.items():
        part = float(np.mean(whole[name][carried])) / total
        meaning = f"share of the {body} in the compliance of the assembly of solids, mean over the positions"
        yield f"assembly.share.{name}", Value(part, "-", meaning, label=f"Compliance share, {body}")
        part = float(np.mean(added[name][carried])) / missing
        meaning = f"share of the {body} in the compliance that the lumped model neglects, mean over the positions"
        yield f"assembly.added.{name}", Value(part, "-", meaning, label=f"Neglected share, {body}")


def _pictures(angles: Floats, own: SolidStiffness) -> Iterator[Table]:
    """The deformed bodies where the assembly is softest."""
    if np.isfinite(own.secant).any():
        least = int(np.nanargmin(own.secant))
        for body in own.surfaces:
            yield tables.surface_table(own, least, body, where=f", input at {np.degrees(angles[least]):.4g}°")


def _findings(spec: IndexerSpec, angles: Floats, own: SolidStiffness) -> Iterator[str]:
    """Where the assembly carries nothing and why, and how far its numbers can be trusted."""
    for reason in dict.fromkeys(reason for reason in own.reasons if reason):
        rows = [k for k, each in enumerate(own.reasons) if each == reason]
        places = ", ".join(f"{angle:.4g}" for angle in np.degrees(angles[rows]))
        yield f"assembly: no stiffness at {len(rows)} of {len(angles)} input angles ({places}°): {reason}"
    yield (
        "assembly: wheel, drum and seats have usual proportions where the spec has no key for them (theory.md); a finer mesh lowers the "
        f"stiffness by up to {100 * MESH_ERROR:.0f} %"
    )
    stiffness = tables.equivalent_pin_stiffness(own)
    if np.isfinite(stiffness):
        given = spec.contact.pin_stiffness
        there = "rigid pins" if given is None else f"{given:.3g} N/m"
        yield f"assembly: pins and wheel yield like contact.pin_stiffness = {stiffness:.3g} N/m; the lumped model has {there}"
    if own.fields is not None:
        yield from (f"assembly, stress: {note}" for note in own.fields.notes)
