"""What a shaft refuses, in which words; and what it computes with a failed check instead."""

import copy
import re

import numpy as np
import pytest

import drivewright as dw
from drivewright.errors import InputError, SpecError

pytestmark = pytest.mark.error

BASE = {
    "segments": [{"length": "340 mm", "diameter": "20 mm"}],
    "bearings": [
        {"name": "A", "position": "56.5 mm", "radial_stiffness": "3e7 N/m"},
        {"name": "B", "position": "136.5 mm", "radial_stiffness": "3e7 N/m"},
    ],
    "stations": [{"name": "m1", "position": "0 mm", "mass": "3 kg"}, {"name": "m2", "position": "245 mm", "mass": "8 kg"}],
    "loads": [{"station": "m2", "force": "500 N"}],
}
BALLS = {"balls": 12, "ball_diameter": "3.572 mm", "pitch_diameter": "26 mm"}


def changed(path, value):
    """BASE with one key replaced, by a dotted path; None removes it."""
    tables = copy.deepcopy(BASE)
    *steps, last = (int(step) if step.isdigit() else step for step in path.split("."))
    place = tables
    for step in steps:
        place = place.setdefault(step, {}) if isinstance(place, dict) else place[step]
    if value is None:
        del place[last]
    else:
        place[last] = value
    return tables


REFUSED = [
    ("segments.0.diameter", "0 mm", "segments.0.diameter", "must be"),
    ("segments.0.diameter", "-20 mm", "segments.0.diameter", "must be"),
    ("segments.0.length", "0 mm", "segments.0.length", "must be"),
    ("segments.0.length", "340", "segments.0.length", "unit missing"),
    ("segments.0.length", "nan mm", "segments.0.length", "not finite"),
    ("segments.0.bore", "20 mm", "segments.0.bore", "not below the diameter of the shaft"),
    ("segments.0.bore", "-1 mm", "segments.0.bore", "must be at least 0"),
    ("segments.0.end_diameter", "0 mm", "segments.0.end_diameter", "must be"),
    ("material.youngs_modulus", "0 GPa", "material.youngs_modulus", "must be"),
    ("material.youngs_modulus", "206 kg", "material.youngs_modulus", "pressure"),
    ("material.poisson_ratio", 0.5, "material.poisson_ratio", "less than 0.5"),
    ("material.poisson_ratio", -1.0, "material.poisson_ratio", "greater than -1"),
    ("material.poisson_ratio", float("nan"), "material.poisson_ratio", "finite"),
    ("bearings.0.position", "400 mm", "bearings.A.position", "outside the shaft, which runs from 0 to 340 mm"),
    ("stations.0.position", "-5 mm", "stations.m1.position", "outside the shaft"),
    ("bearings.0.radial_stiffness", "0 N/m", "bearings.0.radial_stiffness", "above 0"),
    ("bearings.0.radial_stiffness", "-3e7 N/m", "bearings.0.radial_stiffness", "above 0"),
    ("bearings.0.radial_stiffness", "stiff", "bearings.0.radial_stiffness", "stiffness"),
    ("bearings.0.radial_stiffness", "3e7 N", "bearings.0.radial_stiffness", "force"),
    ("bearings.0.radial_stiffness", None, "bearings.A", "has no stiffness"),
    ("bearings.0.geometry", BALLS, "bearings.A", "has radial_stiffness and geometry"),
    ("bearings.0.tilt_stiffness", "0 N m/rad", "bearings.0.tilt_stiffness", "must be"),
    ("bearings.1.position", "56.5 mm", "bearings.B.position", "the position of 'A'"),
    ("bearings.1.name", "A", "bearings.1.name", "occurs twice"),
    ("bearings.0.preload", "10 N", "bearings.A.preload", "rolling bearing"),
    ("bearings.0.free", ["tilt"], "bearings.A.free", "rolling bearing"),
    ("bearings.0.radial_clearance", "-1 um", "bearings.A.radial_clearance", "clearance above 0"),
    ("bearings.0.width", "200 mm", "bearings.A.width", "overhangs the end of the shaft"),
    ("stations.1.name", "m1", "stations.1.name", "occurs twice"),
    ("stations.1.position", "0 mm", "stations.m2.position", "different positions"),
    ("stations.0.mass", "-1 kg", "stations.0.mass", "must be at least 0"),
    ("loads.0.station", "m3", "loads.0.station", "there is no station 'm3'; known: m1, m2"),
    ("loads.0.position", "10 mm", "loads.0", "either station or position"),
    ("loads.0.force", "500", "loads.0.force", "unit missing"),
    ("analysis.shear_coefficient", 0.0, "analysis.shear_coefficient", "above 0"),
    ("analysis.shear_coefficient", "cooper", "analysis.shear_coefficient", "cowper"),
    ("analysis.theory", "timoschenko", "analysis.theory", "timoshenko"),
    ("line_loads", [{"start": "20 mm", "end": "10 mm", "force": "1 N/mm"}], "line_loads.0.end", "not right of its start"),
]


