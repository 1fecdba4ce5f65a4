"""Chains with tensioners, guides and fixed shafts, from the spec on: the worked example, what goes wrong and how it is told, the scene."""

import re

import numpy as np
import pytest
from places import EXAMPLES, ROOT

import drivewright as dw
from drivewright import registry, units
from drivewright.chains.explicit.turning import turning
from drivewright.chains.path import route
from drivewright.chains.wear import path_articulations
from drivewright.errors import InputError, SpecError
from drivewright.mechanisms.silent_chain.chain_drive import bare_drive, chain_drive
from drivewright.runner import build

pytestmark = pytest.mark.analytical

EXAMPLE = EXAMPLES / "tensioned_chain.toml"
ROW = re.compile(r"\| `([\w.]+)` \| (-?[\d.]+)(?: ([^|]+?))? \|")
SHORT = ('dynamics.settling="0.1 s"', 'dynamics.duration="0.1 s"', "dynamics.ensemble=1")
BLADE = """
format = 1
mechanism = "silent-chain"
pitch = "9.525 mm"
links = 82
teeth = [35, 37]
[joint]
kind = "round-pin"
rolling_radius = "1.2 mm"
[plate]
apothem = "2.6 mm"
[drive]
speed = "1000 rpm"
load_torque = "5 N m"
[driven]
centre_distance = "218 mm"
[[guides]]
name = "blade"
centre = ["110 mm", "257 mm"]
radius = "200 mm"
start = "240 deg"
end = "300 deg"
friction = 0.1
force = "60 N"
direction = "-90 deg"
pivot = ["20 mm", "75 mm"]
lever = "90 mm"
stiffness = "1 N/mm"
damping = "100 N s/m"
mass = "60 g"
[[guides]]
name = "rail"
centre = ["110 mm", "220 mm"]
radius = "280 mm"
start = "255 deg"
end = "285 deg"
side = "inside"
"""


def load(*changes):
    return dw.load(EXAMPLE, changes)


def run(only, *changes):
    return dw.run(load(*changes), only=only)


@pytest.fixture(scope="module")
def blade(tmp_path_factory):
    path = tmp_path_factory.mktemp("blade") / "blade.toml"
    path.write_text(BLADE)
    return path


@pytest.fixture(scope="module")
def whole():
    return dw.run(load())


# ------------------------------------------------------------------------------------------------------------- the worked example


def test_every_check_of_the_example_passes(whole):
    assert whole.outcome == "complete" and whole.ok
    assert {"running.tooth_contacts", "running.slack", "running.jumped_teeth", "tensioner.idler.travel", "guide.rail.reach", "settled"} <= {
        check.name for check in whole.checks
    }


def test_the_running_chain_is_that_of_the_balance(whole):
    assert whole["dynamics.tensioner.idler.travel.mean"] == pytest.approx(whole["layout.tensioner.idler.travel"], rel=0.02)
    assert whole["dynamics.tensioner.idler.force"] == pytest.approx(40.0 - 2e3 * whole["dynamics.tensioner.idler.travel.mean"], rel=1e-9)
    for name in ("drive", "idler", "driven", "rail"):
        expected = whole[f"layout.pull.{name}"] + whole["strand.centrifugal_force"]
        assert whole[f"dynamics.strand.{name}.tension"] == pytest.approx(expected, rel=0.01)
    difference = whole["dynamics.strand.driven.tension"] - whole["dynamics.strand.idler.tension"]
    assert difference == pytest.approx(8.0 * 2 * np.pi / (38 * 9.525e-3), rel=0.005)


def test_the_page_shows_the_numbers_of_the_example(whole):
    rows = ROW.findall((ROOT / "docs/tensioned_chain.md").read_text(encoding="utf-8"))
    assert len(rows) > 5
    for key, number, unit in rows:
        digits = len(number.partition(".")[2])
        assert whole.values[key].value / float(units.exact_factor(unit)) == pytest.approx(float(number), abs=1.01 * 10.0**-digits), key


