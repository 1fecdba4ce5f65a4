"""What a study refuses, and what it says; a folder that is not ours, a disk that fills, a file that is gone."""

import errno
import os
import re
import shutil
import sqlite3
import subprocess
import sys
from pathlib import Path

import numpy as np
import pyarrow as pa
import pytest
from places import EXAMPLES
from pyarrow import parquet
from study_toy import Body, Part, Toy, install

import drivewright as dw
from drivewright import atomic
from drivewright.cli import main
from drivewright.errors import InputError, SpecError, UnknownName
from drivewright.execution import batches, evaluation
from drivewright.studies import plan, study_folder
from drivewright.studies import sweeps as sweeping
from drivewright.studies.plan import make_plan
from drivewright.studies.variation import (
    geomspace,
    linspace,
    normal,
    parse_variation,
    tolerance,
    triangular,
    uniform,
    with_options,
    with_variation,
)

pytestmark = pytest.mark.error

SPEC = Toy(parts=(Part(name="left"), Part(name="right")), bodies={"arm": Body()})
LEVELS = {"size": linspace("8 mm", "12 mm", 5), "ratio": [1, 2]}


@pytest.fixture(autouse=True)
def _toy(monkeypatch):
    install(monkeypatch.setattr)


def refused(vary, message, spec=SPEC, kind=SpecError, **settings):
    with pytest.raises(kind) as found:
        make_plan(with_variation(spec, vary, **settings))
    assert message in str(found.value)
    return found.value


# -- what varies ---------------------------------------------------------------------------------------------------------------


def test_nothing_that_varies():
    with pytest.raises(SpecError, match=r"^study.vary: choose at least one parameter to vary: --vary KEY=FROM:TO:STEPS"):
        make_plan(SPEC)
    refused({}, "at least one parameter to vary", samples=4)


@pytest.mark.parametrize(
    ("key", "words"),
    [
        ("sise", "this spec has no key 'sise' (did you mean 'size'?); known there: title, size, offset, force"),
        ("SIZE", "(did you mean 'size'?)"),
        ("parts.left.widht", "(did you mean 'parts.left.width'?); known there: parts.left.name, parts.left.width"),
        ("parts.middle.width", "no key 'parts.middle.width': parts has left, right"),
        ("parts.2.width", "parts has left, right"),
        ("parts.lefd.width", "parts has left, right (did you mean 'left'?)"),
        ("bodies.leg.mass", "no key 'bodies.leg.mass': bodies has arm"),
        ("teeth.2", "no key 'teeth.2': teeth has 0, 1"),
        ("size.x", "no key 'size.x'"),
        ("", "no key ''"),
        ("bodies.arm.at.2", "bodies.arm.at has 0, 1"),
        ("mechanism", "mechanism cannot vary: it states what the study is of"),
        ("format", "format cannot vary"),
        ("units", "units cannot vary: it states what results are shown in"),
        ("study.seed", "study.seed cannot vary"),
        ("optimise.seed", "optimise.seed cannot vary"),
        ("table", "table is a table or a file, not one value; name a key in it"),
        ("bodies.arm", "bodies.arm is a table or a file"),
    ],
)
def test_keys_that_cannot_vary(key, words):
    assert str(refused({"count": [1], key: ["1 mm"]}, words)).startswith("study.vary.1.key: ")


def test_what_an_unknown_key_offers_is_only_what_can_vary():
    assert not {"format", "mechanism", "study", "optimise", "units"} & set(
        re.findall(r"\w+", str(refused({"zzz": [1]}, "known there")).partition(";")[2])
    )


def test_an_empty_list_has_no_elements():
    refused({"parts.0.width": ["1 mm"]}, "no key 'parts.0.width': parts has no elements", Toy())


@pytest.mark.parametrize(
    ("key", "values", "words"),
    [
        ("size", ["1 mm", 2], 'values.1: unit missing: a length, e.g. "2 mm"'),
        ("size", ["1 N"], "values.0: wants a length, got '1 N' (force)"),
        ("ratio", ["x"], "values.0: wants a number, got 'x'"),
        ("ratio", [True], "wants a number, got true"),
        ("count", [1.0], "wants a whole number, got 1.0"),
        ("count", [1, True], "values.1: wants a whole number, got true"),
        ("flag", [1], "wants true or false, got 1"),
        ("colour", [5], "wants a text, got 5"),
        ("form", ["rond"], "must be one of round, square, got 'rond' (did you mean 'round'?)"),
    ],
)
def test_levels_that_are_none(key, values, words):
    assert str(refused({key: values}, words)).startswith("study.vary.0.values.")


