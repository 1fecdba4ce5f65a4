"""The closed form of the four-bar with massless links: tables of the ideal folder, Lagrange's equation, energy, the paper's load."""

import json
import subprocess
import sys

import numpy as np
import pytest
from places import SUPPORT

from drivewright._jit import plain
from drivewright.errors import DoesNotAssemble
from drivewright.numerics import jets
from drivewright.numerics.ode import integrate
from drivewright.oracles.linkage.four_bar_closed_form import (
    COUPLER_TURN,
    ROCKER_TURN,
    FourBar,
    LinkMotion,
    ideal_motion,
    impact_load,
    jacobian,
    link_accelerations,
    positions,
    rocker_acceleration,
    velocities,
)

pytestmark = pytest.mark.analytical

SPEED = 2 * np.pi * 28800 / 3600
ABOUT_PIVOT = 0.4487 - 6.883 * 0.243**2
START = np.array([0.1, 0.2, 3.0, 0.3])
SCRIPT = SUPPORT / "jax_folder.py"


def folder(clearance=2e-4, damping=0.0, rocker_inertia=ABOUT_PIVOT, first=0.0):
    """The knife folder of the press."""
    return FourBar(
        lengths=np.array([0.484, 0.066, 0.158, 0.424]),
        masses=np.array([1.0, 1.113, 6.883]),
        inertias=np.array([2316e-6, rocker_inertia]),
        centroids=np.array([0.0, 0.079, 0.243]),
        clearances=np.array([first, clearance, clearance, clearance]),
        body_damping=0.1,
        link_damping=damping,
    )


def uneven(**changes):
    """Nothing zero, nothing equal."""
    return folder(damping=1e-4)._replace(
        masses=np.array([1.3, 1.113, 6.883]),
        centroids=np.array([0.011, 0.07, 0.243]),
        clearances=np.array([1.5e-4, 2e-4, 2.5e-4, 1e-4]),
        centroid_damping=0.7,
        **changes,
    )


def states(count, seed=3):
    rng = np.random.default_rng(seed)
    return [(rng.uniform(0, 2 * np.pi), rng.uniform(0, 2 * np.pi, 4), rng.normal(0, 2 * SPEED, 4)) for _ in range(count)]


# -- ideal mechanism ---------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def turn():
    crank = np.linspace(0, 2 * np.pi, 360001)
    return crank, *ideal_motion(folder(), crank)


def test_ideal_angles(turn):
    _, e, _, _ = turn
    rocker, coupler = np.degrees(np.angle(-e[2]) % (2 * np.pi)), np.degrees(np.angle(e[1]))
    assert (rocker.min(), rocker.max()) == pytest.approx((188.8297, 207.5609), abs=5e-5)
    assert np.ptp(rocker) == pytest.approx(18.731243, abs=5e-7)
    assert (coupler.min(), coupler.max()) == pytest.approx((-82.8185, -31.0310), abs=5e-5)


def test_ideal_rates_and_accelerations(turn):
    crank, _, v, a = turn
    rocker, places = a[ROCKER_TURN].real, np.degrees(crank)
    assert (rocker.min(), rocker.max()) == pytest.approx((-0.220792, 0.175163), abs=5e-7)
    assert (places[rocker.argmin()], places[rocker.argmax()]) == pytest.approx((297.90, 172.81), abs=6e-3)
    assert np.abs(v[[ROCKER_TURN, COUPLER_TURN]]).max(axis=1) == pytest.approx([0.190342, 0.451690], abs=5e-7)
    assert np.abs(a[COUPLER_TURN]).max() == pytest.approx(0.529108, abs=5e-7)


