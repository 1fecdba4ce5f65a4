"""Torsional stiffness of a pin-wheel indexer with its bodies as solids, beside that of the reduced model (extra `fe`).

Cams, eccentric shafts and pin wheel are meshed once with curved second-order tetrahedra and condensed to the loads between them; at every
position they are joined by what joins them in the reduced model: pins that press or stick, bearings by their laws between the mean
displacements of their seats, the flanks of the gears.  The contact state is that of the assembly: every contact of every cam takes part
that may close.  What differs from the reduced model is thus the elasticity of the bodies alone.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from time import perf_counter
from typing import Literal, NamedTuple

import numpy as np

from drivewright._typing import ArrayLike, Floats
from drivewright.errors import DoesNotAssemble, InputError, SolverError
from drivewright.indexing.contacts import CamContacts
from drivewright.indexing.drivetrain import Drivetrain
from drivewright.indexing.pin_wheel import PinWheel
from drivewright.indexing.solid.condensation import STRIP, Bodies, condensed, touching_point
from drivewright.indexing.solid.fields import Loaded, pressed_points, stress_fields
from drivewright.indexing.solid.parts import Solids, check
from drivewright.indexing.solid.springs import Position, PositionSettings, springs_between
from drivewright.indexing.solid.surfaces import deformed_surfaces
from drivewright.indexing.stiffness import TorsionalStiffness, solve_torsional_stiffness
from drivewright.indexing.stiffness.result import FAR, REASONS, ROTATION_LIMIT
from drivewright.solids.coupling import CoupledSolution, InterfaceSpring, functional_offsets
from drivewright.solids.deformation import DisplacedSurface
from drivewright.solids.nonlinear_coupling import NonlinearSpring, solve_nonlinear
from drivewright.steps import note_step
from drivewright.surface_fields import SurfaceFields

GROUPS = ("pin", "crank", "support", "gear", "wheel bearing", "output", "cam", "shaft", "wheel")


@dataclass(frozen=True, eq=False)
class SolidStiffness:
    """The assembly at p positions; nan where it does not carry, and `reasons` says why.

    secant (p,) [N m/rad] with solids; reduced: the `TorsionalStiffness` beside it; shares: compliance [rad/(N m)] of each of GROUPS (p,),
    force times displacement over torque^2, which add up to 1/secant: springs first, then the elasticity of cams, shafts and wheel.
    pin_forces: one array (cams, k) [N] a position, as in `TorsionalStiffness`; energy (p,) [J] stored in bodies and springs.
    unknowns: {"cam", "shaft", "wheel"} of one mesh each, 0 where a body is not a solid.
    surfaces: {"cam", "shaft", "wheel": `DisplacedSurface`} of the solids, displacements (p, n, 3) [m].
    fields: stress on the deformed solids at a few positions, None without pictures or solids.
    """

    theta: Floats
    torque: float
    secant: Floats
    reduced: TorsionalStiffness
    shares: dict[str, Floats]
    pin_forces: tuple[Floats, ...]
    energy: Floats
    reasons: tuple[str, ...]
    unknowns: dict[str, int]
    seconds: float
    surfaces: dict[str, DisplacedSurface]
    fields: SurfaceFields | None = None

    @property
    def ratio(self) -> Floats:
        """Stiffness with solids over that of the reduced model."""
        return self.secant / self.reduced.secant


class SolidAssembly(NamedTuple):
    """Condensed bodies and positions of a drive, the time [s] that it took to mesh and condense them, and the width [m] of a contact's
    strip on a cam."""

    wheel: PinWheel
    drive: Drivetrain
    solids: Solids
    cams: int
    theta: Floats
    places: tuple[Position, ...]
    bodies: Bodies
    seconds: float
    strip: float


class _Loaded(NamedTuple):
    """One position in equilibrium."""

    coupled: CoupledSolution
    shares: dict[str, float]
    pins: Floats
    energy: float


def condense_assembly(
    wheel: PinWheel,
    drive: Drivetrain,
    solids: Solids,
    theta: ArrayLike,
    contacts: Sequence[CamContacts],
    *,
    cams: int = 2,
    fineness: float = 1.0,
    strip: float = STRIP,
) -> SolidAssembly:
    """The `SolidAssembly` of a `PinWheel`, its `Drivetrain` and `Solids` at the angles theta (p,) [rad], to be loaded as often as wanted.

    contacts: `CamContacts` of cam 0, one a position, as for the reduced model; fineness: factor on all element sizes; strip: width sigma of
    a contact on the cam in radii of a pin.  InputError where bodies have no meaning, overlap or do not fit.
    """
    started = perf_counter()
    check(solids, wheel, drive, cams)
    theta = np.atleast_1d(np.asarray(theta, dtype=float))
    places = tuple(_position(wheel, float(angle), here, i) for i, (angle, here) in enumerate(zip(theta, contacts, strict=True)))
    bodies = condensed(wheel, drive, solids, places, cams, fineness, strip)
    return SolidAssembly(wheel, drive, solids, cams, theta, places, bodies, perf_counter() - started, strip * wheel.pin_radius)


def load_assembly(
    assembly: SolidAssembly, torque: float, model: Literal["unilateral", "bonded"] = "unilateral", pictures: bool = True
) -> SolidStiffness:
    """`SolidStiffness` of a `SolidAssembly` under a torque [N m]; without `pictures` no surfaces.

    model: "unilateral" - contacts press, also those whose gap closes; "bonded" - the intended ones without a gap stick, no others.
    SolverError where the reduced model carries the torque somewhere and the assembly nowhere.
    """
    started = perf_counter()
    wheel, drive, _, cams, theta, places, bodies, *_ = assembly
    reduced = solve_torsional_stiffness(
        drive, theta, [each.contacts for each in places], wheel.eccentricity, torque, cams=cams, sense=int(wheel.sense), model=model
    )
    settings = PositionSettings(cams, model == "bonded", assembly.solids.wheel is not None, 2 * abs(torque) / drive.spacing)
    found, reasons = {}, list(reduced.reasons)
    carried = np.flatnonzero(reduced.carried)
    for number, i in enumerate(carried, 1):
        note_step(f"positions, {model}", number, len(carried))
        try:
            found[int(i)] = _loaded(assembly, places[i], settings, torque)
        except (DoesNotAssemble, SolverError) as error:
            reasons[i] = str(error)
    if reduced.carried.any() and not found:
        raise SolverError(reasons[int(reduced.carried.argmax())])
    shares = {group: _spread(theta, {i: each.shares[group] for i, each in found.items()}) for group in GROUPS}
    return SolidStiffness(
        theta,
        torque,
        1 / np.sum(list(shares.values()), axis=0),
        reduced,
        shares,
        tuple(found[i].pins if i in found else np.full((cams, len(each.contacts.gap)), np.nan) for i, each in enumerate(places)),
        _spread(theta, {i: each.energy for i, each in found.items()}),
        tuple(reasons),
        {name: bodies[key].unknowns for name, key in (("cam", ("cam", 0)), ("shaft", ("shaft", 0)), ("wheel", ("wheel",)))},
        assembly.seconds + perf_counter() - started,
        deformed_surfaces(bodies, {i: each.coupled for i, each in found.items()}, len(theta)) if pictures and found else {},
        _fields(assembly, found) if pictures and found else None,
    )


def solid_stiffness(
    wheel: PinWheel,
    drive: Drivetrain,
    solids: Solids,
    theta: ArrayLike,
    contacts: Sequence[CamContacts],
    torque: float,
    *,
    cams: int = 2,
    model: Literal["unilateral", "bonded"] = "unilateral",
    fineness: float = 1.0,
    strip: float = STRIP,
) -> SolidStiffness:
    """`condense_assembly` and `load_assembly` at once; InputError where no position carries the torque."""
    check(solids, wheel, drive, cams)
    theta = np.atleast_1d(np.asarray(theta, dtype=float))
    reduced = solve_torsional_stiffness(drive, theta, contacts, wheel.eccentricity, torque, cams=cams, sense=int(wheel.sense), model=model)
    if not reduced.carried.any():
        raise InputError(f"assembly: no position carries the torque: {reduced.reasons[0]}.")
    assembly = condense_assembly(wheel, drive, solids, theta, contacts, cams=cams, fineness=fineness, strip=strip)
    return load_assembly(assembly, torque, model)


def _fields(assembly: SolidAssembly, found: Mapping[int, _Loaded]) -> SurfaceFields | None:
    """Stress of the positions that carry."""
    if not any(body.free for body in assembly.bodies.values()):
        return None
    loaded = []
    for i, each in found.items():
        place = assembly.places[i]
        touched = [int(c) for c in np.flatnonzero(place.kept(False))]
        points = {c: touching_point(assembly.wheel, place, c) for c in touched}
        loaded.append(Loaded(place, each.coupled, pressed_points(points, each.pins, touched)))
    return stress_fields(assembly.drive, assembly.bodies, loaded, assembly.wheel.eccentricity, assembly.cams, assembly.strip)


def _spread(theta: Floats, values: Mapping[int, float]) -> Floats:
    return np.array([values.get(i, np.nan) for i in range(len(theta))])


def _position(wheel: PinWheel, angle: float, here: CamContacts, number: int) -> Position:
    turned = float(np.angle(np.mean(here.centre * np.exp(-2j * np.pi * here.pin / wheel.pins))))
    return Position(number, wheel.sense * angle, turned, wheel.pins, here)


def _loaded(assembly: SolidAssembly, place: Position, settings: PositionSettings, torque: float) -> _Loaded:
    """The position under the torque; SolverError where the wheel turns so far that other contacts act."""
    springs = list(springs_between(assembly.drive, place, settings))
    linear = [each for each in springs if isinstance(each, InterfaceSpring)]
    laws = [each for each in springs if isinstance(each, NonlinearSpring)]
    found = solve_nonlinear(assembly.bodies, linear, laws, (("wheel",), ("flange", 5), torque / assembly.wheel.circle_radius))
    groups = [each.group for each in linear] + [each.group for each in laws for _ in each.rows]
    shares = _shares(assembly.bodies, assembly.drive, groups, found.coupled, torque)
    if abs(torque) * sum(shares.values()) > ROTATION_LIMIT:
        raise SolverError(REASONS[FAR])
    pins = np.zeros((settings.cams, len(place.contacts.gap)))
    pins[:, place.kept(settings.bonded)] = found.coupled.forces[[group == "pin" for group in groups]].reshape(settings.cams, -1)
    return _Loaded(found.coupled, shares, pins, found.energy)


def _shares(bodies: Bodies, drive: Drivetrain, groups: Sequence[str], found: CoupledSolution, torque: float) -> dict[str, float]:
    """Work of springs and bodies over torque^2; of the output shaft, in series, its compliance."""
    shares: dict[str, float] = dict.fromkeys(GROUPS, 0.0)
    for group, force, strain in zip(groups, found.forces, found.strains, strict=True):
        shares[group] += force * strain / torque**2
    start, _ = functional_offsets(bodies)
    for name, body in bodies.items():
        loads = found.loads[start[name] : start[name] + len(body.flexibility)]
        if name[0] in shares:
            shares[name[0]] += float(loads @ body.flexibility @ loads) / torque**2
    shares["output"] += 0.0 if drive.wheel_torsion is None else 1 / drive.wheel_torsion
    return shares
