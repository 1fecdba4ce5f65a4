"""The job that shows a design in three dimensions: its parts, its scene, and the analyses whose fields can be seen on them."""

from types import SimpleNamespace

import pytest

from drivewright.errors import InputError
from drivewright.studio.jobs import solid

pytestmark = pytest.mark.interface

SPEC, MODEL = SimpleNamespace(mechanism="toy"), object()


def analysis(name, fields, missing=None):
    return SimpleNamespace(
        name=name, meaning=f"what {name} is", fields=fields, missing=lambda spec: missing if spec is SPEC else "another spec"
    )


@pytest.fixture
def toy(monkeypatch):
    """A kind with two parts, of whose analyses two have fields; what is packed is told as it is."""
    kind = SimpleNamespace(
        kind="toy",
        parts=lambda model: ("plate", "pin") if model is MODEL else (),
        scene=lambda model: "scene",
        analyses=(analysis("motion", None), analysis("stress", object()), analysis("heat", object(), "its extra is not installed")),
    )
    monkeypatch.setattr(solid, "registry", SimpleNamespace(mechanism={"toy": kind}.__getitem__))
    monkeypatch.setattr(solid, "runner", SimpleNamespace(build=lambda spec: MODEL))
    monkeypatch.setattr(solid, "solid_surfaces", lambda parts, progress: [f"surface of {part}" for part in parts])
    monkeypatch.setattr(solid, "pack_solids", lambda surfaces, scene: {"parts": surfaces, "scene": scene})
    return kind


def shown():
    return solid.solid(SimpleNamespace(spec=lambda: SPEC), lambda *news: None)


def test_analyses_with_fields_are_offered_and_what_they_lack_is_said(toy):
    assert shown() == {
        "parts": ["surface of plate", "surface of pin"],
        "scene": "scene",
        "analyses": [
            {"name": "stress", "meaning": "what stress is", "missing": None},
            {"name": "heat", "meaning": "what heat is", "missing": "its extra is not installed"},
        ],
    }


def test_an_assembly_without_a_scene_stands_still(toy):
    toy.scene = None
    assert shown()["scene"] is None


@pytest.mark.parametrize("parts", [None, lambda model: ()])
def test_a_drive_without_solids_says_so(toy, parts):
    toy.parts = parts
    with pytest.raises(InputError, match="toy has no solids to show"):
        shown()
