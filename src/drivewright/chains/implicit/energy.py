"""Energy of a drive, its gradient and its exact Hessian, compiled.

    V = sum k_j |d|^2/2 + sum V_contact(depth) + sum (s q^2/2 - F q) - sum T psi - weight

With rates, the gradient takes in the forces of all dampers, and the tangent their derivatives by the rates times `gain`: the matrix
of an implicit step less its mass.  How damping and friction forces turn with the places is left out of it, which keeps it symmetric.
"""

import numpy as np

from drivewright._jit import inner
from drivewright.chains.explicit.state import law_of
from drivewright.chains.implicit.parts import ARC, CONTACT, GUIDE, JOINT, SLIDE, TORQUE, TURN, Parts, State
from drivewright.chains.implicit.ring import clear
from drivewright.chains.implicit.touch import depth_of, drag_guide
from drivewright.contact.normal import normal_force, stored_energy, tangent


@inner
def assemble(parts: Parts, state: State, gain: float) -> float:
    """Fill the field of the parts at this state; returns V [J].  gain [1/s]: by how much rates follow places in the tangent."""
    field = parts.field
    clear(field.ring)
    field.powers[:] = 0.0
    field.bodies[:] = 0.0
    field.loads[:] = 0.0
    for i in range(len(state.plates)):
        field.directions[i, 0], field.directions[i, 1] = np.cos(state.plates[i, 2]), np.sin(state.plates[i, 2])
    energy = _weights(parts, state) + _bodies(parts, state, gain)
    for i in range(len(state.plates)):
        energy += _joint(parts, state, i, gain)
    for k in range(parts.size[0]):
        pair = parts.pairs[k]
        body = parts.bodies[pair.body]
        for place in range(2):
            energy += _press(parts, state, pair, body, place, gain)
        if body.kind == ARC and pair.right * body.friction > 0.0:
            drag_guide(parts, state, pair, body, gain)
    return energy


@inner
def _weights(parts, state):
    """Weight of the plates; the gradient starts anew with it."""
    field, gx, gy, energy = parts.field, parts.chain.mass * parts.gravity[0], parts.chain.mass * parts.gravity[1], 0.0
    for i in range(len(state.plates)):
        field.plates[i, 0], field.plates[i, 1], field.plates[i, 2] = -gx, -gy, 0.0
        energy -= gx * state.plates[i, 0] + gy * state.plates[i, 1]
    return energy


@inner
def _bodies(parts, state, gain):
    """Slides with force, spring, damper and weight; turning bodies with torque and damper.  What is prescribed counts for nothing."""
    field, energy = parts.field, 0.0
    for n in range(len(state.bodies)):
        q, psi, rate, spin = state.bodies[n, 0], state.bodies[n, 1], state.body_rates[n, 0], state.body_rates[n, 1]
        b = parts.bodies[n]
        column, turn = b.slide_column, b.turn_column
        if column >= 0:
            pull = b.force + b.mass * (parts.gravity[0] * b.ux + parts.gravity[1] * b.uy)
            energy += 0.5 * b.spring * q * q - pull * q
            field.bodies[n, 0] = b.spring * q - pull + b.slide_damping * rate
            field.ring.corner[column, column] += b.spring + gain * b.slide_damping
            field.powers[SLIDE] += b.slide_damping * rate * rate
        if turn >= 0:
            energy -= b.load * psi
            field.bodies[n, 1] = b.turn_damping * spin - b.load
            field.ring.corner[turn, turn] += gain * b.turn_damping
            field.powers[TURN] += b.turn_damping * spin * spin
            field.powers[TORQUE] += b.load * spin
    return energy