@pytest.mark.parametrize(("speed", "angular", "tip"), [(10800, 78.449, 35.166), (28800, 557.857, 250.071), (41400, 1152.759, 516.749)])
def test_ideal_peaks_at_speed(turn, speed, angular, tip):
    """Knife tip: arm 0.161 m on the rocker at B, the angle between them 1.536 rad."""
    _, _, v, a = turn
    omega, reach = 2 * np.pi * speed / 3600, abs(0.424 - 0.161 * np.exp(1.536j))
    assert reach == pytest.approx(0.448271, abs=5e-7)
    assert np.abs(a[ROCKER_TURN]).max() * omega**2 == pytest.approx(angular, abs=5e-4)
    assert (reach * np.hypot(a[ROCKER_TURN].real, v[ROCKER_TURN].real ** 2)).max() * omega**2 == pytest.approx(tip, abs=5e-4)


def test_the_mirrored_assembly_moves_as_much(turn):
    _, _, _, a = turn
    crank, below = turn[0][::100], ideal_motion(folder()._replace(branch=-1.0), -turn[0][::100])
    e = positions(folder()._replace(clearances=np.zeros(4)), 0.7, START)
    other = positions(folder()._replace(clearances=np.zeros(4), branch=-1.0), -0.7, START)
    assert np.allclose(np.conj(e), other, rtol=0, atol=1e-15)
    assert below[2][ROCKER_TURN].real == pytest.approx(-a[ROCKER_TURN, ::100].real, abs=1e-12) and crank.size == 3601


@pytest.mark.parametrize(
    ("coupler", "rocker", "crank", "message"),
    [
        (0.1, 0.4, [0, 3.0], r"crank angle 171\.9° A and O4 are 0\.549\d* m apart.* 0\.3 to 0\.5 m"),
        (0.1, 0.55, [3.0, 0.1], r"crank angle 5\.7° A and O4 are 0\.418\d* m apart.* 0\.45 to 0\.65 m"),
    ],
)
def test_a_bar_that_cannot_turn_says_where(coupler, rocker, crank, message):
    short = folder()._replace(lengths=np.array([0.484, 0.066, coupler, rocker]))
    with pytest.raises(DoesNotAssemble, match=message):
        ideal_motion(short, np.array(crank))


# -- kinematics with links ---------------------------------------------------------------------------------------------------


def test_the_loop_closes():
    bar = uneven()
    for crank, alphas, _ in states(5):
        e2, e3, e4 = positions(bar, crank, alphas)
        loop = bar.lengths[1:] @ [e2, e3, e4] + bar.clearances @ np.exp(1j * alphas)
        assert abs(loop - bar.lengths[0]) < 1e-15 and abs(abs(e3) - 1) < 1e-14 and abs(abs(e4) - 1) < 1e-14


def jet_motion(bar, crank, alphas, rates, second, speed=SPEED):
    """Jets over time of (centroids of crank, coupler, rocker), coupler's and rocker's angle: from the positions alone."""
    e2 = jets.exp(1j * jets.Jet(crank, speed, 0.0, 0.0))
    links = [r * jets.exp(1j * jets.Jet(*each, 0.0)) for r, *each in zip(bar.clearances, alphas, rates, second, strict=True)]
    l1, l2, l3, l4 = bar.lengths
    d = l1 - l2 * e2 - links[0] - links[1] - links[2] - links[3]
    reach = jets.sqrt(d.abs2())
    x = (d.abs2() + (l4**2 - l3**2)) / (2 * l4 * reach)
    e4 = d / reach * (x + 1j * bar.branch * jets.sqrt(1 - x * x))
    e3 = (d - l4 * e4) / l3
    s2, s3, s4 = bar.centroids
    return (
        links[0] + s2 * e2,
        links[0] + l2 * e2 + links[1] + s3 * e3,
        l1 - links[3] - s4 * e4,
        jets.atan2(e3.imag, e3.real),
        jets.atan2(e4.imag, e4.real),
    )


