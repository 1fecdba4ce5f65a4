"""Studies and searches of values with intervals: columns, routes, answers, requirements."""

import csv
import os
from dataclasses import replace
from pathlib import Path

import chaos_toy
import numpy as np
import pytest
from older_study import make_older
from pyarrow import parquet

from drivewright import registry
from drivewright.cli import show
from drivewright.errors import SpecError
from drivewright.execution import batches
from drivewright.execution.outputs import case_outputs
from drivewright.report.content import Views, pictures
from drivewright.report.tabular import write_study_table
from drivewright.result import Answer, Value
from drivewright.spec import Optimise
from drivewright.studies.answers import analyse_study
from drivewright.studies.optimisation import optimise
from drivewright.studies.search.problem import prepare
from drivewright.studies.sweeps import open_study, sweep
from drivewright.studies.variation import linspace, normal, uniform

pytestmark = pytest.mark.interface

LEVELS = {"size": linspace("10 mm", "13 mm", 7)}
SAMPLE = {"size": normal("11 mm", "0.5 mm"), "load": normal(1.0, 0.05)}


@pytest.fixture(autouse=True)
def _toy(monkeypatch):
    chaos_toy.install(monkeypatch.setattr)
    monkeypatch.setattr(registry, "is_known", lambda kind: True)


def spec(**keys):
    return chaos_toy.Chaotic(**keys)


def sampled(count=200, method="random", **keys):
    return sweep(
        spec(study={"samples": count, "method": method, "seed": 3, "vary": [_entry(key, what) for key, what in SAMPLE.items()]}, **keys),
        on="serial",
    )


def _entry(key, what):
    return {"key": key, **what}


# -- rows ----------------------------------------------------------------------------------------------------------------------


def test_a_value_with_an_interval_has_three_columns():
    study = sweep(spec(), LEVELS, on="serial")
    assert study.value_names == ("level", "area") and study.check_names == ("low_enough", "settled")
    low, high = study.bounds("level")
    assert np.all(low < study["level"]) and np.all(study["level"] < high)
    assert study.bounds("area") is None and study.bounds("check.settled") is None
    assert study.table.schema.field("level.low").metadata[b"bounds"] == b"level"
    assert (study.unit("level.high"), study.meaning("level.high")) == ("m", "level of the drive, at most")
    margins = study.bounds("check.low_enough")
    assert margins[0] == pytest.approx(chaos_toy.LIMIT - high) and margins[1] == pytest.approx(chaos_toy.LIMIT - low)
    assert study.at_worst("level", 1) == pytest.approx(high) and study.at_worst("area", -1) == pytest.approx(study["area"])


def test_values_that_are_named_keep_their_ends():
    study = sweep(spec(study={"values": ["level"]}), LEVELS, on="serial")
    assert study.table.column_names[4:] == ["level", "level.low", "level.high", "level.error"]


def test_a_value_with_the_name_of_a_key_keeps_its_ends(monkeypatch):
    def answer(model, done):
        return Answer({"size": Value(model.size, "m", "size again", 0.9 * model.size, 1.1 * model.size, "fit")})

    main = replace(chaos_toy.CHAOTIC.analyses[0], answer=answer)
    chaos_toy.install(monkeypatch.setattr, replace(chaos_toy.CHAOTIC, analyses=(main,)))
    study = sweep(spec(noise=0.2), LEVELS, on="serial")
    assert study.table.column_names[3:] == ["size", "value.size", "value.size.low", "value.size.high"]
    assert study.bounds("value.size")[1] == pytest.approx(1.1 * study["size"]) and study.bounds("size") is None


def test_a_value_that_is_called_low_is_a_value():
    values = {"play": Value(2.0, "m", "play", 1.0, 3.0, "fit"), "play.low": Value(0.5, "m", "play at the lower stop")}
    found = case_outputs(values, ())
    assert found["play.low"].value == 0.5 and found["play.low"].bounds == "" and found["play.high"].bounds == "play"


@pytest.mark.parametrize("target", [1e-9, 100.0])
def test_the_size_of_a_batch_changes_nothing(monkeypatch, target):
    whole = sweep(spec(), LEVELS, on="serial")
    monkeypatch.setattr(batches, "TARGET", target)
    assert sweep(spec(), LEVELS, on="serial").table.equals(whole.table, check_metadata=True)


