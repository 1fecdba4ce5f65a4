"""The drive as arrays: what the kernels read and write.

Plates lie in rows of `lanes`, a whole number of vectors: behind the N plates comes a copy of the first one, so that a joint finds its
right-hand plate one place further, and dead plates that nothing moves, a vector of them more than joints need: runs of plates are read in
whole vectors from any plate on.  What belongs to joint i stands at i + 1, for the same reason.
"""

from typing import Any, NamedTuple

import numpy as np

from drivewright._jit import by_reference, generic, implements
from drivewright._typing import Bools, Floats, Ints, Records
from drivewright.chains.model import LINEAR, ChainDrive, Guide
from drivewright.chains.roller_tooth import RollerTooth
from drivewright.contact.laws import ContactParameters, contact_law
from drivewright.contact.normal import KelvinVoigt, stored_energy
from drivewright.errors import InputError

PLATES_PER_VECTOR = 8  # as many as one vector instruction may hold; loops over plates run over a whole number of these


@by_reference
class Plates(NamedTuple):
    """Per plate: mass centre, direction (cos, sin), rates at the whole step, angle, rates at the half step, load, constants.

    Rates at the whole step are predicted while loads are found, then the mean of the half steps on both sides; loads become accelerations.

    `x1` ... are the same memory one plate further.
    """

    x: Floats
    y: Floats
    c: Floats
    s: Floats
    vx: Floats
    vy: Floats
    w: Floats
    x1: Floats
    y1: Floats
    c1: Floats
    s1: Floats
    vx1: Floats
    vy1: Floats
    w1: Floats
    angle: Floats
    hx: Floats
    hy: Floats
    hw: Floats
    fx: Floats
    fy: Floats
    moment: Floats
    half: Floats  # half the hole pitch
    half1: Floats
    by_mass: Floats  # 1/m, 0 for dead plates
    by_inertia: Floats
    gx: Floats  # weight, 0 for dead plates
    gy: Floats


@by_reference
class Joints(NamedTuple):
    """Per joint: force on the plate ahead (the one behind gets the opposite), where it acts, torque of its articulation, rate of stretch,
    damping power and its sum.

    `fx_` ... are the same memory one joint earlier.
    """

    fx: Floats
    fy: Floats
    mx: Floats
    my: Floats
    turn: Floats
    fx_: Floats
    fy_: Floats
    mx_: Floats
    my_: Floats
    turn_: Floats
    rx: Floats
    ry: Floats
    power: Floats
    lost: Floats


@by_reference
class Touches(NamedTuple):
    """Per plate: seat angle of its tooth (less psi) with cosine and sine, forces of the right and left flank (of roller seat and flank) and
    what of them is damping, loss power and its sum, energy stored, force on the plate, torque on the body, power that a guide's damping and
    friction take."""

    seat: Floats
    seat_cos: Floats
    seat_sin: Floats
    right: Floats
    left: Floats
    damped_right: Floats
    damped_left: Floats
    power: Floats
    lost: Floats
    stored: Floats
    fx: Floats
    fy: Floats
    torque: Floats
    guide_damped: Floats
    guide_rubbed: Floats


BODIES = np.dtype(
    [
        (name, float)
        for name in (
            "q",
            "vq",
            "hq",
            "psi",
            "w",
            "hw",
            "x",
            "y",
            "vx",
            "vy",
            "fx",
            "fy",
            "torque",
            "aq",
            "aw",
            "x0",
            "y0",
            "ux",
            "uy",
            "px",
            "py",
            "lever",
            "swing",
            "weight",
            "mass",
            "inertia",
            "start",
            "speed",
            "ramp",
            "psi0",
            "force",
            "spring",
            "slide_damping",
            "load",
            "turn_damping",
            "stiffness",
            "damping",
        )
    ]
    + [("slides", bool), ("driven", bool)],
    align=True,
)
"""Per sprocket, then per guide: what slides and turns.  Rates at whole steps and (hq, hw) at half steps; loads; constants.

(ux, uy): how the centre moves with q, which a pivot (px, py) with its lever changes; swing: 1/lever of a guide, which turns about it too.

Records, as of guides: a tuple of so many arrays takes long to compile.
"""


@by_reference
class Teeth(NamedTuple):
    """Per sprocket: base radius, support, limits of the support for form and tip, tooth angle, reach; then what a roller's tooth needs."""

    base: Floats
    support: Floats
    low: Floats
    high: Floats
    pitch_angle: Floats
    reach: Floats
    rolls: Bools
    seat_at: Floats
    seat_gap: Floats  # seat less roller radius
    flank_gap: Floats  # flank plus roller radius
    edge_x: Floats  # end of the seat, direction from its centre
    edge_y: Floats
    flank_x: Floats
    flank_y: Floats


