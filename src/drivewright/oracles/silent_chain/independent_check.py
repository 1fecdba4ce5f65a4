"""The chain drive once more: printed formulas in 40 digits, points of the teeth, the largest centre distance, rest, other integrators,
and the running chain in Exudyn.

Rows are tuples (name, ours, other, unit, allowed difference, route) in SI.
"""

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from drivewright._typing import Floats
from drivewright.chains.closure import States
from drivewright.chains.explicit.assembly import start
from drivewright.chains.explicit.signals import tensioners
from drivewright.chains.explicit.simulate import Settings, simulate, tooth_time
from drivewright.chains.explicit.stability import largest_step
from drivewright.chains.implicit import simulate as implicit
from drivewright.chains.implicit.equilibrium import compliance_of, stiffened
from drivewright.chains.link import Link, seat_support
from drivewright.chains.model import Slide, with_sprocket
from drivewright.chains.path.route import short_name
from drivewright.mechanisms.silent_chain.build import SIDES, ChainModel
from drivewright.mechanisms.silent_chain.chain_drive import chain_drive
from drivewright.oracles.silent_chain import exudyn_rows
from drivewright.registry import LeftOut, Row
from drivewright.result import Result

DIGITS = 40
PRINTED = "equations as printed, {}"
POINTS, DENSE = 40001, "dense points of the involute against the seated flank"
LARGEST = "largest centre distance of the loop, by SciPy's SLSQP"
REST = "equilibrium with elastic joints and teeth, extrapolated to rigid ones"
HERTZ = "pressure integrated over the contact, Boussinesq and Flamant"
ALPHA = "implicit steps, generalised alpha"
STIFFER, POSITIONS = 50.0, 12
NODES = 400
STEP = 2e-7  # [s], or less, of both integrators
SHARE = 0.5  # of a tooth, over which they run side by side: contacts make neighbouring motions part


def verify(model: ChainModel, result: Result[Any]) -> Iterator[Row | LeftOut]:
    """All rows; of a running chain that Exudyn does not know, or without Exudyn, what is left out."""
    if model.sides:
        yield from _meshing(model, result)
        for number, side in enumerate(SIDES):
            yield from _tangency(model, result, side, number)
    if "centre_distance" in result.tables:
        yield from _loop(model, result)
        yield from _rest(model, result)
    if "pin.contact_pressure" in result.values:
        yield from _pressure(model, result)
    if "dynamics.energy_drift" in result.values:
        pivots = any(entry.pivot for entry in (*model.spec.sprockets, *model.spec.guides))
        yield from (
            [LeftOut("the running chain by implicit steps", "implicit integration does not support pivots")] if pivots else _running(model)
        )
        yield from exudyn_rows.rows(model)


# -- the published method ------------------------------------------------------------------------------------------------------


def _numbers() -> tuple[Callable[[Any], Any], Callable[[Any], Any], Callable[[Any], Any], Any, str]:
    """(number from a float, sin, cos, pi, how exact): 40 digits where mpmath is installed, else those of long doubles."""
    try:
        import mpmath
    except ImportError:
        return np.longdouble, np.sin, np.cos, np.longdouble("3.14159265358979323846264338328"), "in long doubles"
    context = mpmath.mp.clone()
    context.dps = DIGITS
    return context.mpf, context.sin, context.cos, context.pi, f"in {DIGITS} digits"


