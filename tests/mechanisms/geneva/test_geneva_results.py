"""What a Geneva drive's spec makes of its numbers: defaults, checks, findings, refusals, drawings."""

import numpy as np
import pytest

import drivewright as dw
from drivewright import registry
from drivewright.errors import SpecError
from drivewright.mechanisms.geneva.build import build
from drivewright.mechanisms.geneva.scene import drawings, parts, scene
from drivewright.spec import from_document, load

pytestmark = pytest.mark.property

PRESETS = registry.mechanism("geneva").presets()


def spec(*changes, preset="default"):
    return load(PRESETS[preset], changes)


def run(*changes, preset="default", only=None):
    return dw.run(spec(*changes, preset=preset), only) if only else dw.run(spec(*changes, preset=preset))


@pytest.mark.parametrize("preset", PRESETS)
def test_presets_pass_their_checks(preset):
    result = run(preset=preset)
    assert result.ok and result.outcome == "complete" and result["crank_excess"] == pytest.approx(0.0, abs=1e-15)


def test_the_length_that_is_left_out_fits_the_other():
    assert run(only="geometry")["crank_radius"] == pytest.approx(0.1 * np.sin(np.pi / 4), rel=1e-12)
    assert run(preset="six", only="geometry")["centre_distance"] == pytest.approx(0.08, rel=1e-12)


@pytest.mark.parametrize(("off", "fits"), [("0.005 mm", True), ("0.05 mm", False), ("-0.05 mm", False)])
def test_a_crank_that_is_off_fails_the_fit_and_is_computed_all_the_same(off, fits):
    radius = f"crank_radius={70.71067811865476 + float(off.split()[0])!r} mm"
    result = run(radius)
    assert result.check("fit").ok == fits and "max_pressure.drive" in result.values
    assert any("strikes the tip of the wheel" in finding for finding in result.findings) != fits


def test_a_slot_without_clearance_fits_the_pin():
    result = run("wheel.slot_clearance=0 mm", only="entry")
    assert result.check("fit").ok and result["entry.path_angle"] == pytest.approx(0.0, abs=1e-7) and result["crossing.speed"] == 0.0


def test_the_energy_is_not_audited_where_a_shock_takes_it():
    assert run(only="energy").check("energy_audit").ok
    off = run("crank_radius=70.8 mm", only="energy")
    assert "energy.error" not in off.values and any("shock" in finding for finding in off.findings)


@pytest.mark.parametrize(
    ("change", "check"),
    [
        ("limits.acceleration=400 rad/s^2", "acceleration"),
        ("limits.dwell=280 deg", "dwell"),
        ("limits.contact_pressure=500 MPa", "contact_pressure"),
        ("limits.slot_wall=30 mm", "slot_wall"),
        ("limits.mouth_wall=20 mm", "mouth_wall"),
        ("locking.radius=62 mm", "mouth_wall"),
        ("wheel.bore=40 mm", "bore_wall"),
        ("wheel.hub_diameter=50 mm", "hub_clearance"),
        ("wheel.hub_diameter=20 mm", "hub_wall"),
        ("locking.bore=50 mm", "disc_wall"),
        ("pin.journal_radius=7.5 mm", "roller_wall"),
        ("manufacture.cutter_diameter=17 mm", "cutter"),
        ("locking.clearance=0.5 mm", "dwell_play"),
        ("wheel.slot_clearance=1 mm", "entry_angle"),
        ("limits.locking_clearance=0.1 mm", "locking_clearance"),
        ("limits.life=1e9 h", "bearing_life"),
    ],
)
def test_each_check_can_fail(change, check):
    result, usual = run(change), run()
    assert not result.check(check).ok
    assert change.startswith("limits") or usual.check(check).ok


def test_a_fixed_pin_slides_and_a_roller_less():
    fixed, roller = (run(f"pin.kind={kind}", "pin.journal_radius=4 mm", only="forces") for kind in ("fixed", "roller"))
    assert fixed["max_sliding_speed"] == pytest.approx(2 * roller["max_sliding_speed"], rel=1e-9)
    assert fixed["friction_work"] > roller["friction_work"] > 0
    assert run("pin.friction=0.0", only="forces")["friction_work"] == 0.0