ARCS = np.dtype([(name, float) for name in ("radius", "distance", "side", "middle_x", "middle_y", "opening", "friction", "slip")])
"""Per guide: radius; distance to the pin line; side (-1 outside, 1 inside); middle of its arc, cosine of half of it; friction, slip."""


@by_reference
class ContactCandidates(NamedTuple):
    """Plates first .. last-1 that may touch a body; `size`[0] of them are in use."""

    body: Ints  # sprockets first, then guides
    first: Ints
    last: Ints
    size: Ints


class LinearLaws(NamedTuple):
    """Every body is touched by a linear law, stiffness and damping in its record."""

    bodies: int


class ContactLaws(NamedTuple):
    """Every body has a law of its own, all of one class."""

    laws: tuple[Any, ...]


@generic
def law_of(contacts: Any, body: Records, number: int) -> Any:
    """The contact law of a body, a sprocket or a guide."""
    raise NotImplementedError


@generic
def flank_energy(contacts: Any, law: Any, right: float, left: float) -> float:
    """Energy [J] stored in both flanks of a plate at these depths [m]."""
    raise NotImplementedError


@implements(law_of, LinearLaws)
def _(contacts, body, number):
    return KelvinVoigt(body.stiffness, body.damping)


@implements(flank_energy, LinearLaws)
def _(contacts, law, right, left):
    return 0.5 * law.k * (right * right + left * left)


@implements(law_of, ContactLaws)
def _(contacts, body, number):
    return contacts.laws[number]


@implements(flank_energy, ContactLaws)
def _(contacts, law, right, left):
    return stored_energy(law, -right) + stored_energy(law, -left)


class ChainConstants(NamedTuple):
    """What all plates share."""

    count: int  # pyright: ignore[reportIncompatibleMethodOverride]  of plates; tuple.count is not used here
    blocks: int
    joint_stiffness: float
    joint_damping: float  # beta k_j
    articulation_damping: float
    rolling_diameter: float  # 2 r
    offset: float
    cos: float
    sin: float
    flank_support: float
    deepest: float  # limits of the contact's place along the flank
    highest: float
    half_plate: float
    mass: float
    inertia: float
    laws: LinearLaws | ContactLaws


@by_reference
class DriveArrays(NamedTuple):
    """All arrays of a drive; clock: time [s], steps done; power and its integral, see SUMS."""

    chain: ChainConstants
    plates: Plates
    joints: Joints
    touches: Touches
    bodies: Records
    teeth: Teeth
    arcs: Records
    candidates: ContactCandidates
    gravity: Floats
    clock: Floats
    power: Floats
    sums: Floats


SUMS = ("drive", "torque", "slide damping", "turn damping", "friction", "guide damping", "impulse x", "impulse y", "turning impulse")
DRIVE, TORQUE, SLIDE_DAMPING, TURN_DAMPING, FRICTION, GUIDE_DAMPING, IMPULSE_X, IMPULSE_Y, TURNING_IMPULSE = range(len(SUMS))


def compile_model(model: ChainDrive) -> DriveArrays:
    """The `DriveArrays` of a model, its plates not yet placed."""
    chain = _chain(model)
    return DriveArrays(
        chain,
        _plates(model, chain),
        _joints(chain),
        _touches(chain),
        _bodies(model),
        _teeth(model),
        _arcs(model.guides),
        _runs(model, chain),
        np.array(model.gravity, float),
        np.zeros(2),
        np.zeros(len(SUMS)),
        np.zeros(len(SUMS)),
    )


def _chain(model):
    chain, link = model.chain, model.chain.link
    ca, sa = np.cos(link.flank_angle), np.sin(link.flank_angle)
    along = [(link.flank_support * sa - depth) / ca for depth in (chain.toe, chain.crotch)]
    blocks = chain.count // PLATES_PER_VECTOR + 1  # one more place than plates at least, for the copy of the first
    values = (
        chain.joint_stiffness,
        chain.joint_damping * chain.joint_stiffness,
        chain.articulation_damping,
        2 * link.radius,
        chain.centre_offset,
        ca,
        sa,
        link.flank_support,
        *along,
        0.5 * link.pitch,
        chain.mass,
        chain.inertia,
    )
    # Integers among them would cause another compilation.
    return ChainConstants(int(chain.count), blocks, *map(float, values), laws=_contacts(model))