def _meshing(model, result):
    """Equations (1), (5) to (7), (9) to (11), (16) as they stand; the offset from the deviations, which are linear in it."""
    exact, sin, cos, pi, how = _numbers()
    spec, route = model.spec, PRINTED.format(how)
    p, r, alpha = (exact(float(value)) for value in (spec.pitch, model.link.radius, spec.plate.flank_angle))
    hole, f = p + 2 * r, exact(float(model.standard_apothem))
    half = [pi / z for z in model.teeth]
    ideal = [p / cos(t) if spec.meshing.ideal == "seat" else p * sin(t) / cos(t) / t for t in half]
    e = _offset(spec.joint.offset, hole, r, half, ideal, sin, cos)
    p2, a2 = (exact(float(value)) for value in model.cutter)
    yield "hole_pitch", result["hole_pitch"], float(hole), "m", 1e-12 * spec.pitch, route
    yield "pin_offset", result["pin_offset"], float(e), "m", 1e-12 * spec.pitch, route
    for side, t, wanted, z in zip(SIDES, half, ideal, model.teeth, strict=True):
        seated = hole - 2 * (r - e * sin(t)) / cos(t)
        fp = f + (p - seated) * cos(alpha) / 2
        cot, cot2 = cos(t) / sin(t), cos(a2) / sin(a2)
        base = p2 * z / pi * cos(a2)
        fa = base / 2 * (alpha - a2) + seated / 2 * (cos(alpha) - sin(alpha) * cot - cos(a2) + sin(a2) * cot) + fp
        x = -exact(z) / 2 + 3 * pi / 4 * cot2 - pi * fa / sin(a2) / p2 - pi * seated / (2 * p2) * cot2 + pi * seated / (2 * p2) * cot
        for name, value in (
            ("seated_pitch", seated),
            ("ideal_pitch", wanted),
            ("pitch_deviation", seated - wanted),
            ("seated_apothem", fp),
            ("positioning_diameter", seated / sin(t)),
        ):
            yield f"{name}.{side}", result[f"{name}.{side}"], float(value), "m", 1e-12 * spec.pitch, route
        yield f"modification.{side}", result[f"modification.{side}"], float(x), "-", 1e-11, route


def _offset(given, hole, r, half, ideal, sin, cos):
    """The offset e as given, or the one that leaves no deviation on the driver, or opposite ones on both."""
    if not isinstance(given, str):
        return type(hole)(float(given))
    left = [hole - 2 * r / cos(t) - wanted for t, wanted in zip(half, ideal, strict=True)]
    slope = [2 * sin(t) / cos(t) for t in half]
    return -left[0] / slope[0] if given == "match-drive" else -sum(left) / sum(slope)


def _tangency(model, result, side, number):
    """Points of the tooth that the cutter leaves, next to a seated plate: where they come nearest to its flank, and how near.

    Half the angle of a tooth on the base circle is (pi/2 + 2 x tan a2)/z + tan a2 - a2; the pin line from two plates that meet at 2 t.
    """
    link, cutter, z = model.link, model.cutter, model.teeth[number]
    base, turn = 0.5 * cutter.module * z * np.cos(cutter.half_angle), np.exp(-2j * np.pi / z)
    joint = 2 * link.radius * np.exp(-1j * np.pi / z)
    height = ((joint - 0.5 * link.hole_pitch * (1 + turn)) / (1j * (1 - turn))).real
    tan2 = np.tan(cutter.half_angle)
    filled = (0.5 * np.pi + 2 * result[f"modification.{side}"] * tan2) / z + tan2 - cutter.half_angle
    roll = np.linspace(0.0, 2.3 * model.sides[number].tooth.curvature_radius / base, POINTS)
    polar = 0.5 * np.pi - 2 * np.pi / z + filled - (roll - np.arctan(roll))
    points = base * np.hypot(1.0, roll) * np.exp(1j * polar)
    normal = np.exp(-1j * link.flank_angle)
    gap = (np.conj(normal) * (points - 1j * height)).real - link.flank_support
    nearest = int(np.argmin(gap))
    meant = model.sides[number].tooth.support - seat_support(link, z)
    yield f"gap of a seated plate.{side}", float(meant), float(gap[nearest]), "m", 1e-9, DENSE
    yield f"contact_radius.{side}", result[f"contact_radius.{side}"], float(abs(points[nearest])), "m", 4e-4 * model.spec.pitch, DENSE


# -- the closed loop -----------------------------------------------------------------------------------------------------------