@pytest.mark.parametrize("branch", [1.0, -1.0])
def test_ideal_motion_is_the_derivative_of_the_positions(branch):
    bar, crank = uneven(branch=branch), np.array([0.4, 2.0, 5.1])
    _, v, a = ideal_motion(bar, crank)
    zero = np.zeros(4)
    for n, angle in enumerate(crank):
        motion = jet_motion(bar._replace(clearances=zero), angle, zero, zero, zero, speed=1.0)
        assert v[:, n] == pytest.approx(np.array([each.d1 for each in motion]), rel=1e-11)
        assert a[:, n] == pytest.approx(np.array([each.d2 for each in motion]), rel=1e-10)


@pytest.mark.parametrize("branch", [1.0, -1.0])
def test_velocities_are_derivatives_of_the_positions(branch):
    bar = uneven(branch=branch)
    for crank, alphas, rates in states(5):
        e = positions(bar, crank, alphas)
        motion = jet_motion(bar, crank, alphas, rates, np.zeros(4))
        assert velocities(bar, e, SPEED, alphas, rates) == pytest.approx(np.array([each.d1 for each in motion]), rel=1e-11)
        still = jet_motion(bar, crank, alphas, np.zeros(4), np.zeros(4))
        unit = jet_motion(bar, crank, alphas, np.array([0, 1.0, 0, 0]), np.zeros(4))
        column = np.array([b.d1 - a.d1 for a, b in zip(still, unit, strict=True)])
        assert jacobian(bar, e, alphas)[1] == pytest.approx(column, abs=1e-12)


def test_the_rockers_acceleration_is_the_second_derivative_of_its_angle():
    bar = uneven()
    for crank, alphas, rates in states(5):
        second = link_accelerations(bar, crank, SPEED, alphas, rates)
        angle = jet_motion(bar, crank, alphas, rates, second)[4]
        assert rocker_acceleration(bar, crank, SPEED, alphas, rates) == pytest.approx(angle.d2, rel=1e-10)


# -- dynamics ----------------------------------------------------------------------------------------------------------------


def virtual_work(bar, crank, alphas, rates):
    """Work of all forces and inertia forces per alpha_j (4,), from jets: zero where the equation of motion holds."""
    second = link_accelerations(bar, crank, SPEED, alphas, rates)
    motion = jet_motion(bar, crank, alphas, rates, second)
    inertia = np.concatenate([bar.masses, bar.inertias])
    damping = np.repeat([bar.centroid_damping, bar.body_damping], [3, 2])
    weight = np.concatenate([1j * bar.gravity * bar.masses, np.zeros(2)])
    forces = [m * x.d2 + c * x.d1 + w for m, c, w, x in zip(inertia, damping, weight, motion, strict=True)]
    columns = jacobian(bar, positions(bar, crank, alphas), alphas)
    work = (columns.conj() @ forces).real + bar.link_damping * rates
    return work, np.abs(columns) @ np.abs(forces)


def test_the_virtual_work_vanishes():
    for state in states(8, seed=5):
        work, size = virtual_work(uneven(), *state)
        assert np.all(np.abs(work) < 1e-10 * size)


def test_ideal_pins_leave_their_links_alone():
    bar = uneven()._replace(clearances=np.array([0.0, 2e-4, 0.0, 1e-4]))
    crank, alphas, rates = states(1)[0]
    second = link_accelerations(bar, crank, SPEED, alphas, rates)
    work, size = virtual_work(bar, crank, alphas, rates * [0, 1, 0, 1])
    assert second[0] == second[2] == 0.0 and np.all(np.abs(work) < 1e-10 * (size + 1e-30))


def test_compiled_and_plain_agree():
    crank, alphas, rates = states(1)[0]
    compiled = link_accelerations(uneven(), crank, SPEED, alphas, rates)
    assert plain(link_accelerations)(uneven(), crank, SPEED, alphas, rates) == pytest.approx(compiled, rel=1e-12)


