"""The lever between its cams as a model of contact: energy, closed forms, units, and what play and speed do."""

import numpy as np
import pytest

from drivewright import registry
from drivewright.cams.clearance import LeverBetweenCams, roller_forces
from drivewright.contact import KelvinVoigt
from drivewright.mechanisms.seedling_pusher import dynamics
from drivewright.numerics.ode import integrate
from drivewright.runner import run
from drivewright.spec import load
from drivewright.units import SI

pytestmark = pytest.mark.property

PUSHER = registry.mechanism("seedling-pusher")
ARM, MASS, SWING, LEVER, BACK, STIFFNESS = 0.056, 0.2, 0.23, 0.0151, 0.0139, 2e7
PER_SWING = ARM / np.cos(SWING) ** 2  # travel of the rod per swing at rest
AHEAD = 1e-3  # rad/s, at the start


def still(damping=0.0, clearance=0.0, lost=(0.0, 0.0)):
    """A lever whose cams stand still, without push force; SWING, both leverages and what undercut has taken are constant."""
    values = np.array([SWING, 0.0, 0.0, LEVER, BACK, *lost])
    tables = np.zeros((7, 17, 2))
    tables[:, :, 0] = values[:, None]
    return LeverBetweenCams(KelvinVoigt(STIFFNESS, damping), tables, 1.0, ARM, MASS, 0.0, 0.3, clearance)


def fly(system, duration, samples=4001, rate=AHEAD):
    """(t, delta, its rate) from a push at the start."""
    t = np.linspace(0, duration, samples)
    run = integrate(system, 0.0, duration * (1 + 1e-12), [0.0, rate], rtol=1e-10, atol=[1e-16, 1e-13], samples=t, max_step=duration / 2000)
    return t, *run.y.T


def energy(system, delta, rate):
    """Rod (m g'^2 phi'^2 / 2) and both contacts."""
    per_swing = ARM / np.cos(SWING + delta) ** 2
    gaps = LEVER * delta + system.clearance, -BACK * delta + system.clearance
    return 0.5 * MASS * (per_swing * rate) ** 2 + sum(0.5 * STIFFNESS * np.minimum(gap, 0.0) ** 2 for gap in gaps)


def quarter(leverage):
    """Quarter period of the lever on one contact: (pi/2) sqrt(m g'^2 / (k leverage^2))."""
    return 0.5 * np.pi * np.sqrt(MASS * PER_SWING**2 / STIFFNESS) / leverage


def test_a_free_lever_swings_with_the_period_of_its_two_contacts():
    period = 2 * quarter(LEVER) + 2 * quarter(BACK)
    t, delta, _ = fly(still(), 9.2 * period)
    k = np.flatnonzero((delta[:-1] < 0) & (delta[1:] >= 0))
    upwards = t[k] - delta[k] * (t[k + 1] - t[k]) / (delta[k + 1] - delta[k])
    assert upwards == pytest.approx(period * np.arange(1, 10), rel=1e-4)
    amplitude = AHEAD * np.sqrt(MASS / STIFFNESS) * PER_SWING
    assert (delta.max(), -delta.min()) == pytest.approx((amplitude / BACK, amplitude / LEVER), rel=1e-4)


@pytest.mark.parametrize("clearance", [0.0, 2e-7])
def test_a_contact_without_damping_keeps_the_energy(clearance):
    system = still(clearance=clearance)
    t, delta, rate = fly(system, 0.05)
    total = energy(system, delta, rate)
    assert np.ptp(np.sign(rate)) == 2
    assert total == pytest.approx(np.full(len(t), total[0]), rel=1e-5)


@pytest.mark.parametrize("clearance", [0.0, 2e-7])
def test_a_contact_with_damping_only_takes_energy(clearance):
    system = still(damping=100.0, clearance=clearance)
    _, delta, rate = fly(system, 0.05)
    total = energy(system, delta, rate)
    assert np.max(np.diff(total)) < 1e-7 * total[0]
    assert total[-1] < 0.95 * total[0]


def test_play_lets_the_lever_fly_that_far_before_it_touches():
    system = still(clearance=5e-6)
    t, delta, rate = fly(system, 0.6, rate=2e-2)
    force = np.array([roller_forces(system, 0.0, d, v) for d, v in zip(delta, rate, strict=True)])
    flying = np.max(force, axis=1) == 0
    assert np.max(delta[flying]) == pytest.approx(5e-6 / BACK, rel=0.05)
    assert np.min(delta[flying]) == pytest.approx(-5e-6 / LEVER, rel=0.05)
    assert np.all(delta[force[:, 0] > 0] < -5e-6 / LEVER) and np.all(delta[force[:, 1] > 0] > 5e-6 / BACK)
    assert np.all(force >= 0) and not np.any((force[:, 0] > 0) & (force[:, 1] > 0))


