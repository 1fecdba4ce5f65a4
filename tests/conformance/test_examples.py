"""Ourselves against accidents: every worked example runs, and a few of its numbers have not moved.

These numbers are our own.  When one moves for a good reason, print the new one with `drivewright run examples/NAME.toml --json`,
say in the commit why it moved, and change it here.
"""

import os
import subprocess
import sys

import pytest
from places import EXAMPLES

import drivewright as dw

pytestmark = pytest.mark.golden

FOLDER = EXAMPLES
PINNED = {
    "disc_cam": {"max_pressure_angle": 0.47777217340123485, "min_convex_radius": 0.031610820401744206, "max_contact_force": 206.6133},
    "oscillating_cam": {"max_pressure_angle": 0.42140923293097693, "min_convex_radius": 0.03150449711976596},
    "valve_train": {
        "valve.lift": 0.010000278965755465,
        "max_contact_force": 1535.68822,
        "spring.jump_speed": 373.84576,
        "surge.max_force": 150.422014,
        "film.at_peak_pressure": 3.34533984e-07,
    },
    "yoke_cam": {"min_convex_radius": 0.042, "min_half_face": 0.01613085562113285},
    "seedling_pusher": {
        "tip.track_height": 0.18232325075379263,
        "cam.max_pressure_angle": 0.7693077366704577,
        "contact.peak_force": 671.705,
    },
    "four_bar": {"rocker.max_angular_acceleration": 799.6856085336536, "drive.max_torque": 0.675338618892054},
    "jansen_leg": {"foot.max_acceleration": 9.374857905206746, "drive.max_torque": 0.03531556050871491},
    "five_bar": {"drives.left.rms_torque": 1.5413241, "drives.right.peak_torque": 3.32638208, "friction.power": 0.0542280717},
    "press_worn_pin": {"joints.wrist.max_force": 296367.6, "drives.main.rms_torque": 227.607, "drives.main.reflected_inertia": 0.866657638},
    "knife_folder": {"knife.impact_load_coefficient": 1.6599560257699812, "knife_tip.peak_acceleration_ratio": 1.508782965780165},
    "pressure_roller_shaft": {"stations.m2.deflection": 0.000357575392, "modes.1.frequency": 63.9497231},
    "rubber_roller_shaft": {"stations.m3.deflection": 0.000312090678, "flexibility.m3.m3": 6.24181357e-07, "modes.1.frequency": 38.8348779},
    "rubber_roller_61804": {
        "stations.m3.deflection": 0.000398758557,
        "bearings.C.reference_life": 34034277,
        "bearings.C.stiffness.tangent": 118615240,
    },
    "gearbox_shaft": {
        "gears.pinion.misalignment": 1.10910298e-05,
        "bearings.A.basic_life.time": 39240748.7,
        "bearings.B.modified_life.time": 187219620,
        "strength.min_safety": 2.62186124,
    },
    "two_disc_rotor": {
        "whirl.forward.1": 89.7875645,
        "whirl.backward.2": 243.95576,
        "critical_speeds.damped.2": 89.6911214,
        "unbalance.small.amplitude": 8.37291605e-06,
    },
    "spindle_duty": {
        "bearings.front_2.basic_life.time": 75645281,
        "bearings.front_2.mean_load": 2432.14828,
        "strength.min_safety": 8.90131956,
    },
    "spindle": {"stations.nose.deflection": 5.50790965e-06, "critical_speeds.forward.1": 5509.45005},
    "pin_indexer": {
        "profile.area": 0.0381221101584,
        "play.forward.maximum": 0.033082967,
        "stiffness.mean": 361238.11,
        "crank.max_load": 28817.9164,
    },
    "pin_indexer_two_way": {"profile.area": 0.04299048005, "stiffness.mean": 35289711.4, "pins.max_pressure": 703033471.3},
    "cycloid_reducer": {"profile.area": 0.00993052288449, "stiffness.mean": 340276.1185, "pins.max_pressure": 814187601.6},
    "roller_gear_indexer": {
        "pressure_angle.maximum": 0.48197626,
        "profile.min_relative_radius": 0.0097356891,
        "pins.max_pressure": 946802171.1,
    },
    "dial_table": {
        "drive.peak_torque": 41.97577676,
        "motor.rms_torque": 0.9044213879,
        "stiffness.minimum": 280800.0396,
        "dwell.stiffness.minimum": 1944474.558,
        "pressure_angle.maximum": 0.73594471,
    },
    "geneva": {
        "max_acceleration": 90.75410124457152,
        "max_pressure.drive": 496917909.4,
        "crank.peak_torque": 129.783692,
        "crossing.speed": 0.00953721171,
    },
    "torsion_test": {"stiffness.per_branch": 359156.472, "hysteresis_energy": 0.0741732},
    # Contacts of a running chain chatter: only what stands still is pinned.
    "hyvo_chain": {"pitch_deviation.driven": 2.46695172e-06, "centre_distance.mean": 0.219057426, "over_pins.drive": 0.1064210048},
    "hyvo_groups": {"centre_distance.fluctuation": 1.05445846e-06, "pin.contact_pressure": 1549806044.3},
    "hyvo_classical": {
        "centre_distance.mean": 0.219084033,
        "centre_distance.fluctuation": 4.6700946e-06,
        "pin.contact_pressure": 417528655.5,
    },
    "duplex_chain": {
        "layout.centre_distance": 0.901276637282,
        "centre_distance.fluctuation": 3.9275236569e-05,
        "chain.static_safety": 38.024994084,
        "pin.bearing_pressure": 6648331.66,
        "wear.life": 307361877.1,
    },
    "tensioned_chain": {
        "layout.tensioner.idler.travel": 0.00380888048,
        "layout.pull.driven": 216.8434858,
        "tensioner.idler.travel.fluctuation": 6.45777254e-05,
    },
    "roller_chain": {"centre_distance.mean": 0.32017224765, "layout.centre_distance": 0.3201723026, "strand.tight_force": 244.208655},
    # Chaotic: only what does not depend on which way the pin bounces.
    "slider_crank_clearance": {"slider.ideal_peak": 19419.360511402672, "bodies.crank.angular_velocity": 523.5987755982989},
    "seedling_pusher_improved": {"needle.angle_difference": 0.953388, "cam.max_pressure_angle": 0.310305, "cam.curvature_ratio": 1.680426},
}
LONG = ("hyvo_classical", "hyvo_groups", "tensioned_chain", "roller_chain")  # seconds each; another chain stays


def test_every_example_is_pinned():
    assert {path.stem for path in FOLDER.glob("*.toml")} == set(PINNED)


@pytest.mark.parametrize("name", [pytest.param(name, marks=pytest.mark.slow) if name in LONG else name for name in PINNED])
def test_an_example_runs_to_the_same_numbers(name):
    result = dw.run(dw.load(FOLDER / f"{name}.toml"))
    assert result.outcome == "complete"
    assert {key: result[key] for key in PINNED[name]} == pytest.approx(PINNED[name], rel=2e-5)


def test_the_improved_pusher_meets_every_requirement():
    assert dw.run(dw.load(FOLDER / "seedling_pusher_improved.toml")).ok


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(PINNED))
def test_a_first_run_with_nothing_compiled_is_complete(name, tmp_path):
    """In a process of its own: what is compiled first, and from where, differs from that among other tests."""
    command = [sys.executable, "-m", "drivewright", "run", str(FOLDER / f"{name}.toml"), "--no-figures", "--out", str(tmp_path / "out")]
    done = subprocess.run(command, env=os.environ | {"XDG_CACHE_HOME": str(tmp_path)}, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stdout + done.stderr
