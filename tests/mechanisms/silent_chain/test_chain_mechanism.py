"""Analyses of the chain drive against each other: comparisons, the chain at rest and running, stress, life."""

import tomllib
from pathlib import Path

import numpy as np
import pytest

import drivewright as dw
from drivewright.chains.closure import Drive, close
from drivewright.chains.link import design_link
from drivewright.spec import from_document
from drivewright.spec.parsing import change_key

pytestmark = pytest.mark.property

MM = 1e-3
PRESET = (Path(dw.__file__).parent / "mechanisms/silent_chain/presets/default.toml").read_text()


def run(only, *changes):
    tables = tomllib.loads(PRESET)
    for change in changes:
        change_key(tables, change)
    return dw.run(from_document(tables), only=only)


def test_trade_off_is_the_closure_of_each_radius():
    found = run("trade_off", 'compare.rolling_radii=["1.6 mm", "1.0 mm", "0 mm"]', 'contact.force="200 N"')
    table = found.tables["trade_off"]
    assert table["rolling_radius"].data == pytest.approx([1.0 * MM, 1.6 * MM])
    for row, r in enumerate((1.0, 1.6)):
        own = run(("closure", "contact", "meshing"), f'joint.rolling_radius="{r} mm"', 'contact.force="200 N"')
        assert table["fluctuation"].data[row] == pytest.approx(own["centre_distance.fluctuation"], rel=2e-3)
        assert table["mean"].data[row] == pytest.approx(own["centre_distance.mean"], abs=1e-11)
        assert table["contact_pressure"].data[row] == pytest.approx(own["pin.contact_pressure"], rel=1e-12)
        assert table["pitch_deviation_driven"].data[row] == pytest.approx(own["pitch_deviation.driven"], rel=1e-12)
        assert table["pin_offset"].data[row] == pytest.approx(own["pin_offset"], rel=1e-12)
    assert table["running_deviation"].data[0] == pytest.approx(219.056810 * MM - 219.0540176 * MM, abs=2e-9)


def test_phase_map_counts_links_and_teeth():
    found = run("phase_map", "compare.links=[82, 83]", 'compare.rolling_radii=["1.2 mm"]', "compare.driven_teeth=[36, 37]")
    table = found.tables["phase_map"]
    for links, teeth, fluctuation in zip(*(table[n].data for n in ("links", "driven_teeth", "fluctuation")), strict=True):
        own = close(Drive(design_link(9.525 * MM, 1.2 * MM, np.pi / 6, 0.0), 35, int(teeth), int(links)))
        assert fluctuation == pytest.approx(own.fluctuation, rel=5e-3)
    assert found["phase_map.least_fluctuation"] == pytest.approx(np.min(table["fluctuation"].data), rel=1e-12)
    apart = run("phase_map", "compare.links=[38, 82]", 'compare.rolling_radii=["1.2 mm"]', "compare.driven_teeth=[110]")
    assert any("do not close" in finding for finding in apart.findings)


@pytest.mark.parametrize("radius", (1.0, 1.6))
def test_stiffness_taken_to_infinity_leads_to_the_rigid_closure(radius):
    found = run(("quasi_static", "closure"), f'joint.rolling_radius="{radius} mm"', 'contact.stiffness="1e6 N/mm"')
    assert found["quasi_static.centre_distance.rigid"] == pytest.approx(found["centre_distance.mean"], abs=1e-7)
    added = found["quasi_static.centre_distance.mean"] - found["quasi_static.centre_distance.rigid"]
    joints = 23 * 3 * 75 / 1e9  # of a strand, three contacts each, 75 N
    assert joints < added < 1.6 * joints  # the teeth yield too


def test_thick_teeth_and_a_longer_chain_move_the_sprocket_as_they_should():
    plain = run("quasi_static", 'contact.stiffness="1e6 N/mm"')["quasi_static.centre_distance.mean"]
    thick = run("quasi_static", 'contact.stiffness="1e6 N/mm"', 'dynamics.thickness_deviation="20 um"')["quasi_static.centre_distance.mean"]
    assert -650e-6 < thick - plain < -400e-6
    longer = run("quasi_static", 'contact.stiffness="1e6 N/mm"', "closure.elongation=1e-4")["quasi_static.centre_distance.mean"]
    assert longer > plain + 10e-6


def test_runs_keep_their_balance_and_tension():
    found = run(("dynamics", "contact"), 'dynamics.settling="20 ms"', 'dynamics.duration="20 ms"')
    assert found.check("energy_drift").ok and found.outcome == "complete"
    assert 0.6 < found["dynamics.tension.mean"] / found["pin.force"] < 1.0  # seated plates leave a part of it to the teeth


@pytest.mark.slow
@pytest.mark.needs_fe
def test_stress_and_life_of_a_plate():
    short = ('dynamics.settling="5 ms"', "fatigue.fineness=0.6")
    found = run("life", *short)
    history = found.tables["plate_history"]
    assert np.max(history["mises"].data) == pytest.approx(found["plate.max_von_mises"], rel=1e-9)
    assert found["plate.max_von_mises.y"] < -1e-3  # in the crotch
    assert found["plate.life"] > 1e6
    assert any("estimated" in finding for finding in found.findings)
    worse = run("life", *short, 'fatigue.plane="max-damage"')
    assert worse["plate.life"] < found["plate.life"]


@pytest.mark.needs_fe
def test_life_needs_a_whole_revolution():
    found = run("life", 'dynamics.settling="5 ms"', 'dynamics.duration="30 ms"', "fatigue.fineness=0.4")
    assert "plate.life" not in found.values
    assert any("shorter than a revolution" in finding for finding in found.findings)


def test_what_cannot_be_drawn_stops_only_what_needs_it():
    found = run((), 'cutter.tip_depth="-1 mm"')
    assert not found.check("geometry.sprockets").ok
    assert "dynamics.centre_distance.mean" not in found.values and "centre_distance.mean" in found.values
    assert any("analysis 'dynamics' is left out" in finding for finding in found.findings)


@pytest.mark.slow
def test_the_speeds_of_the_campbell_diagram_are_runs_of_their_own():
    found = run("speeds", 'compare.speeds=["1000 rpm", "2000 rpm"]')
    table = found.tables["speeds"]
    for row, speed in enumerate(("1000", "2000")):
        own = run("dynamics", f'drive.speed="{speed} rpm"')
        assert table["mean"].data[row] == pytest.approx(own["dynamics.centre_distance.mean"], abs=1e-5)
        assert table["tension"].data[row] < 3 * own["dynamics.tension.maximum"]


def test_a_fatigue_card_may_be_given():
    card = (
        'fatigue.card.youngs_modulus="206 GPa"',
        'fatigue.card.fatigue_strength="1470 MPa"',
        "fatigue.card.fatigue_strength_exponent=-0.087",
        "fatigue.card.fatigue_ductility=0.46",
        "fatigue.card.fatigue_ductility_exponent=-0.58",
    )
    tables = tomllib.loads(PRESET)
    for change in card:
        change_key(tables, change)
    spec = from_document(tables)
    assert spec.fatigue.card.fatigue_strength == pytest.approx(1470e6)
    assert not spec.fatigue.card.estimated
