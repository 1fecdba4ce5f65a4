"""The shaft once more: by integrals that share no formula with the elements, its bearings alone, and as a solid of finite elements.

Rows are tuples (name, ours, other, unit, allowed difference, route) in SI.
"""

import re
from collections.abc import Iterator

import numpy as np

from drivewright import bearings, shafts
from drivewright.errors import InputError, MissingExtra
from drivewright.mechanisms.shaft.build import ShaftModel
from drivewright.mechanisms.shaft.frequencies import turning_equilibrium
from drivewright.mechanisms.shaft.rotation import unbalances
from drivewright.mechanisms.shaft.spec import ShaftSpec
from drivewright.oracles.shaft import moment_integrals
from drivewright.registry import LeftOut, Row
from drivewright.result import Result
from drivewright.shafts.solid_check import allowed_difference, solid_and_beam

WHIRL = re.compile(r"whirl\.(forward|backward)\.[12]")
INTEGRAL = "integrals of M^2/EI, redundant reactions"
GIVEN = "integral of the moments of loads and reactions"
ALONE = "rolling bearing alone, at the force found"
TURNING, ROSS = "whirl and unbalance response in ROSS", "ROSS: elements, eigenvalues and response of its own"
SOLID = "solid of second-order finite elements"


def verify(model: ShaftModel, result: Result[ShaftSpec]) -> Iterator[Row | LeftOut]:
    """All rows."""
    loaded = shafts.apply_loads(model.shaft, model.loads)
    yield from _flexibility(model, result)
    yield from _balance(loaded)
    yield from _deflections(model, loaded)
    yield from _bearings(model, loaded)
    if "flexibility" in result.arrays:
        yield from _solid(model, loaded.equilibrium)
    if "campbell" in result.tables:
        yield from _turning(model, result)


def _flexibility(model, result):
    """Where the bearings are springs across the shaft alone."""
    if "flexibility" not in result.arrays or not all(_is_spring(support) for support in model.shaft.supports):
        return
    ours = result.arrays["flexibility"].values
    other = moment_integrals.flexibility(
        model.shaft, [(s.position, s.stiffness[0]) for s in model.shaft.supports if s.stiffness[0]], model.places
    )
    for name, i, j in _pairs(model):
        yield f"flexibility {name}", ours[i, j], other[i, j], "m/N", 1e-8 * np.sqrt(ours[i, i] * ours[j, j]) + 1e-16, INTEGRAL


def _is_spring(support):
    return support.law is None and not support.width and not any(support.stiffness[3:]) and support.stiffness[0] == support.stiffness[1]


def _pairs(model):
    return [(f"{a}, {b}", i, j) for i, a in enumerate(model.names) for j, b in enumerate(model.names) if j >= i]


def _balance(loaded):
    """Reactions against loads."""
    equilibrium, n = loaded.equilibrium, loaded.equilibrium.model.beam.size
    force = loaded.force[:n].reshape(-1, 6)
    if not np.abs(force).max() > 0:
        return
    z, places = equilibrium.model.beam.z, np.array([mount.support.position for mount in equilibrium.model.mounts])
    size = np.abs(force[:, :3]).max() + np.abs(equilibrium.reactions).max()
    for axis, name in enumerate("xy"):
        yield (
            f"sum of the reactions along {name}",
            equilibrium.reactions[:, axis].sum(),
            -force[:, axis].sum(),
            "N",
            1e-8 * size,
            "sum of the loads",
        )
        across, sign = 4 - axis, 1 - 2 * axis
        ours = equilibrium.reactions[:, axis] @ places + sign * equilibrium.reactions[:, across].sum()
        loads = force[:, axis] @ z + sign * force[:, across].sum()
        yield f"moment of the reactions, {name}", ours, -loads, "N m", 1e-8 * size * z[-1], "moment of the loads"


