"""Every pin of every linkage example in turn with play of every model: a complete record, or a partial one that says why."""

import numpy as np
import pytest
from random_specs import EXAMPLES

from drivewright import runner
from drivewright.errors import SpecError
from drivewright.mechanisms.linkage.tables import place
from drivewright.spec import document, from_document, load

pytestmark = pytest.mark.property

TURNS, STEPS = 2, 60_000
PLAYS = {
    "dry": {"model": "dry", "clearance": "0.05 mm", "bearing_radius": "4 mm", "friction": 0.05},
    "lubricated": {"model": "lubricated", "clearance": "0.05 mm", "bearing_radius": "4 mm"},
    "massless-link": {"model": "massless-link", "clearance": "0.05 mm", "link_damping": "1e-4 N m s/rad"},
}


def pins():
    """(example, joint) of every revolute joint that no drive turns."""
    for path in sorted(EXAMPLES.glob("*.toml")):
        spec = load(path)
        if spec.mechanism == "linkage":
            for number, joint in enumerate(spec.joints):
                if joint.kind == "revolute" and not (spec.drive and spec.drive.joint == joint.name):
                    yield pytest.param(path, number, id=f"{path.stem}-{joint.name}")


def with_play(path, number, play):
    """The tables of an example with one pin replaced and a short run."""
    tables = document(load(path))
    joint = tables["joints"][number]
    for key in ("model", "clearance", "bearing_radius", "bearing_length", "stiffness", "damping"):
        joint.pop(key, None)
    joint.update(PLAYS[play])
    tables.setdefault("simulate", {}).update({"max_steps": STEPS, "discard": 0})
    if tables["simulate"].get("turns"):
        tables["simulate"]["turns"] = TURNS
    for study in ("poincare", "lyapunov", "bifurcation", "table", "tolerances", "wear"):
        tables.pop(study, None)
    return tables


@pytest.mark.slow
@pytest.mark.parametrize("play", PLAYS)
@pytest.mark.parametrize(("path", "number"), list(pins()))
def test_play_at_every_pin_in_turn(path, number, play):
    tables = with_play(path, number, play)
    try:
        spec = from_document(tables)
    except SpecError as refused:
        bodies = [place(text)[0] for text in tables["joints"][number]["connects"]]
        assert play == "massless-link" and "two clearances in series" in str(refused) and refused.key.split(".")[1] in bodies
        return
    with np.errstate(under="ignore"):
        result = runner.run(spec)
    assert result.provenance["failed"] == [], result.findings
    stopped = [finding for finding in result.findings if finding.startswith("the run ends at t = ")]
    assert (result.outcome == "partial") == bool(stopped)
    audit = result.check("energy_audit")
    assert audit.ok or stopped
    columns = [column for table in result.tables.values() for column in table.columns if np.asarray(column.data).dtype.kind == "f"]
    assert [column.name for column in columns if not np.all(np.isfinite(column.data))] == []
