"""Forces of joints and teeth of a chain drive, once more from the geometry: complex numbers, all plates at once, virtual work.

For a solver that knows neither rolling joints nor teeth; nothing of the kernels of `drivewright.chains` is used.  A place is x + iy, a
force fx + i fy, a velocity likewise.  Numbers of the sprockets are arrays, from which the plates that may touch take theirs.
"""

from typing import NamedTuple

import numpy as np

from drivewright._typing import Complexes, Floats, Ints
from drivewright.chains.model import LINEAR, ChainDrive
from drivewright.chains.roller_tooth import RollerTooth


class Plates(NamedTuple):
    """Mass centres (N,) [m], directions exp(i angle), their velocities [m/s] and the angular ones [rad/s]."""

    place: Complexes
    direction: Complexes
    velocity: Complexes
    spin: Floats


class Wheels(NamedTuple):
    """All sprockets as they are now: centres [m] and their velocities, angles and speeds, (sprockets,) each."""

    centre: Complexes
    velocity: Complexes
    angle: Floats
    spin: Floats


class Pressed(NamedTuple):
    """Contacts of plates: the force on each [N] and where it acts [m]."""

    force: Complexes
    place: Complexes


def unknown(model: ChainDrive) -> str:
    """What of a drive has no counterpart here; empty where nothing is missing."""
    if model.guides:
        return "guides"
    if any(sprocket.contact.law != LINEAR for sprocket in model.sprockets):
        return "a contact law that is not linear"
    if any(sprocket.drive and (sprocket.drive.ramp or sprocket.slide) for sprocket in model.sprockets):
        return "a driver that changes its speed or slides"
    return ""


def plates_of(poses: Floats, rates: Floats) -> Plates:
    """`Plates` from x, y and angle of their mass centres, row by row (N, 3), and the rates of these."""
    return Plates(poses[:, 0] + 1j * poses[:, 1], np.exp(1j * poses[:, 2]), rates[:, 0] + 1j * rates[:, 1], rates[:, 2])


def dot(a: Complexes, b: Complexes) -> Floats:
    """Scalar product of two vectors."""
    return a.real * b.real + a.imag * b.imag


def cross(a: Complexes, b: Complexes) -> Floats:
    """Vector product of two vectors, across the plane."""
    return a.real * b.imag - a.imag * b.real


class RollingJoints:
    """The joints: energy k |d|^2/2 of the stretch d = P - Q - 2 r u of a pin P and the next plate's Q, u the mean of both directions.

    The generalised forces are those of virtual work, -B^T (k d + c B q'), with B q' the rate of d in a frame that turns with the mean of
    both plates: so damping resists no turning of the whole.
    """

    def __init__(self, model: ChainDrive) -> None:
        chain = model.chain
        self.stiffness, self.damping = chain.joint_stiffness, chain.joint_damping * chain.joint_stiffness
        self.radius = chain.link.radius
        half, plates = 0.5 * chain.hole_pitches, np.arange(chain.count)
        self.next, self.previous = (plates + 1) % chain.count, plates - 1
        self.right, self.left = half - 1j * chain.centre_offset, -half - 1j * chain.centre_offset

    def forces(self, plates: Plates) -> tuple[Complexes, Complexes, Complexes, Complexes, Complexes]:
        """(k d [N], c d' [N], mean direction, B of the angle of the plate before and of the one after) of the joint behind every plate."""
        place, u, velocity, spin = plates
        mean = u + u[self.next]
        mean /= np.abs(mean)
        right, left = self.right * u, (self.left * u)[self.next]
        d = place + right - place[self.next] - left - 2 * self.radius * mean
        common = 1j * (self.radius * mean + 0.5 * d)
        before, after = 1j * right - common, -1j * left - common
        rate = velocity - velocity[self.next] + before * spin + after * spin[self.next]
        return self.stiffness * d, self.damping * rate, mean, before, after

    def tension(self, plates: Plates) -> Floats:
        """Force of every joint along its mean direction, positive where it pulls on the chain (N,)  [N]."""
        spring, damper, mean, _, _ = self.forces(plates)
        return -dot(spring + damper, mean)

    def add(self, plates: Plates, load: Floats, springs: bool = True) -> None:
        """Add the generalised forces (N, 3) [N], [N m] to `load`: of springs and dampers, or of the dampers alone."""
        spring, damper, _, before, after = self.forces(plates)
        force = spring + damper if springs else damper
        total = force[self.previous] - force
        load[:, 0] += total.real
        load[:, 1] += total.imag
        load[:, 2] -= dot(before, force) + dot(after, force)[self.previous]


