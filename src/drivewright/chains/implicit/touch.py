"""How deep a plate presses into a tooth or a guide, with the first and second derivatives of the depth, compiled.

A flank and a guide are both a straight line of the plate, with the outward normal n, against a curve given by its support:

    depth = n.D + w - (H + s rb delta),   D the pin frame's origin from the body's centre in the plate's frame, delta the plate turned
    against its seat; s = 1 for the right flank, -1 for the left one, and rb = 0 for a guide, whose H is -(R + distance).
"""

from typing import Any

import numpy as np

from drivewright._jit import inner
from drivewright.chains.implicit.parts import ARC, FRICTION, GAP, Parts, State
from drivewright.chains.touching.flank import flank_contact, is_active
from drivewright.chains.touching.guide import is_on_arc, nearest_on_plate
from drivewright.chains.touching.roller import roller_contact
from drivewright.chains.touching.seats import nearest_gap, nearest_tooth


@inner
def depth_of(parts: Parts, state: State, pair: Any, body: Any, place: int) -> float:
    """Depth [m] of one contact of a pair, -1 where there is none; its derivatives in the field: slope (5,), bend (5, 5).

    Place 0, 1: right and left flank of a plate, seat and flank of a roller's gap; a guide has place 0 alone.
    """
    c, s = parts.field.directions[pair.plate, 0], parts.field.directions[pair.plate, 1]
    gx = state.plates[pair.plate, 0] - body.x0 - state.bodies[pair.body, 0] * body.ux
    gy = state.plates[pair.plate, 1] - body.y0 - state.bodies[pair.body, 0] * body.uy
    along, up = c * gx + s * gy, c * gy - s * gx
    if body.kind == ARC:
        return _guide(parts, body, c, s, along, up) if place == 0 else -1.0
    if body.kind == GAP:
        half = parts.half[pair.plate]
        return _roller(parts, body, c, s, along, up, half, state.bodies[pair.body, 1] + pair.seat, place)
    return _flank(parts, body, c, s, along, up, state.plates[pair.plate, 2] - state.bodies[pair.body, 1] - pair.seat, 1.0 - 2.0 * place)


@inner
def _line(field, body, c, s, along, up, nx, ny, roll):
    """Derivatives of n.D - roll (angle - psi): with N = R n, that by the place is N, by the angle N'.(X - B) - roll, twice -N.(X - B)."""
    slope, bend = field.slope, field.bend
    wx, wy, tx, ty = c * nx - s * ny, s * nx + c * ny, -s * nx - c * ny, c * nx - s * ny
    slope[0], slope[1], slope[2] = wx, wy, nx * up - ny * along - roll
    slope[3], slope[4] = -wx * body.ux - wy * body.uy, roll
    bend[:] = 0.0
    bend[0, 2] = bend[2, 0] = tx
    bend[1, 2] = bend[2, 1] = ty
    bend[2, 2] = -nx * along - ny * up
    bend[2, 3] = bend[3, 2] = -tx * body.ux - ty * body.uy


@inner
def _flank(parts, body, c, s, along, up, turned, sign):
    """Depth [m] of the right (sign 1) or left flank in its tooth; -1 where their contact lies off either's active flank.

    (c, s) cosine and sine of the plate's angle; along, up [m]: its centre from the body's, in its frame; turned [rad] off the seat.
    """
    chain = parts.chain
    rolled = body.base_radius * turned
    depth, support, place = flank_contact(
        chain.cos, chain.sin, chain.flank_support, body.base_radius, body.support, sign, along, up - chain.offset, rolled
    )
    if not (depth > 0.0 and is_active(support, body.low, body.high, place, chain.deepest, chain.highest)):
        return -1.0
    _line(parts.field, body, c, s, along, up, sign * chain.cos, -chain.sin, sign * body.base_radius)
    return depth