@pytest.mark.parametrize("path, value, key, words", REFUSED, ids=[f"{path}={value}"[:50] for path, value, *_ in REFUSED])
def test_nonsense_is_refused_by_name(path, value, key, words):
    with pytest.raises(SpecError) as caught:
        dw.build(dw.Shaft(**changed(path, value)))
    assert key in str(caught.value) and words in str(caught.value)


def test_one_bearing_is_a_mechanism_unless_it_resists_tilting():
    tables = changed("bearings", BASE["bearings"][:1])
    with pytest.raises(InputError, match="'A'.* leave it free to swing: a mechanism, not a beam.*tilt_stiffness"):
        dw.run(dw.Shaft(**tables))
    tables["bearings"] = [{**BASE["bearings"][0], "tilt_stiffness": "2e4 N m/rad"}]
    assert dw.run(dw.Shaft(**tables))["stations.m2.deflection"] > 0


def test_a_bearing_of_the_catalogue_has_its_nearest_name():
    with pytest.raises(SpecError, match=r"bearings\.A\.bearing.*did you mean .*6180\d"):
        dw.build(dw.Shaft(**changed("bearings.0", {"name": "A", "position": "56.5 mm", "bearing": "6180"})))


def test_an_inner_geometry_that_cannot_be_is_refused_under_its_key():
    with pytest.raises(SpecError, match=r"bearings\.0\.geometry.*balls"):
        dw.Shaft(**changed("bearings.0", {"name": "A", "position": "56.5 mm", "geometry": BALLS | {"balls": 30}}))
    with pytest.raises(SpecError, match=r"bearings\.0\.geometry\.inner_conformity.*greater than 0.5"):
        dw.Shaft(**changed("bearings.0", {"name": "A", "position": "56.5 mm", "geometry": BALLS | {"inner_conformity": 0.5}}))


def has_no_statics(spec, words):
    """No equilibrium, and so no numbers that rest on one; what needs none is there, and the outcome says so."""
    result = dw.run(spec)
    assert any(re.search(words, finding) for finding in result.findings if "analysis 'statics'" in finding)
    assert result.outcome == "partial" and not any(name.startswith(("bearings.", "max_")) for name in result.values)


def test_an_axial_force_that_nothing_takes():
    has_no_statics(
        dw.Shaft(**changed("loads.0.axial_force", "200 N")), "an axial force of 200 N, and no bearing that takes a force to the right"
    )


def test_torques_that_do_not_balance():
    has_no_statics(dw.Shaft(**changed("loads.0.torque", "5 N m")), "the torques do not balance: their sum is 5 N·m")


def test_a_station_on_a_rigid_bearing_has_flexibility_but_no_stiffness():
    tables = changed("bearings.0.radial_stiffness", "rigid")
    tables["stations"][0]["position"] = "56.5 mm"
    result = dw.run(dw.Shaft(**tables))
    assert "stiffness" not in result.arrays and abs(result.arrays["flexibility"].values[0, 0]) < 1e-18
    assert any("'m1' stands on a rigid bearing" in finding for finding in result.findings)


