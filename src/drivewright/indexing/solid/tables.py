"""The assembly of solids as tables, and their plots."""

from collections.abc import Iterator, Mapping

import numpy as np

from drivewright._typing import Floats, Ints
from drivewright.errors import InputError
from drivewright.indexing.solid.assembly import SolidStiffness
from drivewright.indexing.stiffness import TorsionalStiffness
from drivewright.result import Column, Plot, Table
from drivewright.solids.deformation import DisplacedSurface, displaced_table, exaggeration_for, field_table
from drivewright.surface_fields import SurfaceBody, SurfaceFields

NOTHING = "at some input angles the assembly carries no torque"
WINDOW = 0.6  # of the radius: what is drawn of a wheel to both sides of a pin
DRAWN = 0.03  # the largest displacement is drawn as about this part of the body
BODIES = {  # label, shares of the assembly, shares of the lumped model
    "cam": ("cams", ("cam",), ()),
    "wheel": ("pins and wheel", ("pin", "wheel", "output", "wheel bearing"), ("pin", "wheel")),
    "shaft": ("shafts", ("shaft",), ("bending", "torsion")),
    "crank": ("crank bearings", ("crank",), ("crank",)),
    "support": ("support bearings", ("support",), ("support", "housing")),
    "gear": ("gears", ("gear",), ("gear",)),
}
SURFACES = {  # title, axes that are drawn (right, up, away) and their meanings
    "cam": ("Deformed cam", ((0, "transverse position"), (1, "height"), (2, "axial position"))),
    "shaft": ("Deformed split shaft", ((2, "axial position"), (1, "height"), (0, "transverse position"))),
    "wheel": ("Deformed wheel", ((0, "circumferential position"), (2, "axial position"), (1, "radial position"))),
}


def compliance_by_body(solid: SolidStiffness) -> dict[str, Floats]:
    """Compliance [rad/(N m)] of each of BODIES in the assembly (p,)."""
    return {name: np.sum([solid.shares[group] for group in groups], axis=0) for name, (_, groups, _) in BODIES.items()}


def added_compliance(solid: SolidStiffness, lumped: TorsionalStiffness) -> dict[str, Floats]:
    """What each of BODIES yields more in the assembly than in a lumped model at the same positions [rad/(N m)] (p,).

    They add up to 1/K - 1/K_lumped; bearings and gears differ only by the forces that the other bodies give them.
    """
    own = compliance_by_body(solid)
    return {name: own[name] - np.sum([lumped.shares[group] for group in groups], axis=0) for name, (_, _, groups) in BODIES.items()}


def equivalent_pin_stiffness(solid: SolidStiffness) -> float:
    """Stiffness k [N/m] of a pin in its seats that would yield like the solid wheel: sum F^2/k = T^2 C, F the forces of the pins and C the
    compliance of the wheel, both summed over the positions that carry; nan where the wheel is no solid."""
    carried = np.isfinite(solid.secant)
    squares = sum(float(np.sum(np.square(forces))) for forces, held in zip(solid.pin_forces, carried, strict=True) if held)
    yielded = solid.torque**2 * float(np.sum(solid.shares["wheel"][carried]))
    return squares / yielded if yielded > 0 else np.nan


def assembly_table(
    angles: Floats, solids: Mapping[str, SolidStiffness], lumped: Mapping[str, TorsionalStiffness], title: str = "Stiffness of the assembly"
) -> Table:
    """Secant stiffness of assembly and lumped model over the input angles (p,) [rad], {"unilateral", "bonded"} each."""
    words = {"unilateral": "unilateral pins", "bonded": "bonded pins"}
    columns = [Column("angle", "rad", "input angle", angles)]
    for model, text in words.items():
        columns.append(
            Column(
                f"lumped_{model}", "N m/rad", f"secant stiffness of the lumped model, {text}", lumped[model].secant, f"lumped model, {text}"
            )
        )
        columns.append(
            Column(
                model, "N m/rad", f"secant stiffness of the assembly of solids, {text}", solids[model].secant, f"assembly of solids, {text}"
            )
        )
    for model, text in words.items():
        columns.append(
            Column(
                f"ratio_{model}",
                "-",
                f"secant stiffness of solids over lumped model, {text}",
                solids[model].secant / lumped[model].secant,
                f"stiffness ratio, {text}",
            )
        )
    return Table("assembly", title, tuple(columns), missing=NOTHING)


def share_tables(angles: Floats, solid: SolidStiffness, lumped: TorsionalStiffness) -> Iterator[Table]:
    """Compliance by bodies of the assembly, and what each adds to that of the lumped model, over the input angles (p,) [rad]."""
    for name, title, what, shares in (
        ("assembly_shares", "Compliance of the assembly by body", "compliance", compliance_by_body(solid)),
        ("assembly_added", "Compliance neglected by the lumped model", "neglected compliance", added_compliance(solid, lumped)),
    ):
        columns = [
            Column(body, "rad/(N m)", f"{what} of the {label}", shares[body], f"{what}, {label}") for body, (label, _, _) in BODIES.items()
        ]
        yield Table(name, title, (Column("angle", "rad", "input angle", angles), *columns), missing=NOTHING)


