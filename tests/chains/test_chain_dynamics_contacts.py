"""Each contact is the slope of the energy it stores, on plate, centre and sprocket alike; depths against drawn geometry."""

import numpy as np
import pytest
import shapely

from drivewright._jit import plain
from drivewright.chains.explicit.advance import near
from drivewright.chains.explicit.bodies import follow, load_guide, load_rollers, turn_acceleration
from drivewright.chains.explicit.state import FRICTION, compile_model
from drivewright.chains.explicit.step import (
    accelerate_plates,
    drift_plates,
    flank_damping_work,
    joint_damping_work,
    load_flanks,
    load_gravity,
    load_joints,
)
from drivewright.chains.link import design_link, seat_height, seat_support
from drivewright.chains.model import Chain, ChainContact, ChainDrive, Guide, SpeedRamp, Sprocket
from drivewright.chains.roller_sprocket import design_roller_sprocket
from drivewright.chains.roller_tooth import RollerTooth
from drivewright.chains.tooth import Tooth
from drivewright.contact import KelvinVoigt, mean_force

pytestmark = pytest.mark.analytical

A, K = np.pi / 6, 1e7
JOINT = design_link(9.525e-3, 1.2e-3, A, 2e-4)
INVOLUTE = Tooth(12, 9.525e-3 * 12 / (2 * np.pi) * np.cos(A), seat_support(JOINT, 12))
ROLLER = RollerTooth(12, 9.525e-3 / (2 * np.sin(np.pi / 12)), 2.6e-3, np.radians(130), 8e-3, 2.5e-3)


def lowered(tooth=INVOLUTE, guides=(), offset=0.7e-3, damping=0.0, joint=JOINT, count=8):
    chain = Chain(joint, count, 2.5e-3, 6.4e-8, 3e6, centre_offset=offset)
    here = Sprocket(tooth, ChainContact(K, damping), (0.02, -0.01), drive=SpeedRamp(1.0, 1.0))
    return compile_model(ChainDrive(chain, (here, Sprocket(tooth, ChainContact(K), (5.0, 0.0), inertia=1.0)), guides))


def put(drive, x, y, angle, psi=0.4, centre=(0.02, -0.01), v=(0.0, 0.0, 0.0), body=0):
    p, b = drive.plates, drive.bodies
    p.x[0], p.y[0], p.angle[0], p.c[0], p.s[0] = x, y, angle, np.cos(angle), np.sin(angle)
    p.vx[0], p.vy[0], p.w[0] = v
    b.psi[body], b.x[body], b.y[body] = psi, *centre
    b.fx[:], b.fy[:], b.torque[:] = 0.0, 0.0, 0.0
    plain(load_gravity)(drive.chain, p, drive.touches)


def flank(drive, seat, dt=1e-6, plates=(0, 1)):
    drive.touches.seat[:], drive.touches.seat_cos[:], drive.touches.seat_sin[:] = seat, np.cos(seat), np.sin(seat)
    plain(load_flanks)(drive.chain, drive.plates, drive.touches, drive.bodies, drive.teeth, 0, *plates, dt)
    plain(flank_damping_work)(drive.chain, drive.plates, drive.touches, drive.bodies, drive.teeth, 0, *plates, dt)


def roller(drive, seat, dt=1e-6, plates=(0, 1)):
    drive.touches.seat[:], drive.touches.seat_cos[:], drive.touches.seat_sin[:] = seat, np.cos(seat), np.sin(seat)
    plain(load_rollers)(drive.chain, drive.plates, drive.touches, drive.bodies, drive.teeth, 0, *plates, dt)


def guide(drive, seat, dt=1e-6, plates=(0, 1)):
    plain(load_guide)(drive.chain, drive.plates, drive.touches, drive.bodies, drive.arcs, 0, *plates, drive.power, dt)


