"""A value brought to a wanted number by one dimension: against closed forms, at the ends of a range, where nothing reaches it."""

import math
from dataclasses import replace

import pytest
from study_toy import TOY, install

from drivewright import runner
from drivewright.errors import InputError, UnknownName
from drivewright.registry import Analysis
from drivewright.result import Answer, Check, Value
from drivewright.spec import from_document
from drivewright.studies import reaching
from drivewright.studies.reaching import reach

RUN = {"mechanism": "toy", "size": "10 mm", "force": "2 N", "ratio": 0.25, "angle": "30 deg"}


def answered(spec, done):
    """work = force size, of which a design larger than 18 mm has none; steps jumps; small and strong are its checks."""
    if spec.size > 0.018:
        raise InputError("too large")
    values = {
        "work": Value(spec.force * spec.size, "N m", "force by size"),
        "sine": Value(math.sin(spec.angle), "-", "sine of angle"),
        "steps": Value(math.floor(spec.ratio * 8), "-", "jumps"),
        "fixed": Value(3.0, "-", "of nothing"),
    }
    checks = (Check("small", spec.size, 0.012, "<=", "m", "it fits"), Check("strong", spec.force, 2.5, ">=", "N", "it holds"))
    return Answer(values=values, checks=checks)


@pytest.fixture
def result(monkeypatch):
    drive = replace(
        TOY, analyses=(Analysis("main", answered, "what it is"),), adjustable={"size": 2.0, "force": 2.0, "angle": 3.0, "ratio": 2.0}
    )
    install(monkeypatch.setattr, drive)
    return runner.run(from_document(RUN))


def test_every_dimension_that_reaches_it_is_a_way_and_a_run_agrees(result):
    found = reach(result, "work", 0.028, 60.0)
    ways = {way.change.key: way for way in found.ways}
    assert set(ways) == {"size", "force"} and not found.stopped and found.nearest is None
    assert ways["size"].change.after == pytest.approx(0.014, rel=2e-4) and ways["force"].change.after == pytest.approx(2.8, rel=2e-4)
    for way in found.ways:
        again = runner.run(from_document({**RUN, way.change.key: way.change.given}))
        assert again.values["work"].value == pytest.approx(0.028, rel=2e-4) and again.values["work"].value == pytest.approx(way.value)
    assert ways["size"].then_fails == ("small",) and ways["force"].also_passes == ("strong",)
    assert [way.change.key for way in found.ways] == ["force", "size"]  # what makes a check fail comes last


def test_few_digits_are_enough_where_the_number_is_round(result):
    (way,) = reach(result, "work", 0.026, 60.0, held=("size",)).ways
    assert way.change.given == "2.6 N" and way.change.before == 2.0


def test_a_target_on_the_other_side_is_reached_by_less(result):
    (way,) = reach(result, "sine", math.sin(math.radians(17.0)), 60.0).ways
    assert way.change.key == "angle" and way.change.after == pytest.approx(math.radians(17.0), rel=1e-3)


def test_the_nearest_is_told_where_no_range_reaches_it(result):
    found = reach(result, "work", 0.1, 60.0, held=("size",))
    assert not found.ways and found.nearest.key == "force" and found.nearest.value == pytest.approx(0.04)  # twice the force at most


def test_a_design_that_has_no_answer_ends_a_range(result):
    """Up to 18 mm there is one, and the factor of the dimension would go to 20 mm."""
    reached = reach(result, "work", 0.0355, 60.0, held=("force",))
    beyond = reach(result, "work", 0.0361, 60.0, held=("force",))
    assert [way.change.after for way in reached.ways] == [pytest.approx(0.01775, rel=2e-4)]
    assert not beyond.ways and 0.03 < beyond.nearest.value <= 0.036


def test_a_jump_is_no_way(result):
    assert not reach(result, "steps", 2.5, 60.0).ways


def test_what_nothing_moves_and_what_there_is_not(result):
    assert not reach(result, "fixed", 4.0, 60.0).ways
    with pytest.raises(UnknownName, match="no value is called 'wrok'"):
        reach(result, "wrok", 1.0, 60.0)


def test_time_that_is_over_says_so(result):
    found = reach(result, "work", 0.028, -1.0)
    assert found.stopped and not found.ways


def test_no_more_ways_than_are_of_use(result, monkeypatch):
    monkeypatch.setattr(reaching, "ENOUGH", 1)
    assert len(reach(result, "work", 0.028, 60.0).ways) == 1
