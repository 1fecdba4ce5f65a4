"""`drivewright fit-stiffness DATA.csv`: a torsion test of any drive, evaluated and written as a run folder."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np

from drivewright import registry, runner
from drivewright.errors import InputError, SpecError
from drivewright.indexing import torsion_test
from drivewright.indexing.torsion_test import SeriesSpring, TorsionTestResult, TorsionTestSettings
from drivewright.indexing.torsion_test.answers import comparison_answer, loop_tables, position_table, torsion_plots, torsion_values
from drivewright.registry import Analysis, Command, Mechanism
from drivewright.result import Answer, Answers
from drivewright.spec import DataFile, Integer, MechanismSpec, Number, load
from drivewright.spec.fields import Field
from drivewright.units import Length, RotationalStiffness, Torque


class TorsionTest(MechanismSpec):
    """A torsion test: the input is locked, the output is loaded and unloaded."""

    mechanism: Literal["fit-stiffness"] = Field("fit-stiffness", description="kind of evaluation")
    data: DataFile = Field(
        title="Test data file", description="CSV file: torque [N m],angle [arcmin] and optionally cycle, branch, crank [deg]"
    )
    rated_torque: Torque | None = Field(None, gt=0, description="rated torque of the drive", examples=["1000 N m"])
    loading_bar_stiffness: RotationalStiffness | None = Field(
        None, gt=0, description="stiffness of the loading bar, in series with the drive", examples=["2e7 N m/rad"]
    )
    loading_bar_uncertainty: RotationalStiffness | None = Field(
        None, ge=0, description="standard uncertainty of the stiffness of the loading bar"
    )
    support_stiffness: RotationalStiffness | None = Field(
        None, gt=0, description="stiffness of the support, in series with the drive", examples=["5000 N m/arcmin"]
    )
    support_uncertainty: RotationalStiffness | None = Field(None, ge=0, description="standard uncertainty of the stiffness of the support")
    arm: Length | None = Field(
        None,
        gt=0,
        title="Lever arm",
        description="lever arm of the force, for a column force [N] in place of the torque",
        examples=["500 mm"],
    )
    confidence: Number = Field(0.95, ge=0.5, lt=1, title="Confidence level", description="confidence level of the intervals")
    resamples: Integer = Field(
        1000, ge=0, le=100_000, title="Bootstrap samples", description="number of resampled tests of the bootstrap by cycles"
    )
    model: DataFile | None = Field(
        None, title="Spec of the drive", description="spec of the drive whose computed stiffness is compared with the measured one"
    )


@dataclass(frozen=True)
class TorsionTestModel:
    """The spec, and the evaluations of all positions of the crank in rising order."""

    spec: TorsionTest
    tests: tuple[TorsionTestResult, ...]


def build(spec: TorsionTest) -> TorsionTestModel:
    """The `TorsionTestModel` of a spec."""
    setup = TorsionTestSettings(spec.rated_torque, tuple(_series_springs(spec)), spec.confidence, spec.resamples)
    return TorsionTestModel(spec, torsion_test.evaluate_positions(torsion_test.read_test(spec.data, spec.arm), setup))


def _series_springs(spec: TorsionTest) -> Iterator[SeriesSpring]:
    for key, name in (("loading_bar", "loading bar's"), ("support", "support's")):
        stiffness, uncertainty = getattr(spec, f"{key}_stiffness"), getattr(spec, f"{key}_uncertainty")
        if stiffness is None and uncertainty is not None:
            raise SpecError(f"needs {key}_stiffness, whose uncertainty it is; give both", key=f"{key}_uncertainty")
        if stiffness is not None:
            yield SeriesSpring(name, stiffness, uncertainty or 0.0)


def stiffness(model: TorsionTestModel, done: Answers) -> Answer:
    """Every number of the test; over several positions of the crank their mean."""
    return torsion_values(model.tests, model.spec.confidence)


def loop(model: TorsionTestModel, done: Answers) -> Answer:
    """The loop with its fits and residuals, and its mid-line; of several positions the least stiff one."""
    return Answer(tables=loop_tables(model.tests))


def positions(model: TorsionTestModel, done: Answers) -> Answer:
    """The test over the positions of the crank."""
    return Answer() if model.tests[0].crank is None else Answer(tables=(position_table(model.tests),))


def comparison(model: TorsionTestModel, done: Answers) -> Answer:
    """The stiffness that the spec's own mechanism computes, at the measured positions."""
    spec, tests = model.spec, model.tests
    if spec.model is None or tests[0].crank is None:
        return Answer(findings=("the model is not compared: the data have no column 'crank [deg]' with the crank angle of each loop",))
    design = load(spec.model)
    able = [analysis.name for analysis in registry.mechanism(design.mechanism).analyses if analysis.name == "stiffness"]
    tables = runner.run(design, able).tables
    if "stiffness" not in tables or not {"angle", "secant"} <= {column.name for column in tables["stiffness"].columns}:
        raise InputError(f"--model {spec.model}: kind {design.mechanism} has no table 'stiffness' with columns angle and secant")
    angle, secant = tables["stiffness"]["angle"].data, tables["stiffness"]["secant"].data
    known = np.isfinite(secant)
    if np.sum(known) < 2:
        raise InputError(f"--model {spec.model}: its stiffness exists at {np.sum(known)} positions; at least 2 are needed")
    return comparison_answer(tests, angle, secant)


def _no_model(spec: TorsionTest) -> str | None:
    return "no spec of the drive was given (--model)" if spec.model is None else None


command = Command(
    Mechanism(
        kind="fit-stiffness",
        summary="torsion test: stiffness, lost motion, backlash and hysteresis, with uncertainties",
        spec=TorsionTest,
        build=build,
        folder=Path(__file__).with_suffix(""),
        plots=torsion_plots,
        analyses=(
            Analysis("stiffness", stiffness, "stiffness, lost motion and hysteresis with uncertainties"),
            Analysis("loop", loop, "hysteresis loop with fitted lines"),
            Analysis("positions", positions, "stiffness over the crank angle"),
            Analysis("comparison", comparison, "measured and computed stiffness", missing=_no_model),
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
