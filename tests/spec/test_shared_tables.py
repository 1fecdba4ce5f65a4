"""Specs of one study: made from shared, validated tables they are those made from raw ones, and so is what is wrong with them."""

import numpy as np
import pytest
from places import EXAMPLES

from drivewright import load
from drivewright.errors import DrivewrightError, SpecError
from drivewright.execution.evaluation import PreparedTask, case_task
from drivewright.execution.keys import key_kind
from drivewright.spec import Spec, document, from_document, set_key, value_at
from drivewright.spec.shared_tables import share_tables
from drivewright.units import SI

pytestmark = pytest.mark.property
PAIRS = 25  # of keys of a spec, spread over all of them
SPECS = sorted(EXAMPLES.glob("*.toml"))


def drive(path):
    """(raw tables, spec) without what a study leaves out."""
    spec = load(path)
    tables = {name: table for name, table in document(spec).items() if name not in ("study", "optimise")}
    return tables, from_document(tables)


def quantities(tables, spec, before=""):
    """Dotted keys of the quantities in raw tables."""
    for name, raw in tables.items() if isinstance(tables, dict) else enumerate(tables):
        key = f"{before}{name}"
        if isinstance(raw, (dict, list)):
            yield from quantities(raw, spec, f"{key}.")
        elif isinstance(value_at(spec, key), float):
            try:
                if key_kind(spec, key).name == "quantity":
                    yield key
            except SpecError:
                continue  # what a study cannot vary


def changed(tables, given, model):
    """The spec, or the words of its refusal."""
    for key, value in given.items():
        set_key(tables, key, value)
    try:
        return from_document(tables, model)
    except DrivewrightError as error:
        return str(error)


@pytest.mark.parametrize("path", SPECS, ids=lambda path: path.stem)
def test_specs_from_shared_tables_are_those_from_raw_ones(path):
    tables, spec = drive(path)
    keys = list(quantities(tables, spec))
    assert keys
    pairs = list(zip(keys, keys[1:] + keys[:1], strict=True))
    for first, second in pairs[:: -(-len(pairs) // PAIRS)]:
        shared, raw = share_tables(document(spec), spec, (first, second)), document(spec)
        for factor in (1.001, 0.5):
            given = {key: SI(factor * value_at(spec, key)) for key in (first, second)}
            ours, theirs = changed(shared, given, type(spec)), changed(raw, given, type(spec))
            if isinstance(theirs, str):
                assert isinstance(ours, str)
            else:
                assert ours == theirs and ours.digest() == theirs.digest()


def test_tables_without_a_key_are_the_same_ones_and_the_others_are_not():
    tables, spec = drive(EXAMPLES / "hyvo_chain.toml")
    shared = share_tables(tables, spec, ("joint.rolling_radius", "pitch"))
    made = changed(shared, {"joint.rolling_radius": SI(1.3e-3), "pitch": SI(9.6e-3)}, type(spec))
    assert made.joint.rolling_radius == 1.3e-3 and spec.joint.rolling_radius == 1.2e-3 and made.pitch == 9.6e-3
    shared_names = {name for name in tables if isinstance(getattr(spec, name), Spec) and getattr(made, name) is getattr(spec, name)}
    assert {"plate", "cutter", "drive"} <= shared_names and "joint" not in shared_names


def test_named_tables_and_lists_are_shared_as_a_whole():
    tables, spec = drive(EXAMPLES / "four_bar.toml")
    made = changed(share_tables(tables, spec, ("drive.speed",)), {"drive.speed": SI(3.0)}, type(spec))
    assert made.drive.speed == 3.0 and made.bodies["crank"] is spec.bodies["crank"] and made.joints[0] is spec.joints[0]


def test_tables_that_are_looked_at_as_a_whole_before_they_are_validated_stay_raw():
    """A cam's `rotation` may be said in its tables [drive] and [follower]."""
    tables, spec = drive(EXAMPLES / "oscillating_cam.toml")
    assert any(each.info.mode == "before" for each in type(spec).__pydantic_decorators__.model_validators.values())
    assert share_tables(tables, spec, ("base_radius",)) == tables


@pytest.mark.parametrize(("key", "values"), [("joint.rolling_radius", (1.2e-3, -1.0, 9e-3)), ("pitch", (9.525e-3, 0.0, -1e-3))])
def test_a_case_that_is_refused_says_the_same_as_its_spec(key, values):
    path = EXAMPLES / "hyvo_chain.toml"
    prepared = PreparedTask(case_task(load(path, ('study.analyses=["closure"]',)), (key,)))
    tables, spec = drive(path)
    for n, value in enumerate(values):
        case, alone = prepared.case({key: np.array(values)}, n), changed(tables, {key: SI(value)}, type(spec))
        assert (case.message == alone) if isinstance(alone, str) else (case.status == "complete")
    assert prepared.case({key: np.array(values)}, 0).values  # a refusal leaves the tables as good as before
