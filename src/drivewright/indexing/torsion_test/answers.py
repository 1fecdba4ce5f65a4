"""Values, tables and plots of a torsion test, for every kind that brings one."""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from drivewright._typing import Floats
from drivewright.indexing.torsion_test.regression import Estimate
from drivewright.indexing.torsion_test.result import TorsionTestResult
from drivewright.numerics.ensemble import LEVEL
from drivewright.result import Answer, Column, Plot, Result, Table, Value

ESTIMATES = {  # label, meaning
    "whole_loop": ("whole loop", "slope of the whole loop, least squares of torque on angle (biased low by hysteresis)"),
    "per_branch": ("branches", "slope of the branches, each pass with an intercept of its own (angle on torque)"),
    "corrected": ("corrected", "slope of the branches without the series stiffness of the rig"),
    "inverse": ("whole loop, inverse", "slope of the whole loop, least squares of angle on torque"),
    "loading": ("loading branches", "slope of the branches with rising torque"),
    "unloading": ("unloading branches", "slope of the branches with falling torque"),
}
STIFF, TURN = "N m/rad", "rad"


# -- numbers -------------------------------------------------------------------------------------------------------------------


def torsion_values(tests: Sequence[TorsionTestResult], confidence: float) -> Answer:
    """Every number of the test; over several positions of the crank their mean."""
    values = {}
    for name, (label, meaning) in ESTIMATES.items():
        values |= estimate_values(f"stiffness.{name}", label, meaning, [getattr(test, name) for test in tests], confidence)
    values |= _mean(tests) | (_over_crank(tests) if len(tests) > 1 else _resampled(tests[0], confidence))
    return Answer(values, findings=tuple(_findings(tests)))


def estimate_values(name: str, label: str, meaning: str, estimates: Sequence[Estimate | None], confidence: float) -> dict[str, Value]:
    """Value, standard uncertainty and interval of a stiffness; of several positions the mean, their errors independent.

    The value carries its interval where that is one of 95 %, as those of all results are.
    """
    if None in estimates:
        return {}
    columns = np.array(estimates)
    value, count, share = columns[:, 0].mean(), len(estimates), f"{100 * confidence:g} %"
    below, above = (np.sqrt(np.sum((columns[:, 0] - columns[:, n]) ** 2)) / count for n in (2, 3))
    of = f", mean of {count} positions of the crank" if count > 1 else ""
    rows = (
        ("", value, f"{meaning}{of}", "Stiffness"),
        (".uncertainty", np.sqrt(np.sum(columns[:, 1] ** 2)) / count, f"standard uncertainty of the {meaning}", "Uncertainty"),
        (".low", value - below, f"lower end of the {share} interval of the {meaning}", "Lower bound"),
        (".high", value + above, f"upper end of the {share} interval of the {meaning}", "Upper bound"),
    )
    values = {
        f"{name}{key}": Value(float(number), STIFF, text, label=f"{what}, {label}")
        for key, number, text, what in rows
        if np.isfinite(number)
    }
    if name in values and confidence == LEVEL:
        values[name] = values[name]._replace(low=value - below, high=value + above, interval="fit").plain()
    return values


def _mean(tests: Sequence[TorsionTestResult]) -> dict[str, Value]:
    """Shape of the loop, means over the positions; what no loop shows is absent."""
    shapes, pieces = np.array([t.shape for t in tests]), np.array([t.pieces for t in tests])
    drifts = np.array([np.nan if t.drift is None else t.drift for t in tests])
    rows = (
        ("lost_motion", shapes[:, 0], TURN, "Lost motion", "rotation of the mid-line from -3 % to +3 % of the rated torque"),
        ("backlash", shapes[:, 1], TURN, "Backlash", "width of the loop at zero torque"),
        ("hysteresis_energy", shapes[:, 2], "J", "Hysteresis loss per cycle", "energy lost in a cycle, the area of the loop"),
        ("hysteresis_loss", shapes[:, 3], "-", "Relative hysteresis loss", "energy lost in a cycle over the work put in"),
        ("stiffness.secant", shapes[:, 4], STIFF, "Secant stiffness", "slope of the mid-line from 50 to 100 % of the rated torque"),
        ("stiffness.k1", pieces[:, 0], STIFF, "Stiffness K1", "slope of the first segment of the mid-line, from zero torque on"),
        ("stiffness.k2", pieces[:, 1], STIFF, "Stiffness K2", "slope of the second segment of the mid-line"),
        ("stiffness.k3", pieces[:, 2], STIFF, "Stiffness K3", "slope of the third segment of the mid-line, up to the maximum torque"),
        ("stiffness.t1", pieces[:, 3], "N m", "Breakpoint torque T1", "torque between the first and the second segment of the mid-line"),
        ("stiffness.t2", pieces[:, 4], "N m", "Breakpoint torque T2", "torque between the second and the third segment of the mid-line"),
        ("drift", drifts, TURN, "Removed drift of the angle", "drift of the angle over the test that was removed"),
        ("rated_torque", np.array([t.rated_torque for t in tests]), "N m", "Rated torque", "torque that percentages refer to"),
    )
    return {name: Value(float(data.mean()), unit, text, label=label) for name, data, unit, label, text in rows if np.all(np.isfinite(data))}