@pytest.mark.parametrize(("side", "taken"), [(0, (3e-6, 0.0)), (1, (0.0, 3e-6))])
def test_what_undercut_has_taken_is_play_on_that_side_only(side, taken):
    system = still(lost=taken)
    pressed = [roller_forces(system, 0.0, delta, 0.0) for delta in (-2e-6 / LEVER, 2e-6 / BACK)]
    assert pressed[side] == (0.0, 0.0)
    assert pressed[1 - side][1 - side] == pytest.approx(STIFFNESS * 2e-6, rel=1e-9)
    deeper = [roller_forces(system, 0.0, delta, 0.0) for delta in (-5e-6 / LEVER, 5e-6 / BACK)]
    assert deeper[side][side] == pytest.approx(STIFFNESS * 2e-6, rel=1e-9)


# -- the drive -------------------------------------------------------------------------------------------------------------------


def simulate(*changes, preset="default"):
    """(peak force [N], largest rod error [m], share of the turn without contact) of the last turn."""
    model = PUSHER.build(load(PUSHER.presets()[preset], changes))
    run = dynamics.simulate(model)
    assert not run.trajectory.advice
    return run.peak_force, run.max_deviation, run.separation


def test_without_play_the_rod_follows_and_the_rollers_stay():
    for preset in ("default", "paper-mirrored", "design-b"):
        force, error, apart = simulate(preset=preset)
        assert error < 0.2e-3 and apart < 0.02
        assert 500 < force < 800  # 507 N (417, 470 N) without elasticity, and the shock of the resistance at the end of the push


def test_rod_error_is_the_travel_beyond_the_programme():
    model = PUSHER.build(load(PUSHER.presets()["design-b"], ["contact.clearance=0.1 mm"]))
    angle, _, _, error, run = dynamics.simulate(model)
    rod, arm = model.pair.travel(model.pair.start + angle).d0, model.spec.lever.output_arm
    assert error == pytest.approx(arm * np.tan(np.arctan2(rod, arm) + run.y[:, 0]) - rod, abs=1e-12)


@pytest.mark.parametrize(("preset", "expected"), [("default", [84, 342, 935]), ("paper-mirrored", [68, 295, 725])])
def test_peak_force_grows_with_speed(preset, expected):
    """Without elasticity 79 and 65 N at 100 rpm: the pressure angles make the difference."""
    forces = [simulate(f"drive.speed={rpm} rpm", "load.push_force=0 N", preset=preset)[0] for rpm in (100, 200, 300)]
    assert forces == pytest.approx(expected, rel=0.03)
    # Inertia grows with the square of the speed; vibration adds to it.
    assert 4 < forces[1] / forces[0] < 5 and 2.25 < forces[2] / forces[1] < 2.8


@pytest.mark.parametrize("preset", ["default", "paper-mirrored"])
def test_a_stiff_contact_needs_the_force_of_the_rigid_drive(preset):
    """Slowly and without resistance the peak force is that of kinematics: rod acceleration times mass over the leverage."""
    model = PUSHER.build(load(PUSHER.presets()[preset], ["drive.speed=50 rpm", "load.push_force=0 N", "contact.stiffness=1e8 N/m"]))
    angle, main, back, *_ = dynamics.simulate(model)
    t = model.pair.start + angle
    rod, swing = model.pair.travel(t), model.pair.swing(t)
    lever = model.spec.load.mass * rod.d2 * model.spec.drive.speed**2 * model.spec.lever.output_arm / np.cos(swing.d0) ** 2
    for cam, force in zip(model.pair.cams, (main, back), strict=True):
        rigid = np.maximum(cam.side * lever, 0.0) / (cam.arm * np.cos(model.pair.pressure_angle(cam, t).d0))
        assert force == pytest.approx(rigid, abs=0.12 * rigid.max())


@pytest.mark.parametrize("preset", ["default", "paper-mirrored", "design-b"])
def test_play_makes_the_rod_error_grow(preset):
    """Between the cams the rod is free by play over leverage, times travel per swing; impacts bend the contacts on top.

    The motion is chaotic: of fifteen draws the peak force of the largest play was 1.5 to 4.6 times that without.
    """
    plays = np.array([0, 0.02, 0.05, 0.1, 0.2])
    force, error, apart = np.transpose([simulate(f"contact.clearance={play} mm", preset=preset) for play in plays])
    assert np.all(np.diff(error[[0, 1, 3, 4]]) > 0)
    assert np.all(error[1:] > 3.5e-3 * plays[1:]) and np.all(error[1:] < 12e-3 * plays[1:] + 0.2e-3)
    assert apart[0] < 0.02 and np.all(apart[1:] > 0.4)
    assert np.max(force[3:]) > 1.2 * force[0]


