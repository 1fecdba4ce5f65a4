"""What to change so that a value becomes the number that is wanted: one dimension, each way verified by a run."""

from collections.abc import Sequence
from typing import Any

from drivewright import runner
from drivewright.errors import InputError, UnknownName
from drivewright.report.content import check_label
from drivewright.result import Result
from drivewright.steps import detailed
from drivewright.studies.adjustable import dimensions
from drivewright.studies.reaching import Reached, Way, reach
from drivewright.studio.design import Design
from drivewright.studio.jobs.design_keys import is_locked, label
from drivewright.studio.jobs.fix import changed, questions
from drivewright.studio.jobs.progress import LONGER, Progress
from drivewright.units import any_quantity
from drivewright.view.text import display_unit, quantity

PATIENCE = 30.0  # seconds of the search


def reach_value(
    design: Design, progress: Progress, value: str = "", target: str = "", longer: bool = False, locks: Sequence[str] = ()
) -> dict[str, Any]:
    """The changes of one dimension each with which a value is as wanted; keys that are locked stay.

    {"value", "ways": [{"changes": [{"key", "label", "before", "given"}], "load": {key: text}, "value", "also_passes", "then_fails"}],
    "reason": why there is none, "" where there is one, "nearest": {"value", "key", "label", "at"} or None, "stopped": the time was over}.
    """
    spec = design.spec_on_screen()
    with detailed(progress) as step:
        result = runner.run(spec, progress=step)
    wanted = _wanted(result, value, target)
    if result.outcome != "complete":
        return _none(value, "the run of this design did not end, so no change can be compared with it")
    seconds, found, free = PATIENCE * (LONGER if longer else 1), Reached(()), 0
    for asked in questions(result):
        held = {each.key for each in dimensions(asked.spec) if is_locked(design.tables, each.key, locks)}
        free += len(dimensions(asked.spec)) - len(held)
        found = reach(asked, value, wanted, seconds, held, lambda number: progress(0, 0, f"design {number} is being computed"))
        if found.ways or found.stopped:
            break
    if found.ways:
        return {
            "value": value,
            "ways": [_way(design, result, value, way) for way in found.ways],
            "reason": "",
            "nearest": None,
            "stopped": False,
        }
    return _none(value, _reason(free, found.stopped, seconds), _nearest(design, result, value, found), found.stopped)


def _wanted(result: Result[Any], name: str, text: str) -> float:
    """The number [SI] that is wanted of a value, as it was typed."""
    if name not in result.values:
        raise UnknownName("value", name, result.values)
    unit = display_unit(result.values[name].plain().unit)[1]
    part = 100.0 if unit in ("-", "") and text.rstrip().endswith("%") else 1.0
    number, kind = any_quantity(text.rstrip(" %\u00a0") if part > 1 else text)
    if kind != any_quantity("1" if unit in ("-", "") else f"1 {unit}")[1]:
        raise InputError(f"{text} is no number of this kind; wanted is one in {'no unit' if unit in ('-', '') else unit}")
    return number / part


def _reason(free: int, stopped: bool, seconds: float) -> str:
    if not free:
        return "no dimension that may change is free; unlock one"
    return f"no change was found within {seconds:.0f} s" if stopped else "no change of one dimension within its range gives this value"


def _none(value: str, reason: str, nearest: dict[str, str] | None = None, stopped: bool = False) -> dict[str, Any]:
    return {"value": value, "ways": [], "reason": reason, "nearest": nearest, "stopped": stopped}


def _nearest(design: Design, result: Result[Any], name: str, found: Reached) -> dict[str, str] | None:
    """The nearest value that was seen, in words."""
    if found.nearest is None:
        return None
    value, key, unit, at = found.nearest
    return {"value": quantity(value, result.values[name].unit), "key": key, "label": label(design.tables, key), "at": quantity(at, unit)}


def _way(design: Design, result: Result[Any], name: str, way: Way) -> dict[str, Any]:
    labels = {each.name: check_label(each) for each in result.checks}
    return {
        "changes": [changed(design.tables, way.change)],
        "load": {way.change.key: way.change.given},
        "value": quantity(way.value, result.values[name].unit),
        "also_passes": [labels[check] for check in way.also_passes],
        "then_fails": [labels[check] for check in way.then_fails],
    }
