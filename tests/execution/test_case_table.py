"""The columns of a table of cases: unit, label and meaning of the value that they come from."""

import numpy as np
import pytest

from drivewright.execution.case_table import case_table
from drivewright.execution.keys import KeyKind
from drivewright.execution.outputs import case_outputs
from drivewright.result import Check, Value

pytestmark = pytest.mark.interface


def test_columns_have_the_label_of_the_value_they_come_from():
    values = {
        "force.peak": Value(2.0, "N", "largest force on a pin, over the turn", low=1.0, high=3.0, interval="ensemble", label="Peak force"),
        "mass": Value(1.0, "kg", "mass of the crank, without pins"),
    }
    outputs = case_outputs(values, [Check("wall", 4e-3, 3e-3, ">=", "m", "wall between the holes")])
    about = {name: output.about for name, output in outputs.items()}
    columns = {"limits.static_safety": np.array([1.0])}
    data = {name: np.array([output.value]) for name, output in outputs.items()}
    table = case_table(0, columns, {"limits.static_safety": KeyKind("number")}, data, about, ["complete"], [""])
    labels = {field.name: field.metadata[b"label"].decode() for field in table.schema}
    assert labels == {
        "case": "Case",
        "status": "Status",
        "message": "Message",
        "limits.static_safety": "Limits · static safety",
        "force.peak": "Peak force",
        "force.peak.low": "Peak force",
        "force.peak.high": "Peak force",
        "mass": "Mass of the crank",
        "check.wall": "Wall between the holes, margin",
    }
    assert table.schema.field("force.peak.low").metadata[b"bounds"] == b"force.peak"
