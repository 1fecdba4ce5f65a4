"""What a run tells of the stiffness of drives whose cams turn, of gears that are not given, and which keys are refused."""

from pathlib import Path

import numpy as np
import pytest

import drivewright as dw
from drivewright.errors import SpecError

pytestmark = pytest.mark.interface

PRESETS = Path(dw.__file__).parent / "mechanisms/indexer/presets"
KINDS = ("parallel", "globoidal", "barrel")
LOAD = ("load.torque=100 N m",)
YIELDING = (
    "housing.cam_stiffness=5e8 N/m",
    "housing.wheel_stiffness=5e8 N/m",
    "housing.input_torsion=2e5 N m/rad",
    "housing.wheel_torsion=1e6 N m/rad",
    "contact.pin_stiffness=4e8 N/m",
)


def load(name, *changes):
    return dw.load(PRESETS / f"{name}.toml", [*changes])


def run(name, *changes, only=("stiffness",)):
    return dw.run(load(name, *changes), only)


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_tells_stiffness_and_shared_forces(kind):
    plain, soft = run(kind, *LOAD), run(kind, *LOAD, *YIELDING)
    for name in ("mean", "minimum", "minimum.at", "maximum", "range", "undefined_fraction"):
        assert f"stiffness.{name}" in plain.values
    assert {"shared.max_force", "shared.max_pressure", "dwell.stiffness.minimum", "dwell.undefined_fraction"} <= set(plain.values)
    assert soft["stiffness.mean"] < 0.8 * plain["stiffness.mean"]
    table = soft.tables["stiffness"]
    total = sum(table[name].data for name in ("pin", "cam", "input", "wheel"))
    np.testing.assert_allclose(total * table["secant"].data, 1.0, rtol=1e-9)
    assert {check.name for check in soft.checks} == {"held.dwell"} and soft.ok


@pytest.mark.parametrize("kind", KINDS)
def test_shared_forces_balance_the_torque_at_every_angle(kind):
    table = run(kind, *LOAD, *YIELDING).tables["shared_forces"]
    for angle in np.unique(table["angle"].data):
        own = table["angle"].data == angle
        assert np.sum((table["force"].data * table["arm"].data)[own]) == pytest.approx(-100.0, rel=1e-9)


@pytest.mark.property
def test_dwell_of_a_parallel_drive_holds_by_one_roller():
    """One roller at R with the pressure angle of the dwell arc carries all: statics and shared force are the same."""
    both = run("parallel", *LOAD, only=("stiffness", "stress"))
    assert both["dwell.pins.max_force"] == pytest.approx(both["pins.max_force"], rel=1e-9)


@pytest.mark.property
@pytest.mark.parametrize("torque", ["100 N m", "-100 N m"])
def test_one_roller_alone_has_force_and_pressure_of_statics(torque):
    """In the dwell of a parallel drive a roller of either level carries all of the torque, by number and by pressure the same."""
    both = run("parallel", f"load.torque={torque}", "load.angle=200 deg", only=("stiffness", "stress"))
    statics, shared = both.tables["pin_forces"], both.tables["shared_forces"]
    for name in ("pin", "force", "arm", "pressure"):
        np.testing.assert_allclose(shared[name].data, statics[name].data, rtol=1e-9, err_msg=name)
    assert (statics["pin"].data[0] >= 8) == (torque == "100 N m")


@pytest.mark.property
def test_interference_stiffens():
    kind = "globoidal"
    assert run(kind, *LOAD, "contact.interference=5 um")["stiffness.mean"] > 1.8 * run(kind, *LOAD)["stiffness.mean"]


def test_least_stiffness_is_checked_for_all_kinds():
    found = run("barrel", *LOAD, "limits.stiffness=1e9 N m/rad")
    (check,) = [each for each in found.checks if each.name == "stiffness"]
    assert not check.ok and check.value == found["stiffness.minimum"]
    told = dw.run(load("barrel", "load.torque=", "limits.stiffness=1e9 N m/rad"), ("motion",)).findings
    assert any("limits.stiffness is not checked: load.torque is not given" in each for each in told)


def test_one_angle_alone_has_no_dwell():
    found = run("globoidal", *LOAD, "load.angle=90 deg")
    assert len(found.tables["stiffness"]["secant"].data) == 1 and "dwell.stiffness.minimum" not in found.values


def test_gears_that_are_not_given_neither_yield_nor_have_play():
    """[gear] adds compliance; without it its share is 0, and a finding says so."""
    with_gear, without = run("default"), run("default", "gear=")
    assert np.nanmax(with_gear.tables["stiffness"]["gear"].data) > 0
    assert np.nanmax(np.abs(without.tables["stiffness"]["gear"].data)) == 0.0
    assert without["stiffness.mean"] > with_gear["stiffness.mean"]
    words = "[gear] is not given: the split shafts are held at the gear positions"
    assert any(words in each for each in without.findings) and not any(words in each for each in with_gear.findings)


@pytest.mark.error
@pytest.mark.parametrize(
    ("kind", "change", "key", "words"),
    [
        ("parallel", "housing.support_stiffness=1e9 N/m", "housing.support_stiffness", "give cam_stiffness for the bearings of its cam"),
        ("default", "housing.cam_stiffness=1e9 N/m", "housing.cam_stiffness", "is for parallel, barrel and globoidal"),
        ("default", "housing.input_torsion=1e5 N m/rad", "housing.input_torsion", "is for parallel, barrel and globoidal"),
        ("default", "contact.interference=5 um", "contact.interference", "is for parallel, barrel and globoidal"),
        ("barrel", "contact.interference=-5 um", "contact.interference", "must be at least 0"),
        ("globoidal", "support_bearings.bearing=61904", "support_bearings", "has no split shafts"),
    ],
)
def test_keys_of_other_kinds_are_refused(kind, change, key, words):
    with pytest.raises(SpecError, match=words) as told:
        dw.build(load(kind, change))
    assert told.value.key == key


@pytest.mark.error
def test_contacts_that_stick_have_no_interference():
    with pytest.raises(SpecError, match="bonded contacts need no interference"):
        dw.build(load("parallel", "contact.interference=5 um", "contact.model=bonded"))