def test_tables_and_plots_are_those_of_a_tensioner(whole):
    assert {"tensioners", "motion_spectrum", "rigid_travel", "running"} <= set(whole.tables)
    table = whole.tables["tensioners"]
    assert table["force"].data == pytest.approx(40.0 - 2e3 * table["travel"].data, rel=1e-12)
    assert set(table["tensioner"].data) == {"idler"}
    shown = {plot.name for plot in registry.mechanism("silent-chain").plots(whole)}
    assert {"tensioners", "motion_spectrum", "rigid_travel"} <= shown and "spectrum" not in shown


# ---------------------------------------------------------------------------------------------------------------- its wear

WEAR = 'wear.coefficient="2e-7 mm^3/(N m)"'


@pytest.mark.parametrize("changes", [(), ("guides=[]", "sprockets.0.teeth=10"), ("guides=[]", 'driven.centre_distance="319 mm"')])
def test_a_joint_turns_as_much_as_in_the_rigid_chain_that_is_followed_over_a_tooth(changes):
    """All joints of the chain over one tooth are one joint over a revolution; in the last two the idler is wrapped by less than a tooth."""
    model = build(load(*changes))
    drive = bare_drive(model)
    found = turning(drive, -np.linspace(0.0, 2 * np.pi / model.teeth[0], 401), model.balance)
    angles = found.plates[:, :, 2]
    bends = np.angle(np.exp(1j * (np.roll(angles, -1, axis=1) - angles)))
    turned = np.sum(np.abs(np.diff(bends, axis=0)))
    rigid = model.balance._replace(route=route(drive, model.balance.route.stations, np.mean(found.q[1:], axis=0)))
    assert turned == pytest.approx(sum(turn.angle for turn in path_articulations(rigid)), rel=3e-3)


def test_wear_counts_the_tensioner_and_the_rail():
    found = run(("layout", "wear"), WEAR)
    assert found.outcome == "complete" and found["layout.wrap.idler"] > 2 * np.pi / 15
    model = build(load())
    rail = 2 * np.arctan(0.5 * 9.525e-3 / (300e-3 + model.roller_link.end_radius))  # between two plates that lie on it
    angles = np.array([2 * np.pi / 19, 2 * np.pi / 15, 2 * np.pi / 38, rail])
    assert found["wear.sliding"] == pytest.approx(3.28e-3 * np.sum(angles), rel=1e-12)
    pulls = np.array([found[f"layout.pull.{name}"] for name in ("drive", "idler", "driven", "rail")]) + model.balance.centrifugal
    depth = 2e-16 * np.sum(angles * (pulls + np.roll(pulls, 1))) / (2 * 8.5e-3)
    assert found["wear.depth"] == pytest.approx(depth, rel=1e-12, abs=0)


@pytest.mark.parametrize("only", ["layout", "closure", "contact", "wear"])
def test_wear_without_a_running_time_leaves_the_chain_as_it_is(only):
    worn, new = run(only, WEAR), run(only)
    assert worn.outcome == "complete" or only == "closure"
    for name, value in new.values.items():
        assert worn[name] == pytest.approx(value.value, rel=1e-12, abs=0), name


def test_the_forces_of_the_strands_are_those_of_the_worn_chain():
    worn = run(("layout", "contact", "wear"), WEAR, 'wear.running_time="500 h"')
    assert worn["wear.elongation"] > 1e-4
    assert worn["strand.tight_force"] == pytest.approx(worn["layout.pull.rail"], rel=1e-12)
    assert worn["layout.tensioner.idler.travel"] > 1.05 * run("layout")["layout.tensioner.idler.travel"]
    assert worn["wear.depth"] == pytest.approx(run("wear", WEAR)["wear.depth"], rel=1e-12, abs=0)


# ------------------------------------------------------------------------------------------------------------------- a blade


