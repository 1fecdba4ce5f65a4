"""What a spec of an indexing drive promises: names of values, tables and checks, units, absent values."""

import tomllib
from pathlib import Path

import numpy as np
import pytest

import drivewright as dw
from drivewright.errors import DrivewrightError
from drivewright.spec import from_document
from drivewright.spec.parsing import change_key

pytestmark = pytest.mark.interface

SPEC = """
mechanism = "indexer"
kind = "pin-wheel"
pins = 12
pin_circle_radius = "120 mm"
pin_radius = "8 mm"
eccentricity = "10 mm"
cams = 2
side = "inside"
[motion]
law = "modified-sine"
motion_to_dwell = 1.0
[load]
torque = "1000 N m"
[contact]
model = "unilateral"
"""
VALUES = (
    "profile.area",
    "profile.perimeter",
    "profile.min_radius",
    "profile.max_radius",
    "profile.min_convex_radius",
    "contacts.minimum",
    "contacts.maximum",
    "play.forward.maximum",
    "play.backward.maximum",
    "stiffness.mean",
    "stiffness.minimum",
    "stiffness.minimum.at",
    "stiffness.range",
    "stiffness.undefined_fraction",
)
PRESETS = Path(dw.__file__).parent / "mechanisms/indexer/presets"


def spec(*changes):
    tables = tomllib.loads(SPEC)
    for change in changes:
        change_key(tables, change)
    return from_document(tables)


@pytest.fixture(scope="module")
def result():
    return dw.run(spec())


@pytest.fixture(scope="module")
def prototype():
    return dw.run(dw.load(PRESETS / "default.toml"))


def test_the_contract_gives_every_value(result):
    assert set(VALUES) <= set(result.values) and result.outcome == "complete"
    units = {name: result.values[name].unit for name in VALUES}
    assert units["profile.area"] == "m^2" and units["play.forward.maximum"] == "rad" and units["stiffness.mean"] == "N m/rad"


def test_the_tables_have_their_columns(prototype):
    columns = {name: [column.name for column in table.columns] for name, table in prototype.tables.items()}
    assert columns["profile"] == ["angle", "pin", "x", "y", "curvature"]
    assert columns["stiffness"][:3] == ["angle", "secant", "tangent"]
    assert {"pin", "crank", "support", "housing", "bending", "torsion", "gear", "wheel"} <= set(columns["stiffness"])
    assert {"contacts", "play", "pin_forces", "bearing_loads", "motion"} <= set(columns)
    assert len(prototype.tables["stiffness"]["angle"].data) == 41 == len(prototype.tables["contacts"]["angle"].data)


def test_the_checks_of_the_paper_s_prototype(prototype):
    assert {name: prototype.check(name).ok for name in ("play.forward", "play.backward", "pressure_angle", "static_rating.support")} == {
        "play.forward": False,
        "play.backward": False,
        "pressure_angle": False,
        "static_rating.support": False,
    }
    assert prototype.check("static_rating.crank").value == pytest.approx(1.47, rel=0.02)


def test_the_prototype_s_numbers(prototype):
    assert prototype["profile.area"] == pytest.approx(38122.1e-6, rel=1e-4)
    assert prototype["profile.perimeter"] == pytest.approx(1018.66e-3, rel=5e-4)
    assert prototype["profile.min_radius"] == pytest.approx(0.102, rel=1e-9)
    assert prototype["profile.max_radius"] == pytest.approx(0.122, rel=1e-9)
    assert (prototype["contacts.minimum"], prototype["contacts.maximum"]) == (7, 12)
    assert np.degrees(prototype["play.forward.maximum"]) * 60 == pytest.approx(113.73, abs=0.02)
    assert prototype["play.backward.maximum"] == pytest.approx(prototype["play.forward.maximum"], rel=1e-6)


def test_the_shares_add_up_to_the_compliance(prototype):
    table = prototype.tables["stiffness"]
    shares = sum(table[name].data for name in ("pin", "crank", "support", "housing", "bending", "torsion", "gear", "wheel"))
    carried = np.isfinite(table["secant"].data)
    assert carried.sum() == 33
    assert shares[carried] == pytest.approx(1 / table["secant"].data[carried], rel=1e-9)


def test_statics_of_the_paper_corrected_meet_the_solver(prototype):
    assert prototype["statics.corrected.deviation"] < 1e-8 < 0.1 < prototype["statics.printed.deviation"]


def test_one_position(prototype):
    one = dw.run(dw.load(PRESETS / "default.toml", ('load.angle="90 deg"',)))
    table = prototype.tables["stiffness"]
    assert one["stiffness.mean"] == pytest.approx(table["secant"].data[20], rel=1e-9)
    assert one["stiffness.minimum.at"] == pytest.approx(np.pi / 2) and one["stiffness.range"] == 0
    assert len(one.tables["contacts"]["angle"].data) == 1


def test_where_nothing_holds_a_value_is_absent_and_a_finding_says_why():
    one = dw.run(spec('load.angle="13.5 deg"'))
    assert one["stiffness.undefined_fraction"] == 1 and "stiffness.mean" not in one.values and "stiffness.minimum" not in one.values
    assert any("no contact without a gap resists the torque" in finding for finding in one.findings)
    assert np.isnan(one.tables["stiffness"]["secant"].data[0]) and one.tables["stiffness"]["secant_after_play"].data[0] > 0