def _contacts(model: ChainDrive) -> LinearLaws | ContactLaws:
    """The contact laws of all bodies, sprockets first."""
    contacts = [body.contact for body in (*model.sprockets, *model.guides)]
    if all(each.law == LINEAR for each in contacts):
        return LinearLaws(len(contacts))
    if len({each.law for each in contacts}) > 1:
        raise InputError("chain drive: sprockets and guides touch by different contact laws; give all of them the same one.")
    return ContactLaws(tuple(contact_law(each.law, ContactParameters(each.stiffness, damping=each.damping)) for each in contacts))


def _lanes(chain):
    return PLATES_PER_VECTOR * (chain.blocks + 1)


def _padded_row(chain):
    return np.zeros(_lanes(chain) + 1)


def _plates(model, chain):
    moving = [_padded_row(chain) for _ in range(7)]
    moving[2][:] = 1.0
    half, rest = _padded_row(chain), [_padded_row(chain)[:-1] for _ in range(7)]
    half[: chain.count] = 0.5 * model.chain.hole_pitches
    half[chain.count] = half[0]
    live = np.where(np.arange(_lanes(chain)) < chain.count, 1.0, 0.0)
    constants = (
        live / model.chain.mass,
        live / model.chain.inertia,
        model.chain.mass * model.gravity[0] * live,
        model.chain.mass * model.gravity[1] * live,
    )
    return Plates(*[a[:-1] for a in moving], *[a[1:] for a in moving], *rest, *[half[:-1], half[1:], *constants])


def _joints(chain):
    rows = [_padded_row(chain) for _ in range(5)]
    return Joints(*(a[1:] for a in rows), *(a[:-1] for a in rows), *(_padded_row(chain)[:-1] for _ in range(4)))


def _touches(chain):
    return Touches(*(_padded_row(chain)[:-1] for _ in Touches._fields))


def _bodies(model):
    every = (*model.sprockets, *model.guides)
    rows = np.zeros(len(every), BODIES).view(np.recarray)
    for row, body in zip(rows, every, strict=True):
        row.x0, row.y0 = row.x, row.y = body.centre
        row.psi0 = row.psi = getattr(body, "angle", 0.0) or 0.0
        row.mass, row.inertia = body.mass if body.slide else 1.0, getattr(body, "inertia", 0.0) or 1.0
        row.turn_damping = getattr(body, "damping", 0.0)
        row.load = getattr(body, "torque", 0.0) + row.turn_damping * getattr(body, "reference_speed", 0.0)
        row.stiffness, row.damping = body.contact.stiffness, body.contact.damping
        _slide(row, body.slide, isinstance(body, Guide))
        _drive(row, getattr(body, "drive", None), isinstance(body, Guide))
    return rows


def _slide(row, slide, guide):
    if slide:
        way = slide.way(complex(row.x0, row.y0), 0.0)
        row.slides, row.ux, row.uy, row.weight = True, way.real, way.imag, 0.0 if slide.pivot else row.mass
        if slide.pivot:
            row.px, row.py, row.lever, row.swing = *slide.pivot, slide.lever, 1 / slide.lever if guide else 0.0
        row.force, row.spring, row.slide_damping = slide.force, slide.stiffness, slide.damping


def _drive(row, drive, still):
    row.driven = still or drive is not None
    if drive:
        row.start, row.speed, row.ramp = drive.start, drive.speed, drive.ramp


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
    return (
        0.0,
        0.0,
        sprocket.tip_radius,
        0.0,
        2 * np.pi / tooth.teeth,
        reach,
        True,
        tooth.seat_centre,
        tooth.seat_radius - tooth.roller_radius,
        tooth.flank_radius + tooth.roller_radius,
        np.sin(edge),
        -np.cos(edge),
        *tooth.flank_centre,
    )


def _arcs(guides):
    rows = np.zeros(len(guides), ARCS).view(np.recarray)
    for row, g in zip(rows, guides, strict=True):
        middle = 0.5 * (g.start + g.end)
        row.radius, row.distance, row.side = g.radius, g.distance, 1.0 if g.side == "inside" else -1.0
        row.middle_x, row.middle_y, row.opening = np.cos(middle), np.sin(middle), np.cos(0.5 * (g.end - g.start))
        row.friction, row.slip = g.friction, g.slip
    return rows


def _runs(model, chain):
    room = (len(model.sprockets) + len(model.guides)) * chain.count
    return ContactCandidates(*(np.zeros(room, np.int64) for _ in range(3)), size=np.zeros(1, np.int64))
