"""The chain in Exudyn: its forces are those of the kernels, its motion is ours, and a drive that differs a little is noticed."""

import sys
from dataclasses import replace

import numpy as np
import pytest
from chain_implicit_models import small, with_guides, with_rollers

import drivewright as dw
from drivewright import registry
from drivewright._jit import plain
from drivewright.chains.explicit.advance import find_candidates, load
from drivewright.chains.explicit.assembly import start
from drivewright.chains.explicit.simulate import Settings, chain_shapes, placed, running_start, simulate, tooth_time
from drivewright.chains.explicit.stability import largest_step
from drivewright.chains.explicit.step import accelerate_plates
from drivewright.chains.model import Slide, SpeedRamp, with_sprocket
from drivewright.chains.standards import pitch_diameter
from drivewright.errors import InputError
from drivewright.mechanisms.silent_chain.chain_drive import chain_drive
from drivewright.oracles.silent_chain import exudyn_rows
from drivewright.oracles.silent_chain.chain_forces import RollingJoints, ToothContacts, Wheels, plates_of, unknown

pytestmark = pytest.mark.property
MECHANISM = registry.mechanism("silent-chain")
SOFT = {"stiffness": 1e7, "joint": 3e6, "damping": 60.0}


def rolling(links=24, **changes):
    """Plates with a mass centre off their pins, unlike pitches, short flanks; a slide at an angle with a spring, under gravity."""
    deviations = tuple(2e-6 * np.sin(np.arange(links)))
    chain = {"gravity": (3.0, -9.81), "toe": 6e-3, "crotch": 0.2e-3, "articulation_damping": 2e-5, "deviations": deviations}
    model = small(**SOFT, **chain, links=links, torque=0.4, **changes)
    return with_sprocket(model, 1, slide=Slide(0.1, 150.0, 2e4, 80.0), damping=1e-3, reference_speed=-54.0)


def hinged(**changes):
    return with_rollers(**SOFT, torque=0.4, gravity=(3.0, -9.81), **changes)


DRIVES = pytest.mark.parametrize("make", [rolling, hinged])


def disturbed(model, seed=1):
    """The start, every pose and rate a little off."""
    begin, rng = start(model), np.random.default_rng(seed)
    count, sprockets = model.chain.count, len(model.sprockets)
    poses = begin.poses + rng.normal(size=(count, 3)) * [2e-5, 2e-5, 4e-3]
    rates = begin.rates + rng.normal(size=(count, 3)) * [0.02, 0.02, 4.0]
    slides = np.array([0.0, 0.03])
    return replace(begin, poses=poses, rates=rates, psi=begin.psi + 1e-3 * rng.normal(size=sprockets), rate_q=slides)


def kernel_loads(model, begin):
    """Loads on the plates (N, 3), forces along x and y and torque on the sprockets (sprockets, 3), by the kernels of a run."""
    drive = placed(model, begin, 1e-9)
    plain(find_candidates)(drive.chain, drive.plates, drive.touches, drive.bodies, drive.teeth, drive.arcs, drive.candidates)
    chain, p, b = drive.chain, drive.plates, drive.bodies
    plain(load)(chain, p, drive.joints, drive.touches, b, drive.teeth, drive.arcs, drive.candidates, drive.gravity, drive.power, 0.0)
    plain(accelerate_plates)(chain, p, drive.joints)
    n = chain.count
    return np.stack([chain.mass * p.fx[:n], chain.mass * p.fy[:n], chain.inertia * p.moment[:n]], axis=1), np.stack(
        [b.fx, b.fy, b.torque], 1
    )


@DRIVES
def test_forces_are_those_of_the_kernels(make):
    model = replace(make(), gravity=(0.0, 0.0))
    model = replace(model, chain=replace(model.chain, articulation_damping=0.0))  # Exudyn's own dampers
    for seed in (1, 2, 3):
        begin = disturbed(model, seed)
        expected, on_sprockets = kernel_loads(model, begin)
        offset, angle = model.chain.centre_offset, begin.poses[:, 2]
        up = offset * np.stack([-np.sin(angle), np.cos(angle), 0 * angle], axis=1)
        turned = np.stack([-up[:, 1], up[:, 0], 0 * angle], axis=1) * begin.rates[:, 2:]
        plates = plates_of(begin.poses + up, begin.rates + turned)
        along = np.exp(1j * model.sprockets[1].slide.direction)
        centre = np.array([0j, complex(*model.sprockets[1].centre) + begin.q[1] * along])
        wheels = Wheels(centre, begin.rate_q * np.array([0.0, along]), begin.psi, begin.rate_psi)
        loads = np.zeros((model.chain.count, 3))
        RollingJoints(model).add(plates, loads)
        force, moment = ToothContacts(model).add(plates, wheels, loads)
        size = np.max(np.abs(expected), axis=0)
        np.testing.assert_allclose(loads / size, expected / size, atol=1e-9)
        found = np.stack([force.real, force.imag, moment], axis=1)
        assert np.min(np.abs(on_sprockets[:, :2])) > 1.0
        np.testing.assert_allclose(found, on_sprockets, atol=1e-9 * np.max(np.abs(on_sprockets)))