def energies(bar, y):
    """(kinetic, kinetic and potential) with a standing crank at angle 0."""
    motion = jet_motion(bar, 0.0, y[:4], y[4:], np.zeros(4), speed=0.0)
    kinetic = 0.5 * np.concatenate([bar.masses, bar.inertias]) @ np.abs([each.d1 for each in motion]) ** 2
    return kinetic, kinetic + bar.gravity * bar.masses @ [each.d0.imag for each in motion[:3]]


def test_energy_is_kept_while_the_crank_stands():
    """T + V without damping; with one kind of damping alone it falls."""
    base = uneven()._replace(body_damping=0.0, link_damping=0.0, centroid_damping=0.0)
    kept, *falling = (
        _energy_gained(base._replace(**change)) for change in ({}, {"body_damping": 0.1}, {"link_damping": 1e-6}, {"centroid_damping": 0.7})
    )
    assert abs(kept) < 1e-7 and max(falling) < -1e-3


def _energy_gained(bar):
    """Relative to the largest kinetic energy of the run, which trades it with the weight."""
    start = np.concatenate([START, [90.0, -40.0, 30.0, 60.0]])
    run = integrate(LinkMotion(bar, 0.0), 0.0, 0.05, start, 1e-10, 1e-12 * np.repeat([1.0, 100.0], 4)).checked()
    history = np.array([energies(bar, y) for y in run.y[::20]])
    assert np.ptp(history[:, 0]) > 0.1 * history[:, 0].max()
    return (energies(bar, run.y_end)[1] - energies(bar, start)[1]) / history[:, 0].max()


@pytest.mark.parametrize(
    ("rocker_inertia", "clearance", "damping", "coefficient", "rms"),
    [
        (ABOUT_PIVOT, 1e-4, 3e-5, 1.26804, 0.57814),
        (ABOUT_PIVOT, 2e-4, 1e-4, 1.65908, 0.58444),
        (ABOUT_PIVOT, 2e-4, 2e-4, 0.99409, 0.57614),
        (0.4487, 4e-4, 1e-3, 1.21328, 0.58116),
    ],
)
def test_impact_load_of_the_folder(rocker_inertia, clearance, damping, coefficient, rms):
    """An independent computation, printed to five digits, that looked at 4000 places per turn."""
    load = impact_load(folder(clearance, damping, rocker_inertia), SPEED, START, samples=4000)
    assert (load.coefficient, load.largest, load.rms) == pytest.approx((coefficient, coefficient, rms), abs=5.1e-6)


def test_impact_load_between_the_samples():
    """Every ninth of the fine samples: what the peaks lose is small, and none is gained."""
    coarse, fine = (impact_load(folder(1e-4, 3e-5), SPEED, START, samples=n) for n in (4000, 36000))
    assert coarse.coefficient < fine.coefficient < 1.002 * coarse.coefficient
    assert fine.coefficient == pytest.approx(1.269784, abs=1e-6)


# -- the same by automatic differentiation -----------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.needs_peers
def test_lagrange_by_automatic_differentiation():
    bars = [uneven(), uneven(branch=-1.0), folder(damping=1e-4)]
    cases = [
        {
            "bar": {name: np.asarray(value).tolist() for name, value in bar._asdict().items()},
            "speed": SPEED,
            "states": [{"crank": crank, "alphas": list(alphas), "rates": list(rates)} for crank, alphas, rates in states(10, seed)],
        }
        for seed, bar in enumerate(bars)
    ]
    done = subprocess.run([sys.executable, SCRIPT], input=json.dumps(cases), capture_output=True, text=True, check=False, timeout=120)
    assert done.returncode == 0, done.stderr
    for bar, case, answers in zip(bars, cases, json.loads(done.stdout), strict=True):
        for at, other in zip(case["states"], answers, strict=True):
            ours = link_accelerations(bar, at["crank"], SPEED, np.array(at["alphas"]), np.array(at["rates"]))
            assert np.linalg.norm(ours - other) < 2e-12 * np.linalg.norm(ours)