def test_a_blade_about_a_pivot_balances_its_moment(blade):
    model = build(dw.load(blade))
    found, drive = model.balance, chain_drive(model)
    place, (pivot, lever) = found.route.place(2), (complex(0.02, 0.075), 0.09)
    centre = complex(0.11, 0.257) + drive.guides[0].slide.shift(complex(0.11, 0.257), found.q[2])
    # pulls through the centre of its arc, friction on its face of 200 mm: both against the spring
    friction = 0.2 * (found.pulls[place] - found.pulls[place - 1])
    moment = (np.conj(centre - pivot) * found.force_on(place)).imag + friction
    assert abs(moment) == pytest.approx((60.0 - 1e3 * found.q[2]) * lever, rel=1e-9)
    assert friction > 0.1 * abs(moment)


def test_a_blade_runs_and_keeps_its_energy(blade):
    short = ('dynamics.settling="60 ms"', 'dynamics.duration="0.3 s"', "dynamics.ensemble=1")
    found = dw.run(dw.load(blade, short), only=("dynamics", "layout"))
    assert found.check("energy_drift").ok and found.check("running.jumped_teeth").ok
    assert found["dynamics.tensioner.blade.travel.mean"] == pytest.approx(found["layout.tensioner.blade.travel"], rel=0.05)
    difference = found["dynamics.strand.driven.tension"] - found["dynamics.strand.blade.tension"]
    assert difference == pytest.approx(5.0 * 2 * np.pi / (37 * 9.525e-3), rel=0.05)


# ------------------------------------------------------------------------------------------------------------- what goes wrong


@pytest.mark.error
def test_a_tensioner_on_the_tight_strand_is_told():
    below = ('sprockets.0.centre=["130 mm", "-46 mm"]', 'sprockets.0.direction="90 deg"', 'sprockets.0.force="140 N"', "guides=[]")
    found = " ".join(run("layout", *below).findings)
    assert "tensioner idler presses on the tight strand: with clockwise rotation and a load torque of 8 N·m" in found
    assert "comes from the driven sprocket" in found and "Move the tensioner to the other strand" in found
    assert "tight strand" not in " ".join(run("layout").findings)
    driving = " ".join(run("layout", 'drive.load_torque="-2 N m"').findings)
    assert "presses on the tight strand" in driving and "goes to the driven sprocket" in driving


@pytest.mark.error
def test_a_reversing_drive_is_told_of_its_tensioner():
    found = " ".join(run("layout", "drive.reversing=true").findings)
    assert "the drive reverses: in the other sense of rotation the strand of tensioner idler is the tight one" in found


@pytest.mark.error
def test_a_guide_out_of_reach_is_a_finding_and_one_too_short_a_check():
    found = run("layout", 'guides.0.centre=["160 mm", "-352 mm"]')
    words = r"guides.rail: the chain does not touch this guide, it passes at a distance of [\d.]+ mm"
    assert any(re.search(words, each) for each in found.findings)
    short = run("layout", 'guides.0.start="100 deg"', 'guides.0.end="106 deg"').check("guide.rail.reach")
    assert not short.ok and short.value < 0


@pytest.mark.error
@pytest.mark.parametrize(
    ("changes", "words"),
    [
        (("links=104",), r"104 links are [\d.]+ links \([\d.]+ mm\) too long: sprocket 'idler' moves by 15 mm"),
        (("links=94",), r"94 links are .* too short.*Take 2 more links"),
        (('sprockets.0.centre=["130 mm", "95 mm"]', 'sprockets.0.travel="1 mm"'), "too long|does not reach"),
        (('sprockets.0.side="inside"',), "sprocket 'idler' does not t.*: it lies inside the loop.* take side = 'outside'"),
        (
            ('driven.centre_distance="100 mm"',),
            "driving sprocket and the driven sprocket overlap|no strand fits between sprocket 'idler' and the",
        ),
    ],
)
def test_what_does_not_fit_is_said_in_links_and_millimetres(changes, words):
    found = run("layout", *changes)
    assert any(re.search(words, each) for each in found.findings), found.findings


@pytest.mark.error
@pytest.mark.parametrize(
    ("changes", "key", "words"),
    [
        (("driven.centre_distance=",), "drive.preload", "the position of the driven sprocket is undefined"),
        (("sprockets.0.force=",), "sprockets.idler.force", "is missing for a tensioner"),
        (("sprockets.0.direction=",), "sprockets.idler.force", "a tensioner needs both force and direction"),
    ],
)
def test_keys_that_miss_each_other(changes, key, words):
    with pytest.raises(SpecError, match=words) as caught:
        build(load(*changes))
    assert caught.value.key == key


