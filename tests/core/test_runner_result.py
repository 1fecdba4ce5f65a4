"""A result: its record is strict JSON, its tables carry units, its checks know their margin."""

import json
import pickle
from types import MappingProxyType

import numpy as np
import pytest
from spec_cases import ToySpec

import drivewright as dw
from drivewright.errors import UnknownName
from drivewright.notebook import result_card
from drivewright.result import Array, Check, Column, Result, Table, Value

pytestmark = pytest.mark.interface

TABLE = Table(
    "force",
    "Force over the turn",
    (Column("angle", "rad", "cam angle", np.linspace(0, 1, 3)), Column("force", "N", "normal force", np.arange(3.0))),
)
CHECKS = (
    Check("low", np.float64(0.5), 1.0, ">=", "-", "too low", ("cam",)),
    Check("high", 3.0, np.float64(4.0), "<=", "m", "fine", label="height"),
    Check("unknown", float("nan"), 1.0, "<=", "-", "not computed"),
    Check("free", 1.0, float("inf"), "<=", "-", "no limit"),
)


def sample(**changes):
    given = {
        "spec": ToySpec(length="1 mm"),
        "mechanism": "toy",
        "title": "a toy",
        "digest": "0" * 64,
        "values": {
            "lift": Value(np.float64(0.02), "m", "stroke"),
            "peak": Value(np.float32(0.5), "-", "peak"),
            "jerk": Value(float("inf"), "m", "none"),
        },
        "tables": {"force": TABLE},
        "checks": CHECKS,
        "findings": ("one",),
        "provenance": MappingProxyType({"seed": 0}),
        "arrays": {
            "flexibility": Array("m/N", ("station", "station"), (("a", "b"), ("a", "b")), np.array([[1.0, np.nan], [np.inf, 4.0]])),
            "count": Array("-", ("n",), (("a", "b"),), np.array([1, 2])),
        },
    }
    return Result(**given | changes)


def test_the_record_is_strict_json_as_product_documents_it():
    record = json.loads(json.dumps(sample().record(), allow_nan=False))
    assert list(record) == [
        "format",
        "drivewright",
        "mechanism",
        "title",
        "digest",
        "values",
        "arrays",
        "checks",
        "advice",
        "findings",
        "warnings",
        "outcome",
        "provenance",
    ]
    assert (record["format"], record["drivewright"], record["outcome"]) == (1, dw.__version__, "complete")
    assert record["values"] == {
        "lift": {"value": 0.02, "unit": "m", "label": "Stroke", "meaning": "stroke"},
        "peak": {"value": 0.5, "unit": "-", "label": "Peak", "meaning": "peak"},
    }
    assert record["arrays"]["flexibility"] == {
        "unit": "m/N",
        "axes": ["station", "station"],
        "labels": [["a", "b"], ["a", "b"]],
        "values": [[1.0, None], [None, 4.0]],
    }
    assert record["arrays"]["count"]["values"] == [1, 2]
    unknown = {"value": None, "limit": None, "sense": "<=", "margin": None, "unit": "-", "ok": False, "parts": []}
    assert record["checks"] == [
        {
            "name": "low",
            "label": "Too low",
            "value": 0.5,
            "limit": 1.0,
            "sense": ">=",
            "margin": -0.5,
            "unit": "-",
            "ok": False,
            "message": "too low",
            "parts": ["cam"],
        },
        {
            "name": "high",
            "label": "Height",
            "value": 3.0,
            "limit": 4.0,
            "sense": "<=",
            "margin": 1.0,
            "unit": "m",
            "ok": True,
            "message": "fine",
            "parts": [],
        },
        {**unknown, "name": "unknown", "label": "Not computed", "limit": 1.0, "message": "not computed"},
        {**unknown, "name": "free", "label": "No limit", "value": 1.0, "ok": True, "message": "no limit"},
    ]