@pytest.fixture
def elsewhere(tmp_path, monkeypatch):
    """The kind as an installed package, for the processes that are started from here."""
    package = tmp_path / "chaos_toy-1.0.dist-info"
    package.mkdir()
    (package / "METADATA").write_text("Metadata-Version: 2.1\nName: chaos-toy\nVersion: 1.0\n")
    (package / "entry_points.txt").write_text("[drivewright.mechanisms]\nchaotic-toy = chaos_toy:CHAOTIC\n")
    monkeypatch.syspath_prepend(tmp_path)  # a process that is started here takes over the path
    paths = [str(tmp_path), str(Path(chaos_toy.__file__).parent), os.environ.get("PYTHONPATH", "")]
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join(filter(None, paths)))


def test_processes_give_the_same_bytes(elsewhere):
    serial = sweep(spec(), LEVELS, on="serial")
    assert sweep(spec(), LEVELS, workers=2).table.equals(serial.table, check_metadata=True)


@pytest.mark.needs_cluster
@pytest.mark.slow
def test_dask_gives_the_same_bytes(elsewhere):
    import distributed

    serial = sweep(spec(), LEVELS, on="serial")
    with distributed.LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=":0") as cluster:
        assert sweep(spec(), LEVELS, on=cluster.scheduler_address).table.equals(serial.table, check_metadata=True)


def test_a_study_goes_on_with_the_same_bytes(tmp_path):
    whole = sweep(spec(), LEVELS, on="serial")

    def stop(done, total, what):
        if done >= 3:
            raise KeyboardInterrupt

    assert sweep(spec(), LEVELS, out=tmp_path / "S", on="serial", progress=stop).interrupted
    again = sweep(spec(), LEVELS, out=tmp_path / "S", on="serial")
    assert again.complete and again.table.equals(whole.table, check_metadata=True)
    assert open_study(tmp_path / "S").table.equals(whole.table, check_metadata=True)


def test_a_study_of_an_earlier_version_opens(tmp_path):
    """Its parts have no ends of intervals."""
    sweep(spec(study={"samples": 30, "vary": [_entry("size", SAMPLE["size"])]}), out=tmp_path / "S", on="serial")

    def without_ends(table):
        ends = [field.name for field in table.schema if b"bounds" in field.metadata]
        assert ends
        return table.drop_columns(ends)

    make_older(tmp_path / "S", without_ends)
    study = open_study(tmp_path / "S")
    assert study.value_names == ("level", "area") and study.bounds("level") is None
    assert "within_cases" not in analyse_study(study).result.tables


# -- the compiled route --------------------------------------------------------------------------------------------------------


def offering(known):
    """A `batch` that knows some outputs, by running the closed form of the toy."""

    def batch(given, keys, names):
        if not set(names) <= known or keys != ("size",):
            return None

        def evaluate(designs):
            rows = [
                case_outputs(found.values, found.checks)
                for (size,) in designs
                for found in [chaos_toy.answer(given.model_copy(update={"size": size}), {})]
            ]
            return {name: np.array([row[name].value for row in rows]) for name in names}

        return evaluate

    return batch


PLAIN = {"level", "area", "check.low_enough", "check.settled"}
ALL = PLAIN | {"level.low", "level.high", "level.error", "check.low_enough.low", "check.low_enough.high"}


@pytest.mark.parametrize(("known", "taken"), [(ALL, True), (PLAIN, False), (ALL - {"level.high"}, False)])
def test_a_compiled_route_has_to_give_the_ends_too(monkeypatch, known, taken):
    serial, called = sweep(spec(), LEVELS, on="serial"), []

    def batch(given, keys, names):
        found = offering(known)(given, keys, names)
        return found and (lambda designs: called.append(len(designs)) or found(designs))

    chaos_toy.install(monkeypatch.setattr, replace(chaos_toy.CHAOTIC, batch=batch))
    assert sweep(spec(), LEVELS, on="serial").table.equals(serial.table, check_metadata=True)
    assert bool(called) is taken


# -- files and screens ---------------------------------------------------------------------------------------------------------


def test_written_tables_have_the_ends(tmp_path):
    study = sweep(spec(), LEVELS, on="serial")
    with write_study_table(study, tmp_path / "S.csv").open(newline="") as file:
        head, first, *_ = csv.reader(file)
    assert head[4:7] == ["level [mm]", "level.low [mm]", "level.high [mm]"]
    assert float(first[5]) == pytest.approx(1e3 * study.bounds("level")[0][0])
    back = parquet.read_table(write_study_table(study, tmp_path / "S.parquet"))
    assert back.schema.field("level.high").metadata[b"bounds"] == b"level"
    assert write_study_table(study, tmp_path / "S.xlsx").stat().st_size > 5000


