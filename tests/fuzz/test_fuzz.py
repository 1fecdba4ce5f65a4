"""Presets and examples with faults in them: an answer or a refusal, never a traceback, a hang, a crash or a number that is none.

A case that goes wrong is looked at with `python -m tests.fuzz NUMBER`; when it is mended it becomes a named test in test_fuzz_found.py.
"""

import pytest

from .cases import case_of
from .pool import answers

pytestmark = pytest.mark.error

FEW, MANY, CHUNK = 40, 5000, 250
WORKERS = 2


def wrong(numbers):
    """{number: what is wrong} of the cases that go wrong."""
    found = {answer["number"]: answer for answer in answers(numbers, WORKERS)}
    assert sorted(found) == sorted(numbers)
    return {number: answer["wrong"] for number, answer in found.items() if answer["wrong"]}


@pytest.mark.slow
def test_forty_cases():
    assert wrong(range(FEW)) == {}


@pytest.mark.slow
@pytest.mark.parametrize("first", range(FEW, MANY, CHUNK))
def test_thousands_of_cases(first):
    assert wrong(range(first, min(first + CHUNK, MANY))) == {}


def test_a_case_is_made_from_its_number_alone():
    assert all(repr(case_of(number)) == repr(case_of(number)) for number in range(60))
    assert len({repr(case_of(number)) for number in range(60)}) == 60


@pytest.mark.slow
def test_two_processes_say_the_same_of_one_case():
    numbers = [number for number in range(12) if case_of(number).entry != "run"]
    one, other = ({each["number"]: (each["code"], each["err"]) for each in answers(numbers, 1)} for _ in range(2))
    assert {number: (code, _without_folder(text)) for number, (code, text) in one.items()} == {
        number: (code, _without_folder(text)) for number, (code, text) in other.items()
    }


def _without_folder(text):
    """A message without the folder of its case, whose name is drawn."""
    import re

    return re.sub(r"/tmp\w*/[\w/]+", "FOLDER", text)
