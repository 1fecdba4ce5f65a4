"""Steps within an analysis reach who shows progress, and nobody else."""

import pytest

from drivewright import cases, steps
from drivewright.steps import detailed, note_step

pytestmark = pytest.mark.interface


@pytest.fixture
def told(monkeypatch):
    monkeypatch.setattr(steps, "EACH", 0.0)
    return []


def test_a_step_is_told_under_the_name_of_what_goes_on(told):
    note_step("before anybody listens", 1, 2)
    with detailed(lambda *words: told.append(words)) as step:
        note_step("meshing a pin")
        step(1, 4, "solid_stress")
        note_step("condensing a pin", 3, 9)
    note_step("after", 1, 2)
    assert told == [(0, 0, "meshing a pin"), (1, 4, "solid_stress"), (1, 4, "solid_stress: condensing a pin, 3 of 9")]


def test_an_inner_listener_hears_alone_and_gives_back(told):
    with detailed(lambda *words: told.append(("outer", words[2]))):
        with detailed(lambda *words: told.append(("inner", words[2]))):
            note_step("one")
        note_step("two")
    assert told == [("inner", "one"), ("outer", "two")]


def test_threads_of_cases_are_heard(told):
    with detailed(lambda *words: told.append(words[2])):
        cases.run(lambda n: note_step(f"case {n}"), range(4), workers=2)
    assert sorted(told) == [f"case {n}" for n in range(4)]


def test_many_quick_steps_are_told_now_and_then(told, monkeypatch):
    monkeypatch.setattr(steps, "EACH", 60.0)
    with detailed(lambda *words: told.append(words[2])):
        for number in range(1000):
            note_step("quick", number + 1, 1000)
    assert told == ["quick, 1 of 1000"]


def test_a_listener_that_raises_ends_what_goes_on():
    def cancel(done, total, what):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt), detailed(cancel):
        note_step("long", 1, 2)
