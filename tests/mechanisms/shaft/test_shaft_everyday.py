"""What a machine designer asks of a shaft every day: bearings by designation, lives, gears, strength, whirl, unbalance."""

import copy

import numpy as np
import pytest
from places import EXAMPLES

import drivewright as dw
from drivewright.errors import InputError, SpecError

GEARBOX = {
    "material": {"card": "42CrMo4"},
    "segments": [
        {"length": "40 mm", "diameter": "30 mm", "fillet_radius": "1 mm"},
        {"length": "120 mm", "diameter": "38 mm"},
        {"length": "40 mm", "diameter": "30 mm"},
    ],
    "bearings": [
        {"name": "A", "position": "20 mm", "bearing": "6306"},
        {"name": "B", "position": "180 mm", "bearing": "6306", "free": ["axial"]},
    ],
    "gears": [
        {
            "name": "wheel",
            "position": "65 mm",
            "pitch_diameter": "150 mm",
            "torque": "160 N m",
            "mesh_angle": "180 deg",
            "helix_angle": "12 deg",
            "face_width": "30 mm",
        },
        {"name": "pinion", "position": "130 mm", "pitch_diameter": "50 mm", "torque": "-160 N m", "mesh_angle": "-60 deg"},
    ],
    "drive": {"speed": "970 rpm"},
}
ROTOR = {
    "material": {"youngs_modulus": "211 GPa", "density": "7810 kg/m^3"},
    "segments": [{"length": "1.5 m", "diameter": "50 mm"}],
    "bearings": [
        {"name": name, "position": place, "radial_stiffness": "1e6 N/m", "radial_damping": "100 N s/m"}
        for name, place in (("A", "0 m"), ("B", "1.5 m"))
    ],
    "stations": [
        {"name": "d1", "position": "0.5 m", "mass": "32 kg", "polar_inertia": "0.33 kg m^2", "diametral_inertia": "0.18 kg m^2"},
        {"name": "d2", "position": "1 m", "mass": "51 kg", "polar_inertia": "0.8 kg m^2", "diametral_inertia": "0.42 kg m^2"},
    ],
    "drive": {"speed": "4000 rpm"},
}


def shaft(tables=GEARBOX, **changes):
    return dw.Shaft(**(copy.deepcopy(tables) | changes))


def changed(tables, table, number, **keys):
    """The tables with keys of one entry of a list changed; a key that is None is taken away."""
    whole = copy.deepcopy(tables)
    whole[table][number] = {key: value for key, value in (whole[table][number] | keys).items() if value is not None}
    return whole


@pytest.fixture(scope="module")
def gearbox():
    return dw.run(shaft())


@pytest.fixture(scope="module")
def rotor():
    return dw.run(shaft(ROTOR))


# -- bearings ------------------------------------------------------------------------------------------------------------------


@pytest.mark.interface
def test_a_bearing_by_its_designation_is_estimated_and_says_so(gearbox):
    told = [finding for finding in gearbox.findings if "'A'" in finding and "6306" in finding]
    assert any("estimated" in finding for finding in told)
    assert gearbox["bearings.A.dynamic_rating"] == pytest.approx(29600, rel=0.1)
    assert gearbox["bearings.A.static_rating"] == pytest.approx(16000, rel=0.1)
    given = dw.run(shaft(changed(GEARBOX, "bearings", 0, dynamic_rating="29.6 kN", static_rating="16 kN")), only=("rolling",))
    assert given["bearings.A.dynamic_rating"] == 29600
    assert not any("C = " in finding and "'A'" in finding for finding in given.findings)


@pytest.mark.analytical
def test_lives_of_a_bearing_fit_together(gearbox):
    """L10 = 1e6 (C/P)^3 revolutions, hours at speed; the modified life is a_ISO of the reference life."""
    turns = 970 / 60
    for name in "AB":
        key = f"bearings.{name}"
        basic = 1e6 * (gearbox[f"{key}.dynamic_rating"] / gearbox[f"{key}.equivalent_load"]) ** 3
        assert gearbox[f"{key}.basic_life"] == pytest.approx(basic, rel=1e-9)
        for kind in ("basic_life", "reference_life", "modified_life"):
            assert gearbox[f"{key}.{kind}.time"] == pytest.approx(gearbox[f"{key}.{kind}"] / turns, rel=1e-9)
        assert gearbox[f"{key}.modified_life"] == pytest.approx(gearbox[f"{key}.a_iso"] * gearbox[f"{key}.reference_life"], rel=1e-9)
    singles = [gearbox[f"bearings.{name}.basic_life.time"] for name in "AB"]
    system = sum(each ** (-10 / 9) for each in singles) ** (-9 / 10)
    assert gearbox["shaft.system_basic_life.time"] == pytest.approx(system, rel=1e-9)


