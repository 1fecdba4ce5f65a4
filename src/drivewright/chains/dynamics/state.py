"""The drive as arrays: what the kernels read and write.

Plates lie in rows of `lanes`, a whole number of vectors: behind the N plates comes a copy of the first one, so that a joint finds its
right-hand plate one place further, and dead plates that nothing moves.  What belongs to joint i stands at i + 1, for the same reason.
"""

from typing import NamedTuple

import numpy as np

from drivewright.chains.dynamics.model import Guide
from drivewright.chains.dynamics.roller import RollerTooth

WIDTH = 8  # plates that one vector instruction may hold


class Plates(NamedTuple):
    """Per plate: mass centre, direction (cos, sin), rates at the whole step (predicted), angle, rates at the half step, load, constants.

    `x1` ... are the same memory one plate further.
    """

    x: np.ndarray
    y: np.ndarray
    c: np.ndarray
    s: np.ndarray
    vx: np.ndarray
    vy: np.ndarray
    w: np.ndarray
    x1: np.ndarray
    y1: np.ndarray
    c1: np.ndarray
    s1: np.ndarray
    vx1: np.ndarray
    vy1: np.ndarray
    w1: np.ndarray
    angle: np.ndarray
    hx: np.ndarray
    hy: np.ndarray
    hw: np.ndarray
    fx: np.ndarray
    fy: np.ndarray
    moment: np.ndarray
    half: np.ndarray  # half the hole pitch
    half1: np.ndarray
    by_mass: np.ndarray  # 1/m, 0 for dead plates
    by_inertia: np.ndarray
    gx: np.ndarray  # gravity, 0 for dead plates
    gy: np.ndarray


class Joints(NamedTuple):
    """Per joint: force on the plate ahead (the one behind gets the opposite), where it acts, damping power and its sum.

    `fx_` ... are the same memory one joint earlier.
    """

    fx: np.ndarray
    fy: np.ndarray
    mx: np.ndarray
    my: np.ndarray
    fx_: np.ndarray
    fy_: np.ndarray
    mx_: np.ndarray
    my_: np.ndarray
    power: np.ndarray
    lost: np.ndarray


class Touches(NamedTuple):
    """Per plate: seat angle of its tooth (less psi), forces of the right and left flank (of roller seat and flank), loss power and its sum,
    energy stored, force on the plate, torque on the body."""

    seat: np.ndarray
    right: np.ndarray
    left: np.ndarray
    power: np.ndarray
    lost: np.ndarray
    stored: np.ndarray
    fx: np.ndarray
    fy: np.ndarray
    torque: np.ndarray


class Bodies(NamedTuple):
    """Per sprocket, then per guide: what slides and turns.  Rates at whole steps (predicted) and at half steps; loads; constants."""

    q: np.ndarray
    vq: np.ndarray
    hq: np.ndarray
    psi: np.ndarray
    w: np.ndarray
    hw: np.ndarray
    x: np.ndarray
    y: np.ndarray
    vx: np.ndarray
    vy: np.ndarray
    fx: np.ndarray
    fy: np.ndarray
    torque: np.ndarray
    aq: np.ndarray
    aw: np.ndarray
    x0: np.ndarray
    y0: np.ndarray
    ux: np.ndarray
    uy: np.ndarray
    mass: np.ndarray
    inertia: np.ndarray
    slides: np.ndarray  # bool
    driven: np.ndarray  # bool
    start: np.ndarray
    speed: np.ndarray
    ramp: np.ndarray
    psi0: np.ndarray
    force: np.ndarray
    spring: np.ndarray
    slide_damping: np.ndarray
    load: np.ndarray
    turn_damping: np.ndarray
    stiffness: np.ndarray
    damping: np.ndarray


