"""Surge, jump and oil film in the results of a cam."""

import re

import numpy as np
import pytest
from places import EXAMPLES, ROOT
from scipy.interpolate import CubicHermiteSpline
from scipy.optimize import brentq

import drivewright as dw
from drivewright import cams, units
from drivewright.cams import PeriodicSurge, lift_harmonics
from drivewright.mechanisms.cam.build import build
from drivewright.mechanisms.cam.spec import CamSpec
from drivewright.numerics.jets import variable
from drivewright.spec import from_document

SEGMENTS = [
    {"angle": "65 deg", "law": "polynomial-4567", "rise": "9 mm"},
    {"angle": "65 deg", "law": "polynomial-4567", "rise": "-9 mm"},
    {"angle": "230 deg", "law": "dwell"},
]
TAPPET = {"face": "flat", "base_radius": "55 mm", "half_face": "18 mm"}
SPRING = {"stiffness": "35 N/mm", "preload": "350 N", "mass": "50 g", "damping_ratio": 0.02}
OIL = {"viscosity": "8 mPa s", "roughness": "0.25 um"}


def spec(speed="2400 rpm", spring=None, follower=None, lubricant=None, **tables):
    data = {
        "mechanism": "cam",
        "follower": follower or TAPPET,
        "programme": SEGMENTS,
        "drive": {"speed": speed},
        "load": {"mass": "0.11 kg"},
        "spring": {**SPRING, **(spring or {})},
        "lubricant": lubricant or OIL,
        **tables,
    }
    return from_document(data, CamSpec)


@pytest.fixture(scope="module")
def result():
    return dw.run(spec())


@pytest.mark.analytical
def test_values_of_the_spring(result):
    frequency = 0.5 * np.sqrt(35e3 / 0.050)
    assert result["surge.natural_frequency"] == pytest.approx(frequency, rel=1e-12)
    harmonic = round(frequency / 40)
    assert result["surge.harmonic"] == harmonic
    assert result["surge.resonance_speed"] == pytest.approx(2 * np.pi * frequency / harmonic, rel=1e-12)
    table = result.tables["surge"]
    assert table["spring_force"].data - table["static_force"].data == pytest.approx(table["surge_force"].data, abs=1e-9)
    assert result["surge.max_force"] == pytest.approx(np.max(np.abs(table["surge_force"].data)), rel=1e-3)
    assert result.check("spring_force").value == result["spring.min_force"] <= np.min(table["spring_force"].data)
    angle = np.linspace(0, 2 * np.pi, 20000, endpoint=False)
    lift = build(spec()).programme(angle).s
    amplitude = 2 * abs(np.mean(lift * np.exp(-1j * harmonic * angle)))
    assert result["surge.harmonic_lift"] == pytest.approx(amplitude, rel=1e-6)
    row = result.tables["surge_harmonics"]["lift"].data[harmonic - 1]
    assert row == pytest.approx(amplitude, rel=1e-6)


@pytest.mark.analytical
def test_surge_reaches_the_contact_force(result):
    """m s'' + k s + P + surge, over the turn."""
    surge = result.tables["surge"]
    angle = surge["angle"].data
    inner = slice(1, 130)
    motion, speed = build(spec()).programme(angle[inner]), 80 * np.pi
    force = 0.11 * motion.a * speed**2 + 35e3 * motion.s + 350 + surge["surge_force"].data[inner]
    assert result.tables["contact"]["contact_force"].data[inner] == pytest.approx(np.maximum(force, 0), rel=1e-9, abs=1e-6)
    assert dw.run(spec(), only=("energy",)).check("energy_audit").ok


@pytest.mark.property
def test_a_light_spring_does_not_surge():
    """Force of surge in proportion to the mass of a light spring, m y''/3; the jump speed that of a spring without mass."""
    light = [dw.run(spec(spring={"mass": mass}), only=("surge", "spring")) for mass in ("0.2 g", "0.1 g")]
    assert light[0]["surge.max_force"] / light[1]["surge.max_force"] == pytest.approx(2, rel=0.1)
    assert light[1]["spring.jump_speed"] == pytest.approx(light[1]["spring.jump_speed.without_surge"], rel=2e-3)