@inner
def _guide(parts, body, c, s, along, up):
    """Depth of the plate's back or belly, half a pitch either way, in the arc of a guide; -1 where the arc ends.

    Where the nearest point of that line is its end, two plates make a corner that touches.
    """
    x, y, far = nearest(parts, body, along, up)
    within = is_on_arc(c, s, x, y, far, body.middle_x, body.middle_y, body.opening)
    if not (far < body.radius and body.side * y > 0.0 and within):
        return -1.0
    if x == 0.0:
        _line(parts.field, body, c, s, along, up, 0.0, -body.side, 0.0)
        return body.radius - far
    gx, gy = c * x - s * y, s * x + c * y
    px, py = x - along, y - up
    _point(parts.field, body, -gx / far, -gy / far, -1.0 / far, c * px - s * py, s * px + c * py, gx, gy)
    return body.radius - far


@inner
def nearest(parts: Parts, body: Any, along: float, up: float) -> tuple[float, float, float]:
    """The nearest point (x, y) [m] of a plate's back or belly from a guide's centre, in the plate's frame, and its distance [m]."""
    y = up - body.side * body.distance - parts.chain.offset
    _, x, far = nearest_on_plate(along, y, parts.chain.half_plate)
    return x, y, far


@inner
def _roller(parts, body, c, s, along, up, half, turn, place):
    """Depth of the roller on the right-hand pin in the seat (place 0) or flank of its gap; -1 in the other one and beyond the tip."""
    arm_x, arm_y = half * c + parts.chain.offset * s, half * s - parts.chain.offset * c
    gx, gy = c * along - s * up + arm_x, s * along + c * up + arm_y
    co, si = np.cos(turn), np.sin(turn)
    across, out = si * gx - co * gy, co * gx + si * gy - body.seat_at
    mirror = 1.0 if across >= 0.0 else -1.0
    depth, far, x, y, seated = roller_contact(
        across * mirror, out, body.edge_x, body.edge_y, body.flank_x, body.flank_y, body.seat_gap, body.flank_gap
    )
    if seated != (place == 0) or not body.seat_at + out < body.low:
        return -1.0
    x, far, sign = x * mirror, max(far, 1e-15), 1.0 if seated else -1.0
    wx, wy = sign * (x * si + y * co) / far, sign * (y * si - x * co) / far
    _point(parts.field, body, wx, wy, sign / far, arm_x, arm_y, gx, gy)
    return depth


@inner
def _point(field, body, wx, wy, curve, rx, ry, gx, gy):
    """Derivatives of a depth with gradient w and curvature `curve` across it, of a point at r from the mass centre, g from the body.

    The point moves against the body by e_x, e_y, perp(r), -slide, -perp(g) per plate's x, y, angle, q, psi.
    """
    slope, bend = field.slope, field.bend
    ways_x, ways_y = (1.0, 0.0, -ry, -body.ux, gy), (0.0, 1.0, rx, -body.uy, -gx)
    for a in range(5):
        slope[a] = wx * ways_x[a] + wy * ways_y[a]
        for d in range(5):
            bend[a, d] = curve * (wx * ways_y[a] - wy * ways_x[a]) * (wx * ways_y[d] - wy * ways_x[d])
    bend[2, 2] -= wx * rx + wy * ry
    bend[4, 4] -= wx * gx + wy * gy
    for a in range(4):  # what moves the point also moves it about the turning body
        bend[a, 4] += wx * ways_y[a] - wy * ways_x[a]
        bend[4, a] += wx * ways_y[a] - wy * ways_x[a]