@pytest.mark.error
def test_teeth_on_the_back_of_a_silent_chain_are_refused(blade):
    with pytest.raises(SpecError, match="a sprocket cannot mesh with the back of a silent chain; use a guide"):
        build(dw.load(blade, ('sprockets=[{name="idler", teeth=21, centre=["100 mm", "80 mm"], side="outside"}]',)))


def test_a_preload_beside_a_fixed_centre_distance_is_told_to_be_idle():
    assert any("drive.preload has no effect" in each for each in build(load('drive.preload="100 N"')).findings)


BELOW = ('sprockets.0.centre=["130 mm", "-46 mm"]', 'sprockets.0.direction="90 deg"', "guides=[]")


@pytest.mark.error
def test_a_strand_that_would_have_to_push_fails_a_check_once_and_is_no_overspeed():
    found = run(("layout", "contact", "wear"), *BELOW, WEAR)
    taut = [check for check in found.checks if check.name == "strand.taut"]
    assert len(taut) == 1 and not taut[0].ok
    assert taut[0].value == pytest.approx(found["strand.slack_force"], rel=1e-12) and taut[0].value < -50.0
    assert not any(check.name == "chain.overspeed" for check in found.checks) and "layout.limit_speed" not in found.values
    assert found.outcome == "complete" and "chain.mean_static_safety" not in found.values
    assert sum("the slack strand would be compressed" in each for each in found.warnings) == 1
    assert run(("layout", "contact")).check("strand.taut").ok


@pytest.mark.error
@pytest.mark.parametrize("only", ["layout", "contact", "wear"])
def test_the_preload_at_which_the_slack_strand_begins_to_pull_is_told(only):
    changes = ("driven.centre_distance=", "sprockets=[]", "guides=[]", WEAR)
    loose = run(only, *changes, 'drive.preload="100 N"')
    assert not loose.check("strand.taut").ok
    words = next(each for each in loose.warnings if "would be compressed" in each)
    least = float(re.search(r"A drive.preload above ([\d.]+) N", words)[1])
    slope = np.sqrt(1 - (19 * 9.525e-3 / (2 * np.pi) / run("layout", *changes, 'drive.preload="1 kN"')["layout.centre_distance"]) ** 2)
    assert least == pytest.approx(8.0 * 2 * np.pi / (38 * 9.525e-3) * slope, rel=1e-3)
    assert run(only, *changes, f'drive.preload="{1.001 * least} N"').check("strand.taut").ok


@pytest.mark.error
def test_a_chain_longer_than_its_path_hangs_in_the_slack_strand_up_to_a_limit():
    fixed = ("sprockets=[]", "guides=[]")
    hangs = run("layout", *fixed, 'driven.centre_distance="319 mm"').check("chain.slack")
    assert hangs.ok and hangs.limit == pytest.approx(0.02 * 0.319)
    assert not run("layout", *fixed, 'driven.centre_distance="310 mm"').check("chain.slack").ok
    assert not any(check.name == "chain.slack" for check in run("layout").checks)


# ------------------------------------------------------------------------------------------------------------- how a run fails


@pytest.mark.error
def test_jumped_teeth_end_the_run_there_and_keep_what_it_was_up_to():
    found = run("dynamics", 'sprockets.0.force="4 N"', 'sprockets.0.stiffness="0 N/mm"', *SHORT)
    assert found.outcome == "partial"
    jumped = found.check("running.jumped_teeth")
    assert not jumped.ok and jumped.value >= 1 and "has jumped" in jumped.message
    stop = found["dynamics.stop_time"]
    assert 0 <= stop < 0.2
    assert np.isfinite(found["dynamics.tension.mean"])
    assert any(re.search(rf"up to t = {stop:.4g} s of 0.2\d* s: the chain jumps a tooth on", each) for each in found.findings)
    assert found.tables["running"]["time"].data[-1] == pytest.approx(stop, abs=1e-3)


