"""The worked studies run, a few of their numbers have not moved, and each says something that is known from elsewhere.

The pinned numbers are our own; when one moves for a good reason, say in the commit why, and change it here.  The studies run in a smaller
size; in full they run with `docs/generate.py`.
"""

import csv
import re

import numpy as np
import pytest
from places import EXAMPLES

import drivewright as dw
from drivewright.studies.plan import make_plan
from drivewright.studies.variation import with_variation

pytestmark = pytest.mark.golden

FOLDER = EXAMPLES / "studies"
CASES = {
    "clearance_bifurcation": 50,
    "hyvo_phase_map": 288,
    "indexer_play": 65,
    "knife_kd_calibrated": 110,
    "knife_kd_map": 165,
    "pusher_pareto": 20_000,
    "shaft_tolerance": 1143,
}
NAMES = tuple(CASES)


def load(name):
    return dw.load(FOLDER / f"{name}.toml")


def smaller(name, vary=None, **settings):
    """The study with other levels, or other settings of its [study]."""
    study = dw.sweep(with_variation(load(name), vary or {}, **settings), on="serial")
    assert study.counts == {"complete": len(study.plan)}
    return study


def test_every_worked_study_is_known_here():
    assert {path.stem for path in FOLDER.glob("*.toml")} == set(CASES)


@pytest.mark.parametrize("name", NAMES)
def test_a_study_has_the_cases_that_its_comment_tells(name):
    assert len(make_plan(load(name))) == CASES[name]
    assert re.search(rf"\b{CASES[name]} (cases|designs)", told(name).replace("20 000", "20000"))


def told(name):
    """The comment at the head of a study."""
    text = (FOLDER / f"{name}.toml").read_text(encoding="utf-8")
    return " ".join(line.lstrip("# ") for line in text.splitlines() if line.startswith("#"))


# -- chain ---------------------------------------------------------------------------------------------------------------------

# Fluctuation [um] of the closure with straight strands by an independent program, for rolling radii of 1.0 and 1.6 mm.  It looked at 48 to
# 80 positions of a tooth only: it can miss the ends of the fluctuation, but not go beyond them.
BY_ANOTHER_PROGRAM = {80: (1.30, 2.31), 81: (8.10, 8.08), 83: (8.19, 8.16), 84: (1.21, 2.16)}


def test_phase_map_agrees_with_another_program():
    study = smaller(
        "hyvo_phase_map", {"links": list(BY_ANOTHER_PROGRAM), "joint.rolling_radius": ["1.0 mm", "1.6 mm"], "closure.strands": ["straight"]}
    )
    found = 1e6 * study["centre_distance.fluctuation"].reshape(4, 2)
    over = found / np.array(list(BY_ANOTHER_PROGRAM.values()))
    assert np.all((over > 0.99) & (over < 1.03))


def test_phase_map_is_pinned_and_pressure_follows_hertz():
    study = smaller("hyvo_phase_map", {"joint.rolling_radius": ["0.5 mm", "1.0 mm"], "closure.strands": ["equilibrium"]})
    assert study["centre_distance.fluctuation"][1] == pytest.approx(1.05445846e-6, rel=2e-5)
    pressure = study["pin.contact_pressure"]
    assert pressure[0] / pressure[1] == pytest.approx(np.sqrt(2.0), rel=1e-9)  # p0 = sqrt(F E*/(pi L R))
    assert (study["check.pin.shakedown"] >= 0).tolist() == [False, True]


# -- linkages ------------------------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_small_play_is_calm_and_a_large_one_chaotic():
    study = smaller("clearance_bifurcation", {"joints.wrist.clearance": ["0.01 mm", "0.5 mm"]})
    assert study["slider.impact_load_coefficient"][0] == pytest.approx(1.0188, rel=1e-3)
    calm, wild = study["lyapunov_exponent.per_turn"]
    assert calm < -1.0 and wild > 1.0
    crank, rod, speed = 0.05, 0.12, 5000 * 2 * np.pi / 60
    assert study["slider.ideal_peak"] == pytest.approx(crank * speed**2 * (1 + crank / rod), rel=1e-9)


IDEAL = ["knife.impact_load_coefficient", "knife.ideal_peak"]
HOUR = 2 * np.pi / 3600  # a turn an hour


def rows_of_the_table(path, keep):
    """A smaller copy of the points: rows of (law, speed, play) to keep."""
    with (FOLDER / "knife_kd_calibrated.csv").open(encoding="utf-8") as file:
        head, *rows = csv.reader(file)
    chosen = [row for row in rows if (row[0], row[1], row[2]) in keep]
    path.write_text("\n".join(",".join(row) for row in [head, *chosen]) + "\n", encoding="utf-8")
    return path


@pytest.mark.slow
def test_calibrated_load_coefficients_agree_with_other_programs(tmp_path):
    """0.01 mm by the closed form of the four-bar, sampled finely; the others by a program written apart from this one."""
    by_another_program = {
        ("growing with speed", "10800", "0.4"): 7.564,
        ("growing with speed", "28800", "0.01"): 1.2344,
        ("growing with speed", "28800", "0.2"): 1.997,
        ("growing with speed", "28800", "0.4"): 5.177,
        ("growing with speed", "41400", "0.4"): 5.028,
    }
    points = rows_of_the_table(tmp_path / "points.csv", by_another_program)
    study = smaller("knife_kd_calibrated", points=str(points), values=IDEAL)
    assert study["knife.impact_load_coefficient"] == pytest.approx(list(by_another_program.values()), rel=0.01)
    assert study["knife.ideal_peak"] == pytest.approx(0.220792 * study["drive.speed"] ** 2, rel=5e-6)