@pytest.mark.property
def test_a_duty_cycle_of_one_case_is_no_duty_cycle(gearbox):
    one = dw.run(shaft(duty=[{"share": 1.0}]), only=("rolling",))
    halves = dw.run(shaft(duty=[{"share": 0.5}, {"share": 0.5, "load": 1.0, "speed": "970 rpm"}]), only=("rolling",))
    for name in (f"bearings.{b}.{kind}.time" for b in "AB" for kind in ("basic_life", "reference_life", "modified_life")):
        assert one[name] == pytest.approx(gearbox[name], rel=1e-9) == halves[name]


@pytest.mark.analytical
def test_a_duty_cycle_adds_up_the_damage():
    """Miner's sum of the lives of each case on its own."""
    cases = ({"share": 0.2, "load": 1.5, "speed": "300 rpm"}, {"share": 0.7, "load": 0.5, "speed": "1200 rpm"}, {"share": 0.1, "load": 0.0})
    alone = []
    for case in cases[:2]:
        gears = [gear | {"torque": f"{float(gear['torque'].split()[0]) * case['load']} N m"} for gear in GEARBOX["gears"]]
        alone.append(dw.run(shaft(gears=gears, drive={"speed": case["speed"]}), only=("rolling",)))
    found = dw.run(shaft(duty=list(cases)), only=("rolling",))
    for name in ("bearings.A.basic_life.time", "bearings.B.reference_life.time", "bearings.A.modified_life.time"):
        assert 1 / found[name] == pytest.approx(sum(c["share"] / each[name] for c, each in zip(cases, alone, strict=False)), rel=1e-6)
    assert "duty.A" in found.tables and found.tables["duty.A"]["reference_damage"].data.sum() == pytest.approx(1)


@pytest.mark.interface
def test_a_bearing_of_ones_own_from_its_envelope():
    envelope = {
        "type": "deep-groove",
        "bore": "30 mm",
        "outer_diameter": "72 mm",
        "width": "19 mm",
        "dynamic_rating": "29.6 kN",
        "static_rating": "16 kN",
    }
    found = dw.run(shaft(changed(GEARBOX, "bearings", 0, bearing=None, envelope=envelope)), only=("rolling",))
    named = dw.run(shaft(), only=("rolling",))
    assert found["bearings.A.dynamic_rating"] == 29600
    assert found["bearings.A.radial_force"] == pytest.approx(named["bearings.A.radial_force"], rel=1e-2)
    with pytest.raises(SpecError, match=r"bearings\.A\.envelope\.dynamic_rating.*does not go with the envelope"):
        dw.build(shaft(changed(GEARBOX, "bearings", 0, bearing=None, envelope=envelope | {"dynamic_rating": "296 kN"})))


@pytest.mark.error
def test_ratings_that_contradict_the_bearing_are_findings():
    found = dw.run(shaft(changed(GEARBOX, "bearings", 0, dynamic_rating="296 kN")), only=("rolling",))
    assert any("'A'" in finding and "dynamic_rating" in finding and "times" in finding for finding in found.findings)


@pytest.mark.error
@pytest.mark.parametrize("wrong, told", [("6399", "6305|6309|6319|6300"), ("6321", "6319|6320|6221"), ("NU99", "NU"), ("hello", "known")])
def test_an_unknown_designation_names_the_nearest(wrong, told):
    with pytest.raises(SpecError, match=rf"bearings\.A\.bearing.*({told})"):
        dw.build(shaft(changed(GEARBOX, "bearings", 0, bearing=wrong)))


# -- gears ---------------------------------------------------------------------------------------------------------------------


