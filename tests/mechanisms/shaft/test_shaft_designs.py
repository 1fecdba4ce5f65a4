"""Designs in the compiled batch against the run of each, for every key there is; and what is beyond the batch."""

import copy

import numpy as np
import pytest

import drivewright as dw
from drivewright.mechanisms.shaft.designs import batch

pytestmark = pytest.mark.property

TABLES = {
    "segments": [
        {"length": "90 mm", "diameter": "25 mm", "bore": "8 mm"},
        {"length": "120 mm", "diameter": "30 mm", "end_diameter": "40 mm"},
        {"length": "110 mm", "diameter": "28 mm"},
    ],
    "bearings": [
        {"name": "A", "position": "40 mm", "radial_stiffness": "4e7 N/m"},
        {"name": "B", "position": "250 mm", "radial_stiffness": "9e7 N/m"},
    ],
    "stations": [{"name": "p", "position": "0 mm"}, {"name": "q", "position": "160 mm"}],
}
KEYS = {
    "segments.0.length": 95.0,
    "segments.0.diameter": 27.0,
    "segments.1.diameter": 33.0,
    "segments.1.end_diameter": 37.0,
    "segments.0.bore": 11.0,
    "bearings.A.position": 35.0,
    "bearings.1.position": 240.0,
    "stations.q.position": 150.0,
    "stations.0.position": 8.0,
}


def changed(key, value):
    tables = copy.deepcopy(TABLES)
    table, entry, name = key.split(".")
    row = next(each for number, each in enumerate(tables[table]) if entry in (str(number), each.get("name")))
    row[name] = f"{value} mm"
    return dw.Shaft(**tables)


@pytest.mark.parametrize("key", KEYS)
def test_each_key_changes_what_it_names(key):
    names = ("flexibility.p.p", "flexibility.p.q", "flexibility.q.q")
    found = batch(dw.Shaft(**TABLES), (key,), names)(np.array([[1e-3 * KEYS[key]]]))
    wanted = dw.run(changed(key, KEYS[key]), only=("flexibility",))
    assert [found[name][0] for name in names] == pytest.approx([wanted[name] for name in names], rel=1e-9)


@pytest.mark.parametrize("more", [{"tilt_stiffness": "2e4 N m/rad"}, {"width": "10 mm"}, {"radial_clearance": "5 um"}])
def test_supports_beyond_the_batch_are_left_to_the_run(more):
    tables = copy.deepcopy(TABLES)
    tables["bearings"][1] |= more
    assert batch(dw.Shaft(**tables), ("segments.0.diameter",), ("flexibility.p.p",)) is None
    assert batch(dw.Shaft(**TABLES), ("segments.0.diameter",), ("modes.1.frequency",)) is None
