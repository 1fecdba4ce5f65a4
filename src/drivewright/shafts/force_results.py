"""Forces on a shaft as values and tables of a result: teeth of its gears and how they stand, reactions, and both as vectors."""

from collections.abc import Iterator, Mapping

import numpy as np

from drivewright._typing import Floats
from drivewright.result import Column, Plot, Table, Value
from drivewright.shafts.equilibrium import ShaftEquilibrium
from drivewright.shafts.loads import ToothForces, slope_in_plane_of_action
from drivewright.shafts.model import ShaftLoad


def tooth_values(name: str, forces: ToothForces) -> dict[str, Value]:
    """The `ToothForces` of the gear of this name."""
    key = f"gears.{name}"
    return {
        f"{key}.{way}_force": Value(float(force), "N", f"{way} tooth force on gear {name!r}", convention=convention)
        for way, force, convention in (
            ("tangential", forces.tangential, "same sign as the torque"),
            ("radial", forces.radial, "positive towards the axis"),
            ("axial", forces.axial, "positive to the right"),
        )
    }


def seat_values(name: str, equilibrium: ShaftEquilibrium, load: ShaftLoad, face_width: float | None) -> dict[str, Value]:
    """Deflection [m], slope [rad] and misalignment of the gear of this name, whose teeth load the shaft at a node."""
    key, of = f"gears.{name}", f"of the shaft at gear {name!r}"
    move, slope = equilibrium.displacement_at(load.position), equilibrium.slope_at(load.position)
    across = slope_in_plane_of_action(slope, load)
    meaning = f"mesh slope of gear {name!r}, in the plane of action"
    sense = "positive where the deflection along the tooth force grows to the right"
    values = {
        f"{key}.deflection": Value(float(np.hypot(*move)), "m", f"deflection {of}, magnitude"),
        f"{key}.slope": Value(float(np.hypot(*slope)), "rad", f"slope {of}, magnitude"),
        f"{key}.mesh_slope": Value(across, "rad", meaning, convention=sense),
    }
    if face_width:
        meaning = f"face misalignment of gear {name!r}, in the plane of action, from this shaft alone"
        values[f"{key}.misalignment"] = Value(abs(across) * face_width, "m", meaning)
    return values


def vector_table(forces: Mapping[str, Floats]) -> Table:
    """`force_vectors`: the forces (x, y) [N] on the shaft by the name of what exerts them, each from the axis to its tip in a column of
    its own."""
    tips = np.array([point for force in forces.values() for point in (np.zeros(2), np.asarray(force, float)[:2])])
    columns = [Column("x", "N", "force on the shaft along x", tips[:, 0])]
    for n, name in enumerate(forces):
        data = np.full(len(tips), np.nan)
        data[2 * n : 2 * n + 2] = tips[2 * n : 2 * n + 2, 1]
        columns.append(Column(name, "N", f"force along y, {name}", data, name))
    return Table("force_vectors", "Forces across the shaft", tuple(columns), "each force has rows of its own")


def vector_plots(tables: Mapping[str, Table]) -> Iterator[Plot]:
    """The forces as vectors in the plane across the axis: x and y as everywhere, z towards the eye."""
    if "force_vectors" in tables:
        names, title = tuple(column.name for column in tables["force_vectors"].columns[1:]), "Forces across the shaft"
        meaning = "seen from the right end of the shaft: x to the right, y up, z towards the viewer"
        yield Plot("force_vectors", title, "force_vectors", "x", names, equal=True, whole=True, meaning=meaning)