@pytest.mark.property
def test_a_gear_is_a_station_of_its_own(gearbox):
    stations = [{"name": name, "position": place} for name, place in (("w", "65 mm"), ("p", "130 mm"))]
    twin = dw.run(shaft(stations=stations))
    for gear, station in (("wheel", "w"), ("pinion", "p")):
        assert gearbox[f"gears.{gear}.deflection"] == pytest.approx(twin[f"stations.{station}.displacement"], rel=1e-9)
        assert gearbox[f"gears.{gear}.slope"] >= abs(twin[f"stations.{station}.slope"]) - 1e-15
        assert abs(gearbox[f"gears.{gear}.mesh_slope"]) <= gearbox[f"gears.{gear}.slope"] * (1 + 1e-12)
    assert gearbox["gears.wheel.misalignment"] == pytest.approx(0.03 * abs(gearbox["gears.wheel.mesh_slope"]), rel=1e-12)
    assert "gears.pinion.misalignment" not in gearbox.values


@pytest.mark.analytical
def test_tooth_forces(gearbox):
    tangential = 2 * 160 / 0.15
    assert gearbox["gears.wheel.tangential_force"] == pytest.approx(tangential)
    assert gearbox["gears.wheel.radial_force"] == pytest.approx(tangential * np.tan(np.radians(20)) / np.cos(np.radians(12)))
    assert gearbox["gears.wheel.axial_force"] == pytest.approx(tangential * np.tan(np.radians(12)))
    assert gearbox["gears.pinion.tangential_force"] == pytest.approx(-2 * 160 / 0.05)
    assert gearbox["gears.pinion.axial_force"] == 0


@pytest.mark.analytical
def test_the_slope_in_the_plane_of_action_is_that_along_the_tooth_force():
    """A gear on a simply supported shaft, its force along one direction: the slope lies in the plane of the force, or square to it."""
    plain = {
        "material": {"density": "0 kg/m^3"},
        "segments": [{"length": "300 mm", "diameter": "25 mm"}],
        "bearings": [
            {"name": n, "position": z, "radial_stiffness": "rigid", "axial_stiffness": k}
            for n, z, k in (("A", "0 mm", "rigid"), ("B", "300 mm", None))
        ],
        "gears": [{"name": "g", "position": "80 mm", "pitch_diameter": "60 mm", "torque": "50 N m", "face_width": "20 mm"}],
        "loads": [{"position": "300 mm", "torque": "-50 N m"}],
    }
    for bearing in plain["bearings"]:
        if bearing["axial_stiffness"] is None:
            del bearing["axial_stiffness"]
    found = dw.run(dw.Shaft(**plain), only=("statics",))
    assert abs(found["gears.g.mesh_slope"]) == pytest.approx(found["gears.g.slope"], rel=1e-9)
    force, a, b, length = 2 * 50 / 0.06 / np.cos(np.radians(20)), 0.08, 0.22, 0.3
    inertia = np.pi / 64 * 0.025**4
    slope = force * a * b * (b - a) / (3 * 206e9 * inertia * length)
    assert found["gears.g.mesh_slope"] == pytest.approx(slope, rel=1e-9)
    assert found["gears.g.misalignment"] == pytest.approx(0.02 * slope, rel=1e-9)


@pytest.mark.property
def test_the_mass_of_a_gear_counts_like_that_of_a_station():
    heavy = {"mass": "5 kg", "polar_inertia": "0.01 kg m^2", "diametral_inertia": "0.006 kg m^2"}
    down = {"gravity": ["0 m/s^2", "-9.81 m/s^2", "0 m/s^2"]}
    own = dw.run(shaft(changed(GEARBOX, "gears", 0, **heavy), **down))
    station = dw.run(shaft(stations=[{"name": "w", "position": "65 mm", **heavy}], **down))
    for name in (
        "modes.1.frequency",
        "torsional_modes.1.frequency",
        "critical_speeds.lowest",
        "whirl.forward.1",
        "bearings.A.radial_force",
    ):
        assert own[name] == pytest.approx(station[name], rel=1e-9)
    assert own["unbalance.wheel.amplitude"] == pytest.approx(station["unbalance.w.amplitude"], rel=1e-9)
    with pytest.raises(SpecError, match=r"gears\.0\.name.*is that of a station"):
        shaft(changed(GEARBOX, "gears", 0, **heavy), stations=[{"name": "wheel", "position": "10 mm"}])


