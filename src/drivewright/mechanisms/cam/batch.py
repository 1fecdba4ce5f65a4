"""Many cams at once for the optimiser: the measures of a run, with columns in the place of the spec's numbers."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import cache, partial
from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.cams import nan_unless
from drivewright.errors import DrivewrightError, InputError
from drivewright.mechanisms.cam.build import CamModel, assembled, build, clear_of_axis, programme_of
from drivewright.mechanisms.cam.geometry import geometry_measures, motion_measures
from drivewright.mechanisms.cam.loads import force_measures, is_loaded, no_forces, no_spring, spring_measures
from drivewright.mechanisms.cam.profiles import finished_profiles, is_untrimmed, untrimmed_measures
from drivewright.mechanisms.cam.spec import CamSpec
from drivewright.result import Answer
from drivewright.spec import value_at
from drivewright.spec.designs import accepted_blocks, evaluator_of_blocks, numbers_of, with_columns, with_samples, within_limits

BLOCK = 32  # designs at a time: their samples over the turn stay in the processor's cache
TABLES = ("follower", "conjugate", "groove", "drive", "load", "spring", "face", "manufacture", "limits")
PROGRAMME = ("angle", "rise", "b", "c", "d")  # keys of a segment; each choice of them is a motion of its own


def batch(spec: CamSpec, keys: Sequence[str], names: Sequence[str]) -> Callable[[Floats], dict[str, Floats]] | None:
    """designs (n, d) -> {name: (n,)}; None where a key or a value is beyond it, which then runs one by one.

    A design that the spec or the build refuses is nan in every name; a value that does not exist for a design is nan.
    """
    if spec.valve or spec.follower.lift_at or (spec.spring and spec.spring.mass):  # the motion depends on the arms, surge on the speed
        return None
    of_motion = [key for key in keys if _is_of_motion(spec, key)]
    rest = [key for key in keys if key not in of_motion]
    if not all(_is_number(spec, key) for key in rest):
        return None
    measures = _measures(with_samples(spec, rest), names)
    if measures is None:
        return None

    def by_motion(columns, rows):
        """(rows, {name: (n,)}) of the designs that nothing refuses."""
        varied = {key: columns[key] for key in rest}
        for motion, own in _by_motion(columns, of_motion, rows):
            yield from _of_one_motion(with_columns(spec, motion), varied, own, measures)

    return evaluator_of_blocks(keys, names, partial(within_limits, type(spec)), by_motion)


def _is_of_motion(spec, key):
    """Whether a key changes the motion.  The rise of a swing says by its type that it is an angle, which a column does not."""
    table, _, rest = key.partition(".")
    number, _, name = rest.partition(".")
    swings = spec.follower.motion == "oscillating"
    return table == "programme" and number.isdigit() and name in PROGRAMME and not (name == "rise" and swings)


def _is_number(spec, key):
    """Whether a key is a number of a table that the spec has."""
    table, _, name = key.partition(".")
    return table in TABLES and getattr(spec, table) is not None and not isinstance(value_at(spec, key), str) and "." not in name


def _by_motion(columns, keys, rows):
    """({key: number}, rows) of the designs that share a motion."""
    if not keys:
        return [({}, rows)]
    shared, group = np.unique(np.stack([columns[key][rows] for key in keys], axis=1), axis=0, return_inverse=True)
    return [(dict(zip(keys, numbers, strict=True)), rows[group.ravel() == k]) for k, numbers in enumerate(shared)]


def _of_one_motion(spec, columns, rows, measures):
    """(rows, {name: (n,)}) of the designs with the motion of a spec that nothing refuses."""
    try:
        programme = programme_of(spec)
    except InputError:
        return

    def alone(row):
        """The spec of one design."""
        return with_columns(spec, {key: float(column[row]) for key, column in columns.items()})

    @cache
    def is_left(row):
        """Whether anything is left of the cam of one design, by trimming."""
        try:
            build(alone(row))
        except InputError:
            return False
        return True

    def measured(rows):
        """{name: (n,)} of the designs in these rows."""
        model = assembled(with_columns(spec, {key: column[rows, None] for key, column in columns.items()}), programme)
        near = ~np.broadcast_to(np.all(clear_of_axis(model).reshape(len(model.tracks), -1), axis=0), rows.shape)
        if not all(is_left(row) for row in rows[near].tolist()):
            raise InputError("cam: of some designs nothing is left")
        found = _columns((number for measure in measures.always for number in numbers_of(measure(model))), rows)
        if measures.untrimmed:
            profiles = _columns((number for measure in measures.untrimmed for number in numbers_of(measure(model))), rows)
            for place in np.flatnonzero(~np.broadcast_to(np.ravel(is_untrimmed(model)), rows.shape)):
                trimmed = _trimmed(alone(rows[place]))
                for name, column in profiles.items():
                    column[place] = trimmed.get(name, np.nan)
                for column in () if trimmed else found.values():  # without a profile nothing is known of the design
                    column[place] = np.nan
            found |= profiles
        return found

    yield from accepted_blocks(rows, measured, BLOCK)


class Measures(NamedTuple):
    """The functions that give the requested names: those of any design, and those of a design whose profile nothing trims."""

    always: list[Callable[[CamModel], Answer]]
    untrimmed: list[Callable[[CamModel], Answer]]


def _columns(numbers, rows):
    """{name: (n,)} of (name, number)."""
    return {name: np.array(np.broadcast_to(np.ravel(number), rows.shape), float) for name, number in numbers}


def _trimmed(spec):
    """{name: number} of the finished profiles of one design; none where they fail."""
    try:
        return dict(numbers_of(finished_profiles(build(spec), {})))
    except DrivewrightError:
        return {}


def _measures(spec, names):
    """The `Measures` of these names, of all that the analyses of a cam use; None where a name is not among them."""
    try:
        model = assembled(spec, programme_of(spec))
        kinds = [
            {measure: {name for name, _ in numbers_of(measure(model))} for measure in of_kind}
            for of_kind in (_all_measures(model), untrimmed_measures(model))
        ]
    except DrivewrightError:  # the run of one design says why
        return None
    if not set(names) <= set().union(*(own for given in kinds for own in given.values())):
        return None
    return Measures(*([measure for measure, own in given.items() if own & set(names)] for given in kinds))


def _all_measures(model: CamModel) -> Iterator[Callable[[CamModel], Answer]]:
    yield from motion_measures(model)
    yield from geometry_measures(model)
    if no_forces(model.spec) is None:
        yield from (partial(_where_loaded, measure) for measure in force_measures(model))
    if no_spring(model.spec) is None:
        yield from (partial(_where_loaded, measure) for measure in spring_measures(model))


def _where_loaded(measure, model):
    """The answer of a measure for the designs that have a load."""
    answer, loaded = measure(model), is_loaded(model.spec)
    values = {name: value._replace(value=nan_unless(loaded, value.value)) for name, value in answer.values.items()}
    return replace(answer, values=values, checks=tuple(c._replace(value=nan_unless(loaded, c.value)) for c in answer.checks))