def at_tooth(dx, dy, turn, psi=0.4, tooth=2, offset=0.7e-3):
    """Pose of a plate off its seat by (dx, dy) in its own frame and a turn."""
    seat = tooth * 2 * np.pi / 12 - np.pi / 2
    angle = psi + seat
    place = 0.02 - 0.01j + (dx + 1j * (seat_height(JOINT, 12) + offset + dy)) * np.exp(1j * angle)
    return place.real, place.imag, angle + turn, seat


GUIDES = tuple(Guide((0.02, -0.01), 0.03, 0.0, np.pi, side, 4e-3, ChainContact(K)) for side in ("inside", "outside"))
CASES = {
    "both flanks": (INVOLUTE, (), flank, (*at_tooth(0, -4e-5, 2e-4)[:3],), at_tooth(0, 0, 0)[3]),
    "right flank": (INVOLUTE, (), flank, (*at_tooth(6e-5, -1e-5, 4e-3)[:3],), at_tooth(0, 0, 0)[3]),
    "left flank": (INVOLUTE, (), flank, (*at_tooth(-6e-5, -1e-5, -4e-3)[:3],), at_tooth(0, 0, 0)[3]),
    "belly": (INVOLUTE, GUIDES[:1], guide, (0.021, 0.02465, 0.03), 0.0),
    "back": (INVOLUTE, GUIDES[1:], guide, (0.021, 0.02325, np.pi + 0.03), 0.0),
    "roller seat": (ROLLER, (), roller, (0.0207, 0.00765, 0.05), np.pi / 2 - 0.4 - 0.24),
    "roller flank": (ROLLER, (), roller, (0.0224, 0.0092, 0.05), np.pi / 2 - 0.4 - 0.24),
}


@pytest.mark.parametrize("name", CASES)
def test_forces_are_the_slope_of_the_energy(name):
    tooth, guides, touch, pose, seat = CASES[name]
    drive = lowered(tooth, guides, joint=design_link(9.525e-3, 0.0, A, 2e-4) if tooth is ROLLER else JOINT)
    body = 2 if guides else 0
    base = np.array([*pose, 0.02, -0.01, 0.4])

    def energy(x):
        put(drive, *x[:3], psi=x[5], centre=x[3:5], body=body)
        touch(drive, seat)
        return drive.touches.stored[0]

    steps = 1e-8 * np.eye(6)
    slope = np.array([(energy(base + h) - energy(base - h)) / 2e-8 for h in steps])
    energy(base)
    p, t = drive.plates, drive.touches
    force = np.array([t.fx[0], t.fy[0], p.moment[0], -t.fx[0], -t.fy[0], t.torque[0]])
    if guides:
        force[5] = 0.0
    assert t.stored[0] > 1e-5
    np.testing.assert_allclose(force, -slope, rtol=1e-5, atol=1e-4 * np.max(np.abs(force[:2])))


@pytest.mark.parametrize("name", CASES)
def test_a_run_of_plates_touches_as_its_plates_one_by_one_and_leaves_all_others(name):
    """Kernels take runs in whole vectors, here one of eight plates for a run of three, all of them in contact and as they were loaded."""
    tooth, guides, touch, pose, seat = CASES[name]
    joint = design_link(9.525e-3, 0.0, A, 2e-4) if tooth is ROLLER else JOINT
    body, ends = (2 if guides else 0), {}
    for way, runs in {"together": [(2, 5)], "alone": [(2, 3), (3, 4), (4, 5)]}.items():
        drive = lowered(tooth, guides, joint=joint, damping=40.0)
        put(drive, *pose, body=body, v=(0.3, -0.2, 1.0))
        p, t = drive.plates, drive.touches
        for row in (p.x, p.y, p.angle, p.c, p.s, p.vx, p.vy, p.w):
            row[:10] = row[0]  # the eight plates, the copy of the first, and a dead one
        rows = [getattr(t, n) for n in ("right", "left", "damped_right", "damped_left", "power", "lost", "stored")] + [p.fx, p.fy, p.moment]
        for number, row in enumerate(rows):
            row[:10] = 1.0 + number
        for run in runs:
            touch(drive, seat, plates=run)
        ends[way] = np.array([row[:10] for row in rows])
    before = np.broadcast_to(1.0 + np.arange(len(rows))[:, None], ends["alone"].shape)
    others = [0, 1, *range(5, 10)]
    np.testing.assert_array_equal(ends["together"][:, others], before[:, others])
    assert np.all(np.any(ends["alone"][:, 2:5] != before[:, 2:5], axis=0))
    np.testing.assert_array_equal(ends["together"], ends["alone"])


