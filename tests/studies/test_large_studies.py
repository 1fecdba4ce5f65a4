"""Studies that are too large to be held: read piece by piece they say what they say at once, of all cases."""

import os
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pyarrow as pa
import pytest
from places import SUPPORT
from pyarrow import csv, parquet
from study_toy import TOY, Toy, exact, install

import drivewright as dw
from drivewright.errors import InputError
from drivewright.report.study import write_answers
from drivewright.report.tabular import write_study_table
from drivewright.studies import random_points, stored_rows
from drivewright.studies.answers import all_cases, analyse_study, thinned
from drivewright.studies.statistics import summary
from drivewright.studies.stored_rows import StoredRows
from drivewright.studies.streaming import Moments, floats_of, numbers_of_ranks, ordered_bits, summaries
from drivewright.studies.variation import linspace, normal, uniform, with_variation

pytestmark = pytest.mark.property

RANDOM = {"size": uniform("8 mm", "13 mm"), "ratio": normal(0.25, 0.1)}
COLUMNS = {
    "normal": lambda rng, n: rng.normal(size=n),
    "few numbers": lambda rng, n: rng.integers(-3, 4, n).astype(float),
    "one number": lambda rng, n: np.full(n, 2.5),
    "narrow": lambda rng, n: 1e-3 + 1e-9 * rng.normal(size=n),
    "wide, of both signs": lambda rng, n: np.exp(20 * rng.normal(size=n)) * rng.choice([-1, 1], n),
    "huge and tiny": lambda rng, n: rng.choice([-1e308, -1e-308, 0.0, 5e-324, 1e308], n),
}


# -- statistics ------------------------------------------------------------------------------------------------------------------


def close(one, two, tolerance):
    np.testing.assert_allclose(one, two, rtol=tolerance, atol=0, equal_nan=True)


@pytest.mark.parametrize("name", [name for name in COLUMNS if "huge" not in name])
@pytest.mark.parametrize("n", [1, 2, 7, 1000, 150_000])
def test_a_summary_of_pieces_is_that_of_the_whole(name, n):
    rng = np.random.default_rng(n)
    column = COLUMNS[name](rng, n)
    column[rng.random(n) < 0.05] = np.nan
    pieces, moments = np.array_split(column, 6), Moments()
    for first, piece in zip(np.cumsum([0, *map(len, pieces)]), pieces, strict=False):
        moments.add(piece, first + np.arange(len(piece)))
    found, whole = summaries(lambda: ({"y": piece} for piece in pieces), {"y": moments})["y"], summary(column)
    assert (found.cases, found.absent) == (whole.cases, whole.absent)
    np.testing.assert_equal([found.least, found.greatest, *found.percentiles], [whole.least, whole.greatest, *whole.percentiles])
    if whole.cases:
        assert column[moments.least_at] == whole.least and column[moments.greatest_at] == whole.greatest
        size = max(abs(whole.least), abs(whole.greatest))
        np.testing.assert_allclose(found.mean, whole.mean, rtol=0, atol=1e-13 * size, equal_nan=True)
        close(found.sigma, whole.sigma, 1e-9)  # rounding of the narrow numbers themselves
        np.testing.assert_allclose(found.skewness, whole.skewness, rtol=1e-6, atol=1e-6, equal_nan=True)


@pytest.mark.parametrize("name", COLUMNS)
def test_numbers_of_ranks_are_those_of_the_sorted_column(name, monkeypatch):
    monkeypatch.setattr("drivewright.studies.streaming.BINS", 16)
    monkeypatch.setattr("drivewright.studies.streaming.COLLECTED", 20)
    rng = np.random.default_rng(3)
    column = COLUMNS[name](rng, 3000)
    ordered, ranks = np.sort(column), np.array([0, 1, 2, 57, 1499, 1500, 2998, 2999])
    found = numbers_of_ranks(lambda: ({"y": piece} for piece in np.array_split(column, 5)), {"y": ranks}, {"y": (ordered[0], ordered[-1])})[
        "y"
    ]
    assert [found[rank] for rank in ranks.tolist()] == ordered[ranks].tolist()


def test_patterns_of_floats_are_in_the_order_of_the_floats():
    floats = np.array([-np.finfo(float).max, -1.0, -5e-324, 0.0, 5e-324, 1.0, np.finfo(float).max])
    bits = ordered_bits(floats)
    assert np.all(np.diff(bits) > 0) and np.array_equal(floats_of(bits), floats) and ordered_bits(np.array([-0.0])) == 0


# -- studies ---------------------------------------------------------------------------------------------------------------------


@pytest.fixture(autouse=True)
def _toy(monkeypatch):
    install(monkeypatch.setattr, replace(TOY, batch=exact))
    monkeypatch.setattr("drivewright.execution.batches.LARGEST", 700)


def spec_of(vary, **settings):
    return with_variation(Toy(), vary, **settings)


def run(folder, spec, **more):
    return dw.sweep(spec, out=folder, on="serial", **more)


