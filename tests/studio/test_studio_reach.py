"""A key number brought to a value, and another bought part for a check that fails, as the page asks for them."""

import pytest
from places import EXAMPLES

from drivewright import runner
from drivewright.errors import DrivewrightError
from drivewright.studio import part_lists
from drivewright.studio.document import Document
from drivewright.studio.jobs.fix import fix
from drivewright.studio.jobs.other_part import places
from drivewright.studio.jobs.reach import reach_value
from drivewright.studio.opening import opened

pytestmark = pytest.mark.interface

ROCKER = "rocker.swing"


def told(*news):
    """Progress that nobody looks at."""


@pytest.fixture(scope="module")
def four_bar():
    return opened(EXAMPLES / "four_bar.toml")


def swing(design, changes):
    document = Document(design)
    document.load(changes)
    return runner.run(document.design.spec_on_screen(), only=("motion",)).values[ROCKER].value


def test_a_swing_of_sixty_degrees_exactly(four_bar):
    found = reach_value(four_bar, told, ROCKER, "60 deg")
    assert found["reason"] == "" and len(found["ways"]) > 1
    for way in found["ways"]:
        assert swing(four_bar, way["load"]) == pytest.approx(1.0471975512, abs=1e-3)
        (change,) = way["changes"]
        assert way["load"] == {change["key"]: change["given"]} and way["value"].endswith("°")


def test_a_locked_dimension_stays(four_bar):
    free = {way["changes"][0]["key"] for way in reach_value(four_bar, told, ROCKER, "55 deg")["ways"]}
    held = reach_value(four_bar, told, ROCKER, "55 deg", locks=sorted(free))["ways"]
    assert free and not free & {way["changes"][0]["key"] for way in held}


def test_what_is_not_possible_says_what_is_nearest(four_bar):
    found = reach_value(four_bar, told, ROCKER, "175 deg", locks=["ground", "bodies.coupler", "bodies.rocker"])
    assert not found["ways"] and found["reason"] == "no change of one dimension within its range gives this value"
    assert found["nearest"]["value"].endswith("°") and "crank" in found["nearest"]["label"]


@pytest.mark.parametrize(
    ("value", "target", "words"),
    [
        (ROCKER, "60 mm", "is no number of this kind"),
        (ROCKER, "sixty", "number unit"),
        (ROCKER, "", "number unit"),
        (ROCKER, "1e999 deg", "finite"),
        ("__class__", "1", "no value is called"),
    ],
)
def test_nonsense_is_refused_in_words(four_bar, value, target, words):
    with pytest.raises(DrivewrightError, match=words):
        reach_value(four_bar, told, value, target)


# -- another bought part ---------------------------------------------------------------------------------------------------------


def test_stronger_bearings_have_the_bore_of_the_one_before_and_its_type_first():
    found = part_lists.stronger("bearings", "6306")
    assert found[:1] == ["6406"] and "NU306E" in found and "6206" not in found and "6307" not in found
    assert part_lists.stronger("bearings", "no bearing") == part_lists.stronger("no list", "6306") == []


@pytest.fixture
def overloaded():
    """The gearbox shaft with half as much torque again: both bearings are too weak."""
    document = Document(opened(EXAMPLES / "gearbox_shaft.toml"))
    document.load({"gears.0.torque": "400 N m", "gears.1.torque": "-400 N m"})
    return document


def test_a_bearing_that_is_too_weak_gives_way_to_another_one_of_the_list(overloaded):
    found = fix(overloaded.design, told, "life.A")
    (change,) = found["changes"]
    assert change["key"] == "bearings.A.bearing" and change["before"] == "6306" and not found["load"] and not found["then_fails"]
    overloaded.pick(**found["pick"])
    checks = {check.name: check for check in runner.run(overloaded.design.spec_on_screen()).checks}
    assert checks["life.A"].ok and checks["modified_life.A"].ok and "Modified life · A" in found["also_passes"]


def test_no_rating_of_a_part_that_is_bought_is_proposed(overloaded):
    """A locked bearing stays, and no maker sells it with another rating."""
    found = fix(overloaded.design, told, "life.A", locks=["bearings.A.bearing"])
    assert all("rating" not in change["key"] for change in found["changes"])


def test_places_of_parts_and_what_stands_in_their_place(overloaded):
    first, second = places(overloaded.design)
    assert (first.part, second.part) == ("6306", "NU206") and "bearings.A.dynamic_rating" in first.overrides
