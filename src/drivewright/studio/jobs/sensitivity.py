"""Which key moves which number: every key of a design a little down and up, one at a time."""

import math
import time
from collections.abc import Sequence
from typing import Any

import numpy as np
from annotated_types import Ge, Gt, Le, Lt

from drivewright import registry, runner
from drivewright.errors import SpecError, UnknownName
from drivewright.execution.case_table import MESSAGE
from drivewright.execution.evaluation import case_task
from drivewright.execution.outputs import CHECK
from drivewright.labels import label_of
from drivewright.report.content import check_label, headline
from drivewright.spec import Study
from drivewright.spec.fields import field_at, marker_of
from drivewright.studies.plan import Block, Plan
from drivewright.studies.statistics import NORMAL
from drivewright.studies.store import Memory
from drivewright.studies.sweeps import compute_study
from drivewright.studies.variables import Variable
from drivewright.studio.design import Design
from drivewright.studio.jobs.design_keys import is_locked, label, numeric, plain
from drivewright.studio.jobs.progress import Progress
from drivewright.view.text import display_unit, quantity

ROUNDING = 1e-12  # of a number: no change
PATIENCE = 2.0  # seconds of a run, beyond which only the analyses that check something are asked


def sensitivity(
    design: Design,
    progress: Progress,
    locks: Sequence[str] = (),
    targets: Sequence[str] | None = None,
    share: float = 0.01,
    workers: int | None = None,
    on: str | None = None,
) -> dict[str, Any]:
    """How each number of a run follows each key of the design, by central differences of `share` of the key.

    {"targets": [{"name", "label", "unit", "kind", "base", "relative", "bars": [{"key", "label", "step", "low", "high", "effect"}],
    "still": [keys without effect], "unclear": [keys whose effect is within chance], "failed": [keys]}], "failed": [{"key", "text"}],
    "remarks"}, the strongest key first.  low and high are the target with the key a step down and up.  effect: of a check the change of
    its margin per per cent of the key; of a value its own change in per cent per per cent.  Where the value is 0 the change itself; where
    the key is 0 its step stands for one per cent.
    """
    spec = design.spec_on_screen()
    keys = {key: found for key, found in numeric(design, spec).items() if not is_locked(design.tables, key, locks)}
    if not keys:
        raise SpecError("no number of this design is free to change; unlock some")
    wanted, analyses = _requested_targets(spec, progress, targets)
    steps = _steps(spec, keys, share)
    plan = _plan(keys, steps)
    asking = spec.model_copy(update={"study": Study(analyses=analyses, values=tuple(wanted))})
    study = compute_study(
        Memory(),
        asking,
        plan,
        case_task(asking, plan.keys),
        workers,
        on,
        lambda done, total, what: progress(done, total, f"design {done} of {total}"),
    )
    rows = [_target(design, study, name, about, keys, steps) for name, about in wanted.items()]
    return {"targets": rows, "failed": _failed(study, keys), "remarks": list(study.remarks)}


# -- what is asked -------------------------------------------------------------------------------------------------------------


def _requested_targets(spec, progress, names):
    """(the numbers to follow as `_targets` gives them, the analyses that give them)."""
    mechanism, model = registry.mechanism(spec.mechanism), runner.build(spec)
    result = runner.run(spec, model=model, progress=progress)
    began = time.perf_counter()  # of a second run: the first one compiles
    answers = runner.run_analyses(spec, model, runner.select_analyses(mechanism.analyses))
    slow = time.perf_counter() - began > PATIENCE and not names
    given = {
        name: {*answer.values, *(f"{CHECK}{check.name}" for check in answer.checks)}
        for name, answer in answers.items()
        if answer.checks or not slow
    }
    wanted = {name: about for name, about in _targets(result, names).items() if any(name in each for each in given.values())}
    return wanted, tuple(name for name, each in given.items() if each & wanted.keys())


def _targets(result, names):
    """{column: (kind, label, SI unit, value)} of the checks' margins and the headline values; of those named, if any are."""
    targets = {f"{CHECK}{c.name}": ("check", check_label(c), c.unit, c.margin) for c in result.checks}
    for value in headline(result):
        about = result.values[value["name"]]
        targets[value["name"]] = ("value", value["label"], about.unit, about.value)
    for name in names or ():
        if name not in targets and name in result.values:
            about = result.values[name]
            targets[name] = ("value", label_of(about.meaning or name, about.label), about.unit, about.value)
        elif name not in targets:
            raise UnknownName("value or check", name, {*targets, *result.values})
    return {name: targets[name] for name in names} if names else targets


