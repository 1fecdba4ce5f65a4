"""The analysis `assembly` of an indexer, and its option of elastic bodies."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

import drivewright as dw
from drivewright import registry
from drivewright.errors import SpecError
from drivewright.indexing import solid
from drivewright.indexing.solid import tables
from drivewright.mechanisms.indexer import assembly
from drivewright.mechanisms.indexer.build import IndexerModel
from drivewright.runner import build

pytestmark = pytest.mark.interface

PRESETS = registry.mechanism("indexer").presets()
UNSIZED = ("crank_bearings.bearing=", 'crank_bearings.law="elements"', 'crank_bearings.stiffness="3e8 N/m"')


def spec(*changes):
    return dw.load(PRESETS["default"], changes)


def left_out(given):
    return next(text for text in dw.run(given, ("assembly",)).findings if "'assembly'" in text)


def test_it_runs_on_request_only():
    analysis = next(each for each in registry.mechanism("indexer").analyses if each.name == "assembly")
    assert not analysis.default and not analysis.needs


@pytest.mark.parametrize(
    ("given", "reason"),
    [
        (lambda: spec("load.torque="), "load.torque is not given"),
        (lambda: spec(*UNSIZED), "no body has a size: give crank_bearings.bearing, which sets the holes of the cams and the crank pins"),
        (lambda: dw.load(PRESETS["barrel"]), "kind 'barrel' has no cams on cranks"),
    ],
)
def test_why_it_is_left_out(given, reason):
    assert left_out(given()).endswith(reason)


def test_elastic_bodies_without_size_are_refused():
    with pytest.raises(SpecError, match='bodies: "elastic" needs the size of the bodies: give crank_bearings.bearing'):
        build(spec(*UNSIZED, 'bodies="elastic"'))
    assert any("does not use bodies" in text for text in build(dw.load(PRESETS["barrel"], ('bodies="elastic"',))).findings)


def test_bodies_are_rigid_unless_told_otherwise():
    model = build(spec())
    assert model.spec.bodies == "rigid" and model.loaded_wheel == model.rigid_wheel and model.train.bodies is None


@cache
def rigid_assembly():
    """The assembly of the preset, every body as in the lumped model: no finite elements."""
    patch = pytest.MonkeyPatch()
    patch.setattr(IndexerModel, "solids", solid.Solids())
    try:
        return build(spec()), assembly.load(build(spec())), assembly.assembly(build(spec()), {})
    finally:
        patch.undo()


def test_with_bodies_of_the_lumped_model_it_adds_nothing():
    _, loaded, answer = rigid_assembly()
    assert loaded.angles == pytest.approx(np.radians(22.5) * np.arange(9))
    for model in ("unilateral", "bonded"):
        assert loaded.solids[model].secant == pytest.approx(loaded.lumped[model].secant, rel=1e-9, nan_ok=True)
        added = tables.added_compliance(loaded.solids[model], loaded.lumped[model])
        carried = np.isfinite(loaded.solids[model].secant)
        assert np.abs([part[carried] for part in added.values()]).max() < 1e-9 / np.nanmin(loaded.solids[model].secant)
    value = answer.values["assembly.stiffness.mean"]
    assert value.value == pytest.approx(np.nanmean(loaded.lumped["unilateral"].secant), rel=1e-9)
    assert value.low == pytest.approx(0.98 * value.value) and value.high == value.value and value.interval == "mesh"
    assert answer.values["assembly.stiffness.minimum"].value == pytest.approx(np.nanmin(loaded.lumped["unilateral"].secant), rel=1e-9)
    assert answer.values["assembly.stiffness.ratio"].value == pytest.approx(1.0, rel=1e-9)
    assert answer.values["assembly.undefined_fraction"].value == pytest.approx(2 / 9)


APART = (("stations=6",), ("stations=4", "pin_phase=0.3"), ("pins=24", "stations=8", "cams=3", 'pin_radius="4 mm"'))


@pytest.mark.parametrize("changes", APART)
def test_with_stations_apart_from_pins_the_same_bodies_add_nothing(monkeypatch, changes):
    """Every pin of every cam stands where the lumped model has it, whatever the number of pins that a step passes."""
    monkeypatch.setattr(IndexerModel, "solids", solid.Solids())
    loaded = assembly.load(build(spec(*changes)), positions=5)
    for model in ("unilateral", "bonded"):
        assert np.isfinite(loaded.solids[model].secant).any()
        assert loaded.solids[model].secant == pytest.approx(loaded.lumped[model].secant, rel=1e-6, nan_ok=True)


def test_pins_of_the_lumped_model_are_told_to_yield_as_they_do():
    """Pins that stick close no gap and yield (F/K_l)^0.9 + F/k; put into the wheel's share, sum F^2/(k T^2) gives k back."""
    _, loaded, answer = rigid_assembly()
    own, line = loaded.solids["bonded"], 8.06e10 * spec().cam_width ** (8 / 9)
    dents = np.array([np.sum(np.abs(forces) ** 1.9) for forces in own.pin_forces]) / line**0.9
    series = own.shares["pin"] - dents / own.torque**2
    moved = replace(own, shares=own.shares | {"wheel": series})
    assert tables.equivalent_pin_stiffness(moved) == pytest.approx(spec().contact.pin_stiffness, rel=1e-6)
    assert np.isnan(tables.equivalent_pin_stiffness(own)) and not any("yield like" in text for text in answer.findings)


