"""What the implicit kernels read and write: records of the bodies and of the contacts, the state, the gradient with its tangent."""

from typing import NamedTuple

import numpy as np

from drivewright._jit import by_reference
from drivewright._typing import Floats, Ints, Records
from drivewright.chains.explicit import assembly, state
from drivewright.chains.explicit.assembly import Start
from drivewright.chains.implicit.ring import Ring, empty_ring
from drivewright.chains.model import ChainDrive
from drivewright.errors import InputError

POWERS = ("joint damping", "contact damping", "slide damping", "turn damping", "friction", "guide damping", "torque")
JOINT, CONTACT, SLIDE, TURN, FRICTION, GUIDE, TORQUE = range(len(POWERS))
TOOTH, GAP, ARC = range(3)  # kinds of a body
_FROM_BODIES = (
    "x0",
    "y0",
    "ux",
    "uy",
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
_FROM_TEETH = (
    "support",
    "low",
    "high",
    "pitch_angle",
    "reach",
    "seat_at",
    "seat_gap",
    "flank_gap",
    "edge_x",
    "edge_y",
    "flank_x",
    "flank_y",
)
_FROM_ARCS = ("radius", "distance", "side", "middle_x", "middle_y", "opening", "friction", "slip")
BODY = np.dtype(
    [("kind", np.int64), ("base_radius", float), ("slide_column", np.int64), ("turn_column", np.int64)]
    + [(name, float) for name in (*_FROM_BODIES, *_FROM_TEETH, *_FROM_ARCS)]
)
PAIR = np.dtype([("body", np.int64), ("plate", np.int64), ("seat", float), ("right", float), ("left", float)])


@by_reference
class State(NamedTuple):
    """Plates (N, 3): x, y of the mass centre, angle; bodies (B, 2): place q on the slide, angle psi; their rates."""

    plates: Floats
    bodies: Floats
    plate_rates: Floats
    body_rates: Floats


class Field(NamedTuple):
    """Gradient by plates (N, 3) and bodies (B, 2), tangent, joint forces (N, 2), powers (see POWERS).

    loads (B, 3): what all plates do to a body by touching it, force x, y and moment about its centre.
    Scratch: directions (N, 2) cos, sin; of one contact the depth's derivatives by x, y, angle of the plate and q, psi of the body:
    slope (5,), bend (5, 5).
    """

    plates: Floats
    bodies: Floats
    ring: Ring
    joints: Floats
    powers: Floats
    loads: Floats
    directions: Floats
    slope: Floats
    bend: Floats


@by_reference
class Parts(NamedTuple):
    """All of a drive.

    chain: what all plates share; half: of the hole pitches; bodies: a record (see BODY) of each sprocket, then of each guide, with the
    columns of q and psi in the tangent's border, -1 for what is prescribed; pairs: who may touch whom, the angle of the tooth there
    (less psi), the forces of right and left flank (seat and flank of a roller's gap, guide and its friction); `size`[0] of them in use.
    """

    chain: state.ChainConstants
    half: Floats
    gravity: Floats
    bodies: Records
    pairs: Records
    size: Ints
    field: Field


def compile_model(model: ChainDrive) -> Parts:
    """The `Parts` of a `Model`; InputError for a pivot, whose curved way the tangent does not know."""
    for body in (*model.sprockets, *model.guides):
        if body.slide and body.slide.pivot:
            raise InputError(
                f"chain drive: {body.name or 'a tensioner'} turns about a pivot, which implicit integration and the chain at rest do not "
                "support; "
                "use explicit integration, or a slide instead of the pivot."
            )
    drive = state.compile_model(model)
    bodies, count = _records(drive), model.chain.count
    border = int(max(bodies["slide_column"].max(), bodies["turn_column"].max())) + 1
    field = Field(
        np.zeros((count, 3)),
        np.zeros((len(bodies), 2)),
        empty_ring(count, border),
        np.zeros((count, 2)),
        np.zeros(len(POWERS)),
        np.zeros((len(bodies), 3)),
        np.zeros((count, 2)),
        np.zeros(5),
        np.zeros((5, 5)),
    )
    half = 0.5 * np.ascontiguousarray(model.chain.hole_pitches)
    pairs = np.zeros(count * len(bodies), PAIR).view(np.recarray)
    return Parts(drive.chain, half, drive.gravity, bodies, pairs, np.zeros(1, np.int64), field)


def _records(drive):
    rows = np.zeros(len(drive.bodies.q), BODY).view(np.recarray)  # for the kernels in plain Python
    sprockets = len(drive.teeth.base)
    for names, source, place in (
        (_FROM_BODIES, drive.bodies, slice(None)),
        (_FROM_TEETH, drive.teeth, slice(0, sprockets)),
        (_FROM_ARCS, drive.arcs, slice(sprockets, None)),
    ):
        for name in names:
            rows[name][place] = getattr(source, name)
    rows["base_radius"][:sprockets] = drive.teeth.base
    rows["kind"][:sprockets] = np.where(drive.teeth.rolls, GAP, TOOTH)
    rows["kind"][sprockets:] = ARC
    free = np.column_stack([drive.bodies.slides, ~drive.bodies.driven])
    number = np.where(free, np.cumsum(free.ravel()).reshape(free.shape) - 1, -1)
    rows["slide_column"], rows["turn_column"] = number.T
    return rows


def at_rest(plates: Floats, bodies: Floats) -> State:
    """A `State` without rates."""
    plates, bodies = np.array(plates, float), np.array(bodies, float)
    return State(plates, bodies, np.zeros_like(plates), np.zeros_like(bodies))


def assembled(model: ChainDrive, begin: Start | None = None) -> State:
    """The `State` of a `Start`, by itself that of the assembly: seated plates, straight strands, all moving as if rigid."""
    begin, offset = assembly.start(model) if begin is None else begin, model.chain.centre_offset
    x, y, angle = begin.poses.T
    vx, vy, w = begin.rates.T
    lift = offset * np.stack([-np.sin(angle), np.cos(angle)])
    bodies, rates = np.zeros((2, len(model.sprockets) + len(model.guides), 2))
    bodies[: len(begin.psi)] = np.column_stack([begin.q, begin.psi])
    bodies[len(begin.psi) :, 0] = begin.guide_q
    rates[: len(begin.psi)] = np.column_stack([begin.rate_q, begin.rate_psi])
    return State(
        np.column_stack([x + lift[0], y + lift[1], angle]), bodies, np.column_stack([vx - w * lift[1], vy + w * lift[0], w]), rates
    )
