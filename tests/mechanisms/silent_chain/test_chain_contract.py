"""What a spec of a chain drive promises: names of values, tables and checks, units, absent values, words of refusals and findings."""

import tomllib
from pathlib import Path

import numpy as np
import pytest

import drivewright as dw
from drivewright.errors import DrivewrightError
from drivewright.spec import from_document
from drivewright.spec.parsing import change_key

pytestmark = pytest.mark.interface

MM = 1e-3
SPEC = """
mechanism = "silent-chain"
pitch = "9.525 mm"
links = 82
teeth = [35, 37]
[joint]
kind = "round-pin"
rolling_radius = "1.2 mm"
offset = "match-drive"
[plate]
flank_angle = "30 deg"
apothem = "2.6 mm"
thickness = "2 mm"
[cutter]
half_angle = "30 deg"
[drive]
speed = "2000 rpm"
preload = "150 N"
"""
SIDED = ("seated_pitch", "ideal_pitch", "pitch_deviation", "seated_apothem", "modification", "positioning_diameter", "contact_radius")
MESHING = (
    "hole_pitch",
    "pin_offset",
    "pitch_deviation.reference",
    "k",
    "rolling_radius.boundary",
    "rolling_radius.monotone_limit",
    "standard_apothem",
    *(f"{name}.{side}" for name in SIDED for side in ("drive", "driven")),
)
PRESETS = Path(dw.__file__).parent / "mechanisms/silent_chain/presets"


def spec(*changes):
    tables = tomllib.loads(SPEC)
    for change in changes:
        change_key(tables, change)
    return from_document(tables)


def run(only, *changes):
    return dw.run(spec(*changes), only=only)


def test_meshing_of_group_three():
    found = run("meshing")
    assert set(MESHING) <= set(found.values)
    expected = {
        "hole_pitch": 11.925 * MM,
        "pin_offset": 0.267776183764 * MM,
        "seated_pitch.driven": 9.5619049365922 * MM,
        "pitch_deviation.driven": 2.4669517247e-6,
        "pitch_deviation.reference": 4.0618538598e-6,
        "k": 11.46484882912,
        "rolling_radius.boundary": 5.054799380642 * MM,
        "rolling_radius.monotone_limit": 4.78174992 * MM,
        "standard_apothem": 3.773118576423 * MM,
        "seated_apothem.drive": 3.756447657234 * MM,
        "modification.drive": -1.105074529736,
        "positioning_diameter.drive": 106.6886832989 * MM,
        "positioning_diameter.driven": 112.750435724 * MM,
        "contact_radius.drive": 49.59688789127 * MM,
        "ideal_pitch.drive": 9.563499838727 * MM,
        "ideal_pitch.driven": 9.559437984867 * MM,
    }
    for name, value in expected.items():
        assert found[name] == pytest.approx(value, rel=2e-10), name
    assert abs(found["pitch_deviation.drive"]) < 1e-17
    assert found.values["pitch_deviation.driven"].unit == "m" and found.values["k"].unit == "-"


def test_offsets_and_readings():
    assert run("meshing", 'joint.offset="minimax"')["pin_offset"] == pytest.approx(0.260732346 * MM, rel=1e-8)
    given = run("meshing", 'joint.offset="0.6 mm"')
    assert given["pin_offset"] == pytest.approx(0.6 * MM)
    assert given["modification.drive"] == pytest.approx(-1.105074529736, rel=1e-11)
    rack = run("meshing", 'meshing.ideal="rack"')["ideal_pitch.drive"]
    assert rack == pytest.approx(9.525 * MM * np.tan(np.pi / 35) / (np.pi / 35), rel=1e-13)
    other = run("meshing", 'meshing.apothem_reference="pin"')
    assert run("meshing")["standard_apothem"] - other["standard_apothem"] == pytest.approx(other["pin_offset"] * 0.5, rel=1e-9)
    assert any("off the flanks of the plates" in finding for finding in other.findings)


@pytest.mark.parametrize(("angle", "x1", "x2"), [(25, -0.475936, -0.4206063388), (20, 0.114870, 0.227164), (31.5, -1.305890, -1.317714)])
def test_other_cutters(angle, x1, x2):
    found = run("meshing", f'cutter.half_angle="{angle} deg"')
    assert found["modification.drive"] == pytest.approx(x1, abs=6e-7)
    assert found["modification.driven"] == pytest.approx(x2, abs=6e-7)
    assert found["contact_radius.drive"] == pytest.approx(49.59688789127 * MM, rel=1e-12)


def test_the_flank_may_be_given_from_the_pitch_line():
    found = run("meshing", "plate.apothem=", 'plate.standard_apothem="3.773118576423235 mm"')
    assert found["modification.drive"] == pytest.approx(-1.105074529736, rel=1e-10)


STRAIGHT = {1.0: (219.056560, 1.26), 1.2: (219.057069, 1.59), 1.6: (219.058086, 2.24)}
BENT = {1.0: (219.056810, 1.05), 1.2: (219.057426, 1.29), 1.6: (219.058711, 1.70)}


