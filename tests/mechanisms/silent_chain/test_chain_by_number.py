"""A chain drive by the number of its chain: what it fills, what wins over it, rows, safety against breaking."""

import numpy as np
import pytest

import drivewright as dw
from drivewright.chains.sizes import chain_size
from drivewright.errors import SpecError
from drivewright.mechanisms.silent_chain.sizing import supplied
from drivewright.spec import from_document, schema, template
from drivewright.spec.parsing import change_key, parse_document

pytestmark = pytest.mark.interface

SPEC = {
    "mechanism": "silent-chain",
    "chain": "08B",
    "links": 100,
    "teeth": [19, 38],
    "drive": {"speed": "1000 rpm", "preload": "400 N", "load_torque": "20 N m"},
}


def spec(*changes):
    tables = {key: dict(value) if isinstance(value, dict) else value for key, value in SPEC.items()}
    for change in changes:
        change_key(tables, change)
    return from_document(tables)


def check(result, name):
    return next(each for each in result.checks if each.name == name)


def run(*changes, only=("contact", "layout")):
    return dw.run(spec(*changes), only=only)


def test_the_number_fills_pitch_roller_pin_plate_and_joint():
    size = chain_size("08B")
    model = dw.build(spec())
    assert model.spec.pitch == size.pitch and model.link.pitch == size.pitch and model.link.radius == 0
    assert model.joint_kind == "revolute" and model.pins.radius == size.pin_diameter / 2
    assert model.roller_diameter == size.roller_diameter and model.sheet == size.outer_plate
    assert model.link_mass.mass == pytest.approx(0.69 * 12.7e-3) and model.contact_length == size.bush_length
    link = model.roller_link
    assert link.end_radius == size.plate_height / 2 and link.inner_plate == pytest.approx(size.inner_plate)
    assert link.width == pytest.approx(size.inner_width + 4 * size.outer_plate)
    assert not model.findings


def test_thicker_inner_plates_make_the_chain_wider():
    model, size = dw.build(spec("chain=16B")), chain_size("16B")
    assert (size.inner_plate, size.outer_plate) == (4.15e-3, 3.1e-3)
    assert model.chain_width == pytest.approx(size.inner_width + 2 * (4.15e-3 + 3.1e-3))
    assert model.roller_link.bush_gap(model.contact_length) == pytest.approx(0, abs=1e-12)


def test_it_is_the_drive_whose_keys_are_given_one_by_one():
    size = chain_size("08B")
    written = {
        **SPEC,
        "pitch": f"{size.pitch!r} m",
        "breaking_load": f"{size.tensile_strength!r} N",
        "joint": {"kind": "revolute", "pin_diameter": f"{size.pin_diameter!r} m", "contact_length": f"{size.bush_length!r} m"},
        "roller": {"diameter": f"{size.roller_diameter!r} m", "inner_width": f"{size.inner_width!r} m"},
        "plate": {
            "thickness": f"{size.outer_plate!r} m",
            "back": f"{size.plate_height / 2!r} m",
            "link_mass": f"{size.mass_per_length * size.pitch!r} kg",
        },
    }
    del written["chain"]
    by_number, by_hand = run(), dw.run(from_document(written), only=("contact", "layout"))
    assert {name: value.value for name, value in by_number.values.items()} == {name: value.value for name, value in by_hand.values.items()}


def test_keys_beside_it_win_and_are_told_of():
    found = dw.build(spec('pitch="12 mm"', 'plate.link_mass="9 g"', 'roller.diameter="8.51 mm"'))
    assert found.spec.pitch == 12e-3 and found.link_mass.mass == 9e-3
    about_pitch, about_mass = found.findings
    assert "pitch = 12 mm" in about_pitch and "12.7 mm of chain 08B-1" in about_pitch
    assert "plate.link_mass = 0.009 kg" in about_mass and "0.008763 kg" in about_mass
    assert any("pitch = 12 mm" in finding for finding in run('pitch="12 mm"').findings)


def test_a_bush_chain_says_so():
    (finding,) = dw.build(spec("chain=25")).findings
    assert "04C-1 (ANSI 25) has no rollers" in finding


def test_a_number_without_quotes_is_a_number_too():
    assert dw.build(spec("chain=40")).spec.pitch == 12.7e-3


def test_another_number_is_another_chain():
    changed = spec().replace(chain="10B")
    assert dw.build(changed).spec.pitch == 15.875e-3 and not dw.build(changed).findings
    assert from_document(parse_document(changed.to_toml())) == changed


def test_a_study_may_vary_about_what_the_number_gives():
    numbers = supplied(spec())
    assert numbers["pitch"] == 12.7e-3 and numbers["breaking_load"] == 17.8e3 and "joint.kind" not in numbers
    assert "pitch" not in supplied(spec('pitch="12 mm"'))


