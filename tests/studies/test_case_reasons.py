"""Reasons of cases in groups: what differs in numbers only is one, names stay, and each number tells its range."""

import pytest

from drivewright.execution.case_reasons import UNKNOWN, ReasonGroup, reason_groups

pytestmark = pytest.mark.interface

OFF = "loads.0.position: {} mm lies outside the shaft, which runs from 0 to 340 mm; move it, or make a segment longer"


def groups(*messages, status="failed"):
    return reason_groups([status] * len(messages), messages)


def only(*messages):
    (found,) = groups(*messages)
    return found


def test_one_group_with_the_range_of_what_differs_and_the_first_in_full():
    found = only(*(OFF.format(number) for number in ("412", "345.5", "-1e3", "412")))
    assert found == ReasonGroup("failed", 4, 0, OFF.format(412), OFF.format("-1e3 … 412"))
    assert found.text() == f"{OFF.format('-1e3 … 412')} (the first: {OFF.format(412)})"


def test_equal_messages_are_told_once():
    found = only("no oil at 3 mm", "no oil at 3 mm")
    assert found.cases == 2 and found.text() == "no oil at 3 mm"
    assert only("no oil at 3.0 mm", "no oil at 3 mm").text() == "no oil at 3.0 mm"


def test_the_largest_group_first_and_equal_ones_in_the_order_of_the_cases():
    found = groups("b 1", "a", "b 2", "c", None, "")
    assert [(each.cases, each.first, each.row) for each in found] == [(2, "b 1", 0), (2, UNKNOWN, 4), (1, "a", 1), (1, "c", 3)]


def test_complete_cases_have_no_reason_and_statuses_stay_apart():
    found = reason_groups(["complete", "failed", "partial", "complete", "partial"], ["left out", "x 1", "x 2", "", "x 3"])
    assert [(each.status, each.cases, each.row) for each in found] == [("partial", 2, 2), ("failed", 1, 1)]
    assert reason_groups([], []) == [] and reason_groups(["complete"], ["left out"]) == []


@pytest.mark.parametrize(
    ("one", "two"),
    [
        ("loads.0.position: off", "loads.1.position: off"),
        ("station m1 is bad", "station m2 is bad"),
        ("no bearing is called '61804'", "no bearing is called '61805'"),
        ('no bearing is called "61804"', 'no bearing is called "61805"'),
        ("joint A-2x", "joint A-3x"),
        ("3 mm", "3 um"),
    ],
)
def test_names_keep_reasons_apart(one, two):
    assert len(groups(one, two)) == 2


@pytest.mark.parametrize(
    ("one", "two", "summary"),
    [
        ("at 1.5 deg", "at -.5 deg", "at -.5 … 1.5 deg"),
        ("limit 10..20 deg", "limit 10..35 deg", "limit 10..20 … 35 deg"),
        ("got '1.2 mm' (size)", "got '3 mm' (size)", "got '1.2 … 3 mm' (size)"),
        ("sum is 10 N m", "sum is 9 N m", "sum is 9 … 10 N m"),
        ("(2e-3)", "(1e-2)", "(2e-3 … 1e-2)"),
        ("'a' 5, 7, 7.", "'a' 6, 7, 8.", "'a' 5 … 6, 7, 7 … 8."),
    ],
)
def test_numbers_do_not(one, two, summary):
    found = only(one, two)
    assert (found.summary, found.first, found.cases) == (summary, one, 2)


def test_ranges_are_those_of_all_cases():
    assert only("x 5", "x 2", "x 9", "x 5").summary == "x 2 … 9"


def test_long_messages_are_cut_and_only_where_that_is_asked_for():
    found = only("a" * 30 + " 1", "a" * 30 + " 2")
    assert found.text(10) == f"{'a' * 10} ... (the first: {'a' * 10} ...)" and found.text(99) == found.text()
    assert only("b" * 12).text(12) == "b" * 12