@pytest.mark.slow
def test_load_coefficients_at_constant_damping_agree_with_another_program():
    """28 800 turns an hour at 1e-4 N m s/rad, printed to three figures: small plays are frozen, the largest rattles."""
    plays, dampings = (" + ".join(f"joints.{pin}.{key}" for pin in ("A", "B", "O4")) for key in ("clearance", "link_damping"))
    levels = {"drive.speed": ["28800 rev/h"], plays: ["0.1 mm", "0.2 mm", "0.4 mm"], dampings: ["1e-4 N m s/rad"]}
    study = smaller("knife_kd_map", levels, values=IDEAL)
    assert study["knife.impact_load_coefficient"] == pytest.approx([1.00, 1.66, 15.8], rel=5e-3)
    assert study["knife.ideal_peak"] == pytest.approx(0.220792 * (28800 * HOUR) ** 2, rel=5e-6)


def test_play_and_damping_are_the_same_in_three_pins():
    for name, dampings in (("knife_kd_map", 3), ("knife_kd_calibrated", 55)):
        columns = make_plan(load(name)).cases(0, CASES[name])
        for key, levels in (("clearance", 5), ("link_damping", dampings)):
            first, *others = (columns[f"joints.{pin}.{key}"] for pin in ("A", "B", "O4"))
            assert len(np.unique(first)) == levels and all(np.array_equal(first, other) for other in others)
        assert len(np.unique(columns["drive.speed"])) == 11


def test_the_calibrated_points_follow_the_two_laws_of_damping():
    columns = make_plan(load("knife_kd_calibrated")).cases(0, CASES["knife_kd_calibrated"])
    law, speed, play = (columns[key] for key in ("title", "drive.speed", "joints.A.clearance"))
    damping, alone = columns["joints.A.link_damping"], law == "one for each play"
    own = {r: damping[alone & (play == r)] for r in np.unique(play)}
    assert [each[0] for each in own.values()] == [1.49e-7, 5.55e-6, 2.71e-5, 8.89e-5, 1.95e-4]
    assert all(np.ptp(each) == 0 and len(each) == 11 for each in own.values())
    growing = law == "growing with speed"
    expected = np.array([own[r][0] for r in play[growing]]) * speed[growing] / (28800 * HOUR)
    assert damping[growing] == pytest.approx(expected, rel=1e-3) and np.sum(growing) == 55


# -- shaft ---------------------------------------------------------------------------------------------------------------------


def test_shaft_tolerances_are_pinned_and_the_lever_holds_in_every_case():
    study = smaller("shaft_tolerance", samples=20)
    nominal = study.plan.block("nominal").start
    assert study["stations.m2.deflection"][nominal] == pytest.approx(1.39454403e-4, rel=1e-6)
    a, b, station = (study[f"{key}.position"] for key in ("bearings.A", "bearings.B", "stations.m2"))
    reaction = study["loads.0.force"] * (station - a) / (b - a)
    assert study["bearings.B.radial_force"] == pytest.approx(reaction, rel=1e-9)
    assert study["check.static_safety.B"] == pytest.approx(2320.0 / (5 * reaction) - 1.0, abs=1e-9)
    assert (study["check.deflection.m2"] >= 0).tolist() == (study["stations.m2.deflection"] <= 0.145e-3).tolist()


# -- pusher --------------------------------------------------------------------------------------------------------------------


def test_pusher_sample_by_the_compiled_route_is_what_a_run_gives():
    study = smaller("pusher_pareto", samples=200)
    assert study.remarks  # by the compiled route, and it says how far off
    pivot = study["lever.pivot_distance"]
    assert study["rod.needle_distance"] == pytest.approx(np.abs(pivot + 0.0619 - 0.1652 * np.sin(np.radians(35.47))), abs=1e-12)
    assert study["cam.max_pressure_angle"][:2] == pytest.approx(PUSHER, rel=1e-6)
    design = dw.load(FOLDER / "pusher_pareto.toml", [f"{key}={study[key][7]:.17g} {study.unit(key)}" for key in study.plan.keys])
    result = dw.run(design)
    for name in ("cam.max_pressure_angle", "cam.max_pitch_radius", "cam.curvature_ratio"):
        assert study[name][7] == pytest.approx(result[name], rel=1e-3)


PUSHER = (0.9918975492784172, 1.0586143640968337)


# -- indexer -------------------------------------------------------------------------------------------------------------------


def test_play_is_alike_in_both_directions_where_the_motion_is_symmetric_about_the_pins():
    """The mirror image of the motion about its middle is the motion backwards; it meets the same pins where the motion angle
    360 m/(1 + m) deg is a multiple of the pins' pitch, 30 deg: at 1, not at 1.25."""
    study = smaller("indexer_play", {"motion.motion_to_dwell": [1.0, 1.25], "motion.law": ["modified-sine", "cycloidal"]})
    forward, backward = (study[f"play.{way}.maximum"].reshape(2, 2) for way in ("forward", "backward"))
    assert forward[0, 0] == pytest.approx(0.033082967, rel=2e-5)
    assert forward[0] == pytest.approx(backward[0], rel=1e-6, abs=1e-9)
    assert np.all(np.abs(forward[1] - backward[1]) > 1e-4)
    peaks = np.array([1.7596, 2.0])  # published velocity factors of the laws
    angle = 2 * np.pi * np.array([1 / 2, 5 / 9])[:, None]
    assert study["motion.velocity_factor"].reshape(2, 2) == pytest.approx(2 * np.pi / 12 * peaks / angle, rel=2e-5)
