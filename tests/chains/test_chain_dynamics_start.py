"""How a run begins: strands that do not swing, teeth and pitches taken on without a blow, whatever they are; a balance that adds up."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

from drivewright.chains.explicit.assembly import start
from drivewright.chains.explicit.measure import ROW
from drivewright.chains.explicit.simulate import Settings, chain_shapes, running_start, simulate, tooth_time
from drivewright.chains.link import design_link, seat_height, seat_support
from drivewright.chains.model import Chain, ChainContact, ChainDrive, Guide, Slide, SpeedRamp, Sprocket, with_sprocket
from drivewright.chains.tooth import Tooth

pytestmark = pytest.mark.property

PITCH, ANGLE = 9.525e-3, np.pi / 6


def drive(speed=-200.0, thick=0.0, stiffness=1e8, beta=2e-6, damping=300.0, angle=None, **chain):
    joint = design_link(PITCH, 1.2e-3, ANGLE, 2.6e-3)
    sprockets = []
    for z in (27, 29):
        tooth, height = Tooth(z, PITCH * z / (2 * np.pi) * np.cos(ANGLE), seat_support(joint, z) - thick), seat_height(joint, z)
        sprockets.append(Sprocket(tooth, ChainContact(stiffness), tip_radius=height - 1.9e-3, form_radius=height - 6.2e-3))
    return ChainDrive(
        Chain(joint, 72, 2.5e-3, 6.4e-8, stiffness / 3, beta, **{"toe": 6e-3, "crotch": 1.4e-3} | chain),
        (
            replace(sprockets[0], drive=SpeedRamp(speed, speed), angle=angle),
            replace(sprockets[1], centre=(0.2095, 0.0), mass=0.3, inertia=2e-4, slide=Slide(0.0, 150.0, damping=damping)),
        ),
    )


def swing(model, begin):
    """Largest distance of plates from the upper strand's straight line, while each of them runs along it, within a string's period."""
    free = begin.poses[(begin.poses[:, 1] > 0.0405) & (begin.poses[:, 0] > 0.02) & (begin.poses[:, 0] < 0.19)]
    line, wave = np.polyfit(free[:, 0], free[:, 1], 1), np.sqrt(begin.tension / model.chain.line_density)
    period, found = min(0.05, 2 * 0.2095 / (wave - begin.speed)), []
    for plate in begin.seated[0][-1] + np.array([1, 6, 11]):
        run = simulate(model, period, Settings(run_in=0.0, plate=int(plate), tolerance=1.0), begin=begin)
        x, y = run.column("x"), run.column("y")
        here = (x > 0.02) & (x < 0.19) & (y > 0.02)
        found.append(np.max(np.abs(y - np.polyval(line, x))[here]))
    return max(found)


def test_strands_do_not_swing_at_the_start():
    # the sprockets lift the strand's ends by the chordal rise, 0.28 mm; rates interpolated between its ends make that ten times as much
    model = drive()
    rise = 0.5 * PITCH * np.tan(0.5 * np.pi / 27)
    assert swing(model, start(model)) < 3 * rise


def test_all_plates_start_at_the_speed_of_the_chain():
    begin = start(drive())
    along = np.sum(begin.rates[:, :2] * np.stack([np.cos(begin.poses[:, 2]), np.sin(begin.poses[:, 2])], axis=1), axis=1)
    np.testing.assert_allclose(along, 200 * 27 * PITCH / (2 * np.pi), rtol=8e-3)
    np.testing.assert_allclose(begin.rates[begin.seated[1], 2], -200 * 27 / 29, rtol=1e-12)
    assert begin.speed == pytest.approx(200 * 27 * PITCH / (2 * np.pi), rel=1e-12)


def test_thick_teeth_are_taken_on_without_a_blow():
    model = drive(thick=2e-5, stiffness=1e9)
    struck, run = (simulate(model, 0.01, Settings(step=2e-7, run_in=t, tolerance=1.0)) for t in (0.0, 0.01))
    assert np.ptp(struck.column("kinetic")) > 0.05 * struck.column("kinetic")[0]
    assert np.ptp(run.column("kinetic")) < 0.03 * run.column("kinetic")[0]
    assert run.energy_drift < 2e-5
    assert run.body(1, "q")[0] < -2e-4  # the chain rides up on the flanks


def test_pitches_and_guides_are_their_own_when_the_clock_starts():
    pitches = tuple(np.random.default_rng(2).normal(0, 1e-5, 72))
    low, depths, pushes, angles = start(drive()).poses[:, 1].min(), (4e-3, 6.5e-3), [], []
    for depth in depths:
        guide = Guide((0.105, low - 3e-3 - 0.15 + depth), 0.15, np.pi / 2 - 0.4, np.pi / 2 + 0.4, "outside", 3e-3, ChainContact(1e7, 50.0))
        run = simulate(replace(drive(deviations=pitches), guides=(guide,)), 0.1, Settings(tolerance=3e-3))
        assert (run.t[0], run.rows[0, ROW.index("joint damping")]) == (0.0, pytest.approx(0.0, abs=1e-3))
        assert run.outcome == "complete", run.advice
        pushes.append(-run.mean(run.body(2, "fy")))
        # the strands run from the ends of the span at the angle a around the rail: (L/2) sin a + (R - depth) cos a = R
        angles.append(brentq(lambda a, depth=depth: 0.10475 * np.sin(a) + (0.15 - depth) * np.cos(a) - 0.15, 0.0, 0.3))
    assert pushes[1] - pushes[0] == pytest.approx(2 * 75.0 * np.ptp(np.sin(angles)), rel=0.15)


def test_the_clock_starts_with_the_first_sprocket_at_its_angle():
    for sense in (-1, 1):
        run = simulate(drive(sense * 200.0, angle=0.05), 0.002)
        assert run.body(0, "psi")[0] == pytest.approx(0.05, abs=1e-12)
        assert run.body(0, "psi")[-1] == pytest.approx(0.05 + sense * 200 * run.t[-1], abs=1e-9)


def test_without_damping_energy_is_kept():
    run = simulate(drive(speed=-20.0, beta=0.0, damping=0.0), 0.01, Settings(step=5e-7))
    assert np.min(run.column("contacts")) > 20
    assert run.energy_drift < 1e-6


def test_what_damping_takes_is_counted_exactly():
    # flanks that close and open leave an error of second order, 6e-7; work at predicted rates would leave a hundred times as much
    model = drive(speed=-20.0)
    model = with_sprocket(model, 0, contact=ChainContact(1e8, 100.0))
    run = simulate(model, 0.01)
    assert np.ptp(run.column("joint damping")) > 100 * np.max(np.abs(run.energy_gap))
    assert np.ptp(run.column("contact damping")) > 10 * np.max(np.abs(run.energy_gap))
    assert run.energy_drift < 3e-6


def test_a_run_goes_on_from_the_start_after_the_run_in():
    model = drive(stiffness=1e7, centre_offset=0.4e-3)
    settings = Settings(1e-6, run_in=0.01)
    whole = simulate(model, 0.5 * tooth_time(model), settings)
    begin = running_start(model, settings)
    later = simulate(model, 0.5 * tooth_time(model), replace(settings, run_in=0.0), begin=begin)
    assert np.ptp(whole.body(1, "q")) > 1e-7
    np.testing.assert_allclose(later.body(1, "q"), whole.body(1, "q"), atol=1e-4 * np.ptp(whole.body(1, "q")))
    for name in ("x", "y", "angle"):
        np.testing.assert_allclose(later.column(name), whole.column(name), atol=1e-5 * np.ptp(whole.column(name)))
    t, shapes = chain_shapes(model, begin, later.t[-1], later.step, len(later.t) - 1)
    np.testing.assert_allclose(t, later.t, rtol=1e-12)
    np.testing.assert_allclose(shapes[:, 0, 0], later.column("x"), atol=1e-12)
    np.testing.assert_allclose(shapes[:, 0, 2], later.column("angle"), atol=1e-10)