@pytest.mark.error
def test_a_load_beyond_the_preload_is_slack_or_jumps():
    found = dw.run(dw.load(EXAMPLES / "roller_chain.toml", ('drive.load_torque="60 N m"', *SHORT)), only="dynamics")
    assert found.outcome == "partial" and not found.check("running.jumped_teeth").ok


@pytest.mark.error
def test_a_run_that_goes_slack_says_which_check_fails_and_by_how_much():
    found = run("dynamics", 'sprockets.0.force="12 N"', 'sprockets.0.stiffness="0 N/mm"', 'drive.speed="1500 rpm"', "guides=[]", *SHORT)
    slack = found.check("running.slack")
    assert found.outcome == "partial" and not slack.ok
    words = next(each for each in found.findings if each.startswith("the run failed and its statistics are left out: "))
    assert f"running.slack is {slack.value:.3g} and must be at most 0.05 (share of time" in words
    assert "Raise the preload or the tensioner's force" in words


def test_what_the_tensioner_does_is_among_the_first_values(whole):
    shown = registry.headlines(registry.mechanism("silent-chain"), whole.values)
    assert {f"layout.tensioner.idler.{name}" for name in ("travel", "force")} < set(shown)
    assert {f"dynamics.tensioner.idler.{name}" for name in ("travel.mean", "force")} < set(shown)


@pytest.mark.error
def test_overspeed_is_a_check_of_the_run_and_of_the_layout():
    changes = ('drive.speed="30000 rpm"', 'dynamics.settling="10 ms"', 'dynamics.duration="10 ms"', "dynamics.ensemble=1")
    fast = dw.run(dw.load(EXAMPLES / "roller_chain.toml", changes), only="dynamics")
    lifted = fast.check("running.tooth_contacts")
    assert not lifted.ok and "overspeed" in lifted.message
    tight = ("sprockets=[]", "guides=[]", 'driven.centre_distance="320.5 mm"', 'drive.load_torque="0 N m"')
    still = run("layout", *tight)
    limit = still["layout.limit_speed"]
    assert still.check("chain.overspeed").ok
    beyond = run("layout", *tight, f'drive.speed="{1.2 * limit} rad/s"').check("chain.overspeed")
    assert not beyond.ok and beyond.limit == pytest.approx(limit, rel=1e-6)


# ------------------------------------------------------------------------------------------------------------- on the screen


def test_the_scene_shows_all_bodies_and_closes():
    model = build(load())
    scene = registry.mechanism("silent-chain").scene(model)
    bodies = {body.name: body for body in scene.bodies}
    assert {"drive", "driven", "idler", "rail", "link0", "link95"} <= set(bodies)
    assert bodies["idler"].poses[-1, 2] - bodies["idler"].poses[0, 2] == pytest.approx(4 * np.pi / 15)  # two teeth, the other way round
    assert bodies["drive"].poses[-1, 2] == pytest.approx(-4 * np.pi / 19)
    np.testing.assert_allclose(bodies["link0"].poses[-1, :2], bodies["link2"].poses[0, :2], atol=1e-9)
    assert 1e-5 < np.ptp(bodies["idler"].poses[:, 1]) < 2e-4
    face = next(iter(bodies["rail"].shapes)).outline.points(1e-6)
    assert np.max(np.hypot(*face.T)) == pytest.approx(0.3, rel=1e-6)


def test_drawings_and_solids_hold_the_further_sprocket():
    kind, model = registry.mechanism("silent-chain"), build(load())
    assert {drawing.name for drawing in kind.drawings(model)} >= {"sprocket_drive", "sprocket_driven", "sprocket_idler"}
    parts = {part.name: part for part in kind.parts(model)}
    assert parts["idler"].pose[0] == pytest.approx(0.13) and parts["idler"].pose[1] < 0.036


@pytest.mark.error
def test_a_scene_without_a_drive_says_what_it_lacks():
    with pytest.raises(InputError, match=r"depends on its loads; add \[drive\]"):
        registry.mechanism("silent-chain").scene(build(load("drive=")))
