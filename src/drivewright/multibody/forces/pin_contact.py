"""Kernels: the forces of a pin with play on its two bodies, dry or with a film of oil, at a known state.

States of a contact in y (states,): its memory, the speed of approach [m/s] at the touch, LASTING, or 0 without contact; its bristle [m].
"""

from typing import Any

import numpy as np

from drivewright._jit import inner, per_lane
from drivewright._typing import Floats, Numbers
from drivewright.contact.film import journal_friction, long_bearing, short_bearing
from drivewright.contact.film_table import tabulated_bearing
from drivewright.contact.friction import ambrosio, coulomb, lugre, lugre_rate
from drivewright.contact.impact import cylinder_energy, cylinder_force
from drivewright.contact.normal import PowerLaw, normal_force
from drivewright.contact.wear import wear_at
from drivewright.multibody.forces.contact import AMBROSIO, COULOMB, LONG_FILM, LUGRE, NO_FILM, SHORT_FILM, further_force
from drivewright.multibody.frames import apply_force, apply_torque_pair, relative_motion, rotated
from drivewright.multibody.records import OneRecord, Records
from drivewright.multibody.system import System, Work
from drivewright.numerics.lanes import any_lane, where
from drivewright.numerics.small import ldl_energy

SLOWEST = 1e-4  # approach speed that counts at least, where a law divides by it [m/s]
LASTING = -1.0  # in the memory of a contact that no longer remembers an approach; 0: no contact
THINNEST = 1e-4  # least film thickness over clearance that the film formulas see


@inner
def penetration(system: System, work: Work, n: int) -> float:
    """How deep the journal is in the bearing's wall: |e| - clearance - wear, e from the journal's centre (j) to the bearing's (i)."""
    contact = system.contacts[n]
    one, two = work.poses[contact.i], work.poses[contact.j]
    px, py = rotated(one, contact.ax, contact.ay)
    qx, qy = rotated(two, contact.bx, contact.by)
    dx, dy = one.x + px - two.x - qx, one.y + py - two.y - qy
    distance = np.sqrt(dx * dx + dy * dy)
    worn, _ = wear_depth(system.wear[n], work.poses[contact.i].angle, dx, dy, distance)
    return distance - contact.clearance - worn


@inner
def wear_depth(wear: Floats, turned_by: float, dx: float, dy: float, distance: float) -> tuple[float, float]:
    """(depth [m] worn off the bearing where the journal is, opposite to e = (dx, dy) [m]; its slope by the angle over |e| = distance).

    wear (bins,) [m] is in the bearing's frame, which has turned by an angle [rad]; see `contact.wear.wear_at`.
    The journal is taken to touch where its centre points, so that depth = |e| - clearance - h(angle); the force is that law's gradient,
    which keeps the energy.  It holds while the profile is flat: its slope by the angle well below the clearance.
    """
    if wear.size == 0:
        return 0.0, 0.0
    return _worn_wall(wear, turned_by, dx, dy, distance)


@per_lane
def _worn_wall(wear, turned_by, dx, dy, distance):
    """`wear_depth` of a bearing that is worn. wear (bins,)."""
    if distance == 0.0:  # in the middle there is no side
        return 0.0, 0.0
    depth, slope = wear_at(wear, np.arctan2(-dy, -dx) - turned_by)
    return depth, slope / distance


@inner
def normal_of(contact: OneRecord, depth: float, rate: float, memory: Numbers, mobility: float) -> float:
    """Normal force of a depth > 0 that changes at a rate; a contact never pulls.

    K d^n (1 + h d'/d0') + c d' from the touch at d0' = memory on, K d^n (1 + h_w d'/w) + c d' in a lasting contact, w of
    `loading_speed`; or the cylinder law instead of K d^n.  `contact.impact.lasting_factor` says how h_w goes with h.
    """
    elastic, speed = elastic_of(contact, depth), memory
    if memory < 0.0:
        speed = loading_speed(contact, depth, elastic, mobility)
    if speed > 0.0:
        elastic += elastic * _loss(contact, rate, speed, memory) / speed
    return max(elastic + contact.damping * rate, 0.0)


