"""Corners of studies: points of a file, keys of every kind, stores that are damaged."""

from dataclasses import replace

import numpy as np
import pyarrow as pa
import pytest
from pyarrow import parquet
from study_toy import TOY, Body, Part, Toy, exact, install, rough

import drivewright as dw
from drivewright.errors import InputError, SpecError, UnknownName
from drivewright.studies.plan import make_plan
from drivewright.studies.variation import geomspace, linspace, normal, with_variation

pytestmark = pytest.mark.error

SPEC = Toy(parts=(Part(name="left"), Part(name="right")), bodies={"arm": Body()})


@pytest.fixture(autouse=True)
def _toy(monkeypatch):
    install(monkeypatch.setattr)


def columns(vary, spec=SPEC, **settings):
    plan = make_plan(with_variation(spec, vary, **settings))
    return {key: column.tolist() for key, column in plan.cases(0, len(plan)).items()}


def points(tmp_path, text):
    (tmp_path / "p.csv").write_text(text)
    return columns({}, points=str(tmp_path / "p.csv"))


@pytest.mark.parametrize("unit", ["mm", "in", "um"])
def test_points_are_the_same_floats_as_levels(tmp_path, unit):
    numbers = [str(n / 8) for n in range(60)] + ["9", "0.3", "1.1"]
    assert points(tmp_path, "\n".join([f"size [{unit}]", *numbers])) == columns({"size": [f"{n} {unit}" for n in numbers]})


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("size [mm],size [mm]\n1,2\n", "column 'size' occurs twice; give it once"),
        ("size [mm],ratio,size [m]\n1,2,3\n", "column 'size' occurs twice"),
        ("count\n100000000000000000000\n", "wants a whole number"),
        ('"si\nze [mm]"\n1\n', "has a line break in the heading"),
        ('"si\nze [mm]"\n1\n', "has a line break in the heading"),
        ("form\nround\nrond\n", "wants round or square, got 'rond'"),
        ("teeth\n17\n", "teeth holds several values, not one; name an element, e.g. teeth.0"),
    ],
)
def test_points_that_are_none(tmp_path, text, words):
    with pytest.raises(SpecError) as found:
        points(tmp_path, text)
    assert words in str(found.value)


def test_a_null_is_no_text(tmp_path):
    parquet.write_table(pa.table({"colour": ["red", None]}), tmp_path / "p.pq")
    with pytest.raises(SpecError, match="case 1, column 'colour': wants a text, got None"):
        columns({}, points=str(tmp_path / "p.pq"))


@pytest.mark.parametrize(
    ("key", "words"),
    [
        ("teeth", "teeth holds several values"),
        ("bodies.arm.at", "bodies.arm.at holds several values"),
        ("size", None),
        ("teeth.0", None),
        ("bodies.arm.at.1", None),
    ],
)
def test_a_list_is_not_one_value(key, words):
    values = [1] if key.startswith("teeth") else ["1 mm"]
    if words is None:
        assert columns({key: values})
    else:
        with pytest.raises(SpecError, match=words):
            columns({key: values})


def test_whole_numbers_with_equal_ratios():
    assert columns({"count": geomspace(2, 8, 3)})["count"] == [2, 4, 8] and columns({"count": geomspace(3, 48, 5)})["count"] == [
        3,
        6,
        12,
        24,
        48,
    ]


def test_a_whole_number_beyond_all_bounds():
    with pytest.raises(SpecError, match="too large a whole number"):
        columns({"count": [10**20, 1]})
    with pytest.raises(SpecError, match="too large a whole number"):
        columns({"count": linspace(1, 10**23, 2)})


def test_designs_of_which_the_compiled_route_is_silent_do_not_count_against_it(monkeypatch):
    install(monkeypatch.setattr, replace(TOY, batch=exact))
    study = dw.sweep(SPEC, {"ratio": [-1, 1, 4, 9, 16]}, on="serial")
    assert study.remarks == () and np.isnan(study["root"][0]) and study["area"][0] == pytest.approx(1e-4)
    install(monkeypatch.setattr, replace(TOY, batch=rough))
    named = dw.sweep(with_variation(SPEC, {"ratio": [-1, 1, 4, 9, 16]}, values=["area"]), on="serial")
    assert named.remarks[0].endswith("differs from a run by 0.001 of a value at most")


def test_a_part_that_cannot_be_read(tmp_path):
    dw.sweep(SPEC, {"count": [1, 2, 3]}, out=tmp_path / "S", on="serial")
    sorted((tmp_path / "S" / "parts").iterdir())[0].write_bytes(b"no table")
    with pytest.raises(InputError, match=r"S: a part cannot be read .*; the sweep.s command computes its cases again"):
        dw.open_study(tmp_path / "S")
    assert dw.sweep(SPEC, {"count": [1, 2, 3]}, out=tmp_path / "S", on="serial").complete


def test_other_content_of_a_data_file_is_said(tmp_path):
    (tmp_path / "t.csv").write_text("1\n")
    dw.sweep(SPEC.replace(table=str(tmp_path / "t.csv")), {"count": [1]}, out=tmp_path / "S", on="serial")
    (tmp_path / "t.csv").write_text("2\n")
    words = "holds another study; table: the content of the file is not that of the study's copy; a study keeps one content, also where a"
    with pytest.raises(InputError, match=f"{words} file was repaired. Give"):
        dw.sweep(SPEC.replace(table=str(tmp_path / "t.csv")), {"count": [1]}, out=tmp_path / "S", on="serial")


def test_ctrl_c_before_the_first_case(tmp_path):
    def stop(done, total, what):
        raise KeyboardInterrupt

    study = dw.sweep(SPEC, {"count": [1, 2]}, out=tmp_path / "S", on="serial", progress=stop)
    assert study.interrupted and len(study) == 0 and not study.answered and study.counts == {}
    assert repr(dw.open_study(tmp_path / "S")) == "<Study of 'toy': 0 of 2 cases, {}>"


def test_the_unit_of_a_column_that_is_none():
    with pytest.raises(UnknownName, match="no column of the study is called 'aria'"):
        dw.sweep(SPEC, {"count": [1]}, on="serial").unit("aria")


def test_a_word_of_a_key_that_takes_a_number_or_a_word():
    """Levels "cowper" of the shaft's shear_coefficient, "no-dwell" of the indexer's motion_to_dwell."""
    from drivewright.execution.keys import KeyKind

    assert KeyKind("number").given("cowper") == "cowper" and KeyKind("number").given(np.float64(0.9)) == 0.9


def test_corners_keep_the_bounds_to_the_last_bit():
    """A clearance that ends at 0 must not be asked for at -3e-21 m, which the spec refuses."""
    for percent in range(1, 80):
        vary = {
            "size": normal(f"{percent / 100} mm", "0.01 mm", "0 mm", "1 mm"),
            "offset": {"lower": "0.3 mm", "upper": f"{0.3 + percent / 7} mm"},
        }
        least, greatest = (make_plan(with_variation(SPEC, vary, method="corners")).points[n] for n in (0, -1))
        assert least[0] >= 0 and greatest[0] <= 1e-3 and least[1] >= 3e-4
