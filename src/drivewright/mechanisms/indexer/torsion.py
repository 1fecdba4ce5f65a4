"""`drivewright fit-stiffness DATA.csv`: a torsion test of any drive, evaluated and written as a run folder."""

from pathlib import Path
from typing import Literal

import numpy as np

from drivewright import registry, runner
from drivewright.errors import InputError, SpecError
from drivewright.indexing import torsion_test
from drivewright.indexing.torsion_test import Part, Setup
from drivewright.numerics.ensemble import LEVEL
from drivewright.registry import Analysis, Command, Mechanism
from drivewright.result import Answer, Column, Plot, Table, Value
from drivewright.spec import DataFile, Integer, MechanismSpec, Number, load
from drivewright.spec.fields import Field
from drivewright.units import Length, RotationalStiffness, Torque

ESTIMATES = {
    "whole_loop": "slope of the whole loop, least squares of torque on angle (biased low by hysteresis)",
    "per_branch": "slope of the branches, each pass with an intercept of its own (angle on torque)",
    "corrected": "slope of the branches without the series stiffness of the rig",
    "inverse": "slope of the whole loop, least squares of angle on torque",
    "loading": "slope of the branches with rising torque",
    "unloading": "slope of the branches with falling torque",
}
STIFF, TURN = "N m/rad", "rad"


class TorsionTest(MechanismSpec):
    """A torsion test: the input locked, the output loaded and unloaded."""

    mechanism: Literal["fit-stiffness"] = Field("fit-stiffness", description="kind of evaluation")
    data: DataFile = Field(description="CSV file: torque [N m],angle [arcmin] and, where there are, cycle, branch, crank [deg]")
    rated_torque: Torque | None = Field(None, gt=0, description="rated torque of the drive", examples=["1000 N m"])
    loading_bar_stiffness: RotationalStiffness | None = Field(
        None, gt=0, description="stiffness of the loading bar, in series with the drive", examples=["2e7 N m/rad"]
    )
    loading_bar_uncertainty: RotationalStiffness | None = Field(None, ge=0, description="its standard uncertainty")
    support_stiffness: RotationalStiffness | None = Field(
        None, gt=0, description="stiffness of the support, in series with the drive", examples=["5000 N m/arcmin"]
    )
    support_uncertainty: RotationalStiffness | None = Field(None, ge=0, description="its standard uncertainty")
    arm: Length | None = Field(
        None, gt=0, description="arm of the force, for a column force [N] in place of the torque", examples=["500 mm"]
    )
    confidence: Number = Field(0.95, ge=0.5, lt=1, description="confidence of the intervals")
    resamples: Integer = Field(1000, ge=0, le=100_000, description="resampled tests of the bootstrap by cycles")
    model: DataFile | None = Field(None, description="spec of the drive, whose computed stiffness is laid over the measured one")


def build(spec):
    """The evaluations of all positions of the crank."""
    setup = Setup(spec.rated_torque, tuple(_parts(spec)), spec.confidence, spec.resamples)
    return spec, torsion_test.evaluate_positions(torsion_test.read(spec.data, spec.arm), setup)


def _parts(spec):
    for key, name in (("loading_bar", "loading bar's"), ("support", "support's")):
        stiffness, uncertainty = getattr(spec, f"{key}_stiffness"), getattr(spec, f"{key}_uncertainty")
        if stiffness is None and uncertainty is not None:
            raise SpecError(f"is the uncertainty of a stiffness that is not given; give {key}_stiffness as well", key=f"{key}_uncertainty")
        if stiffness is not None:
            yield Part(name, stiffness, uncertainty or 0.0)


# -- numbers -------------------------------------------------------------------------------------------------------------------


def stiffness(model, done):
    """Every number of the test; over several positions of the crank their mean."""
    spec, tests = model
    values = {}
    for name, meaning in ESTIMATES.items():
        values |= _estimate(f"stiffness.{name}", meaning, [getattr(test, name) for test in tests], spec.confidence)
    values |= _mean(tests) | (_over_crank(tests) if len(tests) > 1 else _resampled(tests[0], spec.confidence))
    return Answer(values, findings=tuple(_told(tests)))


def _estimate(name, meaning, found, confidence):
    """Value, standard uncertainty and interval of a stiffness; of several positions the mean, their errors independent.

    The value carries its interval where that is one of 95 %, as those of all results are.
    """
    if None in found:
        return {}
    columns = np.array(found)
    value, count, share = columns[:, 0].mean(), len(found), f"{100 * confidence:g} %"
    below, above = (np.sqrt(np.sum((columns[:, 0] - columns[:, n]) ** 2)) / count for n in (2, 3))
    of = f", mean of {count} positions of the crank" if count > 1 else ""
    told = {
        "": (value, f"{meaning}{of}"),
        ".uncertainty": (np.sqrt(np.sum(columns[:, 1] ** 2)) / count, "standard uncertainty of it"),
        ".low": (value - below, f"lower end of the {share} interval"),
        ".high": (value + above, f"upper end of the {share} interval"),
    }
    values = {f"{name}{key}": Value(float(number), STIFF, text) for key, (number, text) in told.items() if np.isfinite(number)}
    if name in values and confidence == LEVEL:
        values[name] = values[name]._replace(low=value - below, high=value + above, interval="fit").plain()
    return values


