"""The cam pair in Exudyn: the rod follows its programme, a wrong cam is seen, and our own contact model says the same."""

import numpy as np
import pytest

from drivewright import curves, registry
from drivewright.cli import main
from drivewright.mechanisms.seedling_pusher import dynamics
from drivewright.oracles.seedling_pusher.rolled_motion import RolledMotion
from drivewright.spec import load

pytestmark = [pytest.mark.property, pytest.mark.needs_peers]
PUSHER = registry.mechanism("seedling-pusher")


def model_of(preset, *changes):
    return PUSHER.build(load(PUSHER.presets()[preset], changes))


def rod_error(model):
    """(carrier angle since the start of the push, rod ahead of its programme [m], the run)."""
    from drivewright.oracles.seedling_pusher import exudyn_model as prototype

    run = prototype.simulate(model, RolledMotion(model).planet)
    return run.angle, run.travel - model.pair.travel(model.pair.start + run.angle).d0, run


@pytest.mark.parametrize(
    ("preset", "changes"),
    [
        ("default", []),
        ("paper-mirrored", []),
        ("design-b", ["cams.orbit=counter-clockwise"]),
        ("design-c", ["drive.speed=40 rpm", "push.law=modified-sine"]),
    ],
)
def test_the_rod_follows_its_programme(preset, changes):
    model = model_of(preset, *changes)
    angle, error, run = rod_error(model)
    assert np.max(np.abs(error)) < 0.06e-3
    assert np.ptp(run.travel) == pytest.approx(model.spec.push.stroke, abs=0.1e-3)
    assert np.ptp(run.swing) == pytest.approx(np.arctan(18 / (1e3 * model.spec.lever.output_arm)), abs=2e-3)
    assert run.travel == pytest.approx(model.spec.lever.output_arm * np.tan(run.swing), abs=1e-9)
    assert angle[-1] == pytest.approx(2 * np.pi, rel=1e-9)


def test_a_cam_for_another_stroke_is_seen():
    model = model_of("default")
    model.pair.__dict__["trimmed"] = model_of("default", "push.stroke=17.5 mm").pair.trimmed
    error = rod_error(model)[1]
    assert -0.6e-3 < error.min() < -0.4e-3


@pytest.mark.parametrize("preset", ["default", "paper-mirrored"])
def test_an_undercut_cam_lets_the_rod_fall_behind_by_what_it_has_lost(preset):
    """Main cam undercut: lost motion over leverage is a swing, times l / cos^2(swing) a travel of the rod.

    So slowly that the resistance of the push holds the roller on its cam while the programme slows the rod down.
    """
    model = model_of(preset, "train.start=far", "drive.speed=100 rpm")
    main, error = model.pair.cams[0], rod_error(model)[1]
    t = np.linspace(model.pair.start, model.pair.start + 2 * np.pi, 4001)
    swing = curves.profile_gap(model.pair.trimmed["main"], t) / (main.arm * np.cos(model.pair.pressure_angle(main, t).d0))
    behind = np.max(swing * model.spec.lever.output_arm / np.cos(model.pair.swing(t).d0) ** 2)
    assert behind > 1e-3
    assert -error.min() == pytest.approx(behind, abs=0.03e-3)


def test_our_own_contact_model_agrees():
    """A contact as stiff as Exudyn's is at these forces, about 1e8 N/m: both rods within 50 um of each other all over the turn."""
    model = model_of("default", "contact.stiffness=1e8 N/m", "contact.turns=1")
    angle, error, _ = rod_error(model)
    ours = dynamics.simulate(model)
    assert np.max(np.abs(error - np.interp(angle, ours.angle, ours.deviation))) < 0.05e-3


@pytest.mark.slow
def test_verify_prints_the_rod_error(capsys):
    with pytest.raises(SystemExit) as left:
        main(["verify", str(PUSHER.presets()["design-b"])])
    out = " ".join(capsys.readouterr().out.split())
    assert left.value.code == 0
    for words in ("independent route", "rod, stroke", "rod, furthest ahead", "rod, furthest behind", "lever.swing", "0.2 mm", "Exudyn"):
        assert words in out