@pytest.mark.interface
def test_reactions_are_drawn_as_vectors(gearbox):
    table = gearbox.tables["force_vectors"]
    names = [column.name for column in table.columns[1:]]
    assert names == ["bearing A", "bearing B", "gear wheel", "gear pinion"]
    tips_x = table["x"].data[1::2]
    tips_y = [table[name].data[2 * n + 1] for n, name in enumerate(names)]
    assert sum(tips_x) == pytest.approx(0, abs=1e-6) and sum(tips_y) == pytest.approx(0, abs=1e-6)
    assert np.hypot(tips_x[0], tips_y[0]) == pytest.approx(gearbox["bearings.A.radial_force"], rel=1e-12)


@pytest.mark.interface
def test_gears_have_checks():
    found = dw.run(shaft(limits={"gear_slope": "0.001 deg", "deflection": "1 mm"}), only=("statics",))
    assert not found.check("slope.wheel").ok and found.check("deflection.wheel").ok


# -- strength ------------------------------------------------------------------------------------------------------------------


@pytest.mark.interface
def test_strength_of_every_section(gearbox):
    assert gearbox["strength.min_safety"] == min(gearbox["strength.fatigue_safety"], gearbox["strength.static_safety"])
    assert any("fillet radii are assumed" in finding and "shoulder_2" in finding for finding in gearbox.findings)
    assert not any("shoulder_1" in finding for finding in gearbox.findings)
    rows = gearbox.tables["strength"]
    assert set(rows["section"].data) == {"shoulder_1", "shoulder_2", "segment_1", "segment_2", "segment_3"}
    assert gearbox.check("strength.fatigue_safety").ok


@pytest.mark.property
def test_a_notch_weakens_a_shaft_and_a_shock_its_yield(gearbox):
    notch = {"name": "key", "kind": "keyway", "position": "110 mm", "length": "30 mm"}
    found = dw.run(shaft(notches=[notch], strength={"torsion": "alternating"}, limits={"shock_factor": 2}), only=("strength",))
    smooth = gearbox.tables["strength"]["fatigue_safety"].data[list(gearbox.tables["strength"]["section"].data).index("segment_2")]
    assert found["strength.key.fatigue_safety"] < 0.6 * smooth
    once = dw.run(shaft(notches=[notch], strength={"torsion": "alternating"}), only=("strength",))
    assert found["strength.static_safety"] == pytest.approx(0.5 * once["strength.static_safety"], rel=1e-9)
    assert found["strength.fatigue_safety"] == pytest.approx(once["strength.fatigue_safety"], rel=1e-9)


@pytest.mark.error
@pytest.mark.parametrize(
    "notch, told",
    [
        ({"kind": "retaining-ring", "depth": "1 mm"}, "width: is missing"),
        ({"kind": "keyway", "depth": "1 mm"}, "depth: does not belong to a keyway"),
        ({"kind": "cross-hole", "diameter": "5 mm", "position": "300 mm"}, "300 mm lies outside the shaft"),
    ],
)
def test_notches_without_a_meaning_are_refused(notch, told):
    with pytest.raises(SpecError, match=told):
        dw.build(shaft(notches=[{"name": "n", "position": "50 mm"} | notch]))


@pytest.mark.error
def test_a_lubricant_says_each_thing_once():
    with pytest.raises(SpecError, match=r"lubrication\.viscosity: replaces grade"):
        dw.build(shaft(lubrication={"viscosity": "20 mm^2/s", "grade": "ISO VG 68"}))


@pytest.mark.error
def test_what_strength_lacks_is_said():
    found = dw.run(shaft(material={"youngs_modulus": "206 GPa"}))
    assert any("'strength'" in finding and "tensile strength" in finding for finding in found.findings)
    by_yield = dw.run(shaft(material={"yield_strength": "355 MPa"}), only=("strength",))
    assert any("is used instead" in finding and "tensile_strength" in finding for finding in by_yield.findings)
    whole = dw.run(shaft(material={"yield_strength": "355 MPa", "tensile_strength": "510 MPa"}), only=("strength",))
    assert by_yield["strength.fatigue_safety"] < whole["strength.fatigue_safety"]
    assert not any("is used instead" in finding for finding in whole.findings)


# -- rotors --------------------------------------------------------------------------------------------------------------------