def _mean(tests):
    """Shape of the loop, means over the positions; what no loop shows is absent."""
    shapes, pieces = np.array([t.shape for t in tests]), np.array([t.pieces for t in tests])
    drifts = np.array([np.nan if t.drift is None else t.drift for t in tests])
    rows = (
        ("lost_motion", shapes[:, 0], TURN, "turn of the mid-line from -3 % to +3 % of the rated torque"),
        ("backlash", shapes[:, 1], TURN, "width of the loop at zero torque"),
        ("hysteresis_energy", shapes[:, 2], "J", "energy lost in a cycle, the area of the loop"),
        ("hysteresis_loss", shapes[:, 3], "-", "energy lost in a cycle over the work put in"),
        ("stiffness.secant", shapes[:, 4], STIFF, "mid-line from 50 to 100 % of the rated torque"),
        ("stiffness.k1", pieces[:, 0], STIFF, "first piece of the mid-line, from zero torque on"),
        ("stiffness.k2", pieces[:, 1], STIFF, "second piece of the mid-line"),
        ("stiffness.k3", pieces[:, 2], STIFF, "third piece of the mid-line, up to the largest torque"),
        ("stiffness.t1", pieces[:, 3], "N m", "torque between the first and the second piece"),
        ("stiffness.t2", pieces[:, 4], "N m", "torque between the second and the third piece"),
        ("drift", drifts, TURN, "drift of the angle over the test that was removed"),
        ("rated_torque", np.array([t.rated_torque for t in tests]), "N m", "torque that percentages refer to"),
    )
    return {name: Value(float(data.mean()), unit, meaning) for name, data, unit, meaning in rows if np.all(np.isfinite(data))}


def _over_crank(tests):
    """How the corrected stiffness changes with the position of the crank."""
    curve = np.array([test.corrected.value for test in tests])
    low, high = int(np.argmin(curve)), int(np.argmax(curve))
    return {
        "stiffness.minimum": Value(float(curve[low]), STIFF, "least corrected stiffness over the crank"),
        "stiffness.minimum.at": Value(float(tests[low].crank), TURN, "angle of the crank where it is"),
        "stiffness.maximum": Value(float(curve[high]), STIFF, "largest corrected stiffness over the crank"),
        "stiffness.maximum.at": Value(float(tests[high].crank), TURN, "angle of the crank where it is"),
        "stiffness.range": Value(float(np.ptp(curve)), STIFF, "largest minus least corrected stiffness"),
    }


def _resampled(test, confidence):
    told = f"end of the {100 * confidence:g} % interval by resampled cycles"
    return {
        f"stiffness.{name}.bootstrap.{end}": Value(ends[n], STIFF, f"{word} {told}")
        for name, ends in test.bootstrap.items()
        for n, (end, word) in enumerate((("low", "lower"), ("high", "upper")))
    }


def _told(tests):
    """Each finding once, with the number of positions that it is about."""
    places = {}
    for test in tests:
        for finding in test.findings:
            places.setdefault(finding, []).append(test.crank)
    for finding, at in places.items():
        yield finding if len(at) == len(tests) else f"at {len(at)} of {len(tests)} positions ({np.degrees(at[0]):g} deg ...): {finding}"


# -- tables --------------------------------------------------------------------------------------------------------------------


def loop(model, done):
    """The loop with its fits, what these leave, and its mid-line; of several positions the least stiff one."""
    _, tests = model
    test = min(tests, key=lambda each: each.corrected.value)
    at = "" if test.crank is None else f" at {np.degrees(test.crank):g} deg of the crank"
    branch = (test.angle - test.line.intercepts[test.group]) / test.line.slope
    columns = (
        Column("angle", TURN, "angle of the output, zero at the mid-line", test.angle),
        Column("torque", "N m", "measured", test.torque),
        Column("whole_loop", "N m", "whole loop", test.whole_line.intercepts[0] + test.whole_line.slope * test.angle),
        Column("per_branch", "N m", "branches", np.where(test.group < 0, np.nan, branch)),
    )
    left = np.full(test.torque.size, np.nan)
    left[test.group >= 0] = test.line.residuals
    sample = np.arange(1, test.torque.size + 1)
    residuals = (
        Column("sample", "-", "number of the sample", sample),
        Column("torque", "N m", "torque", test.torque),
        Column("per_branch", TURN, "measured angle minus that of the branches' lines", left),
        Column("whole_loop", "N m", "measured torque minus that of the whole loop's line", test.whole_line.residuals),
    )
    return Answer(
        tables=(
            Table("loop", f"Torsion test{at}", columns),
            Table("residuals", f"What the fits leave{at}", residuals),
            *_mid_line(test, at),
        )
    )


def _mid_line(test, at):
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
            Column("torque", "N m", "size of the torque", torque),
            Column("angle", TURN, "mid-line, both senses folded", angle),
            Column("pieces", TURN, "three straight pieces", fitted),
        ),
    )