def test_a_check_that_does_not_exist_is_in_the_record_and_not_ok():
    record = next(check for check in sample().record()["checks"] if check["name"] == "unknown")
    assert record["value"] is None and record["margin"] is None and record["ok"] is False


def test_values_keep_every_digit():
    value = 2.4669517247e-06 * (1 + 2**-52)
    record = json.loads(json.dumps(sample(values={"x": Value(value, "m", "")}).record()))
    assert record["values"]["x"]["value"] == value


@pytest.mark.parametrize(
    ("value", "sense", "margin", "ok"),
    [
        (0.5, ">=", -0.5, False),
        (1.0, ">=", 0.0, True),
        (1.5, ">=", 0.5, True),
        (0.5, "<=", 0.5, True),
        (1.0, "<=", 0.0, True),
        (1.5, "<=", -0.5, False),
    ],
)
def test_a_check_has_its_margin_on_the_good_side(value, sense, margin, ok):
    check = Check("c", np.float64(value), 1.0, sense, "-", "")
    assert check.margin == margin and check.ok is ok


def test_a_check_that_could_not_be_computed_is_not_passed():
    assert not CHECKS[2].ok and not sample().ok and sample(checks=CHECKS[1:2]).ok and sample(checks=()).ok


def test_names_that_are_none_are_refused_with_the_nearest():
    result = sample()
    assert result["lift"] == 0.02 and result.check("low") is CHECKS[0] and TABLE["force"].unit == "N"
    for ask, message in (
        (lambda: result["lifd"], "no value is called 'lifd' .did you mean 'lift'"),
        (lambda: result.check("lo"), "no check is called 'lo'"),
        (lambda: result.table("farce"), "did you mean 'force'"),
        (lambda: TABLE["farce"], "no column of table 'force' is called 'farce'"),
    ):
        with pytest.raises(UnknownName, match=message):
            ask()


def test_a_table_on_disk_has_units_and_meanings(tmp_path):
    from pyarrow import parquet

    parquet.write_table(sample().table("force"), tmp_path / "force.parquet")
    read = parquet.read_table(tmp_path / "force.parquet")
    assert read.schema.metadata[b"title"] == b"Force over the turn" and read.column("force").to_pylist() == [0.0, 1.0, 2.0]
    fields = {f.name: (f.metadata[b"unit"], f.metadata[b"meaning"]) for f in read.schema}
    assert fields == {"angle": (b"rad", b"cam angle"), "force": (b"N", b"normal force")}


def test_a_result_is_a_value_that_travels():
    result = sample(provenance={"seed": 3})
    again = pickle.loads(pickle.dumps(result))
    assert again.record() == result.record() and again.spec == result.spec
    with pytest.raises(AttributeError):
        result.title = "x"


def test_a_notebook_shows_checks_findings_and_values():
    page = result_card(sample(title="<b>a toy</b>", warnings=("one",)))
    assert "&lt;b&gt;a toy" in page and "✗" in page and "✓" in page and "Height" in page and "<li>⚠ one</li>" in page
    assert "<b>a toy" not in page and "Stroke" in page and "20\u00a0mm" in page and page.count("<table>") == page.count("</table>") >= 3


@pytest.mark.parametrize(
    "data",
    [
        np.array([0.5, np.nan, -np.inf]),
        np.arange(10)[::2],
        np.array([1, 2], dtype=np.int32),
        np.array(["", "Wälzlager", "键"]),
        np.array(["a", "bb"], dtype=object),
        np.array([True, False, True]),
        np.array(["a", None], dtype=object),
        np.array([], dtype=float),
    ],
    ids=repr,
)
def test_a_column_in_arrow_is_what_arrow_makes_of_it(data):
    import pyarrow as pa

    table = Table("t", "T", (Column("c", "-", "anything", data),)).arrow()
    table.validate(full=True)
    expected = pa.array(data)
    assert table["c"].type == expected.type and table["c"].to_pylist().__repr__() == expected.to_pylist().__repr__()