@inner
def _joint(parts, state, i, gain):
    """Rolling joint behind plate i: d = P - Q - 2 r u, with u the mean of both directions; V = k |d|^2/2.

    With a, b from the mass centres to the pins: d by the angles is perp(a) - r perp(u) and -perp(b) - r perp(u); by them twice
    -a + r u/2, b + r u/2, and mixed r u/2.  The damper sees the relative velocity of both plates midway between the pins; articulation
    has one of its own.
    """
    field, chain, half, x, v = parts.field, parts.chain, parts.half, state.plates, state.plate_rates
    k, damping, r, offset = chain.joint_stiffness, chain.joint_damping, 0.5 * chain.rolling_diameter, chain.offset
    articulation = chain.articulation_damping
    j = i + 1 if i + 1 < len(x) else 0
    c, s, c1, s1 = field.directions[i, 0], field.directions[i, 1], field.directions[j, 0], field.directions[j, 1]
    ax, ay = half[i] * c + offset * s, half[i] * s - offset * c
    bx, by = -half[j] * c1 + offset * s1, -half[j] * s1 - offset * c1
    near = r / np.hypot(c + c1, s + s1)
    ux, uy = near * (c + c1), near * (s + s1)  # r u
    dx, dy = x[i, 0] + ax - x[j, 0] - bx - 2 * ux, x[i, 1] + ay - x[j, 1] - by - 2 * uy
    fx, fy = k * dx, k * dy
    mx, my, nx, ny = ax - ux - 0.5 * dx, ay - uy - 0.5 * dy, bx + ux + 0.5 * dx, by + uy + 0.5 * dy
    rx = v[i, 0] - v[i, 2] * my - v[j, 0] + v[j, 2] * ny
    ry = v[i, 1] + v[i, 2] * mx - v[j, 1] - v[j, 2] * nx
    gx, gy = fx + damping * rx, fy + damping * ry
    field.joints[i, 0], field.joints[i, 1] = gx, gy
    turn = articulation * (v[i, 2] - v[j, 2])
    field.powers[JOINT] += damping * (rx * rx + ry * ry) + turn * (v[i, 2] - v[j, 2])
    _put(field.plates[i], gx, gy, mx * gy - my * gx + turn)
    _put(field.plates[j], -gx, -gy, ny * gx - nx * gy - turn)
    px, py, qx, qy = uy - ay, ax - ux, by + uy, -bx - ux  # d by the angles
    extra, stiff = gain * damping, k + gain * damping
    ex, ey, hx, hy = k * px - extra * my, k * py + extra * mx, k * qx + extra * ny, k * qy - extra * nx
    own, other, cross = field.ring.diagonal[i], field.ring.diagonal[j], field.ring.side[i]
    turning, slowed = 0.5 * (fx * ux + fy * uy), gain * articulation
    own_turn = k * (px * px + py * py) + extra * (mx * mx + my * my) - fx * ax - fy * ay + turning + slowed
    other_turn = k * (qx * qx + qy * qy) + extra * (nx * nx + ny * ny) + fx * bx + fy * by + turning + slowed
    cross_turn = k * (px * qx + py * qy) - extra * (mx * nx + my * ny) + turning - slowed
    _put_block(own, stiff, ex, ey, ex, ey, own_turn)
    _put_block(other, stiff, -hx, -hy, -hx, -hy, other_turn)
    _put_block(cross, -stiff, hx, hy, -ex, -ey, cross_turn)
    return 0.5 * k * (dx * dx + dy * dy)


@inner
def _put(row, x, y, turn):
    """Add a force (x, y) [N] and a moment `turn` [N m] to row (3,)."""
    row[0] += x
    row[1] += y
    row[2] += turn


@inner
def _put_block(block, stiff, x2, y2, x0, y0, turn):
    """Add to a block (3, 3): `stiff` [N/m] of both places, columns x2, y2 and rows x0, y0 of the angles [N], `turn` [N m] of the angles."""
    block[0, 0] += stiff
    block[1, 1] += stiff
    block[0, 2] += x2
    block[1, 2] += y2
    block[2, 0] += x0
    block[2, 1] += y0
    block[2, 2] += turn


@inner
def _press(parts, state, pair, body, place, gain):
    """One contact: force of its law onto plate and body; returns its energy [J].  gain [1/s] as for `assemble`."""
    field, rate, force = parts.field, 0.0, 0.0
    law = law_of(parts.chain.laws, body, pair.body)
    depth = depth_of(parts, state, pair, body, place)
    if depth > 0.0:
        for a in range(5):
            rate += field.slope[a] * (state.plate_rates[pair.plate, a] if a < 3 else state.body_rates[pair.body, a - 3])
        force = normal_force(law, -depth, -rate)
        field.powers[GUIDE if body.kind == ARC else CONTACT] += (force - normal_force(law, -depth, 0.0)) * rate
    if place == 0:
        pair.right = force
    else:
        pair.left = force
    if force > 0.0:
        stiffness, damping = tangent(law, -depth, -rate)
        _scatter(field, pair, body, force, stiffness + gain * damping)
    return stored_energy(law, -depth)


@inner
def _scatter(field, pair, body, force, stiffness):
    """Gradient force J and tangent stiffness J J' + force d2(depth) of one contact into those of the drive: force [N], stiffness [N/m].

    J = field.slope (5,) and d2(depth) = field.bend (5, 5) by x, y, angle of the plate, place and angle of the body.
    """
    slope, bend, ring, columns = field.slope, field.bend, field.ring, (body.slide_column, body.turn_column)
    loads = field.loads[pair.body]
    loads[0] += force * slope[0]
    loads[1] += force * slope[1]
    loads[2] -= force * slope[4]
    for a in range(3):
        field.plates[pair.plate, a] += force * slope[a]
        for b in range(3):
            ring.diagonal[pair.plate, a, b] += stiffness * slope[a] * slope[b] + force * bend[a, b]
    for a in range(2):
        field.bodies[pair.body, a] += force * slope[3 + a]
        if columns[a] >= 0:
            for b in range(3):
                ring.border[pair.plate, b, columns[a]] += stiffness * slope[3 + a] * slope[b] + force * bend[3 + a, b]
            for b in range(2):
                if columns[b] >= 0:
                    ring.corner[columns[a], columns[b]] += stiffness * slope[3 + a] * slope[3 + b] + force * bend[3 + a, 3 + b]
