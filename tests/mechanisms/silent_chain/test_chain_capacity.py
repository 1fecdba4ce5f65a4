"""Wear and rating of a chain drive: values, intervals, checks, what feeds back into the closure, what is left out and why."""

import numpy as np
import pytest

import drivewright as dw
from drivewright.chains.standards import ansi_power
from drivewright.errors import SpecError
from drivewright.spec import from_document
from drivewright.spec.parsing import change_key

pytestmark = pytest.mark.interface

RPM = np.pi / 30
SPEC = {
    "mechanism": "silent-chain",
    "chain": "60-2",
    "links": 100,
    "teeth": [19, 38],
    "drive": {"speed": "600 rpm", "preload": "3 kN", "load_torque": "150 N m"},
    "wear": {"coefficient_range": ["5e-8 mm^3/(N m)", "2e-7 mm^3/(N m)"]},
}


def spec(*changes):
    tables = {key: dict(value) if isinstance(value, dict) else value for key, value in SPEC.items()}
    for change in changes:
        change_key(tables, change)
    return from_document(tables)


def run(*changes, only=("wear", "contact")):
    return dw.run(spec(*changes), only=only)


def check(result, name):
    return next(each for each in result.checks if each.name == name)


@pytest.mark.analytical
def test_life_by_the_closed_form():
    result = run("wear.coefficient=1e-7 mm^3/(N m)")
    pull = result["strand.tight_force"] + result["strand.slack_force"] + 2 * result["strand.centrifugal_force"]
    length = 12.57e-3 + 2 * 2.42e-3
    depth = np.pi * 1e-16 * pull * (1 / 19 + 1 / 38) / (2 * length)
    assert result["wear.depth"] == pytest.approx(depth, rel=1e-12, abs=0)
    turn = 100 * 19.05e-3 / result["chain.speed"]
    assert result["wear.life"] == pytest.approx(0.03 * 19.05e-3 / depth * turn, rel=1e-12)
    assert result.values["wear.life"].unit == "s" and result["wear.sliding"] == pytest.approx(5.94e-3 * 2 * np.pi * (1 / 19 + 1 / 38))


@pytest.mark.property
def test_a_range_of_the_coefficient_makes_intervals():
    life = run().values["wear.life"]
    assert life.interval == "given" and life.made == "bound, given"
    assert life.low < life.value < life.high
    assert life.high / life.value == pytest.approx(2) and life.value / life.low == pytest.approx(2)
    assert run("wear.coefficient_range=", "wear.coefficient=1e-7 mm^3/(N m)").values["wear.life"].low is None
    table = run().tables["wear"]
    assert table["elongation"].data[0] == 0 and np.all(np.diff(table["elongation.high"].data) > 0)
    assert np.interp(life.low, table["time"].data, table["elongation.high"].data) == pytest.approx(0.03, rel=1e-12)


def test_a_life_asked_for_is_a_check_with_its_interval():
    life = run().values["wear.life"]
    for hours, verdict in ((life.low / 3600 - 1, True), (life.high / 3600 + 1, False)):
        found = check(run(f"limits.wear_life={hours} h"), "wear.life")
        assert found.ok is verdict
    undecided = check(run(f"limits.wear_life={life.value / 3600} h"), "wear.life")
    assert (undecided.low, undecided.high) == (pytest.approx(life.low), pytest.approx(life.high))


@pytest.mark.property
def test_the_running_time_goes_into_the_closure():
    new, worn = run(only=("closure",)), run("wear.running_time=10000 h", only=("closure", "wear"))
    given = run(f"closure.elongation={worn['wear.elongation']!r}", only=("closure",))
    assert worn["centre_distance.mean"] == given["centre_distance.mean"] > new["centre_distance.mean"]
    both = run("wear.running_time=10000 h", "closure.elongation=0.01", only=("closure",))
    assert dw.build(spec("wear.running_time=10000 h", "closure.elongation=0.01")).elongation == pytest.approx(
        0.01 + worn["wear.elongation"]
    )
    assert both["centre_distance.mean"] > worn["centre_distance.mean"]
    assert check(worn, "wear.elongation").ok and any("only the pitches with outer plates" in finding for finding in worn.findings)
    assert any("wear is added to closure.elongation" in each for each in run("closure.elongation=0.01").findings)