def test_joints_turn_and_move_nothing_as_a_whole():
    model = rolling()
    begin = disturbed(model)
    loads = np.zeros((24, 3))
    plates = plates_of(begin.poses, begin.rates)
    RollingJoints(model).add(plates, loads)
    forces = loads[:, 0] + 1j * loads[:, 1]
    assert np.max(np.abs(forces)) > 10
    assert abs(forces.sum()) < 1e-10 * np.max(np.abs(forces))
    assert abs(np.sum((np.conj(plates.place) * forces).imag + loads[:, 2])) < 1e-10 * np.max(np.abs(forces))


@pytest.mark.needs_peers
@DRIVES
def test_the_motion_is_ours(make):
    """A twentieth of a tooth from a disturbed start: contacts that open and close leave an error of the first order in the step."""
    from drivewright.oracles.silent_chain import exudyn_model

    model = make()
    begin, duration = disturbed(model), 0.05 * tooth_time(model)
    misses = []
    for share in (0.2, 0.03):
        step = share * largest_step(model)
        run = exudyn_model.run(model, begin, duration, step, 10)
        motion = simulate(model, duration, Settings(step, run_in=0.0, samples_per_tooth=200), begin=begin)
        t, shapes = chain_shapes(model, begin, duration, step, 10)
        np.testing.assert_allclose(run.time, t, atol=1e-12)
        moved = np.ptp(shapes, axis=0).max(axis=0)
        slide, angle = motion.body(1, "q"), motion.body(1, "psi")
        own = (run.slides[-1, 1] - slide[-1]) / np.ptp(slide), (run.angles[-1, 1] - angle[-1]) / np.ptp(angle)
        misses.append([*(np.max(np.abs(run.plates - shapes), axis=(0, 1)) / moved), *np.abs(own)])
    assert np.all(np.array(misses[1]) < 2e-4)
    assert np.all(np.array(misses[1][:3]) < 0.4 * np.array(misses[0][:3]))


@pytest.mark.parametrize(
    ("model", "reason"),
    [
        (lambda: with_guides(small()), "guides"),
        (lambda: with_sprocket(small(), 0, drive=SpeedRamp(-60.0, 0.0, 0.01)), "a driver that changes its speed or slides"),
        (
            lambda: with_sprocket(small(), 1, contact=replace(small().sprockets[1].contact, law="hunt-crossley")),
            "a contact law that is not linear",
        ),
    ],
)
def test_what_the_twin_does_not_know(model, reason):
    assert unknown(model()) == reason


def test_the_twin_refuses_what_it_does_not_know():
    exudyn_model = pytest.importorskip("drivewright.oracles.silent_chain.exudyn_model", exc_type=ImportError)
    model = with_guides(small())
    with pytest.raises(InputError, match="the chain has guides; the Exudyn model supports"):
        exudyn_model.run(model, start(model), 1e-4, 1e-7, 2)


# -- rows ------------------------------------------------------------------------------------------------------------------------


@pytest.mark.needs_peers
@DRIVES
def test_means_agree_and_a_drive_that_differs_a_little_is_noticed(monkeypatch, make):
    from drivewright.oracles.silent_chain import exudyn_model

    monkeypatch.setattr(exudyn_rows, "MOST_STEPS", 400)
    model = make()
    begin = running_start(model, Settings(0.4 * largest_step(model), run_in=0.005))
    rows = tuple(exudyn_rows.means(exudyn_model, model, begin))
    assert [row[0].split(",")[0] for row in rows] == ["centre distance", "force of the tight strand", "force of the slack strand"]
    assert all(abs(ours - other) <= allowed for _, ours, other, _, allowed, _ in rows)
    assert all(allowed < 5e-3 * abs(ours) for _, ours, _, _, allowed, _ in rows)

    class Other:
        """Exudyn with teeth that are a little stiffer."""

        def run(self, drive, *how):
            contact = replace(drive.sprockets[1].contact, stiffness=1.03 * drive.sprockets[1].contact.stiffness)
            return exudyn_model.run(with_sprocket(drive, 1, contact=contact), *how)

    rows = tuple(exudyn_rows.means(Other(), model, begin))
    assert any(abs(ours - other) > allowed for _, ours, other, _, allowed, _ in rows)