@pytest.mark.parametrize(
    ("key", "what", "words"),
    [
        ("size", linspace(1, "2 mm", 3), "study.vary.0.lower: unit missing: a length"),
        ("size", linspace("1 mm", "2 deg", 3), "study.vary.0.upper: wants a length, got '2 deg' (angle)"),
        ("size", {"lower": "1 mm", "steps": 3}, "study.vary.0.upper: a range of steps needs lower and upper; upper is missing"),
        ("size", {"upper": "1 mm", "steps": 3}, "study.vary.0.lower: a range of steps needs lower and upper; lower is missing"),
        ("force", geomspace("-1 N", "2 N", 3), "logarithmic levels need bounds of one sign beside 0, got '-1 N' and '2 N'"),
        ("force", geomspace("0 N", "2 N", 3), "bounds of one sign beside 0"),
        ("ratio", geomspace(1, 0, 3), "bounds of one sign beside 0, got 1 and 0"),
        ("count", linspace(1, 10, 4), None),
        ("count", linspace(1, 10, 3), "count takes whole numbers, but 3 steps from 1 to 10 give 1, 5.5, 10"),
        ("count", linspace(10, 1, 3), "choose steps = 10, or give values"),
        ("count", linspace(1, 2.5, 3), "wants a whole number, got 2.5"),
        ("colour", linspace("1 mm", "2 mm", 3), "colour takes a text and has no range; give values"),
        ("flag", linspace(0, 1, 2), "wants true or false, got 0"),
    ],
)
def test_ranges_that_are_none(key, what, words):
    if words is None:
        assert make_plan(with_variation(SPEC, {key: what})).shape == (4,)
    else:
        refused({key: what}, words)


@pytest.mark.parametrize(
    ("key", "what", "words"),
    [
        ("size", normal("1 mm", "0 mm"), "study.vary.0.sigma: must be greater than 0, got '0 mm'"),
        ("size", {"sigma": "-1 mm"}, "sigma: must be greater than 0"),
        ("size", tolerance("0 mm"), "study.vary.0.tolerance: must be greater than 0, got '0 mm'"),
        ("ratio", tolerance(-1), "greater than 0, got -1"),
        ("size", uniform("2 mm", "1 mm"), "study.vary.0: lower bound 2 mm is not below upper bound 1 mm"),
        ("size", uniform("1 mm", "0.1 cm"), "is not below"),
        ("size", normal("1 mm", "1 mm", "3 mm", "2 mm"), "lower bound 3 mm is not below upper bound 2 mm"),
        ("size", {"distribution": "normal", "mean": "1 mm"}, "study.vary.0.sigma: a normal distribution needs sigma or tolerance"),
        ("size", {"distribution": "normal", "lower": "1 mm", "upper": "2 mm"}, "needs sigma or tolerance"),
        ("size", {}, "study.vary.0: needs lower and upper, or a tolerance"),
        ("size", {"lower": "1 mm"}, "needs lower and upper, or a tolerance"),
        ("size", {"distribution": "triangular", "upper": "1 mm"}, "needs lower and upper, or a tolerance"),
        (
            "size",
            triangular("1 mm", "3 mm", "2 mm"),
            "study.vary.0.mode: the peak of the triangle is not between its ends; give a mode there",
        ),
        ("size", {"distribution": "triangular", "lower": "11 mm", "upper": "12 mm"}, "give a mode there"),
        ("offset", tolerance("1 mm"), "study.vary.0: offset has no value in this spec to vary about; give mean, or lower and upper"),
        ("offset", {"sigma": "1 mm"}, "offset has no value in this spec to vary about"),
        ("size", normal(1, "1 mm"), "study.vary.0.mean: unit missing"),
        ("size", normal("1 mm", "1 deg"), "study.vary.0.sigma: wants a length"),
        ("size", triangular("1 mm", "2 kg", "3 mm"), "study.vary.0.mode: wants a length"),
        ("size", tolerance(1), "study.vary.0.tolerance: unit missing"),
        (
            "count",
            uniform(1, 9),
            "study.vary.0: count takes a whole number, so it varies over values only; give values, or lower, upper and steps",
        ),
        ("flag", {}, "flag takes true or false, so it varies over values only"),
        ("form", tolerance(1), "form takes a text, so it varies over values only"),
    ],
)
def test_distributions_that_are_none(key, what, words):
    refused({key: what}, words)


def test_bounds_that_are_no_numbers_or_settings_that_are_none():
    refused({"size": {"lower": "wide", "upper": "2 mm"}}, "lower")
    refused({"size": {"lower": True, "upper": "2 mm"}}, 'wants a finite number, or a quantity such as "9.5 mm", got true')
    refused({"size": linspace("1 mm", "2 mm", 0)}, "steps")
    refused({"size": {"step": 1}}, "step")
    refused(LEVELS, "samples", samples=0)
    refused(LEVELS, "seed", seed=-1)
    refused(LEVELS, "latin-hypercube", method="latin")