def test_a_run_may_begin_at_the_last_plate():
    """Of 15, behind which the vector that begins there needs seven more places."""
    drive = lowered(count=15)
    put(drive, *at_tooth(0.0, -1e-6, 0.0)[:3])
    for row in (drive.plates.x, drive.plates.y, drive.plates.angle, drive.plates.c, drive.plates.s):
        row[14] = row[0]
    flank(drive, at_tooth(0, 0, 0)[3], plates=(14, 15))
    assert drive.touches.right[14] == pytest.approx(K * 1e-6 * np.sin(A), rel=1e-5) and not np.any(drive.touches.right[:14])


def test_a_seated_plate_touches_neither_flank_and_a_deeper_one_both_alike():
    drive = lowered()
    for lower_by, force in ((-1e-9, 0.0), (1e-6, K * 1e-6 * np.sin(A))):
        x, y, angle, seat = at_tooth(0.0, -lower_by, 0.0)
        put(drive, x, y, angle)
        flank(drive, seat)
        np.testing.assert_allclose([drive.touches.right[0], drive.touches.left[0]], force, rtol=1e-6, atol=1e-9)


@pytest.mark.parametrize("across, out", [(0.0, -2e-5), (5e-5, -2e-5), (-1.2e-4, -3e-5), (0.28e-3, 0.3e-3), (-0.64e-3, 0.85e-3)])
def test_a_roller_is_as_deep_as_in_the_drawn_sprocket(across, out):
    wheel, psi, seat, angle = design_roller_sprocket(12, 9.525e-3, 6.35e-3, 0.7), 0.4, 0.93, 0.05
    profile = shapely.Polygon(wheel.outline().points(1e-9)).exterior  # a space on its y axis
    drawn = 0.5 * wheel.roller_diameter - profile.distance(shapely.Point(across, wheel.pitch_radius + out))
    drive = lowered(wheel.tooth, joint=design_link(9.525e-3, 0.0, A, 2e-4), offset=0.0)
    pin = 0.02 - 0.01j + (wheel.pitch_radius + out - 1j * across) * np.exp(1j * (psi + seat))
    middle = pin - drive.plates.half[0] * np.exp(1j * angle)
    put(drive, middle.real, middle.imag, angle, psi=psi)
    roller(drive, seat, dt=0.0)
    force = np.hypot(drive.touches.fx[0], drive.touches.fy[0])
    assert 1e-6 < drawn < 1e-4
    assert force / K == pytest.approx(drawn, abs=2e-9)