def test_a_slip_of_units_fails_a_check_and_is_computed():
    tables = changed("segments.0.length", "340 m")
    result = dw.run(dw.Shaft(**tables))
    assert not result.check("slenderness").ok and np.isfinite(result["stations.m2.deflection"])
    tables = changed("segments.0.diameter", "20 m")
    assert not dw.run(dw.Shaft(**tables)).check("stockiness").ok


def test_an_overload_fails_checks_and_is_computed():
    tables = changed("loads.0.force", "6 kN")
    tables["material"] = {"yield_strength": "355 MPa"}
    tables["bearings"][1] = {"name": "B", "position": "136.5 mm", "bearing": "61804"}
    result = dw.run(dw.Shaft(**tables))
    assert not result.check("yield_safety").ok and not result.check("static_safety.B").ok
    assert result["bearings.B.reaction"] == pytest.approx(6000 * 2.35625, rel=0.15)  # its tilt stiffness takes a part


def test_more_modes_than_there_are_is_no_error():
    assert "modes.20.frequency" in dw.run(dw.Shaft(**changed("analysis.modes", 20))).values


def test_play_without_load_has_no_stiffness_and_says_so():
    tables = changed("loads", [])
    for bearing in tables["bearings"]:
        bearing["radial_clearance"] = "20 um"
    result = dw.run(dw.Shaft(**tables))
    assert "flexibility" not in result.arrays and "modes.1.frequency" not in result.values
    assert any("give a load, a preload or no clearance" in finding for finding in result.findings)


def test_a_bearing_table_that_does_not_rise(tmp_path):
    (tmp_path / "k.csv").write_text("displacement [um],force [N]\n0,0\n10,100\n20,90\n")
    tables = changed("bearings.0", {"name": "A", "position": "56.5 mm", "table": str(tmp_path / "k.csv")})
    with pytest.raises(InputError, match="rise from row to row"):
        dw.build(dw.Shaft(**tables))


@pytest.mark.parametrize("force", ["1 mN", "1 N", "10 N", "1 kN"])
@pytest.mark.parametrize("free", [[], ["axial"], ["axial", "tilt"]])
def test_light_loads_in_a_clearance_are_computed_or_left_out_with_a_reason(force, free):
    tables = changed("loads.0.force", force)
    tables["bearings"] = [
        {"name": n, "position": z, "bearing": "61804", "radial_clearance": "12 um", "free": free}
        for n, z in (("A", "56.5 mm"), ("B", "136.5 mm"))
    ]
    result = dw.run(dw.Shaft(**tables))
    assert result["bearings.B.reaction"] == pytest.approx(
        2.35625 * float(force.split()[0]) * {"mN": 1e-3, "N": 1, "kN": 1e3}[force.split()[1]], rel=0.05
    )
    assert "flexibility" in result.arrays or any("do not resist" in finding for finding in result.findings)


def test_one_rolling_bearing_alone_holds_a_shaft_by_its_tilting_stiffness():
    tables = changed("bearings", [{"name": "A", "position": "56.5 mm", "bearing": "61804"}])
    tables["loads"][0] |= {"station": "m1", "force": "20 N"}
    result = dw.run(dw.Shaft(**tables))
    assert result["bearings.A.moment"] == pytest.approx(20 * 0.0565, rel=1e-6) and "flexibility" in result.arrays


def test_tapered_bearings_that_both_push_the_same_way():
    tables = copy.deepcopy(BASE)
    tables["bearings"] = [
        {"name": n, "position": z, "bearing": "hypothetical-TRB-20x32x7", "carries": "right"}
        for n, z in (("A", "56.5 mm"), ("B", "136.5 mm"))
    ]
    has_no_statics(dw.Shaft(**tables), "push it to the left, and none of them takes an axial force to the left.*carries")