def test_the_same_key_twice():
    found = SPEC.model_copy(update={"study": with_variation(SPEC, {"size": ["1 mm"], "ratio": [1]}).study})
    twice = found.study.model_copy(update={"vary": (*found.study.vary, found.study.vary[0])})
    with pytest.raises(SpecError, match=r"^study.vary.*: size varies twice; give it once$"):
        make_plan(found.model_copy(update={"study": twice}))
    with pytest.raises(SpecError, match="--vary size is given twice; give its levels in one list"):
        with_options(SPEC, ["size=1 mm", "size=2 mm"])


def test_too_many_corners(monkeypatch):
    wide = Toy(parts=tuple(Part() for _ in range(17)))
    vary = {f"parts.{n}.width": tolerance("1 um") for n in range(17)}
    refused(vary, "study.method: 17 keys have 1.3e+05 corners; 16 keys at most, or take one-at-a-time", wide, method="corners")
    three = {"size": tolerance("1 mm"), "force": tolerance("1 N"), "ratio": tolerance(0.1)}
    monkeypatch.setattr(plan, "MOST_CORNERS", 3)
    assert make_plan(with_variation(SPEC, three, method="corners")).inner == 8
    monkeypatch.setattr(plan, "MOST_CORNERS", 2)
    refused(three, "3 keys have 8 corners; 2 keys", method="corners")


def test_too_many_dimensions_for_sobol(monkeypatch):
    from scipy.stats import qmc

    monkeypatch.setattr(qmc.Sobol, "MAXDIM", 3)
    vary = {"size": tolerance("1 mm"), "force": tolerance("1 N")}
    refused(vary, "4 dimensions are beyond a Sobol sequence; take latin-hypercube", method="sobol-indices", samples=4)
    assert make_plan(with_variation(SPEC, vary | {"ratio": tolerance(0.1)}, method="sobol", samples=4)).inner == 4


def test_too_many_cases(monkeypatch):
    monkeypatch.setattr(plan, "LARGEST", 20)
    refused({"count": linspace(1, 7, 7), "ratio": [1, 2, 3]}, "study.vary: 21 cases are more than 2e+01; take fewer levels or samples")
    refused({"count": [1, 2, 3], "size": tolerance("1 mm")}, "study.vary: 21 cases are more", samples=7)
    assert len(make_plan(with_variation(SPEC, {"count": linspace(1, 5, 5), "size": tolerance("1 mm")}, samples=4))) == 20


def test_very_many_cases_want_a_yes(monkeypatch):
    monkeypatch.setattr(sweeping, "MANY", 9)
    with pytest.raises(InputError, match=r"^10 cases are more than 9; give --yes to confirm, or take fewer levels or samples$"):
        dw.sweep(SPEC, LEVELS, on="serial", confirmed=False)
    assert len(dw.sweep(SPEC, LEVELS, on="serial")) == len(dw.sweep(SPEC, {"size": LEVELS["size"]}, on="serial", confirmed=False)) + 5 == 10


# -- --vary --------------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("size", "--vary takes KEY=FROM:TO:STEPS"),
        ("=1 mm", "got '=1 mm'"),
        ("size=", "got 'size='"),
        ("", "KEY=+-TOLERANCE; got ''"),
        ("size=1 mm:2 mm:3:log:5", "--vary takes KEY="),
        ("size=1 mm:2 mm:0", "the number of steps must be a whole number from 1 up, got '0'"),
        ("size=1 mm:2 mm:x", "whole number from 1 up, got 'x'"),
        ("size=1 mm:2 mm:-3", "got '-3'"),
        ("size=1 mm:2 mm:2.5", "got '2.5'"),
        ("size=1 mm:2 mm:", "got ''"),
        ("size=1 mm:2 mm:3:lin", "--vary size=1 mm:2 mm:3:lin: behind the steps only :log can stand, got 'lin'"),
        ("size=gauss(1 mm, 2 mm)", "no distribution is called 'gauss'; known: normal, uniform, triangular"),
        ("size=normal(1 mm)", "normal takes (mean, sigma), got 1 numbers"),
        ("size=uniform(1 mm, 2 mm, 3 mm)", "uniform takes (lower, upper), got 3 numbers"),
        ("size=triangular(1 mm, 2 mm)", "triangular takes (lower, mode, upper), got 2 numbers"),
        ("size=normal(1 m,1 m,1 m,1 m,1 m)", "got 5 numbers"),
    ],
)
def test_texts_of_the_wrong_form(text, words):
    with pytest.raises(SpecError) as found:
        parse_variation(text)
    assert words in str(found.value)