def test_many_teeth_shorten_the_life():
    few, many = run("teeth=[19, 38]", "links=200"), run("teeth=[19, 114]", "links=200")
    assert few["wear.elongation_limit"] == 0.03 and many["wear.elongation_limit"] == pytest.approx(2 / 114)


def test_rolling_pins_do_not_wear_by_sliding():
    tables = {
        "mechanism": "silent-chain",
        "pitch": "9.525 mm",
        "links": 82,
        "teeth": [35, 37],
        "joint": {"rolling_radius": "1.2 mm"},
        "plate": {"apothem": "2.6 mm"},
        "drive": {"speed": "2000 rpm", "preload": "150 N"},
        "wear": {"coefficient": "1e-7 mm^3/(N m)", "running_time": "1000 h"},
    }
    result = dw.run(from_document(tables), only="wear")
    assert any("pins that roll on each other do not slide" in each for each in result.findings)
    assert dw.build(from_document(tables)).elongation == 0
    hinge = {**tables, "joint": {"kind": "revolute", "pin_diameter": "3 mm"}}
    found = dw.run(from_document(hinge), only=("wear", "contact"))
    tight = found["strand.tight_force"] + found["strand.slack_force"] + 2 * found["strand.centrifugal_force"]
    assert found["wear.depth"] == pytest.approx(np.pi * 1e-16 * tight * (1 / 35 + 1 / 37) / 2e-3, rel=1e-12, abs=0), "the fewer plates bear"


@pytest.mark.error
@pytest.mark.parametrize(
    ("changes", "key"),
    [
        (("wear.coefficient_range=",), "wear.coefficient"),
        (('wear.coefficient_range=["2e-7 mm^3/(N m)", "5e-8 mm^3/(N m)"]',), "wear.coefficient_range"),
        (("wear.coefficient=1e-6 mm^3/(N m)",), "wear.coefficient_range"),
        (("wear.coefficient=0 mm^3/(N m)",), "wear.coefficient"),
        (("wear.running_time=1e6 h",), "wear.running_time"),
    ],
)
def test_refusals_name_the_key(changes, key):
    with pytest.raises(SpecError) as refused:
        dw.build(spec(*changes)).elongation  # noqa: B018  computed when it is asked for
    assert refused.value.key == key


@pytest.mark.analytical
def test_rated_power_of_an_american_chain():
    result = run(only=("rating",))
    limits = ansi_power("60", 19.05e-3, 19, 600 * RPM)
    assert result["rating.rated_power"] == pytest.approx(1.7 * limits.rated, rel=1e-12)
    assert (
        result["rating.plate_fatigue"] == pytest.approx(1.7 * limits.plate_fatigue)
        and result["rating.roller_impact"] > result["rating.plate_fatigue"]
    )
    assert result["rating.power"] == pytest.approx(150 * 300 * RPM) and check(result, "rating.power").ok
    hard = run("rating.service_factor=6", only=("rating",))
    assert hard["rating.design_power"] == pytest.approx(6 * result["rating.power"]) and not check(hard, "rating.power").ok
    slower = run("teeth=[38, 19]", only=("rating",))
    assert slower["rating.rated_power"] == pytest.approx(1.7 * ansi_power("60", 19.05e-3, 19, 1200 * RPM).rated), "of the smaller sprocket"


def test_the_makers_rating_counts():
    result = run("chain=12B-2", "rating.rated_power=5 kW", only=("rating",))
    assert result["rating.rated_power"] == pytest.approx(8500) and "rating.plate_fatigue" not in result.values
    assert run("chain=12B-2", "rating.rated_power=5 kW", "rating.strand_factor=1.8", only=("rating",))[
        "rating.rated_power"
    ] == pytest.approx(9000)


@pytest.mark.error
def test_a_table_that_is_written_and_left_out_is_a_warning():
    def warned(*changes):
        return [each for each in dw.run(spec("wear=", "drive=", "chain=12B", *changes)).warnings if "'rating'" in each]

    assert not warned() and not warned("rating.service_factor=1")
    assert len(warned("rating.service_factor=1.5")) == 1


@pytest.mark.error
@pytest.mark.parametrize(
    ("changes", "words"),
    [(("chain=12B",), "no rating is known"), (("drive.load_torque=0 N m",), "no power is transmitted"), (("drive=",), "add [drive]")],
)
def test_why_there_is_no_rating(changes, words):
    assert any(words in finding for finding in run(*changes, only=("rating",)).findings)