def test_shares_add_up():
    _, loaded, answer = rigid_assembly()
    own = loaded.solids["unilateral"]
    assert sum(tables.compliance_by_body(own).values()) == pytest.approx(1 / own.secant, rel=1e-9, nan_ok=True)
    assert sum(answer.values[f"assembly.share.{name}"].value for name in tables.BODIES) == pytest.approx(1.0, rel=1e-9)


def test_tables_and_findings():
    _, _, answer = rigid_assembly()
    by_name = {table.name: table for table in answer.tables}
    assert set(by_name) == {"assembly", "assembly_shares", "assembly_added", "assembly_pins"}
    assert np.isnan(by_name["assembly"]["unilateral"].data[:2]).all() and np.isfinite(by_name["assembly"]["bonded"].data).all()
    forces = by_name["assembly_pins"]["force"].data
    assert answer.values["assembly.pins.max_force"].value == forces.max() and forces.min() > 0
    assert answer.findings[0].startswith("assembly: no stiffness at 2 of 9 input angles (0, 22.5°): no contact without a gap")
    assert {plot.name for plot in tables.assembly_plots(by_name)} == set(by_name)


def test_one_input_angle():
    patch = pytest.MonkeyPatch()
    patch.setattr(IndexerModel, "solids", solid.Solids())
    free = assembly.assembly(build(spec('load.angle="10 deg"')), {})
    held = assembly.assembly(build(spec('load.angle="100 deg"', 'contact.model="bonded"')), {})
    patch.undo()
    assert free.values.keys() == {"assembly.undefined_fraction"} and free.values["assembly.undefined_fraction"].value == 1
    assert held.values["assembly.bonded.stiffness.mean"].value == pytest.approx(held.values["assembly.stiffness.mean"].value, rel=1e-12)


@pytest.mark.needs_fe
@pytest.mark.slow
def test_the_prototype():
    """Softer than the lumped model everywhere; the parts of what that leaves out add up to all of it; the bodies are drawn."""
    result = dw.run(spec(), ("assembly",))
    table = result.tables["assembly"]
    for model in ("unilateral", "bonded"):
        ratio = table[f"ratio_{model}"].data
        assert np.nanmin(ratio) > 0.7 and np.nanmax(ratio) < 0.97
    assert 0.8 < result["assembly.stiffness.ratio"] < 0.95
    assert result["assembly.stiffness.minimum"] < result["assembly.stiffness.mean"] < result["assembly.bonded.stiffness.mean"]
    assert sum(result[f"assembly.added.{name}"] for name in tables.BODIES) == pytest.approx(1.0, rel=1e-9)
    assert result["assembly.added.cam"] > 0.3 and abs(result["assembly.added.gear"]) < 0.02
    (told,) = [text for text in result.findings if "yield like contact.pin_stiffness" in text]
    assert told.endswith("the lumped model has 5e+08 N/m")
    for body in ("cam", "shaft", "wheel"):
        moved = result.tables[f"assembly_{body}"]["displacement"].data
        assert 1e-5 < moved.max() < 1e-3 and len(moved) % 3 == 0
        assert "input at 45°" in result.tables[f"assembly_{body}"].title


@pytest.mark.needs_fe
@pytest.mark.slow
def test_elastic_bodies_bring_the_stiffness_down_to_the_assembly():
    elastic = spec('bodies="elastic"')
    rigid, found, whole = dw.run(spec(), ("stiffness",)), dw.run(elastic, ("stiffness",)), dw.run(elastic, ("assembly",))
    assert found["stiffness.mean"] < 0.97 * rigid["stiffness.mean"]
    assert 0.93 < whole["assembly.stiffness.ratio"] < 1.0