def test_command_line_tells_ends_with_their_intervals(capsys):
    study = sweep(spec(), LEVELS, on="serial")
    show.study(study, analyse_study(study))
    row = study["level"].argmin()
    low, high = study.bounds("level")
    assert f"({1e3 * low[row]:.2f} to {1e3 * high[row]:.2f}) mm" in capsys.readouterr().out


def test_response_curves_have_bands():
    study = sweep(spec(), LEVELS, on="serial")
    found = analyse_study(study)
    low, high = study.bounds("level")
    table = found.result.tables["response"]
    assert np.array_equal(table["level.low"].data, low) and np.array_equal(table["level.high"].data, high)
    from drivewright.view.panels import panels

    plot = next(plot for plot in found.plots if plot.name == "curve.level")
    (panel,) = panels(found.result, plot)
    assert panel.series[0].ends[0] == pytest.approx(1e3 * low) and len(panel.series) == 1
    assert any(picture.name == "plot-curve.level" for picture in pictures(found.result, Views(plots=found.plots)))
    least = found.result.values["least.level"]
    row = study["level"].argmin()
    assert (least.low, least.high) == (low[row], high[row])


def test_the_margin_of_the_worst_check_and_the_front_have_their_intervals():
    study = sweep(spec(), LEVELS, on="serial")
    found = analyse_study(study, ("level", "area")).result
    table, margin = found.tables["response"], study["check.low_enough"]
    low, high = (end / np.abs(margin).max() for end in study.bounds("check.low_enough"))
    settled = study["check.settled"]
    assert table["checks.margin.low"].data == pytest.approx(np.minimum(low, settled))
    assert table["checks.margin.high"].data == pytest.approx(np.minimum(high, settled))
    pareto = found.tables["pareto"]
    rows = pareto["case"].data.astype(int)
    assert pareto["level.high"].data == pytest.approx(study.bounds("level")[1][rows])


def test_a_grid_without_intervals_has_no_columns_for_them():
    study = sweep(spec(study={"values": ["area"]}), LEVELS, on="serial")
    found = analyse_study(study).result
    assert [c.name for c in found.tables["range"].columns][-1] == "greatest.case"
    assert found.values["least.area"].low is None


# -- answers -------------------------------------------------------------------------------------------------------------------


def test_spread_within_a_case_is_told_apart():
    """By the keys the squares of 0.5/11 and 5 % of the level add up; a case by itself has 40 % / sqrt(32)."""
    study = sampled(1500, noise=0.4)
    found = analyse_study(study).result
    keys, within = found.values["sigma_keys.level"], found.values["sigma_within.level"].value
    assert found.values["sigma_within.level"].interval == "sample"
    true_keys = 0.011 * np.hypot(0.5 / 11, 0.05)
    assert within == pytest.approx(0.4 * 0.011 / np.sqrt(32), rel=0.05)
    assert keys.low <= true_keys <= keys.high and keys.interval == "sample"
    assert found.values["sigma.level"].value == pytest.approx(np.hypot(true_keys, within), rel=0.1)
    assert any("of the variance over the cases is spread within a case" in text for text in found.findings)
    table = found.tables["contributions"]
    shares = {(v, k): s for v, k, m, s in zip(*(c.data for c in table.columns[:4]), strict=True) if m == "regression"}
    assert shares["level", "size"] + shares["level", "load"] == pytest.approx(1, abs=0.15)


def test_without_noise_nothing_is_told_apart():
    found = analyse_study(sampled(100, noise=0.0)).result
    assert found.values["sigma_keys.level"].value == pytest.approx(found.values["sigma.level"].value)
    assert not any("within a case" in text for text in found.findings)


def test_sobol_indices_take_the_noise_off():
    """Both keys cause half, though most of the variance is noise."""
    found = analyse_study(sampled(400, "sobol-indices", noise=0.5)).result
    table = found.tables["indices"]
    columns = [table[name].data for name in ("value", "key", "total", "total.low", "total.high")]
    row = {key: ends for value, key, *ends in zip(*columns, strict=True) if value == "level"}
    true = (0.5 / 11) ** 2 / ((0.5 / 11) ** 2 + 0.05**2)
    assert row["size"][1] <= true <= row["size"][2] and row["load"][1] <= 1 - true <= row["load"][2]


def test_yield_is_bounded_by_the_intervals():
    study = sampled(100, noise=0.3)
    found = analyse_study(study).result
    margin, (low, high) = study["check.low_enough"], study.bounds("check.low_enough")
    settled = study["check.settled"] >= 0
    table = found.tables["yield"]
    undecided = dict(zip(table["check"].data, table["undecided"].data, strict=True))
    assert undecided["low_enough"] == np.sum((low < 0) & (high >= 0)) > 10
    share = found.values["yield"]
    assert share.value == np.mean((margin >= 0) & settled)
    assert share.low < np.mean((low >= 0) & settled) <= share.value <= np.mean((high >= 0) & settled) < share.high
    assert (found.values["yield.low"].value, found.values["yield.high"].value) == (share.low, share.high)