def _crank_angle(test: TorsionTestResult) -> float:
    """Position of the crank [rad], nan where the test has none."""
    return np.nan if test.crank is None else float(test.crank)


def _over_crank(tests: Sequence[TorsionTestResult]) -> dict[str, Value]:
    """How the corrected stiffness changes with the position of the crank."""
    curve = np.array([test.corrected.value for test in tests])
    low, high = int(np.argmin(curve)), int(np.argmax(curve))
    return {
        "stiffness.minimum": Value(
            float(curve[low]), STIFF, "minimum corrected stiffness over the crank angle", label="Minimum corrected stiffness"
        ),
        "stiffness.minimum.at": Value(_crank_angle(tests[low]), TURN, "crank angle at minimum stiffness"),
        "stiffness.maximum": Value(
            float(curve[high]), STIFF, "maximum corrected stiffness over the crank angle", label="Maximum corrected stiffness"
        ),
        "stiffness.maximum.at": Value(_crank_angle(tests[high]), TURN, "crank angle at maximum stiffness"),
        "stiffness.range": Value(
            float(np.ptp(curve)), STIFF, "maximum minus minimum corrected stiffness", label="Peak-to-peak corrected stiffness"
        ),
    }


def _resampled(test: TorsionTestResult, confidence: float) -> dict[str, Value]:
    text = f"end of the {100 * confidence:g} % interval by resampled cycles"
    return {
        f"stiffness.{name}.bootstrap.{end}": Value(
            ends[n], STIFF, f"{word} {text} of the {ESTIMATES[name][1]}", label=f"Bootstrap {word} end, {ESTIMATES[name][0]}"
        )
        for name, ends in test.bootstrap.items()
        for n, (end, word) in enumerate((("low", "lower"), ("high", "upper")))
    }


def _findings(tests: Sequence[TorsionTestResult]) -> Iterator[str]:
    """Each finding once, with the number of positions that it is about."""
    places: dict[str, list[float]] = {}
    for test in tests:
        for finding in test.findings:
            places.setdefault(finding, []).append(_crank_angle(test))
    for finding, at in places.items():
        yield finding if len(at) == len(tests) else f"at {len(at)} of {len(tests)} positions ({np.degrees(at[0]):g}° ...): {finding}"


# -- tables --------------------------------------------------------------------------------------------------------------------


def loop_tables(tests: Sequence[TorsionTestResult]) -> tuple[Table, ...]:
    """The loop with its fits, their residuals, and its mid-line; of several positions the least stiff one."""
    test = min(tests, key=lambda each: each.corrected.value)
    at = "" if test.crank is None else f", crank at {np.degrees(test.crank):g}°"
    branch = (test.angle - test.line.intercepts[test.group]) / test.line.slope
    columns = (
        Column("angle", TURN, "angle of the output, zero at the mid-line", test.angle),
        Column("torque", "N m", "torque, measured", test.torque, "Torque, measured"),
        Column(
            "whole_loop",
            "N m",
            "torque, line of the whole loop",
            test.whole_line.intercepts[0] + test.whole_line.slope * test.angle,
            "Torque, whole loop",
        ),
        Column("per_branch", "N m", "torque, lines of the branches", np.where(test.group < 0, np.nan, branch), "Torque, branches"),
    )
    left = np.full(test.torque.size, np.nan)
    left[test.group >= 0] = test.line.residuals
    sample = np.arange(1, test.torque.size + 1)
    residuals = (
        Column("sample", "-", "number of the sample", sample),
        Column("torque", "N m", "torque", test.torque),
        Column("per_branch", TURN, "residual angle, measured minus lines of the branches", left),
        Column("whole_loop", "N m", "residual torque, measured minus line of the whole loop", test.whole_line.residuals),
    )
    return (Table("loop", f"Torsion test{at}", columns), Table("residuals", f"Residuals of the fits{at}", residuals), *_mid_line(test, at))