@pytest.mark.parametrize("name", ["both flanks", "belly", "roller seat"])
def test_damping_power_is_that_of_the_forces(name):
    tooth, guides, touch, pose, seat = CASES[name]
    joint = design_link(9.525e-3, 0.0, A, 2e-4) if tooth is ROLLER else JOINT
    still, moving = (
        lowered(
            tooth,
            tuple(Guide(g.centre, g.radius, g.start, g.end, g.side, g.distance, ChainContact(K, c)) for g in guides),
            damping=c,
            joint=joint,
        )
        for c in (0.0, 80.0)
    )
    v = np.array([0.02, -0.3, 4.0])
    for drive in (still, moving):
        put(drive, *pose, v=v, body=2 if guides else 0)
        drive.bodies.vx[:], drive.bodies.vy[:], drive.bodies.w[:] = 0.05, 0.11, 0.0 if guides else -3.0
        touch(drive, seat)
    extra = [
        (moving.touches.fx - still.touches.fx)[0],
        (moving.touches.fy - still.touches.fy)[0],
        (moving.plates.moment - still.plates.moment)[0],
    ]
    lost = moving.touches.power[0] if not guides else -moving.power[5]
    assert lost > 1e-3
    torque = (moving.touches.torque - still.touches.torque)[0]
    on_body = -0.05 * extra[0] - 0.11 * extra[1] + (0.0 if guides else -3.0 * torque)
    assert np.dot(extra, v) + on_body == pytest.approx(-lost, rel=1e-9)


@pytest.mark.parametrize("name", ["right flank", "left flank", "belly", "roller seat"])
def test_a_contact_acts_with_its_mean_over_the_step(name):
    tooth, guides, touch, pose, seat = CASES[name]
    drive = lowered(tooth, guides, joint=design_link(9.525e-3, 0.0, A, 2e-4) if tooth is ROLLER else JOINT)
    v, dt = np.array([0.0, -0.3, 0.0]), 4e-2  # through the whole depth within the step

    def depth(time):
        put(drive, *(np.array(pose) + time * v), body=2 if guides else 0)
        touch(drive, seat)
        return np.sqrt(2 * drive.touches.stored[0] / K)

    rate, here = (depth(1e-8) - depth(-1e-8)) / 2e-8, depth(0.0)
    put(drive, *pose, v=v, body=2 if guides else 0)
    drive.bodies.w[0] = 0.0
    touch(drive, seat, dt)
    t = drive.touches  # in so long a step the other flank comes near, too
    force = {"right flank": t.right[0], "left flank": t.left[0]}.get(name, np.hypot(t.fx[0], t.fy[0]))
    assert force == pytest.approx(mean_force(KelvinVoigt(K, 0.0), here, rate, dt)[1], rel=1e-4)
    assert abs(force / (K * here) - 1) > 0.05


def dampened(name, damping):
    """(drive of a case with damping in what it touches, its kernel, pose, seat, number of what it touches)."""
    tooth, guides, touch, pose, seat = CASES[name]
    guides = tuple(Guide(g.centre, g.radius, g.start, g.end, g.side, g.distance, ChainContact(K, damping)) for g in guides)
    drive = lowered(tooth, guides, damping=damping, joint=design_link(9.525e-3, 0.0, A, 2e-4) if tooth is ROLLER else JOINT)
    return drive, touch, pose, seat, 2 if guides else 0


def pressed(drive, name):
    t = drive.touches
    return {"right flank": t.right[0], "left flank": t.left[0]}.get(name, np.hypot(t.fx[0], t.fy[0]))


SINGLE = ["right flank", "left flank", "belly", "back", "roller seat", "roller flank"]


@pytest.mark.parametrize("name", SINGLE)
def test_damping_acts_for_the_part_of_the_step_in_contact(name):
    """c d' times the share of the way on which the depth is above 0, here 0.7, beside the mean of K d."""
    still, touch, pose, seat, body = dampened(name, 0.0)
    v, moving = np.array([0.0, -0.3, 0.0]), dampened(name, 90.0)[0]

    def depth(time):
        put(still, *(np.array(pose) + time * v), body=body)
        touch(still, seat)
        return np.sqrt(2 * still.touches.stored[0] / K)

    rate, here, forces = (depth(1e-8) - depth(-1e-8)) / 2e-8, depth(0.0), []
    for drive in (still, moving):
        put(drive, *pose, v=v, body=body)
        drive.bodies.w[0] = 0.0
        touch(drive, seat, here / (0.2 * rate))
        forces.append(pressed(drive, name))
    assert rate > 0.05 and forces[1] - forces[0] == pytest.approx(90.0 * rate * 0.7, rel=1e-4)