# -- searches ------------------------------------------------------------------------------------------------------------------


def search(limit, **keys):
    table = {
        "unknowns": [{"key": "size", "lower": "9 mm", "upper": "13 mm"}],
        "objectives": [{"value": "area", "goal": "maximise"}],
        "requirements": [{"value": "level", "at_most": limit}],
        "generations": 12,
        "population": 12,
    }
    return spec(optimise=Optimise(**table), **keys)


def test_a_requirement_is_met_by_the_whole_interval():
    found = optimise(search("12 mm"), on="serial")
    level = found.best.values["level"]
    assert found.feasible and level.high <= 0.012 and not found.requirements[0].undecided
    assert found.requirements[0].high == level.high
    values = {name: found.history[name] for name in ("level", "level.high")}
    chosen = found.history["violation"] <= 0
    assert np.all(values["level.high"][chosen] <= 0.012)
    assert np.any(values["level"][~chosen] <= 0.012), "or the interval would decide nothing"
    assert "(" in found.objective_rows()[0][1] or found.objective_rows()[0][0] == "area"


@pytest.mark.parametrize(("side", "end", "limit"), [("at_most", 1, 0.0117), ("at_least", 0, 0.0111)])
def test_the_front_takes_what_meets_the_requirements_by_its_whole_interval(side, end, limit):
    goals = [{"value": "area", "goal": "minimise"}, {"value": "level", "goal": "maximise"}]
    table = {
        "unknowns": [{"key": "size", "lower": "9 mm", "upper": "13 mm"}],
        "objectives": goals,
        "requirements": [{"value": "level", side: f"{limit} m"}],
    }
    study = sweep(spec(optimise=Optimise(**table)), LEVELS, on="serial")
    pareto = analyse_study(study).result.tables["pareto"]
    sign, rows = (1 if side == "at_most" else -1), pareto["case"].data.astype(int)
    surely = (sign * (study.bounds("level")[end] - limit) <= 0) & (study["check.low_enough"] >= 0)
    by_value = (sign * (study["level"] - limit) <= 0) & (study["check.low_enough"] >= 0)
    assert ((pareto["set"].data != "fails") == surely[rows]).all() and by_value.sum() > surely.sum() > 0


def test_half_the_width_stands_for_a_standard_error_that_is_not_there(monkeypatch):
    def answer(model, done):
        return Answer({"level": Value(model.size, "m", "level", model.size - 1.96e-3, model.size + 1.96e-3, "fit")})

    main = replace(chaos_toy.CHAOTIC.analyses[0], answer=answer)
    chaos_toy.install(monkeypatch.setattr, replace(chaos_toy.CHAOTIC, analyses=(main,)))
    study = sweep(spec(noise=0.03), LEVELS, on="serial")
    assert study.errors("level") == pytest.approx(np.full(7, 1e-3), rel=1e-4) and study.errors("size") is None


def test_the_requirement_to_blame_tells_the_end_of_the_interval():
    found = optimise(search("8.2 mm", noise=0.6), on="serial")
    assert not found.feasible
    assert "with an interval to" in found.findings[0] and "all of which has to meet it" in found.findings[0]


def test_the_worse_end_is_the_upper_one_of_at_most_and_the_lower_one_of_at_least():
    problem = prepare(search("12 mm"))
    values = {"area": np.ones(3), "level": np.array([0.0115, 0.0115, 0.0125]), "level.high": np.array([0.0119, 0.0121, np.nan])}
    assert (problem.violations(values)[0] <= 0).tolist() == [True, False, False]
    other = replace(problem, limits=(("level", ">=", 0.011),))
    values |= {"level.low": np.array([0.0111, 0.0109, np.nan])}
    assert (other.violations(values)[0] <= 0).tolist() == [True, False, True]


def test_a_value_without_interval_is_its_own_end():
    with pytest.raises(SpecError, match="does not exist|unknown|nearest|value of the result"):
        prepare(
            spec(
                optimise=Optimise(
                    unknowns=[{"key": "size", "lower": "9 mm", "upper": "13 mm"}],
                    objectives=[{"value": "area", "goal": "minimise"}],
                    requirements=[{"value": "none", "at_most": 1}],
                )
            )
        )
    assert "area.low" not in prepare(search("12 mm")).names
    assert uniform("1 mm", "2 mm")["distribution"] == "uniform"