@pytest.mark.parametrize("levels", ["1 mm", 5, None, b"1"])
def test_levels_that_are_no_list(levels):
    with pytest.raises(SpecError, match="study.vary: wants a list of levels, or linspace, normal ..., got"):
        with_variation(SPEC, {"size": levels})


@pytest.mark.parametrize(("texts", "points"), [(["size=1 mm:2 mm:3"], None), ([], None), (["count=1,2"], "p.csv")])
def test_a_sample_of_nothing(texts, points, tmp_path):
    (tmp_path / "p.csv").write_text("ratio\n1\n")
    with pytest.raises(SpecError, match=r"^--sample 5: nothing has a distribution to sample from; give --vary KEY=FROM:TO or"):
        with_options(SPEC, texts, points and tmp_path / points, samples=5)
    assert with_options(SPEC, [*texts, "force=1 N:2 N"], samples=5).study.samples == 5


# -- a file of points ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "has no cases; give a line of keys and a line for each case"),
        ("\n\n", "has no cases"),
        ("size [mm],ratio\n", "has no cases"),
        ("size\n8\n", "column 'size': wants its unit in brackets: 'size [mm]'"),
        ("size []\n8\n", "wants its unit in brackets"),
        ("size [N]\n8\n", "column 'size': wants a length, got 'N' (force)"),
        ("size [mmm]\n8\n", "'mmm' is no unit known here"),
        ("ratio [mm]\n8\n", "column 'ratio': takes a number, so it has no unit; got [mm]"),
        ("colour [m]\nred\n", "takes a text, so it has no unit"),
        ("size [mm],ratio\n8,1\n9\n", "case 1 has 1 entries, the first line has 2"),
        ("size [mm]\n8\n9,1\n", "case 1 has 2 entries, the first line has 1"),
        ("size [mm],ratio\n8,1\n9,x\n", "case 1, column 'ratio': wants a number, got 'x'"),
        ("size [mm]\n8 mm\n", "case 0, column 'size': wants a number, got '8 mm'"),
        ("size [mm]\n8\n\n \n", "case 1, column 'size': wants a number, got ' '"),
        ("size [mm]\nnan\n", "wants a number, got 'nan'"),
        ("ratio\ninf\n", "wants a number, got 'inf'"),
        ("count\n2.5\n", "case 0, column 'count': wants a whole number, got '2.5'"),
        ("count\ninf\n", "whole number, got 'inf'"),
        ("flag\nyes\n", "wants true or false, got 'yes'"),
        ("sise [mm]\n8\n", "column 'sise': this spec has no key 'sise' (did you mean 'size'?)"),
        ("study.seed\n8\n", "study.seed cannot vary"),
        ("size [mm],case\n8,0\n", "column 'case': this spec has no key 'case'"),
    ],
)
def test_csv_files_of_points_that_are_none(text, words, tmp_path):
    file = tmp_path / "p.csv"
    file.write_text(text)
    assert str(refused({}, words, points=str(file))).startswith(f"{file}: ")


def test_csv_files_of_points_that_are_some(tmp_path):
    (tmp_path / "p.csv").write_bytes(
        "\ufeffsize [mm] , ratio,colour,count, flag,angle [deg]\n8,1e-1,a b,3.0,TRUE,180\n\n10,-2,,4,false,90\n".encode()
    )
    columns = make_plan(with_variation(SPEC, {}, points=str(tmp_path / "p.csv"))).cases(0, 2)
    expected = {
        "size": [8e-3, 10e-3],
        "ratio": [0.1, -2.0],
        "colour": ["a b", ""],
        "count": [3, 4],
        "flag": [True, False],
        "angle": [np.pi, np.pi / 2],
    }
    assert {key: column.tolist() for key, column in columns.items()} == expected


def test_a_file_of_points_that_cannot_be_read(tmp_path):
    (tmp_path / "latin.csv").write_bytes(b"colour\nr\xf6t\n")
    refused({}, "latin.csv: cannot be read: line 2 has the byte 0xf6, which is no UTF-8", points=str(tmp_path / "latin.csv"))
    (tmp_path / "p.parquet").write_text("size [mm]\n8\n")
    refused({}, "p.parquet: is no Parquet file that can be read", points=str(tmp_path / "p.parquet"))
    refused({}, "there is no file", points=str(tmp_path / "none.csv"))


def parquet_of(file, **columns):
    """A Parquet file; a column is (values, unit or None)."""
    fields, arrays = [], []
    for name, (values, unit) in columns.items():
        arrays.append(pa.array(values))
        fields.append(pa.field(name, arrays[-1].type, metadata=None if unit is None else {"unit": unit}))
    parquet.write_table(pa.Table.from_arrays(arrays, schema=pa.schema(fields)), file)
    return str(file)