@pytest.mark.parametrize("name", SINGLE)
def test_no_contact_ever_pulls(name):
    """Left so fast that damping would hold the plate back: no force."""
    drive, touch, pose, seat, body = dampened(name, 1e5)
    put(drive, *pose, v=(0.0, 3.0, 0.0), body=body)
    drive.bodies.w[0] = 0.0
    touch(drive, seat)
    assert drive.touches.stored[0] > 0
    assert [drive.touches.fx[0], drive.touches.fy[0], drive.touches.torque[0], drive.plates.moment[0]] == [0.0] * 4
    assert (drive.touches.right[0], drive.touches.left[0]) == (0.0, 0.0)


def accelerations(drive):
    """Of eight plates under the loads that they have, (8, 3)."""
    plain(accelerate_plates)(drive.chain, drive.plates, drive.joints)
    return np.stack([row[:8] for row in (drive.plates.fx, drive.plates.fy, drive.plates.moment)], axis=-1)


def test_articulation_resists_the_turning_of_two_plates_against_each_other_alone():
    """c (w - w1) on one plate, the opposite on the other; the power lost is c (w - w1)^2."""
    quiet, drive = lowered(), lowered()
    drive = drive._replace(chain=drive.chain._replace(articulation_damping=2e-4))
    spin, turned = np.array([7.0, -4.0, 1.0, 2.5, -3.0, 6.0, 0.5, 9.0]), []
    for each in (quiet, drive):
        each.plates.w[:8], each.plates.w[8] = spin, spin[0]
        plain(load_gravity)(each.chain, each.plates, each.touches)
        plain(load_joints)(each.chain, each.plates, each.joints)
        turned.append(accelerations(each))
        plain(joint_damping_work)(each.chain, each.plates, each.joints, 1e-6)
    extra, against = np.diff(turned, axis=0)[0], spin - np.roll(spin, -1)
    np.testing.assert_allclose(6.4e-8 * extra[:, 2], 2e-4 * (np.roll(against, 1) - against), rtol=1e-6, atol=1e-9)
    np.testing.assert_array_equal(extra[:, :2], 0.0)
    np.testing.assert_allclose((drive.joints.power - quiet.joints.power)[:8], 2e-4 * against**2, rtol=1e-12)
    np.testing.assert_allclose(drive.joints.lost[:8], 1e-6 * 2e-4 * against**2, rtol=1e-12)


def test_a_sprocket_is_calm_at_its_own_rate():
    """Damping resists what differs from `reference_speed`: there the torque given is all that acts, elsewhere c (calm - w) besides."""
    chain = Chain(JOINT, 8, 2.5e-3, 6.4e-8, 3e6)
    free = Sprocket(INVOLUTE, ChainContact(K), (5.0, 0.0), inertia=0.4, torque=0.3, damping=0.02, reference_speed=-50.0)
    bodies = compile_model(ChainDrive(chain, (Sprocket(INVOLUTE, ChainContact(K), drive=SpeedRamp(1.0, 1.0)), free))).bodies
    for rate, moment in ((-50.0, 0.3), (-80.0, 0.3 + 0.02 * 30), (10.0, 0.3 - 0.02 * 60)):
        bodies.w[1] = rate
        assert plain(turn_acceleration)(bodies, 1) == pytest.approx(moment / 0.4, rel=1e-12)


def test_friction_on_a_guide_opposes_sliding_and_saturates():
    at = Guide((0.02, -0.01), 0.03, 0.0, np.pi, "inside", 4e-3, ChainContact(K), friction=0.3, slip=1e-3)
    drive = lowered(guides=(at,), offset=0.0)
    for speed in (2.0, -2.0):
        put(drive, 0.02, 0.02395, 0.0, v=(speed, 0.0, 0.0), body=2)
        drive.power[:] = 0.0
        guide(drive, 0.0)
        assert drive.touches.fy[0] == pytest.approx(K * 5e-5, rel=1e-9)
        assert drive.touches.fx[0] == pytest.approx(-np.sign(speed) * 0.3 * K * 5e-5, rel=1e-6)
        assert drive.power[FRICTION] == pytest.approx(-0.3 * K * 5e-5 * 2.0, rel=1e-6)
        assert drive.touches.torque[0] == pytest.approx(0.02995 * drive.touches.fx[0], rel=1e-9)