def test_separation_and_rod_error_are_reported():
    result = run(load(PUSHER.presets()["default"], ["contact.clearance=0.1 mm"]), ("contact",))
    assert 0.4 < result["contact.separation"] < 0.98
    assert result["contact.peak_force"] == max(result["contact.main.peak_force"], result["contact.return.peak_force"])
    check = result.check("rod_error")
    assert check.value == result["contact.rod_error.max"] > 0.5e-3 and not check.ok


@pytest.fixture(scope="module")
def study():
    """The study of play on the published design."""
    return run(load(PUSHER.presets()["default"]), ("clearance",))


def test_the_study_of_play_says_what_it_does_to_the_force(study):
    """Ratio, mean and check belong together; without play it is the contact run, and the first row of the table."""
    tight, loose, ratio = (study[f"clearance.{name}"] for name in ("peak_force.tight", "peak_force", "force_ratio"))
    assert tight == pytest.approx(simulate()[0], rel=1e-12)
    assert ratio == pytest.approx(loose / tight, rel=1e-12) and ratio > 1.5
    value, check = study.values["clearance.force_ratio"], study.check("play")
    assert (check.value, check.low, check.high) == (value.value, value.low, value.high)
    assert check.limit == 2.0 and check.ok == (ratio <= 2.0)
    assert not run(load(PUSHER.presets()["default"], ["limits.play_force_ratio=1"]), ("clearance",)).check("play").ok


def test_means_of_the_study_of_play_carry_intervals_of_eight_starts(study):
    """Student's 95 % interval of eight runs that differ by a millionth of the play."""
    model = PUSHER.build(load(PUSHER.presets()["default"]))
    runs = [dynamics.simulate(model, 1e-4 * (1 + 1e-6 * number)) for number in range(8)]
    for name, numbers in (("peak_force", [each.peak_force for each in runs]), ("separation", [each.separation for each in runs])):
        value, half = study.values[f"clearance.{name}"], 2.364624 * np.std(numbers, ddof=1) / np.sqrt(8)
        found = (value.value, value.high - value.value, value.value - value.low)
        assert found == pytest.approx((np.mean(numbers), half, half), rel=1e-6)
        assert half > 0


def test_the_table_of_play_is_the_part_of_the_study_at_the_given_speed(study):
    play, whole = study.tables["play"], study.tables["clearance"]
    assert play["clearance"].data == pytest.approx([0, 25e-6, 50e-6, 75e-6, 100e-6], abs=1e-12)
    for column in play.columns:
        assert np.array_equal(column.data, whole[column.name].data[:5])
    assert play["peak_force"].data[0] == study["clearance.peak_force.tight"]
    assert np.all(np.diff(play["rod_error"].data[[0, 1, 4]]) > 0)


def test_other_units_of_length_mass_and_time_change_no_pure_number():
    length, mass, time = 1.9, 3.0, 0.7
    spec = load(PUSHER.presets()["design-b"])

    def scaled(table, factors):
        part = getattr(spec, table)
        return part.replace(**{name: SI(getattr(part, name) * factor) for name, factor in factors.items()})

    lengths = {
        "push": ("stroke",),
        "lever": ("pivot_distance", "arm_main", "arm_return", "output_arm", "rod_length"),
        "cams": ("prime_radius_main", "prime_radius_return", "roller_radius"),
        "arm": ("tip_distance",),
        "train": ("semi_major",),
    }
    changes = {table: scaled(table, dict.fromkeys(names, length)) for table, names in lengths.items()}
    changes["drive"] = scaled("drive", {"speed": 1 / time})
    changes["load"] = scaled("load", {"mass": mass, "push_force": mass * length / time**2})
    changes["contact"] = scaled("contact", {"stiffness": mass / time**2, "damping": mass / time})
    numbers = []
    for design in (spec, spec.replace(**changes)):
        model = PUSHER.build(design)
        run = dynamics.simulate(model)
        numbers.append(np.array([run.main.max(), run.back.max(), run.max_deviation, run.separation]))
    factors = np.array([mass * length / time**2, mass * length / time**2, length])
    assert numbers[1][:3] / numbers[0][:3] == pytest.approx(factors, rel=2e-3)
    assert numbers[1][3] == pytest.approx(numbers[0][3], abs=3 / len(run.angle))  # counted in samples