def test_parquet_files_of_points_with_and_without_units(tmp_path):
    for unit, factor in ((None, 1.0), ("", 1.0), ("m", 1.0), ("mm", 1e-3), ("in", 0.0254)):
        file = parquet_of(
            tmp_path / "p.pq", size=([8.0, 10.0], unit), count=([1, 2], None), colour=(["red", "blue"], ""), flag=([True, False], None)
        )
        columns = make_plan(with_variation(SPEC, {}, points=file)).cases(0, 2)
        assert columns["size"] == pytest.approx([8 * factor, 10 * factor], rel=1e-14)
        assert [columns[key].tolist() for key in ("count", "colour", "flag")] == [[1, 2], ["red", "blue"], [True, False]]


@pytest.mark.parametrize(
    ("columns", "words"),
    [
        ({"size": ([1.0], "N")}, "column 'size': wants a length, got 'N'"),
        ({"ratio": ([1.0], "m")}, "so it has no unit; got [m]"),
        ({"size": ([1.0, None], "mm")}, "case 1, column 'size': wants a number, got None"),
        ({"count": ([1.5], None)}, "wants a whole number, got 1.5"),
        ({"size": (["wide"], "mm")}, "wants a number, got 'wide'"),
        ({"size": (np.array([]), "mm")}, "has no cases"),
        ({"gauge": ([1.0], "")}, "has no key 'gauge'"),
    ],
)
def test_parquet_files_of_points_that_are_none(columns, words, tmp_path):
    refused({}, words, points=parquet_of(tmp_path / "p.parquet", **columns))


def test_points_and_random_keys_are_not_crossed(tmp_path):
    (tmp_path / "p.csv").write_text("ratio\n1\n")
    refused(
        {"size": tolerance("1 mm")},
        "study.points: a file of points is not crossed with random keys; put their values into the file",
        points=str(tmp_path / "p.csv"),
    )
    refused({"ratio": [1]}, "ratio varies twice; give it once", points=str(tmp_path / "p.csv"))


# -- a folder ------------------------------------------------------------------------------------------------------------------


def run(folder, spec=SPEC, vary=LEVELS, **more):
    return dw.sweep(spec, vary, out=folder, on="serial", **more)


@pytest.fixture
def study(tmp_path):
    """A folder with a complete study."""
    run(tmp_path / "S")
    return tmp_path / "S"


def test_a_file_in_the_place_of_the_folder(tmp_path):
    (tmp_path / "S").write_text("mine")
    with pytest.raises(InputError, match=r"S: is a file, a study cannot take its place; choose another --out"):
        run(tmp_path / "S")
    assert (tmp_path / "S").read_text() == "mine"


def test_somebody_elses_folder_is_left_alone(tmp_path):
    for name in ("thesis.tex", "zebra"):
        (tmp_path / name).write_text("mine")
    with pytest.raises(
        InputError, match=r"is not empty and holds no study \(thesis.tex, zebra ...\); nothing was written. Choose another --out"
    ):
        run(tmp_path)
    assert sorted(os.listdir(tmp_path)) == ["thesis.tex", "zebra"]


def test_a_folder_that_is_no_study_is_not_opened(tmp_path):
    for folder in (tmp_path, tmp_path / "none"):
        with pytest.raises(InputError, match=r"is no study \(it has no study.toml with a ledger.sqlite\); `drivewright sweep SPEC"):
            dw.open_study(folder)


def test_what_a_killed_start_leaves_is_no_foreign_folder(tmp_path):
    """Killed after the ledger was made and before the spec was written."""
    (tmp_path / "S" / "parts").mkdir(parents=True)
    for name in ("ledger.sqlite", "study.toml.tmp", ".lock"):
        (tmp_path / "S" / name).touch()
    assert run(tmp_path / "S").complete


HOLDER = "import sys, fcntl, time; f = open(sys.argv[1], 'a'); fcntl.flock(f, fcntl.LOCK_EX); print('held', flush=True); time.sleep(60)"


def test_a_folder_at_which_another_process_works(study):
    before = dw.open_study(study).table
    other = subprocess.Popen([sys.executable, "-c", HOLDER, str(study / ".lock")], stdout=subprocess.PIPE)
    try:
        assert other.stdout.readline() == b"held\n"
        with pytest.raises(InputError, match="another process works on this study; wait for it, or give another --out"):
            run(study)
        assert dw.open_study(study).table.equals(before)
    finally:
        other.kill()
        other.wait()
        other.stdout.close()
    assert run(study).table.equals(before)


def test_a_folder_is_locked_against_others_while_it_is_worked_at(tmp_path):
    seen = []

    def look(done, total, what):
        seen.append(pytest.raises(InputError, run, tmp_path / "S").value)

    assert run(tmp_path / "S", progress=look).complete
    assert seen and all("another process works on this study" in str(error) for error in seen)