@pytest.fixture
def small_memory(monkeypatch):
    """Nothing that grows with the number of cases is held."""
    monkeypatch.setattr(stored_rows, "HELD", 0)
    monkeypatch.setattr(random_points, "HELD", 100)
    monkeypatch.setattr(random_points, "BLOCK", 256)
    monkeypatch.setattr(thinned, "HELD", 500)
    monkeypatch.setattr(all_cases, "HELD", 0)


SAMPLE = spec_of(RANDOM, method="random", samples=3000)


def both(folder, spec):
    """(study as it is held, the same in small memory) of one folder."""
    held = run(folder, spec)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(stored_rows, "HELD", 0)
        return held, dw.open_study(folder)


def test_stored_rows_are_those_of_the_table(tmp_path):
    held, stored = both(tmp_path / "S", SAMPLE)
    assert isinstance(stored.rows, StoredRows) and isinstance(held.rows, pa.Table) and len(list((tmp_path / "S" / "parts").iterdir())) > 3
    assert stored.table.equals(held.table) and stored.schema.equals(held.schema, check_metadata=True)
    assert len(stored) == 3000 and stored.counts == held.counts and stored.complete and stored.answered
    for name in ("area", "status", "case"):
        assert stored[name].tolist() == held[name].tolist() or name == "area"
    np.testing.assert_array_equal(stored["area"], held["area"])
    for study in (held, stored):
        for first, stop in ((0, 3000), (5, 6), (650, 1500), (2990, None)):
            pieces = pa.concat_tables(study.batches(("area", "case"), first, stop))
            assert pieces.column_names == ["area", "case"] and pieces["case"].to_pylist() == list(range(first, stop or 3000))
    assert [group.text() for group in stored.reasons()] == [group.text() for group in held.reasons()]


def test_tables_are_written_piece_by_piece(tmp_path):
    held, stored = both(tmp_path / "S", SAMPLE)
    for form in ("csv", "parquet", "xlsx"):
        one, two = (write_study_table(study, tmp_path / f"{name}.{form}") for name, study in (("held", held), ("stored", stored)))
        if form == "csv":
            assert one.read_bytes() == two.read_bytes() and csv.read_csv(two).num_rows == 3000
        elif form == "parquet":
            tables = [parquet.read_table(path) for path in (one, two)]
            assert tables[0].equals(tables[1]) and tables[1].schema.field("size").metadata[b"unit"] == b"m"


def test_a_part_that_is_damaged_later_is_told_when_it_is_read(tmp_path):
    _, stored = both(tmp_path / "S", SAMPLE)
    file = sorted((tmp_path / "S" / "parts").glob("*.parquet"))[-1]
    file.write_bytes(file.read_bytes()[:-9])
    with pytest.raises(InputError, match="S: a part cannot be read"):
        list(stored.batches(["area"]))
    with pytest.raises(InputError, match="S: a part cannot be read"), pytest.MonkeyPatch.context() as patch:
        patch.setattr(stored_rows, "HELD", 0)
        dw.open_study(tmp_path / "S")


def test_an_interrupted_study_goes_on_and_gives_the_same_rows(tmp_path, small_memory):
    calls = []

    def stop(done, total, what):
        calls.append(done)
        if done > 1000:
            raise KeyboardInterrupt

    stopped = run(tmp_path / "S", SAMPLE, progress=stop)
    assert stopped.interrupted and 0 < len(stopped) < 3000
    result, _ = analyse_study(stopped)
    assert result["cases.missing"] == 3000 - len(stopped)
    whole = run(tmp_path / "S", SAMPLE)
    assert whole.complete and whole.table.equals(run(tmp_path / "T", SAMPLE).table)


def answers(study, monkeypatch=None):
    result, plots = analyse_study(study)
    return result, {plot.name for plot in plots}


def numbers(result, table):
    return {row["value"] if "value" in row else row["check"]: row for row in result.table(table).to_pylist()}


@pytest.mark.parametrize("method", ["random", "tolerance"])
def test_of_a_large_sample_all_cases_are_told(tmp_path, monkeypatch, method):
    spec = spec_of(RANDOM, method=method, samples=3000)
    held = run(tmp_path / "S", spec)
    expected, plots = answers(held)
    with pytest.MonkeyPatch.context() as patch:
        for module, name, number in ((stored_rows, "HELD", 0), (thinned, "HELD", 500), (all_cases, "HELD", 0)):
            patch.setattr(module, name, number)
        found, few_plots = answers(dw.open_study(tmp_path / "S"))
    assert plots == few_plots
    for table in ("tolerance", "confidence", "yield"):
        one, two = numbers(found, table), numbers(expected, table)
        assert one.keys() == two.keys()
        for name, row in one.items():
            close([x for x in row.values() if isinstance(x, float)], [x for x in two[name].values() if isinstance(x, float)], 1e-9)
    assert found["yield"] == expected["yield"] and found["cases"] == 3000 + (1 + 4 + 4) * (method == "tolerance")
    remark = next(finding for finding in found.findings if finding.startswith("the study has"))
    assert "are those of all of them" in remark and "drawn from 500 of them (the first points of each sample)" in remark
    assert len(found.table("sample")) <= 500
    if method == "tolerance":
        assert numbers(found, "worst_case")["area"] == numbers(expected, "worst_case")["area"]


