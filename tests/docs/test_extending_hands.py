"""The drive of docs/extending.md that a hand can move, edit and build: its code runs as it stands there, and does what the text says."""

import json
import re
import sys
from types import ModuleType

import numpy as np
import pytest
from places import ROOT

from drivewright import registry, runner
from drivewright.report.pack_plots import pack_every_plot
from drivewright.studio import preview
from drivewright.studio.design import Design
from drivewright.studio.document import Document
from drivewright.view.panels import known_plots

pytestmark = pytest.mark.interface

TURN = [("90 deg", "cycloidal", "30 mm"), ("90 deg", "dwell", "0 mm"), ("120 deg", "modified-sine", "-30 mm"), ("60 deg", "dwell", "0 mm")]
TABLES = {
    "mechanism": "lift-table",
    "width": "200 mm",
    "programme": [{"angle": angle, "law": law, "rise": rise} for angle, law, rise in TURN],
    "weights": [{"at": ["-30 mm", "10 mm"]}],
}


@pytest.fixture
def drive(monkeypatch):
    """The mechanism that the code of the section makes, known to this process."""
    text = (ROOT / "docs" / "extending.md").read_text(encoding="utf-8")
    section = text[text.index("## What a hand can move") : text.index("## An indexing drive")]
    module = ModuleType("lift_table")
    monkeypatch.setitem(sys.modules, "lift_table", module)
    exec("\n".join(re.findall(r"```python\n(.*?)```", section, re.DOTALL)), module.__dict__)
    kinds, find = registry.kinds, registry.mechanism
    monkeypatch.setattr(registry, "kinds", lambda: sorted([*kinds(), "lift-table"]))
    monkeypatch.setattr(registry, "mechanism", lambda kind: module.mechanism if kind == "lift-table" else find(kind))
    return module.mechanism


@pytest.fixture
def document(drive):
    return Document(Design(TABLES))


def drawn(document, **how):
    """What the page is sent of a drawing."""
    sent = []
    preview.draw(sent.append, document.design, (), **how)
    return json.loads(sent[-1])


def test_its_handles_go_where_their_keys_say(drive, document):
    def handles():
        return {handle.key: handle for handle in drive.scene(runner.build(document.design.spec())).handles}

    before = handles()
    document.drag({"width": "210 mm"}, "g")
    assert np.subtract(handles()["width"].point, before["width"].point) == pytest.approx(np.multiply(before["width"].direction, 0.01))
    document.drag({"weights.0.at.0": "5 mm", "weights.0.at.1": "12 mm"}, "h")
    assert handles()["weights.0.at"].point == pytest.approx((0.005, 0.012)) and handles()["weights.0.at"].body == "table"
    assert [handle["key"] for handle in drawn(document)["scene"]["handles"]] == ["width", "weights.0.at"]


def test_while_a_hand_moves_it_its_quick_scene_is_drawn(document):
    assert 4 * len(drawn(document, moving=True)["scene"]["u"]) < len(drawn(document)["scene"]["u"])


def test_its_programme_can_be_edited(document):
    packed = drawn(document)["programme"]
    assert [segment["law"] for segment in packed["segments"]] == [law for _, law, _ in TURN] and packed["list"] == "programme"
    for n, segment in enumerate(packed["segments"]):
        document.set(f"{packed['list']}.{n}.{packed['keys']['angle']}", f"{np.degrees(segment['angle']):.9g} deg")
    document.drag({"programme.0.angle": "80 deg", "programme.1.angle": "100 deg"}, "border")
    assert runner.build(document.design.spec()).lift.levels == pytest.approx([0, 0.03, 0.03, 0, 0])
    elements = [{"of": 0, "changes": {"law": packed["laws"][2]["name"]}}, *({"of": n, "changes": {}} for n in (1, 2, 3))]
    document.arrange("programme", elements)
    assert document.design.tables["programme"][0]["law"] == "modified-sine"


def test_its_main_plots_and_diagrams_are_those_it_names(drive, document):
    result = runner.run(document.design.spec())
    found = pack_every_plot(result, drive.scene(runner.build(result.spec)), tuple(known_plots(result).values()))
    assert found["first"] == ["lift/lift", "speed/speed"] and found["diagrams"] == ["load/count"]


def test_it_is_built_by_clicks(document):
    document.drop("weights", 0)
    assert drawn(document, building=True)["missing"] == ["there is no weight on the table"]
    document.construct("weight", [(0.02, 0.01)], 0.001)
    assert document.design.tables["weights"] == [{"at": ["20 mm", "10 mm"]}] and drawn(document, building=True)["missing"] == []
    document.undo()
    document.undo()
    assert document.design.tables == TABLES
