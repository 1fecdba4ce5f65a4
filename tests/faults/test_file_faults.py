"""Kill, tear and fill the disk at every file operation of what writes: nothing of a person is lost, and the next start ends the work."""

import pytest
from file_faults import run_scenario

pytestmark = pytest.mark.property

FAULTS = ["kill", "torn", "full", "read-only", "once"]
STEPS = {  # every so many operations, for a few seconds; the slow tests try all of them, with every scenario and fault
    "run-folder": 16,
    "run-folder-by-two-renames": 16,
    "sweep": 40,
    "sweep-without-ledger": 12,
    "sweep-with-damaged-ledger": 20,
    "sweep-with-damaged-part": 25,
    "optimise": 60,
    "table": 24,
}
LONG = {"answers": 9, "run": 9, "export": 9, "export-for-the-shop": 9}  # commands that write the same kinds of file again and again


@pytest.mark.parametrize(("fault", "scenario"), [("kill", "run-folder"), ("kill", "sweep"), ("kill", "table"), ("full", "run-folder")])
def test_at_some_operations(scenario, fault, tmp_path):
    assert int(run_scenario(scenario, tmp_path, fault, STEPS[scenario])) >= 3


@pytest.mark.slow
@pytest.mark.parametrize("scenario", [*STEPS, *LONG])
@pytest.mark.parametrize("fault", FAULTS)
def test_at_every_operation(scenario, fault, tmp_path):
    print(scenario, fault, run_scenario(scenario, tmp_path, fault, LONG.get(scenario, 1)))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("scenario", "step"), [("run-folder", 2), ("run-folder-by-two-renames", 6), ("sweep-with-damaged-ledger", 12), ("sweep", 12)]
)
def test_at_operations_and_again_at_those_of_the_next_start(scenario, step, tmp_path):
    print(scenario, "kill twice", run_scenario(scenario, tmp_path, "kill-twice", step))
