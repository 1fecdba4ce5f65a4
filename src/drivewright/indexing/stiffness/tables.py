"""Torsional stiffness, forces of pins and loads of bearings as tables, and their plots."""

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from drivewright._typing import Complexes, Floats
from drivewright.indexing.contacts import CamContacts
from drivewright.indexing.pin_pressure import contact_force_table, pin_pressure
from drivewright.indexing.stiffness.result import TorsionalStiffness, WheelStiffness
from drivewright.result import Column, Plot, Table

GROUP_LABELS = {
    "pin": "pin contacts",
    "crank": "crank bearings",
    "support": "support bearings",
    "housing": "housing",
    "bending": "shafts in bending",
    "torsion": "shafts in torsion",
    "gear": "gears",
    "wheel": "wheel and its bearing",
    "cam": "cam shaft bearings",
    "input": "input shaft",
}
NO_SHARE = 1e-9  # of the largest share of a compliance: rounding
SHAFTS, ENDS = ("left", "right"), ("front", "rear")


def stiffness_table(angles: Floats, result: WheelStiffness, loaded: WheelStiffness, free: Floats, reverse: WheelStiffness) -> Table:
    """Secant, tangent and the share of every group in the compliance; after the play where the wheel turns freely first.

    angles (p,) [rad]; result: at the contacts without a gap; loaded: after the free rotation `free` (p,) [rad]; reverse: torque reversed.
    """
    columns = [
        Column("angle", "rad", "input angle", angles),
        Column("secant", "N m/rad", "secant stiffness, torque over rotation of the wheel", result.secant),
        Column("tangent", "N m/rad", "tangent stiffness, change of torque over change of rotation", result.tangent),
    ]
    columns += [Column(name, "rad/(N m)", f"compliance of the {GROUP_LABELS[name]}", share) for name, share in result.shares.items()]
    columns += [
        Column("free_rotation", "rad", "play before a contact carries the torque", free, "Play before holding contact"),
        Column("secant_after_play", "N m/rad", "secant stiffness after the play, torque over the rotation beyond it", loaded.secant),
        Column("secant_reversed", "N m/rad", "secant stiffness, torque reversed", reverse.secant, "Secant stiffness, torque reversed"),
    ]
    return Table("stiffness", "Torsional stiffness", tuple(columns))


def pin_force_table(
    angles: Floats,
    contacts: Sequence[CamContacts],
    pin_forces: Sequence[Floats],
    pin_radius: float,
    width: float,
    modulus: float,
    name: str = "pin_forces",
    title: str = "Forces on the pins",
) -> Table:
    """Force and Hertz pressure of every loaded contact, one row each.

    pin_forces: (cams, k) [N] a position, as of a `TorsionalStiffness`; lengths [m], effective modulus E* [Pa].
    """
    rows = []
    for angle, each, forces in zip(angles, contacts, pin_forces, strict=True):
        for cam, row in enumerate(forces):
            for k in np.flatnonzero(np.nan_to_num(row) != 0):
                pressure = pin_pressure(row[k], each.curvature[k], pin_radius, width, modulus)
                rows.append((angle, cam, each.pin[k], row[k], each.arm[k], pressure))
    return contact_force_table(
        name,
        title,
        ("angle", "cam", "pin", "force", "arm", "pressure"),
        rows,
        {"pin": "pin, counted from the line of the first cam", "force": "force on the pin"},
        missing="there is no Hertz pressure at a corner, under tension, or where the profile is as hollow as the pin",
    )


def bearing_forces(result: TorsionalStiffness) -> dict[str, Complexes]:
    """{name: force (p,) [N], complex} of every bearing: "crank.left.cam1", ..., "support.right.rear"."""
    cams = result.crank_forces.shape[2]
    cranks = {f"crank.{side}.cam{cam + 1}": result.crank_forces[:, s, cam] for s, side in enumerate(SHAFTS) for cam in range(cams)}
    return cranks | {f"support.{side}.{end}": result.support_forces[:, s, k] for s, side in enumerate(SHAFTS) for k, end in enumerate(ENDS)}


def bearing_load_table(angles: Floats, forces: Mapping[str, Complexes]) -> Table:
    """Size and components of the forces of `bearing_forces` over the input angle (p,) [rad]."""
    columns = [Column("angle", "rad", "input angle", angles)]
    for name, force in forces.items():
        label = _bearing_label(name)
        columns += [
            Column(name, "N", f"load of the {label}", np.abs(force), label),
            Column(f"{name}.x", "N", f"load of the {label} along x", force.real, f"{label}, x"),
            Column(f"{name}.y", "N", f"load of the {label} along y", force.imag, f"{label}, y"),
        ]
    return Table("bearing_loads", "Bearing loads", tuple(columns))


def _bearing_label(name: str) -> str:
    """ "crank.left.cam1" -> "left crank bearing of cam 1"; "support.right.rear" -> "right rear support bearing"."""
    group, side, place = name.split(".")
    return f"{side} {place} support bearing" if group == "support" else f"{side} crank bearing of cam {place.removeprefix('cam')}"


def stiffness_plots(tables: Mapping[str, Table]) -> Iterator[Plot]:
    """The plots of `stiffness_table`, `pin_force_table` and `bearing_load_table`, of those that are among the tables of a result."""
    if "stiffness" in tables:
        yield Plot("stiffness", "Torsional stiffness", "stiffness", "angle", ("secant", "tangent", "secant_reversed"))
        given = [column.name for column in tables["stiffness"].columns if column.name in GROUP_LABELS]
        largest = {name: np.nanmax(np.abs(tables["stiffness"][name].data), initial=0.0) for name in given}
        groups = tuple(name for name, share in largest.items() if share > NO_SHARE * max(largest.values()))
        yield Plot("budget", "Compliance contributions", "stiffness", "angle", groups, style="bars")
    if "pin_forces" in tables:
        yield Plot("pin_forces", tables["pin_forces"].title, "pin_forces", "angle", ("force", "pressure"), style="points")
    if "shared_forces" in tables:
        title = "Roller forces shared by stiffness"
        yield Plot("shared_forces", title, "shared_forces", "angle", ("force", "pressure"), style="points")
    if "bearing_loads" in tables:
        names = [column.name for column in tables["bearing_loads"].columns[1:] if column.name[-2:] not in (".x", ".y")]
        for group in ("crank", "support"):
            own = tuple(name for name in names if name.startswith(group))
            yield Plot(f"{group}_loads", f"Loads of the {group} bearings", "bearing_loads", "angle", own)
