"""Wear of a bearing: volumes, frames, limits, and the worn wall in the contact."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from drivewright.mechanisms.linkage import analyses
from drivewright.multibody.analyses import wear
from drivewright.multibody.assembly import assemble
from drivewright.multibody.model import GROUND, Body, Dry, Friction, JointDrive, Marker, MultibodyModel, Revolute, line
from drivewright.multibody.observe import PIN_FIELDS, observe
from drivewright.multibody.simulate import Settings, simulate

pytestmark = pytest.mark.analytical

PLAY, RADIUS, LENGTH, STIFF = 1e-3, 0.01, 0.02, 1e8
K = 3e-14
TURN = 2 * np.pi


def rotor(clearance=PLAY, bearing="ground", friction=0.1, hysteresis=0.2, exponent=1.5):
    """A driven crank with a bob on a pin with play; the bearing is in the crank, or in the bob."""
    dry = Dry(clearance, RADIUS, STIFF, exponent, hysteresis, length=LENGTH, friction=Friction("coulomb", friction, 0.05))
    ends = (Marker("crank", 0.05), Marker("bob", 0.002, 0.001))
    return MultibodyModel(
        (Body("crank", 1.0, 1e-3), Body("bob", 0.3, 2e-4, (0.03, 0.0))),
        (Revolute("O", Marker(GROUND), Marker("crank")), Revolute("P", *(ends if bearing == "ground" else ends[::-1]), dry)),
        drives=(JointDrive("O", line(0.2, 60.0)),),
        gravity=(0.0, -9.81),
    )


def run(assembly, duration=0.05, rtol=1e-8):
    return simulate(assembly, duration, Settings(rtol=rtol, per_step=2))


def bumps(bins=90):
    return 5e-6 * (1.5 + np.sin(2 * np.arange(bins) * TURN / bins) + 0.4 * np.cos(np.arange(bins) * TURN / bins))


def states(assembly):
    """A state in contact for every direction of the journal, the approach remembered: (states, angles in the bearing's frame)."""
    system, state = assembly.system, assembly.state
    free, angles = system.bodies.free[2], np.linspace(0.1, TURN, 17)
    found = np.tile(state, (17, 1))
    spot = list(system.stored)
    found[:, spot.index(free)] += (PLAY + 3e-5) * np.cos(angles)
    found[:, spot.index(free + 1)] += (PLAY + 3e-5) * np.sin(angles)
    found[:, -2:] += (3.0, 0.0)
    found[:, system.contacts.memory[0]] = 0.5
    return found, angles


def pin(assembly, found):
    return dict(zip(PIN_FIELDS, np.moveaxis(observe(assembly.system, np.zeros(len(found)), found).pins[:, 0], 1, 0), strict=True))


def test_a_profile_of_zero_depth_changes_no_bit():
    one, two = run(assemble(rotor())), run(wear.with_wear(assemble(rotor()), 0, np.zeros(36)))
    np.testing.assert_array_equal(one.end[2], two.end[2])
    np.testing.assert_array_equal(one.impacts, two.impacts)
    assert len(one.impacts) > 0


def test_even_wear_is_a_larger_clearance_but_for_the_stiffness():
    assembly = assemble(rotor())
    found, _ = states(assembly)
    worn = pin(wear.with_wear(assembly, 0, np.full(36, 1e-5)), found)
    wide = pin(assemble(rotor(PLAY + 1e-5)), found)
    for field in PIN_FIELDS:
        np.testing.assert_allclose(worn[field], wide[field], rtol=1e-9, atol=1e-12)
    assert np.sum(worn["normal"] > 0) > 10  # where it flies off fast, nothing pulls
    assert np.all(worn["depth"] < pin(assembly, found)["depth"] - 0.9e-5)


def test_the_depth_is_read_in_the_frame_of_the_bearing_and_the_force_is_its_gradient():
    assembly = assemble(rotor(friction=0.0, hysteresis=0.0))
    found, angles = states(assembly)
    depth = np.zeros(72)
    depth[10:14] = 1e-5
    worn, plain = (pin(one, found) for one in (wear.with_wear(assembly, 0, depth), assembly))
    taken = plain["depth"] - worn["depth"]
    crank = 0.2  # the drive's angle
    places = np.mod(angles - crank, TURN) * 72 / TURN
    np.testing.assert_array_equal(taken > 1e-12, (places > 8.5) & (places < 14.5))
    assert np.sum(taken > 1e-12) == 1 or np.sum(taken > 1e-12) == 2
    smooth = wear.with_wear(assembly, 0, bumps())
    step = 1e-8
    spot = [list(smooth.system.stored).index(smooth.system.bodies.free[2] + k) for k in (0, 1)]
    for k, field in zip(spot, ("fx", "fy"), strict=True):
        energy = []
        for sign in (-1, 1):
            moved = found.copy()
            moved[:, k] += sign * step
            energy.append(0.4 * STIFF * pin(smooth, moved)["depth"] ** 2.5)
        np.testing.assert_allclose(pin(smooth, found)[field], (energy[1] - energy[0]) / (2 * step), rtol=1e-5, atol=1e-2)


def test_a_bouncing_journal_keeps_its_energy_in_a_worn_bearing():
    still = replace(rotor(friction=0.0, hysteresis=0.0, bearing="bob"), drives=(JointDrive("O", line(0.2, 0.0)),), gravity=(0.0, 0.0))
    bob = replace(still.bodies[1], velocity=(0.7, -0.3), angular_velocity=9.0)
    assembly = wear.with_wear(assemble(replace(still, bodies=(still.bodies[0], bob))), 0, 3 * bumps())
    moved = run(assembly, 0.05, 1e-10)
    assert len(moved.impacts) > 10
    energies = []
    for t, y in ((0.0, assembly.state), moved.end[1:]):
        seen = observe(assembly.system, [t], y[None])
        _, _, _, vx, vy, w = seen.bodies[0, 2, :6]
        energies.append(0.15 * (vx**2 + vy**2) + 1e-4 * w**2 + 0.4 * STIFF * max(seen.pins[0, 0, 0], 0.0) ** 2.5)
    assert energies[1] == pytest.approx(energies[0], rel=1e-6)


# -- the analysis on a record by hand ------------------------------------------------------------------------------------------


class Seen:
    """A record: contact at angles (in the bearing, which turns), force and slip over time."""

    def __init__(self, t, angle, force, slip, turning):
        self.t, self.turned = t, turning
        world = angle + turning
        zeros = np.zeros_like(t)
        columns = {
            "depth": zeros,
            "normal": force,
            "friction": zeros,
            "slip": slip,
            "nx": -np.cos(world),
            "ny": -np.sin(world),
            "fx": force,
            "fy": zeros,
            "drag": zeros,
            "spin": zeros,
        }
        self.pins = np.stack([columns[name] for name in PIN_FIELDS], axis=1)[:, None]

    def point(self, name, field):
        assert (name, field) == ("bearing of P", "angle")
        return self.turned


MODEL = SimpleNamespace(pins=["P"], period=0.5, turn_length=0.5, window_start=0.0, markers={}, outputs=(), ensemble=1)


def bearing(coefficient=K, cycles=1000, jumps=1):
    return wear.WearingBearing("P", "crank", RADIUS, LENGTH, PLAY, coefficient, cycles, jumps, 90)


def test_the_volume_of_a_turn_is_that_of_force_and_slip():
    t = np.linspace(0.0, 1.0, 4001)  # two turns
    seen = Seen(t, 1.0 + 0.7 * np.sin(9 * t), 20 + 15 * np.cos(5 * t), 0.3 * np.sin(4 * t), 60 * t)
    depth = wear.depth_per_turn(seen, MODEL, bearing())
    volume = K * np.trapezoid((20 + 15 * np.cos(5 * t)) * np.abs(0.3 * np.sin(4 * t)), t) / 2
    assert np.mean(depth) * TURN * RADIUS * LENGTH == pytest.approx(volume, rel=1e-9)
    places = np.arange(90) * TURN / 90
    assert np.all(depth[(places < 0.2) | (places > 1.8)] == 0) and np.min(depth[(places > 0.4) & (places < 1.6)]) > 0


def test_a_load_that_goes_round_evenly_in_the_bearing_wears_it_evenly():
    t = np.linspace(0.0, 0.5, 36001)
    seen = Seen(t, TURN * 2 * t, np.full_like(t, 50.0), np.full_like(t, -0.4), 0.3 + 5 * np.sin(20 * t))
    depth = wear.depth_per_turn(seen, MODEL, bearing())
    np.testing.assert_allclose(depth, K * 50 * 0.4 * 0.5 / (TURN * RADIUS * LENGTH), rtol=3e-3)


def test_growth_of_the_clearance_is_half_of_both_sides():
    depth = np.zeros(8)
    depth[1], depth[5], depth[3] = 4e-6, 2e-6, 5e-6
    assert wear.clearance_growth(depth) == pytest.approx(3e-6)
    assert wear.clearance_growth(np.full(7, 2e-6)) == pytest.approx(2e-6)


@pytest.fixture
def answer(monkeypatch):
    """Answer of the analysis with real runs of the rotor."""

    def ask(coefficient=K, cycles=1000, jumps=1):
        run = {"assembly": assemble(rotor()), "run_length": 0.05, "settings": Settings(per_step=2), "period": 0.05, "turn_length": 0.05}
        return wear.wear(SimpleNamespace(**vars(MODEL) | run), bearing(coefficient, cycles, jumps))

    return ask


def test_twice_the_coefficient_over_half_the_turns_is_the_same_wear(answer):
    one, two = answer(K, 1000), answer(2 * K, 500)
    np.testing.assert_allclose(two.tables[0]["last"].data, one.tables[0]["last"].data, rtol=1e-12)
    assert one.values["wear.P.max_depth"].value > 0
    assert one.values["wear.P.cycles"].value == 1000 and two.values["wear.P.cycles"].value == 500
    assert one.values["wear.P.volume"].value == pytest.approx(1000 * one.tables[1]["volume_per_turn"].data[0], rel=1e-12)


def test_jumps_add_up_and_feed_back(answer):
    scale = 3e-5 / answer(K, 1000).values["wear.P.max_depth"].value  # so that a jump of 1000 turns takes off 30 um
    found = answer(scale * K, 2000, 2)
    history, profile = found.tables[1], found.tables[0]
    np.testing.assert_array_equal(history["cycles"].data, [0.0, 1000.0])
    assert history["max_depth"].data[1] == pytest.approx(3e-5, rel=1e-9)
    assert history["volume"].data[1] == pytest.approx(1000 * history["volume_per_turn"].data[0], rel=1e-12)
    assert found.values["wear.P.volume"].value == pytest.approx(1000 * np.sum(history["volume_per_turn"].data), rel=1e-12)
    assert history["volume_per_turn"].data[1] != history["volume_per_turn"].data[0]  # the worn bearing runs otherwise
    assert np.max(profile["first"].data) == pytest.approx(3e-5, rel=1e-9)
    assert np.all(profile["last"].data >= profile["first"].data)


def test_no_coefficient_no_wear(answer):
    found = answer(0.0, 3000, 3)
    assert not np.any(found.tables[0]["last"].data)
    assert len(set(found.tables[1]["max_force"].data)) == 1  # the three runs are the same to the last bit
    assert found.findings == ()


def test_steep_profiles_and_long_jumps_are_told(answer):
    joint = bearing()
    assert wear._findings(joint, bumps(), 1e-6) == ()
    steep, far = wear._findings(joint, 20 * bumps(), 2e-4)
    assert "slopes of" in steep and "clearance of 1 mm" in steep
    assert "0.2 mm, 0.2 times the clearance" in far and "increase jumps" in far


@pytest.mark.parametrize(
    ("changes", "reason"), [({"pin": "lubricated"}, "'P' is lubricated"), ({"wear_coefficient": None}, "has no wear_coefficient")]
)
def test_what_does_not_wear_is_named(changes, reason):
    joint = SimpleNamespace(name="P", pin="dry", wear_coefficient=K)
    spec = SimpleNamespace(joints=[joint], wear=SimpleNamespace(joint="P"), simulate=None, period=0.5)
    assert analyses._no_wear(spec) is None
    spec.joints = [SimpleNamespace(**vars(joint) | changes)]
    assert reason in analyses._no_wear(spec)
    spec.wear = None
    assert "[wear]" in analyses._no_wear(spec)