@pytest.mark.parametrize(("strands", "table"), [("straight", STRAIGHT), ("equilibrium", BENT)])
def test_closure(strands, table):
    for radius, (mean, fluctuation) in table.items():
        found = run("closure", f'joint.rolling_radius="{radius} mm"', f'closure.strands="{strands}"')
        assert found["centre_distance.mean"] == pytest.approx(mean * MM, abs=1.5e-9)
        assert found["centre_distance.fluctuation"] == pytest.approx(fluctuation * 1e-6, rel=0.015)
    rise = {"straight": 0.213993, "equilibrium": 0.214065}[strands]
    found = run("closure", f'closure.strands="{strands}"')
    assert found["chordal_rise.drive"] == pytest.approx(rise * MM, abs=6e-10)
    assert found["transmission_error"] == pytest.approx({"straight": 73e-6, "equilibrium": 62e-6}[strands], rel=0.015)
    table = found.tables["centre_distance"]
    assert np.ptp(table["centre_distance"].data) <= found["centre_distance.fluctuation"] * (1 + 1e-9)
    assert found.ok


@pytest.mark.parametrize(("kind", "mean", "fluctuation"), [("arc", 219.07283, 11.7), ("revolute", 219.054018, 0.505)])
def test_other_joints(kind, mean, fluctuation):
    found = run("closure", f'joint.kind="{kind}"', 'joint.rolling_radius="7.4 mm"', 'closure.strands="straight"')
    assert found["centre_distance.mean"] == pytest.approx(mean * MM, abs=5e-9)
    assert found["centre_distance.fluctuation"] == pytest.approx(fluctuation * 1e-6, rel=0.015)


def test_the_offset_changes_nothing_physical():
    results = [run(("geometry", "closure", "contact"), f'joint.offset="{e} mm"') for e in (-0.3, 0.0, 0.6)]
    for name, value in results[0].values.items():
        for other in results[1:]:
            assert other[name] == pytest.approx(value.value, rel=1e-12, abs=1e-15), name  # least gaps are differences of lengths


def test_pressure_of_the_pins_under_200_newtons():
    for radius, kind, pressure, width, shear in ((1.2, "round-pin", 1414.77, 0.0150, 424), (7.4, "arc", 569.72, 0.0372, 171)):
        found = run("contact", 'contact.force="200 N"', f'joint.kind="{kind}"', f'joint.rolling_radius="{radius} mm"')
        assert found["pin.contact_pressure"] == pytest.approx(pressure * 1e6, rel=1e-5)
        assert found["pin.half_width"] == pytest.approx(width * MM, rel=4e-3)
        assert found["pin.max_shear"] == pytest.approx(shear * 1e6, rel=3e-3)


def test_the_force_of_the_pins_unless_given():
    found = run("contact", 'plate.link_mass="2.5 g"')
    v = 2000 * np.pi / 30 * 35 * 9.525 * MM / (2 * np.pi)
    along = 75 / np.cos(np.arcsin((37 - 35) * 9.525 * MM / (2 * np.pi) / 219.054 / MM))  # strands lean against the line of centres
    assert found["pin.force"] == pytest.approx(along + 2.5e-3 / (9.525 * MM) * v**2, rel=1e-6)
    loaded = run("contact", 'drive.load_torque="3 N m"')
    pull = 3 * 2 * np.pi / (37 * 9.525 * MM)
    assert loaded["strand.tight_force"] - loaded["strand.slack_force"] == pytest.approx(pull, rel=1e-12)
    assert loaded["strand.tight_force"] + loaded["strand.slack_force"] == pytest.approx(2 * along, rel=1e-6)
    uneven = run("contact", "teeth=[20, 100]", "links=110", 'contact.force="100 N"')
    assert uneven["strand.tight_force"] == pytest.approx(94.29, abs=0.05)  # that of the elastic chain at rest
    assert not run("contact", 'drive.load_torque="30 N m"').check("strand.taut").ok


DYNAMICS = (
    "dynamics.centre_distance.mean",
    "dynamics.centre_distance.fluctuation",
    "dynamics.centre_distance.mesh_order_amplitude",
    "dynamics.energy_drift",
)


def test_dynamics():
    found = run("dynamics")
    assert set(DYNAMICS) <= set(found.values)
    assert found["dynamics.energy_drift"] < 1e-3
    rigid = 219.057426 * MM
    compliance = 23 * 3 * 75 / 1e8  # joints of a strand, three contacts each
    assert rigid < found["dynamics.centre_distance.mean"] < rigid + 1.2 * compliance
    assert found["dynamics.mesh_frequency"] == pytest.approx(2000 / 60 * 35, rel=1e-12)
    table = found.tables["running"]
    assert len(table["time"].data) > 20 * 82
    assert np.all(np.diff(table["time"].data) <= 1 / found["dynamics.mesh_frequency"] / 20 * (1 + 1e-9))


def test_dynamics_of_the_other_joints():
    """The contract's own spec with a hinge; the classical arcs of the preset."""
    hinge = run("dynamics", 'joint.kind="revolute"')
    assert set(DYNAMICS) <= set(hinge.values), hinge.findings
    assert 219.054018 * MM < hinge["dynamics.centre_distance.mean"] < 219.13 * MM
    classical = dw.run(dw.load(PRESETS / "classical.toml"), only=("dynamics",))
    assert 219.084 * MM < classical["dynamics.centre_distance.mean"] < 219.19 * MM