@pytest.mark.parametrize("side", [0, 1])
def test_friction_power_is_that_of_the_forces_on_a_turning_plate(side):
    rough, smooth = (
        lowered(guides=(Guide((0.02, -0.01), 0.03, 0.0, np.pi, GUIDES[side].side, 4e-3, ChainContact(K), friction=mu),))
        for mu in (0.3, 0.0)
    )
    v = np.array([0.4, 0.1, 30.0])
    for drive in (rough, smooth):
        put(drive, *CASES[("belly", "back")[side]][3], v=v, body=2)
        drive.power[:] = 0.0
        guide(drive, 0.0)
    extra = [
        (rough.touches.fx - smooth.touches.fx)[0],
        (rough.touches.fy - smooth.touches.fy)[0],
        (rough.plates.moment - smooth.plates.moment)[0],
    ]
    assert rough.power[FRICTION] < -1.0
    assert np.dot(extra, v) == pytest.approx(rough.power[FRICTION], rel=1e-9)
    x, y, angle = CASES[("belly", "back")[side]][3]
    contact = 0.02 - 0.01j + 0.03j * (1 - 2 * side) * np.exp(1j * angle)
    arm = contact - (x + 1j * y)
    assert extra[2] == pytest.approx(arm.real * extra[1] - arm.imag * extra[0], abs=3e-4 * np.hypot(*extra[:2]))


def test_joint_moments_are_the_slope_of_the_energy():
    drive = lowered()
    p, j, k = drive.plates, drive.joints, drive.chain.joint_stiffness

    def stored(turns):
        p.angle[:2] = turns
        for row, turned in ((p.c, np.cos(turns)), (p.s, np.sin(turns))):
            row[:2] = turned
        plain(load_joints)(drive.chain, p, j)
        return 0.5 * (j.fx[0] ** 2 + j.fy[0] ** 2) / k

    p.x[:2], p.y[:2] = (0.0, 9.6e-3), (0.0, -4e-4)
    turns = np.array([0.11, -0.23])
    slope = [(stored(turns + h) - stored(turns - h)) / 2e-6 for h in 1e-6 * np.eye(2)]
    stored(turns)
    moment = [-(j.mx[0] - p.x[i]) * j.fy[0] + (j.my[0] - p.y[i]) * j.fx[0] for i in (0, 1)]
    np.testing.assert_allclose([moment[0], -moment[1]], -np.array(slope), rtol=1e-6)


def test_a_guide_ends_where_its_arc_does():
    drive = lowered(guides=(Guide((0.02, -0.01), 0.03, np.pi / 2 + 0.1, np.pi, "inside", 4e-3, ChainContact(K)),), offset=0.0)
    for angle, touched in ((0.0, False), (0.2, True)):
        place = 0.02 - 0.01j + 0.03395j * np.exp(1j * angle)
        put(drive, place.real, place.imag, angle, body=2)
        guide(drive, 0.0)
        assert (drive.touches.stored[0] > 0) == touched