@pytest.mark.analytical
def test_safety_against_breaking():
    result = run()
    tight = result["strand.tight_force"] + result["strand.centrifugal_force"]
    slack = result["strand.slack_force"] + result["strand.centrifugal_force"]
    assert result["chain.breaking_load"] == 17.8e3
    assert result["chain.static_safety"] == pytest.approx(17.8e3 / tight, rel=1e-12)
    assert result["chain.mean_static_safety"] == pytest.approx(17.8e3 / (0.5 * (tight + slack)), rel=1e-12)
    assert check(result, "chain.static_safety").ok
    failed = check(run('drive.load_torque="500 N m"'), "chain.static_safety")
    assert not failed.ok and failed.limit == 6 and "breaking load" in failed.message
    assert check(run("limits.static_safety=100"), "chain.static_safety").limit == 100
    assert run('breaking_load="10 kN"')["chain.breaking_load"] == 10e3


def test_without_a_drive_the_force_given_counts():
    found = run("drive=", 'contact.force="2 kN"', only=("contact",))
    assert found["chain.static_safety"] == pytest.approx(8.9, rel=1e-12) and "chain.mean_static_safety" not in found.values


@pytest.mark.analytical
@pytest.mark.parametrize(("bush", "gap"), [("", 0.0), ("17.02 mm", 4.15e-3)])
def test_the_pin_is_a_beam_between_outer_plates(bush, gap):
    """Greatest moment F/2 (L/4 + s/2 + gap): the bush goes through the inner plates, or ends between them."""
    result, size = run("chain=16B", *([f"joint.contact_length={bush}"] if bush else [])), chain_size("16B")
    length = 17.02e-3 if bush else size.bush_length
    moment = 0.5 * result["pin.force"] * (length / 4 + size.outer_plate / 2 + gap)
    assert result["pin.bending_stress"] == pytest.approx(32 * moment / (np.pi * size.pin_diameter**3), rel=1e-9)


@pytest.mark.property
def test_two_rows_bear_half_each():
    one, two = run('breaking_load="10 kN"', 'plate.link_mass="10 g"'), run("chain=08B-2", 'breaking_load="10 kN"', 'plate.link_mass="10 g"')
    assert two["pin.force"] == one["pin.force"] and two["chain.static_safety"] == one["chain.static_safety"]
    for name in ("pin.bearing_pressure", "pin.bending_stress", "pin.shear_stress"):
        assert two[name] == pytest.approx(0.5 * one[name], rel=1e-12)
    model = dw.build(spec("chain=08B-2"))
    assert model.rows == 2 and model.chain_width == pytest.approx(model.row_width + 13.92e-3)
    assert model.contact_stiffness == 2 * dw.build(spec()).contact_stiffness


@pytest.mark.property
def test_rows_of_a_silent_chain_share_the_force():
    tables = {
        "mechanism": "silent-chain",
        "pitch": "9.525 mm",
        "links": 82,
        "teeth": [35, 37],
        "joint": {"rolling_radius": "1.2 mm"},
        "plate": {"apothem": "2.6 mm"},
        "contact": {"force": "200 N"},
    }
    one = dw.run(from_document(tables), only="contact")
    two = dw.run(from_document({**tables, "rows": 2}), only="contact")
    assert two["pin.contact_pressure"] == pytest.approx(one["pin.contact_pressure"] / np.sqrt(2), rel=1e-12)
    single, double = dw.build(from_document(tables)), dw.build(from_document({**tables, "rows": 2, "row_pitch": "8 mm"}))
    assert double.link_mass.mass == pytest.approx(2 * single.link_mass.mass) and double.chain_width == pytest.approx(14e-3)
    assert dw.build(from_document({**tables, "rows": 3})).chain_width == pytest.approx(3 * single.chain_width)


@pytest.mark.error
@pytest.mark.parametrize(
    ("changes", "key", "words"),
    [
        (("chain=07B",), "chain", "did you mean 06B"),
        (("chain=60H",), "chain", "heavy-series"),
        (("chain=",), "pitch", 'is missing; give it, or the number of a roller chain, e.g. chain = "08B"'),
        (('joint.kind="round-pin"', 'joint.rolling_radius="1 mm"'), "joint.kind", "a roller chain has revolute joints"),
        (("chain=", 'pitch="12 mm"', 'joint.kind="revolute"', "roller.tooth_space=0.5"), "roller.diameter", "is missing"),
    ],
)
def test_refusals_name_the_key(changes, key, words):
    with pytest.raises(SpecError) as refused:
        dw.build(spec(*changes))
    assert refused.value.key == key and words in str(refused.value)


def test_the_template_and_the_schema_know_it():
    text = template("silent-chain", "roller")
    assert "#chain = " in text and "\npitch = " in text and "number of a roller chain" in text
    assert set(schema("silent-chain")["required"]) >= {"links", "teeth"} and "pitch" not in schema("silent-chain")["required"]