@pytest.mark.interface
def test_a_rotor_has_its_whirl_and_its_response(rotor):
    for n in (1, 2, 3):
        assert 0 < rotor[f"whirl.backward.{n}"] < rotor[f"whirl.forward.{n}"]
        assert rotor[f"whirl.forward.{n}.log_decrement"] > 0
    assert rotor["stability.log_decrement"] == min(value.value for name, value in rotor.values.items() if name.endswith(".log_decrement"))
    assert rotor["unbalance.d1.amplitude"] > 0 and rotor["bearings.A.unbalance_force"] > 0
    assert rotor["unbalance.balance_quality"] == pytest.approx(6.3e-3, rel=1e-12)
    assert any("G 6.3" in finding for finding in rotor.findings)
    assert {"campbell", "whirl_shapes", "unbalance_response"} <= set(rotor.tables)
    assert rotor["critical_speeds.damped.1"] < rotor["critical_speeds.damped.2"]
    assert rotor["critical_speeds.damped.2.amplification"] > 10
    assert not rotor.check("critical_speed").ok and rotor.check("separation_margin").ok and rotor.check("stability").ok


@pytest.mark.property
def test_whirl_of_a_rotor_that_hardly_turns_is_its_natural_frequency():
    found = dw.run(shaft(ROTOR, drive={"speed": "0.1 rpm"}))
    for way in ("forward", "backward"):
        assert found[f"whirl.{way}.1"] == pytest.approx(2 * np.pi * found["modes.1.frequency"], rel=1e-4)


@pytest.mark.error
def test_a_resonance_that_nothing_damps_is_told():
    undamped = copy.deepcopy(ROTOR)
    for bearing in undamped["bearings"]:
        del bearing["radial_damping"]
    speed = dw.run(shaft(undamped), only=("modes",))["critical_speeds.forward.1"]
    found = dw.run(shaft(undamped, drive={"speed": f"{speed!r} rad/s"}))
    assert "unbalance.d1.amplitude" not in found.values and "whirl.forward.1" in found.values
    assert any("natural frequency that no support damps" in finding and "radial_damping" in finding for finding in found.findings)
    assert np.all(np.isfinite(found.tables["unbalance_response"]["d1"].data))
    assert "stability.log_decrement" not in found.values


@pytest.mark.analytical
def test_cross_coupling_turns_the_deflection():
    """A rigid shaft on two bearings: u = inv(K) F, the force along x of a displacement along y being stiffness_xy."""
    k, load = np.array([[3e6, 8e5], [-5e5, 2e6]]), np.array([100.0, -400.0])
    bearings = [
        {
            "name": name,
            "position": place,
            "stiffness_xx": "1.5e6 N/m",
            "stiffness_yy": "1e6 N/m",
            "stiffness_xy": "4e5 N/m",
            "stiffness_yx": "-2.5e5 N/m",
        }
        for name, place in (("A", "0 mm"), ("B", "200 mm"))
    ]
    tables = {
        "material": {"youngs_modulus": "1e9 GPa"},
        "segments": [{"length": "200 mm", "diameter": "40 mm"}],
        "bearings": bearings,
        "stations": [{"name": "m", "position": "100 mm"}],
        "loads": [{"station": "m", "force": "100 N", "angle": "0 deg"}, {"station": "m", "force": "400 N"}],
    }
    found = dw.run(dw.Shaft(**tables), only=("statics", "flexibility"))
    wanted = np.linalg.solve(k, load)
    assert [found["stations.m.deflection_x"], found["stations.m.deflection_y"]] == pytest.approx(wanted.tolist(), rel=1e-6)
    assert found["bearings.A.reaction_x"] == pytest.approx(-load[0] / 2, rel=1e-9)
    down = np.array([0.0, -1.0])
    assert found.check("equilibrium").ok and found.check("equilibrium.unit_loads").ok
    assert not any("not linear" in finding for finding in found.findings)
    offset = [bearing | {"seat_offset": ["0.1 mm", "0 mm"]} for bearing in bearings]
    moved = dw.run(dw.Shaft(**(tables | {"bearings": offset})), only=("statics",))
    assert moved["stations.m.deflection_x"] == pytest.approx(wanted[0] + 1e-4, rel=1e-6)
    assert moved["stations.m.deflection_y"] == pytest.approx(wanted[1], rel=1e-6) and moved.check("equilibrium").ok
    assert found["flexibility.m.m"] == pytest.approx(down @ np.linalg.inv(k) @ down, rel=1e-6)


