"""The worked linkages by routes of their own: a five-bar by inverse kinematics and its bodies' equations, a press by statics."""

import numpy as np
import pytest
from places import EXAMPLES
from scipy.interpolate import CubicSpline

import drivewright as dw

pytestmark = pytest.mark.analytical

G = 9.81
CRANK, COUPLER, HALF = 0.15, 0.2, 0.06


def value(result, name):
    return result.values[name].value


# -- five-bar -----------------------------------------------------------------------------------------------------------------------


def tool_path(t):
    """The planned path of the tool [m]: 160 mm to the side over an arch, a rest, and back."""

    def rise(u):
        u = np.clip(u, 0.0, 1.0)
        return u**3 * (10 - 15 * u + 6 * u * u)

    q = rise(t / 0.4) - rise((t - 0.6) / 0.4)
    return np.stack([-0.08 + 0.16 * q, 0.24 + 0.04 * (4 * q * (1 - q)) ** 2], axis=-1)


def five_bar_poses(t):
    """Angles (m, 4) of left and right crank, left and right coupler, that bring the tool to its path."""
    place, angles = tool_path(t), []
    for side in (-1.0, 1.0):
        pivot = np.array([side * HALF, 0.0])
        reach = np.hypot(*(place - pivot).T)
        open_by = np.arccos((CRANK**2 + reach**2 - COUPLER**2) / (2 * CRANK * reach))
        crank = np.arctan2(place[:, 1], place[:, 0] - pivot[0]) - side * open_by
        elbow = pivot + CRANK * np.stack([np.cos(crank), np.sin(crank)], axis=-1)
        coupler = np.arctan2(place[:, 1] - elbow[:, 1], place[:, 0] - elbow[:, 0])
        angles += [crank, coupler]
    return np.unwrap(np.stack([angles[0], angles[2], angles[1], angles[3]], axis=-1), axis=0)


MASS, INERTIA, CENTRE = np.array([0.35, 0.35, 0.22, 1.02]), np.array([7.5e-4, 7.5e-4, 7.9e-4, 2.6e-3]), np.array([0.07, 0.07, 0.1, 0.178])
PINS = (  # (first body, its arm, second body, its arm, radius): bodies by number, -1 the ground
    (-1, -HALF, 0, 0.0, 0.01),
    (-1, HALF, 1, 0.0, 0.01),
    (0, CRANK, 2, 0.0, 0.006),
    (1, CRANK, 3, 0.0, 0.006),
    (2, COUPLER, 3, COUPLER, 0.006),
)


def five_bar_torques(time, mu, static, speed):
    """(m, 2) torques of the motors: Newton's and Euler's equations of the four bodies, with friction in the pins by repetition."""
    step = 1e-4
    spline = [five_bar_poses(time + k * step) for k in (-2, -1, 0, 1, 2)]
    angle = spline[2]
    rate = (spline[0] - 8 * spline[1] + 8 * spline[3] - spline[4]) / (12 * step)
    gain = (-spline[0] + 16 * spline[1] - 30 * spline[2] + 16 * spline[3] - spline[4]) / (12 * step**2)
    return np.array([_torques(*each, mu, static, speed) for each in zip(angle, rate, gain, strict=True)])


def _torques(angle, rate, gain, mu, static, speed):
    along = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    across = np.stack([-along[:, 1], along[:, 0]], axis=-1)

    def acceleration(arms):  # of points on the bodies, from the pin with which each begins
        return arms[:, None] * (gain[:, None] * across - rate[:, None] ** 2 * along)

    start = np.zeros((4, 2))
    start[2:] = acceleration(np.full(4, CRANK))[:2]
    centre = start + acceleration(CENTRE)
    friction, rates = np.zeros(5), np.append(rate, 0.0)
    for _ in range(60):
        matrix, right = np.zeros((12, 12)), np.zeros(12)
        for b in range(4):
            right[3 * b : 3 * b + 2] = MASS[b] * (centre[b] + [0.0, G])
            right[3 * b + 2] = INERTIA[b] * gain[b]
        for p, (first, at_first, second, at_second, _) in enumerate(PINS):  # force and friction on the first, the opposite on the second
            for body, arm, sign in ((first, at_first, 1.0), (second, at_second, -1.0)):
                if body < 0:
                    continue
                lever = (arm - CENTRE[body]) * along[body]
                matrix[3 * body, 2 * p] = matrix[3 * body + 1, 2 * p + 1] = sign
                matrix[3 * body + 2, 2 * p], matrix[3 * body + 2, 2 * p + 1] = -sign * lever[1], sign * lever[0]
                right[3 * body + 2] -= sign * friction[p]
        matrix[2, 10] = matrix[5, 11] = 1.0
        unknown = np.linalg.solve(matrix, right)
        forces = np.hypot(unknown[0:10:2], unknown[1:10:2])
        radius = np.array([pin[4] for pin in PINS])
        slip = np.array([rates[pin[0]] - rates[pin[2]] for pin in PINS]) * radius
        coefficient = mu + (static - mu) * np.exp(-((slip / speed) ** 2))
        friction = -np.sign(slip) * coefficient * radius * forces
    return unknown[10:]


