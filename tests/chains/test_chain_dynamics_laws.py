"""What no number can change: conserved quantities of a free ring, the order of the step, the same drive elsewhere or turned."""

from dataclasses import replace

import numpy as np
import pytest

from drivewright._jit import plain
from drivewright.chains.explicit.advance import run, settle_rates
from drivewright.chains.explicit.measure import PLATE, ROW, measured
from drivewright.chains.explicit.simulate import Settings, simulate
from drivewright.chains.explicit.snapshots import PLATES, empty_snapshots
from drivewright.chains.explicit.state import compile_model
from drivewright.chains.link import design_link, seat_support
from drivewright.chains.model import Chain, ChainContact, ChainDrive, Slide, SpeedRamp, Sprocket
from drivewright.chains.tooth import Tooth

pytestmark = pytest.mark.property

PITCH, ANGLE, N = 9.525e-3, np.pi / 6, 14


def ring(radius=1.2e-3, beta=0.0, offset=0.0, seed=3, articulation=0.0):
    """A free ring of plates, shaken and turning, far from two sprockets."""
    joint = design_link(PITCH, radius, ANGLE, 2e-4)
    tooth = Tooth(9, 0.0118, -5e-3)
    chain = Chain(joint, N, 2.5e-3, 6.4e-8, 1e6, beta, centre_offset=offset, articulation_damping=articulation)
    far = [Sprocket(tooth, ChainContact(1e6), (9.0 + k, 9.0), inertia=1.0, drive=SpeedRamp(1.0, 1.0) if k == 0 else None) for k in (0, 1)]
    drive, random = compile_model(ChainDrive(chain, tuple(far))), np.random.default_rng(seed)
    p, turn = drive.plates, 2 * np.pi / N
    angle = -turn * np.arange(N)
    height = (0.5 * joint.hole_pitch * np.cos(turn / 2) - radius) / np.sin(turn / 2)
    place = 0.03 + 0.01j + (height + offset) * 1j * np.exp(1j * angle)
    velocity = 5j * (place - 0.03) + random.normal(0, 0.05, N) + 1j * random.normal(0, 0.05, N) + 0.4 - 0.2j
    rows = (place.real, place.imag, np.cos(angle), np.sin(angle), velocity.real, velocity.imag, 5 + random.normal(0, 3, N))
    for row, value in zip((p.x, p.y, p.c, p.s, p.vx, p.vy, p.w), rows, strict=True):
        row[:N], row[N] = value, value[0]
    p.angle[:N] = angle
    p.hx[:], p.hy[:], p.hw[:] = p.vx, p.vy, p.w
    p.hx[N:], p.hy[N:], p.hw[N:] = 0.0, 0.0, 0.0
    return drive


def rows_of(drive, samples, every, dt):
    snapshots = empty_snapshots(samples, 2, N)
    settle_rates(drive, dt)
    run(drive, snapshots, 0, samples, every, 50.0, dt)
    rows = measured(drive, snapshots, (0,), 0).rows
    return {name: rows[:, k] for k, name in enumerate(ROW)}


@pytest.mark.parametrize("offset", [0.0, 1.3e-3])
@pytest.mark.parametrize("beta", [0.0, 3e-6])
@pytest.mark.parametrize("articulation", [0.0, 1e-5])
def test_a_free_ring_keeps_both_momenta(beta, offset, articulation):
    seen = rows_of(ring(beta=beta, offset=offset, articulation=articulation), 40, 25, 1e-6)
    for name in ("momentum x", "momentum y", "angular momentum"):
        assert np.ptp(seen[name]) < 1e-12 * np.max(np.abs(seen[name])), name
    assert np.ptp(seen["potential"]) > 1e-5  # the ring does move


def test_the_watched_plate_moves_as_its_pins_push_it():
    drive, dt, i = ring(), 1e-6, 5
    snapshots = empty_snapshots(20, 2, N)
    settle_rates(drive, dt)
    run(drive, snapshots, 0, 20, 10, 50.0, dt)
    log, rows = measured(drive, snapshots, tuple(range(N)), i), {name: snapshots.plates[:, k, i] for k, name in enumerate(PLATES)}
    plate = {name: log.plate[:, k] for k, name in enumerate(PLATE)}
    push = (plate["left x"] + plate["right x"] + 1j * (plate["left y"] + plate["right y"])) * np.exp(1j * plate["angle"])
    gained = 2 * 2.5e-3 / dt * (rows["hx"] - rows["vx"] + 1j * (rows["hy"] - rows["vy"]))
    np.testing.assert_allclose(push, gained, atol=1e-5 * np.max(np.abs(push)))
    assert 0 < np.sum(log.tension < 0) < log.tension.size
    np.testing.assert_array_equal(log.rows[:, ROW.index("open joints")], np.sum(log.tension <= 0, axis=1))