class Teeth(NamedTuple):
    """Per sprocket: base radius, support, limits of the support for form and tip, tooth angle, reach; then what a roller's tooth needs."""

    base: np.ndarray
    support: np.ndarray
    low: np.ndarray
    high: np.ndarray
    pitch_angle: np.ndarray
    reach: np.ndarray
    rolls: np.ndarray  # bool
    seat_at: np.ndarray
    seat_gap: np.ndarray  # seat less roller radius
    flank_gap: np.ndarray  # flank plus roller radius
    edge_x: np.ndarray  # end of the seat, direction from its centre
    edge_y: np.ndarray
    flank_x: np.ndarray
    flank_y: np.ndarray


class Arcs(NamedTuple):
    """Per guide: radius; distance to the pin line; side (-1 outside, 1 inside); middle of its arc, cosine of half of it; friction, slip."""

    radius: np.ndarray
    distance: np.ndarray
    side: np.ndarray
    middle_x: np.ndarray
    middle_y: np.ndarray
    opening: np.ndarray
    friction: np.ndarray
    slip: np.ndarray


class Runs(NamedTuple):
    """Plates first .. last-1 that may touch a body; `size`[0] of them are in use."""

    body: np.ndarray  # sprockets first, then guides
    first: np.ndarray
    last: np.ndarray
    size: np.ndarray


class Chain(NamedTuple):
    """What all plates share."""

    count: int
    blocks: int
    joint_stiffness: float
    joint_damping: float  # beta k_j
    rolling: float  # 2 r
    offset: float
    cos: float
    sin: float
    flank: float
    deepest: float  # limits of the contact's place along the flank
    highest: float
    half_plate: float
    mass: float
    inertia: float


class Drive(NamedTuple):
    """All arrays of a drive; clock: time [s], steps done; power and its integral, see SUMS."""

    chain: Chain
    plates: Plates
    joints: Joints
    touches: Touches
    bodies: Bodies
    teeth: Teeth
    arcs: Arcs
    runs: Runs
    gravity: np.ndarray
    clock: np.ndarray
    power: np.ndarray
    sums: np.ndarray


SUMS = ("drive", "torque", "slide damping", "turn damping", "friction", "guide damping", "impulse x", "impulse y", "turning impulse")
DRIVE, TORQUE, SLIDE_DAMPING, TURN_DAMPING, FRICTION, GUIDE_DAMPING, IMPULSE_X, IMPULSE_Y, TURNING_IMPULSE = range(len(SUMS))


def lower(model):
    """The `Drive` of a model, its plates not yet placed."""
    chain = _chain(model.chain)
    return Drive(chain, _plates(model, chain), _joints(chain), _touches(chain), _bodies(model), _teeth(model), _arcs(model.guides),
                 _runs(model, chain), np.array(model.gravity, float), np.zeros(2), np.zeros(len(SUMS)), np.zeros(len(SUMS)))


def _chain(chain):
    link = chain.link
    ca, sa = np.cos(link.flank_angle), np.sin(link.flank_angle)
    along = [(link.flank * sa - depth) / ca for depth in (chain.toe, chain.crotch)]
    blocks = chain.count // WIDTH + 1  # one more place than plates at least, for the copy of the first
    return Chain(chain.count, blocks, chain.joint_stiffness, chain.joint_damping * chain.joint_stiffness, 2 * link.radius,
                 chain.centre_offset, ca, sa, link.flank, *along, 0.5 * link.pitch, chain.mass, chain.inertia)


def _lanes(chain):
    return np.zeros(WIDTH * chain.blocks + 1)


def _plates(model, chain):
    moving = [_lanes(chain) for _ in range(7)]
    moving[2][:] = 1.0
    half, rest = _lanes(chain), [_lanes(chain)[:-1] for _ in range(7)]
    half[: chain.count] = 0.5 * model.chain.hole_pitches
    half[chain.count] = half[0]
    live = np.arange(WIDTH * chain.blocks) < chain.count
    constants = (live / model.chain.mass, live / model.chain.inertia, live * model.gravity[0], live * model.gravity[1])
    return Plates(*(a[:-1] for a in moving), *(a[1:] for a in moving), *rest, half[:-1], half[1:], *constants)


