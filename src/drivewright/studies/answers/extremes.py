"""Which combination of inputs gives the least and the greatest of each value, and what linear theory's worst corner really gives."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from drivewright.execution.case_table import CASE
from drivewright.result import Column, Table, Value
from drivewright.studies.answers.all_cases import moments_of, row_of
from drivewright.studies.answers.causes import theories
from drivewright.studies.answers.parts import Arranged, Part, about, join_names, plain, together
from drivewright.studies.plan import Plan
from drivewright.studies.study import Study
from drivewright.studies.variables import Variable
from drivewright.view.text import quantity

Rerun: TypeAlias = Callable[[Mapping[str, NDArray[Any]]], Study]  # {key: values in SI} of some cases -> a study of them
ENDS = ("least", "greatest")
STRAIGHT = 0.05  # part of what linear theory says of the way to its worst corner that may be wrong without a word


class End(NamedTuple):
    """The least or greatest of a value [SI] with the interval that it has in its case, and the number of that case."""

    number: float
    low: float
    high: float
    case: int

    @property
    def bounds(self) -> tuple[float, float] | None:
        """Ends of its interval, None where it has none."""
        return (self.low, self.high) if np.isfinite(self.low) and np.isfinite(self.high) else None


def extremes(arranged: Arranged) -> Part:
    """`Part` of all cases: table `extremes` of all values and margins with the inputs of their ends, and one for each shown value."""
    found = {name: ends for name in arranged.known_names if (ends := ends_of(arranged, name)) is not None}
    if not found:
        return Part()
    rows = [(name, end, each) for name, ends in found.items() for end, each in zip(ENDS, ends, strict=True)]
    shown = [_of_value(arranged, name, found[name]) for name in arranged.plotted if name in found]
    return Part(tables=(_all(arranged, rows), *shown))


def ends_of(arranged: Arranged, name: str) -> tuple[End, End] | None:
    """(least, greatest) of a column over all cases of the study, also where only some are held; None where no case has it."""
    if arranged.everything:
        ends = arranged.everything.ends[name]
        rows = [arranged.everything.row(case) for case in (ends.least_at, ends.greatest_at)] if ends.count else []
        return (_end(rows[0], name, 0), _end(rows[1], name, 0)) if rows else None
    column = np.asarray(arranged.study[name], float)
    if not np.any(np.isfinite(column)):
        return None
    return _end(arranged.study, name, int(np.nanargmin(column))), _end(arranged.study, name, int(np.nanargmax(column)))


def ends_of_columns(study: Study, names: Sequence[str]) -> dict[str, tuple[End, End]]:
    """{column: its (least, greatest)} of the columns that a case has, read piece by piece."""
    found = {name: each for name, each in moments_of(study, names).items() if each.count}
    return {
        name: (_end(row_of(study, each.least_at), name, 0), _end(row_of(study, each.greatest_at), name, 0)) for name, each in found.items()
    }


def _end(study, name, row):
    low, high = study.bounds(name) or ([np.nan] * len(study),) * 2
    return End(float(study[name][row]), float(low[row]), float(high[row]), int(study[CASE][row]))


def _all(arranged, rows):
    """Table of all ends, a column for each key."""
    study, ends = arranged.study, [end for *_, end in rows]
    number = Column("number", "", "the end of the value", np.array([end.number for end in ends]))
    low, high = (np.array([getattr(end, side) for end in ends]) for side in ("low", "high"))
    inputs = arranged.whole_plan.at(np.array([end.case for end in ends]))
    columns = (
        Column("value", "", "value of the result, or margin of a check to its limit", np.array([name for name, *_ in rows])),
        Column("unit", "", "unit of the row's number", np.array([study.unit(name) for name, *_ in rows])),
        Column("end", "", "which end over all cases", np.array([end for _, end, _ in rows])),
        number,
        *(number.bounds(low, high) if np.any(np.isfinite(low)) else ()),
        Column("case", "-", "number of the case", np.array([end.case for end in ends])),
        Column("kind", "", "kind of case: a corner, of the sample ...", np.array([kind_of(arranged.whole_plan, end.case) for end in ends])),
        *(Column(key, unit, key, plain(inputs[key])) for key, unit in key_units(arranged.whole_plan).items()),
    )
    return Table("extremes", "Least and greatest values, and the inputs that give them", columns)


def key_units(plan: Plan) -> dict[str, str]:
    """{key: SI unit} of all keys that vary."""
    return {key: variable.kind.unit for variable in plan.variables for key in variable.keys}


def kind_of(plan: Plan, case: int) -> str:
    """Name of the block that a case is of; of levels, or of a file of points, there is only one."""
    point = case % plan.inner
    block = next((block.name for block in plan.blocks if block.start <= point < block.stop), "")
    return {"corners": "corner", "steps": "step", "a": "sample", "b": "sample"}.get(block, block) or ("points" if plan.listed else "levels")


def _of_value(arranged, name, ends):
    """Table of the keys, with their values at both ends of a value."""
    study, plan, system = arranged.study, arranged.whole_plan, arranged.study.spec.units
    inputs = plan.at(np.array([end.case for end in ends]))
    units = key_units(plan)
    columns = [_column(end, [inputs[key][place] for key in units], units.values(), system) for place, end in enumerate(ENDS)]
    texts = [f"{quantity(end.number, study.unit(name), system=system, label=study.label(name))} in case {end.case}" for end in ends]
    return Table(
        f"extremes.{name}",
        f"{study.label(name)}: inputs of the least ({texts[0]}) and of the greatest ({texts[1]})",
        (
            Column("key", "", "key that varies", np.array(list(units))),
            Column("unit", "", "unit of the row's numbers", np.array(list(units.values()))),
            *columns,
        ),
    )


def _column(end, cells, units, system):
    """Values of the keys at an end: numbers, or texts where one of them is none."""
    what = f"its value at the {end} value"
    if all(isinstance(cell, (float, int, np.number)) and not isinstance(cell, (bool, np.bool_)) for cell in cells):
        return Column(end, "", what, np.array(cells, float))
    return Column(end, "-", what, np.array([input_text(cell, unit, system) for cell, unit in zip(cells, units, strict=True)]))


def input_text(cell: Any, unit: str, system: Any) -> str:
    """A value of a key as people read it."""
    if isinstance(cell, (bool, np.bool_)):
        return str(bool(cell)).lower()
    return quantity(float(cell), unit, system=system) if isinstance(cell, (int, float, np.number)) else str(cell)


# -- the corner that linear theory calls worst ---------------------------------------------------------------------------------


class Corner(NamedTuple):
    """A corner by the signs of the slopes: the value, which end, what linear theory says of it and the upper ends of the keys (d,)."""

    name: str
    end: str
    linear: float
    nominal: float
    upper: NDArray[np.bool_]


def linear_corners(arranged: Arranged, rerun: Rerun | None = None) -> Part:
    """`Part` of the shown values: table `linear_corners`, each value at the corner where linear theory has it least or greatest.

    There dy/dx_k and the deviation of key k have one sign for every key.  The value is that of the case at this corner, which is run for
    this where the study has no corners; what linear theory says of it is off by `difference`.
    """
    corners = list(_corners(arranged)) if arranged.combinations == 1 and not arranged.everything else []
    if not corners:
        return Part()
    computed = _computed(arranged, corners, rerun)
    study, random = arranged.study, arranged.plan.random
    inputs = np.array([[each.ends[up] for each, up in zip(random, corner.upper.astype(int), strict=True)] for corner in corners]).T
    table = Table(
        "linear_corners",
        "Worst corners of linear theory, computed",
        (
            Column("value", "", "value of the result", np.array([corner.name for corner in corners])),
            Column("unit", "", "unit of the row's numbers", np.array([study.unit(corner.name) for corner in corners])),
            Column("end", "", "which end by linear theory", np.array([corner.end for corner in corners])),
            Column("linear", "", "what linear theory says", np.array([corner.linear for corner in corners])),
            Column("computed", "", "value at this corner", computed),
            Column("difference", "", "computed value less that of linear theory", computed - [corner.linear for corner in corners]),
            *(Column(each.key, each.kind.unit, each.key, column) for each, column in zip(random, inputs, strict=True)),
        ),
        missing="a corner that cannot be computed has no value",
    )
    values = dict(_corner_values(study, corners, computed))
    return Part(values, (table,), findings=tuple(_bends(study, corners, computed)))


def _corner_values(study, corners, computed):
    for corner, number in zip(corners, computed, strict=True):
        told = about(study, corner.name, f"computed at the {corner.end} corner of linear theory")
        yield f"linear.{corner.end}.{corner.name}.computed", Value(float(number), study.unit(corner.name), **told)


def _corners(arranged):
    for name in arranged.plotted:
        samples = arranged.of(name)
        for theory in theories(arranged, name):
            nominal = float(samples[0, arranged.block("nominal")][0])
            if np.all(np.isfinite(theory.slope)) and np.any(theory.slope):
                yield Corner(name, "least", theory.least, nominal, theory.slope < 0)
                yield Corner(name, "greatest", theory.greatest, nominal, theory.slope > 0)


def _computed(arranged, corners, rerun):
    """Values (corners,) at some corners, nan where there is none."""
    block = arranged.block("corners")
    if block is not None:  # all of them, the first key slowest
        keys = len(arranged.plan.random)
        places = [int(corner.upper @ (1 << np.arange(keys)[::-1])) for corner in corners]
        return np.array([arranged.of(corner.name)[0, block][place] for corner, place in zip(corners, places, strict=True)])
    if rerun is None:
        return np.full(len(corners), np.nan)
    random: tuple[Variable, ...] = arranged.plan.random
    own = {each: np.array([each.ends[int(corner.upper[k])] for corner in corners]) for k, each in enumerate(random)}
    study = rerun({key: column for each, values in own.items() for key, column in each.columns(values).items()})
    return np.array([study[corner.name][n] if corner.name in study.column_names else np.nan for n, corner in enumerate(corners)], float)


def _bends(study, corners, computed):
    """One finding on all values of which linear theory is far off."""
    far = {
        corner.name: f"{corner.name} ({corner.end} {texts[0]}, not {texts[1]})"
        for corner, number in zip(corners, computed, strict=True)
        if np.isfinite(number) and abs(number - corner.linear) > STRAIGHT * abs(corner.linear - corner.nominal)
        for texts in [[quantity(each, study.unit(corner.name), system=study.spec.units) for each in (number, corner.linear)]]
    }
    if far:
        texts = join_names(list(far.values()))
        yield f"not linear in the keys between their ends, as the corners show that linear theory calls worst: {texts}"


def worst_inputs(arranged: Arranged, rerun: Rerun | None = None) -> Part:
    """`Part` of both."""
    return together([extremes(arranged), linear_corners(arranged, rerun)])


def inputs_text(study: Study, case: int, most: int = 8) -> str:
    """The inputs of a case in one line, "size 8 mm, ratio 0.2"."""
    inputs, units = study.plan.at(np.array([case])), key_units(study.plan)
    texts = [f"{key} {input_text(inputs[key][0], unit, study.spec.units)}" for key, unit in list(units.items())[:most]]
    return ", ".join(texts) + (f" and {len(units) - most} more" if len(units) > most else "")
