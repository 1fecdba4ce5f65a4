"""Pictures, scenes, the independent route, exports: what fails there costs nothing else, and says who is to blame."""

import json
from types import SimpleNamespace

import pytest
from places import EXAMPLES

import drivewright as dw
from drivewright import registry, runner
from drivewright.cams import clearance
from drivewright.errors import DoesNotAssemble, GeometryCheckFailed, InputError, MissingExtra, SolverError
from drivewright.mechanisms.seedling_pusher import dynamics
from drivewright.report import content, export
from drivewright.result import Answer, Check
from drivewright.studies import verification as verify
from drivewright.studio import preview
from drivewright.studio.opening import opened

pytestmark = [pytest.mark.interface, pytest.mark.faults]


def raises(error):
    def call(*given, **named):
        raise error

    return call


@pytest.fixture(scope="module")
def cam():
    return dw.run(dw.load(EXAMPLES / "disc_cam.toml"), only=("motion", "geometry"))


def test_one_figure_that_fails_is_missing_and_the_others_are_there(cam, monkeypatch):
    seen = content.views(cam)
    whole = content.pictures(cam, seen)
    monkeypatch.setattr(content, "draw_drawing", raises(ZeroDivisionError("no <width>")))
    cut = content.pictures(cam, seen)
    assert [picture.name for picture in cut] == [picture.name for picture in whole]
    missing = [picture for picture, before in zip(cut, whole, strict=True) if picture.svg != before.svg]
    assert missing and {picture.name.split("-")[0] for picture in missing} == {"drawing"}
    assert (
        all(
            "This figure is missing: failed by a fault of the program" in " ".join(picture.svg.replace("<", " <").split())
            or "ZeroDivisionError" in picture.svg
            for picture in missing
        )
        and "<width>" not in missing[0].svg
    )


@pytest.mark.parametrize(
    ("error", "words"),
    [
        (ZeroDivisionError("x"), "no motion to show: failed by a fault of the program, not of the spec: ZeroDivisionError: x"),
        (DoesNotAssemble("the loop stays open"), "no motion to show: the loop stays open"),
    ],
)
def test_a_scene_that_fails_is_a_remark(cam, monkeypatch, error, words):
    fake = registry.Mechanism(**{**vars(registry.mechanism("cam")), "scene": raises(error)})
    monkeypatch.setattr(registry, "mechanism", lambda name: fake)
    seen = content.views(cam, dw.build(cam.spec))
    assert seen.scene is None and seen.drawings and seen.remarks[0].startswith(words)
    told = []
    found = preview.draw(told.append, opened(EXAMPLES / "disc_cam.toml"), ["motion"])
    assert json.loads(told[0])["remarks"][0].startswith(words.removeprefix("no motion to show: ")) and found["values"]


@pytest.fixture
def verified(monkeypatch):
    """`verify` of the disc cam with a route and an outcome of the caller's."""

    def run(error, failed=()):
        kind = registry.mechanism("cam")
        fake = SimpleNamespace(kind="cam", verify=raises(error), build=kind.build)
        monkeypatch.setattr(verify, "registry", SimpleNamespace(mechanism=lambda name: fake))
        monkeypatch.setattr(verify, "run", lambda spec, model: SimpleNamespace(provenance={"failed": list(failed)}))
        return verify.verify(dw.load(EXAMPLES / "disc_cam.toml"))

    return run


@pytest.mark.parametrize(
    ("error", "failed", "kind", "words"),
    [
        (ValueError("odd"), (), SolverError, "the independent route failed: failed by a fault of the program, not of the spec: ValueError"),
        (InputError("no value is called 'x'"), ("geometry",), SolverError, "no value is called 'x'; the run lacks geometry"),
        (InputError("the twin knows no gear"), (), InputError, "^the twin knows no gear"),
        (MissingExtra("verify", "peers"), ("geometry",), MissingExtra, "needs the extra 'peers'"),
    ],
)
def test_an_independent_route_that_fails(verified, error, failed, kind, words):
    with pytest.raises(kind, match=words):
        verified(error, failed)


def test_what_could_not_be_checked_is_not_manufactured(monkeypatch, tmp_path):
    spec, kind = dw.load(EXAMPLES / "disc_cam.toml"), registry.mechanism("cam")
    analyses = tuple(
        registry.Analysis(a.name, raises(SolverError("the trimming does not end")), a.meaning) if a.name == "profile" else a
        for a in kind.analyses
    )
    fake = registry.Mechanism(**{**vars(kind), "analyses": analyses})
    monkeypatch.setattr(registry, "mechanism", lambda name: fake)
    with pytest.raises(GeometryCheckFailed, match="not checked in full and not exported: analysis 'profile' .*does not end.*--anyway"):
        export.export(spec, ("dxf",), tmp_path)
    assert not list(tmp_path.iterdir())
    assert [path.suffix for path in export.export(spec, ("dxf",), tmp_path, anyway=True)][:1] == [".dxf"]


@pytest.mark.parametrize(("manufacture", "refused"), [(True, True), (False, False)])
def test_before_an_export_run_the_default_analyses_and_those_for_manufacture(monkeypatch, tmp_path, manufacture, refused):
    spec, kind = dw.load(EXAMPLES / "disc_cam.toml"), registry.mechanism("cam")
    thin = Answer(checks=(Check("wall.rim", 1e-3, 2e-3, ">=", "m", "wall of the rim", ("cam",), geometry=True),))
    extra = registry.Analysis("rim", lambda model, done: thin, "the rim", default=False, manufacture=manufacture)
    fake = registry.Mechanism(**{**vars(kind), "analyses": (*kind.analyses, extra)})
    monkeypatch.setattr(registry, "mechanism", lambda name: fake)
    if refused:
        with pytest.raises(GeometryCheckFailed, match=r"Wall of the rim: 1.mm, limit >= 2.mm"):
            export.export(spec, ("dxf",), tmp_path)
    else:
        assert export.export(spec, ("dxf",), tmp_path)


def test_the_gears_of_a_pusher_are_checked_before_an_export_and_its_studies_do_not_run():
    asked = {a.name for a in registry.mechanism("seedling-pusher").analyses if a.default or a.manufacture}
    assert {"teeth", "inspection"} <= asked and not {"clearance", "poincare"} & asked


@pytest.mark.parametrize(("share", "failed"), [(0.9, []), (0.1, ["contact"])])
def test_the_pusher_says_until_when_its_contact_was_simulated(monkeypatch, share, failed):
    integrate, model = clearance.integrate, dw.build(dw.load(EXAMPLES / "seedling_pusher.toml"))
    steps = int(share * dynamics.simulate(model).trajectory.steps)
    monkeypatch.setattr(clearance, "integrate", lambda *given, **named: integrate(*given, **{**named, "max_steps": steps}))
    result = runner.run(model.spec, only=("contact", "load"), model=model)
    (stop,) = (finding for finding in result.findings if finding.startswith("the contact simulation ends at t = "))
    assert result.outcome == "partial" and f"the limit of {steps} steps" in stop and stop.endswith("Partial for that reason: contact")
    contact = [value for name, value in result.values.items() if name.startswith("contact.")]
    assert result.provenance["failed"] == [] and bool(contact) == (not failed)
    assert all("the contact simulation ends" in value.meaning for value in contact)