def test_the_symmetry_theorem_through_the_command_s_own_path():
    for angle, other in ((45.0, 135.0), (67.5, 112.5), (85.5, 94.5), (160.0, 20.0)):
        pair = [
            dw.run(dw.load(PRESETS / "default.toml", (f'load.angle="{at} deg"', f'load.torque="{torque} N m"')), only=("stiffness",))
            for at, torque in ((angle, 1000), (other, -1000))
        ]
        assert pair[0]["stiffness.mean"] == pytest.approx(pair[1]["stiffness.mean"], rel=1e-9)


def test_a_report_is_written_where_nothing_carries_the_torque(tmp_path):
    from drivewright.report.content import views
    from drivewright.report.folder import write_run_folder

    changed = spec('load.angle="10 deg"')
    model = dw.build(changed)
    result = dw.run(changed)
    assert (write_run_folder(result, tmp_path / "out", False, views(result, model)) / "report.html").is_file()
    assert not [check.name for check in result.checks if check.name.startswith(("play", "held"))]


def test_a_cycloid_with_cusps_of_its_centre_curve():
    """Eccentricity times pins is the pin circle's radius: the centre curve has N - 1 cusps, arcs of the pin fill the valleys."""
    found = dw.run(spec('kind="cycloid"', "motion.law=", "motion.motion_to_dwell="), only=("profile", "play"))
    near = [
        dw.run(spec('kind="cycloid"', "motion.law=", "motion.motion_to_dwell=", f'eccentricity="{e} mm"'), only=("profile",))
        for e in (9.99, 10.01)
    ]
    area, low, high = found["profile.area"], near[0]["profile.area"], near[1]["profile.area"]
    assert low < area < high and area == pytest.approx(0.5 * (low + high), rel=2e-6)
    assert found["profile.min_radius"] == pytest.approx(0.102, rel=1e-9) and found["play.forward.maximum"] < 1e-6


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ('load.angle="45 deg"', "load.angle gives a single input angle"),
        ('hand="left"', "does not use hand"),
        ('limits.life="100 h"', "load.speed is not given"),
    ],
)
def test_what_is_given_and_not_used_is_told(change, words):
    assert any(words in finding for finding in dw.build(spec(change)).findings)


def test_the_dwell_is_told_beside_the_step(prototype):
    assert {"dwell.stiffness.minimum", "dwell.undefined_fraction", "dwell.pins.max_force"} <= set(prototype.values)
    mid = dw.run(dw.load(PRESETS / "default.toml", ('load.angle="270 deg"',)), only=("stiffness",))["stiffness.mean"]
    assert prototype["dwell.stiffness.minimum"] <= mid


def test_a_cycloid_is_the_pin_wheel_with_a_uniform_law():
    changes = ('eccentricity="6 mm"', 'motion.law="uniform"', "motion.motion_to_dwell=")
    wheel, disc = dw.run(spec(*changes)), dw.run(spec('kind="cycloid"', *changes))
    assert wheel.values.keys() == disc.values.keys()
    assert {name: wheel[name] for name in wheel.values} == {name: disc[name] for name in disc.values}
    assert wheel["play.forward.maximum"] < 1e-6 and wheel["contacts.minimum"] == 12


@pytest.mark.parametrize("kind", ["parallel", "barrel", "globoidal", "cycloid"])
def test_every_kind_tells_profile_motion_pressure_angle_and_stress(kind):
    found = dw.run(dw.load(PRESETS / f"{kind}.toml"))
    assert found.ok and found.outcome == "complete"
    assert {"pressure_angle.maximum", "contacts.minimum", "play.forward.maximum", "pins.max_pressure", "motion.velocity_factor"} <= set(
        found.values
    )
    assert {"profile", "motion", "contacts", "play", "pin_forces"} <= set(found.tables)
    assert "curvature" in [column.name for column in found.tables["profile"].columns]


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ("pins=2", "at least 3"),
        ('motion.law="spline"', "needs it"),
        ("motion.motion_to_dwell=1e9", "1000"),
        ('eccentricity="-1 mm"', "greater than 0"),
        ('pin_radius="40 mm"', "overlap"),
        ("cams=5", "at most 4"),
        ("pins=9", "divide"),
        ("motion.motion_to_dwell=0.0", "from 0.001 to 1000"),
        ("motion.motion_to_dwell=-1.0", "from 0.001 to 1000"),
        ('motion.law="uniform"', "no dwell"),
        ('motion.law="constant-velocity"', "velocity jumps"),
        ('motion.law="modified-sin"', "modified-sine"),
        ('load.torque="0 N m"', "no stiffness"),
        ('load.torque="1000 N m/rad"', "torque"),
        ("eccentricity=", "needs it"),
        ('eccentricity="115 mm"', "no cam remains"),
        ('crank_bearings.bearing="NU207E"', "shaft_spacing"),
        ('kind="cycloid"', "uniform"),
        ('kind="globoidal"', "centre_distance"),
        ('kind="wheel"', "pin-wheel"),
    ],
)
def test_what_has_no_meaning_is_refused_in_one_line(change, words):
    with pytest.raises(DrivewrightError) as error:
        dw.build(spec(change))
    assert words in str(error.value) and "\n" not in str(error.value)