@inner
def elastic_of(contact: OneRecord, depth: float) -> float:
    """Elastic force of a depth > 0."""
    if contact.cylinder:
        return cylinder_force(
            depth, contact.clearance, contact.bearing_radius, contact.bearing_radius - contact.clearance, contact.stiffness, contact.length
        )
    return normal_force(PowerLaw(contact.stiffness, contact.exponent), -depth, 0.0)


@inner
def loading_speed(contact: OneRecord, depth: float, elastic: float, mobility: float) -> float:
    """w = sqrt(2 E/m): the speed at which a free body touches that comes so deep without loss; mobility = 1/m, 0 if no force moves it."""
    if contact.cylinder:
        energy = cylinder_energy(
            depth,
            elastic,
            contact.clearance,
            contact.bearing_radius,
            contact.bearing_radius - contact.clearance,
            contact.stiffness,
            contact.length,
        )
    else:
        energy = elastic * depth / (contact.exponent + 1.0)
    return np.sqrt(2.0 * energy * mobility) if mobility > 0.0 else 0.0


@inner
def _loss(contact, rate, speed, memory):
    """What the rate adds to the elastic force, times speed over it: h_w d', or h d' from a touch on.

    The laws take d0' for the largest rate: so it is in an impact.  Where a load goes on to press faster than the bodies touched, the
    rate counts as no more than twice d0': as d0' (1 + u/sqrt(1 + u^2)), u = |d'|/d0' - 1, with two continuous derivatives.
    """
    if memory < 0.0:
        return contact.lasting * rate
    over = abs(rate) / speed - 1.0
    if over > 0.0:
        return contact.hysteresis * speed * np.sign(rate) * (1.0 + over / np.sqrt(1.0 + over * over))
    return contact.hysteresis * rate


@inner
def contact_signs(system: System, n: int, work: Work, y: Floats) -> tuple[float, float, float]:
    """(depth, rate d' while the contact remembers its approach, what has the sign of its force before it is kept from pulling).

    Where the second rises through 0 another compression begins; where the third changes sign the force has a kink.  They are 1 where
    there is nothing to watch for.

    y (states,) as in `loads.apply_forces`.
    """
    contact, memory = system.contacts[n], y[system.contacts[n].memory]
    remembers = (memory != 0.0) & ((contact.hysteresis != 0.0) | (contact.damping != 0.0))
    if not any_lane(remembers):
        return penetration(system, work, n), where(remembers, 1.0, 1.0), where(remembers, 1.0, 1.0)
    depth, rate, mobility, _, _, _, _ = gap_motion(system, n, work, memory)
    reversal, hold = _signs_of_rate(contact, depth, rate, mobility, memory)
    return depth, where(remembers, reversal, 1.0), where(remembers, hold, 1.0)


@per_lane
def _signs_of_rate(contact, depth, rate, mobility, memory):
    """The second and the third of `contact_signs` of a contact whose law has a loss."""
    reversal = rate if memory > 0.0 and contact.hysteresis > 0.0 else 1.0
    elastic = elastic_of(contact, max(depth, 0.0))
    if contact.damping > 0.0:
        return reversal, elastic + contact.damping * rate
    speed = loading_speed(contact, max(depth, 0.0), elastic, mobility) if memory < 0.0 else memory
    return reversal, speed + _loss(contact, rate, speed, memory)


@inner
def friction_force(contact: OneRecord, normal: float, slip: float, bristle: Any) -> tuple[float, float]:
    """(friction force against the slip, rate of the bristle)."""
    if normal <= 0.0 or contact.law == 0:
        return 0.0, 0.0
    if contact.law == COULOMB:
        return coulomb(contact.friction, normal, slip, contact.slip_speed), 0.0
    if contact.law == AMBROSIO:
        return ambrosio(contact.friction, normal, slip, contact.dead_speed, contact.slip_speed), 0.0
    rate = lugre_rate(bristle, slip, contact.bristle_stiffness, contact.friction, contact.static_friction, contact.slip_speed)
    return lugre(bristle, rate, slip, normal, contact.bristle_stiffness, contact.bristle_damping, contact.viscous), rate