@pytest.mark.property
def test_jump_speed_with_surge_is_the_first_from_below(result):
    """Below it the contact holds at every speed, by the harmonics of the motion at each of them; just above it is open."""
    model, jump = build(spec()), result["spring.jump_speed"]
    lift = lift_harmonics(model.load_travel, 2048)
    angle = np.linspace(0, 2 * np.pi, 721)
    motion = model.programme(angle)

    def least(speed):
        surge = PeriodicSurge(model.surging_spring, lift, speed).harmonics.at(angle).d0
        return np.min(0.11 * motion.a * speed**2 + 35e3 * motion.s + 350 + surge)

    assert min(least(speed) for speed in np.linspace(0.2, 0.999, 400) * jump) > 0 > least(1.003 * jump)
    at = model.programme(result["spring.jump_speed.at"])
    assert at.a < 0  # the valve is brought back there
    check = result.check("jump_speed")
    assert check.ok == (jump >= 80 * np.pi) and f"{60 * jump / (2 * np.pi):.5g} rpm" in check.message


@pytest.mark.analytical
def test_preload_that_just_holds_the_contact():
    needed = dw.run(spec("4500 rpm"), only=("spring",))["spring.needed_preload"]
    at_limit = dw.run(spec("4500 rpm", spring={"preload": f"{needed!r} N"}), only=("spring",))
    assert needed > 350 and at_limit["min_required_force"] == pytest.approx(0, abs=1e-6)


@pytest.mark.analytical
def test_film_of_the_tappet(result):
    table, model = result.tables["film"], build(spec())
    angle = table["angle"].data
    motion = model.programme(angle % (2 * np.pi))
    inner = np.flatnonzero((angle > 0.02) & (angle < 2.2))
    speed = 0.5 * 80 * np.pi * (0.055 + motion.s + 2 * motion.a)
    assert np.abs(table["entrainment_speed"].data[inner]) == pytest.approx(np.abs(speed[inner]), rel=1e-9, abs=1e-9)
    # Typed out at one place: R = R0 + s + s'', flat face.
    k = inner[40]
    radius, stiff = 0.055 + motion.s[k] + motion.a[k], 210e9 / (1 - 0.3**2)
    force = result.tables["contact"]["contact_force"].data[k] / 0.010
    thickness = (
        2.65 * radius * (0.008 * abs(speed[k]) / (stiff * radius)) ** 0.7 * (18e-9 * stiff) ** 0.54 / (force / (stiff * radius)) ** 0.13
    )
    assert table["min_thickness"].data[k] == pytest.approx(thickness, rel=5e-3)
    assert table["film_ratio"].data[k] == pytest.approx(table["min_thickness"].data[k] / 0.25e-6, rel=1e-12)
    assert result["film.reversals"] == 4
    assert any("reverses at the cam angles" in finding for finding in result.findings)
    assert result["film.ratio"] == pytest.approx(result["film.at_peak_pressure"] / 0.25e-6, rel=1e-12)


@pytest.mark.property
def test_a_roller_has_no_reversal():
    roller = {"face": "roller", "roller_radius": "8 mm", "prime_radius": "35 mm"}
    found = dw.run(spec(follower=roller), only=("forces", "film"))
    assert found["film.reversals"] == 0 and not any("reverses" in finding for finding in found.findings)
    assert found["film.at_peak_pressure"] < found["film.central_at_peak_pressure"]
    knife = dw.run(spec(follower={"face": "knife", "prime_radius": "35 mm"}), only=("film",))
    assert any("film is absent" in finding for finding in knife.findings)


@pytest.mark.error
def test_a_follower_that_jumps_is_told_in_plain_words():
    found = dw.run(spec("6000 rpm"), only=("forces", "spring"))
    check = found.check("jump_speed")
    assert not check.ok and not found.ok
    assert check.message.startswith("the follower leaves the cam at ") and "at cam angle" in check.message
    assert any(finding.startswith("the follower leaves the cam over about") for finding in found.findings)


@pytest.mark.property
def test_jets_of_the_required_force_hold_the_slope_of_surge():
    model, theta, step = build(spec()), np.array([0.4, 0.9, 1.6]), 1e-6
    at = model.required(*model.cycle.at_angle(theta))
    sides = [model.required(*model.cycle.at_angle(theta + k * step)).d0 for k in (-1, 1)]
    assert at.d1 == pytest.approx((sides[1] - sides[0]) / (2 * step), rel=1e-5)
    assert model.surge.force(variable(theta)).d0.shape == theta.shape