def test_energy_is_kept_to_second_order_in_the_step():
    gaps = []
    for halved in (1, 2, 4):
        seen = rows_of(ring(), 40, 20 * halved, 2e-6 / halved)
        energy = seen["kinetic"] + seen["potential"]
        gaps.append(np.max(np.abs(energy - energy[0])) / np.max(seen["kinetic"]))
    order = np.log2(np.array(gaps[:-1]) / np.array(gaps[1:]))
    np.testing.assert_allclose(order, 2.0, atol=0.15)


@pytest.mark.parametrize("damping", [{"beta": 3e-6}, {"articulation": 1e-5}, {"beta": 3e-6, "articulation": 1e-5}])
def test_damping_takes_what_energy_the_ring_loses(damping):
    seen = rows_of(ring(**damping), 60, 25, 1e-6)
    energy = seen["kinetic"] + seen["potential"]
    lost = energy - energy[0]
    assert lost[-1] < -1e-3 * energy[0]
    np.testing.assert_allclose(seen["joint damping"] - seen["joint damping"][0], lost, atol=2e-3 * abs(lost[-1]))


def test_a_rolling_radius_towards_nothing_is_a_hinge():
    places = [rows_of(ring(radius=r), 3, 100, 1e-6)["potential"][-1] for r in (1e-9, 0.0, 1e-3)]
    assert places[0] == pytest.approx(places[1], rel=1e-5)
    assert abs(places[2] / places[1] - 1) > 1e-3


def test_compiled_and_plain_kernels_agree():
    compiled, twin = ring(), ring()
    rows_of(compiled, 2, 5, 1e-6)
    settle_rates(twin, 1e-6)
    plain(run)(twin, empty_snapshots(2, 2, N), 0, 2, 5, 50.0, 1e-6)
    np.testing.assert_allclose(twin.plates.x[:N], compiled.plates.x[:N], rtol=1e-14)
    np.testing.assert_allclose(twin.plates.hw[:N], compiled.plates.hw[:N], rtol=1e-9)


# ------------------------------------------------------------------------------------------------------------------ drives


def drive(turn=0.0, shift=(0.0, 0.0), scale=1.0, offset=0.0):
    """Nine and ten teeth, 24 links; `scale` stretches time: rates 1/scale, forces and stiffness 1/scale^2."""
    joint = design_link(PITCH, 1.2e-3, ANGLE, 2e-4)
    teeth = [Tooth(z, PITCH * z / (2 * np.pi) * np.cos(ANGLE), seat_support(joint, z)) for z in (9, 10)]
    chain = Chain(joint, 24, 2.5e-3, 6.4e-8, 3e6 / scale**2, 2e-6 * scale, centre_offset=offset, toe=4e-3)
    contact = ChainContact(1e7 / scale**2, 5.0 / scale)
    slide = Slide(turn, 150.0 / scale**2, 1e4 / scale**2, 200.0 / scale)
    centre = (shift[0] + 0.0692 * np.cos(turn), shift[1] + 0.0692 * np.sin(turn))
    return ChainDrive(
        chain,
        (
            Sprocket(teeth[0], contact, shift, angle=turn, drive=SpeedRamp(-150 / scale, -150 / scale)),
            Sprocket(teeth[1], contact, centre, mass=0.2, inertia=2e-5, torque=0.3 / scale**2, damping=1e-3 / scale, slide=slide),
        ),
    )


@pytest.fixture(scope="module")
def reference():
    return simulate(drive(), 0.006)


def test_turned_and_shifted_the_drive_runs_the_same(reference):
    elsewhere = simulate(drive(0.7, (0.31, -0.2)), 0.006)
    np.testing.assert_allclose(elsewhere.body(1, "q"), reference.body(1, "q"), atol=2e-10)
    np.testing.assert_allclose(elsewhere.tension, reference.tension, atol=2e-3)
    np.testing.assert_allclose(elsewhere.transmission_error(1), reference.transmission_error(1), atol=1e-8)


def test_time_can_be_stretched(reference):
    slow = simulate(drive(scale=3.0), 0.018, Settings(step=3e-6, run_in=0.06))
    np.testing.assert_allclose(slow.body(1, "q"), reference.body(1, "q"), atol=2e-10)
    np.testing.assert_allclose(9 * slow.column("kinetic"), reference.column("kinetic"), rtol=1e-6)
    np.testing.assert_allclose(9 * slow.tension, reference.tension, atol=2e-3)


def test_action_and_reaction_of_every_body(reference):
    assert max(reference.momentum_residual) < 1e-11
    assert max(simulate(drive(offset=1e-3), 0.003).momentum_residual) < 1e-11


def test_energy_adds_up(reference):
    assert reference.energy_drift < 1.2e-4  # a second; a revolution of the chain takes 0.11 s
    assert np.ptp(reference.column("contact damping")) > 100 * np.max(np.abs(reference.energy_gap))


def test_settings_of_the_samples(reference):
    assert reference.per_tooth * 9 * 150 / (2 * np.pi) * (reference.t[1] - reference.t[0]) == pytest.approx(1.0, rel=1e-12)
    assert reference.t[-1] >= 0.006
    assert replace(reference.settings, settle=0.001).settle == 0.001
