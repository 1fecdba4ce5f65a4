"""Small motions about a state of balance: mass, damping and stiffness of the independent coordinates, and their modes."""

from typing import Any, NamedTuple

import numpy as np
import scipy

from drivewright._jit import plain
from drivewright._typing import Complexes, Floats
from drivewright.errors import InputError
from drivewright.multibody.assembly import Assembly
from drivewright.multibody.forces.pin_contact import LASTING, elastic_of, gap_motion, loading_speed, penetration
from drivewright.multibody.simulate import repartition
from drivewright.multibody.statics import (
    Place,
    coordinate_names,
    coordinate_scales,
    equilibrium,
    forces_at_work,
    place_at_rest,
    reduced_equations,
    scaled_stiffness,
)
from drivewright.multibody.system import motion
from drivewright.numerics.linear import null_space

STEP = 1e-3  # of the differences, in lengths of the mechanism
SHARE = 0.01  # ... and of the clearance or the depth of a pin with play
RATE = 1e-2  # step of the rates: such a part of a length per second
BALANCED = 1e-6  # generalised force over those that make it, above which a state is not in balance
STANDING = 1e-5  # eigenvalue over the typical one that counts as zero; its square for stiffnesses
LEAST = 1e-6  # part of the clearance below which a depth is none
INSTANT = 1e6  # eigenvalue over the typical one that belongs to a motion without mass and damping


class Linear(NamedTuple):
    """mass x'' + damping x' + stiffness x = 0 of small changes x of the independent coordinates, by `names`.

    motions (bodies, 3, f): d(x, y, angle of a body)/dx, the ground first; scale (f,): changes that move the bodies alike.
    """

    mass: Floats
    damping: Floats
    stiffness: Floats
    names: tuple[str, ...]
    motions: Floats
    scale: Floats


class Modes(NamedTuple):
    """Of the modes, by rising frequency: eigenvalue s [rad/s], |s| / 2 pi [Hz], damping ratio -Re s / |s| (below 0: it grows), and shapes.

    A root without oscillation is a mode of its own with ratio 1 or -1; one that nothing pushes back has frequency and ratio 0.
    coordinates (modes, f) and bodies (modes, bodies, 3: x, y, angle) are complex; the coordinate that moves most, has its `scale`.
    """

    eigenvalues: Complexes
    frequencies: Floats
    ratios: Floats
    coordinates: Complexes
    bodies: Complexes


def linearise(assembly: Assembly, state: Floats | None = None, time: float = 0.0, running: bool = False) -> Linear:
    """`Linear` about a state of balance, by default the equilibrium at `time`.

    The drives are held; `running`, they go on as at `time` and the state keeps its rates (a governor).
    """
    here = _place(assembly, state, time, running)
    now, length = reduced_equations(here), here.system.length
    scale = coordinate_scales(now, length)
    step = _step(here, length)
    stiffness = (4 * scaled_stiffness(here, scale, step / 2) - scaled_stiffness(here, scale, step)) / 3
    _check_balance(here, now, assembly, stiffness, scale, length)
    damping = _scaled_damping(here, scale, length)
    unscaled = np.outer(1 / scale, 1 / scale)
    return Linear(now.mass, damping * unscaled, stiffness * unscaled, coordinate_names(assembly, here.system), now.motions, scale)


def modes(linear: Linear) -> Modes:
    """`Modes` of a linearised system:  (s^2 mass + s damping + stiffness) x = 0."""
    free = len(linear.scale)
    if free == 0:
        return Modes(
            np.zeros(0, complex), np.zeros(0), np.zeros(0), np.zeros((0, 0), complex), np.zeros((0, len(linear.motions), 3), complex)
        )
    both = np.outer(linear.scale, linear.scale)
    (mass, damping, stiffness), speed = _in_own_time(linear.mass * both, linear.damping * both, linear.stiffness * both)
    unit, none = np.eye(free), np.zeros((free, free))
    pairs: Any = scipy.linalg.eig(
        np.block([[none, unit], [-stiffness, -damping]]), np.block([[unit, none], [none, mass]]), homogeneous_eigvals=True
    )  # with homogeneous eigenvalues, which SciPy's types do not know
    (top, bottom), vectors = pairs
    moving = (np.abs(top) < INSTANT * np.abs(bottom)) & (np.abs(top) > STANDING * np.abs(bottom))
    roots, vectors = top[moving] / bottom[moving], vectors[:free, moving]
    once = roots.imag > -1e-9 * np.abs(roots)  # one of each conjugate pair
    still = null_space(stiffness, rcond=STANDING**2 / max(float(np.linalg.norm(stiffness, 2)), STANDING**2))
    roots, vectors = np.append(np.zeros(still.shape[1]), roots[once] * speed), np.hstack([still, vectors[:, once]])
    order = np.argsort(np.abs(roots), kind="stable")
    return _modes(linear, roots[order], vectors[:, order].T)


