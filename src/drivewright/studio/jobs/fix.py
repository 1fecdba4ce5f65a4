"""What to change so that a check which fails passes: the smallest change of one or two dimensions, verified by a run."""

import time
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from drivewright import runner
from drivewright.advice import Advice, Change
from drivewright.errors import InputError, UnknownName
from drivewright.report.content import check_label
from drivewright.result import Check, Result
from drivewright.steps import detailed
from drivewright.studies.adjustable import dimensions
from drivewright.studies.advising import advise, is_advisable
from drivewright.studio.design import Design
from drivewright.studio.jobs.design_keys import is_locked, label
from drivewright.studio.jobs.other_part import Place, other_part, places
from drivewright.studio.jobs.progress import LONGER, Progress
from drivewright.view.text import SIGNS, quantity

PATIENCE = 30.0  # seconds of the search for a change


def fix(design: Design, progress: Progress, check: str = "", longer: bool = False, locks: Sequence[str] = ()) -> dict[str, Any]:
    """The change of one or two dimensions with which a failed check passes, or another bought part; keys that are locked stay.

    {"check", "changes": [{"key", "label", "before", "given"}], "load": {key: text}, "value", "limit", "also_passes", "then_fails": labels
    of other checks whose verdict turns, "reason": why there is no change, "" where there is one, "stopped": the time was over}.  "pick":
    {"key", "text"} where the change is another part, which is chosen and not loaded.
    """
    spec = design.spec_on_screen()
    with detailed(progress) as step:
        result = runner.run(spec, progress=step)
    failed = _check_named(result, check)
    seconds = PATIENCE * (LONGER if longer else 1)
    if is_advisable(failed) and (other := other_part(design, result, failed, progress, seconds / 2, locks)):
        return _part_found(design, result, failed, *other)
    deadline, free, stopped, found = time.monotonic() + seconds, 0, False, None
    locks = [*locks, *(key for place in places(design) for key in place.overrides)]  # the ratings of a bought part are no dimensions
    for asked in questions(result) if is_advisable(failed) else ():
        held = {each.key for each in dimensions(asked.spec) if is_locked(design.tables, each.key, locks)}
        here = len(dimensions(asked.spec)) - len(held)
        free += here
        if not here:
            continue
        advised = advise(
            asked,
            deadline - time.monotonic(),
            checks=(check,),
            held=held,
            tried=lambda number: progress(0, 0, f"design {number} is being computed"),
        )
        stopped, found = advised.advice_stopped, next(iter(advised.advice), None)
        if found or stopped:
            break
    if found is None:
        reason = _reason(failed, result, free, stopped, seconds)
        return {"check": check, "changes": [], "load": {}, "reason": reason, "stopped": stopped}
    return _fix_found(design, result, failed, found)


def questions(result: Result[Any]) -> tuple[Result[Any], ...]:
    """What may change, one after the other: the unknowns of the design's own search, then what its kind calls adjustable."""
    if result.spec.optimise is None:
        return (result,)
    return result, replace(result, spec=result.spec.model_copy(update={"optimise": None}))


def _check_named(result: Result[Any], name: str) -> Check:
    known = {each.name: each for each in result.checks}
    if name not in known:
        raise UnknownName("check", name, known)
    if known[name].ok:
        raise InputError(f"{check_label(known[name])}: this check passes, so there is nothing to change")
    return known[name]


def _reason(failed: Check, result: Result[Any], free: int, stopped: bool, seconds: float) -> str:
    """Why there is no change to propose, in a sentence."""
    if result.outcome != "complete":
        return "the run of this design did not end, so no change can be compared with it"
    if failed.bounds is not None:
        return "the value of this check has an interval: the effect of a small change cannot be told from chance"
    if not is_advisable(failed):
        return "this check has no number that a change could improve"
    if not free:
        return "no dimension that may change is free; unlock one"
    if stopped:
        return f"no change was found within {seconds:.0f} s"
    return "no change of one or two dimensions within their ranges makes this check pass"


def _fix_found(design: Design, result: Result[Any], failed: Check, advice: Advice) -> dict[str, Any]:
    labels = {each.name: check_label(each) for each in result.checks}
    return {
        "check": failed.name,
        "changes": [changed(design.tables, change) for change in advice.changes],
        "load": {change.key: change.given for change in advice.changes},
        "value": quantity(advice.value, failed.unit),
        "limit": f"{SIGNS[failed.sense]} {quantity(failed.limit, failed.unit)}",
        "also_passes": [labels[name] for name in advice.also_passes],
        "then_fails": [labels[name] for name in advice.then_fails],
        "reason": "",
        "stopped": False,
    }


def _part_found(design: Design, result: Result[Any], failed: Check, place: Place, part: str, tried: Result[Any]) -> dict[str, Any]:
    """The answer where another bought part makes the check pass; "pick" is what the page then asks for."""
    labels, after = {each.name: check_label(each) for each in result.checks}, {each.name: each for each in tried.checks}
    turned = [each for each in result.checks if each.name in after and each.name != failed.name and after[each.name].ok != each.ok]
    return {
        "check": failed.name,
        "changes": [{"key": place.key, "label": label(design.tables, place.key), "before": place.part, "given": part}],
        "load": {},
        "pick": {"key": place.key, "text": part},
        "value": quantity(after[failed.name].value, failed.unit),
        "limit": f"{SIGNS[failed.sense]} {quantity(failed.limit, failed.unit)}",
        "also_passes": [labels[each.name] for each in turned if not each.ok],
        "then_fails": [labels[each.name] for each in turned if each.ok],
        "reason": "",
        "stopped": False,
    }


def changed(tables: Mapping[str, Any], change: Change) -> dict[str, str]:
    """A change of a key as the page shows it."""
    return {
        "key": change.key,
        "label": label(dict(tables), change.key),
        "before": quantity(change.before, change.unit),
        "given": change.given,
    }