@pytest.mark.property
def test_a_beam_with_rotary_inertia_lies_between_the_other_two():
    lowest = {
        theory: dw.run(shaft(ROTOR, analysis={"theory": theory}), only=("modes",))["modes.3.frequency"]
        for theory in ("timoshenko", "rayleigh", "euler-bernoulli")
    }
    assert lowest["timoshenko"] < lowest["rayleigh"] < lowest["euler-bernoulli"]


@pytest.mark.error
@pytest.mark.parametrize(
    "keys, told",
    [
        ({"radial_stiffness": None, "stiffness_xx": "1e6 N/m"}, r"stiffness_yy: is missing beside stiffness_xx"),
        ({"stiffness_xx": "1e6 N/m", "stiffness_yy": "1e6 N/m"}, "radial_stiffness and stiffness_xx; give one of"),
        ({"radial_stiffness": "rigid", "stiffness_xy": "1e5 N/m"}, "stiffness_xy: needs a radial_stiffness"),
        ({"radial_damping": "-3 N s/m"}, "radial_damping"),
        ({"damping_xx": "1 N s/m", "damping_yy": "2 N s/m"}, "radial_damping: has no effect beside"),
    ],
)
def test_supports_without_a_meaning_are_refused(keys, told):
    with pytest.raises(InputError, match=told):
        dw.build(shaft(changed(ROTOR, "bearings", 0, **keys)))


@pytest.mark.error
@pytest.mark.parametrize(
    "duty, told",
    [([{"share": 0.5}], r"duty: the shares of the time sum to 0\.5"), ([{"share": 1.0, "speed": "0 rpm"}], "all speeds are 0")],
)
def test_duty_cycles_without_a_meaning_are_refused(duty, told):
    with pytest.raises(SpecError, match=told):
        shaft(duty=duty)
    without = {key: value for key, value in GEARBOX.items() if key != "drive"}
    with pytest.raises(SpecError, match=r"duty\.0\.speed: is missing"):
        shaft(without, duty=[{"share": 1.0}])


@pytest.mark.conformance
def test_the_examples_of_every_day_pass_their_checks():
    for name in ("gearbox_shaft", "two_disc_rotor", "spindle_duty"):
        result = dw.run(dw.load(EXAMPLES / f"{name}.toml"))
        assert result.outcome == "complete" and all(check.ok for check in result.checks), name


# -- what a design must not pass with ------------------------------------------------------------------------------------------


@pytest.mark.property
def test_the_largest_load_of_a_duty_cycle_is_judged():
    """Strength and static safety are those of the same loads on their own."""
    duty = [{"share": 0.9, "load": 0.5}, {"share": 0.1, "load": 3.0, "name": "over"}]
    found = dw.run(shaft(duty=duty), only=("rolling", "strength"))
    gears = [gear | {"torque": f"{3 * float(gear['torque'].split()[0])} N m"} for gear in GEARBOX["gears"]]
    alone = dw.run(shaft(gears=gears), only=("rolling", "strength"))
    assert found["strength.min_safety"] == pytest.approx(alone["strength.min_safety"], rel=1e-9)
    for name in "AB":
        assert found.check(f"static_safety.{name}").value == pytest.approx(alone.check(f"static_safety.{name}").value, rel=1e-6)
    assert any("maximum loads of the duty cycle, 3 times" in finding for finding in found.findings)
    assert found.tables["duty.A"]["case"].data.tolist() == ["1", "over"]
    mild = dw.run(shaft(duty=[{"share": 1.0, "load": 0.5}]), only=("rolling", "strength"))
    given = dw.run(shaft(), only=("rolling", "strength"))
    assert mild["strength.min_safety"] == pytest.approx(given["strength.min_safety"], rel=1e-12)
    assert mild.check("static_safety.A").value == pytest.approx(given.check("static_safety.A").value, rel=1e-12)


RING = {"name": "n", "kind": "retaining-ring", "position": "100 mm", "depth": "1 mm", "width": "1.6 mm", "radius": "0.1 mm"}