def _modes(linear, roots, shapes):
    size = np.abs(roots)
    most = np.take_along_axis(shapes, np.argmax(np.abs(shapes), axis=1)[:, None], axis=1)
    coordinates = shapes / most * linear.scale
    ratios = -roots.real / np.where(size > 0, size, 1.0)
    return Modes(roots, size / (2 * np.pi), ratios, coordinates, np.einsum("bcm,km->kbc", linear.motions, coordinates))


def _in_own_time(mass, damping, stiffness):
    """((mass, damping, stiffness) of size 1 and below, in a unit of time of the system's own, and that unit's inverse)."""
    m, c, k = (np.max(np.abs(matrix)) for matrix in (mass, damping, stiffness))
    speed = np.sqrt(k / m) if m and k else k / c if c and k else c / m if c and m else 1.0
    size = max(m * speed**2, c * speed, k)
    return (mass * speed**2 / size, damping * speed / size, stiffness / size), speed


# ------------------------------------------------------------------------------------------------------------- differences


def _place(assembly, state, time, running):
    """The place to linearise about, its coordinates split there."""
    if state is None:
        state = equilibrium(assembly, None, time).state
    here = place_at_rest(assembly, state, time)
    y = np.array(state, float) if running else here.y
    system, y = repartition(assembly.system if running else here.system, time, y)
    y[system.contacts.memory] = LASTING
    return Place(system, motion(system).work, time, y)


def _step(here, length):
    """Step of the scaled coordinates: small beside the mechanism, the clearances of its pins and how deep their walls are pressed."""
    pins = [(contact.clearance, abs(plain(penetration)(here.system, here.work, n))) for n, contact in enumerate(here.system.contacts)]
    return min([STEP * length, *(SHARE * min(clearance, max(depth, LEAST * clearance)) for clearance, depth in pins)])


def _scaled_damping(here, scale, length):
    """-d(force)/d(rates), both scaled, by central differences of the fourth order."""
    speeds = [RATE * length, *(SHARE * contact.slip_speed for contact in here.system.contacts if contact.law), *_pressed_speeds(here)]
    first = len(here.system.stored)

    def force(m, change):
        y = here.y.copy()
        y[first + m] += change * scale[m]
        return reduced_equations(here._replace(y=y)).force * scale

    def slope(m, size):
        return (force(m, -size) - force(m, size)) / (2 * size)

    step = min(speeds)
    columns = [(4 * slope(m, step / 2) - slope(m, step)) / 3 for m in range(len(scale))]
    return np.array(columns).T.reshape(len(scale), len(scale))


def _pressed_speeds(here):
    """Rates so small beside `loading_speed` that pins which are pressed keep touching."""
    system, work = here.system, here.work
    reduced_equations(here)
    for n, contact in enumerate(system.contacts):
        depth, _, mobility, *_ = plain(gap_motion)(system, n, work, LASTING)
        if depth > 0 and mobility > 0:
            yield SHARE * float(plain(loading_speed)(contact, depth, plain(elastic_of)(contact, depth), mobility))


def _check_balance(here, now, assembly, stiffness, scale, length):
    force, whole = forces_at_work(now, stiffness, scale, length)
    part = np.linalg.norm(force) / whole
    if part > BALANCED:
        worst = int(np.argmax(np.abs(force)))
        raise InputError(
            f"linearise: the state is not an equilibrium: at coordinate {coordinate_names(assembly, here.system)[worst]!r} a force of "
            f"{abs(force[worst]):.4g} N is unbalanced, {part:.2g} of the acting forces. Linearise about equilibrium(...).state"
        )