def _deflections(model, loaded):
    """Deflection of stations and gears from the loads and reactions alone, between the first and the last bearing."""
    equilibrium = loaded.equilibrium
    if len(equilibrium.model.mounts) < 2 or not model.loaded or any(mount.support.width for mount in equilibrium.model.mounts):
        return
    beam, spec = equilibrium.model.beam, model.spec
    places = [(f"{table}.{part.name}", part.position) for table in ("stations", "gears") for part in getattr(spec, table)]
    for axis, name in enumerate("xy"):
        forces, couples = moment_integrals.acting(loaded, axis)
        ends = sorted(mount.support.position for mount in equilibrium.model.mounts)
        first, last = (equilibrium.u[6 * beam.node(place) + axis] for place in (ends[0], ends[-1]))
        deflections = moment_integrals.deflections_through(
            model.shaft, (ends[0], first), (ends[-1], last), forces, couples, [z for _, z in places]
        )
        size = np.abs(equilibrium.u[: beam.size].reshape(-1, 6)[:, :2]).max()
        for (part, place), other in zip(places, deflections, strict=True):
            ours = equilibrium.u[6 * beam.node(place) + axis]
            if size > 0 and max(abs(ours), abs(other)) > 1e-9 * size:
                yield f"{part}.deflection_{name}", ours, other, "m", 1e-6 * size, GIVEN


def _bearings(model, loaded):
    """Each rolling bearing on its own finds the displacement under the force that the shaft puts on it."""
    for mount in loaded.equilibrium.model.mounts:
        inner = model.rolling.get(mount.support.name)
        if inner is None:
            continue
        own = mount.rows @ loaded.equilibrium.unknowns - mount.support.offset
        force = bearings.solve(inner, displacement=own).force
        if np.hypot(*force[:2]) > 0:
            free = np.abs(force) > 1e-9 * np.abs(force[:2]).max() * np.array([1, 1, 1, inner.pitch_diameter, inner.pitch_diameter])
            equilibrium = bearings.solve(
                inner,
                force=np.where(free, force, 0.0),
                start=np.where(free, 0.0, own),
                held=tuple(name for name, is_free in zip(bearings.FREEDOMS, free, strict=True) if not is_free),
            )
            size = float(np.hypot(*own[:2]))
            for axis, name in enumerate("xy"):
                yield (
                    f"bearings.{mount.support.name}, displacement {name}",
                    own[axis],
                    equilibrium.displacement[axis],
                    "m",
                    1e-6 * size,
                    ALONE,
                )


def _solid(model, at_rest):
    try:
        solid, beam = solid_and_beam(at_rest, model.places, model.direction, model.spec.analysis.solid_band)
    except InputError:  # one bearing alone, or bands that meet: no case for the solid
        return
    for name, i, j in _pairs(model):
        allowed = allowed_difference(model.shaft) * np.sqrt(solid.flexibility[i, i] * solid.flexibility[j, j])
        yield f"flexibility {name}, on bands", beam[i, j], solid.flexibility[i, j], "m/N", float(allowed), SOLID


# -- ROSS ----------------------------------------------------------------------------------------------------------------------


def _turning(model, result):
    """Whirl frequencies and orbits at the speed of the shaft, or why there are none."""
    try:
        from drivewright.oracles.shaft import ross_model
    except ImportError as error:
        yield LeftOut(TURNING, str(MissingExtra("the turning shaft in ROSS", "peers", error)), "peers")
        return
    at_rest = turning_equilibrium(model, shafts.apply_loads(model.shaft, model.loads).equilibrium)
    missing = ross_model.unknown(at_rest)
    if missing:
        yield LeftOut(TURNING, f"its elements do not know {missing}")
        return
    twin, speed = ross_model.rotor(at_rest), model.spec.drive.speed
    frequencies, _ = ross_model.whirl_frequencies(twin, speed)
    for name, value in result.values.items():
        if WHIRL.fullmatch(name):
            nearest = frequencies[np.argmin(np.abs(frequencies - value.value))]
            yield name, value.value, float(nearest), "rad/s", 1e-5 * value.value, ROSS
    parts = [part for part in model.turning_parts if f"unbalance.{part.name}.amplitude" in result.values]
    found = ross_model.unbalance_amplitudes(twin, at_rest, unbalances(model), speed, [part.position for part in parts]) if parts else []
    for part, amplitude in zip(parts, found, strict=True):
        ours = result.values[f"unbalance.{part.name}.amplitude"].value
        yield f"unbalance.{part.name}.amplitude", ours, float(amplitude), "m", 1e-4 * ours, ROSS