@pytest.mark.parametrize("held", [0, 10**9])
def test_of_a_sample_over_levels_each_combination_is_told(tmp_path, held):
    spec = spec_of({"count": [1, 2, 3], "size": uniform("8 mm", "13 mm")}, method="random", samples=900)
    expected, _ = answers(run(tmp_path / "S", spec))
    with pytest.MonkeyPatch.context() as patch:
        for module, number in ((stored_rows, 0), (thinned, 500), (all_cases, held)):
            patch.setattr(module, "HELD", number)
        found, _ = answers(dw.open_study(tmp_path / "S"))
    one, two = (result.table("tolerance").to_pylist() for result in (found, expected))
    two = [row for row in two if row["count"] != 2]  # of three levels both ends are told
    assert len(one) == len(two) and {row["count"] for row in one} == {1, 3}
    for row, other in zip(one, two, strict=True):
        close([x for x in row.values() if isinstance(x, float)], [x for x in other.values() if isinstance(x, float)], 1e-9)


def test_a_large_grid_has_the_ends_of_all_cases_and_maps_of_fewer_levels(tmp_path, small_memory):
    spec = spec_of({"size": linspace("5 mm", "11 mm", 61), "ratio": linspace(0.1, 4.0, 50)})
    study = run(tmp_path / "S", spec)
    result, plots = analyse_study(study)
    row = numbers(result, "range")["root"]
    assert row["least"] == pytest.approx(np.sqrt(0.1)) and row["greatest"] == pytest.approx(2.0) and row["cases"] == 3050
    assert study["ratio"][row["greatest.case"]] == 4.0
    table = result.tables["response"]
    sizes = table["size"].data
    assert len(sizes) <= 500 and len(set(sizes.tolist())) > 10 and sizes.max() == pytest.approx(11e-3)
    assert any(plot.style == "map" for plot in plots)


def test_the_front_is_that_of_all_cases(tmp_path, small_memory):
    spec = spec_of(RANDOM, method="random", samples=3000, values=("area", "root"))
    study = run(tmp_path / "S", spec)
    found = analyse_study(study, ("area", "root"))[0].table("front")
    area, root = study["area"], study["root"]
    passes = (study["size"] <= 0.012) if "check.small" in study.column_names else np.isfinite(area)
    known = np.isfinite(area) & np.isfinite(root) & passes

    def is_beaten(n):
        return np.any(known & (area <= area[n]) & (root <= root[n]) & ((area < area[n]) | (root < root[n])))

    best = [n for n in np.flatnonzero(known) if not is_beaten(n)]
    assert sorted(found["case"].to_pylist()) == best


def test_the_sobol_indices_of_shorter_samples(tmp_path, small_memory):
    spec = spec_of({"size": uniform("8 mm", "13 mm"), "ratio": uniform(0.5, 1.0)}, method="sobol-indices", samples=512)
    study = run(tmp_path / "S", spec)
    rows = {(row["value"], row["key"]): row for row in analyse_study(study)[0].table("indices").to_pylist()}
    assert rows["area", "size"]["rows"] == 500 // 4 and rows["area", "size"]["total"] == pytest.approx(1, abs=0.05)
    assert rows["root", "size"]["total"] == pytest.approx(0, abs=1e-9)


def test_the_report_of_a_large_study(tmp_path, small_memory):
    study = run(tmp_path / "S", SAMPLE)
    page = write_answers(study, analyse_study(study), tmp_path / "S").read_text()
    assert "all 3000 cases complete" in page and "are those of all of them" in page and page.count("<svg") < 20


# -- memory ----------------------------------------------------------------------------------------------------------------------


def peaks(folder, cases, method):
    """{step: peak of the resident memory up to its end [MB]} of a study in a process of its own."""
    run = subprocess.run(
        [sys.executable, str(SUPPORT / "memory_of_study.py"), str(cases), str(folder), method],
        capture_output=True,
        text=True,
        check=True,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path), "MPLBACKEND": "Agg"},
    )
    return {step: int(peak) for step, peak in map(str.split, run.stdout.splitlines())}


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="counts the memory as Linux does")
@pytest.mark.parametrize("method", ["random", "latin-hypercube", "sobol", "grid"])
def test_ten_times_the_cases_take_no_more_memory(tmp_path, method):
    """3,600,000 rows of nine columns are 260 MB; no step has more than 120 MB more than with 360,000."""
    few, many = (peaks(tmp_path / str(cases), cases, method) for cases in (360_000, 3_600_000))
    assert few.keys() == many.keys() == {"start", "sweep", "again", "report", "csv", "parquet"}
    assert {step: many[step] - few[step] for step in many if many[step] - few[step] > 120} == {}