def _loop(model, result):
    """The farthest that the seated plates let the driven sprocket go, every free plate with a direction of its own."""
    from scipy.optimize import minimize

    closure = model.closure
    sample = len(closure.driver_angle) // 3
    state = States(*(column[sample] for column in closure.states))
    ours = float(result.tables["centre_distance"]["centre_distance"].data[sample])
    loop = Loop(model.worn, model.teeth, state, closure.drive.strands == "equilibrium")
    first = loop.first()
    downhill = np.where(np.arange(len(first)) == 1, -1.0, 0.0)
    best = minimize(
        lambda x: -x[1],
        first,
        jac=lambda x: downhill,
        constraints={"type": "eq", "fun": loop.misses},
        method="SLSQP",
        options={"ftol": 1e-12, "maxiter": 500},
    )
    where = f"at {np.degrees(state.driver_angle):.4g} deg of the driver"
    yield f"centre distance {where}", ours, float(best.x[1] * loop.pitch), "m", 1e-7 * model.spec.pitch, LARGEST
    yield f"driven angle {where}", float(state.driven_angle), float(best.x[0]), "rad", 1e-6, LARGEST


class Loop:
    """Both strands between plates seated as in one of the `States`; unknown are the driven angle, the centre distance in pitches, and the
    direction of every free plate, or of the whole strand where strands are straight."""

    def __init__(self, link: Link, teeth: tuple[int, int], state: States, bent: bool) -> None:
        self.link, self.pitch, self.teeth, self.state, self.bent = link, link.pitch, teeth, state, bent
        self.counts = (1, 1)

    def first(self) -> Floats:
        """A belt around the pitch circles, strands straight."""
        radii = [0.5 / np.sin(np.pi / z) for z in self.teeth]
        distance = float(self.state.centre_distance) / self.pitch
        rise = np.arcsin((radii[1] - radii[0]) / distance)
        x = np.array([float(self.state.driven_angle), distance])
        up, down = (meet - leave for leave, meet in self.ends(x))
        upper, lower = (int(round(abs(strand) + 2 * self.link.radius / self.pitch)) for strand in (up, down))
        self.counts = upper, lower
        copies = self.counts if self.bent else (1, 1)
        return np.concatenate([x, np.full(copies[0], rise), np.full(copies[1], -np.pi - rise)])

    def seats(self, driven: float) -> tuple[float, float, float, float]:
        """Polar angles of the four seated plates next to the strands."""
        phi, (off_1, on_2, off_2, on_1) = 2 * np.pi / np.array(self.teeth), self.state.seats
        own = self.state.driver_angle
        return own + off_1 * phi[0], driven + on_2 * phi[1], driven + off_2 * phi[1], own + on_1 * phi[0] - 2 * np.pi

    def ends(self, x: Floats) -> tuple[tuple[complex, complex], tuple[complex, complex]]:
        """((start, end), (start, end)) of the upper and of the lower strand [pitches]: last pin seated, first pin seated again."""
        places = []
        for number, (seat, side) in enumerate(zip(self.seats(x[0]), (-0.5, 0.5, -0.5, 0.5), strict=True)):
            driven = number in (1, 2)
            middle = self.seat(self.teeth[driven])
            places.append((middle + 1j * side * self.link.hole_pitch) / self.pitch * np.exp(1j * seat) + (x[1] if driven else 0.0))
        return (places[0], places[1]), (places[2], places[3])

    def seat(self, teeth: int) -> complex:
        """Middle of a seated plate's pins from the sprocket's centre, outward and against the running direction [m]: the centre about which
        a plate turned by a tooth meets the joint of the plate before it."""
        half, turn = 0.5 * self.link.hole_pitch, np.exp(-2j * np.pi / teeth)
        joint = 2 * self.link.radius * np.exp(-2j * np.pi / teeth * (1 - self.link.first_share))
        centre = (half + turn * half - joint) / (1 - turn)
        return complex(1j * centre)

    def misses(self, x: Floats) -> Floats:
        """By how much both strands miss their ends (4,)."""
        upper, lower = self.counts if self.bent else (1, 1)
        free = np.split(x[2:], [upper])
        quarter, components = 0.5 * np.pi, []
        seats = self.seats(x[0])
        for strand, (leave, meet), count, first, last in zip(free, self.ends(x), self.counts, seats[::2], seats[1::2], strict=True):
            directions = np.concatenate([[first - quarter], np.broadcast_to(strand, count), [last - quarter]])
            plates = self.link.hole_pitch * np.exp(1j * directions[1:-1]).sum()
            share = self.link.first_share
            joints = 2 * self.link.radius * np.exp(1j * (share * directions[:-1] + (1 - share) * directions[1:])).sum()
            miss = leave + (plates - joints) / self.pitch - meet
            components += [miss.real, miss.imag]
        return np.array(components)