def surface_table(solid: SolidStiffness, position: int, body: str = "cam", where: str = "", exaggeration: float | None = None) -> Table:
    """Table of a deformed body ("cam", "shaft", "wheel") at one position for a plot of style "mesh": three rows a triangle.

    The cam without its motion as a whole, the shaft against the housing; of the wheel, against its output, what lies about
    the pin that moves most, seen from its axis outwards.  `where` ends the title.
    """
    title, drawn = SURFACES[body]
    surface = solid.surfaces.get(body)
    if surface is None:
        raise InputError(f"assembly: the {body} is not a solid and has no deformed surface; give it as one.")
    displacement = surface.displacements[position]
    if body == "wheel":
        surface, displacement = _window_surface(surface, displacement)
    factor = exaggeration or exaggeration_for(np.ptp(surface.points[:, drawn[0][0]]), displacement, DRAWN)
    rest = tuple((axis, f"unloaded {words}") for axis, words in drawn[:2])
    return displaced_table(f"assembly_{body}", title + where, surface, displacement, factor, drawn, rest)


STRESSED = {  # title, axes that are drawn (right, up, towards the viewer) and their meanings, parts of an element's edge
    "cam": ("Von Mises stress, cam", ((0, "transverse position"), (1, "height"), (2, "axial position")), 2),
    "shaft": ("Von Mises stress, shaft", ((2, "axial position"), (1, "height"), (0, "transverse position")), 3),
    "wheel": ("Von Mises stress, wheel", ((0, "circumferential position"), (2, "axial position"), (1, "radial position")), 3),
}


def stress_tables(fields: SurfaceFields) -> Iterator[Table]:
    """Tables for plots of style "mesh": von Mises stress on the deformed cam, shaft and wheel, of each the one that bears most."""
    for kind, (title, drawn, parts) in STRESSED.items():
        alike = [body for body in fields.bodies if body.name.split("_")[0] == kind]
        if not alike:
            continue
        body = max(alike, key=lambda each: each.fields[0].range[1])
        step = int(np.nanmax(body.fields[0].values, axis=1).argmax())
        if kind == "wheel":
            body = _window_body(body, step)
        where = f", {fields.steps[step]}"
        yield field_table(f"assembly_{kind}_stress", title + where, body, step, "mises", fields.scale, drawn, parts)


def _window_body(body: SurfaceBody, step: int) -> SurfaceBody:
    """What lies about the point of a wheel that bears most, turned so that this point lies along y."""
    turn = _turn_to(body.points[np.nanargmax(body.fields[0].values[step])])
    points = body.points @ turn.T
    return body._replace(points=points, triangles=_window(points, body.triangles), displacements=body.displacements @ turn.T)


def _window_surface(surface: DisplacedSurface, displacement: Floats) -> tuple[DisplacedSurface, Floats]:
    """What lies about the point of a wheel that moves most, turned so that this point lies along y."""
    turn = _turn_to(surface.points[np.linalg.norm(displacement, axis=1).argmax()])
    points = surface.points @ turn.T
    return DisplacedSurface(points, _window(points, surface.triangles), surface.displacements), displacement @ turn.T


def _turn_to(point: Floats) -> Floats:
    """Rotation (3, 3) about z that brings a point (3,) onto the y axis."""
    x, y = point[:2] / np.hypot(*point[:2])
    return np.array([[y, -x, 0.0], [x, y, 0.0], [0.0, 0.0, 1.0]])


def _window(points: Floats, triangles: Ints) -> Ints:
    """The triangles (k, 3) of the upper half that lie within `WINDOW` to both sides of the y axis, seen from the z axis."""
    middle = points[triangles, :2].mean(axis=1)
    near = np.abs(middle[:, 0]) < WINDOW * np.hypot(*points[:, :2].T).max()
    return triangles[near & (middle[:, 1] > 0)]


def assembly_plots(tables: Mapping[str, Table]) -> Iterator[Plot]:
    """The plots of the tables above, of those that are among the tables of a result."""
    if "assembly" in tables:
        curves = ("lumped_unilateral", "unilateral", "lumped_bonded", "bonded")
        title = "Torsional stiffness, lumped and solids"
        yield Plot("assembly", title, "assembly", "angle", curves)
    for name in ("assembly_shares", "assembly_added"):
        if name in tables:
            yield Plot(name, tables[name].title, name, "angle", tuple(BODIES), style="bars")
    if "assembly_pins" in tables:
        yield Plot("assembly_pins", tables["assembly_pins"].title, "assembly_pins", "angle", ("force", "pressure"), style="points")
    for body, (_, drawn) in SURFACES.items():
        name = f"assembly_{body}"
        if name in tables:
            right, up, away = ("xyz"[axis] for axis, _ in drawn)
            reference, beside = (f"rest_{right}", f"rest_{up}"), "Dashed: outline of the undeformed body."
            shown = (up, away, "displacement")
            yield Plot(name, tables[name].title, name, right, shown, equal=True, style="mesh", reference=reference, meaning=beside)
    for kind in STRESSED:
        name = f"assembly_{kind}_stress"
        if name in tables:
            yield Plot(name, tables[name].title, name, "right", ("up", "depth", "mises"), equal=True, style="mesh")