@pytest.mark.needs_peers
def test_a_strand_swings_as_a_string():
    """Both engines find the same frequency, and a string's with half a pitch of doubt at each end."""
    from drivewright.oracles.silent_chain import exudyn_model

    model = rolling(links=36)
    begin = running_start(model, Settings(0.4 * largest_step(model)))
    strand = exudyn_rows.strand_of(model, begin, tight=True)
    tension = simulate(model, tooth_time(model), Settings(1e-6, joints=(strand.middle(begin),))).tension.mean()
    density, speed = model.chain.line_density, 60.0 * 9 * model.chain.link.pitch / (2 * np.pi)
    string = float(exudyn_rows.strand_frequency(tension, density, strand.length, speed))
    ours, theirs = exudyn_rows.frequencies(exudyn_model, model, begin, strand, string)
    assert theirs == pytest.approx(ours[-1], abs=10 * np.ptp(ours) + 1e-3)
    assert theirs == pytest.approx(string, rel=model.chain.link.pitch / strand.length)


def test_the_frequency_is_fitted_among_others():
    t = np.linspace(0.0, 0.06, 200)
    signal = 3.0 + np.cos(2 * np.pi * 33.7 * t + 0.4) + 0.05 * np.sin(2 * np.pi * 900 * t)
    assert exudyn_rows.fitted_frequency(t, signal, 30.0) == pytest.approx(33.7, rel=3e-4)
    assert exudyn_rows.fitted_frequency(t, signal - signal.mean(), 40.0) == pytest.approx(33.7, rel=3e-4)


def test_strands_are_the_tangents_and_their_middles_lie_on_the_chain():
    model = rolling()
    begin = start(model)
    tight, slack = (exudyn_rows.strand_of(model, begin, each) for each in (True, False))
    assert tight.start.imag < 0 < slack.start.imag
    for strand in (tight, slack):
        for number, foot in ((0, 0.0), (1, strand.length)):
            place = complex(*model.sprockets[number].centre) + begin.q[number] * np.exp(0.1j)
            seen = (place - strand.start) / strand.along
            assert seen.real == pytest.approx(foot, abs=1e-12)
            assert abs(seen.imag) == pytest.approx(0.5 * pitch_diameter(model.chain.link.pitch, 9 + number), rel=1e-12)
        s, across = strand.coordinates(begin.poses)
        middle = strand.middle(begin)
        assert abs(s[middle] - 0.5 * strand.length) < 0.5 * model.chain.link.pitch and abs(across[middle]) < 1e-3
        rate = exudyn_rows.plucked(begin, strand, 0.3, 3e-3).rates - begin.rates
        velocity = (rate[:, 0] + 1j * rate[:, 1]) / strand.along
        assert np.max(np.abs(velocity.real)) < 1e-12 and 0.28 < np.max(velocity.imag) <= 0.3
        assert velocity.imag[middle] == pytest.approx(0.3 * np.sin(np.pi * s[middle] / strand.length))


def spec(preset="default", *changes):
    return dw.load(MECHANISM.presets()[preset], changes)


def test_a_chain_that_exudyn_does_not_run_is_left_out_with_the_reason():
    assert exudyn_rows.missing_in_exudyn(chain_drive(MECHANISM.build(spec("default")))) == ""
    (left,) = exudyn_rows.rows(MECHANISM.build(spec("default", 'drive.ramp="10 ms"')))
    assert left == ("the running chain in Exudyn", "the Exudyn model does not support a driver that changes its speed or slides", "")


def test_more_than_two_sprockets_are_left_out_with_the_reason():
    drive = rolling()
    three = replace(drive, sprockets=(*drive.sprockets, drive.sprockets[0]))
    assert exudyn_rows.missing_in_exudyn(three) == "more than two sprockets"


def test_without_exudyn_its_rows_are_left_out_and_the_extra_is_named(monkeypatch):
    from drivewright.oracles import silent_chain

    monkeypatch.setitem(sys.modules, "exudyn", None)
    monkeypatch.delitem(sys.modules, "drivewright.oracles.silent_chain.exudyn_model", raising=False)
    monkeypatch.delattr(silent_chain, "exudyn_model", raising=False)
    (left,) = exudyn_rows.rows(MECHANISM.build(spec()))
    assert left.name == "the running chain in Exudyn" and "needs the extra 'peers'" in left.reason and left.extra == "peers"


@pytest.mark.slow
@pytest.mark.needs_peers
@pytest.mark.parametrize("preset", ["default", "roller"])
def test_running_presets_agree(preset):
    model = MECHANISM.build(spec(preset))
    rows = tuple(exudyn_rows.exudyn_rows(exudyn_rows.route(), model))
    assert [name.split(",")[0] for name, *_ in rows] == [
        "centre distance",
        "force of the tight strand",
        "force of the slack strand",
        "first frequency of the tight strand",
    ]
    assert [(name, ours, other) for name, ours, other, _, allowed, _ in rows if not abs(ours - other) <= allowed] == []
    assert all(allowed < 0.05 * ours for _, ours, _, _, allowed, _ in rows)