@inner
def drag_guide(parts: Parts, state: State, pair: Any, body: Any, gain: float) -> None:
    """Friction -mu fn v/sqrt(v^2 + slip^2) along the plate where it touches the guide."""
    field, c, s = parts.field, parts.field.directions[pair.plate, 0], parts.field.directions[pair.plate, 1]
    v = state.plate_rates[pair.plate]
    gx = state.plates[pair.plate, 0] - body.x0 - state.bodies[pair.body, 0] * body.ux
    gy = state.plates[pair.plate, 1] - body.y0 - state.bodies[pair.body, 0] * body.uy
    along, up = c * gx + s * gy, c * gy - s * gx
    x, y, far = nearest(parts, body, along, up)
    tx, ty = body.side * y / far, -body.side * x / far
    wx, wy, lever = c * tx - s * ty, s * tx + c * ty, (x - along) * ty - (y - up) * tx
    back = -(wx * body.ux + wy * body.uy)
    slide = wx * v[0] + wy * v[1] + v[2] * lever + back * state.body_rates[pair.body, 0]
    soft, limit = np.hypot(slide, body.slip), pair.right * body.friction
    drag, damping = limit * slide / soft, gain * limit * body.slip**2 / soft**3
    pair.left = -drag
    field.powers[FRICTION] += drag * slide
    way, column = (wx, wy, lever), body.slide_column
    for a in range(3):
        field.plates[pair.plate, a] += drag * way[a]
        for d in range(3):
            field.ring.diagonal[pair.plate, a, d] += damping * way[a] * way[d]
        if column >= 0:
            field.ring.border[pair.plate, a, column] += damping * way[a] * back
    field.bodies[pair.body, 0] += drag * back
    loads = field.loads[pair.body]
    loads[0] += drag * wx
    loads[1] += drag * wy
    loads[2] -= drag * body.side * far
    if column >= 0:
        field.ring.corner[column, column] += damping * back * back


# ------------------------------------------------------------------------------------------------- who may touch whom


@inner
def find_candidates(parts: Parts, state: State) -> bool:
    """Pairs of a body and a plate near it, with the tooth that the plate may sit on; of the sprockets only the nearest counts.

    Returns whether anything of it is new.
    """
    count, new = 0, False
    for n in range(len(state.bodies)):
        for plate in range(len(state.plates)):
            if _near(parts, state, n, plate):
                pair = parts.pairs[count]
                seat = _seat(parts, state, n, plate)
                new = new or pair.body != n or pair.plate != plate or abs(pair.seat - seat) > 1e-9
                pair.body, pair.plate, pair.seat = n, plate, seat
                count += 1
    new = new or count != parts.size[0]
    parts.size[0] = count
    return new


@inner
def _near(parts, state, n, plate):
    """Whether a plate may touch body n: a guide within its arc's reach, of the sprockets the nearest."""
    body = parts.bodies[n]
    far = _distance(parts, state, n, plate)
    if body.kind == ARC:
        return far < body.radius + abs(body.distance) + 4 * parts.chain.half_plate
    near = far < body.reach
    for m in range(len(parts.bodies)):
        other = parts.bodies[m]
        if m != n and other.kind != ARC and _distance(parts, state, m, plate) - other.reach < far - body.reach:
            near = False
    return near


@inner
def _distance(parts, state, n, plate):
    """Distance of a plate's mass centre from the centre of body n [m]."""
    body, q = parts.bodies[n], state.bodies[n, 0]
    return np.hypot(state.plates[plate, 0] - body.x0 - q * body.ux, state.plates[plate, 1] - body.y0 - q * body.uy)


@inner
def _seat(parts, state, n, plate):
    """Angle [rad] of the tooth (for rollers: of the gap) nearest to the plate, against psi; see `touching.seats`."""
    body, q, psi = parts.bodies[n], state.bodies[n, 0], state.bodies[n, 1]
    phi, half, offset, angle = body.pitch_angle, parts.half[plate], parts.chain.offset, state.plates[plate, 2]
    x, y = state.plates[plate, 0] - body.x0 - q * body.ux, state.plates[plate, 1] - body.y0 - q * body.uy
    if body.kind == ARC:
        return 0.0
    if body.kind == GAP:
        x, y = x + half * np.cos(angle) + offset * np.sin(angle), y + half * np.sin(angle) - offset * np.cos(angle)
        return nearest_gap(x, y, psi, phi)
    return nearest_tooth(x, y, psi, phi, angle)