@inner
def gap_motion(system: System, n: int, work: Work, memory: Numbers) -> tuple[float, float, float, float, float, float, float]:
    """(depth, its rate d', mobility, slip, nx, ny, wear_slope) of a pin with play; n points from the journal to the bearing's centre.

    A worn wall leans: its slope enters the rate.  Slip is the bearing's wall against the journal along t = (-ny, nx).
    The mobility, asked for in lasting contacts alone, is what a unit force along the gap gives to d'':  1/m = b^T M^-1 b with
    b = d(depth)/d(independent coordinates).
    """
    contact = system.contacts[n]
    dx, dy, vx, vy, px, py, qx, qy = relative_motion(work.poses, contact)
    distance = np.sqrt(dx * dx + dy * dy)  # np.hypot takes twice as long, for lengths that no gap has
    worn, wear_slope = wear_depth(system.wear[n], work.poses[contact.i].angle, dx, dy, distance)
    depth = distance - contact.clearance - worn
    is_centred = distance == 0.0  # where any direction is as good
    length = where(is_centred, 1.0, distance)
    nx, ny = where(is_centred, 1.0, dx / length), where(is_centred, 0.0, dy / length)
    # The wall's point is at -R n from the bearing's centre, and at d - R n = -(R - |d|) n from the journal's.
    radius, spin = contact.bearing_radius, work.poses[contact.i].w
    slip = nx * vy - ny * vx - radius * spin + (radius - distance) * work.poses[contact.j].w
    slip = where(is_centred, 0.0, slip)
    rate = where(is_centred, 0.0, nx * vx + ny * vy - wear_slope * (nx * vy - ny * vx - distance * spin))
    mobility, lasts = where(is_centred, 0.0, 0.0), (memory < 0.0) & (depth > 0.0)
    if any_lane(lasts):
        for m in range(work.unit_load.size):
            one, two = work.reduced_partial_velocities[contact.i, m], work.reduced_partial_velocities[contact.j, m]
            ux, uy = one.x - one.t * py - two.x + two.t * qy, one.y + one.t * px - two.y - two.t * qx
            work.unit_load[m] = nx * ux + ny * uy - wear_slope * (nx * uy - ny * ux - distance * one.t)
        mobility = where(lasts, ldl_energy(work.mass, work.unit_load), 0.0)
    return depth, rate, mobility, slip, nx, ny, wear_slope


@inner
def contact_state(system: System, n: int, work: Work, y: Floats) -> tuple[float, float, float, float, float, float, float, float]:
    """(depth, normal, friction, slip, bristle rate, nx, ny, wear_slope) of a pin with play, as in `gap_motion`.

    Contact lies at -R n from the bearing's centre.  Where the wall leans the bearing gets beside -N n also N wear_slope t at the journal's
    centre, through which the normal of a round journal always goes.
    """
    contact, memory = system.contacts[n], y[system.contacts[n].memory]
    depth, rate, mobility, slip, nx, ny, wear_slope = gap_motion(system, n, work, memory)
    normal = rubbing = bristle_rate = where(depth > 0.0, 0.0, 0.0)
    if any_lane((memory != 0.0) & (depth > 0.0)):
        normal, rubbing, bristle_rate = contact_force(system, contact, depth, rate, slip, memory, mobility, y[contact.bristle])
    return depth, normal, rubbing, slip, bristle_rate, nx, ny, wear_slope