@pytest.mark.error
@pytest.mark.parametrize(
    "notch, told",
    [
        (RING | {"depth": "20 mm"}, r"notches\.n: nothing is left of the shaft"),
        (RING | {"radius": "5 mm"}, r"notches\.n: corners of 5 mm do not go into a groove 1 mm deep"),
        ({"name": "n", "kind": "keyway", "position": "50 mm", "length": "300 mm"}, r"notches\.n: ends at 350 mm, beyond the shaft"),
        ({"name": "n", "kind": "cross-hole", "position": "100 mm", "diameter": "39 mm"}, r"notches\.n"),
    ],
)
def test_impossible_notches_are_refused(notch, told):
    with pytest.raises(SpecError, match=told):
        dw.build(shaft(notches=[notch]))


@pytest.mark.error
@pytest.mark.parametrize(
    "changes, told",
    [
        ({"material": {"yield_strength": "1200 MPa", "tensile_strength": "900 MPa"}}, r"material\.yield_strength: 1200 MPa is more"),
        (changed(GEARBOX, "segments", 0, fillet_radius="50 mm"), r"segments\.0\.fillet_radius: 50 mm is more than the radius"),
    ],
)
def test_impossible_strengths_and_fillets_are_refused(changes, told):
    with pytest.raises(SpecError, match=told):
        dw.build(shaft(**changes))


@pytest.mark.error
def test_a_bearing_of_another_bore_is_told():
    found = dw.run(shaft(changed(GEARBOX, "bearings", 0, bearing="6000")), only=("rolling",))
    assert any("'A' has a bore of 10 mm, and the shaft has 30 mm at its seat" in finding for finding in found.findings)
    fitting = dw.run(shaft(), only=("rolling",))
    assert not any("bore" in finding for finding in fitting.findings)
    step = dw.run(shaft(changed(GEARBOX, "bearings", 0, position="40 mm", bearing="6306")), only=("rolling",))
    assert not any("bore" in finding for finding in step.findings)


@pytest.mark.error
def test_a_shaft_that_nothing_locates_is_told():
    spur = [{key: value for key, value in gear.items() if key != "helix_angle"} for gear in GEARBOX["gears"]]
    loose = changed(GEARBOX, "bearings", 0, bearing="NU206") | {"gears": spur}
    assert any("no bearing locates the shaft along its axis" in finding for finding in dw.run(shaft(loose), only=("rolling",)).findings)
    assert not any("along its axis" in finding for finding in dw.run(shaft(gears=spur), only=("rolling",)).findings)


@pytest.mark.error
def test_a_preload_that_nothing_answers_is_told():
    spur = [{key: value for key, value in gear.items() if key != "helix_angle"} for gear in GEARBOX["gears"]]
    found = dw.run(shaft(changed(GEARBOX, "bearings", 0, preload="300 N") | {"gears": spur}), only=("rolling",))
    assert any("preload of bearing 'A' has no effect" in finding for finding in found.findings)
    spindle = dw.run(dw.load(EXAMPLES / "spindle_duty.toml"), only=("rolling",))
    assert not any("has no effect" in finding for finding in spindle.findings)


@pytest.mark.error
def test_inertia_that_no_body_has_is_told(rotor):
    found = dw.run(shaft(changed(ROTOR, "stations", 0, polar_inertia="15 kg m^2")), only=("whirl",))
    assert any("'d1' has a polar_inertia of 15" in finding for finding in found.findings)
    assert not any("polar_inertia" in finding for finding in rotor.findings)


@pytest.mark.interface
def test_the_campbell_diagram_always_shows_the_speed(rotor):
    found = dw.run(shaft(ROTOR, analysis={"campbell_speed": "1000 rpm"}))
    assert found.tables["campbell"]["speed"].data[-1] == pytest.approx(1.05 * 4000 * np.pi / 30)
    assert "separation_margin" in {check.name for check in found.checks}
    whole = rotor["unbalance.d1.moment"] + rotor["unbalance.d2.moment"]
    mass = 83 + 7810 * np.pi / 4 * 0.05**2 * 1.5
    assert whole == pytest.approx(6.3e-3 / (4000 * np.pi / 30) * mass, rel=1e-9)


# -- tables and words of a rotor -----------------------------------------------------------------------------------------------


