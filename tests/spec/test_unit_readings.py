"""Units of one reading: what they are read as is among the findings of a run, and changes nothing else."""

import pickle

import pytest

from drivewright import runner
from drivewright.errors import SpecError
from drivewright.spec import Spec, load
from drivewright.spec.fields import Field, Named, Text
from drivewright.spec.parsing import change_key, read_document
from drivewright.spec.readings import readings
from drivewright.units import Frequency, Speed, Torque, Unbalance

pytestmark = pytest.mark.interface

CAM = "examples/disc_cam.toml"
SAID = "drive.speed: '25 Hz' is read as 25 rev/s"


@pytest.fixture
def spec():
    return load(CAM, ["drive.speed=25 Hz"])


def test_the_reading_belongs_to_the_text_and_not_to_the_design(spec):
    same = load(CAM, ["drive.speed=25 rev/s"])
    assert dict(spec.readings) == {"drive.speed": SAID} and not same.readings
    assert spec == same and hash(spec) == hash(same) and spec.digest() == same.digest() and spec.to_toml() == same.to_toml()


def test_a_copy_keeps_the_readings_of_the_keys_that_it_keeps(spec):
    assert pickle.loads(pickle.dumps(spec)).readings == spec.readings == spec.replace(title="another").readings
    assert not spec.replace({"drive.speed": "30 rpm"}).readings
    assert spec.replace({"drive.speed": "30 1/min"}).readings == {"drive.speed": "drive.speed: '30 1/min' is read as 30 rev/min"}


def test_a_spec_built_in_python_has_them_too(spec):
    built = type(spec)(**load_tables(["drive.speed=1500 1/min"]))
    assert built.readings == {"drive.speed": "drive.speed: '1500 1/min' is read as 1500 rev/min"}


def load_tables(changes):
    tables = read_document(CAM)
    for change in changes:
        change_key(tables, change)
    return tables


def test_a_run_says_it_first(spec):
    assert SAID in runner.run(spec, "geometry").findings
    assert not [each for each in runner.run(load(CAM), "geometry").findings if "is read as" in each]


class Motor(Spec):
    """A table of a list."""

    speed: Speed
    torque: Torque = Field("1 N m")
    note: Text = ""


class Plant(Spec):
    """Tables at all depths."""

    motors: tuple[Motor, ...] = ()
    pumps: Named[Motor] = Field({})
    torques: tuple[Torque, ...] = ()
    unbalance: Unbalance = Field("1 g mm")
    ripple: Frequency = Field("1 Hz")


def test_keys_of_lists_and_named_tables_are_found_and_no_others():
    tables = {
        "motors": [{"speed": "3 rpm", "note": "5 Hz"}, {"speed": "2 Hz", "torque": "8 oz-in"}],
        "pumps": {"main": {"speed": "9/min"}},
        "torques": ["1 N m", "2 oz in"],
        "unbalance": "3 oz in",
        "ripple": "50 Hz",
    }
    assert readings(Plant(**tables), tables) == {
        "motors.1.speed": "motors.1.speed: '2 Hz' is read as 2 rev/s",
        "motors.1.torque": "motors.1.torque: '8 oz-in' is read as 8 ozf in",
        "pumps.main.speed": "pumps.main.speed: '9/min' is read as 9 rev/min",
        "torques.1": "torques.1: '2 oz in' is read as 2 ozf in",
    }


def test_what_has_no_single_reading_is_refused():
    with pytest.raises(SpecError, match=r"drive.speed: wants an angular speed, got '25 1/s' \(frequency\)"):
        load(CAM, ["drive.speed=25 1/s"])


# -- systems of units ----------------------------------------------------------------------------------------------------------


def test_the_units_shown_change_no_number_and_no_digest():
    mm, inch = load(CAM), load(CAM, ["units=inch"])
    assert (mm.units, inch.units) == ("mm", "inch") and mm.digest() == inch.digest()
    one, other = (runner.run(each, "geometry").record() for each in (mm, inch))
    assert one["values"] == other["values"] and one["checks"] == other["checks"]


def test_an_unknown_system_is_refused():
    with pytest.raises(SpecError, match='units: must be one of "mm", "si", "inch", got \'inches\''):
        load(CAM, ["units=inches"])


def test_a_spec_in_inches_and_pounds_is_the_same_design():
    metric = ["follower.roller_radius=12.7 mm", "load.mass=0.45359237 kg", "load.force=44.482216152605 N", "drive.speed=1500 rpm"]
    customary = ["follower.roller_radius=500 mil", "load.mass=16 oz", "load.force=0.01 kip", "drive.speed=25 Hz"]
    one, other = load(CAM, metric), load(CAM, customary)
    assert one.digest() == other.digest() != load(CAM).digest()
    assert runner.run(one, "geometry").values == runner.run(other, "geometry").values