def _joints(chain):
    rows = [_lanes(chain) for _ in range(4)]
    return Joints(*(a[1:] for a in rows), *(a[:-1] for a in rows), _lanes(chain)[:-1], _lanes(chain)[:-1])


def _touches(chain):
    return Touches(*(_lanes(chain)[:-1] for _ in Touches._fields))


def _bodies(model):
    every = (*model.sprockets, *model.guides)
    slides = [body.slide for body in every]
    drives = [getattr(body, "drive", None) for body in every]

    def row(values):
        return np.array([float(v) for v in values])

    x0, y0 = row(b.centre[0] for b in every), row(b.centre[1] for b in every)
    psi0 = row(getattr(b, "angle", 0.0) or 0.0 for b in every)
    zeros = [np.zeros(len(every)) for _ in range(15)]
    zeros[3], zeros[6], zeros[7] = psi0.copy(), x0.copy(), y0.copy()
    return Bodies(
        *zeros, x0, y0, row(np.cos(s.direction) if s else 0.0 for s in slides), row(np.sin(s.direction) if s else 0.0 for s in slides),
        row(b.mass if s else 1.0 for b, s in zip(every, slides, strict=True)),
        row(getattr(b, "inertia", 0.0) or 1.0 for b in every), np.array([s is not None for s in slides]),
        np.array([d is not None or isinstance(b, Guide) for b, d in zip(every, drives, strict=True)]),
        row(d.start if d else 0.0 for d in drives), row(d.speed if d else 0.0 for d in drives), row(d.ramp if d else 0.0 for d in drives),
        psi0, row(s.force if s else 0.0 for s in slides), row(s.stiffness if s else 0.0 for s in slides),
        row(s.damping if s else 0.0 for s in slides), row(getattr(b, "torque", 0.0) for b in every),
        row(getattr(b, "damping", 0.0) for b in every), row(b.contact.stiffness for b in every), row(b.contact.damping for b in every))


def _teeth(model):
    rows = [_roller(s, model) if isinstance(s.tooth, RollerTooth) else _involute(s, model) for s in model.sprockets]
    columns = [np.array(column) for column in zip(*rows, strict=True)]
    return Teeth(*columns)


def _involute(sprocket, model):
    """Supports between which the contact radius sqrt(H^2 + rb^2), H < 0, lies between form and tip."""
    tooth, link = sprocket.tooth, model.chain.link
    low, high = (-np.sqrt(max(radius**2 - tooth.base_radius**2, 0.0)) for radius in (sprocket.tip_radius, sprocket.form_radius))
    t = np.pi / tooth.teeth
    reach = (0.5 * link.hole_pitch * np.cos(t) - link.radius) / np.sin(t) + link.pitch
    return (tooth.base_radius, tooth.support, low, high, 2 * t, reach, False, *[0.0] * 7)


def _roller(sprocket, model):
    tooth = sprocket.tooth
    edge = 0.5 * tooth.seat_angle
    reach = tooth.pitch_radius + model.chain.link.pitch
    return (0.0, 0.0, sprocket.tip_radius, 0.0, 2 * np.pi / tooth.teeth, reach, True, tooth.pitch_radius,
            tooth.seat_radius - tooth.roller_radius, tooth.flank_radius + tooth.roller_radius, np.sin(edge), -np.cos(edge),
            *tooth.flank_centre)


def _arcs(guides):
    middle = np.array([0.5 * (g.start + g.end) for g in guides])
    side = np.array([1.0 if g.side == "inside" else -1.0 for g in guides])
    radius, distance = np.array([float(g.radius) for g in guides]), np.array([float(g.distance) for g in guides])
    return Arcs(radius, distance, side, np.cos(middle), np.sin(middle),
                np.cos([0.5 * (g.end - g.start) for g in guides]), np.array([g.friction for g in guides], float),
                np.array([g.slip for g in guides], float))


def _runs(model, chain):
    room = (len(model.sprockets) + len(model.guides)) * chain.count
    return Runs(*(np.zeros(room, np.int64) for _ in range(3)), np.zeros(1, np.int64))