def test_a_run_that_left_its_teeth_shows_no_statistics():
    lost = run("dynamics", 'drive.preload="500 kN"')
    assert lost.outcome == "partial" and not lost.check("running.centre_distance").ok
    assert "dynamics.centre_distance.mean" not in lost.values
    assert any("slack strand" in finding for finding in lost.findings)


def test_equal_teeth_and_more_teeth_on_the_drive():
    equal = run(("meshing", "closure"), "teeth=[36, 36]", "links=83", 'closure.strands="straight"', 'joint.rolling_radius="1.0 mm"')
    assert equal["pitch_deviation.reference"] == 0
    assert equal["rolling_radius.boundary"] == pytest.approx(9.525 * MM / (2 * np.cos(np.pi / 36)), rel=1e-12)
    assert equal["centre_distance.fluctuation"] == pytest.approx(1.01e-6, rel=0.01)
    more = run(("meshing", "closure"), "teeth=[37, 35]")
    assert more["pitch_deviation.reference"] == pytest.approx(-4.0618538598e-6, rel=1e-9)
    assert any("articulation angle is larger on the driven sprocket" in finding for finding in more.findings)


def test_findings_and_failed_checks():
    odd = run("layout", "links=83")
    assert any("odd number of links" in finding for finding in odd.findings)
    assert not run("layout", "teeth=[7, 37]", "links=60").check("teeth.drive").ok
    few = run("geometry", "teeth=[9, 37]", "links=60")
    assert not few.ok
    steep = run("meshing", 'joint.offset="1.5 mm"')
    assert not steep.check("offset").ok
    big = run("contact", 'contact.force="900 N"')
    assert not big.check("pin.shakedown").ok
    walls = run("geometry", 'joint.rolling_radius="1.8 mm"', 'limits.wall="0.6 mm"')
    assert not walls.check("wall.hole_to_outline").ok
    assert not run("geometry", 'joint.rolling_radius="3 mm"').check("geometry.plate").ok
    assert not run("closure", "links=38").check("sprockets.apart").ok
    unlike = run("meshing", 'cutter.pitch="9.9 mm"')
    assert any("base pitch" in finding for finding in unlike.findings)
    apart = run("closure", "teeth=[12, 90]", "links=100")
    assert not apart.check("wrap.drive").ok


REFUSED = [
    (["teeth=[3, 37]"], "teeth"),
    (["links=30"], "links"),
    (['joint.rolling_radius="0 mm"'], "rolling_radius"),
    (["joint.rolling_radius="], "rolling_radius"),
    (['plate.flank_angle="50 deg"'], "flank_angle"),
    (["plate.apothem="], "apothem"),
    (['plate.standard_apothem="3 mm"'], "apothem"),
    (['drive.preload="0 N"'], "preload"),
    (['drive.speed="-5 rpm"'], "speed"),
    (['pitch="9.525"'], "pitch"),
    (['roller.diameter="6 mm"'], "kind"),
    (["plate.lacing=[0, 2]"], "lacing"),
    (["teeth=[35.5, 37]"], "teeth"),
    (['joint.offset="best"'], "offset"),
    (['plate.link_mass="-1 g"'], "link_mass"),
]


@pytest.mark.parametrize(("changes", "word"), REFUSED)
def test_refused(changes, word):
    with pytest.raises(DrivewrightError, match=word):
        run("meshing", *changes)


def test_impossible_runs_say_why():
    for words, *asked in (
        ("stable", "dynamics", 'dynamics.step="20 us"'),
        ("implicit", "dynamics", 'contact.damping="20 N s/mm"', 'dynamics.step="1 us"'),
        ("61 links around 6 and 60 teeth", "closure", "teeth=[6, 60]", "links=61"),
    ):
        found = run(*asked)
        assert found.outcome == "partial" and any(f"analysis '{asked[0]}'" in f and words in f for f in found.findings)
    left_out = run("dynamics", "drive=")
    assert any("add [drive]" in f for f in left_out.findings)


def test_every_preset_builds_and_closes():
    for path in PRESETS.glob("*.toml"):
        found = dw.run(dw.load(path), only=("closure", "contact"))
        assert found["centre_distance.fluctuation"] > 0, path.name


def test_scene_drawings_and_parts():
    from drivewright import registry

    kind = registry.mechanism("silent-chain")
    for preset in ("default", "roller"):
        model = dw.build(dw.load(PRESETS / f"{preset}.toml"))
        scene = kind.scene(model)
        assert len(scene.bodies) == model.spec.links + 2
        link = next(body for body in scene.bodies if body.name == "link10")
        after = next(body for body in scene.bodies if body.name == "link12")
        assert np.allclose(link.poses[-1, :2], after.poses[0, :2], atol=1e-9)
        assert len(kind.drawings(model)) == 3
        assert len(tuple(kind.parts(model))) == 6
