"""What a run tells of the stiffness of drives whose cams turn, of gears that are not given, and which keys are refused."""

from pathlib import Path

import numpy as np
import pytest

import drivewright as dw
from drivewright import contact
from drivewright.errors import SpecError
from drivewright.indexing.pin_pressure import WIDEST, largest_approach, relative_width
from drivewright.mechanisms.indexer.stress import PRESSURES

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


@pytest.mark.property
@pytest.mark.parametrize("change", ["contact.interference=0 um", "contact.interference=20 um"])
@pytest.mark.parametrize("kind", KINDS)
def test_the_check_of_the_pressure_takes_the_largest_that_the_run_knows(kind, change):
    """Of statics, of the load shared by stiffness and of the dwell; an interference presses rollers by far more than the torque does."""
    found = run(kind, *LOAD, change, only=("stress", "stiffness"))
    known = {name: found[name] for name in PRESSURES if name in found.values}
    (check,) = [each for each in found.checks if each.name == "contact_pressure"]
    assert check.value == max(known.values()) and known[_judged(check)] == check.value
    assert check.label == found.values[_judged(check)].label
    if "20 um" in change:
        assert known["shared.max_pressure"] > 1.5 * known["pins.max_pressure"] and not check.ok


def _judged(check):
    """The value that a check of the pressure names: the longest of the messages that it may begin with."""
    begun = [name for name, words in PRESSURES.items() if check.message.startswith(f"{words.format('roller')};")]
    return max(begun, key=lambda name: len(PRESSURES[name]))


@pytest.mark.property
def test_the_pressure_in_the_dwell_counts_for_cams_on_cranks():
    found = run("default", only=("stiffness",))
    (check,) = [each for each in found.checks if each.name == "contact_pressure"]
    assert check.value == max(found["pins.max_pressure"], found["dwell.pins.max_pressure"])


@pytest.mark.analytical
def test_interference_alone_presses_opposed_rollers_by_the_law_of_the_contact():
    """In the dwell two rollers hold the cam between them; all else is rigid, and next to no torque is on the wheel.  The interference d
    is then the approach of either line contact: F = K_l d^(10/9), p0 = sqrt(F E*/(pi L R))."""
    found = run("globoidal", "load.torque=1 N m", "contact.interference=5 um", "load.angle=300 deg")
    table = found.tables["shared_forces"]
    force = 8.06e10 * table["length"].data ** (8 / 9) * 5e-6 ** (10 / 9)
    np.testing.assert_allclose(table["force"].data, force, rtol=0.02)
    assert len(set(table["cam"].data)) == 2


def test_statics_alone_do_not_judge_an_interference():
    found = run("globoidal", *LOAD, "contact.interference=5 um", only=("stress",))
    assert not [each for each in found.checks if each.name == "contact_pressure"]
    assert any("contact_pressure is not checked" in each and "contact.interference" in each for each in found.findings)
    assert "contact_pressure" in [each.name for each in run("globoidal", *LOAD, only=("stress",)).checks]


def test_a_contact_wider_than_theory_holds_is_told():
    found = run("globoidal", *LOAD, "contact.interference=150 um", only=("stress", "stiffness"))
    (finding,) = [each for each in found.findings if "Hertz's theory holds up to" in each]
    assert finding.startswith("shared.max_pressure = ") and not found.ok
    assert not any("Hertz's theory holds up to" in each for each in run("globoidal", *LOAD, only=("stress", "stiffness")).findings)


@pytest.mark.error
def test_an_interference_beyond_contact_theory_is_refused():
    with pytest.raises(SpecError, match=r"1 mm is 8\.\d+ % of the roller's radius; beyond 0\.\d+ mm .*try \"5 um\"") as told:
        dw.build(load("globoidal", "contact.interference=1 mm"))
    assert told.value.key == "contact.interference"


@pytest.mark.analytical
def test_the_largest_approach_is_that_of_two_cylinders():
    """Twice the compression of a cylinder whose line contact is a tenth of the radius wide, of any modulus."""
    radius, modulus, poisson = 0.012, 210e9, 0.3
    effective = modulus / (2 * (1 - poisson**2))
    force = np.pi * effective * (WIDEST * radius) ** 2 / (4 * radius)
    made = contact.line_contact(force, 1.0, radius, effective)
    assert made.half_width == pytest.approx(WIDEST * radius) and relative_width(made.pressure, effective) == pytest.approx(WIDEST)
    each = contact.cylinder_compression(force, 1.0, made.half_width, radius, modulus, poisson)
    assert largest_approach(radius) == pytest.approx(2 * each, rel=1e-12)