@pytest.mark.parametrize(
    ("spec", "vary", "words"),
    [
        (SPEC.replace(force="3 N"), LEVELS, "force: 2 N there, 3 N here"),
        (SPEC.replace(offset="1 mm"), LEVELS, "offset: not given there, 1 mm here"),
        (SPEC.replace(bodies={"arm": {"mass": "2 kg"}}), LEVELS, "bodies.arm.mass: 1 kg there, 2 kg here"),
        (SPEC, LEVELS | {"ratio": [1, 3]}, "study.vary.1.values.1: 2 there, 3 here"),
        (SPEC, LEVELS | {"size": linspace("8 mm", "12 mm", 6)}, "study.vary.0.steps: 5 there, 6 here"),
        (SPEC, LEVELS | {"flag": [True]}, "study.vary.2.key: not given there, flag here"),
        (SPEC, {"size": LEVELS["size"]}, "study.vary.1.key: ratio there, not given here"),
    ],
)
def test_another_study_in_the_folder_is_named_by_its_difference(study, spec, vary, words):
    before = dw.open_study(study).table
    with pytest.raises(InputError, match="holds another study; ") as found:
        run(study, spec, vary)
    assert words in str(found.value) and str(found.value).endswith(". Give another --out, or remove the folder")
    assert not re.search(r"\b(spec|plan|study): ", str(found.value))  # a digest tells nobody anything
    assert dw.open_study(study).table.equals(before)


def test_of_many_differences_eight_are_named(study):
    with pytest.raises(InputError, match=r"size: 10 mm there, 11 mm here; .* and \d+ more\. Give") as found:
        run(
            study,
            SPEC.replace(
                size="11 mm", force="3 N", angle="1 deg", ratio=0.5, count=3, flag=True, colour="blue", form="square", teeth=(1, 2)
            ),
        )
    assert str(found.value).count(" there, ") == 8


def test_the_same_study_said_otherwise_goes_on(study):
    same = run(study, SPEC.replace(title="T", size="1 cm"), LEVELS | {"size": linspace("0.8 cm", "12000 um", 5)})
    assert same.complete and same.table.equals(dw.open_study(study).table)


def test_what_is_kept_is_part_of_the_study(study):
    spec = with_variation(SPEC, LEVELS, values=["area"])
    with pytest.raises(InputError, match=r"study.values.0: not given there, area here"):
        run(study, spec, None)


def test_another_version_of_the_program_does_not_go_on(study, monkeypatch):
    known = sweeping.versions()
    monkeypatch.setattr(sweeping, "versions", lambda: known | {"drivewright": "99.1"})
    with pytest.raises(InputError, match=rf"holds another study; drivewright: {known['drivewright']} there, 99.1 here\. Give"):
        run(study)


def test_a_worker_of_another_version_is_refused():
    task = evaluation.case_task(with_variation(SPEC, LEVELS), ("size",))._replace(version="99.1")
    with pytest.raises(InputError, match="drivewright 99.1, and this worker has .*; install the same version on all workers"):
        evaluation.evaluate(task, 0, {"size": np.array([1e-3])})


def test_the_content_of_a_data_file_is_part_of_the_study(tmp_path):
    data, spec = tmp_path / "table.csv", SPEC.replace
    data.write_text("1,2\n")
    before = run(tmp_path / "S", spec(table=str(data)))
    shutil.copy(data, tmp_path / "copy.csv")
    assert run(tmp_path / "S", spec(table=str(tmp_path / "copy.csv"))).table.equals(before.table)
    with pytest.raises(InputError) as found:
        run(tmp_path / "S", spec(table=str(tmp_path / "copy.csv"), force="3 N"))
    assert "another study; force: 2 N there, 3 N here. Give" in str(found.value)
    data.write_text("1,3\n")
    with pytest.raises(
        InputError, match="holds another study; table: .*keeps one content, also where a file was repaired. Give another --out"
    ):
        run(tmp_path / "S", spec(table=str(data)))
    assert (tmp_path / "S" / "data" / "table.csv").read_text() == "1,2\n"


def test_the_content_of_a_file_of_points_is_part_of_the_study(tmp_path):
    (tmp_path / "p.csv").write_text("ratio\n1\n2\n")
    spec = with_options(SPEC, (), tmp_path / "p.csv")
    run(tmp_path / "S", spec, None)
    assert dw.open_study(tmp_path / "S")["ratio"].tolist() == [1, 2]
    assert run(tmp_path / "S", dw.load(tmp_path / "S" / "study.toml"), None).complete
    (tmp_path / "p.csv").write_text("ratio\n1\n3\n")
    with pytest.raises(InputError, match="holds another study; .*points"):
        run(tmp_path / "S", spec, None)
    assert dw.open_study(tmp_path / "S")["ratio"].tolist() == [1, 2]


