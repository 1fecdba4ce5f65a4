"""Advice in words: 'prime radius 42 mm instead of 38 mm gives 30°'."""

import math
from collections.abc import Mapping
from typing import Any

from drivewright.advice import Advice, Change
from drivewright.labels import key_in_words
from drivewright.report.words import Words, words_of
from drivewright.result import Check, Result
from drivewright.units import System
from drivewright.view.text import SIGNS, labelled_scale, number, shown_scale, with_unit

MOST_TURNED = 3  # other checks that are named
MOST_FAILED = 2  # checks of which the first lines of a report speak


def failed_texts(result: Result[Any], words: Words | None = None) -> list[str]:
    """A sentence for each of the checks that fail by most: its value, its limit, what to change; and the labels of more.

    "Maximum pressure angle 34.2° (limit ≤ 30°): prime radius 42 mm instead of 38 mm gives 30°."
    """
    words, advice = words or words_of("en"), advice_texts(result, words)
    failed = sorted((check for check in result.checks if not check.ok), key=lambda check: _shortfall(check), reverse=True)
    texts = [_failed_text(check, advice.get(check.name, ""), result.units, words) for check in failed[:MOST_FAILED]]
    others = {check.name: check for check in failed[MOST_FAILED:]}
    return texts + ([words("Also failing: *.", _labels(tuple(others), others, words))] if others else [])


def _shortfall(check: Check) -> float:
    """How far a check is from passing, over the larger of value and limit: 1 and more where nothing of it is reached."""
    size = max(abs(check.limit), abs(check.value)) if math.isfinite(check.value) else 0.0
    return -check.margin / size if size else math.inf


def _failed_text(check: Check, advice: str, system: System, words: Words) -> str:
    shown = labelled_scale(check.display_label, check.unit, system, check.limit or check.value)
    value, limit = (with_unit(number(shown.of(each), 4), shown.unit) for each in (check.value, check.limit))
    text = words("* * (limit * *)", words(check.display_label), value, SIGNS[check.sense], limit)
    return f"{text}: {advice}." if advice else f"{text}."


def advice_texts(result: Result[Any], words: Words | None = None) -> dict[str, str]:
    """{check: what to change so that it passes} of the advice of a result, in English or in other words."""
    checks = {check.name: check for check in result.checks}
    return {each.check: advice_text(each, checks, result.units, words) for each in result.advice}


def advice_text(advice: Advice, checks: Mapping[str, Check], system: System, words: Words | None = None) -> str:
    """ "prime radius 42 mm instead of 38 mm gives 30°; but 'Wall of the hub' would fail"."""
    words = words or words_of("en")
    check = checks[advice.check]
    shown = labelled_scale(check.display_label, check.unit, system, check.limit)
    changes = [_change(change, system, words) for change in advice.changes]
    reached = with_unit(number(shown.of(advice.value), 4), shown.unit)
    text = words("* gives *", *changes, reached) if len(changes) == 1 else words("* and * give *", *changes, reached)
    if advice.also_passes:
        text += words("; * passes too", _labels(advice.also_passes, checks, words))
    if advice.then_fails:
        text += words("; but * would fail", _labels(advice.then_fails, checks, words))
    return text


def _change(change: Change, system: System, words: Words) -> str:
    """ "prime radius 42 mm instead of 38 mm"."""
    shown = shown_scale(change.unit, system=system, size=change.before)
    after, before = (with_unit(number(shown.of(value)), shown.unit) for value in (change.after, change.before))
    return words("* instead of *", f"{words.exact(key_in_words(change.key))} {after}", before)


def _labels(names: tuple[str, ...], checks: Mapping[str, Check], words: Words) -> str:
    """The labels of checks, the first few of them."""
    labels = [f"'{words(checks[name].display_label)}'" for name in names[:MOST_TURNED]]
    return ", ".join([*labels, words("* more", len(names) - MOST_TURNED)] if len(names) > MOST_TURNED else labels)
