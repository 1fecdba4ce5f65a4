"""The tables [table] and [motor]: what a run tells of the torque at the input, of the motor, and what is refused."""

from pathlib import Path

import numpy as np
import pytest

import drivewright as dw
from drivewright.errors import SpecError
from drivewright.mechanisms.indexer.batch import batch

pytestmark = pytest.mark.interface

PRESETS = Path(dw.__file__).parent / "mechanisms/indexer/presets"
TABLE = ("table.inertia=20 kg m^2", "table.friction_torque=15 N m", "load.speed=60 rpm")
MOTOR = ("motor.ratio=20", "motor.efficiency=0.8", "motor.inertia=5 kg cm^2")


def load(name, *changes):
    return dw.load(PRESETS / f"{name}.toml", [*changes])


def run(name, *changes):
    return dw.run(load(name, *changes), ("drive",))


def numbers(result):
    return {name: value.value for name, value in result.values.items()}


@pytest.mark.property
@pytest.mark.parametrize("kind", ["barrel", "globoidal"])
def test_all_kinds_with_one_motion_ask_for_one_torque(kind):
    same = ("motion.motion_to_dwell=2", "pins=12")
    assert numbers(run(kind, *TABLE, *same)) == numbers(run("default", *TABLE, *same))


@pytest.mark.analytical
def test_values_of_a_globoidal_drive():
    found = numbers(run("globoidal", *TABLE))
    step, angle, speed = np.pi / 6, 4 * np.pi / 3, 2 * np.pi
    assert found["drive.table_torque.maximum"] == pytest.approx(20 * speed**2 * step * 5.527957 / angle**2 + 15, rel=1e-5)
    assert found["drive.reflected_inertia.maximum"] == pytest.approx(20 * (1.759603 * step / angle) ** 2, rel=1e-5)
    assert found["drive.friction_work"] == pytest.approx(15 * step, rel=1e-5)
    assert found["drive.mean_power"] == pytest.approx(15 * step * speed / (2 * np.pi), rel=1e-5)
    assert found["drive.mean_torque"] * 2 * np.pi == pytest.approx(15 * step, rel=1e-5)
    assert found["drive.peak_power"] == pytest.approx(found["drive.peak_torque"] * speed)
    assert found["drive.braking_power"] > 0


@pytest.mark.analytical
def test_motor_sees_the_torque_through_ratio_and_losses():
    plain, geared = numbers(run("globoidal", *TABLE)), numbers(run("globoidal", *TABLE, *MOTOR))
    lossless = numbers(run("globoidal", *TABLE, "motor.ratio=20"))
    for name in ("peak_torque", "rms_torque", "mean_torque"):
        assert lossless[f"motor.{name}"] == pytest.approx(plain[f"drive.{name}"] / 20)
    for name in ("peak_power", "rms_power", "mean_power", "braking_power"):
        assert lossless[f"motor.{name}"] == pytest.approx(plain[f"drive.{name}"])
    assert geared["motor.peak_power"] == pytest.approx(plain["drive.peak_power"] / 0.8)
    assert geared["motor.braking_power"] == pytest.approx(plain["drive.braking_power"] * 0.8)
    assert geared["motor.mean_power"] > plain["drive.mean_power"] / 0.8
    assert geared["motor.speed"] == pytest.approx(40 * np.pi)
    assert geared["motor.inertia_ratio"] == pytest.approx(plain["drive.reflected_inertia.maximum"] / 400 / 5e-4)
    assert geared["motor.reflected_inertia.mean"] == pytest.approx(plain["drive.reflected_inertia.mean"] / 400)


def test_ratings_of_the_motor_are_checked():
    found = run("globoidal", *TABLE, *MOTOR, "motor.rated_torque=0.2 N m", "motor.maximum_torque=50 N m")
    checks = {check.name: check for check in found.checks}
    assert not checks["motor.rated_torque"].ok and checks["motor.rated_torque"].value == found["motor.rms_torque"]
    assert checks["motor.maximum_torque"].ok and checks["motor.maximum_torque"].value == found["motor.peak_torque"]


def test_table_that_asks_for_more_than_the_judged_torque_is_told():
    assert any("the table needs up to" in each for each in run("globoidal", *TABLE, "load.torque=20 N m").findings)
    assert not any("the table needs up to" in each for each in run("globoidal", *TABLE).findings)


@pytest.mark.parametrize(
    ("changes", "words"), [(TABLE[:2] + ("load.speed=",), "load.speed is not given"), (("load.speed=60 rpm",), "[table] is not given")]
)
def test_why_there_is_no_torque_at_the_input_is_told(changes, words):
    result = dw.run(load("globoidal", *changes), ("motion", "drive"))
    assert "drive" not in result.tables
    assert any(words in each for each in (*result.findings, *result.warnings))


def test_motor_without_a_table_is_told():
    assert any("[motor] is not used" in each for each in dw.run(load("globoidal", "motor.ratio=5"), ("motion",)).findings)


@pytest.mark.property
def test_many_designs_have_the_torque_of_their_runs():
    spec, keys, names = load("default", *TABLE), ["table.inertia", "motion.motion_to_dwell"], ["drive.peak_torque", "drive.rms_torque"]
    evaluate = batch(spec, keys, names)
    assert evaluate is not None
    found = evaluate(np.array([[1.0, 1.0], [3.0, 2.0]]))
    for row, (inertia, ratio) in enumerate(((1.0, 1.0), (3.0, 2.0))):
        one = run("default", *TABLE, f"table.inertia={inertia} kg m^2", f"motion.motion_to_dwell={ratio}")
        for name in names:
            assert found[name][row] == pytest.approx(one[name], rel=1e-12)


@pytest.mark.error
@pytest.mark.parametrize(
    ("change", "key", "words"),
    [
        ("table.inertia=-2 kg m^2", "table.inertia", "must be at least 0 kg m.2, got -2 kg m.2"),
        ("table.friction_torque=-1 N m", "table.friction_torque", "0"),
        ("table.inertia=2 kg", "table.inertia", "moment of inertia"),
        ("motor.efficiency=1.2", "motor.efficiency", "1"),
        ("motor.ratio=0", "motor.ratio", "0"),
    ],
)
def test_what_has_no_meaning_is_refused_by_key(change, key, words):
    with pytest.raises(SpecError, match=words) as told:
        load("globoidal", *TABLE, change)
    assert told.value.key == key