@pytest.fixture(scope="module")
def example():
    return dw.run(dw.load(EXAMPLES / "valve_train.toml"))


@pytest.mark.analytical
def test_rocker_of_the_example_by_root_finding(example):
    """The swing at which the pad stands at the printed lift, to what half of its last digit makes of the swing."""
    text = (EXAMPLES / "valve_lift.csv").read_text().replace(",", ".").splitlines()[2:]
    rows = np.array([[float(cell) for cell in line.split(";")] for line in text])
    start, arm = np.radians(-7), 0.040
    swing = [brentq(lambda a, h=h: arm * (np.sin(start + a) - np.sin(start)) - h / 1e3, -0.1, 0.6) for h in rows[:, 1]]
    ours = build(example.spec).programme(np.radians(rows[:, 0])).s
    assert ours == pytest.approx(swing, abs=0.51e-6 / (arm * np.cos(0.13)))
    assert len(rows) == 131 and example.ok


@pytest.mark.analytical
def test_spring_force_of_the_example_by_its_modes(example):
    """60 modes as masses on springs, carried in time over the motion of the valve; the modes left out act as mass."""
    model, modes = build(example.spec), 60
    spring, speed = model.surging_spring, model.speed
    cycle = cams.Cycle(model.valve_motion)
    table = example.tables["surge"]
    angle = np.unique(table["angle"].data)[1:-1:5]
    left = np.pi**2 / 6 - np.sum(1 / np.arange(1, modes + 1) ** 2)
    force = 2 * spring.stiffness * left * speed**2 / spring.frequency**2 * cycle.at_angle(angle)[1].d2
    for n in range(1, modes + 1):
        response = cams.periodic_response(cycle, 1.0, speed, n * spring.frequency, spring.damping)
        places = np.flatnonzero(np.diff(response.angle, prepend=-1) > 0)
        error, rate = (part[places] for part in (response.error.d0, response.error.d1))
        force -= 2 * spring.stiffness * CubicHermiteSpline(response.angle[places], error, rate / speed)(angle)
    ours = np.interp(angle, table["angle"].data, table["surge_force"].data)
    assert ours == pytest.approx(force, abs=2e-3 * np.max(np.abs(force)))


ROCKER = {
    "motion": "oscillating",
    "face": "roller",
    "roller_radius": "9 mm",
    "prime_radius": "28 mm",
    "pivot_distance": "40 mm",
    "arm_length": "25 mm",
}


@pytest.mark.property
def test_surge_goes_through_the_ratio_of_the_rocker():
    """A surging spring at a valve whose rocker's ratio is far from 1: force at the cam, preload and jump speed that just hold."""
    given = spec("4000 rpm", follower=ROCKER, valve={"arm_length": "14 mm", "start_angle": "-35 deg"})
    model, found = build(given), dw.run(given, only=("spring", "forces", "surge"))
    angle, swing = model.cycle.sampled()
    quiet = model.path.force(swing, model.load, model.speed).d0
    ratio = 14 / 25 * np.cos(np.radians(-35) + swing.d0)
    assert model.required(angle, swing).d0 - quiet == pytest.approx(ratio * found.tables["surge"]["surge_force"].data, abs=1e-9)
    at_preload = build(given.replace({"spring.preload": f"{found['spring.needed_preload']!r} N"}))
    assert at_preload.cycle.minimum(at_preload.required).value == pytest.approx(0, abs=1e-6)
    at_jump = build(given.replace({"drive.speed": f"{found['spring.jump_speed']!r} rad/s"}))
    assert at_jump.cycle.minimum(at_jump.required).value == pytest.approx(0, abs=1e-3)


@pytest.mark.golden
def test_the_page_shows_the_numbers_of_the_example(example):
    """Every row of its table of values: within a unit of the last printed digit."""
    text = (ROOT / "docs" / "valve_train.md").read_text(encoding="utf-8")
    rows = re.findall(r"\| `([\w.]+)` \| (-?[\d.]+)(?: ([\w/^]+))? \|", text)
    assert len(rows) == 18
    for key, number, unit in rows:
        factor = units.exact_factor(unit) if unit else 1
        digits = len(number.partition(".")[2])
        assert example[key] / float(factor) == pytest.approx(float(number), abs=1.01 * 10.0**-digits), key