@per_lane
def contact_force(
    system: System, contact: OneRecord, depth: float, rate: float, slip: float, memory: Numbers, mobility: float, bristle: Any
) -> tuple[float, float, float]:
    """(normal force [N], friction force [N] against the slip, rate of the bristle [m/s]) at a depth [m] that changes at a rate [m/s]."""
    if memory == 0.0 or depth <= 0.0:
        return 0.0, 0.0, 0.0
    if contact.further > 0:
        normal = max(further_force(system.laws, contact.further, -depth, -rate), 0.0)
    else:
        normal = normal_of(contact, depth, rate, memory, mobility)
    rubbing, bristle_rate = friction_force(contact, normal, slip, bristle)
    return normal, rubbing, bristle_rate


@per_lane
def film_force(contact: OneRecord, poses: Records, films: Floats) -> tuple[float, float, float]:
    """Force (x, y) [N] of the oil on the bearing in the journal's centre, and its drag [N m] on it about that point; all of it fades where
    the walls touch.  films as in `System`."""
    dx, dy, vx, vy, _, _, _, _ = relative_motion(poses, contact)
    distance, clearance = np.hypot(dx, dy), contact.clearance
    excess = (distance - clearance) / contact.roughness
    if excess >= 1.0:
        return 0.0, 0.0, 0.0
    weight = 1.0 if excess <= 0.0 else 1.0 - excess * excess * (3.0 - 2.0 * excess)
    most = clearance - max(contact.roughness, THINNEST * clearance)
    scale = most / distance if distance > most else 1.0
    spin = poses[contact.i].w + poses[contact.j].w
    ex, ey, radius, viscosity, length = -dx * scale, -dy * scale, contact.bearing_radius, contact.viscosity, contact.length
    if contact.film == LONG_FILM:
        fx, fy = long_bearing(ex, ey, -vx, -vy, spin, viscosity, length, radius, clearance)
    elif contact.film == SHORT_FILM:
        fx, fy = short_bearing(ex, ey, -vx, -vy, spin, viscosity, length, radius, clearance)
    else:
        fx, fy = tabulated_bearing(ex, ey, -vx, -vy, spin, viscosity, length, radius, clearance, films[contact.film_table])
    slip = poses[contact.j].w - poses[contact.i].w
    drag = journal_friction(ex, ey, fx, fy, slip, viscosity, length, radius, clearance)
    return -weight * fx, -weight * fy, weight * drag


@inner
def apply_pin_contact(system: System, n: int, work: Work, y: Floats, dy: Floats) -> None:
    """Forces of a pin with play on both bodies, at the point where they touch; the rates of its own states go into dy.

    y, dy (states,) [m, rad, m/s, rad/s; an approach speed in m/s and a bristle in m for every contact].
    """
    contact = system.contacts[n]
    one, two = work.poses[contact.i], work.poses[contact.j]
    _, normal, rubbing, _, bristle_rate, nx, ny, wear_slope = contact_state(system, n, work, y)
    dy[contact.memory] = 0.0
    if contact.law == LUGRE:
        dy[contact.bristle] = bristle_rate
    if any_lane(normal > 0.0):
        # On the bearing: -N n - T t, t = (-ny, nx), at -R n from its centre.
        fx, fy = -normal * nx + rubbing * ny, -normal * ny - rubbing * nx
        px, py = rotated(one, contact.ax, contact.ay)
        px, py = px - contact.bearing_radius * nx, py - contact.bearing_radius * ny
        apply_force(one, px, py, fx, fy)
        apply_force(two, px + one.x - two.x, py + one.y - two.y, -fx, -fy)
        if any_lane(wear_slope != 0.0):
            fx, fy = -normal * wear_slope * ny, normal * wear_slope * nx
            qx, qy = rotated(two, contact.bx, contact.by)
            apply_force(one, qx + two.x - one.x, qy + two.y - one.y, fx, fy)
            apply_force(two, qx, qy, -fx, -fy)
    if contact.film != NO_FILM:
        fx, fy, drag = film_force(contact, work.poses, system.films)
        apply_torque_pair(work.poses, contact, drag)
        qx, qy = rotated(two, contact.bx, contact.by)
        apply_force(one, qx + two.x - one.x, qy + two.y - one.y, fx, fy)
        apply_force(two, qx, qy, -fx, -fy)
