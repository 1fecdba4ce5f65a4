"""Advice in words: 'prime radius 42 mm instead of 38 mm gives 30°'."""

from collections.abc import Mapping
from typing import Any

from drivewright.advice import Advice, Change
from drivewright.labels import key_in_words, usual_unit
from drivewright.report.words import Words, words_of
from drivewright.result import Check, Result
from drivewright.units import System
from drivewright.view.text import number, shown_scale, with_unit

MOST_TURNED = 3  # other checks that are named


def advice_texts(result: Result[Any], words: Words | None = None) -> dict[str, str]:
    """{check: what to change so that it passes} of the advice of a result, in English or in other words."""
    checks = {check.name: check for check in result.checks}
    return {each.check: advice_text(each, checks, result.units, words) for each in result.advice}


def advice_text(advice: Advice, checks: Mapping[str, Check], system: System, words: Words | None = None) -> str:
    """ "prime radius 42 mm instead of 38 mm gives 30°; but 'Wall of the hub' would fail"."""
    words = words or words_of("en")
    check = checks[advice.check]
    shown = shown_scale(check.unit, usual_unit(check.display_label, check.unit), system, check.limit)
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