def test_joint_force_acts_where_the_pins_touch_and_turns_nothing_else():
    drive = lowered()
    p, random = drive.plates, np.random.default_rng(5)
    for row in (p.x, p.y, p.vx, p.vy):
        row[:9] = random.normal(0, 1e-2, 9)
    p.angle[:8] = random.normal(0, 0.3, 8)
    p.c[:8], p.s[:8] = np.cos(p.angle[:8]), np.sin(p.angle[:8])
    p.c[8], p.s[8], p.x[8], p.y[8], p.vx[8], p.vy[8] = p.c[0], p.s[0], p.x[0], p.y[0], p.vx[0], p.vy[0]
    drive = drive._replace(chain=drive.chain._replace(joint_damping=3.0))
    plain(load_gravity)(drive.chain, p, drive.touches)
    plain(load_joints)(drive.chain, p, drive.joints)
    a = accelerations(drive)
    turning = np.sum(2.5e-3 * (p.x[:8] * a[:, 1] - p.y[:8] * a[:, 0]) + 6.4e-8 * a[:, 2])
    assert abs(np.sum(2.5e-3 * a[:, 0])) < 1e-9 * np.max(np.abs(2.5e-3 * a))
    assert abs(turning) < 1e-11 * np.max(np.abs(2.5e-3 * a))
    d = p.x[0] + p.half[0] * p.c[0] + 0.7e-3 * p.s[0] - (p.x[1] - p.half[1] * p.c[1] + 0.7e-3 * p.s[1])
    mean = np.arctan2(p.s[0] + p.s[1], p.c[0] + p.c[1])
    quiet = drive._replace(chain=drive.chain._replace(joint_damping=0.0))
    plain(load_joints)(quiet.chain, p, quiet.joints)
    assert quiet.joints.fx[0] == pytest.approx(3e6 * (d - 2.4e-3 * np.cos(mean)), rel=1e-12)


def test_directions_turn_with_their_angles():
    drive = lowered()
    p = drive.plates
    p.angle[:], p.hw[:] = 0.3, np.linspace(-4e3, 4e3, p.angle.size)
    p.c[:], p.s[:] = np.cos(0.3), np.sin(0.3)
    for _ in range(5):
        plain(drift_plates)(drive.chain, p, 1e-6)
    np.testing.assert_allclose(p.c, np.cos(p.angle), rtol=0, atol=2e-15)
    np.testing.assert_allclose(p.s, np.sin(p.angle), rtol=0, atol=2e-15)


def test_a_ramp_is_smooth_and_its_angle_the_integral():
    drive = lowered()
    b = drive.bodies
    b.start[0], b.speed[0], b.ramp[0], b.psi0[0] = -20.0, -200.0, 0.01, 0.3
    psi, w = [], []
    time = np.linspace(0, 0.02, 4001)
    for t in time:
        plain(follow)(b, 0, t)
        psi.append(b.psi[0])
        w.append(b.w[0])
    assert (w[0], w[-1]) == (-20.0, -200.0)
    assert w[1000] == pytest.approx(-110.0, rel=1e-9)
    assert w[500] == pytest.approx(-20 - 180 * (0.25 - 1 / (2 * np.pi)), rel=1e-9)
    np.testing.assert_allclose(np.gradient(psi, time)[1:-1], w[1:-1], atol=0.02)
    np.testing.assert_allclose(psi[-1] - 0.3, -110 * 0.01 - 200 * 0.01, rtol=1e-12)


@pytest.mark.parametrize("direction", [0.0, 1.0, 2.5, 4.0])
def test_only_plates_within_reach_of_the_nearest_sprocket_are_looked_at(direction):
    drive = lowered()
    b, reach = drive.bodies, drive.teeth.reach[0]
    for share, found in ((0.99, True), (1.01, False)):
        x, y = b.x[0] + share * reach * np.cos(direction), b.y[0] + share * reach * np.sin(direction)
        b.x[1:], b.y[1:] = b.x[0] - 50 * reach * np.cos(direction), b.y[0] - 50 * reach * np.sin(direction)
        assert plain(near)(drive.chain, x, y, b, drive.teeth, drive.arcs, 0) == found
    b.x[1], b.y[1], drive.teeth.reach[1] = x, y, reach
    assert not plain(near)(drive.chain, x, y, b, drive.teeth, drive.arcs, 0)
