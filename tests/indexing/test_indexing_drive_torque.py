"""Torque at the input for a dial table: closed forms, balance of energy, derivative of the kinetic energy, laws that jump or run back."""

import numpy as np
import pytest

from drivewright import motion
from drivewright.errors import InputError
from drivewright.indexing.drive_torque import TableLoad, drive_table, drive_torque
from drivewright.indexing.motion import TURN, IndexMotion, index_motion
from drivewright.motion.motor_sizing import mean_over_cycle, rms_over_cycle

J, SPEED, STATIONS, RATIO = 2.5, 7.0, 6, 0.5
ANGLE = TURN * RATIO / (1 + RATIO)
STEP = TURN / STATIONS


def moving(law="cycloidal", **parameters):
    return index_motion(law, STATIONS, RATIO, **parameters)


@pytest.mark.analytical
def test_peak_and_rms_of_the_cycloidal_law_have_their_closed_forms():
    """v a = 2 pi sin x (1 - cos x): largest 3 sqrt(3) pi/2 at 120 deg, mean square 4 pi^2 5/8 over the step."""
    found = drive_torque(moving(), TableLoad(J), SPEED)
    scale = J * SPEED**2 * STEP**2 / ANGLE**3
    assert np.max(found.input_torque) == pytest.approx(scale * 1.5 * np.sqrt(3) * np.pi, rel=2e-5)
    assert np.min(found.input_torque) == pytest.approx(-scale * 1.5 * np.sqrt(3) * np.pi, rel=2e-5)
    assert rms_over_cycle(found.time, found.input_torque) == pytest.approx(scale * TURN * np.sqrt(0.625 * ANGLE / TURN), rel=1e-9)
    assert np.max(found.table_torque) == pytest.approx(J * SPEED**2 * STEP * TURN / ANGLE**2, rel=2e-5)


@pytest.mark.analytical
def test_peak_of_the_modified_sine_is_its_published_factor():
    found = drive_torque(moving("modified-sine"), TableLoad(J), SPEED, points=3600)
    assert np.max(found.input_torque) == pytest.approx(5.4578 * J * SPEED**2 * STEP**2 / ANGLE**3, rel=1e-5)


@pytest.mark.analytical
def test_reflected_inertia_of_the_cycloidal_law():
    """J phi'^2: largest J (2 step/angle)^2, mean over the turn 3/2 J (step/angle)^2 angle/(2 pi)."""
    found = drive_torque(moving(), TableLoad(J), SPEED)
    assert np.max(found.felt_inertia) == pytest.approx(J * (2 * STEP / ANGLE) ** 2, rel=1e-9)
    assert mean_over_cycle(found.time, found.felt_inertia) == pytest.approx(1.5 * J * (STEP / ANGLE) ** 2 * ANGLE / TURN, rel=1e-9)


@pytest.mark.analytical
def test_friction_alone_is_its_torque_times_the_ratio():
    found = drive_torque(moving(), TableLoad(0.0, 30.0), SPEED)
    assert np.max(found.input_torque) == pytest.approx(30.0 * 2 * STEP / ANGLE)
    assert not np.any(found.input_torque[found.angle > ANGLE])


@pytest.mark.property
@pytest.mark.parametrize("law", ["modified-sine", "modified-trapezoid", "simple-harmonic", "polynomial-4567"])
@pytest.mark.parametrize("process", [0.0, -12.0, 9.0])
def test_work_at_the_input_is_that_of_friction_and_process(law, process):
    """What inertia takes it gives back: over a step (T_f + T_p) 2 pi/S are left."""
    found = drive_torque(moving(law), TableLoad(J, 20.0, process), SPEED)
    work = mean_over_cycle(found.time, found.input_torque) * TURN
    assert work == pytest.approx((20.0 + process) * STEP, rel=1e-4)