def test_wear_goes_with_its_coefficient():
    once, twice = (run(f"pin.wear_coefficient={rate} mm^3/(N m)", preset="six", only="forces") for rate in ("1e-7", "2e-7"))
    assert twice["wear.volume"] == pytest.approx(2 * once["wear.volume"]) and once["wear.slot_depth"] > 0
    work = once["friction_work"] / 0.1  # friction work over the coefficient is force times path
    assert once["wear.volume"] == pytest.approx(1e6 * 1e-16 * work, rel=1e-9)


def test_the_mean_torque_pays_friction_and_load():
    result = run(only="forces")
    assert result["crank.mean_torque"] * 2 * np.pi == pytest.approx(1.0 * np.pi / 2 + result["friction_work"], rel=1e-4)


def test_a_law_spreads_over_time_and_leaves_the_step_alone():
    even, driven = run("drive.law=uniform", preset="servo"), run(preset="servo")
    assert driven["max_bend"] == even["max_bend"] and driven["motion_angle"] == even["motion_angle"]
    assert driven["motion_time"] < even["motion_time"] and driven["max_speed"] > even["max_speed"]
    assert driven.tables["motion"].columns[0].name == "time" and even.tables["motion"].columns[0].name == "angle"


@pytest.mark.parametrize(
    ("changes", "key", "words"),
    [
        (("crank_radius=100 mm",), "crank_radius", "reaches the axis of the wheel"),
        (("pin.radius=25 mm",), "pin.radius", "slots meet"),
        (("pin.radius=12 mm", "wheel.end_clearance=25 mm"), "pin.radius", "slots meet"),
        (("locking.radius=25 mm",), "locking.radius", "does not reach the wheel"),
        (("locking.radius=79 mm",), "locking.radius", "no sides"),
        (("wheel.outer_radius=100 mm",), "wheel.outer_radius", "axis of the crank"),
        (("wheel.outer_radius=29 mm",), "wheel.outer_radius", "no sides"),
        (("bearing.friction=0.1",), "bearing.radius", "is missing"),
        (("pin.material=cheese",), "pin.material", "cheese"),
        (("bearing.bearing=9999999",), "bearing.bearing", "9999999"),
    ],
)
def test_what_has_no_solution_is_refused_by_its_key(changes, key, words):
    with pytest.raises(SpecError, match=words) as refused:
        build(spec(*changes))
    assert refused.value.key == key


def test_a_drive_without_lengths_is_refused():
    tables = {"mechanism": "geneva", "slots": 4, "pin": {"radius": "8 mm"}, "drive": {"speed": "60 rpm"}}
    with pytest.raises(SpecError, match="give centre_distance, crank_radius") as refused:
        build(from_document(tables))
    assert refused.value.key == "centre_distance"


@pytest.mark.parametrize("preset", PRESETS)
def test_the_pin_stays_in_its_slot_on_screen(preset):
    """In the frame of the wheel the pin of every frame of the step lies on the axis of slot 0."""
    model = build(spec(preset=preset))
    drawn = scene(model)
    wheel, crank = (next(body.poses for body in drawn.bodies if body.name == name) for name in ("wheel", "crank"))
    pin = model.step.crank_radius * np.exp(1j * crank[:, 2])
    inside = np.abs(crank[:, 2]) <= model.step.half_engagement
    seen = (pin - wheel[:, 0]) * np.exp(-1j * wheel[:, 2])
    assert np.max(np.abs(seen[inside].imag)) < 1e-12 and np.min(seen[inside].real) > 0
    assert np.ptp(wheel[:, 2]) == pytest.approx(2 * np.pi / model.spec.slots) and wheel[-1, 2] < wheel[0, 2], "clockwise"


def test_drawings_and_parts():
    model = build(spec())
    assert [sheet.name for sheet in drawings(model)] == ["wheel", "disc"]
    assert all(sheet.on("profile") and sheet.on("hole") and sheet.thickness == pytest.approx(0.012) for sheet in drawings(model))
    assert [part.name for part in parts(model)] == ["crank", "pin", "wheel"]