def _mid_line(test: TorsionTestResult, at: str) -> Iterator[Table]:
    if test.mid_line is None:
        return
    torque, angle = test.mid_line
    k1, k2, k3, t1, t2, _ = test.pieces
    first, second = (t1, t2) if np.isfinite(t1) else (0.0, 0.0)
    fitted = np.minimum(torque, first) / k1 + np.clip(torque - first, 0, second - first) / k2 + np.maximum(torque - second, 0) / k3
    yield Table(
        "mid_line",
        f"Mid-line of the loop{at}",
        (
            Column("torque", "N m", "magnitude of the torque", torque),
            Column("angle", TURN, "angle of the mid-line, both directions averaged", angle),
            Column("pieces", TURN, "angle of the three straight segments", fitted),
        ),
    )


def position_table(tests: Sequence[TorsionTestResult]) -> Table:
    """The test over the positions of the crank."""
    columns = [Column("angle", TURN, "crank angle", np.array([test.crank for test in tests]))]
    columns += [
        Column(name, STIFF, meaning, np.array([getattr(test, name).value for test in tests]), meaning)
        for name, meaning in (
            ("corrected", "stiffness, corrected"),
            ("per_branch", "stiffness, branches"),
            ("whole_loop", "stiffness, whole loop"),
        )
    ]
    columns += [
        Column(
            name,
            STIFF,
            f"{word} end of the interval of the corrected stiffness",
            np.array([getattr(test.corrected, name) for test in tests]),
            f"{word} end, corrected",
        )
        for name, word in (("low", "lower"), ("high", "upper"))
    ]
    columns += [
        Column(name, unit, meaning, np.array([getattr(test.shape, name) for test in tests]))
        for name, unit, meaning in (
            ("lost_motion", TURN, "lost motion"),
            ("backlash", TURN, "backlash"),
            ("hysteresis_energy", "J", "hysteresis loss per cycle"),
        )
    ]
    return Table("positions", "Torsional stiffness over crank angle", tuple(columns))


def comparison_answer(tests: Sequence[TorsionTestResult], angle: Floats, secant: Floats) -> Answer:
    """Measured stiffness beside the computed one: secant (n,) [N m/rad], at two finite places at least, over the crank angle (n,) [rad]."""
    known = np.isfinite(secant)
    crank = np.array([test.crank for test in tests], dtype=float)
    inside = (crank >= angle[known].min() - 1e-9) & (crank <= angle[known].max() + 1e-9)
    computed = np.where(inside, np.interp(crank, angle[known], secant[known]), np.nan)
    estimates = np.array([test.corrected for test in tests])
    names = (
        ("measured", 0, "measured stiffness"),
        ("low", 2, "lower end of the measured stiffness"),
        ("high", 3, "upper end of the measured stiffness"),
    )
    columns = (
        Column("angle", TURN, "crank angle", crank),
        *(Column(n, STIFF, m, estimates[:, c]) for n, c, m in names),
        Column("model", STIFF, "computed stiffness", computed),
    )
    values = (
        {}
        if not np.any(inside)
        else {
            "model.ratio": Value(
                float(np.mean(estimates[inside, 0] / computed[inside])), "-", "measured over computed stiffness, mean over the positions"
            )
        }
    )
    outside = () if np.all(inside) else (f"the model has no stiffness at {np.sum(~inside)} of {crank.size} measured positions",)
    return Answer(values, (Table("comparison", "Measured and computed stiffness", columns),), findings=outside)


# -- pictures ------------------------------------------------------------------------------------------------------------------


def torsion_plots(result: Result[Any]) -> tuple[Plot, ...]:
    """All plots whose table the result has."""
    return tuple(plot for plot in _all_plots() if plot.table in result.tables)


def _all_plots() -> Iterator[Plot]:
    yield Plot("loop", "Torsion test with fitted lines", "loop", "angle", ("whole_loop", "per_branch", "torque"))
    yield Plot("residuals", "Residuals of the fits", "residuals", "torque", ("per_branch", "whole_loop"), style="points")
    fitted = "Dashed: three straight segments fitted to it."
    yield Plot("mid_line", "Mid-line of the hysteresis loop", "mid_line", "torque", ("angle",), reference=("pieces",), meaning=fitted)
    yield Plot("positions", "Torsional stiffness over crank angle", "positions", "angle", ("corrected", "low", "high"))
    yield Plot("comparison", "Measured and computed stiffness", "comparison", "angle", ("measured", "low", "high", "model"))