class Laws:
    """Linear contacts: stiffness [N/m] and damping [N s/m] of every sprocket's."""

    def __init__(self, model: ChainDrive) -> None:
        self.stiffness = np.array([sprocket.contact.stiffness for sprocket in model.sprockets])
        self.damping = np.array([sprocket.contact.damping for sprocket in model.sprockets])

    def force(self, wheel: Ints, depth: Floats, rate: Floats) -> Floats:
        """k d + c d' where d > 0, never below 0  [N]."""
        return np.where(depth > 0.0, np.maximum(self.stiffness[wheel] * depth + self.damping[wheel] * rate, 0.0), 0.0)


class RollerTeeth:
    """Rollers of radius r on the right-hand pins, in spaces of a sprocket: a seat of radius ri with its bottom at R - r, then flanks re."""

    def __init__(self, model: ChainDrive) -> None:
        chain, self.laws = model.chain, Laws(model)
        teeth, pitch_radius, seat, angle, flank, roller = np.array([sprocket.tooth for sprocket in model.sprockets]).T
        self.pin = 0.5 * chain.hole_pitches - 1j * chain.centre_offset
        self.seat, self.flank, self.roller, self.space = seat, flank, roller, 2 * np.pi / teeth
        self.seat_centre = pitch_radius - roller + seat
        self.end = np.exp(0.5j * (angle - np.pi))  # of the seat, from its centre, with the space upright
        self.flank_centre = (seat + flank) * self.end  # from that of the seat
        self.tip = np.array([sprocket.tip_radius for sprocket in model.sprockets])
        self.reach = pitch_radius + chain.link.pitch

    def touch(self, plates: Plates, wheels: Wheels, number: Ints, wheel: Ints) -> tuple[Pressed, ...]:
        """Contacts of the plates `number` with the sprockets `wheel`."""
        space, roller = self.space[wheel], self.roller[wheel]
        arm = self.pin[number] * plates.direction[number]
        pin = plates.place[number] + arm
        off = pin - wheels.centre[wheel]
        polar = np.angle(off * np.exp(-1j * wheels.angle)[wheel])  # as the sprocket sees it
        up = np.exp(1j * ((np.floor(polar / space) + 0.5) * space - 0.5 * np.pi + wheels.angle[wheel]))
        out = off * np.conj(up)  # the space upright
        mirror = np.where(out.real < 0.0, -1.0, 1.0)
        e = mirror * out.real + 1j * (out.imag - self.seat_centre[wheel])  # from the seat's centre, in the right half of the space
        in_seat = cross(self.end[wheel], e) <= 0.0  # below the ray to the seat's end
        to_flank = self.flank_centre[wheel] - e
        length, beside = np.abs(e), np.abs(to_flank)
        depth = np.where(in_seat, length - (self.seat[wheel] - roller), self.flank[wheel] + roller - beside)
        inward = np.where(in_seat, e / np.maximum(length, 1e-12), to_flank / beside)  # into the tooth
        inward = (mirror * inward.real + 1j * inward.imag) * up
        speed = plates.velocity[number] + 1j * plates.spin[number] * arm - wheels.velocity[wheel] - 1j * wheels.spin[wheel] * off
        force = np.where(out.imag < self.tip[wheel], self.laws.force(wheel, depth, dot(inward, speed)), 0.0)
        return (Pressed(-force * inward, pin),)