def _rest(model, result):
    """Mean centre distance of rigid plates as the limit of stiff ones at rest, which find their seats by contact alone."""
    spec = model.spec
    odd = model.link.skew or model.elongation or spec.dynamics.thickness_deviation or spec.guides or spec.sprockets or spec.roller
    if not spec.drive or odd or spec.closure.strands != "equilibrium" or spec.meshing.apothem_reference == "pin":
        return
    system = replace(chain_drive(model), gravity=(0.0, 0.0))
    system = with_sprocket(system, 1, torque=0.0, centre=(model.closure.mean, 0.0), mass=1.0, slide=Slide(0.0, spec.drive.preload))
    equilibrium = compliance_of(stiffened(system, STIFFER), POSITIONS)
    yield "centre_distance.mean", result["centre_distance.mean"], equilibrium.rigid_mean, "m", 1e-6, REST


# -- pins ----------------------------------------------------------------------------------------------------------------------


def _pressure(model, result):
    """Force, radius and shear that the pressure p0 sqrt(1 - (x/b)^2) belongs to, by Gauss and Chebyshev's rule over the contact."""
    material = model.spec.material
    peak, b = result["pin.contact_pressure"], result["pin.half_width"]
    at = np.pi * np.arange(1, NODES + 1) / (NODES + 1)
    x, weight = np.cos(at), np.pi / (NODES + 1) * np.sin(at) ** 2  # sum of weight f(x) = integral of sqrt(1 - x^2) f(x)
    yield "pin.force", result["pin.force"], float(peak * b * model.contact_length * weight.sum()), "N", 1e-9 * result["pin.force"], HERTZ
    between = np.cos(np.pi * (2 * np.arange(1, NODES + 2) - 1) / (2 * (NODES + 1)))[NODES // 4]
    modulus = 0.5 * material.youngs_modulus / (1 - material.poisson_ratio**2)
    slope = 2 * peak / (np.pi * modulus) * np.sum(weight / (between - x))  # of the surfaces that the pressure flattens: x b/R
    radius = 2 * model.link.effective_radius
    yield "rolling radius of the pins", radius, float(2 * between * b / slope), "m", 1e-9 * radius, HERTZ
    z = result["pin.shear_depth"] / b
    across = -2 * z / np.pi * np.sum(weight * x**2 / (x**2 + z**2) ** 2)
    down = -2 * z**3 / np.pi * np.sum(weight / (x**2 + z**2) ** 2)
    yield "pin.max_shear", result["pin.max_shear"], float(0.5 * peak * abs(across - down)), "Pa", 1e-6 * peak, HERTZ


# -- the running chain ---------------------------------------------------------------------------------------------------------


def _running(model):
    """The same start by both integrators: where the driven sprocket is after a part of a tooth."""
    system = chain_drive(model)
    step, time = min(STEP, 0.5 * largest_step(system)), SHARE * tooth_time(system)
    begin = start(system)
    ours = simulate(system, time, Settings(step, run_in=0.0), begin=begin)
    other = implicit.simulate(system, time, implicit.Settings(step, rho=1.0), begin=begin)
    after = f"after {SHARE:g} tooth"
    if system.sprockets[1].slide:
        a, b = (motion.body(1, "q") for motion in (ours, other))
        yield f"slide {after}", float(a[-1]), float(b[-1]), "m", 1e-3 * float(np.ptp(a)), ALPHA
    for number in tensioners(system):
        a, b = (motion.body(number, "q") for motion in (ours, other))
        name = f"travel of tensioner {short_name(system, number)} {after}"
        yield name, float(a[-1]), float(b[-1]), "m", 1e-2 * float(np.ptp(a)), ALPHA
    a, b = (motion.transmission_error(1) for motion in (ours, other))
    yield f"transmission error {after}", float(a[-1]), float(b[-1]), "rad", 1e-2 * float(np.ptp(a)), ALPHA
    a, b = (motion.tension[-1, 0] for motion in (ours, other))
    yield f"tension {after}", float(a), float(b), "N", 1e-2 * float(np.abs(ours.tension).max()), ALPHA
