"""Advice in words: 'prime radius 42 mm instead of 38 mm gives 30°'."""

from drivewright.advice import Advice, Change
from drivewright.labels import key_in_words
from drivewright.result import Check, Result
from drivewright.units import System
from drivewright.view.text import number, shown_scale, with_unit

MOST_TURNED = 3  # other checks that are named


def advice_texts(result: Result) -> dict[str, str]:
    """{check: what to change so that it passes} of the advice of a result."""
    checks = {check.name: check for check in result.checks}
    return {each.check: advice_text(each, checks, result.units) for each in result.advice}


def advice_text(advice: Advice, checks: dict[str, Check], system: System) -> str:
    """ "prime radius 42 mm instead of 38 mm gives 30°; then 'Wall of the hub' fails"."""
    check = checks[advice.check]
    changes = " and ".join(change_text(change, system) for change in advice.changes)
    shown = shown_scale(check.unit, system=system, size=check.limit)
    text = f"{changes} give{'' if len(advice.changes) > 1 else 's'} {with_unit(number(shown.of(advice.value), 4), shown.unit)}"
    if advice.also_passes:
        text += f"; {_labels(advice.also_passes, checks)} pass{'' if len(advice.also_passes) > 1 else 'es'} too"
    if advice.then_fails:
        text += f"; but {_labels(advice.then_fails, checks)} would fail"
    return text


def change_text(change: Change, system: System) -> str:
    """ "prime radius 42 mm instead of 38 mm"."""
    shown = shown_scale(change.unit, system=system, size=change.before)
    after, before = (with_unit(number(shown.of(value)), shown.unit) for value in (change.after, change.before))
    return f"{key_in_words(change.key)} {after} instead of {before}"


def _labels(names: tuple[str, ...], checks: dict[str, Check]) -> str:
    """The labels of checks, the first few of them."""
    labels = [f"'{checks[name].display_label}'" for name in names[:MOST_TURNED]]
    if len(names) > MOST_TURNED:
        return f"{', '.join(labels)} and {len(names) - MOST_TURNED} more"
    return " and ".join(filter(None, (", ".join(labels[:-1]), labels[-1])))
