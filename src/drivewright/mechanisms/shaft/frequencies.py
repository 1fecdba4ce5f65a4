"""Natural frequencies and critical speeds."""

import numpy as np

from drivewright import shafts
from drivewright.errors import InputError, SpecError
from drivewright.result import Answer, Check, Column, Table, Value
from drivewright.shafts.beam import FREEDOMS
from drivewright.shafts.linearised import refined_equilibrium

ELEMENTS, MOST_ELEMENTS = 40, 1000  # along the shaft, at least and at most


def no_modes(spec):
    return None if spec.analysis.modes else "no modes are asked for (analysis.modes = 0)"


def frequencies(model, done):
    """Modes and critical speeds about the equilibrium of the loads, and what a massless shaft would make of them."""
    count, fine = model.spec.analysis.modes, refined(model, done["statics"].data.equilibrium)
    try:
        (found, axial), critical = shafts.modes(fine, count), shafts.critical_speeds(fine, count)
    except InputError as error:
        return Answer(findings=(f"modes are absent: {error}",), outcome="left out")
    if not len(found.frequencies) + len(axial.frequencies):
        return Answer(
            findings=("modes are absent: nothing that can move has a mass; give a density, or a station a mass",), outcome="left out"
        )
    values = {
        f"{kind}.{n}.frequency": Value(float(f), "Hz", f"natural frequency {n} {words}, at rest")
        for kind, words, some in (("modes", "of bending", found), ("axial_modes", "along the axis", axial))
        for n, f in enumerate(some.frequencies, 1)
    }
    values |= {
        f"critical_speeds.{way}.{n}": Value(float(s), "rad/s", f"critical speed {n}, whirling {words} the shaft")
        for way, words, speeds in (("forward", "with", critical.forward), ("backward", "against", critical.backward))
        for n, s in enumerate(speeds, 1)
    }
    values |= {
        f"torsional_modes.{n}.frequency": Value(float(f), "Hz", f"natural frequency {n} of torsion of the free shaft")
        for n, f in enumerate(shafts.torsional(fine, min(count, 3)).frequencies, 1)
    }
    lowest = shafts.lowest_excited(fine, critical)
    if lowest:
        values["critical_speeds.lowest"] = Value(
            lowest,
            "rad/s",
            "lowest critical speed that an unbalance excites: with the shaft, on bearings that are not the same all round also against it",
        )
    massless, findings = _massless(model, done, found)
    return Answer(values | massless, (_shape_table(model, fine, found),), tuple(_speed_check(model, lowest)), findings)


def refined(model, at_rest):
    """The same equilibrium on a mesh that is fine enough for the shapes of the modes; bearings keep their tangents."""
    step = model.spec.analysis.element_length or model.shaft.length / ELEMENTS
    if model.shaft.length / step > MOST_ELEMENTS:
        raise SpecError(
            f"makes {model.shaft.length / step:.0f} elements of the shaft; {MOST_ELEMENTS} are the most", "analysis.element_length"
        )
    return refined_equilibrium(at_rest, step)


def _massless(model, done, shapes):
    """Frequencies of the stations' masses alone on the flexibility, and the error of leaving out the shaft's own mass."""
    found = done["flexibility"].data if "flexibility" in done else None
    masses = np.array([station.mass for station in model.shaft.stations])
    if found is None or not len(masses) or np.any(masses == 0) or not len(shapes.frequencies):
        return {}, ()
    root = np.sqrt(masses)
    inverse = np.linalg.eigvalsh(root[:, None] * found.delta * root)[::-1]
    squares = 1 / inverse[inverse > 1e-12 * inverse[0]]  # a station on a rigid bearing does not move
    values = {
        f"massless_modes.{n}.frequency": Value(
            float(np.sqrt(s) / (2 * np.pi)), "Hz", f"natural frequency {n} of the stations' masses on a massless shaft"
        )
        for n, s in enumerate(squares, 1)
    }
    along = _first_along(model, shapes)
    if along is None or any(station.diametral for station in model.shaft.stations):
        return values, ()
    error = np.sqrt(squares[0]) / (2 * np.pi) / shapes.frequencies[along] - 1
    return values, (f"leaving out the shaft's own mass (K = inverse of the flexibility) puts mode {along + 1} off by {100 * error:+.1f} %",)


def _first_along(model, shapes):
    """Number of the first mode that moves along the unit loads, where modes have planes of their own; None where none does."""
    for number, shape in enumerate(shapes.shapes.T):
        nodes = shape[: len(shape) // FREEDOMS * FREEDOMS].reshape(-1, FREEDOMS)[:, :2]
        if np.sum((nodes @ model.direction) ** 2) > 0.5 * np.sum(nodes**2) or not nodes[:, 0].any():
            return number
    return None


def _speed_check(model, lowest):
    drive = model.spec.drive
    if drive is not None and lowest:
        yield Check(
            "critical_speed",
            lowest / drive.speed,
            model.spec.limits.critical_speed,
            ">=",
            "-",
            "lowest critical speed that an unbalance excites over the speed of the shaft",
            ("shaft",),
        )


def _shape_table(model, fine, found):
    z, n = fine.model.beam.z, fine.model.beam.size
    columns = [Column("z", "m", "distance from the left end", z)]
    for number, shape in enumerate(found.shapes.T, 1):
        x, y = shape[0:n:FREEDOMS], shape[1:n:FREEDOMS]
        way = x if np.abs(x).max() > np.abs(y).max() else y
        largest, plane = way[np.argmax(np.abs(way))], "" if not x.any() else " along x" if way is x else " along y"
        columns.append(Column(f"mode_{number}", "-", f"mode {number}, {found.frequencies[number - 1]:.4g} Hz{plane}", way / largest))
    return Table("modes", "Shapes of the natural modes", tuple(columns))