class InvoluteTeeth:
    """Straight flanks on involutes: plate flanks with the normals exp(-+i a) at the distance w from the origin of the pins.

    The normal to an involute touches its base circle, so the distance p of its tangent from the centre grows by dp = rb dg as the normal
    turns by dg, and the point of contact lies at p n + i rb n.  Of the seated plate p = H.
    """

    def __init__(self, model: ChainDrive) -> None:
        chain, link, self.laws = model.chain, model.chain.link, Laws(model)
        teeth, self.base, self.seated = np.array([sprocket.tooth for sprocket in model.sprockets]).T
        self.offset, self.normal, self.support = chain.centre_offset, np.exp(-1j * link.flank_angle), link.flank_support
        self.form, self.tip = np.array([(sprocket.form_radius, sprocket.tip_radius) for sprocket in model.sprockets]).T
        self.lowest, self.highest = -chain.toe, -chain.crotch
        self.space, t = 2 * np.pi / teeth, np.pi / teeth
        self.reach = (0.5 * link.hole_pitch * np.cos(t) - link.radius) / np.sin(t) + link.pitch

    def touch(self, plates: Plates, wheels: Wheels, number: Ints, wheel: Ints) -> tuple[Pressed, ...]:
        """Contacts of the plates `number` with the sprockets `wheel`: right flanks, left ones."""
        u, angle, space = plates.direction[number], wheels.angle[wheel], self.space[wheel]
        off = plates.place[number] - wheels.centre[wheel]
        tooth = np.round((np.angle(off) - angle) / space) * space
        turned = np.angle(1j * u * np.exp(-1j * (angle + tooth)))  # of the plate against its seat
        pins = off / u - 1j * self.offset
        carried = plates.velocity[number] - wheels.velocity[wheel] - 1j * plates.spin[number] * off
        spin = plates.spin[number] - wheels.spin[wheel]
        found = []
        for side in (1.0, -1.0):
            seen = pins if side > 0 else -np.conj(pins)  # a mirror makes the left flank a right one
            tangent = self.seated[wheel] + side * self.base[wheel] * turned  # of the tooth
            contact = (tangent + 1j * self.base[wheel]) * self.normal  # from the centre
            height, radius = (contact - seen).imag, np.abs(contact)
            active = (tangent < 0.0) & (self.form[wheel] < radius) & (radius < self.tip[wheel])
            active &= (self.lowest < height) & (height < self.highest)
            inward = (self.normal if side > 0 else -np.conj(self.normal)) * u
            arm = (contact if side > 0 else -np.conj(contact)) * u
            depth = dot(self.normal, seen) + self.support - tangent
            force = self.laws.force(wheel, depth, dot(inward, carried + 1j * spin * arm))
            found.append(Pressed(-np.where(active, force, 0.0) * inward, wheels.centre[wheel] + arm))
        return tuple(found)


class ToothContacts:
    """Teeth of all sprockets against all plates; of the sprockets only the nearest counts for a plate."""

    def __init__(self, model: ChainDrive) -> None:
        rolls = isinstance(model.sprockets[0].tooth, RollerTooth)
        self.teeth = RollerTeeth(model) if rolls else InvoluteTeeth(model)

    def add(self, plates: Plates, wheels: Wheels, load: Floats) -> tuple[Complexes, Floats]:
        """Add the generalised forces (N, 3) [N], [N m] to `load`; (force [N], moment about the centre [N m]) on every sprocket."""
        spare = np.abs(plates.place - wheels.centre[:, None]) - self.teeth.reach[:, None]
        number = np.flatnonzero(spare.min(axis=0) < 0.0)
        wheel = spare.argmin(axis=0)[number]
        force, moment = np.zeros(len(wheels.centre), complex), np.zeros(len(wheels.centre))
        for at in self.teeth.touch(plates, wheels, number, wheel):
            load[number, 0] += at.force.real
            load[number, 1] += at.force.imag
            load[number, 2] += cross(at.place - plates.place[number], at.force)
            turning = cross(at.place - wheels.centre[wheel], at.force)
            for n in range(len(force)):
                own = wheel == n
                force[n] -= at.force[own].sum()
                moment[n] -= turning[own].sum()
        return force, moment