# -- what is lost --------------------------------------------------------------------------------------------------------------


def names(folder):
    with sqlite3.connect(folder / "ledger.sqlite") as ledger:
        return [name for (name,) in ledger.execute("select name from parts order by first")]


def test_a_part_that_vanished_is_computed_again(study):
    before, parts = dw.open_study(study).table, names(study)
    kept = {name: (study / "parts" / name).stat().st_mtime_ns for name in parts}
    (study / "parts" / parts[1]).unlink()
    with pytest.raises(InputError, match="S: a part cannot be read "):
        dw.open_study(study)
    assert run(study).table.equals(before) and dw.open_study(study).table.equals(before)
    del kept[parts[1]]
    assert kept and {name: (study / "parts" / name).stat().st_mtime_ns for name in kept} == kept


def test_what_the_ledger_does_not_name_is_removed(study):
    before = dw.open_study(study).table
    (study / "parts" / "000000000001-000000000009.parquet").write_bytes(b"half")
    run(study)
    assert sorted(os.listdir(study / "parts")) == names(study) and dw.open_study(study).table.equals(before)


def test_a_ledger_that_cannot_be_read(study):
    (study / "ledger.sqlite").write_bytes(b"no data base at all " * 100)
    with pytest.raises(InputError, match=r"its ledger.sqlite is damaged \(file is not a database\); the parts are there: `driv"):
        dw.open_study(study)
    with pytest.raises(InputError, match="holds another study"):
        run(study, SPEC.replace(force="3 N"))
    assert len(list((study / "parts").iterdir())) > 1


def full(after, monkeypatch, what):
    """From the part number `after` on the disk is full: at `what`."""
    calls, here = [], {"part": Path.write_bytes, "force": atomic.force}

    def failing(path, *content):
        if what == "part" and path.parent.name != "parts":
            return here[what](path, *content)
        calls.append(path)
        if len(calls) > after:
            if what == "part":
                here[what](path, b"half")
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        return here[what](path, *content)

    monkeypatch.setattr(*{"part": (Path, "write_bytes"), "force": (atomic, "force")}[what], failing)


SAFE = r"finished before is safe\. Free space on the disk, or repair it, and give the same"
FULL = rf"S: cannot be written: .*(No space left|disk is full).*{SAFE}"