@pytest.mark.property
def test_work_up_to_any_angle_is_kinetic_energy_and_friction():
    found = drive_torque(moving("modified-sine"), TableLoad(J, 20.0), SPEED, points=7200)
    work = np.append(0.0, np.cumsum(0.5 * (found.input_torque[1:] + found.input_torque[:-1]) * np.diff(found.angle)))
    wanted = 0.5 * J * found.wheel_speed**2 + 20.0 * moving("modified-sine")(np.minimum(found.angle, TURN * (1 - 1e-15))).d0
    np.testing.assert_allclose(work, wanted, atol=1e-5 * np.max(wanted))


@pytest.mark.property
def test_torque_is_the_derivative_of_the_kinetic_energy():
    """Lagrange, at constant speed of the input: T = d/dtheta (1/2 J (phi' w)^2), by differences of the motion alone."""
    found, small = drive_torque(moving("polynomial-4567"), TableLoad(J), SPEED), 1e-5
    inside = (found.angle > 0.01) & (found.angle < ANGLE - 0.01)
    rates = [moving("polynomial-4567")(found.angle[inside] + sign * small).d1 for sign in (1, -1)]
    energy = [0.5 * J * (rate * SPEED) ** 2 for rate in rates]
    np.testing.assert_allclose(found.input_torque[inside], (energy[0] - energy[1]) / (2 * small), atol=1e-6 * np.max(found.input_torque))


@pytest.mark.property
def test_inertia_grows_with_the_square_of_the_speed_and_friction_not():
    slow, fast = (drive_torque(moving(), TableLoad(J, 20.0, 3.0), speed) for speed in (SPEED, 2 * SPEED))
    rubbing = drive_torque(moving(), TableLoad(0.0, 20.0, 3.0), SPEED)
    np.testing.assert_allclose(fast.input_torque - rubbing.input_torque, 4 * (slow.input_torque - rubbing.input_torque), atol=1e-9)
    np.testing.assert_allclose(fast.time, slow.time / 2)


@pytest.mark.property
def test_law_whose_acceleration_jumps_starts_with_the_whole_torque():
    """Simple harmonic: from the first instant J pi^2/2 step/angle^2 and friction."""
    found = drive_torque(moving("simple-harmonic"), TableLoad(J, 20.0), SPEED)
    assert found.table_torque[0] == pytest.approx(J * SPEED**2 * np.pi**2 / 2 * STEP / ANGLE**2 + 20.0)
    assert found.table_torque[-1] == 0.0
    joint = np.flatnonzero(np.diff(found.angle) == 0)
    assert len(joint) == 1 and found.table_torque[joint[0]] < 0 == found.table_torque[joint[0] + 1]


@pytest.mark.property
def test_friction_turns_with_the_motion():
    """A wheel that swings back before it goes on rubs all the way."""
    law = motion.law("spline", points=((0.0, 0.0), (0.2, -0.1), (0.8, 1.1), (1.0, 1.0)))
    found = drive_torque(IndexMotion(law, STATIONS, ANGLE), TableLoad(0.0, 20.0), SPEED)
    way = np.sum(np.abs(np.diff(law(np.linspace(0, 1, 20001)).s))) * STEP
    assert way > 1.3 * STEP
    assert mean_over_cycle(found.time, found.input_torque) * TURN == pytest.approx(20.0 * way, rel=1e-3)
    assert np.min(found.input_torque) >= 0


@pytest.mark.interface
def test_table_tells_the_power():
    found = drive_torque(moving(), TableLoad(J, 20.0), SPEED)
    table = drive_table(found, SPEED)
    np.testing.assert_allclose(table["input_power"].data, table["table_torque"].data * table["wheel_speed"].data, atol=1e-9)


@pytest.mark.error
@pytest.mark.parametrize(
    ("load", "speed", "words"),
    [
        (TableLoad(-1.0), 1.0, "inertia = -1 kg m.2; it must be 0 or more"),
        (TableLoad(1.0, -2.0), 1.0, "friction_torque = -2 N m"),
        (TableLoad(1.0), 0.0, "speed of the input is 0 rad/s"),
    ],
)
def test_what_is_no_table_is_refused(load, speed, words):
    with pytest.raises(InputError, match=words):
        drive_torque(moving(), load, speed)