@pytest.mark.property
def test_the_campbell_diagram_meets_whirl_and_critical_speeds(rotor):
    table, speed = rotor.tables["campbell"], 4000 * np.pi / 30
    assert table["speed"].data[0] == 0
    assert table["synchronous"].data == pytest.approx(table["speed"].data / (2 * np.pi))
    for name in ("forward_1", "backward_1", "forward_2", "backward_2"):
        at_speed = np.interp(speed, table["speed"].data, table[name].data)
        assert 2 * np.pi * at_speed == pytest.approx(rotor[f"whirl.{name.replace('_', '.')}"], rel=1e-4)
        assert np.sign(table[f"{name}.sense"].data[-1]) == (1 if name.startswith("forward") else -1)
    critical = [rotor[f"critical_speeds.damped.{n}"] for n in (1, 2, 3, 4)]
    excited = [each for each in critical if each in (critical[1], critical[3])]  # forward, on bearings that are the same all round
    margin = min(abs(each / speed - 1) for each in excited)
    assert rotor.check("separation_margin").value == pytest.approx(margin, rel=1e-9)
    speeds = rotor.tables["unbalance_response"]["speed"].data
    for number, each in enumerate(critical, 1):
        ratio = 0.5 / rotor[f"critical_speeds.damped.{number}.amplification"]
        for flank in (-4, -1, -0.5, 0, 0.5, 1, 2, 4):
            assert np.min(np.abs(speeds / each - 1 - flank * ratio)) < 1e-9
    assert np.all(np.diff(speeds) > 0) and speeds[0] > 0 and speeds[-1] == pytest.approx(table["speed"].data[-1])


@pytest.mark.interface
def test_whirl_shapes_and_words_of_a_rotor(rotor):
    shapes = rotor.tables["whirl_shapes"]
    for column in shapes.columns[1:]:
        assert np.abs(column.data).max() == pytest.approx(1, rel=1e-4)
    assert np.all(shapes["forward_1"].data > 0) and np.any(shapes["forward_2"].data < 0) and shapes["forward_2"].data[0] > 0.5
    hertz = rotor["whirl.forward.1"] / (2 * np.pi)
    assert f"{hertz:.4g} Hz" in shapes["forward_1"].meaning
    assert "at 4000 rpm" in rotor.values["whirl.forward.1"].meaning and "at 4000 rpm" in rotor.values["unbalance.d1.amplitude"].meaning
    lags = rotor.tables["unbalance_response"]["d1.lag"].data
    assert abs(lags[0]) < np.pi and np.all(np.abs(np.diff(lags)) < np.pi)


@pytest.mark.error
def test_what_drowns_the_stiffness_leaves_whirl_and_response_out():
    found = dw.run(shaft(changed(ROTOR, "bearings", 0, radial_damping="1e30 N s/m")))
    assert any(finding.startswith("whirl is absent") and "damping" in finding for finding in found.findings)
    assert any("'unbalance'" in finding and "left out" in finding for finding in found.findings)
    assert found.outcome == "complete" and "whirl.forward.1" not in found.values


@pytest.mark.property
def test_a_gear_and_a_station_at_one_place_keep_their_own_unbalance():
    gear = {"name": "g", "position": "0.5 m", "pitch_diameter": "100 mm", "torque": "0 N m", "mesh_angle": "0 deg", "mass": "3.2 kg"}
    shared = dw.run(shaft(ROTOR, gears=[gear]), only=("unbalance",))
    assert shared["unbalance.g.moment"] == pytest.approx(0.1 * shared["unbalance.d1.moment"], rel=1e-12)
    own = dw.run(shaft(ROTOR, gears=[gear | {"unbalance": "20 g mm"}]), only=("unbalance",))
    assert own["unbalance.g.moment"] == pytest.approx(2e-8 * 1e3, rel=1e-12) and "unbalance.d1.moment" not in own.values


@pytest.mark.interface
def test_a_solver_that_fails_under_the_overload_leaves_the_strength_out(monkeypatch):
    from drivewright import shafts
    from drivewright.errors import SolverError

    def fails(*_):
        raise SolverError("no equilibrium")

    monkeypatch.setattr(shafts, "scaled_loads", fails)
    found = dw.run(shaft(GEARBOX, duty=[{"share": 1.0, "load": 3.0}]), only=("strength",))
    assert any("strength is absent: no equilibrium" in finding for finding in found.findings)