@pytest.mark.parametrize(("what", "after"), [("part", 0), ("part", 2), ("force", 0), ("force", 5), ("force", 6)])
def test_a_disk_that_fills(tmp_path, monkeypatch, what, after):
    whole = run(tmp_path / "whole").table
    with monkeypatch.context() as patch:
        full(after, patch, what)
        with pytest.raises(InputError, match=FULL):
            run(tmp_path / "S")
    acknowledged = names(tmp_path / "S") if after else []
    assert len(acknowledged) == (after if what == "part" else max(0, (after - 2) // 2))
    assert [name for name in os.listdir(tmp_path / "S" / "parts") if ".tmp" in name] == []
    stamps = {name: (tmp_path / "S" / "parts" / name).stat().st_mtime_ns for name in acknowledged}
    assert run(tmp_path / "S").table.equals(whole)
    assert {name: (tmp_path / "S" / "parts" / name).stat().st_mtime_ns for name in acknowledged} == stamps


def test_a_ledger_that_finds_the_disk_full(tmp_path, monkeypatch):
    make, whole = study_folder.open_ledger, run(tmp_path / "whole").table

    def narrow(folder):
        ledger = make(folder)
        ledger.execute(f"pragma max_page_count = {ledger.execute('pragma page_count').fetchone()[0]}")
        return ledger

    monkeypatch.setattr(study_folder, "open_ledger", narrow)
    with monkeypatch.context() as patch:
        patch.setattr(sweeping, "study_identity", lambda spec, plan: {"spec": "x" * 5000})  # more than the page that is free
        with pytest.raises(InputError, match=FULL):
            run(tmp_path / "S")
    monkeypatch.setattr(study_folder, "open_ledger", make)
    assert run(tmp_path / "S").table.equals(whole)


def test_a_ledger_that_finds_the_disk_full_on_the_way(tmp_path, monkeypatch):
    """The part is on the disk already, but the ledger cannot name it any more: it never happened."""
    monkeypatch.setattr(batches, "TARGET", 1e-9)  # one case in a part
    make, vary = study_folder.open_ledger, {"size": linspace("8 mm", "12 mm", 120)}

    def narrow(folder):
        ledger = make(folder)
        ledger.execute(f"pragma max_page_count = {ledger.execute('pragma page_count').fetchone()[0]}")
        return ledger

    monkeypatch.setattr(study_folder, "open_ledger", narrow)
    with pytest.raises(InputError, match=FULL):
        run(tmp_path / "S", SPEC, vary)
    acknowledged, there = names(tmp_path / "S"), os.listdir(tmp_path / "S" / "parts")
    assert 5 < len(acknowledged) == len(there) - 1
    monkeypatch.setattr(study_folder, "open_ledger", make)
    assert run(tmp_path / "S", SPEC, vary).complete and names(tmp_path / "S")[: len(acknowledged)] == acknowledged


@pytest.fixture
def tiny(tmp_path):
    """A file system of 160 kB, where this may be made."""
    place = tmp_path / "tiny"
    place.mkdir()
    if os.geteuid() or subprocess.run(["mount", "-t", "tmpfs", "-o", "size=160k", "none", place], capture_output=True).returncode:
        pytest.skip("no right to mount")
    yield place
    subprocess.run(["umount", "-l", place], check=True)


def test_a_disk_that_is_really_full(tiny, monkeypatch):
    monkeypatch.setattr(batches, "TARGET", 1e-9)  # one case in a part
    vary = {"size": linspace("8 mm", "12 mm", 40)}
    with pytest.raises(InputError, match=FULL):
        run(tiny / "S", SPEC, vary)
    safe = names(tiny / "S")
    stamps = {name: (tiny / "S" / "parts" / name).stat().st_mtime_ns for name in safe}
    assert safe and sum(len(parquet.read_table(tiny / "S" / "parts" / name)) for name in safe) < 40
    subprocess.run(["mount", "-o", "remount,size=10m", tiny], check=True)
    assert run(tiny / "S", SPEC, vary).table.equals(dw.sweep(SPEC, vary, on="serial").table)
    assert {name: (tiny / "S" / "parts" / name).stat().st_mtime_ns for name in safe} == stamps


def test_a_folder_that_cannot_be_made(tmp_path):
    (tmp_path / "file").touch()
    with pytest.raises(InputError, match="cannot be written: Not a directory"):
        run(tmp_path / "file" / "S")


# -- rows and names ------------------------------------------------------------------------------------------------------------


def test_an_analysis_that_is_none():
    with pytest.raises(UnknownName, match="no analysis is called 'mein' .did you mean 'main'.."):
        dw.sweep(with_variation(SPEC, LEVELS, analyses=["mein"]), on="serial")


def test_a_column_that_is_none(study):
    with pytest.raises(UnknownName, match="no column of the study is called 'aria' .did you mean 'area'..; known: area, case"):
        dw.open_study(study)["aria"]


def test_a_very_long_reason_is_cut(monkeypatch):
    monkeypatch.setattr(evaluation, "LONGEST", 40)
    (row,) = dw.sweep(SPEC, {"colour": ["black"]}, on="serial")["message"]
    assert len(row) == 40 and row == "analysis 'main' (what it is) has no  ..."


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (
            ["--vary", "joint.rolling_radus=1 mm:2 mm:3"],
            "study.vary.0.key: this spec has no key 'joint.rolling_radus' (did you mean 'joint.rolling_radius'?)",
        ),
        (["--vary", "joint.rolling_radius=1:2:3"], 'study.vary.0.lower: unit missing: a length, e.g. "1 mm"'),
        ([], "study.vary: choose at least one parameter to vary"),
        (["--vary", "joint.rolling_radius"], "--vary takes KEY=FROM:TO:STEPS"),
        (["--vary", "links=80,82", "--sample", "5"], "--sample 5: nothing has a distribution"),
        (["--vary", "links=80,82", "--only", "mesh"], "no analysis is called 'mesh' (did you mean 'meshing'?)"),
        (["--points", "none.csv"], "there is no file"),
        (["--vary", "links=80,82", "--workers", "2", "--on", "serial"], "give one of them"),
        (["--vary", "links=80,82", "--seed", "-1"], "seed"),
        (["--vary", "links=80,82", "--set", "pitch=1 kg"], "pitch: wants a length, got '1 kg' (mass)"),
        (["--vary", "links=80,82", "--method", "grid"], "method"),
    ],
)
def test_the_command_line_says_it_in_one_line_with_the_file(arguments, words, tmp_path, capsys):
    with pytest.raises(SystemExit) as end:
        main(["sweep", str(EXAMPLES / "hyvo_chain.toml"), "--out", str(tmp_path / "S"), *arguments])
    complaint = capsys.readouterr().err
    assert end.value.code == 2 and words in complaint and "hyvo_chain.toml" in complaint and complaint.startswith("drivewright: ")
    assert "Traceback" not in complaint