# -- steps ---------------------------------------------------------------------------------------------------------------------


def _steps(spec, keys, share):
    """{key: (down, up)} [SI]: the share of the value, or of the largest like it where it is 0, as far as the key's limits leave room."""
    return {key: _room(spec, key, value, share * (abs(value) or _scale(key, kind, keys))) for key, (kind, value) in keys.items()}


def _scale(key, kind, keys):
    """Size of a key that is 0: the largest of its kind in its table, or in the design; 1 of a pure number or an angle."""
    if kind.name == "number" or kind.unit == "rad":
        return 1.0
    alike = {other: abs(value) for other, (its, value) in keys.items() if its == kind and value}
    near = [size for other, size in alike.items() if other.split(".")[0] == key.split(".")[0]]
    return max(near or alike.values(), default=1.0 / display_unit(kind.unit)[0])


def _room(spec, key, value, step):
    """(down, up): the step, shortened to stay within the limits of the key."""
    field = field_at(type(spec), key.split("."))
    down = up = step
    for mark, name, part in ((Ge, "ge", 1.0), (Gt, "gt", 0.5)):
        if limit := marker_of(field, mark):
            down = min(down, part * (value - getattr(limit, name)))
    for mark, name, part in ((Le, "le", 1.0), (Lt, "lt", 0.5)):
        if limit := marker_of(field, mark):
            up = min(up, part * (getattr(limit, name) - value))
    return down, up


def _plan(keys, steps):
    """The design itself, then each key down and up."""
    nominal = np.array([value for _, value in keys.values()])
    points = np.repeat(nominal[None], 1 + 2 * len(keys), axis=0)
    for k, (down, up) in enumerate(steps.values()):
        points[1 + 2 * k, k] -= down
        points[2 + 2 * k, k] += up
    variables = tuple(Variable(key, kind, value) for key, (kind, value) in keys.items())
    return Plan((), variables, points, (Block("nominal", 0, 1), Block("steps", 1, len(points))), {})


# -- what came out -------------------------------------------------------------------------------------------------------------


def _target(design, study, name, about, keys, steps):
    """One number with its bars."""
    kind, text, unit, value = about
    column = study[name] if name in study.column_names else np.full(len(study), np.nan)
    relative = kind == "value" and value != 0
    errors = study.errors(name) if name in study.column_names else None
    bars, still, unclear, failed = [], [], [], []
    for k, (key, (of, at)) in enumerate(keys.items()):
        effect = _effect(column[0], column[1 + 2 * k], column[2 + 2 * k], at, steps[key])
        if not math.isfinite(effect):
            failed.append(key)
        elif effect == 0:
            still.append(key)
        elif errors is not None and _within_chance(column, errors, 1 + 2 * k):
            unclear.append(key)
        else:
            bars.append(
                {
                    "key": key,
                    "label": label(design.tables, key),
                    "step": quantity(max(steps[key]), of.unit),
                    "low": plain(column[1 + 2 * k], unit),
                    "high": plain(column[2 + 2 * k], unit),
                    "effect": 100 * effect / abs(value) if relative else plain(effect, unit),
                }
            )
    bars.sort(key=lambda bar: -abs(bar["effect"]))
    return {
        "name": name,
        "label": text,
        "unit": display_unit(unit)[1],
        "kind": kind,
        "base": plain(value, unit),
        "relative": relative,
        "bars": bars,
        "still": still,
        "unclear": unclear,
        "failed": failed,
    }


def _within_chance(column, errors, row):
    """Whether a number changes no more between the step down and the step up than two draws of one chaotic case would."""
    error = float(np.hypot(*errors[row : row + 2]))
    return abs(column[row + 1] - column[row]) <= NORMAL * error


def _effect(base, low, high, at, steps):
    """Change of a number per per cent of a key at `at`; from one side where the other has no number, or no room."""
    down, up = steps
    low, down = (low, down) if math.isfinite(low) else (base, 0.0)
    high, up = (high, up) if math.isfinite(high) else (base, 0.0)
    if not down + up > 0:
        return math.nan
    if abs(high - low) <= ROUNDING * max(abs(high), abs(low)):
        return 0.0
    return (high - low) / (100 * (down + up) / abs(at) if at else (down + up) / max(steps))


def _failed(study, keys):
    """Keys of which neither step could be computed, with the reason."""
    messages, status = study[MESSAGE], study["status"]
    return [
        {"key": key, "text": messages[1 + 2 * k] or messages[2 + 2 * k]}
        for k, key in enumerate(keys)
        if status[1 + 2 * k] == status[2 + 2 * k] == "failed"
    ]