@pytest.fixture(scope="module")
def arm():
    return dw.run(dw.load(EXAMPLES / "five_bar.toml"), only=["motion", "energy", "friction", "motors"])


def test_the_tool_goes_where_it_was_planned(arm):
    table = arm.tables["motion"]
    wanted = tool_path(table["time"].data)
    for k, axis in enumerate("xy"):
        np.testing.assert_allclose(table[f"tool.{axis}"].data, wanted[:, k], atol=2e-6)


def test_the_motors_give_what_the_bodies_and_their_pins_need(arm):
    table = arm.tables["drive"]
    time = table["time"].data
    moving = ((time > 0.03) & (time < 0.37)) | ((time > 0.63) & (time < 0.97))
    wanted = five_bar_torques(time[moving], 0.1, 0.15, 0.01)
    for k, side in enumerate(("left", "right")):
        found = table[f"torque_{side}"].data[moving]
        off = np.abs(found - wanted[:, k])
        assert np.percentile(off, 98) < 4e-3 * np.abs(wanted).max()  # but where a pin's sliding turns round between two samples


def test_sizing_of_the_motors_is_that_of_their_torques(arm):
    table, motion = arm.tables["drive"], arm.tables["motion"]
    time = table["time"].data
    torque = table["torque_left"].data
    assert value(arm, "drives.left.rms_torque") == pytest.approx(np.sqrt(np.trapezoid(torque**2, time) / time[-1]), rel=1e-3)
    assert value(arm, "drives.left.peak_torque") == pytest.approx(np.abs(torque).max(), rel=1e-3)
    speed = CubicSpline(motion["time"].data, five_bar_poses(motion["time"].data)[:, 0]).derivative()(time)
    assert value(arm, "drives.left.peak_speed") == pytest.approx(np.abs(speed).max(), rel=1e-3)
    assert value(arm, "drives.left.mean_power") == pytest.approx(np.trapezoid(torque * speed, time) / time[-1], abs=2e-3)


def test_what_the_motors_give_is_lost_in_the_pins(arm):
    """The tool comes back to where it started, at rest."""
    given = value(arm, "drives.left.mean_power") + value(arm, "drives.right.mean_power")
    assert value(arm, "friction.power") == pytest.approx(given, rel=1e-3)


# -- press --------------------------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def press():
    return dw.run(
        dw.load(EXAMPLES / "press_worn_pin.toml").replace({"simulate.turns": 4, "simulate.discard": 1}),
        only=["motion", "pins", "forces", "friction"],
    )


def test_under_the_sheet_the_pin_carries_its_force_and_the_guide_what_the_rod_leans(press):
    """Between the knocks: N = (F - m g + ...) sin/cos of the rod, and friction of the guide helps to hold the ram."""
    table = press.tables["forces"]
    angle = np.degrees(table["crank_angle"].data) % 360
    at = np.abs(angle - 163.0) < 0.5  # 0.302 s after the top dead centre, the sheet's force at its largest
    turned = np.radians(90 + angle[at])
    lean = 30 * np.cos(turned) / 240
    rod = (60e3 - 120 * G) / (np.sqrt(1 - lean**2) - 0.1 * np.abs(lean))
    assert np.median(table["wrist.force"].data[at]) == pytest.approx(np.median(rod), rel=0.02)