def positions(model, done):
    """The test over the positions of the crank."""
    _, tests = model
    if tests[0].crank is None:
        return Answer()
    columns = [Column("angle", TURN, "angle of the crank", np.array([test.crank for test in tests]))]
    columns += [
        Column(name, STIFF, meaning, np.array([getattr(test, name).value for test in tests]))
        for name, meaning in (("corrected", "corrected stiffness"), ("per_branch", "branches"), ("whole_loop", "whole loop"))
    ]
    columns += [
        Column(name, STIFF, f"{word} end of the corrected stiffness", np.array([getattr(test.corrected, name) for test in tests]))
        for name, word in (("low", "lower"), ("high", "upper"))
    ]
    columns += [
        Column(name, unit, meaning, np.array([getattr(test.shape, name) for test in tests]))
        for name, unit, meaning in (
            ("lost_motion", TURN, "lost motion"),
            ("backlash", TURN, "backlash"),
            ("hysteresis_energy", "J", "energy lost in a cycle"),
        )
    ]
    return Answer(tables=(Table("positions", "Torsional stiffness over the crank", tuple(columns)),))


def comparison(model, done):
    """The stiffness that the spec's own mechanism computes, at the measured positions."""
    spec, tests = model
    if tests[0].crank is None:
        return Answer(findings=("the model is not compared: the data have no column 'crank [deg]' with the position of each loop",))
    design = load(spec.model)
    able = [analysis.name for analysis in registry.mechanism(design.mechanism).analyses if analysis.name == "stiffness"]
    tables = runner.run(design, able).tables
    if "stiffness" not in tables or not {"angle", "secant"} <= {column.name for column in tables["stiffness"].columns}:
        raise InputError(f"--model {spec.model}: kind {design.mechanism} has no table 'stiffness' with columns angle and secant")
    angle, secant = tables["stiffness"]["angle"].data, tables["stiffness"]["secant"].data
    known = np.isfinite(secant)
    if np.sum(known) < 2:
        raise InputError(f"--model {spec.model}: its stiffness exists at {np.sum(known)} positions; that is no curve to compare with")
    crank = np.array([test.crank for test in tests])
    inside = (crank >= angle[known].min() - 1e-9) & (crank <= angle[known].max() + 1e-9)
    computed = np.where(inside, np.interp(crank, angle[known], secant[known]), np.nan)
    estimates = np.array([test.corrected for test in tests])
    names = (("measured", 0, "measured"), ("low", 2, "lower end"), ("high", 3, "upper end"))
    columns = (
        Column("angle", TURN, "angle of the crank", crank),
        *(Column(n, STIFF, m, estimates[:, c]) for n, c, m in names),
        Column("model", STIFF, "computed", computed),
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


def _no_model(spec):
    return "no spec of the drive was given (--model)" if spec.model is None else None


# -- pictures ------------------------------------------------------------------------------------------------------------------


def plots(result):
    """All plots whose table the result has."""
    return tuple(plot for plot in _all_plots() if plot.table in result.tables)


def _all_plots():
    yield Plot("loop", "Torsion test with fitted lines", "loop", "angle", ("whole_loop", "per_branch", "torque"))
    yield Plot("residuals", "What the fits leave", "residuals", "torque", ("per_branch", "whole_loop"), style="points")
    yield Plot("mid_line", "Mid-line, dashed: three straight pieces", "mid_line", "torque", ("angle",), reference=("pieces",))
    yield Plot("positions", "Torsional stiffness over the crank, with its interval", "positions", "angle", ("corrected", "low", "high"))
    yield Plot(
        "comparison", "Measured stiffness with its interval, and computed", "comparison", "angle", ("measured", "low", "high", "model")
    )


command = Command(
    Mechanism(
        kind="fit-stiffness",
        summary="torsion test: stiffness, lost motion, backlash and hysteresis, with uncertainties",
        spec=TorsionTest,
        build=build,
        folder=Path(__file__).with_suffix(""),
        plots=plots,
        analyses=(
            Analysis("stiffness", stiffness, "stiffness, play and hysteresis with uncertainties"),
            Analysis("loop", loop, "the loop and its fits"),
            Analysis("positions", positions, "stiffness over the crank"),
            Analysis("comparison", comparison, "measured beside computed stiffness", missing=_no_model),
        ),
        headline=(
            "stiffness.whole_loop",
            "stiffness.whole_loop.uncertainty",
            "stiffness.per_branch",
            "stiffness.per_branch.uncertainty",
            "stiffness.corrected",
            "stiffness.corrected.uncertainty",
            "stiffness.inverse",
            "stiffness.secant",
            "stiffness.k1",
            "stiffness.k2",
            "stiffness.k3",
            "lost_motion",
            "backlash",
            "hysteresis_energy",
            "hysteresis_loss",
            "stiffness.minimum",
            "stiffness.minimum.at",
            "stiffness.range",
            "model.ratio",
        ),
        sources=("Liu, Zhai, Li, Guo, DOI 10.13364/j.issn.1672-6510.20160015, equations (3) and (4)",),
    ),
    argument="data",
)
